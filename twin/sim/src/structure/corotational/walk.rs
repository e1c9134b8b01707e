//! Along the equilibrium path: Newton at a load, Riks' arc between loads, the critical point.

use super::system::{Balance, State, System, Tangent};
use super::{Options, Outcome};

/// Newton iterations at one point. Twelve are more than any sound step takes; moments fixed in
/// space make the tangent inexact, so some more.
const ITERATIONS: usize = 20;
/// Cosine of the angle a step may make with the path's direction at its start and at its end: a
/// quarter right angle and a little. A jump to another branch does not keep to it at both.
const ALONG: f64 = 0.9;
/// Largest spin of a node in one iteration, rad.
const SPIN_RAD: f64 = 1.5;
/// A step shorter than this part of the first is below what the balance resolves.
const SHORTEST: f64 = 1e-9;
/// Halvings from the first step to the shortest, and some.
const HALVINGS: usize = 40;

/// A point of the path in equilibrium.
#[derive(Debug)]
pub(super) struct Spot {
    pub(super) state: State,
    pub(super) balance: Balance,
    pub(super) tangent: Tangent,
    /// Motion per unit of factor.
    rate: Vec<f64>,
}

impl Spot {
    /// Directions without resistance.
    pub(super) fn negative(&self) -> usize {
        self.tangent.signed.negative
    }

    /// Compliance `f·K⁻¹ f`: through infinity at a limit point, negative past it.
    fn compliance(&self) -> f64 {
        self.balance.push.iter().zip(&self.rate).map(|(f, u)| f * u).sum()
    }
}

/// A step taken: where to, along what, in how many iterations.
struct Landing {
    spot: Spot,
    step: Vec<f64>,
    iterations: usize,
}

/// What a walk needs to know about itself.
pub(super) struct Walk<'a> {
    pub(super) system: &'a System,
    pub(super) options: &'a Options,
    /// Motion of the unloaded frame per unit of factor.
    pub(super) first_speed: f64,
    /// Newton iterations so far.
    pub(super) iterations: usize,
}

/// The next spot of a walk.
pub(super) enum Next {
    /// In equilibrium, further on.
    Further(Spot),
    /// The wanted factor.
    Arrived(Spot),
    /// No step, however small, could be taken.
    Stuck,
}

/// Direction and length of a step, in the system's measure.
#[derive(Debug, Clone)]
pub(super) struct Heading {
    /// The step before, which says which way is on; empty at the start.
    last: Vec<f64>,
    length: f64,
    shortest: f64,
}

impl Heading {
    pub(super) fn first() -> Self {
        Self { last: Vec::new(), length: f64::INFINITY, shortest: 0.0 }
    }
}

impl Walk<'_> {
    /// Equilibrium without load.
    pub(super) fn begin(&mut self) -> Option<Spot> {
        let state = self.system.start();
        let balance = self.system.balance(&state);
        let spot = self.settled(state, balance)?;
        self.first_speed = self.system.norm(&spot.rate);
        Some(spot)
    }

    fn settled(&self, state: State, balance: Balance) -> Option<Spot> {
        let tangent = self.system.tangent(&balance, state.factor)?;
        let rate = self.system.solve(&tangent, &balance.push)?;
        Some(Spot { state, balance, tangent, rate })
    }

    /// From no load to where the options end it; every spot is shown on the way.
    pub(super) fn follow(&mut self, start: Spot, mut show: impl FnMut(&Spot)) -> (Outcome, Spot) {
        show(&start);
        let (mut at, mut heading, mut lost) = (start, Heading::first(), None);
        for _ in 0..self.options.steps {
            let next = self.next(&at, &mut heading);
            let (spot, arrived) = match next {
                Next::Stuck => break,
                Next::Further(spot) => (spot, false),
                Next::Arrived(spot) => (spot, true),
            };
            if lost.is_none() && spot.negative() > 0 {
                let length = self.system.norm(&heading.last);
                let critical = self.critical(at, &spot, length);
                let factor = critical.factor;
                lost = Some(if critical.limit {
                    Outcome::LimitPoint { factor }
                } else {
                    Outcome::Branches { factor }
                });
                show(&critical.spot);
                if !self.options.past_critical {
                    at = critical.spot;
                    break;
                }
            }
            show(&spot);
            at = spot;
            if arrived {
                return (lost.unwrap_or(Outcome::Converged), at);
            }
        }
        (lost.unwrap_or(Outcome::NotConverged { factor: at.state.factor }), at)
    }

    /// One step on: to the wanted factor where the tangent says it is in reach, else along the arc.
    pub(super) fn next(&mut self, from: &Spot, heading: &mut Heading) -> Next {
        let speed = self.system.norm(&from.rate);
        let bold = self.options.step_turn_rad / self.system.reach(&from.rate) * speed;
        if heading.last.is_empty() {
            heading.length = 0.5 * bold;
            heading.shortest = SHORTEST * bold;
        }
        heading.length = heading.length.min(bold);
        let ahead = if heading.last.is_empty() {
            1.0
        } else {
            self.system.inner(&heading.last, &from.rate).signum()
        };
        let until = self.options.until;
        let to_go = until - from.state.factor;
        for _ in 0..HALVINGS {
            let rise = ahead * heading.length / speed;
            let landing = if !rise.is_finite() || (ahead > 0.0 && rise >= to_go) {
                self.land(from, until)
            } else {
                self.arc(from, rise)
            };
            // within reach after all: the last step is the landing's
            let beyond = |landing: &Landing| landing.spot.state.factor > until;
            match landing {
                Some(landing) if !beyond(&landing) => {
                    heading.length = self.system.norm(&landing.step)
                        * if landing.iterations <= 4 { 1.5 } else { 1.0 };
                    heading.last = landing.step;
                    let arrived = landing.spot.state.factor == until;
                    return if arrived {
                        Next::Arrived(landing.spot)
                    } else {
                        Next::Further(landing.spot)
                    };
                }
                _ => {
                    heading.length = 0.5 * heading.length.min((speed * to_go).abs());
                    if heading.length < heading.shortest {
                        break;
                    }
                }
            }
        }
        Next::Stuck
    }

    /// Newton at the wanted load.
    fn land(&mut self, from: &Spot, until: f64) -> Option<Landing> {
        let rise = until - from.state.factor;
        let foretold: Vec<f64> = from.rate.iter().map(|rate| rate * rise).collect();
        let landing = self.correct(from, &foretold, until, false)?;
        // past a critical point the step must be taken along the arc
        (landing.spot.negative() <= from.negative()).then_some(landing)
    }

    /// Along the arc: the step's end stays in the plane across the step so far (Riks, Ramm).
    fn arc(&mut self, from: &Spot, rise: f64) -> Option<Landing> {
        let foretold: Vec<f64> = from.rate.iter().map(|rate| rate * rise).collect();
        self.correct(from, &foretold, from.state.factor + rise, true)
    }

    fn correct(
        &mut self,
        from: &Spot,
        foretold: &[f64],
        factor: f64,
        along_arc: bool,
    ) -> Option<Landing> {
        let system = self.system;
        let mut step = foretold.to_vec();
        let mut state = system.moved(&from.state, &step, factor);
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
            let mut change = system.solve(&tangent, &balance.rest)?;
            let mut factor = state.factor;
            if along_arc {
                let rate = system.solve(&tangent, &balance.push)?;
                let slope = system.inner(&step, &rate);
                let rise = -system.inner(&step, &change) / slope;
                if !rise.is_finite() {
                    return None;
                }
                change.iter_mut().zip(&rate).for_each(|(x, rate)| *x += rise * rate);
                factor += rise;
            }
            if system.largest_spin(&change) > SPIN_RAD {
                return None;
            }
            step.iter_mut().zip(&change).for_each(|(sum, more)| *sum += more);
            state = system.moved(&state, &change, factor);
        }
        None
    }

    /// Whether a step goes along the path where it starts and where it ends. At each, a factor of
    /// 1 weighs as far as the frame moves for it there, or unloaded if that is less: then twice the
    /// stiffness is 18 degrees off, three times 27, and a limit point is like any other.
    fn keeps_to_path(&self, from: &Spot, to: &Spot, step: &[f64]) -> bool {
        let system = self.system;
        let rise = to.state.factor - from.state.factor;
        let along = |spot: &Spot| {
            let squared = system.inner(&spot.rate, &spot.rate);
            let weight = squared.min(self.first_speed.powi(2));
            let length = (system.inner(step, step) + weight * rise * rise).sqrt();
            let speed = (squared + weight).sqrt();
            (system.inner(step, &spot.rate) + weight * rise).abs() >= ALONG * length * speed
        };
        along(from) && along(to)
    }

    /// Narrows a step that ends past a critical point: the last sound spot before it, the largest
    /// factor met, and whether the factor itself turned back there (a limit point).
    pub(super) fn critical(&mut self, from: Spot, past: &Spot, length: f64) -> Critical {
        let stiffness = |spot: &Spot| 1.0 / spot.compliance();
        let speed = self.system.norm(&from.rate);
        let sound = from.negative();
        let mut low = (0.0, stiffness(&from));
        let mut high = (length, stiffness(past));
        let mut top = from.state.factor.max(past.state.factor);
        let mut best: Option<Spot> = None;
        for turn in 0..60 {
            let width = high.0 - low.0;
            if width <= 1e-9 * length {
                break;
            }
            // a limit point is where stiffness goes through zero; a branch point has no such sign
            let straight = low.0 + width * low.1 / (low.1 - high.1);
            let crossed = low.1 > 0.0 && high.1 < 0.0;
            let at = if crossed && turn % 3 != 2 {
                straight.clamp(low.0 + 1e-3 * width, high.0 - 1e-3 * width)
            } else {
                low.0 + 0.5 * width
            };
            let Some(landing) = self.arc(&from, at / speed) else { break };
            let spot = landing.spot;
            top = top.max(spot.state.factor);
            let here = (at, stiffness(&spot));
            let flat = here.1.abs() <= 1e-6 * low.1.abs().max(high.1.abs());
            if spot.negative() > sound {
                high = here;
            } else {
                low = here;
                best = Some(spot);
            }
            if crossed && flat && here.1.abs() <= 1e-7 * stiffness(&from).abs() {
                break;
            }
        }
        let limit = high.1 < 0.0;
        let spot = best.unwrap_or(from);
        if !limit {
            top = spot.state.factor;
        }
        Critical { spot, factor: top, limit }
    }
}

/// Where the path first loses stability.
pub(super) struct Critical {
    pub(super) spot: Spot,
    pub(super) factor: f64,
    pub(super) limit: bool,
}
