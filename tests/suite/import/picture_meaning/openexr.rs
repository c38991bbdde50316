//! OpenEXR: alpha, windows, layers and chromaticities.

use super::{assert_near, texels, with_background, with_texture};
use crate::support::program::Workspace;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};
use glam::{DVec3, Vec3, Vec4};
use glimray::import::{self, Memory, Options};
use half::f16;
use std::io::Cursor;

/// How an OpenEXR file is written.
#[derive(Clone)]
pub struct Exr {
    /// Size of the display window, which begins at (0, 0).
    pub size: [usize; 2],
    /// The corner and the size of the data window.
    pub data: ([i32; 2], [usize; 2]),
    pub prefix: &'static str,
    pub is_half: bool,
    pub encoding: Encoding,
    pub chromaticities: Option<[f32; 8]>,
}

impl Exr {
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            size: [width, height],
            data: ([0, 0], [width, height]),
            prefix: "",
            is_half: false,
            encoding: Encoding::UNCOMPRESSED,
            chromaticities: None,
        }
    }

    /// The layer of a file with these channels, each the same number in all pixels or one for each.
    fn layer(&self, channels: &[(&str, Vec<f32>)]) -> Layer<AnyChannels<FlatSamples>> {
        let (corner, size) = self.data;
        let stored = |values: &Vec<f32>| {
            let values = values.iter().cycle().take(size[0] * size[1]);
            match self.is_half {
                true => FlatSamples::F16(values.map(|v| f16::from_f32(*v)).collect()),
                false => FlatSamples::F32(values.copied().collect()),
            }
        };
        let channels: Vec<_> = (channels.iter())
            .map(|(name, values)| {
                AnyChannel::new(format!("{}{name}", self.prefix).as_str(), stored(values))
            })
            .collect();
        let attributes = LayerAttributes {
            layer_position: Vec2(corner[0], corner[1]),
            layer_name: Some(Text::from("part")),
            ..LayerAttributes::default()
        };
        let channels = AnyChannels::sort(channels.into());
        Layer::new(Vec2(size[0], size[1]), attributes, self.encoding, channels)
    }

    fn file(&self, layers: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
        let window = IntegerBounds::from_dimensions(Vec2(self.size[0], self.size[1]));
        let point = |it: &[f32; 8], at: usize| Vec2(it[2 * at], it[2 * at + 1]);
        let attributes = ImageAttributes {
            chromaticities: (self.chromaticities.as_ref()).map(|it| Chromaticities {
                red: point(it, 0),
                green: point(it, 1),
                blue: point(it, 2),
                white: point(it, 3),
            }),
            ..ImageAttributes::new(window)
        };
        let mut bytes = Cursor::new(Vec::new());
        let image = Image::from_layers(attributes, layers);
        (image.write().non_parallel().to_buffered(&mut bytes)).expect("a picture");
        bytes.into_inner()
    }

    pub fn of(&self, channels: &[(&str, Vec<f32>)]) -> Vec<u8> {
        self.file(vec![self.layer(channels)])
    }

    /// A file of red, green, blue, and alpha if `color` has it.
    pub fn colored(&self, color: &[f32]) -> Vec<u8> {
        let channels = ["R", "G", "B", "A"].into_iter().zip(color);
        let channels: Vec<_> = channels.map(|(name, value)| (name, vec![*value])).collect();
        self.of(&channels)
    }
}

const PAINT: &str = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n\
                     vt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
const MATERIAL: &str = "newmtl m\nKd 1 1 1\nillum 0\nmap_Kd a.exr\nmap_d a.exr\n";

/// Colours of OpenEXR are multiplied by alpha. So a texture has them divided by it, a mask has the alpha, and light
/// around a scene is what it is.
#[test]
fn alpha_of_openexr_is_used_once_whatever_its_encoding() {
    let color = [0.4, 0.2, 0.1, 0.5];
    let plain = Exr::new(16, 8);
    let mut kinds = vec![plain.clone()];
    for compression in [
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ] {
        for (blocks, line_order) in [
            (Blocks::ScanLines, LineOrder::Increasing),
            (Blocks::ScanLines, LineOrder::Decreasing),
            (Blocks::Tiles(Vec2(4, 4)), LineOrder::Increasing),
        ] {
            for (is_half, prefix) in [(false, ""), (true, "Combined.")] {
                kinds.push(Exr {
                    encoding: Encoding {
                        compression,
                        blocks,
                        line_order,
                    },
                    is_half,
                    prefix,
                    ..plain.clone()
                });
            }
        }
    }
    for kind in kinds {
        let file = kind.colored(&color);
        let files = Memory::from_iter([
            ("a.obj", PAINT.as_bytes()),
            ("a.mtl", MATERIAL.as_bytes()),
            ("a.exr", &file),
        ]);
        let scene = import::load_from(&files, "a.obj", &Options::default()).expect("a model");
        let pictures = scene.pictures.iter().take(2);
        let firsts: Vec<Vec4> = pictures.map(|picture| texels(picture)[77]).collect();
        assert_near(firsts[0], [0.8, 0.4, 0.2, 0.5], 1e-3);
        assert_near(firsts[1], [1.0, 1.0, 1.0, 0.5], 0.0);
        let around = with_background("a.exr", &file);
        assert_near(texels(&around.pictures[0])[77], [0.4, 0.2, 0.1, 0.5], 1e-4);
        // Numbers are no colours.
        let numbers = with_texture("a.exr", &file, ", linear = true");
        assert_near(texels(&numbers.pictures[0])[77], [0.4, 0.2, 0.1, 0.5], 1e-4);
        let told = numbers.skipped.join("\n");
        let layer = "`a.exr` has no nameless layer: the layer `Combined` is shown";
        assert_eq!(told == layer, !kind.prefix.is_empty(), "{told}");
    }
}

/// Porter and Duff (1984): a colour that was multiplied by alpha, over white, is that colour plus 1 − alpha.
#[test]
fn a_texture_with_alpha_is_composed_over_what_is_behind() {
    let workspace = Workspace::new();
    workspace.write("a.obj", PAINT);
    workspace.write("a.mtl", MATERIAL);
    workspace.write("a.exr", Exr::new(8, 8).colored(&[0.4, 0.2, 0.1, 0.5]));
    let run = workspace.run(
        "render a.obj --bare --background 1,1,1 --look-from 0,0,5 --look-at 0,0,0 --orthographic 1 \
         --size 4x4 --integrator whitted --tone none --exposure 0 -o o.exr",
    );
    run.expect(0);
    let picture = image::open(workspace.path("o.exr")).expect("a picture");
    for pixel in picture.into_rgb32f().pixels() {
        let off = Vec3::from(pixel.0) - Vec3::new(0.9, 0.7, 0.6);
        assert!(off.abs().max_element() < 1e-3, "{pixel:?}");
    }
}

/// Without alpha there is no colour to interpolate with. An edge keeps the colour beside it.
#[test]
fn texels_without_alpha_take_the_colors_around_them() {
    let three = |edge: f32, middle: f32| vec![edge, middle, 0.0, 0.0];
    let file = Exr::new(4, 1).of(&[
        ("R", three(0.8, 0.4)),
        ("G", three(0.4, 0.2)),
        ("B", three(0.2, 0.1)),
        ("A", three(1.0, 0.5)),
    ]);
    let read = texels(&with_texture("a.exr", &file, "").pictures[0]);
    for (texel, alpha) in read.iter().zip([1.0, 0.5, 0.0]) {
        assert_near(*texel, [0.8, 0.4, 0.2, alpha], 1e-6);
    }
    assert_eq!(read[3], Vec4::ZERO, "out of reach of any colour");
    // Light that is added has no alpha, and stays.
    let glow = Exr::new(1, 1).colored(&[2.0, 1.0, 0.5, 0.0]);
    let read = texels(&with_texture("a.exr", &glow, "").pictures[0]);
    assert_near(read[0], [2.0, 1.0, 0.5, 0.0], 0.0);
}

#[test]
fn the_picture_of_an_openexr_file_is_its_display_window() {
    let inner = Exr {
        data: ([2, 1], [3, 2]),
        ..Exr::new(8, 4)
    };
    let beyond = Exr {
        data: ([-2, -1], [12, 6]),
        ..Exr::new(8, 4)
    };
    let numbers = |count: usize| (1..=count).map(|i| i as f32).collect::<Vec<_>>();
    for (window, alpha) in [(&inner, false), (&inner, true), (&beyond, false)] {
        let ([left, top], [width, height]) = window.data;
        let values = numbers(width * height);
        let mut channels = ["R", "G", "B"].map(|name| (name, values.clone())).to_vec();
        if alpha {
            channels.push(("A", vec![1.0]));
        }
        let scene = with_background("a.exr", &window.of(&channels));
        let picture = &scene.pictures[0];
        assert_eq!((picture.width, picture.height), (8, 4));
        for (index, texel) in picture.linear().enumerate() {
            let (x, y) = ((index % 8) as i32 - left, (index / 8) as i32 - top);
            let is_inside = x >= 0 && y >= 0 && x < width as i32 && y < height as i32;
            let value = match is_inside {
                true => values[y as usize * width + x as usize],
                false => 0.0,
            };
            assert_eq!(texel.truncate(), Vec3::splat(value), "{index}");
        }
    }
}

/// The channels that are shown, and those that are no picture.
#[test]
fn single_channels_and_later_parts_are_pictures() {
    let one = Exr::new(2, 1);
    let two = vec![0.25, 3.0];
    let first = |name: &str, file: &[u8]| {
        let scene = with_texture(name, file, "");
        texels(&scene.pictures[0])[0]
    };
    for name in ["Y", "Z", "R", "roughness", "depth.Z"] {
        let read = first("a.exr", &one.of(&[(name, two.clone())]));
        assert_near(read, [0.25, 0.25, 0.25, 1.0], 0.0);
    }
    let grey = one.of(&[("Y", two.clone()), ("A", vec![0.5])]);
    assert_near(first("a.exr", &grey), [0.5, 0.5, 0.5, 0.5], 0.0);
    // A vector, colour differences, and another layer's alpha.
    let layered = one.of(&[
        ("normal.X", vec![0.1]),
        ("normal.Y", vec![0.2]),
        ("normal.Z", vec![0.3]),
        ("A", vec![0.5]),
        ("x.R", vec![0.4]),
        ("x.G", vec![0.6]),
        ("x.B", vec![0.8]),
    ]);
    assert_near(first("a.exr", &layered), [0.4, 0.6, 0.8, 1.0], 0.0);
    // The picture is in the second part; the first has the same channel among others.
    let part = |name: &str, channels: &[(&str, Vec<f32>)]| {
        let mut layer = one.layer(channels);
        layer.attributes.layer_name = Some(Text::from(name));
        layer
    };
    let vector = ["X", "Y", "Z"].map(|name| (name, vec![9.0]));
    let parts = vec![part("normal", &vector), part("beauty", &[("Y", two)])];
    let read = first("a.exr", &one.file(parts));
    assert_near(read, [0.25, 0.25, 0.25, 1.0], 0.0);
}

/// Red, green, blue and white of Rec. 2020 and of ACES 2065-1 (SMPTE ST 2065-1).
pub const REC2020: [f32; 8] = [0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.329];
const ACES: [f32; 8] = [0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767];

#[test]
fn colors_are_converted_from_the_chromaticities_of_their_file() {
    let read = |chromaticities, color: [f32; 3]| {
        let kind = Exr {
            chromaticities: Some(chromaticities),
            ..Exr::new(2, 1)
        };
        let file = kind.colored(&color);
        let texture = with_texture("a.exr", &file, "");
        let around = with_background("a.exr", &file);
        let [texture_texel, around_texel] =
            [&texture, &around].map(|scene| texels(&scene.pictures[0])[0].truncate());
        assert_eq!(texture_texel, around_texel);
        assert_eq!(texture.skipped, around.skipped);
        (texture_texel, texture.skipped)
    };
    let near = |found: Vec3, expected: [f32; 3]| {
        let off = (found - Vec3::from(expected)).abs().max_element();
        assert!(off < 1e-3, "{found}, not {expected:?}");
    };
    // ITU-R BT.2087: the red of Rec. 2020 is (1.6605, −0.1246, −0.0182) in Rec. 709.
    let (red, notes) = read(REC2020, [1.0, 0.0, 0.0]);
    near(red, [1.6605, 0.0, 0.0]);
    assert_eq!(
        notes,
        ["all 2 texels of `a.exr` were outside of the gamut of Rec. 709 and cut to it"]
    );
    for chromaticities in [REC2020, ACES] {
        let (white, notes) = read(chromaticities, [0.5; 3]);
        near(white, [0.5; 3]);
        assert_eq!(notes, [] as [&str; 0]);
    }
    // The matrix that OpenColorIO has for ACES 2065-1, adapted by Bradford's method.
    let aces = DVec3::new(0.3, 0.4, 0.35);
    let rows = [
        DVec3::new(2.521_686, -1.134_131, -0.387_555),
        DVec3::new(-0.276_480, 1.372_719, -0.096_239),
        DVec3::new(-0.015_378, -0.152_975, 1.168_353),
    ];
    let (color, _) = read(ACES, aces.as_vec3().to_array());
    near(color, rows.map(|row| row.dot(aces) as f32));
    let (color, notes) = read([0.0; 8], [0.25, 0.5, 1.0]);
    near(color, [0.25, 0.5, 1.0]);
    let note =
        "`a.exr` has chromaticities that are no colour space: Rec. 709 is assumed".to_owned();
    assert_eq!(notes, [note]);
}
