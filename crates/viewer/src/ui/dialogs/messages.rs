//! The list of all messages.

use crate::state::session::Session;
use eframe::egui::{self, Label, RichText, vec2};

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    crate::ui::dialogs::window(ctx, "Messages", vec2(520.0, 360.0), |ui| {
        let messages = session.messages.all();
        if messages.is_empty() {
            ui.weak("No messages yet.");
        }
        egui::ScrollArea::vertical()
            .auto_shrink([false, true])
            .show(ui, |ui| {
                for notice in messages.iter().rev() {
                    ui.horizontal_top(|ui| {
                        ui.add_sized(
                            [64.0, 16.0],
                            Label::new(RichText::new(age(notice.since.elapsed().as_secs())).weak()),
                        );
                        if notice.is_trouble {
                            ui.colored_label(ui.visuals().warn_fg_color, "!");
                        }
                        ui.add(Label::new(&notice.text).wrap());
                    });
                }
            });
    })
}

fn age(seconds: u64) -> String {
    match seconds {
        0..60 => "just now".to_owned(),
        60..3600 => format!("{} min ago", seconds / 60),
        _ => format!("{} h ago", seconds / 3600),
    }
}
