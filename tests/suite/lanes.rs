//! A pixel is a function of scene, settings and seed: it has the same bytes wherever it lies in a vector and whatever the other
//! lanes do. Kernels that let lanes disturb each other fail here, and drivers that do.

use crate::deformation;
use crate::explain::{finish, project_scenes, random_pixels, renderer};
use crate::path::{emitter_tree, lobes};
use crate::reference::compare::{assert_none, check_same_bits, fetched, open_gpu, try_render};
use crate::reference::scenes;
use crate::render::cut;
use crate::support::{
    harness::{gpu, probe},
    random::Random,
};
use glam::dvec3;
use glimray::image::Image;
use glimray::import;
use glimray::pack;
use glimray::render::{
    Antialias, ExecutionPolicy, Features, Fetch, Integrator, PixelFeatures, QueryRay, RayQuery,
    RenderSettings, Renderer, Tone, denoise,
};
use glimray::scene::{Filter, Scene};
use std::path::Path;
use std::sync::Arc;

const SIZE: (u32, u32) = (27, 22);

/// Mesa 22.3 computes the value of lanes that have left once more in each round of the others, unless the loop has a second exit.
#[test]
fn a_value_leaves_a_loop_lane_by_lane() {
    const LEAVE_WITH_A_VALUE: &str = "
        @group(0) @binding(0) var<storage, read> inputs: array<u32>;
        fn probe(least: u32) -> u32 {
            var i = 0u;
            var found: u32;
            loop {
                let value = inputs[i] * 3u;
                if (value >= least) { found = value; break; }
                i++;
            }
            return found;
        }";
    let inputs: Vec<u32> = (0..64).collect();
    let found: Vec<u32> = gpu().map_shader(
        &probe(LEAVE_WITH_A_VALUE).buffer("inputs", &inputs),
        &inputs,
    );
    let expected: Vec<u32> = inputs.iter().map(|least| least.div_ceil(3) * 3).collect();
    assert_eq!(found, expected);
}

fn settings(integrator: Integrator) -> RenderSettings {
    RenderSettings {
        size: SIZE,
        samples: 4,
        antialias: Antialias::Stratified,
        filter: Filter::Box,
        max_depth: 6,
        integrator,
        ..RenderSettings::default()
    }
}

/// The settings of a part of the picture.
fn part(whole: &RenderSettings, crop: [u32; 4]) -> RenderSettings {
    RenderSettings {
        crop: Some(crop),
        ..whole.clone()
    }
}

/// Crops that move pixels to each place of a vector of up to 16 lanes, which holds 4x4 pixels, and single pixels.
fn crops((width, height): (u32, u32)) -> impl Iterator<Item = [u32; 4]> {
    let shifted = (1..16).map(move |k| [k % 4, k / 4, width, height]);
    let alone = random_pixels((width, height), 5, 3);
    shifted.chain(alone.into_iter().map(|[x, y]| [x, y, x + 1, y + 1]))
}

fn picture(mut renderer: Renderer) -> Image {
    finish(&mut renderer);
    renderer.develop(&Tone::LINEAR).expect("a picture")
}

/// Compares crops with the whole picture.
fn check_crops(
    name: &str,
    scene: &Scene,
    whole: &RenderSettings,
    fetch: Fetch,
) -> Result<(), String> {
    let of = |settings: &RenderSettings| picture(renderer(scene, &fetched(settings, fetch)));
    let expected = of(whole);
    let name = format!("{name}, {:?} from {fetch:?}", whole.integrator);
    crops(whole.size).try_for_each(|crop| {
        let actual = of(&part(whole, crop));
        check_same_bits(&format!("{name}, {crop:?}"), &cut(&expected, crop), &actual)
    })
}

/// Each scene in `assets/scenes` with its name.
pub fn assets() -> Vec<(String, Scene)> {
    let scenes = project_scenes(&["toml", "scene", "nff", "obj", "glb"]);
    assert!(scenes.len() > 25, "{}", scenes.len());
    scenes
}

#[test]
fn crops_of_asset_scenes_are_the_pixels_of_the_whole_by_paths() {
    let settings = settings(Integrator::Path);
    assert_none(assets().iter().enumerate().map(|(index, (name, scene))| {
        check_crops(name, scene, &settings, Fetch::Image)?;
        match index % 4 {
            0 => check_crops(name, scene, &settings, Fetch::Buffer),
            _ => Ok(()),
        }
    }));
}

#[test]
fn crops_of_asset_scenes_are_the_pixels_of_the_whole_by_whitted() {
    let settings = settings(Integrator::Whitted);
    assert_none(assets().iter().enumerate().map(|(index, (name, scene))| {
        check_crops(name, scene, &settings, Fetch::Image)?;
        let of = |fetch| picture(renderer(scene, &fetched(&settings, fetch)));
        let expected = of(Fetch::Image);
        check_same_bits(&format!("{name}, packets"), &expected, &of(Fetch::Packet))?;
        match index % 3 {
            0 => check_crops(name, scene, &settings, Fetch::Packet),
            1 => check_crops(name, scene, &settings, Fetch::Buffer),
            _ => Ok(()),
        }
    }));
}

/// Deformed meshes, trees of lights, lobes under an environment, and whatever scenes can hold.
#[test]
fn crops_of_generated_scenes_are_the_pixels_of_the_whole() {
    let mut scenes = vec![
        ("deformed".to_owned(), deformation::party()),
        ("emitters".to_owned(), emitter_tree::mixed(40)),
        ("lobes".to_owned(), lobes::scene()),
        ("everything".to_owned(), scenes::everything()),
    ];
    let transparent = |integrator| RenderSettings {
        transparent_shadows: integrator == Integrator::Path,
        ..settings(integrator)
    };
    for seed in 0..5 {
        let mut scene = crate::random_scene::scene(&mut Random::new(seed));
        (scene.lights.iter_mut()).for_each(|light| light.samples = 1);
        let renders = |integrator| try_render(&scene, &transparent(integrator)).is_ok();
        if pack::scene(&scene).is_ok() && renders(Integrator::Path) && renders(Integrator::Whitted)
        {
            scenes.push((format!("random {seed}"), scene));
        }
    }
    assert!(scenes.len() > 6, "most scenes can be rendered");
    assert_none(scenes.iter().flat_map(|(name, scene)| {
        [Integrator::Path, Integrator::Whitted]
            .map(|integrator| check_crops(name, scene, &transparent(integrator), Fetch::Image))
    }));
}

#[test]
fn crops_of_debug_views_are_the_pixels_of_the_whole() {
    let load = |name| import::load(Path::new(name)).unwrap_or_else(|error| panic!("{error}"));
    let scenes = [
        ("everything", scenes::everything()),
        ("patterns", load("assets/scenes/patterns.toml")),
        ("mesh", load("assets/scenes/helmet.glb")),
    ];
    let views = [
        Integrator::Normals,
        Integrator::Depth,
        Integrator::Ids,
        Integrator::Uv,
    ];
    assert_none(scenes.iter().flat_map(|(name, scene)| {
        views.map(|view| check_crops(name, scene, &settings(view), Fetch::Image))
    }));
}

/// Lists of pixels that need more samples are shorter in a crop.
#[test]
fn crops_of_adaptive_pictures_are_the_pixels_of_the_whole() {
    let scene = import::load(Path::new("assets/scenes/night_light.toml")).expect("a scene");
    assert_none([Integrator::Path, Integrator::Whitted].map(|integrator| {
        let adaptive = RenderSettings {
            samples: 48,
            antialias: Antialias::Adaptive,
            noise: 0.05,
            ..settings(integrator)
        };
        check_crops("adaptive", &scene, &adaptive, Fetch::Image)
    }));
}

/// The mean of samples that were each taken alone, added in order as the film does.
#[test]
fn samples_alone_are_those_among_others() {
    let rows = ["carousel.toml", "night_light.toml", "patterns.toml"].map(|name| {
        let scene = import::load(&Path::new("assets/scenes").join(name)).expect("a scene");
        (name, scene)
    });
    assert_none(rows.iter().flat_map(|(name, scene)| {
        [Integrator::Path, Integrator::Whitted].map(|integrator| {
            let whole = settings(integrator);
            let of = |settings: &RenderSettings| {
                picture(renderer(scene, &fetched(settings, Fetch::Image)))
            };
            let expected = of(&whole);
            let mut sums = Image::new(SIZE.0, SIZE.1);
            sums.pixels.fill([0.0; 4]);
            for sample in 0..whole.samples {
                let alone = of(&RenderSettings {
                    sample_range: Some(sample..sample + 1),
                    ..whole.clone()
                });
                for (sum, pixel) in sums.pixels.iter_mut().zip(alone.pixels) {
                    for channel in 0..4 {
                        sum[channel] += pixel[channel];
                    }
                }
            }
            let count = whole.samples as f32;
            sums.pixels
                .iter_mut()
                .flatten()
                .for_each(|sum| *sum /= count);
            check_same_bits(&format!("{name}, {integrator:?}"), &expected, &sums)
        })
    }));
}

/// A pixel that is explained alone, and among others whose trees are larger or smaller.
#[test]
fn explained_pixels_are_the_same_alone_and_among_others() {
    let mut problems = Vec::new();
    for (name, scene) in [
        ("everything", scenes::everything()),
        ("emitters", emitter_tree::mixed(40)),
        ("mirrors", scenes::mirrors_and_glass()),
    ] {
        for integrator in [Integrator::Path, Integrator::Whitted] {
            let wanted = fetched(&settings(integrator), Fetch::Image);
            let mut renderer = renderer(&scene, &wanted);
            finish(&mut renderer);
            let places: Vec<_> = (random_pixels(SIZE, 24, 9).into_iter())
                .map(|place| (place, 0..4))
                .collect();
            let together = renderer.explain_pixels(&places).expect("trees");
            for (place, expected) in places.iter().zip(&together).step_by(3) {
                let alone = renderer.explain_pixels(std::slice::from_ref(place));
                if alone.expect("a tree") != [expected.clone()] {
                    problems.push(format!("{name}, {integrator:?}, {:?}", place.0));
                }
            }
        }
    }
    assert!(problems.is_empty(), "{problems:?}");
}

/// Rays of a query alone, in order and shuffled.
#[test]
fn rays_of_queries_hit_alone_what_they_hit_among_others() {
    let scene = scenes::everything();
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let mut random = Random::new(4);
    let mut ray = || {
        let origin = 6.0 * random.in_cube() + dvec3(0.0, 2.0, 0.0);
        let toward = 3.0 * random.in_cube() - origin;
        QueryRay::new(origin, toward.normalize().as_vec3())
    };
    let rays: Vec<_> = (0..333).map(|_| ray()).collect();
    let places: Vec<_> = (0..rays.len()).map(|k| k * 100 % rays.len()).collect();
    for fetch in [Fetch::Image, Fetch::Buffer, Fetch::Packet] {
        let policy = ExecutionPolicy {
            fetch,
            ..ExecutionPolicy::default()
        };
        let query = RayQuery::new(open_gpu(), packed.clone(), &view, policy).expect("a query");
        let expected = query.closest_hits(&rays).expect("hits");
        let shuffled: Vec<_> = places.iter().map(|&place| rays[place]).collect();
        let hits = query.closest_hits(&shuffled).expect("hits");
        for (place, hit) in places.iter().zip(hits) {
            assert_eq!(hit, expected[*place], "{fetch:?}: ray {place} among others");
        }
        for place in (0..rays.len()).step_by(30) {
            let alone = query.closest_hits(&rays[place..=place]).expect("a hit");
            assert_eq!(
                alone,
                expected[place..=place],
                "{fetch:?}: ray {place} alone"
            );
        }
    }
}

/// Albedo, normals, depth, identities and moments of a crop, which the denoiser takes and layers show.
#[test]
fn features_of_crops_are_those_of_the_whole() {
    let scene = import::load(Path::new("assets/scenes/carousel.toml")).expect("a scene");
    let whole = RenderSettings {
        features: true,
        ..settings(Integrator::Path)
    };
    let of = |settings: &RenderSettings| -> Features {
        let mut renderer = renderer(&scene, &fetched(settings, Fetch::Image));
        finish(&mut renderer);
        renderer
            .film()
            .expect("a film")
            .features()
            .expect("features")
    };
    let expected = of(&whole);
    for crop in crops(SIZE) {
        assert_eq!(
            of(&part(&whole, crop)),
            cut_features(&expected, crop),
            "{crop:?}"
        );
    }
}

fn cut_features(all: &Features, [x0, y0, x1, y1]: [u32; 4]) -> Features {
    let places = (y0..y1).flat_map(|y| (x0..x1).map(move |x| y * all.width + x));
    Features {
        width: x1 - x0,
        height: y1 - y0,
        pixels: places.map(|place| all.pixels[place as usize]).collect(),
    }
}

/// Pixels that are farther from the edges than the filter reaches.
#[test]
fn the_denoiser_gives_a_pixel_wherever_it_lies() {
    const REACH: u32 = 70;
    let side = 2 * REACH + 12;
    let mut random = Random::new(8);
    let mut real = |low, high| random.between(low, high) as f32;
    let mut pixel = || PixelFeatures {
        radiance: [real(0.0, 2.0), real(0.0, 1.0), real(0.0, 1.0)],
        albedo: [real(0.2, 0.9), 0.5, 0.5],
        normal: [0.0, real(0.0, 0.3), 1.0],
        depth: real(2.0, 2.2),
        variance: real(0.0, 0.3),
        samples: 16.0,
        ..PixelFeatures::default()
    };
    let whole = Features {
        width: side,
        height: side,
        pixels: (0..side * side).map(|_| pixel()).collect(),
    };
    let denoised = |features: &Features| {
        let image = denoise(&features.picture(), &open_gpu(), features);
        image.expect("a denoised picture").image
    };
    let middle = [REACH + 4, REACH + 4, side - REACH, side - REACH];
    let expected = cut(&denoised(&whole), middle);
    assert_none((1..16).map(|k| {
        let [x, y] = [k % 4, k / 4];
        let moved = denoised(&cut_features(&whole, [x, y, side, side]));
        let [x0, y0, x1, y1] = middle;
        let actual = cut(&moved, [x0 - x, y0 - y, x1 - x, y1 - y]);
        check_same_bits(&format!("moved by {x}, {y}"), &expected, &actual)
    }));
}
