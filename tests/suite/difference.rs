//! The difference of two images.

use glimray::image::{Difference, Errors, Image, Placed, ScreenImage};

const WHOLE: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

fn image(width: u32, levels: &[[u8; 3]]) -> ScreenImage {
    ScreenImage {
        width,
        height: levels.len() as u32 / width,
        pixels: levels.iter().map(|&[r, g, b]| [r, g, b, 255]).collect(),
    }
}

fn greys(levels: &[u8]) -> ScreenImage {
    let levels: Vec<_> = levels.iter().map(|level| [*level; 3]).collect();
    image(levels.len() as u32, &levels)
}

/// An image that covers the whole picture.
fn placed(image: &ScreenImage) -> Placed<'_> {
    Placed {
        image,
        edges: WHOLE,
    }
}

fn difference(first: &ScreenImage, second: &ScreenImage, gain: f32) -> Difference {
    Difference::new(placed(first), placed(second), gain)
}

fn reds(difference: &Difference) -> Vec<u8> {
    let pixels = difference.image.pixels.iter();
    pixels.map(|pixel| pixel[0]).collect()
}

#[test]
fn an_image_does_not_differ_from_itself() {
    let levels: Vec<_> = (0..35 * 21_u32)
        .map(|n| [n * 7, n * 13, n * 29].map(|level| (level % 256) as u8))
        .collect();
    let picture = image(35, &levels);
    let found = difference(&picture, &picture, 100.0);
    assert_eq!((found.rmse, found.mean), (0.0, 0.0));
    assert_eq!(found.image, image(35, &[[0; 3]; 35 * 21]));
}

#[test]
fn constants_differ_by_their_distance() {
    let first = image(4, &[[200, 10, 60]; 12]);
    let second = image(4, &[[190, 50, 60]; 12]);
    for (gain, expected) in [
        (1.0, [10, 40, 0, 255]),
        (2.5, [25, 100, 0, 255]),
        (100.0, [255, 255, 0, 255]),
    ] {
        let found = difference(&first, &second, gain);
        assert!(found.image.pixels.iter().all(|pixel| *pixel == expected));
        let rmse = ((100.0 + 1600.0) / 3.0_f64).sqrt() / 255.0;
        assert!((found.rmse - rmse).abs() < 1e-12, "{}", found.rmse);
        assert!((found.mean - 50.0 / 3.0 / 255.0).abs() < 1e-12);
    }
}

#[test]
fn a_smaller_image_is_interpolated() {
    // Centres of 2 pixels lie at 1/4 and 3/4, those of 4 at 1/8, 3/8, 5/8 and 7/8.
    let found = difference(&greys(&[0; 4]), &greys(&[0, 100]), 1.0);
    assert_eq!(reds(&found), [0, 25, 75, 100]);
}

#[test]
fn pixels_without_a_counterpart_are_left_out() {
    let second = greys(&[50, 60]);
    let narrow = Placed {
        image: &second,
        edges: [0.25, 0.0, 0.75, 1.0],
    };
    let mut first = greys(&[10, 20, 30, 40]);
    let found = Difference::new(placed(&first), narrow, 1.0);
    assert_eq!(reds(&found), [0, 30, 30, 0]);
    assert!((found.mean - 30.0 / 255.0).abs() < 1e-12, "{}", found.mean);
    first.pixels[1][3] = 0;
    let found = Difference::new(placed(&first), narrow, 1.0);
    assert_eq!(reds(&found), [0, 0, 30, 0]);
    assert!((found.rmse - 30.0 / 255.0).abs() < 1e-12, "{}", found.rmse);
    let outside = Placed {
        edges: [1.0, 0.0, 2.0, 1.0],
        ..narrow
    };
    let found = Difference::new(placed(&first), outside, 1.0);
    assert_eq!((found.rmse, found.mean), (0.0, 0.0));
}

#[test]
fn values_beyond_the_screen_are_clamped_and_nan_is_black() {
    let image = Image {
        width: 2,
        height: 1,
        pixels: vec![[f32::NAN, f32::INFINITY, -3.0, 1.0], [1e30, 0.5, 1.0, 0.0]],
    };
    let expected = [[0, 255, 0, 255], [0; 4]];
    assert_eq!(ScreenImage::from(&image).pixels, expected);
}

/// A row of opaque linear colours.
fn linear(colors: &[[f32; 3]]) -> Image {
    Image {
        width: colors.len() as u32,
        height: 1,
        pixels: colors.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect(),
    }
}

#[test]
fn relative_errors_are_those_of_a_calculation_by_hand() {
    let first = linear(&[[0.5, 1.0, 0.0], [3.0, 3.0, 3.0]]);
    let second = linear(&[[0.25, 1.0, 0.1], [1.0, 2.0, 4.0]]);
    let whole = |image| Placed {
        image,
        edges: WHOLE,
    };
    // |0.5 − 0.25| / (0.25 + 0.01), 0, and 0.1 / (0.1 + 0.01); then 2 / 1.01, 1 / 2.01 and 1 / 4.01.
    let relative = [
        (0.25 / 0.26 + 0.1 / 0.11) / 3.0,
        (2.0 / 1.01 + 1.0 / 2.01 + 1.0 / 4.01) / 3.0,
    ];
    // 0.25² / (0.25² + 0.01), 0, and 0.1² / (0.1² + 0.01); then 4 / 1.01, 1 / 4.01 and 1 / 16.01.
    let squared = [
        (0.0625 / 0.0725 + 0.01 / 0.02) / 3.0,
        (4.0 / 1.01 + 1.0 / 4.01 + 1.0 / 16.01) / 3.0,
    ];
    for (found, expected) in [
        (Errors::relative(whole(&first), whole(&second)), relative),
        (
            Errors::relative_squared(whole(&first), whole(&second)),
            squared,
        ),
    ] {
        for (error, expected) in found.errors.iter().zip(expected) {
            let error = f64::from(error.expect("an error"));
            assert!((error - expected).abs() < 1e-6, "{error} for {expected}");
        }
        let mean = (expected[0] + expected[1]) / 2.0_f64;
        assert!((found.mean() - mean).abs() < 1e-6, "{}", found.mean());
    }
    let equal = Errors::relative(whole(&second), whole(&second));
    assert_eq!(equal.errors, [Some(0.0); 2]);
}

#[test]
fn pixels_that_are_not_opaque_have_no_error() {
    let mut first = linear(&[[1.0; 3], [2.0; 3]]);
    let second = linear(&[[4.0; 3], [1.0; 3]]);
    first.pixels[0][3] = 0.5;
    let place = |image| Placed {
        image,
        edges: WHOLE,
    };
    let found = Errors::relative_squared(place(&first), place(&second));
    assert_eq!(found.errors[0], None);
    assert!((found.mean() - 1.0 / 1.01).abs() < 1e-6, "{}", found.mean());
    let painted = found.painted(|error| [error * 100.0, 7.0, 300.0]);
    assert_eq!(painted.pixels, [[0, 0, 0, 255], [99, 7, 255, 255]]);
}
