//! How the extruder answers what it is told: lag, levels, priming, starvation, blobs.
//!
//! The job tells a flow that is constant between steps; the drive gives what it can; the flow at the orifice
//! follows with a first-order lag. Solved exactly, piece by piece, so no time step enters anywhere.

use std::f64::consts::PI;

use super::drive::Drive;

/// What the extruder is told: from each time on, a flow. Before the first step it is told nothing.
///
/// Times in s on any clock (below zero where a strand starts at zero and is primed before it), flow in
/// m³/s; a flow below zero is a retract.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Told {
    steps: Vec<(f64, f64)>,
}

impl Told {
    /// Steps of (start s, flow m³/s), put in order of time; of two at one time the later in the list holds.
    /// Steps with a time or flow that is not a number or infinite are dropped.
    pub fn new(mut steps: Vec<(f64, f64)>) -> Self {
        steps.retain(|(start_s, flow)| start_s.is_finite() && flow.is_finite());
        steps.sort_by(|one, other| one.0.total_cmp(&other.0));
        Self { steps }
    }
}

/// An extruder: its lag and its drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Feed {
    /// Time constant of the flow, s: 0.05–0.2 direct, 0.3–1 Bowden, 1–5 syringe of gel (process-physics.md
    /// section 4, from memory). Not positive or not a number is taken as no lag.
    pub lag_s: f64,
    /// What flows it can give.
    pub drive: Drive,
}

/// One piece of the answer: from a time on, the flow tends from `start` to `given`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    from_s: f64,
    given_m3_s: f64,
    start_m3_s: f64,
    /// Delivered before this piece, m³.
    before_m3: f64,
}

/// What comes out of the orifice: `Q' = (Q_given − Q)/τ` from rest, solved exactly.
///
/// `Q(t) = Q_given + (Q_0 − Q_given) e^(−t/τ)` on each piece. Range: a melt or gel that answers like one
/// compressible volume behind one resistance; dead time and oozing from rest are left out (no constants found).
/// Source: process-physics.md section 4.
#[derive(Debug, Clone, PartialEq)]
pub struct Delivered {
    lag_s: f64,
    pieces: Vec<Piece>,
}

impl Feed {
    /// Answers what is told. O(n log n) in steps, for the levels of the drive counted as constant.
    pub fn deliver(&self, told: &Told) -> Delivered {
        let lag_s = if self.lag_s > 0.0 { self.lag_s } else { 0.0 };
        let mut pieces: Vec<Piece> = Vec::with_capacity(told.steps.len());
        for &(from_s, told_m3_s) in &told.steps {
            let (start_m3_s, before_m3) = pieces.last().map_or((0.0, 0.0), |piece| {
                let after_s = from_s - piece.from_s;
                (piece.flow_m3_s(lag_s, after_s), piece.volume_m3(lag_s, after_s))
            });
            let given_m3_s = self.drive.given_m3_s(told_m3_s);
            pieces.push(Piece { from_s, given_m3_s, start_m3_s, before_m3 });
        }
        Delivered { lag_s, pieces }
    }
}

impl Piece {
    fn flow_m3_s(&self, lag_s: f64, after_s: f64) -> f64 {
        if lag_s == 0.0 {
            return self.given_m3_s;
        }
        self.given_m3_s + (self.start_m3_s - self.given_m3_s) * (-after_s / lag_s).exp()
    }

    /// Delivered since the beginning of all, m³, at a time (or for ever) into the piece.
    fn volume_m3(&self, lag_s: f64, after_s: f64) -> f64 {
        let steady = if self.given_m3_s == 0.0 { 0.0 } else { self.given_m3_s * after_s };
        let step = self.start_m3_s - self.given_m3_s;
        let lagged = if step == 0.0 { 0.0 } else { step * held_s(lag_s, after_s) };
        self.before_m3 + steady + lagged
    }
}

/// `τ (1 − e^(−t/τ))`: the time the old flow would have to last to give what it still gives, s.
fn held_s(lag_s: f64, after_s: f64) -> f64 {
    if lag_s == 0.0 {
        0.0
    } else if lag_s.is_infinite() {
        after_s
    } else {
        -lag_s * (-after_s / lag_s).exp_m1()
    }
}

impl Delivered {
    /// Flow at a time, m³/s; nothing before the first step. O(log n).
    pub fn flow_m3_s(&self, time_s: f64) -> f64 {
        self.piece(time_s).map_or(0.0, |piece| piece.flow_m3_s(self.lag_s, time_s - piece.from_s))
    }

    /// The flow that the drive tends to at a time, m³/s: what would come out without lag. O(log n).
    pub fn given_m3_s(&self, time_s: f64) -> f64 {
        self.piece(time_s).map_or(0.0, |piece| piece.given_m3_s)
    }

    /// Volume that comes out between two times, m³; the end may be infinite. O(log n).
    ///
    /// Closed form: `V = Q_given t + (Q_0 − Q_given) τ (1 − e^(−t/τ))` on each piece. Below zero where a
    /// retract draws back more than comes out, or where the times are the other way round.
    pub fn volume_m3(&self, from_s: f64, to_s: f64) -> f64 {
        self.until_m3(to_s) - self.until_m3(from_s)
    }

    /// Volumes between neighbours of ascending times, m³: one fewer than times. O(m log n).
    pub fn volumes_m3(&self, times_s: &[f64]) -> Vec<f64> {
        let until: Vec<f64> = times_s.iter().map(|&time_s| self.until_m3(time_s)).collect();
        until.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    fn until_m3(&self, time_s: f64) -> f64 {
        self.piece(time_s).map_or(0.0, |piece| piece.volume_m3(self.lag_s, time_s - piece.from_s))
    }

    fn piece(&self, time_s: f64) -> Option<&Piece> {
        let count = self.pieces.partition_point(|piece| piece.from_s <= time_s);
        self.pieces[..count].last()
    }

    /// The pieces between two times: length s, flow tended to, flow at its start.
    fn between(&self, from_s: f64, to_s: f64) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let first = self.pieces.partition_point(|piece| piece.from_s <= from_s).saturating_sub(1);
        (first..self.pieces.len()).map_while(move |i| {
            let piece = &self.pieces[i];
            let begin_s = piece.from_s.max(from_s);
            let next_s = self.pieces.get(i + 1).map_or(f64::INFINITY, |next| next.from_s);
            let flow_m3_s = piece.flow_m3_s(self.lag_s, begin_s - piece.from_s);
            (begin_s < to_s).then(|| (next_s.min(to_s) - begin_s, piece.given_m3_s, flow_m3_s))
        })
    }

    /// What a strand made between two times lacks because the flow lags. O(n) in steps between them.
    ///
    /// `share` is of the diameter: the bead is thin while `√(Q/Q_given) < share`, whatever the speed, and
    /// where nothing is given. Against the flow the drive tends to; what the drive itself gives wrong is
    /// [`Drive::flow_error`]. For one step from rest at the start: missing `Q τ (1 − e^(−t/τ))`, thin for
    /// `τ ln(1/(1 − share²))`.
    pub fn starved(&self, from_s: f64, to_s: f64, share: f64) -> Starved {
        let first_s = self.pieces.first().map_or(f64::INFINITY, |piece| piece.from_s);
        let mut thin_s = (first_s.min(to_s) - from_s).max(0.0);
        let (mut missing_m3, mut thin) = (0.0, true);
        let threshold = share.max(0.0).powi(2);
        for (length_s, given, start) in self.between(from_s, to_s) {
            if start < given {
                missing_m3 += (given - start) * held_s(self.lag_s, length_s);
            }
            if thin {
                let fills_s = prime_time_s(self.lag_s, start, given, threshold);
                thin = given <= 0.0 || fills_s >= length_s;
                thin_s += if given > 0.0 { fills_s.min(length_s) } else { length_s };
            }
        }
        Starved { missing_m3, thin_s }
    }

    /// The volumes that come out while the nozzle rests at both ends of a strand, and after it. O(log n).
    ///
    /// Times in s: priming begins at `primes_s`, the nozzle leaves at `start_s`, arrives at `end_s`, goes away
    /// after its dwell at `leaves_s`, and the next priming begins at `until_s` (or never, infinite).
    pub fn blobs(
        &self,
        primes_s: f64,
        start_s: f64,
        end_s: f64,
        leaves_s: f64,
        until_s: f64,
    ) -> Blobs {
        Blobs {
            start_m3: self.volume_m3(primes_s, start_s).max(0.0),
            end_m3: self.volume_m3(end_s, leaves_s).max(0.0),
            ooze_m3: self.volume_m3(leaves_s, until_s).max(0.0),
        }
    }
}

/// What the start of a strand lacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Starved {
    /// Volume that a flow without lag would have given more, m³.
    pub missing_m3: f64,
    /// Time from the start during which the bead is thinner than the share of its diameter, s.
    pub thin_s: f64,
}

/// Volumes that come out where none belongs, m³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blobs {
    /// Before the nozzle moves off: the priming.
    pub start_m3: f64,
    /// While it rests at the end, the flow still decaying.
    pub end_m3: f64,
    /// After it has left: carried away, or a hair.
    pub ooze_m3: f64,
}

/// Diameter of a sphere of a volume, m: `(6 V / π)^⅓`; zero where there is none.
pub fn sphere_diameter_m(volume_m3: f64) -> f64 {
    (6.0 * volume_m3.max(0.0) / PI).cbrt()
}

/// Time of priming until the flow is a share of the flow given, s.
///
/// `t = τ ln((Q_given − Q_old)/(Q_given (1 − share)))`, from rest `τ ln(1/(1 − share))`. Zero where the old
/// flow is share enough or nothing is given; infinite where the share is one or more and the old flow is
/// less.
pub fn prime_time_s(lag_s: f64, old_m3_s: f64, given_m3_s: f64, share: f64) -> f64 {
    if !(given_m3_s > 0.0 && old_m3_s < share * given_m3_s && lag_s > 0.0) {
        return 0.0;
    }
    if share >= 1.0 {
        return f64::INFINITY;
    }
    lag_s * ((1.0 - old_m3_s / given_m3_s) / (1.0 - share)).ln()
}

/// Time before a strand's end at which to stop the drive, so that no more than a volume follows the end, s.
///
/// After the stop `Q τ e^(−t/τ)` is still to come: `t = τ ln(Q τ / V)`, at least zero. The strand's end
/// starves by what no longer makes a blob, `Q t − Q τ (1 − e^(−t/τ))`.
pub fn coast_time_s(lag_s: f64, flow_m3_s: f64, blob_m3: f64) -> f64 {
    if !(lag_s > 0.0 && flow_m3_s > 0.0) {
        return 0.0;
    }
    lag_s * (flow_m3_s * lag_s / blob_m3.max(0.0)).ln().max(0.0)
}

/// Volume that an extruder holds back as pressure at a steady flow, m³: `Q τ`.
///
/// What is missing at the start of a strand made from rest, what comes after the drive stops, and so what a
/// retract has to take back to leave nothing. Zero where there is no lag.
pub fn stored_m3(lag_s: f64, flow_m3_s: f64) -> f64 {
    if lag_s > 0.0 { flow_m3_s * lag_s } else { 0.0 }
}
