//! A hairball: thin triangles in all directions, whose boxes overlap and are mostly empty.

use super::{Detail, of_mesh, parts::Builder};
use crate::bench::random::Random;
use glam::{DVec3, dvec3};
use glimray_scene::Scene;

/// Length of a segment of a hair.
const STEP: f64 = 0.012;
/// Half the width of a hair.
const WIDTH: f64 = 0.0006;
/// How much a hair bends from one segment to the next.
const BEND: f64 = 0.25;

/// 400,000 triangles: 2,000 curled ribbons that start on a small ball.
pub fn hairball(detail: Detail) -> Scene {
    let (hairs, segments) = detail.of((2000, 100), (200, 20));
    let mut builder = Builder::default();
    for hair in 0..hairs {
        let mut random = Random::of(5, hair);
        let mut direction = random.direction();
        let mut at = 0.2 * direction;
        let across = random.direction();
        let mut ribbon = Vec::new();
        for _ in 0..=segments {
            let aside = WIDTH * direction.cross(across).normalize_or(DVec3::Y);
            ribbon.push([at - aside, at + aside]);
            at += STEP * direction;
            direction = (direction + BEND * random.direction()).normalize();
        }
        builder.grid(1, segments, |i, j| ribbon[j as usize][i as usize]);
    }
    let view = [dvec3(0.25, 0.2, 1.2), DVec3::ZERO];
    of_mesh(builder.mesh(), view, dvec3(2.0, 3.0, 2.0))
}
