//! The part of the world that a picture shows.

use glam::DVec3;
use glimray_scene::{Camera, Scene};

/// How far beyond a plane a point may be that lies in it, as a share of its coordinates.
const SLACK: f64 = 1e-5;

/// The space between the near and the far plane of a camera, without the side that the section plane cuts away.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Points p with normal·p ≤ offset are inside of each.
    planes: Vec<(DVec3, f64)>,
}

impl Limits {
    /// The limits of a picture of a scene.
    pub fn of(scene: &Scene, camera: &Camera) -> Self {
        let forward = (camera.look_at - camera.look_from).normalize_or(DVec3::NEG_Z);
        let eye = camera.look_from.dot(forward);
        let (near, far) = camera.clip;
        let mut planes = vec![(-forward, -(eye + near)), (forward, eye + far)];
        planes.retain(|(_, offset)| offset.is_finite());
        planes.extend((scene.section).map(|section| (section.normal, section.offset)));
        Self { planes }
    }

    /// Whether a point in world space is inside. Points in the planes are.
    pub fn contain(&self, point: DVec3) -> bool {
        self.planes.iter().all(|plane| room(*plane, point) >= 0.0)
    }

    /// The part of a line in world space that is inside; `None` if nothing is left.
    pub fn clip(&self, (from, to): (DVec3, DVec3)) -> Option<(DVec3, DVec3)> {
        self.planes
            .iter()
            .try_fold((from, to), |(from, to), plane| {
                let (start, end) = (room(*plane, from), room(*plane, to));
                if start < 0.0 && end < 0.0 {
                    return None;
                }
                let crossing = || from.lerp(to, start / (start - end));
                Some((
                    if start < 0.0 { crossing() } else { from },
                    if end < 0.0 { crossing() } else { to },
                ))
            })
    }
}

/// How far within a plane a point is, in scene units; below 0 beyond it.
fn room((normal, offset): (DVec3, f64), point: DVec3) -> f64 {
    let slack = SLACK * point.abs().max_element().max(offset.abs());
    offset + slack - normal.dot(point)
}
