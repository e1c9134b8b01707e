use super::{Change, Status, parse, rewritten};
use crate::Source;

fn library(name: &str) -> Source {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../materials/");
    let text = std::fs::read_to_string(format!("{root}{name}.toml")).expect("a material");
    Source::new(name, text)
}

fn change(table: &[&'static str], numbers: &[(&'static str, f64)]) -> Change {
    Change {
        table: table.to_vec(),
        numbers: numbers.to_vec(),
        source: "twin calibrate of C:\\\"odd\"\nname".to_owned(),
    }
}

#[test]
fn numbers_are_replaced_and_nothing_else() {
    let source = library("pla");
    let changes = [
        change(&["cte_per_k"], &[("value", 6.123_456_789e-5), ("low", 6e-5), ("high", 1e-4)]),
        change(
            &["setting", "thermoplastic", "viscosity"],
            &[("d1_pa_s", 5e9), ("factor_low", 0.8), ("factor_high", 1.25)],
        ),
    ];
    let text = rewritten(&source, &changes).expect("both are there");
    let new = parse(&Source::new("new", text.clone())).expect("it reads back");
    let old = parse(&source).expect("a material");
    assert_eq!(
        (new.cte_per_k.value, new.cte_per_k.low, new.cte_per_k.high),
        (6.123_46e-5, 6e-5, 1e-4)
    );
    assert_eq!(new.cte_per_k.status, Status::Measured);
    assert_eq!(new.cte_per_k.source, "twin calibrate of C:\\\"odd\" name");
    assert_eq!((&new.density_kg_m3, &new.k_w_mk), (&old.density_kg_m3, &old.k_w_mk));
    assert!(text.contains("d1_pa_s = 5000000000.0\n") && text.contains("factor_low = 0.8\n"));
    // Eight or nine lines differ, comments and order stay.
    let differ = text.lines().zip(source.text.lines()).filter(|(new, old)| new != old).count();
    assert_eq!((text.lines().count(), differ), (source.text.lines().count(), 10));
}

#[test]
fn tables_in_one_line_and_missing_ones() {
    let source = Source::new(
        "m",
        "name = \"é\"\ncte_per_k = { value = 1, low = 0.5, high = 2, status = \"found\", source = \"é\" } # ö\n",
    );
    let changes = [change(&["cte_per_k"], &[("value", 3.0), ("low", 2.5), ("high", 1e30)])];
    let text = rewritten(&source, &changes).expect("it is there");
    assert_eq!(
        text,
        "name = \"é\"\ncte_per_k = { value = 3.0, low = 2.5, high = 1e30, status = \"measured\", source = \"twin calibrate of C:\\\\\\\"odd\\\" name\" } # ö\n"
    );
    assert_eq!(rewritten(&source, &[change(&["k_w_mk"], &[])]), None);
    assert_eq!(rewritten(&source, &[change(&["name"], &[])]), None);
    assert_eq!(rewritten(&Source::new("m", "= ="), &changes), None);
}
