//! Buffers, accessors and primitives.

use super::model::{Model, UNSIGNED_BYTE, UNSIGNED_SHORT, base64, floats};
use super::{folder, load, message_in, scene};
use glam::{Vec2, Vec3};
use glimray::import::{self, Options};
use glimray::scene::Mesh;
use serde_json::json;

fn mesh(model: &Model) -> Mesh {
    let scene = model.scene();
    assert_eq!(scene.meshes.len(), 1, "{:?}", scene.skipped);
    (*scene.meshes[0]).clone()
}

/// The corners of each triangle.
fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    let corner = |i: u32| mesh.positions[i as usize];
    mesh.triangles.iter().map(|t| t.map(corner)).collect()
}

const SQUARE: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
];

#[test]
fn a_triangle_without_normals_is_flat_and_faces_where_it_is_counter_clockwise() {
    let mesh = mesh(&Model::triangle(json!({})));
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
}

#[test]
fn flat_triangles_do_not_share_normals() {
    // Two sides of a tent, which share an edge.
    let mut model = Model::new();
    let positions = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
    ];
    let position = model.vectors(&positions);
    let indices = model.accessor(&[0, 1, 2, 0, 3, 1], UNSIGNED_BYTE, "SCALAR", 6);
    model.primitive(position, json!({ "indices": indices }));
    let mesh = mesh(&model);
    assert_eq!(mesh.positions.len(), 6);
    let slope = std::f32::consts::FRAC_1_SQRT_2;
    for i in 0..3 {
        assert!(mesh.normals[i].abs_diff_eq(Vec3::new(-slope, slope, 0.0), 1e-6));
        assert!(mesh.normals[i + 3].abs_diff_eq(Vec3::new(slope, slope, 0.0), 1e-6));
    }
}

#[test]
fn strips_and_fans_keep_the_winding_of_the_specification() {
    let [a, b, c, d] = SQUARE.map(Vec3::from);
    // The triangles in the tables of section 3.7.2.1.
    for (mode, triangles) in [
        (4, vec![[a, b, c]]),
        (5, vec![[a, b, c], [b, d, c]]),
        (6, vec![[b, c, a], [c, d, a]]),
    ] {
        let mut model = Model::new();
        let position = model.vectors(&SQUARE);
        model.primitive(position, json!({ "mode": mode }));
        assert_eq!(corners(&mesh(&model)), triangles, "mode {mode}");
    }
}

#[test]
fn points_and_lines_are_skipped_by_name() {
    for (mode, what) in [(0, "points"), (1, "lines"), (2, "lines"), (3, "lines")] {
        let mut model = Model::triangle(json!({}));
        let position = model.vectors(&SQUARE);
        model.primitive(position, json!({ "mode": mode }));
        let scene = model.scene();
        assert_eq!(scene.triangle_count(), 1);
        let note = format!("{what} skipped: meshes[0].primitives[1]");
        assert_eq!(scene.skipped, [note]);
    }
}

#[test]
fn interleaved_vertices_are_read_with_their_stride() {
    let mut model = Model::new();
    let mut bytes = Vec::new();
    for position in &SQUARE[..3] {
        bytes.extend(floats(position));
        bytes.extend(floats(&[0.0, 0.0, -2.0]));
    }
    let view = model.view(&bytes);
    model.json["bufferViews"][view]["byteStride"] = json!(24);
    let accessor = |offset: u32| {
        json!({
            "bufferView": view, "byteOffset": offset, "componentType": 5126, "type": "VEC3", "count": 3,
        })
    };
    let position = model.push("accessors", accessor(0));
    let normal = model.push("accessors", accessor(12));
    model.primitive(position, json!({ "attributes": { "NORMAL": normal } }));
    let mesh = mesh(&model);
    assert_eq!(
        mesh.positions,
        SQUARE[..3]
            .iter()
            .copied()
            .map(Vec3::from)
            .collect::<Vec<_>>()
    );
    assert_eq!(mesh.normals, [Vec3::NEG_Z; 3], "and made to unit length");
}

#[test]
fn quantized_positions_are_whole_numbers_or_fractions() {
    // KHR_mesh_quantization: f = max(c / 32767, −1) if normalised, else f = c.
    let codes: [[i16; 3]; 3] = [[0, 0, 0], [32767, 0, 0], [0, -32768, 16384]];
    let mut bytes = Vec::new();
    for code in codes {
        bytes.extend(code.iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    for normalized in [false, true] {
        let mut model = Model::new().with(json!({
            "extensionsRequired": ["KHR_mesh_quantization"],
        }));
        let position = model.accessor(&bytes, 5122, "VEC3", 3);
        model.json["bufferViews"][0]["byteStride"] = json!(8);
        model.json["accessors"][position]["normalized"] = json!(normalized);
        model.primitive(position, json!({}));
        let expected = match normalized {
            true => [Vec3::ZERO, Vec3::X, Vec3::new(0.0, -1.0, 16384.0 / 32767.0)],
            false => [
                Vec3::ZERO,
                Vec3::new(32767.0, 0.0, 0.0),
                Vec3::new(0.0, -32768.0, 16384.0),
            ],
        };
        assert_eq!(mesh(&model).positions, expected);
    }
}

#[test]
fn sparse_values_replace_those_of_the_buffer_or_zeros() {
    for has_view in [true, false] {
        let mut model = Model::new();
        let position = model.vectors(&[[0.0; 3], [1.0, 0.0, 0.0], [5.0, 5.0, 5.0]]);
        let indices = model.view(&2_u16.to_le_bytes());
        let values = model.view(&floats(&[0.0, 7.0, 0.0]));
        let accessor = &mut model.json["accessors"][position];
        accessor["sparse"] = json!({
            "count": 1,
            "indices": { "bufferView": indices, "componentType": UNSIGNED_SHORT },
            "values": { "bufferView": values },
        });
        if has_view {
            model.primitive(position, json!({}));
            let expected = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 7.0, 0.0)];
            assert_eq!(mesh(&model).positions, expected);
        } else {
            accessor
                .as_object_mut()
                .expect("a table")
                .remove("bufferView");
            model.primitive(position, json!({}));
            let scene = model.scene();
            // (0, 0, 0), (0, 0, 0) and (0, 7, 0) make no area.
            assert_eq!(scene.triangle_count(), 0);
        }
    }
}

#[test]
fn v_of_texture_coordinates_points_up_in_the_scene() {
    let mut model = Model::new();
    let position = model.vectors(&SQUARE[..3]);
    let uv = model.pairs(&[[0.0, 0.0], [1.0, 0.25], [0.5, 1.0]]);
    let picture = super::model::png(1, &[[255; 4]]);
    let view = model.view(&picture);
    model.push(
        "images",
        json!({ "bufferView": view, "mimeType": "image/png" }),
    );
    model.push("textures", json!({ "source": 0 }));
    let material = json!({ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "metallicFactor": 0 } });
    model.push("materials", material);
    model.primitive(
        position,
        json!({ "attributes": { "TEXCOORD_0": uv }, "material": 0 }),
    );
    let expected = [
        Vec2::new(0.0, 1.0),
        Vec2::new(1.0, 0.75),
        Vec2::new(0.5, 0.0),
    ];
    assert_eq!(mesh(&model).uvs, expected);
}

#[test]
fn morph_targets_are_applied_with_their_default_weights() {
    let mut model = Model::new();
    let position = model.vectors(&SQUARE[..3]);
    let moved = model.vectors(&[[0.0; 3], [4.0, 0.0, 0.0], [0.0; 3]]);
    model.primitive(position, json!({ "targets": [{ "POSITION": moved }] }));
    model.json["meshes"][0]["weights"] = json!([0.25]);
    assert_eq!(mesh(&model).positions[1], Vec3::new(2.0, 0.0, 0.0));
}

#[test]
fn buffers_are_beside_the_model_or_in_it() {
    let model = Model::triangle(json!({}));
    let plain = mesh(&model);
    let data = format!(
        "data:application/octet-stream;base64,{}",
        base64(&model.bin)
    );
    assert_eq!(*scene("a.gltf", model.gltf(&data)).meshes[0], plain);
    let marked = format!("\u{feff}{}", model.gltf(&data));
    assert_eq!(*scene("a.gltf", marked).meshes[0], plain);
    let text = model.gltf("sub%20folder/gr%C3%BCn.bin");
    let files = folder(&[
        ("a.gltf", text.as_bytes()),
        ("sub folder/grün.bin", &model.bin),
    ]);
    let found = import::load(&files.path().join("a.gltf")).expect("a scene");
    assert_eq!(*found.meshes[0], plain);
    // A GLB with another ending is still one.
    assert_eq!(*scene("a.gltf", model.glb()).meshes[0], plain);
}

#[test]
fn uris_cannot_leave_the_folder() {
    let model = Model::triangle(json!({}));
    let mut verdict = crate::support::verdict::Verdict::on("URIs");
    for uri in [
        "../a.bin",
        "%2e%2e/a.bin",
        "..%2fa.bin",
        "/etc/passwd",
        "C:\\a.bin",
        "\\\\host\\share\\a.bin",
        "file:///etc/passwd",
        "http://example.org/a.bin",
        "a%FF.bin",
        "a%00.bin",
        "",
        "gone.bin",
        ".",
        "data:;base64,!!!!",
    ] {
        let files = folder(&[
            ("in/a.gltf", model.gltf(uri).as_bytes()),
            ("a.bin", &model.bin),
        ]);
        let message = message_in(&files, "in/a.gltf", &Options::default());
        let is_named = message.contains("buffers[0]: ");
        verdict.that(uri, is_named && message != "no error", || message.clone());
    }
    verdict.close();
    let long = model.gltf(&"a".repeat(1_000_000));
    let refused = load("a.gltf", long).expect_err("a refusal").to_string();
    assert!(
        refused.contains("is not a file name") && refused.len() < 300,
        "{refused}"
    );
}
