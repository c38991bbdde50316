//! Maps of materials that clips move: `KHR_animation_pointer` to `KHR_texture_transform`.

use super::model::Model;
use super::model::picture;
use crate::reference::compare::{sized, start_packed};
use glam::DVec3;
use glimray::image::Image;
use glimray::import::{self, Options, Staging};
use glimray::pack;
use glimray::render::{Integrator, RenderSettings, Tone};
use glimray::scene::{Pattern, Scene, Target, TextureProperty, linear_from_srgb};
use serde_json::{Value, json};
use std::sync::Arc;

const BASE: &str = "/materials/0/pbrMetallicRoughness/baseColorTexture";
const VALUES: &str = "/materials/0/pbrMetallicRoughness/metallicRoughnessTexture";
const NORMAL: &str = "/materials/0/normalTexture";

/// A triangle with three maps of one picture, the normal map with a transform of its own.
fn model(transform: Value, of_normal: Value) -> Model {
    let mut model = Model::triangle(json!({ "material": 0 }));
    let uv = model.pairs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
    let map = |transform: Value| json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    model.push(
        "materials",
        json!({
            "pbrMetallicRoughness": { "baseColorTexture": map(transform.clone()), "metallicRoughnessTexture": map(transform) },
            "normalTexture": map(of_normal),
        }),
    );
    let texel = |i: u8| [40 * i, 255 - 50 * i, 30 + 70 * (i % 3), 255];
    picture(&mut model, 2, &[texel(0), texel(1), texel(2), texel(3)]);
    model
}

/// Channels of a clip: pointers, and their values at 0 s and 2 s.
fn animated(mut model: Model, channels: &[(String, Vec<[f32; 2]>)]) -> Model {
    model.json["extensionsUsed"] = json!(["KHR_animation_pointer", "KHR_texture_transform"]);
    let input = model.numbers(&[0.0, 2.0]);
    let clip = json!({ "channels": [], "samplers": [] });
    model.json["animations"] = json!([clip]);
    for (index, (pointer, values)) in channels.iter().enumerate() {
        let output = match pointer.ends_with("rotation") {
            true => model.numbers(&[values[0][0], values[1][0]]),
            false => model.pairs(values),
        };
        let clip = &mut model.json["animations"][0];
        let list =
            |list: &mut Value, value: Value| list.as_array_mut().expect("a list").push(value);
        list(
            &mut clip["samplers"],
            json!({ "input": input, "output": output }),
        );
        let pointer = json!({ "KHR_animation_pointer": { "pointer": pointer } });
        let target = json!({ "path": "pointer", "extensions": pointer });
        list(
            &mut clip["channels"],
            json!({ "sampler": index, "target": target }),
        );
    }
    model
}

fn channel(map: &str, part: &str, values: [[f32; 2]; 2]) -> (String, Vec<[f32; 2]>) {
    (
        format!("{map}/extensions/KHR_texture_transform/{part}"),
        values.to_vec(),
    )
}

/// As it is read for an integrator, without a ground, so that nothing else has textures.
fn read(model: &Model, integrator: Integrator) -> Scene {
    let folder = super::folder(&[("a.glb", &model.glb())]);
    let options = Options {
        integrator: Some(integrator.into()),
        baking: match integrator.is_classical() {
            true => import::Baking::Always,
            false => import::Baking::Never,
        },
        staging: Staging {
            ground: import::Ground::None,
            ..Staging::default()
        },
        ..Options::default()
    };
    let scene = import::load_with(&folder.path().join("a.glb"), &options);
    scene.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn pointers_move_the_maps_that_they_name() {
    let rest = json!({ "offset": [0.5, 0.25], "rotation": 0.4, "scale": [2, 3] });
    let channels = [
        channel(BASE, "offset", [[0.0, 0.0], [1.0, 3.0]]),
        channel(VALUES, "rotation", [[0.0; 2], [1.0; 2]]),
        channel(VALUES, "scale", [[1.0, 1.0], [-3.0, 5.0]]),
    ];
    let scene = read(
        &animated(model(rest.clone(), rest), &channels),
        Integrator::Path,
    );
    assert_eq!(scene.skipped, [""; 0]);
    let layers = scene.materials[0]
        .metallic_roughness()
        .expect("a model")
        .textures;
    let (base, values) = (
        layers.base_color.expect("a map"),
        layers.metallic.expect("a map"),
    );
    let normal = scene.materials[0].textures.normal.expect("a map");
    let frame = scene.frame(1.0);
    for (texture, offset, rotation, scale) in [
        // Properties that are not animated keep the file's values.
        (base, [0.5, 1.5], 0.4, [2.0, 3.0]),
        (values, [0.5, 0.25], 0.5, [-1.0, 3.0]),
        (normal, [0.5, 0.25], 0.4, [2.0, 3.0]),
    ] {
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.3, 0.9)] {
            // The matrix in the text of KHR_texture_transform, with v downwards.
            let (x, y): (f64, f64) = (scale[0] * u, scale[1] * v);
            let (sin, cos) = f64::sin_cos(rotation);
            let (s, t) = (
                cos * x + sin * y + offset[0],
                -sin * x + cos * y + offset[1],
            );
            let place = frame.textures[texture].pattern_from_space;
            let found = place.transform_point3(DVec3::new(u, 1.0 - v, 0.0));
            assert!(
                found.abs_diff_eq(DVec3::new(s, 1.0 - t, 0.0), 1e-6),
                "{texture}: {found}"
            );
        }
    }
    assert!(
        scene.motion_samples(0.0, 1.0).len() == 1,
        "maps do not move while the shutter is open"
    );
}

fn picture_at(scene: &Scene, integrator: Integrator, time: f64) -> Image {
    let packed = Arc::new(pack::scene(scene).expect("a scene that can be packed"));
    let view = packed.frame(&scene.frame(time)).expect("a view");
    let settings = RenderSettings {
        integrator,
        samples: 2,
        ..sized(24, 24)
    };
    let mut renderer = start_packed(packed, &view, &settings);
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer.develop(&Tone::LINEAR).expect("a picture")
}

#[test]
fn a_moved_map_looks_like_one_that_was_always_there() {
    let half = json!({ "offset": [0.5, 0.25], "rotation": 0.5, "scale": [2, 1] });
    let all = [BASE, VALUES].map(|map| {
        [
            channel(map, "offset", [[0.0, 0.0], [1.0, 0.5]]),
            channel(map, "rotation", [[0.0; 2], [1.0; 2]]),
            channel(map, "scale", [[1.0, 1.0], [3.0, 1.0]]),
        ]
    });
    // A normal map that turns keeps the directions of its relief: it does not turn here.
    let mut channels = all.as_flattened().to_vec();
    channels.push(channel(NORMAL, "offset", [[0.0, 0.0], [1.0, 0.5]]));
    let shifted = json!({ "offset": [0.5, 0.25] });
    let moving = animated(model(json!({}), json!({})), &channels);
    for integrator in [Integrator::Path, Integrator::Whitted] {
        let moving = read(&moving, integrator);
        let still = read(&model(half.clone(), shifted.clone()), integrator);
        let expected = picture_at(&still, integrator, 0.0);
        let differ = |time: f64| {
            let found = picture_at(&moving, integrator, time);
            let pairs = found
                .pixels
                .iter()
                .flatten()
                .zip(expected.pixels.iter().flatten());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        assert!(differ(1.0) < 1e-4, "{integrator:?}: {}", differ(1.0));
        assert!(differ(0.0) > 0.1, "{integrator:?}");
    }
}

/// A picture that was computed for the classical integrator lies where its first map does.
#[test]
fn computed_pictures_move_with_their_first_map_and_others_count_with_their_mean() {
    let channels = [channel(BASE, "offset", [[0.0, 0.0], [1.0, 0.0]])];
    let scene = read(
        &animated(model(json!({}), json!({})), &channels),
        Integrator::Whitted,
    );
    let base = scene.materials[0]
        .metallic_roughness()
        .and_then(|it| it.textures.base_color);
    let diffuse = scene.materials[0].classical().textures.diffuse;
    assert!(diffuse.is_some() && diffuse != base);
    for texture in [base, diffuse].into_iter().flatten() {
        for property in TextureProperty::ALL {
            let target = Target::Texture(texture, property);
            let mut tracks = scene.tracks.iter();
            assert!(
                tracks.any(|track| track.targets.contains(&target)),
                "{target:?}"
            );
        }
    }
    // The other map stays: its mean metalness is 82.5/255, and its mean roughness so large that nothing is mirrored.
    let metallic = 82.5 / 255.0;
    let factor = 1.0 - metallic + 0.6 * metallic;
    let texture = &scene.textures[diffuse.expect("a texture")];
    let Pattern::Picture { picture, .. } = texture.pattern else {
        panic!("not a picture");
    };
    for (i, texel) in (0..4).zip(scene.pictures[picture].linear()) {
        let red = linear_from_srgb(f64::from(40 * i) / 255.0);
        assert!(
            (f64::from(texel.x) - factor * red).abs() < 4.5e-3,
            "{texel} {i}"
        );
    }
}
