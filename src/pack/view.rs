//! The tree over what is placed, made anew for each shot: instances, their keys while the shutter is
//! open, and nodes whose boxes follow the movement.

use super::{
    PackError, PackedScene,
    geometry::in_range,
    nodes,
    placed::{Placed, PlacedTree, VIEW_STACK},
    placement::{Placement, aligned},
};
use crate::{
    bvh::{self, Aabb, Child},
    layout::{INSTANCE, MOVING, PackedInstance, PackedKey, PackedNode},
    scene::Frame,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// Groups of boxes: parts of the tree of what stands still, and instances.
const PARTS: u8 = 0;
const INSTANCES: u8 = 1;

/// What is placed, as the GPU wants it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placements {
    /// Each followed by the same node at the end of the shot if anything moves.
    pub nodes: Vec<PackedNode>,
    pub instances: Vec<PackedInstance>,
    pub keys: Vec<PackedKey>,
    /// Whether an instance moves while the shutter is open.
    pub moves: bool,
}

/// Boxes at the beginning and at the end of a shot. What moves is at any time in the box that lies in
/// proportion between them.
#[derive(Clone, Copy)]
struct Swept {
    open: Aabb,
    close: Aabb,
}

impl PackedScene {
    /// Places the trees as the frames of a shot say. `first_node` is the index that the first node will
    /// have.
    pub(super) fn placements(
        &self,
        frames: &[Frame],
        first_node: u32,
    ) -> Result<Placements, PackError> {
        let mut view = Placements::default();
        let mut boxes = Vec::new();
        let mut references = [Vec::new(), Vec::new()];
        for &(aabb, reference) in &self.still_parts {
            boxes.push(still(aabb));
            references[PARTS as usize].push(reference);
        }
        for (id, placed) in self.placed.iter().enumerate() {
            if let Some(swept) = self.place(placed, id as u32, frames, &mut view)? {
                boxes.push(swept);
                references[INSTANCES as usize].push(INSTANCE | (view.instances.len() - 1) as u32);
            }
        }
        view.moves = view.instances.iter().any(|instance| instance.key_count > 1);
        let mut groups = vec![PARTS; self.still_parts.len()];
        groups.resize(boxes.len(), INSTANCES);
        view.nodes = tree(&boxes, &groups, &references, first_node, view.moves);
        Ok(view)
    }

    /// Adds one instance, and its keys if it moves; `None` where it is hidden.
    fn place(
        &self,
        placed: &Placed,
        id: u32,
        frames: &[Frame],
        view: &mut Placements,
    ) -> Result<Option<Swept>, PackError> {
        if !placed.carrier.is_visible(&frames[0]) {
            return Ok(None);
        }
        let world_from_tree = |frame| placed.carrier.world_from_tree(frame);
        let Some(worlds) = frames
            .iter()
            .map(world_from_tree)
            .collect::<Option<Vec<_>>>()
        else {
            return Ok(None);
        };
        let to_render = DAffine3::from_translation(-self.origin);
        let tree = &self.placed_trees[placed.tree];
        for &world in &worlds {
            let (min, max) = tree.bounds(to_render * world);
            in_range(min.abs().max(max.abs()).max_element())?;
        }
        let first = to_render * worlds[0];
        let to_pattern = placed.carrier.pattern_from_tree(&self.moving, worlds[0]);
        let pattern = pattern_rows(to_render * to_pattern);
        let linear = rows(first.matrix3);
        let inverse = rows(first.matrix3.inverse());
        let mut instance = PackedInstance {
            translation: first.translation.as_vec3().into(),
            root: tree.tree.root,
            inverse_x: inverse[0],
            first: tree.tree.first,
            inverse_y: inverse[1],
            count: tree.tree.count,
            inverse_z: inverse[2],
            key_count: 1,
            linear_x: linear[0],
            first_key: view.keys.len() as u32,
            linear_y: linear[1],
            id: id + 1,
            linear_z: linear[2],
            pattern_x: pattern[0],
            pattern_y: pattern[1],
            pattern_z: pattern[2],
            ..Default::default()
        };
        let swept = if worlds.iter().all(|world| *world == worlds[0]) {
            let (min, max) = tree.bounds(first);
            still(rounded_outwards(min, max))
        } else {
            let keys = (worlds.iter()).map(|&world| Placement::of(to_render * world));
            let keys = aligned(keys.collect());
            instance.key_count = keys.len() as u32;
            view.keys.extend(keys.iter().map(Placement::packed));
            sweep(tree, &keys)
        };
        view.instances.push(instance);
        Ok(Some(swept))
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

fn still(aabb: Aabb) -> Swept {
    Swept {
        open: aabb,
        close: aabb,
    }
}

/// In f32, with room for what rounds on a ray's way into the space of an instance.
fn rounded_outwards(min: DVec3, max: DVec3) -> Aabb {
    let size = min.abs().max(max.abs()).max_element() + (max - min).max_element();
    let slack = size * 16.0 * f64::from(f32::EPSILON);
    Aabb {
        min: (min - slack).as_vec3(),
        max: (max + slack).as_vec3(),
    }
}

/// Boxes between which a tree stays. They hold it at all keys and half-way between, and half as much
/// more as it strays between from where the boxes of the keys would have it.
fn sweep(tree: &PlacedTree, keys: &[Placement]) -> Swept {
    let last = 2 * (keys.len() - 1);
    let at = |step: usize| {
        let placement = match step % 2 {
            0 => keys[step / 2],
            _ => keys[step / 2].between(&keys[step / 2 + 1], 0.5),
        };
        tree.bounds(placement.transform())
    };
    let boxes: Vec<_> = (0..=last).map(at).collect();
    // How far the two boxes must move outwards.
    let (mut below, mut above) = (DVec3::ZERO, DVec3::ZERO);
    let mut stray = DVec3::ZERO;
    for (step, (min, max)) in boxes.iter().enumerate() {
        let share = step as f64 / last as f64;
        below = below.max(boxes[0].0.lerp(boxes[last].0, share) - *min);
        above = above.max(*max - boxes[0].1.lerp(boxes[last].1, share));
        if step % 2 == 1 {
            let (before, after) = (boxes[step - 1], boxes[step + 1]);
            stray = stray
                .max((before.0 + after.0) * 0.5 - *min)
                .max(*max - (before.1 + after.1) * 0.5);
        }
    }
    let end = |(min, max): (DVec3, DVec3)| {
        rounded_outwards(min - below - stray * 0.5, max + above + stray * 0.5)
    };
    Swept {
        open: end(boxes[0]),
        close: end(boxes[last]),
    }
}

/// The nodes over all boxes. References to the nodes themselves count from `first_node`.
fn tree(
    boxes: &[Swept],
    groups: &[u8],
    references: &[Vec<u32>; 2],
    first_node: u32,
    moves: bool,
) -> Vec<PackedNode> {
    let unions: Vec<_> = boxes
        .iter()
        .map(|swept| swept.open.union(swept.close))
        .collect();
    let limits = bvh::Limits {
        leaf_size: 1,
        stack_size: VIEW_STACK,
    };
    let bvh = bvh::build(&unions, groups, references.len(), limits);
    let place = |group: u8, first: u32| bvh.order[group as usize][first as usize] as usize;
    let part_count = references[PARTS as usize].len();
    let reference = |child: &Child| match *child {
        Child::Node(index) if moves => (first_node + 2 * index) | MOVING,
        Child::Node(index) => first_node + index,
        Child::Leaf { group, first, .. } => {
            let offset = if group == PARTS { 0 } else { part_count };
            references[group as usize][place(group, first) - offset]
        }
    };
    if !moves {
        let pack = |node| nodes::quantize(node, reference);
        return bvh.nodes.iter().map(pack).collect();
    }
    // Children come after their parents, so one pass backwards knows the boxes of all nodes.
    let nothing = Aabb {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };
    let mut bounds = vec![still(nothing); bvh.nodes.len()];
    let mut packed = vec![PackedNode::default(); 2 * bvh.nodes.len()];
    for (i, node) in bvh.nodes.iter().enumerate().rev() {
        let swept_of = |child: &Child| match *child {
            Child::Node(index) => bounds[index as usize],
            Child::Leaf { group, first, .. } => boxes[place(group, first)],
        };
        let (mut open, mut close) = (node.clone(), node.clone());
        let mut own = still(nothing);
        for (k, (_, child)) in node.children.iter().enumerate() {
            let swept = swept_of(child);
            open.children[k].0 = swept.open;
            close.children[k].0 = swept.close;
            own.open = own.open.union(swept.open);
            own.close = own.close.union(swept.close);
        }
        bounds[i] = own;
        packed[2 * i] = nodes::quantize(&open, reference);
        packed[2 * i + 1] = nodes::quantize(&close, reference);
    }
    packed
}
