//! Errors of videos are one line each, and nothing is lost.

use super::{encode_to, options, picture, scene};
use glimray::image::Image;
use glimray::output::video::{self, FrameRate, Picture8, VideoFormat, VideoOptions};
use glimray::output::{self, OutputError};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const FORMATS: [VideoFormat; 3] = [VideoFormat::Mp4, VideoFormat::Gif, VideoFormat::Y4m];

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn only_old_is_left(folder: &Path, context: impl std::fmt::Display) {
    let names = fs::read_dir(folder).expect("a folder").count();
    let old = fs::read(folder.join("video")).expect("the old file");
    assert_eq!((names, &old[..]), (1, &b"old"[..]), "{context}");
}

#[test]
fn a_frame_of_different_size_is_reported_and_the_old_file_kept() {
    let frames = [scene(20, 10, 0), scene(20, 10, 1), scene(20, 12, 2)];
    for format in FORMATS {
        let folder = folder();
        let path = folder.path().join("video");
        fs::write(&path, "old").expect("an old file");
        let error = encode_to(&path, format, &VideoOptions::default(), &frames);
        assert_eq!(
            error.expect_err("another size").to_string(),
            "cannot write the video (frame 2, counted from 0): it has 20×12 pixels, \
             but the first one 20×10. Render it again at that size."
        );
        only_old_is_left(folder.path(), format);
    }
}

#[test]
fn an_unreadable_frame_is_an_error_and_the_old_file_is_kept() {
    for format in FORMATS {
        let folder = folder();
        let path = folder.path().join("video");
        fs::write(&path, "old").expect("an old file");
        let missing = folder.path().join("frame_0003.png");
        let mut fetch = |index: usize| match index {
            3 => video::read_frame(&missing),
            _ => Ok(scene(20, 10, index)),
        };
        let result = video::encode(&path, format, &VideoOptions::default(), 6, &mut fetch);
        let error = result.expect_err("no such frame");
        assert!(
            matches!(&error, OutputError::UnreadableFrame { path, .. } if *path == missing),
            "{error}"
        );
        only_old_is_left(folder.path(), format);
    }
}

#[test]
fn no_frame_no_pixels_and_too_few_pixels_are_errors() {
    let folder = folder();
    let path = folder.path().join("video");
    let hollow = Picture8 {
        width: 4,
        height: 4,
        pixels: vec![[0; 3]; 15],
    };
    for format in FORMATS {
        for frames in [
            &[][..],
            &[Picture8::default()],
            std::slice::from_ref(&hollow),
        ] {
            let result = encode_to(&path, format, &VideoOptions::default(), frames);
            let error = result.expect_err("nothing to write");
            assert!(error.is_internal(), "{format}: {error}");
            assert!(!path.exists());
        }
    }
}

#[test]
fn limits_are_checked_in_advance() {
    let folder = folder();
    let path = folder.path().join("video");
    let check = |format, width, height| {
        video::check(&path, format, &VideoOptions::default(), width, height)
    };
    check(VideoFormat::Mp4, 3840, 2160).expect("level 5.2");
    check(VideoFormat::Mp4, 2160, 3840).expect("upright");
    check(VideoFormat::Gif, 65535, 1).expect("16 bits");
    check(VideoFormat::Y4m, 70000, 70000).expect("no limit");
    for (format, width, height) in [
        (VideoFormat::Mp4, 3841, 16),
        (VideoFormat::Mp4, 2161, 2161),
        (VideoFormat::Gif, 65536, 1),
    ] {
        let error = check(format, width, height).expect_err("too large");
        assert!(error.is_usage(), "{error}");
        assert!(
            matches!(error, OutputError::VideoTooLarge { .. }),
            "{error}"
        );
    }
    assert_eq!(
        check(VideoFormat::Mp4, 4096, 2304)
            .expect_err("too large")
            .to_string(),
        "cannot write the video (4096×2304 pixels): MP4 supports at most 3840×2160, or the same in portrait. \
         Choose a smaller size or another format."
    );
}

#[test]
fn a_gif_cannot_be_faster_than_its_players() {
    let folder = folder();
    let path = folder.path().join("video");
    let at = |rate| {
        let options = options(FrameRate::from_f64(rate).expect("a rate"));
        video::check(&path, VideoFormat::Gif, &options, 8, 8)
    };
    at(50.0).expect("two hundredths of a second");
    assert_eq!(
        at(60.0).expect_err("too fast").to_string(),
        "cannot write the video (60 frames per second): GIF supports 0.01 to 50. \
         Choose a rate between them or another format."
    );
    assert!(at(0.005).is_err());
}

#[test]
fn errors_of_image_files_apply_to_videos() {
    let folder = folder();
    let check = |path: &Path, clobber| {
        let options = VideoOptions {
            clobber,
            ..VideoOptions::default()
        };
        video::check(path, VideoFormat::Mp4, &options, 8, 8)
    };
    let missing = check(&folder.path().join("no/such.mp4"), true);
    assert!(matches!(missing, Err(OutputError::MissingFolder { .. })));
    let is_folder = check(folder.path(), true);
    assert!(matches!(is_folder, Err(OutputError::IsFolder { .. })));
    let old = folder.path().join("video");
    fs::write(&old, "old").expect("an old file");
    check(&old, true).expect("may be replaced");
    assert!(matches!(
        check(&old, false),
        Err(OutputError::Exists { .. })
    ));
    only_old_is_left(folder.path(), "after checks");
}

/// A named pipe is written to directly, frame by frame.
#[cfg(unix)]
#[test]
fn a_pipe_is_written_to_and_not_replaced() {
    let folder = folder();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo").success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).expect("a stream")
    });
    let frames = [scene(16, 16, 0), scene(16, 16, 1)];
    let options = VideoOptions::default();
    encode_to(&pipe, VideoFormat::Y4m, &options, &frames).expect("a video");
    let read = reader.join().expect("a reader");
    assert_eq!(read, super::encoded(VideoFormat::Y4m, &options, &frames));
    assert!(!pipe.metadata().expect("the pipe").is_file());
}

#[test]
fn frames_are_read_back_as_they_were_written() {
    let folder = folder();
    let values = |i: u32| [i as f32 / 255.0, 0.5, 1.0 - i as f32 / 255.0, 1.0];
    let mut image = Image {
        width: 16,
        height: 16,
        pixels: (0..256).map(values).collect(),
    };
    let path = folder.path().join("frame.png");
    output::save(&path, &image).expect("saved");
    let read = video::read_frame(&path).expect("a frame");
    assert_eq!(read, Picture8::from(&image));
    assert_eq!(
        read,
        picture(16, 16, |x, y| {
            let level = (16 * y + x) as u8;
            [level, 128, 255 - level]
        })
    );

    image.pixels[0][3] = 0.25;
    output::save(&path, &image).expect("saved");
    assert_eq!(
        video::read_frame(&path).expect("a frame"),
        read,
        "with opacity"
    );
}

/// Codes of linear light by IEC 61966-2-1, in f64.
#[test]
fn linear_frames_are_encoded_for_the_screen() {
    let folder = folder();
    let lights = [-1.0, 0.0, 0.001, 0.0031308, 0.01, 0.18, 0.5, 1.0, 7.0];
    let image = Image {
        width: lights.len() as u32,
        height: 1,
        pixels: lights.map(|light| [light, light, light, 1.0]).to_vec(),
    };
    for name in ["frame.exr", "frame.hdr"] {
        let path = folder.path().join(name);
        output::save(&path, &image).expect("saved");
        let read = video::read_frame(&path).expect("a frame");
        for (light, [level, ..]) in lights.into_iter().zip(read.pixels) {
            let light = f64::from(light).clamp(0.0, 1.0);
            let code = match light {
                0.0..0.0031308 => 12.92 * light,
                _ => 1.055 * light.powf(1.0 / 2.4) - 0.055,
            };
            let off = (f64::from(level) - 255.0 * code).abs();
            // HDR holds light to 1 part in 256 of the largest channel.
            assert!(off < 1.5, "{light} in {name} became {level}");
        }
    }
}

#[test]
fn damaged_frames_are_refused_by_name() {
    let folder = folder();
    let path = folder.path().join("frame.png");
    output::save(&path, &Image::new(64, 64)).expect("saved");
    let whole = fs::read(&path).expect("a file");
    for content in [&b""[..], b"no picture", &whole[..whole.len() / 2]] {
        fs::write(&path, content).expect("written");
        let error = video::read_frame(&path).expect_err("damaged");
        assert!(error.is_refused_input());
        let text = error.to_string();
        assert!(text.starts_with("cannot read the frame ("), "{text}");
        assert!(text.contains("frame.png") && !text.contains('\n'), "{text}");
    }
}
