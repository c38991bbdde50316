//! The self-test of an adapter: renders one sphere and one light, and compares the centre pixel with Phong's
//! formula evaluated here in f64.

use crate::device;
use glam::{DVec3, Vec3};
use glimray_app::error::AppError;
use glimray_render::gpu::Gpu;
use glimray_render::{ExecutionPolicy, RenderSettings, Tone};
use glimray_scene::{Camera, Geometry, Light, LightKind, Material, Phong, Scene, Shape};

/// Odd, so that the ray through the centre pixel runs along the camera's axis.
const SIDE: u32 = 33;

/// Larger than rounding errors in f32, smaller than the effect of any bug.
const TOLERANCE: f64 = 1e-3;

const LIGHT: DVec3 = DVec3::new(1.5, 2.0, 1.0);
const CENTER: DVec3 = DVec3::new(0.0, 0.0, -3.0);
const RADIUS: f64 = 1.0;
const AMBIENT: f64 = 0.1;
const DIFFUSE: f64 = 0.5;
const SPECULAR: f64 = 0.3;
const SHININESS: f64 = 4.0;

/// Radiance of the centre pixel.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// On the adapter, in the channel with the largest error.
    pub found: f64,
    /// By the formula.
    pub expected: f64,
}

impl Outcome {
    pub fn is_right(&self) -> bool {
        (self.found - self.expected).abs() <= TOLERANCE
    }
}

/// Renders the test scene on `gpu`.
pub fn run(gpu: Gpu, memory_limit_bytes: u64) -> Result<Outcome, AppError> {
    let settings = RenderSettings {
        size: (SIDE, SIDE),
        ..RenderSettings::default()
    };
    let policy = ExecutionPolicy {
        memory_limit_bytes,
        ..ExecutionPolicy::default()
    };
    let mut renderer = device::renderer(gpu, &scene(), (0.0, 0.0), settings, policy)?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    let image = renderer.develop(&Tone::LINEAR)?;
    let [r, g, b, _] = image
        .pixel(SIDE / 2, SIDE / 2)
        .ok_or_else(|| AppError::Internal("self-test: the picture is too small".into()))?;
    let expected = expected();
    let off = |value: &f64| (value - expected).abs();
    let found = [r, g, b]
        .map(f64::from)
        .into_iter()
        .max_by(|a, b| off(a).total_cmp(&off(b)))
        .unwrap_or(f64::NAN);
    Ok(Outcome { found, expected })
}

fn scene() -> Scene {
    Scene {
        shapes: vec![Shape {
            geometry: Geometry::Sphere {
                center: CENTER,
                radius: RADIUS,
            },
            material: 0,
            node: None,
            name: String::new(),
        }],
        materials: vec![Material::from(Phong {
            diffuse: Vec3::splat(DIFFUSE as f32),
            specular: Vec3::splat(SPECULAR as f32),
            shininess: SHININESS as f32,
            ambient: Vec3::ONE,
            ..Phong::default()
        })],
        lights: vec![Light {
            kind: LightKind::Point { position: LIGHT },
            color: Vec3::ONE,
            ..Light::default()
        }],
        cameras: vec![Camera::default()],
        ambient: Vec3::splat(AMBIENT as f32),
        ..Scene::default()
    }
}

/// I = k_a + k_d (l·n) + k_s (r·v)^α at the point where the camera's axis meets the sphere.
fn expected() -> f64 {
    let n = DVec3::Z;
    let v = DVec3::Z;
    let l = (LIGHT - (CENTER + RADIUS * n)).normalize();
    let r = 2.0 * l.dot(n) * n - l;
    AMBIENT + DIFFUSE * l.dot(n).max(0.0) + SPECULAR * r.dot(v).max(0.0).powf(SHININESS)
}
