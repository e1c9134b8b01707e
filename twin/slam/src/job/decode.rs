//! Tree to document.
//!
//! What [`super::check`] has refused is left out here (an absent key, an empty list, an empty
//! name), so that the rest of the file can still be judged in the same run.

use jsonc_parser::ast::{Object, Value};

use super::syntax::span_of;
use crate::diagnostic::Spanned;
use crate::document::*;

/// The whole job.
pub(super) fn document(root: &Object<'_>) -> Document {
    Document {
        name: text(root, "name").unwrap_or_default(),
        cell: text(root, "cell").unwrap_or_default(),
        material: text(root, "material").unwrap_or_default(),
        placement: root.get_object("placement").map(placement).unwrap_or_default(),
        environment: root.get_object("environment").map(environment).unwrap_or_default(),
        forms: objects(root, "forms").map(form).collect(),
        process: root.get_object("process").map(process).unwrap_or_default(),
        strands: objects(root, "strands").map(strand).collect(),
        sequence: root
            .get_array("sequence")
            .map(|list| list.elements.iter().filter_map(step).collect()),
        loads: objects(root, "loads").map(load_case).collect(),
        limits: root.get_object("limits").map(limits).unwrap_or_default(),
        allow: objects(root, "allow").map(allowance).collect(),
    }
}

fn placement(object: &Object<'_>) -> Placement {
    Placement { xyz_mm: triple(object, "xyz_mm"), rpy_deg: triple(object, "rpy_deg") }
}

fn environment(object: &Object<'_>) -> Environment {
    Environment { air_c: number(object, "air_c"), air_m_s: number(object, "air_m_s") }
}

fn form(object: &Object<'_>) -> Form {
    Form {
        id: text(object, "id").unwrap_or_default(),
        mesh: text(object, "mesh").unwrap_or_default(),
        placement: placement(object),
        adhesion_mpa: number(object, "adhesion_mpa"),
    }
}

fn process(object: &Object<'_>) -> Process {
    Process {
        speed_mm_s: number(object, "speed_mm_s"),
        flow: object.get_object("flow").and_then(flow),
        prime_s: number(object, "prime_s"),
        lights_after_mm: number(object, "lights_after_mm"),
        overrun_mm: number(object, "overrun_mm"),
        dwell_s: number(object, "dwell_s"),
        second_pass_mm_s: number(object, "second_pass_mm_s"),
        post_cure_j_cm2: number(object, "post_cure_j_cm2"),
        threads: object.get_object("threads").and_then(threads),
        approach_mm: number(object, "approach_mm"),
        retract_mm: number(object, "retract_mm"),
        orientation: object.get_object("orientation").map(orientation).unwrap_or_default(),
        interpolation: word(object, "interpolation", |name| match name {
            "linear" => Some(Interpolation::Linear),
            "joint" => Some(Interpolation::Joint),
            _ => None,
        }),
    }
}

fn flow(object: &Object<'_>) -> Option<Spanned<Flow>> {
    let diameter = number(object, "diameter_mm").map(|number| Flow::DiameterMm(number.value));
    let rate = number(object, "rate_mm3_s").map(|number| Flow::RateMm3S(number.value));
    let level = number(object, "level").map(|number| Flow::Level(number.value as u32));
    Some(Spanned::new(diameter.or(rate).or(level)?, span_of(object)))
}

fn threads(object: &Object<'_>) -> Option<Threads> {
    Some(Threads {
        count: number(object, "count")?.value as u32,
        diameter_mm: number(object, "diameter_mm")?.value,
        pitch_mm: number(object, "pitch_mm")?.value,
        sweep_mm: number(object, "sweep_mm")?.value,
    })
}

fn orientation(object: &Object<'_>) -> Orientation {
    let spin = object.get("spin").and_then(|property| {
        let spin = match &property.value {
            Value::StringLit(text) if text.value == "free" => Spin::Free,
            value => Spin::HeldDeg(number_of(value)?),
        };
        Some(Spanned::new(spin, span_of(&property.value)))
    });
    Orientation {
        follow: word(object, "follow", |name| match name {
            "tangent" => Some(Follow::Tangent),
            "vertical" => Some(Follow::Vertical),
            "surface_normal" => Some(Follow::SurfaceNormal),
            "given" => Some(Follow::Given),
            _ => None,
        }),
        tilt: word(object, "tilt", |name| match name {
            "cone" => Some(Tilt::Cone),
            "per-axis" => Some(Tilt::PerAxis),
            _ => None,
        }),
        tilt_from_deg: number(object, "tilt_from_deg"),
        tilt_max_deg: number(object, "tilt_max_deg"),
        tilt_free_deg: number(object, "tilt_free_deg"),
        spin,
    }
}

fn strand(object: &Object<'_>) -> Strand {
    Strand {
        id: text(object, "id").unwrap_or_default(),
        span: span_of(object),
        points_mm: triples(object, "points_mm").unwrap_or_default(),
        directions: triples(object, "directions"),
        joints: rows(object, "joints"),
        times_s: times(object),
        on: word(object, "on", |name| {
            Some(match name {
                "air" => On::Air,
                "bed" => On::Bed,
                id => On::Form(id.to_owned()),
            })
        }),
        start: object.get_object("start").map(end).unwrap_or_default(),
        end: object.get_object("end").map(end).unwrap_or_default(),
        profile: objects(object, "profile").filter_map(profile_point).collect(),
        events: objects(object, "events").filter_map(event).collect(),
        process: process(object),
    }
}

fn end(object: &Object<'_>) -> End {
    let join = word(object, "join", |name| {
        Some(match name {
            "bed" => Join::Bed,
            "free" => Join::Free,
            id => Join::Id(id.to_owned()),
        })
    });
    End { join, dwell_s: number(object, "dwell_s") }
}

fn profile_point(object: &Object<'_>) -> Option<ProfilePoint> {
    Some(ProfilePoint {
        at_mm: number(object, "at_mm")?,
        speed_mm_s: number(object, "speed_mm_s"),
        flow_mm3_s: number(object, "flow_mm3_s"),
    })
}

fn event(object: &Object<'_>) -> Option<Event> {
    let at_mm = number(object, "at_mm").map(|at| Spanned::new(At::Mm(at.value), at.span));
    let at_s = number(object, "at_s").map(|at| Spanned::new(At::S(at.value), at.span));
    Some(Event {
        from_end: text(object, "from").is_some_and(|from| from.value == "end"),
        at: at_mm.or(at_s)?,
        set: text(object, "set")?,
        on: word(object, "to", |name| Some(name == "on"))?,
    })
}

fn step(value: &Value<'_>) -> Option<Spanned<Step>> {
    let span = span_of(value);
    let step = match value {
        Value::StringLit(id) if !id.value.is_empty() => Step::Strand(id.value.clone().into_owned()),
        Value::Object(object) => {
            let joints = object.get_object("move").and_then(|inner| rows(inner, "joints"));
            let release = || text(object, "release").map(|id| Step::Release(id.value));
            let checkpoint = || text(object, "checkpoint").map(|name| Step::Checkpoint(name.value));
            let wait = || number(object, "wait_s").map(|time| Step::Wait(time.value));
            let joints = joints.map(|rows| Step::Move(rows.value));
            joints.or_else(wait).or_else(release).or_else(checkpoint)?
        }
        _ => return None,
    };
    Some(Spanned::new(step, span))
}

fn load_case(object: &Object<'_>) -> LoadCase {
    let support = |object: &Object<'_>| {
        let fix = word(object, "fix", |letters| {
            let xyz = ['x', 'y', 'z'].map(|axis| letters.contains(axis));
            Some(Fix { xyz, rotations: letters.contains('r') })
        });
        Some(SupportPoint { at_mm: triple(object, "at_mm")?, fix: fix? })
    };
    let force = |object: &Object<'_>| {
        Some(PointForce { at_mm: triple(object, "at_mm")?, force_n: triple(object, "force_n")? })
    };
    LoadCase {
        name: text(object, "name").unwrap_or_default(),
        supports: objects(object, "supports").filter_map(support).collect(),
        forces: objects(object, "forces").filter_map(force).collect(),
    }
}

fn limits(object: &Object<'_>) -> Limits {
    Limits {
        clearance_mm: number(object, "clearance_mm"),
        node_miss_mm: number(object, "node_miss_mm"),
        sag_mm: number(object, "sag_mm"),
        deflection_mm: number(object, "deflection_mm"),
        strength_percent: number(object, "strength_percent"),
        buckling_factor: number(object, "buckling_factor"),
        load_factor: number(object, "load_factor"),
        speed_band_percent: number(object, "speed_band_percent"),
        cycle_time_s: number(object, "cycle_time_s"),
    }
}

fn allowance(object: &Object<'_>) -> Allowance {
    Allowance {
        code: text(object, "code").unwrap_or_default(),
        strand: text(object, "strand"),
        reason: text(object, "reason").unwrap_or_default(),
        until: text(object, "until").unwrap_or_default(),
    }
}

fn objects<'a, 'b>(
    object: &'b Object<'a>,
    key: &str,
) -> impl Iterator<Item = &'b Object<'a>> + use<'a, 'b> {
    let list = object.get_array(key).map(|list| list.elements.as_slice()).unwrap_or_default();
    list.iter().filter_map(Value::as_object)
}

fn text(object: &Object<'_>, key: &str) -> Option<Spanned<String>> {
    let literal = object.get_string(key).filter(|literal| !literal.value.is_empty())?;
    Some(Spanned::new(literal.value.clone().into_owned(), span_of(literal)))
}

fn word<T>(object: &Object<'_>, key: &str, read: impl Fn(&str) -> Option<T>) -> Option<Spanned<T>> {
    let literal = object.get_string(key).filter(|literal| !literal.value.is_empty())?;
    Some(Spanned::new(read(&literal.value)?, span_of(literal)))
}

fn number_of(value: &Value<'_>) -> Option<f64> {
    value.as_number_lit()?.value.parse().ok().filter(|number: &f64| number.is_finite())
}

fn number(object: &Object<'_>, key: &str) -> Option<Spanned<f64>> {
    let value = &object.get(key)?.value;
    Some(Spanned::new(number_of(value)?, span_of(value)))
}

fn triple_of(value: &Value<'_>) -> Option<Triple> {
    let [x, y, z] = value.as_array()?.elements.as_slice() else { return None };
    Some(Spanned::new([number_of(x)?, number_of(y)?, number_of(z)?], span_of(value)))
}

fn triple(object: &Object<'_>, key: &str) -> Option<Triple> {
    triple_of(&object.get(key)?.value)
}

/// All triples of a list, or nothing if one is unusable: indices must keep their meaning.
fn triples(object: &Object<'_>, key: &str) -> Option<Vec<Triple>> {
    object.get_array(key)?.elements.iter().map(triple_of).collect()
}

fn rows(object: &Object<'_>, key: &str) -> Option<Spanned<Vec<Vec<f64>>>> {
    let list = object.get_array(key)?;
    let row = |value: &Value<'_>| value.as_array()?.elements.iter().map(number_of).collect();
    Some(Spanned::new(list.elements.iter().map(row).collect::<Option<_>>()?, span_of(list)))
}

fn times(object: &Object<'_>) -> Option<Spanned<Vec<f64>>> {
    let list = object.get_array("times_s")?;
    Some(Spanned::new(list.elements.iter().map(number_of).collect::<Option<_>>()?, span_of(list)))
}
