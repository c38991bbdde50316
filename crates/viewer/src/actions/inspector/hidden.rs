//! Finds the hidden parts of rays in the ray view, by tracing visibility rays with its renderer.

use crate::actions::inspector::outside;
use crate::model::camera::project;
use crate::state::answer::Answer;
use crate::state::inspector::PARTS;
use crate::state::inspector::Parts;
use crate::state::inspector::View;
use crate::state::inspector::rows::RayId;
use crate::state::session::Session;
use crate::worker::progressive_image::FrameRenderer;
use crate::worker::request::RenderRequest;
use glam::{DVec3, dvec2};
use glimray_app::advice;

/// Maximum number of rays tested; others are drawn as visible.
const MOST_LINES: usize = 256;
/// Relative depth tolerance: pixels have an extent.
const TOLERANCE: f64 = 5e-3;

fn view(session: &Session) -> Option<View> {
    Some(View {
        request: session.outside_request()?,
        filter: session.inspector.filter,
        tree: session.inspector.tree_count,
    })
}

/// The result for the rays shown now.
pub fn known(session: &Session) -> Option<&Parts> {
    let (known, parts) = session.inspector.hidden.known.as_ref()?;
    (view(session)? == *known).then_some(parts)
}

/// Requests visibility once the ray view is finished, unless that was done.
pub fn ask(session: &mut Session) {
    let view = view(session);
    if view.is_none() || view == session.inspector.hidden.asked {
        return;
    }
    let (Some(view), Some(inspected)) = (view, &session.inspector.inspected) else {
        return;
    };
    let reach = session.inspector.outside.reach();
    let rays = outside::shown(inspected, &view.filter).take(MOST_LINES);
    let lines = rays.map(|(id, ray)| (id, outside::ends(ray, reach)));
    let lines: Vec<_> = lines.collect();
    session.inspector.hidden.asked = Some(view.clone());
    session.ask(move |frame| match parts(frame, &view.request, &lines) {
        Ok(parts) => Answer::Hidden(parts),
        Err(why) => Answer::Failed(why),
    });
}

/// The hidden parts for the requested view; `None` if another view is shown.
fn parts(
    frame: &mut FrameRenderer,
    asked: &RenderRequest,
    lines: &[(RayId, (DVec3, DVec3))],
) -> Result<Option<Parts>, String> {
    let Some((renderer, request)) = &mut frame.outside else {
        return Ok(None);
    };
    let (true, Some(camera)) = (**request == *asked, &request.camera) else {
        return Ok(None);
    };
    let (width, height) = request.settings.size;
    let size = dvec2(width.into(), height.into());
    // Each part: its ray, its index, its pixel and its distance.
    let mut places = Vec::new();
    for (line, (_, (from, to))) in lines.iter().enumerate() {
        for part in 0..PARTS {
            let share = (part as f64 + 0.5) / PARTS as f64;
            let point = from.lerp(*to, share);
            let at = project(camera, point, size)
                .filter(|at| at.cmpge(dvec2(0.0, 0.0)).all() && at.cmplt(size).all());
            if let Some(at) = at {
                let pixel = [at.x as u32, at.y as u32];
                places.push((line, part, pixel, point.distance(camera.look_from)));
            }
        }
    }
    let pixels: Vec<_> = places.iter().map(|(.., pixel, _)| (*pixel, 0..1)).collect();
    let trees = renderer
        .explain_pixels(&pixels)
        .map_err(|error| advice::render(&error))?;
    let mut parts: Parts = (lines.iter())
        .map(|(id, _)| (*id, vec![false; PARTS]))
        .collect();
    for ((line, part, _, distance), tree) in places.iter().zip(trees) {
        let first = tree.samples.first().and_then(|sample| sample.rays.first());
        let hit = first.and_then(|ray| ray.hit.as_ref());
        let is_hidden = hit.is_some_and(|hit| hit.distance < distance * (1.0 - TOLERANCE));
        if let Some(of_line) = parts.get_mut(&lines[*line].0) {
            of_line[*part] = is_hidden;
        }
    }
    Ok(Some(parts))
}
