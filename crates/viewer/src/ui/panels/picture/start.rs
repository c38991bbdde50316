//! Ways to open a scene if there is none.

use crate::actions::files;
use crate::model::bindings::Action;
use crate::state::files::Intent;
use crate::state::session::Session;
use eframe::egui::{self, Align2, Button, Rect, RichText, Vec2};
use std::path::PathBuf;

/// Most recent files that are listed.
const RECENT: usize = 5;
/// Width of the list, in points.
const WIDTH: f32 = 300.0;

/// A wish of the person who starts.
enum Wish {
    Browse,
    New,
    Open(PathBuf),
    BuiltIn,
}

/// A way to open a scene, the files opened last, and the built-in scene.
pub fn start(ui: &mut egui::Ui, session: &mut Session, space: Rect) {
    let width = WIDTH.min(space.width() - 16.0).max(0.0);
    let recent: Vec<PathBuf> = (session.preferences.recent.iter())
        .take(RECENT)
        .cloned()
        .collect();
    let key = session.preferences.bindings.label(Action::Open);
    // The height that the rows below take, so that they stand in the middle.
    let rows = 5 + recent.len() + usize::from(!recent.is_empty());
    let row = ui.spacing().interact_size.y + ui.spacing().item_spacing.y;
    let size = Vec2::new(width, rows as f32 * row + 16.0);
    let area = Align2::CENTER_CENTER.align_size_within_rect(size, space);
    let mut wish = None;
    ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
        let heading = RichText::new("Drop a scene or open one").size(16.0);
        ui.vertical_centered(|ui| ui.add(egui::Label::new(heading).selectable(false)));
        ui.add_space(8.0);
        let wide = |button: Button<'static>| button.min_size(Vec2::new(width, 0.0)).truncate();
        if ui
            .add(wide(Button::new("Open…").shortcut_text(key)))
            .clicked()
        {
            wish = Some(Wish::Browse);
        }
        let key = session.preferences.bindings.label(Action::New);
        if ui
            .add(wide(Button::new("New scene").shortcut_text(key)))
            .clicked()
        {
            wish = Some(Wish::New);
        }
        if !recent.is_empty() {
            ui.add_space(4.0);
            ui.weak("Recent files");
        }
        for path in recent {
            let folder = path.display().to_string();
            let button = ui.add(wide(Button::new(files::short(&path)).frame(false)));
            if button.on_hover_text(folder).clicked() {
                wish = Some(Wish::Open(path));
            }
        }
        ui.add_space(4.0);
        ui.weak("Examples");
        if ui
            .add(wide(Button::new("Built-in scene").frame(false)))
            .clicked()
        {
            wish = Some(Wish::BuiltIn);
        }
    });
    match wish {
        Some(Wish::Browse) => files::ask(session, ui.ctx()),
        Some(Wish::New) => files::go_on(session, Intent::New),
        Some(Wish::Open(path)) => files::open(session, vec![path]),
        Some(Wish::BuiltIn) => files::open_built_in(session),
        None => {}
    }
}
