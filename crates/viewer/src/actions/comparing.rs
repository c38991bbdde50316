//! Keeps snapshots and opens reference pictures to compare with.

use crate::model::bindings::Action;
use crate::model::file_dialog::{self, Reply, Request};
use crate::model::gallery::{MOST, Snapshot, StillId};
use crate::model::view_settings::{Comparison, Sharing, Source};
use crate::state::answer::Answer;
use crate::state::comparing::Reading;
use crate::state::session::Session;
use crate::worker::progressive_image::FrameRenderer;
use eframe::egui;
use glimray_app::{advice, picture_file};
use glimray_render::{Shows, Tone};
use glimray_scene::image::{Image, ScreenImage};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{TryRecvError, channel};

/// Keeps the main picture as it is now, to compare later ones with it.
pub fn keep_snapshot(session: &mut Session) {
    if session.scene().is_none() {
        session.messages.notify("There is no picture yet");
    } else if has_room(session) {
        session.ask(snapshot);
    }
}

/// Whether there is room for another still; a message says so if not.
fn has_room(session: &mut Session) -> bool {
    let is_full = session.comparing.gallery.is_full();
    if is_full {
        session.messages.warn(format!(
            "{MOST} snapshots and reference pictures are kept already. Remove one in the Render panel first."
        ));
    }
    !is_full
}

fn snapshot(frame: &mut FrameRenderer) -> Answer {
    let (request, region) = (frame.request, frame.renderer.region());
    let entry = request.settings.integrator.entry();
    let is_radiance = entry.shows == Shows::Radiance;
    let is_denoised = is_radiance && frame.renderer.denoises(&request.tone);
    let tone = match is_radiance {
        true => Tone {
            denoise: is_denoised,
            ..Tone::LINEAR
        },
        false => request.tone,
    };
    let how = if is_denoised { ", denoised" } else { "" };
    let kept = frame.image(&tone).and_then(|kept| {
        let screen = frame.screen_image()?;
        // Without a presentation, the pixels are what is known.
        let screen = screen.unwrap_or_else(|| ScreenImage::from(&kept.0));
        Ok((kept, screen))
    });
    match kept {
        Ok(((image, samples), screen)) => Answer::Snapshot(Box::new(Snapshot {
            image,
            screen,
            region,
            size: request.settings.size,
            is_radiance,
            detail: format!("{}, {samples} samples{how}", entry.title),
        })),
        Err(error) => Answer::Failed(advice::render(&error)),
    }
}

/// Keeps the snapshot from the render thread.
pub fn kept(session: &mut Session, snapshot: Snapshot) {
    if !has_room(session) {
        return;
    }
    let still = session.comparing.gallery.keep_snapshot(snapshot);
    session.view.proposed = Some(Source::Still(still.id));
    let (name, number) = (still.name.clone(), still.number);
    let key = Action::kept(number).map(|action| session.preferences.bindings.label(action));
    let told = match key.filter(|key| !key.is_empty()) {
        Some(key) => format!("Kept {name}. {key} flips to it"),
        None => format!("Kept {name}. Choose a comparison to see it"),
    };
    session.messages.notify(told);
}

/// Shows the kept picture in place of the present one, or the present one and its comparison again: the one that was compared
/// with last, or else the last one that was kept.
pub fn flip(session: &mut Session) {
    match flipped(session) {
        Some(_) => session.view.comparison = session.unflipped.take(),
        None => {
            let proposed = session
                .view
                .proposed
                .or(session.view.comparison.map(|it| it.source));
            let still = match proposed {
                Some(Source::Still(id)) => Some(id),
                _ => session.comparing.gallery.newest().map(|still| still.id),
            };
            show(session, still);
        }
    }
}

/// Shows the kept picture with this number in place of the present one, or the present one again if that is shown already.
pub fn flip_to(session: &mut Session, number: usize) {
    let Some(id) = (session.comparing.gallery.numbered(number)).map(|still| still.id) else {
        let told = format!("No picture is kept under {number}");
        session.messages.notify(told);
        return;
    };
    match flipped(session) == Some(id) {
        true => session.view.comparison = session.unflipped.take(),
        false => show(session, Some(id)),
    }
}

/// Shows the kept picture after the one that is shown, or the first.
pub fn flip_to_next(session: &mut Session) {
    let all = session.comparing.gallery.all();
    let now = flipped(session);
    let now = now.and_then(|id| all.iter().position(|still| still.id == id));
    let next = now.map_or(0, |index| (index + 1) % all.len());
    show(session, all.get(next).map(|still| still.id));
}

/// The kept picture that is shown in place of the present one.
pub fn flipped(session: &Session) -> Option<StillId> {
    match session.view.comparison? {
        Comparison {
            source: Source::Still(id),
            sharing: Sharing::Wipe(share),
        } if share <= 0.0 => Some(id),
        _ => None,
    }
}

/// Shows a kept picture in place of the present one.
fn show(session: &mut Session, still: Option<StillId>) {
    let Some(id) = still else {
        session
            .messages
            .notify("No picture is kept yet. Keep a snapshot first");
        return;
    };
    if flipped(session).is_none() {
        session.unflipped = session.view.comparison;
    }
    let source = Source::Still(id);
    session.view.proposed = Some(source);
    // A wipe whose line is at the left edge.
    let sharing = Sharing::Wipe(0.0);
    session.view.comparison = Some(Comparison { source, sharing });
    if let Some(still) = session.comparing.gallery.get(id) {
        let name = still.name.clone();
        session.messages.notify(format!("Showing {name}"));
    }
}

/// Forgets a still and ends its comparison.
pub fn remove(session: &mut Session, still: StillId) {
    session.view.forget(still);
    (session.unflipped).take_if(|before| before.source == Source::Still(still));
    (session.comparing.renaming).take_if(|(renamed, _)| *renamed == still);
    session.comparing.gallery.remove(still);
}

/// Opens a file dialog for a reference picture.
pub fn ask_reference(session: &mut Session, ctx: &egui::Context) {
    if session.comparing.asked.is_some() {
        return;
    }
    let folder = session.path.as_deref().and_then(Path::parent);
    let request = Request {
        saves: false,
        kind: Some(("Pictures", glimray_io::import::PICTURE_ENDINGS)),
        title: "Open a reference picture".to_owned(),
        folder: folder.map(Path::to_owned),
        name: None,
    };
    session.comparing.asked = Some(session.files.dialogs.ask(request, ctx));
}

/// Reads a reference picture on a thread of its own, to compare with it.
pub fn open_reference(session: &mut Session, path: PathBuf) {
    let (sender, outcome) = channel();
    let from = path.clone();
    let read = move || {
        // The window may have been closed meanwhile.
        let _ = sender.send(picture_file::read(&from));
    };
    match std::thread::Builder::new().name("load".into()).spawn(read) {
        Ok(_) => session.comparing.reading = Some(Reading { path, outcome }),
        Err(error) => session
            .messages
            .warn(format!("Cannot read the picture: {error}.")),
    }
}

/// Takes replies of the file dialog and pictures that have been read.
pub fn update(session: &mut Session) {
    if flipped(session).is_none() {
        session.unflipped = None;
    }
    match file_dialog::take_reply(&mut session.comparing.asked) {
        Some(Reply::Chosen(path)) => open_reference(session, path),
        Some(Reply::Unavailable) => {
            let told =
                "No file dialog is available on this desktop (no portal answers). Type the path.";
            session.messages.warn(told.to_owned());
            session.comparing.typed = Some(String::new());
        }
        Some(Reply::Cancelled) | None => {}
    }
    let Some(reading) = &session.comparing.reading else {
        return;
    };
    let outcome = match reading.outcome.try_recv() {
        Err(TryRecvError::Empty) => return,
        outcome => outcome,
    };
    let Some(Reading { path, .. }) = session.comparing.reading.take() else {
        return;
    };
    match outcome {
        Ok(Ok(picture)) => {
            for note in picture.notes {
                session.messages.warn(note);
            }
            let image = opaque(picture.image, picture.is_float);
            compare_with(session, &path, image, picture.is_float);
        }
        Ok(Err(error)) => session.messages.warn(error.to_string()),
        Err(_) => {
            let path = path.display();
            let why = format!("Internal error while reading {path}. Please report it.");
            session.messages.warn(why);
        }
    }
}

fn compare_with(session: &mut Session, path: &Path, image: Image, is_radiance: bool) {
    if session.comparing.gallery.holds(path) || has_room(session) {
        let gallery = &mut session.comparing.gallery;
        let still = gallery.keep_reference(path, image, is_radiance);
        let source = Source::Still(still.id);
        session.view.compare_with(source);
    }
}

/// The picture without its transparency, which rendered pictures do not have. Light is seen in front of black.
fn opaque(mut image: Image, is_radiance: bool) -> Image {
    for [r, g, b, opacity] in &mut image.pixels {
        // Without opacity there is no colour, only light that is added.
        if is_radiance && *opacity > 0.0 {
            for color in [r, g, b] {
                *color *= *opacity;
            }
        }
        *opacity = 1.0;
    }
    image
}
