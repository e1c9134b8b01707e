//! What can be drawn: one closed list for callers and for the process that draws.

use crate::closeup::close_up;
use crate::overlay;
use crate::view::View;
use crate::{Engine, Picture, RenderError, check_size, row, sheet};
use sim::scene::{Row, Scene};

/// A picture that is wanted.
#[derive(Debug, Clone)]
pub enum Task {
    /// The whole cell and beside it the part, with one legend.
    Sheet {
        /// What there is to see.
        scene: Box<Scene>,
        /// Width and height, px.
        size_px: (u32, u32),
    },
    /// Several moments of one thing.
    Row {
        /// The moments.
        row: Box<Row>,
        /// Width and height, px.
        size_px: (u32, u32),
    },
    /// One view.
    View {
        /// What there is to see.
        scene: Box<Scene>,
        /// From where.
        view: View,
    },
    /// The first mark from near by, with what is highlighted named.
    CloseUp {
        /// What there is to see.
        scene: Box<Scene>,
        /// Width and height, px.
        size_px: (u32, u32),
    },
}

impl Task {
    fn size_px(&self) -> (u32, u32) {
        match self {
            Task::Sheet { size_px, .. }
            | Task::Row { size_px, .. }
            | Task::CloseUp { size_px, .. } => *size_px,
            Task::View { view, .. } => view.size_px,
        }
    }

    /// Draws it with an opened machine.
    pub(crate) fn with(&self, engine: &Engine) -> Result<Picture, RenderError> {
        check_size(self.size_px())?;
        match self {
            Task::Sheet { scene, size_px } => sheet::compose(scene, *size_px, engine),
            Task::Row { row, size_px } => row::compose(row, *size_px, engine),
            Task::View { scene, view } => overlay::picture(scene, view, engine),
            Task::CloseUp { scene, size_px } => close_up(scene, *size_px, engine),
        }
    }
}
