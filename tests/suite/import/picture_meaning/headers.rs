//! Headers of Radiance HDR, PNG and JPEG files.

use super::{assert_near, texels, with_texture};
use crate::import::{folder, message_in};
use glam::{Vec3, Vec4};
use glimray::import::Options;
use image::{ImageBuffer, ImageFormat, Rgb};
use std::io::Cursor;

/// A Radiance file of 3 × 2 texels in rows from the top, not compressed: the first is ([0], 0.25, 0.125) and so on. All
/// values are exact.
pub fn radiance(header: &str, resolution: &str, reds: &[f32]) -> Vec<u8> {
    let mut bytes = format!("{header}\n\n{resolution}\n").into_bytes();
    for red in reds {
        // The exponent of values below 1, so that a mantissa is 256 times the value.
        bytes.extend([red * 256.0, 64.0, 32.0].map(|value| value as u8));
        bytes.push(128);
    }
    bytes
}

pub const REDS: [f32; 6] = [0.5, 0.25, 0.75, 0.125, 0.625, 0.375];

fn check_radiance(header: &str, resolution: &str, reds: &[f32], factor: Vec3, notes: &[&str]) {
    let scene = with_texture("a.hdr", &radiance(header, resolution, reds), "");
    let picture = &scene.pictures[0];
    assert_eq!((picture.width, picture.height), (3, 2), "{resolution}");
    let expected = REDS.map(|red| factor * Vec3::new(red, 0.25, 0.125));
    let found: Vec<Vec3> = picture.linear().map(Vec4::truncate).collect();
    assert_eq!(found, expected, "{header}, {resolution}");
    assert_eq!(scene.skipped, notes, "{header}");
}

#[test]
fn headers_of_radiance_files_count() {
    let plain = "FORMAT=32-bit_rle_rgbe";
    let half = Vec3::splat(0.5);
    let rows: [(String, Vec3, &[&str]); 9] = [
        (format!("#?RADIANCE\n{plain}"), Vec3::ONE, &[]),
        (format!("#?RGBE\n{plain}"), Vec3::ONE, &[]),
        (format!("#?RADIANCE\r\n{plain}\r"), Vec3::ONE, &[]),
        (
            "#?RGBE\nSOFTWARE=none\n# EXPOSURE=8".to_owned(),
            Vec3::ONE,
            &[],
        ),
        (format!("#?RADIANCE\nEXPOSURE=2\n{plain}"), half, &[]),
        (
            format!("#?RADIANCE\nEXPOSURE= 1e1\n{plain}\nEXPOSURE=.4\n\tEXPOSURE=7"),
            Vec3::splat(0.25),
            &[],
        ),
        (
            format!("#?RADIANCE\nCOLORCORR=1 2 4\n{plain}"),
            Vec3::new(1.0, 0.5, 0.25),
            &[],
        ),
        (
            format!("#?RADIANCE\nPIXASPECT=2\nEXPOSURE=-1\nGAMMA=2.2\n{plain}"),
            Vec3::ONE,
            &[
                "`a.hdr` says `PIXASPECT=2`, which is not applied",
                "`a.hdr` says `EXPOSURE=-1`, which is not applied",
                "`a.hdr` says `GAMMA=2.2`, which is not applied",
            ],
        ),
        (
            format!("#?RADIANCE\nPRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n{plain}"),
            Vec3::ONE,
            &[],
        ),
    ];
    for (header, factor, notes) in rows {
        check_radiance(&header, "-Y 2 +X 3", &REDS, factor, notes);
    }
}

#[test]
fn scan_lines_of_radiance_files_lie_as_their_header_says() {
    let [a, b, c, d, e, f] = REDS;
    for (resolution, reds) in [
        ("-Y 2 +X 3", [a, b, c, d, e, f]),
        ("-Y 2 -X 3", [c, b, a, f, e, d]),
        ("+Y 2 +X 3", [d, e, f, a, b, c]),
        ("+Y 2 -X 3", [f, e, d, c, b, a]),
        ("+X 3 -Y 2", [a, d, b, e, c, f]),
        ("+X 3 +Y 2", [d, a, e, b, f, c]),
        ("-X 3 -Y 2", [c, f, b, e, a, d]),
        ("-X 3 +Y 2", [f, c, e, b, d, a]),
    ] {
        check_radiance(
            "#?RGBE\nFORMAT=32-bit_rle_rgbe",
            resolution,
            &reds,
            Vec3::ONE,
            &[],
        );
    }
}

#[test]
fn colors_of_radiance_files_are_converted_to_rec_709() {
    let read = |header: &str, color: [u8; 3]| {
        let mut file = format!("#?RADIANCE\n{header}\n\n-Y 1 +X 1\n").into_bytes();
        file.extend(color);
        file.push(128);
        texels(&with_texture("a.hdr", &file, "").pictures[0])[0]
    };
    // X, Y and Z of D65 with Y = 0.5, in 256ths; and IEC 61966-2-1 for the green primary.
    let white = read("FORMAT=32-bit_rle_xyze", [122, 128, 139]);
    assert_near(white, [0.5, 0.5, 0.5, 1.0], 0.01);
    let green = read("FORMAT=32-bit_rle_xyze", [92, 183, 31]);
    assert_near(green, [0.0, 1.0, 0.0, 1.0], 0.01);
    let of_rec2020 = "PRIMARIES=.708 .292 .17 .797 .131 .046 .3127 .329\nFORMAT=32-bit_rle_rgbe";
    assert_near(
        read(of_rec2020, [128, 128, 128]),
        [0.5, 0.5, 0.5, 1.0],
        1e-3,
    );
    assert_near(read(of_rec2020, [128, 0, 0]), [0.830, 0.0, 0.0, 1.0], 1e-3);
}

#[test]
fn radiance_files_that_cannot_be_read_are_refused() {
    let body = [128; 24];
    let lines: Vec<String> = [
        "#?RADIANCE\nFORMAT=Radiance_spectra\n\n-Y 2 +X 3\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +Y 3\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\nY 2 X 3\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n",
    ]
    .iter()
    .map(|header| {
        let bytes = [header.as_bytes(), &body].concat();
        let folder = folder(&[
            ("a.toml", b"textures.t = { picture = 'a.hdr' }"),
            ("a.hdr", &bytes),
        ]);
        message_in(&folder, "a.toml", &Options::default())
    })
    .collect();
    insta::assert_snapshot!(lines.join("\n"), @r"
    picture refused (a.toml:1:26): `a.hdr` has the unsupported encoding `Radiance_spectra`. Save it as PNG, JPEG, WebP, KTX2, HDR or EXR.
    picture refused (a.toml:1:26): `a.hdr` is damaged: `-Y 2 +Y 3` is no size of a picture. Check that it was written completely.
    picture refused (a.toml:1:26): `a.hdr` is damaged: `Y 2 X 3` is no size of a picture. Check that it was written completely.
    picture refused (a.toml:1:26): `a.hdr` is truncated: its header has no end. Check that it was written completely.
    ");
}

/// A PNG with a chunk before its texels.
pub fn png_with(name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let image = ImageBuffer::from_pixel(2, 1, Rgb([9u8, 9, 9]));
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, ImageFormat::Png)
        .expect("a picture");
    let mut chunk = name.to_vec();
    chunk.extend(data);
    // The polynomial of ISO 3309, bit by bit.
    let crc = chunk.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & 0u32.wrapping_sub(crc & 1))
        })
    });
    let length = data.len() as u32;
    let chunk = [&length.to_be_bytes()[..], &chunk, &(!crc).to_be_bytes()].concat();
    let mut bytes = bytes.into_inner();
    // Behind the signature and the header.
    bytes.splice(33..33, chunk);
    bytes
}

#[test]
fn color_spaces_that_are_not_followed_are_said() {
    let words =
        |numbers: &[u32]| -> Vec<u8> { numbers.iter().flat_map(|n| n.to_be_bytes()).collect() };
    let of_srgb = [31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000];
    let adobe = [31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000];
    for (name, data, note) in [
        (b"gAMA", words(&[45455]), None),
        (
            b"gAMA",
            words(&[100_000]),
            Some("has a gamma of its own, which is not applied: sRGB is assumed"),
        ),
        (b"cHRM", words(&of_srgb), None),
        (
            b"cHRM",
            words(&adobe),
            Some("has primaries of its own, which are not applied: sRGB is assumed"),
        ),
        (b"cICP", vec![1, 13, 0, 1], None),
        (
            b"cICP",
            vec![9, 16, 0, 1],
            Some("names a colour space by code points, which is not applied: sRGB is assumed"),
        ),
        (b"tEXt", b"Comment\0gAMA".to_vec(), None),
    ] {
        let file = png_with(name, &data);
        let expected: Vec<String> = note.iter().map(|note| format!("`a.png` {note}")).collect();
        assert_eq!(with_texture("a.png", &file, "").skipped, expected);
        let numbers = with_texture("a.png", &file, ", linear = true");
        assert_eq!(
            numbers.skipped,
            [] as [&str; 0],
            "numbers have no colour space"
        );
    }
}

/// Exif data of a JPEG file that turns it.
#[test]
fn pictures_that_their_exif_data_turns_are_said() {
    let mut bytes = Cursor::new(Vec::new());
    let image = ImageBuffer::from_pixel(8, 8, Rgb([9u8, 9, 9]));
    image
        .write_to(&mut bytes, ImageFormat::Jpeg)
        .expect("a picture");
    let turned = |orientation: u8| {
        // One entry of a little-endian TIFF directory: tag 0x112, one number of 16 bits.
        let tiff = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
        let mut tiff = tiff.to_vec();
        tiff[24] = orientation;
        let length = (tiff.len() + 2) as u16;
        let segment = [&[0xff, 0xe1][..], &length.to_be_bytes(), &tiff].concat();
        let mut bytes = bytes.get_ref().clone();
        bytes.splice(2..2, segment);
        bytes
    };
    let note = "`a.jpg` is turned or mirrored by its Exif data, which is not applied";
    for more in ["", ", linear = true"] {
        assert_eq!(with_texture("a.jpg", &turned(6), more).skipped, [note]);
        assert_eq!(
            with_texture("a.jpg", &turned(1), more).skipped,
            [] as [&str; 0]
        );
    }
}
