//! Broken and malicious models: refused in one line, quickly, and in little memory.

use super::load;
use super::model::{Model, floats};
use crate::support::effort;
use crate::support::verdict::Verdict;
use insta::assert_snapshot;
use serde_json::{Value, json};

/// The messages for a triangle after each of the changes.
fn changed(changes: &[&dyn Fn(&mut Value)]) -> String {
    let message = |change: &&dyn Fn(&mut Value)| {
        let mut model = Model::triangle(json!({}));
        let indices = model.accessor(&[0, 1, 2], 5121, "SCALAR", 3);
        model.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        change(&mut model.json);
        model.message()
    };
    changes.iter().map(message).collect::<Vec<_>>().join("\n")
}

#[test]
fn ranges_outside_buffers_are_refused() {
    let huge = json!(1_u64 << 62);
    let most = json!(u64::MAX);
    assert_snapshot!(changed(&[
        &|it| it["accessors"][0]["bufferView"] = json!(7),
        &|it| it["accessors"][0]["count"] = json!(4),
        &|it| it["accessors"][0]["count"] = huge.clone(),
        &|it| it["accessors"][0]["count"] = json!(0),
        &|it| it["accessors"][0]["byteOffset"] = most.clone(),
        &|it| it["bufferViews"][0]["byteLength"] = most.clone(),
        &|it| it["bufferViews"][0]["byteOffset"] = most.clone(),
        &|it| it["bufferViews"][0]["buffer"] = json!(1),
        &|it| it["bufferViews"][0]["byteStride"] = json!(4),
        &|it| it["bufferViews"][0]["byteStride"] = most.clone(),
        &|it| it["buffers"] = json!([{ "byteLength": 1000 }]),
        &|it| it["accessors"][0]["componentType"] = json!(5124),
        &|it| it["accessors"][0]["type"] = json!("MAT4"),
        &|it| it["accessors"][0]["type"] = json!("VEC5"),
        &|it| it["accessors"][1]["componentType"] = json!(5120),
        &|it| it["accessors"][1]["byteOffset"] = json!(1),
    ]), @r"
bad model (a.glb): accessors[0]: bufferViews[7] does not exist. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: 4 elements from byte 0 lie outside the buffer view, which has 36 bytes. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: 4611686018427387904 elements from byte 0 lie outside the buffer view, which has 36 bytes. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: count is 0. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: 3 elements from byte 18446744073709551615 lie outside the buffer view, which has 36 bytes. Export the model again, or correct the file.
bad model (a.glb): bufferViews[0]: 18446744073709551615 bytes from byte 0 lie outside buffers[0], which has 39 bytes. Export the model again, or correct the file.
bad model (a.glb): bufferViews[0]: 36 bytes from byte 18446744073709551615 lie outside buffers[0], which has 39 bytes. Export the model again, or correct the file.
bad model (a.glb): bufferViews[0]: buffers[1] does not exist. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: its elements have 12 bytes, more than the stride 4. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: 3 elements from byte 0 lie outside the buffer view, which has 36 bytes. Export the model again, or correct the file.
no error
bad model (a.glb): accessors[0]: componentType 5124 is unknown. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: meshes[0].primitives[0].attributes.POSITION cannot have the type MAT4. Export the model again, or correct the file.
bad model (a.glb): accessors[0]: meshes[0].primitives[0].attributes.POSITION cannot have the type SCALAR. Export the model again, or correct the file.
bad model (a.glb): accessors[1]: meshes[0].primitives[0].indices must be unsigned integers. Export the model again, or correct the file.
bad model (a.glb): accessors[1]: 3 elements from byte 1 lie outside the buffer view, which has 3 bytes. Export the model again, or correct the file.
");
}

#[test]
fn sparse_parts_outside_their_accessor_are_refused() {
    let sparse = |count: u64, index: u8| {
        let mut model = Model::triangle(json!({}));
        let indices = model.view(&[index]);
        let values = model.view(&floats(&[1.0, 2.0, 3.0]));
        model.json["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": { "bufferView": indices, "componentType": 5121 },
            "values": { "bufferView": values },
        });
        model.message()
    };
    let messages = [sparse(1, 2), sparse(1, 3), sparse(2, 0), sparse(1 << 62, 0)];
    assert_snapshot!(messages.join("\n"), @r"
no error
bad model (a.glb): accessors[0].sparse: an index is not below the accessor's count. Export the model again, or correct the file.
bad model (a.glb): accessors[0].sparse: 2 elements from byte 0 lie outside the buffer view, which has 1 bytes. Export the model again, or correct the file.
bad model (a.glb): accessors[0].sparse: 4611686018427387904 elements from byte 0 lie outside the buffer view, which has 1 bytes. Export the model again, or correct the file.
");
}

#[test]
fn counts_that_no_buffer_backs_are_refused_before_memory_is_taken() {
    for count in [100_000_000_u64, 1 << 40, 1 << 62, u64::MAX] {
        let mut model = Model::triangle(json!({}));
        let accessor = &mut model.json["accessors"][0];
        accessor
            .as_object_mut()
            .expect("a table")
            .remove("bufferView");
        accessor["count"] = json!(count);
        let error = effort::within(1_000.0, || load("a.glb", model.glb())).expect_err("refused");
        assert!(error.is_too_big(), "{error}");
    }
}

#[test]
fn a_mesh_that_is_repeated_in_the_file_takes_no_unbounded_memory() {
    // A buffer of 1.2 MB and 5000 primitives that read it all.
    let mut model = Model::new();
    let positions: Vec<[f32; 3]> = (0..99_999)
        .map(|i| [i as f32, (i % 7) as f32, 0.0])
        .collect();
    let position = model.vectors(&positions);
    for _ in 0..5000 {
        model.primitive(position, json!({}));
    }
    let error = effort::within(20_000.0, || load("a.glb", model.glb())).expect_err("refused");
    assert!(error.is_too_big(), "{error}");
}

/// Parts that cannot be used are left out with a note, and the rest is shown. A model of which nothing is left is refused.
#[test]
fn references_and_values_out_of_range_are_left_out_and_named() {
    type Change<'a> = &'a dyn Fn(&mut Value);
    let rows: [(Change, &str); 20] = [
        (
            &|it| it["scene"] = json!(3),
            "scene: scenes[3] does not exist",
        ),
        (
            &|it| it["scenes"][0]["nodes"] = json!([0, 0]),
            "scenes[0].nodes: nodes[0] has another place already",
        ),
        (
            &|it| it["nodes"][0]["children"] = json!([0]),
            "nodes[0].children: nodes[0] has another place already",
        ),
        (
            &|it| it["nodes"][0]["children"] = json!([9]),
            "nodes[0].children: nodes[9] does not exist",
        ),
        (
            &|it| {
                it["nodes"] = json!([{ "mesh": 0, "children": [1] }, { "children": [2] }, { "children": [1] }])
            },
            "nodes[2].children: nodes[1] has another place already",
        ),
        (
            &|it| it["nodes"][0]["mesh"] = json!(9),
            "bad model (a.glb): nodes[0]: meshes[9] does not exist",
        ),
        (
            &|it| it["nodes"][0]["camera"] = json!(-1),
            "nodes[0].camera was ignored: it must be a whole number from 0",
        ),
        (
            &|it| it["nodes"][0]["camera"] = json!(0),
            "nodes[0]: cameras[0] does not exist",
        ),
        (
            &|it| it["nodes"][0]["skin"] = json!(0),
            "nodes[0]: skins[0] does not exist",
        ),
        (
            &|it| it["nodes"][0]["matrix"] = json!(vec![1.0; 3]),
            "nodes[0].matrix was ignored: it must be 16 numbers",
        ),
        (
            &|it| it["nodes"][0]["translation"] = json!("up"),
            "nodes[0].translation was ignored: it must be a list of numbers",
        ),
        (
            &|it| it["meshes"][0]["primitives"][0]["mode"] = json!(7),
            "bad model (a.glb): meshes[0].primitives[0]: mode 7 is unknown",
        ),
        (
            &|it| it["meshes"][0]["primitives"][0]["material"] = json!(0),
            "meshes[0].primitives[0]: materials[0] does not exist",
        ),
        (
            &|it| it["meshes"][0]["primitives"][0]["indices"] = json!(0),
            "bad model (a.glb): accessors[0]: meshes[0].primitives[0].indices must be unsigned integers",
        ),
        (
            &|it| it["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1),
            "meshes[0].primitives[0].attributes.NORMAL cannot have the type SCALAR",
        ),
        (
            &|it| it["materials"] = json!([{ "alphaMode": "GLASS" }]),
            "materials[0].alphaMode was ignored: it must be one of OPAQUE, MASK, BLEND",
        ),
        (
            &|it| {
                it["nodes"][0]["camera"] = json!(0);
                it["cameras"] = json!([{ "perspective": { "yfov": 0 } }]);
            },
            "cameras[0]: perspective.yfov is 0, but it must be between 0 and π: π/4 is used",
        ),
        (
            &|it| it["asset"]["version"] = json!("1.0"),
            "bad model (a.glb): it is glTF `1.0`, but only version 2.0 is read",
        ),
        (&|it| it["asset"] = Value::Null, "it has no `asset`"),
        (
            &|it| {
                it["extensionsRequired"] =
                    json!(["ABC_compression", "KHR_mesh_quantization", "ABC_x"])
            },
            "bad model (a.glb): it requires extensions that are not supported: `ABC_compression`, `ABC_x`",
        ),
    ];
    let mut verdict = Verdict::on("references");
    for (change, expected) in rows {
        let mut model = Model::triangle(json!({}));
        let indices = model.accessor(&[0, 1, 2], 5121, "SCALAR", 3);
        model.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        change(&mut model.json);
        let found = match load("a.glb", model.glb()) {
            Ok(scene) => scene.skipped.join("\n"),
            Err(_) => model.message(),
        };
        verdict.that(expected, found.contains(expected), || found.clone());
    }
    verdict.close();
}

#[test]
fn indices_beyond_the_vertices_are_refused() {
    let mut model = Model::triangle(json!({}));
    let indices = model.accessor(&[0, 1, 3], 5121, "SCALAR", 3);
    model.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    assert_eq!(
        model.message(),
        "bad model (a.glb): meshes[0].primitives[0].indices: the index 3 is not below the number of \
         vertices, 3. Export the model again, or correct the file."
    );
}

#[test]
fn triangles_at_positions_that_are_not_finite_are_left_out_and_normals_repaired() {
    for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut model = Model::new();
        let position = model.vectors(&[[0.0; 3], [odd, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        model.primitive(position, json!({}));
        let message = model.message();
        assert!(message.contains("1 positions are not finite"), "{message}");
        let mut model = Model::new();
        let corners = [[0.0; 3], [odd, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0; 3]];
        let position = model.vectors(&corners);
        let indices = model.accessor(&[0, 1, 2, 0, 3, 2, 0, 2, 9], 5121, "SCALAR", 9);
        model.primitive(position, json!({ "indices": indices }));
        let scene = model.scene();
        assert_eq!(scene.triangle_count(), 1);
        let notes = scene.skipped.join("\n");
        assert!(notes.contains("2 of 3 triangles left out"), "{notes}");
        let mut model = Model::triangle(json!({}));
        let normal = model.vectors(&[[odd; 3], [0.0; 3], [0.0, 0.0, 1.0]]);
        model.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normal);
        let scene = model.scene();
        assert_eq!(scene.meshes[0].normals, [glam::Vec3::Z; 3]);
        assert_eq!(scene.skipped, ["recomputed 2 normals of zero length"]);
    }
}

#[test]
fn numbers_at_the_end_of_their_range_do_no_harm() {
    let mut verdict = Verdict::on("numbers");
    for node in [
        json!({ "mesh": 0, "scale": [1e300, 1e300, 1e300] }),
        json!({ "mesh": 0, "scale": [1e-300, 1, 1] }),
        json!({ "mesh": 0, "translation": [1e300, 0, 0] }),
        json!({ "mesh": 0, "rotation": [0, 0, 0, 0] }),
        json!({ "mesh": 0, "rotation": [1e300, 1e300, 0, 0] }),
        json!({ "mesh": 0, "matrix": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0] }),
    ] {
        let scene = Model::triangle(json!({}))
            .with(json!({ "nodes": [node] }))
            .scene();
        let frame = scene.frame(0.0);
        let is_finite = frame
            .nodes
            .iter()
            .all(|node| node.world_from_node.is_finite());
        verdict.that(
            &node,
            is_finite && !scene.skipped.is_empty() || node["scale"][1] == 1,
            || format!("{:?}", scene.nodes),
        );
    }
    verdict.close();
    let material = json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [1e300, -5, 0, 1], "roughnessFactor": -1e300, "metallicFactor": 1e300 },
        "emissiveFactor": [1e300, 0, 0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 1e308 },
                        "KHR_materials_ior": { "ior": -3 } } });
    let scene = Model::triangle(json!({ "material": 0 }))
        .with(json!({ "materials": [material] }))
        .scene();
    let found = &scene.materials[0];
    assert!(
        found.emission.is_finite()
            && found.classical().specular.is_finite()
            && found.classical().ior >= 1.0
    );
    assert!(
        found.classical().diffuse.is_finite() && found.classical().diffuse.min_element() >= 0.0
    );
}

/// Programs write such files, and others read them.
#[test]
fn careless_glbs_are_read() {
    let whole = Model::triangle(json!({})).glb();
    let word =
        |at: usize| u32::from_le_bytes(whole[at..at + 4].try_into().expect("four bytes")) as usize;
    let json = whole[20..20 + word(12)].trim_ascii_end().to_vec();
    let bin = whole[28 + word(12)..].to_vec();
    let built = |json: &[u8], bin: &[u8], after: &[u8]| {
        let mut bytes = b"glTF".to_vec();
        let length = 28 + json.len() + bin.len();
        for word in [2, length as u32, json.len() as u32, 0x4e4f_534a] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(json);
        for word in [bin.len() as u32, 0x004e_4942] {
            bytes.extend(word.to_le_bytes());
        }
        [bytes, bin.to_vec(), after.to_vec()].concat()
    };
    let odd = [&json[..], b" "].concat();
    let odd = if odd.len() % 4 == 0 {
        json.clone()
    } else {
        odd
    };
    for (name, bytes) in [
        ("zeros", built(&[&json[..], &[0; 5]].concat(), &bin, &[])),
        ("bytes after the end", built(&json, &bin, b"trailer")),
        ("odd lengths", built(&odd, &bin, &[])),
        (
            "a byte order mark",
            built(&[b"\xef\xbb\xbf", &json[..]].concat(), &bin, &[]),
        ),
    ] {
        let scene = load("a.glb", bytes);
        let scene = scene.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(scene.triangle_count(), 1, "{name}");
        assert!(scene.skipped.is_empty(), "{name}: {:?}", scene.skipped);
    }
}

#[test]
fn planes_that_cannot_clip_are_left_out_and_named() {
    let lens = |znear: f64, zfar: f64| json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": znear, "zfar": zfar } });
    let scene = Model::triangle(json!({}))
        .with(json!({
            "scenes": [{ "nodes": [0, 1] }],
            "nodes": [{ "mesh": 0, "camera": 0 }, { "camera": 1 }],
            "cameras": [lens(-0.5, 10.0), lens(2.0, 1.0)],
        }))
        .scene();
    let own = scene
        .cameras
        .iter()
        .filter(|camera| camera.name != "framed");
    let clips: Vec<_> = own.map(|camera| camera.clip).collect();
    assert_eq!(clips, [(0.0, 10.0), (2.0, f64::INFINITY)]);
    assert_eq!(
        scene.skipped,
        [
            "cameras[0]: znear -0.5 does not clip: it must be 0 or more",
            "cameras[1]: zfar 1 does not clip: it must be greater than znear",
        ]
    );
}

#[test]
fn properties_without_effect_are_named() {
    let scene = Model::triangle(json!({ "extras": 1 }))
        .with(json!({
            "asset": { "generator": "a test" },
            "extensionsUsed": ["ABC_mist"],
            "nodes": [{ "mesh": 0, "camera": 0, "spin": 3, "extensions": { "ABC_mist": {} } }],
            "cameras": [{ "type": "perspective", "perspective": { "yfov": 1, "aspectRatio": 2 } }],
        }))
        .scene();
    let skipped = scene.skipped.join("\n");
    for part in [
        "nodes[0].spin is not known",
        "the extension `ABC_mist` is not supported",
    ] {
        assert!(skipped.contains(part), "{part}: {skipped}");
    }
    let remarks = scene.remarks.join("\n");
    for part in ["cameras[0].type", "asset.generator", "extras"] {
        assert!(remarks.contains(part), "{part}: {remarks}");
    }
    // Remarks are no loss, so `--strict` accepts them.
    assert!(
        !skipped.contains("type") && !skipped.contains("extras"),
        "{skipped}"
    );
}

#[test]
fn names_of_required_extensions_are_compared_whole() {
    let name = "KHR_materials_pbrSpecularGlossiness";
    let scene = Model::triangle(json!({}))
        .with(json!({ "extensionsUsed": [name], "extensionsRequired": [name] }))
        .scene();
    assert_eq!(scene.triangle_count(), 1);
    let longer =
        Model::triangle(json!({})).with(json!({ "extensionsRequired": [format!("{name}2")] }));
    assert!(longer.message().contains("pbrSpecularGlossiness2`"));
}

#[test]
fn a_glb_that_is_cut_anywhere_is_refused() {
    let mut model = Model::triangle(json!({ "material": 0 }));
    model.push("materials", json!({ "name": "paint" }));
    let whole = model.glb();
    let mut verdict = Verdict::on("truncated files");
    for percent in 0..100 {
        let cut = &whole[..whole.len() * percent / 100];
        let message = super::super::messages("a.glb", &[cut]);
        let is_refused = message.contains("Check that it");
        verdict.that(format!("{percent} %"), is_refused, || message.clone());
    }
    verdict.close();
}

#[test]
fn no_corruption_of_a_model_makes_the_importer_panic() {
    let mut random = crate::support::random::Random::new(16);
    let mut model = Model::triangle(json!({ "material": 0 }));
    let indices = model.accessor(&[0, 1, 2], 5121, "SCALAR", 3);
    model.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    model.push(
        "materials",
        json!({ "pbrMetallicRoughness": { "roughnessFactor": 0.5 } }),
    );
    let whole = model.glb();
    let mut refused = 0;
    for _ in 0..400 {
        let mut broken = whole.clone();
        for _ in 0..3 {
            let at = random.bits() as usize % broken.len();
            broken[at] = random.bits() as u8;
        }
        refused += usize::from(load("a.glb", broken).is_err());
    }
    assert!(refused > 200, "only {refused} of 400 were refused");
}

#[test]
fn lying_headers_and_bombs_of_json_are_refused_soon() {
    let header = |version: u32, length: u32| {
        let mut bytes = b"glTF".to_vec();
        bytes.extend(version.to_le_bytes());
        bytes.extend(length.to_le_bytes());
        bytes
    };
    let nested = format!("{{\"extras\":{}", "[".repeat(1_000_000));
    let many = format!(
        "{{\"asset\":{{\"version\":\"2.0\"}},\"materials\":[{}{{}}]}}",
        "{},".repeat(10_000_000)
    );
    let files: [(&str, Vec<u8>); 6] = [
        ("version", header(1, 12)),
        ("length", header(2, u32::MAX)),
        ("no chunk", header(2, 12)),
        ("nested", nested.into_bytes()),
        ("many", many.into_bytes()),
        ("text", b"solid cube".to_vec()),
    ];
    let lines: Vec<String> = (files.into_iter())
        .map(|(name, bytes)| {
            let found = effort::within(5_000.0, || super::super::messages("a.glb", &[bytes]));
            format!("{name}: {found}")
        })
        .collect();
    assert_snapshot!(lines.join("\n"), @r"
version: bad model (a.glb): it is a GLB of version 1, but only version 2 is read. Convert it to glTF 2.0.
length: bad model (a.glb): 12 bytes of 4 GiB are there. Check that it was written completely.
no chunk: bad model (a.glb): the first chunk is not JSON. Check that it was written completely.
nested: bad model (a.glb:1:137): recursion limit exceeded. Check that it is a complete glTF 2.0 file.
many: bad model (a.glb): reading it would take more than 292.9 MiB of memory: 8 times the size of the file plus 64 MiB. Split it into several files.
text: bad model (a.glb:1:1): expected value. Check that it is a complete glTF 2.0 file.
");
}
