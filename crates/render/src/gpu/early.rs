//! Modules that are made before a device is open.

use super::{Gpu, Overrides, guard, shader::ModuleKey};
use glimray_shaders::{AdapterKind, Kernel, Variant};
use std::{
    sync::PoisonError,
    thread::{self, JoinHandle},
};
use wgpu::naga::Module;

/// The module of a pipeline that will be needed, made by a thread while the device is being opened.
pub struct EarlyModule {
    key: ModuleKey,
    /// `None` if it panicked.
    thread: JoinHandle<Option<Result<Module, String>>>,
}

impl EarlyModule {
    /// Starts to make a module for lavapipe; opening a GPU takes longer than what this would save there. `None` if the system
    /// has no thread left.
    pub(crate) fn start(kernel: Kernel, variant: Variant, overrides: Overrides) -> Option<Self> {
        let key = ModuleKey {
            kernel: kernel.name,
            variant,
            overrides: overrides.clone(),
        };
        // A panic must not end the program: the adapter may turn out to be another.
        let make =
            move || guard::catch(|| kernel.module(variant, &overrides, AdapterKind::Lavapipe)).ok();
        let thread = thread::Builder::new().spawn(make).ok()?;
        Some(Self { key, thread })
    }
}

impl Gpu {
    /// Gives the device a module, used if a pipeline needs just that; only lavapipe keeps it.
    pub fn with_early_module(self, module: Option<EarlyModule>) -> Self {
        let module = module.filter(|_| self.adapter_kind() == AdapterKind::Lavapipe);
        *self.early.lock().unwrap_or_else(PoisonError::into_inner) = module;
        self
    }

    /// Whether a module that was made early has not been used.
    pub fn has_early_module(&self) -> bool {
        let early = self.early.lock().unwrap_or_else(PoisonError::into_inner);
        early.is_some()
    }

    /// Takes the module with this key, if it is made early. Waits for it.
    pub(super) fn take_early_module(&self, key: &ModuleKey) -> Option<Result<Module, String>> {
        let mut early = self.early.lock().unwrap_or_else(PoisonError::into_inner);
        let module = early.take_if(|module| module.key == *key)?;
        drop(early);
        module.thread.join().ok().flatten()
    }
}
