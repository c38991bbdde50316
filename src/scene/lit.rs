//! Default samples per pixel, and whether a scene has any light.

use super::{Background, LightProperty, MaterialProperty, OutputDefaults, Scene, Target};
use glam::Vec3;

/// Samples per pixel for scenes that are noisy with one.
const SAMPLES: u32 = 16;

impl Scene {
    /// Default samples per pixel: 16 if a lens, an area light or an open shutter makes the rays of a
    /// pixel random, otherwise 1.
    pub fn default_samples(&self) -> u32 {
        let has_lens = self.cameras.iter().any(|camera| camera.lens.is_some());
        let is_large = self
            .lights
            .iter()
            .any(|light| light.kind.radiance().is_some());
        let shutter = self.output.shutter;
        let is_blurred = shutter.open < shutter.close && !self.tracks.is_empty();
        match has_lens || is_large || is_blurred {
            true => SAMPLES,
            false => OutputDefaults::default().samples,
        }
    }

    /// Whether all surfaces are black because there is no light: no lights, no ambient light and no
    /// emission at any time, and no mirror or glass that could show the background. False for a scene
    /// without surfaces.
    pub fn is_unlit(&self) -> bool {
        let is_lit = |color: Vec3| color.max_element() > 0.0;
        let changes = |wanted: fn(&Target) -> bool| {
            let mut targets = self.tracks.iter().flat_map(|track| &track.targets);
            targets.any(wanted)
        };
        let any_material = |color: fn(&super::Material) -> Vec3| {
            let mut materials = self.materials.iter();
            materials.any(|material| is_lit(color(material)))
        };
        let has_lights = self.lights.iter().any(|light| is_lit(light.color))
            || changes(|target| {
                use LightProperty::{Color, Intensity, On};
                matches!(target, Target::Light(_, Color | Intensity | On))
            });
        let has_ambient = is_lit(self.ambient)
            && (any_material(|material| material.ambient)
                || changes(|t| matches!(t, Target::Material(_, MaterialProperty::Ambient))));
        let emits = any_material(|material| material.emission)
            || changes(|target| matches!(target, Target::Material(_, MaterialProperty::Emission)));
        let shows_background = self.background.shines()
            && (any_material(|material| material.reflect + material.transmit)
                || changes(|target| {
                    use MaterialProperty::{Reflect, Transmit};
                    matches!(
                        target,
                        Target::Material(_, Reflect | Transmit) | Target::Layer(..)
                    )
                }));
        let has_surfaces = !(self.shapes.is_empty() && self.instances.is_empty());
        has_surfaces && !(has_lights || has_ambient || emits || shows_background)
    }
}

impl Background {
    /// Whether it is not black, as far as that is known without looking into its picture.
    pub fn shines(&self) -> bool {
        let is_lit = |color: &Vec3| color.max_element() > 0.0;
        match self {
            Self::Color(color) => is_lit(color),
            Self::Gradient { bottom, top } => is_lit(bottom) || is_lit(top),
            Self::Picture { strength, .. } => *strength > 0.0,
        }
    }
}
