//! `twin calibrate`: a few measured prints to a material of one's own.

mod prints;
mod table;
mod writing;

use std::path::PathBuf;

use sim::calibration::{Fit, Known, Measured, fit};
use sim::interval::Interval;
use slam::measured_file::{self, MeasuredFile};
use slam::{Diagnostic, Source};

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Naming, line_of};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{FEASIBLE, FOUND, files, targets};

/// Fit a material to a few measured prints
///
/// MEASURED.toml names a cell and a material and lists prints with what was measured on them: free hangs
/// (swell), bridges at two speeds (viscosity and cooling as one lump, slack), cantilevers (shrinkage), cured
/// depths (working curve). Prints each number before and after with its 90 % interval, how each print
/// fits, and which print would help most. Exits with 1 where a print does not fit.
#[derive(Debug, clap::Args)]
pub(crate) struct Calibrate {
    /// Measured prints
    #[arg(value_name = "MEASURED.toml")]
    measured: PathBuf,
    /// Where to write the material, whole, with what was fitted; nowhere if absent
    #[arg(short, long, value_name = "MATERIAL.toml")]
    out: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

/// What a file of measured prints comes to.
struct Calibrated {
    /// Text of the measured prints.
    measured: Source,
    /// Text of the material before.
    material: Source,
    /// The prints.
    prints: Vec<Measured>,
    /// What they say.
    fit: Fit,
}

impl Calibrate {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        targets::claim(self.out.as_deref(), [self.measured.as_path()])?;
        let library = Library::open(&self.library)?;
        let done = self.calibrated(&library)?;
        table::print(&done, screen)?;
        if let Some(path) = &self.out {
            files::write_whole(path, writing::material(&done)?.as_bytes())?;
            writeln!(screen.out, "material  {}", path.display())?;
        }
        let fits = done.fit.arrived && done.fit.residuals.iter().all(|it| it.fits);
        Ok(if fits { FEASIBLE } else { FOUND })
    }

    fn calibrated(&self, library: &Library) -> Result<Calibrated, Refusal> {
        let measured = files::text(&self.measured, files::MAX_TOML)?;
        let file =
            measured_file::parse(&measured).map_err(|faults| Refusal::of(&measured, faults))?;
        let folder = files::folder_of(&self.measured);
        let naming = |key| Naming {
            source: &measured,
            span: line_of(&measured, key),
            folder: Some(&folder),
        };
        let parts = load::cell_parts(&file.cell, &naming("cell"), library)?;
        let (material_file, material) =
            load::material(&file.material, &naming("material"), library)?;
        let cell = load::bare_machine(&parts, &material_file).map_err(|fault| {
            let says = format!("this cell cannot be used: {fault}");
            Refusal::of(&measured, vec![Diagnostic::error(line_of(&measured, "cell"), says)])
        })?;
        let [nominal, low, high] = file.slack;
        let known = Known {
            material: sim::cell::material(&material_file),
            swell: cell.extruder.swell,
            slack: Interval::new(nominal, low, high),
        };
        check_light(&file, &known, &measured)?;
        let prints = prints::measured(&file, &cell);
        let fit = fit(&known, &prints, Some(&prints::usual(&file, &cell)));
        Ok(Calibrated { measured, material, prints, fit })
    }
}

/// A cured depth says nothing of a material that light does not set.
fn check_light(file: &MeasuredFile, known: &Known, source: &Source) -> Result<(), Refusal> {
    let is_resin = matches!(known.material.setting, sim::process::Setting::Photopolymer(_));
    if is_resin || file.cured_depth.is_empty() {
        return Ok(());
    }
    let says = format!("`{}` is no photopolymer, it has no cured depth", known.material.name);
    let problem = Diagnostic::error(line_of(source, "material"), says)
        .hint("name the resin, or leave out [[cured_depth]]");
    Err(Refusal::of(source, vec![problem]))
}
