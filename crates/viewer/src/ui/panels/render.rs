//! Render settings: view mode, sampling, size and tone mapping.

mod background;
mod compare;
mod histogram;
mod size;
mod statistics;

pub use statistics::{remaining, seconds};

use crate::model::view_settings::{MAX_SAMPLES, ViewSettings};
use crate::ui::context::PanelContext;
use crate::ui::panels::setting_rows::{choice, line, number};
use eframe::egui::{self, Ui};
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_app::value_names::{
    ANTIALIAS, BSDF_MODELS, FILTERS, INTEGRATORS, TONES, TRANSFERS, TRIANGLE_TESTS,
};
use glimray_render::Integrator;
use glimray_scene::Antialias;

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
    let usual = look.scene_settings.clone();
    let before = look.settings.samples;
    let mut samples = before;
    line(
        ui,
        ("Samples", "Target samples per pixel, 1 to 65536"),
        &mut samples,
        &usual.samples,
        |ui, value| {
            let response = number(ui, value, 1..=MAX_SAMPLES, 0.25, "");
            if ui
                .button("½")
                .on_hover_text("Halve the target samples")
                .clicked()
            {
                *value = (*value / 2).max(1);
            }
            if ui
                .button("×2")
                .on_hover_text("Double the target samples")
                .clicked()
            {
                *value = (*value * 2).min(MAX_SAMPLES);
            }
            response
        },
    );
    if samples != before {
        look.set_samples(samples);
    }
    let settings = &mut look.settings;
    line(
        ui,
        ("Antialias", "Placement of samples in a pixel"),
        &mut settings.antialias,
        &usual.antialias,
        |ui, value| choice(ui, "antialias", &ANTIALIAS, value),
    );
    let is_adaptive = settings.antialias == Antialias::Adaptive;
    line(
        ui,
        (
            "Noise",
            "Adaptive sampling continues where the estimated error exceeds this fraction of white",
        ),
        &mut settings.noise,
        &usual.noise,
        |ui, value| {
            ui.add_enabled_ui(is_adaptive, |ui| number(ui, value, 1e-6..=1.0, 0.0005, ""))
                .inner
                .on_disabled_hover_text("Only used by adaptive sampling")
        },
    );
    let before = settings.filter;
    line(
        ui,
        ("Filter", "Reconstruction filter"),
        &mut settings.filter,
        &usual.filter,
        |ui, value| choice(ui, "filter", &FILTERS, value),
    );
    if settings.filter != before {
        settings.filter_radius = match settings.filter == usual.filter {
            true => usual.filter_radius,
            false => settings.filter.default_radius(),
        };
    }
    let usual_radius = match settings.filter == usual.filter {
        true => usual.filter_radius,
        false => settings.filter.default_radius(),
    };
    line(
        ui,
        ("Filter radius", "Radius of the filter, 0.01 to 16 pixels"),
        &mut settings.filter_radius,
        &usual_radius,
        |ui, value| number(ui, value, 0.01..=16.0, 0.01, " px"),
    );
    line(
        ui,
        (
            "Light samples",
            "Factor on the samples of every area light, 0.001 to 1000",
        ),
        &mut settings.light_samples,
        &usual.light_samples,
        |ui, value| number(ui, value, 0.001..=1000.0, 0.02, " ×"),
    );
    line(
        ui,
        ("Seed", "Seed of the random numbers"),
        &mut settings.seed,
        &usual.seed,
        |ui, value| number(ui, value, 0..=u32::MAX, 0.1, ""),
    );
}

fn rays(ui: &mut Ui, look: &mut ViewSettings) {
    let usual = look.scene_settings.clone();
    let settings = &mut look.settings;
    line(
        ui,
        (
            "Max depth",
            "Bounces after the first hit, 0 to 1000. 0 is local shading only",
        ),
        &mut settings.max_depth,
        &usual.max_depth,
        |ui, value| number(ui, value, 0..=1000, 0.05, ""),
    );
    line(
        ui,
        (
            "Min throughput",
            "Terminate reflection and refraction rays below this throughput, 0 to 1",
        ),
        &mut settings.min_throughput,
        &usual.min_throughput,
        |ui, value| number(ui, value, 0.0..=1.0, 0.0005, ""),
    );
    if settings.integrator == Integrator::Path {
        line(
            ui,
            (
                "Clear shadows",
                "Let all glass filter shadow rays in straight lines, which loses caustics",
            ),
            &mut settings.transparent_shadows,
            &usual.transparent_shadows,
            |ui, value| ui.checkbox(value, ""),
        );
        line(
            ui,
            ("Scattering", "How metallic-roughness materials scatter"),
            &mut settings.bsdf,
            &usual.bsdf,
            |ui, value| choice(ui, "scattering", &BSDF_MODELS, value),
        );
        line(
            ui,
            (
                "Clamp indirect",
                "The most radiance that a sample gains at once from indirect light; 0 is no limit. \
                 It removes fireflies, and light",
            ),
            &mut settings.clamp_indirect,
            &usual.clamp_indirect,
            |ui, value| {
                let mut limit = value.unwrap_or_default();
                let response = number(ui, &mut limit, 0.0..=1e6, 0.1, "");
                *value = Some(limit).filter(|limit| *limit > 0.0);
                response
            },
        );
    }
    line(
        ui,
        ("Triangle test", "Ray–triangle intersection algorithm"),
        &mut settings.triangle_test,
        &usual.triangle_test,
        |ui, value| choice(ui, "triangle test", &TRIANGLE_TESTS, value),
    );
    line(
        ui,
        (
            "Brute force",
            "Test every primitive for every ray, without the BVH. Same picture, much slower",
        ),
        &mut settings.brute_force,
        &usual.brute_force,
        |ui, value| ui.checkbox(value, ""),
    );
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
