//! Collapses a binary tree to nodes of up to four children.

use super::{
    Aabb, Bvh,
    binary::{BinaryKind, BinaryNode},
};

/// Cost of visiting a node, in primitive tests: how much more a leaf may cost before it is split. A
/// four-way node spreads this cost over several splits.
const NODE_COST: f32 = 1.0;

/// Up to four children with their boxes.
#[derive(Clone, Debug, Default)]
pub struct WideNode {
    /// Each box bounds all boxes below it.
    pub children: Vec<(Aabb, Child)>,
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

/// Summary of a subtree for the collapse.
#[derive(Clone, Copy)]
struct Summary {
    count: u32,
    /// The common group of all its boxes, if there is one.
    group: Option<u8>,
    /// Expected cost of a ray that hits it, times its area.
    cost: f32,
    is_leaf: bool,
}

/// Opens the child with the largest area until there are four, and makes leaves of up to `leaf_size`
/// boxes of one group where that costs no more than a further split.
pub fn collapse(tree: &[BinaryNode], groups: &[u8], group_count: usize, leaf_size: u32) -> Bvh {
    let mut bvh = Bvh {
        nodes: vec![WideNode::default()],
        order: vec![Vec::new(); group_count],
        stack_need: 1,
    };
    if tree.is_empty() {
        return bvh;
    }
    let summaries = summarize(tree, groups, leaf_size);
    let mut open = vec![(0usize, 0usize)];
    while let Some((binary, wide)) = open.pop() {
        let mut children = Vec::with_capacity(4);
        for source in gather(tree, &summaries, binary) {
            let child = match summaries[source] {
                Summary {
                    group: Some(group),
                    count,
                    is_leaf: true,
                    ..
                } => {
                    let order = &mut bvh.order[group as usize];
                    let first = order.len() as u32;
                    push_boxes(tree, source, order);
                    Child::Leaf {
                        group,
                        first,
                        count,
                    }
                }
                _ => {
                    bvh.nodes.push(WideNode::default());
                    let index = bvh.nodes.len() - 1;
                    open.push((source, index));
                    Child::Node(index as u32)
                }
            };
            children.push((tree[source].aabb, child));
        }
        bvh.nodes[wide].children = children;
    }
    bvh.stack_need = stack_need(&bvh.nodes);
    bvh
}

/// Summaries of all subtrees. Children come after their parents, so a single backward pass suffices.
fn summarize(tree: &[BinaryNode], groups: &[u8], leaf_size: u32) -> Vec<Summary> {
    let nothing = Summary {
        count: 0,
        group: None,
        cost: 0.0,
        is_leaf: false,
    };
    let mut summaries = vec![nothing; tree.len()];
    for (i, node) in tree.iter().enumerate().rev() {
        let area = node.aabb.half_area();
        summaries[i] = match node.kind {
            BinaryKind::Leaf(index) => Summary {
                count: 1,
                group: Some(groups[index as usize]),
                cost: area,
                is_leaf: true,
            },
            BinaryKind::Inner(left, right) => {
                let (left, right) = (summaries[left], summaries[right]);
                let count = left.count + right.count;
                let group = left.group.filter(|_| left.group == right.group);
                let split_cost = NODE_COST * area + left.cost + right.cost;
                let leaf_cost = count as f32 * area;
                let is_leaf = group.is_some() && count <= leaf_size && leaf_cost <= split_cost;
                let cost = if is_leaf { leaf_cost } else { split_cost };
                Summary {
                    count,
                    group,
                    cost,
                    is_leaf,
                }
            }
        };
    }
    summaries
}

/// The one to four subtrees that become the children of a wide node.
fn gather(tree: &[BinaryNode], summaries: &[Summary], root: usize) -> Vec<usize> {
    let mut parts = vec![root];
    while parts.len() < 4 {
        let largest = parts
            .iter()
            .enumerate()
            .filter(|(_, part)| !summaries[**part].is_leaf)
            .max_by(|(_, a), (_, b)| {
                let area = |i: &usize| tree[*i].aabb.half_area();
                area(a).total_cmp(&area(b))
            });
        let Some((place, &part)) = largest else { break };
        let BinaryKind::Inner(left, right) = tree[part].kind else {
            break;
        };
        parts[place] = left;
        parts.push(right);
    }
    parts
}

/// Appends the boxes below a node to `order`, left to right.
fn push_boxes(tree: &[BinaryNode], root: usize, order: &mut Vec<u32>) {
    let mut open = vec![root];
    while let Some(node) = open.pop() {
        match tree[node].kind {
            BinaryKind::Leaf(index) => order.push(index),
            BinaryKind::Inner(left, right) => open.extend([right, left]),
        }
    }
}

/// Stack entries when every child of every node on the path is hit: a node with n children leaves n − 1
/// behind. Plus one for the entry that marks the empty stack.
fn stack_need(nodes: &[WideNode]) -> usize {
    let mut need = vec![0usize; nodes.len()];
    for (i, node) in nodes.iter().enumerate().rev() {
        let below = node.children.iter().map(|(_, child)| match child {
            Child::Node(index) => need[*index as usize],
            Child::Leaf { .. } => 0,
        });
        need[i] = below.max().unwrap_or(0) + node.children.len().saturating_sub(1);
    }
    need[0] + 1
}
