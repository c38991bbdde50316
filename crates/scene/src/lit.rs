//! Default samples per pixel, whether a scene has any light, and whether its materials make some.

use super::{
    Attenuation, Background, Bsdf, Light, LightKind, LightProperty, LightTransport, Material,
    MaterialProperty, OutputDefaults, Pattern, Scene, Target, corners,
};
use glam::{DVec3, Vec3};

impl Light {
    /// The radiance that it gives a white surface at `point` that faces it, in the brightest channel; an area light as if it
    /// were small.
    fn towards(&self, point: DVec3) -> f32 {
        let brightest = self.color.max_element();
        let Some((min, max)) = self.kind.bounds() else {
            return brightest;
        };
        let way = point - min.midpoint(max);
        let is_outside = match self.kind {
            LightKind::Spot {
                direction, outer, ..
            } => way.dot(direction) < outer.cos() * way.length(),
            _ => false,
        };
        match self.attenuation {
            _ if is_outside => 0.0,
            Attenuation::None => brightest,
            Attenuation::InverseSquare => brightest / way.length_squared().max(1e-30) as f32,
        }
    }
}

impl Scene {
    /// Default samples per pixel: 64 of a scene for path tracing; 16 if a lens, an area light or an open shutter
    /// makes the rays of a pixel random; otherwise 1.
    pub fn default_samples(&self) -> u32 {
        if self.output.integrator == LightTransport::Path {
            return LightTransport::Path.samples();
        }
        let has_lens = self.cameras.iter().any(|camera| camera.lens.is_some());
        let is_large = self
            .lights
            .iter()
            .any(|light| light.kind.radiance().is_some());
        let shutter = self.output.shutter;
        let is_blurred = shutter.open < shutter.close && !self.tracks.is_empty();
        match has_lens || is_large || is_blurred {
            true => LightTransport::Whitted.samples(),
            false => OutputDefaults::default().samples,
        }
    }

    /// Whether all surfaces are black because there is no light: no lights, no ambient light and no
    /// emission at any time, and no mirror or glass that could show the background. False for a scene
    /// without surfaces.
    pub fn is_unlit(&self) -> bool {
        let shows_background = self.background_shines()
            && (self.any_material(|material| {
                let phong = material.classical();
                phong.reflect + phong.transmit
            }) || self.changes(|target| {
                use MaterialProperty::{Reflect, Transmit};
                matches!(
                    target,
                    Target::Material(_, Reflect | Transmit) | Target::Layer(..)
                )
            }));
        self.has_surfaces() && !(self.has_own_light() || shows_background)
    }

    /// Whether matt surfaces are lit by the background alone, which only path tracing sees: there are no lights, no ambient
    /// light and no emission at any time.
    pub fn is_lit_by_background_alone(&self) -> bool {
        let is_matt = self.any_material(|material| material.classical().diffuse);
        self.has_surfaces() && is_matt && self.background_shines() && !self.has_own_light()
    }

    fn has_surfaces(&self) -> bool {
        !(self.shapes.is_empty() && self.instances.is_empty())
    }

    /// Whether there are lights, ambient light or emission at any time.
    fn has_own_light(&self) -> bool {
        let has_lights = self.lights.iter().any(|light| is_lit(light.color))
            || self.changes(|target| {
                use LightProperty::{Color, Intensity, On};
                matches!(target, Target::Light(_, Color | Intensity | On))
            });
        let has_ambient = is_lit(self.ambient)
            && (self.any_material(|material| material.classical().ambient)
                || self.changes(|t| matches!(t, Target::Material(_, MaterialProperty::Ambient))));
        let emits = (self.materials.iter()).any(|material| self.emits(material))
            || self.changes(|target| {
                matches!(target, Target::Material(_, MaterialProperty::Emission))
            });
        has_lights || has_ambient || emits
    }

    /// Whether a track has a target like this.
    fn changes(&self, is_wanted: fn(&Target) -> bool) -> bool {
        let mut targets = self.tracks.iter().flat_map(|track| &track.targets);
        targets.any(is_wanted)
    }

    fn any_material(&self, color: fn(&Material) -> Vec3) -> bool {
        self.materials
            .iter()
            .any(|material| is_lit(color(material)))
    }

    /// The radiance that the lights give a white surface that faces each of them, unshadowed and at time 0: the mean over
    /// the centre and the corners of the bounds, where it counts at most 1. 0 without bounds.
    pub fn own_light(&self) -> f32 {
        let Some(bounds) = self.bounds() else {
            return 0.0;
        };
        let lights = self.lights_at(0.0, 0.0, &self.nodes_at(0.0, 0.0));
        let points = corners(bounds)
            .into_iter()
            .chain([bounds.0.midpoint(bounds.1)]);
        let at = |point: DVec3| -> f32 {
            let sent = lights.iter().map(|light| light.towards(point));
            sent.sum::<f32>().min(1.0)
        };
        points.map(at).sum::<f32>() / 9.0
    }

    /// Whether the background is not black.
    pub fn background_shines(&self) -> bool {
        let is_lit = |color: &Vec3| color.max_element() > 0.0;
        match &self.background {
            Background::Color(color) => is_lit(color),
            Background::Gradient { bottom, top } => is_lit(bottom) || is_lit(top),
            Background::Picture {
                strength, picture, ..
            } => *strength > 0.0 && !self.pictures[*picture].texels.is_black(),
        }
    }

    /// The Phong materials that send on more light than arrives, which the path tracer scales down: a colour of theirs is
    /// above 1, or the highlight of an exponent s has k_s above (s + 1)/2.
    pub fn materials_that_gain_light(&self) -> impl Iterator<Item = &Material> {
        let gains = |material: &&Material| {
            let Bsdf::Phong(phong) = &material.bsdf else {
                return false;
            };
            let highlight = 2.0 * phong.specular / (phong.shininess + 1.0);
            let colors = [phong.diffuse, phong.reflect, phong.transmit];
            let most = colors.into_iter().fold(highlight, Vec3::max);
            most.max_element() > 1.0
        };
        self.materials.iter().filter(gains)
    }

    /// The mirrors and the glass: materials that reflect at least 0.7 of the light, more than a glossy paint, or transmit
    /// some.
    pub fn mirrors_and_glass(&self) -> impl Iterator<Item = &Material> {
        let follows = |material: &&Material| {
            let phong = material.classical();
            phong.reflect.max_element() >= 0.7 || phong.transmit.max_element() > 0.0
        };
        self.materials.iter().filter(follows)
    }

    /// Whether a material has an emission that its texture does not make black.
    fn emits(&self, material: &Material) -> bool {
        let is_black = |texture: usize| match self.textures[texture].pattern {
            Pattern::Checker { a, b }
            | Pattern::Stripes { a, b }
            | Pattern::Gradient { a, b }
            | Pattern::Noise { a, b, .. } => a.max(b).max_element() <= 0.0,
            Pattern::Picture { picture, .. } => self.pictures[picture].texels.is_black(),
        };
        let (color, texture) = material.radiance();
        color.max_element() > 0.0 && !texture.is_some_and(is_black)
    }
}

fn is_lit(color: Vec3) -> bool {
    color.max_element() > 0.0
}
