//! Most probable values of the parameters, and how sure they are.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::interval::Interval;
use crate::process::StrandInput;

use super::known::{Known, Parameter};
use super::next::{Next, best};
use super::predict::{Measured, Print, predicted_m};
use super::prior::{NINETY, Prior, ninety_percent};

/// A print whose measurement is further than this many standard deviations from the fit does not fit.
pub const MISFIT_SIGMAS: f64 = 3.0;
/// A parameter of which the prints take less than this share of its prior deviation is not informed.
const INFORMED: f64 = 0.05;
/// Half step of the differences, standard deviations of the prior.
const DIFFERENCE: f64 = 1e-4;
/// Steps after which a search stops, whatever it found.
const MOST_STEPS: usize = 60;
/// Step at which it has arrived, standard deviations of the prior.
const ARRIVED: f64 = 1e-7;
/// The sum may differ by this share from a parabola's at the ends of an interval for it to be taken as one.
const STRAIGHT: f64 = 0.1;
/// Places where a start is looked for, standard deviations of the prior.
const STARTS: [f64; 7] = [-2.4, -1.6, -0.8, 0.0, 0.8, 1.6, 2.4];

/// What the prints say.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Every number the material has, in order of [`Parameter::ALL`].
    pub parameters: Vec<Fitted>,
    /// One for each print, in their order.
    pub residuals: Vec<Residual>,
    /// Sum of the squares of `sigmas`; about the number of prints less the parameters they inform.
    pub chi2: f64,
    /// Whether the search arrived; else the values are the best it met.
    pub arrived: bool,
    /// What is known now: informed parameters with their fitted 90 % intervals, the others as before.
    pub known: Known,
    /// The print that would help most, if any would.
    pub next: Option<Next>,
}

/// What the prints say of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitted {
    /// Which.
    pub parameter: Parameter,
    /// Its range before.
    pub before: Interval,
    /// Most probable value and 90 % interval; as before where it is not informed.
    pub after: Interval,
    /// Standard deviation after over before, on the scale of the fit; one: nothing was learnt.
    pub doubt_left: f64,
    /// Whether any print informs it.
    pub informed: bool,
    /// Whether the interval reaches past the range from before: look at the print, or at the range.
    pub past_range: bool,
}

/// One print against the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// What the fit says it measures, m.
    pub predicted_m: f64,
    /// Measured less predicted, standard deviations of the measurement.
    pub sigmas: f64,
    /// False past [`MISFIT_SIGMAS`], and where nothing finite can be predicted or compared.
    pub fits: bool,
}

/// Fits every parameter of the material to the prints.
///
/// Maximum a posteriori: minimises `Σ ((measured − predicted)/σ)² + Σ u²`, `u` the parameters in standard
/// deviations of their priors ([`Prior`]: `low..high` holds 90 %, normal in the logarithm where positive).
/// Levenberg–Marquardt with central differences, from the best start of a fixed scan. An interval holds 90 % of the probability along the ridge of the
/// linearised posterior (covariance `(1 + JᵀJ)⁻¹`): ±1.645 deviations where the sum rises as it should, else
/// integrated, since a taut bridge says only how little slack there is.
/// Prints that are not finite are left out and do not fit. `usual` is a strand as it is usually
/// printed, for the proposal of the next print. Bounded in time; any input.
pub fn fit(known: &Known, prints: &[Measured], usual: Option<&StrandInput>) -> Fit {
    let problem = Problem::new(known, prints);
    let found = problem.search(problem.start());
    let precision = problem.precision(&found.at);
    let covariance = inverse(&precision);
    let mut now = known.clone();
    let mut parameters = Vec::new();
    for parameter in Parameter::ALL {
        let Some(before) = known.get(parameter) else { continue };
        let mut fitted = Fitted {
            parameter,
            before,
            after: before,
            doubt_left: 1.0,
            informed: false,
            past_range: false,
        };
        let index = problem.priors.iter().position(|(fitted, _)| *fitted == parameter);
        if let Some(index) = index {
            let (at, [low, high]) = (found.at[index], problem.ends(&found, &covariance, index));
            let doubt_left = 0.5 * (high - low) / NINETY;
            if doubt_left < 1.0 - INFORMED {
                let value = |place| problem.priors[index].1.value(place);
                let after = Interval::new(value(at), value(low), value(high));
                let past_range = after.low < before.low || after.high > before.high;
                fitted = Fitted { after, doubt_left, informed: true, past_range, ..fitted };
                now = now.with(parameter, after);
            }
        }
        parameters.push(fitted);
    }
    let fitted = problem.known_at(&found.at);
    let residuals: Vec<Residual> = prints.iter().map(|it| residual(it, &fitted)).collect();
    let finite = |it: &Residual| if it.sigmas.is_finite() { it.sigmas * it.sigmas } else { 0.0 };
    let chi2 = residuals.iter().map(finite).sum();
    let slopes = |print: &Print| problem.slopes(print, &found.at);
    let names: Vec<Parameter> = problem.priors.iter().map(|(parameter, _)| *parameter).collect();
    let next = best(&fitted, usual, &names, &precision, slopes);
    Fit { parameters, residuals, chi2, arrived: found.arrived, known: now, next }
}

fn residual(measured: &Measured, known: &Known) -> Residual {
    let predicted_m = predicted_m(&measured.print, known);
    let sigmas = (measured.value_m - predicted_m) / measured.deviation_m;
    Residual { predicted_m, sigmas, fits: is_usable(measured) && sigmas.abs() <= MISFIT_SIGMAS }
}

fn is_usable(measured: &Measured) -> bool {
    let deviation = measured.deviation_m;
    measured.value_m.is_finite() && deviation.is_finite() && deviation > 0.0
}

/// Covariance of the parameters from their precision; that of the priors where it cannot be had.
pub(super) fn inverse(precision: &DMatrix<f64>) -> DMatrix<f64> {
    let prior = || DMatrix::identity(precision.nrows(), precision.ncols());
    Cholesky::new(precision.clone()).map_or_else(prior, |factor| factor.inverse())
}

/// What is to be minimised, in standard deviations of the priors.
struct Problem<'a> {
    known: &'a Known,
    prints: Vec<Measured>,
    priors: Vec<(Parameter, Prior)>,
}

/// Where a search ended.
struct Found {
    at: DVector<f64>,
    cost: f64,
    arrived: bool,
}

impl<'a> Problem<'a> {
    fn new(known: &'a Known, prints: &[Measured]) -> Self {
        let prior = |parameter| Some((parameter, Prior::of(known.get(parameter)?)?));
        let priors: Vec<_> = Parameter::ALL.into_iter().filter_map(prior).collect();
        let mut problem = Self { known, prints: Vec::new(), priors };
        let middle = problem.known_at(&DVector::zeros(problem.priors.len()));
        let usable = |it: &&Measured| is_usable(it) && predicted_m(&it.print, &middle).is_finite();
        problem.prints = prints.iter().filter(usable).copied().collect();
        problem
    }

    fn known_at(&self, at: &DVector<f64>) -> Known {
        let numbers = self.priors.iter().zip(at.iter());
        numbers.fold(self.known.clone(), |known, ((parameter, prior), &deviations)| {
            known.with(*parameter, Interval::exact(prior.value(deviations)))
        })
    }

    /// Predicted less measured, in standard deviations of the measurement.
    fn residuals(&self, at: &DVector<f64>) -> DVector<f64> {
        let known = self.known_at(at);
        let residual =
            |it: &Measured| (predicted_m(&it.print, &known) - it.value_m) / it.deviation_m;
        DVector::from_iterator(self.prints.len(), self.prints.iter().map(residual))
    }

    fn cost(&self, at: &DVector<f64>) -> f64 {
        self.residuals(at).norm_squared() + at.norm_squared()
    }

    /// What a print's prediction gains by one standard deviation of each parameter, m.
    fn slopes(&self, print: &Print, at: &DVector<f64>) -> DVector<f64> {
        let predicted = |index: usize, by: f64| {
            let mut moved = at.clone();
            moved[index] += by;
            predicted_m(print, &self.known_at(&moved))
        };
        DVector::from_fn(self.priors.len(), |index, _| {
            let slope = predicted(index, DIFFERENCE) - predicted(index, -DIFFERENCE);
            if slope.is_finite() { slope / (2.0 * DIFFERENCE) } else { 0.0 }
        })
    }

    fn jacobian(&self, at: &DVector<f64>) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.prints.len(), self.priors.len());
        for (row, measured) in self.prints.iter().enumerate() {
            let slopes = self.slopes(&measured.print, at) / measured.deviation_m;
            jacobian.set_row(row, &slopes.transpose());
        }
        jacobian
    }

    /// Inverse covariance of the linearised posterior, `1 + JᵀJ`.
    fn precision(&self, at: &DVector<f64>) -> DMatrix<f64> {
        let jacobian = self.jacobian(at);
        let count = self.priors.len();
        DMatrix::identity(count, count) + jacobian.tr_mul(&jacobian)
    }

    /// One parameter after another put where the cost is least, twice over: out of the places where a print
    /// does not feel a parameter (a taut strand its slack, a dose below the critical one the depth).
    fn start(&self) -> DVector<f64> {
        let mut start = DVector::zeros(self.priors.len());
        let mut least = self.cost(&start);
        for index in (0..start.len()).chain(0..start.len()) {
            for place in STARTS {
                let mut at = start.clone();
                at[index] = place;
                let cost = self.cost(&at);
                if cost < least {
                    (start, least) = (at, cost);
                }
            }
        }
        start
    }

    fn search(&self, start: DVector<f64>) -> Found {
        let mut found = Found { cost: self.cost(&start), at: start, arrived: false };
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let jacobian = self.jacobian(&found.at);
            let gradient = jacobian.tr_mul(&self.residuals(&found.at)) + &found.at;
            let precision =
                jacobian.tr_mul(&jacobian) + DMatrix::identity(found.at.len(), found.at.len());
            // Damped until a step goes down; the damping is bounded, so is the loop.
            loop {
                let mut damped = precision.clone();
                for index in 0..found.at.len() {
                    damped[(index, index)] *= 1.0 + damping;
                }
                let Some(factor) = Cholesky::new(damped) else { return found };
                let at = &found.at - factor.solve(&gradient);
                let step = (&at - &found.at).norm();
                let cost = self.cost(&at);
                if cost <= found.cost {
                    found = Found { at, cost, arrived: step < ARRIVED };
                    damping = (0.1 * damping).max(1e-12);
                    break;
                }
                if step < ARRIVED {
                    return Found { arrived: true, ..found };
                }
                damping *= 10.0;
                if damping >= 1e12 {
                    return found;
                }
            }
            if found.arrived {
                break;
            }
        }
        found
    }

    /// Ends of the 90 % interval of a parameter, standard deviations of its prior.
    fn ends(&self, found: &Found, covariance: &DMatrix<f64>, index: usize) -> [f64; 2] {
        let deviation = covariance[(index, index)].sqrt();
        let ridge = covariance.column(index) / deviation;
        let rise = |reach: f64| self.cost(&(&found.at + &ridge * reach)) - found.cost;
        let is_straight =
            |side: f64| (rise(side * NINETY) / NINETY.powi(2) - 1.0).abs() <= STRAIGHT;
        let reaches = match is_straight(-1.0) && is_straight(1.0) {
            true => [-NINETY, NINETY],
            false => ninety_percent(rise),
        };
        reaches.map(|reach| found.at[index] + reach * deviation)
    }
}
