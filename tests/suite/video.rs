//! Videos: independent decoders get the frames that were encoded.

mod faults;
mod gif;
mod mp4;
mod tools;
mod y4m;
mod yuv;

use glimray::output::OutputError;
use glimray::output::video::{self, FrameRate, Picture8, VideoFormat, VideoOptions};
use std::fs;
use std::path::Path;

/// An image with the colour that `colour` gives for each column and row.
fn picture(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 3]) -> Picture8 {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Picture8 {
        width,
        height,
        pixels: pixels.map(|(x, y)| colour(x, y)).collect(),
    }
}

/// A static gradient in the upper half, a moving disc over grey in the lower half.
fn scene(width: u32, height: u32, frame: usize) -> Picture8 {
    let (across, down) = (f64::from(width), f64::from(height));
    let centre = (0.2 * across + 0.02 * across * frame as f64, 0.75 * down);
    picture(width, height, |x, y| {
        let (x, y) = (f64::from(x), f64::from(y));
        if y < 0.5 * down {
            let level = |share: f64| (20.0 + 200.0 * share) as u8;
            return [level(x / across), level(2.0 * y / down), level(0.5)];
        }
        let distance = (x - centre.0).hypot(y - centre.1) / (0.2 * down);
        let light = (1.0 - distance.powi(2)).max(0.0).sqrt();
        let level = |grey: f64, own: f64| (grey + light * (own - grey)) as u8;
        [level(90.0, 230.0), level(90.0, 120.0), level(90.0, 40.0)]
    })
}

fn options(rate: FrameRate) -> VideoOptions {
    VideoOptions {
        rate,
        ..VideoOptions::default()
    }
}

/// The encoded video of these frames.
fn encoded(format: VideoFormat, options: &VideoOptions, frames: &[Picture8]) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("video");
    encode_to(&path, format, options, frames).expect("a video");
    fs::read(path).expect("a file")
}

fn encode_to(
    path: &Path,
    format: VideoFormat,
    options: &VideoOptions,
    frames: &[Picture8],
) -> Result<(), OutputError> {
    let mut fetch = |index: usize| Ok(frames[index].clone());
    video::encode(path, format, options, frames.len(), &mut fetch)
}

/// Peak signal to noise ratio of samples of 8 bits, in decibels.
fn psnr(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares: f64 = a
        .iter()
        .zip(b)
        .map(|(&a, &b)| f64::from(a.abs_diff(b)).powi(2))
        .sum();
    10.0 * (255.0_f64.powi(2) * a.len() as f64 / squares).log10()
}

#[test]
fn extensions_select_video_formats_in_either_case() {
    let format = |name: &str| VideoFormat::from_path(Path::new(name));
    assert_eq!(format("a.mp4"), Some(VideoFormat::Mp4));
    assert_eq!(format("x.y/a.GIF"), Some(VideoFormat::Gif));
    assert_eq!(format("a.b.y4m"), Some(VideoFormat::Y4m));
    assert_eq!(format("mp4"), None);
    assert_eq!(format("a.png"), None);
    for ending in VideoFormat::ENDINGS.split(", ") {
        assert!(format(&format!("a{ending}")).is_some(), "{ending}");
    }
}

#[test]
fn rates_are_the_fractions_that_are_meant() {
    for (rate, numerator, denominator) in [
        (24.0, 24, 1),
        (25.0, 25, 1),
        (23.976, 24000, 1001),
        (23.98, 24000, 1001),
        (29.97, 30000, 1001),
        (30.0, 30, 1),
        (59.94, 60000, 1001),
        (12.5, 25, 2),
        (1.0 / 3.0, 1, 3),
        (7.001, 7001, 1000),
        (1.0 / 1001.0, 1, 1001),
        (1000.0, 1000, 1),
    ] {
        let expected = FrameRate {
            numerator,
            denominator,
        };
        assert_eq!(FrameRate::from_f64(rate), Some(expected), "{rate}");
    }
    for none in [0.0, -24.0, f64::NAN, f64::INFINITY, 1e-9, 1e9] {
        assert_eq!(FrameRate::from_f64(none), None, "{none}");
    }
}

#[test]
fn a_video_is_the_same_bytes_every_time() {
    let frames: Vec<_> = (0..5).map(|frame| scene(97, 65, frame)).collect();
    for format in [VideoFormat::Mp4, VideoFormat::Gif, VideoFormat::Y4m] {
        let [a, b] = [0, 1].map(|_| encoded(format, &VideoOptions::default(), &frames));
        assert!(a == b, "{format} differs from run to run");
    }
}

#[test]
fn only_mp4_pads_sides_that_are_odd_or_tiny() {
    assert_eq!(VideoFormat::Mp4.padded_size(1, 17), (16, 18));
    assert_eq!(VideoFormat::Mp4.padded_size(481, 361), (482, 362));
    assert_eq!(VideoFormat::Mp4.padded_size(480, 360), (480, 360));
    assert_eq!(VideoFormat::Gif.padded_size(481, 361), (481, 361));
    assert_eq!(VideoFormat::Y4m.padded_size(481, 361), (481, 361));
}
