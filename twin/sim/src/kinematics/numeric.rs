//! Any other arm: damped least squares from many starts. Finds postures, never proves there are
//! no more.

use std::f64::consts::PI;

use nalgebra::Vector6;

use super::chain::Chain;
use super::gate::Gate;
use super::polish::{damped_step, pose_error, twist};
use super::posture::{MAX_DOF, Posture};
use crate::pose::Pose;

/// How hard to search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Numeric {
    /// Starts per pose: the seed, the middle of the limits, then points spread by a fixed sequence.
    pub starts: usize,
    /// Steps per start.
    pub steps: usize,
}

impl Default for Numeric {
    fn default() -> Self {
        Self { starts: 64, steps: 60 }
    }
}

/// A start ends when its error is below this, m and rad; the final check has its own tolerance.
const CONVERGED: f64 = 1e-11;

impl Numeric {
    /// Postures, limits aside, that put the tip on `target`; the same one may come more than once.
    pub(super) fn candidates(&self, gate: &mut Gate) {
        let (chain, target, seed) = (gate.chain, gate.target, gate.options.seed);
        let mut random = Xorshift::new(0x9e37_79b9_7f4a_7c15);
        for start in 0..self.starts {
            let begin = match (start, seed) {
                (0, Some(seed)) if seed.len() >= chain.dof() => Posture::new(&seed[..chain.dof()]),
                (0 | 1, _) => between(chain, || 0.5),
                _ => between(chain, || random.unit()),
            };
            if let Some(found) = self.descend(chain, target, begin) {
                gate.keep_searched(found);
            }
        }
    }

    /// Levenberg–Marquardt on offset and rotation vector, 1 m counted as 1 rad.
    fn descend(&self, chain: &Chain, target: &Pose, mut q: Posture) -> Option<Posture> {
        let mut columns = [Vector6::zeros(); MAX_DOF];
        let mut damping = 1e-3;
        let mut tip = chain.jacobian_into(&q, &mut columns);
        let mut error = twist(&pose_error(&tip, target));
        for _ in 0..self.steps {
            if error.amax() < CONVERGED {
                return Some(q);
            }
            let step = damped_step(&columns[..chain.dof()], &error, damping)?;
            let longest = step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let scale = (1.0 / longest).min(1.0);
            let mut moved = q;
            for (value, change) in moved.iter_mut().zip(step) {
                *value += scale * change;
            }
            tip = chain.forward(&moved);
            let next = twist(&pose_error(&tip, target));
            if next.norm_squared() < error.norm_squared() {
                (q, error) = (moved, next);
                chain.jacobian_into(&q, &mut columns);
                damping = (damping * 0.2).max(1e-15);
            } else {
                damping *= 8.0;
                if damping > 1e3 {
                    return None;
                }
            }
        }
        (error.amax() < CONVERGED).then_some(q)
    }
}

/// A posture at the given shares of the way from lower to upper limit; open ends count as ±π.
fn between(chain: &Chain, mut share: impl FnMut() -> f64) -> Posture {
    let mut q = Posture::zeros(chain.dof());
    for (value, axis) in q.iter_mut().zip(chain.axes()) {
        let lower = if axis.lower.is_finite() { axis.lower } else { -PI };
        let upper = if axis.upper.is_finite() { axis.upper } else { PI };
        *value = lower + (upper - lower) * share();
    }
    q
}

/// Marsaglia's xorshift64*: the same numbers everywhere, so the same input gives the same answer.
#[derive(Debug, Clone)]
pub(super) struct Xorshift(u64);

impl Xorshift {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed | 1)
    }

    /// Next number in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11;
        bits as f64 / (1_u64 << 53) as f64
    }
}
