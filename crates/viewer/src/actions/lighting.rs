//! Turning the light of the background, and warnings of scenes without light with the ways out of them.

use crate::actions::adding;
use crate::actions::surface::surface_at;
use crate::model::adding::Addition;
use crate::model::bindings::Action;
use crate::model::environment::BackgroundLight;
use crate::model::handles::lamp::{LampChange, LampPart, change_lamp};
use crate::model::messages::{Remedy, sentence};
use crate::model::objects::{self, Id};
use crate::model::tool::Purpose;
use crate::model::viewport::Viewport;
use crate::state::session::Session;
use eframe::egui::Vec2;
use glam::DVec3;
use glimray_app::advice::UNLIT;
use glimray_render::Integrator;
use glimray_scene::sky::{SUN_AZIMUTH_DEG, SUN_ELEVATION_DEG};
use glimray_scene::{Background, ObjectRef, Scene};
use std::sync::Arc;

/// The warning for a scene that is lit by its background, in a classical picture.
const CLASSICAL: &str = "the scene is lit by its environment alone, which only path tracing sees: the classical picture is \
                         dark. Switch to path tracing, or add a light.";

/// Whether the light of the background is being turned by a drag in the picture.
pub fn is_turning(session: &Session) -> bool {
    (session.drag).is_some_and(|drag| drag.action == Action::TurnLight)
}

/// Begins to turn the light of the background, unless it comes from everywhere alike.
pub fn begin_turn(session: &mut Session) {
    let light = session.scene().and_then(|scene| BackgroundLight::of(scene));
    if session.view.background.is_some() || light.is_none() {
        session.drag = None;
        session.messages.notify(match light {
            Some(_) => "Another background is shown for now, which has no direction. Press Shift+B until it ends",
            None => "The background has no direction. Choose a sky or another environment in Properties first",
        });
    }
}

/// Turns the light of the background by a drag of this many points since it began.
pub fn turn(session: &mut Session, drag: Vec2, viewport: Viewport) {
    let (drag, size) = (viewport.length(drag), viewport.extent());
    let Some(light) = session.scene().and_then(|scene| BackgroundLight::of(scene)) else {
        return;
    };
    session.drag_change(light.edit_name(), |scene| {
        if let Some(light) = BackgroundLight::of(scene) {
            light.dragged(drag, size).apply(scene);
        }
        Ok(())
    });
}

/// Asks for the surface at which a lamp is to aim that was dropped over this pixel.
pub fn aim_at_surface(session: &mut Session, light: usize, pixel: Option<[u32; 2]>) {
    let (Some(pixel), Some(scene)) = (pixel, session.scene().cloned()) else {
        return;
    };
    session.editing.aimed = Some((light, scene));
    session.ask(move |frame| surface_at(frame, pixel, Purpose::AimLamp));
}

/// Aims the lamp that waits for it at a point in world space, as part of the drag that dropped it there. Over the background
/// and over lamps it stays as it is, and so it does if the scene has changed meanwhile.
pub fn aim_at(session: &mut Session, hit: Option<(DVec3, Option<ObjectRef>)>) {
    let time = session.playback.time;
    let (Some((light, dropped)), Some((point, object)), Some(document)) =
        (session.editing.aimed.take(), hit, &mut session.document)
    else {
        return;
    };
    let is_lamp = matches!(object, Some(ObjectRef::Light(_)));
    let id = Id::Object(ObjectRef::Light(light));
    let place = objects::place(&dropped, id, time);
    if is_lamp || !Arc::ptr_eq(document.scene(), &dropped) {
        return;
    }
    let Some(way) = place.and_then(|place| (point - place.translation).try_normalize()) else {
        return;
    };
    document.go_on();
    let name = format!("aim {}", session.label(id));
    session.drag_change(&name, |scene| {
        change_lamp(
            scene,
            light,
            LampPart::Aim,
            LampChange::Direction(way),
            time,
        )
    });
    if let Some(document) = &mut session.document {
        document.release();
    }
}

/// Warns once the scene has no light in the picture that is shown, and takes the warning back when it has.
pub fn update(session: &mut Session) {
    let (Some(scene), integrator) = (session.scene(), session.view.settings.integrator) else {
        return;
    };
    let background = session.view.background.as_ref();
    let is_known = (session.editing.lit.as_ref()).is_some_and(|known| {
        Arc::ptr_eq(&known.0, scene) && known.1 == integrator && known.2.as_ref() == background
    });
    if is_known {
        return;
    }
    let now = (scene.clone(), integrator, background.cloned());
    let trouble = trouble(&now.0, integrator, background);
    session.editing.lit = Some(now);
    if session.editing.darkness == trouble {
        return;
    }
    if let Some(before) = std::mem::replace(&mut session.editing.darkness, trouble) {
        session.messages.dismiss(&sentence(before));
    }
    match trouble {
        Some(UNLIT) => (session.messages).offer(UNLIT, &[Remedy::AddLight, Remedy::Sky]),
        Some(text) => (session.messages).offer(text, &[Remedy::PathTracing, Remedy::AddLight]),
        None => {}
    }
}

/// Why the picture is dark, if its scene has no light.
fn trouble(
    scene: &Scene,
    integrator: Integrator,
    background: Option<&Background>,
) -> Option<&'static str> {
    let other;
    let scene = match background {
        None => scene,
        Some(background) => {
            other = Scene {
                background: background.clone(),
                ..scene.clone()
            };
            &other
        }
    };
    match integrator {
        Integrator::Path => (scene.is_unlit() && !scene.background_shines()).then_some(UNLIT),
        Integrator::Whitted if scene.is_lit_by_background_alone() => Some(CLASSICAL),
        Integrator::Whitted => scene.is_unlit().then_some(UNLIT),
        _ => None,
    }
}

/// Takes a way out.
pub fn remedy(session: &mut Session, remedy: Remedy) {
    match remedy {
        Remedy::AddLight => _ = adding::place(session, Addition::PointLight),
        Remedy::PathTracing => session.view.settings.integrator = Integrator::Path,
        Remedy::Sky => {
            let [elevation, azimuth] = [SUN_ELEVATION_DEG, SUN_AZIMUTH_DEG].map(f64::to_radians);
            session.change("add a sky", |scene| {
                scene.set_sky(elevation, azimuth);
                Ok(())
            });
            session.view.background = None;
            session.view.settings.integrator = Integrator::Path;
        }
    }
}
