//! The top-level acceleration structure (TLAS), built for each frame in which an instance moves: instances,
//! their keys over the shutter interval, and nodes with moving boxes.

use super::{
    PackError, PackedScene, PackedView,
    deform::Deformed,
    geometry::in_range,
    instance::{Instance, InstancedBlas},
    nodes::{self, Children},
    placement::{Placement, aligned},
};
use crate::{
    bvh::{self, Aabb, Bvh, Child, StackNeed},
    layout::{INSTANCE, MOVING, PackedInstance, PackedKey, PackedNode, STACK_SIZE},
};
use glam::{DAffine3, DMat3, DVec3};
use glimray_scene::Frame;
use std::sync::Arc;

/// The input of the TLAS that does not depend on the frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TlasSource {
    pub origin: DVec3,
    /// Index of the first node of a view in the nodes array.
    pub first_node: u32,
    /// Boxes of baked geometry, with child references.
    pub parts: Vec<(Aabb, u32)>,
    pub blas: Vec<InstancedBlas>,
    pub instances: Vec<Instance>,
    /// The most entries on the stack of a walk through any BLAS.
    pub stack_need: StackNeed,
}

/// A packed TLAS.
#[derive(Debug, Default)]
pub struct Tlas {
    /// If any instance moves, each node is followed by the same node at the end of the shutter interval.
    pub nodes: Vec<PackedNode>,
    pub instances: Vec<PackedInstance>,
    pub keys: Vec<PackedKey>,
    /// Whether an instance moves while the shutter is open.
    pub moves: bool,
    /// Index of its first node in the nodes array.
    pub first_node: u32,
    /// The most entries on the stack of a walk through it and a BLAS below, 0 without instances.
    pub stack_need: StackNeed,
    /// The input it was built from: for each instance the transforms to world space over the shutter interval,
    /// one if it does not move; `None` if it is hidden.
    source: Arc<TlasSource>,
    deformed: Arc<Deformed>,
    worlds: Vec<Option<Vec<DAffine3>>>,
}

/// Compares the packed data.
impl PartialEq for Tlas {
    fn eq(&self, other: &Self) -> bool {
        self.nodes == other.nodes && self.instances == other.instances && self.keys == other.keys
    }
}

/// Boxes at the beginning and the end of the shutter interval. At any time, the object is inside the linear
/// interpolation between them.
#[derive(Clone, Copy)]
struct Swept {
    open: Aabb,
    close: Aabb,
}

impl PackedScene {
    /// The TLAS for the frames of a shutter interval; reuses that of `previous` if it is the same.
    pub(super) fn tlas(
        &self,
        frames: &[Frame],
        deformed: &Arc<Deformed>,
        previous: Option<&PackedView>,
    ) -> Result<Arc<Tlas>, PackError> {
        let source = &self.tlas_source;
        let worlds: Vec<_> = (source.instances.iter())
            .map(|instance| instance.worlds(frames))
            .collect();
        if let Some(before) = previous.map(|previous| &previous.tlas)
            && Arc::ptr_eq(&before.source, source)
            && before.deformed.is_same(deformed)
            && before.worlds == worlds
        {
            return Ok(before.clone());
        }
        Ok(Arc::new(Tlas::build(source, deformed, worlds)?))
    }
}

impl Instance {
    fn worlds(&self, frames: &[Frame]) -> Option<Vec<DAffine3>> {
        if !self.source.is_visible(&frames[0]) {
            return None;
        }
        let world_from_tree = |frame| self.source.world_from_tree(frame);
        let worlds = frames.iter().map(world_from_tree);
        let mut worlds = worlds.collect::<Option<Vec<_>>>()?;
        if worlds.iter().all(|world| *world == worlds[0]) {
            worlds.truncate(1);
        }
        Some(worlds)
    }
}

impl Tlas {
    /// The TLAS of a scene without instances.
    pub fn empty(first_node: u32) -> Self {
        Self {
            first_node,
            ..Self::default()
        }
    }

    fn build(
        source: &Arc<TlasSource>,
        deformed: &Arc<Deformed>,
        worlds: Vec<Option<Vec<DAffine3>>>,
    ) -> Result<Self, PackError> {
        let mut tlas = Self {
            source: source.clone(),
            deformed: deformed.clone(),
            first_node: source.first_node + deformed.node_count(),
            ..Self::default()
        };
        // Boxes and child references: first parts of baked geometry, then instances.
        let (mut boxes, mut references) = (Vec::new(), Vec::new());
        for &(aabb, reference) in &source.parts {
            boxes.push(at_rest(aabb));
            references.push(reference);
        }
        for (id, worlds) in worlds.iter().enumerate() {
            if let Some(worlds) = worlds {
                boxes.push(tlas.add(id, worlds)?);
                references.push(INSTANCE | (tlas.instances.len() - 1) as u32);
            }
        }
        tlas.worlds = worlds;
        tlas.moves = tlas.instances.iter().any(|instance| instance.key_count > 1);
        // One stack entry returns from a BLAS, and the last store of a traversal step writes one entry beyond
        // the top.
        let limit = STACK_SIZE as usize - 2;
        let below = source.stack_need.max(deformed.stack_need());
        let limits = bvh::Limits {
            leaf_size: 1,
            alone: None,
            stack_size: limit.saturating_sub(below.references),
        };
        let unions: Vec<_> = (boxes.iter())
            .map(|swept| swept.open.union(swept.close))
            .collect();
        // Leaves hold a single box, so the groups do not matter.
        let bvh = bvh::build(&unions, &vec![0; unions.len()], 1, limits);
        let need = bvh.stack_need + below;
        if need.references > limit {
            let need = need.references;
            return Err(PackError::TooDeep { need, limit });
        }
        // One entry returns from a BLAS.
        tlas.stack_need = StackNeed {
            references: need.references + 1,
            nodes: need.nodes + 1,
        };
        tlas.nodes = pack_nodes(&bvh, &boxes, &references, tlas.first_node, tlas.moves);
        Ok(tlas)
    }

    /// Adds the instance with this index, and its keys if it moves.
    fn add(&mut self, id: usize, worlds: &[DAffine3]) -> Result<Swept, PackError> {
        let Instance { blas, source } = &self.source.instances[id];
        let to_render = DAffine3::from_translation(-self.source.origin);
        let deformed = self.deformed.tree(*blas);
        let blas = deformed.map_or(&self.source.blas[*blas], |tree| &tree.instanced);
        for &world in worlds {
            let (min, max) = blas.bounds(to_render * world);
            in_range(min.abs().max(max.abs()).max_element())?;
        }
        let first = to_render * worlds[0];
        let pattern = pattern_rows(to_render * source.pattern_from_tree(worlds[0]));
        let linear = rows(first.matrix3);
        let inverse = rows(first.matrix3.inverse());
        let mut instance = PackedInstance {
            translation: first.translation.as_vec3().into(),
            root: blas.root,
            inverse_x: inverse[0],
            first: blas.first,
            inverse_y: inverse[1],
            count: blas.count,
            inverse_z: inverse[2],
            key_count: 1,
            linear_x: linear[0],
            first_key: self.keys.len() as u32,
            linear_y: linear[1],
            id: id as u32 + 1,
            linear_z: linear[2],
            next_key: deformed.map_or(0, |tree| tree.next_key),
            pattern_x: pattern[0],
            pattern_y: pattern[1],
            pattern_z: pattern[2],
        };
        let swept = if worlds.len() == 1 {
            let (min, max) = blas.bounds(first);
            at_rest(rounded_outwards(min, max))
        } else {
            let keys = (worlds.iter()).map(|&world| Placement::of(to_render * world));
            let keys = aligned(keys.collect());
            instance.key_count = keys.len() as u32;
            self.keys.extend(keys.iter().map(Placement::packed));
            sweep(blas, &keys)
        };
        self.instances.push(instance);
        Ok(swept)
    }
}

fn rows(matrix: DMat3) -> [[f32; 3]; 3] {
    [0, 1, 2].map(|i| matrix.row(i).as_vec3().into())
}

fn pattern_rows(transform: DAffine3) -> [[f32; 4]; 3] {
    [0, 1, 2].map(|i| {
        let row = transform.matrix3.row(i);
        [row.x, row.y, row.z, transform.translation[i]].map(|c| c as f32)
    })
}

fn at_rest(aabb: Aabb) -> Swept {
    Swept {
        open: aabb,
        close: aabb,
    }
}

/// Rounds to f32, with a margin for the rounding error of transforming a ray into the space of an instance.
fn rounded_outwards(min: DVec3, max: DVec3) -> Aabb {
    let size = min.abs().max(max.abs()).max_element() + (max - min).max_element();
    let slack = size * 16.0 * f64::from(f32::EPSILON);
    Aabb {
        min: (min - slack).as_vec3(),
        max: (max + slack).as_vec3(),
    }
}

/// Boxes whose linear interpolation bounds a moving BLAS. They bound it at all keys and at steps between, plus
/// half of its maximum deviation from linear motion between neighbouring steps.
fn sweep(blas: &InstancedBlas, keys: &[Placement]) -> Swept {
    let last = (keys.len() - 1) as f64;
    let mut boxes = vec![(0.0, blas.bounds(keys[0].transform()))];
    let mut stray = DVec3::ZERO;
    for (i, pair) in keys.windows(2).enumerate() {
        let start = boxes.len() - 1;
        let steps = steps_between(&pair[0], &pair[1]);
        for step in 1..=steps {
            let fraction = f64::from(step) / f64::from(steps);
            let placement = match step == steps {
                true => pair[1],
                false => pair[0].between(&pair[1], fraction),
            };
            boxes.push((
                (i as f64 + fraction) / last,
                blas.bounds(placement.transform()),
            ));
        }
        for three in boxes[start..].windows(3) {
            let [(_, before), (_, (min, max)), (_, after)] = [three[0], three[1], three[2]];
            stray = stray
                .max((before.0 + after.0) * 0.5 - min)
                .max(max - (before.1 + after.1) * 0.5);
        }
    }
    let ((_, open), (_, close)) = (boxes[0], boxes[boxes.len() - 1]);
    // The distances by which both boxes must be enlarged.
    let (mut below, mut above) = (DVec3::ZERO, DVec3::ZERO);
    for &(fraction, (min, max)) in &boxes {
        below = below.max(open.0.lerp(close.0, fraction) - min);
        above = above.max(max - open.1.lerp(close.1, fraction));
    }
    let end = |(min, max): (DVec3, DVec3)| {
        rounded_outwards(min - below - stray * 0.5, max + above + stray * 0.5)
    };
    Swept {
        open: end(open),
        close: end(close),
    }
}

/// The number of steps between two keys: more for a large rotation, as in a jump cut, where a box may be larger
/// in between than at both ends and the middle.
fn steps_between(from: &Placement, to: &Placement) -> u32 {
    const MAX_TURN: f64 = 0.25;
    if from.rotation.angle_between(to.rotation) > MAX_TURN {
        16
    } else {
        2
    }
}

/// The packed nodes. References to them start at `first_node`.
fn pack_nodes(
    bvh: &Bvh,
    boxes: &[Swept],
    references: &[u32],
    first_node: u32,
    moves: bool,
) -> Vec<PackedNode> {
    let place = |first: u32| bvh.order[0][first as usize] as usize;
    let reference = |child: &Child| match *child {
        Child::Node(index) if moves => (first_node + 2 * index) | MOVING,
        Child::Node(index) => first_node + index,
        Child::Leaf { first, .. } => references[place(first)],
    };
    let children = |node: &bvh::WideNode| {
        let children = node.children.iter();
        Children::new(children.map(|(aabb, child)| (*aabb, reference(child))))
    };
    if !moves {
        let pack = |node| nodes::quantize(children(node).as_slice());
        return bvh.nodes.iter().map(pack).collect();
    }
    // Children come after their parents, so one backward pass computes the boxes of all nodes.
    let mut bounds = vec![at_rest(Aabb::EMPTY); bvh.nodes.len()];
    let mut packed = vec![PackedNode::default(); 2 * bvh.nodes.len()];
    for (i, node) in bvh.nodes.iter().enumerate().rev() {
        let swept = |child: &Child| match *child {
            Child::Node(index) => bounds[index as usize],
            Child::Leaf { first, .. } => boxes[place(first)],
        };
        let at = |end: fn(&Swept) -> Aabb| {
            let children = node.children.iter();
            Children::new(children.map(|(_, child)| (end(&swept(child)), reference(child))))
        };
        let (open, close) = (at(|swept| swept.open), at(|swept| swept.close));
        packed[2 * i] = nodes::quantize(open.as_slice());
        packed[2 * i + 1] = nodes::quantize(close.as_slice());
        bounds[i] = Swept {
            open: open.bounds(),
            close: close.bounds(),
        };
    }
    packed
}
