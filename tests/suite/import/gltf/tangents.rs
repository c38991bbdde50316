//! TANGENT attributes, and tangents that the importer makes.

use super::model::{FLOAT, Model};
use crate::reference::compare::{check_same_bits, differing, render, sized};
use glam::{Vec3, Vec4};
use glimray::scene::{Mesh, Scene};
use serde_json::{Value, json};

/// A triangle with u and v, and a normal map of one colour if `has_map`.
fn model(attributes: Value, has_map: bool) -> Model {
    let mut model = Model::new();
    let position = model.vectors(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let tilt = 0.6f32;
    let normals = [[tilt, 0.0, 0.8], [0.0, tilt, 0.8], [0.0, 0.0, 1.0]];
    let normal = model.vectors(&normals);
    // v points down in the file: this mapping is mirrored.
    let uv = model.pairs(&[[0.0, 0.0], [1.0, 0.2], [0.1, 1.0]]);
    let mut all = json!({ "NORMAL": normal, "TEXCOORD_0": uv });
    for (name, accessor) in attributes.as_object().expect("attributes") {
        all[name] = accessor.clone();
    }
    model.primitive(position, json!({ "attributes": all, "material": 0 }));
    let texture = super::model::picture(&mut model, 1, &[[200, 90, 220, 255]]);
    model.json["materials"] = match has_map {
        true => json!([{ "normalTexture": { "index": texture } }]),
        false => json!([{}]),
    };
    model
}

fn with_tangents(values: &[[f32; 4]]) -> Model {
    // Accessors are numbered in the order in which they were added.
    let mut with = model(json!({ "TANGENT": 3 }), true);
    with.quads(values);
    with
}

fn mesh(model: &Model) -> Mesh {
    (*model.scene().meshes[0]).clone()
}

fn picture(scene: &Scene) -> glimray::image::Image {
    render(scene, &sized(40, 40)).0
}

#[test]
fn tangents_in_the_file_are_kept_and_others_are_made() {
    let made = mesh(&model(json!({}), true));
    assert_eq!(made.tangents.len(), 3);
    for (tangent, normal) in made.tangents.iter().zip(&made.normals) {
        assert!((tangent.truncate().length() - 1.0).abs() < 1e-6);
        assert!(tangent.truncate().dot(*normal).abs() < 1e-6);
        // u grows to the right and v, which points up in the picture, downwards.
        assert!(tangent.x > 0.5 && tangent.w == -1.0, "{tangent}");
    }
    let own = [
        [0.0, 2.0, 0.0, 1.0],
        [0.6, 0.8, 0.0, -1.0],
        [1.0, 0.0, 0.0, 1.0],
    ];
    let kept = mesh(&with_tangents(&own));
    let unit = Vec4::new(0.0, 1.0, 0.0, 1.0);
    assert_eq!(
        kept.tangents,
        [unit, Vec4::from(own[1]), Vec4::from(own[2])]
    );
}

#[test]
fn a_file_with_the_tangents_that_would_be_made_shows_the_same() {
    let without = model(json!({}), true);
    let made: Vec<[f32; 4]> = mesh(&without)
        .tangents
        .iter()
        .map(|t| t.to_array())
        .collect();
    let with = with_tangents(&made);
    let (without, with) = (without.scene(), with.scene());
    assert_eq!(without.meshes, with.meshes);
    let expected = picture(&without);
    check_same_bits("the tangents that were made", &picture(&with), &expected).expect("the same");
    let turned: Vec<_> = made.iter().map(|[x, y, z, w]| [-x, -y, -z, *w]).collect();
    let other = picture(&with_tangents(&turned).scene());
    assert!(
        differing(&other, &expected, 4.0) > 100,
        "tangents have no effect"
    );
}

#[test]
fn without_a_normal_map_no_tangents_are_kept() {
    let mut plain = model(json!({ "TANGENT": 3 }), false);
    plain.quads(&[[1.0, 0.0, 0.0, 1.0]; 3]);
    assert!(mesh(&plain).tangents.is_empty());
}

#[test]
fn anisotropy_needs_tangents_too() {
    let mut brushed = model(json!({}), false);
    brushed.json["materials"][0]["extensions"] =
        json!({ "KHR_materials_anisotropy": { "anisotropyStrength": 0.5 } });
    brushed.json["extensionsUsed"] = json!(["KHR_materials_anisotropy"]);
    assert_eq!(mesh(&brushed).tangents.len(), 3);
}

#[test]
fn tangents_that_are_no_directions_are_made() {
    let odd = [
        [0.0, 0.0, 0.0, 1.0],
        [f32::NAN, 0.0, 0.0, 1.0],
        [f32::INFINITY, 0.0, 0.0, 1.0],
    ];
    assert_eq!(
        mesh(&with_tangents(&odd)).tangents,
        mesh(&model(json!({}), true)).tangents
    );
}

#[test]
fn tangents_of_another_number_of_vertices_are_left_out() {
    let mut short = model(json!({ "TANGENT": 3 }), true);
    short.accessor(&super::model::floats(&[1.0; 8]), FLOAT, "VEC4", 2);
    let notes = short.scene().skipped.join("\n");
    assert!(
        notes.contains("TANGENT: 2 values for 3 vertices"),
        "{notes}"
    );
}

#[test]
fn morph_targets_displace_tangents() {
    let mut model = with_tangents(&[[1.0, 0.0, 0.0, 1.0]; 3]);
    let moved = model.vectors(&[[0.0; 3]; 3]);
    let turned = model.vectors(&[[0.0, 2.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0]]);
    let primitive = &mut model.json["meshes"][0]["primitives"][0];
    primitive["targets"] = json!([{ "POSITION": moved, "TANGENT": turned }]);
    model.json["meshes"][0]["weights"] = json!([0.5]);
    let mesh = mesh(&model);
    let expected = |added: f32, normal: Vec3| {
        let t = Vec3::new(1.0, added, 0.0);
        (t - t.dot(normal) * normal).normalize().extend(1.0)
    };
    let added = [1.0, 0.0, 0.5];
    for ((found, added), normal) in mesh.tangents.iter().zip(added).zip(&mesh.normals) {
        let expected = expected(added, *normal);
        assert!(
            (*found - expected).length() < 1e-6,
            "{found}, not {expected}"
        );
    }
}
