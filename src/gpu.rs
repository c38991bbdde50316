//! The device: finding an adapter, opening it, noticing when it is lost, and every way it can fail
//! turned into a [`GpuError`].
//!
//! wgpu reports the loss of a device through a callback and panics in `poll` after it; see
//! `Gpu::wait`. Allocation and pipeline creation run inside error scopes.

mod adapter;
mod buffer;
mod error;
mod fault;
mod guard;
mod readback;
mod shader;
mod specialize;

pub use adapter::{AdapterChoice, AdapterReport, Backend, adapters};
pub use buffer::{Ledger, MEMORY_LIMIT_BYTES};
pub use error::GpuError;
pub use guard::{is_guarded, surviving_loss};
pub(crate) use readback::{Reading, Source};
pub(crate) use shader::Compiled;
pub use shader::{Kernel, Overrides};

use std::{
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// How long one wait for the device may take, and how many of them are tried before the device
/// counts as lost.
const WAIT: Duration = Duration::from_secs(10);
const WAITS: u32 = 3;

/// An open device with its queue. A clone is the same device.
#[derive(Clone)]
pub struct Gpu {
    choice: AdapterChoice,
    report: AdapterReport,
    pub(crate) instance: wgpu::Instance,
    pub(crate) adapter: wgpu::Adapter,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    /// Whether it was opened here. Another's device is not replaced when it is lost.
    is_own: bool,
    lost: Arc<AtomicBool>,
    /// The first error that no scope caught.
    stray_error: Arc<Mutex<Option<String>>>,
    /// What was compiled so far: the next renderer on this device may need the same.
    pipelines: Arc<Mutex<shader::Pipelines>>,
}

/// Sizes that may exceed WebGPU's default limits, in bytes and texels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// The largest buffer that a shader reads or writes as a whole.
    pub binding_bytes: u64,
    /// The longest side of a texture.
    pub texture_side: u32,
}

impl Gpu {
    /// Opens the adapter that `choice` names, or the fastest kind there is. It asks for no feature
    /// and for no more than WebGPU's default limits.
    pub fn new(choice: &AdapterChoice) -> Result<Self, GpuError> {
        Self::open(choice, Needs::default())
    }

    /// Opens an adapter with limits that serve `needs`.
    pub(crate) fn open(choice: &AdapterChoice, needs: Needs) -> Result<Self, GpuError> {
        let found = adapter::choose(choice)?;
        let required_limits = limits_for(needs, &found.adapter.limits())?;
        Self::request(found, choice, required_limits)
    }

    /// Opens an adapter with limits that serve whatever it can serve at all. For a device that is
    /// shared, and so cannot give way to one with higher limits.
    pub fn with_all_limits(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let found = adapter::choose(choice)?;
        let most = found.adapter.limits();
        let required_limits = wgpu::Limits {
            max_storage_buffer_binding_size: most.max_storage_buffer_binding_size,
            max_buffer_size: most.max_buffer_size,
            max_texture_dimension_2d: most.max_texture_dimension_2d,
            ..limits_for(Needs::default(), &most)?
        };
        Self::request(found, choice, required_limits)
    }

    fn request(
        found: adapter::Found,
        choice: &AdapterChoice,
        required_limits: wgpu::Limits,
    ) -> Result<Self, GpuError> {
        let adapter::Found {
            instance,
            adapter,
            report,
        } = found;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("glimray"),
            required_limits,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| no_device(&report.name, &error.to_string()))?;
        let lost = Arc::new(AtomicBool::new(false));
        let on_loss = lost.clone();
        // The callback may run with locks held, so it only sets a flag.
        device.set_device_lost_callback(move |_, _| on_loss.store(true, Ordering::Release));
        let stray_error = Arc::new(Mutex::new(None));
        let slot = stray_error.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut slot) = slot.lock() {
                slot.get_or_insert(error.to_string());
            }
        }));
        Ok(Self {
            choice: choice.clone(),
            report,
            instance,
            adapter,
            device,
            queue,
            is_own: true,
            lost,
            stray_error,
            pipelines: Arc::default(),
        })
    }

    /// A device that a program has already, with what it came from. It stays the program's: its limits
    /// decide what can be rendered, its callbacks are not touched, and when it is lost the program opens
    /// another one ([`GpuError::Lost`]). At least WebGPU's default limits are needed.
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
        }
    }

    /// Whether it was opened here, and not given by [`Gpu::from_wgpu`].
    pub fn is_own(&self) -> bool {
        self.is_own
    }

    /// This device if it serves `needs`, else one on the same adapter with higher limits.
    pub(crate) fn with_limits_for(self, needs: Needs) -> Result<Self, GpuError> {
        if self.meets(needs) {
            return Ok(self);
        }
        self.check_limits(needs)?;
        Self::open(&self.choice, needs)
    }

    /// Whether a device on this adapter could have limits that serve `needs`; another's device has those
    /// that it has.
    pub(crate) fn check_limits(&self, needs: Needs) -> Result<(), GpuError> {
        if self.is_own {
            return limits_for(needs, &self.adapter.limits()).map(drop);
        }
        let has = self.device.limits();
        let buffer = has.max_buffer_size.min(has.max_storage_buffer_binding_size);
        let side = u64::from(has.max_texture_dimension_2d);
        let needed = [
            ("bytes in one storage buffer", needs.binding_bytes, buffer),
            (
                "texels along a texture's side",
                needs.texture_side.into(),
                side,
            ),
        ];
        match needed.into_iter().find(|(_, need, limit)| need > limit) {
            Some((name, need, limit)) => Err(GpuError::Limit { name, need, limit }),
            None => Ok(()),
        }
    }

    /// Whether this device's limits allow for `needs`.
    pub(crate) fn meets(&self, needs: Needs) -> bool {
        let limits = self.device.limits();
        needs.binding_bytes <= limits.max_storage_buffer_binding_size
            && needs.binding_bytes <= limits.max_buffer_size
            && needs.texture_side <= limits.max_texture_dimension_2d
    }

    /// The device with what it came from, for others who draw with it.
    pub fn handles(&self) -> (wgpu::Instance, wgpu::Adapter, wgpu::Device, wgpu::Queue) {
        (
            self.instance.clone(),
            self.adapter.clone(),
            self.device.clone(),
            self.queue.clone(),
        )
    }

    /// What this device was asked for by.
    pub(crate) fn choice(&self) -> &AdapterChoice {
        &self.choice
    }

    /// The adapter that this device runs on.
    pub fn adapter(&self) -> &AdapterReport {
        &self.report
    }

    /// Whether the adapter is a software renderer.
    pub fn is_cpu(&self) -> bool {
        self.report.device_type == "cpu"
    }

    /// Loses the device, as a driver reset would. For rehearsing what happens then.
    pub fn lose(&self) {
        // wgpu tells of a driver's reset at once, of a device that is given up only when it is idle.
        self.lost.store(true, Ordering::Release);
        self.device.destroy();
    }

    /// Whether the device has been lost.
    pub fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Acquire)
    }

    /// Workgroups along x of a dispatch that is to have `columns`: one less where a driver that cuts
    /// it short is rehearsed.
    pub(crate) fn dispatch_columns(&self, columns: u32) -> u32 {
        columns - u32::from(fault::should_fail(fault::Site::Dispatch))
    }

    /// Submits and waits until the work is done. A device that is lost, or does not answer within
    /// half a minute, is [`GpuError::Lost`].
    pub(crate) fn submit(&self, commands: wgpu::CommandBuffer) -> Result<(), GpuError> {
        let index = self.enqueue(commands)?;
        self.wait(index)
    }

    /// Submits without waiting.
    pub(crate) fn enqueue(
        &self,
        commands: wgpu::CommandBuffer,
    ) -> Result<wgpu::SubmissionIndex, GpuError> {
        if fault::should_fail(fault::Site::Device) {
            self.lose();
        }
        guard::catch(|| self.queue.submit([commands])).map_err(|()| GpuError::Lost)
    }

    fn wait(&self, index: wgpu::SubmissionIndex) -> Result<(), GpuError> {
        for _ in 0..WAITS {
            let poll = wgpu::PollType::Wait {
                submission_index: Some(index.clone()),
                timeout: Some(WAIT),
            };
            let polled = guard::catch(|| self.device.poll(poll)).map_err(|_| GpuError::Lost)?;
            self.check()?;
            match polled {
                Ok(_) => return Ok(()),
                Err(wgpu::PollError::Timeout) => {}
                Err(_) => return Err(GpuError::Lost),
            }
        }
        Err(GpuError::Lost)
    }

    /// Whether anything went wrong that was not reported where it happened.
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
            Some(what) => Err(GpuError::Internal { what }),
            None => Ok(()),
        }
    }

    /// Whether this is another program's device and lost, of which the callback tells that program alone.
    /// wgpu makes buffers on a lost device without a word, and then finds them invalid.
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
        let is_lost = pollster::block_on(scope.pop()).is_some() || tried.is_err();
        self.lost.fetch_or(is_lost, Ordering::AcqRel);
        is_lost
    }

    /// Runs `make` inside error scopes and turns what they catch into an error.
    fn scoped<T>(&self, what: &str, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let made = guard::catch(make);
        let invalid = pollster::block_on(validation.pop());
        let exhausted = pollster::block_on(memory.pop());
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

/// What it means that a driver refuses to open the adapter. wgpu tells that it lacks memory in words only.
fn no_device(adapter: &str, why: &str) -> GpuError {
    match why.contains("Not enough memory") {
        true => GpuError::OutOfMemory {
            what: format!("opening {adapter}"),
        },
        false => GpuError::NoDevice {
            adapter: adapter.into(),
            why: why.trim_end_matches('.').into(),
        },
    }
}

/// WebGPU's default limits, raised to `needs` where the adapter allows it.
fn limits_for(needs: Needs, adapter: &wgpu::Limits) -> Result<wgpu::Limits, GpuError> {
    let defaults = wgpu::Limits::default();
    let raise = |name, need: u64, default: u64, most: u64| {
        if need > default && need > most {
            return Err(GpuError::Limit {
                name,
                need,
                limit: most,
            });
        }
        Ok(need.max(default).min(most.max(1)))
    };
    let binding = raise(
        "bytes in one storage buffer binding",
        needs.binding_bytes,
        defaults.max_storage_buffer_binding_size,
        adapter.max_storage_buffer_binding_size,
    )?;
    let buffer = raise(
        "bytes in one buffer",
        needs.binding_bytes,
        defaults.max_buffer_size,
        adapter.max_buffer_size,
    )?;
    let side = raise(
        "texels along a texture's side",
        needs.texture_side.into(),
        defaults.max_texture_dimension_2d.into(),
        adapter.max_texture_dimension_2d.into(),
    )?;
    // What an adapter cannot give at all (a GL driver below WebGPU's floor) is not asked for; a
    // shader that needs it is refused when its pipeline is made.
    let floor = defaults.or_worse_values_from(adapter);
    Ok(wgpu::Limits {
        max_storage_buffer_binding_size: binding,
        max_buffer_size: buffer,
        max_texture_dimension_2d: side as u32,
        ..floor
    })
}
