//! The kernels of glimray: compute shaders in WESL, linked to plain WGSL, and specialised in naga's IR before a driver
//! sees them. Nothing here needs a device.
//!
//! Release builds embed the linked kernels; development builds read them from `linked/` at run time, so that an edited
//! shader needs no compiler of Rust.

mod bound;
mod files;
mod inline;
mod kernel;
mod specialize;

pub use bound::bound_loops;
pub use inline::inline_functions;
pub use kernel::{AdapterKind, Kernel, Variant};
pub use specialize::specialize;
