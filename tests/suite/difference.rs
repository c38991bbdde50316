//! The difference of two images.

use glimray::image::{Difference, Image, Placed, ScreenImage};

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
