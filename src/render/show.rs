//! Develops sums to a texture on the GPU: `kernels/show.wesl`.

use super::{
    Levels, Quantity, RenderError, Renderer, Tone,
    layouts::{SCREEN_FORMAT, group_at},
    slice::Slice,
};
use crate::{
    gpu::{GpuError, Kernel, Source},
    layout::PackedTone,
};
use bytemuck::{bytes_of, cast_slice};

/// A texture for display, as large as the picture: 8 bits per channel, encoded with the transfer function of
/// the tone, premultiplied alpha.
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
}

/// GPU resources for display, created on first use.
pub struct Presenter {
    pipeline: wgpu::ComputePipeline,
    tone: wgpu::Buffer,
}

impl Renderer {
    /// A black screen of the size of the picture or its crop.
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
    pub fn read_pixel(&self, screen: &Screen, [x, y]: [u32; 2]) -> Result<[u8; 4], RenderError> {
        let gpu = &self.device.gpu;
        let row = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let texel = gpu.allocate("texel", row.into(), usage)?;
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let staging = gpu.allocate("staging", 4, usage)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let texture = wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x, y, z: 0 },
            ..screen.view.texture().as_image_copy()
        };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        let target = wgpu::TexelCopyBufferInfo {
            buffer: &texel,
            layout,
        };
        let size = wgpu::Extent3d {
            width: 1,
            height: 1,
            depth_or_array_layers: 1,
        };
        encoder.copy_texture_to_buffer(texture, target, size);
        let source = Source {
            buffer: &texel,
            offset: 0,
            bytes: 4,
        };
        let read = |bytes: &[u8]| [bytes[0], bytes[1], bytes[2], bytes[3]];
        Ok(gpu.submit_and_read(encoder, &[source], &staging, read)?)
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
    /// samples than one block, and for adaptive sampling.
    pub fn shows_directly(&self) -> bool {
        self.settings.integrator.quantity() != Some(Quantity::Samples) && self.tiles.is_one_block()
    }

    /// Develops the samples so far to a screen of the size of the picture: pixels with samples get the result
    /// of [`Self::develop`], rounded to 8 bits. Returns the range over which a quantity is shown. If it
    /// [`Self::shows_directly`] and needs no range, it does not wait for the GPU.
    pub fn show(&mut self, tone: &Tone, screen: &Screen) -> Result<Option<[f32; 2]>, RenderError> {
        let range = self.range_of(tone)?;
        if self.shows_directly() {
            let tone = tone.packed(
                self.settings.integrator,
                range,
                self.tiles.list[0].rows_per_pixel(),
            );
            self.surviving_losses(|renderer| renderer.present(&tone, screen))?;
            return Ok(range);
        }
        let tone = &Tone {
            levels: range.map_or(Levels::Raw, Levels::Fixed),
            ..*tone
        };
        let image = self.develop(tone)?;
        let quantized = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
        let bytes: Vec<u8> = (image.pixels.iter())
            .flat_map(|[r, g, b, _]| [quantized(*r), quantized(*g), quantized(*b), 255])
            .collect();
        self.device.gpu.write_image(&screen.view, 0, &bytes)?;
        Ok(range)
    }

    fn present(&mut self, tone: &PackedTone, screen: &Screen) -> Result<(), GpuError> {
        if self.device.presenter.is_none() {
            self.device.presenter = Some(self.new_presenter()?);
        }
        let device = &mut self.device;
        let (gpu, buffers) = (&device.gpu, &device.buffers);
        let Some(presenter) = &device.presenter else {
            return Err(GpuError::Internal {
                what: "no show pipeline".into(),
            });
        };
        let tile = &self.tiles.list[0];
        if device.loaded_tile != Some(0) {
            gpu.write(&buffers.film, 0, cast_slice(&tile.developable()))?;
            device.loaded_tile = Some(0);
        }
        let slice = Slice {
            first_group: 0,
            end_group: tile.group_count(),
            first_sample: 0,
            end_sample: 0,
        };
        let packed = slice.packed(tile, &self.settings);
        gpu.write(&buffers.dispatch, 0, bytes_of(&packed))?;
        gpu.write(&presenter.tone, 0, bytes_of(tone))?;
        let resources = [
            (0, presenter.tone.as_entire_binding()),
            (2, wgpu::BindingResource::TextureView(&screen.view)),
        ];
        let target = group_at(gpu, &device.layouts.show, &resources);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&presenter.pipeline);
            pass.set_bind_group(1, &buffers.frame_group, &[]);
            pass.set_bind_group(2, &buffers.film_group, &[]);
            pass.set_bind_group(3, &target, &[]);
            let (columns, rows) = slice.grid();
            pass.dispatch_workgroups(columns, rows, 1);
        }
        gpu.enqueue(encoder.finish()).map(drop)
    }

    fn new_presenter(&self) -> Result<Presenter, GpuError> {
        let (gpu, layouts) = (&self.device.gpu, &self.device.layouts);
        let groups = [
            None,
            Some(&layouts.frame),
            Some(&layouts.film),
            Some(&layouts.show),
        ];
        Ok(Presenter {
            pipeline: gpu
                .pipeline(&Kernel::SHOW, false, &groups, Vec::new())?
                .pipeline,
            tone: gpu.upload("tone", bytes_of(&PackedTone::default()))?,
        })
    }
}
