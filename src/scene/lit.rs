//! What the lights and cameras of a scene ask of its picture.

use super::{Background, LightProperty, MaterialProperty, OutputDefaults, Scene, Target};
use glam::Vec3;

/// Samples per pixel of a picture that is noise with one.
const SAMPLES: u32 = 16;

impl Scene {
    /// Samples per pixel unless told otherwise: 16 where a lens, a light with extent or an open shutter
    /// makes every ray of a pixel another one, else 1.
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

    /// Whether all surfaces are black for want of light: there is no light, no ambient light and no
    /// emission, at any time, and nothing that a mirror or glass could show of the background. A scene
    /// without surfaces wants no light.
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
        let has_background = match self.background {
            Background::Color(color) => is_lit(color),
            Background::Gradient { bottom, top } => is_lit(bottom) || is_lit(top),
            Background::Picture { strength, .. } => strength > 0.0,
        };
        let shows_background = has_background
            && (any_material(|material| material.reflect + material.transmit)
                || changes(|target| {
                    use MaterialProperty::{Reflect, Transmit};
                    matches!(target, Target::Material(_, Reflect | Transmit))
                }));
        let has_surfaces = !(self.shapes.is_empty() && self.instances.is_empty());
        has_surfaces && !(has_lights || has_ambient || emits || shows_background)
    }
}
