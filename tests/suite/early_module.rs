//! Modules that are made while the device is being opened.

use crate::reference::compare::{assert_none, check_same_bits, render_on, sized};
use crate::reference::scenes;
use glimray::gpu::{AdapterChoice, Gpu};
use glimray::image::Image;
use glimray::pack;
use glimray::render::{Antialias, ExecutionPolicy, Integrator, RenderSettings, early_module};
use glimray::scene::Scene;
use std::sync::Arc;

/// A picture by a device of its own, for which the module of `foreseen` was made, and whether that is left.
fn rendered(
    scene: &Scene,
    settings: &RenderSettings,
    foreseen: Option<&RenderSettings>,
) -> (Image, bool) {
    let policy = ExecutionPolicy::default();
    let packed = Arc::new(pack::scene(scene).expect("a packed scene"));
    let view = packed.frame(&scene.frame(0.0)).expect("a packed frame");
    let module = foreseen.map(|foreseen| {
        early_module(&packed, &view, foreseen, &policy).expect("a kernel that is not for packets")
    });
    let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
    let gpu = gpu.with_early_module(module);
    let (image, _) = render_on(gpu.clone(), scene, &(settings.clone(), policy));
    (image, gpu.has_early_module())
}

#[test]
fn a_module_is_used_if_it_is_the_one_that_the_picture_needs() {
    let whitted = sized(48, 32);
    let paths = RenderSettings {
        integrator: Integrator::Path,
        ..sized(48, 32)
    };
    let antialiased = RenderSettings {
        antialias: Antialias::Stratified,
        ..sized(48, 32)
    };
    let gpu = Gpu::new(&AdapterChoice::default()).expect("a device");
    let is_lavapipe = gpu.is_cpu() && gpu.adapter().backend == "vulkan";
    let check = |name: &str, scene: Scene, settings: &RenderSettings, foreseen, is_needed: bool| {
        let (expected, _) = rendered(&scene, settings, None);
        let (actual, is_left) = rendered(&scene, settings, Some(foreseen));
        if is_left == (is_lavapipe && is_needed) {
            return Err(format!("{name}: the module is left: {is_left}"));
        }
        check_same_bits(name, &expected, &actual)
    };
    assert_none([
        check("spheres", scenes::spheres(), &whitted, &whitted, true),
        check("meshes", scenes::meshes(), &whitted, &whitted, true),
        check("everything", scenes::everything(), &whitted, &whitted, true),
        check("paths", scenes::everything(), &paths, &paths, true),
        check(
            "other samples",
            scenes::spheres(),
            &whitted,
            &antialiased,
            false,
        ),
        check(
            "other integrator",
            scenes::spheres(),
            &paths,
            &whitted,
            false,
        ),
    ]);
}
