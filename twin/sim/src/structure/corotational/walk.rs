//! Along the equilibrium path: steps bounded in turn, to the wanted factor or a critical point.

use super::Outcome;
use super::newton::{Landing, Spot, Step, Walk};

/// A step shorter than this part of the first is below what the balance resolves.
const SHORTEST: f64 = 1e-9;
/// Halvings from the first step to the shortest, and some.
const HALVINGS: usize = 40;

/// The next spot of a walk.
enum Next {
    /// In equilibrium, further on.
    Further(Spot),
    /// The wanted factor.
    Arrived(Spot),
    /// No step, however small, could be taken.
    Stuck,
}

/// Direction and length of a step, in the walk's measure.
#[derive(Debug, Clone)]
struct Heading {
    /// The step before, which says which way is on.
    last: Option<Step>,
    length: f64,
    shortest: f64,
}

/// Where the path first loses stability.
struct Critical {
    /// The last sound spot before it.
    spot: Spot,
    /// The largest factor met.
    factor: f64,
    /// Whether the factor itself turned back there.
    limit: bool,
}

impl Walk<'_> {
    /// From no load to where the options end it; every spot is shown on the way.
    pub(super) fn follow(&mut self, start: Spot, mut show: impl FnMut(&Spot)) -> (Outcome, Spot) {
        show(&start);
        let mut heading = Heading { last: None, length: f64::INFINITY, shortest: 0.0 };
        let (mut at, mut lost) = (start, None);
        for _ in 0..self.options.steps {
            let (spot, arrived) = match self.next(&at, &mut heading) {
                Next::Stuck => break,
                Next::Further(spot) => (spot, false),
                Next::Arrived(spot) => (spot, true),
            };
            if let (None, Some(last)) =
                (lost, heading.last.as_ref().filter(|_| spot.negative() > 0))
            {
                let Critical { spot, factor, limit } = self.critical(at, &spot, last);
                lost = Some(if limit {
                    Outcome::LimitPoint { factor }
                } else {
                    Outcome::Branches { factor }
                });
                show(&spot);
                at = spot;
                if !self.options.past_critical {
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
    fn next(&mut self, from: &Spot, heading: &mut Heading) -> Next {
        let speed = self.length(&from.rate);
        let until = self.options.until;
        let turns = self.options.step_turn_rad / self.system.reach(&from.rate.motion);
        // what does not turn goes in one step
        let bold = speed * turns.min(2.0 * until);
        let ahead = heading.last.as_ref().map_or(1.0, |last| self.inner(last, &from.rate).signum());
        if heading.last.is_none() {
            heading.length = 0.5 * bold;
            heading.shortest = SHORTEST * bold;
        }
        heading.length = heading.length.min(bold);
        let to_go = until - from.state.factor;
        for _ in 0..HALVINGS {
            let rise = ahead * heading.length / speed;
            let landing = if !rise.is_finite() || (ahead > 0.0 && rise >= to_go) {
                self.land(from, until)
            } else {
                self.arc(from, rise)
            };
            // beyond the wanted factor: it is in reach after all, of a shorter step
            let landing = landing.filter(|landing| !(landing.spot.state.factor > until));
            if let Some(Landing { spot, step, iterations }) = landing {
                heading.length = self.length(&step) * if iterations <= 4 { 1.5 } else { 1.0 };
                heading.last = Some(step);
                let arrived = spot.state.factor == until;
                return if arrived { Next::Arrived(spot) } else { Next::Further(spot) };
            }
            heading.length = 0.5 * heading.length.min((speed * to_go).abs());
            if heading.length < heading.shortest {
                break;
            }
        }
        Next::Stuck
    }

    /// Narrows a step that ends past a critical point. What the factor climbs per length goes
    /// through zero at a limit point and is looked for there; at a branch it does not, and the
    /// step is halved.
    fn critical(&mut self, from: Spot, past: &Spot, step: &Step) -> Critical {
        let speed = self.length(&from.rate);
        let sound = from.negative();
        let length = self.length(step);
        let mut low = (0.0, 1.0 / speed);
        let mut high = (length, self.climb(past, step));
        let mut top = from.state.factor.max(past.state.factor);
        let (mut best, mut stayed) = (None, None);
        for _ in 0..60 {
            let width = high.0 - low.0;
            if !(width > 1e-8 * length) {
                break;
            }
            let crosses = low.1 > 0.0 && high.1 < 0.0;
            let at = if crosses {
                let straight = low.0 + width * low.1 / (low.1 - high.1);
                straight.clamp(low.0 + 1e-2 * width, high.0 - 1e-2 * width)
            } else {
                low.0 + 0.5 * width
            };
            let Some(landing) = self.arc(&from, at / speed) else { break };
            let here = (at, self.climb(&landing.spot, &landing.step));
            top = top.max(landing.spot.state.factor);
            // a bound that stays twice counts half (Illinois), so that both close in
            let flat = crosses && here.1.abs() <= 1e-7 / speed;
            if landing.spot.negative() > sound {
                low.1 *= if stayed == Some(true) { 0.5 } else { 1.0 };
                (high, stayed) = (here, Some(true));
            } else {
                high.1 *= if stayed == Some(false) { 0.5 } else { 1.0 };
                (low, stayed) = (here, Some(false));
                best = Some(landing.spot);
                if flat {
                    break;
                }
            }
        }
        let limit = high.1 < 0.0;
        let spot = best.unwrap_or(from);
        let factor = if limit { top } else { spot.state.factor };
        Critical { spot, factor, limit }
    }

    /// Rise of the factor per length, going on the way a step went.
    fn climb(&self, spot: &Spot, step: &Step) -> f64 {
        self.inner(step, &spot.rate).signum() / self.length(&spot.rate)
    }
}
