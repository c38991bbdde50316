//! The exercise alone: the picture of the classical ray tracer, by a kernel without trees, features or packets; scenes with
//! more are refused.

use crate::reference::compare::{assert_none, check_alike, render, sized, try_render};
use crate::support::program::Workspace;
use glam::Vec3;
use glimray::import;
use glimray::render::{Integrator, RenderError, RenderSettings, TriangleTest};
use glimray::scene::{Antialias, Scene};
use std::path::Path;

fn course(name: &str) -> Scene {
    import::load(&Path::new("assets/scenes").join(name)).expect("a scene")
}

fn settings(integrator: Integrator) -> RenderSettings {
    RenderSettings {
        integrator,
        max_depth: 0,
        ..sized(96, 72)
    }
}

#[test]
fn course_scenes_look_as_by_the_classical_integrator() {
    let mut results = Vec::new();
    for name in [
        "sphere.scene",
        "spheres_and_triangles.scene",
        "terrain.scene",
    ] {
        let scene = course(name);
        for (test, antialias, samples) in [
            (TriangleTest::Watertight, Antialias::None, 1),
            (TriangleTest::Plane, Antialias::None, 1),
            (TriangleTest::MollerTrumbore, Antialias::Stratified, 4),
        ] {
            let [lecture, whitted] = [Integrator::Lecture, Integrator::Whitted].map(|integrator| {
                let settings = RenderSettings {
                    triangle_test: test,
                    antialias,
                    samples,
                    ..settings(integrator)
                };
                render(&scene, &settings).0
            });
            let shown = lecture.pixels.iter().filter(|pixel| pixel[0] > 0.0).count();
            assert!(shown > 500, "{name}: {shown} pixels show something");
            let name = format!("lecture {name} {test:?}");
            // Rays that graze an edge or a light may go either way: the kernels round differently.
            results.push(check_alike(&name, &whitted, &lecture, 0.5, 1e-3));
        }
    }
    assert_none(results);
}

#[test]
fn scenes_with_more_than_the_exercise_are_refused_by_the_names_of_the_parts() {
    let glowing = {
        let mut scene = course("sphere.scene");
        scene.materials[0].emission = Vec3::ONE;
        scene
    };
    let mirror = {
        let mut scene = course("sphere.scene");
        scene.materials[0].classical_mut().reflect = Vec3::splat(0.5);
        scene
    };
    for (scene, depth, parts) in [
        (course("shapes.toml"), 0, "planes"),
        (course("solids.toml"), 0, "shapes other than spheres"),
        (course("soft_shadows.toml"), 0, "lights with area"),
        (course("patterns.toml"), 0, "textures"),
        (glowing, 0, "emissive surfaces"),
        (mirror.clone(), 1, "reflection or refraction"),
        (course("orbits.toml"), 0, "instances"),
    ] {
        let settings = RenderSettings {
            max_depth: depth,
            ..settings(Integrator::Lecture)
        };
        match try_render(&scene, &settings) {
            Err(RenderError::BeyondLecture { parts: found }) => {
                assert!(found.contains(parts), "{found} lacks {parts}");
            }
            other => panic!("{parts}: {:?}", other.map(|(_, stats)| stats)),
        }
    }
    // At depth 0 the classical integrator does not follow them either.
    try_render(&mirror, &settings(Integrator::Lecture)).expect("a picture");
}

#[test]
fn the_program_renders_and_refuses_it() {
    let workspace = Workspace::new();
    workspace
        .run("render a.scene --integrator lecture --size 32x24 -o a.png")
        .expect(0);
    workspace.write(
        "b.toml",
        "[[objects]]\nplane = { point = [0, -1, 0], normal = [0, 1, 0] }\n",
    );
    let run = workspace
        .run("render b.toml --integrator lecture --size 32x24 -o b.png")
        .expect(3);
    run.says(
        "cannot render the scene as the exercise alone: it has planes. Use --integrator whitted.",
    );
    let run = workspace
        .run("render a.scene --integrator lecture --layers depth -o a.exr")
        .expect(2);
    run.says("cannot render layers (--integrator lecture): it has none. Choose whitted or path.");
}
