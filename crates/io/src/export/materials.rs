//! The materials of a scene.

use super::exact::{same_bits, shortest};
use super::{ExportError, Writer};
use crate::import::native::file::{
    ColorOrTexture, ColorTable, CoverageTable, IOR, MaterialTable, OpticsTable, PhongTable,
    ReflectTable, RefractTable, Spanned,
};
use crate::import::native::values::{Fraction, Positive, differing, short};
use glam::Vec3;
use glimray_scene::{
    Bsdf, Coverage, Fresnel, Material, MaterialProperty, Mixing, Phong, PhongTextures, Target,
};

impl Writer<'_> {
    pub fn material(
        &mut self,
        index: usize,
        material: &Material,
    ) -> Result<MaterialTable, ExportError> {
        let own = &material.textures;
        let height_map = self.height_map(own.normal, material.normal_scale)?;
        let normal_map = match height_map {
            Some(_) => None,
            None => self.data_map(own.normal, material.normal_scale),
        };
        let table = MaterialTable {
            normal_map,
            height_map: height_map.map(Into::into),
            occlusion_map: self.data_map(own.occlusion, material.occlusion_strength),
            thin: material.thin.then_some(true),
            shadow_catcher: material.shadow_catcher.then_some(true),
            coverage: self.coverage(material),
            emission: self.shade_unless(Vec3::ZERO, material.emission, own.emission),
            two_sided: (!material.two_sided).then_some(false),
            two_sided_emission: (!material.two_sided_emission).then_some(false),
            ..MaterialTable::default()
        };
        Ok(match &material.bsdf {
            Bsdf::MetallicRoughness(model) => {
                let (phong, optics) = self.classical(index, material, model);
                MaterialTable {
                    pbr: Some(self.physical(material, model).into()),
                    phong,
                    optics,
                    ..table
                }
            }
            Bsdf::Phong(phong) => {
                let local = self.phong(index, phong);
                let is_plain = matches!(
                    local,
                    PhongTable {
                        diffuse: None,
                        specular: None,
                        shininess: None,
                        ambient: None,
                    }
                );
                let phong_table = (!is_plain).then_some(local);
                self.optics(
                    MaterialTable {
                        phong: phong_table,
                        ..table
                    },
                    material,
                    phong,
                )
            }
        })
    }

    /// How much of the surface is there; `None` if all of it is.
    fn coverage(&self, material: &Material) -> Option<CoverageTable> {
        let mask = match material.coverage {
            Coverage::Opaque => return None,
            Coverage::Mask(least) => Some(Fraction(least)),
            Coverage::Blend => None,
        };
        let map = material.textures.alpha;
        Some(CoverageTable {
            alpha: differing(material.alpha, 1.0),
            map: map.map(|map| self.shade(Vec3::ONE, Some(map))),
            mask,
        })
    }

    pub fn phong(&self, index: usize, phong: &Phong) -> PhongTable {
        let (textures, plain) = (&phong.textures, PhongTable::plain());
        let has_own = !has_same_ambient(phong) || self.is_own_ambient(index);
        PhongTable {
            diffuse: self.shade_unless(plain.diffuse, phong.diffuse, textures.diffuse),
            specular: self.shade_unless(plain.specular, phong.specular, textures.specular),
            shininess: differing(phong.shininess, plain.shininess),
            ambient: has_own.then(|| self.shade(phong.ambient, textures.ambient)),
        }
    }

    /// Whether the diffuse colour of a material is animated while its ambient colour, which is the same
    /// at rest, is not: the ambient colour must then be written.
    pub fn is_own_ambient(&self, index: usize) -> bool {
        let mut targets = self.scene.tracks.iter().flat_map(|track| &track.targets);
        let moves = |property| Target::Material(index, property);
        let diffuse = moves(MaterialProperty::Diffuse);
        let ambient = moves(MaterialProperty::Ambient);
        targets.clone().any(|target| *target == diffuse) && !targets.any(|t| *t == ambient)
    }

    /// A colour, with or without a texture.
    fn shade(&self, constant: Vec3, texture: Option<usize>) -> Spanned<ColorOrTexture> {
        let Some(texture) = texture else {
            return ColorOrTexture::Color(constant.into()).into();
        };
        let table = ColorTable {
            texture: Some(self.names.texture(texture)),
            color: differing(constant, Vec3::ONE),
            ..ColorTable::default()
        };
        ColorOrTexture::Table(Box::new(table)).into()
    }

    /// A colour, unless it is the default one.
    pub fn shade_unless(
        &self,
        default: Vec3,
        constant: Vec3,
        texture: Option<usize>,
    ) -> Option<Spanned<ColorOrTexture>> {
        let is_default = texture.is_none() && same_bits(constant, default);
        (!is_default).then(|| self.shade(constant, texture))
    }

    /// Adds reflection and transmission to `table`.
    fn optics(&self, table: MaterialTable, material: &Material, phong: &Phong) -> MaterialTable {
        let PhongTextures {
            reflect, transmit, ..
        } = phong.textures;
        let is_opaque = same_bits(phong.transmit, Vec3::ZERO)
            && transmit.is_none()
            && phong.opacity == 1.0
            && same_bits(phong.absorption, Vec3::ZERO)
            && material.priority == 0;
        let is_dull = same_bits(phong.reflect, Vec3::ZERO) && reflect.is_none();
        let is_layered = phong.mixing == Mixing::Layer;
        let is_bare = phong.ior == 1.0 && phong.fresnel == Fresnel::None;
        if is_layered && is_opaque && is_dull && is_bare {
            return table;
        }
        let is_read = is_layered && (0.01..=100.0).contains(&phong.ior);
        if is_read && is_opaque {
            let reflect = ReflectTable {
                fresnel: differing(phong.fresnel, Fresnel::None),
                ior: differing(phong.ior, IOR),
                ..self.mirror(phong)
            };
            let reflect = Some(reflect);
            return MaterialTable { reflect, ..table };
        }
        match self.refract(material, phong).filter(|_| is_read) {
            Some(refract) => {
                let has_mirror = !is_dull && phong.fresnel == Fresnel::None;
                MaterialTable {
                    reflect: has_mirror.then(|| self.mirror(phong)),
                    refract: Some(refract.into()),
                    ..table
                }
            }
            None => MaterialTable {
                optics: Some(self.directly(material, phong).into()),
                ..table
            },
        }
    }

    /// The reflected fraction and its colour.
    fn mirror(&self, phong: &Phong) -> ReflectTable {
        let amount = phong.reflect.x;
        let texture = phong.textures.reflect;
        let is_amount =
            texture.is_none() && same_bits(phong.reflect, Vec3::splat(amount)) && amount <= 1.0;
        let (amount, color) = match is_amount {
            true => (differing(amount, 1.0), None),
            false => (None, Some(self.shade(phong.reflect, texture))),
        };
        ReflectTable {
            amount,
            color,
            ..ReflectTable::default()
        }
    }

    /// The `refract` table, if one expresses the transmission exactly, beside a mirror or with its own Fresnel term.
    fn refract(&self, material: &Material, phong: &Phong) -> Option<RefractTable> {
        let opacity = phong.opacity.to_bits();
        let gives = |amount: f32| (1.0 - amount).to_bits() == opacity;
        let near = f64::from(1.0 - phong.opacity);
        let amount = if phong.fresnel == Fresnel::None {
            let found = shortest([near], |[amount]| gives(amount as f32));
            found.map(|[amount]| amount as f32)?
        } else {
            phong.reflect.x
        };
        if !gives(amount) || !(0.0..=1.0).contains(&amount) {
            return None;
        }
        if phong.fresnel == Fresnel::None {
            // A mirror beside it may reflect at most the rest, and its colour may be of any brightness.
            let texture = phong.textures.reflect;
            let mirrored = phong.reflect.x;
            let is_gray = texture.is_none() && same_bits(phong.reflect, Vec3::splat(mirrored));
            let is_dull = texture.is_none() && same_bits(phong.reflect, Vec3::ZERO);
            if !(is_dull || is_gray && mirrored + amount <= 1.0) {
                return None;
            }
        } else if !same_bits(phong.reflect, Vec3::splat(amount)) || phong.textures.reflect.is_some()
        {
            return None;
        }
        let tint = |factor: Vec3| same_bits(amount * factor, phong.transmit);
        let through = if tint(Vec3::ONE) {
            Vec3::ONE
        } else {
            let near = (phong.transmit / amount).as_dvec3().to_array();
            if !near.iter().all(|x| x.is_finite()) {
                return None;
            }
            let of = |n: [f64; 3]| glam::DVec3::from(n).as_vec3();
            of(shortest(near, |n| tint(of(n)))?)
        };
        Some(RefractTable {
            amount: differing(amount, 1.0),
            ior: differing(phong.ior, IOR),
            color: self.shade_unless(Vec3::ONE, through, phong.textures.transmit),
            absorption: differing(phong.absorption, Vec3::ZERO),
            fresnel: differing(phong.fresnel, Fresnel::Exact),
            priority: differing(material.priority, 0),
        })
    }

    pub fn directly(&self, material: &Material, phong: &Phong) -> OpticsTable {
        let (textures, plain) = (&phong.textures, Phong::default());
        let has_ior = phong.ior != plain.ior;
        OpticsTable {
            reflect: self.shade_unless(plain.reflect, phong.reflect, textures.reflect),
            transmit: self.shade_unless(plain.transmit, phong.transmit, textures.transmit),
            opacity: differing(phong.opacity, plain.opacity),
            ior: has_ior.then(|| Positive(short(phong.ior))),
            absorption: differing(phong.absorption, plain.absorption),
            fresnel: differing(phong.fresnel, plain.fresnel),
            priority: differing(material.priority, 0),
            mixing: differing(phong.mixing, plain.mixing),
        }
    }
}

/// Whether the ambient colour equals the diffuse one, which is the default.
pub(super) fn has_same_ambient(phong: &Phong) -> bool {
    let textures = &phong.textures;
    same_bits(phong.ambient, phong.diffuse) && textures.ambient == textures.diffuse
}
