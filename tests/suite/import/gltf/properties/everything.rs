//! A model that has every property of glTF 2.0 and of the extensions that are read, apart from compressed geometry. Each
//! has an effect in it if it has one anywhere.

use super::super::model::{FLOAT, Model, UNSIGNED_BYTE, UNSIGNED_SHORT, base64, floats, png};
use serde_json::{Value, json};

/// Corners of a square.
const CORNERS: [[f32; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.25],
];

/// A map with all that maps have. `texture` is one of four, `set` one of two.
fn map(texture: usize, set: usize) -> Value {
    json!({ "index": texture, "texCoord": set, "extras": { "of": "a map" }, "extensions": {
        "KHR_texture_transform": {
            "offset": [0.125, 0.25], "rotation": 0.5, "scale": [2.5, 3.5], "texCoord": set,
        },
    } })
}

/// A map with a factor, `scale` or `strength`.
fn scaled(texture: usize, set: usize, factor: &str) -> Value {
    let mut map = map(texture, set);
    map[factor] = json!(0.75);
    map
}

/// The extensions of a material with all layers.
fn layers() -> Value {
    let mut all = json!({
        "KHR_materials_emissive_strength": { "emissiveStrength": 2.5 },
        "KHR_materials_ior": { "ior": 1.4 },
        "KHR_materials_transmission": { "transmissionFactor": 0.5, "transmissionTexture": map(1, 0) },
        "KHR_materials_dispersion": { "dispersion": 0.125 },
    });
    all["KHR_materials_volume"] = json!({
        "thicknessFactor": 0.5, "thicknessTexture": map(2, 1),
        "attenuationDistance": 2.5, "attenuationColor": [0.5, 0.25, 0.75],
    });
    all["KHR_materials_specular"] = json!({
        "specularFactor": 0.5, "specularTexture": map(2, 0),
        "specularColorFactor": [0.5, 0.25, 0.75], "specularColorTexture": map(0, 1),
    });
    all["KHR_materials_clearcoat"] = json!({
        "clearcoatFactor": 0.5, "clearcoatTexture": map(1, 0),
        "clearcoatRoughnessFactor": 0.25, "clearcoatRoughnessTexture": map(1, 1),
        "clearcoatNormalTexture": scaled(1, 0, "scale"),
    });
    all["KHR_materials_sheen"] = json!({
        "sheenColorFactor": [0.5, 0.25, 0.75], "sheenColorTexture": map(0, 0),
        "sheenRoughnessFactor": 0.25, "sheenRoughnessTexture": map(1, 0),
    });
    all["KHR_materials_anisotropy"] = json!({
        "anisotropyStrength": 0.5, "anisotropyRotation": 0.25, "anisotropyTexture": map(1, 1),
    });
    all["KHR_materials_iridescence"] = json!({
        "iridescenceFactor": 0.5, "iridescenceTexture": map(1, 1), "iridescenceIor": 1.75,
        "iridescenceThicknessMinimum": 150.5, "iridescenceThicknessMaximum": 350.5,
        "iridescenceThicknessTexture": map(1, 0),
    });
    all["KHR_materials_diffuse_transmission"] = json!({
        "diffuseTransmissionFactor": 0.25, "diffuseTransmissionTexture": map(1, 1),
        "diffuseTransmissionColorFactor": [0.5, 0.25, 0.75], "diffuseTransmissionColorTexture": map(0, 1),
    });
    all
}

fn materials() -> [Value; 5] {
    let mut paint = json!({
        "name": "paint", "emissiveFactor": [0.5, 0.25, 0.75], "emissiveTexture": map(0, 1),
        "normalTexture": scaled(1, 0, "scale"), "occlusionTexture": scaled(2, 1, "strength"),
        "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true, "extensions": layers(),
    });
    paint["pbrMetallicRoughness"] = json!({
        "baseColorFactor": [0.5, 0.25, 0.75, 0.875], "baseColorTexture": map(0, 0),
        "metallicFactor": 0.5, "roughnessFactor": 0.625, "metallicRoughnessTexture": map(1, 1),
    });
    let older = json!({ "alphaMode": "BLEND", "extensions": { "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.5, 0.25, 0.75, 0.875], "diffuseTexture": map(2, 1), "specularFactor": [0.5, 0.25, 0.75],
        "glossinessFactor": 0.5, "specularGlossinessTexture": map(0, 0),
    } } });
    let unlit = json!({
        "extensions": { "KHR_materials_unlit": {} },
        "pbrMetallicRoughness": { "baseColorTexture": map(3, 0), "baseColorFactor": [0.5, 0.25, 0.75, 1.0] },
    });
    let named = |name: &str, roughness: f64| json!({ "name": name, "pbrMetallicRoughness": { "roughnessFactor": roughness } });
    [
        paint,
        older,
        unlit,
        named("worn", 0.9),
        named("polished", 0.1),
    ]
}

/// Adds an accessor's properties that are not there yet.
fn complete(model: &mut Model, accessor: usize, more: Value) {
    for (key, value) in more.as_object().expect("a table") {
        model.json["accessors"][accessor][key] = value.clone();
    }
}

/// Accessors for a square, without positions: normals, tangents, two sets of texture coordinates and colours.
fn attributes(model: &mut Model) -> Value {
    let normal = model.vectors(&[
        [0.0, 0.0, 1.0],
        [0.0, 0.6, 0.8],
        [0.6, 0.0, 0.8],
        [0.0, 0.0, 1.0],
    ]);
    let tangent = model.quads(&[[1.0, 0.0, 0.0, 1.0]; 4]);
    let first = model.pairs(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    let codes: Vec<u8> = [0_u16, 0, 9000, 500, 100, 8000, 65000, 65000]
        .iter()
        .flat_map(|code| code.to_le_bytes())
        .collect();
    let second = model.accessor(&codes, UNSIGNED_SHORT, "VEC2", 4);
    complete(
        model,
        second,
        json!({ "normalized": true, "name": "second set" }),
    );
    let colors: Vec<u8> = (0..16).map(|i| 40 + 13 * i).collect();
    let color = model.accessor(&colors, UNSIGNED_BYTE, "VEC4", 4);
    complete(
        model,
        color,
        json!({ "normalized": true, "min": [40, 40, 40, 40], "max": [255, 255, 255, 255] }),
    );
    json!({ "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": first, "TEXCOORD_1": second, "COLOR_0": color, "_WEAR": first })
}

/// Positions of a square in a view of their own, with a stride and an offset, and one of them in a sparse part.
fn positions(model: &mut Model) -> usize {
    let rows = CORNERS.map(|[x, y, z]| [x, y, z, 9.0]);
    let mut bytes = floats(&[5.0]);
    bytes.extend(floats(rows.as_flattened()));
    let view = model.view(&bytes);
    model.json["bufferViews"][view]["byteStride"] = json!(16);
    model.json["bufferViews"][view]["target"] = json!(34962);
    model.json["bufferViews"][view]["name"] = json!("corners");
    let indices = model.view(&[9, 3]);
    let values = model.view(&floats(&[8.0, 0.75, 1.25, 0.5]));
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": indices, "byteOffset": 1, "componentType": UNSIGNED_BYTE },
        "values": { "bufferView": values, "byteOffset": 4 },
    });
    model.push(
        "accessors",
        json!({
            "bufferView": view, "byteOffset": 4, "componentType": FLOAT, "type": "VEC3", "count": 4,
            "normalized": false, "min": [0.0, 0.0, 0.0], "max": [1.0, 1.25, 0.5], "sparse": sparse,
        }),
    )
}

fn meshes(model: &mut Model) {
    let square = positions(model);
    let mut own = attributes(model);
    let corners: Vec<u8> = [0_u16, 1, 2, 2, 1, 3]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    let indices = model.accessor(&corners, UNSIGNED_SHORT, "SCALAR", 6);
    own["POSITION"] = json!(square);
    let moved = model.vectors(&[[0.0, 0.0, 0.5], [0.0; 3], [0.25, 0.0, 0.0], [0.0; 3]]);
    let turned = model.vectors(&[[0.0, 0.5, 0.0], [0.0; 3], [0.0; 3], [0.25, 0.0, 0.0]]);
    let other = model.vectors(&[[0.0, 1.0, 0.0], [0.5, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
    let morphing = json!({
        "name": "morphing", "weights": [0.5, 0.25],
        "primitives": [{
            "attributes": own, "indices": indices, "material": 0, "mode": 4,
            "targets": [
                { "POSITION": moved, "NORMAL": turned, "TANGENT": turned },
                { "POSITION": other },
            ],
            "extensions": { "EXT_mesh_manifold": { "manifoldPrimitive": { "indices": 3 } } },
        }],
    });
    let joints: Vec<u8> = (0..4).flat_map(|i| [i % 2, 1 - i % 2, 0, 0]).collect();
    let joints = model.accessor(&joints, UNSIGNED_BYTE, "VEC4", 4);
    let weights = model.quads(&[[0.75, 0.25, 0.0, 0.0]; 4]);
    let bent = json!({
        "name": "bent",
        "primitives": [{
            "attributes": { "POSITION": square, "JOINTS_0": joints, "WEIGHTS_0": weights },
            "mode": 5,
        }],
    });
    let shared = json!({
        "POSITION": own["POSITION"], "TEXCOORD_0": own["TEXCOORD_0"], "TEXCOORD_1": own["TEXCOORD_1"], "COLOR_0": own["COLOR_0"],
    });
    let of =
        |material: usize| json!({ "attributes": shared, "indices": indices, "material": material });
    let mut varied = of(0);
    varied["extensions"] = json!({ "KHR_materials_variants": { "mappings": [
        { "name": "as it was", "material": 3, "variants": [0] },
        { "material": 4, "variants": [1] },
    ] } });
    let plain = json!({ "name": "plain", "primitives": [of(1), of(2), varied] });
    model.json["meshes"] = json!([morphing, bent, plain]);
}

fn nodes(model: &mut Model) {
    let translation = model.vectors(&[[1.0, 0.0, 0.0], [2.0, 0.5, 0.0]]);
    let rotation = model.quads(&[[0.0, 0.0, 0.6, 0.8], [0.0, 0.0, 0.0, 1.0]]);
    let scale = model.vectors(&[[1.0; 3], [3.0; 3]]);
    let light =
        |light: usize| json!({ "extensions": { "KHR_lights_punctual": { "light": light } } });
    let parts = json!({ "translation": [0.5, 1.5, -2.5], "rotation": [0.0, 0.6, 0.0, 0.8], "scale": [1.5, 2.5, 0.5] });
    let mut root = parts.clone();
    root["children"] = json!([1, 2, 5, 6, 7, 8, 9, 10]);
    let mut morphing = parts;
    morphing["name"] = json!("mask");
    morphing["mesh"] = json!(0);
    let copies = json!({ "EXT_mesh_gpu_instancing": { "attributes": {
        "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale, "_AGE": translation } } });
    let list = vec![
        root,
        morphing,
        json!({ "name": "bent", "mesh": 1, "skin": 0 }),
        json!({ "children": [4], "translation": [0.5, 0.25, 0.0] }),
        json!({ "rotation": [0.0, 0.0, 0.6, 0.8], "translation": [0.25, 0.0, 0.5] }),
        json!({ "camera": 0, "translation": [0.25, 0.0, 5.5] }),
        json!({ "camera": 1, "translation": [0.25, 0.0, 6.5], "name": "plan" }),
        light(0),
        light(1),
        light(2),
        json!({ "mesh": 2, "extensions": copies, "extras": [1, 2] }),
        json!({ "mesh": 0, "weights": [0.125, 0.375], "extensions": { "KHR_node_visibility": { "visible": true } } }),
        json!({ "mesh": 2, "matrix": [1.0, 0.5, 0.0, 0.0, 0.25, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 4.0, 0.0, -1.0, 1.0] }),
    ];
    model.json["nodes"] = list.into();
    model.json["scene"] = json!(0);
    let story = json!({ "KHR_xmp": { "packet": 1 }, "KHR_xmp_json_ld": { "packet": 0 } });
    model.json["scenes"] =
        json!([{ "name": "main", "nodes": [0, 3, 11, 12], "extensions": story }]);
    let bind: Vec<f32> = (0..2)
        .flat_map(|i| {
            let x = i as f32 / 4.0;
            [
                1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, 0.5, 0.0, 1.0,
            ]
        })
        .collect();
    let bind = model.accessor(&floats(&bind), FLOAT, "MAT4", 2);
    model.json["skins"] = json!([{
        "name": "bones", "joints": [3, 4], "inverseBindMatrices": bind, "skeleton": 3,
    }]);
}

fn lenses_and_lights(model: &mut Model) {
    model.json["cameras"] = json!([
        { "name": "eye", "type": "perspective",
          "perspective": { "yfov": 0.75, "aspectRatio": 2.5, "znear": 0.125, "zfar": 90.5 } },
        { "name": "plan", "type": "orthographic",
          "orthographic": { "xmag": 4.5, "ymag": 1.5, "znear": 0.125, "zfar": 90.5 } },
    ]);
    let color = json!([0.5, 0.25, 0.75]);
    model.json["extensions"]["KHR_lights_punctual"] = json!({ "lights": [
        { "name": "bulb", "type": "point", "color": color, "intensity": 40.5, "range": 9.5 },
        { "name": "sun", "type": "directional", "color": color, "intensity": 2.5 },
        { "name": "torch", "type": "spot", "color": color, "intensity": 30.5,
          "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
    ] });
}

fn pictures(model: &mut Model) {
    let colors = png(
        2,
        &[
            [255, 0, 0, 255],
            [0, 200, 50, 128],
            [90, 10, 200, 255],
            [20, 30, 40, 60],
        ],
    );
    let values = png(2, &[[128, 128, 255, 255], [90, 128, 240, 255]]);
    let view = model.view(&values);
    let uri = |kind: &str, bytes: &[u8]| format!("data:image/{kind};base64,{}", base64(bytes));
    model.json["images"] = json!([
        { "name": "colours", "uri": uri("png", &colors) },
        { "name": "values", "bufferView": view, "mimeType": "image/png" },
        { "uri": uri("webp", include_bytes!("../../../../encoded/alpha.webp")) },
        { "uri": uri("ktx2", include_bytes!("../../../../encoded/etc1s_alpha.ktx2")) },
    ]);
    model.json["samplers"] = json!([
        { "name": "smooth", "magFilter": 9729, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648 },
        { "magFilter": 9728, "minFilter": 9728, "wrapS": 10497, "wrapT": 10497 },
    ]);
    model.json["textures"] = json!([
        { "name": "colours", "sampler": 0, "source": 0 },
        { "sampler": 1, "source": 1 },
        { "sampler": 0, "extensions": { "EXT_texture_webp": { "source": 2 } } },
        { "sampler": 1, "extensions": { "KHR_texture_basisu": { "source": 3 } } },
    ]);
}

fn clips(model: &mut Model) {
    // Times are in a buffer of their own.
    let times = floats(&[0.5, 2.5]);
    let uri = format!("data:application/octet-stream;base64,{}", base64(&times));
    let view = model.push(
        "bufferViews",
        json!({ "buffer": 1, "byteLength": times.len() }),
    );
    let input = model.push(
        "accessors",
        json!({ "bufferView": view, "componentType": FLOAT, "type": "SCALAR", "count": 2 }),
    );
    let moved = model.vectors(&[[0.0; 3], [1.0, 0.5, 0.25]]);
    let turned = model.quads(&[[0.0, 0.0, 0.0, 1.0], [0.0, 0.6, 0.0, 0.8]]);
    let grown: Vec<[f32; 3]> = (0..6).map(|i| [1.0, 1.0 + i as f32 / 4.0, 1.0]).collect();
    let grown = model.vectors(&grown);
    let weights = model.numbers(&[0.0, 0.5, 1.0, 0.25]);
    let shown = model.accessor(&[1, 0], UNSIGNED_BYTE, "SCALAR", 2);
    let sampler = |output: usize, interpolation: &str| json!({ "input": input, "output": output, "interpolation": interpolation });
    let channel = |sampler: usize, path: &str| json!({ "sampler": sampler, "target": { "node": 1, "path": path } });
    let pointer = "/nodes/11/extensions/KHR_node_visibility/visible";
    let hidden = json!({ "sampler": 4, "target": {
        "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": pointer } } } });
    model.json["animations"] = json!([{
        "name": "walk",
        "samplers": [
            sampler(moved, "LINEAR"), sampler(turned, "STEP"), sampler(grown, "CUBICSPLINE"),
            sampler(weights, "LINEAR"), sampler(shown, "STEP"),
        ],
        "channels": [
            channel(0, "translation"), channel(1, "rotation"), channel(2, "scale"), channel(3, "weights"), hidden,
        ],
    }]);
    model.json["buffers"] = json!([
        { "name": "most" },
        { "uri": uri, "byteLength": times.len() },
    ]);
}

/// The model.
pub fn everything() -> Model {
    let mut model = Model::new();
    for material in materials() {
        model.push("materials", material);
    }
    meshes(&mut model);
    nodes(&mut model);
    lenses_and_lights(&mut model);
    pictures(&mut model);
    clips(&mut model);
    let length = model.bin.len();
    model.json["buffers"][0]["byteLength"] = json!(length);
    let story = json!({ "KHR_xmp": { "packet": 1 }, "KHR_xmp_json_ld": { "packet": 0 } });
    model.json["asset"] = json!({
        "version": "2.0", "minVersion": "2.0", "generator": "a test", "copyright": "nobody", "extensions": story,
    });
    let extensions = &mut model.json["extensions"];
    extensions["KHR_xmp"] = json!({ "packets": [{ "dc:title": "all" }] });
    extensions["KHR_xmp_json_ld"] = json!({ "packets": [{ "dc:title": "all" }] });
    extensions["KHR_materials_variants"] =
        json!({ "variants": [{ "name": "first" }, { "name": "second" }] });
    model.json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_texture_transform"]);
    model.json["extensionsRequired"] = json!(["KHR_texture_transform"]);
    model
}
