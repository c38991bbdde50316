//! The scene's meshes at one time, and the times at which to look at a scene that moves.

use super::{Instance, NodeState, Scene, Target};
use glam::{DAffine3, DVec3};
use std::collections::HashMap;

/// An axis-aligned box (min, max).
pub(super) type Bounds = (DVec3, DVec3);

/// The most times at which an animation is looked at.
const MOST_MOMENTS: usize = 33;

/// The times are fewer if more vertices would have to be moved than these, down to the next number.
const MOST_VERTICES: usize = 1 << 23;
const FEWEST_MOMENTS: usize = 5;

/// The nodes and the meshes of a scene at one time.
pub(super) struct Posed<'a> {
    scene: &'a Scene,
    pub nodes: Vec<NodeState>,
    /// The vertices of deforming meshes.
    moved: HashMap<usize, Vec<DVec3>>,
}

impl<'a> Posed<'a> {
    pub fn new(scene: &'a Scene, time: f64) -> Self {
        Self::of(scene, time, |_| true)
    }

    /// Only those meshes deform that are `wanted`.
    pub fn of(scene: &'a Scene, time: f64, wanted: impl Fn(usize) -> bool) -> Self {
        let nodes = scene.nodes_at(time, time);
        let weights = scene.weights_at(time);
        let deformations = scene.deformations.iter().zip(&weights);
        let deformations = deformations.filter(|(deformation, _)| wanted(deformation.mesh));
        let moved = deformations.map(|(deformation, weights)| {
            let mesh = &scene.meshes[deformation.mesh];
            let pose = deformation.pose(&nodes, weights);
            let posed = deformation.posed(mesh, &pose);
            let positions = (0..posed.len()).map(|vertex| posed.position(vertex));
            (deformation.mesh, positions.collect())
        });
        Self {
            moved: moved.collect(),
            scene,
            nodes,
        }
    }

    /// From a node to the world.
    pub fn world_from(&self, node: Option<usize>) -> DAffine3 {
        node.map_or(DAffine3::IDENTITY, |node| self.nodes[node].world_from_node)
    }

    /// From an instance to the world.
    pub fn world_from_object(&self, instance: &Instance) -> DAffine3 {
        self.world_from(self.scene.node_of(instance)) * instance.placement
    }

    /// The vertices of a mesh.
    pub fn points(&self, mesh: usize) -> impl Iterator<Item = DVec3> {
        let moved = self.moved.get(&mesh);
        let still = &self.scene.meshes[mesh].positions;
        (0..still.len()).map(move |i| match moved {
            Some(moved) => moved[i],
            None => still[i].as_dvec3(),
        })
    }

    /// The smallest axis-aligned box round a mesh in object space; `None` without vertices.
    pub fn bounds(&self, mesh: usize) -> Option<Bounds> {
        self.points(mesh).map(|p| (p, p)).reduce(union)
    }

    /// The smallest axis-aligned box in the target space of `space_from_object`.
    pub fn bounds_in(&self, mesh: usize, space_from_object: DAffine3) -> Option<Bounds> {
        let points = self.points(mesh);
        let points = points.map(|p| space_from_object.transform_point3(p));
        points.map(|p| (p, p)).reduce(union)
    }

    /// Extends `all` by an instance of a mesh that lies within `outer`.
    pub fn reach(&self, all: &mut Option<Bounds>, mesh: usize, place: DAffine3, outer: Bounds) {
        let is_inside = |(min, max): Bounds| min.cmple(outer.0).all() && max.cmpge(outer.1).all();
        if all.is_some_and(is_inside) {
            return;
        }
        if let Some(bounds) = self.bounds_in(mesh, place) {
            *all = Some(all.map_or(bounds, |all| union(all, bounds)));
        }
    }
}

impl Scene {
    /// A copy of the scene with its deforming meshes in their pose at `time`, in seconds, in which they stay.
    pub fn at_rest(&self, time: f64) -> Self {
        let mut scene = self.clone();
        let frame = self.frame(time);
        for (deformation, weights) in self.deformations.iter().zip(&frame.weights) {
            let source = &self.meshes[deformation.mesh];
            let pose = deformation.pose(&frame.nodes, weights);
            let posed = deformation.posed(source, &pose);
            let vertices = (0..posed.len()).map(|vertex| posed.vertex(vertex));
            let mut mesh = super::Mesh::clone(source);
            (mesh.positions, mesh.normals) = vertices
                .map(|(position, normal)| (position.as_vec3(), normal.as_vec3()))
                .unzip();
            mesh.repair();
            scene.meshes[deformation.mesh] = mesh.into();
        }
        for instance in &mut scene.instances {
            instance.node = self.node_of(instance);
        }
        scene.deformations.clear();
        let carries = scene.carrying_nodes();
        for track in &mut scene.tracks {
            let is_kept = |target: &Target| match *target {
                Target::Weight(..) => false,
                // Joints have nothing left to move.
                Target::Node(node, _) => carries[node],
                _ => true,
            };
            track.targets.retain(is_kept);
        }
        scene.tracks.retain(|track| !track.targets.is_empty());
        scene
    }

    /// For each node whether anything that can be seen or sees is attached to it or to a node below it.
    fn carrying_nodes(&self) -> Vec<bool> {
        let mut carries = vec![false; self.nodes.len()];
        let instances = self.instances.iter().map(|it| it.node);
        let shapes = self.shapes.iter().map(|it| it.node);
        let lights = self.lights.iter().map(|it| it.node);
        let cameras = self.cameras.iter().flat_map(|it| [it.node, it.target]);
        for node in instances
            .chain(shapes)
            .chain(lights)
            .chain(cameras)
            .flatten()
        {
            carries[node] = true;
        }
        // Parents come before their children.
        for index in (0..self.nodes.len()).rev() {
            if let (true, Some(parent)) = (carries[index], self.nodes[index].parent) {
                carries[parent] = true;
            }
        }
        carries
    }

    /// Times from 0 to the end of the animation, both included if geometry moves; otherwise only 0.
    pub(super) fn moments(&self) -> Vec<f64> {
        let targets = self.tracks.iter().flat_map(|track| &track.targets);
        let moves = |target: &Target| matches!(target, Target::Node(..) | Target::Weight(..));
        let duration = self.duration();
        if !targets.into_iter().any(moves) || duration <= 0.0 {
            return vec![0.0];
        }
        let moving = self.moving_instances();
        let moving = self
            .instances
            .iter()
            .zip(moving)
            .filter(|(_, moves)| *moves);
        let vertices: usize = moving
            .map(|(instance, _)| self.meshes[instance.mesh].positions.len())
            .sum();
        let count = MOST_VERTICES / vertices.max(1);
        let last = count.clamp(FEWEST_MOMENTS, MOST_MOMENTS) - 1;
        // At its very end an animation that repeats is at its beginning.
        let end = duration * (1.0 - 1e-9);
        (0..=last).map(|i| end * (i as f64 / last as f64)).collect()
    }

    /// For each instance whether it moves or deforms.
    pub(super) fn moving_instances(&self) -> Vec<bool> {
        let nodes = self.moving_nodes();
        let instances = self.instances.iter();
        instances
            .map(|instance| {
                instance.node.is_some_and(|node| nodes[node])
                    || self.deformation_of(instance.mesh).is_some()
            })
            .collect()
    }
}

pub(super) fn union(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}
