//! What lies over the window for a while: the sheet of bindings, the preferences, the first hint,
//! questions; and the keeping of what is chosen there.

mod bindings;
mod cameras;
mod first;
mod history;
mod preferences;
mod questions;
mod save_scene;

use crate::viewer::actions::commands;
use crate::viewer::actions::editing;
use crate::viewer::actions::files;
use crate::viewer::actions::{self, settings};
use crate::viewer::model::bindings::Action;
use crate::viewer::state::dialogs::Dialog;
use crate::viewer::state::layout::Layout;
use crate::viewer::ui::context::PanelContext;
use eframe::egui;
use std::path::Path;

/// Draws those that are open.
pub fn show(ui: &mut egui::Ui, context: &mut PanelContext, layout: &mut Layout) {
    if context.session.files.is_posing() {
        return;
    }
    let ctx = ui.ctx().clone();
    for sheet in context.session.dialogs.open.clone() {
        let stays = match sheet {
            Dialog::Shortcuts => bindings::show(&ctx, context.session),
            Dialog::Preferences => preferences::show(&ctx, context.session, layout),
            Dialog::Hint => first::show(&ctx, context.session),
            Dialog::Messages => history::show(&ctx, context.session),
            Dialog::Cameras => cameras::show(&ctx, context.session),
        };
        if !stays {
            context.session.dialogs.close(sheet);
            actions::dialogs::closed(context.session, sheet);
        }
    }
    questions::typed(&ctx, context.session);
    questions::saving(&ctx, context);
    save_scene::show(ui, context);
    if let Some(intent) = questions::undecided(&ctx, context.session) {
        match intent {
            questions::Choice::Save(intent) => {
                commands::perform(Action::SaveScene, context.session, layout, &ctx);
                // Where that needs a name first, what was wanted can be asked for again.
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
    settings::keep_layout_if_due(context.session, layout);
}

/// Says which folder a file goes into, however its name is typed.
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

/// A sheet in the middle of the window. Whether it stays.
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
