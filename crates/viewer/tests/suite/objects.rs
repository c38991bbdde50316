//! Edits of one object, and the outline that it is found in.

use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray::scene::*;
use glimray_viewer::model::objects;
use glimray_viewer::model::objects::{
    EditError, Id, assign, duplicate, freedom, is_visible, place, remove, set_place, set_visible,
};
use glimray_viewer::model::outline::{Outline, label};
use std::sync::Arc;

const SHAPE: Id = Id::Object(ObjectRef::Shape(0));
const INSTANCE: Id = Id::Object(ObjectRef::Instance(0));

fn light(kind: LightKind) -> Light {
    Light {
        kind,
        color: Vec3::ONE,
        ..Light::default()
    }
}

/// A sphere, a plane, a mesh, a light of every kind, and a node that goes round.
fn scene() -> Scene {
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let mesh = Mesh {
        name: "sail".to_owned(),
        positions: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
        normals: vec![Vec3::Z; 3],
        materials: vec![0; 3],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    let shape = |geometry| Shape {
        geometry,
        material: 1,
        node: None,
        name: String::new(),
    };
    Scene {
        materials: ["", "glass"]
            .map(|name| Material {
                name: name.to_owned(),
                ..Material::default()
            })
            .to_vec(),
        cameras: vec![Camera::default(); 2],
        meshes: vec![Arc::new(mesh)],
        instances: vec![
            Instance {
                mesh: 0,
                placement: DAffine3::from_translation(DVec3::X),
                node: Some(0),
                name: String::new(),
            },
            Instance {
                mesh: 0,
                placement: DAffine3::IDENTITY,
                node: None,
                name: String::new(),
            },
        ],
        shapes: vec![
            shape(Geometry::Sphere {
                center: DVec3::new(1.0, 2.0, 3.0),
                radius: 0.5,
            }),
            shape(Geometry::Plane {
                point: DVec3::ZERO,
                normal: DVec3::Y,
            }),
            shape(Geometry::Sphere {
                center: DVec3::ZERO,
                radius: 2.0,
            }),
        ],
        lights: vec![
            light(LightKind::Point { position: DVec3::Y }),
            light(LightKind::Directional {
                direction: DVec3::NEG_Y,
            }),
            light(LightKind::Spot {
                position: DVec3::Y,
                direction: DVec3::X,
                inner: 0.1,
                outer: 0.2,
            }),
            light(LightKind::Rectangle {
                center: DVec3::Y,
                edge_u: DVec3::X,
                edge_v: 2.0 * DVec3::Z,
            }),
            light(LightKind::Disc {
                center: DVec3::Y,
                normal: DVec3::NEG_Y,
                radius: 0.3,
            }),
            light(LightKind::Sphere {
                center: DVec3::Y,
                radius: 0.3,
            }),
        ],
        nodes: vec![Node {
            name: "wheel".to_owned(),
            placement: DAffine3::from_translation(DVec3::Z),
            ..Node::default()
        }],
        tracks: vec![
            Track {
                targets: vec![Target::Node(0, NodeProperty::Angles)],
                curve: linear(DVec3::ZERO, DVec3::Y * std::f64::consts::TAU),
            },
            Track {
                targets: vec![Target::Light(2, LightProperty::Position)],
                curve: linear(DVec3::Y, DVec3::X),
            },
        ],
        ..Scene::default()
    }
}

fn linear(from: DVec3, to: DVec3) -> Curve {
    Curve {
        times: vec![0.0, 8.0],
        values: Values::Vector(vec![from, to]),
        interpolation: Interpolation::Linear,
        easing: Easing::None,
        beyond: Beyond::Hold,
    }
}

fn nearly(a: DAffine3, b: DAffine3) -> bool {
    a.abs_diff_eq(b, 1e-12)
}

#[test]
fn an_object_is_found_where_it_was_put_whatever_carries_it() {
    let wanted = DAffine3::from_scale_rotation_translation(
        DVec3::new(0.5, 2.0, 3.0),
        DQuat::from_rotation_x(0.7),
        DVec3::new(-3.0, 0.2, 5.0),
    );
    for time in [0.0, 1.0, 2.7] {
        for id in [SHAPE, INSTANCE, Id::Object(ObjectRef::Instance(1))] {
            let mut scene = scene();
            set_place(&mut scene, id, wanted, time).expect("free");
            let found = place(&scene, id, time).expect("placed");
            assert!(nearly(found, wanted), "{id:?} at {time}: {found:?}");
        }
    }
    // A carried object goes on being carried: half a turn later it is across the wheel's axis.
    let mut scene = scene();
    set_place(
        &mut scene,
        INSTANCE,
        DAffine3::from_translation(DVec3::X),
        0.0,
    )
    .expect("free");
    let later = place(&scene, INSTANCE, 4.0).expect("placed").translation;
    assert!(
        later.abs_diff_eq(DVec3::new(-1.0, 0.0, 2.0), 1e-12),
        "{later}"
    );
}

#[test]
fn numbers_that_are_typed_stay_as_they_were_typed() {
    let mut scene = scene();
    let transform = Transform {
        translate: DVec3::new(0.1, 0.2, 0.3),
        rotate_deg: DVec3::new(0.0, 27.0, 0.0),
        scale: DVec3::splat(1.5),
    };
    let id = Id::Object(ObjectRef::Instance(1));
    set_place(&mut scene, id, transform.affine(), 0.0).expect("free");
    assert_eq!(scene.instances[1].placement, transform.affine());
    let moved = DAffine3::from_scale_rotation_translation(
        DVec3::splat(0.5),
        DQuat::IDENTITY,
        DVec3::new(0.1, 0.2, 0.3),
    );
    set_place(&mut scene, SHAPE, moved, 0.0).expect("free");
    let sphere = Geometry::Sphere {
        center: DVec3::new(0.1, 0.2, 0.3),
        radius: 0.5,
    };
    assert_eq!(scene.shapes[0].geometry, sphere);
}

#[test]
fn transforms_tell_every_map_without_a_slant() {
    let mut random = crate::support::random::Random::new(4);
    let mut between = |low, high| DVec3::from([(); 3].map(|()| random.between(low, high)));
    for i in 0..500 {
        let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
        let given = Transform {
            translate: between(-5.0, 5.0),
            rotate_deg: between(-180.0, 180.0),
            scale: between(0.1, 4.0) * DVec3::new(sign, 1.0, 1.0),
        };
        let (found, is_same) = Transform::of(given.affine());
        assert!(
            is_same && found.affine().abs_diff_eq(given.affine(), 1e-9),
            "{given:?}"
        );
        assert!((found.scale - given.scale).abs().max_element() < 1e-9);
    }
    // Straight up and down, where two angles turn about the same axis.
    for y in [90.0, -90.0] {
        let given = Transform {
            rotate_deg: DVec3::new(20.0, y, 30.0),
            ..Transform::default()
        };
        let (found, is_same) = Transform::of(given.affine());
        assert!(
            is_same && found.affine().abs_diff_eq(given.affine(), 1e-9),
            "{found:?}"
        );
    }
    let slanted = glam::DMat3::from_cols(DVec3::X, DVec3::new(0.5, 1.0, 0.0), DVec3::Z);
    assert!(!Transform::of(DAffine3::from_mat3(slanted)).1);
}

#[test]
fn lights_take_the_freedoms_that_they_have_and_refuse_others_with_words() {
    let id = |index| Id::Object(ObjectRef::Light(index));
    let by = |scene: &Scene, index, change: DAffine3| {
        place(scene, id(index), 0.0).expect("placed") * change
    };
    let turn = DAffine3::from_rotation_x(0.5);
    let grow = DAffine3::from_scale(DVec3::splat(2.0));
    let stretch = DAffine3::from_scale(DVec3::new(2.0, 1.0, 1.0));
    let shift = DAffine3::from_translation(DVec3::X);
    // Point, directional, spot (whose position is animated), rectangle, disc, sphere.
    let allowed = [
        [true, false, false, false],
        [false, true, false, false],
        [false, true, false, false],
        [true, true, true, true],
        [true, true, true, false],
        [true, false, true, false],
    ];
    for (index, row) in allowed.into_iter().enumerate() {
        for (change, is_allowed) in [shift, turn, grow, stretch].into_iter().zip(row) {
            let mut scene = scene();
            let before = scene.clone();
            let wanted = by(&scene, index, change);
            match set_place(&mut scene, id(index), wanted, 0.0) {
                Ok(()) => assert!(is_allowed && scene != before, "{index} {change:?}"),
                Err(error) => {
                    assert!(
                        !is_allowed && scene == before,
                        "{index} {change:?}: {error}"
                    );
                    assert!(error.to_string().ends_with('.'));
                }
            }
        }
    }
    let mut scene = scene();
    let wanted = by(&scene, 2, shift);
    let error = set_place(&mut scene, id(2), wanted, 0.0).expect_err("animated");
    assert_eq!(
        error,
        EditError::Animated {
            property: "position"
        }
    );
    assert!(!freedom(&scene, id(2)).translate);
}

#[test]
fn a_light_that_is_moved_keeps_its_shape_to_the_last_digit() {
    for index in [0, 3, 4, 5] {
        let mut scene = scene();
        scene.lights[index].node = Some(0);
        let id = Id::Object(ObjectRef::Light(index));
        let mut wanted = place(&scene, id, 1.0).expect("placed");
        wanted.translation += DVec3::new(0.1, 0.2, 0.3);
        let before = objects::of_light(&scene.lights[index].kind).matrix3;
        set_place(&mut scene, id, wanted, 1.0).expect("free");
        assert_eq!(objects::of_light(&scene.lights[index].kind).matrix3, before);
        assert!(
            nearly(place(&scene, id, 1.0).expect("placed"), wanted),
            "light {index}"
        );
    }
}

#[test]
fn animated_nodes_refuse_what_their_keys_set_and_take_the_rest() {
    let mut scene = scene();
    let node = Id::Node(0);
    let old = place(&scene, node, 1.0).expect("placed");
    let moved = DAffine3::from_translation(DVec3::new(0.0, 3.0, 0.0)) * old;
    set_place(&mut scene, node, moved, 1.0).expect("nothing moves it");
    assert!(nearly(place(&scene, node, 1.0).expect("placed"), moved));
    let turned = moved * DAffine3::from_rotation_x(0.3);
    let error = set_place(&mut scene, node, turned, 1.0).expect_err("keys turn it");
    assert_eq!(
        error,
        EditError::Animated {
            property: "rotation"
        }
    );
    assert!(nearly(place(&scene, node, 1.0).expect("placed"), moved));
}

#[test]
fn what_would_leave_nothing_or_is_not_there_is_refused() {
    let mut scene = scene();
    let before = scene.clone();
    let flat = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
    let far = DAffine3::from_translation(DVec3::splat(1e39));
    let none = DAffine3::from_translation(DVec3::splat(f64::NAN));
    for bad in [flat, far, none] {
        assert_eq!(set_place(&mut scene, SHAPE, bad, 0.0), Err(EditError::Flat));
    }
    let gone = Id::Object(ObjectRef::Shape(7));
    assert_eq!(
        set_place(&mut scene, gone, DAffine3::IDENTITY, 0.0),
        Err(EditError::Gone)
    );
    assert_eq!(remove(&mut scene, &[gone]), Err(EditError::Gone));
    assert_eq!(set_visible(&mut scene, gone, false), Err(EditError::Gone));
    assert_eq!(scene, before);
}

#[test]
fn what_is_hidden_is_neither_packed_nor_lost_in_a_file() {
    let mut scene = scene();
    let all = glimray::pack::scene(&scene).expect("packed");
    let plane = Id::Object(ObjectRef::Shape(1));
    for id in [SHAPE, plane, Id::Object(ObjectRef::Light(0))] {
        set_visible(&mut scene, id, false).expect("hidden");
        assert!(!is_visible(&scene, id));
    }
    assert_eq!(scene.nodes.len(), 2, "one node hides them all");
    let packed = glimray::pack::scene(&scene).expect("packed");
    assert_eq!((all.plane_count, packed.plane_count), (1, 0));
    assert_eq!(all.baked_shape_count - packed.baked_shape_count, 1);
    assert_eq!(scene.frame(0.0).lights[0].color, Vec3::ZERO);

    let export = glimray::export::native(&scene, "s", &|_, _| false).expect("an export");
    let folder = tempfile::tempdir().expect("a folder");
    for file in &export.files {
        std::fs::write(folder.path().join(&file.name), &file.bytes).expect("a file");
    }
    let path = folder.path().join("s.toml");
    std::fs::write(&path, &export.text).expect("a file");
    let mut read = glimray::import::load(&path).expect("a scene");
    assert_eq!(
        (read.shapes.clone(), read.lights.len()),
        (scene.shapes.clone(), 6)
    );
    for scene in [&mut scene, &mut read] {
        for id in [SHAPE, plane, Id::Object(ObjectRef::Light(0))] {
            set_visible(scene, id, true).expect("shown");
            assert!(is_visible(scene, id));
        }
        assert_eq!(scene.nodes.len(), 1, "what hid them is gone");
    }
    assert_eq!(scene.shapes, self::scene().shapes);
}

#[test]
fn what_hangs_on_something_hidden_says_so() {
    let mut scene = scene();
    set_visible(&mut scene, Id::Node(0), false).expect("hidden");
    assert!(!is_visible(&scene, INSTANCE));
    let error = set_visible(&mut scene, INSTANCE, true).expect_err("carried");
    let carrier = "wheel".to_owned();
    assert_eq!(error, EditError::CarrierHidden { carrier });
}

#[test]
fn what_is_removed_takes_its_tracks_along_and_others_keep_theirs() {
    let mut scene = scene();
    remove(&mut scene, &[Id::Object(ObjectRef::Light(0))]).expect("removed");
    assert_eq!(
        scene.tracks[1].targets,
        [Target::Light(1, LightProperty::Position)]
    );
    remove(&mut scene, &[Id::Object(ObjectRef::Light(1))]).expect("removed");
    assert_eq!((scene.lights.len(), scene.tracks.len()), (4, 1));
    scene.camera_index = 1;
    remove(&mut scene, &[Id::Camera(0)]).expect("removed");
    assert_eq!(scene.camera_index, 0);
    let last = EditError::Last { what: "camera" };
    assert_eq!(remove(&mut scene, &[Id::Camera(0)]), Err(last));
    remove(&mut scene, &[SHAPE]).expect("removed");
    assert_eq!(scene.shapes.len(), 2);
}

#[test]
fn a_duplicate_is_where_the_original_is_and_moves_as_it_does() {
    let mut scene = scene();
    for id in [SHAPE, INSTANCE, Id::Object(ObjectRef::Light(2))] {
        let copy = duplicate(&mut scene, id).expect("a copy");
        assert_ne!(copy, id);
        for time in [0.0, 3.0] {
            assert_eq!(place(&scene, copy, time), place(&scene, id, time), "{id:?}");
        }
    }
}

#[test]
fn a_material_goes_to_one_object_even_where_its_mesh_stands_elsewhere_too() {
    let mut scene = scene();
    assign(&mut scene, ObjectRef::Shape(0), 0).expect("assigned");
    assert_eq!(scene.shapes[0].material, 0);
    assign(&mut scene, ObjectRef::Instance(0), 1).expect("assigned");
    let of =
        |scene: &Scene, index: usize| scene.meshes[scene.instances[index].mesh].materials.clone();
    assert_eq!((of(&scene, 0), of(&scene, 1)), (vec![1; 3], vec![0; 3]));
    // Alone on its mesh it needs no other copy.
    assign(&mut scene, ObjectRef::Instance(0), 0).expect("assigned");
    assert_eq!((of(&scene, 0), scene.meshes.len()), (vec![0; 3], 2));
    assert!(assign(&mut scene, ObjectRef::Light(0), 0).is_err());
    assert_eq!(
        assign(&mut scene, ObjectRef::Shape(0), 9),
        Err(EditError::Gone)
    );
}

#[test]
fn the_outline_lists_everything_once_below_what_carries_it() {
    let mut scene = scene();
    set_visible(&mut scene, SHAPE, false).expect("hidden");
    let outline = Outline::of(&scene);
    let lines: Vec<_> = (outline.entries.iter())
        .map(|entry| {
            let mark = if entry.visible { "" } else { " (hidden)" };
            format!("{}{}{mark}", "  ".repeat(entry.depth), entry.label)
        })
        .collect();
    assert_eq!(
        lines,
        [
            "Objects",
            "  wheel",
            "    sail 1 (material 1)",
            "  sail 2 (material 1)",
            "  sphere 1 (glass) (hidden)",
            "  plane 1 (glass)",
            "  sphere 2 (glass)",
            "Lights",
            "  point light 1",
            "  directional light 1",
            "  spot light 1",
            "  rectangle light 1",
            "  disc light 1",
            "  sphere light 1",
            "Cameras",
            "  camera 1",
            "  camera 2",
            "Materials",
            "  material 1",
            "  glass",
        ]
    );
    assert_eq!(label(&scene, INSTANCE), "sail 1 (material 1)");
    assert_eq!(outline.position(INSTANCE), Some(2));
    let found = |query: &str| outline.search(query);
    assert_eq!(found("SAIL 1"), [0, 1, 2, 3]);
    assert_eq!(found("sphere glass"), [0, 4, 6]);
    assert_eq!(found("nothing"), [0; 0]);
    assert_eq!(found(" ").len(), outline.entries.len());
}

#[test]
fn the_bounds_of_one_object_are_those_of_its_points() {
    let scene = scene();
    let bounds = |object, time| scene.bounds_of(object, time);
    let near = |found: Option<(DVec3, DVec3)>, min: [f64; 3], max: [f64; 3]| {
        let (low, high) = found.expect("bounded");
        assert!(
            low.abs_diff_eq(min.into(), 1e-9) && high.abs_diff_eq(max.into(), 1e-9),
            "{low} {high}"
        );
    };
    near(
        bounds(ObjectRef::Shape(0), 0.0),
        [0.5, 1.5, 2.5],
        [1.5, 2.5, 3.5],
    );
    near(
        bounds(ObjectRef::Instance(0), 0.0),
        [1.0, 0.0, 1.0],
        [2.0, 1.0, 1.0],
    );
    near(
        bounds(ObjectRef::Instance(0), 4.0),
        [-2.0, 0.0, 1.0],
        [-1.0, 1.0, 1.0],
    );
    near(
        bounds(ObjectRef::Light(4), 0.0),
        [-0.3, 1.0, -0.3],
        [0.3, 1.0, 0.3],
    );
    near(
        bounds(ObjectRef::Light(3), 0.0),
        [-1.0, 1.0, -2.0],
        [1.0, 1.0, 2.0],
    );
    assert_eq!(bounds(ObjectRef::Shape(1), 0.0), None);
    assert_eq!(bounds(ObjectRef::Shape(99), 0.0), None);
}

#[test]
fn the_bounds_of_many_instances_are_those_of_all_their_vertices() {
    let mut random = crate::support::random::Random::new(8);
    for _ in 0..20 {
        let mut scene = scene();
        let mut between = |low, high| DVec3::from([(); 3].map(|()| random.between(low, high)));
        let positions = (0..50).map(|_| between(-1.0, 1.0).as_vec3()).collect();
        scene.shapes.clear();
        scene.meshes = vec![Arc::new(Mesh {
            positions,
            ..Mesh::default()
        })];
        scene.instances = (0..200)
            .map(|_| Instance {
                mesh: 0,
                placement: Transform {
                    translate: between(-4.0, 4.0),
                    rotate_deg: between(-180.0, 180.0),
                    scale: between(0.1, 2.0),
                }
                .affine(),
                node: None,
                name: String::new(),
            })
            .collect();
        let points = scene.instances.iter().flat_map(|instance| {
            let positions = &scene.meshes[0].positions;
            let placed = |p: &Vec3| instance.placement.transform_point3(p.as_dvec3());
            positions.iter().map(placed).collect::<Vec<_>>()
        });
        let all = points
            .map(|p| (p, p))
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        assert_eq!(scene.bounds(), all);
    }
}

#[test]
fn a_node_is_not_moved_into_itself_and_a_hidden_object_stays_hidden_in_another_node() {
    let mut scene = scene();
    for name in ["arm", "hand"] {
        scene.nodes.push(Node {
            name: name.to_owned(),
            parent: Some(scene.nodes.len() - 1),
            translation: DVec3::X,
            ..Node::default()
        });
    }
    let before = scene.clone();
    let error = objects::set_parent(&mut scene, Id::Node(1), Some(2), 0.0).expect_err("a circle");
    assert!(error.to_string().contains("into itself"), "{error}");
    assert_eq!(scene, before);
    let at = place(&scene, Id::Node(2), 0.0).expect("a place");
    objects::set_parent(&mut scene, Id::Node(2), None, 0.0).expect("free");
    assert_eq!(scene.nodes[2].parent, None);
    assert!(nearly(
        place(&scene, Id::Node(2), 0.0).expect("a place"),
        at
    ));
    set_visible(&mut scene, SHAPE, false).expect("hidden");
    let at = place(&scene, SHAPE, 0.0).expect("a place");
    objects::set_parent(&mut scene, SHAPE, Some(2), 0.0).expect("free");
    assert!(!is_visible(&scene, SHAPE));
    assert!(nearly(place(&scene, SHAPE, 0.0).expect("a place"), at));
    set_visible(&mut scene, SHAPE, true).expect("shown");
    assert_eq!(scene.shapes[0].node, Some(2));
}

/// Moved into a rotated node, a sphere has the same points, so it needs no matrix; a texture in u and v would
/// turn with it, and an uneven node would squeeze it.
#[test]
fn a_sphere_moved_into_a_rotated_node_stays_a_sphere() {
    let sphere = Geometry::Sphere {
        center: DVec3::new(1.0, 2.0, 3.0),
        radius: 0.5,
    };
    let turned = |scale: DVec3| {
        let mut scene = Scene {
            cameras: vec![Camera::default()],
            materials: vec![Material::default()],
            shapes: vec![Shape {
                geometry: sphere,
                material: 0,
                node: None,
                name: String::new(),
            }],
            ..Scene::default()
        };
        scene.nodes.push(Node {
            placement: DAffine3::from_scale_rotation_translation(
                scale,
                DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7),
                DVec3::new(-1.0, 0.25, 4.0),
            ),
            ..Node::default()
        });
        scene
    };
    let mut scene = turned(DVec3::splat(2.0));
    objects::set_parent(&mut scene, SHAPE, Some(0), 0.0).expect("free");
    let Geometry::Sphere { center, radius } = scene.shapes[0].geometry else {
        panic!("{:?}", scene.shapes[0].geometry);
    };
    assert!((radius - 0.25).abs() < 1e-12, "{radius}");
    let center = scene.nodes[0].placement.transform_point3(center);
    assert!(center.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-12);

    let mut uneven = turned(DVec3::new(1.0, 2.0, 1.0));
    let at = place(&uneven, SHAPE, 0.0).expect("a place");
    objects::set_parent(&mut uneven, SHAPE, Some(0), 0.0).expect("free");
    assert!(nearly(place(&uneven, SHAPE, 0.0).expect("a place"), at));

    let mut mapped = turned(DVec3::ONE);
    mapped.textures.push(Texture {
        pattern: Pattern::Checker {
            a: Vec3::ZERO,
            b: Vec3::ONE,
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::IDENTITY,
    });
    mapped.materials[0].classical_mut().textures.diffuse = Some(0);
    objects::set_parent(&mut mapped, SHAPE, Some(0), 0.0).expect("free");
    assert!(nearly(place(&mapped, SHAPE, 0.0).expect("a place"), at));
}

#[test]
fn swatches_show_what_a_material_reflects_and_transmits() {
    use glimray_viewer::model::swatch::Swatch;
    // Nearly black but for its reflection, as metals are.
    let gold = Swatch::of(&Material::from(Phong {
        diffuse: Vec3::new(0.05, 0.03, 0.01),
        specular: Vec3::ZERO,
        reflect: Vec3::new(0.95, 0.7, 0.3),
        ..Phong::default()
    }));
    assert!(gold.is_glossy && !gold.is_clear);
    let [r, g, b] = gold.color.to_array();
    assert!(
        r > 0.9 && (0.6..0.85).contains(&g) && b < 0.45,
        "{r} {g} {b}"
    );
    let glass = Swatch::of(&Material::from(Phong {
        diffuse: Vec3::ZERO,
        transmit: Vec3::new(0.8, 0.9, 0.85),
        ..Phong::default()
    }));
    assert!(glass.is_clear);
    assert!(glass.color.min_element() > 0.7);
    let matte = Swatch::of(&Material::from(Phong {
        diffuse: Vec3::new(0.2, 0.4, 0.1),
        specular: Vec3::ZERO,
        ..Phong::default()
    }));
    assert_eq!(matte.color, Vec3::new(0.2, 0.4, 0.1));
    assert!(!matte.is_glossy && !matte.is_clear);
}
