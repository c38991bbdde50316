//! Skins and morph targets that clips move, against matrices multiplied here in f64.

use super::bar::{COUNT, bar, bend, bending, channel, indices, morph, rest, share};
use super::model::{Model, UNSIGNED_BYTE, floats, picture};
use glam::{DMat4, DVec3, DVec4, Vec3};
use glimray::scene::{Scene, Target};
use serde_json::{Value, json};

/// The joints' matrices at a time, with their inverse bind matrices.
fn joints(time: f64) -> [DMat4; 2] {
    let turn = DMat4::from_rotation_z(std::f64::consts::FRAC_PI_4 * time);
    let first = DMat4::from_translation(DVec3::new(0.0, 2.0 * time, 2.0))
        * DMat4::from_scale(DVec3::new(1.0, 2.0, 3.0));
    let second = first * DMat4::from_translation(DVec3::X * 2.0) * turn;
    [
        first * DMat4::from_translation(DVec3::X * 0.5),
        second * DMat4::from_translation(DVec3::X * -2.0),
    ]
}

/// Where vertex `i` is after a displacement, and the normal that `normal` becomes.
fn skinned(i: usize, moved: DVec3, normal: DVec3, time: f64) -> [DVec3; 2] {
    let [a, b] = joints(time);
    let blend = a * (1.0 - share(i)) + b * share(i);
    let place = blend * (rest(i) + moved).extend(1.0);
    // Normals transform by the inverse transpose.
    let turned = blend.inverse().transpose() * DVec4::from((normal, 0.0));
    [place.truncate(), turned.truncate().normalize()]
}

/// Checks the first instance at several times against `expected`, which gives the position and the normal.
fn check(scene: &Scene, expected: impl Fn(usize, f64) -> [DVec3; 2]) {
    let instance = &scene.instances[0];
    let deformation = scene.deformation_of(instance.mesh).expect("a deformation");
    let index = scene.deformations.iter().position(|it| it == deformation);
    for time in [0.0, 0.4, 1.0, 1.7] {
        let frame = scene.frame(time);
        let pose = deformation.pose(&frame.nodes, &frame.weights[index.expect("an index")]);
        let posed = deformation.posed(&scene.meshes[instance.mesh], &pose);
        for i in 0..posed.len() {
            let (place, normal) = posed.vertex(i);
            let [wanted, direction] = expected(i, time);
            assert!(
                place.abs_diff_eq(wanted, 1e-5),
                "vertex {i} at {time}: {place} is not {wanted}"
            );
            assert!(posed.position(i) == place);
            assert!(
                normal.abs_diff_eq(direction, 1e-5),
                "normal {i} at {time}: {normal} is not {direction}"
            );
        }
    }
}

fn tilted() -> DVec3 {
    DVec3::new(0.0, -0.5, 1.0).normalize()
}

#[test]
fn a_bar_follows_two_joints_with_uneven_scales() {
    for sets in [1, 2] {
        let mut model = bar(sets);
        bend(&mut model);
        let scene = model.scene();
        assert_eq!(scene.skipped, [""; 0]);
        check(&scene, |i, time| skinned(i, DVec3::ZERO, tilted(), time));
    }
}

fn weights(time: f64) -> [f64; 2] {
    let (s, length) = (time / 2.0, 2.0);
    let hermite = |from: f64, leave: f64, reach: f64, to: f64| {
        let (s2, s3) = (s * s, s * s * s);
        (2.0 * s3 - 3.0 * s2 + 1.0) * from
            + length * (s3 - 2.0 * s2 + s) * leave
            + (3.0 * s2 - 2.0 * s3) * to
            + length * (s3 - s2) * reach
    };
    [hermite(0.0, 0.0, 0.0, 1.0), hermite(1.0, 0.5, -1.0, 3.0)]
}

/// The targets' offsets of the position and the normal of a vertex.
fn morphed(i: usize, time: f64) -> [DVec3; 2] {
    let [a, b] = weights(time);
    let is_aside = i >= COUNT;
    let aside = if is_aside { b } else { 0.0 };
    [
        DVec3::new(0.0, aside, a * rest(i).x),
        tilted() + DVec3::X * aside,
    ]
}

#[test]
fn morph_targets_move_a_bar_before_its_skin() {
    let scene = bending().scene();
    assert_eq!(scene.skipped, [""; 0]);
    check(&scene, |i, time| {
        let [moved, normal] = morphed(i, time);
        skinned(i, moved, normal, time)
    });
}

#[test]
fn morph_targets_without_a_skin_stay_at_their_node() {
    let mut model = bar(1);
    morph(&mut model);
    let node = model.json["nodes"][0].as_object_mut().expect("a node");
    node.remove("skin");
    let scene = model.scene();
    check(&scene, |i, time| {
        let [moved, normal] = morphed(i, time);
        [rest(i) + moved, normal.normalize()]
    });
    let node = scene.instances[0].node.expect("a node");
    let place = scene.frame(1.0).nodes[node].world_from_node.translation;
    assert_eq!(place, DVec3::X * 100.0);
}

#[test]
fn flat_meshes_stay_flat_in_every_pose() {
    let mut model = bar(1);
    bend(&mut model);
    let primitive = &mut model.json["meshes"][0]["primitives"][0];
    let attributes = primitive["attributes"].as_object_mut().expect("attributes");
    attributes.remove("NORMAL");
    let corners = indices();
    check(&model.scene(), |i, time| {
        let at = |i: usize| skinned(usize::from(corners[i]), DVec3::ZERO, DVec3::Z, time)[0];
        let first = i / 3 * 3;
        let [a, b, c] = [at(first), at(first + 1), at(first + 2)];
        [at(i), (b - a).cross(c - a).normalize()]
    });
}

#[test]
fn nodes_that_share_a_mesh_deform_apart() {
    let mut model = bar(1);
    bend(&mut model);
    morph(&mut model);
    // The second has other weights at rest, and joints that do not move.
    let skins = model.json["skins"].as_array_mut().expect("a list");
    let mut still = skins[0].clone();
    still["joints"] = json!([4, 5]);
    skins.push(still);
    let nodes = model.json["nodes"].as_array_mut().expect("a list");
    nodes.push(json!({ "children": [5] }));
    nodes.push(json!({}));
    nodes.push(json!({ "mesh": 0, "skin": 0, "weights": [0, 2] }));
    nodes.push(json!({ "mesh": 0, "skin": 1, "weights": [0, 2] }));
    model.json["scenes"][0]["nodes"] = json!([0, 1, 4, 6, 7]);
    let scene = model.scene();
    // The last one never moves: its pose is in its mesh.
    assert_eq!((scene.instances.len(), scene.deformations.len()), (3, 2));
    let [moved, other] = &scene.deformations[..] else {
        panic!("two deformations")
    };
    assert!(std::ptr::eq(
        &*scene.meshes[moved.mesh],
        &*scene.meshes[other.mesh]
    ));
    let frame = scene.frame(1.0);
    let expected = weights(1.0);
    assert!((frame.weights[0][1] - expected[1]).abs() < 1e-6);
    assert_eq!(frame.weights[1], [0.0, 2.0]);
    let pose = other.pose(&frame.nodes, &frame.weights[1]);
    let posed = other.posed(&scene.meshes[other.mesh], &pose);
    let last = 2 * COUNT - 1;
    let [wanted, _] = skinned(last, DVec3::Y * 2.0, DVec3::Z, 1.0);
    assert!(posed.position(last).abs_diff_eq(wanted, 1e-5));
    let still = &scene.meshes[scene.instances[2].mesh];
    let wanted = rest(last) + DVec3::Y * 2.0 - DVec3::X * 2.0;
    assert!(still.positions[last].as_dvec3().abs_diff_eq(wanted, 1e-5));
}

#[test]
fn a_clip_that_is_not_played_deforms_nothing() {
    let mut model = bar(1);
    bend(&mut model);
    let clip = model.json["animations"][0].clone();
    model.json["animations"][0] = json!({ "channels": [], "samplers": [] });
    model.push("animations", clip);
    let files = super::folder(&[("a.glb", &model.glb())]);
    let options = glimray::import::Options {
        clip: Some("0".to_owned()),
        ..Default::default()
    };
    let path = files.path().join("a.glb");
    let scene = glimray::import::load_with(&path, &options).expect("a scene");
    assert!(scene.deformations.is_empty() && scene.tracks.is_empty());
    let found = scene.meshes[0].positions[3].as_dvec3();
    assert!(found.abs_diff_eq(skinned(3, DVec3::ZERO, DVec3::Z, 0.0)[0], 1e-5));
}

#[test]
fn a_joint_may_shrink_to_nothing() {
    let mut model = bar(1);
    bend(&mut model);
    model.json["nodes"][2]["scale"] = json!([0, 0, 0]);
    let scene = model.scene();
    let (deformation, frame) = (&scene.deformations[0], scene.frame(0.0));
    let pose = deformation.pose(&frame.nodes, &frame.weights[0]);
    let posed = deformation.posed(&scene.meshes[0], &pose);
    let found = posed.position(2 * COUNT - 1);
    // Where the joint is.
    assert!(
        found.abs_diff_eq(DVec3::new(2.0, 0.0, 2.0), 1e-4),
        "{found}"
    );
}

#[test]
fn framing_holds_the_whole_animation() {
    let mut model = bar(1);
    bend(&mut model);
    let scene = model.scene();
    let camera = &scene.cameras[0];
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let tangent = (camera.fov_y / 2.0).tan();
    let mut highest = 0.0_f64;
    for step in 0..20 {
        let time = f64::from(step) / 10.0;
        for i in 0..2 * COUNT {
            let [place, _] = skinned(i, DVec3::ZERO, DVec3::Z, time);
            let to = place - camera.look_from;
            let depth = to.dot(forward) * tangent;
            let (x, y) = (to.dot(right) / (depth * 4.0 / 3.0), to.dot(up) / depth);
            highest = highest.max(x.abs()).max(y.abs());
        }
    }
    // A tenth of the picture is left free; between two of its moments the bar may reach into that.
    assert!((0.85..0.92).contains(&highest), "{highest}");
}

/// The notes on a bar after a change.
fn notes(change: impl FnOnce(&mut Model)) -> String {
    let mut model = bar(1);
    bend(&mut model);
    morph(&mut model);
    change(&mut model);
    model.scene().skipped.join("\n")
}

#[test]
fn bad_skins_and_targets_are_left_out_and_named() {
    let found = notes(|model| {
        let output = model.numbers(&[0.0; 9]);
        model.json["animations"][0]["samplers"][2]["output"] = json!(output);
    });
    let expected =
        "animations[0].channels[2].sampler.output: 9 values for 2 keys of 2 morph targets";
    assert!(found.contains(expected), "{found}");
    let found = notes(|model| {
        model.json["skins"][0]["joints"] = json!([1]);
    });
    let expected = "the skin has no joint 1: its vertices move with the first joint";
    assert!(found.contains(expected), "{found}");
    let found = notes(|model| {
        let short = model.vectors(&[[0.0; 3]; 4]);
        model.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(short);
    });
    let expected = "targets[1].POSITION: a target for another number of vertices";
    assert!(found.contains(expected), "{found}");
    let found = notes(|model| {
        let bind = [f32::NAN; 32];
        let bind = model.accessor(&floats(&bind), 5126, "MAT4", 2);
        model.json["skins"][0]["inverseBindMatrices"] = json!(bind);
    });
    let expected = "skins[0]: 2 joints have no inverse bind matrix";
    assert!(found.contains(expected), "{found}");
}

/// A channel that points at `pointer`.
fn pointed(model: &mut Model, pointer: &str, input: usize, output: usize, interpolation: &str) {
    let target = json!({
        "path": "pointer",
        "extensions": { "KHR_animation_pointer": { "pointer": pointer } },
    });
    channel(model, target, input, output, interpolation);
}

#[test]
fn pointers_animate_what_they_point_at() {
    let mut model = Model::triangle(json!({ "material": 0 })).with(json!({
        "extensionsUsed": ["KHR_animation_pointer", "KHR_lights_punctual", "KHR_node_visibility"],
        "extensionsRequired": ["KHR_animation_pointer"],
        "nodes": [
            { "mesh": 0, "children": [1, 2] },
            { "camera": 0 },
            { "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ],
        "materials": [{
            "pbrMetallicRoughness": { "metallicFactor": 0 },
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 5 } },
        }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 1 } }],
        "extensions": { "KHR_lights_punctual": { "lights": [
            { "type": "point", "intensity": 0, "color": [1, 0.5, 0] },
        ] } },
    }));
    let input = model.numbers(&[0.0, 2.0]);
    let three = model.vectors(&[[0.0; 3], [0.5, 1.0, 0.25]]);
    let four = model.quads(&[[1.0, 1.0, 1.0, 1.0], [0.0, 0.5, 1.0, 1.0]]);
    let fov = model.numbers(&[1.0, 0.5]);
    let intensity = model.numbers(&[0.0, 6.0]);
    let seen = model.accessor(&[1_u8, 0, 1], UNSIGNED_BYTE, "SCALAR", 3);
    let moments = model.numbers(&[0.0, 1.5, 2.0]);
    pointed(&mut model, "/nodes/0/translation", input, three, "LINEAR");
    pointed(
        &mut model,
        "/cameras/0/perspective/yfov",
        input,
        fov,
        "LINEAR",
    );
    pointed(
        &mut model,
        "/materials/0/emissiveFactor",
        input,
        three,
        "LINEAR",
    );
    let base_color = "/materials/0/pbrMetallicRoughness/baseColorFactor";
    pointed(&mut model, base_color, input, four, "LINEAR");
    let light = "/extensions/KHR_lights_punctual/lights/0/intensity";
    pointed(&mut model, light, input, intensity, "LINEAR");
    let visible = "/nodes/0/extensions/KHR_node_visibility/visible";
    pointed(&mut model, visible, moments, seen, "STEP");
    pointed(&mut model, "/materials/0/alphaCutoff", input, fov, "LINEAR");
    let scene = model.scene();
    assert_eq!(
        scene.skipped,
        ["animations[0] moves `/materials/0/alphaCutoff`, which is not shown"]
    );
    let frame = scene.frame(1.0);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    let node = scene.instances[0].node.expect("a node");
    let place = frame.nodes[node].world_from_node.translation;
    assert_eq!(place, DVec3::new(0.25, 0.5, 0.125));
    assert!(near(scene.cameras_at(1.0)[0].fov_y, 0.75));
    let material = &frame.materials[0];
    let emission = material.emission.as_dvec3();
    assert!(emission.abs_diff_eq(DVec3::new(1.25, 2.5, 0.625), 1e-5));
    let diffuse = material.classical().diffuse.as_dvec3();
    assert!(
        diffuse.abs_diff_eq(DVec3::new(0.5, 0.75, 1.0), 1e-5),
        "{diffuse}"
    );
    let color = frame.lights[0].color.as_dvec3() * std::f64::consts::PI;
    assert!(
        color.abs_diff_eq(DVec3::new(3.0, 1.5, 0.0), 1e-5),
        "{color}"
    );
    assert!(frame.nodes[node].visible && !scene.frame(1.75).nodes[node].visible);
}

/// The frame at 1 s of a triangle whose material a clip of 2 s changes: pointers in the material, and their values at
/// the ends.
fn material_at_half(
    material: serde_json::Value,
    channels: &[(&str, [f32; 2])],
) -> (glimray::scene::Scene, glimray::scene::Material) {
    let mut model = Model::triangle(json!({ "material": 0 })).with(json!({
        "extensionsUsed": ["KHR_animation_pointer"],
        "materials": [material],
    }));
    let input = model.numbers(&[0.0, 2.0]);
    for (pointer, ends) in channels {
        let pointer = format!("/materials/0/{pointer}");
        let output = model.numbers(ends);
        pointed(&mut model, &pointer, input, output, "LINEAR");
    }
    let scene = model.scene();
    let material = scene.frame(1.0).materials[0].clone();
    (scene, material)
}

#[test]
fn pointers_animate_the_layers_of_materials() {
    let channels = [
        ("pbrMetallicRoughness/roughnessFactor", [0.2, 0.6]),
        ("pbrMetallicRoughness/metallicFactor", [0.0, 0.5]),
        ("extensions/KHR_materials_ior/ior", [1.5, 2.0]),
        (
            "extensions/KHR_materials_transmission/transmissionFactor",
            [0.0, 1.0],
        ),
        (
            "extensions/KHR_materials_emissive_strength/emissiveStrength",
            [2.0, 6.0],
        ),
    ];
    let material = json!({
        "pbrMetallicRoughness": { "roughnessFactor": 0.2, "metallicFactor": 0 },
        "emissiveFactor": [1, 0.5, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 2 } },
    });
    let (scene, half) = material_at_half(material, &channels);
    assert!(scene.skipped.is_empty(), "{:?}", scene.skipped);
    let model = half.metallic_roughness().expect("the model");
    let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
    assert!(near(model.roughness, 0.4) && near(model.metallic, 0.25));
    assert!(near(model.ior, 1.75) && near(model.transmission, 0.5));
    let emission = half.emission.as_dvec3();
    assert!(
        emission.abs_diff_eq(DVec3::new(4.0, 2.0, 0.0), 1e-5),
        "{emission}"
    );
    // The classical colours are those of a material that always had these values.
    let still = json!({
        "pbrMetallicRoughness": { "roughnessFactor": 0.4, "metallicFactor": 0.25 },
        "extensions": {
            "KHR_materials_ior": { "ior": 1.75 },
            "KHR_materials_transmission": { "transmissionFactor": 0.5 },
        },
    });
    let still = Model::triangle(json!({ "material": 0 })).with(json!({ "materials": [still] }));
    let expected = still.scene().materials[0].clone();
    for (found, expected) in [
        (half.classical().diffuse, expected.classical().diffuse),
        (half.classical().specular, expected.classical().specular),
        (half.classical().reflect, expected.classical().reflect),
        (half.classical().transmit, expected.classical().transmit),
        (
            Vec3::splat(half.classical().shininess),
            Vec3::splat(expected.classical().shininess),
        ),
    ] {
        assert!(found.abs_diff_eq(expected, 1e-5), "{found}, not {expected}");
    }
    assert!(half.thin && half.classical().transmit != Vec3::ZERO);
    // Both integrators get them, and the code for glass.
    let packed = glimray::pack::scene(&scene).expect("a scene that can be packed");
    assert!(packed.features.refraction && packed.features.thin_walls);
    assert!(packed.features.rough_glass);
    let view = packed.frame(&scene.frame(1.0)).expect("a frame");
    let layers = view.materials[0].layers;
    assert!(near(layers.roughness, 0.4) && near(layers.transmission, 0.5));
}

#[test]
fn a_light_that_a_clip_turns_on_keeps_its_map() {
    for (material, channel) in [
        (json!({}), "emissiveFactor"),
        (
            json!({
                "emissiveFactor": [1, 1, 1],
                "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 0 } },
            }),
            "extensions/KHR_materials_emissive_strength/emissiveStrength",
        ),
    ] {
        let mut model = Model::triangle(json!({ "material": 0 })).with(json!({
            "extensionsUsed": ["KHR_animation_pointer", "KHR_materials_emissive_strength"],
            "materials": [material],
        }));
        let uv = model.pairs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
        let texture = picture(&mut model, 1, &[[255, 0, 0, 255]]);
        model.json["materials"][0]["emissiveTexture"] = json!({ "index": texture });
        assert_eq!(
            model.scene().materials[0].textures.emission,
            None,
            "{channel}"
        );
        let input = model.numbers(&[0.0, 2.0]);
        let values = match channel {
            "emissiveFactor" => model.vectors(&[[0.0; 3], [1.0; 3]]),
            _ => model.numbers(&[0.0, 1.0]),
        };
        let pointer = format!("/materials/0/{channel}");
        pointed(&mut model, &pointer, input, values, "LINEAR");
        let scene = model.scene();
        assert!(scene.materials[0].textures.emission.is_some(), "{channel}");
    }
}

#[test]
fn base_colors_move_with_vertex_colors_and_alpha_in_both_models() {
    let mut model = Model::triangle(json!({ "material": 0 })).with(json!({
        "extensionsUsed": ["KHR_animation_pointer"],
        "materials": [{ "alphaMode": "BLEND", "pbrMetallicRoughness": { "metallicFactor": 0 } }],
    }));
    let color = model.quads(&[[0.25, 1.0, 0.0, 1.0]; 3]);
    model.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(color);
    let input = model.numbers(&[0.0, 2.0]);
    let values = model.quads(&[[1.0, 1.0, 1.0, 1.0], [0.0, 0.5, 1.0, 0.2]]);
    let pointer = "/materials/0/pbrMetallicRoughness/baseColorFactor";
    pointed(&mut model, pointer, input, values, "LINEAR");
    let scene = model.scene();
    assert!(scene.skipped.is_empty(), "{:?}", scene.skipped);
    let material = &scene.frame(1.0).materials[0];
    assert!((material.alpha - 0.6).abs() < 1e-6, "{}", material.alpha);
    let base = DVec3::new(0.5, 0.75, 1.0);
    let model = material.metallic_roughness().expect("the model");
    assert!(model.base_color.as_dvec3().abs_diff_eq(base, 1e-6));
    assert_eq!(scene.meshes[0].colors, [glam::vec4(0.25, 1.0, 0.0, 1.0); 3]);
    let diffuse = material.classical().diffuse.as_dvec3();
    assert!(diffuse.abs_diff_eq(base, 1e-6), "{diffuse}, not {base}");
    let packed = glimray::pack::scene(&scene).expect("a scene that can be packed");
    let view = packed.frame(&scene.frame(1.0)).expect("a frame");
    let seen = Vec3::from(view.materials[0].layers.base).as_dvec3();
    assert!(seen.abs_diff_eq(base, 1e-6), "{seen}, not {base}");
}

#[test]
fn what_pointers_cannot_animate_is_named() {
    let dark = json!({
        "emissiveFactor": [1, 1, 1],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 0 } },
    });
    let strength = "extensions/KHR_materials_emissive_strength/emissiveStrength";
    let turn = "normalTexture/scale";
    let rough = "pbrMetallicRoughness/roughnessFactor";
    let channels = [
        (strength, [0.0, 1.0]),
        (turn, [0.0, 1.0]),
        (rough, [0.0, 1.0]),
    ];
    let (scene, _) = material_at_half(dark, &channels);
    assert_eq!(
        scene.skipped,
        [
            "animations[0] moves the strength of an emission that is 0 at rest, which is not shown",
            "animations[0] moves `/materials/0/normalTexture/scale`, which is not shown",
        ]
    );
}

#[test]
fn weights_of_a_mesh_are_those_of_nodes_without_their_own() {
    let mut model = bar(1);
    morph(&mut model);
    let nodes = model.json["nodes"].as_array_mut().expect("a list");
    nodes[0].as_object_mut().expect("a node").remove("skin");
    nodes.push(json!({ "mesh": 0, "weights": [1, 0] }));
    model.json["scenes"][0]["nodes"] = json!([0, 4]);
    model.json["animations"] = Value::Null;
    let (input, output) = (
        model.numbers(&[0.0, 2.0]),
        model.numbers(&[0.0, 0.0, 1.0, 3.0]),
    );
    pointed(&mut model, "/meshes/0/weights", input, output, "LINEAR");
    let scene = model.scene();
    assert_eq!(scene.deformations.len(), 1);
    assert_eq!(scene.frame(1.0).weights, [[0.5, 1.5]]);
    assert_eq!(scene.tracks[1].targets, [Target::Weight(0, 1)]);
}

#[test]
fn a_node_may_be_hidden() {
    let mut model = Model::triangle(json!({}));
    model.json["nodes"] = json!([
        { "children": [1], "extensions": { "KHR_node_visibility": { "visible": false } } },
        { "mesh": 0 },
    ]);
    let scene = model.scene();
    let node = scene.instances[0].node.expect("a node");
    assert!(!scene.frame(0.0).nodes[node].visible);
}
