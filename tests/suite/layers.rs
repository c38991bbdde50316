//! The layers of pictures: closed forms, exact merging, and the channels of files.

use crate::film::{bytes, cut, film, merged, stratified, traced};
use crate::reference::compare::{sized, sliced};
use crate::reference::scenes::{self, Build};
use crate::support::program::Workspace;
use crate::support::random::Random;
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use glam::{DAffine3, DVec3, Vec3, dvec3, vec3};
use glimray::render::{Features, Film, Integrator, PixelFeatures, RenderSettings, Slicing};
use glimray::scene::{
    Antialias, Background, Camera, Filter, Geometry, Light, LightKind, Material, Phong, Scene,
};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

fn featured(settings: RenderSettings) -> RenderSettings {
    RenderSettings {
        features: true,
        ..settings
    }
}

fn paths(settings: RenderSettings) -> RenderSettings {
    RenderSettings {
        integrator: Integrator::Path,
        ..featured(settings)
    }
}

fn features(scene: &Scene, settings: &RenderSettings) -> Features {
    film(scene, settings).features().expect("features")
}

/// Where the camera of [`balls`] is: not at the origin, from which rays are traced.
const EYE: DVec3 = DVec3::new(1.5, -0.75, 2.25);

/// Two balls on the axis of the camera, in front of a sky: a matte one, and behind the camera another that a mirror may
/// show.
fn balls(front: Material) -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: EYE,
            look_at: EYE - DVec3::Z,
            fov_y: 0.6,
            ..Camera::default()
        }],
        materials: vec![
            Material::from(Phong {
                diffuse: vec3(0.1, 0.7, 0.2),
                ..Phong::default()
            }),
            front,
        ],
        background: Background::Color(vec3(0.2, 0.3, 0.4)),
        ..Scene::default()
    };
    scene.add_sphere(EYE + dvec3(0.0, 0.0, 60.0), 50.0, 0);
    scene.add_sphere(EYE + dvec3(0.0, 0.0, -6.0), 1.0, 1);
    scene
}

fn matte() -> Material {
    Material::from(Phong {
        diffuse: vec3(0.6, 0.4, 0.5),
        ..Phong::default()
    })
}

fn far(a: [f32; 3], b: impl Into<Vec3>) -> f32 {
    Vec3::from(a).distance(b.into())
}

#[test]
fn the_first_surface_is_where_the_ray_meets_the_ball() {
    let scene = balls(matte());
    for integrator in [Integrator::Path, Integrator::Whitted] {
        let settings = RenderSettings {
            integrator,
            ..featured(sized(31, 31))
        };
        let found = features(&scene, &settings);
        let (mut hits, mut misses) = (0, 0);
        for (index, pixel) in found.pixels.iter().enumerate() {
            // The ray through the centre of the pixel, and where it meets the ball (Pythagoras).
            let side = 0.3_f64.tan();
            let along = |at: usize| ((at as f64 + 0.5) / 31.0 * 2.0 - 1.0) * side;
            let ray = dvec3(along(index % 31), -along(index / 31), -1.0).normalize();
            let nearest = ray.dot(dvec3(0.0, 0.0, -6.0));
            let off = 36.0 - nearest * nearest;
            if off < 0.99 {
                let depth = nearest - (1.0 - off).sqrt();
                let point = EYE + depth * ray;
                let normal = depth * ray - dvec3(0.0, 0.0, -6.0);
                assert!((f64::from(pixel.depth) - depth).abs() < 1e-4, "{pixel:?}");
                assert!(far(pixel.position, point.as_vec3()) < 1e-4, "{pixel:?}");
                assert!(far(pixel.normal, normal.as_vec3()) < 1e-3, "{pixel:?}");
                assert!(far(pixel.albedo, vec3(0.6, 0.4, 0.5)) < 1e-5, "{pixel:?}");
                assert_eq!((pixel.object, pixel.material), (2, 2));
                assert_eq!(scene.shapes.len(), 2);
                hits += 1;
            } else if off > 1.01 {
                let PixelFeatures { depth, object, .. } = *pixel;
                assert_eq!((depth, object, pixel.material), (0.0, 0, 0));
                assert!(far(pixel.emission, vec3(0.2, 0.3, 0.4)) < 1e-6, "{pixel:?}");
                assert!(far(pixel.albedo, vec3(0.2, 0.3, 0.4)) < 1e-6, "{pixel:?}");
                misses += 1;
            }
        }
        assert!(hits > 100 && misses > 100, "{hits} and {misses}");
    }
}

/// Films and renderers tell the same point, and so does the ray query of `explain`, which is traced on its own.
#[test]
fn positions_are_those_that_are_explained() {
    // The scene's camera is at (0, 0, 6).
    let folder = Workspace::moving();
    let flags = "--size 9x7 --integrator path";
    folder
        .run(&format!(
            "render a.toml {flags} --samples 1 --layers position -o a.exr"
        ))
        .expect(0);
    let explained = folder
        .run(&format!(
            "explain a.toml {flags} --samples 1 --pixel 2,3 --json"
        ))
        .expect(0);
    let tree = explained.json();
    let hit = &tree["samples"][0]["rays"][0]["hit"]["position"];
    let image = channels(&folder, "a.exr");
    for (axis, name) in ["position.X", "position.Y", "position.Z"]
        .iter()
        .enumerate()
    {
        let expected = hit[axis].as_f64().expect("a hit");
        let found = f64::from(image[*name][3 * 9 + 2]);
        assert!((found - expected).abs() < 1e-5, "{found} and {expected}");
    }

    let scene = balls(matte());
    for samples in [1, 150] {
        let mut renderer = traced(&scene, &paths(stratified(samples, (7, 5))));
        let of_film = renderer.film().expect("a film").features();
        assert_eq!(renderer.features().ok(), of_film, "{samples} samples");
    }
}

/// A mirror that reflects half of the light shows half of the albedo of the ball behind the camera.
#[test]
fn mirrors_show_the_albedo_and_the_normal_behind_them() {
    let mirror = Material::from(Phong {
        diffuse: Vec3::ZERO,
        specular: Vec3::ZERO,
        reflect: Vec3::splat(0.5),
        ..Phong::default()
    });
    let found = features(&balls(mirror), &paths(sized(9, 9)));
    let centre = &found.pixels[40];
    assert!(
        far(centre.albedo, 0.5 * vec3(0.1, 0.7, 0.2)) < 1e-5,
        "{centre:?}"
    );
    // The reflected ray returns along +z and meets the ball at z = 10.
    assert!(
        far(centre.normal, vec3(0.0, 0.0, -1.0)) < 1e-3,
        "{centre:?}"
    );
    assert!((centre.depth - 5.0).abs() < 1e-4, "{centre:?}");
}

/// Samples at the edge of the ball have one of two albedos. So the mean tells how many have which, and these the variance.
#[test]
fn albedos_have_the_variance_of_their_samples() {
    let luminance = |[r, g, b]: [f32; 3]| {
        [(0.2126, r), (0.7152, g), (0.0722, b)].map(|(weight, part)| weight * f64::from(part))
    };
    let luminance = |color| luminance(color).iter().sum::<f64>();
    let (ball, behind) = (luminance([0.6, 0.4, 0.5]), luminance([0.2, 0.3, 0.4]));
    // More than 64 samples are summed in several blocks.
    for (antialias, samples) in [
        (Antialias::Stratified, 64),
        (Antialias::Stratified, 150),
        (Antialias::Adaptive, 64),
    ] {
        let settings = RenderSettings {
            antialias,
            ..paths(stratified(samples, (31, 31)))
        };
        let mut mixed = 0;
        for pixel in &features(&balls(matte()), &settings).pixels {
            let share = (luminance(pixel.albedo) - behind) / (ball - behind);
            let of_samples = share * (1.0 - share) * (ball - behind).powi(2);
            let expected = of_samples / f64::from(pixel.samples - 1.0);
            let found = f64::from(pixel.albedo_variance);
            assert!(
                (found - expected).abs() < 1e-3 * expected + 1e-8,
                "{found} for {expected}: {pixel:?}"
            );
            mixed += usize::from(share > 0.1 && share < 0.9);
        }
        assert!(mixed > 20, "{mixed} pixels at the edge");
    }
}

/// A mirror that is a little dull scatters some samples elsewhere. What those meet is not seen in it: the albedo stays that of
/// the ball behind the camera, and so does the normal. Elsewhere is a white background.
#[test]
fn samples_that_a_dull_mirror_scatters_do_not_change_what_it_shows() {
    let mirror = Material::from(Phong {
        diffuse: Vec3::splat(0.1),
        specular: Vec3::ZERO,
        reflect: Vec3::splat(0.5),
        ..Phong::default()
    });
    let mut scene = balls(mirror);
    scene.background = Background::Color(Vec3::ONE);
    // As good as flat.
    scene.shapes[1].geometry = Geometry::Sphere {
        center: EYE + dvec3(0.0, 0.0, -1005.0),
        radius: 1000.0,
    };
    for antialias in [Antialias::Stratified, Antialias::Adaptive] {
        let settings = RenderSettings {
            antialias,
            ..paths(stratified(64, (9, 9)))
        };
        let centre = &features(&scene, &settings).pixels[40];
        // A sample that is scattered counts 1/1024, with the mirror's own diffuse colour and normal. One in six is, at
        // most half of them here.
        let tolerance = 2.0 / 1024.0;
        assert!(
            far(centre.albedo, 0.5 * vec3(0.1, 0.7, 0.2)) < tolerance,
            "{antialias:?}: {centre:?}"
        );
        assert!(
            far(centre.normal, vec3(0.0, 0.0, -1.0)) < 2.0 * tolerance,
            "{antialias:?}: {centre:?}"
        );
    }
}

/// A black surface reflects nothing, and is seen as well as a white one: a pixel on the edge between them has half the albedo.
#[test]
fn black_surfaces_are_seen() {
    for integrator in [Integrator::Path, Integrator::Whitted] {
        let black = Material::from(Phong {
            diffuse: Vec3::ZERO,
            specular: Vec3::ZERO,
            ..Phong::default()
        });
        let mut scene = balls(black);
        let white = Material::from(Phong {
            diffuse: Vec3::ONE,
            ..Phong::default()
        });
        scene.materials.push(white);
        // Two squares side by side fill the picture, and their edge is in the middle of its middle column.
        for (x, material) in [(-5.0, 1), (5.0, 2)] {
            let place = DAffine3::from_translation(EYE + dvec3(x, 0.0, -4.0));
            let upright = DAffine3::from_rotation_x(FRAC_PI_2);
            scene.add_mesh(scenes::quad(10.0, material), place * upright);
        }
        let settings = RenderSettings {
            integrator,
            ..featured(stratified(64, (9, 9)))
        };
        let middle = &features(&scene, &settings).pixels[40];
        assert!(far(middle.albedo, Vec3::splat(0.5)) < 0.02, "{middle:?}");
        assert!(far(middle.normal, Vec3::Z) < 1e-3, "{middle:?}");
    }
}

#[test]
fn light_is_split_by_how_often_it_was_scattered() {
    let mut scene = balls(matte());
    scene.lights = vec![Light {
        color: Vec3::splat(2.0),
        kind: LightKind::Directional {
            // Past the ball behind the camera.
            direction: dvec3(-1.0, 0.0, -0.5).normalize(),
        },
        ..Light::default()
    }];
    scene.background = Background::Color(Vec3::ZERO);
    let mut indirect = 0.0;
    for depth in [0, 4] {
        let settings = RenderSettings {
            max_depth: depth,
            ..paths(stratified(16, (24, 24)))
        };
        let found = features(&scene, &settings);
        let mut lit = 0.0;
        for pixel in &found.pixels {
            let parts = [pixel.direct, pixel.indirect, pixel.emission].map(Vec3::from);
            let whole = Vec3::from(pixel.radiance);
            let sum = parts[0] + parts[1] + parts[2];
            assert!(
                sum.distance(whole) <= 1e-5 * whole.max_element(),
                "{pixel:?}"
            );
            lit += parts[0].max_element();
            indirect += parts[1].max_element();
        }
        assert!(lit > 1.0, "the lamp lights the ball");
        if depth == 0 {
            assert!(indirect.abs() < 1e-4, "no second bounce: {indirect}");
        }
    }
}

#[test]
fn parts_with_features_merge_to_the_bytes_of_one_run() {
    let mut random = Random::new(5);
    let scene = scenes::everything();
    let mitchell = RenderSettings {
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..paths(stratified(200, (19, 13)))
    };
    for (name, whole) in [
        ("whitted", featured(stratified(9, (17, 11)))),
        ("many", mitchell),
    ] {
        let expected = film(&scene, &whole);
        for count in [2, 5] {
            let parts = cut(&whole, count, &mut random);
            let films = parts.iter().map(|part| film(&scene, part)).collect();
            let found = merged(films, &mut random);
            assert!(bytes(&found) == bytes(&expected), "{name} of {count} parts");
        }
        let slicing = Slicing {
            tile_side: 16,
            max_groups: 3,
            max_samples: 5,
            ..Slicing::default()
        };
        let sliced = film(&scene, &sliced(&whole, slicing));
        assert!(bytes(&sliced) == bytes(&expected), "{name} in slices");
        let read = Film::read(&bytes(&expected)[..]).expect("a film");
        assert_eq!(read.features(), expected.features());
    }
}

#[test]
fn a_crop_of_an_adaptive_picture_has_its_features() {
    let scene = scenes::everything();
    let whole = RenderSettings {
        antialias: Antialias::Adaptive,
        noise: 0.05,
        ..paths(stratified(32, (24, 18)))
    };
    let all = features(&scene, &whole);
    let part = RenderSettings {
        crop: Some([5, 3, 17, 11]),
        ..whole
    };
    let crop = features(&scene, &part);
    for (index, pixel) in crop.pixels.iter().enumerate() {
        let (x, y) = (5 + index % 12, 3 + index / 12);
        assert_eq!(*pixel, all.pixels[y * 24 + x], "{x},{y}");
        assert!(pixel.samples >= 4.0);
    }
}

#[test]
fn features_do_not_change_the_picture() {
    let scene = scenes::everything();
    let plain = RenderSettings {
        integrator: Integrator::Path,
        ..stratified(8, (16, 12))
    };
    let expected = film(&scene, &plain);
    let found = film(&scene, &featured(plain));
    let gpu = crate::reference::compare::open_gpu();
    let developed = |film: &Film| film.develop(&gpu, &glimray::render::Tone::LINEAR);
    assert_eq!(
        developed(&found).expect("a picture"),
        developed(&expected).expect("a picture")
    );
}

/// The channels of an OpenEXR file of one part, by name.
fn channels(folder: &Workspace, name: &str) -> BTreeMap<String, Vec<f32>> {
    let image = exr::prelude::read_first_flat_layer_from_file(folder.path(name));
    let channels = image.expect("an OpenEXR file").layer_data.channel_data;
    let values = channels.list.iter().map(|channel| {
        let values = channel.sample_data.values_as_f32().collect();
        (channel.name.to_string(), values)
    });
    values.collect()
}

const ALL: &str = "beauty,albedo,normal,depth,position,uv,object,material,direct,indirect,emission,variance,samples";

#[test]
fn files_have_the_channels_that_other_programs_read() {
    let folder = Workspace::new();
    let flags = format!("--samples 4 --size 12x8 --integrator path --layers {ALL} --denoise");
    folder
        .run(&format!("render a.scene {flags} -o all.exr"))
        .expect(0);
    let read = |name: &str| {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(folder.path(name))
            .expect("an OpenEXR file")
    };
    let one = read("all.exr");
    assert_eq!(one.layer_data.len(), 1);
    let channels = &one.layer_data[0].channel_data.list;
    let is_half = |name: &str| {
        let found = channels
            .iter()
            .find(|channel| channel.name.to_string() == name);
        let found = found.unwrap_or_else(|| panic!("no channel {name}"));
        matches!(found.sample_data, FlatSamples::F16(_))
    };
    for name in [
        "R",
        "G",
        "B",
        "albedo.R",
        "normal.X",
        "direct.G",
        "indirect.B",
        "emission.R",
        "denoised.R",
    ] {
        assert!(is_half(name), "{name}");
    }
    for name in [
        "depth.Z",
        "position.Y",
        "uv.V",
        "object.id",
        "material.id",
        "variance.Y",
        "samples.N",
    ] {
        assert!(!is_half(name), "{name}");
    }
    assert_eq!(channels.len(), 31);
    folder
        .run(&format!(
            "render a.scene {flags} --layers-parts -o parts.exr"
        ))
        .expect(0);
    let parts = read("parts.exr");
    let names: Vec<_> = (parts.layer_data.iter())
        .map(|layer| {
            layer
                .attributes
                .layer_name
                .clone()
                .expect("a name")
                .to_string()
        })
        .collect();
    assert_eq!(names.join(","), format!("{ALL},denoised"));
}

/// Most programs show the denoised picture that was asked for; the raw one is a layer.
#[test]
fn denoised_files_keep_the_raw_picture() {
    let folder = Workspace::new();
    let run = |line: &str| folder.run(line).expect(0);
    let flags = "--samples 4 --size 12x8 --integrator path";
    run(&format!("render a.scene {flags} --denoise -o clean.exr"));
    run(&format!("render a.scene {flags} -o raw.exr"));
    run(&format!(
        "render a.scene {flags} --denoise --layers beauty -o both.exr"
    ));
    run(&format!("render a.scene {flags} --denoise -o a.film"));
    run("merge a.film --denoise -o merged.exr");
    run(&format!(
        "animate a.scene {flags} --denoise --frames 0 -o frame_%d.exr"
    ));
    let [clean, raw, both] = ["clean", "raw", "both"].map(|name| {
        let channels = channels(&folder, &format!("{name}.exr"));
        move |name: &str| channels[name].clone()
    });
    let near = |a: &[f32], b: &[f32]| {
        // Half floats have 11 bits.
        (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= 5e-4 * b.abs().max(1e-3))
    };
    for channel in ["R", "G", "B"] {
        let denoised = clean(channel);
        assert!(near(&both(&format!("denoised.{channel}")), &denoised));
        assert!(near(&clean(&format!("beauty.{channel}")), &raw(channel)));
        assert!(!near(&denoised, &raw(channel)), "{channel} is denoised");
    }
    assert!(folder.read("merged.exr") == folder.read("clean.exr"));
    assert!(folder.read("frame_0.exr") == folder.read("clean.exr"));
}

#[test]
fn a_merged_film_gives_the_file_of_one_run() {
    let folder = Workspace::new();
    let flags = format!("--samples 128 --size 12x8 --integrator path --layers {ALL}");
    let run = |line: String| folder.run(&line).expect(0);
    run(format!("render a.scene {flags} --denoise -o whole.exr"));
    run(format!(
        "render a.scene {flags} --sample-count 64 -o a.film"
    ));
    run(format!(
        "render a.scene {flags} --sample-offset 64 -o b.film"
    ));
    run(format!(
        "merge b.film a.film --layers {ALL} --denoise -o merged.exr"
    ));
    assert!(folder.read("whole.exr") == folder.read("merged.exr"));
}

#[test]
fn layers_that_cannot_be_are_refused() {
    let folder = Workspace::new();
    for (line, code, words) in [
        (
            "render a.scene --layers albedo -o a.png",
            2,
            "only OpenEXR files and films",
        ),
        (
            "render a.scene --layers beauty,colour -o a.exr",
            2,
            "albedo",
        ),
        (
            "render a.scene --layers depth --integrator normals -o a.exr",
            2,
            "(--integrator normals): it has none",
        ),
        ("render a.scene --layers-parts -o a.exr", 2, "--layers"),
    ] {
        folder.run(line).expect(code).says(words);
    }
    folder.run("render a.scene --size 8x8 -o a.film").expect(0);
    folder
        .run("merge a.film --denoise -o a.png")
        .expect(2)
        .says("no features");
}
