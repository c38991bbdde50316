//! The GPU resources of a render, and the submission of slices.

use super::{
    Stats,
    bindings::{self, Buffers},
    denoise::Denoiser,
    develop::Developer,
    film_tile::{FilmTile, GROUP_PIXELS},
    layouts::Layouts,
    pipelines,
    policy::Fetch,
    settings::RenderSettings,
    slice::Slice,
    task::Task,
};
use crate::{
    gpu::{AdapterChoice, Compiled, Gpu, GpuError, Reading, Source, Submitted},
    layout::{PackedCounters, PackedDispatch},
};
use bytemuck::{bytes_of, cast_slice, pod_read_unaligned};
use glimray_scene::clock::Instant;
use std::ops::Range;

const ROW_BYTES: u64 = 16;

/// All GPU resources, which are lost with the device.
pub struct Device {
    pub gpu: Gpu,
    /// Image or buffer, never auto.
    pub fetch: Fetch,
    pub layouts: Layouts,
    pub buffers: Buffers,
    /// The pipeline for the current view: views of one scene differ in motion and lights.
    pipeline: wgpu::ComputePipeline,
    pub developer: Option<Developer>,
    /// The tone of the picture on a screen.
    pub shown_tone: Option<wgpu::Buffer>,
    /// For pictures on a screen of one size.
    pub denoiser: Option<Denoiser>,
    /// Consecutive samples per lane.
    pub lane_samples: u32,
    /// Work without results that ends before the next slice is submitted, whose time is measured.
    pub other_work: Option<OtherWork>,
    /// Index of the film tile whose sums are in the film buffer.
    pub loaded_tile: Option<usize>,
    /// Whether the film buffer still has its first zeros.
    is_film_clear: bool,
}

impl Device {
    /// Uploads the scene and compiles the kernel.
    pub fn new(gpu: Gpu, fetch: Fetch, task: Task, stats: &mut Stats) -> Result<Self, GpuError> {
        let start = Instant::now();
        let layouts = Layouts::new(&gpu, fetch);
        let shown = (task.scene, task.view);
        let uploads = &mut stats.uploads;
        let buffers = Buffers::new(&gpu, &layouts, fetch, shown, task.film_rows, uploads)?;
        stats.upload_seconds += start.elapsed().as_secs_f64();
        let (pipeline, lane_samples, first_run) =
            compile(&gpu, fetch, &layouts, &buffers, task, stats)?;
        Ok(Self {
            gpu,
            fetch,
            layouts,
            buffers,
            pipeline,
            developer: None,
            shown_tone: None,
            denoiser: None,
            lane_samples,
            other_work: first_run,
            loaded_tile: None,
            is_film_clear: true,
        })
    }

    /// Switches to another frame, or to another scene with its frame, and ensures room for its film. Up to
    /// `spare` bytes may be allocated beyond what is needed.
    pub fn set(&mut self, task: Task, spare: u64, stats: &mut Stats) -> Result<(), GpuError> {
        let start = Instant::now();
        let (gpu, layouts) = (&self.gpu, &self.layouts);
        if self.buffers.make_room(gpu, layouts, task.film_rows)? {
            self.developer = None;
            self.is_film_clear = true;
        }
        let shown = (task.scene, task.view);
        (self.buffers).set(gpu, layouts, shown, spare, &mut stats.uploads)?;
        stats.upload_seconds += start.elapsed().as_secs_f64();
        self.loaded_tile = None;
        let first_run;
        (self.pipeline, self.lane_samples, first_run) =
            compile(gpu, self.fetch, layouts, &self.buffers, task, stats)?;
        self.other_work = first_run.or(self.other_work.take());
        Ok(())
    }

    /// Writes film rows to the film buffer: those of the film tile with this index, if they are its sums.
    pub fn load_film(&mut self, tile: Option<usize>, rows: &[[f32; 4]]) -> Result<(), GpuError> {
        self.loaded_tile = None;
        self.is_film_clear = false;
        self.gpu.write(&self.buffers.film, 0, cast_slice(rows))?;
        self.loaded_tile = tile;
        Ok(())
    }

    /// Reads back the sums of the film tile on the device.
    pub async fn fetch_film(&self, tile: &mut FilmTile) -> Result<(), GpuError> {
        let encoder = self.gpu.device.create_command_encoder(&Default::default());
        let rows = Source {
            buffer: &self.buffers.film,
            offset: 0,
            bytes: tile.row_count() as u64 * ROW_BYTES,
        };
        let staging = &self.buffers.staging;
        self.gpu
            .submit_and_read(encoder, &[rows], staging, |bytes| {
                tile.replace_rows(0, cast_slice(bytes));
            })
            .await
    }

    /// Submits one slice of the film tile with this index, without waiting for it. [`Device::finish`] collects
    /// the results.
    pub fn launch(
        &mut self,
        slice: &Slice,
        (index, tile): (usize, &FilmTile),
        settings: &RenderSettings,
        back: Readback,
    ) -> Result<Reading, GpuError> {
        let (gpu, buffers) = (&self.gpu, &self.buffers);
        let is_loaded = self.loaded_tile == Some(index);
        let is_blank = !is_loaded && tile.sums.is_empty();
        // If something fails, the film may hold anything.
        self.loaded_tile = None;
        let is_clear = std::mem::take(&mut self.is_film_clear);
        if !is_loaded && !is_blank {
            gpu.write(&buffers.film, 0, cast_slice(&tile.sums))?;
        }
        let packed = slice.packed(tile, settings, self.lane_samples);
        gpu.write(&buffers.dispatch, 0, bytes_of(&packed))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        if is_blank && !is_clear {
            let bytes = tile.row_count() as u64 * ROW_BYTES;
            encoder.clear_buffer(&buffers.film, 0, Some(bytes));
        }
        let (columns, rows) = slice.grid(self.lane_samples);
        let grid = (gpu.dispatch_columns(columns), rows);
        dispatch(&mut encoder, &self.pipeline, buffers, grid);
        let counters = counters(&buffers.dispatch);
        let rows = back.rows(slice, tile);
        let sums = Source {
            buffer: &buffers.film,
            offset: rows.start as u64 * ROW_BYTES,
            bytes: rows.len() as u64 * ROW_BYTES,
        };
        let sources = &[counters, sums][..1 + usize::from(!rows.is_empty())];
        let reading = gpu.submit_reading(encoder, sources, &buffers.staging)?;
        self.loaded_tile = Some(index);
        Ok(reading)
    }

    /// Takes the results of a launched slice that is done, and returns its counters. The sums that were read back are stored in the tile
    /// if the slice is complete.
    pub fn finish(
        &self,
        reading: Reading,
        slice: &Slice,
        tile: &mut FilmTile,
        back: Readback,
    ) -> Result<PackedCounters, GpuError> {
        let rows = back.rows(slice, tile);
        self.gpu.take(reading, |bytes| {
            let (counters, sums) = bytes.split_at(size_of::<PackedCounters>());
            let counters = pod_read_unaligned(counters);
            if slice.is_complete(&counters, self.lane_samples) {
                tile.replace_rows(rows.start, cast_slice(sums));
            }
            counters
        })
    }
}

/// Work without results.
pub struct OtherWork {
    pub submitted: Submitted,
    /// Whether it is the first run of a pipeline, in which some drivers compile it.
    pub compiles: bool,
}

/// Which part of the film is read back with a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Readback {
    /// Nothing.
    Nothing,
    /// The slice's workgroups.
    Groups,
    /// The whole film tile.
    Tile,
}

impl Readback {
    /// The film rows to read back.
    fn rows(self, slice: &Slice, tile: &FilmTile) -> Range<usize> {
        let group_rows = GROUP_PIXELS * tile.rows_per_pixel();
        match self {
            Self::Nothing => 0..0,
            Self::Groups => {
                slice.first_group as usize * group_rows..slice.end_group as usize * group_rows
            }
            Self::Tile => 0..tile.row_count(),
        }
    }
}

/// Opens a replacement for a lost device.
pub fn reopen(
    choice: &AdapterChoice,
    fetch: Fetch,
    task: Task,
    stats: &mut Stats,
) -> Result<Device, GpuError> {
    let needs = bindings::needs(task.scene, task.view, fetch, task.film_rows);
    Device::new(Gpu::reopened(choice, needs)?, fetch, task, stats)
}

/// The counters in a buffer of dispatch parameters, to be read back.
pub fn counters(dispatch: &wgpu::Buffer) -> Source<'_> {
    Source {
        buffer: dispatch,
        offset: std::mem::offset_of!(PackedDispatch, counters) as u64,
        bytes: size_of::<PackedCounters>() as u64,
    }
}

/// The pipeline of the integrator, and the samples that its lanes should take. A new one is dispatched once without work,
/// because some drivers only compile then: the third value.
fn compile(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    buffers: &Buffers,
    task: Task,
    stats: &mut Stats,
) -> Result<(wgpu::ComputePipeline, u32, Option<OtherWork>), GpuError> {
    let start = Instant::now();
    let (compiled, lane_samples) = pipelines::rendering(gpu, fetch, layouts, task)?;
    let Compiled { pipeline, is_new } = compiled;
    let mut first_run = None;
    if is_new {
        let idle = PackedDispatch {
            group_count: 1,
            grid_width: 1,
            tile_width: 1,
            blocks: 1,
            ..Default::default()
        };
        gpu.write(&buffers.dispatch, 0, bytes_of(&idle))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        dispatch(&mut encoder, &pipeline, buffers, (1, 1));
        stats.compile_seconds += start.elapsed().as_secs_f64();
        first_run = Some(OtherWork {
            submitted: gpu.submit(encoder.finish())?,
            compiles: true,
        });
    }
    Ok((pipeline, lane_samples, first_run))
}

fn dispatch(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::ComputePipeline,
    buffers: &Buffers,
    (columns, rows): (u32, u32),
) {
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, &buffers.scene_group, &[]);
    pass.set_bind_group(1, &buffers.frame_group, &[]);
    pass.set_bind_group(2, &buffers.film_group, &[]);
    pass.dispatch_workgroups(columns, rows, 1);
}
