//! The functions of the fuzz targets. They are among the tests, which replay what the targets start from and
//! what they found.

#[path = "../../tests/fuzz/harness.rs"]
mod harness;

pub use harness::*;
