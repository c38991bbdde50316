//! Which frames an animation has, and when they are.

use crate::app::clock;
use crate::app::clock::Clock;
use crate::app::error::AppError;
use crate::cli::args::{Range, RangeFlags};
use crate::scene::Scene;

/// The frames of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timeline {
    pub clock: Clock,
    pub first: u32,
    /// From one frame to the next, at least 1.
    pub step: u32,
    /// At least 1.
    pub count: usize,
    /// Whether the end is the start again.
    pub repeat: bool,
}

impl Timeline {
    /// What the flags say, else the scene's whole animation.
    ///
    /// # Errors
    /// There is no such frame, or the scene does not say where its animation ends.
    pub fn new(scene: &Scene, flags: &RangeFlags, clock: Clock) -> Result<Self, AppError> {
        let Range { first, last } = flags.frames.unwrap_or(Range {
            first: 0,
            last: None,
        });
        let end = match last {
            // The last one is the first again.
            Some(last) if flags.repeat => last.checked_sub(1),
            Some(last) => Some(last),
            None => Some(end_of(scene, clock.fps, flags.repeat)?),
        };
        let end = end.filter(|&end| end >= first).ok_or_else(|| {
            AppError::Usage(if flags.repeat && last.is_some() {
                format!(
                    "there are no frames (--frames, --loop): the last one, which --loop leaves out, \
                     is also the first ({first}). Give a longer range."
                )
            } else {
                format!(
                    "there are no frames (--frames): the scene's animation ends before frame {first}. \
                     Start earlier, or say where to end."
                )
            })
        })?;
        Ok(Self {
            clock,
            first,
            step: flags.step,
            count: ((end - first) / flags.step) as usize + 1,
            repeat: flags.repeat,
        })
    }

    /// Their numbers.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        (self.first..).step_by(self.step as usize).take(self.count)
    }

    pub fn last(&self) -> u32 {
        self.first + self.step * (self.count as u32 - 1)
    }

    /// Frames per second of a video of them, which lasts as long as the animation.
    pub fn video_fps(&self) -> f64 {
        self.clock.fps / f64::from(self.step)
    }
}

/// Number of the scene's last frame.
fn end_of(scene: &Scene, fps: f64, repeat: bool) -> Result<u32, AppError> {
    let duration = clock::duration(scene).ok_or_else(|| {
        AppError::Usage(
            "nothing moves in the scene (--frames): it has no animation and does not say how long it \
             lasts. Give the frames, such as --frames 0..47, or make one picture with \
             `glimray render`."
                .into(),
        )
    })?;
    let last = clock::last_frame(duration, fps, repeat);
    if last > crate::cli::args::MAX_FRAME {
        return Err(AppError::Usage(format!(
            "too many frames (--fps): {duration} seconds at {fps} frames per second are more than {}. \
             Give a range with --frames.",
            crate::cli::args::MAX_FRAME
        )));
    }
    Ok(last)
}
