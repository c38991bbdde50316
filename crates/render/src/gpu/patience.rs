//! How long submitted work may take before the device counts as lost.

use super::AdapterReport;
use std::time::Duration;

/// Drivers of GPUs reset one that hangs for seconds, but not all of them report it.
const OF_A_GPU: Duration = Duration::from_secs(30);

/// Software adapters compile kernels and run them on cores that other programs may keep busy, and nothing resets them.
const OF_A_CPU: Duration = Duration::from_secs(3600);

impl AdapterReport {
    /// Time that submitted work may take on this adapter before the device counts as lost: half a minute, and an hour on
    /// software adapters and in browsers, which do not tell these from others but report every loss.
    pub fn patience(&self) -> Duration {
        match self.is_cpu() || cfg!(target_arch = "wasm32") {
            true => OF_A_CPU,
            false => OF_A_GPU,
        }
    }

    /// Whether the adapter is a software renderer.
    pub fn is_cpu(&self) -> bool {
        self.device_type == "cpu"
    }
}
