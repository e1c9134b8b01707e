//! Loads, stages and landings of the frame as tables: the worst rows, the rest folded.

use super::album::{Album, PictureKind};
use super::film::figure;
use super::{name, sentence};
use crate::frame::{Landing, LoadCase, Stage};
use crate::parts::Report;
use crate::quantity::{Unit, counted, digits};

/// Rows told at once.
const WORST: usize = 8;
/// Rows told of each table.
const ROWS: usize = 400;

/// A column: its heading, and whether numbers stand in it.
pub(super) type Column = (&'static str, bool);

/// All tables with the pictures of the frame; empty where nothing was solved.
pub(super) fn body(report: &Report, album: &Album<'_>) -> String {
    let pictures: String = [
        (PictureKind::Frame, "The frame under its weight, bent as the picture says."),
        (PictureKind::Collapse, "How the part gives way."),
    ]
    .into_iter()
    .filter_map(|(kind, words)| Some(figure("frame-picture", album.first(&kind)?, words)))
    .collect();
    let pictures = if pictures.is_empty() {
        pictures
    } else {
        format!("<div class=\"maps\">{pictures}</div>")
    };
    [pictures, loads(&report.loads), stages(&report.stages), landings(&report.landings)].concat()
}

/// A table; the first cell of a row is its heading. Cells are HTML.
pub(super) fn table(caption: &str, columns: &[Column], rows: &[Vec<String>]) -> String {
    let class = |number: bool| if number { " class=\"n\"" } else { "" };
    let heads: String = columns
        .iter()
        .map(|(head, number)| format!("<th scope=\"col\"{}>{head}</th>", class(*number)))
        .collect();
    let cells = |row: &Vec<String>| {
        let cells = row.iter().zip(columns).enumerate().map(|(k, (cell, (_, number)))| match k {
            0 => format!("<th scope=\"row\"{}>{cell}</th>", class(*number)),
            _ => format!("<td{}>{cell}</td>", class(*number)),
        });
        format!("<tr>{}</tr>", cells.collect::<String>())
    };
    let rows: String = rows.iter().map(cells).collect();
    format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{caption}\"><table><caption>{caption}</caption>\
         <thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
    )
}

/// The worst rows as a table, all in order folded below.
fn folded<T>(
    title: &str,
    columns: &[Column],
    all: &[T],
    badness: impl Fn(&T) -> f64,
    row: impl Fn(&T) -> Vec<String>,
) -> String {
    if all.len() <= WORST + 2 {
        let rows: Vec<Vec<String>> = all.iter().map(row).collect();
        return format!("<h3>{title}</h3>{}", table(title, columns, &rows));
    }
    let mut worst: Vec<&T> = all.iter().collect();
    worst.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
    let worst: Vec<Vec<String>> = worst.into_iter().take(WORST).map(&row).collect();
    let told: Vec<Vec<String>> = all.iter().take(ROWS).map(&row).collect();
    let more = match all.len().saturating_sub(ROWS) {
        0 => String::new(),
        n => format!("<p>{} in report.json.</p>", counted(n, "more row")),
    };
    format!(
        "<h3>{title}</h3>{}<details><summary>All {} in order</summary>{}{more}</details>",
        table(&format!("{title}: the worst {WORST}"), columns, &worst),
        all.len(),
        table(&format!("{title}: all in order"), columns, &told)
    )
}

fn mm(value: Option<f64>) -> String {
    value.map_or(dash(), |value| Unit::Millimetre.show(Some(value)))
}

fn percent(value: Option<f64>) -> String {
    value.map_or(dash(), |value| Unit::Percent.show(Some(value)))
}

fn plain(value: Option<f64>, unit: &str) -> String {
    value.map_or(dash(), |value| Unit::Plain.show(Some(value)) + unit)
}

fn dash() -> String {
    "–".to_owned()
}

fn loads(loads: &[LoadCase]) -> String {
    if loads.is_empty() {
        return String::new();
    }
    let columns = [
        ("Case", false),
        ("Forces", true),
        ("Bends", true),
        ("Stiffness", true),
        ("First yield at", true),
        ("Buckles at", true),
        ("Note", false),
    ];
    let row = |load: &LoadCase| {
        vec![
            name(&load.name),
            plain(load.load_n, " N"),
            mm(load.deflection_m),
            load.stiffness_n_m
                .map_or(dash(), |stiffness| format!("{} N/mm", digits(stiffness * 1e-3))),
            plain(load.first_yield, " times"),
            plain(load.buckling_factor, " times"),
            load.fault
                .as_ref()
                .map_or(String::new(), |fault| format!("not solved: {}", sentence(fault))),
        ]
    };
    // what yields first is worst
    let badness = |load: &LoadCase| load.first_yield.map_or(f64::NEG_INFINITY, |factor| -factor);
    folded("Load cases", &columns, loads, badness, row)
}

fn stages(stages: &[Stage]) -> String {
    if stages.is_empty() {
        return String::new();
    }
    let columns = [
        ("Strands", true),
        ("Newest", false),
        ("Moves at once", true),
        ("Moves staged", true),
        ("Members used", true),
        ("Nodes used", true),
        ("Buckles at", true),
        ("Hold used", true),
    ];
    let row = |stage: &Stage| {
        let newest = match (&stage.released, &stage.strand) {
            (Some(form), _) => format!("{} taken away", name(form)),
            (None, Some(strand)) => name(strand),
            (None, None) => dash(),
        };
        vec![
            stage.printed.to_string(),
            newest,
            mm(stage.one_shot_m),
            mm(stage.staged_m),
            percent(stage.member_utilisation),
            percent(stage.node_utilisation),
            plain(stage.buckling_factor, " times"),
            percent(stage.hold),
        ]
    };
    let used = |stage: &Stage| {
        let shares = [stage.member_utilisation, stage.node_utilisation, stage.hold];
        shares.into_iter().flatten().chain(stage.staged_m).fold(0.0, f64::max)
    };
    let words = "<p class=\"soft\">The frame as it stands after so many strands. At once: gravity on all of it; staged: each strand \
                 born without stress on what stands. Used: share of strength.</p>";
    folded("Stages", &columns, stages, used, row).replacen("</h3>", &format!("</h3>{words}"), 1)
}

fn landings(landings: &[Landing]) -> String {
    if landings.is_empty() {
        return String::new();
    }
    let columns = [
        ("Strand", false),
        ("At its", false),
        ("Node", true),
        ("Misses by", true),
        ("Push of the nozzle", true),
        ("What mends it", false),
    ];
    let row = |landing: &Landing| {
        let remedies: Vec<String> = landing
            .remedies
            .iter()
            .take(3)
            .map(|remedy| format!("{} (leaves {})", sentence(&remedy.change), mm(remedy.left_m)))
            .collect();
        vec![
            name(&landing.strand),
            if landing.at_end { "end" } else { "start" }.to_owned(),
            landing.node.to_string(),
            mm(landing.sum_m),
            Unit::Millimetre.show_range(&landing.push_length_m),
            remedies.join("; "),
        ]
    };
    folded("Landings on nodes", &columns, landings, |landing| landing.sum_m.unwrap_or(0.0), row)
}
