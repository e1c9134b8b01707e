//! JSON files of joint vectors and poses, with the place of everything that is wrong.

use std::path::Path;

use jsonc_parser::ast::{Array, Object, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use sim::pose::{Pose, from_quaternion_wxyz};
use slam::{Diagnostic, Source, Span};

use crate::files;
use crate::refusal::Refusal;

/// Problems told of one file.
const MOST_PROBLEMS: usize = 20;
/// Deeper than any file of ours; the parser is recursive.
const MAX_DEPTH: usize = 16;
/// A quaternion further from length one than this is none; nearer ones were printed with few digits.
const UNIT_SLACK: f64 = 1e-3;

/// Joint vectors of `dof` numbers each.
pub(super) fn joint_vectors(
    path: &Path,
    dof: usize,
    order: &str,
) -> Result<Vec<Vec<f64>>, Refusal> {
    let source = files::text(path, files::MAX_TEXT)?;
    list(&source, "an array of joint vectors", |item| {
        let vector = numbers(item)?;
        if vector.len() == dof {
            return Ok(vector);
        }
        let message = format!("{} values; the chain has {dof} moving joints", vector.len());
        Err(Diagnostic::error(span(item), message).hint(order))
    })
}

/// Poses of the tip in the base.
pub(super) fn poses(path: &Path) -> Result<Vec<Pose>, Refusal> {
    let source = files::text(path, files::MAX_TEXT)?;
    list(&source, "an array of poses", pose)
}

/// Every item of the array that the file is, or all that is wrong with them.
fn list<T>(
    source: &Source,
    what: &str,
    read: impl Fn(&Value<'_>) -> Result<T, Diagnostic>,
) -> Result<Vec<T>, Refusal> {
    let refuse = |problem| Refusal::of(source, vec![problem]);
    shallow(&source.text).map_err(refuse)?;
    let options = ParseOptions {
        allow_comments: true,
        allow_loose_object_property_names: false,
        allow_trailing_commas: true,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    };
    let tree = parse_to_ast(&source.text, &CollectOptions::default(), &options);
    let tree = tree.map_err(|error| {
        let range = error.range();
        refuse(Diagnostic::error(
            Span { start: range.start, end: range.end },
            error.kind().to_string(),
        ))
    })?;
    let items = match &tree.value {
        Some(Value::Array(Array { elements, .. })) => elements,
        Some(other) => {
            return Err(refuse(Diagnostic::error(span(other), format!("{what} is needed"))));
        }
        None => {
            return Err(refuse(Diagnostic::error(
                Span::default(),
                format!("the file is empty; {what} is needed"),
            )));
        }
    };
    let (mut list, mut problems) = (Vec::with_capacity(items.len()), Vec::new());
    for item in items {
        match read(item) {
            Ok(value) => list.push(value),
            Err(problem) => problems.push(problem),
        }
        if problems.len() == MOST_PROBLEMS {
            break;
        }
    }
    if problems.is_empty() { Ok(list) } else { Err(Refusal::of(source, problems)) }
}

/// Refuses nesting that would be too deep for the parser.
fn shallow(text: &str) -> Result<(), Diagnostic> {
    let (mut depth, mut inside, mut escaped) = (0_usize, false, false);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if inside => escaped = true,
            b'"' => inside = !inside,
            b'[' | b'{' if !inside => depth += 1,
            b']' | b'}' if !inside => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_DEPTH {
            let here = Span { start: at, end: at + 1 };
            return Err(Diagnostic::error(here, format!("nested deeper than {MAX_DEPTH} levels")));
        }
    }
    Ok(())
}

fn span(node: &impl Ranged) -> Span {
    Span { start: node.start(), end: node.end() }
}

fn numbers(value: &Value<'_>) -> Result<Vec<f64>, Diagnostic> {
    let Value::Array(array) = value else {
        return Err(Diagnostic::error(span(value), "an array of numbers is needed"));
    };
    array.elements.iter().map(number).collect()
}

fn number(value: &Value<'_>) -> Result<f64, Diagnostic> {
    let literal = value.as_number_lit().and_then(|literal| literal.value.parse::<f64>().ok());
    match literal {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(Diagnostic::error(span(value), "this number is too large")),
        None => Err(Diagnostic::error(span(value), "a number is needed")),
    }
}

fn pose(value: &Value<'_>) -> Result<Pose, Diagnostic> {
    const KEYS: [&str; 2] = ["position_m", "quaternion_wxyz"];
    let Value::Object(object) = value else {
        return Err(Diagnostic::error(
            span(value),
            "an object with position_m and quaternion_wxyz is needed",
        ));
    };
    if let Some(other) =
        object.properties.iter().find(|property| !KEYS.contains(&property.name.as_str()))
    {
        return Err(Diagnostic::error(
            span(other),
            format!("unknown key {:?}", crate::names::clipped(other.name.as_str())),
        )
        .hint("a pose has position_m and quaternion_wxyz"));
    }
    let position_m: [f64; 3] = fixed(object, KEYS[0])?;
    let wxyz: [f64; 4] = fixed(object, KEYS[1])?;
    let length = wxyz.iter().map(|part| part * part).sum::<f64>().sqrt();
    if (length - 1.0).abs() > UNIT_SLACK {
        let message = format!("a quaternion of length {length} is no rotation");
        return Err(Diagnostic::error(span(value), message).hint("w, x, y, z with length one"));
    }
    Ok(from_quaternion_wxyz(position_m, wxyz))
}

fn fixed<const N: usize>(object: &Object<'_>, key: &str) -> Result<[f64; N], Diagnostic> {
    let property = object.properties.iter().find(|property| property.name.as_str() == key);
    let Some(property) = property else {
        return Err(Diagnostic::error(span(object), format!("`{key}` is missing here")));
    };
    let list = numbers(&property.value)?;
    let n_found = list.len();
    list.try_into().map_err(|_| {
        Diagnostic::error(span(&property.value), format!("{n_found} numbers; `{key}` has {N}"))
    })
}
