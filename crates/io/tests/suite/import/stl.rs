//! STL, as text and as binary.

use super::{load, messages, scene};
use crate::support::effort;
use glam::{DVec3, Vec3};
use glimray::import;
use glimray::scene::Scene;
use insta::assert_snapshot;
use std::f64::consts::TAU;

type Facet = [[f32; 3]; 3];

/// A binary file with this free text, and an attribute for each facet.
fn binary(text: &[u8], facets: &[Facet], attribute: impl Fn(usize) -> u16) -> Vec<u8> {
    let mut bytes = text.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    for (i, facet) in facets.iter().enumerate() {
        bytes.extend([0; 12]);
        let numbers = facet.iter().flatten();
        numbers.for_each(|number| bytes.extend(number.to_le_bytes()));
        bytes.extend(attribute(i).to_le_bytes());
    }
    bytes
}

fn text(facets: &[Facet]) -> String {
    let facet = |facet: &Facet| {
        let corner = |[x, y, z]: &[f32; 3]| format!("      vertex {x:e} {y:e} {z:e}\n");
        let corners: String = facet.iter().map(corner).collect();
        format!("  facet normal 0 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    let facets: String = facets.iter().map(facet).collect();
    format!("solid a part\n{facets}endsolid a part\n")
}

/// The two triangles of a quadrilateral.
fn quad([a, b, c, d]: [[f32; 3]; 4]) -> [Facet; 2] {
    [[a, b, c], [a, c, d]]
}

/// A box from the origin to `size`, counter-clockwise seen from outside.
fn cuboid([x, y, z]: [f32; 3]) -> Vec<Facet> {
    let corner =
        |i: u8| [(1, x), (2, y), (4, z)].map(|(bit, side)| if i & bit == 0 { 0.0 } else { side });
    let sides = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    sides
        .into_iter()
        .flat_map(|side| quad(side.map(corner)))
        .collect()
}

/// A prism of radius 1 and height 2 along z. Its caps are fans around a corner, as CAD programs write them.
fn prism(sides: usize) -> Vec<Facet> {
    let corner = |i: usize, z: f32| {
        let (sin, cos) = (TAU * (i % sides) as f64 / sides as f64).sin_cos();
        [cos as f32, sin as f32, z]
    };
    let side = |i: usize| {
        quad([
            corner(i, 0.0),
            corner(i + 1, 0.0),
            corner(i + 1, 2.0),
            corner(i, 2.0),
        ])
    };
    let mut facets: Vec<Facet> = (0..sides).flat_map(side).collect();
    for i in 1..sides - 1 {
        facets.push([corner(0, 2.0), corner(i, 2.0), corner(i + 1, 2.0)]);
        facets.push([corner(0, 0.0), corner(i + 1, 0.0), corner(i, 0.0)]);
    }
    facets
}

/// The position and normal of each vertex.
fn vertices(scene: &Scene) -> impl Iterator<Item = (Vec3, Vec3)> {
    let mesh = &scene.meshes[0];
    mesh.positions
        .iter()
        .copied()
        .zip(mesh.normals.iter().copied())
}

#[test]
fn text_and_binary_files_give_the_same_mesh_and_it_stands() {
    let facets = cuboid([1.0, 2.0, 3.0]);
    let of_text = scene("a.stl", text(&facets));
    let of_binary = scene("a.stl", binary(b"", &facets, |_| 0));
    assert_eq!(of_text.meshes, of_binary.meshes);
    assert_eq!(of_text.triangle_count(), 12);
    // Three faces meet at right angles in each of eight corners.
    assert_eq!(of_text.meshes[0].positions.len(), 24);
    for (_, normal) in vertices(&of_text) {
        assert_eq!(normal.abs().max_element(), 1.0, "{normal}");
    }
    // +Z of the file points up, and the view is not mirrored: +Y of the file points away.
    let bounds = of_text.bounds().expect("bounds");
    assert_eq!(
        bounds,
        (DVec3::new(0.0, 0.0, -2.0), DVec3::new(1.0, 3.0, 0.0))
    );
    assert_eq!(of_text.skipped, [""; 0]);
}

#[test]
fn keywords_have_any_case_and_a_file_may_have_several_solids() {
    let one = text(&cuboid([1.0; 3]));
    let two = text(&cuboid([2.0; 3])).to_uppercase();
    let scene = scene("a.STL", format!("{one}\r\n{two}"));
    assert_eq!(scene.triangle_count(), 24);
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn a_binary_file_may_begin_with_solid() {
    let facets = cuboid([1.0; 3]);
    for text in [
        &b"solid"[..],
        b"solid facet normal",
        b"solid\n facet endsolid",
    ] {
        let scene = scene("a.stl", binary(text, &facets, |_| 0));
        assert_eq!(scene.triangle_count(), 12);
    }
}

#[test]
fn facets_are_smooth_below_thirty_degrees() {
    // The sides of a prism of n sides meet at 360°/n.
    for (sides, is_smooth) in [(64, true), (9, true), (7, false), (6, false)] {
        let scene = scene("a.stl", binary(b"", &prism(sides), |_| 0));
        for (position, normal) in vertices(&scene) {
            if normal.y.abs() > 0.5 {
                assert!(
                    (normal.y.abs() - 1.0).abs() < 1e-6,
                    "a cap stays flat: {normal}"
                );
                continue;
            }
            let radial = position.with_y(0.0).normalize();
            let cosine = f64::from(radial.dot(normal));
            let expected = if is_smooth {
                1.0
            } else {
                (TAU / sides as f64 / 2.0).cos()
            };
            assert!((cosine - expected).abs() < 1e-5, "{sides} sides: {cosine}");
        }
        let sides_of_vertices = if is_smooth { 1 } else { 2 };
        assert_eq!(
            scene.meshes[0].positions.len(),
            2 * sides * (1 + sides_of_vertices)
        );
    }
}

/// Linear from sRGB in 8 bits, IEC 61966-2-1.
fn linear(code: f64) -> f32 {
    let code = code / 255.0;
    (if code <= 0.04045 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }) as f32
}

#[test]
fn both_dialects_have_colours() {
    let facets = cuboid([1.0; 3]);
    // 31, 10 and 0 of 31 are 255, 82 and 0 of 255.
    let orange = Vec3::new(1.0, linear(82.0), 0.0);
    let of = |scene: &Scene, triangle: usize| {
        let mesh = &scene.meshes[0];
        let [a, b, c] = mesh.triangles[triangle].map(|i| mesh.materials[i as usize] as usize);
        assert!(a == b && b == c, "a facet has one colour");
        scene.materials[a].classical().diffuse
    };
    // VisCAM and SolidView: the mark, then red, green and blue; without the mark there is no colour.
    let viscam = scene(
        "a.stl",
        binary(b"", &facets, |i| {
            if i < 6 {
                0x8000 | 31 << 10 | 10 << 5
            } else {
                0
            }
        }),
    );
    assert_eq!((of(&viscam, 0), of(&viscam, 5)), (orange, orange));
    assert_eq!(of(&viscam, 6), Vec3::ONE);
    // Magics: blue, green and red; with the mark a facet has the colour of the whole part.
    let magics = scene(
        "a.stl",
        binary(b"x COLOR=\x40\x70\xff\xff", &facets, |i| {
            if i < 6 { 10 << 5 | 31 } else { 0x8000 }
        }),
    );
    assert_eq!((of(&magics, 0), of(&magics, 5)), (orange, orange));
    assert_eq!(of(&magics, 6), Vec3::new(linear(64.0), linear(112.0), 1.0));
    // Two colours, and the ground.
    assert_eq!(magics.materials.len(), 2 + 1);
    assert_eq!(magics.skipped, [""; 0]);
    let header =
        b"COLOR=\x40\x70\xff\xff,MATERIAL=\x40\x70\xff\xff\x40\x70\xff\xff\x40\x70\xff\xff";
    let scene = scene("a.stl", binary(header, &facets, |_| 0x8000));
    assert_eq!(scene.materials.len(), 1 + 1);
    assert_eq!(
        scene.skipped,
        ["the material in the header skipped: only its colour is read"]
    );
}

#[test]
fn facets_without_area_or_with_nan_are_reported() {
    let mut facets = cuboid([1.0; 3]);
    facets.push([[0.0; 3], [1.0; 3], [2.0; 3]]);
    facets.push([[0.0; 3], [0.0; 3], [1.0; 3]]);
    facets.push([[f32::NAN; 3], [1.0; 3], [2.0; 3]]);
    facets.push([[f32::INFINITY, 0.0, 0.0], [1.0; 3], [2.0; 3]]);
    let mut bytes = binary(b"", &facets, |_| 0);
    bytes.push(7);
    let scene = scene("a.stl", bytes);
    assert_eq!(scene.triangle_count(), 12);
    assert_snapshot!(scene.skipped.join("\n"), @r"
bytes after the last facet skipped: 1
facets with coordinates that are not finite skipped: 2
dropped 2 triangles without area
");
}

#[test]
fn a_wrong_number_of_facets_in_a_header_is_reported() {
    let facets = cuboid([1.0; 3]);
    for (announced, length, count) in [(u32::MAX, 684, 12), (12, 400, 6), (0, 684, 12)] {
        let mut bytes = binary(b"solid", &facets, |_| 0);
        bytes[80..84].copy_from_slice(&announced.to_le_bytes());
        let scene = scene("a.stl", &bytes[..length]);
        assert_eq!(scene.triangle_count(), count);
        let note = format!(
            "the header announces {announced} facets, but the file has {count}: it may be truncated"
        );
        assert_eq!(scene.skipped[0], note);
    }
}

#[test]
fn facets_of_text_that_cannot_be_used_are_skipped_and_reported() {
    let good = text(&cuboid([1.0; 3]));
    let mut facets: Vec<String> = good
        .split_inclusive("endfacet\n")
        .map(str::to_owned)
        .collect();
    facets[1] = facets[1]
        .replace("vertex", "vertex nan 0 0 #")
        .replace('#', "\nvertex");
    facets[2] = facets[2].replacen("endloop", "", 1);
    facets[3] = facets[3].replacen("facet normal", "facet abnormal", 1);
    facets[4] = facets[4].replacen("1e0", "-1.#IND", 1);
    let scene = scene("a.stl", facets.concat());
    assert_eq!(scene.triangle_count(), 8);
    assert_snapshot!(scene.skipped.join("\n"), @r"
`vertex`: values that are not finite numbers skipped: 3 (first in line 11)
`facet`: facets that are not whole triangles skipped: 3 (first in line 14)
");
}

#[test]
fn normals_that_contradict_their_facets_are_reported() {
    let facets = cuboid([1.0; 3]);
    let good = text(&facets).replace("facet normal 0 0 0", "facet normal 0 0 -5");
    let scene = scene("a.stl", good);
    assert_snapshot!(scene.skipped.join("\n"), @"normals that contradict the corners of their facets skipped: 10");
}

#[test]
fn every_error_has_a_message() {
    let facets = cuboid([1.0; 3]);
    let good = text(&facets);
    let mut big_endian = binary(b"", &facets, |_| 0);
    big_endian[80..84].reverse();
    let texts: Vec<Vec<u8>> = vec![
        vec![],
        b"Dear Sir or Madam".to_vec(),
        vec![0; 83],
        b"\x89PNG".repeat(100),
        big_endian,
        good.replace("facet normal", "facet abnormal").into(),
        good.replace("1e0", "one").into(),
        good.replace("1e0", "nan").into(),
        good.replace("endloop", "").into(),
        good[..good.len() / 2].into(),
        b"solid a\nfacet".to_vec(),
        b"solid a\nvertex 1 2 3".to_vec(),
        b"solid a\nendsolid a\nfacet".to_vec(),
    ];
    assert_snapshot!(messages("a.stl", &texts), @r"
bad model (a.stl): the file is empty. Check that it was written completely.
bad model (a.stl): it has 17 bytes: neither the text `solid` nor a binary header. Name an STL file.
bad model (a.stl): it has 83 bytes: neither the text `solid` nor a binary header. Name an STL file.
bad model (a.stl): its header announces 1196314761 facets, but it has room for 6. Check that it was written completely.
bad model (a.stl): its numbers are big-endian, but those of STL are little-endian. Save it again as binary STL.
bad model (a.stl:2:9): expected `normal`, found `abnormal`. Check that this is an STL file that was written completely.
bad model (a.stl:5:22): `one` is not a number. Write a decimal number such as -0.5 or 2e3.
bad model (a.stl:5:22): `nan` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad model (a.stl:8:3): expected `endloop`, found `endfacet`. Check that this is an STL file that was written completely.
no error
bad model (a.stl:2:6): the file ends where `normal` should be. Check that this is an STL file that was written completely.
bad model (a.stl:2:1): expected `facet` or `endsolid`, found `vertex`. Check that this is an STL file that was written completely.
bad model (a.stl:3:1): expected `solid`, found `facet`. Check that this is an STL file that was written completely.
");
}

#[test]
fn a_file_that_was_cut_anywhere_is_refused_or_reported() {
    let facets = prism(20);
    for whole in [
        binary(b"solid", &facets, |i| i as u16),
        text(&facets).into_bytes(),
    ] {
        for percent in 0..100 {
            let cut = &whole[..whole.len() * percent / 100];
            match effort::within(2_000.0, || load("a.stl", cut)) {
                Ok(scene) => assert!(!scene.skipped.is_empty(), "cut at {percent} %"),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
    }
}

#[test]
fn the_axis_that_points_up_can_be_chosen() {
    let files = |bytes| import::Memory::from_iter([("a.stl", bytes)]);
    let files = files(binary(b"", &cuboid([1.0, 2.0, 3.0]), |_| 0));
    for (up, height) in [
        (import::Axis::X, 1.0),
        (import::Axis::Y, 2.0),
        (import::Axis::Z, 3.0),
    ] {
        let options = import::Options {
            up: Some(up),
            ..import::Options::default()
        };
        let scene = import::load_from(&files, "a.stl", &options).expect("a scene");
        let (min, max) = scene.bounds().expect("bounds");
        assert_eq!((min.y, max.y), (0.0, height));
        // A rotation keeps the winding: the normal of a triangle agrees with that of its corners.
        let mesh = &scene.meshes[0];
        let [a, b, c] = mesh.triangles[0].map(|i| mesh.positions[i as usize]);
        let normal = mesh.normals[mesh.triangles[0][0] as usize];
        assert!((b - a).cross(c - a).normalize().dot(normal) > 0.99);
    }
}
