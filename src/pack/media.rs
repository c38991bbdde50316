//! Which transparent bodies the camera is inside of.

use super::{PackError, light, material, mesh::CachedMesh, shell::Shell};
use crate::{
    layout::NONE,
    scene::{CanonicalShape, Frame, Geometry, Scene},
};
use glam::{DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// Most media that a ray remembers.
pub const MEDIA_SIZE: usize = 4;

/// A closed surface of a material that is transparent at some time.
#[derive(Clone, Debug)]
pub struct Body {
    /// In whose space it is; `None` is the world.
    node: Option<usize>,
    material: u32,
    surface: Surface,
}

#[derive(Clone, Debug)]
enum Surface {
    Shape(Geometry),
    /// All instances of a mesh share it; the transform leads to their own space.
    Mesh(Arc<Shell>, DAffine3),
}

/// The bodies of a scene that are transparent at some time.
pub fn bodies(scene: &Scene, meshes: &[Arc<CachedMesh>]) -> Vec<Body> {
    let may_be_clear = material::clear(scene);
    let shapes = (scene.shapes.iter())
        .filter(|shape| may_be_clear[shape.material] && is_closed(&shape.geometry))
        .map(|shape| Body {
            node: shape.node,
            material: shape.material as u32,
            surface: Surface::Shape(shape.geometry),
        });
    let shells: Vec<_> = (meshes.iter())
        .map(|cached| {
            let mesh = &cached.mesh;
            // A mesh of several materials is several bodies, which nothing tells apart.
            let material = *mesh.materials.first()?;
            let is_body = may_be_clear[material as usize]
                && mesh.materials.iter().all(|&other| other == material);
            let shell = if is_body { cached.shell() } else { None };
            Some((shell?, material))
        })
        .collect();
    let meshes = scene.instances.iter().filter_map(|instance| {
        let (shell, material) = shells[instance.mesh].as_ref()?;
        Some(Body {
            node: instance.node,
            material: *material,
            surface: Surface::Mesh(shell.clone(), instance.placement),
        })
    });
    shapes.chain(meshes).collect()
}

/// Whether a body that is transparent at some time may touch or overlap another body. One mesh may hold
/// several: mostly they differ in material, but parts that do not hang together are bodies as well.
pub fn may_touch(scene: &Scene, meshes: &[Arc<CachedMesh>]) -> bool {
    let lamps = light::visible(scene).count();
    let bodies = scene.shapes.len() + scene.instances.len() + lamps;
    let is_divided = || meshes.iter().any(|mesh| mesh.part_count() > 1);
    material::clear(scene).contains(&true)
        && (bodies > 1 || scene.materials.len() > 1 || is_divided())
}

/// The materials of the bodies round a point in the world that are transparent in this frame, the
/// outermost first, then [`NONE`].
///
/// # Errors
/// More than [`MEDIA_SIZE`] are nested there.
pub fn around(
    bodies: &[Body],
    frame: &Frame,
    point: DVec3,
) -> Result<[u32; MEDIA_SIZE], PackError> {
    let is_clear = |material: u32| {
        let now = frame.materials.get(material as usize);
        now.is_none_or(|material| material.transmit != Vec3::ZERO)
    };
    let mut inside: Vec<(f64, u32)> = (bodies.iter())
        .filter(|body| is_clear(body.material))
        .filter_map(|body| {
            let world_from_body = match body.node.map(|node| frame.nodes[node]) {
                None => DAffine3::IDENTITY,
                Some(state) if state.visible => state.world_from_node,
                Some(_) => return None,
            };
            let is_inside = body.contains(world_from_body.inverse().transform_point3(point));
            is_inside.then(|| (body.extent(world_from_body), body.material))
        })
        .collect();
    if inside.len() > MEDIA_SIZE {
        return Err(PackError::TooMany {
            what: "transparent bodies round the camera",
            count: inside.len(),
            limit: MEDIA_SIZE,
        });
    }
    inside.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut media = [NONE; MEDIA_SIZE];
    for (place, (_, material)) in media.iter_mut().zip(inside) {
        *place = material;
    }
    Ok(media)
}

fn is_closed(geometry: &Geometry) -> bool {
    !matches!(
        geometry,
        Geometry::Placed {
            canonical: CanonicalShape::Disc { .. }
                | CanonicalShape::Rectangle
                | CanonicalShape::Cone { capped: false, .. },
            ..
        }
    )
}

impl Body {
    fn contains(&self, point: DVec3) -> bool {
        match &self.surface {
            Surface::Shape(geometry) => shape_contains(geometry, point),
            Surface::Mesh(shell, placement) => {
                shell.contains(placement.inverse().transform_point3(point))
            }
        }
    }

    /// The volume of its box in the world: what lies inside another body has the smaller one.
    fn extent(&self, world_from_body: DAffine3) -> f64 {
        let bounds = match &self.surface {
            Surface::Shape(geometry) => geometry.placed(world_from_body).bounds(),
            Surface::Mesh(shell, placement) => Some(shell.bounds(world_from_body * *placement)),
        };
        bounds.map_or(f64::INFINITY, |(min, max)| (max - min).element_product())
    }
}

fn shape_contains(geometry: &Geometry, point: DVec3) -> bool {
    match *geometry {
        Geometry::Sphere { center, radius } => point.distance(center) < radius,
        // A half-space: inside is where the normal points away from.
        Geometry::Plane {
            point: foot,
            normal,
        } => normal.dot(point - foot) < 0.0,
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => {
            let p = world_from_canonical.inverse().transform_point3(point);
            let off_axis = p.x.hypot(p.z);
            match canonical {
                CanonicalShape::Box => p.abs().max_element() < 1.0,
                CanonicalShape::Ellipsoid => p.length() < 1.0,
                CanonicalShape::Torus { minor } => (off_axis - 1.0).hypot(p.y) < minor,
                CanonicalShape::Cone { bottom, top, .. } => {
                    0.0 < p.y && p.y < 1.0 && off_axis < bottom + (top - bottom) * p.y
                }
                CanonicalShape::Disc { .. } | CanonicalShape::Rectangle => false,
            }
        }
    }
}
