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
//! - `MESA_SHADER_CACHE_DIR` names the folder of compiled kernels: one for each width and processor. Mesa's cache does not
//!   distinguish widths, and would execute code of 256 bits as if it had 512. It distinguishes its own builds.

#[cfg(target_os = "linux")]
use crate::app::folders;
#[cfg(target_os = "linux")]
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

/// Replaces this process by one with the variables that are missing. Returns if there are none, or if the program
/// cannot be executed again. Variables that are set stay as they are, but for a width with which the window would
/// crash, and a folder of kernels, in which those of this width get one of their own.
#[cfg(target_os = "linux")]
pub fn set_environment(opens_window: bool) {
    use std::os::unix::process::CommandExt as _;
    let value = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let has_no_session = value("XDG_RUNTIME_DIR").is_none() && value("NODEVICE_SELECT").is_none();
    let given = value("LP_NATIVE_VECTOR_WIDTH").and_then(|width| width.into_string().ok());
    let width = match given.as_deref() {
        None if !opens_window && has_wide_vectors() => Some("512"),
        Some("512") if opens_window => Some("256"),
        _ => None,
    };
    let wanted = [
        (
            "NODEVICE_SELECT",
            has_no_session.then(|| OsString::from("1")),
        ),
        ("LP_NATIVE_VECTOR_WIDTH", width.map(OsString::from)),
        (
            "MESA_SHADER_CACHE_DIR",
            kernel_folder(
                width.or(given.as_deref()),
                value("MESA_SHADER_CACHE_DIR").map(PathBuf::from),
            ),
        ),
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

/// The folder of kernels for vectors of this width on this processor, inside the one that is set, or else in the cache of the
/// program. `None` if it is set, or cannot be created: Mesa would print a message.
#[cfg(target_os = "linux")]
fn kernel_folder(width: Option<&str>, set: Option<PathBuf>) -> Option<OsString> {
    let width = width.filter(|width| width.bytes().all(|byte| byte.is_ascii_digit()));
    let name = format!("{}-bits-{}", width.unwrap_or("256"), processor());
    if set.as_deref().and_then(Path::file_name) == Some(name.as_ref()) {
        return None;
    }
    let folder = match set {
        Some(set) => set.join(name),
        None => folders::platform_cache()?.join("mesa").join(name),
    };
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder.into())
}

/// A name for the kind of this processor, from its model and its instruction sets.
#[cfg(target_os = "linux")]
fn processor() -> String {
    use std::io::Read as _;
    let mut text = Vec::new();
    if let Ok(file) = std::fs::File::open("/proc/cpuinfo") {
        // The first of its processors.
        let _ = file.take(8192).read_to_end(&mut text);
    }
    let text = String::from_utf8_lossy(&text);
    let kinds = ["model name", "flags", "CPU part", "Features"];
    let lines = text.lines().take_while(|line| !line.is_empty());
    let lines = lines.filter(|line| kinds.iter().any(|kind| line.starts_with(kind)));
    let sum = xxhash_rust::xxh3::xxh3_64(lines.collect::<String>().as_bytes());
    format!("{sum:016x}")
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
