//! The contents of the bind groups of `bindings.wesl`.

use super::{
    arrays::{ARRAY_COUNT, Array, IMAGE_WIDTH, ROW_BYTES, Rows, arrays, node_rows},
    layouts::{Layouts, group},
    policy::{ExecutionPolicy, Fetch, Storage},
    stats::Uploads,
};
use crate::{
    gpu::{Gpu, GpuError, Ledger, Needs, Timer},
    layout::{PackedCounters, PackedDispatch, PackedFrame, PackedTone},
    pack::{PackedScene, PackedView},
};
use bytemuck::bytes_of;
use std::sync::Arc;
use wgpu::{Buffer, BufferUsages};

/// Usage of buffers that shaders write and the host reads.
const READABLE: BufferUsages = BufferUsages::STORAGE
    .union(BufferUsages::COPY_SRC)
    .union(BufferUsages::COPY_DST);

const FRAME_BYTES: u64 = size_of::<PackedFrame>() as u64;

/// Binding of the materials in the group of the scene.
const MATERIALS: usize = 3;

/// All GPU resources except the pipelines.
pub struct Buffers {
    pub scene_group: wgpu::BindGroup,
    pub frame_group: wgpu::BindGroup,
    pub film_group: wgpu::BindGroup,
    pub dispatch: Buffer,
    pub film: Buffer,
    pub staging: Buffer,
    scene: SceneBuffers,
}

impl Buffers {
    /// Uploads the scene and the frame, and allocates a film of `film_rows`.
    pub fn new(
        gpu: &Gpu,
        layouts: &Layouts,
        fetch: Fetch,
        (scene, view): (&Arc<PackedScene>, &PackedView),
        film_rows: usize,
        uploads: &mut Uploads,
    ) -> Result<Self, GpuError> {
        let buffers = SceneBuffers::new(gpu, fetch, scene, view, uploads)?;
        uploads.frames += FRAME_BYTES;
        Self::around(gpu, layouts, buffers, view, film_rows)
    }

    /// Other buffers for this scene and frame: dispatch parameters and a film of `film_rows` of their own. The scene is shared,
    /// and replaced or destroyed with these.
    pub fn beside(
        &self,
        gpu: &Gpu,
        layouts: &Layouts,
        view: &PackedView,
        film_rows: usize,
    ) -> Result<Self, GpuError> {
        let shared = SceneBuffers {
            fetch: self.scene.fetch,
            buffers: self.scene.buffers.clone(),
            on_device: None,
        };
        Self::around(gpu, layouts, shared, view, film_rows)
    }

    fn around(
        gpu: &Gpu,
        layouts: &Layouts,
        scene: SceneBuffers,
        view: &PackedView,
        film_rows: usize,
    ) -> Result<Self, GpuError> {
        let scene_group = scene.group(gpu, layouts);
        let dispatch = gpu.allocate("dispatch", size_of::<PackedDispatch>() as u64, READABLE)?;
        let (film, staging) = film(gpu, film_rows)?;
        let frame_group = frame_group(gpu, layouts, scene.fetch, view, &dispatch)?;
        let film_group = group(gpu, &layouts.film, &[film.as_entire_binding()]);
        Ok(Self {
            scene_group,
            frame_group,
            film_group,
            dispatch,
            film,
            staging,
            scene,
        })
    }

    /// Ensures room for `film_rows`. Returns whether the film buffer was replaced.
    pub fn make_room(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        film_rows: usize,
    ) -> Result<bool, GpuError> {
        if film_rows as u64 * ROW_BYTES <= self.film.size() {
            return Ok(false);
        }
        self.film.destroy();
        self.staging.destroy();
        (self.film, self.staging) = film(gpu, film_rows)?;
        self.film_group = group(gpu, &layouts.film, &[self.film.as_entire_binding()]);
        Ok(true)
    }

    /// The bind group of the scene for a ray query, with `rays` in place of materials.
    pub fn query_group(&self, gpu: &Gpu, layouts: &Layouts, rays: &Rows) -> wgpu::BindGroup {
        let mut resources: Vec<_> = self.scene.buffers.iter().map(Rows::resource).collect();
        resources[MATERIALS] = rays.resource();
        group(gpu, &layouts.scene, &resources)
    }

    /// Switches to another frame, or to another scene with its frame, and uploads only the differences. Arrays
    /// that are too small grow by up to `spare` bytes beyond what is needed.
    pub fn set(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        (scene, view): (&Arc<PackedScene>, &PackedView),
        spare: u64,
        uploads: &mut Uploads,
    ) -> Result<(), GpuError> {
        if self.scene.set(gpu, scene, view, spare, uploads)? {
            self.scene_group = self.scene.group(gpu, layouts);
        }
        self.frame_group = frame_group(gpu, layouts, self.scene.fetch, view, &self.dispatch)?;
        uploads.frames += FRAME_BYTES;
        Ok(())
    }
}

/// The buffers of a scene and its view.
struct SceneBuffers {
    fetch: Fetch,
    /// In the order of [`arrays`] and of the bindings.
    buffers: Vec<Rows>,
    /// Contents of the buffers; `None` before they are written or after a failure.
    on_device: Option<(Arc<PackedScene>, PackedView)>,
}

impl SceneBuffers {
    fn new(
        gpu: &Gpu,
        fetch: Fetch,
        scene: &Arc<PackedScene>,
        view: &PackedView,
        uploads: &mut Uploads,
    ) -> Result<Self, GpuError> {
        let mut buffers = Self {
            fetch,
            buffers: Vec::new(),
            on_device: None,
        };
        buffers.set(gpu, scene, view, 0, uploads)?;
        Ok(buffers)
    }

    /// Uploads the differences. Returns whether some buffer was replaced; buffers that are too small are
    /// destroyed first, because the ledger counts them once.
    fn set(
        &mut self,
        gpu: &Gpu,
        scene: &Arc<PackedScene>,
        view: &PackedView,
        spare: u64,
        uploads: &mut Uploads,
    ) -> Result<bool, GpuError> {
        let before = self.on_device.take();
        let fetch = self.fetch;
        let old = before
            .as_ref()
            .map(|(scene, view)| arrays(scene, view, fetch));
        let mut is_other = false;
        for (index, array) in arrays(scene, view, fetch).iter().enumerate() {
            let rows = self.buffers.get(index);
            let fits = |rows: &Rows| old.is_some() && array.least_bytes() <= rows.bytes();
            let mut known = old.as_ref().map_or(&[][..], |old| &old[index].pieces);
            if !rows.is_some_and(fits) {
                let bytes = match rows.filter(|_| old.is_some()) {
                    Some(rows) => rows.grown(gpu, array.bytes, spare / ARRAY_COUNT as u64),
                    None => array.bytes,
                };
                if let Some(rows) = rows {
                    rows.destroy();
                }
                let rows = Rows::allocate(gpu, fetch, array, bytes)?;
                match self.buffers.get_mut(index) {
                    Some(place) => *place = rows,
                    None => self.buffers.push(rows),
                }
                known = &[];
                is_other = true;
            }
            array.write(gpu, &self.buffers[index], known, uploads)?;
        }
        self.on_device = Some((scene.clone(), view.clone()));
        Ok(is_other)
    }

    fn group(&self, gpu: &Gpu, layouts: &Layouts) -> wgpu::BindGroup {
        let resources: Vec<_> = self.buffers.iter().map(Rows::resource).collect();
        group(gpu, &layouts.scene, &resources)
    }
}

/// A film with this many rows, and the staging buffer for reading it back together with the counters and the
/// timestamps of a dispatch.
fn film(gpu: &Gpu, rows: usize) -> Result<(Buffer, Buffer), GpuError> {
    let bytes = rows as u64 * ROW_BYTES;
    let film = gpu.allocate("film", bytes, READABLE)?;
    let staging = gpu.allocate(
        "staging",
        bytes + (size_of::<PackedCounters>() + Timer::BYTES) as u64,
        BufferUsages::MAP_READ | BufferUsages::COPY_DST,
    )?;
    // The first write to memory takes long. Software adapters do it now, while the kernel is compiled.
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.clear_buffer(&film, 0, None);
    encoder.clear_buffer(&staging, 0, None);
    gpu.enqueue(encoder.finish())?;
    Ok((film, staging))
}

/// The bind group of a frame and of the dispatch parameters.
fn frame_group(
    gpu: &Gpu,
    layouts: &Layouts,
    fetch: Fetch,
    view: &PackedView,
    dispatch: &Buffer,
) -> Result<wgpu::BindGroup, GpuError> {
    let frame = gpu.upload("frame", bytes_of(&view.frame_after(node_rows(fetch))))?;
    let resources = [frame.as_entire_binding(), dispatch.as_entire_binding()];
    Ok(group(gpu, &layouts.frame, &resources))
}

/// The fetch to use, image or buffer: the requested one, or by default that of the faster storage, unless the adapter has
/// room for the scene only in the other or the device cannot bind as many images.
pub fn choose_fetch(
    policy: &ExecutionPolicy,
    gpu: &Gpu,
    scene: &PackedScene,
    view: &PackedView,
) -> Fetch {
    if !gpu.reads_images() {
        return Fetch::Buffer;
    }
    let adapter = gpu.adapter();
    let bytes = |fetch| largest_row_bytes(scene, view, fetch);
    let fits_buffer = bytes(Fetch::Buffer) <= adapter.max_binding_bytes;
    let fits_image = image_side(bytes(Fetch::Image)) <= adapter.max_texture_2d;
    let preferred = policy.storage.unwrap_or_else(|| Storage::usual(gpu));
    match (policy.fetch, preferred) {
        (Fetch::Auto | Fetch::Packet, Storage::Image) if fits_image || !fits_buffer => Fetch::Image,
        (Fetch::Auto | Fetch::Packet, Storage::Buffer) if !fits_buffer => Fetch::Image,
        (Fetch::Auto | Fetch::Packet, _) => Fetch::Buffer,
        (chosen, _) => chosen,
    }
}

/// The device limits needed for this scene and film.
pub fn needs(scene: &PackedScene, view: &PackedView, fetch: Fetch, film_rows: usize) -> Needs {
    let film = film_rows as u64 * ROW_BYTES;
    let rows = largest_row_bytes(scene, view, fetch);
    if fetch != Fetch::Image {
        return Needs {
            binding_bytes: film.max(rows),
            texture_side: 0,
        };
    }
    // Texels stay within the limits that WebGPU guarantees.
    Needs {
        binding_bytes: film,
        texture_side: image_side(rows),
    }
}

/// The longer side of an image of this many bytes of rows, in texels.
fn image_side(bytes: u64) -> u32 {
    let height = bytes.div_ceil(u64::from(IMAGE_WIDTH) * ROW_BYTES);
    IMAGE_WIDTH.max(height.try_into().unwrap_or(u32::MAX))
}

fn largest_row_bytes(scene: &PackedScene, view: &PackedView, fetch: Fetch) -> u64 {
    let rows = arrays(scene, view, fetch)
        .into_iter()
        .filter(Array::is_row_image);
    rows.map(|array| array.bytes).max().unwrap_or(0)
}

/// The planned allocations of a render, on the GPU and for the picture on the host.
pub fn ledger(
    scene: &PackedScene,
    view: &PackedView,
    fetch: Fetch,
    film_rows: usize,
    picture_pixels: u64,
) -> Ledger {
    let mut ledger = Ledger::default();
    for array in arrays(scene, view, fetch) {
        ledger.plan(array.what, array.bytes);
    }
    let tone = size_of::<PackedTone>() as u64;
    ledger.plan("frame", FRAME_BYTES + tone);
    ledger.plan("film and its copies", 4 * film_rows as u64 * ROW_BYTES);
    ledger.plan("picture", picture_pixels * 2 * ROW_BYTES);
    ledger
}
