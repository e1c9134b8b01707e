//! `twin validate`.

use super::{assert_refused, folder, twin, write};
use crate::{FEASIBLE, FOUND};

#[test]
fn every_case_is_told_with_both_sides_and_a_verdict() {
    let done = twin(["validate"]);
    assert_eq!(done.code, FEASIBLE, "{}{}", done.out, done.err);
    assert!(done.err.is_empty(), "{}", done.err);
    for id in
        ["PRICCI-TRENDS", "KIRKMAN-SET", "ENDPOINT-ORDER", "LAYER-XZ", "TOL-DEFAULTS", "JETS-2-10"]
    {
        assert!(
            done.out.lines().any(|line| line.starts_with(&format!("{id}  "))),
            "{id} in {}",
            done.out
        );
    }
    // three kinds of list, told apart and counted; nothing of the closed forms is outside
    assert!(done.out.contains("Seppala & Migler 2016"));
    let closed = done.out.lines().find(|line| line.starts_with("closed form")).expect("a count");
    assert!(closed.contains(" 0 outside, 0 not comparable"), "{closed}");
    // as many reasons as cases outside
    let begin =
        |word: &str| done.out.lines().filter(|line| line.trim_start().starts_with(word)).count();
    let outside = done.out.lines().filter(|line| line.contains("  OUTSIDE  ")).count();
    assert!(outside > 0 && begin("why     ") == outside, "{outside} outside in {}", done.out);
    assert!(!done.out.contains("nobody knows why") && !done.out.contains("NaN"));
    assert_eq!(twin(["validate"]).out, done.out, "the same every time");
}

#[test]
fn one_case_by_its_id() {
    let done = twin(["validate", "pricci-trends"]);
    assert_eq!(done.code, FEASIBLE);
    assert!(
        done.out.starts_with("PRICCI-TRENDS  inside") && !done.out.contains("CURA"),
        "{}",
        done.out
    );
    assert!(twin(["validate", "elastica-k4"]).out.contains("0.425"));
    assert_refused(&twin(["validate", "PRICCI"]), "ID:1:1", &["did you mean `PRICCI-TRENDS`?"]);
}

/// A library of another's materials in front is what is judged; what it explains no more is told by exit 1.
#[test]
fn a_library_in_front_is_what_is_judged() {
    let library = folder("validate");
    let materials = library.join("materials");
    std::fs::create_dir(&materials).expect("a folder");
    let file = include_str!("../../../../materials/pla.toml");
    let pla = file.replace("name = \"pla\"", "name = \"abs\"");
    assert_ne!(pla, file);
    write(&materials, "abs.toml", pla);
    let done = twin(["validate", "--library", &library.display().to_string()]);
    assert_eq!(done.code, FOUND, "{}{}", done.out, done.err);
    assert!(
        done.out.contains("ENDPOINT-ORDER  OUTSIDE") && done.out.contains("nobody knows why"),
        "{}",
        done.out
    );
}
