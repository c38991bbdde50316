//! The stage of a scene that is being loaded, over the picture.

use crate::actions::files;
use crate::ui::context::PanelContext;
use crate::ui::panels::render::seconds;
use crate::worker::stage::Stage;
use eframe::egui::{self, Align2, Color32, Rect, Sense, Vec2};
use std::f32::consts::TAU;
use std::time::Duration;

/// Interval of updates while something is loading. On software, each frame of the window delays the loading.
pub const INTERVAL: Duration = Duration::from_millis(100);

/// Width of the text, in points.
const WIDTH: f32 = 280.0;
/// Dots of the spinner, and their turns per second.
const DOTS: u32 = 8;
const TURNS: f32 = 0.8;

/// The heading: "Loading scene.toml", or "Preparing scene.toml" once it is imported.
pub fn heading(context: &PanelContext) -> String {
    match &context.session.loader {
        Some(loader) => format!("Loading {}", files::short(&loader.path)),
        None => format!("Preparing {}", context.session.title()),
    }
}

/// Draws the stage, the elapsed time and the button that cancels loading. Over a picture this is only drawn while another scene
/// is loaded: the status bar tells the rest.
pub fn loading(ui: &egui::Ui, context: &mut PanelContext, space: Rect) {
    let is_covered = context.session.loader.is_none() && context.has_picture();
    let Some(activity) = context.noticeable_activity().filter(|_| !is_covered) else {
        return;
    };
    if context.session.files.is_posing() {
        return;
    }
    let elapsed = activity.since.elapsed().as_secs_f32();
    egui::Area::new(egui::Id::unique("loading"))
        .pivot(Align2::CENTER_CENTER)
        .fixed_pos(space.center())
        .constrain_to(space)
        // Without a button, the mouse belongs to the picture below.
        .interactable(context.session.loader.is_some())
        .show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_width(WIDTH.min(space.width() - 32.0).max(0.0));
                ui.horizontal(|ui| {
                    spinner(ui, elapsed);
                    ui.add(egui::Label::new(heading(context)).truncate());
                });
                ui.add(egui::Label::new(activity.stage.to_string()).truncate());
                if let Stage::FirstSamples { share } = activity.stage {
                    ui.add(egui::ProgressBar::new(share as f32).desired_height(6.0));
                }
                ui.horizontal(|ui| {
                    ui.weak(seconds(elapsed.into()));
                    if context.session.loader.is_some() {
                        let right = egui::Layout::right_to_left(egui::Align::Center);
                        ui.with_layout(right, |ui| cancel(ui, context));
                    }
                });
            });
        });
}

fn cancel(ui: &mut egui::Ui, context: &mut PanelContext) {
    let button = ui.button("Cancel loading");
    let tip = match context.session.scene() {
        Some(_) => "Keep the current scene",
        None => "Open no scene",
    };
    if button.on_hover_text(tip).clicked() {
        files::cancel_loading(context.session);
    }
}

/// A ring of dots that turns. egui's own spinner repaints the window without a pause.
fn spinner(ui: &mut egui::Ui, elapsed: f32) {
    let (rect, _) = ui.allocate_exact_size(Vec2::splat(16.0), Sense::hover());
    let head = (elapsed * TURNS).fract();
    for dot in 0..DOTS {
        let place = dot as f32 / DOTS as f32;
        let strength = 1.0 - (head - place).rem_euclid(1.0);
        let color: Color32 = ui
            .visuals()
            .text_color()
            .gamma_multiply(0.15 + 0.85 * strength);
        let center = rect.center() + 6.0 * Vec2::angled(place * TAU);
        ui.painter().circle_filled(center, 1.5, color);
    }
}
