//! In which order, and from which end, elements are printed.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use jsonc_parser::ast::Value;
use slam::{Diagnostic, Source, Span};

use crate::frame::Frame;
use crate::json::{array, integer, object, parse, span};

/// An element, from the node where its print starts to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Directed {
    pub(crate) element: usize,
    pub(crate) from: usize,
    pub(crate) to: usize,
}

/// The order that a file gives for the frame of this file stem.
///
/// `None` with no error listed: the file holds orders of many frames, and none of this one.
pub(crate) fn given(
    source: &Source,
    file_stem: &str,
    frame: &Frame,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Vec<Directed>> {
    let pairs = parse(source).and_then(|root| {
        find(&root, file_stem)?.map(|list| Ok((pairs(list, diagnostics)?, span(list)))).transpose()
    });
    match pairs {
        Ok(Some((pairs, list))) => Some(match_elements(&pairs, list, frame, diagnostics)),
        Ok(None) => {
            let message =
                format!("no order for `{file_stem}` under `instances`; bottom-up instead");
            diagnostics.push(Diagnostic::warning(Span::default(), message));
            None
        }
        Err(fatal) => {
            diagnostics.push(fatal);
            None
        }
    }
}

/// The list of pairs: the root itself, or under `directed_elements`, or in `instances` by file stem.
fn find<'v, 'a>(root: &'v Value<'a>, file_stem: &str) -> Result<Option<&'v Value<'a>>, Diagnostic> {
    if root.as_array().is_some() {
        return Ok(Some(root));
    }
    let map = object(root, "an order file")?;
    if let Some(list) = map.get("directed_elements") {
        return Ok(Some(&list.value));
    }
    let Some(instances) = map.get("instances") else {
        return Err(Diagnostic::error(span(root), "no order in this file")
            .hint("an array of [from, to] pairs of nodes, alone or under `directed_elements`"));
    };
    let Some(instance) = object(&instances.value, "`instances`")?.get(file_stem) else {
        return Ok(None);
    };
    if instance.value.as_array().is_some() {
        return Ok(Some(&instance.value));
    }
    let instance = object(&instance.value, "an instance")?;
    crate::json::need(instance, "directed_elements").map(Some)
}

/// Pairs of node numbers; pairs that cannot be read are listed.
fn pairs(
    list: &Value,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<([i64; 2], Span)>, Diagnostic> {
    let mut pairs = Vec::new();
    for value in array(list, "an order")? {
        let pair = array(value, "an entry of the order").and_then(|ends| match ends {
            [from, to] => Ok([integer(from, "a node")?, integer(to, "a node")?]),
            _ => Err(Diagnostic::error(
                span(value),
                "an entry of the order is a pair [from, to] of nodes",
            )),
        });
        match pair {
            Ok(pair) => pairs.push((pair, span(value))),
            Err(diagnostic) => diagnostics.push(diagnostic),
        }
    }
    Ok(pairs)
}

/// Pairs to elements, each exactly once.
fn match_elements(
    pairs: &[([i64; 2], Span)],
    list: Span,
    frame: &Frame,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Directed> {
    let element_of = elements_by_nodes(frame);
    let mut order = Vec::with_capacity(pairs.len());
    let mut listed = vec![false; frame.elements.len()];
    for &([from, to], at) in pairs {
        let nodes = frame.node_of_id.get(&from).zip(frame.node_of_id.get(&to));
        let found = nodes.and_then(|(&from, &to)| {
            let element = *element_of.get(&sorted([from, to]))?;
            Some(Directed { element, from, to })
        });
        let Some(directed) = found else {
            let message = format!("no element joins nodes {from} and {to}");
            diagnostics.push(Diagnostic::error(at, message));
            continue;
        };
        if std::mem::replace(&mut listed[directed.element], true) {
            let message = format!("element {} [{from}, {to}] is listed twice", directed.element);
            diagnostics.push(Diagnostic::error(at, message));
        }
        order.push(directed);
    }
    let end_of_list = Span { start: list.end.saturating_sub(1), end: list.end };
    for (index, element) in frame.elements.iter().enumerate().filter(|(index, _)| !listed[*index]) {
        let [a, b] = element.nodes.map(|node| frame.nodes[node].id);
        let message = format!("element {index} [{a}, {b}] is missing from the order");
        diagnostics.push(Diagnostic::error(end_of_list, message));
    }
    order
}

/// The element that each pair of nodes is joined by, the smaller first.
pub(crate) fn elements_by_nodes(frame: &Frame) -> BTreeMap<[usize; 2], usize> {
    let elements = frame.elements.iter().enumerate();
    elements.map(|(index, element)| (sorted(element.nodes), index)).collect()
}

pub(crate) fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Grows the frame from the bed: always the element with the lowest middle among those that touch
/// what is printed, from the printed node to the new one, upward where both are printed.
///
/// Elements that nothing joins to the bed come last, each such piece grown from its lowest element;
/// they are listed, since they will hang in the air.
pub(crate) fn bottom_up(
    frame: &Frame,
    heights_mm: &[f64],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Directed> {
    let mut growth = Growth::new(frame, heights_mm);
    for (node, _) in frame.nodes.iter().enumerate().filter(|(_, node)| node.grounded) {
        growth.reach(node);
    }
    growth.grow();
    let mut floating: Vec<usize> =
        (0..frame.elements.len()).filter(|&e| !growth.printed[e]).collect();
    floating.sort_by(|&a, &b| growth.middle_mm(a).total_cmp(&growth.middle_mm(b)).then(a.cmp(&b)));
    if let Some(&lowest) = floating.first() {
        let message = format!(
            "{} elements, element {lowest} among them, are not joined to the bed",
            floating.len()
        );
        diagnostics.push(
            Diagnostic::warning(frame.elements[lowest].span, message)
                .hint("they come last, and start in free air"),
        );
    }
    for element in floating {
        let [a, b] = frame.elements[element].nodes;
        growth.reach(if heights_mm[b] < heights_mm[a] { b } else { a });
        growth.grow();
    }
    growth.order
}

/// A frame half grown.
struct Growth<'f> {
    frame: &'f Frame,
    heights_mm: &'f [f64],
    elements_at: Vec<Vec<usize>>,
    reached: Vec<bool>,
    printed: Vec<bool>,
    /// Elements that touch a reached node, lowest middle first; may name an element twice.
    front: BinaryHeap<Reverse<(Height, usize)>>,
    order: Vec<Directed>,
}

impl<'f> Growth<'f> {
    fn new(frame: &'f Frame, heights_mm: &'f [f64]) -> Self {
        let mut elements_at = vec![Vec::new(); frame.nodes.len()];
        for (index, element) in frame.elements.iter().enumerate() {
            element.nodes.iter().for_each(|&node| elements_at[node].push(index));
        }
        Self {
            frame,
            heights_mm,
            elements_at,
            reached: vec![false; frame.nodes.len()],
            printed: vec![false; frame.elements.len()],
            front: BinaryHeap::new(),
            order: Vec::with_capacity(frame.elements.len()),
        }
    }

    fn middle_mm(&self, element: usize) -> f64 {
        let [a, b] = self.frame.elements[element].nodes;
        (self.heights_mm[a] + self.heights_mm[b]) / 2.0
    }

    /// Makes a node one that strands can start from.
    fn reach(&mut self, node: usize) {
        if std::mem::replace(&mut self.reached[node], true) {
            return;
        }
        for at in 0..self.elements_at[node].len() {
            let element = self.elements_at[node][at];
            if !self.printed[element] {
                self.front.push(Reverse((Height(self.middle_mm(element)), element)));
            }
        }
    }

    /// Prints all that can be reached.
    fn grow(&mut self) {
        while let Some(Reverse((_, element))) = self.front.pop() {
            if std::mem::replace(&mut self.printed[element], true) {
                continue;
            }
            let [a, b] = self.frame.elements[element].nodes;
            let turn = match (self.reached[a], self.reached[b]) {
                (true, true) => self.heights_mm[b] < self.heights_mm[a],
                (from_a, _) => !from_a,
            };
            let (from, to) = if turn { (b, a) } else { (a, b) };
            self.order.push(Directed { element, from, to });
            self.reach(to);
        }
    }
}

/// A height with the total order that a heap needs.
#[derive(PartialEq)]
struct Height(f64);

impl Eq for Height {}

impl PartialOrd for Height {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Height {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
