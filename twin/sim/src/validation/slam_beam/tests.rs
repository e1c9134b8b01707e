//! The model of the beam of stress lines, piece by piece and as a whole.

#![allow(clippy::unwrap_used)]

mod beam;
mod stress;

use super::*;

/// A file of the shared reference data, or why the test skips.
fn reference(path: &str) -> Option<serde_json::Value> {
    let shared = std::env::var_os("TWIN_SHARED").map_or_else(
        || std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        std::path::PathBuf::from,
    );
    let path = shared.join("data").join(path);
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(serde_json::from_str(&text).expect("JSON")),
        Err(_) => {
            eprintln!("skipped: {} is not there (set TWIN_SHARED)", path.display());
            None
        }
    }
}
