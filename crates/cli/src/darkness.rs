//! Pictures that are black, or nearly so, with the likely reason.

use crate::job::Job;
use glimray_app::console;
use glimray_app::overrides::label;
use glimray_render::{RenderSettings, Shows, Tone};
use glimray_scene::image::Image;
use glimray_scene::{Camera, Sight, linear_from_srgb};

/// A pixel whose channels are all below this is black to the eye: five levels of 255.
const BLACK: f32 = 0.02;

/// The share of pixels that need not be black.
const BRIGHT_SHARE: f64 = 0.001;

impl Job<'_> {
    /// Whether `image`, a finished picture of this tone, is black without a known reason: another warning tells of a scene
    /// without light, and a part of a picture may be black.
    pub fn is_black(&self, image: &Image, tone: &Tone, settings: &RenderSettings) -> bool {
        let shows_light = settings.integrator.entry().shows == Shows::Radiance;
        shows_light && settings.crop.is_none() && !self.is_unlit() && is_black(image, tone)
    }

    /// Warns that the picture, or all pictures, are black.
    pub fn warn_of_darkness(&self, tone: &Tone, settings: &RenderSettings) {
        console::warning(format_args!(
            "the picture is black, or nearly so: {}.",
            self.reason(tone, settings)
        ));
    }

    fn reason(&self, tone: &Tone, settings: &RenderSettings) -> String {
        if tone.exposure_ev < 0.0 {
            return format!(
                "its exposure is {} EV. Use --exposure 0, or --exposure auto",
                tone.exposure_ev
            );
        }
        let aspect = f64::from(settings.size.0) / f64::from(settings.size.1);
        let sight = Sight::new(&self.scene, self.scene.background_shines());
        let sees = |camera: &Camera| sight.sees(camera, aspect);
        let cameras = self.scene.cameras_at(0.0);
        let own = self.scene.camera_index;
        if !sees(&self.scene.frame(0.0).camera) {
            let others = cameras.iter().enumerate();
            let mut others = others.filter(|(index, camera)| *index != own && sees(camera));
            let way = match others.next() {
                Some(other) => format!("--camera {}", other.0),
                None => "--look-from and --look-at".to_owned(),
            };
            return format!(
                "camera {} sees nothing that is lit, as it may be inside a closed object. Use {way}",
                label((own, &cameras[own]))
            );
        }
        "little light reaches what the camera sees. Use --exposure auto, or add light".to_owned()
    }
}

/// Whether hardly any pixel differs from black.
fn is_black(image: &Image, tone: &Tone) -> bool {
    let linear = Tone {
        denoise: tone.denoise,
        ..Tone::LINEAR
    };
    let least = match *tone == linear {
        true => linear_from_srgb(BLACK.into()) as f32,
        false => BLACK,
    };
    let is_bright = |pixel: &&[f32; 4]| pixel[..3].iter().any(|channel| *channel > least);
    let bright = image.pixels.iter().filter(is_bright).count();
    (bright as f64) < BRIGHT_SHARE * image.pixels.len() as f64
}
