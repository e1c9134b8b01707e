//! Newton's iteration to one spot of the path: at a load, or along Riks' arc.

use super::Options;
use super::system::{Balance, State, System, Tangent};

/// Newton iterations at one spot: more than a sound step takes.
const ITERATIONS: usize = 20;
/// Cosine of the angle a step may make with the path's direction at its start and at its end: a
/// quarter right angle and a little. A jump to another branch does not keep to it at both.
const ALONG: f64 = 0.9;
/// Largest spin of a node in one iteration, rad.
const SPIN_RAD: f64 = 1.5;
/// A factor of 1 counts as a move of at least this part of the mean member, so that a path without
/// motion has length too.
const LEAST_MOTION: f64 = 1e-6;

/// Motion of the kept freedoms with the rise of the factor.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) motion: Vec<f64>,
    pub(super) rise: f64,
}

/// A point of the path in equilibrium.
#[derive(Debug)]
pub(super) struct Spot {
    pub(super) state: State,
    pub(super) balance: Balance,
    tangent: Tangent,
    /// Motion for a factor of 1.
    pub(super) rate: Step,
}

impl Spot {
    /// Directions without resistance.
    pub(super) fn negative(&self) -> usize {
        self.tangent.signed.negative
    }
}

/// A step taken: where to, along what, in how many iterations.
pub(super) struct Landing {
    pub(super) spot: Spot,
    pub(super) step: Step,
    pub(super) iterations: usize,
}

/// A path being followed.
pub(super) struct Walk<'a> {
    pub(super) system: &'a System,
    pub(super) options: &'a Options,
    /// Newton iterations so far.
    pub(super) iterations: usize,
    /// Length of the unloaded frame's motion for a factor of 1.
    first_speed: f64,
}

impl<'a> Walk<'a> {
    pub(super) fn new(system: &'a System, options: &'a Options) -> Self {
        Self { system, options, iterations: 0, first_speed: 0.0 }
    }

    /// Equilibrium without load; `None` where its tangent cannot be factored.
    pub(super) fn begin(&mut self) -> Option<Spot> {
        let state = self.system.start();
        let balance = self.system.balance(&state);
        let spot = self.settled(state, balance)?;
        self.first_speed = self.length(&spot.rate);
        Some(spot)
    }

    fn settled(&self, state: State, balance: Balance) -> Option<Spot> {
        let tangent = self.system.tangent(&balance, state.factor)?;
        let motion = self.system.solve(&tangent, &balance.push)?;
        Some(Spot { state, balance, tangent, rate: Step { motion, rise: 1.0 } })
    }

    /// The walk's measure.
    pub(super) fn inner(&self, a: &Step, b: &Step) -> f64 {
        let least_m = LEAST_MOTION * self.system.scale_m;
        self.system.inner(&a.motion, &b.motion) + least_m * least_m * a.rise * b.rise
    }

    pub(super) fn length(&self, step: &Step) -> f64 {
        self.inner(step, step).sqrt()
    }

    /// Newton at the wanted load. Past a critical point the step must be taken along the arc.
    pub(super) fn land(&mut self, from: &Spot, until: f64) -> Option<Landing> {
        let landing = self.correct(from, until, false)?;
        (landing.spot.negative() <= from.negative()).then_some(landing)
    }

    /// Along the arc: the step's end stays in the plane across the step so far (Riks, Ramm).
    pub(super) fn arc(&mut self, from: &Spot, rise: f64) -> Option<Landing> {
        self.correct(from, from.state.factor + rise, true)
    }

    fn correct(&mut self, from: &Spot, factor: f64, along_arc: bool) -> Option<Landing> {
        let system = self.system;
        let rise = factor - from.state.factor;
        let foretold = from.rate.motion.iter().map(|rate| rate * rise).collect();
        let mut step = Step { motion: foretold, rise };
        let mut state = system.moved(&from.state, &step.motion, factor);
        for iterations in 0..=ITERATIONS {
            let balance = system.balance(&state);
            if balance.residual <= self.options.tolerance + 8.0 * balance.rounding {
                let spot = self.settled(state, balance)?;
                let sound = self.keeps_to_path(from, &spot, &step);
                return sound.then_some(Landing { spot, step, iterations });
            }
            if iterations == ITERATIONS || !balance.residual.is_finite() {
                return None;
            }
            self.iterations += 1;
            let tangent = system.tangent(&balance, state.factor)?;
            let mut change = Step { motion: system.solve(&tangent, &balance.rest)?, rise: 0.0 };
            if along_arc {
                let rate = Step { motion: system.solve(&tangent, &balance.push)?, rise: 1.0 };
                change.rise = -self.inner(&step, &change) / self.inner(&step, &rate);
                change.add(&rate, change.rise);
            }
            if !(change.rise.is_finite() && system.largest_spin(&change.motion) <= SPIN_RAD) {
                return None;
            }
            step.add(&change, 1.0);
            step.rise += change.rise;
            // at a load, the factor stays the very number asked for
            let factor = if along_arc { from.state.factor + step.rise } else { factor };
            state = system.moved(&state, &change.motion, factor);
        }
        None
    }

    /// Whether a step goes along the path where it starts and where it ends. At each, a factor of
    /// 1 weighs as far as the frame moves for it there, or unloaded if that is less: then twice the
    /// stiffness is 18 degrees off, three times 27, and a limit point is like any other.
    fn keeps_to_path(&self, from: &Spot, to: &Spot, step: &Step) -> bool {
        let along = |spot: &Spot| {
            let squared = self.inner(&spot.rate, &spot.rate);
            let weight = squared.min(self.first_speed.powi(2));
            let length = (self.inner(step, step) + weight * step.rise * step.rise).sqrt();
            let speed = (squared + weight).sqrt();
            (self.inner(step, &spot.rate) + weight * step.rise).abs() >= ALONG * length * speed
        };
        along(from) && along(to)
    }
}

impl Step {
    /// Adds a multiple of another's motion; the rise is the caller's.
    fn add(&mut self, other: &Self, factor: f64) {
        self.motion.iter_mut().zip(&other.motion).for_each(|(x, more)| *x += factor * more);
    }
}
