//! Several trees in the same arrays: that of all that stands still, and one for each mesh or shape that
//! is placed by instances.

use super::{geometry, nodes};
use crate::{
    bvh::{self, Aabb, Child},
    layout::{PackedNode, PackedShape, PackedTriangle, SHAPE},
};

/// Most primitives in a leaf.
const LEAF_SIZE: u32 = 4;

/// Most parts into which the tree of what stands still is opened.
const MOST_PARTS: usize = 64;

#[derive(Debug, Default)]
pub struct Forest {
    pub nodes: Vec<PackedNode>,
    pub triangles: Vec<PackedTriangle>,
    pub shapes: Vec<PackedShape>,
}

/// One of the trees.
#[derive(Clone, Debug)]
pub struct Tree {
    /// Child reference to its root.
    pub root: u32,
    /// Its first primitive, with [`SHAPE`] where there are only shapes.
    pub first: u32,
    /// Number of primitives.
    pub count: u32,
    /// The most entries that a walk through it has on the stack.
    pub stack_need: usize,
    /// Boxes that hold it together, in its own space, with references to what is in them.
    pub parts: Vec<(Aabb, u32)>,
}

impl Forest {
    /// Builds a tree of triangles and shapes. The first one's root is node 0.
    pub fn plant(
        &mut self,
        triangles: &[PackedTriangle],
        shapes: &[(PackedShape, Aabb)],
        stack_size: usize,
    ) -> Tree {
        let boxes: Vec<_> = (triangles.iter().map(geometry::triangle_box))
            .chain(shapes.iter().map(|(_, bounds)| *bounds))
            .collect();
        let mut groups = vec![nodes::TRIANGLES; triangles.len()];
        groups.resize(boxes.len(), nodes::SHAPES);
        let limits = bvh::Limits {
            leaf_size: LEAF_SIZE,
            stack_size,
        };
        let bvh = bvh::build(&boxes, &groups, nodes::GROUP_COUNT, limits);

        let first_node = self.nodes.len() as u32;
        let (first_triangle, first_shape) = (self.triangles.len() as u32, self.shapes.len() as u32);
        let reference = |child: &Child| match *child {
            Child::Node(index) => first_node + index,
            Child::Leaf { group, .. } => {
                let offset = if group == nodes::SHAPES {
                    first_shape
                } else {
                    first_triangle
                };
                nodes::leaf(child, offset)
            }
        };
        let order = |group: u8| bvh.order[group as usize].iter().map(|&i| i as usize);
        (self.triangles).extend(order(nodes::TRIANGLES).map(|i| triangles[i]));
        (self.shapes).extend(order(nodes::SHAPES).map(|i| shapes[i - triangles.len()].0));
        self.nodes.extend(
            bvh.nodes
                .iter()
                .map(|node| nodes::quantize(node, reference)),
        );

        let is_shapes = triangles.is_empty();
        Tree {
            root: match &bvh.nodes[0].children[..] {
                [(_, only)] => reference(only),
                _ => first_node,
            },
            first: if is_shapes {
                SHAPE | first_shape
            } else {
                first_triangle
            },
            count: boxes.len() as u32,
            stack_need: bvh.stack_need,
            parts: top(&bvh.nodes, reference),
        }
    }
}

/// The boxes near the root, with references to what is in them: the largest is opened until there are
/// [`MOST_PARTS`].
fn top(nodes: &[bvh::WideNode], reference: impl Fn(&Child) -> u32) -> Vec<(Aabb, u32)> {
    let mut parts = nodes[0].children.clone();
    loop {
        let open = (parts.iter().enumerate())
            .filter_map(|(place, (aabb, child))| match child {
                Child::Node(index) => Some((place, *index, aabb.half_area())),
                Child::Leaf { .. } => None,
            })
            .max_by(|a, b| a.2.total_cmp(&b.2));
        let Some((place, index, _)) = open else { break };
        let children = &nodes[index as usize].children;
        if parts.len() + children.len() > MOST_PARTS {
            break;
        }
        parts.swap_remove(place);
        parts.extend_from_slice(children);
    }
    (parts.iter())
        .map(|(aabb, child)| (*aabb, reference(child)))
        .collect()
}
