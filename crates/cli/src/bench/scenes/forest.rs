//! A forest: many instances of a few meshes, in a TLAS whose leaves overlap.

use super::{Detail, empty, hills, parts::Builder, placed};
use crate::bench::random::Random;
use glam::{DAffine3, DMat3, DVec3, dvec3};
use glimray_scene::{Mesh, Scene};

/// Different trees.
const KINDS: u64 = 4;
/// Leaves of a tree, of two triangles each.
const LEAVES: u32 = 492;
/// Distance between neighbouring trees.
const SPACING: f64 = 1.5;

/// 10,000 instances of four trees of 1,000 triangles each, on a ground of 20,000 triangles.
pub fn forest(detail: Detail) -> Scene {
    let (side, ground) = detail.of((100, 100), (12, 10));
    let extent = SPACING * side as f64;
    let view = [
        dvec3(-0.55 * extent, 4.0, -0.55 * extent),
        dvec3(0.0, 1.0, 0.0),
    ];
    let mut scene = empty(view, dvec3(-0.5 * extent, extent, 0.2 * extent));
    scene.meshes = (0..KINDS).map(|kind| tree(kind).into()).collect();
    scene.instances = (0..side * side)
        .map(|index| {
            let mut random = Random::of(6, index);
            let cell = dvec3((index % side) as f64, 0.0, (index / side) as f64);
            let jitter = dvec3(random.unit(), 0.0, random.unit());
            let place = SPACING * (cell + jitter) - 0.5 * extent * dvec3(1.0, 0.0, 1.0);
            let scale = random.between(0.7, 1.3);
            let turned = DAffine3::from_mat3(scale * about_y(&mut random));
            placed(
                (index % KINDS) as usize,
                DAffine3::from_translation(place) * turned,
            )
        })
        .collect();
    scene.meshes.push(hills(ground, ground, 0.0).into());
    let stretch = DAffine3::from_scale(dvec3(1.2 * extent, 1.0, 1.2 * extent));
    scene.instances.push(placed(KINDS as usize, stretch));
    scene
}

/// A random rotation about the vertical axis.
fn about_y(random: &mut Random) -> DMat3 {
    let across = random.direction().with_y(0.0).normalize_or(DVec3::X);
    DMat3::from_cols(across, DVec3::Y, across.cross(DVec3::Y))
}

/// A trunk and a crown of leaves, about three units high.
fn tree(kind: u64) -> Mesh {
    let mut random = Random::of(7, kind);
    let mut builder = Builder::default();
    builder.tube([DVec3::ZERO, dvec3(0.0, 1.5, 0.0)], 0.08, 8);
    let half = dvec3(0.6, 0.9, 0.6) * random.between(0.8, 1.1);
    for _ in 0..LEAVES {
        // On the crown's surface and a little below it.
        let center = dvec3(0.0, 1.9, 0.0) + half * random.between(0.7, 1.0) * random.direction();
        let (u, v) = (0.09 * random.direction(), 0.09 * random.direction());
        builder.grid(1, 1, |i, j| center + f64::from(i) * u + f64::from(j) * v);
    }
    builder.mesh()
}
