//! The objects and distances that the pixels of the picture show, and the shapes that are drawn from them.

use crate::model::edges::{EdgeCache, SeenEdges};
use crate::model::grid::Grid;
use crate::model::objects::Id;
use crate::model::sight::Sight;
use crate::model::tool::BoxMode;
use crate::model::viewport::Viewport;
use eframe::egui::{Rect, Shape};
use glam::{DVec2, DVec3};
use glimray_scene::{Camera, Scene};
use std::cell::RefCell;
use std::sync::Arc;

/// The picture that was looked at.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The scene, compared by address.
    pub scene: Arc<Scene>,
    /// The camera in world space.
    pub camera: Camera,
    /// Seconds of the animation.
    pub time: f64,
    /// In pixels.
    pub size: (u32, u32),
    /// Which edges were looked for: all, and features.
    pub edges: (bool, bool),
}

impl Subject {
    /// Whether both have the same view, whatever edges they show.
    pub fn has_view_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && (self.time, self.size) == (other.time, other.size)
            && self.camera == other.camera
    }

    /// Whether everything is in the place where it was in the other one: only materials and the like may have changed.
    pub fn looks_like(&self, other: &Self) -> bool {
        let (a, b) = (&self.scene, &other.scene);
        (self.time, self.size) == (other.time, other.size)
            && self.camera == other.camera
            && (Arc::ptr_eq(a, b)
                || a.section == b.section
                    && a.nodes == b.nodes
                    && a.meshes.len() == b.meshes.len()
                    && a.meshes
                        .iter()
                        .zip(&b.meshes)
                        .all(|(a, b)| Arc::ptr_eq(a, b))
                    && a.instances == b.instances
                    && a.lights.len() == b.lights.len()
                    && (a.lights.iter().zip(&b.lights))
                        .all(|(a, b)| (a.kind, a.node, a.visible) == (b.kind, b.node, b.visible))
                    && a.shapes.len() == b.shapes.len()
                    && (a.shapes.iter().zip(&b.shapes))
                        .all(|(a, b)| (a.geometry, a.node) == (b.geometry, b.node)))
    }
}

/// The answer about a picture.
#[derive(Debug)]
pub struct Seen {
    /// The picture.
    pub subject: Subject,
    /// Objects and distances.
    pub sight: Sight,
    /// The edges that are not hidden; empty unless they were asked for.
    pub edges: SeenEdges,
}

/// The silhouettes of the selection.
#[derive(Debug, Default)]
pub struct Silhouettes {
    /// The silhouettes of the object that was selected last, in pixels of the picture.
    pub lead: Vec<Vec<DVec2>>,
    /// The silhouettes of the other selected objects.
    pub others: Vec<Vec<DVec2>>,
    /// Selected objects without a visible pixel.
    pub hidden: Vec<Id>,
}

/// Shapes that need not be made anew in each frame.
pub(crate) struct Drawn<T> {
    /// The parts of the screen that the picture takes, and that can be seen.
    pub place: [Rect; 2],
    /// The things that the shapes show.
    pub of: T,
    /// The shapes.
    pub shapes: Vec<Shape>,
}

impl<T> Drawn<T> {
    /// The shapes, if they are at this place and show what `is_same` accepts.
    pub fn at(
        known: &Option<Self>,
        place: [Rect; 2],
        is_same: impl Fn(&T) -> bool,
    ) -> Option<Vec<Shape>> {
        let known = known.as_ref()?;
        (known.place == place && is_same(&known.of)).then(|| known.shapes.clone())
    }
}

/// A rectangle of the picture that waits to be applied.
pub struct Boxed {
    /// Opposite corners, in pixels of the picture.
    pub corners: [DVec2; 2],
    /// How the objects in it change the selection.
    pub mode: BoxMode,
    /// The picture in which it was drawn.
    pub subject: Option<Subject>,
}

/// The vertex to which a click snaps, if there is one, and what it depends on.
pub(crate) struct Snapped {
    pub(crate) seen: Arc<Seen>,
    pub(crate) viewport: Viewport,
    pub(crate) pixel: [u32; 2],
    pub(crate) vertex: Option<DVec3>,
}

/// Knowledge about the pixels of the picture.
#[derive(Default)]
pub struct SightState {
    /// The last answer.
    pub latest: Option<Arc<Seen>>,
    /// The picture that was asked about, while the answer is to come and after it failed.
    pub(crate) asked: Option<Subject>,
    /// The edges of meshes that were looked at.
    pub(crate) cache: EdgeCache,
    /// The drawn edges.
    pub(crate) edges: Option<Drawn<Arc<Seen>>>,
    /// The drawn grid.
    pub(crate) grid: Option<Drawn<(Arc<Seen>, Grid)>>,
    /// The drawn silhouettes.
    pub(crate) outlined: Option<Drawn<Arc<Silhouettes>>>,
    /// The rectangle that was drawn last, until it is known what its pixels show.
    pub boxed: Option<Boxed>,
    /// The vertex that was found last for the pixel under the pointer.
    pub(crate) snapped: RefCell<Option<Snapped>>,
    /// The silhouettes of a selection in the last answer.
    pub(crate) silhouettes: Option<(Vec<Id>, Arc<Silhouettes>)>,
}

impl SightState {
    /// Drops what belongs to the previous device.
    pub fn reopened(&mut self) {
        self.asked = None;
    }
}
