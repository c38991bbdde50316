//! Commands that edit the scene, and the focus of the outline.

use crate::model::document::Document;
use crate::model::objects;
use crate::model::objects::{EditError, Id, Labels};
use crate::model::outline;
use crate::state::session::Session;
use eframe::egui::{self, Key, Modifiers};
use glimray_app::overrides;
use glimray_scene::{Camera, Scene};
use std::sync::Arc;

/// Whether the outline handles arrow keys. Other keys perform commands.
pub fn keys(session: &mut Session, ctx: &egui::Context) -> bool {
    if !has_list_focus(session, ctx) {
        return false;
    }
    let take = |key| ctx.input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key));
    let steps = take(Key::ArrowDown) as isize - take(Key::ArrowUp) as isize;
    if steps != 0
        && let Some(next) = session.editing.listing.step(session.selection, steps)
    {
        session.select(vec![next]);
    }
    true
}

/// Whether the outline has the keyboard focus: nothing else has it, and no row is being renamed.
pub fn has_list_focus(session: &Session, ctx: &egui::Context) -> bool {
    let editing = &session.editing;
    editing.renaming.is_none() && holds_focus(editing.list_focus, ctx)
}

/// Whether the outline's focused row still has the focus, or nothing else has it: a row that is scrolled out
/// of view loses it.
pub fn holds_focus(line: Option<egui::Id>, ctx: &egui::Context) -> bool {
    let focused = ctx.memory(|memory| memory.focused());
    line.is_some() && (focused.is_none() || focused == line)
}

/// Updates everything that depends on the scene after an edit.
pub fn update(session: &mut Session, ctx: &egui::Context) {
    let Some(document) = &mut session.document else {
        return;
    };
    let editing = &session.editing;
    let is_held = editing.is_held() || editing.modal.is_some();
    if !ctx.input(|input| input.pointer.any_down()) && !is_held {
        document.release();
    }
    let scene = document.scene().clone();
    let editing = &mut session.editing;
    let is_known = (editing.known.as_ref()).is_some_and(|known| Arc::ptr_eq(known, &scene));
    if !is_known {
        editing.known = Some(scene.clone());
        editing.owes_bounds = true;
        session.playback.set_scene(&scene);
        let camera = session.home_camera();
        if let (Some(controller), Some(camera)) = (&mut session.controller, &camera)
            && session.editing.home.as_ref() != Some(camera)
        {
            controller.set_home(camera);
        }
        session.editing.home = camera;
        if (session.selection).is_some_and(|id| !objects::is_there(&scene, id)) {
            session.select(Vec::new());
        }
    }
    // A camera that was left is not to be focused by a later click.
    let selection = session.selection;
    (session.tool_state.focuses).take_if(|index| selection != Some(Id::Camera(*index)));
    // Visits every vertex, so it is postponed while something is dragged.
    if session.editing.owes_bounds && !session.is_moving() {
        session.editing.owes_bounds = false;
        if let Some(controller) = &mut session.controller {
            controller.set_bounds(scene.bounds());
        }
    }
}

/// Applies an edit to the selection, or reports that nothing is selected.
pub fn with_selection(session: &mut Session, act: impl FnOnce(&mut Session, Id)) {
    match session.selection {
        Some(id) => act(session, id),
        None => session
            .messages
            .notify("Nothing is selected. Click an object first"),
    }
}

/// Reverts all changes since the scene was opened, in a step that can be undone.
pub fn revert(session: &mut Session) {
    let Some(document) = session.noting_selection() else {
        return;
    };
    if !document.is_changed() {
        session.messages.notify("No changes to revert");
        return;
    }
    document.revert();
    session.select(Vec::new());
    session.moved();
    session
        .messages
        .notify("All changes reverted. Undo restores them");
}

/// Undoes the last change.
pub fn undo(session: &mut Session) {
    step(session, false);
}

/// Redoes the last undone change.
pub fn redo(session: &mut Session) {
    step(session, true);
}

fn step(session: &mut Session, again: bool) {
    let selected = session.selected();
    let Some(document) = &mut session.document else {
        return;
    };
    let before = document.scene().clone();
    document.note_selection(&selected);
    let (done, did, undone) = match again {
        true => (document.redo(), "Redid", "redo"),
        false => (document.undo(), "Undid", "undo"),
    };
    // Indices may refer to different objects now.
    let is_other = done.as_deref().is_some_and(Document::replaces);
    let after = document.scene().clone();
    let mut found = match (done.is_some(), is_other) {
        (false, _) => selected,
        // Things that came back are selected unless something else is.
        (true, _) if selected.is_empty() => document.selected().to_vec(),
        (true, true) => Vec::new(),
        (true, false) => objects::same(&before, &after, &selected),
    };
    found.retain(|id| objects::is_there(&after, *id));
    session.select(found);
    session.editing.renaming = None;
    session.messages.notify(match done {
        Some(name) => format!("{did} {name}"),
        None => format!("Nothing to {undone}"),
    });
    session.moved();
}

impl Session {
    /// Changes the scene in one step. `name` describes it, such as "move sphere 3". Reports an error as a
    /// message.
    pub fn change<T>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, EditError>,
    ) -> Option<T> {
        let changed = self.noting_selection()?.try_edit(name, change);
        self.report(name, changed)
    }

    /// Changes the scene as part of a drag, which is one step until the button is released. `change` gets
    /// the scene from before the drag.
    pub fn drag_change<T>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, EditError>,
    ) -> Option<T> {
        let changed = self.noting_selection()?.drag(name, change);
        self.report(name, changed)
    }

    /// The document, which is told what is selected before it changes.
    fn noting_selection(&mut self) -> Option<&mut Document> {
        let selected = self.selected();
        let document = self.document.as_mut()?;
        document.note_selection(&selected);
        Some(document)
    }

    fn report<T>(&mut self, name: &str, changed: Result<T, EditError>) -> Option<T> {
        match changed {
            Ok(value) => {
                self.moved();
                Some(value)
            }
            Err(error) => {
                self.messages.warn(format!("Cannot {name}: {error}"));
                None
            }
        }
    }

    /// The label of something.
    pub fn label(&self, id: Id) -> String {
        let Some(scene) = self.scene() else {
            return String::new();
        };
        // A drag, an answer or a menu may name something that an undo or a reload has taken away.
        if !objects::is_there(scene, id) {
            return "nothing".to_owned();
        }
        match self.editing.listing.label(scene, id) {
            Some(label) => label.to_owned(),
            None => outline::label(scene, id),
        }
    }

    /// Shows or hides something.
    pub fn set_visible(&mut self, id: Id, visible: bool) {
        let verb = if visible { "show" } else { "hide" };
        let name = format!("{verb} {}", self.label(id));
        self.change(&name, |scene| objects::set_visible(scene, id, visible));
    }

    /// Hides all other objects.
    pub fn hide_others(&mut self, id: Id) {
        let name = format!("hide all but {}", self.label(id));
        self.change(&name, |scene| {
            objects::hide_others(scene, id);
            Ok(())
        });
    }

    /// Shows all hidden objects.
    pub fn show_all(&mut self) {
        self.change("show all", |scene| {
            objects::show_all(scene);
            Ok(())
        });
    }

    /// Starts to rename the selection.
    pub fn begin_rename(&mut self) {
        if let (Some(id), Some(scene)) = (self.selection, self.scene())
            && objects::is_there(scene, id)
        {
            self.editing.renaming = Some((id, self.name(id)));
        }
    }

    /// The name of something; without one, its label without the material.
    pub fn name(&self, id: Id) -> String {
        match self.scene() {
            Some(scene) => Labels::of(scene).short(scene, id),
            None => String::new(),
        }
    }

    /// Frames something; a camera is looked through.
    pub fn frame(&mut self, id: Id) {
        self.select(vec![id]);
        let aspect = self.aspect();
        let bounds = self.selection_bounds();
        let (Some(controller), Some(document)) = (&mut self.controller, &self.document) else {
            return;
        };
        if let Id::Camera(index) = id {
            let scene = document.scene();
            let camera = camera_in_world(scene, index, self.playback.time);
            match scene.cameras[index].has_aim() {
                true => controller.go_to(&camera),
                false => controller.go_to_without_aim(&camera),
            }
        } else if let Some(bounds) = bounds {
            controller.frame(bounds, aspect);
        }
        self.moved();
    }

    /// Sets the scene's camera to the current view.
    pub fn set_scene_camera(&mut self) {
        let Some(camera) = self.camera() else {
            return;
        };
        self.change("use this camera for the scene", |scene| {
            overrides::set_camera(scene, &camera);
            Ok(())
        });
        if let (Some(camera), Some(controller)) = (self.home_camera(), &mut self.controller) {
            controller.set_home(&camera);
            controller.go_home();
            controller.arrive();
        }
    }
}

/// A camera in world space at `time`.
pub fn camera_in_world(scene: &Scene, index: usize, time: f64) -> Camera {
    scene.cameras_at(time).swap_remove(index)
}
