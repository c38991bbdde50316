//! How the picture is made and looked at: what a person changes without changing the scene.

use super::playback::Playback;
use super::region::Grip;
use super::session::Session;
use crate::render::{Antialias, Integrator, Levels, RenderSettings, Shows, Tone};
use crate::scene::{Background, OutputDefaults};

/// Most samples of a pixel.
pub const MAX_SAMPLES: u32 = 65_536;

/// Settings of the picture, and what it is compared with.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Of the picture; its size and region only where [`Look::fits`] says so.
    pub settings: RenderSettings,
    /// How the traced picture is developed; debug views stay as they are.
    pub tone: Tone,
    /// In place of the scene's.
    pub background: Option<Background>,
    /// Whether the picture is as large as there is room for; else it has the size of its settings.
    pub fits: bool,
    /// The second look at the same, and how both share the room.
    pub comparison: Option<Comparison>,
    /// Part of the picture that is rendered, as shares of its width and height: x0, y0, x1, y1.
    pub region: Option<[f64; 4]>,
    /// Whether no more samples are added.
    pub paused: bool,
    /// The edge or corner of the region that the mouse holds.
    pub grip: Option<Grip>,
    /// What the scene and the command line say, to go back to.
    pub scene_settings: RenderSettings,
    /// The same of developing.
    pub scene_tone: Tone,
}

/// A second look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// What it shows.
    pub integrator: Integrator,
    /// How both share the room.
    pub sharing: Sharing,
}

/// How two looks share the room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sharing {
    /// One picture, with a line at this share of its width: the first look on its left.
    Wipe(f32),
    /// Two pictures.
    SideBySide,
}

impl Look {
    /// What the scene and the command line say.
    pub fn new(settings: RenderSettings, tone: Tone, fits: bool) -> Self {
        Self {
            scene_settings: settings.clone(),
            settings,
            tone,
            background: None,
            fits,
            comparison: None,
            region: None,
            paused: false,
            grip: None,
            scene_tone: tone,
        }
    }

    /// Aims at another number of samples, 1 to [`MAX_SAMPLES`]. One lies in the pixel's centre and several
    /// are spread, as on the command line, unless the person has chosen otherwise.
    pub fn set_samples(&mut self, samples: u32) {
        let usual = |samples| match samples {
            1 => Antialias::None,
            _ => Antialias::Stratified,
        };
        let settings = &mut self.settings;
        if settings.antialias == usual(settings.samples) {
            settings.antialias = usual(samples);
        }
        settings.samples = samples.clamp(1, MAX_SAMPLES);
    }

    /// Compares with another look, or no longer if that is how it is already.
    pub fn compare(&mut self, sharing: Sharing) {
        let is_same =
            |now: Sharing| std::mem::discriminant(&now) == std::mem::discriminant(&sharing);
        self.comparison = match self.comparison {
            Some(comparison) if is_same(comparison.sharing) => None,
            Some(comparison) => Some(Comparison {
                sharing,
                ..comparison
            }),
            None => Some(Comparison {
                integrator: match self.settings.integrator {
                    Integrator::Normals => Integrator::Whitted,
                    _ => Integrator::Normals,
                },
                sharing,
            }),
        };
    }

    /// What a scene would say to look like this; what scenes do not say, such as the integrator, is not in it.
    pub fn output(&self, before: &OutputDefaults, playback: &Playback) -> OutputDefaults {
        let settings = &self.settings;
        let usual = RenderSettings::from(&OutputDefaults {
            samples: settings.samples,
            ..OutputDefaults::default()
        });
        OutputDefaults {
            size: if self.fits {
                before.size
            } else {
                settings.size
            },
            samples: settings.samples,
            antialias: (settings.antialias != usual.antialias).then_some(settings.antialias),
            filter: settings.filter,
            filter_radius: (settings.filter_radius != settings.filter.default_radius())
                .then_some(settings.filter_radius),
            noise: settings.noise,
            light_samples: settings.light_samples,
            max_depth: settings.max_depth,
            exposure_ev: self.tone.exposure_ev,
            tone: self.tone.curve,
            transfer: self.tone.transfer,
            fps: playback.clock.fps,
            duration: before.duration,
            shutter: playback.clock.shutter,
        }
    }

    /// How a picture of this integrator is developed.
    pub fn tone_of(&self, integrator: Integrator) -> Tone {
        match integrator.entry().shows {
            Shows::Radiance => self.tone,
            Shows::Colors | Shows::Quantity(_) => Tone {
                levels: Levels::Found,
                ..Tone::LINEAR
            },
        }
    }

    /// The settings of a picture for which there is room of so many pixels.
    pub fn settings_in(&self, space: (u32, u32), integrator: Integrator) -> RenderSettings {
        let size = match self.fits {
            true => (space.0.max(1), space.1.max(1)),
            false => self.settings.size,
        };
        let crop = match self.region {
            Some(region) => Some(pixels(region, size)),
            None => self.settings.crop.filter(|_| !self.fits),
        };
        RenderSettings {
            size,
            crop,
            integrator,
            ..self.settings.clone()
        }
    }
}

impl Session {
    /// What the scene would have to say to look as it is shown; `None` if it does.
    fn unkept(&self) -> Option<OutputDefaults> {
        let before = &self.scene()?.output;
        let output = self.look.output(before, &self.playback);
        (output != *before || self.look.background.is_some()).then_some(output)
    }

    /// Whether the picture is made otherwise than the scene says.
    pub fn has_unkept_look(&self) -> bool {
        self.unkept().is_some()
    }

    /// Makes how the picture is made and developed the scene's own, background and timing included, to be
    /// saved with it.
    pub fn keep_look(&mut self) {
        let Some(output) = self.unkept() else {
            return;
        };
        let background = self.look.background.take();
        self.change("keep the settings in the scene", |scene| {
            scene.output = output;
            scene.background = background.unwrap_or(scene.background.clone());
            Ok(())
        });
        self.look.scene_settings = self.look.settings.clone();
        self.look.scene_tone = self.look.tone;
    }
}

/// A region in pixels: at least one.
fn pixels(region: [f64; 4], (width, height): (u32, u32)) -> [u32; 4] {
    let at = |share: f64, length: u32| (share.clamp(0.0, 1.0) * f64::from(length)).round() as u32;
    let span = |from: f64, to: f64, length: u32| {
        let start = at(from.min(to), length).min(length - 1);
        (start, at(from.max(to), length).max(start + 1))
    };
    let (x0, x1) = span(region[0], region[2], width);
    let (y0, y1) = span(region[1], region[3], height);
    [x0, y0, x1, y1]
}
