//! Videos as FFmpeg sees them, where it is installed.

use super::{encode_to, options, psnr, scene};
use crate::support::skip::{Need, skip};
use glimray::output::video::{FrameRate, Picture8, Planes, VideoFormat};
use std::path::Path;
use std::process::Command;

/// The output of an FFmpeg program; `None`, with a line that says so, if it is not installed.
fn tool(name: &str, arguments: &[&str], file: &Path) -> Option<Vec<u8>> {
    let position = arguments.iter().position(|argument| *argument == "FILE");
    let position = position.expect("a place for the file");
    let run = Command::new(name)
        .args(["-v", "error"])
        .args(&arguments[..position])
        .arg(file)
        .args(&arguments[position + 1..])
        .output();
    let Ok(run) = run else {
        skip(Need::Ffmpeg, format_args!("{name} is not installed"));
        return None;
    };
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success() && said.is_empty(), "{name}: {said}");
    Some(run.stdout)
}

fn frames(width: u32, height: u32, count: usize) -> Vec<Picture8> {
    (0..count)
        .map(|frame| scene(width, height, frame))
        .collect()
}

/// The values of these fields of the single stream, as text.
fn probe(file: &Path, fields: &str) -> Option<String> {
    let entries = format!("stream={fields}");
    let arguments = [
        "-count_frames",
        "-show_entries",
        &entries,
        "-of",
        "default=noprint_wrappers=1:nokey=1",
        "FILE",
    ];
    let printed = String::from_utf8(tool("ffprobe", &arguments, file)?).expect("text");
    Some(printed.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[test]
fn ffprobe_finds_size_rate_length_and_colours() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.mp4");
    for (rate, width, height, count, seconds) in [
        (24.0, 64, 48, 48, "2.000000"),
        (29.97, 64, 48, 30, "1.001000"),
        (25.0, 33, 17, 1, "0.040000"),
        (23.976, 65, 49, 24, "1.001000"),
        (12.5, 64, 48, 5, "0.400000"),
    ] {
        let rate = FrameRate::from_f64(rate).expect("a rate");
        let frames = frames(width, height, count);
        encode_to(&path, VideoFormat::Mp4, &options(rate), &frames).expect("a video");
        let fields = "codec_name,profile,codec_tag_string,width,height,pix_fmt,color_range,\
                      color_space,color_transfer,color_primaries,r_frame_rate,avg_frame_rate,\
                      duration,nb_frames,nb_read_frames";
        let Some(found) = probe(&path, fields) else {
            return;
        };
        let (width, height) = VideoFormat::Mp4.padded_size(width, height);
        let fraction = format!("{}/{}", rate.numerator, rate.denominator);
        let expected = format!(
            "h264 Constrained Baseline avc1 {width} {height} yuv420p tv bt709 iec61966-2-1 bt709 \
             {fraction} {fraction} {seconds} {count} {count}"
        );
        assert_eq!(found, expected);
    }
}

#[test]
fn ffmpeg_decodes_the_frames_that_went_in() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let frames = frames(98, 66, 10);
    for (name, format, least) in [
        ("a.mp4", VideoFormat::Mp4, 38.0),
        ("a.y4m", VideoFormat::Y4m, f64::INFINITY),
    ] {
        let path = folder.path().join(name);
        encode_to(&path, format, &options(FrameRate::FILM), &frames).expect("a video");
        let arguments = ["-i", "FILE", "-f", "rawvideo", "-pix_fmt", "yuv420p", "-"];
        let Some(decoded) = tool("ffmpeg", &arguments, &path) else {
            return;
        };
        let planes = frames.iter().map(|frame| Planes::new(frame, (98, 66)));
        let expected: Vec<_> = planes.flat_map(|p| [p.y, p.u, p.v].concat()).collect();
        let near = psnr(&decoded, &expected);
        assert!(near >= least, "{near} dB in {name}");
    }
}

/// Converts back to R′G′B′ with independent arithmetic: the matrix, range and siting must agree.
#[test]
fn ffmpeg_shows_the_colours_that_went_in() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let frames = frames(160, 120, 2);
    let path = folder.path().join("a.mp4");
    encode_to(&path, VideoFormat::Mp4, &options(FrameRate::FILM), &frames).expect("a video");
    let arguments = [
        "-i",
        "FILE",
        "-sws_flags",
        "accurate_rnd+full_chroma_int+bicubic",
    ];
    let arguments = [
        &arguments[..],
        &["-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
    ]
    .concat();
    let Some(decoded) = tool("ffmpeg", &arguments, &path) else {
        return;
    };
    let expected: Vec<_> = frames
        .iter()
        .flat_map(|f| f.pixels.as_flattened())
        .copied()
        .collect();
    let near = psnr(&decoded, &expected);
    assert!(near > 36.0, "{near} dB");
}

#[test]
fn ffprobe_reads_y4m_of_odd_sizes_and_gifs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let rate = FrameRate::from_f64(29.97).expect("a rate");
    let frames = frames(33, 17, 6);
    for (name, format, fields, expected) in [
        (
            "a.y4m",
            VideoFormat::Y4m,
            "width,height,pix_fmt,color_range,chroma_location,r_frame_rate,nb_read_frames",
            "33 17 yuv420p tv left 30000/1001 6",
        ),
        (
            "a.gif",
            VideoFormat::Gif,
            "codec_name,width,height,nb_read_frames",
            "gif 33 17 6",
        ),
    ] {
        let path = folder.path().join(name);
        encode_to(&path, format, &options(rate), &frames).expect("a video");
        let Some(found) = probe(&path, fields) else {
            return;
        };
        assert_eq!(found, expected, "{name}");
    }
}
