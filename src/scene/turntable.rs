//! A camera that goes once round what is in a scene, and lights that go with it.

mod framing;

use super::{
    Attenuation, Background, Beyond, Camera, Curve, Easing, Interpolation, Light, LightKind, Node,
    NodeProperty, Scene, Target, Track, Values,
};
use framing::Swept;
use glam::{DAffine3, DQuat, DVec3, Vec3};
use std::f64::consts::TAU;

/// How far from level the camera of a turntable may be, in radians: it must not look along the axis.
pub const MAX_ELEVATION: f64 = 89.0 * std::f64::consts::PI / 180.0;

/// How [`turntable`] shows a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Turntable {
    /// What the scene turns about, through the middle of its bounds, and upwards in the picture; of
    /// any length but 0.
    pub axis: DVec3,
    /// Radians by which the camera is above the level of what it looks at; kept within
    /// ±[`MAX_ELEVATION`].
    pub elevation: f64,
    /// What a turn takes, above 0.
    pub seconds: f64,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
    /// The picture's width over its height, above 0.
    pub aspect: f64,
    /// Share of half the picture's width and height that is left free at its edges, in [0, 1).
    pub margin: f64,
    /// Whether the scene appears to turn clockwise, seen from the tip of the axis.
    pub clockwise: bool,
}

impl Default for Turntable {
    /// Counter-clockwise about +Y in eight seconds, seen from a little above in a picture of 4:3.
    fn default() -> Self {
        Self {
            axis: DVec3::Y,
            elevation: 15_f64.to_radians(),
            seconds: 8.0,
            fov_y: 30_f64.to_radians(),
            aspect: 4.0 / 3.0,
            margin: 0.05,
            clockwise: false,
        }
    }
}

/// Gives `scene` a camera, in place of its own, that goes round it once in [`Turntable::seconds`]
/// and again, so near that over the whole turn everything bounded stays in the picture and just
/// reaches the margin above and below, or left and right. The camera starts in front, to +Z if the
/// axis is +Y. `false` if nothing is bounded; then the scene stays as it is.
///
/// It is in the picture as it stands at time 0; what moves by itself may leave it. Where the scene
/// has no lights, or those of [`Scene::staged`], it gets three soft ones, which go with the camera as
/// if the scene turned on a table before it, and a grey background if its own is black or staged.
pub fn turntable(scene: &mut Scene, options: &Turntable) -> bool {
    let Some((min, max)) = scene.bounds() else {
        return false;
    };
    let axis = options.axis.normalize_or(DVec3::Y);
    let center = min.midpoint(max);
    let placement =
        DAffine3::from_rotation_translation(DQuat::from_rotation_arc(DVec3::Y, axis), center);
    let swept = Swept::new(scene, placement.inverse());
    let elevation = options.elevation.clamp(-MAX_ELEVATION, MAX_ELEVATION);
    let view = swept.view(elevation, options);

    let node = scene.nodes.len();
    scene.nodes.push(Node {
        name: "turntable".to_owned(),
        placement,
        ..Node::default()
    });
    for track in &mut scene.tracks {
        let is_camera = |target: &Target| matches!(target, Target::Camera(..));
        track.targets.retain(|target| !is_camera(target));
    }
    scene.tracks.retain(|track| !track.targets.is_empty());
    // The scene turns against the camera.
    let turn = if options.clockwise { TAU } else { -TAU };
    scene.tracks.push(Track {
        targets: vec![Target::Node(node, NodeProperty::Angles)],
        curve: Curve {
            times: vec![0.0, options.seconds],
            values: Values::Vector(vec![DVec3::ZERO, DVec3::Y * turn]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Repeat,
        },
    });
    let look_at = DVec3::Y * view.height;
    // Never 0, not even for a single point far out.
    let radius = swept.radius(view.height);
    let radius = radius.max(1e-6 * center.abs().max_element().max(1e-6));
    let (sin, cos) = elevation.sin_cos();
    scene.cameras = vec![Camera {
        name: "turntable".to_owned(),
        look_from: look_at + view.distance.max(1e-3 * radius) * DVec3::new(0.0, sin, cos),
        look_at,
        fov_y: options.fov_y,
        node: Some(node),
        ..Camera::default()
    }];
    scene.camera_index = 0;
    scene.output.duration = Some(options.seconds);
    if scene.staged || scene.lights.is_empty() {
        light(scene, node, look_at, radius, axis);
    }
    true
}

/// Soft light from the front right above, from the front left and from behind, for what lies within
/// `radius` round `center`, which is in the space of `node`.
fn light(scene: &mut Scene, node: usize, center: DVec3, radius: f64, axis: DVec3) {
    // They do not fade, so that large and small models get the same.
    let soft = |towards: DVec3, size: f64, color: Vec3| {
        let normal = -towards.normalize();
        Light {
            kind: LightKind::Disc {
                center: center - 3.0 * radius * normal,
                normal,
                radius: size * radius,
            },
            color,
            attenuation: Attenuation::None,
            samples: 1,
            visible: false,
            node: Some(node),
        }
    };
    scene.lights = vec![
        soft(DVec3::new(0.7, 0.9, 0.9), 1.2, Vec3::new(0.74, 0.72, 0.68)),
        soft(DVec3::new(-1.0, 0.3, 0.8), 1.6, Vec3::new(0.24, 0.26, 0.29)),
        soft(DVec3::new(-0.2, 0.8, -1.0), 1.0, Vec3::splat(0.4)),
    ];
    if scene.staged || scene.ambient == Vec3::ZERO {
        scene.ambient = Vec3::splat(0.12);
    }
    if scene.staged || scene.background == Background::default() {
        // A gradient goes by the world's y, and would rock about any other axis.
        scene.background = if axis.x.hypot(axis.z) < 1e-9 {
            Background::Gradient {
                bottom: Vec3::splat(0.1),
                top: Vec3::splat(0.5),
            }
        } else {
            Background::Color(Vec3::splat(0.3))
        };
    }
    scene.staged = false;
}
