//! The making of a strand as the laws of the process want it: from the job and the motion.

use crate::cell::{At, Event, Job, Strand};
use crate::motion::{Leg, Moment};
use crate::pose::Vector;
use crate::process::{Course, Station, Told};
use crate::toolpath::{Path, Sample};

/// How a strand was made. Where the arm reaches nothing of it: as asked, the arm at home.
pub(super) fn course(job: &Job, path: &Path, leg: Option<&Leg>) -> Course {
    let strand = &job.strands[path.strand];
    let moments = leg.map_or(&[][..], |leg| &leg.moments);
    let unreached = leg.is_some_and(|leg| !leg.unreached.is_empty());
    let stations = if moments.len() < 2 || unreached {
        as_asked(job, path)
    } else {
        moments.iter().map(|moment| station(job, path, moment, moments[0].time_s)).collect()
    };
    let mut course =
        Course { stations, flow: Vec::new(), light: Vec::new(), dwell_s: strand.end.dwell_s };
    course.flow = flow(strand, path, &course);
    course.light = light(job, strand, &course);
    course
}

fn as_asked(job: &Job, path: &Path) -> Vec<Station> {
    let mut time_s = 0.0;
    let mut stations = Vec::with_capacity(path.samples.len());
    for (k, sample) in path.samples.iter().enumerate() {
        if k > 0 {
            let before = &path.samples[k - 1];
            time_s += (sample.at_m - before.at_m) / before.speed_m_s;
        }
        stations.push(place(job, sample, time_s, &job.cell.home));
    }
    stations
}

fn station(job: &Job, path: &Path, moment: &Moment, start_s: f64) -> Station {
    let sample = sample_at(path, moment.at_m);
    place(job, &sample, moment.time_s - start_s, &moment.q)
}

fn place(job: &Job, sample: &Sample, time_s: f64, q: &[f64]) -> Station {
    let tip = job.cell.robot.arm.chain.forward(q);
    let part_from_room = (job.cell.world_from_bed(&tip) * job.bed_from_part).inverse();
    Station {
        at_m: sample.at_m,
        time_s,
        point: sample.point,
        tangent: sample.tangent,
        gravity_m_s2: part_from_room * job.cell.gravity_m_s2,
        part_from_tool: part_from_room * job.cell.world_from_tool(&tip),
        part_from_room,
    }
}

/// The strand at an arc length: between the samples around it.
fn sample_at(path: &Path, at_m: f64) -> Sample {
    let samples = &path.samples;
    let k = samples.partition_point(|sample| sample.at_m <= at_m).clamp(1, samples.len());
    let from = samples[k - 1];
    let Some(to) = samples.get(k) else { return from };
    let share = ((at_m - from.at_m) / (to.at_m - from.at_m)).clamp(0.0, 1.0);
    Sample { at_m, point: from.point + (to.point - from.point) * share, ..from }
}

/// Primed with the first flow; told along the way; nothing from the end on. Switches of `flow` turn it
/// off and on.
fn flow(strand: &Strand, path: &Path, course: &Course) -> Vec<Told<f64>> {
    let end_s = course.time_at_s(path.length_m);
    let first = strand.asked(f64::NEG_INFINITY).1;
    let mut told = vec![Told { from_s: -strand.settings.prime_s, value: first }];
    for point in &strand.profile {
        let value = strand.asked(point.at_m).1;
        told.push(Told { from_s: course.time_at_s(point.at_m), value });
    }
    told.push(Told { from_s: end_s, value: 0.0 });
    told.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    let switches = switches(strand, course, "flow");
    if switches.is_empty() {
        return told;
    }
    let told_at = |time_s: f64| {
        let k = told.partition_point(|told| told.from_s <= time_s);
        if k > 0 { told[k - 1].value } else { 0.0 }
    };
    let open_at = |time_s: f64| {
        let k = switches.partition_point(|switch| switch.from_s <= time_s);
        k == 0 || switches[k - 1].value
    };
    let mut times: Vec<f64> =
        told.iter().map(|told| told.from_s).chain(switches.iter().map(|s| s.from_s)).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let at =
        |from_s: f64| Told { from_s, value: if open_at(from_s) { told_at(from_s) } else { 0.0 } };
    times.into_iter().map(at).collect()
}

/// On once the length without lights is printed, until the nozzle leaves; switches of `light` have the
/// last word. A resin that lies on the bed and is passed a second time is laid in the dark.
fn light(job: &Job, strand: &Strand, course: &Course) -> Vec<Told<bool>> {
    let mut told = Vec::new();
    let laid_dark = strand.settings.second_pass_m_s.is_some() && strand.on != crate::cell::On::Air;
    if super::lighting::any(job) && !laid_dark {
        told.push(Told { from_s: course.time_at_s(strand.settings.lights_after_m), value: true });
    }
    told.extend(switches(strand, course, "light"));
    told.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    told
}

/// The switches of one thing, by time.
fn switches(strand: &Strand, course: &Course, what: &str) -> Vec<Told<bool>> {
    let mut switches: Vec<Told<bool>> = strand
        .events
        .iter()
        .filter(|event| event.set == what)
        .map(|event| Told { from_s: time_of(strand, course, event), value: event.on })
        .collect();
    switches.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
    switches
}

fn time_of(strand: &Strand, course: &Course, event: &Event) -> f64 {
    let length_m = *crate::toolpath::stations(&strand.points).last().unwrap_or(&0.0);
    match (event.at, event.from_end) {
        (At::Length(at_m), false) => course.time_at_s(at_m),
        (At::Length(at_m), true) => course.time_at_s(length_m + at_m),
        (At::Time(at_s), false) => at_s,
        (At::Time(at_s), true) => course.time_at_s(length_m) + at_s,
    }
}

/// Below this share of gravity what is across an upright strand is rounding: a shell that has no stiffness at the bad
/// end would fall over by it.
const ROUNDING: f64 = 1e-9;

/// Greatest component of gravity across the strand while it is made, and gravity's direction there,
/// part axes: the bed may turn.
pub(super) fn gravity_across(course: &Course) -> (f64, Vector) {
    let mut worst = (0.0, Vector::zeros());
    for station in &course.stations {
        let g = station.gravity_m_s2;
        let across_m_s2 = (g - station.tangent * g.dot(&station.tangent)).norm();
        if across_m_s2 > worst.0 || worst.1 == Vector::zeros() {
            worst = (across_m_s2, g);
        }
    }
    let length = worst.1.norm();
    let across_m_s2 = if worst.0 > ROUNDING * length { worst.0 } else { 0.0 };
    (across_m_s2, if length > 0.0 { worst.1 / length } else { Vector::zeros() })
}
