//! Packing: the layout of the arrays that the GPU reads.

use crate::reference::scenes::{self, Build};
use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3, dvec3, vec3};
use glimray::layout::{
    LIGHT_POINT, LIGHT_SPOT, MATERIAL_TWO_SIDED, MATERIAL_TWO_SIDED_EMISSION, PackedLight,
    SHAPE_DISC, SHAPE_PLANE, SHAPE_RECTANGLE, SHAPE_SPHERE,
};
use glimray::pack::{self, PackError, PackedScene};
use glimray::scene::{
    Attenuation, CanonicalShape, Deformation, Geometry, Influences, Joint, Light, LightKind,
    Material, Mesh, MorphTarget, Phong, Scene, Shape, Skin,
};
use std::sync::Arc;

fn packed(scene: &Scene) -> PackedScene {
    pack::scene(scene).expect("a scene that can be packed")
}

#[test]
fn render_space_has_its_origin_at_the_camera() {
    let mut scene = scenes::empty();
    let eye = dvec3(1e7, -3e7, 2e7);
    scene.cameras[0].look_from = eye;
    scene.cameras[0].look_at = eye + DVec3::X;
    // f32 would round these positions to whole metres.
    scene.add_sphere(eye + dvec3(0.125, 0.25, -0.375), 0.5, 0);
    scene.add_mesh(
        scenes::quad(1.0, 0),
        DAffine3::from_translation(eye + dvec3(0.0, 0.0625, 0.0)),
    );
    scene.add_point_light(eye + dvec3(0.0, 0.03125, 0.0), 1.0);
    let packed = packed(&scene);
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    assert_eq!(packed.origin, eye);
    assert_eq!(view.frame.camera.origin, [0.0; 3]);
    assert_eq!(packed.shapes[0].position, [0.125, 0.25, -0.375]);
    assert_eq!(packed.triangles[0].v0, [-0.5, 0.0625, 0.5]);
    assert_eq!(view.lights[0].position, [0.0, 0.03125, 0.0]);
}

#[test]
fn another_camera_is_placed_relative_to_the_default_one() {
    let scene = scenes::spheres();
    let packed = packed(&scene);
    let mut frame = scene.frame(0.0);
    frame.camera.look_from += dvec3(1.0, 2.0, 3.0);
    let view = packed.frame(&frame).expect("a frame");
    assert_eq!(view.frame.camera.origin, [1.0, 2.0, 3.0]);
}

#[test]
fn planes_follow_the_bounded_shapes_and_all_keep_their_ids() {
    let mut scene = scenes::empty();
    for i in 0..20 {
        let x = f64::from(i);
        if i % 3 == 0 {
            scene.add_plane(dvec3(0.0, -x, 0.0), DVec3::Y, 0);
        } else {
            scene.add_sphere(dvec3(x, 0.0, 0.0), 0.1, 0);
        }
    }
    let packed = packed(&scene);
    assert_eq!((packed.plane_count, packed.bounded_shape_count()), (7, 13));
    let kinds: Vec<_> = packed.shapes.iter().map(|shape| shape.kind).collect();
    assert_eq!(
        kinds,
        [[SHAPE_SPHERE; 13].as_slice(), &[SHAPE_PLANE; 7]].concat()
    );
    let mut ids: Vec<_> = packed.shapes.iter().map(|shape| shape.id).collect();
    for shape in packed.shapes.iter() {
        assert_eq!(shape.kind == SHAPE_PLANE, shape.id % 3 == 0, "{shape:?}");
    }
    ids.sort_unstable();
    assert_eq!(ids, (0..20).collect::<Vec<_>>());
}

#[test]
fn a_plane_is_kept_by_its_point_nearest_to_the_camera() {
    let mut scene = scenes::empty();
    let normal = dvec3(1.0, 2.0, -2.0) / 3.0;
    // The point in the file is far away, where f32 would misplace the plane.
    let along = normal.any_orthonormal_vector();
    let eye = scene.cameras[0].look_from;
    scene.add_plane(eye + normal * 4.0 + along * 1e12, normal, 0);
    let shape = packed(&scene).shapes[0];
    let expected = (normal * 4.0).as_vec3();
    assert!(
        Vec3::from(shape.position).distance(expected) < 1e-3,
        "{shape:?}"
    );
    assert_eq!(shape.row_y, normal.as_vec3().to_array());
}

#[test]
fn every_triangle_and_sphere_is_packed_once() {
    let mut scene = scenes::everything();
    scene.add_mesh(
        scenes::torus(1.0, 0.3, UVec2::new(30, 20), 0),
        DAffine3::IDENTITY,
    );
    let packed = packed(&scene);
    assert_eq!(packed.triangles.len(), scene.triangle_count());
    let mut corners: Vec<_> = packed
        .triangles
        .iter()
        .map(|t| [t.i0, t.i1, t.i2])
        .collect();
    let mut first = 0;
    let mut expected = Vec::new();
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        expected.extend(mesh.triangles.iter().map(|t| t.map(|i| i + first)));
        first += mesh.positions.len() as u32;
    }
    corners.sort_unstable();
    expected.sort_unstable();
    assert_eq!(corners, expected);
    assert_eq!(packed.vertices.len(), first as usize);
}

#[test]
fn normals_go_by_the_inverse_transpose() {
    let spin = DAffine3::from_rotation_y(0.7) * DAffine3::from_rotation_x(-0.4);
    let mirror = DAffine3::from_scale(dvec3(-1.0, 1.0, 1.0));
    let uneven = DAffine3::from_scale(dvec3(0.2, 1.0, 5.0));
    let rows = [
        ("turned", spin),
        ("uneven", uneven),
        ("mirrored", mirror),
        (
            "all at once",
            spin * uneven * mirror * DAffine3::from_rotation_z(0.3),
        ),
        ("tiny", DAffine3::from_scale(DVec3::splat(1e-9))),
        (
            "turned inside out",
            DAffine3::from_scale(DVec3::splat(-1e6)),
        ),
    ];
    for (name, placement) in rows {
        let mut scene = scenes::empty();
        scene.add_mesh(scenes::ball(UVec2::new(16, 8), 0), placement);
        let packed = packed(&scene);
        // The ball becomes the ellipsoid |M⁻¹ p| = 1, whose gradient is M⁻ᵀ M⁻¹ p.
        let inverse = placement.matrix3.inverse();
        for (vertex, position) in packed.vertices.iter().zip(&scene.meshes[0].positions) {
            let p = placement.transform_vector3(position.as_dvec3());
            let gradient = (inverse.transpose() * (inverse * p)).normalize();
            let normal = Vec3::from(vertex.normal).as_dvec3();
            assert!(
                normal.distance(gradient) < 1e-5,
                "{name}: {normal}, expected {gradient}"
            );
            assert!(
                (normal.length() - 1.0).abs() < 1e-6,
                "{name}: {}",
                normal.length()
            );
            assert!(normal.dot(p) > 0.0, "{name}: a normal points inwards");
        }
    }
}

/// Backs emit if their material is two-sided and its emission too.
#[test]
fn backs_emit_where_two_keys_say_so() {
    let emits = |two_sided: bool, two_sided_emission: bool| {
        let mut scene = scenes::empty();
        scene.materials[0].two_sided = two_sided;
        scene.materials[0].two_sided_emission = two_sided_emission;
        packed(&scene).materials[0].flags & MATERIAL_TWO_SIDED_EMISSION != 0
    };
    let all = [(true, true), (true, false), (false, true), (false, false)];
    assert_eq!(all.map(|(a, b)| emits(a, b)), [true, false, false, false]);
}

#[test]
fn materials_keep_their_order_and_their_sides() {
    let mut scene = scenes::empty();
    scene.add_material(Material {
        two_sided: false,
        bsdf: Phong {
            diffuse: vec3(0.1, 0.2, 0.3),
            specular: vec3(0.4, 0.5, 0.6),
            shininess: 7.0,
            ambient: vec3(0.8, 0.9, 1.0),
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    });
    let [default, given] = packed(&scene).materials[..] else {
        panic!("two materials")
    };
    assert_eq!(default.flags & MATERIAL_TWO_SIDED, MATERIAL_TWO_SIDED);
    assert_eq!(given.flags & MATERIAL_TWO_SIDED, 0);
    assert_eq!(
        (given.diffuse, given.specular),
        ([0.1, 0.2, 0.3], [0.4, 0.5, 0.6])
    );
    assert_eq!((given.shininess, given.ambient), (7.0, [0.8, 0.9, 1.0]));
}

#[test]
fn mixed_materials_are_noticed() {
    assert!(!packed(&scenes::meshes()).features.mixed_materials);
    assert!(packed(&scenes::everything()).features.mixed_materials);
}

#[test]
fn a_dark_light_stands_in_where_there_is_none() {
    let mut scene = scenes::spheres();
    scene.lights.clear();
    let view = packed(&scene).frame(&scene.frame(0.0)).expect("a frame");
    assert_eq!(view.lights, [PackedLight::default()]);
    assert_eq!(view.frame.light_count, 1);
    assert_eq!(view.lights[0].color, [0.0; 3]);
}

#[test]
fn lights_keep_their_kind_and_cones_become_cosines() {
    let mut scene = scenes::empty();
    scene.add_point_light(DVec3::ZERO, 0.5);
    scene.lights.push(Light {
        kind: LightKind::Spot {
            position: DVec3::Y,
            direction: DVec3::NEG_Y,
            inner: 0.0,
            outer: std::f64::consts::FRAC_PI_3,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    });
    let view = packed(&scene).frame(&scene.frame(0.0)).expect("a frame");
    let [point, spot] = view.lights[..] else {
        panic!("two lights")
    };
    assert_eq!(
        (point.kind, point.color, point.attenuation),
        (LIGHT_POINT, [0.5; 3], 0)
    );
    assert_eq!(
        (spot.kind, spot.direction, spot.attenuation),
        (LIGHT_SPOT, [0.0, -1.0, 0.0], 1)
    );
    assert_eq!(spot.cos_inner, 1.0);
    assert!((spot.cos_outer - 0.5).abs() < 1e-7, "{}", spot.cos_outer);
}

#[test]
fn the_image_plane_is_as_high_as_the_field_of_view_and_as_wide_as_the_aspect() {
    let mut scene = scenes::empty();
    scene.cameras[0] = glimray::scene::Camera::default();
    let view = packed(&scene).frame(&scene.frame(0.0)).expect("a frame");
    let camera = view.with_aspect(300, 100).frame.camera;
    let half = (std::f32::consts::PI / 6.0).tan();
    assert_eq!(camera.forward, [0.0, 0.0, -1.0]);
    assert!(
        Vec3::from(camera.up).distance(vec3(0.0, half, 0.0)) < 1e-7,
        "{:?}",
        camera.up
    );
    assert!(
        Vec3::from(camera.right).distance(vec3(3.0 * half, 0.0, 0.0)) < 1e-6,
        "{:?}",
        camera.right
    );
}

#[test]
fn the_same_scene_packs_to_the_same_bytes() {
    let mut scene = scenes::everything();
    let hills = scenes::height_field(8.0, 100, 0, |x, z| (x * 2.0).sin() * (z * 3.0).cos());
    scene.add_mesh(hills, DAffine3::IDENTITY);
    let (a, b) = (packed(&scene), packed(&scene));
    assert!(a.nodes == b.nodes && a.triangles == b.triangles && a.shapes == b.shapes);
    assert!(a.vertices == b.vertices && a.materials == b.materials);
}

#[test]
fn coordinates_beyond_the_range_of_f32_arithmetic_are_refused() {
    let mut far = scenes::empty();
    far.add_sphere(dvec3(1e16, 0.0, 0.0), 1.0, 0);
    let mut large = scenes::empty();
    large.add_sphere(DVec3::ZERO, 1e16, 0);
    let mut mesh = scenes::empty();
    mesh.add_mesh(
        scenes::quad(1.0, 0),
        DAffine3::from_scale(DVec3::splat(1e17)),
    );
    for scene in [far, large, mesh] {
        let refusal = pack::scene(&scene).map(|_| ());
        assert!(
            matches!(refusal, Err(PackError::OutOfRange { .. })),
            "{refusal:?}"
        );
    }
    let mut light = scenes::empty();
    light.add_point_light(dvec3(0.0, 1e16, 0.0), 1.0);
    let refusal = packed(&light).frame(&light.frame(0.0));
    assert!(
        matches!(refusal, Err(PackError::OutOfRange { .. })),
        "{refusal:?}"
    );
}

#[test]
fn a_scene_without_geometry_packs_to_a_root_without_children() {
    let packed = packed(&scenes::empty());
    assert!(packed.nodes.iter().all(|node| *node == [0; 16]));
    assert!(!packed.nodes.is_empty());
    assert!(packed.triangles.is_empty() && packed.shapes.is_empty());
}

#[test]
fn u_and_v_of_a_plane_are_lengths_from_its_point_to_the_right_and_up() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // The normal, and the directions of u and v.
    let rows = [
        ("a floor", DVec3::Y, DVec3::X, DVec3::NEG_Z),
        ("a ceiling", DVec3::NEG_Y, DVec3::X, DVec3::Z),
        ("a wall in front", DVec3::Z, DVec3::X, DVec3::Y),
        ("a wall behind", DVec3::NEG_Z, DVec3::NEG_X, DVec3::Y),
        ("a wall to the left", DVec3::X, DVec3::NEG_Z, DVec3::Y),
        (
            "a roof that leans back",
            dvec3(0.0, 0.6, 0.8),
            DVec3::X,
            dvec3(0.0, 0.8, -0.6),
        ),
        (
            "a slope to the right",
            dvec3(half - 1e-3, half + 1e-3, 0.0).normalize(),
            dvec3(half + 1e-3, -half + 1e-3, 0.0).normalize(),
            DVec3::NEG_Z,
        ),
    ];
    for (name, normal, u, v) in rows {
        let point = dvec3(3.0, -4.0, 5.0);
        let mut scene = scenes::empty();
        scene.add_plane(point, normal, 0);
        let packed = pack::scene(&scene).expect("a scene");
        let plane = packed.shapes[0];
        let at = |p: DVec3| {
            let p = p - packed.origin;
            let along = |row: [f32; 3]| DVec3::from(row.map(f64::from)).dot(p);
            let (u, v) = (along(plane.row_x), along(plane.row_z));
            (u + f64::from(plane.size0), v + f64::from(plane.size1))
        };
        let (got_u, got_v) = at(point + 2.0 * u + 3.0 * v);
        assert!(
            (got_u - 2.0).abs() < 1e-5 && (got_v - 3.0).abs() < 1e-5,
            "{name}: {got_u}, {got_v}"
        );
    }
}

#[test]
fn cones_are_packed_as_wide_as_they_are_high() {
    let mut scene = scenes::empty();
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical: CanonicalShape::Cone {
                bottom: 0.5,
                top: 0.125,
                capped: true,
            },
            world_from_canonical: DAffine3::from_scale(dvec3(2.0, 3.0, 4.0)),
        },
        material: 0,
        node: None,
        name: String::new(),
    });
    let cone = pack::scene(&scene).expect("a scene").shapes[0];
    assert_eq!((cone.size0, cone.size1), (1.0, 0.25));
    assert_eq!(cone.row_x, [1.0, 0.0, 0.0]);
    assert_eq!(cone.row_y, [0.0, 1.0 / 3.0, 0.0]);
    assert_eq!(cone.row_z, [0.0, 0.0, 0.5]);
}

#[test]
fn a_shape_too_thin_for_f32_is_refused() {
    let mut scene = scenes::empty();
    scene.shapes.push(Shape {
        geometry: Geometry::Placed {
            canonical: CanonicalShape::Ellipsoid,
            world_from_canonical: DAffine3::from_scale(dvec3(1.0, 1e-16, 1.0)),
        },
        material: 0,
        node: None,
        name: String::new(),
    });
    let error = pack::scene(&scene).expect_err("too thin");
    insta::assert_snapshot!(error, @"object too small (scaled size): 1e-16 units in one direction is below the range of f32 arithmetic, at least 1e-15. Make it larger, or scale the scene up.");
}

#[test]
fn visible_lights_are_surfaces_that_shine_on_their_front() {
    let mut scene = scenes::spheres();
    let (materials, shapes) = (scene.materials.len(), packed(&scene).shapes.len());
    let center = dvec3(1.0, 4.0, 2.0);
    let lamp = |kind, visible| Light {
        kind,
        visible,
        color: vec3(3.0, 2.0, 1.0),
        attenuation: Attenuation::InverseSquare,
        samples: 4,
        node: None,
        name: String::new(),
    };
    let rectangle = LightKind::Rectangle {
        center,
        edge_u: DVec3::Z * 2.0,
        edge_v: DVec3::X,
    };
    let disc = LightKind::Disc {
        center,
        normal: DVec3::NEG_Z,
        radius: 0.5,
    };
    let sphere = LightKind::Sphere {
        center,
        radius: 0.5,
    };
    assert!(!packed(&scene).features.emission);
    scene.lights = vec![lamp(sphere, false)];
    let hidden = packed(&scene);
    assert!(!hidden.features.emission && hidden.shapes.len() == shapes);

    scene.lights = [rectangle, disc, sphere]
        .map(|kind| lamp(kind, true))
        .to_vec();
    let packed = packed(&scene);
    assert!(packed.features.emission);
    assert_eq!(packed.shapes.len(), shapes + 3);
    // (kind, radiance of colour 1, normal): π over the area, 1/r² for round ones.
    let expected = [
        (
            SHAPE_RECTANGLE,
            std::f32::consts::PI / 8.0,
            Some([0.0, 1.0, 0.0]),
        ),
        (SHAPE_DISC, 4.0, Some([0.0, 0.0, -1.0])),
        (SHAPE_SPHERE, 4.0, None),
    ];
    for (i, (kind, radiance, facing)) in expected.into_iter().enumerate() {
        let index = materials + i;
        let material = packed.materials[index];
        let off = Vec3::from(material.emission) - radiance * vec3(3.0, 2.0, 1.0);
        assert!(off.length() < 1e-5, "{material:?}");
        assert_eq!(
            (material.diffuse, material.specular, material.ambient),
            ([0.0; 3], [0.0; 3], [0.0; 3])
        );
        assert_eq!(material.flags & MATERIAL_TWO_SIDED, 0);
        let shape = packed
            .shapes
            .iter()
            .find(|shape| shape.material == index as u32);
        let shape = shape.expect("its surface");
        assert_eq!(shape.kind, kind);
        if let Some(facing) = facing {
            assert_eq!(Vec3::from(shape.row_y).normalize(), Vec3::from(facing));
        }
    }
}

#[test]
fn scenes_without_a_camera_are_refused() {
    let mut scene = scenes::spheres();
    let before = packed(&scene);
    // The index is of another scene's camera.
    scene.camera_index = 1;
    let others = [scene, Scene::default()];
    for scene in &others {
        for outcome in [pack::scene(scene), pack::scene_from(&before, scene)] {
            let error = outcome.expect_err("a refusal");
            assert!(matches!(error, PackError::NoCamera), "{error}");
            assert_eq!(
                error.to_string(),
                "scene refused (cameras): it has no camera to be seen by. Add one to `Scene::cameras`."
            );
        }
    }
}

#[test]
fn meshes_whose_arrays_do_not_fit_are_refused() {
    let refused = |spoil: fn(&mut Mesh)| {
        let mut scene = scenes::empty();
        let mut mesh = scenes::quad(1.0, 0);
        spoil(&mut mesh);
        scene.add_mesh(scenes::quad(1.0, 0), DAffine3::IDENTITY);
        scene.add_mesh(mesh, DAffine3::IDENTITY);
        match pack::scene(&scene) {
            Err(error @ PackError::Inconsistent { index: 1, .. }) => error.to_string(),
            other => panic!("{other:?}"),
        }
    };
    let told = refused(|mesh| mesh.normals.clear());
    assert!(told.contains("(mesh 1): it has 0 normals for 4 positions"));
    let told = refused(|mesh| mesh.uvs = vec![Vec2::ZERO; 3]);
    assert!(told.contains("it has 3 texture coordinates for 4 positions"));
    let told = refused(|mesh| mesh.triangles[1][2] = 4);
    assert!(told.contains("a triangle has vertex 4, and there are 4"));
    let told = refused(|mesh| mesh.materials[3] = 7);
    assert!(told.contains("a vertex has material 7, and the scene has 1"));
}

#[test]
fn deformations_that_do_not_fit_their_mesh_are_refused() {
    type Spoil = fn(&mut Deformation);
    let refused = |spoil: Spoil| {
        let mut scene = scenes::empty();
        scene.add_mesh(scenes::quad(1.0, 0), DAffine3::IDENTITY);
        let mut influences = Influences::default();
        (0..4).for_each(|_| influences.push([(0, 1.0)]));
        let mut deformation = Deformation {
            mesh: 0,
            targets: Arc::new([MorphTarget {
                vertices: vec![1, 3],
                positions: vec![Vec3::X; 2],
                ..MorphTarget::default()
            }]),
            weights: vec![0.0],
            skin: Some(Skin {
                joints: vec![Joint {
                    node: None,
                    node_from_mesh: DAffine3::IDENTITY,
                }],
                influences: Arc::new(influences),
            }),
            flat: Arc::default(),
        };
        spoil(&mut deformation);
        scene.deformations.push(deformation);
        match pack::scene(&scene) {
            Err(error @ PackError::Inconsistent { .. }) => error.to_string(),
            Err(error) => panic!("{error}"),
            Ok(_) => String::new(),
        }
    };
    fn target(deformation: &mut Deformation) -> &mut MorphTarget {
        &mut Arc::get_mut(&mut deformation.targets).expect("one owner")[0]
    }
    fn skin(deformation: &mut Deformation) -> &mut Skin {
        deformation.skin.as_mut().expect("a skin")
    }
    let rows: [(Spoil, &str); 11] = [
        (|_| (), ""),
        (|it| it.mesh = 1, "(mesh 1): it deforms, but does not exist"),
        (
            |it| it.weights.clear(),
            "(mesh 0): it has 0 weights for 1 morph targets",
        ),
        (
            |it| target(it).vertices[1] = 4,
            "a morph target moves vertex 4, and there are 4",
        ),
        (
            |it| target(it).vertices.swap(0, 1),
            "are not in ascending order",
        ),
        (
            |it| target(it).positions.clear(),
            "has 0 positions for 2 vertices",
        ),
        (
            |it| target(it).normals = vec![Vec3::X],
            "has 1 normals for 2 vertices",
        ),
        (
            |it| skin(it).joints.clear(),
            "a vertex follows joint 0, and there are 0",
        ),
        (
            |it| it.flat = Arc::new([0..3, 3..4]),
            "its flat triangles are not in ascending order, or not among 4 vertices",
        ),
        (
            |it| skin(it).joints[0].node = Some(2),
            "a joint follows node 2, and the scene has 0",
        ),
        (
            |it| skin(it).influences = Arc::default(),
            "its skin has influences for 0 vertices, and there are 4",
        ),
    ];
    for (spoil, expected) in rows {
        let told = refused(spoil);
        assert!(told.contains(expected), "{told}, not {expected}");
        assert_eq!(told.is_empty(), expected.is_empty(), "{told}");
    }
    let mut scene = scenes::empty();
    scene.add_mesh(scenes::quad(1.0, 0), DAffine3::IDENTITY);
    scene.deformations = vec![
        Deformation {
            mesh: 0,
            targets: Arc::default(),
            weights: Vec::new(),
            skin: None,
            flat: Arc::default(),
        };
        2
    ];
    let told = pack::scene(&scene)
        .expect_err("two of one mesh")
        .to_string();
    assert!(told.contains("not in the order of their meshes"), "{told}");
}
