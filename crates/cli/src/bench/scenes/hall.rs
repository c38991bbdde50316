//! A hall: long and short triangles in one tree, seen from inside.

use super::{Detail, of_mesh, parts::Builder};
use crate::bench::random::Random;
use glam::{DVec3, dvec3};
use glimray_scene::Scene;

/// Half the width, the height and half the length of the hall.
const SIZE: DVec3 = DVec3::new(10.0, 12.0, 30.0);
/// Columns on each side, and their radius.
const COLUMNS: u32 = 20;
const COLUMN_RADIUS: f64 = 0.5;
const WIRE_SIDES: u32 = 24;

/// 300,000 triangles: walls, columns of narrow strips from floor to ceiling, wires along the whole hall, balls of
/// small triangles, and some scattered triangles.
pub fn hall(detail: Detail) -> Scene {
    let (column_sides, wires) = detail.of((360, 200), (36, 20));
    let (balls, ball_rows, count) = detail.of((127, 16, 300_000), (40, 4, 9_000));
    let mut random = Random::new(4);
    let mut builder = Builder::default();
    walls(&mut builder);
    for index in 0..2 * COLUMNS {
        let along = f64::from(index / 2) + 0.5 - f64::from(COLUMNS) / 2.0;
        let side = if index % 2 == 0 { -1.0 } else { 1.0 };
        let foot = dvec3(
            0.6 * side * SIZE.x,
            0.0,
            along * 2.0 * SIZE.z / f64::from(COLUMNS),
        );
        let ends = [foot, foot + SIZE.y * DVec3::Y];
        builder.tube(ends, COLUMN_RADIUS, column_sides);
    }
    for _ in 0..wires {
        let [x, y] = [random.between(-SIZE.x, SIZE.x), random.between(9.0, 11.5)];
        let ends = [-SIZE.z, SIZE.z].map(|z| dvec3(x, y, z));
        builder.tube(ends, 0.02, WIRE_SIDES);
    }
    for _ in 0..balls {
        let radius = random.between(0.2, 0.8);
        let center = random.point(
            dvec3(-SIZE.x, radius, -SIZE.z),
            dvec3(SIZE.x, radius + 1.0, SIZE.z),
        );
        builder.ball(center, radius, ball_rows);
    }
    while builder.triangle_count() < count {
        let center = random.point(dvec3(-SIZE.x, 0.0, -SIZE.z), SIZE);
        builder.triangle([(); 3].map(|()| center + 0.1 * random.direction()));
    }
    let view = [dvec3(-2.0, 2.0, -28.0), dvec3(1.0, 4.0, 0.0)];
    of_mesh(builder.mesh(), view, dvec3(0.5, 8.0, -3.0))
}

/// The six sides of the hall.
fn walls(builder: &mut Builder) {
    let corner = |x: u32, y: u32, z: u32| {
        let [x, y, z] = [x, y, z].map(f64::from);
        dvec3(2.0 * x - 1.0, y, 2.0 * z - 1.0) * SIZE
    };
    for side in 0..2 {
        builder.grid(1, 1, |i, j| corner(side, i, j));
        builder.grid(1, 1, |i, j| corner(i, side, j));
        builder.grid(1, 1, |i, j| corner(i, j, side));
    }
}
