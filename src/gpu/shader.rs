//! The linked kernels and the pipelines made of them.

use super::{Gpu, GpuError};
use std::collections::VecDeque;

/// How many pipelines of a device are kept: each may be a megabyte of machine code.
const MOST_PIPELINES: usize = 64;

/// Pipelines by what they are made of, the newest first.
#[derive(Default)]
pub(super) struct Pipelines(VecDeque<(Ingredients, wgpu::ComputePipeline)>);

/// What a pipeline is made of. The layout is not among it: it follows from the source.
#[derive(PartialEq)]
struct Ingredients {
    name: String,
    source: &'static str,
    overrides: Vec<(String, f64)>,
}

/// A compute kernel: WGSL linked by `build.rs`, and its entry point.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// Also the entry point's, and its file's in `shaders/kernels/`; `explain` is `whitted` that keeps
    /// records.
    pub name: &'static str,
    /// Its variants, by name: geometry is read from images or from buffers, and those called moving can
    /// place instances and move while the shutter is open. The others are shorter, which drivers
    /// compile sooner.
    pub sources: [(&'static str, &'static str); 4],
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $constant:ident $name:literal)*) => {
        $($(#[$doc])* pub const $constant: Kernel = Kernel {
            name: $name,
            sources: [
                ("image", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_image.wgsl"))),
                ("buffer", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_buffer.wgsl"))),
                ("moving_image", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_moving_image.wgsl"))),
                ("moving_buffer", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_moving_buffer.wgsl"))),
            ],
        };)*
        /// All kernels.
        pub const ALL: &[Kernel] = &[$(Self::$constant),*];
    };
}

impl Kernel {
    kernels! {
        /// Adds samples of [`crate::render::Integrator::Whitted`] to the film.
        WHITTED "whitted"
        /// Adds samples of the other integrators to the film.
        DEBUG_VIEW "debug_view"
        /// Records all rays of single samples of [`crate::render::Integrator::Whitted`].
        EXPLAIN "explain"
        /// Turns the film into a picture.
        DEVELOP "develop"
        /// Turns the film into a picture on the screen.
        SHOW "show"
    }

    /// The variant that reads geometry from images or from buffers, and can move or cannot.
    pub fn source(&self, from_images: bool, moving: bool) -> &'static str {
        let index = usize::from(!from_images) + 2 * usize::from(moving);
        self.sources[index].1
    }
}

impl Gpu {
    /// A kernel, compiled unless that was done before. A shader that the driver refuses is our fault:
    /// the error carries the driver's words, and the linked text lies in the folder for temporary files.
    pub(crate) fn pipeline(
        &self,
        name: &str,
        source: &'static str,
        layout: Option<&wgpu::PipelineLayout>,
        overrides: &[(&str, f64)],
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let named = |(id, value): &(&str, f64)| (id.to_string(), *value);
        let wanted = Ingredients {
            name: name.to_owned(),
            source,
            overrides: overrides.iter().map(named).collect(),
        };
        let known = |Pipelines(kept): &Pipelines| {
            let found = kept.iter().find(|(of, _)| *of == wanted);
            found.map(|(_, pipeline)| pipeline.clone())
        };
        if let Some(known) = self.pipelines.lock().ok().and_then(|kept| known(&kept)) {
            return Ok(known);
        }
        let pipeline = self.compile(name, source, layout, overrides)?;
        if let Ok(mut kept) = self.pipelines.lock() {
            kept.0.truncate(MOST_PIPELINES - 1);
            kept.0.push_front((wanted, pipeline.clone()));
        }
        Ok(pipeline)
    }

    fn compile(
        &self,
        name: &str,
        source: &str,
        layout: Option<&wgpu::PipelineLayout>,
        overrides: &[(&str, f64)],
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let made = self.scoped(name, || {
            let module = self
                .device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(name),
                    source: wgpu::ShaderSource::Wgsl(source.into()),
                });
            self.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(name),
                    layout,
                    module: &module,
                    entry_point: None,
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: overrides,
                        ..Default::default()
                    },
                    cache: None,
                })
        });
        made.map_err(|error| match error {
            GpuError::Internal { what } => {
                let dump = std::env::temp_dir().join(format!("glimray-{name}.wgsl"));
                let place = match std::fs::write(&dump, source) {
                    Ok(()) => format!(" (linked shader: {})", dump.display()),
                    Err(_) => String::new(),
                };
                GpuError::Internal {
                    what: format!("{what}{place}"),
                }
            }
            other => other,
        })
    }
}
