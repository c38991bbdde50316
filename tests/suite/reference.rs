//! An independent reference tracer: f64, brute force, textbook formulas, written from the specification and
//! sharing no code with shaders or packing. Its submodules support tests of whole pictures: scenes, rendering
//! and comparison.

pub mod compare;
pub mod count;
mod moment;
mod optics;
pub mod rays;
pub mod scenes;
pub mod shapes;
pub mod spd;
pub mod textures;

use glam::{DAffine3, DVec2, DVec3};
use glimray::image::Image;
use glimray::render::{RayKind, Rays};
use glimray::scene::{
    Attenuation, Camera, CanonicalShape, Geometry, Light, LightKind, Material, Phong, Scene, Shape,
};
use moment::Carriers;
use optics::Place;
use rays::Log;
use std::f64::consts::TAU;

/// The picture and the number of rays it took.
pub struct Traced {
    /// Linear radiance, not clamped.
    pub image: Image,
    pub rays: Rays,
}

/// Renders `scene` through its default camera, one ray through the centre of each pixel.
pub fn trace(scene: &Scene, size: (u32, u32)) -> Traced {
    picture(&Tracer::new(scene, &Carriers::default()), size)
}

/// Renders a moving scene at `time`.
pub fn trace_at(scene: &Scene, time: f64, size: (u32, u32)) -> Traced {
    let (still, carriers) = moment::resolve(scene, time);
    picture(&Tracer::new(&still, &carriers), size)
}

fn picture(tracer: &Tracer, (width, height): (u32, u32)) -> Traced {
    let row = |y: u32| {
        let mut rays = Log::default();
        let pixels: Vec<_> = (0..width)
            .map(|x| {
                let (origin, direction) = pixel_ray(tracer.camera, (width, height), [x, y]);
                tracer.radiance(origin, direction, &mut rays)
            })
            .collect();
        (pixels, rays.counts)
    };
    // Two threads, even and odd rows, because brute force takes its time.
    let rows: Vec<_> = std::thread::scope(|scope| {
        let of = |first: u32| move || (first..height).step_by(2).map(row).collect::<Vec<_>>();
        let odd = scope.spawn(of(1));
        let even = of(0)();
        let mut odd = odd.join().expect("a traced half").into_iter();
        even.into_iter()
            .flat_map(|row| std::iter::once(row).chain(odd.next()))
            .collect()
    });

    let mut image = Image {
        width,
        height,
        pixels: Vec::new(),
    };
    let mut rays = Rays::default();
    for (pixels, row) in rows {
        image
            .pixels
            .extend(pixels.iter().map(|c| c.as_vec3().extend(1.0).to_array()));
        rays.primary += row.primary;
        rays.primary_hits += row.primary_hits;
        rays.shadow += row.shadow;
        rays.shadow_blocked += row.shadow_blocked;
        rays.reflection += row.reflection;
        rays.reflection_hits += row.reflection_hits;
        rays.refraction += row.refraction;
        rays.refraction_hits += row.refraction_hits;
    }
    Traced { image, rays }
}

/// Origin and direction of the ray through the centre of a pixel.
fn pixel_ray(camera: &Camera, (width, height): (u32, u32), [x, y]: [u32; 2]) -> (DVec3, DVec3) {
    let aspect = f64::from(width) / f64::from(height);
    let x = (f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0;
    let y = 1.0 - (f64::from(y) + 0.5) / f64::from(height) * 2.0;
    camera_ray(camera, DVec2::new(x * aspect, y))
}

/// The ray from the eye through (x, y) of the image plane at distance 1, whose upper edge is at y = 1; for an
/// orthographic camera straight ahead, from (x, y) of the plane through the eye.
fn camera_ray(camera: &Camera, at: DVec2) -> (DVec3, DVec3) {
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    if let Some(height) = camera.orthographic_height {
        let at = at * height / 2.0;
        return (camera.look_from + at.x * right + at.y * up, forward);
    }
    let at = at * (camera.fov_y / 2.0).tan();
    let direction = (forward + at.x * right + at.y * up).normalize();
    (camera.look_from, direction)
}

struct Tracer<'a> {
    scene: &'a Scene,
    carriers: &'a Carriers,
    camera: &'a Camera,
    triangles: Vec<Triangle>,
}

/// In world space.
struct Triangle {
    corners: [DVec3; 3],
    /// Perpendicular to the plane; its length is twice the area.
    cross: DVec3,
    normals: [DVec3; 3],
    uvs: [DVec2; 3],
    materials: [u32; 3],
    instance: usize,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Primitive {
    Triangle(usize),
    Shape(usize),
}

#[derive(Clone, Copy)]
struct Ray {
    origin: DVec3,
    direction: DVec3,
    /// Hits count with t_min < t < t_max.
    t_min: f64,
    t_max: f64,
    /// A flat primitive that the ray leaves and therefore cannot hit.
    leaving: Option<Primitive>,
}

/// A hit.
struct Hit {
    p: DVec3,
    /// Shading normal.
    n: DVec3,
    /// Interpolated, and multiplied by textures.
    material: Material,
    material_index: usize,
    /// Whether the ray hit the side that the normal of the surface points to.
    enters: bool,
}

impl<'a> Tracer<'a> {
    fn new(scene: &'a Scene, carriers: &'a Carriers) -> Self {
        let mut triangles = Vec::new();
        for (index, instance) in scene.instances.iter().enumerate() {
            let mesh = &scene.meshes[instance.mesh];
            let placement = instance.placement;
            let normal_matrix = placement.matrix3.inverse().transpose();
            for indices in &mesh.triangles {
                let indices = indices.map(|i| i as usize);
                let corners =
                    indices.map(|i| placement.transform_point3(mesh.positions[i].as_dvec3()));
                triangles.push(Triangle {
                    corners,
                    cross: (corners[1] - corners[0]).cross(corners[2] - corners[0]),
                    normals: indices
                        .map(|i| (normal_matrix * mesh.normals[i].as_dvec3()).normalize()),
                    uvs: indices.map(|i| mesh.uvs.get(i).copied().unwrap_or_default().as_dvec2()),
                    materials: indices.map(|i| mesh.materials[i]),
                    instance: index,
                });
            }
        }
        Self {
            scene,
            carriers,
            camera: &scene.cameras[scene.camera_index],
            triangles,
        }
    }

    fn radiance(&self, origin: DVec3, direction: DVec3, rays: &mut Log) -> DVec3 {
        rays.counts.primary += 1;
        let ray = Ray {
            origin,
            direction,
            t_min: 0.0,
            t_max: f64::INFINITY,
            leaving: None,
        };
        let first = Place {
            kind: RayKind::Primary,
            sender: None,
            depth: 0,
            throughput: DVec3::ONE,
            media: Vec::new(),
        };
        let (color, is_hit) = self.trace(ray, &first, rays);
        rays.counts.primary_hits += u64::from(is_hit);
        color
    }

    /// The surface at a hit.
    fn hit(&self, ray: Ray, t: f64, primitive: Primitive) -> Hit {
        let p = ray.origin + t * ray.direction;
        let direction = ray.direction;
        let (n, material, uv, material_index, outward) = match primitive {
            Primitive::Shape(i) => {
                let shape = &self.scene.shapes[i];
                let (n, material) = self.shape_surface(shape, p, direction);
                let outward = self.shape_normal(shape, p);
                (n, material, DVec2::ZERO, shape.material, outward)
            }
            Primitive::Triangle(i) => {
                let triangle = &self.triangles[i];
                let weights = weights(triangle, p);
                let [a, b, c] = triangle.uvs;
                let uv = weights.x * a + weights.y * b + weights.z * c;
                let (n, material) = self.triangle_surface(triangle, p, direction);
                let [na, nb, nc] = triangle.normals;
                let given = weights.x * na + weights.y * nb + weights.z * nc;
                let outward = triangle.cross * triangle.cross.dot(given).signum();
                (n, material, uv, triangle.materials[0] as usize, outward)
            }
        };
        Hit {
            p,
            n,
            material: textures::textured(
                self.scene,
                material,
                self.pattern_place(primitive, p),
                uv,
            ),
            material_index,
            enters: outward.dot(direction) <= 0.0,
        }
    }

    /// The lookup position of solid textures for a point of a primitive.
    fn pattern_place(&self, primitive: Primitive, p: DVec3) -> DVec3 {
        match primitive {
            Primitive::Shape(i) => Carriers::pattern_place(&self.carriers.shapes, i, p),
            Primitive::Triangle(i) => {
                let instance = self.triangles[i].instance;
                Carriers::pattern_place(&self.carriers.instances, instance, p)
            }
        }
    }

    /// amb + Σ L (k_d max(l·n, 0) + k_s max(r·v, 0)^α) over the lights visible from `shadow`'s origin, with r =
    /// 2(l·n)n - l.
    fn shade(&self, shadow: Ray, n: DVec3, v: DVec3, material: &Material, rays: &mut Log) -> DVec3 {
        let mut sum = self.scene.ambient.as_dvec3() * material.classical().ambient.as_dvec3();
        for (index, light) in self.scene.lights.iter().enumerate() {
            for (l, distance, arriving) in light_points(light, shadow.origin) {
                let cos = l.dot(n);
                if cos <= 0.0 || arriving == DVec3::ZERO {
                    continue;
                }
                rays.shadow += 1;
                let blocker = self.nearest(Ray {
                    direction: l,
                    t_max: distance,
                    ..shadow
                });
                rays.keep_shadow(index, blocker);
                if blocker.is_some() {
                    rays.shadow_blocked += 1;
                    continue;
                }
                let r = 2.0 * cos * n - l;
                let highlight = r
                    .dot(v)
                    .max(0.0)
                    .powf(material.classical().shininess.into());
                sum += arriving
                    * (material.classical().diffuse.as_dvec3() * cos
                        + material.classical().specular.as_dvec3() * highlight);
            }
        }
        sum
    }

    fn nearest(&self, ray: Ray) -> Option<(f64, Primitive)> {
        let triangles = self.triangles.iter().enumerate();
        let shapes = self.scene.shapes.iter().enumerate();
        let mut best = None;
        let mut t_max = ray.t_max;
        for (i, triangle) in triangles {
            if ray.leaving != Some(Primitive::Triangle(i))
                && let Some(t) = hit_triangle(triangle, Ray { t_max, ..ray })
            {
                t_max = t;
                best = Some((t, Primitive::Triangle(i)));
            }
        }
        for (i, shape) in shapes {
            let is_left = ray.leaving == Some(Primitive::Shape(i));
            let t = match shape.geometry {
                Geometry::Sphere { center, radius } => hit_sphere(center, radius, ray),
                Geometry::Plane { .. } if is_left => None,
                Geometry::Plane { point, normal } => hit_plane(point, normal, ray),
                Geometry::Placed {
                    canonical: CanonicalShape::Disc { .. } | CanonicalShape::Rectangle,
                    ..
                } if is_left => None,
                Geometry::Placed {
                    canonical,
                    world_from_canonical,
                } => hit_placed(canonical, world_from_canonical, ray),
            };
            if let Some(t) = t.filter(|t| *t < t_max) {
                t_max = t;
                best = Some((t, Primitive::Shape(i)));
            }
        }
        best
    }

    fn shape_surface(&self, shape: &Shape, p: DVec3, direction: DVec3) -> (DVec3, Material) {
        let material = self.scene.materials[shape.material].clone();
        let normal = self.shape_normal(shape, p);
        let turned = material.two_sided && normal.dot(direction) > 0.0;
        (if turned { -normal } else { normal }, material)
    }

    fn shape_normal(&self, shape: &Shape, p: DVec3) -> DVec3 {
        match shape.geometry {
            Geometry::Sphere { center, radius } => (p - center) / radius,
            Geometry::Plane { normal, .. } => normal,
            Geometry::Placed {
                canonical,
                world_from_canonical,
            } => shapes::normal(canonical, world_from_canonical, p),
        }
    }

    /// Interpolates normal and coefficients; the first corner decides whether there are two sides.
    fn triangle_surface(
        &self,
        triangle: &Triangle,
        p: DVec3,
        direction: DVec3,
    ) -> (DVec3, Material) {
        let weights = weights(triangle, p);
        let corners = triangle
            .materials
            .map(|i| &self.scene.materials[i as usize]);
        let [a, b, c] = &corners.map(Material::classical);
        let mix = |of: fn(&Phong) -> glam::Vec3| {
            weights.x as f32 * of(a) + weights.y as f32 * of(b) + weights.z as f32 * of(c)
        };
        let shininess = DVec3::new(a.shininess.into(), b.shininess.into(), c.shininess.into());
        let material = Material {
            bsdf: Phong {
                diffuse: mix(|m| m.diffuse),
                specular: mix(|m| m.specular),
                shininess: weights.dot(shininess) as f32,
                ambient: mix(|m| m.ambient),
                reflect: mix(|m| m.reflect),
                ..Phong::clone(a)
            }
            .into(),
            ..corners[0].clone()
        };
        let [na, nb, nc] = triangle.normals;
        let normal = (weights.x * na + weights.y * nb + weights.z * nc).normalize();
        // The side is that of the flat triangle; the shading normal must be on it.
        let facing = triangle.cross * -triangle.cross.dot(direction).signum();
        let turned = material.two_sided && normal.dot(facing) < 0.0;
        (if turned { -normal } else { normal }, material)
    }
}

/// Sample points of a light: direction and distance to each, and its unshadowed light.
fn light_points(light: &Light, p: DVec3) -> Vec<(DVec3, f64, DVec3)> {
    /// Along either of a surface's coordinates.
    const PARTS: u32 = 24;
    let parts = || (0..PARTS).map(|i| (f64::from(i) + 0.5) / f64::from(PARTS));
    // Points that represent equal areas of the surface, with their normals.
    let on_surface = |(u, v): (f64, f64)| {
        let (sin, cos) = (TAU * v).sin_cos();
        match light.kind {
            LightKind::Rectangle {
                center,
                edge_u,
                edge_v,
            } => {
                let q = center + (2.0 * u - 1.0) * edge_u + (2.0 * v - 1.0) * edge_v;
                (q, edge_u.cross(edge_v).normalize())
            }
            LightKind::Disc {
                center,
                normal,
                radius,
            } => {
                let x = normal.any_orthonormal_vector();
                let around = cos * x + sin * normal.cross(x);
                (center + radius * u.sqrt() * around, normal)
            }
            // Archimedes: equal heights of a sphere have equal areas.
            LightKind::Sphere { center, radius } => {
                let y = 2.0 * u - 1.0;
                let r = (1.0 - y * y).sqrt();
                let normal = DVec3::new(r * cos, y, r * sin);
                (center + radius * normal, normal)
            }
            _ => unreachable!("it has no surface"),
        }
    };
    // A Lambertian emitter, from A color cos / (π d²) L to the definition of `color`: for flat lights the mean
    // of color cos / d²; a sphere has four times the area of its disc.
    let factor = match light.kind {
        LightKind::Rectangle { .. } | LightKind::Disc { .. } => 1.0,
        LightKind::Sphere { .. } => 4.0,
        _ => return vec![light_at(light, p)],
    };
    assert_eq!(
        light.attenuation,
        Attenuation::InverseSquare,
        "no scene of the tests has another"
    );
    let weight = factor / f64::from(PARTS * PARTS);
    parts()
        .flat_map(|u| parts().map(move |v| (u, v)))
        .map(on_surface)
        .map(|(q, normal)| {
            let distance = q.distance(p);
            let l = (q - p) / distance;
            let strength = weight * (-l.dot(normal)).max(0.0) / (distance * distance);
            (
                l,
                distance * (1.0 - 1e-9),
                strength * light.color.as_dvec3(),
            )
        })
        .collect()
}

/// Direction to the light, distance to it, and its unshadowed light.
fn light_at(light: &Light, p: DVec3) -> (DVec3, f64, DVec3) {
    let color = light.color.as_dvec3();
    let (position, strength) = match light.kind {
        LightKind::Directional { direction } => return (-direction, f64::INFINITY, color),
        LightKind::Point { position } => (position, 1.0),
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => {
            let cos = (p - position).normalize().dot(direction);
            let x = ((cos - outer.cos()) / (inner.cos() - outer.cos()).max(1e-6)).clamp(0.0, 1.0);
            (position, x * x * (3.0 - 2.0 * x))
        }
        LightKind::Rectangle { .. } | LightKind::Disc { .. } | LightKind::Sphere { .. } => {
            unreachable!("lights of many points")
        }
    };
    let distance = position.distance(p);
    let fall_off = match light.attenuation {
        Attenuation::None => 1.0,
        Attenuation::InverseSquare => distance.powi(-2),
    };
    (
        (position - p) / distance,
        distance,
        color * strength * fall_off,
    )
}

/// t² + 2 b t + c = 0: the smaller valid root.
fn hit_sphere(center: DVec3, radius: f64, ray: Ray) -> Option<f64> {
    let from_center = ray.origin - center;
    let b = from_center.dot(ray.direction);
    let c = from_center.length_squared() - radius * radius;
    let root = (b * b - c).sqrt();
    // Without real roots both are NaN, which is in no range.
    [-b - root, -b + root]
        .into_iter()
        .find(|&t| t > ray.t_min && t < ray.t_max)
}

fn hit_placed(canonical: CanonicalShape, world_from_canonical: DAffine3, ray: Ray) -> Option<f64> {
    shapes::crossings(canonical, world_from_canonical, ray.origin, ray.direction)
        .into_iter()
        .find(|&t| t > ray.t_min && t < ray.t_max)
}

fn hit_plane(point: DVec3, normal: DVec3, ray: Ray) -> Option<f64> {
    let t = (point - ray.origin).dot(normal) / ray.direction.dot(normal);
    (t > ray.t_min && t < ray.t_max).then_some(t)
}

/// The hit of the plane, if it is on the inner side of all edges.
fn hit_triangle(triangle: &Triangle, ray: Ray) -> Option<f64> {
    let t = hit_plane(triangle.corners[0], triangle.cross, ray)?;
    (weights(triangle, ray.origin + t * ray.direction).min_element() >= 0.0).then_some(t)
}

/// Barycentric weights of a point in the plane of the triangle: ratios of areas.
fn weights(triangle: &Triangle, p: DVec3) -> DVec3 {
    let [a, b, c] = triangle.corners;
    let area = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(triangle.cross);
    DVec3::new(area(b, c), area(c, a), area(a, b)) / triangle.cross.length_squared()
}
