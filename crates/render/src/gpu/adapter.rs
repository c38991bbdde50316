//! Lists the adapters and chooses one.

use super::{GpuError, guard};

/// A graphics API that wgpu can drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// Vulkan, also supported by Mesa's software renderer.
    Vulkan,
    /// Metal, on Apple's systems.
    Metal,
    /// Direct3D 12, on Windows.
    Dx12,
    /// OpenGL and OpenGL ES.
    Gl,
}

impl Backend {
    /// Why this backend is unavailable on this platform whatever is installed, as a clause; `None` if it may be
    /// available.
    pub fn absence(self) -> Option<&'static str> {
        let is_apple = cfg!(target_vendor = "apple");
        match self {
            Self::Vulkan if is_apple => Some("this program uses Metal on Apple's systems"),
            Self::Metal if !is_apple => Some("only Apple's systems have Metal"),
            Self::Dx12 if !cfg!(windows) => Some("only Windows has DirectX 12"),
            Self::Gl if cfg!(not(feature = "gl")) => {
                Some("this program was built without it, the cargo feature `gl`")
            }
            _ => None,
        }
    }

    /// The backend's name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vulkan => "vulkan",
            Self::Metal => "metal",
            Self::Dx12 => "dx12",
            Self::Gl => "gl",
        }
    }
}

/// The choice of an adapter; the default chooses automatically.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AdapterChoice {
    /// The backend to use; all if `None`.
    pub backend: Option<Backend>,
    /// An index into [`adapters_async`], or part of a name, case-insensitive.
    pub adapter: Option<String>,
}

/// An adapter and its capabilities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterReport {
    /// Index in [`adapters_async`].
    pub index: usize,
    /// The name that the driver reports.
    pub name: String,
    /// "vulkan", "metal", "dx12" or "gl".
    pub backend: String,
    /// The driver's name and version; may be empty.
    pub driver: String,
    /// "discrete_gpu", "integrated_gpu", "virtual_gpu", "cpu" or "other".
    pub device_type: String,
    /// Maximum size of a buffer, in bytes.
    pub max_buffer_bytes: u64,
    /// Maximum size of a storage buffer binding, in bytes.
    pub max_binding_bytes: u64,
    /// Maximum side of a 2-D texture, in texels.
    pub max_texture_2d: u32,
    /// Maximum number of storage buffers in a compute shader.
    pub storage_buffers_per_stage: u32,
}

impl AdapterReport {
    /// The identity, which decides how the adapter rounds: see [`adapter_identity`].
    pub fn identity(&self) -> String {
        adapter_identity(&self.name, &self.backend, &self.driver)
    }
}

/// An adapter with its backend and its driver as `NAME (BACKEND, DRIVER)`. Two adapters with the same identity give the same
/// bytes.
pub fn adapter_identity(name: &str, backend: &str, driver: &str) -> String {
    match driver {
        "" => format!("{name} ({backend})"),
        driver => format!("{name} ({backend}, {driver})"),
    }
}

/// An adapter to open a device on.
pub(super) struct Found {
    pub instance: wgpu::Instance,
    pub adapter: wgpu::Adapter,
    pub report: AdapterReport,
}

/// All adapters that can run compute shaders, in the order of their indices. A browser tells one.
pub async fn adapters_async(choice: &AdapterChoice) -> Vec<AdapterReport> {
    let (_, adapters) = enumerate(allowed_backends(choice)).await;
    adapters
        .iter()
        .enumerate()
        .map(|(index, adapter)| report(index, adapter))
        .collect()
}

/// The requested adapter, otherwise the first of the best kind: discrete, integrated, virtual, software; among
/// equals a modern API before GL.
pub(super) async fn choose(choice: &AdapterChoice) -> Result<Found, GpuError> {
    if let Some((backend, why)) = choice.backend.and_then(|b| Some((b.name(), b.absence()?))) {
        return Err(GpuError::NoBackend { backend, why });
    }
    // Enumerating GL devices takes as long as rendering a small picture, so it happens only if necessary.
    let mut enumerated = match (choice.backend, &choice.adapter) {
        (None, None) => enumerate(wgpu::Backends::PRIMARY).await,
        _ => (None, Vec::new()),
    };
    if enumerated.1.is_empty() {
        enumerated = enumerate(allowed_backends(choice)).await;
    }
    let (instance, mut found) = enumerated;
    let reports: Vec<_> = found
        .iter()
        .enumerate()
        .map(|(i, a)| report(i, a))
        .collect();
    let Some(instance) = instance.filter(|_| !found.is_empty()) else {
        let tried = choice
            .backend
            .map_or("every backend".into(), |b| format!("{b:?}"));
        return Err(GpuError::NoAdapter { tried });
    };
    let index = match &choice.adapter {
        Some(wanted) => reports
            .iter()
            .position(|r| matches(r, wanted))
            .ok_or_else(|| no_such_adapter(wanted, &reports))?,
        None => (0..reports.len())
            .min_by_key(|&i| preference(&reports[i]))
            .unwrap_or(0),
    };
    Ok(Found {
        instance,
        adapter: found.swap_remove(index),
        report: reports[index].clone(),
    })
}

fn matches(report: &AdapterReport, wanted: &str) -> bool {
    match wanted.parse::<usize>() {
        Ok(index) => report.index == index,
        Err(_) => report.name.to_lowercase().contains(&wanted.to_lowercase()),
    }
}

fn no_such_adapter(wanted: &str, reports: &[AdapterReport]) -> GpuError {
    let present: Vec<_> = (reports.iter())
        .map(|r| format!("{} {} ({})", r.index, r.name, r.backend))
        .collect();
    GpuError::NoSuchAdapter {
        wanted: wanted.into(),
        present: present.join(", "),
    }
}

fn preference(report: &AdapterReport) -> (usize, bool, usize) {
    let kinds = [
        "discrete_gpu",
        "integrated_gpu",
        "virtual_gpu",
        "other",
        "cpu",
    ];
    let kind = kinds.iter().position(|kind| *kind == report.device_type);
    (
        kind.unwrap_or(kinds.len()),
        report.backend == "gl",
        report.index,
    )
}

/// The backends that a choice allows.
fn allowed_backends(choice: &AdapterChoice) -> wgpu::Backends {
    match choice.backend {
        None => wgpu::Backends::PRIMARY | wgpu::Backends::GL,
        Some(Backend::Vulkan) => wgpu::Backends::VULKAN,
        Some(Backend::Metal) => wgpu::Backends::METAL,
        Some(Backend::Dx12) => wgpu::Backends::DX12,
        Some(Backend::Gl) => wgpu::Backends::GL,
    }
}

/// The adapters that can run compute shaders, and their instance.
async fn enumerate(backends: wgpu::Backends) -> (Option<wgpu::Instance>, Vec<wgpu::Adapter>) {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    // There are no indirect dispatches, so validating them would only cost start-up time.
    descriptor
        .flags
        .remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    descriptor.memory_budget_thresholds = wgpu::MemoryBudgetThresholds {
        for_resource_creation: Some(90),
        for_device_loss: Some(97),
    };
    let found = guard::catch(|| {
        let instance = wgpu::Instance::new(descriptor);
        let adapters = instance.enumerate_adapters(backends);
        (instance, adapters)
    });
    let (instance, found) = match found {
        Ok((instance, adapters)) => (Some(instance), adapters.await),
        Err(()) => (None, Vec::new()),
    };
    let has_compute = |adapter: &wgpu::Adapter| {
        let flags = adapter.get_downlevel_capabilities().flags;
        flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS)
    };
    (instance, found.into_iter().filter(has_compute).collect())
}

/// The number of lanes of all subgroups of the adapter, 8 or 16, if packet kernels exist for it and the adapter has the memory
/// that they need.
pub(super) fn packet_lanes(adapter: &wgpu::Adapter) -> Option<u32> {
    let info = adapter.get_info();
    let lanes = info.subgroup_min_size;
    let can_trace = info.subgroup_max_size == lanes
        && [8, 16].contains(&lanes)
        && adapter.features().contains(wgpu::Features::SUBGROUP)
        && adapter.limits().max_compute_workgroup_storage_size >= super::PACKET_WORKGROUP_BYTES;
    can_trace.then_some(lanes)
}

/// The report of an adapter with this index.
pub(super) fn report(index: usize, adapter: &wgpu::Adapter) -> AdapterReport {
    let info = adapter.get_info();
    let limits = adapter.limits();
    AdapterReport {
        index,
        name: info.name,
        backend: info.backend.to_str().into(),
        driver: [info.driver, info.driver_info].join(" ").trim().into(),
        device_type: match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete_gpu",
            wgpu::DeviceType::IntegratedGpu => "integrated_gpu",
            wgpu::DeviceType::VirtualGpu => "virtual_gpu",
            wgpu::DeviceType::Cpu => "cpu",
            wgpu::DeviceType::Other => "other",
        }
        .into(),
        max_buffer_bytes: limits.max_buffer_size,
        max_binding_bytes: limits.max_storage_buffer_binding_size,
        max_texture_2d: limits.max_texture_dimension_2d,
        storage_buffers_per_stage: limits.max_storage_buffers_per_shader_stage,
    }
}
