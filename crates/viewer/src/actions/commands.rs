//! Dispatches all commands, whether from keys, menus or buttons.

use crate::actions::keyboard::Keyboard;
use crate::actions::{
    adding, comparing, dialogs, editing, files, lighting, measuring, modal, saving, selecting,
    tools, walk,
};
use crate::model::bindings::Action;
use crate::model::camera::{CameraController, CameraHistory, Flight, Side};
use crate::model::objects::Id;
use crate::model::preferences::Theme;
use crate::model::tool::Tool;
use crate::model::view_settings::{ErrorMap, Measure, Sharing};
use crate::model::viewport::PixelZoom;
use crate::state::dialogs::Dialog;
use crate::state::files::Intent;
use crate::state::layout::{Layout, Panel};
use crate::state::session::Session;
use eframe::egui::{self, Event, Popup, ViewportCommand};
use glam::DVec3;
use glimray_scene::ObjectRef;
use std::f64::consts::PI;

/// Angle of orbit and roll commands, in radians.
const TURN: f64 = PI / 12.0;
/// Exposure step, in stops.
const EXPOSURE_STEP: f32 = 1.0 / 3.0;

/// Performs the commands of clicks and keys, except those keys that a question or the widget with the focus takes.
pub fn keys(session: &mut Session, layout: &mut Layout, ctx: &egui::Context) {
    for action in std::mem::take(&mut session.clicked) {
        perform(action, session, layout, ctx);
    }
    if walk::input(session, ctx) {
        return;
    }
    let keyboard = Keyboard::of(session, ctx);
    let are_taken = session.editing.modal.is_none() && dialogs::take_keys(session, ctx);
    let bindings = &session.preferences.bindings;
    let flight = match are_taken || keyboard == Keyboard::Text {
        true => Flight::default(),
        false => ctx.input(|input| bindings.flight(input)),
    };
    let events = ctx.input(|input| input.events.clone());
    if session.editing.modal.is_some() {
        // A widget with the focus would take Enter for a click.
        ctx.input_mut(|input| {
            input
                .events
                .retain(|event| !matches!(event, Event::Key { .. }))
        });
    }
    let was_flying = (session.controller.as_ref()).is_some_and(CameraController::is_flying);
    if let Some(controller) = &mut session.controller {
        controller.fly(flight);
    }
    if are_taken {
        return;
    }
    for event in &events {
        // During a flight, its keys do nothing else: Shift, which makes it faster, gives other commands to some.
        if !keyboard.passes(event)
            || modal::key(session, event)
            || files::cameras::take_number(session, event)
            || was_flying && session.preferences.bindings.flies(event)
        {
            continue;
        }
        let Some(action) = session.preferences.bindings.pressed_by(event) else {
            continue;
        };
        match keyboard {
            // The text is entered before the command, and menus close.
            Keyboard::Text => {
                Popup::close_all(ctx);
                ctx.memory_mut(|memory| memory.stop_text_input());
                session.clicked.push(action);
                ctx.request_repaint();
            }
            Keyboard::Commands | Keyboard::Widget => perform(action, session, layout, ctx),
        }
    }
    if egui::Popup::is_any_open(ctx)
        && let Some(controller) = &mut session.controller
    {
        controller.fly(Default::default());
    }
}

/// Performs a command.
pub fn perform(action: Action, session: &mut Session, layout: &mut Layout, ctx: &egui::Context) {
    if let Some(controller) = &session.controller {
        session.camera_history.note(controller, true);
    }
    match action {
        // Drags, wheels and held keys are handled where they apply.
        Action::Orbit
        | Action::Pan
        | Action::Zoom
        | Action::ZoomToCursor
        | Action::LookAround
        | Action::PixelZoom
        | Action::TurnLight
        | Action::FlyForward
        | Action::FlyBack
        | Action::FlyLeft
        | Action::FlyRight
        | Action::FlyUp
        | Action::FlyDown
        | Action::FlyFaster
        | Action::SnapHandles
        | Action::FineHandles
        | Action::SelectBox => {}
        Action::SetPivot | Action::FocusHere | Action::Select | Action::PictureMenu => {
            tools::pick_under_cursor(session, action, ctx);
        }
        Action::Walk => walk::begin(session, ctx),
        Action::OrbitLeft => camera(session, |it| it.orbit_by(-TURN, 0.0)),
        Action::OrbitRight => camera(session, |it| it.orbit_by(TURN, 0.0)),
        Action::OrbitUp => camera(session, |it| it.orbit_by(0.0, -TURN)),
        Action::OrbitDown => camera(session, |it| it.orbit_by(0.0, TURN)),
        Action::ZoomIn => camera(session, |it| it.zoom(1.0, None)),
        Action::ZoomOut => camera(session, |it| it.zoom(-1.0, None)),
        Action::RollLeft => camera(session, |it| it.roll(TURN)),
        Action::RollRight => camera(session, |it| it.roll(-TURN)),
        Action::Level => camera(session, CameraController::level),
        Action::FrameSelection => match session.selection_bounds() {
            Some(bounds) => frame(session, Some(bounds)),
            None => frame_all(session),
        },
        Action::FrameAll => frame_all(session),
        Action::ViewFront => view(session, Side::Front),
        Action::ViewBack => view(session, Side::Back),
        Action::ViewRight => view(session, Side::Right),
        Action::ViewLeft => view(session, Side::Left),
        Action::ViewTop => view(session, Side::Top),
        Action::ViewBottom => view(session, Side::Bottom),
        Action::ToggleOrthographic => camera(session, CameraController::toggle_orthographic),
        Action::Home => camera(session, CameraController::go_home),
        Action::UndoView => step_view(session, CameraHistory::undo, "undo"),
        Action::RedoView => step_view(session, CameraHistory::redo, "redo"),
        Action::Bookmarks => session.dialogs.toggle(Dialog::Cameras),
        Action::SaveCamera => files::cameras::bookmark(session),
        Action::NextCamera => files::cameras::step(session, 1),
        Action::PreviousCamera => files::cameras::step(session, -1),
        Action::CopyCamera => files::cameras::copy(session, ctx),
        Action::PasteCamera => files::paste_camera(session, ctx),
        Action::IntegratorWhitted
        | Action::IntegratorPath
        | Action::IntegratorNormals
        | Action::IntegratorDepth
        | Action::IntegratorIds
        | Action::IntegratorUv
        | Action::IntegratorHeat
        | Action::IntegratorSamples => {
            if let Some(integrator) = action.integrator() {
                session.view.settings.integrator = integrator;
            }
        }
        Action::NextLayer => session.view.step_layer(1),
        Action::PreviousLayer => session.view.step_layer(-1),
        Action::FalseColor => session.view.toggle_false_color(),
        Action::SplitWipe => session.view.compare(Sharing::Wipe(0.5)),
        Action::SideBySide => session.view.compare(Sharing::SideBySide),
        Action::ShowDifference => session
            .view
            .compare(Sharing::Difference(ErrorMap::new(Measure::Absolute))),
        Action::SwapSides => session.view.swap_sides(),
        Action::KeepSnapshot => comparing::keep_snapshot(session),
        Action::FlipKept => comparing::flip(session),
        Action::NextKept => comparing::flip_to_next(session),
        Action::Kept1
        | Action::Kept2
        | Action::Kept3
        | Action::Kept4
        | Action::Kept5
        | Action::Kept6
        | Action::Kept7
        | Action::Kept8 => {
            if let Some(number) = action.kept_number() {
                comparing::flip_to(session, number);
            }
        }
        Action::OpenReference => comparing::ask_reference(session, ctx),
        Action::ExposureUp => session.view.tone.exposure_ev += EXPOSURE_STEP,
        Action::ExposureDown => session.view.tone.exposure_ev -= EXPOSURE_STEP,
        Action::ExposureReset => session.view.tone = session.view.scene_tone,
        Action::NextToneCurve => session.view.next_tone_curve(),
        Action::NextBackground => session.view.next_background(),
        Action::PixelZoomIn => tools::pixel_zoom(session, 1.0, ctx.pointer_hover_pos()),
        Action::PixelZoomOut => tools::pixel_zoom(session, -1.0, ctx.pointer_hover_pos()),
        Action::PixelZoomReset => session.pixel_zoom = PixelZoom::default(),
        Action::PauseRender => session.view.paused = !session.view.paused,
        Action::RestartRender => session.restart(),
        Action::MoreSamples => session.view.scale_samples(2.0),
        Action::FewerSamples => session.view.scale_samples(0.5),
        Action::Film => files::film::open(session),
        Action::PlayPause => session.playback.toggle(),
        Action::StepForward => session.playback.step(1),
        Action::StepBack => session.playback.step(-1),
        Action::FirstFrame => session.playback.go_to(0),
        Action::LastFrame => session.playback.go_to(session.playback.last_frame()),
        Action::PlayFaster => session.playback.scale_speed(2.0),
        Action::PlaySlower => session.playback.scale_speed(0.5),
        Action::ToggleLoop => session.playback.repeats = !session.playback.repeats,
        Action::ToggleMotionBlur => session.playback.blurs = !session.playback.blurs,
        Action::Tool(tool) => tools::activate(session, layout, tool),
        Action::Add => adding::open_menu(session, ctx),
        Action::SelectAll => selecting::select_all(session),
        Action::SelectNothing => leave(session),
        Action::ToggleVisible => selecting::toggle_visible(session),
        Action::Rename => {
            layout.set_visible(Panel::Outline, true);
            session.begin_rename();
        }
        Action::Duplicate => selecting::duplicate(session),
        Action::Delete if measuring::remove(session) => {}
        Action::Delete => selecting::remove(session),
        Action::CopyMeasurements => measuring::copy(session, ctx),
        Action::ToggleSnapping => toggle_snapping(session),
        Action::Undo => editing::undo(session),
        Action::Redo => editing::redo(session),
        Action::New => files::intend(session, Intent::New),
        Action::Open => files::ask(session, ctx),
        Action::OpenNext => files::open_next(session, 1),
        Action::OpenPrevious => files::open_next(session, -1),
        Action::Reload => files::reload(session),
        Action::Revert => editing::revert(session),
        Action::SaveScene => saving::save(session),
        Action::SaveSceneAs => saving::ask(session),
        Action::SavePicture => files::pictures::open(session, false),
        Action::CopyPicture => files::pictures::copy(session),
        Action::SavePictureWithOverlays if session.viewport.is_none() => {
            session
                .messages
                .notify("The picture is hidden. Show its panel first");
        }
        Action::SavePictureWithOverlays => files::pictures::open(session, true),
        Action::Help => session.dialogs.toggle(Dialog::Shortcuts),
        Action::Preferences => session.dialogs.toggle(Dialog::Preferences),
        Action::TogglePanels => layout.toggle_all(),
        Action::ToggleOutline => {
            let visible = layout.is_visible(Panel::Outline);
            layout.set_visible(Panel::Outline, !visible);
        }
        Action::ToggleOverlays => session.shows_overlays = !session.shows_overlays,
        Action::ToggleOutlines
        | Action::ToggleGrid
        | Action::ToggleWireframe
        | Action::ToggleFeatureEdges
        | Action::ToggleSectionHandle
        | Action::ToggleLampHandles
        | Action::ToggleInspectedRays => toggle_overlay(session, action),
        Action::ToggleStatistics => session.shows_statistics = !session.shows_statistics,
        Action::ToggleTheme => session.preferences.theme = other_theme(ctx.theme()),
        Action::LargerText => session.preferences.enlarge(),
        Action::SmallerText => session.preferences.shrink(),
        Action::ResetText => session.preferences.ui_scale = 1.0,
        Action::FullScreen => {
            let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
            ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
        }
        Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
    }
}

/// Shows or hides an overlay. One that is shown brings the others back.
fn toggle_overlay(session: &mut Session, action: Action) {
    if let Some(is_shown) = session.preferences.overlays.of(action) {
        *is_shown = !*is_shown || !session.shows_overlays;
        session.shows_overlays |= *is_shown;
    }
}

fn toggle_snapping(session: &mut Session) {
    session.preferences.snaps = !session.preferences.snaps;
    session.messages.notify(match session.preferences.snaps {
        true => "Snapping is on",
        false => "Snapping is off",
    });
}

/// Changes the camera if there is one.
fn camera(session: &mut Session, change: impl FnOnce(&mut CameraController)) {
    if let Some(controller) = &mut session.controller {
        change(controller);
        session.moved();
    }
}

/// Undoes or redoes a movement of the camera.
fn step_view(
    session: &mut Session,
    step: fn(&mut CameraHistory, &mut CameraController) -> bool,
    verb: &str,
) {
    let Some(controller) = &mut session.controller else {
        return;
    };
    match step(&mut session.camera_history, controller) {
        true => session.moved(),
        false => {
            let told = format!("No camera movement to {verb}");
            session.messages.notify(told);
        }
    }
}

/// Shows the selection, or else the whole scene, from one side.
fn view(session: &mut Session, side: Side) {
    camera(session, |it| it.look_from(side));
    frame(session, session.selection_bounds().or(session.subject()));
}

/// Frames a box in world space.
fn frame(session: &mut Session, bounds: Option<(DVec3, DVec3)>) {
    let aspect = session.aspect();
    if let Some(bounds) = bounds {
        camera(session, |it| it.frame(bounds, aspect));
        let is_lamp = |id: &Id| matches!(id, Id::Object(ObjectRef::Light(_)));
        if !session.selected().iter().any(is_lamp) {
            see_past_lamps(session);
        }
    }
}

/// Looks past the lamps between the eye and the scene.
fn see_past_lamps(session: &mut Session) {
    let (aspect, time) = (session.aspect(), session.playback.time);
    let lights = session.scene().map(|scene| scene.frame(time).lights);
    if let (Some(subject), Some(lights)) = (session.subject(), lights) {
        camera(session, |it| it.see_past(subject, aspect, &lights));
    }
}

/// Frames the whole scene from a direction in which no lamp hides it.
fn frame_all(session: &mut Session) {
    let (aspect, time) = (session.aspect(), session.playback.time);
    let lights = session.scene().map(|scene| scene.frame(time).lights);
    if let (Some(bounds), Some(lights)) = (session.subject(), lights) {
        camera(session, |it| it.frame_past(bounds, aspect, &lights));
        see_past_lamps(session);
    }
}

/// Escape closes the uppermost dialog, else it cancels a drag or a focus by click, else it leaves the tool, else it clears the
/// selection.
fn leave(session: &mut Session) {
    if dialogs::close_uppermost(session) {
        return;
    }
    if session.editing.is_held() || lighting::is_turning(session) {
        modal::cancel(session);
        return;
    }
    let frame = session.tool_state.frame.take().is_some();
    if session.sight.boxed.take().is_some() || frame {
        return;
    }
    if session.tool_state.focuses.take().is_some() {
        return;
    }
    if session.tool == Tool::Select {
        session.select(Vec::new());
    }
    session.tool = Tool::Select;
}

fn other_theme(theme: egui::Theme) -> Theme {
    match theme {
        egui::Theme::Dark => Theme::Light,
        egui::Theme::Light => Theme::Dark,
    }
}
