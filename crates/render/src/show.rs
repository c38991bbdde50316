//! Develops sums to a texture on the GPU: `kernels/show.wesl`.

use super::{
    Levels, Quantity, RenderError, Renderer, Tone,
    denoise::Denoiser,
    device::OtherWork,
    film_pass::add_film_pass,
    layouts::{SCREEN_FORMAT, target},
    overrides, pipelines,
    slice::Slice,
};
use crate::{
    gpu::{Gpu, GpuError, Kernel, Source, Variant},
    layout::PackedTone,
};
use bytemuck::{bytes_of, cast_slice};
use glimray_scene::image::ScreenImage;
use wgpu::BindingResource;

/// A texture for display, as large as the picture: 8 bits per channel, encoded with the transfer function of
/// the tone, premultiplied alpha. A program draws it on its own device while the picture develops; nothing waits for the GPU:
///
/// ```
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// use glimray::gpu::Gpu;
/// use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Status, Tone};
/// use glimray::{import, pack};
/// use std::{path::Path, sync::Arc};
///
/// // The set-up of any wgpu program.
/// let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
/// let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
/// let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
/// let gpu = Gpu::from_wgpu(instance, adapter, device.clone(), queue.clone());
///
/// let scene = import::load(Path::new("assets/scenes/carousel.toml"))?;
/// let packed = Arc::new(pack::scene(&scene)?);
/// let view = packed.frame(&scene.frame(0.0))?;
/// let settings = RenderSettings { size: (64, 36), samples: 2, ..RenderSettings::from(&scene.output) };
/// // The film stays on the GPU.
/// let policy = ExecutionPolicy { host_copy: false, ..ExecutionPolicy::default() };
/// let mut renderer = Renderer::new(gpu, packed, &view, settings, policy)?;
/// let screen = renderer.new_screen()?;
/// loop {
///     // Once for each frame of the window.
///     let status = renderer.poll()?;
///     renderer.show(&Tone::from(&scene.output), &screen)?;
///     // Here the program draws `screen.view()`.
///     if status == Status::Done {
///         break;
///     }
///     renderer.submit()?;
/// }
/// let shown = screen.read(renderer.gpu())?;
/// assert!(shown.pixels.iter().any(|pixel| pixel[0] > 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    view: wgpu::TextureView,
}

impl Screen {
    /// The texture, to be sampled without conversion.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (u32, u32) {
        let texture = self.view.texture();
        (texture.width(), texture.height())
    }

    /// A screen that shows an image of at least one pixel.
    ///
    /// # Errors
    /// The image is larger than the adapter's textures, or the device failed.
    pub fn of(gpu: &Gpu, image: &ScreenImage) -> Result<Self, RenderError> {
        let view = gpu.allocate_screen(image.width, image.height, SCREEN_FORMAT)?;
        let screen = Self { view };
        screen.write(gpu, image)?;
        Ok(screen)
    }

    /// Replaces the contents by an image of the same size.
    ///
    /// # Errors
    /// The device failed.
    pub fn write(&self, gpu: &Gpu, image: &ScreenImage) -> Result<(), RenderError> {
        Ok(gpu.write_image(&self.view, 0, cast_slice(&image.pixels))?)
    }

    /// All pixels as they are displayed.
    ///
    /// # Errors
    /// The device failed.
    pub async fn read_async(&self, gpu: &Gpu) -> Result<ScreenImage, RenderError> {
        let (width, height) = self.size();
        let pixels = self.read_part(gpu, [0, 0, width, height]).await?;
        Ok(ScreenImage {
            width,
            height,
            pixels,
        })
    }

    /// The pixels of a rectangle (x, y, width, height), row by row.
    async fn read_part(
        &self,
        gpu: &Gpu,
        [x, y, width, height]: [u32; 4],
    ) -> Result<Vec<[u8; 4]>, GpuError> {
        let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let bytes = u64::from(row) * u64::from(height);
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let texels = gpu.allocate("texels", bytes, usage)?;
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let staging = gpu.allocate("staging", bytes, usage)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let texture = wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x, y, z: 0 },
            ..self.view.texture().as_image_copy()
        };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        let target = wgpu::TexelCopyBufferInfo {
            buffer: &texels,
            layout,
        };
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        encoder.copy_texture_to_buffer(texture, target, size);
        let source = Source {
            buffer: &texels,
            offset: 0,
            bytes,
        };
        gpu.submit_and_read(encoder, &[source], &staging, |bytes| {
            let rows = bytes.chunks_exact(row as usize);
            let rows = rows.flat_map(|row| row[..4 * width as usize].as_chunks::<4>().0);
            rows.copied().collect()
        })
        .await
    }
}

impl Renderer {
    /// A black screen of the size of the picture or its crop.
    ///
    /// # Errors
    /// The device has no memory for it.
    pub fn new_screen(&self) -> Result<Screen, RenderError> {
        let [.., width, height] = self.settings.region();
        let view = self
            .device
            .gpu
            .allocate_screen(width, height, SCREEN_FORMAT)?;
        Ok(Screen { view })
    }

    /// One pixel of a screen as it is displayed: red, green, blue and premultiplied alpha, 8 bits each.
    ///
    /// # Errors
    /// The device failed.
    pub async fn read_pixel_async(
        &self,
        screen: &Screen,
        [x, y]: [u32; 2],
    ) -> Result<[u8; 4], RenderError> {
        let pixels = screen.read_part(&self.device.gpu, [x, y, 1, 1]).await?;
        Ok(pixels.first().copied().unwrap_or_default())
    }

    /// The rendered part of the picture: x, y, width, height in pixels.
    pub fn region(&self) -> [u32; 4] {
        self.settings.region()
    }

    /// The number of samples of every pixel while all are sampled together: in a single film tile, evenly or in
    /// the first round of adaptive sampling. Otherwise an estimate from the progress.
    pub fn samples_done(&self) -> u32 {
        match self.tiles.is_even() && !self.is_done() {
            true => self.cursor.sample,
            false => (self.progress() * f64::from(self.settings.samples)) as u32,
        }
    }

    /// Whether [`Self::show`] works on the GPU alone. The host is needed for several film tiles, for more
    /// samples than one block, for adaptive sampling, for opacity, and for the exposure of a denoised picture.
    pub fn shows_directly(&self, tone: &Tone) -> bool {
        self.develops_directly() && !(tone.auto_exposure && self.denoises(tone))
    }

    /// Whether the device has all that a picture is developed from.
    pub(super) fn develops_directly(&self) -> bool {
        self.settings.integrator.quantity() != Some(Quantity::Samples)
            && !self.settings.has_opacity()
            && self.tiles.is_one_block()
    }

    /// Develops the samples so far to a screen of the size of the picture: pixels with samples get the result
    /// of [`Self::develop`], rounded to 8 bits; denoised ones within one of these levels. Returns the range over
    /// which a quantity is shown. If it [`Self::shows_directly`] and needs neither a range nor an exposure, and
    /// does not denoise, it does not wait for the GPU.
    ///
    /// # Errors
    /// The device failed.
    pub async fn show_async(
        &mut self,
        tone: &Tone,
        screen: &Screen,
    ) -> Result<Option<[f32; 2]>, RenderError> {
        let range = self.range_of(tone).await?;
        if self.shows_directly(tone) {
            let packed = self.exposed(tone).await?.packed(
                self.settings.integrator,
                range,
                self.tiles.list[0].rows_per_pixel(),
            );
            let is_denoised = self.denoises(tone);
            self.surviving_losses(|renderer| renderer.present(&packed, screen, is_denoised))?;
            return Ok(range);
        }
        let tone = &Tone {
            levels: range.map_or(Levels::Raw, Levels::Fixed),
            ..*tone
        };
        let image = self.develop_async(tone).await?;
        screen.write(&self.device.gpu, &ScreenImage::from(&image))?;
        Ok(range)
    }

    fn present(
        &mut self,
        tone: &PackedTone,
        screen: &Screen,
        is_denoised: bool,
    ) -> Result<(), GpuError> {
        self.load_first_tile()?;
        let tile = &self.tiles.list[0];
        let slice = Slice {
            first_group: 0,
            end_group: tile.group_count(),
            first_sample: 0,
            // For the denoiser: as many as every pixel has.
            end_sample: match self.is_done() {
                true => tile.samples.len() as u32,
                false => 0,
            },
        };
        let packed = slice.packed(tile, &self.settings, 1);
        let grid = slice.grid(1);
        let device = &mut self.device;
        let (gpu, layouts, buffers) = (&device.gpu, &device.layouts, &device.buffers);
        let shown_tone = match &mut device.shown_tone {
            Some(buffer) => buffer,
            empty => empty.insert(gpu.upload("tone", bytes_of(tone))?),
        };
        gpu.write(&buffers.dispatch, 0, bytes_of(&packed))?;
        gpu.write(shown_tone, 0, bytes_of(tone))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut resources = vec![
            (0, shown_tone.as_entire_binding()),
            (2, BindingResource::TextureView(&screen.view)),
        ];
        let kept = (device.denoiser.take()).filter(|kept| kept.size() == screen.size());
        if is_denoised {
            let (width, height) = screen.size();
            let denoiser = device.denoiser.insert(match kept {
                Some(kept) => kept,
                None => {
                    let variant = pipelines::portable(device.fetch);
                    Denoiser::new(gpu, variant, (width, height), false)?
                }
            });
            denoiser.read_film(gpu, (layouts, buffers), &self.settings, grid, &mut encoder)?;
            denoiser.denoise(gpu, &mut encoder)?;
            resources.push((4, BindingResource::TextureView(denoiser.result())));
        }
        let (layout, group) = target(gpu, Variant::Buffer, &resources);
        let screen = overrides::SHOWS_DENOISED(is_denoised);
        let overrides = [overrides::of_tone(tone), screen].concat();
        let pipeline = pipelines::developing(gpu, layouts, Kernel::SHOW, &layout, overrides)?;
        let groups = [&buffers.frame_group, &buffers.film_group, &group];
        add_film_pass(&mut encoder, &pipeline, groups, grid);
        if !is_denoised {
            return gpu.enqueue(encoder.finish()).map(|_| ());
        }
        // These passes take long, and the time of the next slice is measured.
        device.other_work = Some(OtherWork {
            submitted: gpu.submit(encoder.finish())?,
            compiles: false,
        });
        Ok(())
    }

    /// Writes the sums of the only film tile to the film buffer unless they are there.
    pub(super) fn load_first_tile(&mut self) -> Result<(), GpuError> {
        let device = &mut self.device;
        if device.loaded_tile != Some(0) {
            let rows = self.tiles.list[0].developable();
            device.load_film(Some(0), &rows)?;
        }
        Ok(())
    }
}
