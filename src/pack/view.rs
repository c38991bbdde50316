//! The tree over what is placed, made anew for each shot: instances, their keys while the shutter is
//! open, and nodes whose boxes follow the movement.

use super::{
    PackError, PackedScene,
    geometry::in_range,
    nodes,
    placed::{Placed, PlacedTree},
    placement::{Placement, aligned},
};
use crate::{
    bvh::{self, Aabb, Bvh, Child},
    layout::{INSTANCE, MOVING, PackedInstance, PackedKey, PackedNode, STACK_SIZE},
    scene::Frame,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};

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
        // Boxes, and the child references to what is in them: first parts of the tree of what stands
        // still, then instances.
        let (mut boxes, mut references) = (Vec::new(), Vec::new());
        for &(aabb, reference) in &self.still_parts {
            boxes.push(still(aabb));
            references.push(reference);
        }
        for (id, placed) in self.placed.iter().enumerate() {
            if let Some(swept) = self.place(placed, id as u32, frames, &mut view)? {
                boxes.push(swept);
                references.push(INSTANCE | (view.instances.len() - 1) as u32);
            }
        }
        view.moves = view.instances.iter().any(|instance| instance.key_count > 1);
        // One entry leads back from a tree that is placed, and the last store of a step lies one beyond.
        let limit = STACK_SIZE as usize - 2;
        let limits = bvh::Limits {
            leaf_size: 1,
            stack_size: limit.saturating_sub(self.stack_need),
        };
        let unions: Vec<_> = (boxes.iter())
            .map(|swept| swept.open.union(swept.close))
            .collect();
        // A leaf has one box, so that it does not matter what kind the others are of.
        let bvh = bvh::build(&unions, &vec![0; unions.len()], 1, limits);
        let need = bvh.stack_need + self.stack_need;
        if need > limit {
            return Err(PackError::TooDeep { need, limit });
        }
        view.nodes = pack_nodes(&bvh, &boxes, &references, first_node, view.moves);
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
        let Some(mut worlds) = frames
            .iter()
            .map(world_from_tree)
            .collect::<Option<Vec<_>>>()
        else {
            return Ok(None);
        };
        let to_render = DAffine3::from_translation(-self.origin);
        let tree = &self.placed_trees[placed.tree];
        let moves = worlds.iter().any(|world| *world != worlds[0]);
        if !moves {
            worlds.truncate(1);
        }
        for &world in &worlds {
            let (min, max) = tree.bounds(to_render * world);
            in_range(min.abs().max(max.abs()).max_element())?;
        }
        let first = to_render * worlds[0];
        let to_pattern = placed.carrier.pattern_from_tree(worlds[0]);
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
        let swept = if !moves {
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

/// Boxes between which a tree stays. They hold it at all keys and at steps in between, and half as much
/// more as it strays from one step to the next from where the boxes beside it would have it.
fn sweep(tree: &PlacedTree, keys: &[Placement]) -> Swept {
    let last = (keys.len() - 1) as f64;
    let mut boxes = vec![(0.0, tree.bounds(keys[0].transform()))];
    let mut stray = DVec3::ZERO;
    for (i, pair) in keys.windows(2).enumerate() {
        let start = boxes.len() - 1;
        let steps = steps_between(&pair[0], &pair[1]);
        for step in 1..=steps {
            let share = f64::from(step) / f64::from(steps);
            let placement = match step == steps {
                true => pair[1],
                false => pair[0].between(&pair[1], share),
            };
            boxes.push((
                (i as f64 + share) / last,
                tree.bounds(placement.transform()),
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
    // How far the two boxes must move outwards.
    let (mut below, mut above) = (DVec3::ZERO, DVec3::ZERO);
    for &(share, (min, max)) in &boxes {
        below = below.max(open.0.lerp(close.0, share) - min);
        above = above.max(max - open.1.lerp(close.1, share));
    }
    let end = |(min, max): (DVec3, DVec3)| {
        rounded_outwards(min - below - stray * 0.5, max + above + stray * 0.5)
    };
    Swept {
        open: end(open),
        close: end(close),
    }
}

/// How many steps there are from one key to the next: more where so much turns at once, as in a jump,
/// that a box may be larger in between than at both ends and half-way.
fn steps_between(from: &Placement, to: &Placement) -> u32 {
    const MAX_TURN: f64 = 0.25;
    if from.rotation.angle_between(to.rotation) > MAX_TURN {
        16
    } else {
        2
    }
}

/// The nodes over all boxes. References to the nodes themselves count from `first_node`.
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
            Child::Leaf { first, .. } => boxes[place(first)],
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
