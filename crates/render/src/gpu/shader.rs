//! The linked kernels, and the cache of their pipelines.

use super::{Gpu, GpuError, bound::bound_loops, inline::inline_functions, specialize::specialize};
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

/// The kinds of adapters for which modules differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// A software adapter for Vulkan, which is taken for Mesa's.
    Lavapipe,
    /// A GPU.
    Gpu,
    /// Another software adapter, or a virtual one, behind which there may be lavapipe.
    Other,
}

/// Values for overrides of `bindings.wesl`, by their names.
pub type Overrides = Vec<(&'static str, f64)>;

/// A pipeline, and whether it was compiled just now.
pub(crate) struct Compiled {
    pub pipeline: wgpu::ComputePipeline,
    pub is_new: bool,
}

/// A compute kernel: linked WGSL from `shaders/linked`, and its entry point.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// The name of the kernel, its entry point and its file in `shaders/kernels/`; `explain` is `whitted` with
    /// recording.
    pub name: &'static str,
    /// The kernel's variants, and their sources as `build.rs` compressed them.
    compressed: &'static [(Variant, &'static [u8])],
}

/// A variant of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Geometry, or what the denoiser filters, is fetched from storage images.
    Image,
    /// Geometry is fetched from buffers, what the denoiser filters from textures.
    Buffer,
    /// As `Image`, and the lanes of a subgroup trace their rays together: see [`Gpu::traces_packets`].
    Packet,
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $constant:ident $name:literal $($variant:ident $file:literal),*;)*) => {
        $($(#[$doc])* pub const $constant: Kernel = Kernel {
            name: $name,
            compressed: &[$((
                Variant::$variant,
                include_bytes!(concat!(env!("OUT_DIR"), "/", $name, "_", $file, ".deflate")),
            )),*],
        };)*
        /// All kernels.
        pub const ALL: &[Kernel] = &[$(Self::$constant),*];
    };
}

impl Kernel {
    kernels! {
        /// Adds samples of [`crate::render::Integrator::Lecture`] to the film.
        LECTURE "lecture" Image "image", Buffer "buffer";
        /// Adds samples of [`crate::render::Integrator::Whitted`] to the film.
        WHITTED "whitted" Image "image", Buffer "buffer", Packet "packet";
        /// Adds samples of [`crate::render::Integrator::Path`] to the film.
        PATH_TRACE "path_trace" Image "image", Buffer "buffer";
        /// Adds samples of the other integrators to the film.
        DEBUG_VIEW "debug_view" Image "image", Buffer "buffer";
        /// Records all rays of single samples of [`crate::render::Integrator::Whitted`].
        EXPLAIN "explain" Image "image", Buffer "buffer";
        /// Records all rays of single samples of [`crate::render::Integrator::Path`].
        EXPLAIN_PATH "explain_path" Image "image", Buffer "buffer";
        /// Develops the film to a picture.
        DEVELOP "develop" Buffer "buffer";
        /// Develops the film to a texture for display.
        SHOW "show" Buffer "buffer";
        /// Writes what the denoiser needs from the film to textures.
        FILM_FEATURES "film_features" Buffer "buffer";
        /// Divides a picture by its albedo, for the denoiser.
        DEMODULATE "demodulate" Buffer "buffer";
        /// A pass of the denoiser's filter.
        DENOISE "denoise" Image "image", Buffer "buffer";
        /// Traces the rays of a [`crate::render::RayQuery`].
        TRACE_RAYS "trace_rays" Image "image", Buffer "buffer", Packet "packet";
    }

    /// The module of a variant, specialised by overrides of `bindings.wesl`, by name. The error names a missing
    /// variant or an unknown override, or is naga's with the lines of the linked source.
    pub fn specialized(
        &self,
        variant: Variant,
        overrides: &[(&str, f64)],
    ) -> Result<naga::Module, String> {
        match self.source(variant) {
            Some(source) => specialize(&source, overrides),
            None => Err(format!("{} has no variant {variant:?}", self.name)),
        }
    }

    /// The module of a variant for a kind of adapter. The error is that of [`Self::specialized`].
    pub(super) fn module(
        &self,
        variant: Variant,
        overrides: &[(&str, f64)],
        target: Target,
    ) -> Result<naga::Module, String> {
        let by_select = ("EXTREMES_BY_SELECT", f64::from(target != Target::Gpu));
        let mut module = self.specialized(variant, &[overrides, &[by_select]].concat())?;
        // Other drivers have not been measured.
        if target == Target::Lavapipe {
            inline_functions(&mut module);
        }
        if target != Target::Gpu {
            bound_loops(&mut module);
        }
        Ok(module)
    }

    /// Whether it has this variant.
    pub fn has(&self, variant: Variant) -> bool {
        self.variants().any(|known| known == variant)
    }

    /// The kernel's variants.
    pub fn variants(&self) -> impl Iterator<Item = Variant> {
        self.compressed.iter().map(|(variant, _)| *variant)
    }

    /// The linked WGSL of a variant, if it has this variant.
    pub fn source(&self, variant: Variant) -> Option<String> {
        let (_, compressed) = (self.compressed.iter()).find(|(known, _)| *known == variant)?;
        let bytes = miniz_oxide::inflate::decompress_to_vec(compressed).ok()?;
        String::from_utf8(bytes).ok()
    }
}

impl Gpu {
    pub(super) fn target(&self) -> Target {
        match (
            self.report.device_type.as_str(),
            self.report.backend.as_str(),
        ) {
            ("discrete_gpu" | "integrated_gpu", _) => Target::Gpu,
            ("cpu", "vulkan") => Target::Lavapipe,
            _ => Target::Other,
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
        if variant != Variant::Buffer {
            self.prove_lanes()?;
        }
        let module = match self.take_early_module(wanted) {
            Some(module) => module,
            None => kernel.module(variant, &wanted.overrides, self.target()),
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
