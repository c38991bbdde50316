//! Decides which objects are baked into the world and which become instances with their own BLAS: meshes with
//! several copies, and everything that moves or deforms.

use super::{PackError, light};
use crate::{bvh::Aabb, layout::NO_INSTANCE};
use glam::{DAffine3, DVec3};
use glimray_scene::{Deformation, Frame, Geometry, LightProperty, ObjectRef, Scene, Target};
use std::collections::HashMap;

/// Copies of a static mesh are baked into the world if they have at most this many triangles in total: rays
/// then need no transform into the space of an instance.
pub const MAX_BAKED: usize = 1 << 14;

/// Static meshes of at most this many triangles are merged into the joint BLAS ...
const MAX_IN_SMALL: usize = 1 << 11;
/// ... up to this total, which bounds the time to rebuild it.
const MAX_JOINT: usize = 1 << 14;

/// An instance of a BLAS.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// Index among the instanced BLASes.
    pub blas: usize,
    pub source: TransformSource,
}

/// The source of the transform of an instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TransformSource {
    /// A static transform to world space.
    World(DAffine3),
    /// A moving node, and a transform to its space.
    Node(usize, DAffine3),
    /// A node that only hides it, and a static transform to world space.
    Switch(usize, DAffine3),
    /// A visible light.
    Lamp(usize),
}

/// An instanced BLAS, as the TLAS builder needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct InstancedBlas {
    /// Child reference to its root.
    pub root: u32,
    /// The first primitive, with [`crate::layout::SHAPE`] for a shape.
    pub first: u32,
    /// Number of primitives.
    pub count: u32,
    /// Boxes that together bound it, in its own space.
    pub boxes: Vec<Aabb>,
    /// Set for shapes, whose bounds are computed exactly for any transform.
    pub shape: Option<Geometry>,
}

/// A static mesh baked as a BLAS of its own.
#[derive(Debug)]
pub struct Baked {
    /// Index of the instance in the scene.
    pub index: usize,
    pub world_from_object: DAffine3,
    pub is_visible: bool,
}

/// The assignment of objects to baked and instanced BLASes.
#[derive(Debug, Default)]
pub struct Plan {
    pub baked: Vec<Baked>,
    /// Indices of the instances in the joint BLAS, and their transforms.
    pub joint: Vec<(usize, DAffine3)>,
    /// Shapes in the joint BLAS, and planes.
    pub joint_shapes: Vec<usize>,
    /// Lights whose surfaces are in the joint BLAS.
    pub joint_lamps: Vec<usize>,
    /// Meshes with an instanced BLAS.
    pub instanced_meshes: Vec<usize>,
    /// Indices of instances in the scene, indices of their meshes in `instanced_meshes`, and their transform
    /// sources.
    pub instances: Vec<(usize, usize, TransformSource)>,
    /// Indices of moving shapes, and their nodes.
    pub shapes: Vec<(usize, usize)>,
    /// Visible lights that move.
    pub lamps: Vec<usize>,
}

impl Plan {
    /// Bakes static objects, except meshes that deform or have many large copies. Hidden objects count towards the joint
    /// limit, so that showing one changes no other BLAS.
    ///
    /// # Errors
    /// There are too many instances.
    pub fn new(
        scene: &Scene,
        (rest, origin): (&Frame, DVec3),
        most_baked: usize,
    ) -> Result<Self, PackError> {
        let moving = scene.moving_nodes();
        let object_from_tree = object_from_tree(scene, origin);
        let moving_node = |node: Option<usize>| node.filter(|&node| moving[node]);
        let is_visible_at_rest =
            |node: Option<usize>| node.is_none_or(|node| rest.nodes[node].visible);
        let mut copies = vec![0_usize; scene.meshes.len()];
        for instance in &scene.instances {
            copies[instance.mesh] += 1;
        }
        let mut plan = Self::default();
        let mut place_of_mesh = vec![None; scene.meshes.len()];
        let mut room = MAX_JOINT;
        for (index, instance) in scene.instances.iter().enumerate() {
            let triangles = scene.meshes[instance.mesh].triangles.len();
            let is_visible = is_visible_at_rest(instance.node);
            let is_shared =
                copies[instance.mesh] > 1 && copies[instance.mesh] * triangles > most_baked;
            let world_from_object = world_from(rest, scene.node_of(instance)) * instance.placement;
            let deforming = object_from_tree.get(&instance.mesh);
            let from_tree = deforming.copied().unwrap_or_default();
            let source = match (moving_node(instance.node), scene.node_of(instance)) {
                (Some(node), None) => Some(TransformSource::Switch(
                    node,
                    instance.placement * from_tree,
                )),
                (Some(node), _) => {
                    Some(TransformSource::Node(node, instance.placement * from_tree))
                }
                (None, _) => (is_shared || deforming.is_some())
                    .then_some(TransformSource::World(world_from_object * from_tree)),
            };
            match source {
                Some(TransformSource::World(_)) if !is_visible => {}
                Some(source) => {
                    let meshes = &mut plan.instanced_meshes;
                    let place = *place_of_mesh[instance.mesh].get_or_insert_with(|| {
                        meshes.push(instance.mesh);
                        meshes.len() - 1
                    });
                    plan.instances.push((index, place, source));
                }
                None if triangles <= MAX_IN_SMALL.min(room) => {
                    room -= triangles;
                    if is_visible {
                        plan.joint.push((index, world_from_object));
                    }
                }
                None => plan.baked.push(Baked {
                    index,
                    world_from_object,
                    is_visible,
                }),
            }
        }
        for (index, shape) in scene.shapes.iter().enumerate() {
            if let Some(node) = moving_node(shape.node) {
                plan.shapes.push((index, node));
            } else if is_visible_at_rest(shape.node) {
                plan.joint_shapes.push(index);
            }
        }
        for index in light::visible(scene) {
            let node = scene.lights[index].node;
            if moving_node(node).is_some() || has_moving_surface(scene, index) {
                plan.lamps.push(index);
            } else if is_visible_at_rest(node) {
                plan.joint_lamps.push(index);
            }
        }
        let (count, limit) = (plan.instance_count(), NO_INSTANCE as usize);
        match count > limit {
            false => Ok(plan),
            true => Err(PackError::TooMany {
                what: "instances",
                count,
                limit,
            }),
        }
    }

    /// Number of instances.
    pub fn instance_count(&self) -> usize {
        self.instances.len() + self.shapes.len() + self.lamps.len()
    }

    /// The instanced objects: meshes, then shapes, then lamps.
    pub fn instanced_objects(&self) -> impl Iterator<Item = ObjectRef> + '_ {
        let instances = (self.instances.iter()).map(|(index, ..)| ObjectRef::Instance(*index));
        let shapes = (self.shapes.iter()).map(|(index, _)| ObjectRef::Shape(*index));
        let lamps = (self.lamps.iter()).map(|index| ObjectRef::Light(*index));
        instances.chain(shapes).chain(lamps)
    }
}

/// For each mesh that deforms, the transform from the space of its BLAS to object space. A skin gives world
/// positions, which are most precise around the render origin.
fn object_from_tree(scene: &Scene, origin: DVec3) -> HashMap<usize, DAffine3> {
    let transform =
        |deformation: &Deformation| DAffine3::from_translation(tree_origin(deformation, origin));
    let deformations = scene.deformations.iter();
    deformations.map(|it| (it.mesh, transform(it))).collect()
}

/// The origin of the space of its BLAS.
pub fn tree_origin(deformation: &Deformation, origin: DVec3) -> DVec3 {
    match deformation.skin {
        Some(_) => origin,
        None => DVec3::ZERO,
    }
}

/// The transform from a node to world space.
pub fn world_from(frame: &Frame, node: Option<usize>) -> DAffine3 {
    node.map_or(DAffine3::IDENTITY, |node| frame.nodes[node].world_from_node)
}

/// Whether a track changes the position, direction or visibility of a light.
fn has_moving_surface(scene: &Scene, light: usize) -> bool {
    use LightProperty::{Direction, On, Position};
    let targets = scene.tracks.iter().flat_map(|track| &track.targets);
    targets.copied().any(|target| {
        [Direction, On, Position]
            .into_iter()
            .any(|property| target == Target::Light(light, property))
    })
}

impl TransformSource {
    /// The transform from BLAS to world space; `None` if the object is hidden.
    pub fn world_from_tree(&self, frame: &Frame) -> Option<DAffine3> {
        match *self {
            Self::World(placement) | Self::Switch(_, placement) => Some(placement),
            Self::Node(node, placement) => Some(frame.nodes[node].world_from_node * placement),
            Self::Lamp(index) => light::world_from_unit(&frame.lights[index].kind),
        }
    }

    /// Whether the object is visible.
    pub fn is_visible(&self, frame: &Frame) -> bool {
        match *self {
            Self::World(_) => true,
            Self::Node(node, _) | Self::Switch(node, _) => frame.nodes[node].visible,
            Self::Lamp(index) => frame.lights[index].visible,
        }
    }

    /// The transform from BLAS space to the lookup position of solid textures, which stay fixed relative to the
    /// moving node.
    pub fn pattern_from_tree(&self, world_from_tree: DAffine3) -> DAffine3 {
        match *self {
            Self::Node(_, placement) => placement,
            Self::World(_) | Self::Switch(..) | Self::Lamp(_) => world_from_tree,
        }
    }
}

impl InstancedBlas {
    /// The bounding box in the space that `transform` leads to.
    pub fn bounds(&self, transform: DAffine3) -> (DVec3, DVec3) {
        if let Some(geometry) = &self.shape {
            return geometry.placed(transform).bounds().unwrap_or_default();
        }
        let boxes = self.boxes.iter().map(|aabb| box_of(*aabb, transform));
        boxes
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            .unwrap_or((transform.translation, transform.translation))
    }
}

/// The bounding box of a transformed box.
fn box_of(aabb: Aabb, transform: DAffine3) -> (DVec3, DVec3) {
    let (min, max) = (aabb.min.as_dvec3(), aabb.max.as_dvec3());
    let center = transform.transform_point3((min + max) * 0.5);
    let half = (max - min) * 0.5;
    let matrix = transform.matrix3;
    let reach =
        matrix.x_axis.abs() * half.x + matrix.y_axis.abs() * half.y + matrix.z_axis.abs() * half.z;
    (center - reach, center + reach)
}
