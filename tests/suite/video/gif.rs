//! GIFs as the decoder of `gif` shows them.

use super::{encoded, options, picture, psnr, scene};
use gif::{ColorOutput, DecodeOptions, DisposalMethod, Repeat};
use glimray::output::video::{FrameRate, Picture8, VideoFormat, VideoOptions};

/// A GIF as a viewer sees it.
struct Shown {
    size: (u16, u16),
    repeat: Repeat,
    /// In hundredths of a second.
    delays: Vec<u16>,
    frames: Vec<Vec<[u8; 3]>>,
    /// Pixels in the rectangle of each frame.
    drawn: Vec<usize>,
}

fn show(options: &VideoOptions, frames: &[Picture8]) -> Shown {
    let file = encoded(VideoFormat::Gif, options, frames);
    let mut decode = DecodeOptions::new();
    decode.set_color_output(ColorOutput::RGBA);
    let mut decoder = decode.read_info(&file[..]).expect("a GIF");
    let (width, height) = (decoder.width(), decoder.height());
    let mut shown = Shown {
        size: (width, height),
        repeat: decoder.repeat(),
        delays: Vec::new(),
        frames: Vec::new(),
        drawn: Vec::new(),
    };
    let mut canvas = vec![[0; 3]; usize::from(width) * usize::from(height)];
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        assert_eq!(frame.dispose, DisposalMethod::Keep);
        let columns = usize::from(frame.width);
        for (at, pixel) in frame.buffer.chunks_exact(4).enumerate() {
            let x = usize::from(frame.left) + at % columns;
            let y = usize::from(frame.top) + at / columns;
            if pixel[3] > 0 {
                canvas[y * usize::from(width) + x] = [pixel[0], pixel[1], pixel[2]];
            }
        }
        shown.delays.push(frame.delay);
        shown.frames.push(canvas.clone());
        shown.drawn.push(columns * usize::from(frame.height));
    }
    shown.repeat = decoder.repeat();
    assert_eq!(shown.frames.len(), frames.len());
    shown
}

fn frames(width: u32, height: u32, count: usize) -> Vec<Picture8> {
    (0..count)
        .map(|frame| scene(width, height, frame))
        .collect()
}

/// The mean of each block of 4×4 pixels, which averages the dithering.
fn blocks(pixels: &[[u8; 3]], width: usize) -> Vec<u8> {
    let (columns, rows) = (width / 4, pixels.len() / width / 4);
    let mut means = Vec::new();
    for block in 0..columns * rows {
        let (left, top) = (block % columns * 4, block / columns * 4);
        let inside = (0..16).map(|i| pixels[(top + i / 4) * width + left + i % 4]);
        let sum = inside.fold([0; 3], |sum: [u32; 3], pixel| {
            [0, 1, 2].map(|c| sum[c] + u32::from(pixel[c]))
        });
        means.extend(sum.map(|sum| (sum as f64 / 16.0).round() as u8));
    }
    means
}

#[test]
fn gradients_are_close_and_closer_when_averaged() {
    let frames = frames(160, 120, 8);
    let shown = show(&VideoOptions::default(), &frames);
    assert_eq!(shown.size, (160, 120));
    for (shown, frame) in shown.frames.iter().zip(&frames) {
        let near = psnr(shown.as_flattened(), frame.pixels.as_flattened());
        let afar = psnr(&blocks(shown, 160), &blocks(&frame.pixels, 160));
        assert!(near > 29.0, "{near} dB");
        assert!(afar > 38.0, "{afar} dB in the mean of blocks");
    }
}

#[test]
fn static_areas_do_not_flicker() {
    let frames = frames(120, 90, 10);
    let shown = show(&VideoOptions::default(), &frames);
    let pairs = shown.frames.windows(2).zip(frames.windows(2));
    for (shown, frames) in pairs {
        let pixels = frames[0].pixels.iter().zip(&frames[1].pixels);
        for (at, (old, new)) in pixels.enumerate() {
            assert!(old != new || shown[0][at] == shown[1][at], "pixel {at}");
        }
    }
    assert_eq!((shown.frames.len(), shown.drawn.len()), (10, 10));
    // The gradient, half of the picture, is drawn once.
    assert_eq!(shown.drawn[0], 120 * 90);
    assert!(shown.drawn[1..].iter().all(|&drawn| drawn < 120 * 45));
}

#[test]
fn a_picture_that_stays_takes_one_pixel() {
    let frames = vec![scene(40, 30, 0); 4];
    let shown = show(&VideoOptions::default(), &frames);
    assert_eq!(shown.drawn, [1200, 1, 1, 1]);
    assert!(shown.frames.iter().all(|frame| *frame == shown.frames[0]));
}

#[test]
fn few_colours_are_kept_as_they_are() {
    let colours = [[1, 2, 3], [250, 128, 7], [90, 90, 91]];
    let frames =
        [0, 1].map(|frame| picture(31, 17, |x, y| colours[((x + y + frame) % 3) as usize]));
    let shown = show(&VideoOptions::default(), &frames);
    for (shown, frame) in shown.frames.iter().zip(&frames) {
        assert_eq!(*shown, frame.pixels);
    }
}

#[test]
fn the_darkest_and_lightest_colours_survive() {
    let mut frames = frames(160, 120, 2);
    for frame in &mut frames {
        for (at, pixel) in frame.pixels.iter_mut().enumerate().take(3200) {
            *pixel = [[0; 3], [255; 3]][at / 1600];
        }
    }
    let shown = show(&VideoOptions::default(), &frames);
    for frame in shown.frames {
        assert!(frame[..1600].iter().all(|pixel| *pixel == [0; 3]));
        assert!(frame[1600..3200].iter().all(|pixel| *pixel == [255; 3]));
    }
}

#[test]
fn delays_add_up_without_drift() {
    for rate in [24.0, 30.0, 23.976, 25.0, 50.0, 7.0, 0.5] {
        let rate = FrameRate::from_f64(rate).expect("a rate");
        let shown = show(&options(rate), &vec![scene(4, 4, 0); 49]);
        let mut end = 0;
        for (index, &delay) in shown.delays.iter().enumerate() {
            end += u32::from(delay);
            let expected = 100.0 * (index + 1) as f64 / rate.as_f64();
            let off = (f64::from(end) - expected).abs();
            assert!(off <= 0.5, "frame {index} at {rate} ends {off}/100 s off");
        }
    }
}

#[test]
fn it_repeats_only_if_requested() {
    for (repeat, expected) in [(true, Repeat::Infinite), (false, Repeat::Finite(0))] {
        let options = VideoOptions {
            repeat,
            ..VideoOptions::default()
        };
        assert_eq!(show(&options, &frames(8, 8, 2)).repeat, expected);
    }
}
