//! Environment variables of Mesa, whose drivers read them when they are loaded. A running process cannot safely change
//! its own environment, so the program is executed again with them.
//!
//! - `NODEVICE_SELECT` switches the device-select layer off. On a machine without a desktop session the layer asks
//!   libwayland for a display, and libwayland prints `error: XDG_RUNTIME_DIR is invalid or not set in the environment.`
//!   to standard error, where scripts look for glimray's errors. The layer has nothing to select there. This can be
//!   removed once the layer is silent.
//! - `LP_NATIVE_VECTOR_WIDTH` is the width in bits of the vectors in which lavapipe executes shaders. It takes 256
//!   unless told otherwise, also where the processor has 512 (AVX-512). With 512, Mesa 22.3 crashes as soon as it
//!   draws: so compute kernels have 512, and the window 256.
//! - `MESA_SHADER_CACHE_DIR` names a folder of their own for kernels of 512 bits. Mesa's cache does not distinguish the
//!   widths, so a kernel that the window has compiled would stay at 256.

#[cfg(target_os = "linux")]
use crate::app::folders;
#[cfg(target_os = "linux")]
use std::ffi::OsString;

/// Replaces this process by one with the variables that are missing. Returns if there are none, or if the program
/// cannot be executed again. Variables that are set stay as they are, but for a width with which the window would
/// crash.
#[cfg(target_os = "linux")]
pub fn set_environment(opens_window: bool) {
    use std::os::unix::process::CommandExt as _;
    let value = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
    let has_no_session = value("XDG_RUNTIME_DIR").is_none() && value("NODEVICE_SELECT").is_none();
    let width = match value("LP_NATIVE_VECTOR_WIDTH").as_deref() {
        None if !opens_window && has_wide_vectors() => Some("512"),
        Some("512") if opens_window => Some("256"),
        _ => None,
    };
    let cache = match value("MESA_SHADER_CACHE_DIR") {
        None if width == Some("512") => wide_cache(),
        _ => None,
    };
    let wanted = [
        (
            "NODEVICE_SELECT",
            has_no_session.then(|| OsString::from("1")),
        ),
        ("LP_NATIVE_VECTOR_WIDTH", width.map(OsString::from)),
        ("MESA_SHADER_CACHE_DIR", cache),
    ];
    let missing: Vec<_> = (wanted.into_iter())
        .filter_map(|(name, value)| Some((name, value?)))
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

/// The folder of kernels for vectors of 512 bits. Mesa would print a message if it could not be created; without it the
/// widths share Mesa's own folder.
#[cfg(target_os = "linux")]
fn wide_cache() -> Option<OsString> {
    let folder = folders::platform_cache()?.join("mesa-512-bits");
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.into())
}

/// Other systems have no such layer, and no lavapipe.
#[cfg(not(target_os = "linux"))]
pub fn set_environment(_opens_window: bool) {}

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
