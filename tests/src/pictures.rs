//! Pictures against the golden ones in `renders/` (see the README there).

use std::path::{Path, PathBuf};

use crate::tools::{root, scratch, twin};

/// Largest mean difference of all channels, of 255.
const MEAN_MAX: f64 = 1.0;
/// A pixel that differs by more than this is another pixel.
const OTHER: u8 = 24;
/// Largest share of other pixels.
const OTHER_SHARE_MAX: f64 = 0.005;
/// The name of who drew stands in the lower right corner and is no part of the picture: this share of width and height.
const CORNER: [f64; 2] = [0.5, 0.05];

/// Golden picture, job, and how it is asked for.
const PICTURES: [(&str, &str, &[&str]); 6] = [
    (
        "tapered-helix/sheet.png",
        "tapered-helix/job.slam",
        &["--view", "sheet", "--size", "1600x900"],
    ),
    ("lattice/frame.png", "lattice/job.slam", &["--view", "frame", "--size", "1600x1100"]),
    (
        "near-miss-s402/collapse.png",
        "near-miss-s402/past.slam",
        &["--view", "collapse", "--size", "1600x1100"],
    ),
    ("bunny-wireframe/finding.png", "bunny-wireframe/job.slam", &["--view", "finding:1"]),
    (
        "dome-on-form/half-way.png",
        "dome-on-form/job.slam",
        &["--view", "part", "--at", "50%", "--colour", "speed"],
    ),
    ("beam-150/top.png", "beam-150/job.slam", &["--view", "top", "--colour", "order"]),
];

#[test]
fn pictures_look_as_they_did() {
    let folder = scratch("pictures");
    let mut problems = Vec::new();
    for (golden, job, args) in PICTURES {
        let drawn = draw(&folder, golden, job, args);
        problems.extend(compare(&drawn, golden).err());
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// With the same driver, or the same rays, nothing moves at all.
#[test]
fn the_same_picture_has_the_same_bytes() {
    for (golden, job, args) in [PICTURES[0], PICTURES[4]] {
        for more in [&[][..], &["--cpu"]] {
            let args: Vec<&str> = args.iter().chain(more).copied().collect();
            let folder = scratch("twice");
            let one = std::fs::read(draw(&folder, golden, job, &args)).expect("a picture");
            let two = std::fs::read(draw(&folder, golden, job, &args)).expect("a picture");
            assert!(one == two, "{golden} {more:?}: {} and {} bytes", one.len(), two.len());
        }
    }
}

fn draw(folder: &Path, golden: &str, job: &str, args: &[&str]) -> PathBuf {
    let path = folder.join(golden.replace('/', "-"));
    let (job, out) = (root().join("scenarios").join(job), path.display().to_string());
    let job = job.display().to_string();
    let ran = twin(["render", &job, "-o", &out].iter().chain(args));
    assert_eq!(ran.code, 0, "{golden}: {}", ran.err);
    path
}

fn compare(drawn: &Path, golden_name: &str) -> Result<(), String> {
    let golden = root().join("renders").join(golden_name);
    let open = |path: &Path| {
        image::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display())).to_rgb8()
    };
    let asked = std::env::var("UPDATE_SNAPSHOTS").unwrap_or_default();
    let new = open(drawn);
    // "force" renews all, "1" those that fail
    let keep = |new: &image::RgbImage| {
        std::fs::create_dir_all(golden.parent().expect("a folder"))
            .expect("renders/ can be written");
        new.save(&golden).expect("a golden picture can be written");
        Ok(())
    };
    if asked == "force" || (asked == "1" && !golden.exists()) {
        return keep(&new);
    }
    let old = open(&golden);
    let told = match off(&new, &old) {
        None => return Ok(()),
        Some(_) if asked == "1" => return keep(&new),
        Some(told) => told,
    };
    let folder = root().join("renders/out");
    std::fs::create_dir_all(&folder).expect("renders/out can be written");
    let name = golden_name.replace('/', "-");
    new.save(folder.join(&name)).expect("written");
    if new.dimensions() == old.dimensions() {
        let apart: Vec<u8> =
            new.as_raw().iter().zip(old.as_raw()).map(|(a, b)| a.abs_diff(*b)).collect();
        let apart = image::RgbImage::from_raw(new.width(), new.height(), apart).expect("one size");
        apart.save(folder.join(format!("{name}.diff.png"))).expect("written");
    }
    Err(format!("{golden_name}: {told}; see renders/out, or UPDATE_SNAPSHOTS=1"))
}

/// How far two pictures are apart, where that is too far.
fn off(new: &image::RgbImage, old: &image::RgbImage) -> Option<String> {
    if new.dimensions() != old.dimensions() {
        return Some(format!("{:?} px in place of {:?}", new.dimensions(), old.dimensions()));
    }
    let (width, height) = (f64::from(new.width()), f64::from(new.height()));
    let counts = |x: u32, y: u32| {
        f64::from(x) < width * (1.0 - CORNER[0]) || f64::from(y) < height * (1.0 - CORNER[1])
    };
    let both = new.enumerate_pixels().zip(old.pixels()).filter(|((x, y, _), _)| counts(*x, *y));
    let (mut sum, mut other, mut pixels) = (0.0, 0_u32, 0_u32);
    for ((_, _, a), b) in both {
        let apart = (0..3).map(|c| a[c].abs_diff(b[c]));
        sum += apart.clone().map(f64::from).sum::<f64>();
        other += u32::from(apart.max() > Some(OTHER));
        pixels += 1;
    }
    let (mean, share) = (sum / f64::from(3 * pixels), f64::from(other) / f64::from(pixels));
    (mean > MEAN_MAX || share > OTHER_SHARE_MAX)
        .then(|| format!("mean difference {mean:.3}, other pixels {:.3} %", share * 100.0))
}

/// A picture that is another one is found, and its difference is written.
#[test]
fn another_picture_is_told_from_the_same() {
    let grey = |value| image::RgbImage::from_pixel(100, 60, image::Rgb([value; 3]));
    assert!(off(&grey(90), &grey(90)).is_none());
    assert!(off(&grey(92), &grey(90)).is_some(), "all of it a little");
    let mut spot = grey(90);
    (0..40).for_each(|x| spot.put_pixel(x, 20, image::Rgb([200, 90, 90])));
    assert!(off(&spot, &grey(90)).is_some(), "a line across");
    let mut corner = grey(90);
    (60..100).for_each(|x| corner.put_pixel(x, 58, image::Rgb([0; 3])));
    assert!(off(&corner, &grey(90)).is_none(), "who drew");
    assert!(off(&grey(90), &image::RgbImage::new(99, 60)).is_some());
}
