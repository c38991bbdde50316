//! What a render keeps on the GPU, and how one slice is run there.

use super::{
    Stats,
    bindings::{self, Buffers},
    develop::Developer,
    layouts::Layouts,
    overrides, pipelines,
    policy::Fetch,
    settings::RenderSettings,
    show::Projector,
    slice::Slice,
    task::Task,
    window::{TILE_PIXELS, Window},
};
use crate::clock::Instant;
use crate::{
    gpu::{AdapterChoice, Compiled, Gpu, GpuError, Reading, Source},
    layout::PackedSlice,
};
use bytemuck::{bytes_of, cast_slice, cast_slice_mut, pod_collect_to_vec, pod_read_unaligned};
use std::ops::Range;

const ROW_BYTES: u64 = 16;

/// Everything that lives on the GPU, and dies with it.
pub struct Device {
    pub gpu: Gpu,
    /// Image or buffer, not auto.
    pub fetch: Fetch,
    pub layouts: Layouts,
    pub buffers: Buffers,
    /// What the view needs: views of one scene differ in what moves and shines.
    pipeline: wgpu::ComputePipeline,
    pub developer: Option<Developer>,
    pub projector: Option<Projector>,
    /// The window whose sums are in the film buffer.
    pub loaded_window: Option<usize>,
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
        let pipeline = compile(&gpu, fetch, &layouts, &buffers, task, stats)?;
        Ok(Self {
            gpu,
            fetch,
            layouts,
            buffers,
            pipeline,
            developer: None,
            projector: None,
            loaded_window: None,
        })
    }

    /// Puts another frame in place, or another scene with it, and makes room for its film. `spare` bytes
    /// may be allocated beyond what is needed.
    pub fn set(&mut self, task: Task, spare: u64, stats: &mut Stats) -> Result<(), GpuError> {
        let start = Instant::now();
        let (gpu, layouts) = (&self.gpu, &self.layouts);
        if self.buffers.make_room(gpu, layouts, task.film_rows)? {
            self.developer = None;
        }
        let shown = (task.scene, task.view);
        (self.buffers).set(gpu, layouts, shown, spare, &mut stats.uploads)?;
        stats.upload_seconds += start.elapsed().as_secs_f64();
        self.loaded_window = None;
        self.pipeline = compile(gpu, self.fetch, layouts, &self.buffers, task, stats)?;
        Ok(())
    }

    /// The sums of the window that is on the device.
    pub fn fetch_film(&self, window: &mut Window) -> Result<(), GpuError> {
        let encoder = self.gpu.device.create_command_encoder(&Default::default());
        let rows = Source {
            buffer: &self.buffers.film,
            offset: 0,
            bytes: window.row_count() as u64 * ROW_BYTES,
        };
        let staging = &self.buffers.staging;
        self.gpu
            .submit_and_read(encoder, &[rows], staging, |bytes| {
                window.sums.clear();
                window
                    .sums
                    .extend_from_slice(&pod_collect_to_vec::<u8, [f32; 4]>(bytes));
            })
    }

    /// Submits one slice of the window with this index, without waiting for it. [`Device::finish`] takes up
    /// what comes of it.
    pub fn launch(
        &mut self,
        slice: &Slice,
        (index, window): (usize, &Window),
        settings: &RenderSettings,
        back: Back,
    ) -> Result<Reading, GpuError> {
        let Self { gpu, buffers, .. } = self;
        if self.loaded_window != Some(index) {
            gpu.write(&buffers.film, 0, cast_slice(&window.sums))?;
            self.loaded_window = Some(index);
        }
        let packed = slice.packed(window, settings);
        gpu.write(&buffers.slice, 0, bytes_of(&packed))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let (columns, rows) = slice.grid();
        let grid = (gpu.dispatched(columns), rows);
        dispatch(&mut encoder, &self.pipeline, buffers, grid);
        let accounts = Source {
            buffer: &buffers.slice,
            offset: 0,
            bytes: size_of::<PackedSlice>() as u64,
        };
        let rows = back.rows(slice, window);
        let sums = Source {
            buffer: &buffers.film,
            offset: rows.start as u64 * ROW_BYTES,
            bytes: rows.len() as u64 * ROW_BYTES,
        };
        let sources = &[accounts, sums][..1 + usize::from(!rows.is_empty())];
        gpu.submit_reading(encoder, sources, &buffers.staging)
    }

    /// The accounts of a slice that was launched, for which this waits. What came back of the film goes to
    /// the window if the slice was done in full.
    pub fn finish(
        &self,
        reading: Reading,
        slice: &Slice,
        window: &mut Window,
        back: Back,
    ) -> Result<PackedSlice, GpuError> {
        let rows = back.rows(slice, window);
        self.gpu.read(reading, |bytes| {
            let (tally, sums) = bytes.split_at(size_of::<PackedSlice>());
            let tally = pod_read_unaligned(tally);
            if slice.is_complete(&tally) {
                cast_slice_mut(&mut window.sums[rows]).copy_from_slice(sums);
            }
            tally
        })
    }
}

/// What of the film comes to the host with a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Back {
    /// Nothing.
    Nothing,
    /// Its tiles.
    Tiles,
    /// The window.
    Window,
}

impl Back {
    /// The rows of the window's film.
    fn rows(self, slice: &Slice, window: &Window) -> Range<usize> {
        let tile_rows = TILE_PIXELS * window.rows_per_pixel();
        match self {
            Self::Nothing => 0..0,
            Self::Tiles => {
                slice.first_tile as usize * tile_rows..slice.end_tile as usize * tile_rows
            }
            Self::Window => 0..window.row_count(),
        }
    }
}

/// A device like the one that was lost.
pub fn reopen(
    choice: &AdapterChoice,
    fetch: Fetch,
    task: Task,
    stats: &mut Stats,
) -> Result<Device, GpuError> {
    let needs = bindings::needs(task.scene, task.view, fetch, task.film_rows);
    Device::new(Gpu::open(choice, needs)?, fetch, task, stats)
}

/// The integrator's pipeline. One that is new runs once on nothing, which is when some drivers really
/// compile.
fn compile(
    gpu: &Gpu,
    fetch: Fetch,
    layouts: &Layouts,
    buffers: &Buffers,
    task: Task,
    stats: &mut Stats,
) -> Result<wgpu::ComputePipeline, GpuError> {
    let start = Instant::now();
    let kernel = task.settings.integrator.entry().kernel;
    let Compiled { pipeline, is_new } =
        pipelines::tracing(gpu, fetch, layouts, kernel, overrides::of(task))?;
    if is_new {
        let idle = PackedSlice {
            tile_count: 1,
            tile_columns: 1,
            grid_width: 1,
            ..Default::default()
        };
        gpu.write(&buffers.slice, 0, bytes_of(&idle))?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        dispatch(&mut encoder, &pipeline, buffers, (1, 1));
        gpu.submit(encoder.finish())?;
        stats.compile_seconds += start.elapsed().as_secs_f64();
    }
    Ok(pipeline)
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
