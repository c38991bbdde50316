//! Changing the scene: the commands, and what panels keep from frame to frame.

pub mod handles;
mod listing;
pub mod modal;
mod overlay;
mod saving;

pub use listing::Listing;
pub use overlay::overlay;
pub use saving::sheet;

use super::super::overrides;
use super::bindings::Action;
use super::document::Document;
use super::objects::{self, EditError, Id};
use super::outline;
use super::session::Session;
use super::tools::Tool;
use crate::scene::{Camera, Mesh, Scene};
use eframe::egui::{self, Key, Modifiers, Pos2};
use glam::DVec3;
use handles::Grip;
use modal::Modal;
use saving::Saving;
use std::path::PathBuf;
use std::sync::Arc;

/// What is being changed, and what was.
pub struct Editing {
    /// What is in the scene, line by line.
    pub listing: Listing,
    /// A handle in the hand, and where the pointer was last.
    pub grip: Option<(Grip, Pos2)>,
    /// A movement without a button, which then holds the grip.
    pub modal: Option<Modal>,
    /// What is being renamed, and its name so far.
    pub renaming: Option<(Id, String)>,
    /// The line of the outline that had the focus in the last frame: arrow keys go through the outline
    /// from there.
    pub list_focus: Option<egui::Id>,
    /// The selection that the outline has brought into sight.
    pub seen_selection: Option<Id>,
    /// From where to where the outline is in sight, in points from its beginning.
    pub seen_lines: egui::Rangef,
    /// Asks where a scene is to be saved.
    saving: Option<Saving>,
    /// What was written here, and so is not a person's own text.
    written: Option<PathBuf>,
    /// The scene that all else was told of.
    known: Option<Arc<Scene>>,
    /// The camera that it is seen by.
    home: Option<Camera>,
    /// Whether bounds are still to be told.
    owes_bounds: bool,
    /// The box of a mesh, which is looked for once.
    mesh_box: Option<(Arc<Mesh>, Bounds)>,
}

/// The least and the greatest corner of a box; `None` of what has none.
type Bounds = Option<(DVec3, DVec3)>;

impl Default for Editing {
    fn default() -> Self {
        Self {
            listing: Listing::default(),
            grip: None,
            modal: None,
            renaming: None,
            list_focus: None,
            seen_selection: None,
            seen_lines: egui::Rangef::EVERYTHING,
            saving: None,
            written: None,
            known: None,
            home: None,
            owes_bounds: false,
            mesh_box: None,
        }
    }
}

impl Editing {
    /// Whether a name for the scene is asked for.
    pub fn is_asking(&self) -> bool {
        self.saving.is_some()
    }

    /// Notes that the scene's file is not, or no longer, one that was written here.
    pub fn forget_written(&mut self) {
        self.written = None;
    }

    /// Bounds of a mesh in its own space.
    fn bounds_of(&mut self, mesh: &Arc<Mesh>) -> Option<(DVec3, DVec3)> {
        match &self.mesh_box {
            Some((known, bounds)) if Arc::ptr_eq(known, mesh) => *bounds,
            _ => {
                let bounds = mesh.bounds();
                self.mesh_box = Some((mesh.clone(), bounds));
                bounds
            }
        }
    }
}

/// Carries out a command that changes the scene. Whether it does.
pub fn perform(action: Action, session: &mut Session) -> bool {
    match action {
        Action::SelectNothing if session.editing.grip.is_some() => modal::cancel(session),
        Action::ToggleVisible => with_selection(session, |session, id| {
            let scene = session.scene().cloned();
            let visible = scene.is_some_and(|scene| objects::is_visible(&scene, id));
            session.set_visible(id, !visible);
        }),
        Action::Duplicate => with_selection(session, Session::duplicate),
        Action::Delete => with_selection(session, Session::remove),
        Action::Undo => step(session, false),
        Action::Redo => step(session, true),
        Action::Revert => {
            let Some(document) = &mut session.document else {
                return true;
            };
            let told = match document.is_changed() {
                true => "Threw all changes away; Undo brings them back",
                false => "There is nothing to throw away",
            };
            if document.is_changed() {
                session.selection = None;
            }
            document.revert();
            session.moved();
            session.notices.tell(told);
        }
        Action::SaveScene => saving::save(session),
        Action::SaveSceneAs => saving::ask(session),
        _ => return false,
    }
    true
}

/// Whether arrow keys go through the outline, which takes them, and other keys to commands.
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

/// Whether the outline has the keyboard focus: nothing else has it, and no line is being renamed.
pub fn has_list_focus(session: &Session, ctx: &egui::Context) -> bool {
    let editing = &session.editing;
    editing.renaming.is_none() && holds_focus(editing.list_focus, ctx)
}

/// Whether the line of the outline that had the focus still has it, or at least nothing else has: a line
/// that is scrolled out of sight loses it.
pub fn holds_focus(line: Option<egui::Id>, ctx: &egui::Context) -> bool {
    let focused = ctx.memory(|memory| memory.focused());
    line.is_some() && (focused.is_none() || focused == line)
}

/// What changes of the scene bring with them.
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
        session.playback.follow(&scene);
        let camera = scene.frame(session.playback.time).camera;
        if let Some(rig) = &mut session.rig
            && session.editing.home.as_ref() != Some(&camera)
        {
            rig.set_home(&camera);
        }
        session.editing.home = Some(camera);
        if (session.selection).is_some_and(|id| !objects::is_there(&scene, id)) {
            session.selection = None;
        }
    }
    // Every vertex may have to be looked at: not while something is dragged.
    if session.editing.owes_bounds && !session.is_moving() {
        session.editing.owes_bounds = false;
        if let Some(rig) = &mut session.rig {
            rig.set_bounds(scene.bounds());
        }
    }
}

fn with_selection(session: &mut Session, act: impl FnOnce(&mut Session, Id)) {
    match session.selection {
        Some(id) => act(session, id),
        None => session.notices.tell("Nothing is selected: click something"),
    }
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
    // Indices may stand for other things now.
    let is_other = done.as_deref().is_some_and(Document::replaces);
    let after = document.scene();
    let selected = session.selection.filter(|_| !is_other);
    session.selection = selected.and_then(|id| objects::same(&before, after, id));
    session.editing.renaming = None;
    session.notices.tell(match done {
        Some(name) => format!("{did} {name}"),
        None => format!("There is nothing to {undone}"),
    });
    session.moved();
}

impl Session {
    /// Changes the scene in one step, which `name` names in words such as "move sphere 3", or tells why
    /// that is not possible.
    pub fn change<T>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, EditError>,
    ) -> Option<T> {
        let changed = self.document.as_mut()?.try_edit(name, change);
        self.tell_of(name, changed)
    }

    /// The same as part of a drag, which is one step until the mouse is let go. `change` gets the scene
    /// as it was when that began.
    pub fn drag_change<T>(
        &mut self,
        name: &str,
        change: impl FnOnce(&mut Scene) -> Result<T, EditError>,
    ) -> Option<T> {
        let changed = self.document.as_mut()?.drag(name, change);
        self.tell_of(name, changed)
    }

    fn tell_of<T>(&mut self, name: &str, changed: Result<T, EditError>) -> Option<T> {
        match changed {
            Ok(value) => {
                self.moved();
                Some(value)
            }
            Err(error) => {
                self.notices.warn(format!("Cannot {name}: {error}"));
                None
            }
        }
    }

    /// What something is called.
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

    /// Hides all other objects and nodes that carry none of what stays.
    pub fn hide_others(&mut self, id: Id) {
        let name = format!("hide all but {}", self.label(id));
        self.change(&name, |scene| {
            objects::hide_others(scene, id);
            Ok(())
        });
    }

    /// Shows all that is hidden.
    pub fn show_all(&mut self) {
        self.change("show everything", |scene| {
            objects::show_all(scene);
            Ok(())
        });
    }

    /// Makes another one, which is selected then.
    pub fn duplicate(&mut self, id: Id) {
        let label = self.label(id);
        let name = format!("duplicate {label}");
        if let Some(copy) = self.change(&name, |scene| objects::duplicate(scene, id)) {
            self.selection = Some(copy);
            let has_place = matches!(copy, Id::Object(_));
            self.notices.tell(match has_place {
                true => format!("The copy stands where {label} is: drag it away"),
                false => format!("Made a copy of {label}"),
            });
            if has_place {
                self.tool = Tool::Move;
            }
        }
    }

    /// Takes something out of the scene.
    pub fn remove(&mut self, id: Id) {
        let name = format!("delete {}", self.label(id));
        if self
            .change(&name, |scene| objects::remove(scene, id))
            .is_some()
        {
            self.selection = None;
        }
    }

    /// Begins to rename what is selected, if it has a name.
    pub fn begin_rename(&mut self) {
        if let (Some(id), Some(scene)) = (self.selection, self.scene())
            && let Some(name) = objects::name(scene, id)
        {
            self.editing.renaming = Some((id, name.to_owned()));
        } else if let Some(id) = self.selection {
            let told = format!(
                "{} has no name of its own: materials, cameras and nodes do",
                self.label(id)
            );
            self.notices.tell(told);
        }
    }

    /// Comes as near as shows all of something; a camera is looked through.
    pub fn frame(&mut self, id: Id) {
        self.selection = Some(id);
        let (width, height) = self.picture_size();
        let aspect = f64::from(width) / f64::from(height.max(1));
        let bounds = self.selection_bounds();
        let (Some(rig), Some(document)) = (&mut self.rig, &self.document) else {
            return;
        };
        if let Id::Camera(index) = id {
            rig.go_to(&camera_in_world(
                document.scene(),
                index,
                self.playback.time,
            ));
        } else if let Some(bounds) = bounds {
            rig.frame(bounds, aspect);
        }
        self.moved();
    }

    /// Makes what the picture is seen by the scene's own camera.
    pub fn keep_camera(&mut self) {
        let Some(camera) = self.camera() else {
            return;
        };
        self.change("use this camera for the scene", |scene| {
            overrides::see_by(scene, &camera);
            Ok(())
        });
        if let (Some(rig), Some(document)) = (&mut self.rig, &self.document) {
            let camera = document.scene().frame(self.playback.time).camera;
            rig.set_home(&camera);
            rig.go_home();
            rig.arrive();
        }
    }
}

/// A camera as the world has it at `time`.
pub fn camera_in_world(scene: &Scene, index: usize, time: f64) -> Camera {
    let mut scene = scene.clone();
    scene.camera_index = index;
    scene.frame(time).camera
}
