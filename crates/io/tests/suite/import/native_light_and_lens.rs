//! The native format: area lights, lenses and filters.

use super::{messages, scene};
use glam::{DVec3, Vec3};
use glimray::scene::{Attenuation, Filter, Lens, Light, LightKind, Scene};
use insta::assert_snapshot;

fn light(text: &str) -> Light {
    let mut scene = scene("a.toml", format!("[[lights]]\n{text}"));
    scene.lights.remove(0)
}

fn lens(text: &str) -> Lens {
    let camera = "[camera]\nlook_from = [0, 1, 5]\nlook_at = [0, 1, 1]\nfov_y_deg = 90";
    let scene: Scene = scene("a.toml", format!("{camera}\nlens = {{ {text} }}"));
    scene.cameras[0].lens.expect("a lens")
}

#[test]
fn missing_keys_of_area_lights_have_their_defaults() {
    let got = light("sphere = { center = [1, 2, 3], radius = 0.5 }");
    let kind = LightKind::Sphere {
        center: DVec3::new(1.0, 2.0, 3.0),
        radius: 0.5,
    };
    assert_eq!(
        got,
        Light {
            kind,
            color: Vec3::ONE,
            attenuation: Attenuation::InverseSquare,
            samples: 16,
            visible: true,
            node: None,
            name: String::new(),
        }
    );
}

#[test]
fn every_key_of_area_lights_has_an_effect() {
    let got = light(
        "disc = { center = [0, 4, 0], normal = [0, -2, 0], radius = 2, color = [1, 0.5, 0], intensity = 3, \
         samples = 5, visible = false, attenuation = 'none' }",
    );
    let kind = LightKind::Disc {
        center: DVec3::Y * 4.0,
        normal: DVec3::NEG_Y,
        radius: 2.0,
    };
    assert_eq!(
        got,
        Light {
            kind,
            color: Vec3::new(3.0, 1.5, 0.0),
            attenuation: Attenuation::None,
            samples: 5,
            visible: false,
            node: None,
            name: String::new(),
        }
    );
    let got = light("disc = { center = [0, 4, 0], look_at = [0, 4, -9], radius = 2 }");
    assert!(matches!(
        got.kind,
        LightKind::Disc {
            normal: DVec3::NEG_Z,
            ..
        }
    ));
    let got = light("rectangle = { center = [0, 4, 0], edge_u = [0, 0, 2], edge_v = [1, 0, 0] }");
    let kind = LightKind::Rectangle {
        center: DVec3::Y * 4.0,
        edge_u: DVec3::Z * 2.0,
        edge_v: DVec3::X,
    };
    assert_eq!(got.kind, kind);
}

#[test]
fn radiance_is_that_of_the_surface() {
    // A Lambertian emitter of area A and radiance L has an intensity of L A / π along its normal.
    let rows = [
        (
            "sphere = { center = [0, 0, 0], radius = 3, radiance = 2 }",
            18.0,
        ),
        (
            "disc = { center = [0, 0, 0], normal = [0, 1, 0], radius = 3, radiance = 2 }",
            18.0,
        ),
        (
            "rectangle = { center = [0, 9, 0], look_at = [0, 0, 0], size = [2, 3], radiance = 2 }",
            12.0 / std::f32::consts::PI,
        ),
    ];
    for (text, expected) in rows {
        let got = light(text).color;
        assert!((got - expected).length() < 1e-5 * expected, "{text}: {got}");
    }
}

#[test]
fn rectangles_face_look_at_and_are_level() {
    for look_at in [
        [3.0, 1.0, -2.0],
        [0.0, -5.0, 0.0],
        [0.0, 9.0, 0.0],
        [1e-9, -5.0, 0.0],
    ] {
        let text =
            format!("rectangle = {{ center = [0, 4, 0], look_at = {look_at:?}, size = [2, 6] }}");
        let LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } = light(&text).kind
        else {
            panic!("not a rectangle");
        };
        let normal = (DVec3::from(look_at) - center).normalize();
        let shines = edge_u.cross(edge_v).normalize();
        assert!(shines.dot(normal) > 1.0 - 1e-12, "{look_at:?}: {shines}");
        assert!((edge_u.length() - 1.0).abs() < 1e-12 && (edge_v.length() - 3.0).abs() < 1e-12);
        assert!(edge_u.y.abs() < 1e-8, "level: {edge_u}");
        assert!(edge_u.dot(edge_v).abs() < 1e-12);
    }
}

#[test]
fn lenses_have_an_aperture_and_a_focus() {
    let round = Lens {
        radius: 0.25,
        focus_distance: 4.0,
        blade_count: 0,
        blade_rotation: 0.0,
    };
    assert_eq!(lens("radius = 0.25"), round, "what it looks at is sharp");
    assert_eq!(
        lens("radius = 0.25, focus_distance = 7").focus_distance,
        7.0
    );
    // Only the part along the viewing direction counts.
    assert_eq!(
        lens("radius = 0.25, focus_on = [3, -8, -1]").focus_distance,
        6.0
    );
    let bladed = lens("radius = 0.25, blades = 6, blade_rotation_deg = -90");
    assert_eq!(
        (bladed.blade_count, bladed.blade_rotation),
        (6, -90_f64.to_radians())
    );
    // A field of view of 90° on 24 mm is a focal length of 12 mm; f/2 then has an aperture of 6 mm.
    assert!((lens("f_number = 2").radius - 0.003).abs() < 1e-12);
    assert!((lens("f_number = 2, sensor_height_mm = 48").radius - 0.006).abs() < 1e-12);
}

#[test]
fn the_output_names_filter_and_light_samples() {
    let text = "output = { filter = 'blackman-harris', filter_radius = 2, light_samples = 0.25 }";
    let output = scene("a.toml", text).output;
    assert_eq!(output.filter, Filter::BlackmanHarris);
    assert_eq!(
        (output.filter_radius, output.light_samples),
        (Some(2.0), 0.25)
    );
    let names = [
        ("box", Filter::Box),
        ("tent", Filter::Tent),
        ("gaussian", Filter::Gaussian),
        ("mitchell", Filter::Mitchell),
    ];
    for (name, filter) in names {
        let output = scene("a.toml", format!("output.filter = '{name}'")).output;
        assert_eq!((output.filter, output.filter_radius), (filter, None));
    }
}

#[test]
fn every_error_has_a_message() {
    let light = |text: &str| format!("[[lights]]\n{text}");
    let lens = |text: &str| {
        format!("[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nlens = {{ {text} }}")
    };
    let texts = [
        light("rectangle = { center = [0, 0, 0] }"),
        light("rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0] }"),
        light("rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [0, 0, 0] }"),
        light("rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [-2, 0, 0] }"),
        light(
            "rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [0, 1, 0], size = [1, 1] }",
        ),
        light("rectangle = { center = [0, 0, 0], look_at = [0, 0, 0], size = [1, 1] }"),
        light("rectangle = { center = [0, 0, 0], look_at = [0, 1, 0], size = [1, 0] }"),
        light("rectangle = { center = [0, 0, 0], look_at = [0, 1, 0], size = 1 }"),
        light("disc = { center = [0, 0, 0], normal = [0, 1, 0], radius = 0 }"),
        light("disc = { center = [0, 0, 0], normal = [0, 0, 0], radius = 1 }"),
        light("disc = { center = [0, 0, 0], radius = 1 }"),
        light("disc = { center = [0, 0, 0], normal = [0, 1, 0], look_at = [0, 1, 0], radius = 1 }"),
        light("disc = { center = [0, 0, 0], look_at = [0, 0, 0], radius = 1 }"),
        light("sphere = { center = [0, 0, 0], radius = 0 }"),
        light("sphere = { center = [0, 0, 0] }"),
        light("sphere = { center = [0, 0, 0], radius = 1, intensity = 1, radiance = 1 }"),
        light("sphere = { center = [0, 0, 0], radius = 1, radiance = -1 }"),
        light("sphere = { center = [0, 0, 0], radius = 1e-30 }"),
        light("sphere = { center = [0, 0, 0], radius = 1, samples = 0 }"),
        light("sphere = { center = [0, 0, 0], radius = 1, samples = 2.5 }"),
        light("sphere = { center = [0, 0, 0], radius = 1, two_sided = true }"),
        light("sphere = { center = [0, 0, 0], radius = 1 }\npoint = { position = [0, 0, 0] }"),
        lens(""),
        lens("radius = 0"),
        lens("radius = 1, f_number = 2"),
        lens("f_number = 0"),
        lens("f_number = -2"),
        lens("radius = 1, sensor_height_mm = 24"),
        lens("radius = 1, focus_distance = 0"),
        lens("radius = 1, focus_distance = -3"),
        lens("radius = 1, focus_on = [0, 0, 9]"),
        lens("radius = 1, focus_on = [3, 3, 5]"),
        lens("radius = 1, focus_on = [0, 0, 0], focus_distance = 5"),
        lens("radius = 1, blades = 1"),
        lens("radius = 1, blades = 2"),
        lens("radius = 1, blades = 5.5"),
        lens("radius = 1, blades = 65"),
        lens("radius = 1e20"),
        lens("radius = 10, focus_distance = 1e-6"),
        lens("aperture = 1"),
        "output.filter = 'lanczos'".to_owned(),
        "output.filter_radius = 0".to_owned(),
        "output.filter_radius = 100".to_owned(),
        "output.light_samples = 0".to_owned(),
        "output.light_samples = 1e30".to_owned(),
        lens("radius = 1e-300"),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r"
bad scene (a.toml:1:1): a rectangle needs its edges. Give it either `edge_u` and `edge_v`, or `look_at` and `size`.
bad scene (a.toml:1:1): a rectangle needs its edges. Give it either `edge_u` and `edge_v`, or `look_at` and `size`.
bad scene (a.toml:2:44): `edge_u` and `edge_v` span no area. Give two edges that are not parallel.
bad scene (a.toml:2:44): `edge_u` and `edge_v` span no area. Give two edges that are not parallel.
bad scene (a.toml:1:1): a rectangle needs its edges. Give it either `edge_u` and `edge_v`, or `look_at` and `size`.
bad scene (a.toml:2:45): `look_at` is the centre of the light itself. Move one of them.
bad scene (a.toml:2:63): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:63): invalid type: integer `1`, expected two numbers [width, height]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:59): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:39): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:1:1): a disc needs exactly one direction. Give it either `look_at` or `normal`.
bad scene (a.toml:1:1): a disc needs exactly one direction. Give it either `look_at` or `normal`.
bad scene (a.toml:2:40): `look_at` is the centre of the light itself. Move one of them.
bad scene (a.toml:2:41): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:10): the key `radius` is missing. Add `radius = …`.
bad scene (a.toml:1:1): there are both `intensity` and `radiance`. Leave out one of them.
bad scene (a.toml:2:55): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:1): its size or radiance is out of range: at most 3.4e38 is allowed. Make it darker, or change its size.
bad scene (a.toml:2:54): 0 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:2:54): 2.5 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:2:44): unknown key `two_sided`. Allowed here: `center`, `radius`, `color`, `intensity`, `radiance`, `samples`, `visible`, `attenuation`.
bad scene (a.toml:1:1): a light needs exactly one kind. Give it one of `point`, `directional`, `spot`, `rectangle`, `disc` and `sphere`.
bad scene (a.toml:4:8): a lens needs exactly one aperture. Give it either `radius` or `f_number`.
bad scene (a.toml:4:19): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:4:8): a lens needs exactly one aperture. Give it either `radius` or `f_number`.
bad scene (a.toml:4:21): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:4:21): -2 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:4:41): `sensor_height_mm` has no effect with `radius`. Give `f_number` instead of `radius`.
bad scene (a.toml:4:39): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:4:39): -3 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:4:33): `focus_on` is not in front of the camera. Give a point in front of it.
bad scene (a.toml:4:33): `focus_on` is not in front of the camera. Give a point in front of it.
bad scene (a.toml:4:33): there are both `focus_distance` and `focus_on`. Leave out one of them.
bad scene (a.toml:4:31): 1 is not a whole number from 3 to 64. See `glimray schema` for what is allowed.
bad scene (a.toml:4:31): 2 is not a whole number from 3 to 64. See `glimray schema` for what is allowed.
bad scene (a.toml:4:31): 5.5 is not a whole number from 3 to 64. See `glimray schema` for what is allowed.
bad scene (a.toml:4:31): 65 is not a whole number from 3 to 64. See `glimray schema` for what is allowed.
bad scene (a.toml:4:8): the lens is out of proportion: its radius must be at most 1e9, and at most a million times its focus distance. Make it smaller.
bad scene (a.toml:4:8): the lens is out of proportion: its radius must be at most 1e9, and at most a million times its focus distance. Make it smaller.
bad scene (a.toml:4:10): unknown key `aperture`. Allowed here: `radius`, `f_number`, `sensor_height_mm`, `focus_distance`, `focus_on`, `blades`, `blade_rotation_deg`, `blade_rotation`.
bad scene (a.toml:1:17): unknown value `lanczos`. Allowed here: `box`, `tent`, `gaussian`, `blackman-harris`, `mitchell`.
bad scene (a.toml:1:24): 0 is not between 0.01 and 16. See `glimray schema` for what is allowed.
bad scene (a.toml:1:24): 100 is not between 0.01 and 16. See `glimray schema` for what is allowed.
bad scene (a.toml:1:24): 0 is not between 0.001 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:24): 1e30 is not between 0.001 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:4:19): 1e-300 is out of range: at least 1.2e-38 is allowed. See `glimray schema` for what is allowed.
");
}

#[test]
fn the_schema_knows_every_key() {
    let schema = glimray::import::native_schema();
    let text = serde_json::to_string(&schema).expect("JSON");
    let tables = [
        "output.?=1",
        "camera.lens.?=1",
        "lights=[{?=1}]",
        "lights=[{rectangle={?=1}}]",
        "lights=[{disc={?=1}}]",
        "lights=[{sphere={?=1}}]",
    ];
    for table in tables {
        let error = messages("a.toml", &[table.replace('?', "qqqqqq")]);
        let (_, known) = error
            .split_once("Allowed here: ")
            .unwrap_or_else(|| panic!("{error}"));
        for key in known.split('`').skip(1).step_by(2) {
            assert!(
                text.contains(&format!("\"{key}\":{{")),
                "{key} of {table} is in the schema"
            );
        }
    }
}
