//! Packing a scene from a similar one gives the same bytes as packing it anew: only changed parts get new trees
//! and are uploaded.

use crate::reference::compare::{open_gpu, sized};
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::image::Image;
use glimray::pack::{self, PackedScene, PackedView, TreeWork};
use glimray::render::{ExecutionPolicy, Fetch, Renderer, Tone, Uploads};
use glimray::scene::{
    Background, Beyond, Curve, Easing, Instance, Interpolation, Light, LightKind, Node,
    NodeProperty, Pattern, Scene, Shadows, Space, Target, Texture, Track, Values,
};
use std::sync::Arc;

fn packed(scene: &Scene) -> PackedScene {
    pack::scene(scene).expect("a scene that can be packed")
}

/// Both kinds of objects, and a visible lamp.
fn furnished() -> Scene {
    let mut scene = scenes::meshes();
    let material = scene.add_material(scenes::shiny(vec3(0.2, 0.7, 0.2)));
    scene.add_sphere(dvec3(1.0, 0.8, 0.3), 0.5, material);
    scene.lights.push(Light {
        kind: LightKind::Sphere {
            center: dvec3(0.0, 5.0, 0.0),
            radius: 0.5,
        },
        color: Vec3::ONE,
        visible: true,
        ..Light::default()
    });
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    scene
}

type Edit = fn(&mut Scene);

/// Whether both are the same to the GPU, and have the same names.
fn is_same(scene: &Scene, a: &PackedScene, b: &PackedScene) -> bool {
    let frames = scene.motion_samples(0.0, 0.0);
    let names = |packed: &PackedScene| (packed.material_name(0).map(str::to_owned), packed.origin);
    a.parts().concat() == b.parts().concat()
        && a.features == b.features
        && a.pictures == b.pictures
        && (a.plane_count, a.baked_shape_count) == (b.plane_count, b.baked_shape_count)
        && names(a) == names(b)
        && a.view(&frames).expect("a view") == b.view(&frames).expect("a view")
}

#[test]
fn changes_of_appearance_build_no_tree_and_give_the_bytes_of_a_full_pack() {
    let edits: [(&str, Edit); 10] = [
        ("a colour", |s| {
            s.materials[0].classical_mut().diffuse = vec3(0.1, 0.5, 0.9)
        }),
        ("a mirror", |s| {
            s.materials[1].classical_mut().reflect = Vec3::splat(0.5)
        }),
        ("glass", |s| {
            s.materials[1].classical_mut().transmit = Vec3::ONE;
            s.materials[1].classical_mut().ior = 1.5;
        }),
        ("a lamp's colour", |s| s.lights[0].color *= 2.0),
        ("a light's place", |s| {
            let last = s.lights.len() - 1;
            s.lights[last].kind = LightKind::Point {
                position: DVec3::ONE,
            };
        }),
        ("a background", |s| {
            s.background = Background::Color(Vec3::ONE)
        }),
        ("shadows through glass", |s| s.shadows = Shadows::Filtered),
        ("a texture", |s| {
            s.textures.push(Texture {
                pattern: Pattern::Checker {
                    a: Vec3::ONE,
                    b: Vec3::ZERO,
                },
                space: Space::World,
                pattern_from_space: glam::DAffine3::IDENTITY,
            });
            s.materials[0].classical_mut().textures.diffuse = Some(0);
        }),
        ("the camera", |s| s.cameras[0].fov_y *= 0.5),
        ("a name", |s| s.materials[0].name = "other".into()),
    ];
    let was = furnished();
    let before = packed(&was);
    let mut verdict = Verdict::on("edits that keep surfaces");
    for (name, edit) in edits {
        let mut scene = was.clone();
        edit(&mut scene);
        let again = pack::scene_from(&before, &scene).expect("packed");
        verdict.that(name, again.work == TreeWork::default(), || {
            format!("{:?}", again.work)
        });
        let is_same = is_same(&scene, &again, &packed(&scene));
        verdict.that(name, is_same, || "other bytes");
    }
    verdict.close();
}

/// Twelve balls too large for the joint tree, in two rows over a floor; a shape and a small mesh next to them.
fn gallery() -> Scene {
    let mut scene = scenes::empty();
    scene.add_material(scenes::shiny(vec3(0.7, 0.2, 0.1)));
    for i in 0..12 {
        let ball = scenes::ball(UVec2::new(48, 24 + i), i % 2);
        let place = dvec3(f64::from(i % 6) - 2.5, 0.4, f64::from(i / 6) * -1.5);
        scene.add_mesh(ball, at(place));
    }
    scene.add_mesh(scenes::quad(9.0, 0), DAffine3::IDENTITY);
    scene.add_mesh(scenes::torus(0.3, 0.1, UVec2::new(12, 8), 1), at(DVec3::Y));
    scene.add_sphere(dvec3(0.0, 1.5, 0.0), 0.3, 0);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    scene.nodes.push(Node {
        visible: false,
        ..Node::default()
    });
    scene.pin_render_origin();
    scene
}

fn at(place: DVec3) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        DVec3::splat(0.4),
        glam::DQuat::from_rotation_y(0.3),
        place,
    )
}

const TOP: TreeWork = TreeWork {
    topologies: 0,
    refits: 0,
    joint: 0,
    top: 1,
};
const ONE_REFIT: TreeWork = TreeWork { refits: 1, ..TOP };
const ONE_MESH: TreeWork = TreeWork {
    topologies: 1,
    ..ONE_REFIT
};
const JOINT: TreeWork = TreeWork { joint: 1, ..TOP };
const ONLY_JOINT: TreeWork = TreeWork {
    joint: 1,
    ..NOTHING
};
const NOTHING: TreeWork = TreeWork { top: 0, ..TOP };

/// Edits of a gallery, and the trees that each rebuilds.
const EDITS: [(&str, TreeWork, Edit); 13] = [
    ("the camera", NOTHING, |s| {
        s.cameras[0].look_from += dvec3(1.0, 2.0, 3.0);
    }),
    ("a material", NOTHING, |s| {
        s.materials[1].classical_mut().diffuse = Vec3::ONE
    }),
    ("a light", NOTHING, |s| s.lights[0].color *= 2.0),
    ("moved", ONE_REFIT, |s| {
        s.instances[5].placement.translation.y += 0.5;
    }),
    ("turned", ONE_REFIT, |s| {
        s.instances[6].placement *= DAffine3::from_rotation_x(0.5);
    }),
    ("hidden", TOP, |s| s.instances[4].node = Some(0)),
    ("removed", TOP, |s| _ = s.instances.remove(3)),
    ("another mesh", ONE_MESH, |s| {
        Arc::make_mut(&mut s.meshes[2]).positions[7] *= 1.1;
    }),
    ("added", ONE_MESH, |s| {
        s.add_mesh(
            scenes::ball(UVec2::new(60, 30), 0),
            at(dvec3(0.0, 2.0, 0.0)),
        );
    }),
    ("a copy", ONE_REFIT, |s| {
        let copy = Instance {
            placement: at(dvec3(0.5, 2.0, 0.0)),
            ..s.instances[1].clone()
        };
        s.instances.push(copy);
    }),
    ("a shape of few, which are in no tree", ONLY_JOINT, |s| {
        s.add_sphere(DVec3::Y, 0.1, 1);
    }),
    ("more shapes", JOINT, |s| {
        (0..5).for_each(|i| s.add_sphere(f64::from(i) * DVec3::Y, 0.1, 1));
    }),
    ("a small mesh", JOINT, |s| {
        let last = s.instances.len() - 1;
        s.instances[last].placement.translation.x -= 1.0;
    }),
];

#[test]
fn an_edit_rebuilds_only_affected_trees_and_gives_the_bytes_of_a_full_pack() {
    let was = gallery();
    let before = packed(&was);
    assert_eq!((before.work.topologies, before.work.refits), (12, 12));
    let mut verdict = Verdict::on("edits of a gallery");
    for (name, work, edit) in EDITS {
        let mut scene = was.clone();
        edit(&mut scene);
        let again = pack::scene_from(&before, &scene).expect("packed");
        verdict.that(name, again.work == work, || format!("{:?}", again.work));
        verdict.that(
            name,
            is_same(&scene, &again, &packed(&scene)),
            || "other bytes",
        );
        let back = pack::scene_from(&again, &was).expect("packed");
        verdict.that(name, back.work.topologies <= 1, || {
            format!("{:?}", back.work)
        });
        verdict.that(name, is_same(&was, &back, &before), || "another way back");
    }
    verdict.close();
}

#[test]
fn many_edits_one_after_the_other_leave_no_trace() {
    let mut random = Random::new(71);
    let mut scene = gallery();
    let mut before = packed(&scene);
    let mut verdict = Verdict::on("edits one after the other");
    for round in 0..40 {
        let (name, _, edit) = EDITS[random.below(EDITS.len())];
        if scene.instances.len() > 8 {
            edit(&mut scene);
        }
        let again = pack::scene_from(&before, &scene).expect("packed");
        let name = format!("{name} in round {round}");
        verdict.that(
            name,
            is_same(&scene, &again, &packed(&scene)),
            || "other bytes",
        );
        before = again;
    }
    verdict.close();
}

/// A gallery in which a sphere and a ball move.
fn moving_gallery() -> Scene {
    let mut scene = gallery();
    scene.nodes.push(Node::default());
    scene.shapes[0].node = Some(1);
    scene.instances[0].node = Some(1);
    scene.tracks = vec![Track {
        targets: vec![Target::Node(1, NodeProperty::Translation)],
        curve: Curve {
            times: vec![0.0, 1.0],
            values: Values::Vector(vec![DVec3::ZERO, DVec3::Y]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }];
    scene
}

#[test]
fn the_tree_over_instances_is_kept_as_long_as_nothing_moves() {
    let was = moving_gallery();
    let packed = packed(&was);
    let view = packed.view(&was.motion_samples(0.2, 0.4)).expect("a view");
    let from = |packed: &PackedScene, scene: &Scene, (open, close)| {
        let again = packed
            .view_from(Some(&view), &scene.motion_samples(open, close))
            .expect("a view");
        let whole = packed
            .view(&scene.motion_samples(open, close))
            .expect("a view");
        assert!(again == whole, "other bytes");
        again.shares_tlas(&view)
    };
    assert!(from(&packed, &was, (0.2, 0.4)));
    assert!(!from(&packed, &was, (0.2, 0.5)), "another shutter interval");
    let mut verdict = Verdict::on("edits beside what moves");
    for (name, work, edit) in EDITS {
        let mut scene = was.clone();
        edit(&mut scene);
        let again = pack::scene_from(&packed, &scene).expect("packed");
        let is_kept = from(&again, &scene, (0.2, 0.4));
        verdict.that(name, is_kept == (work == NOTHING), || is_kept);
        // Moving objects are not affected by edits of static ones.
        verdict.that(name, again.work.top == 0, || format!("{:?}", again.work));
    }
    verdict.close();
}

fn picture(renderer: &mut Renderer) -> Image {
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer.develop(&Tone::LINEAR).expect("a picture")
}

#[test]
fn only_what_differs_is_uploaded_and_the_picture_is_that_of_a_new_renderer() {
    let mut verdict = Verdict::on("uploads");
    for (fetch, was) in [
        (Fetch::Image, gallery()),
        (Fetch::Buffer, gallery()),
        (Fetch::Image, moving_gallery()),
    ] {
        let settings = sized(48, 36);
        let policy = ExecutionPolicy {
            fetch,
            ..ExecutionPolicy::default()
        };
        let packed = Arc::new(packed(&was));
        let view = packed.frame(&was.frame(0.3)).expect("a view");
        let new = |packed: &Arc<PackedScene>, view: &PackedView| {
            Renderer::new(open_gpu(), packed.clone(), view, settings.clone(), policy)
                .expect("a renderer")
        };
        let mut renderer = new(&packed, &view);
        for (edit_name, work, edit) in EDITS {
            let name = format!("{fetch:?} {edit_name}");
            let mut scene = was.clone();
            edit(&mut scene);
            let again = Arc::new(pack::scene_from(&packed, &scene).expect("packed"));
            let frame = scene.frame(0.3);
            let next = again.view_from(Some(&view), &[frame]).expect("a view");
            let before = renderer.stats().uploads;
            renderer
                .restart(again.clone(), &next, settings.clone(), policy)
                .expect("restarted");
            let uploads = since(before, renderer.stats().uploads);
            verdict.that(&name, uploads.frames > 0, || "no frame");
            if work == NOTHING {
                let is_frame = (uploads.geometry, uploads.tlas) == (0, 0);
                verdict.that(&name, is_frame, || format!("{uploads:?}"));
                let has_surfaces = uploads.surfaces > 0;
                verdict.that(&name, has_surfaces == name.contains("material"), || {
                    format!("{uploads:?}")
                });
            }
            if let "moved" | "turned" = edit_name {
                // The mesh's triangles and vertices, at most a node for two triangles, and the tree above.
                let own = |index: usize| {
                    let mesh = &scene.meshes[index];
                    48 * mesh.triangles.len()
                        + 16 * mesh.positions.len()
                        + 32 * mesh.triangles.len()
                };
                let most = own(5).max(own(6)) + 64 * 1024;
                let is_own = (1..most as u64).contains(&uploads.geometry);
                verdict.that(&name, is_own, || format!("{uploads:?}"));
            }
            let is_same = picture(&mut renderer) == picture(&mut new(&again, &next));
            verdict.that(&name, is_same, || "another picture");
            renderer
                .restart(packed.clone(), &view, settings.clone(), policy)
                .expect("restarted");
        }
        let is_same = picture(&mut renderer) == picture(&mut new(&packed, &view));
        verdict.that(format!("{fetch:?} back"), is_same, || "another picture");
    }
    verdict.close();
}

fn since(before: Uploads, after: Uploads) -> Uploads {
    Uploads {
        geometry: after.geometry - before.geometry,
        surfaces: after.surfaces - before.surfaces,
        tlas: after.tlas - before.tlas,
        frames: after.frames - before.frames,
    }
}

#[test]
fn another_camera_leaves_the_render_origin_where_it_is() {
    let mut scene = gallery();
    let before = packed(&scene);
    scene.cameras[0].look_from = dvec3(300.0, 20.0, 1.0);
    let after = packed(&scene);
    assert_eq!(before.origin, after.origin);
    assert!(before.parts() == after.parts());
    scene.render_origin = None;
    assert_eq!(packed(&scene).origin, dvec3(300.0, 20.0, 1.0));
}
