//! The tools along the left edge of the picture, and its view mode, overlays, comparison, region and camera along the
//! upper one.

use crate::model::bindings::Action;
use crate::model::document::Document;
use crate::model::overlays::Overlays;
use crate::model::tool::{Tool, ToolMenu};
use crate::model::view_settings::Sharing;
use crate::state::session::Session;
use crate::ui::panels::render::view_mode;
use crate::ui::panels::sign::{SIDE, Sign, button};
use eframe::egui::{self, Frame, Margin, Popup, Rect, Sense, Ui, UiBuilder, Vec2, pos2, vec2};

/// Width of the bar on the left and height of the upper one, with the space around them, in points.
const BAR: f32 = 40.0;
/// Smallest picture that has both bars, in points.
const LEAST: Vec2 = vec2(270.0, 300.0);
/// Smallest picture whose bars have all buttons, in points.
const ROOMY: Vec2 = vec2(350.0, 340.0);
/// Smallest picture that has the upper bar, with its most important buttons, in points.
const LEAST_UPPER: Vec2 = vec2(184.0, 110.0);
/// Distance from the edges of the picture, in points.
const MARGIN: f32 = 6.0;

/// The bars of a picture.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bars {
    None,
    /// The upper one, with few buttons.
    Upper,
    Both,
}

/// The bars that a picture of this size has.
fn bars(session: &Session, space: Rect) -> Bars {
    let fits = |least: Vec2| space.size().min(least) == least;
    let is_wanted = session.shows_overlays && !session.files.is_posing();
    match is_wanted && session.scene().is_some() {
        true if fits(LEAST) => Bars::Both,
        true if fits(LEAST_UPPER) => Bars::Upper,
        _ => Bars::None,
    }
}

/// Whether both bars are shown in a picture of this size.
pub fn is_shown(session: &Session, space: Rect) -> bool {
    bars(session, space) == Bars::Both
}

/// The part of the picture that the bars leave free.
pub fn room(session: &Session, space: Rect) -> Rect {
    let taken = match bars(session, space) {
        Bars::None => Vec2::ZERO,
        Bars::Upper => vec2(0.0, BAR),
        Bars::Both => Vec2::splat(BAR),
    };
    Rect::from_min_max(space.min + taken, space.max)
}

/// Draws the bars.
pub fn toolbar(ui: &mut Ui, session: &mut Session, space: Rect) {
    let bars = bars(session, space);
    if bars == Bars::None {
        return;
    }
    let corner = space.min + Vec2::splat(MARGIN);
    let upper = Rect::from_min_max(corner, pos2(space.max.x - MARGIN, corner.y));
    let has_room = bars == Bars::Both;
    let is_wide = has_room && space.width() >= ROOMY.x;
    bar(ui, upper, |ui| {
        ui.horizontal(|ui| view(ui, session, has_room, is_wide))
            .inner
    });
    if !has_room {
        return;
    }
    let left = Rect::from_min_max(
        corner + vec2(0.0, BAR),
        pos2(corner.x + BAR, space.max.y - MARGIN),
    );
    bar(ui, left, |ui| {
        tools(ui, session);
        if space.height() >= ROOMY.y {
            history(ui, session);
        }
    });
}

/// A bar over the picture, which takes the clicks between its buttons.
fn bar(ui: &mut Ui, rect: Rect, contents: impl FnOnce(&mut Ui)) {
    let builder = UiBuilder::new()
        .max_rect(rect)
        .layout(egui::Layout::top_down(egui::Align::Min));
    ui.scope_builder(builder, |ui| {
        let fill = ui.visuals().panel_fill.gamma_multiply(0.92);
        let frame = Frame::new().fill(fill).corner_radius(6.0);
        frame.inner_margin(Margin::same(2)).show(ui, |ui| {
            let sensed = UiBuilder::new().sense(Sense::CLICK | Sense::DRAG);
            ui.scope_builder(sensed, |ui| {
                ui.spacing_mut().item_spacing = Vec2::splat(2.0);
                contents(ui);
            });
        });
    });
}

/// The effect of a command and its shortcut.
fn tip(session: &Session, action: Action) -> String {
    (session.preferences.bindings).tip(action.description(), action)
}

fn tools(ui: &mut Ui, session: &mut Session) {
    for &tool in Tool::ALL {
        if tool.entry().menu == ToolMenu::Edit {
            let is_active = session.tool == tool;
            let title = tool.entry().title;
            let response = button(ui, Sign::Tool(tool), title, is_active, true);
            if response
                .on_hover_text(tip(session, Action::Tool(tool)))
                .clicked()
            {
                // The shortcut of such a tool may start a movement.
                match tool.entry().has_handles {
                    true => session.tool = tool,
                    false => session.clicked.push(Action::Tool(tool)),
                }
            }
        }
    }
}

/// Undo and redo.
fn history(ui: &mut Ui, session: &mut Session) {
    ui.add_space(4.0);
    let document = session.document.as_ref();
    let undo = document.and_then(Document::undo_name).map(str::to_owned);
    let redo = document.and_then(Document::redo_name).map(str::to_owned);
    for (action, sign, text, name) in [
        (Action::Undo, Sign::Undo, "Undo", undo),
        (Action::Redo, Sign::Redo, "Redo", redo),
    ] {
        let response = button(ui, sign, text, false, name.is_some());
        let told = match name {
            Some(name) => format!("{text} {name}"),
            None => format!("Nothing to {}", text.to_lowercase()),
        };
        let response = response.on_disabled_hover_text(&told);
        let keys = tip(session, action);
        if response.on_hover_text(format!("{told}\n{keys}")).clicked() {
            session.clicked.push(action);
        }
    }
}

/// The upper bar. Without room it has neither the name of the view mode nor the render region, and only where it `is_wide` the
/// less important buttons.
fn view(ui: &mut Ui, session: &mut Session, has_room: bool, is_wide: bool) {
    // As high as the other buttons.
    ui.spacing_mut().interact_size.y = SIDE;
    let mut shown = view_mode::shown(&session.view);
    let name = match has_room {
        true => view_mode::name(shown),
        false => "View".to_owned(),
    };
    let menu = ui.menu_button(format!("{name} ⏷"), |ui| {
        let height = ui.ctx().content_rect().height() - 120.0;
        egui::ScrollArea::vertical()
            .min_scrolled_height(height)
            .max_height(height)
            .show(ui, |ui| view_mode::list(ui, &mut shown));
    });
    menu.response.on_hover_text("What is shown");
    view_mode::show(&mut session.view, shown);
    let response = button(ui, Sign::Overlays, "Overlays", true, true);
    if response
        .on_hover_text(tip(session, Action::ToggleOverlays))
        .clicked()
    {
        session.clicked.push(Action::ToggleOverlays);
        let key = session.preferences.bindings.label(Action::ToggleOverlays);
        let how = match key.is_empty() {
            true => "Window › Overlays shows them again".to_owned(),
            false => format!("{key} shows them again"),
        };
        session
            .messages
            .notify(format!("Overlays are hidden. {how}"));
    }
    if is_wide {
        overlays(ui, session);
    }
    compare(ui, session);
    if has_room {
        region(ui, session);
    }
    if is_wide {
        snapping(ui, session);
    }
    camera(ui, session);
}

fn region(ui: &mut Ui, session: &mut Session) {
    let region = Action::Tool(Tool::Region);
    let is_active = session.tool == Tool::Region || session.view.region.is_some();
    let response = button(
        ui,
        Sign::Tool(Tool::Region),
        "Render region",
        is_active,
        true,
    );
    if response.on_hover_text(tip(session, region)).clicked() {
        session.clicked.push(region);
    }
}

fn snapping(ui: &mut Ui, session: &mut Session) {
    let response = button(
        ui,
        Sign::Snapping,
        "Snapping",
        session.preferences.snaps,
        true,
    );
    let text = tip(session, Action::ToggleSnapping);
    let told = format!("{text}\nSteps of the grid, 15° and 0.1; Shift makes them finer.");
    if response.on_hover_text(told).clicked() {
        session.clicked.push(Action::ToggleSnapping);
    }
}

/// The menu of what is drawn over the picture.
fn overlays(ui: &mut Ui, session: &mut Session) {
    let response = ui.add(egui::Button::new("⏷").min_size(vec2(14.0, SIDE)));
    let name = "Choose overlays";
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    let response = response.on_hover_text("Choose what is drawn over the picture");
    let mut chosen = None;
    let stays = egui::PopupCloseBehavior::CloseOnClickOutside;
    Popup::menu(&response).close_behavior(stays).show(|ui| {
        for entry in Overlays::ALL {
            let is_shown = session
                .preferences
                .overlays
                .of(entry.action)
                .is_some_and(|it| *it);
            let key = session.preferences.bindings.label(entry.action);
            let entry_button = egui::Button::selectable(is_shown, entry.title).shortcut_text(key);
            let response = ui.add(entry_button).accessible_name(entry.title);
            if response.on_hover_text(entry.action.description()).clicked() {
                chosen = Some(entry.action);
            }
        }
    });
    session.clicked.extend(chosen);
}

fn compare(ui: &mut Ui, session: &mut Session) {
    let sharing = session.view.comparison.map(|comparison| comparison.sharing);
    let response = button(ui, Sign::Compare, "Comparison", sharing.is_some(), true);
    let response = response.on_hover_text("Show a second picture");
    let mut chosen = None;
    Popup::menu(&response).show(|ui| {
        if ui.selectable_label(sharing.is_none(), "Off").clicked() {
            chosen = Some(None);
        }
        for (text, way) in Sharing::offered() {
            let is_so = sharing.is_some_and(|now| now.is_like(way));
            if ui.selectable_label(is_so, text).clicked() && !is_so {
                chosen = Some(Some(way));
            }
        }
    });
    match chosen {
        Some(Some(sharing)) => session.view.compare(sharing),
        Some(None) => session.view.comparison = None,
        None => {}
    }
}

fn camera(ui: &mut Ui, session: &mut Session) {
    let response = button(ui, Sign::Camera, "Camera", false, true);
    let response = response.on_hover_text("Views of the scene");
    let mut chosen = None;
    Popup::menu(&response).show(|ui| {
        for (text, action) in [
            ("Scene camera", Action::Home),
            ("Frame all", Action::FrameAll),
            ("Frame selection", Action::FrameSelection),
            ("Perspective or orthographic", Action::ToggleOrthographic),
            ("Bookmark view", Action::SaveCamera),
        ] {
            let key = session.preferences.bindings.label(action);
            let entry = ui.add(egui::Button::new(text).shortcut_text(key));
            if entry.on_hover_text(action.description()).clicked() {
                chosen = Some(action);
            }
        }
    });
    session.clicked.extend(chosen);
}
