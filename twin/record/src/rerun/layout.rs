//! How the viewer lays the recording out at first.

use super::cell::body_paths;
use super::plots::{Plot, plot_of};
use super::tape::TIMELINE;
use crate::paint;
use rerun::blueprint::components::{BackgroundKind, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Spatial2DView,
    Spatial3DView, StateTimelineView, Tabs, TextDocumentView, TextLogView, TimePanel,
    TimeSeriesView, Vertical,
};
use rerun::datatypes::{TimeInt, TimeRange, TimeRangeBoundary};
use rerun::external::re_sdk_types::blueprint::archetypes::{Background, EyeControls3D, TimeAxis};
use rerun::{AsComponents, EntityPath};
use sim::film::{Film, Trace};
use sim::pose::Vector;
use sim::scene::{BodyKind, Bounds};

/// Behind the part: the dark end of the colours would be lost on the viewer's own dark ground.
const GROUND: [u8; 3] = [0xE4, 0xE8, 0xEC];
/// From the part to the eye, part axes, and how far in diagonals of the part.
const TO_EYE: [f64; 3] = [0.55, -0.75, 0.4];
const EYE_FAR: f64 = 1.15;

/// The layout, and what the library's own layout has no words for: properties of views by their paths.
pub(super) struct Layout {
    /// Containers, views, panels.
    pub(super) blueprint: Blueprint,
    /// Properties to be added.
    pub(super) more: Vec<(EntityPath, Box<dyn AsComponents>)>,
}

/// The part and the cell to the left, states beneath; plots, findings and report to the right.
pub(super) fn layout(film: &Film, traces: &[Trace], has_pictures: bool) -> Layout {
    let (part, cell) = (part_view(film), cell_view());
    let mut more: Vec<(EntityPath, Box<dyn AsComponents>)> = Vec::new();
    for view in [&part, &cell] {
        let ground = Background::new(BackgroundKind::SolidColor).with_color(GROUND);
        more.extend(property(view, "Background", Box::new(ground)));
    }
    more.extend(eye(film).and_then(|eye| property(&part, "EyeControls3D", Box::new(eye))));
    let plots = plot_tabs(film, traces, &mut more);
    let blueprint = blueprint([part, cell], plots, has_pictures);
    Layout { blueprint, more }
}

fn property(
    view: &ContainerLike,
    name: &str,
    what: Box<dyn AsComponents>,
) -> Option<(EntityPath, Box<dyn AsComponents>)> {
    match view {
        ContainerLike::View(view) => {
            Some((view.blueprint_path().join(&super::tape::path([name])), what))
        }
        _ => None,
    }
}

/// The whole part in view, from the front and above.
fn eye(film: &Film) -> Option<EyeControls3D> {
    let bounds = Bounds::of(film.strands.iter().flat_map(|strand| &strand.points).copied())?;
    let far_m = EYE_FAR * bounds.size().norm().max(1e-3);
    let at = bounds.centre() + Vector::from(TO_EYE).normalize() * far_m;
    let target = bounds.centre();
    let eye = EyeControls3D::new()
        .with_position([at.x, at.y, at.z])
        .with_look_target([target.x, target.y, target.z])
        .with_eye_up([0.0, 0.0, 1.0]);
    Some(eye)
}

fn blueprint(
    spaces: [ContainerLike; 2],
    plots: Vec<ContainerLike>,
    has_pictures: bool,
) -> Blueprint {
    let seen: ContainerLike = Tabs::new(spaces).into();
    let state = StateTimelineView::new("What the arm does").with_origin("/state").into();
    let left = Vertical::new([seen, state]).with_row_shares(vec![5.0, 1.0]);
    let mut right = Vec::new();
    let mut shares = Vec::new();
    if !plots.is_empty() {
        right.push(Tabs::new(plots).into());
        shares.push(3.0);
    }
    right.push(Tabs::new(reading(has_pictures)).into());
    shares.push(2.0);
    let right = Vertical::new(right).with_row_shares(shares);
    let root = Horizontal::new([left.into(), right.into()]).with_column_shares(vec![3.0, 2.0]);
    Blueprint::new(root)
        .with_auto_layout(false)
        .with_auto_views(false)
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Collapsed))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Collapsed))
        .with_time_panel(
            TimePanel::new()
                .with_timeline(TIMELINE)
                .with_state(PanelState::Collapsed)
                .with_play_state(PlayState::Following),
        )
}

/// The part in its own axes, with the nozzle: the view's extent is the part's.
fn part_view(film: &Film) -> ContainerLike {
    let name = match film.painted.first() {
        Some(painted) => format!("Part: {}", paint::words(painted)),
        None => "Part".to_owned(),
    };
    let nozzles = film.bodies.iter().zip(body_paths(film));
    let nozzles = nozzles.filter(|(body, _)| body.kind == BodyKind::Nozzle);
    let contents = std::iter::once("+ /world/part/**".to_owned())
        .chain(nozzles.map(|(_, at)| format!("+ {at}")));
    Spatial3DView::new(name).with_origin("/world/part").with_contents(contents).into()
}

fn cell_view() -> ContainerLike {
    Spatial3DView::new("Cell").with_origin("/world").into()
}

/// A tab for each group of plots that there is anything in; each plot shows the whole program.
fn plot_tabs(
    film: &Film,
    traces: &[Trace],
    more: &mut Vec<(EntityPath, Box<dyn AsComponents>)>,
) -> Vec<ContainerLike> {
    let mut plots: Vec<Plot> = Vec::new();
    for trace in traces {
        let plot = plot_of(trace.of);
        if !plots.contains(&plot) {
            plots.push(plot);
        }
    }
    let end = TimeRangeBoundary::Absolute(TimeInt((film.total_s.clamp(1e-3, 1e8) * 1e9) as i64));
    let whole = TimeRange { start: TimeRangeBoundary::Absolute(TimeInt(0)), end };
    let tab = |name: &str| {
        let views: Vec<ContainerLike> = plots
            .iter()
            .filter(|plot| plot.tab == name)
            .map(|plot| {
                let origin = format!("/plots/{}", plot.name);
                let view = TimeSeriesView::new(plot.title).with_origin(origin).into();
                let axis = TimeAxis::new().with_view_range(whole);
                more.extend(property(&view, "TimeAxis", Box::new(axis)));
                view
            })
            .collect();
        (!views.is_empty()).then(|| Vertical::new(views).with_name(name).into())
    };
    ["Motion", "Process", "Structure"].into_iter().filter_map(tab).collect()
}

fn reading(has_pictures: bool) -> Vec<ContainerLike> {
    let mut tabs: Vec<ContainerLike> = vec![
        TextLogView::new("Findings").with_origin("/log/findings").into(),
        TextDocumentView::new("Report").with_origin("/report").into(),
        TextLogView::new("Strands").with_origin("/log/strands").into(),
    ];
    if has_pictures {
        tabs.push(Spatial2DView::new("Pictures").with_origin("/camera/overview").into());
    }
    tabs
}
