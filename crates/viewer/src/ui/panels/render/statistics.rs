//! Progress and statistics of the picture.

use crate::model::bindings::Action;
use crate::ui::context::PanelContext;
use crate::ui::panels::row::row;
use crate::worker::progressive_image::PictureSlot;
use crate::worker::progressive_image::{Progress, Shown};
use eframe::egui::{self, Ui};
use glimray_scene::bytes::size;

/// Width of the button that pauses and continues, in points.
const PAUSE: f32 = 70.0;

/// The progress bar, and the buttons that control rendering.
pub fn progress(ui: &mut Ui, context: &mut PanelContext) {
    let shown = context.shown(PictureSlot::Main);
    let progress = shown
        .as_ref()
        .map(|shown| shown.progress)
        .unwrap_or_default();
    let share = if progress.is_coarse {
        0.0
    } else {
        progress.share
    };
    let text = match &shown {
        Some(_) => state(&progress, context.session.view.paused),
        None => context.session.waiting_for(),
    };
    let bar = egui::ProgressBar::new(share as f32).text(text);
    ui.add(bar)
        .on_hover_text("Fraction of the target samples that are done");
    let bindings = &context.session.preferences.bindings;
    let with_pause = match context.session.view.paused {
        true => bindings.tip("Resume rendering", Action::PauseRender),
        false => bindings.tip("Pause rendering", Action::PauseRender),
    };
    let with_restart = bindings.tip("Restart rendering", Action::RestartRender);
    let has_scene = context.session.scene().is_some();
    ui.horizontal_wrapped(|ui| {
        let paused = context.session.view.paused;
        let name = if paused { "Continue" } else { "Pause" };
        // Both names have the same room, so that the other buttons stay where they are.
        let pause = egui::Button::new(name).min_size(egui::vec2(PAUSE, 0.0));
        if ui
            .add_enabled(has_scene, pause)
            .on_hover_text(with_pause)
            .clicked()
        {
            context.session.view.paused = !paused;
        }
        let restart = ui.add_enabled(has_scene, egui::Button::new("Restart"));
        if restart.on_hover_text(with_restart).clicked() {
            context.session.restart();
        }
        let keep = ui.add_enabled(
            context.session.has_unsaved_view_settings(),
            egui::Button::new("Save settings to scene"),
        );
        let tip = "Store sampling, tone mapping, background and timing in the scene";
        let keep = keep.on_hover_text(tip);
        if keep.on_disabled_hover_text("No changes to save").clicked() {
            context.session.save_view_settings();
        }
    });
}

/// The text of the progress bar.
fn state(progress: &Progress, paused: bool) -> String {
    let (samples, target) = (progress.samples_so_far(), progress.target);
    match (progress.is_done, paused) {
        (true, _) if !progress.is_coarse => format!("Done: {}", samples_of(u64::from(target))),
        (_, true) => format!("Paused at {samples} of {target} samples"),
        _ if progress.is_coarse => "Preview".into(),
        _ => format!("{samples} of {target} samples"),
    }
}

/// Timings, counts and memory.
pub fn statistics(ui: &mut Ui, context: &mut PanelContext) {
    let Some(shown) = context.shown(PictureSlot::Main) else {
        return;
    };
    for (name, tip, value) in rows(&shown, context.session.time_left.seconds()) {
        row(ui, (name, tip), |ui, _| {
            ui.add(egui::Label::new(value).wrap()).on_hover_text(tip);
        });
    }
}

/// A number of samples in words.
fn samples_of(count: u64) -> String {
    match count {
        1 => "1 sample".to_owned(),
        count => format!("{count} samples"),
    }
}

/// `left`: estimated seconds until the picture is done.
fn rows(shown: &Shown, left: Option<f64>) -> Vec<(&'static str, &'static str, String)> {
    let Shown {
        progress,
        stats,
        adapter,
        ..
    } = shown;
    let mut rows = vec![
        (
            "Time",
            "Seconds of tracing in this picture",
            seconds(progress.trace_seconds),
        ),
        (
            "Remaining",
            "Estimated seconds of tracing until the picture is done",
            left.map_or("–".into(), seconds),
        ),
        (
            "Speed",
            "Camera rays per second of tracing, in millions",
            format!("{:.2} M rays/s", progress.rays_per_second / 1e6),
        ),
        (
            "Noise",
            "Estimated root mean square error as a fraction of white",
            progress
                .noise
                .map_or("–".into(), |noise| format!("{:.2} %", noise * 100.0)),
        ),
        (
            "Adapter",
            "The GPU or driver that renders",
            adapter.to_string(),
        ),
        (
            "Submissions",
            "Pieces of work that the adapter got since the window was opened, and the longest of them in \
             milliseconds",
            format!(
                "{} (longest {:.0} ms)",
                stats.submissions, stats.longest_submission_ms
            ),
        ),
        (
            "Memory",
            "GPU memory planned for the scene and the picture",
            size(stats.gpu_bytes),
        ),
    ];
    if stats.nonfinite_samples > 0 {
        rows.push((
            "Dropped",
            "Samples that were not finite, or brighter than 10^12, and are left out",
            samples_of(stats.nonfinite_samples),
        ));
    }
    if stats.cut_off_trees > 0 {
        rows.push((
            "Cut off",
            "Samples with too many rays or more than 4 nested dielectric volumes. Lower the depth, raise the minimum throughput, or nest fewer volumes",
            samples_of(stats.cut_off_trees),
        ));
    }
    rows
}

/// Formats a duration as `12.3 s` or `2 min 5 s`.
pub fn seconds(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0..60 => format!("{seconds:.1} s"),
        60..3600 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole / 60 % 60),
    }
}
