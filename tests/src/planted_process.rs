//! A hundred faults of the process planted into jobs, more than half of them within ten percent of
//! a limit: each must be found, on the right strand, with the right cause, at the right place; and
//! the job without it must be free of errors.
//!
//! A fault has one number. What is measured is no straight line in it (sag goes with the fourth
//! power of the speed), so the numbers that miss a limit by little are found by halving between one
//! deep fault and the job without it. All between two faults that are near is near as well.

mod jobs;

use crate::planting::{self, Expected, Fault};

/// A kind of fault; the number it takes is told with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A bridge printed too fast: mm/s.
    TooFast,
    /// The fan that cools a bridge fails: m/s of its air.
    NoAir,
    /// A hot end too cold to weld to a strand that is cold: °C.
    TooCold,
    /// A room so hot that the set bridge is soft: °C.
    TooHot,
    /// The lights go off before the end is cured: s from the start.
    LightOff,
    /// The lights go on late: mm printed before.
    LightLate,
    /// The lamps of the ring turned from the strand: their angle, degrees.
    RingTurned,
    /// The ring aimed past the place where the strand should set: mm below the orifice.
    RingAimed,
    /// A bright bed throws light on the nozzle: its albedo.
    BrightBed,
    /// No time to cool before the nozzle leaves a free end: s of dwell.
    NoDwell,
    /// The nozzle stops before the end is past the lights: mm of overrun.
    NoOverrun,
    /// A long hose and too short a prime: s.
    NoPrime,
    /// The flow cut down: mm³/s.
    Thinned,
    /// The flow turned up in a bridge: mm³/s.
    Slack,
    /// A flow between the levels that the drive has: mm³/s.
    NoLevel,
    /// ABS where PLA was meant, in a free rod: its length, mm.
    WrongMaterial,
    /// Speed and flow told to change at once, faster than the extruder follows: how many times.
    Jumped,
    /// The melt waits in the nozzle: s.
    Idle,
    /// A strand far from the nozzle's axis: degrees.
    Leaning,
}

impl Kind {
    const ALL: [Self; 19] = [
        Self::TooFast,
        Self::NoAir,
        Self::TooCold,
        Self::TooHot,
        Self::LightOff,
        Self::LightLate,
        Self::RingTurned,
        Self::RingAimed,
        Self::BrightBed,
        Self::NoDwell,
        Self::NoOverrun,
        Self::NoPrime,
        Self::Thinned,
        Self::Slack,
        Self::NoLevel,
        Self::WrongMaterial,
        Self::Jumped,
        Self::Idle,
        Self::Leaning,
    ];

    /// The number of a deep fault, and one that is none.
    fn range(self) -> [f64; 2] {
        match self {
            Self::TooFast => [22.0, 12.0],
            Self::NoAir => [0.3, 3.0],
            Self::TooCold => [187.0, 220.0],
            Self::TooHot => [90.0, 65.0],
            Self::LightOff => [8.0, 16.3],
            Self::LightLate => [9.0, 4.0],
            Self::RingTurned => [15.0, 45.0],
            Self::RingAimed => [14.0, 6.0],
            Self::BrightBed => [0.8, 0.05],
            Self::NoDwell => [0.5, 15.0],
            Self::NoOverrun => [0.2, 2.5],
            Self::NoPrime => [0.1, 1.2],
            Self::Thinned => [0.8, 2.0],
            Self::Slack => [6.0, 3.3],
            Self::NoLevel => [7.5, 5.65],
            Self::WrongMaterial => [180.0, 100.0],
            Self::Jumped => [4.0, 1.05],
            Self::Idle => [900.0, 200.0],
            Self::Leaning => [75.0, 40.0],
        }
    }

    fn expected(self, x: f64) -> Expected {
        let of = |code, strand, says, at_mm| Expected { code, strand, says, at_mm, also: None };
        let start = Some([0.0, 0.5]);
        match self {
            Self::TooFast | Self::NoAir => {
                of("P301", "bridge", "behind the nozzle", Some([0.0, 20.0]))
            }
            Self::TooCold => of("P310", "second", "holds to `first`", start),
            Self::TooHot => of("P303", "bridge", "under its own weight", Some([59.0, 61.0])),
            // What the nozzle had left a little before is still in the light's way.
            Self::LightOff => of("P305", "rod", "uncured core", Some([2.0 * x - 8.0, 30.0])),
            Self::LightLate => of("P305", "rod", "uncured core", Some([0.0, x])),
            Self::RingTurned => of("P305", "rod", "uncured core", None),
            Self::RingAimed => of("P306", "rod", "sets", None),
            Self::BrightBed => of("P308", "rod", "on the nozzle's tip", Some([0.0, 12.0])),
            Self::NoDwell => of("P304", "rod", "at its free end", Some([179.0, 180.0])),
            Self::NoOverrun => of("P311", "rod", "`overrun_mm`", Some([29.0, 30.0])),
            Self::NoPrime => of("P311", "rod", "`prime_s`", start),
            Self::Thinned => of("P302", "bridge", "is drawn at", None),
            Self::Slack => of("P302", "bridge", "more was fed", Some([9.0, 11.0])),
            Self::NoLevel => of("P307", "rod", "wide as drawn", None),
            Self::WrongMaterial => of("P304", "rod", "at its free end", Some([x - 1.0, x])),
            // Where it was told to change, and what is printed in a lag after that.
            Self::Jumped => of("P307", "rod", "wide as drawn", Some([15.0, 17.0])),
            Self::Idle => of("E511", "second", "waits", start),
            Self::Leaning => of("P309", "rod", "leaves the nozzle", None),
        }
    }
}

#[test]
fn a_hundred_planted_faults_of_the_process_are_found() {
    let faults: Vec<Fault> = Kind::ALL.into_iter().map(fault).collect();
    planting::all_are_found("planted-process", &faults);
}

fn fault(kind: Kind) -> Fault {
    Fault {
        name: format!("{kind:?}"),
        range: kind.range(),
        sound: jobs::sound(kind),
        files: Box::new(move |x| jobs::files(kind, x)),
        expected: Box::new(move |x| kind.expected(x)),
    }
}
