//! `twin check`: read a job, run the twin, say what was found.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use report::{Provenance, Report, StepTime, Timing};
use sim::film::Film;
use sim::finding::Severity;
use sim::preflight::{Preflight, Step, preflight};

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Loaded};
use crate::pictures::{self, Album};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{DEGRADED, FEASIBLE, FOUND, files};

/// Check a job before it reaches the robot
///
/// Exits with 0 if nothing stops the job, 1 if findings do, 2 if the job cannot be used, 4 if under
/// --strict something was left out that does not change the verdict.
#[derive(Debug, clap::Args)]
pub(crate) struct Check {
    /// Job to check
    #[arg(value_name = "JOB.slam")]
    job: PathBuf,
    /// Folder for report.json, strands.html, picture.png, frame.png and collapse.png
    #[arg(long, value_name = "DIR", default_value = "twin.out")]
    out: PathBuf,
    /// Draw no picture
    #[arg(long)]
    no_render: bool,
    /// Write no page of plots
    #[arg(long)]
    no_plots: bool,
    /// What to print
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    /// From which findings on to exit with 1
    #[arg(long, value_enum, default_value_t = FailOn::Error)]
    fail_on: FailOn,
    /// Exit with 4 where the picture fails or a check was left out
    #[arg(long)]
    strict: bool,
    /// Threads; all of the machine's if absent
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Draw with rays on the processor, also where there is a graphics card
    #[arg(long)]
    cpu: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Text for people
    Human,
    /// JSON for programs
    Json,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum FailOn {
    /// The nominal value is past a limit
    Error,
    /// Also where only the low or high end is
    Warning,
}

impl Check {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let mut clock = Clock::start();
        let library = Library::open(&self.library)?;
        clock.step("reading");
        let loaded = load::job(&self.job, &library, screen)?;
        let pool = self.pool()?;
        // before the work, which would be lost
        self.make_folder()?;
        let Loaded { source, job, inputs, missing_meshes } = loaded;
        let bar = bar(screen);
        let checked = on(pool.as_ref(), || {
            preflight(job, |step| {
                clock.step(step.word());
                bar.set_position(place(step));
                bar.set_message(step.word());
            })
        });
        let checked = checked.map_err(|error| {
            bar.finish_and_clear();
            Refusal::whole(&source.name, format!("the frame cannot be solved: {error}"))
        })?;
        clock.stop();

        let report_path = self.out.join("report.json");
        let mut report =
            Report::new(&checked, &source, Provenance::new(inputs, None), clock.timing());
        files::write_whole(&report_path, report::to_json(&report).as_bytes())?;
        if !self.no_plots {
            files::write_whole(&self.page(), report::strands_page(&report).as_bytes())?;
        }

        let drawn = (!self.no_render).then(|| {
            let film = Film::new(&checked);
            clock.step("drawing");
            bar.set_position(Step::ALL.len() as u64);
            bar.set_message("drawing");
            let backend = if self.cpu { render::Backend::Cpu } else { render::Backend::Auto };
            let mut studio = render::Studio::new(backend, screen.drawer.clone());
            on(pool.as_ref(), || Album::of(&checked, &film, &self.out, &mut studio))
        });
        clock.stop();
        bar.finish_and_clear();
        if let Some(drawn) = drawn.as_ref().filter(|drawn| !drawn.shots.is_empty()) {
            report.provenance.drawn_by = Some(drawn.drawn_by.clone());
            report.timing = clock.timing();
            files::write_whole(&report_path, report::to_json(&report).as_bytes())?;
        }
        self.answer(&report, &drawn, screen)?;
        let undrawn = drawn.as_ref().is_some_and(|drawn| drawn.missing.is_some());
        let degraded = undrawn || missing_meshes > 0;
        Ok(self.code(&checked, degraded))
    }

    fn answer(
        &self,
        report: &Report,
        drawn: &Option<Album>,
        screen: &mut Screen<'_>,
    ) -> Result<(), Failure> {
        if let Some(Album { missing: Some(why), .. }) = drawn {
            writeln!(screen.err, "warning: a picture was not drawn: {why}")?;
        }
        match self.format {
            Format::Json => screen.out.write_all(report::to_json(report).as_bytes())?,
            Format::Human => {
                let color = screen.out_is_terminal && screen.colour_asked;
                let text = report::human(report, color, screen.width());
                writeln!(screen.out, "{}\n", text.trim_end())?;
                writeln!(screen.out, "report   {}", self.out.join("report.json").display())?;
                if !self.no_plots {
                    writeln!(screen.out, "plots    {}", self.page().display())?;
                }
                for shot in drawn.iter().flat_map(|drawn| &drawn.shots) {
                    if let Some(path) = &shot.path {
                        writeln!(screen.out, "picture  {} ({})", path.display(), shot.words)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// What the findings say goes before what was left out.
    fn code(&self, checked: &Preflight, degraded: bool) -> u8 {
        let least = match self.fail_on {
            FailOn::Error => Severity::Error,
            FailOn::Warning => Severity::Warning,
        };
        match checked.findings().iter().any(|finding| finding.severity >= least) {
            true => FOUND,
            false if self.strict && degraded => DEGRADED,
            false => FEASIBLE,
        }
    }

    fn pool(&self) -> Result<Option<rayon::ThreadPool>, Refusal> {
        let Some(n_threads) = self.jobs else { return Ok(None) };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(n_threads)).build();
        pool.map(Some).map_err(|error| Refusal::whole("--jobs", error.to_string()))
    }

    /// Where the page of plots goes.
    fn page(&self) -> PathBuf {
        self.out.join("strands.html")
    }

    /// The folder of the answer, without pictures and page of an earlier one.
    fn make_folder(&self) -> Result<(), Refusal> {
        let name = || self.out.display().to_string();
        std::fs::create_dir_all(&self.out).map_err(|error| {
            Refusal::whole(name(), format!("the folder cannot be made: {error}"))
                .hint("name another with --out")
        })?;
        let there = std::fs::read_dir(&self.out).into_iter().flatten().flatten();
        let pictures = there
            .filter(|entry| entry.file_name().to_str().is_some_and(pictures::is_ours))
            .map(|entry| entry.path());
        for old in pictures.chain([self.page()]) {
            if let Err(error) = std::fs::remove_file(&old)
                && old.is_file()
            {
                let message =
                    format!("it is left of an earlier check and cannot be removed: {error}");
                return Err(Refusal::whole(old.display().to_string(), message));
            }
        }
        Ok(())
    }
}

/// Runs on the threads asked for.
fn on<T: Send>(pool: Option<&rayon::ThreadPool>, work: impl FnOnce() -> T + Send) -> T {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// Progress for a person who waits; nothing in pipes.
fn bar(screen: &Screen<'_>) -> ProgressBar {
    if !screen.err_is_terminal {
        return ProgressBar::hidden();
    }
    let template = "{spinner} {msg}  {bar:20} {elapsed}";
    let style = ProgressStyle::with_template(template).unwrap_or(ProgressStyle::default_bar());
    let bar = ProgressBar::new(Step::ALL.len() as u64 + 1).with_style(style);
    bar.enable_steady_tick(Duration::from_millis(120));
    bar
}

fn place(step: Step) -> u64 {
    Step::ALL.iter().position(|&known| known == step).unwrap_or(0) as u64
}

/// How long each step took.
struct Clock {
    begun: Instant,
    running: Option<(&'static str, Instant)>,
    done: Vec<StepTime>,
}

impl Clock {
    fn start() -> Self {
        Self { begun: Instant::now(), running: None, done: Vec::new() }
    }

    /// The next step begins.
    fn step(&mut self, word: &'static str) {
        self.stop();
        self.running = Some((word, Instant::now()));
    }

    fn stop(&mut self) {
        if let Some((word, since)) = self.running.take() {
            let time_s = since.elapsed().as_secs_f64();
            self.done.push(StepTime { step: word.to_owned(), time_s });
        }
    }

    fn timing(&self) -> Timing {
        Timing { steps: self.done.clone(), total_s: self.begun.elapsed().as_secs_f64() }
    }
}
