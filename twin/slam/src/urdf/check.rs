//! Numbers, vectors and names, each at its place, before urdf-rs reads them.

use super::xml::Element;
use crate::diagnostic::quoted;
use crate::{Diagnostic, Span};

const KINDS: [&str; 4] = ["revolute", "continuous", "prismatic", "fixed"];

/// Everything in links and joints that is no usable value.
pub(super) fn values(elements: &[Element<'_>]) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    if let Some(root) = elements.first()
        && root.name != "robot"
    {
        let message = format!("the root element is {}, not \"robot\"", quoted(root.name));
        return vec![Diagnostic::error(root.span, message)];
    }
    for (index, element) in elements.iter().enumerate() {
        if element.name.starts_with("xacro:") {
            let problem = Diagnostic::error(element.span, "this is xacro, not URDF");
            return vec![problem.hint("expand it first: xacro robot.xacro > robot.urdf")];
        }
        if index > 0 && is_of_interest(elements, index) {
            attributes(element, &mut problems);
        }
    }
    problems
}

/// Whether an element lies in (or is) a link or joint that is a child of the root.
fn is_of_interest(elements: &[Element<'_>], index: usize) -> bool {
    let mut top = index;
    while let Some(parent) = elements[top].parent.filter(|&parent| parent != 0) {
        top = parent;
    }
    matches!(elements[top].name, "link" | "joint")
}

/// How many numbers the attribute of an element holds; `None`: it is none of ours.
fn number_count(element: &str, attribute: &str) -> Option<usize> {
    match (element, attribute) {
        ("origin", "xyz" | "rpy") | ("axis", "xyz") | ("box", "size") | ("mesh", "scale") => {
            Some(3)
        }
        ("origin", "quat_xyzw") | ("color", "rgba") => Some(4),
        ("mass", "value")
        | ("inertia", "ixx" | "ixy" | "ixz" | "iyy" | "iyz" | "izz")
        | ("sphere", "radius")
        | ("cylinder" | "capsule", "radius" | "length")
        | ("limit", "lower" | "upper" | "effort" | "velocity")
        | ("mimic", "multiplier" | "offset")
        | ("dynamics", "damping" | "friction") => Some(1),
        _ => None,
    }
}

fn attributes(element: &Element<'_>, problems: &mut Vec<Diagnostic>) {
    for (index, attribute) in element.attributes.iter().enumerate() {
        let name = attribute.name;
        if element.attributes[..index].iter().any(|other| other.name == name) {
            problems.push(Diagnostic::error(attribute.span, format!("{name} stands here twice")));
        }
        if let Some(count) = number_count(element.name, name) {
            match numbers(attribute.value, count) {
                Ok(values) => problems.extend(sign(element.name, name, &values, attribute.span)),
                Err(what) => {
                    let message = format!("{name} of <{}>: {what}", element.name);
                    problems.push(Diagnostic::error(attribute.span, message));
                }
            }
        }
        if (element.name, name) == ("joint", "type") && !KINDS.contains(&attribute.value) {
            let message = format!("joints of type {} are not supported", quoted(attribute.value));
            let problem = Diagnostic::error(attribute.span, message);
            problems.push(problem.hint(format!("the twin knows {}", KINDS.join(", "))));
        }
    }
    let needed = match element.name {
        "link" => "name",
        "joint" => "type",
        "parent" | "child" => "link",
        "mesh" => "filename",
        _ => return,
    };
    for name in [needed, if element.name == "joint" { "name" } else { needed }] {
        if element.attribute(name).is_none_or(|attribute| attribute.value.trim().is_empty()) {
            problems
                .push(Diagnostic::error(element.span, format!("<{}> has no {name}", element.name)));
            return;
        }
    }
}

fn numbers(text: &str, count: usize) -> Result<Vec<f64>, String> {
    let mut values = Vec::with_capacity(count);
    for word in text.split_whitespace() {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => values.push(value),
            Ok(_) => return Err(format!("{} is not finite", quoted(word))),
            Err(_) => return Err(format!("{} is not a number", quoted(word))),
        }
        if values.len() > count {
            break;
        }
    }
    match values.len() == count {
        true => Ok(values),
        false => Err(format!("needs {count} numbers, has {}", text.split_whitespace().count())),
    }
}

fn sign(element: &str, name: &str, values: &[f64], span: Span) -> Option<Diagnostic> {
    let problem =
        |what: &str| Some(Diagnostic::error(span, format!("{name} of <{element}> must {what}")));
    match (element, name) {
        ("mass", _) if values[0] < 0.0 => problem("not be negative"),
        ("box" | "sphere" | "cylinder" | "capsule", _)
            if values.iter().any(|&value| value <= 0.0) =>
        {
            problem("be positive")
        }
        ("mesh", "scale") if values.contains(&0.0) => problem("not be zero"),
        ("axis", _) if values.iter().map(|value| value * value).sum::<f64>() < 1e-18 => {
            problem("not be zero")
        }
        _ => None,
    }
}
