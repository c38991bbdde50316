//! The surface that a pixel of the picture shows.

use crate::model::tool::Purpose;
use crate::state::answer::Answer;
use crate::worker::progressive_image::FrameRenderer;
use glam::DVec3;
use glimray_app::advice;

/// Finds the nearest surface in a pixel of the picture.
pub fn surface_at(frame: &mut FrameRenderer, pixel: [u32; 2], purpose: Purpose) -> Answer {
    match frame.renderer.explain(pixel, 0..1) {
        Ok(tree) => {
            let first = tree.samples.first().and_then(|sample| sample.rays.first());
            let hit = first.and_then(|ray| ray.hit.as_ref());
            Answer::Picked {
                purpose,
                hit: hit.map(|hit| (DVec3::from(hit.position), hit.object)),
            }
        }
        Err(error) => Answer::Failed(advice::render(&error)),
    }
}
