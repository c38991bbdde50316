//! Hierarchy, instances, cameras, lights and scenes.

use super::model::{Model, floats};
use super::{folder, message_in};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use glimray::import::{self, Options};
use glimray::scene::{Attenuation, Instance, LightKind, Scene};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// From the mesh to the world at rest.
fn world(scene: &Scene, instance: &Instance) -> DAffine3 {
    let frame = scene.frame(0.0);
    let node = instance.node.map(|node| frame.nodes[node].world_from_node);
    node.unwrap_or_default() * instance.placement
}

#[test]
fn matrices_and_parts_multiply_down_the_tree() {
    let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(-1.1);
    let model = Model::triangle(json!({})).with(json!({
        "nodes": [
            { "children": [1], "translation": [1, 2, 3], "rotation": turn.to_array(), "scale": [2, -3, 0.5] },
            { "children": [2], "matrix": [1, 0, 0, 0, 0.5, 2, 0, 0, 0, 0, 1, 0, 4, 0, -1, 1] },
            { "mesh": 0, "scale": [-1, 1, 1], "name": "leaf" },
        ],
    }));
    let scene = model.scene();
    let top = DAffine3::from_scale_rotation_translation(
        DVec3::new(2.0, -3.0, 0.5),
        turn,
        DVec3::new(1.0, 2.0, 3.0),
    );
    let middle = DAffine3 {
        matrix3: DMat3::from_cols(DVec3::X, DVec3::new(0.5, 2.0, 0.0), DVec3::Z),
        translation: DVec3::new(4.0, 0.0, -1.0),
    };
    let leaf = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let found = world(&scene, &scene.instances[0]);
    assert!(found.abs_diff_eq(top * middle * leaf, 1e-6), "{found:?}");
    assert_eq!(scene.nodes.len(), 1, "still nodes are folded");
    assert_eq!(scene.nodes[0].name, "leaf");
}

#[test]
fn a_mesh_of_many_nodes_is_stored_once() {
    let model = Model::triangle(json!({})).with(json!({
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": [
            { "mesh": 0 },
            { "mesh": 0, "translation": [5, 0, 0] },
            { "mesh": 0, "scale": [2, 2, 2] },
        ],
    }));
    let scene = model.scene();
    assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 3));
    assert_eq!(scene.triangle_count(), 3);
}

#[test]
fn instancing_places_a_mesh_by_its_attributes() {
    let mut model = Model::triangle(json!({}));
    let translation = model.vectors(&[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    // A quarter of a turn about z, as normalised bytes would have it; and none.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let rotation = model.quads(&[[0.0, 0.0, half, half], [0.0, 0.0, 0.0, 1.0]]);
    let scale = model.vectors(&[[1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]);
    let model = model.with(json!({ "nodes": [{
        "mesh": 0, "translation": [0, 10, 0],
        "extensions": { "EXT_mesh_gpu_instancing": { "attributes": {
            "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale } } },
    }] }));
    let scene = model.scene();
    assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 2));
    let place = |i: usize, p: DVec3| world(&scene, &scene.instances[i]).transform_point3(p);
    assert!(place(0, DVec3::X).abs_diff_eq(DVec3::new(1.0, 11.0, 0.0), 1e-6));
    assert!(place(1, DVec3::X).abs_diff_eq(DVec3::new(5.0, 10.0, 0.0), 1e-6));
}

#[test]
fn cameras_look_along_their_negative_z() {
    let model = Model::triangle(json!({})).with(json!({
        "scenes": [{ "nodes": [0, 1, 2] }],
        "nodes": [
            { "mesh": 0 },
            { "camera": 0, "translation": [0, 0, 5], "name": "eye" },
            { "camera": 1, "rotation": DQuat::from_rotation_y(PI / 2.0).to_array() },
        ],
        "cameras": [
            { "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } },
            { "type": "orthographic", "name": "plan",
              "orthographic": { "xmag": 2, "ymag": 1.5, "znear": 0, "zfar": 9 } },
        ],
    }));
    let scene = model.scene();
    let names: Vec<_> = scene.cameras.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["eye", "plan"]);
    assert_eq!(scene.cameras[0].fov_y, 0.5);
    assert_eq!(scene.cameras[1].orthographic_height, Some(3.0));
    let clips: Vec<_> = scene.cameras.iter().map(|camera| camera.clip).collect();
    assert_eq!(clips, [(0.1, f64::INFINITY), (0.0, 9.0)]);
    let seen = scene.frame(0.0).camera;
    assert_eq!(seen.look_from, DVec3::new(0.0, 0.0, 5.0));
    let direction = (seen.look_at - seen.look_from).normalize();
    assert!(direction.abs_diff_eq(DVec3::NEG_Z, 1e-12));
}

#[test]
fn lights_have_the_radiance_of_their_intensity() {
    let light =
        |light: usize| json!({ "extensions": { "KHR_lights_punctual": { "light": light } } });
    let model = Model::triangle(json!({})).with(json!({
        "scenes": [{ "nodes": [0, 1, 2, 3] }],
        "nodes": [{ "mesh": 0 }, light(0), light(1), light(2)],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [
            { "type": "directional", "intensity": 2, "color": [1, 0.5, 0] },
            { "type": "point", "intensity": 100, "range": 4 },
            { "type": "spot", "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.3 } },
        ] } },
    }));
    let scene = model.scene();
    let [sun, bulb, spot] = &scene.lights[..] else {
        panic!("{:?}", scene.lights);
    };
    // 2 lux on a white diffuse surface: radiance 2/π; the scene's lights are in this unit.
    assert!((f64::from(sun.color.x) - 2.0 / PI).abs() < 1e-6);
    assert_eq!((sun.color.y / sun.color.x, sun.color.z), (0.5, 0.0));
    assert_eq!(sun.attenuation, Attenuation::None);
    assert!((f64::from(bulb.color.x) - 100.0 / PI).abs() < 1e-4);
    assert_eq!(bulb.attenuation, Attenuation::InverseSquare);
    let LightKind::Spot {
        inner,
        outer,
        direction,
        ..
    } = spot.kind
    else {
        panic!("{spot:?}");
    };
    assert_eq!((inner, outer, direction), (0.1, 0.3, DVec3::NEG_Z));
    assert!(!scene.staged, "the file has lights");
}

#[test]
fn values_of_lights_out_of_range_are_noted_with_what_is_used_instead() {
    const CLAMPED: &str = "lights clamped to a radiance of 1e9 at the far end of the scene: 1";
    let mut verdict = Verdict::on("values of lights");
    let spot = |values: Value| json!({ "type": "spot", "spot": values });
    let cases = [
        (
            json!({ "type": "point", "intensity": -100 }),
            "intensity is -100, but at least 0 is allowed: 0 is used",
        ),
        (json!({ "type": "point", "intensity": 1e300 }), CLAMPED),
        (
            json!({ "type": "point", "color": [1e300, 1, 1], "intensity": 1e300 }),
            CLAMPED,
        ),
        (
            json!({ "type": "point", "color": [-1, 5, 1] }),
            "color is [-1, 5, 1], but at least 0 is allowed: [0, 5, 1] is used",
        ),
        (
            json!({ "type": "point", "color": [1e20, 1, 1], "intensity": 1e20 }),
            CLAMPED,
        ),
        (
            spot(json!({ "outerConeAngle": 0 })),
            "spot.outerConeAngle is 0, but it must be above 0: the default of π/4 is used",
        ),
        (
            spot(json!({ "outerConeAngle": 3 })),
            "spot.outerConeAngle is 3, but at most 1.5708 is allowed",
        ),
        (
            spot(json!({ "innerConeAngle": 1, "outerConeAngle": 0.5 })),
            "spot.innerConeAngle is 1, but at most 0.5 is allowed",
        ),
        (
            spot(json!({ "innerConeAngle": -1 })),
            "spot.innerConeAngle is -1, but",
        ),
    ];
    for (mut light, expected) in cases {
        light["name"] = json!("bulb");
        let model = Model::triangle(json!({})).with(json!({
            "scenes": [{ "nodes": [0, 1] }],
            "nodes": [{ "mesh": 0 }, { "extensions": { "KHR_lights_punctual": { "light": 0 } } }],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": { "KHR_lights_punctual": { "lights": [light.clone()] } },
        }));
        let scene = model.scene();
        let start = match expected {
            CLAMPED => CLAMPED.to_owned(),
            _ => format!("lights[0] `bulb`: {expected}"),
        };
        let is_noted = matches!(&scene.skipped[..], [only] if only.starts_with(&start));
        verdict.that(&light, is_noted, || format!("{:?}", scene.skipped));
        if let LightKind::Spot { inner, outer, .. } = scene.lights[0].kind {
            let is_open = (0.0..=outer).contains(&inner) && (0.1..1.6).contains(&outer);
            verdict.that(format!("{light}, angles"), is_open, || {
                format!("{inner}, {outer}")
            });
        }
    }
    verdict.close();
}

#[test]
fn scenes_are_chosen_by_name_or_number() {
    let model = Model::triangle(json!({})).with(json!({
        "scene": 1,
        "scenes": [{ "nodes": [0], "name": "first" }, { "nodes": [1, 2], "name": "both" }],
        "nodes": [{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0 }],
    }));
    let files = folder(&[("a.glb", &model.glb())]);
    let chosen = |name: Option<&str>| Options {
        scene: name.map(str::to_owned),
        ..Options::default()
    };
    let count = |name| {
        let found = import::load_with(&files.path().join("a.glb"), &chosen(name));
        found.expect("a scene").triangle_count()
    };
    assert_eq!(
        (count(None), count(Some("first")), count(Some("1"))),
        (2, 1, 2)
    );
    assert_eq!(
        message_in(&files, "a.glb", &chosen(Some("firts"))),
        "bad model (a.glb): unknown scene `firts`, did you mean `first`? It has `first`, `both`."
    );
    let course = folder(&[("a.scene", b"0 amb: 0 0 0")]);
    assert_eq!(
        message_in(&course, "a.scene", &chosen(Some("first"))),
        "choice refused (a.scene): only glTF models have a scene to choose. Leave out the choice."
    );
}

#[test]
fn a_model_without_scenes_shows_all_nodes() {
    let mut model = Model::triangle(json!({}));
    model
        .json
        .as_object_mut()
        .expect("a table")
        .remove("scenes");
    let scene = model.scene();
    assert_eq!(scene.triangle_count(), 1);
    assert!(scene.staged && scene.cameras.len() == 1);
}

#[test]
fn a_flat_scale_is_kept_and_no_extent_hides() {
    let with = |scale: [f64; 3]| {
        Model::triangle(json!({}))
            .with(json!({ "nodes": [{ "mesh": 0, "scale": scale }] }))
            .scene()
    };
    let flat = with([1.0, 1.0, 0.0]);
    assert!(flat.nodes[0].visible && world(&flat, &flat.instances[0]).inverse().is_finite());
    let none = with([0.0, 0.0, 0.0]);
    assert!(none.instances.is_empty());
    assert_eq!(none.skipped, ["the model has no triangles"]);
}

/// `KHR_lights_punctual` and section 3.10 of glTF 2.0: the scale of lights and cameras does not count.
#[test]
fn lights_and_cameras_of_a_node_without_extent_are_kept() {
    let scene = Model::triangle(json!({}))
        .with(json!({
            "scenes": [{ "nodes": [0, 1] }],
            "nodes": [
                { "mesh": 0 },
                {
                    "scale": [0, 0, 0], "translation": [1, 2, 3], "mesh": 0, "camera": 0,
                    "extensions": { "KHR_lights_punctual": { "light": 0 } },
                },
            ],
            "cameras": [{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point" }] } },
        }))
        .scene();
    assert_eq!(scene.triangle_count(), 1);
    let frame = scene.frame(0.0);
    assert_eq!(frame.camera.look_from, DVec3::new(1.0, 2.0, 3.0));
    let forward = (frame.camera.look_at - frame.camera.look_from).normalize();
    assert!(forward.abs_diff_eq(DVec3::NEG_Z, 1e-9), "{forward}");
    assert!(frame.lights[0].color.min_element() > 0.0);
}

#[test]
fn a_chain_of_a_hundred_thousand_nodes_is_read() {
    const COUNT: usize = 100_000;
    let mut nodes: Vec<_> = (1..COUNT)
        .map(|i| json!({ "children": [i], "translation": [1, 0, 0] }))
        .collect();
    nodes.push(json!({ "mesh": 0 }));
    let mut model = Model::triangle(json!({}));
    model.json["nodes"] = nodes.into();
    let scene = crate::support::effort::within(10_000.0, || model.scene());
    let place = world(&scene, &scene.instances[0]).translation;
    assert_eq!(place, DVec3::new(COUNT as f64 - 1.0, 0.0, 0.0));
}

#[test]
fn a_skin_shows_the_pose_of_its_joints() {
    let mut model = Model::new();
    let position = model.vectors(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let joints = model.accessor(
        &[[0_u8, 1, 0, 0], [0, 1, 0, 0], [0, 1, 0, 0]].concat(),
        5121,
        "VEC4",
        3,
    );
    let weights = model.quads(&[
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.5, 0.5, 0.0, 0.0],
    ]);
    let bind: Vec<f32> = [
        [
            1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.,
        ],
        // The second joint was at (1, 0, 0) when it was bound.
        [
            1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., -1., 0., 0., 1.,
        ],
    ]
    .concat();
    let bind = model.accessor(&floats(&bind), 5126, "MAT4", 2);
    let attributes = json!({ "JOINTS_0": joints, "WEIGHTS_0": weights });
    model.primitive(position, json!({ "attributes": attributes }));
    let model = model.with(json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            // The skinned node's own transform has no effect.
            { "mesh": 0, "skin": 0, "translation": [100, 0, 0] },
            { "children": [2], "translation": [0, 0, 2] },
            { "translation": [0, 3, 0] },
        ],
        "skins": [{ "joints": [1, 2], "inverseBindMatrices": bind }],
    }));
    let scene = model.scene();
    let place = world(&scene, &scene.instances[0]);
    let found: Vec<DVec3> = (scene.meshes[0].positions.iter())
        .map(|p| place.transform_point3(p.as_dvec3()))
        .collect();
    let [a, b] = [DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.0, 3.0, 2.0)];
    // Half of (0, 1, 2) and half of (−1, 4, 2).
    let expected = [a, b, DVec3::new(-0.5, 2.5, 2.0)];
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            found.abs_diff_eq(expected, 1e-6),
            "{found} is not {expected}"
        );
    }
}
