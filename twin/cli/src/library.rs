//! Robots, cells, tools and materials by name: the project's folders in the program, and the
//! user's in front of them.

use std::fs;
use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};
use slam::Source;

use crate::files;
use crate::refusal::Refusal;

static ROBOTS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../robots");
static MATERIALS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../materials");

/// Where the library is, beside the folders in the program.
#[derive(Debug, Clone, Default, clap::Args)]
pub(crate) struct LibraryArgs {
    /// Folder with robots/ and materials/ that is looked into first (also: TWIN_LIBRARY)
    #[arg(long, value_name = "DIR")]
    library: Option<PathBuf>,
}

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A cell.
    Cell,
    /// A tool.
    Tool,
    /// A robot: its URDF.
    Robot,
    /// A material.
    Material,
}

impl Kind {
    /// All kinds.
    pub(crate) const ALL: [Self; 4] = [Self::Robot, Self::Cell, Self::Tool, Self::Material];

    /// The word for it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Cell => "cell",
            Self::Tool => "tool",
            Self::Robot => "robot",
            Self::Material => "material",
        }
    }

    fn path(self, name: &str) -> String {
        match self {
            Self::Cell => format!("robots/cells/{name}.toml"),
            Self::Tool => format!("robots/tools/{name}.toml"),
            Self::Robot => format!("robots/{name}/robot.urdf"),
            Self::Material => format!("materials/{name}.toml"),
        }
    }

    fn limit(self) -> u64 {
        if self == Self::Robot { files::MAX_URDF } else { files::MAX_TOML }
    }

    /// Name of the thing that a file of the library holds, `path` with `/` between its parts.
    fn name_in(self, path: &str) -> Option<&str> {
        let (before, after) = match self {
            Self::Cell => ("robots/cells/", ".toml"),
            Self::Tool => ("robots/tools/", ".toml"),
            Self::Robot => ("robots/", "/robot.urdf"),
            Self::Material => ("materials/", ".toml"),
        };
        path.strip_prefix(before)?.strip_suffix(after).filter(|name| is_name(name))
    }
}

/// A file of the library.
#[derive(Debug)]
pub(crate) struct Found {
    /// Its text.
    pub(crate) source: Source,
    /// Its folder on disk; `None` for one in the program.
    pub(crate) folder: Option<PathBuf>,
}

/// The library.
#[derive(Debug)]
pub(crate) struct Library {
    front: Vec<PathBuf>,
}

impl Library {
    /// The folders asked for, in front of those in the program.
    pub(crate) fn open(args: &LibraryArgs) -> Result<Self, Refusal> {
        let named = std::env::var_os("TWIN_LIBRARY").filter(|value| !value.is_empty());
        let front: Vec<PathBuf> =
            args.library.iter().cloned().chain(named.map(PathBuf::from)).collect();
        for folder in &front {
            if !folder.join("robots").is_dir() && !folder.join("materials").is_dir() {
                let message = "this is no library: neither robots/ nor materials/ is in it";
                return Err(Refusal::whole(folder.display().to_string(), message)
                    .hint("--library and TWIN_LIBRARY name a folder laid out as the project is"));
            }
        }
        Ok(Self { front })
    }

    /// The folders on disk, first looked into first.
    pub(crate) fn folders(&self) -> &[PathBuf] {
        &self.front
    }

    /// The file of this name, if there is one.
    pub(crate) fn find(&self, kind: Kind, name: &str) -> Result<Option<Found>, Refusal> {
        if !is_name(name) {
            return Ok(None);
        }
        self.file(&kind.path(name), kind.limit())
    }

    /// What stands beside the URDF of a robot, if there is something.
    pub(crate) fn robot_toml(&self, name: &str) -> Result<Option<Found>, Refusal> {
        self.file(&format!("robots/{name}/robot.toml"), files::MAX_TOML)
    }

    fn file(&self, path: &str, limit: u64) -> Result<Option<Found>, Refusal> {
        for folder in &self.front {
            let file = folder.join(path);
            if file.exists() {
                let source = files::text(&file, limit)?;
                return Ok(Some(Found { source, folder: Some(files::folder_of(&file)) }));
            }
        }
        let bytes = embedded(path).map(<[u8]>::to_vec);
        let found = |bytes| {
            let source = files::utf8(format!("<library>/{path}"), bytes)?;
            Ok(Found { source, folder: None })
        };
        bytes.map(found).transpose()
    }

    /// All names of a kind, in order.
    pub(crate) fn names(&self, kind: Kind) -> Vec<String> {
        let mut paths = Vec::new();
        embedded_paths(&ROBOTS, "robots", &mut paths);
        embedded_paths(&MATERIALS, "materials", &mut paths);
        for folder in &self.front {
            for part in ["robots", "materials"] {
                disk_paths(&folder.join(part), part, 0, &mut paths);
            }
        }
        let mut names: Vec<String> =
            paths.iter().filter_map(|path| kind.name_in(path)).map(str::to_owned).collect();
        names.sort();
        names.dedup();
        names
    }
}

/// Whether a text can be a name: parts of letters, digits and `-_.` between slashes, none of them
/// a way out of the library.
pub(crate) fn is_name(text: &str) -> bool {
    let part = |part: &str| {
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        !part.is_empty() && !part.starts_with('.') && part.chars().all(plain)
    };
    text.len() <= 200 && text.split('/').all(part)
}

fn embedded(path: &str) -> Option<&'static [u8]> {
    let (folder, rest) = path.split_once('/')?;
    let dir = if folder == "robots" { &ROBOTS } else { &MATERIALS };
    dir.get_file(rest).map(|file| file.contents())
}

fn embedded_paths(dir: &Dir<'_>, prefix: &str, paths: &mut Vec<String>) {
    let slashes = |path: &Path| path.to_string_lossy().replace('\\', "/");
    paths.extend(dir.files().map(|file| format!("{prefix}/{}", slashes(file.path()))));
    for inner in dir.dirs() {
        embedded_paths(inner, prefix, paths);
    }
}

fn disk_paths(folder: &Path, prefix: &str, depth: usize, paths: &mut Vec<String>) {
    // robots/<maker>/<model>/robot.urdf is the deepest; links in circles end here too
    const DEEPEST: usize = 3;
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = format!("{prefix}/{}", entry.file_name().to_string_lossy());
        match entry.path().is_dir() {
            true if depth < DEEPEST => disk_paths(&entry.path(), &name, depth + 1, paths),
            true => {}
            false => paths.push(name),
        }
    }
}
