//! A GPU ray tracer: it loads scenes and writes images. Compute shaders trace all rays. One call renders a picture:
//!
//! ```
//! use glimray::{PictureOptions, output, render_file};
//!
//! let options = PictureOptions { size: Some((64, 48)), ..PictureOptions::default() };
//! let picture = render_file("assets/scenes/spheres_and_triangles.scene", &options)?;
//! let folder = tempfile::tempdir()?;
//! output::save(folder.path().join("spheres.png"), &picture)?;
//! # assert_eq!((picture.width, picture.height), (64, 48));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A scene file becomes an image through one pipeline. Each arrow is one function, each noun is a value
//! that can be printed and tested on its own, and no arrow points back:
//!
//! ```text
//! file ─import▶ Scene ─frame▶ Frame ─pack▶ PackedScene, PackedView ─Renderer▶ film ─develop▶ Image ─output▶ file
//! ```
//!
//! For an animation the pipeline is repeated from [`scene::Scene::frame`] for each frame, or from
//! [`scene::Scene::motion_samples`] if the shutter is open for some time: [`render::Renderer::set_frame`]
//! accepts the next [`pack::PackedView`]. [`render_file`] takes these steps:
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
//! let picture = renderer.develop(&Tone::from(&scene.output))?;
//! let folder = tempfile::tempdir()?;
//! output::save(folder.path().join("spheres.png"), &picture)?;
//! # assert_eq!((picture.width, picture.height), (640, 480));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! * **Axes**: right-handed, +Y up; a camera without a transform looks along −Z. Images start at the top
//!   left, x to the right, y down; the centre of pixel (0, 0) is (0.5, 0.5).
//! * **Units**: metres, or the file's unit; seconds; bytes. Angles are radians, and degrees only in files
//!   and flags whose name ends in `_deg` (or whose help says so).
//! * **Colours**: linear Rec. 709 radiance from the importer to the film. Only [`output`]'s PNG and JPEG
//!   files contain display values, after exposure, tone curve and transfer function ([`render::Tone`]).
//! * **Spaces**: a mesh is f32 in object space. Instances, shapes, lights, cameras and texture transforms
//!   are f64 in the space of their parent [`scene::Node`], or in world space. Shapes other than spheres
//!   and planes are canonical in a space of their own ([`scene::CanonicalShape`]). On the GPU, instanced
//!   geometry (moving objects, and large meshes that are used several times) is f32 in the space of its
//!   BLAS; everything else is f32 in render space, which is world space translated so that the scene's
//!   render origin is at the origin ([`scene::Scene::render_origin`]).
//! * **Motion**: a [`scene::Scene`] is static; its [`scene::Track`]s animate nodes, cameras, lights,
//!   materials and the weights of morph targets, and a [`scene::Frame`] is their state at one time. The GPU gets frames that are evenly
//!   spaced over the shutter interval, and every sample has a time between the first and the last.
//! * **Normals**: `n` is the shading normal, `ng` the geometric one; the winding of a triangle determines
//!   `ng` only. Directions have unit length and point away from the surface.
//! * **Dielectric volumes**: the inside of a transparent surface is the side that its normals point away
//!   from. [`scene::Phong::ior`] and `absorption`, and [`scene::Material::priority`] describe the inside.
//! * **Absence** is `Option` on the host and [`layout::NONE`] on the GPU, never a NaN or an infinity.
//! * **Ownership**: the caller owns the [`scene::Scene`]. The packed scene is shared, because a
//!   [`render::Renderer`] uploads it again after a device is lost. The renderer owns the film, and the
//!   device unless it was given one ([`gpu::Gpu::from_wgpu`]). The caller owns each [`image::Image`].
//! * **Determinism**: a pixel is a function of scene, frame, settings, seed and sample index. It does not
//!   depend on how the work is divided into submissions. With adaptive sampling
//!   ([`scene::Antialias::Adaptive`]), the first samples of a pixel and its neighbours determine its
//!   sample count.
//! * **Limits are reported**: samples that had to be cut off are counted ([`render::Stats`]), and parts
//!   of a scene that had to be skipped are listed ([`scene::Scene::skipped`]).
//! * **Errors**: one enum for each module that can fail, with the information that a user needs. Only
//!   the program prints, exits or mentions flags. A bad file, a missing GPU or a full disk never causes a panic.
//!
//! # Features
//!
//! All are on by default. Without any the library is the renderer: it opens no window, needs no C or C++
//! compiler, knows no command line, and compiles for `wasm32-unknown-unknown`, where [`output`], the
//! functions of [`import`] that read folders, and those that wait for the device are left out. Each function that waits has a
//! counterpart whose name ends in `_async`; [`gpu::Gpu::open`] is that of `Gpu::new`, and [`render_from`] that of `render_file`.
//!
//! | feature | adds |
//! |---|---|
//! | `cli` | the program |
//! | `viewer` | the window of `glimray view`; brings `cli` |
//! | `video` | MP4 and GIF |
//! | `basis` | KTX2 pictures |
//! | `draco` | glTF models with Draco compression |
//! | `gl` | OpenGL, where there is no Vulkan, Metal or DirectX 12 |
//! | `parallel` | trees are built and pictures decoded by all cores |
//!
//! # Map
//!
//! | module | does | package |
//! |---|---|---|
//! | [`scene`] | the host model, with every question settled | `glimray-scene` |
//! | [`bytes`] | sizes in messages | |
//! | [`threads`] | work on slices by all cores | |
//! | [`image`](mod@image) | a finished picture in memory | |
//! | [`import`] | file → `Scene`, one file for each format; files come from an [`import::Resolver`] | `glimray-io` |
//! | [`export`] | `Scene` → native scene file | |
//! | [`output`] | `Image` → file, frames → video, complete or absent | |
//! | [`bvh`] | boxes → tree of four-way nodes | `glimray-render` |
//! | [`layout`] | the structs and tags that shaders also see | |
//! | [`pack`] | `Scene` → arrays for the GPU; no device needed | |
//! | [`gpu`] | the device, its memory, its loss, its errors | |
//! | [`render`] | steps, films that are written and merged, adaptive rounds, developing, ray trees | |
//!
//! `glimray-shaders` has the kernels. `ARCHITECTURE.md` in the repository says which package uses which, and where to
//! find things.

mod picture;

#[cfg(not(target_arch = "wasm32"))]
pub use picture::render_file;
pub use picture::{PictureError, PictureOptions, render_from};

#[cfg(not(target_arch = "wasm32"))]
#[doc(inline)]
pub use glimray_io::output;
#[doc(inline)]
pub use glimray_io::{export, import};
#[doc(inline)]
pub use glimray_render::{self as render, bvh, gpu, layout, pack};
#[doc(inline)]
pub use glimray_scene::{self as scene, bytes, image, threads};
