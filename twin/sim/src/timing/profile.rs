//! `s(t)` in steps of constant jerk.

/// The state at the start of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) t: f64,
    pub(super) s: f64,
    pub(super) v: f64,
    pub(super) a: f64,
    pub(super) j: f64,
}

impl Step {
    fn rest(t: f64, s: f64) -> Self {
        Self { t, s, v: 0.0, a: 0.0, j: 0.0 }
    }

    /// The state `dt` later.
    pub(super) fn later(&self, dt: f64) -> Self {
        Self {
            t: self.t + dt,
            s: self.s + dt * (self.v + dt * (self.a / 2.0 + dt * self.j / 6.0)),
            v: self.v + dt * (self.a + dt * self.j / 2.0),
            a: self.a + dt * self.j,
            j: self.j,
        }
    }

    /// Time until `s` is reached, at most `most`.
    fn until(&self, s: f64, most: f64) -> f64 {
        let gap = s - self.s;
        if gap <= 0.0 {
            return 0.0;
        }
        if self.j == 0.0 {
            let root = (self.v * self.v + 2.0 * self.a * gap).max(0.0).sqrt();
            return (2.0 * gap / (self.v + root)).min(most);
        }
        let (mut low, mut high) = (0.0, most);
        let mut dt = most * (gap / (self.later(most).s - self.s)).clamp(0.0, 1.0);
        for _ in 0..60 {
            let at = self.later(dt);
            if at.s < s {
                low = dt;
            } else {
                high = dt;
            }
            let newton = dt - (at.s - s) / at.v;
            let next = if newton > low && newton < high { newton } else { (low + high) / 2.0 };
            if (next - dt).abs() <= 1e-15 * most {
                return next;
            }
            dt = next;
        }
        dt
    }
}

/// The whole law; the last step is the state at the end and has no length.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    pub(super) steps: Vec<Step>,
}

impl Profile {
    pub(super) fn rest(s: f64) -> Self {
        Self { steps: vec![Step::rest(0.0, s)] }
    }

    /// From `(s, ṡ²)`, linear in between; `None` if it stands still on the way.
    pub(super) fn from_phase(points: &[(f64, f64)]) -> Option<Self> {
        let mut steps = Vec::with_capacity(points.len());
        let mut t = 0.0;
        for pair in points.windows(2) {
            let [(s, x), (s_next, x_next)] = [pair[0], pair[1]];
            let (v, v_next) = (x.sqrt(), x_next.sqrt());
            let width = s_next - s;
            let dt = 2.0 * width / (v + v_next);
            if !dt.is_finite() {
                return None;
            }
            steps.push(Step { t, s, v, a: (x_next - x) / (2.0 * width), j: 0.0 });
            t += dt;
        }
        let (s, _) = *points.last()?;
        steps.push(Step::rest(t, s));
        Some(Self { steps })
    }

    pub(super) fn end(&self) -> Step {
        self.steps[self.steps.len() - 1]
    }

    pub(super) fn duration(&self) -> f64 {
        self.end().t
    }

    /// Index of the step at `t`.
    fn step_at(&self, t: f64) -> usize {
        self.steps.partition_point(|step| step.t <= t).max(1) - 1
    }

    /// The state at `t`, at rest before the start and after the end.
    pub(super) fn at(&self, t: f64) -> Step {
        let (first, end) = (self.steps[0], self.end());
        if !(t >= first.t) {
            return Step::rest(t, first.s);
        }
        if t > end.t {
            return Step::rest(t, end.s);
        }
        let step = self.steps[self.step_at(t)];
        let mut at = step.later(t - step.t);
        at.s = at.s.min(end.s);
        at
    }

    /// When `s` is reached first.
    pub(super) fn time_of(&self, s: f64) -> f64 {
        let k = self.steps.partition_point(|step| step.s < s).max(1) - 1;
        // Near a rest, rounding of `s` is a long time.
        let near = 1e-9 * (self.end().s - self.steps[0].s);
        let around = &self.steps[k.saturating_sub(1)..self.steps.len().min(k + 3)];
        let rests = |step: &&Step| step.v == 0.0 && (step.s - s).abs() <= near;
        if let Some(rest) = around.iter().find(rests) {
            return rest.t;
        }
        let step = &self.steps[k];
        let most = self.steps.get(k + 1).map_or(0.0, |next| next.t - step.t);
        step.t + step.until(s, most)
    }

    /// The same motion `factor` times as long.
    pub(super) fn slow_down(&mut self, factor: f64) {
        for step in &mut self.steps {
            step.t *= factor;
            step.v /= factor;
            step.a /= factor.powi(2);
            step.j /= factor.powi(3);
        }
    }

    /// Goes on with a law that starts from rest where this one ends.
    pub(super) fn append(&mut self, other: &Self) {
        let start = self.duration();
        self.steps.pop();
        self.steps.extend(other.steps.iter().map(|step| Step { t: step.t + start, ..*step }));
    }

    /// Running mean over the last `window_s`, which is constant acceleration turned into constant
    /// jerk:
    ///
    /// ```text
    /// s(t) = 1/T ∫ s₀ over [t − T, t]    v = (s₀(t) − s₀(t−T))/T    a = (v₀(t) − v₀(t−T))/T
    /// ```
    ///
    /// It ends `window_s` later than this law.
    pub(super) fn smoothed(&self, window_s: f64) -> Self {
        let end_s = self.duration() + window_s;
        let least = 1e-12 * end_s;
        let begin = self.steps[0].s;
        let mut out = Vec::with_capacity(2 * self.steps.len());
        let (mut lead, mut trail) = (0, 0);
        let (mut t, mut s) = (0.0, begin);
        let time =
            |k: usize, late: f64| self.steps.get(k).map_or(f64::INFINITY, |step| step.t + late);
        while t < end_s - least {
            while time(lead + 1, 0.0) <= t + least {
                lead += 1;
            }
            while time(trail + 1, window_s) <= t + least {
                trail += 1;
            }
            let starts = t < window_s - least;
            let next = if starts { window_s } else { time(trail + 1, window_s) };
            let next = next.min(time(lead + 1, 0.0)).min(end_s);
            let state = |k: usize, t: f64| {
                let step = self.steps[k];
                if t < step.t { Step { t, ..step } } else { step.later(t - step.t) }
            };
            let front = state(lead, t);
            let back = if starts { Step::rest(t, begin) } else { state(trail, t - window_s) };
            let step = Step {
                t,
                s,
                v: ((front.s - back.s) / window_s).max(0.0),
                a: (front.v - back.v) / window_s,
                j: (front.a - back.a) / window_s,
            };
            s = step.later(next - t).s;
            out.push(step);
            t = next;
        }
        out.push(Step::rest(end_s, self.end().s));
        Self { steps: out }
    }

    /// Cuts steps where they pass one of `places`, which grow.
    pub(super) fn cut_at(&self, places: impl Iterator<Item = f64>) -> Self {
        let mut places = places.peekable();
        let mut out = Vec::with_capacity(self.steps.len());
        for (k, &step) in self.steps.iter().enumerate() {
            out.push(step);
            let Some(next) = self.steps.get(k + 1) else { break };
            while places.next_if(|place| *place <= step.s).is_some() {}
            while let Some(place) = places.next_if(|place| *place < next.s) {
                let most = next.t - step.t;
                let dt = step.until(place, most);
                // A cut beside an end would only leave a sliver.
                if dt > 1e-9 * most && dt < (1.0 - 1e-9) * most {
                    out.push(step.later(dt));
                }
            }
        }
        Self { steps: out }
    }
}
