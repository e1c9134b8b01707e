//! A rod that bends far under its own weight, co-rotational, in the plane of its path and gravity.
//!
//! Straight elements that turn with their chord, bend and stretch little about it; Newton with the load and
//! the ends brought on in steps. For set strands (stiffness by element, ageing as `E_eff`) whose sag is above
//! 0.3 of their span. Source: process-physics.md section 3.1, cases ELASTICA-*, EB-*.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

#[cfg(test)]
mod tests;

/// A straight piece of a rod, at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeavyPiece {
    /// Length, m.
    pub length_m: f64,
    /// Bending stiffness `E I`, N m².
    pub bending_n_m2: f64,
    /// Stiffness along it `E A`, N.
    pub axial_n: f64,
    /// Mass per length, kg/m.
    pub line_mass_kg_m: f64,
}

/// What an end is held by, in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Support {
    /// In place and direction.
    Clamped {
        /// Place, m.
        at_m: [f64; 2],
        /// Direction of the rod from the first axis to the second, rad.
        angle_rad: f64,
    },
    /// In place.
    Hinged {
        /// Place, m.
        at_m: [f64; 2],
    },
    /// Not at all.
    Free,
}

/// A rod without load: straight, from `from_m` along `angle_rad`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeavyRod<'a> {
    /// Its pieces in order.
    pub pieces: &'a [HeavyPiece],
    /// Where it begins, m.
    pub from_m: [f64; 2],
    /// Its direction, rad.
    pub angle_rad: f64,
    /// What holds its beginning and its end; they are brought there from the straight rod as the load comes on.
    pub ends: [Support; 2],
    /// Gravity, m/s².
    pub gravity_m_s2: [f64; 2],
}

/// A rod at rest under its weight, at the boundaries of its pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Hanging {
    /// Places, m.
    pub points_m: Vec<[f64; 2]>,
    /// Directions, rad.
    pub angles_rad: Vec<f64>,
    /// Greatest bending moment, N m.
    pub moment_n_m: f64,
    /// Whether it stays there when pushed a little.
    pub stable: bool,
    /// Newton iterations taken.
    pub iterations: usize,
}

/// Why a rod has no rest shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HangError {
    /// A number is not finite, or a length or stiffness is not positive.
    Input,
    /// None found within the iterations, or nothing holds it.
    NoEquilibrium,
}

/// Newton iterations to a step of load and in all.
const STEP_ITERATIONS: usize = 20;
const ALL_ITERATIONS: usize = 1500;
/// Smallest step of load.
const LEAST_STEP: f64 = 1.0 / 8192.0;
/// Change of place over length, and of direction, at which Newton has arrived.
const ARRIVED: f64 = 1e-9;
/// Greatest turn of one iteration, rad; a longer way is shortened.
const TURN: f64 = 0.5;

/// Rest shape of a rod, `cuts` elements (1 to 256) to a piece.
///
/// Second order in the elements' length (weight in lumps at the nodes); O(n) an iteration, at most 1500 iterations
/// in all. [`hang_fine`] takes the error of second and fourth order out.
///
/// # Errors
/// [`HangError`] where a number means nothing or no equilibrium is found.
pub fn hang(rod: &HeavyRod, cuts: u32) -> Result<Hanging, HangError> {
    let mut newton = Newton::new(rod, cuts.clamp(1, 256))?;
    let (mut done, mut step) = (0.0, 0.25);
    let mut iterations = 0;
    while done < 1.0 {
        let to = f64::min(done + step, 1.0);
        let before = newton.state.clone();
        if newton.settle(to, &mut iterations) {
            done = to;
            step *= 1.5;
        } else {
            newton.state = before;
            step *= 0.25;
            if step < LEAST_STEP || iterations >= ALL_ITERATIONS {
                return Err(HangError::NoEquilibrium);
            }
        }
    }
    Ok(newton.hanging(iterations))
}

/// Rest shape from three finenesses, `cuts`, twice and four times that, by Richardson: sixth order.
///
/// # Errors
/// As [`hang`].
pub fn hang_fine(rod: &HeavyRod, cuts: u32) -> Result<Hanging, HangError> {
    let coarse = hang(rod, cuts)?;
    let middle = hang(rod, 2 * cuts)?;
    let mut fine = hang(rod, 4 * cuts)?;
    // 1/45, −20/45, 64/45: free of the terms in h² and h⁴
    let best = |c: f64, m: f64, f: f64| f + (19.0 * (f - m) - (m - c)) / 45.0;
    for (i, point) in fine.points_m.iter_mut().enumerate() {
        for k in 0..2 {
            point[k] = best(coarse.points_m[i][k], middle.points_m[i][k], point[k]);
        }
        fine.angles_rad[i] =
            best(coarse.angles_rad[i], middle.angles_rad[i], fine.angles_rad[i]);
    }
    fine.moment_n_m = best(coarse.moment_n_m, middle.moment_n_m, fine.moment_n_m);
    fine.iterations += coarse.iterations + middle.iterations;
    Ok(fine)
}

/// Rest shape in space of a straight rod printed from a point along a direction, clamped where it begins and
/// free at its end; gravity any way, m/s². Points at the boundaries of its pieces, m.
///
/// # Errors
/// As [`hang`].
pub fn droop(
    pieces: &[HeavyPiece],
    from_m: [f64; 3],
    along: [f64; 3],
    gravity_m_s2: [f64; 3],
    cuts: u32,
) -> Result<Vec<[f64; 3]>, HangError> {
    let axes = super::rod::Axes::new(along, gravity_m_s2);
    let part = |axis: [f64; 3]| (0..3).map(|i| axis[i] * gravity_m_s2[i]).sum::<f64>();
    let (along, across) = (axes.along, axes.across[0]);
    let rod = HeavyRod {
        pieces,
        from_m: [0.0; 2],
        angle_rad: 0.0,
        ends: [Support::Clamped { at_m: [0.0; 2], angle_rad: 0.0 }, Support::Free],
        gravity_m_s2: [part(along), part(across)],
    };
    let flat = hang_fine(&rod, cuts)?;
    let place = |p: &[f64; 2]| [0, 1, 2].map(|i| from_m[i] + p[0] * along[i] + p[1] * across[i]);
    Ok(flat.points_m.iter().map(place).collect())
}

/// An element: rest length, stiffness, and the weight at each of its nodes.
struct Element {
    length_m: f64,
    bending_n_m2: f64,
    axial_n: f64,
    weight_n: [f64; 2],
}

struct Newton {
    elements: Vec<Element>,
    cuts: usize,
    length_m: f64,
    /// Place and direction of each node.
    state: Vec<Vector3<f64>>,
    /// Place and direction of both ends, straight and held, and which of them are held.
    straight: [Vector3<f64>; 2],
    held: [Vector3<f64>; 2],
    fixed: [[bool; 3]; 2],
}

impl Newton {
    fn new(rod: &HeavyRod, cuts: u32) -> Result<Self, HangError> {
        let mut elements = Vec::with_capacity(rod.pieces.len() * cuts as usize);
        let mut length_m = 0.0;
        let (sin, cos) = rod.angle_rad.sin_cos();
        let place = |at_m: f64| {
            Vector3::new(rod.from_m[0] + at_m * cos, rod.from_m[1] + at_m * sin, rod.angle_rad)
        };
        let mut state = vec![place(0.0)];
        for piece in rod.pieces {
            let numbers = [piece.length_m, piece.bending_n_m2, piece.axial_n];
            if !numbers.iter().all(|x| *x > 0.0 && x.is_finite()) {
                return Err(HangError::Input);
            }
            let cut_m = piece.length_m / f64::from(cuts);
            for _ in 0..cuts {
                length_m += cut_m;
                state.push(place(length_m));
                elements.push(Element {
                    length_m: cut_m,
                    bending_n_m2: piece.bending_n_m2,
                    axial_n: piece.axial_n,
                    weight_n: rod.gravity_m_s2.map(|g| 0.5 * g * piece.line_mass_kg_m * cut_m),
                });
            }
        }
        let straight = [state[0], state[state.len() - 1]];
        let (mut held, mut fixed) = (straight, [[false; 3]; 2]);
        for (i, support) in rod.ends.iter().enumerate() {
            match *support {
                Support::Clamped { at_m, angle_rad } => {
                    held[i] = Vector3::new(at_m[0], at_m[1], angle_rad);
                    fixed[i] = [true; 3];
                }
                Support::Hinged { at_m } => {
                    held[i] = Vector3::new(at_m[0], at_m[1], 0.0);
                    fixed[i] = [true, true, false];
                }
                Support::Free => {}
            }
        }
        let numbers = straight.iter().chain(&held).flat_map(|v| v.iter());
        let weights = elements.iter().flat_map(|e| e.weight_n.iter());
        if elements.is_empty() || !numbers.chain(weights).all(|x| x.is_finite()) {
            return Err(HangError::Input);
        }
        Ok(Self { elements, cuts: cuts as usize, length_m, state, straight, held, fixed })
    }

    /// Newton at a share of load and way; whether it arrived.
    fn settle(&mut self, share: f64, iterations: &mut usize) -> bool {
        for _ in 0..STEP_ITERATIONS {
            if *iterations >= ALL_ITERATIONS {
                return false;
            }
            *iterations += 1;
            let Some(change) = self.downhill(share, iterations) else { return false };
            let turn = change.iter().fold(0.0, |a: f64, c| a.max(c[2].abs()));
            let shift = change.iter().fold(0.0, |a: f64, c| a.max(c[0].abs()).max(c[1].abs()));
            if !(turn + shift / self.length_m).is_finite() {
                return false;
            }
            let shorten = if turn > TURN { TURN / turn } else { 1.0 };
            for (node, change) in self.state.iter_mut().zip(&change) {
                *node += shorten * change;
            }
            if turn + shift / self.length_m < ARRIVED {
                return true;
            }
        }
        false
    }

    /// Newton's change; where the rod would not stay (pressed straight), stiffened until it would, so that it leaves
    /// for a shape in which it does.
    fn downhill(&self, share: f64, iterations: &mut usize) -> Option<Vec<Vector3<f64>>> {
        let softest = self.elements.iter().map(|e| e.bending_n_m2).fold(f64::INFINITY, f64::min);
        let mut stiffer = 0.0;
        loop {
            match self.solve(share, stiffer * softest) {
                Some((change, true)) => return Some(change),
                other if stiffer > 1e9 || *iterations >= ALL_ITERATIONS => {
                    return other.map(|(change, _)| change);
                }
                _ => *iterations += 1,
            }
            stiffer = if stiffer == 0.0 { 1.0 } else { 10.0 * stiffer };
        }
    }

    /// One linear solve: change of each node, and whether the stiffness is positive. `stiffer`, N m², is added to
    /// it, over the length of the rod.
    fn solve(&self, share: f64, stiffer: f64) -> Option<(Vec<Vector3<f64>>, bool)> {
        let nodes = self.state.len();
        let mut own = vec![Matrix3::zeros(); nodes];
        let mut next = vec![Matrix3::zeros(); nodes - 1];
        let mut out = vec![Vector3::zeros(); nodes];
        for (i, element) in self.elements.iter().enumerate() {
            let (force, stiffness) = element.push(&self.state[i], &self.state[i + 1]);
            own[i] += stiffness.fixed_view::<3, 3>(0, 0);
            own[i + 1] += stiffness.fixed_view::<3, 3>(3, 3);
            next[i] += stiffness.fixed_view::<3, 3>(0, 3);
            let weight = Vector3::new(element.weight_n[0], element.weight_n[1], 0.0) * share;
            out[i] += weight - force.fixed_rows::<3>(0);
            out[i + 1] += weight - force.fixed_rows::<3>(3);
        }
        let (turn, shift) = (stiffer / self.length_m, stiffer / self.length_m.powi(3));
        for block in &mut own {
            *block += Matrix3::from_diagonal(&Vector3::new(shift, shift, turn));
        }
        for end in 0..2 {
            let node = if end == 0 { 0 } else { nodes - 1 };
            let to = self.straight[end].lerp(&self.held[end], share);
            for k in (0..3).filter(|k| self.fixed[end][*k]) {
                let by = to[k] - self.state[node][k];
                let column: Vector3<f64> = own[node].column(k).into();
                out[node] -= column * by;
                own[node].set_column(k, &Vector3::zeros());
                own[node].set_row(k, &nalgebra::RowVector3::zeros());
                own[node][(k, k)] = column[k].abs().max(f64::MIN_POSITIVE);
                if end == 0 {
                    let row: Vector3<f64> = next[0].row(k).transpose();
                    out[1] -= row * by;
                    next[0].set_row(k, &nalgebra::RowVector3::zeros());
                } else {
                    let column: Vector3<f64> = next[nodes - 2].column(k).into();
                    out[nodes - 2] -= column * by;
                    next[nodes - 2].set_column(k, &Vector3::zeros());
                }
            }
            for k in (0..3).filter(|k| self.fixed[end][*k]) {
                out[node][k] = (to[k] - self.state[node][k]) * own[node][(k, k)];
            }
        }
        sweep(own, &next, out)
    }

    fn hanging(&self, iterations: usize) -> Hanging {
        let every = |i: usize| &self.state[i * self.cuts];
        let nodes = self.elements.len() / self.cuts + 1;
        let moment = |i: usize| {
            let (force, _) = self.elements[i].push(&self.state[i], &self.state[i + 1]);
            force[2].abs().max(force[5].abs())
        };
        Hanging {
            points_m: (0..nodes).map(|i| [every(i)[0], every(i)[1]]).collect(),
            angles_rad: (0..nodes).map(|i| every(i)[2]).collect(),
            moment_n_m: (0..self.elements.len()).map(moment).fold(0.0, f64::max),
            stable: self.solve(1.0, 0.0).is_some_and(|(_, positive)| positive),
            iterations,
        }
    }
}

/// Block elimination down a chain of nodes; no answer where a block is singular.
fn sweep(
    mut own: Vec<Matrix3<f64>>,
    next: &[Matrix3<f64>],
    mut out: Vec<Vector3<f64>>,
) -> Option<(Vec<Vector3<f64>>, bool)> {
    let mut positive = true;
    for i in 0..own.len() {
        if i > 0 {
            let carry = next[i - 1].transpose() * own[i - 1];
            own[i] -= carry * next[i - 1];
            let before = out[i - 1];
            out[i] -= carry * before;
        }
        let block = own[i];
        positive &= block[(0, 0)] > 0.0
            && block.fixed_view::<2, 2>(0, 0).determinant() > 0.0
            && block.determinant() > 0.0;
        own[i] = block.try_inverse()?;
    }
    for i in (0..own.len()).rev() {
        let mut right = out[i];
        if i + 1 < own.len() {
            right -= next[i] * out[i + 1];
        }
        out[i] = own[i] * right;
    }
    Some((out, positive))
}

impl Element {
    /// Force on its nodes and stiffness, of a co-rotational beam (Crisfield's planar element).
    fn push(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> (Vector6<f64>, Matrix6<f64>) {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        let (c, s) = (dx / length, dy / length);
        // directions of the ends against the chord, through sine and cosine so that no turn is missed
        let against = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (sin * c - cos * s).atan2(cos * c + sin * s)
        };
        let (first, second) = (against(a[2]), against(b[2]));
        let pull = self.axial_n * (length - self.length_m) / self.length_m;
        let bend = self.bending_n_m2 / self.length_m;
        let moments = [bend * (4.0 * first + 2.0 * second), bend * (2.0 * first + 4.0 * second)];
        let along = Vector6::new(-c, -s, 0.0, c, s, 0.0);
        let across = Vector6::new(s, -c, 0.0, -s, c, 0.0);
        let turn = across / length;
        let (mut one, mut two) = (-turn, -turn);
        one[2] += 1.0;
        two[5] += 1.0;
        let force = along * pull + one * moments[0] + two * moments[1];
        let stiffness = along * along.transpose() * (self.axial_n / self.length_m)
            + (one * one.transpose() + two * two.transpose()) * (4.0 * bend)
            + (one * two.transpose() + two * one.transpose()) * (2.0 * bend)
            + across * across.transpose() * (pull / length)
            + (along * across.transpose() + across * along.transpose())
                * ((moments[0] + moments[1]) / (length * length));
        (force, stiffness)
    }
}
