//! Level 1: `lib/camera.wesl` against the geometry of a picture.

use crate::support::{
    harness::gpu,
    random::Random,
    types::{Ray, T_FAR, ray},
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;
use glimray::layout::PackedCamera;
use glimray_shader_test::Plain;

/// A camera that looks along -z with +y up and a vertical field of view of 60°: half the height of the picture
/// is tan 30° = 1/√3 at distance 1.
fn course_camera(aspect: f64) -> Plain<PackedCamera> {
    looking([0.0; 3], DVec3::NEG_Z, DVec3::Y, 1.0 / 3f64.sqrt(), aspect)
}

fn looking(
    origin: [f32; 3],
    forward: DVec3,
    up: DVec3,
    half_height: f64,
    aspect: f64,
) -> Plain<PackedCamera> {
    Plain(PackedCamera {
        origin,
        forward: forward.as_vec3().into(),
        right: (forward.cross(up) * half_height * aspect).as_vec3().into(),
        up: (up * half_height).as_vec3().into(),
        ..Default::default()
    })
}

/// Rounding error of the camera's vectors, the point on the image plane and its normalisation.
const TOLERANCE: Tolerance = Tolerance::Absolute(3e-7);

#[test]
fn rays_go_through_the_points_of_the_image_plane() {
    let wide = course_camera(4.0 / 3.0);
    let square = course_camera(1.0);
    let to_the_right = looking([1.0, 2.0, 3.0], DVec3::X, DVec3::Y, 1.0 / 3f64.sqrt(), 1.0);
    let upside_down = looking([0.0; 3], DVec3::NEG_Z, DVec3::NEG_Y, 1.0, 1.0);
    // Directions as integers over roots: (x, y, z) / √n.
    let over = |x: f64, y: f64, z: f64, n: f64| [x, y, z].map(|c| c / n.sqrt());
    let (r3, r27) = (3f64.sqrt(), 27f64.sqrt());
    let vga = [640.0, 480.0];
    #[rustfmt::skip]
    let rows = [
        ("the middle of the picture is straight ahead", wide, [320.0, 240.0], vga, [0.0, 0.0, -1.0]),
        ("the upper left corner", wide, [0.0, 0.0], vga, over(-4.0, 3.0, -r27, 52.0)),
        ("the upper right corner", wide, [640.0, 0.0], vga, over(4.0, 3.0, -r27, 52.0)),
        ("the lower left corner", wide, [0.0, 480.0], vga, over(-4.0, -3.0, -r27, 52.0)),
        ("the lower right corner", wide, [640.0, 480.0], vga, over(4.0, -3.0, -r27, 52.0)),
        ("the upper edge is 30° above the axis", wide, [320.0, 0.0], vga, [0.0, 0.5, -0.5 * r3]),
        ("the lower edge is 30° below it", wide, [320.0, 480.0], vga, [0.0, -0.5, -0.5 * r3]),
        ("the only pixel of a 1x1 picture", square, [0.5, 0.5], [1.0, 1.0], [0.0, 0.0, -1.0]),
        ("the first pixel of 2x2", square, [0.5, 0.5], [2.0, 2.0], over(-1.0, 1.0, -2.0 * r3, 14.0)),
        ("the last pixel of 2x2", square, [1.5, 1.5], [2.0, 2.0], over(1.0, -1.0, -2.0 * r3, 14.0)),
        ("looking along +x, +z is to the right", to_the_right, [2.0, 1.0], [2.0, 2.0], [0.5 * r3, 0.0, 0.5]),
        ("looking along +x, +y is up", to_the_right, [1.0, 0.0], [2.0, 2.0], [0.5 * r3, 0.5, 0.0]),
        ("upside down, the upper edge looks down", upside_down, [1.0, 0.0], [2.0, 2.0], over(0.0, -1.0, -1.0, 2.0)),
        ("one row of 16384 pixels, its right end", square, [16384.0, 0.5], [16384.0, 1.0], over(1.0, 0.0, -r3, 4.0)),
    ];
    let inputs: Vec<_> = rows
        .iter()
        .map(|&(_, camera, position, size, _)| (camera, position, size))
        .collect();
    let rays: Vec<Ray> = gpu().map("lib::camera::camera_ray", &inputs);
    let mut verdict = Verdict::on("camera_ray");
    for ((name, camera, .., direction), got) in rows.iter().zip(&rays) {
        verdict.near(name, &got.direction, direction, TOLERANCE);
        let expected = ray(camera.origin, got.direction);
        verdict.that(
            format!("{name}: from the eye, without end"),
            *got == expected,
            || format!("{got:?}"),
        );
    }
    verdict.close();
}

#[test]
fn camera_rays_have_unit_length_and_no_end() {
    let mut random = Random::new(1);
    let inputs: Vec<_> = (0..2000)
        .map(|_| {
            let forward = random.direction();
            let up = forward.any_orthonormal_vector();
            let half_height = 10f64.powf(random.between(-3.0, 2.0));
            let camera = looking(
                [0.0; 3],
                forward,
                up,
                half_height,
                random.between(0.1, 10.0),
            );
            (
                camera,
                [
                    random.between(0.0, 640.0) as f32,
                    random.between(0.0, 480.0) as f32,
                ],
                [640f32, 480.0],
            )
        })
        .collect();
    let rays: Vec<Ray> = gpu().map("lib::camera::camera_ray", &inputs);
    let mut verdict = Verdict::on("camera_ray");
    for (i, ray) in rays.iter().enumerate() {
        let length = DVec3::from(ray.direction.map(f64::from)).length();
        verdict.near(
            format!("ray {i} has length 1"),
            &(length as f32),
            &1.0,
            TOLERANCE,
        );
        verdict.near(
            format!("ray {i} has no end"),
            &ray.t_max,
            &f64::from(T_FAR),
            Tolerance::Exact,
        );
    }
    verdict.close();
}
