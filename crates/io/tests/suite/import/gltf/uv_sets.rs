//! Sets of texture coordinates: whatever their numbers are, a material gets the two that it uses.

use super::model::Model;
use super::model::picture;
use glimray::scene::{Scene, Space};
use serde_json::{Value, json};

/// Values that no other set has.
fn values(model: &mut Model, set: usize) -> usize {
    let x = set as f32 / 8.0;
    model.pairs(&[[x, 0.0], [0.5, x], [0.0, 1.0 - x]])
}

/// A triangle with two pictures, and the accessors of six sets of texture coordinates, which no primitive has yet.
fn model(materials: &[Value]) -> (Model, [usize; 6]) {
    let mut model = Model::triangle(json!({ "material": 0 }));
    for other in 1..materials.len() {
        let position = model.vectors(&[[2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 1.0, 0.0]]);
        model.primitive(position, json!({ "material": other }));
    }
    let sets = [0, 1, 2, 3, 4, 5].map(|set| values(&mut model, set));
    for material in materials {
        model.push("materials", material.clone());
    }
    picture(&mut model, 2, &[[255, 0, 0, 255], [0, 200, 50, 255]]);
    picture(&mut model, 2, &[[128, 128, 255, 255], [90, 128, 240, 255]]);
    (model, sets)
}

/// Gives a primitive sets of texture coordinates: numbers and accessors.
fn give(model: &mut Model, primitive: usize, sets: &[(u32, usize)]) {
    let attributes = &mut model.json["meshes"][0]["primitives"][primitive]["attributes"];
    for (set, accessor) in sets {
        attributes[format!("TEXCOORD_{set}")] = json!(accessor);
    }
}

/// A base colour with the set `color`, and a normal map with the set `normal`.
fn two_maps(color: u32, normal: u32) -> Value {
    json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": color } },
        // The set in the extension counts.
        "normalTexture": { "index": 1, "texCoord": 9,
            "extensions": { "KHR_texture_transform": { "texCoord": normal } } },
    })
}

/// Checks that nothing is noted of `scene` and that it looks like `other`.
fn assert_same(scene: &Scene, other: &Scene) {
    assert_eq!(scene.skipped, [""; 0]);
    assert!(scene.meshes[0].second_uvs != scene.meshes[0].uvs);
    assert_eq!(scene.meshes, other.meshes);
    assert_eq!(scene.textures, other.textures);
    assert_eq!(scene.materials, other.materials);
}

#[test]
fn sets_with_high_numbers_are_those_of_a_model_with_the_first_two() {
    let (mut high, sets) = model(&[two_maps(2, 5)]);
    let all: Vec<_> = (0..6).zip(sets).collect();
    give(&mut high, 0, &all);
    let (mut low, sets) = model(&[two_maps(0, 1)]);
    give(&mut low, 0, &[(0, sets[2]), (1, sets[5])]);
    assert_same(&high.scene(), &low.scene());
}

#[test]
fn materials_of_one_mesh_have_different_pairs_of_sets() {
    let (mut high, sets) = model(&[two_maps(3, 2), two_maps(0, 4)]);
    let all: Vec<_> = (0..6).zip(sets).collect();
    give(&mut high, 0, &all);
    give(&mut high, 1, &all);
    let (mut low, sets) = model(&[two_maps(0, 1), two_maps(0, 1)]);
    give(&mut low, 0, &[(0, sets[3]), (1, sets[2])]);
    give(&mut low, 1, &[(0, sets[0]), (1, sets[4])]);
    assert_same(&high.scene(), &low.scene());
}

/// A base colour, an emission and a normal map with three sets.
fn three_maps(sets: [u32; 3]) -> Value {
    let [color, emission, normal] = sets;
    let mut material = two_maps(color, normal);
    material["name"] = json!("Paint");
    material["emissiveFactor"] = json!([1, 1, 1]);
    material["emissiveTexture"] = json!({ "index": 0, "texCoord": emission });
    material
}

#[test]
fn sets_with_the_same_values_count_once() {
    let (mut thrice, sets) = model(&[three_maps([0, 4, 2])]);
    give(&mut thrice, 0, &[(0, sets[1]), (4, sets[1]), (2, sets[3])]);
    let (mut twice, sets) = model(&[three_maps([0, 0, 1])]);
    give(&mut twice, 0, &[(0, sets[1]), (1, sets[3])]);
    assert_same(&thrice.scene(), &twice.scene());
}

#[test]
fn sets_that_differ_in_another_primitive_are_different() {
    let (mut model, sets) = model(&[three_maps([0, 4, 2]), json!({})]);
    model.json["meshes"][0]["primitives"][1]["material"] = json!(0);
    give(&mut model, 0, &[(0, sets[1]), (4, sets[1]), (2, sets[3])]);
    give(&mut model, 1, &[(0, sets[1]), (4, sets[2]), (2, sets[3])]);
    assert_eq!(
        model.scene().skipped,
        [
            "materials[0] `Paint`: emissiveTexture is not shown, as TEXCOORD_4 is a third set of texture coordinates"
        ]
    );
}

#[test]
fn maps_of_layers_leave_the_two_sets_to_those_of_the_surface() {
    let coated = |factor: f64| {
        let mut material = two_maps(1, 2);
        material["extensions"] = json!({ "KHR_materials_clearcoat": {
            "clearcoatFactor": factor,
            "clearcoatTexture": { "index": 1, "texCoord": 0 },
        } });
        let (mut model, sets) = model(&[material]);
        give(&mut model, 0, &[(0, sets[0]), (1, sets[1]), (2, sets[2])]);
        // By default models are path-traced.
        super::scene("a.glb", model.glb())
    };
    let (scene, without) = (coated(0.5), coated(0.0));
    assert_eq!(
        scene.skipped,
        [
            "materials[0]: clearcoatTexture is not shown, as TEXCOORD_0 is a third set of texture coordinates"
        ]
    );
    assert!(scene.materials[0].textures.normal.is_some());
    // A layer that is not there has no map to be missed.
    assert_eq!(without.skipped, [""; 0]);
}

#[test]
fn coordinates_that_are_not_numbers_are_zero_and_reported() {
    let (mut model, _) = model(&[two_maps(0, 0)]);
    let broken = model.pairs(&[[f32::NAN, 0.25], [f32::INFINITY, f32::NAN], [0.0, 1.0]]);
    give(&mut model, 0, &[(0, broken)]);
    let scene = model.scene();
    let rows: Vec<_> = (scene.meshes[0].uvs.iter())
        .map(|uv| uv.to_array())
        .collect();
    // v points down in glTF.
    assert_eq!(rows, [[0.0, 0.75], [1e9, 1.0], [0.0, 0.0]]);
    assert_eq!(
        scene.skipped,
        ["texture coordinates that are not numbers, set to 0: 2"]
    );
}

/// The maps of the specification and of its extensions, by where they are in a material, with factors that show them.
fn maps_besides_the_base_colour() -> Vec<(&'static str, &'static str, Value)> {
    let coat = json!({ "clearcoatFactor": 1, "clearcoatRoughnessFactor": 1 });
    let sheen = json!({ "sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 1 });
    let film = json!({ "iridescenceFactor": 1 });
    let through = json!({ "diffuseTransmissionFactor": 1 });
    vec![
        (
            "pbrMetallicRoughness",
            "metallicRoughnessTexture",
            json!({}),
        ),
        ("", "normalTexture", json!({})),
        ("", "occlusionTexture", json!({})),
        ("", "emissiveTexture", json!({})),
        (
            "KHR_materials_transmission",
            "transmissionTexture",
            json!({ "transmissionFactor": 1 }),
        ),
        ("KHR_materials_specular", "specularTexture", json!({})),
        ("KHR_materials_specular", "specularColorTexture", json!({})),
        ("KHR_materials_clearcoat", "clearcoatTexture", coat.clone()),
        (
            "KHR_materials_clearcoat",
            "clearcoatRoughnessTexture",
            coat.clone(),
        ),
        ("KHR_materials_clearcoat", "clearcoatNormalTexture", coat),
        ("KHR_materials_sheen", "sheenColorTexture", sheen.clone()),
        ("KHR_materials_sheen", "sheenRoughnessTexture", sheen),
        (
            "KHR_materials_anisotropy",
            "anisotropyTexture",
            json!({ "anisotropyStrength": 1 }),
        ),
        (
            "KHR_materials_iridescence",
            "iridescenceTexture",
            film.clone(),
        ),
        (
            "KHR_materials_iridescence",
            "iridescenceThicknessTexture",
            film,
        ),
        (
            "KHR_materials_diffuse_transmission",
            "diffuseTransmissionTexture",
            through.clone(),
        ),
        (
            "KHR_materials_diffuse_transmission",
            "diffuseTransmissionColorTexture",
            through,
        ),
    ]
}

#[test]
fn every_map_may_have_a_set_of_its_own() {
    for (place, map, factors) in maps_besides_the_base_colour() {
        let mut material = json!({
            "emissiveFactor": [1, 1, 1],
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 0 } },
        });
        let owner = match place {
            "" => &mut material,
            "pbrMetallicRoughness" => &mut material[place],
            extension => {
                material["extensions"][extension] = factors;
                &mut material["extensions"][extension]
            }
        };
        owner[map] = json!({ "index": 1, "texCoord": 3 });
        let (mut model, sets) = model(&[material]);
        give(&mut model, 0, &[(0, sets[0]), (3, sets[3])]);
        let scene = super::scene("a.glb", model.glb());
        assert_eq!(scene.skipped, [""; 0], "{map}");
        let seconds = scene
            .textures
            .iter()
            .filter(|it| it.space == Space::SecondUv);
        assert!(seconds.count() > 0, "{map}");
        let mesh = &scene.meshes[0];
        assert_eq!((mesh.uvs[0].x, mesh.second_uvs[0].x), (0.0, 0.375), "{map}");
    }
}
