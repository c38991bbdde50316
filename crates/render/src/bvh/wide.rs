//! Collapses a binary tree to nodes of up to four children.

use super::{
    Aabb, Bvh, Limits, StackNeed,
    binary::{Kind, Node, Tree},
    threads,
};
use bytemuck::{Zeroable, allocation::zeroed_vec};
use std::ops::{Deref, Range};

/// Cost of visiting a node, in primitive tests.
const NODE_COST: f32 = 1.0;

/// Up to four children with their boxes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WideNode {
    /// Each box bounds all boxes below it.
    pub children: Children,
}

/// A list of at most four children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Children {
    list: [(Aabb, Child); 4],
    count: u32,
}

impl Children {
    fn push(&mut self, aabb: Aabb, child: Child) {
        self.list[self.count as usize] = (aabb, child);
        self.count += 1;
    }
}

impl Default for Children {
    fn default() -> Self {
        Self {
            list: [(Aabb::EMPTY, Child::Node(0)); 4],
            count: 0,
        }
    }
}

impl Deref for Children {
    type Target = [(Aabb, Child)];

    fn deref(&self) -> &Self::Target {
        &self.list[..self.count as usize]
    }
}

impl<'a> IntoIterator for &'a Children {
    type Item = &'a (Aabb, Child);
    type IntoIter = std::slice::Iter<'a, (Aabb, Child)>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// A child of a [`WideNode`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// Index into [`Bvh::nodes`].
    Node(u32),
    /// A range of boxes in their group's [`Bvh::order`].
    Leaf {
        /// Index into [`Bvh::order`].
        group: u8,
        /// Position of the first box in it.
        first: u32,
        /// Number of boxes, 1 to [`super::Limits::leaf_size`].
        count: u32,
    },
}

/// How a subtree is best represented by children of a node (after Ylitie, Karras, Laine 2017, section 3.1).
#[derive(Clone, Copy, Debug, Zeroable)]
struct Plan {
    /// Expected cost of a ray that hits it, times its area, when it becomes at most 1, 2 or 3 children.
    costs: [f32; 3],
    /// How it is divided when it becomes at most 2, 3 or 4 children: two bits each for the number of children
    /// that its left subtree becomes, or 0 if it is best to use one child less.
    division: u8,
    /// Whether it becomes a leaf when it becomes one child.
    is_leaf: bool,
    /// The common group of all its boxes, or [`MIXED`].
    group: u8,
    /// Number of boxes, at most [`u8::MAX`].
    count: u8,
}

/// Stands for several groups.
const MIXED: u8 = u8::MAX;

impl Plan {
    fn of_box(area: f32, group: u8) -> Self {
        Self {
            costs: [area; 3],
            division: 0,
            is_leaf: true,
            group,
            count: 1,
        }
    }

    fn of_subtrees(area: f32, left: &Self, right: &Self, limits: Limits) -> Self {
        let count = left.count.saturating_add(right.count);
        let group = match left.group == right.group {
            true => left.group,
            false => MIXED,
        };
        // The least cost when both become at most `slots` children, and how many of them are left ones.
        let divided = |slots: usize| {
            let cost = |on_left: usize| left.costs[on_left - 1] + right.costs[slots - on_left - 1];
            (2..slots).fold((cost(1), 1), |(least, best), on_left| match cost(on_left) {
                cost if cost < least => (cost, on_left as u8),
                _ => (least, best),
            })
        };
        let (four, division_of_four) = divided(4);
        let (leaf, node) = (f32::from(count) * area, NODE_COST * area + four);
        let may_share = group != MIXED && Some(group) != limits.alone;
        let is_leaf = may_share && u32::from(count) <= limits.leaf_size && leaf <= node;
        let mut costs = [if is_leaf { leaf } else { node }; 3];
        let mut division = division_of_four << 4;
        for slots in [2, 3] {
            let (cost, on_left) = divided(slots);
            costs[slots - 1] = costs[slots - 2];
            if cost < costs[slots - 1] {
                costs[slots - 1] = cost;
                division |= on_left << (2 * (slots - 2));
            }
        }
        Self {
            costs,
            division,
            is_leaf,
            group,
            count,
        }
    }

    /// The number of children that the left subtree becomes if all become at most `slots`, 2 to 4; 0 if it is
    /// best to use one child less.
    fn left_of(&self, slots: u8) -> u8 {
        self.division >> (2 * (slots - 2)) & 3
    }
}

/// The tree of least expected cost that four-way nodes can make of a binary one.
pub fn collapse(tree: &Tree, groups: &[u8], group_count: usize, limits: Limits) -> Bvh {
    let nodes = &tree.nodes[..];
    let mut top = Piece::new(nodes.len() / 4, group_count);
    let mut stack = StackNeed::default();
    if !nodes.is_empty() {
        let plans = plans(tree, groups, limits);
        let below = top.grow(nodes, &plans, 0, &tree.parts);
        // Most wide nodes stand for six binary ones.
        let room = nodes.len() / 6 / below.len().max(1);
        let pieces = threads::map(below, |(source, at)| {
            let mut piece = Piece::new(room, group_count);
            piece.grow(nodes, &plans, source, &[]);
            let need = stack_need(&piece.nodes, &[]);
            (piece, (at, need))
        });
        let needs: Vec<_> = pieces.iter().map(|(_, need)| *need).collect();
        stack = stack_need(&top.nodes, &needs);
        drop(plans);
        top.append(pieces);
    }
    Bvh {
        stack_need: stack.with_end(),
        nodes: top.nodes,
        order: top.order,
        work: 0,
    }
}

/// A part of a tree under construction, as [`Bvh`] has all of it.
struct Piece {
    nodes: Vec<WideNode>,
    order: Vec<Vec<u32>>,
}

impl Piece {
    /// One node without children, and room for more.
    fn new(room: usize, group_count: usize) -> Self {
        let mut nodes = Vec::with_capacity(1 + room);
        nodes.push(WideNode::default());
        Self {
            nodes,
            order: vec![Vec::new(); group_count],
        }
    }

    /// Makes the first node that of a subtree, and adds those below it, except for those in `parts`: returns the roots
    /// of these with their nodes, which have no children yet.
    fn grow(
        &mut self,
        tree: &[Node],
        plans: &[Plan],
        root: u32,
        parts: &[Range<usize>],
    ) -> Vec<(u32, usize)> {
        let mut open = vec![(root, 0)];
        let mut left_out = Vec::new();
        while let Some((binary, wide)) = open.pop() {
            if is_in(parts, binary as usize) {
                left_out.push((binary, wide));
                continue;
            }
            let (sources, count) = divide(tree, plans, binary);
            let mut children = Children::default();
            for &source in &sources[..count] {
                let plan = &plans[source as usize];
                let child = if plan.is_leaf {
                    let order = &mut self.order[plan.group as usize];
                    let first = order.len() as u32;
                    order.extend(boxes_below(tree, source, plan.count));
                    Child::Leaf {
                        group: plan.group,
                        first,
                        count: plan.count.into(),
                    }
                } else {
                    self.nodes.push(WideNode::default());
                    let index = self.nodes.len() - 1;
                    open.push((source, index));
                    Child::Node(index as u32)
                };
                children.push(tree[source as usize].aabb, child);
            }
            self.nodes[wide].children = children;
        }
        left_out
    }

    /// Appends pieces, the first node of each in the place of a node that there is.
    fn append(&mut self, pieces: Vec<(Self, (usize, StackNeed))>) {
        let mut len = self.nodes.len();
        let mut jobs = Vec::with_capacity(pieces.len());
        for (mut piece, (at, _)) in pieces {
            let first: Vec<_> = self.order.iter().map(|order| order.len() as u32).collect();
            for (order, own) in self.order.iter_mut().zip(&piece.order) {
                order.extend_from_slice(own);
            }
            let moved = Moved {
                nodes: len as u32,
                order: first,
            };
            moved.apply(&mut piece.nodes[..1]);
            self.nodes[at] = piece.nodes[0];
            len += piece.nodes.len() - 1;
            jobs.push((piece.nodes, moved));
        }
        let pieces = threads::map(jobs, |(mut nodes, moved)| {
            moved.apply(&mut nodes[1..]);
            nodes
        });
        self.nodes.reserve_exact(len - self.nodes.len());
        for nodes in pieces {
            self.nodes.extend_from_slice(&nodes[1..]);
        }
    }
}

/// Where a piece has come to lie: the place of its second node, and that of its first box in each group.
struct Moved {
    nodes: u32,
    order: Vec<u32>,
}

impl Moved {
    fn apply(&self, nodes: &mut [WideNode]) {
        for node in nodes {
            let count = node.children.count as usize;
            for (_, child) in &mut node.children.list[..count] {
                match child {
                    Child::Node(index) => *index += self.nodes - 1,
                    Child::Leaf { group, first, .. } => *first += self.order[usize::from(*group)],
                }
            }
        }
    }
}

/// Whether a node is in one of the parts, which are in order.
fn is_in(parts: &[Range<usize>], node: usize) -> bool {
    let after = parts.partition_point(|part| part.start <= node);
    after > 0 && node < parts[after - 1].end
}

/// Plans for all subtrees: first for those that several threads can work on, then for those above them.
fn plans(tree: &Tree, groups: &[u8], limits: Limits) -> Vec<Plan> {
    let nodes = &tree.nodes[..];
    let mut plans: Vec<Plan> = zeroed_vec(nodes.len());
    let mut rest = &mut plans[..];
    let mut before = 0;
    let jobs = tree.parts.iter().map(|part| {
        let from = std::mem::take(&mut rest)
            .split_at_mut(part.start - before)
            .1;
        let (own, others) = from.split_at_mut(part.len());
        (rest, before) = (others, part.end);
        (part.clone(), own)
    });
    threads::map(jobs.collect(), |(part, plans)| {
        plan(nodes, groups, limits, part.clone(), plans, part.start);
    });
    let ends = tree.parts.iter().map(|part| part.end);
    let starts = tree.parts.iter().map(|part| part.start);
    let above = std::iter::once(0).chain(ends);
    let above: Vec<_> = above.zip(starts.chain([nodes.len()])).collect();
    for (start, end) in above.into_iter().rev() {
        plan(nodes, groups, limits, start..end, &mut plans, 0);
    }
    plans
}

/// Plans for a range of nodes. Children come after their parents, so a single backward pass suffices. `plans` are
/// those of the nodes from `first` on.
fn plan(
    tree: &[Node],
    groups: &[u8],
    limits: Limits,
    range: Range<usize>,
    plans: &mut [Plan],
    first: usize,
) {
    for index in range.rev() {
        let node = &tree[index];
        let area = node.aabb.half_area();
        plans[index - first] = match node.kind() {
            Kind::Leaf(of) => Plan::of_box(area, groups[of as usize]),
            Kind::Inner(right) => {
                let left = &plans[index + 1 - first];
                Plan::of_subtrees(area, left, &plans[right as usize - first], limits)
            }
        };
    }
}

/// The one to four subtrees that become the children of the wide node for a subtree.
fn divide(tree: &[Node], plans: &[Plan], root: u32) -> ([u32; 4], usize) {
    let (mut parts, mut count) = ([root; 4], 0);
    // Subtrees with the number of children that they become at most; at most three wait at a time.
    let (mut open, mut waiting) = ([(root, 4u8); 4], 1);
    while waiting > 0 {
        waiting -= 1;
        let (source, slots) = open[waiting];
        let plan = &plans[source as usize];
        match tree[source as usize].kind() {
            Kind::Inner(right) if slots > 1 && !(plan.is_leaf && source == root) => {
                match plan.left_of(slots) {
                    0 => {
                        open[waiting] = (source, slots - 1);
                        waiting += 1;
                    }
                    left => {
                        open[waiting] = (right, slots - left);
                        open[waiting + 1] = (source + 1, left);
                        waiting += 2;
                    }
                }
            }
            _ => {
                parts[count] = source;
                count += 1;
            }
        }
    }
    (parts, count)
}

/// The boxes below a node with `count` of them, left to right.
fn boxes_below(tree: &[Node], root: u32, count: u8) -> impl Iterator<Item = u32> {
    let boxes = tree[root as usize..]
        .iter()
        .filter_map(|node| match node.kind() {
            Kind::Leaf(index) => Some(index),
            Kind::Inner(_) => None,
        });
    boxes.take(count.into())
}

/// Without an end marker. `known` are places of nodes without children yet, and the entries that these need.
fn stack_need(nodes: &[WideNode], known: &[(usize, StackNeed)]) -> StackNeed {
    let mut need = vec![StackNeed::default(); nodes.len()];
    for &(at, known) in known {
        need[at] = known;
    }
    for (i, node) in nodes.iter().enumerate().rev() {
        let below = node.children.iter().map(|(_, child)| match child {
            Child::Node(index) => need[*index as usize],
            Child::Leaf { .. } => StackNeed::default(),
        });
        need[i] = need[i].max(StackNeed::below(node.children.len(), below));
    }
    need[0]
}
