//! Saves the picture to a file, as `glimray render` would.

use crate::actions::files::{NO_DIALOG, short};
use crate::model::file_dialog::{self, PICTURES, Reply, Request};
use crate::state::answer::Answer;
use crate::state::files::Captured;
use crate::state::files::SaveDialog;
use crate::state::files::{Pose, SaveSize};
use crate::state::jobs::{JobBegun, JobOutcome, Written};
use crate::state::session::Session;
use crate::state::target::Target;
use crate::worker::free_name;
use crate::worker::progressive_image::{FrameRenderer, PictureSlot};
use crate::worker::request::RenderRequest;
use crate::worker::still::{self, Still};
use eframe::egui;
use glimray_app::advice;
use glimray_io::output::SaveOptions;
use glimray_render::{Integrator, Tone};
use std::path::{Path, PathBuf};
use std::sync::mpsc::Sender;

/// Opens the dialog with a free name.
pub fn open(session: &mut Session, overlays: bool) {
    if session.scene().is_none() {
        session.messages.notify("There is no picture yet");
        return;
    }
    let path = free_name(session, ".png").to_string_lossy().into_owned();
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

/// The scene's name with the lowest number that no file has and no job will write, in the folder of the last picture.
pub(super) fn free_name(session: &Session, ending: &str) -> PathBuf {
    let scene = session.path.as_deref();
    let unnamed = if session.is_untitled {
        "untitled"
    } else {
        "demo"
    };
    let stem = scene.and_then(Path::file_stem).unwrap_or(unnamed.as_ref());
    let folder = (session.files.pending.folder.as_deref())
        .or(scene.and_then(Path::parent))
        .unwrap_or(Path::new(""));
    let mut name = stem.to_owned();
    name.push(format!("_1{ending}"));
    free_name::free(folder.join(name), |path| {
        path.exists() || session.files.jobs.is_reserved(path)
    })
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
        session.files.jobs.wait(target);
    } else {
        let job = session.files.jobs.begin(target.path.clone(), false);
        ask(session, target, job, None);
    }
}

/// Ends the jobs that wait for the picture because another scene was opened, with a message for each.
pub(super) fn abandon(session: &mut Session) {
    while let Some((id, target)) = session.files.jobs.waiting() {
        let why = not_finished(target);
        session.messages.warn(why.clone());
        session.files.jobs.fail(id, why);
    }
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

/// The request for what is rendered for a file alone, with the camera after all motion has ended; without one where
/// that is the scene's own.
pub(super) fn request_of_file(session: &Session, integrator: Integrator) -> Option<RenderRequest> {
    let request = session.render_request(integrator)?;
    let controller = session.controller.as_ref()?;
    let camera = controller.destination();
    // A camera that frames a model in the window does so in no picture of another size.
    let is_home = controller.is_home() || session.home_camera().as_ref() == Some(&camera);
    Some(RenderRequest {
        camera: (!is_home).then_some(camera),
        ..request
    })
}

/// Renders the picture at another size on a thread of its own, and writes it.
fn render(session: &mut Session, mut target: Target, size: (u32, u32)) {
    let integrator = session.view.settings.integrator;
    let Some(mut request) = request_of_file(session, integrator) else {
        return;
    };
    request.settings = session.view.settings_at(size, integrator);
    target.opacity = request.settings.has_opacity();
    let linear = (session.request.overrides.tone).tone(&request.scene.output, integrator, true);
    let tone = tone_of(&target, request.tone, linear);
    let job = session.files.jobs.begin(target.path.clone(), true);
    let (width, height) = size;
    let name = short(&target.path);
    session
        .messages
        .notify(format!("Rendering {name} at {width}×{height}"));
    session.ask(move |frame| {
        let gpu = frame.renderer.gpu().clone();
        let work = move || {
            let keeps_raw = target.format.has_layers();
            let outcome = match still::render(gpu, &request, &tone, keeps_raw, &job.control) {
                Ok(Some(still)) => write_file(&still, &target, ""),
                Ok(None) => Ok(None),
                Err(error) => Err(error.to_string()),
            };
            // The window may have been closed meanwhile.
            let _ = job.sender.send(outcome);
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

/// Writes a picture. If its name has been taken since, the next one that is free is used: nothing that was rendered is
/// thrown away.
fn write_file(still: &Still, target: &Target, how_far: &str) -> JobOutcome {
    let options = SaveOptions {
        format: Some(target.format),
        quality: target.quality,
        clobber: target.replaces,
        opacity: target.opacity,
        ..SaveOptions::default()
    };
    let save = |path: &Path| still.save(path, &options);
    match free_name::write(&target.path, save) {
        Ok(path) => Ok(Some(Written {
            message: saved(&path, &target.path, how_far),
            path,
        })),
        Err(error) => Err(error.to_string()),
    }
}

/// The message about a file that was written to `path` instead of `wanted` if that was taken. `how_far` tells how far it
/// is finished.
pub(super) fn saved(path: &Path, wanted: &Path, how_far: &str) -> String {
    let message = format!("Saved {}{how_far}", path.display());
    match path == wanted {
        true => message,
        false => format!("{message}, because {} exists by now", short(wanted)),
    }
}

/// Requests the picture from the render thread.
fn ask(session: &mut Session, target: Target, job: JobBegun, waits: Option<u32>) {
    let integrator = session.view.settings.integrator;
    let Some(scene) = session.scene() else {
        return;
    };
    let linear = (session.request.overrides.tone).tone(&scene.output, integrator, true);
    let captured = Captured {
        still: Ok(None),
        samples: 0,
        of: 0,
        target,
        waits,
        job: job.id,
        sender: job.sender,
    };
    session.ask(move |frame| capture(frame, captured, linear));
}

fn capture(frame: &mut FrameRenderer, mut captured: Captured, linear: Tone) -> Answer {
    captured.of = frame.settings().samples;
    if captured.waits.is_some() && !frame.renderer.is_done() {
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

/// Copies the picture as the window shows it to the clipboard, once the render thread has read it.
pub fn copy(session: &mut Session) {
    if session.scene().is_none() {
        session.messages.notify("There is no picture yet");
        return;
    }
    session.ask(|frame| match frame.screen_image() {
        Ok(Some(image)) => Answer::Copied(Box::new(image)),
        Ok(None) => Answer::Failed("There is no picture yet.".to_owned()),
        Err(error) => Answer::Failed(advice::render(&error)),
    });
}

/// Passes a picture to the clipboard.
fn pass_copied(session: &mut Session, ctx: &egui::Context) {
    let Some(image) = session.files.copied.take() else {
        return;
    };
    let size = [image.width as usize, image.height as usize];
    ctx.copy_image(egui::ColorImage::from_rgba_premultiplied(
        size,
        image.pixels.as_flattened(),
    ));
    let (width, height) = (image.width, image.height);
    let message = format!("Copied the picture, {width}×{height} pixels");
    session.messages.notify(message);
}

/// Handles the picture from the render thread.
pub fn captured(session: &mut Session, captured: Captured) {
    let files = &mut session.files;
    // Another scene may be open by now.
    let is_other = (captured.waits).is_some_and(|turn| turn != files.pending.turn);
    let still = match captured.still {
        _ if is_other => Err(not_finished(&captured.target)),
        Ok(None) => return files.jobs.wait_again(captured.job, captured.target),
        Ok(Some(still)) => Ok(still),
        Err(why) => Err(why),
    };
    let still = match still {
        Ok(still) => still,
        Err(why) => {
            files.jobs.fail(captured.job, why.clone());
            session.messages.warn(why);
            return;
        }
    };
    let how_far = match captured.samples < captured.of {
        true => format!(" ({} of {} samples)", captured.samples, captured.of),
        false => String::new(),
    };
    write(session, still, captured.target, captured.sender, how_far);
}

/// Writes on a separate thread, which sends the outcome.
pub(super) fn write(
    session: &mut Session,
    still: Still,
    target: Target,
    sender: Sender<JobOutcome>,
    how_far: String,
) {
    let work = move || {
        let outcome = write_file(&still, &target, &how_far);
        // The window may have been closed meanwhile.
        let _ = sender.send(outcome);
    };
    if let Err(error) = std::thread::Builder::new().name("save".into()).spawn(work) {
        session
            .messages
            .warn(format!("Cannot save the picture: {error}."));
    }
}

/// Handles results of saving since the last frame.
pub(super) fn update(session: &mut Session, ctx: &egui::Context) {
    take_reply(session);
    pass_copied(session, ctx);
    let messages = &mut session.messages;
    session.files.jobs.update(|outcome| match outcome {
        Ok(written) => messages.saved(written.message, written.path),
        Err(why) => messages.warn(why),
    });
}

/// Saves the next waiting picture when the current one is finished.
pub fn finish(session: &mut Session, is_done: bool) {
    let jobs = &mut session.files.jobs;
    let waiting = jobs.waiting().filter(|_| is_done);
    if let Some((id, target)) = waiting.map(|(id, target)| (id, target.clone())) {
        let job = jobs.run(id);
        let turn = session.files.pending.turn;
        ask(session, target, job, Some(turn));
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
