//! glTF 2.0. The models are built here, byte by byte.

mod compressed;
pub mod deform;
mod geometry;
mod hostile;
mod materials;
pub mod model;
mod motion;
mod moving_maps;
mod nodes;
mod properties;
mod tangents;
mod unused;
mod uv_sets;

use super::{folder, load, message_in, scene};
