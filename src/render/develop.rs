//! From sums to a picture: `kernels/develop.wesl`.

use super::{
    Integrator, Levels, RenderError, Renderer, Settings, film::Window, layouts::group, levels,
    slice::Slice,
};
use crate::clock::Instant;
use crate::{
    gpu::{GpuError, Kernel, Source},
    image::Image,
    layout::{
        PackedTone, TONE_ACES, TONE_AGX, TONE_NONE, TONE_REINHARD, TRANSFER_LINEAR, TRANSFER_SRGB,
    },
    scene::{ToneCurve, Transfer},
};
use bytemuck::{bytes_of, cast_slice, pod_collect_to_vec};
use wgpu::BufferUsages;

/// How linear radiance becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Stops; each doubles the brightness.
    pub exposure_ev: f32,
    /// Applied after the exposure.
    pub curve: ToneCurve,
    /// Applied last.
    pub transfer: Transfer,
    /// The range of a view that shows a quantity, such as distances.
    pub levels: Levels,
}

impl Tone {
    /// Leaves radiance as it is.
    pub const LINEAR: Self = Self {
        exposure_ev: 0.0,
        curve: ToneCurve::None,
        transfer: Transfer::Linear,
        levels: Levels::Raw,
    };

    /// Over this range, where there is one, for a film with so many rows a pixel.
    pub(super) fn packed(
        &self,
        settings: &Settings,
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
            },
            transfer: match self.transfer {
                Transfer::Srgb => TRANSFER_SRGB,
                Transfer::Linear => TRANSFER_LINEAR,
            },
            view: settings.integrator.developed_view(),
            range: [least, most],
            has_range: range.is_some().into(),
            film_rows: film_rows as u32,
        }
    }
}

/// What developing keeps on the GPU once it has been used.
pub struct Developer {
    pipeline: wgpu::ComputePipeline,
    developed: wgpu::Buffer,
    tone: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Renderer {
    /// The picture of what has been gathered so far, also before the render is done. Changing the
    /// tone costs no new rays.
    pub fn develop(&mut self, tone: &Tone) -> Result<Image, RenderError> {
        let start = Instant::now();
        self.fetch_film()?;
        let range = self.range_of(tone)?;
        let [x, y, width, height] = self.settings.region();
        let mut image = Image::new(width, height);
        if self.settings.integrator == Integrator::Samples {
            for (index, pixel) in image.pixels.iter_mut().enumerate() {
                let place = [x + index as u32 % width, y + index as u32 / width];
                let count = self.film.samples_at(place) as f32;
                let level = match range {
                    Some(range) => levels::place(count, range),
                    None => count / self.settings.samples as f32,
                };
                *pixel = [level, level, level, 1.0];
            }
            return Ok(image);
        }
        let tone = tone.packed(&self.settings, range, 1);
        for (window, means) in self.film.developable(&self.settings) {
            let pixels =
                self.surviving_losses(|renderer| renderer.develop_window(&window, &means, &tone))?;
            for (row, line) in pixels.chunks_exact(window.width as usize).enumerate() {
                let start = (window.y - y) as usize + row;
                let start = start * width as usize + (window.x - x) as usize;
                image.pixels[start..start + line.len()].copy_from_slice(line);
            }
        }
        self.stats.develop_seconds += start.elapsed().as_secs_f64();
        Ok(image)
    }

    /// One window's pixels, row by row.
    fn develop_window(
        &mut self,
        window: &Window,
        means: &[[f32; 4]],
        tone: &PackedTone,
    ) -> Result<Vec<[f32; 4]>, GpuError> {
        if self.device.developer.is_none() {
            self.device.developer = Some(self.new_developer()?);
        }
        let device = &self.device;
        let Some(developer) = &device.developer else {
            return Err(GpuError::Internal {
                what: "no develop pipeline".into(),
            });
        };
        let slice = Slice {
            first_tile: 0,
            end_tile: window.tile_count(),
            first_sample: 0,
            end_sample: 0,
        };
        let packed = slice.packed(window, &self.settings);
        let gpu = &device.gpu;
        gpu.write(&device.buffers.slice, 0, bytes_of(&packed))?;
        gpu.write(&device.buffers.film, 0, cast_slice(means))?;
        gpu.write(&developer.tone, 0, bytes_of(tone))?;

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&developer.pipeline);
            pass.set_bind_group(1, &device.buffers.frame_group, &[]);
            pass.set_bind_group(2, &device.buffers.film_group, &[]);
            pass.set_bind_group(3, &developer.group, &[]);
            let (columns, rows) = slice.grid();
            pass.dispatch_workgroups(columns, rows, 1);
        }
        let bytes = u64::from(window.width) * u64::from(window.height) * 16;
        let source = Source {
            buffer: &developer.developed,
            offset: 0,
            bytes,
        };
        let staging = &device.buffers.staging;
        let pixels = gpu.submit_and_read(encoder, &[source], staging, pod_collect_to_vec)?;
        // The film on the GPU is this window's now.
        self.device.loaded_window = None;
        Ok(pixels)
    }

    fn new_developer(&self) -> Result<Developer, GpuError> {
        let gpu = &self.device.gpu;
        let layouts = &self.device.layouts;
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("develop"),
                bind_group_layouts: &[
                    None,
                    Some(&layouts.frame),
                    Some(&layouts.film),
                    Some(&layouts.develop),
                ],
                immediate_size: 0,
            });
        let pipeline = gpu.pipeline(&Kernel::DEVELOP, false, &layout, &[])?;
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let bytes = self.film.largest_window() as u64 * 16;
        let developed = gpu.allocate("developed", bytes, usage)?;
        let tone = gpu.upload("tone", bytes_of(&PackedTone::default()))?;
        let resources = [tone.as_entire_binding(), developed.as_entire_binding()];
        let group = group(gpu, &layouts.develop, &resources);
        Ok(Developer {
            pipeline,
            developed,
            tone,
            group,
        })
    }
}
