//! Meshes whose vertices move: morph targets displace them, then a skin bends them (glTF 2.0, sections
//! 3.7.2.2 and 3.7.3).

use super::{Mesh, NodeState};
use glam::{DAffine3, DMat3, DVec3, Vec3, Vec4};
use std::ops::Range;
use std::sync::Arc;

/// Vertices whose weights sum to less than this stay where they are.
const LEAST_WEIGHT: f64 = 1e-6;

/// How the vertices of a mesh move.
#[derive(Clone, Debug, PartialEq)]
pub struct Deformation {
    /// Index into [`super::Scene::meshes`]. A mesh has at most one deformation.
    pub mesh: usize,
    /// Each is added to the mesh, multiplied by its weight. May be empty.
    pub targets: Arc<[MorphTarget]>,
    /// The weight of each target at rest; tracks override them.
    pub weights: Vec<f64>,
    /// Applied after the targets. Its result is in world space.
    pub skin: Option<Skin>,
    /// Ranges of vertices of which each three are a triangle and have its normal. In ascending order.
    pub flat: Arc<[Range<usize>]>,
}

/// Displacements of some vertices of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// The displaced vertices, in ascending order.
    pub vertices: Vec<u32>,
    /// The displacement of each in object space; finite.
    pub positions: Vec<Vec3>,
    /// Vector added to each vertex's unit normal; empty if normals stay.
    pub normals: Vec<Vec3>,
    /// Vector added to the direction of each vertex's tangent; empty if tangents stay.
    pub tangents: Vec<Vec3>,
}

impl MorphTarget {
    fn inconsistency(&self, vertices: usize) -> Option<String> {
        let own = self.vertices.len();
        let optional = [("normals", &self.normals), ("tangents", &self.tangents)];
        let given = optional.into_iter().filter(|(_, list)| !list.is_empty());
        let lists = given.chain([("positions", &self.positions)]);
        if let Some((what, list)) = lists.into_iter().find(|(_, list)| list.len() != own) {
            return Some(format!(
                "a morph target has {} {what} for {own} vertices",
                list.len()
            ));
        }
        if !self.vertices.is_sorted_by(|a, b| a < b) {
            return Some("the vertices of a morph target are not in ascending order".into());
        }
        let last = self.vertices.last()?;
        (*last as usize >= vertices)
            .then(|| format!("a morph target moves vertex {last}, and there are {vertices}"))
    }

    /// Displaces copies as the vertices are of which they were made; the first copy has the index `first`.
    pub fn copy_vertices(&mut self, vertices: &[u32], first: usize) {
        for (index, vertex) in (first..).zip(vertices) {
            if let Ok(at) = self.vertices.binary_search(vertex) {
                self.vertices.push(index as u32);
                self.positions.push(self.positions[at]);
                for list in [&mut self.normals, &mut self.tangents] {
                    if !list.is_empty() {
                        list.push(list[at]);
                    }
                }
            }
        }
    }

    /// The largest displacement of a vertex.
    pub fn reach(&self) -> f64 {
        let lengths = self.positions.iter().map(|p| p.as_dvec3().length());
        lengths.fold(0.0, f64::max)
    }
}

/// Joints, and how far each vertex follows each of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// The joints.
    pub joints: Vec<Joint>,
    /// The joints of each vertex.
    pub influences: Arc<Influences>,
}

impl Skin {
    fn inconsistency(&self, vertices: usize, nodes: usize) -> Option<String> {
        let influenced = self.influences.len();
        if influenced != vertices {
            return Some(format!(
                "its skin has influences for {influenced} vertices, and there are {vertices}"
            ));
        }
        let joints = self.joints.len();
        if let Some(joint) = (self.influences.last_joint()).filter(|last| *last as usize >= joints)
        {
            return Some(format!(
                "a vertex follows joint {joint}, and there are {joints}"
            ));
        }
        let mut used = self.joints.iter().filter_map(|joint| joint.node);
        let unknown = used.find(|&node| node >= nodes)?;
        Some(format!(
            "a joint follows node {unknown}, and the scene has {nodes}"
        ))
    }
}

/// A joint of a skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Index into [`super::Scene::nodes`]; `None` for a joint that never moves.
    pub node: Option<usize>,
    /// From object space to the space of the node, or to the world. Finite; need not be invertible.
    pub node_from_mesh: DAffine3,
}

/// For each vertex of a mesh, joints and their weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Influences {
    /// The number of influences on all vertices up to each one, itself included.
    ends: Vec<u32>,
    /// The index of a joint, and a weight other than 0; by vertex.
    list: Vec<(u32, f32)>,
}

impl Influences {
    /// Adds the next vertex. Weights of 0 are left out.
    pub fn push(&mut self, of_vertex: impl IntoIterator<Item = (u32, f32)>) {
        let used = of_vertex.into_iter().filter(|(_, weight)| *weight != 0.0);
        self.list.extend(used);
        self.ends.push(self.list.len() as u32);
    }

    /// Adds copies of vertices.
    pub fn copy_vertices(&mut self, vertices: &[u32]) {
        for &vertex in vertices {
            let own = self.of(vertex as usize).to_vec();
            self.push(own);
        }
    }

    /// The joints of a vertex and their weights, which need not sum to 1.
    pub fn of(&self, vertex: usize) -> &[(u32, f32)] {
        let start = vertex.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.list[start as usize..self.ends[vertex] as usize]
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no vertices.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The largest index of a joint; `None` without influences.
    pub fn last_joint(&self) -> Option<u32> {
        self.list.iter().map(|(joint, _)| *joint).max()
    }
}

/// Parameters of the shape of a deforming mesh at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// The weight of each target.
    pub weights: Vec<f64>,
    /// For each joint the transform from object space to the world.
    pub joints: Vec<DAffine3>,
}

impl Deformation {
    /// How it does not fit its mesh of so many vertices, or the number of nodes of its scene; `None` if it does.
    pub fn inconsistency(&self, vertices: usize, nodes: usize) -> Option<String> {
        let (targets, weights) = (self.targets.len(), self.weights.len());
        if targets != weights {
            return Some(format!(
                "it has {weights} weights for {targets} morph targets"
            ));
        }
        let is_whole = |range: &Range<usize>| {
            range.start <= range.end && range.len().is_multiple_of(3) && range.end <= vertices
        };
        let are_ascending = self.flat.is_sorted_by(|a, b| a.end <= b.start);
        if !are_ascending || !self.flat.iter().all(is_whole) {
            return Some(format!(
                "its flat triangles are not in ascending order, or not among {vertices} vertices"
            ));
        }
        (self.targets.iter())
            .find_map(|target| target.inconsistency(vertices))
            .or_else(|| self.skin.as_ref()?.inconsistency(vertices, nodes))
    }

    /// The pose in which the nodes have these states and the targets these weights.
    pub fn pose(&self, nodes: &[NodeState], weights: &[f64]) -> Pose {
        let joints = self.skin.as_ref().map_or(&[][..], |skin| &skin.joints);
        let world = |joint: &Joint| match joint.node {
            Some(node) => nodes[node].world_from_node * joint.node_from_mesh,
            None => joint.node_from_mesh,
        };
        Pose {
            weights: weights.to_vec(),
            joints: joints.iter().map(world).collect(),
        }
    }

    /// `mesh`, which this belongs to, in a pose.
    pub fn posed<'a>(&'a self, mesh: &'a Mesh, pose: &'a Pose) -> PosedMesh<'a> {
        PosedMesh {
            mesh,
            deformation: self,
            pose,
            morphed: self.morphed(mesh, pose),
            turned: self.turned(mesh, pose),
        }
    }

    /// The directions of tangents with the targets added; `None` if none changes.
    fn turned(&self, mesh: &Mesh, pose: &Pose) -> Option<Vec<DVec3>> {
        let mut turned = None;
        for (target, &weight) in self.targets.iter().zip(&pose.weights) {
            if weight == 0.0 || target.tangents.is_empty() || mesh.tangents.is_empty() {
                continue;
            }
            let at_rest = || {
                let tangents = mesh.tangents.iter();
                tangents.map(|it| it.truncate().as_dvec3()).collect()
            };
            let tangents: &mut Vec<_> = turned.get_or_insert_with(at_rest);
            for (added, &vertex) in target.tangents.iter().zip(&target.vertices) {
                tangents[vertex as usize] += weight * added.as_dvec3();
            }
        }
        turned
    }

    /// Positions and normals with the targets added; `None` if all weights are 0.
    fn morphed(&self, mesh: &Mesh, pose: &Pose) -> Option<Vec<[DVec3; 2]>> {
        let used = self.targets.iter().zip(&pose.weights);
        let used = used.filter(|(_, weight)| **weight != 0.0);
        let mut morphed = None;
        for (target, &weight) in used {
            let at_rest = || {
                let all = mesh.positions.iter().zip(&mesh.normals);
                all.map(|(p, n)| [p.as_dvec3(), n.as_dvec3()]).collect()
            };
            let vertices: &mut Vec<_> = morphed.get_or_insert_with(at_rest);
            for (moved, &vertex) in target.positions.iter().zip(&target.vertices) {
                vertices[vertex as usize][0] += weight * moved.as_dvec3();
            }
            for (turned, &vertex) in target.normals.iter().zip(&target.vertices) {
                vertices[vertex as usize][1] += weight * turned.as_dvec3();
            }
        }
        morphed
    }
}

/// A mesh in a pose. All arithmetic is f64.
pub struct PosedMesh<'a> {
    mesh: &'a Mesh,
    deformation: &'a Deformation,
    pose: &'a Pose,
    morphed: Option<Vec<[DVec3; 2]>>,
    turned: Option<Vec<DVec3>>,
}

impl PosedMesh<'_> {
    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.mesh.positions.len()
    }

    /// Whether there are no vertices.
    pub fn is_empty(&self) -> bool {
        self.mesh.positions.is_empty()
    }

    /// The position of a vertex: in object space, or with a skin in world space.
    pub fn position(&self, vertex: usize) -> DVec3 {
        let [position, _] = self.morphed_at(vertex);
        match self.blend(vertex) {
            Some((matrix, translation)) => matrix * position + translation,
            None => position,
        }
    }

    /// The position of a vertex, and its unit normal; +Y where the normal has no direction.
    pub fn vertex(&self, vertex: usize) -> (DVec3, DVec3) {
        if let Some(corners) = self.flat_triangle(vertex) {
            let [a, b, c] = corners.map(|corner| self.position(corner));
            let side = self.blend(vertex).map_or(1.0, |(matrix, _)| side(matrix));
            let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
            return (self.position(vertex), side * normal);
        }
        let [position, normal] = self.morphed_at(vertex);
        match self.blend(vertex) {
            Some((matrix, translation)) => {
                // The cofactor matrix: also right where the mean of transforms cannot be inverted.
                let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
                let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
                let normal = (side(matrix) * (cofactors * normal)).normalize_or(DVec3::Y);
                (matrix * position + translation, normal)
            }
            None => (position, normal.normalize_or(DVec3::Y)),
        }
    }

    /// The tangent of a vertex with this unit normal, as in [`Mesh::tangents`]; zero if it has none.
    pub fn tangent(&self, vertex: usize, normal: DVec3) -> Vec4 {
        let Some(own) = self.mesh.tangents.get(vertex) else {
            return Vec4::ZERO;
        };
        let mut direction = match &self.turned {
            Some(turned) => turned[vertex],
            None => own.truncate().as_dvec3(),
        };
        let mut hand = own.w;
        if let Some((matrix, _)) = self.blend(vertex) {
            direction = matrix * direction;
            hand *= side(matrix) as f32;
        }
        let direction = (direction - direction.dot(normal) * normal).normalize_or_zero();
        match direction == DVec3::ZERO {
            true => Vec4::ZERO,
            false => direction.as_vec3().extend(hand),
        }
    }

    fn morphed_at(&self, vertex: usize) -> [DVec3; 2] {
        match &self.morphed {
            Some(morphed) => morphed[vertex],
            None => [
                self.mesh.positions[vertex].as_dvec3(),
                self.mesh.normals[vertex].as_dvec3(),
            ],
        }
    }

    /// The mean of the joints' transforms, weighted.
    fn blend(&self, vertex: usize) -> Option<(DMat3, DVec3)> {
        let skin = self.deformation.skin.as_ref()?;
        let (mut matrix, mut translation, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
        for &(joint, weight) in skin.influences.of(vertex) {
            let (joint, weight) = (&self.pose.joints[joint as usize], f64::from(weight));
            matrix += joint.matrix3 * weight;
            translation += joint.translation * weight;
            sum += weight;
        }
        let is_held = sum.abs() >= LEAST_WEIGHT;
        is_held.then(|| (matrix * sum.recip(), translation / sum))
    }

    /// The corners of the triangle that a vertex belongs to, if it has the triangle's normal.
    fn flat_triangle(&self, vertex: usize) -> Option<[usize; 3]> {
        let flat = &self.deformation.flat;
        let index = flat.partition_point(|range| range.end <= vertex);
        let start = flat
            .get(index)
            .filter(|range| range.contains(&vertex))?
            .start;
        let first = start + (vertex - start) / 3 * 3;
        Some([first, first + 1, first + 2])
    }
}

/// −1 if a transform mirrors, otherwise 1.
fn side(matrix: DMat3) -> f64 {
    if matrix.determinant() < 0.0 {
        -1.0
    } else {
        1.0
    }
}
