use crate::diagnostic::Source;
use crate::document::*;
use crate::job::{self, MAX_PROBLEMS, check, problems::Problems, syntax};
use crate::schema;

/// The example of design.md section 4.
pub(super) const EXAMPLE: &str = r#"{
  "$schema": "job.schema.json",
  "slam": 1,
  "name": "tapered-helix",
  "cell": "kirkman-sda10d", // a comment
  "material": "sla-resin-silica",
  "placement": { "xyz_mm": [0, 0, 0], "rpy_deg": [0, 0, 0] },
  "environment": { "air_c": 23, "air_m_s": 0.1 },
  "forms": [{ "id": "mould", "mesh": "mould.stl", "xyz_mm": [0, 0, 0], "rpy_deg": [0, 0, 0], "adhesion_mpa": 0.3 }],
  "process": { /* defaults */
    "speed_mm_s": 2.0, "flow": { "diameter_mm": 3.0 },
    "prime_s": 0.8, "lights_after_mm": 3.0, "overrun_mm": 1.5, "dwell_s": 2.0, "approach_mm": 15, "retract_mm": 15,
    "orientation": { "follow": "tangent", "tilt": "per-axis", "tilt_from_deg": 20, "tilt_max_deg": 40, "spin": "free" },
    "interpolation": "linear"
  },
  "strands": [
    { "id": "helix",
      "points_mm": [[20, 0, 0], [19.9, 1.9, 0.4]],
      "directions": [[0, 0, -1], [0, 0.1, -0.99]],
      "joints": [[0, -30, 0, 90, 0, 60, 0], [1, -30, 0, 90, 0, 60, 0]],
      "times_s": [0, 0.4],
      "on": "air",
      "start": { "join": "bed", "dwell_s": 1.0 },
      "end": { "join": "free" },
      "profile": [{ "at_mm": 0, "speed_mm_s": 1.5, "flow_mm3_s": 10 }],
      "events": [{ "at_mm": 1.0, "set": "light", "to": "on" }, { "from": "end", "at_s": -0.3, "set": "flow", "to": "off" }],
      "flow": { "rate_mm3_s": 14.1 }, "orientation": { "spin": 30 } },
    { "id": "b", "points_mm": [[0, 0, 0], [5, 0, 0]], "on": "mould", "flow": { "level": 3 }, "end": { "join": "helix" } },
  ],
  "sequence": [{ "move": { "joints": [[0, 0, 0, 90, 0, 60, 0]] } }, "helix", { "wait_s": 60 }, "b", { "release": "mould" }, { "checkpoint": "a" }],
  "loads": [{ "name": "test", "supports": [{ "at_mm": [0, 0, 0], "fix": "xyz" }], "forces": [{ "at_mm": [75, 0, 30], "force_n": [0, 0, -100] }] }],
  "limits": { "clearance_mm": 1.0, "node_miss_mm": 1.0, "sag_mm": 2, "deflection_mm": 5, "speed_band_percent": 5, "cycle_time_s": 600 },
  "allow": [{ "code": "C201", "strand": "b", "reason": "seen on the machine", "until": "2027-01-31" }],
}
"#;

const HEAD: &str = "{\"slam\": 1, \"name\": \"n\", \"cell\": \"c\", \"material\": \"m\",\n";

fn shown(text: &str) -> Vec<String> {
    let source = Source::new("job.slam", text);
    let problems = match job::parse(&source) {
        Ok((_, warnings)) => warnings,
        Err(problems) => problems,
    };
    problems.iter().map(|problem| source.plain(problem).to_string()).collect()
}

/// A job whose second line holds the strands and what else is given.
fn body(rest: &str) -> String {
    format!("{HEAD}{rest}}}")
}

fn strand(rest: &str) -> String {
    body(&format!(
        "\"strands\": [{{\"id\": \"a\", \"points_mm\": [[0,0,0],[1,0,0],[2,0,0]]{rest}}}]"
    ))
}

#[track_caller]
fn expect(text: &str, expected: &[&str]) {
    let found = shown(text);
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(expected.split('|').all(|part| found.contains(part)), "{found}\nlacks {expected}");
    }
}

#[test]
fn example_of_the_design_is_read() {
    let (document, warnings) = job::parse(&Source::new("job.slam", EXAMPLE)).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(document.name.value, "tapered-helix");
    let helix = &document.strands[0];
    assert_eq!(helix.points_mm[1].value, [19.9, 1.9, 0.4]);
    assert_eq!(helix.start.join.as_ref().unwrap().value, Join::Bed);
    assert_eq!(helix.events[1].at.value, At::S(-0.3));
    assert!(helix.events[1].from_end && !helix.events[1].on.value);
    assert_eq!(helix.process.flow.unwrap().value, Flow::RateMm3S(14.1));
    assert_eq!(helix.process.orientation.spin.unwrap().value, Spin::HeldDeg(30.0));
    assert_eq!(document.strands[1].process.flow.unwrap().value, Flow::Level(3));
    assert_eq!(document.strands[1].on.as_ref().unwrap().value, On::Form("mould".to_owned()));
    assert_eq!(document.sequence.as_ref().unwrap().len(), 6);
    assert_eq!(document.loads[0].supports[0].fix.value, Fix { xyz: [true; 3], rotations: false });
    let span = document.process.speed_mm_s.unwrap().span;
    assert_eq!(&EXAMPLE[span.start..span.end], "2.0");
}

#[test]
fn example_round_trips() {
    let (document, _) = job::parse(&Source::new("job.slam", EXAMPLE)).unwrap();
    let text = job::print(&document);
    let (again, _) = job::parse(&Source::new("again", text.as_str())).unwrap();
    assert_eq!(document, again);
    assert_eq!(text, job::print(&again));
    assert!(text.contains("\n        [19.9, 1.9, 0.4]\n"), "{text}");
}

#[test]
fn texts_that_are_no_job() {
    for (text, expected) in [
        ("", "1:1: error: the file is empty"),
        (" // nothing\n", "the file is empty"),
        ("[]", "1:1: |must start with {"),
        ("\u{feff}{}", "byte order mark"),
        ("{\"a\0\"", "1:4: |NUL"),
        ("{\"slam\": 1,\n \"name\": \"a\nb\"}", "2:10: |not closed on its line"),
        ("{\"slam\": 1", "1:1: |never closed"),
        ("{\"slam\": 1 \"name\": 2}", "1:11: |comma"),
        ("{'slam': 1}", "1:2: |double quotes"),
        ("{slam: 1}", "1:2: |double quotes"),
        ("{\"slam\": NaN}", "1:10: |NaN|finite"),
        ("{\"slam\": -Infinity}", "finite"),
        ("{\"slam\": True}", "lower case"),
        ("{\"slam\": 0x10}", "1:10: |exadecimal"),
        ("{\"slam\": +1}", "plus"),
        ("{\"slam\": 1} {}", "1:13: |after the end"),
        ("{} /* ", "never closed"),
        ("{\"slam\": 2, \"whatever\": 3}", "1:10: |version 2; this twin reads 1"),
    ] {
        expect(text, &[expected]);
    }
}

#[test]
fn nesting_and_size_are_limited_without_recursion() {
    expect(&"[".repeat(1_000_000), &["1:33: |nested deeper than 32"]);
    expect(&format!("//\r{}", "{\"a\":".repeat(100_000)), &["nested deeper"]);
    expect(&" ".repeat(job::MAX_BYTES + 1), &["bytes"]);
    // brackets in texts and comments do not count
    expect(
        &body(&format!("\"strands\": 1 // {}\n", "[".repeat(99))),
        &["2:12: |strands is a number"],
    );
}

#[test]
fn number_of_strands_is_limited() {
    let strands = vec!["0"; job::MAX_STRANDS + 1].join(",");
    expect(&body(&format!("\"strands\": [{strands}]")), &["200001 strands; at most 200000"]);
}

#[test]
fn keys_types_and_ranges() {
    for (rest, expected) in [
        (", \"sped_mm_s\": 1", "2:|unknown key \"sped_mm_s\"|did you mean \"speed_mm_s\""),
        (", \"speed_m_s\": 1", "did you mean \"speed_mm_s\"? The unit here is mm/s, not m/s"),
        (", \"speed_mm_min\": 1", "The unit here is mm/s, not mm/min"),
        (", \"speed\": 1", "The unit here is mm/s"),
        (", \"clearance_mm\": 1", "this key belongs in \"limits\""),
        (", \"qqqqqqqq\": 1", "a strand has the keys id, points_mm"),
        (", \"speed_mm_s\": 0", "speed_mm_s is 0; it must be from 0.001 to 10000 mm/s"),
        (", \"speed_mm_s\": 1e999", "1e999 is too large"),
        (", \"speed_mm_s\": \"2\"", "is \"2\"; it must be a number"),
        (", \"speed_mm_s\": null", "is null|leave the key out"),
        (", \"dwell_s\": -1", "from 0 to 86400 s"),
        (", \"on\": \"bed\", \"on\": \"air\"", "key \"on\" stands here twice"),
        (", \"flow\": {}", "a flow needs exactly one of the keys diameter_mm, rate_mm3_s, level"),
        (", \"flow\": {\"level\": 1, \"diameter_mm\": 2}", "exactly one"),
        (", \"flow\": {\"level\": 1.5}", "whole number"),
        (", \"flow\": {\"level\": 0}", "from 1 to 1000"),
        (", \"orientation\": {\"follow\": \"tangnet\"}", "must be one of|did you mean \"tangent\""),
        (", \"orientation\": {\"spin\": \"fre\"}", "\"free\" or a number"),
        (", \"interpolation\": \"\"", "one of linear, joint"),
        (", \"profile\": [{\"at_mm\": 0}]", "at least one of the keys speed_mm_s, flow_mm3_s"),
        (
            ", \"events\": [{\"set\": \"light\", \"to\": \"on\"}]",
            "exactly one of the keys at_mm, at_s",
        ),
        (", \"events\": [{\"at_mm\": 1, \"to\": \"on\"}]", "an event lacks the key \"set\""),
        (", \"directions\": [[0,0,1],[0,1],[0,0,1]]", "three numbers; here are 2"),
        (", \"on\": \"\"", "on is empty"),
    ] {
        expect(&strand(rest), &[expected]);
    }
    expect(&body("\"strands\": []"), &["2:12: |at least 1 item; here are 0"]);
    expect(
        &strand("").replace("\"slam\": 1,", ""),
        &["1:1: |lacks the key \"slam\"|write \"slam\": 1"],
    );
    let rest = "\"environment\": {\"air_k\": 300},\n";
    expect(
        &strand("").replacen(HEAD, &format!("{HEAD}{rest}"), 1),
        &["2:17: |\"air_c\"? The unit here is °C, not K"],
    );
    let limits = format!("{HEAD}\"limits\": {{\"sag_mm\": 0}},\n");
    expect(&strand("").replacen(HEAD, &limits, 1), &["2:22: |sag_mm is 0; it must be above 0"]);
    let loads =
        "\"loads\": [{\"name\": \"t\", \"supports\": [{\"at_mm\": [0,0,0], \"fix\": \"zx\"}]}],\n";
    expect(&strand("").replacen(HEAD, &format!("{HEAD}{loads}"), 1), &["xyzr, in this order"]);
}

#[test]
fn values_that_contradict_each_other() {
    for (rest, expected) in [
        (", \"directions\": [[0,0,1]]", "at least 2 items|"),
        (", \"directions\": [[0,0,1],[0,0,1]]", "directions has 2 entries for 3 points"),
        (", \"directions\": [[0,0,1],[0,0,0],[0,0,1]]", "directions[1] has no length"),
        (", \"joints\": [[1],[2]]", "joints has 2 entries for 3 points"),
        (", \"joints\": [[1],[2],[3, 4]]", "joints[2] has 2 values, joints[0] has 1"),
        (", \"times_s\": [0, 1]", "times_s has 2 entries for 3 points"),
        (", \"times_s\": [0, 1, 1]", "times_s[2] = 1 is not after 1"),
        (
            ", \"profile\": [{\"at_mm\": 1, \"speed_mm_s\": 1}, {\"at_mm\": 1, \"speed_mm_s\": 2}]",
            "profile[1] is not past",
        ),
        (", \"profile\": [{\"at_mm\": 3, \"speed_mm_s\": 1}]", "warning: |only 2.000 mm long"),
        (
            ", \"events\": [{\"at_mm\": -1, \"set\": \"light\", \"to\": \"on\"}]",
            "before the strand|\"from\": \"end\"",
        ),
        (
            ", \"events\": [{\"at_mm\": -3, \"from\": \"end\", \"set\": \"light\", \"to\": \"on\"}]",
            "warning: ",
        ),
        (", \"on\": \"bde\"", "there is no form \"bde\"|did you mean \"bed\""),
        (", \"end\": {\"join\": \"b\"}", "there is no form or strand \"b\"|did you mean \"a\""),
        (", \"orientation\": {\"follow\": \"given\"}", "has none|add \"directions\""),
    ] {
        let text = strand(rest);
        let found = shown(&text);
        assert!(
            found.iter().any(|one| expected.split('|').all(|part| one.contains(part))),
            "{rest}: {found:#?}"
        );
    }
    let repeated = strand("").replace("[1,0,0]", "[0,0,1e-7]");
    expect(&repeated, &["2:47: |points_mm[1] coincides"]);
    expect(&strand("").replace(",[1,0,0],[2,0,0]", ""), &["at least 2 items; here are 1"]);
}

#[test]
fn sequence_names_every_strand_once() {
    let job = |sequence: &str| {
        body(&format!(
            "\"forms\": [{{\"id\": \"f\", \"mesh\": \"f.stl\"}}],\n\"strands\": [{{\"id\": \"one\", \"on\": \"f\", \"points_mm\": [[0,0,0],[1,0,0]]}},\n\
             {{\"id\": \"two\", \"points_mm\": [[0,0,0],[1,0,0]]}}],\n\"sequence\": [{sequence}]"
        ))
    };
    expect(&job("\"one\", \"two\""), &[]);
    expect(&job("\"one\""), &["4:8: |never prints strand \"two\""]);
    expect(&job("\"one\", \"two\", \"one\""), &["5:28: |printed twice"]);
    expect(&job("\"one\", \"two\", \"twoo\""), &["5:28: |no strand \"twoo\"|did you mean \"two\""]);
    expect(
        &job("{\"release\": \"f\"}, \"one\", \"two\""),
        &["rests on form \"f\", released before"],
    );
    expect(&job("\"one\", \"two\", {\"release\": \"one\"}"), &["there is no form \"one\""]);
    expect(
        &job("\"one\", \"two\", {\"release\": \"f\"}, {\"release\": \"f\"}"),
        &["released twice"],
    );
    expect(
        &job("\"one\", \"two\", {\"move\": {\"joints\": [[1],[1,2]]}}"),
        &["joints[1] has 2 values"],
    );
    expect(&job("\"one\", \"two\"").replace("\"two\"", "\"f\""), &["4:8: |already taken"]);
    let reserved = job("\"one\", \"two\"").replace("\"two\"", "\"bed\"");
    expect(&reserved, &["4:8: |meaning of its own"]);
    let unused = job("\"one\", \"two\"").replace(" \"on\": \"f\",", "");
    expect(&unused, &["2:18: warning: |no strand is printed on the form \"f\""]);
}

#[test]
fn an_allowance_has_a_reason_and_a_day() {
    let job = |allow: &str| strand("").replacen(HEAD, &format!("{HEAD}\"allow\": [{allow}],\n"), 1);
    let whole =
        "{\"code\": \"C201\", \"strand\": \"a\", \"reason\": \"known\", \"until\": \"2027-01-31\"}";
    expect(&job(whole), &[]);
    expect(&job(&whole.replace(" \"strand\": \"a\",", "")), &[]);
    for (part, instead, expected) in [
        (", \"until\": \"2027-01-31\"", "", "2:11: |an allowance lacks the key \"until\""),
        (", \"reason\": \"known\"", "", "an allowance lacks the key \"reason\""),
        ("\"code\": \"C201\", ", "", "an allowance lacks the key \"code\""),
        ("known", "", "reason is empty"),
        ("known", " \\t", "2:53: |reason is blank|say why"),
        ("01-31", "02-29", "2:71: |until is \"2027-02-29\"|a day of the calendar, as 2027-01-31"),
        ("\"2027-01-31\"", "20270131", "until is a number|a day of the calendar"),
        ("\"a\"", "\"aa\"", "2:38: |there is no strand \"aa\"|did you mean \"a\""),
        ("reason", "reasons", "unknown key \"reasons\"|did you mean \"reason\""),
    ] {
        let found = shown(&job(&whole.replace(part, instead)));
        assert!(
            found.iter().any(|one| expected.split('|').all(|part| one.contains(part))),
            "{instead}: {found:#?}"
        );
    }
}

#[test]
fn all_problems_come_at_once_in_order_and_capped() {
    let text = strand(", \"dwell_s\": -1, \"prime_s\": -1, \"on\": \"x\"");
    expect(&text, &["dwell_s", "prime_s", "no form"]);
    let many = vec!["[0,0,0]"; MAX_PROBLEMS + 50].join(",");
    let found = shown(&body(&format!("\"strands\": [{{\"id\": \"a\", \"points_mm\": [{many}]}}]")));
    assert_eq!(found.len(), MAX_PROBLEMS + 1);
    assert!(found[MAX_PROBLEMS].contains("49 more errors are not listed"));
}

#[test]
fn names_from_the_file_cannot_write_to_the_terminal() {
    let found = shown(&strand(", \"\\u001b[2J\": 1"));
    assert!(found[0].contains("\\u{1b}[2J") && !found[0].contains('\u{1b}'), "{found:?}");
}

/// Whether the table alone finds nothing wrong.
fn fits_table(text: &str) -> bool {
    let root = syntax::tree(text).unwrap();
    let mut problems = Problems::default();
    check::table(&root, &mut problems);
    problems.finish().is_ok()
}

/// All ways to spoil one value or key of a document.
fn spoiled(value: &serde_json::Value) -> Vec<serde_json::Value> {
    use serde_json::{Value, json};
    let mut all = vec![
        json!(null),
        json!(-1e7),
        json!(0),
        json!(1.5),
        json!(""),
        json!("xr"),
        json!([]),
        json!({}),
    ];
    match value {
        Value::Object(map) => {
            for (key, inner) in map {
                let mut without = map.clone();
                without.remove(key);
                all.push(Value::Object(without.clone()));
                without.insert(format!("{key}_"), inner.clone());
                all.push(Value::Object(without));
                for other in spoiled(inner) {
                    let mut with = map.clone();
                    with.insert(key.clone(), other);
                    all.push(Value::Object(with));
                }
            }
        }
        Value::Array(list) => {
            for (index, inner) in list.iter().enumerate() {
                for other in spoiled(inner) {
                    let mut with = list.clone();
                    with[index] = other;
                    all.push(Value::Array(with));
                }
            }
            all.push(Value::Array(list.iter().skip(1).cloned().collect()));
        }
        _ => {}
    }
    all
}

#[test]
fn decoder_and_schema_agree_on_every_spoiled_example() {
    let validator = jsonschema::validator_for(&schema::job_schema()).unwrap();
    let (document, _) = job::parse(&Source::new("job.slam", EXAMPLE)).unwrap();
    let value: serde_json::Value = serde_json::from_str(&job::print(&document)).unwrap();
    assert!(
        validator.is_valid(&value),
        "{:?}",
        validator.iter_errors(&value).map(|e| e.to_string()).collect::<Vec<_>>()
    );
    let variants = spoiled(&value);
    assert!(variants.len() > 1000, "{}", variants.len());
    let mut refused = 0;
    for variant in variants.iter().filter(|variant| variant.is_object()) {
        let text = variant.to_string();
        assert_eq!(fits_table(&text), validator.is_valid(variant), "{text}");
        refused += usize::from(!fits_table(&text));
    }
    assert!(refused > 1000, "{refused}");
}
