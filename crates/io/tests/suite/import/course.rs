//! The course's format, by its specification and as found in practice.

use super::{messages, scene};
use glam::{DVec3, Vec3};
use glimray::scene::{
    Attenuation, Background, Camera, Geometry, Light, LightKind, Material, Mixing, Phong, Shape,
    Transfer,
};
use insta::assert_snapshot;

const PLAIN: &str = "2
amb: 0.1 0.2 0.3
sphere
pos: 0 -0 -3
rad: .44
dif: 0.3 0.5 0.8
spe: 0.6 0.6 0.6
shi: 50
light
pos: 3 4 1
col: 0.9 1 +0.5e0
";

/// A triangle in the plane z = -5 whose corners have the given normals and materials of one colour.
fn triangle(corners: [&str; 3], normal: &str) -> String {
    let vertex = |p: &str| format!("pos: {p} nor: {normal} dif: 1 0 0 spe: 0 0 0 shi: 1\n");
    format!("triangle\n{}", corners.map(vertex).concat())
}

#[test]
fn a_plain_file_reads_as_written() {
    let scene = scene("a.scene", PLAIN);
    let center = DVec3::new(0.0, 0.0, -3.0);
    let geometry = Geometry::Sphere {
        center,
        radius: 0.44,
    };
    assert_eq!(
        scene.shapes,
        [Shape {
            geometry,
            material: 0,
            node: None,
            name: String::new(),
        }]
    );
    assert_eq!(
        scene.materials,
        [Material {
            name: String::new(),
            two_sided: false,
            bsdf: Phong {
                diffuse: Vec3::new(0.3, 0.5, 0.8),
                specular: Vec3::splat(0.6),
                shininess: 50.0,
                ambient: Vec3::ONE, // If mirrors are requested, reflection has the weight of the highlight.
                reflect: Vec3::splat(0.6),
                mixing: Mixing::Blend,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        }]
    );
    assert_eq!(
        scene.lights,
        [Light {
            kind: LightKind::Point {
                position: DVec3::new(3.0, 4.0, 1.0)
            },
            color: Vec3::new(0.9, 1.0, 0.5),
            attenuation: Attenuation::None,
            ..Light::default()
        }]
    );
    assert_eq!(scene.ambient, Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn the_output_settings_are_those_of_the_course() {
    let scene = scene("a.scene", "0 amb: 0 0 0");
    assert_eq!(scene.cameras, [Camera::default()]);
    assert_eq!(scene.background, Background::Color(Vec3::ONE));
    assert_eq!(scene.output.size, (640, 480));
    assert_eq!(scene.output.samples, 1);
    assert_eq!(scene.output.tone, None);
    assert_eq!(scene.output.transfer, Transfer::Linear);
    assert_eq!(
        scene.materials.len(),
        1,
        "there is a material even when nothing has one"
    );
}

#[test]
fn common_deviations_are_accepted() {
    let plain = scene("a.scene", PLAIN);
    let no_newline = PLAIN.trim_end().to_owned();
    let windows = format!("\u{feff}{}", PLAIN.replace('\n', "\r\n"));
    let spaced = PLAIN.replace(' ', "\t \n\n\x0b\x0c");
    let shouted = PLAIN.to_uppercase();
    let commented = PLAIN.replace('\n', " # amb: 9 9 9\n// sphere\n");
    let glued = PLAIN.replace("-3\n", "-3//three away\n");
    let one_line = PLAIN.replace('\n', " ");
    for text in [
        no_newline, windows, spaced, shouted, commented, glued, one_line,
    ] {
        assert_eq!(scene("a.scene", &text), plain, "{text:?}");
    }
    let any_order = "2 amb: 0.1 0.2 0.3 sphere shi: 50 spe: 0.6 0.6 0.6 dif: 0.3 0.5 0.8 rad: .44
        pos: 0 0 -3 light col: 0.9 1 .5 pos: 3 4 1";
    assert_eq!(scene("a.scene", any_order), plain);
}

#[test]
fn a_wrong_count_is_reported_and_all_objects_are_read() {
    for announced in ["1", "3", "1e9"] {
        let scene = scene("a.scene", PLAIN.replacen('2', announced, 1));
        assert_eq!((scene.shapes.len(), scene.lights.len()), (1, 1));
        assert_eq!(scene.skipped.len(), 1);
    }
    let scene = scene("a.scene", PLAIN.replacen('2', "5", 1));
    assert_snapshot!(scene.skipped.join("\n"), @"the file announces 5 objects, but contains 2: all of them are read");
}

#[test]
fn the_students_extensions_are_read_and_reported() {
    let text = "3 amb: 0 0 0
        sphere pos: 0 0 -3 ref: 0.5 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1
        sphere pos: 0 0 -9 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1 Ref: 0.25
        light pos: 0 5 0 col: 1 1 1 area_light: true area_u: 1 0 0 area_v: 0 0 1 samples: 16";
    let scene = scene("a.scene", text);
    assert_eq!((scene.shapes.len(), scene.lights.len()), (2, 1));
    assert_snapshot!(scene.skipped.join("\n"), @"`ref:` is not supported (found 2 times)");
}

#[test]
fn area_lights_of_students_are_rectangles_that_do_not_fade() {
    let light = |text: &str| {
        scene("a.scene", format!("2 amb: 0 0 0 light {text}"))
            .lights
            .remove(0)
    };
    let kind = LightKind::Rectangle {
        center: DVec3::new(0.0, 5.0, 0.0),
        edge_u: DVec3::X,
        edge_v: DVec3::Z * 0.5,
    };
    let expected = Light {
        kind,
        color: Vec3::ONE,
        attenuation: Attenuation::None,
        samples: 9,
        visible: false,
        node: None,
        name: String::new(),
    };
    let sphere = "sphere pos: 0 0 -3 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1";
    let texts = [
        "pos: 0 5 0 col: 1 1 1 area_light: true area_u: 2 0 0 area_v: 0 0 1 samples: 9",
        "Samples: 9 area_V: 0 0 1 pos: 0 5 0 area_u: 2 0 0 AREA_LIGHT: TRUE col: 1 1 1",
    ];
    for text in texts {
        assert_eq!(light(text), expected, "{text}");
        assert_eq!(light(&format!("{text} {sphere}")), expected, "{text}");
    }
    let some = Light {
        samples: 16,
        ..expected.clone()
    };
    assert_eq!(light(&texts[0].replace("samples: 9", "")), some);

    let point = LightKind::Point {
        position: DVec3::new(0.0, 5.0, 0.0),
    };
    assert_eq!(light(&texts[0].replace("true", "false")).kind, point);
    assert_eq!(light(&texts[0].replace("area_light: true", "")).kind, point);
}

#[test]
fn missing_keys_of_area_lights_are_reported() {
    let light = "light pos: 0 5 0 col: 1 1 1";
    let text = format!(
        "4 amb: 0 0 0 samples: 3
        {light} area_light: true area_u: 1 0 0 samples: 4
        {light} area_light: false area_u: 1 0 0
        {light} area_v: 0 0 1
        sphere pos: 0 0 -3 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1 area_light: true"
    );
    assert_snapshot!(scene("a.scene", text).skipped.join("\n"), @r"
`area_light:` has no effect without a light, `area_light: true`, `area_u:` and `area_v:` (found 2 times)
`area_u:` has no effect without a light, `area_light: true`, `area_u:` and `area_v:` (found once)
`area_v:` has no effect without a light, `area_light: true`, `area_u:` and `area_v:` (found once)
`samples:` has no effect without a light, `area_light: true`, `area_u:` and `area_v:` (found 2 times)
");
}

#[test]
fn triangles_become_one_mesh_with_a_material_at_each_corner() {
    let text = "2 amb: 0 0 0
        triangle
        pos: 0 0 -5 nor: 0 0 2 dif: 1 0 0 spe: 0 0 0 shi: 1
        pos: 1 0 -5 nor: 0 0 1 dif: 0 1 0 spe: 0 0 0 shi: 1
        nor: 0 3 4 pos: 0 1 -5 dif: 1 0 0 shi: 1 spe: 0 -0 0
        sphere pos: 0 0 -9 rad: 1 dif: 0 1 0 spe: 0 0 0 shi: 1";
    let scene = scene("a.scene", text);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    let offset = scene.instances[0].placement.translation;
    let corner = mesh.positions[1].as_dvec3() + offset;
    assert_eq!(corner, DVec3::new(1.0, 0.0, -5.0));
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::Z, Vec3::new(0.0, 0.6, 0.8)]);
    assert_eq!(mesh.materials, [0, 1, 0], "equal materials are one");
    assert_eq!(scene.shapes[0].material, 1);
    assert_eq!(scene.materials.len(), 2);
}

#[test]
fn normals_are_not_flipped_by_the_winding() {
    let text = format!(
        "1 amb: 0 0 0 {}",
        triangle(["0 0 -5", "0 1 -5", "1 0 -5"], "0 0 1")
    );
    assert_eq!(scene("a.scene", text).meshes[0].normals, [Vec3::Z; 3]);
}

#[test]
fn flat_triangles_are_dropped_and_zero_normals_recomputed() {
    let flat = triangle(["0 0 -5", "1 1 -6", "2 2 -7"], "0 0 1");
    let bare = triangle(["0 0 -5", "1 0 -5", "0 1 -5"], "0 0 0");
    let scene = scene("a.scene", format!("2 amb: 0 0 0 {flat} {bare}"));
    assert_eq!(scene.triangle_count(), 1);
    assert_eq!(&scene.meshes[0].normals[3..], [Vec3::Z; 3]);
    assert_snapshot!(scene.skipped.join("\n"), @r"
dropped 1 triangle without area
recomputed 3 normals of zero length
");

    let nothing = super::scene("a.scene", format!("1 amb: 0 0 0 {flat}"));
    assert_eq!((nothing.meshes.len(), nothing.instances.len()), (0, 0));
}

#[test]
fn triangles_far_away_keep_their_shape() {
    let corners = ["1e6 0 -5", "1000000.25 0 -5", "1e6 0.25 -5"];
    let scene = scene(
        "a.scene",
        format!("1 amb: 0 0 0 {}", triangle(corners, "0 0 1")),
    );
    let instance = &scene.instances[0];
    let corner = |i: usize| scene.meshes[0].positions[i].as_dvec3();
    assert_eq!(corner(1) - corner(0), DVec3::new(0.25, 0.0, 0.0));
    let world = instance.placement.transform_point3(corner(0));
    assert!(world.distance(DVec3::new(1e6, 0.0, -5.0)) < 1e-6);
}

#[test]
fn values_that_cannot_be_used_are_repaired_and_reported() {
    let sphere = |values: &str| format!("sphere pos: 0 0 -3 rad: 1 {values}\n");
    let light = "light pos: 0 0 0 col: 1 1 1 area_light: true area_v: 0 1 0";
    let corner = |place: &str| format!("pos: {place} nor: 0 0 1 dif: 1 1 1 spe: 0 0 0 shi: 1\n");
    let text = format!(
        "-7 amb: 0.5 -1 nan\n{}{}{}{light} area_u: 0 2 0 samples: 2.5\n\
         light pos: 0 1e39 0 col: 1 1 1\ntriangle {}{}{}",
        sphere("dif: 1 -1 0.25 spe: 0 0 0 shi: -3"),
        sphere("dif: 1 1 1 spe: 0 0 0 shi: 1").replace("rad: 1", "rad: -1"),
        sphere("dif: 1 1 1 spe: 0 0 0 shi: 1").replace("-3", "-inf"),
        corner("0 0 -1"),
        corner("1 0 -1"),
        corner("nan 0 -1"),
    );
    let scene = scene("a.scene", text);
    assert_eq!((scene.shapes.len(), scene.meshes.len()), (1, 0));
    assert_eq!(scene.ambient, Vec3::new(0.5, 0.0, 0.0));
    let material = &scene.materials[scene.shapes[0].material];
    assert_eq!(material.classical().diffuse, Vec3::new(1.0, 0.0, 0.25));
    assert_eq!(material.classical().shininess, 0.0);
    let point = LightKind::Point {
        position: DVec3::ZERO,
    };
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(scene.lights[0].kind, point);
    assert_snapshot!(scene.skipped.join("\n"), @r"
the file announces -7 objects, but contains 6: all of them are read
`amb:`: negative numbers set to 0: 1 (line 1)
`amb:`: values that are not finite, skipped or set to 0: 1 (line 1)
`dif:`: negative numbers set to 0: 1 (line 2)
`shi:`: negative numbers set to 0: 1 (line 2)
`rad:`: spheres without a positive radius skipped: 1 (line 3)
`pos:`: values that are not finite, skipped or set to 0: 3 (first in line 4)
`samples:`: other than 1 to 65536 skipped: 1 (line 5)
`area_light:`: lights without area left as points: 1 (line 5)
");
}

#[test]
fn every_error_has_a_message() {
    let sphere = "1\namb: 0 0 0\nsphere pos: 0 0 -3 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1\n";
    let change = |from: &str, to: &str| sphere.replacen(from, to, 1);
    let texts = [
        String::new(),
        "  \n".to_owned(),
        "many".to_owned(),
        "1".to_owned(),
        "1 sphere".to_owned(),
        "1 amb: 0 0".to_owned(),
        change("sphere", "shpere"),
        change("sphere", "torus"),
        change("rad: 1", "rads: 1"),
        change("rad: 1", "reflectivity: 1"),
        change("rad: 1", "pos: 0 0 0"),
        change("rad: 1 ", ""),
        change("rad: 1", "rad: 0"),
        change("rad: 1", "rad: -1"),
        change("rad: 1", "rad: 1e-50"),
        change("rad: 1", "rad: nan"),
        change("rad: 1", "rad: -inf"),
        change("rad: 1", "rad: 1e400"),
        change("rad: 1", "rad: 1e39"),
        change("rad: 1", "rad: 0x10"),
        change("rad: 1", "rad: 1,5"),
        change("rad: 1", "rad: ١"),
        change("rad: 1", "rad:"),
        change("shi: 1", "shi:"),
        change(" shi: 1", ""),
        change("shi: 1", "ref: much"),
        change("shi: 1", "shi: 1 area_light: yes"),
        change("shi: 1", "shi: 1 samples:"),
        format!("{sphere}col: 1 1 1"),
        format!("{sphere}light pos: 0 0 0 sphere"),
        format!("{sphere}triangle pos: 0 0 0 nor: 0 0 1 dif: 1 1 1 spe: 0 0 0 shi: 1"),
        format!("{sphere}triangle pos: 0 0 0 nor: 0 0 1 rad: 1"),
    ];
    assert_snapshot!(messages("a.scene", &texts), @r"
bad scene (a.scene): the file is empty. Check that it was written completely.
bad scene (a.scene:1:1): the file ends where the number of objects `N` should be. Check that it is complete.
bad scene (a.scene:1:1): `many` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:1:2): the file ends where `amb:` should be. Check that it is complete.
bad scene (a.scene:1:3): expected `amb:`, found `sphere`. Begin the file with N and `amb: R G B`.
bad scene (a.scene:1:11): the file ends where a number of `amb:` should be. Check that it is complete.
bad scene (a.scene:3:1): unknown object `shpere`, did you mean `sphere`? Objects are `sphere`, `triangle` and `light`.
bad scene (a.scene:3:1): unknown object `torus`. Objects are `sphere`, `triangle` and `light`.
bad scene (a.scene:3:20): unknown key `rads:`, did you mean `rad:`? A sphere needs `pos:`, `rad:`, `dif:`, `spe:`, `shi:`, each once.
bad scene (a.scene:3:20): unknown key `reflectivity:`. A sphere needs `pos:`, `rad:`, `dif:`, `spe:`, `shi:`, each once.
bad scene (a.scene:3:20): a second `pos:` before `rad:`. A sphere needs `pos:`, `rad:`, `dif:`, `spe:`, `shi:`, each once.
bad scene (a.scene:3:48): the file ends inside a sphere, before `rad:`. Check that it is complete.
bad scene (a.scene:3:25): the radius `0` is not greater than 0. Write a positive number.
bad scene (a.scene:3:25): the radius `-1` is not greater than 0. Write a positive number.
bad scene (a.scene:3:25): the radius `1e-50` is not greater than 0. Write a positive number.
bad scene (a.scene:3:25): `nan` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `-inf` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `1e400` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `1e39` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `0x10` is hexadecimal, which is not accepted. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `1,5` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `١` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:25): `dif:` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:53): the file ends where a number of `shi:` should be. Check that it is complete.
bad scene (a.scene:3:48): the file ends inside a sphere, before `shi:`. Check that it is complete.
bad scene (a.scene:3:54): `much` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:3:68): expected `true` or `false`, found `yes`. Write `area_light: true`.
bad scene (a.scene:3:64): the file ends where a value of `samples:` should be. Check that it is complete.
bad scene (a.scene:4:1): unknown object `col:`. Objects are `sphere`, `triangle` and `light`.
bad scene (a.scene:4:18): a new object begins, but the light before it has no `col:`. A light needs `pos:`, `col:`, each once.
bad scene (a.scene:4:60): the file ends inside a triangle, before `pos:`. Check that it is complete.
bad scene (a.scene:4:32): unknown key `rad:`. A vertex of a triangle needs `pos:`, `nor:`, `dif:`, `spe:`, `shi:`, each once.
");
}
