//! One model in every format: a letter that has no symmetry, in four colours. It looks the same in all.

use crate::import::gltf::model::{Model, UNSIGNED_SHORT};
use crate::import::writing::archive;
use crate::reference::compare::{assert_none, check_alike, sized, start_packed};
use glam::{Vec3, vec3};
use glimray::image::Image;
use glimray::import::{self, Memory, Options};
use glimray::pack;
use glimray::render::{Integrator, RenderSettings, Tone};
use glimray::scene::{LightTransport, OutputDefaults, Scene, ToneCurve};
use serde_json::json;
use std::sync::Arc;

/// Width and height of a picture.
const SIZE: (u32, u32) = (64, 48);
/// Pictures side by side on the sheet.
const COLUMNS: usize = 4;

/// An F of three boxes with a knob in front, +Y up, from corner to corner, with their colours. The values are
/// 0 or 1, which mean the same in every colour space.
const BOXES: [([f32; 3], [f32; 3], [u8; 3]); 4] = [
    ([0.0, 0.0, 0.0], [0.3, 1.4, 0.3], [1, 0, 0]),
    ([0.3, 1.1, 0.0], [1.0, 1.4, 0.3], [0, 1, 0]),
    ([0.3, 0.55, 0.0], [0.75, 0.85, 0.3], [0, 0, 1]),
    ([0.65, 1.15, 0.3], [0.85, 1.35, 0.5], [1, 1, 0]),
];

/// Faces of a box by the numbers of its corners, x fastest, counter-clockwise from outside.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

fn corners(least: [f32; 3], most: [f32; 3]) -> [Vec3; 8] {
    std::array::from_fn(|i| {
        let end = |axis: usize| if i >> axis & 1 == 0 { least } else { most }[axis];
        vec3(end(0), end(1), end(2))
    })
}

fn obj() -> Vec<u8> {
    let mut text = "mtllib letter.mtl\n".to_owned();
    for (i, (least, most, _)) in BOXES.into_iter().enumerate() {
        for corner in corners(least, most) {
            text += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
        }
        text += &format!("usemtl m{i}\n");
        for face in FACES {
            let [a, b, c, d] = face.map(|corner| 8 * i + corner + 1);
            text += &format!("f {a} {b} {c} {d}\n");
        }
    }
    text.into_bytes()
}

fn mtl() -> Vec<u8> {
    let materials = BOXES.iter().enumerate();
    let text = materials.map(|(i, (.., [r, g, b]))| format!("newmtl m{i}\nKd {r} {g} {b}\n"));
    text.collect::<String>().into_bytes()
}

/// Big-endian numbers, or text.
fn ply(is_binary: bool) -> Vec<u8> {
    let format = if is_binary {
        "binary_big_endian"
    } else {
        "ascii"
    };
    let mut bytes = format!(
        "ply\nformat {format} 1.0\nelement vertex 32\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 24\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for (least, most, color) in BOXES {
        let [r, g, b] = color.map(|c| 255 * c);
        for corner in corners(least, most) {
            if is_binary {
                bytes.extend(corner.to_array().iter().flat_map(|c| c.to_be_bytes()));
                bytes.extend([r, g, b]);
            } else {
                let Vec3 { x, y, z } = corner;
                bytes.extend(format!("{x} {y} {z} {r} {g} {b}\n").bytes());
            }
        }
    }
    for i in 0..BOXES.len() {
        for face in FACES {
            let face = face.map(|corner| 8 * i + corner);
            if is_binary {
                bytes.push(4);
                bytes.extend(
                    face.iter()
                        .flat_map(|&corner| (corner as i32).to_be_bytes()),
                );
            } else {
                let [a, b, c, d] = face;
                bytes.extend(format!("4 {a} {b} {c} {d}\n").bytes());
            }
        }
    }
    bytes
}

/// +Z points up, and colours have five bits.
fn stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(48_u32.to_le_bytes());
    for (least, most, [r, g, b]) in BOXES {
        let corners = corners(least, most);
        for [a, b_, c, d] in FACES {
            for triangle in [[a, b_, c], [a, c, d]] {
                bytes.extend([0; 12]);
                for corner in triangle.map(|corner| corners[corner]) {
                    let upright = [corner.x, -corner.z, corner.y];
                    bytes.extend(upright.iter().flat_map(|c| c.to_le_bytes()));
                }
                let color = [r, g, b].map(|c| 31 * u16::from(c));
                let word = 0x8000 | color[0] << 10 | color[1] << 5 | color[2];
                bytes.extend(word.to_le_bytes());
            }
        }
    }
    bytes
}

/// One cube of edge 2 around the origin in four nodes; one is mirrored, another lies on its side, and their
/// parent undoes a turn, a shift and an uneven scale.
fn gltf() -> Model {
    let cube = corners([-1.0; 3], [1.0; 3]).map(|corner| corner.to_array());
    let mut model = Model::new();
    let position = model.vectors(&cube);
    let indices: Vec<u8> = FACES
        .iter()
        .flat_map(|&[a, b, c, d]| [a, b, c, a, c, d])
        .flat_map(|corner| (corner as u16).to_le_bytes())
        .collect();
    let indices = model.accessor(&indices, UNSIGNED_SHORT, "SCALAR", 36);
    let primitive = |material: usize| json!([{ "attributes": { "POSITION": position }, "indices": indices, "material": material }]);
    let materials = BOXES.iter().map(|(.., color)| {
        let [r, g, b] = *color;
        json!({ "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1], "metallicFactor": 0, "roughnessFactor": 1 } })
    });
    let meshes = (0..BOXES.len()).map(|i| json!({ "primitives": primitive(i) }));
    // In the parent's space x is stretched by 2, then all is turned by 90° about z and moved.
    let mut nodes = vec![json!({
        "children": [1, 2, 3, 4],
        "matrix": [0, -2, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 3, 1, 0, 1],
    })];
    for (i, (least, most, _)) in BOXES.into_iter().enumerate() {
        let (least, most) = (Vec3::from(least), Vec3::from(most));
        let (center, half) = ((least + most) / 2.0, (most - least) / 2.0);
        // The inverse of the parent: world (x, y, z) is parent ((1 − y)/2, x − 3, z).
        let center = [(1.0 - center.y) / 2.0, center.x - 3.0, center.z];
        let mut scale = [half.y / 2.0, half.x, half.z];
        let mut node = json!({ "mesh": i, "translation": center });
        if i == 1 {
            scale[0] = -scale[0];
        }
        if i == 2 {
            let root = 0.5_f32.sqrt();
            node["rotation"] = json!([0, 0, root, root]);
            scale.swap(0, 1);
        }
        node["scale"] = json!(scale);
        nodes.push(node);
    }
    model.with(json!({
        "nodes": nodes, "meshes": meshes.collect::<Vec<_>>(), "materials": materials.collect::<Vec<_>>(),
    }))
}

/// The model in every format, the reference first.
fn models() -> Vec<(&'static str, Vec<u8>)> {
    let (obj, mtl, model) = (obj(), mtl(), gltf());
    vec![
        (
            "letter.zip",
            archive(&[("a/letter.obj", &obj), ("a/letter.mtl", &mtl)]),
        ),
        ("letter.obj", obj),
        ("text.ply", ply(false)),
        ("binary.ply", ply(true)),
        ("letter.stl", stl()),
        ("letter.glb", model.glb()),
        ("letter.gltf", model.gltf("letter.bin").into_bytes()),
    ]
}

fn load(name: &str, bytes: Vec<u8>) -> Scene {
    let mut files = Memory::from_iter([("letter.mtl", mtl()), ("letter.bin", gltf().bin)]);
    files.insert(name, bytes);
    let options = Options {
        size: Some(SIZE),
        // Pictures of all formats are compared.
        integrator: Some(LightTransport::Whitted),
        baking: import::Baking::Always,
        ..Options::default()
    };
    let scene = import::load_from(&files, name, &options).expect("a scene");
    assert_eq!(scene.skipped, [""; 0], "{name}");
    scene
}

fn render(scene: &Scene, settings: &RenderSettings, tone: &Tone) -> Image {
    let packed = Arc::new(pack::scene(scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    let mut renderer = start_packed(packed, &view, settings);
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer.develop(tone).expect("a picture")
}

/// Which channels are bright where the colour is strong.
fn hues(image: &Image) -> Vec<Option<[bool; 3]>> {
    let hue = |&[r, g, b, _]: &[f32; 4]| {
        let most = r.max(g).max(b);
        let least = r.min(g).min(b);
        (most - least > 0.5 * most && most > 0.02).then(|| [r, g, b].map(|c| c > 0.5 * most))
    };
    image.pixels.iter().map(hue).collect()
}

#[test]
fn a_model_looks_the_same_in_every_format() {
    let shape = RenderSettings {
        integrator: Integrator::Normals,
        ..sized(SIZE.0, SIZE.1)
    };
    let mut reference = None;
    assert_none(models().into_iter().map(|(name, bytes)| {
        let scene = load(name, bytes);
        let normals = render(&scene, &shape, &Tone::LINEAR);
        let hues = hues(&render(&scene, &sized(SIZE.0, SIZE.1), &Tone::LINEAR));
        for (.., color) in BOXES {
            let color = color.map(|c| c == 1);
            let count = hues.iter().filter(|hue| **hue == Some(color)).count();
            if count < 15 {
                return Err(format!("{name}: {count} pixels of {color:?}"));
            }
        }
        let (expected, expected_hues) = reference.get_or_insert((normals.clone(), hues.clone()));
        check_alike(&format!("model {name}"), expected, &normals, 2.0, 0.005)?;
        let pairs = expected_hues.iter().zip(&hues);
        let wrong = pairs
            .filter(|(a, b)| a.is_some() && b.is_some() && a != b)
            .count();
        match wrong {
            0..=8 => Ok(()),
            _ => Err(format!("{name}: {wrong} pixels have another colour")),
        }
    }));
}

/// The pictures of all formats by the classical integrator.
pub fn sheet() -> Image {
    let pictures: Vec<Image> = models()
        .into_iter()
        .map(|(name, bytes)| {
            let scene = load(name, bytes);
            let output = OutputDefaults {
                size: SIZE,
                samples: 16,
                integrator: LightTransport::Whitted,
                tone: Some(ToneCurve::None),
                ..scene.output.clone()
            };
            render(&scene, &RenderSettings::from(&output), &Tone::from(&output))
        })
        .collect();
    Image::sheet(&pictures, COLUMNS)
}
