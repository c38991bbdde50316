//! The checkerboard behind transparent pictures.

use eframe::egui::{Color32, Mesh, Painter, Rect, Vec2};

/// The side of a square, in points.
const SIDE: f32 = 8.0;

/// The squares' two greys.
const GREYS: [Color32; 2] = [Color32::from_gray(102), Color32::from_gray(153)];

/// Fills `rect` with a checkerboard that starts at its corner.
pub fn checker(painter: &Painter, rect: Rect) {
    if !rect.is_positive() {
        return;
    }
    painter.rect_filled(rect, 0.0, GREYS[0]);
    let mut mesh = Mesh::default();
    let count = |length: f32| (length / SIDE).ceil() as u32;
    for row in 0..count(rect.height()) {
        for column in (row % 2..count(rect.width())).step_by(2) {
            let corner = rect.min + SIDE * Vec2::new(column as f32, row as f32);
            let square = Rect::from_min_size(corner, Vec2::splat(SIDE));
            mesh.add_colored_rect(square.intersect(rect), GREYS[1]);
        }
    }
    painter.add(mesh);
}
