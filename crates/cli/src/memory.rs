//! The memory limit of this process on Linux (`ulimit -v`, `ulimit -d`).
//!
//! A failed allocation aborts a Rust program, and drivers crash. Large steps therefore check an estimate
//! beforehand, and [`exit_as_too_big`] gives any remaining failure the right exit code. Without such a limit
//! nothing can be checked: the system kills a process that uses too much memory.

use glimray_app::error::AppError;
use glimray_scene::Scene;
use glimray_scene::bytes::sizes;
use std::fs;
use std::path::Path;

const MIB: u64 = 1 << 20;

/// Memory that importers need per byte of a geometry file.
const BYTES_PER_FILE_BYTE: u64 = 5;

/// Memory for packing, BVHs and the driver per mesh triangle, texel and pixel.
const BYTES_PER_TRIANGLE: u64 = 300;
const BYTES_PER_TEXEL: u64 = 16;
const BYTES_PER_PIXEL: u64 = 100;

/// Memory that a driver reserves: a base amount, and an amount per thread. It starts one thread per core, up
/// to a maximum.
const DRIVER_BYTES: u64 = 768 * MIB;
const THREAD_BYTES: u64 = 128 * MIB;
const MAX_THREADS: usize = 16;

/// A failure with less memory left than this is taken to be caused by the limit.
const SHORTAGE: u64 = 512 * MIB;

/// Bytes that the process may still allocate; `None` if there is no known limit.
fn available() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let left = |limit: &str, used: &str| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
        let used = status.lines().find_map(|line| line.strip_prefix(used))?;
        let used: u64 = used.split_whitespace().next()?.parse().ok()?;
        Some(limit.saturating_sub(used << 10))
    };
    let limits = [
        left("Max address space", "VmSize:"),
        left("Max data size", "VmData:"),
    ];
    limits.into_iter().flatten().min()
}

/// Whether there is a known limit.
pub fn is_limited() -> bool {
    available().is_some()
}

/// Refuses `what` (at `place`) if it needs more bytes than are available.
fn require(what: &str, place: &str, need: u64) -> Result<(), AppError> {
    match available() {
        Some(available) if available < need => {
            let [need, available] = sizes([need, available]);
            Err(AppError::TooBig(format!(
                "too big for the memory ({place}): {what} takes about {need}, and the limit (`ulimit -v`) \
                 leaves {available}. Raise the limit, or use a smaller scene or picture."
            )))
        }
        _ => Ok(()),
    }
}

/// Refuses to read a model that needs more memory than the limit allows.
///
/// # Errors
/// [`AppError::TooBig`].
pub fn check_file(path: &Path) -> Result<(), AppError> {
    // A file that cannot be read is reported when it is opened.
    let length = fs::metadata(path).map_or(0, |found| found.len());
    let need = length.saturating_mul(BYTES_PER_FILE_BYTE);
    require("reading it", &path.display().to_string(), need)
}

/// Refuses to render a scene at a size that needs more memory than the limit allows.
///
/// # Errors
/// [`AppError::TooBig`].
pub fn check_scene(
    scene: &Scene,
    place: &str,
    (width, height): (u32, u32),
) -> Result<(), AppError> {
    let cores = std::thread::available_parallelism().map_or(1, |count| count.get());
    let triangles: usize = (scene.meshes.iter()).map(|mesh| mesh.triangles.len()).sum();
    let texels: usize = (scene.pictures.iter())
        .map(|picture| picture.texels.len())
        .sum();
    let pixels = u64::from(width) * u64::from(height);
    let need = DRIVER_BYTES
        + THREAD_BYTES * cores.min(MAX_THREADS) as u64
        + BYTES_PER_TRIANGLE * triangles as u64
        + BYTES_PER_TEXEL * texels as u64
        + BYTES_PER_PIXEL.saturating_mul(pixels);
    require("rendering it", place, need)
}

/// Whether the memory limit is the likely cause of a failure.
pub fn is_short() -> bool {
    available().is_some_and(|available| available < SHORTAGE)
}

/// If there is a limit, makes a failed allocation end the program with exit code 7. Rust prints a line of
/// its own and raises SIGABRT in that case.
#[cfg(unix)]
pub fn exit_as_too_big() {
    if available().is_some() {
        let always = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
        let abort = signal_hook::consts::SIGABRT;
        // If it cannot be installed, the default behaviour remains.
        let _ = signal_hook::flag::register_conditional_shutdown(abort, 7, always);
    }
}

/// Other systems have no such signal.
#[cfg(not(unix))]
pub fn exit_as_too_big() {}
