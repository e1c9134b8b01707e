//! What one key of a job says about another: references, lengths, orders.

use std::collections::{BTreeMap, BTreeSet};

use super::hints::nearest;
use super::problems::Problems;
use crate::diagnostic::quoted;
use crate::document::*;
use crate::{Diagnostic, Span};

/// Points nearer to each other than this are one point, mm.
const SAME_POINT_MM: f64 = 1e-6;
/// Shorter directions have no direction.
const ZERO_LENGTH: f64 = 1e-9;
/// Words that stand where an id may stand.
const RESERVED: [&str; 3] = ["air", "bed", "free"];

/// Checks a decoded job.
pub(super) fn check(document: &Document, problems: &mut Problems) {
    for strand in &document.strands {
        points(strand, problems);
        beside_points(strand, problems);
        times(strand, problems);
        profile(strand, problems);
        events(strand, problems);
        orientation(strand, &document.process.orientation, problems);
    }
    let ids = Ids::collect(document, problems);
    // an id that could not be read would make true references look wrong
    if !ids.contains("") {
        references(document, &ids, problems);
        allowances(document, &ids, problems);
        sequence(document, &ids, problems);
    }
}

/// All ids of a job.
struct Ids<'a> {
    forms: BTreeSet<&'a str>,
    strands: BTreeSet<&'a str>,
}

impl<'a> Ids<'a> {
    fn collect(document: &'a Document, problems: &mut Problems) -> Self {
        let mut ids = Self { forms: BTreeSet::new(), strands: BTreeSet::new() };
        let forms = document.forms.iter().map(|form| (&form.id, true));
        let strands = document.strands.iter().map(|strand| (&strand.id, false));
        for (id, is_form) in forms.chain(strands) {
            let name = id.value.as_str();
            if RESERVED.contains(&name) {
                let message =
                    format!("{} has a meaning of its own and cannot be an id", quoted(name));
                problems.add(Diagnostic::error(id.span, message).hint("choose another"));
            }
            if !name.is_empty() && ids.contains(name) {
                let message = format!("the id {} is already taken", quoted(name));
                let hint = "every form and every strand needs an id of its own";
                problems.add(Diagnostic::error(id.span, message).hint(hint));
            }
            if is_form {
                ids.forms.insert(name)
            } else {
                ids.strands.insert(name)
            };
        }
        ids
    }

    fn contains(&self, name: &str) -> bool {
        self.forms.contains(name) || self.strands.contains(name)
    }
}

fn unknown<'a>(
    span: Span,
    what: &str,
    name: &str,
    known: impl Iterator<Item = &'a str>,
) -> Diagnostic {
    let problem = Diagnostic::error(span, format!("there is no {what} {}", quoted(name)));
    match nearest(name, known) {
        Some(near) => problem.hint(format!("did you mean {}?", quoted(near))),
        None => problem.hint(format!("give the id of a {what} of this job")),
    }
}

fn references(document: &Document, ids: &Ids<'_>, problems: &mut Problems) {
    let forms = || ids.forms.iter().copied();
    for strand in &document.strands {
        if let Some(on) = &strand.on
            && let On::Form(name) = &on.value
            && !ids.forms.contains(name.as_str())
        {
            problems.add(unknown(on.span, "form", name, forms().chain(["air", "bed"])));
        }
        for join in [&strand.start.join, &strand.end.join].into_iter().flatten() {
            if let Join::Id(name) = &join.value
                && !ids.contains(name)
            {
                let known = forms().chain(ids.strands.iter().copied()).chain(["bed", "free"]);
                problems.add(unknown(join.span, "form or strand", name, known));
            }
        }
    }
    for form in &document.forms {
        let rests = |strand: &Strand| matches!(&strand.on, Some(on) if on.value == On::Form(form.id.value.clone()));
        if !document.strands.iter().any(rests) {
            problems.warning(
                form.id.span,
                format!("no strand is printed on the form {}", quoted(&form.id.value)),
            );
        }
    }
}

fn allowances(document: &Document, ids: &Ids<'_>, problems: &mut Problems) {
    for allowance in &document.allow {
        let reason = &allowance.reason;
        if !reason.value.is_empty() && reason.value.trim().is_empty() {
            let hint = "say why the finding may stand, for those who read the report";
            problems.add(Diagnostic::error(reason.span, "reason is blank").hint(hint));
        }
        if let Some(strand) = &allowance.strand
            && !ids.strands.contains(strand.value.as_str())
        {
            let known = ids.strands.iter().copied();
            problems.add(unknown(strand.span, "strand", &strand.value, known));
        }
    }
}

fn sequence(document: &Document, ids: &Ids<'_>, problems: &mut Problems) {
    let Some(steps) = &document.sequence else { return };
    let on_form: BTreeMap<&str, &str> = document
        .strands
        .iter()
        .filter_map(|strand| match &strand.on.as_ref()?.value {
            On::Form(form) => Some((strand.id.value.as_str(), form.as_str())),
            _ => None,
        })
        .collect();
    let (mut printed, mut released) = (BTreeSet::new(), BTreeSet::new());
    for step in steps {
        match &step.value {
            Step::Strand(id) if !ids.strands.contains(id.as_str()) => {
                problems.add(unknown(step.span, "strand", id, ids.strands.iter().copied()));
            }
            Step::Strand(id) => {
                if !printed.insert(id.as_str()) {
                    problems.error(step.span, format!("strand {} is printed twice", quoted(id)));
                }
                if let Some(form) =
                    on_form.get(id.as_str()).filter(|&&form| released.contains(form))
                {
                    let message = format!(
                        "strand {} rests on form {}, released before",
                        quoted(id),
                        quoted(form)
                    );
                    problems.error(step.span, message);
                }
            }
            Step::Release(id) if !ids.forms.contains(id.as_str()) => {
                problems.add(unknown(step.span, "form", id, ids.forms.iter().copied()));
            }
            Step::Release(id) => {
                if !released.insert(id.as_str()) {
                    problems.error(step.span, format!("form {} is released twice", quoted(id)));
                }
            }
            Step::Move(rows) => same_width(rows, step.span, problems),
            Step::Wait(_) | Step::Checkpoint(_) => {}
        }
    }
    for strand in
        document.strands.iter().filter(|strand| !printed.contains(strand.id.value.as_str()))
    {
        let message = format!("the sequence never prints strand {}", quoted(&strand.id.value));
        problems.add(
            Diagnostic::error(strand.id.span, message)
                .hint("add its id to \"sequence\", or remove it"),
        );
    }
}

fn points(strand: &Strand, problems: &mut Problems) {
    for (index, pair) in strand.points_mm.windows(2).enumerate() {
        if distance_mm(pair) < SAME_POINT_MM {
            let message = format!("points_mm[{}] coincides with the point before it", index + 1);
            problems.add(Diagnostic::error(pair[1].span, message).hint("leave one of them out"));
        }
    }
}

fn distance_mm(pair: &[Triple]) -> f64 {
    let square = |axis: usize| (pair[1].value[axis] - pair[0].value[axis]).powi(2);
    (square(0) + square(1) + square(2)).sqrt()
}

/// Directions, joints and times stand one per point.
fn beside_points(strand: &Strand, problems: &mut Problems) {
    let count = strand.points_mm.len();
    let mut same_length = |name: &str, length: usize, span: Span| {
        if count >= 2 && length != count {
            let message = format!("{name} has {length} entries for {count} points");
            problems.add(Diagnostic::error(span, message).hint("give one entry per point"));
        }
    };
    if let Some(directions) = &strand.directions {
        let span = directions.first().map_or(strand.span, |first| first.span);
        same_length("directions", directions.len(), span);
    }
    if let Some(joints) = &strand.joints {
        same_length("joints", joints.value.len(), joints.span);
    }
    if let Some(times) = &strand.times_s {
        same_length("times_s", times.value.len(), times.span);
    }
    for (index, direction) in strand.directions.iter().flatten().enumerate() {
        if direction.value.iter().map(|part| part * part).sum::<f64>().sqrt() < ZERO_LENGTH {
            let message = format!("directions[{index}] has no length");
            let hint = "a direction points out of the nozzle, as [0, 0, -1] does";
            problems.add(Diagnostic::error(direction.span, message).hint(hint));
        }
    }
    if let Some(joints) = &strand.joints {
        same_width(&joints.value, joints.span, problems);
    }
}

fn same_width(rows: &[Vec<f64>], span: Span, problems: &mut Problems) {
    let width = rows.first().map_or(0, Vec::len);
    if let Some((index, row)) = rows.iter().enumerate().find(|(_, row)| row.len() != width) {
        let message = format!("joints[{index}] has {} values, joints[0] has {width}", row.len());
        problems.error(span, message);
    }
}

fn times(strand: &Strand, problems: &mut Problems) {
    let Some(times) = &strand.times_s else { return };
    if let Some(index) = times.value.windows(2).position(|pair| pair[1] <= pair[0]) {
        let (before, after) = (times.value[index], times.value[index + 1]);
        let message = format!("times_s[{}] = {after} is not after {before}", index + 1);
        problems.add(Diagnostic::error(times.span, message).hint("times must rise"));
    }
}

fn length_mm(strand: &Strand) -> f64 {
    strand.points_mm.windows(2).map(distance_mm).sum()
}

fn profile(strand: &Strand, problems: &mut Problems) {
    for (index, pair) in strand.profile.windows(2).enumerate() {
        if pair[1].at_mm.value <= pair[0].at_mm.value {
            let message = format!("profile[{}] is not past the point before it", index + 1);
            problems.error(pair[1].at_mm.span, message);
        }
    }
    if strand.profile.is_empty() || strand.points_mm.len() < 2 {
        return;
    }
    let length_mm = length_mm(strand);
    for point in strand.profile.iter().filter(|point| point.at_mm.value > length_mm) {
        problems.warning(point.at_mm.span, format!("the strand is only {length_mm:.3} mm long"));
    }
}

fn events(strand: &Strand, problems: &mut Problems) {
    if strand.events.is_empty() || strand.points_mm.len() < 2 {
        return;
    }
    let length_mm = length_mm(strand);
    for event in &strand.events {
        let (value, past_mm) = match event.at.value {
            At::Mm(at) if event.from_end => (at, -at > length_mm),
            At::Mm(at) => (at, at > length_mm),
            At::S(at) => (at, false),
        };
        if !event.from_end && value < 0.0 {
            let problem = Diagnostic::error(event.at.span, "this event lies before the strand");
            problems.add(problem.hint("add \"from\": \"end\" to count back from the end"));
        } else if past_mm {
            problems.warning(event.at.span, format!("the strand is only {length_mm:.3} mm long"));
        }
    }
}

fn orientation(strand: &Strand, defaults: &Orientation, problems: &mut Problems) {
    let own = &strand.process.orientation;
    let follow = own.follow.or(defaults.follow);
    match (follow, &strand.directions) {
        (Some(follow), None) if follow.value == Follow::Given => {
            let span = own.follow.map_or(strand.id.span, |own| own.span);
            let message = format!(
                "strand {} follows given directions but has none",
                quoted(&strand.id.value)
            );
            problems
                .add(Diagnostic::error(span, message).hint("add \"directions\", one per point"));
        }
        (Some(_), Some(_)) => {
            if let Some(own) = own.follow.filter(|own| own.value != Follow::Given) {
                problems.warning(
                    own.span,
                    "this strand also has directions; one of the two is not used",
                );
            }
        }
        _ => {}
    }
}
