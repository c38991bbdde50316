//! Materials.

use super::MetallicRoughness;
use glam::Vec3;
use std::sync::Arc;

/// How a surface scatters light: Phong coefficients per colour channel (Phong 1975), mirror reflection
/// and transmission (Whitted 1980).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Empty if the file gives none.
    pub name: String,
    /// k_d, 0 or more.
    pub diffuse: Vec3,
    /// k_s, 0 or more.
    pub specular: Vec3,
    /// The exponent α, 0 or more.
    pub shininess: f32,
    /// Factor on [`super::Scene::ambient`]. 1 in the course's format, by default the diffuse colour in
    /// others.
    pub ambient: Vec3,
    /// Whether the shading normal is flipped to face the ray. Off in the course's format: a surface lit
    /// from behind gets the ambient term only.
    pub two_sided: bool,
    /// Radiance that the surface emits, 0 or more; from its back only if `two_sided` and
    /// `two_sided_emission`.
    pub emission: Vec3,
    /// Whether the back emits too if the surface is `two_sided`. Off where back faces are not rendered, as those of
    /// single-sided materials in glTF: they stay visible here, and send no light.
    pub two_sided_emission: bool,
    /// Fraction of the light that is reflected, 0 or more; with `fresnel` its value at grazing angles.
    pub reflect: Vec3,
    /// Fraction of the light that is transmitted, 0 or more; with `fresnel` before reflection is
    /// subtracted.
    pub transmit: Vec3,
    /// Weight of the local shading if `mixing` is [`Mixing::Layer`], in 0..=1.
    pub opacity: f32,
    /// Index of refraction on the inside, which is the side that the normal points away from; above 0.
    pub ior: f32,
    /// Absorption coefficient of the inside per unit length: exp(−absorption · length) is transmitted
    /// (Beer and Lambert). 0 or more.
    pub absorption: Vec3,
    /// Whether transmitted light goes straight on, as through a window pane: the surface encloses no medium, and
    /// `ior`, `absorption` and `priority` have no effect on it. Passing it is not a bounce.
    pub thin: bool,
    /// Among overlapping dielectric volumes the one of the highest priority counts; among equals the one
    /// entered last (Schmidt and Budge 2002).
    pub priority: i32,
    /// How reflection depends on the angle.
    pub fresnel: Fresnel,
    /// How local, reflected and transmitted light are combined.
    pub mixing: Mixing,
    /// Textures that multiply the colours, and the normal map.
    pub textures: Textures,
    /// Factor on the tilt of normals in the normal map: on their x and y, 0 or more.
    pub normal_scale: f32,
    /// The weight of the occlusion map, in 0..=1: a value v of it leaves 1 + weight · (v − 1) of the ambient light.
    pub occlusion_strength: f32,
    /// How much of the surface is there.
    pub coverage: Coverage,
    /// The number that `coverage` is about, in 0..=1, multiplied by the alpha of [`Textures::alpha`].
    pub alpha: f32,
    /// Whether paths from the camera see only the shadows on it, where the picture is transparent:
    /// [`super::Backdrop::Transparent`]. All other light sees the material.
    pub shadow_catcher: bool,
    /// The physically based material that the members above show, if the file has one; the path tracer uses
    /// it. Shared by materials that differ in `tint`.
    pub metallic_roughness: Option<Arc<MetallicRoughness>>,
    /// A factor on the base colour of `metallic_roughness`.
    pub tint: Vec3,
    /// Textures that multiply parameters of `metallic_roughness`, if there are any. Its emission has that of
    /// `textures`. Boxed, as few of many materials have them.
    pub layer_textures: Option<Box<LayerTextures>>,
}

impl Material {
    /// The coefficients besides the diffuse and the ambient colour that a colour of vertices multiplies: all that are
    /// multiples of the base colour, and the emission of a Phong material that shows nothing else.
    pub fn colored_parts(&self) -> ColoredParts {
        match &self.metallic_roughness {
            Some(model) => ColoredParts {
                mirror: model.metallic > 0.5,
                glass: true,
                emission: model.unlit,
            },
            None => ColoredParts {
                emission: self.diffuse == Vec3::ZERO,
                ..ColoredParts::default()
            },
        }
    }

    /// Multiplies its colours with `color`, as [`super::Mesh::colors`] do.
    pub fn paint(&mut self, color: Vec3) {
        let parts = self.colored_parts();
        self.diffuse *= color;
        self.ambient *= color;
        self.tint = color;
        if parts.mirror {
            self.specular *= color;
            self.reflect *= color;
        }
        if parts.glass {
            self.transmit *= color;
        }
        if parts.emission {
            self.emission *= color;
        }
    }

    /// Whether its textures multiply classical colours as they are: none was computed from several maps.
    pub fn follows_layers(&self) -> bool {
        let Textures {
            diffuse,
            specular,
            reflect,
            transmit,
            ..
        } = self.textures;
        let layers = self.layer_textures.as_deref().copied().unwrap_or_default();
        let is_plain = |it: Option<usize>| it.is_none() || it == layers.base_color;
        [diffuse, specular, reflect, transmit]
            .into_iter()
            .all(is_plain)
            && layers.metallic.is_none()
            && layers.roughness.is_none()
            && layers.transmission.is_none()
    }

    /// Gives classical colours the values of `metallic_roughness` where they are independent of textures that were
    /// computed for its values at rest.
    pub(super) fn follow_layers(&mut self) {
        let Some(model) = &self.metallic_roughness else {
            return;
        };
        if !self.follows_layers() || model.unlit {
            return;
        }
        let own = model.classical(String::new());
        self.diffuse = own.diffuse;
        self.ambient = own.ambient;
        self.specular = own.specular;
        self.shininess = own.shininess;
        self.reflect = own.reflect;
        self.transmit = own.transmit;
        self.ior = own.ior;
        self.fresnel = own.fresnel;
        self.paint(self.tint);
    }

    /// Whether its surfaces depend on tangents: they or their coat have a normal map, or they have anisotropy.
    pub fn has_tangents(&self) -> bool {
        let model = self.metallic_roughness.as_ref();
        let layers = self.layer_textures.as_ref();
        self.textures.normal.is_some()
            || layers.is_some_and(|layers| layers.clearcoat_normal.is_some())
            || model.is_some_and(|model| model.anisotropy > 0.0)
    }
}

/// See [`Material::colored_parts`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ColoredParts {
    /// [`Material::specular`] and [`Material::reflect`].
    pub mirror: bool,
    /// [`Material::transmit`].
    pub glass: bool,
    /// [`Material::emission`].
    pub emission: bool,
}

/// Defines the list of textures from one list of names.
macro_rules! layer_textures {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// For parameters of a [`MetallicRoughness`] the index in [`super::Scene::textures`] of the texture that
        /// multiplies them.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct LayerTextures {
            $($(#[$doc])* pub $name: Option<usize>,)*
        }

        impl LayerTextures {
            /// All of them.
            pub fn all(&self) -> impl Iterator<Item = Option<usize>> + use<> {
                [$(self.$name,)*].into_iter()
            }

            /// Adds `first` to every index, for textures that are appended to others.
            pub fn shift(&mut self, first: usize) {
                $(self.$name = self.$name.map(|index| index + first);)*
            }
        }
    };
}

layer_textures! {
    /// Of [`MetallicRoughness::base_color`].
    base_color,
    /// Of [`MetallicRoughness::metallic`], in blue.
    metallic,
    /// Of [`MetallicRoughness::roughness`], in green.
    roughness,
    /// Of [`MetallicRoughness::transmission`], in red.
    transmission,
    /// Of [`MetallicRoughness::specular`], in alpha.
    specular,
    /// Of [`MetallicRoughness::specular_color`].
    specular_color,
    /// Of [`MetallicRoughness::clearcoat`], in red.
    clearcoat,
    /// Of [`MetallicRoughness::clearcoat_roughness`], in green.
    clearcoat_roughness,
    /// The normal map of the clear coat, which does not follow that of the surface.
    clearcoat_normal,
    /// Of [`MetallicRoughness::sheen_color`].
    sheen_color,
    /// Of [`MetallicRoughness::sheen_roughness`], in alpha.
    sheen_roughness,
    /// Of [`MetallicRoughness::anisotropy`], in blue; its red and green are a direction, from -1 to 1 for 0 to 1, that is
    /// turned by [`MetallicRoughness::anisotropy_rotation`].
    anisotropy,
    /// Of [`MetallicRoughness::iridescence`], in red.
    iridescence,
    /// The place in [`MetallicRoughness::iridescence_thickness`], in green.
    iridescence_thickness,
    /// Of [`MetallicRoughness::diffuse_transmission`], in alpha.
    diffuse_transmission,
    /// Of [`MetallicRoughness::diffuse_transmission_color`].
    diffuse_transmission_color,
}

/// How much of a surface is there. The rest is a hole: rays pass it in a straight line, shadow rays too. They
/// do not count as bounces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Coverage {
    /// All of it, whatever alpha is.
    #[default]
    Opaque,
    /// All of it where alpha is at least this number, in 0..=1, and nothing elsewhere.
    Mask(f32),
    /// The fraction alpha.
    Blend,
}

/// How reflection depends on the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fresnel {
    /// Independent of the angle.
    #[default]
    None,
    /// Fresnel's equations for unpolarised light, with total reflection beyond the critical angle.
    Exact,
    /// Schlick's approximation of them (1994).
    Schlick,
}

/// How local, reflected and transmitted light are combined, with R and T for `reflect` and `transmit`
/// after Fresnel's split.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mixing {
    /// highlight + (1 − R) · opacity · (ambient + diffuse) + R · reflected + T · transmitted. Conserves
    /// energy.
    #[default]
    Layer,
    /// local + R · reflected + T · transmitted, as in Haines' NFF.
    Sum,
    /// (1 − R) · local + R · reflected, as in the course; where no reflection ray is sent, local alone.
    Blend,
}

/// For each colour of a [`Material`] the index in [`super::Scene::textures`] of the texture that
/// multiplies it.
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
    /// The normal map: a picture of shading normals on triangles with u and v. Values from 0 to 1 stand for −1
    /// to 1; x points along u of the picture, y along v, z along the interpolated normal. Other surfaces
    /// have none.
    pub normal: Option<usize>,
    /// The occlusion map: the fraction of ambient light that reaches the surface, in red.
    pub occlusion: Option<usize>,
    /// The texture whose alpha multiplies [`Material::alpha`]. Only pictures have an alpha other than 1.
    pub alpha: Option<usize>,
}

impl Textures {
    /// The textures of all colours and of alpha, the normal map and the occlusion map.
    pub fn all(&self) -> [Option<usize>; 9] {
        let [
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
            alpha,
        ] = self.looked_up();
        [
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
            alpha,
            self.normal,
            self.occlusion,
        ]
    }

    /// The textures of all colours and of alpha.
    pub fn looked_up(&self) -> [Option<usize>; 7] {
        let Self {
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
            alpha,
            normal: _,
            occlusion: _,
        } = *self;
        [
            diffuse, specular, ambient, emission, reflect, transmit, alpha,
        ]
    }

    /// Adds `first` to every index, for textures that are appended to others.
    pub fn shift(&mut self, first: usize) {
        let Self {
            diffuse,
            specular,
            ambient,
            emission,
            reflect,
            transmit,
            normal,
            occlusion,
            alpha,
        } = self;
        for index in [
            diffuse, specular, ambient, emission, reflect, transmit, normal, occlusion, alpha,
        ] {
            *index = index.map(|index| index + first);
        }
    }
}

impl Default for Material {
    /// A matte light grey, two-sided.
    fn default() -> Self {
        Self {
            name: String::new(),
            diffuse: Vec3::splat(0.8),
            specular: Vec3::ZERO,
            shininess: 1.0,
            ambient: Vec3::splat(0.8),
            two_sided: true,
            emission: Vec3::ZERO,
            two_sided_emission: true,
            reflect: Vec3::ZERO,
            transmit: Vec3::ZERO,
            opacity: 1.0,
            ior: 1.0,
            absorption: Vec3::ZERO,
            thin: false,
            priority: 0,
            fresnel: Fresnel::None,
            mixing: Mixing::Layer,
            textures: Textures::default(),
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            coverage: Coverage::Opaque,
            alpha: 1.0,
            shadow_catcher: false,
            metallic_roughness: None,
            tint: Vec3::ONE,
            layer_textures: None,
        }
    }
}
