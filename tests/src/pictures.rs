//! Pictures against the golden ones in `renders/`.

use std::path::{Path, PathBuf};

use crate::tools::{root, scratch, twin};

/// Largest mean difference of all channels, of 255.
const MEAN_MAX: f64 = 1.0;
/// A pixel that differs by more than this is another pixel.
const OTHER: u8 = 24;
/// Largest share of other pixels.
const OTHER_SHARE_MAX: f64 = 0.005;

/// Row 10 of the issue holds the picture that was looked at.
#[test]
fn the_helix_looks_as_it_did() {
    let folder = scratch("pictures");
    let job = root().join("scenarios/tapered-helix/job.slam");
    let (job, out) = (job.display().to_string(), folder.display().to_string());
    let ran = twin(["check", &job, "--cpu", "--out", &out]);
    assert!(ran.code <= 1, "{}", ran.err);
    compare(&folder.join("picture.png"), "tapered-helix/sheet.png");
}

/// Three stages of the girder, displacements enlarged.
#[test]
fn the_frame_of_the_lattice_looks_as_it_did() {
    let folder = drawn("frame", "scenarios/lattice/job.slam");
    compare(&folder.join("frame.png"), "lattice/frame.png");
    assert!(!folder.join("collapse.png").exists(), "nothing falls");
}

/// A leaf that was printed a tenth of a millimetre too high.
#[test]
fn what_falls_looks_as_it_did() {
    let folder = drawn("collapse", "scenarios/near-miss-s402/past.slam");
    compare(&folder.join("collapse.png"), "near-miss-s402/collapse.png");
}

/// The folder of a check with its pictures.
fn drawn(name: &str, job: &str) -> PathBuf {
    let folder = scratch(name);
    let (job, out) = (root().join(job).display().to_string(), folder.display().to_string());
    let ran = twin(["check", &job, "--cpu", "--no-plots", "--out", &out]);
    assert!(ran.code <= 1, "{}", ran.err);
    folder
}

fn compare(drawn: &Path, golden_name: &str) {
    let golden = root().join("renders").join(golden_name);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::create_dir_all(golden.parent().expect("a folder"))
            .expect("renders/ can be written");
        std::fs::copy(drawn, &golden).expect("a golden picture can be written");
    }
    let open = |path: &Path| {
        image::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display())).to_rgb8()
    };
    let (new, old) = (open(drawn), open(&golden));
    assert_eq!(new.dimensions(), old.dimensions(), "{golden_name} has another size");
    let differences = || new.as_raw().iter().zip(old.as_raw()).map(|(a, b)| a.abs_diff(*b));
    let mean = differences().map(f64::from).sum::<f64>() / new.as_raw().len() as f64;
    let n_other = new
        .pixels()
        .zip(old.pixels())
        .filter(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > OTHER))
        .count();
    let other_share = n_other as f64 / f64::from(new.width() * new.height());
    if mean > MEAN_MAX || other_share > OTHER_SHARE_MAX {
        let folder = root().join("renders/out");
        std::fs::create_dir_all(&folder).expect("renders/out can be written");
        let name = golden_name.replace('/', "-");
        new.save(folder.join(&name)).expect("written");
        let difference: Vec<u8> = differences().collect();
        let difference =
            image::RgbImage::from_raw(new.width(), new.height(), difference).expect("same size");
        difference.save(folder.join(format!("{name}.diff.png"))).expect("written");
        panic!(
            "{golden_name}: mean difference {mean:.3}, other pixels {:.3} %; see renders/out",
            other_share * 100.0
        );
    }
}
