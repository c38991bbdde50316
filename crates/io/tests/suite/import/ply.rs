//! Stanford PLY files as scenes.

use super::{load, messages, scene};
use crate::support::effort;
use glam::{DVec3, Vec3};
use glimray::scene::{Geometry, Scene};
use insta::assert_snapshot;

/// A cube of six quads, from −1 to 1, in one of the encodings.
fn cube(encoding: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat {encoding} 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n\
         property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let side = |i: u32, bit: u32| if i & bit == 0 { -1.0_f32 } else { 1.0 };
    let vertices = (0..8).map(|i| [1, 2, 4].map(|bit| side(i, bit)));
    let faces: [[i32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    match encoding {
        "ascii" => {
            vertices.for_each(|[x, y, z]| bytes.extend(format!("{x} {y} {z}\n").bytes()));
            for [a, b, c, d] in faces {
                bytes.extend(format!("4 {a} {b} {c} {d}\n").bytes());
            }
        }
        _ => {
            let is_little = encoding == "binary_little_endian";
            let mut put = |mut number: [u8; 4]| {
                if !is_little {
                    number.reverse();
                }
                bytes.extend(number);
            };
            vertices
                .flatten()
                .for_each(|number| put(number.to_le_bytes()));
            for face in faces {
                // The count is one byte.
                bytes.push(4);
                for index in face {
                    let number = if is_little {
                        index.to_le_bytes()
                    } else {
                        index.to_be_bytes()
                    };
                    bytes.extend(number);
                }
            }
        }
    }
    bytes
}

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// A text file with these vertex properties after the position.
fn text(properties: &str, vertices: &[&str], faces: &[&str]) -> String {
    let properties: String = properties
        .split(", ")
        .filter(|p| !p.is_empty())
        .map(|p| format!("property {p}\n"))
        .collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{properties}\
         element face {}\nproperty list uchar int vertex_index\nend_header\n{}\n{}\n",
        vertices.len(),
        faces.len(),
        vertices.join("\n"),
        faces.join("\n")
    )
}

#[test]
fn a_cube_of_quads_is_the_same_in_every_encoding_and_keeps_its_edges() {
    let cubes = ENCODINGS.map(|encoding| scene("a.ply", cube(encoding)));
    for scene in &cubes {
        assert_eq!(scene.triangle_count(), 12);
        assert_eq!(scene.meshes, cubes[0].meshes);
        assert_eq!(scene.bounds(), Some((DVec3::splat(-1.0), DVec3::ONE)));
        assert_eq!(scene.skipped, [""; 0]);
        let mesh = &scene.meshes[0];
        assert_eq!(mesh.positions.len(), 24);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let normal = (b - a).cross(c - a).normalize();
            assert!(
                triangle
                    .iter()
                    .all(|&i| mesh.normals[i as usize].dot(normal) > 0.9999)
            );
            assert!((a + b + c).dot(normal) > 0.0, "faces look outwards");
        }
    }
}

#[test]
fn normals_in_the_file_are_kept_and_unused_vertices_dropped() {
    let file = text(
        "float nx, float ny, float nz",
        &["9 9 9 0 0 1", "0 0 0 0 3 4", "1 0 0 0 0 1", "0 1 0 0 0 1"],
        &["3 1 2 3"],
    );
    let scene = scene("a.ply", file);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(mesh.normals, [Vec3::new(0.0, 0.6, 0.8), Vec3::Z, Vec3::Z]);
}

fn colors(scene: &Scene) -> Vec<Vec3> {
    let mesh = &scene.meshes[0];
    assert_eq!(scene.materials[0].classical().diffuse, Vec3::ONE);
    mesh.colors.iter().map(|color| color.truncate()).collect()
}

#[test]
fn vertices_have_their_colours() {
    // 188 of 255 in sRGB is 0.5029 in linear light (IEC 61966-2-1).
    let expected = [Vec3::X, Vec3::splat(0.5029), Vec3::Z];
    for (properties, vertices) in [
        (
            "uchar red, uchar green, uchar blue",
            ["0 0 0 255 0 0", "1 0 0 188 188 188", "0 1 0 0 0 255"],
        ),
        (
            "float red, float green, float blue",
            ["0 0 0 1 0 0", "1 0 0 0.7373 0.7373 0.7373", "0 1 0 0 0 1"],
        ),
        (
            "ushort diffuse_red, ushort diffuse_green, ushort diffuse_blue",
            [
                "0 0 0 65535 0 0",
                "1 0 0 48316 48316 48316",
                "0 1 0 0 0 65535",
            ],
        ),
    ] {
        let scene = scene("a.ply", text(properties, &vertices, &["3 0 1 2"]));
        for (color, expected) in colors(&scene).into_iter().zip(expected) {
            assert!(
                (color - expected).abs().max_element() < 1e-4,
                "{properties}: {color}"
            );
        }
        assert_eq!(scene.skipped, [""; 0]);
    }
}

#[test]
fn of_too_many_colours_of_points_the_upper_bits_are_kept() {
    // 64 × 64 × 64 colours in steps of four.
    let vertices: Vec<String> = (0..1 << 18)
        .map(|i| {
            format!(
                "{i} 0 {} {} {} {}",
                i % 7,
                i % 64 * 4,
                i / 64 % 64 * 4,
                i / 4096 * 4
            )
        })
        .collect();
    let vertices: Vec<&str> = vertices.iter().map(String::as_str).collect();
    let scene = scene(
        "a.ply",
        text("uchar red, uchar green, uchar blue", &vertices, &[]),
    );
    // The materials of the points, and of the ground.
    assert_eq!(scene.materials.len(), 32 * 32 * 32 + 1);
    let note = "colours of points reduced to 5 bits a channel: there are too many";
    assert!(
        scene.skipped.contains(&note.to_owned()),
        "{:?}",
        scene.skipped
    );
}

#[test]
fn strips_alternate_their_winding() {
    let file = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2\n";
    let scene = scene("a.ply", file);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [2, 3, 4], [0, 1, 2]]);
    assert_eq!(mesh.normals, [Vec3::Z; 5]);
}

#[test]
fn points_without_faces_are_spheres() {
    let sphere = |scene: &Scene, index: usize| match scene.shapes[index].geometry {
        Geometry::Sphere { center, radius } => (
            center,
            radius,
            scene.materials[scene.shapes[index].material]
                .classical()
                .diffuse,
        ),
        _ => panic!("a point is a sphere"),
    };
    // The diagonal is 5, and half of it over the root of four points is 1.25.
    let file = text(
        "uchar red, uchar green, uchar blue",
        &[
            "0 0 0 255 0 0",
            "3 0 0 0 255 0",
            "0 4 0 0 0 255",
            "3 4 0 0 0 0",
            "nan 0 0 9 9 9",
        ],
        &[],
    );
    let cloud = scene("a.ply", file);
    // The last shape is the ground.
    assert_eq!(cloud.shapes.len(), 5);
    assert_eq!(sphere(&cloud, 0), (DVec3::ZERO, 1.25, Vec3::X));
    assert_eq!(
        sphere(&cloud, 2),
        (DVec3::new(0.0, 4.0, 0.0), 1.25, Vec3::Z)
    );
    assert_eq!(
        cloud.skipped,
        ["points with coordinates that are not finite skipped: 1"]
    );
    let cloud = scene(
        "a.ply",
        text("float radius", &["0 0 0 0.5", "3 0 0 0"], &[]),
    );
    assert_eq!(sphere(&cloud, 0).1, 0.5);
    assert_eq!(sphere(&cloud, 1).1, 1.5 / 2.0_f64.sqrt());
}

#[test]
fn texture_coordinates_that_are_not_numbers_are_zero_and_reported() {
    let file = text(
        "float s, float t, float s2, float t2",
        &[
            "0 0 0 nan 0.5 0.25 nan",
            "1 0 0 nan nan inf -inf",
            "0 1 0 0.5 1 0 0",
        ],
        &["3 0 1 2"],
    );
    let scene = scene("a.ply", file);
    let mesh = &scene.meshes[0];
    let rows = |uvs: &[glam::Vec2]| -> Vec<_> { uvs.iter().map(|uv| uv.to_array()).collect() };
    assert_eq!(rows(&mesh.uvs), [[0.0, 0.5], [0.0, 0.0], [0.5, 1.0]]);
    assert_eq!(
        rows(&mesh.second_uvs),
        [[0.25, 0.0], [1e9, -1e9], [0.0, 0.0]]
    );
    assert_eq!(
        scene.skipped,
        ["texture coordinates that are not numbers, set to 0: 4"]
    );
}

#[test]
fn what_is_skipped_is_named() {
    let file = "ply\nformat ascii 1.0\ncomment TextureFile wood grain.png\nelement vertex 4\nproperty float x\n\
        property float y\nproperty float z\nproperty float confidence\nproperty uchar alpha\nelement face 4\n\
        property list uchar int vertex_indices\nproperty uchar red\nelement edge 1\nproperty int vertex1\n\
        end_header\n0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n3 0 1 2 0\n2 0 1 0\n3 0 0 1 0\n4 0 2 1 3 0\n7\n";
    assert_snapshot!(scene("a.ply", file).skipped.join("\n"), @r"
vertex properties skipped: confidence, alpha
face properties skipped: red
elements `edge` skipped: 1
texture skipped: `wood grain.png`
faces with fewer than three corners skipped: 1
dropped 1 triangle without area
");
}

#[test]
fn every_error_has_a_message() {
    let good = String::from_utf8(cube("ascii")).expect("text");
    let mut swapped = cube("binary_big_endian");
    let header = swapped
        .windows(10)
        .position(|w| w == b"big_endian")
        .expect("a header");
    swapped.splice(header..header + 10, *b"little_endian");
    let texts: Vec<Vec<u8>> = vec![
        vec![],
        b"solid".to_vec(),
        b"ply\n".to_vec(),
        swapped,
        good.replace("vertex 8", "vertex 4000000000").into(),
        good.replace("vertex 8", "vertex 99999999999999999999")
            .into(),
        good.replace("4 0 4 6 2", "255 0 4 6 2").into(),
        good.replace("property float z\n", "").into(),
        good.replace(
            "property list uchar int vertex_indices",
            "property int vertex_indices",
        )
        .into(),
        good.replace("element face", "element vertex 0\nelement face")
            .into(),
    ];
    assert_snapshot!(messages("a.ply", &texts), @r"
bad mesh (a.ply): it does not begin with `ply`. Name a PLY file.
bad mesh (a.ply): it does not begin with `ply`. Name a PLY file.
bad mesh (a.ply): its header does not end with `end_header`. Save the file again.
bad mesh (a.ply): a face has vertex 67108864, but only 8 exist. Save the file again.
bad mesh (a.ply): it is shorter than its header announces. Check that it was written completely.
bad mesh (a.ply): line 4 of its header is `element vertex 99999999999999999…`. Save the file again.
bad mesh (a.ply): it is shorter than its header announces. Check that it was written completely.
bad mesh (a.ply): its vertices lack x, y or z. Save the file again.
bad mesh (a.ply): its faces have no list `vertex_indices`. Save the file again.
bad mesh (a.ply): its header has the element `vertex` twice. Save the file again.
");
}

#[test]
fn a_file_that_was_cut_anywhere_is_refused_or_reported() {
    for encoding in ENCODINGS {
        let whole = cube(encoding);
        for percent in 0..100 {
            let cut = &whole[..whole.len() * percent / 100];
            match effort::within(2_000.0, || load("a.ply", cut)) {
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
                // Without its last digit a text is a complete file.
                Ok(scene) => assert!(
                    scene.triangle_count() < 12 && !scene.skipped.is_empty()
                        || encoding == "ascii" && cut.len() + 3 > whole.len(),
                    "{encoding} at {percent} %: {:?}",
                    scene.skipped
                ),
            }
        }
    }
}

#[test]
fn faces_at_vertices_that_cannot_be_used_are_skipped_and_reported() {
    let good = String::from_utf8(cube("ascii")).expect("text");
    let changed = good.replace("1 1 1", "1 -nan(ind) 1");
    let changed = changed.replace("4 0 4 6 2", "4 0 4 6 8");
    let scene = scene("a.ply", changed);
    // A corner of a cube is part of three of its six faces.
    assert_eq!(scene.triangle_count(), 4);
    assert_eq!(scene.meshes[0].positions.len(), 8);
    assert!(scene.meshes[0].positions.iter().all(|p| p.is_finite()));
    assert_snapshot!(scene.skipped.join("\n"), @"vertices with coordinates that are not finite skipped with their faces: 2");
}
