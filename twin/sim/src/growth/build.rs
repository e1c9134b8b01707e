//! Strands and contacts to nodes and members.
//!
//! A strand becomes members between its *stations*: the corners of its polyline as planned (at
//! their places as printed), its contacts, its ends. Ends within half a bead of each other become one node, as do contacts whose axes
//! meet; other contacts become links, short weightless members with the softness of the patch of contact.

use super::Printed;
use super::built::Built;
use super::strand_law::StrandLaw;
use super::welds::{Bond, Joined, patch_m2, welds};
use crate::cell::{Job, Join, On};
use crate::deposit::{Contact, Deposit};
use crate::pose::Point;
use crate::structure::{At, Frame, Member};

/// Stations nearer than this share of a radius are one.
const SAME_SHARE: f64 = 0.2;
/// Turn at a vertex below which it is no station, rad.
const STRAIGHT_RAD: f64 = 1e-6;

/// A contact as seen from one of its two strands.
#[derive(Debug, Clone, Copy)]
struct Touch {
    contact: usize,
    side: usize,
    at_m: f64,
}

/// Builds the frame of a whole print.
pub fn build(job: &Job, printed: &Printed<'_>) -> Built {
    let &Printed { deposit, contacts, laws, bonds, .. } = printed;
    let mut touches: Vec<Vec<Touch>> = vec![Vec::new(); deposit.strands.len()];
    for (contact, each) in contacts.iter().enumerate() {
        if is_refused(job, deposit, each) {
            continue;
        }
        for side in 0..2 {
            touches[each.orders[side]].push(Touch { contact, side, at_m: each.at_m[side] });
        }
    }
    let mut builder = Builder {
        job,
        deposit,
        laws,
        contacts,
        bonds,
        contact_nodes: vec![[None; 2]; contacts.len()],
        nodes: Vec::new(),
        members: Vec::new(),
        built_ends: Vec::new(),
        member_order: Vec::new(),
        member_at_m: Vec::new(),
        born: vec![0],
        grounded: Vec::new(),
        formed: Vec::new(),
        links: Vec::new(),
        is_link: Vec::new(),
        joints: Vec::new(),
    };
    for (order, touches) in touches.iter_mut().enumerate() {
        touches.sort_by(|a, b| a.at_m.total_cmp(&b.at_m).then(a.contact.cmp(&b.contact)));
        builder.strand(order, touches);
    }
    builder.is_link.resize(builder.members.len(), false);
    let mut by_order = vec![Vec::new(); deposit.strands.len()];
    let joined: Vec<Joined> = builder.links.into_iter().chain(builder.joints).collect();
    let frame =
        Frame::new(builder.nodes, builder.members).expect("stations are apart and laws are sound");
    let (welds, weld_contact) = welds(&frame, printed, &joined);
    for &contact in &weld_contact {
        by_order[contacts[contact].orders[0]].push(contact);
    }
    Built {
        contacts: by_order,
        is_link: builder.is_link,
        welds,
        weld_contact,
        frame,
        born: builder.born,
        ends: builder.built_ends,
        member_order: builder.member_order,
        member_at_m: builder.member_at_m,
        grounded: builder.grounded,
        formed: builder.formed,
    }
}

/// Whether the author said that the later strand's end there is free. Strands that come after
/// may land on a free end.
fn is_refused(job: &Job, deposit: &Deposit, contact: &Contact) -> bool {
    let printed = &deposit.strands[contact.orders[0]];
    let strand = &job.strands[printed.strand];
    let length_m = printed.at_m.last().copied().unwrap_or(0.0);
    let near = |end_m: f64| (contact.at_m[0] - end_m).abs() < 2.0 * printed.radius_m;
    (strand.start.join == Some(Join::Free) && near(0.0))
        || (strand.end.join == Some(Join::Free) && near(length_m))
}

struct Builder<'a> {
    job: &'a Job,
    deposit: &'a Deposit,
    laws: &'a [StrandLaw],
    contacts: &'a [Contact],
    bonds: &'a [Bond],
    /// Node of each contact on each of its sides, once known.
    contact_nodes: Vec<[Option<usize>; 2]>,
    nodes: Vec<Point>,
    members: Vec<Member>,
    built_ends: Vec<[usize; 2]>,
    member_order: Vec<usize>,
    member_at_m: Vec<[f64; 2]>,
    born: Vec<usize>,
    grounded: Vec<(usize, usize)>,
    formed: Vec<(usize, usize, usize)>,
    links: Vec<Joined>,
    joints: Vec<Joined>,
    is_link: Vec<bool>,
}

impl Builder<'_> {
    fn strand(&mut self, order: usize, touches: &[Touch]) {
        let stations = self.stations(order, touches);
        let mut nodes: Vec<usize> = Vec::with_capacity(stations.len());
        let mut merged: Vec<Option<usize>> = Vec::with_capacity(stations.len());
        for station in &stations {
            let (node, by) = self.node(order, station, nodes.last().copied());
            nodes.push(node);
            merged.push(by);
        }
        let law = &self.laws[order];
        let member = |ends: [usize; 2]| Member {
            ends,
            section: law.section(),
            elastic: law.elastic(),
            density_kg_m3: law.density_kg_m3,
            initial_strain: law.strain,
            side: nalgebra::Vector3::zeros(),
            strand: self.deposit.strands[order].strand,
        };
        let mut joints: Vec<Joined> = Vec::new();
        for (at, &node) in nodes.iter().enumerate() {
            let mut through = Vec::new();
            if at > 0
                && self.members.last().is_some_and(|last| last.ends[1] == node)
                && self.member_order.last() == Some(&order)
            {
                through.push((self.members.len() - 1, At::Last));
            }
            let next = nodes.get(at + 1).copied();
            if let Some(next) = next.filter(|&next| self.nodes[next] != self.nodes[node]) {
                through.push((self.members.len(), At::First));
                self.members.push(member([node, next]));
                self.member_order.push(order);
                self.member_at_m.push([stations[at].at_m, stations[at + 1].at_m]);
            }
            if let Some(contact) = merged[at] {
                joints.push(Joined { node, contact, through });
            }
        }
        self.joints.extend(joints);
        self.links(order, touches);
        self.hold(order, &nodes);
        self.born.push(self.members.len());
        self.built_ends.push([nodes[0], nodes[nodes.len() - 1]]);
    }

    /// Corners, contacts and ends by arc length, those that are nearly one merged.
    fn stations(&self, order: usize, touches: &[Touch]) -> Vec<Station> {
        let printed = &self.deposit.strands[order];
        let same_m = SAME_SHARE * printed.radius_m;
        let last = printed.as_printed.len() - 1;
        let mut stations: Vec<Station> = Vec::new();
        for (k, point) in printed.as_printed.iter().enumerate() {
            let corner = k == 0 || k == last || {
                let planned = &printed.as_planned;
                let (a, b) = (planned[k] - planned[k - 1], planned[k + 1] - planned[k]);
                a.angle(&b) > STRAIGHT_RAD
            };
            if corner {
                stations.push(Station {
                    at_m: printed.at_m[k],
                    point: *point,
                    touches: Vec::new(),
                });
            }
        }
        for touch in touches {
            let nearest = stations.iter().position(|station| {
                (station.at_m - touch.at_m).abs() <= self.snap_m(order, station, same_m)
            });
            if let Some(k) = nearest {
                stations[k].touches.push(*touch);
            } else {
                let after = stations.partition_point(|station| station.at_m < touch.at_m);
                let point = self.contacts[touch.contact].points[touch.side];
                stations.insert(after, Station { at_m: touch.at_m, point, touches: vec![*touch] });
            }
        }
        stations
    }

    /// How near a contact must be to a station to be one with it: half a bead at the ends.
    fn snap_m(&self, order: usize, station: &Station, same_m: f64) -> f64 {
        let printed = &self.deposit.strands[order];
        let length_m = printed.at_m[printed.at_m.len() - 1];
        let is_end = station.at_m == 0.0 || station.at_m == length_m;
        if is_end { printed.radius_m.max(same_m) } else { same_m }
    }

    /// The node of a station: that of the other side of a contact whose axes meet (and that contact), or a
    /// new one.
    fn node(
        &mut self,
        order: usize,
        station: &Station,
        before: Option<usize>,
    ) -> (usize, Option<usize>) {
        let radius_m = self.deposit.strands[order].radius_m;
        let mut merged: Option<(usize, usize)> = None;
        for touch in &station.touches {
            if let Some(other) = self.contact_nodes[touch.contact][1 - touch.side] {
                let apart_m = (self.nodes[other] - station.point).norm();
                if merged.is_none() && apart_m <= radius_m && Some(other) != before {
                    merged = Some((other, touch.contact));
                }
            }
        }
        let node = merged.map_or_else(
            || {
                self.nodes.push(station.point);
                self.nodes.len() - 1
            },
            |(node, _)| node,
        );
        for touch in &station.touches {
            self.contact_nodes[touch.contact][touch.side] = Some(node);
        }
        (node, merged.map(|(_, contact)| contact))
    }

    /// Links for contacts of this strand with earlier ones whose nodes did not become one.
    fn links(&mut self, order: usize, touches: &[Touch]) {
        let law = &self.laws[order];
        for touch in touches {
            let [Some(a), Some(b)] = self.contact_nodes[touch.contact] else { continue };
            let known = |member: &Member| member.ends == [a, b] || member.ends == [b, a];
            let length_m = (self.nodes[a] - self.nodes[b]).norm();
            let recent = self.members.iter().rev().take(8 * touches.len() + 8).any(known);
            if a == b || recent || length_m <= 0.0 {
                continue;
            }
            let through = vec![(self.members.len(), At::Middle)];
            self.links.push(Joined { node: a, contact: touch.contact, through });
            self.members.push(Member {
                ends: [a, b],
                section: law.link(patch_m2(&self.bonds[touch.contact], law.diameter_m), length_m),
                elastic: law.elastic(),
                density_kg_m3: 0.0,
                initial_strain: 0.0,
                side: nalgebra::Vector3::zeros(),
                strand: self.deposit.strands[order].strand,
            });
            self.member_order.push(order);
            self.member_at_m.push([touch.at_m; 2]);
            self.is_link.resize(self.members.len() - 1, false);
            self.is_link.push(true);
        }
    }

    /// Nodes that the bed or a form holds.
    fn hold(&mut self, order: usize, nodes: &[usize]) {
        let printed = &self.deposit.strands[order];
        let strand = &self.job.strands[printed.strand];
        match strand.on {
            On::Bed => self.grounded.extend(nodes.iter().map(|&node| (node, order))),
            On::Form(form) => self.formed.extend(nodes.iter().map(|&node| (node, order, form))),
            On::Air => {}
        }
        let ends = [(strand.start.join, nodes[0]), (strand.end.join, nodes[nodes.len() - 1])];
        for (join, node) in ends {
            match join {
                Some(Join::Bed) => self.grounded.push((node, order)),
                Some(Join::Form(form)) => self.formed.push((node, order, form)),
                Some(Join::Free | Join::Strand(_)) => {}
                None => {
                    let height_m = (self.job.bed_from_part * self.nodes[node]).z;
                    if height_m <= TOUCHES_BED * printed.radius_m {
                        self.grounded.push((node, order));
                    }
                }
            }
        }
    }
}

/// An end whose axis is lower over the bed than this many radii touches it.
const TOUCHES_BED: f64 = 1.1;

#[derive(Debug, Clone)]
struct Station {
    at_m: f64,
    point: Point,
    touches: Vec<Touch>,
}
