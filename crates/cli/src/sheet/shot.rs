//! The cameras of a sheet, and the lamps that go with them.

use crate::args::View;
use glam::{DAffine3, DMat3, DVec3};
use glimray_app::advice::UNBOUNDED;
use glimray_app::error::AppError;
use glimray_scene::{Camera, Frame, Framing, Node, Scene};

/// Margin around the model, as a fraction of half the view.
const MARGIN: f64 = 0.12;

/// The field of view of the views in perspective, in radians.
const FOV_Y: f64 = 32.0 * std::f64::consts::PI / 180.0;

/// The longest that the scale bar may be, as a fraction of a view.
const LONGEST_BAR: f64 = 0.6;

/// A view with its camera.
pub struct Shot {
    pub view: View,
    pub frame: Frame,
}

/// All views of a sheet.
pub struct Shots {
    pub list: Vec<Shot>,
    /// The size of the model's bounding box, in scene units.
    pub extent: DVec3,
    /// The length of the scale bar in scene units, and in pixels of the views along an axis.
    pub bar: (f64, u32),
}

impl View {
    /// Whether the view is along an axis, and so to scale.
    pub fn is_to_scale(self) -> bool {
        !matches!(self, Self::FrontRight | Self::BackLeft)
    }

    /// The directions in world space that are right, up and towards the eye in the picture.
    pub fn axes(self) -> DMat3 {
        let (towards, up) = match self {
            Self::Front => (DVec3::Z, DVec3::Y),
            Self::Back => (DVec3::NEG_Z, DVec3::Y),
            Self::Left => (DVec3::NEG_X, DVec3::Y),
            Self::Right => (DVec3::X, DVec3::Y),
            Self::Top => (DVec3::Y, DVec3::NEG_Z),
            Self::Bottom => (DVec3::NEG_Y, DVec3::Z),
            Self::FrontRight => (DVec3::new(0.8, 0.6, 1.0), DVec3::Y),
            Self::BackLeft => (DVec3::new(-0.8, 0.6, -1.0), DVec3::Y),
        };
        let towards = towards.normalize();
        let right = up.cross(towards).normalize();
        DMat3::from_cols(right, towards.cross(right), towards)
    }
}

impl Shots {
    /// Places a camera for each of `views`, of `side` pixels square, in `scene`, which is then seen by the first one. The
    /// lamps of a bare model turn with the camera, so that no side is dark.
    ///
    /// # Errors
    /// Nothing in the scene is bounded.
    pub fn new(scene: &mut Scene, views: &[View], side: u32) -> Result<Self, AppError> {
        let Some((min, max)) = scene.bounds() else {
            return Err(AppError::Refused(UNBOUNDED.into()));
        };
        let (center, extent) = (min.midpoint(max), max - min);
        // Never 0, not even for a single point far from the origin.
        let least = 1e-6 * center.abs().max_element().max(1e-6);
        let longest = extent.max_element().max(least);
        let bar = bar(f64::from(side) * (1.0 - MARGIN) / longest, side);
        let height = f64::from(side) * bar.0 / f64::from(bar.1);
        let lamps = attach_lamps(scene);
        let shoot = |view: View| {
            let axes = view.axes();
            let camera = match view.is_to_scale() {
                true => Some(Camera {
                    look_from: center + extent.length().max(least) * axes.z_axis,
                    look_at: center,
                    up: axes.y_axis,
                    orthographic_height: Some(height),
                    ..Camera::default()
                }),
                false => scene.framed(&Framing {
                    towards: axes.z_axis,
                    fov_y: FOV_Y,
                    aspect: 1.0,
                    margin: MARGIN,
                }),
            };
            scene.hold_camera(camera.unwrap_or_default());
            if let Some(node) = lamps {
                let [there, back] = [center, -center].map(DAffine3::from_translation);
                scene.nodes[node].placement = there * DAffine3::from_mat3(axes) * back;
            }
            Shot {
                view,
                frame: scene.frame(0.0),
            }
        };
        // The first one last.
        let mut list: Vec<_> = views.iter().rev().copied().map(shoot).collect();
        list.reverse();
        Ok(Self { list, extent, bar })
    }

    /// The length of a pixel of the views along an axis, in scene units.
    pub fn units_per_pixel(&self) -> f64 {
        self.bar.0 / f64::from(self.bar.1)
    }
}

/// The length of a scale bar in scene units, which is 1, 2 or 5 times a power of ten, and in whole pixels, if a unit is at most
/// so many pixels long, in a view of `side` pixels.
fn bar(pixels_per_unit: f64, side: u32) -> (f64, u32) {
    let most = LONGEST_BAR * f64::from(side) / pixels_per_unit;
    let power = 10_f64.powi(most.log10().floor() as i32);
    let steps = [5.0, 2.0].into_iter();
    let step = steps.map(|step| step * power).find(|step| *step <= most);
    let length = step.unwrap_or(power);
    (length, (length * pixels_per_unit).floor().max(1.0) as u32)
}

/// Attaches the lamps of a bare model to a new node, which is returned.
fn attach_lamps(scene: &mut Scene) -> Option<usize> {
    let node = scene.nodes.len();
    if !scene.staged {
        return None;
    }
    scene.nodes.push(Node::default());
    for light in &mut scene.lights {
        if light.kind.radiance().is_some() {
            light.node = Some(node);
        }
    }
    Some(node)
}
