//! Rays as lines, in the ray view and over the picture.

use crate::actions::inspector::outside;
use crate::actions::inspector::outside::{End, Line};
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::panels::rays::paint::colour;
use eframe::egui::{self, Color32, Pos2, Shape, Stroke, vec2};

/// Draws the inspected rays over the picture at `viewport`, as its current camera sees them. After the camera has moved, they are still at their place in the scene.
pub fn path(painter: &egui::Painter, session: &Session, viewport: Viewport) {
    if !session.preferences.overlays.rays {
        return;
    }
    let lines = outside::path(session, viewport.extent());
    let clip = viewport.rect.intersect(painter.clip_rect());
    draw(
        &painter.with_clip_rect(clip),
        session,
        &lines,
        viewport,
        false,
    );
}

/// Draws lines at `viewport`, the highlighted ray last.
pub fn draw(
    painter: &egui::Painter,
    session: &Session,
    lines: &[Line],
    viewport: Viewport,
    has_normals: bool,
) {
    let highlighted = session.inspector.highlighted();
    let is_highlighted = |line: &&Line| Some(line.id) == highlighted;
    for line in lines.iter().filter(|line| !is_highlighted(line)) {
        draw_line(painter, line, viewport, false, has_normals);
    }
    for line in lines.iter().filter(is_highlighted) {
        draw_line(painter, line, viewport, true, true);
    }
}

fn draw_line(
    painter: &egui::Painter,
    line: &Line,
    viewport: Viewport,
    is_highlighted: bool,
    has_normal: bool,
) {
    let ink = colour(line.kind, line.blocked, true);
    let [from, to] = [line.from, line.to].map(|end| viewport.point(end));
    let width = if is_highlighted { 3.0 } else { 1.6 };
    let stroke = Stroke::new(width, ink);
    let under = match is_highlighted {
        true => Stroke::new(width + 3.0, Color32::WHITE),
        false => Stroke::new(width + 1.6, Color32::from_black_alpha(110)),
    };
    for piece in &line.pieces {
        let ends = [piece.from, piece.to].map(|end| viewport.point(end));
        for stroke in [under, stroke] {
            let stroke = Stroke::new(stroke.width, stroke.color.gamma_multiply(piece.strength));
            match line.blocked {
                true => painter.extend(Shape::dashed_line(&ends, stroke, 6.0, 4.0)),
                false => _ = painter.line_segment(ends, stroke),
            }
        }
    }
    arrow(painter, from, to, ink, width);
    match line.end {
        End::Surface => _ = painter.circle(to, width + 0.8, ink, Stroke::new(1.0, Color32::BLACK)),
        End::Light => _ = painter.circle_stroke(to, width + 2.0, stroke),
        End::Nowhere | End::Cut => {}
    }
    if let Some(tip) = line.normal.filter(|_| has_normal) {
        let tip = viewport.point(tip);
        painter.line_segment([to, tip], Stroke::new(3.0, Color32::from_black_alpha(120)));
        painter.line_segment(
            [to, tip],
            Stroke::new(1.2, Color32::from_rgb(110, 230, 130)),
        );
    }
}

/// An arrow head in the middle of a line, if there is space.
fn arrow(painter: &egui::Painter, from: Pos2, to: Pos2, ink: Color32, width: f32) {
    let way = to - from;
    if way.length() < 18.0 {
        return;
    }
    let ahead = way.normalized() * (2.5 + 1.5 * width);
    let aside = vec2(-ahead.y, ahead.x) * 0.6;
    let tip = from + way * 0.55 + ahead;
    let points = vec![tip, tip - ahead * 1.8 + aside, tip - ahead * 1.8 - aside];
    painter.add(Shape::convex_polygon(points, ink, Stroke::NONE));
}
