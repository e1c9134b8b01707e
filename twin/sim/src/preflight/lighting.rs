//! The lights of the cell as the process wants them, and what they do to the nozzle's tip.

use crate::cell::{Job, Lamp as CellLamp};
use crate::interval::Interval;
use crate::pose::Point;
use crate::process::bed_light::{Tip, lights_on_after_m, tip_limit_w_m2};
use crate::process::history::Corner;
use crate::process::lamp::{Lamp, Lobe, RingPlace};
use crate::process::lights::{ALWAYS, Carrier, LampSet, Lights};
use crate::process::shade::Shade;
use crate::process::{Course, Photopolymer, Station};
use crate::shape::Shape;

/// Share of the light that a bed throws back of which nobody knows: it can only warn; the high end a bright one, ours.
const ALBEDO: Interval = Interval { nominal: 0.0, low: 0.0, high: 0.8 };
/// The disc that shades the orifice stands this far above it, as a share of the lamps' height; ours.
const SHADE_SHARE: f64 = 0.25;

/// Whether anything shines in the cell.
pub(super) fn any(job: &Job) -> bool {
    job.cell.tool.light_ring.is_some()
        || !job.cell.tool.lamps.is_empty()
        || !job.cell.lamps.is_empty()
}

/// All lamps, at a corner of their intensity, and what shades them.
pub(super) fn lights(job: &Job, radius_m: f64, corner: Corner) -> Lights {
    let (lamps, shades) = on_tool(job, radius_m, corner);
    let room = job.cell.lamps.iter().map(|lamp| of(lamp, corner)).collect();
    let set = |carrier, lamps| LampSet { carrier, lamps, on_s: vec![ALWAYS] };
    Lights {
        sets: vec![set(Carrier::Tool, lamps), set(Carrier::Room, room)],
        shades: shades.into_iter().map(|shade| (Carrier::Tool, shade)).collect(),
    }
}

fn of(lamp: &CellLamp, corner: Corner) -> Lamp {
    Lamp {
        at: lamp.at,
        along: lamp.along,
        peak_w_sr: corner.helpful(lamp.peak_w_sr),
        full_angle_rad: lamp.full_angle_rad,
        lobe: Lobe::Gaussian,
    }
}

fn on_tool(job: &Job, radius_m: f64, corner: Corner) -> (Vec<Lamp>, Vec<Shade>) {
    let tool = &job.cell.tool;
    let mut lamps: Vec<Lamp> = tool.lamps.iter().map(|lamp| of(lamp, corner)).collect();
    let mut shades = Vec::new();
    if let Some(ring) = &tool.light_ring {
        let place = RingPlace::of(ring, ring.aim_m);
        let peak_w_sr = corner.helpful(ring.intensity_w_sr);
        lamps.extend(place.lamps(peak_w_sr, ring.full_angle_rad, Lobe::Gaussian));
        shades.push(place.shadow(ring.shadow_m, radius_m, SHADE_SHARE * place.height_m));
    }
    // Parts shade the lamps told one by one; those of a ring are shaded as its shadow says.
    if !tool.lamps.is_empty() && tool.light_ring.is_none() {
        let parts = tool.parts.iter().flat_map(|part| &part.shapes);
        shades.extend(parts.filter_map(shade).filter(|shade| {
            let (middle, ball_m) = shade.ball();
            tool.lamps.iter().all(|lamp| (lamp.at - middle).norm() > ball_m)
        }));
    }
    (lamps, shades)
}

fn shade(shape: &Shape) -> Option<Shade> {
    match shape {
        Shape::Cone { from, to, radius_from_m, radius_to_m } => Some(Shade::Cone {
            from: *from,
            to: *to,
            radius_from_m: *radius_from_m,
            radius_to_m: *radius_to_m,
        }),
        Shape::Capsule { a, b, radius_m } => {
            Some(Shade::Capsule { from: *a, to: *b, radius_m: *radius_m })
        }
        _ => None,
    }
}

/// Dose at the rim of the orifice while one bead passes, over the critical exposure, as the lights go on, and the
/// length printed after which they may.
pub(super) struct TipDose {
    /// The dose's share.
    pub(super) share: Interval,
    /// Where on the strand, m.
    pub(super) at_m: f64,
    /// From which length on the lights would do no harm, m; infinite: nowhere.
    pub(super) clear_after_m: f64,
}

/// The worst moment with lights on; `None` where there are none.
pub(super) fn tip_dose(
    job: &Job,
    course: &Course,
    resin: &Photopolymer,
    (diameter_m, speed_m_s): (f64, f64),
) -> Option<TipDose> {
    let length_m = course.length_m();
    // Stations lie millimetres apart: where the lights go on is one of its own.
    let begins: Vec<Station> =
        course.lit().iter().filter_map(|on| course.station_at(on[0])).collect();
    let lit: Vec<&Station> = course
        .stations
        .iter()
        .chain(&begins)
        .filter(|station| station.at_m <= length_m && course.lit_at(station.time_s))
        .collect();
    let height = |station: &Station| {
        let place = station.part_from_tool.translation.vector;
        (job.bed_from_part * Point::from(place)).z
    };
    let residence_s = diameter_m / speed_m_s;
    let albedo = job.cell.bed.albedo.unwrap_or(ALBEDO);
    let share_at = |station: &Station, bed_m: f64, corner: Corner| {
        let (mut lamps, shades) = on_tool(job, 0.5 * diameter_m, corner);
        let tool_from_room = station.part_from_tool.inverse() * station.part_from_room;
        lamps.extend(job.cell.lamps.iter().map(|lamp| of(lamp, corner).moved(&tool_from_room)));
        let tip = Tip { rim_m: 0.5 * job.cell.tool.orifice_m, lamps: &lamps, shades: &shades };
        // Bright lamps and a bright bed are the bad end here.
        let critical_j_m2 = corner.harmful(resin.critical_exposure_j_m2);
        let light = tip.light(bed_m, corner.helpful(albedo));
        (light.direct_w_m2 + light.reflected_w_m2) * residence_s / critical_j_m2
    };
    let (station, bed_m) = worst_height(&lit, height, |s, h| share_at(s, h, Corner::Nominal))?;
    let share = Interval::new(
        share_at(station, bed_m, Corner::Nominal),
        share_at(station, bed_m, Corner::Slow),
        share_at(station, bed_m, Corner::Fast),
    );
    let limit = job.limits.tip_dose_share;
    let clear_after_m = if share.nominal <= limit {
        0.0
    } else {
        let (lamps, shades) = on_tool(job, 0.5 * diameter_m, Corner::Nominal);
        let tip = Tip { rim_m: 0.5 * job.cell.tool.orifice_m, lamps: &lamps, shades: &shades };
        let limit_w_m2 = tip_limit_w_m2(limit, resin.critical_exposure_j_m2.nominal, residence_s);
        let clear_m = tip.clear_m(limit_w_m2, albedo.nominal, 0.2);
        let rise = (job.bed_from_part * station.tangent).z;
        station.at_m + lights_on_after_m(clear_m, bed_m, rise)
    };
    Some(TipDose { share, at_m: station.at_m, clear_after_m })
}

/// Heights above the bed at which light on the tip is looked at, up to [`FARTHEST_M`]; it peaks some millimetres up.
const LOOKS: usize = 10;
/// Past this height the bed throws nothing back that counts, m.
const FARTHEST_M: f64 = 0.03;

/// The lit station and height with most light on the tip: all heights passed with the lights on are looked at, not only
/// those of stations.
fn worst_height<'a>(
    lit: &[&'a Station],
    height: impl Fn(&Station) -> f64,
    share: impl Fn(&Station, f64) -> f64,
) -> Option<(&'a Station, f64)> {
    let nearest = lit.iter().min_by(|a, b| height(a).total_cmp(&height(b)))?;
    let low_m = height(nearest).max(1e-5);
    let high_m = lit.iter().map(|station| height(station)).fold(low_m, f64::max).min(FARTHEST_M);
    let looks =
        (0..LOOKS).map(|k| low_m + (high_m - low_m).max(0.0) * k as f64 / (LOOKS - 1) as f64);
    let at = |bed_m: f64| {
        let near = |station: &&&Station| (height(station) - bed_m).abs();
        let station = lit.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(nearest);
        (*station, bed_m)
    };
    let shares = looks.map(at).map(|(station, bed_m)| (station, bed_m, share(station, bed_m)));
    let (station, bed_m, _) = shares.max_by(|a, b| a.2.total_cmp(&b.2))?;
    Some((station, bed_m))
}
