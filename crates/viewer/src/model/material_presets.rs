//! Ready-made materials of the metallic-roughness model, and how one replaces another material.

use crate::model::objects::{EditError, unused_name};
use glam::Vec3;
use glimray_scene::{Material, MaterialProperty, MetallicRoughness, Scene, Target};

/// A ready-made material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialPreset {
    /// Clear glass that refracts.
    Glass,
    /// Polished gold.
    Gold,
    /// Fired clay.
    Clay,
    /// Metallic paint under a clear coat.
    CarPaint,
    /// A layer of fibres over a dark cloth.
    Velvet,
    /// A film of water in air.
    SoapFilm,
    /// A surface that glows like an incandescent lamp.
    Emissive,
}

impl MaterialPreset {
    /// All, in the order of menus.
    pub const ALL: [Self; 7] = [
        Self::Glass,
        Self::Gold,
        Self::Clay,
        Self::CarPaint,
        Self::Velvet,
        Self::SoapFilm,
        Self::Emissive,
    ];

    /// The label in menus, and the name of a material that is added.
    pub fn title(self) -> &'static str {
        match self {
            Self::Glass => "Glass",
            Self::Gold => "Gold",
            Self::Clay => "Clay",
            Self::CarPaint => "Car paint",
            Self::Velvet => "Velvet",
            Self::SoapFilm => "Soap film",
            Self::Emissive => "Emissive",
        }
    }

    /// The preset that a material has all parameters of.
    pub fn of(material: &Material) -> Option<Self> {
        material.metallic_roughness()?;
        (Self::ALL.into_iter()).find(|preset| preset.replacing(material) == *material)
    }

    /// The material, without a name.
    pub fn material(self) -> Material {
        let emission = match self {
            // The colour of a black body of 3000 K, #FFB46B in sRGB (Charity, "What color is a blackbody?", 10° observer).
            Self::Emissive => 5.0 * Vec3::new(1.0, 0.456, 0.147),
            _ => Vec3::ZERO,
        };
        Material {
            emission,
            ..self.model().into()
        }
    }

    fn model(self) -> MetallicRoughness {
        let dielectric = MetallicRoughness {
            metallic: 0.0,
            ..MetallicRoughness::default()
        };
        match self {
            // KHR_materials_transmission and KHR_materials_volume; 1.5 is the usual index of window glass.
            Self::Glass => MetallicRoughness {
                roughness: 0.0,
                ior: 1.5,
                transmission: 1.0,
                thickness: 1.0,
                ..dielectric
            },
            // Measured reflectance along the normal (Lagarde, "Feeding a physically based shading model", 2011).
            Self::Gold => MetallicRoughness {
                base_color: Vec3::new(1.0, 0.766, 0.336),
                metallic: 1.0,
                roughness: 0.15,
                ..dielectric
            },
            // Brick in the chart of Filament's material guide: (148, 125, 117) in sRGB.
            Self::Clay => MetallicRoughness {
                base_color: Vec3::new(0.296, 0.205, 0.178),
                roughness: 1.0,
                ..dielectric
            },
            // The body of three.js' example of a car: KHR_materials_clearcoat over a metal.
            Self::CarPaint => MetallicRoughness {
                base_color: Vec3::new(0.6, 0.02, 0.02),
                metallic: 1.0,
                roughness: 0.5,
                clearcoat: 1.0,
                clearcoat_roughness: 0.03,
                ..dielectric
            },
            // KHR_materials_sheen, with the width of Estevez and Kulla's pictures of velvet (2017).
            Self::Velvet => MetallicRoughness {
                base_color: Vec3::new(0.1, 0.005, 0.02),
                roughness: 1.0,
                sheen_color: Vec3::new(0.7, 0.15, 0.25),
                sheen_roughness: 0.3,
                ..dielectric
            },
            // KHR_materials_iridescence with its default thickness: water between air and air.
            Self::SoapFilm => MetallicRoughness {
                roughness: 0.0,
                ior: 1.0,
                transmission: 1.0,
                iridescence: 1.0,
                iridescence_ior: 1.33,
                ..dielectric
            },
            Self::Emissive => MetallicRoughness {
                base_color: Vec3::ZERO,
                roughness: 1.0,
                ..dielectric
            },
        }
    }

    /// The material in place of another one, of which it keeps what is no part of the surface's look.
    fn replacing(self, other: &Material) -> Material {
        Material {
            name: other.name.clone(),
            priority: other.priority,
            shadow_catcher: other.shadow_catcher,
            ..self.material()
        }
    }

    /// Replaces a material of a scene. It keeps its name.
    ///
    /// # Errors
    /// An animation changes a colour or a number of Phong's model, which the preset does not have.
    pub fn apply(self, scene: &mut Scene, index: usize) -> Result<(), EditError> {
        let targets = scene.tracks.iter().flat_map(|track| &track.targets);
        let mut properties = targets.filter_map(|target| match *target {
            Target::Material(of, property) if of == index => Some(property),
            _ => None,
        });
        if properties.any(|property| property != MaterialProperty::Emission) {
            return Err(EditError::Unable {
                what: "an animated material",
                done: "replaced",
                todo: "Remove its animation from the scene file, or use another material",
            });
        }
        let own = scene.materials.get_mut(index).ok_or(EditError::Gone)?;
        *own = self.replacing(own);
        Ok(())
    }

    /// Adds the material to a scene under a name that is not used, and returns its index.
    pub fn add_to(self, scene: &mut Scene) -> usize {
        let name = unused_name(scene, self.title());
        scene.materials.push(Material {
            name,
            ..self.material()
        });
        scene.materials.len() - 1
    }
}
