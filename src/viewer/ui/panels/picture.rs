//! The picture, and the camera under the mouse.

mod compare;
mod legend;
mod start;

use crate::viewer::actions::inspector;
use crate::viewer::actions::region;
use crate::viewer::actions::tools;
use crate::viewer::model::viewport::Viewport;
use crate::viewer::ui::context::PanelContext;
use crate::viewer::ui::overlay;
use crate::viewer::ui::panels::rays;
use crate::viewer::worker::progressive_image::PictureSlot;
use crate::viewer::worker::progressive_image::Shown;
use eframe::egui::{self, Color32, Pos2, Rect, Vec2};

/// Texture coordinates of a whole texture.
const WHOLE: Rect = Rect {
    min: Pos2::ZERO,
    max: Pos2::new(1.0, 1.0),
};

/// The rest of the picture while only a region is rendered.
const DIMMED: Color32 = Color32::from_gray(90);

/// Draws the picture so far, and what it is compared with, and hands the mouse to the tools.
pub fn picture(ui: &mut egui::Ui, context: &mut PanelContext) {
    let pixels_per_point = ui.ctx().pixels_per_point();
    let space = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(space, egui::Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Rendered picture"));
    let comparison = context.session.view.comparison;
    let spaces = compare::spaces(comparison, space);
    let pixels = (spaces[0].size() * pixels_per_point).max(Vec2::splat(1.0));
    (context.session).set_space((pixels.x as u32, pixels.y as u32));
    let size = context.session.picture_size();
    let viewports = spaces.map(|space| Viewport::fitting(space, size, pixels_per_point));
    context.session.viewport = Some(viewports[0]);
    let painter = ui.painter_at(space);
    let shown = context.shown(PictureSlot::Main);
    let covered = match (&shown, comparison) {
        (Some(shown), None) if is_opaque(shown) => viewports[0].rect,
        _ => Rect::NOTHING,
    };
    surround(&painter, space, covered, ui.visuals().extreme_bg_color);
    if let Some(shown) = shown {
        draw(&painter, context, &shown, viewports[0]);
    }
    if let (Some(comparison), Some(shown)) = (comparison, context.shown(PictureSlot::Beside)) {
        let clip = compare::clip(comparison.sharing, space, viewports[1]);
        draw(&painter.with_clip_rect(clip), context, &shown, viewports[1]);
    }
    let is_right =
        spaces[0] != spaces[1] && used_at(&response).is_some_and(|point| spaces[1].contains(point));
    let viewport = viewports[usize::from(is_right)];
    context.session.viewport = Some(viewport);
    let is_taken = region::follow(context.session, &response, viewport)
        || overlay::overlay(context.session, &response, &painter, viewport);
    if !is_taken {
        inspector::follow(context.session, &response, viewport);
        tools::navigate(context.session, &response, viewport);
    }
    rays::mark(&painter, context.session, viewports[0]);
    context.session.viewport = Some(viewports[0]);
    compare::overlay(ui, context, space, viewports);
    if context.session.shows_overlays {
        legends(ui, context, space, viewports);
    }
    if context.session.is_empty() {
        start::start(ui, context.session, space);
    }
}

/// What the levels of the pictures stand for.
fn legends(ui: &egui::Ui, context: &PanelContext, space: Rect, viewports: [Viewport; 2]) {
    let painter = ui.painter_at(space);
    let look = &context.session.view;
    let rects = viewports.map(|viewport| viewport.rect.intersect(space));
    if let Some(shown) = context.shown(PictureSlot::Main) {
        let integrator = look.settings.integrator;
        legend::legend(ui, &painter, &shown, integrator, (rects[0], false));
    }
    if let (Some(comparison), Some(shown)) = (look.comparison, context.shown(PictureSlot::Beside)) {
        let place = (rects[1], true);
        legend::legend(ui, &painter, &shown, comparison.integrator, place);
    }
}

/// Of two pictures side by side the mouse is in one: as long as a button is down in that where it was
/// pressed.
fn used_at(response: &egui::Response) -> Option<Pos2> {
    let origin = response.ctx.input(|input| input.pointer.press_origin());
    let id = response.id.with("pressed at");
    // It is over in the frame in which the button is let go, and a drag is not yet.
    let before = response.ctx.data_mut(|data| {
        let before: Option<Option<Pos2>> = data.get_temp(id);
        data.insert_temp(id, origin);
        before.flatten()
    });
    origin.or(before).or(response.hover_pos())
}

/// Whether every pixel of the picture shows something. On software each layer that is not drawn beneath is
/// time for the picture.
fn is_opaque(shown: &Shown) -> bool {
    let is_whole = shown.whole.is_none() && shown.region == [0, 0, shown.size.0, shown.size.1];
    is_whole && (shown.under_is_coarse || has_samples(shown))
}

/// Whether every pixel of the fine picture has a sample.
fn has_samples(shown: &Shown) -> bool {
    let progress = &shown.progress;
    progress.samples > 0 && !progress.is_coarse && shown.screen.is_some()
}

/// Fills what of `space` is not in `covered`.
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
    let region = viewport.part(shown.region);
    if let Some(whole) = &shown.whole {
        let id = context.textures.id(whole, true);
        painter.image(id, viewport.rect, WHOLE, DIMMED);
    }
    // A picture of other proportions than there is room for by now is stretched until the next one.
    let under = shown.under.as_ref().filter(|_| !has_samples(shown));
    for (screen, is_smooth) in [(under, true), (shown.screen.as_ref(), !is_exact)] {
        if let Some(screen) = screen {
            let id = context.textures.id(screen, is_smooth);
            painter.image(id, region, WHOLE, Color32::WHITE);
        }
    }
    if context.session.view.region.is_some() {
        overlay::region_outline(painter, viewport, shown.region);
    }
}
