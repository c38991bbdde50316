//! Fingerprints: things with the same fingerprint are treated as equal.

use super::{Integrator, TriangleTest};
use crate::pack::{PackedScene, PackedView, SceneFeatures};
use glimray_scene::{Antialias, Filter};
use std::{fmt, ops::Range};
use xxhash_rust::xxh3::Xxh3;

/// A 128-bit XXH3 hash, stable across runs, machines and builds. It detects accidental differences, not
/// forgeries. Displayed in hexadecimal.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fingerprint(pub u128);

impl Fingerprint {
    /// The fingerprint of everything in a packed scene that affects a picture.
    pub fn of_scene(scene: &PackedScene) -> Self {
        let SceneFeatures {
            shape_kinds,
            // This follows from the triangles and shapes.
            outside_tree: _,
            mixed_materials,
            reflection,
            refraction,
            contact,
            priorities,
            filtered_shadows,
            // These follow from the materials.
            anisotropy: _,
            gloss: _,
            metallic_roughness: _,
            coatings: _,
            coated_emission: _,
            coat_normals: _,
            rough_glass: _,
            dispersion: _,
            shadow_catchers: _,
            thin_walls: _,
            textures,
            second_uvs,
            noise,
            pictures,
            footprints,
            coverage,
            normal_maps,
            occlusion_maps,
            byte_texels,
            half_texels,
            optics_textures,
            emission,
            instances,
        } = scene.features;
        let mut encoder = Encoder::new("scene", 1);
        for part in scene.parts() {
            encoder.bytes(part);
        }
        encoder.number(shape_kinds);
        for flag in [
            mixed_materials,
            reflection,
            refraction,
            contact,
            priorities,
            filtered_shadows,
            textures,
            second_uvs,
            noise,
            pictures,
            footprints,
            coverage,
            normal_maps,
            occlusion_maps,
            byte_texels,
            half_texels,
            optics_textures,
            emission,
            instances,
        ] {
            encoder.number(flag.into());
        }
        encoder.number(scene.plane_count);
        for picture in &scene.pictures {
            picture.iter().for_each(|number| encoder.number(*number));
        }
        encoder.finish()
    }

    /// The fingerprint of everything in a packed frame that affects a picture.
    pub fn of_view(view: &PackedView) -> Self {
        let mut encoder = Encoder::new("view", 1);
        for part in view.parts() {
            encoder.bytes(part);
        }
        encoder.number(view.background);
        encoder.number(view.has_lights.into());
        encoder.number(view.has_area_lights.into());
        encoder.finish()
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl fmt::Debug for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{self}")
    }
}

/// Hashes a sequence of values unambiguously: byte strings are preceded by their length.
pub(super) struct Encoder(Xxh3);

impl Encoder {
    /// Starts the fingerprint of a kind of object. Increase the version when the encoding changes.
    pub fn new(name: &str, version: u32) -> Self {
        let mut encoder = Self(Xxh3::new());
        encoder.bytes(name.as_bytes());
        encoder.number(version);
        encoder
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.update(&(bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
    }

    pub fn number(&mut self, number: u32) {
        self.0.update(&number.to_le_bytes());
    }

    pub fn float(&mut self, number: f32) {
        self.number(number.to_bits());
    }

    /// Encodes whether there are numbers, and their values.
    pub fn option<const N: usize>(&mut self, numbers: Option<[u32; N]>) {
        self.number(numbers.is_some().into());
        for number in numbers.unwrap_or([0; N]) {
            self.number(number);
        }
    }

    pub fn finish(self) -> Fingerprint {
        Fingerprint(self.0.digest128())
    }
}

/// A value in a fingerprint, the same in every build.
pub(super) trait Encode {
    fn encode(&self, encoder: &mut Encoder);
}

macro_rules! encode {
    ($($type:ty: |$value:ident, $encoder:ident| $encoding:expr;)+) => {$(
        impl Encode for $type {
            fn encode(&self, $encoder: &mut Encoder) {
                let $value = self;
                $encoding;
            }
        }
    )+};
}

encode! {
    u32: |value, encoder| encoder.number(*value);
    f32: |value, encoder| encoder.float(*value);
    bool: |value, encoder| encoder.number((*value).into());
    (u32, u32): |value, encoder| {
        encoder.number(value.0);
        encoder.number(value.1);
    };
    Option<[u32; 4]>: |value, encoder| encoder.option(*value);
    Option<Range<u32>>: |value, encoder| {
        encoder.option(value.as_ref().map(|range| [range.start, range.end]));
    };
    Integrator: |value, encoder| encoder.bytes(value.entry().name.as_bytes());
    Antialias: |value, encoder| encoder.number(match value {
        Antialias::None => 0,
        Antialias::Stratified => 1,
        Antialias::Adaptive => 2,
    });
    Filter: |value, encoder| encoder.number(match value {
        Filter::Box => 0,
        Filter::Tent => 1,
        Filter::Gaussian => 2,
        Filter::BlackmanHarris => 3,
        Filter::Mitchell => 4,
    });
    TriangleTest: |value, encoder| encoder.number(match value {
        TriangleTest::Plane => 0,
        TriangleTest::MollerTrumbore => 1,
        TriangleTest::Watertight => 2,
    });
}
