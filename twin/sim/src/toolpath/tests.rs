use proptest::prelude::*;

use super::*;
use crate::cell::{Orientation, Spin, Tilt};
use crate::test_job::{job, strand, text};

fn orientation(tilt: Tilt) -> Orientation {
    Orientation {
        follow: Follow::Tangent,
        tilt,
        tilt_from_rad: 20f64.to_radians(),
        tilt_max_rad: 40f64.to_radians(),
        tilt_free_rad: 0.0,
        spin: Spin::Free,
    }
}

/// A direction of travel that rises `psi` from up, towards `azimuth` in the bed's plane.
fn rising(psi_deg: f64, azimuth_deg: f64) -> Vector {
    let (psi, azimuth) = (psi_deg.to_radians(), azimuth_deg.to_radians());
    Vector::new(psi.sin() * azimuth.cos(), psi.sin() * azimuth.sin(), psi.cos())
}

/// Kirkman: upright up to 20°, then the angle of the strand less 20°, at most 40°.
#[test]
fn cone_tilt_follows_its_law() {
    let law = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (30.0, 10.0), (45.0, 25.0), (60.0, 40.0)];
    for (psi_deg, tilt_deg) in law.into_iter().chain([(90.0, 40.0), (150.0, 40.0)]) {
        for azimuth_deg in [0.0, 77.0, 200.0] {
            let travel = rising(psi_deg, azimuth_deg);
            let nozzle = tilted(travel, Vector::z(), Vector::x(), &orientation(Tilt::Cone));
            let wanted = -rising(tilt_deg, azimuth_deg);
            assert!((nozzle - wanted).norm() < 1e-12, "{psi_deg}° to {azimuth_deg}°: {nozzle}");
        }
    }
}

/// Each axis by itself: in a plane of the bed's axes as the cone, on the diagonal further out.
#[test]
fn per_axis_tilt_follows_its_law_about_both_axes() {
    let tilt = |travel| tilted(travel, Vector::z(), Vector::x(), &orientation(Tilt::PerAxis));
    for (psi_deg, tilt_deg) in [(0.0, 0.0), (15.0, 0.0), (35.0, 15.0), (50.0, 30.0), (75.0, 40.0)] {
        for azimuth_deg in [0.0, 90.0, 180.0, 270.0] {
            let nozzle = tilt(rising(psi_deg, azimuth_deg));
            let wanted = -rising(tilt_deg, azimuth_deg);
            assert!((nozzle - wanted).norm() < 1e-12, "{psi_deg}° to {azimuth_deg}°: {nozzle}");
        }
    }
    // A level strand on the diagonal: 40° about both axes.
    let both = 40f64.to_radians().tan();
    let wanted = -Vector::new(both, both, 1.0).normalize();
    assert!((tilt(rising(90.0, 45.0)) - wanted).norm() < 1e-12);
}

#[test]
fn a_turned_bed_turns_the_tilt_with_it() {
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.4, 1.1);
    for kind in [Tilt::Cone, Tilt::PerAxis] {
        let (travel, law) = (rising(63.0, 30.0), orientation(kind));
        let straight = tilted(travel, Vector::z(), Vector::x(), &law);
        let turned = tilted(turn * travel, turn * Vector::z(), turn * Vector::x(), &law);
        assert!((turn * straight - turned).norm() < 1e-12);
    }
}

fn path_of(points_mm: &[[f64; 3]], more: &str) -> Path {
    let job = job(&text("kr10-cone", "", &strand("a", points_mm, more)));
    paths(&job).remove(0)
}

#[test]
fn samples_are_even_and_include_ends_and_corners() {
    let path = path_of(&[[0.0, 0.0, 1.0], [30.0, 0.0, 1.0], [30.0, 17.0, 1.0]], "");
    assert!((path.length_m - 0.047).abs() < 1e-15);
    let at = |at_m: f64| path.samples.iter().any(|sample| (sample.at_m - at_m).abs() < 1e-12);
    assert!(at(0.0) && at(0.03) && at(0.047));
    // 30 mm in 8 steps, 17 mm in 5
    assert_eq!(path.samples.len(), 14);
    for pair in path.samples.windows(2) {
        assert!(pair[1].at_m - pair[0].at_m <= STEP_M + 1e-12);
    }
    assert_eq!(path.samples[13].point, Point::new(0.03, 0.017, 1e-3));
}

#[test]
fn the_overrun_goes_straight_on_without_flow() {
    let path = path_of(&[[0.0, 0.0, 1.0], [10.0, 0.0, 5.0]], r#", "overrun_mm": 6"#);
    let (printed, over): (Vec<Sample>, Vec<Sample>) =
        path.samples.iter().partition(|sample| sample.at_m <= path.length_m);
    let end = printed[printed.len() - 1];
    assert_eq!(end.point, Point::new(0.01, 0.0, 5e-3));
    assert!(printed.iter().all(|sample| sample.flow_m3_s > 0.0));
    assert_eq!(over.len(), 2);
    for sample in &over {
        assert_eq!((sample.flow_m3_s, sample.speed_m_s), (0.0, end.speed_m_s));
        let further = end.point + end.tangent * (sample.at_m - path.length_m);
        assert!((sample.point - further).norm() < 1e-15);
    }
    assert!((over[1].at_m - path.length_m - 6e-3).abs() < 1e-15);
}

#[test]
fn a_profile_changes_speed_and_flow_where_it_says() {
    let more = r#", "speed_mm_s": 2, "flow": { "diameter_mm": 2 },
        "profile": [{ "at_mm": 10.5, "speed_mm_s": 5 }, { "at_mm": 21.3, "flow_mm3_s": 9 }]"#;
    let path = path_of(&[[0.0, 0.0, 1.0], [40.0, 0.0, 1.0]], more);
    let told = std::f64::consts::PI * 1e-6 * 2e-3;
    for sample in &path.samples {
        let speed_m_s = if sample.at_m < 10.5e-3 - 1e-12 { 2e-3 } else { 5e-3 };
        let flow_m3_s = if sample.at_m < 21.3e-3 - 1e-12 { told } else { 9e-9 };
        assert_eq!(sample.speed_m_s, speed_m_s, "at {}", sample.at_m);
        assert!((sample.flow_m3_s - flow_m3_s).abs() < 1e-20, "at {}", sample.at_m);
    }
    // both changes are places where it is looked
    for at_m in [10.5e-3, 21.3e-3] {
        assert!(path.samples.iter().any(|sample| (sample.at_m - at_m).abs() < 1e-12), "{at_m}");
    }
}

/// One row of joints per point: a sample more or less would shift all rows after it.
#[test]
fn a_strand_with_joints_is_sampled_at_its_points_alone() {
    let points_mm: Vec<[f64; 3]> = (0..30).map(|k| [0.3 * f64::from(k), 0.0, 1.0]).collect();
    let rows = vec!["[0, -90, 90, 0, 90, 0]"; points_mm.len()].join(", ");
    let path = path_of(&points_mm, &format!(", \"joints\": [{rows}]"));
    assert_eq!(path.samples.len(), points_mm.len());
    for (sample, point) in path.samples.iter().zip(&points_mm) {
        assert!((sample.point - Point::from(point.map(|mm| mm / 1e3))).norm() < 1e-12);
    }
}

/// Off a form, surface normals are those of the form's own facets, turned up.
#[test]
fn surface_normals_come_from_the_form() {
    let roof = slam::mesh::Mesh {
        vertices: vec![
            [0.0, 0.0, 0.0],
            [100.0, 0.0, 50.0],
            [0.0, 100.0, 0.0],
            [100.0, 100.0, 50.0],
        ],
        triangles: vec![[0, 1, 2], [1, 2, 3]],
    };
    let more = r#""forms": [{ "id": "roof", "mesh": "roof.stl" }],"#;
    let points_mm = [[20.0, 10.0, 11.0], [80.0, 90.0, 41.0]];
    let follow = r#", "on": "roof", "orientation": { "follow": "surface_normal" }"#;
    let text = text("kr10-cone", more, &strand("a", &points_mm, follow));
    let job = crate::test_job::try_job(&text, &[roof]).expect("a sound job");
    let down = -Vector::new(-0.5, 0.0, 1.0).normalize();
    for sample in &paths(&job)[0].samples {
        assert!((sample.nozzle - down).norm() < 1e-6, "{}", sample.nozzle);
    }
}

fn polyline() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let step = (0.05..20.0f64, -3.0..3.0f64, -1.2..1.2f64);
    prop::collection::vec(step, 1..25).prop_map(|steps| {
        let mut points = vec![[0.0, 0.0, 100.0]];
        for (length, turn, rise) in steps {
            let [x, y, z] = points[points.len() - 1];
            let flat = length * f64::cos(rise);
            points.push([x + flat * turn.cos(), y + flat * turn.sin(), z + length * rise.sin()]);
        }
        points
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// No two samples are further apart than the step, all lie on the line at their arc length.
    #[test]
    fn samples_keep_their_distance(points_mm in polyline()) {
        let path = path_of(&points_mm, "");
        let points: Vec<Point> = points_mm.iter().map(|p| Point::from(p.map(|mm| mm / 1e3))).collect();
        let stations = stations(&points);
        prop_assert_eq!(path.samples[0].at_m, 0.0);
        let last = path.samples[path.samples.len() - 1];
        prop_assert!((last.at_m - stations[stations.len() - 1]).abs() < 1e-12);
        for pair in path.samples.windows(2) {
            let gap_m = pair[1].at_m - pair[0].at_m;
            prop_assert!(gap_m > 0.0 && gap_m <= STEP_M + 1e-12, "gap {gap_m}");
        }
        for sample in &path.samples {
            let k = stations.partition_point(|&at_m| at_m < sample.at_m).clamp(1, points.len() - 1);
            let along = (points[k] - points[k - 1]).normalize();
            let wanted = points[k - 1] + along * (sample.at_m - stations[k - 1]);
            prop_assert!((sample.point - wanted).norm() < 1e-12);
            prop_assert!((sample.nozzle.norm() - 1.0).abs() < 1e-12);
        }
    }
}
