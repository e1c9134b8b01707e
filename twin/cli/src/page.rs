//! `report.html`: what the page shows beyond the report.

use report::{EmbeddedPicture, Extras, PictureKind, Report};
use sim::film::{Film, Trace, traces};
use sim::preflight::Preflight;

use crate::pictures::{Album, Shot, Shows, jpeg};

/// Room for the 3-D view in the page, bytes.
const VIEW_BYTES: usize = 2_500_000;

/// All that does not change between the page before anything is drawn and the page with pictures.
pub(crate) struct Page<'a> {
    checked: &'a Preflight,
    film: &'a Film,
    source: &'a slam::Source,
    traces: Vec<Trace>,
    view: String,
}

impl<'a> Page<'a> {
    pub(crate) fn new(checked: &'a Preflight, film: &'a Film, source: &'a slam::Source) -> Self {
        let view = report::view3d(checked, film, VIEW_BYTES);
        Self { checked, film, source, traces: traces(checked, film), view }
    }

    /// The page with the pictures there are.
    pub(crate) fn html(&self, report: &Report, album: Option<&Album>) -> String {
        let shots = album.into_iter().flat_map(|album| &album.shots);
        let pictures = shots.map(|shot| self.embedded(shot));
        let extras = Extras {
            film: Some(self.film),
            traces: &self.traces,
            source: self.source,
            view: Some(&self.view),
            pictures: pictures.filter(|picture| !picture.bytes.is_empty()).collect(),
        };
        report::html_page(report, &extras)
    }

    fn embedded(&self, shot: &Shot) -> EmbeddedPicture {
        let kind = match shot.shows {
            Shows::Sheet => PictureKind::Hero,
            Shows::Finding(index) => PictureKind::Finding { index },
            Shows::Frame => PictureKind::Frame,
            Shows::Collapse => PictureKind::Collapse,
            Shows::Moment(time_s) => PictureKind::Strip { time_s },
            Shows::SpinMap(strand) => {
                PictureKind::SpinMap { strand: self.checked.job().strands[strand].id.clone() }
            }
        };
        let (alt, bytes) = (shot.words.clone(), jpeg(&shot.rgba));
        EmbeddedPicture { kind, alt, mime: "image/jpeg", bytes }
    }
}
