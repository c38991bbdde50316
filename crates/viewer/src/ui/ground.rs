//! The grid on the ground, and the edges of meshes.

use crate::actions::sight;
use crate::model::grid::Grid;
use crate::model::handles::Eye;
use crate::model::snapping::grid_step;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::state::sight::{Drawn, Seen};
use crate::ui::overlay::COLORS;
use crate::ui::world_lines::WorldLines;
use crate::ui::world_painter::WorldPainter;
use eframe::egui::{Color32, Painter, Shape, vec2};
use std::sync::Arc;

/// The colours of lines and of edges.
const LINE: Color32 = Color32::from_gray(165);
const EDGE: Color32 = Color32::from_rgb(232, 226, 196);
/// How strong lines are, and those behind something.
const FULL: f64 = 0.75;
const HIDDEN: f64 = 0.06;

/// Draws both as far as they are shown.
pub fn draw(session: &mut Session, painter: &Painter, viewport: Viewport) {
    let Some(camera) = session.camera().filter(|_| session.shows_overlays) else {
        return;
    };
    let view = WorldPainter::new(painter, viewport, &camera);
    if session.preferences.overlays.grid
        && let Some(grid) = grid(session, &view)
    {
        painter.extend(ground(session, &view, grid));
    }
    if session.preferences.overlays.has_edges()
        && let Some(edges) = edges(session, &view)
    {
        painter.extend(edges);
    }
}

/// The grid in a view.
fn grid(session: &Session, view: &WorldPainter) -> Option<Grid> {
    let controller = session.controller.as_ref()?;
    let pivot = controller.pivot();
    let point = view.viewport.length(vec2(1.0, 0.0)).x;
    let length = view.eye.pixel_at(pivot).abs() * point;
    Grid::new(view.eye, controller.up_axis(), pivot, length)
}

fn ground(session: &mut Session, view: &WorldPainter, grid: Grid) -> Vec<Shape> {
    let (seen, place) = (sight::current(session), view.place());
    if let Some(seen) = &seen {
        let is_same = |of: &(Arc<Seen>, Grid)| Arc::ptr_eq(&of.0, seen) && of.1 == grid;
        if let Some(shapes) = Drawn::at(&session.sight.grid, place, is_same) {
            return shapes;
        }
    }
    let sight = seen.as_ref().map(|seen| &seen.sight);
    let mut lines = WorldLines::default();
    for line in &grid.lines {
        let color = line.axis.map_or(LINE, |axis| COLORS[axis]);
        lines.add(view, sight, line.ends, |point, is_seen| {
            let strength = line.strength * grid.fade(point);
            let share = if is_seen { FULL } else { HIDDEN };
            color.gamma_multiply((strength * share) as f32)
        });
    }
    let shapes = vec![lines.shape()];
    session.sight.grid = seen.map(|seen| Drawn {
        place,
        of: (seen, grid),
        shapes: shapes.clone(),
    });
    shapes
}

/// The edges that can be seen. While the camera moves it is not known which these are.
fn edges(session: &mut Session, view: &WorldPainter) -> Option<Vec<Shape>> {
    let (seen, place) = (sight::current(session)?, view.place());
    let is_same = |of: &Arc<Seen>| Arc::ptr_eq(of, &seen);
    let known = Drawn::at(&session.sight.edges, place, is_same);
    if known.is_some() {
        return known;
    }
    let mut lines = WorldLines::default();
    for ends in &seen.edges.lines {
        let ends = ends.map(|at| view.viewport.point(at));
        lines.add_on_screen(ends, EDGE);
    }
    let shapes = vec![lines.shape()];
    session.sight.edges = Some(Drawn {
        place,
        of: seen,
        shapes: shapes.clone(),
    });
    Some(shapes)
}

/// The distance of grid lines, for the status bar.
pub fn spacing(session: &Session, viewport: Viewport) -> Option<f64> {
    let camera = session.camera()?;
    let eye = Eye {
        camera: &camera,
        size: viewport.extent(),
    };
    let pivot = session.controller.as_ref()?.pivot();
    let point = viewport.length(vec2(1.0, 0.0)).x;
    Some(grid_step(eye.pixel_at(pivot).abs() * point))
}
