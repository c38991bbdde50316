//! A picture that follows its [`RenderRequest`]: a coarse preview while something moves, then progressive
//! refinement at full resolution.

mod frame_renderer;
mod noise;
mod pace;
pub(super) mod packing;
mod shown;

pub use frame_renderer::{FrameRenderer, ImageError, PictureSlot};
pub(super) use pace::policy;
pub use pace::{Pace, patience};
pub use shown::{Progress, Shown};

use crate::app::layer_picture;
use crate::app::layers::PictureLayer;
use crate::gpu::Gpu;
use crate::pack::{self, PackedScene, PackedView};
use crate::render::{Antialias, RenderSettings, Renderer, Screen};
use crate::scene::{Frame, Scene};
use crate::viewer::worker::classical::ShownScenes;
use crate::viewer::worker::request::{PreparedScene, RenderRequest};
use crate::viewer::worker::stage::{ReportStage, Stage};
use noise::Noise;
use packing::view;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Minimum interval between presentations of a picture that passes through the host.
const DETOUR: Duration = Duration::from_millis(500);

/// The same for one that is denoised each time.
const DENOISED: Duration = Duration::from_secs(2);

/// A picture, its renderer and its screens.
pub struct ProgressiveImage {
    gpu: Gpu,
    place: PictureSlot,
    report: ReportStage,
    is_opening: bool,
    order: Option<RenderRequest>,
    /// Whether only the coarse preview is wanted.
    stays_coarse: bool,
    is_coarse: bool,
    /// By which the coarse picture's width and height are divided.
    divisor: u32,
    scenes: ShownScenes,
    /// The scene of `packed`.
    scene: Option<Arc<Scene>>,
    packed: Option<Arc<PackedScene>>,
    frames: Vec<Frame>,
    view: Option<PackedView>,
    /// Number of BVH builds and refits since the window was opened.
    trees_built: usize,
    renderer: Option<Renderer>,
    screen: Option<Screen>,
    coarse: Option<Screen>,
    whole: Option<Screen>,
    /// The displayed range of the last presentation.
    range: Option<[f32; 2]>,
    is_shown: bool,
    last_look: Option<Instant>,
    looks: u64,
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
            order: None,
            stays_coarse: false,
            is_coarse: false,
            divisor: 1,
            scenes: ShownScenes::default(),
            scene: None,
            packed: None,
            frames: Vec::new(),
            view: None,
            trees_built: 0,
            renderer: None,
            screen: None,
            coarse: None,
            whole: None,
            range: None,
            is_shown: true,
            last_look: None,
            looks: 0,
            busy: 0.0,
            pace: Pace::default(),
            spent: Spent::default(),
            noise: Noise::default(),
        }
    }

    /// Applies a request and keeps the results that are still valid. `prepared` saves the work of packing its
    /// scene.
    pub fn set_request(
        &mut self,
        order: Option<&RenderRequest>,
        coarse: bool,
        prepared: Option<&PreparedScene>,
    ) -> Result<(), ImageError> {
        let Some(order) = order else {
            if self.order.is_some() {
                *self = Self::new(self.gpu.clone(), self.place, self.report.clone());
            }
            return Ok(());
        };
        let before = self.order.clone();
        let packed = prepared.and_then(|prepared| prepared.packed(&order.scene));
        let outcome = self.apply_request(order, coarse, packed);
        if outcome.is_err() {
            // Keep the last image, but do not treat it as this request's result.
            self.order = before;
            self.scene = None;
            self.packed = None;
        }
        outcome
    }

    fn apply_request(
        &mut self,
        order: &RenderRequest,
        coarse: bool,
        packed: Option<&Arc<PackedScene>>,
    ) -> Result<(), ImageError> {
        let before = self.order.as_ref();
        let scene = self.scenes.of(order);
        let is_other_scene = (self.scene.as_ref()).is_none_or(|it| !Arc::ptr_eq(it, &scene));
        let shows_same = before.is_some_and(|b| b.shows_same(order));
        let has_settings =
            before.is_some_and(|b| b.settings == order.settings && b.policy == order.policy);
        self.stays_coarse = coarse;
        if before.is_some_and(|b| b.tone != order.tone || b.layer != order.layer) {
            self.is_shown = false;
            self.noise = Noise::default();
        }
        let is_other_interval =
            before.is_none_or(|before| before.shutter_interval != order.shutter_interval);
        let differs_in_samples = before.is_some_and(|b| {
            let samples = order.settings.samples;
            RenderSettings {
                samples,
                ..b.settings.clone()
            } == order.settings
                && b.policy == order.policy
        });
        let differs_in_size = order.settings.crop.is_none()
            && before.is_some_and(|b| {
                let size = order.settings.size;
                RenderSettings {
                    size,
                    ..b.settings.clone()
                } == order.settings
                    && b.policy == order.policy
            });
        if let Some(before) = self.order.replace(order.clone()) {
            self.keep_whole(&before.settings, &order.settings);
        }
        if shows_same && has_settings && self.renderer.is_some() {
            // A full-resolution picture is kept when only a preview is wanted, until something changes.
            return Ok(());
        }
        if shows_same && differs_in_samples && self.aim_at(order.settings.samples) {
            return Ok(());
        }
        if is_other_scene || self.packed.is_none() {
            self.is_opening |= self.packed.is_none() || packed.is_some();
            let is_packed = packed.is_some() && Arc::ptr_eq(&scene, &order.scene);
            self.pack(&scene, packed, is_packed)?;
        }
        if is_other_scene || is_other_interval || self.scene.is_none() {
            let (open, close) = order.shutter_interval;
            self.frames = scene.motion_samples(open, close);
        }
        self.scene = Some(scene);
        if shows_same && differs_in_size && !coarse && self.keeps_screen() {
            return self.begin(None);
        }
        // A picture at rest begins coarse too, so that there is something to see at once.
        let divisor = pace::first_divisor(&self.gpu, &mut self.pace, &order.settings);
        self.begin(Some(divisor))
    }

    /// Keeps the picture in full under the one of another size that replaces it. Scaled, it shows more than a
    /// coarse one. Whether there is one.
    fn keeps_screen(&mut self) -> bool {
        if self.is_coarse {
            return false;
        }
        if self.last_look.is_some() {
            self.coarse = self.screen.take();
        }
        self.coarse.is_some()
    }

    /// Continues from the existing samples. Returns whether that is possible.
    fn aim_at(&mut self, samples: u32) -> bool {
        match &mut self.renderer {
            // Restarts the full-resolution picture.
            Some(_) if self.is_coarse => true,
            Some(renderer) => renderer.continue_to(samples),
            None => false,
        }
    }

    /// Keeps the whole picture while only a region of it is rendered. Screens of another region are
    /// discarded.
    fn keep_whole(&mut self, before: &RenderSettings, now: &RenderSettings) {
        if before.crop == now.crop
            || before.size != now.size && now.crop.is_some() == before.crop.is_some()
        {
            return;
        }
        let screen = self.screen.take().filter(|_| !self.is_coarse);
        let screen = screen.or(self.coarse.take());
        if before.crop.is_none() {
            self.whole = screen;
        } else if now.crop.is_none() {
            self.coarse = self.whole.take();
        }
    }

    /// `is_packed`: whether `packed` is this scene, not the one that it was made from.
    fn pack(
        &mut self,
        scene: &Scene,
        packed: Option<&Arc<PackedScene>>,
        is_packed: bool,
    ) -> Result<(), ImageError> {
        let packed = match packed.or(self.packed.as_ref()) {
            Some(packed) if is_packed => packed.clone(),
            Some(before) => Arc::new(pack::scene_from(before, scene)?),
            None => {
                let triangles = scene.triangle_count();
                (self.report)(Stage::BuildingBvh { triangles });
                Arc::new(pack::scene(scene)?)
            }
        };
        self.trees_built += packed.work.total();
        self.packed = Some(packed);
        Ok(())
    }

    /// Starts the picture over: coarse by a divisor of its width and height, or in full.
    fn begin(&mut self, divisor: Option<u32>) -> Result<(), ImageError> {
        let (Some(order), Some(packed)) = (&self.order, &self.packed) else {
            return Ok(());
        };
        let view = view(packed, self.view.as_ref(), &self.frames, order)?;
        let has_tlas = (self.view.as_ref()).is_some_and(|before| before.shares_tlas(&view));
        self.trees_built += usize::from(packed.features.instances && !has_tlas);
        let settings = match divisor {
            Some(divisor) => pace::coarse(&order.settings, divisor),
            None => order.settings.clone(),
        };
        let policy = pace::policy(&self.gpu, order.policy);
        let packed = packed.clone();
        if self.is_opening {
            (self.report)(Stage::Uploading);
        }
        match &mut self.renderer {
            Some(renderer) => renderer.restart(packed, &view, settings, policy)?,
            None => {
                let gpu = self.gpu.clone();
                self.renderer = Some(Renderer::new(gpu, packed, &view, settings, policy)?);
            }
        }
        if self.is_opening {
            (self.report)(Stage::FirstSamples { share: 0.0 });
        }
        self.view = Some(view);
        self.is_coarse = divisor.is_some();
        self.divisor = divisor.unwrap_or(1);
        self.is_shown = false;
        self.last_look = None;
        self.busy = 0.0;
        self.noise = Noise::default();
        if let Some(renderer) = &self.renderer {
            let stats = renderer.stats();
            self.spent = Spent {
                seconds: stats.trace_seconds,
                samples: stats.samples,
            };
        }
        Ok(())
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
    pub fn looks(&self) -> u64 {
        self.looks
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
        let Some(order) = &self.order else {
            return Ok(());
        };
        let pixels = pace::pixels(&order.settings);
        match self.pace.next(pixels, self.divisor) {
            1 => self.begin(None),
            divisor => self.begin(Some(divisor)),
        }
    }

    /// Adds samples for a slice of time and shows them. Those of a `paused` picture are only shown, once
    /// there are any.
    pub fn step(&mut self, paused: bool) -> Result<(), ImageError> {
        let started = Instant::now();
        let is_traced = self.renderer.as_ref().is_some_and(Renderer::is_done);
        if self.is_coarse && !self.stays_coarse && is_traced && self.is_shown && !paused {
            self.refine()?;
        }
        let (Some(renderer), Some(order)) = (&mut self.renderer, &self.order) else {
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
        let interval = match renderer.shows_directly() && order.layer == PictureLayer::Beauty {
            true => pace::between_looks(&self.gpu),
            false => DETOUR,
        };
        let interval = match renderer.denoises(&order.tone) {
            true => interval.max(DENOISED),
            false => interval,
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
        let screen = match self.is_coarse {
            true => &mut self.coarse,
            false => &mut self.screen,
        };
        let [.., width, height] = renderer.region();
        let screen = match screen {
            Some(screen) if screen.size() == (width, height) => screen,
            _ => screen.insert(renderer.new_screen()?),
        };
        self.range = match order.layer {
            layer if layer != PictureLayer::Beauty && order.settings.has_features() => {
                let features = renderer.features()?;
                let image = layer_picture::picture(layer, &features, &order.tone, &self.gpu)?;
                screen.write(&self.gpu, &(&image).into())?;
                None
            }
            _ => renderer.show(&order.tone, screen)?,
        };
        self.busy += started.elapsed().as_secs_f64();
        if self.is_coarse && self.last_look.is_none() {
            (self.pace).measured(self.busy, u64::from(width) * u64::from(height));
        }
        self.is_shown = true;
        self.last_look = Some(Instant::now());
        self.looks += 1;
        self.is_opening = false;
        self.estimate_noise()
    }

    /// Estimates the noise each time the samples have doubled.
    fn estimate_noise(&mut self) -> Result<(), ImageError> {
        let (Some(renderer), Some(order)) = (&mut self.renderer, &self.order) else {
            return Ok(());
        };
        let samples = renderer.samples_done();
        let is_estimable = !self.is_coarse
            && self.place == PictureSlot::Main
            && order.settings.antialias != Antialias::None;
        if is_estimable && self.noise.is_due(samples) {
            self.noise.look(&renderer.develop(&order.tone)?, samples);
        }
        Ok(())
    }

    /// For questions; `None` while the renderer's film holds the preview.
    pub fn frame(&mut self) -> Option<FrameRenderer<'_>> {
        (!self.is_coarse).then_some(())?;
        Some(FrameRenderer {
            renderer: self.renderer.as_mut()?,
            order: self.order.as_ref()?,
            screen: self.screen.as_ref().filter(|_| self.last_look.is_some()),
            outside: None,
        })
    }
}
