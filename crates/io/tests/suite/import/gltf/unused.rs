//! Parts of a model that no picture shows are told by name, and what contradicts the specification is told with what is
//! used instead.

use super::load;
use super::model::Model;
use crate::support::verdict::Verdict;
use glimray::import::{self, Memory, Options};
use glimray::scene::Camera;
use serde_json::{Value, json};

type Change<'a> = &'a dyn Fn(&mut Value);

/// A triangle with the accessors 0 of positions, 1 of indices, 2 of texture coordinates, 3 of tangents, 4 of joints,
/// 5 of weights and 6 of places, of which it uses the first two.
fn model() -> Model {
    let mut model = Model::triangle(json!({ "material": 0 }));
    model.accessor(&[0, 1, 2], 5121, "SCALAR", 3);
    model.pairs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    model.quads(&[[1.0, 0.0, 0.0, 1.0]; 3]);
    model.accessor(&[0; 12], 5121, "VEC4", 3);
    model.quads(&[[1.0, 0.0, 0.0, 0.0]; 3]);
    model.vectors(&[[0.0; 3], [f32::INFINITY, 0.0, 0.0]]);
    model.push("materials", json!({}));
    model.json["meshes"][0]["primitives"][0]["indices"] = json!(1);
    model
}

/// All that is said about the model after a change: its notes and remarks, or the error.
fn said(change: Change) -> String {
    let mut model = model();
    change(&mut model.json);
    match load("a.glb", model.glb()) {
        Ok(scene) => [scene.skipped, scene.remarks].concat().join("\n"),
        Err(error) => error.to_string(),
    }
}

fn check(name: &str, rows: &[(Change, &str)]) {
    let mut verdict = Verdict::on(name);
    let before = said(&|_| ());
    for (change, expected) in rows {
        let found = said(change);
        let is_new = found.contains(expected) && !before.contains(expected);
        verdict.that(expected, is_new, || found.clone());
    }
    verdict.close();
}

fn first(it: &mut Value) -> &mut Value {
    &mut it["meshes"][0]["primitives"][0]
}

#[test]
fn properties_that_others_leave_without_an_effect_are_named() {
    check(
        "properties beside others",
        &[
            (
                &|it| {
                    let matrix = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
                    it["nodes"][0] = json!({ "mesh": 0, "matrix": matrix, "scale": [2, 2, 2] });
                },
                "nodes[0].scale is not used: the node has a matrix",
            ),
            (
                &|it| {
                    it["nodes"][0]["translation"] = json!([1, 2, 3]);
                    it["nodes"][0]["skin"] = json!(0);
                    it["skins"] = json!([{ "joints": [0] }]);
                },
                "nodes[0].translation is not used: a skin places the mesh",
            ),
            (
                &|it| it["nodes"] = json!([{ "mesh": 0, "children": [1] }, { "skin": 0 }]),
                "nodes[1].skin is not used: the node has no mesh",
            ),
            (
                &|it| it["nodes"][0]["weights"] = json!([1, 2]),
                "nodes[0].weights has 2 numbers for 0 morph targets",
            ),
            (
                &|it| it["materials"][0]["alphaCutoff"] = json!(0.25),
                "materials[0].alphaCutoff is not used: the alpha mode is not MASK",
            ),
            (
                &|it| it["materials"][0]["doubleSided"] = json!(false),
                "materials[0].doubleSided is not used: surfaces are seen from both sides",
            ),
            (
                &|it| {
                    let unlit = json!({ "KHR_materials_unlit": {}, "KHR_materials_ior": {} });
                    it["materials"][0]["extensions"] = unlit;
                },
                "materials[0].extensions.KHR_materials_ior is not used: the material is unlit",
            ),
            (
                &|it| {
                    let older = json!({ "KHR_materials_pbrSpecularGlossiness": {} });
                    it["materials"][0]["extensions"] = older;
                    it["materials"][0]["pbrMetallicRoughness"] = json!({});
                },
                "materials[0].pbrMetallicRoughness is not used: KHR_materials_pbrSpecularGlossiness takes its place",
            ),
            (
                &|it| {
                    it["cameras"] = json!([{
                        "perspective": { "yfov": 1, "znear": 1 }, "orthographic": { "xmag": 1, "ymag": 1 } }]);
                },
                "cameras[0].orthographic is not used: the camera has a perspective",
            ),
            (
                &|it| {
                    let light = json!({ "type": "point", "spot": {} });
                    it["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
                },
                "extensions.KHR_lights_punctual.lights[0].spot is not used: the light is no spot",
            ),
            (
                &|it| it["accessors"][0]["normalized"] = json!(true),
                "accessors[0].normalized is not used: only integers of 8 or 16 bits can be normalised",
            ),
            (
                &|it| it["accessors"][1]["normalized"] = json!(true),
                "accessors[1].normalized is not used: indices are whole numbers",
            ),
            (
                &|it| it["images"] = json!([{ "uri": "a.png", "bufferView": 0 }]),
                "images[0].bufferView is not used: the image has a URI",
            ),
            (
                &|it| first(it)["attributes"]["TEXCOORD_0"] = json!(2),
                "meshes[0].primitives[0].attributes.TEXCOORD_0 is not used: no map of the material lies in it",
            ),
            (
                &|it| first(it)["attributes"]["TANGENT"] = json!(3),
                "meshes[0].primitives[0].attributes.TANGENT is not used: no map of the material bends normals",
            ),
            (
                &|it| {
                    first(it)["attributes"]["JOINTS_0"] = json!(4);
                    first(it)["attributes"]["WEIGHTS_0"] = json!(5);
                },
                "meshes[0].primitives[0].attributes.JOINTS_0 is not used: no node of the mesh has a skin",
            ),
        ],
    );
}

#[test]
fn entries_to_which_nothing_refers_are_named() {
    check(
        "entries without a use",
        &[
            (
                &|it| it["scenes"] = json!([{ "nodes": [0] }, { "nodes": [] }]),
                "scenes[1] is not used: another scene is shown",
            ),
            (
                &|it| it["nodes"] = json!([{ "mesh": 0 }, {}, {}]),
                "nodes[1] is not used: the scene does not show it (2 times)",
            ),
            (
                &|it| it["materials"] = json!([{}, {}]),
                "materials[1] is not used: the scene does not show it",
            ),
            (
                &|it| it["cameras"] = json!([{}]),
                "cameras[0] is not used: the scene does not show it",
            ),
            (
                &|it| {
                    let views = it["bufferViews"].as_array_mut().expect("a list");
                    views.push(json!({ "buffer": 0, "byteLength": 4 }));
                },
                "bufferViews[7] is not used: nothing refers to it",
            ),
            (
                &|it| {
                    it["animations"] =
                        json!([{ "samplers": [{ "input": 2, "output": 3 }], "channels": [] }])
                },
                "animations[0].samplers[0] is not used: nothing refers to it",
            ),
        ],
    );
    assert!(said(&|_| ()).contains("accessors[2] is not used: nothing refers to it (5 times)"));
}

#[test]
fn values_that_the_specification_excludes_are_told() {
    let channels = |channels: Value| {
        move |it: &mut Value| {
            it["animations"] = json!([{
                "samplers": [{ "input": 2, "output": 3 }], "channels": channels }]);
        }
    };
    let moved = json!({ "sampler": 0, "target": { "node": 0, "path": "translation" } });
    check(
        "excluded values",
        &[
            (
                &|it| it["samplers"] = json!([{ "wrapS": 7 }]),
                "samplers[0].wrapS 7 is unknown: 10497 is used",
            ),
            (
                &|it| it["samplers"] = json!([{ "magFilter": 9984 }]),
                "samplers[0].magFilter 9984 is unknown: 9729 is used",
            ),
            (
                &channels(json!([{ "sampler": 0, "target": { "path": "scale" } }])),
                "animations[0].channels[0] moves nothing: its target has no node",
            ),
            (
                &channels(json!([moved, moved])),
                "animations[0].channels[1] moves what an earlier channel of its clip moves",
            ),
            (
                &channels(json!([{ "sampler": 0, "target": { "node": 0, "path": "weights" } }])),
                "animations[0] moves the weights of a mesh without morph targets",
            ),
            (
                &|it| {
                    let pointer = json!({ "pointer": "/cameras/0/perspective/yfov" });
                    let target = json!({ "path": "pointer", "extensions": { "KHR_animation_pointer": pointer } });
                    it["nodes"][0]["camera"] = json!(0);
                    it["cameras"] = json!([{ "orthographic": { "xmag": 1, "ymag": 1 } }]);
                    it["animations"] = json!([{
                        "samplers": [{ "input": 2, "output": 3 }], "channels": [{ "sampler": 0, "target": target }] }]);
                },
                "animations[0] moves a lens that the camera has not, which is not shown",
            ),
            (
                &|it| {
                    let copies = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 6 } } });
                    it["nodes"][0]["extensions"] = copies;
                },
                "nodes[0]: copies are hidden whose transform is out of range",
            ),
            (
                &|it| {
                    let mapping = json!({ "material": 9, "variants": [3] });
                    first(it)["extensions"] =
                        json!({ "KHR_materials_variants": { "mappings": [mapping] } });
                },
                "mappings[0].material: materials[9] does not exist",
            ),
            (
                &|it| {
                    let mapping = json!({ "material": 0, "variants": [3] });
                    first(it)["extensions"] =
                        json!({ "KHR_materials_variants": { "mappings": [mapping] } });
                },
                "mappings[0].variants: variants[3] does not exist",
            ),
        ],
    );
}

#[test]
fn versions_decide_whether_a_model_is_read() {
    let asset = |asset: Value| said(&move |it: &mut Value| it["asset"] = asset.clone());
    let refused = [
        json!({ "version": "odd" }),
        json!({ "version": "20.0" }),
        json!({ "version": "1.0" }),
        json!({ "version": "2." }),
        json!({}),
        json!({ "version": "2.1", "minVersion": "2.1" }),
        json!({ "version": "2.0", "minVersion": "odd" }),
    ];
    for value in refused {
        let found = asset(value.clone());
        assert!(
            found.contains("but only version 2.0 is read"),
            "{value}: {found}"
        );
    }
    let plain = asset(json!({ "version": "2.0" }));
    for value in [
        json!({ "version": "2.0", "minVersion": "2.0" }),
        json!({ "version": "2.7" }),
        json!({ "version": "2.1", "minVersion": "2.0" }),
    ] {
        assert_eq!(asset(value.clone()), plain, "{value}");
    }
    for (value, expected) in [
        (
            json!({ "version": "2" }),
            "asset.version is `2`, and was read as 2.0",
        ),
        (
            json!({ "version": "odd", "minVersion": "2.0" }),
            "asset.version is `odd`, which is no version",
        ),
        (
            json!({ "version": "1.0", "minVersion": "2.0" }),
            "asset.version is `1.0`, which is below minVersion",
        ),
    ] {
        let found = asset(value);
        assert!(found.contains(expected), "{expected}: {found}");
    }
}

/// Section 3.10: an angle of view is between 0 and π, and the size of an orthographic view is not 0.
#[test]
fn cameras_with_impossible_lenses_are_kept_with_usual_ones() {
    let seen = |lens: Value| {
        let model = model().with(json!({
            "nodes": [{ "mesh": 0, "camera": 0 }],
            "cameras": [lens],
        }));
        let files = Memory::from_iter([("a.glb", &model.glb()[..])]);
        let options = Options {
            size: Some((200, 100)),
            ..Options::default()
        };
        let scene = import::load_from(&files, "a.glb", &options).expect("a scene");
        (scene.cameras[0].clone(), scene.skipped.join("\n"))
    };
    let usual = std::f64::consts::FRAC_PI_4;
    for yfov in [0.0, -1.0, 4.0, 60.0] {
        let (camera, notes) = seen(json!({ "perspective": { "yfov": yfov, "znear": 0.5 } }));
        assert_eq!((camera.fov_y, camera.clip.0), (usual, 0.5));
        let expected = format!(
            "cameras[0]: perspective.yfov is {yfov}, but it must be between 0 and π: π/4 is used"
        );
        assert!(notes.contains(&expected), "{notes}");
    }
    let (camera, notes) = seen(json!({ "perspective": { "yfov": 0.5, "aspectRatio": -2 } }));
    assert_eq!(camera.fov_y, 0.5);
    assert!(
        notes.contains("perspective.aspectRatio is -2, but it must be above 0"),
        "{notes}"
    );
    let (camera, notes) = seen(json!({ "type": "perspective" }));
    assert_eq!(camera.fov_y, usual);
    assert!(notes.contains("cameras[0] has no lens"), "{notes}");
    let flat = |xmag: f64, ymag: f64| {
        let (
            Camera {
                orthographic_height,
                ..
            },
            notes,
        ) = seen(json!({ "orthographic": { "xmag": xmag, "ymag": ymag } }));
        (orthographic_height.expect("an orthographic view"), notes)
    };
    // A picture of 200 × 100 pixels.
    for (xmag, ymag, height, note) in [
        (
            1.5,
            0.0,
            2.0,
            "orthographic.ymag is 0, but it must be above 0: 1 is used",
        ),
        (
            0.0,
            1.5,
            3.0,
            "orthographic.xmag is 0, but it must be above 0: 3 is used",
        ),
        (
            1.5,
            -1.5,
            3.0,
            "orthographic.ymag is -1.5, but it must be above 0: 1.5 is used",
        ),
    ] {
        let (found, notes) = flat(xmag, ymag);
        assert_eq!(found, height, "{xmag}, {ymag}");
        assert!(notes.contains(note), "{notes}");
    }
}
