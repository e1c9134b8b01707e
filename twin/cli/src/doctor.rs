//! `twin doctor`: what this machine can do.

use std::path::Path;

use render::{Backend, Camera, Fit, Studio, Task, View};

use crate::FEASIBLE;
use crate::files;
use crate::library::{Kind, Library, LibraryArgs};
use crate::load::{self, Naming};
use crate::refusal::{Failure, Refusal};
use crate::robot;
use crate::screen::Screen;

/// Say what this machine can do: drawing, library, folders
///
/// Reads every file of the library and draws a small picture. Always exits with 0.
#[derive(Debug, clap::Args)]
pub(crate) struct Doctor {
    #[command(flatten)]
    library: LibraryArgs,
}

impl Doctor {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let n_threads = std::thread::available_parallelism().map_or(1, usize::from);
        writeln!(screen.out, "twin        {}", env!("CARGO_PKG_VERSION"))?;
        writeln!(
            screen.out,
            "machine     {}, {}, {n_threads} threads",
            std::env::consts::OS,
            std::env::consts::ARCH
        )?;
        drawing(screen)?;
        match Library::open(&self.library) {
            Ok(library) => library_check(&library, screen)?,
            Err(refusal) => screen.say(&refusal.source, &refusal.diagnostics)?,
        }
        let probe = Path::new(".twin-doctor");
        let writable = files::write_whole(probe, b"").is_ok();
        let _ = std::fs::remove_file(probe);
        let folder = std::env::current_dir().unwrap_or_default();
        let may = if writable {
            "can be written to"
        } else {
            "CANNOT be written to; give `twin check` an --out"
        };
        writeln!(screen.out, "folder      {} {may}", folder.display())?;
        Ok(FEASIBLE)
    }
}

fn drawing(screen: &mut Screen<'_>) -> Result<(), Failure> {
    let adapters = render::adapters();
    if adapters.is_empty() {
        writeln!(
            screen.out,
            "adapters    no Vulkan adapter: pictures are drawn by rays on the processor"
        )?;
    }
    for adapter in &adapters {
        writeln!(screen.out, "adapters    {adapter}")?;
    }
    let size_px = (render::MIN_PX, render::MIN_PX);
    let view = View { size_px, camera: Camera::Isometric, fit: Fit::Cell, ghost_arm: false };
    let task = Task::View { scene: Box::default(), view };
    match Studio::new(Backend::Auto, screen.drawer.clone()).draw(&task) {
        Ok(picture) => {
            writeln!(screen.out, "drawing     works: {}", picture.drawn_by)?;
            writeln!(screen.out, "font        embedded, works")?;
        }
        Err(error) => writeln!(screen.out, "drawing     FAILS: {error}")?,
    }
    Ok(())
}

fn library_check(library: &Library, screen: &mut Screen<'_>) -> Result<(), Failure> {
    writeln!(screen.out, "library     in the program")?;
    for folder in library.folders() {
        writeln!(screen.out, "library     in front of it: {}", folder.display())?;
    }
    let nobody = slam::Source::new("library", "");
    let naming = Naming { source: &nobody, span: slam::Span::default(), folder: None };
    for kind in Kind::ALL {
        let names = library.names(kind);
        let mut broken = 0;
        for name in &names {
            if let Err(refusal) = read(kind, name, &naming, library) {
                broken += 1;
                screen.say(&refusal.source, &refusal.diagnostics)?;
            }
        }
        let state = if broken == 0 { "all read".to_owned() } else { format!("{broken} BROKEN") };
        let kinds = format!("{}s", kind.word());
        writeln!(screen.out, "  {kinds:<10}{} ({state}): {}", names.len(), names.join(", "))?;
    }
    Ok(())
}

fn read(kind: Kind, name: &str, naming: &Naming<'_>, library: &Library) -> Result<(), Refusal> {
    match kind {
        Kind::Cell => load::cell_parts(name, naming, library).map(drop),
        Kind::Material => load::material(name, naming, library).map(drop),
        Kind::Robot => robot::from_library(library, name).map(drop),
        Kind::Tool => match library.find(kind, name)? {
            Some(found) => slam::tool_file::parse(&found.source)
                .map(drop)
                .map_err(|problems| Refusal::of(&found.source, problems)),
            None => Ok(()),
        },
    }
}
