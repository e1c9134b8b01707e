//! `twin plan`: a design to a job.

use std::path::{Path, PathBuf};

use plan::{Bed, Input, Options, Planned, Remark};
use sim::finding::counted;
use slam::cell_file::{CellFile, Mode};
use slam::{Source, Span};

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Naming, is_path};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, REFUSED, files, targets};

/// Turn a wireframe or curves into a job
///
/// FRAME.json is a frame of the `assembly_instances` family: one strand per element, bottom-up or
/// in the given order; or a joint-space plan of pb-construction, whose joint paths become the
/// job's own. CURVES.csv has the header strand,x_mm,y_mm,z_mm[,dx,dy,dz].
#[derive(Debug, clap::Args)]
pub(crate) struct Plan {
    /// Frame (.json) or curves (.csv)
    #[arg(value_name = "FRAME.json|CURVES.csv")]
    design: PathBuf,
    /// Order of printing: [from, to] node pairs, or a file of many by name of the frame
    #[arg(long, value_name = "ORDER.json")]
    order: Option<PathBuf>,
    /// Cell of the library, or path to a cell's .toml
    #[arg(long, value_name = "CELL")]
    cell: String,
    /// Material of the library, or path to a material's .toml
    #[arg(long, value_name = "MATERIAL")]
    material: String,
    /// Where to write the job; standard output if absent
    #[arg(short, long, value_name = "JOB.slam")]
    output: Option<PathBuf>,
    /// What to call the job; the design's file name if absent
    #[arg(long)]
    name: Option<String>,
    /// Bead where the design names none, mm; the cell's if absent
    #[arg(long, value_name = "MM", value_parser = positive)]
    diameter_mm: Option<f64>,
    /// Print speed, mm/s; the cell's if absent
    #[arg(long, value_name = "MM_S", value_parser = positive)]
    speed_mm_s: Option<f64>,
    #[command(flatten)]
    library: LibraryArgs,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a number above zero is needed".to_owned()),
    }
}

impl Plan {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let read = [Some(&self.design), self.order.as_ref()].into_iter().flatten();
        targets::claim(self.output.as_deref(), read.map(PathBuf::as_path))?;
        let library = Library::open(&self.library)?;
        let cell = self.cell_and_material(&library)?;
        let options = self.options(&cell)?;
        let design = files::text(&self.design, files::MAX_TEXT)?;
        let order =
            self.order.as_ref().map(|path| files::text(path, files::MAX_TEXT)).transpose()?;
        let extension = self.design.extension().map(|ext| ext.to_string_lossy().to_lowercase());
        let planned = match (extension.as_deref(), &order) {
            (Some("csv"), None) => plan::curves(&design, &options),
            (Some("csv"), Some(order)) => {
                return Err(Refusal::whole(
                    &order.name,
                    "curves are printed in the order of their file",
                )
                .hint("leave --order out, or sort the strands of the CSV file")
                .into());
            }
            (Some("json"), None) if plan::is_peer_plan(&design) => {
                let orifice = self.orifice(&library)?;
                plan::peer_plan(&design, &options, &|q| orifice.at(q))
            }
            (Some("json"), Some(order)) if plan::is_peer_plan(&design) => {
                return Err(Refusal::whole(&order.name, "a plan comes with its own order")
                    .hint("leave --order out")
                    .into());
            }
            (Some("json"), order) => plan::wireframe(&design, order.as_ref(), &options),
            _ => {
                return Err(Refusal::whole(&design.name, "neither a .json frame nor .csv curves")
                    .hint("the file's ending says what it is")
                    .into());
            }
        };
        let Planned { document, remarks } = match planned {
            Ok(planned) => planned,
            Err(remarks) => {
                tell(&remarks, &design, order.as_ref(), screen)?;
                return Ok(REFUSED);
            }
        };
        tell(&remarks, &design, order.as_ref(), screen)?;
        let text = slam::job::print(&document);
        self.reads_back(&text)?;
        match &self.output {
            None => screen.out.write_all(text.as_bytes())?,
            Some(path) => {
                files::write_whole(path, text.as_bytes())?;
                let n_strands = document.strands.len();
                writeln!(screen.err, "{}: {}", path.display(), counted(n_strands, "strand"))?;
            }
        }
        Ok(FEASIBLE)
    }

    /// The cell, once cell, robot, tool and material are known to be readable.
    fn cell_and_material(&self, library: &Library) -> Result<CellFile, Refusal> {
        let here = Path::new(".");
        let source = |argument: &str, value: &str| Source::new(argument, value);
        let naming = |source| Naming { source, span: Span::default(), folder: Some(here) };
        let argument = source("--cell", &self.cell);
        let cell = load::cell_parts(&self.cell, &naming(&argument), library)?.cell;
        let argument = source("--material", &self.material);
        load::material(&self.material, &naming(&argument), library)?;
        Ok(cell)
    }

    fn options(&self, cell: &CellFile) -> Result<Options, Refusal> {
        let stem = self.design.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = self.name.clone().unwrap_or_else(|| stem.clone());
        if name.trim().is_empty() {
            return Err(Refusal::whole("--name", "the job needs a name"));
        }
        Ok(Options {
            name,
            cell: self.seen_from_job(&self.cell)?,
            material: self.seen_from_job(&self.material)?,
            bed: match cell.mode {
                Mode::ToolOnFlange => Bed::InRobotBase {
                    xyz_mm: cell.bed.pose.xyz_mm,
                    rpy_deg: cell.bed.pose.rpy_deg,
                },
                Mode::BedOnFlange => Bed::OnFlange,
            },
            diameter_mm: self.diameter_mm,
            speed_mm_s: self.speed_mm_s.unwrap_or(cell.extruder.speed_mm_s),
            file_stem: stem,
        })
    }

    /// Where the cell's arm puts the orifice; kept apart from the planner, which knows no kinematics.
    fn orifice(&self, library: &Library) -> Result<Orifice, Refusal> {
        let argument = Source::new("--cell", &self.cell);
        let naming =
            Naming { source: &argument, span: Span::default(), folder: Some(Path::new(".")) };
        let parts = load::cell_parts(&self.cell, &naming, library)?;
        let (material, _) = load::material(&self.material, &naming, library)?;
        let cell = load::bare_machine(&parts, &material)
            .map_err(|fault| Refusal::whole(&self.cell, format!("cannot be used: {fault}")))?;
        Ok(Orifice { cell })
    }

    /// A name as it is; a path, which the user gave from here, as seen from the job's folder.
    fn seen_from_job(&self, name: &str) -> Result<String, Refusal> {
        let Some(output) = &self.output else { return Ok(name.to_owned()) };
        if !is_path(name) || Path::new(name).is_absolute() {
            return Ok(name.to_owned());
        }
        let folder = files::folder_of(output);
        let real = |path: &Path| {
            path.canonicalize().map_err(|error| {
                Refusal::whole(path.display().to_string(), format!("cannot be found: {error}"))
            })
        };
        let (folder, target) = (real(&folder)?, real(Path::new(name))?);
        let shared =
            folder.components().zip(target.components()).take_while(|(a, b)| a == b).count();
        let up = folder.components().skip(shared).map(|_| "..".into());
        let down = target.components().skip(shared).map(|part| part.as_os_str().to_string_lossy());
        Ok(up.chain(down).collect::<Vec<_>>().join("/"))
    }

    /// What `twin check` would refuse is not written: an option may be outside the format's range.
    fn reads_back(&self, text: &str) -> Result<(), Refusal> {
        let name =
            self.output.as_ref().map_or("job.slam".to_owned(), |path| path.display().to_string());
        let source = Source::new(name, text);
        match slam::job::parse(&source) {
            Ok(_) => Ok(()),
            Err(problems) => Err(Refusal::of(&source, problems).hint(
                "the job would be refused and was not written; see the design and the options",
            )),
        }
    }
}

/// The cell whose arm a peer's plan was made for.
struct Orifice {
    cell: sim::cell::Cell,
}

impl Orifice {
    /// Place of the orifice in bed axes, mm.
    fn at(&self, q: &[f64]) -> Option<[f64; 3]> {
        let chain = &self.cell.robot.arm.chain;
        if q.len() != chain.dof() {
            return None;
        }
        Some((self.cell.bed_from_tool(q).translation.vector * 1e3).into())
    }
}

fn tell(
    remarks: &[Remark],
    design: &Source,
    order: Option<&Source>,
    screen: &mut Screen<'_>,
) -> Result<(), Failure> {
    for remark in remarks {
        let source = match remark.input {
            Input::Design => design,
            Input::Order => order.unwrap_or(design),
        };
        screen.say(source, std::slice::from_ref(&remark.diagnostic))?;
    }
    Ok(())
}
