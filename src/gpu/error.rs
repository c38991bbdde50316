//! What can go wrong between here and the GPU.

/// An error of the device or its driver.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    #[error(
        "no usable GPU (tried {tried}): no driver was found. Install a Vulkan driver, or Mesa's software one (Debian and Ubuntu: apt-get install libvulkan1 mesa-vulkan-drivers)."
    )]
    NoAdapter { tried: String },
    #[error(
        "no such adapter (--adapter {wanted}): there are {present}. Name one of them, or part of its name."
    )]
    NoSuchAdapter { wanted: String, present: String },
    #[error("the adapter cannot be opened ({adapter}): {why}. Try another with --adapter.")]
    NoDevice { adapter: String, why: String },
    #[error("the GPU was lost (driver reset or time-out): its work is gone. Try again.")]
    Lost,
    #[error(
        "the GPU failed {count} times (driver resets): it cannot finish this picture. Try another adapter with --adapter, or update the driver."
    )]
    KeptFailing { count: u32 },
    #[error(
        "too big for this adapter ({name}): {need} needed, {limit} allowed. {}",
        Self::ADVICE
    )]
    Limit {
        name: &'static str,
        need: u64,
        limit: u64,
    },
    #[error(
        "too big for the memory limit ({what}): {need} bytes needed in all, {limit} allowed. {}",
        Self::ADVICE
    )]
    Budget { what: String, need: u64, limit: u64 },
    #[error(
        "the GPU is out of memory ({what}): the driver refused to allocate. {}",
        Self::ADVICE
    )]
    OutOfMemory { what: String },
    #[error("internal fault (GPU): {what}. Please report it with the output of `glimray doctor`.")]
    Internal { what: String },
}

impl GpuError {
    const ADVICE: &str =
        "Use a smaller scene or picture, or raise --memory-limit if memory allows.";

    /// The process's exit code for this error: 5 no usable adapter, 6 kept failing, 7 too big,
    /// 1 our own fault.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::NoAdapter { .. } | Self::NoSuchAdapter { .. } | Self::NoDevice { .. } => 5,
            Self::Lost | Self::KeptFailing { .. } => 6,
            Self::Limit { .. } | Self::Budget { .. } | Self::OutOfMemory { .. } => 7,
            Self::Internal { .. } => 1,
        }
    }
}
