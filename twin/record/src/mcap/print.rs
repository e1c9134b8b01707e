//! Strands as they come to lie, and the places of findings, all in the frame of the part.

use sim::pose::{Point, Pose, Vector, is_finite_point};
use sim::scene::colours::of_severity;

use super::parts;
use super::story::{STRAND_COLOUR, Story};
use super::wire::Proto;

// fields of foxglove.SceneEntity
const FACTS: u32 = 6;
const SPHERES: u32 = 9;
const LINES: u32 = 11;
const TEXTS: u32 = 13;

/// Diameter of the ball that marks a finding, m.
const BALL_M: f64 = 0.006;
/// Height of its text on the screen, pixels.
const LETTER: f64 = 14.0;

/// A piece of a strand.
pub(super) fn piece(story: &Story<'_>, ns: u64, order: usize, from: usize, to: usize) -> Proto {
    line(story, ns, &format!("strand/{order}/{from}"), order, from, to)
}

/// All that lies there at a time, a line for each strand.
pub(super) fn so_far(story: &Story<'_>, time_s: f64, ns: u64) -> Vec<Proto> {
    let strands = story.film.strands.iter().enumerate();
    let laid = strands.filter_map(|(order, strand)| {
        let (laid, _) = strand.laid(time_s);
        let last = laid.min(strand.points.len()).checked_sub(1).filter(|last| *last > 0)?;
        Some(line(story, ns, &format!("strand/{order}"), order, 0, last))
    });
    laid.collect()
}

/// A line from point to point of a strand, as thick as its bead.
fn line(story: &Story<'_>, ns: u64, id: &str, order: usize, from: usize, to: usize) -> Proto {
    let facts = story.facts(order, from, to);
    let points = story.film.strands.get(order).and_then(|strand| strand.points.get(from..=to));
    let line = Proto::default()
        .uint(1, 0)
        .message(2, parts::pose(&Pose::identity()))
        .double(3, story.bead_m(order, from, to))
        .uint(4, 0)
        .messages(
            5,
            points.unwrap_or_default().iter().filter(|p| is_finite_point(p)).map(parts::point),
        )
        .message(6, parts::colour(STRAND_COLOUR, 1.0));
    parts::entity(ns, "part", id)
        .messages(FACTS, facts.iter().map(|(key, value)| parts::pair(key, value)))
        .message(LINES, line)
}

/// A ball and a text for each finding that has a place.
pub(super) fn marks(story: &Story<'_>, ns: u64) -> Vec<Proto> {
    let findings = story.film.findings.iter().enumerate();
    let marks = findings.filter_map(|(index, place)| {
        let at = place.at.filter(is_finite_point)?;
        let facts = story.finding_facts(index);
        let entity = parts::entity(ns, "part", &format!("finding/{index}"))
            .messages(FACTS, facts.iter().map(|(key, value)| parts::pair(key, value)));
        let label = format!("{} {}", place.code, super::text::name(&place.words));
        Some(ball(entity, &at, of_severity(place.severity), &label))
    });
    marks.collect()
}

/// An entity with a ball and a text above it that faces the eye.
fn ball(entity: Proto, at: &Point, colour: u32, label: &str) -> Proto {
    let sphere = Proto::default()
        .message(1, parts::pose(&Pose::translation(at.x, at.y, at.z)))
        .message(2, parts::vector(&Vector::repeat(BALL_M)))
        .message(3, parts::colour(colour, 0.7));
    let label = Proto::default()
        .message(1, parts::pose(&Pose::translation(at.x, at.y, at.z + 1.5 * BALL_M)))
        .uint(2, 1)
        .double(3, LETTER)
        .uint(4, 1)
        .message(5, parts::colour(colour, 1.0))
        .text(6, label);
    entity.message(SPHERES, sphere).message(TEXTS, label)
}
