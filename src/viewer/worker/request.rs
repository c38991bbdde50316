//! What a picture in the window follows from.

use crate::render::{ExecutionPolicy, RenderSettings, Tone};
use crate::scene::{Background, Camera, Scene};
use std::sync::Arc;

/// Everything that determines a picture, as on the command line.
#[derive(Clone, Debug)]
pub struct RenderRequest {
    /// Told apart from others by its address: an edit makes another one.
    pub scene: Arc<Scene>,
    /// How often it was asked for anew.
    pub restarts: u32,
    /// In place of the scene's, in the world.
    pub camera: Option<Camera>,
    /// In place of the scene's.
    pub background: Option<Background>,
    /// When the shutter opens and closes, in seconds.
    pub shot: (f64, f64),
    /// Of the picture in full.
    pub settings: RenderSettings,
    /// How it is made; the window sees to its slices.
    pub policy: ExecutionPolicy,
    /// How it is developed.
    pub tone: Tone,
}

impl PartialEq for RenderRequest {
    fn eq(&self, other: &Self) -> bool {
        self.shows_same(other)
            && self.settings == other.settings
            && self.policy == other.policy
            && self.tone == other.tone
    }
}

impl RenderRequest {
    /// Whether both look at the same.
    pub fn shows_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.restarts == other.restarts
            && self.camera == other.camera
            && self.background == other.background
            && self.shot == other.shot
    }
}
