//! glimray
pub mod app;
pub mod bvh;
pub mod gpu;
pub mod image;
pub mod import;
pub mod layout;
pub mod output;
pub mod pack;
pub mod render;
pub mod scene;
