//! What joints that turn evenly do to the speed of the TCP and to the bead.

use super::*;
use crate::finding::Phase;
use crate::process::bead::drawn_diameter_m;
use crate::test_job::{job, strand, text};
use crate::toolpath;

const PROCESS: &str = r#""process": { "speed_mm_s": 20, "flow": { "diameter_mm": 1.2 } },"#;
const LINE: [[f64; 3]; 2] = [[-160.0, -40.0, 1.0], [160.0, 120.0, 1.0]];

/// Rows of the two ends of a strand, found by the search.
fn rows(cell: &str) -> String {
    let job = job(&text(cell, PROCESS, &strand("a", &LINE, "")));
    let motion = plan(&job, &toolpath::paths(&job));
    let leg = motion.legs.iter().find(|leg| leg.phase == Phase::Print).expect("a print");
    let row = |moment: &Moment| {
        let degrees: Vec<f64> = moment.q.iter().map(|q| q.to_degrees()).collect();
        format!("{degrees:?}")
    };
    format!("[{}, {}]", row(&leg.moments[0]), row(leg.moments.last().expect("moments")))
}

/// Issue 3, row 10: the TCP's speed along the strand is that of the Jacobian at constant joint speed,
/// and the bead is what mass balance makes of it, both within one percent; the speeds differ enough
/// for that to mean something.
#[test]
fn joints_that_turn_evenly_move_the_tcp_as_the_jacobian_says() {
    let given = format!(r#", "interpolation": "joint", "joints": {}"#, rows("kr6-hot-end"));
    let job = job(&text("kr6-hot-end", PROCESS, &strand("a", &LINE, &given)));
    let paths = toolpath::paths(&job);
    let motion = plan(&job, &paths);
    let moved = &as_moved(&paths, &motion)[0];
    let rows = job.strands[0].joints.as_ref().expect("given rows");
    let length_m = paths[0].length_m;
    let samples = &moved.samples;
    let (mut slowest, mut fastest) = (f64::INFINITY, 0.0_f64);
    for k in 0..samples.len() - 1 {
        let at_m = (samples[k].at_m + samples[k + 1].at_m) / 2.0;
        let turn: Vec<f64> = rows[0].iter().zip(&rows[1]).map(|(a, b)| b - a).collect();
        let q: Vec<f64> =
            rows[0].iter().zip(&turn).map(|(a, turn)| a + turn * at_m / length_m).collect();
        let asked_m_s = paths[0].samples[k].speed_m_s;
        let rates: Vec<f64> = turn.iter().map(|turn| turn * asked_m_s / length_m).collect();
        // The tool is in line with the flange: the chain to its orifice says it all.
        let chain = job.cell.robot.arm.chain.with_tip(&job.cell.tool_pose);
        let twist = chain.jacobian(&q) * nalgebra::DVector::from_vec(rates);
        let predicted_m_s = twist.fixed_rows::<3>(0).norm();
        let speed_m_s = samples[k].speed_m_s;
        assert!((speed_m_s / predicted_m_s - 1.0).abs() < 0.01, "{at_m}: {speed_m_s}");
        let bead = drawn_diameter_m(samples[k].flow_m3_s, speed_m_s);
        let wanted = drawn_diameter_m(samples[k].flow_m3_s, predicted_m_s);
        assert!((bead / wanted - 1.0).abs() < 0.01, "{at_m}: {bead} m");
        slowest = slowest.min(predicted_m_s);
        fastest = fastest.max(predicted_m_s);
    }
    assert!(fastest / slowest > 1.1, "{slowest} to {fastest} m/s");
    // And by the clock: chords between moments over their times, away from the ramps.
    let leg = motion.legs.iter().find(|leg| leg.phase == Phase::Print).expect("a print");
    for pair in leg.moments.windows(2).skip(1).take(leg.moments.len() - 3) {
        let [a, b] = [&pair[0], &pair[1]].map(|moment| between::nozzle_at(&job, &moment.q).0);
        let speed_m_s = (b - a).norm() / (pair[1].time_s - pair[0].time_s);
        let k = samples.partition_point(|sample| sample.at_m < pair[0].at_m - 1e-12);
        assert!((speed_m_s / samples[k].speed_m_s - 1.0).abs() < 0.01, "{}", pair[0].at_m);
    }
}
