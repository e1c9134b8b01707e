//! `twin map`: which orientations a strand could have been printed in.

use std::path::PathBuf;

use sim::motion::{Across, MapState, SpinMap, spin_map};
use sim::preflight::preflight;

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Loaded};
use crate::pictures::png;
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, files, targets};

/// Width and height of the picture, px.
const PICTURE_PX: (u32, u32) = (1400, 800);

/// Draw which orientations a strand could be printed in
///
/// Path position against spin about the nozzle's axis (or tilt, or elbow angle), coloured by what
/// fails there, with the path the twin chose. Look for another way from left to right through white.
#[derive(Debug, clap::Args)]
pub(crate) struct Map {
    /// Job with the strand
    #[arg(value_name = "JOB.slam")]
    job: PathBuf,
    /// The strand by its id; the first printed if absent
    #[arg(long, value_name = "ID")]
    strand: Option<String>,
    /// What to vary
    #[arg(long, value_enum, default_value_t = Vary::Spin)]
    across: Vary,
    /// Picture to write
    #[arg(short, long, value_name = "FILE.png", default_value = "spin-map.png")]
    output: PathBuf,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Vary {
    /// Rotation about the nozzle's axis
    Spin,
    /// Lean of the nozzle in the plane of travel
    Tilt,
    /// Elbow angle of a seven-joint arm
    Elbow,
}

impl Map {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let library = Library::open(&self.library)?;
        let Loaded { source, job, inputs, .. } = load::job(&self.job, &library, screen)?;
        targets::ends_in(&self.output, &["png"])?;
        targets::claim([self.output.as_path()], load::paths(&inputs))?;
        let strand = self.strand(&job, &source.name)?;
        let id = job.strands[strand].id.clone();
        let checked =
            preflight(job, |_| {}).map_err(|error| Refusal::unsolved(&source.name, &error))?;
        let across = match self.across {
            Vary::Spin => Across::Spin,
            Vary::Tilt => Across::Tilt,
            Vary::Elbow => Across::Elbow,
        };
        let Some(map) = spin_map(&checked.map_of(), strand, across) else {
            let why = match across {
                Across::Elbow => "its arm has no elbow angle, or no posture reaches it",
                _ => "no posture reaches it",
            };
            return Err(Refusal::whole(&source.name, format!("strand `{id}` has no map: {why}"))
                .hint("`twin check` says what is out of reach; `--across spin` fits every arm")
                .into());
        };
        let title = format!("{} · strand {id}", crate::names::clipped(&checked.job().name));
        let picture = render::spin_map(&map, &title, PICTURE_PX)
            .map_err(|error| Refusal::whole(&source.name, error.to_string()))?;
        let png = png(&picture)
            .map_err(|error| Refusal::whole(&source.name, format!("no picture: {error}")))?;
        files::write_whole(&self.output, &png)?;
        writeln!(screen.out, "{}", summary(&map))?;
        writeln!(screen.out, "picture  {}", self.output.display())?;
        Ok(FEASIBLE)
    }

    fn strand(&self, job: &sim::cell::Job, name: &str) -> Result<usize, Refusal> {
        let Some(id) = &self.strand else {
            return job.print_order().next().ok_or_else(|| Refusal::whole(name, "no strand"));
        };
        job.strands.iter().position(|strand| strand.id == *id).ok_or_else(|| {
            let refusal = Refusal::whole(name, format!("no strand `{id}`"));
            let ids: Vec<&str> = job.strands.iter().take(8).map(|s| s.id.as_str()).collect();
            refusal.hint(format!("there are {}: {} …", job.strands.len(), ids.join(", ")))
        })
    }
}

fn summary(map: &SpinMap) -> String {
    let n_rows = map.angles_rad.len();
    let columns = map.at_m.len();
    let is_clear = |s: &MapState| matches!(s, MapState::Clear | MapState::NearSingular);
    let open = (0..n_rows)
        .filter(|row| map.states[row * columns..(row + 1) * columns].iter().all(is_clear))
        .count();
    let clear = map.states.iter().filter(|s| is_clear(s)).count();
    format!(
        "{:.0} % of the map is clear; {open} of {n_rows} angles are clear from end to end",
        100.0 * clear as f64 / map.states.len().max(1) as f64
    )
}
