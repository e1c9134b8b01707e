//! Which closed form fits a chain.

use super::arm::{Arm, Solver};
use super::cartesian::Cartesian;
use super::chain::{Chain, ChainFault};
use super::lines::lines;
use super::numeric::Numeric;
use super::opw::Opw;
use super::parallel::Parallel;
use super::posture::MAX_DOF;
use super::srs::Srs;

/// Finds the arm's type from its axes, with joints at zero, to 1e-6 m and rad; names play no part.
///
/// An arm behind further joints (a torso, a rail) is recognised once those are held
/// ([`Chain::hold`]).
pub fn recognise(chain: &Chain) -> Result<Arm, ChainFault> {
    if chain.dof() > MAX_DOF {
        return Err(ChainFault::TooManyJoints { dof: chain.dof(), most: MAX_DOF });
    }
    Ok(Arm { chain: chain.clone(), solver: solver(chain) })
}

fn solver(chain: &Chain) -> Solver {
    if let Some((lines, tip)) = lines(chain) {
        if let Some(opw) = Opw::fit(&lines, &tip) {
            return Solver::Opw(opw);
        }
        if let Some(parallel) = Parallel::fit(&lines, &tip) {
            return Solver::Parallel(parallel);
        }
        if let Some(srs) = Srs::fit(&lines, &tip) {
            return Solver::Srs(srs);
        }
    }
    match Cartesian::fit(chain) {
        Some(cartesian) => Solver::Cartesian(cartesian),
        None => Solver::Numeric(Numeric::default()),
    }
}
