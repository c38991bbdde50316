//! The pixel whose rays are inspected, and what of them is shown.

use crate::render::{RayTree, TracedRay};
use crate::viewer::model::camera::CameraController;
use crate::viewer::model::file_dialog::Reply;
use crate::viewer::model::objects::Id;
use crate::viewer::model::outline;
pub mod rows;
pub mod words;

use crate::viewer::model::tool::Drag;
use crate::viewer::model::viewport::Viewport;
use crate::viewer::worker::request::RenderRequest;
use rows::{Filter, RayId, Row};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::mpsc::Receiver;

/// Length of a ray that goes on for ever, in radii of the scene.
const ENDLESS: f64 = 0.6;

/// A pixel's rays, and the picture that they are of.
#[derive(Debug)]
pub struct Inspected {
    /// Every ray of every sample.
    pub tree: RayTree,
    /// The picture.
    pub order: RenderRequest,
    /// Whether the pixel had all its samples; else adaptive sampling may add some.
    pub is_final: bool,
    /// How often the light of each ray was mirrored or refracted before: by sample and ray.
    pub bounces: Vec<Vec<u32>>,
    /// What the outline calls all that they met.
    pub(in crate::viewer) labels: BTreeMap<Id, String>,
}

impl Inspected {
    /// The tree of a picture.
    pub fn new(tree: RayTree, order: RenderRequest, is_final: bool) -> Self {
        let bounces = tree.samples.iter().map(rows::bounces).collect();
        let labels = outline::labels(&order.scene, words::met(&tree));
        Self {
            tree,
            order,
            is_final,
            bounces,
            labels,
        }
    }

    /// What something is called that its rays met.
    pub fn label(&self, id: Id) -> &str {
        self.labels.get(&id).map_or("something", String::as_str)
    }

    /// One of its rays.
    pub fn ray(&self, (sample, ray): RayId) -> Option<&TracedRay> {
        self.tree.samples.get(sample)?.rays.get(ray)
    }

    /// The most bounces before a ray.
    pub fn max_bounces(&self) -> u32 {
        self.bounces.iter().flatten().copied().max().unwrap_or(0)
    }
}

/// Which pixel is inspected, its rays, and what of them is shown.
#[derive(Default)]
pub struct Inspector {
    /// The pixel that was asked for last: column and row.
    pub pixel: Option<[u32; 2]>,
    /// What came of it.
    pub inspected: Option<Inspected>,
    /// Which rays are shown.
    pub filter: Filter,
    /// Those whose rays are not.
    pub folded: BTreeSet<RayId>,
    /// The ray that is told about.
    pub selected: Option<RayId>,
    /// The ray under the cursor, in the last frame.
    pub hovered: Option<RayId>,
    /// The same in this frame.
    pub hovers: Option<RayId>,
    /// Whether the list is to be scrolled to the one that is selected.
    pub scrolls: bool,
    /// Whether the pixel under the cursor is inspected without a click.
    pub follows: bool,
    /// The scene from outside.
    pub outside: Outside,
    /// What of the lines there is behind something.
    pub hidden: Hidden,
    /// How many trees there were.
    pub tree_count: u32,
    /// What happens to files that are saved.
    pub saving: Saving,
    pub(in crate::viewer) rows: Option<Vec<Row>>,
    pub(in crate::viewer) is_asked: bool,
    pub(in crate::viewer) is_wanted: bool,
}

impl Inspector {
    /// The lines of the list; made anew after [`Self::changed`].
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

    /// Says that the list has other lines by now.
    pub fn changed(&mut self) {
        self.rows = None;
    }

    /// Hides the rays that a ray sent, or shows them.
    pub fn fold(&mut self, id: RayId) {
        if !self.folded.remove(&id) {
            self.folded.insert(id);
        }
        self.changed();
    }

    /// Hides everything but the samples' first rays, or nothing.
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

    /// Tells about a ray, or no longer if it is told about already.
    pub fn toggle(&mut self, id: RayId) {
        self.selected = (self.selected != Some(id)).then_some(id);
        self.changed();
    }

    /// Tells about a ray and brings it into the list.
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

    /// The ray to be seen before others.
    pub fn highlighted(&self) -> Option<RayId> {
        self.hovered.or(self.selected)
    }

    /// Whether an answer is on its way.
    pub fn is_waiting(&self) -> bool {
        self.is_asked
    }
}

/// Parts that a line has.
pub const PARTS: usize = 24;

/// By line, whether each of its parts is hidden, from its start on.
pub type Parts = HashMap<RayId, Vec<bool>>;

/// What is known, and what was asked.
#[derive(Default)]
pub struct Hidden {
    pub(in crate::viewer) known: Option<(View, Parts)>,
    pub(in crate::viewer) asked: Option<View>,
}

/// What the answer depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    pub(in crate::viewer) order: RenderRequest,
    pub(in crate::viewer) filter: Filter,
    /// Which of the trees that there were.
    pub(in crate::viewer) tree: u32,
}

impl Hidden {
    /// Takes up an answer; `None` if it was not for the picture that it was asked about.
    pub fn take(&mut self, parts: Option<Parts>) {
        match (self.asked.clone(), parts) {
            (Some(view), Some(parts)) => self.known = Some((view, parts)),
            _ => self.asked = None,
        }
    }
}

/// The second camera and its picture.
#[derive(Default)]
pub struct Outside {
    /// The camera; `None` before there were rays to look at.
    pub controller: Option<CameraController>,
    /// Where the picture is; `None` before it was drawn.
    pub viewport: Option<Viewport>,
    /// Whether the scene is shown by its normals only.
    pub plain: bool,
    /// Whether directions of surfaces are drawn.
    pub normals: bool,
    /// Room for it in pixels, in this frame; nothing where it was not drawn.
    pub space: Option<(u32, u32)>,
    /// The same in the last frame.
    pub(in crate::viewer) shown: Option<(u32, u32)>,
    /// What is dragged in it.
    pub drag: Option<Drag>,
}

impl Outside {
    /// How much is drawn of a ray that goes on for ever, in scene units.
    pub fn reach(&self) -> f64 {
        let radius = self
            .controller
            .as_ref()
            .map_or(1.0, CameraController::scene_radius);
        ENDLESS * radius
    }

    /// Lets time go by. Whether the camera moves.
    pub fn advance(&mut self, seconds: f64) -> bool {
        self.shown = self.space.take();
        let Some(controller) = &mut self.controller else {
            return false;
        };
        controller.advance(seconds) || controller.is_moving() || self.drag.is_some()
    }
}

/// A text that waits for a file's name.
#[derive(Default)]
pub struct Saving(pub Option<(Receiver<Reply>, String)>);
