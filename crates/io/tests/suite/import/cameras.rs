//! The camera of a model: its own where it sees something lit, in pictures of any aspect.

use super::gltf::model::{Model, ship};
use glam::DVec3;
use glimray::import::{self, Memory, Options, Staging};
use glimray::scene::{Camera, Scene};
use serde_json::{Value, json};

fn load(model: &Model, options: &Options) -> Scene {
    let files = Memory::from_iter([("a.glb", &model.glb()[..])]);
    import::load_from(&files, "a.glb", options).expect("a scene")
}

/// The name of the camera that is used, and how many are passed over.
fn used(model: &Model) -> (String, usize) {
    let scene = load(model, &Options::default());
    let name = scene.cameras[scene.camera_index].name.clone();
    (name, scene.blind_cameras)
}

#[test]
fn a_camera_in_a_closed_box_is_not_the_default() {
    assert_eq!(used(&ship(json!({}))), ("framed".to_owned(), 1));
    let scene = load(&ship(json!({})), &Options::default());
    let camera = scene.frame(0.0).camera;
    assert!(camera.look_from.abs().max_element() > 2.0, "{camera:?}");
    assert_eq!(scene.cameras[0].name, "bridge", "it can be chosen");
    let bare = Options {
        staging: Staging::NONE,
        ..Options::default()
    };
    assert_eq!(load(&ship(json!({})), &bare).camera_index, 0);
}

#[test]
fn the_next_camera_that_sees_something_takes_its_place() {
    let outside = |translation: Value| {
        ship(json!({
            "scenes": [{ "nodes": [0, 1, 2, 3] }],
            "nodes": [
                { "mesh": 0 },
                { "mesh": 0, "translation": [10, 0, 0] },
                { "camera": 0, "name": "bridge" },
                { "camera": 0, "name": "quay", "translation": translation },
            ],
        }))
    };
    assert_eq!(used(&outside(json!([0, 0, 8]))), ("quay".to_owned(), 1));
    let away = used(&outside(json!([0, 0, -8])));
    assert_eq!(
        away,
        ("framed".to_owned(), 2),
        "it looks away from the model"
    );
}

#[test]
fn a_camera_in_a_box_that_is_lit_or_open_is_the_default() {
    let glowing = json!({ "materials": [{ "emissiveFactor": [1, 1, 1] }] });
    let clear = json!({ "materials": [{ "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.2] } }] });
    let lamp = json!({
        "scenes": [{ "nodes": [0, 1, 2, 3] }],
        "nodes": [
            { "mesh": 0 },
            { "mesh": 0, "translation": [10, 0, 0] },
            { "camera": 0, "name": "bridge" },
            { "translation": [0, 0.5, 0.5], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point" }] } },
    });
    for more in [glowing, clear, lamp] {
        assert_eq!(
            used(&ship(more.clone())),
            ("bridge".to_owned(), 0),
            "{more}"
        );
    }
}

/// A model with a camera of this lens.
fn seen_by(lens: Value) -> Model {
    Model::triangle(json!({})).with(json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "camera": 0, "translation": [0, 0, 3] }],
        "cameras": [lens],
    }))
}

/// Half the height of what the camera of the model sees at distance 1, in a picture of this size.
fn high(model: &Model, size: (u32, u32)) -> f64 {
    let options = Options {
        size: Some(size),
        ..Options::default()
    };
    let Camera {
        fov_y,
        orthographic_height,
        ..
    } = load(model, &options).cameras[0];
    orthographic_height.map_or((fov_y / 2.0).tan(), |height| height / 2.0)
}

#[test]
fn a_camera_of_another_aspect_shows_as_much_to_the_sides() {
    let tangent = 0.5;
    let perspective = |ratio: Value| {
        let yfov = 2.0 * f64::atan(tangent);
        json!({ "type": "perspective", "perspective": { "yfov": yfov, "aspectRatio": ratio, "znear": 0.1 } })
    };
    let orthographic = json!({
        "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 0.5, "znear": 0, "zfar": 9 }
    });
    let twice = seen_by(perspective(json!(2)));
    for (size, expected) in [
        ((200, 100), 0.5),
        ((100, 100), 1.0),
        ((50, 100), 2.0),
        ((400, 100), 0.5),
    ] {
        for model in [&twice, &seen_by(orthographic.clone())] {
            let found = high(model, size);
            assert!((found - expected).abs() < 1e-9, "{size:?}: {found}");
        }
    }
    let mut plain = perspective(json!(1));
    plain["perspective"]
        .as_object_mut()
        .expect("a lens")
        .remove("aspectRatio");
    assert!(
        (high(&seen_by(plain), (50, 100)) - tangent).abs() < 1e-9,
        "it fits all"
    );
}

#[test]
fn a_model_can_be_framed_whatever_its_cameras() {
    let model =
        seen_by(json!({ "type": "perspective", "perspective": { "yfov": 0.1, "znear": 0.1 } }));
    let options = Options {
        staging: Staging {
            fit: true,
            ..Staging::default()
        },
        ..Options::default()
    };
    let scene = load(&model, &options);
    let plain = load(&Model::triangle(json!({})), &Options::default());
    assert_eq!(
        scene.frame(0.0).camera.look_from,
        plain.frame(0.0).camera.look_from
    );
    assert!(
        scene
            .frame(0.0)
            .camera
            .look_from
            .distance(DVec3::new(0.0, 0.0, 3.0))
            > 0.1
    );
    assert_eq!(scene.blind_cameras, 0);
}
