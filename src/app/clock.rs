//! When a frame is taken, and how long an animation lasts.

use super::overrides::{Moment, TimingOverrides};
use crate::scene::{OutputDefaults, Scene, Shutter};

/// Turns frames into times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Frames per second, above 0.
    pub fps: f64,
    /// When the shutter is open, in frames.
    pub shutter: Shutter,
}

impl Clock {
    /// The scene's timing, where `overrides` do not set it.
    pub fn new(output: &OutputDefaults, overrides: &TimingOverrides) -> Self {
        Self {
            fps: overrides.fps.unwrap_or(output.fps),
            shutter: overrides.shutter.unwrap_or(output.shutter),
        }
    }

    /// When the shutter opens and closes for a picture of `moment`, in seconds.
    pub fn moment(&self, moment: &Moment) -> (f64, f64) {
        self.shot(self.time(moment))
    }

    /// The time of `moment`, in seconds.
    pub fn time(&self, moment: &Moment) -> f64 {
        match moment.frame {
            Some(frame) => f64::from(frame) / self.fps,
            None => moment.time.unwrap_or(0.0),
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
