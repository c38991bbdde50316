//! Metallic-roughness materials of a scene.

use super::Writer;
use super::exact::{same_bits, shortest};
use super::text::{Table, color, list, number, number32, string};
use glam::Vec3;
use glimray_scene::{LayerTextures, Material, MetallicRoughness, Phong};

impl Writer<'_> {
    /// Adds keys for the classical integrators, where these show `material` otherwise than what follows from `model`.
    pub fn classical(
        &self,
        table: &mut Table,
        index: usize,
        material: &Material,
        model: &MetallicRoughness,
    ) {
        let (own, derived) = (material.classical(), model.derived_phong(material.tint));
        let local = |phong: &Phong| {
            let colors = [phong.diffuse, phong.specular, phong.ambient];
            let it = &phong.textures;
            let textures = (it.diffuse, it.specular, it.ambient);
            (format!("{colors:?}"), phong.shininess.to_bits(), textures)
        };
        if local(&own) != local(&derived) || self.is_own_ambient(index) {
            table.put("phong", self.phong(index, &own).inline());
        }
        let optical = |phong: &Phong| {
            let colors = [phong.reflect, phong.transmit, phong.absorption];
            let numbers = [phong.opacity, phong.ior].map(f32::to_bits);
            let textures = (phong.textures.reflect, phong.textures.transmit);
            let ways = (phong.fresnel, phong.mixing);
            (format!("{colors:?}"), numbers, ways, textures)
        };
        if optical(&own) != optical(&derived) {
            table.put("optics", self.directly(material, &own).inline());
        }
    }

    /// The parameters that are not the defaults of a native scene.
    pub fn physical(&self, material: &Material, model: &MetallicRoughness) -> Table {
        let layers = &model.textures;
        let none = MetallicRoughness::default();
        let mut table = Table::default();
        macro_rules! numbers {
            ($($name:ident $default:expr),*) => {
                $(self.fraction(&mut table, stringify!($name), model.$name, layers.$name, $default);)*
            };
        }
        macro_rules! colors {
            ($($name:ident $default:expr),*) => {
                $(
                    let is_default = same_bits(model.$name, $default) && layers.$name.is_none();
                    let shade = self.shade(model.$name, layers.$name);
                    table.put_if(!is_default, stringify!($name), shade);
                )*
            };
        }
        macro_rules! plain {
            ($($name:ident),*) => {
                $(table.put_if(model.$name != none.$name, stringify!($name), number32(model.$name));)*
            };
        }
        colors!(base_color Vec3::splat(0.8));
        table.put_if(
            !same_bits(material.tint, Vec3::ONE),
            "tint",
            color(material.tint),
        );
        numbers!(metallic 0.0, roughness 0.5);
        plain!(ior);
        numbers!(specular 1.0);
        colors!(specular_color Vec3::ONE);
        numbers!(transmission 0.0);
        plain!(thickness);
        let tint = model.attenuation_color;
        table.put_if(
            !same_bits(tint, Vec3::ONE),
            "attenuation_color",
            color(tint),
        );
        plain!(attenuation_distance);
        table.put_if(
            material.priority != 0,
            "priority",
            material.priority.to_string(),
        );
        numbers!(clearcoat 0.0, clearcoat_roughness 0.0);
        let map = self.data_map(layers.clearcoat_normal, model.clearcoat_normal_scale);
        if let Some(map) = map {
            table.put("clearcoat_normal_map", map);
        }
        colors!(sheen_color Vec3::ZERO);
        numbers!(sheen_roughness 0.0, anisotropy 0.0, iridescence 0.0);
        plain!(iridescence_ior);
        self.film(&mut table, model, layers);
        table.put_if(
            model.anisotropy_rotation.to_bits() != 0,
            "anisotropy_rotation_deg",
            number(degrees(model.anisotropy_rotation)),
        );
        plain!(dispersion);
        numbers!(diffuse_transmission 0.0);
        colors!(diffuse_transmission_color Vec3::ONE);
        table.put_if(model.unlit, "unlit", "true");
        table
    }

    fn film(&self, table: &mut Table, model: &MetallicRoughness, layers: &LayerTextures) {
        let range = model.iridescence_thickness;
        let differs = range != MetallicRoughness::default().iridescence_thickness;
        table.put_if(differs, "iridescence_thickness", list(range.map(number32)));
        if let Some(map) = layers.iridescence_thickness {
            let mut named = Table::default();
            named.put("texture", string(&self.names.textures[map]));
            table.put("iridescence_thickness_map", named.inline());
        }
    }

    /// A number, with or without a texture.
    fn fraction(
        &self,
        table: &mut Table,
        key: &'static str,
        value: f32,
        texture: Option<usize>,
        default: f32,
    ) {
        let Some(texture) = texture else {
            table.put_if(value != default, key, number32(value));
            return;
        };
        let mut named = Table::default();
        named.put("texture", string(&self.names.textures[texture]));
        named.put_if(value != 1.0, "value", number32(value));
        table.put(key, named.inline());
    }
}

/// An angle in degrees that becomes exactly these radians.
fn degrees(radians: f32) -> f64 {
    let near = f64::from(radians).to_degrees();
    let is_it = |[degrees]: [f64; 1]| (degrees.to_radians() as f32).to_bits() == radians.to_bits();
    shortest([near], is_it).map_or(near, |[degrees]| degrees)
}
