//! The menu of the point under the cursor.

use crate::actions::inspector;
use crate::model::bindings::Action;
use crate::model::objects::{self, Id};
use crate::model::tool::Tool;
use crate::state::picture_menu::PictureMenu;
use crate::state::session::Session;
use eframe::egui::containers::menu::menu_style;
use eframe::egui::{Align, Button, Id as WidgetId, Layout, Popup, PopupKind, Response, Ui};

/// Draws the menu, if it is open.
pub fn menu(ui: &Ui, session: &mut Session) {
    let Some(mut menu) = session.picture_menu.take() else {
        return;
    };
    let ctx = ui.ctx();
    let id = WidgetId::unique("picture menu");
    if std::mem::take(&mut menu.is_new) {
        Popup::open_id(ctx, id);
    }
    let popup = Popup::new(id, ctx.clone(), menu.at, ui.layer_id());
    let popup = popup.kind(PopupKind::Menu).open_memory(None);
    let popup = popup
        .layout(Layout::top_down_justified(Align::Min))
        .style(menu_style);
    let shown = popup.show(|ui| entries(ui, session, &menu));
    if shown.is_some() && Popup::is_id_open(ctx, id) {
        session.picture_menu = Some(menu);
    }
}

fn entries(ui: &mut Ui, session: &mut Session, menu: &PictureMenu) {
    let selection = session.selection.filter(|_| menu.point.is_some());
    let is_there = selection.is_some();
    if let Some(id) = selection {
        ui.weak(session.label(id));
    }
    command(ui, session, (is_there, "Frame"), Action::FrameSelection);
    let focus = entry(
        ui,
        session,
        (menu.point.is_some(), "Focus here"),
        Action::FocusHere,
    );
    if let (true, Some(point), Some(controller)) =
        (focus.clicked(), menu.point, &mut session.controller)
    {
        controller.focus_on(point);
    }
    let rays = Action::Tool(Tool::Inspect);
    if entry(ui, session, (true, "Inspect rays"), rays).clicked() {
        session.clicked.push(rays);
        inspector::inspect(session, menu.pixel);
    }
    let material = material(session, selection);
    let text = Button::new("Material");
    let tip = "Show the material of the object in the properties";
    let shows_material = ui.add_enabled(material.is_some(), text).on_hover_text(tip);
    if let (true, Some(id)) = (shows_material.clicked(), material) {
        session.select(vec![id]);
    }
    command(ui, session, (is_there, "Hide"), Action::ToggleVisible);
    ui.separator();
    command(ui, session, (true, "Copy picture"), Action::CopyPicture);
    command(ui, session, (true, "Save picture…"), Action::SavePicture);
    ui.separator();
    command(ui, session, (is_there, "Duplicate"), Action::Duplicate);
    command(ui, session, (is_there, "Delete"), Action::Delete);
}

/// The first material of an object.
fn material(session: &Session, id: Option<Id>) -> Option<Id> {
    let Some(Id::Object(object)) = id else {
        return None;
    };
    let used = objects::materials_of(session.scene()?, object);
    used.first().copied().map(Id::Material)
}

/// An entry that performs a command.
fn command(ui: &mut Ui, session: &mut Session, label: (bool, &str), action: Action) {
    if entry(ui, session, label, action).clicked() {
        session.clicked.push(action);
    }
}

/// An entry that can be disabled, with the shortcut of its command.
fn entry(
    ui: &mut Ui,
    session: &Session,
    (enabled, text): (bool, &str),
    action: Action,
) -> Response {
    let keys = session.preferences.bindings.shortcut(action);
    ui.add_enabled(enabled, Button::new(text).shortcut_text(keys))
        .on_hover_text(action.description())
        .accessible_name(text)
}
