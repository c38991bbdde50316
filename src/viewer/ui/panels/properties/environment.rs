//! The properties of the scene as a whole.

use crate::scene::{Background, Shadows};
use crate::viewer::state::session::Session;
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;

/// Background, ambient light, shadows and the camera.
pub fn show(fields: &mut Fields, session: &mut Session) {
    fields.note("Nothing is selected. Click an object in the picture or the outline.");
    fields.heading("Background");
    let background = fields.scene.background.clone();
    if session.view.background.is_some() {
        fields.note("The Render panel overrides the background.");
    }
    let kind = |background: &Background| match background {
        Background::Color(_) => 0,
        Background::Gradient { .. } => 1,
        Background::Picture { .. } => 2,
    };
    let now = kind(&background);
    let mut options = vec![(0, "Colour"), (1, "Gradient")];
    if now == 2 {
        options.push((2, "Picture"));
    }
    let tip = "What rays see when they hit no object.";
    fields.choice(("Kind", tip), now, &options, |scene, to| {
        let mean = match &scene.background {
            Background::Color(color) => (*color, *color),
            Background::Gradient { bottom, top } => (*bottom, *top),
            Background::Picture { .. } => (Vec3::splat(0.5), Vec3::splat(0.5)),
        };
        scene.background = match to {
            0 => Background::Color((mean.0 + mean.1) * 0.5),
            _ => Background::Gradient {
                bottom: mean.0,
                top: mean.1,
            },
        };
    });
    match background {
        Background::Color(color) => {
            fields.color(("Background", tip), color, |scene, to| {
                scene.background = Background::Color(to);
            });
        }
        Background::Gradient { bottom, top } => {
            fields.color(("Bottom", "Colour straight down."), bottom, |scene, to| {
                if let Background::Gradient { bottom, .. } = &mut scene.background {
                    *bottom = to;
                }
            });
            fields.color(("Top", "Colour straight up."), top, |scene, to| {
                if let Background::Gradient { top, .. } = &mut scene.background {
                    *top = to;
                }
            });
        }
        Background::Picture {
            strength, rotation, ..
        } => {
            let label = ("Strength", "Factor on the image, 0 or more.");
            fields.number(label, f64::from(strength), Limits::AMOUNT, |scene, to| {
                if let Background::Picture { strength, .. } = &mut scene.background {
                    *strength = to as f32;
                }
            });
            let tip = "Rotation about +Y in degrees, counter-clockwise from above.";
            let degrees = rotation.to_degrees();
            fields.number(("Rotation", tip), degrees, Limits::ANGLE, |scene, to| {
                if let Background::Picture { rotation, .. } = &mut scene.background {
                    *rotation = to.to_radians();
                }
            });
        }
    }
    fields.heading("Ambient light");
    let tip = "Radiance of the ambient term. Materials multiply it by their ambient colour.";
    fields.color(("Ambient", tip), fields.scene.ambient, |scene, to| {
        scene.ambient = to;
    });
    let options = [
        (Shadows::Opaque, "Opaque"),
        (Shadows::Filtered, "Coloured through glass"),
    ];
    let tip = "How shadow rays treat transparent objects.";
    let shadows = fields.scene.shadows;
    fields.choice(("Shadows", tip), shadows, &options, |scene, to| {
        scene.shadows = to;
    });
    fields.heading("Camera");
    let is_home = session
        .controller
        .as_ref()
        .is_none_or(|controller| controller.is_home());
    let tip = "Replace the scene's camera with the current view.";
    let button = eframe::egui::Button::new("Set scene camera from view");
    let button = fields.ui.add_enabled(!is_home, button).on_hover_text(tip);
    let button = button.on_disabled_hover_text("The view matches the scene's camera.");
    if button.clicked() {
        session.set_scene_camera();
    }
}
