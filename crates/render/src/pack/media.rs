//! Dielectric volumes around the camera.

use super::{PackError, light, material, mesh::CachedMesh, shell::Shell};
use crate::layout::NONE;
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{CanonicalShape, Frame, Geometry, Instance, Scene};
use std::sync::Arc;

/// Maximum number of media in the list of a ray.
pub const MEDIA_SIZE: usize = 4;

/// A closed surface with a material that is transparent at some time.
#[derive(Clone, Debug)]
pub struct Volume {
    /// The node whose space it is in; `None` for world space.
    node: Option<usize>,
    material: u32,
    surface: Surface,
}

#[derive(Clone, Debug)]
enum Surface {
    Shape(Geometry),
    /// Shared by all instances of a mesh; the transform leads to the node.
    Mesh(Arc<Shell>, DAffine3),
}

/// The dielectric volumes of a scene, without deforming meshes.
pub fn volumes(scene: &Scene, meshes: &[Arc<CachedMesh>]) -> Vec<Volume> {
    let may_enclose = material::may_enclose(scene);
    let shapes = (scene.shapes.iter())
        .filter(|shape| may_enclose[shape.material] && is_closed(&shape.geometry))
        .map(|shape| Volume {
            node: shape.node,
            material: shape.material as u32,
            surface: Surface::Shape(shape.geometry),
        });
    let shells: Vec<_> = (meshes.iter())
        .map(|cached| {
            let mesh = &cached.mesh;
            // A mesh with several materials consists of several volumes that cannot be told apart.
            let material = *mesh.materials.first()?;
            let is_volume = may_enclose[material as usize]
                && mesh.materials.iter().all(|&other| other == material);
            let shell = if is_volume { cached.shell() } else { None };
            Some((shell?, material))
        })
        .collect();
    let still = |instance: &&Instance| scene.deformation_of(instance.mesh).is_none();
    let meshes = scene.instances.iter().filter(still).filter_map(|instance| {
        let (shell, material) = shells[instance.mesh].as_ref()?;
        Some(Volume {
            node: instance.node,
            material: *material,
            surface: Surface::Mesh(shell.clone(), instance.placement),
        })
    });
    shapes.chain(meshes).collect()
}

/// Whether a dielectric volume may touch or overlap another object. One mesh may contain several volumes, with
/// different materials or as disconnected parts.
pub fn may_touch(scene: &Scene, meshes: &[Arc<CachedMesh>]) -> bool {
    let lamps = light::visible(scene).count();
    let volumes = scene.shapes.len() + scene.instances.len() + lamps;
    let is_divided = || meshes.iter().any(|mesh| mesh.part_count() > 1);
    material::may_enclose(scene).contains(&true)
        && (volumes > 1 || scene.materials.len() > 1 || is_divided())
}

/// The materials of the volumes that contain a world-space point and are transparent in this frame, outermost
/// first, then [`NONE`].
///
/// # Errors
/// More than [`MEDIA_SIZE`] volumes contain the point.
pub fn at_point(
    volumes: &[Volume],
    frame: &Frame,
    point: DVec3,
) -> Result<[u32; MEDIA_SIZE], PackError> {
    let transmits = |material: u32| {
        let now = frame.materials.get(material as usize);
        now.is_none_or(|material| material.classical().transmit != Vec3::ZERO)
    };
    let mut inside: Vec<(f64, u32)> = (volumes.iter())
        .filter(|volume| transmits(volume.material))
        .filter_map(|volume| {
            let world_from_volume = match volume.node.map(|node| frame.nodes[node]) {
                None => DAffine3::IDENTITY,
                Some(state) if state.visible => state.world_from_node,
                Some(_) => return None,
            };
            let is_inside = volume.contains(world_from_volume.inverse().transform_point3(point));
            is_inside.then(|| (volume.extent(world_from_volume), volume.material))
        })
        .collect();
    if inside.len() > MEDIA_SIZE {
        return Err(PackError::TooMany {
            what: "transparent volumes around the camera",
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

impl Volume {
    fn contains(&self, point: DVec3) -> bool {
        match &self.surface {
            Surface::Shape(geometry) => shape_contains(geometry, point),
            Surface::Mesh(shell, placement) => {
                shell.contains(placement.inverse().transform_point3(point))
            }
        }
    }

    /// The volume of its bounding box in the world: a nested volume has the smaller one.
    fn extent(&self, world_from_volume: DAffine3) -> f64 {
        let bounds = match &self.surface {
            Surface::Shape(geometry) => geometry.placed(world_from_volume).bounds(),
            Surface::Mesh(shell, placement) => Some(shell.bounds(world_from_volume * *placement)),
        };
        bounds.map_or(f64::INFINITY, |(min, max)| (max - min).element_product())
    }
}

fn shape_contains(geometry: &Geometry, point: DVec3) -> bool {
    match *geometry {
        Geometry::Sphere { center, radius } => point.distance(center) < radius,
        // A half-space: the inside is opposite to the normal.
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
