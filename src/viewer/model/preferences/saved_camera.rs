//! A camera that a person kept, to the last bit.

use crate::scene::{Camera, Lens};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use toml::Value;

/// A camera under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedCamera {
    /// Not empty.
    pub name: String,
    /// In world space.
    pub camera: Camera,
}

/// As the file has it. Angles are radians here: degrees would not lead back to the same bits.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    look_from: [f64; 3],
    look_at: [f64; 3],
    up: [f64; 3],
    fov_y: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    orthographic: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lens: Option<LensEntry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LensEntry {
    radius: f64,
    focus_distance: f64,
    blades: u32,
    blade_rotation: f64,
}

impl SavedCamera {
    pub(super) fn to_toml(&self) -> Value {
        let Self { name, camera } = self;
        let entry = Entry {
            name: name.clone(),
            look_from: camera.look_from.to_array(),
            look_at: camera.look_at.to_array(),
            up: camera.up.to_array(),
            fov_y: camera.fov_y,
            orthographic: camera.orthographic_height,
            lens: camera.lens.map(|lens| LensEntry {
                radius: lens.radius,
                focus_distance: lens.focus_distance,
                blades: lens.blade_count,
                blade_rotation: lens.blade_rotation,
            }),
        };
        // Only what is no table at all can fail.
        Value::try_from(entry).unwrap_or_else(|_| Value::Table(toml::Table::new()))
    }

    pub(super) fn from_toml(value: Value) -> Result<Self, String> {
        let first = |error: toml::de::Error| {
            let message = error.message().lines().next();
            message.unwrap_or("invalid TOML").to_owned()
        };
        let entry: Entry = value.try_into().map_err(first)?;
        let [look_from, look_at, up] =
            [entry.look_from, entry.look_at, entry.up].map(DVec3::from_array);
        let forward = (look_at - look_from).try_normalize();
        let is_clear = forward.is_some_and(|f| f.cross(up.normalize_or_zero()).length() > 1e-9);
        if !is_clear {
            return Err("its direction is undefined".to_owned());
        }
        if !(entry.fov_y > 0.0 && entry.fov_y < PI) {
            return Err("`fov_y` must be between 0 and pi".to_owned());
        }
        let is_size = |size: f64| size.is_finite() && size > 0.0;
        if !entry.orthographic.is_none_or(is_size) {
            return Err("`orthographic` must be above 0".to_owned());
        }
        let lens = entry.lens.map(|lens| Lens {
            radius: lens.radius,
            focus_distance: lens.focus_distance,
            blade_count: lens.blades,
            blade_rotation: lens.blade_rotation,
        });
        if !lens.is_none_or(|lens| is_size(lens.radius) && is_size(lens.focus_distance)) {
            return Err("its lens must have a size above 0".to_owned());
        }
        Ok(Self {
            name: entry.name,
            camera: Camera {
                name: String::new(),
                look_from,
                look_at,
                up,
                fov_y: entry.fov_y,
                orthographic_height: entry.orthographic,
                lens,
                node: None,
                target: None,
            },
        })
    }
}
