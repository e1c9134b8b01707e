//! Coordinate frames of a recording: every link by its name, and tool, bed and part, all in the world.

use std::collections::BTreeSet;

use sim::film::{Film, FilmBody, Frame};
use sim::pose::{Pose, is_finite};
use sim::scene::BodyKind;

use super::text::{self, distinct};

/// Name of the frame all others are told in.
pub(crate) const WORLD: &str = "world";

/// A frame with its mover.
#[derive(Debug, Clone)]
pub(crate) struct NamedFrame {
    /// Its name, no other's.
    pub(crate) name: String,
    /// What it rides on, an index in [`Film::movers`].
    pub(crate) mover: usize,
    /// Its axes in those of the mover.
    pub(crate) mover_from_frame: Pose,
}

impl NamedFrame {
    /// Whether it never moves.
    pub(crate) fn is_still(&self) -> bool {
        self.mover == Film::ROOM
    }
}

/// All frames, and the one each body is drawn in.
#[derive(Debug, Clone)]
pub(crate) struct Frames {
    /// The frames but the world.
    pub(crate) all: Vec<NamedFrame>,
    /// For each body of the film its frame, `None` for the world, and `frame_from_body`.
    of_body: Vec<(Option<usize>, Pose)>,
}

impl Frames {
    /// Frames of a film. Names that occur twice are numbered.
    pub(crate) fn new(film: &Film) -> Frames {
        let ours = [(film.tool, "tool"), (film.bed, "bed"), (film.part, "part")];
        let own = |(mover, name): &(usize, &str)| NamedFrame {
            name: (*name).to_owned(),
            mover: *mover,
            mover_from_frame: Pose::identity(),
        };
        let mut all: Vec<NamedFrame> = ours.iter().map(own).collect();
        let mut taken: BTreeSet<String> = all.iter().map(|frame| frame.name.clone()).collect();
        taken.insert(WORLD.to_owned());
        let mut of_body = Vec::with_capacity(film.bodies.len());
        for body in &film.bodies {
            if !is_link(body) {
                let index = ours.iter().position(|(mover, _)| *mover == body.mover);
                of_body.push((index, body.mover_from_body));
                continue;
            }
            let name = distinct(&body.name, |name| taken.contains(name));
            taken.insert(name.clone());
            of_body.push((Some(all.len()), Pose::identity()));
            all.push(NamedFrame {
                name,
                mover: body.mover,
                mover_from_frame: body.mover_from_body,
            });
        }
        Frames { all, of_body }
    }

    /// The frame a body is drawn in, and its axes there.
    pub(crate) fn of_body(&self, body: usize) -> (&str, Pose) {
        let (index, pose) = self.of_body.get(body).copied().unwrap_or((None, Pose::identity()));
        (index.map_or(WORLD, |index| &self.all[index].name), pose)
    }

    /// `world_from_frame` of every frame; those that are not finite are left out.
    pub(crate) fn poses<'a>(
        &'a self,
        frame: &'a Frame,
    ) -> impl Iterator<Item = (&'a NamedFrame, Pose)> {
        self.all.iter().filter_map(|named| {
            let world_from_mover = frame.world_from_mover.get(named.mover)?;
            let pose = world_from_mover * named.mover_from_frame;
            is_finite(&pose).then_some((named, pose))
        })
    }
}

/// Links have frames of their own; all else is drawn in the frame it rides on.
fn is_link(body: &FilmBody) -> bool {
    matches!(body.kind, BodyKind::Arm | BodyKind::OtherArm)
}

/// Names of joints for both profiles.
pub(crate) fn joint_names(film: &Film) -> Vec<String> {
    film.joints.iter().map(|joint| text::name(&joint.name)).collect()
}
