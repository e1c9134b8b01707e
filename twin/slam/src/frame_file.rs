//! A plain frame, as JSON, for `twin solve`: so that any engineer can hold its solver against another.
//!
//! Units mm, N, MPa, kg/mm³. Keys that are not known are passed over, so that files of references, which hold answers
//! too, can be read as they are.

use serde::Deserialize;

use crate::diagnostic::{Diagnostic, Source, Span};

#[cfg(test)]
mod tests;

/// A frame and its loads.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct FrameFile {
    /// Places, mm.
    pub nodes: Vec<[f64; 3]>,
    /// Pairs of nodes.
    pub members: Vec<[usize; 2]>,
    /// Of each member, a solid circle, mm.
    pub radius: Vec<f64>,
    /// Nodes held in all six freedoms.
    pub fixed: Vec<usize>,
    /// Young's modulus, MPa.
    #[serde(rename = "E")]
    pub e_mpa: f64,
    /// Shear modulus, MPa.
    #[serde(rename = "G")]
    pub g_mpa: f64,
    /// Density, kg/mm³.
    pub density: f64,
    /// Gravity, m/s².
    #[serde(default = "downwards")]
    pub gravity_m_s2: [f64; 3],
    /// Forces, N, and moments, N mm.
    #[serde(default)]
    pub nodal_loads: Vec<FrameLoad>,
    /// Of each member; empty: none.
    #[serde(default)]
    pub initial_strain: Vec<f64>,
    /// Factor on E and G of each member; empty: one.
    #[serde(default)]
    pub stiffness_factor: Vec<f64>,
    /// Whether members shear (Cowper's coefficient, ν = E/2G − 1).
    #[serde(default)]
    pub shear: bool,
    /// Members in the order in which they are printed; empty: not asked.
    #[serde(default)]
    pub sequence: Vec<usize>,
    /// What is wanted of buckling.
    #[serde(default)]
    pub buckling: FrameBuckling,
}

/// Load on a node.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
pub struct FrameLoad {
    /// The node.
    pub node: usize,
    /// Fx, Fy, Fz, N; Mx, My, Mz, N mm.
    pub load: [f64; 6],
}

/// What is wanted of buckling; asked only where `modes` is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
pub struct FrameBuckling {
    /// Equal parts per member; two where it is not told.
    pub elements_per_member: Option<usize>,
    /// How many factors.
    pub modes: Option<usize>,
}

fn downwards() -> [f64; 3] {
    [0.0, 0.0, -9.80665]
}

/// Most nodes, and most members.
pub const MOST: usize = 200_000;
/// Most modes.
pub const MOST_MODES: usize = 100;

/// Reads a frame; every index and length in it is then sound, every number finite and, where it must be, positive.
///
/// # Errors
/// What is wrong and where.
pub fn parse(source: &Source) -> Result<FrameFile, Diagnostic> {
    let file: FrameFile = serde_json::from_str(&source.text).map_err(|error| {
        let line = source.text.split_inclusive('\n').take(error.line().saturating_sub(1));
        let start = line.map(str::len).sum::<usize>() + error.column().saturating_sub(1);
        let start = (0..=start.min(source.text.len())).rev().find(|&at| source.text.is_char_boundary(at));
        let start = start.unwrap_or(0);
        let words = error.to_string();
        let words = words.split(" at line ").next().unwrap_or("unreadable").to_owned();
        Diagnostic::error(Span { start, end: start }, words).hint(
            "a frame has nodes [n][3], members [m][2], radius [m], fixed [node…], E, G, density; see `twin solve --help`",
        )
    })?;
    check(&file).map_err(|(key, message)| {
        let at = source.text.find(&format!("\"{key}\"")).unwrap_or(0);
        Diagnostic::error(Span { start: at, end: at + key.len() + 2 }, message)
    })?;
    Ok(file)
}

/// The key that is wrong, and how.
type Wrong = (&'static str, String);

fn check(file: &FrameFile) -> Result<(), Wrong> {
    let (n_nodes, n_members) = (file.nodes.len(), file.members.len());
    for (key, n) in [("nodes", n_nodes), ("members", n_members)] {
        if n > MOST {
            return Err((key, format!("{n} {key}; at most {MOST} are taken")));
        }
    }
    let node = |key, nodes: &[usize]| {
        let wrong = nodes.iter().find(|&&node| node >= n_nodes);
        wrong.map_or(Ok(()), |node| {
            Err((key, format!("there is no node {node}: {n_nodes} are given, counted from 0")))
        })
    };
    node("members", file.members.as_flattened())?;
    node("fixed", &file.fixed)?;
    let loaded: Vec<usize> = file.nodal_loads.iter().map(|load| load.node).collect();
    node("nodal_loads", &loaded)?;
    let per_member = |key, values: &[f64], may_miss: bool| {
        let right = values.len() == n_members || (may_miss && values.is_empty());
        let message = || format!("{} numbers for {n_members} members", values.len());
        if right { Ok(()) } else { Err((key, message())) }
    };
    per_member("radius", &file.radius, false)?;
    per_member("initial_strain", &file.initial_strain, true)?;
    per_member("stiffness_factor", &file.stiffness_factor, true)?;
    let positive = |key, values: &[f64]| {
        let wrong = values.iter().find(|value| !(value.is_finite() && **value > 0.0));
        wrong.map_or(Ok(()), |value| Err((key, format!("{value} must be more than zero"))))
    };
    positive("radius", &file.radius)?;
    positive("stiffness_factor", &file.stiffness_factor)?;
    positive("E", &[file.e_mpa])?;
    positive("G", &[file.g_mpa])?;
    if !(file.density.is_finite() && file.density >= 0.0) {
        return Err(("density", format!("{} must be zero or more", file.density)));
    }
    order(file, n_members)?;
    buckling(file)
}

fn order(file: &FrameFile, n_members: usize) -> Result<(), Wrong> {
    let mut seen = vec![false; n_members];
    for &member in &file.sequence {
        let Some(seen) = seen.get_mut(member) else {
            return Err((
                "sequence",
                format!("there is no member {member}: {n_members} are given"),
            ));
        };
        if std::mem::replace(seen, true) {
            return Err(("sequence", format!("member {member} comes twice")));
        }
    }
    Ok(())
}

fn buckling(file: &FrameFile) -> Result<(), Wrong> {
    let FrameBuckling { elements_per_member, modes } = file.buckling;
    if elements_per_member.is_some_and(|n| !(1..=64).contains(&n)) {
        return Err(("elements_per_member", "from 1 to 64 elements per member".to_owned()));
    }
    if modes.is_some_and(|n| !(1..=MOST_MODES).contains(&n)) {
        return Err(("modes", format!("from 1 to {MOST_MODES} modes")));
    }
    Ok(())
}
