//! Running the program in the test's own process.

use std::path::{Path, PathBuf};

/// Root of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the workspace").to_owned()
}

/// Shared reference data, or `None` with a printed reason.
pub(crate) fn shared(what: &str) -> Option<PathBuf> {
    let folder =
        std::env::var_os("TWIN_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from);
    let path = folder.join(what);
    if path.exists() {
        return Some(path);
    }
    eprintln!("skipped: {} is not there (set TWIN_SHARED)", path.display());
    None
}

/// A folder of this test alone, emptied.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("twin-tests-{}", std::process::id())).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("the temporary folder can be written");
    folder
}

/// What a run of the program left behind.
pub(crate) struct Ran {
    /// Exit code.
    pub(crate) code: u8,
    /// Standard output.
    pub(crate) out: String,
    /// Standard error.
    pub(crate) err: String,
}

/// Runs `twin` with these arguments.
pub(crate) fn twin<I: AsRef<std::ffi::OsStr>>(args: impl IntoIterator<Item = I>) -> Ran {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let args =
        std::iter::once("twin".into()).chain(args.into_iter().map(|arg| arg.as_ref().to_owned()));
    let code = cli::run(args, &mut out, &mut err);
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Ran { code, out: text(out), err: text(err) }
}

/// Runs `twin check` without a picture; the report it wrote, if it wrote one.
pub(crate) fn check(job: &Path, folder: &Path) -> (Ran, Option<serde_json::Value>) {
    let args = [
        "check".as_ref(),
        job.as_os_str(),
        "--no-render".as_ref(),
        "--out".as_ref(),
        folder.as_os_str(),
    ];
    let ran = twin(args);
    let report = std::fs::read_to_string(folder.join("report.json")).ok();
    (ran, report.and_then(|text| serde_json::from_str(&text).ok()))
}
