//! Metallic-roughness materials of a scene.

use super::Writer;
use super::exact::shortest;
use crate::import::native::file::{
    FractionOrTexture, NumberTable, OpticsTable, PbrTable, PhongTable, Spanned,
};
use crate::import::native::values::{
    Angle, Color, Fraction, Positive, Thicknesses, differing, short,
};
use glam::Vec3;
use glimray_scene::{Material, MetallicRoughness, Phong};

impl Writer<'_> {
    /// Keys for the classical integrators, where these show `material` otherwise than what follows from `model`.
    pub fn classical(
        &self,
        index: usize,
        material: &Material,
        model: &MetallicRoughness,
    ) -> (Option<PhongTable>, Option<Spanned<OpticsTable>>) {
        let (own, derived) = (material.classical(), model.derived_phong(material.tint));
        let local = |phong: &Phong| {
            let colors = [phong.diffuse, phong.specular, phong.ambient];
            let it = &phong.textures;
            let textures = (it.diffuse, it.specular, it.ambient);
            (format!("{colors:?}"), phong.shininess.to_bits(), textures)
        };
        let differs = local(&own) != local(&derived) || self.is_own_ambient(index);
        let optical = |phong: &Phong| {
            let colors = [phong.reflect, phong.transmit, phong.absorption];
            let numbers = [phong.opacity, phong.ior].map(f32::to_bits);
            let textures = (phong.textures.reflect, phong.textures.transmit);
            let ways = (phong.fresnel, phong.mixing);
            (format!("{colors:?}"), numbers, ways, textures)
        };
        let is_other = optical(&own) != optical(&derived);
        (
            differs.then(|| self.phong(index, &own)),
            is_other.then(|| self.directly(material, &own).into()),
        )
    }

    /// The parameters that are not the defaults of a native scene.
    pub fn physical(&self, material: &Material, model: &MetallicRoughness) -> PbrTable {
        let (layers, plain) = (&model.textures, PbrTable::plain());
        let distance = model.attenuation_distance;
        let rotation = model.anisotropy_rotation;
        let thickness = model.iridescence_thickness;
        let mut table = PbrTable {
            tint: differing::<_, Color>(material.tint, Vec3::ONE).map(Into::into),
            ior: differing(model.ior, plain.ior),
            thickness: differing(model.thickness, plain.thickness),
            attenuation_color: differing::<_, Color>(model.attenuation_color, Vec3::ONE)
                .map(Into::into),
            attenuation_distance: distance.is_finite().then(|| Positive(short(distance))),
            priority: differing(material.priority, 0),
            clearcoat_normal_map: self
                .data_map(layers.clearcoat_normal, model.clearcoat_normal_scale),
            iridescence_ior: differing(model.iridescence_ior, plain.iridescence_ior),
            iridescence_thickness: differing::<_, Thicknesses>(
                thickness,
                plain.iridescence_thickness,
            )
            .map(Into::into),
            iridescence_thickness_map: (layers.iridescence_thickness)
                .map(|map| self.number(map, None).into()),
            anisotropy_rotation_deg: (rotation.to_bits() != 0).then(|| Angle(degrees(rotation))),
            dispersion: differing(model.dispersion, plain.dispersion),
            unlit: model.unlit.then_some(true),
            ..PbrTable::default()
        };
        macro_rules! colors {
            ($($name:ident)*) => {
                $(table.$name = self.shade_unless(plain.$name, model.$name, layers.$name);)*
            };
        }
        macro_rules! numbers {
            ($($name:ident)*) => {
                $(table.$name = self.fraction(plain.$name, model.$name, layers.$name);)*
            };
        }
        colors!(base_color specular_color sheen_color diffuse_transmission_color);
        numbers!(metallic roughness specular transmission clearcoat clearcoat_roughness);
        numbers!(sheen_roughness anisotropy iridescence diffuse_transmission);
        table
    }

    /// A number, with or without a texture, unless it is the default one.
    fn fraction(
        &self,
        default: f32,
        value: f32,
        texture: Option<usize>,
    ) -> Option<Spanned<FractionOrTexture>> {
        let number = match texture {
            None => FractionOrTexture::Fraction(differing(value, default)?),
            Some(texture) => {
                let table = self.number(texture, differing(value, 1.0));
                FractionOrTexture::Table(Box::new(table))
            }
        };
        Some(number.into())
    }

    /// A texture of numbers, and a factor on it.
    fn number(&self, texture: usize, value: Option<Fraction>) -> NumberTable {
        NumberTable {
            texture: Some(self.names.texture(texture)),
            value,
            ..NumberTable::default()
        }
    }
}

/// An angle in degrees that becomes exactly these radians.
fn degrees(radians: f32) -> f64 {
    let near = f64::from(radians).to_degrees();
    let is_it = |[degrees]: [f64; 1]| (degrees.to_radians() as f32).to_bits() == radians.to_bits();
    shortest([near], is_it).map_or(near, |[degrees]| degrees)
}
