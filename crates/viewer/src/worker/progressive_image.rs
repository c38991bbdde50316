//! A picture that follows its [`RenderRequest`]: a coarse preview while something moves, then progressive
//! refinement at full resolution.

mod apply;
mod frame_renderer;
mod noise;
mod pace;
pub(super) mod packing;
mod shown;

pub use frame_renderer::{FrameRenderer, ImageError, PictureSlot};
pub(super) use pace::policy;
pub use pace::{Pace, wait_limit};
pub use shown::{Progress, Shown};

use crate::worker::classical::ShownScenes;
use crate::worker::request::RenderRequest;
use crate::worker::stage::{ReportStage, Stage};
use glimray_app::layers::PictureLayer;
use glimray_app::{false_color, layer_picture};
use glimray_render::gpu::Gpu;
use glimray_render::pack::{PackedScene, PackedView};
use glimray_render::{Antialias, Renderer, Screen, Tone};
use glimray_scene::{Frame, Scene, ToneCurve, Transfer};
use noise::Noise;
use std::sync::{Arc, Weak};
use std::time::{Duration, Instant};

/// Minimum interval between presentations of a picture that passes through the host.
const DETOUR: Duration = Duration::from_millis(500);

/// Minimum interval between denoised updates; at least 4× the last denoise time.
const DENOISED: Duration = Duration::from_millis(200);
const DENOISED_PAUSE: u32 = 4;

/// A picture, its renderer and its screens.
pub struct ProgressiveImage {
    gpu: Gpu,
    place: PictureSlot,
    report: ReportStage,
    is_opening: bool,
    request: Option<RenderRequest>,
    /// Whether only the coarse preview is wanted.
    stays_coarse: bool,
    is_coarse: bool,
    /// By which the coarse picture's width and height are divided.
    divisor: u32,
    scenes: ShownScenes,
    /// The scene of `packed`.
    scene: Option<Arc<Scene>>,
    packed: Option<Arc<PackedScene>>,
    /// The packed scene of the window from which `packed` was made.
    prepared: Weak<PackedScene>,
    frames: Vec<Frame>,
    view: Option<PackedView>,
    /// Number of BVH builds and refits since the window was opened.
    trees_built: usize,
    renderer: Option<Renderer>,
    screen: Option<Screen>,
    coarse: Option<Screen>,
    whole: Option<Screen>,
    /// The picture without denoising, if it is wanted and differs.
    raw: Option<Screen>,
    shows_raw: bool,
    /// The displayed range of the last presentation.
    range: Option<[f32; 2]>,
    is_shown: bool,
    last_look: Option<Instant>,
    /// How long the last presentation took.
    look_time: Duration,
    frames_shown: u64,
    /// Seconds of work on this picture.
    busy: f64,
    pace: Pace,
    adapter: Arc<str>,
    spent: Spent,
    noise: Noise,
}

/// The renderer's statistics when the picture started.
#[derive(Clone, Copy, Default)]
struct Spent {
    seconds: f64,
    samples: u64,
}

impl ProgressiveImage {
    /// An empty one, which reports the stages of a scene that is opened, and compilation at any time.
    pub fn new(gpu: Gpu, place: PictureSlot, report: ReportStage) -> Self {
        let compiles = report.clone();
        Self {
            adapter: gpu.adapter().name.as_str().into(),
            gpu: gpu.reporting_compilation(move || compiles(Stage::CompilingShaders)),
            place,
            report,
            is_opening: false,
            request: None,
            stays_coarse: false,
            is_coarse: false,
            divisor: 1,
            scenes: ShownScenes::default(),
            scene: None,
            packed: None,
            prepared: Weak::new(),
            frames: Vec::new(),
            view: None,
            trees_built: 0,
            renderer: None,
            screen: None,
            coarse: None,
            whole: None,
            raw: None,
            shows_raw: false,
            range: None,
            is_shown: true,
            last_look: None,
            look_time: Duration::ZERO,
            frames_shown: 0,
            busy: 0.0,
            pace: Pace::default(),
            spent: Spent::default(),
            noise: Noise::default(),
        }
    }

    /// Whether it is the picture of this request, or there is none.
    pub fn shows(&self, request: Option<&RenderRequest>) -> bool {
        self.request.as_ref() == request
    }

    /// Whether every pixel of the full-resolution picture has a sample.
    pub fn has_sample(&self) -> bool {
        let renderer = self.renderer.as_ref().filter(|_| !self.is_coarse);
        renderer.is_some_and(|renderer| renderer.samples_done() > 0)
    }

    /// Whether the picture is finished and presented.
    pub fn is_done(&self) -> bool {
        let is_traced = self.renderer.as_ref().is_none_or(Renderer::is_done);
        self.is_shown && is_traced && (self.stays_coarse || !self.is_coarse)
    }

    /// Whether the current samples have been presented.
    pub fn is_shown(&self) -> bool {
        self.is_shown
    }

    /// Number of presentations.
    pub fn frames_shown(&self) -> u64 {
        self.frames_shown
    }

    /// Whether a renderer exists for questions.
    pub fn is_ready(&self) -> bool {
        self.renderer.is_some() && !self.is_coarse
    }

    /// Whether the full-resolution main picture has not started yet.
    pub fn is_awaited(&self) -> bool {
        self.place == PictureSlot::Main && self.renderer.is_some() && self.is_coarse
    }

    /// Whether the scene has just been opened and has no picture yet.
    pub fn is_opening(&self) -> bool {
        self.is_opening
    }

    /// Priority among pictures: the lowest comes first.
    pub fn rank(&self) -> f64 {
        match &self.renderer {
            Some(renderer) if !self.is_coarse => renderer.progress(),
            _ => -1.0,
        }
    }

    /// Begins the next finer picture: on slow devices by levels, each of which comes as a whole.
    fn refine(&mut self) -> Result<(), ImageError> {
        let Some(request) = &self.request else {
            return Ok(());
        };
        let pixels = pace::pixels(&request.settings);
        match self.pace.next(pixels, self.divisor) {
            1 => self.begin(None),
            divisor => self.begin(Some(divisor)),
        }
    }

    /// Adds samples for a slice of time and shows them. Those of a `paused` picture are only shown, once
    /// there are any.
    ///
    /// # Errors
    /// The device failed or cannot render the scene.
    pub fn step(&mut self, paused: bool) -> Result<(), ImageError> {
        let started = Instant::now();
        let is_traced = self.renderer.as_ref().is_some_and(Renderer::is_done);
        if self.is_coarse && !self.stays_coarse && is_traced && self.is_shown && !paused {
            self.refine()?;
        }
        let (Some(renderer), Some(request)) = (&mut self.renderer, &self.request) else {
            return Ok(());
        };
        let is_held = paused && !self.is_coarse && self.last_look.is_some();
        if !is_held {
            renderer.step()?;
        }
        if self.is_opening {
            let share = renderer.progress();
            (self.report)(Stage::FirstSamples { share });
        }
        let tone = Tone {
            denoise: request.tone.denoise || self.is_coarse && request.denoises_coarse(),
            ..request.tone
        };
        let is_false_color = request.is_false_color();
        let is_beauty = request.layer == PictureLayer::Beauty && !is_false_color;
        let is_direct = is_beauty && renderer.shows_directly(&tone);
        let is_denoised = (is_beauty || is_false_color) && renderer.denoises(&tone);
        let interval = match (is_denoised, is_direct) {
            (true, _) => DENOISED.max(DENOISED_PAUSE * self.look_time),
            (false, true) => pace::between_looks(&self.gpu),
            (false, false) => DETOUR,
        };
        let is_due = renderer.is_done()
            || is_held
            || self.last_look.is_none_or(|last| last.elapsed() > interval);
        // A coarse picture comes as a whole, and so does the first sample.
        let is_whole = renderer.is_done() || !self.is_coarse && renderer.samples_done() > 0;
        if !is_due || !is_whole {
            self.is_shown = false;
            self.busy += started.elapsed().as_secs_f64();
            return Ok(());
        }
        let look = Instant::now();
        let screen = match self.is_coarse {
            true => &mut self.coarse,
            false => &mut self.screen,
        };
        let [.., width, height] = renderer.region();
        let screen = match screen {
            Some(screen) if screen.size() == (width, height) => screen,
            _ => screen.insert(renderer.new_screen()?),
        };
        self.range = match request.layer {
            layer if layer != PictureLayer::Beauty && request.settings.has_features() => {
                let features = renderer.features()?;
                let image = layer_picture::picture(layer, &features, &request.tone, &self.gpu)?;
                screen.write(&self.gpu, &(&image).into())?;
                None
            }
            _ if is_false_color => {
                let exposed = Tone {
                    curve: ToneCurve::None,
                    transfer: Transfer::Linear,
                    ..tone
                };
                let image = false_color::picture(&renderer.develop(&exposed)?);
                screen.write(&self.gpu, &image)?;
                None
            }
            _ => renderer.show(&tone, screen)?,
        };
        self.raw = match self.shows_raw && is_denoised && !self.is_coarse {
            true => {
                let screen = match self.raw.take() {
                    Some(screen) if screen.size() == (width, height) => screen,
                    _ => renderer.new_screen()?,
                };
                renderer.show(&raw(&request.tone), &screen)?;
                Some(screen)
            }
            false => None,
        };
        self.look_time = look.elapsed();
        self.busy += started.elapsed().as_secs_f64();
        if self.is_coarse && self.last_look.is_none() {
            (self.pace).measured(self.busy, u64::from(width) * u64::from(height));
        }
        self.is_shown = true;
        self.last_look = Some(Instant::now());
        self.frames_shown += 1;
        self.is_opening = false;
        self.estimate_noise()
    }

    /// Estimates the noise each time the samples have doubled.
    fn estimate_noise(&mut self) -> Result<(), ImageError> {
        let (Some(renderer), Some(request)) = (&mut self.renderer, &self.request) else {
            return Ok(());
        };
        let samples = renderer.samples_done();
        let is_estimable = !self.is_coarse
            && self.place == PictureSlot::Main
            && request.settings.antialias != Antialias::None;
        if is_estimable && self.noise.is_due(samples) {
            // Neighbours share the noise of a denoised picture.
            let image = renderer.develop(&raw(&request.tone))?;
            self.noise.look(&image, samples);
        }
        Ok(())
    }

    /// Whether the picture is also shown without denoising.
    pub fn show_raw(&mut self, raw: bool) {
        if std::mem::replace(&mut self.shows_raw, raw) != raw && raw {
            self.is_shown = false;
        }
    }

    /// For questions; `None` while the renderer's film holds the preview.
    pub fn frame(&mut self) -> Option<FrameRenderer<'_>> {
        (!self.is_coarse).then_some(())?;
        Some(FrameRenderer {
            renderer: self.renderer.as_mut()?,
            request: self.request.as_ref()?,
            screen: self.screen.as_ref().filter(|_| self.last_look.is_some()),
            outside: None,
        })
    }
}

/// The tone without denoising.
fn raw(tone: &Tone) -> Tone {
    Tone {
        denoise: false,
        ..*tone
    }
}
