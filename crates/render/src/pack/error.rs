//! Why a scene cannot be packed.

#[cfg(doc)]
use glimray_scene::Scene;

/// A scene that cannot be packed: it exceeds a limit, has no camera, or a mesh contradicts itself.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// [`Scene::camera_index`] is not the index of a camera.
    #[error(
        "scene refused (cameras): it has no camera to be seen by. Add one to `Scene::cameras`."
    )]
    NoCamera,
    /// A mesh whose arrays, or what deforms it, do not fit each other.
    #[error("mesh refused (mesh {index}): {what}. Correct the mesh before it is packed.")]
    Inconsistent {
        /// Index into [`Scene::meshes`].
        index: usize,
        /// How they do not fit.
        what: String,
    },
    /// An index does not fit its bits.
    #[error(
        "scene too big (after instancing): it has {count} {what}, at most {limit} are possible. Use fewer or simpler objects."
    )]
    TooMany {
        /// The counted objects, in the plural.
        what: &'static str,
        /// The number in the scene, with each instance counted.
        count: usize,
        /// The maximum number.
        limit: usize,
    },
    /// A coordinate or radius whose square overflows f32.
    #[error(
        "scene too spread out (object coordinates): {value:e} units from the camera is beyond the range of f32 arithmetic, at most {limit:e}. Scale the scene down."
    )]
    OutOfRange {
        /// Magnitude in scene units, relative to the render origin.
        value: f64,
        /// The largest allowed.
        limit: f64,
    },
    /// A shape that is too thin for f32.
    #[error(
        "object too small (scaled size): {size:e} units in one direction is below the range of f32 arithmetic, at least {limit:e}. Make it larger, or scale the scene up."
    )]
    TooSmall {
        /// In scene units.
        size: f64,
        /// The smallest allowed.
        limit: f64,
    },
    /// The TLAS and the BLASes together need a deeper traversal stack than shaders have.
    #[error(
        "scene too deep (BVH over instances): traversal needs {need} stack entries, at most {limit} are available. Use fewer objects, or spread them more evenly."
    )]
    TooDeep {
        /// Entries needed.
        need: usize,
        /// Entries available.
        limit: usize,
    },
}
