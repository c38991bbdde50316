//! Clips.

use super::model::Model;
use super::{folder, message_in};
use crate::support::program::Workspace;
use glam::{DQuat, DVec3};
use glimray::import::{self, Options};
use glimray::scene::Scene;
use serde_json::{Value, json};

/// A triangle whose node a clip moves: `path`, times, and values of three or four numbers.
fn moved(path: &str, times: &[f32], values: Values, interpolation: &str) -> Model {
    let mut model = Model::triangle(json!({}));
    let input = model.numbers(times);
    let output = match values {
        Values::Three(values) => model.vectors(values),
        Values::Four(values) => model.quads(values),
    };
    model.push("animations", clip("", path, input, output, interpolation));
    model
}

enum Values<'a> {
    Three(&'a [[f32; 3]]),
    Four(&'a [[f32; 4]]),
}

fn clip(name: &str, path: &str, input: usize, output: usize, interpolation: &str) -> Value {
    json!({
        "name": name,
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": path } }],
        "samplers": [{ "input": input, "output": output, "interpolation": interpolation }],
    })
}

/// Where the origin of the first node is.
fn place(scene: &Scene, time: f64) -> DVec3 {
    scene.frame(time).nodes[0].world_from_node.translation
}

#[test]
fn translations_follow_their_interpolation() {
    let values = [[0.0; 3], [4.0, 0.0, 0.0], [4.0, 2.0, 0.0]];
    let times = [0.0, 1.0, 3.0];
    let linear = moved("translation", &times, Values::Three(&values), "LINEAR").scene();
    assert_eq!(place(&linear, 0.25), DVec3::new(1.0, 0.0, 0.0));
    assert_eq!(place(&linear, 2.0), DVec3::new(4.0, 1.0, 0.0));
    assert_eq!(linear.duration(), 3.0);
    let step = moved("translation", &times, Values::Three(&values), "STEP").scene();
    assert_eq!(place(&step, 0.99), DVec3::ZERO);
    assert_eq!(place(&step, 1.0), DVec3::new(4.0, 0.0, 0.0));
}

#[test]
fn cubic_splines_scale_their_tangents_with_the_time_between_keys() {
    // In-tangent, value and out-tangent of each key, two seconds apart (appendix C.5).
    let keys = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.5, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0; 3],
    ];
    let scene = moved(
        "translation",
        &[0.0, 2.0],
        Values::Three(&keys),
        "CUBICSPLINE",
    )
    .scene();
    for time in [0.3_f64, 1.0, 1.7] {
        let (t, length) = (time / 2.0, 2.0);
        let (t2, t3) = (t * t, t * t * t);
        let expected = (2.0 * t3 - 3.0 * t2 + 1.0) * 1.0
            + length * (t3 - 2.0 * t2 + t) * 0.5
            + (3.0 * t2 - 2.0 * t3) * 3.0
            - length * (t3 - t2);
        let found = place(&scene, time).x;
        assert!(
            (found - expected).abs() < 1e-9,
            "{time}: {found} is not {expected}"
        );
    }
}

#[test]
fn rotations_take_the_shorter_way() {
    let [a, b] = [0.2, 1.4].map(DQuat::from_rotation_z);
    // The negative quaternion is the same rotation.
    let keys = [a, -b].map(|q| q.to_array().map(|x| x as f32));
    let scene = moved("rotation", &[0.0, 1.0], Values::Four(&keys), "LINEAR").scene();
    let turned = scene.frame(0.5).nodes[0].world_from_node.matrix3 * DVec3::X;
    let expected = DVec3::new(0.8_f64.cos(), 0.8_f64.sin(), 0.0);
    assert!(turned.abs_diff_eq(expected, 1e-6), "{turned}");
}

#[test]
fn channels_of_a_clip_repeat_together() {
    let mut model = moved(
        "translation",
        &[1.0, 2.0],
        Values::Three(&[[0.0; 3], [6.0, 0.0, 0.0]]),
        "LINEAR",
    );
    let input = model.numbers(&[0.0, 4.0]);
    let output = model.vectors(&[[1.0; 3], [2.0; 3]]);
    let clip = &mut model.json["animations"][0];
    let mut add = |list: &str, entry: Value| clip[list].as_array_mut().expect("a list").push(entry);
    let target = json!({ "node": 0, "path": "scale" });
    add("channels", json!({ "sampler": 1, "target": target }));
    add("samplers", json!({ "input": input, "output": output }));
    let scene = model.scene();
    assert_eq!(scene.duration(), 4.0);
    for (time, x) in [(0.5, 0.0), (1.5, 3.0), (3.5, 6.0), (4.5, 0.0), (5.5, 3.0)] {
        assert!((place(&scene, time).x - x).abs() < 1e-9, "at {time}");
    }
}

#[test]
fn a_moving_parent_carries_its_children() {
    let mut model = moved(
        "translation",
        &[0.0, 1.0],
        Values::Three(&[[0.0; 3], [2.0, 0.0, 0.0]]),
        "LINEAR",
    );
    model.json["nodes"] = json!([
        { "children": [1], "scale": [2, 2, 2] },
        { "children": [2], "translation": [0, 1, 0] },
        { "mesh": 0 },
    ]);
    let scene = model.scene();
    let instance = &scene.instances[0];
    let node = instance.node.expect("a node");
    let frame = scene.frame(0.5);
    let world = frame.nodes[node].world_from_node * instance.placement;
    assert!(
        world
            .translation
            .abs_diff_eq(DVec3::new(1.0, 2.0, 0.0), 1e-12)
    );
}

#[test]
fn clips_are_chosen_by_name_and_others_are_left_out() {
    let mut model = moved(
        "translation",
        &[0.0, 1.0],
        Values::Three(&[[0.0; 3], [1.0, 0.0, 0.0]]),
        "LINEAR",
    );
    model.json["animations"][0]["name"] = json!("walk");
    let input = model.numbers(&[0.0, 2.0]);
    let output = model.vectors(&[[0.0; 3], [0.0, 8.0, 0.0]]);
    model.push(
        "animations",
        clip("jump", "translation", input, output, "LINEAR"),
    );
    let scene = model.scene();
    assert_eq!(place(&scene, 0.5), DVec3::new(0.5, 0.0, 0.0));
    assert_eq!(
        scene.remarks,
        ["the clip 1 `jump` is not played: it moves what an earlier one moves"]
    );
    // Nothing of the file is lost: any clip can be asked for.
    let workspace = Workspace::new();
    workspace.write("a.glb", model.glb());
    let strict = workspace.run("inspect a.glb --strict").expect(0);
    assert!(strict.text().contains("the clip 1 `jump` is not played"));
    let files = folder(&[("a.glb", &model.glb())]);
    let options = |clip: &str| Options {
        clip: Some(clip.to_owned()),
        ..Options::default()
    };
    let jump = import::load_with(&files.path().join("a.glb"), &options("jump")).expect("a scene");
    assert_eq!(place(&jump, 0.5), DVec3::new(0.0, 2.0, 0.0));
    assert_eq!(
        message_in(&files, "a.glb", &options("run")),
        "bad model (a.glb): unknown clip `run`. It has `walk`, `jump`."
    );
}

#[test]
fn convert_writes_no_file_of_a_scene_that_it_could_not_read_again() {
    let mirrored = Values::Three(&[[1.0; 3], [-1.0; 3]]);
    let model = moved("scale", &[0.0, 1.0], mirrored, "LINEAR");
    let workspace = Workspace::new();
    workspace.write("a.glb", model.glb());
    workspace.run("inspect a.glb --strict").expect(0);
    let run = workspace.run("convert a.glb -o out.toml").expect(3);
    run.says("error: cannot write the scene as a native one: ");
    run.says("the scale would pass through 0");
    assert_eq!(workspace.made(), ["a.glb"]);
}
