//! Speeds and tolerances of others.

use super::strand::usable_speed_m_s;
use super::{Case, Check, Kind, Library, number};
use crate::interval::Interval;

pub(super) fn cases(library: &Library<'_>) -> Vec<Case> {
    vec![yu_bunny(library), mit_toolspeed(library), tol_defaults(library)]
}

fn yu_bunny(library: &Library<'_>) -> Case {
    let gross_mm_s = 16.1e3 / (91.0 * 60.0);
    let ours = usable_speed_m_s(library.pla, 3e-3, 5.0).scaled(1e3);
    let around = |value: f64| [value / 1.6, value * 1.6];
    Case {
        id: "YU-BUNNY",
        kind: Kind::Paper,
        title: "a rabbit of 179 edges in 91 minutes",
        source: "Yu et al. 2016, ACADIA; length scaled from bunny_full_tri.json",
        checks: vec![
            Check::band("usable speed, PLA 3 mm under 5 m/s", "mm/s", around(gross_mm_s), ours),
            Check::words(
                "printing alone, 16.1 m at that speed",
                "at most 91 min",
                format!("{} min", number(16.1 / (ours.nominal * 1e-3) / 60.0)),
                16.1 / (ours.nominal * 1e-3) / 60.0 <= 91.0,
            ),
        ],
        note: format!(
            "theirs within a factor 1.6 of the gross speed, {} mm/s (30.5 s to an edge), moves between edges in it; strand \
             and air are not printed and are ours",
            number(gross_mm_s)
        ),
    }
}

fn mit_toolspeed(library: &Library<'_>) -> Case {
    let ours = |material| usable_speed_m_s(material, 1.27e-3, 5.0).scaled(1e3);
    Case {
        id: "MIT-TOOLSPEED",
        kind: Kind::Practice,
        title: "speed that planners of spatial extrusion take",
        source: "SLAMStruder default 5 mm/s; caelan/pb-construction @274e5bd0, TOOL_VELOCITY 10 mm/s",
        checks: vec![
            Check::band("usable speed, PLA 1.27 mm", "mm/s", [2.5, 20.0], ours(library.pla)),
            Check::band("usable speed, ABS 1.27 mm", "mm/s", [2.5, 20.0], ours(library.abs)),
        ],
        note: "theirs 5 to 10, twice as wide; ours where sag behind the nozzle is half the diameter, span 60 mm, under a jet \
               of 5 m/s, which is ours"
            .to_owned(),
    }
}

fn tol_defaults(library: &Library<'_>) -> Case {
    let limit = Interval::exact(library.deflection_m * 1e3);
    Case {
        id: "TOL-DEFAULTS",
        kind: Kind::Practice,
        title: "how far a half-built frame may give way",
        source: "FrameFab FiberPrintPARM.h: 1 to 2 mm; conmech numpy_stiffness.py: 1 mm, 3 degrees",
        checks: vec![
            Check::band("limit of the cell kr6-hot-end", "mm", [1.0, 2.0], limit),
            Check::missing(
                "turn of a node",
                "3 degrees",
                "the turn of a node is held against nothing here",
            ),
        ],
        note: "a choice of others taken over, not a law".to_owned(),
    }
}
