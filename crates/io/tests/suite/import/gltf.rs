//! glTF 2.0. The models are built here, byte by byte.

mod bar;
mod compressed;
mod deform;
mod geometry;
mod hostile;
mod materials;
pub mod model;
mod nodes;
mod unused;
mod uv_sets;

use super::{folder, load, message_in, scene};
