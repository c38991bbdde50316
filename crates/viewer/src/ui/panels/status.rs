//! The status bar.

use crate::model::objects::Id;
use crate::model::tool::Tool;
use crate::state::cursor::Surface;
use crate::state::dropping::Dropping;
use crate::ui::context::PanelContext;
use crate::ui::ground;
use crate::ui::panels::jobs;
use crate::ui::panels::picture::loading;
use crate::ui::panels::render::seconds;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui;
use glimray_app::legend::number;

/// Samples, time, speed and noise of the picture, and the frame time of the window.
pub fn status(ui: &mut egui::Ui, context: &mut PanelContext) {
    egui::Panel::bottom("status").show(ui, |ui| {
        ui.horizontal(|ui| {
            jobs::line(ui, context);
            if context.activity().is_some() {
                ui.ctx().request_repaint_after(loading::INTERVAL);
            }
            if let Some(activity) = context.noticeable_activity() {
                let text = loading::heading(context);
                let time = seconds(activity.since.elapsed().as_secs_f64());
                ui.label(format!("{text} · {} · {time}", activity.stage))
                    .on_hover_text("The stage of loading, and the time since it began");
                return;
            }
            let Some(shown) = context.shown(PictureSlot::Main) else {
                ui.label(context.session.waiting_for());
                return;
            };
            let progress = shown.progress;
            let (width, height) = shown.size;
            ui.label(format!("{width}×{height}"))
                .on_hover_text("Width and height of the picture in pixels");
            ui.separator();
            let samples = progress.samples_so_far();
            ui.label(format!("{samples} of {} samples", progress.target))
                .on_hover_text("Samples per pixel so far, and the target");
            tool(ui, context);
            drawn(ui, context);
            dropping(ui, context);
            cursor(ui, context);
            if !context.session.shows_statistics {
                return;
            }
            let left = (context.session.time_left.seconds())
                .map(|left| format!(", {} left", seconds(left)))
                .unwrap_or_default();
            ui.separator();
            ui.label(format!("{}{left}", seconds(progress.trace_seconds)))
                .on_hover_text("Seconds of tracing so far, and until the picture is done");
            ui.separator();
            ui.label(format!("{:.2} M rays/s", progress.rays_per_second / 1e6))
                .on_hover_text("Camera rays per second of tracing, in millions");
            if let Some(noise) = progress.noise {
                ui.separator();
                ui.label(format!("noise {:.2} %", noise * 100.0)).on_hover_text(
                    "Estimated root mean square error as a fraction of white",
                );
            }
            // In a narrow window it would overlap the rest.
            if ui.available_width() < 100.0 {
                return;
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.weak(frame_time(ui.ctx())).on_hover_text(
                    "Mean time between the last frames of the window, which is drawn only when something \
                     changes, in milliseconds",
                );
            });
        });
    });
}

/// The active tool, unless it is the usual one.
fn tool(ui: &mut egui::Ui, context: &PanelContext) {
    let tool = context.session.tool;
    if tool != Tool::default() {
        ui.separator();
        ui.label(tool.entry().title)
            .on_hover_text(tool.entry().description);
    }
}

/// The size of the grid, and whether some edges are left out.
fn drawn(ui: &mut egui::Ui, context: &PanelContext) {
    let session = &*context.session;
    let (overlays, is_shown) = (session.preferences.overlays, session.shows_overlays);
    if let Some(viewport) = session.viewport.filter(|_| overlays.grid && is_shown)
        && let Some(step) = ground::spacing(session, viewport)
    {
        ui.separator();
        ui.label(format!("grid {}", number(step as f32)))
            .on_hover_text("The distance of the lines of the grid, in scene units");
    }
    let seen = session.sight.latest.as_ref();
    if overlays.has_edges() && is_shown && seen.is_some_and(|seen| seen.edges.is_cut) {
        ui.separator();
        ui.label("not all edges").on_hover_text(
            "There are more edges than the window draws. Hide objects or move closer to see the others",
        );
    }
}

/// The material that is dragged, and the object below it.
fn dropping(ui: &mut egui::Ui, context: &PanelContext) {
    let session = &context.session;
    let Some(Dropping { material, over, .. }) = session.editing.dropping else {
        return;
    };
    let material = session.label(Id::Material(material));
    ui.separator();
    ui.label(match over {
        Some(object) => {
            let object = session.label(Id::Object(object));
            format!("Give {material} to {object} · Escape cancels")
        }
        None => format!("Drop {material} on an object · Escape cancels"),
    });
}

/// The pixel under the cursor: its position, its colour and what it shows.
fn cursor(ui: &mut egui::Ui, context: &PanelContext) {
    let cursor = &context.session.cursor;
    let zoom = context.session.pixel_zoom;
    if zoom.is_active() {
        ui.separator();
        ui.label(format!("{:.0} %", zoom.scale() * 100.0))
            .on_hover_text("Pixel zoom of the picture");
    }
    let Some([x, y]) = cursor.pixel else {
        return;
    };
    let mut text = format!("x {x}, y {y}");
    let probe = cursor.current();
    if let Some([red, green, blue]) = probe.and_then(|probe| probe.rgb) {
        text += &format!("  RGB {red} {green} {blue}");
    }
    match probe.map(|probe| &probe.surface) {
        Some(Some(surface)) => {
            let Surface { object, distance } = surface;
            text += &format!("  {object}  distance {}", number(*distance as f32));
        }
        Some(None) => text += "  Background",
        None => {}
    }
    ui.separator();
    ui.add(egui::Label::new(text).truncate()).on_hover_text(
        "The pixel under the cursor, its displayed colour in levels of 255, and the object that the camera \
         ray hits",
    );
}

/// The moving average of consecutive frame times.
fn frame_time(ctx: &egui::Context) -> String {
    /// Longer intervals mean that the window was idle, in seconds.
    const IDLE: f32 = 0.5;
    /// Weight of the newest frame in the average.
    const NEWS: f32 = 0.1;
    let newest = ctx.input(|input| input.unstable_dt);
    let id = egui::Id::unique("frame time");
    let mean = ctx.data(|data| data.get_temp::<f32>(id));
    let mean = match mean {
        Some(mean) if newest > IDLE => mean,
        Some(mean) => mean + NEWS * (newest - mean),
        None => newest,
    };
    ctx.data_mut(|data| data.insert_temp(id, mean));
    format!("{:.0} ms/frame", mean * 1e3)
}
