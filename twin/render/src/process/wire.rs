//! What parent and child say to each other: scenes and pictures as bytes.
//!
//! Little-endian numbers, lists and texts with their length in front. Both ends are the same program, so there is no
//! version; whatever else the bytes say, reading gives `None` and neither panics nor takes more memory than the bytes.

use sim::pose::{Point, Pose, Vector};
use sim::scene::{
    BedShape, Body, BodyKind, Bounds, ColourScale, Mark, MarkSeverity, Row, Scene, Shape,
    StrandShape,
};

/// Bytes that grow.
#[derive(Default)]
pub(super) struct Writer(pub(super) Vec<u8>);

impl Writer {
    pub(super) fn number(&mut self, value: f64) {
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn count(&mut self, value: usize) {
        self.0.extend((value as u32).to_le_bytes());
    }

    pub(super) fn text(&mut self, text: &str) {
        self.count(text.len());
        self.0.extend(text.as_bytes());
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.0.extend(bytes);
    }

    pub(super) fn list<T>(&mut self, all: &[T], each: impl Fn(&mut Self, &T)) {
        self.count(all.len());
        all.iter().for_each(|one| each(self, one));
    }

    pub(super) fn maybe<T>(&mut self, value: Option<&T>, each: impl Fn(&mut Self, &T)) {
        self.count(usize::from(value.is_some()));
        value.into_iter().for_each(|one| each(self, one));
    }

    fn numbers(&mut self, values: impl IntoIterator<Item = f64>) {
        values.into_iter().for_each(|value| self.number(value));
    }

    pub(super) fn point(&mut self, point: &Point) {
        self.numbers(point.coords.iter().copied());
    }

    pub(super) fn vector(&mut self, vector: &Vector) {
        self.numbers(vector.iter().copied());
    }

    fn pose(&mut self, pose: &Pose) {
        self.numbers(pose.translation.vector.iter().chain(pose.rotation.coords.iter()).copied());
    }

    fn bounds(&mut self, bounds: &Bounds) {
        self.point(&bounds.min);
        self.point(&bounds.max);
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Capsule { a, b, radius_m } => {
                self.count(0);
                self.point(a);
                self.point(b);
                self.number(*radius_m);
            }
            Shape::Cone { from, to, radius_from_m, radius_to_m } => {
                self.count(1);
                self.point(from);
                self.point(to);
                self.numbers([*radius_from_m, *radius_to_m]);
            }
            Shape::Box { pose, half_m } => {
                self.count(2);
                self.pose(pose);
                self.vector(half_m);
            }
            Shape::Hull { points } => {
                self.count(3);
                self.list(points, Self::point);
            }
            Shape::Mesh { vertices, triangles } => {
                self.count(4);
                self.list(vertices, Self::point);
                self.list(triangles, |to, corners| {
                    corners.iter().for_each(|&corner| to.count(corner as usize));
                });
            }
        }
    }

    fn body(&mut self, body: &Body) {
        self.text(&body.name);
        self.count(KINDS.iter().position(|&kind| kind == body.kind).unwrap_or(0));
        self.pose(&body.pose);
        self.shape(&body.shape);
        self.count(usize::from(body.highlighted));
    }

    fn strand(&mut self, strand: &StrandShape) {
        self.list(&strand.points, Self::point);
        self.number(strand.radius_m);
        self.maybe(strand.value.as_ref(), |to, value| to.number(*value));
        self.count(usize::from(strand.highlighted));
    }

    fn mark(&mut self, mark: &Mark) {
        self.point(&mark.at);
        self.text(&mark.label);
        self.count(SEVERITIES.iter().position(|&known| known == mark.severity).unwrap_or(0));
    }

    fn colour(&mut self, scale: &ColourScale) {
        self.text(&scale.title);
        self.text(&scale.unit);
        self.numbers([scale.low, scale.high]);
        self.maybe(scale.limit.as_ref(), |to, limit| to.number(*limit));
    }

    pub(super) fn scene(&mut self, scene: &Scene) {
        self.list(&scene.bodies, Self::body);
        self.list(&scene.strands, Self::strand);
        self.list(&scene.planned, Self::strand);
        self.maybe(scene.bed.as_ref(), |to, bed| {
            to.pose(&bed.pose);
            to.numbers(bed.size_m);
        });
        self.text(&scene.title);
        self.list(&scene.marks, Self::mark);
        self.maybe(scene.colour.as_ref(), Self::colour);
        self.maybe(scene.part_bounds.as_ref(), Self::bounds);
    }

    pub(super) fn row(&mut self, row: &Row) {
        self.text(&row.title);
        self.list(&row.scenes, Self::scene);
        self.list(&row.notes, |to, note| to.text(note));
        self.maybe(row.stamp.as_ref(), |to, stamp| to.text(stamp));
    }
}

const KINDS: [BodyKind; 7] = [
    BodyKind::Arm,
    BodyKind::Tool,
    BodyKind::Nozzle,
    BodyKind::Bed,
    BodyKind::Obstacle,
    BodyKind::Form,
    BodyKind::OtherArm,
];

const SEVERITIES: [MarkSeverity; 3] =
    [MarkSeverity::Note, MarkSeverity::Warning, MarkSeverity::Error];

/// Bytes that are used up.
pub(super) struct Reader<'a>(pub(super) &'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, n: usize) -> Option<&'a [u8]> {
        let (head, rest) = self.0.split_at_checked(n)?;
        self.0 = rest;
        Some(head)
    }

    pub(super) fn number(&mut self) -> Option<f64> {
        Some(f64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    pub(super) fn count(&mut self) -> Option<usize> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?) as usize)
    }

    pub(super) fn flag(&mut self) -> Option<bool> {
        Some(self.count()? != 0)
    }

    pub(super) fn bytes(&mut self) -> Option<&'a [u8]> {
        let n = self.count()?;
        self.take(n)
    }

    pub(super) fn text(&mut self) -> Option<String> {
        String::from_utf8(self.bytes()?.to_vec()).ok()
    }

    /// Memory follows the bytes that are really there, not the count that they claim.
    pub(super) fn list<T>(&mut self, each: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let n = self.count()?;
        let mut all = Vec::with_capacity(n.min(self.0.len() / 4));
        for _ in 0..n {
            all.push(each(self)?);
        }
        Some(all)
    }

    #[allow(clippy::option_option, reason = "absent, or cannot be read")]
    pub(super) fn maybe<T>(&mut self, each: impl Fn(&mut Self) -> Option<T>) -> Option<Option<T>> {
        if self.flag()? { each(self).map(Some) } else { Some(None) }
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut all = [0.0; N];
        for value in &mut all {
            *value = self.number()?;
        }
        Some(all)
    }

    pub(super) fn point(&mut self) -> Option<Point> {
        self.numbers::<3>().map(Point::from)
    }

    pub(super) fn vector(&mut self) -> Option<Vector> {
        self.numbers::<3>().map(Vector::from)
    }

    fn pose(&mut self) -> Option<Pose> {
        let at = self.vector()?;
        let turn = nalgebra::Quaternion::from_vector(self.numbers::<4>()?.into());
        Some(Pose::from_parts(at.into(), nalgebra::Unit::new_unchecked(turn)))
    }

    fn bounds(&mut self) -> Option<Bounds> {
        Some(Bounds { min: self.point()?, max: self.point()? })
    }

    fn shape(&mut self) -> Option<Shape> {
        Some(match self.count()? {
            0 => Shape::Capsule { a: self.point()?, b: self.point()?, radius_m: self.number()? },
            1 => Shape::Cone {
                from: self.point()?,
                to: self.point()?,
                radius_from_m: self.number()?,
                radius_to_m: self.number()?,
            },
            2 => Shape::Box { pose: self.pose()?, half_m: self.vector()? },
            3 => Shape::Hull { points: self.list(Self::point)? },
            4 => Shape::Mesh {
                vertices: self.list(Self::point)?,
                triangles: self.list(|from| {
                    Some([from.count()? as u32, from.count()? as u32, from.count()? as u32])
                })?,
            },
            _ => return None,
        })
    }

    fn body(&mut self) -> Option<Body> {
        Some(Body {
            name: self.text()?,
            kind: *KINDS.get(self.count()?)?,
            pose: self.pose()?,
            shape: self.shape()?,
            highlighted: self.flag()?,
        })
    }

    fn strand(&mut self) -> Option<StrandShape> {
        Some(StrandShape {
            points: self.list(Self::point)?,
            radius_m: self.number()?,
            value: self.maybe(Self::number)?,
            highlighted: self.flag()?,
        })
    }

    fn mark(&mut self) -> Option<Mark> {
        let (at, label) = (self.point()?, self.text()?);
        Some(Mark { at, label, severity: *SEVERITIES.get(self.count()?)? })
    }

    fn colour(&mut self) -> Option<ColourScale> {
        Some(ColourScale {
            title: self.text()?,
            unit: self.text()?,
            low: self.number()?,
            high: self.number()?,
            limit: self.maybe(Self::number)?,
        })
    }

    pub(super) fn scene(&mut self) -> Option<Scene> {
        Some(Scene {
            bodies: self.list(Self::body)?,
            strands: self.list(Self::strand)?,
            planned: self.list(Self::strand)?,
            bed: self
                .maybe(|from| Some(BedShape { pose: from.pose()?, size_m: from.numbers()? }))?,
            title: self.text()?,
            marks: self.list(Self::mark)?,
            colour: self.maybe(Self::colour)?,
            part_bounds: self.maybe(Self::bounds)?,
        })
    }

    pub(super) fn row(&mut self) -> Option<Row> {
        Some(Row {
            title: self.text()?,
            scenes: self.list(Self::scene)?,
            notes: self.list(Self::text)?,
            stamp: self.maybe(Self::text)?,
        })
    }
}
