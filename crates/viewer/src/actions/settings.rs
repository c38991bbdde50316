//! Applies the preferences to the window and writes them to the settings file.

use crate::model::preferences::Theme;
use crate::state::dialogs::Dialog;
use crate::state::layout::Layout;
use crate::state::session::Session;
use eframe::egui::{self, ThemePreference};
use std::time::Duration;

/// Delay before changes are written, such as those of a window that is being resized.
const PAUSE: Duration = Duration::from_secs(1);

/// Applies the preferences, and writes them when they have changed.
pub fn update(session: &mut Session, ctx: &egui::Context) {
    let file = &mut session.dialogs.preferences_file;
    if !file.is_begun {
        file.is_begun = true;
        file.written = Some(session.preferences.clone());
        if !session.preferences.hint_seen {
            session.dialogs.open(Dialog::Hint);
        }
    }
    apply(session, ctx);
    let file = &mut session.dialogs.preferences_file;
    let now = ctx.input(|input| input.time);
    if file.looked.is_some_and(|at| now - at < PAUSE.as_secs_f64()) {
        if file.written.as_ref() != Some(&session.preferences) {
            ctx.request_repaint_after(PAUSE);
        }
        return;
    }
    file.looked = Some(now);
    file.is_due = true;
    store_window(session, ctx);
    write(session);
}

/// Writes the preferences if they have changed. An error is reported once.
pub fn write(session: &mut Session) {
    let file = &mut session.dialogs.preferences_file;
    if file.written.as_ref() == Some(&session.preferences) {
        return;
    }
    file.written = Some(session.preferences.clone());
    match session.store.save(&session.preferences) {
        Ok(()) => file.has_failed = false,
        Err(_) if file.has_failed => {}
        Err(why) => {
            file.has_failed = true;
            session.messages.warn(format!(
                "{why} Changes to settings will be lost when the window closes."
            ));
        }
    }
}

fn apply(session: &mut Session, ctx: &egui::Context) {
    let preferences = &session.preferences;
    let wanted = (preferences.theme, preferences.ui_scale);
    let file = &mut session.dialogs.preferences_file;
    if file.applied == Some(wanted) {
        return;
    }
    file.applied = Some(wanted);
    // The table of bindings has keys for this.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.set_theme(match wanted.0 {
        Theme::System => ThemePreference::System,
        Theme::Dark => ThemePreference::Dark,
        Theme::Light => ThemePreference::Light,
    });
    ctx.set_zoom_factor(wanted.1);
}

/// Stores whether the window is maximized, else its size and position.
fn store_window(session: &mut Session, ctx: &egui::Context) {
    let viewport = ctx.input(|input| input.viewport().clone());
    let is_minimized = viewport.minimized.unwrap_or(false);
    if is_minimized || viewport.fullscreen.unwrap_or(false) {
        return;
    }
    let preferences = &mut session.preferences;
    preferences.maximized = viewport.maximized.unwrap_or(false);
    if preferences.maximized {
        return;
    }
    // In points of the screen's own scale; otherwise the window would grow at each start.
    let own = |vec: egui::Vec2| (vec * ctx.zoom_factor()).round().into();
    if let Some(size) = viewport.inner_rect.map(|rect| rect.size())
        && size.x >= 320.0
        && size.y >= 240.0
    {
        preferences.window = Some(own(size));
    }
    if let Some(rect) = viewport.outer_rect {
        preferences.window_position = Some(own(rect.min.to_vec2()));
    }
}

/// Stores the layout of the panels when the settings file is due.
pub fn store_layout_if_due(session: &mut Session, layout: &Layout) {
    if std::mem::take(&mut session.dialogs.preferences_file.is_due) {
        store_layout(session, layout);
    }
}

/// Stores the layout of the panels.
pub fn store_layout(session: &mut Session, layout: &Layout) {
    session.preferences.set_layout(Some(layout));
}
