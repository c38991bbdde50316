//! Automatic exposure: the log-average of a picture becomes a medium grey (Reinhard et al. 2002).

use crate::reference::compare::{open_gpu, sized, start};
use crate::reference::scenes;
use glimray::image::{Image, ScreenImage};
use glimray::render::{Antialias, RenderSettings, Slicing, Tone};
use glimray::scene::Transfer;

const AUTO: Tone = Tone {
    auto_exposure: true,
    ..Tone::LINEAR
};

/// The developed levels of these grey pixels in one row.
fn exposed(tone: &Tone, greys: &[f32]) -> Vec<f32> {
    let image = Image {
        width: greys.len() as u32,
        height: 1,
        pixels: greys.iter().map(|&l| [l, l, l, 1.0]).collect(),
    };
    let image = tone.develop(&open_gpu(), &image).expect("a picture");
    image.pixels.iter().map(|pixel| pixel[1]).collect()
}

/// Exposures are found to a 64th of a stop.
#[track_caller]
fn near(found: f32, expected: f32) {
    let stops = (found / expected).log2().abs();
    assert!(stops < 1.0 / 64.0, "{found}, expected {expected}");
}

#[test]
fn an_even_picture_becomes_a_medium_grey() {
    for grey in [1e-6, 0.02, 0.18, 1.0, 3e4] {
        near(exposed(&AUTO, &[grey; 40])[0], 0.18);
    }
    let brighter = Tone {
        exposure_ev: 1.0,
        ..AUTO
    };
    near(exposed(&brighter, &[5.0; 40])[0], 0.36);
}

#[test]
fn the_average_is_that_of_the_logarithm() {
    // 1 is 2^0 and 16 is 2^4: their average is 2^2.
    let halves: Vec<f32> = [1.0_f32; 32].into_iter().chain([16.0; 32]).collect();
    let found = exposed(&AUTO, &halves);
    near(found[0], 0.18 / 4.0);
    near(found[63], 0.18 * 4.0);
}

#[test]
fn black_pixels_and_a_few_bright_ones_do_not_count() {
    let mut pixels = vec![0.5_f32; 100];
    pixels[..3].fill(1e9);
    pixels[10..50].fill(0.0);
    near(exposed(&AUTO, &pixels)[99], 0.18);
    assert_eq!(exposed(&AUTO, &[0.0; 9]), [0.0; 9], "a black picture");
}

#[test]
fn films_and_pictures_in_any_tiles_have_the_same_exposure() {
    let scene = scenes::spheres();
    let settings = RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        ..sized(50, 40)
    };
    let mut whole = None;
    for tile_side in [16, 1024] {
        let slicing = Slicing {
            tile_side,
            ..Slicing::default()
        };
        let wanted = crate::reference::compare::sliced(&settings, slicing);
        let mut renderer = start(&scene, &wanted).expect("a renderer");
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        let picture = renderer.develop(&AUTO).expect("a picture");
        let film = renderer.film().expect("a film");
        let developed = film.develop(&open_gpu(), &AUTO).expect("a picture");
        assert_eq!(picture, developed, "the film, tiles of {tile_side}");
        let first = whole.get_or_insert(picture.clone());
        assert_eq!(*first, picture, "tiles of {tile_side}");
    }
}

#[test]
fn a_screen_shows_a_denoised_picture_with_the_exposure_of_the_file() {
    let settings = RenderSettings {
        samples: 4,
        antialias: Antialias::Stratified,
        features: true,
        ..sized(50, 40)
    };
    let tone = Tone {
        denoise: true,
        transfer: Transfer::Srgb,
        ..AUTO
    };
    let mut renderer = start(&scenes::everything(), &settings).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let screen = renderer.new_screen().expect("a screen");
    renderer.show(&tone, &screen).expect("shown");
    let shown = screen.read(renderer.gpu()).expect("pixels");
    let file = renderer.develop(&tone).expect("a picture");
    assert_eq!(shown, ScreenImage::from(&file));
}
