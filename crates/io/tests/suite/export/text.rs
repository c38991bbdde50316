//! The text of an export and the files beside it.

use super::write;
use glam::{DAffine3, DVec3, Vec3, Vec4};
use glimray::export::{self, ExportError};
use glimray::import;
use glimray::scene::{
    Camera, CanonicalShape, Geometry, Instance, Light, LightKind, Material, Mesh, Phong, Picture,
    Scene, Shape, Texels,
};
use std::path::Path;
use std::sync::Arc;

fn scene() -> Scene {
    Scene {
        materials: vec![Material::default()],
        cameras: vec![Camera {
            fov_y: 60_f64.to_radians(),
            ..Camera::default()
        }],
        ..Scene::default()
    }
}

fn text(scene: &Scene) -> String {
    export::native(scene, "s", &|_, _| false)
        .expect("an export")
        .text
}

fn load(name: &str) -> Scene {
    let folder = Path::new("assets/scenes");
    import::load(&folder.join(name)).expect("a scene")
}

#[test]
fn numbers_are_written_as_in_the_original_file() {
    let text = text(&load("glass_and_mirrors.toml"));
    for line in [
        "look_from = [0, 2.5, 9.2]",
        "fov_y_deg = 28.5",
        "checker = { a = \"#e6ddcf\", b = \"#76899a\" }",
        "rotate_deg = [0, 32, 0]",
        "refract = { absorption = [0.1, 0.03, 0.05] }",
        "sphere = { center = [-2.35, 1.05, -1.1], radius = 1.05 }",
        "transform = { translate = [2.75, 0.5, 0.55], rotate_deg = [0, 27, 0], scale = 0.5 }",
        "torus = { center = [-2.05, 0.2, 1.75], major_radius = 0.52, minor_radius = 0.2 }",
        "cone = { from = [-3.4, 0, 0.35], to = [-3.4, 1.3, 0.35], from_radius = 0.52 }",
    ] {
        assert!(
            text.lines().any(|found| found == line),
            "{line} is not in\n{text}"
        );
    }
}

#[test]
fn default_values_are_not_written() {
    let text = text(&scene());
    let said: Vec<_> = text
        .lines()
        .filter(|l| !l.is_empty() && !l.starts_with('#'))
        .collect();
    let camera = ["[camera]", "look_from = [0, 0, 0]", "look_at = [0, 0, -1]"];
    // The native format's default exponent is 32.
    let material = ["[materials.\"material 1\"]", "phong = { shininess = 1 }"];
    assert_eq!(said, [&camera[..], &material[..]].concat());
}

#[test]
fn missing_and_duplicate_names_become_unique() {
    let named = |name: &str, red: f32| Material {
        name: name.to_owned(),
        bsdf: Phong {
            diffuse: Vec3::new(red, 0.0, 0.0),
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    let mut scene = scene();
    let names = ["a", "", "a", "material 2", "strange \"name\"\n[x]", ""];
    scene.materials = (1..)
        .zip(names)
        .map(|(i, name)| named(name, i as f32))
        .collect();
    let export = export::native(&scene, "s", &|_, _| false).expect("an export");
    let (_folder, path) = write(&export, "s");
    let read = import::load(&path).expect("a scene");
    let read: Vec<_> = read
        .materials
        .iter()
        .map(|m| (m.classical().diffuse.x, m.name.as_str()))
        .collect();
    let strange = names[4];
    assert_eq!(
        read,
        [
            (1.0, "a"),
            (2.0, "material 3"),
            (3.0, "a 2"),
            (4.0, "material 2"),
            (5.0, strange),
            (6.0, "material 6")
        ]
    );
}

#[test]
fn names_of_objects_and_lights_come_back_unique() {
    let mut scene = scene();
    let names = ["", "ball", "ball", "arm", "sphere 9"];
    scene.shapes = (names.iter().enumerate())
        .map(|(index, name)| Shape {
            geometry: Geometry::Sphere {
                center: DVec3::X * index as f64,
                radius: 0.5,
            },
            material: 0,
            node: None,
            name: (*name).to_owned(),
        })
        .collect();
    scene.nodes = vec![glimray::scene::Node {
        name: "arm".to_owned(),
        ..glimray::scene::Node::default()
    }];
    let lamp = |name: &str| glimray::scene::Light {
        color: Vec3::ONE,
        name: name.to_owned(),
        ..glimray::scene::Light::default()
    };
    scene.lights = ["", "lamp", "lamp"].map(lamp).into();
    let export = export::native(&scene, "s", &|_, _| false).expect("an export");
    let (_folder, path) = write(&export, "s");
    let read = import::load(&path).expect("a scene");
    let shapes: Vec<_> = read.shapes.iter().map(|it| it.name.as_str()).collect();
    // Objects and nodes share their names.
    assert_eq!(shapes, ["", "ball", "ball 2", "arm 2", "sphere 9"]);
    let lights: Vec<_> = read.lights.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(lights, ["", "lamp", "lamp 2"]);
    let again = export::native(&read, "s", &|_, _| false).expect("an export");
    assert_eq!(again.text, export.text);
}

#[test]
fn many_copies_become_one_object_and_a_file_of_placements() {
    let mut scene = scene();
    scene.shapes = (0..5000_u32)
        .map(|i| Shape {
            geometry: Geometry::Sphere {
                center: DVec3::new(0.1 * f64::from(i), 0.0, -1.0 / 3.0),
                radius: 0.01 + 1e-7 * f64::from(i),
            },
            material: 0,
            node: None,
            name: String::new(),
        })
        .collect();
    let export = export::native(&scene, "s", &|_, _| false).expect("an export");
    assert_eq!(
        export.text.matches("[[objects]]").count(),
        1,
        "{}",
        export.text
    );
    assert_eq!(export.files.len(), 1);
    let (_folder, path) = write(&export, "s");
    assert_eq!(import::load(&path).expect("a scene").shapes, scene.shapes);
    // Numbers that the window gave to keep labels are not worth an object each; a name of all is kept.
    for (index, shape) in (1..).zip(&mut scene.shapes) {
        shape.name = format!("sphere {index}");
    }
    let numbered = export::native(&scene, "s", &|_, _| false).expect("an export");
    assert_eq!(numbered.text, export.text);
    for shape in &mut scene.shapes {
        shape.name = "grain".to_owned();
    }
    let named = export::native(&scene, "s", &|_, _| false).expect("an export");
    assert_eq!(named.text.matches("name = \"grain\"").count(), 1);
    let (_folder, path) = write(&named, "s");
    assert_eq!(import::load(&path).expect("a scene").shapes, scene.shapes);
}

#[test]
fn a_scene_beyond_the_size_limit_is_refused() {
    let mut scene = scene();
    scene.shapes = (0..60_000_u32)
        .map(|i| Shape {
            geometry: Geometry::Placed {
                canonical: CanonicalShape::Torus {
                    minor: 0.1 + 1e-6 * f64::from(i),
                },
                world_from_canonical: DAffine3::IDENTITY,
            },
            material: 0,
            node: None,
            name: String::new(),
        })
        .collect();
    let error = export::native(&scene, "s", &|_, _| false).expect_err("too much");
    assert!(matches!(error, ExportError::TooBig { marks, limit: 500_000, .. } if marks > 500_000));
    assert_eq!(error.to_string().lines().count(), 1);
}

#[test]
fn a_picture_is_a_png_if_8_bits_suffice_and_otherwise_an_exr() {
    let picture = |texels: Texels| {
        let mut scene = scene();
        scene.pictures.push(Arc::new(Picture {
            width: 2,
            height: 1,
            texels,
            origin: glimray::scene::Origin::Texels,
        }));
        scene.background = glimray::scene::Background::Picture {
            picture: 0,
            strength: 1.0,
            rotation: 1.0,
        };
        let export = export::native(&scene, "s", &|_, _| false).expect("an export");
        let (_folder, path) = write(&export, "s");
        let read = import::load(&path).expect("a scene");
        assert_eq!(read.pictures, scene.pictures);
        assert_eq!(read.background, scene.background);
        export.files[0].name.clone()
    };
    let codes = Texels::Srgb8(vec![[0, 77, 255, 255], [1, 2, 3, 4]]);
    assert_eq!(picture(codes), "s-picture-1.png");
    let levels = Texels::Float(vec![Vec4::ZERO, Vec4::ONE]);
    assert_eq!(picture(levels), "s-picture-1.png");
    let odd = Vec4::new(0.1, 1e-8, 12345.678, 0.5);
    assert_eq!(
        picture(Texels::Float(vec![Vec4::ONE, odd])),
        "s-picture-1.exr"
    );
}

#[test]
fn existing_files_are_kept() {
    let mut scene = scene();
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    scene.meshes.push(Arc::new(Mesh {
        name: "sail/../../x".to_owned(),
        positions: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
        normals: vec![Vec3::Z; 3],
        materials: vec![0; 3],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    }));
    scene.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::IDENTITY,
        node: None,
        name: String::new(),
    });
    let name = |taken: &dyn Fn(&str, &[u8]) -> bool| {
        let export = export::native(&scene, "s", taken).expect("an export");
        let name = export.files[0].name.clone();
        assert!(export.text.contains(&format!("\"{name}\"")));
        name
    };
    assert_eq!(name(&|_, _| false), "s-sail_______x.ply");
    assert_eq!(
        name(&|name, _| !name.contains("-3.")),
        "s-sail_______x-3.ply"
    );
}

#[test]
fn a_sky_is_written_as_its_sun() {
    for (elevation, azimuth, line) in [
        (45.0_f64, -135.0_f64, "background = \"sky\""),
        (
            12.5,
            30.0,
            "background = { sky = { elevation_deg = 12.5, azimuth_deg = 30 } }",
        ),
    ] {
        let mut scene = scene();
        let picture = glimray::scene::sky::picture(elevation.to_radians(), azimuth.to_radians());
        scene.pictures.push(Arc::new(picture));
        scene.background = glimray::scene::Background::Picture {
            picture: 0,
            strength: 1.0,
            rotation: 0.0,
        };
        let export = export::native(&scene, "s", &|_, _| false).expect("an export");
        assert!(
            export.text.lines().any(|found| found == line),
            "{}",
            export.text
        );
        assert!(export.files.is_empty());
        super::loss(&scene).unwrap_or_else(|lost| panic!("{lost}"));
    }
}

#[test]
fn a_built_in_environment_is_written_by_its_name() {
    use glimray::scene::{Background, BuiltIn};
    for environment in BuiltIn::ALL {
        let name = environment.entry().name;
        for (strength, line) in [
            (1.0, format!("background = \"{name}\"")),
            (
                2.5,
                format!("background = {{ environment = \"{name}\", strength = 2.5 }}"),
            ),
        ] {
            let mut scene = scene();
            scene.set_built_in(*environment);
            if let Background::Picture { strength: own, .. } = &mut scene.background {
                *own = strength;
            }
            let export = export::native(&scene, "s", &|_, _| false).expect("an export");
            let is_there = export.text.lines().any(|found| found == line);
            assert!(is_there, "{line}: {}", export.text);
            assert!(export.files.is_empty());
            super::loss(&scene).unwrap_or_else(|lost| panic!("{lost}"));
        }
    }
}

/// The sky's texels lack the sun, so a picture is no way out.
#[test]
fn a_sky_at_radians_that_no_degrees_give_is_written_with_the_nearest() {
    // Near 46° neighbouring degrees are farther apart than neighbouring radians.
    let is_given = |radians: f64| {
        let near = radians.to_degrees();
        [near, near.next_up(), near.next_down()]
            .iter()
            .any(|degrees| degrees.to_radians() == radians)
    };
    let mut others = (0..1000_u64)
        .map(|step| f64::from_bits(0.8_f64.to_bits() + step))
        .filter(|radians| !is_given(*radians));
    let radians = others.next().expect("radians without degrees");
    let mut scene = scene();
    let picture = glimray::scene::sky::picture(radians, 0.0);
    scene.pictures.push(Arc::new(picture));
    scene.background = glimray::scene::Background::Picture {
        picture: 0,
        strength: 1.0,
        rotation: 0.0,
    };
    let export = export::native(&scene, "s", &|_, _| false).expect("an export");
    let line = export
        .text
        .lines()
        .find(|line| line.starts_with("background"));
    let line = line.expect("a background");
    let written = line
        .split("elevation_deg = ")
        .nth(1)
        .and_then(|rest| rest.split(',').next());
    let written: f64 = written.expect(line).trim().parse().expect("a number");
    assert!((written.to_radians() - radians).abs() < 1e-15, "{line}");
}

/// Degrees of so narrow a cone are refused: it is written in radians.
#[test]
fn a_spot_light_as_narrow_as_files_may_have_it_is_read_back() {
    let kind = LightKind::Spot {
        position: DVec3::Y,
        direction: DVec3::NEG_Y,
        inner: 0.0,
        outer: 0.0006,
    };
    let written = Scene {
        lights: vec![Light {
            kind,
            ..Light::default()
        }],
        ..scene()
    };
    let options = import::Options::default();
    let read = import::parse("s.toml", &text(&written), &options).expect("a scene");
    assert_eq!(read.lights[0].kind, kind);
}
