//! The outline of the selection along the pixels that show it.

use crate::actions::sight;
use crate::model::objects::Id;
use crate::state::session::Session;
use crate::state::sight::{Drawn, Silhouettes};
use crate::ui::world_lines::WorldLines;
use crate::ui::world_painter::{SHADE, WorldPainter};
use eframe::egui::{Color32, Pos2, Shape, Stroke};
use glam::DVec2;
use glimray_scene::ObjectRef;
use std::sync::Arc;

/// The colour of what was selected last, and of the others.
pub const LEAD: Color32 = Color32::from_rgb(255, 176, 56);
pub const OTHER: Color32 = Color32::from_rgb(224, 112, 8);
/// Width of an outline and of its dark border, in points.
const WIDTH: f32 = 2.0;
const BORDER: f32 = 3.5;
/// The most points of outlines that are drawn with all care.
const MOST_POINTS: usize = 6000;

/// Things to mark in another way.
pub struct Marks {
    /// Lamps, nodes and cameras, which are marked with lines whether they can be seen or not, and all that is selected while it
    /// is not known what the pixels show.
    pub firm: Vec<Id>,
    /// Selected objects without a visible pixel.
    pub faint: Vec<Id>,
}

/// Draws the outlines, and returns what else is to be marked.
pub fn draw(session: &mut Session, view: &WorldPainter, selected: &[Id]) -> Marks {
    let Some(known) = sight::silhouettes(session, selected) else {
        return Marks {
            firm: selected.to_vec(),
            faint: Vec::new(),
        };
    };
    view.painter.extend(shapes(session, view, &known));
    let is_marked =
        |id: &Id| !matches!(id, Id::Object(ObjectRef::Instance(_) | ObjectRef::Shape(_)));
    Marks {
        firm: selected.iter().copied().filter(is_marked).collect(),
        faint: (known.hidden.iter().copied())
            .filter(|id| !is_marked(id))
            .collect(),
    }
}

/// The outlines as they are drawn, which stay the same while the picture stays where it is.
fn shapes(session: &mut Session, view: &WorldPainter, known: &Arc<Silhouettes>) -> Vec<Shape> {
    let place = view.place();
    let is_same = |of: &Arc<Silhouettes>| Arc::ptr_eq(of, known);
    if let Some(shapes) = Drawn::at(&session.sight.outlined, place, is_same) {
        return shapes;
    }
    let parts = [(&known.others, OTHER), (&known.lead, LEAD)];
    let count: usize = parts.iter().map(|(lines, _)| lines.concat().len()).sum();
    let shapes = match count > MOST_POINTS {
        true => vec![many(view, parts)],
        false => parts
            .into_iter()
            .flat_map(|(lines, color)| few(view, lines, color))
            .collect(),
    };
    session.sight.outlined = Some(Drawn {
        place,
        of: known.clone(),
        shapes: shapes.clone(),
    });
    shapes
}

/// Lines with round joints and a dark border.
fn few(view: &WorldPainter, lines: &[Vec<DVec2>], color: Color32) -> Vec<Shape> {
    let lines: Vec<Vec<Pos2>> = lines.iter().map(|line| on_screen(view, line)).collect();
    let strokes = [Stroke::new(BORDER, SHADE), Stroke::new(WIDTH, color)];
    let shapes = strokes
        .into_iter()
        .flat_map(|stroke| lines.iter().map(move |line| shape(line, stroke)));
    shapes.collect()
}

/// Lines that cost little however many they are.
fn many(view: &WorldPainter, parts: [(&Vec<Vec<DVec2>>, Color32); 2]) -> Shape {
    let mut drawn = WorldLines::default();
    for (lines, color) in parts {
        for line in lines {
            for ends in on_screen(view, line).windows(2) {
                drawn.add_on_screen([ends[0], ends[1]], color);
            }
        }
    }
    drawn.shape()
}

fn on_screen(view: &WorldPainter, line: &[DVec2]) -> Vec<Pos2> {
    line.iter().map(|at| view.viewport.point(*at)).collect()
}

fn shape(line: &[Pos2], stroke: Stroke) -> Shape {
    match line.first() == line.last() {
        true => Shape::closed_line(line[..line.len().saturating_sub(1)].to_vec(), stroke),
        false => Shape::line(line.to_vec(), stroke),
    }
}
