//! When a frame is taken, and how long an animation lasts.

use super::cli::{MomentFlags, MotionFlags};
use crate::scene::{OutputDefaults, Scene, Shutter};

/// Turns frames into times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Frames per second, above 0.
    pub fps: f64,
    pub shutter: Shutter,
}

impl Clock {
    /// Flags win over the scene.
    pub fn new(output: &OutputDefaults, flags: &MotionFlags) -> Self {
        Self {
            fps: flags.fps.unwrap_or(output.fps),
            shutter: flags.shutter.unwrap_or(output.shutter),
        }
    }

    /// When the shutter opens and closes for the picture that the flags ask for, in seconds.
    pub fn moment(&self, flags: &MomentFlags) -> (f64, f64) {
        match flags.frame {
            Some(frame) => self.frame(frame),
            None => self.shot(flags.time.unwrap_or(0.0)),
        }
    }

    /// When the shutter opens and closes for frame `number`, in seconds.
    pub fn frame(&self, number: u32) -> (f64, f64) {
        self.shot(f64::from(number) / self.fps)
    }

    /// When the shutter opens and closes for a picture at `time`, all in seconds.
    pub fn shot(&self, time: f64) -> (f64, f64) {
        let Shutter { open, close } = self.shutter;
        (time + open / self.fps, time + close / self.fps)
    }
}

/// [`Scene::duration`], above 0; `None` where nothing ever changes.
pub fn duration(scene: &Scene) -> Option<f64> {
    Some(scene.duration()).filter(|&duration| duration > 0.0)
}

/// Numbers of frames that lie within `duration` seconds: from 0 to the result. The last moment is
/// one of them, unless it is the first one again.
pub fn last_frame(duration: f64, fps: f64, repeat: bool) -> u32 {
    // Rounding must not cost or add a frame.
    let frames = duration * fps;
    let end = if repeat {
        (frames - 1e-6).ceil() - 1.0
    } else {
        (frames + 1e-6).floor()
    };
    end.max(0.0) as u32
}
