//! The render requests of the session.

use super::Session;
use crate::model::gallery::Still;
use crate::model::view_settings::Source;
use crate::worker::comparison::StillRequest;
use crate::worker::progressive_image::PictureSlot;
use crate::worker::render_thread::RenderRequests;
use crate::worker::request::RenderRequest;
use glimray_app::layers::PictureLayer;
use glimray_render::{Antialias, Integrator, RenderSettings};

/// Samples per pixel of the ray view.
const SAMPLES: u32 = 4;

impl Session {
    /// The current render requests.
    pub fn requests(&self) -> RenderRequests {
        let mut requests = RenderRequests {
            coarse: self.is_moving(),
            paused: self.view.paused,
            prepared: self.prepared.clone(),
            ball: self.ball.request.clone(),
            ..RenderRequests::default()
        };
        if self.room.taken.0 > 0 && self.room.taken.1 > 0 {
            let main = self.render_request(self.view.settings.integrator);
            let comparison = self.view.comparison;
            let shows_errors = comparison.is_some_and(|it| it.error_map().is_some());
            requests.pictures[PictureSlot::Main as usize] = main.map(|request| RenderRequest {
                layer: self.view.layer,
                // An error map compares both pictures as they are displayed.
                false_color: self.view.false_color && !shows_errors,
                ..request
            });
            if let Some(comparison) = self.view.comparison.filter(|_| self.scene().is_some()) {
                requests.pictures[PictureSlot::Beside as usize] = (comparison.integrator())
                    .and_then(|integrator| self.render_request(integrator));
                requests.still = self.still().map(|still| self.still_request(still));
                requests.difference = comparison.error_map();
                requests.raw = comparison.source == Source::Raw;
            }
        }
        requests.pictures[PictureSlot::Outside as usize] = self.outside_request();
        requests
    }

    pub(crate) fn render_request(&self, integrator: Integrator) -> Option<RenderRequest> {
        let (scene, controller) = (self.scene()?, self.controller.as_ref()?);
        Some(RenderRequest {
            scene: scene.clone(),
            restarts: self.restarts,
            camera: (self.is_fitted() || !controller.is_home()).then(|| controller.camera()),
            background: self.view.background.clone(),
            shutter_interval: self.playback.shutter_interval(),
            settings: self.view.settings_in(self.room.taken, integrator),
            policy: self.request.policy,
            tone: self.view.tone_of(integrator),
            layer: PictureLayer::Beauty,
            denoises_previews: self.preferences.denoises_previews,
            false_color: false,
        })
    }

    /// The still that the picture is compared with.
    pub fn still(&self) -> Option<&Still> {
        match self.view.comparison?.source {
            Source::Still(id) => self.comparing.gallery.get(id),
            Source::Integrator(_) | Source::Raw => None,
        }
    }

    fn still_request(&self, still: &Still) -> StillRequest {
        StillRequest {
            picture: still.picture.clone(),
            tone: still.is_radiance.then_some(self.view.tone),
        }
    }

    /// The request of the ray view while it is visible.
    pub fn outside_request(&self) -> Option<RenderRequest> {
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
            layer: PictureLayer::Beauty,
            denoises_previews: self.preferences.denoises_previews,
            false_color: false,
        })
    }
}
