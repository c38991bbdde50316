//! Textures and backgrounds in whole pictures, against the f64 evaluation in `reference::textures`.

use crate::reference::compare::{
    assert_none, check_alike, check_same_bits, fetched, render, sized, start,
};
use crate::reference::scenes::{self, Build};
use crate::reference::{textures, trace};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DQuat, DVec2, DVec3, Vec2, Vec3, Vec4, dvec3, vec3};
use glimray::image::Image;
use glimray::render::{Fetch, Tone};
use glimray::scene::{
    Background, Camera, Material, Minify, Pattern, Phong, PhongTextures, Picture, Scene, Space,
    Texels, Texture, Wrap,
};
use glimray::{import, pack};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::process::Command;
use std::sync::Arc;

/// Five by three texels of random colours that are exact in half floats.
fn picture(seed: u64) -> Picture {
    let mut random = Random::new(seed);
    let mut channel = || random.below(64) as f32 / 64.0;
    let colors = (0..15).map(|_| vec3(channel(), channel(), channel()));
    Picture::opaque(5, 3, colors)
}

fn pattern_texture(pattern: Pattern, space: Space, space_from_pattern: DAffine3) -> Texture {
    Texture {
        pattern,
        space,
        pattern_from_space: space_from_pattern.inverse(),
    }
}

/// Without a mipmap, which the tracer in f64 lacks.
fn in_full(nearest: bool) -> Minify {
    match nearest {
        true => Minify::Nearest,
        false => Minify::Linear,
    }
}

const A: Vec3 = vec3(0.9, 0.8, 0.1);
const B: Vec3 = vec3(0.1, 0.2, 0.6);

fn patterns() -> [Pattern; 6] {
    let (a, b) = (A, B);
    let picture = |nearest| Pattern::Picture {
        picture: 0,
        nearest,
        minify: in_full(nearest),
        wrap: [Wrap::Repeat; 2],
    };
    [
        Pattern::Checker { a, b },
        Pattern::Stripes { a, b },
        Pattern::Gradient { a, b },
        Pattern::Noise { a, b, octaves: 4 },
        picture(false),
        picture(true),
    ]
}

/// Spheres, planes and a mesh, with a texture in one or more slots of each material.
fn textured_scene() -> Scene {
    let mut scene = scenes::spheres();
    scene.pictures.push(picture(1).into());
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, -0.4);
    for (i, pattern) in patterns().into_iter().enumerate() {
        let scale = DVec3::splat(0.31 + 0.05 * i as f64);
        let place = DAffine3::from_scale_rotation_translation(scale, turn, dvec3(0.1, 0.2, 0.3));
        scene
            .textures
            .push(pattern_texture(pattern, Space::World, place));
    }
    let shrunk = DAffine3::from_scale(dvec3(0.5, 0.25, 1.0));
    for pattern in patterns() {
        scene
            .textures
            .push(pattern_texture(pattern, Space::Uv, shrunk));
    }
    // Each slot alone, and several at once.
    let slots = |diffuse, specular, ambient| PhongTextures {
        diffuse,
        specular,
        ambient,
        ..PhongTextures::default()
    };
    scene.materials[0].classical_mut().textures = slots(Some(0), None, Some(0));
    scene.materials[1].classical_mut().textures = slots(Some(3), Some(1), Some(2));
    scene.materials[2].classical_mut().textures = slots(None, Some(4), None);
    scene.materials[3].classical_mut().textures = slots(Some(4), None, None);
    for slot in 6..12 {
        let material = scene.add_material(Material::from(Phong {
            textures: slots(Some(slot), None, Some(slot)),
            ..Phong::default()
        }));
        let mut quad = scenes::quad(0.85, material as u32);
        quad.uvs = [[-0.3, -0.2], [1.1, 0.0], [1.4, 1.2], [0.1, 1.0]]
            .map(Vec2::from)
            .into();
        let x = 0.9 * (slot as f64 - 8.5);
        let place =
            DAffine3::from_translation(dvec3(x, 2.2, -1.0)) * DAffine3::from_rotation_x(FRAC_PI_2);
        scene.add_mesh(quad, place);
    }
    scene
}

pub fn under_a_gradient() -> Scene {
    Scene {
        background: Background::Gradient {
            bottom: vec3(0.9, 0.4, 0.1),
            top: vec3(0.1, 0.2, 0.8),
        },
        ..textured_scene()
    }
}

pub fn under_a_picture() -> Scene {
    Scene {
        background: Background::Picture {
            picture: 0,
            strength: 0.75,
            rotation: 1.1,
        },
        ..textured_scene()
    }
}

#[test]
fn pictures_of_textured_scenes_match_an_independent_tracer() {
    let rows = [
        ("textures under a gradient", under_a_gradient()),
        ("textures under a picture", under_a_picture()),
    ];
    assert_none(rows.map(|(name, scene)| {
        let expected = trace(&scene, (256, 192)).image;
        let (actual, _) = render(&scene, &sized(256, 192));
        // An edge in a pattern is as sharp as one between surfaces: pixels on it may differ.
        check_alike(name, &expected, &actual, 2.0, 0.002)
    }));
}

#[test]
fn images_and_buffers_fetch_the_same_textures() {
    let scene = textured_scene();
    let of = |fetch| render(&scene, &fetched(&sized(96, 72), fetch)).0;
    assert_none([check_same_bits(
        "textures",
        &of(Fetch::Image),
        &of(Fetch::Buffer),
    )]);
}

/// A plane seen face-on with only ambient colour, so that a pixel has the value of the texture.
fn flat(texture: Texture, pictures: Vec<Picture>, at: DVec3) -> Scene {
    let mut scene = Scene {
        ambient: Vec3::ONE,
        pictures: pictures.into_iter().map(Arc::new).collect(),
        textures: vec![texture],
        cameras: vec![Camera {
            look_from: at + dvec3(0.0, 0.0, 2.0),
            look_at: at,
            fov_y: FRAC_PI_2,
            ..Camera::default()
        }],
        materials: vec![Material::from(Phong {
            ambient: Vec3::ONE,
            textures: PhongTextures {
                ambient: Some(0),
                ..PhongTextures::default()
            },
            ..Phong::default()
        })],
        ..Scene::default()
    };
    scene.add_plane(at, DVec3::Z, 0);
    scene
}

#[test]
fn texels_of_every_kind_are_found_in_pictures_of_several_layers() {
    // More words than the 4,194,304 of a layer, behind a picture that shifts them.
    let (width, height) = (2051, 2053);
    let code = |index: u32| (index.wrapping_mul(2_654_435_761) >> 8).to_le_bytes();
    let codes: Vec<_> = (0..width * height).map(code).collect();
    let value =
        |[r, g, b, a]: [u8; 4]| Vec4::from([r, g, b, a].map(|code| f32::from(code) / 256.0));
    let kinds = [
        Texels::Float(codes.iter().map(|code| value(*code)).collect()),
        Texels::Linear8(codes.clone()),
        Texels::Srgb8(codes),
    ];
    let mut verdict = Verdict::on("large pictures");
    for (name, texels) in ["float", "linear8", "srgb8"].into_iter().zip(kinds) {
        let pattern = Pattern::Picture {
            picture: 1,
            nearest: true,
            minify: Minify::Nearest,
            wrap: [Wrap::Repeat; 2],
        };
        let place = DAffine3::from_scale(DVec3::splat(3.9));
        let large = Picture {
            width,
            height,
            texels,
            origin: glimray::scene::Origin::Texels,
        };
        let texture = pattern_texture(pattern, Space::World, place);
        let scene = flat(texture, vec![picture(2), large], DVec3::ZERO);
        let (image, _) = render(&scene, &sized(64, 64));
        let large: Vec<_> = scene.pictures[1].linear().collect();
        for (i, pixel) in image.pixels.iter().enumerate() {
            let place = seen(i, 64) / 3.9;
            let cell = |at: f64, count: u32| (at.rem_euclid(1.0) * f64::from(count)).floor() as u32;
            let row = height - 1 - cell(place.y, height);
            let expected = large[(row * width + cell(place.x, width)) as usize].truncate();
            let off = (Vec3::from_slice(pixel) - expected).abs().max_element();
            verdict.that(format!("{name} at {place}"), off < 1e-3, || {
                format!("{pixel:?}, not {expected}")
            });
        }
    }
    verdict.close();
}

/// The point of the plane of [`flat`] seen at a pixel centre, from `at`.
fn seen(index: usize, size: u32) -> DVec2 {
    let middle = |i: usize| (i as f64 + 0.5) / f64::from(size) * 4.0 - 2.0;
    DVec2::new(
        middle(index % size as usize),
        -middle(index / size as usize),
    )
}

#[test]
fn texels_blend_as_in_f64_across_the_seam_and_far_from_it() {
    let mut problems = Vec::new();
    let (repeat, clamp, mirror) = (Wrap::Repeat, Wrap::Clamp, Wrap::Mirror);
    let wraps = [
        [repeat; 2],
        [clamp, mirror],
        [mirror, repeat],
        [repeat, clamp],
    ];
    for (nearest, wrap) in [false, true]
        .into_iter()
        .flat_map(|it| wraps.map(|wrap| (it, wrap)))
    {
        for offset in [0.0, 1000.0] {
            let pattern = Pattern::Picture {
                picture: 0,
                nearest,
                minify: in_full(nearest),
                wrap,
            };
            let move_by = DAffine3::from_translation(dvec3(offset, -offset, 0.0));
            let texture = pattern_texture(pattern, Space::World, move_by);
            let scene = flat(texture, vec![picture(2)], DVec3::ZERO);
            let (image, _) = render(&scene, &sized(96, 96));
            assert_eq!(image.pixels.len(), 96 * 96);
            for (i, pixel) in image.pixels.iter().enumerate() {
                let p = seen(i, 96).extend(0.0);
                let expected = textures::color_at(&scene, &scene.textures[0], p, DVec2::ZERO);
                let got = Vec3::from_slice(pixel).as_dvec3();
                if (got - expected).abs().max_element() > 2e-4 {
                    problems.push(format!("{nearest} {offset} {p}: {got} for {expected}"));
                }
            }
        }
    }
    // A hard edge may fall on either side in a few pixels.
    assert!(problems.len() < 40, "{}", problems.len());
    problems.retain(|problem| problem.starts_with("false"));
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn patterns_far_from_the_origin_are_as_fine_as_near_it() {
    // Shifted by whole periods of every pattern, and the same in f64.
    let far = dvec3(256e6, -128e6, 64e6);
    let mut problems = Vec::new();
    for (i, pattern) in patterns().into_iter().enumerate() {
        let texture = pattern_texture(pattern, Space::World, DAffine3::IDENTITY);
        let near = render(
            &flat(texture.clone(), vec![picture(3)], DVec3::ZERO),
            &sized(64, 64),
        );
        if matches!(texture.pattern, Pattern::Gradient { .. }) {
            continue;
        }
        let moved = render(&flat(texture, vec![picture(3)], far), &sized(64, 64));
        problems.push(check_alike(
            &format!("pattern {i}"),
            &near.0,
            &moved.0,
            0.5,
            0.002,
        ));
    }
    assert_none(problems);
}

#[test]
fn a_floor_at_the_boundary_of_a_checkers_cells_is_clean() {
    let checker = Pattern::Checker {
        a: Vec3::ONE,
        b: Vec3::ZERO,
    };
    // The floor is at an integer cell boundary, and the camera is not.
    for scale in [1.0, 0.1, 7.0] {
        let texture = pattern_texture(checker.clone(), Space::World, {
            DAffine3::from_scale(DVec3::splat(scale))
        });
        let mut scene = flat(texture, Vec::new(), DVec3::ZERO);
        scene.shapes.clear();
        scene.add_plane(dvec3(0.0, -3.0 * scale, 0.0), DVec3::Y, 0);
        let eye = scale * dvec3(0.37, 3.71, 0.0);
        scene.cameras[0].look_from = eye;
        scene.cameras[0].look_at = eye + scale * dvec3(0.3, -1.7, -1.0);
        let (image, _) = render(&scene, &sized(160, 120));
        let expected = trace(&scene, (160, 120)).image;
        let wrong = (image.pixels.iter().zip(&expected.pixels))
            .filter(|(a, b)| (a[0] - b[0]).abs() > 0.5)
            .count();
        // There are 19,200 pixels; a pixel exactly on an edge may be either colour.
        assert!(wrong <= 8, "scale {scale}: {wrong} speckles");
    }
}

/// The background seen by a narrow camera that looks along `direction`.
fn glimpse(scene: &mut Scene, direction: DVec3) -> DVec3 {
    let up = direction.any_orthonormal_vector();
    scene.cameras[0] = Camera {
        look_from: DVec3::ZERO,
        look_at: direction,
        up,
        fov_y: 1e-3,
        ..Camera::default()
    };
    let (image, _) = render(scene, &sized(1, 1));
    Vec3::from_slice(&image.pixels[0]).as_dvec3()
}

#[test]
fn the_background_is_where_it_should_be_along_the_axes_however_it_is_turned() {
    // Eight by four texels that encode their position.
    let texels = (0..32).map(|i| vec3((i % 8) as f32, (i / 8) as f32, 1.0));
    let mut scene = scenes::empty();
    let picture = Picture::opaque(8, 4, texels);
    scene.pictures.push(Arc::new(picture));
    // Column boundaries: ahead is between 3 and 4, right between 5 and 6, left between 1 and 2.
    let axes = [(DVec3::NEG_Z, 3.5), (DVec3::X, 5.5), (DVec3::NEG_X, 1.5)];
    let mut verdict = Verdict::on("the background");
    for quarters in 0..4 {
        scene.background = Background::Picture {
            picture: 0,
            strength: 0.5,
            rotation: f64::from(quarters) * FRAC_PI_2,
        };
        // Rotated counter-clockwise from above, the front moves to the left: 2 columns per quarter turn.
        let turned = |column: f64| (column + 2.0 * f64::from(quarters)).rem_euclid(8.0);
        for (direction, column) in axes {
            let got = glimpse(&mut scene, direction);
            let column = turned(column);
            // Between the last column and the first.
            let expected = if column > 7.0 { 3.5 } else { column };
            let expected = 0.5 * dvec3(expected, 1.5, 1.0);
            let is_near = (got - expected).length() <= 1e-3;
            verdict.that(format!("{quarters}, {direction}"), is_near, || {
                format!("{got}, not {expected}")
            });
        }
        for (direction, row) in [(DVec3::Y, 0.0), (DVec3::NEG_Y, 3.0)] {
            let got = glimpse(&mut scene, direction);
            let is_near = (got.y - 0.5 * row).abs() <= 1e-3;
            verdict.that(format!("{quarters}, {direction}"), is_near, || {
                format!("row {}", 2.0 * got.y)
            });
        }
        let got = glimpse(&mut scene, DVec3::Z);
        let expected = textures::background(&scene, DVec3::Z);
        let is_near = (got - expected).length() <= 2e-3;
        verdict.that(format!("{quarters}, behind"), is_near, || {
            format!("{got}, not {expected}")
        });
    }
    verdict.close();
}

#[test]
fn one_bright_texel_is_seen_in_its_direction_alone() {
    const WIDTH: u32 = 64;
    const HEIGHT: u32 = 32;
    for (column, row) in [(0, 0), (63, 31), (63, 16), (0, 16), (20, 5), (45, 30)] {
        let mut texels = vec![Vec3::ZERO; (WIDTH * HEIGHT) as usize];
        texels[(row * WIDTH + column) as usize] = vec3(100.0, 50.0, 25.0);
        let mut scene = scenes::empty();
        let picture = Picture::opaque(WIDTH, HEIGHT, texels);
        scene.pictures.push(Arc::new(picture));
        scene.background = Background::Picture {
            picture: 0,
            strength: 1.0,
            rotation: 0.0,
        };
        // The centre of the texel, by longitude to the right of -Z and latitude.
        let toward = |column: f64, row: f64| {
            let around = (column + 0.5) / f64::from(WIDTH) * TAU - PI;
            let up = PI / 2.0 - (row + 0.5) / f64::from(HEIGHT) * PI;
            dvec3(around.sin() * up.cos(), up.sin(), -around.cos() * up.cos())
        };
        let (column, row) = (f64::from(column), f64::from(row));
        let bright = glimpse(&mut scene, toward(column, row));
        assert!(
            (bright - dvec3(100.0, 50.0, 25.0)).length() < 0.1,
            "{column} {row}: {bright}"
        );
        for (right, down) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let row = row + down;
            if (0.0..32.0).contains(&row) {
                let dark = glimpse(&mut scene, toward(column + right, row));
                assert!(
                    dark.length() < 0.1,
                    "{column} {row}, {right} {down}: {dark}"
                );
            }
        }
    }
}

#[test]
fn another_frame_may_have_another_kind_of_background() {
    let mut scene = scenes::empty();
    let colour = scene.clone();
    scene.background = Background::Gradient {
        bottom: Vec3::X,
        top: Vec3::Z,
    };
    let expected = trace(&scene, (32, 24)).image;
    let mut renderer = start(&colour, &sized(32, 24)).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let packed = pack::scene(&scene).expect("packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    renderer.set_frame(&view).expect("another frame");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let actual: Image = renderer.develop(&Tone::LINEAR).expect("a picture");
    assert_none([check_alike("gradient", &expected, &actual, 1.0, 0.0)]);
}

#[test]
fn the_scene_of_patterns_matches_an_independent_tracer() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/scenes/patterns.toml");
    let mut scene = import::load(path.as_ref()).unwrap_or_else(|error| panic!("{error}"));
    for texture in &mut scene.textures {
        if let Pattern::Picture {
            nearest, minify, ..
        } = &mut texture.pattern
        {
            *minify = in_full(*nearest);
        }
    }
    let expected = trace(&scene, (320, 180)).image;
    let (actual, _) = render(&scene, &sized(320, 180));
    // Near the horizon the cells of the floor are smaller than pixels, where any rounding error picks another
    // cell.
    assert_none([check_alike("patterns", &expected, &actual, 2.0, 0.005)]);
}

#[test]
fn more_textures_than_materials_can_tell_apart_are_refused() {
    let mut scene = scenes::empty();
    let texture = pattern_texture(patterns()[0].clone(), Space::World, DAffine3::IDENTITY);
    scene.textures = vec![texture; 65_535];
    assert!(pack::scene(&scene).is_ok());
    scene.textures.push(scene.textures[0].clone());
    let error = pack::scene(&scene).expect_err("too many");
    assert!(error.to_string().contains("65536 textures"), "{error}");
}

#[test]
fn inspect_lists_textures_and_pictures() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/scenes/patterns.toml");
    let inspect = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimray"));
        let output = command.args(["inspect", path]).args(more).output();
        String::from_utf8(output.expect("the program runs").stdout).expect("text")
    };
    let text = inspect(&[]);
    for line in [
        "noise over world, ",
        "picture over world, picture 0",
        "128×128 texels",
    ] {
        assert!(text.contains(line), "{line} in\n{text}");
    }
    let json: serde_json::Value = serde_json::from_str(&inspect(&["--json"])).expect("JSON");
    let list = json["texture_list"].as_array().expect("a list");
    assert!(list.iter().any(|texture| texture["pattern"] == "checker"));
    assert_eq!(
        json["picture_list"][0]["size"],
        serde_json::json!([128, 128])
    );
}
