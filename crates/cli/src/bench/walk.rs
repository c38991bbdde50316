//! Closest hits on the host, in double precision: the rays of the sets start from them, so that the sets are the
//! same whatever adapter traces them. The result does not depend on the tree.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use glimray_render::bvh::{self, Aabb, Bvh, Child, Limits};
use glimray_scene::{Geometry, Mesh, Scene};

/// A scene of meshes and spheres with its trees.
pub struct Walker<'a> {
    scene: &'a Scene,
    /// A tree over the triangles of each mesh.
    meshes: Vec<Bvh>,
    /// World to object space of each instance.
    object_from_world: Vec<DAffine3>,
    /// The tree over instances (group 0) and spheres (group 1).
    top: Bvh,
}

/// The closest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Distance along the ray.
    pub t: f64,
    /// Geometric normal in world space, of unit length, on the side from which the ray comes.
    pub normal: DVec3,
}

/// A candidate: ties go to the lower object and then to the lower triangle.
#[derive(Clone, Copy)]
struct Best {
    t: f64,
    object: (u8, u32),
    triangle: u32,
    /// In object space.
    normal: DVec3,
}

const LIMITS: Limits = Limits {
    leaf_size: 4,
    stack_size: usize::MAX,
    alone: None,
};

impl<'a> Walker<'a> {
    /// Builds the trees. Nodes, planes and other shapes than spheres are not supported and are ignored.
    pub fn new(scene: &'a Scene) -> Self {
        let instances = scene.instances.iter().map(|instance| {
            let mesh = &scene.meshes[instance.mesh];
            enclosing(mesh.bounds_in(instance.placement).unwrap_or_default())
        });
        let spheres = scene.shapes.iter();
        let spheres = spheres.map(|shape| enclosing(shape.geometry.bounds().unwrap_or_default()));
        let boxes: Vec<_> = instances.chain(spheres).collect();
        let groups: Vec<_> = (0..boxes.len())
            .map(|index| u8::from(index >= scene.instances.len()))
            .collect();
        Self {
            scene,
            meshes: scene.meshes.iter().map(|mesh| tree_of(mesh)).collect(),
            object_from_world: (scene.instances.iter())
                .map(|instance| instance.placement.inverse())
                .collect(),
            top: bvh::build(&boxes, &groups, 2, LIMITS),
        }
    }

    /// The closest hit of each ray of origin and direction, in the order of the rays.
    pub fn closest_hits(&self, rays: &[(DVec3, DVec3)]) -> Vec<Option<Found>> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let part = rays.len().div_ceil(threads).max(1);
        std::thread::scope(|scope| {
            let walks: Vec<_> = (rays.chunks(part))
                .map(|rays| {
                    scope.spawn(move || -> Vec<_> {
                        rays.iter().map(|ray| self.closest_hit(*ray)).collect()
                    })
                })
                .collect();
            let hits = walks.into_iter().map(|walk| match walk.join() {
                Ok(hits) => hits,
                Err(panic) => std::panic::resume_unwind(panic),
            });
            hits.flatten().collect()
        })
    }

    fn closest_hit(&self, (origin, direction): (DVec3, DVec3)) -> Option<Found> {
        let mut best: Option<Best> = None;
        walk(
            &self.top,
            (origin, direction),
            f64::INFINITY,
            |group, index, limit| {
                match group {
                    0 => self.meet_instance(index, (origin, direction), &mut best),
                    _ => self.meet_sphere(index, (origin, direction), &mut best),
                }
                best.map_or(limit, |best| best.t)
            },
        );
        let best = best?;
        let normal = match best.object {
            (0, instance) => {
                let object_from_world: DMat3 = self.object_from_world[instance as usize].matrix3;
                object_from_world.transpose() * best.normal
            }
            _ => best.normal,
        };
        let normal = normal.normalize();
        let faces_ray = normal.dot(direction) < 0.0;
        Some(Found {
            t: best.t,
            normal: if faces_ray { normal } else { -normal },
        })
    }

    fn meet_instance(&self, index: u32, ray: (DVec3, DVec3), best: &mut Option<Best>) {
        let instance = &self.scene.instances[index as usize];
        let mesh = &self.scene.meshes[instance.mesh];
        let into = &self.object_from_world[index as usize];
        // t stays the same because the direction is not normalised.
        let (origin, direction) = (into.transform_point3(ray.0), into.transform_vector3(ray.1));
        let limit = best.map_or(f64::INFINITY, |best| best.t);
        walk(
            &self.meshes[instance.mesh],
            (origin, direction),
            limit,
            |_, triangle, limit| {
                let corners = mesh.triangles[triangle as usize];
                let corners = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
                if let Some((t, normal)) = meet_triangle(corners, origin, direction) {
                    keep(best, t, (0, index), triangle, normal);
                }
                best.map_or(limit, |best| best.t)
            },
        );
    }

    fn meet_sphere(
        &self,
        index: u32,
        (origin, direction): (DVec3, DVec3),
        best: &mut Option<Best>,
    ) {
        let index = index - self.scene.instances.len() as u32;
        let Geometry::Sphere { center, radius } = self.scene.shapes[index as usize].geometry else {
            return;
        };
        let from = origin - center;
        let (a, b) = (direction.length_squared(), from.dot(direction));
        // The discriminant from the distance between the centre and the ray, which cancels less.
        let nearest = from - b / a * direction;
        let discriminant = radius * radius - nearest.length_squared();
        if discriminant < 0.0 {
            return;
        }
        let root = (discriminant / a).sqrt();
        let hit = [-b / a - root, -b / a + root];
        if let Some(t) = hit.into_iter().find(|t| *t > 0.0) {
            keep(best, t, (1, index), 0, from + t * direction);
        }
    }
}

fn keep(best: &mut Option<Best>, t: f64, object: (u8, u32), triangle: u32, normal: DVec3) {
    let is_better = best.is_none_or(|best| {
        t < best.t || (t == best.t && (object, triangle) < (best.object, best.triangle))
    });
    if is_better {
        *best = Some(Best {
            t,
            object,
            triangle,
            normal,
        });
    }
}

/// Distance and normal, not normalised, of a triangle (Möller and Trumbore 1997).
fn meet_triangle([a, b, c]: [DVec3; 3], origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
    let (ab, ac, from) = (b - a, c - a, origin - a);
    let (across, aside) = (direction.cross(ac), from.cross(ab));
    let determinant = ab.dot(across);
    let (u, v) = (
        from.dot(across) / determinant,
        direction.dot(aside) / determinant,
    );
    let t = ac.dot(aside) / determinant;
    (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0)
        .then(|| (t, ab.cross(ac)))
}

fn tree_of(mesh: &Mesh) -> Bvh {
    let corner = |index: u32| mesh.positions[index as usize];
    let boxes: Vec<_> = (mesh.triangles.iter())
        .map(|triangle| Aabb::of(triangle.map(corner)))
        .collect();
    bvh::build(&boxes, &vec![0; boxes.len()], 1, LIMITS)
}

/// A box of f32 that contains a box of f64.
fn enclosing((min, max): (DVec3, DVec3)) -> Aabb {
    Aabb {
        min: Vec3::from(min.as_vec3().to_array().map(f32::next_down)),
        max: Vec3::from(max.as_vec3().to_array().map(f32::next_up)),
    }
}

/// Visits boxes on a ray that begin before a limit: `visit` receives the group and the index of a box and the
/// limit, and returns the new limit.
fn walk(
    bvh: &Bvh,
    (origin, direction): (DVec3, DVec3),
    limit: f64,
    mut visit: impl FnMut(u8, u32, f64) -> f64,
) {
    let inverse = direction.recip();
    let mut limit = limit;
    let mut open = vec![(0.0, Child::Node(0))];
    while let Some((near, child)) = open.pop() {
        if near > limit {
            continue;
        }
        match child {
            Child::Node(index) => {
                let first = open.len();
                let children = bvh.nodes[index as usize].children.iter();
                open.extend(children.filter_map(|(aabb, child)| {
                    let near = entry(aabb, origin, inverse)?;
                    (near <= limit).then_some((near, *child))
                }));
                open[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
            }
            Child::Leaf {
                group,
                first,
                count,
            } => {
                let order = &bvh.order[group as usize];
                for index in &order[first as usize..(first + count) as usize] {
                    limit = visit(group, *index, limit);
                }
            }
        }
    }
}

/// Where a ray enters a box, a little early to allow for rounding. A product of zero and infinity is not a
/// number, which `min` and `max` ignore.
fn entry(aabb: &Aabb, origin: DVec3, inverse: DVec3) -> Option<f64> {
    const SLACK: f64 = 1e-9;
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let to = |plane: f32| (f64::from(plane) - origin[axis]) * inverse[axis];
        let (a, b) = (to(aabb.min[axis]), to(aabb.max[axis]));
        near = near.max(a.min(b) - SLACK * a.min(b).abs());
        far = far.min(a.max(b) + SLACK * a.max(b).abs());
    }
    (near <= far).then_some(near)
}
