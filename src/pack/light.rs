//! The surfaces of visible lights.

use crate::scene::{CanonicalShape, Frame, Geometry, Light, LightKind, Material, Scene};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// The indices of visible lights, in scene order.
pub fn visible(scene: &Scene) -> impl Iterator<Item = usize> + '_ {
    let has_surface = |light: &Light| light.visible && unit_surface(&light.kind).is_some();
    (0..scene.lights.len()).filter(move |&index| has_surface(&scene.lights[index]))
}

/// The material index of a visible light's surface, after the materials of the scene, and its id, after those
/// of the shapes.
pub fn material_and_id(scene: &Scene, light: usize) -> (usize, usize) {
    let place = visible(scene).take_while(|&other| other != light).count();
    (scene.materials.len() + place, scene.shapes.len() + place)
}

/// The material of a visible light: it reflects nothing, and emits on the side on which the light emits.
pub fn material(light: &Light) -> Material {
    let radiance = light.kind.radiance().unwrap_or(0.0);
    Material {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        emission: (light.color.as_dvec3() * radiance).as_vec3(),
        two_sided: false,
        ..Material::default()
    }
}

/// The material over the shutter interval: its radiance is the mean of the piecewise linear interpolation
/// between the frames, the same as for the illumination. The trail of a lamp that moves and changes at the same
/// time therefore has uniform brightness.
pub fn mean_material(frames: &[Frame], light: usize) -> Material {
    let intervals = (frames.len() - 1) as f64;
    let last = frames.len() - 1;
    let mut sum = DVec3::ZERO;
    for (i, frame) in frames.iter().enumerate() {
        let weight = match i {
            _ if last == 0 => 1.0,
            _ if i == 0 || i == last => 0.5 / intervals,
            _ => intervals.recip(),
        };
        sum += weight * material(&frame.lights[light]).emission.as_dvec3();
    }
    Material {
        emission: sum.as_vec3(),
        ..material(&frames[0].lights[light])
    }
}

/// The surface of a light in world space.
pub fn surface(kind: &LightKind) -> Option<Geometry> {
    if let LightKind::Sphere { center, radius } = *kind {
        return Some(Geometry::Sphere { center, radius });
    }
    match unit_surface(kind)? {
        Geometry::Placed { canonical, .. } => Some(Geometry::Placed {
            canonical,
            world_from_canonical: world_from_unit(kind)?,
        }),
        other => Some(other),
    }
}

/// The surface of a light in its own space, which [`world_from_unit`] maps to the world.
pub fn unit_surface(kind: &LightKind) -> Option<Geometry> {
    let canonical = match kind {
        LightKind::Point { .. } | LightKind::Directional { .. } | LightKind::Spot { .. } => {
            return None;
        }
        LightKind::Rectangle { .. } => CanonicalShape::Rectangle,
        LightKind::Disc { .. } => CanonicalShape::Disc { hole: 0.0 },
        LightKind::Sphere { .. } => {
            return Some(Geometry::Sphere {
                center: DVec3::ZERO,
                radius: 1.0,
            });
        }
    };
    Some(Geometry::Placed {
        canonical,
        world_from_canonical: DAffine3::IDENTITY,
    })
}

/// The transform from the space of [`unit_surface`] to world space.
pub fn world_from_unit(kind: &LightKind) -> Option<DAffine3> {
    let (matrix, center) = match *kind {
        LightKind::Point { .. } | LightKind::Directional { .. } | LightKind::Spot { .. } => {
            return None;
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            let normal = edge_u.cross(edge_v).try_normalize()?;
            (DMat3::from_cols(edge_v, normal, edge_u), center)
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            let (x, z) = normal.any_orthonormal_pair();
            (DMat3::from_cols(x * radius, normal, z * radius), center)
        }
        LightKind::Sphere { center, radius } => {
            (DMat3::from_diagonal(DVec3::splat(radius)), center)
        }
    };
    Some(DAffine3::from_mat3_translation(matrix, center))
}
