//! The list of kept pictures: number, thumbnail and name of each, and buttons that rename and remove it.

use super::told;
use crate::actions::comparing;
use crate::model::bindings::Action;
use crate::model::gallery::{Still, StillId};
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::icon;
use crate::ui::thumbnails::{self, color_image};
use eframe::egui::{
    self, Align2, Color32, FontId, Key, Layout, Rect, Sense, TextEdit, Ui, WidgetInfo, pos2, vec2,
};

/// Height of a line, widths of the number and the thumbnail, and the space between them, in points.
const HEIGHT: f32 = 34.0;
const NUMBER: f32 = 18.0;
const THUMBNAIL: f32 = 44.0;
const GAP: f32 = 4.0;

/// Draws the list.
pub fn list(ui: &mut Ui, context: &mut PanelContext) {
    let session = &mut *context.session;
    let stills = session.comparing.gallery.all().to_vec();
    for still in &stills {
        line(ui, session, still);
    }
}

/// One picture. A click flips to it, or back.
fn line(ui: &mut Ui, session: &mut Session, still: &Still) {
    let size = vec2(ui.available_width(), HEIGHT);
    let layout = Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        buttons(ui, session, still);
        let width = ui.available_width().max(0.0);
        let is_renamed =
            (session.comparing.renaming.as_ref()).is_some_and(|(id, _)| *id == still.id);
        let sense = if is_renamed {
            Sense::hover()
        } else {
            Sense::click()
        };
        let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), sense);
        let is_shown = comparing::flipped(session) == Some(still.id);
        let fill = match (is_shown, response.hovered() && !is_renamed) {
            (true, _) => ui.visuals().selection.bg_fill,
            (false, true) => ui.visuals().widgets.hovered.weak_bg_fill,
            (false, false) => Color32::TRANSPARENT,
        };
        ui.painter().rect_filled(rect, 3.0, fill);
        let (number, rest) = rect.split_left_right_at_x(rect.min.x + NUMBER);
        let (picture, name) = rest.split_left_right_at_x(rest.min.x + THUMBNAIL);
        let color = match is_shown {
            true => ui.visuals().selection.stroke.color,
            false => ui.visuals().text_color(),
        };
        let font = FontId::proportional(13.0);
        let text = still.number.to_string();
        let painter = ui.painter();
        painter.text(number.center(), Align2::CENTER_CENTER, text, font, color);
        thumbnail(ui, still, picture.shrink2(vec2(0.0, 2.0)));
        let name = Rect::from_min_max(name.min + vec2(GAP, 0.0), name.max);
        if is_renamed {
            rename(ui, session, still.id, name);
        } else {
            write(ui, name, &still.name, color);
            let told_name = format!("{}: {}", still.number, still.name);
            response.widget_info(|| {
                WidgetInfo::selected(egui::Role::Button, ui.is_enabled(), is_shown, &told_name)
            });
            let response = response.on_hover_text(tip(session, still));
            if response.double_clicked() {
                begin_renaming(session, still);
            } else if response.clicked() {
                comparing::flip_to(session, still.number);
            }
        }
    });
}

/// The effect of a click, with its key, and what the picture is.
fn tip(session: &Session, still: &Still) -> String {
    let flip = "Flip between this picture and the present one";
    let flip = match Action::kept(still.number) {
        Some(action) => session.preferences.bindings.tip(flip, action),
        None => flip.to_owned(),
    };
    format!("{flip}\n{}\n{}", still.name, told(still))
}

/// The buttons, from the right.
fn buttons(ui: &mut Ui, session: &mut Session, still: &Still) {
    let name = &still.name;
    let button = ui.button("×").on_hover_text("Forget this picture");
    icon::named(&button, &format!("Remove: {name}"));
    if button.clicked() {
        comparing::remove(session, still.id);
        thumbnails::forget(ui.ctx(), texture_of(still.id));
    }
    let button = ui.button("✏").on_hover_text("Rename this picture");
    icon::named(&button, &format!("Rename: {name}"));
    if button.clicked() {
        begin_renaming(session, still);
    }
}

fn begin_renaming(session: &mut Session, still: &Still) {
    session.comparing.renaming = Some((still.id, still.name.clone()));
}

/// The field of a new name: Enter keeps it, and Escape does not.
fn rename(ui: &mut Ui, session: &mut Session, still: StillId, rect: Rect) {
    let Some((_, name)) = &mut session.comparing.renaming else {
        return;
    };
    let height = ui.spacing().interact_size.y;
    let rect = Rect::from_center_size(rect.center(), vec2(rect.width(), height));
    let edit = ui.put(rect, TextEdit::singleline(name).id_salt("kept picture"));
    icon::named(&edit, "New name of the picture");
    if edit.lost_focus() {
        let is_kept = !ui.input(|input| input.key_pressed(Key::Escape));
        let name = std::mem::take(name);
        session.comparing.renaming = None;
        if is_kept {
            session.comparing.gallery.rename(still, &name);
        }
    } else if !edit.has_focus() {
        edit.request_focus();
    }
}

/// Writes a text in one line, with an ellipsis where it is too long.
fn write(ui: &Ui, rect: Rect, text: &str, color: Color32) {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width());
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let y = rect.center().y - galley.size().y / 2.0;
    ui.painter().galley(pos2(rect.min.x, y), galley, color);
}

/// Where egui keeps the texture of a thumbnail.
fn texture_of(still: StillId) -> egui::Id {
    egui::Id::unique(("kept picture", still))
}

/// Draws the small picture, in the middle of `space`.
fn thumbnail(ui: &Ui, still: &Still, space: Rect) {
    let small = || Some(color_image(&still.thumbnail));
    let Some(texture) = thumbnails::kept(ui.ctx(), texture_of(still.id), small) else {
        return;
    };
    let size = texture.size_vec2();
    let share = (space.size() / size).min_elem();
    let rect = Rect::from_center_size(space.center(), size * share);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter()
        .image(texture.id(), rect, whole, Color32::WHITE);
}
