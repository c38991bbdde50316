//! Scenes whose surfaces only look different are packed without building trees, to the same bytes.

use crate::reference::scenes::{self, Build};
use crate::support::verdict::Verdict;
use glam::{DVec3, Vec3, dvec3, vec3};
use glimray::pack::{self, PackedScene};
use glimray::scene::{Background, Light, LightKind, Pattern, Scene, Shadows, Space, Texture};
use std::sync::Arc;

fn packed(scene: &Scene) -> PackedScene {
    pack::scene(scene).expect("a scene that can be packed")
}

/// Both kinds of objects, and a lamp that rays see.
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

#[test]
fn what_only_looks_different_is_packed_to_the_same_bytes_without_a_tree() {
    let edits: [(&str, Edit); 9] = [
        ("a colour", |s| s.materials[0].diffuse = vec3(0.1, 0.5, 0.9)),
        ("a mirror", |s| s.materials[1].reflect = Vec3::splat(0.5)),
        ("glass", |s| {
            s.materials[1].transmit = Vec3::ONE;
            s.materials[1].ior = 1.5;
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
            s.materials[0].textures.diffuse = Some(0);
        }),
        ("a name", |s| s.materials[0].name = "other".into()),
    ];
    let was = furnished();
    let before = packed(&was);
    let mut verdict = Verdict::on("edits that keep surfaces");
    for (name, edit) in edits {
        let mut scene = was.clone();
        edit(&mut scene);
        let whole = packed(&scene);
        let Some(quick) = before.with_surfaces(&was, &scene).expect("no limit") else {
            verdict.that(name, false, || "packed anew");
            continue;
        };
        let frames = scene.shot(0.0, 0.0);
        let is_same = quick.parts() == whole.parts()
            && quick.features == whole.features
            && quick.pictures == whole.pictures
            && quick.material_name(0) == whole.material_name(0)
            && quick.shot(&frames).expect("a view") == whole.shot(&frames).expect("a view");
        verdict.that(name, is_same, || "other bytes");
    }
    verdict.close();
}

#[test]
fn what_stands_elsewhere_is_packed_anew() {
    let edits: [(&str, Edit); 7] = [
        ("a shape", |s| {
            s.shapes.last_mut().expect("one").material = 0
        }),
        ("an instance", |s| {
            s.instances[0].placement.translation.x += 1.0;
        }),
        ("a mesh", |s| {
            Arc::make_mut(&mut s.meshes[0]).positions[0].x += 0.5;
        }),
        ("a lamp", |s| {
            s.lights.iter_mut().for_each(|light| {
                if let LightKind::Sphere { radius, .. } = &mut light.kind {
                    *radius = 0.75;
                }
            })
        }),
        ("a hidden lamp", |s| {
            s.lights.iter_mut().for_each(|light| light.visible = false);
        }),
        ("the camera", |s| s.cameras[0].look_from.x += 1.0),
        ("one more material", |s| {
            s.add_material(scenes::shiny(Vec3::ONE));
        }),
    ];
    let was = furnished();
    let before = packed(&was);
    let mut verdict = Verdict::on("edits that change surfaces");
    for (name, edit) in edits {
        let mut scene = was.clone();
        edit(&mut scene);
        let quick = before.with_surfaces(&was, &scene).expect("no limit");
        verdict.that(name, quick.is_none(), || "kept its trees");
    }
    verdict.close();
}
