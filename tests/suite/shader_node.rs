//! Ray and boxes: `lib/intersect/node.wesl`. A box test may accept a ray that misses the box; it must never
//! reject one that hits. That holds for nodes with planes as bytes and as floats.

use crate::support::{
    harness::gpu,
    random::Random,
    types::Node,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;
use glimray::pack::with_float_planes;

/// `MISS` of node.wesl.
const MISS: u32 = 0xffff_fffc;

/// Keys of the four children, from the same inputs as in traversal.
const KEYS: &str = "
    import package::lib::intersect::node::{child_keys, decode_node};
    import package::lib::numeric::safe_reciprocal;
    fn probe(
        r0: vec4u, r1: vec4u, r2: vec4u, origin: vec3f, direction: vec3f, t_max: f32,
    ) -> vec4u {
        let inv = safe_reciprocal(direction);
        return child_keys(decode_node(r0, r1, r2, inv), origin, inv, t_max);
    }
";

/// Keys of the node with planes as floats, whose lower and upper planes traversal reads in the ray's order.
const FLOAT_KEYS: &str = "
    import package::lib::intersect::node::{float_child_keys, float_node};
    import package::lib::numeric::safe_reciprocal;
    fn probe(
        lx: vec4u, ux: vec4u, ly: vec4u, uy: vec4u, lz: vec4u, uz: vec4u,
        origin: vec3f, direction: vec3f, t_max: f32,
    ) -> vec4u {
        let inv = safe_reciprocal(direction);
        let down = inv < vec3f(0.0);
        let node = float_node(
            select(lx, ux, down.x), select(ux, lx, down.x),
            select(ly, uy, down.y), select(uy, ly, down.y),
            select(lz, uz, down.z), select(uz, lz, down.z),
        );
        return float_child_keys(node, origin, inv, t_max);
    }
";

/// How the planes of a node are stored.
#[derive(Clone, Copy, Debug)]
enum Planes {
    Bytes,
    Floats,
}

/// A node, and the origin, direction and end of a ray.
type Case = (Boxes, [f32; 3], [f32; 3], f32);

/// The keys of the children in each case.
fn keys(planes: Planes, cases: &[Case]) -> Vec<[u32; 4]> {
    match planes {
        Planes::Bytes => {
            let inputs = cases
                .iter()
                .map(|&(node, o, d, end)| (box_rows(&node), o, d, end));
            gpu().map_source(KEYS, &inputs.collect::<Vec<_>>())
        }
        Planes::Floats => {
            let inputs = cases
                .iter()
                .map(|&(node, o, d, end)| (float_rows(&node), o, d, end));
            gpu().map_source(FLOAT_KEYS, &inputs.collect::<Vec<_>>())
        }
    }
}

/// A row of 16 bytes.
type Row = [u32; 4];

/// The rows of a packed node.
type Rows = (Row, Row, Row, Row);

/// The rows of the boxes of a packed node.
type BoxRows = (Row, Row, Row);

/// The rows of the boxes of a node in floats.
type FloatRows = (Rows, (Row, Row));

fn float_rows(node: &Boxes) -> FloatRows {
    let (r0, r1, r2, r3) = rows(node);
    let words = [r0, r1, r2, r3].concat().try_into().expect("16 words");
    let [lx, ux, ly, uy, lz, uz, _]: [Row; 7] = bytemuck::cast(with_float_planes(&words));
    ((lx, ux, ly, uy), (lz, uz))
}

/// Lower and upper planes of a child as steps from the node's corner.
type Steps = ([u8; 3], [u8; 3]);

/// A node before it is packed.
#[derive(Clone, Copy, Debug)]
struct Boxes {
    lo: [f32; 3],
    scale: [f32; 3],
    boxes: [Steps; 4],
    children: [u32; 4],
}

fn node(lo: [f32; 3], scale: [f32; 3], boxes: [Steps; 4]) -> Boxes {
    with_children(lo, scale, boxes, [1, 2, 3, 4])
}

/// The step along x is rounded so that its lowest three bits are the number of children.
fn with_children(lo: [f32; 3], scale: [f32; 3], boxes: [Steps; 4], children: [u32; 4]) -> Boxes {
    let count = children.iter().filter(|child| **child != 0).count() as u32;
    let [x, y, z] = scale;
    Boxes {
        lo,
        scale: [f32::from_bits(x.to_bits() & !7 | count), y, z],
        boxes,
        children,
    }
}

fn box_rows(node: &Boxes) -> BoxRows {
    let (r0, r1, r2, _) = rows(node);
    (r0, r1, r2)
}

fn rows(node: &Boxes) -> Rows {
    let planes = |axis: usize| {
        let lower = node.boxes.map(|(min, _)| min[axis]);
        let upper = node.boxes.map(|(_, max)| max[axis]);
        [lower, upper].map(u32::from_le_bytes)
    };
    let ([x, y, z], [sx, sy, sz]) = (node.lo.map(f32::to_bits), node.scale.map(f32::to_bits));
    let [[x0, x1], [y0, y1], [z0, z1]] = [0, 1, 2].map(planes);
    (
        [x, y, z, sx],
        [sy, sz, x0, x1],
        [y0, y1, z0, z1],
        node.children,
    )
}

/// The two corners of a child in exact arithmetic.
fn corners(node: &Boxes, (min, max): Steps) -> [DVec3; 2] {
    [min, max].map(|steps| {
        let along = |axis: usize| {
            f64::from(node.lo[axis]) + f64::from(node.scale[axis]) * f64::from(steps[axis])
        };
        DVec3::new(along(0), along(1), along(2))
    })
}

/// The interval of a line inside a box, planes included; `None` if it misses.
fn slab([min, max]: [DVec3; 2], origin: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (o, d) = (origin[axis], direction[axis]);
        if d == 0.0 {
            if o < min[axis] || o > max[axis] {
                return None;
            }
        } else {
            let (a, b) = ((min[axis] - o) / d, (max[axis] - o) / d);
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
    }
    (near <= far && far >= 0.0).then_some((near.max(0.0), far))
}

#[test]
fn decode_node_takes_the_rows_apart() {
    #[rustfmt::skip]
    let rows = [
        [1.5f32.to_bits(), (-2.0f32).to_bits(), 1e-30f32.to_bits(), 0x3e80_0003],
        [0.5f32.to_bits(), 8.0f32.to_bits(), 0x0403_0201, 0xff80_7f00],
        [0x1413_1211, 0x1817_1615, 0x2423_2221, 0x2827_2625],
    ];
    let up = [1f32, 1.0, 1e18];
    let down = [-1f32, 1.0, -1e18];
    let inputs = [up, down].map(|inv| (rows[0], rows[1], rows[2], inv));
    let nodes: Vec<Node> = gpu().map("lib::intersect::node::decode_node", &inputs);
    let expected = Node {
        lo: [1.5, -2.0, 1e-30],
        scale: [f32::from_bits(0x3e80_0003), 0.5, 8.0],
        near_x: [1.0, 2.0, 3.0, 4.0],
        far_x: [0.0, 127.0, 128.0, 255.0],
        near_y: [17.0, 18.0, 19.0, 20.0],
        far_y: [21.0, 22.0, 23.0, 24.0],
        near_z: [33.0, 34.0, 35.0, 36.0],
        far_z: [37.0, 38.0, 39.0, 40.0],
        child_count: 3,
    };
    assert_eq!(nodes[0], expected);
    // Against an axis the upper planes come first.
    let reversed = Node {
        near_x: expected.far_x,
        far_x: expected.near_x,
        near_z: expected.far_z,
        far_z: expected.near_z,
        ..expected
    };
    assert_eq!(nodes[1], reversed);
}

#[test]
fn float_node_holds_the_rows() {
    let rows: [[f32; 4]; 6] =
        std::array::from_fn(|row| std::array::from_fn(|i| (10 * row + i) as f32 - 20.5));
    let [a, b, c, d, e, f] = rows.map(|row| row.map(f32::to_bits));
    let nodes: Vec<Node> = gpu().map(
        "lib::intersect::node::float_node",
        &[((a, b, c, d), (e, f))],
    );
    let expected = Node {
        lo: [0.0; 3],
        scale: [1.0; 3],
        near_x: rows[0],
        far_x: rows[1],
        near_y: rows[2],
        far_y: rows[3],
        near_z: rows[4],
        far_z: rows[5],
        child_count: 4,
    };
    assert_eq!(nodes[0], expected);
}

/// Boxes whose planes all lie a power of two away from the corner of their node at -4, up to 2^-18 along x.
const GRID: [Steps; 4] = [
    ([2, 1, 2], [8, 4, 4]), // [-2, 4] x [-3, 0] x [-2, 0]
    ([4, 1, 2], [4, 8, 8]), // flat: x = 0
    ([4, 2, 1], [4, 2, 8]), // a line along z
    ([2, 4, 4], [2, 4, 4]), // the point (-2, 0, 0)
];

/// Rays towards these boxes and past them, for every combination of signs and places. Directions are powers of two.
fn grid() -> Vec<Case> {
    let node = node([-4.0; 3], [1.0; 3], GRID);
    let places = [-3.5, -3.0, -2.0, -1.0, 0.0, 4.0, 5.0];
    let slopes = [1.0, -1.0, 0.5, 0.0, -0.0];
    let grid = |values: &[f32]| -> Vec<[f32; 3]> {
        let n = values.len();
        (0..n * n * n)
            .map(|i| [values[i % n], values[i / n % n], values[i / n / n]])
            .collect()
    };
    let directions: Vec<_> = (grid(&slopes).into_iter())
        .filter(|d| *d != [0.0; 3])
        .collect();
    let from = |origin| directions.iter().map(move |d| (node, origin, *d, 1e6f32));
    grid(&places).into_iter().flat_map(from).collect()
}

/// A box of the grid and a ray, in f64.
struct Meeting {
    corners: [DVec3; 2],
    origin: DVec3,
    direction: DVec3,
}

impl Meeting {
    fn of(&(node, origin, direction, _): &Case, child: usize) -> Self {
        Self {
            corners: corners(&node, GRID[child]),
            origin: DVec3::from(origin.map(f64::from)),
            direction: DVec3::from(direction.map(f64::from)),
        }
    }

    /// Where the ray enters the box enlarged by `more`.
    fn entry(&self, more: f64) -> Option<f64> {
        let larger = [self.corners[0] - more, self.corners[1] + more];
        slab(larger, self.origin, self.direction).map(|(near, _)| near)
    }

    /// Whether a miss is as correct as a hit: the builder moves planes outwards, so a ray within a plane has nothing to hit
    /// there, nor, where GPUs fuse operations, one that leaves the box where it starts.
    fn is_either(&self) -> bool {
        let (o, d) = (self.origin, self.direction);
        let on_plane = |i: usize| d[i] == 0.0 && self.corners.iter().any(|c| c[i] == o[i]);
        let leaves = slab(self.corners, o, d).is_some_and(|(_, far)| far == 0.0);
        (0..3).any(on_plane) || leaves && gpu().bound(false, true)
    }
}

/// The arithmetic of the shader and the expected result are exact. A box is a few roundings larger, so a ray beside it may meet it.
#[test]
fn boxes_are_met_exactly_for_every_combination_of_signs_and_places() {
    let cases = grid();
    let mut verdict = Verdict::on("child_keys");
    for (case, keys) in cases.iter().zip(&keys(Planes::Bytes, &cases)) {
        for (child, &key) in keys.iter().enumerate() {
            let meeting = Meeting::of(case, child);
            let expected = (meeting.entry(0.0))
                .map_or(MISS, |near| ((near as f32).to_bits() & !3) | child as u32);
            let name = format!("box {child} from {:?} along {:?}", case.1, case.2);
            let is_beside = expected == MISS && meeting.entry(LARGER).is_some();
            if is_beside {
                let found = (key != MISS).then(|| f64::from(f32::from_bits(key & !3)));
                let is_near = |t: f64| meeting.entry(LARGER).is_some_and(|near| t >= near - LARGER);
                verdict.that(name, found.is_none_or(is_near), || format!("{key:#x}"));
            } else if !meeting.is_either() || expected == MISS {
                verdict.near(name, &key, &expected, Tolerance::Exact);
            } else {
                verdict.that(name, key == MISS || key == expected, || format!("{key:#x}"));
            }
        }
    }
    verdict.close();
}

/// Boxes are larger by a few roundings of the coordinates, which are up to 8.
const LARGER: f64 = 1e-5;

#[test]
fn boxes_in_floats_are_met_where_they_are() {
    let cases = grid();
    let mut verdict = Verdict::on("float_child_keys");
    for (case, keys) in cases.iter().zip(&keys(Planes::Floats, &cases)) {
        for (child, &key) in keys.iter().enumerate() {
            let meeting = Meeting::of(case, child);
            let found = (key != MISS).then(|| f64::from(f32::from_bits(key & !3)));
            let is_right = match (meeting.entry(0.0), found, meeting.entry(LARGER)) {
                (Some(own), Some(found), Some(least)) => {
                    (least - LARGER..=own + LARGER).contains(&found)
                }
                (Some(_), None, _) => meeting.is_either(),
                (None, Some(_), larger) => larger.is_some(),
                _ => found.is_none(),
            };
            let name = format!("box {child} from {:?} along {:?}", case.1, case.2);
            verdict.that(name, is_right, || format!("{key:#x}"));
        }
    }
    verdict.close();
}

/// The packer rejects coordinates beyond 1e15.
#[test]
fn the_largest_boxes_are_met_along_the_axes() {
    let whole = ([0; 3], [255; 3]);
    let node = node([-1e15; 3], [8e12; 3], [whole; 4]);
    let axes = [
        [1f32, 0.0, 0.0],
        [-1.0, -0.0, 0.0],
        [0.0, 1.0, -0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [-0.0, 0.0, -1.0],
    ];
    let inputs = axes.map(|d| (node, d.map(|c| -9e14 * c), d, 3e38f32));
    let mut verdict = Verdict::on("child_keys");
    for planes in [Planes::Bytes, Planes::Floats] {
        for (direction, keys) in axes.iter().zip(&keys(planes, &inputs)) {
            verdict.near(
                format!("{planes:?}, from inside along {direction:?}"),
                keys,
                &[0, 1, 2, 3],
                Tolerance::Exact,
            );
        }
    }
    verdict.close();
}

#[test]
fn boxes_beyond_the_ray_s_end_and_absent_children_are_not_met() {
    let ahead = ([0, 0, 16], [255, 255, 32]);
    let one = with_children(
        [-128.0, -128.0, 0.0],
        [1.0; 3],
        [ahead, ([0, 0, 64], [255, 255, 65]), ahead, ahead],
        [9, 9, 0, 0],
    );
    #[rustfmt::skip]
    let ends = [
        ("without end, both children are met", 1e30, [16.0f32.to_bits(), 64.0f32.to_bits() | 1, MISS, MISS]),
        ("an end between the boxes leaves the first", 40.0, [16.0f32.to_bits(), MISS, MISS, MISS]),
        ("an end inside the box leaves it", 20.0, [16.0f32.to_bits(), MISS, MISS, MISS]),
        ("an end on its plane leaves it", 16.0, [16.0f32.to_bits(), MISS, MISS, MISS]),
        ("an end before it leaves none", 15.9, [MISS; 4]),
    ];
    let inputs = ends.map(|(_, t_max, _)| (one, [0f32; 3], [0f32, 0.0, 1.0], t_max as f32));
    let mut verdict = Verdict::on("child_keys");
    for ((name, _, expected), keys) in ends.iter().zip(&keys(Planes::Bytes, &inputs)) {
        verdict.near(name, keys, expected, Tolerance::Exact);
    }
    for ((name, _, expected), keys) in ends.iter().zip(&keys(Planes::Floats, &inputs)) {
        let is_met = |keys: &[u32; 4]| keys.map(|key| key != MISS);
        let name = format!("{name}, planes as floats");
        verdict.that(name, is_met(keys) == is_met(expected), || {
            format!("{keys:x?}")
        });
    }
    verdict.close();
}

/// The builder moves planes outwards by 2^-20 of the node size; with that slack no ray at a point in the box is
/// rejected, near or far, at any scale.
#[test]
fn a_ray_at_something_in_a_box_meets_the_box() {
    let mut random = Random::new(13);
    let mut inputs = Vec::new();
    let mut aimed_at = Vec::new();
    while inputs.len() < 50_000 {
        let size = 10f64.powf(random.between(-4.0, 4.0));
        let lo = random.in_cube() * size * 10f64.powf(random.between(-2.0, 2.0));
        let scale = (DVec3::splat(1.01) + random.in_cube()) * size / 255.0;
        let boxes = std::array::from_fn(|_| {
            let planes: [[u8; 2]; 3] = std::array::from_fn(|_| {
                let (a, b) = (random.below(256) as u8, random.below(256) as u8);
                [a.min(b), a.max(b)]
            });
            (planes.map(|[min, _]| min), planes.map(|[_, max]| max))
        });
        let node = node(lo.as_vec3().into(), scale.as_vec3().into(), boxes);
        let child = random.below(4);
        let [min, max] = corners(&node, boxes[child]);
        let slack = 255.0 * DVec3::from(node.scale.map(f64::from)) / (1 << 20) as f64;
        let [min, max] = [min + slack, max - slack];
        // Points on the faces, edges and corners of the contents, and inside.
        let fraction = (1.2 * random.in_cube() + 0.5).clamp(DVec3::ZERO, DVec3::ONE);
        let target = min + fraction * (max - min);
        let away = size * 10f64.powf(random.between(-3.0, 4.0));
        let origin = (target + away * random.direction()).as_vec3();
        let direction = (target - origin.as_dvec3()).normalize().as_vec3();
        // The rounded ray may miss the target of the exact one.
        if min.cmple(max).all()
            && slab([min, max], origin.as_dvec3(), direction.as_dvec3()).is_some()
        {
            inputs.push((node, origin.to_array(), direction.to_array(), 3e38f32));
            aimed_at.push(child);
        }
    }
    let mut verdict = Verdict::on("child_keys");
    for planes in [Planes::Bytes, Planes::Floats] {
        let found = keys(planes, &inputs);
        for ((input, &child), keys) in inputs.iter().zip(&aimed_at).zip(&found) {
            let name = format!("{planes:?}, child {child} of {input:?}");
            verdict.that(name, keys[child] != MISS, || "missed");
        }
    }
    verdict.close();
}

/// Boxes of floats need no slack: no ray that meets one is rejected, wherever it is and however close the ray starts.
#[test]
fn a_ray_that_meets_a_box_of_floats_is_not_rejected() {
    let mut random = Random::new(15);
    let mut inputs = Vec::new();
    while inputs.len() < 100_000 {
        let size = 10f64.powf(random.between(-4.0, 4.0));
        let min = (random.in_cube() * size * 10f64.powf(random.between(0.0, 4.0))).as_vec3();
        let max = (min.as_dvec3() + (random.in_cube() + 1.0) * size).as_vec3();
        let corners = [min.as_dvec3(), max.as_dvec3()];
        let fraction = (1.2 * random.in_cube() + 0.5).clamp(DVec3::ZERO, DVec3::ONE);
        let target = corners[0] + fraction * (corners[1] - corners[0]);
        let away = size * 10f64.powf(random.between(-3.0, 2.0));
        let origin = (target + away * random.direction()).as_vec3();
        let direction = (target - origin.as_dvec3())
            .normalize_or(DVec3::X)
            .as_vec3();
        if slab(corners, origin.as_dvec3(), direction.as_dvec3()).is_some() {
            let [lower, upper] =
                [min, max].map(|corner| corner.to_array().map(|c| [c.to_bits(); 4]));
            let first = (lower[0], upper[0], lower[1], upper[1]);
            let rows: FloatRows = (first, (lower[2], upper[2]));
            inputs.push((rows, origin.to_array(), direction.to_array(), 3e38f32));
        }
    }
    let keys: Vec<[u32; 4]> = gpu().map_source(FLOAT_KEYS, &inputs);
    let mut verdict = Verdict::on("float_child_keys");
    for (input, keys) in inputs.iter().zip(&keys) {
        verdict.that(format!("{input:?}"), keys[0] != MISS, || "missed");
    }
    verdict.close();
}

#[test]
fn child_of_takes_the_slot_of_a_key() {
    let children = [7u32, 0x8000_0001, 0, 0xf800_0002];
    let keys = [0, 1, 2, 3, MISS, 0x3f80_0001, 0xffff_fffe, u32::MAX];
    let found: Vec<u32> = gpu().map(
        "lib::intersect::node::child_of",
        &keys.map(|key| (children, key)),
    );
    let [a, b, c, d] = children;
    assert_eq!(found, [a, b, c, d, a, b, c, d]);
}

#[test]
fn sort4_sorts_every_order() {
    let mut random = Random::new(14);
    let small = (0..256).map(|i| [i & 3, i >> 2 & 3, i >> 4 & 3, i >> 6]);
    let large = (0..1000).map(|_| std::array::from_fn(|_| random.word()));
    let inputs: Vec<[u32; 4]> = small
        .chain(large)
        .chain([[MISS, 3, MISS, 0x7f80_0000]])
        .collect();
    let sorted: Vec<[u32; 4]> = gpu().map("lib::intersect::node::sort4", &inputs);
    let mut verdict = Verdict::on("sort4");
    for (keys, got) in inputs.iter().zip(&sorted) {
        let mut expected = *keys;
        expected.sort_unstable();
        verdict.near(format!("{keys:?}"), got, &expected, Tolerance::Exact);
    }
    verdict.close();
}
