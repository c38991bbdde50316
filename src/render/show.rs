//! From sums to a picture on the screen, without leaving the GPU: `kernels/show.wesl`.

use super::{
    Levels, Quantity, RenderError, Renderer, Tone,
    layouts::{SCREEN_FORMAT, group_at},
    slice::Slice,
};
use crate::{
    gpu::{GpuError, Kernel},
    layout::PackedTone,
};
use bytemuck::{bytes_of, cast_slice};

/// What a tile or a test shows: a texture as large as a picture, 8 bits a channel, encoded as its
/// tone says, with premultiplied alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    view: wgpu::TextureView,
}

impl Screen {
    /// The texture, to be sampled without any conversion.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Width and height in pixels.
    pub fn size(&self) -> (u32, u32) {
        let texture = self.view.texture();
        (texture.width(), texture.height())
    }
}

/// What showing keeps on the GPU once it has been used.
pub struct Presenter {
    pipeline: wgpu::ComputePipeline,
    tone: wgpu::Buffer,
}

impl Renderer {
    /// A black screen as large as the picture, or as its crop.
    pub fn new_screen(&self) -> Result<Screen, RenderError> {
        let [.., width, height] = self.settings.region();
        let view = self
            .device
            .gpu
            .allocate_screen(width, height, SCREEN_FORMAT)?;
        Ok(Screen { view })
    }

    /// The part of the picture that is rendered: x, y, width, height in pixels.
    pub fn region(&self) -> [u32; 4] {
        self.settings.region()
    }

    /// Samples that every pixel has got, for a picture that [`Self::shows_directly`]; else the fraction
    /// of all that has been done.
    pub fn samples_done(&self) -> u32 {
        match self.tiles.is_one_rectangle() && !self.is_done() {
            true => self.cursor.sample,
            false => (self.progress() * f64::from(self.settings.samples)) as u32,
        }
    }

    /// Whether [`Self::show`] leaves the film where it is. Else the host has a part in it: films of
    /// several tiles, more samples than one sum takes, adaptive sampling.
    pub fn shows_directly(&self) -> bool {
        self.settings.integrator.quantity() != Some(Quantity::Samples) && self.tiles.is_one_block()
    }

    /// Puts what has been gathered so far on a screen of the picture's size: for every pixel that has a
    /// sample what [`Self::develop`] gives, rounded to 8 bits. Returns the range of a quantity over which it
    /// is shown. Where it [`Self::shows_directly`] and no range is to be found, it waits for nothing.
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
