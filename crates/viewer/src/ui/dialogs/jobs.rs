//! The list of jobs: files that are being rendered or written, and those that were.

use crate::actions::files::{film, show};
use crate::state::jobs::{Job, JobId, JobState};
use crate::ui::context::PanelContext;
use crate::ui::panels::jobs::progress;
use crate::ui::panels::messages::SHOW;
use eframe::egui::{self, Label, ProgressBar, RichText, ScrollArea, Ui, vec2};
use std::path::PathBuf;

/// A button beside a job.
enum Wish {
    Cancel(JobId),
    Resume(JobId),
    Show(PathBuf),
}

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, context: &mut PanelContext) -> bool {
    let mut wish = None;
    let mut clears = false;
    let stays = crate::ui::dialogs::window(ctx, "Jobs", vec2(480.0, 300.0), |ui| {
        let jobs = context.session.files.jobs.all();
        if jobs.is_empty() {
            ui.weak("No jobs yet. Use File › Save picture, or Render › Film.");
            return;
        }
        let has_ended = jobs.iter().any(|job| !job.is_active());
        ScrollArea::vertical()
            .auto_shrink([false, true])
            .show(ui, |ui| {
                for job in jobs.iter().rev() {
                    wish = row(ui, job, context).or(wish.take());
                }
            });
        ui.add_space(6.0);
        clears = has_ended && ui.button("Clear list").clicked();
    });
    let jobs = &mut context.session.files.jobs;
    if clears {
        jobs.clear();
    }
    match wish {
        Some(Wish::Cancel(id)) => jobs.cancel(id),
        Some(Wish::Resume(id)) => film::resume(context.session, id),
        Some(Wish::Show(path)) => show::in_folder(context.session, &path, ctx),
        None => {}
    }
    stays
}

/// A job with its buttons.
fn row(ui: &mut Ui, job: &Job, context: &PanelContext) -> Option<Wish> {
    let mut wish = None;
    let name = job.name();
    let (share, text) = progress(job, context);
    ui.horizontal(|ui| {
        ui.label(RichText::new(&name).strong())
            .on_hover_text(job.path.display().to_string());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let copy = ui.button("Copy path").on_hover_text("Copy the file's path");
            if copy.accessible_name(format!("Copy path: {name}")).clicked() {
                ui.ctx().copy_text(job.path.display().to_string());
            }
            if job.state == JobState::Done {
                let show = ui.button("Show in folder").on_hover_text(SHOW);
                let label = format!("Show {name} in its folder");
                if show.accessible_name(label).clicked() {
                    wish = Some(Wish::Show(job.path.clone()));
                }
            }
            if job.can_resume() {
                let resume = ui
                    .button("Resume")
                    .on_hover_text("Go on with the frames that are missing");
                if resume.accessible_name(format!("Resume: {name}")).clicked() {
                    wish = Some(Wish::Resume(job.id));
                }
            }
            if job.lasts() {
                let cancel = ui.button("Cancel").on_hover_text("Do not write this file");
                if cancel.accessible_name(format!("Cancel: {name}")).clicked() {
                    wish = Some(Wish::Cancel(job.id));
                }
            }
        });
    });
    match &job.state {
        JobState::Waiting(_) | JobState::Running => {
            ui.add(ProgressBar::new(share).text(text));
        }
        JobState::Failed(_) => {
            let text = RichText::new(text).color(ui.visuals().error_fg_color);
            ui.add(Label::new(text).wrap());
        }
        JobState::Done | JobState::Cancelled => {
            ui.weak(format!("{text}: {}", job.path.display()));
        }
    }
    ui.separator();
    wish
}
