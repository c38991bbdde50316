//! The frame range of an animation and its times.

use crate::args::{Range, RangeFlags};
use glimray_app::clock;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
use glimray_scene::Scene;

/// The frames of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timeline {
    pub clock: Clock,
    pub first: u32,
    /// Difference between consecutive frame numbers, at least 1.
    pub step: u32,
    /// Number of frames, at least 1.
    pub count: usize,
    /// Whether the animation loops.
    pub repeat: bool,
}

impl Timeline {
    /// The range in the flags, by default the scene's whole animation.
    ///
    /// # Errors
    /// The range is empty, or the scene has no animation that would end it.
    pub fn new(scene: &Scene, flags: &RangeFlags, mut clock: Clock) -> Result<Self, AppError> {
        let Range { first, last } = flags.frames.unwrap_or(Range {
            first: 0,
            last: None,
        });
        let end = match last {
            // At the last frame the animation begins again.
            Some(last) if flags.repeat => last.checked_sub(1),
            Some(last) => Some(last),
            None => {
                if !flags.repeat {
                    clock.end = scene.begins_again_at();
                }
                Some(end_of(scene, clock.fps, flags.repeat)?)
            }
        };
        let end = end.filter(|&end| end >= first).ok_or_else(|| {
            AppError::Usage(if flags.repeat && last.is_some() {
                format!(
                    "there are no frames (--frames, --loop): --loop drops the last frame, which is also \
                     the first ({first}). Choose a longer range."
                )
            } else {
                format!(
                    "there are no frames (--frames): the scene's animation ends before frame {first}. \
                     Start earlier, or give an end."
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

    /// The frame numbers.
    pub fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        (self.first..).step_by(self.step as usize).take(self.count)
    }

    pub fn last(&self) -> u32 {
        self.first + self.step * (self.count as u32 - 1)
    }

    /// The frame at which the animation of `scene` ends, if later ones are asked for.
    pub fn ends_before_last(&self, scene: &Scene) -> Option<u32> {
        let end = clock::last_frame(clock::duration(scene)?, self.clock.fps, false);
        (self.last() > end).then_some(end)
    }

    /// Frame rate of a video that lasts as long as the animation.
    pub fn video_fps(&self) -> f64 {
        self.clock.fps / f64::from(self.step)
    }
}

/// Number of the scene's last frame.
fn end_of(scene: &Scene, fps: f64, repeat: bool) -> Result<u32, AppError> {
    let duration = clock::duration(scene).ok_or_else(|| {
        AppError::Usage(
            "nothing moves in the scene (--frames): it has no animation and no duration. Give a range, such \
             as --frames 0..47, or render one picture with `glimray render`."
                .into(),
        )
    })?;
    let last = clock::last_frame(duration, fps, repeat);
    if last > crate::args::MAX_FRAME {
        return Err(AppError::Usage(format!(
            "too many frames (--fps): {duration} seconds at {fps} frames per second exceed the limit of {} \
             frames. Give a range with --frames.",
            crate::args::MAX_FRAME
        )));
    }
    Ok(last)
}
