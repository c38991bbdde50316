//! Playback of the animation; the time is always at a whole frame.

use glimray_app::clock;
use glimray_app::clock::Clock;
use glimray_scene::{Scene, Shutter};

/// Limit of the playback speed, as a factor in both directions.
pub const MAX_SPEED: f64 = 16.0;

/// The state of playback.
#[derive(Clone, Debug, PartialEq)]
pub struct Playback {
    /// Frames per second and shutter.
    pub clock: Clock,
    /// The current time in seconds.
    pub time: f64,
    /// Whether the animation is playing.
    pub is_playing: bool,
    /// Playback speed: animation seconds per second, above 0.
    pub speed: f64,
    /// Whether it loops.
    pub repeats: bool,
    /// Whether motion blur is on.
    pub blurs: bool,
    /// Seconds since the current frame started.
    since_frame: f64,
    /// Duration in seconds; 0 without animation.
    duration: f64,
}

impl Playback {
    /// Paused at `time`, in seconds.
    pub fn new(clock: Clock, time: f64) -> Self {
        Self {
            clock,
            time,
            is_playing: false,
            speed: 1.0,
            repeats: true,
            blurs: true,
            since_frame: 0.0,
            duration: 0.0,
        }
    }

    /// Sets the duration of a scene's animation.
    pub fn set_scene(&mut self, scene: &Scene) {
        self.duration = clock::duration(scene).unwrap_or(0.0);
        self.is_playing &= self.duration > 0.0;
    }

    /// Duration in seconds; 0 without animation.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Index of the current frame.
    pub fn frame(&self) -> u32 {
        if !self.repeats && self.duration > 0.0 && self.time >= self.duration {
            return self.last_frame();
        }
        (self.time * self.clock.fps + 1e-6).floor().max(0.0) as u32
    }

    /// Index of the last frame.
    pub fn last_frame(&self) -> u32 {
        clock::last_frame(self.duration, self.clock.fps, self.repeats)
    }

    /// Plays or pauses. At the end of the animation it restarts.
    pub fn toggle(&mut self) {
        self.is_playing = !self.is_playing && self.duration > 0.0;
        if self.is_playing && !self.repeats && self.frame() >= self.last_frame() {
            self.go_to(0);
        }
    }

    /// Changes the frame rate, above 0, and moves to the nearest frame.
    pub fn set_fps(&mut self, fps: f64) {
        if fps != self.clock.fps {
            self.clock.fps = fps;
            let frame = (self.time * fps).round().max(0.0) as u32;
            self.go_to(frame.min(self.last_frame()));
        }
    }

    /// Moves to a frame.
    pub fn go_to(&mut self, frame: u32) {
        self.since_frame = 0.0;
        let time = f64::from(frame) / self.clock.fps;
        // The last frame shows the end of a clip, behind which it begins again.
        self.time = match self.repeats || self.duration == 0.0 {
            true => time,
            false => time.min(self.duration),
        };
    }

    /// Moves by some frames, wrapping around if it loops.
    pub fn step(&mut self, frames: i64) {
        self.is_playing = false;
        self.advance_frames(frames);
    }

    /// Multiplies the speed, within [`MAX_SPEED`].
    pub fn scale_speed(&mut self, factor: f64) {
        self.speed = (self.speed * factor).clamp(1.0 / MAX_SPEED, MAX_SPEED);
    }

    /// Advances by `seconds`.
    pub fn advance(&mut self, seconds: f64) {
        if !self.is_playing {
            return;
        }
        self.since_frame += seconds * self.speed;
        let frames = (self.since_frame * self.clock.fps).floor();
        if frames >= 1.0 {
            let rest = self.since_frame - frames / self.clock.fps;
            self.advance_frames(frames as i64);
            self.since_frame = rest;
        }
    }

    fn advance_frames(&mut self, frames: i64) {
        let last = i64::from(self.last_frame());
        let wanted = i64::from(self.frame()) + frames;
        let frame = match self.repeats {
            true => wanted.rem_euclid(last + 1),
            false => wanted.clamp(0, last),
        };
        self.is_playing &= self.repeats || frame < last;
        self.go_to(frame as u32);
    }

    /// When the shutter opens and closes, in seconds.
    pub fn shutter_interval(&self) -> (f64, f64) {
        match self.blurs {
            true => self.clock.shutter_interval(self.time),
            false => (self.time, self.time),
        }
    }

    /// The shutter as a flag of the command line.
    pub fn shutter(&self) -> Shutter {
        match self.blurs {
            true => self.clock.shutter,
            false => Shutter {
                open: 0.0,
                close: 0.0,
            },
        }
    }
}
