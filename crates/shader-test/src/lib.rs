#![doc = include_str!("../README.md")]

mod gpu;
mod linked;
mod row;
mod shader;
mod signature;

pub use gpu::Gpu;
pub use row::{Plain, Row, Scalar};
pub use shader::Shader;
/// The wesl of [`Shader::resolved_by`].
pub use wesl;
/// The wgpu of [`Gpu::from_device`].
pub use wgpu;

use std::fmt;

/// The reason why a call gave no results. `Debug` prints the text of `Display`, for `unwrap` in tests.
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// There is no device, or it was lost or is out of memory.
    Device(String),
    /// The shader is invalid: `file:line: message`, and the line on the next one.
    Shader(String),
    /// The rows do not fit the function.
    Rows(String),
    /// The function did not return for a row: the driver stopped it.
    Unwritten {
        /// The function's name.
        function: String,
        /// The index of the first such row.
        row: usize,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Device(text) | Self::Shader(text) | Self::Rows(text) => f.write_str(text),
            Self::Unwritten { function, row } => {
                write!(f, "`{function}` wrote nothing for row {row}")
            }
        }
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Error {}
