//! Files of the whole job for other programs: `--record`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use record::{Attachments, FindingWords, GlbOptions, McapRecording, Profile};
use report::Report;
use sim::film::{Film, Player, Quantity};
use sim::preflight::Preflight;

use crate::files;
use crate::pictures::{Album, Shows, done_s, png};
use crate::refusal::Refusal;

/// A file to record to; its name says what it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Recording {
    path: PathBuf,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Mcap,
    Rerun,
    Glb,
    Stl,
}

impl Recording {
    /// Where it goes.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

impl FromStr for Recording {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let kind = match ending.to_ascii_lowercase().as_str() {
            "mcap" => Kind::Mcap,
            "rrd" => Kind::Rerun,
            "glb" => Kind::Glb,
            "stl" => Kind::Stl,
            _ => return Err("recordings end in .mcap, .rrd, .glb or .stl".to_owned()),
        };
        Ok(Self { path, kind })
    }
}

/// Which programs an MCAP file is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum McapProfile {
    /// Foxglove, Lichtblick, PlotJuggler, Rerun
    Foxglove,
    /// ros2 bag and RViz
    Ros2,
}

/// What all recordings are made of.
pub(crate) struct Recorder<'a> {
    pub(crate) checked: &'a Preflight,
    pub(crate) film: &'a Film,
    pub(crate) report: &'a Report,
    pub(crate) source: &'a slam::Source,
    pub(crate) urdf: Option<(&'a str, &'a [u8])>,
    pub(crate) album: Option<&'a Album>,
    pub(crate) profile: McapProfile,
}

impl Recorder<'_> {
    /// Writes a recording, whole or not at all.
    pub(crate) fn write(&self, recording: &Recording) -> Result<(), Refusal> {
        let path = &recording.path;
        match recording.kind {
            Kind::Mcap => files::write_by(path, |temporary| self.mcap(temporary)),
            Kind::Rerun => files::write_by(path, |temporary| self.rerun(temporary)),
            Kind::Glb => {
                let frame = Player::new(self.checked).frame_at(done_s(self.film));
                let options = GlbOptions { cell: false, colour: Some(Quantity::Sag) };
                files::write_whole(path, &record::glb(self.film, &frame, options))
            }
            Kind::Stl => files::write_whole(path, &record::stl(self.film)),
        }
    }

    fn mcap(&self, path: &Path) -> Result<(), String> {
        let told = |error: &dyn std::fmt::Display| error.to_string();
        let report_json = report::to_json(self.report);
        let run = self.run();
        let pictures = self.pictures();
        let recording = McapRecording {
            preflight: self.checked,
            film: self.film,
            run: &run,
            attachments: Attachments {
                job: (&self.source.name, self.source.text.as_bytes()),
                report_json: report_json.as_bytes(),
                urdf: self.urdf,
                more: Vec::new(),
            },
            pictures: &pictures,
            profile: match self.profile {
                McapProfile::Foxglove => Profile::Foxglove,
                McapProfile::Ros2 => Profile::Ros2,
            },
            epoch_ns: 0,
        };
        let mut file = BufWriter::new(File::create(path).map_err(|error| told(&error))?);
        record::write_mcap(&recording, &mut file).map_err(|error| told(&error))?;
        file.flush().map_err(|error| told(&error))
    }

    fn rerun(&self, path: &Path) -> Result<(), String> {
        let words: Vec<FindingWords<'_>> = self
            .report
            .findings
            .iter()
            .zip(&self.film.findings)
            .map(|(finding, place)| FindingWords {
                code: &finding.code,
                severity: place.severity,
                message: &finding.message,
                hint: &finding.hint,
            })
            .collect();
        let page = report::markdown(self.report);
        record::write_rrd(self.checked, self.film, &words, &page, &self.pictures(), path)
            .map(drop)
            .map_err(|error| error.to_string())
    }

    /// Facts of the run.
    fn run(&self) -> BTreeMap<String, String> {
        let provenance = &self.report.provenance;
        let mut run = BTreeMap::from([
            ("twin".to_owned(), provenance.twin.clone()),
            ("job".to_owned(), self.report.name.clone()),
        ]);
        for input in &provenance.inputs {
            run.insert(format!("sha256 of {} {}", input.what, input.name), input.sha256.clone());
        }
        run
    }

    /// The film strip as PNG files with their times.
    fn pictures(&self) -> Vec<(f64, Vec<u8>)> {
        let shots = self.album.into_iter().flat_map(|album| &album.shots);
        shots
            .filter_map(|shot| match shot.shows {
                Shows::Moment(time_s) => Some((time_s, png(&shot.rgba).ok()?)),
                _ => None,
            })
            .collect()
    }
}
