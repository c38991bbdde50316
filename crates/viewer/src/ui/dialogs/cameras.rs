//! The dialog of bookmarked views: a small picture of each; rename, go to, delete.

use crate::actions::files::cameras::{self, View};
use crate::model::preferences::{THUMBNAIL, Thumbnail};
use crate::state::session::Session;
use crate::ui::thumbnails;
use eframe::egui::{
    self, Align2, Color32, ColorImage, FontId, Rect, Response, Sense, TextEdit, TextureHandle, Ui,
    WidgetInfo, pos2, vec2,
};

/// Size of the small pictures, in points.
const PICTURE: egui::Vec2 = vec2(0.8 * THUMBNAIL[0] as f32, 0.8 * THUMBNAIL[1] as f32);

/// Draws the dialog. Returns whether it stays open.
pub fn show(ctx: &egui::Context, session: &mut Session) -> bool {
    let kept: Vec<_> = cameras::all(session)
        .into_iter()
        .filter(|view| view.is_bookmark)
        .collect();
    let mut names = std::mem::take(&mut session.dialogs.names);
    let mut rename = None;
    let stays = crate::ui::dialogs::window(ctx, "Bookmarked views", vec2(420.0, 360.0), |ui| {
        if kept.is_empty() {
            ui.weak("No bookmarks yet. Use View › Cameras › Bookmark view.");
        } else {
            ui.weak("A click or a number goes there.");
        }
        egui::ScrollArea::vertical().show(ui, |ui| {
            for (index, view) in kept.iter().enumerate() {
                ui.horizontal(|ui| {
                    if picture(ui, view, index).clicked() {
                        cameras::go(session, view);
                    }
                    let name = &view.name;
                    let text = names.entry(name.clone()).or_insert_with(|| name.clone());
                    let field = ui.add(TextEdit::singleline(text).desired_width(170.0));
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

/// The small picture of a bookmark with its number.
fn picture(ui: &mut Ui, view: &View, index: usize) -> Response {
    let (rect, response) = ui.allocate_exact_size(PICTURE, Sense::CLICK | Sense::HOVER);
    let name = format!("Picture of {}", view.name);
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &name));
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, ui.visuals().extreme_bg_color);
    match view.picture.as_ref().and_then(|it| texture(ui.ctx(), it)) {
        Some(texture) => {
            let size = texture.size_vec2();
            let scale = (rect.width() / size.x).min(rect.height() / size.y);
            let place = Rect::from_center_size(rect.center(), scale * size);
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture.id(), place, whole, Color32::WHITE);
        }
        None => {
            _ = painter.text(
                rect.center(),
                Align2::CENTER_CENTER,
                "No picture",
                FontId::proportional(12.0),
                ui.visuals().weak_text_color(),
            )
        }
    }
    if index < cameras::NUMBERS.len() {
        let number = (index + 1).to_string();
        let font = FontId::proportional(12.0);
        let galley = painter.layout_no_wrap(number, font, Color32::WHITE);
        let corner = rect.left_top() + vec2(3.0, 2.0);
        let back = Rect::from_min_size(corner, galley.size()).expand2(vec2(3.0, 0.0));
        painter.rect_filled(
            back.translate(vec2(2.0, 1.0)),
            3.0,
            Color32::from_black_alpha(190),
        );
        painter.galley(corner + vec2(2.0, 1.0), galley, Color32::WHITE);
    }
    let edge = match response.hovered() {
        true => ui.visuals().widgets.hovered.fg_stroke,
        false => ui.visuals().widgets.noninteractive.bg_stroke,
    };
    painter.rect_stroke(rect, 3.0, edge, egui::StrokeKind::Inside);
    response.on_hover_text(format!("Go to {}", view.name))
}

/// The texture of a small picture, which stays as long as the window; `None` if its file is damaged.
fn texture(ctx: &egui::Context, thumbnail: &Thumbnail) -> Option<TextureHandle> {
    let id = egui::Id::unique(("bookmark", thumbnail));
    thumbnails::kept(ctx, id, || {
        let pixels = thumbnail.pixels()?;
        let size = [pixels.width() as usize, pixels.height() as usize];
        Some(ColorImage::from_rgb(size, pixels.as_raw()))
    })
}
