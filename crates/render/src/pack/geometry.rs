//! Packs meshes and shapes in render space, or in the space of an instanced BLAS.

use super::{
    PackError,
    shape_pieces::{self, ShapePiece},
};
use crate::{
    bvh::{Aabb, threads},
    layout::{
        PackedShape, PackedTangent, PackedTriangle, PackedVertex, SHAPE_BOX, SHAPE_CAPPED,
        SHAPE_CONE, SHAPE_DISC, SHAPE_ELLIPSOID, SHAPE_GLOBE, SHAPE_PLANE, SHAPE_RECTANGLE,
        SHAPE_SPHERE, SHAPE_TORUS,
    },
};
use glam::{DAffine3, DMat3, DVec3, Vec3, Vec4};
use glimray_scene::{CanonicalShape, Geometry, Mesh, PosedMesh};
use std::sync::Arc;

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
    /// Tangents of all vertices; empty if none has any.
    pub tangents: Vec<PackedTangent>,
    /// Bounded shapes with their boxes, and unbounded ones.
    pub bounded: Vec<(PackedShape, Aabb)>,
    pub planes: Vec<PackedShape>,
    /// Pieces of bounded shapes, in their order.
    pub pieces: Vec<ShapePiece>,
}

impl Flat {
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
        let enlarged = |min: Vec3, max: Vec3| Aabb {
            min: min - slack,
            max: max + slack,
        };
        for piece in shape_pieces::pieces(geometry) {
            let (min, max) = piece.bounds().unwrap_or_default();
            self.pieces.push(ShapePiece {
                shape: self.bounded.len() as u32,
                aabb: enlarged(render_point(min, origin)?, render_point(max, origin)?),
            });
        }
        let bounds = enlarged(min, max);
        self.bounded.push((packed, bounds));
        Ok(())
    }

    /// Adds a mesh in render space. Its vertex indices start at `vertex` plus the vertices added so far.
    pub fn add_mesh(
        &mut self,
        mesh: &Mesh,
        world_from_object: DAffine3,
        origin: DVec3,
        vertex: u32,
    ) -> Result<(), PackError> {
        let before = self.vertices.len();
        let first_vertex = vertex as usize + before;
        let placed = PlacedMesh::new(mesh, world_from_object, origin, first_vertex)?;
        self.vertices.extend_from_slice(&placed.vertices);
        if !placed.tangents.is_empty() {
            self.tangents.resize(before, PackedTangent::default());
            self.tangents.extend_from_slice(&placed.tangents);
        } else if !self.tangents.is_empty() {
            let count = self.vertices.len();
            self.tangents.resize(count, PackedTangent::default());
        }
        let triangles = (0..mesh.triangles.len()).map(|index| placed.triangle(index));
        self.triangles.extend(triangles);
        Ok(())
    }
}

/// A mesh in render space, or in the space of an instanced BLAS.
pub struct PlacedMesh<'a> {
    mesh: &'a Mesh,
    positions: Vec<Vec3>,
    /// In mesh order.
    pub vertices: Arc<[PackedVertex]>,
    /// One for each vertex; empty if the mesh has none.
    pub tangents: Arc<[PackedTangent]>,
    first_vertex: u32,
    /// How far the indices of neighbouring vertices are apart.
    stride: u32,
}

impl<'a> PlacedMesh<'a> {
    /// The vertices get indices from `first_vertex` on. All arithmetic before the final rounding is f64.
    pub fn new(
        mesh: &'a Mesh,
        world_from_object: DAffine3,
        origin: DVec3,
        first_vertex: usize,
    ) -> Result<Self, PackError> {
        check_vertex_count(first_vertex + mesh.positions.len())?;
        let from_origin =
            |position: &Vec3| world_from_object.transform_point3(position.as_dvec3()) - origin;
        let positions = threads::collect(mesh.positions.len(), |index| {
            from_origin(&mesh.positions[index]).as_vec3()
        });
        // Rounding may move a coordinate across the limit, so that those near it are checked before.
        let near_limit = (COORDINATE_LIMIT * 0.5) as f32;
        for (position, rounded) in mesh.positions.iter().zip(&positions) {
            if rounded.abs().max_element() > near_limit {
                in_range(from_origin(position).abs().max_element())?;
            }
        }
        // Normals transform by the inverse transpose; mirroring keeps them on their side.
        let normal_matrix: DMat3 = world_from_object.matrix3.inverse().transpose();
        let vertices = threads::collect_shared(mesh.positions.len(), |index| {
            let normal = (normal_matrix * mesh.normals[index].as_dvec3()).normalize_or(DVec3::Y);
            PackedVertex {
                normal: normal.as_vec3().into(),
                material: mesh.materials[index],
            }
        });
        let mirrors = world_from_object.matrix3.determinant() < 0.0;
        let tangents = threads::collect_shared(mesh.tangents.len(), |index| {
            let own = mesh.tangents[index];
            let direction = world_from_object.matrix3 * own.truncate().as_dvec3();
            packed_tangent(
                direction
                    .as_vec3()
                    .extend(if mirrors { -own.w } else { own.w }),
            )
        });
        Ok(Self {
            mesh,
            positions,
            vertices,
            tangents,
            first_vertex: first_vertex as u32,
            stride: 1,
        })
    }

    /// A mesh in a pose, whose positions are relative to `origin`; neighbouring vertices get indices that are `stride`
    /// apart. Otherwise as [`Self::new`].
    pub fn posed(
        mesh: &'a Mesh,
        posed: &PosedMesh,
        origin: DVec3,
        (first_vertex, stride): (usize, usize),
    ) -> Result<Self, PackError> {
        check_vertex_count(first_vertex + stride * posed.len())?;
        let moved = threads::collect(posed.len(), |index| {
            let (position, normal) = posed.vertex(index);
            let tangent = posed.tangent(index, normal);
            (position - origin, normal.as_vec3(), tangent)
        });
        for (position, ..) in &moved {
            in_range(position.abs().max_element())?;
        }
        Ok(Self {
            mesh,
            positions: moved
                .iter()
                .map(|(position, ..)| position.as_vec3())
                .collect(),
            vertices: (moved.iter().zip(&mesh.materials))
                .map(|((_, normal, _), &material)| PackedVertex {
                    normal: (*normal).into(),
                    material,
                })
                .collect(),
            tangents: match mesh.tangents.is_empty() {
                true => Arc::default(),
                false => (moved.iter().map(|(.., tangent)| packed_tangent(*tangent))).collect(),
            },
            first_vertex: first_vertex as u32,
            stride: stride as u32,
        })
    }

    /// The positions of the vertices.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// A triangle of the mesh.
    pub fn triangle(&self, index: usize) -> PackedTriangle {
        let [a, b, c] = self.mesh.triangles[index];
        let corner = |i: u32| self.positions[i as usize].into();
        let vertex = |i: u32| self.first_vertex + self.stride * i;
        PackedTriangle {
            v0: corner(a),
            i0: vertex(a),
            v1: corner(b),
            i1: vertex(b),
            v2: corner(c),
            i2: vertex(c),
        }
    }
}

/// w is the handedness.
fn packed_tangent(tangent: Vec4) -> PackedTangent {
    match tangent.truncate().as_dvec3().try_normalize() {
        None => PackedTangent::default(),
        Some(direction) => PackedTangent {
            direction: direction.as_vec3().into(),
            handedness: tangent.w,
        },
    }
}

fn check_vertex_count(count: usize) -> Result<(), PackError> {
    let (what, limit) = ("vertices", u32::MAX as usize);
    match count > limit {
        true => Err(PackError::TooMany { what, count, limit }),
        false => Ok(()),
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
    if value.is_nan() || value > COORDINATE_LIMIT {
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
    Aabb::of(corners(triangle))
}

pub fn corners(triangle: &PackedTriangle) -> [Vec3; 3] {
    [triangle.v0, triangle.v1, triangle.v2].map(Vec3::from)
}
