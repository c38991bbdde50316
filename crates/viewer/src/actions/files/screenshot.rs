//! Saves the picture with its overlays: a screenshot of the window, cropped to the picture.

use crate::actions::files::pictures;
use crate::state::session::Session;
use crate::worker::still::Still;
use eframe::egui::{self, ColorImage, Rect};
use glimray_scene::image::Image;
use std::sync::mpsc::{TryRecvError, channel};

/// Requests the screenshot and handles its result.
pub(super) fn update(session: &mut Session, ctx: &egui::Context) {
    let Some(mut pose) = session.files.pending.pose.take() else {
        return;
    };
    let Some(screenshot) = &pose.screenshot else {
        pose.frames = pose.frames.saturating_sub(1);
        if pose.frames == 0 {
            let (sender, receiver) = channel();
            let waker = ctx.clone();
            ctx.request_screenshot(move |image| {
                // The window may have been closed meanwhile.
                let _ = sender.send(image);
                waker.request_repaint();
            });
            pose.screenshot = Some(receiver);
        }
        ctx.request_repaint();
        session.files.pending.pose = Some(pose);
        return;
    };
    match screenshot.try_recv() {
        Ok(image) => {
            let Some(view) = session.viewport else {
                let why = "the picture is hidden. Show its panel and save again.";
                session.messages.warn(why.to_owned());
                return;
            };
            let image = cut(&image, view.rect, ctx.pixels_per_point());
            let still = Still { image, raw: None };
            let job = (session.files.jobs).begin(pose.target.path.clone(), false);
            pictures::write(session, still, pose.target, job.sender, String::new());
        }
        Err(TryRecvError::Empty) => session.files.pending.pose = Some(pose),
        Err(TryRecvError::Disconnected) => {
            let why = "screenshots are not supported here. Save the picture without overlays.";
            session.messages.warn(why.to_owned());
        }
    }
}

/// Crops the window to `rect`, which is in points.
fn cut(window: &ColorImage, rect: Rect, pixels_per_point: f32) -> Image {
    let [width, height] = window.size;
    let at = |length: f32, most: usize| {
        ((length * pixels_per_point).round().max(0.0) as usize).min(most)
    };
    let (x0, x1) = (at(rect.min.x, width), at(rect.max.x, width));
    let (y0, y1) = (at(rect.min.y, height), at(rect.max.y, height));
    let rows = (y0..y1).map(|y| &window.pixels[y * width + x0..y * width + x1]);
    let level = |code: u8| f32::from(code) / 255.0;
    let pixels = rows.flatten().map(|color| {
        let [r, g, b, _] = color.to_array();
        [level(r), level(g), level(b), 1.0]
    });
    Image {
        pixels: pixels.collect(),
        width: (x1 - x0) as u32,
        height: (y1 - y0) as u32,
    }
}
