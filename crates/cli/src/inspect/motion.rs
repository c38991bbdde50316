//! The animation of a scene: nodes, tracks, duration and frames.

use crate::inspect::number;
use glimray_app::clock;
use glimray_scene::{OutputDefaults, Scene, Shutter};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::{self, Write};

/// The animation of a scene.
#[derive(Serialize, JsonSchema)]
pub struct MotionEntry {
    nodes: usize,
    tracks: usize,
    /// In seconds; null for a static scene.
    duration: Option<f64>,
    fps: f64,
    /// The number that `animate` renders by default; null for a static scene.
    frames: Option<u64>,
    /// Opening and closing times in frames, relative to a frame's time.
    shutter: [f64; 2],
}

impl From<&Scene> for MotionEntry {
    fn from(scene: &Scene) -> Self {
        let OutputDefaults { fps, shutter, .. } = scene.output;
        Self {
            nodes: scene.nodes.len(),
            tracks: scene.tracks.len(),
            duration: clock::duration(scene),
            fps,
            frames: frames(scene),
            shutter: [shutter.open, shutter.close],
        }
    }
}

pub fn write_text(out: &mut String, scene: &Scene) -> fmt::Result {
    let [nodes, tracks] = [scene.nodes.len(), scene.tracks.len()];
    write!(out, "animation  {nodes} node(s), {tracks} track(s)")?;
    let OutputDefaults { fps, shutter, .. } = scene.output;
    let (Some(duration), Some(frames)) = (clock::duration(scene), frames(scene)) else {
        return writeln!(out);
    };
    let duration = number(duration);
    write!(
        out,
        ", {duration} s, {frames} frames at {} frames/s",
        number(fps)
    )?;
    let Shutter { open, close } = shutter;
    if open < close {
        write!(
            out,
            ", shutter from {} to {} frames",
            number(open),
            number(close)
        )?;
    }
    writeln!(out)
}

/// Number of frames that `animate` renders by default.
fn frames(scene: &Scene) -> Option<u64> {
    let duration = clock::duration(scene)?;
    Some(u64::from(clock::last_frame(duration, scene.output.fps, false)) + 1)
}
