//! The properties of the scene as a whole.

use crate::model::bindings::Action;
use crate::model::environment::BackgroundLight;
use crate::state::session::Session;
use crate::ui::panels::properties::fields::{Fields, Limits};
use crate::ui::panels::properties::section;
use crate::ui::panels::render;
use crate::ui::panels::row::row;
use crate::ui::sun_dial::SunDial;
use eframe::egui::{self, Sense, Ui, WidgetInfo, vec2};
use glam::Vec3;
use glimray_scene::{Background, BuiltIn, Origin, Scene, Shadows};

/// Radius of the map of the sky, in points.
const DIAL: f32 = 40.0;

/// Background, ambient light, shadows and the camera.
pub fn show(fields: &mut Fields, session: &mut Session) {
    fields.note("Nothing is selected. Click an object in the picture or the outline.");
    fields.heading("Background");
    let background = fields.scene.background.clone();
    if session.view.background.is_some() {
        fields.note("Another background is shown for now.");
        fields.draw(|ui, _| {
            let button = ui.button("Show the scene's background");
            if button.on_hover_text("Ends “Next background”").clicked() {
                session.view.background = None;
            }
        });
    }
    let tip = "What rays see when they hit no object.";
    let now = Kind::of(fields.scene);
    let mut options = vec![(Kind::Color, "Colour"), (Kind::Gradient, "Gradient")];
    let built_in = BuiltIn::ALL.iter();
    options.extend(built_in.map(|it| (Kind::BuiltIn(*it), it.entry().title)));
    if now == Kind::Picture {
        options.push((now, "Image"));
    }
    fields.choice(("Kind", tip), now, &options, |scene, to| to.apply(scene));
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
            picture,
            strength,
            rotation,
        } => {
            sun(fields, session, picture);
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
            // Light that is turned is judged by how bright the picture becomes.
            fields.draw(|ui, _| render::exposure(ui, "View exposure", &mut session.view));
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
    section::show(fields, session);
    fields.heading("Camera");
    let is_home = session
        .controller
        .as_ref()
        .is_none_or(|controller| controller.is_home());
    let tip = "Replace the scene's camera with the current view.";
    fields.draw(|ui, _| {
        let button = eframe::egui::Button::new("Set scene camera from view");
        let button = ui.add_enabled(!is_home, button).on_hover_text(tip);
        let button = button.on_disabled_hover_text("The view matches the scene's camera.");
        if button.clicked() {
            session.set_scene_camera();
        }
    });
}

/// Where the sun stands, if the picture is a sky.
fn sun(fields: &mut Fields, session: &Session, picture: usize) {
    let Origin::Sky { elevation, azimuth } = fields.scene.pictures[picture].origin else {
        return;
    };
    sun_dial(fields, session);
    let tip = "Height of the sun above the horizon in degrees, 0 to 90.";
    let limits = Limits {
        least: 0.0,
        most: 90.0,
        ..Limits::ANGLE
    };
    let degrees = elevation.to_degrees();
    fields.number(("Sun elevation", tip), degrees, limits, move |scene, to| {
        scene.set_sky(to.to_radians(), azimuth);
    });
    let tip = "Direction of the sun in degrees from −Z towards +X.";
    let degrees = azimuth.to_degrees();
    fields.number(
        ("Sun azimuth", tip),
        degrees,
        Limits::ANGLE,
        move |scene, to| {
            scene.set_sky(elevation, to.to_radians());
        },
    );
}

/// A map of the sky in which the sun can be dragged.
fn sun_dial(fields: &mut Fields, session: &Session) {
    let Some((light, sun)) =
        BackgroundLight::of(fields.scene).and_then(|light| Some((light, light.sun_deg()?)))
    else {
        return;
    };
    let bindings = &session.preferences.bindings;
    let tip = "The sky from above. Drag the sun; the middle is the zenith and the line is the way the camera looks. \
               In the picture, drag to turn it";
    let tip = bindings.tip(tip, Action::TurnLight);
    let forward = session
        .camera()
        .map(|camera| camera.look_at - camera.look_from);
    let map = |ui: &mut Ui| {
        let size = vec2(2.0 * DIAL, 2.0 * DIAL + 4.0);
        // The mouse only: the numbers are for keys.
        let (rect, response) = ui.allocate_exact_size(size, Sense::CLICK | Sense::DRAG);
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, "Map of the sky"));
        let dial = SunDial {
            center: rect.center(),
            radius: DIAL,
        };
        dial.paint(ui.painter(), sun, forward);
        let at = response.interact_pointer_pos();
        let moved = response.dragged() || response.clicked();
        response.on_hover_text(&tip);
        at.filter(|_| moved).map(|at| dial.sun_deg(at))
    };
    let moved = fields.draw(|ui, _| row(ui, ("Sun", &tip), |ui, _| map(ui)));
    if let Some(sun) = moved.flatten() {
        fields.change("sun", move |scene| {
            light.with_sun(sun).apply(scene);
            Ok(())
        });
    }
}

/// A kind of background.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Color,
    Gradient,
    BuiltIn(BuiltIn),
    Picture,
}

impl Kind {
    fn of(scene: &Scene) -> Self {
        match scene.background {
            Background::Color(_) => Self::Color,
            Background::Gradient { .. } => Self::Gradient,
            Background::Picture { picture, .. } => {
                let picture = &scene.pictures[picture];
                match (BuiltIn::of(picture), &picture.origin) {
                    (Some(environment), _) => Self::BuiltIn(environment),
                    (None, Origin::Sky { .. }) => Self::BuiltIn(BuiltIn::Sky),
                    (None, _) => Self::Picture,
                }
            }
        }
    }

    /// Replaces the background by one of this kind, of about the same colour where it has one.
    fn apply(self, scene: &mut Scene) {
        let (bottom, top) = match &scene.background {
            Background::Color(color) => (*color, *color),
            Background::Gradient { bottom, top } => (*bottom, *top),
            Background::Picture { .. } => (Vec3::splat(0.5), Vec3::splat(0.5)),
        };
        match self {
            Self::Color => scene.background = Background::Color((bottom + top) * 0.5),
            Self::Gradient => scene.background = Background::Gradient { bottom, top },
            Self::BuiltIn(environment) => scene.set_built_in(environment),
            // This kind is offered only if already chosen.
            Self::Picture => {}
        }
    }
}
