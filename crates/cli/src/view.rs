//! `glimray view [SCENE]`: hands what the command line says to the window.

use super::args::{Cli, Command, ViewArgs};
use super::job;
use clap::Parser;
use glimray_app::error::AppError;
use glimray_app::new_scene;
use glimray_app::overrides::{Moment, RenderOverrides};
use glimray_app::window::{PictureRequest, RecordingRequest, ViewRequest, Window};
use glimray_io::import::{Baking, Options};

pub(super) fn run(arguments: &ViewArgs, window: Option<&Window>) -> Result<(), AppError> {
    match window {
        Some(window) => (window.open)(request_of(arguments)),
        None => Err(AppError::Internal("view: there is no window".into())),
    }
}

/// The request of `glimray view WORDS…` to the window.
///
/// # Errors
/// The words are no such command line.
pub fn request<'a>(words: impl IntoIterator<Item = &'a str>) -> Result<ViewRequest, AppError> {
    let words = ["glimray", "view"].into_iter().chain(words);
    match Cli::try_parse_from(words) {
        Ok(Cli {
            command: Command::View(arguments),
        }) => Ok(request_of(&arguments)),
        Ok(_) => Err(AppError::Usage("not a `view`".into())),
        Err(error) => Err(AppError::Usage(error.to_string())),
    }
}

fn request_of(arguments: &ViewArgs) -> ViewRequest {
    let recording = &arguments.recording;
    ViewRequest {
        scene: arguments.scene.clone(),
        overrides: RenderOverrides {
            picture: arguments.picture.overrides(),
            tone: arguments.picture.develop.overrides(),
            camera: arguments.camera.overrides(&arguments.reading),
            moment: arguments.moment.moment(),
            timing: arguments.motion.overrides(),
        },
        import: Options {
            // The window does it when such an integrator is chosen.
            baking: Baking::Never,
            instead_of_empty: Some(new_scene::TEXT),
            ..(arguments.camera).import_options(&arguments.reading, &arguments.picture)
        },
        recording: RecordingRequest {
            record: recording.record.clone(),
            replay: recording.replay.clone(),
            is_fast: recording.replay_fast,
            closes: recording.close_after_replay,
        },
        adapter: arguments.device.choice(),
        policy: job::policy(&arguments.device, false),
        parse: picture,
    }
}

/// The picture that the words of a command line ask for, the program's name first.
///
/// # Errors
/// They are not `glimray render` or `glimray animate`, or a flag is wrong: one line on why.
pub fn picture(words: &[String]) -> Result<PictureRequest, String> {
    let cli = Cli::try_parse_from(words).map_err(|error| {
        let text = error.to_string();
        let first = text.lines().next().unwrap_or_default();
        let why = first.strip_prefix("error: ").unwrap_or(first);
        format!("cannot read the command line: {why}")
    })?;
    let (scene, picture, camera, reading, moment, motion) = match cli.command {
        Command::Render(it) => (
            it.scene,
            it.picture,
            it.camera,
            it.reading,
            it.moment.moment(),
            it.motion,
        ),
        Command::Animate(it) => {
            let moment = Moment {
                frame: Some(it.range.frames.map_or(0, |range| range.first)),
                time: None,
            };
            (
                it.scene, it.picture, it.camera, it.reading, moment, it.motion,
            )
        }
        _ => {
            return Err("cannot paste: only `glimray render` and `animate` have a camera".into());
        }
    };
    Ok(PictureRequest {
        scene,
        overrides: RenderOverrides {
            picture: picture.overrides(),
            tone: picture.develop.overrides(),
            camera: camera.overrides(&reading),
            moment,
            timing: motion.overrides(),
        },
    })
}
