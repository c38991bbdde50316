//! No pixel is brighter than the lights of its scene can make it.

use crate::lanes::assets;
use crate::reference::compare::{assert_none, render};
use glimray::render::{Antialias, Integrator, RenderSettings};
use glimray::scene::{Background, Scene};

/// The largest radiance that a light has: of the background, of emissive surfaces and of area lights; of others the largest
/// intensity or irradiance, as from a distance of 1.
fn brightest(scene: &Scene) -> f32 {
    let background = match scene.background {
        Background::Picture {
            picture, strength, ..
        } => {
            let texels = scene.pictures[picture].linear();
            let largest = texels.map(|texel| texel.truncate().max_element());
            strength * largest.fold(0.0, f32::max)
        }
        Background::Color(color) => color.max_element(),
        Background::Gradient { bottom, top } => bottom.max(top).max_element(),
    };
    let emission = scene.materials.iter().map(|one| one.emission.max_element());
    let lamps = scene.lights.iter().map(|light| {
        let factor = light.kind.radiance().unwrap_or(1.0).max(1.0);
        factor as f32 * light.color.max_element()
    });
    emission.chain(lamps).fold(background, f32::max)
}

/// A sample of a path adds at each surface at most twice the radiance of a light that it could hit: the power heuristic leaves a light
/// sample no more than half the radiance over the density of the path, and a choice among lobes at most doubles a throughput.
/// Lights without extent have no such weight, and highlights of them are as bright as a lobe is narrow: they get
/// a factor of 10.
fn bound(scene: &Scene, settings: &RenderSettings) -> f32 {
    let has_point = (scene.lights.iter()).any(|light| light.kind.radiance().is_none());
    let factor = if has_point { 10.0 } else { 2.0 };
    (factor * brightest(scene) + scene.ambient.max_element()) * (settings.max_depth + 1) as f32
}

#[test]
fn no_pixel_is_brighter_than_lights_can_make_it() {
    let rows = assets().into_iter().flat_map(|(name, scene)| {
        [Integrator::Path, Integrator::Whitted].map(|integrator| {
            let settings = RenderSettings {
                size: (64, 48),
                samples: 16,
                antialias: Antialias::Stratified,
                integrator,
                ..RenderSettings::from(&scene.output)
            };
            let (image, stats) = render(&scene, &settings);
            let peak = (image.pixels.iter().flat_map(|pixel| &pixel[..3]))
                .fold(0.0, |a: f32, b| a.max(*b));
            let most = bound(&scene, &settings);
            println!("{name}, {integrator:?}: {peak} of {most}");
            match peak <= most && stats.nonfinite_samples == 0 {
                true => Ok(()),
                false => Err(format!("{name}, {integrator:?}: {peak}, at most {most}")),
            }
        })
    });
    assert_none(rows);
}
