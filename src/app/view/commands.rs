//! Every command of the viewer, wherever it comes from: a key, a menu, a button.

use super::bindings::Action;
use super::layout::{Layout, Panel};
use super::look::{Comparison, MAX_SAMPLES, Sharing};
use super::navigation::Side;
use super::playback::MAX_SPEED;
use super::session::Session;
use super::tools::Tool;
use super::{editing, files, inspector, sheets, tools};
use crate::scene::{Background, ToneCurve};
use eframe::egui::{self, ViewportCommand};
use glam::Vec3;
use std::f64::consts::PI;

/// What a key turns or rolls the camera by.
const TURN: f64 = PI / 12.0;
/// What a key brightens by, in stops.
const EXPOSURE_STEP: f32 = 1.0 / 3.0;

/// Does what clicks and keys ask for; keys only where no text is edited, no question is asked and no menu
/// is open.
pub fn keys(session: &mut Session, layout: &mut Layout, ctx: &egui::Context) {
    for action in std::mem::take(&mut session.clicked) {
        perform(action, session, layout, ctx);
    }
    if session.editing.modal.is_none()
        && (egui::Popup::is_any_open(ctx)
            || sheets::take_keys(session, ctx)
            || ctx.egui_wants_keyboard_input() && !editing::keys(session, ctx))
    {
        if let Some(rig) = &mut session.rig {
            rig.fly(Default::default());
        }
        return;
    }
    let bindings = &session.preferences.bindings;
    let (events, flight) = ctx.input(|input| (input.events.clone(), bindings.flight(input)));
    if let Some(rig) = &mut session.rig {
        rig.fly(flight);
    }
    for event in &events {
        if editing::modal::key(session, event) {
            continue;
        }
        if let Some(action) = session.preferences.bindings.pressed_by(event) {
            perform(action, session, layout, ctx);
        }
    }
}

/// Carries out one command.
pub fn perform(action: Action, session: &mut Session, layout: &mut Layout, ctx: &egui::Context) {
    // The first that knows the command carries it out.
    let _ = camera(action, session)
        || look(action, session)
        || time(action, session)
        || window(action, session, layout, ctx)
        || sheets::perform(action, session, ctx)
        || editing::perform(action, session)
        || files::perform(action, session, ctx)
        || inspector::perform(action, session, layout)
        || tools::perform(action, session, ctx)
        || tool(action, session);
}

fn camera(action: Action, session: &mut Session) -> bool {
    let aspect = {
        let (width, height) = session.picture_size();
        f64::from(width) / f64::from(height.max(1))
    };
    // Every vertex is looked at for it.
    let bounds = match action {
        Action::FrameSelection => session.selection_bounds().or_else(|| session.subject()),
        Action::FrameAll => session.subject(),
        _ => None,
    };
    let Some(rig) = &mut session.rig else {
        return false;
    };
    match action {
        Action::OrbitLeft => rig.orbit_by(-TURN, 0.0),
        Action::OrbitRight => rig.orbit_by(TURN, 0.0),
        Action::OrbitUp => rig.orbit_by(0.0, -TURN),
        Action::OrbitDown => rig.orbit_by(0.0, TURN),
        Action::ZoomIn => rig.zoom(1.0, None),
        Action::ZoomOut => rig.zoom(-1.0, None),
        Action::RollLeft => rig.roll(TURN),
        Action::RollRight => rig.roll(-TURN),
        Action::Level => rig.level(),
        Action::FrameSelection | Action::FrameAll => {
            if let Some(bounds) = bounds {
                rig.frame(bounds, aspect);
            }
        }
        Action::ViewFront => rig.look_from(Side::Front),
        Action::ViewBack => rig.look_from(Side::Back),
        Action::ViewRight => rig.look_from(Side::Right),
        Action::ViewLeft => rig.look_from(Side::Left),
        Action::ViewTop => rig.look_from(Side::Top),
        Action::ViewBottom => rig.look_from(Side::Bottom),
        Action::ToggleOrthographic => rig.toggle_orthographic(),
        Action::Home => rig.go_home(),
        _ => return false,
    }
    session.moved();
    true
}

fn look(action: Action, session: &mut Session) -> bool {
    let look = &mut session.look;
    if let Some(integrator) = action.integrator() {
        look.settings.integrator = integrator;
        return true;
    }
    let samples = look.settings.samples;
    match action {
        Action::SplitWipe => look.compare(Sharing::Wipe(0.5)),
        Action::SideBySide => look.compare(Sharing::SideBySide),
        Action::SwapSides => {
            if let Some(Comparison { integrator, .. }) = &mut look.comparison {
                std::mem::swap(integrator, &mut look.settings.integrator);
            }
        }
        Action::ExposureUp => look.tone.exposure_ev += EXPOSURE_STEP,
        Action::ExposureDown => look.tone.exposure_ev -= EXPOSURE_STEP,
        Action::ExposureReset => look.tone = look.scene_tone,
        Action::NextToneCurve => {
            look.tone.curve = match look.tone.curve {
                ToneCurve::None => ToneCurve::Aces,
                ToneCurve::Aces => ToneCurve::Agx,
                ToneCurve::Agx => ToneCurve::Reinhard,
                ToneCurve::Reinhard => ToneCurve::None,
            }
        }
        Action::NextBackground => {
            let plain = |level: f32| Some(Background::Color(Vec3::splat(level)));
            look.background = match &look.background {
                None => plain(0.0),
                black if *black == plain(0.0) => plain(0.18),
                grey if *grey == plain(0.18) => plain(1.0),
                _ => None,
            }
        }
        Action::PauseRender => look.paused = !look.paused,
        Action::RestartRender => session.restart(),
        Action::MoreSamples => look.set_samples((samples * 2).min(MAX_SAMPLES)),
        Action::FewerSamples => look.set_samples((samples / 2).max(1)),
        _ => return false,
    }
    true
}

fn time(action: Action, session: &mut Session) -> bool {
    let playback = &mut session.playback;
    match action {
        Action::PlayPause => playback.toggle(),
        Action::StepForward => playback.step(1),
        Action::StepBack => playback.step(-1),
        Action::FirstFrame => playback.go_to(0),
        Action::LastFrame => playback.go_to(playback.last_frame()),
        Action::PlayFaster => playback.speed = (playback.speed * 2.0).min(MAX_SPEED),
        Action::PlaySlower => playback.speed = (playback.speed / 2.0).max(1.0 / MAX_SPEED),
        Action::ToggleLoop => playback.repeats = !playback.repeats,
        Action::ToggleMotionBlur => playback.blurs = !playback.blurs,
        _ => return false,
    }
    true
}

fn window(action: Action, session: &mut Session, layout: &mut Layout, ctx: &egui::Context) -> bool {
    match action {
        Action::TogglePanels => layout.toggle_all(),
        Action::ToggleOutline => {
            let visible = layout.is_visible(Panel::Outline);
            layout.set_visible(Panel::Outline, !visible);
        }
        Action::Rename => {
            layout.set_visible(Panel::Outline, true);
            session.begin_rename();
        }
        Action::ToggleOverlays => session.shows_overlays = !session.shows_overlays,
        Action::ToggleStatistics => session.shows_statistics = !session.shows_statistics,
        Action::FullScreen => {
            let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
            ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
        }
        Action::SavePictureWithOverlays if session.viewport.is_none() => {
            (session.notices).tell("The picture is not to be seen: show its panel first");
        }
        Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        _ => return false,
    }
    true
}

fn tool(action: Action, session: &mut Session) -> bool {
    let handled = match action {
        Action::MoveTool => Some(Tool::Move),
        Action::RotateTool => Some(Tool::Rotate),
        Action::ScaleTool => Some(Tool::Scale),
        _ => None,
    };
    if let Some(tool) = handled {
        editing::modal::take(session, tool);
        return true;
    }
    session.tool = match action {
        Action::SelectMode => Tool::Select,
        Action::RegionRender => {
            // The second time it ends.
            match session.look.region.take() {
                Some(_) => Tool::Select,
                None => Tool::Region,
            }
        }
        Action::SelectNothing if session.tool != Tool::Select => Tool::Select,
        Action::SelectNothing => {
            session.selection = None;
            Tool::Select
        }
        _ => return false,
    };
    true
}
