//! Importers with the renderer and the program. `crates/io` has the other tests of importers.

mod demo;
pub mod gltf;
mod memory;
mod nff;
mod picture_meaning;
mod range;
#[allow(dead_code, reason = "the tests of importers use more of it")]
#[path = "../../crates/io/tests/suite/import/writing.rs"]
pub mod writing;

use writing::{folder, load, message_in, messages, scene};
