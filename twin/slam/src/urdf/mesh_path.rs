//! Where a mesh named in a URDF lies. Pure path arithmetic: nothing is opened, links of the file
//! system are not followed.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// Why a mesh is not looked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshPathError {
    /// Nobody said where the package lies.
    #[error("{path}: nobody said where the package {package} lies")]
    UnknownPackage {
        /// As written in the URDF.
        path: String,
        /// The package's name.
        package: String,
    },
    /// A path out of the folders that the user named.
    #[error("{path}: leads out of the robot's folders, to {resolved}")]
    Outside {
        /// As written in the URDF.
        path: String,
        /// Where it leads.
        resolved: PathBuf,
    },
    /// `http:` and the like, or no path at all.
    #[error("{path:?}: not a path to a file")]
    Unsupported {
        /// As written in the URDF.
        path: String,
    },
}

/// Resolves `package://NAME/rest`, `file://` and paths relative to `urdf_dir`, the folder of the
/// URDF.
///
/// The answer lies below the parent of `urdf_dir` or below a folder of `packages`; a
/// `package://` path stays in its own package.
pub fn mesh_location(
    path: &str,
    packages: &BTreeMap<String, PathBuf>,
    urdf_dir: &Path,
) -> Result<PathBuf, MeshPathError> {
    let unsupported = || MeshPathError::Unsupported { path: path.to_owned() };
    if path.contains('\0') || path.trim().is_empty() {
        return Err(unsupported());
    }
    if let Some(rest) = path.strip_prefix("package://") {
        let (package, inner) = rest.split_once('/').ok_or_else(unsupported)?;
        let folder = packages.get(package).ok_or_else(|| MeshPathError::UnknownPackage {
            path: path.to_owned(),
            package: package.to_owned(),
        })?;
        // a leading slash would make `join` forget the folder
        return below(path, &folder.join(inner.trim_start_matches('/')), &[normal(folder)]);
    }
    let file = match path.split_once("://") {
        Some(("file", file)) => file,
        Some(_) => return Err(unsupported()),
        None => path,
    };
    // both: the parent of an empty (current) folder is `..`, which holds `x` only by its real name
    let mut folders = vec![normal(&urdf_dir.join("..")), normal(urdf_dir)];
    folders.extend(packages.values().map(|folder| normal(folder)));
    below(path, &urdf_dir.join(file), &folders)
}

fn below(path: &str, resolved: &Path, folders: &[PathBuf]) -> Result<PathBuf, MeshPathError> {
    let resolved = normal(resolved);
    // relative folders: what is left of `../../x` below `..` still climbs
    let inside = |folder: &PathBuf| {
        let rest = resolved.strip_prefix(folder).ok();
        rest.is_some_and(|rest| matches!(rest.components().next(), Some(Component::Normal(_))))
    };
    match folders.iter().any(inside) {
        true => Ok(resolved),
        false => Err(MeshPathError::Outside { path: path.to_owned(), resolved }),
    }
}

/// Without `.` and, as far as the text tells, without `..`.
fn normal(path: &Path) -> PathBuf {
    let mut parts: Vec<Component<'_>> = Vec::new();
    for part in path.components() {
        match (part, parts.last()) {
            (Component::CurDir, _) => {}
            (Component::ParentDir, Some(Component::Normal(_))) => {
                parts.pop();
            }
            (Component::ParentDir, Some(Component::RootDir | Component::Prefix(_))) => {}
            _ => parts.push(part),
        }
    }
    parts.iter().collect()
}
