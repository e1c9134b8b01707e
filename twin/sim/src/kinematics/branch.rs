//! Which of the postures that reach a pose.

/// Posture of an arm: one bit per choice.
///
/// | bit | arm with spherical wrist (OPW) | S-R-S arm | arm with three parallel axes |
/// | --- | --- | --- | --- |
/// | shoulder | wrist centre behind axis 1 | second joint negative | forearm on the other side of axis 1 |
/// | elbow | elbow below the line to the wrist | fourth joint negative | same |
/// | wrist | fifth joint negative | sixth joint negative | fifth joint negative |
///
/// Signs are those of the canonical angles of the arm's parameters. Arms solved numerically have no
/// named branches: all bits are unset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Branch {
    /// Shoulder bit.
    pub shoulder: bool,
    /// Elbow bit.
    pub elbow: bool,
    /// Wrist bit.
    pub wrist: bool,
}
