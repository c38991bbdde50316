//! The state of a scene at one moment.

mod camera;
mod light;
mod material;
mod texture;

use super::{
    Background, Beyond, Camera, Curve, Light, Material, NodeProperty, Scene, Section, Target,
    Texture, Track, Value, Values,
};
use glam::{DAffine3, DQuat, DVec3, Vec3};

/// The animated part of a [`Scene`] at one time. Geometry stays in the scene, so that an animation
/// uploads it only once.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The camera in use, in world space.
    pub camera: Camera,
    /// One for each of the scene's lights, in world space; black and invisible while switched off.
    pub lights: Vec<Light>,
    /// Radiance of rays that hit nothing.
    pub background: Background,
    /// Linear radiance of the ambient term, multiplied by [`super::Phong::ambient`].
    pub ambient: Vec3,
    /// The plane beyond which the scene is cut away.
    pub section: Option<Section>,
    /// One for each of the scene's nodes.
    pub nodes: Vec<NodeState>,
    /// One for each of the scene's materials if a track animates any; otherwise empty, and the scene's
    /// materials apply.
    pub materials: Vec<Material>,
    /// One for each of the scene's textures if a track animates any; otherwise empty, and the scene's textures apply.
    pub textures: Vec<Texture>,
    /// For each of the scene's deformations the weights of its morph targets.
    pub weights: Vec<Vec<f64>>,
}

/// The state of a [`super::Node`] at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeState {
    /// Invertible.
    pub world_from_node: DAffine3,
    /// Whether the node and all of its ancestors are visible.
    pub visible: bool,
}

impl Scene {
    /// The scene at `time` seconds, seen by its default camera.
    ///
    /// Values that overshoot on cubic and Bézier curves are clamped to the documented range of the
    /// property. A track whose values do not have the type of its target has no effect.
    pub fn frame(&self, time: f64) -> Frame {
        self.frame_while(time, time)
    }

    /// The scene at `time`; properties that are frozen while the shutter is open have their state at
    /// `opened`.
    pub(super) fn frame_while(&self, time: f64, opened: f64) -> Frame {
        let nodes = self.nodes_at(time, opened);
        Frame {
            camera: self.camera_at(time, &nodes),
            lights: self.lights_at(time, opened, &nodes),
            background: self.background.clone(),
            ambient: self.ambient,
            section: self.section,
            materials: self.materials_at(opened),
            textures: self.textures_at(opened),
            weights: self.weights_at(time),
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

    /// The weights of the morph targets of each deformation.
    pub(super) fn weights_at(&self, time: f64) -> Vec<Vec<f64>> {
        let at_rest = self.deformations.iter().map(|it| it.weights.clone());
        let mut weights: Vec<_> = at_rest.collect();
        for track in &self.tracks {
            for target in &track.targets {
                if let Target::Weight(deformation, index) = *target
                    && let Value::Scalar(value) = track.curve.at(time)
                {
                    weights[deformation][index] = value;
                }
            }
        }
        weights
    }

    /// For each node, whether a track moves or hides it or one of its ancestors.
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

    /// Whether any track changes a property over time.
    pub fn is_animated(&self) -> bool {
        self.tracks.iter().any(|track| !track.curve.is_constant())
    }

    /// The end of the animation in seconds, if something is elsewhere then than at its start, to which it returns
    /// at once.
    pub fn begins_again_at(&self) -> Option<f64> {
        let end = self.duration();
        let jumps = |track: &Track| {
            let (first, last) = track.curve.span();
            let is_near = (last - end).abs() <= 1e-6 * end;
            let ends_apart = track.curve.at(first) != track.curve.at(last);
            track.curve.beyond == Beyond::Repeat && is_near && ends_apart
        };
        self.tracks.iter().any(jumps).then_some(end)
    }

    /// Duration of the animation in seconds: the file's, otherwise the time of the last key, extended to
    /// a whole cycle for ping-pong tracks; 0 if there is none.
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

/// The curves of each node, for evaluating some nodes of the hierarchy without the others.
pub(super) struct Hierarchy<'a> {
    scene: &'a Scene,
    /// Sorted by node.
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

    /// The state of a node; `states` holds at least those of its ancestors.
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

/// The rotation by radians about x, then y, then z.
pub(super) fn rotation_from(angles: DVec3) -> DQuat {
    DQuat::from_rotation_z(angles.z)
        * DQuat::from_rotation_y(angles.y)
        * DQuat::from_rotation_x(angles.x)
}

/// `scale`, with components kept at least a millionth of those at `rest` away from 0, which they would
/// cross between a positive and a negative key.
fn invertible(scale: DVec3, rest: DVec3) -> DVec3 {
    let least = 1e-6 * rest.abs();
    let kept = scale.abs().max(least);
    DVec3::select(scale.cmplt(DVec3::ZERO), -kept, kept)
}

/// The state of a switch when the shutter opens.
fn is_on(curve: &Curve, opened: f64) -> bool {
    matches!(curve.at(opened), Value::Scalar(value) if value >= 0.5)
}

/// A colour in f32, clamped to the valid range.
fn color(value: DVec3) -> Vec3 {
    value
        .clamp(DVec3::ZERO, DVec3::splat(f64::from(f32::MAX)))
        .as_vec3()
}

impl Target {
    /// Whether a track with `values` can drive this target.
    pub fn accepts(self, values: &Values) -> bool {
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
            | Self::Weight(..)
            | Self::Material(_, Material::Shininess | Material::Opacity | Material::Ior) => {
                matches!(values, Values::Scalar(_))
            }
            _ => matches!(values, Values::Vector(_)),
        }
    }
}
