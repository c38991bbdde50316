//! A camera that orbits a scene once, with lights attached to it.

mod framing;

use super::{
    Attenuation, Background, Beyond, Camera, Curve, Easing, Geometry, Interpolation, Light,
    LightKind, Node, NodeProperty, Scene, Target, Track, Values,
};
use framing::Swept;
use glam::{DAffine3, DQuat, DVec3, Vec3};
use std::f64::consts::TAU;

/// Largest elevation of a turntable's camera, in radians: it must not look along the axis.
pub const MAX_ELEVATION: f64 = 89.0 * std::f64::consts::PI / 180.0;

/// Options of [`turntable`].
#[derive(Clone, Debug, PartialEq)]
pub struct Turntable {
    /// Axis of the turntable through the centre of the scene's bounds, pointing upwards in the image; any
    /// length but 0.
    pub axis: DVec3,
    /// Elevation of the camera in radians; clamped to ±[`MAX_ELEVATION`].
    pub elevation: f64,
    /// Duration of a turn, above 0.
    pub seconds: f64,
    /// Vertical field of view in radians, in (0, π).
    pub fov_y: f64,
    /// Aspect ratio of the image, above 0.
    pub aspect: f64,
    /// Margin as a fraction of half the image's width and height, in [0, 1).
    pub margin: f64,
    /// Whether the scene appears to turn clockwise, seen from the tip of the axis.
    pub clockwise: bool,
}

impl Default for Turntable {
    /// Counter-clockwise about +Y in eight seconds, seen from slightly above, with aspect ratio 4:3.
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

/// Replaces the cameras of `scene` with one that orbits it once every [`Turntable::seconds`], at the
/// smallest distance that keeps all bounded geometry in frame for the whole turn: it just touches the
/// margin above and below, or left and right. The camera starts in front of the scene, at +Z if the axis
/// is +Y. Returns `false` and leaves the scene as it is if nothing is bounded.
///
/// Geometry that moves is in frame at many times of its animation, so that all of it is. A scene without lights,
/// or with the lamps of [`Scene::staged`] in their place, gets a soft three-light rig attached to the camera, as if the
/// scene turned on a table in front of it, and a grey background if its own is black or staged. The ground of
/// a staged scene is removed, as it would not turn with it, unless it only catches the shadow.
pub fn turntable(scene: &mut Scene, options: &Turntable) -> bool {
    let Some((min, max)) = scene.bounds_over_time() else {
        return false;
    };
    let axis = options.axis.normalize_or(DVec3::Y);
    let center = min.midpoint(max);
    let placement = about(axis, center);
    let swept = Swept::new(scene, placement.inverse());
    let elevation = options.elevation.clamp(-MAX_ELEVATION, MAX_ELEVATION);
    let view = swept.view(elevation, options);

    let look_at = DVec3::Y * view.height;
    // Never 0, not even for a single point far from the origin.
    let radius = swept.radius(view.height);
    let radius = radius.max(1e-6 * center.abs().max_element().max(1e-6));
    let (sin, cos) = elevation.sin_cos();
    let camera = Camera {
        name: "turntable".to_owned(),
        look_from: look_at + view.distance.max(1e-3 * radius) * DVec3::new(0.0, sin, cos),
        look_at,
        fov_y: options.fov_y,
        ..Camera::default()
    };
    let node = circle(scene, camera, placement, options.seconds, options.clockwise);
    if scene.staged {
        let Scene {
            shapes, materials, ..
        } = scene;
        shapes.retain(|shape| {
            !matches!(shape.geometry, Geometry::Plane { .. })
                || materials[shape.material].shadow_catcher
        });
    }
    let is_lamp = |light: &Light| light.kind.radiance().is_some();
    let needs_rig = match scene.staged {
        true => scene.lights.iter().any(is_lamp),
        false => scene.lights.is_empty(),
    };
    if needs_rig {
        scene.lights.retain(|light| !is_lamp(light));
        light(scene, node, look_at, radius);
    }
    let is_stage = scene.staged && matches!(scene.background, Background::Gradient { .. });
    if is_stage || needs_rig && !scene.staged && scene.background == Background::default() {
        // A gradient follows the world's y and would tilt with any other axis.
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
    true
}

/// Lets `camera`, which is in world space, circle the axis through `around`, a point and a direction of any length but 0,
/// once in `seconds` (above 0). It takes the place of all cameras. The scene appears to turn `clockwise` or not, seen from
/// the tip of the axis.
pub fn orbit(
    scene: &mut Scene,
    camera: &Camera,
    around: (DVec3, DVec3),
    seconds: f64,
    clockwise: bool,
) {
    let (center, axis) = around;
    let placement = about(axis.normalize_or(DVec3::Y), center);
    let inverse = placement.inverse();
    let camera = Camera {
        look_from: inverse.transform_point3(camera.look_from),
        look_at: inverse.transform_point3(camera.look_at),
        up: inverse.transform_vector3(camera.up),
        ..camera.clone()
    };
    circle(scene, camera, placement, seconds, clockwise);
}

impl Scene {
    /// Lets the scene be seen by this camera alone, which is in world space and stands still.
    pub fn hold_camera(&mut self, camera: Camera) {
        for track in &mut self.tracks {
            let is_camera = |target: &Target| matches!(target, Target::Camera(..));
            track.targets.retain(|target| !is_camera(target));
        }
        self.tracks.retain(|track| !track.targets.is_empty());
        self.cameras = vec![camera];
        self.camera_index = 0;
        self.blind_cameras = 0;
    }
}

/// The space whose y axis goes through `center` along `axis`, which is a unit vector.
fn about(axis: DVec3, center: DVec3) -> DAffine3 {
    DAffine3::from_rotation_translation(DQuat::from_rotation_arc(DVec3::Y, axis), center)
}

/// Replaces the cameras with one that circles the y axis of the space `placement`, in which it is given, once in
/// `seconds`. Returns the index of its node.
fn circle(
    scene: &mut Scene,
    camera: Camera,
    placement: DAffine3,
    seconds: f64,
    clockwise: bool,
) -> usize {
    let node = scene.nodes.len();
    scene.nodes.push(Node {
        name: "turntable".to_owned(),
        placement,
        ..Node::default()
    });
    scene.hold_camera(Camera {
        node: Some(node),
        target: None,
        ..camera
    });
    // The scene turns in the opposite direction to the camera.
    let turn = if clockwise { TAU } else { -TAU };
    scene.tracks.push(Track {
        targets: vec![Target::Node(node, NodeProperty::Angles)],
        curve: Curve {
            times: vec![0.0, seconds],
            values: Values::Vector(vec![DVec3::ZERO, DVec3::Y * turn]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Repeat,
        },
    });
    scene.output.duration = Some(seconds);
    node
}

/// A soft key light from the front right above, a fill light from the front left and a back light, for
/// geometry within `radius` of `center`, which is in the space of `node`.
fn light(scene: &mut Scene, node: usize, center: DVec3, radius: f64) {
    // No attenuation, so that large and small models are lit alike.
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
            name: String::new(),
        }
    };
    scene.lights.extend([
        soft(DVec3::new(0.7, 0.9, 0.9), 1.2, Vec3::new(0.74, 0.72, 0.68)),
        soft(DVec3::new(-1.0, 0.3, 0.8), 1.6, Vec3::new(0.24, 0.26, 0.29)),
        soft(DVec3::new(-0.2, 0.8, -1.0), 1.0, Vec3::splat(0.4)),
    ]);
    if scene.staged || scene.ambient == Vec3::ZERO {
        scene.ambient = Vec3::splat(0.12);
    }
}
