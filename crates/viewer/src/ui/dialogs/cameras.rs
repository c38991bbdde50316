//! The dialog of bookmarked views: rename, go to, delete.

use crate::actions::files::cameras;
use crate::state::session::Session;
use eframe::egui::{self, TextEdit, vec2};

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    let kept: Vec<_> = cameras::all(session)
        .into_iter()
        .filter(|view| view.is_bookmark)
        .collect();
    let mut names = std::mem::take(&mut session.dialogs.names);
    let mut rename = None;
    let stays = crate::ui::dialogs::window(ctx, "Bookmarked views", vec2(380.0, 300.0), |ui| {
        if kept.is_empty() {
            ui.weak("No bookmarks yet. Use View › Cameras › Bookmark view.");
        }
        egui::ScrollArea::vertical().show(ui, |ui| {
            for view in &kept {
                ui.horizontal(|ui| {
                    let name = &view.name;
                    let text = names.entry(name.clone()).or_insert_with(|| name.clone());
                    let field = ui.add(TextEdit::singleline(text).desired_width(200.0));
                    let field = field.accessible_name(format!("Name of {name}"));
                    if field.lost_focus() && *text != *name {
                        rename = Some((name.clone(), text.clone()));
                    }
                    for (verb, hover) in
                        [("Go", "Go to this view"), ("Delete", "Delete the bookmark")]
                    {
                        let button = ui.button(verb).on_hover_text(hover);
                        let button = button.accessible_name(format!("{verb}: {name}"));
                        match (button.clicked(), verb) {
                            (true, "Go") => cameras::go(session, view),
                            (true, _) => cameras::delete(session, name),
                            (false, _) => {}
                        }
                    }
                });
            }
        });
    });
    if let Some((name, to)) = rename {
        if !cameras::rename(session, &name, &to) {
            let to = to.trim();
            session.messages.warn(format!(
                "Cannot rename the bookmark to “{to}”: the name is empty or already used"
            ));
        }
        names.remove(&name);
    }
    if stays {
        session.dialogs.names = names;
    }
    stays
}
