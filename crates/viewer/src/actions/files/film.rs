//! Films: the dialog, and the job that renders one.

use crate::actions::files::{NO_DIALOG, pictures, short};
use crate::model::file_dialog::{self, FILMS, Reply, Request};
use crate::state::answer::Answer;
use crate::state::film::{FilmDialog, FilmMotion, FilmTarget, MAX_FRAME};
use crate::state::jobs::{JobBegun, JobId, Written};
use crate::state::session::Session;
use crate::worker::classical::ShownScenes;
use crate::worker::film::{self, FilmRequest};
use eframe::egui;
use glimray_app::clock::Clock;
use glimray_render::{RenderSettings, Tone};
use glimray_scene::{self as scene, Scene};
use std::path::Path;
use std::sync::Arc;

/// Duration of a turn, in seconds.
const TURN: f64 = 4.0;

/// Opens the dialog with a free name, the scene's size and what moves.
pub fn open(session: &mut Session) {
    let Some(scene) = session.scene() else {
        session.messages.notify("There is no picture yet");
        return;
    };
    let motion = match scene.is_animated() {
        true => FilmMotion::Animation,
        false => FilmMotion::Turntable,
    };
    let (width, height) = session.view.scene_settings.size;
    let settings = (session.view).settings_at((width, height), session.view.settings.integrator);
    let path = pictures::free_name(session, ".mp4");
    let path = path.to_string_lossy().into_owned();
    session.files.film = Some(FilmDialog {
        proposed: path.clone(),
        path,
        motion,
        range: [0, session.playback.last_frame().min(MAX_FRAME)],
        scaled: None,
        seconds: TURN,
        clockwise: false,
        fps: session.playback.clock.fps,
        size: [width, height],
        samples: settings.samples,
        denoise: session.view.tone.denoise,
        loops: session.playback.repeats,
        quality: session.files.pending.quality.unwrap_or(90),
        has_opacity: settings.has_opacity(),
        is_new: true,
        inputs: session.files.inputs(),
        agreed: None,
        asked: None,
        looked_up: Default::default(),
    });
}

/// Whether the background of frames is transparent with the settings that the window has now.
pub fn has_opacity(session: &Session) -> bool {
    let settings = &session.view.settings;
    (session.view)
        .settings_at(settings.size, settings.integrator)
        .has_opacity()
}

/// Opens a file dialog for the name.
pub fn browse(session: &mut Session, ctx: &egui::Context) {
    let Some(dialog) = &mut session.files.film else {
        return;
    };
    let request = Request::save("Save the film", FILMS, &dialog.typed());
    dialog.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Takes the name that was chosen in the file dialog.
pub(super) fn update(session: &mut Session) {
    let Some(dialog) = &mut session.files.film else {
        return;
    };
    match file_dialog::take_reply(&mut dialog.asked) {
        Some(Reply::Chosen(mut path)) => {
            let agreed = path.clone();
            if path.extension().is_none() {
                path.set_extension("mp4");
            }
            dialog.path = path.to_string_lossy().into_owned();
            dialog.agreed = (agreed == path).then_some(agreed);
        }
        Some(Reply::Unavailable) => session.messages.warn(NO_DIALOG.to_owned()),
        Some(Reply::Cancelled) | None => {}
    }
}

/// Begins the film of the dialog.
pub fn start(session: &mut Session) {
    let Some(dialog) = session.files.film.take() else {
        return;
    };
    let request = (dialog.target().ok()).and_then(|target| request(session, &dialog, target));
    let Some(request) = request else {
        session.files.film = Some(dialog);
        return;
    };
    session.files.pending.quality = Some(dialog.quality);
    session.files.pending.folder = dialog.typed().parent().map(Path::to_owned);
    let name = short(request.path());
    let count = request.count;
    session
        .messages
        .notify(format!("Filming {name}, {count} frames"));
    let request = Arc::new(request);
    let job = session.files.jobs.begin_film(request.clone());
    work(session, request, job);
}

/// Continues a film that was cancelled or has failed. Frames that are still right are not rendered again.
pub fn resume(session: &mut Session, id: JobId) {
    if let Some(request) = session.files.jobs.film(id).cloned() {
        let job = session.files.jobs.run(id);
        work(session, request, job);
    }
}

/// Renders on a thread of its own.
fn work(session: &mut Session, request: Arc<FilmRequest>, job: JobBegun) {
    session.ask(move |frame| {
        let gpu = frame.renderer.gpu().clone();
        let work = move || {
            let outcome = match film::render(gpu, &request, &job.control) {
                Ok(Some(path)) => Ok(Some(Written {
                    message: pictures::saved(&path, request.path(), ""),
                    path,
                })),
                Ok(None) => Ok(None),
                Err(error) => Err(error.to_string()),
            };
            // The window may have been closed meanwhile.
            let _ = job.sender.send(outcome);
        };
        match std::thread::Builder::new().name("film".into()).spawn(work) {
            Ok(_) => Answer::Nothing,
            Err(error) => Answer::Failed(format!("cannot render a film: {error}.")),
        }
    });
}

/// The film of a dialog: the view, its background and its settings as the window has them now.
fn request(session: &Session, dialog: &FilmDialog, target: FilmTarget) -> Option<FilmRequest> {
    let integrator = session.view.settings.integrator;
    let shown = pictures::request_of_file(session, integrator)?;
    let [width, height] = dialog.size;
    let mut view = session.view.clone();
    view.settings = view.settings_at((width, height), integrator);
    view.set_samples(dialog.samples);
    let settings = RenderSettings {
        features: dialog.denoise,
        ..view.settings
    };
    let linear = (session.request.overrides.tone).tone(&shown.scene.output, integrator, true);
    let tone = Tone {
        denoise: dialog.denoise,
        ..match target.files.format.is_linear() {
            true => linear,
            false => shown.tone,
        }
    };
    let mut clock = Clock {
        fps: dialog.fps,
        shutter: session.playback.shutter(),
        end: None,
    };
    let filmed = ShownScenes::default().of(&shown);
    let mut filmed = Scene::clone(&filmed);
    if let Some(background) = shown.background {
        filmed.background = background;
    }
    let (first, count) = (dialog.range[0], dialog.count());
    let first = match dialog.motion {
        FilmMotion::Animation => {
            // All of an animation ends where it ends, as that of the command line.
            let last = dialog.last_frame(session.playback.duration());
            if dialog.range == [0, last] && !dialog.loops {
                clock.end = filmed.begins_again_at();
            }
            if let Some(camera) = shown.camera {
                filmed.hold_camera(camera);
            }
            first
        }
        FilmMotion::Turntable => {
            let controller = session.controller.as_ref()?;
            // A whole number of frames, so that the step from the last to the first equals all other steps.
            let seconds = f64::from(count) / dialog.fps;
            let around = (controller.pivot(), controller.up_axis());
            let camera =
                (shown.camera).unwrap_or_else(|| shown.scene.frame(session.playback.time).camera);
            scene::orbit(&mut filmed, &camera, around, seconds, dialog.clockwise);
            0
        }
    };
    Some(FilmRequest {
        scene: Arc::new(filmed),
        clock,
        first,
        count,
        settings,
        tone,
        policy: shown.policy,
        files: target.files,
        video: target.video,
    })
}
