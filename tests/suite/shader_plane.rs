//! Level 2: `lib/intersect/plane.wesl`.

use crate::support::{harness::gpu, types::ray, verdict::Tolerance};

#[test]
fn a_plane_is_hit_where_it_should_be() {
    let up = [0f32, 1.0, 0.0];
    let ground = [0f32, -1.0, 0.0];
    let half = 0.5f32.sqrt();
    let origin = [0.0; 3];
    #[rustfmt::skip]
    gpu().check("lib::intersect::plane::intersect_plane", Tolerance::Ulps(2.0), &[
        ("straight down", (ray(origin, [0.0, -1.0, 0.0]), ground, up), Some(1.0)),
        ("from below it is hit as well", (ray([0.0, -3.0, 0.0], [0.0, 1.0, 0.0]), ground, up), Some(2.0)),
        ("the normal may point away", (ray(origin, [0.0, -1.0, 0.0]), ground, [0.0, -1.0, 0.0]), Some(1.0)),
        ("3-4-5", (ray([0.0, 2.0, 0.0], [0.8, -0.6, 0.0]), ground, up), Some(3.0 / f64::from(0.6f32))),
        ("it lies behind", (ray(origin, [0.0, 1.0, 0.0]), ground, up), None),
        ("a parallel ray", (ray(origin, [0.6, 0.0, 0.8]), ground, up), None),
        ("a parallel ray with a negative zero", (ray(origin, [0.6, -0.0, 0.8]), ground, up), None),
        ("a ray within the plane", (ray([7.0, -1.0, 2.0], [1.0, 0.0, 0.0]), ground, up), None),
        ("a ray that starts on it", (ray([7.0, -1.0, 2.0], [0.0, -1.0, 0.0]), ground, up), None),
        ("grazing with a slope of 10^-6", (ray(origin, [1.0, -1e-6, 0.0]), ground, up), Some(1.0 / f64::from(1e-6f32))),
        ("any point of the plane will do", (ray(origin, [0.0, -1.0, 0.0]), [1000.0, -1.0, -500.0], up), Some(1.0)),
        ("far away", (ray(origin, [0.0, -1.0, 0.0]), [0.0, -1e30, 0.0], up), Some(f64::from(1e30f32))),
        ("very near", (ray(origin, [0.0, -1.0, 0.0]), [0.0, -1e-30, 0.0], up), Some(f64::from(1e-30f32))),
        ("slanted at 45°", (ray(origin, [0.0, -1.0, 0.0]), ground, [half, half, 0.0]), Some(1.0)),
    ]);
}
