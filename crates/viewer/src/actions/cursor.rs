//! Asks the renderer what the pixel under the cursor shows.

use crate::model::objects::Id;
use crate::model::outline;
use crate::state::answer::Answer;
use crate::state::cursor::{Probe, REST, Subject, Surface};
use crate::state::session::Session;
use crate::worker::progressive_image::{FrameRenderer, PictureSlot, Progress};
use glam::DVec3;

/// Asks about the pixel under the cursor, once the cursor rests there and the camera rests too. Asks again
/// when the samples have doubled or the finished picture is developed anew.
pub fn update(session: &mut Session, progress: &Progress) {
    let cursor = &session.cursor;
    let is_at_rest = !session.is_moving() && session.now - cursor.since >= REST;
    let has_samples = !progress.is_coarse && progress.samples > 0;
    let Some(pixel) = cursor.pixel.filter(|_| cursor.is_in_main) else {
        return;
    };
    if !is_at_rest || !has_samples || session.playback.is_playing {
        return;
    }
    let mut requests = session.requests();
    let Some(request) = requests.pictures[PictureSlot::Main as usize].take() else {
        return;
    };
    let [x, y, width, height] = request.settings.region();
    let is_rendered = (x..x + width).contains(&pixel[0]) && (y..y + height).contains(&pixel[1]);
    let stage = match progress.is_done {
        true => (true, progress.frames_shown),
        false => (false, progress.samples.ilog2().into()),
    };
    let subject = Subject {
        pixel,
        request,
        stage,
    };
    if is_rendered && session.cursor.asked.as_ref() != Some(&subject) {
        session.cursor.asked = Some(subject);
        session.ask(move |frame| probe(frame, pixel));
    }
}

fn probe(frame: &mut FrameRenderer, pixel: [u32; 2]) -> Answer {
    // A device that fails is reported where the picture itself fails.
    let rgb = frame.displayed(pixel).unwrap_or(None);
    Answer::Probed(Probe {
        pixel,
        rgb,
        surface: surface(frame, pixel),
    })
}

fn surface(frame: &mut FrameRenderer, pixel: [u32; 2]) -> Option<Surface> {
    let tree = frame.renderer.explain(pixel, 0..1).ok()?;
    let ray = tree.samples.first()?.rays.first()?;
    let hit = ray.hit.as_ref()?;
    let id = hit.object.map(Id::Object);
    let mut names = outline::labels(&frame.request.scene, id);
    Some(Surface {
        object: id.and_then(|id| names.remove(&id)).unwrap_or_default(),
        distance: DVec3::from(hit.position).distance(DVec3::from(ray.origin)),
    })
}
