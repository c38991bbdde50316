//! Packs lights, and the surfaces of visible ones.

use super::{
    PackError,
    geometry::{in_range, render_point},
};
use crate::layout::{
    ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, LIGHT_DIRECTIONAL, LIGHT_DISC, LIGHT_POINT,
    LIGHT_RECTANGLE, LIGHT_SPHERE, LIGHT_SPOT, PackedLight,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use glimray_scene::{
    Attenuation, CanonicalShape, Frame, Geometry, LUMINANCE, Light, LightKind, Material, Phong,
    Scene,
};

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
        emission: (light.color.as_dvec3() * radiance).as_vec3(),
        two_sided: false,
        bsdf: Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

/// The material over the shutter interval: its radiance is the mean of the piecewise linear interpolation
/// between the frames, the same as for the illumination. The trail of a lamp that moves and changes at the same
/// time therefore has uniform brightness.
pub fn mean_material(frames: &[Frame], light: usize) -> Material {
    let emission = |frame: &Frame| material(&frame.lights[light]).emission.as_dvec3();
    let weighted = frames.iter().zip(shutter_weights(frames.len()));
    let sum: DVec3 = weighted
        .map(|(frame, weight)| weight * emission(frame))
        .sum();
    Material {
        emission: sum.as_vec3(),
        ..material(&frames[0].lights[light])
    }
}

/// The weights of evenly spaced frames for the mean of what is linear between them; they add up to 1.
fn shutter_weights(count: usize) -> impl Iterator<Item = f64> {
    let last = count - 1;
    (0..count).map(move |i| match i {
        _ if last == 0 => 1.0,
        _ if i == 0 || i == last => 0.5 / last as f64,
        _ => 1.0 / last as f64,
    })
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

/// The part of a light's chance that does not depend on its power, so that a strong light far away does not hide a
/// weak one nearby.
const EVEN_PART: f64 = 0.1;

/// Half of the diagonal of a scene's bounds; 1 where [`set_chances`] does not need it.
pub fn radius(scene: &Scene) -> f64 {
    let fades = |light: &Light| {
        light.attenuation == Attenuation::InverseSquare
            && !matches!(light.kind, LightKind::Directional { .. })
    };
    let is_mixed = scene
        .lights
        .iter()
        .any(|light| fades(light) != fades(&scene.lights[0]));
    let bounds = if is_mixed { scene.bounds() } else { None };
    bounds.map_or(1.0, |(min, max)| (max - min).length() / 2.0)
}

/// The mean power of each light over the shutter interval, up to a factor that all have in common. `radius` is that of
/// the scene: lights that do not fade shine on a disc of this size.
pub fn powers(frames: &[Frame], radius: f64) -> Vec<f64> {
    let mut powers = vec![0.0; frames[0].lights.len()];
    for (frame, weight) in frames.iter().zip(shutter_weights(frames.len())) {
        for (sum, light) in powers.iter_mut().zip(&frame.lights) {
            *sum += weight * power(light, radius);
        }
    }
    powers
}

/// Sets the chances with which paths sample the lights of each key, in proportion to `powers`. They add up to `share`.
pub fn set_chances(lights: &mut [PackedLight], powers: &[f64], share: f64) {
    let total: f64 = powers.iter().sum();
    let lit = powers.iter().filter(|power| **power > 0.0).count() as f64;
    for key in lights.chunks_mut(powers.len().max(1)) {
        let mut sum = 0.0;
        for (light, power) in key.iter_mut().zip(powers) {
            let chance = match *power > 0.0 {
                true => share * (EVEN_PART / lit + (1.0 - EVEN_PART) * power / total),
                false => 0.0,
            };
            light.chance = chance as f32;
            light.place = (sum as f32).to_bits();
            sum += chance;
        }
    }
}

fn power(light: &Light, radius: f64) -> f64 {
    use std::f64::consts::PI;
    let luminance = LUMINANCE.dot(light.color.as_dvec3());
    let solid_angle = match light.kind {
        LightKind::Directional { .. } => return luminance * radius * radius,
        LightKind::Point { .. } | LightKind::Sphere { .. } => 4.0 * PI,
        LightKind::Spot { outer, .. } => 2.0 * PI * (1.0 - outer.cos()),
        LightKind::Rectangle { .. } | LightKind::Disc { .. } => PI,
    };
    let spread = match light.attenuation {
        Attenuation::InverseSquare => 1.0,
        Attenuation::None => radius * radius,
    };
    // Per steradian a light that fades sends its strength, which a light that does not sends per area.
    luminance * spread * solid_angle / PI
}

/// A light in render space, without its chance.
pub fn packed(light: &Light, origin: DVec3) -> Result<PackedLight, PackError> {
    let mut packed = PackedLight {
        direction: DVec3::NEG_Y.as_vec3().into(),
        color: light.color.into(),
        attenuation: match light.attenuation {
            Attenuation::InverseSquare => ATTENUATION_INVERSE_SQUARE,
            Attenuation::None => ATTENUATION_NONE,
        },
        sample_count: 1,
        visible: u32::from(light.visible && light.kind.radiance().is_some()),
        ..Default::default()
    };
    let direct = |direction: DVec3| direction.as_vec3().into();
    let position = match light.kind {
        LightKind::Point { position } => {
            packed.kind = LIGHT_POINT;
            position
        }
        LightKind::Directional { direction } => {
            packed.kind = LIGHT_DIRECTIONAL;
            packed.attenuation = ATTENUATION_NONE;
            packed.direction = direct(direction);
            origin
        }
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => {
            packed.kind = LIGHT_SPOT;
            packed.direction = direct(direction);
            packed.cos_inner = inner.cos() as f32;
            packed.cos_outer = outer.cos() as f32;
            position
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            in_range(edge_u.length().max(edge_v.length()))?;
            packed.kind = LIGHT_RECTANGLE;
            packed.direction = direct(edge_u.cross(edge_v).normalize_or(DVec3::NEG_Y));
            (packed.edge_u, packed.edge_v) = (direct(edge_u), direct(edge_v));
            center
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            in_range(radius)?;
            packed.kind = LIGHT_DISC;
            packed.direction = direct(normal);
            let (u, v) = normal.any_orthonormal_pair();
            (packed.edge_u, packed.edge_v) = (direct(u * radius), direct(v * radius));
            center
        }
        LightKind::Sphere { center, radius } => {
            in_range(radius)?;
            packed.kind = LIGHT_SPHERE;
            packed.radius = radius as f32;
            center
        }
    };
    packed.position = render_point(position, origin)?.into();
    if light.kind.radiance().is_some() {
        packed.sample_count = light.samples;
    }
    Ok(packed)
}
