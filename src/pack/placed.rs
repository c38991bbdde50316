//! What is placed by instances instead of being laid out in the world: meshes that stand in several
//! places, and all that moves.

use super::{Forest, PackError, forest::Tree, geometry::Flat, light};
use crate::{
    bvh::Aabb,
    layout::NO_INSTANCE,
    scene::{Frame, Geometry, LightProperty, ObjectRef, Scene, Target},
};
use glam::{DAffine3, DVec3};

/// Copies of a mesh are laid out in the world if they have at most this many triangles together: rays
/// need no way into the space of an instance then.
pub const MOST_LAID_OUT: usize = 1 << 14;

/// Bound on the traversal stack of trees that have another above them, for which it leaves room.
pub const PLACED_STACK: usize = 60;

/// A tree and how it comes into the world.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Index among the trees that are placed.
    pub tree: usize,
    pub carrier: Carrier,
}

/// What says where a placed tree is.
#[derive(Clone, Copy, Debug)]
pub enum Carrier {
    /// A transform into the world.
    World(DAffine3),
    /// A node that moves, and a transform into its space.
    Node(usize, DAffine3),
    /// A light that rays can see.
    Lamp(usize),
}

/// A tree that is placed.
#[derive(Clone, Debug)]
pub struct PlacedTree {
    pub tree: Tree,
    /// Set for shapes, whose bounds are exact in any place.
    pub shape: Option<Geometry>,
}

/// What of a scene is laid out, and what is placed.
#[derive(Debug, Default)]
pub struct Plan {
    /// Instances that are laid out.
    pub still_instances: Vec<usize>,
    /// Shapes that are laid out.
    pub still_shapes: Vec<usize>,
    /// Lights whose surfaces are laid out.
    pub still_lamps: Vec<usize>,
    /// Indices of instances, and what carries them.
    meshes: Vec<(usize, Carrier)>,
    /// Indices of shapes, and their nodes.
    shapes: Vec<(usize, usize)>,
    lamps: Vec<usize>,
}

impl Plan {
    /// Lays out what stands still, but for meshes of which there are many large copies.
    pub fn new(scene: &Scene, rest: &Frame, most_laid_out: usize) -> Self {
        let moving = scene.moving_nodes();
        let moving_node = |node: Option<usize>| node.filter(|&node| moving[node]);
        let is_there = |node: Option<usize>| node.is_none_or(|node| rest.nodes[node].visible);
        let mut copies = vec![0_usize; scene.meshes.len()];
        for instance in &scene.instances {
            copies[instance.mesh] += 1;
        }
        let mut plan = Self::default();
        for (index, instance) in scene.instances.iter().enumerate() {
            let triangles = copies[instance.mesh] * scene.meshes[instance.mesh].triangles.len();
            let is_shared = copies[instance.mesh] > 1 && triangles > most_laid_out;
            if let Some(node) = moving_node(instance.node) {
                let carrier = Carrier::Node(node, instance.placement);
                plan.meshes.push((index, carrier));
            } else if is_there(instance.node) && is_shared {
                let carrier = Carrier::World(world_from(rest, instance.node) * instance.placement);
                plan.meshes.push((index, carrier));
            } else if is_there(instance.node) {
                plan.still_instances.push(index);
            }
        }
        for (index, shape) in scene.shapes.iter().enumerate() {
            if let Some(node) = moving_node(shape.node) {
                plan.shapes.push((index, node));
            } else if is_there(shape.node) {
                plan.still_shapes.push(index);
            }
        }
        for index in light::visible(scene) {
            let node = scene.lights[index].node;
            if moving_node(node).is_some() || has_moving_surface(scene, index) {
                plan.lamps.push(index);
            } else if is_there(node) {
                plan.still_lamps.push(index);
            }
        }
        plan
    }

    /// Whether everything is laid out.
    pub fn is_still(&self) -> bool {
        self.meshes.is_empty() && self.shapes.is_empty() && self.lamps.is_empty()
    }

    /// Number of instances.
    pub fn placed_count(&self) -> usize {
        self.meshes.len() + self.shapes.len() + self.lamps.len()
    }

    /// What is placed, in the order of [`Self::plant`].
    pub fn placed_objects(&self) -> impl Iterator<Item = ObjectRef> + '_ {
        let instances = (self.meshes.iter()).map(|(index, _)| ObjectRef::Instance(*index));
        let shapes = (self.shapes.iter()).map(|(index, _)| ObjectRef::Shape(*index));
        let lamps = (self.lamps.iter()).map(|index| ObjectRef::Light(*index));
        instances.chain(shapes).chain(lamps)
    }

    /// Builds the trees that are placed, each mesh once.
    pub fn plant(
        &self,
        scene: &Scene,
        flat: &mut Flat,
        forest: &mut Forest,
    ) -> Result<(Vec<PlacedTree>, Vec<Placed>), PackError> {
        let (count, limit) = (self.placed_count(), NO_INSTANCE as usize);
        if count > limit {
            let what = "instances";
            return Err(PackError::TooMany { what, count, limit });
        }
        let mut trees = Vec::new();
        let mut placed = Vec::with_capacity(count);
        let mut tree_of_mesh = vec![None; scene.meshes.len()];
        for &(index, carrier) in &self.meshes {
            let mesh = scene.instances[index].mesh;
            let tree = match tree_of_mesh[mesh] {
                Some(tree) => tree,
                None => {
                    let start = flat.mark();
                    flat.add_mesh(&scene.meshes[mesh], DAffine3::IDENTITY, DVec3::ZERO)?;
                    trees.push(PlacedTree {
                        tree: flat.plant_from(start, forest),
                        shape: None,
                    });
                    *tree_of_mesh[mesh].insert(trees.len() - 1)
                }
            };
            placed.push(Placed { tree, carrier });
        }
        let mut add_shape = |geometry: &Geometry, material, id, carrier| {
            let start = flat.mark();
            flat.add_shape(geometry, material, id, None)?;
            trees.push(PlacedTree {
                tree: flat.plant_from(start, forest),
                shape: Some(*geometry),
            });
            let tree = trees.len() - 1;
            placed.push(Placed { tree, carrier });
            Ok(())
        };
        for &(index, node) in &self.shapes {
            let shape = &scene.shapes[index];
            let carrier = Carrier::Node(node, DAffine3::IDENTITY);
            add_shape(&shape.geometry, shape.material, index, carrier)?;
        }
        for &index in &self.lamps {
            let (material, id) = light::material_and_id(scene, index);
            let Some(surface) = light::unit_surface(&scene.lights[index].kind) else {
                continue;
            };
            add_shape(&surface, material, id, Carrier::Lamp(index))?;
        }
        Ok((trees, placed))
    }
}

/// From the space of a node to the world's.
pub fn world_from(frame: &Frame, node: Option<usize>) -> DAffine3 {
    node.map_or(DAffine3::IDENTITY, |node| frame.nodes[node].world_from_node)
}

/// Whether a track changes where a light is or whether it is there.
fn has_moving_surface(scene: &Scene, light: usize) -> bool {
    use LightProperty::{Direction, On, Position};
    let targets = scene.tracks.iter().flat_map(|track| &track.targets);
    targets.copied().any(|target| {
        [Direction, On, Position]
            .into_iter()
            .any(|property| target == Target::Light(light, property))
    })
}

impl Carrier {
    /// From the tree's space to the world's, or `None` where it is hidden.
    pub fn world_from_tree(&self, frame: &Frame) -> Option<DAffine3> {
        match *self {
            Self::World(placement) => Some(placement),
            Self::Node(node, placement) => Some(frame.nodes[node].world_from_node * placement),
            Self::Lamp(index) => light::world_from_unit(&frame.lights[index].kind),
        }
    }

    /// Whether it is there at all.
    pub fn is_visible(&self, frame: &Frame) -> bool {
        match *self {
            Self::World(_) => true,
            Self::Node(node, _) => frame.nodes[node].visible,
            Self::Lamp(index) => frame.lights[index].visible,
        }
    }

    /// From the tree's space to where patterns in space are looked up: they stand still for what
    /// carries the tree.
    pub fn pattern_from_tree(&self, world_from_tree: DAffine3) -> DAffine3 {
        match *self {
            Self::Node(_, placement) => placement,
            Self::World(_) | Self::Lamp(_) => world_from_tree,
        }
    }
}

impl PlacedTree {
    /// The box round it in the space that the transform leads to.
    pub fn bounds(&self, transform: DAffine3) -> (DVec3, DVec3) {
        if let Some(geometry) = &self.shape {
            return geometry.placed(transform).bounds().unwrap_or_default();
        }
        let parts = self
            .tree
            .parts
            .iter()
            .map(|(aabb, _)| box_of(*aabb, transform));
        parts
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
            .unwrap_or((transform.translation, transform.translation))
    }
}

/// The box round a transformed box.
fn box_of(aabb: Aabb, transform: DAffine3) -> (DVec3, DVec3) {
    let (min, max) = (aabb.min.as_dvec3(), aabb.max.as_dvec3());
    let center = transform.transform_point3((min + max) * 0.5);
    let half = (max - min) * 0.5;
    let matrix = transform.matrix3;
    let reach =
        matrix.x_axis.abs() * half.x + matrix.y_axis.abs() * half.y + matrix.z_axis.abs() * half.z;
    (center - reach, center + reach)
}
