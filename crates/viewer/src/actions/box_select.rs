//! Selects what is in a rectangle that is drawn in the picture.

use crate::actions::sight;
use crate::actions::tools::BUTTONS;
use crate::model::bindings::Action;
use crate::model::camera::project;
use crate::model::objects::{self, Id};
use crate::model::tool::{BoxDrag, BoxMode, Tool};
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use crate::state::sight::Boxed;
use eframe::egui::{self, Modifiers, PointerButton};
use glam::{DVec2, DVec3};
use glimray_scene::{Geometry, LightKind, ObjectRef, Scene};
use std::collections::BTreeSet;

/// Handles the mouse for a rectangle. Returns whether it is consumed.
pub fn drag(session: &mut Session, response: &egui::Response, viewport: Viewport) -> bool {
    let (pointer, pressed_at, modifiers) = response.ctx.input(|input| {
        let pointer = &input.pointer;
        (
            pointer.interact_pos(),
            pointer.press_origin(),
            input.modifiers,
        )
    });
    if let Some(drag) = &mut session.tool_state.frame {
        drag.to = pointer.unwrap_or(drag.to);
        drag.mode = mode(modifiers);
        let drag = *drag;
        if !response.dragged() {
            session.tool_state.frame = None;
            session.sight.boxed = Some(Boxed {
                corners: [drag.from, drag.to].map(|point| viewport.position(point)),
                mode: drag.mode,
                subject: sight::subject(session),
            });
            go_on(session);
            // The answer may come in a later frame.
            response.ctx.request_repaint();
        }
        return true;
    }
    let started = BUTTONS.into_iter().find(|button| {
        let is_tool = session.tool == Tool::Box && *button == PointerButton::Primary;
        let bindings = &session.preferences.bindings;
        let is_bound = || bindings.drag(*button, modifiers) == Some(Action::SelectBox);
        response.drag_started_by(*button) && (is_tool || is_bound())
    });
    if let (Some(_), Some(from)) = (started, pressed_at.or(pointer)) {
        session.tool_state.frame = Some(BoxDrag {
            from,
            to: pointer.unwrap_or(from),
            mode: mode(modifiers),
        });
        return true;
    }
    if session.tool == Tool::Box && response.hovered() {
        response.ctx.set_cursor_icon(egui::CursorIcon::Crosshair);
    }
    false
}

fn mode(modifiers: Modifiers) -> BoxMode {
    match (modifiers.shift, modifiers.command || modifiers.ctrl) {
        (_, true) => BoxMode::Remove,
        (true, false) => BoxMode::Add,
        (false, false) => BoxMode::Only,
    }
}

/// Selects what is in the rectangle that was drawn last, once it is known what the pixels show. Another view drops it.
pub fn go_on(session: &mut Session) {
    let Some(boxed) = &session.sight.boxed else {
        return;
    };
    let drawn_in = boxed.subject.as_ref().zip(sight::subject(session));
    if !drawn_in.is_some_and(|(drawn, now)| drawn.looks_like(&now)) {
        session.sight.boxed = None;
        return (session.messages)
            .notify("The view has changed, so the box selects nothing. Draw it again");
    }
    let (Some(seen), Some(scene)) = (sight::current(session), session.scene().cloned()) else {
        return;
    };
    let Some(Boxed {
        corners: [a, b],
        mode,
        ..
    }) = session.sight.boxed.take()
    else {
        return;
    };
    let mut found = seen.sight.objects_in(a, b);
    // A ground without end lies behind nearly everything.
    let is_plane = |object: &ObjectRef| {
        matches!(*object, ObjectRef::Shape(index)
            if matches!(scene.shapes[index].geometry, Geometry::Plane { .. }))
    };
    if !found.iter().all(is_plane) {
        found.retain(|object| !is_plane(object));
    }
    let mut ids: Vec<Id> = found.into_iter().map(Id::Object).collect();
    ids.extend(points_in(session, &scene, a.min(b), a.max(b)));
    choose(session, ids, mode);
}

/// The lamps that are not seen as a surface, and the cameras, whose places are in a rectangle of the picture.
fn points_in(session: &Session, scene: &Scene, min: DVec2, max: DVec2) -> Vec<Id> {
    let (Some(camera), Some(viewport)) = (session.camera(), session.viewport) else {
        return Vec::new();
    };
    let time = session.playback.time;
    let is_in = |point: DVec3| {
        let at = project(&camera, point, viewport.extent());
        at.is_some_and(|at| at.cmpge(min).all() && at.cmple(max).all())
    };
    let lights = scene.frame(time).lights.into_iter().enumerate();
    let lights = lights.filter_map(|(index, light)| {
        let id = Id::Object(ObjectRef::Light(index));
        let is_surface = light.kind.radiance().is_some() && light.visible;
        if is_surface || matches!(light.kind, LightKind::Directional { .. }) {
            return None;
        }
        let place = objects::of_light(&light.kind).translation;
        (is_in(place) && objects::is_visible(scene, id)).then_some(id)
    });
    let cameras = scene.cameras_at(time).into_iter().enumerate();
    let cameras = cameras.filter(|(_, other)| *other != camera && is_in(other.look_from));
    lights
        .chain(cameras.map(|(index, _)| Id::Camera(index)))
        .collect()
}

fn choose(session: &mut Session, found: Vec<Id>, mode: BoxMode) {
    let mut selected = session.selected();
    match mode {
        BoxMode::Only => selected = found,
        BoxMode::Add => {
            let known: BTreeSet<_> = selected.iter().copied().collect();
            selected.extend(found.into_iter().filter(|id| !known.contains(id)));
        }
        BoxMode::Remove => {
            let found: BTreeSet<_> = found.into_iter().collect();
            selected.retain(|id| !found.contains(id));
        }
    }
    let told = match selected.as_slice() {
        [] => "Nothing is selected".to_owned(),
        ids => format!("Selected {}", session.labels(ids)),
    };
    session.messages.notify(told);
    session.select(selected);
}
