//! Rays and pictures of scenes of the Standard Procedural Database.

use crate::reference::compare::{check_alike, counting, differing, render, sized};
use crate::reference::count::{self, Inwards};
use crate::reference::spd;
use crate::support::verdict::Verdict;
use glimray::render::RenderSettings;
use glimray::scene::Scene;

/// Rays through the corners of the pixels of a picture of 512×512 are those through the centres of one of
/// 513×513 whose edges lie half a pixel farther out. In SPD's own count all of them hit.
#[test]
fn every_ray_through_a_corner_of_a_pixel_of_balls_hits() {
    let Some((mut scene, _)) = spd::load("balls.nff") else {
        return;
    };
    let camera = &mut scene.cameras[0];
    camera.fov_y = 2.0 * ((camera.fov_y / 2.0).tan() * 513.0 / 512.0).atan();
    let settings = RenderSettings {
        max_depth: 0,
        ..sized(513, 513)
    };
    let (_, stats) = render(&scene, &counting(&settings));
    let rays = stats.rays.expect("counts");
    assert_eq!((rays.primary, rays.primary_hits), (263_169, 263_169));
}

/// Prints two counts, which should differ by less than this many per cent.
fn check(verdict: &mut Verdict, name: &str, kind: &str, got: u64, expected: u64, most: f64) {
    let percent = 100.0 * (got as f64 - expected as f64) / expected.max(1) as f64;
    println!("{name} | {kind} | {got} | {expected} | {percent:+.3} %");
    verdict.that(format!("{name}, {kind}"), percent.abs() < most, || {
        format!("{got} for {expected}, {percent:+.2} %")
    });
}

/// Compares with the tracer in f64. A ray that grazes an edge or the border of a shadow may fall to either
/// side, so counts agree approximately and not in every ray. The same holds for pictures: round mirrors amplify
/// rounding errors with every bounce. The effect on a picture is estimated by moving the eye of the tracer by a
/// few f32 roundings.
#[test]
fn rays_and_pictures_are_those_of_a_tracer_in_f64() {
    let files = spd::files();
    if files.is_empty() {
        return;
    }
    let mut verdict = Verdict::on("rays");
    for name in files {
        let (mut scene, _) = spd::load(&name).expect("a file that was just listed");
        let depth = scene.output.max_depth;
        let trace = |scene: &Scene| count::trace(scene, (256, 256), depth, Inwards::Turned);
        let (image, stats) = render(&scene, &counting(&sized(256, 256)));
        assert_eq!(stats.cut_off_trees, 0, "{name}");
        let (picture, expected) = trace(&scene);
        let got = stats.rays.expect("counts");
        for (kind, got, expected) in [
            ("primary", got.primary, expected.primary),
            ("primary hits", got.primary_hits, expected.primary_hits),
            ("shadow", got.shadow, expected.shadow),
            (
                "shadow blocked",
                got.shadow_blocked,
                expected.shadow_blocked,
            ),
            ("reflection", got.reflection, expected.reflection),
            (
                "reflection hits",
                got.reflection_hits,
                expected.reflection_hits,
            ),
            ("refraction", got.refraction, expected.refraction),
            (
                "refraction hits",
                got.refraction_hits,
                expected.refraction_hits,
            ),
        ] {
            check(&mut verdict, &name, kind, got, expected, 1.0);
        }
        scene.cameras[scene.camera_index].look_from *= 1.0 + 1e-6;
        let fickle = differing(&picture, &trace(&scene).0, 1.0);
        let most = fickle as f64 / f64::from(256 * 256) + 1e-3;
        println!(
            "{name} | pixels that differ | {} | {fickle} where the eye moves",
            differing(&picture, &image, 1.0)
        );
        let check = check_alike(&name, &picture, &image, 1.0, most);
        verdict.that(format!("{name}, picture"), check.is_ok(), || {
            check.clone().err().unwrap_or_default()
        });
    }
    verdict.close();
}

/// POV-Ray 3.7.0 without antialiasing, for the same scenes in its own format at 512×512, counts these reflected
/// rays with `max_trace_level 5` and these shadow rays, in total and blocked, with 6: it counts one level of
/// reflected rays that it does not trace. In `teapot` interpolated normals reflect rays into a surface, from
/// where they return as a few additional rays.
#[test]
fn balls_and_teapot_take_as_many_rays_as_in_pov_ray() {
    let (Some((balls, _)), Some((teapot, _))) = (spd::load("balls.nff"), spd::load("teapot.nff"))
    else {
        return;
    };
    let mut verdict = Verdict::on("rays");
    for (name, scene, shadow, blocked, reflection) in [
        ("balls.nff", balls, 966_462, 294_219, 186_818),
        ("teapot.nff", teapot, 408_253, 42_792, 228_365),
    ] {
        let (_, stats) = render(&scene, &counting(&sized(512, 512)));
        let rays = stats.rays.expect("counts");
        for (kind, got, expected) in [
            ("shadow", rays.shadow, shadow),
            ("shadow blocked", rays.shadow_blocked, blocked),
            ("reflection", rays.reflection, reflection),
        ] {
            check(&mut verdict, name, kind, got, expected, 2.0);
        }
    }
    verdict.close();
}
