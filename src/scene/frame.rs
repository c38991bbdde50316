//! What moves: the state of a scene at one moment.

use super::{Background, Camera, Light, Scene};
use glam::Vec3;

/// The moving part of a [`Scene`] at one time. Geometry and materials stay in the scene, so that an
/// animation uploads them once.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The camera that the picture is seen by.
    pub camera: Camera,
    /// May be empty.
    pub lights: Vec<Light>,
    /// What rays see that hit nothing.
    pub background: Background,
    /// Linear radiance of the ambient term, multiplied by [`super::Material::ambient`].
    pub ambient: Vec3,
}

impl Scene {
    /// The scene at `time` seconds, seen by its default camera. Scenes are still so far, so every
    /// time gives the same frame.
    pub fn frame(&self, _time: f64) -> Frame {
        Frame {
            camera: self.cameras[self.camera_index].clone(),
            lights: self.lights.clone(),
            background: self.background.clone(),
            ambient: self.ambient,
        }
    }
}
