//! The properties of a camera.

use crate::model::objects::Id;
use crate::state::session::Session;
use crate::ui::panels::properties::fields::{Change, Fields, Limits};
use glam::DVec3;
use glimray_scene::{Camera, CameraProperty, Lens, Scene, Target};

/// Limits of scene files: the largest lens in scene units, and relative to the focus distance.
const MAX_LENS: f64 = 1e9;
const MAX_RATIO: f64 = 1e6;

/// Draws all properties of a camera.
pub fn show(fields: &mut Fields, session: &mut Session, index: usize) {
    let camera = fields.scene.cameras[index].clone();
    let is_used = fields.scene.camera_index == index;
    fields.ui.horizontal_wrapped(|ui| {
        let tip = "Move the view to this camera without changing the scene.";
        if ui.button("Look through").on_hover_text(tip).clicked() {
            session.frame(Id::Camera(index));
        }
        if !is_used {
            let tip = "Make this the scene's active camera.";
            if ui.button("Make active").on_hover_text(tip).clicked() {
                fields.changes.push(Change {
                    name: format!("use {}", fields.subject),
                    apply: Box::new(move |scene| {
                        scene.camera_index = index;
                        Ok(())
                    }),
                });
            }
        }
    });
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
    lens(fields, index, &camera);
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
        }
    }
}

/// Whether `look_at` and `up` pass the native importer's check.
fn looks_somewhere(camera: &Camera) -> bool {
    let forward = (camera.look_at - camera.look_from).normalize_or_zero();
    let up = camera.up.normalize_or_zero();
    forward.cross(up).length() >= 1e-6
}

fn lens(fields: &mut Fields, index: usize, camera: &Camera) {
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
    let with = move |change: fn(&mut Lens, f64)| {
        move |scene: &mut Scene, to: f64| {
            if let Some(lens) = &mut scene.cameras[index].lens {
                change(lens, to);
            }
        }
    };
    let tip = "Aperture radius in scene units, above 0.";
    let set = with(|lens, to| lens.radius = to.min(MAX_LENS).min(MAX_RATIO * lens.focus_distance));
    fields
        .driven_by(Target::Camera(index, P::LensRadius))
        .number(("Radius", tip), lens.radius, Limits::SIZE, set);
    let tip = "Focus distance along the viewing direction in scene units, above 0.";
    let set = with(|lens, to| lens.focus_distance = to.max(lens.radius / MAX_RATIO));
    fields
        .driven_by(Target::Camera(index, P::FocusDistance))
        .number(("Focus", tip), lens.focus_distance, Limits::SIZE, set);
    let tip = "Number of aperture blades, at least 3; 0 for a circular aperture.";
    let limits = Limits::between(0.0, 64.0).with_speed(0.1);
    let set = with(|lens, to| {
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
        let set = with(|lens, to| lens.blade_rotation = to.to_radians());
        let degrees = lens.blade_rotation.to_degrees();
        fields.number(("Blade rotation", tip), degrees, Limits::ANGLE, set);
    }
}
