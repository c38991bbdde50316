//! What moves: the state of a scene at one moment.

use super::{Background, Camera, Light, Material, Scene};
use glam::{DAffine3, Vec3};

/// The moving part of a [`Scene`] at one time. Geometry stays in the scene, so that an animation
/// uploads it once.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The camera that the picture is seen by, in world space.
    pub camera: Camera,
    /// One for each of the scene's, in world space; dark and invisible while it is off.
    pub lights: Vec<Light>,
    /// What rays see that hit nothing.
    pub background: Background,
    /// Linear radiance of the ambient term, multiplied by [`Material::ambient`].
    pub ambient: Vec3,
    /// One for each of the scene's nodes.
    pub nodes: Vec<NodeState>,
    /// One for each of the scene's, if a track changes any; else empty, and the scene's count.
    pub materials: Vec<Material>,
}

/// Where a [`super::Node`] is at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeState {
    /// Invertible.
    pub world_from_node: DAffine3,
    /// Whether it and all nodes above it are visible.
    pub visible: bool,
}

impl Scene {
    /// The scene at `time` seconds, seen by its default camera.
    pub fn frame(&self, _time: f64) -> Frame {
        let mut nodes: Vec<NodeState> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let parent = node.parent.map(|parent| nodes[parent]);
            let parent_from_node = node.parent_from_node();
            nodes.push(NodeState {
                world_from_node: parent.map_or(parent_from_node, |parent| {
                    parent.world_from_node * parent_from_node
                }),
                visible: node.visible && parent.is_none_or(|parent| parent.visible),
            });
        }
        Frame {
            camera: self.cameras[self.camera_index].clone(),
            lights: self.lights.clone(),
            background: self.background.clone(),
            ambient: self.ambient,
            nodes,
            materials: Vec::new(),
        }
    }

    /// The scene while the shutter is open, from `open` to `close` in seconds: frames at equal
    /// distances of time, the first at `open` and the last at `close`, so close together that what
    /// lies between two may be interpolated; a single one where nothing moves.
    pub fn shot(&self, open: f64, close: f64) -> Vec<Frame> {
        let _ = close;
        vec![self.frame(open)]
    }

    /// For each node whether a track moves it, or one above it.
    pub fn moving_nodes(&self) -> Vec<bool> {
        vec![false; self.nodes.len()]
    }
}
