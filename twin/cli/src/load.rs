//! A job's file and everything it names, read, parsed and resolved.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use report::Input;
use sim::cell::{Cell, Job, Parts, resolve};
use slam::cell_file::{self, CellFile};
use slam::document::{Allowance, Document, Form};
use slam::material_file::{self, MaterialFile};
use slam::mesh::Mesh;
use slam::tool_file::{self, ToolFile};
use slam::{Diagnostic, Source, Span};

use crate::files;
use crate::library::{Found, Kind, Library, is_name};
use crate::names::{sha256, with_names};
use crate::refusal::{Failure, Refusal};
use crate::robot::{self, RobotFiles};
use crate::screen::Screen;

/// A job ready for the twin.
pub(crate) struct Loaded {
    /// Its text.
    pub(crate) source: Source,
    /// What it says.
    pub(crate) job: Job,
    /// Findings that it lets pass for a while.
    pub(crate) allowances: Vec<Allowance>,
    /// URDF of its robot.
    pub(crate) urdf: Source,
    /// The files it was made from.
    pub(crate) inputs: Vec<Input>,
    /// Link meshes that could not be had, so that these links are not in the way of anything.
    pub(crate) missing_meshes: usize,
}

/// Paths of what was read; names of the library are none.
pub(crate) fn paths(inputs: &[Input]) -> impl Iterator<Item = &Path> {
    inputs.iter().map(|input| Path::new(&input.name))
}

/// A cell with its robot and tool.
pub(crate) struct CellParts {
    /// The cell.
    pub(crate) cell: CellFile,
    robot: RobotFiles,
    tool: ToolFile,
    packages: BTreeMap<String, PathBuf>,
    inputs: Vec<Input>,
}

/// Who names a cell or a material, and where.
pub(crate) struct Naming<'a> {
    /// The text that does.
    pub(crate) source: &'a Source,
    /// Where in it.
    pub(crate) span: Span,
    /// The folder that paths in it start from; `None`: it has none and may name no path.
    pub(crate) folder: Option<&'a Path>,
}

/// Reads a job. Warnings are told as they come.
pub(crate) fn job(
    path: &Path,
    library: &Library,
    screen: &mut Screen<'_>,
) -> Result<Loaded, Failure> {
    let source = files::text(path, files::MAX_TEXT)?;
    let (document, warnings) =
        slam::job::parse(&source).map_err(|problems| Refusal::of(&source, problems))?;
    screen.say(&source, &warnings)?;
    let folder = files::folder_of(path);
    let naming = |span| Naming { source: &source, span, folder: Some(&folder) };
    let mut inputs = vec![input("job", &source)];
    let CellParts { cell, robot, tool, packages, inputs: of_cell } =
        cell_parts(&document.cell.value, &naming(document.cell.span), library)?;
    inputs.extend(of_cell);
    let (material, text) =
        material(&document.material.value, &naming(document.material.span), library)?;
    inputs.push(input("material", &text));
    let form_meshes = form_meshes(&document, &source, &folder, &mut inputs)?;
    let meshes = robot.collision_meshes(&packages);
    screen.say(&robot.source, &meshes.warnings)?;
    let parts = Parts {
        cell: &cell,
        robot: robot.notes.as_ref().map(|(_, notes)| notes),
        urdf: &robot.urdf,
        link_meshes: &meshes.read,
        tool: &tool,
        material: &material,
        form_meshes: &form_meshes,
    };
    let job = resolve(&document, &parts).map_err(|problems| Refusal::of(&source, problems))?;
    Ok(Loaded {
        job,
        allowances: document.allow,
        urdf: robot.source,
        inputs,
        missing_meshes: meshes.warnings.len(),
        source,
    })
}

fn input(what: &str, source: &Source) -> Input {
    let sha256 = sha256(source.text.as_bytes());
    Input { what: what.to_owned(), name: source.name.clone(), sha256 }
}

/// A cell by name or path, with its robot and tool.
pub(crate) fn cell_parts(
    name: &str,
    naming: &Naming<'_>,
    library: &Library,
) -> Result<CellParts, Refusal> {
    let Found { source, folder } = named(Kind::Cell, name, naming, library)?;
    let cell = cell_file::parse(&source).map_err(|problems| Refusal::of(&source, problems))?;
    let at =
        |key| Naming { source: &source, span: line_of(&source, key), folder: folder.as_deref() };
    let robot = robot_of(&cell.robot, &at("robot"), library)?;
    let found = named(Kind::Tool, &cell.tool, &at("tool"), library)?;
    let tool =
        tool_file::parse(&found.source).map_err(|problems| Refusal::of(&found.source, problems))?;
    let packages = folder.iter().flat_map(|folder| {
        cell.packages.iter().map(|(package, path)| (package.clone(), folder.join(path)))
    });
    let mut inputs = vec![input("cell", &source), input("robot", &robot.source)];
    inputs.extend(robot.notes.iter().map(|(notes, _)| input("robot", notes)));
    inputs.push(input("tool", &found.source));
    Ok(CellParts { packages: packages.collect(), cell, robot, tool, inputs })
}

/// The cell alone, without shapes of its links: enough to ask where its arm puts the nozzle.
pub(crate) fn bare_machine(parts: &CellParts, material: &MaterialFile) -> Result<Cell, String> {
    sim::cell::machine(&Parts {
        cell: &parts.cell,
        robot: parts.robot.notes.as_ref().map(|(_, notes)| notes),
        urdf: &parts.robot.urdf,
        link_meshes: &BTreeMap::new(),
        tool: &parts.tool,
        material,
        form_meshes: &[],
    })
}

/// A material by name or path, and its text.
pub(crate) fn material(
    name: &str,
    naming: &Naming<'_>,
    library: &Library,
) -> Result<(MaterialFile, Source), Refusal> {
    let Found { source, .. } = named(Kind::Material, name, naming, library)?;
    let material =
        material_file::parse(&source).map_err(|problems| Refusal::of(&source, problems))?;
    Ok((material, source))
}

/// Whether a cell, tool or material is named by the path of its file.
pub(crate) fn is_path(name: &str) -> bool {
    name.ends_with(".toml") || name.starts_with('.') || name.starts_with('/') || name.contains('\\')
}

fn named(kind: Kind, name: &str, naming: &Naming<'_>, library: &Library) -> Result<Found, Refusal> {
    if is_path(name) {
        let path = path_of(name, naming)?;
        let source = files::text(&path, files::MAX_TOML).map_err(|refusal| {
            // a file that is not there is the fault of who names it
            if path.is_file() { refusal } else { not_there(kind, name, &path, naming) }
        })?;
        return Ok(Found { source, folder: Some(files::folder_of(&path)) });
    }
    library.find(kind, name)?.ok_or_else(|| unknown(kind, name, naming, library))
}

fn robot_of(name: &str, naming: &Naming<'_>, library: &Library) -> Result<RobotFiles, Refusal> {
    if name.to_lowercase().ends_with(".urdf") {
        let path = path_of(name, naming)?;
        if !path.is_file() {
            return Err(not_there(Kind::Robot, name, &path, naming));
        }
        return robot::from_path(&path);
    }
    let found = robot::from_library(library, name)?;
    found.ok_or_else(|| unknown(Kind::Robot, name, naming, library))
}

fn path_of(name: &str, naming: &Naming<'_>) -> Result<PathBuf, Refusal> {
    match naming.folder {
        Some(folder) => Ok(folder.join(name)),
        None => {
            let problem = Diagnostic::error(naming.span, "a file in the program names no paths")
                .hint("put a library of your own in front with --library");
            Err(Refusal::of(naming.source, vec![problem]))
        }
    }
}

fn not_there(kind: Kind, name: &str, path: &Path, naming: &Naming<'_>) -> Refusal {
    let word = kind.word();
    let message = format!("{word} `{}`: no file {}", crate::names::clipped(name), path.display());
    let problem = Diagnostic::error(naming.span, message)
        .hint(format!("give a path relative to this file, or the name of a {word} of the library"));
    Refusal::of(naming.source, vec![problem])
}

fn unknown(kind: Kind, name: &str, naming: &Naming<'_>, library: &Library) -> Refusal {
    let word = kind.word();
    let message = format!("the library has no {word} `{}`", crate::names::clipped(name));
    let mut problem =
        with_names(Diagnostic::error(naming.span, message), name, &library.names(kind));
    if !is_name(name) || name.contains('/') {
        let ending = if kind == Kind::Robot { ".urdf" } else { ".toml" };
        problem = problem.hint(format!("a path to a file ends in {ending}"));
    }
    Refusal::of(naming.source, vec![problem])
}

/// Place of the value of a top-level `key = …` line.
pub(crate) fn line_of(source: &Source, key: &str) -> Span {
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        let value = line.trim_start().strip_prefix(key).map(str::trim_start);
        if let Some(value) = value.and_then(|rest| rest.strip_prefix('=')) {
            let value = value.trim();
            let at = start + line.rfind(value).unwrap_or(0);
            return Span { start: at, end: at + value.len() };
        }
        start += line.len();
    }
    Span::default()
}

fn form_meshes(
    document: &Document,
    source: &Source,
    folder: &Path,
    inputs: &mut Vec<Input>,
) -> Result<Vec<Mesh>, Refusal> {
    let mut meshes = Vec::new();
    let mut problems = Vec::new();
    for form in &document.forms {
        match form_mesh(form, folder) {
            Ok((mesh, hash)) => {
                meshes.push(mesh);
                let name = folder.join(&form.mesh.value).display().to_string();
                inputs.push(Input { what: "form".to_owned(), name, sha256: hash });
            }
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Ok(meshes) } else { Err(Refusal::of(source, problems)) }
}

const MESHES: &str = "a form is a triangle mesh in mm, as .stl or .obj";

/// The mesh of a form, which lies below the job's folder also when links are followed, and the
/// hash of its bytes.
fn form_mesh(form: &Form, folder: &Path) -> Result<(Mesh, String), Diagnostic> {
    let name = &form.mesh.value;
    let refuse = |why: String| {
        let message =
            format!("mesh {} of form `{}`: {why}", crate::names::clipped(name), form.id.value);
        Diagnostic::error(form.mesh.span, message)
    };
    let below =
        |problem: Diagnostic| problem.hint("put the mesh beside the job or in a folder below");
    let inner = Path::new(name);
    if !inner.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
        return Err(below(refuse("the path leads out of the job's folder".to_owned())));
    }
    let path = folder.join(inner);
    if !path.exists() {
        return Err(refuse("there is no such file".to_owned())
            .hint(format!("paths start from the job's folder, {}", folder.display())));
    }
    let real = path.canonicalize().and_then(|real| Ok((real, folder.canonicalize()?)));
    let (real, home) = real.map_err(|error| refuse(format!("it cannot be found: {error}")))?;
    if !real.starts_with(&home) {
        return Err(below(refuse("a link leads out of the job's folder".to_owned())));
    }
    let bytes = files::bytes(&real, files::MAX_MESH).map_err(|why| refuse(why).hint(MESHES))?;
    let hash = sha256(&bytes);
    // the name as written says what it is, not the name a link leads to
    let mesh = robot::parse_mesh(inner, bytes).map_err(|why| refuse(why).hint(MESHES))?;
    Ok((mesh, hash))
}
