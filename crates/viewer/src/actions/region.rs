//! The render region: draws a rectangle and drags its edges.

use crate::model::region::Grip;
use crate::model::tool::Tool;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use eframe::egui::{self, CursorIcon, PointerButton, Pos2};
use glam::DVec2;

/// Distance within which an edge can be dragged, in points.
const REACH: f32 = 6.0;
/// Minimum size of a region, in pixels of the picture.
const LEAST: f64 = 4.0;

/// Handles the mouse for the region. Returns whether it is consumed.
pub fn drag(session: &mut Session, response: &egui::Response, viewport: Viewport) -> bool {
    let (pointer, pressed_at) =
        (response.ctx).input(|input| (input.pointer.interact_pos(), input.pointer.press_origin()));
    let share = |point: Pos2| viewport.position(point) / viewport.extent();
    if let Some(grip) = session.tool_state.region {
        if let Some(to) = pointer {
            let region = Some(grip.region(share(to)));
            if session.view.region != region {
                session.view.region = region;
                session.moved();
            }
        }
        if !response.dragged() {
            finish(session, viewport);
        }
        return true;
    }
    let region = session.view.region;
    if response.drag_started_by(PointerButton::Primary)
        && let Some(from) = pressed_at.or(pointer)
    {
        let at = share(from);
        session.tool_state.region = match region.and_then(|region| edges(region, from, viewport)) {
            Some(follows) => region.map(|start| Grip {
                start,
                follows,
                from: at,
            }),
            None if session.tool == Tool::Region => Some(Grip {
                start: [at.x, at.y, at.x, at.y],
                follows: [false, false, true, true],
                from: at,
            }),
            None => None,
        };
        return session.tool_state.region.is_some();
    }
    if let Some(at) = response.hover_pos() {
        let follows = region.and_then(|region| edges(region, at, viewport));
        match follows {
            Some(follows) => response.ctx.set_cursor_icon(cursor(follows)),
            None if session.tool == Tool::Region => {
                response.ctx.set_cursor_icon(CursorIcon::Crosshair);
            }
            None => {}
        }
    }
    false
}

/// Sorts the edges and discards a region that is too small.
fn finish(session: &mut Session, viewport: Viewport) {
    session.tool_state.region = None;
    let Some([x0, y0, x1, y1]) = session.view.region else {
        return;
    };
    let size = DVec2::new((x1 - x0).abs(), (y1 - y0).abs()) * viewport.extent();
    if size.min_element() < LEAST {
        session.view.region = None;
        return;
    }
    session.view.region = Some([x0.min(x1), y0.min(y1), x0.max(x1), y0.max(y1)]);
    if session.tool == Tool::Region {
        session.tool = Tool::Select;
    }
}

/// The edges of a region within reach of a point.
fn edges([x0, y0, x1, y1]: [f64; 4], at: Pos2, viewport: Viewport) -> Option<[bool; 4]> {
    let extent = viewport.extent();
    let corner = |x: f64, y: f64| viewport.point(DVec2::new(x, y) * extent);
    let rect = egui::Rect::from_two_pos(corner(x0, y0), corner(x1, y1));
    let near = |a: f32, b: f32| (a - b).abs() <= REACH;
    let follows = [
        near(at.x, rect.min.x),
        near(at.y, rect.min.y),
        near(at.x, rect.max.x),
        near(at.y, rect.max.y),
    ];
    let is_on = rect.expand(REACH).contains(at) && follows.contains(&true);
    is_on.then_some(follows)
}

fn cursor(follows: [bool; 4]) -> CursorIcon {
    match follows {
        [true, true, ..] | [.., true, true] => CursorIcon::ResizeNwSe,
        [true, _, _, true] | [_, true, true, _] => CursorIcon::ResizeNeSw,
        [true, ..] | [_, _, true, _] => CursorIcon::ResizeHorizontal,
        _ => CursorIcon::ResizeVertical,
    }
}
