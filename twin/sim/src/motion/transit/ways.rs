//! Ways of a few straight pieces: out of both ends, across, or through home.

use super::How;
use super::ask::Ask;
use super::metric::Metric;
use crate::kinematics::Posture;

/// A straight way out of an end, without it; empty: the end itself.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Exit {
    /// Which way it leads.
    pub(crate) how: How,
    /// Its postures, outwards.
    pub(crate) way: Vec<Posture>,
}

/// The clear part of each way out of `end`, and a short piece of it: where a little room is enough
/// the whole way would cost time. The first exit is the end itself.
pub(super) fn clear_exits(ask: &mut Ask<'_>, end: &Posture, exits: Vec<Exit>) -> Vec<Exit> {
    /// The short piece is this part of the whole.
    const PART: usize = 4;
    let mut clear = vec![Exit { how: How::Direct, way: Vec::new() }];
    for Exit { how, mut way } in exits {
        let n_asked = way.len();
        let mut before = *end;
        let n_clear = way
            .iter()
            .take_while(|q| {
                let is_clear = ask.clear(&before, q).is_ok();
                before = **q;
                is_clear
            })
            .count();
        way.truncate(n_clear);
        let short = n_asked.div_ceil(PART);
        if n_clear > short && how == How::Along {
            clear.push(Exit { how, way: way[..short].to_vec() });
        }
        if n_clear > 0 {
            clear.push(Exit { how, way });
        }
    }
    clear
}

/// The two ends and the ways out of them.
pub(super) struct Ends<'a> {
    pub(super) from: Posture,
    pub(super) to: Posture,
    pub(super) home: Posture,
    pub(super) here: &'a [Exit],
    pub(super) there: &'a [Exit],
}

impl Ends<'_> {
    /// The quickest clear way out, across and in, or through home. The straight move from end to
    /// end is taken as asked before.
    pub(super) fn cross(&self, ask: &mut Ask<'_>, metric: &Metric) -> Option<(How, Vec<Posture>)> {
        let mut ways: Vec<(f64, How, Vec<Posture>, usize)> = Vec::new();
        for out in self.here {
            for into in self.there {
                let how = out.how.max(into.how);
                if how != How::Direct {
                    let way = self.join(out, None, into);
                    ways.push((metric.time(&way), how, way, out.way.len()));
                }
            }
        }
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, how, way, n_out) in ways {
            if ask.clear(&way[n_out], &way[n_out + 1]).is_ok() {
                return Some((how, way));
            }
        }
        self.through_home(ask, metric)
    }

    fn through_home(&self, ask: &mut Ask<'_>, metric: &Metric) -> Option<(How, Vec<Posture>)> {
        if self.from == self.home || self.to == self.home {
            return None;
        }
        let mut nearest_clear = |end: &Posture, exits: &[Exit]| {
            let mut exits: Vec<(f64, Exit)> = exits
                .iter()
                .map(|exit| {
                    let mut way = vec![*end];
                    way.extend(&exit.way);
                    way.push(self.home);
                    (metric.time(&way), exit.clone())
                })
                .collect();
            exits.sort_by(|a, b| a.0.total_cmp(&b.0));
            let reaches = |exit: &Exit| ask.clear(exit.way.last().unwrap_or(end), &self.home);
            exits.into_iter().map(|(_, exit)| exit).find({
                let mut reaches = reaches;
                move |exit| reaches(exit).is_ok()
            })
        };
        let out = nearest_clear(&self.from, self.here)?;
        let into = nearest_clear(&self.to, self.there)?;
        Some((How::Home, self.join(&out, Some(self.home), &into)))
    }

    fn join(&self, out: &Exit, middle: Option<Posture>, into: &Exit) -> Vec<Posture> {
        let mut way = vec![self.from];
        way.extend(&out.way);
        way.extend(middle);
        way.extend(into.way.iter().rev());
        way.push(self.to);
        way
    }
}
