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
//! - `MESA_SHADER_CACHE_DISABLE` is set where that folder cannot be used. Mesa maps the index of its cache into memory, a
//!   file with holes, and on a full disk it ends with SIGBUS as soon as it writes into one: so the index is given its
//!   space before.

#[cfg(target_os = "linux")]
use glimray_app::{console, folders};
#[cfg(target_os = "linux")]
use glimray_io::output;
#[cfg(target_os = "linux")]
use std::{
    ffi::OsString,
    fs, io,
    path::{Path, PathBuf},
};

/// Size in bytes of the index: a number, and 65,536 keys of 20 bytes (`disk_cache_mmap_cache_index` in Mesa).
#[cfg(target_os = "linux")]
const INDEX_SIZE: u64 = 8 + (20 << 16);

/// The variables that are missing. Variables that are set stay as they are, but for a width with which the window would
/// crash, and a folder of kernels, in which those of this width get one of their own. Warns if there is no space for them.
#[cfg(target_os = "linux")]
pub fn missing(opens_window: bool) -> Vec<(&'static str, OsString)> {
    let value = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let has_no_session = value("XDG_RUNTIME_DIR").is_none() && value("NODEVICE_SELECT").is_none();
    let given = value("LP_NATIVE_VECTOR_WIDTH").and_then(|width| width.into_string().ok());
    let width = match given.as_deref() {
        None if !opens_window && has_wide_vectors() => Some("512"),
        Some("512") if opens_window => Some("256"),
        _ => None,
    };
    let uses_cache = value("MESA_SHADER_CACHE_DISABLE").is_none_or(|value| value != "true");
    let set_folder = value("MESA_SHADER_CACHE_DIR").map(PathBuf::from);
    let folder = match uses_cache {
        true => kernel_folder(width.or(given.as_deref()), set_folder.as_deref()),
        false => None,
    };
    let has_no_space = (folder.as_deref()).is_some_and(|folder| !can_hold_kernels(folder));
    let wanted = [
        (
            "NODEVICE_SELECT",
            has_no_session.then(|| OsString::from("1")),
        ),
        ("LP_NATIVE_VECTOR_WIDTH", width.map(OsString::from)),
        (
            "MESA_SHADER_CACHE_DIR",
            folder
                .filter(|folder| set_folder.as_ref() != Some(folder))
                .map(OsString::from),
        ),
        (
            "MESA_SHADER_CACHE_DISABLE",
            has_no_space.then(|| OsString::from("true")),
        ),
    ];
    (wanted.into_iter())
        .filter_map(|(name, value)| Some((name, value?)))
        .collect()
}

/// Replaces this process by one with the variables that are [`missing`]. Returns if there are none, or if the program
/// cannot be executed again.
#[cfg(target_os = "linux")]
pub fn set_environment(opens_window: bool) {
    use std::os::unix::process::CommandExt as _;
    let missing = missing(opens_window);
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
/// program. `None` if the platform has none.
#[cfg(target_os = "linux")]
fn kernel_folder(width: Option<&str>, set: Option<&Path>) -> Option<PathBuf> {
    let width = width.filter(|width| width.bytes().all(|byte| byte.is_ascii_digit()));
    let name = format!("{}-bits-{}", width.unwrap_or("256"), processor());
    match set {
        Some(set) if set.file_name() == Some(name.as_ref()) => Some(set.to_owned()),
        Some(set) => Some(set.join(name)),
        None => Some(folders::cache()?.join("mesa").join(name)),
    }
}

/// Whether Mesa can keep kernels in `folder`. Says so if the disk is too full for them. A folder that cannot be created is no
/// reason for a message.
#[cfg(target_os = "linux")]
fn can_hold_kernels(folder: &Path) -> bool {
    use io::ErrorKind::{QuotaExceeded, StorageFull};
    match reserve_index(folder) {
        Ok(()) => true,
        Err(error) => {
            if [QuotaExceeded, StorageFull].contains(&error.kind()) {
                console::warning(format!(
                    "no shader cache ({}): {}. Free some space: kernels are compiled anew by each run until then.",
                    folder.display(),
                    output::reason(&error)
                ));
            }
            false
        }
    }
}

/// Gives the index of Mesa's cache in `folder` its space on the disk, with its contents unchanged.
#[cfg(target_os = "linux")]
fn reserve_index(folder: &Path) -> io::Result<()> {
    use rustix::fs::{FallocateFlags, fallocate};
    use rustix::io::Errno;
    let folder = folder.join("mesa_shader_cache");
    fs::create_dir_all(&folder)?;
    let mut options = fs::File::options();
    let index =
        (options.read(true).write(true).create(true).truncate(false)).open(folder.join("index"))?;
    match fallocate(&index, FallocateFlags::empty(), 0, INDEX_SIZE) {
        Err(error @ (Errno::NOSPC | Errno::DQUOT)) => Err(error.into()),
        // Some network file systems reserve nothing. Beyond a limit on sizes Mesa does without a cache by itself.
        _ => Ok(()),
    }
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

/// None, as other systems have no lavapipe.
#[cfg(not(target_os = "linux"))]
pub fn missing(_opens_window: bool) -> Vec<(&'static str, std::ffi::OsString)> {
    Vec::new()
}

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
