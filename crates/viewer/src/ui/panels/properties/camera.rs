//! The properties of a camera.

use crate::model::objects::Id;
use crate::state::session::Session;
use crate::ui::panels::properties::fields::{Change, Fields, Limits};
use glam::DVec3;
use glimray_scene::{Camera, CameraProperty, Lens, Scene, Target};

/// Limits of scene files: the largest lens in scene units, and relative to the focus distance.
const MAX_LENS: f64 = 1e9;
const MAX_RATIO: f64 = 1e6;

/// Half the height of a picture on 35 mm film, in millimetres.
const HALF_FILM: f64 = 12.0;
/// The focal lengths of the fields of view that can be entered, in millimetres.
const FOCAL_LENGTHS: [f64; 2] = [0.105, 13_750.0];
/// Millimetres of a scene unit, which is a metre for f-stops.
const UNIT: f64 = 1000.0;

/// Draws all properties of a camera.
pub fn show(fields: &mut Fields, session: &mut Session, index: usize) {
    let camera = fields.scene.cameras[index].clone();
    let is_used = fields.scene.camera_index == index;
    let mut is_chosen = false;
    fields.draw(|ui, _| {
        ui.horizontal_wrapped(|ui| {
            let tip = "Move the view to this camera without changing the scene.";
            if ui.button("Look through").on_hover_text(tip).clicked() {
                session.frame(Id::Camera(index));
            }
            if !is_used {
                let tip = "Make this the scene's active camera.";
                is_chosen = ui.button("Make active").on_hover_text(tip).clicked();
            }
        })
    });
    if is_chosen {
        fields.request(Change {
            name: format!("use {}", fields.subject),
            apply: Box::new(move |scene| {
                scene.camera_index = index;
                Ok(())
            }),
        });
    }
    if is_used {
        let is_home = session
            .controller
            .as_ref()
            .is_some_and(|controller| controller.is_home());
        fields.note(match is_home {
            true => "This is the active camera.",
            false => "This is the scene's camera. The current view differs from it.",
        });
    }
    fields.heading("Transform");
    let space = match camera.node {
        Some(_) => "in its parent's space",
        None => "in world space",
    };
    use CameraProperty as P;
    type Slot = fn(&mut Camera) -> &mut DVec3;
    let mut vector = |label, tip, value, property, slot: Slot| {
        let tip = format!("{tip}, {space}, in scene units.");
        let set = move |scene: &mut Scene, to: DVec3| {
            let mut camera = scene.cameras[index].clone();
            *slot(&mut camera) = to;
            if looks_somewhere(&camera) {
                scene.cameras[index] = camera;
            }
        };
        fields.driven_by(Target::Camera(index, property)).vector(
            (label, &tip),
            value,
            Limits::LENGTH,
            set,
        );
    };
    let tip = "Position";
    vector("Look from", tip, camera.look_from, P::LookFrom, |c| {
        &mut c.look_from
    });
    if camera.target.is_none() {
        let tip = "The point at the centre of the picture";
        vector("Look at", tip, camera.look_at, P::LookAt, |c| {
            &mut c.look_at
        });
    }
    let tip = "The up direction of the picture";
    vector("Up", tip, camera.up, P::Up, |c| &mut c.up);
    if camera.target.is_some() {
        fields.note("It tracks a node.");
    }
    projection(fields, index, &camera);
    lens(fields, &mut session.tool_state.focuses, index, &camera);
}

/// A change of a camera.
fn with<T>(index: usize, change: fn(&mut Camera, T)) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| change(&mut scene.cameras[index], to)
}

fn projection(fields: &mut Fields, index: usize, camera: &Camera) {
    use CameraProperty as P;
    fields.heading("Projection");
    let tip = "Use parallel projection.";
    let is_parallel = camera.orthographic_height.is_some();
    let set = with(index, |camera, to: bool| {
        // The size of the target is preserved.
        let distance = camera.look_from.distance(camera.look_at);
        let height = 2.0 * distance * (camera.fov_y / 2.0).tan();
        camera.orthographic_height = to.then_some(height);
    });
    fields.toggle(("Orthographic", tip), is_parallel, set);
    match camera.orthographic_height {
        Some(height) => {
            let tip = "Height of the visible area in scene units, above 0.";
            let set = with(index, |camera, to| camera.orthographic_height = Some(to));
            fields
                .driven_by(Target::Camera(index, P::OrthographicHeight))
                .number(("Height", tip), height, Limits::SIZE, set);
        }
        None => {
            let tip = "Vertical field of view in degrees, above 0 and below 180.";
            let limits = Limits {
                least: 0.1,
                most: 179.0,
                ..Limits::ANGLE
            };
            let set = with(index, |camera, to: f64| camera.fov_y = to.to_radians());
            fields.driven_by(Target::Camera(index, P::FovY)).number(
                ("Field of view", tip),
                camera.fov_y.to_degrees(),
                limits,
                set,
            );
            let tip = "Focal length of a 35 mm camera, whose picture is 24 mm high, with this field of view, in millimetres.";
            let limits = Limits {
                unit: " mm",
                ..Limits::between(FOCAL_LENGTHS[0], FOCAL_LENGTHS[1])
            };
            let set = with(index, |camera, to: f64| {
                camera.fov_y = 2.0 * (HALF_FILM / to).atan();
            });
            fields.driven_by(Target::Camera(index, P::FovY)).number(
                ("Focal length", tip),
                focal_length(camera),
                limits,
                set,
            );
        }
    }
}

/// The focal length in millimetres of a 35 mm camera with the same field of view.
fn focal_length(camera: &Camera) -> f64 {
    HALF_FILM / (camera.fov_y / 2.0).tan()
}

/// Whether `look_at` and `up` pass the native importer's check.
fn looks_somewhere(camera: &Camera) -> bool {
    let forward = (camera.look_at - camera.look_from).normalize_or_zero();
    let up = camera.up.normalize_or_zero();
    forward.cross(up).length() >= 1e-6
}

/// `focuses`: the camera whose focus the next click in the picture sets.
fn lens(fields: &mut Fields, focuses: &mut Option<usize>, index: usize, camera: &Camera) {
    use CameraProperty as P;
    fields.heading("Lens");
    let tip = "Use a thin lens with depth of field instead of a pinhole.";
    let set = with(index, |camera, to: bool| {
        let distance = camera.look_from.distance(camera.look_at);
        camera.lens = to.then_some(Lens {
            radius: 0.02 * distance,
            focus_distance: distance,
            blade_count: 0,
            blade_rotation: 0.0,
        });
    });
    fields.toggle(("Thin lens", tip), camera.lens.is_some(), set);
    let Some(lens) = camera.lens else {
        return;
    };
    let tip = "Aperture radius in scene units, above 0.";
    let set = with_lens(index, |lens, to| {
        lens.radius = to.min(MAX_LENS).min(MAX_RATIO * lens.focus_distance)
    });
    fields
        .driven_by(Target::Camera(index, P::LensRadius))
        .number(("Radius", tip), lens.radius, Limits::SIZE, set);
    if camera.orthographic_height.is_none() {
        let tip = "Focal length over the diameter of the aperture. A scene unit counts as a metre, and the focal length is that \
                   of a 35 mm camera.";
        let focal_length = focal_length(camera);
        let set = with_lens(index, move |lens, to| {
            let radius = focal_length / to / 2.0 / UNIT;
            lens.radius = radius.min(MAX_RATIO * lens.focus_distance);
        });
        let stop = focal_length / (2.0 * lens.radius * UNIT);
        fields
            .driven_by(Target::Camera(index, P::LensRadius))
            .number(("F-stop", tip), stop, Limits::SIZE, set);
    }
    let tip = "Focus distance along the viewing direction in scene units, above 0.";
    let set = with_lens(index, |lens, to| {
        lens.focus_distance = to.max(lens.radius / MAX_RATIO)
    });
    fields
        .driven_by(Target::Camera(index, P::FocusDistance))
        .number(("Focus", tip), lens.focus_distance, Limits::SIZE, set);
    let is_chosen = *focuses == Some(index);
    let tip = "Click in the picture on what is to be sharp.";
    fields.draw(|ui, _| {
        let button = ui.selectable_label(is_chosen, "Focus by click");
        if button.on_hover_text(tip).clicked() {
            *focuses = (!is_chosen).then_some(index);
        }
    });
    let tip = "Number of aperture blades, at least 3; 0 for a circular aperture.";
    let limits = Limits::between(0.0, 64.0).with_speed(0.1);
    let set = with_lens(index, |lens, to| {
        let count = to.round() as u32;
        lens.blade_count = match (count, lens.blade_count) {
            // Skips 1 and 2, which are not valid numbers of blades.
            (1 | 2, 0) => 3,
            (1 | 2, _) => 0,
            _ => count,
        };
    });
    fields.number(("Blades", tip), f64::from(lens.blade_count), limits, set);
    if lens.blade_count > 0 {
        let tip = "Rotation of the first blade from the right, in degrees counter-clockwise.";
        let set = with_lens(index, |lens, to| lens.blade_rotation = to.to_radians());
        let degrees = lens.blade_rotation.to_degrees();
        fields.number(("Blade rotation", tip), degrees, Limits::ANGLE, set);
    }
}

/// A change of a camera's lens.
fn with_lens(index: usize, change: impl FnOnce(&mut Lens, f64)) -> impl FnOnce(&mut Scene, f64) {
    move |scene, to| {
        if let Some(lens) = &mut scene.cameras[index].lens {
            change(lens, to);
        }
    }
}
