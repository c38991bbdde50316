//! The exact counters of packets, where the adapter traces them.

use super::{SIDE, Steps, do_not_grow, means, small};
use glimray::render::RayTest;

/// Nodes visited and primitives tested by a packet, for each ray set: with packets of 32 rays, in subgroups of 8 lanes, and
/// of 64 rays, in subgroups of 16.
const OF_32: [(&str, Steps); 6] = [
    (
        "heightfield",
        [
            [13.289, 18.328],
            [24.915, 37.393],
            [25.938, 37.889],
            [39.265, 53.322],
            [28.777, 39.188],
            [108.906, 82.828],
        ],
    ),
    (
        "sphereflake",
        [
            [4.398, 2.242],
            [7.041, 5.252],
            [7.308, 5.835],
            [13.626, 10.014],
            [13.407, 9.626],
            [21.773, 12.883],
        ],
    ),
    (
        "hall",
        [
            [26.203, 19.477],
            [22.461, 19.367],
            [28.930, 22.727],
            [74.250, 51.688],
            [51.641, 38.680],
            [75.680, 37.250],
        ],
    ),
    (
        "hairball",
        [
            [20.633, 6.812],
            [164.896, 84.418],
            [125.851, 67.090],
            [183.612, 78.597],
            [182.955, 76.254],
            [125.977, 10.484],
        ],
    ),
    (
        "forest",
        [
            [111.586, 75.359],
            [164.086, 95.398],
            [179.067, 95.142],
            [304.110, 147.018],
            [308.481, 159.474],
            [329.555, 85.305],
        ],
    ),
    (
        "terrain",
        [
            [49.203, 58.523],
            [82.398, 97.555],
            [102.299, 104.827],
            [127.754, 117.468],
            [121.354, 118.852],
            [181.344, 63.953],
        ],
    ),
];

const OF_64: [(&str, Steps); 6] = [
    (
        "heightfield",
        [
            [18.953, 32.453],
            [34.457, 61.810],
            [36.400, 63.994],
            [55.827, 89.667],
            [40.569, 67.150],
            [170.375, 164.234],
        ],
    ),
    (
        "sphereflake",
        [
            [5.141, 3.016],
            [8.826, 7.680],
            [9.292, 8.125],
            [17.248, 14.992],
            [17.872, 14.839],
            [27.844, 21.047],
        ],
    ),
    (
        "hall",
        [
            [32.375, 29.047],
            [28.734, 28.766],
            [39.219, 36.234],
            [113.141, 86.984],
            [70.453, 60.391],
            [121.672, 65.547],
        ],
    ),
    (
        "hairball",
        [
            [32.812, 13.625],
            [289.552, 168.478],
            [231.881, 133.955],
            [316.388, 156.925],
            [321.940, 152.194],
            [196.609, 20.969],
        ],
    ),
    (
        "forest",
        [
            [186.688, 145.656],
            [272.316, 182.248],
            [293.716, 182.279],
            [520.868, 285.178],
            [526.448, 309.988],
            [601.016, 173.594],
        ],
    ),
    (
        "terrain",
        [
            [84.875, 115.203],
            [144.855, 192.590],
            [174.112, 203.677],
            [222.029, 234.418],
            [208.994, 235.003],
            [325.141, 131.125],
        ],
    ),
];

#[test]
fn nodes_and_primitives_per_packet_do_not_grow() {
    let (query, _) = small("sphereflake");
    let table = match query.packet_rays() {
        Some(32) => OF_32,
        Some(64) => OF_64,
        Some(other) => panic!("packets of {other} rays"),
        None => return,
    };
    do_not_grow("steps per packet", &table, |query, batch, test| {
        let steps = query.packet_steps(batch, test).expect("steps");
        steps.expect("no packet exceeds its stack")
    });
}

/// A packet visits what any of its rays visits. If all are the same ray, it does what one does alone.
#[test]
fn a_packet_of_equal_rays_takes_the_steps_of_one() {
    for scene in ["sphereflake", "hall", "forest"] {
        let (query, sets) = small(scene);
        let Some(count) = query.packet_rays() else {
            return;
        };
        let chosen = sets[0].rays.iter().step_by(61);
        let rays: Vec<_> = chosen
            .flat_map(|ray| std::iter::repeat_n(*ray, count as usize))
            .collect();
        assert!(rays.len() > (SIDE * SIDE / 4) as usize);
        let batch = query.batch(&rays).expect("a batch");
        let alone = query.steps(&batch, RayTest::Closest).expect("steps");
        let packets = query.packet_steps(&batch, RayTest::Closest);
        let packets = packets.expect("steps").expect("packets");
        let differing = alone.iter().zip(&packets).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{scene}, of {} rays", rays.len());
    }
}

/// Packets of different rays visit more nodes than each ray alone, and fewer than all of them together.
#[test]
fn a_packet_visits_the_nodes_of_its_rays() {
    let (query, sets) = small("hall");
    let Some(count) = query.packet_rays() else {
        return;
    };
    for set in sets {
        let batch = query.batch(&set.rays).expect("a batch");
        let [alone, _] = means(&query.steps(&batch, set.test).expect("steps"));
        let packets = query.packet_steps(&batch, set.test).expect("steps");
        let [packets, _] = means(&packets.expect("packets"));
        let all = f64::from(count) * alone;
        assert!(
            (alone..all).contains(&packets),
            "{}: {alone} {packets}",
            set.name
        );
    }
}
