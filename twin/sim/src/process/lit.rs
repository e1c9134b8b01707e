//! What the lights make of a strand along its length: dose, cured shell, gel age, degree of cure.

use super::course::Course;
use super::cured::Cured;
use super::dose::{AZIMUTHS, Run, Segment, SegmentDose, Strand, add_run};
use super::history::Corner;
use super::lights::{Lights, Station};
use super::lit_cure::{Curing, Pass, Place, Warmth, curing};
use super::material::Photopolymer;
use super::through::{Inside, Section};
use crate::interval::Interval;
use stations::{middles, own_segments, second_pass, stations};

mod stations;

/// Light and what it leaves, segment by segment; intervals at corners of lamps, critical exposure and
/// penetration.
#[derive(Debug, Clone, PartialEq)]
pub struct Lit {
    /// Middle of each segment, m.
    pub at_m: Vec<f64>,
    /// Mean dose on its surface, J/m².
    pub dose_j_m2: Vec<Interval>,
    /// Depth cured at its least lit side, m.
    pub depth_m: Vec<Interval>,
    /// Age at which its surface gels, s; infinite if never.
    pub gel_s: Vec<Interval>,
    /// Share of the section cured, mean of the length.
    pub area_fraction: Interval,
    /// Share of the bending stiffness cured, mean of the length.
    pub stiffness_fraction: Interval,
    /// Depth after the post-cure that the job declares, least of the length, m.
    pub post_cured_m: Option<Interval>,
    /// Greatest degree of cure at the surface of the middle segment, and when it began, s; where kinetics are known.
    pub cure: Option<Cured>,
    /// Greatest temperature in the middle segment as it cures, K; where kinetics and heat of reaction are known.
    pub warmest_k: Option<Interval>,
}

/// What is asked of the lights.
#[derive(Clone, Copy)]
pub struct Exposure<'a> {
    /// Lamps and shades at a corner of the lamps.
    pub lights: &'a dyn Fn(Corner) -> Lights,
    /// Radius of the strand, m.
    pub radius_m: f64,
    /// Length of the strand, m.
    pub length_m: f64,
    /// Speed of a second pass with the lights on, m/s.
    pub second_pass_m_s: Option<f64>,
    /// Dose of a post-cure from all around, J/m².
    pub post_cure_j_m2: Option<f64>,
    /// Whether it lies on something: its underside is then not held against it, and depth is that of the even shell
    /// of the same area.
    pub resting: bool,
    /// Temperature of the strand, K.
    pub temperature_k: f64,
    /// What its heat of cure goes into and where it goes; `None`: the strand stays at its temperature.
    pub warmth: Option<Warmth<'a>>,
}

/// Light on a strand and what it cures. Nominal and slow corners take light inside the strand as bent square to its
/// surface (Jacobs), the fast one as straight: the truth lies between.
pub fn shine(course: &Course, resin: &Photopolymer, exposure: &Exposure) -> Lit {
    let stations = stations(course, exposure.length_m);
    let corners = [Corner::Nominal, Corner::Fast, Corner::Slow];
    let mut made = corners.map(|corner| at_corner(course, resin, exposure, &stations, corner));
    let n = made[0].len();
    let [nominal, fast, slow] = std::array::from_fn(|k| {
        let curing = warm(resin, exposure, &mut made[k], corners[k]);
        curing.filter(|curing| k == 0 || curing.warmest_k.is_some())
    });
    let warmest = |curing: &Option<Curing>| curing.as_ref().and_then(|curing| curing.warmest_k);
    let warmest_k = warmest(&nominal).map(|nominal_k| {
        // A corner at which it never gels makes no heat that is told of.
        let [fast_k, slow_k] = [&fast, &slow].map(warmest);
        let air_k = exposure.temperature_k;
        Interval::new(nominal_k, fast_k.unwrap_or(air_k), slow_k.unwrap_or(air_k))
    });
    let of = |value: &dyn Fn(&Made) -> f64| -> Vec<Interval> {
        let at = |k: usize| made.each_ref().map(|corner| value(&corner[k]));
        (0..n).map(at).map(|[nominal, fast, slow]| Interval::new(nominal, fast, slow)).collect()
    };
    let mean = |value: &dyn Fn(&Made) -> f64| {
        let [nominal, fast, slow] =
            made.each_ref().map(|corner| corner.iter().map(value).sum::<f64>() / n.max(1) as f64);
        Interval::new(nominal, fast, slow)
    };
    let post_cured_m = exposure.post_cure_j_m2.map(|_| {
        let least = |corner: &Vec<Made>| {
            corner.iter().map(|m| m.post_cured_m).fold(exposure.radius_m, f64::min)
        };
        let [nominal, fast, slow] = made.each_ref().map(least);
        Interval::new(nominal, fast, slow)
    });
    Lit {
        at_m: middles(&stations, exposure.length_m, n),
        dose_j_m2: of(&|m| m.dose_j_m2),
        depth_m: of(&|m| m.depth_m),
        gel_s: of(&|m| m.gel_s),
        area_fraction: mean(&|m| m.area),
        stiffness_fraction: mean(&|m| m.stiffness),
        post_cured_m,
        cure: nominal.map(|curing| curing.cure),
        warmest_k,
    }
}

/// One segment at one corner.
#[derive(Debug, Clone, Copy)]
struct Made {
    dose_j_m2: f64,
    depth_m: f64,
    gel_s: f64,
    area: f64,
    stiffness: f64,
    post_cured_m: f64,
    lit_s: f64,
    irradiance_w_m2: f64,
    /// Light of the second pass alone; of the middle segment.
    second: Option<Pass>,
}

fn at_corner(
    course: &Course,
    resin: &Photopolymer,
    exposure: &Exposure,
    stations: &[Station],
    corner: Corner,
) -> Vec<Made> {
    let mut lights = (exposure.lights)(corner);
    for set in &mut lights.sets {
        set.on_s = course.lit();
    }
    let critical_j_m2 = corner.harmful(resin.critical_exposure_j_m2);
    let strand = Strand { radius_m: exposure.radius_m, critical_j_m2, azimuths: AZIMUTHS };
    let run = Run { stations, dwell_s: course.dwell_s, lights: &lights };
    let own = own_segments(stations, exposure.length_m, course);
    let mut doses = vec![SegmentDose::dark(AZIMUTHS); own.len()];
    add_run(&own, &mut doses, &run, &strand);
    let mut second = None;
    if let Some(speed_m_s) = exposure.second_pass_m_s {
        let again = second_pass(stations, course, speed_m_s);
        for set in &mut lights.sets {
            set.on_s = vec![super::lights::ALWAYS];
        }
        let run = Run { stations: &again, dwell_s: 0.0, lights: &lights };
        add_run(&own, &mut doses, &run, &strand);
        if resin.kinetics.is_some() && (resin.oxygen.is_some() || exposure.warmth.is_some()) {
            second = own.get(own.len() / 2).and_then(|segment| alone(segment, &run, &strand));
        }
    }
    let penetration_m = corner.helpful(resin.penetration_m);
    let inside = if corner == Corner::Fast { Inside::Straight } else { Inside::Radial };
    let section = |doses: &[f64]| {
        let radius_m = exposure.radius_m;
        let skin_m = resin.tacky_skin_m.map_or(0.0, |skin_m| corner.harmful(skin_m));
        Section { radius_m, penetration_m, critical_j_m2, doses_j_m2: doses, inside }
            .cured_under(skin_m)
    };
    doses
        .iter()
        .map(|dose| {
            let given =
                if inside == Inside::Straight { &dose.beam_j_m2 } else { &dose.surface_j_m2 };
            let cured = section(given);
            let post_cured_m = exposure.post_cure_j_m2.map_or(0.0, |extra| {
                let all: Vec<f64> = dose.surface_j_m2.iter().map(|own| own + extra).collect();
                let radial = Section {
                    radius_m: exposure.radius_m,
                    penetration_m,
                    critical_j_m2,
                    doses_j_m2: &all,
                    inside: Inside::Radial,
                };
                radial.cured().least_depth_m
            });
            Made {
                dose_j_m2: dose.mean_j_m2(),
                depth_m: if exposure.resting { cured.mean_depth_m } else { cured.least_depth_m },
                gel_s: dose.mean_gel_s,
                area: cured.area_fraction,
                stiffness: cured.stiffness_fraction,
                post_cured_m,
                lit_s: dose.lit_s(),
                irradiance_w_m2: dose.peak_w_m2,
                second,
            }
        })
        .collect()
}

/// The light of a run on one segment alone; `None` where it stays dark.
fn alone(segment: &Segment, run: &Run, strand: &Strand) -> Option<Pass> {
    let mut dose = [SegmentDose::dark(AZIMUTHS)];
    add_run(std::slice::from_ref(segment), &mut dose, run, strand);
    let [dose] = dose;
    let irradiance_w_m2 = dose.peak_w_m2;
    let apart = |station: &&Station| (station.point - segment.middle).norm();
    let near = run.stations.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let from_s = if dose.mean_gel_s.is_finite() {
        dose.mean_gel_s - strand.critical_j_m2 / irradiance_w_m2
    } else {
        near.time_s - segment.born_s
    };
    (irradiance_w_m2 > 0.0).then_some(Pass { from_s, lit_s: dose.lit_s(), irradiance_w_m2 })
}

/// Cure of the middle segment; where it warms, all gel so much sooner after their light begins.
fn warm(
    resin: &Photopolymer,
    exposure: &Exposure,
    made: &mut [Made],
    corner: Corner,
) -> Option<Curing> {
    let law = resin.kinetics?;
    if corner != Corner::Nominal
        && (exposure.warmth.is_none() || resin.reaction_heat_j_kg.is_none())
    {
        return None;
    }
    let middle = made.get(made.len() / 2)?;
    if !(middle.irradiance_w_m2 > 0.0) || !middle.gel_s.is_finite() {
        return None;
    }
    let critical_j_m2 = corner.harmful(resin.critical_exposure_j_m2);
    let begun_s = |made: &Made| (made.gel_s - critical_j_m2 / made.irradiance_w_m2).max(0.0);
    let irradiance_w_m2 = middle.irradiance_w_m2;
    let whole = Pass { from_s: begun_s(middle), lit_s: middle.lit_s, irradiance_w_m2 };
    let second = middle.second.filter(|second| second.from_s > middle.gel_s);
    let twice = second.and_then(|second| {
        // What the second pass did not give, the first did.
        let first_j_m2 = middle.dose_j_m2 - second.lit_s * second.irradiance_w_m2;
        let lit_s = (first_j_m2 / irradiance_w_m2).min(second.from_s - whole.from_s);
        (lit_s > 0.0).then_some([Pass { lit_s, ..whole }, second])
    });
    let place = Place {
        radius_m: exposure.radius_m,
        temperature_k: exposure.temperature_k,
        whole,
        twice,
        warmth: exposure.warmth,
    };
    let curing = curing(law, resin, &place, corner);
    if curing.warmest_k.is_some() {
        for made in made.iter_mut().filter(|made| made.gel_s.is_finite()) {
            let from_s = begun_s(made);
            made.gel_s = from_s + (made.gel_s - from_s) * curing.sooner;
        }
    }
    Some(curing)
}

impl Lit {
    /// The least cured place: its arc length, m, and the depth there.
    pub fn least(&self) -> Option<(f64, Interval)> {
        let least = (0..self.depth_m.len())
            .min_by(|&a, &b| self.depth_m[a].nominal.total_cmp(&self.depth_m[b].nominal))?;
        Some((self.at_m[least], self.depth_m[least]))
    }

    /// Age at which half of the strand's length gels sooner, s.
    pub fn median_gel_s(&self) -> Interval {
        let median = |end: fn(&Interval) -> f64| {
            let mut ages: Vec<f64> = self.gel_s.iter().map(end).collect();
            ages.sort_by(f64::total_cmp);
            ages.get(ages.len() / 2).copied().unwrap_or(f64::INFINITY)
        };
        Interval::new(median(|age| age.nominal), median(|age| age.low), median(|age| age.high))
    }
}
