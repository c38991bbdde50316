//! Environment variables of Mesa, whose drivers read them when they are loaded. A running process cannot safely change
//! its own environment, so the program is executed again with them.
//!
//! - `NODEVICE_SELECT` switches the device-select layer off. On a machine without a desktop session the layer asks
//!   libwayland for a display, and libwayland prints `error: XDG_RUNTIME_DIR is invalid or not set in the environment.`
//!   to standard error, where scripts look for glimray's errors. The layer has nothing to select there. This can be
//!   removed once the layer is silent.
//! - `LP_NATIVE_VECTOR_WIDTH` is the width in bits of the vectors in which lavapipe executes shaders. It takes 256
//!   unless told otherwise, also where the processor has 512 (AVX-512).

/// Replaces this process by one with the variables that are missing. Returns if there are none, or if the program
/// cannot be executed again. Variables that are set stay as they are.
#[cfg(target_os = "linux")]
pub fn set_environment() {
    use std::os::unix::process::CommandExt as _;
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let wanted = [
        (
            "NODEVICE_SELECT",
            "1",
            !is_set("XDG_RUNTIME_DIR") && !is_set("NODEVICE_SELECT"),
        ),
        (
            "LP_NATIVE_VECTOR_WIDTH",
            "512",
            has_wide_vectors() && !is_set("LP_NATIVE_VECTOR_WIDTH"),
        ),
    ];
    let missing: Vec<_> = (wanted.into_iter())
        .filter_map(|(name, value, is_missing)| is_missing.then_some((name, value)))
        .collect();
    let Ok(program) = std::env::current_exe() else {
        return;
    };
    if missing.is_empty() {
        return;
    }
    let mut arguments = std::env::args_os();
    let mut again = std::process::Command::new(program);
    if let Some(name) = arguments.next() {
        again.arg0(name);
    }
    // Returns only on failure. The message, or the lower speed, is then acceptable.
    let _ = again.args(arguments).envs(missing).exec();
}

/// Other systems have no such layer, and no lavapipe.
#[cfg(not(target_os = "linux"))]
pub fn set_environment() {}

/// Whether the processor has vectors of 512 bits, with all instructions that Mesa's compiler uses for them.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn has_wide_vectors() -> bool {
    std::arch::is_x86_feature_detected!("avx512f")
        && std::arch::is_x86_feature_detected!("avx512bw")
        && std::arch::is_x86_feature_detected!("avx512dq")
        && std::arch::is_x86_feature_detected!("avx512vl")
}

#[cfg(all(target_os = "linux", not(target_arch = "x86_64")))]
fn has_wide_vectors() -> bool {
    false
}
