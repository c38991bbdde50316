//! The preferences: theme, interface scale, shortcuts, and defaults of new scenes.

use crate::model::bindings::Preset;
use crate::model::preferences::Theme;
use crate::state::dialogs::Dialog;
use crate::state::layout::Layout;
use crate::state::session::Session;
use eframe::egui::{self, ComboBox, DragValue, Grid, Slider, vec2};
use glimray_app::value_names::TONES;
use glimray_scene::ToneCurve;

/// Default when the user overrides a scene's samples.
const SAMPLES: u32 = 16;

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session, layout: &mut Layout) -> bool {
    let mut is_resetting = session.dialogs.is_resetting;
    let mut is_reset = false;
    let stays = crate::ui::dialogs::window(ctx, "Preferences", vec2(420.0, 300.0), |ui| {
        Grid::new("preferences")
            .num_columns(2)
            .spacing([24.0, 8.0])
            .show(ui, |ui| {
                appearance(ui, session);
                hands(ui, session);
                defaults(ui, session);
            });
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
    ui.label("Theme");
    ui.horizontal(|ui| {
        for theme in Theme::ALL {
            let text = match theme {
                Theme::System => "Follow the system",
                Theme::Dark => "Dark",
                Theme::Light => "Light",
            };
            ui.radio_value(&mut preferences.theme, theme, text);
        }
    });
    ui.end_row();
    ui.label("Scale");
    let mut percent = (preferences.ui_scale * 100.0).round();
    let slider = Slider::new(&mut percent, 50.0..=400.0)
        .step_by(5.0)
        .suffix(" %");
    // The slider labels its number, but needs a name of its own for that.
    let slider = ui.add(slider.logarithmic(true)).accessible_name("Scale");
    // Applied after the drag: scaling the slider during the drag would feed back.
    let slider = slider.on_hover_text(
        "Interface zoom relative to the screen's scale, in percent. The picture is not scaled",
    );
    let id = ui.scope_id().with("scale");
    if slider.dragged() {
        ui.data_mut(|data| data.insert_temp(id, percent));
    } else if let Some(chosen) = ui.data_mut(|data| data.remove_temp::<f32>(id)) {
        preferences.ui_scale = chosen / 100.0;
    } else if slider.changed() {
        preferences.ui_scale = percent / 100.0;
    }
    ui.end_row();
}

fn hands(ui: &mut egui::Ui, session: &mut Session) {
    ui.label("Keyboard shortcuts");
    ui.horizontal(|ui| {
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
    ui.end_row();
}

fn defaults(ui: &mut egui::Ui, session: &mut Session) {
    let preferences = &mut session.preferences;
    ui.label("Samples");
    ui.horizontal(|ui| {
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
    ui.end_row();
    let label = ui.label("Previews");
    ui.checkbox(&mut preferences.denoises_previews, "Denoise")
        .on_hover_text(
            "Path-traced previews are denoised while the camera or the time moves, also where the picture is not",
        )
        .labelled_by(label.id);
    ui.end_row();
    let label = ui.label("Tone curve");
    let name = |tone: Option<ToneCurve>| match tone {
        None => "From the scene",
        Some(curve) => TONES.name(&curve),
    };
    let response = ComboBox::from_id_salt("tone")
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
    let hover = "For scenes opened from now on";
    response.response.labelled_by(label.id).on_hover_text(hover);
    ui.end_row();
}
