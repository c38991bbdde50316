//! Lines and text over the picture, at places in world space.

use crate::model::handles::Eye;
use crate::model::viewport::Viewport;
use eframe::egui::{self, Align2, Color32, FontId, Painter, Pos2, Rect, Stroke};
use glam::DVec3;
use glimray_scene::Camera;

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

impl<'a> WorldPainter<'a> {
    /// Draws into the picture that the camera sees.
    pub fn new(painter: &'a Painter, viewport: Viewport, camera: &'a Camera) -> Self {
        Self {
            painter,
            viewport,
            eye: Eye {
                camera,
                size: viewport.extent(),
            },
        }
    }

    /// Draws lines in world space.
    pub fn lines(&self, lines: &[[DVec3; 2]], color: Color32) {
        for ends in lines {
            if let Some(ends) = self.segment(*ends) {
                self.painter.line_segment(ends, Stroke::new(3.0, SHADE));
                self.painter.line_segment(ends, Stroke::new(1.5, color));
            }
        }
    }

    /// The parts of the screen that the picture takes, and that can be seen.
    pub fn place(&self) -> [Rect; 2] {
        [self.viewport.rect, self.painter.clip_rect()]
    }

    /// Draws lines in world space without a border.
    pub fn thin_lines(&self, lines: &[[DVec3; 2]], color: Color32) {
        for ends in lines {
            if let Some(ends) = self.segment(*ends) {
                self.painter.line_segment(ends, Stroke::new(1.0, color));
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

    /// Draws text with its lower left corner at a point of the screen, or beside it where the picture ends. Returns its place.
    pub fn text(&self, at: Pos2, text: &str) -> Rect {
        let font = FontId::proportional(14.0);
        let galley = (self.painter).layout_no_wrap(text.to_owned(), font, Color32::WHITE);
        let margin = egui::vec2(6.0, 3.0);
        let rect = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        let rect = inside(rect.expand2(margin), self.painter.clip_rect());
        let back = Color32::from_black_alpha(190);
        self.painter.rect_filled(rect, 4.0, back);
        self.painter
            .galley(rect.min + margin, galley, Color32::WHITE);
        rect
    }
}

/// The rectangle moved so that it lies in `space`, if it is not larger.
pub fn inside(rect: Rect, space: Rect) -> Rect {
    let over = (rect.max - space.max).max(egui::Vec2::ZERO);
    let rect = rect.translate(-over);
    rect.translate((space.min - rect.min).max(egui::Vec2::ZERO))
}
