//! Instances and shapes flattened into render space.

use super::PackError;
use crate::{
    bvh::Aabb,
    layout::{PackedShape, PackedTriangle, PackedVertex, SHAPE_PLANE, SHAPE_SPHERE},
    scene::{Geometry, Instance, Mesh, Scene},
};
use glam::{DMat3, DVec3, Vec3};

/// Beyond this, squares of coordinates leave the range of f32.
const COORDINATE_LIMIT: f64 = 1e15;

/// A scene's geometry in render space, in scene order.
pub struct Flat {
    pub triangles: Vec<PackedTriangle>,
    pub vertices: Vec<PackedVertex>,
    /// Shapes that have bounds, and those that have none.
    pub bounded: Vec<PackedShape>,
    pub planes: Vec<PackedShape>,
    pub mixed_materials: bool,
}

/// Places every instance and shape. All arithmetic before the last rounding is f64.
pub fn flatten(scene: &Scene, origin: DVec3) -> Result<Flat, PackError> {
    let mut flat = Flat {
        triangles: Vec::with_capacity(scene.triangle_count()),
        vertices: Vec::new(),
        bounded: Vec::new(),
        planes: Vec::new(),
        mixed_materials: false,
    };
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        flat.add_mesh(mesh, instance, origin)?;
    }
    for (id, shape) in scene.shapes.iter().enumerate() {
        let (list, position, radius, normal, kind) = match shape.geometry {
            Geometry::Sphere { center, radius } => {
                (&mut flat.bounded, center, radius, DVec3::ZERO, SHAPE_SPHERE)
            }
            Geometry::Plane { point, normal } => {
                // The foot of the perpendicular from the origin is the point f32 keeps best.
                let foot = origin + normal * normal.dot(point - origin);
                (&mut flat.planes, foot, 0.0, normal, SHAPE_PLANE)
            }
        };
        in_range(radius)?;
        list.push(PackedShape {
            position: render_point(position, origin)?.into(),
            radius: radius as f32,
            normal: normal.as_vec3().into(),
            kind,
            material: shape.material as u32,
            id: id as u32,
            ..Default::default()
        });
    }
    Ok(flat)
}

impl Flat {
    fn add_mesh(
        &mut self,
        mesh: &Mesh,
        instance: &Instance,
        origin: DVec3,
    ) -> Result<(), PackError> {
        let world_from_object = instance.world_from_object;
        // Normals go by the inverse transpose; a mirroring keeps them on their side.
        let normal_matrix: DMat3 = world_from_object.matrix3.inverse().transpose();
        let first_vertex = self.vertices.len();
        if first_vertex + mesh.positions.len() > u32::MAX as usize {
            return Err(PackError::TooMany {
                what: "vertices",
                count: first_vertex + mesh.positions.len(),
                limit: u32::MAX as usize,
            });
        }
        let mut positions = Vec::with_capacity(mesh.positions.len());
        for (i, position) in mesh.positions.iter().enumerate() {
            let world = world_from_object.transform_point3(position.as_dvec3());
            positions.push(render_point(world, origin)?);
            let normal = (normal_matrix * mesh.normals[i].as_dvec3()).normalize_or(DVec3::Y);
            self.vertices.push(PackedVertex {
                normal: normal.as_vec3().into(),
                material: mesh.materials[i],
            });
        }
        for &[a, b, c] in &mesh.triangles {
            let material = |i: u32| mesh.materials[i as usize];
            self.mixed_materials |= material(a) != material(b) || material(a) != material(c);
            let corner = |i: u32| positions[i as usize].into();
            let vertex = |i: u32| first_vertex as u32 + i;
            self.triangles.push(PackedTriangle {
                v0: corner(a),
                i0: vertex(a),
                v1: corner(b),
                i1: vertex(b),
                v2: corner(c),
                i2: vertex(c),
            });
        }
        Ok(())
    }
}

/// World to render space.
pub fn render_point(world: DVec3, origin: DVec3) -> Result<Vec3, PackError> {
    let p = world - origin;
    in_range(p.abs().max_element())?;
    Ok(p.as_vec3())
}

fn in_range(value: f64) -> Result<(), PackError> {
    if value > COORDINATE_LIMIT {
        return Err(PackError::OutOfRange {
            value,
            limit: COORDINATE_LIMIT,
        });
    }
    Ok(())
}

pub fn triangle_box(triangle: &PackedTriangle) -> Aabb {
    let [a, b, c] = [triangle.v0, triangle.v1, triangle.v2].map(Vec3::from);
    Aabb {
        min: a.min(b).min(c),
        max: a.max(b).max(c),
    }
}

/// A sphere's box, rounded outwards.
pub fn shape_box(shape: &PackedShape) -> Aabb {
    let center = Vec3::from(shape.position);
    let slack = (center.abs() + shape.radius) * f32::EPSILON;
    Aabb {
        min: center - shape.radius - slack,
        max: center + shape.radius + slack,
    }
}
