//! Lines cut where they cross and end: the nodes and bars of a frame in a box.

use std::ops::Range;

use super::lines::{Family, Region, distance};

/// Pieces of a line that are looked at together.
const STRETCH: usize = 16;

/// What a bar is printed as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Piece of a line (or of one direction of a grid), in the layers of its family.
    Inner(Family),
    /// The box around it, in all layers.
    Enclosure,
}

/// A straight bar between two nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bar {
    pub(super) ends: [usize; 2],
    pub(super) part: Part,
}

/// A plane frame: centre lines.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Net {
    pub(super) nodes_m: Vec<[f64; 2]>,
    pub(super) bars: Vec<Bar>,
}

impl Net {
    pub(super) fn length_m(&self, bar: &Bar) -> f64 {
        distance(self.nodes_m[bar.ends[0]], self.nodes_m[bar.ends[1]])
    }

    /// Total length of what is printed as something.
    pub(super) fn total_m(&self, is: impl Fn(Part) -> bool) -> f64 {
        self.bars.iter().filter(|bar| is(bar.part)).map(|bar| self.length_m(bar)).sum()
    }
}

/// A line of a family, from edge to edge.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    pub(super) family: Family,
    pub(super) points: Vec<[f64; 2]>,
}

/// Makes a net of lines in an enclosure.
///
/// A line that ends within `touch_m` of a side is led straight to it. Nodes: `marks` on the
/// enclosure, ends of lines, crossings of the two families; one nearer than `joint_m` to an earlier
/// one is the same joint. Bars run straight between neighbours on a line; those along a side lie in
/// it, those between the same two joints on each other, and those that lead nowhere carry nothing:
/// all three are left out.
pub(super) fn net(
    lines: &[Line],
    enclosure: &Region,
    marks: &[[f64; 2]],
    touch_m: f64,
    joint_m: f64,
) -> Net {
    let mut joints = Joints { enclosure: *enclosure, joint_m, nodes_m: Vec::new() };
    for &mark in marks {
        joints.at(mark);
    }
    // stations on each line: how far along, and the joint
    let mut stations: Vec<Vec<(f64, usize)>> = vec![Vec::new(); lines.len()];
    for (line, stations) in lines.iter().zip(&mut stations) {
        let last = line.points.len().saturating_sub(1);
        for (along, end) in [(0.0, line.points.first()), (last as f64, line.points.last())] {
            if let Some(foot) = end.and_then(|&end| joints.foot(end, touch_m)) {
                stations.push((along, joints.at(foot)));
            }
        }
    }
    for one in (0..lines.len()).filter(|&one| lines[one].family == Family::Larger) {
        for other in (0..lines.len()).filter(|&other| lines[other].family == Family::Smaller) {
            for (along_one, along_other, at) in crossings(&lines[one].points, &lines[other].points)
            {
                let joint = joints.at(at);
                stations[one].push((along_one, joint));
                stations[other].push((along_other, joint));
            }
        }
    }
    let mut bars = joints.sides();
    for (line, mut stations) in lines.iter().zip(stations) {
        stations.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in stations.windows(2) {
            let ends = [pair[0].1.min(pair[1].1), pair[0].1.max(pair[1].1)];
            let bar = Bar { ends, part: Part::Inner(line.family) };
            if ends[0] != ends[1] && !joints.on_one_side(ends) && !bars.contains(&bar) {
                bars.push(bar);
            }
        }
    }
    without_dead_ends(Net { nodes_m: joints.nodes_m, bars })
}

/// Nodes found so far, earlier ones first.
struct Joints {
    enclosure: Region,
    joint_m: f64,
    nodes_m: Vec<[f64; 2]>,
}

impl Joints {
    /// The joint at a place, an earlier one if it is near.
    fn at(&mut self, at: [f64; 2]) -> usize {
        let away2 = |node: &[f64; 2]| minus(*node, at).iter().map(|gap| gap * gap).sum::<f64>();
        let nearest = self.nodes_m.iter().map(away2).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        match nearest {
            Some((node, away2)) if away2 < self.joint_m.powi(2) => node,
            _ => {
                self.nodes_m.push(at);
                self.nodes_m.len() - 1
            }
        }
    }

    /// Foot on the nearest side, if one is within reach.
    fn foot(&self, at: [f64; 2], touch_m: f64) -> Option<[f64; 2]> {
        let sides = [0, 1].into_iter().flat_map(|axis| {
            [self.enclosure.low_m[axis], self.enclosure.high_m[axis]].map(|side| (axis, side))
        });
        let (axis, side) =
            sides.min_by(|a, b| (at[a.0] - a.1).abs().total_cmp(&(at[b.0] - b.1).abs()))?;
        let mut foot = at;
        foot[axis] = side;
        // the edge of the region is reached to rounding
        ((at[axis] - side).abs() <= touch_m * (1.0 + 1e-6)).then_some(foot)
    }

    fn on_side(&self, node: usize, axis: usize, side: f64) -> bool {
        (self.nodes_m[node][axis] - side).abs() <= 1e-9 * self.joint_m
    }

    fn four_sides(&self) -> [(usize, f64); 4] {
        let (low, high) = (self.enclosure.low_m, self.enclosure.high_m);
        [(1, low[1]), (0, high[0]), (1, high[1]), (0, low[0])]
    }

    fn on_one_side(&self, ends: [usize; 2]) -> bool {
        let on =
            |&(axis, side): &(usize, f64)| ends.iter().all(|&node| self.on_side(node, axis, side));
        self.four_sides().iter().any(on)
    }

    /// The enclosure, node by node along each side.
    fn sides(&self) -> Vec<Bar> {
        let mut bars = Vec::new();
        for (axis, side) in self.four_sides() {
            let on = |node: &usize| self.on_side(*node, axis, side);
            let mut nodes: Vec<usize> = (0..self.nodes_m.len()).filter(on).collect();
            let along = |node: &usize| self.nodes_m[*node][1 - axis];
            nodes.sort_by(|a, b| along(a).total_cmp(&along(b)));
            bars.extend(
                nodes
                    .windows(2)
                    .map(|pair| Bar { ends: [pair[0], pair[1]], part: Part::Enclosure }),
            );
        }
        bars
    }
}

/// Where two polylines cross: how far along each (pieces and parts of one), and the place.
fn crossings(one: &[[f64; 2]], other: &[[f64; 2]]) -> Vec<(f64, f64, [f64; 2])> {
    let (stretches_one, stretches_other) = (stretches(one), stretches(other));
    let mut found = Vec::new();
    for (pieces_one, box_one) in &stretches_one {
        for (pieces_other, box_other) in &stretches_other {
            if apart(box_one, box_other) {
                continue;
            }
            for i in pieces_one.clone() {
                for j in pieces_other.clone() {
                    let pieces = [[one[i], one[i + 1]], [other[j], other[j + 1]]];
                    if let Some((s, t, at)) = crossing(pieces) {
                        found.push((i as f64 + s, j as f64 + t, at));
                    }
                }
            }
        }
    }
    found
}

/// Runs of pieces with the box around each, so that far ones are passed over together.
fn stretches(line: &[[f64; 2]]) -> Vec<(Range<usize>, Region)> {
    let last = line.len().saturating_sub(1);
    let of = |from: usize| {
        let pieces = from..(from + STRETCH).min(last);
        let points = &line[pieces.start..=pieces.end];
        let most = |axis: usize, pick: fn(f64, f64) -> f64| {
            points.iter().map(|at| at[axis]).fold(points[0][axis], pick)
        };
        let low_m = [0, 1].map(|axis| most(axis, f64::min));
        let high_m = [0, 1].map(|axis| most(axis, f64::max));
        (pieces, Region { low_m, high_m })
    };
    (0..last).step_by(STRETCH).map(of).collect()
}

fn apart(a: &Region, b: &Region) -> bool {
    (0..2).any(|axis| a.high_m[axis] < b.low_m[axis] || b.high_m[axis] < a.low_m[axis])
}

/// Where two straight pieces cross, as parts of each. Half open, so that a corner of a line counts
/// once; parallel pieces give no numbers.
fn crossing([a, b]: [[[f64; 2]; 2]; 2]) -> Option<(f64, f64, [f64; 2])> {
    let (u, v, gap) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(b[0], a[0]));
    let area = cross(u, v);
    let (s, t) = (cross(gap, v) / area, cross(gap, u) / area);
    let inside = (0.0..1.0).contains(&s) && (0.0..1.0).contains(&t);
    inside.then(|| (s, t, [a[0][0] + s * u[0], a[0][1] + s * u[1]]))
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Drops bars that hang on one node only, again and again, and nodes without bars.
fn without_dead_ends(mut net: Net) -> Net {
    loop {
        let mut degree = vec![0usize; net.nodes_m.len()];
        net.bars.iter().flat_map(|bar| bar.ends).for_each(|node| degree[node] += 1);
        let before = net.bars.len();
        net.bars.retain(|bar| bar.ends.iter().all(|&node| degree[node] > 1));
        if net.bars.len() == before {
            let mut name = vec![0usize; degree.len()];
            let mut kept = Vec::new();
            for node in (0..degree.len()).filter(|&node| degree[node] > 0) {
                name[node] = kept.len();
                kept.push(net.nodes_m[node]);
            }
            for bar in &mut net.bars {
                bar.ends = bar.ends.map(|node| name[node]);
            }
            return Net { nodes_m: kept, bars: net.bars };
        }
    }
}
