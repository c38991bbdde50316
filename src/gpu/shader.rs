//! The linked kernels and the pipelines made of them.

use super::{Gpu, GpuError, specialize::specialize};
use std::borrow::Cow;

/// A compute kernel: WGSL linked by `build.rs`, and its entry point.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// Also the entry point's, and its file's in `shaders/kernels/`; `explain` is `whitted` that keeps
    /// records.
    pub name: &'static str,
    /// Its variants, by name: geometry is read from images or from buffers.
    pub sources: [(&'static str, &'static str); 2],
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $constant:ident $name:literal)*) => {
        $($(#[$doc])* pub const $constant: Kernel = Kernel {
            name: $name,
            sources: [
                ("image", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_image.wgsl"))),
                ("buffer", include_str!(concat!(env!("OUT_DIR"), "/", $name, "_buffer.wgsl"))),
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

    /// The module of the variant that reads geometry from images or from buffers, specialised by these
    /// overrides: values by the ids that `bindings.wesl` gives them. The error is naga's, with the lines
    /// of the linked source.
    pub fn specialized(
        &self,
        from_images: bool,
        overrides: &[(&str, f64)],
    ) -> Result<naga::Module, String> {
        specialize(self.source(from_images), overrides)
    }

    fn source(&self, from_images: bool) -> &'static str {
        self.sources[usize::from(!from_images)].1
    }
}

impl Gpu {
    /// Compiles a kernel, specialised by these overrides. A shader that the driver refuses is our fault:
    /// the error carries the driver's words, and the linked text lies in the folder for temporary files.
    pub(crate) fn pipeline(
        &self,
        kernel: &Kernel,
        from_images: bool,
        layout: &wgpu::PipelineLayout,
        overrides: &[(&str, f64)],
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        let name = kernel.name;
        let refused = |what: String| GpuError::Internal {
            what: dumped(name, kernel.source(from_images), &what),
        };
        let module = kernel
            .specialized(from_images, overrides)
            .map_err(refused)?;
        let made = self.scoped(name, || {
            let module = self
                .device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(name),
                    source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
                });
            self.device
                .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(name),
                    layout: Some(layout),
                    module: &module,
                    entry_point: None,
                    compilation_options: Default::default(),
                    cache: None,
                })
        });
        made.map_err(|error| match error {
            GpuError::Internal { what } => refused(what),
            other => other,
        })
    }
}

/// An error about a kernel, with the file that its linked text was written to.
fn dumped(name: &str, source: &str, what: &str) -> String {
    let dump = std::env::temp_dir().join(format!("glimray-{name}.wgsl"));
    match std::fs::write(&dump, source) {
        Ok(()) => format!("{what} (linked shader: {})", dump.display()),
        Err(_) => what.to_owned(),
    }
}
