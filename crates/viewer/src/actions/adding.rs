//! Adding things to the scene: surfaces, lights, cameras and models.

use crate::actions::dialogs;
use crate::actions::files::{NO_DIALOG, short};
use crate::actions::modal;
use crate::model::adding::{self, Addition, Spot};
use crate::model::file_dialog::{self, Reply, Request};
use crate::model::objects::{Id, unused_name};
use crate::state::session::Session;
use eframe::egui::{self, Popup};
use glam::DVec3;
use glimray_app::advice;
use glimray_io::import::{self, Options, Staging};
use glimray_scene::Scene;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{TryRecvError, channel};

/// Opens the menu of what can be added at the cursor, or in the middle of the picture.
pub fn open_menu(session: &mut Session, ctx: &egui::Context) {
    let Some(viewport) = session.viewport.filter(|_| session.scene().is_some()) else {
        session
            .messages
            .notify("No picture is open to add something to");
        return;
    };
    let pointer = ctx.pointer_latest_pos();
    let pointer = pointer.filter(|at| viewport.rect.contains(*at));
    session.editing.adding_at = pointer.unwrap_or(viewport.rect.center());
    Popup::open_id(ctx, menu_id());
}

/// The id of the menu of what can be added.
pub fn menu_id() -> egui::Id {
    egui::Id::unique("add")
}

/// Adds something at the pivot, in one step. It is selected, and follows the pointer until it is placed.
pub fn add(session: &mut Session, what: Addition) {
    if let Some(Id::Object(_)) = place(session, what) {
        modal::place_new(session);
    }
}

/// Adds something at the pivot, in one step, and selects it.
pub fn place(session: &mut Session, what: Addition) -> Option<Id> {
    let spot = spot(session)?;
    let name = unused_name(session.scene()?, what.title());
    let id = session.change(&format!("add {name}"), |scene| {
        Ok(adding::add(scene, what, &spot))
    })?;
    session.select(vec![id]);
    session.messages.notify(format!("Added {name}"));
    Some(id)
}

fn spot(session: &Session) -> Option<Spot> {
    let controller = session.controller.as_ref()?;
    Some(Spot::new(
        controller.pivot(),
        controller.up_axis(),
        controller.destination(),
    ))
}

/// Asks for the file of a model to add.
pub fn ask_model(session: &mut Session, ctx: &egui::Context) {
    let folder = session.path.as_deref().and_then(Path::parent);
    let request = Request {
        saves: false,
        kind: None,
        title: "Add a model or a scene".to_owned(),
        folder: folder.map(Path::to_owned),
        name: None,
    };
    session.files.asked_model = Some(session.files.dialogs.ask(request, ctx));
}

/// Reads a model or a scene, which is then added.
pub fn add_model(session: &mut Session, path: PathBuf) {
    let (sender, receiver) = channel();
    let from = path.clone();
    let read = move || {
        let options = Options {
            staging: Staging::NONE,
            ..Options::default()
        };
        // The window may have been closed meanwhile.
        let _ = sender.send(import::load_with(&from, &options));
    };
    match std::thread::Builder::new().name("load".into()).spawn(read) {
        Ok(_) => session.files.model = Some((path, receiver)),
        Err(error) => (session.messages).warn(format!("Cannot read the model: {error}.")),
    }
}

/// Takes the answer of the file dialog, and the model once it is read.
pub fn update(session: &mut Session) {
    match file_dialog::take_reply(&mut session.files.asked_model) {
        Some(Reply::Chosen(path)) => add_model(session, path),
        Some(Reply::Unavailable) => {
            session.messages.warn(NO_DIALOG.to_owned());
            session.files.typed_model = Some(String::new());
        }
        Some(Reply::Cancelled) | None => {}
    }
    // A model that is read meanwhile waits until the hand is free.
    if is_in_hand(session) {
        return;
    }
    let Some((path, receiver)) = &session.files.model else {
        return;
    };
    let outcome = match receiver.try_recv() {
        Err(TryRecvError::Empty) => return,
        Ok(outcome) => Some(outcome),
        Err(TryRecvError::Disconnected) => None,
    };
    let path = path.clone();
    session.files.model = None;
    match outcome {
        Some(Ok(model)) => merge(session, &path, model),
        Some(Err(error)) => session.messages.warn(advice::import(&error)),
        None => {
            let path = path.display();
            let why = format!("Internal error while reading {path}. Please report it.");
            session.messages.warn(why);
        }
    }
}

/// Whether something is dragged or follows the pointer, which another change would end.
fn is_in_hand(session: &Session) -> bool {
    let editing = &session.editing;
    session.drag.is_some() || editing.grip.is_some() || editing.modal.is_some()
}

/// Adds a model under a node of its own, so that it stands at the pivot with a good size.
fn merge(session: &mut Session, path: &Path, model: Scene) {
    let Some(spot) = spot(session) else {
        return;
    };
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = match session.scene() {
        Some(scene) => unused_name(scene, &stem),
        None => return,
    };
    let (skipped, bounds) = (model.skipped.len(), model.bounds());
    let mut halvings = 0;
    let added = session.change(&format!("add {name}"), |scene| {
        let (node, times) = scene.append(model, &name);
        halvings = times;
        let (min, max) = bounds.unwrap_or((DVec3::ZERO, DVec3::ZERO));
        let extent = (max - min).max_element();
        let factor = match extent > 0.0 {
            true => adding::rounded(2.0 * spot.size / extent),
            false => 1.0,
        };
        scene.nodes[node].scale = DVec3::splat(factor);
        // The lowest point is where a plane is added.
        let foot = min.midpoint(max) - spot.up * (max - min).dot(spot.up.abs()) / 2.0;
        scene.nodes[node].translation = spot.pivot - spot.up * spot.size - foot * factor;
        Ok(Id::Node(node))
    });
    let Some(id) = added else {
        return;
    };
    session.select(vec![id]);
    session.messages.notify(format!("Added {}", short(path)));
    if halvings > 0 {
        session.messages.warn(import::smaller_pictures(halvings));
    }
    if skipped > 0 {
        let text = "Parts of the model are missing or were repaired: see the end of the outline";
        session.messages.warn(text.to_owned());
    }
    // The keys of a field or a dialog are not those of a move.
    let is_typing = session.editing.renaming.is_some() || session.dialogs.had_keyboard;
    let is_asking = dialogs::is_asking(session) || session.dialogs.bindings.awaits();
    if !is_typing && !is_asking {
        modal::place_new(session);
    }
}
