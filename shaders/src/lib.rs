//! The kernels of glimray: compute shaders in WESL, linked to plain WGSL, and specialised in naga's IR before a driver
//! sees them. Nothing here needs a device.
//!
//! Release builds embed the linked kernels; development builds read them from `linked/` at run time, so that an edited
//! shader needs no compiler of Rust.
//!
//! ```
//! use glimray_shaders::{AdapterKind, Kernel, Variant};
//!
//! // The classical ray tracer for GPUs, for triangles and lights only.
//! let overrides = [("HAS_TRIANGLES", 1.0), ("HAS_LIGHTS", 1.0)];
//! let module = Kernel::WHITTED.module(Variant::Buffer, &overrides, AdapterKind::Gpu)?;
//! assert_eq!(module.entry_points[0].name, "whitted");
//! assert!(module.overrides.is_empty());
//! # Ok::<(), String>(())
//! ```

mod bound;
mod files;
mod inline;
mod kernel;
mod specialize;

pub use bound::bound_loops;
pub use inline::inline_functions;
pub use kernel::{AdapterKind, Kernel, Variant};
pub use specialize::specialize;
