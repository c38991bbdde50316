//! Packs the scene into the arrays that the GPU reads. Packing is pure: it uses no device, and the same scene
//! gives the same bytes.

pub mod albedo;
mod background;
mod blas;
mod deform;
mod divided;
mod emissive_solid;
mod emitter_places;
mod emitters;
mod environment;
mod error;
mod features;
mod frame;
mod geometry;
mod glow;
mod instance;
mod joint;
mod layers;
mod light;
mod light_cluster;
mod light_tree;
mod material;
mod media;
mod mesh;
mod nodes;
mod object;
mod picture;
mod placement;
mod segments;
mod shape_pieces;
mod shell;
mod surfaces;
mod tlas;
mod topology;
mod trees;
mod triangle_pieces;

pub use error::PackError;
pub use features::{OutsideTree, SceneFeatures};
pub use frame::PackedView;
pub use instance::MAX_BAKED;
pub use mesh::DRAFT_FROM;
pub use nodes::with_float_planes;
pub use segments::Segments;
pub use trees::TreeWork;

use crate::layout::{
    IMAGE_WIDTH_LOG2, LEAF_FIRST_MASK, NODE_ROWS, PackedMaterial, PackedNode, PackedShape,
    PackedTangent, PackedTexture, PackedTriangle, PackedVertex, SHAPE, leaf_reference,
};
use bytemuck::cast_slice;
use deform::DeformingMesh;
use environment::Environment;
use geometry::Flat;
use glam::DVec3;
use glimray_scene::clock::Instant;
use glimray_scene::{Geometry, Scene, Shadows};
use glow::Glow;
use instance::{Instance, InstancedBlas, Plan, TransformSource};
use mesh::CachedMesh;
use object::Origins;
use picture::PackedPicture;
use std::sync::Arc;
use surfaces::AnimatedMaterials;
use tlas::TlasSource;
use trees::Trees;

/// A packed scene.
///
/// The arrays consist of segments that [`scene_from`] shares between scenes: the nodes, triangles and vertices
/// of each BLAS, in scene order. Instanced BLASes come first, then those baked into the world, then the joint
/// BLAS of shapes and small meshes: data that changes most often comes last.
#[derive(Clone, Debug)]
pub struct PackedScene {
    /// 4-wide nodes with 8-bit box planes. Node 0 is the root of all baked geometry if nothing is instanced;
    /// the nodes between it and the baked BLASes follow the nodes of all BLASes.
    pub nodes: Segments<PackedNode>,
    /// BLAS by BLAS, in leaf order, then those in several leaves or in none. Triangles of hidden baked meshes are all 0.
    pub triangles: Segments<PackedTriangle>,
    /// The first triangle in render space; those before it are in the space of an instanced BLAS.
    pub first_baked_triangle: u32,
    /// Number of triangles in render space.
    pub baked_triangle_count: u32,
    /// Baked bounded shapes in the same order, then `plane_count` planes, then instanced shapes.
    pub shapes: Segments<PackedShape>,
    /// Number of baked bounded shapes.
    pub baked_shape_count: u32,
    /// Number of planes, which follow the baked shapes and are in no BVH.
    pub plane_count: u32,
    /// BLAS by BLAS, mesh by mesh.
    pub vertices: Segments<PackedVertex>,
    /// (u, v) of each vertex and its second set, zeros for meshes without texture coordinates; empty if no mesh has any.
    pub uvs: Segments<[f32; 4]>,
    /// Tangents of each vertex, zeros for meshes without tangents; empty if no mesh has any.
    pub tangents: Segments<PackedTangent>,
    /// Linear red, green, blue and alpha of each vertex, white for meshes without colours; empty if no mesh has any.
    pub colors: Segments<[f32; 4]>,
    /// In scene order, then the materials of visible lights.
    pub materials: Arc<[PackedMaterial]>,
    /// In scene order.
    pub textures: Arc<[PackedTexture]>,
    /// The words of the texels of all pictures, concatenated: red, green, blue and alpha in 8 bits each, lowest
    /// first, or two words of half floats. Before the first texel of a picture with a mipmap the words -k say where its
    /// level k starts, counted from there.
    /// The table of [`crate::layout::PackedFrame::environment_first`] is at the end.
    pub texels: Segments<u32>,
    /// The first word with its `PICTURE_` bits, width and height of each picture.
    pub pictures: Vec<[u32; 3]>,
    /// The features that the scene uses; all others are compiled out.
    pub features: SceneFeatures,
    /// From this many lamps and emissive triangles and shapes on, paths choose them from the light tree, unless they are one
    /// flat patch.
    pub tree_from: usize,
    /// Dielectric volumes that are transparent at some time, which the camera may be inside of.
    volumes: Vec<media::Volume>,
    /// Triangles and shapes that emit light at some time.
    emissive: emitters::EmissiveParts,
    /// Half of the diagonal of the scene's bounds, where the chances of lights depend on it.
    radius: f64,
    meshes: Vec<Arc<CachedMesh>>,
    trees: Trees,
    /// The meshes that deform.
    deforming: Arc<[DeformingMesh]>,
    tlas_source: Arc<TlasSource>,
    packed_pictures: Vec<PackedPicture>,
    /// The table of the picture in the background.
    environment: Option<Environment>,
    /// The scene's materials if visible lights or a track may change some.
    animated_materials: Option<AnimatedMaterials>,
    /// Maps packed primitives back to scene objects.
    origins: Origins,
    /// The origin of render space, in world space: [`Scene::render_origin`].
    pub origin: DVec3,
    /// Time spent on building and refitting BVHs, in seconds.
    pub build_seconds: f64,
    /// Counts of the BVHs that were built.
    pub work: TreeWork,
}

/// Packs a scene and builds its BVHs.
///
/// # Errors
/// The scene exceeds the limits of the packed formats, or it has no camera, or the arrays of a mesh, or what deforms it, do
/// not fit each other.
pub fn scene(scene: &Scene) -> Result<PackedScene, PackError> {
    pack(None, scene, MAX_BAKED, false)
}

/// Packs a scene for its first pictures: the BVHs of large meshes are drafts, which are built in a fraction of the time, and
/// in which rays take longer. [`refined`] gives the scene its usual ones. Triangles lie in another order, so that other ones
/// of a mesh are chosen as lights; otherwise pictures are those of [`scene`].
///
/// # Errors
/// As [`scene`].
pub fn draft(scene: &Scene) -> Result<PackedScene, PackError> {
    pack(None, scene, MAX_BAKED, true)
}

/// Packs a scene with the same result as [`scene`], and about as slowly, from a draft of it or of an earlier state of it. Other
/// threads can use the draft meanwhile.
///
/// # Errors
/// As [`scene`].
pub fn refined(draft: &PackedScene, scene: &Scene) -> Result<PackedScene, PackError> {
    draft.meshes.iter().for_each(|mesh| mesh.refine());
    scene_from(draft, scene)
}

/// Packs a scene with the same result as [`scene`], reusing parts of `previous`: the BLASes of unchanged meshes
/// at unchanged positions, and pictures. An object that is added, moved, hidden or changed requires at most its
/// own BLAS and the tree above. After the removal of an object, later ones move up in the arrays.
///
/// # Errors
/// As [`scene`].
pub fn scene_from(previous: &PackedScene, scene: &Scene) -> Result<PackedScene, PackError> {
    pack(Some(previous), scene, MAX_BAKED, false)
}

/// Like [`scene`], with a limit on baking: a static mesh with several instances is baked if its copies have at
/// most `most_baked` triangles in total, and otherwise becomes one BLAS with many instances.
///
/// # Errors
/// As [`scene`].
pub fn scene_with(scene: &Scene, most_baked: usize) -> Result<PackedScene, PackError> {
    pack(None, scene, most_baked, false)
}

fn pack(
    previous: Option<&PackedScene>,
    scene: &Scene,
    most_baked: usize,
    drafts: bool,
) -> Result<PackedScene, PackError> {
    if scene.camera_index >= scene.cameras.len() {
        return Err(PackError::NoCamera);
    }
    let meshes = mesh::cached(previous.map_or(&[], |previous| &previous.meshes), scene)?;
    let rest = scene.frame(0.0);
    let origin = scene.render_origin_at(&rest);
    let plan = Plan::new(scene, (&rest, origin), most_baked)?;

    let start = Instant::now();
    let before = previous.map(|previous| &previous.trees);
    let trees = Trees::build(before, scene, (&rest, origin), &plan, &meshes, drafts)?;
    let build_seconds = start.elapsed().as_secs_f64();

    let joint = &trees.joint.blas;
    let first_instanced = (joint.shapes.len() + trees.joint.planes.len()) as u32;
    let (shapes, blas_of_shapes) = instanced_shapes(scene, &plan, first_instanced)?;
    let instanced_shapes: Arc<[_]> = shapes.into();
    let first_baked_triangle = (trees.baked.first())
        .map_or(joint.offsets, |t| t.blas.offsets)
        .triangle;
    let end = joint.end();
    let shape_count = joint.shapes.len() + instanced_shapes.len();
    let limit = LEAF_FIRST_MASK as usize;
    for (what, count) in [
        ("triangles", end.triangle as usize),
        ("shapes", shape_count),
    ] {
        if count > limit {
            return Err(PackError::TooMany { what, count, limit });
        }
    }
    let nodes: Segments<_> = trees.nodes();
    let tlas_source = TlasSource {
        origin,
        first_node: first_view_node(nodes.len()),
        parts: trees.top.parts.clone(),
        blas: (trees.instanced.iter().map(trees::MeshTree::instanced))
            .chain(blas_of_shapes)
            .collect(),
        instances: instances(&plan, trees.instanced.len()),
        stack_need: trees.stack_need(),
    };
    let before = previous.map(|previous| &previous.tlas_source);
    let tlas_source = match before.filter(|before| ***before == tlas_source) {
        Some(before) => before.clone(),
        None => Arc::new(tlas_source),
    };

    let before = previous.map_or(&[][..], |previous| &previous.packed_pictures);
    let (packed_pictures, pictures) = picture::pictures(scene, before)?;
    let before = previous.and_then(|previous| previous.environment.as_ref());
    let environment = environment::of_scene(scene, &packed_pictures, before);
    let table = environment.as_ref().and_then(Environment::table);
    let table = table.map(|table| table.words.clone());
    let mut texels = Segments::default();
    (packed_pictures.iter()).for_each(|packed| texels.append(&packed.words));
    texels.append(&[albedo::words()].into_iter().chain(table).collect());
    let bounded = joint.shapes.iter().chain(&*instanced_shapes);
    let features = SceneFeatures {
        shape_kinds: bounded.fold(0, |kinds, shape| kinds | 1 << shape.kind),
        outside_tree: trees.joint.outside_tree,
        mixed_materials: trees.meshes().any(|mesh| mesh.mixes_materials),
        second_uvs: scene.meshes.iter().any(|mesh| !mesh.second_uvs.is_empty()),
        contact: media::may_touch(scene, &meshes),
        filtered_shadows: scene.shadows == Shadows::Filtered,
        instances: plan.instance_count() > 0,
        ..material::features(scene)
    };
    let tangents = trees.tangents();
    let has_uvs = scene.meshes.iter().any(|mesh| !mesh.uvs.is_empty());
    let emits = material::may_emit(scene);
    let glows = Glow::of_materials(scene, &emits);
    let (materials, animated_materials) = surfaces::materials(scene, &rest, &glows);
    let mut packed = PackedScene {
        nodes,
        triangles: trees.triangles(&plan),
        first_baked_triangle,
        baked_triangle_count: end.triangle - first_baked_triangle,
        shapes: [&joint.shapes, &trees.joint.planes, &instanced_shapes]
            .map(Arc::clone)
            .into_iter()
            .collect(),
        baked_shape_count: joint.shapes.len() as u32,
        plane_count: trees.joint.planes.len() as u32,
        vertices: trees.vertices(),
        // Tangents have their place after them.
        uvs: match has_uvs || !tangents.is_empty() {
            true => trees.meshes().map(CachedMesh::uvs).collect(),
            false => Segments::default(),
        },
        deforming: deform::meshes(scene, origin, &plan, &trees, !tangents.is_empty()),
        tangents,
        colors: trees.colors(),
        materials,
        textures: material::textures(&scene.textures, origin, &pictures)?,
        texels,
        pictures,
        features,
        volumes: media::volumes(scene, &meshes),
        radius: light::radius(scene),
        emissive: emitters::EmissiveParts::default(),
        tree_from: light_tree::LEAST_LIGHTS,
        origins: Origins::new(scene, &plan, &trees),
        work: trees.work,
        meshes,
        trees,
        tlas_source,
        packed_pictures,
        environment,
        animated_materials,
        origin,
        build_seconds,
    };
    packed.emissive = packed.emissive(&emits, &glows);
    Ok(packed)
}

/// Moving shapes, each with its own BLAS. Their indices start at `first`.
fn instanced_shapes(
    scene: &Scene,
    plan: &Plan,
    first: u32,
) -> Result<(Vec<PackedShape>, Vec<InstancedBlas>), PackError> {
    let mut flat = Flat::default();
    let mut blas = Vec::new();
    let mut add = |geometry: Geometry, material, id| {
        let index = first + flat.bounded.len() as u32;
        flat.add_shape(&geometry, material, id, None)?;
        blas.push(InstancedBlas {
            root: leaf_reference(index, 1, true),
            first: SHAPE | index,
            count: 1,
            boxes: Vec::new(),
            shape: Some(geometry),
        });
        Ok::<_, PackError>(())
    };
    for &(index, _) in &plan.shapes {
        let shape = &scene.shapes[index];
        add(shape.geometry, shape.material, index)?;
    }
    for &index in &plan.lamps {
        let (material, id) = light::material_and_id(scene, index);
        if let Some(surface) = light::unit_surface(&scene.lights[index].kind) {
            add(surface, material, id)?;
        }
    }
    let shapes = flat.bounded.into_iter().map(|(shape, _)| shape);
    Ok((shapes.collect(), blas))
}

/// All instances: of meshes, then of shapes and lamps, whose BLASes follow those of `mesh_count` meshes.
fn instances(plan: &Plan, mesh_count: usize) -> Vec<Instance> {
    let meshes = (plan.instances.iter()).map(|&(_, blas, source)| Instance { blas, source });
    let nodes = (plan.shapes.iter())
        .map(|&(_, node)| TransformSource::Node(node, glam::DAffine3::IDENTITY));
    let lamps = plan.lamps.iter().map(|&index| TransformSource::Lamp(index));
    let own_trees = (mesh_count..)
        .zip(nodes.chain(lamps))
        .map(|(blas, source)| Instance { blas, source });
    meshes.chain(own_trees).collect()
}

/// Index of the first node of a view, for a scene with this many nodes: at the start of an image row.
fn first_view_node(node_count: usize) -> u32 {
    (node_count as u32).next_multiple_of((1 << IMAGE_WIDTH_LOG2) / NODE_ROWS)
}

impl PackedScene {
    /// All bytes of the scene that a picture depends on, without the view; input of fingerprints.
    pub fn parts(&self) -> Vec<&[u8]> {
        let mut parts: Vec<_> = (self.nodes.bytes().chain(self.triangles.bytes()))
            .chain(self.shapes.bytes())
            .chain(self.vertices.bytes())
            .chain(self.uvs.bytes())
            .chain(self.tangents.bytes())
            .chain(self.colors.bytes())
            .collect();
        parts.extend([cast_slice(&self.materials), cast_slice(&self.textures)]);
        parts.extend(self.texels.bytes());
        parts
    }

    /// Whether it has BVHs that [`refined`] replaces.
    pub fn is_draft(&self) -> bool {
        self.trees.has_drafts()
    }

    /// Number of bounded shapes.
    pub fn bounded_shape_count(&self) -> u32 {
        self.shapes.len() as u32 - self.plane_count
    }

    /// Maximum number of instances of a view.
    pub fn instance_count(&self) -> usize {
        self.tlas_source.instances.len()
    }

    /// Index of the first node of a view: after all nodes of the scene, at the start of an image row.
    pub fn first_view_node(&self) -> u32 {
        self.tlas_source.first_node
    }
}
