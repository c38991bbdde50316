//! Text files as programs of all ages write them: line ends, byte order marks, padding and encodings.

use super::{folder, load, message_in, scene};
use glam::Vec3;
use glimray::import::{self, Options};

const OBJ: &str = "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
    endloop\nendfacet\nendsolid a\n";
const NFF: &str = "# a comment\nv\nfrom 0 -5 1\nat 0 0 1\nup 0 0 1\nangle 45\nhither 0.01\nresolution 320 200\n\
    f 1 0.5 0.25 0.8 0.5 30 0 0\ns 0 0 0 1 # another\n";
const COURSE: &str = "1 # a comment\namb: 0 0 0\nsphere // another\npos: 0 0 -3\nrad: 1\ndif: 1 1 1\nspe: 0 0 0\nshi: 1\n";
const NATIVE: &str = "# a comment\nambient = [1, 1, 1] # another\n[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

const FILES: [(&str, &str); 6] = [
    ("a.obj", OBJ),
    ("a.ply", PLY),
    ("a.stl", STL),
    ("a.nff", NFF),
    ("a.scene", COURSE),
    ("a.toml", NATIVE),
];

#[test]
fn every_text_format_reads_all_line_ends_marks_and_padding() {
    for (name, text) in FILES {
        let expected = scene(name, text);
        let units = |encode: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(encode);
        let variants: [(&str, Vec<u8>); 8] = [
            ("carriage returns", text.replace('\n', "\r").into()),
            ("both", text.replace('\n', "\r\n").into()),
            ("a mark", format!("\u{feff}{text}").into()),
            (
                "a mark and carriage returns",
                format!("\u{feff}{text}").replace('\n', "\r").into(),
            ),
            ("zero bytes", format!("{text}\0\0\0\0\0").into()),
            ("the end mark of DOS", format!("{text}\x1a").into()),
            (
                "UTF-16",
                [0xff, 0xfe]
                    .into_iter()
                    .chain(units(u16::to_le_bytes))
                    .collect(),
            ),
            (
                "UTF-16, big end first",
                [0xfe, 0xff]
                    .into_iter()
                    .chain(units(u16::to_be_bytes))
                    .collect(),
            ),
        ];
        for (what, bytes) in variants {
            let found = load(name, bytes);
            let found = found.unwrap_or_else(|error| panic!("{name} with {what}: {error}"));
            assert_eq!(found, expected, "{name} with {what}");
        }
    }
}

#[test]
fn binary_ply_files_may_have_carriage_returns_in_their_header() {
    // The first byte of the body is a line feed: 10 in the lowest bits of a float.
    let x = f32::from_bits(0x3f80_000a);
    let mut body = Vec::new();
    for number in [x, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0] {
        body.extend(number.to_le_bytes());
    }
    body.push(3);
    [0_i32, 1, 2]
        .iter()
        .for_each(|i| body.extend(i.to_le_bytes()));
    assert_eq!(body[0], b'\n');
    let header = PLY.split_once("0 0 0\n").expect("a body").0;
    let header = header.replace("ascii", "binary_little_endian");
    let file = |newline: &str| {
        let mut bytes = header.replace('\n', newline).into_bytes();
        bytes.extend(&body);
        scene("a.ply", bytes)
    };
    let expected = file("\n");
    assert_eq!(expected.triangle_count(), 1);
    assert!(expected.meshes[0].positions.iter().any(|p| p.x == x));
    assert_eq!(file("\r"), expected);
    assert_eq!(file("\r\n"), expected);
}

#[test]
fn lines_keep_their_numbers() {
    for newline in ["\n", "\r", "\r\n"] {
        for mark in ["", "\u{feff}"] {
            let text =
                format!("{mark}v 0 0 0\nv 1 0 0\n\nv 0 1 x\nf 1 2 3\n").replace('\n', newline);
            let folder = folder(&[("a.obj", text.as_bytes())]);
            let message = message_in(&folder, "a.obj", &Options::default());
            assert!(
                message.starts_with("bad model (a.obj:4:7): `x`"),
                "{message}"
            );
        }
    }
}

#[test]
fn names_may_be_in_latin_1() {
    // One file in Latin-1, the other in UTF-8; a picture named in Latin-1.
    let model = b"mtllib gr\xfcn.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Gr\xfcn\nf 1 2 3\n";
    for library in [
        &b"newmtl Gr\xfcn\nKd 1 0 0\nmap_Ke gr\xfcn.png\n"[..],
        "newmtl Gr\u{fc}n\nKd 1 0 0\nmap_Ke gr\u{fc}n.png\n".as_bytes(),
    ] {
        let folder = folder(&[
            ("a.obj", model),
            ("gr\u{fc}n.mtl", library),
            ("gr\u{fc}n.png", &super::textures::png()),
        ]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        let material = &scene.materials[0];
        assert_eq!(
            (&*material.name, material.classical().diffuse),
            ("Gr\u{fc}n", Vec3::X)
        );
        assert_eq!(material.textures.emission, Some(0));
    }
    for (name, text) in &FILES[..5] {
        let Some((first, rest)) = text.split_once("a comment") else {
            continue;
        };
        let bytes = [first.as_bytes(), b"f\xfcr alle", rest.as_bytes()].concat();
        assert_eq!(load(name, bytes).expect("a scene"), scene(name, text));
    }
}
