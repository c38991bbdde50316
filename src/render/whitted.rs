//! The overrides of `kernels/whitted.wesl`.

use super::{
    device::Task,
    layers,
    settings::{Integrator, TriangleTest},
};
use crate::{
    layout::{
        FILTER_BLACKMAN_HARRIS, FILTER_BOX, FILTER_GAUSSIAN, FILTER_MITCHELL, FILTER_TENT,
        TRIANGLE_TEST_MOLLER_TRUMBORE, TRIANGLE_TEST_PLANE, TRIANGLE_TEST_WATERTIGHT,
    },
    scene::{Antialias, Filter},
};

/// Values for the `override`s of `bindings.wesl`, by their ids.
pub type Overrides = Vec<(&'static str, f64)>;

/// Features that the scene, the frame and the settings need; all others are compiled out.
pub fn overrides(task: Task) -> Overrides {
    let mut overrides = tracing(task);
    overrides.push(("9", flag(task.view.has_lights)));
    overrides.push(("20", f64::from(task.view.background)));
    overrides.push(("16", flag(task.view.has_area_lights)));
    overrides
}

/// Those of every kernel that sends rays.
pub fn tracing(task: Task) -> Overrides {
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
    let filter = match settings.filter {
        Filter::Box => FILTER_BOX,
        Filter::Tent => FILTER_TENT,
        Filter::Gaussian => FILTER_GAUSSIAN,
        Filter::BlackmanHarris => FILTER_BLACKMAN_HARRIS,
        Filter::Mitchell => FILTER_MITCHELL,
    };
    let features = scene.features;
    let layers = layers::of_sampling(settings);
    let squares_row = layers::row_of(layers, &layers::SQUARES).unwrap_or_default();
    let mut cameras = view.cameras.iter().chain([&view.frame.camera]);
    vec![
        ("0", f64::from(triangle_test)),
        ("1", flag(!scene.triangles.is_empty())),
        ("2", flag(scene.bounded_shape_count() > 0)),
        ("3", flag(scene.plane_count > 0)),
        ("4", flag(scene.features.mixed_materials)),
        ("5", flag(settings.brute_force)),
        ("6", flag(settings.antialias != Antialias::None)),
        ("7", flag(settings.count_rays)),
        ("8", flag(settings.integrator == Integrator::Heat)),
        ("11", f64::from(features.shape_kinds)),
        ("12", flag(features.reflection && settings.max_depth > 0)),
        ("13", flag(features.refraction && settings.max_depth > 0)),
        ("14", flag(features.contact && settings.max_depth > 0)),
        ("15", flag(features.filtered_shadows)),
        ("17", flag(cameras.any(|camera| camera.lens_radius > 0.0))),
        ("18", f64::from(filter)),
        ("19", f64::from(settings.filter_radius)),
        (
            "21",
            flag(features.textures || settings.integrator == Integrator::Uv),
        ),
        ("22", flag(features.emission)),
        ("23", flag(settings.is_adaptive())),
        ("24", flag(features.instances)),
        ("25", flag(view.has_moving_instances())),
        ("26", flag(!view.cameras.is_empty())),
        ("27", flag(view.frame.light_key_count > 1)),
        ("28", flag(view.orthographic)),
        ("29", flag(!scene.uvs.is_empty())),
        ("30", layers::rows(layers) as f64),
        ("31", squares_row as f64),
    ]
}

fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}
