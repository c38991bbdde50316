//! Open devices, and the scene that was packed last. Renderers share them, and with them all compiled kernels and the BVHs of
//! equal meshes: a second picture of a scene compiles and builds nothing.

use crate::errors::Failure;
use glimray_app::host::Packed;
use glimray_render::gpu::{AdapterChoice, Gpu};
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard, PoisonError};

struct Devices {
    /// The process that opened them.
    process: u32,
    open: Vec<(AdapterChoice, Gpu)>,
    packed: Option<Packed>,
}

/// Bytes of a packed scene beyond which it is not kept.
const MOST_KEPT: usize = 1 << 30;

static DEVICES: Mutex<Devices> = Mutex::new(Devices {
    process: 0,
    open: Vec::new(),
    packed: None,
});

fn devices() -> MutexGuard<'static, Devices> {
    DEVICES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The device on this adapter.
///
/// # Errors
/// There is no such adapter, it cannot be opened, or a device was opened before the process was forked.
pub fn on(choice: &AdapterChoice) -> Result<Gpu, Failure> {
    let mut devices = devices();
    let process = std::process::id();
    if !devices.open.is_empty() && devices.process != process {
        return Err(Failure::Forked);
    }
    devices.process = process;
    devices.open.retain(|(_, gpu)| !gpu.is_lost());
    let found = devices.open.iter().find(|(known, _)| known == choice);
    if let Some((_, gpu)) = found {
        return Ok(gpu.clone());
    }
    let gpu = Gpu::new(choice).map_err(|error| Failure::App(error.into()))?;
    devices.open.push((choice.clone(), gpu.clone()));
    Ok(gpu)
}

/// Keeps the device that a renderer ended with, which has replaced the one it began with if that was lost or too limited.
pub fn keep(choice: &AdapterChoice, gpu: &Gpu) {
    let mut devices = devices();
    if let Some((_, known)) = (devices.open.iter_mut()).find(|(known, _)| known == choice) {
        *known = gpu.clone();
    }
}

/// The scene that was packed last, unless it was very large.
pub fn packed() -> Option<Packed> {
    devices().packed.clone()
}

/// Keeps a packed scene.
pub fn keep_packed(packed: Packed) {
    let bytes: usize = packed.1.parts().iter().map(|part| part.len()).sum();
    devices().packed = Some(packed).filter(|_| bytes <= MOST_KEPT);
}

/// Whether a device is open.
#[pyfunction]
pub fn is_open(py: Python) -> bool {
    // Another thread may be opening one.
    py.detach(|| !devices().open.is_empty())
}

/// Closes all devices: a driver must not be at work when the process ends. After a fork there is nothing to close.
#[pyfunction]
pub fn close(py: Python) {
    py.detach(close_all);
}

fn close_all() {
    let mut devices = devices();
    devices.packed = None;
    let open = std::mem::take(&mut devices.open);
    if devices.process != std::process::id() {
        std::mem::forget(open);
    }
}
