//! Settings of the picture: what is computed, how finely, how large, and how it is developed.

mod background;
mod figures;
mod size;

pub use figures::{remaining, seconds};

use crate::app::words::{ANTIALIAS, FILTERS, INTEGRATORS, TONES, TRANSFERS, TRIANGLE_TESTS};
use crate::scene::Antialias;
use crate::viewer::model::bindings::Action;
use crate::viewer::model::view_settings::{Comparison, MAX_SAMPLES, Sharing, ViewSettings};
use crate::viewer::ui::context::PanelContext;
use crate::viewer::ui::panels::words::{choice, line, number};
use eframe::egui::{self, Ui};

/// Width of the column of names, in points, so that all sections line up.
const NAMES: f32 = 96.0;

/// Everything about the picture that is not in the scene.
pub fn render(ui: &mut Ui, context: &mut PanelContext) {
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        egui::Frame::NONE.inner_margin(6.0).show(ui, |ui| {
            figures::progress(ui, context);
            ui.separator();
            section(ui, "Shown", |ui| shown(ui, context));
            section(ui, "Sampling", |ui| samples(ui, &mut context.session.view));
            section(ui, "Rays", |ui| rays(ui, &mut context.session.view));
            section(ui, "Size", |ui| size::size(ui, context));
            section(ui, "Developing", |ui| {
                developing(ui, &mut context.session.view)
            });
            section(ui, "Surroundings", |ui| background::background(ui, context));
            section(ui, "Figures", |ui| figures::figures(ui, context));
        });
    });
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title)
        .default_open(true)
        .show_unindented(ui, |ui| {
            egui::Grid::new(title)
                .num_columns(2)
                .spacing([10.0, 5.0])
                .min_col_width(NAMES)
                .show(ui, contents);
        });
}

/// What there is to see, and what it is compared with.
fn shown(ui: &mut Ui, context: &mut PanelContext) {
    let key = |action| match context.session.preferences.bindings.label(action) {
        label if label.is_empty() => String::new(),
        label => format!(" ({label})"),
    };
    let swap = format!("Change over the two looks{}", key(Action::SwapSides));
    let comparing = format!(
        "A second look at the same: behind a line to drag{}, or side by side{}",
        key(Action::SplitWipe),
        key(Action::SideBySide)
    );
    let look = &mut context.session.view;
    line(
        ui,
        ("Integrator", "What is computed for a ray"),
        &mut look.settings.integrator,
        &look.scene_settings.integrator,
        |ui, value| choice(ui, "integrator", &INTEGRATORS, value),
    );
    let mut way = look.comparison.map(|comparison| comparison.sharing);
    line(ui, ("Compare", &comparing), &mut way, &None, |ui, way| {
        let name = |way: Option<Sharing>| match way {
            None => "Off",
            Some(Sharing::Wipe(_)) => "Split wipe",
            Some(Sharing::SideBySide) => "Side by side",
        };
        let ways = [None, Some(Sharing::Wipe(0.5)), Some(Sharing::SideBySide)];
        egui::ComboBox::from_id_salt("compare")
            .selected_text(name(*way))
            .show_ui(ui, |ui| {
                for other in ways {
                    let is_chosen = name(other) == name(*way);
                    if ui.selectable_label(is_chosen, name(other)).clicked() && !is_chosen {
                        *way = other;
                    }
                }
            })
            .response
    });
    if way != look.comparison.map(|comparison| comparison.sharing) {
        match way {
            None => look.comparison = None,
            Some(sharing) => look.compare(sharing),
        }
    }
    if let Some(Comparison { integrator, .. }) = &mut look.comparison {
        let label = ui
            .label("Compared with")
            .on_hover_text("What the second look shows");
        ui.horizontal(|ui| {
            choice(ui, "second", &INTEGRATORS, integrator).labelled_by(label.id);
            if ui.button("Swap").on_hover_text(swap).clicked() {
                std::mem::swap(integrator, &mut look.settings.integrator);
            }
        });
        ui.end_row();
    }
}

fn samples(ui: &mut Ui, look: &mut ViewSettings) {
    let usual = look.scene_settings.clone();
    let before = look.settings.samples;
    let mut samples = before;
    line(
        ui,
        ("Samples", "Samples of each pixel to be reached, 1 to 65536"),
        &mut samples,
        &usual.samples,
        |ui, value| {
            let response = number(ui, value, 1..=MAX_SAMPLES, 0.25, "");
            if ui.button("½").on_hover_text("Halve the samples").clicked() {
                *value = (*value / 2).max(1);
            }
            if ui
                .button("×2")
                .on_hover_text("Double the samples")
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
        ("Antialias", "Where in a pixel its samples lie"),
        &mut settings.antialias,
        &usual.antialias,
        |ui, value| choice(ui, "antialias", &ANTIALIAS, value),
    );
    let is_adaptive = settings.antialias == Antialias::Adaptive;
    line(
        ui,
        (
            "Noise",
            "Adaptive sampling goes on where the estimated error is more than this, in parts of white",
        ),
        &mut settings.noise,
        &usual.noise,
        |ui, value| {
            ui.add_enabled_ui(is_adaptive, |ui| number(ui, value, 1e-6..=1.0, 0.0005, ""))
                .inner
                .on_disabled_hover_text("Only adaptive sampling has a limit of noise")
        },
    );
    let before = settings.filter;
    line(
        ui,
        ("Filter", "What samples round a pixel are weighted by"),
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
        (
            "Filter radius",
            "How far the filter reaches, 0.01 to 16 pixels",
        ),
        &mut settings.filter_radius,
        &usual_radius,
        |ui, value| number(ui, value, 0.01..=16.0, 0.01, " px"),
    );
    line(
        ui,
        (
            "Light samples",
            "Multiplies the samples of every area light, 0.001 to 1000",
        ),
        &mut settings.light_samples,
        &usual.light_samples,
        |ui, value| number(ui, value, 0.001..=1000.0, 0.02, " ×"),
    );
    line(
        ui,
        ("Seed", "Chooses the random numbers"),
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
            "Bounces after the first hit, 0 to 1000; 0 is local shading only",
        ),
        &mut settings.max_depth,
        &usual.max_depth,
        |ui, value| number(ui, value, 0..=1000, 0.05, ""),
    );
    line(
        ui,
        (
            "Min throughput",
            "Mirrored and refracted rays are sent whose share in the sample is at least this, 0 to 1",
        ),
        &mut settings.min_throughput,
        &usual.min_throughput,
        |ui, value| number(ui, value, 0.0..=1.0, 0.0005, ""),
    );
    line(
        ui,
        ("Triangle test", "How rays meet triangles"),
        &mut settings.triangle_test,
        &usual.triangle_test,
        |ui, value| choice(ui, "triangle test", &TRIANGLE_TESTS, value),
    );
    line(
        ui,
        (
            "Brute force",
            "Try every primitive for every ray: the same picture, slowly",
        ),
        &mut settings.brute_force,
        &usual.brute_force,
        |ui, value| ui.checkbox(value, ""),
    );
}

/// None of these costs a ray.
fn developing(ui: &mut Ui, look: &mut ViewSettings) {
    let usual = look.scene_tone;
    let tone = &mut look.tone;
    line(
        ui,
        (
            "Exposure",
            "Brightens the picture by 2 to this power, -64 to 64 stops",
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
        (
            "Tone curve",
            "How bright light becomes a colour of the screen",
        ),
        &mut tone.curve,
        &usual.curve,
        |ui, value| choice(ui, "tone curve", &TONES, value),
    );
    line(
        ui,
        ("Transfer", "How the values are encoded"),
        &mut tone.transfer,
        &usual.transfer,
        |ui, value| choice(ui, "transfer", &TRANSFERS, value),
    );
}
