//! How surfaces answer light.

use glam::Vec3;

/// How a surface answers light: Phong coefficients, per colour channel (Phong 1975), and what it
/// mirrors and lets through (Whitted 1980).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Empty when the file gives none.
    pub name: String,
    /// k_d, 0 or more.
    pub diffuse: Vec3,
    /// k_s, 0 or more.
    pub specular: Vec3,
    /// The exponent α, 0 or more.
    pub shininess: f32,
    /// Multiplies [`super::Scene::ambient`]. The course's format wants 1, others the diffuse colour.
    pub ambient: Vec3,
    /// Whether the shading normal is turned to the side that the ray comes from. The course's
    /// format wants it left as given: a surface lit from behind gets the ambient term only.
    pub two_sided: bool,
    /// Radiance of the surface itself, 0 or more; from the back only if `two_sided`.
    pub emission: Vec3,
    /// Fraction of the light that is mirrored, 0 or more; with `fresnel` that at grazing angles.
    pub reflect: Vec3,
    /// Share of the light that is let through, 0 or more; with `fresnel` before reflection.
    pub transmit: Vec3,
    /// Share of the local shading where `mixing` is [`Mixing::Layer`], in 0..=1: what is not
    /// let through.
    pub opacity: f32,
    /// Index of refraction of what the normal points away from, above 0.
    pub ior: f32,
    /// How much of the light a unit length of it swallows: exp(−absorption · length) is left (Beer
    /// and Lambert). 0 or more.
    pub absorption: Vec3,
    /// Where bodies overlap, the one of the highest priority counts; among equals the one entered
    /// last (Schmidt and Budge 2002).
    pub priority: i32,
    /// How much is mirrored at which angle.
    pub fresnel: Fresnel,
    /// How local, mirrored and transmitted light are put together.
    pub mixing: Mixing,
    /// What multiplies the colours.
    pub textures: Textures,
}

/// How much is mirrored at which angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fresnel {
    /// The same at every angle.
    #[default]
    None,
    /// By Fresnel's equations for unpolarised light; all of it beyond the critical angle.
    Exact,
    /// By Schlick's approximation of them (1994).
    Schlick,
}

/// How local, mirrored and transmitted light are put together, with R and T for `reflect` and
/// `transmit` after Fresnel's split.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mixing {
    /// highlight + (1 − R) · opacity · (ambient + diffuse) + R · mirrored + T · transmitted, which
    /// makes no light.
    #[default]
    Layer,
    /// local + R · mirrored + T · transmitted, as in Haines' NFF.
    Sum,
    /// (1 − R) · local + R · mirrored, as the course wants it; where no ray is sent, all is local.
    Blend,
}

/// For each colour of a [`Material`] an index into [`super::Scene::textures`], by which it is
/// multiplied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Textures {
    /// Of [`Material::diffuse`].
    pub diffuse: Option<usize>,
    /// Of [`Material::specular`].
    pub specular: Option<usize>,
    /// Of [`Material::ambient`].
    pub ambient: Option<usize>,
    /// Of [`Material::emission`].
    pub emission: Option<usize>,
    /// Of [`Material::reflect`].
    pub reflect: Option<usize>,
    /// Of [`Material::transmit`].
    pub transmit: Option<usize>,
}

impl Textures {
    /// Those of all colours.
    pub fn all(&self) -> [Option<usize>; 6] {
        let Self {
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
        } = *self;
        [diffuse, specular, ambient, emission, reflect, transmit]
    }

    /// Adds `first` to every index, for textures that were put behind others.
    pub fn shift(&mut self, first: usize) {
        let Self {
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
        } = self;
        for index in [diffuse, specular, ambient, emission, reflect, transmit] {
            *index = index.map(|index| index + first);
        }
    }
}

impl Default for Material {
    /// A matte light grey, seen from both sides.
    fn default() -> Self {
        Self {
            name: String::new(),
            diffuse: Vec3::splat(0.8),
            specular: Vec3::ZERO,
            shininess: 1.0,
            ambient: Vec3::splat(0.8),
            two_sided: true,
            emission: Vec3::ZERO,
            reflect: Vec3::ZERO,
            transmit: Vec3::ZERO,
            opacity: 1.0,
            ior: 1.0,
            absorption: Vec3::ZERO,
            priority: 0,
            fresnel: Fresnel::None,
            mixing: Mixing::Layer,
            textures: Textures::default(),
        }
    }
}
