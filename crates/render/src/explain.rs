//! Records all rays of a pixel: `kernels/explain.wesl` or `kernels/explain_path.wesl`.
//!
//! The code that rendered the picture, compiled a second time with recording enabled, runs once more for each
//! sample with the same random numbers. It writes to its own buffer, so the film, which may still be
//! growing, is not changed.

mod path;
mod phong;
mod tree;

pub use path::{LightSample, LightSource, Lobe, PathStep, Sharing, StepOutcome};
pub use phong::PhongTerms;
pub use tree::{RayHit, RayKind, RaySplit, RayTree, SampleTree, ShadowRay, TracedRay};

use super::{
    Integrator, RenderError, RenderSettings, Renderer,
    device::{self, Device},
    layouts::group,
    overrides, pipelines,
    policy::{ExecutionPolicy, Stack},
    task::Task,
};
use crate::{
    gpu::{GpuError, Kernel, Source},
    layout::{NONE, PROBE_ROWS, PackedCounters, PackedDispatch, PackedProbe, PackedRay, RAY_ROWS},
};
use bytemuck::{Pod, bytes_of, cast_slice, pod_read_unaligned};
use std::ops::Range;
use tree::Reader;
use wgpu::BufferUsages;

/// Maximum number of recorded rays of a sample.
const MAX_RAYS: u32 = 1 << 16;
/// Maximum number of recorded rays of a pixel, over all its samples.
const MAX_PIXEL_RAYS: u32 = 1 << 18;
/// Maximum number of samples in a submission.
const MAX_PROBES: usize = 1024;
/// Maximum number of recorded rays of a submission: 32 MiB.
const MAX_RECORDS: u32 = (32 << 20) / (16 * RAY_ROWS);
/// Lanes of a workgroup; each traces one sample.
const LANES: usize = 64;
/// Overrides that the kernel lacks, because it has no film and counts no rays.
const UNUSED_OVERRIDES: [&str; 4] = ["COUNT_RAYS", "ADAPTIVE", "FILM_ROWS", "SQUARES_ROW"];

/// The results of a submission.
struct Records {
    counters: PackedCounters,
    probes: Vec<PackedProbe>,
    rays: Vec<PackedRay>,
}

impl Renderer {
    /// Traces samples of a pixel of the picture and records all their rays. The contributions of the rays add
    /// up to the colour of a sample, and the weighted colours of the samples to [`RayTree::value`]. With the
    /// samples 0 to [`Self::samples_at`] that is the pixel's value in the finished film.
    ///
    /// If there are too many rays, only the first are recorded, and [`SampleTree::ray_count`] is their full
    /// number.
    ///
    /// This can be called at any time and does not change the film. The rays are those of [`Integrator::Path`] if
    /// the settings specify it, and otherwise those of [`Integrator::Whitted`].
    ///
    /// # Errors
    /// The device failed, or the driver ends the loops of a shader early even for one sample.
    pub async fn explain_async(
        &mut self,
        pixel: [u32; 2],
        samples: Range<u32>,
    ) -> Result<RayTree, RenderError> {
        let wanted = samples.map(|sample| (pixel, sample)).collect();
        let samples = self.explain_samples(wanted).await?;
        Ok(RayTree::new(pixel, self.explained(), samples))
    }

    /// Like [`Self::explain_async`] for several pixels, with fewer submissions.
    ///
    /// # Errors
    /// As [`Self::explain_async`].
    pub async fn explain_pixels_async(
        &mut self,
        pixels: &[([u32; 2], Range<u32>)],
    ) -> Result<Vec<RayTree>, RenderError> {
        let places = pixels.iter().flat_map(|(pixel, samples)| {
            let of = |sample| (*pixel, sample);
            samples.clone().map(of)
        });
        let mut traced = self.explain_samples(places.collect()).await?.into_iter();
        let integrator = self.explained();
        let tree = |(pixel, samples): &([u32; 2], Range<u32>)| {
            let own = traced.by_ref().take(samples.len()).collect();
            RayTree::new(*pixel, integrator, own)
        };
        Ok(pixels.iter().map(tree).collect())
    }

    /// The number of samples that a pixel will have; with adaptive sampling the number after the finished
    /// rounds. 0 outside of [`RenderSettings::region`].
    pub fn samples_at(&self, pixel: [u32; 2]) -> u32 {
        let [x, y, width, height] = self.settings.region();
        let within = |at: u32, start: u32, length: u32| (start..start + length).contains(&at);
        match within(pixel[0], x, width) && within(pixel[1], y, height) {
            true => self.tiles.samples_at(pixel),
            false => 0,
        }
    }

    /// The integrator whose rays are recorded. Debug views show the surfaces of the classical tree.
    fn explained(&self) -> Integrator {
        match self.settings.integrator {
            Integrator::Path => Integrator::Path,
            _ => Integrator::Whitted,
        }
    }

    async fn explain_samples(
        &mut self,
        wanted: Vec<([u32; 2], u32)>,
    ) -> Result<Vec<SampleTree>, RenderError> {
        let mut trees = Vec::with_capacity(wanted.len());
        let (mut pixel, mut room) = (None, 0);
        for part in wanted.chunks(MAX_PROBES) {
            let mut probes: Vec<_> = (part.iter())
                .map(|&([pixel_x, pixel_y], sample)| PackedProbe {
                    pixel_x,
                    pixel_y,
                    sample,
                    ..Default::default()
                })
                .collect();
            // First only count the rays, to allocate exactly enough room.
            let counted = self.record(&probes, 0).await?.probes;
            for (probe, counted) in probes.iter_mut().zip(&counted) {
                let place = Some([probe.pixel_x, probe.pixel_y]);
                if pixel != place {
                    (pixel, room) = (place, MAX_PIXEL_RAYS);
                }
                probe.ray_limit = counted.ray_count.min(MAX_RAYS).min(room);
                room -= probe.ray_limit;
            }
            let mut rest = &mut probes[..];
            while !rest.is_empty() {
                let (now, later) = rest.split_at_mut(probes_that_fit(rest));
                let record_count = assign_rows(now);
                let records = self.record(now, record_count).await?;
                let reader = Reader::new(&self.scene, &self.view, self.explained());
                let mut rays = &records.rays[..];
                for probe in &records.probes {
                    let (own, others) = rays.split_at(probe.ray_limit as usize);
                    trees.push(reader.sample(probe, own));
                    rays = others;
                }
                rest = later;
            }
        }
        Ok(trees)
    }

    /// Traces the probes, one per lane, with room for `record_count` rays after them.
    async fn record(
        &mut self,
        probes: &[PackedProbe],
        record_count: u32,
    ) -> Result<Records, RenderError> {
        let records = loop {
            match self.dispatch_probes(probes, record_count).await {
                Ok(records) => break records,
                Err(error) => self.recover_from(error)?,
            }
        };
        match records.counters.cut_off {
            0 => Ok(records),
            _ => Err(self.path_too_long()),
        }
    }

    /// The pipeline of the recording kernel.
    fn recorder(&self) -> Result<wgpu::ComputePipeline, GpuError> {
        let settings = RenderSettings {
            integrator: self.explained(),
            ..self.settings.clone()
        };
        // A sample takes no time, so it is not traced twice.
        let policy = ExecutionPolicy {
            stack: Stack::Deepest,
            ..self.policy
        };
        let task = Task {
            scene: &self.scene,
            view: &self.view,
            settings: &settings,
            policy: &policy,
            film_rows: self.tiles.largest(),
        };
        let mut overrides = overrides::of(task);
        overrides.retain(|(name, _)| !UNUSED_OVERRIDES.contains(name));
        let Device {
            gpu,
            fetch,
            layouts,
            ..
        } = &self.device;
        let kernel = match settings.integrator {
            Integrator::Path => Kernel::EXPLAIN_PATH,
            _ => Kernel::EXPLAIN,
        };
        let compiled = pipelines::tracing(
            gpu,
            pipelines::portable(*fetch),
            layouts,
            (kernel, task.policy.stack),
            overrides,
        )?;
        Ok(compiled.pipeline)
    }

    async fn dispatch_probes(
        &self,
        probes: &[PackedProbe],
        record_count: u32,
    ) -> Result<Records, GpuError> {
        let device = &self.device;
        let gpu = &device.gpu;
        let pipeline = self.recorder()?;
        let mut padded = probes.to_vec();
        padded.resize(
            probes.len().next_multiple_of(LANES),
            PackedProbe {
                pixel_x: NONE,
                ..Default::default()
            },
        );
        let groups = (padded.len() / LANES) as u32;
        let probe_bytes = size_of_val(&padded[..]) as u64;
        let bytes = probe_bytes + u64::from(record_count) * size_of::<PackedRay>() as u64;
        let counter_bytes = size_of::<PackedCounters>();
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let mapped = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let records = gpu.allocate("records", bytes, storage)?;
        let staging = gpu.allocate("staging", counter_bytes as u64 + bytes, mapped)?;
        let own_group = group(gpu, &device.layouts.film, &[records.as_entire_binding()]);
        gpu.write(&records, 0, cast_slice(&padded))?;
        gpu.write(&device.buffers.dispatch, 0, bytes_of(&self.packed(groups)))?;

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &device.buffers.scene_group, &[]);
            pass.set_bind_group(1, &device.buffers.frame_group, &[]);
            pass.set_bind_group(2, &own_group, &[]);
            pass.dispatch_workgroups(groups, 1, 1);
        }
        let counters = device::counters(&device.buffers.dispatch);
        let written = Source {
            buffer: &records,
            offset: 0,
            bytes,
        };
        let sources = [counters, written];
        let records = gpu.submit_and_read(encoder, &sources, &staging, |bytes| {
            let (counters, written) = bytes.split_at(counter_bytes);
            let (written_probes, rays) = written.split_at(probe_bytes as usize);
            let mut traced: Vec<PackedProbe> = read_all(written_probes);
            traced.truncate(probes.len());
            Records {
                counters: pod_read_unaligned(counters),
                probes: traced,
                rays: read_all(rays),
            }
        });
        let records = records.await?;
        // A driver that stops a dispatch of a thousand samples is treated as lost.
        match records.counters.finished_groups() == groups {
            true => Ok(records),
            false => Err(GpuError::Lost),
        }
    }

    /// The dispatch parameters.
    fn packed(&self, groups: u32) -> PackedDispatch {
        let settings = &self.settings;
        PackedDispatch {
            picture_width: settings.size.0,
            picture_height: settings.size.1,
            group_count: groups,
            end_group: groups,
            grid_width: groups,
            seed: settings.seed,
            shared_samples: settings.shared_samples(),
            max_depth: settings.max_depth,
            backdrop: settings.backdrop_color(),
            min_throughput: settings.min_throughput,
            light_samples: settings.light_samples,
            footprint: settings.footprint(),
            ..Default::default()
        }
    }
}

fn read_all<T: Pod>(bytes: &[u8]) -> Vec<T> {
    let each = bytes.chunks_exact(size_of::<T>());
    each.map(pod_read_unaligned).collect()
}

/// How many of the probes fit in one submission, at least one.
fn probes_that_fit(probes: &[PackedProbe]) -> usize {
    let mut room = MAX_RECORDS;
    let fits = |probe: &&PackedProbe| {
        let left = room.checked_sub(probe.ray_limit);
        room = left.unwrap_or(0);
        left.is_some()
    };
    probes.iter().take_while(fits).count().max(1)
}

/// Assigns rows to the rays of each probe, after the probes of whole workgroups. Returns the number of rays.
fn assign_rows(probes: &mut [PackedProbe]) -> u32 {
    let first_row = PROBE_ROWS * probes.len().next_multiple_of(LANES) as u32;
    let mut count = 0;
    for probe in probes {
        probe.first_row = first_row + RAY_ROWS * count;
        count += probe.ray_limit;
    }
    count
}
