//! The limit on the memory of this process (`ulimit -v`, `ulimit -d`), where Linux has one.
//!
//! An allocation that fails ends a Rust program on the spot, and drivers crash. So steps that take much
//! ask beforehand, by estimates, and [`exit_as_too_big`] gives what slips through the right exit code.
//! Where there is no such limit, nothing is known beforehand: the system ends a process that takes too
//! much, and that cannot be told from here.

use crate::app::error::AppError;
use crate::scene::Scene;
use std::fs;
use std::path::Path;

const MIB: u64 = 1 << 20;

/// What importers take for a byte of geometry.
const BYTES_PER_FILE_BYTE: u64 = 5;

/// What packing, the trees and the driver take together for a triangle of a mesh, a texel and a pixel.
const BYTES_PER_TRIANGLE: u64 = 300;
const BYTES_PER_TEXEL: u64 = 24;
const BYTES_PER_PIXEL: u64 = 100;

/// What a driver reserves: for itself, and for each of its threads, of which it has one for a core, up to
/// a number of them.
const DRIVER_BYTES: u64 = 768 * MIB;
const THREAD_BYTES: u64 = 128 * MIB;
const MOST_THREADS: usize = 16;

/// A process with less room than this that fails has failed for want of it.
const SHORTAGE: u64 = 512 * MIB;

/// Bytes that the process may still take; `None` where there is no limit, or none that is known.
fn room() -> Option<u64> {
    let limits = fs::read_to_string("/proc/self/limits").ok()?;
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let room = |limit: &str, used: &str| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
        let used = status.lines().find_map(|line| line.strip_prefix(used))?;
        let used: u64 = used.split_whitespace().next()?.parse().ok()?;
        Some(limit.saturating_sub(used << 10))
    };
    let rooms = [
        room("Max address space", "VmSize:"),
        room("Max data size", "VmData:"),
    ];
    rooms.into_iter().flatten().min()
}

/// Refuses `what` (`place`) if it takes more bytes than there are.
fn require(what: &str, place: &str, need: u64) -> Result<(), AppError> {
    match room() {
        Some(room) if room < need => Err(AppError::TooBig(format!(
            "too big for the memory ({place}): {what} takes about {} MiB, and the limit (`ulimit -v`) \
             leaves {}. Raise the limit, or use a smaller scene or picture.",
            need / MIB,
            room / MIB
        ))),
        _ => Ok(()),
    }
}

/// Refuses to read a model that is too large for the limit.
///
/// # Errors
/// [`AppError::TooBig`].
pub fn check_file(path: &Path) -> Result<(), AppError> {
    // Whoever reads it says what is wrong with it.
    let length = fs::metadata(path).map_or(0, |found| found.len());
    let need = length.saturating_mul(BYTES_PER_FILE_BYTE);
    require("reading it", &path.display().to_string(), need)
}

/// Refuses to render a scene in so many pixels that is too large for the limit.
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
        + THREAD_BYTES * cores.min(MOST_THREADS) as u64
        + BYTES_PER_TRIANGLE * triangles as u64
        + BYTES_PER_TEXEL * texels as u64
        + BYTES_PER_PIXEL.saturating_mul(pixels);
    require("rendering it", place, need)
}

/// Whether the limit is the likely cause of a failure.
pub fn is_short() -> bool {
    room().is_some_and(|room| room < SHORTAGE)
}

/// Where there is a limit, makes a failed allocation end the program with exit code 7: Rust raises the
/// signal SIGABRT for it, after a line of its own.
#[cfg(unix)]
pub fn exit_as_too_big() {
    if room().is_some() {
        let always = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
        let abort = signal_hook::consts::SIGABRT;
        // Where there is no handler, the program is no worse off than before.
        let _ = signal_hook::flag::register_conditional_shutdown(abort, 7, always);
    }
}

/// Other systems have no such signal.
#[cfg(not(unix))]
pub fn exit_as_too_big() {}
