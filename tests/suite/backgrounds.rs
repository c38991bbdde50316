//! Backgrounds of a frame that replace that of the scene.

use crate::reference::compare::{assert_none, check_same_bits, render, sized, start};
use crate::reference::scenes;
use glam::Vec3;
use glimray::import;
use glimray::pack;
use glimray::render::{Antialias, RenderSettings, Tone};
use glimray::scene::{Background, Scene};
use std::path::Path;

const COLOR: Background = Background::Color(Vec3::new(0.7, 0.2, 0.05));
const GRADIENT: Background = Background::Gradient {
    bottom: Vec3::new(0.1, 0.3, 0.0),
    top: Vec3::new(0.2, 0.4, 1.5),
};

/// A renderer restarted with a frame with another background gives the bits of a scene packed with that
/// background, and afterwards again those of its own.
fn check(name: &str, scene: &Scene) -> Vec<Result<(), String>> {
    let settings = RenderSettings {
        samples: 3,
        antialias: Antialias::Stratified,
        ..sized(48, 36)
    };
    let mut renderer = start(scene, &settings).expect("a renderer");
    let packed = pack::scene(scene).expect("a packed scene");
    let own = scene.background.clone();
    let mut outcomes = Vec::new();
    for (what, background) in [("colour", COLOR), ("gradient", GRADIENT), ("own", own)] {
        let mut frames = scene.motion_samples(0.0, 0.0);
        for frame in &mut frames {
            frame.background = background.clone();
        }
        let view = packed.view(&frames).expect("a view");
        renderer.set_frame(&view).expect("another frame");
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        let image = renderer.develop(&Tone::LINEAR).expect("a picture");
        let other = Scene {
            background,
            ..scene.clone()
        };
        let name = format!("{name}, {what}");
        outcomes.push(check_same_bits(&name, &render(&other, &settings).0, &image));
    }
    outcomes
}

#[test]
fn another_background_of_a_frame_gives_the_picture_of_a_scene_that_has_it() {
    let mut outcomes = check("everything", &scenes::everything());
    outcomes.extend(check(
        "under a picture",
        &crate::textures::under_a_picture(),
    ));
    let glass = Path::new("assets/scenes/glass_and_mirrors.toml");
    outcomes.extend(check("glass", &import::load(glass).expect("a scene")));
    assert_none(outcomes);
}

#[test]
fn where_nothing_is_hit_there_is_the_background_alone() {
    let scene = Scene {
        background: COLOR,
        ..scenes::empty()
    };
    let (image, _) = render(&scene, &sized(16, 12));
    let expected = [0.7, 0.2, 0.05, 1.0];
    let off = image.pixels.iter().find(|pixel| **pixel != expected);
    assert_eq!(off, None);
}
