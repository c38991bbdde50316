//! Films that keep the background apart, so that another one can be put in when they are developed.

use crate::reference::compare::{assert_none, check_alike, check_same_bits, render, sized, start};
use crate::reference::scenes;
use glam::Vec3;
use glimray::image::Image;
use glimray::import;
use glimray::render::{Antialias, Renderer, Settings, Slicing, Tone};
use glimray::scene::{Background, Scene};
use std::path::Path;

const COLOR: Background = Background::Color(Vec3::new(0.7, 0.2, 0.05));
const GRADIENT: Background = Background::Gradient {
    bottom: Vec3::new(0.1, 0.3, 0.0),
    top: Vec3::new(0.2, 0.4, 1.5),
};

fn apart(settings: &Settings) -> Settings {
    Settings {
        background_apart: true,
        ..settings.clone()
    }
}

fn traced(scene: &Scene, settings: &Settings) -> Renderer {
    let mut renderer = start(scene, settings).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer
}

fn before(renderer: &mut Renderer, background: &Background) -> Image {
    let tone = Tone {
        background: background.ends(),
        ..Tone::LINEAR
    };
    renderer.develop(&tone).expect("a picture")
}

/// A film that was traced before one background gives the pictures of others, which are traced here; and
/// its own without a bit of difference.
fn check(name: &str, scene: &Scene, settings: &Settings) -> Vec<Result<(), String>> {
    let mut renderer = traced(scene, &apart(settings));
    let samples = renderer.stats().samples;
    let mut outcomes = Vec::new();
    for (what, background) in [("colour", COLOR), ("gradient", GRADIENT)] {
        let developed = before(&mut renderer, &background);
        let other = Scene {
            background,
            ..scene.clone()
        };
        let (expected, _) = render(&other, settings);
        let name = format!("{name}, {what}");
        outcomes.push(check_alike(&name, &expected, &developed, 0.01, 0.0));
    }
    let own = renderer.develop(&Tone::LINEAR).expect("a picture");
    outcomes.push(check_same_bits(name, &render(scene, settings).0, &own));
    assert_eq!(renderer.stats().samples, samples, "{name} was traced again");
    outcomes
}

#[test]
fn another_background_gives_the_picture_that_is_traced_before_it() {
    let settings = Settings {
        samples: 3,
        antialias: Antialias::Stratified,
        ..sized(48, 36)
    };
    let mut outcomes = check("everything", &scenes::everything(), &settings);
    let picture = crate::textures::under_a_picture();
    outcomes.extend(check("under a picture", &picture, &settings));
    let glass = Path::new("assets/scenes/glass_and_mirrors.toml");
    let glass = import::load(glass).expect("a scene");
    outcomes.extend(check("glass", &glass, &settings));
    assert_none(outcomes);
}

#[test]
fn so_it_does_over_many_windows_and_more_samples_than_one_sum_takes() {
    let settings = Settings {
        samples: 300,
        antialias: Antialias::Stratified,
        filter: glimray::scene::Filter::Mitchell,
        filter_radius: 2.0,
        slicing: Slicing {
            window_side: 16,
            ..Slicing::default()
        },
        ..sized(20, 12)
    };
    assert_none(check("many", &scenes::everything(), &settings));
}

#[test]
fn where_nothing_is_hit_there_is_the_background_alone() {
    let mut renderer = traced(&scenes::empty(), &apart(&sized(16, 12)));
    let Background::Color(color) = COLOR else {
        unreachable!()
    };
    let image = before(&mut renderer, &COLOR);
    // A little rounding: it is the sum of what is seen of its colours below and above.
    let is_near = |pixel: &[f32; 4]| (Vec3::from_slice(pixel) - color).abs().max_element() < 1e-6;
    let off = image.pixels.iter().find(|pixel| !is_near(pixel));
    assert_eq!(off, None);
}

#[test]
fn adaptive_sampling_and_debug_views_keep_nothing_apart() {
    let all = apart(&sized(8, 8));
    assert!(all.keeps_background_apart());
    let adaptive = Settings {
        antialias: Antialias::Adaptive,
        samples: 16,
        ..all.clone()
    };
    let normals = Settings {
        integrator: glimray::render::Integrator::Normals,
        ..all
    };
    let scene = scenes::everything();
    for settings in [adaptive, normals] {
        assert!(!settings.keeps_background_apart());
        let mut renderer = traced(&scene, &settings);
        let own = renderer.develop(&Tone::LINEAR).expect("a picture");
        assert!(own == before(&mut renderer, &COLOR));
    }
}
