//! From the host model to the arrays that the GPU reads. Pure: no device is involved, the same
//! scene gives the same bytes.

mod forest;
mod frame;
mod geometry;
mod light;
mod material;
mod media;
mod nodes;
mod object;
mod placed;
mod placement;
mod surfaces;
mod view;

pub use frame::PackedView;
pub use placed::MOST_LAID_OUT;

use crate::clock::Instant;
use crate::{
    bvh::Aabb,
    layout::{
        LEAF_FIRST_MASK, PackedMaterial, PackedNode, PackedShape, PackedTexture, PackedTriangle,
        PackedVertex, STACK_SIZE,
    },
    scene::{Material, Scene, Shadows},
};
use bytemuck::cast_slice;
use forest::Forest;
use geometry::Flat;
use glam::DVec3;
use object::Origins;
use placed::{Placed, PlacedTree, Plan};

/// A scene as the GPU wants it.
#[derive(Clone, Debug)]
pub struct PackedScene {
    /// Four-way nodes with boxes of 8 bits a plane: the tree of what stands still, whose root is node
    /// 0, then those that instances place.
    pub nodes: Vec<PackedNode>,
    /// In leaf order, tree by tree.
    pub triangles: Vec<PackedTriangle>,
    /// Those of them that are in the first tree, in render space; others are in a space of their own.
    pub still_triangle_count: u32,
    /// Bounded shapes of the first tree in leaf order, then `plane_count` planes, then those of other
    /// trees.
    pub shapes: Vec<PackedShape>,
    /// Shapes of the first tree.
    pub still_shape_count: u32,
    /// Shapes behind them that are in no tree.
    pub plane_count: u32,
    /// In scene order, mesh by mesh.
    pub vertices: Vec<PackedVertex>,
    /// (u, v, 0, 0) of each vertex, zeros in meshes without; empty where no mesh has any.
    pub uvs: Vec<[f32; 4]>,
    /// In scene order, then those of visible lights.
    pub materials: Vec<PackedMaterial>,
    /// In scene order.
    pub textures: Vec<PackedTexture>,
    /// Linear texels of all pictures, one after the other, as half floats; the fourth is 1.
    pub texels: Vec<[u16; 4]>,
    /// For each of the scene's pictures its first texel, width and height.
    pub pictures: Vec<[u32; 3]>,
    /// What the scene has, so that all else is compiled out.
    pub features: Features,
    /// Bodies that are transparent at some time, which the camera may be inside of.
    bodies: Vec<media::Body>,
    /// Boxes near the root of the first tree, where there are others beside it.
    still_parts: Vec<(Aabb, u32)>,
    /// The most entries on the stack in any of the trees.
    stack_need: usize,
    placed_trees: Vec<PlacedTree>,
    placed: Vec<Placed>,
    /// The scene's materials where its visible lights or a track may change some.
    changing: Option<Changing>,
    /// What everything is in the scene.
    origins: Origins,
    /// Where render space has its origin, in world space: [`Scene::render_origin`].
    pub origin: DVec3,
    /// Seconds that building the tree took.
    pub build_seconds: f64,
}

/// What [`PackedScene::materials`] are made of.
#[derive(Clone, Debug)]
struct Changing {
    materials: Vec<Material>,
    /// Indices of the visible lights.
    lamps: Vec<usize>,
}

/// What is in a scene that a kernel needs code for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// Bit k: there is a bounded shape of kind k.
    pub shape_kinds: u32,
    /// Some triangle's corners differ in material.
    pub mixed_materials: bool,
    /// Something mirrors, be it only by total reflection, or shows only part of its local light.
    pub reflection: bool,
    /// Something is transparent.
    pub refraction: bool,
    /// A transparent body may touch or overlap another body.
    pub contact: bool,
    /// Shadow rays go on through what is transparent.
    pub filtered_shadows: bool,
    /// Some colour varies over a surface.
    pub textures: bool,
    /// Something shines that rays can see.
    pub emission: bool,
    /// There are trees that instances place.
    pub instances: bool,
}

/// Why a scene cannot be packed: it is too big for the formats the GPU reads.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// An index does not fit into its bits.
    #[error(
        "scene too big (after instancing): it has {count} {what}, the tree can address {limit}. Use fewer or simpler objects."
    )]
    TooMany {
        /// What is counted, in the plural.
        what: &'static str,
        /// How many there are, instances counted each.
        count: usize,
        /// The most that can be told apart.
        limit: usize,
    },
    /// A coordinate or radius whose square f32 cannot hold.
    #[error(
        "scene too spread out (object coordinates): {value:e} units from the camera is beyond the range of f32 arithmetic, at most {limit:e}. Scale the scene down."
    )]
    OutOfRange {
        /// Its magnitude in scene units, seen from the render origin.
        value: f64,
        /// The largest allowed.
        limit: f64,
    },
    /// A shape that is thinner than f32 can resolve.
    #[error(
        "object too small (scaled size): {size:e} units in one direction is below the range of f32 arithmetic, at least {limit:e}. Make it larger, or scale the scene up."
    )]
    TooSmall {
        /// In scene units.
        size: f64,
        /// The smallest allowed.
        limit: f64,
    },
    /// The trees of what is placed and the one above them need more of a stack than shaders have.
    #[error(
        "scene too deep (tree over instances): walking it takes a stack of {need} entries, at most {limit} are possible. Use fewer objects, or spread them more evenly."
    )]
    TooDeep {
        /// Entries needed.
        need: usize,
        /// Entries there are.
        limit: usize,
    },
}

/// Packs a scene and builds its trees.
pub fn scene(scene: &Scene) -> Result<PackedScene, PackError> {
    scene_with(scene, MOST_LAID_OUT)
}

/// The same, where meshes that stand still in several places are laid out in the world if their copies
/// have at most this many triangles, and else are one tree with many instances.
pub fn scene_with(scene: &Scene, most_laid_out: usize) -> Result<PackedScene, PackError> {
    let rest = scene.frame(0.0);
    let origin = scene.render_origin_at(&rest);
    let plan = Plan::new(scene, &rest, most_laid_out);
    let mut flat = Flat::of_still(&plan, scene, &rest, origin)?;

    let start = Instant::now();
    let mut forest = Forest::default();
    let stack_size = match plan.is_still() {
        // The last store of a traversal step lies one beyond the entries that count.
        true => STACK_SIZE as usize - 1,
        false => placed::PLACED_STACK,
    };
    let still = forest.plant(&flat.triangles, &flat.bounded, stack_size);
    let (still_triangle_count, still_shape_count) = (flat.triangles.len(), flat.bounded.len());
    forest.shapes.extend_from_slice(&flat.planes);
    let (placed_trees, placed) = plan.plant(scene, &mut flat, &mut forest)?;
    let build_seconds = start.elapsed().as_secs_f64();

    let limit = LEAF_FIRST_MASK as usize;
    let counts = [
        ("triangles", flat.triangles.len()),
        ("shapes", flat.bounded.len()),
    ];
    for (what, count) in counts {
        if count > limit {
            return Err(PackError::TooMany { what, count, limit });
        }
    }
    let (texels, pictures) = material::texels(scene)?;
    let textures = material::textures(scene, origin, &pictures)?;
    let features = Features {
        shape_kinds: (flat.bounded.iter()).fold(0, |kinds, (shape, _)| kinds | 1 << shape.kind),
        mixed_materials: flat.mixed_materials,
        contact: media::may_touch(scene),
        filtered_shadows: scene.shadows == Shadows::Filtered,
        instances: !placed.is_empty(),
        ..material::features(scene)
    };
    let (materials, changing) = surfaces::materials(scene, &rest);
    Ok(PackedScene {
        nodes: forest.nodes,
        triangles: forest.triangles,
        still_triangle_count: still_triangle_count as u32,
        shapes: forest.shapes,
        still_shape_count: still_shape_count as u32,
        plane_count: flat.planes.len() as u32,
        vertices: flat.vertices,
        uvs: if scene.meshes.iter().any(|mesh| !mesh.uvs.is_empty()) {
            flat.uvs
        } else {
            Vec::new()
        },
        materials,
        textures,
        texels,
        pictures,
        features,
        bodies: media::bodies(scene),
        stack_need: (placed_trees.iter().map(|placed| placed.tree.stack_need))
            .fold(still.stack_need, usize::max),
        still_parts: if placed.is_empty() {
            Vec::new()
        } else {
            still.parts
        },
        placed_trees,
        placed,
        changing,
        origins: Origins::new(scene, &plan),
        origin,
        build_seconds,
    })
}

impl PackedScene {
    /// Every byte that a picture depends on but for the view: what a fingerprint is made of.
    pub fn parts(&self) -> Vec<&[u8]> {
        vec![
            cast_slice(&self.nodes),
            cast_slice(&self.triangles),
            cast_slice(&self.shapes),
            cast_slice(&self.vertices),
            cast_slice(&self.uvs),
            cast_slice(&self.materials),
            cast_slice(&self.textures),
            cast_slice(&self.texels),
        ]
    }

    /// Number of shapes in all trees.
    pub fn bounded_shape_count(&self) -> u32 {
        self.shapes.len() as u32 - self.plane_count
    }

    /// Number of instances that a view can have.
    pub fn instance_count(&self) -> usize {
        self.placed.len()
    }
}
