//! Ray sets: the rays of different purposes in a scene. They are the same on every machine, so that figures of
//! different adapters, programs and versions can be compared.

use super::random::Random;
use super::walk::{Found, Walker};
use glam::{DVec3, dvec3};
use glimray_render::{Coherence, QueryRay, RayTest};
use glimray_scene::{LightKind, Scene};

/// Side of a square of neighbouring pixels, whose rays follow each other in Morton order.
const TILE: u32 = 8;
/// Distance from the surface at which rays start, as a fraction of the radius of the scene.
const OFFSET: f64 = 1e-5;
/// Length of ambient-occlusion rays, as a fraction of the radius of the scene.
const OCCLUSION_LENGTH: f64 = 0.1;

/// Rays of one purpose.
#[derive(Clone, Debug)]
pub struct RaySet {
    /// `primary`, `shadow`, `ambient-occlusion`, `diffuse`, `mirror` or `random`.
    pub name: &'static str,
    /// The question that they answer.
    pub test: RayTest,
    /// Incoherent if its rays are faster alone, by measurement (benches/log/2026-11.md).
    pub coherence: Coherence,
    /// The rays, in order.
    pub rays: Vec<QueryRay>,
}

impl RaySet {
    /// A checksum of all rays (FNV-1a over their components as f32).
    pub fn checksum(&self) -> u64 {
        fnv(self.rows().flatten().flat_map(f32::to_le_bytes))
    }

    /// Origin, direction and `t_max` of each ray.
    pub fn rows(&self) -> impl Iterator<Item = [f32; 7]> {
        self.rays.iter().map(|ray| {
            let [ox, oy, oz] = ray.origin.as_vec3().to_array();
            let [dx, dy, dz] = ray.direction.to_array();
            [ox, oy, oz, dx, dy, dz, ray.t_max]
        })
    }
}

/// A checksum of bytes (FNV-1a by Fowler, Noll and Vo).
pub fn fnv(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |sum, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The ray sets of a scene of meshes and spheres, for a picture of `side` × `side` pixels; `side` is a multiple
/// of 8. One ray for each pixel is primary, and as many are random; for each pixel with a hit there is one ray of
/// each other set. Shadow rays go to the first light.
pub fn of(scene: &Scene, side: u32) -> Vec<RaySet> {
    let primary = primary(scene, side);
    let rays: Vec<_> = (primary.iter())
        .map(|ray| (ray.origin, ray.direction.as_dvec3()))
        .collect();
    let hits = Walker::new(scene).closest_hits(&rays);
    let bounds = scene.bounds().unwrap_or_default();
    let radius = 0.5 * (bounds.1 - bounds.0).length();
    let points: Vec<_> = (rays.iter().zip(&hits).zip(0..))
        .filter_map(|((&(origin, direction), hit), index)| {
            let Found { t, normal } = (*hit)?;
            Some(Point {
                place: origin + t * direction + OFFSET * radius * normal,
                normal,
                incoming: direction,
                index,
            })
        })
        .collect();
    let from_points = |name, test, coherence, ray: &dyn Fn(&Point) -> QueryRay| RaySet {
        name,
        test,
        coherence,
        rays: points.iter().map(ray).collect(),
    };
    let light = scene.lights.first().map(|light| light.kind);
    let occlusion_length = (OCCLUSION_LENGTH * radius) as f32;
    vec![
        RaySet {
            name: "primary",
            test: RayTest::Closest,
            coherence: Coherence::Coherent,
            rays: primary,
        },
        from_points("shadow", RayTest::Any, Coherence::Coherent, &|point| {
            shadow(point, light)
        }),
        from_points(
            "ambient-occlusion",
            RayTest::Any,
            Coherence::Coherent,
            &|point| QueryRay {
                t_max: occlusion_length,
                ..point.ray(point.random(1).cosine(point.normal))
            },
        ),
        from_points(
            "diffuse",
            RayTest::Closest,
            Coherence::Incoherent,
            &|point| point.ray(point.random(2).cosine(point.normal)),
        ),
        from_points("mirror", RayTest::Closest, Coherence::Coherent, &|point| {
            let along = point.incoming.dot(point.normal);
            point.ray(point.incoming - 2.0 * along * point.normal)
        }),
        RaySet {
            name: "random",
            test: RayTest::Closest,
            coherence: Coherence::Incoherent,
            rays: (0..u64::from(side * side))
                .map(|index| {
                    let mut random = Random::of(3, index);
                    let origin = random.point(bounds.0, bounds.1);
                    QueryRay::new(origin, random.direction().as_vec3())
                })
                .collect(),
        },
    ]
}

/// A point in front of a surface.
struct Point {
    place: DVec3,
    normal: DVec3,
    /// Direction of the primary ray.
    incoming: DVec3,
    /// Index of the primary ray.
    index: u64,
}

impl Point {
    fn ray(&self, direction: DVec3) -> QueryRay {
        QueryRay::new(self.place, direction.as_vec3())
    }

    fn random(&self, series: u64) -> Random {
        Random::of(series, self.index)
    }
}

fn shadow(point: &Point, light: Option<LightKind>) -> QueryRay {
    match light.unwrap_or(LightKind::Point {
        position: DVec3::ZERO,
    }) {
        LightKind::Directional { direction } => point.ray(-direction),
        LightKind::Point { position }
        | LightKind::Spot { position, .. }
        | LightKind::Rectangle {
            center: position, ..
        }
        | LightKind::Disc {
            center: position, ..
        }
        | LightKind::Sphere {
            center: position, ..
        } => {
            let way = position - point.place;
            QueryRay {
                t_max: way.length() as f32,
                ..point.ray(way.normalize())
            }
        }
    }
}

/// The rays through the pixels' centres, from the default camera with its default field of view of 60°.
fn primary(scene: &Scene, side: u32) -> Vec<QueryRay> {
    let camera = &scene.cameras[scene.camera_index];
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    // tan 30°.
    let half = (1.0_f64 / 3.0).sqrt();
    let on_screen = |pixel: u32| half * (2.0 * (f64::from(pixel) + 0.5) / f64::from(side) - 1.0);
    let ray = |x: u32, y: u32| {
        let way = dvec3(on_screen(x), -on_screen(y), 1.0);
        let direction = way.x * right + way.y * up + way.z * forward;
        QueryRay::new(camera.look_from, direction.normalize().as_vec3())
    };
    let tiles = side / TILE;
    let pixels = (0..tiles * tiles).flat_map(|tile| {
        let corner = [tile % tiles * TILE, tile / tiles * TILE];
        (0..TILE * TILE).map(move |lane| {
            let bit = |shift: u32, to: u32| ((lane >> shift) & 1) << to;
            let x = bit(0, 0) | bit(2, 1) | bit(4, 2);
            let y = bit(1, 0) | bit(3, 1) | bit(5, 2);
            [corner[0] + x, corner[1] + y]
        })
    });
    pixels.map(|[x, y]| ray(x, y)).collect()
}
