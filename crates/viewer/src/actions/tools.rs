//! The mouse in the picture: the active tool, and camera navigation.

use crate::actions::editing::camera_in_world;
use crate::actions::surface::surface_at;
use crate::actions::{inspector, lighting, materials, measuring, modal};
use crate::model::bindings::{Action, Drag};
use crate::model::camera::CameraController;
use crate::model::objects::Id;
use crate::model::tool::{Purpose, Tool};
use crate::model::viewport::Viewport;
use crate::state::answer::Answer;
use crate::state::layout::Layout;
use crate::state::picture_menu::PictureMenu;
use crate::state::session::Session;
use crate::worker::progressive_image::Progress;
use eframe::egui::{self, LayerId, PointerButton, Pos2, Vec2};
use glam::{DVec2, DVec3};
use glimray_scene::ObjectRef;

/// All mouse buttons.
pub const BUTTONS: [PointerButton; 5] = [
    PointerButton::Primary,
    PointerButton::Middle,
    PointerButton::Secondary,
    PointerButton::Extra1,
    PointerButton::Extra2,
];

/// Activates a tool.
pub fn activate(session: &mut Session, layout: &mut Layout, tool: Tool) {
    match tool {
        Tool::Move | Tool::Rotate | Tool::Scale => modal::activate(session, tool),
        Tool::Inspect => inspector::open(session, layout),
        Tool::Region if session.view.region.take().is_some() => session.tool = Tool::Select,
        Tool::Measure => {
            session.tool_state.measured.clear();
            session.tool_state.kept.clear();
            session.tool = tool;
        }
        Tool::Select | Tool::Box | Tool::Region => session.tool = tool,
    }
}

/// Whether the tool or its effect is active.
pub fn is_active(session: &Session, tool: Tool) -> bool {
    session.tool == tool || tool == Tool::Region && session.view.region.is_some()
}

/// Passes the mouse in the picture to the active tool and to the camera. Input consumed by a tool or a handle does not get here.
pub fn navigate(session: &mut Session, response: &egui::Response, viewport: Viewport) {
    inspector::inspect_hovered(session, response, viewport);
    let ctx = &response.ctx;
    let (modifiers, pointer, pressed) = ctx.input(|input| {
        let pointer = &input.pointer;
        (
            input.modifiers,
            pointer.interact_pos(),
            pointer.press_origin(),
        )
    });
    let bindings = session.preferences.bindings.clone();
    for button in BUTTONS {
        if response.drag_started_by(button)
            && let (Some(from), Some(action)) =
                (pressed.or(pointer), bindings.drag(button, modifiers))
        {
            session.drag = Some(Drag { action, from });
            session.camera_history.end_gesture();
            if action == Action::TurnLight {
                lighting::begin_turn(session);
            }
        }
        if response.double_clicked_by(button) {
            click(session, bindings.double_click(button, modifiers), pointer);
        } else if response.clicked_by(button) {
            click(session, bindings.click(button, modifiers), pointer);
        }
    }
    if !session.clicked.is_empty() {
        ctx.request_repaint();
    }
    if let (Some(drag), Some(to)) = (session.drag, pointer) {
        let from = to - response.drag_delta();
        if from != to && drag.action == Action::TurnLight {
            lighting::turn(session, to - drag.from, viewport);
        } else if from != to
            && let Some(controller) = &mut session.controller
        {
            move_camera(controller, drag, viewport, from, to);
            session.moved();
        }
        if response.drag_stopped() {
            session.drag = None;
        }
    }
    if response.hovered() {
        let turned = ctx.input(|input| bindings.wheel(input));
        wheel(session, &turned, pointer, viewport);
    }
}

fn wheel(
    session: &mut Session,
    turned: &[(Action, f64)],
    pointer: Option<Pos2>,
    viewport: Viewport,
) {
    for &(action, steps) in turned {
        if action == Action::PixelZoom {
            pixel_zoom(session, steps, pointer);
        } else if let Some(controller) = &mut session.controller {
            let at = pointer
                .filter(|_| action == Action::ZoomToCursor)
                .map(|point| controller.point_at(viewport.position(point), viewport.extent()));
            controller.zoom(steps, at);
            session.moved();
        }
    }
}

/// Magnifies the picture round a point of the screen, or round its middle if the point is not in it.
pub fn pixel_zoom(session: &mut Session, steps: f64, pointer: Option<Pos2>) {
    let Some(viewport) = session.viewport else {
        return;
    };
    let position = pointer.map(|point| viewport.position(point) / viewport.extent());
    let is_inside = |at: &DVec2| at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::ONE).all();
    let at = position.filter(is_inside).unwrap_or(DVec2::splat(0.5));
    let at = Vec2::new(at.x as f32, at.y as f32);
    session.pixel_zoom.zoom(steps, at);
}

/// Moves the camera by a drag from one point of the screen to another.
pub fn move_camera(
    controller: &mut CameraController,
    drag: Drag,
    viewport: Viewport,
    from: Pos2,
    to: Pos2,
) {
    let size = viewport.extent();
    let (start, end) = (viewport.position(from), viewport.position(to));
    let moved = end - start;
    match drag.action {
        Action::Orbit => controller.orbit(moved, size),
        Action::Pan => controller.pan(start, end, size, None),
        Action::LookAround => controller.look(moved, size),
        Action::Zoom => controller.drag_zoom(moved, size, None),
        Action::ZoomToCursor => {
            let at = controller.point_at(viewport.position(drag.from), size);
            controller.drag_zoom(moved, size, Some(at));
        }
        _ => {}
    }
}

/// Performs a command at the point under the cursor.
pub fn pick_under_cursor(session: &mut Session, action: Action, ctx: &egui::Context) {
    let pointer = ctx.pointer_hover_pos();
    let pointer = pointer.filter(|point| ctx.layer_id_at(*point) == Some(LayerId::background()));
    let pixel = (pointer.zip(session.viewport)).and_then(|(point, view)| view.pixel(point));
    match pointer.zip(pixel) {
        Some((point, pixel)) => pick(session, action, point, pixel),
        None => (session.messages).notify("Move the cursor over the picture first"),
    }
}

/// The command of a click; a click without modifiers belongs to the tool.
fn click(session: &mut Session, action: Option<Action>, pointer: Option<Pos2>) {
    let pixel = (pointer.zip(session.viewport)).and_then(|(point, view)| view.pixel(point));
    match (action, pointer.zip(pixel)) {
        (Some(action), Some((point, pixel))) if is_pick(action) => {
            pick(session, action, point, pixel);
        }
        (Some(action), _) if !is_pick(action) => session.clicked.push(action),
        _ => {}
    }
}

fn is_pick(action: Action) -> bool {
    matches!(
        action,
        Action::SetPivot | Action::FocusHere | Action::Select | Action::PictureMenu
    )
}

/// Performs a command at a point of the screen, which shows that pixel.
fn pick(session: &mut Session, action: Action, point: Pos2, pixel: [u32; 2]) {
    let focuses = match action {
        Action::Select => session.tool_state.focuses.take(),
        _ => None,
    };
    let purpose = match (action, focuses) {
        (Action::PictureMenu, _) => {
            session.picture_menu = Some(PictureMenu::new(point, pixel));
            Purpose::Menu
        }
        (Action::SetPivot, _) => Purpose::Pivot,
        (Action::FocusHere, _) => Purpose::Focus,
        (_, Some(index)) => Purpose::FocusOf(index),
        (_, None) => match session.tool {
            Tool::Inspect => {
                inspector::inspect(session, pixel);
                return;
            }
            Tool::Measure => Purpose::Measure(pixel),
            Tool::Select | Tool::Box | Tool::Region | Tool::Move | Tool::Rotate | Tool::Scale => {
                Purpose::Select
            }
        },
    };
    session.ask(move |frame| surface_at(frame, pixel, purpose));
}

/// Asks once what the middle of the picture shows, for the pivot of a camera that aims at no point. The first sample comes
/// first: the answer may need a kernel that is not compiled yet.
pub fn aim(session: &mut Session, progress: &Progress) {
    let is_home = (session.controller.as_ref()).is_some_and(CameraController::is_home);
    let is_seen = progress.samples > 0 && !progress.is_coarse;
    if !is_seen || !is_home || session.is_moving() || !std::mem::take(&mut session.owes_aim) {
        return;
    }
    session.ask(|frame| {
        let (width, height) = frame.settings().size;
        match surface_at(frame, [width / 2, height / 2], Purpose::Aim) {
            // The middle lies outside the rendered region.
            Answer::Failed(_) => Answer::Nothing,
            answer => answer,
        }
    });
}

/// Handles a pick: its point in world space and its object, or `None` for the background.
pub fn picked(session: &mut Session, purpose: Purpose, hit: Option<(DVec3, Option<ObjectRef>)>) {
    match (purpose, hit) {
        (Purpose::Pivot, Some((point, _))) => {
            if let Some(controller) = &mut session.controller {
                controller.recentre(point);
            }
        }
        (Purpose::Aim, hit) => {
            if let (Some(controller), Some((point, _))) = (&mut session.controller, hit) {
                controller.aim_at(point);
            }
        }
        (Purpose::Focus, Some((point, _))) => {
            if let Some(controller) = &mut session.controller {
                controller.focus_on(point);
            }
        }
        (Purpose::FocusOf(index), Some((point, _))) => focus(session, index, point),
        (Purpose::AimLamp, hit) => lighting::aim_at(session, hit),
        (Purpose::Select, hit) => {
            let object = hit.and_then(|(_, object)| object).map(Id::Object);
            session.select(object.into_iter().collect());
        }
        (Purpose::Menu, hit) => {
            let object = hit.and_then(|(_, object)| object).map(Id::Object);
            // A menu of one of several that are selected is about all of them.
            if let Some(id) = object.filter(|id| !session.is_selected(*id)) {
                session.select(vec![id]);
            }
            if let Some(menu) = &mut session.picture_menu {
                menu.point = hit.map(|(point, _)| point);
            }
        }
        (Purpose::Hover, hit) => materials::hovered(session, hit.and_then(|(_, object)| object)),
        (Purpose::Assign(material), Some((_, Some(object)))) => {
            materials::assign(session, material, object);
        }
        (Purpose::Measure(pixel), hit) => measuring::picked(session, pixel, hit),
        (_, None) | (Purpose::Assign(_), _) => {
            session.messages.notify("Nothing is under the cursor")
        }
    }
}

/// Focuses a camera of the scene on the depth of a point in world space.
fn focus(session: &mut Session, index: usize, point: DVec3) {
    let Some(scene) = session.scene().filter(|scene| index < scene.cameras.len()) else {
        return;
    };
    let camera = camera_in_world(scene, index, session.playback.time);
    let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
    let distance = (point - camera.look_from).dot(forward);
    if distance <= 0.0 {
        (session.messages).notify("The point is behind the camera");
        return;
    }
    session.change("change focus of the camera", |scene| {
        if let (Some(own), Some(lens)) = (&mut scene.cameras[index].lens, camera.lens) {
            // Nodes may scale.
            own.focus_distance *= distance / lens.focus_distance;
        }
        Ok(())
    });
}
