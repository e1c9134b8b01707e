//! A frame of nodes and elements to a job of one strand per element.

use slam::Diagnostic;
use slam::Source;
use slam::document::{End, Follow, Join, On, Strand};

use crate::document::{document, strand, unplaced};
use crate::frame::{Frame, read};
use crate::order::{Directed, bottom_up, given};
use crate::placement::place;
use crate::{Bed, Input, Options, Planned, Remark, any_error, remarks};

/// A job from a frame file of the `assembly_instances` family, one strand `e<index>` per element.
///
/// The frame's graph decides the joints: an end at a grounded node is joined to the bed, one at a
/// node that is printed already to the first strand printed there, any other end is free. The order
/// is the given one, or bottom-up. Axes and place are those of `base_frame_in_rob_base`, moved along the bed's normal until
/// the lowest grounded node lies on the bed; the bead is the file's `cross_sec_area` as a circle,
/// else the options', else the cell's. The nozzle points straight down.
///
/// # Errors
///
/// Everything that is wrong with the frame, or with the order if the frame is sound.
pub fn wireframe(
    source: &Source,
    order: Option<&Source>,
    options: &Options,
) -> Result<Planned, Vec<Remark>> {
    let mut on_design = Vec::new();
    let Some(frame) = read(source, &mut on_design) else {
        return Err(remarks(Input::Design, on_design));
    };
    let placed = place(&frame, options.bed);
    if options.bed == Bed::OnFlange {
        on_design.push(
            Diagnostic::warning(
                slam::Span::default(),
                "the cell's bed moves, so the place in the robot's base is left out",
            )
            .hint("the grounded nodes are centred on the bed; edit `placement` to move the part"),
        );
    }
    let diameter_mm = diameter_mm(&frame, options, &mut on_design);

    let mut on_order = Vec::new();
    let directed = order.and_then(|order| given(order, &options.file_stem, &frame, &mut on_order));
    if any_error(&on_order) {
        let mut all = remarks(Input::Design, on_design);
        all.extend(remarks(Input::Order, on_order));
        return Err(all);
    }
    let directed =
        directed.unwrap_or_else(|| bottom_up(&frame, &placed.heights_mm, &mut on_design));
    let strands = strands(&frame, &directed, &placed.heights_mm, diameter_mm);
    let document =
        document(options, placed.placement, diameter_mm, Some(Follow::Vertical), strands);
    let mut remarks_of_both = remarks(Input::Design, on_design);
    remarks_of_both.extend(remarks(Input::Order, on_order));
    Ok(Planned { document, remarks: remarks_of_both })
}

/// The file's bead before the asked one; a word where they differ.
pub(crate) fn diameter_mm(
    frame: &Frame,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<f64> {
    if let (Some(of_file), Some(asked)) = (frame.diameter_mm, options.diameter_mm)
        && (of_file - asked).abs() > 1e-6
    {
        let message = format!(
            "the file's `cross_sec_area` means a bead of {of_file} mm, not {asked} mm; the file counts"
        );
        diagnostics.push(Diagnostic::warning(slam::Span::default(), message));
    }
    frame.diameter_mm.or(options.diameter_mm)
}

pub(crate) fn strands(
    frame: &Frame,
    order: &[Directed],
    heights_mm: &[f64],
    diameter_mm: Option<f64>,
) -> Vec<Strand> {
    let mut first_at: Vec<Option<usize>> = vec![None; frame.nodes.len()];
    let lies_mm = diameter_mm.map_or(crate::SAME_POINT_MM, |diameter| diameter / 2.0);
    let lies = |node: usize| frame.nodes[node].grounded && heights_mm[node] <= lies_mm;
    let mut strands = Vec::with_capacity(order.len());
    for directed in order {
        let ends = [directed.from, directed.to];
        let points = ends.map(|node| unplaced(frame.nodes[node].point_mm.into()));
        let [start, end] = ends.map(|node| joined(frame.nodes[node].grounded, first_at[node]));
        let on = ends.into_iter().all(lies).then(|| unplaced(On::Bed));
        strands.push(Strand { on, start, end, ..strand(name(directed.element), points.into()) });
        for node in ends {
            first_at[node].get_or_insert(directed.element);
        }
    }
    strands
}

fn joined(grounded: bool, first: Option<usize>) -> End {
    let join = match first {
        _ if grounded => Join::Bed,
        Some(element) => Join::Id(name(element)),
        None => Join::Free,
    };
    End { join: Some(unplaced(join)), dwell_s: None }
}

fn name(element: usize) -> String {
    format!("e{element}")
}
