//! The comparison of two pictures: layout, second picture, wipe line and labels.

use crate::model::view_settings::{Comparison, ErrorMap, Measure, Sharing, Source};
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::icon;
use crate::ui::panels::picture::caption::label;
use crate::ui::panels::picture::legend;
use crate::ui::panels::picture::{WHOLE, draw};
use crate::ui::panels::setting_rows::title;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui::{
    self, Align2, Color32, CursorIcon, EventFilter, Key, Pos2, Rect, Stroke, pos2, vec2,
};
use glimray_app::value_names::INTEGRATORS;

/// Distance within which the line can be dragged, in points.
const REACH: f32 = 5.0;
/// Step of an arrow key, as a fraction of the picture's width.
const STEP: f32 = 0.02;

/// The areas of both pictures.
pub fn spaces(comparison: Option<Comparison>, space: Rect) -> [Rect; 2] {
    match comparison {
        Some(Comparison {
            sharing: Sharing::SideBySide,
            ..
        }) => {
            let (left, right) = space.split_left_right_at_fraction(0.5);
            [left, right]
        }
        _ => [space, space],
    }
}

/// Draws the second picture, or the difference of both.
pub fn second(
    painter: &egui::Painter,
    context: &mut PanelContext,
    comparison: Comparison,
    space: Rect,
    viewport: Viewport,
) {
    let painter = painter.with_clip_rect(clip(comparison.sharing, space, viewport));
    let is_exact = viewport.is_exact(painter.pixels_per_point());
    let is_zoomed = context.session.pixel_zoom.is_active();
    if comparison.error_map().is_some() {
        if let Some(difference) = context.render.difference() {
            let is_part = difference.region != [0, 0, viewport.size.0, viewport.size.1];
            let rect = match is_part {
                true => viewport.part(difference.region),
                false => viewport.under(difference.screen.size()),
            };
            let is_crisp = is_zoomed || is_exact && !difference.is_coarse;
            let id = context.textures.id(&difference.screen, !is_crisp);
            painter.image(id, rect, WHOLE, Color32::WHITE);
        }
    } else if !matches!(comparison.source, Source::Still(_)) {
        if let Some(shown) = context.shown(PictureSlot::Beside) {
            draw(&painter, context, &shown, viewport);
        }
    } else if let Some(screen) = context.render.still() {
        let is_crisp = is_zoomed || is_exact && screen.size() == viewport.size;
        let id = context.textures.id(&screen, !is_crisp);
        let painter = painter.with_clip_rect(viewport.rect);
        painter.image(id, viewport.framing(screen.size()), WHOLE, Color32::WHITE);
    }
}

/// The area in which the second picture is drawn.
fn clip(sharing: Sharing, space: Rect, viewport: Viewport) -> Rect {
    match sharing {
        Sharing::SideBySide | Sharing::Difference(_) => space,
        Sharing::Wipe(share) => {
            let mut right = viewport.rect;
            right.min.x += right.width() * share;
            right
        }
    }
}

/// Draws the wipe line, which can be dragged, and the labels in the corners.
pub fn overlay(
    ui: &mut egui::Ui,
    context: &mut PanelContext,
    (space, room): (Rect, Rect),
    viewports: [Viewport; 2],
) {
    let names = [
        title(INTEGRATORS.name(&context.session.view.settings.integrator)),
        second_name(context.session),
    ];
    let Some(comparison) = &mut context.session.view.comparison else {
        return;
    };
    let painter = ui.painter_at(space);
    let corners = match &mut comparison.sharing {
        Sharing::Difference(map) => {
            let map = *map;
            let picture = viewports[0].rect.intersect(room);
            difference(ui, &painter, context, (names, map), picture);
            return;
        }
        Sharing::Wipe(share) => {
            let rect = viewports[0].rect.intersect(space);
            let y_range = rect.y_range();
            let line = Rect::from_x_y_ranges(viewports[0].rect.x_range(), y_range);
            wipe(ui, &painter, share, line);
            let rect = rect.intersect(room);
            [rect.left_top(), rect.right_top()]
        }
        Sharing::SideBySide => {
            let middle = space.center_top();
            let line = [middle, space.center_bottom()];
            painter.line_segment(line, Stroke::new(1.0, Color32::from_gray(128)));
            viewports.map(|viewport| viewport.rect.intersect(room).left_top())
        }
    };
    let is_wipe = matches!(comparison.sharing, Sharing::Wipe(_));
    let right = if is_wipe {
        Align2::RIGHT_TOP
    } else {
        Align2::LEFT_TOP
    };
    let [first, second] = names;
    if let Sharing::Wipe(share) = comparison.sharing
        && share <= 0.0
    {
        // The second picture hides the first.
        label(&painter, corners[0], Align2::LEFT_TOP, second);
        return;
    }
    label(&painter, corners[0], Align2::LEFT_TOP, first);
    label(&painter, corners[1], right, second);
}

/// The name of the second picture, with the size of a still that is scaled.
fn second_name(session: &Session) -> String {
    match session.view.comparison.map(|comparison| comparison.source) {
        Some(Source::Integrator(integrator)) => title(INTEGRATORS.name(&integrator)),
        Some(Source::Raw) => "Without denoising".to_owned(),
        _ => session.still().map_or(String::new(), |still| {
            let (width, height) = still.size();
            match still.size() == session.picture_size() {
                true => still.name.clone(),
                false => format!("{}, scaled from {width}×{height}", still.name),
            }
        }),
    }
}

/// Names both pictures, tells how much they differ, and explains the colours.
fn difference(
    ui: &egui::Ui,
    painter: &egui::Painter,
    context: &PanelContext,
    ([first, second], map): ([String; 2], ErrorMap),
    picture: Rect,
) {
    let rect = picture.intersect(painter.clip_rect());
    let title = match map.measure {
        Measure::Flip => "FLIP".to_owned(),
        measure => measure.title().to_lowercase(),
    };
    let gain = match (map.gain * 10.0).round() / 10.0 {
        gain if gain > 1.0 || map.measure == Measure::Absolute => format!(" × {gain}"),
        _ => String::new(),
    };
    let names = format!("{first} and {second}: {title}{gain}");
    label(painter, rect.left_top(), Align2::LEFT_TOP, names);
    let shown = context.render.difference();
    // The last one may be of another measure.
    let Some(shown) = shown.filter(|shown| shown.measure == map.measure) else {
        return;
    };
    let (rmse, mean) = (shown.rmse, shown.mean);
    let told = match map.measure {
        Measure::Absolute => {
            let levels = rmse * 255.0;
            format!("RMSE {rmse:.4} ({levels:.2} levels), mean {mean:.4}")
        }
        measure => {
            let name = measure.mean();
            format!("{name} {mean:.6}")
        }
    };
    let rect = label(
        painter,
        rect.left_bottom(),
        Align2::LEFT_BOTTOM,
        told.clone(),
    );
    let id = ui.scope_id().with("difference");
    let response = ui.interact(rect, id, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &told));
    icon::named(&response, &told);
    response.on_hover_text(match map.measure {
        Measure::Absolute => {
            "Differences of the displayed colours, without the gain: root mean square and mean, as fractions of \
             white"
                .to_owned()
        }
        measure => format!("{}. The mean of all pixels, without the gain", measure.help()),
    });
    if map.measure != Measure::Absolute {
        // Above the mean.
        let above = Rect::from_min_max(picture.min, pos2(picture.max.x, rect.min.y + 4.0));
        legend::errors(ui, painter, map, above);
    }
}

/// The wipe line: dragged, or moved by arrow keys while it has the focus.
fn wipe(ui: &mut egui::Ui, painter: &egui::Painter, share: &mut f32, rect: Rect) {
    let at = |share: f32| rect.min.x + rect.width() * share;
    let area = Rect::from_center_size(
        Pos2::new(at(*share), rect.center().y),
        vec2(2.0 * REACH, rect.height()),
    );
    let id = ui.scope_id().with("wipe");
    let response = ui.interact(area, id, egui::Sense::click_and_drag());
    if let Some(pointer) = response
        .interact_pointer_pos()
        .filter(|_| response.dragged())
    {
        *share = (pointer.x - rect.min.x) / rect.width().max(1.0);
    }
    if response.clicked() {
        response.request_focus();
    }
    let has_focus = response.has_focus();
    if has_focus {
        let filter = EventFilter {
            horizontal_arrows: true,
            ..EventFilter::default()
        };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id, filter));
        let steps = ui.input_mut(|input| {
            let count = |key, input: &mut egui::InputState| {
                input.count_and_consume_key(egui::Modifiers::NONE, key) as f32
            };
            count(Key::ArrowRight, input) - count(Key::ArrowLeft, input)
        });
        *share += steps * STEP;
    }
    *share = share.clamp(0.0, 1.0);
    let percent = f64::from(*share) * 100.0;
    response.widget_info(|| egui::WidgetInfo::slider(true, percent, "Comparison wipe"));
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    let is_taken = response.hovered() || response.dragged() || has_focus;
    let x = at(*share);
    let (top, bottom) = (Pos2::new(x, rect.min.y), Pos2::new(x, rect.max.y));
    let dark = Color32::from_black_alpha(140);
    painter.line_segment([top, bottom], Stroke::new(3.0, dark));
    painter.line_segment([top, bottom], Stroke::new(1.0, Color32::WHITE));
    let knob = Pos2::new(x, rect.center().y);
    let radius = if is_taken { 9.0 } else { 7.0 };
    painter.circle(knob, radius, dark, Stroke::new(1.5, Color32::WHITE));
    for side in [-1.0, 1.0] {
        let tip = knob + vec2(side * (radius - 3.0), 0.0);
        for y in [-2.5, 2.5] {
            let end = tip + vec2(-side * 2.5, y);
            painter.line_segment([tip, end], Stroke::new(1.2, Color32::WHITE));
        }
    }
    if has_focus {
        painter.circle_stroke(knob, radius + 2.5, ui.visuals().selection.stroke);
    }
}
