//! What is measured: scenes made here, the same every time.

use crate::app::demo;
use crate::app::exit::AppError;
use crate::import;
use crate::scene::{Background, Camera, Instance, Light, LightKind, Material, Mesh, Scene};
use glam::{DAffine3, DVec3, Vec3};
use std::f32::consts::TAU;
use std::fmt::Write;

/// A scene and the size to render it in.
pub struct Workload {
    pub name: &'static str,
    pub scene: Scene,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

/// Every workload, from small to large.
pub fn all() -> Result<Vec<Workload>, AppError> {
    let demo = demo::scene()?;
    let course = course_text(1500, 3);
    Ok(vec![
        Workload {
            name: "course",
            scene: import::parse("course.scene", &course, &import::Options::default())?,
            size: (640, 480),
        },
        Workload {
            name: "demo",
            size: demo.output.size,
            scene: demo,
        },
        Workload {
            name: "heightfield-primary",
            scene: height_field(300, Vec::new()),
            size: (1024, 1024),
        },
        Workload {
            name: "heightfield-shadow",
            scene: height_field(300, vec![sun()]),
            size: (1024, 1024),
        },
    ])
}

/// A scene in the course's format: small triangles strewn over a box in front of the camera.
fn course_text(triangle_count: u32, light_count: u32) -> String {
    let mut random = Random(1);
    let mut text = format!("{}\namb: 0.1 0.1 0.1\n", triangle_count + light_count);
    for _ in 0..triangle_count {
        let center = [4.0, 3.0, 3.0].map(|extent| extent * (random.next() - 0.5));
        text.push_str("triangle\n");
        for _ in 0..3 {
            let [x, y, z] = center.map(|c| c + 0.4 * (random.next() - 0.5));
            let [r, g, b] = [random.next(), random.next(), random.next()];
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

/// Hills of `quads` × `quads` quads over the unit square of the ground, seen from a corner.
fn height_field(quads: u32, lights: Vec<Light>) -> Scene {
    let side = quads + 1;
    let height = |x: f32, z: f32| {
        0.06 * (TAU * 2.0 * x).sin() * (TAU * 3.0 * z).cos() + 0.01 * (TAU * 17.0 * (x + z)).sin()
    };
    let at = |i: u32| i as f32 / quads as f32 - 0.5;
    let vertices = (0..side * side).map(|i| (at(i % side), at(i / side)));
    let mut mesh = Mesh {
        positions: vertices
            .map(|(x, z)| Vec3::new(x, height(x, z), z))
            .collect(),
        materials: vec![0; (side * side) as usize],
        triangles: (0..quads * quads)
            .map(|i| i / quads * side + i % quads)
            .flat_map(|i| [[i, i + side, i + 1], [i + 1, i + side, i + side + 1]])
            .collect(),
        ..Mesh::default()
    };
    mesh.repair();
    Scene {
        meshes: vec![mesh],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
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

fn sun() -> Light {
    Light {
        kind: LightKind::Directional {
            direction: DVec3::new(-2.0, -1.0, -1.0).normalize(),
        },
        color: Vec3::ONE,
        ..Light::default()
    }
}

/// Numbers in 0..1, the same on every machine (Steele and Vigna's SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1_u32 << 24) as f32
    }
}
