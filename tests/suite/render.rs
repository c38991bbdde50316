//! The guarantees of the renderer: a picture is a function of scene, settings and seed, independent of slicing;
//! rays are counted correctly; extreme sizes and scenes work.

use crate::reference::compare::{
    assert_none, check_alike, check_same_bits, counting, open_gpu, render, sized, sliced, start,
    start_packed, try_render,
};
use crate::reference::scenes::{self, Build, Random};
use crate::reference::trace;
use crate::support::skip::{Need, skip};
use glam::{DAffine3, DVec3, Vec3, dvec3, vec3};
use glimray::gpu::{AdapterChoice, Gpu, GpuError};
use glimray::image::Image;
use glimray::pack;
use glimray::render::{
    Antialias, ExecutionPolicy, Integrator, LongPath, RenderError, RenderSettings, Renderer,
    Slicing, Stats, Tone,
};
use glimray::scene::{
    Attenuation, Camera, Light, LightKind, Material, Mesh, Phong, Scene, ToneCurve, Transfer,
};
use glimray_app::error::AppError;
use std::ops::Range;
use std::sync::Arc;

fn against_the_reference(
    name: &str,
    scene: &Scene,
    settings: &RenderSettings,
) -> Result<(), String> {
    let expected = trace(scene, settings.size).image;
    check_alike(name, &expected, &render(scene, settings).0, 2.0, 0.001)
}

/// Renders to the end without a picture.
fn finish(renderer: &mut Renderer) {
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
}

pub fn slicings() -> Vec<(&'static str, Slicing)> {
    let base = Slicing::default();
    vec![
        (
            "one workgroup at a time",
            Slicing {
                max_groups: 1,
                ..base
            },
        ),
        (
            "seven workgroups at a time",
            Slicing {
                max_groups: 7,
                ..base
            },
        ),
        (
            "one sample at a time",
            Slicing {
                max_samples: 1,
                ..base
            },
        ),
        (
            "three samples at a time",
            Slicing {
                max_samples: 3,
                ..base
            },
        ),
        (
            "film tiles of one workgroup",
            Slicing {
                tile_side: 8,
                ..base
            },
        ),
        (
            "film tiles that cut workgroups",
            Slicing {
                tile_side: 29,
                ..base
            },
        ),
        (
            "shortest slices",
            Slicing {
                target_seconds: 1e-9,
                ..base
            },
        ),
        (
            "longest slices",
            Slicing {
                target_seconds: 10.0,
                max_samples: 64,
                ..base
            },
        ),
    ]
}

#[test]
fn the_cut_of_the_work_does_not_show() {
    let scene = scenes::everything();
    let base = RenderSettings {
        samples: 8,
        antialias: Antialias::Stratified,
        ..sized(77, 51)
    };
    let (expected, stats) = render(&scene, &counting(&base));
    assert_none(slicings().into_iter().map(|(name, slicing)| {
        let (actual, cut) = render(&scene, &sliced(&base, slicing));
        assert_eq!(cut.rays, stats.rays, "{name}");
        check_same_bits(name, &expected, &actual)
    }));
}

#[test]
fn slicing_does_not_affect_pictures_of_more_than_one_block() {
    let scene = scenes::spheres();
    let base = RenderSettings {
        samples: 600,
        antialias: Antialias::Stratified,
        ..sized(19, 13)
    };
    let (expected, _) = render(&scene, &base);
    let rows = slicings()
        .into_iter()
        .filter(|(name, _)| *name != "one workgroup at a time");
    assert_none(rows.map(|(name, slicing)| {
        let (actual, _) = render(&scene, &sliced(&base, slicing));
        check_same_bits(name, &expected, &actual)
    }));
}

#[test]
fn two_runs_give_the_same_bits() {
    let settings = RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        ..sized(96, 64)
    };
    let picture = || render(&scenes::everything(), &settings).0;
    assert_none([check_same_bits("second run", &picture(), &picture())]);
}

#[test]
fn a_crop_is_the_same_pixels_of_the_whole_picture() {
    let scene = scenes::everything();
    let whole = RenderSettings {
        samples: 2,
        antialias: Antialias::Stratified,
        ..sized(70, 50)
    };
    let (expected, _) = render(&scene, &whole);
    let crops = [
        [0, 0, 70, 50],
        [13, 7, 52, 41],
        [69, 49, 70, 50],
        [0, 30, 70, 31],
    ];
    assert_none(crops.map(|crop| {
        let (actual, _) = render(
            &scene,
            &RenderSettings {
                crop: Some(crop),
                ..whole.clone()
            },
        );
        check_same_bits(&format!("{crop:?}"), &cut(&expected, crop), &actual)
    }));
}

/// A part of a picture.
pub fn cut(image: &Image, [x0, y0, x1, y1]: [u32; 4]) -> Image {
    let pixels = (y0..y1).flat_map(|y| (x0..x1).filter_map(move |x| image.pixel(x, y)));
    Image {
        width: x1 - x0,
        height: y1 - y0,
        pixels: pixels.collect(),
    }
}

#[test]
fn looking_at_an_unfinished_picture_does_not_change_the_finished_one() {
    let scene = scenes::spheres();
    let settings = RenderSettings {
        samples: 300,
        antialias: Antialias::Stratified,
        ..sized(24, 24)
    };
    let slicing = Slicing {
        max_groups: 5,
        max_samples: 40,
        tile_side: 16,
        ..Slicing::default()
    };
    let settings = sliced(&settings, slicing);
    let (expected, _) = render(&scene, &settings);
    let mut renderer = start(&scene, &settings).expect("a renderer");
    let mut looks = 0;
    while !renderer.is_done() {
        renderer.step().expect("a step");
        if looks % 5 == 0 {
            let image = renderer.develop(&Tone::LINEAR).expect("a picture");
            assert!(image.pixels.iter().flatten().all(|c| c.is_finite()));
        }
        looks += 1;
    }
    let actual = renderer.develop(&Tone::LINEAR).expect("a picture");
    assert_none([check_same_bits("looked at", &expected, &actual)]);
}

#[test]
fn progress_grows_from_0_to_1() {
    let settings = RenderSettings {
        samples: 3,
        ..sized(50, 40)
    };
    let slicing = Slicing {
        max_groups: 3,
        max_samples: 2,
        tile_side: 32,
        ..Slicing::default()
    };
    let mut renderer = start(&scenes::spheres(), &sliced(&settings, slicing)).expect("a renderer");
    let mut before = renderer.progress();
    assert_eq!(before, 0.0);
    while !renderer.is_done() {
        renderer.step().expect("a step");
        let now = renderer.progress();
        assert!(now > before && now <= 1.0, "{before} was followed by {now}");
        before = now;
    }
    assert_eq!(before, 1.0);
    let submissions = renderer.stats().submissions;
    renderer.step().expect("a step that does nothing");
    assert_eq!(renderer.stats().submissions, submissions);
}

#[test]
fn another_frame_starts_the_picture_over() {
    let first = scenes::everything();
    let mut second = first.clone();
    second.cameras[0].look_from = dvec3(2.0, 2.5, 5.0);
    second.lights.truncate(1);
    second.background = glimray::scene::Background::Color(vec3(0.9, 0.1, 0.2));
    let settings = sized(64, 48);

    let packed = Arc::new(pack::scene(&first).expect("packed"));
    let view = |scene: &Scene| packed.frame(&scene.frame(0.0)).expect("a frame");
    let new = |scene| start_packed(packed.clone(), &view(scene), &settings);
    let mut renderer = new(&first);
    let mut picture = |scene: Option<&Scene>| {
        if let Some(scene) = scene {
            renderer.set_frame(&view(scene)).expect("a frame");
            assert_eq!(renderer.progress(), 0.0);
        }
        finish(&mut renderer);
        renderer.develop(&Tone::LINEAR).expect("a picture")
    };
    let (one, two, again) = (picture(None), picture(Some(&second)), picture(Some(&first)));

    let mut fresh = new(&second);
    finish(&mut fresh);
    let expected = fresh.develop(&Tone::LINEAR).expect("a picture");
    assert_none([
        check_same_bits("second frame", &expected, &two),
        check_same_bits("first frame again", &one, &again),
    ]);
    assert_ne!(one, two);
}

#[test]
fn rays_are_counted_as_the_reference_counts_them() {
    let rows = [("spheres", scenes::spheres()), ("meshes", scenes::meshes())];
    let (settings, policy) = counting(&sized(160, 120));
    for (name, scene) in rows {
        let expected = trace(&scene, settings.size).rays;
        let wanted = (settings.clone(), policy);
        let rays = render(&scene, &wanted).1.rays.expect("counts");
        assert_eq!(rays.primary, 160 * 120, "{name}");
        let pairs = [
            ("primary hits", expected.primary_hits, rays.primary_hits),
            ("shadow", expected.shadow, rays.shadow),
            (
                "shadow blocked",
                expected.shadow_blocked,
                rays.shadow_blocked,
            ),
        ];
        for (what, expected, actual) in pairs {
            // Rays at an edge may go either way.
            let off = expected.abs_diff(actual);
            assert!(
                off * 1000 <= expected,
                "{name}, {what}: {actual}, expected {expected}"
            );
        }
    }
}

#[test]
fn rays_of_many_samples_all_count() {
    let settings = RenderSettings {
        samples: 20,
        ..sized(33, 21)
    };
    let rays = render(&scenes::spheres(), &counting(&settings))
        .1
        .rays
        .expect("counts");
    assert_eq!(rays.primary, 20 * 33 * 21);
    assert_eq!(
        rays.shadow % 20,
        0,
        "centre samples are all alike: {rays:?}"
    );
    assert_eq!(render(&scenes::spheres(), &sized(8, 8)).1.rays, None);
}

#[test]
fn every_size_renders_right() {
    let sizes = [(1, 1), (16384, 1), (1, 300), (17, 9), (2049, 16), (7, 2050)];
    let scene = scenes::spheres();
    assert_none(sizes.map(|(width, height)| {
        against_the_reference(&format!("{width}x{height}"), &scene, &sized(width, height))
    }));
}

#[test]
fn a_scene_without_light_is_ambient_and_one_without_objects_background() {
    let mut dark = scenes::spheres();
    dark.lights.clear();
    let settings = counting(&sized(40, 30));
    let (image, stats) = render(&dark, &settings);
    assert_eq!(
        stats.rays.map(|rays| rays.shadow),
        Some(0),
        "nothing to see a light by"
    );
    assert_none([check_alike(
        "dark",
        &trace(&dark, (40, 30)).image,
        &image,
        0.0,
        0.001,
    )]);

    let (image, stats) = render(&scenes::empty(), &settings);
    assert!(
        image
            .pixels
            .iter()
            .all(|pixel| *pixel == [0.2, 0.4, 0.6, 1.0])
    );
    assert_eq!(
        stats.rays.map(|rays| (rays.primary, rays.primary_hits)),
        Some((1200, 0))
    );
    for integrator in [Integrator::Normals, Integrator::Depth, Integrator::Ids] {
        let (image, _) = render(
            &scenes::empty(),
            &RenderSettings {
                integrator,
                ..sized(9, 9)
            },
        );
        assert!(
            image.pixels.iter().all(|pixel| pixel[..3] == [0.0; 3]),
            "{integrator:?}"
        );
    }
}

#[test]
fn a_camera_inside_a_sphere_sees_its_inner_side() {
    let mut scene = scenes::empty();
    let shiny = scene.add_material(scenes::shiny(vec3(0.3, 0.6, 0.9)));
    scene.add_sphere(dvec3(0.0, 1.0, 6.0), 3.0, shiny);
    scene.add_sphere(dvec3(0.5, 0.5, 4.0), 0.4, 0);
    scene.add_point_light(dvec3(1.0, 2.0, 6.5), 0.8);
    scene.add_point_light(dvec3(0.0, 20.0, 0.0), 0.8);
    assert_none([against_the_reference("inside", &scene, &sized(96, 72))]);
}

/// A floor and a sphere under `count` lamps, which together are as bright as one.
fn under_lamps(count: usize) -> Scene {
    let mut scene = scenes::empty();
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene.add_sphere(dvec3(0.0, 1.0, 0.0), 1.0, 0);
    scene.add_mesh(
        scenes::quad(1.0, 0),
        DAffine3::from_translation(dvec3(-2.0, 0.5, 0.0)),
    );
    let mut random = Random(5);
    for _ in 0..count {
        let position = random.within(3.0).with_y(random.between(4.0, 6.0));
        scene.add_point_light(position, 1.0 / count as f32);
    }
    scene
}

#[test]
fn a_thousand_lights_all_shine() {
    let settings = RenderSettings {
        samples: 3,
        ..sized(64, 48)
    };
    assert_none([against_the_reference(
        "lamps",
        &under_lamps(1000),
        &settings,
    )]);
}

/// Either the correct picture or an error.
fn right_or_refused(
    name: &str,
    scene: &Scene,
    settings: &RenderSettings,
    expected: &Image,
) -> Result<(), String> {
    match try_render(scene, settings) {
        Ok((image, _)) => check_alike(name, expected, &image, 2.0, 0.001),
        Err(RenderError::PathTooLong(_) | RenderError::TooManyShadowRays { .. }) => Ok(()),
        Err(error) => Err(format!("{name}: {error}")),
    }
}

#[test]
fn too_many_lights_for_the_drivers_loop_limit_are_refused_not_left_out() {
    let settings = sized(16, 12);
    assert_none([8_000, 12_000, 20_000, 70_000].map(|count| {
        // The mean of very many lamps is that of fewer, which takes less time.
        let expected = trace(&under_lamps(count.min(12_000)), settings.size).image;
        right_or_refused(
            &format!("{count} lamps"),
            &under_lamps(count),
            &settings,
            &expected,
        )
    }));
}

#[test]
fn lights_behind_the_surface_count_towards_the_loop_limit() {
    let mut scene = scenes::empty();
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene.materials[0].two_sided = false;
    for _ in 0..70_000 {
        scene.add_point_light(dvec3(0.0, -5.0, 0.0), 0.5);
    }
    let mut lit = scene.clone();
    lit.lights.clear();
    lit.add_point_light(dvec3(0.0, 5.0, 0.0), 0.7);
    let expected = trace(&lit, (16, 12)).image;
    scene.add_point_light(dvec3(0.0, 5.0, 0.0), 0.7);
    assert_none([right_or_refused(
        "last lamp",
        &scene,
        &sized(16, 12),
        &expected,
    )]);
}

/// Area lights with this many samples each, over a floor.
fn under_area_lamps(count: usize, samples: u32) -> Scene {
    let mut scene = under_lamps(count);
    for light in &mut scene.lights {
        let LightKind::Point { position } = light.kind else {
            continue;
        };
        light.kind = LightKind::Disc {
            center: position,
            normal: DVec3::NEG_Y,
            radius: 0.5,
        };
        light.samples = samples;
    }
    scene
}

#[test]
fn more_shadow_rays_from_a_point_than_a_submission_should_take_are_refused_before_any_is_sent() {
    let scene = under_area_lamps(300, 65_536);
    let with = |light_samples| RenderSettings {
        light_samples,
        ..sized(8, 8)
    };
    let error = start(&scene, &with(1.0))
        .map(|_| ())
        .expect_err("a refusal");
    let error = AppError::from(error);
    assert_eq!(error.exit_code(), 7);
    let text = error.to_string();
    for part in [
        "300 lights",
        "19660800",
        "65536",
        "--light-samples",
        "--samples",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // One light at the limit of the formats, few samples, and integrators without lights.
    assert!(start(&under_area_lamps(1, 65_536), &with(1.0)).is_ok());
    assert!(start(&scene, &with(1e-3)).is_ok());
    let normals = RenderSettings {
        integrator: Integrator::Normals,
        ..with(1.0)
    };
    assert!(start(&scene, &normals).is_ok());
    // An unfinished picture is restarted.
    let mut renderer = start(&scene, &with(1e-3)).expect("a renderer");
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    assert!(
        renderer
            .restart(packed, &view, with(1.0), ExecutionPolicy::default())
            .is_err()
    );
}

#[test]
fn the_first_submission_is_one_workgroup_if_points_take_thousands_of_shadow_rays() {
    let groups = match open_gpu().is_cpu() {
        true => 32.0,
        false => 8.0,
    };
    for (samples, tiles) in [(1, groups), (2048, 1.0)] {
        let scene = under_area_lamps(1, samples);
        let mut renderer = start(&scene, &sized(64, 64)).expect("a renderer");
        renderer.step().expect("a step");
        assert_eq!(renderer.progress(), tiles / 64.0, "{samples} samples");
    }
}

#[test]
fn the_message_of_the_loop_limit_names_what_is_too_much() {
    let mut mirrors = scenes::spheres();
    mirrors.materials[0].classical_mut().reflect = Vec3::splat(0.99);
    let deep = RenderSettings {
        max_depth: 1000,
        ..sized(8, 8)
    };
    let brute = RenderSettings {
        brute_force: true,
        ..sized(8, 8)
    };
    let rows = [
        (
            under_lamps(20_000),
            sized(8, 8),
            "(20000 lights, 20000 shadow rays from each point)",
            "fewer lights",
        ),
        (
            under_area_lamps(2, 10_000),
            sized(8, 8),
            "(2 lights, 20000 shadow rays from each point)",
            "--light-samples",
        ),
        (mirrors, deep, "(up to 1000 bounces)", "--max-depth"),
        (
            layers(0..5000),
            brute,
            "(every ray tests 5000 primitives)",
            "--no-bvh",
        ),
        (
            layers(0..5000),
            sized(8, 8),
            "(very many surfaces in one place",
            "duplicate",
        ),
    ];
    for (scene, settings, cause, remedy) in rows {
        let packed = pack::scene(&scene).expect("packed");
        let view = packed.frame(&scene.frame(0.0)).expect("a frame");
        let error = RenderError::PathTooLong(LongPath::of(&packed, &view, &settings));
        let text = AppError::from(error).to_string();
        assert!(text.contains(cause) && text.contains(remedy), "{text}");
    }
}

#[test]
fn more_coincident_triangles_than_the_drivers_loop_limit_are_refused_as_such() {
    let scene = |count| {
        let mut mesh = Mesh {
            positions: vec![
                vec3(-9.0, -9.0, 0.0),
                vec3(9.0, -9.0, 0.0),
                vec3(0.0, 9.0, 0.0),
            ],
            triangles: vec![[0, 1, 2]; count],
            materials: vec![0; 3],
            ..Mesh::default()
        };
        mesh.repair();
        let mut scene = scenes::empty();
        scene.add_mesh(mesh, DAffine3::IDENTITY);
        scene
    };
    check_too_long(&scene(140_000), &scene(1), false, LongPath::Crowded);
}

/// Checks that distances are refused for this reason, or are those of a scene that looks the same. Mesa limits the rounds of
/// loops up to version 22.3, and no longer in 25.0.
fn check_too_long(scene: &Scene, alike: &Scene, brute_force: bool, expected: LongPath) {
    let settings = RenderSettings {
        brute_force,
        integrator: Integrator::Depth,
        ..sized(8, 8)
    };
    match try_render(scene, &settings) {
        Err(RenderError::PathTooLong(cause)) => assert_eq!(cause, expected),
        Err(error) => panic!("{error}"),
        Ok((found, _)) => {
            let (right, _) = render(alike, &settings);
            check_same_bits("distances", &right, &found).expect("the driver's limit was noticed");
            skip(
                Need::LoopLimit,
                "this adapter does not limit the rounds of loops",
            );
        }
    }
}

/// Triangles in layers, the last one in front.
fn layers(places: Range<u32>) -> Scene {
    let mut mesh = Mesh::default();
    for i in places {
        let z = i as f32 / 131_072.0;
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend([vec3(-9.0, -9.0, z), vec3(9.0, -9.0, z), vec3(0.0, 9.0, z)]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh.materials = vec![0; mesh.positions.len()];
    mesh.repair();
    let mut scene = scenes::empty();
    scene.cameras[0] = Camera {
        look_from: DVec3::Z * 6.0,
        ..Camera::default()
    };
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

/// A window draws with its own device, and could not use a picture on another one.
#[test]
fn a_device_that_is_shared_is_never_replaced() {
    let scene = scenes::everything();
    let packed = Arc::new(pack::scene(&scene).expect("packed"));
    let view = packed.frame(&scene.frame(0.0)).expect("a view");
    let renderer = |host_copy| {
        let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
        gpu.lose();
        let policy = ExecutionPolicy {
            host_copy,
            ..ExecutionPolicy::default()
        };
        Renderer::new(gpu, packed.clone(), &view, sized(16, 12), policy)
    };
    let shared = renderer(false).map(drop);
    assert!(
        matches!(shared, Err(RenderError::Gpu(GpuError::Lost))),
        "{shared:?}"
    );
    let own = renderer(true).expect("another device");
    assert_eq!(own.stats().device_losses, 1);
}

#[test]
fn brute_force_over_more_triangles_than_the_drivers_loop_limit_is_refused() {
    let expected = LongPath::BruteForce { primitives: 70_000 };
    let front = layers(69_999..70_000);
    check_too_long(&layers(0..70_000), &front, true, expected);
}

#[test]
fn brute_force_below_the_loop_limit_is_right() {
    let rows = [30_000, 59_000, 64_000].map(|count| (count, layers(0..count)));
    let depth = |scene: &Scene, brute_force| {
        let settings = RenderSettings {
            brute_force,
            integrator: Integrator::Depth,
            ..sized(8, 8)
        };
        try_render(scene, &settings)
    };
    assert_none(rows.map(|(count, scene)| match depth(&scene, true) {
        Ok((image, _)) => {
            let (expected, _) = depth(&scene, false).expect("through the tree");
            check_same_bits(&format!("{count} layers"), &expected, &image)
        }
        Err(RenderError::PathTooLong(_)) => Ok(()),
        Err(error) => Err(format!("{count} layers: {error}")),
    }));
}

fn limited(settings: RenderSettings, memory_limit_bytes: u64) -> (RenderSettings, ExecutionPolicy) {
    let policy = ExecutionPolicy {
        memory_limit_bytes,
        ..ExecutionPolicy::default()
    };
    (settings, policy)
}

#[test]
fn more_memory_than_allowed_is_refused_with_the_numbers() {
    let settings = limited(sized(4096, 4096), 1_000_000);
    let error = try_render(&scenes::spheres(), &settings)
        .map(|_| ())
        .expect_err("a refusal");
    let RenderError::Gpu(GpuError::Budget { need, limit, .. }) = &error else {
        panic!("{error}");
    };
    assert_eq!(*limit, 1_000_000);
    assert!(*need > 4096 * 4096 * 16, "{need}");
    let text = error.to_string();
    let needed = format!("{:.1} MiB needed in all", *need as f64 / f64::from(1 << 20));
    // 10⁶ / 1024.
    let allowed = "976.6 KiB allowed";
    assert!(text.contains(&needed) && text.contains(allowed), "{text}");
    assert_eq!(AppError::from(error).exit_code(), 7);
}

#[test]
fn a_picture_within_the_memory_limit_renders_and_reports_what_it_takes() {
    let (_, stats) = render(&scenes::spheres(), &sized(32, 32));
    let within = |limit| try_render(&scenes::spheres(), &limited(sized(32, 32), limit));
    assert!(within(stats.gpu_bytes).is_ok());
    assert!(within(stats.gpu_bytes - 1).is_err());
}

/// A wall in the right half of the picture under two lights of this strength.
fn wall_under(color: f32) -> Scene {
    let mut scene = scenes::empty();
    scene.cameras[0] = Camera {
        look_from: DVec3::Z * 5.0,
        ..Camera::default()
    };
    scene.materials[0] = Material::from(Phong {
        diffuse: Vec3::ONE,
        ..Phong::default()
    });
    let upright = DAffine3::from_rotation_x(std::f64::consts::FRAC_PI_2);
    scene.add_mesh(
        scenes::quad(40.0, 0),
        DAffine3::from_translation(DVec3::X * 20.0) * upright,
    );
    for _ in 0..2 {
        scene.lights.push(Light {
            kind: LightKind::Directional {
                direction: DVec3::NEG_Z,
            },
            color: Vec3::splat(color),
            attenuation: Attenuation::None,
            ..Light::default()
        });
    }
    scene
}

fn is_finite(image: &Image) -> bool {
    image.pixels.iter().flatten().all(|c| c.is_finite())
}

/// Not finite, or beyond 2^40.
#[test]
fn samples_that_are_no_light_are_dropped_and_counted() {
    for integrator in [Integrator::Whitted, Integrator::Path] {
        for intensity in [f32::MAX, 1.2e12] {
            let settings = RenderSettings {
                samples: 3,
                integrator,
                ..sized(32, 16)
            };
            check_dropped_samples(intensity, &settings);
        }
    }
}

fn check_dropped_samples(intensity: f32, settings: &RenderSettings) {
    let (image, stats) = render(&wall_under(intensity), settings);
    assert_eq!(
        stats.nonfinite_samples,
        3 * 16 * 16,
        "those of the right half"
    );
    assert!(is_finite(&image));
    assert_eq!(
        image.pixel(31, 8),
        Some([0.0, 0.0, 0.0, 1.0]),
        "no sample is left"
    );
    assert_eq!(
        image.pixel(0, 8),
        Some([0.2, 0.4, 0.6, 1.0]),
        "the background is as it was"
    );
    let (_, stats) = render(&wall_under(0.4), settings);
    assert_eq!(
        stats,
        Stats {
            nonfinite_samples: 0,
            ..stats.clone()
        }
    );
}

#[test]
fn sums_of_samples_near_the_end_of_the_range_are_kept() {
    // Each sample is below 2^40, the sum of three is not.
    let settings = RenderSettings {
        samples: 3,
        ..sized(32, 16)
    };
    let (image, stats) = render(&wall_under(5e11), &settings);
    assert_eq!(stats.nonfinite_samples, 0);
    let [red, ..] = image.pixel(31, 8).expect("a pixel");
    assert!((red / 1e12 - 1.0).abs() < 1e-5, "{red}");
}

#[test]
fn very_bright_pixels_develop_to_finite_values_under_every_curve() {
    let mut renderer = start(&wall_under(5e11), &sized(16, 8)).expect("a renderer");
    finish(&mut renderer);
    assert_none(
        [
            ToneCurve::None,
            ToneCurve::Aces,
            ToneCurve::Agx,
            ToneCurve::Reinhard,
            ToneCurve::Neutral,
        ]
        .map(|curve| {
            let tone = Tone {
                exposure_ev: 4.0,
                curve,
                transfer: Transfer::Srgb,
                ..Tone::LINEAR
            };
            let image = renderer.develop(&tone).expect("a picture");
            let [r, g, b, _] = image.pixel(15, 4).expect("a pixel");
            let bright = is_finite(&image) && [r, g, b].iter().all(|c| *c > 0.5);
            bright
                .then_some(())
                .ok_or(format!("{curve:?}: {:?}", image.pixel(15, 4)))
        }),
    );
}
