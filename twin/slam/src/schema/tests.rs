use super::keys::{JOB, NAMED_OBJECTS};
use super::{Kind, Range, Rule, Table, job_schema};

fn check_table(table: &Table) {
    let names: Vec<_> = table.keys().map(|key| key.name).collect();
    for (index, key) in table.keys().enumerate() {
        assert!(!names[..index].contains(&key.name), "{} twice in {}", key.name, table.name);
        assert!(key.doc.ends_with('.'), "{}: {}", key.name, key.doc);
        assert_eq!(key.required, key.default.is_empty(), "{}", key.name);
        check_kind(key.kind);
    }
    if let Rule::OneOf(names) | Rule::AnyOf(names) = table.rule {
        assert!(names.iter().all(|name| table.key(name).is_some()), "{}", table.name);
    }
}

fn check_kind(kind: Kind) {
    match kind {
        Kind::Object(table) | Kind::TextOr(table) => check_table(table),
        Kind::List(item, _) => check_kind(*item),
        _ => {}
    }
}

#[test]
fn tables_are_sound() {
    check_table(&JOB);
    NAMED_OBJECTS.iter().for_each(|(_, table)| check_table(table));
}

#[test]
fn schema_is_a_schema_and_tells_units() {
    let schema = job_schema();
    assert!(jsonschema::meta::is_valid(&schema));
    assert_eq!(schema["additionalProperties"], false);
    let strand = &schema["properties"]["strands"]["items"];
    assert_eq!(strand["additionalProperties"], false);
    let speed = &strand["properties"]["speed_mm_s"];
    assert_eq!(speed["minimum"], 1e-3);
    assert_eq!(speed["description"], "Asked TCP speed. Unit: mm/s. Default: the cell's.");
}

#[test]
fn ranges_hold_their_ends() {
    let range = Range::positive(2.0);
    assert!(!range.holds(0.0) && range.holds(1e-12) && range.holds(2.0) && !range.holds(f64::NAN));
    assert!(Range::within(0.0, 1.0).holds(0.0));
}
