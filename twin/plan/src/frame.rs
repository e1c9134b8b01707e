//! Frame files of the `assembly_instances` family (FrameFab, Choreo, pychoreo, pb-construction).
//!
//! The family's files differ in what they leave out: `node_id` and `element_id` (then the place in
//! the list counts), `fixities`, `Origin` beside `OriginX`, `OriginY`, `OriginZ`. Peers read
//! `base_frame_in_rob_base` in the file's `unit`, as the nodes, and so does this.

use std::collections::BTreeMap;

use jsonc_parser::ast::{Object, Value};
use nalgebra::{Matrix3, Rotation3, Vector3};
use slam::{Diagnostic, Source, Span};

use crate::json::{array, integer, need, number, object, parse, span, text, xyz};
use crate::{LARGEST_MM, SAME_POINT_MM};

/// How far axes may be from unit length and right angles before they are refused.
const AXES_TOLERANCE: f64 = 1e-3;

/// A frame as the file gives it, in mm.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) nodes: Vec<Node>,
    /// Nodes by the number that elements and orders call them by.
    pub(crate) node_of_id: BTreeMap<i64, usize>,
    pub(crate) elements: Vec<Element>,
    pub(crate) base_from_part: PartPose,
    /// Diameter of the round section of the file's area.
    pub(crate) diameter_mm: Option<f64>,
}

#[derive(Debug)]
pub(crate) struct Node {
    pub(crate) id: i64,
    pub(crate) point_mm: Vector3<f64>,
    pub(crate) grounded: bool,
}

#[derive(Debug)]
pub(crate) struct Element {
    /// Indices into the nodes, in the order of the file.
    pub(crate) nodes: [usize; 2],
    pub(crate) span: Span,
}

/// Part axes in the robot's base.
#[derive(Debug)]
pub(crate) struct PartPose {
    pub(crate) origin_mm: Vector3<f64>,
    pub(crate) rotation: Rotation3<f64>,
}

/// Reads a frame; `None` if anything in it is an error.
pub(crate) fn read(source: &Source, diagnostics: &mut Vec<Diagnostic>) -> Option<Frame> {
    match parse(source).and_then(|root| frame_of(&root, diagnostics)) {
        Ok(frame) if !crate::any_error(diagnostics) => Some(frame),
        Ok(_) => None,
        Err(fatal) => {
            diagnostics.push(fatal);
            None
        }
    }
}

/// What a file must have at its root is fatal; what is wrong with one node or element is listed.
pub(crate) fn frame_of(
    root: &Value,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Frame, Diagnostic> {
    let root = object(root, "a frame file")?;
    let mm = unit_mm(need(root, "unit").map_err(|d| d.hint("write \"unit\": \"millimeter\""))?)?;
    let node_values = array(need(root, "node_list")?, "`node_list`")?;
    let element_values = array(need(root, "element_list")?, "`element_list`")?;
    let base_from_part = keep(part_pose(root, mm), diagnostics);
    let diameter_mm = keep(diameter_mm(root), diagnostics).flatten();

    let mut nodes = Vec::with_capacity(node_values.len());
    let mut node_of_id = BTreeMap::new();
    for (index, value) in node_values.iter().enumerate() {
        // A node that cannot be read still takes its number, or every later one would be off.
        let node = keep(node(value, index, mm, diagnostics), diagnostics);
        let node =
            node.unwrap_or(Node { id: index as i64, point_mm: Vector3::zeros(), grounded: false });
        if node_of_id.insert(node.id, index).is_some() {
            diagnostics
                .push(Diagnostic::error(span(value), format!("node {} is there twice", node.id)));
        }
        nodes.push(node);
    }
    // Elements of broken nodes would only repeat what is said already.
    if crate::any_error(diagnostics) {
        return Err(diagnostics.pop().unwrap_or_else(|| Diagnostic::error(span(root), "no frame")));
    }
    let elements = elements(element_values, &nodes, &node_of_id, diagnostics);
    if !nodes.iter().any(|node| node.grounded) {
        diagnostics.push(
            Diagnostic::error(span(need(root, "node_list")?), "no node is grounded")
                .hint("set `is_grounded` to 1 where the frame stands on the bed"),
        );
    }
    if element_values.is_empty() {
        diagnostics
            .push(Diagnostic::error(span(need(root, "element_list")?), "no element to print"));
    }
    match base_from_part {
        Some(base_from_part) => {
            Ok(Frame { nodes, node_of_id, elements, base_from_part, diameter_mm })
        }
        None => Err(Diagnostic::error(span(root), "no place for the frame")),
    }
}

/// The value, or its diagnostic listed.
fn keep<T>(result: Result<T, Diagnostic>, diagnostics: &mut Vec<Diagnostic>) -> Option<T> {
    result.map_err(|diagnostic| diagnostics.push(diagnostic)).ok()
}

/// Length of the file's unit, mm.
fn unit_mm(value: &Value) -> Result<f64, Diagnostic> {
    match text(value, "`unit`")? {
        "millimeter" | "millimetre" | "mm" => Ok(1.0),
        "centimeter" | "centimetre" | "cm" => Ok(10.0),
        "meter" | "metre" | "m" => Ok(1000.0),
        "inch" | "in" => Ok(25.4),
        "foot" | "ft" => Ok(304.8),
        other => Err(Diagnostic::error(span(value), format!("unknown unit `{other}`"))
            .hint("millimeter, centimeter, meter, inch or foot")),
    }
}

/// A length in the file's unit, refused where no cell could hold it.
fn lengths_mm(triple: [f64; 3], mm: f64, at: Span) -> Result<Vector3<f64>, Diagnostic> {
    let lengths = Vector3::from(triple) * mm;
    if lengths.amax() <= LARGEST_MM {
        return Ok(lengths);
    }
    Err(Diagnostic::error(at, "further than a kilometre from the origin").hint("check `unit`"))
}

fn node(
    value: &Value,
    index: usize,
    mm: f64,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Node, Diagnostic> {
    let at = span(value);
    let value = object(value, "a node")?;
    let id = match value.get("node_id") {
        Some(property) => integer(&property.value, "`node_id`")?,
        None => index as i64,
    };
    let point = need(value, "point")?;
    let point_mm = lengths_mm(xyz(point, "`point`")?, mm, span(point))?;
    let grounded = flag(need(value, "is_grounded")?, "`is_grounded`")?;
    if let Some(fixities) = value.get_array("fixities").filter(|_| grounded) {
        let held = |value: &Value| flag(value, "a fixity").unwrap_or(false);
        if !fixities.elements.iter().all(held) {
            diagnostics.push(
                Diagnostic::warning(
                    at,
                    format!("node {id} is grounded but not held in all of its `fixities`"),
                )
                .hint("a bed holds all six freedoms; the job says so"),
            );
        }
    }
    Ok(Node { id, point_mm, grounded })
}

/// Yes or no, also as 0 and 1.
fn flag(value: &Value, what: &str) -> Result<bool, Diagnostic> {
    match value {
        Value::BooleanLit(literal) => Ok(literal.value),
        Value::NumberLit(literal) if literal.value == "0" => Ok(false),
        Value::NumberLit(literal) if literal.value == "1" => Ok(true),
        _ => Err(Diagnostic::error(span(value), format!("{what} must be 0 or 1"))),
    }
}

fn elements(
    values: &[Value],
    nodes: &[Node],
    node_of_id: &BTreeMap<i64, usize>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Element> {
    let mut elements = Vec::with_capacity(values.len());
    let mut first_with = BTreeMap::new();
    let mut renumbered = None;
    for (index, value) in values.iter().enumerate() {
        let read = element(value, index, nodes, node_of_id).and_then(|(element, id)| {
            let [a, b] = element.nodes;
            if let Some(first) = first_with.insert((a.min(b), a.max(b)), index) {
                let twice = format!("element {index} joins the same nodes as element {first}");
                return Err(Diagnostic::error(element.span, twice).hint("leave one of them out"));
            }
            if id.is_some_and(|id| id != index as i64) {
                renumbered.get_or_insert(element.span);
            }
            Ok(element)
        });
        elements.extend(keep(read, diagnostics));
    }
    if let Some(first) = renumbered {
        diagnostics.push(
            Diagnostic::warning(first, "`element_id` is not the element's place in the list")
                .hint("strands are named e0, e1, … by their place in the list"),
        );
    }
    elements
}

/// An element and the number the file gives it.
fn element(
    value: &Value,
    index: usize,
    nodes: &[Node],
    node_of_id: &BTreeMap<i64, usize>,
) -> Result<(Element, Option<i64>), Diagnostic> {
    let at = span(value);
    let value = object(value, "an element")?;
    let ends = need(value, "end_node_ids")?;
    let [from, to] = array(ends, "`end_node_ids`")? else {
        return Err(Diagnostic::error(span(ends), "an element has two end nodes"));
    };
    let mut indices = [0; 2];
    for (slot, end) in indices.iter_mut().zip([from, to]) {
        let id = integer(end, "a node")?;
        *slot = *node_of_id.get(&id).ok_or_else(|| {
            Diagnostic::error(
                span(end),
                format!("element {index} ends at node {id}, which is not there"),
            )
        })?;
    }
    let length_mm = (nodes[indices[0]].point_mm - nodes[indices[1]].point_mm).norm();
    if length_mm < SAME_POINT_MM {
        return Err(Diagnostic::error(at, format!("element {index} has no length"))
            .hint("its two nodes are at the same place"));
    }
    let id = value
        .get("element_id")
        .map(|property| integer(&property.value, "`element_id`"))
        .transpose()?;
    Ok((Element { nodes: indices, span: at }, id))
}

fn part_pose(root: &Object, mm: f64) -> Result<PartPose, Diagnostic> {
    let value = need(root, "base_frame_in_rob_base")
        .map_err(|d| d.hint("it says where the frame stands before the robot"))?;
    let base = object(value, "`base_frame_in_rob_base`")?;
    let origin = match base.get("Origin") {
        Some(origin) => xyz(&origin.value, "`Origin`")?,
        None => {
            let mut origin = [0.0; 3];
            for (slot, key) in origin.iter_mut().zip(["OriginX", "OriginY", "OriginZ"]) {
                *slot = number(need(base, key)?, key)?;
            }
            origin
        }
    };
    let x = Vector3::from(xyz(need(base, "XAxis")?, "`XAxis`")?);
    let y = Vector3::from(xyz(need(base, "YAxis")?, "`YAxis`")?);
    let z = match base.get("ZAxis") {
        Some(z) => Vector3::from(xyz(&z.value, "`ZAxis`")?),
        None => x.cross(&y),
    };
    let given = Matrix3::from_columns(&[x, y, z]);
    let off = (given.transpose() * given - Matrix3::identity()).amax();
    // NaN from numbers past the range must be refused too.
    if off.is_nan() || off > AXES_TOLERANCE || given.determinant() < 0.0 {
        return Err(Diagnostic::error(
            span(value),
            "axes are not right-handed, of unit length and at right angles",
        )
        .hint("X × Y must give Z"));
    }
    let x = x.normalize();
    let y = (y - x * x.dot(&y)).normalize();
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
    Ok(PartPose { origin_mm: lengths_mm(origin, mm, span(value))?, rotation })
}

/// Diameter of the circle with the file's area, `d = 2 √(A/π)`, mm; `None` if it gives no area.
fn diameter_mm(root: &Object) -> Result<Option<f64>, Diagnostic> {
    let Some(material) = root.get_object("material_properties") else { return Ok(None) };
    let Some(area) = material.get("cross_sec_area") else { return Ok(None) };
    let unit_key = "cross_sec_area_unit";
    let unit = need(material, unit_key).map_err(|d| d.hint("such as \"centimeter^2\""))?;
    let side_mm = match text(unit, "`cross_sec_area_unit`")? {
        "millimeter^2" | "mm^2" | "mm2" | "mm²" => 1.0,
        "centimeter^2" | "cm^2" | "cm2" | "cm²" => 10.0,
        "meter^2" | "m^2" | "m2" | "m²" => 1000.0,
        other => {
            return Err(Diagnostic::error(span(unit), format!("unknown unit of area `{other}`"))
                .hint("millimeter^2, centimeter^2 or meter^2"));
        }
    };
    let number = number(&area.value, "`cross_sec_area`")?;
    let diameter_mm = 2.0 * (number / std::f64::consts::PI).sqrt() * side_mm;
    if number > 0.0 && diameter_mm <= LARGEST_MM {
        // The area has about 16 digits of which the last is rounding; 3 mm should read 3.
        return Ok(Some((diameter_mm * 1e9).round() / 1e9));
    }
    Err(Diagnostic::error(span(&area.value), "`cross_sec_area` must be more than nothing"))
}
