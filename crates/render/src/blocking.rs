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

/// Removes noise from a picture by its features, and waits for the device.
///
/// # Errors
/// As [`denoise_async`].
pub fn denoise(image: &Image, gpu: &Gpu, features: &Features) -> Result<Denoised, RenderError> {
    wait(denoise_async(image, gpu, features))
}

impl Renderer {
    /// Adds samples for about [`super::Slicing::target_seconds`], and waits for the device. Does nothing if the render is done.
    ///
    /// # Errors
    /// As [`Self::step_async`].
    pub fn step(&mut self) -> Result<(), RenderError> {
        wait(self.step_async())
    }

    /// Develops the samples so far to a picture, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::develop_async`].
    pub fn develop(&mut self, tone: &Tone) -> Result<Image, RenderError> {
        wait(self.develop_async(tone))
    }

    /// Develops the samples so far to a screen, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::show_async`].
    pub fn show(&mut self, tone: &Tone, screen: &Screen) -> Result<Option<[f32; 2]>, RenderError> {
        wait(self.show_async(tone, screen))
    }

    /// Reads a pixel of a screen, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::read_pixel_async`].
    pub fn read_pixel(&self, screen: &Screen, pixel: [u32; 2]) -> Result<[u8; 4], RenderError> {
        wait(self.read_pixel_async(screen, pixel))
    }

    /// Reads the features of the picture so far, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::features_async`].
    pub fn features(&mut self) -> Result<Features, RenderError> {
        wait(self.features_async())
    }

    /// Finds the range of the quantity that is shown, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::range_async`].
    pub fn range(&mut self) -> Result<Option<[f32; 2]>, RenderError> {
        wait(self.range_async())
    }

    /// Finds an exposure for the picture so far, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::exposure_async`].
    pub fn exposure(&mut self) -> Result<f32, RenderError> {
        wait(self.exposure_async())
    }

    /// Finds the light on a shadow catcher, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::catcher_light_async`].
    pub fn catcher_light(&mut self) -> Result<CatcherLight, RenderError> {
        wait(self.catcher_light_async())
    }

    /// Makes a checkpoint of the samples so far, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::checkpoint_async`].
    pub fn checkpoint(&mut self) -> Result<Checkpoint<'_>, RenderError> {
        wait(self.checkpoint_async())
    }

    /// Traces the rays of a pixel again, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::explain_async`].
    pub fn explain(
        &mut self,
        pixel: [u32; 2],
        samples: Range<u32>,
    ) -> Result<RayTree, RenderError> {
        wait(self.explain_async(pixel, samples))
    }

    /// Traces the rays of pixels again, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::explain_pixels_async`].
    pub fn explain_pixels(
        &mut self,
        pixels: &[([u32; 2], Range<u32>)],
    ) -> Result<Vec<RayTree>, RenderError> {
        wait(self.explain_pixels_async(pixels))
    }

    /// Goes on with another packing of the same scene and frame, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::replace_scene_async`].
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
    /// Reads the contents of the screen, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::read_async`].
    pub fn read(&self, gpu: &Gpu) -> Result<ScreenImage, RenderError> {
        wait(self.read_async(gpu))
    }
}

impl Tone {
    /// Develops a picture of linear radiance, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::develop_async`].
    pub fn develop(&self, gpu: &Gpu, image: &Image) -> Result<Image, RenderError> {
        wait(self.develop_async(gpu, image))
    }
}

impl Film {
    /// Develops the film to a picture, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::develop_async`].
    pub fn develop(&self, gpu: &Gpu, tone: &Tone) -> Result<Image, RenderError> {
        wait(self.develop_async(gpu, tone))
    }
}

impl RayQuery {
    /// Finds the closest hit of each ray, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub fn closest_hits(&self, rays: &[QueryRay]) -> Result<Vec<Option<QueryHit>>, RenderError> {
        wait(self.closest_hits_async(rays))
    }

    /// Finds whether anything is in the way of each ray, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::occluded_async`].
    pub fn occluded(&self, rays: &[QueryRay]) -> Result<Vec<bool>, RenderError> {
        wait(self.occluded_async(rays))
    }

    /// Finds the closest hit of each ray of a batch, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::closest_hits_of_async`].
    pub fn closest_hits_of(&self, batch: &RayBatch) -> Result<Vec<Option<QueryHit>>, RenderError> {
        wait(self.closest_hits_of_async(batch))
    }

    /// Finds whether anything is in the way of each ray of a batch, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::occluded_of_async`].
    pub fn occluded_of(&self, batch: &RayBatch) -> Result<Vec<bool>, RenderError> {
        wait(self.occluded_of_async(batch))
    }

    /// Counts the steps of each ray, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::steps_async`].
    pub fn steps(&self, batch: &RayBatch, test: RayTest) -> Result<Vec<RaySteps>, RenderError> {
        wait(self.steps_async(batch, test))
    }

    /// Counts the steps of each packet, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::packet_steps_async`].
    pub fn packet_steps(
        &self,
        batch: &RayBatch,
        test: RayTest,
    ) -> Result<Option<Vec<RaySteps>>, RenderError> {
        wait(self.packet_steps_async(batch, test))
    }

    /// Measures the time of the rays of a batch, and waits for the device.
    ///
    /// # Errors
    /// As [`Self::seconds_async`].
    pub fn seconds(
        &self,
        batch: &RayBatch,
        test: RayTest,
        passes: u32,
    ) -> Result<f64, RenderError> {
        wait(self.seconds_async(batch, test, passes))
    }
}
