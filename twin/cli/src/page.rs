//! `report.html`: what the page shows beyond the report.

use report::{EmbeddedPicture, Extras, PictureKind, Report};
use sim::film::{Film, traces};
use sim::preflight::Preflight;

use crate::pictures::{Album, Shows, jpeg};

/// Room for the 3-D view in the page, bytes.
const VIEW_BYTES: usize = 2_500_000;

/// The page of a report, with the pictures there are.
pub(crate) fn page(
    checked: &Preflight,
    film: &Film,
    report: &Report,
    source: &slam::Source,
    album: Option<&Album>,
) -> String {
    let embedded = |shot: &crate::pictures::Shot| EmbeddedPicture {
        kind: match shot.shows {
            Shows::Sheet => PictureKind::Hero,
            Shows::Finding(index) => PictureKind::Finding { index },
            Shows::Frame => PictureKind::Frame,
            Shows::Collapse => PictureKind::Collapse,
            Shows::Moment(time_s) => PictureKind::Strip { time_s },
            Shows::SpinMap(strand) => {
                PictureKind::SpinMap { strand: checked.job().strands[strand].id.clone() }
            }
        },
        alt: shot.words.clone(),
        mime: "image/jpeg",
        bytes: jpeg(&shot.rgba),
    };
    let shots = album.into_iter().flat_map(|album| &album.shots);
    let extras = Extras {
        film: Some(film),
        traces: &traces(checked, film),
        source,
        view: Some(report::view3d(checked, film, VIEW_BYTES)),
        pictures: shots.map(embedded).filter(|picture| !picture.bytes.is_empty()).collect(),
    };
    report::html_page(report, &extras)
}
