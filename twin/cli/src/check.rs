//! `twin check`: read a job, run the twin, say what was found.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use report::{Baseline, Input, Provenance, Report, Severity, StepTime, Timing};
use sim::film::Film;
use sim::preflight::{Step, preflight};

use crate::library::{Library, LibraryArgs};
use crate::load::{self, Loaded};
use crate::outputs::{Form, Saved, clear_folder, make_folder, today};
use crate::page::Page;
use crate::pictures::Album;
use crate::recordings::{McapProfile, Recorder, Recording};
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;
use crate::{DEGRADED, FEASIBLE, FOUND, diff, files, names, targets};

/// Check a job before it reaches the robot
///
/// Exits with 0 if nothing stops the job, 1 if findings do, 2 if the job cannot be used, 3 on a bug of ours, 4 if under
/// --strict something was left out that does not change the verdict, 130 on Ctrl-C.
#[derive(Debug, clap::Args)]
pub(crate) struct Check {
    /// Job to check
    #[arg(value_name = "JOB.slam")]
    job: PathBuf,
    /// Folder for report.html, report.json, strands.html and pictures
    #[arg(long, value_name = "DIR", default_value = "twin.out")]
    out: PathBuf,
    /// Draw no picture
    #[arg(long)]
    no_render: bool,
    /// Write no pages: neither report.html nor strands.html
    #[arg(long)]
    no_pages: bool,
    /// What to print
    #[arg(long, value_enum, default_value_t = Form::Human)]
    format: Form,
    /// Also write these forms, to the folder of the answer or to a file: sarif,junit=ci/twin.xml
    #[arg(long, value_name = "FORM[=FILE]", value_delimiter = ',')]
    report: Vec<Saved>,
    /// Also record the whole job: files that end in .mcap, .rrd, .glb or .stl
    #[arg(long, value_name = "FILE", num_args = 1..)]
    record: Vec<Recording>,
    /// Which programs an MCAP file is for
    #[arg(long, value_enum, default_value_t = McapProfile::Foxglove)]
    mcap_profile: McapProfile,
    /// report.json of an earlier check: what it already found does not fail this one
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// From which findings on to exit with 1
    #[arg(long, value_enum, default_value_t = FailOn::Error)]
    fail_on: FailOn,
    /// Exit with 4 where a picture fails or a check was left out
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
enum FailOn {
    /// The nominal value is past a limit
    Error,
    /// Also where only the low or high end is
    Warning,
}

/// The files an answer went to, as they are told.
type Written = Vec<(&'static str, String)>;

impl Check {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let mut clock = Clock::start();
        let library = Library::open(&self.library)?;
        clock.step("reading");
        let loaded = load::job(&self.job, &library, screen)?;
        let baseline_of = self.baseline.as_deref().map(diff::read).transpose()?;
        let baseline = baseline_of.as_ref().map(Baseline::of);
        let pool = self.pool()?;
        let Loaded { source, job, allowances, urdf, inputs, missing_meshes } = loaded;
        if let Some(other) = baseline_of.as_ref().filter(|other| other.name != job.name) {
            let (theirs, ours) = (names::clipped(&other.name), names::clipped(&job.name));
            writeln!(
                screen.err,
                "warning: the baseline is of another job, `{theirs}`; this is `{ours}`"
            )?;
        }
        // before the work, which would be lost
        make_folder(&self.out)?;
        self.claim(&inputs)?;
        clear_folder(&self.out)?;
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
            Refusal::unsolved(&source.name, &error)
        })?;
        clock.stop();

        let film = Film::new(&checked);
        let mut report =
            Report::new(&checked, &source, Provenance::new(inputs, None), clock.timing());
        let told = report::apply_allowances(&mut report, &allowances, &today());
        // the answer is safe before anything is drawn
        let page = (!self.no_pages).then(|| Page::new(&checked, &film, &source));
        self.write(&report, page.as_ref(), None)?;

        let album = (!self.no_render).then(|| {
            clock.step("drawing");
            bar.set_position(Step::ALL.len() as u64);
            bar.set_message("drawing");
            let backend = if self.cpu { render::Backend::Cpu } else { render::Backend::Auto };
            let mut studio = render::Studio::new(backend, screen.drawer.clone());
            on(pool.as_ref(), || Album::of(&checked, &film, &self.out, &mut studio))
        });
        let recorder = Recorder {
            checked: &checked,
            film: &film,
            report: &report,
            source: &source,
            urdf: Some((&urdf.name, urdf.text.as_bytes())),
            album: album.as_ref(),
            profile: self.mcap_profile,
        };
        let recorded = self.record(&recorder, &mut clock, &bar)?;
        clock.stop();
        bar.finish_and_clear();
        if let Some(album) = album.as_ref().filter(|album| !album.shots.is_empty()) {
            report.provenance.drawn_by = Some(album.drawn_by.join("; then "));
        }
        report.timing = clock.timing();
        let mut written = self.write(&report, page.as_ref(), album.as_ref())?;
        written.extend(recorded);

        for sentence in told {
            writeln!(screen.err, "warning: {sentence}")?;
        }
        self.answer(&report, album.as_ref(), &written, screen)?;
        let undrawn = album.as_ref().is_some_and(|album| album.missing.is_some());
        Ok(self.code(&report, baseline.as_ref(), undrawn || missing_meshes > 0))
    }

    /// Every file that will be written but pictures, which have names that nobody chooses.
    fn claim(&self, inputs: &[Input]) -> Result<(), Refusal> {
        let pages: &[&str] = if self.no_pages { &[] } else { &["report.html", "strands.html"] };
        let own = pages.iter().chain(&["report.json"]).map(|name| self.out.join(name));
        let saved = self.report.iter().map(|saved| saved.path(&self.out));
        let recorded = self.record.iter().map(|recording| recording.path().to_owned());
        let all: Vec<PathBuf> = own.chain(saved).chain(recorded).collect();
        targets::claim(all.iter().map(PathBuf::as_path), load::paths(inputs))
    }

    /// Everything but pictures and recordings.
    fn write(
        &self,
        report: &Report,
        page: Option<&Page<'_>>,
        album: Option<&Album>,
    ) -> Result<Written, Refusal> {
        let mut written = Written::new();
        let json = self.out.join("report.json");
        files::write_whole(&json, report::to_json(report).as_bytes())?;
        if let Some(page) = page {
            let html = self.out.join("report.html");
            files::write_whole(&html, page.html(report, album).as_bytes())?;
            written.push(("report", html.display().to_string()));
            let strands = self.out.join("strands.html");
            files::write_whole(&strands, report::strands_page(report).as_bytes())?;
            written.push(("plots", strands.display().to_string()));
        }
        written.push(("data", json.display().to_string()));
        for saved in &self.report {
            saved.write(report, &root(), &self.out)?;
            written.push(("also", saved.path(&self.out).display().to_string()));
        }
        Ok(written)
    }

    fn record(
        &self,
        recorder: &Recorder<'_>,
        clock: &mut Clock,
        bar: &ProgressBar,
    ) -> Result<Written, Refusal> {
        let mut written = Written::new();
        for recording in &self.record {
            clock.step("recording");
            bar.set_message("recording");
            recorder.write(recording)?;
            written.push(("recorded", recording.path().display().to_string()));
        }
        Ok(written)
    }

    fn answer(
        &self,
        report: &Report,
        album: Option<&Album>,
        written: &Written,
        screen: &mut Screen<'_>,
    ) -> Result<(), Failure> {
        if let Some(why) = album.and_then(|album| album.missing.as_ref()) {
            writeln!(screen.err, "warning: a picture was not drawn: {why}")?;
        }
        if let Some(why) = album.and_then(|album| album.fell_back.as_ref()) {
            let told = "pictures were drawn by rays on the processor, which takes longer";
            writeln!(screen.err, "note: {told}: {why}")?;
        }
        let rest = self.out.join("report.html").display().to_string();
        if self.format != Form::Human {
            screen.out.write_all(self.format.text(report, &root(), &rest).as_bytes())?;
        } else {
            let color = screen.out_is_terminal && screen.colour_asked;
            let text = report::human(report, color, screen.width());
            writeln!(screen.out, "{}\n", text.trim_end())?;
            for (what, file) in written {
                writeln!(screen.out, "{what:8} {file}")?;
            }
            for shot in album.iter().flat_map(|album| &album.shots) {
                if let Some(path) = &shot.path {
                    writeln!(screen.out, "picture  {} ({})", path.display(), shot.words)?;
                }
            }
        }
        self.tell_github(report, &rest, screen)
    }

    /// Annotations and the step's summary, where GitHub's runner listens.
    fn tell_github(
        &self,
        report: &Report,
        rest: &str,
        screen: &mut Screen<'_>,
    ) -> Result<(), Failure> {
        let Some(github) = screen.github.clone() else { return Ok(()) };
        if self.format == Form::Human {
            screen.out.write_all(report::github(report, &root(), rest).as_bytes())?;
        }
        if let Some(summary) = &github.summary
            && let Err(error) =
                files::append(summary, report::step_summary(report, rest).as_bytes())
        {
            writeln!(screen.err, "warning: the step's summary was not written: {error}")?;
        }
        Ok(())
    }

    /// What the findings say goes before what was left out.
    fn code(&self, report: &Report, baseline: Option<&Baseline>, degraded: bool) -> u8 {
        let least = match self.fail_on {
            FailOn::Error => Severity::Error,
            FailOn::Warning => Severity::Warning,
        };
        match report::fails(report, least, baseline) {
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
}

/// The folder that paths in machine formats are told from.
fn root() -> String {
    std::env::current_dir().unwrap_or_default().display().to_string()
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
