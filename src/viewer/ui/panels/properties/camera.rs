//! A camera of the scene.

use crate::scene::{CameraProperty, Lens, Scene, Target};
use crate::viewer::model::objects::Id;
use crate::viewer::state::session::Session;
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;

/// What scene files can hold: the largest lens, in scene units, and in focus distances.
const MAX_LENS: f64 = 1e9;
const MAX_RATIO: f64 = 1e6;

/// All fields of a camera.
pub fn show(fields: &mut Fields, session: &mut Session, index: usize) {
    let camera = fields.scene.cameras[index].clone();
    let target = |property| Some(Target::Camera(index, property));
    let is_used = fields.scene.camera_index == index;
    fields.ui.horizontal_wrapped(|ui| {
        let tip = "Go to where this camera is; the scene stays as it is.";
        if ui.button("Look through it").on_hover_text(tip).clicked() {
            session.frame(Id::Camera(index));
        }
        if !is_used {
            let tip = "Make it the camera that the scene is seen by.";
            if ui.button("Use it").on_hover_text(tip).clicked() {
                fields
                    .changes
                    .push(crate::viewer::ui::panels::properties::Change {
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
            true => "The picture is seen by it.",
            false => "The scene's camera; the picture is seen from elsewhere.",
        });
    }
    fields.heading("Place");
    let space = match camera.node {
        Some(_) => "in the space of what carries it",
        None => "in the world",
    };
    let mut vector = |label: &str, tip: &str, value: DVec3, property, slot: Slot| {
        let tip = format!("{tip}, {space}, in scene units.");
        let set = move |scene: &mut Scene, to: DVec3| {
            let mut camera = scene.cameras[index].clone();
            *slot(&mut camera) = to;
            if looks_somewhere(&camera) {
                scene.cameras[index] = camera;
            }
        };
        fields.vector(label, &tip, value, Limits::LENGTH, target(property), set);
    };
    type Slot = fn(&mut crate::scene::Camera) -> &mut DVec3;
    use CameraProperty as P;
    vector(
        "Look from",
        "Where it is",
        camera.look_from,
        P::LookFrom,
        |c| &mut c.look_from,
    );
    if camera.target.is_none() {
        vector(
            "Look at",
            "A point in the middle of the picture",
            camera.look_at,
            P::LookAt,
            |c| &mut c.look_at,
        );
    }
    vector(
        "Up",
        "What is upwards in the picture",
        camera.up,
        P::Up,
        |c| &mut c.up,
    );
    if camera.target.is_some() {
        fields.note("It looks at what a node carries.");
    }
    fields.heading("Projection");
    let tip = "Whether rays are parallel.";
    let is_parallel = camera.orthographic_height.is_some();
    let distance = camera.look_from.distance(camera.look_at);
    let fov_y = camera.fov_y;
    fields.toggle("Orthographic", tip, is_parallel, move |scene, to| {
        // What is looked at keeps its size.
        let height = 2.0 * distance * (fov_y / 2.0).tan();
        scene.cameras[index].orthographic_height = to.then_some(height);
    });
    match camera.orthographic_height {
        Some(height) => {
            let tip = "Height of what is in the picture, in scene units, above 0.";
            let driven = target(P::OrthographicHeight);
            fields.number(
                "Height",
                tip,
                height,
                Limits::SIZE,
                driven,
                move |scene, to| {
                    scene.cameras[index].orthographic_height = Some(to);
                },
            );
        }
        None => {
            let tip = "Vertical field of view in degrees, above 0 and below 180.";
            let limits = Limits {
                least: 0.1,
                most: 179.0,
                ..Limits::ANGLE
            };
            let degrees = fov_y.to_degrees();
            fields.number(
                "Field of view",
                tip,
                degrees,
                limits,
                target(P::FovY),
                move |scene, to| {
                    scene.cameras[index].fov_y = to.to_radians();
                },
            );
        }
    }
    lens(fields, index, camera.lens, distance);
}

/// As the reader of native scenes asks for it.
fn looks_somewhere(camera: &crate::scene::Camera) -> bool {
    let forward = (camera.look_at - camera.look_from).normalize_or_zero();
    let up = camera.up.normalize_or_zero();
    forward.cross(up).length() >= 1e-6
}

fn lens(fields: &mut Fields, index: usize, lens: Option<Lens>, distance: f64) {
    fields.heading("Lens");
    let tip = "A thin lens instead of a pinhole: what is not at its distance is blurred.";
    fields.toggle("Thin lens", tip, lens.is_some(), move |scene, to| {
        scene.cameras[index].lens = to.then_some(Lens {
            radius: 0.02 * distance,
            focus_distance: distance,
            blade_count: 0,
            blade_rotation: 0.0,
        });
    });
    let Some(lens) = lens else {
        return;
    };
    let target = |property| Some(Target::Camera(index, property));
    let with = move |change: fn(&mut Lens, f64)| {
        move |scene: &mut Scene, to: f64| {
            if let Some(lens) = &mut scene.cameras[index].lens {
                change(lens, to);
            }
        }
    };
    let tip = "Of the opening, in scene units, above 0.";
    let driven = target(CameraProperty::LensRadius);
    let set = with(|lens, to| lens.radius = to.min(MAX_LENS).min(MAX_RATIO * lens.focus_distance));
    fields.number("Radius", tip, lens.radius, Limits::SIZE, driven, set);
    let tip = "Distance along the line of sight of what is sharp, in scene units, above 0.";
    let driven = target(CameraProperty::FocusDistance);
    let set = with(|lens, to| lens.focus_distance = to.max(lens.radius / MAX_RATIO));
    fields.number("Focus", tip, lens.focus_distance, Limits::SIZE, driven, set);
    let tip = "Corners of the opening, 3 or more; 0 for a round one.";
    let limits = Limits {
        speed: 0.1,
        ..Limits::between(0.0, 64.0)
    };
    let set = with(|lens, to| {
        let count = to.round() as u32;
        lens.blade_count = match (count, lens.blade_count) {
            // On the way up from a circle, and down to it.
            (1 | 2, 0) => 3,
            (1 | 2, _) => 0,
            _ => count,
        };
    });
    fields.number(
        "Blades",
        tip,
        f64::from(lens.blade_count),
        limits,
        None,
        set,
    );
    if lens.blade_count > 0 {
        let tip = "Degrees counter-clockwise of the first corner from the right.";
        let set = with(|lens, to| lens.blade_rotation = to.to_radians());
        let degrees = lens.blade_rotation.to_degrees();
        fields.number("Blades turned", tip, degrees, Limits::ANGLE, None, set);
    }
}
