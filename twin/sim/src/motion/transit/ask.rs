//! The one question of the planner, and what the answers add up to.

use crate::clearance::Blocked;
use crate::kinematics::Posture;

/// Whether the straight joint move between two postures keeps this clearance, m, all the way; a move
/// from a posture to itself asks for the posture.
pub(crate) type Free<'a> = dyn Fn(&Posture, &Posture, f64) -> Result<(), Blocked> + Sync + 'a;

/// The question with the clearance wanted; counts how often it was asked.
pub(super) struct Ask<'a> {
    free: &'a Free<'a>,
    pub(super) need_m: f64,
    pub(super) n_checks: usize,
}

impl<'a> Ask<'a> {
    pub(super) fn new(free: &'a Free<'a>, need_m: f64) -> Self {
        Self { free, need_m, n_checks: 0 }
    }

    pub(super) fn clear(&mut self, from: &Posture, to: &Posture) -> Result<(), Blocked> {
        self.n_checks += 1;
        (self.free)(from, to, self.need_m)
    }

    /// Whether every move of a way is clear, or the first that is not.
    pub(super) fn way(&mut self, way: &[Posture]) -> Result<(), (usize, Blocked)> {
        for (k, pair) in way.windows(2).enumerate() {
            self.clear(&pair[0], &pair[1]).map_err(|blocked| (k, blocked))?;
        }
        Ok(())
    }
}

/// Which pairs of bodies stood in the way, how often, and where nearest to where the moves began.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally {
    rows: Vec<Row>,
    n: usize,
}

/// What one pair of bodies did.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) bodies: [String; 2],
    pub(super) n: usize,
    pub(super) clearance_m: f64,
    /// The blocked posture nearest to the root of the search.
    pub(super) q: Posture,
    away_m: f64,
}

impl Tally {
    /// `q` is the blocked posture, `away_m` how far it is from where the search began.
    pub(super) fn note(&mut self, blocked: Blocked, q: Posture, away_m: f64) {
        let Blocked { clearance_m, pair: bodies, .. } = blocked;
        self.n += 1;
        match self.rows.iter_mut().find(|row| row.bodies == bodies) {
            Some(row) => {
                row.n += 1;
                if away_m < row.away_m {
                    *row = Row { bodies, n: row.n, clearance_m, q, away_m };
                }
            }
            None => self.rows.push(Row { bodies, n: 1, clearance_m, q, away_m }),
        }
    }

    /// The pair that blocked most often, of equal ones the nearest, with its share of all blocks.
    pub(super) fn worst(&self) -> Option<(&Row, f64)> {
        let worst =
            self.rows.iter().min_by(|a, b| b.n.cmp(&a.n).then(a.away_m.total_cmp(&b.away_m)))?;
        Some((worst, worst.n as f64 / self.n as f64))
    }
}
