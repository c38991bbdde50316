//! Y4M by its text and the length of its frames.

use super::{encoded, options, scene};
use glimray::output::video::{FrameRate, Planes, VideoFormat, Y4mWriter};

#[test]
fn frames_follow_the_header_plane_by_plane() {
    let rate = FrameRate::from_f64(29.97).expect("a rate");
    let frames: Vec<_> = (0..3).map(|frame| scene(7, 5, frame)).collect();
    let file = encoded(VideoFormat::Y4m, &options(rate), &frames);
    let end = file.iter().position(|&byte| byte == b'\n').expect("a line");
    let header = str::from_utf8(&file[..end]).expect("text");
    let words: Vec<_> = header.split(' ').collect();
    assert_eq!(
        words[..7],
        [
            "YUV4MPEG2",
            "W7",
            "H5",
            "F30000:1001",
            "Ip",
            "A1:1",
            "C420mpeg2"
        ]
    );
    assert!(words.contains(&"XCOLORRANGE=LIMITED"));

    let mut rest = &file[end + 1..];
    for frame in &frames {
        let planes = Planes::new(frame, (7, 5));
        let expected = [b"FRAME\n", &planes.y[..], &planes.u, &planes.v].concat();
        assert_eq!(rest[..expected.len()], expected);
        rest = &rest[expected.len()..];
    }
    assert!(rest.is_empty());
}

#[test]
fn a_pipe_gets_what_a_file_gets() {
    let frames: Vec<_> = (0..3).map(|frame| scene(32, 20, frame)).collect();
    let mut piped = Vec::new();
    let mut writer = Y4mWriter::new(&mut piped, 32, 20, FrameRate::FILM).expect("a header");
    for frame in &frames {
        writer.write(frame).expect("a frame");
    }
    writer.finish().expect("the end");
    assert_eq!(
        piped,
        encoded(VideoFormat::Y4m, &options(FrameRate::FILM), &frames)
    );
}

#[test]
fn a_frame_of_another_size_never_reaches_the_pipe() {
    let mut piped = Vec::new();
    let mut writer = Y4mWriter::new(&mut piped, 32, 20, FrameRate::FILM).expect("a header");
    let error = writer.write(&scene(20, 32, 0)).expect_err("another size");
    assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
    writer.finish().expect("the end");
    assert_eq!(piped.last(), Some(&b'\n'));
    assert_eq!(piped.iter().filter(|&&byte| byte == b'\n').count(), 1);
}
