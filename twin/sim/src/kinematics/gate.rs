//! What every candidate of a closed form must pass on its way to the solutions.

use std::f64::consts::TAU;

use super::arm::{IkOptions, Solution};
use super::branch::Branch;
use super::canonical::JointMap;
use super::chain::Chain;
use super::planar::Play;
use super::polish::{POSITION_TOLERANCE_M, ROTATION_TOLERANCE_RAD, polish, pose_error};
use super::posture::{MAX_DOF, Posture};
use super::turns::{Turns, all_turns, same_turned};
use crate::pose::Pose;

/// A closed form that leaves less than this, m and rad, is not polished.
const SHARP: f64 = 1e-12;
/// Two solutions nearer than this in every joint are one, rad or m.
const SAME: f64 = 1e-7;
/// The same for polished or searched solutions, which stop at different errors.
const SAME_POLISHED: f64 = 1e-6;

/// Error of a candidate's tip, m and rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TipError {
    pub(super) m: f64,
    pub(super) rad: f64,
}

/// One inverse problem: what is asked, and the solutions so far.
pub(super) struct Gate<'a> {
    pub(super) chain: &'a Chain,
    pub(super) target: &'a Pose,
    pub(super) options: &'a IkOptions<'a>,
    /// Whether the closed form is the chain to rounding, so that its angles can be held against the
    /// limits, and its own error believed.
    pub(super) exact: bool,
    /// What the closed form is to allow for.
    pub(super) play: Play,
    /// Set once two branches are so close that they may be one.
    pub(super) close: bool,
    pub(super) out: &'a mut Vec<Solution>,
}

impl Gate<'_> {
    /// Values of joint `index` at canonical angle `theta`; `None` where the limits allow none.
    #[inline]
    pub(super) fn turns(&self, index: usize, map: &JointMap, theta: f64) -> Option<Turns> {
        let value = map.q(theta);
        if !self.exact {
            return Some(Turns::only(value));
        }
        let near = self.options.seed.and_then(|seed| seed.get(index).copied());
        Turns::within(&self.chain.axes()[index], value, near)
    }

    /// Takes a candidate of a closed form whose own forward kinematics leave `error`.
    pub(super) fn keep(&mut self, turns: &[Turns], branch: Branch, error: TipError) {
        if self.exact && error.m < SHARP && error.rad < SHARP {
            self.push(turns, branch, error, SAME);
            return;
        }
        let q = firsts(turns);
        let same = if self.exact { SAME } else { SAME_POLISHED };
        self.keep_polished(q, branch, same);
    }

    /// Takes a posture found by search.
    pub(super) fn keep_searched(&mut self, q: Posture) {
        self.keep_polished(q, Branch::default(), SAME_POLISHED);
    }

    fn keep_polished(&mut self, mut q: Posture, branch: Branch, same: f64) {
        let (m, rad) = polish(self.chain, self.target, &mut q);
        if m <= POSITION_TOLERANCE_M && rad <= ROTATION_TOLERANCE_RAD {
            self.keep_as_is(q, branch, TipError { m, rad }, same);
        }
    }

    /// Takes a posture of an arm that cannot turn, if it is in place.
    pub(super) fn keep_place(&mut self, q: Posture) {
        let (offset, rotation) = pose_error(&self.chain.forward(&q), self.target);
        let error = TipError { m: offset.norm(), rad: rotation.norm() };
        if error.m <= POSITION_TOLERANCE_M {
            self.keep_as_is(q, Branch::default(), error, SAME);
        }
    }

    fn keep_as_is(&mut self, q: Posture, branch: Branch, error: TipError, same: f64) {
        if let Some(turns) = all_turns(self.chain, &q, self.options.seed) {
            self.push(&turns[..q.len().min(MAX_DOF)], branch, error, same);
        }
    }

    /// Adds all copies that are not there yet.
    fn push(&mut self, turns: &[Turns], branch: Branch, error: TipError, same: f64) {
        let axes = self.chain.axes();
        let twin = |known: &Solution| {
            let mut entries = known.q.iter().zip(turns).zip(axes);
            entries.all(|((value, turns), axis)| same_turned(axis, *value, turns.first, same))
        };
        // Branches that are far apart need no comparing, nor do the copies of different ones.
        let met = self.close && self.out.iter().any(twin);
        let out = &mut *self.out;
        let known = out.len();
        let q = firsts(turns);
        out.push(Solution { q, branch, position_error_m: error.m, rotation_error_rad: error.rad });
        // Each joint repeats all there is so far, a turn further.
        for (index, turns) in turns.iter().enumerate().filter(|(_, turns)| turns.more > 0) {
            let block = known..out.len();
            for turn in 1..=turns.more {
                let further = (turns.first + f64::from(turn) * TAU).min(axes[index].upper);
                let copies = out.len();
                out.extend_from_within(block.clone());
                for copy in &mut out[copies..] {
                    copy.q[index] = further;
                }
            }
        }
        if met {
            let added = out.split_off(known);
            for solution in added {
                if out[..known].iter().all(|known| known.q.distance(&solution.q) > same) {
                    out.push(solution);
                }
            }
        }
    }
}

/// The least value of every joint.
fn firsts(turns: &[Turns]) -> Posture {
    let mut q = Posture::zeros(turns.len());
    for (value, turns) in q.iter_mut().zip(turns) {
        *value = turns.first;
    }
    q
}
