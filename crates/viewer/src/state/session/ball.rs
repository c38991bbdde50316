//! The preview of the material in the Properties panel.

use super::Session;
use crate::model::ball::BallMaker;
use crate::worker::request::RenderRequest;
use glimray_app::layers::PictureLayer;
use glimray_render::{Antialias, Integrator, RenderSettings, Tone};
use glimray_scene::OutputDefaults;

/// Samples per pixel.
const SAMPLES: u32 = 32;
/// Least number of bounces: through a ball of glass and back.
const LEAST_DEPTH: u32 = 6;

/// The preview of a material.
#[derive(Default)]
pub struct Ball {
    maker: BallMaker,
    /// The picture of it, while it is shown.
    pub(super) request: Option<RenderRequest>,
}

impl Session {
    /// Asks for a picture of a ball of a material, of so many pixels a side; for none with `None`.
    pub fn show_ball(&mut self, ball: Option<(usize, u32)>) {
        self.ball.request = ball.and_then(|(index, side)| {
            let document = self.document.as_ref()?;
            let settings = &self.view.settings;
            let integrator = match settings.integrator.is_classical() {
                true => Integrator::Whitted,
                false => Integrator::Path,
            };
            Some(RenderRequest {
                scene: self.ball.maker.scene(document.scene(), index),
                restarts: 0,
                camera: None,
                background: None,
                shutter_interval: (0.0, 0.0),
                settings: RenderSettings {
                    size: (side, side),
                    samples: SAMPLES,
                    antialias: Antialias::Stratified,
                    integrator,
                    max_depth: settings.max_depth.max(LEAST_DEPTH),
                    ..RenderSettings::default()
                },
                policy: self.request.policy,
                tone: Tone::of_scene(&OutputDefaults::default(), integrator),
                layer: PictureLayer::Beauty,
                denoises_previews: true,
                false_color: false,
            })
        });
    }
}
