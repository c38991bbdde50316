//! What moves: the state of a scene at one moment.

mod camera;
mod light;
mod material;

use super::{
    Background, Beyond, Camera, Curve, Light, Material, NodeProperty, Scene, Target, Value, Values,
};
use glam::{DAffine3, DQuat, DVec3, Vec3};

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
    ///
    /// What cubics and Bézier curves overshoot stays in the range that the property's own
    /// description gives. A track whose values are not of its target's kind is without effect.
    pub fn frame(&self, time: f64) -> Frame {
        self.frame_while(time, time)
    }

    /// The scene at `time` with what the shutter freezes as it is at `opened`.
    pub(super) fn frame_while(&self, time: f64, opened: f64) -> Frame {
        let nodes = self.nodes_at(time, opened);
        Frame {
            camera: self.camera_at(time, &nodes),
            lights: self.lights_at(time, opened, &nodes),
            background: self.background.clone(),
            ambient: self.ambient,
            materials: self.materials_at(opened),
            nodes,
        }
    }

    pub(super) fn nodes_at(&self, time: f64, opened: f64) -> Vec<NodeState> {
        let hierarchy = Hierarchy::new(self);
        let mut states = Vec::with_capacity(self.nodes.len());
        for index in 0..self.nodes.len() {
            states.push(hierarchy.state(index, &states, time, opened));
        }
        states
    }

    /// For each node whether a track moves or hides it, or one above it.
    pub fn moving_nodes(&self) -> Vec<bool> {
        let mut moving = vec![false; self.nodes.len()];
        for target in self.tracks.iter().flat_map(|track| &track.targets) {
            if let Target::Node(index, _) = *target {
                moving[index] = true;
            }
        }
        for (index, node) in self.nodes.iter().enumerate() {
            moving[index] |= node.parent.is_some_and(|parent| moving[parent]);
        }
        moving
    }

    /// Whether anything changes, ever.
    pub fn is_animated(&self) -> bool {
        self.tracks.iter().any(|track| !track.curve.is_constant())
    }

    /// Seconds that the animation lasts: what the file says, else until the last key of any track, and
    /// until what goes to and fro is back; 0 where that is nothing.
    pub fn duration(&self) -> f64 {
        let ends = self.tracks.iter().map(|track| {
            let (first, last) = track.curve.span();
            match track.curve.beyond {
                Beyond::PingPong => last + (last - first),
                Beyond::Hold | Beyond::Repeat => last,
            }
        });
        (self.output.duration).unwrap_or_else(|| ends.fold(0.0, f64::max))
    }
}

/// Which curves drive which node, so that a few nodes can be evaluated without all others.
pub(super) struct Hierarchy<'a> {
    scene: &'a Scene,
    /// In the nodes' order.
    curves: Vec<(usize, NodeProperty, &'a Curve)>,
}

impl<'a> Hierarchy<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let mut curves = Vec::new();
        for track in &scene.tracks {
            for target in &track.targets {
                if let Target::Node(index, property) = *target {
                    curves.push((index, property, &track.curve));
                }
            }
        }
        curves.sort_by_key(|(index, ..)| *index);
        Self { scene, curves }
    }

    /// The curves of one node.
    pub fn curves_of(&self, index: usize) -> &[(usize, NodeProperty, &'a Curve)] {
        let start = self.curves.partition_point(|(other, ..)| *other < index);
        let count = self.curves[start..].partition_point(|(other, ..)| *other == index);
        &self.curves[start..start + count]
    }

    /// The state of a node; those of the nodes above it are in `states`.
    pub fn state(&self, index: usize, states: &[NodeState], time: f64, opened: f64) -> NodeState {
        let rest = &self.scene.nodes[index];
        let (mut translation, mut rotation) = (rest.translation, rest.rotation);
        let (mut scale, mut visible) = (rest.scale, rest.visible);
        for (_, property, curve) in self.curves_of(index) {
            match (property, curve.at(time)) {
                (NodeProperty::Translation, Value::Vector(value)) => translation = value,
                (NodeProperty::Rotation, Value::Rotation(value)) => rotation = value,
                (NodeProperty::Angles, Value::Vector(value)) => rotation = rotation_from(value),
                (NodeProperty::Scale, Value::Vector(value)) => {
                    scale = invertible(value, rest.scale);
                }
                (NodeProperty::Visible, Value::Scalar(_)) => visible = is_on(curve, opened),
                _ => {}
            }
        }
        let local = DAffine3::from_scale_rotation_translation(scale, rotation, translation);
        let parent_from_node = rest.placement * local;
        match rest.parent.map(|parent| states[parent]) {
            None => NodeState {
                world_from_node: parent_from_node,
                visible,
            },
            Some(parent) => NodeState {
                world_from_node: parent.world_from_node * parent_from_node,
                visible: visible && parent.visible,
            },
        }
    }
}

/// Radians round x, then y, then z.
pub(super) fn rotation_from(angles: DVec3) -> DQuat {
    DQuat::from_rotation_z(angles.z)
        * DQuat::from_rotation_y(angles.y)
        * DQuat::from_rotation_x(angles.x)
}

/// `scale`, whose components are kept from coming nearer to 0 than a millionth of those at `rest`,
/// as they do on their way from a positive to a negative key.
fn invertible(scale: DVec3, rest: DVec3) -> DVec3 {
    let least = 1e-6 * rest.abs();
    let kept = scale.abs().max(least);
    DVec3::select(scale.cmplt(DVec3::ZERO), -kept, kept)
}

/// The state of a switch when the shutter opens.
fn is_on(curve: &Curve, opened: f64) -> bool {
    matches!(curve.at(opened), Value::Scalar(value) if value >= 0.5)
}

/// A colour as single floats, in range.
fn color(value: DVec3) -> Vec3 {
    value
        .clamp(DVec3::ZERO, DVec3::splat(f64::from(f32::MAX)))
        .as_vec3()
}

impl Target {
    /// Whether a track with `values` can drive it.
    pub fn takes(self, values: &Values) -> bool {
        use super::{
            CameraProperty as Camera, LightProperty as Light, MaterialProperty as Material,
        };
        match self {
            Self::Node(_, NodeProperty::Rotation) => matches!(values, Values::Rotation(_)),
            Self::Node(_, NodeProperty::Visible)
            | Self::Camera(
                _,
                Camera::FovY
                | Camera::OrthographicHeight
                | Camera::FocusDistance
                | Camera::LensRadius,
            )
            | Self::Light(_, Light::Intensity | Light::On)
            | Self::Material(_, Material::Shininess | Material::Opacity | Material::Ior) => {
                matches!(values, Values::Scalar(_))
            }
            _ => matches!(values, Values::Vector(_)),
        }
    }
}
