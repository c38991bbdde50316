//! Importers: the meaning of each format, and the message for every error.

mod assets;
mod cameras;
mod course;
mod defaults;
mod encoded;
mod files;
mod gltf;
mod hostile;
mod keys;
mod mtl;
mod native;
mod native_animation;
mod native_groups;
mod native_keys;
mod native_light_and_lens;
mod nff;
mod nodes_and_ply;
mod obj;
mod optics;
mod picture_store;
mod pictures;
mod ply;
mod resolver;
mod rounding;
mod shapes;
mod stage;
mod stl;
mod texts;
mod textures;
mod writing;
mod zipped;

use writing::{archive, folder, load, message_in, messages, scene, triangles, without_folder};
