//! What lies over the window for a while: the sheet of bindings, the preferences, the first hint,
//! questions; and the keeping of what is chosen there.

mod bindings;
mod cameras;
mod first;
mod history;
mod kept;
mod preferences;
mod questions;

use super::bindings::Action;
use super::commands;
use super::editing;
use super::files;
use super::layout::Layout;
use super::preferences::Theme;
use super::session::Session;
use super::viewer::Desk;
pub use bindings::BindingsSheet;
pub use bindings::rebind;
use eframe::egui::{self, Key};
pub use kept::{keep_layout, update, write};

/// Factors by which everything is made larger or smaller.
const SCALES: [f32; 12] = [
    0.5, 0.67, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0,
];

/// Something that lies over the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// All bindings.
    Bindings,
    /// Theme, scale and defaults.
    Preferences,
    /// What to do first.
    Hint,
    /// All notices.
    History,
    /// The cameras that were kept.
    Cameras,
}

/// Which sheets are open, and what is being done in them.
#[derive(Default)]
pub struct Sheets {
    open: Vec<Sheet>,
    /// The sheet of bindings.
    pub bindings: BindingsSheet,
    names: cameras::Names,
    is_resetting: bool,
    /// Whether a field had the keyboard in the last frame: egui takes that away before Escape is seen.
    had_keyboard: bool,
    kept: kept::Kept,
}

impl Sheets {
    /// Whether a sheet is open.
    pub fn is_open(&self, sheet: Sheet) -> bool {
        self.open.contains(&sheet)
    }

    /// Opens a sheet, over the others.
    pub fn open(&mut self, sheet: Sheet) {
        self.close(sheet);
        self.open.push(sheet);
    }

    /// Closes a sheet.
    pub fn close(&mut self, sheet: Sheet) {
        self.open.retain(|known| *known != sheet);
    }

    /// Tells that the window is another one, which nothing was told yet.
    pub fn begin(&mut self) {
        self.kept.forget_window();
    }

    fn toggle(&mut self, sheet: Sheet) {
        match self.is_open(sheet) {
            true => self.close(sheet),
            false => self.open(sheet),
        }
    }
}

/// Whether keys are for a sheet, or leave a field, and give no commands. Escape ends a question.
pub fn take_keys(session: &mut Session, ctx: &egui::Context) -> bool {
    let is_escape = ctx.input(|input| input.key_pressed(Key::Escape));
    // This one sees to Escape itself.
    if session.editing.is_asking() || session.sheets.bindings.awaits() {
        return true;
    }
    let files = &session.files;
    if files.undecided.is_some() || files.saving.is_some() || files.typed.is_some() {
        if is_escape {
            close_uppermost(session);
        }
        return true;
    }
    is_escape && session.sheets.had_keyboard
}

/// Carries out a command that opens or closes a sheet, or changes preferences. Whether it does.
pub fn perform(action: Action, session: &mut Session, ctx: &egui::Context) -> bool {
    let preferences = &mut session.preferences;
    match action {
        Action::Help => session.sheets.toggle(Sheet::Bindings),
        Action::Preferences => session.sheets.toggle(Sheet::Preferences),
        Action::ToggleTheme => {
            preferences.theme = match ctx.theme() {
                egui::Theme::Dark => Theme::Light,
                egui::Theme::Light => Theme::Dark,
            }
        }
        Action::LargerText => {
            let next = SCALES.iter().find(|scale| **scale > preferences.ui_scale);
            preferences.ui_scale = *next.unwrap_or(&preferences.ui_scale);
        }
        Action::SmallerText => {
            let next = SCALES.iter().rev();
            let next = next.copied().find(|scale| *scale < preferences.ui_scale);
            preferences.ui_scale = next.unwrap_or(preferences.ui_scale);
        }
        Action::ResetText => preferences.ui_scale = 1.0,
        // Escape closes the uppermost first.
        Action::SelectNothing => return close_uppermost(session),
        _ => return false,
    }
    true
}

fn close_uppermost(session: &mut Session) -> bool {
    let files = &mut session.files;
    if files.undecided.take().is_some() || files.saving.take().is_some() {
        return true;
    }
    if files.typed.take().is_some() {
        return true;
    }
    match session.sheets.open.pop() {
        Some(sheet) => {
            closed(session, sheet);
            true
        }
        None => false,
    }
}

fn closed(session: &mut Session, sheet: Sheet) {
    if sheet == Sheet::Hint {
        session.preferences.hint_seen = true;
    }
}

/// Draws those that are open.
pub fn show(ui: &mut egui::Ui, desk: &mut Desk, layout: &mut Layout) {
    if desk.session.files.is_posing() {
        return;
    }
    let ctx = ui.ctx().clone();
    for sheet in desk.session.sheets.open.clone() {
        let stays = match sheet {
            Sheet::Bindings => bindings::show(&ctx, desk.session),
            Sheet::Preferences => preferences::show(&ctx, desk.session, layout),
            Sheet::Hint => first::show(&ctx, desk.session),
            Sheet::History => history::show(&ctx, desk.session),
            Sheet::Cameras => cameras::show(&ctx, desk.session),
        };
        if !stays {
            desk.session.sheets.close(sheet);
            closed(desk.session, sheet);
        }
    }
    questions::typed(&ctx, desk.session);
    questions::saving(&ctx, desk);
    if let Some(intent) = questions::undecided(&ctx, desk.session) {
        match intent {
            questions::Choice::Save(intent) => {
                commands::perform(Action::SaveScene, desk.session, layout, &ctx);
                // Where that needs a name first, what was wanted can be asked for again.
                if !desk.session.has_changes() {
                    files::go_on(desk.session, intent);
                }
            }
            questions::Choice::GoOn(intent) => files::go_on(desk.session, intent),
        }
    }
    questions::hovering(&ctx);
    let is_list = editing::has_list_focus(desk.session, &ctx);
    desk.session.sheets.had_keyboard = ctx.egui_wants_keyboard_input() && !is_list;
    kept::keep_layout_if_due(desk.session, layout);
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
