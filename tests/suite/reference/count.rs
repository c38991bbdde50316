//! Counts and shades the rays of the classical ray tree with an independent tracer: f64, textbook formulas, a
//! median-split BVH for speed. It supports the contents of NFF scenes (spheres, cones, triangles, point lights,
//! no ambient light, [`Mixing::Sum`] without Fresnel) and rejects everything else.

use glam::{DAffine3, DVec2, DVec3};
use glimray::image::Image;
use glimray::scene::{
    Attenuation, Background, CanonicalShape, Geometry, Light, LightKind, Material, Phong,
};
use glimray::scene::{Fresnel, Mixing, Scene};
use std::ops::AddAssign;

/// A ray is traced only if its throughput reaches this in some channel.
const MIN_THROUGHPUT: f64 = 1.0 / 512.0;

/// Relative to the coordinates of a point: secondary rays ignore closer hits. NFF files have six digits, so
/// spheres that should touch overlap or have gaps of that size, and hits there are rounding noise. POV-Ray
/// ignores such hits too: without this, its number of reflected rays in `balls` is exceeded by one percent.
const NEAREST: f64 = 1e-6;

/// Number of rays of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rays {
    pub primary: u64,
    pub primary_hits: u64,
    pub shadow: u64,
    pub shadow_blocked: u64,
    pub reflection: u64,
    pub reflection_hits: u64,
    pub refraction: u64,
    pub refraction_hits: u64,
}

impl AddAssign for Rays {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.primary_hits += other.primary_hits;
        self.shadow += other.shadow;
        self.shadow_blocked += other.shadow_blocked;
        self.reflection += other.reflection;
        self.reflection_hits += other.reflection_hits;
        self.refraction += other.refraction;
        self.refraction_hits += other.refraction_hits;
    }
}

/// The handling of a ray that an interpolated normal would reflect into the surface.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Inwards {
    /// The ray is traced into the surface, as in POV-Ray.
    Sent,
    /// The geometric normal is used instead, for the reflected and the refracted ray, as in the renderer.
    Turned,
}

/// Counts the rays of a picture of `scene` through its default camera: one primary ray through the centre of
/// each pixel, and `max_depth` bounces.
pub fn count(scene: &Scene, size: (u32, u32), max_depth: u32) -> Rays {
    trace(scene, size, max_depth, Inwards::Sent).1
}

/// Also returns the picture: linear radiance, not clamped.
pub fn trace(
    scene: &Scene,
    (width, height): (u32, u32),
    max_depth: u32,
    inwards: Inwards,
) -> (Image, Rays) {
    let tree = Tree::new(scene, inwards);
    let camera = &scene.cameras[scene.camera_index];
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let slope = (camera.fov_y / 2.0).tan();
    let row = |y: u32| {
        let mut rays = Rays::default();
        let pixels: Vec<DVec3> = (0..width)
            .map(|x| {
                let at = DVec2::new(f64::from(2 * x + 1), f64::from(2 * y + 1));
                let at = (at - DVec2::new(width.into(), height.into())) / f64::from(height);
                rays.primary += 1;
                let direction = (forward + slope * (at.x * right - at.y * up)).normalize();
                let ray = Ray {
                    origin: camera.look_from,
                    direction,
                    t_min: 0.0,
                    leaving: usize::MAX,
                };
                let (color, is_hit) = tree.radiance(&ray, DVec3::ONE, max_depth, &mut rays);
                rays.primary_hits += u64::from(is_hit);
                color
            })
            .collect();
        (pixels, rays)
    };
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
        let pixels = pixels.iter().map(|c| c.as_vec3().extend(1.0).to_array());
        image.pixels.extend(pixels);
        rays += row;
    }
    (image, rays)
}

struct Ray {
    origin: DVec3,
    direction: DVec3,
    /// Hits count beyond this distance.
    t_min: f64,
    /// A triangle that the ray leaves and therefore cannot hit.
    leaving: usize,
}

struct Primitive {
    surface: Surface,
    material: usize,
    min: DVec3,
    max: DVec3,
}

enum Surface {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    /// x² + z² = (bottom + slope y)², 0 ≤ y ≤ 1 in its own space.
    Cone {
        bottom: f64,
        slope: f64,
        canonical_from_world: DAffine3,
    },
    Triangle {
        corners: [DVec3; 3],
        /// A normal whose length is twice the area.
        cross: DVec3,
        normals: [DVec3; 3],
    },
}

/// A box with either two children or primitives.
struct Node {
    min: DVec3,
    max: DVec3,
    children: Option<(usize, usize)>,
    primitives: std::ops::Range<usize>,
}

struct Tree<'a> {
    scene: &'a Scene,
    inwards: Inwards,
    background: DVec3,
    primitives: Vec<Primitive>,
    /// The root is the last.
    nodes: Vec<Node>,
}

impl<'a> Tree<'a> {
    fn new(scene: &'a Scene, inwards: Inwards) -> Self {
        let Background::Color(background) = scene.background else {
            panic!("only backgrounds of one colour are known here");
        };
        assert_eq!(scene.ambient, glam::Vec3::ZERO, "ambient light");
        let is_known = |m: &Material| {
            m.classical().mixing == Mixing::Sum && m.classical().fresnel == Fresnel::None
        };
        assert!(scene.materials.iter().all(is_known), "materials of NFF");
        let mut primitives = primitives(scene);
        let mut nodes = Vec::new();
        let all = 0..primitives.len();
        build(&mut primitives, all, &mut nodes);
        Self {
            scene,
            inwards,
            background: background.as_dvec3(),
            primitives,
            nodes,
        }
    }

    /// The radiance along `ray`, whose weight in the pixel is `throughput`, and whether it hits anything.
    fn radiance(
        &self,
        ray: &Ray,
        throughput: DVec3,
        bounces: u32,
        rays: &mut Rays,
    ) -> (DVec3, bool) {
        let Some((t, index)) = self.hit(ray, f64::INFINITY, false) else {
            return (self.background, false);
        };
        let primitive = &self.primitives[index];
        let material = &self.scene.materials[primitive.material];
        let p = ray.origin + t * ray.direction;
        let (outwards, shading) = primitive.surface.normals(p);
        let enters = outwards.dot(ray.direction) < 0.0;
        // On the side of the ray.
        let side = if enters { outwards } else { -outwards };
        let n = if shading.dot(side) < 0.0 {
            -shading
        } else {
            shading
        };
        let leaving = match primitive.surface {
            Surface::Triangle { .. } => index,
            _ => usize::MAX,
        };
        let leave = |direction| Ray {
            origin: p,
            direction,
            t_min: NEAREST * (1.0 + p.abs().max_element()),
            leaving,
        };
        let mut color = DVec3::ZERO;
        for light in &self.scene.lights {
            let (l, distance) = towards(light, p);
            let cos = l.dot(n);
            if cos <= 0.0 {
                continue;
            }
            rays.shadow += 1;
            if self.hit(&leave(l), distance, true).is_some() {
                rays.shadow_blocked += 1;
                continue;
            }
            let r = 2.0 * cos * n - l;
            let highlight = r
                .dot(-ray.direction)
                .max(0.0)
                .powf(material.classical().shininess.into());
            let answer = material.classical().diffuse.as_dvec3() * cos
                + material.classical().specular.as_dvec3() * highlight;
            color += light.color.as_dvec3() * answer;
        }
        if bounces == 0 {
            return (color, true);
        }
        let goes_on = |weight: DVec3| {
            weight.max_element() > 0.0 && (throughput * weight).max_element() >= MIN_THROUGHPUT
        };
        let mirrored = |n: DVec3| ray.direction - 2.0 * ray.direction.dot(n) * n;
        let is_turned = self.inwards == Inwards::Turned && mirrored(n).dot(side) <= 0.0;
        let n = if is_turned { side } else { n };
        let mirror = material.classical().reflect.as_dvec3();
        if goes_on(mirror) {
            let direction = mirrored(n);
            rays.reflection += 1;
            let (seen, is_hit) =
                self.radiance(&leave(direction), throughput * mirror, bounces - 1, rays);
            rays.reflection_hits += u64::from(is_hit);
            color += mirror * seen;
        }
        let glass = material.classical().transmit.as_dvec3();
        let ior = f64::from(material.classical().ior);
        let eta = if enters { 1.0 / ior } else { ior };
        if goes_on(glass)
            && let Some(direction) = refracted(ray.direction, n, eta)
        {
            rays.refraction += 1;
            let (seen, is_hit) =
                self.radiance(&leave(direction), throughput * glass, bounces - 1, rays);
            rays.refraction_hits += u64::from(is_hit);
            color += glass * seen;
        }
        (color, true)
    }

    /// The nearest hit before `t_max`, or any hit.
    fn hit(&self, ray: &Ray, mut t_max: f64, any: bool) -> Option<(f64, usize)> {
        let mut best = None;
        let mut stack = vec![self.nodes.len().checked_sub(1)?];
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index];
            if !node.is_met(ray, t_max) {
                continue;
            }
            if let Some((a, b)) = node.children {
                stack.extend([a, b]);
                continue;
            }
            for i in node.primitives.clone() {
                if i != ray.leaving
                    && let Some(t) = self.primitives[i].surface.hit(ray, t_max)
                {
                    t_max = t;
                    best = Some((t, i));
                    if any {
                        return best;
                    }
                }
            }
        }
        best
    }
}

/// Snell's law; `None` beyond the critical angle.
fn refracted(direction: DVec3, n: DVec3, eta: f64) -> Option<DVec3> {
    let cos = -direction.dot(n);
    let square = 1.0 - eta * eta * (1.0 - cos * cos);
    (square >= 0.0).then(|| (eta * direction + (eta * cos - square.sqrt()) * n).normalize())
}

/// Direction and distance.
fn towards(light: &Light, p: DVec3) -> (DVec3, f64) {
    let (LightKind::Point { position }, Attenuation::None) = (light.kind, light.attenuation) else {
        panic!("only point lights that do not fade are known here");
    };
    let distance = position.distance(p);
    ((position - p) / distance, distance)
}

impl Surface {
    /// The first hit with t_min < t < `t_max`.
    fn hit(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let is_between = |t: &f64| *t > ray.t_min && *t < t_max;
        match *self {
            Self::Sphere { center, radius } => {
                let from = ray.origin - center;
                let b = from.dot(ray.direction);
                let root = (b * b - from.length_squared() + radius * radius).sqrt();
                [-b - root, -b + root].into_iter().find(is_between)
            }
            Self::Cone {
                bottom,
                slope,
                canonical_from_world,
            } => {
                let o = canonical_from_world.transform_point3(ray.origin);
                let d = canonical_from_world.transform_vector3(ray.direction);
                let radius = bottom + slope * o.y;
                let a = d.x * d.x + d.z * d.z - slope * slope * d.y * d.y;
                let b = o.x * d.x + o.z * d.z - slope * radius * d.y;
                let c = o.x * o.x + o.z * o.z - radius * radius;
                let root = (b * b - a * c).sqrt();
                // Along a line of the cone's own slope there is one root.
                let mut roots = match a.abs() < 1e-14 * d.length_squared() {
                    true => [-c / (2.0 * b); 2],
                    false => [(-b - root) / a, (-b + root) / a],
                };
                roots.sort_by(f64::total_cmp);
                let is_on = |t: &f64| (0.0..=1.0).contains(&(o.y + t * d.y));
                roots.into_iter().find(|t| is_between(t) && is_on(t))
            }
            Self::Triangle { corners, cross, .. } => {
                let t = (corners[0] - ray.origin).dot(cross) / ray.direction.dot(cross);
                let p = ray.origin + t * ray.direction;
                (is_between(&t) && weights(corners, cross, p).min_element() >= 0.0).then_some(t)
            }
        }
    }

    /// The geometric and the shading normal, both of unit length.
    fn normals(&self, p: DVec3) -> (DVec3, DVec3) {
        match *self {
            Self::Sphere { center, radius } => {
                let n = (p - center) / radius;
                (n, n)
            }
            Self::Cone {
                bottom,
                slope,
                canonical_from_world,
            } => {
                let q = canonical_from_world.transform_point3(p);
                let gradient = DVec3::new(q.x, -slope * (bottom + slope * q.y), q.z);
                let n = (canonical_from_world.matrix3.transpose() * gradient).normalize();
                (n, n)
            }
            Self::Triangle {
                corners,
                cross,
                normals: [a, b, c],
            } => {
                let weights = weights(corners, cross, p);
                let n = weights.x * a + weights.y * b + weights.z * c;
                (cross.normalize(), n.normalize())
            }
        }
    }
}

/// Barycentric weights of a point in the plane of the triangle.
fn weights([a, b, c]: [DVec3; 3], cross: DVec3, p: DVec3) -> DVec3 {
    let area = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(cross);
    DVec3::new(area(b, c), area(c, a), area(a, b)) / cross.length_squared()
}

fn primitives(scene: &Scene) -> Vec<Primitive> {
    let mut primitives = Vec::new();
    for shape in &scene.shapes {
        let surface = match shape.geometry {
            Geometry::Sphere { center, radius } => Surface::Sphere { center, radius },
            Geometry::Placed {
                canonical:
                    CanonicalShape::Cone {
                        bottom,
                        top,
                        capped: false,
                    },
                world_from_canonical,
            } => Surface::Cone {
                bottom,
                slope: top - bottom,
                canonical_from_world: world_from_canonical.inverse(),
            },
            _ => panic!("only spheres and open cones are known here"),
        };
        let (min, max) = shape.geometry.bounds().expect("bounds");
        primitives.push(Primitive {
            surface,
            material: shape.material,
            min,
            max,
        });
    }
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        let placement = instance.placement;
        let normal_matrix = placement.matrix3.inverse().transpose();
        for indices in &mesh.triangles {
            let indices = indices.map(|i| i as usize);
            let corners = indices.map(|i| placement.transform_point3(mesh.positions[i].as_dvec3()));
            let [a, b, c] = corners;
            let normals = indices.map(|i| normal_matrix * mesh.normals[i].as_dvec3());
            primitives.push(Primitive {
                surface: Surface::Triangle {
                    corners,
                    cross: (b - a).cross(c - a),
                    normals: normals.map(DVec3::normalize),
                },
                material: mesh.materials[indices[0]] as usize,
                min: a.min(b).min(c),
                max: a.max(b).max(c),
            });
        }
    }
    primitives
}

/// Builds the BVH over a part of the primitives, which it sorts, and returns its root.
fn build(
    primitives: &mut [Primitive],
    part: std::ops::Range<usize>,
    nodes: &mut Vec<Node>,
) -> usize {
    let members = &mut primitives[part.clone()];
    let union = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
    let boxes = members.iter().map(|p| (p.min, p.max));
    let (min, max) = boxes.reduce(union).unwrap_or_default();
    let mut children = None;
    if members.len() > 4 {
        let size = max - min;
        let axis = (0..3)
            .max_by(|&a, &b| size[a].total_cmp(&size[b]))
            .unwrap_or(0);
        let center = |p: &Primitive| p.min[axis] + p.max[axis];
        let half = members.len() / 2;
        members.select_nth_unstable_by(half, |a, b| center(a).total_cmp(&center(b)));
        let middle = part.start + half;
        let first = build(primitives, part.start..middle, nodes);
        let second = build(primitives, middle..part.end, nodes);
        children = Some((first, second));
    }
    // Enlarged for the rounding of the box test.
    let slack = DVec3::splat(1e-9 * (1.0 + min.abs().max(max.abs()).max_element()));
    nodes.push(Node {
        min: min - slack,
        max: max + slack,
        children,
        primitives: part,
    });
    nodes.len() - 1
}

impl Node {
    /// Whether the ray intersects the box before `t_max` (Kay and Kajiya 1986).
    fn is_met(&self, ray: &Ray, t_max: f64) -> bool {
        let (a, b) = (
            (self.min - ray.origin) / ray.direction,
            (self.max - ray.origin) / ray.direction,
        );
        let (mut enter, mut exit) = (0.0, t_max);
        for axis in 0..3 {
            // min and max ignore NaN, which occurs for a ray within a side.
            enter = f64::max(enter, a[axis].min(b[axis]));
            exit = f64::min(exit, a[axis].max(b[axis]));
        }
        enter <= exit
    }
}

/// A camera at `eye` that looks along -z, and a sphere around the origin of a material with these reflection
/// and transmission factors.
fn ball(eye: DVec3, reflect: f32, transmit: f32, ior: f32) -> Scene {
    let material = Material::from(Phong {
        reflect: glam::Vec3::splat(reflect),
        transmit: glam::Vec3::splat(transmit),
        ior,
        mixing: Mixing::Sum,
        ..Phong::default()
    });
    Scene {
        shapes: vec![glimray::scene::Shape {
            geometry: Geometry::Sphere {
                center: DVec3::ZERO,
                radius: 1.0,
            },
            material: 0,
            node: None,
            name: String::new(),
        }],
        materials: vec![material],
        cameras: vec![glimray::scene::Camera {
            look_from: eye,
            look_at: eye + DVec3::NEG_Z,
            ..Default::default()
        }],
        ..Scene::default()
    }
}

#[test]
fn the_counter_loses_no_ray_in_a_mirror_ball() {
    let mut scene = ball(DVec3::new(0.3, 0.2, 0.1), 1.0, 0.0, 1.0);
    scene.lights = vec![Light::default()];
    let rays = count(&scene, (16, 16), 5);
    assert_eq!((rays.primary, rays.primary_hits), (256, 256));
    assert_eq!((rays.reflection, rays.reflection_hits), (5 * 256, 5 * 256));
    assert_eq!((rays.shadow, rays.shadow_blocked), (6 * 256, 0));
    assert_eq!((rays.refraction, rays.refraction_hits), (0, 0));
    // 1/10 and 1/100 are traced, 1/1000 is below 1/512.
    scene.materials[0].classical_mut().reflect = glam::Vec3::splat(0.1);
    assert_eq!(count(&scene, (16, 16), 5).reflection, 2 * 256);
}

#[test]
fn the_counter_follows_light_through_a_ball_that_does_not_bend_it() {
    let scene = ball(DVec3::new(0.0, 0.0, 3.0), 0.0, 1.0, 1.0);
    let rays = count(&scene, (32, 32), 5);
    assert!(rays.primary_hits > 100 && rays.primary_hits < 1024);
    assert_eq!(rays.refraction, 2 * rays.primary_hits);
    assert_eq!(rays.refraction_hits, rays.primary_hits);
}

/// From inside at distance d from the centre, along a direction at the angle θ to the outward radius, the ray
/// hits the wall of the ball under sin φ = d sin θ.
#[test]
fn the_counter_sends_nothing_beyond_the_critical_angle() {
    let eye = DVec3::new(0.9, 0.0, 0.0);
    let rays = count(&ball(eye, 0.0, 1.0, 1.25), (64, 64), 5);
    let leaves = |(x, y): (u32, u32)| {
        let at = |i: u32| (f64::from(2 * i + 1) / 64.0 - 1.0) * 30_f64.to_radians().tan();
        let sine = DVec3::new(at(x), -at(y), -1.0)
            .normalize()
            .cross(eye)
            .length();
        sine < 1.0 / 1.25
    };
    let pixels = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
    let expected = pixels.filter(|p| leaves(*p)).count() as u64;
    assert!(expected > 100 && expected < 4000, "{expected}");
    assert_eq!((rays.refraction, rays.refraction_hits), (expected, 0));
}

/// A frustum from y = -1 with radius 2 to y = 1 with radius 1, against the analytic area of its ring in a view
/// from above through its open ends.
#[test]
fn the_counter_sees_open_cones_from_both_sides() {
    let mut scene = ball(DVec3::new(0.0, 1e6, 0.0), 0.0, 0.0, 1.0);
    scene.cameras[0].look_at = DVec3::ZERO;
    scene.cameras[0].up = DVec3::X;
    scene.cameras[0].fov_y = 2.0 * 2.5e-6_f64.atan();
    for (bottom, top) in [(2.0, 1.0), (1.0, 2.0)] {
        scene.shapes[0].geometry = Geometry::Placed {
            canonical: CanonicalShape::Cone {
                bottom,
                top,
                capped: false,
            },
            world_from_canonical: DAffine3::from_scale_rotation_translation(
                DVec3::new(1.0, 2.0, 1.0),
                glam::DQuat::from_rotation_y(1.0),
                DVec3::NEG_Y,
            ),
        };
        let rays = count(&scene, (500, 500), 0);
        let area = rays.primary_hits as f64 * 1e-4;
        assert!((area - 3.0 * std::f64::consts::PI).abs() < 0.02, "{area}");
    }
}
