//! Clamps colours that are finite in the file but whose products could overflow, to ranges in which light
//! stays finite over many bounces. Real scenes are far within these ranges.

use super::notes::Notes;
use glam::{DVec3, Vec3, Vec4};
use glimray_scene::{
    Attenuation, Background, Bsdf, Light, LightProperty, Material, MaterialProperty, Pattern,
    Phong, Scene, Target, Texture, Values,
};
use std::sync::Arc;

/// Limit of coefficients, such as diffuse colours, and of pattern colours, which are multiplied with
/// them.
const COEFFICIENT: f32 = 1e3;

/// Limit of radiance: of colours of the background, ambient light, emission, lights without attenuation, and others at the
/// far end of the scene. Its product with a coefficient is below 2^40, beyond which samples count as not finite.
const RADIANCE: f32 = 1e9;

/// Limit of the texels of the picture of a background (`picture/repair.rs`), whose suns are small.
pub(super) const SUN: f32 = 1e12;

/// Limit of lights with attenuation, however far they are, and of the surfaces of area lights. The Sun at its distance in
/// metres needs 2e25.
const INTENSITY: f32 = 1e30;

/// Limit of absorption, per unit of length.
const ABSORPTION: f32 = 1e12;

/// Range of indices of refraction, whose squares must not overflow.
pub(super) const IOR: (f32, f32) = (1e-6, 1e6);

/// Limit of the indices of refraction of thin films.
pub(super) const FILM_IOR: f32 = 100.0;

/// Limit of the thickness of thin films in nanometres: a millimetre.
pub(super) const FILM_THICKNESS: f32 = 1e6;

/// Limit of dispersion, 20 divided by Abbe's number, which is about 20 to 90 for glass.
pub(super) const DISPERSION: f32 = 100.0;

/// Clamps the colours of `scene` and notes how many were out of range.
pub(super) fn limit(scene: &mut Scene) {
    let mut counts = Counts::default();
    for material in &mut scene.materials {
        counts.material(material);
    }
    for mesh in &mut scene.meshes {
        if !mesh.colors.iter().all(is_color) {
            counts.colors(&mut Arc::make_mut(mesh).colors);
        }
    }
    for texture in &mut scene.textures {
        counts.texture(texture);
    }
    let most = intensities(scene);
    for (light, most) in scene.lights.iter_mut().zip(&most) {
        counts.light(light, *most);
    }
    counts.radiance(&mut scene.ambient);
    match &mut scene.background {
        Background::Color(color) => counts.radiance(color),
        Background::Gradient { bottom, top } => {
            counts.radiance(bottom);
            counts.radiance(top);
        }
        Background::Picture {
            strength, picture, ..
        } => {
            // A picture's brightest texel is in proportion to its scale.
            let most = SUN / scene.pictures[*picture].texels.scale();
            lower_number(strength, most, &mut counts.suns);
        }
    }
    counts.tracks(scene, &most);
    counts.report(scene);
}

/// Numbers of values out of range.
#[derive(Default)]
struct Counts {
    coefficients: usize,
    colors: usize,
    radiances: usize,
    suns: usize,
    intensities: usize,
    indices: usize,
}

/// Whether a colour of a vertex is in range.
fn is_color(color: &Vec4) -> bool {
    color.cmpge(Vec4::ZERO).all() && color.cmple(Vec4::splat(COEFFICIENT)).all()
}

/// Clamps each component of `color` to `most`.
fn lower(color: &mut Vec3, most: f32, count: &mut usize) {
    if color.max_element() > most {
        *color = color.min(Vec3::splat(most));
        *count += 1;
    }
}

fn lower_number(number: &mut f32, most: f32, count: &mut usize) {
    if *number > most {
        *number = most;
        *count += 1;
    }
}

impl Counts {
    fn radiance(&mut self, color: &mut Vec3) {
        lower(color, RADIANCE, &mut self.radiances);
    }

    fn material(&mut self, material: &mut Material) {
        self.radiance(&mut material.emission);
        let phong = match &mut material.bsdf {
            Bsdf::Phong(phong) => phong,
            Bsdf::MetallicRoughness(model) if model.phong.is_none() => return,
            Bsdf::MetallicRoughness(_) => material.classical_mut(),
        };
        let Phong {
            diffuse,
            specular,
            ambient,
            reflect,
            transmit,
            absorption,
            ior,
            ..
        } = phong;
        for color in [diffuse, specular, ambient, reflect, transmit] {
            lower(color, COEFFICIENT, &mut self.coefficients);
        }
        lower(absorption, ABSORPTION, &mut self.coefficients);
        if !(IOR.0..=IOR.1).contains(ior) {
            *ior = ior.clamp(IOR.0, IOR.1);
            self.indices += 1;
        }
    }

    /// NaN becomes 0.
    fn colors(&mut self, colors: &mut [Vec4]) {
        for color in colors.iter_mut().filter(|color| !is_color(color)) {
            *color = color.map(|c| if c > 0.0 { c.min(COEFFICIENT) } else { 0.0 });
            self.colors += 1;
        }
    }

    fn texture(&mut self, texture: &mut Texture) {
        match &mut texture.pattern {
            Pattern::Checker { a, b }
            | Pattern::Stripes { a, b }
            | Pattern::Gradient { a, b }
            | Pattern::Noise { a, b, .. } => {
                for color in [a, b] {
                    lower(color, COEFFICIENT, &mut self.coefficients);
                }
            }
            Pattern::Picture { .. } => {}
        }
    }

    fn light(&mut self, light: &mut Light, most: f32) {
        // The surface of a small area light is brighter than its intensity.
        let surface = light.kind.radiance().unwrap_or(1.0).max(1.0);
        let most = most.min((f64::from(INTENSITY) / surface) as f32);
        lower(&mut light.color, most, &mut self.intensities);
    }

    /// `intensities` are the limits of the lights.
    fn tracks(&mut self, scene: &mut Scene, intensities: &[f32]) {
        for track in &mut scene.tracks {
            let most = |target: &Target| match *target {
                Target::Light(light, LightProperty::Color | LightProperty::Intensity) => {
                    Some(intensities[light])
                }
                Target::Material(_, MaterialProperty::Emission) => Some(RADIANCE),
                Target::Material(_, MaterialProperty::Absorption) => Some(ABSORPTION),
                Target::Material(
                    _,
                    MaterialProperty::Diffuse
                    | MaterialProperty::Specular
                    | MaterialProperty::Ambient
                    | MaterialProperty::Reflect
                    | MaterialProperty::Transmit,
                ) => Some(COEFFICIENT),
                _ => None,
            };
            let Some(most) = track.targets.iter().filter_map(most).reduce(f32::min) else {
                continue;
            };
            let most = f64::from(most);
            let before = self.intensities;
            match &mut track.curve.values {
                Values::Scalar(numbers) => {
                    for number in numbers.iter_mut().filter(|number| number.abs() > most) {
                        *number = number.clamp(-most, most);
                        self.intensities += 1;
                    }
                }
                Values::Vector(colors) => {
                    for color in colors.iter_mut().filter(|c| c.abs().max_element() > most) {
                        *color = color.clamp(DVec3::splat(-most), DVec3::splat(most));
                        self.intensities += 1;
                    }
                }
                Values::Rotation(_) => {}
            }
            // A track counts once, however many of its values are out of range.
            self.intensities = self.intensities.min(before + 1);
        }
    }

    fn report(self, scene: &mut Scene) {
        let mut notes = Notes::default();
        for (count, what) in [
            (
                self.coefficients,
                format!("coefficients clamped to {COEFFICIENT}"),
            ),
            (
                self.colors,
                format!("colours of vertices clamped to 0 to {COEFFICIENT}"),
            ),
            (self.radiances, format!("radiances clamped to {RADIANCE:e}")),
            (
                self.suns,
                format!(
                    "strengths of backgrounds clamped, so that their texels are at most {SUN:e}"
                ),
            ),
            (
                self.intensities,
                format!("lights clamped to a radiance of {RADIANCE:e} at the far end of the scene"),
            ),
            (
                self.indices,
                format!("indices of refraction clamped to {} to {}", IOR.0, IOR.1),
            ),
        ] {
            if count > 0 {
                notes.add("values out of range", || format!("{what}: {count}"));
            }
        }
        scene.skipped.extend(notes.into_lines());
    }
}

/// The limits of the colours of the lights: [`RADIANCE`] at the point of the scene that is farthest from the light, at least
/// one unit away.
fn intensities(scene: &Scene) -> Vec<f32> {
    let is_bright = |light: &Light| light.color.max_element() > RADIANCE;
    let is_moving = |target: &Target| matches!(target, Target::Light(..));
    let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
    if !scene.lights.iter().any(is_bright) && !targets.any(is_moving) {
        return vec![RADIANCE; scene.lights.len()];
    }
    let rest = scene.frame(0.0);
    let eye = rest.camera.look_from;
    let (low, high) = scene.bounds().unwrap_or((eye, eye));
    let (low, high) = (low.min(eye), high.max(eye));
    let limit = |light: &Light| match (light.attenuation, light.kind.bounds()) {
        (Attenuation::InverseSquare, Some((from, to))) => {
            let place = (from + to) / 2.0;
            let reach = (place - low).abs().max((high - place).abs()).length();
            (f64::from(RADIANCE) * reach.max(1.0).powi(2)).min(INTENSITY.into()) as f32
        }
        _ => RADIANCE,
    };
    rest.lights.iter().map(limit).collect()
}
