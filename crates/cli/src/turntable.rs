//! `glimray turntable MODEL`: a seamless turntable animation, as a video or as frames.

use crate::animate;
use crate::animate::{Sequence, Target, Timeline};
use crate::args::{LayerFlags, MotionFlags, Range, RangeFlags, TurnFlags, TurntableArgs};
use crate::idle_flags;
use crate::job::Job;
use crate::report::Draft;
use glimray_app::advice::UNBOUNDED;
use glimray_app::clock::Clock;
use glimray_app::error::AppError;
use glimray_app::overrides::SectionChoice;
use glimray_scene::{self as scene, Background, Scene, Turntable};
use std::time::Instant;

/// Samples per pixel, unless the model sets more than one.
const SAMPLES: u32 = 4;

/// Largest number of frames in a turn.
const MAX_FRAMES: f64 = 1e6;

pub fn run(arguments: &TurntableArgs, started: Instant) -> Result<(), AppError> {
    let TurntableArgs {
        scene, output, log, ..
    } = arguments;
    let name = ("turntable", "turntable");
    animate::with_report(name, scene, output, log, started, |target, draft| {
        render(arguments, target, draft)
    })
}

fn render(arguments: &TurntableArgs, target: Target, draft: &mut Draft) -> Result<(), AppError> {
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = arguments
        .reading
        .import_options(arguments.axis.up, false, &arguments.picture);
    let mut scene = draft.load(&arguments.scene, &options, arguments.reading.strict)?;
    let turn = &arguments.turn;
    if scene.output.samples == 1 {
        scene.output.samples = SAMPLES;
    }
    let frames = (turn.seconds * turn.fps).round().max(1.0);
    if frames > MAX_FRAMES {
        return Err(AppError::Usage(format!(
            "too many frames (--seconds, --fps): the turn has {frames}; the limit is {MAX_FRAMES}. Choose a \
             shorter turn or a lower rate."
        )));
    }
    let size = arguments
        .picture
        .settings
        .given
        .size
        .unwrap_or(scene.output.size);
    // A whole number of frames, so that the step from the last to the first equals all other steps.
    let mut scene = turned(scene, turn, frames / turn.fps, size)?;
    if let Some(background) = turn.shown.background {
        scene.background = Background::Color(background);
    }
    if let Some(SectionChoice(section)) = turn.shown.section {
        scene.section = section;
    }
    let flags = MotionFlags {
        fps: Some(turn.fps),
        shutter: turn.shutter,
    };
    let range = RangeFlags {
        frames: Some(Range {
            first: 0,
            last: Some(frames as u32),
        }),
        step: 1,
        repeat: true,
    };
    let timeline = Timeline::new(
        &scene,
        &range,
        Clock::new(&scene.output, &flags.overrides()),
    )?;
    let job = Job {
        scene,
        picture: &arguments.picture,
        device: &arguments.device,
        log: &arguments.log,
        layers: &LayerFlags::default(),
    };
    let flags = &arguments.output;
    Sequence {
        job,
        timeline,
        flags,
        target,
    }
    .run(draft)
}

/// The scene with a camera that circles it once in `seconds`.
fn turned(
    mut scene: Scene,
    turn: &TurnFlags,
    seconds: f64,
    (width, height): (u32, u32),
) -> Result<Scene, AppError> {
    let options = Turntable {
        axis: turn.axis,
        elevation: turn.elevation.to_radians(),
        seconds,
        fov_y: turn.fov_y.to_radians(),
        aspect: f64::from(width) / f64::from(height),
        margin: turn.margin,
        clockwise: turn.clockwise,
    };
    if scene::turntable(&mut scene, &options) {
        return Ok(scene);
    }
    Err(AppError::Refused(UNBOUNDED.into()))
}
