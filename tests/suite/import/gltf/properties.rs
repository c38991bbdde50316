//! Every property of glTF 2.0 and of the extensions that are read has an effect, a note or a remark.

use super::model::{FLOAT, Model, UNSIGNED_BYTE, UNSIGNED_SHORT, base64, floats, png};
use crate::support::verdict::Verdict;
use glimray::import::{self, Options, Staging};
use glimray::scene::LightTransport;
use serde_json::{Value, json};

/// A model that has every property at least once, after the specification's tables of properties.
fn everything() -> Model {
    let mut model = Model::new();
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let position = model.vectors(&corners);
    let normal = model.vectors(&[[0.0, 0.6, 0.8]; 4]);
    let tangent = model.quads(&[[1.0, 0.0, 0.0, 1.0]; 4]);
    let uv = model.pairs(&[[0.1, 0.2], [0.9, 0.3], [0.2, 0.8], [0.7, 0.9]]);
    let other_uv = model.pairs(&[[0.4, 0.1], [0.8, 0.2], [0.3, 0.7], [0.6, 0.8]]);
    let color = model.accessor(&[[200, 100, 50, 255]; 4].concat(), UNSIGNED_BYTE, "VEC4", 4);
    let joints = model.accessor(&[[0, 1, 0, 0]; 4].concat(), UNSIGNED_BYTE, "VEC4", 4);
    let weights = model.quads(&[[0.75, 0.25, 0.0, 0.0]; 4]);
    let moved = model.vectors(&[[0.0, 0.0, 0.5], [0.0; 3], [0.0, 0.25, 0.0], [0.0; 3]]);
    let indices: Vec<u8> = [0_u16, 1, 2, 2, 1, 3]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    let indices = model.accessor(&indices, UNSIGNED_SHORT, "SCALAR", 6);
    let times = model.numbers(&[0.0, 1.0]);
    let places = model.vectors(&[[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let strengths = model.numbers(&[1.0, 3.0]);
    let amounts = model.numbers(&[0.0, 1.0]);
    let bind: Vec<f32> = [
        glam::Mat4::IDENTITY,
        glam::Mat4::from_translation(glam::Vec3::X),
    ]
    .iter()
    .flat_map(glam::Mat4::to_cols_array)
    .collect();
    let bind = model.accessor(&floats(&bind), FLOAT, "MAT4", 2);
    let copies = model.vectors(&[[0.0, 0.0, 0.0], [0.0, 0.0, -2.0]]);
    let (at, to) = (
        model.view(&[1, 0]),
        model.view(&floats(&[0.25, 0.25, 0.25])),
    );
    model.json["accessors"][normal]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": at, "byteOffset": 0, "componentType": UNSIGNED_BYTE },
        "values": { "bufferView": to, "byteOffset": 0 },
    });
    model.json["accessors"][position]["max"] = json!([1, 1, 0]);
    model.json["accessors"][position]["min"] = json!([0, 0, 0]);
    model.json["accessors"][position]["name"] = json!("corners");
    model.json["accessors"][position]["byteOffset"] = json!(0);
    model.json["accessors"][color]["normalized"] = json!(true);
    model.json["bufferViews"][position]["name"] = json!("bytes of corners");
    model.json["bufferViews"][position]["byteStride"] = json!(12);
    model.json["bufferViews"][position]["target"] = json!(34962);
    model.primitive(
        position,
        json!({
            "attributes": {
                "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": uv, "TEXCOORD_1": other_uv,
                "COLOR_0": color, "JOINTS_0": joints, "WEIGHTS_0": weights,
            },
            "indices": indices, "material": 0, "mode": 4,
            "targets": [{ "POSITION": moved }],
            "extensions": { "KHR_materials_variants": { "mappings": [
                { "name": "in red", "material": 1, "variants": [0] },
            ] } },
        }),
    );
    let texels = [
        [255, 0, 0, 255],
        [0, 255, 0, 128],
        [0, 0, 255, 255],
        [255, 255, 0, 64],
    ];
    let picture = png(2, &texels);
    let inside = model.view(&picture);
    let map = |index: usize| {
        json!({ "index": index, "texCoord": 1, "extensions": { "KHR_texture_transform": {
            "offset": [0.1, 0.2], "rotation": 0.3, "scale": [2, 3], "texCoord": 0,
        } } })
    };
    let mut model = model.with(json!({
        "asset": { "version": "2.0", "minVersion": "2.0", "generator": "a test", "copyright": "nobody" },
        "scene": 0,
        "scenes": [{ "name": "all", "nodes": [0, 1, 2, 3, 4, 5, 6, 7] }],
        "nodes": [
            { "mesh": 0, "skin": 0, "name": "skinned", "weights": [0.5] },
            { "name": "joint", "translation": [0.1, 0.2, 0.3], "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, 1],
              "children": [8] },
            { "camera": 0, "name": "eye", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1] },
            { "camera": 1, "name": "plan" },
            { "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "extensions": { "KHR_lights_punctual": { "light": 1 } } },
            { "extensions": { "KHR_lights_punctual": { "light": 2 }, "KHR_node_visibility": { "visible": true } } },
            { "mesh": 1, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": copies } } } },
            { "name": "second joint", "translation": [0.5, 0, 0] },
        ],
        "skins": [{ "name": "skin", "inverseBindMatrices": bind, "joints": [1, 8], "skeleton": 1 }],
        "cameras": [
            { "name": "perspective", "type": "perspective",
              "perspective": { "yfov": 0.5, "aspectRatio": 1.5, "znear": 0.1, "zfar": 90 } },
            { "name": "parallel", "type": "orthographic",
              "orthographic": { "xmag": 2, "ymag": 1.5, "znear": 0.1, "zfar": 9 } },
        ],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants"],
        "extensionsRequired": ["KHR_lights_punctual"],
        "extensions": {
            "KHR_lights_punctual": { "lights": [
                { "name": "sun", "type": "directional", "intensity": 2, "color": [1, 0.5, 0.25] },
                { "name": "bulb", "type": "point", "intensity": 100, "range": 4 },
                { "name": "torch", "type": "spot", "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.3 } },
            ] },
            "KHR_materials_variants": { "variants": [{ "name": "red" }] },
        },
        "animations": [{
            "name": "clip",
            "channels": [
                { "sampler": 0, "target": { "node": 1, "path": "translation" } },
                { "sampler": 1, "target": { "path": "pointer", "extensions": { "KHR_animation_pointer": {
                    "pointer": "/extensions/KHR_lights_punctual/lights/1/intensity",
                } } } },
                { "sampler": 2, "target": { "node": 0, "path": "weights" } },
            ],
            "samplers": [
                { "input": times, "output": places, "interpolation": "LINEAR" },
                { "input": times, "output": strengths, "interpolation": "STEP" },
                { "input": times, "output": amounts },
            ],
        }],
        "images": [
            { "name": "inside", "bufferView": inside, "mimeType": "image/png" },
            { "name": "in text", "uri": format!("data:image/png;base64,{}", base64(&picture)) },
        ],
        "samplers": [{ "name": "sharp", "magFilter": 9728, "minFilter": 9728, "wrapS": 33071, "wrapT": 33648 }],
        "textures": [
            { "name": "first", "source": 0, "sampler": 0 },
            { "name": "second", "source": 1 },
        ],
    }))
    .with(json!({
        "materials": [
            {
                "name": "rich",
                "pbrMetallicRoughness": {
                    "baseColorFactor": [0.9, 0.8, 0.7, 0.6], "baseColorTexture": map(0),
                    "metallicFactor": 0.4, "roughnessFactor": 0.3, "metallicRoughnessTexture": map(1),
                },
                "normalTexture": { "index": 0, "texCoord": 0, "scale": 0.5 },
                "occlusionTexture": { "index": 0, "texCoord": 0, "strength": 0.5 },
                "emissiveTexture": map(1), "emissiveFactor": [0.1, 0.2, 0.3],
                "alphaMode": "MASK", "alphaCutoff": 0.4, "doubleSided": true,
                "extensions": {
                    "KHR_materials_emissive_strength": { "emissiveStrength": 2 },
                    "KHR_materials_ior": { "ior": 1.4 },
                    "KHR_materials_specular": {
                        "specularFactor": 0.5, "specularTexture": map(0),
                        "specularColorFactor": [0.9, 0.8, 0.7], "specularColorTexture": map(1),
                    },
                    "KHR_materials_clearcoat": {
                        "clearcoatFactor": 0.5, "clearcoatTexture": map(0),
                        "clearcoatRoughnessFactor": 0.2, "clearcoatRoughnessTexture": map(1),
                        "clearcoatNormalTexture": { "index": 0, "texCoord": 0, "scale": 0.5 },
                    },
                    "KHR_materials_sheen": {
                        "sheenColorFactor": [0.3, 0.2, 0.1], "sheenColorTexture": map(0),
                        "sheenRoughnessFactor": 0.4, "sheenRoughnessTexture": map(1),
                    },
                    "KHR_materials_anisotropy": {
                        "anisotropyStrength": 0.5, "anisotropyRotation": 0.3, "anisotropyTexture": map(0),
                    },
                    "KHR_materials_iridescence": {
                        "iridescenceFactor": 0.5, "iridescenceTexture": map(0), "iridescenceIor": 1.4,
                        "iridescenceThicknessMinimum": 150, "iridescenceThicknessMaximum": 350,
                        "iridescenceThicknessTexture": map(1),
                    },
                },
            }
        ],
    }));
    let more = json!([
            {
                "name": "glass",
                "extensions": {
                    "KHR_materials_transmission": { "transmissionFactor": 0.9, "transmissionTexture": map(0) },
                    "KHR_materials_volume": {
                        "thicknessFactor": 0.5, "thicknessTexture": map(0),
                        "attenuationDistance": 2, "attenuationColor": [0.9, 0.8, 0.7],
                    },
                    "KHR_materials_dispersion": { "dispersion": 0.3 },
                    "KHR_materials_diffuse_transmission": {
                        "diffuseTransmissionFactor": 0.3, "diffuseTransmissionTexture": map(0),
                        "diffuseTransmissionColorFactor": [0.9, 0.8, 0.7], "diffuseTransmissionColorTexture": map(1),
                    },
                },
            },
            {
                "name": "glossy", "alphaMode": "BLEND",
                "extensions": { "KHR_materials_pbrSpecularGlossiness": {
                    "diffuseFactor": [0.9, 0.8, 0.7, 0.6], "diffuseTexture": map(0),
                    "specularFactor": [0.3, 0.2, 0.1], "glossinessFactor": 0.4,
                } },
            },
    ]);
    for material in more.as_array().expect("a list") {
        model.push("materials", material.clone());
    }
    model.json["meshes"][0]["name"] = json!("square");
    model.json["meshes"][0]["weights"] = json!([0.25]);
    let copied = json!([{
        "attributes": { "POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv, "TEXCOORD_1": other_uv },
        "indices": indices, "material": 2,
    }]);
    model.push("meshes", json!({ "name": "copied", "primitives": copied }));
    model
}

/// What becomes of a model: its scene with notes and remarks, or the error; the remarks; and the notes.
fn outcome(model: &Model) -> (String, String, Vec<String>) {
    let folder = super::folder(&[("a.glb", &model.glb())]);
    let options = Options {
        integrator: Some(LightTransport::Path),
        staging: Staging::NONE,
        ..Options::default()
    };
    match import::load_with(&folder.path().join("a.glb"), &options) {
        Ok(scene) => (
            format!("{scene:?}"),
            scene.remarks.join("\n"),
            scene.skipped,
        ),
        Err(error) => (error.to_string(), String::new(), Vec::new()),
    }
}

/// The pointers to all values in `json` that are not objects or lists.
fn leaves(json: &Value, here: &str, into: &mut Vec<String>) {
    match json {
        Value::Object(members) => {
            for (key, value) in members {
                leaves(value, &format!("{here}/{key}"), into);
            }
        }
        Value::Array(values) => {
            for (index, value) in values.iter().enumerate() {
                leaves(value, &format!("{here}/{index}"), into);
            }
        }
        _ => into.push(here.to_owned()),
    }
}

#[test]
fn an_odd_value_of_each_property_is_seen() {
    let model = everything();
    let (base, remarks, skipped) = outcome(&model);
    assert!(base.starts_with("Scene"), "{base}");
    assert_eq!(skipped, [""; 0], "all of it is used");
    let mut all = Vec::new();
    leaves(&model.json, "", &mut all);
    assert!(all.len() > 300, "{}", all.len());
    let mut verdict = Verdict::on("properties");
    for pointer in all {
        let odd = |value: &Value| match value {
            Value::Bool(flag) => vec![json!(!flag)],
            Value::Number(number) if number.is_f64() => vec![json!(0.37), json!(-3.5), json!(1e9)],
            Value::Number(_) => vec![json!(7), json!(-3), json!(1_000_000)],
            _ => vec![json!("odd")],
        };
        // Remarks name all properties that say nothing about the picture by a pattern, others by the first place.
        let (mut pattern, mut place) = (String::new(), String::new());
        for part in pointer.split('/').skip(1) {
            match part.parse::<u32>() {
                Ok(_) => pattern += "[]",
                Err(_) => pattern += &format!(".{part}"),
            }
            match part.parse::<u32>() {
                Ok(index) => place += &format!("[{index}]"),
                Err(_) => place += &format!(".{part}"),
            }
        }
        if [pattern, place]
            .iter()
            .any(|name| remarks.contains(name.trim_start_matches('.').trim_end_matches("[]")))
        {
            continue;
        }
        for value in odd(model.json.pointer(&pointer).expect("a value")) {
            let mut changed = model.clone();
            *changed.json.pointer_mut(&pointer).expect("a value") = value.clone();
            let seen = outcome(&changed).0 != base;
            verdict.that(
                format!("{pointer} = {value}"),
                seen,
                || "changes nothing and is not said",
            );
        }
    }
    verdict.close();
}
