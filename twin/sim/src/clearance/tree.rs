//! A tree of boxes over items, in flat arrays.
//!
//! Built in O(n log n) by halving along the longest edge of the box about the middles; the same
//! items give the same tree. A search goes to the nearer child first and leaves out what is
//! further than the best so far: O(log n) where one item is clearly nearest, O(n) where all are as
//! near. Every node knows the least number in it, so that a search may be held to the items
//! before a number ("what is printed so far"): a node with none of them costs one comparison.

use crate::pose::{Point, Vector};

/// Items in a leaf, at most.
const LEAF: usize = 4;

/// Levels of the tree: halving 2³² items gives 32.
const LEVELS: usize = 48;

#[derive(Debug, Clone)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Numbers of the items, leaf by leaf.
    pub(super) order: Vec<u32>,
}

/// A box with what is in it.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) middle: Point,
    pub(super) half: Vector,
    /// Half the diagonal, m.
    pub(super) radius_m: f64,
    /// Least number of an item in it.
    first: u32,
    /// Items in it if it is a leaf, else 0.
    n_items: u32,
    /// Place of its first item, or of its second child; the first child follows the node.
    link: u32,
}

impl Node {
    /// Distance of a point from the box, m; zero inside.
    pub(super) fn to_point(&self, point: &Point) -> f64 {
        let out = (point - self.middle).abs() - self.half;
        out.sup(&Vector::zeros()).norm()
    }
}

impl Tree {
    /// Over items of these boxes (lowest and highest corner).
    pub(super) fn new(boxes: &[(Point, Point)]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        if !boxes.is_empty() {
            let n_items = order.len();
            grow(boxes, &mut order, 0, n_items, &mut nodes);
        }
        Self { nodes, order }
    }

    /// The box about all items; `None` of nothing.
    pub(super) fn root(&self) -> Option<&Node> {
        self.nodes.first()
    }

    /// The least that `measure` gives for an item numbered below `below`, where that is less than
    /// `best_m`; else `best_m`.
    ///
    /// `bound_m` is a lower bound for all items in a node. `measure` gets the place of an item in
    /// `order` and the best so far.
    pub(super) fn least(
        &self,
        below: u32,
        mut best_m: f64,
        bound_m: impl Fn(&Node) -> f64,
        mut measure: impl FnMut(usize, f64) -> f64,
    ) -> f64 {
        let mut open = [(0u32, 0f64); LEVELS];
        let mut n_open = 0;
        let Some(root) = self.nodes.first() else { return best_m };
        if root.first < below {
            open[0] = (0, bound_m(root));
            n_open = 1;
        }
        while n_open > 0 {
            n_open -= 1;
            let (mut index, mut node_m) = open[n_open];
            while node_m < best_m {
                let node = &self.nodes[index as usize];
                if node.n_items > 0 {
                    let from = node.link as usize;
                    for place in from..from + node.n_items as usize {
                        if self.order[place] < below {
                            best_m = best_m.min(measure(place, best_m));
                        }
                    }
                    break;
                }
                let child = |index: u32| {
                    let node = &self.nodes[index as usize];
                    (index, if node.first < below { bound_m(node) } else { f64::INFINITY })
                };
                let (mut near, mut far) = (child(index + 1), child(node.link));
                if far.1 < near.1 {
                    (near, far) = (far, near);
                }
                if far.1 < best_m && n_open < LEVELS {
                    open[n_open] = far;
                    n_open += 1;
                }
                (index, node_m) = near;
            }
        }
        best_m
    }

    /// Visits the places in `order` of all items numbered below `below` in leaves whose box
    /// is within reach.
    pub(super) fn visit(
        &self,
        below: u32,
        within: impl Fn(&Node) -> bool,
        mut visit: impl FnMut(usize),
    ) {
        let mut open = [0u32; LEVELS];
        let mut n_open = usize::from(!self.nodes.is_empty());
        while n_open > 0 {
            n_open -= 1;
            let index = open[n_open];
            let node = &self.nodes[index as usize];
            if node.first >= below || !within(node) {
                continue;
            }
            if node.n_items > 0 {
                let places = node.link as usize..(node.link + node.n_items) as usize;
                places.filter(|&place| self.order[place] < below).for_each(&mut visit);
            } else {
                open[n_open] = node.link;
                open[n_open + 1] = index + 1;
                n_open += 2;
            }
        }
    }
}

/// Adds the node over `order[from..to]` and all under it.
fn grow(
    boxes: &[(Point, Point)],
    order: &mut [u32],
    from: usize,
    to: usize,
    nodes: &mut Vec<Node>,
) {
    let items = &mut order[from..to];
    let middle = |item: u32| nalgebra::center(&boxes[item as usize].0, &boxes[item as usize].1);
    let (mut low, mut high) = boxes[items[0] as usize];
    let (mut least, mut most) = (middle(items[0]), middle(items[0]));
    for &item in items.iter() {
        let (l, h) = boxes[item as usize];
        (low, high) = (low.inf(&l), high.sup(&h));
        (least, most) = (least.inf(&middle(item)), most.sup(&middle(item)));
    }
    let half = (high - low) / 2.0;
    let index = nodes.len();
    let leaf = items.len() <= LEAF;
    nodes.push(Node {
        middle: nalgebra::center(&low, &high),
        half,
        radius_m: half.norm(),
        first: items.iter().copied().min().unwrap_or(u32::MAX),
        n_items: if leaf { items.len() as u32 } else { 0 },
        link: from as u32,
    });
    if leaf {
        items.sort_unstable();
        return;
    }
    let axis = (most - least).imax();
    let cut = items.len() / 2;
    items.select_nth_unstable_by(cut, |&a, &b| {
        middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b))
    });
    grow(boxes, order, from, from + cut, nodes);
    nodes[index].link = nodes.len() as u32;
    grow(boxes, order, from + cut, to, nodes);
}
