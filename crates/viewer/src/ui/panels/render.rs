//! Render settings: view mode, sampling, size and tone mapping.

mod background;
mod compare;
mod histogram;
mod size;
mod statistics;

pub use statistics::seconds;

use crate::model::view_settings::ViewSettings;
use crate::ui::context::PanelContext;
use crate::ui::panels::setting_rows::{self, choice, line};
use eframe::egui::{self, Ui};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::settings::{SETTINGS, Section};
use glimray_app::value_names::{INTEGRATORS, TONES, TRANSFERS};
use glimray_render::{Integrator, RenderSettings};

/// Width of the label column, in points, so that all sections line up.
const NAMES: f32 = 96.0;

/// Draws all settings that are not part of the scene.
pub fn render(ui: &mut Ui, context: &mut PanelContext) {
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        egui::Frame::NONE.inner_margin(6.0).show(ui, |ui| {
            statistics::progress(ui, context);
            ui.separator();
            section(ui, "Display", |ui| shown(ui, context));
            section(ui, "Sampling", |ui| samples(ui, &mut context.session.view));
            section(ui, "Rays", |ui| rays(ui, &mut context.session.view));
            section(ui, "Size", |ui| size::size(ui, context));
            section(ui, "Tone mapping", |ui| {
                developing(ui, &mut context.session.view)
            });
            plain_section(ui, "Histogram", |ui| histogram::histogram(ui, context));
            section(ui, "Environment", |ui| {
                background::background(ui, context);
                background::backdrop(ui, context);
            });
            section(ui, "Statistics", |ui| statistics::statistics(ui, context));
        });
    });
}

/// A section with rows of two columns.
fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    plain_section(ui, title, |ui| {
        egui::Grid::new(title)
            .num_columns(2)
            .spacing([10.0, 5.0])
            .min_col_width(NAMES)
            .show(ui, contents);
    });
}

fn plain_section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title)
        .default_open(true)
        .show_unindented(ui, contents);
}

/// The view mode and its comparison.
fn shown(ui: &mut Ui, context: &mut PanelContext) {
    let look = &mut context.session.view;
    line(
        ui,
        ("View mode", "What is computed for each camera ray"),
        &mut look.settings.integrator,
        &look.scene_settings.integrator,
        |ui, value| choice(ui, "integrator", &INTEGRATORS, value),
    );
    layer(ui, &mut context.session.view);
    compare::compare(ui, context);
}

/// The layer of a path-traced picture; of a classical one if a key has chosen it.
fn layer(ui: &mut Ui, look: &mut ViewSettings) {
    let integrator = look.settings.integrator;
    let is_layered = integrator.entry().has_layers;
    if !is_layered || integrator != Integrator::Path && look.layer == PictureLayer::Beauty {
        return;
    }
    let mut layer = look.layer;
    line(
        ui,
        (
            "Layer",
            "What is shown of the picture; numbers in false colours. The first layer other than the beauty starts \
             the picture over",
        ),
        &mut layer,
        &PictureLayer::Beauty,
        |ui, value| choice(ui, "layer", &LAYERS, value),
    );
    if layer != look.layer {
        look.show_layer(layer);
    }
}

fn samples(ui: &mut Ui, look: &mut ViewSettings) {
    let (samples, filter) = (look.settings.samples, look.settings.filter);
    rows(ui, Section::Sampling, look);
    let chosen = look.settings.samples;
    if chosen != samples {
        look.settings.samples = samples;
        look.set_samples(chosen);
    }
    if look.settings.filter != filter {
        look.settings.filter_radius = usual(look).filter_radius;
    }
}

fn rays(ui: &mut Ui, look: &mut ViewSettings) {
    rows(ui, Section::Rays, look);
}

/// The rows of a section from the table of settings. Settings of paths are there for paths only.
fn rows(ui: &mut Ui, section: Section, look: &mut ViewSettings) {
    for setting in SETTINGS {
        if let Some(row) = &setting.row
            && row.section == section
            && (section == Section::Sampling || setting.applies(&look.settings))
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
        (
            "Exposure",
            "Exposure in stops, -64 to 64. Each stop doubles the brightness",
        ),
        &mut tone.exposure_ev,
        &usual.exposure_ev,
        |ui, value| {
            let stops = egui::DragValue::new(value).range(-64.0..=64.0).speed(0.02);
            ui.add(stops.max_decimals(2).suffix(" EV"))
        },
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
    line(
        ui,
        (
            "Denoise",
            "Filters the noise, guided by albedo, normals and depth. Switched on for the first time, it \
             starts the picture over",
        ),
        &mut tone.denoise,
        &usual.denoise,
        |ui, value| ui.checkbox(value, ""),
    );
    // Once the film has features, switching costs no samples.
    look.settings.features |= tone.denoise;
}
