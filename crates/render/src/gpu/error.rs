//! Errors of the device and its driver.

use glimray_scene::bytes::sizes;

/// An error of the device or its driver.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter that can run compute shaders was found.
    #[error(
        "no usable GPU (tried {tried}): no driver was found. {}",
        Self::INSTALL
    )]
    NoAdapter {
        /// The requested backend, or "every backend".
        tried: String,
    },
    /// The requested backend is unavailable on this platform, whatever is installed.
    #[error("no usable GPU ({backend}): {why}. Choose another backend.")]
    NoBackend {
        /// The backend.
        backend: &'static str,
        /// Why it is unavailable, as a clause.
        why: &'static str,
    },
    /// There are adapters, but not the requested one.
    #[error(
        "no such adapter ({wanted}): there are {present}. Name one of them, or part of its name."
    )]
    NoSuchAdapter {
        /// The request: [`super::AdapterChoice::adapter`].
        wanted: String,
        /// Index, name and backend of each available adapter.
        present: String,
    },
    /// The driver failed to open the adapter.
    #[error("the adapter cannot be opened ({adapter}): {why}.")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// The driver's message.
        why: String,
    },
    /// The device is lost, with all data on it. A [`crate::Renderer`] opens another one.
    #[error("the GPU was lost (driver reset or time-out): its work is gone. Try again.")]
    Lost,
    /// Devices were lost, or did not complete their work, too often for one picture.
    #[error("the GPU failed {count} times (driver resets): it cannot finish this picture.")]
    KeptFailing {
        /// The number of failures.
        count: u32,
    },
    /// The scene or picture exceeds a limit of the adapter.
    #[error("too big for this adapter ({name}): {} needed, {} allowed.", amounts(*in_bytes, [*need, *limit])[0], amounts(*in_bytes, [*need, *limit])[1])]
    Limit {
        /// The limit; with its unit unless that is bytes.
        name: &'static str,
        /// The required value.
        need: u64,
        /// The maximum of the adapter.
        limit: u64,
        /// Whether both are in bytes.
        in_bytes: bool,
    },
    /// The total of all allocations would exceed [`crate::ExecutionPolicy::memory_limit_bytes`].
    #[error("too big for the memory limit ({what}): {} needed in all, {} allowed.", sizes([*need, *limit])[0], sizes([*need, *limit])[1])]
    Budget {
        /// The largest allocation and its size.
        what: String,
        /// Their sum, in bytes.
        need: u64,
        /// In bytes.
        limit: u64,
    },
    /// The driver refused an allocation within the limits.
    #[error(
        "the GPU is out of memory ({what}): the driver refused to allocate. Use a smaller scene or picture, or end other programs that use its memory."
    )]
    OutOfMemory {
        /// The allocation or operation that failed.
        what: String,
    },
    /// A software adapter executes kernels with another number of lanes than it reports.
    #[error(
        "the adapter mixes kernels for vectors of different widths ({adapter}): its shader cache has some that were \
         compiled with another LP_NATIVE_VECTOR_WIDTH, and pictures would be wrong. Set MESA_SHADER_CACHE_DIR to a \
         folder of its own for this width."
    )]
    WrongLanes {
        /// The adapter's name.
        adapter: String,
    },
    /// The driver reports an API error, rejects a shader or leaves work undone.
    #[error("internal fault (GPU): {what}.")]
    Internal {
        /// The fault, in the driver's words if available.
        what: String,
    },
}

impl GpuError {
    /// How to install a driver on this system.
    const INSTALL: &str = if cfg!(target_os = "linux") {
        "Install the driver of your GPU, or Mesa's software driver (Debian and Ubuntu: apt-get install \
         libvulkan1 mesa-vulkan-drivers)."
    } else if cfg!(any(target_os = "windows", target_os = "macos")) {
        "Update the driver of your GPU, or the system."
    } else {
        "Install a Vulkan driver, or Mesa's software one."
    };
}

/// The needed and the allowed amount.
fn amounts(in_bytes: bool, amounts: [u64; 2]) -> [String; 2] {
    match in_bytes {
        true => sizes(amounts),
        false => amounts.map(|amount| amount.to_string()),
    }
}

/// An error outside of error scopes.
pub fn stray(error: &wgpu::Error) -> GpuError {
    match error {
        wgpu::Error::OutOfMemory { .. } => GpuError::OutOfMemory {
            what: "a buffer or texture".into(),
        },
        error => GpuError::Internal {
            what: error.to_string(),
        },
    }
}

/// Whether an error outside of error scopes only says that a window found the device busy when it configured its surface. The
/// window draws on with the old surface and tries again.
pub fn is_busy_surface(error: &wgpu::Error) -> bool {
    let text = error.to_string();
    text.contains("Surface::configure") && text.contains("come idle")
}

/// The error of a driver that fails to open the adapter. wgpu reports a lack of memory only in the text.
pub fn no_device(adapter: &str, why: &str) -> GpuError {
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

#[cfg(test)]
mod tests {
    use super::is_busy_surface;

    #[test]
    fn a_surface_that_waits_for_a_busy_device_is_no_fault() {
        let error = |text: &str| wgpu::Error::Validation {
            source: Box::new(std::fmt::Error),
            description: text.to_owned(),
        };
        let busy = "In Surface::configure, Failed to wait for GPU to come idle before reconfiguring the Surface";
        assert!(is_busy_surface(&error(busy)));
        for other in [
            "In Surface::configure, Invalid surface",
            "In Queue::submit, a buffer is destroyed",
        ] {
            assert!(!is_busy_surface(&error(other)), "{other}");
        }
    }
}
