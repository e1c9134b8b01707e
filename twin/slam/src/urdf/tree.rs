//! The robot as a whole: names, limits, and that links and joints make one tree.

use std::collections::{BTreeMap, BTreeSet};

use super::xml::Element;
use super::{JointDescription, JointKind, RobotDescription};
use crate::diagnostic::quoted;
use crate::{Diagnostic, Span};

/// Everything wrong between the parts of a robot whose parts are right.
pub(super) fn check(robot: &RobotDescription, elements: &[Element<'_>]) -> Vec<Diagnostic> {
    let places = Places { elements };
    let mut problems = Vec::new();
    if robot.links.is_empty() {
        problems.push(Diagnostic::error(places.root(), "the robot has no link"));
    }
    let mut links = BTreeSet::new();
    for (index, link) in robot.links.iter().enumerate() {
        if !links.insert(link.name.as_str()) {
            let message = format!("a second link {}", quoted(&link.name));
            problems.push(Diagnostic::error(places.of("link", index), message));
        }
    }
    let mut joints = BTreeSet::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        let place = places.of("joint", index);
        let mut error = |message: String| problems.push(Diagnostic::error(place, message));
        if !joints.insert(joint.name.as_str()) {
            error(format!("a second joint {}", quoted(&joint.name)));
        }
        for (role, link) in [("parent", &joint.parent), ("child", &joint.child)] {
            if !links.contains(link.as_str()) {
                error(format!(
                    "joint {}: there is no {role} link {}",
                    quoted(&joint.name),
                    quoted(link)
                ));
            }
        }
        limits(joint).into_iter().for_each(error);
    }
    mimics(robot, &places, &mut problems);
    if problems.is_empty() {
        problems.extend(one_tree(robot, &places));
    }
    problems
}

/// Places of links and joints by their number.
struct Places<'a> {
    elements: &'a [Element<'a>],
}

impl Places<'_> {
    fn root(&self) -> Span {
        self.elements.first().map_or(Span::default(), |root| root.span)
    }

    /// The name of the `index`-th link or joint below the root; the root's place if there is none.
    fn of(&self, tag: &str, index: usize) -> Span {
        let mut these =
            self.elements.iter().filter(|each| each.parent == Some(0) && each.name == tag);
        these.nth(index).map_or(self.root(), |element| {
            element.attribute("name").map_or(element.span, |name| name.span)
        })
    }
}

fn limits(joint: &JointDescription) -> Vec<String> {
    let name = quoted(&joint.name);
    let mut problems = Vec::new();
    if let (Some(lower), Some(upper)) = (joint.lower, joint.upper) {
        if !(lower.is_finite() && upper.is_finite()) {
            problems.push(format!("joint {name} has stops but states no lower and upper limit"));
        } else if lower > upper {
            problems
                .push(format!("joint {name}: lower limit {lower} is above upper limit {upper}"));
        }
    }
    if joint.kind != JointKind::Fixed && joint.velocity.is_none() {
        problems.push(format!("joint {name} moves but states no velocity limit above zero"));
    }
    problems
}

/// A joint may follow a joint that exists and moves by itself.
fn mimics(robot: &RobotDescription, places: &Places<'_>, problems: &mut Vec<Diagnostic>) {
    let followed: BTreeMap<_, _> =
        robot.joints.iter().map(|joint| (joint.name.as_str(), joint)).collect();
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = &joint.mimic else { continue };
        let (name, other) = (quoted(&joint.name), quoted(&mimic.joint));
        let message = match followed.get(mimic.joint.as_str()) {
            None => format!("joint {name} follows {other}, which does not exist"),
            Some(leader) if leader.kind == JointKind::Fixed => {
                format!("joint {name} follows {other}, which is fixed")
            }
            Some(leader) if leader.mimic.is_some() => {
                format!("joint {name} follows {other}, which follows another itself")
            }
            Some(_) => continue,
        };
        problems.push(Diagnostic::error(places.of("joint", index), message));
    }
}

fn one_tree(robot: &RobotDescription, places: &Places<'_>) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let mut parents: BTreeMap<&str, &str> = BTreeMap::new();
    for (index, joint) in robot.joints.iter().enumerate() {
        if parents.insert(&joint.child, &joint.parent).is_some() {
            let message = format!("link {} has two parents", quoted(&joint.child));
            problems.push(Diagnostic::error(places.of("joint", index), message));
        }
    }
    let orphans: Vec<_> = robot
        .links
        .iter()
        .enumerate()
        .filter(|(_, link)| !parents.contains_key(link.name.as_str()))
        .collect();
    for (index, link) in orphans.iter().skip(1) {
        let root = quoted(&orphans[0].1.name);
        let message = format!("two roots: {} and {root} hang on no joint", quoted(&link.name));
        problems.push(Diagnostic::error(places.of("link", *index), message));
    }
    if problems.is_empty() {
        problems.extend(unreached(
            robot,
            places,
            orphans.first().map(|(_, link)| link.name.as_str()),
        ));
    }
    problems
}

/// With one parent each and one root, a link that the root does not reach lies in a cycle.
fn unreached(
    robot: &RobotDescription,
    places: &Places<'_>,
    root: Option<&str>,
) -> Option<Diagnostic> {
    let mut children: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for joint in &robot.joints {
        children.entry(&joint.parent).or_default().push(&joint.child);
    }
    let mut reached = BTreeSet::new();
    let mut open: Vec<&str> = root.into_iter().collect();
    while let Some(link) = open.pop() {
        if reached.insert(link) {
            open.extend(children.get(link).into_iter().flatten());
        }
    }
    let (index, link) =
        robot.links.iter().enumerate().find(|(_, link)| !reached.contains(link.name.as_str()))?;
    let message = format!("link {} lies in a cycle of joints", quoted(&link.name));
    Some(Diagnostic::error(places.of("link", index), message))
}
