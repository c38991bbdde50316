//! What is being edited.

use crate::scene::{Camera, Mesh, Scene};
use crate::viewer::model::file_dialog::Reply;
use crate::viewer::model::handles::Grip;
use crate::viewer::model::listing::Listing;
use crate::viewer::model::modal::Modal;
use crate::viewer::model::objects::Id;
use eframe::egui::{self, Pos2};
use glam::DVec3;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;

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
    /// Things that are selected together.
    pub group: Option<Group>,
    /// The line of the outline that had the focus in the last frame: arrow keys go through the outline
    /// from there.
    pub list_focus: Option<egui::Id>,
    /// The selection that the outline has brought into sight.
    pub seen_selection: Option<Id>,
    /// From where to where the outline is in sight, in points from its beginning.
    pub seen_lines: egui::Rangef,
    /// Asks where a scene is to be saved.
    pub(in crate::viewer) saving: Option<Saving>,
    /// What was written here, and so is not a person's own text.
    pub(in crate::viewer) written: Option<PathBuf>,
    /// The scene that all else was told of.
    pub(in crate::viewer) known: Option<Arc<Scene>>,
    /// The camera that it is seen by.
    pub(in crate::viewer) home: Option<Camera>,
    /// Whether bounds are still to be told.
    pub(in crate::viewer) owes_bounds: bool,
    /// The box of a mesh, which is looked for once.
    pub(in crate::viewer) mesh_box: Option<(Arc<Mesh>, Bounds)>,
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
            group: None,
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

/// A question where to save.
pub struct Saving {
    pub(in crate::viewer) name: String,
    /// What stands in the way of that name.
    pub(in crate::viewer) trouble: Option<String>,
    pub(in crate::viewer) is_new: bool,
    /// What the desktop's dialog will say, while it is open.
    pub(in crate::viewer) asked: Option<Receiver<Reply>>,
}
