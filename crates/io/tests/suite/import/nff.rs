//! Haines' Neutral File Format and its polygons.

mod polygons;

use super::{messages, scene, triangles};
use glam::{DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{
    Background, Camera, CanonicalShape, Fresnel, Geometry, Light, LightKind, Material, Mixing,
    Phong, Shape, Transfer,
};
use insta::assert_snapshot;

const VIEW: &str =
    "v\nfrom 0 -5 1\nat 0 0 1\nup 0 0 1\nangle 45\nhither 0.01\nresolution 320 200\n";

const MATERIAL: &str = "f 1 0.5 0.25 0.8 0.5 30 0 0\n";

/// A file with a view and a material, followed by `rest`.
fn file(rest: &str) -> String {
    format!("{VIEW}{MATERIAL}{rest}\n")
}

fn sphere(x: f64, radius: f64, material: usize) -> Shape {
    let geometry = Geometry::Sphere {
        center: DVec3::new(x, 0.0, 0.0),
        radius,
    };
    Shape {
        geometry,
        material,
        node: None,
        name: String::new(),
    }
}

fn light(position: DVec3, color: Vec3) -> Light {
    Light {
        kind: LightKind::Point { position },
        color,
        ..Light::default()
    }
}

#[test]
fn a_plain_file_reads_as_written() {
    let text = format!("b 0.078 0.361 0.753\n{VIEW}l 4 3 2 1 0.5 0\n{MATERIAL}s 0 0 0 0.5\n");
    let scene = scene("a.nff", text);
    assert_eq!(
        scene.cameras,
        [Camera {
            look_from: DVec3::new(0.0, -5.0, 1.0),
            look_at: DVec3::new(0.0, 0.0, 1.0),
            up: DVec3::Z,
            fov_y: std::f64::consts::FRAC_PI_4,
            ..Camera::default()
        }]
    );
    let background = Vec3::new(0.078, 0.361, 0.753);
    assert_eq!(scene.background, Background::Color(background));
    let position = DVec3::new(4.0, 3.0, 2.0);
    assert_eq!(scene.lights, [light(position, Vec3::new(1.0, 0.5, 0.0))]);
    assert_eq!(scene.shapes, [sphere(0.0, 0.5, 0)]);
    assert_eq!(scene.ambient, Vec3::ZERO);
    assert_eq!(scene.output.size, (320, 200));
    assert_eq!(scene.output.samples, 1);
    assert_eq!(scene.output.max_depth, 5);
    assert_eq!(scene.output.tone, None);
    assert_eq!(scene.output.transfer, Transfer::Linear);
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn highlight_and_reflection_are_white_and_the_diffuse_part_is_coloured() {
    let scene = scene("a.nff", file("f 1 0.5 0 0.5 0.25 12 0.75 1.5 s 0 0 0 1"));
    assert_eq!(
        scene.materials[1],
        Material {
            name: String::new(),
            two_sided: true,
            bsdf: Phong {
                diffuse: Vec3::new(0.5, 0.25, 0.0),
                specular: Vec3::splat(0.25),
                shininess: 12.0,
                ambient: Vec3::ZERO,
                reflect: Vec3::splat(0.25),
                transmit: Vec3::splat(0.75),
                ior: 1.5,
                fresnel: Fresnel::None,
                mixing: Mixing::Sum,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        }
    );
    assert_eq!(
        scene.materials[0].classical().ior,
        1.0,
        "an index of 0 is none"
    );
}

#[test]
fn objects_have_the_material_before_them_and_equal_ones_are_kept_once() {
    let text = file(
        "s 0 0 0 1 f 0 0 1 1 0 0 0 0 s 1 0 0 1 s 2 0 0 1 f 1 0.5 0.25 0.8 0.5 30 0 0 s 3 0 0 1 p 3 0 0 0 1 0 0 0 1 0",
    );
    let scene = scene("a.nff", text);
    assert_eq!(scene.materials.len(), 2);
    let used: Vec<_> = scene.shapes.iter().map(|shape| shape.material).collect();
    assert_eq!(used, [0, 1, 1, 0]);
    assert_eq!(scene.meshes[0].materials, [0, 0, 0]);
}

#[test]
fn lights_without_a_colour_share_one_over_the_root_of_their_number() {
    let text = format!("{VIEW}l 0 0 1\nl 0 0 2 0.1 0.2 0.3 # red\nl -1 0 3\nl +1 0 4\n");
    let scene = scene("a.nff", text);
    let colors: Vec<_> = scene.lights.iter().map(|light| light.color).collect();
    let half = Vec3::splat(0.5);
    assert_eq!(colors, [half, Vec3::new(0.1, 0.2, 0.3), half, half]);
}

#[test]
fn common_deviations_are_accepted() {
    let plain = format!("{VIEW}b 0 0 1\nl 1 2 3\n{MATERIAL}s 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n");
    let expected = scene("a.nff", &plain);
    let windows = format!("\u{feff}{}", plain.replace('\n', "\r\n"));
    let commented = plain.replace('\n', "# s 9 9 9 9\n#\n");
    let one_line = plain.replace('\n', " ");
    let spaced = plain.replace(' ', "\t \n\x0b\x0c");
    let late_view = format!("b 0 0 1\nl 1 2 3\n{MATERIAL}s 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\n{VIEW}");
    let any_order = plain.replacen("from 0 -5 1\n", "", 1);
    let any_order = any_order.replacen("hither 0.01\n", "from 0 -5 1\n", 1);
    let no_newline = plain.trim_end().to_owned();
    for text in [
        windows, commented, one_line, spaced, late_view, any_order, no_newline,
    ] {
        assert_eq!(scene("a.nff", &text), expected, "{text:?}");
    }
    let parsed = import::parse("a.nff", &plain, &Options::default()).expect("a scene");
    assert_eq!(parsed, expected);
}

/// Points of a cone's rims, found from the file's numbers alone, must be on the placed shape.
fn assert_cone(text: &str, base: DVec3, bottom: f64, apex: DVec3, top: f64) {
    let scene = scene("a.nff", file(text));
    let [
        Shape {
            geometry:
                Geometry::Placed {
                    canonical,
                    world_from_canonical,
                },
            ..
        },
    ] = scene.shapes[..]
    else {
        panic!("{text}: {:?}", scene.shapes);
    };
    let wide = bottom.max(top);
    let expected = CanonicalShape::Cone {
        bottom: bottom / wide,
        top: top / wide,
        capped: false,
    };
    assert_eq!(canonical, expected, "{text}");
    assert!(
        world_from_canonical.matrix3.determinant() > 0.0,
        "{text}: mirrored"
    );
    let axis = (apex - base).normalize();
    for step in 0..12 {
        let angle = f64::from(step);
        for (center, radius, y) in [(base, bottom, 0.0), (apex, top, 1.0)] {
            let share = radius / wide;
            let rim = DVec3::new(share * angle.cos(), y, share * angle.sin());
            let rim = world_from_canonical.transform_point3(rim);
            let tolerance = 1e-12 * (1.0 + center.length() + radius);
            assert!((rim.distance(center) - radius).abs() < tolerance, "{text}");
            assert!((rim - center).dot(axis).abs() < tolerance, "{text}");
        }
    }
}

#[test]
fn the_rims_of_cones_are_round_and_where_the_file_has_them() {
    let (o, up) = (DVec3::ZERO, DVec3::new(0.0, 0.0, 3.0));
    assert_cone("c 0 0 0 2\n0 0 3 1", o, 2.0, up, 1.0);
    assert_cone("c 0 0 3 1 0 0 0 2", up, 1.0, o, 2.0);
    assert_cone("c 0 0 0 1 0 0 3 0", o, 1.0, up, 0.0);
    assert_cone("c 0 0 0 0 0 0 3 1", o, 0.0, up, 1.0);
    assert_cone("c 0 0 0 -2 0 0 3 -1", o, 2.0, up, 1.0);
    assert_cone(
        "c 0 0 0 5 0 -2 0 5",
        o,
        5.0,
        DVec3::new(0.0, -2.0, 0.0),
        5.0,
    );
    let (a, b) = (DVec3::new(1.5, -2.0, 4.0), DVec3::new(-3.0, 7.5, 4.25));
    assert_cone("c 1.5 -2 4 0.125 -3 7.5 4.25 0.0625", a, 0.125, b, 0.0625);
    let far = DVec3::new(1e6, 1e6, -1e6);
    let near = far + DVec3::new(0.0, 0.5, 0.0);
    assert_cone(
        "c 1e6 1e6 -1e6 100 1e6 1000000.5 -1e6 1",
        far,
        100.0,
        near,
        1.0,
    );
}

#[test]
fn repairs_are_reported() {
    let text = "b 1 1 1 b 0 0 0 s 0 0 0 -1 c 0 0 0 -1 0 0 1 -2
        p 5 0 0 0 0 0 0 1 0 0 0 1 0 0 0 0
        p 2 0 0 0 1 1 1  p 1 2 2 2
        p 4 0 0 0 1 0 0 2 0 0 3 0 0  p 3 1 1 1 1 1 1 1 1 1
        pp 3 0 0 0 0 0 0  1 0 0 0 0 1  0 1 0 0 0 1";
    let scene = scene("a.nff", file(text));
    assert_eq!(scene.background, Background::Color(Vec3::ZERO));
    assert_eq!(scene.shapes[0], sphere(0.0, 1.0, 0));
    assert_eq!(scene.triangle_count(), 2);
    assert_eq!(scene.meshes[0].normals, [Vec3::Z; 6]);
    assert_snapshot!(scene.skipped.join("\n"), @r"
2 backgrounds: the last one is used
shapes visible from inside only (negative radii), rendered two-sided: 2
repeated corners of polygons dropped: 4
polygons with fewer than three corners skipped: 2
polygons without area skipped: 2
recomputed 1 normal of zero length
");
}

#[test]
fn values_that_cannot_be_used_are_repaired_and_reported() {
    let view = VIEW.replace("up 0 0 1", "up 0 1 0").replace("45", "180");
    let view = view.replace("320", "0").replace("hither 0.01", "hither 99");
    let text = format!(
        "{view}b 0 nan 0\nl 1 2 inf\nl 1 2 3\nf 1 -1 0.5 1 nan 9 0.5 0\ns 0 0 0 1\n\
         s 0 0 nan 1\ns 0 0 0 0\nc 0 0 0 1 0 0 0 1\nc 0 0 0 1 0 0 1 -1\nc 0 0 0 1 0 0 -nan(ind) 1\n\
         p 3 0 0 0 1 0 0 0 1e39 0\np 4 0 0 0 3 0 0 0 1 0 1 1 0\n"
    );
    let scene = scene("a.nff", text);
    assert_eq!((scene.shapes.len(), scene.triangle_count()), (1, 2));
    assert_eq!(scene.lights, [light(DVec3::new(1.0, 2.0, 3.0), Vec3::ONE)]);
    assert_eq!(scene.background, Background::Color(Vec3::ZERO));
    let material = &scene.materials[0];
    assert_eq!(material.classical().diffuse, Vec3::new(1.0, 0.0, 0.5));
    assert_eq!(
        (material.classical().specular, material.classical().ior),
        (Vec3::ZERO, 1.0)
    );
    assert_eq!(scene.output.size, (512, 200));
    let camera = &scene.cameras[0];
    assert_eq!(camera.fov_y, std::f64::consts::FRAC_PI_4);
    assert!(camera.up.dot(DVec3::Y).abs() < 1e-9);
    assert_snapshot!(scene.skipped.join("\n"), @r"
`hither` lies beyond the point that is looked at: nothing is cut off
polygons that intersect themselves or are too large, triangulated as fans: 1
`v`: angles other than 0 to 180 replaced by 45: 1 (line 5)
`v`: counts of pixels replaced by 512: 1 (line 7)
`v`: `up` replaced: 1 (line 1)
`b`: values that are not finite, skipped or set to 0: 1 (line 8)
`l`: values that are not finite, skipped or set to 0: 1 (line 9)
`f`: negative numbers set to 0: 1 (line 11)
`f`: values that are not finite, skipped or set to 0: 1 (line 11)
`f`: indices of refraction of 0 set to 1: 1 (line 11)
`s`: values that are not finite, skipped or set to 0: 1 (line 13)
`s`: shapes without extent skipped: 1 (line 14)
`c`: shapes without extent skipped: 2 (first in line 15)
`c`: values that are not finite, skipped or set to 0: 1 (line 17)
`p`: values that are not finite, skipped or set to 0: 1 (line 18)
");
}

#[test]
fn every_error_has_a_message() {
    let view = |from: &str, to: &str| VIEW.replacen(from, to, 1);
    let texts = [
        // The view.
        String::new(),
        "# nothing\n".to_owned(),
        "s 0 0 0 1".to_owned(),
        MATERIAL.to_owned(),
        "v".to_owned(),
        "v\nfrom 0 0".to_owned(),
        "v\nfrom 0 0 1\nb 0 0 0\n".to_owned(),
        view("at 0 0 1\n", ""),
        view("resolution 320 200", "l 0 0 1"),
        view("up 0 0 1", "upp 0 0 1"),
        view("up 0 0 1", "up 0 0"),
        view("up 0 0 1", "up 0 0 1 2"),
        view("up 0 0 1", "up 0 1 0"),
        view("up 0 0 1", "up 0 0 0"),
        view("at 0 0 1", "at 0 -5 1"),
        view("at 0 0 1", "at 0 0 1 at 0 0 1"),
        view("angle 45", "angle 0"),
        view("angle 45", "angle 180"),
        view("angle 45", "angle wide"),
        view("hither 0.01", "hither -1"),
        view("320", "0"),
        view("320", "320.5"),
        view("320", "1000000"),
        format!("{VIEW}{VIEW}"),
        format!("{VIEW}angle 30"),
        file("angle 30"),
        // Other entities.
        file("x 1 2 3"),
        file("S 0 0 0 1"),
        file("sphere 0 0 0 1"),
        file("cylindr 0 0 0 1"),
        file("tapestry"),
        file("1 2 3"),
        file("b 0 0 -1"),
        file("l 1 2"),
        file("l 1 2 3 4"),
        file("l 1 2 3 4 5 -6"),
        format!("{VIEW}f 1 1 1 1 1 1 1"),
        format!("{VIEW}f 1 1 1 1 1 1 1 0"),
        format!("{VIEW}f 1 1 1 -1 1 1 0 1"),
        format!("{VIEW}f 1e30 1 1 1e30 1 1 0 1"),
        format!("{VIEW}s 0 0 0 1"),
        format!("{VIEW}p 3 0 0 0 1 0 0 0 1 0"),
        file("s 0 0 0"),
        file("s 0 0 0 s 0 0 0 1"),
        file("s 0 0 0 0"),
        file("s 0 0 0 1 1"),
        file("s 0 0 nan 1"),
        file("s 0 0 0x1 1"),
        file("s 0 0 0 1e39"),
        file("s 0 0 0 1,5"),
        file("c 0 0 0 1"),
        file("c 0 0 0 1 0 0 0 1"),
        file("c 0 0 0 0 0 0 1 0"),
        file("c 0 0 0 1 0 0 1 -1"),
        // Polygons.
        file("p"),
        file("p 0"),
        file("p -3"),
        file("p 3.5"),
        file("p many"),
        file("p 1000000\n0 0 0"),
        file("p 4\n0 0 0\n1 0 0\n0 1 0"),
        file("p 4\n0 0 0\n1 0 0\n0 1 0\np 3"),
        file("p 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0"),
        file("pp 3\n0 0 0\n1 0 0\n0 1 0\ns 0 0 0 1"),
        file("p 3\n0 0 0\n1 zero 0\n0 1 0"),
    ];
    assert_snapshot!(messages("a.nff", &texts), @r"
bad scene (a.nff): the file is empty. Check that it was written completely.
bad scene (a.nff:1:10): the file has no view (`v`). A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:1:1): no material (`f`) comes before this sphere. Begin objects with `f`.
bad scene (a.nff:1:28): the file has no view (`v`). A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:1:2): the file ends inside a view, before `from`. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:2:9): the file ends inside a view. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:3:1): the view before `b` has no `at`. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:6:19): the file ends inside a view, before `at`. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:7:1): the view before `l` has no `resolution`. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:4:1): unknown key `upp`, did you mean `up`? A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:5:1): `angle` starts a new entity inside a view. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:4:10): the view before `2` has no `angle`. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:1:1): `up` is zero or parallel to the viewing direction. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:1:1): `up` is zero or parallel to the viewing direction. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:1:1): `from` and `at` are the same point or not finite. Choose distinct points.
bad scene (a.nff:3:10): a second `at` in a view. Keep one of them.
bad scene (a.nff:5:7): the angle `0` is out of range. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:5:7): the angle `180` is out of range. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:5:7): `wide` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:6:8): `-1` in `v` is negative. Write 0 or more.
bad scene (a.nff:7:12): `0` is not a count of pixels. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:7:12): `320.5` is not a count of pixels. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:7:12): `1000000` is not a count of pixels. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:8:1): duplicate view. Keep one `v` in the file.
bad scene (a.nff:8:1): a second `angle` in a view. Keep one of them.
bad scene (a.nff:9:1): `angle` is outside a view. A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.
bad scene (a.nff:9:1): unknown entity `x`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:9:1): unknown entity `S`, did you mean `s`? Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:9:1): unknown entity `sphere`, did you mean `s`? Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:9:1): unknown entity `cylindr`, did you mean `c`? Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:9:1): unknown entity `tapestry`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:9:1): expected an entity, found `1`. Count the numbers before it.
bad scene (a.nff:9:7): `-1` in `b` is negative. Write 0 or more.
bad scene (a.nff:9:6): the file ends inside a light. A light is `l X Y Z` or `l X Y Z R G B`.
bad scene (a.nff:9:10): the file ends inside a light. A light is `l X Y Z` or `l X Y Z R G B`.
bad scene (a.nff:9:13): `-6` in `l` is negative. Write 0 or more.
bad scene (a.nff:8:16): the file ends inside a material. A material is `f R G B Kd Ks SHINE T INDEX`.
bad scene (a.nff:8:1): a transparent material needs an index of refraction. Write 1 or more as the last number.
bad scene (a.nff:8:9): `-1` in `f` is negative. Write 0 or more.
bad scene (a.nff:8:1): the colour times Kd is out of range. Write colours from 0 to 1.
bad scene (a.nff:8:1): no material (`f`) comes before this sphere. Begin objects with `f`.
bad scene (a.nff:8:1): no material (`f`) comes before this polygon. Begin objects with `f`.
bad scene (a.nff:9:8): the file ends inside a sphere. A sphere is `s X Y Z RADIUS`.
bad scene (a.nff:9:9): `s` starts a new entity inside a sphere. A sphere is `s X Y Z RADIUS`.
bad scene (a.nff:9:9): the radius `0` is zero. A sphere is `s X Y Z RADIUS`.
bad scene (a.nff:9:11): expected an entity, found `1`. Count the numbers before it.
bad scene (a.nff:9:7): `nan` is not a finite number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:9:7): `0x1` is hexadecimal, which is not accepted. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:9:9): `1e39` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:9:9): `1,5` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:9:10): the file ends inside a cone. A cone is `c X Y Z RADIUS` and the same of its other end.
bad scene (a.nff:9:1): both ends of a cone are the same point. A cone is `c X Y Z RADIUS` and the same of its other end.
bad scene (a.nff:9:17): both radii of a cone are zero. A cone is `c X Y Z RADIUS` and the same of its other end.
bad scene (a.nff:9:17): only one radius of a cone is negative. A cone is `c X Y Z RADIUS` and the same of its other end.
bad scene (a.nff:9:2): the file ends inside a polygon. A polygon is `p N` and N corners of 3 numbers.
bad scene (a.nff:9:3): `0` is not a count of corners. Write a whole number from 3 to 65536.
bad scene (a.nff:9:3): `-3` is not a count of corners. Write a whole number from 3 to 65536.
bad scene (a.nff:9:3): `3.5` is not a count of corners. Write a whole number from 3 to 65536.
bad scene (a.nff:9:3): `many` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.nff:9:3): `1000000` is not a count of corners. Write a whole number from 3 to 65536.
bad scene (a.nff:12:6): the file ends inside a polygon, after 3 of 4 corners. A polygon is `p N` and N corners of 3 numbers.
bad scene (a.nff:13:1): `p` starts a new entity inside a polygon, after 3 of 4 corners. A polygon is `p N` and N corners of 3 numbers.
bad scene (a.nff:13:1): expected an entity, found `0`. Count the numbers before it.
bad scene (a.nff:13:1): `s` starts a new entity inside a patch, after 1 of 3 corners. A patch is `pp N` and N corners of 6 numbers.
bad scene (a.nff:11:3): `zero` is not a number. Write a decimal number such as -0.5 or 2e3.
");
}

#[test]
fn a_scene_may_consist_of_lights_alone() {
    let scene = scene("a.nff", format!("{VIEW}l 0 0 1\n"));
    assert_eq!((scene.shapes.len(), scene.meshes.len()), (0, 0));
    assert_eq!(scene.materials.len(), 1);
}
