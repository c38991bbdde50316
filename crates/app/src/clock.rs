//! Converts frames to times, and finds how long an animation lasts.

use super::overrides::{Moment, TimingOverrides};
use glimray_scene::{OutputDefaults, Scene, Shutter};

/// Frame rate and shutter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Frames per second, greater than 0.
    pub fps: f64,
    /// When the shutter is open, in frames.
    pub shutter: Shutter,
    /// When the animation stops, in seconds: later frames show this moment. `None` if it goes on.
    pub end: Option<f64>,
}

impl Clock {
    /// The scene's timing, where `overrides` do not set it.
    pub fn new(output: &OutputDefaults, overrides: &TimingOverrides) -> Self {
        Self {
            fps: overrides.fps.unwrap_or(output.fps),
            shutter: overrides.shutter.unwrap_or(output.shutter),
            end: None,
        }
    }

    /// When the shutter opens and closes for a picture of `moment`, in seconds.
    pub fn moment(&self, moment: &Moment) -> (f64, f64) {
        self.shutter_interval(self.time(moment))
    }

    /// The time of `moment`, in seconds.
    pub fn time(&self, moment: &Moment) -> f64 {
        match moment.frame {
            Some(frame) => f64::from(frame) / self.fps,
            None => moment.time.unwrap_or(0.0),
        }
    }

    /// Shutter opening and closing times for frame `number`, in seconds.
    pub fn frame(&self, number: u32) -> (f64, f64) {
        self.shutter_interval(f64::from(number) / self.fps)
    }

    /// Shutter opening and closing times for a picture at `time`, all in seconds.
    pub fn shutter_interval(&self, time: f64) -> (f64, f64) {
        let (open, close) = self.shutter.interval(time, self.fps);
        let until = |time: f64| self.end.map_or(time, |end| time.min(end));
        (until(open), until(close))
    }
}

/// [`Scene::duration`] if it is greater than 0; `None` for a static scene.
pub fn duration(scene: &Scene) -> Option<f64> {
    Some(scene.duration()).filter(|&duration| duration > 0.0)
}

/// Number of the last frame of an animation of `duration` seconds, counted from 0: the first one that is not before
/// its end. With `repeat` that frame is left out, because there the animation begins again.
pub fn last_frame(duration: f64, fps: f64, repeat: bool) -> u32 {
    // Rounding errors must neither add nor drop a frame.
    let end = (duration * fps * (1.0 - 1e-7) - 1e-6).ceil();
    (end - f64::from(u8::from(repeat))).max(0.0) as u32
}
