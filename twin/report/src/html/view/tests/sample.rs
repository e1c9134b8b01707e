//! A film made by hand, and what the viewer reads of it.

use super::super::View3d;
use super::super::grid::Grid;
use super::super::keys::Keys;
use serde_json::Value;
use sim::film::{Ageing, Film, FilmBody, FilmFinding, FilmStrand, Painted, Quantity};
use sim::pose::{Point, Pose};
use sim::scene::{BodyKind, ColourScale, MarkSeverity, Shape};

pub(super) fn painted(quantity: Quantity, low: f64, high: f64) -> Painted {
    let [title, unit] = [quantity.title(), quantity.unit()].map(str::to_owned);
    Painted { quantity, scale: ColourScale { title, unit, low, high, limit: None } }
}

/// A strand that winds up, one second for each segment.
fn strand(order: usize, segments: usize, id: &str) -> FilmStrand {
    let at = |k: usize| {
        let turn = k as f64 * 0.1;
        Point::new(0.1 * turn.cos() + 0.01 * order as f64, 0.1 * turn.sin(), 1e-4 * k as f64)
    };
    let points: Vec<Point> = (0..=segments).map(at).collect();
    let born_s = (order * segments) as f64;
    FilmStrand {
        id: id.to_owned(),
        strand: order,
        planned: points.iter().map(|p| Point::new(p.x, p.y, p.z + 1e-3)).collect(),
        at_m: (0..=segments).map(|k| 0.01 * k as f64).collect(),
        time_s: (0..=segments).map(|k| born_s + k as f64).collect(),
        radius_m: 1e-3,
        bead_m: vec![2e-3; segments],
        speed_m_s: vec![0.01; segments],
        sag_m: 5e-5,
        clearance_m: f64::INFINITY,
        displacement_m: vec![f64::NAN; segments],
        utilisation: vec![0.1; segments],
        ageing: Ageing {
            age_s: vec![0.0, 1.0 + order as f64],
            temperature_k: vec![500.0, 300.0],
            ..Ageing::default()
        },
        points,
    }
}

pub(super) fn film(strands: usize, segments: usize, name: &str) -> Film {
    let body = FilmBody {
        name: name.to_owned(),
        kind: BodyKind::Form,
        mover: 3,
        mover_from_body: Pose::translation(0.0, 0.0, 0.05),
        shapes: vec![
            Shape::Cone {
                from: Point::origin(),
                to: Point::new(0.0, 0.0, 0.1),
                radius_from_m: 0.05,
                radius_to_m: 0.05,
            },
            Shape::sphere(Point::origin(), 0.02),
        ],
        gone_s: Some(5.0),
    };
    let finding = FilmFinding {
        found: None,
        excess: 0.5,
        code: "C201",
        severity: MarkSeverity::Error,
        time_s: Some(1.5),
        at: Some(Point::new(0.1, 0.0, 0.0)),
        strand: Some(0),
        bodies: vec![name.to_owned()],
        words: name.to_owned(),
        shown_on_part: true,
    };
    Film {
        job: name.to_owned(),
        cell: name.to_owned(),
        movers: ["world", "tool", "bed", "part"].map(str::to_owned).to_vec(),
        tool: 1,
        bed: 2,
        part: 3,
        bodies: vec![body],
        bed_size_m: [0.3, 0.2],
        strands: (0..strands).map(|order| strand(order, segments, name)).collect(),
        legs: Vec::new(),
        findings: vec![finding],
        joints: Vec::new(),
        painted: vec![
            painted(Quantity::Sag, 0.0, 0.1),
            painted(Quantity::Temperature, 20.0, 230.0),
            painted(Quantity::BeadWidth, 1.0, 3.0),
            painted(Quantity::Speed, 0.0, 20.0),
            painted(Quantity::Clearance, 0.0, 2.0),
        ],
        total_s: (strands * segments) as f64,
    }
}

/// The tool goes along x; all else stands still.
pub(super) fn keys(many: usize) -> Keys {
    let poses = |k: usize| {
        let mut poses = vec![Pose::identity(); 4];
        poses[1] = Pose::new(
            sim::pose::Vector::new(k as f64 * 0.01, 0.2, 0.3),
            sim::pose::Vector::z() * (k as f64 * 0.3),
        );
        poses
    };
    Keys {
        time_s: (0..many).map(|k| k as f64).collect(),
        world_from_mover: (0..many).map(poses).collect(),
    }
}

/// What the viewer reads.
pub(super) struct Read {
    pub(super) head: Value,
    bytes: Vec<u8>,
}

impl Read {
    pub(super) fn of(view: &View3d) -> Read {
        let sign = |c: u8| match c {
            b'A'..=b'Z' => c - b'A',
            b'a'..=b'z' => c - b'a' + 26,
            b'0'..=b'9' => c - b'0' + 52,
            b'+' => 62,
            _ => 63,
        };
        let text = view.data.trim_end_matches('=').as_bytes();
        let bytes: Vec<u8> = text
            .chunks(4)
            .flat_map(|four| {
                let bits = four.iter().fold(0_u32, |bits, &c| bits << 6 | u32::from(sign(c)));
                let bits = bits << (6 * (4 - four.len()));
                [(bits >> 16) as u8, (bits >> 8) as u8, bits as u8].into_iter().take(four.len() - 1)
            })
            .collect();
        let length = u32::from_le_bytes(bytes[..4].try_into().expect("four bytes")) as usize;
        let head = serde_json::from_slice(&bytes[4..4 + length]).expect("a heading in JSON");
        Read { head, bytes: bytes[4 + length..].to_vec() }
    }

    pub(super) fn array(&self, name: &str) -> (&str, &[u8], usize) {
        let array = &self.head["arrays"][name];
        let kind = array[0].as_str().expect("a type");
        let [from, many] = [1, 2].map(|k| array[k].as_u64().expect("a number") as usize);
        let size = kind[1..].parse::<usize>().expect("bits") / 8;
        assert_eq!(from % 8, 0, "{name}");
        (kind, &self.bytes[from..from + many * size], many)
    }

    pub(super) fn u16s(&self, name: &str) -> Vec<u16> {
        let (kind, bytes, _) = self.array(name);
        assert_eq!(kind, "u16");
        bytes.chunks(2).map(|two| u16::from_le_bytes([two[0], two[1]])).collect()
    }

    pub(super) fn grid(&self, told: &Value) -> Grid {
        let x = |k: usize| told["box"][k].as_f64().expect("a number");
        Grid { min: [x(0), x(1), x(2)], size: [x(3), x(4), x(5)] }
    }
}
