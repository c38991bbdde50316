//! The state of the ray inspector.

use crate::model::camera::CameraController;
use crate::model::file_dialog::Reply;
use crate::model::objects::Id;
use crate::model::outline;
use glimray_render::{RayTree, TracedRay};
use glimray_scene::Camera;
pub mod ray_labels;
pub mod rows;

use crate::model::bindings::Drag;
use crate::model::viewport::Viewport;
use crate::worker::request::RenderRequest;
use rows::{Filter, RayId, Row};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::mpsc::Receiver;

/// Drawn length of infinite rays, in scene radii.
const ENDLESS: f64 = 0.6;

/// The rays of a pixel and their request.
#[derive(Debug)]
pub struct Inspected {
    /// All rays of all samples.
    pub tree: RayTree,
    /// The request of the picture.
    pub request: RenderRequest,
    /// Whether the pixel was finished; else adaptive sampling may add samples.
    pub is_final: bool,
    /// The number of bounces before each ray, by sample and ray.
    pub bounces: Vec<Vec<u32>>,
    /// The outline's labels of all objects hit.
    pub(crate) labels: BTreeMap<Id, String>,
}

impl Inspected {
    /// Prepares the tree of a picture.
    pub fn new(tree: RayTree, request: RenderRequest, is_final: bool) -> Self {
        let bounces = tree.samples.iter().map(rows::bounces).collect();
        let labels = outline::labels(&request.scene, ray_labels::hit_by(&tree));
        Self {
            tree,
            request,
            is_final,
            bounces,
            labels,
        }
    }

    /// The camera of the picture.
    pub fn camera(&self) -> Camera {
        let own = || {
            self.request
                .scene
                .frame(self.request.shutter_interval.0)
                .camera
        };
        self.request.camera.clone().unwrap_or_else(own)
    }

    /// The label of an object that was hit.
    pub fn label(&self, id: Id) -> &str {
        self.labels.get(&id).map_or("something", String::as_str)
    }

    /// A ray of the tree.
    pub fn ray(&self, (sample, ray): RayId) -> Option<&TracedRay> {
        self.tree.samples.get(sample)?.rays.get(ray)
    }

    /// The maximum number of bounces.
    pub fn max_bounces(&self) -> u32 {
        self.bounces.iter().flatten().copied().max().unwrap_or(0)
    }
}

/// The inspected pixel, its rays, and the filter.
#[derive(Default)]
pub struct Inspector {
    /// The last requested pixel: column and row.
    pub pixel: Option<[u32; 2]>,
    /// The pixel's rays, or the error.
    pub inspected: Option<Inspected>,
    /// The filter of visible rays.
    pub filter: Filter,
    /// Collapsed rays.
    pub folded: BTreeSet<RayId>,
    /// The selected ray.
    pub selected: Option<RayId>,
    /// The ray under the cursor in the last frame.
    pub hovered: Option<RayId>,
    /// The ray under the cursor in this frame.
    pub hovers: Option<RayId>,
    /// Whether the list must scroll to the selection.
    pub scrolls: bool,
    /// Whether the pixel under the cursor is inspected without a click.
    pub follows: bool,
    /// The ray view.
    pub outside: Outside,
    /// The hidden parts of rays in the ray view.
    pub hidden: Hidden,
    /// Number of trees so far.
    pub tree_count: u32,
    /// The export that waits for a file name.
    pub export: Export,
    pub(crate) rows: Option<Vec<Row>>,
    pub(crate) is_asked: bool,
    pub(crate) is_wanted: bool,
}

impl Inspector {
    /// The rows of the list, updated after [`Self::changed`].
    pub fn rows(&mut self) -> &[Row] {
        let Self {
            inspected,
            filter,
            folded,
            selected,
            ..
        } = self;
        self.rows.get_or_insert_with(|| match inspected {
            Some(inspected) => rows::rows(inspected, filter, folded, *selected),
            None => Vec::new(),
        })
    }

    /// Marks the rows as outdated.
    pub fn changed(&mut self) {
        self.rows = None;
    }

    /// Collapses or expands the children of a ray.
    pub fn fold(&mut self, id: RayId) {
        if !self.folded.remove(&id) {
            self.folded.insert(id);
        }
        self.changed();
    }

    /// Collapses everything below the camera rays, or expands everything.
    pub fn fold_all(&mut self, is_folded: bool) {
        self.folded.clear();
        if let Some(inspected) = self.inspected.as_ref().filter(|_| is_folded) {
            for (sample, tree) in inspected.tree.samples.iter().enumerate() {
                let parents = tree.rays.iter().enumerate();
                let parents = parents.filter(|(_, ray)| !ray.children.is_empty());
                self.folded.extend(parents.map(|(ray, _)| (sample, ray)));
            }
        }
        self.changed();
    }

    /// Selects a ray, or deselects it.
    pub fn toggle(&mut self, id: RayId) {
        self.selected = (self.selected != Some(id)).then_some(id);
        self.changed();
    }

    /// Selects a ray and scrolls to it.
    pub fn select(&mut self, id: RayId) {
        let Some(inspected) = &self.inspected else {
            return;
        };
        let mut above = inspected.ray(id).and_then(|ray| ray.parent);
        while let Some(parent) = above {
            self.folded.remove(&(id.0, parent));
            above = (inspected.ray((id.0, parent))).and_then(|ray| ray.parent);
        }
        self.selected = Some(id);
        self.scrolls = true;
        self.changed();
    }

    /// The highlighted ray.
    pub fn highlighted(&self) -> Option<RayId> {
        self.hovered.or(self.selected)
    }

    /// Whether an answer is pending.
    pub fn is_waiting(&self) -> bool {
        self.is_asked
    }
}

/// Number of parts per ray.
pub const PARTS: usize = 24;

/// For each ray, whether each of its parts is hidden, from its start.
pub type Parts = HashMap<RayId, Vec<bool>>;

/// The known result and the pending request.
#[derive(Default)]
pub struct Hidden {
    pub(crate) known: Option<(View, Parts)>,
    pub(crate) asked: Option<View>,
}

/// The inputs of the result.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    pub(crate) request: RenderRequest,
    pub(crate) filter: Filter,
    /// The index of the tree.
    pub(crate) tree: u32,
}

impl Hidden {
    /// Stores an answer; `None` if the view has changed meanwhile.
    pub fn set(&mut self, parts: Option<Parts>) {
        match (self.asked.clone(), parts) {
            (Some(view), Some(parts)) => self.known = Some((view, parts)),
            _ => self.asked = None,
        }
    }
}

/// The ray view.
#[derive(Default)]
pub struct Outside {
    /// The view's camera; `None` before there are rays.
    pub controller: Option<CameraController>,
    /// The viewport; `None` before the view was drawn.
    pub viewport: Option<Viewport>,
    /// Whether the scene is shaded by its normals.
    pub plain: bool,
    /// Whether surface normals are drawn.
    pub normals: bool,
    /// The view's size in pixels in this frame; `None` if it was not drawn.
    pub space: Option<(u32, u32)>,
    /// The view's size in the last frame.
    pub(crate) shown: Option<(u32, u32)>,
    /// The current drag.
    pub drag: Option<Drag>,
}

impl Outside {
    /// The drawn length of infinite rays, in scene units.
    pub fn reach(&self) -> f64 {
        let radius = self
            .controller
            .as_ref()
            .map_or(1.0, CameraController::scene_radius);
        ENDLESS * radius
    }

    /// Advances time. Returns whether the camera moves.
    pub fn advance(&mut self, seconds: f64) -> bool {
        self.shown = self.space.take();
        let Some(controller) = &mut self.controller else {
            return false;
        };
        controller.advance(seconds) || controller.is_moving() || self.drag.is_some()
    }
}

/// An export of the ray tree.
#[derive(Default)]
pub struct Export {
    /// The file dialog, while it is open.
    pub asked: Option<Receiver<Reply>>,
    /// The text to write.
    pub text: String,
}
