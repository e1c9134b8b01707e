//! A document and the files it names become a [`Job`]: names looked up, units turned to SI.
//!
//! Input is refused, never repaired; every problem is reported at its place in the job's text.

use std::collections::BTreeMap;

use slam::cell_file::CellFile;
use slam::document::{self as doc, Document};
use slam::material_file::MaterialFile;
use slam::mesh::Mesh;
use slam::robot_file::RobotFile;
use slam::tool_file::ToolFile;
use slam::urdf::RobotDescription;
use slam::{Diagnostic, Span, Spanned};

use super::job::{
    Air, At, End, Event, Flow, Follow, Form, Interpolation, Job, Join, Limits, LoadCase, On,
    Orientation, PointForce, ProfilePoint, Settings, Spin, Step, Strand, Support, Threads, Tilt,
};
use super::machine::Cell;
use super::{machine_from_files, material_from_file};
use crate::finding::Code;
use crate::interval::Interval;
use crate::kinematics::{ChainJoint, JointKind};
use crate::pose::{self, Point, Pose, Vector};
use crate::process;

/// All files a job names, already read and parsed by the caller.
#[derive(Debug)]
pub struct Parts<'a> {
    /// The cell.
    pub cell: &'a CellFile,
    /// Its robot's own file; `None` for a URDF that stands alone.
    pub robot: Option<&'a RobotFile>,
    /// Its robot's URDF.
    pub urdf: &'a RobotDescription,
    /// Meshes of the robot's links, by the path in the URDF.
    pub link_meshes: &'a BTreeMap<String, Mesh>,
    /// Its tool.
    pub tool: &'a ToolFile,
    /// The material.
    pub material: &'a MaterialFile,
    /// One mesh per form of the job, in order, mm.
    pub form_meshes: &'a [Mesh],
}

/// Resolves a job.
///
/// # Errors
/// All problems found, with places in the job's text.
pub fn resolve(document: &Document, parts: &Parts<'_>) -> Result<Job, Vec<Diagnostic>> {
    let cell = machine_from_files::machine(parts).map_err(|fault| {
        let message = format!("cell `{}` cannot be used: {fault}", document.cell.value);
        let hint = "the cell, its robot and its tool must fit each other";
        vec![Diagnostic::error(document.cell.span, message).hint(hint)]
    })?;
    let mut resolver = Resolver { document, cell: &cell, problems: Vec::new() };
    let forms = resolver.forms(parts.form_meshes);
    let strands: Vec<Strand> =
        document.strands.iter().map(|strand| resolver.strand(strand)).collect();
    let steps = resolver.steps();
    let limits = resolver.limits();
    resolver.allowed_codes();
    let problems = resolver.problems;
    if !problems.is_empty() {
        return Err(problems);
    }
    let environment = &document.environment;
    Ok(Job {
        name: document.name.value.clone(),
        material: material_from_file::material(parts.material),
        bed_from_part: placement(&document.placement),
        air: Air {
            temperature_k: environment.air_c.map_or(23.0, |air| air.value) + 273.15,
            speed_m_s: environment.air_m_s.map_or(0.0, |air| air.value),
        },
        forms,
        strands,
        steps,
        loads: document.loads.iter().map(load_case).collect(),
        limits,
        cell,
    })
}

/// Tilt of the nozzle for jobs that do not say: Kirkman's 20° and 40°.
const TILT_FROM_DEG: f64 = 20.0;
const TILT_MAX_DEG: f64 = 40.0;

struct Resolver<'a> {
    document: &'a Document,
    cell: &'a Cell,
    problems: Vec<Diagnostic>,
}

impl Resolver<'_> {
    fn error(&mut self, span: Span, message: String, hint: &str) {
        self.problems.push(Diagnostic::error(span, message).hint(hint));
    }

    fn forms(&mut self, meshes: &[Mesh]) -> Vec<Form> {
        assert_eq!(meshes.len(), self.document.forms.len(), "one mesh per form");
        let bed_pa = self.cell.bed.adhesion_pa;
        let form = |(form, mesh): (&doc::Form, &Mesh)| {
            let part_from_mesh = placement(&form.placement);
            let vertices =
                mesh.vertices.iter().map(|&v| part_from_mesh * Point::from(mm(v))).collect();
            Form {
                id: form.id.value.clone(),
                vertices,
                triangles: mesh.triangles.clone(),
                adhesion_pa: form
                    .adhesion_mpa
                    .map_or(bed_pa, |mpa| Interval::exact(mpa.value * 1e6)),
            }
        };
        self.document.forms.iter().zip(meshes).map(form).collect()
    }

    fn form_index(&self, id: &str) -> Option<usize> {
        self.document.forms.iter().position(|form| form.id.value == id)
    }

    fn strand_index(&self, id: &str) -> Option<usize> {
        self.document.strands.iter().position(|strand| strand.id.value == id)
    }

    fn strand(&mut self, strand: &doc::Strand) -> Strand {
        let points: Vec<Point> =
            strand.points_mm.iter().map(|p| Point::from(mm(p.value))).collect();
        let directions = strand.directions.as_ref().map(|rows| {
            rows.iter().map(|row| Vector::from(row.value).normalize()).collect::<Vec<_>>()
        });
        let settings = self.settings(strand, directions.is_some());
        let resolved = Strand {
            id: strand.id.value.clone(),
            span: strand.span,
            points,
            joints: strand.joints.as_ref().map(|given| {
                let rows = self.joint_rows(&given.value, given.span);
                // Past the stop of a turning joint is a finding (R102).
                self.within_stops(&rows, given.span, |joint| joint.kind == JointKind::Prismatic);
                rows
            }),
            directions,
            times_s: strand.times_s.as_ref().map(|times| times.value.clone()),
            on: self.on(strand.on.as_ref()),
            start: self.end(&strand.start, 0.0),
            end: self.end(&strand.end, settings.dwell_s),
            profile: strand.profile.iter().map(profile_point).collect(),
            events: strand.events.iter().map(|event| self.event(event)).collect(),
            settings,
        };
        self.makes_sense(&resolved);
        resolved
    }

    fn settings(&mut self, strand: &doc::Strand, has_directions: bool) -> Settings {
        let (own, common) = (&strand.process, &self.document.process);
        let extruder = &self.cell.extruder;
        let (approach_mm, bead_m) = (extruder.approach_m * 1e3, extruder.diameter_m);
        let speed_mm_s = pick(own.speed_mm_s, common.speed_mm_s, extruder.speed_m_s * 1e3);
        let interpolation = own.interpolation.or(common.interpolation);
        Settings {
            speed_m_s: speed_mm_s / 1e3,
            flow: self.flow(own.flow.or(common.flow)).unwrap_or(Flow::Diameter(bead_m)),
            prime_s: pick(own.prime_s, common.prime_s, 0.0),
            lights_after_m: pick(own.lights_after_mm, common.lights_after_mm, 0.0) / 1e3,
            overrun_m: pick(own.overrun_mm, common.overrun_mm, 0.0) / 1e3,
            dwell_s: pick(own.dwell_s, common.dwell_s, 0.0),
            second_pass_m_s: own
                .second_pass_mm_s
                .or(common.second_pass_mm_s)
                .map(|speed| speed.value / 1e3),
            post_cure_j_m2: own
                .post_cure_j_cm2
                .or(common.post_cure_j_cm2)
                .map(|dose| dose.value * 1e4),
            threads: own.threads.or(common.threads).map(|threads| Threads {
                count: threads.count,
                diameter_m: threads.diameter_mm / 1e3,
                pitch_m: threads.pitch_mm / 1e3,
                sweep_m: threads.sweep_mm / 1e3,
            }),
            approach_m: pick(own.approach_mm, common.approach_mm, approach_mm) / 1e3,
            retract_m: pick(own.retract_mm, common.retract_mm, approach_mm) / 1e3,
            orientation: self.orientation(strand, has_directions),
            interpolation: interpolation.map_or(Interpolation::Linear, |way| way.value),
        }
    }

    fn orientation(&mut self, strand: &doc::Strand, has_directions: bool) -> Orientation {
        let (own, common) = (&strand.process.orientation, &self.document.process.orientation);
        let asked = own.follow.or(common.follow);
        let silent = if has_directions { Follow::Given } else { Follow::Vertical };
        let follow = asked.map_or(silent, |follow| follow.value);
        let span = asked.map_or(strand.span, |follow| follow.span);
        self.follow_is_possible(follow, span, strand);
        let from_deg = pick(own.tilt_from_deg, common.tilt_from_deg, TILT_FROM_DEG);
        let max_deg = pick(own.tilt_max_deg, common.tilt_max_deg, TILT_MAX_DEG);
        Orientation {
            follow,
            tilt: own.tilt.or(common.tilt).map_or(Tilt::Cone, |tilt| tilt.value),
            tilt_from_rad: from_deg.to_radians(),
            tilt_max_rad: max_deg.to_radians(),
            tilt_free_rad: pick(own.tilt_free_deg, common.tilt_free_deg, 0.0).to_radians(),
            spin: match own.spin.or(common.spin).map(|spin| spin.value) {
                Some(doc::Spin::HeldDeg(deg)) => Spin::Held(deg.to_radians()),
                Some(doc::Spin::Free) | None => Spin::Free,
            },
        }
    }

    fn follow_is_possible(&mut self, follow: Follow, span: Span, strand: &doc::Strand) {
        let on_form = matches!(strand.on.as_ref().map(|on| &on.value), Some(doc::On::Form(_)));
        let id = &strand.id.value;
        if follow == Follow::Given && strand.directions.is_none() {
            let message = format!("strand `{id}` is to follow given directions but has none");
            self.error(
                span,
                message,
                "add `directions`, one per point, or choose another `follow`",
            );
        }
        if follow == Follow::SurfaceNormal && !on_form {
            let message =
                format!("strand `{id}` is to follow a surface normal but lies on no form");
            self.error(
                span,
                message,
                "say `\"on\": \"<id of a form>\"`, or choose another `follow`",
            );
        }
    }

    fn flow(&mut self, flow: Option<Spanned<doc::Flow>>) -> Option<Flow> {
        let flow = flow?;
        match flow.value {
            doc::Flow::DiameterMm(diameter) => Some(Flow::Diameter(diameter / 1e3)),
            doc::Flow::RateMm3S(rate) => Some(Flow::Rate(rate / 1e9)),
            doc::Flow::Level(level) => {
                let levels = &self.cell.extruder.levels_m3_s;
                let rate = (level as usize).checked_sub(1).and_then(|k| levels.get(k)).copied();
                if rate.is_none() {
                    let message = format!(
                        "the extruder of cell `{}` has no flow level {level}; it has {}",
                        self.cell.name,
                        levels.len()
                    );
                    self.error(flow.span, message, "say `diameter_mm` or `rate_mm3_s` instead");
                }
                rate.map(Flow::Rate)
            }
        }
    }

    fn joint_rows(&mut self, rows: &[Vec<f64>], span: Span) -> Vec<Vec<f64>> {
        let joints = machine_from_files::free_joints(&self.cell.robot.arm.chain);
        let n_joints = joints.len();
        if let Some((row, values)) = rows.iter().enumerate().find(|(_, row)| row.len() != n_joints)
        {
            let message = format!(
                "row {row} has {} joint values, the arm has {n_joints} joints",
                values.len()
            );
            self.error(span, message, "joints that the cell holds are left out of the rows");
            return Vec::new();
        }
        let scale: Vec<f64> =
            joints.iter().map(|joint| machine_from_files::joint_scale(joint)).collect();
        rows.iter()
            .map(|row| row.iter().zip(&scale).map(|(q, scale)| q * scale).collect())
            .collect()
    }

    /// Refuses rows that put a joint past its stop.
    fn within_stops(&mut self, rows: &[Vec<f64>], span: Span, judged: fn(&ChainJoint) -> bool) {
        let joints = machine_from_files::free_joints(&self.cell.robot.arm.chain);
        let past = |(joint, q): &(&&ChainJoint, &f64)| {
            judged(joint) && !(joint.lower..=joint.upper).contains(*q)
        };
        let found = rows.iter().enumerate().find_map(|(row, values)| {
            joints.iter().zip(values).find(past).map(|(joint, _)| (row, joint.name.clone()))
        });
        if let Some((row, name)) = found {
            let message = format!("row {row} puts joint {name} past its stop");
            self.error(span, message, "`twin inspect` lists the stops of the robot");
        }
    }

    /// Refuses beads that no extruder makes, and strands said to be on a bed that is elsewhere.
    fn makes_sense(&mut self, strand: &Strand) {
        const BEAD_M: std::ops::RangeInclusive<f64> = 1e-5..=0.1;
        let places =
            std::iter::once(f64::NEG_INFINITY).chain(strand.profile.iter().map(|p| p.at_m));
        let bead = |at_m: f64| {
            let (speed_m_s, flow_m3_s) = strand.asked(at_m);
            process::bead::drawn_diameter_m(flow_m3_s, speed_m_s)
        };
        let beads: Vec<f64> = places.map(bead).collect();
        if let Some(bead_m) = beads.iter().find(|bead_m| !BEAD_M.contains(bead_m)) {
            let message = format!("strand `{}` has a bead of {} mm", strand.id, bead_m * 1e3);
            let hint = "flow and speed must give a bead of 0.01 to 100 mm; where nothing is to be extruded, end the strand";
            self.error(strand.span, message, hint);
        }
        let bed_from_part = placement(&self.document.placement);
        let far = |point: &Point| (bed_from_part * point).z.abs() > 3.0 * beads[0];
        let ends =
            [(strand.start.join, strand.points.first()), (strand.end.join, strand.points.last())];
        let joined = ends
            .into_iter()
            .filter(|(join, _)| *join == Some(Join::Bed))
            .filter_map(|(_, point)| point);
        let lying = strand.points.iter().filter(|_| strand.on == On::Bed);
        if let Some(point) = joined.chain(lying).find(|point| far(point)) {
            let height_mm = (bed_from_part * point).z * 1e3;
            let message = format!(
                "strand `{}` is said to be on the bed but is {height_mm:.1} mm above it",
                strand.id
            );
            self.error(
                strand.span,
                message,
                "heights are of the strand's axis; more than three beads is not on the bed",
            );
        }
    }

    fn on(&self, on: Option<&Spanned<doc::On>>) -> On {
        match on.map(|on| &on.value) {
            None | Some(doc::On::Air) => On::Air,
            Some(doc::On::Bed) => On::Bed,
            Some(doc::On::Form(id)) => On::Form(self.form_index(id).expect("slam checked the id")),
        }
    }

    fn end(&self, end: &doc::End, dwell_s: f64) -> End {
        let join = end.join.as_ref().map(|join| match &join.value {
            doc::Join::Bed => Join::Bed,
            doc::Join::Free => Join::Free,
            doc::Join::Id(id) => match (self.form_index(id), self.strand_index(id)) {
                (Some(form), _) => Join::Form(form),
                (None, strand) => Join::Strand(strand.expect("slam checked the id")),
            },
        });
        End { join, dwell_s: end.dwell_s.map_or(dwell_s, |dwell| dwell.value) }
    }

    fn event(&mut self, event: &doc::Event) -> Event {
        const ALWAYS: [&str; 4] = ["flow", "light", "air", "heater"];
        let set = &event.set.value;
        if !ALWAYS.contains(&set.as_str()) && !self.cell.io.contains(set) {
            let message = format!("cell `{}` has no output `{set}`", self.cell.name);
            let known = ALWAYS.iter().copied().chain(self.cell.io.iter().map(String::as_str));
            let hint = format!("it has {}", known.collect::<Vec<_>>().join(", "));
            self.error(event.set.span, message, &hint);
        }
        let at = match event.at.value {
            doc::At::Mm(mm) => At::Length(mm / 1e3),
            doc::At::S(s) => At::Time(s),
        };
        Event { from_end: event.from_end, at, set: set.clone(), on: event.on.value }
    }

    fn steps(&mut self) -> Vec<Step> {
        let Some(sequence) = &self.document.sequence else {
            return (0..self.document.strands.len()).map(Step::Print).collect();
        };
        let mut steps = Vec::with_capacity(sequence.len());
        for step in sequence {
            steps.push(match &step.value {
                doc::Step::Strand(id) => {
                    Step::Print(self.strand_index(id).expect("slam checked the id"))
                }
                doc::Step::Move(rows) => {
                    let rows = self.joint_rows(rows, step.span);
                    self.within_stops(&rows, step.span, |_| true);
                    Step::Move(rows)
                }
                doc::Step::Wait(s) => Step::Wait(*s),
                doc::Step::Release(id) => {
                    Step::Release(self.form_index(id).expect("slam checked the id"))
                }
                doc::Step::Checkpoint(name) => Step::Checkpoint(name.clone()),
            });
        }
        steps
    }

    /// Codes that are let pass must be codes, letter by letter.
    fn allowed_codes(&mut self) {
        for allowance in &self.document.allow {
            let (name, known) = (allowance.code.value.as_str(), Code::ALL.map(Code::as_str));
            if known.contains(&name) {
                continue;
            }
            let hint = match slam::job::nearest(name, known.into_iter()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`twin explain` lists all codes".to_owned(),
            };
            let shown: String = name.chars().take(60).collect();
            let message = format!("there is no code {shown:?}");
            self.error(allowance.code.span, message, &hint);
        }
    }

    fn limits(&self) -> Limits {
        let (asked, default) = (&self.document.limits, &self.cell.limits);
        let pick =
            |asked: Option<Spanned<f64>>, default: f64| asked.map_or(default, |mm| mm.value / 1e3);
        Limits {
            clearance_m: pick(asked.clearance_mm, default.clearance_m),
            node_miss_m: pick(asked.node_miss_mm, default.node_miss_m),
            sag_m: pick(asked.sag_mm, default.sag_m),
            deflection_m: pick(asked.deflection_mm, default.deflection_m),
            strength_share: asked
                .strength_percent
                .map_or(default.strength_share, |percent| percent.value / 100.0),
            buckling_factor: asked
                .buckling_factor
                .map_or(default.buckling_factor, |factor| factor.value),
            load_factor: asked.load_factor.map_or(default.load_factor, |factor| factor.value),
            speed_band: asked
                .speed_band_percent
                .map_or(default.speed_band, |percent| percent.value / 100.0),
            cycle_time_s: asked.cycle_time_s.map(|s| s.value).or(default.cycle_time_s),
            ..default.clone()
        }
    }
}

/// The strand's own value, else the job's, else the default.
fn pick(own: Option<Spanned<f64>>, common: Option<Spanned<f64>>, default: f64) -> f64 {
    own.or(common).map_or(default, |value| value.value)
}

fn profile_point(point: &doc::ProfilePoint) -> ProfilePoint {
    ProfilePoint {
        at_m: point.at_mm.value / 1e3,
        speed_m_s: point.speed_mm_s.map(|speed| speed.value / 1e3),
        flow_m3_s: point.flow_mm3_s.map(|flow| flow.value / 1e9),
    }
}

fn load_case(case: &doc::LoadCase) -> LoadCase {
    let support = |support: &doc::SupportPoint| {
        let doc::Fix { xyz: [x, y, z], rotations: r } = support.fix.value;
        Support { at: Point::from(mm(support.at_mm.value)), fixed: [x, y, z, r, r, r] }
    };
    let force = |force: &doc::PointForce| PointForce {
        at: Point::from(mm(force.at_mm.value)),
        force_n: Vector::from(force.force_n.value),
    };
    LoadCase {
        name: case.name.value.clone(),
        supports: case.supports.iter().map(support).collect(),
        forces: case.forces.iter().map(force).collect(),
    }
}

fn mm(xyz_mm: [f64; 3]) -> [f64; 3] {
    xyz_mm.map(|value| value / 1e3)
}

fn placement(placement: &doc::Placement) -> Pose {
    let triple = |triple: Option<doc::Triple>| triple.map_or([0.0; 3], |triple| triple.value);
    pose::from_xyz_rpy(mm(triple(placement.xyz_mm)), triple(placement.rpy_deg).map(f64::to_radians))
}
