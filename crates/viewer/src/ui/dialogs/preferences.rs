//! The preferences: theme, interface scale, shortcuts, and defaults of new scenes.

use crate::model::bindings::Preset;
use crate::model::preferences::{Preferences, Theme};
use crate::state::dialogs::Dialog;
use crate::state::layout::Layout;
use crate::state::session::Session;
use crate::ui::panels::row::{heading, row};
use eframe::egui::{self, ComboBox, DragValue, Slider, vec2};
use glimray_app::value_names::TONES;
use glimray_scene::ToneCurve;

/// Width of the dialog, in points.
const WIDTH: f32 = 480.0;
/// Distance of choices beside each other, in points.
const APART: f32 = 8.0;
/// Width of the number beside a slider, in points.
const NUMBER: f32 = 64.0;

/// Default when the user overrides a scene's samples.
const SAMPLES: u32 = 16;

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session, layout: &mut Layout) -> bool {
    let mut is_resetting = session.dialogs.is_resetting;
    let mut is_reset = false;
    let stays = crate::ui::dialogs::window(ctx, "Preferences", vec2(WIDTH, 300.0), |ui| {
        heading(ui, "Appearance");
        appearance(ui, session);
        heading(ui, "Mouse and keyboard");
        hands(ui, session);
        heading(ui, "Scenes opened from now on");
        defaults(ui, session);
        ui.add_space(8.0);
        ui.separator();
        match session.store.path() {
            Some(path) => ui.weak(format!("Saved in {}", path.display())),
            None => ui.weak("Not saved: there is no home folder."),
        };
        ui.add_space(4.0);
        if is_resetting {
            ui.label("Reset everything, including shortcuts, panels, recent files and bookmarks?");
            ui.horizontal(|ui| {
                is_reset = ui.button("Reset everything now").clicked();
                if ui.button("Cancel").clicked() || is_reset {
                    is_resetting = false;
                }
            });
        } else {
            let button = ui.button("Reset everything…");
            is_resetting = button
                .on_hover_text("The old settings file is kept as a backup")
                .clicked();
        }
    });
    session.dialogs.is_resetting = is_resetting && stays;
    if is_reset {
        reset(session, layout);
    }
    stays
}

/// Resets all settings.
pub fn reset(session: &mut Session, layout: &mut Layout) {
    match session.store.reset() {
        Ok(preferences) => {
            session.preferences = preferences;
            session.messages.notify("All settings were reset");
        }
        Err(why) => {
            session.preferences = Default::default();
            session.messages.warn(why.to_string());
        }
    }
    *layout = Layout::default();
    session.dialogs.open(Dialog::Hint);
}

fn appearance(ui: &mut egui::Ui, session: &mut Session) {
    let preferences = &mut session.preferences;
    row(ui, ("Theme", "Colours of the window"), |ui, _| {
        ui.spacing_mut().item_spacing.x = APART;
        for theme in Theme::ALL {
            let text = match theme {
                Theme::System => "Follow the system",
                Theme::Dark => "Dark",
                Theme::Light => "Light",
            };
            ui.radio_value(&mut preferences.theme, theme, text);
        }
    });
    let tip =
        "Interface zoom relative to the screen's scale, in percent. The picture is not scaled";
    row(ui, ("Scale", tip), |ui, _| scale(ui, preferences, tip));
}

fn scale(ui: &mut egui::Ui, preferences: &mut Preferences, tip: &str) {
    let mut percent = (preferences.ui_scale * 100.0).round();
    ui.spacing_mut().slider_width = (ui.available_width() - NUMBER).max(40.0);
    let slider = Slider::new(&mut percent, 50.0..=400.0)
        .step_by(5.0)
        .suffix(" %");
    // The slider labels its number, but needs a name of its own for that.
    let slider = ui.add(slider.logarithmic(true)).accessible_name("Scale");
    // Applied after the drag: scaling the slider during the drag would feed back.
    let slider = slider.on_hover_text(tip);
    let id = ui.scope_id().with("scale");
    if slider.dragged() {
        ui.data_mut(|data| data.insert_temp(id, percent));
    } else if let Some(chosen) = ui.data_mut(|data| data.remove_temp::<f32>(id)) {
        preferences.ui_scale = chosen / 100.0;
    } else if slider.changed() {
        preferences.ui_scale = percent / 100.0;
    }
}

fn hands(ui: &mut egui::Ui, session: &mut Session) {
    let tip = "Shortcuts as in another program";
    row(ui, ("Keyboard shortcuts", tip), |ui, _| {
        ui.spacing_mut().item_spacing.x = APART;
        let mut preset = session.preferences.bindings.preset();
        for other in Preset::ALL {
            ui.radio_value(&mut preset, other, other.title());
        }
        if preset != session.preferences.bindings.preset() {
            session.preferences.bindings.set_preset(preset);
        }
        if ui
            .button("Change…")
            .on_hover_text("Show all keyboard shortcuts")
            .clicked()
        {
            session.dialogs.open(Dialog::Shortcuts);
        }
    });
}

fn defaults(ui: &mut egui::Ui, session: &mut Session) {
    let preferences = &mut session.preferences;
    row(ui, ("Samples", "Samples per pixel"), |ui, _| {
        ui.spacing_mut().item_spacing.x = APART;
        ui.radio_value(&mut preferences.samples, None, "From the scene");
        let mut is_own = preferences.samples.is_some();
        if ui.radio(is_own, "Always").clicked() {
            preferences.samples = Some(SAMPLES);
            is_own = true;
        }
        let mut samples = preferences.samples.unwrap_or(SAMPLES);
        let field = DragValue::new(&mut samples).range(1..=65_536);
        let response = ui.add_enabled(is_own, field).accessible_name("Samples");
        if response
            .on_hover_text("Samples per pixel for scenes opened from now on")
            .changed()
        {
            preferences.samples = Some(samples);
        }
    });
    let tip = "Path-traced previews are denoised while the camera or the time moves, also where the picture is not";
    row(ui, ("Previews", tip), |ui, label| {
        let check = ui.checkbox(&mut preferences.denoises_previews, "Denoise");
        if let Some(label) = label {
            check.labelled_by(label).on_hover_text(tip);
        }
    });
    let tip = "For scenes opened from now on";
    row(ui, ("Tone curve", tip), |ui, label| {
        let name = |tone: Option<ToneCurve>| match tone {
            None => "From the scene",
            Some(curve) => TONES.name(&curve),
        };
        let list = ComboBox::from_id_salt("tone")
            .selected_text(name(preferences.tone))
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut preferences.tone, None, name(None));
                for curve in [
                    ToneCurve::None,
                    ToneCurve::Aces,
                    ToneCurve::Agx,
                    ToneCurve::Reinhard,
                    ToneCurve::Neutral,
                ] {
                    ui.selectable_value(&mut preferences.tone, Some(curve), name(Some(curve)));
                }
            });
        if let Some(label) = label {
            list.response.labelled_by(label).on_hover_text(tip);
        }
    });
}
