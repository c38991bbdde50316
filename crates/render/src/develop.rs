//! Develops sums to a picture: `kernels/develop.wesl`.

use super::{
    Fetch, Integrator, Quantity, RenderError, RenderSettings, Renderer, Slicing, Tone,
    bindings::Buffers,
    denoise_async,
    film_pass::{PIXEL_BYTES, add_film_pass, check_memory},
    film_tile::{FilmTile, GroupOrder, rectangles},
    layouts::{Layouts, group},
    levels, overrides, pipelines,
    slice::Slice,
    sums::PixelRows,
};
use crate::{
    gpu::{Gpu, GpuError, Kernel, Source},
    layout::{
        PackedDispatch, PackedFrame, PackedLight, PackedTone, TONE_ACES, TONE_AGX, TONE_NEUTRAL,
        TONE_NONE, TONE_REINHARD, TRANSFER_LINEAR, TRANSFER_SRGB,
    },
};
use bytemuck::{bytes_of, cast_slice};
use glimray_scene::clock::Instant;
use glimray_scene::{ToneCurve, Transfer, image::Image};
use wgpu::BufferUsages;

impl Tone {
    /// Develops linear radiance to a picture, as [`Renderer::develop`] does with that of a renderer. Opacity is kept.
    ///
    /// # Errors
    /// The device failed, or the picture exceeds [`crate::gpu::MEMORY_LIMIT_BYTES`].
    pub async fn develop_async(&self, gpu: &Gpu, image: &Image) -> Result<Image, RenderError> {
        let (width, height) = (image.width, image.height);
        check_memory(width, height, PIXEL_BYTES)?;
        let region = [0, 0, width, height];
        let pixels = image.pixels.iter();
        let sums: Vec<_> = pixels.clone().map(|&[r, g, b, _]| [r, g, b, 1.0]).collect();
        let tone = self
            .exposed(|| sums.iter())
            .packed(Integrator::Whitted, None, 1);
        let mut developed = develop_sums(gpu, region, &sums, &tone).await?;
        for (developed, pixel) in developed.pixels.iter_mut().zip(pixels) {
            developed[3] = pixel[3];
        }
        Ok(developed)
    }

    /// Creates the pipeline with which [`Renderer::develop`] develops pictures of this integrator on this device, so that
    /// it waits less.
    ///
    /// # Errors
    /// The device failed.
    pub fn prepare(&self, gpu: &Gpu, integrator: Integrator) -> Result<(), RenderError> {
        let layouts = Layouts::new(gpu, Fetch::Buffer);
        let overrides = overrides::of_tone(&self.packed(integrator, None, 1));
        pipelines::developing(gpu, &layouts, Kernel::DEVELOP, &layouts.develop, overrides)?;
        Ok(())
    }

    /// The packed tone, with a range for a quantity if there is one, for a film with this many rows per pixel.
    pub(super) fn packed(
        &self,
        integrator: Integrator,
        range: Option<[f32; 2]>,
        film_rows: usize,
    ) -> PackedTone {
        let [least, most] = range.unwrap_or_default();
        PackedTone {
            exposure_scale: self.exposure_ev.exp2(),
            curve: match self.curve {
                ToneCurve::None => TONE_NONE,
                ToneCurve::Aces => TONE_ACES,
                ToneCurve::Agx => TONE_AGX,
                ToneCurve::Reinhard => TONE_REINHARD,
                ToneCurve::Neutral => TONE_NEUTRAL,
            },
            transfer: match self.transfer {
                Transfer::Srgb => TRANSFER_SRGB,
                Transfer::Linear => TRANSFER_LINEAR,
            },
            view: integrator.entry().view,
            range: [least, most],
            has_range: range.is_some().into(),
            film_rows: film_rows as u32,
        }
    }
}

/// GPU resources for developing, created on first use.
pub struct Developer {
    developed: wgpu::Buffer,
    tone: wgpu::Buffer,
    group: wgpu::BindGroup,
}

/// The device and buffers with which a film is developed.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    pub gpu: &'a Gpu,
    pub layouts: &'a Layouts,
    pub frame_group: &'a wgpu::BindGroup,
    pub film_group: &'a wgpu::BindGroup,
    pub dispatch: &'a wgpu::Buffer,
    pub staging: &'a wgpu::Buffer,
}

impl<'a> Context<'a> {
    fn new(gpu: &'a Gpu, layouts: &'a Layouts, buffers: &'a Buffers) -> Self {
        Self {
            gpu,
            layouts,
            frame_group: &buffers.frame_group,
            film_group: &buffers.film_group,
            dispatch: &buffers.dispatch,
            staging: &buffers.staging,
        }
    }
}

impl Renderer {
    /// Develops the samples so far to a picture, also before the render is done. Changing the tone requires no
    /// new rays.
    ///
    /// # Errors
    /// The device failed, or there is no memory for the picture.
    pub async fn develop_async(&mut self, tone: &Tone) -> Result<Image, RenderError> {
        let start = Instant::now();
        let image = self.developed(tone).await?;
        self.stats.develop_seconds += start.elapsed().as_secs_f64();
        Ok(image)
    }

    async fn developed(&mut self, tone: &Tone) -> Result<Image, RenderError> {
        if self.denoises(tone) {
            let features = self.features_async().await?;
            let image = denoise_async(&features.picture(), self.gpu(), &features)
                .await?
                .image;
            return tone.develop_async(self.gpu(), &image).await;
        }
        if let Some(image) = self.transparent_picture().await? {
            return tone.develop_async(self.gpu(), &image).await;
        }
        let is_direct = self.develops_directly();
        match is_direct {
            true => self.finish_work().await?,
            false => self.fetch_film().await?,
        }
        let tone = &self.exposed(tone).await?;
        let range = self.range_of(tone).await?;
        let region = self.settings.region();
        if self.settings.integrator.quantity() == Some(Quantity::Samples) {
            return Ok(sample_count_image(
                region,
                &self.counts(),
                self.settings.samples,
                range,
            ));
        }
        let [.., width, height] = region;
        let mut image = Image::new(width, height);
        if is_direct {
            let tile = self.tiles.list[0].blank();
            let tone = tone.packed(self.settings.integrator, range, tile.rows_per_pixel());
            while let Err(error) = self.develop_tile(&tile, None, &tone, &mut image).await {
                self.recover_from(error)?;
            }
            return Ok(image);
        }
        for (tile, rows) in self.tiles.developable(self.policy.slicing.tile_side) {
            let tone = tone.packed(self.settings.integrator, range, tile.rows_per_pixel());
            let rows = Some(&rows[..]);
            while let Err(error) = self.develop_tile(&tile, rows, &tone, &mut image).await {
                self.recover_from(error)?;
            }
        }
        Ok(image)
    }

    /// Develops a film tile with these rows, or the only one, to its part of a picture.
    async fn develop_tile(
        &mut self,
        tile: &FilmTile,
        rows: Option<&[[f32; 4]]>,
        tone: &PackedTone,
        image: &mut Image,
    ) -> Result<(), GpuError> {
        match rows {
            Some(rows) => self.device.load_film(None, rows)?,
            None => self.load_first_tile()?,
        }
        let device = &mut self.device;
        let context = Context::new(&device.gpu, &device.layouts, &device.buffers);
        let developer = match &mut device.developer {
            Some(developer) => developer,
            empty => empty.insert(Developer::new(context, self.tiles.largest())?),
        };
        (developer.develop(context, tile, &self.settings, tone, image)).await
    }
}

impl Developer {
    /// For film tiles of at most `max_pixels` pixels.
    pub fn new(context: Context, max_pixels: usize) -> Result<Self, GpuError> {
        let Context { gpu, layouts, .. } = context;
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let developed = gpu.allocate("developed", max_pixels as u64 * 16, usage)?;
        let tone = gpu.upload("tone", bytes_of(&PackedTone::default()))?;
        let resources = [tone.as_entire_binding(), developed.as_entire_binding()];
        let group = group(gpu, &layouts.develop, &resources);
        Ok(Self {
            developed,
            tone,
            group,
        })
    }

    /// Develops the film tile in the film buffer to its part of a picture.
    pub async fn develop(
        &self,
        context: Context<'_>,
        tile: &FilmTile,
        settings: &RenderSettings,
        tone: &PackedTone,
        image: &mut Image,
    ) -> Result<(), GpuError> {
        let Context { gpu, layouts, .. } = context;
        let target = &layouts.develop;
        let overrides = overrides::of_tone(tone);
        let pipeline = pipelines::developing(gpu, layouts, Kernel::DEVELOP, target, overrides)?;
        let slice = Slice {
            first_group: 0,
            end_group: tile.group_count(),
            first_sample: 0,
            end_sample: 0,
        };
        let packed = slice.packed(tile, settings, 1);
        gpu.write(context.dispatch, 0, bytes_of(&packed))?;
        gpu.write(&self.tone, 0, bytes_of(tone))?;

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let groups = [context.frame_group, context.film_group, &self.group];
        add_film_pass(&mut encoder, &pipeline, groups, slice.grid(1));
        let source = Source {
            buffer: &self.developed,
            offset: 0,
            bytes: u64::from(tile.width) * u64::from(tile.height) * 16,
        };
        let [x, y, ..] = settings.region();
        gpu.submit_and_read(encoder, &[source], context.staging, |bytes| {
            image.put(cast_slice(bytes), tile.width, [tile.x - x, tile.y - y]);
        })
        .await
    }
}

/// Develops weighted sums without a renderer: one row for each pixel of a region (x, y, width, height), row by row.
pub async fn develop_sums(
    gpu: &Gpu,
    region: [u32; 4],
    sums: &[[f32; 4]],
    tone: &PackedTone,
) -> Result<Image, RenderError> {
    let [x, y, width, height] = region;
    let mut image = Image::new(width, height);
    let tiles = rectangles(
        region,
        Slicing::default().tile_side,
        0..0,
        PixelRows::ONE,
        GroupOrder::Diagonal,
    );
    let Some(most) = tiles.iter().map(FilmTile::pixel_count).max() else {
        return Ok(image);
    };
    let layouts = Layouts::new(gpu, Fetch::Buffer);
    let written = BufferUsages::STORAGE | BufferUsages::COPY_DST;
    let film = gpu.allocate("film", most as u64 * 16, written)?;
    let read = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
    let staging = gpu.allocate("staging", most as u64 * 16, read)?;
    let dispatch = gpu.allocate("dispatch", size_of::<PackedDispatch>() as u64, written)?;
    // The layout requires a frame, which is not used.
    let frame = (PackedFrame::default(), PackedLight::default());
    let frame = gpu.upload("frame", &[bytes_of(&frame.0), bytes_of(&frame.1)].concat())?;
    let shared = [frame.as_entire_binding(), dispatch.as_entire_binding()];
    let context = Context {
        gpu,
        layouts: &layouts,
        frame_group: &group(gpu, &layouts.frame, &shared),
        film_group: &group(gpu, &layouts.film, &[film.as_entire_binding()]),
        dispatch: &dispatch,
        staging: &staging,
    };
    let developer = Developer::new(context, most)?;
    let settings = RenderSettings {
        size: (x + width, y + height),
        crop: Some([x, y, x + width, y + height]),
        ..RenderSettings::default()
    };
    let sum = |[px, py]: [u32; 2]| sums[(py - y) as usize * width as usize + (px - x) as usize];
    for tile in tiles {
        gpu.write(&film, 0, cast_slice(&tile.rows_of(sum)))?;
        (developer.develop(context, &tile, &settings, tone, &mut image)).await?;
    }
    Ok(image)
}

/// A picture of sample counts, as grey levels over a range or as fractions of `max`.
pub fn sample_count_image(
    [.., width, height]: [u32; 4],
    counts: &[f32],
    max: u32,
    range: Option<[f32; 2]>,
) -> Image {
    let mut image = Image::new(width, height);
    for (pixel, count) in image.pixels.iter_mut().zip(counts) {
        let level = range.map_or(count / max as f32, |range| {
            levels::position_in_range(*count, range)
        });
        *pixel = [level, level, level, 1.0];
    }
    image
}
