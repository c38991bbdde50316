//! Shows messages until they expire.

use crate::actions::files::show;
use crate::actions::lighting;
use crate::model::messages::Remedy;
use crate::state::layout::{Layout, Panel};
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::worker::free_name::short;
use eframe::egui::{self, Align2, Area, Frame, Id, RichText};
use std::path::Path;

/// The effect of the button that shows a file.
pub const SHOW: &str = "Open the file manager with this file selected";

/// Maximum width of a message, in points.
const WIDTH: f32 = 380.0;

/// Draws the visible messages above everything else.
pub fn messages(ui: &mut egui::Ui, context: &mut PanelContext, layout: &Layout) {
    let messages = context.session.messages.current();
    if messages.is_empty() || context.session.files.is_posing() {
        return;
    }
    if let Some(time) = context.session.messages.next_change() {
        ui.ctx().request_repaint_after(time);
    }
    // In the picture they hide neither fields nor the histogram.
    let room = (layout.rect(Panel::Picture)).unwrap_or(ui.ctx().content_rect());
    Area::new(Id::unique("notices"))
        .pivot(Align2::RIGHT_BOTTOM)
        .fixed_pos(room.right_bottom() - egui::vec2(12.0, 36.0))
        .order(egui::Order::Foreground)
        .accessible_name("Notices")
        .show(ui.ctx(), |ui| {
            for notice in messages {
                Frame::popup(ui.style()).show(ui, |ui| {
                    ui.set_max_width(WIDTH);
                    ui.horizontal_top(|ui| {
                        if notice.is_trouble {
                            let sign = RichText::new("!").color(ui.visuals().warn_fg_color);
                            ui.label(sign);
                        }
                        ui.with_layout(egui::Layout::right_to_left(egui::Align::Min), |ui| {
                            let button = ui.small_button("×").on_hover_text("Dismiss");
                            let button =
                                button.accessible_name(format!("Dismiss: {}", notice.text));
                            if button.clicked() {
                                context.session.messages.dismiss(&notice.text);
                            }
                            ui.with_layout(egui::Layout::top_down(egui::Align::Min), |ui| {
                                ui.add(egui::Label::new(&notice.text).wrap());
                                if !notice.remedies.is_empty() {
                                    remedies(ui, context.session, notice.remedies);
                                }
                                if let Some(file) = &notice.file {
                                    show_in_folder(ui, context.session, file);
                                }
                            });
                        });
                    });
                });
            }
        });
}

/// The button that shows a file that was written.
fn show_in_folder(ui: &mut egui::Ui, session: &mut Session, file: &Path) {
    let button = ui.button("Show in folder").on_hover_text(SHOW);
    let name = format!("Show in folder: {}", short(file));
    if button.accessible_name(name).clicked() {
        show::in_folder(session, file, ui.ctx());
    }
}

/// The ways out of what a message reports.
fn remedies(ui: &mut egui::Ui, session: &mut Session, remedies: &[Remedy]) {
    ui.horizontal(|ui| {
        for &remedy in remedies {
            if ui.button(remedy.title()).clicked() {
                lighting::remedy(session, remedy);
            }
        }
    });
}
