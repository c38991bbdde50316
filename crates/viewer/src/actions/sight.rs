//! Asks the render thread what each pixel of the picture shows, as soon as the camera rests and something needs it.

use crate::model::camera::ray_through;
use crate::model::edges;
use crate::model::objects::{self, Id};
use crate::model::sight::Sight;
use crate::model::tool::Tool;
use crate::state::answer::Answer;
use crate::state::session::Session;
use crate::state::sight::{Seen, Silhouettes, Subject};
use crate::worker::progressive_image::{FrameRenderer, Progress};
use glam::DVec2;
use glimray_render::gpu::GpuError;
use glimray_render::{QueryRay, RayQuery, RenderError};
use glimray_scene::{Camera, ObjectRef, Scene};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The most pixels that have an entry each; in larger pictures several share one. Software renderers get fewer.
const MOST: u64 = 1 << 21;
const MOST_ON_CPU: u64 = 1 << 20;

/// The picture as it is now; `None` before there is one.
pub(super) fn subject(session: &Session) -> Option<Subject> {
    let overlays = &session.preferences.overlays;
    let is_shown = session.shows_overlays;
    Some(Subject {
        scene: session.scene()?.clone(),
        camera: session.camera()?,
        time: session.playback.time,
        size: session.picture_size(),
        edges: (
            overlays.wireframe && is_shown,
            overlays.features && is_shown,
        ),
    })
}

/// Whether something is drawn or chosen by what the pixels show.
fn is_wanted(session: &Session) -> bool {
    let overlays = &session.preferences.overlays;
    let is_drawn = overlays.grid || overlays.has_edges();
    let is_outlined = overlays.outline && session.selection.is_some();
    session.viewport.is_some()
        && (session.tool_state.frame.is_some()
            || session.sight.boxed.is_some()
            || matches!(session.tool, Tool::Box | Tool::Measure)
            || session.shows_overlays && (is_drawn || is_outlined))
}

/// Asks about the picture unless that was done. Previews are not asked about.
pub fn update(session: &mut Session, progress: &Progress) {
    let is_at_rest = !session.is_moving() && !session.playback.is_playing;
    if !is_at_rest || progress.is_coarse || !is_wanted(session) {
        return;
    }
    let Some(subject) = subject(session) else {
        return;
    };
    let is_same = |known: &Subject| known.has_view_of(&subject) && known.edges == subject.edges;
    let state = &session.sight;
    let is_known = state.latest.as_ref().is_some_and(|it| is_same(&it.subject));
    if is_known || state.asked.as_ref().is_some_and(is_same) {
        return;
    }
    session.sight.asked = Some(subject.clone());
    let cache = session.sight.cache.clone();
    session.ask(move |frame| match look(frame, subject, &cache) {
        Ok(seen) => Answer::Seen(seen),
        // The picture itself reports a lost device. After all failures this picture is not asked about again.
        Err(RenderError::Gpu(GpuError::Lost)) => Answer::Nothing,
        Err(error) => Answer::Failed(format!("cannot draw outlines, edges and the grid: {error}")),
    });
}

/// Takes an answer; `None` if the picture was another one by then.
pub fn take(session: &mut Session, seen: Option<Box<Seen>>) {
    session.sight.asked = None;
    if let Some(seen) = seen {
        session.sight.latest = Some(Arc::from(seen));
        session.sight.silhouettes = None;
        session.sight.snapped.take();
    }
}

/// The objects and distances of the pixels, if they are known for the picture as it is now.
pub fn current(session: &Session) -> Option<Arc<Seen>> {
    let seen = session.sight.latest.as_ref()?;
    let is_current = !session.editing.is_held() && seen.subject.looks_like(&subject(session)?);
    is_current.then(|| seen.clone())
}

fn look(
    frame: &mut FrameRenderer,
    subject: Subject,
    cache: &edges::EdgeCache,
) -> Result<Option<Box<Seen>>, RenderError> {
    let request = frame.request;
    let is_same = Arc::ptr_eq(&request.scene, &subject.scene)
        && request.settings.size == subject.size
        && (request.camera.as_ref()).is_none_or(|camera| *camera == subject.camera);
    if !is_same {
        return Ok(None);
    }
    let sight = sight(frame, &subject)?;
    let edges = edges::seen(
        &subject.scene,
        &subject.camera,
        subject.time,
        (&sight, subject.size),
        subject.edges,
        cache,
    );
    Ok(Some(Box::new(Seen {
        subject,
        sight,
        edges,
    })))
}

fn sight(frame: &FrameRenderer, subject: &Subject) -> Result<Sight, RenderError> {
    let (width, height) = subject.size;
    let most = match frame.renderer.gpu().is_cpu() {
        true => MOST_ON_CPU,
        false => MOST,
    };
    let pixels = u64::from(width) * u64::from(height);
    let step = (1..)
        .find(|step| pixels / (step * step) <= most)
        .unwrap_or(1) as u32;
    let size = DVec2::new(width.into(), height.into());
    let rays = Sight::places(subject.size, step).map(|at| ray(&subject.camera, at, size));
    let (rays, starts): (Vec<_>, Vec<_>) = rays.unzip();
    let query = RayQuery::beside(frame.renderer)?;
    let hits = query.closest_hits(&rays)?.into_iter().zip(starts);
    let seen = hits.map(|(hit, start)| match hit {
        Some(hit) => (query.object_of(&hit), hit.t + start),
        None => (None, Sight::NOTHING),
    });
    Ok(Sight::new(subject.size, step, seen))
}

/// The ray through a position of the picture between the planes of the camera, and how far along it begins.
fn ray(camera: &Camera, at: DVec2, size: DVec2) -> (QueryRay, f32) {
    let (origin, direction) = ray_through(camera, at, size);
    let forward = (camera.look_at - camera.look_from).normalize_or(direction);
    let (near, far) = camera.clip;
    let slope = direction.dot(forward);
    let (near, far) = (near / slope, far / slope);
    let ray = QueryRay {
        t_max: ((far - near) as f32).min(QueryRay::FAR),
        ..QueryRay::new(origin + direction * near, direction.as_vec3())
    };
    (ray, near as f32)
}

/// The silhouettes of what is selected; `None` while it is not known what the pixels show.
pub fn silhouettes(session: &mut Session, selected: &[Id]) -> Option<Arc<Silhouettes>> {
    let seen = current(session)?;
    if let Some((known, silhouettes)) = &session.sight.silhouettes
        && known == selected
    {
        return Some(silhouettes.clone());
    }
    let scene = session.scene()?;
    let (lead, others) = selected.split_at(selected.len().min(1));
    let leads = members(scene, lead);
    let members: BTreeSet<_> = (members(scene, others).difference(&leads).copied()).collect();
    let visible: BTreeSet<_> = seen.sight.objects().into_iter().collect();
    let is_hidden = |id: &Id| matches!(id, Id::Object(object) if !visible.contains(object));
    let silhouettes = Arc::new(Silhouettes {
        lead: seen.sight.silhouettes(|object| leads.contains(&object)),
        others: match members.is_empty() {
            true => Vec::new(),
            false => seen.sight.silhouettes(|object| members.contains(&object)),
        },
        hidden: selected.iter().copied().filter(is_hidden).collect(),
    });
    session.sight.silhouettes = Some((selected.to_vec(), silhouettes.clone()));
    Some(silhouettes)
}

/// The objects of a selection, and those below its nodes.
fn members(scene: &Scene, ids: &[Id]) -> BTreeSet<ObjectRef> {
    let mut members = BTreeSet::new();
    let mut nodes = BTreeSet::new();
    for id in ids {
        match id {
            Id::Object(object) => members.extend([*object]),
            Id::Node(node) => nodes.extend([*node]),
            Id::Camera(_) | Id::Material(_) => {}
        }
    }
    if !nodes.is_empty() {
        let instances = (0..scene.instances.len()).map(ObjectRef::Instance);
        let shapes = (0..scene.shapes.len()).map(ObjectRef::Shape);
        let lights = (0..scene.lights.len()).map(ObjectRef::Light);
        members.extend(instances.chain(shapes).chain(lights).filter(|object| {
            let carrier = objects::carrier(scene, Id::Object(*object));
            let mut above = std::iter::successors(carrier, |node| scene.nodes[*node].parent);
            above.any(|node| nodes.contains(&node))
        }));
    }
    members
}
