//! Sets of texture coordinates: a file has any number, and a mesh two. Each material gets those that its maps use.

use super::Reader;
use super::document::{Material as Source, Primitive};
use super::map_kinds::{MapKind, all_maps};
use crate::import::error::ImportError;
use crate::import::source::quote;
use glam::Vec3;
use glimray_scene::{MetallicRoughness, Space};
use std::collections::HashMap;

/// How much a map matters, from the most: where there are too many sets, the last ones are not shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    /// A texture of the surface itself.
    Main,
    /// A texture of a layer on it, which only paths show.
    Layer,
    /// A texture of a layer that is not there: its factor is 0.
    Idle,
}

/// The sets of texture coordinates of a material.
#[derive(Debug, Default)]
pub(super) struct Sets {
    /// Sets in the file that become the first and the second set of a mesh.
    slots: Vec<u32>,
    /// For sets that are the same as another in all primitives of the material, that other.
    same: HashMap<u32, u32>,
}

impl Sets {
    /// The place of the set with this number in the meshes of the material; `None` if it has none.
    pub fn space(&self, set: u32) -> Option<Space> {
        let set = *self.same.get(&set).unwrap_or(&set);
        match self.slots.iter().position(|slot| *slot == set)? {
            0 => Some(Space::Uv),
            _ => Some(Space::SecondUv),
        }
    }

    /// The numbers of the sets in a mesh's first and second set.
    pub fn into_slots(self) -> Vec<u32> {
        self.slots
    }
}

impl<'a> Reader<'a> {
    /// The sets of texture coordinates of `materials[index]`, which is `source` with the parameters `model` and emits light
    /// at some time if it `can_emit`. Maps with a third set are noted.
    pub(super) fn sets_of(
        &mut self,
        source: &Source,
        index: usize,
        model: &MetallicRoughness,
        can_emit: bool,
    ) -> Result<Sets, ImportError> {
        let here = format!("materials[{index}]");
        let mut maps = Vec::new();
        for (kind, info) in all_maps(source) {
            let Some(rank) = rank(kind, source, model, can_emit) else {
                continue;
            };
            let name = kind.name();
            if let Some(map) = self.map(info, &format!("{here}.{name}"))? {
                maps.push((rank, name, map.uv_set));
            }
        }
        maps.sort_by_key(|(rank, ..)| *rank);
        let mut slots: Vec<u32> = Vec::new();
        for (_, _, set) in &maps {
            if !slots.contains(set) {
                slots.push(*set);
            }
        }
        let mut sets = Sets::default();
        if slots.len() > 2 {
            sets.same = self.same_sets(index, &slots);
            slots.retain(|set| !sets.same.contains_key(set));
            slots.truncate(2);
        }
        sets.slots = slots;
        for (rank, map, set) in maps {
            if rank != Rank::Idle && sets.space(set).is_none() {
                let name = source.name.as_deref().unwrap_or_default();
                self.notes.add("maps that are not shown", || {
                    let name = match name {
                        "" => String::new(),
                        name => format!(" {}", quote(name.as_bytes())),
                    };
                    format!("{here}{name}: {map} is not shown, as TEXCOORD_{set} is a third set of texture coordinates")
                });
            }
        }
        Ok(sets)
    }

    /// For those of `sets` that are the same as an earlier one in all primitives of `materials[index]`, that one.
    fn same_sets(&self, index: usize, sets: &[u32]) -> HashMap<u32, u32> {
        let primitives_of = self.primitives_of.get_or_init(|| self.primitives_of());
        let primitives = primitives_of.get(&index).map_or(&[][..], |it| it);
        let accessors = |set: &u32| -> Vec<Option<usize>> {
            let name = format!("TEXCOORD_{set}");
            let attributes = primitives.iter().map(|primitive| &primitive.attributes);
            attributes.map(|all| all.get(&name).copied()).collect()
        };
        let mut first = HashMap::new();
        let mut same = HashMap::new();
        for &set in sets {
            let known = *first.entry(accessors(&set)).or_insert(set);
            if known != set {
                same.insert(set, known);
            }
        }
        same
    }

    /// The primitives of each material in the chosen variant.
    fn primitives_of(&self) -> HashMap<usize, Vec<&'a Primitive>> {
        let mut found: HashMap<usize, Vec<&Primitive>> = HashMap::new();
        for primitive in (self.document.meshes.iter()).flat_map(|mesh| &mesh.primitives) {
            if let Some(material) = self.material_index(primitive) {
                found.entry(material).or_default().push(primitive);
            }
        }
        found
    }
}

/// How much a map matters; `None` if the material shows none of this kind.
fn rank(map: MapKind, source: &Source, model: &MetallicRoughness, can_emit: bool) -> Option<Rank> {
    let extensions = source.extensions.as_deref();
    let is_older = extensions.is_some_and(|it| it.specular_glossiness.is_some());
    let layer = |is_there| Some(if is_there { Rank::Layer } else { Rank::Idle });
    let surface = |is_there: bool| is_there.then_some(Rank::Main);
    if model.unlit && !matches!(map, MapKind::BaseColor | MapKind::Diffuse) {
        return None;
    }
    match map {
        MapKind::BaseColor | MapKind::MetallicRoughness => surface(!is_older),
        MapKind::Emissive => surface(can_emit),
        MapKind::Diffuse | MapKind::Normal | MapKind::Occlusion | MapKind::Transmission => {
            surface(true)
        }
        MapKind::Specular | MapKind::SpecularColor => layer(model.specular > 0.0),
        MapKind::Clearcoat | MapKind::ClearcoatRoughness | MapKind::ClearcoatNormal => {
            layer(model.clearcoat > 0.0)
        }
        MapKind::SheenColor | MapKind::SheenRoughness => layer(model.sheen_color != Vec3::ZERO),
        MapKind::Anisotropy => layer(model.anisotropy > 0.0),
        MapKind::Iridescence | MapKind::IridescenceThickness => layer(model.iridescence > 0.0),
        MapKind::DiffuseTransmission | MapKind::DiffuseTransmissionColor => {
            layer(model.diffuse_transmission > 0.0)
        }
        MapKind::SpecularGlossiness => None,
    }
}
