//! The ray inspector: requests the rays of a pixel and shows them.

pub mod export;
pub mod hidden;
pub mod outside;

use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::answer::Answer;
use crate::state::inspector::{Hidden, Inspected};
use crate::state::layout::Layout;
use crate::state::session::Session;
use crate::worker::progressive_image::{FrameRenderer, PictureSlot};
use crate::worker::request::RenderRequest;
use eframe::egui;
use glimray_app::advice;
use glimray_render::Integrator;

/// Minimum width of a readable ray tree, in points.
const READABLE: f32 = 420.0;

/// Activates the inspector and shows its panels.
pub fn open(session: &mut Session, layout: &mut Layout) {
    session.tool = Tool::Inspect;
    layout.show_rays(READABLE);
}

/// Repeats the request of a lost renderer.
pub fn reopened(session: &mut Session) {
    let inspector = &mut session.inspector;
    inspector.is_wanted |= std::mem::take(&mut inspector.is_asked);
    inspector.hidden = Hidden::default();
    ask(session);
}

/// Requests the rays of a pixel. Only the last of several pending requests is answered.
pub fn inspect(session: &mut Session, pixel: [u32; 2]) {
    session.inspector.pixel = Some(pixel);
    session.inspector.is_wanted = true;
    ask(session);
}

fn ask(session: &mut Session) {
    let inspector = &mut session.inspector;
    if let (Some(pixel), true, false) = (inspector.pixel, inspector.is_wanted, inspector.is_asked) {
        (inspector.is_wanted, inspector.is_asked) = (false, true);
        session.ask(move |frame| Answer::Rays(rays(frame, pixel).map(Box::new)));
    }
}

/// All rays of a pixel of the main picture.
fn rays(frame: &mut FrameRenderer, pixel: [u32; 2]) -> Result<Inspected, String> {
    let count = frame.renderer.samples_at(pixel);
    if count == 0 {
        let [x, y] = pixel;
        return Err(format!(
            "No rays for pixel {x},{y}: it is outside the picture or has no sample yet."
        ));
    }
    let tree = frame.renderer.explain(pixel, 0..count);
    let is_final = !frame.settings().is_adaptive() || frame.renderer.is_done();
    let tree = tree.map_err(|error| advice::render(&error))?;
    Ok(Inspected::new(tree, frame.request.clone(), is_final))
}

/// Handles the answer of the render thread.
pub fn handle_rays(session: &mut Session, outcome: Result<Box<Inspected>, String>) {
    let bounds = session.bounds();
    let inspector = &mut session.inspector;
    // Answers for a scene that is gone are dropped.
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
        Err(why) => session.messages.warn(why),
    }
    ask(session);
}

/// Called every frame.
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

/// Inspects the pixel under the cursor if that is enabled.
pub fn inspect_hovered(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    if session.tool != Tool::Inspect || !session.inspector.follows || session.drag.is_some() {
        return;
    }
    let pixel = (response.hover_pos()).and_then(|point| viewport.pixel(point));
    if pixel.is_some_and(|pixel| session.inspector.pixel != Some(pixel)) {
        pixel.into_iter().for_each(|pixel| inspect(session, pixel));
    }
}

/// Whether the picture has changed since the rays were traced.
pub fn is_stale(session: &Session) -> bool {
    let inspected = session.inspector.inspected.as_ref();
    let requests = session.requests();
    let now = requests.pictures[PictureSlot::Main as usize].as_ref();
    match (inspected, now) {
        (Some(inspected), Some(now)) => {
            // Debug views show the surfaces of the classical tree.
            let settings = |request: &RenderRequest| glimray_render::RenderSettings {
                integrator: match request.settings.integrator {
                    Integrator::Path => Integrator::Path,
                    _ => Integrator::Whitted,
                },
                ..request.settings.clone()
            };
            !inspected.request.shows_same(now) || settings(&inspected.request) != settings(now)
        }
        _ => false,
    }
}
