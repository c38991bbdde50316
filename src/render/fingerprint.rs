//! Short names for long bytes: two things with the same fingerprint are the same.

use crate::pack::{Features, PackedScene, PackedView};
use std::fmt;
use xxhash_rust::xxh3::Xxh3;

/// XXH3 of 128 bits, stable across runs, machines and builds. It finds accidents, not forgeries. Displayed in
/// hexadecimal digits.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fingerprint(pub u128);

impl Fingerprint {
    /// Of everything in a packed scene that a picture depends on.
    pub fn of_scene(scene: &PackedScene) -> Self {
        let Features {
            shape_kinds,
            mixed_materials,
            reflection,
            refraction,
            contact,
            filtered_shadows,
            textures,
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
            filtered_shadows,
            textures,
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

    /// Of everything in a packed frame that a picture depends on.
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

/// Puts values one after the other, such that nothing moves from one to the next unnoticed.
pub(super) struct Encoder(Xxh3);

impl Encoder {
    /// For what is named so. Who changes what is encoded, or how, counts the version up.
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

    /// Whether there are numbers, and which.
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
