//! The outline of the scene.

use crate::viewer::actions::editing;
use crate::viewer::model::bindings::Action;
use crate::viewer::model::objects;
use crate::viewer::model::objects::Id;
use crate::viewer::model::outline::Entry;
use crate::viewer::state::session::Session;
use crate::viewer::ui::context::PanelContext;
use crate::viewer::ui::panels::icon;
use eframe::egui::{self, Key, Rect, RichText, UiBuilder, vec2};

/// Indentation per level.
const INDENT: f32 = 12.0;
/// Width of icons and toggles.
const ICON: f32 = 16.0;

/// An action of the user on a row.
enum Wish {
    Select(Id),
    Frame(Id),
    Show(Id, bool),
    Rename(Id),
    Renamed(Id, String),
    Do(Id, Action),
    HideOthers(Id),
    ShowAll,
}

/// The outline, and below it the problems of the import.
pub fn outline(ui: &mut egui::Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let Some(scene) = session.scene().cloned() else {
        return;
    };
    let mut wishes = Vec::new();
    egui::Frame::new().inner_margin(6).show(ui, |ui| {
        let search = egui::TextEdit::singleline(&mut session.editing.listing.query)
            .hint_text("Search")
            .desired_width(f32::INFINITY);
        let search = ui.add(search).on_hover_text("Filter by name");
        icon::named(&search, "Search the outline");
        ui.add_space(2.0);
        // The rows do not change during a drag.
        let is_dragging = ui.input(|input| input.pointer.any_down());
        if !is_dragging || session.editing.listing.count() == 0 {
            session.editing.listing.follow(&scene);
        }
        let missing = match scene.skipped.len() {
            0 => 0.0,
            _ => ui.spacing().interact_size.y + 8.0,
        };
        let height = (ui.available_height() - missing).max(40.0);
        lines(ui, session, &scene, height, &mut wishes);
        if !scene.skipped.is_empty() {
            skipped(ui, &scene.skipped);
        }
    });
    for wish in wishes {
        grant(session, wish);
    }
}

fn lines(
    ui: &mut egui::Ui,
    session: &mut Session,
    scene: &crate::scene::Scene,
    height: f32,
    wishes: &mut Vec<Wish>,
) {
    let row_height = ui.spacing().interact_size.y;
    let selection = session.selection;
    let mut area = egui::ScrollArea::vertical()
        .id_salt("outline rows")
        .auto_shrink([false, false])
        .max_height(height);
    // Scrolls to a selection made elsewhere.
    let row = selection.and_then(|id| session.editing.listing.row_of(id));
    if session.editing.seen_selection != selection {
        session.editing.seen_selection = selection;
        let stride = row_height + ui.spacing().item_spacing.y;
        if let Some(row) = row {
            let top = row as f32 * stride;
            let seen = session.editing.seen_lines;
            if top < seen.min || top + stride > seen.max {
                area = area.vertical_scroll_offset((top - height / 2.0).max(0.0));
            }
        }
    }
    let count = session.editing.listing.count();
    if count == 0 {
        ui.weak("No matches");
    }
    let had_focus = session.editing.list_focus.take();
    let output = area.show_rows(ui, row_height, count, |ui, range| {
        let entries: Vec<Entry> = session
            .editing
            .listing
            .rows(range.clone())
            .cloned()
            .collect();
        for (row, entry) in range.zip(entries) {
            ui.push_id(row, |ui| match entry.id {
                None => {
                    let text = RichText::new(&entry.label).strong().small();
                    ui.horizontal(|ui| {
                        ui.set_height(row_height);
                        ui.label(text);
                    });
                }
                Some(id) => line(ui, session, scene, &entry, id, had_focus, wishes),
            });
        }
    });
    let top = output.state.clamped_offset().y;
    session.editing.seen_lines = egui::Rangef::new(top, top + output.inner_rect.height());
}

fn line(
    ui: &mut egui::Ui,
    session: &mut Session,
    scene: &crate::scene::Scene,
    entry: &Entry,
    id: Id,
    had_focus: Option<egui::Id>,
    wishes: &mut Vec<Wish>,
) {
    let is_selected = session.selection == Some(id);
    let (rect, _) = ui.allocate_exact_size(
        vec2(ui.available_width(), ui.spacing().interact_size.y),
        egui::Sense::hover(),
    );
    let mut ui = ui.new_child(UiBuilder::new().max_rect(rect));
    let mut left = rect;
    left.min.x += INDENT * (entry.depth.saturating_sub(1)) as f32;
    let (own, rest) = left.split_left_right_at_x(left.min.x + ICON);
    icon::draw(&ui, own, scene, id, entry.visible);
    let can_hide = matches!(id, Id::Object(_) | Id::Node(_));
    let switch = if can_hide { ICON + 4.0 } else { 0.0 };
    let (middle, right) = rest.split_left_right_at_x(rest.max.x - switch);
    if let Some((renamed, name)) = &mut session.editing.renaming
        && *renamed == id
    {
        let edit = egui::TextEdit::singleline(name).id_salt("rename");
        let edit = ui.put(middle.with_min_x(middle.min.x + 4.0), edit);
        icon::named(&edit, "New name");
        if edit.lost_focus() {
            let is_kept = !ui.input(|input| input.key_pressed(Key::Escape));
            let name = name.clone();
            session.editing.renaming = None;
            if is_kept {
                wishes.push(Wish::Renamed(id, name));
            }
        } else if !edit.has_focus() {
            edit.request_focus();
        }
        return;
    }
    let text = match entry.visible {
        true => RichText::new(&entry.label),
        false => RichText::new(&entry.label).weak(),
    };
    let response = ui
        .scope_builder(
            UiBuilder::new()
                .max_rect(middle)
                .layout(egui::Layout::left_to_right(egui::Align::Center)),
            |ui| ui.add(egui::Button::selectable(is_selected, text).truncate()),
        )
        .inner;
    if response.clicked() {
        wishes.push(Wish::Select(id));
    }
    if response.double_clicked() {
        wishes.push(Wish::Frame(id));
    }
    // Arrow keys continue from the clicked row. The focus follows the selection and is never taken from a
    // widget outside the list.
    let follows = is_selected && editing::holds_focus(had_focus, ui.ctx());
    if response.clicked() || follows && !response.has_focus() {
        response.request_focus();
    }
    if response.has_focus() {
        session.editing.list_focus = Some(response.id);
        ui.memory_mut(|memory| {
            let filter = egui::EventFilter {
                vertical_arrows: true,
                ..Default::default()
            };
            memory.set_focus_lock_filter(response.id, filter);
        });
    }
    response.context_menu(|ui| menu(ui, scene, id, entry.visible, wishes));
    if can_hide {
        let verb = if entry.visible { "Hide" } else { "Show" };
        let response = icon::eye(
            &mut ui,
            Rect::from_center_size(right.center(), vec2(ICON, ICON)),
            entry.visible,
        );
        let name = format!("{verb} {}", entry.label);
        icon::named(&response, &name);
        if response.on_hover_text(name).clicked() {
            wishes.push(Wish::Show(id, !entry.visible));
        }
    }
}

fn menu(
    ui: &mut egui::Ui,
    scene: &crate::scene::Scene,
    id: Id,
    visible: bool,
    wishes: &mut Vec<Wish>,
) {
    let mut item = |ui: &mut egui::Ui, text: &str, wish: Wish| {
        if ui.button(text).clicked() {
            wishes.push(wish);
            ui.close();
        }
    };
    match id {
        Id::Camera(_) => item(ui, "Look through", Wish::Frame(id)),
        Id::Material(_) => {}
        _ => item(ui, "Frame", Wish::Frame(id)),
    }
    if objects::name(scene, id).is_some() {
        item(ui, "Rename", Wish::Rename(id));
    }
    if !matches!(id, Id::Node(_)) {
        item(ui, "Duplicate", Wish::Do(id, Action::Duplicate));
    }
    if !matches!(id, Id::Node(_) | Id::Material(_)) {
        item(ui, "Delete", Wish::Do(id, Action::Delete));
    }
    if matches!(id, Id::Object(_) | Id::Node(_)) {
        ui.separator();
        let verb = if visible { "Hide" } else { "Show" };
        item(ui, verb, Wish::Show(id, !visible));
        item(ui, "Hide others", Wish::HideOthers(id));
        item(ui, "Show all", Wish::ShowAll);
    }
}

fn grant(session: &mut Session, wish: Wish) {
    match wish {
        Wish::Select(id) => session.selection = Some(id),
        Wish::Frame(id) => session.frame(id),
        Wish::Show(id, visible) => session.set_visible(id, visible),
        Wish::Rename(id) => {
            session.selection = Some(id);
            session.begin_rename();
        }
        Wish::Renamed(id, name) => {
            let is_other = (session.scene()).is_some_and(|scene| {
                objects::name(scene, id).is_some_and(|old| old != name.trim())
            });
            if is_other {
                let step = format!("rename {}", session.label(id));
                session.change(&step, |scene| objects::rename(scene, id, &name));
            }
        }
        Wish::Do(id, action) => {
            session.selection = Some(id);
            session.clicked.push(action);
        }
        Wish::HideOthers(id) => session.hide_others(id),
        Wish::ShowAll => session.show_all(),
    }
}

/// The problems of the import.
fn skipped(ui: &mut egui::Ui, skipped: &[String]) {
    let title = match skipped.len() {
        1 => "1 part is missing or was repaired".to_owned(),
        count => format!("{count} parts are missing or were repaired"),
    };
    let color = ui.visuals().warn_fg_color;
    ui.separator();
    ui.menu_button(RichText::new(format!("⚠ {title}")).color(color), |ui| {
        ui.set_max_width(420.0);
        egui::ScrollArea::vertical()
            .max_height(320.0)
            .show(ui, |ui| {
                for sentence in skipped {
                    ui.label(sentence);
                }
            });
    });
}
