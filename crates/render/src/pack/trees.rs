//! All BVHs of a scene: those of its meshes, the joint BLAS of shapes and small meshes, and the one above baked
//! geometry. Unchanged ones are reused from a previous scene.

use super::{
    PackError,
    blas::{Blas, MAX_PARTS, opened},
    geometry::PlacedMesh,
    instance::{InstancedBlas, Plan},
    joint::{Joint, JointInput},
    mesh::CachedMesh,
    nodes::{self, Children, Offsets},
    segments::Segments,
    topology::STACK_BELOW,
};
use crate::{
    bvh::{self, Aabb, Child, StackNeed},
    layout::{PackedNode, PackedTangent, PackedTriangle, PackedVertex, STACK_SIZE},
};
use glam::{DAffine3, DVec3};
use glimray_scene::{Frame, Scene};
use std::{collections::HashMap, sync::Arc};

/// Stack limit for baked geometry: the last store of a traversal step writes one entry beyond the top.
const STACK_ENTRIES: usize = STACK_SIZE as usize - 1;

/// Counts of the BVHs built to pack a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TreeWork {
    /// Mesh topologies that were built.
    pub topologies: usize,
    /// BLASes of single meshes that were refitted in world space or in their own space.
    pub refits: usize,
    /// 1 if the joint BLAS of shapes and small meshes was built.
    pub joint: usize,
    /// 1 if the tree above the baked BLASes was built.
    pub top: usize,
}

impl TreeWork {
    /// Number of BVHs built or refitted.
    pub fn total(&self) -> usize {
        self.refits + self.joint + self.top
    }
}

/// The BLAS of a mesh.
#[derive(Clone, Debug)]
pub struct MeshTree {
    pub mesh: Arc<CachedMesh>,
    /// The transform at which it is baked; `None` if it is instanced.
    world_from_object: Option<DAffine3>,
    pub blas: Arc<Blas>,
}

impl MeshTree {
    /// The input of the TLAS.
    pub fn instanced(&self) -> InstancedBlas {
        InstancedBlas {
            root: self.blas.root(),
            first: self.blas.offsets.triangle,
            count: self.blas.triangles.len() as u32,
            boxes: self.blas.boxes(),
            shape: None,
        }
    }
}

/// BVHs in the order of the arrays: those that change most often come last.
#[derive(Clone, Debug)]
pub struct Trees {
    pub instanced: Vec<MeshTree>,
    pub baked: Vec<MeshTree>,
    pub joint: Arc<Joint>,
    pub top: Arc<Top>,
    pub work: TreeWork,
    origin: DVec3,
}

/// The tree above the baked BLASes, if nothing is instanced.
#[derive(Debug)]
pub struct Top {
    /// Boxes of baked geometry, and child references.
    pub parts: Vec<(Aabb, u32)>,
    /// Node 0 of the scene.
    pub root: Arc<[PackedNode]>,
    /// The root's descendants, after all other nodes.
    pub nodes: Arc<[PackedNode]>,
    /// With the trees below; nothing if it has no nodes of its own.
    stack_need: StackNeed,
    /// That of the trees below.
    need_below: StackNeed,
    first_node: u32,
}

impl Trees {
    /// Builds the BVHs of a scene with these `meshes`, those of large ones as drafts if `drafts` is set; `previous` are those
    /// of another scene.
    pub fn build(
        previous: Option<&Self>,
        scene: &Scene,
        (rest, origin): (&Frame, DVec3),
        plan: &Plan,
        meshes: &[Arc<CachedMesh>],
        drafts: bool,
    ) -> Result<Self, PackError> {
        let previous = previous.filter(|previous| previous.origin == origin);
        let mut work = TreeWork::default();
        let known = ExistingTrees::new(previous);
        // Node 0 is the root of the baked geometry.
        let mut offsets = Offsets {
            node: 1,
            ..Offsets::default()
        };
        let mut tree = |index: usize, world_from_object: Option<DAffine3>| {
            let mesh = &meshes[index];
            let tree = MeshTree {
                mesh: mesh.clone(),
                world_from_object,
                blas: match known.find(mesh, world_from_object, offsets) {
                    Some(blas) => blas.moved_to(offsets),
                    None => {
                        let (transform, origin) = match world_from_object {
                            Some(transform) => (transform, origin),
                            None => (DAffine3::IDENTITY, DVec3::ZERO),
                        };
                        work.refits += 1;
                        // A tree that is refitted for each view has to be a good one.
                        if drafts && !scene.deformations.iter().any(|it| it.mesh == index) {
                            mesh.draft(&mut work.topologies);
                        }
                        let topology = mesh.topology(&mut work.topologies);
                        let first_vertex = offsets.vertex as usize;
                        let placed = PlacedMesh::new(&mesh.mesh, transform, origin, first_vertex)?;
                        Arc::new(Blas::refitted(&topology, placed, offsets))
                    }
                },
            };
            offsets = tree.blas.end();
            Ok(tree)
        };
        let instanced = (plan.instanced_meshes.iter())
            .map(|&mesh| tree(mesh, None))
            .collect::<Result<Vec<_>, PackError>>()?;
        let baked = (plan.baked.iter())
            .map(|baked| {
                let mesh = scene.instances[baked.index].mesh;
                tree(mesh, Some(baked.world_from_object))
            })
            .collect::<Result<Vec<_>, PackError>>()?;

        let has_instances = plan.instance_count() > 0;
        let is_alone = baked.is_empty() && !has_instances;
        let stack_size = if is_alone { STACK_ENTRIES } else { STACK_BELOW };
        let input = JointInput::new(scene, (rest, origin), plan, meshes, stack_size);
        let before = previous.map(|previous| &previous.joint);
        let joint = match before.filter(|before| before.input == input) {
            Some(before) => before.moved_to(offsets),
            None => {
                work.joint = 1;
                Arc::new(Joint::build(input, offsets)?)
            }
        };

        let shown = (baked.iter().zip(&plan.baked)).filter(|(_, baked)| baked.is_visible);
        let shown: Vec<&Blas> = (shown.map(|(tree, _)| &*tree.blas))
            .chain([&*joint.blas])
            .filter(|blas| !blas.is_empty())
            .collect();
        let first_node = joint.blas.end().node;
        let before = previous.map(|previous| &previous.top);
        let top = Top::over(&shown, has_instances, first_node, before, &mut work)?;
        Ok(Self {
            instanced,
            baked,
            joint,
            top,
            work,
            origin,
        })
    }

    /// All nodes.
    pub fn nodes(&self) -> Segments<PackedNode> {
        let trees = self.own().map(|tree| &tree.blas).chain([&self.joint.blas]);
        ([&self.top.root].into_iter())
            .chain(trees.map(|blas| &blas.nodes))
            .chain([&self.top.nodes])
            .cloned()
            .collect()
    }

    /// All triangles; those of hidden meshes are zero.
    pub fn triangles(&self, plan: &Plan) -> Segments<PackedTriangle> {
        let instanced = self
            .instanced
            .iter()
            .map(|tree| tree.blas.triangles.clone());
        let baked = (self.baked.iter().zip(&plan.baked)).map(|(tree, baked)| {
            let triangles = &tree.blas.triangles;
            match baked.is_visible {
                true => triangles.clone(),
                false => vec![PackedTriangle::default(); triangles.len()].into(),
            }
        });
        (instanced.chain(baked))
            .chain([self.joint.blas.triangles.clone()])
            .collect()
    }

    /// All vertices.
    pub fn vertices(&self) -> Segments<PackedVertex> {
        let trees = self.own().map(|tree| &tree.blas).chain([&self.joint.blas]);
        trees.map(|blas| blas.vertices.clone()).collect()
    }

    /// The tangents of all vertices; empty if there is none.
    pub fn tangents(&self) -> Segments<PackedTangent> {
        let blas = || {
            let own = self.own().map(|tree| &tree.blas);
            own.chain([&self.joint.blas])
        };
        if blas().all(|blas| blas.tangents.is_empty()) {
            return Segments::default();
        }
        let of_blas = |blas: &Arc<Blas>| match blas.tangents.is_empty() {
            true => vec![PackedTangent::default(); blas.vertices.len()].into(),
            false => blas.tangents.clone(),
        };
        blas().map(of_blas).collect()
    }

    /// The colours of all vertices; empty if there is none.
    pub fn colors(&self) -> Segments<[f32; 4]> {
        let has_colors = |mesh: &CachedMesh| !mesh.mesh.colors.is_empty();
        match self.meshes().any(has_colors) {
            true => self.meshes().map(CachedMesh::colors).collect(),
            false => Segments::default(),
        }
    }

    /// The meshes in the order of their vertices.
    pub fn meshes(&self) -> impl Iterator<Item = &CachedMesh> {
        let joint = self.joint.input.meshes.iter().map(|(mesh, _)| &**mesh);
        self.own().map(|tree| &*tree.mesh).chain(joint)
    }

    /// The vertices of each closed mesh that is no thin wall, in ascending order: the first, and the one after the last.
    pub fn solids(&self, is_thin: impl Fn(u32) -> bool) -> Vec<[u32; 4]> {
        let mut end = 0;
        let ranges = self.meshes().map(|mesh| {
            let first = end;
            end += mesh.mesh.positions.len() as u32;
            let is_wall = mesh.mesh.materials.first().is_some_and(|&it| is_thin(it));
            (!is_wall && mesh.is_closed()).then_some([first, end, 0, 0])
        });
        ranges.flatten().collect()
    }

    /// Whether some BLAS is a draft.
    pub fn has_drafts(&self) -> bool {
        self.own().any(|tree| tree.blas.is_draft)
    }

    /// The BLASes of single meshes.
    fn own(&self) -> impl Iterator<Item = &MeshTree> {
        self.instanced.iter().chain(&self.baked)
    }

    /// The most entries on the stack of a walk through these trees, without a TLAS.
    pub fn stack_need(&self) -> StackNeed {
        let joint = self.joint.blas.stack_need.max(self.top.stack_need);
        (self.own())
            .map(|tree| tree.blas.stack_need)
            .fold(joint, StackNeed::max)
    }
}

/// Existing BLASes, by mesh and transform.
struct ExistingTrees<'a>(HashMap<Key, Vec<&'a Arc<Blas>>>);

/// The mesh's address and the bits of its transform.
type Key = (usize, Option<[u64; 12]>);

impl<'a> ExistingTrees<'a> {
    fn new(trees: Option<&'a Trees>) -> Self {
        let mut known: HashMap<_, Vec<_>> = HashMap::new();
        let is_outdated = |tree: &&MeshTree| tree.blas.is_draft && !tree.mesh.is_draft();
        for tree in (trees.into_iter().flat_map(Trees::own)).filter(|tree| !is_outdated(tree)) {
            let key = key(&tree.mesh, tree.world_from_object);
            known.entry(key).or_default().push(&tree.blas);
        }
        Self(known)
    }

    /// An existing BLAS, preferably at these offsets.
    fn find(
        &self,
        mesh: &Arc<CachedMesh>,
        world_from_object: Option<DAffine3>,
        offsets: Offsets,
    ) -> Option<&'a Arc<Blas>> {
        let all = self.0.get(&key(mesh, world_from_object))?;
        let here = all.iter().find(|blas| blas.offsets == offsets);
        here.or(all.first()).copied()
    }
}

fn key(mesh: &Arc<CachedMesh>, world_from_object: Option<DAffine3>) -> Key {
    let bits = |transform: DAffine3| transform.to_cols_array().map(f64::to_bits);
    (Arc::as_ptr(mesh) as usize, world_from_object.map(bits))
}

impl Top {
    /// The tree above non-empty `trees`; if something is instanced, only their boxes are needed.
    fn over(
        trees: &[&Blas],
        has_instances: bool,
        first_node: u32,
        before: Option<&Arc<Self>>,
        work: &mut TreeWork,
    ) -> Result<Arc<Self>, PackError> {
        let alone = |parts, root: PackedNode| {
            Ok(Arc::new(Self {
                parts,
                root: [root].into(),
                nodes: Arc::default(),
                stack_need: StackNeed::default(),
                need_below: StackNeed::default(),
                first_node,
            }))
        };
        let limit = MAX_PARTS + 2 * trees.len().saturating_sub(1);
        match trees {
            _ if has_instances => {
                return alone(opened(trees.iter().copied(), limit), PackedNode::default());
            }
            [] => return alone(Vec::new(), PackedNode::default()),
            [tree] => return alone(Vec::new(), tree.nodes[0]),
            _ => {}
        }
        let parts = opened(trees.iter().copied(), limit);
        let needs = trees.iter().map(|tree| tree.stack_need);
        let need_below = needs.fold(StackNeed::default(), StackNeed::max);
        if let Some(before) = before
            && (before.first_node, before.need_below, &before.parts)
                == (first_node, need_below, &parts)
            && !before.nodes.is_empty()
        {
            return Ok(before.clone());
        }
        work.top = 1;
        let boxes: Vec<_> = parts.iter().map(|(aabb, _)| *aabb).collect();
        let limits = bvh::Limits {
            leaf_size: 1,
            alone: None,
            stack_size: STACK_ENTRIES - need_below.references,
        };
        let bvh = bvh::build(&boxes, &vec![0; boxes.len()], 1, limits);
        let stack_need = bvh.stack_need + need_below;
        if stack_need.references > STACK_ENTRIES {
            return Err(PackError::TooDeep {
                need: stack_need.references,
                limit: STACK_ENTRIES,
            });
        }
        let reference = |child: &Child| match *child {
            Child::Node(index) => first_node + index - 1,
            Child::Leaf { first, .. } => parts[bvh.order[0][first as usize] as usize].1,
        };
        let pack = |node: &bvh::WideNode| {
            let children = node.children.iter();
            let children = children.map(|(aabb, child)| (*aabb, reference(child)));
            nodes::quantize(Children::new(children).as_slice())
        };
        let (root, others) = (&bvh.nodes[..1], &bvh.nodes[1..]);
        // Room for all nodes that may be over these trees, so that an edit does not require a larger buffer.
        let spare = (limit - 1).saturating_sub(others.len());
        let unused = std::iter::repeat_n(PackedNode::default(), spare);
        let (root, nodes) = (
            root.iter().map(pack).collect(),
            others.iter().map(pack).chain(unused).collect(),
        );
        Ok(Arc::new(Self {
            root,
            nodes,
            parts,
            stack_need,
            need_below,
            first_node,
        }))
    }
}
