//! Which transparent bodies the camera is inside of.

use super::PackError;
use crate::{
    layout::NONE,
    scene::{Form, Frame, Geometry, MaterialProperty, Scene, Target},
};
use glam::{DVec3, Vec3};

/// Most media that a ray remembers.
pub const MEDIA_SIZE: usize = 4;

/// A closed surface of a transparent material.
#[derive(Clone, Debug)]
pub struct Body {
    /// In whose space it is; `None` is the world.
    node: Option<usize>,
    material: u32,
    /// Of its bounds, to tell what lies inside what.
    volume: f64,
    surface: Surface,
}

#[derive(Clone, Debug)]
enum Surface {
    Shape(Geometry),
    Mesh(Vec<[DVec3; 3]>),
}

/// The bodies of a scene that are transparent at some time, the largest first.
pub fn bodies(scene: &Scene, rest: &Frame) -> Vec<Body> {
    let size = |node: Option<usize>| {
        node.map_or(1.0, |node| {
            rest.nodes[node].world_from_node.matrix3.determinant().abs()
        })
    };
    let is_clear = |material: usize| {
        let becomes = Target::Material(material, MaterialProperty::Transmit);
        let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
        scene.materials[material].transmit != Vec3::ZERO || targets.any(|target| *target == becomes)
    };
    let shapes = (scene.shapes.iter())
        .filter(|shape| is_clear(shape.material) && is_closed(&shape.geometry))
        .map(|shape| {
            let bounds = shape.geometry.bounds();
            let volume = bounds.map_or(f64::INFINITY, |(min, max)| (max - min).element_product());
            Body {
                node: shape.node,
                material: shape.material as u32,
                volume: volume * size(shape.node),
                surface: Surface::Shape(shape.geometry),
            }
        });
    let meshes = scene.instances.iter().filter_map(|instance| {
        let mesh = &scene.meshes[instance.mesh];
        // A mesh of several materials is several bodies, which nothing tells apart.
        let material = *mesh.materials.first()?;
        if mesh.materials.iter().any(|&other| other != material) {
            return None;
        }
        let corner = |&i: &u32| {
            let p = mesh.positions[i as usize].as_dvec3();
            instance.placement.transform_point3(p)
        };
        let triangles: Vec<[DVec3; 3]> = (mesh.triangles.iter())
            .map(|t| [corner(&t[0]), corner(&t[1]), corner(&t[2])])
            .collect();
        let points = triangles.iter().flatten().copied();
        let (min, max) = points
            .clone()
            .zip(points)
            .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        is_clear(material as usize).then_some(Body {
            node: instance.node,
            material,
            volume: (max - min).element_product() * size(instance.node),
            surface: Surface::Mesh(triangles),
        })
    });
    let mut bodies: Vec<_> = shapes.chain(meshes).collect();
    bodies.sort_by(|a, b| b.volume.total_cmp(&a.volume));
    bodies
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
    let mut media = [NONE; MEDIA_SIZE];
    // Without changing materials a frame has none.
    let is_clear = |body: &&Body| {
        let material = frame.materials.get(body.material as usize);
        material.is_none_or(|material| material.transmit != Vec3::ZERO)
    };
    let inside = bodies
        .iter()
        .filter(is_clear)
        .filter(|body| match body.node {
            None => body.contains(point),
            Some(node) => {
                let state = frame.nodes[node];
                state.visible
                    && body.contains(state.world_from_node.inverse().transform_point3(point))
            }
        });
    let materials: Vec<u32> = inside.map(|body| body.material).collect();
    if materials.len() > MEDIA_SIZE {
        return Err(PackError::TooMany {
            what: "transparent bodies round the camera",
            count: materials.len(),
            limit: MEDIA_SIZE,
        });
    }
    media[..materials.len()].copy_from_slice(&materials);
    Ok(media)
}

fn is_closed(geometry: &Geometry) -> bool {
    !matches!(
        geometry,
        Geometry::Placed {
            form: Form::Disc { .. } | Form::Rectangle | Form::Cone { capped: false, .. },
            ..
        }
    )
}

impl Body {
    fn contains(&self, point: DVec3) -> bool {
        match &self.surface {
            Surface::Shape(geometry) => shape_contains(geometry, point),
            Surface::Mesh(triangles) => mesh_contains(triangles, point),
        }
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
            form,
            world_from_form,
        } => {
            let p = world_from_form.inverse().transform_point3(point);
            let off_axis = p.x.hypot(p.z);
            match form {
                Form::Box => p.abs().max_element() < 1.0,
                Form::Ellipsoid => p.length() < 1.0,
                Form::Torus { minor } => (off_axis - 1.0).hypot(p.y) < minor,
                Form::Cone { bottom, top, .. } => {
                    0.0 < p.y && p.y < 1.0 && off_axis < bottom + (top - bottom) * p.y
                }
                Form::Disc { .. } | Form::Rectangle => false,
            }
        }
    }
}

/// Whether a ray from the point crosses the mesh an odd number of times. Its direction is no axis
/// and no diagonal, so that it hardly meets an edge.
fn mesh_contains(triangles: &[[DVec3; 3]], point: DVec3) -> bool {
    let direction = DVec3::new(0.541_196, 0.723_607, 0.428_571);
    let crosses = |&[a, b, c]: &[DVec3; 3]| {
        let (edge1, edge2, from) = (b - a, c - a, point - a);
        let p = direction.cross(edge2);
        let determinant = edge1.dot(p);
        let q = from.cross(edge1);
        let (u, v) = (from.dot(p) / determinant, direction.dot(q) / determinant);
        determinant != 0.0
            && u >= 0.0
            && v >= 0.0
            && u + v <= 1.0
            && edge2.dot(q) / determinant > 0.0
    };
    triangles.iter().filter(|t| crosses(t)).count() % 2 == 1
}
