//! A GPU ray tracer: scenes in, pictures out, all rays traced by compute shaders.
//!
//! A scene file becomes a picture along one river. Each arrow is one function, each noun is a value
//! that can be printed and tested alone, and no arrow points back:
//!
//! ```text
//! file ─import▶ Scene ─frame▶ Frame ─pack▶ PackedScene, PackedView ─Renderer▶ film ─develop▶ Image ─output▶ file
//! ```
//!
//! For a moving picture the river runs from [`scene::Scene::frame`] on once for each frame, or from
//! [`scene::Scene::shot`] on where the shutter is open for a while: [`render::Renderer::set_frame`] takes
//! the next [`pack::PackedView`].
//!
//! ```
//! use glimray::gpu::{AdapterChoice, Gpu};
//! use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
//! use glimray::{import, output, pack};
//! use std::{path::Path, sync::Arc};
//!
//! let scene = import::load(Path::new("assets/scenes/spheres_and_triangles.scene"))?;
//! let packed = Arc::new(pack::scene(&scene)?);
//! let view = packed.frame(&scene.frame(0.0))?;
//! let gpu = Gpu::new(&AdapterChoice::default())?;
//! let settings = RenderSettings::from(&scene.output);
//! let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
//! while !renderer.is_done() {
//!     renderer.step()?;
//! }
//! let picture = renderer.develop(&Tone::LINEAR)?;
//! let folder = tempfile::tempdir()?;
//! output::save(folder.path().join("spheres.png"), &picture)?;
//! # assert_eq!((picture.width, picture.height), (640, 480));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! * **Axes**: right-handed, +Y up; a camera without a transform looks along −Z. Pictures start at
//!   the top left, x to the right, y down; pixel (0, 0) has its centre at (0.5, 0.5).
//! * **Units**: metres, or whatever one unit a file uses; seconds; bytes. Angles are radians, and
//!   degrees only in files and flags, where the name ends in `_deg` (or the help says so).
//! * **Colours**: linear Rec. 709 radiance from the importer to the film. Only [`output`]'s PNG and
//!   JPEG hold what exposure, tone curve and transfer made of it ([`render::Tone`]).
//! * **Spaces**: a mesh is f32 in object space; instances, shapes, lights, cameras and the places of
//!   textures are f64 in the space of the [`scene::Node`] that carries them, or in world space; shapes
//!   other than spheres and planes are canonical in a space of their own ([`scene::Form`]). On the GPU
//!   what instances place (what moves, and large meshes that stand in several places) is f32 in the
//!   space of its own tree, and everything else f32 in render space, which is world space moved so that
//!   the scene's render origin is at the origin ([`scene::Scene::render_origin`]).
//! * **Movement**: a [`scene::Scene`] stands still; its [`scene::Track`]s say how nodes, cameras, lights
//!   and materials change, and a [`scene::Frame`] is all of that at one moment. The GPU gets the frames of
//!   a shot at equal distances of time, and every sample has a moment between the first and the last.
//! * **Normals**: `n` is for shading, `ng` is the geometric one; a triangle's winding gives `ng` and
//!   nothing else. Directions have unit length and point away from the surface.
//! * **Bodies**: the inside of what is transparent is where its normals point away from.
//!   [`scene::Material::ior`], `absorption` and `priority` are those of the inside.
//! * **Absence** is `Option` on the host and [`layout::NONE`] on the GPU, never a NaN or an infinity.
//! * **Ownership**: the caller owns the [`scene::Scene`]; the packed scene is shared, because a
//!   [`render::Renderer`] uploads it again when a device is lost; the renderer owns the film, and the
//!   device unless it was given one ([`gpu::Gpu::from_wgpu`]); an [`image::Image`] belongs to whoever
//!   asked for it.
//! * **Determinism**: a pixel is a function of scene, frame, settings, seed and sample index. How the
//!   work is cut into steps does not show. Adaptive sampling ([`scene::Antialias::Adaptive`]) lets the
//!   first samples of a pixel and its neighbours choose how many it gets.
//! * **Limits are told**: what had to be left out of a picture is counted ([`render::Stats`]), what
//!   had to be left out of a scene is named ([`scene::Scene::skipped`]).
//! * **Errors**: one enum for each module that can fail, with what a user needs to know. Only
//!   [`app`] prints, exits or names flags. There is no panic on a bad file, a missing GPU or a full disk.
//!
//! # Features
//!
//! All are on by default. Without any the library is the renderer: it opens no window, needs no C or C++
//! compiler, knows no command line, and compiles for `wasm32-unknown-unknown`, where [`output`] and the
//! functions of [`import`] that read folders are left out.
//!
//! | feature | adds |
//! |---|---|
//! | `cli` | [`app`], the program |
//! | `viewer` | the window of `glimray view`; brings `cli` |
//! | `video` | MP4 and GIF |
//! | `gl` | OpenGL, where there is no Vulkan, Metal or DirectX 12 |
//! | `parallel` | trees are built by all cores |
//!
//! # Map
//!
//! | module | does | uses |
//! |---|---|---|
//! | [`scene`] | the host model, with every question settled | |
//! | [`import`] | file → `Scene`, one file for each format; files come from an [`import::Resolver`] | `scene` |
//! | [`bvh`] | boxes → tree of four-way nodes | |
//! | [`layout`] | the structs and tags that shaders also see | |
//! | [`pack`] | `Scene` → arrays for the GPU; no device needed | `scene`, `bvh`, `layout` |
//! | [`gpu`] | the device, its memory, its loss, its errors | |
//! | [`render`] | steps, films that are written and merged, adaptive rounds, developing, ray trees | `pack`, `layout`, `gpu`, `image`, `scene` |
//! | [`export`] | `Scene` → native scene file | `scene` |
//! | [`image`](mod@image) | a finished picture in memory | |
//! | [`output`] | `Image` → file, frames → video, complete or absent | `image` |
//! | [`app`] | the command line | everything |
//!
//! The shaders are in `shaders/`: `types.wesl` (shared structs), `bindings.wesl` (all bindings and
//! overrides), `lib/` (pure functions), `scene/` (what reads bindings), `kernels/` (entry points).
//! The binary carries them linked to plain WGSL (`shaders/linked`), which `make shaders` keeps up to date.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(feature = "cli")]
pub mod app;
pub mod bvh;
mod clock;
pub mod export;
pub mod gpu;
pub mod image;
pub mod import;
pub mod layout;
#[cfg(not(target_arch = "wasm32"))]
pub mod output;
pub mod pack;
pub mod render;
pub mod scene;
