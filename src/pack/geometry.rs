//! Packs meshes and shapes in render space, or in the space of an instanced BLAS.

use super::PackError;
use crate::{
    bvh::Aabb,
    layout::{
        PackedShape, PackedTriangle, PackedVertex, SHAPE_BOX, SHAPE_CAPPED, SHAPE_CONE, SHAPE_DISC,
        SHAPE_ELLIPSOID, SHAPE_GLOBE, SHAPE_PLANE, SHAPE_RECTANGLE, SHAPE_SPHERE, SHAPE_TORUS,
    },
    scene::{CanonicalShape, Geometry, Mesh},
};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// Beyond this limit, squares of coordinates overflow f32.
const COORDINATE_LIMIT: f64 = 1e15;

/// A sphere whose radius exceeds its distance from the render origin by this factor is packed as a globe: with
/// a centre and a radius in f32, the error of its surface would be visible.
const GLOBE_RATIO: f64 = 16.0;

/// Geometry in scene order.
#[derive(Default)]
pub struct Flat {
    pub triangles: Vec<PackedTriangle>,
    pub vertices: Vec<PackedVertex>,
    /// Bounded shapes with their boxes, and unbounded ones.
    pub bounded: Vec<(PackedShape, Aabb)>,
    pub planes: Vec<PackedShape>,
}

impl Flat {
    /// A single mesh; see [`Self::add_mesh`].
    pub fn of_mesh(
        mesh: &Mesh,
        world_from_object: DAffine3,
        origin: DVec3,
        vertex: u32,
    ) -> Result<Self, PackError> {
        let mut flat = Self::default();
        flat.add_mesh(mesh, world_from_object, origin, vertex)?;
        Ok(flat)
    }

    /// Adds a shape in render space with this origin, or in its own space.
    pub fn add_shape(
        &mut self,
        geometry: &Geometry,
        material: usize,
        id: usize,
        render_origin: Option<DVec3>,
    ) -> Result<(), PackError> {
        let origin = render_origin.unwrap_or(DVec3::ZERO);
        let mut packed = PackedShape {
            material: material as u32,
            id: id as u32,
            ..Default::default()
        };
        match *geometry {
            Geometry::Sphere { center, radius } => {
                in_range(radius)?;
                let center_from_origin = center - origin;
                let height = center_from_origin.length() - radius;
                if render_origin.is_some() && radius > GLOBE_RATIO * height.abs() {
                    let normal = -center_from_origin.normalize();
                    in_range(center_from_origin.abs().max_element())?;
                    packed.kind = SHAPE_GLOBE;
                    packed.position = (-height * normal).as_vec3().into();
                    packed.row_y = normal.as_vec3().into();
                    packed.size0 = radius.recip() as f32;
                } else {
                    packed.kind = SHAPE_SPHERE;
                    packed.position = render_point(center, origin)?.into();
                    packed.size0 = radius as f32;
                }
            }
            Geometry::Plane { point, normal } => {
                // The perpendicular foot from the origin is the point that f32 represents best.
                let foot = origin + normal * normal.dot(point - origin);
                packed.kind = SHAPE_PLANE;
                packed.position = render_point(foot, origin)?.into();
                packed.row_y = normal.as_vec3().into();
                let (u, v) = Geometry::plane_axes(normal);
                (packed.row_x, packed.row_z) = (u.as_vec3().into(), v.as_vec3().into());
                (packed.size0, packed.size1) =
                    (u.dot(origin - point) as f32, v.dot(origin - point) as f32);
                self.planes.push(packed);
                return Ok(());
            }
            Geometry::Placed {
                canonical,
                world_from_canonical,
            } => {
                let mut render_from_canonical = world_from_canonical.matrix3;
                (packed.kind, packed.size0, packed.size1, packed.flags) = match canonical {
                    CanonicalShape::Disc { hole } => (SHAPE_DISC, hole as f32, 0.0, 0),
                    CanonicalShape::Rectangle => (SHAPE_RECTANGLE, 0.0, 0.0, 0),
                    CanonicalShape::Box => (SHAPE_BOX, 0.0, 0.0, 0),
                    CanonicalShape::Cone {
                        bottom,
                        top,
                        capped,
                    } => {
                        // The shader expects cones scaled to a radius of 1, where f32 is most precise.
                        let wide = bottom.max(top);
                        render_from_canonical.x_axis *= wide;
                        render_from_canonical.z_axis *= wide;
                        let flags = if capped { SHAPE_CAPPED } else { 0 };
                        let radii = ((bottom / wide) as f32, (top / wide) as f32);
                        (SHAPE_CONE, radii.0, radii.1, flags)
                    }
                    CanonicalShape::Torus { minor } => (SHAPE_TORUS, minor as f32, 0.0, 0),
                    CanonicalShape::Ellipsoid => (SHAPE_ELLIPSOID, 0.0, 0.0, 0),
                };
                packed.position = render_point(world_from_canonical.translation, origin)?.into();
                let canonical_from_render = render_from_canonical.inverse();
                let rows = [0, 1, 2].map(|i| canonical_from_render.row(i));
                for row in rows {
                    large_enough(row.length().recip())?;
                }
                [packed.row_x, packed.row_y, packed.row_z] = rows.map(|row| row.as_vec3().into());
            }
        }
        let (min, max) = geometry.bounds().unwrap_or_default();
        let (min, max) = (render_point(min, origin)?, render_point(max, origin)?);
        // Enlarged for the rounding of the bounds, the position and the rows.
        let slack = (min.abs().max(max.abs()) + (max - min).max_element()) * (2.0 * f32::EPSILON);
        let bounds = Aabb {
            min: min - slack,
            max: max + slack,
        };
        self.bounded.push((packed, bounds));
        Ok(())
    }

    /// Adds a mesh in render space. Its vertex indices start at `vertex` plus the vertices added so far. All
    /// arithmetic before the final rounding is f64.
    pub fn add_mesh(
        &mut self,
        mesh: &Mesh,
        world_from_object: DAffine3,
        origin: DVec3,
        vertex: u32,
    ) -> Result<(), PackError> {
        // Normals transform by the inverse transpose; mirroring keeps them on their side.
        let normal_matrix: DMat3 = world_from_object.matrix3.inverse().transpose();
        let first_vertex = vertex as usize + self.vertices.len();
        if first_vertex + mesh.positions.len() > u32::MAX as usize {
            return Err(PackError::TooMany {
                what: "vertices",
                count: first_vertex + mesh.positions.len(),
                limit: u32::MAX as usize,
            });
        }
        let mut positions = Vec::with_capacity(mesh.positions.len());
        self.vertices.reserve(mesh.positions.len());
        for (i, position) in mesh.positions.iter().enumerate() {
            let world = world_from_object.transform_point3(position.as_dvec3());
            positions.push(render_point(world, origin)?);
            let normal = (normal_matrix * mesh.normals[i].as_dvec3()).normalize_or(DVec3::Y);
            self.vertices.push(PackedVertex {
                normal: normal.as_vec3().into(),
                material: mesh.materials[i],
            });
        }
        self.triangles
            .extend(mesh.triangles.iter().map(|&[a, b, c]| {
                let corner = |i: u32| positions[i as usize].into();
                let vertex = |i: u32| first_vertex as u32 + i;
                PackedTriangle {
                    v0: corner(a),
                    i0: vertex(a),
                    v1: corner(b),
                    i1: vertex(b),
                    v2: corner(c),
                    i2: vertex(c),
                }
            }));
        Ok(())
    }
}

/// Transforms a point from world to render space.
pub fn render_point(world: DVec3, origin: DVec3) -> Result<Vec3, PackError> {
    let p = world - origin;
    in_range(p.abs().max_element())?;
    Ok(p.as_vec3())
}

/// Rejects a length whose square overflows f32.
pub fn in_range(value: f64) -> Result<(), PackError> {
    if value > COORDINATE_LIMIT {
        return Err(PackError::OutOfRange {
            value,
            limit: COORDINATE_LIMIT,
        });
    }
    Ok(())
}

/// Rejects a size that cannot be scaled up to 1 in f32.
fn large_enough(size: f64) -> Result<(), PackError> {
    let limit = COORDINATE_LIMIT.recip();
    if size < limit {
        return Err(PackError::TooSmall { size, limit });
    }
    Ok(())
}

pub fn triangle_box(triangle: &PackedTriangle) -> Aabb {
    Aabb::of([triangle.v0, triangle.v1, triangle.v2].map(Vec3::from))
}
