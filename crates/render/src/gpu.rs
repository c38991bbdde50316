//! The GPU device: choosing an adapter, opening the device, detecting its loss. Every failure becomes a
//! [`GpuError`].
//!
//! wgpu reports the loss of a device through a callback, and `poll` panics after it; see `guard.rs`.
//! Allocation and pipeline creation run inside error scopes. Only `blocking.rs` waits for the
//! device. On software adapters `lanes.rs` calls it once for each device. A browser has neither.

mod adapter;
#[cfg(not(target_arch = "wasm32"))]
pub mod blocking;
mod buffer;
mod early;
mod error;
mod fault;
mod gate;
mod guard;
#[cfg(not(target_arch = "wasm32"))]
mod lanes;
mod limits;
mod patience;
mod readback;
mod shader;
mod timer;
mod trusted;

pub use adapter::{AdapterChoice, AdapterReport, Backend, adapter_identity, adapters_async};
#[cfg(not(target_arch = "wasm32"))]
pub use blocking::adapters;
pub use buffer::{Ledger, MEMORY_LIMIT_BYTES};
pub use early::EarlyModule;
pub use error::GpuError;
pub use glimray_shaders::{Kernel, Variant, bound_loops, inline_functions};
pub use guard::{is_guarded, surviving_loss};
pub(crate) use readback::{Reading, Source, Submitted};
pub(crate) use shader::Compiled;
pub use shader::Overrides;
pub(crate) use timer::Timer;
pub use trusted::runtime_checks;

use gate::Gate;
use limits::limits_for;
use std::{
    pin::pin,
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
    },
    task::{Context, Poll, Waker},
};

/// Workgroup memory of packet kernels, for the stacks of their ray trees.
const PACKET_WORKGROUP_BYTES: u32 = 32_256;

/// Features that are used where the adapter has them.
const OPTIONAL_FEATURES: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY;

/// An open device with its queue. A clone refers to the same device.
#[derive(Clone)]
pub struct Gpu {
    choice: AdapterChoice,
    report: AdapterReport,
    pub(crate) instance: wgpu::Instance,
    pub(crate) adapter: wgpu::Adapter,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    /// Whether it was opened here. The device of another program is not replaced when it is lost.
    is_own: bool,
    lost: Arc<AtomicBool>,
    /// The first error outside of any error scope.
    stray_error: Arc<Mutex<Option<GpuError>>>,
    /// Compiled pipelines, kept because the next renderer on this device may need the same ones.
    pipelines: Arc<Mutex<shader::Pipelines>>,
    early: Arc<Mutex<Option<EarlyModule>>>,
    /// Whether its lanes have been tried: see `lanes.rs`.
    #[cfg_attr(
        target_arch = "wasm32",
        expect(dead_code, reason = "browsers keep no kernels of others")
    )]
    lanes_proved: Arc<AtomicBool>,
    /// Called before a pipeline is compiled.
    on_compilation: Option<Arc<dyn Fn() + Send + Sync>>,
    gate: Arc<Gate>,
}

/// Storage images of a kernel that reads the scene from images. WebGPU guarantees four.
const STORAGE_IMAGES: u32 = 5;

/// Required limits that may exceed the defaults of WebGPU.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// The largest buffer that a shader binds as a whole, in bytes.
    pub binding_bytes: u64,
    /// The longest side of a texture, in texels.
    pub texture_side: u32,
}

impl Gpu {
    /// Opens the adapter that `choice` names, or the fastest kind available. The device requires only the default limits of
    /// WebGPU, and a fifth storage image where the adapter has it. The device has subgroups where [`Gpu::traces_packets`]. In a
    /// browser this is [`Gpu::open_with_all_limits`].
    ///
    /// # Errors
    /// There is no such adapter, or it cannot be opened.
    pub async fn open(choice: &AdapterChoice) -> Result<Self, GpuError> {
        match cfg!(target_arch = "wasm32") {
            true => Self::open_with_all_limits(choice).await,
            false => Self::open_for(choice, Needs::default()).await,
        }
    }

    /// Opens an adapter with limits that meet `needs`.
    async fn open_for(choice: &AdapterChoice, needs: Needs) -> Result<Self, GpuError> {
        let found = adapter::choose(choice).await?;
        let required_limits = limits_for(needs, &found.adapter.limits())?;
        Self::request(found, choice, required_limits).await
    }

    /// Another device on the adapter that `choice` names, for one that [`Self::can_be_replaced`].
    pub(crate) fn reopened(choice: &AdapterChoice, needs: Needs) -> Result<Self, GpuError> {
        now(Self::open_for(choice, needs)).unwrap_or(Err(GpuError::Lost))
    }

    /// Opens an adapter with its maximum buffer and texture limits, for a device that is shared with other code
    /// and for browsers: neither can be replaced by one with higher limits.
    ///
    /// # Errors
    /// As [`Gpu::open`].
    pub async fn open_with_all_limits(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let found = adapter::choose(choice).await?;
        let most = found.adapter.limits();
        let required_limits = wgpu::Limits {
            max_storage_buffer_binding_size: most.max_storage_buffer_binding_size,
            max_buffer_size: most.max_buffer_size,
            max_texture_dimension_2d: most.max_texture_dimension_2d,
            ..limits_for(Needs::default(), &most)?
        };
        Self::request(found, choice, required_limits).await
    }

    async fn request(
        found: adapter::Found,
        choice: &AdapterChoice,
        required_limits: wgpu::Limits,
    ) -> Result<Self, GpuError> {
        let adapter::Found {
            instance,
            adapter,
            report,
        } = found;
        let (required_features, workgroup_bytes) = match adapter::packet_lanes(&adapter) {
            Some(_) => (wgpu::Features::SUBGROUP, PACKET_WORKGROUP_BYTES),
            None => (wgpu::Features::empty(), 0),
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("glimray"),
            required_features: required_features | (adapter.features() & OPTIONAL_FEATURES),
            required_limits: wgpu::Limits {
                max_compute_workgroup_storage_size: required_limits
                    .max_compute_workgroup_storage_size
                    .max(workgroup_bytes),
                ..required_limits
            },
            ..Default::default()
        };
        let opened = adapter.request_device(&descriptor).await;
        let (device, queue) =
            opened.map_err(|error| error::no_device(&report.name, &error.to_string()))?;
        let lost = Arc::new(AtomicBool::new(false));
        let on_loss = lost.clone();
        // The callback may run while locks are held, so it only sets a flag.
        device.set_device_lost_callback(move |_, _| on_loss.store(true, Ordering::Release));
        let stray_error = Arc::new(Mutex::new(None));
        let slot = stray_error.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if !error::is_busy_surface(&error)
                && let Ok(mut slot) = slot.lock()
            {
                slot.get_or_insert(error::stray(&error));
            }
        }));
        Ok(Self {
            choice: choice.clone(),
            report,
            is_own: true,
            lost,
            stray_error,
            ..Self::from_wgpu(instance, adapter, device, queue)
        })
    }

    /// Wraps a device that another program opened, with its instance, adapter and queue. It needs at least the default
    /// limits of WebGPU; with five storage images in a shader, kernels can read the scene from images. The program keeps
    /// control of it: its limits decide which scenes can be rendered, its callbacks are not touched, and if it is lost the
    /// program has to open another one ([`GpuError::Lost`]). [`crate::Screen`] has an example.
    pub fn from_wgpu(
        instance: wgpu::Instance,
        adapter: wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
    ) -> Self {
        Self {
            choice: AdapterChoice::default(),
            report: adapter::report(0, &adapter),
            instance,
            adapter,
            device,
            queue,
            is_own: false,
            lost: Arc::default(),
            stray_error: Arc::default(),
            pipelines: Arc::default(),
            early: Arc::default(),
            lanes_proved: Arc::default(),
            on_compilation: None,
            gate: Arc::default(),
        }
    }

    /// Calls `report` before the device compiles a pipeline: that takes seconds on some drivers.
    pub fn reporting_compilation(self, report: impl Fn() + Send + Sync + 'static) -> Self {
        Self {
            on_compilation: Some(Arc::new(report)),
            ..self
        }
    }

    /// Whether the device was opened here, not passed to [`Gpu::from_wgpu`].
    pub fn is_own(&self) -> bool {
        self.is_own
    }

    /// Whether a renderer may open another device in its place: not for one of another program, and not in a browser, which
    /// opens them later.
    pub(crate) fn can_be_replaced(&self) -> bool {
        self.is_own && !cfg!(target_arch = "wasm32")
    }

    /// This device if it meets `needs`, otherwise a new one on the same adapter with higher limits.
    pub(crate) fn with_limits_for(self, needs: Needs) -> Result<Self, GpuError> {
        if self.meets(needs) {
            return Ok(self);
        }
        self.check_limits(needs)?;
        let opened = Self::reopened(&self.choice, needs)?;
        Ok(Self {
            early: self.early,
            on_compilation: self.on_compilation,
            ..opened
        })
    }

    /// Checks that a device on this adapter can meet `needs`. One that cannot be replaced has fixed limits.
    pub(crate) fn check_limits(&self, needs: Needs) -> Result<(), GpuError> {
        if self.can_be_replaced() {
            return limits_for(needs, &self.adapter.limits()).map(drop);
        }
        let has = self.device.limits();
        let buffer = has.max_buffer_size.min(has.max_storage_buffer_binding_size);
        let side = u64::from(has.max_texture_dimension_2d);
        let needed = [
            ("one storage buffer", needs.binding_bytes, buffer, true),
            (
                "texels along a texture's side",
                needs.texture_side.into(),
                side,
                false,
            ),
        ];
        match needed.into_iter().find(|(_, need, limit, _)| need > limit) {
            Some((name, need, limit, in_bytes)) => Err(GpuError::Limit {
                name,
                need,
                limit,
                in_bytes,
            }),
            None => Ok(()),
        }
    }

    /// Whether the limits of this device meet `needs`.
    pub(crate) fn meets(&self, needs: Needs) -> bool {
        let limits = self.device.limits();
        needs.binding_bytes <= limits.max_storage_buffer_binding_size
            && needs.binding_bytes <= limits.max_buffer_size
            && needs.texture_side <= limits.max_texture_dimension_2d
    }

    /// Whether kernels can read the scene from images.
    pub(crate) fn reads_images(&self) -> bool {
        self.device.limits().max_storage_textures_per_shader_stage >= STORAGE_IMAGES
    }

    /// The wgpu handles of the device, for other code that draws with it.
    pub fn handles(&self) -> (wgpu::Instance, wgpu::Adapter, wgpu::Device, wgpu::Queue) {
        (
            self.instance.clone(),
            self.adapter.clone(),
            self.device.clone(),
            self.queue.clone(),
        )
    }

    /// The choice with which this device was opened.
    pub(crate) fn choice(&self) -> &AdapterChoice {
        &self.choice
    }

    /// The adapter that this device runs on.
    pub fn adapter(&self) -> &AdapterReport {
        &self.report
    }

    /// Whether the lanes of a subgroup can trace their rays together, as on lavapipe. Subgroups must have exactly
    /// 8 or exactly 16 lanes.
    pub fn traces_packets(&self) -> bool {
        self.packet_lanes().is_some()
    }

    /// The number of lanes of a subgroup, if they can trace their rays together.
    pub(crate) fn packet_lanes(&self) -> Option<u32> {
        let has_needs = self.device.features().contains(wgpu::Features::SUBGROUP)
            && self.device.limits().max_compute_workgroup_storage_size >= PACKET_WORKGROUP_BYTES;
        adapter::packet_lanes(&self.adapter).filter(|_| has_needs)
    }

    /// Whether the adapter is a software renderer.
    pub fn is_cpu(&self) -> bool {
        self.report.is_cpu()
    }

    /// Loses the device, as a driver reset would, to test recovery.
    pub fn lose(&self) {
        // wgpu reports a driver reset at once, but a destroyed device only once it is idle.
        self.lost.store(true, Ordering::Release);
        self.device.destroy();
    }

    /// Whether the device has been lost.
    pub fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Acquire)
    }

    /// Workgroups along x of a dispatch with this many `columns`: one fewer if a fault injection simulates a
    /// driver that cuts the dispatch short.
    pub(crate) fn dispatch_columns(&self, columns: u32) -> u32 {
        columns - u32::from(fault::should_fail(fault::Site::Dispatch))
    }

    /// Submits without waiting.
    pub(crate) fn enqueue(
        &self,
        commands: wgpu::CommandBuffer,
    ) -> Result<wgpu::SubmissionIndex, GpuError> {
        if fault::should_fail(fault::Site::Device) {
            self.lose();
        }
        let submit = || self.queue.submit([commands]);
        guard::catch(|| self.gate.pass(submit)).map_err(|()| GpuError::Lost)
    }

    /// Lets only the current thread submit work, until [`Gpu::release_submissions`]: for a window that draws with this device
    /// and is about to configure its surface. wgpu refuses that while others submit.
    pub fn hold_submissions(&self) {
        self.gate.hold();
    }

    /// Lets all threads submit work again.
    pub fn release_submissions(&self) {
        self.gate.release();
    }

    /// Returns any error that was not reported where it occurred.
    fn check(&self) -> Result<(), GpuError> {
        if self.is_lost() {
            return Err(GpuError::Lost);
        }
        match self
            .stray_error
            .lock()
            .ok()
            .and_then(|mut slot| slot.take())
        {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Whether this device belongs to another program and is lost. The loss callback informs only that program.
    /// wgpu silently creates buffers on a lost device and then reports them as invalid.
    fn is_others_and_lost(&self) -> bool {
        if self.is_own {
            return false;
        }
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let tried = guard::catch(|| {
            let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("probe"),
                size: 4,
                usage: wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            self.queue.write_buffer(&buffer, 0, &[0; 4]);
        });
        let is_lost = now(scope.pop()).flatten().is_some() || tried.is_err();
        self.lost.fetch_or(is_lost, Ordering::AcqRel);
        is_lost
    }

    /// Runs `make` inside error scopes and converts caught errors. A browser tells errors later: there the device reports
    /// them, and [`Self::check`].
    fn scoped<T>(&self, what: &str, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        if cfg!(target_arch = "wasm32") {
            return Ok(make());
        }
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let made = guard::catch(make);
        let invalid = now(validation.pop()).flatten();
        let exhausted = now(memory.pop()).flatten();
        if self.is_lost() {
            return Err(GpuError::Lost);
        }
        if exhausted.is_some() {
            return Err(GpuError::OutOfMemory { what: what.into() });
        }
        if let Some(error) = invalid {
            if self.is_others_and_lost() {
                return Err(GpuError::Lost);
            }
            return Err(GpuError::Internal {
                what: format!("{what}: {error}"),
            });
        }
        made.map_err(|_| GpuError::Lost)
    }
}

/// The output of a future that has it at once, as those of wgpu have everywhere but in browsers.
fn now<T>(future: impl Future<Output = T>) -> Option<T> {
    match pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(output) => Some(output),
        Poll::Pending => None,
    }
}
