//! The rays of a pixel, made visible: which pixel it is, what it is made of, and what of it is shown.

pub mod export;
pub mod hidden;
pub mod outside;
pub mod rows;
pub mod words;

use super::bindings::Action;
use super::canvas::{Place, Studio};
use super::layout::{Layout, Panel};
use super::objects::Id;
use super::order::Order;
use super::outline;
use super::question::Answer;
use super::session::Session;
use super::tools::Tool;
use super::viewport::Viewport;
use crate::app::advice;
use crate::render::{Integrator, RayTree, TracedRay};
use eframe::egui;
use outside::Outside;
use rows::{Filter, RayId, Row};
use std::collections::{BTreeMap, BTreeSet};

/// A pixel's rays, and the picture that they are of.
#[derive(Debug)]
pub struct Inspected {
    /// Every ray of every sample.
    pub tree: RayTree,
    /// The picture.
    pub order: Order,
    /// Whether the pixel had all its samples; else adaptive sampling may add some.
    pub is_final: bool,
    /// How often the light of each ray was mirrored or refracted before: by sample and ray.
    pub bounces: Vec<Vec<u32>>,
    /// What the outline calls all that they met.
    labels: BTreeMap<Id, String>,
}

impl Inspected {
    /// The tree of a picture.
    pub fn new(tree: RayTree, order: Order, is_final: bool) -> Self {
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
    pub hidden: hidden::Hidden,
    /// How many trees there were.
    pub tree_count: u32,
    /// What happens to files that are saved.
    pub saving: export::Saving,
    rows: Option<Vec<Row>>,
    is_asked: bool,
    is_wanted: bool,
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

/// Takes the inspector's tool and shows its panels. Whether the command is that.
pub fn perform(action: Action, session: &mut Session, layout: &mut Layout) -> bool {
    if action != Action::InspectRays {
        return false;
    }
    session.tool = Tool::Inspect;
    layout.set_visible(Panel::Rays, true);
    layout.set_visible(Panel::Outside, true);
    true
}

/// Asks again what another renderer was asked, which is gone.
pub fn begin(session: &mut Session) {
    let inspector = &mut session.inspector;
    inspector.is_wanted |= std::mem::take(&mut inspector.is_asked);
    inspector.hidden = hidden::Hidden::default();
    ask(session);
}

/// Asks for the rays of a pixel of the picture. Of several that are asked for before there is an answer,
/// only the last is.
pub fn inspect(session: &mut Session, pixel: [u32; 2]) {
    session.inspector.pixel = Some(pixel);
    session.inspector.is_wanted = true;
    ask(session);
}

fn ask(session: &mut Session) {
    let inspector = &mut session.inspector;
    if let (Some(pixel), true, false) = (inspector.pixel, inspector.is_wanted, inspector.is_asked) {
        (inspector.is_wanted, inspector.is_asked) = (false, true);
        session.ask(move |studio| Answer::Rays(rays(studio, pixel).map(Box::new)));
    }
}

/// All rays of a pixel of the main picture.
fn rays(studio: &mut Studio, pixel: [u32; 2]) -> Result<Inspected, String> {
    let count = studio.renderer.samples_at(pixel);
    if count == 0 {
        let [x, y] = pixel;
        return Err(format!(
            "no rays for pixel {x},{y}: it is not in the picture, or has no sample yet."
        ));
    }
    let tree = studio.renderer.explain(pixel, 0..count);
    let is_final = !studio.settings().is_adaptive() || studio.renderer.is_done();
    let tree = tree.map_err(|error| advice::render(&error))?;
    Ok(Inspected::new(tree, studio.order.clone(), is_final))
}

/// Takes up what the render thread answered.
pub fn take(session: &mut Session, outcome: Result<Box<Inspected>, String>) {
    let bounds = session.bounds();
    let inspector = &mut session.inspector;
    // What was asked of a scene that is gone by now is not wanted any more.
    if !std::mem::take(&mut inspector.is_asked) {
        return;
    }
    match outcome {
        Ok(inspected) => {
            inspector.pixel.get_or_insert(inspected.tree.pixel);
            let last = inspected.tree.samples.len().saturating_sub(1);
            inspector.filter.sample = inspector.filter.sample.map(|sample| sample.min(last));
            inspector.folded.clear();
            inspector.selected = None;
            inspector.inspected = Some(*inspected);
            inspector.tree_count += 1;
            inspector.changed();
            outside::look_at(session, bounds);
        }
        Err(why) => session.notices.warn(why),
    }
    ask(session);
}

/// What happened since the last frame.
pub fn update(session: &mut Session, ctx: &egui::Context, seconds: f64) {
    export::update(session);
    let inspector = &mut session.inspector;
    let hovers = inspector.hovers.take();
    if inspector.hovered != hovers {
        inspector.hovered = hovers;
        ctx.request_repaint();
    }
    if inspector.outside.advance(seconds) {
        session.moved();
    }
}

/// Inspects the pixel under the cursor, where that is asked for.
pub fn follow(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    if session.tool != Tool::Inspect || !session.inspector.follows || session.drag.is_some() {
        return;
    }
    let pixel = (response.hover_pos()).and_then(|point| viewport.pixel(point));
    if pixel.is_some_and(|pixel| session.inspector.pixel != Some(pixel)) {
        pixel.into_iter().for_each(|pixel| inspect(session, pixel));
    }
}

/// Whether the picture is not the one any more whose rays there are.
pub fn is_stale(session: &Session) -> bool {
    let inspected = session.inspector.inspected.as_ref();
    let orders = session.orders();
    let now = orders.pictures[Place::Main as usize].as_ref();
    match (inspected, now) {
        (Some(inspected), Some(now)) => {
            // Debug views show the same surfaces.
            let settings = |order: &Order| crate::render::RenderSettings {
                integrator: Integrator::Whitted,
                ..order.settings.clone()
            };
            !inspected.order.shows_same(now) || settings(&inspected.order) != settings(now)
        }
        _ => false,
    }
}
