//! Numbers worked by hand in the README of a scenario, against its report.
//!
//! A README holds a table `| quantity | by hand | pointer |`; the number is compared to the
//! digits printed.

use std::fs;

use serde_json::Value;

use crate::tools::{check, root, scratch};

/// Row 9 of the issue: the report agrees with the README to the digits printed there.
#[test]
fn readmes_worked_by_hand_agree_with_the_report() {
    let mut n_numbers = 0;
    for name in ["two-strands", "tapered-helix"] {
        let folder = root().join("scenarios").join(name);
        let readme = fs::read_to_string(folder.join("README.md")).expect("a README");
        let (ran, report) = check(&folder.join("job.slam"), &scratch(&format!("by-hand-{name}")));
        let report = report.unwrap_or_else(|| panic!("{name}: {}", ran.err));
        let mut here = 0;
        for (quantity, number, pointer) in rows(&readme) {
            let found = report.pointer(&pointer).and_then(Value::as_f64);
            let found = found.unwrap_or_else(|| panic!("{name}: nothing at {pointer}"));
            let expected: f64 =
                number.parse().unwrap_or_else(|_| panic!("{name}: `{number}` is no number"));
            let half = half_of_last_digit(&number);
            assert!(
                (found - expected).abs() <= half,
                "{name}: {quantity}: by hand {number}, report {found}"
            );
            here += 1;
        }
        assert!(here >= 4, "{name}: only {here} numbers worked by hand");
        n_numbers += here;
    }
    assert!(n_numbers >= 10, "only {n_numbers} numbers in all");
}

/// Rows of the tables whose last column is a JSON pointer in backquotes.
fn rows(readme: &str) -> Vec<(String, String, String)> {
    let cells = |line: &str| -> Vec<String> {
        line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    readme
        .lines()
        .filter(|line| line.trim_start().starts_with('|') && line.contains("`/"))
        .map(cells)
        .filter(|cells| cells.len() == 3)
        .map(|cells| (cells[0].clone(), cells[1].clone(), cells[2].trim_matches('`').to_owned()))
        .collect()
}

/// Half a unit of the last digit printed: `0.0123` gives 5e-5, `1.23e-4` gives 5e-7.
fn half_of_last_digit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once('e').unwrap_or((number, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len()) as i32;
    let exponent: i32 = exponent.parse().expect("an exponent");
    // The factor covers numbers that are rounded half up where f64 stands just below.
    0.500_001 * 10f64.powi(exponent - decimals)
}

#[test]
fn digits_are_counted() {
    assert!((half_of_last_digit("0.0123") - 5e-5).abs() < 1e-9);
    assert!((half_of_last_digit("1.23e-4") - 5e-7).abs() < 1e-11);
}
