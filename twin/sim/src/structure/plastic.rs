//! How far a ductile frame carries past its first yield: a lower bound of the collapse load.

use super::balanced::in_balance;
use super::first_yield::first_yield;
use super::frame::{Frame, FrameFault, Member, Support};
use super::solve::{Held, Load, SolveError, check_inputs, solve};
use super::strength::{Cut, Span, Strength, check_strengths, cuts, spans};
use super::yielding::{EllipseCurve, Forces, Yielding};

/// A member is softened in three parts: near its ends, where hinges form, and between.
const PARTS: usize = 3;
/// Length of the parts at the ends over that of the member. Forces stay in balance whatever it is.
const END_PART: f64 = 0.1;
/// Softened solves at most.
const ITERATIONS: usize = 80;
/// Solves without gaining [`GAIN`] after which it is given up.
const PATIENCE: usize = 15;
/// A relative gain below this is none.
const GAIN: f64 = 1e-4;
/// The stiffest part over the softest, at most: far from what the pivots take for a mechanism.
const RANGE: f64 = 1e4;
/// Most by which the spare of two parts counts as different, and the power it counts with: so
/// softened, frames of bars settle within thirty solves.
const RATIO: f64 = 4.0;
const POWER: f64 = 0.5;
/// Steps of the search for a factor: doublings out to 2^±120, then halvings to 1e-12; how much a part
/// has to spare need not be known so well.
const DOUBLINGS: usize = 120;
const HALVINGS: usize = 40;
const HALVINGS_SPARE: usize = 10;

/// What a frame of ductile members carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collapse {
    /// Factor on the growing load that the frame carries for sure; at least the first yield's. 0: not
    /// even the lasting load is shown to be carried.
    pub bound: f64,
    /// Factor at which the elastic frame first yields, at a fibre.
    pub first_yield: f64,
    /// The member used up at the bound; `None` where nothing limits it, or first yield is it.
    pub member: Option<usize>,
    /// Softened solves made.
    pub iterations: usize,
}

impl Collapse {
    /// Post-yield reserve: bound over first yield; 1 where both are unlimited or nothing, infinite
    /// where only redistribution carries the lasting load.
    pub fn reserve(&self) -> f64 {
        if self.bound == self.first_yield { 1.0 } else { self.bound / self.first_yield }
    }
}

/// A lower bound of the collapse load by the static theorem: a field of forces in balance with the
/// loads and nowhere past yield is carried, if every part can yield on without breaking.
///
/// Balanced fields come from elastic solves of a softened frame (elastic compensation, Mackenzie and
/// Boyle 1993): after each solve every part's E and G are multiplied by how little it is used. The
/// best of at most 80 is kept, and the elastic frame's own first yield is one of them. Yield of a
/// section: see `yielding` (N, M and T; without shear by bending). Initial strain is in the first
/// yield only: it is in balance with itself and does not change what a ductile frame carries.
/// What holds strands together is not asked: where a weld breaks first this is no bound, nor is it where
/// the frame buckles. With weight along members, stations are those of [`super::utilisation`].
///
/// Against exact collapse loads the tests find it 0 to 3 % low. Costs up to 80 solves of three times
/// the members.
///
/// # Errors
/// As [`solve`] and [`super::utilisation`].
pub fn plastic_bound(
    frame: &Frame,
    supports: &[Support],
    strengths: &[Strength],
    lasting: &Load,
    growing: &Load,
) -> Result<Collapse, SolveError> {
    check_strengths(frame.members().len(), strengths)?;
    for load in [lasting, growing] {
        check_inputs(frame, supports, &load.at_nodes, load.gravity_m_s2)?;
    }
    let [still, step] = [lasting, growing].map(|load| solve(frame, supports, load));
    let [_, by_fibre, _] = first_yield(
        frame,
        (strengths, &[]),
        (&still?, lasting.gravity_m_s2),
        (&step?, growing.gravity_m_s2),
    )?;
    let first_yield = by_fibre.factor;
    let mut best = Collapse { bound: first_yield, first_yield, member: None, iterations: 0 };
    if !first_yield.is_finite() {
        return Ok(best);
    }
    let parted = parted(frame).map_err(too_short)?;
    let check = Check::new(&parted, strengths);
    let mut held = Held::new(&parted, supports)?;
    let spans = spans(&parted, &held.beams);
    let mut soft = vec![1.0; parted.members().len()];
    let mut last_gain = (0, best.bound);
    for iteration in 1..=ITERATIONS {
        best.iterations = iteration;
        let balanced = |load| in_balance(&parted, supports, &held, load);
        let (Some(base), Some(step)) = (balanced(lasting), balanced(growing)) else { break };
        let base = cuts(&parted, &base, lasting.gravity_m_s2)?;
        let step = cuts(&parted, &step, growing.gravity_m_s2)?;
        let field = Field { spans: &spans, base, step };
        if let Some((bound, part)) = check.factor(&field, best.bound) {
            best = Collapse { bound, member: Some(part / PARTS), ..best };
        }
        if best.bound > last_gain.1 * (1.0 + GAIN) {
            last_gain = (iteration, best.bound);
        } else if iteration - last_gain.0 >= PATIENCE {
            break;
        }
        let by = soften(&mut soft, &check.spare(&field, best.bound));
        // softened so far that something moves freely: the end of the search, not of the answer
        if held.rescale(&by).is_err() {
            break;
        }
    }
    Ok(best)
}

/// The frame with every member in [`PARTS`] parts, in the order of the members.
fn parted(frame: &Frame) -> Result<Frame, FrameFault> {
    let mut nodes = frame.nodes().to_vec();
    let mut members = Vec::with_capacity(PARTS * frame.members().len());
    for member in frame.members() {
        let [from, to] = member.ends.map(|node| frame.nodes()[node]);
        let inner = nodes.len();
        nodes.push(from + (to - from) * END_PART);
        nodes.push(to + (from - to) * END_PART);
        for ends in [[member.ends[0], inner], [inner, inner + 1], [inner + 1, member.ends[1]]] {
            members.push(Member { ends, ..*member });
        }
    }
    Frame::new(nodes, members)
}

/// A member so short that a tenth of it is nothing.
fn too_short(fault: FrameFault) -> SolveError {
    match fault {
        FrameFault::NoLength { member }
        | FrameFault::NoSuchNode { member, .. }
        | FrameFault::Constants { member }
        | FrameFault::Split { member } => SolveError::BadMember { member: member / PARTS },
        FrameFault::NotFinite { node } => SolveError::BadNode { node },
    }
}

/// Parts that have less to spare become softer than the others, the stiffest being 1. What each is
/// to be multiplied by.
fn soften(soft: &mut [f64], spare: &[f64]) -> Vec<f64> {
    let least = spare.iter().copied().fold(f64::INFINITY, f64::min).max(f64::MIN_POSITIVE);
    let wanted = |(soft, spare): (&f64, &f64)| soft * (spare / least).clamp(1.0, RATIO).powf(POWER);
    let wanted: Vec<f64> = soft.iter().zip(spare).map(wanted).collect();
    let stiffest = wanted.iter().copied().fold(0.0, f64::max);
    let change = |(soft, wanted): (&mut f64, f64)| {
        let before = std::mem::replace(soft, (wanted / stiffest).max(1.0 / RANGE));
        *soft / before
    };
    soft.iter_mut().zip(wanted).map(change).collect()
}

/// Forces in balance with the lasting load, and with the growing one.
struct Field<'a> {
    spans: &'a [Span<'a>],
    base: Vec<Cut>,
    step: Vec<Cut>,
}

/// The sections of all parts against what acts on them.
struct Check {
    curve: EllipseCurve,
    yielding: Vec<Yielding>,
}

impl Check {
    fn new(parted: &Frame, strengths: &[Strength]) -> Self {
        let of_part = |(part, member): (usize, &Member)| {
            Yielding::new(&member.section, strengths[part / PARTS])
        };
        let yielding = parted.members().iter().enumerate().map(of_part).collect();
        Self { curve: EllipseCurve::new(), yielding }
    }

    /// Whether a part carries its share of `scale (lasting + factor growing)` at all its stations.
    fn carries(&self, field: &Field, part: usize, scale: f64, factor: f64) -> bool {
        let span = &field.spans[part];
        let cut = field.base[part].plus(&field.step[part], factor);
        let z = span.x.cross(&span.y);
        let stations = cut.stations(&span.x, span.length_m);
        stations.iter().all(|&station_m| {
            let (axial_n, bending, torque) = cut.at(&span.x, station_m);
            let forces = Forces {
                axial_n: axial_n * scale,
                bending_n_m: bending * scale,
                torque_n_m: torque * scale,
            };
            self.yielding[part].carries(&self.curve, &forces, [&span.y, &z])
        })
    }

    /// A factor above `known` up to which the field is carried from nothing on, and the part that
    /// ends it.
    fn factor(&self, field: &Field, known: f64) -> Option<(f64, usize)> {
        let first_past = |factor: f64| {
            (0..field.spans.len()).find(|&part| !self.carries(field, part, 1.0, factor))
        };
        if first_past(0.0).is_some() || first_past(known).is_some() {
            return None;
        }
        let start = if known > 0.0 { known } else { 1.0 };
        let factor = largest(start, HALVINGS, |factor| first_past(factor).is_none());
        let past = factor * (1.0 + 1e-9);
        (factor > known).then(|| (factor, first_past(past).unwrap_or_default()))
    }

    /// By part: the factor on lasting and grown load together that it carries.
    fn spare(&self, field: &Field, factor: f64) -> Vec<f64> {
        let of_part =
            |part| largest(1.0, HALVINGS_SPARE, |scale| self.carries(field, part, scale, factor));
        (0..field.spans.len()).map(of_part).collect()
    }
}

/// Largest number for which something holds that holds up to there, from a guess: 0 below 2^-120 of
/// the guess, and no more than 2^120 of it.
fn largest(guess: f64, halvings: usize, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (guess, guess);
    if holds(guess) {
        for _ in 0..DOUBLINGS {
            high *= 2.0;
            if !holds(high) {
                break;
            }
            low = high;
        }
        if low == high {
            return low;
        }
    } else {
        for _ in 0..DOUBLINGS {
            low *= 0.5;
            if holds(low) {
                break;
            }
            high = low;
        }
        if low == high {
            return 0.0;
        }
    }
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}
