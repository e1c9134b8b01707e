use super::{FindingWords, write_rrd};
use crate::RecordError;
use crate::test_film::checked;
use sim::film::Film;
use sim::preflight::Preflight;
use std::path::PathBuf;

/// A place of its own that is cleared away.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Scratch {
        let dir = std::env::temp_dir().join(format!("twin-record-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&dir).expect("a folder");
        Scratch(dir)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn tent() -> Preflight {
    let up = [[0.0, 0.0, 1.0], [30.0, 0.0, 41.0]];
    let down = [[60.0, 0.0, 1.0], [30.0, 0.0, 41.0]];
    checked("te\"nt/..\u{202e}", &[("up", &up), ("down", &down)])
}

/// Far out of reach.
fn far() -> Preflight {
    checked("far", &[("far", &[[9e3, 0.0, 0.0], [9e3, 10.0, 0.0]])])
}

fn words(film: &Film) -> Vec<FindingWords<'_>> {
    let each = film.findings.iter().map(|finding| FindingWords {
        code: finding.code,
        severity: finding.severity,
        message: "message with `code`, [a](b) and\nlines",
        hint: "hint",
    });
    each.collect()
}

#[test]
fn a_recording_is_whole_and_counts_what_it_holds() {
    let scratch = Scratch::new("whole");
    let path = scratch.0.join("run.rrd");
    let checked = tent();
    let film = Film::new(&checked);
    let pictures = [(1.0, vec![0x89, b'P', b'N', b'G'])];
    let told = write_rrd(&checked, &film, &words(&film), "# report", &pictures, &path);
    let told = told.expect("a recording");
    let bytes = std::fs::read(&path).expect("the file");
    assert_eq!(told.bytes, bytes.len() as u64);
    assert!(bytes.starts_with(b"RRF2"));
    assert!(bytes[bytes.len() - 40..].windows(8).any(|w| w == b"RRF2FOOT"), "the footer");
    // by length, and a strand that ends ends its piece
    assert!((100..=242).contains(&told.pieces), "{told:?}");
    assert!(told.poses > 100 && told.poses <= 200_000, "{told:?}");
    let placed = film.findings.iter().filter(|finding| finding.at.is_some()).count();
    assert_eq!(told.places + told.places_left_out, placed);
}

#[test]
fn nothing_printed_is_a_recording_all_the_same() {
    let scratch = Scratch::new("far");
    let checked = far();
    let film = Film::new(&checked);
    let told = write_rrd(&checked, &film, &words(&film), "", &[], &scratch.0.join("run.rrd"));
    assert!(told.expect("a recording").bytes > 0);
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let scratch = Scratch::new("nowhere");
    let checked = far();
    let film = Film::new(&checked);
    let path = scratch.0.join("no such folder").join("run.rrd");
    let error = write_rrd(&checked, &film, &[], "", &[], &path).expect_err("no folder");
    assert!(matches!(error, RecordError::File { .. }));
    assert!(error.to_string().contains("no such folder/run.rrd"), "{error}");
}

/// The device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let checked = far();
    let film = Film::new(&checked);
    let path = std::path::Path::new("/dev/full");
    let error = write_rrd(&checked, &film, &[], "", &[], path).expect_err("full");
    assert!(matches!(error, RecordError::CutShort { .. }), "{error}");
}
