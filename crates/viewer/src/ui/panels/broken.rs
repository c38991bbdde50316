//! Shows the error of a scene that cannot be read, above the last valid picture.

use crate::actions::files;
use crate::model::loader::SourceLine;
use crate::model::messages::sentence;
use crate::state::files::Intent;
use crate::ui::context::PanelContext;
use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{self, Color32, FontId, RichText, Stroke, Ui};

/// A bar with the message, the line with the error and possible actions.
pub fn broken(ui: &mut Ui, context: &mut PanelContext) {
    let Some(broken) = context.session.files.broken.clone() else {
        return;
    };
    let is_shown = context.session.path.as_ref() == Some(&broken.path);
    egui::Panel::top("broken").show(ui, |ui| {
        ui.add_space(2.0);
        ui.horizontal_wrapped(|ui| {
            let color = ui.visuals().error_fg_color;
            ui.label(RichText::new("!").color(color));
            let message = sentence(&broken.trouble.message);
            ui.add(egui::Label::new(RichText::new(message).color(color)).wrap());
        });
        if let Some(line) = &broken.trouble.line {
            let job = source(line, ui);
            egui::Frame::new()
                .fill(ui.visuals().extreme_bg_color)
                .inner_margin(egui::Margin::symmetric(8, 4))
                .show(ui, |ui| ui.add(egui::Label::new(job).extend()));
        }
        ui.horizontal(|ui| {
            if is_shown && ui.button("Reload").clicked() {
                files::intend(context.session, Intent::Reload);
            }
            if ui.button("Copy message").clicked() {
                ui.ctx().copy_text(broken.trouble.message.clone());
            }
            if ui.button("Dismiss").clicked() {
                context.session.files.broken = None;
            }
            if is_shown {
                let text = match context.session.scene() {
                    Some(_) => "The last valid picture stays visible. The scene reloads when the file changes.",
                    None => "The scene reloads when the file changes.",
                };
                ui.weak(text);
            }
        });
        ui.add_space(2.0);
    });
}

/// The line with its number, the error underlined.
fn source(line: &SourceLine, ui: &Ui) -> LayoutJob {
    let visuals = ui.visuals();
    let font = FontId::monospace(egui::TextStyle::Monospace.resolve(ui.style()).size);
    let format = |color: Color32, underline| TextFormat {
        underline,
        ..TextFormat::simple(font.clone(), color)
    };
    let mut job = LayoutJob::default();
    let number = format!("{} │ ", line.number);
    job.append(
        &number,
        0.0,
        format(visuals.weak_text_color(), Stroke::NONE),
    );
    let plain = format(visuals.text_color(), Stroke::NONE);
    let fault = format(
        visuals.error_fg_color,
        Stroke::new(1.0, visuals.error_fg_color),
    );
    let part = |range| line.text.get(range).unwrap_or_default();
    job.append(part(0..line.span.start), 0.0, plain.clone());
    // An error at the end of a line has no width.
    match line.span.is_empty() {
        true => job.append("^", 0.0, fault),
        false => job.append(part(line.span.clone()), 0.0, fault),
    }
    job.append(part(line.span.end..line.text.len()), 0.0, plain);
    job
}
