//! From the host model to the arrays that the GPU reads. Pure: no device is involved, the same
//! scene gives the same bytes.

mod frame;
mod geometry;
mod light;
mod material;
mod media;
mod nodes;

pub use frame::PackedView;

use crate::{
    bvh,
    layout::{
        LEAF_FIRST_MASK, PackedMaterial, PackedNode, PackedShape, PackedTexture, PackedTriangle,
        PackedVertex, STACK_SIZE,
    },
    scene::{Scene, Shadows},
};
use bytemuck::cast_slice;
use glam::{DVec3, Vec3};
use std::time::Instant;

/// Most primitives in a leaf.
const LEAF_SIZE: u32 = 4;

/// A scene as the GPU wants it.
#[derive(Clone, Debug)]
pub struct PackedScene {
    /// Four-way nodes with boxes of 8 bits a plane; node 0 is the root.
    pub nodes: Vec<PackedNode>,
    /// In leaf order.
    pub triangles: Vec<PackedTriangle>,
    /// Bounded shapes in leaf order, then `plane_count` planes.
    pub shapes: Vec<PackedShape>,
    /// Shapes at the end of `shapes` that are not in the tree.
    pub plane_count: u32,
    /// In scene order, instances one after the other.
    pub vertices: Vec<PackedVertex>,
    /// (u, v, 0, 0) of each vertex; empty where no texture asks for them.
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
    /// Transparent bodies, which the camera may be inside of.
    bodies: Vec<media::Body>,
    /// Where render space has its origin, in world space: at the scene's default camera, where the
    /// picture needs f32 to be finest.
    pub origin: DVec3,
    /// Seconds that building the tree took.
    pub build_seconds: f64,
}

/// What is in a scene that a kernel needs code for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// Bit k: there is a bounded shape of kind k.
    pub shape_kinds: u32,
    /// Some triangle's corners differ in material.
    pub mixed_materials: bool,
    /// Something mirrors.
    pub reflection: bool,
    /// Something is transparent.
    pub refraction: bool,
    /// A transparent body may touch another body.
    pub contact: bool,
    /// Shadow rays go on through what is transparent.
    pub filtered_shadows: bool,
    /// Some colour varies over a surface.
    pub textures: bool,
    /// Something shines that rays can see.
    pub emission: bool,
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
        /// Its magnitude in scene units, seen from the default camera.
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
}

/// Packs a scene and builds its tree.
pub fn scene(scene: &Scene) -> Result<PackedScene, PackError> {
    let origin = scene.cameras[scene.camera_index].look_from;
    let geometry::Flat {
        triangles,
        vertices,
        uvs,
        bounded,
        planes,
        mixed_materials,
    } = geometry::flatten(scene, origin)?;
    let limit = LEAF_FIRST_MASK as usize;
    for (what, count) in [("triangles", triangles.len()), ("shapes", bounded.len())] {
        if count > limit {
            return Err(PackError::TooMany { what, count, limit });
        }
    }

    let start = Instant::now();
    let boxes: Vec<_> = (triangles.iter().map(geometry::triangle_box))
        .chain(bounded.iter().map(|(_, bounds)| *bounds))
        .collect();
    let mut groups = vec![nodes::TRIANGLES; triangles.len()];
    groups.resize(boxes.len(), nodes::SHAPES);
    let limits = bvh::Limits {
        leaf_size: LEAF_SIZE,
        // The last store of a traversal step lies one beyond the entries that count.
        stack_size: STACK_SIZE as usize - 1,
    };
    let bvh = bvh::build(&boxes, &groups, nodes::GROUP_COUNT, limits);
    let (texels, pictures) = material::texels(scene)?;
    let textures = material::textures(scene, origin, &pictures)?;
    let features = Features {
        shape_kinds: (bounded.iter()).fold(0, |kinds, (shape, _)| kinds | 1 << shape.kind),
        mixed_materials,
        filtered_shadows: scene.shadows == Shadows::Filtered,
        ..material::features(scene)
    };
    let lamps: Vec<_> = light::light_surfaces(scene)
        .map(|lamp| lamp.material)
        .collect();
    let features = Features {
        emission: features.emission || lamps.iter().any(|lamp| lamp.emission != Vec3::ZERO),
        ..features
    };
    let pick_shape = |&i: &u32| bounded[i as usize - triangles.len()].0;
    Ok(PackedScene {
        nodes: bvh.nodes.iter().map(nodes::quantize).collect(),
        triangles: (bvh.order[nodes::TRIANGLES as usize].iter())
            .map(|&i| triangles[i as usize])
            .collect(),
        shapes: (bvh.order[nodes::SHAPES as usize].iter().map(pick_shape))
            .chain(planes.iter().copied())
            .collect(),
        plane_count: planes.len() as u32,
        vertices,
        uvs: if features.textures { uvs } else { Vec::new() },
        materials: (scene.materials.iter().chain(&lamps))
            .map(material::material)
            .collect(),
        textures,
        texels,
        pictures,
        features,
        bodies: media::bodies(scene),
        origin,
        build_seconds: start.elapsed().as_secs_f64(),
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

    /// Number of shapes in the tree.
    pub fn bounded_shape_count(&self) -> u32 {
        self.shapes.len() as u32 - self.plane_count
    }
}
