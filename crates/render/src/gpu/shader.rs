//! The cache of pipelines.

use super::{Gpu, GpuError};
use glimray_shaders::{AdapterKind, Kernel, Variant};
use std::{borrow::Cow, collections::VecDeque};

/// Maximum number of cached pipelines of a device: each may be a megabyte of machine code.
const MAX_PIPELINES: usize = 64;

/// Pipelines by their key, the last used first.
#[derive(Default)]
pub(super) struct Pipelines(VecDeque<(ModuleKey, wgpu::ComputePipeline)>);

impl Pipelines {
    /// The pipeline with this key, which becomes the last used.
    fn get(&mut self, key: &ModuleKey) -> Option<wgpu::ComputePipeline> {
        let place = self.0.iter().position(|(known, _)| known == key)?;
        let (key, pipeline) = self.0.remove(place)?;
        self.0.push_front((key, pipeline.clone()));
        Some(pipeline)
    }

    /// Adds a pipeline, and drops the one that was not used for longest if there are too many.
    fn add(&mut self, key: ModuleKey, pipeline: wgpu::ComputePipeline) {
        self.0.truncate(MAX_PIPELINES - 1);
        self.0.push_front((key, pipeline));
    }
}

/// The inputs of a module. They are the key of a pipeline too, whose bind group layouts follow from them.
#[derive(PartialEq)]
pub(super) struct ModuleKey {
    pub kernel: &'static str,
    pub variant: Variant,
    pub overrides: Overrides,
}

/// Values for overrides of `bindings.wesl`, by their names.
pub type Overrides = Vec<(&'static str, f64)>;

/// A pipeline, and whether it was compiled just now.
pub(crate) struct Compiled {
    pub pipeline: wgpu::ComputePipeline,
    pub is_new: bool,
}

impl Gpu {
    pub(super) fn adapter_kind(&self) -> AdapterKind {
        match (
            self.report.device_type.as_str(),
            self.report.backend.as_str(),
        ) {
            ("discrete_gpu" | "integrated_gpu", _) => AdapterKind::Gpu,
            ("cpu", "vulkan") => AdapterKind::Lavapipe,
            _ => AdapterKind::Other,
        }
    }

    /// A pipeline of a kernel, specialised by `overrides`, for these bind group layouts; compiled unless it is
    /// cached. A shader that the driver rejects is an internal error: it contains the driver's message, and the
    /// linked source is written to the folder for temporary files.
    pub(crate) fn pipeline(
        &self,
        kernel: &Kernel,
        variant: Variant,
        groups: &[Option<&wgpu::BindGroupLayout>],
        overrides: Overrides,
    ) -> Result<Compiled, GpuError> {
        let wanted = ModuleKey {
            kernel: kernel.name,
            variant,
            overrides,
        };
        if let Ok(mut kept) = self.pipelines.lock()
            && let Some(pipeline) = kept.get(&wanted)
        {
            let is_new = false;
            return Ok(Compiled { pipeline, is_new });
        }
        if let Some(report) = &self.on_compilation {
            report();
        }
        let pipeline = self.compile(kernel, groups, &wanted)?;
        if let Ok(mut kept) = self.pipelines.lock() {
            kept.add(wanted, pipeline.clone());
        }
        let is_new = true;
        Ok(Compiled { pipeline, is_new })
    }

    fn compile(
        &self,
        kernel: &Kernel,
        groups: &[Option<&wgpu::BindGroupLayout>],
        wanted: &ModuleKey,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let (name, variant) = (kernel.name, wanted.variant);
        let refused = |what: String| GpuError::Internal {
            what: with_dump(name, &kernel.source(variant).unwrap_or_default(), &what),
        };
        #[cfg(not(target_arch = "wasm32"))]
        if variant != Variant::Buffer {
            self.prove_lanes()?;
        }
        let module = match self.take_early_module(wanted) {
            Some(module) => module,
            None => kernel.module(variant, &wanted.overrides, self.adapter_kind()),
        };
        let module = module.map_err(refused)?;
        let made = self.scoped(name, || {
            let layout = self
                .device
                .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: Some(name),
                    bind_group_layouts: groups,
                    immediate_size: 0,
                });
            let module = self.shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(name),
                source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
            });
            self.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(name),
                    layout: Some(&layout),
                    module: &module,
                    entry_point: None,
                    compilation_options: wgpu::PipelineCompilationOptions {
                        // Kernels write workgroup memory before they read it.
                        zero_initialize_workgroup_memory: false,
                        ..Default::default()
                    },
                    cache: None,
                })
        });
        made.map_err(|error| match error {
            GpuError::Internal { what } => refused(what),
            other => other,
        })
    }
}

/// An error message about a kernel, with the path of a dump of its linked source. There are no files in a
/// browser.
fn with_dump(name: &str, source: &str, what: &str) -> String {
    if cfg!(target_arch = "wasm32") {
        return what.to_owned();
    }
    let dump = std::env::temp_dir().join(format!("glimray-{name}.wgsl"));
    match std::fs::write(&dump, source) {
        Ok(()) => format!("{what} (linked shader: {})", dump.display()),
        Err(_) => what.to_owned(),
    }
}
