//! The scene of `glimray demo`.

use glimray::scene::LightTransport;

/// The demo's version has the same objects, and nothing that needs many samples.
#[test]
fn the_demo_is_the_showcase_for_few_paths() {
    let scene = glimray_app::showcase::scene().expect("the showcase");
    let demo = glimray_app::showcase::path_traced().expect("the demo");
    let shapes = demo.shapes.iter().zip(&scene.shapes);
    assert_eq!(demo.shapes.len(), scene.shapes.len());
    assert!(shapes.clone().all(|(a, b)| a.geometry == b.geometry));
    assert_eq!(demo.output.integrator, LightTransport::Path);
    assert!(demo.cameras[0].lens.is_none());
    let features = glimray::pack::scene(&demo).expect("packed").features;
    assert!(features.reflection && !features.refraction);
}
