//! Many lamps, which paths choose from a tree: their chances are those of a reference in f64, and their light is that of
//! the classical integrator, which adds up all lamps.

use super::light_chances::{chances, mean_from, wide};
use super::{lit_floor, matte, mean, near, paths};
use crate::explain::{finish, random_pixels, renderer};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use bytemuck::cast_slice;
use glam::{DVec3, Vec3, dvec3};
use glimray::layout::{
    LIGHT_DISC, LIGHT_INDEX_MASK, LIGHT_LEAF, LIGHT_RECTANGLE, LIGHT_SPOT, PackedCluster,
    PackedLight,
};
use glimray::pack;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{Attenuation, Geometry, Light, LightKind, Material, Phong, Scene, Shape};

/// A floor under this many lamps of a kind for each number.
pub fn floor_under(
    material: Material,
    count: usize,
    kind: impl Fn(usize, DVec3) -> LightKind,
) -> Scene {
    let mut scene = lit_floor(material, Light::default());
    let mut random = Random::new(21);
    scene.lights = (0..count)
        .map(|index| {
            let at = random.in_cube();
            Light {
                kind: kind(index, dvec3(2.5 * at.x, 1.0 + 0.4 * at.y, 2.5 * at.z)),
                color: Vec3::splat(random.between(0.01, 0.1) as f32),
                attenuation: match index % 11 {
                    10 => Attenuation::None,
                    _ => Attenuation::InverseSquare,
                },
                samples: 4,
                visible: false,
                node: None,
                name: String::new(),
            }
        })
        .collect();
    scene
}

/// Lamps of every kind, some of which point away from the floor.
pub fn any_kind(index: usize, position: DVec3) -> LightKind {
    let mut random = Random::new(index as u64);
    let direction = random.direction();
    let (edge_u, edge_v) = direction.any_orthonormal_pair();
    match index % 6 {
        0 => LightKind::Point { position },
        1 => LightKind::Spot {
            position,
            direction,
            inner: 0.5,
            outer: if index % 12 == 1 { 0.5 } else { 1.2 },
        },
        2 => LightKind::Rectangle {
            center: position,
            edge_u: 0.2 * edge_u,
            edge_v: 0.1 * edge_v,
        },
        3 => LightKind::Disc {
            center: position,
            normal: direction,
            radius: 0.1,
        },
        4 => LightKind::Sphere {
            center: position,
            radius: 0.1,
        },
        _ => LightKind::Directional {
            direction: dvec3(direction.x, -1.0, direction.z).normalize(),
        },
    }
}

/// Whether some light of a lamp that fades arrives at p, which is not inside of it.
pub fn reaches(light: &PackedLight, p: DVec3, n: DVec3) -> bool {
    let to_light = (wide(light.position) - p).normalize();
    let cos = -to_light.dot(wide(light.direction));
    let is_ahead = match light.kind {
        LIGHT_SPOT => cos > f64::from(light.cos_outer) + 1e-3,
        LIGHT_RECTANGLE | LIGHT_DISC => cos > 0.01,
        _ => true,
    };
    is_ahead && to_light.dot(n) > 0.01
}

/// The most steps from the root to a leaf.
fn steps_below(clusters: &[PackedCluster], reference: u32) -> u32 {
    if reference & LIGHT_LEAF != 0 {
        return 0;
    }
    let children = &clusters[(reference & LIGHT_INDEX_MASK) as usize..][..4];
    let below = children.iter().filter(|child| child.child != 0);
    1 + (below.map(|child| steps_below(clusters, child.child)))
        .max()
        .expect("a child")
}

/// Each step takes two of 32 bits of a trail. Along each axis lamps are twice as far away as the one before, and 256 are in the
/// place of the first.
#[test]
fn a_light_tree_is_no_deeper_than_its_trails_are_long() {
    let scene = floor_under(matte(0.5), 255 + 216, |index, _| {
        let step = index.saturating_sub(255);
        let axis = [DVec3::X, DVec3::Y, DVec3::Z][step % 3];
        LightKind::Point {
            position: axis * 2f64.powi((step / 3) as i32 - 23),
        }
    });
    let packed = pack::scene(&scene).expect("a scene that can be packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    let clusters: &[PackedCluster] = cast_slice(view.node_parts()[7]);
    let steps = steps_below(clusters, view.frame.light_root);
    assert!((10..=16).contains(&steps), "{steps} steps");
    let all = chances(&view, DVec3::X, DVec3::Y);
    for (light, &(_, trail)) in view.lights.iter().zip(&all.lamps) {
        assert_eq!(light.place, trail);
    }
}

#[test]
fn chances_of_a_light_tree_are_those_of_a_reference_and_no_lamp_that_is_seen_has_none() {
    let mut verdict = Verdict::on("a tree over 300 lamps");
    let scene = floor_under(matte(0.5), 300, any_kind);
    let packed = pack::scene(&scene).expect("a scene that can be packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    verdict.that("tree", view.has_light_tree(), || "none");
    let mut random = Random::new(4);
    for _ in 0..200 {
        let p = 3.0 * random.in_cube();
        let n = random.direction();
        let all = chances(&view, p, n);
        let sum: f64 = all.lamps.iter().map(|(chance, _)| chance).sum();
        let what = format!("sum at {p}");
        near(&mut verdict, what, sum + all.missed, 1.0, 1e-9);
        for (light, &(chance, trail)) in view.lights.iter().zip(&all.lamps) {
            verdict.that("trail", light.place == trail, || {
                format!("{light:?}, {trail}")
            });
            let is_seen = reaches(light, p, n);
            verdict.that("chance", chance > 0.0 || !is_seen, || {
                format!("{light:?} at {p}, {n}")
            });
        }
    }
    // The samples of the shader, on the floor.
    let settings = paths(16, (12, 8), 0);
    let mut renderer = renderer(&scene, &settings);
    finish(&mut renderer);
    let wanted: Vec<_> = (random_pixels(settings.size, 60, 3).into_iter())
        .map(|place| (place, 0..16))
        .collect();
    let trees = renderer.explain_pixels(&wanted).expect("paths");
    let (mut samples, mut misses, mut missed) = (0, 0.0, 0.0);
    for sample in trees.iter().flat_map(|tree| &tree.samples) {
        for ray in &sample.rays {
            let Some(shadow) = &ray.shadow else {
                continue;
            };
            let light = shadow.light.expect("a lamp");
            let found = f64::from(shadow.sample.as_ref().expect("a light sample").chance);
            let p = DVec3::from(ray.origin) - packed.origin;
            let all = chances(&view, p, DVec3::Y);
            let expected = if found > 0.0 { all.lamps[light].0 } else { 0.0 };
            let what = format!("lamp {light} at {p}");
            near(&mut verdict, what, found, expected, 0.02 * expected);
            samples += 1;
            misses += f64::from(u8::from(found == 0.0));
            missed += all.missed;
        }
    }
    verdict.that("count", samples > 500, || samples);
    let spread = 4.0 * f64::sqrt(missed) + 2.0;
    near(&mut verdict, "samples of no lamp", misses, missed, spread);
    verdict.close();
}

#[test]
fn many_lamps_light_a_floor_as_all_of_them_do_one_by_one() {
    let mut verdict = Verdict::on("floors under lamps");
    for count in [3, 30, 300] {
        let scene = floor_under(matte(0.6), count, any_kind);
        let classical = RenderSettings {
            integrator: Integrator::Whitted,
            ..paths(64, (24, 16), 0)
        };
        let expected = mean(&scene, &classical);
        let found = mean(&scene, &paths(2048, (24, 16), 0));
        near(
            &mut verdict,
            format!("{count} lamps"),
            found,
            expected,
            0.005 * expected,
        );
    }
    verdict.close();
}

/// Lamps that paths can hit shine like emissive balls without a tree: both ways to find them know their chances.
#[test]
fn many_lamps_that_paths_can_hit_shine_like_balls_of_the_same_radiance() {
    let glossy = Material {
        bsdf: Phong {
            specular: Vec3::splat(6.0),
            shininess: 40.0,
            ..matte(0.2).classical().into_owned()
        }
        .into(),
        ..matte(0.2)
    };
    let radius = 0.08;
    let mut lamps = floor_under(glossy, 100, |_, center| LightKind::Sphere {
        center,
        radius,
    });
    for light in &mut lamps.lights {
        light.visible = true;
        light.attenuation = Attenuation::InverseSquare;
    }
    let mut balls = lamps.clone();
    balls.lights.clear();
    for light in &lamps.lights {
        let LightKind::Sphere { center, radius } = light.kind else {
            continue;
        };
        let radiance = light.kind.radiance().expect("an area light") as f32;
        let material = balls.materials.len();
        balls.materials.push(Material {
            emission: light.color * radiance,
            two_sided: false,
            ..matte(0.0)
        });
        balls.shapes.push(Shape {
            geometry: Geometry::Sphere { center, radius },
            material,
            node: None,
            name: String::new(),
        });
    }
    let settings = paths(1024, (24, 16), 0);
    let expected = mean_from(&balls, &settings, usize::MAX);
    let found = mean(&lamps, &settings);
    assert!(
        (found / expected - 1.0).abs() < 0.01,
        "{found}, expected {expected}"
    );
}
