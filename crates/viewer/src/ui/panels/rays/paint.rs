//! Icons, colours and swatches of rays.

use crate::state::inspector::rows::RayId;
use crate::ui::panels::icon;
use eframe::egui::{self, Color32, Rect, Response, Rgba, Sense, Shape, Stroke, StrokeKind, vec2};
use glam::DVec3;
use glimray_app::ray_text::{color, kind};
use glimray_render::RayKind;

/// The colour of a ray on a dark or light background.
pub fn colour(kind: RayKind, blocked: bool, is_dark: bool) -> Color32 {
    let [dark, light] = match kind {
        RayKind::Shadow if blocked => [(255, 96, 92), (180, 28, 28)],
        RayKind::Shadow => [(255, 226, 84), (136, 106, 0)],
        RayKind::Primary => [(240, 240, 240), (48, 48, 48)],
        RayKind::Reflection => [(255, 160, 56), (178, 88, 0)],
        RayKind::Refraction => [(84, 190, 255), (0, 104, 178)],
        RayKind::Passage => [(186, 150, 255), (104, 60, 190)],
    };
    let (red, green, blue) = if is_dark { dark } else { light };
    Color32::from_rgb(red, green, blue)
}

/// The screen colour of linear radiance at an exposure in stops.
fn display(linear: [f32; 3], exposure_ev: f32) -> Color32 {
    let factor = exposure_ev.exp2();
    let [red, green, blue] = linear.map(|value| (value * factor).clamp(0.0, 1.0));
    Rgba::from_rgb(red, green, blue).into()
}

/// A colour swatch.
pub fn swatch(ui: &mut egui::Ui, linear: [f32; 3], exposure_ev: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
    let edge = Stroke::new(1.0, icon::edge(ui.visuals()));
    ui.painter().rect(
        rect.shrink(1.0),
        2.0,
        display(linear, exposure_ev),
        edge,
        StrokeKind::Inside,
    );
    response
}

/// The contribution of a bounce above the sum up to it. A click limits the filter to it.
pub fn bounce(
    ui: &mut egui::Ui,
    (bounce, added, sum): (usize, DVec3, DVec3),
    shown: bool,
    exposure_ev: f32,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(22.0, 24.0), Sense::click());
    let (above, below) = rect.shrink(1.0).split_top_bottom_at_fraction(0.5);
    let [added, sum] = [added, sum].map(|value| value.as_vec3().into());
    let painter = ui.painter();
    painter.rect_filled(above, 0.0, display(added, exposure_ev));
    painter.rect_filled(below, 0.0, display(sum, exposure_ev));
    let edge = match (response.hovered() || response.has_focus(), shown) {
        (true, _) => ui.visuals().widgets.hovered.fg_stroke,
        (false, true) => Stroke::new(1.0, ui.visuals().selection.bg_fill),
        (false, false) => Stroke::new(1.0, icon::edge(ui.visuals())),
    };
    painter.rect_stroke(rect, 2.0, edge, StrokeKind::Inside);
    let name = format!("Bounce {bounce}");
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, shown, &name));
    response.on_hover_text(format!(
        "{name}: contribution {}, sum up to it {} (linear radiance)",
        color(added),
        color(sum)
    ))
}

/// The button that collapses or expands a ray.
pub fn fold(ui: &mut egui::Ui, is_folded: bool, id: RayId, width: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, width), Sense::click());
    let style = ui.style().interact(&response);
    let center = rect.center();
    let points = match is_folded {
        true => [vec2(-2.5, -4.0), vec2(3.5, 0.0), vec2(-2.5, 4.0)],
        false => [vec2(-4.0, -2.5), vec2(4.0, -2.5), vec2(0.0, 3.5)],
    };
    let points = points.map(|off| center + off).to_vec();
    let ink = style.fg_stroke.color;
    (ui.painter()).add(Shape::convex_polygon(points, ink, Stroke::NONE));
    if response.has_focus() {
        let focus = ui.visuals().selection.stroke;
        (ui.painter()).rect_stroke(rect, 2.0, focus, StrokeKind::Inside);
    }
    let verb = if is_folded { "Expand" } else { "Collapse" };
    let name = match id {
        (0, ray) => format!("{verb} ray {ray}"),
        (sample, ray) => format!("{verb} ray {ray} of sample {sample}"),
    };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    response
}

/// The icon of a ray: a disc for camera rays, an angle for reflection, a bend for refraction, a line for what goes
/// straight on, a ring for unblocked and a cross for blocked shadow rays.
pub fn icon(ui: &mut egui::Ui, ray: RayKind, blocked: bool) {
    let (rect, response) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
    let stroke = Stroke::new(1.8, colour(ray, blocked, ui.visuals().dark_mode));
    sign(ui.painter(), rect, ray, blocked, stroke);
    response.on_hover_text(match (ray, blocked) {
        (RayKind::Shadow, true) => "blocked shadow ray",
        (RayKind::Shadow, false) => "unblocked shadow ray",
        _ => kind(ray),
    });
}

fn sign(painter: &egui::Painter, rect: Rect, ray: RayKind, blocked: bool, stroke: Stroke) {
    let center = rect.center();
    let at = |x: f32, y: f32| center + vec2(x, y);
    match ray {
        RayKind::Primary => _ = painter.circle_filled(center, 4.0, stroke.color),
        RayKind::Reflection => {
            _ = painter.line(vec![at(-5.0, -4.0), at(0.0, 4.0), at(5.0, -4.0)], stroke)
        }
        RayKind::Refraction => {
            _ = painter.line(vec![at(-5.0, -4.0), at(0.0, -0.5), at(1.5, 5.0)], stroke)
        }
        RayKind::Passage => _ = painter.line(vec![at(-5.0, -5.0), at(5.0, 5.0)], stroke),
        RayKind::Shadow if blocked => {
            painter.line_segment([at(-3.5, -3.5), at(3.5, 3.5)], stroke);
            painter.line_segment([at(-3.5, 3.5), at(3.5, -3.5)], stroke);
        }
        RayKind::Shadow => _ = painter.circle_stroke(center, 3.5, stroke),
    }
}
