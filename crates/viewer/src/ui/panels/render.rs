//! Render settings: view mode, sampling, size and tone mapping.

mod backdrop;
mod compare;
mod histogram;
mod size;
mod statistics;
pub mod view_mode;

pub use statistics::seconds;

use crate::model::view_settings::ViewSettings;
use crate::ui::context::PanelContext;
use crate::ui::panels::row::{self, heading, section};
use crate::ui::panels::setting_rows::{self, choice, line};
use eframe::egui::{self, Ui};
use glimray_app::settings::{SETTINGS, Section, Setting};
use glimray_app::value_names::{TONES, TRANSFERS};
use glimray_render::{Integrator, RenderSettings};

/// The setting whose row stands among the everyday ones.
const SAMPLES: &str = "samples";

/// Draws all settings that are not part of the scene: everyday ones above, those of experts folded.
pub fn render(ui: &mut Ui, context: &mut PanelContext) {
    row::scrolled(ui, |ui| {
        egui::Frame::NONE.inner_margin(6.0).show(ui, |ui| {
            statistics::progress(ui, context);
            heading(ui, "Picture");
            ui.add_enabled_ui(context.session.scene().is_some(), |ui| {
                everyday(ui, &mut context.session.view);
            });
            section(ui, "Comparison", true, |ui| compare::compare(ui, context));
            section(ui, "Histogram", true, |ui| {
                histogram::histogram(ui, context)
            });
            section(ui, "Tone mapping", true, |ui| {
                developing(ui, &mut context.session.view)
            });
            section(ui, "Size", true, |ui| size::size(ui, context));
            let look = &mut context.session.view;
            if look.settings.integrator == Integrator::Path {
                section(ui, "Backdrop", true, |ui| backdrop::backdrop(ui, look));
            }
            section(ui, "Sampling", false, |ui| {
                samples(ui, look, |setting| setting.name != SAMPLES)
            });
            section(ui, "Rays", false, |ui| {
                rows(ui, look, Section::Rays, |_| true)
            });
            section(ui, "Statistics", false, |ui| {
                statistics::statistics(ui, context)
            });
        });
    });
}

/// The settings that are used each day.
fn everyday(ui: &mut Ui, look: &mut ViewSettings) {
    view_mode::view_mode(ui, look);
    exposure(ui, "Exposure", look);
    samples(ui, look, |setting| setting.name == SAMPLES);
    let usual = look.scene_tone.denoise;
    let denoise = &mut look.tone.denoise;
    line(
        ui,
        (
            "Denoise",
            "Filters the noise, guided by albedo, normals and depth. Switched on for the first time, it \
             starts the picture over",
        ),
        denoise,
        &usual,
        |ui, value| ui.checkbox(value, ""),
    );
    // Once the film has features, switching costs no samples.
    look.settings.features |= *denoise;
}

/// The exposure of the picture.
pub fn exposure(ui: &mut Ui, label: &str, look: &mut ViewSettings) {
    line(
        ui,
        (
            label,
            "Exposure in stops, -64 to 64. Each stop doubles the brightness",
        ),
        &mut look.tone.exposure_ev,
        &look.scene_tone.exposure_ev,
        |ui, value| {
            let stops = egui::DragValue::new(value).range(-64.0..=64.0).speed(0.02);
            let size = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
            ui.add_sized(size, stops.max_decimals(2).suffix(" EV"))
        },
    );
}

/// Rows of sampling, of which some depend on others.
fn samples(ui: &mut Ui, look: &mut ViewSettings, is_meant: impl Fn(&Setting) -> bool) {
    let (samples, filter) = (look.settings.samples, look.settings.filter);
    rows(ui, look, Section::Sampling, is_meant);
    let chosen = look.settings.samples;
    if chosen != samples {
        look.settings.samples = samples;
        look.set_samples(chosen);
    }
    if look.settings.filter != filter {
        look.settings.filter_radius = usual(look).filter_radius;
    }
}

/// Rows of a section from the table of settings. Settings of paths are there for paths only.
fn rows(
    ui: &mut Ui,
    look: &mut ViewSettings,
    section: Section,
    is_meant: impl Fn(&Setting) -> bool,
) {
    for setting in SETTINGS {
        if let Some(row) = &setting.row
            && row.section == section
            && (section == Section::Sampling || setting.applies(&look.settings))
            && is_meant(setting)
        {
            let usual = usual(look);
            setting_rows::setting(ui, (setting, row), &mut look.settings, &usual);
        }
    }
}

/// The settings of the scene and the command line; a filter other than theirs has its own radius.
fn usual(look: &ViewSettings) -> RenderSettings {
    let mut usual = look.scene_settings.clone();
    if look.settings.filter != usual.filter {
        usual.filter_radius = look.settings.filter.default_radius();
    }
    usual
}

/// These settings do not retrace the picture.
fn developing(ui: &mut Ui, look: &mut ViewSettings) {
    let usual = look.scene_tone;
    let tone = &mut look.tone;
    line(
        ui,
        (
            "Auto exposure",
            "Adds the exposure that makes the picture's average a medium grey",
        ),
        &mut tone.auto_exposure,
        &usual.auto_exposure,
        |ui, value| ui.checkbox(value, ""),
    );
    line(
        ui,
        ("Tone curve", "Maps radiance to display colours"),
        &mut tone.curve,
        &usual.curve,
        |ui, value| choice(ui, "tone curve", &TONES, value),
    );
    line(
        ui,
        ("Transfer", "Transfer function of the output"),
        &mut tone.transfer,
        &usual.transfer,
        |ui, value| choice(ui, "transfer", &TRANSFERS, value),
    );
}
