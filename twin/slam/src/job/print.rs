//! Document to text.

use std::fmt::Write;

use crate::document::*;

/// A job as canonical text: one point per line, everything else compact. Reading it back gives
/// the same document, every number to its last bit. A document that [`super::parse`] would refuse
/// (NaN, an id twice) is printed as it is and refused when read.
pub fn print(document: &Document) -> String {
    let mut fields = vec![
        field("slam", "1".to_owned()),
        field("name", string(&document.name.value)),
        field("cell", string(&document.cell.value)),
        field("material", string(&document.material.value)),
    ];
    fields.extend(placed("placement", inline(placement(&document.placement))));
    fields.extend(placed("environment", inline(environment(&document.environment))));
    if !document.forms.is_empty() {
        fields.push(field("forms", lines(document.forms.iter().map(form), 1)));
    }
    fields.extend(placed("process", inline(process(&document.process))));
    fields.push(field("strands", lines(document.strands.iter().map(strand), 1)));
    if let Some(steps) = &document.sequence {
        fields.push(field("sequence", lines(steps.iter().map(|each| step(&each.value)), 1)));
    }
    if !document.loads.is_empty() {
        fields.push(field("loads", lines(document.loads.iter().map(load_case), 1)));
    }
    fields.extend(placed("limits", inline(limits(&document.limits))));
    if !document.allow.is_empty() {
        fields.push(field("allow", lines(document.allow.iter().map(allowance), 1)));
    }
    format!("{{\n  {}\n}}\n", fields.join(",\n  "))
}

fn placement(placement: &Placement) -> Vec<String> {
    let xyz = placement.xyz_mm.map(|xyz| field("xyz_mm", row(&xyz.value)));
    let rpy = placement.rpy_deg.map(|rpy| field("rpy_deg", row(&rpy.value)));
    xyz.into_iter().chain(rpy).collect()
}

fn environment(environment: &Environment) -> Vec<String> {
    numbers(&[("air_c", environment.air_c), ("air_m_s", environment.air_m_s)])
}

fn form(form: &Form) -> String {
    let mut fields =
        vec![field("id", string(&form.id.value)), field("mesh", string(&form.mesh.value))];
    fields.extend(placement(&form.placement));
    fields.extend(numbers(&[("adhesion_mpa", form.adhesion_mpa)]));
    inline(fields)
}

fn process(process: &Process) -> Vec<String> {
    let mut fields = numbers(&[("speed_mm_s", process.speed_mm_s)]);
    if let Some(flow) = process.flow {
        let told = match flow.value {
            Flow::DiameterMm(diameter) => field("diameter_mm", number(diameter)),
            Flow::RateMm3S(rate) => field("rate_mm3_s", number(rate)),
            Flow::Level(level) => field("level", level.to_string()),
        };
        fields.push(field("flow", inline(vec![told])));
    }
    fields.extend(numbers(&[
        ("prime_s", process.prime_s),
        ("lights_after_mm", process.lights_after_mm),
        ("overrun_mm", process.overrun_mm),
        ("dwell_s", process.dwell_s),
        ("second_pass_mm_s", process.second_pass_mm_s),
        ("post_cure_j_cm2", process.post_cure_j_cm2),
        ("approach_mm", process.approach_mm),
        ("retract_mm", process.retract_mm),
    ]));
    fields.extend(process.threads.map(|threads| {
        let keys = vec![
            field("count", threads.count.to_string()),
            field("diameter_mm", number(threads.diameter_mm)),
            field("pitch_mm", number(threads.pitch_mm)),
            field("sweep_mm", number(threads.sweep_mm)),
        ];
        field("threads", inline(keys))
    }));
    fields.extend(placed("orientation", inline(orientation(&process.orientation))));
    fields.extend(process.interpolation.map(|interpolation| {
        let word = match interpolation.value {
            Interpolation::Linear => "linear",
            Interpolation::Joint => "joint",
        };
        field("interpolation", string(word))
    }));
    fields
}

fn orientation(orientation: &Orientation) -> Vec<String> {
    let mut fields = Vec::new();
    if let Some(follow) = orientation.follow {
        let word = match follow.value {
            Follow::Tangent => "tangent",
            Follow::Vertical => "vertical",
            Follow::SurfaceNormal => "surface_normal",
            Follow::Given => "given",
        };
        fields.push(field("follow", string(word)));
    }
    if let Some(tilt) = orientation.tilt {
        let word = match tilt.value {
            Tilt::Cone => "cone",
            Tilt::PerAxis => "per-axis",
        };
        fields.push(field("tilt", string(word)));
    }
    fields.extend(numbers(&[
        ("tilt_from_deg", orientation.tilt_from_deg),
        ("tilt_max_deg", orientation.tilt_max_deg),
        ("tilt_free_deg", orientation.tilt_free_deg),
    ]));
    fields.extend(orientation.spin.map(|spin| match spin.value {
        Spin::Free => field("spin", string("free")),
        Spin::HeldDeg(angle) => field("spin", number(angle)),
    }));
    fields
}

fn strand(strand: &Strand) -> String {
    let triples = |list: &[Triple]| lines(list.iter().map(|triple| row(&triple.value)), 3);
    let mut fields =
        vec![field("id", string(&strand.id.value)), field("points_mm", triples(&strand.points_mm))];
    fields.extend(strand.directions.as_ref().map(|list| field("directions", triples(list))));
    fields.extend(
        strand
            .joints
            .as_ref()
            .map(|rows| field("joints", lines(rows.value.iter().map(|each| row(each)), 3))),
    );
    fields.extend(strand.times_s.as_ref().map(|times| field("times_s", row(&times.value))));
    fields.extend(strand.on.as_ref().map(|on| {
        let word = match &on.value {
            On::Air => "air",
            On::Bed => "bed",
            On::Form(id) => id,
        };
        field("on", string(word))
    }));
    fields.extend(placed("start", inline(end(&strand.start))));
    fields.extend(placed("end", inline(end(&strand.end))));
    if !strand.profile.is_empty() {
        fields.push(field("profile", lines(strand.profile.iter().map(profile_point), 3)));
    }
    if !strand.events.is_empty() {
        fields.push(field("events", lines(strand.events.iter().map(event), 3)));
    }
    fields.extend(process(&strand.process));
    format!("{{\n      {}\n    }}", fields.join(",\n      "))
}

fn end(end: &End) -> Vec<String> {
    let join = end.join.as_ref().map(|join| match &join.value {
        Join::Bed => "bed",
        Join::Free => "free",
        Join::Id(id) => id,
    });
    let join = join.map(|word| field("join", string(word)));
    join.into_iter().chain(numbers(&[("dwell_s", end.dwell_s)])).collect()
}

fn profile_point(point: &ProfilePoint) -> String {
    inline(numbers(&[
        ("at_mm", Some(point.at_mm)),
        ("speed_mm_s", point.speed_mm_s),
        ("flow_mm3_s", point.flow_mm3_s),
    ]))
}

fn event(event: &Event) -> String {
    let at = match event.at.value {
        At::Mm(at) => field("at_mm", number(at)),
        At::S(at) => field("at_s", number(at)),
    };
    let mut fields = vec![at];
    if event.from_end {
        fields.push(field("from", string("end")));
    }
    fields.push(field("set", string(&event.set.value)));
    fields.push(field("to", string(if event.on.value { "on" } else { "off" })));
    inline(fields)
}

fn step(step: &Step) -> String {
    inline(vec![match step {
        Step::Strand(id) => return string(id),
        Step::Move(rows) => {
            let joints = list(rows.iter().map(|each| row(each)));
            field("move", inline(vec![field("joints", joints)]))
        }
        Step::Wait(time_s) => field("wait_s", number(*time_s)),
        Step::Release(id) => field("release", string(id)),
        Step::Checkpoint(name) => field("checkpoint", string(name)),
    }])
}

fn load_case(load: &LoadCase) -> String {
    let supports = load.supports.iter().map(|support| {
        let at = field("at_mm", row(&support.at_mm.value));
        inline(vec![at, field("fix", string(&letters(support.fix.value)))])
    });
    let forces = load.forces.iter().map(|force| {
        let at = field("at_mm", row(&force.at_mm.value));
        inline(vec![at, field("force_n", row(&force.force_n.value))])
    });
    let mut fields =
        vec![field("name", string(&load.name.value)), field("supports", list(supports))];
    if !load.forces.is_empty() {
        fields.push(field("forces", list(forces)));
    }
    inline(fields)
}

fn letters(fix: Fix) -> String {
    let [x, y, z] = fix.xyz;
    let held = [('x', x), ('y', y), ('z', z), ('r', fix.rotations)];
    held.into_iter().filter(|(_, held)| *held).map(|(letter, _)| letter).collect()
}

fn limits(limits: &Limits) -> Vec<String> {
    numbers(&[
        ("clearance_mm", limits.clearance_mm),
        ("node_miss_mm", limits.node_miss_mm),
        ("sag_mm", limits.sag_mm),
        ("deflection_mm", limits.deflection_mm),
        ("strength_percent", limits.strength_percent),
        ("buckling_factor", limits.buckling_factor),
        ("load_factor", limits.load_factor),
        ("speed_band_percent", limits.speed_band_percent),
        ("cycle_time_s", limits.cycle_time_s),
    ])
}

fn allowance(allowance: &Allowance) -> String {
    let mut fields = vec![field("code", string(&allowance.code.value))];
    fields.extend(allowance.strand.as_ref().map(|strand| field("strand", string(&strand.value))));
    fields.push(field("reason", string(&allowance.reason.value)));
    fields.push(field("until", string(&allowance.until.value)));
    inline(fields)
}

fn field(name: &str, value: String) -> String {
    format!("\"{name}\": {value}")
}

/// A field that is left out where its object is empty.
fn placed(name: &str, object: String) -> Option<String> {
    (object != "{}").then(|| field(name, object))
}

fn numbers(values: &[(&str, Option<crate::Spanned<f64>>)]) -> Vec<String> {
    let written = |&(name, value): &(&str, Option<crate::Spanned<f64>>)| {
        value.map(|value| field(name, number(value.value)))
    };
    values.iter().filter_map(written).collect()
}

fn inline(fields: Vec<String>) -> String {
    if fields.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", fields.join(", ")) }
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

/// A list with one item per line; `depth`: levels of the key that holds it.
fn lines(items: impl Iterator<Item = String>, depth: usize) -> String {
    let indent = "  ".repeat(depth);
    let mut text = String::from("[");
    for (index, item) in items.enumerate() {
        let comma = if index == 0 { "" } else { "," };
        let _ = write!(text, "{comma}\n{indent}  {item}"); // writing to a String cannot fail
    }
    if text.len() > 1 {
        let _ = write!(text, "\n{indent}");
    }
    text + "]"
}

fn row(values: &[f64]) -> String {
    list(values.iter().map(|&value| number(value)))
}

/// Shortest decimal that reads back as the same number.
fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
