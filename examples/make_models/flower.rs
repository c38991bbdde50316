//! A flower that sways and opens under a glass dome: a skin on a chain of joints, a morph target, a clip, pictures with
//! roles (colour, normals, holes), metal, and glass with a volume.

use crate::{
    glb::{Glb, floats},
    pictures,
    surface::Surface,
};
use glam::{Mat4, Quat, Vec3, vec3};
use serde_json::{Value, json};
use std::{
    error::Error,
    f32::consts::{PI, TAU},
};

/// Joints of the stem, evenly spaced from the soil to the flower.
const JOINTS: usize = 6;
/// Distance of two joints in metres.
const BONE: f32 = 0.055;
/// Height of the soil.
const SOIL: f32 = 0.105;
/// Duration of the clip in seconds.
const SECONDS: f32 = 4.0;
/// Keys of the clip per second.
const RATE: f32 = 12.0;

pub fn write(path: &str) -> Result<(), Box<dyn Error>> {
    let mut glb = Glb::default();
    let wood = glb.picture(&pictures::wood())?;
    let dents = glb.picture(&pictures::dents())?;
    let leaf = glb.picture(&pictures::leaf())?;
    let materials = [
        json!({ "name": "wood", "pbrMetallicRoughness": {
            "baseColorTexture": { "index": wood }, "metallicFactor": 0, "roughnessFactor": 0.55 } }),
        json!({ "name": "brass", "pbrMetallicRoughness": {
            "baseColorFactor": [0.89, 0.7, 0.36, 1], "metallicFactor": 1, "roughnessFactor": 0.2 } }),
        json!({ "name": "clay", "normalTexture": { "index": dents, "scale": 0.8 },
            "pbrMetallicRoughness": {
            "baseColorFactor": [0.62, 0.2, 0.09, 1], "metallicFactor": 0, "roughnessFactor": 0.75 } }),
        json!({ "name": "soil", "pbrMetallicRoughness": {
            "baseColorFactor": [0.04, 0.025, 0.018, 1], "metallicFactor": 0 } }),
        json!({ "name": "stem", "pbrMetallicRoughness": {
            "baseColorFactor": [0.12, 0.3, 0.07, 1], "metallicFactor": 0, "roughnessFactor": 0.5 } }),
        json!({ "name": "leaf", "alphaMode": "MASK", "doubleSided": true, "pbrMetallicRoughness": {
            "baseColorTexture": { "index": leaf }, "metallicFactor": 0, "roughnessFactor": 0.45 } }),
        json!({ "name": "petals", "doubleSided": true, "pbrMetallicRoughness": {
            "metallicFactor": 0, "roughnessFactor": 0.6 } }),
        json!({ "name": "pollen", "pbrMetallicRoughness": {
            "baseColorFactor": [0.95, 0.55, 0.05, 1], "metallicFactor": 0, "roughnessFactor": 0.9 } }),
        json!({ "name": "glass", "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
            "extensions": {
                "KHR_materials_transmission": { "transmissionFactor": 1 },
                "KHR_materials_ior": { "ior": 1.5 },
                "KHR_materials_volume": { "thicknessFactor": 0.003,
                    "attenuationDistance": 0.2, "attenuationColor": [0.8, 0.95, 0.9] } } }),
    ];
    let material = |name: &str| materials.iter().position(|it| it["name"] == name);

    let base = Surface::lathe(
        &[
            [0.0, 0.0],
            [0.17, 0.0],
            [0.175, 0.006],
            [0.175, 0.022],
            [0.165, 0.03],
            [0.0, 0.03],
        ],
        96,
    );
    let rim = Surface::torus(0.158, 0.006, 96, 12).moved(vec3(0.0, 0.033, 0.0));
    let pot = Surface::lathe(
        &[
            [0.0, 0.03],
            [0.045, 0.03],
            [0.066, 0.1],
            [0.074, 0.1],
            [0.074, 0.116],
            [0.065, 0.116],
            [0.062, SOIL],
        ],
        96,
    );
    let soil = Surface::lathe(&[[0.063, SOIL], [0.0, SOIL + 0.004]], 48);
    let still = [
        (base, "wood"),
        (rim, "brass"),
        (pot, "clay"),
        (soil, "soil"),
        (dome(), "glass"),
    ];
    let still = still.map(|(surface, name)| glb.primitive(&surface, material(name), json!({})));
    let still = glb.mesh("still life", still);
    let plant = [
        glb.skinned(&stem(), material("stem"), stem_weights),
        glb.skinned(&leaves(), material("leaf"), leaf_weights),
    ];
    let plant = glb.mesh("plant", plant);
    let flower = flower(&mut glb, material("petals"), material("pollen"));
    let flower = glb.mesh("flower", flower);

    // Nodes: 0 what stands still, 1 the plant, 2… the joints, and the flower on the last one.
    let mut nodes = vec![
        json!({ "name": "still life", "mesh": still }),
        json!({ "name": "plant", "mesh": plant, "skin": 0 }),
    ];
    let first = nodes.len();
    for joint in 0..JOINTS {
        let height = if joint == 0 { SOIL } else { BONE };
        let child = first + joint + 1;
        nodes.push(
            json!({ "name": format!("joint {joint}"), "children": [child],
            "translation": [0, height, 0] }),
        );
    }
    nodes.push(json!({ "name": "flower", "mesh": flower, "weights": [1] }));
    let inverses: Vec<f32> = (0..JOINTS)
        .flat_map(|joint| {
            let height = SOIL + BONE * joint as f32;
            Mat4::from_translation(vec3(0.0, -height, 0.0)).to_cols_array()
        })
        .collect();
    let inverses = glb.accessor(&floats(&inverses), "MAT4", JOINTS, json!({}));
    let joints: Vec<usize> = (first..first + JOINTS).collect();
    let clip = clip(&mut glb, &joints, first + JOINTS);
    glb.write(path, json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"],
        "scene": 0,
        "scenes": [{ "nodes": [0, 1, first] }],
        "nodes": nodes,
        "materials": materials,
        "skins": [{ "joints": joints, "inverseBindMatrices": inverses }],
        "animations": [clip],
    }))?;
    Ok(())
}

/// A shell of glass, 3 mm thick, with its edge on the base.
fn dome() -> Surface {
    const RADIUS: f32 = 0.15;
    const WALL: f32 = 0.003;
    const STRAIGHT: f32 = 0.4;
    const STEPS: u32 = 20;
    let mut profile = Vec::new();
    let mut arc = |radius: f32, angles: &mut dyn Iterator<Item = u32>| {
        for i in angles {
            let (sin, cos) = (i as f32 / STEPS as f32 * PI / 2.0).sin_cos();
            profile.push([radius * cos, STRAIGHT + radius * sin]);
        }
    };
    arc(RADIUS, &mut (0..=STEPS));
    arc(RADIUS - WALL, &mut (0..=STEPS).rev());
    profile.insert(0, [RADIUS, 0.0301]);
    profile.push([RADIUS - WALL, 0.0301]);
    profile.push([RADIUS, 0.0301]);
    Surface::lathe(&profile, 96)
}

/// The height of a point above the soil, in bones.
fn bones(point: Vec3) -> f32 {
    ((point.y - SOIL) / BONE).clamp(0.0, (JOINTS - 1) as f32)
}

fn stem() -> Surface {
    let length = BONE * (JOINTS - 1) as f32;
    Surface::grid([16, 40], |u, v| {
        let radius = 0.006 - 0.002 * v;
        let (sin, cos) = (u * TAU).sin_cos();
        vec3(radius * cos, SOIL + length * v, -radius * sin)
    })
}

/// Between two joints a point follows both.
fn stem_weights(point: Vec3) -> ([u8; 4], [f32; 4]) {
    let at = bones(point);
    let joint = (at as usize).min(JOINTS - 2);
    let part = at - joint as f32;
    (
        [joint as u8, joint as u8 + 1, 0, 0],
        [1.0 - part, part, 0.0, 0.0],
    )
}

/// Heights of the leaves above the soil in metres, and their directions in turns.
const LEAVES: [(f32, f32); 5] = [
    (0.03, 0.1),
    (0.07, 0.48),
    (0.11, 0.86),
    (0.15, 0.24),
    (0.19, 0.62),
];

fn leaves() -> Surface {
    let mut all = Surface::default();
    for (height, turn) in LEAVES {
        let size = 0.135 - 0.28 * height;
        let turned = Quat::from_rotation_y(turn * TAU);
        all.add(&Surface::grid([12, 24], |u, v| {
            let across = (u - 0.5) * 0.5 * size;
            let along = v * size;
            let lift = 0.55 * along - 4.5 * along * along + 2.0 * across * across / size;
            turned * vec3(along, lift, across) + vec3(0.0, SOIL + height, 0.0)
        }));
    }
    all
}

/// A leaf follows the bone that it grows on: the nearest leaf's.
fn leaf_weights(point: Vec3) -> ([u8; 4], [f32; 4]) {
    let direction = (-point.z).atan2(point.x).rem_euclid(TAU) / TAU;
    let apart = |turn: f32| {
        let difference = (direction - turn).rem_euclid(1.0);
        difference.min(1.0 - difference)
    };
    let nearest = LEAVES
        .iter()
        .min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)));
    let height = nearest.map_or(0.0, |leaf| leaf.0);
    stem_weights(vec3(0.0, SOIL + height, 0.0))
}

/// Two rings of petals that open, and a head of pollen.
fn flower(glb: &mut Glb, petals: Option<usize>, pollen: Option<usize>) -> [Value; 2] {
    let ring = |count: usize, length: f32, opening: f32, phase: f32| {
        let mut all = Surface::default();
        for i in 0..count {
            let turned = Quat::from_rotation_y((i as f32 + phase) / count as f32 * TAU);
            all.add(&Surface::grid([10, 16], |u, v| {
                let width = 0.42 * length * (PI * (0.12 + 0.83 * v)).sin();
                let across = (u - 0.5) * 2.0 * width;
                // The petal is an arc: the angle from the axis grows with the distance from the centre.
                let lean = opening * (0.25 + 0.75 * v);
                let (sin, cos) = lean.sin_cos();
                let cup = 6.0 * across * across * (1.0 - 0.4 * opening);
                turned
                    * vec3(
                        0.004 + v * length * sin - cup * cos,
                        v * length * cos + cup * sin,
                        across,
                    )
            }));
        }
        all
    };
    let shape = |opening: f32| {
        let mut all = ring(8, 0.07, 1.25 * opening + 0.12, 0.0);
        all.add(&ring(8, 0.058, 0.95 * opening + 0.08, 0.5));
        all
    };
    let (closed, open) = (shape(0.0), shape(1.0));
    let colors: Vec<f32> = closed
        .uvs
        .iter()
        .flat_map(|[_, v]| {
            let tip = vec3(0.83, 0.06, 0.16);
            let heart = vec3(0.98, 0.55, 0.5);
            heart.lerp(tip, v.sqrt()).extend(1.0).to_array()
        })
        .collect();
    let colors = glb.accessor(&floats(&colors), "VEC4", closed.positions.len(), json!({}));
    let target = glb.morph(&closed, &open);
    let more = json!({ "attributes": { "COLOR_0": colors }, "targets": [target] });
    let petals = glb.primitive(&closed, petals, more);
    let head = Surface::grid([24, 12], |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        let (low, high) = (PI * (1.0 - v)).sin_cos();
        0.012 * vec3(low * cos, 0.7 * high + 0.6, -low * sin)
    });
    let target = glb.morph(&head, &head);
    let head = glb.primitive(&head, pollen, json!({ "targets": [target] }));
    [petals, head]
}

/// The stem sways in an ellipse, each joint a little later than the one below; the flower closes and opens.
fn clip(glb: &mut Glb, joints: &[usize], flower: usize) -> Value {
    let count = (SECONDS * RATE) as usize + 1;
    let times: Vec<f32> = (0..count).map(|i| i as f32 / RATE).collect();
    let bounds = json!({ "min": [0], "max": [SECONDS] });
    let input = glb.accessor(&floats(&times), "SCALAR", count, bounds);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    for (i, &joint) in joints.iter().enumerate() {
        let turns = times.iter().flat_map(|time| {
            let phase = TAU * time / SECONDS - 0.35 * i as f32;
            let turn = Quat::from_rotation_z(0.09 * phase.sin())
                * Quat::from_rotation_x(0.05 * phase.cos());
            turn.to_array()
        });
        let output = glb.accessor(
            &floats(&turns.collect::<Vec<_>>()),
            "VEC4",
            count,
            json!({}),
        );
        channels.push(
            json!({ "sampler": samplers.len(), "target": { "node": joint, "path": "rotation" } }),
        );
        samplers.push(json!({ "input": input, "output": output }));
    }
    let weights: Vec<f32> = times
        .iter()
        .map(|time| 0.55 + 0.45 * (TAU * time / SECONDS).cos())
        .collect();
    let output = glb.accessor(&floats(&weights), "SCALAR", count, json!({}));
    channels.push(
        json!({ "sampler": samplers.len(), "target": { "node": flower, "path": "weights" } }),
    );
    samplers.push(json!({ "input": input, "output": output }));
    json!({ "name": "sway", "samplers": samplers, "channels": channels })
}
