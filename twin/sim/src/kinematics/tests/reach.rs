//! Bounds on the motion of bodies, against motion.

use super::*;
use crate::pose::Vector;
use nalgebra::Point3;

fn chains() -> Vec<Chain> {
    vec![super::forward::mixed_chain(), super::published::sda10_left(), super::published::ur10e()]
}

fn within(ranges: &[(f64, f64)], random: &mut Xorshift) -> Vec<f64> {
    ranges.iter().map(|(lower, upper)| lower + (upper - lower) * random.unit()).collect()
}

fn direction(random: &mut Xorshift) -> Vector {
    let mut draw = || 2.0 * random.unit() - 1.0;
    Vector::new(draw(), draw(), draw()).normalize()
}

/// Speed of a point of the body for each joint, by central differences.
fn speeds(chain: &Chain, q: &[f64], carrier: usize, point: &Vector) -> Vec<f64> {
    let mut poses = Vec::new();
    let mut at = |q: &[f64]| {
        chain.link_poses(q, &mut poses);
        poses[carrier] * Point3::from(*point)
    };
    let step = 1e-5;
    let speed = |axis: usize| {
        let (mut ahead, mut behind) = (q.to_vec(), q.to_vec());
        ahead[axis] += step;
        behind[axis] -= step;
        (at(&ahead) - at(&behind)).norm() / (2.0 * step)
    };
    (0..chain.dof()).map(speed).collect()
}

#[test]
fn no_point_of_a_body_is_faster_than_its_levers() {
    let mut random = Xorshift::new(19);
    for chain in chains() {
        for share in [1.0, 0.5, 0.1, 0.0] {
            let mut closest = vec![0.0_f64; chain.dof()];
            for _ in 0..40 {
                let carrier = (random.unit() * chain.joints().len() as f64) as usize;
                let (centre, radius) = (direction(&mut random) * 0.2, 0.1 * random.unit());
                let middle = within(&ranges(&chain), &mut random);
                let part = |(&(lower, upper), at): (&(f64, f64), &f64)| {
                    (at + share * (lower - at), at + share * (upper - at))
                };
                let ranges: Vec<(f64, f64)> =
                    ranges(&chain).iter().zip(&middle).map(part).collect();
                let levers = levers(&chain, &ranges, Some(carrier), &centre, radius);
                for _ in 0..50 {
                    let q = within(&ranges, &mut random);
                    let point = centre + direction(&mut random) * radius;
                    for (axis, speed) in speeds(&chain, &q, carrier, &point).into_iter().enumerate()
                    {
                        assert!(speed <= levers[axis] + 1e-8, "{axis}: {speed} {levers:?}");
                        closest[axis] = closest[axis].max(speed / levers[axis].max(1e-9));
                    }
                }
            }
            // With one value per joint the bound is the distance plus the radius: nearly met.
            let met = closest.iter().all(|share| *share > 0.8);
            assert!(share > 0.0 || met, "{closest:?}");
        }
    }
}

#[test]
fn no_point_of_a_body_goes_further_than_its_levers_say() {
    let mut random = Xorshift::new(23);
    for chain in chains() {
        let carrier = chain.joints().len() - 1;
        let (centre, radius) = (Vector::new(0.1, 0.0, 0.2), 0.05);
        let mut poses = Vec::new();
        for _ in 0..2000 {
            let (from, to) = (random_q(&chain, &mut random), random_q(&chain, &mut random));
            let part = random.unit();
            let to: Vec<f64> = from.iter().zip(&to).map(|(a, b)| a + part * (b - a)).collect();
            let ranges: Vec<(f64, f64)> =
                from.iter().zip(&to).map(|(a, b)| (a.min(*b), a.max(*b))).collect();
            let levers = levers(&chain, &ranges, Some(carrier), &centre, radius);
            let bound: f64 = levers
                .iter()
                .zip(&ranges)
                .map(|(lever, (lower, upper))| lever * (upper - lower))
                .sum();
            let point = Point3::from(centre + direction(&mut random) * radius);
            chain.link_poses(&from, &mut poses);
            let start = poses[carrier] * point;
            chain.link_poses(&to, &mut poses);
            assert!((poses[carrier] * point - start).norm() <= bound + 1e-12);
        }
    }
}

#[test]
fn what_does_not_move_has_no_lever() {
    let chain = super::published::sda10_left();
    let centre = Vector::new(0.3, 0.1, 0.0);
    assert_eq!(levers(&chain, &ranges(&chain), None, &centre, 0.1), [0.0; 7]);
    let on_elbow = levers(&chain, &ranges(&chain), Some(2), &Vector::zeros(), 0.02);
    assert!(on_elbow[3..].iter().all(|lever| *lever == 0.0));
    // On axis 3 but for its radius; 0.36 m from the shoulder whatever the angles.
    assert!((on_elbow[2] - 0.02).abs() < 1e-12, "{on_elbow:?}");
    assert!(on_elbow[1] >= 0.02 && on_elbow[1] <= 0.38 + 1e-12, "{on_elbow:?}");
}

#[test]
fn a_slide_without_limits_bounds_nothing() {
    let mut joints = super::forward::mixed_chain().joints().to_vec();
    (joints[3].lower, joints[3].upper) = (f64::NEG_INFINITY, f64::INFINITY);
    let chain = Chain::new(joints, Pose::identity()).unwrap();
    let levers = levers(&chain, &ranges(&chain), Some(3), &Vector::zeros(), 0.0);
    // The rail slides with it at 1, the slide itself too; what turns it has no bound.
    assert_eq!(levers, [1.0, f64::INFINITY, 1.0]);
}
