//! The ray view: the scene from a second camera, with the rays of a pixel.

use crate::actions::inspector::hidden;
use crate::actions::inspector::outside;
use crate::actions::inspector::outside::Line;
use crate::actions::tools;
use crate::model::bindings::{Action, Drag};
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::panels::rays::drawing;
use crate::worker::progressive_image::PictureSlot;
use eframe::egui::{self, Color32, Pos2, Rect, Stroke, Vec2};
use glam::{DVec2, dvec2};
use glimray_render::{Integrator, RayKind};

/// Tint of the picture, so that rays stand out.
const DIMMED: Color32 = Color32::from_gray(132);
/// Distance within which a ray can be picked, in points.
const REACH: f32 = 6.0;

/// Draws the picture of the second camera with the rays, and handles the mouse.
pub fn outside(ui: &mut egui::Ui, context: &mut PanelContext) {
    if context.session.inspector.inspected.is_none() {
        ui.add_space(12.0);
        ui.vertical_centered(|ui| ui.weak("Inspect a pixel to see its rays here."));
        return;
    }
    egui::Panel::bottom("outside")
        .frame(egui::Frame::NONE.inner_margin(egui::Margin::symmetric(8, 4)))
        .show(ui, |ui| controls(ui, context.session));
    let pixels_per_point = ui.ctx().pixels_per_point();
    let space = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(space, egui::Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Rays in space"));
    let pixels = (space.size() * pixels_per_point).max(Vec2::splat(1.0));
    let size = (pixels.x as u32, pixels.y as u32);
    let viewport = Viewport::fitting(space, size, pixels_per_point);
    let painter = ui.painter_at(space);
    painter.rect_filled(space, 0.0, Color32::from_gray(24));
    let shown = context.shown(PictureSlot::Outside);
    let is_done = (shown.as_ref()).is_some_and(|it| it.progress.is_done && !it.progress.is_coarse);
    if let Some(shown) = shown {
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        for screen in [&shown.under, &shown.screen].into_iter().flatten() {
            let id = context.textures.id(screen, true);
            painter.image(id, viewport.rect, whole, DIMMED);
        }
    }
    let session = &mut *context.session;
    session.inspector.outside.space = Some(size);
    session.inspector.outside.viewport = Some(viewport);
    if is_done && !session.is_moving() {
        hidden::ask(session);
    }
    let lines = lines(session, viewport);
    draw_camera(&painter, session, viewport);
    let has_normals = session.inspector.outside.normals;
    drawing::draw(&painter, session, &lines, viewport, has_normals);
    pick(session, &response, viewport, &lines);
    navigate(session, &response, viewport);
}

/// The rays in the picture of the second camera.
fn lines(session: &Session, viewport: Viewport) -> Vec<Line> {
    let inspector = &session.inspector;
    let (Some(inspected), Some(controller)) = (&inspector.inspected, &inspector.outside.controller)
    else {
        return Vec::new();
    };
    let reach = inspector.outside.reach();
    let (size, hidden) = (viewport.extent(), hidden::known(session));
    let camera = controller.camera();
    outside::lines(inspected, &inspector.filter, &camera, size, reach, hidden)
}

/// Draws the frustum of the inspected picture's camera.
fn draw_camera(painter: &egui::Painter, session: &Session, viewport: Viewport) {
    let inspector = &session.inspector;
    let (Some(inspected), Some(controller)) = (&inspector.inspected, &inspector.outside.controller)
    else {
        return;
    };
    let first = inspected.camera();
    let (width, height) = inspected.request.settings.size;
    let size = dvec2(width.into(), height.into());
    let depth = 0.12 * controller.scene_radius();
    let extent = viewport.extent();
    for (from, to) in outside::frustum(&first, size, depth, &controller.camera(), extent) {
        let ends = [from, to].map(|end| viewport.point(end));
        painter.line_segment(ends, Stroke::new(3.0, Color32::from_black_alpha(120)));
        painter.line_segment(ends, Stroke::new(1.0, Color32::from_gray(190)));
    }
}

/// Highlights the ray under the cursor; a click selects it.
fn pick(session: &mut Session, response: &egui::Response, viewport: Viewport, lines: &[Line]) {
    let position = |point: Pos2| viewport.position(point);
    let reach = viewport.length(Vec2::splat(REACH)).x;
    let under = |point: DVec2| outside::nearest(lines, point, reach);
    let Some(id) = response.hover_pos().map(position).and_then(under) else {
        return;
    };
    session.inspector.hovers = Some(id);
    if response.clicked() {
        session.inspector.select(id);
    }
}

/// Navigates with the second camera, by the same bindings.
fn navigate(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    let ctx = &response.ctx;
    let (modifiers, pointer) = ctx.input(|input| (input.modifiers, input.pointer.interact_pos()));
    let bindings = &session.preferences.bindings;
    let wheel = match response.hovered() {
        true => ctx.input(|input| bindings.wheel(input)),
        false => Vec::new(),
    };
    let outside = &mut session.inspector.outside;
    let Some(controller) = &mut outside.controller else {
        return;
    };
    for button in [
        egui::PointerButton::Primary,
        egui::PointerButton::Middle,
        egui::PointerButton::Secondary,
    ] {
        if response.drag_started_by(button)
            && let (Some(from), Some(action)) = (pointer, bindings.drag(button, modifiers))
        {
            outside.drag = Some(Drag { action, from });
        }
    }
    if let (Some(drag), Some(to)) = (outside.drag, pointer) {
        let from = to - response.drag_delta();
        if from != to {
            tools::move_camera(controller, drag, viewport, from, to);
        }
        if response.drag_stopped() || !response.dragged() {
            outside.drag = None;
        }
    }
    for (action, steps) in wheel {
        let at = pointer
            .filter(|_| action == Action::ZoomToCursor)
            .map(|point| controller.point_at(viewport.position(point), viewport.extent()));
        controller.zoom(steps, at);
    }
}

/// Camera, display options and the colour key.
fn controls(ui: &mut egui::Ui, session: &mut Session) {
    ui.horizontal_wrapped(|ui| {
        let frame = ui.button("Frame rays");
        if (frame.on_hover_text("Frame all rays")).clicked() {
            let bounds = session.bounds();
            outside::frame(session, bounds);
        }
        let same = ui.button("From the camera");
        if (same.on_hover_text("Match the camera of the picture")).clicked()
            && let (Some(camera), Some(controller)) =
                (session.camera(), &mut session.inspector.outside.controller)
        {
            controller.go_to(&camera);
        }
        let outside = &mut session.inspector.outside;
        ui.checkbox(&mut outside.normals, "Normals")
            .on_hover_text("Draw the surface normal where a ray ends");
        ui.checkbox(&mut outside.plain, "Plain")
            .on_hover_text("Shade the scene by its normals, without lighting");
    });
    let inspected = session.inspector.inspected.as_ref();
    let is_path = inspected.is_some_and(|it| it.tree.integrator == Integrator::Path);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let kinds = [
            (RayKind::Primary, false, "primary"),
            (RayKind::Reflection, false, "reflection"),
            (RayKind::Refraction, false, "refraction"),
            (RayKind::Passage, false, "passage"),
            (RayKind::Shadow, false, "unblocked"),
            (RayKind::Shadow, true, "blocked"),
        ];
        // Only paths tell what goes straight on from what is refracted.
        let is_shown = |kind: RayKind| is_path || kind != RayKind::Passage;
        for (kind, blocked, name) in kinds.into_iter().filter(|(kind, ..)| is_shown(*kind)) {
            crate::ui::panels::rays::paint::icon(ui, kind, blocked);
            ui.label(egui::RichText::new(name).small());
        }
    });
}
