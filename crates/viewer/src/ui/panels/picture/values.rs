//! The values of pixels, written into them where they are magnified enough.

use crate::actions::pixel_values;
use crate::model::viewport::Viewport;
use crate::ui::context::PanelContext;
use crate::worker::progressive_image::Shown;
use eframe::egui::{Align2, Color32, FontId, Painter, Rect};

/// The least width of a pixel that has room for three lines, in points.
const LEAST: f32 = 48.0;

/// Largest height of a line, in points.
const LINE: f32 = 14.0;

/// Writes red, green and blue into the visible pixels, in levels of 255 as they are displayed.
pub fn values(painter: &Painter, context: &mut PanelContext, shown: &Shown, viewport: Viewport) {
    let session = &mut *context.session;
    let side = viewport.rect.width() / viewport.size.0 as f32;
    if side < LEAST {
        session.pixel_values.latest = None;
        return;
    }
    if pixel_values::ask(session, &shown.progress) {
        painter.ctx().request_repaint();
    }
    let Some(read) = &session.pixel_values.latest else {
        return;
    };
    let font = FontId::monospace((side / 4.5).min(LINE));
    for [x, y] in visible(painter.clip_rect(), viewport) {
        if let Some(rgb) = read.rgb([x, y]) {
            let [red, green, blue] = rgb;
            let text = format!("{red}\n{green}\n{blue}");
            let center = viewport.part([x, y, 1, 1]).center();
            painter.text(
                center,
                Align2::CENTER_CENTER,
                text,
                font.clone(),
                legible(rgb),
            );
        }
    }
}

/// The pixels that are visible in `space`.
fn visible(space: Rect, viewport: Viewport) -> impl Iterator<Item = [u32; 2]> {
    let (least, most) = (viewport.position(space.min), viewport.position(space.max));
    let range = |least: f64, most: f64, size: u32| {
        let end = (most.ceil().max(0.0) as u32).min(size);
        (least.floor().max(0.0) as u32)..end
    };
    let rows = range(least.y, most.y, viewport.size.1);
    let columns = range(least.x, most.x, viewport.size.0);
    rows.flat_map(move |y| columns.clone().map(move |x| [x, y]))
}

/// Black or white, whichever is read better on a colour.
fn legible([red, green, blue]: [u8; 3]) -> Color32 {
    // The levels are encoded, about as the eye sees them.
    let [red, green, blue] = [red, green, blue].map(f32::from);
    match 0.299 * red + 0.587 * green + 0.114 * blue > 127.0 {
        true => Color32::BLACK,
        false => Color32::WHITE,
    }
}
