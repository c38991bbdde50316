//! Render and view settings that do not change the scene.

use crate::model::gallery::StillId;
use crate::model::playback::Playback;
pub use crate::worker::error_map::{ErrorMap, Measure};
use glam::Vec3;
use glimray_app::layers::{LAYERS, PictureLayer};
use glimray_render::{Antialias, Integrator, Levels, RenderSettings, Shows, Tone};
use glimray_scene::{Background, LightTransport, OutputDefaults, ToneCurve};

/// Maximum samples per pixel.
pub const MAX_SAMPLES: u32 = 65_536;

/// Maximum gain of a difference. The minimum is 1.
pub const MAX_GAIN: f32 = 100.0;

/// The settings of the picture and of its comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewSettings {
    /// Render settings; size and region apply only if [`ViewSettings::fits`] is off.
    pub settings: RenderSettings,
    /// Tone mapping of lit pictures; debug views ignore it.
    pub tone: Tone,
    /// The layer of the picture that is shown; debug views have no layers.
    pub layer: PictureLayer,
    /// Whether luminance is shown in false colours, in place of the picture.
    pub false_color: bool,
    /// Overrides the scene's background.
    pub background: Option<Background>,
    /// Whether the picture has the size of its panel; else the size of the settings.
    pub fits: bool,
    /// The second picture and the layout of the comparison.
    pub comparison: Option<Comparison>,
    /// The second picture of the next comparison; `None` for another view mode.
    pub proposed: Option<Source>,
    /// The render region as fractions of width and height: x0, y0, x1, y1.
    pub region: Option<[f64; 4]>,
    /// Whether rendering is paused.
    pub paused: bool,
    /// The settings of the scene and the command line, to return to.
    pub scene_settings: RenderSettings,
    /// The tone mapping of the scene and the command line.
    pub scene_tone: Tone,
}

/// The second picture of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The picture.
    pub source: Source,
    /// The layout.
    pub sharing: Sharing,
}

/// A picture to compare with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The scene in this view mode.
    Integrator(Integrator),
    /// A snapshot, or a reference picture from a file.
    Still(StillId),
    /// The picture itself without denoising.
    Raw,
}

/// The layout of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sharing {
    /// One picture with a divider at this fraction of its width; the first picture is on the left.
    Wipe(f32),
    /// Two pictures side by side.
    SideBySide,
    /// The difference of both pictures. The gain is 1 to [`MAX_GAIN`].
    Difference(ErrorMap),
}

impl Sharing {
    /// All that are offered, with their names. FLIP needs a cargo feature.
    pub fn offered() -> impl Iterator<Item = (&'static str, Self)> {
        let plain = [
            ("Split wipe", Self::Wipe(0.5)),
            ("Side by side", Self::SideBySide),
        ];
        let maps = Measure::ALL.into_iter().filter(|it| it.is_built());
        let maps = maps.map(|measure| (measure.title(), Self::Difference(ErrorMap::new(measure))));
        plain.into_iter().chain(maps)
    }

    /// Whether both are the same layout, wherever their line is and whatever their gain.
    pub fn is_like(self, other: Self) -> bool {
        match (self, other) {
            (Self::Difference(own), Self::Difference(other)) => own.measure == other.measure,
            _ => std::mem::discriminant(&self) == std::mem::discriminant(&other),
        }
    }
}

impl Comparison {
    /// The view mode of the second picture, if it is rendered beside the first.
    pub fn integrator(&self) -> Option<Integrator> {
        match self.source {
            Source::Integrator(integrator) => Some(integrator),
            Source::Still(_) | Source::Raw => None,
        }
    }

    /// The error map, if the difference is shown.
    pub fn error_map(&self) -> Option<ErrorMap> {
        match self.sharing {
            Sharing::Difference(map) => Some(map),
            Sharing::Wipe(_) | Sharing::SideBySide => None,
        }
    }
}

impl ViewSettings {
    /// The settings of the scene and the command line.
    pub fn new(settings: RenderSettings, tone: Tone, fits: bool) -> Self {
        Self {
            scene_settings: settings.clone(),
            settings,
            tone,
            layer: PictureLayer::Beauty,
            false_color: false,
            background: None,
            fits,
            comparison: None,
            proposed: None,
            region: None,
            paused: false,
            scene_tone: tone,
        }
    }

    /// Sets the target samples, 1 to [`MAX_SAMPLES`]. A single sample lies at the pixel centre and several
    /// are stratified, as on the command line, unless the user has chosen otherwise.
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

    /// Starts a comparison, or ends it if it has this layout already.
    pub fn compare(&mut self, sharing: Sharing) {
        self.comparison = match self.comparison {
            Some(comparison) if comparison.sharing.is_like(sharing) => None,
            Some(comparison) => Some(Comparison {
                sharing,
                ..comparison
            }),
            None => Some(Comparison {
                source: self.proposed.unwrap_or(Source::Integrator(
                    match self.settings.integrator {
                        Integrator::Normals => Integrator::Whitted,
                        _ => Integrator::Normals,
                    },
                )),
                sharing,
            }),
        };
    }

    /// Compares with this picture, with a wipe unless a comparison has another layout.
    pub fn compare_with(&mut self, source: Source) {
        let sharing = self.comparison.map(|comparison| comparison.sharing);
        let sharing = sharing.unwrap_or(Sharing::Wipe(0.5));
        self.comparison = Some(Comparison { source, sharing });
        self.proposed = Some(source).filter(|source| matches!(source, Source::Still(_)));
    }

    /// Ends the comparison with a still that is removed.
    pub fn forget(&mut self, still: StillId) {
        let source = Source::Still(still);
        (self.proposed).take_if(|proposed| *proposed == source);
        (self.comparison).take_if(|comparison| comparison.source == source);
    }

    /// Multiplies the target samples, within 1 to [`MAX_SAMPLES`].
    pub fn scale_samples(&mut self, factor: f64) {
        let samples = f64::from(self.settings.samples) * factor;
        self.set_samples(samples.clamp(1.0, MAX_SAMPLES.into()) as u32);
    }

    /// Swaps the two view modes of a comparison. A still stays where it is.
    pub fn swap_sides(&mut self) {
        if let Some(Comparison {
            source: Source::Integrator(integrator),
            ..
        }) = &mut self.comparison
        {
            std::mem::swap(integrator, &mut self.settings.integrator);
        }
    }

    /// Shows a layer. The first other than the beauty starts the picture over, as its film has no layers.
    pub fn show_layer(&mut self, layer: PictureLayer) {
        self.layer = layer;
        self.false_color = false;
        self.settings.features |= layer != PictureLayer::Beauty;
    }

    /// Shows the layer that many places further in the list, which is a circle.
    pub fn step_layer(&mut self, by: isize) {
        let count = LAYERS.0.len() as isize;
        let own = LAYERS.0.iter().position(|(.., layer)| *layer == self.layer);
        let next = (own.unwrap_or_default() as isize + by).rem_euclid(count);
        self.show_layer(LAYERS.0[next as usize].2);
    }

    /// Shows the picture's luminance in false colours, or its own colours again.
    pub fn toggle_false_color(&mut self) {
        let is_shown = self.false_color;
        if !is_shown && self.settings.integrator.entry().shows != Shows::Radiance {
            self.settings.integrator = self.scene_settings.integrator;
        }
        self.show_layer(PictureLayer::Beauty);
        self.false_color = !is_shown;
    }

    /// Selects the next tone curve.
    pub fn next_tone_curve(&mut self) {
        self.tone.curve = match self.tone.curve {
            ToneCurve::None => ToneCurve::Aces,
            ToneCurve::Aces => ToneCurve::Agx,
            ToneCurve::Agx => ToneCurve::Reinhard,
            ToneCurve::Reinhard => ToneCurve::Neutral,
            ToneCurve::Neutral => ToneCurve::None,
        };
    }

    /// Cycles the background: the scene's, black, grey, white.
    pub fn next_background(&mut self) {
        let plain = |level: f32| Some(Background::Color(Vec3::splat(level)));
        self.background = match &self.background {
            None => plain(0.0),
            black if *black == plain(0.0) => plain(0.18),
            grey if *grey == plain(0.18) => plain(1.0),
            _ => None,
        };
    }

    /// The output defaults of a scene that looks like this. Settings that scenes do not store, such as debug views,
    /// are left out.
    pub fn output(&self, before: &OutputDefaults, playback: &Playback) -> OutputDefaults {
        let settings = &self.settings;
        let integrator = match settings.integrator.entry().is_lit {
            true => settings.integrator.into(),
            false => before.integrator,
        };
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
            integrator,
            samples: settings.samples,
            antialias: (settings.antialias != usual.antialias).then_some(settings.antialias),
            filter: settings.filter,
            filter_radius: (settings.filter_radius != settings.filter.default_radius())
                .then_some(settings.filter_radius),
            noise: settings.noise,
            light_samples: settings.light_samples,
            max_depth: settings.max_depth,
            exposure_ev: self.tone.exposure_ev,
            auto_exposure: self.tone.auto_exposure,
            tone: Some(self.tone.curve)
                .filter(|curve| before.tone.is_some() || *curve != before.tone_of(integrator)),
            path_tone: before.path_tone,
            transfer: self.tone.transfer,
            fps: playback.clock.fps,
            duration: before.duration,
            shutter: playback.clock.shutter,
            backdrop: settings.backdrop,
            denoise: self.tone.denoise,
        }
    }

    /// The tone mapping of an integrator's pictures.
    pub fn tone_of(&self, integrator: Integrator) -> Tone {
        match integrator.entry().shows {
            Shows::Radiance => self.tone,
            Shows::Colors | Shows::Quantity(_) => Tone {
                levels: Levels::Found,
                ..Tone::LINEAR
            },
        }
    }

    /// The render settings for a panel of that many pixels.
    pub fn settings_in(&self, space: (u32, u32), integrator: Integrator) -> RenderSettings {
        let size = match self.fits {
            true => (space.0.max(1), space.1.max(1)),
            false => self.settings.size,
        };
        self.settings_at(size, integrator)
    }

    /// The settings of a picture of this width and height in pixels.
    pub fn settings_at(&self, size: (u32, u32), integrator: Integrator) -> RenderSettings {
        let crop = match self.region {
            Some(region) => Some(pixels(region, size)),
            None => (self.settings.crop).filter(|_| !self.fits && size == self.settings.size),
        };
        let (own, usual) = (&self.settings, &self.scene_settings);
        let (mut samples, mut antialias, mut max_depth) =
            (own.samples, own.antialias, own.max_depth);
        // Another integrator than the scene's needs other samples and bounces, unless the user has chosen them.
        let from = LightTransport::from(usual.integrator);
        let fitting = from.converted(integrator.into(), (samples, max_depth), usual.features);
        if samples == usual.samples && antialias == usual.antialias {
            samples = fitting.0;
            if antialias == Antialias::None && samples > 1 {
                antialias = Antialias::Stratified;
            }
        }
        if max_depth == usual.max_depth {
            max_depth = fitting.1;
        }
        RenderSettings {
            size,
            crop,
            integrator,
            samples,
            antialias,
            max_depth,
            ..self.settings.clone()
        }
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
