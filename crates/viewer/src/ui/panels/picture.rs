//! The picture panel, with camera navigation by mouse.

mod caption;
mod checker;
mod compare;
mod dropping;
mod framing;
mod gizmo;
mod legend;
pub mod loading;
mod menu;
mod start;
mod toolbar;
mod values;

use crate::actions::box_select;
use crate::actions::region;
use crate::actions::tools;
use crate::model::camera::CameraController;
use crate::model::tool::Tool;
use crate::model::view_settings::{Comparison, Sharing};
use crate::model::viewport::Viewport;
use crate::state::cursor::REST;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::{self, overlay};
use crate::worker::progressive_image::PictureSlot;
use crate::worker::progressive_image::Shown;
use eframe::egui::{self, Align2, Color32, Pos2, Rect, Vec2};
use glimray_render::Shows;

/// Texture coordinates of a whole texture.
const WHOLE: Rect = Rect {
    min: Pos2::ZERO,
    max: Pos2::new(1.0, 1.0),
};

/// Tint of the picture outside the rendered region.
const DIMMED: Color32 = Color32::from_gray(90);

/// Draws the picture and its comparison, and passes the mouse to the tools.
pub fn picture(ui: &mut egui::Ui, context: &mut PanelContext) {
    let pixels_per_point = ui.ctx().pixels_per_point();
    let space = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(space, egui::Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Rendered picture"));
    menu::menu(ui, context.session);
    let comparison = context.session.view.comparison;
    let spaces = compare::spaces(comparison, space);
    let pixels = (spaces[0].size() * pixels_per_point).max(Vec2::splat(1.0));
    (context.session).set_space((pixels.x as u32, pixels.y as u32));
    let size = context.session.picture_size();
    let zoom = context.session.pixel_zoom;
    let is_scaled = context.session.is_scaled_to_room();
    let place = match is_scaled {
        true => Viewport::filling,
        false => Viewport::fitting,
    };
    let viewports = spaces.map(|space| zoom.of(place(space, size, pixels_per_point)));
    context.session.viewport = Some(viewports[0]);
    let painter = ui.painter_at(space);
    let shown = context.shown(PictureSlot::Main);
    let covered = match (&shown, comparison) {
        (Some(shown), None) => covered(shown, viewports[0]),
        _ => Rect::NOTHING,
    };
    surround(&painter, space, covered, ui.visuals().extreme_bg_color);
    if let Some(shown) = shown {
        if context.session.view.settings.has_opacity() {
            checker::checker(&painter, viewports[0].rect.intersect(space));
        }
        draw(&painter, context, &shown, viewports[0]);
        if comparison.is_none() {
            values::values(&painter, context, &shown, viewports[0]);
        }
    }
    if let Some(comparison) = comparison {
        compare::second(&painter, context, comparison, space, viewports[1]);
    }
    let is_right =
        spaces[0] != spaces[1] && used_at(&response).is_some_and(|point| spaces[1].contains(point));
    let viewport = viewports[usize::from(is_right)];
    context.session.viewport = Some(viewport);
    hover(context, &response, viewport, space);
    ui::ground::draw(context.session, &painter, viewport);
    dropping::dropping(context.session, &response, viewport);
    let is_taken = region::drag(context.session, &response, viewport)
        || overlay::overlay(context.session, &response, &painter, viewport)
        || ui::section_handle::handle(context.session, &response, &painter, viewport)
        || box_select::drag(context.session, &response, viewport);
    if !is_taken {
        tools::navigate(context.session, &response, viewport);
    }
    for (index, viewport) in viewports.into_iter().enumerate() {
        // With a divider, both pictures are at the same place.
        if index == 0 || spaces[0] != spaces[1] {
            let painter = painter.with_clip_rect(spaces[index]);
            ui::tools::draw(&painter, context.session, viewport);
        }
    }
    context.session.viewport = Some(viewports[0]);
    let room = toolbar::room(context.session, space);
    compare::overlay(ui, context, (space, room), viewports);
    if context.session.shows_overlays {
        legends(ui, context, space, viewports);
        frames(ui, context, space, viewports);
    }
    cursor(context.session, &response);
    if toolbar::is_shown(context.session, space) {
        gizmo::gizmo(ui, context.session, room);
    }
    toolbar::toolbar(ui, context.session, space);
    if is_scaled && context.session.until_fitted().is_none() && !context.session.files.is_posing() {
        scaled(ui, context, room);
    }
    loading::loading(ui, context, space);
    if context.session.is_empty() {
        start::start(ui, context.session, space);
    }
}

/// Tools that pick a point have a cross as their cursor.
fn cursor(session: &Session, response: &egui::Response) {
    let is_framed = session.tool_state.frame.is_some();
    let is_taken = session.editing.is_held() || session.drag.is_some() || is_framed;
    if response.hovered() && !is_taken && matches!(session.tool, Tool::Inspect | Tool::Measure) {
        response.ctx.set_cursor_icon(egui::CursorIcon::Crosshair);
    }
}

/// Notes the pixel under the cursor for the status bar.
fn hover(context: &mut PanelContext, response: &egui::Response, viewport: Viewport, space: Rect) {
    let session = &mut *context.session;
    let point = response.hover_pos().filter(|point| space.contains(*point));
    let is_in_main = point.is_some_and(|point| match session.view.comparison {
        Some(Comparison {
            sharing: Sharing::Wipe(share),
            ..
        }) => point.x < viewport.rect.min.x + share * viewport.rect.width(),
        Some(Comparison {
            sharing: Sharing::SideBySide,
            ..
        }) => point.x < space.center().x,
        Some(_) | None => true,
    });
    let pixel = point.and_then(|point| viewport.pixel(point));
    let now = session.now;
    if session.cursor.hover(pixel, is_in_main, now) {
        // The renderer is asked by the frame after the cursor has come to rest.
        response.ctx.request_repaint_after_secs(REST as f32);
    }
}

/// The colour legends of the pictures.
fn legends(ui: &egui::Ui, context: &PanelContext, space: Rect, viewports: [Viewport; 2]) {
    let painter = ui.painter_at(space);
    let look = &context.session.view;
    let comparison = look.comparison;
    if comparison.is_some_and(|comparison| comparison.error_map().is_some()) {
        return;
    }
    let rects = viewports.map(|viewport| viewport.rect.intersect(space));
    if let Some(shown) = context.shown(PictureSlot::Main) {
        let integrator = look.settings.integrator;
        match look.false_color && integrator.entry().shows == Shows::Radiance {
            true => legend::stops_of_light(ui, &painter, (rects[0], false)),
            false => legend::legend(ui, &painter, &shown, integrator, (rects[0], false)),
        }
    }
    let second = comparison.and_then(|comparison| comparison.integrator());
    if let (Some(integrator), Some(shown)) = (second, context.shown(PictureSlot::Beside)) {
        legend::legend(ui, &painter, &shown, integrator, (rects[1], true));
    }
}

/// Shows the scene's framing where the picture has the proportions of the window.
fn frames(ui: &egui::Ui, context: &PanelContext, space: Rect, viewports: [Viewport; 2]) {
    let session = &context.session;
    let is_home = (session.controller.as_ref()).is_some_and(CameraController::is_home);
    // A picture of the scene's size has another camera.
    let is_fitted = is_home && session.is_fitted();
    if !session.view.fits || session.scene().is_none() || is_fitted {
        return;
    }
    let painter = ui.painter_at(space);
    let size = session.view.scene_settings.size;
    framing::framing(ui, &painter, viewports[0], size);
    if viewports[0] != viewports[1] {
        framing::framing(ui, &painter, viewports[1], size);
    }
}

/// Says that the picture is scaled, and offers to render it at the size of its room.
fn scaled(ui: &egui::Ui, context: &mut PanelContext, space: Rect) {
    let (width, height) = context.session.picture_size();
    egui::Area::new(egui::Id::unique("scaled picture"))
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(space.center_top() + Vec2::new(0.0, 8.0))
        .constrain_to(space)
        .show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.label(format!("Showing {width}×{height}"));
                    let button = ui.button("Re-render to fit");
                    let tip =
                        "Render the picture again at the size of the window. Its samples are lost.";
                    if button.on_hover_text(tip).clicked() {
                        context.session.take_room();
                    }
                });
            });
        });
}

/// The picture that the mouse belongs to, of two side by side: the one under it, or while a button is held, the
/// one where it was pressed.
fn used_at(response: &egui::Response) -> Option<Pos2> {
    let origin = response.ctx.input(|input| input.pointer.press_origin());
    let id = response.id.with("pressed at");
    // The press origin is gone in the frame of the release, while the drag still continues.
    let before = response.ctx.data_mut(|data| {
        let before: Option<Option<Pos2>> = data.get_temp(id);
        data.insert_temp(id, origin);
        before.flatten()
    });
    origin.or(before).or(response.hover_pos())
}

/// The part of the viewport where every pixel is opaque. On software, each layer that is not drawn below
/// saves time.
fn covered(shown: &Shown, viewport: Viewport) -> Rect {
    let is_whole = shown.whole.is_none() && shown.region == [0, 0, shown.size.0, shown.size.1];
    let under = shown.under.as_ref().filter(|_| shown.under_is_coarse);
    match (is_whole, under) {
        (false, _) => Rect::NOTHING,
        (true, _) if has_samples(shown) => viewport.rect,
        (true, Some(under)) => viewport.rect.intersect(viewport.under(under.size())),
        (true, None) => Rect::NOTHING,
    }
}

/// Whether every pixel of the full-resolution picture has a sample.
fn has_samples(shown: &Shown) -> bool {
    let progress = &shown.progress;
    progress.samples > 0 && !progress.is_coarse && shown.screen.is_some()
}

/// Fills `space` outside `covered`.
fn surround(painter: &egui::Painter, space: Rect, covered: Rect, color: Color32) {
    let covered = covered.intersect(space);
    if !covered.is_positive() {
        painter.rect_filled(space, 0.0, color);
        return;
    }
    let band = |y: f32, height: f32| {
        let min = Pos2::new(space.min.x, y);
        Rect::from_min_size(min, Vec2::new(space.width(), height))
    };
    let rows = Rect::from_x_y_ranges(space.x_range(), covered.y_range());
    for rect in [
        band(space.min.y, covered.min.y - space.min.y),
        band(covered.max.y, space.max.y - covered.max.y),
        rows.with_max_x(covered.min.x),
        rows.with_min_x(covered.max.x),
    ] {
        if rect.is_positive() {
            painter.rect_filled(rect, 0.0, color);
        }
    }
}

fn draw(painter: &egui::Painter, context: &mut PanelContext, shown: &Shown, viewport: Viewport) {
    let is_exact = viewport.is_exact(painter.pixels_per_point());
    let is_crisp = is_exact || context.session.pixel_zoom.is_active();
    let region = viewport.part(shown.region);
    if let Some(whole) = &shown.whole {
        let id = context.textures.id(whole, true);
        painter.image(id, viewport.rect, WHOLE, DIMMED);
    }
    let under = shown.under.as_ref().filter(|_| !has_samples(shown));
    if let Some(under) = under {
        let is_part = shown.region != [0, 0, shown.size.0, shown.size.1];
        let rect = match is_part {
            true => region,
            false => viewport.under(under.size()),
        };
        let id = context.textures.id(under, true);
        let painter = painter.with_clip_rect(viewport.rect);
        painter.image(id, rect, WHOLE, Color32::WHITE);
    }
    if let Some(screen) = &shown.screen {
        let id = context.textures.id(screen, !is_crisp);
        painter.image(id, region, WHOLE, Color32::WHITE);
    }
    if context.session.view.region.is_some() {
        ui::region::outline(painter, viewport, shown.region);
    }
}
