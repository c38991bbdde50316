//! The linked kernels.

use crate::{bound_loops, files, inline_functions, specialize};

/// Kinds of adapters for which modules differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdapterKind {
    /// A software adapter for Vulkan, which is taken for Mesa's.
    Lavapipe,
    /// A GPU.
    Gpu,
    /// Another software adapter, or a virtual one, behind which there may be lavapipe.
    Other,
}

/// A compute kernel: linked WGSL from `shaders/linked`, and its entry point.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// The name of the kernel, its entry point and its file in `shaders/kernels/`. The file of the packet variant has
    /// `_packet` after the name.
    pub name: &'static str,
    variants: &'static [Variant],
}

/// A variant of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Geometry, or what the denoiser filters, is fetched from storage images.
    Image,
    /// Geometry is fetched from buffers, what the denoiser filters from textures.
    Buffer,
    /// As `Image`, and the lanes of a subgroup trace their rays together: see `Gpu::traces_packets` of the renderer.
    Packet,
}

impl Variant {
    /// The end of the names of its files.
    fn file(self) -> &'static str {
        match self {
            Self::Image => "image",
            Self::Buffer => "buffer",
            Self::Packet => "packet",
        }
    }
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $constant:ident $name:literal $($variant:ident),*;)*) => {
        $($(#[$doc])* pub const $constant: Kernel = Kernel {
            name: $name,
            variants: &[$(Variant::$variant),*],
        };)*
        /// All kernels.
        pub const ALL: &[Kernel] = &[$(Self::$constant),*];
    };
}

impl Kernel {
    kernels! {
        /// Adds samples of `Integrator::Lecture` to the film.
        LECTURE "lecture" Image, Buffer;
        /// Adds samples of `Integrator::Whitted` to the film.
        WHITTED "whitted" Image, Buffer, Packet;
        /// Adds samples of `Integrator::Path` to the film.
        PATH_TRACE "path_trace" Image, Buffer;
        /// Adds samples of the other integrators to the film.
        DEBUG_VIEW "debug_view" Image, Buffer;
        /// Records all rays of single samples of `Integrator::Whitted`.
        EXPLAIN "explain" Image, Buffer;
        /// Records all rays of single samples of `Integrator::Path`.
        EXPLAIN_PATH "explain_path" Image, Buffer;
        /// Develops the film to a picture.
        DEVELOP "develop" Buffer;
        /// Develops the film to a texture for display.
        SHOW "show" Buffer;
        /// Writes what the denoiser needs from the film to textures.
        FILM_FEATURES "film_features" Buffer;
        /// Divides a picture by its albedo, for the denoiser.
        DEMODULATE "demodulate" Buffer;
        /// A pass of the denoiser's filter.
        DENOISE "denoise" Image, Buffer;
        /// Traces the rays of a `RayQuery`.
        TRACE_RAYS "trace_rays" Image, Buffer, Packet;
    }

    /// The module of a variant, specialised by overrides of `bindings.wesl`, by name.
    ///
    /// # Errors
    /// The errors of [`Self::source`] and [`specialize`].
    pub fn specialized(
        &self,
        variant: Variant,
        overrides: &[(&str, f64)],
    ) -> Result<naga::Module, String> {
        specialize(&self.source(variant)?, overrides)
    }

    /// The module of a variant for a kind of adapter.
    ///
    /// # Errors
    /// The errors of [`Self::specialized`].
    pub fn module(
        &self,
        variant: Variant,
        overrides: &[(&str, f64)],
        adapter: AdapterKind,
    ) -> Result<naga::Module, String> {
        let by_select = ("EXTREMES_BY_SELECT", f64::from(adapter != AdapterKind::Gpu));
        let mut module = self.specialized(variant, &[overrides, &[by_select]].concat())?;
        // Other drivers have not been measured.
        if adapter == AdapterKind::Lavapipe {
            inline_functions(&mut module);
        }
        if adapter != AdapterKind::Gpu {
            bound_loops(&mut module);
        }
        Ok(module)
    }

    /// Whether it has this variant.
    pub fn has(&self, variant: Variant) -> bool {
        self.variants.contains(&variant)
    }

    /// The kernel's variants.
    pub fn variants(&self) -> impl Iterator<Item = Variant> {
        self.variants.iter().copied()
    }

    /// The linked WGSL of a variant.
    ///
    /// # Errors
    /// The kernel has no such variant, or a development build cannot read its file.
    pub fn source(&self, variant: Variant) -> Result<String, String> {
        if !self.has(variant) {
            return Err(format!("{} has no variant {variant:?}", self.name));
        }
        files::read(&format!("linked/{}_{}.wgsl", self.name, variant.file()))
    }
}
