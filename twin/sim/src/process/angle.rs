//! Angle between nozzle and strand: Yu's θ.

/// Angle between the nozzle's axis and the strand it leaves behind, rad, 0 to π.
///
/// `axis` is the way the material leaves the nozzle, `travel` the way the nozzle goes; neither need be of length
/// one. `θ = ∠(axis, −travel)`: 0 where the nozzle backs off along its own strand, a right angle where it draws the
/// strand square to itself, more where it runs into it. Not a number where either is zero or not finite.
/// That the strand comes out straight only where θ is "limited within a certain degree" is Yu's, without a number;
/// the figures (8 to 10) are not here, and the text also calls θ what defines the cone of the effector: that it is
/// this angle is our reading. Source: Yu 2016, the text on figures 8 to 10.
pub fn nozzle_angle_rad(axis: [f64; 3], travel: [f64; 3]) -> f64 {
    let (axis, behind) = (sized(axis), sized(travel).map(|x| -x));
    let dot: f64 = (0..3).map(|i| axis[i] * behind[i]).sum();
    let part = |i: usize, j: usize| axis[i] * behind[j] - axis[j] * behind[i];
    let cross = part(1, 2).hypot(part(2, 0)).hypot(part(0, 1));
    if dot == 0.0 && cross == 0.0 { f64::NAN } else { cross.atan2(dot) }
}

/// By how much θ is above a limit, rad: zero or less is within it.
pub fn angle_excess_rad(axis: [f64; 3], travel: [f64; 3], limit_rad: f64) -> f64 {
    nozzle_angle_rad(axis, travel) - limit_rad
}

/// Greatest θ along a path, rad, and where: index into `travel`; none of an empty path or where none is a number.
///
/// `axes` and `travel` go together; the shorter ends the path.
pub fn greatest_angle(axes: &[[f64; 3]], travel: &[[f64; 3]]) -> Option<(usize, f64)> {
    let angles = axes.iter().zip(travel).map(|(axis, way)| nozzle_angle_rad(*axis, *way));
    angles.enumerate().filter(|(_, angle)| !angle.is_nan()).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Greatest component one, so that no product leaves the range of numbers; zero stays zero.
fn sized(v: [f64; 3]) -> [f64; 3] {
    let most = v.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    if most > 0.0 { v.map(|x| x / most) } else { v }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::super::tests::within;
    use super::*;

    const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

    #[test]
    fn backs_off_square_and_into() {
        within(nozzle_angle_rad(DOWN, [0.0, 0.0, 3.0]), 0.0, 1e-15);
        within(nozzle_angle_rad(DOWN, [2.0, 0.0, 0.0]), FRAC_PI_2, 1e-15);
        within(nozzle_angle_rad(DOWN, [0.0, 0.0, -1e-200]), PI, 1e-15);
        for steep in [1e-9_f64, 0.1, 1.0, 1.4] {
            let travel = [steep.cos(), 0.0, steep.sin()];
            within(nozzle_angle_rad(DOWN, travel), FRAC_PI_2 - steep, 1e-12);
        }
        assert!(nozzle_angle_rad(DOWN, [0.0; 3]).is_nan());
        assert!(nozzle_angle_rad([f64::NAN; 3], DOWN).is_nan());
    }

    #[test]
    fn limit_and_path() {
        assert!(angle_excess_rad(DOWN, [1.0, 0.0, 1.0], 0.8) < 0.0);
        within(angle_excess_rad(DOWN, [1.0, 0.0, 1.0], 0.7), PI / 4.0 - 0.7, 1e-12);
        let travel = [[0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.5]];
        assert_eq!(greatest_angle(&[DOWN; 4], &travel).map(|(at, _)| at), Some(1));
        assert_eq!(greatest_angle(&[], &travel), None);
    }
}
