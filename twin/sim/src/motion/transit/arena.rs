//! One move to be planned: the attempts in order.

use super::ask::{Ask, Free};
use super::metric::{Metric, Room};
use super::random::Random;
use super::reason::{self, Reason};
use super::rrt::{Search, Tree};
use super::ways::{Ends, Exit, clear_exits};
use super::{How, Transit, shortcut};
use crate::kinematics::Posture;

/// Planned against, in terms of the limit: room for what sag and shrinkage will do to the deposit.
const WIDE: f64 = 2.0;
/// Questions spent on making a found way shorter.
const CHECKS_TO_SHORTEN: usize = 60;

/// What there is to plan with.
pub(super) struct Arena<'a> {
    pub(super) metric: &'a Metric,
    pub(super) room: Room,
    pub(super) from: Posture,
    pub(super) to: Posture,
    pub(super) home: Posture,
    /// The clearance limit, m.
    pub(super) limit_m: f64,
    pub(super) free: &'a Free<'a>,
    /// Straight ways out of a posture, not yet asked about.
    pub(super) exits: &'a dyn Fn(&Posture) -> Vec<Exit>,
}

/// Both ends with their clear ways out, for one clearance.
struct Doors {
    here: Vec<Exit>,
    there: Vec<Exit>,
    /// What every move of the ways out keeps, m.
    keeps_m: f64,
}

impl Arena<'_> {
    /// The straight attempts with wide clearance.
    pub(super) fn straight(&self) -> Option<Transit> {
        let mut ask = Ask::new(self.free, WIDE * self.limit_m);
        if ask.clear(&self.from, &self.to).is_ok() {
            return Some(found(How::Direct, vec![self.from, self.to], ask.need_m, ask.n_checks));
        }
        self.across(&mut ask).0
    }

    /// Search with wide clearance, then the straight attempts and search with the limit itself.
    pub(super) fn search(&self, seed: u64, checks_max: usize) -> Transit {
        let mut wide = Ask::new(self.free, WIDE * self.limit_m);
        let doors = self.doors(&mut wide);
        let opens = |ask: &mut Ask<'_>, end: &Posture, exits: &[Exit]| {
            let mut tips = exits.iter().map(|exit| exit.way.last().unwrap_or(end));
            tips.any(|q| ask.clear(q, q).is_ok())
        };
        if opens(&mut wide, &self.from, &doors.here) && opens(&mut wide, &self.to, &doors.there) {
            let grown = self.grow(&mut wide, &doors, seed, checks_max);
            if let Ok(transit) = grown {
                return transit;
            }
        }
        let mut ask = Ask::new(self.free, self.limit_m);
        ask.n_checks = wide.n_checks;
        for (end, q) in [(reason::End::Start, self.from), (reason::End::Goal, self.to)] {
            if let Err(blocked) = ask.clear(&q, &q) {
                let reason = Reason::of_end(end, blocked, q, self.limit_m);
                return self.unplanned(reason, ask.n_checks);
            }
        }
        if ask.clear(&self.from, &self.to).is_ok() {
            return found(How::Direct, vec![self.from, self.to], ask.need_m, ask.n_checks);
        }
        let (transit, doors) = self.across(&mut ask);
        let transit = transit.map_or_else(|| self.grow(&mut ask, &doors, seed, checks_max), Ok);
        transit.unwrap_or_else(|reason| self.unplanned(*reason, ask.n_checks))
    }

    /// Out, across and in.
    fn across(&self, ask: &mut Ask<'_>) -> (Option<Transit>, Doors) {
        let doors = self.doors(ask);
        let Doors { here, there, keeps_m } = &doors;
        let ends = Ends { from: self.from, to: self.to, home: self.home, here, there };
        let crossed = ends.cross(ask, self.metric);
        let transit = crossed.map(|(how, way)| found(how, way, *keeps_m, ask.n_checks));
        (transit, doors)
    }

    /// The ways out that are clear. An end that does not itself keep what is asked is left with the
    /// limit.
    fn doors(&self, ask: &mut Ask<'_>) -> Doors {
        let need_m = ask.need_m;
        let mut keeps_m = need_m;
        let mut leave = |end: &Posture| {
            if ask.clear(end, end).is_err() {
                ask.need_m = self.limit_m;
                keeps_m = self.limit_m;
            }
            let exits = clear_exits(ask, end, (self.exits)(end));
            ask.need_m = need_m;
            exits
        };
        let (here, there) = (leave(&self.from), leave(&self.to));
        Doors { here, there, keeps_m }
    }

    /// RRT-Connect from the ways out, then a shorter and rounder way.
    fn grow(
        &self,
        ask: &mut Ask<'_>,
        doors: &Doors,
        seed: u64,
        checks_max: usize,
    ) -> Result<Transit, Box<Reason>> {
        let ways = |exits: &[Exit]| exits.iter().map(|exit| exit.way.clone()).collect::<Vec<_>>();
        let mut here = Tree::new(self.from, &ways(&doors.here));
        let mut there = Tree::new(self.to, &ways(&doors.there));
        let mut search = Search {
            ask,
            metric: self.metric,
            room: self.room,
            random: Random::new(seed),
            checks_max,
        };
        let Some(way) = search.connect(&mut here, &mut there) else {
            return Err(Box::new(Reason::of_search(&here, &there, ask.need_m)));
        };
        let mut random = Random::new(seed);
        let way = shortcut::shorten(ask, self.metric, &mut random, way, CHECKS_TO_SHORTEN);
        let way = shortcut::round(ask, self.metric, &way);
        Ok(found(How::Search, way, doors.keeps_m, ask.n_checks))
    }

    /// Over the deposit, or straight where there is no way up: `collision` judges what comes of it.
    fn unplanned(&self, reason: Reason, n_checks: usize) -> Transit {
        let up = |q: &Posture| {
            let over = (self.exits)(q).into_iter().find(|exit| exit.how == How::Over);
            over.map_or_else(Vec::new, |exit| exit.way)
        };
        let mut way = vec![self.from];
        way.extend(up(&self.from));
        way.extend(up(&self.to).into_iter().rev());
        way.push(self.to);
        Transit { way, how: None, keeps_m: 0.0, n_checks, reason: Some(reason) }
    }
}

fn found(how: How, way: Vec<Posture>, keeps_m: f64, n_checks: usize) -> Transit {
    Transit { way, how: Some(how), keeps_m, n_checks, reason: None }
}
