//! The layers of a picture in the window, and what they look like.

use crate::harness::Window;
use crate::reference::compare::open_gpu;
use eframe::egui::{Key, Modifiers};
use glimray::image::ScreenImage;
use glimray::render::{Features, PixelFeatures, Tone};
use glimray_app::layer_picture::picture;
use glimray_app::layers::{LAYERS, PictureLayer};

#[test]
fn keys_step_through_the_layers_of_the_running_picture() {
    let mut window = Window::open(&["--size=32x24", "--samples=2", "--integrator=path"]);
    window.settle();
    let gpu = window.gpu.clone();
    let screen = |window: &Window| {
        window
            .shown()
            .screen
            .expect("a screen")
            .read(&gpu)
            .expect("pixels")
    };
    let beauty = screen(&window);
    for (name, _, layer) in &LAYERS.0[1..] {
        window
            .harness
            .key_press_modifiers(Modifiers::SHIFT, Key::PageDown);
        window.settle();
        assert_eq!(window.session().view.layer, *layer);
        let features = {
            let tone = window.session().view.tone;
            let (sender, receiver) = std::sync::mpsc::channel();
            window.session.borrow_mut().ask(move |frame| {
                sender
                    .send(frame.renderer.features().expect("features"))
                    .expect("someone who waits");
                glimray_viewer::state::answer::Answer::Nothing
            });
            window.settle();
            (receiver.recv().expect("features"), tone)
        };
        let expected = picture(*layer, &features.0, &features.1, &gpu).expect("a picture");
        assert_eq!(screen(&window), ScreenImage::from(&expected), "{name}");
    }
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::PageDown);
    window.settle();
    assert_eq!(window.session().view.layer, PictureLayer::Beauty);
    assert_eq!(screen(&window), beauty);
    window
        .harness
        .key_press_modifiers(Modifiers::SHIFT, Key::PageUp);
    window.settle();
    assert_eq!(window.session().view.layer, PictureLayer::Samples);
}

#[test]
fn false_colors_tell_numbers_apart_and_leave_nothing_black() {
    let pixel = |number: u32| PixelFeatures {
        object: number,
        material: number,
        depth: number as f32,
        variance: number as f32,
        samples: 4.0,
        normal: [0.0, 0.0, if number == 0 { 0.0 } else { -1.0 }],
        position: [number as f32, 1.0, -(number as f32)],
        uv: [-0.25, 1.5],
        ..PixelFeatures::default()
    };
    let features = Features {
        width: 5,
        height: 1,
        pixels: [0, 1, 2, 4, 16].map(pixel).into(),
    };
    let gpu = open_gpu();
    let of = |layer| {
        let image = picture(layer, &features, &Tone::LINEAR, &gpu).expect("a picture");
        let pixels = image.pixels.iter();
        pixels.map(|&[r, g, b, _]| [r, g, b]).collect::<Vec<_>>()
    };
    for layer in [PictureLayer::Object, PictureLayer::Material] {
        let colors = of(layer);
        assert_eq!(colors[0], [0.0; 3]);
        for (index, color) in colors.iter().enumerate() {
            let is_far = |other: &[f32; 3]| (0..3).any(|c| (color[c] - other[c]).abs() > 0.1);
            assert!(colors[..index].iter().all(is_far), "{colors:?}");
        }
    }
    // Evenly spaced logarithms: log₂ 1, 2, 4 and 16 of log₂ 16.
    let greys = [0.0, 1.0, 0.775, 0.55, 0.1];
    let depths = of(PictureLayer::Depth);
    for (found, grey) in depths.iter().zip(greys) {
        assert!((found[0] - grey).abs() < 1e-5, "{depths:?}");
    }
    let normals = of(PictureLayer::Normal);
    assert_eq!((normals[0], normals[1]), ([0.0; 3], [0.5, 0.5, 0.0]));
    assert_eq!(of(PictureLayer::Uv)[1], [0.75, 0.5, 0.0]);
    assert_eq!(of(PictureLayer::Position)[4], [1.0, 0.0, 0.0]);
    let variances = of(PictureLayer::Variance);
    assert_eq!((variances[0], variances[4]), ([0.0; 3], [1.0; 3]));
    assert_eq!(of(PictureLayer::Samples)[2], [1.0; 3]);
}
