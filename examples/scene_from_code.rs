//! Builds a scene in code and renders it: `cargo run --release --example scene_from_code -- OUT.png`
//!
//! A glass ball and a mesh of one triangle stand on a floor in front of a sky.

use glam::{DAffine3, DVec3, Vec3, dvec3, vec3};
use glimray::gpu::{AdapterChoice, Gpu};
use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
use glimray::scene::{
    Antialias, Background, Camera, Fresnel, Geometry, Instance, Light, LightKind, Material, Mesh,
    Phong, Scene, Shape, Transfer,
};
use glimray::{output, pack};
use std::{error::Error, sync::Arc};

fn scene() -> Scene {
    let paint = |color: Vec3| Material {
        two_sided: true,
        bsdf: Phong {
            diffuse: color,
            ambient: color,
            specular: Vec3::splat(0.2),
            shininess: 40.0,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    let glass = Material::from(Phong {
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.5,
        fresnel: Fresnel::Exact,
        ..Phong::default()
    });
    let mut triangle = Mesh {
        positions: vec![
            vec3(-1.0, 0.0, 0.0),
            vec3(1.0, 0.0, 0.0),
            vec3(0.0, 1.6, 0.0),
        ],
        triangles: vec![[0, 1, 2]],
        materials: vec![1; 3],
        ..Mesh::default()
    };
    // Computes the normals.
    triangle.repair();
    let shape = |geometry, material| Shape {
        geometry,
        material,
        node: None,
        name: String::new(),
    };
    Scene {
        materials: vec![
            paint(vec3(0.5, 0.5, 0.45)),
            paint(vec3(0.8, 0.25, 0.1)),
            glass,
        ],
        meshes: vec![Arc::new(triangle)],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::from_translation(dvec3(-1.2, 0.0, -1.0)),
            node: None,
            name: String::new(),
        }],
        shapes: vec![
            shape(
                Geometry::Plane {
                    point: DVec3::ZERO,
                    normal: DVec3::Y,
                },
                0,
            ),
            shape(
                Geometry::Sphere {
                    center: dvec3(0.7, 0.8, 0.0),
                    radius: 0.8,
                },
                2,
            ),
        ],
        lights: vec![Light {
            kind: LightKind::Point {
                position: dvec3(3.0, 5.0, 4.0),
            },
            color: Vec3::ONE,
            ..Light::default()
        }],
        cameras: vec![Camera {
            look_from: dvec3(0.0, 1.6, 5.0),
            look_at: dvec3(0.0, 0.7, 0.0),
            fov_y: 40_f64.to_radians(),
            ..Camera::default()
        }],
        background: Background::Gradient {
            bottom: vec3(0.5, 0.5, 0.5),
            top: vec3(0.2, 0.4, 0.8),
        },
        ambient: Vec3::splat(0.2),
        ..Scene::default()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("name the picture to write")?;
    let scene = scene();
    let packed = Arc::new(pack::scene(&scene)?);
    let view = packed.frame(&scene.frame(0.0))?;
    let settings = RenderSettings {
        size: (320, 200),
        samples: 16,
        // Without it all samples go through the centre of their pixel.
        antialias: Antialias::Stratified,
        ..RenderSettings::default()
    };
    let gpu = Gpu::new(&AdapterChoice::default())?;
    let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    let tone = Tone {
        transfer: Transfer::Srgb,
        ..Tone::LINEAR
    };
    output::save(&path, &renderer.develop(&tone)?)?;
    Ok(())
}
