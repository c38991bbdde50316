//! The time panel: playback, timeline, frame rate and shutter.

use crate::model::bindings::Action;
use crate::model::playback::{MAX_SPEED, Playback};
use crate::state::files::Part;
use crate::ui::context::PanelContext;
use crate::ui::panels::parts;
use crate::ui::panels::setting_rows::number;
use crate::ui::panels::sign::{self, Sign};
use eframe::egui::{self, Ui, vec2};
use glimray_scene::Shutter;

/// Maximum shutter time, and maximum distance from the frame's time, in frames.
const MAX_SHUTTER: f64 = 16.0;

/// Draws the timeline and its controls.
pub fn time(ui: &mut Ui, context: &mut PanelContext) {
    let bindings = &context.session.preferences.bindings;
    let keys = |action: Action| bindings.tip(action.description(), action);
    let tips = [
        Action::FirstFrame,
        Action::StepBack,
        Action::PlayPause,
        Action::StepForward,
        Action::LastFrame,
        Action::ToggleLoop,
        Action::ToggleMotionBlur,
    ]
    .map(keys);
    let before = context.session.playback.clone();
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        egui::Frame::NONE.inner_margin(6.0).show(ui, |ui| {
            parts::part(ui, context.session, Part::Clip);
            let playback = &mut context.session.playback;
            let is_animated = playback.duration() > 0.0;
            ui.add_enabled_ui(is_animated, |ui| {
                timeline(ui, playback);
                ui.horizontal_wrapped(|ui| controls(ui, playback, &tips));
            });
            if !is_animated {
                ui.weak("No animation");
            }
        });
    });
    let now = &context.session.playback;
    if (now.time, now.shutter_interval()) != (before.time, before.shutter_interval()) {
        context.session.moved();
    }
}

/// The timeline of all frames, at full width.
fn timeline(ui: &mut Ui, playback: &mut Playback) {
    let last = playback.last_frame();
    let mut frame = playback.frame();
    let text = format!(
        "frame {frame} of {last}   {:.2} s of {:.2} s",
        playback.time,
        playback.duration()
    );
    ui.horizontal(|ui| {
        let tip = "Current frame: drag, or enter a number";
        let response = number(ui, &mut frame, 0..=last, 0.2, "");
        name(&response, f64::from(frame), "Frame");
        response.on_hover_text(tip);
        let room = ui.available_width() - 210.0;
        ui.spacing_mut().slider_width = room.max(80.0);
        let slider = egui::Slider::new(&mut frame, 0..=last.max(1)).show_value(false);
        let response = ui.add(slider);
        let value = f64::from(frame);
        response.widget_info(|| egui::WidgetInfo::slider(ui.is_enabled(), value, "Timeline"));
        response.on_hover_text(tip);
        ui.label(text);
    });
    if frame != playback.frame() {
        playback.is_playing = false;
        playback.go_to(frame.min(last));
    }
}

fn controls(ui: &mut Ui, playback: &mut Playback, tips: &[String; 7]) {
    let [first, back, play, forward, last, repeat, blur] = tips;
    if button(ui, Sign::First, "First frame", first) {
        playback.go_to(0);
    }
    if button(ui, Sign::Back, "Previous frame", back) {
        playback.step(-1);
    }
    let (icon, label) = match playback.is_playing {
        true => (Sign::Pause, "Pause animation"),
        false => (Sign::Play, "Play animation"),
    };
    if button(ui, icon, label, play) {
        playback.toggle();
    }
    if button(ui, Sign::Forward, "Next frame", forward) {
        playback.step(1);
    }
    if button(ui, Sign::Last, "Last frame", last) {
        playback.go_to(playback.last_frame());
    }
    ui.separator();
    let response = number(
        ui,
        &mut playback.speed,
        1.0 / MAX_SPEED..=MAX_SPEED,
        0.02,
        " ×",
    );
    name(&response, playback.speed, "Speed");
    response.on_hover_text("Playback speed: animation seconds per second");
    ui.checkbox(&mut playback.repeats, "Loop")
        .on_hover_text(repeat);
    ui.separator();
    let mut fps = playback.clock.fps;
    let response = number(ui, &mut fps, 0.01..=1000.0, 0.1, " fps");
    name(&response, fps, "Frames per second");
    response.on_hover_text("Frames per second of animation, 0.01 to 1000");
    playback.set_fps(fps);
    ui.separator();
    ui.checkbox(&mut playback.blurs, "Motion blur")
        .on_hover_text(blur);
    ui.add_enabled_ui(playback.blurs, |ui| {
        shutter(ui, &mut playback.clock.shutter)
    });
}

fn shutter(ui: &mut Ui, shutter: &mut Shutter) {
    let Shutter { open, close } = shutter;
    ui.label("Shutter");
    let tip = "in frames relative to the frame's time, -16 to 16. Half a frame is 180°";
    let response = number(ui, open, -MAX_SHUTTER..=*close, 0.01, "");
    name(&response, *open, "Shutter opens");
    response.on_hover_text(format!("When the shutter opens, {tip}"));
    ui.label("to");
    let response = number(ui, close, *open..=MAX_SHUTTER, 0.01, " frames");
    name(&response, *close, "Shutter closes");
    response.on_hover_text(format!("When the shutter closes, {tip}"));
}

/// A button with a sign. Returns whether it was clicked.
fn button(ui: &mut Ui, sign: Sign, name: &str, tip: &str) -> bool {
    let response = ui.add(egui::Button::new("").min_size(vec2(28.0, 20.0)));
    let is_enabled = ui.is_enabled();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_enabled, name));
    let color = ui.style().interact(&response).fg_stroke.color;
    sign::draw(ui.painter(), sign, response.rect.center(), color);
    response.on_hover_text(tip).clicked()
}

/// Sets the accessible name of a number without a label.
fn name(response: &egui::Response, value: f64, name: &str) {
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::drag_value(response.enabled(), value);
        info.label = Some(name.into());
        info
    });
}
