//! Where the movers are, at a few times; the viewer goes straight between them.

use super::blob::Blob;
use super::grid::Grid;
use serde_json::{Value, json};
use sim::film::{Film, Player};
use sim::pose::{Point, Pose, is_finite};

/// Bytes of a mover at a time: three places, four of a quaternion.
const POSE_BYTES: usize = 14;
/// Times told at most: more are not seen.
pub(super) const KEYS_MAX: usize = 2400;

/// Poses of all movers at times that ascend.
#[derive(Debug, Clone, Default)]
pub(super) struct Keys {
    pub(super) time_s: Vec<f64>,
    /// `world_from_mover` of every mover of the film, at each time.
    pub(super) world_from_mover: Vec<Vec<Pose>>,
}

impl Keys {
    /// As many times as fit in `room` bytes, at most [`KEYS_MAX`].
    pub(super) fn of(player: &Player, film: &Film, room: usize) -> Keys {
        let most = (room / (8 + POSE_BYTES * film.movers.len())).clamp(2, KEYS_MAX);
        let mut time_s = player.key_times(most);
        time_s.retain(|time_s| time_s.is_finite());
        if time_s.is_empty() {
            time_s.push(0.0);
        }
        let frames = time_s.iter().map(|&time_s| player.frame_at(time_s).world_from_mover);
        Keys { world_from_mover: frames.collect(), time_s }
    }

    /// Poses at a place among the keys.
    pub(super) fn poses(&self, mover: usize) -> impl Iterator<Item = Pose> + '_ {
        self.world_from_mover
            .iter()
            .map(move |poses| poses.get(mover).copied().unwrap_or_default())
            .map(|pose| if is_finite(&pose) { pose } else { Pose::identity() })
    }

    /// Writes times and poses; what never moves is told once.
    pub(super) fn pack(&self, movers: usize, blob: &mut Blob) -> Value {
        blob.f64s("key_time", self.time_s.iter().copied());
        let told = (0..movers).map(|mover| {
            let first = self.poses(mover).next().unwrap_or_default();
            if self.poses(mover).all(|pose| pose == first) {
                let [t, q] = [first.translation.vector, first.rotation.coords.xyz()];
                return json!({ "still": [t.x, t.y, t.z, q.x, q.y, q.z, first.rotation.w] });
            }
            let at = |pose: Pose| Point::from(pose.translation.vector);
            let grid = Grid::about(self.poses(mover).map(at));
            blob.u16s(
                &format!("mover_at_{mover}"),
                self.poses(mover).flat_map(|pose| grid.code(&at(pose))),
            );
            blob.i16s(&format!("mover_turn_{mover}"), turns(self.poses(mover)));
            json!({ "box": grid.told() })
        });
        Value::Array(told.collect())
    }
}

/// Quaternions x, y, z, w, each on the side of the one before, so that going straight between them is short.
fn turns(poses: impl Iterator<Item = Pose>) -> Vec<i16> {
    let mut last = [0.0, 0.0, 0.0, 1.0];
    let mut codes = Vec::new();
    for pose in poses {
        let q = pose.rotation.coords;
        let mut now = [q.x, q.y, q.z, q.w];
        let dot: f64 = now.iter().zip(last).map(|(a, b)| a * b).sum();
        if dot < 0.0 {
            now = now.map(|x| -x);
        }
        codes.extend(now.map(|x| (x * 32767.0).round() as i16));
        last = now;
    }
    codes
}
