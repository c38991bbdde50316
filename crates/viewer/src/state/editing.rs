//! The state of editing.

use crate::model::file_dialog::Reply;
use crate::model::handles::Grip;
use crate::model::handles::lamp::LampGrip;
use crate::model::listing::Listing;
use crate::model::modal::Modal;
use crate::model::objects::{self, Id};
use crate::state::dropping::Dropping;
use eframe::egui::{self, Pos2};
use glam::DVec3;
use glimray_render::Integrator;
use glimray_scene::{Background, Camera, Mesh, Scene};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

/// The state of edits and of the outline.
pub struct Editing {
    /// The rows of the outline.
    pub listing: Listing,
    /// The dragged handle and the last pointer position.
    pub grip: Option<(Grip, Pos2)>,
    /// The dragged handle of a lamp and the last pointer position.
    pub lamp: Option<(LampGrip, Pos2)>,
    /// The lamp that waits for the surface at which it is to aim, and the scene in which it was dropped.
    pub(crate) aimed: Option<(usize, Arc<Scene>)>,
    /// The dragged handle of the section plane and the last pointer position.
    pub section: Option<(Grip, Pos2)>,
    /// A modal transform, which holds the grip.
    pub modal: Option<Modal>,
    /// Where on the screen the menu of what can be added is.
    pub adding_at: Pos2,
    /// The item being renamed and its edited name.
    pub renaming: Option<(Id, String)>,
    /// Multiple selection.
    pub group: Option<Group>,
    /// The outline row that had the focus in the last frame, from which arrow keys move.
    pub list_focus: Option<egui::Id>,
    /// The last selection that the outline has scrolled to.
    pub scrolled_to: Option<Id>,
    /// The visible range of the outline, in points from its start.
    pub visible_range: egui::Rangef,
    /// A material that is dragged.
    pub dropping: Option<Dropping>,
    /// The dialog that asks where to save the scene.
    pub(crate) saving: Option<Saving>,
    /// The file saved from this window, which may be replaced without asking.
    pub(crate) written: Option<PathBuf>,
    /// The last scene that dependents were updated for.
    pub(crate) known: Option<Arc<Scene>>,
    /// The scene's camera in world space.
    pub(crate) home: Option<Camera>,
    /// Whether bounds must still be updated.
    pub(crate) owes_bounds: bool,
    /// The subject of the last check for light: the scene, the integrator, and the background of the view.
    pub(crate) lit: Option<(Arc<Scene>, Integrator, Option<Background>)>,
    /// The warning that the scene has no light, while it applies.
    pub(crate) darkness: Option<&'static str>,
    /// Cached bounds of what can be seen.
    pub(crate) subject: Option<(Arc<Scene>, Bounds)>,
    /// Cached bounds of a mesh.
    pub(crate) mesh_box: Option<(Arc<Mesh>, Bounds)>,
}

/// Minimum and maximum corner of a box; `None` without bounds.
pub type Bounds = Option<(DVec3, DVec3)>;

impl Editing {
    /// Whether a handle is being dragged.
    pub fn is_held(&self) -> bool {
        self.grip.is_some() || self.lamp.is_some() || self.section.is_some()
    }
}

impl Default for Editing {
    fn default() -> Self {
        Self {
            listing: Listing::default(),
            grip: None,
            lamp: None,
            aimed: None,
            section: None,
            modal: None,
            adding_at: Pos2::ZERO,
            renaming: None,
            group: None,
            list_focus: None,
            scrolled_to: None,
            visible_range: egui::Rangef::EVERYTHING,
            dropping: None,
            saving: None,
            written: None,
            known: None,
            home: None,
            owes_bounds: false,
            lit: None,
            darkness: None,
            subject: None,
            mesh_box: None,
        }
    }
}

impl Editing {
    /// Whether the save dialog is open.
    pub fn is_asking(&self) -> bool {
        self.saving.is_some()
    }

    /// Called when the scene's file is no longer one that was saved from this window.
    pub fn forget_written(&mut self) {
        self.written = None;
    }

    /// Bounds of the visible geometry, in world space. While a handle of the section plane is dragged they stay the same.
    pub fn subject_of(&mut self, scene: &Arc<Scene>) -> Bounds {
        match &self.subject {
            Some((known, bounds)) if Arc::ptr_eq(known, scene) || self.section.is_some() => *bounds,
            _ => {
                let bounds = objects::subject(scene);
                self.subject = Some((scene.clone(), bounds));
                bounds
            }
        }
    }

    /// Bounds of a mesh in its own space.
    pub fn bounds_of(&mut self, mesh: &Arc<Mesh>) -> Option<(DVec3, DVec3)> {
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

/// Several things that are selected together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The one that [`Session::selection`](super::session::Session::selection) names. The group counts
    /// only as long as that is still selected.
    pub lead: Id,
    /// Where a range of lines begins.
    pub anchor: Id,
    /// All of them, the lead included.
    pub members: Vec<Id>,
}

/// The dialog that asks where to save the scene.
pub struct Saving {
    pub(crate) name: String,
    /// Why the name is invalid.
    pub(crate) trouble: Option<String>,
    pub(crate) is_new: bool,
    /// The pending reply of the desktop's dialog.
    pub(crate) asked: Option<Receiver<Reply>>,
}
