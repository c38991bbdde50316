//! Commands that edit the scene, and the focus of the outline.

use crate::model::document::Document;
use crate::model::objects;
use crate::model::objects::{EditError, Id};
use crate::model::outline;
use crate::model::tool::Tool;
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
    if steps != 0 {
        let next = session.editing.listing.step(session.selection, steps);
        session.selection = next.or(session.selection);
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
    if !ctx.input(|input| input.pointer.any_down()) && session.editing.grip.is_none() {
        document.release();
    }
    let scene = document.scene().clone();
    let editing = &mut session.editing;
    let is_known = (editing.known.as_ref()).is_some_and(|known| Arc::ptr_eq(known, &scene));
    if !is_known {
        editing.known = Some(scene.clone());
        editing.owes_bounds = true;
        session.playback.set_scene(&scene);
        let camera = scene.frame(session.playback.time).camera;
        if let Some(controller) = &mut session.controller
            && session.editing.home.as_ref() != Some(&camera)
        {
            controller.set_home(&camera);
        }
        session.editing.home = Some(camera);
        if (session.selection).is_some_and(|id| !objects::is_there(&scene, id)) {
            session.selection = None;
        }
    }
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
    let Some(document) = &mut session.document else {
        return;
    };
    if !document.is_changed() {
        session.messages.notify("No changes to revert");
        return;
    }
    document.revert();
    session.selection = None;
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
    let Some(document) = &mut session.document else {
        return;
    };
    let before = document.scene().clone();
    let (done, did, undone) = match again {
        true => (document.redo(), "Redid", "redo"),
        false => (document.undo(), "Undid", "undo"),
    };
    // Indices may refer to different objects now.
    let is_other = done.as_deref().is_some_and(Document::replaces);
    let after = document.scene();
    let selected = session.selection.filter(|_| !is_other);
    session.selection = selected.and_then(|id| objects::same(&before, after, id));
    session.editing.renaming = None;
    session.editing.group = None;
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
        let changed = self.document.as_mut()?.try_edit(name, change);
        self.report(name, changed)
    }

    /// Changes the scene as part of a drag, which is one step until the button is released. `change` gets
    /// the scene from before the drag.
    pub fn drag_change<T>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, EditError>,
    ) -> Option<T> {
        let changed = self.document.as_mut()?.drag(name, change);
        self.report(name, changed)
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

    /// Duplicates something and selects the copy.
    pub fn duplicate(&mut self, id: Id) {
        let label = self.label(id);
        let name = format!("duplicate {label}");
        if let Some(copy) = self.change(&name, |scene| objects::duplicate(scene, id)) {
            self.selection = Some(copy);
            let has_place = matches!(copy, Id::Object(_));
            self.messages.notify(match has_place {
                true => "Duplicated in place".to_owned(),
                false => format!("Duplicated {label}"),
            });
            if has_place {
                self.tool = Tool::Move;
            }
        }
    }

    /// Deletes something.
    pub fn remove(&mut self, id: Id) {
        let name = format!("delete {}", self.label(id));
        if self
            .change(&name, |scene| objects::remove(scene, id))
            .is_some()
        {
            self.selection = None;
        }
    }

    /// Starts to rename the selection, if it has a name.
    pub fn begin_rename(&mut self) {
        if let (Some(id), Some(scene)) = (self.selection, self.scene())
            && let Some(name) = objects::name(scene, id)
        {
            self.editing.renaming = Some((id, name.to_owned()));
        } else if let Some(id) = self.selection {
            let notice = format!(
                "{} has no name of its own. Rename its material or node",
                self.label(id)
            );
            self.messages.notify(notice);
        }
    }

    /// Frames something; a camera is looked through.
    pub fn frame(&mut self, id: Id) {
        self.selection = Some(id);
        let (width, height) = self.picture_size();
        let aspect = f64::from(width) / f64::from(height.max(1));
        let bounds = self.selection_bounds();
        let (Some(controller), Some(document)) = (&mut self.controller, &self.document) else {
            return;
        };
        if let Id::Camera(index) = id {
            controller.go_to(&camera_in_world(
                document.scene(),
                index,
                self.playback.time,
            ));
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
        if let (Some(controller), Some(document)) = (&mut self.controller, &self.document) {
            let camera = document.scene().frame(self.playback.time).camera;
            controller.set_home(&camera);
            controller.go_home();
            controller.arrive();
        }
    }
}

/// A camera in world space at `time`.
pub fn camera_in_world(scene: &Scene, index: usize, time: f64) -> Camera {
    let mut scene = scene.clone();
    scene.camera_index = index;
    scene.frame(time).camera
}
