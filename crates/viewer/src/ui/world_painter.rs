//! Lines and text over the picture, at places in world space.

use crate::model::handles::Eye;
use crate::model::viewport::Viewport;
use eframe::egui::{self, Align2, Color32, FontId, Painter, Pos2, Stroke};
use glam::DVec3;

/// The dark border of lines, which keeps them visible on a bright picture.
pub const SHADE: Color32 = Color32::from_black_alpha(110);

/// Draws into a picture of the scene.
pub struct WorldPainter<'a> {
    /// The painter of the picture.
    pub painter: &'a Painter,
    /// The place of the picture on the screen.
    pub viewport: Viewport,
    /// The camera of the picture.
    pub eye: Eye<'a>,
}

impl WorldPainter<'_> {
    /// Draws lines in world space.
    pub fn lines(&self, lines: &[[DVec3; 2]], color: Color32) {
        for ends in lines {
            if let Some(ends) = self.segment(*ends) {
                self.painter.line_segment(ends, Stroke::new(3.0, SHADE));
                self.painter.line_segment(ends, Stroke::new(1.5, color));
            }
        }
    }

    /// Projects a line, clipped at the camera; `None` behind it or far outside.
    pub fn segment(&self, [a, b]: [DVec3; 2]) -> Option<[Pos2; 2]> {
        let (depth_a, depth_b) = (self.eye.depth(a), self.eye.depth(b));
        let near = 1e-3 * depth_a.abs().max(depth_b.abs());
        if depth_a.max(depth_b) <= near {
            return None;
        }
        let cut = |from: DVec3, to: DVec3, depth: f64, other: f64| match depth < near {
            true => from.lerp(to, (near - depth) / (other - depth)),
            false => from,
        };
        let ends = [cut(a, b, depth_a, depth_b), cut(b, a, depth_b, depth_a)];
        let [a, b] = ends.map(|end| self.eye.project(end));
        let ends = [a?, b?].map(|at| self.viewport.point(at));
        // Points far outside would lose their direction in single precision.
        ends.iter()
            .all(|p| p.to_vec2().length() < 1e6)
            .then_some(ends)
    }

    /// Draws text with its lower left corner at a point of the screen.
    pub fn text(&self, at: Pos2, text: &str) {
        let font = FontId::proportional(14.0);
        let galley = (self.painter).layout_no_wrap(text.to_owned(), font, Color32::WHITE);
        let rect = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        let back = Color32::from_black_alpha(190);
        self.painter
            .rect_filled(rect.expand2(egui::vec2(6.0, 3.0)), 4.0, back);
        self.painter.galley(rect.min, galley, Color32::WHITE);
    }
}
