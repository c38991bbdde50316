//! Opening pictures for the textures of materials.

use crate::actions::files::{NO_DIALOG, short};
use crate::model::file_dialog::{self, Reply, Request};
use crate::model::objects::Id;
use crate::model::texture_slots::TextureSlot;
use crate::state::session::Session;
use crate::state::texturing::{PictureRead, Stage, TexturePlace};
use eframe::egui;
use glimray_app::advice;
use glimray_io::import::{self, PICTURE_ENDINGS};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{TryRecvError, channel};

/// Asks for the file of a picture for a slot of materials. Materials without the slot are left out.
pub fn ask(
    session: &mut Session,
    ctx: &egui::Context,
    slot: &'static TextureSlot,
    materials: impl IntoIterator<Item = usize>,
) {
    let Some(scene) = session.scene() else {
        return;
    };
    let has_slot = |index: &usize| {
        let material = scene.materials.get(*index);
        material.is_some_and(|it| TextureSlot::of(it).any(|own| std::ptr::eq(own, slot)))
    };
    let label = |index| (index, session.label(Id::Material(index)));
    let materials = materials.into_iter().filter(has_slot).map(label).collect();
    let place = TexturePlace { slot, materials };
    let folder = session.path.as_deref().and_then(Path::parent);
    let request = Request {
        saves: false,
        kind: Some(("Pictures", PICTURE_ENDINGS)),
        title: "Open a picture for the material".to_owned(),
        folder: folder.map(Path::to_owned),
        name: None,
    };
    let asked = session.files.dialogs.ask(request, ctx);
    session.files.texturing.opening = Some((place, Stage::Asked(asked)));
}

/// Reads a picture on a thread of its own. The material has it then.
pub fn open(session: &mut Session, place: TexturePlace, path: PathBuf) {
    let (sender, receiver) = channel();
    let (from, meaning) = (path.clone(), place.slot.meaning);
    let read = move || {
        // The window may have been closed meanwhile.
        let _ = sender.send(import::texture(&from, meaning));
    };
    match std::thread::Builder::new().name("load".into()).spawn(read) {
        Ok(_) => {
            session.files.texturing.opening = Some((place, Stage::Reading(path, receiver)));
        }
        Err(error) => (session.messages).warn(format!("Cannot read the picture: {error}.")),
    }
}

/// Reads the picture at the path that was typed.
pub fn open_typed(session: &mut Session, path: PathBuf) {
    if let Some((place, _)) = session.files.texturing.opening.take() {
        open(session, place, path);
    }
}

/// Takes the reply of the file dialog, and the picture once it is read.
pub fn update(session: &mut Session) {
    let Some((place, stage)) = session.files.texturing.opening.take() else {
        return;
    };
    let goes_on = match stage {
        Stage::Asked(receiver) => {
            let mut asked = Some(receiver);
            match file_dialog::take_reply(&mut asked) {
                Some(Reply::Chosen(path)) => return open(session, place, path),
                Some(Reply::Unavailable) => {
                    session.messages.warn(NO_DIALOG.to_owned());
                    Some(Stage::Typed(Some(String::new())))
                }
                Some(Reply::Cancelled) => None,
                None => asked.map(Stage::Asked),
            }
        }
        // The dialog was closed.
        Stage::Typed(None) => None,
        Stage::Typed(text) => Some(Stage::Typed(text)),
        Stage::Reading(path, receiver) => match receiver.try_recv() {
            Err(TryRecvError::Empty) => Some(Stage::Reading(path, receiver)),
            Ok(outcome) => return show(session, place, &path, outcome),
            Err(TryRecvError::Disconnected) => {
                let path = path.display();
                let why = format!("Internal error while reading {path}. Please report it.");
                session.messages.warn(why);
                None
            }
        },
    };
    session.files.texturing.opening = goes_on.map(|stage| (place, stage));
}

fn show(session: &mut Session, place: TexturePlace, path: &Path, outcome: PictureRead) {
    let (picture, notes) = match outcome {
        Ok(read) => read,
        Err(error) => return session.messages.warn(advice::import(&error)),
    };
    let name = short(path);
    // An undone step or a reloaded file may have put others in their places.
    let is_other =
        |(index, label): &&(usize, String)| session.label(Id::Material(*index)) != *label;
    if let Some((_, label)) = place.materials.iter().find(is_other) {
        let why = format!(
            "Cannot open {name} for {label}: the material is no longer there. Open the picture again."
        );
        return session.messages.warn(why);
    }
    let to = match &place.materials[..] {
        [(_, label)] => label.clone(),
        several => format!("{} items", several.len()),
    };
    let materials: Vec<usize> = place.materials.iter().map(|(index, _)| *index).collect();
    let known = (Arc::downgrade(&picture), name.clone());
    let step = format!("open {name} for {to}");
    let shown = session.change(&step, |scene| place.slot.show(scene, &materials, picture));
    let Some(halvings) = shown else {
        return;
    };
    let texturing = &mut session.files.texturing;
    texturing
        .names
        .retain(|(picture, _)| picture.strong_count() > 0);
    texturing.names.push(known);
    let smaller = (halvings > 0).then(|| import::smaller_pictures(halvings));
    for note in notes.into_iter().chain(smaller) {
        session.messages.warn(note);
    }
}
