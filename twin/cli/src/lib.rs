//! The program `twin`: files, clock, terminal, exit codes.
//!
//! [`run`] is the whole program, so that tests need no process. One file per command; `library`
//! finds robots, cells, tools and materials, `load` turns a job's file into a `sim` job, `files`
//! reads within limits and writes whole files or none.

mod calibrate;
mod check;
mod diff;
mod doctor;
mod draw;
mod explain;
mod files;
mod inspect;
mod library;
mod load;
mod map;
mod names;
mod outputs;
mod page;
mod pictures;
mod plan;
mod recordings;
mod refusal;
mod render;
mod robot;
mod schema;
mod screen;
mod solve;
mod targets;
#[cfg(test)]
mod tests;
mod validate;

use std::ffi::OsString;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

use clap::Parser;
use clap::error::ErrorKind;

pub use files::remove_temporary;
use refusal::Failure;
pub use screen::{GitHub, Screen};

/// Nothing was found at or above `--fail-on`.
pub const FEASIBLE: u8 = 0;
/// Something was found at or above `--fail-on`.
pub const FOUND: u8 = 1;
/// Input that cannot be used, or a command line that cannot be understood.
pub const REFUSED: u8 = 2;
/// A bug of ours.
pub const BUG: u8 = 3;
/// Something could not be done that does not change the verdict, under `--strict`.
pub const DEGRADED: u8 = 4;

/// Offline digital twin for robotic spatial printing
///
/// Says what a planned print will do before the robot moves: reach, clearance, sag, cure, the
/// half-built frame, and the loads of the finished part.
#[derive(Debug, Parser)]
#[command(name = "twin", version, arg_required_else_help = true, propagate_version = true)]
struct Twin {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    Check(check::Check),
    Render(render::Render),
    Diff(diff::Diff),
    Plan(plan::Plan),
    Map(map::Map),
    Calibrate(calibrate::Calibrate),
    Inspect(inspect::Inspect),
    Explain(explain::Explain),
    Schema(schema::Schema),
    Solve(solve::Solve),
    Validate(validate::Validate),
    Doctor(doctor::Doctor),
    Draw(draw::Draw),
}

/// The whole program, without a terminal: `args` begin with the program's name, the answer is the
/// exit code.
pub fn run(
    args: impl IntoIterator<Item = OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    let mut screen = Screen::quiet(out, err);
    run_on(args, &mut screen)
}

/// The whole program on a given screen.
pub fn run_on(args: impl IntoIterator<Item = OsString>, screen: &mut Screen<'_>) -> u8 {
    let twin = match Twin::try_parse_from(args) {
        Ok(twin) => twin,
        Err(error) => return usage(&error, screen),
    };
    // What a command leaves half done is files, and those are written whole or not at all.
    let done = catch_unwind(AssertUnwindSafe(|| twin.command.run(screen)));
    let code = match done {
        Ok(done) => code_of(done, screen),
        Err(_) => {
            let _ = writeln!(
                screen.err,
                "error: this is a bug of twin {}, not of your job; please report it, with the message \
                 above and the files you gave",
                env!("CARGO_PKG_VERSION")
            );
            BUG
        }
    };
    match screen.out.flush() {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => REFUSED.max(code),
        _ => code,
    }
}

impl Command {
    fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        match self {
            Self::Check(command) => command.run(screen),
            Self::Render(command) => command.run(screen),
            Self::Diff(command) => command.run(screen),
            Self::Plan(command) => command.run(screen),
            Self::Map(command) => command.run(screen),
            Self::Calibrate(command) => command.run(screen),
            Self::Inspect(command) => command.run(screen),
            Self::Explain(command) => command.run(screen),
            Self::Schema(command) => command.run(screen),
            Self::Solve(command) => command.run(screen),
            Self::Validate(command) => command.run(screen),
            Self::Doctor(command) => command.run(screen),
            Self::Draw(command) => command.run(),
        }
    }
}

fn code_of(done: Result<u8, Failure>, screen: &mut Screen<'_>) -> u8 {
    match done {
        Ok(code) => code,
        Err(Failure::Refused(refusal)) => {
            // Nobody to tell is no reason for another code.
            let _ = screen.say(&refusal.source, &refusal.diagnostics);
            REFUSED
        }
        // The reader of our output has read enough (`twin … | head`).
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => FEASIBLE,
        Err(Failure::Output(error)) => {
            let _ = writeln!(screen.err, "error: the output cannot be written: {error}");
            REFUSED
        }
    }
}

/// Help and version are answers; anything else is a command line that cannot be understood.
fn usage(error: &clap::Error, screen: &mut Screen<'_>) -> u8 {
    let answer = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    let text = error.render();
    let (stream, color): (&mut dyn Write, bool) = match answer {
        true => (screen.out, screen.out_is_terminal && screen.colour_asked),
        false => (screen.err, screen.err_is_terminal && screen.colour_asked),
    };
    let _ = match color {
        true => write!(stream, "{}", text.ansi()),
        false => write!(stream, "{text}"),
    };
    if answer { FEASIBLE } else { REFUSED }
}

/// A job with everything it names from the program's own library, checked as `twin check` does: for tests that look at more
/// than files.
///
/// # Errors
/// What is wrong with the job, in sentences.
pub fn checked(job: &std::path::Path) -> Result<sim::preflight::Preflight, String> {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut screen = Screen::quiet(&mut out, &mut err);
    let told = |failure| match failure {
        Failure::Refused(refusal) => refusal.sentences(),
        Failure::Output(error) => error.to_string(),
    };
    let library = library::Library::open(&library::LibraryArgs::default())
        .map_err(|refusal| refusal.sentences())?;
    let loaded = load::job(job, &library, &mut screen).map_err(told)?;
    sim::preflight::preflight(loaded.job, |_| {}).map_err(|error| error.to_string())
}
