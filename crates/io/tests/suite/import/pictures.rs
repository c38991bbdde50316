//! Images of scenes: their texels, and errors.

use super::{folder, message_in};
use glam::{Vec3, Vec4Swizzles};
use glimray::import::{self, Options};
use glimray::scene::{Background, Minify, Pattern, Picture, Scene, Space, Texels, Wrap};
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba};
use insta::assert_snapshot;
use std::io::Cursor;

/// The bytes of a picture file.
fn encode(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image
        .into()
        .write_to(&mut bytes, format)
        .expect("a picture");
    bytes.into_inner()
}

/// A scene with a texture of this picture.
fn with_texture(name: &str, bytes: &[u8]) -> Scene {
    let text = format!("textures.t = {{ picture = '{name}' }}");
    let folder = folder(&[("a.toml", text.as_bytes()), (name, bytes)]);
    import::load(&folder.path().join("a.toml")).unwrap_or_else(|error| panic!("{error}"))
}

fn picture(name: &str, bytes: &[u8]) -> Picture {
    (*with_texture(name, bytes).pictures[0]).clone()
}

/// IEC 61966-2-1, inverted by bisection: the value with the code `code`.
fn linear(code: f64) -> f64 {
    let encoded = |x: f64| match x {
        x if x <= 0.003_130_8 => 12.92 * x,
        x => 1.055 * x.powf(1.0 / 2.4) - 0.055,
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if encoded(middle) < code {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low + high) / 2.0
}

fn assert_near(picture: &Picture, expected: &[[f64; 3]], tolerance: f64) {
    assert_eq!(picture.texels.len(), expected.len());
    for (texel, expected) in picture.linear().zip(expected) {
        let off = (texel.truncate().as_dvec3() - glam::DVec3::from(*expected)).abs();
        assert!(off.max_element() <= tolerance, "{texel}, not {expected:?}");
    }
}

#[test]
fn png_is_srgb_in_eight_and_sixteen_bits_from_the_top_left() {
    let codes = [[0u8, 128, 255], [1, 10, 11], [64, 65, 200], [254, 3, 90]];
    let image = ImageBuffer::from_fn(2, 2, |x, y| Rgb(codes[(2 * y + x) as usize]));
    let read = picture("a.png", &encode(image, ImageFormat::Png));
    assert_eq!((read.width, read.height), (2, 2));
    let expected = codes.map(|texel| texel.map(|code| linear(f64::from(code) / 255.0)));
    assert_near(&read, &expected, 2e-5);
    assert!(matches!(read.texels, Texels::Srgb8(_)), "{read:?}");

    let codes = [[0u16, 300, 65535], [4000, 33_333, 65_000]];
    let image = ImageBuffer::from_fn(2, 1, |x, _| Rgb(codes[x as usize]));
    let read = picture("a.png", &encode(image, ImageFormat::Png));
    let expected = codes.map(|texel| texel.map(|code| linear(f64::from(code) / 65535.0)));
    assert_near(&read, &expected, 2e-5);
}

#[test]
fn grey_becomes_three_channels_and_alpha_is_linear() {
    let grey = ImageBuffer::from_pixel(1, 1, Luma([77u8]));
    let value = linear(77.0 / 255.0);
    let read = picture("a.png", &encode(grey, ImageFormat::Png));
    assert_near(&read, &[[value; 3]], 2e-5);
    let alpha = |picture: &Picture| f64::from(picture.linear().next().expect("a texel").w);
    assert_eq!(alpha(&read), 1.0);
    let thin = ImageBuffer::from_pixel(1, 1, Rgba([77u8, 77, 77, 51]));
    let read = picture("a.png", &encode(thin, ImageFormat::Png));
    assert_near(&read, &[[value; 3]], 2e-5);
    assert!((alpha(&read) - 0.2).abs() < 1e-7);
    let thin = ImageBuffer::from_pixel(1, 1, LumaA([257 * 77u16, 13_107]));
    let read = picture("a.png", &encode(thin, ImageFormat::Png));
    assert_near(&read, &[[value; 3]], 2e-5);
    assert!((alpha(&read) - 0.2).abs() < 1e-7);
}

#[test]
fn jpeg_is_srgb_whatever_its_extension() {
    let image = ImageBuffer::from_pixel(8, 8, Rgb([200u8, 100, 50]));
    let bytes = encode(image, ImageFormat::Jpeg);
    let expected = [200.0, 100.0, 50.0].map(|code| linear(code / 255.0));
    for name in ["a.jpg", "a.jpeg", "a.png", "a"] {
        assert_near(&picture(name, &bytes), &[expected; 64], 0.02);
    }
}

#[test]
fn hdr_and_exr_are_linear() {
    // Radiance stores three 8-bit mantissas with one exponent: these values are exact.
    let values = [
        [0.5f32, 0.25, 1.0],
        [12.0, 3.0, 0.0],
        [0.0, 0.0, 0.0],
        [1e3, 2e3, 4e3],
    ];
    let image = ImageBuffer::from_fn(4, 1, |x, _| Rgb(values[x as usize]));
    let read = picture("a.hdr", &encode(image.clone(), ImageFormat::Hdr));
    let expected = values.map(|texel| texel.map(f64::from));
    assert_near(&read, &expected, 16.0);
    let first = read.linear().take(3).map(|texel| texel.truncate());
    assert_near(&Picture::opaque(3, 1, first), &expected[..3], 0.04);

    let values = [[0.1f32, 1.7, 60_000.0], [-3.0, f32::NAN, f32::INFINITY]];
    let image = ImageBuffer::from_fn(2, 1, |x, _| Rgb(values[x as usize]));
    let read = picture("a.exr", &encode(image, ImageFormat::OpenExr));
    let texels: Vec<_> = read.linear().collect();
    assert_eq!(texels[0].truncate(), Vec3::from(values[0]));
    // Negative values and NaN become 0.
    assert_eq!(texels[1].xy(), glam::Vec2::ZERO);
    assert!(texels[1].z.is_finite());
}

#[test]
fn an_image_used_twice_is_read_once() {
    let image = ImageBuffer::from_pixel(4, 2, Rgb([9u8, 9, 9]));
    let bytes = encode(image, ImageFormat::Png);
    let text = b"
        background = { picture = 'a.png', strength = 2, rotation_deg = 90 }
        textures.t = { picture = { file = './a.png', nearest = true } }
        materials.m.phong.diffuse = { picture = { file = 'sub/../a.png' }, space = 'world' }";
    let folder = folder(&[("a.toml", text), ("a.png", &bytes), ("sub/b", b"")]);
    let options = Options {
        allow_dirs: vec![folder.path().to_owned()],
        ..Options::default()
    };
    let scene = import::load_with(&folder.path().join("a.toml"), &options).expect("a scene");
    // One for all textures, and that of the background, which may have a scale.
    assert_eq!(scene.pictures.len(), 2);
    assert_eq!(scene.pictures[0], scene.pictures[1]);
    let background = Background::Picture {
        picture: 1,
        strength: 2.0,
        rotation: 90f64.to_radians(),
    };
    assert_eq!(scene.background, background);
    let shows = |i: usize, is_nearest| {
        let Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap,
        } = scene.textures[i].pattern
        else {
            panic!("not a picture");
        };
        assert_eq!(wrap, [Wrap::Repeat; 2]);
        assert_eq!(minify, Minify::LinearMipmapLinear);
        assert_eq!((picture, nearest), (0, is_nearest));
        scene.textures[i].space
    };
    assert_eq!((shows(0, true), shows(1, false)), (Space::Uv, Space::World));
}

/// The header of a PNG of this size, without data.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut chunk = b"IHDR".to_vec();
    chunk.extend(width.to_be_bytes());
    chunk.extend(height.to_be_bytes());
    chunk.extend([8, 2, 0, 0, 0]);
    // The polynomial of ISO 3309, bit by bit.
    let crc = chunk.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(crc & 1))
        })
    });
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
    bytes.extend(chunk);
    bytes.extend((!crc).to_be_bytes());
    // The end of the header: the first texels are missing.
    bytes.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
    bytes
}

#[test]
fn every_invalid_image_has_a_message() {
    let good = encode(
        ImageBuffer::from_pixel(9, 9, Rgb([1u8, 2, 3])),
        ImageFormat::Png,
    );
    let files: [(&str, &[u8]); 9] = [
        ("empty.png", b""),
        ("text.png", b"this is no picture at all"),
        ("cut.png", &good[..good.len() / 2]),
        ("wide.png", &png_header(100_000, 100_000)),
        ("huge.png", &png_header(u32::MAX, u32::MAX)),
        ("flat.png", &png_header(0, 7)),
        (
            "huge.hdr",
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n",
        ),
        ("cut.exr", b"\x76\x2f\x31\x01\x02\0\0\0chan"),
        ("a.gif", b"GIF89a\x01\0\x01\0\0\0\0;"),
    ];
    let names = files.iter().map(|file| file.0);
    let others = [
        "gone.png",
        "sub",
        "../a.png",
        "/etc/passwd",
        "",
        "http://a.org/a.png",
    ];
    let folder = folder(&[&files[..], &[("sub/b", b"")]].concat());
    let lines: Vec<_> = (names.chain(others))
        .map(|name| {
            let text = format!("ambient = [0, 0, 0]\nbackground = {{ picture = '{name}' }}");
            std::fs::write(folder.path().join("a.toml"), text).expect("a scene");
            message_in(&folder, "a.toml", &Options::default())
        })
        .collect();
    assert_snapshot!(lines.join("\n"), @r"
picture refused (a.toml:2:26): `empty.png` is empty. Check that it was written completely.
picture refused (a.toml:2:26): `text.png` is not a supported image. Name a PNG, JPEG, WebP, KTX2, HDR or EXR file.
picture refused (a.toml:2:26): `cut.png` is truncated: its end is missing. Check that it was written completely.
picture refused (a.toml:2:26): `wide.png` has 100000 × 100000 texels, but the limit is 67108864 of them. Use a smaller picture.
picture refused (a.toml:2:26): `huge.png` takes too much memory to decode. Use a smaller picture.
picture refused (a.toml:2:26): `flat.png` is damaged: Format error decoding Png: Invalid image dimensions. Check that it was written completely.
picture refused (a.toml:2:26): `huge.hdr` has 60000 × 60000 texels, but the limit is 67108864 of them. Use a smaller picture.
picture refused (a.toml:2:26): `cut.exr` is damaged: invalid: reference to missing bytes. Check that it was written completely.
picture refused (a.toml:2:26): `a.gif` is an image of an unsupported kind. Save it as PNG, JPEG, WebP, KTX2, HDR or EXR.
picture refused (a.toml:2:26): `gone.png` does not exist. Check the name and the folder.
picture refused (a.toml:2:26): `sub` is not a plain file. Name a plain file in the scene folder.
picture refused (a.toml:2:26): `../a.png` points outside the scene folder. Name a file in it, or permit the other folder.
picture refused (a.toml:2:26): `/etc/passwd` points outside the scene folder. Name a file in it, or permit the other folder.
picture refused (a.toml:2:26): `` is not a file name. Name a plain file in the scene folder.
picture refused (a.toml:2:26): `http://a.org/a.png` points outside the scene folder. Name a file in it, or permit the other folder.
");
}

/// Complete images of all formats, and their file names.
fn whole_pictures() -> Vec<(&'static str, Vec<u8>)> {
    let color = ImageBuffer::from_fn(61, 47, |x, y| Rgb([(4 * x) as u8, (5 * y) as u8, 77u8]));
    let light = ImageBuffer::from_fn(61, 47, |x, y| Rgb([x as f32, y as f32 / 9.0, 0.5f32]));
    vec![
        ("a.jpg", encode(color.clone(), ImageFormat::Jpeg)),
        // Written by libjpeg, with chroma at half the resolution.
        (
            "progressive.jpg",
            include_bytes!("../../../../../tests/fuzz/regressions/picture/progressive.jpg")
                .to_vec(),
        ),
        ("a.webp", encode(color.clone(), ImageFormat::WebP)),
        ("a.png", encode(color, ImageFormat::Png)),
        ("a.hdr", encode(light.clone(), ImageFormat::Hdr)),
        ("a.exr", encode(light, ImageFormat::OpenExr)),
    ]
}

/// The result of reading an image with these bytes.
fn read(folder: &tempfile::TempDir, bytes: &[u8]) -> Result<(), import::ImportError> {
    let path = folder.path().join("picture");
    std::fs::write(&path, bytes).expect("a file");
    import::picture(&path).map(|_| ())
}

#[test]
fn a_truncated_picture_is_refused_wherever_it_is_cut() {
    let folder = folder(&[]);
    for (name, whole) in whole_pictures() {
        read(&folder, &whole).unwrap_or_else(|error| panic!("{error}"));
        let cuts = (0..100).map(|percent| whole.len() * percent / 100);
        for length in cuts.chain(whole.len() - 20..whole.len()) {
            let Err(error) = read(&folder, &whole[..length]) else {
                panic!("{name}: {length} of {} bytes were accepted", whole.len());
            };
            assert!(!error.is_too_big(), "{error}");
        }
    }
}

#[test]
fn bytes_after_an_image_are_ignored() {
    let folder = folder(&[]);
    for (name, mut whole) in whole_pictures().into_iter().take(4) {
        whole.extend(b"\0\0whatever");
        let read = read(&folder, &whole);
        read.unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn a_picture_that_claims_more_than_its_bytes_can_hold_is_refused() {
    let folder = folder(&[]);
    let bytes_of = |name: &str| {
        let mut pictures = whole_pictures().into_iter();
        pictures.find(|picture| picture.0 == name).expect("one").1
    };
    // The frame header: its marker, length, precision, and then height and width.
    for (name, marker) in [("a.jpg", 0xc0), ("progressive.jpg", 0xc2)] {
        let mut bytes = bytes_of(name);
        let frame = bytes.windows(2).position(|pair| pair == [0xff, marker]);
        let frame = frame.expect("a frame header");
        bytes[frame + 5..frame + 9].copy_from_slice(&[0x16, 0xa0, 0x16, 0xa0]);
        let error = read(&folder, &bytes).expect_err("refused");
        assert!(error.to_string().contains("cannot hold"), "{name}: {error}");
    }
    // Refused too: an image of a single colour, the best case of every format.
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 5792 +X 5792\n";
    let error = read(&folder, header).expect_err("refused");
    assert!(error.to_string().contains("cannot hold"), "{error}");
    let mut png = png_header(5792, 5792);
    png.extend(b"\0\0\0\0IEND\xae\x42\x60\x82");
    let error = read(&folder, &png).expect_err("refused");
    assert!(error.to_string().contains("cannot hold"), "{error}");
}

#[test]
fn pictures_that_compress_best_are_read() {
    let folder = folder(&[]);
    let plain = ImageBuffer::from_pixel(2048, 2048, Luma([9u8]));
    for format in [ImageFormat::Jpeg, ImageFormat::Png] {
        let read = read(&folder, &encode(plain.clone(), format));
        read.unwrap_or_else(|error| panic!("{error}"));
    }
    let plain = ImageBuffer::from_pixel(2048, 1024, Rgb([0.5f32; 3]));
    for format in [ImageFormat::Hdr, ImageFormat::OpenExr] {
        let read = read(&folder, &encode(plain.clone(), format));
        read.unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn an_embedded_scene_has_no_pictures() {
    let text = "background = { picture = 'a.png' }";
    let error = import::parse("a.toml", text, &Options::default()).expect_err("refused");
    assert_snapshot!(error, @"picture refused (a.toml:1:26): `a.png`: a built-in scene has no folder. Name a plain file in the scene folder.");
}

/// Valid images of every format, truncated and corrupted in reproducible ways.
#[test]
fn no_corruption_of_an_image_makes_the_importer_panic() {
    let color = ImageBuffer::from_fn(13, 9, |x, y| Rgb([(x * 19) as u8, (y * 27) as u8, 77u8]));
    let light = ImageBuffer::from_fn(13, 9, |x, y| Rgb([x as f32, y as f32 / 9.0, 0.5f32]));
    let files = [
        ("a.png", encode(color.clone(), ImageFormat::Png)),
        ("a.jpg", encode(color.clone(), ImageFormat::Jpeg)),
        ("a.webp", encode(color, ImageFormat::WebP)),
        ("a.hdr", encode(light.clone(), ImageFormat::Hdr)),
        ("a.exr", encode(light, ImageFormat::OpenExr)),
    ];
    let mut bits = 0x1357_9bdf_u32;
    let mut random = |below: usize| {
        bits ^= bits << 13;
        bits ^= bits >> 17;
        bits ^= bits << 5;
        bits as usize % below
    };
    let folder = folder(&[]);
    for (name, good) in files {
        let text = format!("textures.t = {{ picture = '{name}' }}");
        std::fs::write(folder.path().join("a.toml"), text).expect("a scene");
        for i in 0..400 {
            let mut bad = good.clone();
            if i % 2 == 0 {
                bad.truncate(random(good.len()));
            }
            for _ in 0..1 + random(4) {
                let at = random(bad.len() + 1).min(bad.len().saturating_sub(1));
                if let Some(byte) = bad.get_mut(at) {
                    *byte = [0, 1, 0x7f, 0x80, 0xff, random(256) as u8][random(6)];
                }
            }
            std::fs::write(folder.path().join(name), bad).expect("a picture");
            match import::load(&folder.path().join("a.toml")) {
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                Ok(scene) => assert!(
                    scene.pictures[0]
                        .linear()
                        .all(|texel| { texel.is_finite() && texel.min_element() >= 0.0 })
                ),
            }
        }
    }
}

/// An EXR of one part with these channels, each of 2 × 1 values.
fn exr_of(channels: &[(&str, [f32; 2])]) -> Vec<u8> {
    use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, WritableImage};
    let list: Vec<_> = (channels.iter())
        .map(|(name, values)| AnyChannel::new(*name, FlatSamples::F32(values.to_vec())))
        .collect();
    let image = Image::from_channels((2, 1), AnyChannels::sort(list.into()));
    let mut bytes = Cursor::new(Vec::new());
    (image.write().non_parallel().to_buffered(&mut bytes)).expect("a picture");
    bytes.into_inner()
}

#[test]
fn an_exr_of_luminance_alone_is_grey_and_others_without_colors_are_named() {
    let read = picture("a.exr", &exr_of(&[("Y", [0.25, 3.0])]));
    assert_eq!((read.width, read.height), (2, 1));
    assert_near(&read, &[[0.25; 3], [3.0; 3]], 0.0);
    let moves = exr_of(&[("U", [0.25, 3.0]), ("V", [0.25, 3.0])]);
    let whole = exr_of(&[("Y", [0.25, 3.0])]);
    let colored = [("Y", [0.5; 2]), ("BY", [0.5; 2]), ("RY", [0.5; 2])];
    let folder = folder(&[
        ("moves.exr", &moves),
        ("yuv.exr", &exr_of(&colored)),
        ("cut.exr", &whole[..whole.len() - 6]),
    ]);
    let lines = ["moves.exr", "yuv.exr", "cut.exr"].map(|name| {
        let text = format!("textures.t = {{ picture = '{name}' }}");
        std::fs::write(folder.path().join("a.toml"), text).expect("a scene");
        message_in(&folder, "a.toml", &Options::default())
    });
    let todo = "Save it with R, G and B, or with a single channel for a grey picture.";
    assert!(lines[0].contains("`moves.exr` has no channels R, G and B, but `U`, `V`"));
    assert!(lines[0].ends_with(todo), "{}", lines[0]);
    assert!(lines[1].contains("but `BY`, `RY`, `Y`"), "{}", lines[1]);
    assert!(lines[2].contains("`cut.exr` is "), "{}", lines[2]);
}

#[test]
fn what_is_repaired_in_a_texture_is_noted() {
    let skipped = |values: [f32; 4]| {
        let image = ImageBuffer::from_fn(4, 1, |x, _| Rgb([0.5, values[x as usize], 0.5f32]));
        let scene = with_texture("a.exr", &encode(image, ImageFormat::OpenExr));
        (
            scene.skipped.clone(),
            scene.pictures[0].linear().map(|texel| texel.y).collect(),
        )
    };
    assert_eq!(skipped([0.0, 1.0, 65504.0, 2.0]).0, [] as [&str; 0]);
    let (notes, values): (_, Vec<f32>) = skipped([f32::NAN, 1.0, -2.0, f32::INFINITY]);
    assert_eq!(values, [0.0, 1.0, 0.0, 0.0]);
    assert_eq!(
        notes,
        [
            "3 texels of `a.exr` were infinite, negative or not a number in some channel, which is 0 there: check the program that wrote it"
        ]
    );
    // The luminance of red and blue is 0.2848, that of green 0.7152: 934,496 of 1,000,000 times the latter are lost.
    let (notes, values): (_, Vec<f32>) = skipped([1.0, 1e6, 1.0, 1.0]);
    assert_eq!(values, [1.0, 65504.0, 1.0, 1.0]);
    let lost = 100.0 * 0.7152 * (1e6 - 65504.0) / (0.7152 * (1e6 + 3.0) + 4.0 * 0.5 * 0.2848);
    assert_eq!(
        notes,
        [format!(
            "1 texel of `a.exr` was cut to 65504, the largest value, so that {lost:.2} % of its light is lost: make the picture darker, and what it multiplies brighter"
        )]
    );
}
