//! The property that a channel of a clip animates, given by node and path, or by a pointer into the JSON
//! (`KHR_animation_pointer`).

use super::Reader;
use super::document::{ChannelTarget, Kind, Material as Source, TextureInfo};
use super::map_kinds::{MapKind, all_maps};
use super::materials::MaterialKey;
use crate::import::error::ImportError;
use glam::DVec3;
use glimray_scene::{
    CameraProperty, Coverage, LayerProperty, LightProperty, Material, MaterialProperty,
    MetallicRoughness, NodeProperty, Target, TextureProperty,
};
use std::f64::consts::PI;

/// A property of something in the file, by its number there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Aim {
    Node(usize, NodeProperty),
    /// The weights of the morph targets of a node's mesh, or of a mesh wherever a node has none of its own.
    WeightsOfNode(usize),
    WeightsOfMesh(usize),
    Camera(usize, CameraProperty),
    Light(usize, LightProperty),
    Emission(usize),
    Layer(usize, LayerProperty),
    /// The transform of a map of a material, by the name of its property.
    Map(usize, &'static str, TextureProperty),
}

/// The values of a channel, before they are values of the scene.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Values {
    Scalar,
    /// With their components, and factors to those of the scene.
    Vector,
    Rotation,
    /// Never 0.
    Scale,
}

impl Aim {
    /// The property that `target` names; `None` if it cannot be animated or is missing.
    pub fn of(target: &ChannelTarget) -> Option<Self> {
        if target.path != "pointer" {
            return Self::of_node(target.node?, &target.path);
        }
        let extensions = target.extensions.as_ref()?;
        Self::at(&extensions.pointer.as_ref()?.pointer)
    }

    fn of_node(node: usize, property: &str) -> Option<Self> {
        Some(match property {
            "translation" => Self::Node(node, NodeProperty::Translation),
            "rotation" => Self::Node(node, NodeProperty::Rotation),
            "scale" => Self::Node(node, NodeProperty::Scale),
            "weights" => Self::WeightsOfNode(node),
            "extensions/KHR_node_visibility/visible" => Self::Node(node, NodeProperty::Visible),
            _ => return None,
        })
    }

    /// The property that a JSON pointer (RFC 6901) leads to.
    fn at(pointer: &str) -> Option<Self> {
        let rest = pointer.strip_prefix('/')?;
        let lights = "extensions/KHR_lights_punctual/lights/";
        if let Some(rest) = rest.strip_prefix(lights) {
            let (index, property) = rest.split_once('/')?;
            let property = match property {
                "color" => LightProperty::Color,
                "intensity" => LightProperty::Intensity,
                _ => return None,
            };
            return Some(Self::Light(index.parse().ok()?, property));
        }
        let (list, rest) = rest.split_once('/')?;
        let (index, property) = rest.split_once('/')?;
        let index = index.parse().ok()?;
        Some(match (list, property) {
            ("nodes", property) => Self::of_node(index, property)?,
            ("meshes", "weights") => Self::WeightsOfMesh(index),
            ("cameras", "perspective/yfov") => Self::Camera(index, CameraProperty::FovY),
            ("cameras", "orthographic/ymag") => {
                Self::Camera(index, CameraProperty::OrthographicHeight)
            }
            ("materials", "emissiveFactor") => Self::Emission(index),
            ("materials", property) => match map_property(property) {
                Some((map, property)) => Self::Map(index, map, property),
                None => Self::Layer(index, layer(property)?),
            },
            _ => return None,
        })
    }

    /// The type of its values in the file.
    pub fn kind(self) -> Kind {
        match self {
            Self::Node(_, NodeProperty::Rotation) | Self::Layer(_, LayerProperty::BaseColor) => {
                Kind::Vec4
            }
            Self::Node(_, NodeProperty::Translation | NodeProperty::Scale)
            | Self::Light(_, LightProperty::Color)
            | Self::Emission(_) => Kind::Vec3,
            Self::Map(_, _, TextureProperty::Offset | TextureProperty::Scale) => Kind::Vec2,
            _ => Kind::Scalar,
        }
    }

    /// The type of its values in the scene.
    pub fn values(self) -> Values {
        match self {
            Self::Node(_, NodeProperty::Rotation) => Values::Rotation,
            Self::Node(_, NodeProperty::Scale) => Values::Scale,
            _ if self.kind() == Kind::Scalar => Values::Scalar,
            _ => Values::Vector,
        }
    }
}

/// The parameter of a material that a pointer names.
fn layer(property: &str) -> Option<LayerProperty> {
    Some(match property {
        "pbrMetallicRoughness/baseColorFactor" => LayerProperty::BaseColor,
        "pbrMetallicRoughness/metallicFactor" => LayerProperty::Metallic,
        "pbrMetallicRoughness/roughnessFactor" => LayerProperty::Roughness,
        "extensions/KHR_materials_ior/ior" => LayerProperty::Ior,
        "extensions/KHR_materials_transmission/transmissionFactor" => LayerProperty::Transmission,
        "extensions/KHR_materials_emissive_strength/emissiveStrength" => {
            LayerProperty::EmissionStrength
        }
        _ => return None,
    })
}

/// The map of a material whose transform a pointer names, by the name of its property, and the part of the transform.
fn map_property(property: &str) -> Option<(&'static str, TextureProperty)> {
    let (map, part) = property.split_once("/extensions/KHR_texture_transform/")?;
    let part = match part {
        "offset" => TextureProperty::Offset,
        "rotation" => TextureProperty::Rotation,
        "scale" => TextureProperty::Scale,
        _ => return None,
    };
    let name = map.rsplit('/').next()?;
    MapKind::shown(name).map(|kind| (kind.name(), part))
}

/// The map of a material with a property of this name.
pub(super) fn map_of<'m>(material: &'m Source, name: &str) -> Option<&'m TextureInfo> {
    let mut maps = all_maps(material).into_iter();
    maps.find(|(kind, _)| kind.name() == name)
        .map(|(_, info)| info)
}

/// A target in the scene, and what the values in the file are multiplied with for it.
pub(super) type Scaled = (Target, DVec3);

impl Reader<'_> {
    /// The targets of `aim` in the scene, apart from weights; none if the chosen scene has none. `is_lit` says
    /// of a light of the file whether its intensity is animated too.
    ///
    /// # Errors
    /// The reason why it cannot be animated.
    pub(super) fn targets(
        &mut self,
        aim: Aim,
        is_lit: impl Fn(usize) -> bool,
    ) -> Result<Vec<Scaled>, &'static str> {
        let same = |target| (target, DVec3::ONE);
        match aim {
            Aim::Node(index, property) => {
                let node = self.node_of.get(index).copied().flatten();
                Ok(node
                    .map(|node| same(Target::Node(node, property)))
                    .into_iter()
                    .collect())
            }
            Aim::WeightsOfNode(_) | Aim::WeightsOfMesh(_) => Ok(Vec::new()),
            Aim::Camera(index, property) => {
                let lens = &self.document.cameras[index];
                let is_flat = lens.perspective.is_none() && lens.orthographic.is_some();
                if is_flat != (property == CameraProperty::OrthographicHeight) {
                    return Err("a lens that the camera has not");
                }
                // The height of a view is twice that of its half.
                let factor = match property {
                    CameraProperty::OrthographicHeight => 2.0,
                    _ => 1.0,
                };
                let cameras = self.cameras.iter().enumerate();
                let cameras = cameras.filter(|(_, file)| **file == index);
                Ok(cameras
                    .map(|(camera, _)| (Target::Camera(camera, property), DVec3::splat(factor)))
                    .collect())
            }
            Aim::Light(index, property) => {
                let source = self.document.extensions.lights.as_ref();
                let Some(source) = source.and_then(|it| it.lights.get(index)) else {
                    return Ok(Vec::new());
                };
                // A light that is dark at first has its colour with an intensity of 1.
                let at_rest = source.intensity.unwrap_or(1.0).max(0.0);
                let is_dark = at_rest == 0.0 && is_lit(index);
                let unit = if is_dark { 1.0 } else { at_rest };
                let factor = match property {
                    LightProperty::Intensity => unit.max(1e-30).recip(),
                    _ => unit / PI,
                };
                let lights = self.lights.iter().enumerate();
                let lights = lights.filter(|(_, file)| **file == index).map(|(i, _)| i);
                let lights: Vec<usize> = lights.collect();
                if is_dark {
                    let color = source.color.unwrap_or([1.0; 3]).map(|c| (c / PI) as f32);
                    for &light in &lights {
                        self.scene.lights[light].color = color.into();
                    }
                }
                Ok(lights
                    .into_iter()
                    .map(|light| (Target::Light(light, property), DVec3::splat(factor)))
                    .collect())
            }
            Aim::Emission(index) => {
                let factor = DVec3::splat(self.emissive_strength(index));
                let add = |material: usize, shown: &Material| {
                    let is_unlit = shown.metallic_roughness().is_some_and(|it| it.unlit);
                    let target = Target::Material(material, MaterialProperty::Emission);
                    (!is_unlit)
                        .then_some((target, factor))
                        .into_iter()
                        .collect()
                };
                Ok(self.targets_of_material(index, add))
            }
            Aim::Layer(index, property) => self.layer_targets(index, property),
            Aim::Map(index, map, property) => {
                let info = map_of(&self.document.materials[index], map);
                let texture =
                    info.and_then(|info| *self.moved_maps.get(&std::ptr::from_ref(info))?);
                Ok(texture
                    .map(|texture| same(Target::Texture(texture, property)))
                    .into_iter()
                    .collect())
            }
        }
    }

    fn emissive_strength(&self, material: usize) -> f64 {
        let extensions = self.document.materials[material].extensions.as_ref();
        let strength = extensions.and_then(|it| it.emissive_strength.as_ref());
        let strength = strength.and_then(|it| it.emissive_strength).unwrap_or(1.0);
        strength.clamp(0.0, 1e12)
    }

    /// The index in the scene of a material of the file, if something shows it.
    fn shown_material(&self, index: usize) -> Option<usize> {
        let shown = self.materials.get(&MaterialKey(Some(index)));
        shown.map(|&material| material as usize)
    }

    /// The target that `of` gives for a material of the file, if something shows it.
    fn targets_of_material(
        &self,
        index: usize,
        of: impl Fn(usize, &Material) -> Vec<Scaled>,
    ) -> Vec<Scaled> {
        let shown = self.shown_material(index);
        shown.map_or_else(Vec::new, |material| {
            of(material, &self.scene.materials[material])
        })
    }

    /// The alphas that follow the fourth component of an animated base colour.
    pub(super) fn alphas(&self, aim: Aim) -> Vec<Scaled> {
        let Aim::Layer(index, LayerProperty::BaseColor) = aim else {
            return Vec::new();
        };
        self.targets_of_material(index, |material, shown| {
            let target = Target::Layer(material, LayerProperty::Alpha);
            let has_holes = shown.coverage != Coverage::Opaque;
            has_holes
                .then_some((target, DVec3::ONE))
                .into_iter()
                .collect()
        })
    }

    fn layer_targets(
        &mut self,
        index: usize,
        property: LayerProperty,
    ) -> Result<Vec<Scaled>, &'static str> {
        let rest = self.emissive_strength(index);
        if property == LayerProperty::EmissionStrength && rest == 0.0 {
            return Err("the strength of an emission that is 0 at rest");
        }
        if property == LayerProperty::Transmission {
            // Where there is glass at some time, it is a thin wall at all times unless it has a thickness.
            if let Some(material) = self.shown_material(index) {
                let material = &mut self.scene.materials[material];
                let is_wall =
                    |it: &MetallicRoughness| it.thickness == 0.0 && it.transmission == 0.0;
                material.thin = material.metallic_roughness().is_some_and(is_wall);
            }
        }
        let targets = self.targets_of_material(index, |material, shown| {
            let Some(model) = shown.metallic_roughness() else {
                return Vec::new();
            };
            let layer = |factor| (Target::Layer(material, property), DVec3::splat(factor));
            match property {
                LayerProperty::EmissionStrength => vec![layer(rest.recip())],
                // The colour is the emission then.
                LayerProperty::BaseColor if model.unlit => {
                    let target = Target::Material(material, MaterialProperty::Emission);
                    vec![(target, DVec3::ONE)]
                }
                _ if model.unlit => Vec::new(),
                _ => vec![layer(1.0)],
            }
        });
        let is_baked = |(target, _): &Scaled| match *target {
            Target::Layer(material, _) => self.scene.materials[material].has_classical_maps(),
            _ => false,
        };
        let is_classical = !self.traces_paths && property != LayerProperty::EmissionStrength;
        if is_classical && targets.iter().any(is_baked) {
            let what = match property {
                LayerProperty::BaseColor => "base colour",
                LayerProperty::Metallic => "metalness",
                LayerProperty::Roughness => "roughness",
                LayerProperty::Ior => "index of refraction",
                _ => "transmission",
            };
            self.notes.add("animations that are not shown", || {
                format!("the {what} of materials[{index}], which has several maps, is animated by path tracing only")
            });
        }
        Ok(targets)
    }

    /// The deformations whose weights `aim` animates.
    pub(super) fn deformations_of(&self, aim: Aim) -> Vec<usize> {
        let nodes = &self.document.nodes;
        let is_meant = |index: usize| match aim {
            Aim::WeightsOfNode(node) => node == index,
            Aim::WeightsOfMesh(mesh) => {
                nodes[index].mesh == Some(mesh) && nodes[index].weights.is_none()
            }
            _ => false,
        };
        let deforming = self.deforming.iter().enumerate();
        deforming
            .filter(|(_, (node, _))| is_meant(*node))
            .map(|(deformation, _)| deformation)
            .collect()
    }

    /// Whether `aim` is weights of a mesh that has no morph targets.
    pub(super) fn lacks_targets(&self, aim: Aim) -> bool {
        let mesh = match aim {
            Aim::WeightsOfNode(node) => self.document.nodes[node].mesh,
            Aim::WeightsOfMesh(mesh) => Some(mesh),
            _ => return false,
        };
        let mesh = mesh.and_then(|mesh| self.document.meshes.get(mesh));
        let primitives = mesh.map_or(&[][..], |mesh| &mesh.primitives);
        primitives.iter().all(|it| it.targets.is_empty())
    }

    /// Checks that what a channel animates exists.
    pub(super) fn check_aim(&self, aim: Aim, here: &str) -> Result<(), ImportError> {
        let document = self.document;
        let lights = document.extensions.lights.as_ref();
        let (what, index, count) = match aim {
            Aim::Node(index, _) | Aim::WeightsOfNode(index) => {
                ("nodes", index, document.nodes.len())
            }
            Aim::WeightsOfMesh(index) => ("meshes", index, document.meshes.len()),
            Aim::Camera(index, _) => ("cameras", index, document.cameras.len()),
            Aim::Light(index, _) => ("lights", index, lights.map_or(0, |it| it.lights.len())),
            Aim::Emission(index) | Aim::Layer(index, _) | Aim::Map(index, ..) => {
                ("materials", index, document.materials.len())
            }
        };
        match index < count {
            true => Ok(()),
            false => Err(self.blame.missing(here, what, index)),
        }
    }
}
