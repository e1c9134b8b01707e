//! Postures and times along one strand.

use rayon::prelude::*;

use super::climb::{self, Clearance};
use super::given;
use super::ladder::{self, Ladder};
use super::place::Course;
use super::refine;
use super::walk::{self, Post, Stand, Steps};
use crate::cell::{Job, Strand};
use crate::kinematics::{Posture, Solution};
use crate::pose::Point;
use crate::toolpath::{Path, Sample};

/// Postures at the samples of a path.
#[derive(Debug, Clone)]
pub(super) struct Postures {
    /// The path with samples added where joints turn fast between two of them.
    pub(super) path: Path,
    /// One per sample; `None`: out of reach.
    pub(super) q: Vec<Option<Posture>>,
    /// Arc length and place of the samples out of reach.
    pub(super) unreached: Vec<(f64, Point)>,
}

impl Postures {
    /// First and last sample that are reached.
    pub(super) fn ends(&self) -> Option<(usize, usize)> {
        let first = self.q.iter().position(Option::is_some)?;
        Some((first, self.q.iter().rposition(Option::is_some)?))
    }

    fn new(path: &Path, samples: Vec<Sample>, q: Vec<Option<Posture>>) -> Self {
        let missing = samples.iter().zip(&q).filter(|(_, q)| q.is_none());
        let unreached = missing.map(|(sample, _)| (sample.at_m, sample.point)).collect();
        Self { path: Path { strand: path.strand, length_m: path.length_m, samples }, q, unreached }
    }
}

/// Postures along a strand, from its own joint path or from the ladder.
pub(super) fn postures(job: &Job, path: &Path, ladder: &Ladder, from: &Posture) -> Postures {
    postures_clear(job, path, ladder, from, None)
}

/// The same, shunning postures that come too near to something.
pub(super) fn postures_clear(
    job: &Job,
    path: &Path,
    ladder: &Ladder,
    from: &Posture,
    clearance: Option<Clearance<'_>>,
) -> Postures {
    let course = Course::new(job, path);
    if let Some(rows) = &job.strands[path.strand].joints {
        return Postures::new(path, path.samples.clone(), given::postures(&course, rows));
    }
    searched(&course, ladder, from, clearance)
}

/// Searches of one strand, at most; each but the first on a ladder with more rungs, the last on a finer
/// fan too.
const SEARCHES: usize = 3;
/// Rungs added at once, at most.
const MOST_ADDED: usize = 48;

fn searched(
    course: &Course<'_>,
    ladder: &Ladder,
    from: &Posture,
    clearance: Option<Clearance<'_>>,
) -> Postures {
    let mut ladder = std::borrow::Cow::Borrowed(ladder);
    let mut best: Option<([usize; 2], Postures)> = None;
    for search in 1..=SEARCHES {
        let way = match clearance {
            None => climb::climb(course, &ladder, from),
            Some(look) => climb::climb_clear(course, ladder.to_mut(), from, look),
        };
        let mut posts = posts(&ladder, &way);
        refine::refine(course, &mut posts, from, clearance);
        let Walked { postures, mut faults, near } = walked(course, &posts, clearance);
        let found = [faults.len(), near.iter().filter(|near| **near).count()];
        if best.as_ref().is_none_or(|(least, _)| found < *least) {
            best = Some((found, postures));
        }
        faults.extend(hidden(&near, &posts));
        faults.sort_unstable();
        faults.dedup();
        let rungs = with_rungs(&ladder, &faults);
        if posts.is_empty() || rungs.is_empty() || search == SEARCHES {
            break;
        }
        let finer = if search + 1 == SEARCHES { 2 } else { 1 };
        ladder = std::borrow::Cow::Owned(ladder::ladder(course, &rungs, finer));
    }
    best.map_or_else(|| walked(course, &[], None).postures, |(_, postures)| postures)
}

/// The postures on a way up the ladder.
pub(super) fn posts(ladder: &Ladder, way: &[(usize, usize)]) -> Vec<Post> {
    let post = |&(rung, index): &(usize, usize)| {
        let rung = &ladder.rungs[rung];
        let candidate = &rung.candidates[index];
        let turn = ladder.fan.turns[candidate.cell];
        Post { sample: rung.sample, turn, q: candidate.q, branch: candidate.branch }
    };
    way.iter().map(post).collect()
}

/// What comes of walking from post to post.
struct Walked {
    postures: Postures,
    /// Samples at which something is wrong: out of reach, or no even way to there.
    faults: Vec<usize>,
    /// Of each sample, whether something is nearer than the limit.
    near: Vec<bool>,
}

/// Postures at all samples by way of the posts.
fn walked(course: &Course<'_>, posts: &[Post], clearance: Option<Clearance<'_>>) -> Walked {
    let samples = &course.path.samples;
    let mut stands = walk::fill(course, posts);
    let bowed = if course.sets_tools() { walk::bow(course, &mut stands) } else { None };
    let mut faults = Vec::new();
    let mut all: Vec<Sample> = Vec::with_capacity(samples.len());
    let mut q = Vec::with_capacity(samples.len());
    let mut steps = Steps::new(course, bowed.as_ref());
    let mut before: Option<(&Sample, Stand)> = None;
    for (k, (sample, stand)) in samples.iter().zip(&stands).enumerate() {
        match (stand, before) {
            (None, _) => faults.push(k),
            (Some(to), Some((at, from))) if !steps.even((at, &from), (sample, to)) => {
                faults.push(k);
            }
            _ => {}
        }
        for (sample, posture) in steps.added.drain(..) {
            all.push(sample);
            q.push(Some(posture));
        }
        all.push(*sample);
        q.push(stand.map(|stand| stand.q));
        before = stand.map(|stand| (sample, stand));
    }
    let near = |(sample, stand): (&Sample, &Option<Stand>)| match (clearance, stand) {
        (Some(look), Some(stand)) => look(sample, &stand.q) < course.job.limits.clearance_m,
        _ => false,
    };
    let near = samples.par_iter().zip(&stands).map(near).collect();
    Walked { postures: Postures::new(course.path, all, q), faults, near }
}

/// Samples at which something is too near though it is not at the posts on both sides: what the rungs
/// did not see.
fn hidden(near: &[bool], posts: &[Post]) -> Vec<usize> {
    let clear = |post: Option<&Post>| post.is_none_or(|post| !near[post.sample]);
    let hides = |sample: &usize| {
        let k = posts.partition_point(|post| post.sample <= *sample);
        clear(posts.get(k)) && clear(k.checked_sub(1).and_then(|k| posts.get(k)))
    };
    (0..near.len()).filter(|&sample| near[sample]).filter(hides).collect()
}

/// The samples of the rungs and more where something is wrong: both ends of an uneven step, the ends and
/// the middle of what is out of reach. Empty if none is new.
fn with_rungs(ladder: &Ladder, faults: &[usize]) -> Vec<usize> {
    let old: Vec<usize> = ladder.rungs.iter().map(|rung| rung.sample).collect();
    let mut new: Vec<usize> = Vec::new();
    for run in faults.chunk_by(|a, b| a + 1 == *b) {
        let (first, last) = (run[0], run[run.len() - 1]);
        new.extend([first.saturating_sub(1), first, first.midpoint(last), last]);
    }
    new.sort_unstable();
    new.dedup();
    new.retain(|sample| old.binary_search(sample).is_err());
    // As many as are looked at, from all over the strand.
    let stride = new.len().div_ceil(MOST_ADDED).max(1);
    let mut rungs: Vec<usize> = new.into_iter().step_by(stride).collect();
    if !rungs.is_empty() {
        rungs.extend(old);
        rungs.sort_unstable();
    }
    rungs
}

/// The solution with the least joint travel from `before`.
pub(super) fn nearest(solutions: &[Solution], before: &[f64]) -> Option<Posture> {
    let travel = |solution: &Solution| -> f64 {
        before.iter().zip(solution.q.iter()).map(|(a, b)| (a - b).abs()).sum()
    };
    solutions.iter().min_by(|a, b| travel(a).total_cmp(&travel(b))).map(|solution| solution.q)
}

/// Time at each sample from the start of the extrusion, s.
///
/// ```text
/// t(s) = ∫ ds / v(s)
/// ```
///
/// `v` is the speed of the sample before, asked or from the strand's own times; those may begin
/// later than the extrusion.
pub(super) fn times(strand: &Strand, path: &Path) -> Vec<f64> {
    let mut time_s =
        strand.times_s.as_ref().and_then(|times| times.first()).copied().unwrap_or(0.0);
    let mut times = vec![time_s];
    for pair in path.samples.windows(2) {
        time_s += (pair[1].at_m - pair[0].at_m) / pair[0].speed_m_s;
        times.push(time_s);
    }
    times
}
