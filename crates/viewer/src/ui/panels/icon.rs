//! Icons for kinds of objects, painted because fonts lack them; and accessible names of widgets.

use crate::model::objects::Id;
use crate::model::swatch::Swatch;
use eframe::egui::{self, Color32, Pos2, Rect, Shape, Stroke, vec2};
use glam::Vec3;
use glimray_scene::{CanonicalShape, Geometry, LightKind, ObjectRef, Scene};

/// Sets the accessible name of a widget without text.
pub fn named(response: &egui::Response, name: &str) {
    let _ = (response.ctx).accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// The outline of a colour swatch, visible on the panel whatever the colour.
pub fn edge(visuals: &egui::Visuals) -> Color32 {
    visuals.weak_text_color()
}

/// A linear colour for the screen, clamped to white.
pub fn on_screen(color: Vec3) -> Color32 {
    let [r, g, b] = color.to_array().map(|c| c.clamp(0.0, 1.0));
    egui::Rgba::from_rgb(r, g, b).into()
}

/// Draws the icon of something, in its own colour.
pub fn draw(ui: &egui::Ui, rect: Rect, scene: &Scene, id: Id, visible: bool) {
    let rect = Rect::from_center_size(rect.center(), vec2(11.0, 11.0));
    let line = match visible {
        true => ui.visuals().text_color(),
        false => ui.visuals().weak_text_color(),
    };
    let stroke = Stroke::new(1.0, line);
    let swatch = own_swatch(scene, id);
    let fill = swatch.map_or(Color32::TRANSPARENT, |swatch| {
        // The panel shows through what is clear.
        let share = if swatch.is_clear { 0.35 } else { 1.0 };
        let share = if visible { share } else { share * 0.4 };
        on_screen(swatch.color).gamma_multiply(share)
    });
    let painter = ui.painter();
    let (center, radius) = (rect.center(), rect.width() / 2.0);
    let polygon = |points: &[(f32, f32)]| {
        let at = |&(x, y): &(f32, f32)| center + vec2(x, y) * radius;
        let points: Vec<Pos2> = points.iter().map(at).collect();
        painter.add(Shape::convex_polygon(points, fill, stroke));
    };
    match id {
        Id::Object(ObjectRef::Shape(index)) => match scene.shapes.get(index).map(|s| s.geometry) {
            Some(Geometry::Plane { .. })
            | Some(Geometry::Placed {
                canonical: CanonicalShape::Rectangle | CanonicalShape::Disc { .. },
                ..
            }) => polygon(&[(-1.0, 0.5), (-0.3, -0.5), (1.0, -0.5), (0.3, 0.5)]),
            Some(Geometry::Placed {
                canonical: CanonicalShape::Box,
                ..
            }) => {
                polygon(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]);
            }
            Some(Geometry::Placed {
                canonical: CanonicalShape::Cone { .. },
                ..
            }) => polygon(&[(-0.5, -0.9), (0.5, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            Some(Geometry::Placed {
                canonical: CanonicalShape::Torus { .. },
                ..
            }) => {
                painter.circle(center, radius, fill, stroke);
                painter.circle(center, radius * 0.4, ui.visuals().panel_fill, stroke);
            }
            _ => _ = painter.circle(center, radius, fill, stroke),
        },
        Id::Object(ObjectRef::Instance(_)) => polygon(&[(0.0, -1.0), (1.0, 0.8), (-1.0, 0.8)]),
        Id::Object(ObjectRef::Light(index)) => {
            let kind = scene.lights.get(index).map(|light| light.kind);
            for i in 0..8 {
                let way = egui::Vec2::angled(std::f32::consts::TAU * i as f32 / 8.0);
                painter.line_segment([center + way * 3.5, center + way * 6.0], stroke);
            }
            let _ = match kind {
                Some(LightKind::Rectangle { .. }) => {
                    let inner = Rect::from_center_size(center, vec2(6.0, 6.0));
                    painter.rect(inner, 0.0, fill, stroke, egui::StrokeKind::Middle)
                }
                _ => painter.circle(center, 3.0, fill, stroke),
            };
        }
        Id::Node(_) => {
            painter.line_segment(
                [center + vec2(-3.0, -5.0), center + vec2(-3.0, 4.0)],
                stroke,
            );
            painter.line_segment([center + vec2(-3.0, 4.0), center + vec2(6.0, 4.0)], stroke);
            painter.line_segment([center + vec2(-3.0, 4.0), center + vec2(3.0, -1.0)], stroke);
        }
        Id::Camera(_) => {
            let body = Rect::from_center_size(center - vec2(1.5, 0.0), vec2(8.0, 7.0));
            painter.rect_stroke(body, 1.0, stroke, egui::StrokeKind::Middle);
            polygon(&[(0.45, 0.0), (1.1, -0.6), (1.1, 0.6)]);
        }
        Id::Material(_) => {
            let inner = Rect::from_center_size(center, vec2(10.0, 10.0));
            painter.rect(inner, 2.0, fill, stroke, egui::StrokeKind::Middle);
        }
    }
    if visible && swatch.is_some_and(|swatch| swatch.is_glossy) {
        let highlight = Color32::from_white_alpha(200);
        painter.circle_filled(center - vec2(1.5, 1.0), 1.4, highlight);
    }
}

/// The swatch of an object's material, or of a light's colour; `None` for anything else.
fn own_swatch(scene: &Scene, id: Id) -> Option<Swatch> {
    let of_material = |index: usize| Some(Swatch::of(scene.materials.get(index)?));
    match id {
        Id::Material(index) => of_material(index),
        Id::Object(ObjectRef::Shape(index)) => of_material(scene.shapes.get(index)?.material),
        Id::Object(ObjectRef::Instance(index)) => {
            let mesh = &scene.meshes[scene.instances.get(index)?.mesh];
            of_material(*mesh.materials.first()? as usize)
        }
        Id::Object(ObjectRef::Light(index)) => {
            let color = scene.lights.get(index)?.color;
            Some(Swatch {
                color: color / color.max_element().max(1e-6),
                is_glossy: false,
                is_clear: false,
            })
        }
        _ => None,
    }
}

/// The visibility toggle: an open or a closed eye.
pub fn eye(ui: &mut egui::Ui, rect: Rect, is_open: bool) -> egui::Response {
    let id = ui.scope_id().with("visible");
    let response = ui.interact(rect.expand(2.0), id, egui::Sense::click());
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Switch, true, is_open, ""));
    let visuals = ui.style().interact(&response);
    let color = match is_open {
        true => visuals.fg_stroke.color,
        false => ui.visuals().weak_text_color(),
    };
    let stroke = Stroke::new(1.2, color);
    let painter = ui.painter();
    let (center, width) = (rect.center(), 6.5);
    let arc = |bend: f32| {
        let point = |i: i32| {
            let x = i as f32 / 6.0;
            center + vec2(x * width, bend * (1.0 - x * x) * 4.0)
        };
        Shape::line((-6..=6).map(point).collect(), stroke)
    };
    painter.add(arc(1.0));
    if is_open {
        painter.add(arc(-1.0));
        painter.circle_filled(center, 2.0, color);
    }
    if response.has_focus() {
        let focus = ui.visuals().selection.stroke;
        painter.rect_stroke(rect.expand(2.0), 2.0, focus, egui::StrokeKind::Outside);
    }
    response
}
