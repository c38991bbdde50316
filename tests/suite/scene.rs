//! The host model: repaired meshes, bounds and counts.

use crate::reference::scenes::{self, Build};
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::scene::{Mesh, Repairs};

/// Two triangles of a unit square in the plane z = 0, without normals.
fn square() -> Mesh {
    Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y],
        materials: vec![0; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

#[test]
fn repair_leaves_a_good_mesh_as_it_is() {
    let mut mesh = scenes::ball(UVec2::new(12, 6), 0);
    let before = mesh.clone();
    assert_eq!(mesh.repair(), Repairs::default());
    assert_eq!(mesh.triangles, before.triangles);
    for (a, b) in mesh.normals.iter().zip(&before.normals) {
        assert!(a.distance(*b) < 1e-6);
    }
}

#[test]
fn triangles_without_area_are_dropped_and_counted() {
    let cases: [(&str, [Vec3; 3]); 5] = [
        ("one point", [Vec3::ONE; 3]),
        ("two points", [Vec3::ZERO, Vec3::X, Vec3::X]),
        (
            "collinear",
            [Vec3::ZERO, vec3(1.0, 2.0, 3.0), vec3(2.0, 4.0, 6.0)],
        ),
        (
            "thinner than rounding",
            [Vec3::ZERO, vec3(1e6, 0.0, 0.0), vec3(5e5, 1e-3, 0.0)],
        ),
        (
            "tiny and collinear",
            [Vec3::ZERO, Vec3::X * 1e-20, Vec3::X * 2e-20],
        ),
    ];
    for (name, corners) in cases {
        let mut mesh = square();
        mesh.positions.extend(corners);
        mesh.materials.extend([0; 3]);
        mesh.triangles.insert(1, [4, 5, 6]);
        let repairs = mesh.repair();
        assert_eq!(
            repairs,
            Repairs {
                dropped_triangles: 1,
                ..Repairs::default()
            },
            "{name}"
        );
        assert_eq!(mesh.triangles, square().triangles, "{name}");
    }
}

#[test]
fn triangles_with_vertices_that_do_not_exist_are_dropped_and_counted() {
    for unknown in [4, 1000, u32::MAX] {
        let mut mesh = square();
        mesh.triangles.push([unknown, 0, 1]);
        mesh.triangles.insert(1, [0, 1, unknown]);
        mesh.triangles.insert(0, [0, 1, 1]);
        let repairs = mesh.repair();
        assert_eq!(
            repairs,
            Repairs {
                dropped_triangles: 1,
                dangling_triangles: 2,
                recomputed_normals: 0
            },
            "{unknown}"
        );
        assert_eq!(mesh.triangles, square().triangles, "{unknown}");
        assert_eq!(mesh.normals, [Vec3::Z; 4], "{unknown}");

        let mut deforming = square();
        deforming.triangles.push([unknown, 0, 1]);
        let repairs = deforming.repair_normals();
        assert_eq!(repairs.dangling_triangles, 1, "{unknown}");
        assert_eq!(deforming.triangles, square().triangles, "{unknown}");
    }
    // Without vertices no triangle is left.
    let mut mesh = Mesh {
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    assert_eq!(mesh.repair().dangling_triangles, 1);
    assert!(mesh.triangles.is_empty());
}

#[test]
fn thin_and_tiny_triangles_stay() {
    let cases = [
        (
            "a sliver",
            [Vec3::ZERO, vec3(1.0, 0.0, 0.0), vec3(0.5, 1e-5, 0.0)],
        ),
        ("tiny", [Vec3::ZERO, Vec3::X * 1e-15, Vec3::Y * 1e-15]),
        ("huge", [Vec3::ZERO, Vec3::X * 1e15, Vec3::Y * 1e15]),
    ];
    for (name, corners) in cases {
        let mut mesh = Mesh {
            positions: corners.to_vec(),
            materials: vec![0; 3],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        assert_eq!(mesh.repair(), Repairs::default(), "{name}");
        assert_eq!(mesh.triangles.len(), 1, "{name}");
        assert!(
            mesh.normals.iter().all(|n| n.distance(Vec3::Z) < 1e-6),
            "{name}: {:?}",
            mesh.normals
        );
    }
}

#[test]
fn missing_normals_are_computed_silently() {
    let mut mesh = square();
    assert_eq!(mesh.repair(), Repairs::default());
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
}

#[test]
fn normals_without_length_are_recomputed_and_counted() {
    let mut mesh = square();
    mesh.normals = vec![Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::X * 5.0];
    let repairs = mesh.repair();
    assert_eq!(
        repairs,
        Repairs {
            recomputed_normals: 3,
            ..Repairs::default()
        }
    );
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::X]);
}

#[test]
fn normals_of_any_length_become_unit_vectors() {
    for length in [1e-20, 1e-3, 1.0, 1e10, 1e38] {
        let mut mesh = square();
        let given = vec3(0.6, 0.0, 0.8);
        mesh.normals = vec![given * length; 4];
        assert_eq!(mesh.repair(), Repairs::default(), "{length}");
        for normal in &mesh.normals {
            assert!(normal.distance(given) < 1e-6, "{length}: {normal}");
        }
    }
}

#[test]
fn recomputed_normals_are_weighted_by_area() {
    // A large triangle facing z and a small one facing x share the edge at the origin.
    let mut mesh = Mesh {
        positions: vec![
            Vec3::ZERO,
            Vec3::Y,
            vec3(-3.0, 0.0, 0.0),
            vec3(0.0, 0.0, -1.0),
        ],
        materials: vec![0; 4],
        triangles: vec![[0, 1, 2], [0, 3, 1]],
        ..Mesh::default()
    };
    mesh.repair();
    let expected = vec3(1.0, 0.0, 3.0).normalize();
    let facing = vec3(mesh.normals[0].x.abs(), 0.0, mesh.normals[0].z.abs());
    assert!(facing.distance(expected) < 1e-6, "{:?}", mesh.normals[0]);
    assert!(
        mesh.normals[2].abs().distance(Vec3::Z) < 1e-6,
        "one triangle only"
    );
}

#[test]
fn an_unused_vertex_gets_a_unit_normal_and_is_not_counted() {
    let mut mesh = square();
    mesh.positions.push(Vec3::ONE);
    mesh.materials.push(0);
    mesh.normals = vec![Vec3::Z, Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ZERO];
    assert_eq!(mesh.repair(), Repairs::default());
    assert!((mesh.normals[4].length() - 1.0).abs() < 1e-6);
}

#[test]
fn vertices_far_from_the_origin_are_kept_near_their_own() {
    let far = dvec3(1e7, 0.0, -2e7);
    let world = [
        far + dvec3(0.125, 0.0, 0.0),
        far + dvec3(-0.125, 0.25, 0.5),
        far,
    ];
    let (local, offset) = Mesh::from_world_positions(&world);
    for (local, world) in local.iter().zip(world) {
        assert_eq!(local.as_dvec3() + offset, world);
    }
    let near = [DVec3::ZERO, DVec3::ONE];
    assert_eq!(
        Mesh::from_world_positions(&near),
        (vec![Vec3::ZERO, Vec3::ONE], DVec3::ZERO)
    );
    assert_eq!(Mesh::from_world_positions(&[]), (vec![], DVec3::ZERO));
}

#[test]
fn bounds_contain_all_bounded_geometry() {
    let mut scene = scenes::empty();
    assert_eq!(scene.bounds(), None);
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    assert_eq!(scene.bounds(), None, "a plane has no bounds");
    scene.add_sphere(dvec3(1.0, 2.0, 3.0), 0.5, 0);
    assert_eq!(
        scene.bounds(),
        Some((dvec3(0.5, 1.5, 2.5), dvec3(1.5, 2.5, 3.5)))
    );
    let placement = DAffine3::from_translation(dvec3(10.0, 0.0, 0.0))
        * DAffine3::from_scale(dvec3(-2.0, 1.0, 1.0));
    scene.add_mesh(scenes::quad(2.0, 0), placement);
    assert_eq!(
        scene.bounds(),
        Some((dvec3(0.5, 0.0, -1.0), dvec3(12.0, 2.5, 3.5)))
    );
}

#[test]
fn triangles_count_once_for_each_instance() {
    let mut scene = scenes::empty();
    scene.add_mesh(scenes::quad(2.0, 0), DAffine3::IDENTITY);
    scene.instances.push(scene.instances[0].clone());
    assert_eq!(scene.triangle_count(), 4);
}

#[test]
fn a_frame_has_the_default_camera() {
    let mut scene = scenes::spheres();
    let mut other = scene.cameras[0].clone();
    other.fov_y = 0.3;
    scene.cameras.push(other);
    scene.camera_index = 1;
    let frame = scene.frame(0.0);
    assert_eq!(frame.camera.fov_y, 0.3);
    assert_eq!(
        (frame.lights, frame.background),
        (scene.lights.clone(), scene.background)
    );
    assert_eq!(frame.ambient, scene.ambient);
}
