//! The overrides of `kernels/whitted.wesl`.

use super::{
    device::Task,
    settings::{Antialias, TriangleTest},
};
use crate::layout::{TRIANGLE_TEST_MOLLER_TRUMBORE, TRIANGLE_TEST_PLANE, TRIANGLE_TEST_WATERTIGHT};

/// Features that the scene, the frame and the settings need; all others are compiled out. `limit_steps` makes
/// the kernel report paths that come near a software driver's limit of loop rounds.
pub fn overrides(task: Task, limit_steps: bool) -> Vec<(&'static str, f64)> {
    let Task {
        scene,
        view,
        settings,
        ..
    } = task;
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
        ("10", flag(view.has_lights)),
    ]
}
