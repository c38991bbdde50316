//! Bookmarked views, stored without loss of precision.

use super::Thumbnail;
use glam::DVec3;
use glimray_scene::{Camera, Lens};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A bookmarked view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Entry", into = "Entry")]
pub struct SavedCamera {
    /// The view's name; not empty.
    pub name: String,
    /// The camera in world space.
    pub camera: Camera,
    /// A small picture of the view when it was bookmarked.
    pub picture: Option<Thumbnail>,
}

/// A bookmark in the file. Angles are in radians, because degrees do not convert back exactly.
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
    /// The distances of the planes between which the camera sees.
    #[serde(skip_serializing_if = "Option::is_none")]
    clip: Option<(f64, f64)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<Thumbnail>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LensEntry {
    radius: f64,
    focus_distance: f64,
    blades: u32,
    blade_rotation: f64,
}

impl From<SavedCamera> for Entry {
    fn from(saved: SavedCamera) -> Self {
        let SavedCamera {
            name,
            camera,
            picture,
        } = saved;
        Self {
            name,
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
            clip: (camera.clip != Camera::UNCLIPPED).then_some(camera.clip),
            picture,
        }
    }
}

impl TryFrom<Entry> for SavedCamera {
    type Error = &'static str;

    fn try_from(entry: Entry) -> Result<Self, Self::Error> {
        let [look_from, look_at, up] =
            [entry.look_from, entry.look_at, entry.up].map(DVec3::from_array);
        let forward = (look_at - look_from).try_normalize();
        let is_clear = forward.is_some_and(|f| f.cross(up.normalize_or_zero()).length() > 1e-9);
        if !is_clear {
            return Err("its direction is undefined");
        }
        if !(entry.fov_y > 0.0 && entry.fov_y < PI) {
            return Err("`fov_y` must be between 0 and pi");
        }
        let is_size = |size: f64| size.is_finite() && size > 0.0;
        if !entry.orthographic.is_none_or(is_size) {
            return Err("`orthographic` must be above 0");
        }
        let clip = entry.clip.unwrap_or(Camera::UNCLIPPED);
        if !(clip.0 >= 0.0 && clip.0 < clip.1) {
            return Err("`clip` must be two distances of at least 0, the nearer one first");
        }
        let lens = entry.lens.map(|lens| Lens {
            radius: lens.radius,
            focus_distance: lens.focus_distance,
            blade_count: lens.blades,
            blade_rotation: lens.blade_rotation,
        });
        if !lens.is_none_or(|lens| is_size(lens.radius) && is_size(lens.focus_distance)) {
            return Err("its lens must have a size above 0");
        }
        Ok(Self {
            name: entry.name,
            camera: Camera {
                look_from,
                look_at,
                up,
                fov_y: entry.fov_y,
                orthographic_height: entry.orthographic,
                lens,
                clip,
                ..Camera::default()
            },
            picture: entry.picture,
        })
    }
}
