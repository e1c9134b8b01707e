//! The program `twin`: [`cli::run_on`] with the terminal's streams.

use std::io::{self, IsTerminal as _, Write as _};
use std::process::ExitCode;
use std::time::Duration;

fn main() -> ExitCode {
    let (stdout, stderr) = (io::stdout(), io::stderr());
    let colour_asked = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
        && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
    // exit code of a program that Ctrl-C has ended
    let ended = ctrlc::set_handler(|| {
        cli::remove_temporary();
        std::process::exit(130);
    });
    if let Err(error) = ended {
        let _ = writeln!(io::stderr(), "warning: Ctrl-C may leave a temporary file: {error}");
    }
    let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let github = set("GITHUB_ACTIONS")
        .filter(|value| value == "true")
        .map(|_| cli::GitHub { summary: set("GITHUB_STEP_SUMMARY").map(Into::into) });
    // a driver that crashes takes only the process with it that draws
    let drawer = std::env::current_exe().ok().map(|program| render::Drawer {
        program,
        args: vec!["draw".into()],
        patience: Duration::from_secs(120),
    });
    let mut screen = cli::Screen {
        drawer,
        github,
        out_is_terminal: stdout.is_terminal(),
        err_is_terminal: stderr.is_terminal(),
        colour_asked,
        out: &mut stdout.lock(),
        // not locked: the progress bar writes there too
        err: &mut io::stderr(),
    };
    ExitCode::from(cli::run_on(std::env::args_os(), &mut screen))
}
