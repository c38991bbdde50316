//! A bar that a clip bends and morphs.

use super::model::{Model, UNSIGNED_BYTE, floats};
use glam::{DMat4, DQuat, DVec3};
use serde_json::{Value, json};

/// A bar along x of `COUNT` pairs of vertices, and how it follows two joints.
pub const COUNT: usize = 9;

pub fn rest(i: usize) -> DVec3 {
    let side = if i.is_multiple_of(2) { -0.5 } else { 0.5 };
    DVec3::new((i / 2) as f64 * 0.5, side, 0.25 * side)
}

/// The share of the second joint.
pub fn share(i: usize) -> f64 {
    (i / 2) as f64 / (COUNT - 1) as f64
}

pub fn positions() -> Vec<[f32; 3]> {
    let all = 0..2 * COUNT;
    all.map(|i| rest(i).as_vec3().to_array()).collect()
}

pub fn indices() -> Vec<u8> {
    let quads = (0..COUNT as u8 - 1).map(|i| 2 * i);
    quads
        .flat_map(|i| [i, i + 2, i + 1, i + 1, i + 2, i + 3])
        .collect()
}

/// A bar with `sets` of four weights, of which the last two are used: so joints 0 and 1 are at the end.
pub fn bar(sets: usize) -> Model {
    let mut model = Model::new();
    let position = model.vectors(&positions());
    let normal = model.vectors(&[[0.0, -0.5, 1.0]; 2 * COUNT]);
    let corners = indices();
    let indices = model.accessor(&corners, UNSIGNED_BYTE, "SCALAR", corners.len());
    let mut attributes = json!({ "NORMAL": normal });
    for set in 0..sets {
        let is_last = set + 1 == sets;
        let joints: Vec<[u8; 4]> =
            vec![if is_last { [0, 0, 0, 1] } else { [1, 0, 1, 0] }; 2 * COUNT];
        let weights: Vec<[f32; 4]> = (0..2 * COUNT)
            .map(|i| match is_last {
                true => [0.0, 0.0, (1.0 - share(i)) as f32, share(i) as f32],
                // In all, no more for one joint than for the other.
                false => [0.0; 4],
            })
            .collect();
        let joints = model.accessor(joints.as_flattened(), UNSIGNED_BYTE, "VEC4", 2 * COUNT);
        attributes[format!("JOINTS_{set}")] = json!(joints);
        attributes[format!("WEIGHTS_{set}")] = json!(model.quads(&weights));
    }
    model.primitive(
        position,
        json!({ "attributes": attributes, "indices": indices }),
    );
    // The second joint was bound at (2, 0, 0).
    let mut bind = [DMat4::IDENTITY, DMat4::from_translation(DVec3::X * -2.0)]
        .map(|m| m.as_mat4().to_cols_array());
    bind[0][12] = 0.5;
    let bind = model.accessor(&floats(bind.as_flattened()), 5126, "MAT4", 2);
    model.with(json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "mesh": 0, "skin": 0, "translation": [100, 0, 0], "name": "bar" },
            { "children": [2], "translation": [0, 0, 2], "scale": [1, 2, 3] },
            { "children": [3], "translation": [2, 0, 0] },
            { "translation": [2, 0, 0] },
        ],
        "skins": [{ "joints": [1, 2], "inverseBindMatrices": bind }],
    }))
}

/// Adds a channel to the only clip.
pub fn channel(model: &mut Model, target: Value, input: usize, output: usize, interpolation: &str) {
    if model.json["animations"].is_null() {
        model.push("animations", json!({ "channels": [], "samplers": [] }));
    }
    let clip = &mut model.json["animations"][0];
    let sampler = clip["samplers"].as_array().expect("a list").len();
    let mut add = |list: &str, entry: Value| clip[list].as_array_mut().expect("a list").push(entry);
    add("channels", json!({ "sampler": sampler, "target": target }));
    add(
        "samplers",
        json!({ "input": input, "output": output, "interpolation": interpolation }),
    );
}

/// The second joint turns about z by a right angle within two seconds, while the first moves.
pub fn bend(model: &mut Model) {
    let quarter = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
    let input = model.numbers(&[0.0, 2.0]);
    let output = model.quads(&[[0.0, 0.0, 0.0, 1.0], quarter.as_quat().to_array()]);
    channel(
        model,
        json!({ "node": 2, "path": "rotation" }),
        input,
        output,
        "LINEAR",
    );
    let output = model.vectors(&[[0.0, 0.0, 2.0], [0.0, 4.0, 2.0]]);
    channel(
        model,
        json!({ "node": 1, "path": "translation" }),
        input,
        output,
        "LINEAR",
    );
}

/// The weights of two targets: the first grows from 0 to 1 in two seconds, the second has cubic tangents.
pub const WEIGHTS: [f32; 12] = [
    0.0, 0.0, 0.0, 1.0, 0.0, 0.5, // first key: in-tangents, values, out-tangents
    0.0, -1.0, 1.0, 3.0, 0.0, 0.0,
];

/// Two targets: all vertices rise along z by x; some move to the side, and their normals turn.
pub fn morph(model: &mut Model) {
    let rise: Vec<[f32; 3]> = positions().iter().map(|p| [0.0, 0.0, p[0]]).collect();
    let aside: Vec<[f32; 3]> = (0..2 * COUNT)
        .map(|i| {
            if i >= COUNT {
                [0.0, 1.0, 0.0]
            } else {
                [0.0; 3]
            }
        })
        .collect();
    let turned: Vec<[f32; 3]> = (0..2 * COUNT)
        .map(|i| {
            if i >= COUNT {
                [1.0, 0.0, 0.0]
            } else {
                [0.0; 3]
            }
        })
        .collect();
    let targets = json!([
        { "POSITION": model.vectors(&rise) },
        { "POSITION": model.vectors(&aside), "NORMAL": model.vectors(&turned) },
    ]);
    model.json["meshes"][0]["primitives"][0]["targets"] = targets;
    let (input, output) = (model.numbers(&[0.0, 2.0]), model.numbers(&WEIGHTS));
    channel(
        model,
        json!({ "node": 0, "path": "weights" }),
        input,
        output,
        "CUBICSPLINE",
    );
}

/// A bar that a clip of two seconds bends and morphs.
pub fn bending() -> Model {
    let mut model = bar(1);
    bend(&mut model);
    morph(&mut model);
    model
}
