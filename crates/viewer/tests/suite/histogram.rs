//! The histogram of the window.

use glimray::image::{Image, ScreenImage};
use glimray_viewer::model::histogram::{Histogram, LEVELS};

#[test]
fn a_ramp_has_one_pixel_at_each_level() {
    let ramp: Vec<_> = (0..=255).map(|level| [level, level, level, 255]).collect();
    let histogram = Histogram::new(&ramp);
    assert_eq!(histogram.channels, [[1; LEVELS]; 4]);
    assert_eq!(histogram.clipped(), [1.0 / 256.0; 2]);
    assert!((histogram.mean_luminance() - 0.5).abs() < 1e-12);
    assert_eq!(histogram.heights(false), [[1.0; LEVELS]; 4]);
}

#[test]
fn a_constant_is_one_bar_of_each_channel() {
    let histogram = Histogram::new(&[[10, 100, 200, 255]; 50]);
    // 0.2126 × 10 + 0.7152 × 100 + 0.0722 × 200 is 88.1.
    for (channel, level) in histogram.channels.iter().zip([10, 100, 200, 88]) {
        let expected: Vec<_> = (0..LEVELS).map(|n| 50 * u32::from(n == level)).collect();
        assert_eq!(channel.as_slice(), expected);
    }
    assert_eq!(histogram.clipped(), [0.0; 2]);
}

#[test]
fn black_is_clipped_in_all_channels_and_white_in_one() {
    let pixels = [[0, 0, 0, 255], [0, 0, 1, 255], [255, 0, 3, 255], [255; 4]];
    assert_eq!(Histogram::new(&pixels).clipped(), [0.25, 0.5]);
}

#[test]
fn overflow_is_white_nan_is_black_and_transparent_pixels_are_left_out() {
    let image = Image {
        width: 4,
        height: 1,
        pixels: vec![
            [f32::INFINITY, 1e30, 2.0, 1.0],
            [f32::NAN, f32::NAN, -1.0, 1.0],
            [0.5, 0.5, 0.5, 1.0],
            [0.0; 4],
        ],
    };
    let histogram = Histogram::new(&ScreenImage::from(&image).pixels);
    assert_eq!(histogram.pixels, 3);
    assert_eq!((histogram.black, histogram.white), (1, 1));
}

#[test]
fn heights_are_relative_to_the_fullest_bar_that_is_not_clipped() {
    let pixels = [([0; 3], 1000), ([50; 3], 5), ([100; 3], 10)];
    let pixels: Vec<_> = (pixels.iter())
        .flat_map(|([r, g, b], count)| vec![[*r, *g, *b, 255]; *count])
        .collect();
    let histogram = Histogram::new(&pixels);
    let [red, ..] = histogram.heights(false);
    assert_eq!([red[0], red[50], red[100], red[200]], [1.0, 0.5, 1.0, 0.0]);
    let [red, ..] = histogram.heights(true);
    let expected = (6_f64.ln() / 11_f64.ln()) as f32;
    assert_eq!(
        [red[0], red[50], red[100], red[200]],
        [1.0, expected, 1.0, 0.0]
    );
    let empty = Histogram::new(&[]);
    assert_eq!(empty.heights(true), [[0.0; LEVELS]; 4]);
    assert_eq!((empty.clipped(), empty.mean_luminance()), ([0.0; 2], 0.0));
}
