//! `glimray bench`: its scenes and ray sets are the same everywhere, and its exact counters do not grow.

mod comparing;
mod exporting;
mod packets;

use crate::reference::compare::open_gpu;
use crate::support::verdict::Verdict;
use glimray::pack;
use glimray::render::{ExecutionPolicy, RayBatch, RayQuery, RaySteps, RayTest};
use glimray_cli::bench::ray_sets::{self, RaySet};
use glimray_cli::bench::scenes::{self, ALL, Detail};
use std::sync::Arc;

/// Side of the picture of the small ray sets.
const SIDE: u32 = 64;
/// Growth of a counter that is a regression.
const GROWTH: f64 = 1.05;

#[test]
fn scenes_have_the_documented_sizes() {
    let count = |name: &str| {
        let scene = ALL.iter().find(|scene| scene.name == name).expect(name);
        let scene = (scene.scene)(Detail::Full);
        let triangles: usize = scene.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        (triangles, scene.shapes.len(), scene.instances.len())
    };
    assert_eq!(count("heightfield"), (180_000, 0, 1));
    assert_eq!(count("sphereflake"), (0, 7_381, 0));
    assert_eq!(count("hall"), (300_000, 0, 1));
    assert_eq!(count("hairball"), (400_000, 0, 1));
    assert_eq!(count("forest"), (4 * 1_000 + 20_000, 0, 10_001));
}

/// A checksum of all ray sets of each scene at small detail.
const CHECKSUMS: [(&str, u64); 6] = [
    ("heightfield", 0x5031_7a04_7719_424c),
    ("sphereflake", 0x081a_454a_c0cf_084b),
    ("hall", 0x0ff7_900f_5908_a02e),
    ("hairball", 0xe746_9fd5_3e1f_4e64),
    ("forest", 0xaafa_6534_5eba_72f8),
    ("terrain", 0xc1de_b337_f561_b57e),
];

#[test]
fn rays_are_the_same_on_every_machine() {
    let mut verdict = Verdict::on("checksums");
    for (name, expected) in CHECKSUMS {
        let scene = ALL.iter().find(|scene| scene.name == name).expect(name);
        let sets = ray_sets::of(&(scene.scene)(Detail::Small), SIDE);
        let sums = sets.iter().map(|set| set.checksum());
        let sum = sums.fold(0_u64, |all, sum| all.rotate_left(7) ^ sum);
        verdict.that(name, sum == expected, || format!("{sum:#018x}"));
    }
    verdict.close();
}

/// Nodes visited and primitives tested per ray of each ray set, in their order.
type Steps = [[f64; 2]; 6];

const STEPS: [(&str, Steps); 6] = [
    (
        "heightfield",
        [
            [6.323, 2.173],
            [10.110, 4.845],
            [8.591, 3.466],
            [10.103, 4.333],
            [9.306, 3.600],
            [8.836, 2.842],
        ],
    ),
    (
        "sphereflake",
        [
            [3.473, 0.894],
            [4.751, 1.618],
            [4.347, 1.508],
            [5.108, 1.935],
            [5.052, 1.993],
            [3.448, 0.918],
        ],
    ),
    (
        "hall",
        [
            [12.089, 3.975],
            [8.392, 2.137],
            [8.088, 2.473],
            [11.083, 5.146],
            [13.048, 5.552],
            [7.431, 2.806],
        ],
    ),
    (
        "hairball",
        [
            [5.921, 0.220],
            [13.075, 2.582],
            [9.373, 2.209],
            [13.955, 2.627],
            [14.612, 2.507],
            [9.125, 0.341],
        ],
    ),
    (
        "forest",
        [
            [21.341, 3.838],
            [14.527, 3.464],
            [15.559, 3.806],
            [22.039, 5.524],
            [24.988, 6.203],
            [15.283, 2.608],
        ],
    ),
    (
        "terrain",
        [
            [9.176, 2.221],
            [12.063, 3.712],
            [12.728, 3.902],
            [14.463, 4.402],
            [14.720, 4.455],
            [9.265, 1.936],
        ],
    ),
];

#[test]
fn nodes_and_primitives_per_ray_do_not_grow() {
    do_not_grow("steps per ray", &STEPS, |query, batch, test| {
        query.steps(batch, test).expect("steps")
    });
}

/// Fails if the means of what `count` counts are more than 5 % above a table. Then it prints the table of today, to replace
/// that after a change on purpose.
fn do_not_grow(
    what: &str,
    table: &[(&str, Steps)],
    count: impl Fn(&RayQuery, &RayBatch, RayTest) -> Vec<RaySteps>,
) {
    let mut verdict = Verdict::on(what);
    let mut today = String::new();
    for (name, expected) in table {
        today += &format!("\n{name} ");
        let (query, sets) = small(name);
        for (set, expected) in sets.iter().zip(expected) {
            let batch = query.batch(&set.rays).expect("a batch");
            let found = means(&count(&query, &batch, set.test));
            today += &format!("[{:.3}, {:.3}], ", found[0], found[1]);
            let has_grown =
                (found.iter().zip(expected)).any(|(found, expected)| *found > GROWTH * expected);
            verdict.that(format!("{name}, {}", set.name), !has_grown, || {
                format!("[{:.3}, {:.3}], it was {expected:?}", found[0], found[1])
            });
        }
    }
    println!("{today}");
    verdict.close();
}

/// A scene at small detail, ready for queries, and its ray sets.
fn small(name: &str) -> (RayQuery, Vec<RaySet>) {
    let scene = ALL.iter().find(|scene| scene.name == name).expect(name);
    let scene = (scene.scene)(Detail::Small);
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let policy = ExecutionPolicy::default();
    let query = RayQuery::new(open_gpu(), packed, &view, policy).expect("a query");
    (query, ray_sets::of(&scene, SIDE))
}

/// Nodes and primitives, as means over the rays.
fn means(steps: &[RaySteps]) -> [f64; 2] {
    let mean = |part: fn(&RaySteps) -> u32| {
        let sum: f64 = steps.iter().map(|steps| f64::from(part(steps))).sum();
        sum / steps.len() as f64
    };
    [mean(|steps| steps.nodes), mean(|steps| steps.primitives)]
}

#[test]
fn secondary_rays_start_where_primary_rays_hit() {
    let mut verdict = Verdict::on("hits");
    for scene in ALL {
        let name = scene.name;
        let scene = (scene.scene)(Detail::Small);
        let packed = Arc::new(pack::scene(&scene).expect("packed"));
        let view = packed.frame(&scene.frame(0.0)).expect("a view");
        let policy = ExecutionPolicy::default();
        let query = RayQuery::new(open_gpu(), packed, &view, policy).expect("a query");
        let sets = ray_sets::of(&scene, SIDE);
        let [primary, others @ .., random] = &sets[..] else {
            panic!("{} sets", sets.len())
        };
        assert_eq!(primary.rays.len(), (SIDE * SIDE) as usize);
        assert_eq!(random.rays.len(), (SIDE * SIDE) as usize);
        let hits = query.closest_hits(&primary.rays).expect("hits");
        let points: Vec<_> = (primary.rays.iter().zip(&hits))
            .filter_map(|(ray, hit)| {
                let way = f64::from((*hit)?.t) * ray.direction.as_dvec3();
                Some(ray.origin + way)
            })
            .collect();
        let (low, high) = scene.bounds().expect("bounds");
        let radius = 0.5 * (high - low).length();
        for set in others {
            // The adapter may see a grazing ray differently than the host.
            let count = set.rays.len();
            let differ = count.abs_diff(points.len());
            verdict.that(
                format!("{name}, {}", set.name),
                differ <= points.len() / 200,
                || format!("{count} rays from {} hits", points.len()),
            );
            if differ == 0 {
                let far = set.rays.iter().zip(&points);
                let far = far.filter(|(ray, point)| ray.origin.distance(**point) > 1e-4 * radius);
                let far = far.count();
                verdict.that(format!("{name}, {}", set.name), far <= count / 200, || {
                    format!("{far} rays start elsewhere")
                });
            }
            let is_unit = |length: f32| (length - 1.0).abs() < 1e-6;
            let is_fine = set.rays.iter().all(|ray| is_unit(ray.direction.length()));
            verdict.that(
                format!("{name}, {}", set.name),
                is_fine,
                || "directions are not of unit length",
            );
        }
        let occlusion = &others[1].rays;
        let is_short = |ray: &glimray::render::QueryRay| f64::from(ray.t_max) <= 0.1001 * radius;
        assert!(
            occlusion.iter().all(is_short),
            "{name}: occlusion rays are short"
        );
    }
    verdict.close();
}

#[test]
fn the_largest_scenes_are_as_documented() {
    let terrain = scenes::terrain(Detail::Full);
    assert_eq!(terrain.triangle_count(), 4_000_000);
    let small = scenes::terrain(Detail::Small);
    assert_eq!(small.triangle_count(), 40_000);
}
