//! A pool of devices for tests: opening one and compiling its kernels costs more than most pictures.

use glimray::gpu::{Gpu, GpuError};
use std::cell::RefCell;
use std::sync::{Mutex, PoisonError};

/// Devices of one kind. A test owns one until its thread ends.
pub struct Devices {
    open: fn() -> Result<Gpu, GpuError>,
    idle: Mutex<Vec<Gpu>>,
}

/// The device of a thread, returned to the pool when it ends.
struct Leases(Vec<(&'static Devices, Gpu)>);

thread_local! {
    static LEASES: RefCell<Leases> = const { RefCell::new(Leases(Vec::new())) };
}

impl Drop for Leases {
    fn drop(&mut self) {
        for (devices, gpu) in self.0.drain(..).filter(|(_, gpu)| !gpu.is_lost()) {
            let idle = devices.idle.lock();
            idle.unwrap_or_else(PoisonError::into_inner).push(gpu);
        }
    }
}

impl Devices {
    pub const fn new(open: fn() -> Result<Gpu, GpuError>) -> Self {
        Self {
            open,
            idle: Mutex::new(Vec::new()),
        }
    }

    /// The device of this thread.
    pub fn lease(&'static self) -> Gpu {
        LEASES.with_borrow_mut(|Leases(leases)| {
            leases.retain(|(_, gpu)| !gpu.is_lost());
            let is_ours = |(of, _): &&(&'static Self, Gpu)| std::ptr::eq(*of, self);
            if let Some((_, gpu)) = leases.iter().find(is_ours) {
                return gpu.clone();
            }
            let idle = self
                .idle
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .pop();
            let gpu = idle.unwrap_or_else(|| (self.open)().unwrap_or_else(|e| panic!("{e}")));
            leases.push((self, gpu.clone()));
            gpu
        })
    }
}
