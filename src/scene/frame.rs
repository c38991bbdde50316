//! What moves: the state of a scene at one moment.

use super::{Camera, Light, Scene};
use glam::Vec3;

/// The moving part of a [`Scene`] at one time. Geometry and materials stay in the scene, so that an
/// animation uploads them once.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    pub camera: Camera,
    pub lights: Vec<Light>,
    pub background: Vec3,
    pub ambient: Vec3,
}

impl Scene {
    /// The scene at `time` seconds, seen by its default camera. Scenes are still so far, so every
    /// time gives the same frame.
    pub fn frame(&self, _time: f64) -> Frame {
        Frame {
            camera: self.cameras[self.camera_index].clone(),
            lights: self.lights.clone(),
            background: self.background,
            ambient: self.ambient,
        }
    }
}
