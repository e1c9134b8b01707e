//! What flow a drive gives for what it is told.

/// What flows a drive can give.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// Any flow.
    Any,
    /// One of these flows, m³/s: the nearest to what is told (Kirkman's relay bits, at most eight levels with
    /// three); the first of two as near. Nothing where the list is empty.
    Levels(Vec<f64>),
    /// This flow, m³/s, whenever more than nothing is told; else nothing (Tam and Mueller's stepper).
    OnOff(f64),
}

impl Drive {
    /// The flow the drive gives for a flow told, m³/s.
    pub fn given_m3_s(&self, told_m3_s: f64) -> f64 {
        match self {
            Self::Any => told_m3_s,
            Self::Levels(levels) => levels
                .iter()
                .copied()
                .min_by(|one, other| (one - told_m3_s).abs().total_cmp(&(other - told_m3_s).abs()))
                .unwrap_or(0.0),
            Self::OnOff(rate_m3_s) => {
                if told_m3_s > 0.0 {
                    *rate_m3_s
                } else {
                    0.0
                }
            }
        }
    }

    /// Relative error of the flow, `dQ/Q`: given over told less one. Not a number where nothing is told
    /// and nothing given. Source: process-physics.md section 4, Kirkman's relay bits.
    pub fn flow_error(&self, told_m3_s: f64) -> f64 {
        self.given_m3_s(told_m3_s) / told_m3_s - 1.0
    }
}

/// Relative error of the diameter that an error of the flow makes at a given speed.
///
/// `dD/D = √(1 + dQ/Q) − 1`; to first order `½ dQ/Q`, which is the reference's. Minus one where the flow
/// error is minus one or less. Source: process-physics.md section 4.
pub fn diameter_error(flow_error: f64) -> f64 {
    (1.0 + flow_error).max(0.0).sqrt() - 1.0
}
