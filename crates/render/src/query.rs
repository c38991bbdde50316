//! Ray queries: closest hits and occlusion of rays that the caller supplies: `kernels/trace_rays.wesl`.

mod rays;

pub use rays::{Coherence, QueryHit, QueryRay, RaySteps, RayTest};

use super::{
    ExecutionPolicy, LongPath, RenderError, Renderer,
    arrays::{self, Array, Rows},
    bindings::{self, Buffers},
    device,
    film_tile::coprime_stride,
    layouts::Layouts,
    overrides, pipelines,
    policy::{Fetch, Stack},
    stats::Uploads,
};
use crate::{
    gpu::{Compiled, Gpu, GpuError, Kernel, Source, Variant},
    layout::{NONE, PackedCounters, PackedDispatch},
    pack::{PackedScene, PackedView},
};
use bytemuck::{bytes_of, cast_slice, pod_collect_to_vec, pod_read_unaligned};
use glimray_scene::{ObjectRef, clock::Instant};
use std::sync::Arc;

/// Rays of a workgroup.
const GROUP_RAYS: usize = 64;
/// Maximum number of rays of a dispatch: 16 MiB of results.
const MAX_RAYS: usize = 1 << 20;
const ROW_BYTES: u64 = 16;
/// Rays of a lane of a packet.
const LANE_RAYS: u32 = 4;

/// Rays on the device, for repeated tracing.
pub struct RayBatch {
    chunks: Vec<Chunk>,
    coherence: Coherence,
}

impl RayBatch {
    /// The rays with this hint; without one they are [`Coherence::Coherent`].
    pub fn with_coherence(self, coherence: Coherence) -> Self {
        Self { coherence, ..self }
    }
}

/// The rays of one dispatch.
struct Chunk {
    ray_count: usize,
    group: wgpu::BindGroup,
}

impl Chunk {
    fn group_count(&self) -> u32 {
        self.ray_count.div_ceil(GROUP_RAYS) as u32
    }
}

/// Traces rays through a view of a packed scene:
///
/// ```
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
/// use glam::{DVec3, Vec3};
/// use glimray::{gpu::Gpu, import, pack, render::{ExecutionPolicy, QueryRay, RayQuery}};
///
/// let scene = import::load("assets/scenes/carousel.toml".as_ref())?;
/// let packed = std::sync::Arc::new(pack::scene(&scene)?);
/// let view = packed.frame(&scene.frame(0.0))?;
/// let query = RayQuery::new(Gpu::new(&Default::default())?, packed, &view, ExecutionPolicy::default())?;
/// let down = QueryRay::new(DVec3::new(0.0, 10.0, 0.0), Vec3::NEG_Y);
/// for hit in query.closest_hits(&[down])?.into_iter().flatten() {
///     println!("{}", hit.t);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A query renders nothing and does not survive the loss of the device: every function then returns
/// [`GpuError::Lost`].
pub struct RayQuery {
    gpu: Gpu,
    fetch: Fetch,
    /// Whether rays may be traced in packets.
    as_packets: bool,
    layouts: Layouts,
    buffers: Buffers,
    scene: Arc<PackedScene>,
    view: PackedView,
}

impl RayQuery {
    /// Uploads a scene. Of the policy, the fetch, the storage and the memory limit apply.
    ///
    /// # Errors
    /// The device failed, or the scene exceeds the memory limit or the limits of the adapter.
    pub fn new(
        gpu: Gpu,
        scene: Arc<PackedScene>,
        view: &PackedView,
        policy: ExecutionPolicy,
    ) -> Result<Self, RenderError> {
        let fetch = bindings::choose_fetch(&policy, &gpu, &scene, view);
        bindings::ledger(&scene, view, fetch, MAX_RAYS, 0).check(policy.memory_limit_bytes)?;
        let gpu = gpu.with_limits_for(bindings::needs(&scene, view, fetch, MAX_RAYS))?;
        let layouts = Layouts::new(&gpu, fetch);
        let shown = (&scene, view);
        let uploads = &mut Uploads::default();
        let buffers = Buffers::new(&gpu, &layouts, fetch, shown, MAX_RAYS, uploads)?;
        Ok(Self {
            gpu,
            fetch,
            as_packets: policy.fetch.allows_packets(),
            layouts,
            buffers,
            scene,
            view: view.clone(),
        })
    }

    /// Traces rays through what a renderer renders, and shares its scene on the device. Only the results need memory.
    ///
    /// The query must not be used after the renderer was given another scene, frame or device.
    ///
    /// # Errors
    /// The device failed, or has no room for the results.
    pub fn beside(renderer: &Renderer) -> Result<Self, RenderError> {
        let device = &renderer.device;
        let (gpu, fetch) = (device.gpu.clone(), device.fetch);
        let (scene, view) = (renderer.scene.clone(), renderer.view.clone());
        gpu.check_limits(bindings::needs(&scene, &view, fetch, MAX_RAYS))?;
        let layouts = Layouts::new(&gpu, fetch);
        let buffers = device.buffers.beside(&gpu, &layouts, &view, MAX_RAYS)?;
        Ok(Self {
            gpu,
            fetch,
            as_packets: renderer.policy.fetch.allows_packets(),
            layouts,
            buffers,
            scene,
            view,
        })
    }

    /// The object of a hit; `None` if it belongs to none.
    pub fn object_of(&self, hit: &QueryHit) -> Option<ObjectRef> {
        (self.scene).object_at(&self.view, hit.primitive, hit.instance)
    }

    /// Bytes of a node of the tree on the device: 64 with planes as bytes, 112 with planes as floats.
    pub fn node_bytes(&self) -> u64 {
        u64::from(arrays::node_rows(self.fetch)) * arrays::ROW_BYTES
    }

    /// The closest hit of each ray.
    ///
    /// # Errors
    /// The device failed, or the driver ends the traversal of a ray early.
    pub async fn closest_hits_async(
        &self,
        rays: &[QueryRay],
    ) -> Result<Vec<Option<QueryHit>>, RenderError> {
        self.closest_hits_of_async(&self.batch(rays)?).await
    }

    /// For each ray whether there is a surface between its origin and its `t_max`.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn occluded_async(&self, rays: &[QueryRay]) -> Result<Vec<bool>, RenderError> {
        self.occluded_of_async(&self.batch(rays)?).await
    }

    /// [`Self::closest_hits_async`] of rays on the device.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn closest_hits_of_async(
        &self,
        batch: &RayBatch,
    ) -> Result<Vec<Option<QueryHit>>, RenderError> {
        let rows = self.rows(batch, RayTest::Closest).await?;
        Ok(rows.into_iter().map(QueryHit::of).collect())
    }

    /// [`Self::occluded_async`] of rays on the device.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn occluded_of_async(&self, batch: &RayBatch) -> Result<Vec<bool>, RenderError> {
        let rows = self.rows(batch, RayTest::Any).await?;
        let is_hit = |[_, primitive, ..]: [u32; 4]| primitive != NONE;
        Ok(rows.into_iter().map(is_hit).collect())
    }

    /// The traversal steps of each ray if it is traced alone, whatever the coherence of the batch. They do not depend on the
    /// adapter's speed, so they show whether a tree or a traversal has become better or worse.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn steps_async(
        &self,
        batch: &RayBatch,
        test: RayTest,
    ) -> Result<Vec<RaySteps>, RenderError> {
        (self.counted(batch, test, pipelines::portable(self.fetch))).await
    }

    /// For each ray the traversal steps of its packet if all rays are traced in packets of [`Self::packet_rays`], in their
    /// order and whatever the coherence of the batch: each ray of a packet is tested against every box and primitive on
    /// its way. `None` if this query traces no packets, or one exceeds its stack.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn packet_steps_async(
        &self,
        batch: &RayBatch,
        test: RayTest,
    ) -> Result<Option<Vec<RaySteps>>, RenderError> {
        if self.packet_rays().is_none() {
            return Ok(None);
        }
        match self.counted(batch, test, Variant::Packet).await {
            Err(RenderError::PathTooLong(_)) => Ok(None),
            steps => steps.map(Some),
        }
    }

    /// The number of rays of a packet, 32 or 64, if coherent rays are traced in packets: the adapter can do that, the policy
    /// allows it, and nothing moves while the shutter is open.
    pub fn packet_rays(&self) -> Option<u32> {
        let lanes = self.gpu.packet_lanes()?;
        (self.variant(Coherence::Coherent) == Variant::Packet).then_some(LANE_RAYS * lanes)
    }

    /// Traces the rays `passes` times and returns the seconds of one pass, without upload and readback. A GPU's
    /// clock is used where it has one, otherwise the time from submission to completion. The first pass of a
    /// test may include its compilation.
    ///
    /// # Errors
    /// As [`Self::closest_hits_async`].
    pub async fn seconds_async(
        &self,
        batch: &RayBatch,
        test: RayTest,
        passes: u32,
    ) -> Result<f64, RenderError> {
        let passes = passes.max(1);
        let seconds = self.with_pipeline(batch, test, async |pipeline| {
            let mut seconds = 0.0;
            for chunk in &batch.chunks {
                seconds += self.dispatch(chunk, pipeline, passes, None).await?;
            }
            Ok(seconds)
        });
        Ok(seconds.await? / f64::from(passes))
    }

    /// Uploads rays.
    ///
    /// # Errors
    /// The device failed.
    pub fn batch(&self, rays: &[QueryRay]) -> Result<RayBatch, RenderError> {
        let chunks = rays.chunks(MAX_RAYS).map(|rays| self.chunk(rays));
        Ok(RayBatch {
            chunks: chunks.collect::<Result<_, GpuError>>()?,
            coherence: Coherence::default(),
        })
    }

    fn chunk(&self, rays: &[QueryRay]) -> Result<Chunk, GpuError> {
        let rows = rays.iter().map(|ray| ray.rows(self.scene.origin));
        let mut rows: Vec<_> = rows.collect();
        // Rays of negative length, which hit nothing, fill the last workgroup.
        rows.resize(
            rays.len().next_multiple_of(GROUP_RAYS),
            [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 1.0, 0.0]],
        );
        let array = Array::of_rows("rays", cast_slice(&rows));
        let uploaded = Rows::allocate(&self.gpu, self.fetch, &array, array.bytes)?;
        array.write(&self.gpu, &uploaded, &[], &mut Uploads::default())?;
        let group = (self.buffers).query_group(&self.gpu, &self.layouts, &uploaded);
        Ok(Chunk {
            ray_count: rays.len(),
            group,
        })
    }

    /// The results of all rays, as `scene/query.wesl` stores them.
    async fn rows(&self, batch: &RayBatch, test: RayTest) -> Result<Vec<[u32; 4]>, RenderError> {
        let rows = self.with_pipeline(batch, test, async |pipeline| {
            self.rows_of(batch, pipeline).await
        });
        rows.await
    }

    async fn counted(
        &self,
        batch: &RayBatch,
        test: RayTest,
        variant: Variant,
    ) -> Result<Vec<RaySteps>, RenderError> {
        let pipeline = self.pipeline(test, true, variant, Stack::Deepest)?;
        let rows = self.rows_of(batch, &pipeline).await?;
        let steps = |[_, _, nodes, primitives]: [u32; 4]| RaySteps { nodes, primitives };
        Ok(rows.into_iter().map(steps).collect())
    }

    async fn rows_of(
        &self,
        batch: &RayBatch,
        pipeline: &wgpu::ComputePipeline,
    ) -> Result<Vec<[u32; 4]>, RenderError> {
        let mut all = Vec::new();
        for chunk in &batch.chunks {
            (self.dispatch(chunk, pipeline, 1, Some(&mut all))).await?;
        }
        Ok(all)
    }

    /// The kernel for rays of this coherence.
    fn variant(&self, coherence: Coherence) -> Variant {
        match self.as_packets && coherence == Coherence::Coherent {
            true => pipelines::tracing_variant(&self.gpu, self.fetch, &self.view),
            false => pipelines::portable(self.fetch),
        }
    }

    /// Calls `trace` with a pipeline, and again with that of the portable kernel and the largest stack if a ray or a packet
    /// exceeds its stack, or a packet the loop limit of the driver.
    async fn with_pipeline<T>(
        &self,
        batch: &RayBatch,
        test: RayTest,
        mut trace: impl AsyncFnMut(&wgpu::ComputePipeline) -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        let variant = self.variant(batch.coherence);
        match trace(&self.pipeline(test, false, variant, Stack::Usual)?).await {
            Err(RenderError::PathTooLong(_)) => {
                let portable = pipelines::portable(self.fetch);
                trace(&self.pipeline(test, false, portable, Stack::Deepest)?).await
            }
            traced => traced,
        }
    }

    fn pipeline(
        &self,
        test: RayTest,
        counts_steps: bool,
        variant: Variant,
        stack: Stack,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let is_any = test == RayTest::Any;
        let overrides = overrides::of_query(&self.scene, &self.view, is_any, counts_steps, stack);
        let (gpu, layouts) = (&self.gpu, &self.layouts);
        let Compiled { pipeline, .. } = pipelines::tracing(
            gpu,
            variant,
            layouts,
            (Kernel::TRACE_RAYS, stack),
            overrides,
        )?;
        Ok(pipeline)
    }

    /// Traces the rays `passes` times, appends the results to `all`, and returns the seconds that it took.
    async fn dispatch(
        &self,
        chunk: &Chunk,
        pipeline: &wgpu::ComputePipeline,
        passes: u32,
        all: Option<&mut Vec<[u32; 4]>>,
    ) -> Result<f64, RenderError> {
        let Self { gpu, buffers, .. } = self;
        let groups = chunk.group_count();
        gpu.write(&buffers.dispatch, 0, bytes_of(&self.packed(groups)))?;
        let timer = gpu.timer()?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: None,
                timestamp_writes: timer.writes(),
            });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &chunk.group, &[]);
            pass.set_bind_group(1, &buffers.frame_group, &[]);
            pass.set_bind_group(2, &buffers.film_group, &[]);
            for _ in 0..passes {
                pass.dispatch_workgroups(groups, 1, 1);
            }
        }
        let mut sources = vec![device::counters(&buffers.dispatch)];
        sources.extend(timer.resolve(&mut encoder));
        if all.is_some() {
            sources.push(Source {
                buffer: &buffers.film,
                offset: 0,
                bytes: chunk.ray_count as u64 * ROW_BYTES,
            });
        }
        let started = Instant::now();
        let reading = gpu.submit_reading(encoder, &sources, &buffers.staging)?;
        let read = gpu.read(reading, |bytes| {
            let (counters, bytes) = bytes.split_at(size_of::<PackedCounters>());
            let waited = started.elapsed().as_secs_f64();
            let (seconds, rows) = timer.split(bytes);
            if let Some(all) = all {
                all.extend(pod_collect_to_vec::<u8, [u32; 4]>(rows));
            }
            (
                pod_read_unaligned::<PackedCounters>(counters),
                seconds.unwrap_or(waited),
            )
        });
        let (counters, seconds) = read.await?;
        // A driver that stops a dispatch is treated as lost.
        if counters.finished_groups() != groups * passes {
            return Err(GpuError::Lost.into());
        }
        match counters.cut_off {
            0 => Ok(seconds),
            _ => Err(RenderError::PathTooLong(LongPath::Crowded)),
        }
    }

    /// The dispatch parameters of so many workgroups. A software renderer gives each thread one contiguous part of them: there
    /// they visit the rays in strides of about the square root of their number. Elsewhere neighbours run at the same time,
    /// and share a cache.
    fn packed(&self, groups: u32) -> PackedDispatch {
        let group_stride = match self.gpu.is_cpu() {
            true => coprime_stride(groups.isqrt() + 1, groups),
            false => 1,
        };
        PackedDispatch {
            group_count: groups,
            group_stride,
            ..Default::default()
        }
    }
}
