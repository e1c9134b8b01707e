//! What a scene of lamps gives the surface of one segment at one instant.

use std::f64::consts::{LN_2, LOG2_E, TAU};

use crate::pose::Vector;

use super::dose::Segment;
use super::lamp::Lobe;
use super::lights::{Scene, SeenLamp};

/// Most azimuths round a segment.
const MOST: usize = 64;

/// Cosines and sines of the azimuths, the same for every segment.
#[derive(Debug, Clone)]
pub(super) struct Azimuths {
    cos: Vec<f64>,
    sin: Vec<f64>,
}

impl Azimuths {
    pub(super) fn new(count: usize) -> Self {
        let angle = |i: usize| TAU * i as f64 / count as f64;
        let count = count.clamp(3, MOST);
        Self {
            cos: (0..count).map(|i| angle(i).cos()).collect(),
            sin: (0..count).map(|i| angle(i).sin()).collect(),
        }
    }

    fn count(&self) -> usize {
        self.cos.len()
    }
}

/// Irradiance at an instant: on the surface at each azimuth, and as beams, W/m².
#[derive(Debug, Clone)]
pub(super) struct Irradiance {
    pub(super) surface: Vec<f64>,
    pub(super) beam: Vec<f64>,
    /// Which pairs of lamp and azimuth a shade hides, as a sum of marks: it differs when a shadow moves.
    pub(super) hidden: u64,
    /// Whether any lamp may be shaded at all.
    pub(super) near_shade: bool,
}

/// One lamp as a segment sees it.
struct View<'a> {
    seen: &'a SeenLamp,
    /// To the lamp: across at azimuth zero, across at a quarter turn.
    to_m: [f64; 2],
    distance2: f64,
    /// Of the lamp's axis, the same, and along the ray from the lamp, m.
    axis: [f64; 2],
    along_m: f64,
    radius_m: f64,
    /// Shades that may stand in between.
    near: u64,
}

impl Irradiance {
    pub(super) fn dark(azimuths: usize) -> Self {
        let zeros = vec![0.0; azimuths];
        Self { surface: zeros.clone(), beam: zeros, hidden: 0, near_shade: false }
    }

    pub(super) fn copy(&mut self, other: &Self) {
        self.surface.copy_from_slice(&other.surface);
        self.beam.copy_from_slice(&other.beam);
        (self.hidden, self.near_shade) = (other.hidden, other.near_shade);
    }

    /// Fills in what a scene gives a segment; lamps times azimuths in cost.
    pub(super) fn fill(
        &mut self,
        scene: &Scene,
        segment: &Segment,
        round: &Azimuths,
        radius_m: f64,
    ) {
        self.surface.fill(0.0);
        self.beam.fill(0.0);
        (self.hidden, self.near_shade) = (0, false);
        let other = segment.tangent.cross(&segment.across);
        for (index, seen) in scene.lamps.iter().enumerate() {
            let lamp = &seen.lamp;
            let to = lamp.at - segment.middle;
            let (distance2, along_m) = (to.norm_squared(), -lamp.along.dot(&to));
            // Not one point of the surface is inside the lobe: its middle is out by more than the radius.
            let distance_m = distance2.sqrt();
            if along_m + radius_m < seen.least_cosine * (distance_m - radius_m) {
                continue;
            }
            let across = |v: &Vector| [v.dot(&segment.across), v.dot(&other)];
            let (to_m, axis) = (across(&to), across(&lamp.along));
            let mut view = View { seen, to_m, distance2, axis, along_m, radius_m, near: 0 };
            let mut visible = [1.0; MOST];
            let mut share = 1.0;
            let near = scene.near_shades(lamp.at, segment.middle, radius_m);
            if near != 0 {
                self.near_shade = true;
                view.near = near;
                let mark = index * round.count() + 1;
                share = self.hide(&mut visible, scene, segment, round, &view, mark);
            }
            if share == 0.0 {
                continue;
            }
            view.light(&mut self.surface, &visible, round);
            let cosine = along_m / distance_m;
            if cosine >= seen.least_cosine {
                let per_m = lamp.intensity_w_sr(cosine) * share / (distance2 * distance_m);
                self.add_beam(to_m, round, per_m);
            }
        }
    }

    /// Marks what shades hide of a lamp; returns the share of the facing azimuths that see it.
    fn hide(
        &mut self,
        visible: &mut [f64; MOST],
        scene: &Scene,
        segment: &Segment,
        round: &Azimuths,
        view: &View,
        mark: usize,
    ) -> f64 {
        let other = segment.tangent.cross(&segment.across);
        let (mut facing, mut seeing) = (0.0, 0.0);
        for (azimuth, (cos, sin)) in round.cos.iter().zip(&round.sin).enumerate() {
            if view.to_m[0] * cos + view.to_m[1] * sin <= view.radius_m {
                continue;
            }
            facing += 1.0;
            let point = segment.middle + (segment.across * *cos + other * *sin) * view.radius_m;
            if scene.is_blocked(view.near, view.seen.lamp.at, point) {
                visible[azimuth] = 0.0;
                let mark = (mark + azimuth) as u64;
                self.hidden = self.hidden.wrapping_add(mark.wrapping_mul(0x9E37_79B9_7F4A_7C15));
            } else {
                seeing += 1.0;
            }
        }
        if facing > 0.0 { seeing / facing } else { 0.0 }
    }

    /// Shares a lamp's light between the two azimuths it stands between; `per_m` is `J/r³`.
    fn add_beam(&mut self, to_m: [f64; 2], round: &Azimuths, per_m: f64) {
        let count = round.count();
        let out = |i: usize| to_m[0] * round.cos[i] + to_m[1] * round.sin[i];
        let best = (1..count).fold(0, |best, i| if out(i) > out(best) { i } else { best });
        let (before, after) = ((best + count - 1) % count, (best + 1) % count);
        let next = if out(before) > out(after) { before } else { after };
        // The direction is a sum of the two normals; their shares are its parts.
        let (p, q, cosine) = (out(best), out(next), round.cos[1]);
        let (a, b) = (p - q * cosine, (q - p * cosine).max(0.0));
        if a + b > 0.0 {
            let strength = per_m * to_m[0].hypot(to_m[1]) / (a + b);
            self.beam[best] += strength * a;
            self.beam[next] += strength * b;
        }
    }
}

impl View<'_> {
    /// Adds the lamp's light on the surface at each azimuth.
    ///
    /// Without branches for a narrow Gaussian lobe, so that azimuths are done several at a time.
    fn light(&self, surface: &mut [f64], visible: &[f64; MOST], round: &Azimuths) {
        let lamp = &self.seen.lamp;
        if lamp.lobe == Lobe::Gaussian && self.seen.least_cosine > 0.7 {
            let width = 4.0 * LN_2 / (lamp.full_angle_rad * lamp.full_angle_rad);
            self.sum(surface, visible, round, |cosine| {
                lamp.peak_w_sr * exp_below_zero(-width * small_angle2(1.0 - cosine))
            });
        } else {
            self.sum(surface, visible, round, |cosine| lamp.intensity_w_sr(cosine));
        }
    }

    #[inline(always)]
    fn sum(
        &self,
        surface: &mut [f64],
        visible: &[f64; MOST],
        round: &Azimuths,
        intensity: impl Fn(f64) -> f64,
    ) {
        let count = surface.len().min(round.cos.len()).min(round.sin.len()).min(MOST);
        let (cos, sin) = (&round.cos[..count], &round.sin[..count]);
        let (surface, visible) = (&mut surface[..count], &visible[..count]);
        let [to_x, to_y] = self.to_m;
        let [axis_x, axis_y] = self.axis;
        let (least, radius_m) = (self.seen.least_cosine, self.radius_m);
        for i in 0..count {
            let out = to_x * cos[i] + to_y * sin[i];
            let height = out - radius_m;
            let square = self.distance2 - radius_m * (2.0 * out - radius_m);
            let inverse = 1.0 / square.sqrt();
            let turned = axis_x * cos[i] + axis_y * sin[i];
            let cosine = (self.along_m + radius_m * turned) * inverse;
            let light = intensity(cosine) * height * inverse * inverse * inverse * visible[i];
            surface[i] += if (height > 0.0) & (cosine >= least) { light } else { 0.0 };
        }
    }
}

/// Square of an angle below 45° from one less its cosine, rad²: series of arcsin², good to 1e-5.
#[inline(always)]
fn small_angle2(versine: f64) -> f64 {
    let u = versine;
    2.0 * u * (1.0 + u * (1.0 / 6.0 + u * (2.0 / 45.0 + u * (1.0 / 70.0 + u * (8.0 / 1575.0)))))
}

/// `exp(x)` for `−700 < x ≤ 0`, good to 2e-7: a power of two from the bits, the rest by its series.
#[inline(always)]
fn exp_below_zero(x: f64) -> f64 {
    /// One and a half times 2^52: adding it leaves the nearest whole number in the last bits.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    let shifted = (x * LOG2_E) + WHOLE;
    let f = x - (shifted - WHOLE) * LN_2;
    let sixth = 1.0 / 120.0 + f * (1.0 / 720.0);
    let series = 1.0 + f * (1.0 + f * (0.5 + f * (1.0 / 6.0 + f * (1.0 / 24.0 + f * sixth))));
    series * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

#[cfg(test)]
mod tests {
    use super::{exp_below_zero, small_angle2};

    #[test]
    fn fast_forms_are_good_enough() {
        for i in 0..=10_000 {
            let x = -0.002 * f64::from(i);
            assert!((exp_below_zero(x) / x.exp() - 1.0).abs() < 2e-7, "{x}");
            let angle: f64 = 45.0_f64.to_radians() * f64::from(i + 1) / 10_001.0;
            let got = small_angle2(1.0 - angle.cos());
            assert!((got / (angle * angle) - 1.0).abs() < 2e-5, "{angle}");
        }
    }
}
