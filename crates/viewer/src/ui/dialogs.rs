//! Draws the dialogs over the window: keyboard shortcuts, preferences, the hint of the first run, messages,
//! bookmarks and questions.

mod cameras;
mod film;
mod first_steps;
mod jobs;
mod messages;
mod preferences;
mod questions;
mod save_scene;
mod shortcuts;

use crate::actions::commands;
use crate::actions::editing;
use crate::actions::files;
use crate::actions::{self, settings};
use crate::model::bindings::Action;
use crate::state::dialogs::Dialog;
use crate::state::layout::Layout;
use crate::ui::context::PanelContext;
use crate::ui::panels::add;
use eframe::egui;
use std::path::Path;

/// Draws the open dialogs.
pub fn show(ui: &mut egui::Ui, context: &mut PanelContext, layout: &mut Layout) {
    if context.session.files.is_posing() {
        return;
    }
    let ctx = ui.ctx().clone();
    for dialog in context.session.dialogs.open.clone() {
        let stays = match dialog {
            Dialog::Shortcuts => shortcuts::show(&ctx, context.session),
            Dialog::Preferences => preferences::show(&ctx, context.session, layout),
            Dialog::Hint => first_steps::show(&ctx, context.session, layout),
            Dialog::Messages => messages::show(&ctx, context.session),
            Dialog::Cameras => cameras::show(&ctx, context.session),
            Dialog::Jobs => jobs::show(&ctx, context),
        };
        if !stays {
            context.session.dialogs.close(dialog);
            actions::dialogs::closed(context.session, dialog);
        }
    }
    questions::typed(&ctx, context.session);
    add::at_cursor(&ctx, context.session);
    questions::saving(&ctx, context);
    film::show(&ctx, context.session);
    save_scene::show(ui, context);
    if let Some(intent) = questions::undecided(&ctx, context.session) {
        match intent {
            questions::Choice::Save(intent) => {
                commands::perform(Action::SaveScene, context.session, layout, &ctx);
                // If saving needs a name first, the action is dropped; the user can repeat it.
                if !context.session.has_changes() {
                    files::go_on(context.session, intent);
                }
            }
            questions::Choice::GoOn(intent) => files::go_on(context.session, intent),
        }
    }
    questions::hovering(&ctx);
    let is_list = editing::has_list_focus(context.session, &ctx);
    context.session.dialogs.had_keyboard = ctx.egui_wants_keyboard_input() && !is_list;
    settings::store_layout_if_due(context.session, layout);
}

/// Shows the folder of a file name.
fn folder(ui: &mut egui::Ui, name: &str) {
    let path = Path::new(name.trim());
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let text = format!("Folder: {}", folder.display());
    ui.add(egui::Label::new(egui::RichText::new(text).weak()).truncate());
}

/// Draws a dialog in the centre of the window. Returns whether it stays open.
fn window(
    ctx: &egui::Context,
    title: &str,
    size: egui::Vec2,
    contents: impl FnOnce(&mut egui::Ui),
) -> bool {
    let mut stays = true;
    let room = ctx.content_rect().size() - egui::vec2(48.0, 96.0);
    egui::Window::new(title)
        .open(&mut stays)
        .collapsible(false)
        .resizable(false)
        .fixed_size(size.min(room))
        .pivot(egui::Align2::CENTER_CENTER)
        .default_pos(ctx.content_rect().center())
        .show(ctx, contents);
    stays
}
