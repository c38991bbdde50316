//! The render requests of the session.

use super::Session;
use crate::render::{Antialias, Integrator, RenderSettings};
use crate::viewer::worker::progressive_image::PictureSlot;
use crate::viewer::worker::render_thread::RenderRequests;
use crate::viewer::worker::request::RenderRequest;

/// Samples per pixel of the ray view.
const SAMPLES: u32 = 4;

impl Session {
    /// The current render requests.
    pub fn orders(&self) -> RenderRequests {
        let mut orders = RenderRequests {
            coarse: self.is_moving(),
            paused: self.view.paused,
            prepared: self.prepared.clone(),
            ..RenderRequests::default()
        };
        if self.room.taken.0 > 0 && self.room.taken.1 > 0 {
            orders.pictures[PictureSlot::Main as usize] = self.order(self.view.settings.integrator);
            orders.pictures[PictureSlot::Beside as usize] =
                (self.view.comparison).and_then(|comparison| self.order(comparison.integrator));
        }
        orders.pictures[PictureSlot::Outside as usize] = self.outside_order();
        orders
    }

    pub(in crate::viewer) fn order(&self, integrator: Integrator) -> Option<RenderRequest> {
        let (scene, controller) = (self.scene()?, self.controller.as_ref()?);
        Some(RenderRequest {
            scene: scene.clone(),
            restarts: self.restarts,
            camera: (!controller.is_home()).then(|| controller.camera()),
            background: self.view.background.clone(),
            shutter_interval: self.playback.shutter_interval(),
            settings: self.view.settings_in(self.room.taken, integrator),
            policy: self.request.policy,
            tone: self.view.tone_of(integrator),
        })
    }

    /// The request of the ray view while it is visible.
    pub fn outside_order(&self) -> Option<RenderRequest> {
        let outside = &self.inspector.outside;
        let (controller, size) = (outside.controller.as_ref()?, outside.shown?);
        self.inspector.inspected.as_ref()?;
        let integrator = match outside.plain {
            true => Integrator::Normals,
            false => Integrator::Whitted,
        };
        let settings = &self.view.settings;
        Some(RenderRequest {
            scene: self.scene()?.clone(),
            restarts: 0,
            camera: Some(controller.camera()),
            background: self.view.background.clone(),
            shutter_interval: (self.playback.time, self.playback.time),
            settings: RenderSettings {
                size,
                crop: None,
                samples: SAMPLES,
                antialias: Antialias::Stratified,
                integrator,
                max_depth: settings.max_depth.min(2),
                ..settings.clone()
            },
            policy: self.request.policy,
            tone: self.view.tone_of(integrator),
        })
    }
}
