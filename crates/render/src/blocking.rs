//! Functions that wait for the device, for programs whose threads may wait. Each has the results and the errors of the one
//! that it awaits.

use super::{
    CatcherLight, Checkpoint, Denoised, ExecutionPolicy, Features, Film, QueryHit, QueryRay,
    RayBatch, RayQuery, RaySteps, RayTest, RayTree, RenderError, Renderer, Screen, Tone,
    denoise_async,
};
use crate::{
    gpu::{Gpu, blocking::wait},
    pack::{PackedScene, PackedView},
};
use glimray_scene::image::{Image, ScreenImage};
use std::{ops::Range, sync::Arc};

/// Awaits [`denoise_async`].
pub fn denoise(image: &Image, gpu: &Gpu, features: &Features) -> Result<Denoised, RenderError> {
    wait(denoise_async(image, gpu, features))
}

impl Renderer {
    /// Awaits [`Self::step_async`].
    pub fn step(&mut self) -> Result<(), RenderError> {
        wait(self.step_async())
    }

    /// Awaits [`Self::develop_async`].
    pub fn develop(&mut self, tone: &Tone) -> Result<Image, RenderError> {
        wait(self.develop_async(tone))
    }

    /// Awaits [`Self::show_async`].
    pub fn show(&mut self, tone: &Tone, screen: &Screen) -> Result<Option<[f32; 2]>, RenderError> {
        wait(self.show_async(tone, screen))
    }

    /// Awaits [`Self::read_pixel_async`].
    pub fn read_pixel(&self, screen: &Screen, pixel: [u32; 2]) -> Result<[u8; 4], RenderError> {
        wait(self.read_pixel_async(screen, pixel))
    }

    /// Awaits [`Self::features_async`].
    pub fn features(&mut self) -> Result<Features, RenderError> {
        wait(self.features_async())
    }

    /// Awaits [`Self::range_async`].
    pub fn range(&mut self) -> Result<Option<[f32; 2]>, RenderError> {
        wait(self.range_async())
    }

    /// Awaits [`Self::exposure_async`].
    pub fn exposure(&mut self) -> Result<f32, RenderError> {
        wait(self.exposure_async())
    }

    /// Awaits [`Self::catcher_light_async`].
    pub fn catcher_light(&mut self) -> Result<CatcherLight, RenderError> {
        wait(self.catcher_light_async())
    }

    /// Awaits [`Self::checkpoint_async`].
    pub fn checkpoint(&mut self) -> Result<Checkpoint<'_>, RenderError> {
        wait(self.checkpoint_async())
    }

    /// Awaits [`Self::explain_async`].
    pub fn explain(
        &mut self,
        pixel: [u32; 2],
        samples: Range<u32>,
    ) -> Result<RayTree, RenderError> {
        wait(self.explain_async(pixel, samples))
    }

    /// Awaits [`Self::explain_pixels_async`].
    pub fn explain_pixels(
        &mut self,
        pixels: &[([u32; 2], Range<u32>)],
    ) -> Result<Vec<RayTree>, RenderError> {
        wait(self.explain_pixels_async(pixels))
    }

    /// Awaits [`Self::replace_scene_async`].
    pub fn replace_scene(
        &mut self,
        scene: Arc<PackedScene>,
        view: &PackedView,
        policy: ExecutionPolicy,
    ) -> Result<(), RenderError> {
        wait(self.replace_scene_async(scene, view, policy))
    }
}

impl Screen {
    /// Awaits [`Self::read_async`].
    pub fn read(&self, gpu: &Gpu) -> Result<ScreenImage, RenderError> {
        wait(self.read_async(gpu))
    }
}

impl Tone {
    /// Awaits [`Self::develop_async`].
    pub fn develop(&self, gpu: &Gpu, image: &Image) -> Result<Image, RenderError> {
        wait(self.develop_async(gpu, image))
    }
}

impl Film {
    /// Awaits [`Self::develop_async`].
    pub fn develop(&self, gpu: &Gpu, tone: &Tone) -> Result<Image, RenderError> {
        wait(self.develop_async(gpu, tone))
    }
}

impl RayQuery {
    /// Awaits [`Self::closest_hits_async`].
    pub fn closest_hits(&self, rays: &[QueryRay]) -> Result<Vec<Option<QueryHit>>, RenderError> {
        wait(self.closest_hits_async(rays))
    }

    /// Awaits [`Self::occluded_async`].
    pub fn occluded(&self, rays: &[QueryRay]) -> Result<Vec<bool>, RenderError> {
        wait(self.occluded_async(rays))
    }

    /// Awaits [`Self::closest_hits_of_async`].
    pub fn closest_hits_of(&self, batch: &RayBatch) -> Result<Vec<Option<QueryHit>>, RenderError> {
        wait(self.closest_hits_of_async(batch))
    }

    /// Awaits [`Self::occluded_of_async`].
    pub fn occluded_of(&self, batch: &RayBatch) -> Result<Vec<bool>, RenderError> {
        wait(self.occluded_of_async(batch))
    }

    /// Awaits [`Self::steps_async`].
    pub fn steps(&self, batch: &RayBatch, test: RayTest) -> Result<Vec<RaySteps>, RenderError> {
        wait(self.steps_async(batch, test))
    }

    /// Awaits [`Self::packet_steps_async`].
    pub fn packet_steps(
        &self,
        batch: &RayBatch,
        test: RayTest,
    ) -> Result<Option<Vec<RaySteps>>, RenderError> {
        wait(self.packet_steps_async(batch, test))
    }

    /// Awaits [`Self::seconds_async`].
    pub fn seconds(
        &self,
        batch: &RayBatch,
        test: RayTest,
        passes: u32,
    ) -> Result<f64, RenderError> {
        wait(self.seconds_async(batch, test, passes))
    }
}
