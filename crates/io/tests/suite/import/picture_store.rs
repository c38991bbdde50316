//! Pictures in scenes of all formats: decoded once, limited in size, and the same whatever decodes them.

use super::gltf::model::{Model, png};
use super::resolver::Recorded;
use super::{folder, load};
use glam::DVec4;
use glimray::import::{self, Memory, Options};
use glimray::scene::{Picture, Scene, Texels};
use glimray::threads;
use image::{GrayImage, ImageFormat};
use serde_json::json;
use std::cell::RefCell;
use std::io::Cursor;
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// A picture of `width` × `height` texels of different colours and alphas.
fn colorful(width: u32, height: u32) -> Vec<u8> {
    let texels: Vec<[u8; 4]> = (0..width * height)
        .map(|i| {
            let (x, y) = (i % width, i / width);
            [x * 40, 255 - y * 30, (x * y) * 11, 255 - x].map(|c| c as u8)
        })
        .collect();
    png(width, &texels)
}

/// A picture as a texture of a native scene, an OBJ model and a glTF model.
fn scenes(picture: &[u8], options: &Options) -> [Scene; 3] {
    let mut model = Model::triangle(json!({
        "attributes": { "TEXCOORD_0": 1 },
        "material": 0,
    }));
    let uvs = super::gltf::model::floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    model.accessor(&uvs, super::gltf::model::FLOAT, "VEC2", 3);
    model.json["materials"] = json!([{ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "metallicFactor": 0 } }]);
    model.json["textures"] = json!([{ "source": 0 }]);
    model.json["images"] = json!([{ "uri": "a.png" }]);
    let folder = folder(&[
        ("a.png", picture),
        (
            "a.toml",
            b"textures.t = { picture = 'a.png' }\nmaterials.m.phong.diffuse = { texture = 't' }",
        ),
        (
            "a.obj",
            b"mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n",
        ),
        ("a.mtl", b"newmtl m\nmap_Kd a.png\n"),
        ("a.glb", &model.glb()),
    ]);
    ["a.toml", "a.obj", "a.glb"].map(|name| {
        import::load_with(&folder.path().join(name), options)
            .unwrap_or_else(|error| panic!("{error}"))
    })
}

/// The mean of the linear values of all texels, by the definition of sRGB in f64.
fn mean(picture: &Picture) -> DVec4 {
    let linear = |code: u8| match f64::from(code) / 255.0 {
        value if value <= 0.04045 => value / 12.92,
        value => ((value + 0.055) / 1.055).powf(2.4),
    };
    let Texels::Srgb8(texels) = &picture.texels else {
        panic!("{picture:?}");
    };
    let sum: DVec4 = (texels.iter())
        .map(|&[r, g, b, a]| DVec4::new(linear(r), linear(g), linear(b), f64::from(a) / 255.0))
        .sum();
    sum / texels.len() as f64
}

#[test]
fn pictures_beyond_the_texture_limit_are_halved_in_linear_light_and_reported() {
    let picture = colorful(32, 8);
    let whole = scenes(&picture, &Options::default());
    for (limit, size) in [(32, (32, 8)), (31, (16, 4)), (8, (8, 2)), (1, (1, 1))] {
        let options = Options {
            texture_limit: NonZero::new(limit),
            ..Options::default()
        };
        for (scene, whole) in scenes(&picture, &options).iter().zip(&whole) {
            let [small, whole] = [scene, whole].map(|scene| &scene.pictures[0]);
            assert_eq!((small.width, small.height), size);
            // Each halving rounds to a code; the steps between bright codes are the largest.
            let off = (mean(small) - mean(whole)).abs().max_element();
            assert!(off < 0.006, "limit {limit}: off by {off}");
            let note =
                format!("1 picture was halved to at most {limit} texels a side, as asked for");
            assert_eq!(
                scene.remarks.contains(&note),
                limit < 32,
                "{:?}",
                scene.remarks
            );
            assert!(scene.skipped.is_empty(), "{:?}", scene.skipped);
        }
    }
}

fn picture(width: u32, height: u32, texels: Texels) -> Picture {
    Picture {
        width,
        height,
        texels,
        origin: glimray::scene::Origin::Texels,
    }
}

#[test]
fn halves_of_data_are_means_of_their_codes() {
    let texels = Texels::Linear8(vec![
        [0, 10, 255, 7],
        [1, 10, 255, 7],
        [98; 4],
        [2, 30, 254, 7],
        [4, 30, 254, 7],
        [98; 4],
    ]);
    // All of an odd width counts: 203/6, 276/6, 1214/6 and 224/6.
    let half = picture(3, 2, texels).halved();
    assert_eq!((half.width, half.height), (1, 1));
    assert_eq!(half.texels, Texels::Linear8(vec![[34, 46, 202, 37]]));
    let bright = Picture::opaque(2, 1, [glam::Vec3::MAX; 2]).halved();
    assert_eq!(bright.linear().next(), Some(glam::Vec3::MAX.extend(1.0)));
}

/// Five texels become two of two and a half, so that a half picture shows the same place as the whole one.
#[test]
fn halves_of_odd_pictures_keep_their_place() {
    let texels = (0..5).map(|i| [50 * i, 0, 0, 255]).collect();
    let half = picture(5, 1, Texels::Linear8(texels)).halved();
    // (0 + 50 + 100/2)/2.5 and (100/2 + 150 + 200)/2.5.
    let expected = vec![[40, 0, 0, 255], [160, 0, 0, 255]];
    assert_eq!(half.texels, Texels::Linear8(expected));
}

/// A colour that nobody sees does not show at the edge of a cut-out.
#[test]
fn halves_of_colors_are_weighted_with_alpha() {
    let texels = vec![[255, 0, 0, 255], [0, 255, 0, 0]];
    let half = picture(2, 1, Texels::Srgb8(texels)).halved();
    let Texels::Srgb8(texels) = &half.texels else {
        panic!("not in sRGB");
    };
    let [r, g, b, a] = texels[0];
    assert!(r == 255 && g <= 1 && b == 0 && a == 128, "{:?}", texels[0]);
}

/// A glTF model with `count` images, each the base colour of a material of its own.
fn many(count: usize) -> Vec<u8> {
    let mut model = Model::new();
    let position = model.vectors(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let uvs = super::gltf::model::floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let uvs = model.accessor(&uvs, super::gltf::model::FLOAT, "VEC2", 3);
    let (mut materials, mut textures, mut images) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..count {
        let attributes = json!({ "attributes": { "TEXCOORD_0": uvs }, "material": i });
        model.primitive(position, attributes);
        let view = model.view(&colorful(1 + i as u32 % 6, 1 + i as u32 % 7));
        images.push(json!({ "bufferView": view, "mimeType": "image/png" }));
        textures.push(json!({ "source": i }));
        materials.push(json!({ "pbrMetallicRoughness": {
            "baseColorTexture": { "index": i }, "metallicFactor": 0 } }));
    }
    model.json["materials"] = json!(materials);
    model.json["textures"] = json!(textures);
    model.json["images"] = json!(images);
    model.glb()
}

#[test]
fn pictures_do_not_depend_on_the_number_of_threads() {
    const COUNT: usize = 150;
    let file = many(COUNT);
    let read = |count| threads::with(count, || load("a.glb", &file)).expect("a scene");
    let (one, five) = (read(1), read(5));
    assert_eq!(one.pictures.len(), COUNT);
    assert_eq!(one.pictures, five.pictures);
    assert_eq!(one.textures, five.textures);
    for (i, picture) in one.pictures.iter().enumerate() {
        let size = (1 + i as u32 % 6, 1 + i as u32 % 7);
        assert_eq!((picture.width, picture.height), size, "picture {i}");
    }
}

#[test]
fn a_file_is_one_picture_for_all_materials_that_use_it_alike() {
    let picture = colorful(4, 4);
    let folder = folder(&[
        ("a.png", &picture),
        ("a.obj", b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\nusemtl n\nf 1/1 2/1 3/1\n"),
        ("a.mtl", b"newmtl m\nmap_Kd a.png\nnewmtl n\nmap_Kd ./a.png\nmap_Ks a.png\nnorm a.png\n"),
        ("a.toml", b"objects = [{ mesh = { file = 'a.obj' } }]\ntextures.t = { picture = 'a.png' }"),
    ]);
    for name in ["a.obj", "a.toml"] {
        let scene = import::load(&folder.path().join(name)).expect("a scene");
        let texels = |picture: &Arc<Picture>| matches!(picture.texels, Texels::Srgb8(_));
        let kinds: Vec<bool> = scene.pictures.iter().map(texels).collect();
        // Colours, and the values of the normal map.
        assert_eq!(kinds, [true, false], "{name}");
    }
}

#[test]
fn a_height_map_is_planned_with_the_other_maps_unless_a_normal_map_replaces_it() {
    let reads = |maps: &str| {
        let model = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
        let files = Memory::from_iter([
            ("a.obj", model.into()),
            ("a.mtl", format!("newmtl m\n{maps}").into_bytes()),
            ("a.png", colorful(4, 4)),
            ("b.png", colorful(4, 4)),
        ]);
        let recorded = Recorded(files, RefCell::default());
        import::load_from(&recorded, "a.obj", &Options::default()).expect("a scene");
        let mut reads = recorded.1.into_inner();
        reads.retain(|path| path.extension() == Some("png".as_ref()));
        reads
    };
    // A file for two roles is read and decoded once, because both are known before the first use.
    assert_eq!(
        reads("map_Kd a.png\nmap_Bump a.png\n"),
        ["a.png"].map(PathBuf::from)
    );
    assert_eq!(
        reads("map_Kd a.png\nbump -bm -2 a.png\n"),
        ["a.png"].map(PathBuf::from)
    );
    assert_eq!(
        reads("map_Kd a.png\nmap_Bump b.png\nnorm a.png\n"),
        ["a.png"].map(PathBuf::from)
    );
    assert_eq!(
        reads("map_Kd a.png\nmap_Bump b.png\n"),
        ["a.png", "b.png"].map(PathBuf::from)
    );
}

/// 11 GiB are 44 pictures of 8192 × 8192 texels. The one after those is refused from its header, before any is decoded, which
/// would take minutes.
#[test]
fn pictures_that_announce_too_much_together_are_refused_before_they_are_decoded() {
    const SIDE: u32 = 8192;
    let mut picture = Cursor::new(Vec::new());
    let black = GrayImage::new(SIDE, SIDE);
    (black.write_to(&mut picture, ImageFormat::Png)).expect("a picture");
    let names: Vec<String> = (0..50).map(|i| format!("{i}.png")).collect();
    let lines = names.iter().map(|name| format!("[[objects]]\nsphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = {{ phong = {{ diffuse = {{ picture = '{name}' }} }} }}\n"));
    let text = lines.collect::<String>();
    let mut files: Vec<(&str, &[u8])> = vec![("a.toml", text.as_bytes())];
    files.extend(names.iter().map(|name| (&name[..], &picture.get_ref()[..])));
    let folder = folder(&files);
    let started = Instant::now();
    let error = import::load(&folder.path().join("a.toml")).expect_err("refused");
    assert!(error.is_too_big());
    assert!(started.elapsed().as_secs() < 60, "{:?}", started.elapsed());
    let message = super::without_folder(&error, folder.path());
    insta::assert_snapshot!(message, @"picture refused (a.toml:135:46): `44.png` is one picture too many: together they have more than 11 GiB of texels. Use a smaller picture.");
}

#[test]
fn of_several_bad_pictures_the_first_is_named() {
    let good = colorful(2, 2);
    let text = "\
        textures.a = { picture = 'good.png' }\n\
        textures.b = { picture = 'bad.png' }\n\
        textures.c = { picture = 'worse.png' }\n";
    let folder = folder(&[
        ("a.toml", text.as_bytes()),
        ("good.png", &good),
        ("bad.png", &good[..good.len() / 2]),
        ("worse.png", b"no picture"),
    ]);
    for threads in [1, 3] {
        let load = || super::message_in(&folder, "a.toml", &Options::default());
        let message = threads::with(threads, load);
        assert!(
            message.contains("(a.toml:2:26): `bad.png` is truncated"),
            "{message}"
        );
    }
}
