//! Textures at one moment.

use crate::{Scene, Target, Texture, TextureProperty, UvTransform, Value};
use std::collections::BTreeMap;

impl Scene {
    /// All textures if a track animates any; otherwise none.
    pub(super) fn textures_at(&self, time: f64) -> Vec<Texture> {
        let mut placed: BTreeMap<usize, UvTransform> = BTreeMap::new();
        for track in &self.tracks {
            for target in &track.targets {
                let Target::Texture(index, property) = *target else {
                    continue;
                };
                let own = placed.entry(index).or_default();
                match (property, track.curve.at(time)) {
                    (TextureProperty::Offset, Value::Vector(value)) => {
                        own.offset = value.truncate();
                    }
                    (TextureProperty::Rotation, Value::Scalar(value)) => own.rotation = value,
                    (TextureProperty::Scale, Value::Vector(value)) => own.scale = value.truncate(),
                    _ => {}
                }
            }
        }
        if placed.is_empty() {
            return Vec::new();
        }
        let mut textures = self.textures.clone();
        for (index, transform) in placed {
            textures[index].pattern_from_space = transform.pattern_from_uv();
        }
        textures
    }
}
