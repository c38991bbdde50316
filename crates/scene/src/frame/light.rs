//! Lights at one moment.

use super::{NodeState, color, is_on};
use crate::{Light, LightKind, LightProperty, Scene, Target, Value};
use glam::{DAffine3, DVec3, Vec3};

impl Scene {
    /// All lights in world space; lights that are off or attached to an invisible node are black.
    pub(crate) fn lights_at(&self, time: f64, opened: f64, nodes: &[NodeState]) -> Vec<Light> {
        let mut lights = self.lights.clone();
        let mut factors = vec![1.0; lights.len()];
        for track in &self.tracks {
            for target in &track.targets {
                let Target::Light(index, property) = *target else {
                    continue;
                };
                let light = &mut lights[index];
                match (property, track.curve.at(time)) {
                    (LightProperty::Position, Value::Vector(value)) => move_to(light, value),
                    (LightProperty::Direction, Value::Vector(value)) => turn_to(light, value),
                    (LightProperty::Color, Value::Vector(value)) => light.color = color(value),
                    (LightProperty::Intensity, Value::Scalar(value)) => {
                        factors[index] *= value.max(0.0);
                    }
                    (LightProperty::On, Value::Scalar(_)) => {
                        factors[index] *= f64::from(u8::from(is_on(&track.curve, opened)));
                        light.visible &= is_on(&track.curve, opened);
                    }
                    _ => {}
                }
            }
        }
        for (light, factor) in lights.iter_mut().zip(factors) {
            if factor != 1.0 {
                light.color = color(light.color.as_dvec3() * factor);
            }
            if let Some(node) = light.node.take() {
                place(&mut light.kind, nodes[node].world_from_node);
                if !nodes[node].visible {
                    light.color = Vec3::ZERO;
                    light.visible = false;
                }
            }
        }
        lights
    }
}

fn move_to(light: &mut Light, place: DVec3) {
    match &mut light.kind {
        LightKind::Directional { .. } => {}
        LightKind::Point { position } | LightKind::Spot { position, .. } => *position = place,
        LightKind::Rectangle { center, .. }
        | LightKind::Disc { center, .. }
        | LightKind::Sphere { center, .. } => *center = place,
    }
}

/// Directions interpolated between opposite keys may vanish; then the light keeps its own.
fn turn_to(light: &mut Light, towards: DVec3) {
    match &mut light.kind {
        LightKind::Directional { direction } | LightKind::Spot { direction, .. } => {
            *direction = towards.normalize_or(*direction);
        }
        LightKind::Disc { normal, .. } => *normal = towards.normalize_or(*normal),
        LightKind::Point { .. } | LightKind::Rectangle { .. } | LightKind::Sphere { .. } => {}
    }
}

/// Transforms a light by `world_from_node`. Positions and directions transform as points and vectors. A
/// rectangle becomes its image and still emits to the side that its normal is mapped to. Discs and
/// spheres stay round: a disc keeps its plane and gets the area of the ellipse, a sphere gets the volume
/// of the ellipsoid. Cone angles and colours stay as they are.
fn place(kind: &mut LightKind, world_from_node: DAffine3) {
    let matrix = world_from_node.matrix3;
    let point = |p: &mut DVec3| *p = world_from_node.transform_point3(*p);
    let along = |v: &mut DVec3| *v = (matrix * *v).normalize_or(*v);
    match kind {
        LightKind::Point { position } => point(position),
        LightKind::Directional { direction } => along(direction),
        LightKind::Spot {
            position,
            direction,
            ..
        } => {
            point(position);
            along(direction);
        }
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            point(center);
            *edge_u = matrix * *edge_u;
            *edge_v = matrix * *edge_v * matrix.determinant().signum();
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            point(center);
            let (u, v) = normal.any_orthonormal_pair();
            // u × v is the normal; a mirroring flips the product of the transformed edges.
            let area = (matrix * u).cross(matrix * v) * matrix.determinant().signum();
            *normal = area.normalize_or(*normal);
            *radius *= area.length().sqrt();
        }
        LightKind::Sphere { center, radius } => {
            point(center);
            *radius *= matrix.determinant().abs().cbrt();
        }
    }
}
