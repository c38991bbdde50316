//! The overrides of `kernels/whitted.wesl`.

use super::settings::{Antialias, Settings, TriangleTest};
use crate::{
    layout::{TRIANGLE_TEST_MOLLER_TRUMBORE, TRIANGLE_TEST_PLANE, TRIANGLE_TEST_WATERTIGHT},
    pack::PackedScene,
};

/// Features that the scene and the settings need; all others are compiled out. `limit_steps` makes
/// the kernel report paths that come near a software driver's limit of loop rounds.
pub fn overrides(
    scene: &PackedScene,
    settings: &Settings,
    limit_steps: bool,
) -> Vec<(&'static str, f64)> {
    let triangle_test = match settings.triangle_test {
        TriangleTest::Plane => TRIANGLE_TEST_PLANE,
        TriangleTest::MollerTrumbore => TRIANGLE_TEST_MOLLER_TRUMBORE,
        TriangleTest::Watertight => TRIANGLE_TEST_WATERTIGHT,
    };
    let flag = |on: bool| f64::from(u8::from(on));
    vec![
        ("0", f64::from(triangle_test)),
        ("1", flag(!scene.triangles.is_empty())),
        ("2", flag(scene.bounded_shape_count() > 0)),
        ("3", flag(scene.plane_count > 0)),
        ("4", flag(scene.mixed_materials)),
        ("5", flag(settings.brute_force)),
        ("6", flag(settings.antialias == Antialias::Stratified)),
        ("7", flag(settings.count_rays)),
        ("8", flag(limit_steps)),
    ]
}
