//! The textures that a material can have, and how a picture becomes one of them.

use crate::model::objects::EditError;
use glam::{DAffine3, Vec3};
use glimray_io::import::Meaning;
use glimray_scene::{
    Background, Bsdf, Coverage, LayerTextures, Material, MetallicRoughness, Minify, Pattern, Phong,
    PhongTextures, Picture, Scene, Space, Texture, Textures, Wrap, fit,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A place for a texture in a material.
pub struct TextureSlot {
    /// The label of its row.
    pub title: &'static str,
    /// Explains the row.
    pub tip: &'static str,
    /// The meaning of a picture's values in this slot.
    pub meaning: Meaning,
    index: Index,
    wake: Wake,
}

/// Where the index of the texture is.
enum Index {
    Own(fn(&mut Textures) -> &mut Option<usize>),
    Phong(fn(&mut PhongTextures) -> &mut Option<usize>),
    Layers(fn(&mut LayerTextures) -> &mut Option<usize>),
}

/// Sets what the texture multiplies to 1 where it is 0, so that the texture shows.
enum Wake {
    Nothing,
    Own(fn(&mut Material)),
    Phong(fn(&mut Phong) -> &mut Vec3),
    Color(fn(&mut MetallicRoughness) -> &mut Vec3),
    Number(fn(&mut MetallicRoughness) -> &mut f32),
}

const MULTIPLIES: &str = "Texture that multiplies this colour or number.";
/// The title of the slot of the normal map.
pub const NORMAL_MAP: &str = "Normal map";
const COAT_MAP: &str = "Clear coat normal map";
const BUMPS: &str = "Normals of small bumps, as a picture.";

macro_rules! slot {
    ($title:expr, $tip:expr, $meaning:ident, $index:ident($name:ident), $wake:expr) => {
        TextureSlot {
            title: $title,
            tip: $tip,
            meaning: Meaning::$meaning,
            index: Index::$index(|it| &mut it.$name),
            wake: $wake,
        }
    };
}

macro_rules! phong {
    ($title:literal, $name:ident) => {
        slot!(
            $title,
            MULTIPLIES,
            Color,
            Phong($name),
            Wake::Phong(|it| &mut it.$name)
        )
    };
}

macro_rules! color {
    ($title:literal, $name:ident) => {
        slot!(
            $title,
            MULTIPLIES,
            Color,
            Layers($name),
            Wake::Color(|it| &mut it.$name)
        )
    };
}

macro_rules! number {
    ($title:literal, $name:ident) => {
        slot!(
            $title,
            MULTIPLIES,
            Numbers,
            Layers($name),
            Wake::Number(|it| &mut it.$name)
        )
    };
}

/// The textures of Phong's model.
static PHONG: [TextureSlot; 5] = [
    phong!("× Diffuse", diffuse),
    phong!("× Specular", specular),
    phong!("× Ambient", ambient),
    phong!("× Reflect", reflect),
    phong!("× Transmit", transmit),
];

/// The textures of the metallic-roughness model.
static LAYERS: [TextureSlot; 16] = [
    color!("× Base colour", base_color),
    number!("× Metallic", metallic),
    number!("× Roughness", roughness),
    number!("× Specular", specular),
    color!("× Specular colour", specular_color),
    number!("× Transmission", transmission),
    number!("× Clear coat", clearcoat),
    number!("× Clear coat roughness", clearcoat_roughness),
    slot!(
        COAT_MAP,
        BUMPS,
        Numbers,
        Layers(clearcoat_normal),
        Wake::Nothing
    ),
    color!("× Sheen colour", sheen_color),
    number!("× Sheen roughness", sheen_roughness),
    number!("× Anisotropy", anisotropy),
    number!("× Iridescence", iridescence),
    slot!(
        "Film thickness map",
        "Texture that is 0 where the film is as thick as “Film from”, in green.",
        Numbers,
        Layers(iridescence_thickness),
        Wake::Nothing
    ),
    number!("× Diffuse transmission", diffuse_transmission),
    color!("× Diffuse transmission colour", diffuse_transmission_color),
];

/// The textures that all materials have.
static OWN: [TextureSlot; 3] = [
    slot!(
        "× Emission",
        MULTIPLIES,
        Color,
        Own(emission),
        Wake::Own(|it| raise(&mut it.emission))
    ),
    slot!(NORMAL_MAP, BUMPS, Normals, Own(normal), Wake::Nothing),
    slot!(
        "× Alpha",
        "Texture whose alpha says how much of the surface is there.",
        Coverage,
        Own(alpha),
        Wake::Own(|it| {
            if it.coverage == Coverage::Opaque {
                it.coverage = Coverage::Blend;
            }
        })
    ),
];

/// The occlusion map, which has a row only if a file gives one.
static OCCLUSION: TextureSlot = slot!(
    "Occlusion map",
    "The fraction of ambient light that reaches the surface, in red.",
    Numbers,
    Own(occlusion),
    Wake::Nothing
);

fn raise(color: &mut Vec3) {
    if *color == Vec3::ZERO {
        *color = Vec3::ONE;
    }
}

impl TextureSlot {
    /// The slots of a material, in the order of their rows.
    pub fn of(material: &Material) -> impl Iterator<Item = &'static Self> + use<> {
        let model: &[Self] = match &material.bsdf {
            Bsdf::Phong(_) => &PHONG,
            Bsdf::MetallicRoughness(_) => &LAYERS,
        };
        let occlusion = material.textures.occlusion.map(|_| &OCCLUSION);
        model.iter().chain(&OWN).chain(occlusion)
    }

    /// The index of the texture in [`Scene::textures`]; `None` without one.
    pub fn get(&self, material: &Material) -> Option<usize> {
        match (&self.index, &material.bsdf) {
            (Index::Own(slot), _) => {
                let mut own = material.textures;
                *slot(&mut own)
            }
            (Index::Phong(slot), Bsdf::Phong(phong)) => {
                let mut own = phong.textures;
                *slot(&mut own)
            }
            (Index::Layers(slot), Bsdf::MetallicRoughness(model)) => {
                let mut own = model.textures;
                *slot(&mut own)
            }
            _ => None,
        }
    }

    /// Replaces the index. Surfaces get the tangents that they need then.
    ///
    /// # Errors
    /// The material is no longer there, or is of another model.
    pub fn set(
        &self,
        scene: &mut Scene,
        material: usize,
        texture: Option<usize>,
    ) -> Result<(), EditError> {
        self.change(scene, |scene| self.set_index(scene, material, texture))
    }

    /// Changes textures of this slot. Tangents follow.
    fn change<T>(&self, scene: &mut Scene, change: impl FnOnce(&mut Scene) -> T) -> T {
        match [NORMAL_MAP, COAT_MAP].contains(&self.title) {
            true => scene.change_mappings(change),
            false => change(scene),
        }
    }

    fn set_index(
        &self,
        scene: &mut Scene,
        material: usize,
        texture: Option<usize>,
    ) -> Result<(), EditError> {
        let own = scene.materials.get_mut(material).ok_or(EditError::Gone)?;
        let slot = match (&self.index, &mut own.bsdf) {
            (Index::Own(slot), _) => slot(&mut own.textures),
            (Index::Phong(slot), Bsdf::Phong(phong)) => slot(&mut phong.textures),
            (Index::Layers(slot), Bsdf::MetallicRoughness(model)) => {
                slot(&mut Arc::make_mut(model).textures)
            }
            _ => return Err(EditError::Gone),
        };
        *slot = texture;
        Ok(())
    }

    /// Gives materials a picture here. It takes the placement of the picture that it replaces; other users of that one keep
    /// it. A factor of 0 becomes 1. Returns how many times pictures were halved so that all fit into memory.
    ///
    /// # Errors
    /// As [`Self::set`].
    pub fn show(
        &self,
        scene: &mut Scene,
        materials: &[usize],
        picture: Arc<Picture>,
    ) -> Result<usize, EditError> {
        scene.pictures.push(picture);
        let picture = scene.pictures.len() - 1;
        let mut known = BTreeMap::new();
        self.change(scene, |scene| {
            (materials.iter())
                .try_for_each(|material| self.show_one(scene, *material, picture, &mut known))
        })?;
        Ok(fit_used(scene))
    }

    /// `known`: the textures of the picture, by those that they replace.
    fn show_one(
        &self,
        scene: &mut Scene,
        material: usize,
        picture: usize,
        known: &mut BTreeMap<Option<usize>, usize>,
    ) -> Result<(), EditError> {
        let own = scene.materials.get(material).ok_or(EditError::Gone)?;
        let before = self.get(own);
        if before.is_none() {
            self.wake(&mut scene.materials[material]);
        }
        if let Some(texture) = known.get(&before) {
            return self.set_index(scene, material, Some(*texture));
        }
        let users = (scene.materials.iter())
            .flat_map(Material::texture_indices)
            .filter(|index| Some(*index) == before)
            .count();
        let placed = before.filter(|index| {
            let pattern = &scene.textures[*index].pattern;
            matches!(pattern, Pattern::Picture { .. })
        });
        let mut texture = match placed {
            Some(index) => scene.textures[index].clone(),
            None => Texture {
                pattern: Pattern::Picture {
                    picture,
                    nearest: false,
                    minify: Minify::default(),
                    wrap: [Wrap::Repeat; 2],
                },
                space: Space::Uv,
                pattern_from_space: DAffine3::IDENTITY,
            },
        };
        if let Pattern::Picture { picture: shown, .. } = &mut texture.pattern {
            *shown = picture;
        }
        match placed.filter(|_| users == 1) {
            Some(index) => scene.textures[index] = texture,
            None => {
                scene.textures.push(texture);
                let own = scene.textures.len() - 1;
                known.insert(before, own);
                self.set_index(scene, material, Some(own))?;
            }
        }
        Ok(())
    }

    fn wake(&self, material: &mut Material) {
        match (&self.wake, &mut material.bsdf) {
            (Wake::Own(wake), _) => wake(material),
            (Wake::Phong(color), Bsdf::Phong(phong)) => raise(color(phong)),
            (Wake::Color(color), Bsdf::MetallicRoughness(model)) => {
                raise(color(Arc::make_mut(model)));
            }
            (Wake::Number(number), Bsdf::MetallicRoughness(model)) => {
                let number = number(Arc::make_mut(model));
                if *number == 0.0 {
                    *number = 1.0;
                }
            }
            _ => {}
        }
    }
}

/// Halves the pictures that are shown until they fit into memory. Returns how many times that was.
fn fit_used(scene: &mut Scene) -> usize {
    let textures = scene.materials.iter().flat_map(Material::texture_indices);
    let mut used: BTreeSet<usize> = textures
        .filter_map(|texture| match scene.textures[texture].pattern {
            Pattern::Picture { picture, .. } => Some(picture),
            _ => None,
        })
        .collect();
    if let Background::Picture { picture, .. } = scene.background {
        used.insert(picture);
    }
    let pictures = scene.pictures.iter_mut().enumerate();
    fit(pictures.filter_map(|(index, picture)| used.contains(&index).then_some(picture)))
}

impl std::fmt::Debug for TextureSlot {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.title)
    }
}
