//! The benchmark's scenes, generated the same way every time.

use super::random::Random;
use super::scenes::{Detail, glass, hills};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray_app::error::AppError;
use glimray_app::showcase;
use glimray_io::import;
use glimray_render::pack;
use glimray_scene::{
    Background, Beyond, Camera, CameraProperty, Curve, Easing, Instance, Interpolation, Light,
    LightKind, Material, Scene, Target, Track, Values,
};
use std::fmt::Write;

/// A scene with its render settings.
pub struct Workload {
    pub name: &'static str,
    pub scene: Scene,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Shutter opening and closing times, in seconds.
    pub shutter_interval: (f64, f64),
    /// See [`pack::scene_with`].
    pub most_baked: usize,
}

impl Workload {
    pub fn new(name: &'static str, scene: Scene, size: (u32, u32)) -> Self {
        Self {
            name,
            scene,
            size,
            shutter_interval: (0.0, 0.0),
            most_baked: pack::MAX_BAKED,
        }
    }
}

/// Every workload, from small to large; with `is_quick` in pictures of half the width and height.
///
/// # Errors
/// None, unless a built-in scene is broken.
pub fn all(is_quick: bool) -> Result<Vec<Workload>, AppError> {
    let mut demo = showcase::scene()?;
    demo.output.samples = 1;
    let course = course_text(1500, 3);
    let course = import::parse("course.scene", &course, &import::Options::default())?;
    let size = demo.output.size;
    let (small, medium, large) = ((640, 480), (512, 512), (1024, 1024));
    let mut all = vec![
        Workload::new("course", course, small),
        Workload::new("demo", demo, size),
        Workload::new("heightfield-primary", height_field(300, Vec::new()), large),
        Workload::new("heightfield-shadow", height_field(300, vec![sun()]), large),
        Workload::new(
            "heightfield-16",
            sampled(height_field(300, Vec::new())),
            medium,
        ),
        Workload {
            shutter_interval: (0.0, 1.0),
            ..Workload::new(
                "heightfield-pan",
                sampled(panned(height_field(300, Vec::new()))),
                medium,
            )
        },
        Workload {
            most_baked: usize::MAX,
            ..Workload::new("crowd-laid-out", crowd(), small)
        },
        Workload {
            most_baked: 0,
            ..Workload::new("crowd-instanced", crowd(), small)
        },
        Workload::new("glass", glass(Detail::Full), small),
    ];
    if is_quick {
        for Workload { size, .. } in &mut all {
            *size = (size.0 / 2, size.1 / 2);
        }
    }
    Ok(all)
}

/// A scene in the course format: small triangles scattered in a box in front of the camera.
pub fn course_text(triangle_count: u32, light_count: u32) -> String {
    let mut random = Random::new(1);
    let mut next = || random.unit() as f32;
    let mut text = format!("{}\namb: 0.1 0.1 0.1\n", triangle_count + light_count);
    for _ in 0..triangle_count {
        let center = [4.0, 3.0, 3.0].map(|extent| extent * (next() - 0.5));
        text.push_str("triangle\n");
        for _ in 0..3 {
            let [x, y, z] = center.map(|c| c + 0.4 * (next() - 0.5));
            let [r, g, b] = [next(), next(), next()];
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "pos: {x:.4} {y:.4} {:.4}\nnor: 0 0 1\ndif: {r:.3} {g:.3} {b:.3}\n\
                 spe: 0.3 0.3 0.3\nshi: 20",
                z - 5.0
            );
        }
    }
    for light in 0..light_count {
        let x = 4.0 * light as f32 - 4.0;
        let _ = writeln!(text, "light\npos: {x} 4 2\ncol: 0.4 0.4 0.4");
    }
    text
}

/// A thousand different height fields of a thousand triangles each, in sunlight.
pub fn thousand() -> Scene {
    let mut scene = height_field(1, vec![sun()]);
    scene.meshes = (0..1000)
        .map(|i| hills(25, 20, f64::from(i) / 1000.0).into())
        .collect();
    scene.instances = (0..1000)
        .map(|i| {
            let place = DVec3::new(f64::from(i % 40) - 19.5, 0.0, f64::from(i / 40) - 12.0);
            Instance {
                mesh: i as usize,
                placement: DAffine3::from_scale_rotation_translation(
                    DVec3::splat(0.03),
                    DQuat::from_rotation_y(f64::from(i)),
                    place * 0.03,
                ),
                node: None,
                name: String::new(),
            }
        })
        .collect();
    scene.pin_render_origin();
    scene
}

/// A height field of `quads` × `quads` quads, seen from a corner.
fn height_field(quads: u32, lights: Vec<Light>) -> Scene {
    Scene {
        meshes: vec![hills(quads, quads, 0.0).into()],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
            name: String::new(),
        }],
        materials: vec![Material::default()],
        lights,
        cameras: vec![Camera {
            look_from: DVec3::new(0.55, 0.45, 0.75),
            look_at: DVec3::new(0.0, -0.05, 0.0),
            ..Camera::default()
        }],
        background: Background::Color(Vec3::new(0.5, 0.7, 1.0)),
        ambient: Vec3::splat(0.2),
        ..Scene::default()
    }
}

/// Sets 16 samples per pixel.
fn sampled(mut scene: Scene) -> Scene {
    scene.output.samples = 16;
    scene
}

/// Moves the camera sideways by an eighth of a unit in one second.
fn panned(mut scene: Scene) -> Scene {
    let camera = &scene.cameras[0];
    let (from, at) = (camera.look_from, camera.look_at);
    let way = (at - from).cross(camera.up).normalize() * 0.125;
    for (property, rest) in [
        (CameraProperty::LookFrom, from),
        (CameraProperty::LookAt, at),
    ] {
        scene.tracks.push(Track {
            targets: vec![Target::Camera(0, property)],
            curve: Curve {
                times: vec![0.0, 1.0],
                values: Values::Vector(vec![rest, rest + way]),
                interpolation: Interpolation::Linear,
                easing: Easing::None,
                beyond: Beyond::Hold,
            },
        });
    }
    scene
}

/// A hundred instances of a height field of 7,200 triangles, each with its own rotation and scale, in sunlight.
fn crowd() -> Scene {
    let mut scene = height_field(60, vec![sun()]);
    let mut random = Random::new(3);
    let mut next = || random.unit();
    scene.instances = (0..100)
        .map(|i| {
            let place = DVec3::new(
                f64::from(i % 10) - 4.5,
                next() * 0.2,
                f64::from(i / 10) - 4.5,
            );
            let scale = DVec3::new(0.1 + 0.06 * next(), 0.2 + 0.2 * next(), 0.1 + 0.06 * next());
            let turn = DQuat::from_rotation_y(6.0 * next());
            Instance {
                mesh: 0,
                placement: DAffine3::from_scale_rotation_translation(scale, turn, place * 0.12),
                node: None,
                name: String::new(),
            }
        })
        .collect();
    scene
}

fn sun() -> Light {
    Light {
        kind: LightKind::Directional {
            direction: DVec3::new(-2.0, -1.0, -1.0).normalize(),
        },
        color: Vec3::ONE,
        ..Light::default()
    }
}
