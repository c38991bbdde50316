//! glTF 2.0. The models are built here, byte by byte.

#[allow(dead_code, reason = "the tests of importers use more of it")]
#[path = "../../../crates/io/tests/suite/import/gltf/bar.rs"]
pub mod bar;
#[allow(dead_code, reason = "the tests of importers use more of it")]
#[path = "../../../crates/io/tests/suite/import/gltf/model.rs"]
pub mod model;
mod motion;
mod moving_maps;
mod properties;
mod tangents;

use super::{folder, message_in};
