//! A robot's files: URDF, the `robot.toml` beside it, and the meshes it names.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use slam::mesh::{Mesh, parse_obj, parse_stl};
use slam::robot_file::{self, RobotFile};
use slam::urdf::{self, RobotDescription, ShapeDescription};
use slam::{Diagnostic, Source, Span};

use crate::files;
use crate::library::{Kind, Library};
use crate::refusal::Refusal;

/// A robot as read.
#[derive(Debug)]
pub(crate) struct RobotFiles {
    /// Text of the URDF.
    pub(crate) source: Source,
    /// What it says.
    pub(crate) urdf: RobotDescription,
    /// What stands beside it.
    pub(crate) notes: Option<(Source, RobotFile)>,
    /// Folder of the URDF; `None` for one in the program.
    folder: Option<PathBuf>,
}

/// A robot of the library, if it has this name.
pub(crate) fn from_library(library: &Library, name: &str) -> Result<Option<RobotFiles>, Refusal> {
    let Some(found) = library.find(Kind::Robot, name)? else { return Ok(None) };
    let notes = library.robot_toml(name)?.map(|notes| notes.source);
    read(found.source, notes, found.folder).map(Some)
}

/// A robot by the path of its URDF.
pub(crate) fn from_path(path: &Path) -> Result<RobotFiles, Refusal> {
    let source = files::text(path, files::MAX_URDF)?;
    let beside = path.with_file_name("robot.toml");
    let notes = beside.is_file().then(|| files::text(&beside, files::MAX_TOML)).transpose()?;
    read(source, notes, Some(files::folder_of(path)))
}

fn read(
    source: Source,
    notes: Option<Source>,
    folder: Option<PathBuf>,
) -> Result<RobotFiles, Refusal> {
    let urdf = urdf::parse(&source).map_err(|problems| Refusal::of(&source, problems))?;
    let notes = match notes {
        None => None,
        Some(notes) => {
            let file =
                robot_file::parse(&notes).map_err(|problems| Refusal::of(&notes, problems))?;
            Some((notes, file))
        }
    };
    Ok(RobotFiles { source, urdf, notes, folder })
}

/// Meshes by their path in the URDF, and a warning for each that cannot be had.
pub(crate) struct Meshes {
    /// Those read.
    pub(crate) read: BTreeMap<String, Mesh>,
    /// One warning per mesh that was not.
    pub(crate) warnings: Vec<Diagnostic>,
}

impl RobotFiles {
    /// Reads the meshes of collision shapes.
    pub(crate) fn collision_meshes(&self, packages: &BTreeMap<String, PathBuf>) -> Meshes {
        let mut meshes = Meshes { read: BTreeMap::new(), warnings: Vec::new() };
        for path in self.mesh_paths(false) {
            let read = self.locate(path, packages).and_then(|file| read_mesh(&file));
            match read {
                Ok(mesh) => drop(meshes.read.insert(path.to_owned(), mesh)),
                Err(why) => meshes.warnings.push(self.missing(path, &why)),
            }
        }
        meshes
    }

    /// A warning for every mesh, also of pictures, whose file is not there.
    pub(crate) fn missing_meshes(&self, packages: &BTreeMap<String, PathBuf>) -> Vec<Diagnostic> {
        let missing = |path| Some(self.missing(path, &self.locate(path, packages).err()?));
        self.mesh_paths(true).into_iter().filter_map(missing).collect()
    }

    fn mesh_paths(&self, also_visual: bool) -> BTreeSet<&str> {
        let links = self.urdf.links.iter();
        let visuals =
            |link: &'_ slam::urdf::LinkDescription| also_visual && !link.visuals.is_empty();
        links
            .flat_map(|link| {
                let visuals = if visuals(link) { link.visuals.as_slice() } else { &[] };
                link.collisions.iter().chain(visuals)
            })
            .filter_map(|body| match &body.shape {
                ShapeDescription::Mesh { path, .. } => Some(path.as_str()),
                _ => None,
            })
            .collect()
    }

    fn missing(&self, path: &str, why: &str) -> Diagnostic {
        let start = self.source.text.find(path).unwrap_or(0);
        // the reasons of `slam` begin with the path
        let why = why.strip_prefix(path).map_or(why, |why| why.trim_start_matches(": "));
        let message = format!("mesh {} is left out: {why}", crate::names::clipped(path));
        let warning = Diagnostic::warning(Span { start, end: start + path.len() }, message);
        match path.strip_prefix("package://").and_then(|rest| rest.split_once('/')) {
            Some((package, _)) => warning.hint(format!(
                "say where the package lies: --package {package}=DIR, or `packages` in the cell"
            )),
            None => warning,
        }
    }

    /// The file of a mesh, below the folders allowed also when links are followed.
    fn locate(&self, path: &str, packages: &BTreeMap<String, PathBuf>) -> Result<PathBuf, String> {
        let none = PathBuf::new();
        let relative = !path.contains("://");
        if self.folder.is_none() && relative {
            return Err("a robot in the program has no files beside it".to_owned());
        }
        let folder = self.folder.as_ref().unwrap_or(&none);
        let file = urdf::mesh_location(path, packages, folder).map_err(|e| e.to_string())?;
        let real = file.canonicalize().map_err(|_| format!("no file {}", file.display()))?;
        let above = folder.canonicalize().ok().and_then(|real| Some(real.parent()?.to_owned()));
        let named = packages.values().filter_map(|folder| folder.canonicalize().ok());
        if !above.into_iter().chain(named).any(|allowed| real.starts_with(allowed)) {
            return Err(format!("a link leads out of the robot's folders, to {}", real.display()));
        }
        Ok(real)
    }
}

/// A mesh by its extension.
pub(crate) fn read_mesh(path: &Path) -> Result<Mesh, String> {
    parse_mesh(path, files::bytes(path, files::MAX_MESH)?)
}

/// The bytes of a mesh file as a mesh.
pub(crate) fn parse_mesh(path: &Path, bytes: Vec<u8>) -> Result<Mesh, String> {
    let extension = path.extension().map(|ext| ext.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("stl") => parse_stl(&bytes).map_err(|error| error.to_string()),
        Some("obj") => {
            let text = String::from_utf8(bytes).map_err(|_| "it is not a text".to_owned())?;
            parse_obj(&text).map_err(|error| error.to_string())
        }
        _ => Err("only .stl and .obj are read".to_owned()),
    }
}
