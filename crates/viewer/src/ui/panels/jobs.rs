//! The jobs in the status bar: what is being rendered for a file, how far it is, and a way to end it.

use crate::state::dialogs::Dialog;
use crate::state::jobs::{Job, JobState};
use crate::ui::context::PanelContext;
use crate::ui::panels::render::seconds;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui::{Button, Ui};

/// Draws the oldest job that takes a while, and the number of others.
pub fn line(ui: &mut Ui, context: &mut PanelContext) {
    let jobs = &context.session.files.jobs;
    let others = jobs.lasting().count().saturating_sub(1);
    let Some(job) = jobs.lasting().next() else {
        return;
    };
    let (id, name) = (job.id, job.name());
    let mut text = format!("{name}: {}", progress(job, context).1);
    if others > 0 {
        text += &format!(" (+{others})");
    }
    let cancel = ui.add(Button::new("×").small());
    let cancel = cancel.on_hover_text("Do not write this file");
    if cancel.accessible_name(format!("Cancel {name}")).clicked() {
        context.session.files.jobs.cancel(id);
    }
    let list = ui.add(Button::new(text).frame(false));
    if list.on_hover_text("Show all jobs").clicked() {
        context.session.dialogs.toggle(Dialog::Jobs);
    }
    ui.separator();
}

/// How far a job is: its share in 0..=1, and words for it.
pub fn progress(job: &Job, context: &PanelContext) -> (f32, String) {
    let (share, step, left) = match &job.state {
        JobState::Waiting(_) => {
            let shown = context.shown(PictureSlot::Main).map(|shown| shown.progress);
            let share = shown.as_ref().map_or(0.0, |progress| progress.share);
            let left = context.session.time_left.seconds();
            (share, "when the picture is finished".to_owned(), left)
        }
        JobState::Running => {
            let progress = job.control.progress();
            let left = progress.seconds_left();
            (progress.share, progress.step, left)
        }
        JobState::Done => return (1.0, "saved".to_owned()),
        JobState::Failed(why) => return (0.0, why.clone()),
        JobState::Cancelled => return (0.0, "cancelled".to_owned()),
    };
    let mut text = format!("{:.0} %", share * 100.0);
    if job.control.is_cancelled() {
        text = "stopping".to_owned();
    } else if let Some(left) = left {
        text += &format!(", {} left", seconds(left));
    }
    if !step.is_empty() {
        text += &format!(", {step}");
    }
    (share as f32, text)
}
