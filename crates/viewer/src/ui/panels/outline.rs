//! The outline of the scene.

use crate::actions::selecting::Pick;
use crate::actions::{editing, materials};
use crate::model::bindings::Action;
use crate::model::objects;
use crate::model::objects::Id;
use crate::model::outline::{self, Entry};
use crate::state::dropping::Dragged;
use crate::state::files::Part;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::row::write_heading;
use crate::ui::panels::{icon, parts};
use eframe::egui::{
    self, Color32, DragAndDrop, Key, Rect, RichText, Sense, StrokeKind, WidgetInfo, WidgetText,
    vec2,
};
use glimray_scene::{ObjectRef, Scene};

/// Indentation per level.
const INDENT: f32 = 12.0;
/// Width of icons and toggles.
const ICON: f32 = 16.0;
/// Size of the triangle that folds a group, in points.
const TRIANGLE: f32 = 12.0;

/// An action of the user on a row.
enum Wish {
    Select(Id, Pick),
    Fold(usize),
    Move(Vec<Id>, Option<usize>),
    Give(usize, ObjectRef),
    Frame(Id),
    Show(Id, bool),
    Rename(Id),
    Renamed(Id, String),
    Do(Id, Action),
    HideOthers(Id),
    ShowAll,
}

/// The outline, and below it the notes of the import.
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
        for part in [Part::Scene, Part::Variant] {
            parts::part(ui, session, part);
        }
        parts::camera(ui, session);
        ui.add_space(2.0);
        // The rows do not change during a drag.
        let is_dragging = ui.input(|input| input.pointer.any_down());
        if !is_dragging || session.editing.listing.count() == 0 {
            session.editing.listing.update(&scene);
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
    scene: &Scene,
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
    if let Some(id) = selection
        && session.editing.scrolled_to != selection
    {
        session.editing.listing.reveal(id);
    }
    let row = selection.and_then(|id| session.editing.listing.row_of(id));
    let mut follows = false;
    if session.editing.scrolled_to != selection {
        session.editing.scrolled_to = selection;
        follows = editing::holds_focus(session.editing.list_focus, ui.ctx());
        let stride = row_height + ui.spacing().item_spacing.y;
        if let Some(row) = row {
            let top = row as f32 * stride;
            let visible = session.editing.visible_range;
            if top < visible.min || top + stride > visible.max {
                area = area.vertical_scroll_offset((top - height / 2.0).max(0.0));
            }
        }
    }
    let count = session.editing.listing.count();
    if count == 0 {
        ui.weak("No matches");
    }
    session.editing.list_focus = None;
    let output = area.show_rows(ui, row_height, count, |ui, range| {
        let entries: Vec<Entry> = session
            .editing
            .listing
            .rows(range.clone())
            .cloned()
            .collect();
        for (row, entry) in range.zip(entries) {
            let fold = session.editing.listing.fold(row);
            ui.push_id(row, |ui| {
                let left = line(ui, session, scene, &entry, follows, wishes);
                if let Some(is_folded) = fold
                    && triangle(ui, left, is_folded, &entry.label).clicked()
                {
                    wishes.push(Wish::Fold(row));
                }
            });
        }
    });
    let top = output.state.clamped_offset().y;
    session.editing.visible_range = egui::Rangef::new(top, top + output.inner_rect.height());
}

/// Draws one line. All of it can be clicked and dragged. `follows` says that the focus goes to a newly selected line.
/// Returns where its triangle goes.
fn line(
    ui: &mut egui::Ui,
    session: &mut Session,
    scene: &Scene,
    entry: &Entry,
    follows: bool,
    wishes: &mut Vec<Wish>,
) -> Rect {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let mut inner = rect;
    inner.min.x += INDENT * (entry.depth.saturating_sub(1)) as f32;
    let (triangle, mut middle) = inner.split_left_right_at_x(inner.min.x + TRIANGLE);
    let is_selected = entry.id.is_some_and(|id| session.is_selected(id));
    accept(ui, &response, scene, entry, wishes);
    take_material(ui, session, &response, entry.id, wishes);
    let Some(id) = entry.id else {
        response
            .widget_info(|| WidgetInfo::labeled(egui::Role::Button, ui.is_enabled(), &entry.label));
        background(ui, &response, is_selected);
        write_heading(ui, middle, &entry.label);
        return triangle;
    };
    if let Some((renamed, name)) = &mut session.editing.renaming
        && *renamed == id
    {
        icon::draw(ui, icon_of(&mut middle), scene, id, entry.visible);
        let edit = egui::TextEdit::singleline(name).id_salt("rename");
        let edit = ui.put(middle, edit);
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
        return triangle;
    }
    response.widget_info(|| {
        WidgetInfo::selected(
            egui::Role::Button,
            ui.is_enabled(),
            is_selected,
            &entry.label,
        )
    });
    let color = background(ui, &response, is_selected);
    icon::draw(ui, icon_of(&mut middle), scene, id, entry.visible);
    let can_hide = matches!(id, Id::Object(_) | Id::Node(_));
    let switch = if can_hide { ICON + 4.0 } else { 0.0 };
    let (text, right) = middle.split_left_right_at_x(middle.max.x - switch);
    let color = match entry.visible {
        true => color,
        false => ui.visuals().weak_text_color(),
    };
    write(ui, text, RichText::new(&entry.label), color);
    let modifiers = ui.input(|input| input.modifiers);
    if response.clicked() {
        let pick = match (modifiers.command, modifiers.shift) {
            (true, _) => Pick::Toggle,
            (_, true) => Pick::Range,
            _ => Pick::Only,
        };
        wishes.push(Wish::Select(id, pick));
    }
    if response.double_clicked() {
        wishes.push(Wish::Frame(id));
    }
    if response.drag_started() {
        let ids = match is_selected {
            true => session.selected(),
            false => vec![id],
        };
        DragAndDrop::set_payload(ui.ctx(), Dragged(ids));
    }
    // Arrow keys continue from the clicked row. The focus follows the selection, and is taken neither from a widget
    // outside the list nor from a line that Tab reached.
    if response.clicked() || follows && session.selection == Some(id) {
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
    response.context_menu(|ui| menu(ui, id, entry.visible, wishes));
    if can_hide {
        let verb = if entry.visible { "Hide" } else { "Show" };
        let at = Rect::from_center_size(right.center(), vec2(ICON, ICON));
        let response = icon::eye(ui, at, entry.visible);
        let name = format!("{verb} {}", entry.label);
        icon::named(&response, &name);
        if response.on_hover_text(name).clicked() {
            wishes.push(Wish::Show(id, !entry.visible));
        }
    }
    triangle
}

/// Cuts the place of the icon off the left of a line.
fn icon_of(line: &mut Rect) -> Rect {
    let (icon, rest) = line.split_left_right_at_x(line.min.x + ICON);
    *line = rest.with_min_x(rest.min.x + 4.0);
    icon
}

/// Fills a line that is selected or under the cursor. Returns the colour of its text.
fn background(ui: &egui::Ui, response: &egui::Response, is_selected: bool) -> Color32 {
    let visuals = ui.style().interact_selectable(response, is_selected);
    if is_selected || response.hovered() || response.has_focus() {
        let radius = visuals.corner_radius;
        ui.painter()
            .rect_filled(response.rect, radius, visuals.weak_bg_fill);
    }
    match is_selected || response.hovered() {
        true => visuals.text_color(),
        false => ui.visuals().text_color(),
    }
}

/// Writes a label into a line, cut off where it is too long.
fn write(ui: &egui::Ui, rect: Rect, text: RichText, color: Color32) {
    let galley = WidgetText::from(text).into_galley(
        ui,
        Some(egui::TextWrapMode::Truncate),
        rect.width(),
        egui::TextStyle::Button,
    );
    let at = rect.left_center() - vec2(0.0, galley.size().y / 2.0);
    ui.painter().galley(at, galley, color);
}

/// The triangle that folds a group.
fn triangle(ui: &mut egui::Ui, rect: Rect, is_folded: bool, label: &str) -> egui::Response {
    let response = ui.interact(rect, ui.scope_id().with("fold"), Sense::click());
    let verb = if is_folded { "Unfold" } else { "Fold" };
    let name = format!("{verb} {label}");
    response.widget_info(|| {
        WidgetInfo::labeled(egui::Role::DisclosureTriangle, ui.is_enabled(), &name)
    });
    let openness = if is_folded { 0.0 } else { 1.0 };
    let mut icon = response.clone();
    icon.rect = Rect::from_center_size(rect.center(), vec2(8.0, 8.0));
    egui::collapsing_header::paint_default_icon(ui, openness, &icon);
    response
}

/// Takes lines that are dropped here: a node becomes their parent, and an object's own parent does.
fn accept(
    ui: &egui::Ui,
    response: &egui::Response,
    scene: &Scene,
    entry: &Entry,
    wishes: &mut Vec<Wish>,
) {
    let parent = match entry.id {
        Some(Id::Node(index)) => Some(index),
        Some(id @ Id::Object(_)) => objects::shown_carrier(scene, objects::carrier(scene, id)),
        None if entry.label == outline::OBJECTS => None,
        _ => return,
    };
    let is_other = |dragged: &Dragged| {
        dragged.material().is_none() && !(entry.id).is_some_and(|id| dragged.0.contains(&id))
    };
    if (response.dnd_hover_payload::<Dragged>()).is_some_and(|dragged| is_other(&dragged)) {
        let stroke = ui.visuals().selection.stroke;
        ui.painter()
            .rect_stroke(response.rect, 2.0, stroke, StrokeKind::Inside);
    }
    let is_taken = DragAndDrop::payload::<Dragged>(ui.ctx()).is_some_and(|it| is_other(&it));
    if is_taken && let Some(dragged) = response.dnd_release_payload::<Dragged>() {
        wishes.push(Wish::Move(dragged.0.clone(), parent));
    }
}

/// Takes a material that is dropped on an object's line.
fn take_material(
    ui: &egui::Ui,
    session: &mut Session,
    response: &egui::Response,
    id: Option<Id>,
    wishes: &mut Vec<Wish>,
) {
    let Some(Id::Object(object)) = id else {
        return;
    };
    let hovered = response.dnd_hover_payload::<Dragged>();
    if hovered.is_some_and(|dragged| dragged.material().is_some()) {
        if let Some(dropping) = &mut session.editing.dropping {
            dropping.next = Some(object);
        }
        let stroke = ui.visuals().selection.stroke;
        (ui.painter()).rect_stroke(response.rect, 2.0, stroke, StrokeKind::Inside);
    }
    // Other lines stay for `accept`.
    let is_material = DragAndDrop::payload::<Dragged>(ui.ctx())
        .is_some_and(|dragged| dragged.material().is_some());
    if is_material
        && let Some(dragged) = response.dnd_release_payload::<Dragged>()
        && let Some(material) = dragged.material()
    {
        wishes.push(Wish::Give(material, object));
    }
}

fn menu(ui: &mut egui::Ui, id: Id, visible: bool, wishes: &mut Vec<Wish>) {
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
    item(ui, "Rename", Wish::Rename(id));
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
        Wish::Select(id, pick) => session.pick(id, pick),
        Wish::Fold(row) => session.editing.listing.toggle_fold(row),
        Wish::Move(ids, parent) => session.set_parent(&ids, parent),
        Wish::Give(material, object) => materials::assign(session, material, object),
        Wish::Frame(id) => session.frame(id),
        Wish::Show(id, visible) if session.is_selected(id) => {
            let ids = session.selected();
            session.set_all_visible(&ids, visible);
        }
        Wish::Show(id, visible) => session.set_visible(id, visible),
        Wish::Rename(id) => {
            session.select(vec![id]);
            session.begin_rename();
        }
        Wish::Renamed(id, name) => {
            if session.name(id) != name.trim() {
                let step = format!("rename {}", session.label(id));
                session.change(&step, |scene| objects::rename(scene, id, &name));
            }
        }
        Wish::Do(id, action) => {
            // A menu on one of several selected lines is for all of them.
            if !session.is_selected(id) {
                session.pick(id, Pick::Only);
            }
            session.clicked.push(action);
        }
        Wish::HideOthers(id) => session.hide_others(id),
        Wish::ShowAll => session.show_all(),
    }
}

/// The notes of the import: what was left out, repaired or decided.
fn skipped(ui: &mut egui::Ui, skipped: &[String]) {
    let title = format!("Notes ({})", skipped.len());
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
