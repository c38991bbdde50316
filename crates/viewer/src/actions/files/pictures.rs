//! Saves the picture to a file, as `glimray render` would.

use crate::actions::files::{NO_DIALOG, short};
use crate::model::camera::CameraController;
use crate::model::file_dialog::{self, PICTURES, Reply, Request};
use crate::state::answer::Answer;
use crate::state::files::Captured;
use crate::state::files::SaveDialog;
use crate::state::files::Target;
use crate::state::files::{Pose, Rendering, SaveSize};
use crate::state::session::Session;
use crate::worker::progressive_image::{FrameRenderer, PictureSlot};
use crate::worker::still::{self, Still};
use eframe::egui;
use glimray_app::advice;
use glimray_app::layers::beside_raw;
use glimray_io::output::{self, LayeredImage, SaveOptions};
use glimray_render::Tone;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{TryRecvError, channel};

/// Opens the dialog with a free name.
pub fn open(session: &mut Session, overlays: bool) {
    if session.scene().is_none() {
        session.messages.notify("There is no picture yet");
        return;
    }
    let path = free_name(session).to_string_lossy().into_owned();
    session.files.saving = Some(SaveDialog {
        path,
        quality: session.files.pending.quality.unwrap_or(90),
        overlays,
        size: SaveSize::default(),
        is_new: true,
        inputs: session.files.inputs(),
        agreed: None,
        asked: None,
    });
}

/// The scene's name with the lowest free number, in the folder of the last picture.
fn free_name(session: &Session) -> PathBuf {
    let scene = session.path.as_deref();
    let stem = scene.and_then(Path::file_stem).unwrap_or("demo".as_ref());
    let folder = (session.files.pending.folder.as_deref())
        .or(scene.and_then(Path::parent))
        .unwrap_or(Path::new(""));
    let name = |number: u32| {
        let mut name = stem.to_owned();
        name.push(format!("_{number}.png"));
        folder.join(name)
    };
    let mut number = 1;
    while name(number).exists() && number < 10_000 {
        number += 1;
    }
    name(number)
}

/// Opens a file dialog for the name.
pub fn browse(session: &mut Session, ctx: &egui::Context) {
    let Some(dialog) = &mut session.files.saving else {
        return;
    };
    let path = Path::new(dialog.path.trim());
    let request = Request::save("Save the picture", PICTURES, path);
    dialog.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Saves with the dialog's settings, now or when the picture is finished.
pub fn save(session: &mut Session, waits: bool) {
    let Some(dialog) = session.files.saving.take() else {
        return;
    };
    let target = match dialog.target() {
        Ok(target) => target,
        Err(_) => {
            session.files.saving = Some(dialog);
            return;
        }
    };
    let other = size_of(session, dialog.size).filter(|_| !dialog.overlays);
    let pending = &mut session.files.pending;
    pending.quality = Some(dialog.quality);
    pending.folder = target.path.parent().map(Path::to_owned);
    if let Some(size) = other {
        render(session, target, size);
    } else if dialog.overlays {
        pending.pose = Some(Pose::new(target));
    } else if waits {
        let name = short(&target.path);
        session
            .messages
            .notify(format!("{name} will be saved when the picture is finished"));
        let waiting = &mut session.files.pending.waiting;
        waiting.retain(|other| other.path != target.path);
        waiting.push(target);
    } else {
        ask(session, target, None);
    }
}

/// Cancels pictures that wait to be finished or are being rendered for a file.
pub fn cancel(session: &mut Session) {
    for rendering in session.files.pending.rendering.drain(..) {
        rendering.is_cancelled.store(true, Ordering::Relaxed);
    }
    session.files.pending.waiting.clear();
}

/// Cancels them because another scene was opened, with a message for each.
pub(super) fn abandon(session: &mut Session) {
    for target in &session.files.pending.waiting {
        session.messages.warn(not_finished(target));
    }
    session.files.pending.waiting.clear();
    session.files.pending.turn += 1;
}

fn not_finished(target: &Target) -> String {
    format!(
        "{} was not saved: another scene was opened before the picture was finished. Open the first \
         one again to save it.",
        target.path.display()
    )
}

/// Width and height in pixels, where they differ from those of the picture in the window.
pub fn size_of(session: &Session, size: SaveSize) -> Option<(u32, u32)> {
    let (width, height) = session.view.scene_settings.size;
    let wanted = match size {
        SaveSize::Window => return None,
        SaveSize::Scene => (width, height),
        SaveSize::Twice => (2 * width, 2 * height),
    };
    (wanted != session.picture_size()).then_some(wanted)
}

/// Renders the picture at another size on a thread of its own, and writes it.
fn render(session: &mut Session, mut target: Target, size: (u32, u32)) {
    let integrator = session.view.settings.integrator;
    let Some(mut request) = session.render_request(integrator) else {
        return;
    };
    request.settings = session.view.settings_at(size, integrator);
    if (session.controller.as_ref()).is_some_and(CameraController::is_home) {
        // A camera that frames a model in the window does so in no picture of another size.
        request.camera = None;
    }
    target.opacity = request.settings.has_opacity();
    let linear = (session.request.overrides.tone).tone(&request.scene.output, integrator, true);
    let tone = tone_of(&target, request.tone, linear);
    let (sender, receiver) = channel();
    let is_cancelled = Arc::new(AtomicBool::new(false));
    session.files.pending.rendering.push(Rendering {
        receiver,
        is_cancelled: is_cancelled.clone(),
    });
    let (width, height) = size;
    let name = short(&target.path);
    session
        .messages
        .notify(format!("Rendering {name} at {width}×{height}"));
    session.ask(move |frame| {
        let gpu = frame.renderer.gpu().clone();
        let work = move || {
            let keeps_raw = target.format.has_layers();
            let outcome = match still::render(gpu, &request, &tone, keeps_raw, &is_cancelled) {
                Ok(Some(still)) => write_file(&still, &target, "").map(Some),
                Ok(None) => Ok(None),
                Err(error) => Err(error.to_string()),
            };
            // The window may have been closed meanwhile.
            let _ = sender.send(outcome);
        };
        match std::thread::Builder::new().name("save".into()).spawn(work) {
            Ok(_) => Answer::Nothing,
            Err(error) => Answer::Failed(format!("cannot render a picture: {error}.")),
        }
    });
}

/// The tone of a file: what the window shows, or for linear light that of the command line, denoised as in the window.
fn tone_of(target: &Target, shown: Tone, linear: Tone) -> Tone {
    match target.format.is_linear() {
        true => Tone {
            denoise: shown.denoise,
            ..linear
        },
        false => shown,
    }
}

/// Writes a picture. The outcome is a message.
fn write_file(still: &Still, target: &Target, how_far: &str) -> Result<String, String> {
    let options = SaveOptions {
        format: Some(target.format),
        quality: target.quality,
        clobber: target.replaces,
        opacity: target.opacity,
        ..SaveOptions::default()
    };
    let saved = match &still.raw {
        None => output::save_with(&target.path, &still.image, &options),
        Some(raw) => {
            let layers = LayeredImage {
                width: raw.width,
                height: raw.height,
                layers: beside_raw(&still.image, raw, target.opacity),
                in_parts: false,
            };
            output::save_layers(&target.path, &layers, &options)
        }
    };
    match saved {
        Ok(()) => Ok(format!("Saved {}{how_far}", target.path.display())),
        Err(error) => Err(error.to_string()),
    }
}

/// Requests the picture from the render thread.
fn ask(session: &mut Session, target: Target, waits: Option<u32>) {
    let integrator = session.view.settings.integrator;
    let Some(scene) = session.scene() else {
        return;
    };
    let linear = (session.request.overrides.tone).tone(&scene.output, integrator, true);
    session.files.pending.asked += 1;
    session.ask(move |frame| capture(frame, target, waits, linear));
}

fn capture(frame: &mut FrameRenderer, target: Target, waits: Option<u32>, linear: Tone) -> Answer {
    let of = frame.settings().samples;
    let mut captured = Captured {
        still: Ok(None),
        samples: 0,
        of,
        target,
        waits,
    };
    if waits.is_some() && !frame.renderer.is_done() {
        return Answer::Picture(Box::new(captured));
    }
    let tone = tone_of(&captured.target, frame.request.tone, linear);
    let keeps_raw = captured.target.format.has_layers();
    match Still::developed(frame.renderer, &tone, keeps_raw) {
        Ok(still) => {
            captured.samples = frame.renderer.samples_done();
            captured.target.opacity = frame.settings().has_opacity();
            captured.still = Ok(Some(still));
        }
        Err(error) => captured.still = Err(advice::render(&error)),
    }
    Answer::Picture(Box::new(captured))
}

/// Handles the picture from the render thread.
pub fn captured(session: &mut Session, captured: Captured) {
    let pending = &mut session.files.pending;
    pending.asked = pending.asked.saturating_sub(1);
    // Another scene may be open by now.
    if captured.waits.is_some_and(|turn| turn != pending.turn) {
        session.messages.warn(not_finished(&captured.target));
        return;
    }
    let still = match captured.still {
        Ok(Some(still)) => still,
        Ok(None) => {
            pending.waiting.push(captured.target);
            return;
        }
        Err(why) => {
            session.messages.warn(why);
            return;
        }
    };
    let how_far = match captured.samples < captured.of {
        true => format!(" ({} of {} samples)", captured.samples, captured.of),
        false => String::new(),
    };
    write(session, still, captured.target, how_far);
}

/// Writes on a separate thread.
pub(super) fn write(session: &mut Session, still: Still, target: Target, how_far: String) {
    let (sender, receiver) = channel();
    let work = move || {
        let outcome = write_file(&still, &target, &how_far);
        // The window may have been closed meanwhile.
        let _ = sender.send(outcome);
    };
    match std::thread::Builder::new().name("save".into()).spawn(work) {
        Ok(_) => session.files.pending.writing.push(receiver),
        Err(error) => session
            .messages
            .warn(format!("Cannot save the picture: {error}.")),
    }
}

/// Handles results of saving since the last frame.
pub(super) fn update(session: &mut Session) {
    take_reply(session);
    let messages = &mut session.messages;
    session.files.pending.writing.retain(|receiver| {
        match receiver.try_recv() {
            Ok(Ok(notice)) => messages.notify(notice),
            Ok(Err(why)) => messages.warn(why),
            Err(TryRecvError::Empty) => return true,
            Err(TryRecvError::Disconnected) => {
                messages
                    .warn("Internal error while saving a picture. Please report it.".to_owned());
            }
        }
        false
    });
    (session.files.pending.rendering).retain(|rendering| match rendering.receiver.try_recv() {
        Err(TryRecvError::Empty) => true,
        Ok(Ok(notice)) => {
            notice
                .into_iter()
                .for_each(|notice| messages.notify(notice));
            false
        }
        Ok(Err(why)) => {
            messages.warn(why);
            false
        }
        // The device was lost, or the scene left before the question was put.
        Err(TryRecvError::Disconnected) => {
            messages.warn("A picture was not written: its rendering was interrupted.".to_owned());
            false
        }
    });
}

/// Saves the next waiting picture when the current one is finished.
pub fn finish(session: &mut Session, is_done: bool) {
    let pending = &mut session.files.pending;
    if is_done && pending.asked == 0 && !pending.waiting.is_empty() {
        let (target, turn) = (pending.waiting.remove(0), pending.turn);
        ask(session, target, Some(turn));
    }
}

fn take_reply(session: &mut Session) {
    let Some(dialog) = &mut session.files.saving else {
        return;
    };
    match file_dialog::take_reply(&mut dialog.asked) {
        Some(Reply::Chosen(mut path)) => {
            let agreed = path.clone();
            if path.extension().is_none() {
                path.set_extension("png");
            }
            dialog.path = path.to_string_lossy().into_owned();
            dialog.agreed = (agreed == path).then_some(agreed);
        }
        Some(Reply::Unavailable) => session.messages.warn(NO_DIALOG.to_owned()),
        Some(Reply::Cancelled) | None => {}
    }
}

/// Size of the picture in pixels.
pub fn size(session: &Session) -> (u32, u32) {
    let requests = session.requests();
    let request = requests.pictures[PictureSlot::Main as usize].as_ref();
    let region = request.map(|request| request.settings.region());
    region.map_or((0, 0), |[.., width, height]| (width, height))
}
