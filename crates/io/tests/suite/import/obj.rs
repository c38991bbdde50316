//! Wavefront OBJ and MTL.

use super::{folder, messages, scene};
use glam::Vec3;
use glimray::import;
use glimray::scene::{Background, Coverage, Material, Mesh, Scene};
use insta::assert_snapshot;

/// The total area of all triangles.
fn area(scene: &Scene) -> f32 {
    let mesh = &scene.meshes[0];
    let corner = |i: u32| mesh.positions[i as usize];
    let area = |t: &[u32; 3]| {
        (corner(t[1]) - corner(t[0]))
            .cross(corner(t[2]) - corner(t[0]))
            .length()
            / 2.0
    };
    mesh.triangles.iter().map(area).sum()
}

/// A model with a material library beside it.
fn with_library(model: &str, library: &[u8]) -> Scene {
    let folder = folder(&[("a.obj", model.as_bytes()), ("a.mtl", library)]);
    import::load(&folder.path().join("a.obj")).unwrap_or_else(|error| panic!("{error}"))
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn a_model_alone_is_framed_and_lit() {
    let scene = scene("a.obj", format!("{SQUARE}f 1 2 3 4"));
    assert_eq!(scene.triangle_count(), 2);
    assert_eq!(scene.meshes[0].name, "a");
    assert!(scene.lights.len() >= 2);
    assert!(scene.staged, "these lights are not the file's");
    assert_ne!(scene.background, Background::Color(Vec3::ZERO));
    assert_eq!(scene.materials[0], Material::default());
}

#[test]
fn corners_may_be_written_in_every_way() {
    let rest = "vt 0 0\nvn 0 0 1\n";
    let plain = scene("a.obj", format!("{SQUARE}{rest}f 1 2 3"));
    for face in [
        "1/1 2/1 3/1",
        "1//1 2//1 3//1",
        "1/1/1 2/1/1 3/1/1",
        "-4 -3 -2",
        "1/ 2/ 3/",
        "1 \\\n2 \\\r\n 3",
        "1//-1 2//-1 3//-1 # why not",
    ] {
        let scene = scene("a.obj", format!("{SQUARE}{rest}f {face}\r\n"));
        let mut mesh = Mesh::clone(&scene.meshes[0]);
        let uvs = std::mem::take(&mut mesh.uvs);
        assert_eq!(mesh, *plain.meshes[0], "{face:?}");
        let has_uvs = ["1/1", "1/1/1"].contains(&face.split(' ').next().expect("a corner"));
        assert_eq!(uvs.len(), if has_uvs { 3 } else { 0 }, "{face:?}");
    }
}

#[test]
fn concave_polygons_are_triangulated_inside() {
    // An arrowhead, and a comb of five teeth, in a plane that is not a coordinate plane.
    let arrow = "v 0 0 0\nv 2 0 2\nv 0.5 0.5 0.5\nv 0 2 0\nf 1 2 3 4\n";
    let area_of_arrow = 2.0 * 0.5 * 2_f32.sqrt();
    assert!((area(&scene("a.obj", arrow)) - area_of_arrow).abs() < 1e-6);

    let mut comb = String::new();
    let mut face = String::from("f");
    for tooth in 0..5 {
        for (x, y) in [(0, 0), (0, 9), (1, 9), (1, 0)] {
            comb += &format!("v {} {y} 1\n", 2 * tooth + x);
        }
    }
    comb += "v 9 -1 1\nv 0 -1 1\n";
    (1..=22).for_each(|i| face += &format!(" {i}"));
    let scene = scene("a.obj", comb + &face);
    assert_eq!(scene.triangle_count(), 20);
    assert!(
        (area(&scene) - (5.0 * 9.0 + 9.0)).abs() < 1e-4,
        "{}",
        area(&scene)
    );
}

#[test]
fn faces_of_many_corners_may_be_concave() {
    let mut text = String::new();
    let mut face = String::from("f");
    const COUNT: usize = 2000;
    for i in 0..COUNT {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / COUNT as f64).sin_cos();
        let radius = if i % 2 == 0 { 1.0 } else { 0.5 };
        text += &format!("v {} {} 1\n", radius * cos, radius * sin);
        face += &format!(" {}", i + 1);
    }
    let scene = scene("a.obj", text + &face);
    // Pairs of triangles from the centre, with sides 1 and 1/2.
    let expected = 0.25 * COUNT as f64 * (std::f64::consts::TAU / COUNT as f64).sin();
    assert!((f64::from(area(&scene)) - expected).abs() < 1e-4);
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn self_intersecting_faces_become_fans_and_are_reported() {
    let text = "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n";
    let scene = scene("a.obj", text);
    assert_eq!(scene.triangle_count(), 2);
    let note = "faces that intersect themselves or are too large, triangulated as fans: 1";
    assert_eq!(scene.skipped, [note]);
}

/// The distinct normals of the vertices at `place`.
fn normals_at(scene: &Scene, place: Vec3) -> Vec<Vec3> {
    let mesh = &scene.meshes[0];
    let mut found: Vec<Vec3> = Vec::new();
    for (&position, &normal) in mesh.positions.iter().zip(&mesh.normals) {
        if position == place && !found.iter().any(|n| n.distance(normal) < 1e-6) {
            found.push(normal);
        }
    }
    found
}

/// The sides and ends of a prism of height 1 over a regular polygon of radius 1.
fn prism(sides: usize) -> String {
    let mut text = String::new();
    for y in 0..2 {
        for i in 0..sides {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / sides as f64).sin_cos();
            text += &format!("v {cos} {y} {}\n", -sin);
        }
    }
    for i in 1..=sides {
        let next = i % sides + 1;
        text += &format!("f {i} {next} {} {}\n", sides + next, sides + i);
    }
    let top: String = (sides + 1..=2 * sides).map(|i| format!(" {i}")).collect();
    let bottom: String = (1..=sides).rev().map(|i| format!(" {i}")).collect();
    text + &format!("f{top}\nf{bottom}\n")
}

#[test]
fn faces_without_normals_are_flat_unless_smoothed() {
    let roof = "v 0 1 0\nv 0 1 1\nv -1 0 0\nv -1 0 1\nv 1 0 0\nv 1 0 1\n";
    for smoothing in ["", "s off\n", "s 0\n", "s\n", "s 1\ns off\n"] {
        let text = format!("{roof}{smoothing}f 1 3 4 2\nf 2 6 5 1\n");
        let scene = scene("a.obj", text);
        let half = 0.5_f32.sqrt();
        let is_flat = |n: &Vec3| n.distance(Vec3::new(n.x.signum() * half, half, 0.0)) < 1e-6;
        assert!(scene.meshes[0].normals.iter().all(is_flat), "{smoothing:?}");
    }
}

#[test]
fn models_without_any_smoothing_group_are_smooth_up_to_sixty_degrees() {
    // The sides of prisms of 7 and of 5 meet at 51.4° and at 72°.
    for (sides, is_smooth) in [(7, true), (5, false)] {
        let scene = scene("a.obj", prism(sides));
        let positions = &scene.meshes[0].positions;
        let corner = positions.iter().find(|p| p.x == 1.0 && p.y == 1.0);
        let normals = normals_at(&scene, *corner.expect("the first corner"));
        // The end, and one mean of the two sides or both of them.
        assert_eq!(normals.len(), if is_smooth { 2 } else { 3 }, "{sides}");
        let is_mean = normals.iter().any(|n| n.distance(Vec3::X) < 1e-6);
        assert_eq!(is_mean, is_smooth, "{normals:?}");
    }
}

#[test]
fn a_cube_keeps_its_edges_with_and_without_smoothing() {
    for smoothing in ["", "s 1\n"] {
        let scene = scene("a.obj", smoothing.to_owned() + &prism(4));
        assert_eq!(scene.meshes[0].positions.len(), 24, "{smoothing:?}");
        for normal in &scene.meshes[0].normals {
            // The sides face along the diagonals of x and z.
            let is_side = normal.y.abs() < 1e-6 && (normal.x.abs() - normal.z.abs()).abs() < 1e-6;
            assert!(is_side || (normal.y.abs() - 1.0).abs() < 1e-6, "{normal}");
        }
    }
}

#[test]
fn smoothing_groups_are_smooth_up_to_sixty_degrees() {
    // The sides of a prism of seven meet at 51.4°, its ends and sides at 90°.
    let scene = scene("a.obj", "s 7\n".to_owned() + &prism(7));
    assert_eq!(scene.meshes[0].positions.len(), 28);
    let corner = scene.meshes[0]
        .positions
        .iter()
        .find(|p| p.x == 1.0 && p.y == 1.0);
    let corner = *corner.expect("the first corner");
    let normals = normals_at(&scene, corner);
    assert_eq!(normals.len(), 2);
    // By symmetry, the mean of the two sides is the direction of the corner.
    let goes = |wanted: Vec3| normals.iter().any(|n| n.distance(wanted) < 1e-6);
    assert!(goes(Vec3::X) && goes(Vec3::Y), "{normals:?}");
}

#[test]
fn faces_of_different_smoothing_groups_do_not_mix() {
    // A crease of 20°, which one group would smooth.
    let slope = 10f64.to_radians().tan();
    let roof = format!("v 0 {slope} 0\nv 0 {slope} 1\nv -1 0 0\nv -1 0 1\nv 1 0 0\nv 1 0 1\n");
    let ridge = Vec3::new(0.0, slope as f32, 0.0);
    let normals = |text: String| normals_at(&scene("a.obj", roof.clone() + &text), ridge);
    assert_eq!(
        normals("s 1\nf 1 3 4 2\ns 2\nf 2 6 5 1\n".to_owned()).len(),
        2
    );
    assert_eq!(
        normals("s 1\nf 1 3 4 2\ns off\nf 2 6 5 1\n".to_owned()).len(),
        2
    );
    // Materials split vertices without changing their normals.
    let both = normals("s 1\nusemtl a\nf 1 3 4 2\nusemtl b\nf 2 6 5 1\n".to_owned());
    assert!(
        matches!(both[..], [n] if n.distance(Vec3::Y) < 1e-6),
        "{both:?}"
    );
}

#[test]
fn the_tip_of_a_cone_of_many_sides_points_along_its_axis() {
    const SIDES: usize = 100;
    let mut text = "v 0 3 0\ns 1\n".to_owned();
    for i in 0..SIDES {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / SIDES as f64).sin_cos();
        text += &format!("v {cos} 0 {}\n", -sin);
    }
    for i in 0..SIDES {
        text += &format!("f 1 {} {}\n", i + 2, (i + 1) % SIDES + 2);
    }
    let scene = scene("a.obj", text);
    let tip = normals_at(&scene, Vec3::new(0.0, 3.0, 0.0));
    assert!(
        matches!(tip[..], [n] if n.distance(Vec3::Y) < 1e-6),
        "{tip:?}"
    );
    assert_eq!(scene.meshes[0].positions.len(), SIDES + 1);
}

#[test]
fn normals_are_kept_where_given_and_computed_where_not() {
    let text = format!("{SQUARE}vn 0 3 4\nvn 0 0 0\nf 1//1 2 3\nf 1//2 3//1 4//1");
    let scene = scene("a.obj", text);
    let given = Vec3::new(0.0, 0.6, 0.8);
    let count = |n: Vec3| {
        scene.meshes[0]
            .normals
            .iter()
            .filter(|m| m.distance(n) < 1e-6)
            .count()
    };
    assert_eq!((count(given), count(Vec3::Z)), (3, 3));
    assert_snapshot!(scene.skipped.join("\n"), @"recomputed 1 normal of zero length");
}

#[test]
fn materials_come_from_the_library() {
    let library = b"# colours
        newmtl dark red
        Kd 0.5 0 0
        Ks 0.25
        Ns 64
        Ka 0 0 0.1
        illum 2
        map_Kd red.png
        d 0.5
        newmtl other
        Kd spectral red.rfl
        Kd 0 1 0
        newmtl unused
        Kd 0 0 1";
    let model = format!("mtllib a.mtl\n{SQUARE}usemtl dark red\nf 1 2 3\nusemtl other\nf 1 3 4\n");
    let scene = with_library(&model, library);
    let [red, green, _ground] = &scene.materials[..] else {
        panic!("only materials in use are kept: {:?}", scene.materials);
    };
    assert_eq!(red.name, "dark red");
    assert_eq!(red.classical().diffuse, Vec3::new(0.5, 0.0, 0.0));
    assert_eq!(red.classical().specular, Vec3::splat(0.25));
    assert_eq!(red.classical().shininess, 64.0);
    assert_eq!(red.classical().ambient, Vec3::new(0.0, 0.0, 0.1));
    assert_eq!(red.classical().opacity, 0.5);
    assert_eq!(
        (green.classical().diffuse, green.classical().ambient),
        (Vec3::Y, Vec3::Y)
    );
    assert_snapshot!(scene.skipped.join("\n"), @r"
skipped in materials: `Kd spectral` 1
texture skipped: `red.png` does not exist
");
}

#[test]
fn missing_and_unsupported_features_are_reported() {
    let text = format!(
        "mtllib gone.mtl lost too.mtl\n{SQUARE}v 0 0 1 1 0 0\no part\ng a b\ns 1\nusemtl gold\nf 1 2 3\nf 1 2\nf 1 1 1\n\
         l 1 2\np 1\ncurv 0 1 1 2\nhologram 7\n"
    );
    let scene = scene("a.obj", text);
    assert_eq!(scene.triangle_count(), 1);
    assert_snapshot!(scene.skipped.join("\n"), @r"
the material file `gone.mtl` does not exist
the material file `lost` does not exist
the material file `too.mtl` does not exist
the material `gold` is not defined: the default replaces it
free-form statements skipped: 1
lines and points skipped: 2
unknown statements skipped: 1
the first unknown statement is `hologram`
`f`: faces with fewer than three corners skipped: 1 (line 12)
dropped 1 triangle without area
");
}

#[test]
fn a_model_without_faces_is_an_empty_scene() {
    for text in ["# nothing\n", "v 1 2 3\n", "o a\n"] {
        let scene = scene("a.obj", text);
        assert_eq!(scene.instances.len(), 0);
        assert_eq!(scene.skipped, ["the model has no triangles"]);
    }
}

#[test]
fn models_far_away_keep_their_shape() {
    let text = "v 1000000 0 0\nv 1000000.125 0 0\nv 1000000 0.125 0\nf 1 2 3";
    let scene = scene("a.obj", text);
    assert_eq!(area(&scene), 0.125 * 0.125 / 2.0);
    let (min, _) = scene.bounds().expect("bounds");
    assert!((min.x - 1e6).abs() < 1e-6);
}

#[test]
fn every_error_has_a_message() {
    let square = |rest: &str| format!("{SQUARE}{rest}");
    let texts = [
        String::new(),
        "Dear Sir or Madam".to_owned(),
        "\x01\x02".to_owned(),
        "v 1 2".to_owned(),
        "v 1 2 x".to_owned(),
        "v 1 2 nan".to_owned(),
        "v 1 2 1e400".to_owned(),
        "v 1 2 3 4 5 6 7 8".to_owned(),
        "vn 0 1".to_owned(),
        square("f"),
        square("f 1 2 5"),
        square("f 1 2 0"),
        square("f 1 2 -5"),
        square("f 1 2 99999999999999999999"),
        square("f 1 2 3.5"),
        square("f 1 2 three"),
        square("f 1/1/1/1 2 3"),
        square("f 1// 2 3"),
        square("f / 2 3"),
        square(&format!("f{}", " 1 2 3".repeat(30_000))),
    ];
    assert_snapshot!(messages("a.obj", &texts), @r"
bad model (a.obj): the file is empty. Check that it was written completely.
bad model (a.obj:1:1): `Dear` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj:1:1): `\u{1}\u{2}` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj:1:1): `v` needs three numbers. Add the missing ones.
bad model (a.obj:1:7): `x` is not a number. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:7): `nan` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:7): `1e400` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:17): a vertex has too many numbers. Write `v X Y Z`.
bad model (a.obj:1:1): `vn` needs three numbers. Add the missing ones.
bad model (a.obj:5:1): a face has fewer than three corners. Check that the file is complete.
bad model (a.obj:5:7): vertex 5 does not exist: 4 come before this face. Count from 1, or backwards from -1.
bad model (a.obj:5:7): vertex 0 does not exist: 4 come before this face. Count from 1, or backwards from -1.
bad model (a.obj:5:7): vertex -5 does not exist: 4 come before this face. Count from 1, or backwards from -1.
bad model (a.obj:5:7): `99999999999999999999` is not the number of a vertex. Write a whole number, counted from 1.
bad model (a.obj:5:7): `3.5` is not the number of a vertex. Write a whole number, counted from 1.
bad model (a.obj:5:7): `three` is not the number of a vertex. Write a whole number, counted from 1.
bad model (a.obj:5:5): texture coordinate 1 does not exist: 0 come before this face. Count from 1, or backwards from -1.
bad model (a.obj:5:3): `1//` is not a corner of a face. Write V, V/VT, V//VN or V/VT/VN.
bad model (a.obj:5:3): `/` is not a corner of a face. Write V, V/VT, V//VN or V/VT/VN.
bad model (a.obj:5:131075): a face has more than 65536 corners. Split the face.
");
}

#[test]
fn values_that_cannot_be_used_are_repaired_and_reported() {
    let text = format!(
        "{SQUARE}v nan 0 0\nv 0 1e39\nv 0 0 -1.#IND\nv 2,5 0 0\nvn 0 0 1\nvn -nan(ind) 0 0\n\
         vt 0.5 0.5\nvt nan 1.#QNAN\nf 1//1 2//1 3//2 4//1\nf 1 2 5\nf 1 2 6\nf 1 2 7\nf 1 2 8 3\n\
         f 1 2 9\nf 1 2 0\nf 1 -9 2\nf 1/3/3 2/2/1 3/1/0\nf 1 2 x\nf 1 2\nf\nusemtl\nmtllib\nvt\n\
         v 0 0 0 1 2 3 4 5\n\x01\x02 3\n"
    );
    let scene = scene("a.obj", text);
    assert_eq!(scene.triangle_count(), 5);
    let mesh = &scene.meshes[0];
    assert!(mesh.normals.iter().all(|n| n.distance(Vec3::Z) < 1e-6));
    assert!(mesh.positions.iter().any(|p| p.x == 2.5));
    assert_snapshot!(scene.skipped.join("\n"), @r"
colours of vertices of 0 to 255 divided by 255
`usemtl` without a name skipped: 1
faces with vertices that are not finite skipped: 3
unknown statements skipped: 1
the first unknown statement is `\u{1}\u{2}`
`v`: values that are not finite numbers skipped: 3 (first in line 5)
`v`: statements with fewer than three numbers skipped: 1 (line 6)
`v`: decimal commas read as points: 1 (line 8)
`v`: numbers after the seventh skipped: 1 (line 28)
`vn`: values that are not finite numbers skipped: 1 (line 10)
`vt`: values that are not finite numbers skipped: 2 (first in line 12)
`vt`: texture coordinates without a number set to 0: 1 (line 27)
`f`: faces with vertices that do not exist skipped: 4 (first in line 18)
`f`: texture coordinates that do not exist left out: 1 (line 21)
`f`: normals that do not exist computed: 2 (first in line 21)
`f`: faces with fewer than three corners skipped: 2 (first in line 23)
`mtllib`: without a name skipped: 1 (line 26)
recomputed 1 normal of zero length
");
}

#[test]
fn a_model_of_which_nothing_is_left_is_refused_for_its_first_fault() {
    let texts = [
        "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n",
        "f 1 2 3\nv 0 0 0\n",
    ];
    assert_snapshot!(messages("a.obj", &texts), @r"
bad model (a.obj:2:7): `nan` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:3): vertex 1 does not exist: 0 come before this face. Count from 1, or backwards from -1.
");
}

#[test]
fn colours_of_vertices_may_have_an_opacity_a_weight_or_levels() {
    const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
    // 128 and 64 of 255 in sRGB, by IEC 61966-2-1.
    const BROWN: [f32; 4] = [0.2159, 0.0513, 0.0, 1.0];
    const DARK: [f32; 4] = [0.0, 0.0, 0.000_303_5, 1.0];
    let of_bytes = "colours of vertices of 0 to 255 divided by 255";
    let cases = [
        // Red, green, blue, opacity.
        (["1 0 0 1", "1 0 0 1", "1 0 0 1"], [RED; 3], vec![]),
        // A weight of 1, which is no opacity if the last numbers differ from 1.
        (["1 1 0 0", "1 1 0 0", "1 1 0 0"], [RED; 3], vec![]),
        (
            ["0 0 1 1", "0 1 0 0.5", "1 0 0 1"],
            [[0.0, 0.0, 1.0, 1.0], [0.0, 1.0, 0.0, 0.5], RED],
            vec![],
        ),
        (
            ["255 0 0", "128 64 0", "0 0 1"],
            [RED, BROWN, DARK],
            vec![of_bytes],
        ),
        (
            ["255 0 0 255", "128 64 0 255", "0 0 1 255"],
            [RED, BROWN, DARK],
            vec![of_bytes],
        ),
        (
            ["1.5 0 0", "0 -1 0", "1 0 0"],
            [RED, [0.0, 0.0, 0.0, 1.0], RED],
            vec!["colours of vertices clamped to 0 to 1: 2"],
        ),
    ];
    let places = ["0 0 0", "1 0 0", "0 1 0"];
    for (numbers, colors, notes) in cases {
        let vertices = (0..3).map(|i| format!("v {} {}\n", places[i], numbers[i]));
        let scene = scene("a.obj", vertices.collect::<String>() + "f 1 2 3\n");
        let mesh = &scene.meshes[0];
        for (place, color) in [Vec3::ZERO, Vec3::X, Vec3::Y].into_iter().zip(colors) {
            let index = mesh.positions.iter().position(|p| *p == place);
            let found = mesh.colors[index.expect("a vertex")];
            let expected = glam::Vec4::from(color);
            assert!(
                (found - expected).abs().max_element() < 1e-4,
                "{numbers:?}: {found}"
            );
        }
        assert_eq!(scene.skipped, notes, "{numbers:?}");
        let is_covered = colors.iter().any(|color| color[3] < 1.0);
        let coverage = scene.materials[0].coverage;
        assert_eq!(coverage == Coverage::Blend, is_covered, "{numbers:?}");
    }
}

#[test]
fn a_model_that_was_cut_anywhere_has_what_is_left_or_is_refused_in_one_line() {
    let faces: String = (1..60)
        .map(|i| format!("f {i}/1 {}/2/1 {}//1\n", i + 1, i + 2))
        .collect();
    let vertices: String = (0..62).map(|i| format!("v {i} {} 0.5\n", i % 2)).collect();
    let model = format!("mtllib a.mtl\n{vertices}vt 0 0\nvt 1 0\nvn 0 0 1\nusemtl m\n{faces}");
    let library = "newmtl m\nKd 0.5 0.25 0.125\nNs 20\nmap_Kd gone.png\n";
    let read = |model: &[u8], library: &[u8]| {
        let files = import::Memory::from_iter([("a.obj", model), ("a.mtl", library)]);
        import::load_from(&files, "a.obj", &import::Options::default())
    };
    for percent in 0..=100 {
        let cut = |text: &str| text.as_bytes()[..text.len() * percent / 100].to_vec();
        for (model, library) in [
            (cut(&model), library.as_bytes().to_vec()),
            (model.clone().into_bytes(), cut(library)),
        ] {
            match read(&model, &library) {
                Ok(scene) => {
                    // The last face may have lost a corner, which makes it another one or none.
                    let whole = model.iter().filter(|&&byte| byte == b'f').count();
                    assert!(scene.triangle_count() <= whole, "{percent} %");
                    assert!(
                        scene.triangle_count() + 1 >= whole || percent < 100,
                        "{percent} %"
                    );
                }
                Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
            }
        }
    }
}
