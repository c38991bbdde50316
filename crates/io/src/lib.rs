//! Files of the ray tracer glimray: scenes and models are read ([`import`]) and written ([`export`]), pictures and
//! videos are written ([`output`]).
//!
//! ```
//! use glimray_io::{export, import, output};
//! use glimray_scene::image::Image;
//!
//! let text = "[[objects]]
//!     sphere = { center = [0, 0, -5], radius = 2 }
//!     material = { phong = { diffuse = [0.8, 0.1, 0.1] } }";
//! let scene = import::parse("ball.toml", text, &import::Options::default())?;
//! assert_eq!(scene.shapes.len(), 1);
//! println!("{}", export::native(&scene, "ball", &|_, _| false)?.text);
//!
//! let folder = tempfile::tempdir()?;
//! output::save(folder.path().join("black.png"), &Image::new(16, 9))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod export;
pub mod import;
#[cfg(not(target_arch = "wasm32"))]
pub mod output;
