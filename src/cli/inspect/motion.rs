//! What moves in a scene, and for how long.

use crate::app::clock;
use crate::cli::inspect::number;
use crate::scene::{OutputDefaults, Scene, Shutter};
use serde_json::{Value, json};
use std::fmt::{self, Write};

/// Seconds, frames per second, and frames from its edges; `duration` and `frames` are null where
/// nothing moves.
pub fn to_json(scene: &Scene) -> Value {
    let OutputDefaults { fps, shutter, .. } = scene.output;
    json!({
        "nodes": scene.nodes.len(),
        "tracks": scene.tracks.len(),
        "duration": clock::duration(scene),
        "fps": fps,
        "frames": frames(scene),
        "shutter": [shutter.open, shutter.close],
    })
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
        ", {duration} s, {frames} frames at {} a second",
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

/// As many as `animate` renders unless told otherwise.
fn frames(scene: &Scene) -> Option<u64> {
    let duration = clock::duration(scene)?;
    Some(u64::from(clock::last_frame(duration, scene.output.fps, false)) + 1)
}
