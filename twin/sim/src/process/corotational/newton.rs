//! Newton on a chain of co-rotational elements.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::{HangError, Hanging, HeavyRod, Support};

/// Newton iterations to a step of load and in all.
const STEP_ITERATIONS: usize = 20;
pub(super) const ALL_ITERATIONS: usize = 1500;
/// Change of place over length, and of direction, at which Newton has arrived.
const ARRIVED: f64 = 1e-9;
/// Stiffness along, over `E I/L²`, of a rod that is brought between its ends.
const SOFT: f64 = 20.0;
/// Greatest turn of one iteration, rad; a longer way is shortened.
const TURN: f64 = 0.5;

/// An element: rest length, stiffness, and the weight at each of its nodes.
struct Element {
    length_m: f64,
    bending_n_m2: f64,
    axial_n: f64,
    weight_n: [f64; 2],
}

pub(super) struct Newton {
    elements: Vec<Element>,
    cuts: usize,
    length_m: f64,
    /// Place and direction of each node.
    pub(super) state: Vec<Vector3<f64>>,
    /// Place and direction of both ends, straight and held, and which of them are held.
    straight: [Vector3<f64>; 2],
    held: [Vector3<f64>; 2],
    fixed: [[bool; 3]; 2],
    /// One: the load and the ends come on. Two, where both ends are held: they come on to a rod that is soft along,
    /// which then gets its stiffness back. A rod longer than its chord so finds the way it hangs; straight and
    /// pressed it would have to buckle.
    pub(super) way: f64,
    /// Stiffness along over the true one in the beginning.
    soft: f64,
}

impl Newton {
    pub(super) fn new(rod: &HeavyRod, cuts: u32) -> Result<Self, HangError> {
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
        let (mut way, mut soft) = (1.0, 1.0);
        if fixed[0][0] && fixed[1][0] {
            let most =
                |value: &dyn Fn(&Element) -> f64| elements.iter().map(value).fold(0.0, f64::max);
            let weight_n: f64 =
                elements.iter().map(|e| 2.0 * e.weight_n[0].hypot(e.weight_n[1])).sum();
            let bending_n = most(&|e| e.bending_n_m2) / (length_m * length_m);
            soft = ((SOFT * bending_n + weight_n) / most(&|e| e.axial_n)).min(1.0);
            way = 2.0;
        }
        let cuts = cuts as usize;
        Ok(Self { elements, cuts, length_m, state, straight, held, fixed, way, soft })
    }

    /// Newton at a part of the way; whether it arrived.
    pub(super) fn settle(&mut self, way: f64, iterations: &mut usize) -> bool {
        for _ in 0..STEP_ITERATIONS {
            if *iterations >= ALL_ITERATIONS {
                return false;
            }
            *iterations += 1;
            let Some(change) = self.downhill(way, iterations) else { return false };
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
    fn downhill(&self, way: f64, iterations: &mut usize) -> Option<Vec<Vector3<f64>>> {
        let softest = self.elements.iter().map(|e| e.bending_n_m2).fold(f64::INFINITY, f64::min);
        let mut stiffer = 0.0;
        loop {
            match self.solve(way, stiffer * softest) {
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
    fn solve(&self, way: f64, stiffer: f64) -> Option<(Vec<Vector3<f64>>, bool)> {
        let (share, soft) = (way.min(1.0), self.soft.powf((self.way - way).clamp(0.0, 1.0)));
        let nodes = self.state.len();
        let mut own = vec![Matrix3::zeros(); nodes];
        let mut next = vec![Matrix3::zeros(); nodes - 1];
        let mut out = vec![Vector3::zeros(); nodes];
        for (i, element) in self.elements.iter().enumerate() {
            let (force, stiffness) = element.push(&self.state[i], &self.state[i + 1], soft);
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

    pub(super) fn hanging(&self, iterations: usize) -> Hanging {
        let every = |i: usize| &self.state[i * self.cuts];
        let nodes = self.elements.len() / self.cuts + 1;
        let moment = |i: usize| {
            let (force, _) = self.elements[i].push(&self.state[i], &self.state[i + 1], 1.0);
            force[2].abs().max(force[5].abs())
        };
        Hanging {
            points_m: (0..nodes).map(|i| [every(i)[0], every(i)[1]]).collect(),
            angles_rad: (0..nodes).map(|i| every(i)[2]).collect(),
            moment_n_m: (0..self.elements.len()).map(moment).fold(0.0, f64::max),
            stable: self.solve(self.way, 0.0).is_some_and(|(_, positive)| positive),
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
    /// `soft` is a factor on its stiffness along.
    fn push(&self, a: &Vector3<f64>, b: &Vector3<f64>, soft: f64) -> (Vector6<f64>, Matrix6<f64>) {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        let (c, s) = (dx / length, dy / length);
        // directions of the ends against the chord, through sine and cosine so that no turn is missed
        let against = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            (sin * c - cos * s).atan2(cos * c + sin * s)
        };
        let (first, second) = (against(a[2]), against(b[2]));
        let axial_n = soft * self.axial_n;
        let pull = axial_n * (length - self.length_m) / self.length_m;
        let bend = self.bending_n_m2 / self.length_m;
        let moments = [bend * (4.0 * first + 2.0 * second), bend * (2.0 * first + 4.0 * second)];
        let along = Vector6::new(-c, -s, 0.0, c, s, 0.0);
        let across = Vector6::new(s, -c, 0.0, -s, c, 0.0);
        let turn = across / length;
        let (mut one, mut two) = (-turn, -turn);
        one[2] += 1.0;
        two[5] += 1.0;
        let force = along * pull + one * moments[0] + two * moments[1];
        let stiffness = along * along.transpose() * (axial_n / self.length_m)
            + (one * one.transpose() + two * two.transpose()) * (4.0 * bend)
            + (one * two.transpose() + two * one.transpose()) * (2.0 * bend)
            + across * across.transpose() * (pull / length)
            + (along * across.transpose() + across * along.transpose())
                * ((moments[0] + moments[1]) / (length * length));
        (force, stiffness)
    }
}
