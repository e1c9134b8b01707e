//! Cross-section, draw and swell.

use super::{Case, Check, Kind, Library, number};
use crate::interval::Interval;
use crate::process::bead::{draw_ratio, drawn_diameter_m, flow_m3_s, overfeed_strain};

pub(super) fn cases(_: &Library<'_>) -> Vec<Case> {
    vec![slam_extruder(), swell_shape(), slpl_narrowing(), sewing_onset()]
}

fn slam_extruder() -> Case {
    // in at one length per second, out at 1.9
    let diameter_m = drawn_diameter_m(flow_m3_s(1.75e-3, 1.0), 1.9);
    let around = |value: f64| [0.97 * value, 1.03 * value];
    Case {
        id: "SLAM-EXTRUDER",
        kind: Kind::Published,
        title: "strand of SLAMStruder from its calibrated ratio of lengths",
        source: "mitchgu/SLAMStruder-firmware @a3cd2083, Options.h: 1.75 mm in, out/in 1.90, nozzle 1.2 mm",
        checks: vec![
            Check::band("strand diameter", "mm", around(1.2696), Interval::exact(diameter_m * 1e3)),
            Check::band("swell", "", around(1.0580), Interval::exact(diameter_m / 1.2e-3)),
        ],
        note:
            "mass balance on their ratio; the swell of our hot ends is this number, no prediction"
                .to_owned(),
    }
}

fn swell_shape() -> Case {
    // the swell that the draw ratio knows at a speed: free diameter over bore
    let swell = |speed_m_s: f64| {
        let flow = flow_m3_s(1.2e-3, speed_m_s);
        let free_m_s = speed_m_s / draw_ratio(flow, speed_m_s, 1.2e-3, 1.058);
        drawn_diameter_m(flow, free_m_s) / 1.2e-3
    };
    let (slow, fast) = (swell(0.001), swell(0.02));
    Case {
        id: "SWELL-SHAPE",
        kind: Kind::Published,
        title: "swell of PLA against print speed",
        source: "De Rosa, Tammaro, D'Avino 2023, Micromachines 14(2):329 (abstract)",
        checks: vec![
            Check::words(
                "swell against speed",
                "rises, levels off, jumps",
                format!("{} at 1 mm/s, {} at 20 mm/s", number(slow), number(fast)),
                fast > 1.001 * slow,
            )
            .outside(
                "swell is a number of the cell with a range, not a law of the speed: the relaxation times that would \
                 make it one are published for no strand of ours. Measure it at the speed you print (free-hang strand)",
            ),
        ],
        note: String::new(),
    }
}

fn slpl_narrowing() -> Case {
    let share = 1609.1 / 3038.3;
    // at a fixed flow the area goes with 1/v: the over-speed that leaves this share of it
    let over = 1.0 / share;
    let narrowing = drawn_diameter_m(1e-9, over) / drawn_diameter_m(1e-9, 1.0);
    Case {
        id: "SLPL-NARROWING",
        kind: Kind::Paper,
        title: "SL-PL lost strength where the robot sped up and the strand narrowed",
        source: "Tam & Mueller 2017, table 7 and discussion",
        checks: vec![
            Check::band("diameter left", "", [0.72, 0.735], Interval::exact(narrowing)),
            Check::band("over-speed that explains it", "", [1.3, 2.5], Interval::exact(over)),
        ],
        note: "if all of the loss were narrowing: an upper bound, since the paper names print quality too".to_owned(),
    }
}

fn sewing_onset() -> Case {
    let (mut low, mut high) = (0.1, 3.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if overfeed_strain(middle) > 0.0 { low = middle } else { high = middle }
    }
    Case {
        id: "SEWING-ONSET",
        kind: Kind::Published,
        title: "a thread laid slower than it comes meanders",
        source: "Brun, Ribe, Audoly, arXiv 1201.1378 and 1410.5382 (abstracts)",
        checks: vec![Check::band(
            "draw ratio at the onset",
            "",
            [0.85, 1.15],
            Interval::exact(low),
        )],
        note: "by mass alone; which pattern it lays is not modelled".to_owned(),
    }
}
