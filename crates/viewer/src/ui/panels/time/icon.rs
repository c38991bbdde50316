//! Playback buttons, painted because the font lacks these icons.

use eframe::egui::{self, Color32, Painter, Pos2, Rect, Shape, Stroke, Ui, vec2};

/// The icon of a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    Play,
    Pause,
    Forward,
    Back,
    First,
    Last,
}

/// Height of the icons, in points.
const HEIGHT: f32 = 10.0;

/// A button with an icon. Returns whether it was clicked.
pub fn button(ui: &mut Ui, icon: Icon, name: &str, tip: &str) -> bool {
    let response = ui.add(egui::Button::new("").min_size(vec2(28.0, 20.0)));
    let is_enabled = ui.is_enabled();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_enabled, name));
    let color = ui.style().interact(&response).fg_stroke.color;
    draw(ui.painter(), icon, response.rect.center(), color);
    response.on_hover_text(tip).clicked()
}

fn draw(painter: &Painter, icon: Icon, center: Pos2, color: Color32) {
    let half = HEIGHT / 2.0;
    // `to` is 1 to the right, -1 to the left.
    let triangle = |x: f32, to: f32| {
        let corner = |dx: f32, dy: f32| center + vec2(x + to * dx, dy);
        let points = vec![corner(-4.0, -half), corner(4.5, 0.0), corner(-4.0, half)];
        painter.add(Shape::convex_polygon(points, color, Stroke::NONE));
    };
    let bar = |x: f32| {
        let rect = Rect::from_center_size(center + vec2(x, 0.0), vec2(2.5, HEIGHT));
        painter.rect_filled(rect, 0.5, color);
    };
    match icon {
        Icon::Play => triangle(0.0, 1.0),
        Icon::Pause => {
            bar(-3.0);
            bar(3.0);
        }
        Icon::Forward => {
            bar(-6.0);
            triangle(1.0, 1.0);
        }
        Icon::Back => {
            triangle(-1.0, -1.0);
            bar(6.0);
        }
        Icon::First => {
            bar(-6.0);
            triangle(0.0, -1.0);
        }
        Icon::Last => {
            triangle(0.0, 1.0);
            bar(6.0);
        }
    }
}
