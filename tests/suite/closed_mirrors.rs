//! Closed meshes of perfect mirrors, seen from inside: no ray ever escapes.

use crate::reference::compare::{counting, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::render::RenderSettings;
use glimray::scene::{CanonicalShape, Geometry, Material, Mesh, Phong, Scene, Shape};

/// Sharp edges in all directions.
fn tetrahedron() -> Mesh {
    let corners = [
        vec3(1.0, 1.0, 1.0),
        vec3(1.0, -1.0, -1.0),
        vec3(-1.0, 1.0, -1.0),
        vec3(-1.0, -1.0, 1.0),
    ];
    let mut mesh = Mesh::default();
    for face in [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]] {
        let [a, b, c] = face.map(|i: usize| corners[i]);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([a, b, c]);
        mesh.normals.extend([(b - a).cross(c - a).normalize(); 3]);
        mesh.materials.extend([0; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

/// A ball with spikes and interpolated normals, which reflect rays deep into its corners.
fn spiky() -> Mesh {
    let mut mesh = scenes::ball(UVec2::new(24, 12), 0);
    for position in &mut mesh.positions {
        // Equal for all vertices at one position.
        let place = (*position * 1e3).round().as_ivec3();
        let odd = (place.x + 3 * place.y + 5 * place.z).rem_euclid(2);
        *position *= if odd == 1 { 2.2 } else { 1.0 };
    }
    mesh.normals.clear();
    mesh.repair();
    mesh
}

/// Looks from inside in all directions except backwards.
fn mirrors(look_from: DVec3) -> Scene {
    let mut scene = scenes::empty();
    let camera = &mut scene.cameras[0];
    camera.look_from = look_from;
    camera.look_at = look_from + dvec3(1.0, 0.01, 0.02);
    camera.fov_y = 2.4;
    scene.materials[0] = Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        reflect: Vec3::ONE,
        ..Phong::default()
    });
    scene
}

#[test]
fn no_mirrored_ray_gets_out_of_a_closed_body() {
    let inside = dvec3(0.1, 0.1, 0.1);
    let with_mesh = |mesh: Mesh, scale: f64| {
        let mut scene = mirrors(scale * inside);
        scene.add_mesh(mesh, DAffine3::from_scale(DVec3::splat(scale)));
        scene
    };
    let with_canonical = |canonical: CanonicalShape| {
        let mut scene = mirrors(inside);
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical: DAffine3::IDENTITY,
            },
            material: 0,
            node: None,
            name: String::new(),
        });
        scene
    };
    let cone = CanonicalShape::Cone {
        bottom: 1.0,
        top: 0.0,
        capped: true,
    };
    let mut verdict = Verdict::on("closed mirrors");
    for (name, scene) in [
        ("tetrahedron", with_mesh(tetrahedron(), 1.0)),
        ("large tetrahedron", with_mesh(tetrahedron(), 1e4)),
        ("spiky ball", with_mesh(spiky(), 1.0)),
        ("box", with_canonical(CanonicalShape::Box)),
        ("cone", with_canonical(cone)),
    ] {
        let settings = RenderSettings {
            max_depth: 200,
            ..sized(128, 96)
        };
        let (_, stats) = render(&scene, &counting(&settings));
        let rays = stats.rays.expect("counts");
        let seen = format!("{rays:?}");
        let is_complete = rays.primary_hits == 128 * 96 && rays.reflection == 200 * rays.primary;
        verdict.that(
            format!("{name}: all rays are mirrored to the end"),
            is_complete,
            || seen.clone(),
        );
        let escaped = rays.reflection - rays.reflection_hits;
        verdict.that(format!("{name}: no ray escapes"), escaped == 0, || {
            format!("{escaped} do, of {seen}")
        });
    }
    verdict.close();
}
