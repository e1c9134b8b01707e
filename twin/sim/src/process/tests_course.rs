//! Laws that follow a strand along its course, against the closed forms and against themselves.

use super::course::{Course, Station, Told};
use super::history::Corner;
use super::lamp::{Lobe, RingPlace};
use super::lights::{ALWAYS, Carrier, LampSet, Lights};
use super::lit::{Exposure, Lit, shine};
use super::soft_rod::sag;
use super::tests_strand::{gel_strand, pla, resin, ring, strand};
use super::*;
use crate::pose::{Point, Pose, Vector};

/// A straight way along x at a steady speed; the nozzle points down, the tool's axes are turned with it.
pub(super) fn straight(
    length_m: f64,
    speed_m_s: f64,
    gravity_m_s2: Vector,
    tangent: Vector,
) -> Course {
    let n = 61;
    let station = |k: usize| {
        let at_m = length_m * k as f64 / (n - 1) as f64;
        let point = Point::from(tangent * at_m);
        let down = crate::pose::from_z_axis(point, -tangent, Vector::new(0.3, 0.7, 0.1));
        Station {
            at_m,
            time_s: at_m / speed_m_s,
            point,
            tangent,
            gravity_m_s2,
            part_from_tool: down,
            part_from_room: Pose::identity(),
        }
    };
    Course {
        stations: (0..n).map(station).collect(),
        flow: vec![Told { from_s: 0.0, value: 1e-8 }],
        light: vec![Told { from_s: 0.0, value: true }],
        dwell_s: 0.0,
    }
}

pub(super) const DOWN: Vector = Vector::new(0.0, 0.0, -9.806_65);

#[test]
fn the_rod_agrees_with_the_closed_form_where_both_hold() {
    let material = pla();
    let input = StrandInput { fidelity: Fidelity::Full, ..strand() };
    let heats = Heats::new(&input, &material);
    let closed = simulate_with(&input, &material, &heats).sag_nozzle_m;
    let course = straight(input.length_m, input.speed_m_s, DOWN, Vector::x());
    for (corner, want_m) in [(Corner::Nominal, closed.nominal), (Corner::Fast, closed.low)] {
        let rod = sag(&input, &course, &material, &heats, [0.0, 0.06], corner).expect("it sags");
        let ratio = rod.greatest_m / want_m;
        assert!((0.93..1.07).contains(&ratio), "{corner:?}: {ratio}");
    }
}

#[test]
fn gravity_along_the_strand_does_not_bend_it_and_its_turn_turns_the_sag() {
    let material = pla();
    let input = StrandInput { fidelity: Fidelity::Full, ..strand() };
    let heats = Heats::new(&input, &material);
    let of = |gravity_m_s2: Vector| {
        let course = straight(input.length_m, input.speed_m_s, gravity_m_s2, Vector::x());
        sag(&input, &course, &material, &heats, [0.0, 0.06], Corner::Nominal).expect("it sags")
    };
    assert!(of(Vector::new(9.8, 0.0, 0.0)).greatest_m < 1e-12);
    let (down, aside) = (of(DOWN), of(Vector::new(0.0, 9.806_65, 0.0)));
    assert!((down.greatest_m / aside.greatest_m - 1.0).abs() < 1e-9);
    let middle = |sagged: &soft_rod::Sagged| sagged.offset_at(0.03);
    assert!(middle(&down)[2] < 0.0 && (middle(&down)[2] + middle(&aside)[1]).abs() < 1e-12);
}

#[test]
fn a_strand_too_hot_to_stiffen_hangs_down_from_where_it_is_held() {
    let material = pla();
    let still = StrandInput {
        fidelity: Fidelity::Full,
        ends: Ends::StartHeld,
        air: Air { jet: None, room_m_s: 0.0, temperature_k: 380.0, blown: None },
        ..strand()
    };
    let heats = Heats::new(&still, &material);
    let course = straight(still.length_m, still.speed_m_s, DOWN, Vector::x());
    let rod =
        sag(&still, &course, &material, &heats, [0.0, 0.06], Corner::Nominal).expect("it sags");
    // Past small slopes, below hanging straight down at twice its length.
    assert!(rod.greatest_m > 0.3 * 0.06 && rod.greatest_m < 5.0_f64.sqrt() * 0.06);
    let tip = rod.offset_at(0.06);
    assert!(tip[2] < -0.9 * 0.06 && tip[0] < -0.5 * 0.06 && tip[1].abs() < 1e-9, "{tip:?}");
    assert_eq!(rod.offset_at(0.0), [0.0; 3]);
}

fn lit(course: &Course, second_pass_m_s: Option<f64>, post_cure_j_m2: Option<f64>) -> Lit {
    let Setting::Photopolymer(resin) = resin().setting else { panic!("a resin") };
    let ring = ring();
    let exposure = Exposure {
        lights: &|corner: Corner| {
            let place = RingPlace::of(&ring, ring.aim_m);
            let peak_w_sr = corner.helpful(ring.intensity_w_sr);
            let lamps = place.lamps(peak_w_sr, ring.full_angle_rad, Lobe::Gaussian);
            let set = LampSet { carrier: Carrier::Tool, lamps, on_s: vec![ALWAYS] };
            Lights { sets: vec![set], shades: Vec::new() }
        },
        radius_m: 1.4e-3,
        length_m: 0.06,
        second_pass_m_s,
        post_cure_j_m2,
        resting: false,
        temperature_k: 298.15,
        warmth: None,
    };
    shine(course, &resin, &exposure)
}

#[test]
fn light_goes_with_time_adds_up_over_passes_and_is_nought_in_the_dark() {
    let speed_m_s = gel_strand().speed_m_s;
    let course = straight(0.06, speed_m_s, DOWN, Vector::z());
    let middle = |lit: &Lit| lit.dose_j_m2[lit.dose_j_m2.len() / 2].nominal;
    let once = lit(&course, None, None);
    let slower = lit(&straight(0.06, speed_m_s / 2.0, DOWN, Vector::z()), None, None);
    assert!((middle(&slower) / middle(&once) - 2.0).abs() < 0.02, "{}", middle(&slower));
    // The second pass shines on all of it, the first only on what is there already.
    let twice = lit(&course, Some(speed_m_s), None);
    let added = middle(&twice) - middle(&once);
    assert!(added > 0.9 * middle(&once) && added < 2.5 * middle(&once), "{added}");
    let dark = lit(&Course { light: Vec::new(), ..course.clone() }, None, None);
    assert!(dark.dose_j_m2.iter().all(|dose| dose.high == 0.0));
    assert!(dark.gel_s.iter().all(|age| age.low.is_infinite()));
    assert_eq!(dark.least().expect("segments").1.high, 0.0);
}

#[test]
fn a_post_cure_deep_enough_leaves_nothing_uncured() {
    let course = straight(0.06, gel_strand().speed_m_s, DOWN, Vector::z());
    let shallow = lit(&course, None, Some(1.0)).post_cured_m.expect("declared");
    let deep = lit(&course, None, Some(1e9)).post_cured_m.expect("declared");
    assert!(shallow.nominal < 1.4e-3);
    assert!((deep.low - 1.4e-3).abs() < 1e-9, "{}", deep.low);
}

#[test]
fn moving_part_and_room_together_changes_no_light() {
    let course = straight(0.06, 0.002, DOWN, Vector::z());
    let shift = crate::pose::from_xyz_rpy([0.3, -0.2, 0.7], [0.4, -1.0, 2.0]);
    let moved = Course {
        stations: course
            .stations
            .iter()
            .map(|station| Station {
                point: shift * station.point,
                tangent: shift * station.tangent,
                gravity_m_s2: shift * station.gravity_m_s2,
                part_from_tool: shift * station.part_from_tool,
                part_from_room: shift * station.part_from_room,
                ..*station
            })
            .collect(),
        ..course.clone()
    };
    let (here, there) = (lit(&course, None, None), lit(&moved, None, None));
    for (a, b) in here.dose_j_m2.iter().zip(&there.dose_j_m2) {
        assert!((a.nominal - b.nominal).abs() <= 1e-6 * a.nominal, "{a:?} {b:?}");
    }
}
