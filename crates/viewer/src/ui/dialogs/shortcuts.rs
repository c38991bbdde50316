//! The dialog of keyboard shortcuts: generated from the table, with a search, editable.

use crate::actions::dialogs;
use crate::model::bindings::{Action, Category, Manner, Mods, Preset, Trigger, zooms};
use crate::model::messages::sentence;
use crate::state::dialogs::Capture;
use crate::state::session::Session;
use eframe::egui::{
    self, Align, Button, Event, Key, Label, Layout, Pos2, Rect, RichText, TextEdit, Ui, Vec2, vec2,
};

/// Size of the small buttons of a row, and the gap between them, in points.
const SMALL: Vec2 = vec2(24.0, 18.0);
const GAP: f32 = 4.0;

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    capture(ctx, session);
    let stays = crate::ui::dialogs::window(ctx, "Keyboard shortcuts", vec2(620.0, 520.0), |ui| {
        head(ui, session);
        ui.separator();
        let search = session.dialogs.bindings.search.to_lowercase();
        egui::ScrollArea::vertical()
            .auto_shrink([false, false])
            .show(ui, |ui| table(ui, session, &search));
    });
    if !stays {
        session.dialogs.bindings.capture = None;
    }
    stays
}

fn head(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        let search = &mut session.dialogs.bindings.search;
        let field = TextEdit::singleline(search)
            .hint_text("Search")
            .desired_width(200.0);
        ui.add(field).accessible_name("Search shortcuts");
        let mut preset = session.preferences.bindings.preset();
        egui::ComboBox::from_label("Preset")
            .selected_text(preset.title())
            .show_ui(ui, |ui| {
                for other in Preset::ALL {
                    ui.selectable_value(&mut preset, other, other.title());
                }
            });
        if preset != session.preferences.bindings.preset() {
            session.preferences.bindings.set_preset(preset);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let has_changes = !session.preferences.bindings.changes().is_empty();
            let button = ui.add_enabled(has_changes, Button::new("Reset all"));
            if button
                .on_hover_text("Restore the preset's shortcuts")
                .clicked()
            {
                session.preferences.bindings.reset_all();
                session.dialogs.bindings.refusal = None;
            }
        });
    });
    let conflicts = session.preferences.bindings.conflicts();
    for conflict in conflicts.iter().take(3) {
        let [first, second] = conflict.actions.map(Action::description);
        let trigger = conflict.trigger.label(cfg!(target_os = "macos"));
        let text = format!("{trigger} is assigned twice: {first} (takes effect), {second}");
        ui.colored_label(ui.visuals().warn_fg_color, text);
    }
}

fn table(ui: &mut Ui, session: &mut Session, search: &str) {
    let mut is_empty = true;
    for category in Category::ALL {
        let actions = Action::ALL.iter().copied();
        let found: Vec<Action> = actions
            .filter(|action| action.category() == category)
            .filter(|action| matches(session, *action, search))
            .collect();
        if found.is_empty() {
            continue;
        }
        is_empty = false;
        ui.add_space(6.0);
        ui.strong(category.title());
        for action in found {
            row(ui, session, action);
        }
    }
    if is_empty {
        ui.add_space(12.0);
        ui.weak("No matching commands.");
    }
}

/// Whether the description, name, category or shortcuts of a command contain all words.
fn matches(session: &Session, action: Action, search: &str) -> bool {
    let text = format!(
        "{} {} {} {}",
        action.description(),
        action.name(),
        action.category().title(),
        session.preferences.bindings.label(action)
    );
    let text = text.to_lowercase();
    search.split_whitespace().all(|word| text.contains(word))
}

fn row(ui: &mut Ui, session: &mut Session, action: Action) {
    let what = action.description();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        // A row wider than the dialog would widen all rows below.
        let width = ui.available_width();
        let size = vec2(width * 0.58, ui.spacing().interact_size.y);
        let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
        let place = egui::UiBuilder::new().max_rect(rect);
        let mut ui_of_text = ui.new_child(place.layout(Layout::left_to_right(Align::Center)));
        ui_of_text.add(Label::new(what).truncate());
        let capture = session.dialogs.bindings.capture;
        if let Some(capture) = capture.filter(|capture| capture.action == action) {
            awaiting(ui, session, capture);
            return;
        }
        let bindings = &session.preferences.bindings;
        let (label, is_changed) = (bindings.label(action), bindings.is_changed(action));
        let text = match label.is_empty() {
            true => RichText::new("none").weak(),
            false if is_changed => RichText::new(&label).strong(),
            false => RichText::new(&label),
        };
        let begin = |adds| Capture {
            action,
            adds,
            place: None,
            is_ready: false,
        };
        let width = (ui.available_width() - 3.0 * (SMALL.x + GAP)).max(40.0);
        let button = Button::new(text).truncate();
        let hover = match label.is_empty() {
            true => "Assign a shortcut".to_owned(),
            false => format!("Change {label}"),
        };
        let place = ui.add_sized(vec2(width, SMALL.y), button);
        if named(place, "Change", what).on_hover_text(hover).clicked() {
            session.dialogs.bindings.capture = Some(begin(false));
            session.dialogs.bindings.refusal = None;
        }
        let small = |ui: &mut Ui, is_on, text| {
            let add = |ui: &mut Ui| ui.add_sized(SMALL, Button::new(text).small());
            ui.add_enabled_ui(is_on, add).inner
        };
        let more = small(ui, true, "+");
        if named(more, "Add to", what)
            .on_hover_text("Add another shortcut")
            .clicked()
        {
            session.dialogs.bindings.capture = Some(begin(true));
            session.dialogs.bindings.refusal = None;
        }
        let none = small(ui, !label.is_empty(), "×");
        if named(none, "Unbind", what)
            .on_hover_text("Remove the shortcut")
            .clicked()
        {
            // An empty list suits every command.
            let _ = session.preferences.bindings.set(action, Vec::new());
        }
        let reset = small(ui, is_changed, "↺");
        if named(reset, "Reset", what)
            .on_hover_text("Restore the preset's shortcut")
            .clicked()
        {
            session.preferences.bindings.reset(action);
        }
    });
    if let Some((refused, why)) = &session.dialogs.bindings.refusal
        && *refused == action
    {
        ui.colored_label(ui.visuals().error_fg_color, sentence(why));
    }
}

fn named(response: egui::Response, verb: &str, what: &str) -> egui::Response {
    response.accessible_name(format!("{verb}: {what}"))
}

/// The field that waits for the new trigger.
fn awaiting(ui: &mut Ui, session: &mut Session, mut capture: Capture) {
    let text = match capture.action.manner() {
        Manner::Press => "Press a key, or click here",
        Manner::Hold => "Press the key to hold",
        Manner::Motion if zooms(capture.action) => "Press a button or turn the wheel here",
        Manner::Motion => "Press a button here",
    };
    let button = Button::new(RichText::new(text).italics());
    let response = ui.add_enabled(false, button);
    ui.weak("Escape cancels");
    capture.place = Some(response.rect);
    session.dialogs.bindings.capture = Some(capture);
}

/// Captures the new trigger.
fn capture(ctx: &egui::Context, session: &mut Session) {
    let Some(mut capture) = session.dialogs.bindings.capture else {
        return;
    };
    if !capture.is_ready {
        capture.is_ready = true;
        session.dialogs.bindings.capture = Some(capture);
        return;
    }
    let manner = capture.action.manner();
    let (events, pointer) = ctx.input(|i| (i.events.clone(), i.pointer.latest_pos()));
    let found = events
        .iter()
        .find_map(|event| trigger(event, manner, capture.place, pointer));
    let Some(found) = found else {
        return;
    };
    session.dialogs.bindings.capture = None;
    if let Some(trigger) = found {
        let rebound = dialogs::rebind(session, capture.action, trigger, capture.adds);
        session.dialogs.bindings.refusal = rebound.err().map(|why| (capture.action, why));
    }
}

/// The trigger of an event; `Some(None)` is Escape, which cancels.
fn trigger(
    event: &Event,
    manner: Manner,
    place: Option<Rect>,
    pointer: Option<Pos2>,
) -> Option<Option<Trigger>> {
    let is_in_place = |at: Pos2| place.is_some_and(|place| place.contains(at));
    let command = Mods {
        command: true,
        ..Mods::NONE
    };
    let key = |mods, key| match manner {
        Manner::Press => Some(Some(Trigger::Key(mods, key))),
        Manner::Hold => Some(Some(Trigger::Hold(key))),
        Manner::Motion => None,
    };
    match event {
        Event::Key {
            key: Key::Escape,
            pressed: true,
            ..
        } => Some(None),
        Event::Key {
            key: pressed,
            pressed: true,
            modifiers,
            ..
        } => key(Mods::from(*modifiers), *pressed),
        // The window system sends these events instead of three of the shortcuts.
        Event::Copy => key(command, Key::C),
        Event::Cut => key(command, Key::X),
        Event::Paste(_) => key(command, Key::V),
        Event::PointerButton {
            pos,
            button,
            pressed: true,
            modifiers,
        } if is_in_place(*pos) => match manner {
            Manner::Press => Some(Some(Trigger::Click(Mods::from(*modifiers), *button))),
            Manner::Motion => Some(Some(Trigger::Drag(Mods::from(*modifiers), *button))),
            Manner::Hold => None,
        },
        // A click elsewhere cancels too.
        Event::PointerButton { pressed: true, .. } => Some(None),
        Event::MouseWheel { modifiers, .. }
            if manner == Manner::Motion && pointer.is_some_and(is_in_place) =>
        {
            Some(Some(Trigger::Wheel(Mods::from(*modifiers))))
        }
        _ => None,
    }
}
