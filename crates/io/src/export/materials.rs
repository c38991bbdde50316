//! The materials of a scene.

use super::exact::{same_bits, shortest};
use super::text::{Table, color, key, number32, string};
use super::{ExportError, Writer};
use glam::Vec3;
use glimray_scene::{
    Bsdf, Coverage, Fresnel, Material, MaterialProperty, Mixing, Phong, PhongTextures, Target,
};

/// The defaults of a native material.
const SHININESS: f32 = 32.0;
const IOR: f32 = 1.5;

impl Writer<'_> {
    pub fn materials(&mut self) -> Result<(), ExportError> {
        let scene = self.scene;
        if !scene.materials.is_empty() {
            self.text.section("Materials");
        }
        for (index, material) in scene.materials.iter().enumerate() {
            let mut table = Table::default();
            match &material.bsdf {
                Bsdf::MetallicRoughness(model) => {
                    table.put("pbr", self.physical(material, model).inline());
                    self.classical(&mut table, index, material, model);
                }
                Bsdf::Phong(phong) => {
                    let local = self.phong(index, phong);
                    table.put_if(!local.is_empty(), "phong", local.inline());
                    self.optics(&mut table, material, phong);
                }
            }
            let emission = self.shade(material.emission, material.textures.emission);
            let shines =
                !same_bits(material.emission, Vec3::ZERO) || material.textures.emission.is_some();
            table.put_if(shines, "emission", emission);
            table.put_if(!material.two_sided, "two_sided", "false");
            let is_from_front = !material.two_sided_emission;
            table.put_if(is_from_front, "two_sided_emission", "false");
            let coverage = self.coverage(material);
            table.put_if(!coverage.is_empty(), "coverage", coverage.inline());
            table.put_if(material.thin, "thin", "true".to_owned());
            table.put_if(material.shadow_catcher, "shadow_catcher", "true");
            let own = &material.textures;
            if let Some(map) = self.height_map(own.normal, material.normal_scale)? {
                table.put("height_map", map);
            } else if let Some(map) = self.data_map(own.normal, material.normal_scale) {
                table.put("normal_map", map);
            }
            if let Some(map) = self.data_map(own.occlusion, material.occlusion_strength) {
                table.put("occlusion_map", map);
            }
            self.text.gap();
            let name = key(&self.names.materials[index]);
            self.text.head(&format!("[materials.{name}]"));
            self.text.lines(&table);
        }
        Ok(())
    }

    /// How much of the surface is there; empty if all of it is.
    fn coverage(&self, material: &Material) -> Table {
        let mut table = Table::default();
        let least = match material.coverage {
            Coverage::Opaque => return table,
            Coverage::Mask(least) => Some(least),
            Coverage::Blend => None,
        };
        table.put("alpha", number32(material.alpha));
        if let Some(map) = material.textures.alpha {
            table.put("map", self.shade(Vec3::ONE, Some(map)));
        }
        if let Some(least) = least {
            table.put("mask", number32(least));
        }
        table
    }

    pub fn phong(&self, index: usize, phong: &Phong) -> Table {
        let PhongTextures {
            diffuse,
            specular,
            ambient,
            ..
        } = phong.textures;
        let mut table = Table::default();
        let is_plain = same_bits(phong.diffuse, Vec3::splat(0.8)) && diffuse.is_none();
        table.put_if(!is_plain, "diffuse", self.shade(phong.diffuse, diffuse));
        let is_matt = same_bits(phong.specular, Vec3::ZERO) && specular.is_none();
        table.put_if(!is_matt, "specular", self.shade(phong.specular, specular));
        let differs = phong.shininess != SHININESS;
        table.put_if(differs, "shininess", number32(phong.shininess));
        let own = !has_same_ambient(phong) || self.is_own_ambient(index);
        table.put_if(own, "ambient", self.shade(phong.ambient, ambient));
        table
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
    pub fn shade(&self, constant: Vec3, texture: Option<usize>) -> String {
        let Some(texture) = texture else {
            return color(constant);
        };
        let mut table = Table::default();
        table.put("texture", string(&self.names.textures[texture]));
        table.put_if(!same_bits(constant, Vec3::ONE), "color", color(constant));
        table.inline()
    }

    /// Reflection and transmission.
    fn optics(&self, table: &mut Table, material: &Material, phong: &Phong) {
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
            return;
        }
        let is_read = (0.01..=100.0).contains(&phong.ior);
        if is_layered && is_read && is_opaque {
            table.put("reflect", self.reflect(phong).inline());
        } else if let (true, true, Some(refract)) =
            (is_layered, is_read, self.refract(material, phong))
        {
            if !is_dull && phong.fresnel == Fresnel::None {
                let mut reflect = Table::default();
                self.mirror(&mut reflect, phong);
                table.put("reflect", reflect.inline());
            }
            table.put("refract", refract.inline());
        } else {
            table.put("optics", self.directly(material, phong).inline());
        }
    }

    fn reflect(&self, phong: &Phong) -> Table {
        let mut table = Table::default();
        self.mirror(&mut table, phong);
        put_fresnel(&mut table, phong.fresnel, Fresnel::None);
        table.put_if(phong.ior != IOR, "ior", number32(phong.ior));
        table
    }

    /// The reflected fraction and its colour.
    fn mirror(&self, table: &mut Table, phong: &Phong) {
        let amount = phong.reflect.x;
        let texture = phong.textures.reflect;
        if texture.is_none() && same_bits(phong.reflect, Vec3::splat(amount)) && amount <= 1.0 {
            table.put_if(amount != 1.0, "amount", number32(amount));
        } else {
            table.put("color", self.shade(phong.reflect, texture));
        }
    }

    /// The `refract` table, if one expresses the transmission exactly, beside a mirror or with its own Fresnel term.
    fn refract(&self, material: &Material, phong: &Phong) -> Option<Table> {
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
        let texture = phong.textures.transmit;
        let mut table = Table::default();
        table.put_if(amount != 1.0, "amount", number32(amount));
        table.put_if(phong.ior != IOR, "ior", number32(phong.ior));
        let is_clear = same_bits(through, Vec3::ONE) && texture.is_none();
        table.put_if(!is_clear, "color", self.shade(through, texture));
        put_absorption(&mut table, phong);
        put_fresnel(&mut table, phong.fresnel, Fresnel::Exact);
        let differs = material.priority != 0;
        table.put_if(differs, "priority", material.priority.to_string());
        Some(table)
    }

    pub fn directly(&self, material: &Material, phong: &Phong) -> Table {
        let PhongTextures {
            reflect, transmit, ..
        } = phong.textures;
        let mut table = Table::default();
        let shows =
            |c: Vec3, texture: Option<usize>| !same_bits(c, Vec3::ZERO) || texture.is_some();
        let mirrors = shows(phong.reflect, reflect);
        table.put_if(mirrors, "reflect", self.shade(phong.reflect, reflect));
        let passes = shows(phong.transmit, transmit);
        table.put_if(passes, "transmit", self.shade(phong.transmit, transmit));
        table.put_if(phong.opacity != 1.0, "opacity", number32(phong.opacity));
        table.put_if(phong.ior != 1.0, "ior", number32(phong.ior));
        put_absorption(&mut table, phong);
        put_fresnel(&mut table, phong.fresnel, Fresnel::None);
        let differs = material.priority != 0;
        table.put_if(differs, "priority", material.priority.to_string());
        match phong.mixing {
            Mixing::Layer => {}
            Mixing::Sum => table.put("mixing", string("sum")),
            Mixing::Blend => table.put("mixing", string("blend")),
        }
        table
    }
}

/// Whether the ambient colour equals the diffuse one, which is the default.
pub(super) fn has_same_ambient(phong: &Phong) -> bool {
    let textures = &phong.textures;
    same_bits(phong.ambient, phong.diffuse) && textures.ambient == textures.diffuse
}

fn put_absorption(table: &mut Table, phong: &Phong) {
    let clear = same_bits(phong.absorption, Vec3::ZERO);
    let numbers = phong.absorption.to_array().map(number32);
    table.put_if(!clear, "absorption", super::text::list(numbers));
}

fn put_fresnel(table: &mut Table, fresnel: Fresnel, default: Fresnel) {
    let name = match fresnel {
        Fresnel::None => "none",
        Fresnel::Exact => "exact",
        Fresnel::Schlick => "schlick",
    };
    table.put_if(fresnel != default, "fresnel", string(name));
}
