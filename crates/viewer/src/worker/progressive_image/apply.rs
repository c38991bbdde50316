//! Applies requests: what of the picture is still valid stays.

use super::{ImageError, Noise, ProgressiveImage, Spent, pace, packing::view};
use crate::worker::request::{PreparedScene, RenderRequest};
use crate::worker::stage::Stage;
use glimray_render::pack::{self, PackedScene};
use glimray_render::{Integrator, RenderSettings, Renderer};
use glimray_scene::Scene;
use std::sync::Arc;

impl ProgressiveImage {
    /// Applies a request and keeps the results that are still valid. `prepared` saves the work of packing its
    /// scene.
    ///
    /// # Errors
    /// The scene cannot be packed or rendered. The last picture stays.
    pub fn set_request(
        &mut self,
        request: Option<&RenderRequest>,
        coarse: bool,
        prepared: Option<&PreparedScene>,
    ) -> Result<(), ImageError> {
        let Some(request) = request else {
            if self.request.is_some() {
                *self = Self::new(self.gpu.clone(), self.place, self.report.clone());
            }
            return Ok(());
        };
        let before = self.request.clone();
        let packed = prepared.and_then(|prepared| prepared.packed(&request.scene));
        let outcome = self.apply_request(request, coarse, packed);
        if outcome.is_err() {
            // Keep the last image, but do not treat it as this request's result.
            self.request = before;
            self.scene = None;
            self.packed = None;
        }
        outcome
    }

    fn apply_request(
        &mut self,
        request: &RenderRequest,
        coarse: bool,
        packed: Option<&Arc<PackedScene>>,
    ) -> Result<(), ImageError> {
        let before = self.request.as_ref();
        let scene = self.scenes.of(request);
        let is_other_scene = (self.scene.as_ref()).is_none_or(|it| !Arc::ptr_eq(it, &scene));
        let shows_same = before.is_some_and(|b| b.shows_same(request));
        // Whether the settings are those of before, once this has taken over some of them.
        let shares_rest = |take: fn(&mut RenderSettings, &RenderSettings)| {
            before.is_some_and(|b| {
                let mut settings = b.settings.clone();
                take(&mut settings, &request.settings);
                settings == request.settings && b.policy == request.policy
            })
        };
        let has_settings = shares_rest(|_, _| ());
        let differs_in_samples = shares_rest(|before, now| before.samples = now.samples);
        let differs_in_size =
            request.settings.crop.is_none() && shares_rest(|before, now| before.size = now.size);
        self.stays_coarse = coarse;
        if before.is_some_and(|b| !b.is_developed_like(request)) {
            self.is_shown = false;
            self.noise = Noise::default();
        }
        let is_other_interval =
            before.is_none_or(|before| before.shutter_interval != request.shutter_interval);
        if let Some(before) = self.request.replace(request.clone()) {
            self.keep_whole(&before.settings, &request.settings);
        }
        let is_first = is_other_scene || self.packed.is_none();
        // The scene is unchanged, but its BVHs are no longer drafts.
        let is_refined =
            !is_first && packed.is_some_and(|packed| Arc::as_ptr(packed) != self.prepared.as_ptr());
        let is_packed = packed.is_some() && Arc::ptr_eq(&scene, &request.scene);
        if shows_same && has_settings && self.renderer.is_some() {
            // A full-resolution picture is kept when only a preview is wanted, until something changes.
            return match is_refined {
                true => self.refine_trees(&scene, packed, is_packed),
                false => Ok(()),
            };
        }
        if shows_same && differs_in_samples && self.aim_at(request.settings.samples) {
            return Ok(());
        }
        self.is_opening |= is_first && (self.packed.is_none() || packed.is_some());
        if is_first || is_refined {
            self.pack(&scene, packed, is_packed)?;
        }
        if is_other_scene || is_other_interval || self.scene.is_none() {
            let (open, close) = request.shutter_interval;
            self.frames = scene.motion_samples(open, close);
        }
        self.scene = Some(scene);
        if shows_same && differs_in_size && !coarse && self.keeps_screen() {
            return self.begin(None);
        }
        // A picture at rest begins coarse too, so that there is something to see at once.
        let divisor = pace::first_divisor(&self.gpu, &mut self.pace, &request.settings);
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
        if let Some(packed) = packed {
            self.prepared = Arc::downgrade(packed);
        }
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

    /// Goes on with the same picture and better BVHs. It keeps all samples, unless they tell of the BVHs.
    fn refine_trees(
        &mut self,
        scene: &Scene,
        packed: Option<&Arc<PackedScene>>,
        is_packed: bool,
    ) -> Result<(), ImageError> {
        let draft = self.packed.clone();
        self.pack(scene, packed, is_packed)?;
        let (Some(request), Some(packed), Some(renderer)) =
            (&self.request, &self.packed, &mut self.renderer)
        else {
            return Ok(());
        };
        let divisor = self.is_coarse.then_some(self.divisor);
        let integrator = request.settings.integrator;
        if integrator.entry().counts_steps || integrator == Integrator::Ids {
            return self.begin(divisor);
        }
        let view = view(packed, self.view.as_ref(), &self.frames, request)?;
        let policy = pace::policy(&self.gpu, request.policy);
        match renderer.replace_scene(packed.clone(), &view, policy) {
            Ok(()) => {
                self.view = Some(view);
                Ok(())
            }
            // For example, there is no memory for both: the picture stays with its draft.
            Err(_) => {
                self.packed = draft;
                self.begin(divisor)
            }
        }
    }

    /// Starts the picture over: coarse by a divisor of its width and height, or in full.
    pub(super) fn begin(&mut self, divisor: Option<u32>) -> Result<(), ImageError> {
        let (Some(request), Some(packed)) = (&self.request, &self.packed) else {
            return Ok(());
        };
        let view = view(packed, self.view.as_ref(), &self.frames, request)?;
        let has_tlas = (self.view.as_ref()).is_some_and(|before| before.shares_tlas(&view));
        self.trees_built += usize::from(packed.features.instances && !has_tlas);
        let settings = match divisor {
            Some(divisor) => pace::coarse(request, divisor),
            None => request.settings.clone(),
        };
        let policy = pace::policy(&self.gpu, request.policy);
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
}
