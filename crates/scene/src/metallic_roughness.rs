//! The metallic-roughness material of glTF 2.0 with the parameters of its ratified `KHR_materials_*`
//! extensions, and how it is shown by Phong's and Whitted's model.
//!
//! The mapping has four parts. F₀, the reflectance at normal incidence, is ((n − 1)/(n + 1))² times the
//! specular colour for a dielectric of index n, and the base colour for a metal.
//! * The **highlight** is the Blinn–Phong lobe of the same width, as a Phong lobe: with α = roughness² its
//!   exponent is (2/α² − 2)/4, and its height F₀ · (2/α² + 6)/8, at most 1.
//! * The **mirror** reflects F₀ times the sharpness (1 − roughness)⁴: a smooth surface shows its
//!   surroundings, a rough one does not.
//! * The **diffuse** part is the base colour of the dielectric. A metal has none, but the blurred image of
//!   its surroundings is missing here: a part of 0.6 of it, less what the mirror shows, is diffuse.
//! * What a dielectric **transmits** is seen straight through, or refracted if the material has a volume.
//!   Alpha stays what it is.

use super::material::ColoredParts;
use super::{Fresnel, LayerTextures, Phong};
use glam::Vec3;

/// How much of the blurred reflection of a metal is shown as diffuse colour.
const METAL_DIFFUSE: f32 = 0.6;

/// Limit of the absorption, per unit of length: products with lengths stay finite.
const MOST_ABSORPTION: f32 = 1e12;

/// Mirrors weaker than this are left out: each costs a ray.
const WEAKEST_MIRROR: f32 = 0.01;

/// Every parameter of a metallic-roughness material. Colours are linear Rec. 709; without another range,
/// numbers and colours are in 0..=1.
#[derive(Clone, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// The colour of a dielectric's body or of a metal's reflection.
    pub base_color: Vec3,
    /// 0 for a dielectric, 1 for a metal.
    pub metallic: f32,
    /// The square root of the width α of the microfacet distribution.
    pub roughness: f32,
    /// Whether the base colour is shown as it is, without light.
    pub unlit: bool,
    /// Index of refraction, 1 or more.
    pub ior: f32,
    /// Factor on a dielectric's reflection.
    pub specular: f32,
    /// Colour of a dielectric's reflection at normal incidence, 0 or more.
    pub specular_color: Vec3,
    /// Fraction of the light that enters a dielectric's body and passes through it.
    pub transmission: f32,
    /// Thickness of the volume in the mesh's space; 0 for a thin wall, which does not refract.
    pub thickness: f32,
    /// Colour of white light after `attenuation_distance` in the volume.
    pub attenuation_color: Vec3,
    /// In scene units, above 0; infinite for a clear volume.
    pub attenuation_distance: f32,
    /// Strength of a clear coat.
    pub clearcoat: f32,
    /// Roughness of the clear coat.
    pub clearcoat_roughness: f32,
    /// Factor on the tilt of the clear coat's normal map, 0 or more.
    pub clearcoat_normal_scale: f32,
    /// Colour of a layer of fibres.
    pub sheen_color: Vec3,
    /// Roughness of that layer.
    pub sheen_roughness: f32,
    /// How much longer highlights are along one direction.
    pub anisotropy: f32,
    /// That direction, in radians counter-clockwise from the tangent.
    pub anisotropy_rotation: f32,
    /// Strength of a thin film.
    pub iridescence: f32,
    /// Index of refraction of the film, 1 or more.
    pub iridescence_ior: f32,
    /// Range of the film's thickness in nanometres.
    pub iridescence_thickness: [f32; 2],
    /// 20 divided by the Abbe number, 0 or more; 0 for none.
    pub dispersion: f32,
    /// Fraction of the diffuse light that leaves on the other side.
    pub diffuse_transmission: f32,
    /// Colour of the diffuse transmission.
    pub diffuse_transmission_color: Vec3,
    /// Textures that multiply the parameters.
    pub textures: LayerTextures,
    /// Shown by the classical integrators in place of [`Self::derived_phong`] if a file says so.
    pub phong: Option<Box<Phong>>,
}

impl Default for MetallicRoughness {
    /// glTF's: a rough white metal.
    fn default() -> Self {
        Self {
            base_color: Vec3::ONE,
            metallic: 1.0,
            roughness: 1.0,
            unlit: false,
            ior: 1.5,
            specular: 1.0,
            specular_color: Vec3::ONE,
            transmission: 0.0,
            thickness: 0.0,
            attenuation_color: Vec3::ONE,
            attenuation_distance: f32::INFINITY,
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            clearcoat_normal_scale: 1.0,
            sheen_color: Vec3::ZERO,
            sheen_roughness: 0.0,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            iridescence: 0.0,
            iridescence_ior: 1.3,
            iridescence_thickness: [100.0, 400.0],
            dispersion: 0.0,
            diffuse_transmission: 0.0,
            diffuse_transmission_color: Vec3::ONE,
            textures: LayerTextures::default(),
            phong: None,
        }
    }
}

/// The parameters that may differ from point to point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// See [`MetallicRoughness::base_color`].
    pub base_color: Vec3,
    /// See [`MetallicRoughness::metallic`].
    pub metallic: f32,
    /// See [`MetallicRoughness::roughness`].
    pub roughness: f32,
    /// See [`MetallicRoughness::transmission`].
    pub transmission: f32,
}

/// The colours of the classical model at one point, all in 0..=1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobes {
    /// For [`Phong::diffuse`] and [`Phong::ambient`].
    pub diffuse: Vec3,
    /// For [`Phong::specular`].
    pub specular: Vec3,
    /// For [`Phong::reflect`].
    pub reflect: Vec3,
    /// For [`Phong::transmit`].
    pub transmit: Vec3,
}

impl MetallicRoughness {
    /// The parameters without maps.
    pub fn point(&self) -> SurfacePoint {
        SurfacePoint {
            base_color: self.base_color,
            metallic: self.metallic,
            roughness: self.roughness,
            transmission: self.transmission,
        }
    }

    /// Whether it has a clear coat, sheen, a thin film or diffuse transmission.
    pub fn is_coated(&self) -> bool {
        let sheen = self.sheen_color.max_element();
        [
            self.clearcoat,
            sheen,
            self.iridescence,
            self.diffuse_transmission,
        ]
        .iter()
        .any(|part| *part > 0.0)
    }

    /// Whether light that passes through the surface is refracted.
    pub(super) fn is_refractive(&self) -> bool {
        self.transmission > 0.0 && self.thickness > 0.0
    }

    /// Whether Fresnel's equations decide how much is reflected. Otherwise it is F₀ from all directions:
    /// for metals, and for thin surfaces, which must not refract.
    fn has_fresnel(&self) -> bool {
        self.is_refractive() || self.transmission == 0.0 && self.metallic == 0.0
    }

    /// The coefficients of [`Self::derived_phong`] that are multiples of the base colour.
    pub(super) fn colored_parts(&self) -> ColoredParts {
        ColoredParts {
            mirror: self.metallic > 0.5,
            glass: true,
            emission: self.unlit,
        }
    }

    /// The classical coefficients without maps.
    pub(super) fn phong_without_maps(&self) -> Phong {
        let point = self.point();
        let lobes = self.lobes(&point, point.roughness);
        let absorption = -self.attenuation_color.max(Vec3::splat(1e-6)).map(f32::ln);
        Phong {
            diffuse: lobes.diffuse,
            ambient: lobes.diffuse,
            specular: lobes.specular,
            shininess: shininess(self.roughness),
            reflect: lobes.reflect,
            transmit: lobes.transmit,
            ior: if self.is_refractive() || self.transmission == 0.0 {
                self.ior
            } else {
                1.0
            },
            absorption: if self.is_refractive() {
                (absorption / self.attenuation_distance).min(Vec3::splat(MOST_ABSORPTION))
            } else {
                Vec3::ZERO
            },
            fresnel: match (self.has_fresnel(), self.is_refractive()) {
                (true, true) => Fresnel::Exact,
                (true, false) => Fresnel::Schlick,
                (false, _) => Fresnel::None,
            },
            ..Phong::default()
        }
    }

    /// The colours at `point`, with a highlight as wide as `highlight_roughness` says.
    pub fn lobes(&self, point: &SurfacePoint, highlight_roughness: f32) -> Lobes {
        if self.unlit {
            return Lobes {
                diffuse: Vec3::ZERO,
                specular: Vec3::ZERO,
                reflect: Vec3::ZERO,
                transmit: Vec3::ZERO,
            };
        }
        let base = point.base_color;
        let f0 = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2) * self.specular;
        let dielectric_f0 = (f0 * self.specular_color).min(Vec3::ONE);
        let f0 = dielectric_f0.lerp(base, point.metallic);
        let sharpness = (1.0 - point.roughness).powi(4);
        let sharpness = if sharpness < WEAKEST_MIRROR {
            0.0
        } else {
            sharpness
        };
        let body = (1.0 - point.metallic) * (1.0 - point.transmission);
        let blurred = METAL_DIFFUSE * point.metallic * (1.0 - sharpness);
        let height = f0 * highlight_gain(highlight_roughness);
        let reflect = match (self.has_fresnel(), self.is_refractive()) {
            // The equations bring F₀ with them, for an index of refraction only.
            (true, true) => Vec3::ONE,
            (true, false) => {
                self.specular.min(1.0) * self.specular_color.min(Vec3::ONE) * sharpness
            }
            (false, _) => f0 * sharpness,
        };
        let passing = (1.0 - point.metallic) * point.transmission;
        Lobes {
            diffuse: base * (body + blurred),
            specular: height / height.max_element().max(1.0),
            reflect,
            transmit: passing * base,
        }
    }
}

/// Phong's exponent of a highlight.
pub(super) fn shininess(roughness: f32) -> f32 {
    (blinn_exponent(roughness) / 4.0).max(1.0)
}

/// The height of a highlight for an F₀ of 1.
fn highlight_gain(roughness: f32) -> f32 {
    (blinn_exponent(roughness) + 8.0) / 8.0
}

/// The exponent of the Blinn–Phong distribution of a given width.
fn blinn_exponent(roughness: f32) -> f32 {
    let alpha = (roughness * roughness).max(0.02);
    2.0 / (alpha * alpha) - 2.0
}
