//! Mirrors and glass: paths of many bounces. It has no ray sets; the whole render is measured.

use super::{Detail, empty, parts::Builder, placed};
use glam::{DAffine3, DVec3, Vec3, dvec3};
use glimray_scene::{Fresnel, Geometry, Material, Mesh, Phong, Scene, Shape};

/// Bounces after the first hit.
const DEPTH: u32 = 12;

/// Glass balls, hollow in every other place, between two mirrors that face each other.
pub fn glass(detail: Detail) -> Scene {
    let side = detail.of(6_u32, 2);
    let view = [dvec3(0.0, 2.2, 5.5), dvec3(0.0, 0.4, 0.0)];
    let mut scene = empty(view, dvec3(1.0, 6.0, 3.0));
    scene.output.max_depth = DEPTH;
    let mirror = Material::from(Phong {
        diffuse: Vec3::splat(0.02),
        reflect: Vec3::splat(0.9),
        ..Phong::default()
    });
    let glass = Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.5,
        absorption: Vec3::new(0.3, 0.1, 0.2),
        fresnel: Fresnel::Exact,
        ..Phong::default()
    });
    let air = Material {
        priority: 1,
        bsdf: Phong {
            ior: 1.0,
            absorption: Vec3::ZERO,
            ..glass.classical().into_owned()
        }
        .into(),
        ..glass.clone()
    };
    scene.materials.extend([mirror, glass, air]);
    let (floor, mirror, glass, air) = (0, 1, 2, 3);
    for (material, corner, [u, v]) in [
        (
            floor,
            dvec3(-5.0, 0.0, -5.0),
            [10.0 * DVec3::Z, 10.0 * DVec3::X],
        ),
        (
            mirror,
            dvec3(-3.5, 0.0, -4.0),
            [3.0 * DVec3::Y, 8.0 * DVec3::Z],
        ),
        (
            mirror,
            dvec3(3.5, 0.0, -4.0),
            [8.0 * DVec3::Z, 3.0 * DVec3::Y],
        ),
    ] {
        scene
            .instances
            .push(placed(scene.meshes.len(), DAffine3::IDENTITY));
        scene.meshes.push(rectangle(corner, u, v, material).into());
    }
    for index in 0..side * side {
        let [i, j] = [index % side, index / side].map(|i| f64::from(i) - f64::from(side - 1) / 2.0);
        let center = dvec3(i, 0.42, j);
        let mut ball = |radius: f64, material: usize| {
            scene.shapes.push(Shape {
                geometry: Geometry::Sphere { center, radius },
                material,
                node: None,
                name: String::new(),
            });
        };
        ball(0.4, glass);
        if index % 2 == 0 {
            ball(0.3, air);
        }
    }
    scene
}

fn rectangle(corner: DVec3, u: DVec3, v: DVec3, material: u32) -> Mesh {
    let mut builder = Builder::default();
    builder.grid(1, 1, |i, j| corner + f64::from(i) * u + f64::from(j) * v);
    let mut mesh = builder.mesh();
    mesh.materials.fill(material);
    mesh
}
