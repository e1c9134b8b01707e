//! Frames near their critical load: structures.md, section 2, B.

use super::*;

const HELD: [bool; 3] = [true, true, true];
const PINNED: [bool; 3] = [true, true, false];

/// W14x48 of 28 ft upright, inches and kips, bent about its strong axis; q across its length.
fn w14x48(area: f64, q: f64) -> (Frame, f64) {
    let length = 336.0;
    let frame = legs(&[[0.0, 0.0], [0.0, length]], section(area, 484.0, 1.45), 29e3, 8);
    let heavy = frame.members().iter().map(|m| Member { density_kg_m3: q / area, ..*m }).collect();
    (Frame::new(frame.nodes().to_vec(), heavy).unwrap(), length)
}

/// The column as it is against print; without shortening (P/E A is 1e-3) against the closed form,
/// whose own neglect of finite slopes is 1e-4.
const AREAS: [f64; 2] = [14.1, 14.1e3];

/// AISC 360 commentary, P-Delta case 1: pinned column of 28 ft under 0.2 k/ft across, axial load P.
///
/// The printed deflections are those without shear: `5 q L⁴/384 E I` is their 0.197. Closed:
/// `M = q (sec(k L/2) - 1)/k²`, k² = P/E I.
#[test]
fn b13_aisc_case_1() {
    let q = 0.2 / 12.0;
    let printed =
        [(0.0, 235.0, 0.197), (150.0, 269.0, 0.224), (300.0, 313.0, 0.261), (450.0, 375.0, 0.311)];
    for (p, moment, deflection) in printed {
        let [real, stiff] = AREAS.map(|area| {
            let (frame, _) = w14x48(area, q);
            let supports = in_plane(&frame, &[(0, PINNED), (1, [true, false, false])]);
            let load =
                Load { gravity_m_s2: [1.0, 0.0, 0.0], ..pushed(1, [0.0, -p, 0.0, 0.0, 0.0, 0.0]) };
            let path = path(&frame, &supports, &load, &Options::default());
            (path.local_end_forces[4][5].abs(), path.displacement[along(2, 8, 0, 4)][0])
        });
        eprintln!("B13.1 P {p}: M {:.2} ({moment}), d {:.4} ({deflection})", real.0, real.1);
        near(real.0, moment, 0.03);
        near(real.1, deflection, 0.05);
        let k = (p / (29e3 * 484.0)).sqrt();
        let closed = if p > 0.0 {
            q * (1.0 / (k * 168.0).cos() - 1.0) / (k * k)
        } else {
            q * 336.0 * 336.0 / 8.0
        };
        near(stiff.0, closed, 3e-4);
    }
}

/// P-Delta case 2: cantilever of 28 ft, 1 k across at the tip. `M = H L tan α/α`,
/// `y = H L³/3EI · 3 (tan α - α)/α³`, `α² = P L²/E I`.
#[test]
fn b13_aisc_case_2() {
    let printed =
        [(0.0, 336.0, 0.901), (100.0, 469.0, 1.33), (150.0, 598.0, 1.75), (200.0, 848.0, 2.56)];
    for (p, moment, deflection) in printed {
        let [real, stiff] = AREAS.map(|area| {
            let (frame, _) = w14x48(area, 0.0);
            let supports = in_plane(&frame, &[(0, HELD)]);
            let load = pushed(1, [1.0, -p, 0.0, 0.0, 0.0, 0.0]);
            let path = path(&frame, &supports, &load, &Options::default());
            (path.reactions.last().unwrap()[5].abs(), path.displacement[1][0])
        });
        eprintln!("B13.2 P {p}: M {:.2} ({moment}), d {:.4} ({deflection})", real.0, real.1);
        near(real.0, moment, 0.03);
        near(real.1, deflection, 0.05);
        let length = 336.0f64;
        let bend = length.powi(3) / (3.0 * 29e3 * 484.0);
        let alpha = (p * length * length / (29e3 * 484.0)).sqrt();
        if p > 0.0 {
            near(stiff.0, length * alpha.tan() / alpha, 3e-4);
            near(stiff.1, bend * 3.0 * (alpha.tan() - alpha) / alpha.powi(3), 3e-4);
        } else {
            near(stiff.1, bend, 3e-4);
        }
    }
}

/// Two bars of span 2 a and rise h under a load at the top. Engineering strain is the element's own:
/// `P = 2 E A (1 - c₀^⅔)^1.5`, c₀ = a/L₀, at `w = h - a tan acos c₀^⅓`.
#[test]
fn b14_von_mises_truss() {
    let (a, h, ea) = (1000.0f64, 100.0f64, 1e6);
    // bars: their stiffness in bending is 1e-15 of that of the truss
    // one bar of the two, by symmetry, pinned at both ends and stiff enough not to bow
    let frame = legs(&[[-a, 0.0], [0.0, h]], section(1.0, 1e3, 1e3), ea, 1);
    let supports = in_plane(&frame, &[(0, PINNED), (1, [true, false, false])]);
    let (factor, path) = limit(&frame, &supports, &pushed(1, [0.0, -0.5, 0.0, 0.0, 0.0, 0.0]), 1e4);
    let c0 = a / a.hypot(h);
    let wanted = 2.0 * ea * (1.0 - c0.powf(2.0 / 3.0)).powf(1.5);
    near(wanted, 381.08719, 1e-8);
    near(factor, wanted, 1e-8);
    near(-path.displacement[1][1], h - a * c0.cbrt().acos().tan(), 1e-4);
    eprintln!(
        "B14: {factor:.8} (closed {wanted:.8}) at {:.5}, {} iterations",
        -path.displacement[1][1], path.iterations
    );
}

/// Lee's frame: two legs of 120, pinned, loaded at a fifth of the beam.
#[test]
fn b15_lee_frame() {
    let mut found = Vec::new();
    for parts in [5, 10, 20] {
        let corners = [[0.0, 0.0], [0.0, 120.0], [120.0, 120.0]];
        let frame = legs(&corners, section(6.0, 2.0, 2.0), 720.0, parts);
        let supports = in_plane(&frame, &[(0, PINNED), (2, PINNED)]);
        let node = along(3, parts, 1, parts / 5);
        let load = pushed(node, [0.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
        let (factor, path) = limit(&frame, &supports, &load, 10.0);
        let down = -path.displacement[node][1];
        eprintln!("B15 {parts}: {factor:.5} at {down:.3}, {} iterations", path.iterations);
        near(factor, 1.8557, 5e-3);
        near(down, 48.7, 5e-3);
        found.push(factor);
    }
    // two other programs' 10, 20 and 40 elements, taken to the limit, give 1.8557
    near(found[2], 1.8557, 3e-5);
    assert!((found[0] - found[1]).abs() > 8.0 * (found[1] - found[2]).abs(), "{found:?}");
}

/// Through both limit points and back up: the load falls below zero and rises again.
#[test]
fn b15_lee_frame_to_the_end() {
    let parts = 10;
    let corners = [[0.0, 0.0], [0.0, 120.0], [120.0, 120.0]];
    let frame = legs(&corners, section(6.0, 2.0, 2.0), 720.0, parts);
    let supports = in_plane(&frame, &[(0, PINNED), (2, PINNED)]);
    let node = along(3, parts, 1, parts / 5);
    let options =
        Options { until: 2.5, past_critical: true, watch: vec![node], ..Options::default() };
    let load = pushed(node, [0.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
    let path = nonlinear(&frame, &supports, &load, &[], &options).unwrap();
    assert!(matches!(path.outcome, Outcome::LimitPoint { .. }), "{:?}", path.outcome);
    assert_eq!(path.factor, 2.5);
    let least = path.points.iter().fold(f64::INFINITY, |least, point| least.min(point.factor));
    assert!(least < -0.9 && least > -1.0, "{least}");
    assert_eq!(path.points.last().unwrap().unstable, 0);
    assert!(path.points.iter().any(|point| point.unstable == 1));
    eprintln!(
        "B15 end: least {least:.4}, {} points, {} iterations",
        path.points.len(),
        path.iterations
    );
}

/// Williams' toggle: clamped, half span 12.943, rise 0.32; the load at given deflections.
#[test]
fn b16_williams_toggle() {
    let parts = 20;
    let (b, t, half) = (0.753, 0.243f64, 12.943);
    let kind = section(b * t, b * t.powi(3) / 12.0, 1e-3);
    let frame = legs(&[[-half, 0.0], [0.0, 0.32], [half, 0.0]], kind, 1.03e7, parts);
    let supports = in_plane(&frame, &[(0, HELD), (2, HELD)]);
    let printed =
        [(0.1, 19.240), (0.2, 25.873), (0.3, 27.714), (0.4, 32.377), (0.5, 46.62), (0.6, 76.26)];
    for (deflection, wanted) in printed {
        // no limit point: the deflection grows with the load, and with 1 % of it passes the print
        let [less, more] = [0.99, 1.01].map(|part| {
            let load = pushed(1, [0.0, -part * wanted, 0.0, 0.0, 0.0, 0.0]);
            -path(&frame, &supports, &load, &Options::default()).displacement[1][1]
        });
        eprintln!("B16 {wanted}: 0.99 gives {less:.4}, 1.01 gives {more:.4} ({deflection})");
        assert!(less < deflection && deflection < more);
    }
}

/// A straight strut branches at Euler's load; bent a little at first it bends on and does not.
#[test]
fn euler_strut_branches_or_bends() {
    let (parts, ei) = (24, 2.0f64);
    // shortening before the branch is 1e-6 of the length
    let frame = legs(&[[0.0, 0.0], [1.0, 0.0]], section(2e6, ei, ei), 1.0, parts);
    let supports = in_plane(&frame, &[(0, PINNED), (1, [false, true, false])]);
    let euler = std::f64::consts::PI.powi(2) * ei;
    let load = pushed(1, [-euler, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let options = Options { until: 2.0, ..Options::default() };
    let straight = nonlinear(&frame, &supports, &load, &[], &options).unwrap();
    let Outcome::Branches { factor } = straight.outcome else { panic!("{:?}", straight.outcome) };
    eprintln!("Euler: {factor:.6}");
    near(factor, 1.0, 1e-4);

    // half a sine of L/1000: amplified by 1/(1 - P/P_E)
    let bow: Vec<[f64; 3]> = frame
        .nodes()
        .iter()
        .map(|node| [0.0, 1e-3 * (std::f64::consts::PI * node.x).sin(), 0.0])
        .collect();
    let half = Options { until: 0.5, ..Options::default() };
    let bent = nonlinear(&frame, &supports, &load, &bow, &half).unwrap();
    assert_eq!(bent.outcome, Outcome::Converged);
    near(bent.displacement[along(2, parts, 0, parts / 2)][1], 1e-3, 2e-3);
    let on = Options { until: 1.1, ..Options::default() };
    let on = nonlinear(&frame, &supports, &load, &bow, &on).unwrap();
    assert_eq!(on.outcome, Outcome::Converged);
}

/// A clamped strut of two elements buckles as cubic elements do, at 40 E I/L² (Euler: 39.478).
#[test]
fn two_elements_see_a_clamped_strut() {
    let frame = legs(&[[0.0, 0.0], [1.0, 0.0]], section(1e8, 1.0, 1.0), 1.0, 2);
    let supports = in_plane(&frame, &[(0, HELD), (1, [false, true, true])]);
    let load = pushed(1, [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let options = Options { until: 100.0, ..Options::default() };
    let path = nonlinear(&frame, &supports, &load, &[], &options).unwrap();
    let Outcome::Branches { factor } = path.outcome else { panic!("{:?}", path.outcome) };
    near(factor, 40.0, 1e-5);
}

/// A clamped strut that wants to grow does not move until it buckles, at `E A ε = 4 π² E I/L²`: a
/// path without motion is a path.
#[test]
fn a_strut_that_swells_buckles() {
    let (ea, ei) = (1e3, 2.0);
    let frame = legs(&[[0.0, 0.0], [1.0, 0.0]], section(ea, ei, ei), 1.0, 8);
    let swells = frame.members().iter().map(|m| Member { initial_strain: 0.1, ..*m }).collect();
    let frame = Frame::new(frame.nodes().to_vec(), swells).unwrap();
    let supports = in_plane(&frame, &[(0, HELD), (1, HELD)]);
    let load = Load { with_initial_strain: true, ..Load::default() };
    let critical = 4.0 * std::f64::consts::PI.powi(2) * ei / (ea * 0.1);
    for until in [0.99 * critical, 3.0] {
        let options = Options { until, ..Options::default() };
        let path = nonlinear(&frame, &supports, &load, &[], &options).unwrap();
        near(-path.local_end_forces[3][6], ea * 0.1 * path.factor, 1e-9);
        if until < critical {
            assert_eq!(path.outcome, Outcome::Converged);
        } else {
            let Outcome::Branches { factor } = path.outcome else { panic!("{:?}", path.outcome) };
            eprintln!("swelling: {factor} ({critical})");
            near(factor, critical, 1e-3);
        }
    }
}
