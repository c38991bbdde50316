//! MP4 by the boxes of ISO/IEC 14496-12 and -15, and by OpenH264's decoder.

use super::{encoded, options, picture, psnr, scene};
use glimray::output::video::{FrameRate, Picture8, Planes, VideoFormat, VideoOptions};
use openh264::decoder::Decoder;
use openh264::formats::YUVSource;

/// An MP4 file taken apart.
struct Movie {
    file: Vec<u8>,
}

impl Movie {
    fn new(options: &VideoOptions, frames: &[Picture8]) -> Self {
        let file = encoded(VideoFormat::Mp4, options, frames);
        Self { file }
    }

    /// Names and contents of the boxes in `bytes`.
    fn boxes(mut bytes: &[u8]) -> Vec<(&str, &[u8])> {
        let mut found = Vec::new();
        while bytes.len() >= 8 {
            let name = str::from_utf8(&bytes[4..8]).expect("a name");
            let (header, size) = match be32(bytes, 0) {
                1 => (16, be32(bytes, 12) as usize),
                size => (8, size as usize),
            };
            found.push((name, &bytes[header..size]));
            bytes = &bytes[size..];
        }
        found
    }

    /// The contents of the box at the end of this path, without the fields that precede its boxes.
    fn find(&self, path: &[&str]) -> &[u8] {
        path.iter().fold(&self.file[..], |bytes, wanted| {
            let mut boxes = Self::boxes(bytes).into_iter();
            let found = boxes.find(|(name, _)| name == wanted);
            let (name, content) = found.unwrap_or_else(|| panic!("no {wanted}"));
            match name {
                "stsd" => &content[8..],
                "avc1" => &content[78..],
                _ => content,
            }
        })
    }

    fn table(&self, name: &str) -> &[u8] {
        self.find(&["moov", "trak", "mdia", "minf", "stbl", name])
    }

    fn entry(&self, name: &str) -> &[u8] {
        self.find(&["moov", "trak", "mdia", "minf", "stbl", "stsd", "avc1", name])
    }

    /// The frames as the decoder gets them: length-prefixed NAL units.
    fn samples(&self) -> Vec<&[u8]> {
        let (sizes, offsets) = (self.table("stsz"), self.table("stco"));
        assert_eq!(be32(offsets, 4), 1, "one run of frames");
        let mut start = be32(offsets, 8) as usize;
        let mut sample = |index| {
            let size = be32(sizes, 12 + 4 * index) as usize;
            start += size;
            &self.file[start - size..start]
        };
        (0..be32(sizes, 8) as usize).map(&mut sample).collect()
    }

    /// NAL units of the one sequence and the one picture parameter set.
    fn parameter_sets(&self) -> [&[u8]; 2] {
        let avcc = self.entry("avcC");
        assert_eq!((avcc[0], avcc[5] & 31), (1, 1), "version and count");
        let after = 8 + usize::from(avcc[7]);
        assert_eq!((avcc[6], avcc[after]), (0, 1), "length and count");
        let end = after + 3 + usize::from(avcc[after + 2]);
        [&avcc[8..after], &avcc[after + 3..end]]
    }

    fn decode(&self) -> Vec<Planes> {
        let mut decoder = Decoder::new().expect("a decoder");
        let mut head = Vec::new();
        for set in self.parameter_sets() {
            head.extend_from_slice(&[0, 0, 0, 1]);
            head.extend_from_slice(set);
        }
        let mut frames = Vec::new();
        for sample in self.samples() {
            let mut stream = std::mem::take(&mut head);
            for unit in units(sample) {
                stream.extend_from_slice(&[0, 0, 0, 1]);
                stream.extend_from_slice(unit);
            }
            let decoded = decoder.decode(&stream).expect("a frame");
            frames.push(planes(&decoded.expect("no delay")));
        }
        frames
    }
}

fn be32(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

/// The NAL units of a frame.
fn units(mut sample: &[u8]) -> Vec<&[u8]> {
    let mut units = Vec::new();
    while !sample.is_empty() {
        let end = 4 + be32(sample, 0) as usize;
        units.push(&sample[4..end]);
        sample = &sample[end..];
    }
    units
}

fn planes(decoded: &impl YUVSource) -> Planes {
    let (width, height) = decoded.dimensions();
    let plane = |samples: &[u8], stride: usize, width: usize| -> Vec<u8> {
        let rows = samples.chunks(stride);
        rows.flat_map(|row| &row[..width]).copied().collect()
    };
    let (y, u, v) = decoded.strides();
    let half = width / 2;
    let mut planes = Planes {
        width,
        height,
        y: plane(decoded.y(), y, width),
        u: plane(decoded.u(), u, half),
        v: plane(decoded.v(), v, half),
    };
    planes.y.truncate(width * height);
    planes.u.truncate(half * height / 2);
    planes.v.truncate(half * height / 2);
    planes
}

fn frames(width: u32, height: u32, count: usize) -> Vec<Picture8> {
    (0..count)
        .map(|frame| scene(width, height, frame))
        .collect()
}

/// The PSNR of luma in the worst frame, in decibels.
fn worst(movie: &Movie, frames: &[Picture8]) -> f64 {
    let decoded = movie.decode();
    assert_eq!(decoded.len(), frames.len());
    let pairs = decoded.iter().zip(frames);
    pairs
        .map(|(decoded, frame)| {
            let size = (decoded.width as u32, decoded.height as u32);
            psnr(&decoded.y, &Planes::new(frame, size).y)
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn decoded_frames_are_close_and_higher_quality_is_larger_and_closer() {
    let frames = frames(160, 120, 12);
    let of = |quality| {
        let movie = Movie::new(
            &VideoOptions {
                quality,
                ..VideoOptions::default()
            },
            &frames,
        );
        (worst(&movie, &frames), movie.file.len())
    };
    let [coarse, usual, fine] = [20, 75, 100].map(of);
    assert!(usual.0 > 40.0, "{} dB at quality 75", usual.0);
    assert!(fine.0 > 46.0, "{} dB at quality 100", fine.0);
    assert!(
        coarse.0 < usual.0 && usual.0 < fine.0 && coarse.1 < usual.1 && usual.1 < fine.1,
        "{coarse:?} {usual:?} {fine:?}"
    );
}

#[test]
fn flat_colours_come_back() {
    for colour in [
        [0, 0, 0],
        [255, 255, 255],
        [255, 0, 0],
        [0, 255, 0],
        [0, 0, 255],
        [187, 90, 33],
    ] {
        let flat = picture(48, 32, |_, _| colour);
        let movie = Movie::new(&VideoOptions::default(), &[flat.clone(), flat.clone()]);
        let expected = Planes::new(&flat, (48, 32));
        for decoded in movie.decode() {
            for (got, expected) in [
                (&decoded.y, &expected.y),
                (&decoded.u, &expected.u),
                (&decoded.v, &expected.v),
            ] {
                let off = got.iter().zip(expected).map(|(a, b)| a.abs_diff(*b));
                assert!(off.max() <= Some(2), "{colour:?}: {got:?}");
            }
        }
    }
}

#[test]
fn the_index_comes_before_the_frames() {
    let movie = Movie::new(&VideoOptions::default(), &frames(64, 48, 3));
    let names: Vec<_> = Movie::boxes(&movie.file)
        .into_iter()
        .map(|(name, _)| name)
        .filter(|name| *name != "free")
        .collect();
    assert_eq!(names, ["ftyp", "moov", "mdat"]);
    let track = Movie::boxes(movie.find(&["moov", "trak"]));
    let has = |wanted: &str| track.iter().any(|(name, _)| *name == wanted);
    assert!(has("tkhd") && has("mdia") && !has("edts"));
}

#[test]
fn times_are_exact() {
    for (rate, count) in [(24.0, 5), (29.97, 7), (12.5, 1), (23.976, 2), (120.0, 3)] {
        let rate = FrameRate::from_f64(rate).expect("a rate");
        let movie = Movie::new(&options(rate), &frames(32, 32, count));
        let header = movie.find(&["moov", "trak", "mdia", "mdhd"]);
        let ticks = count as u32 * rate.denominator;
        assert_eq!(header[0], 0, "version");
        assert_eq!(
            (be32(header, 12), be32(header, 16)),
            (rate.numerator, ticks)
        );
        let durations = movie.table("stts");
        let durations = [4, 8, 12].map(|at| be32(durations, at));
        assert_eq!(durations, [1, count as u32, rate.denominator]);
    }
}

#[test]
fn players_can_jump_to_a_frame_every_two_seconds() {
    let rate = FrameRate::from_f64(5.0).expect("a rate");
    let movie = Movie::new(&options(rate), &frames(32, 32, 25));
    let keyframes = movie.table("stss");
    let keyframes: Vec<_> = (0..be32(keyframes, 4) as usize)
        .map(|index| be32(keyframes, 8 + 4 * index))
        .collect();
    assert_eq!(keyframes, [1, 11, 21]);
    for (index, sample) in movie.samples().into_iter().enumerate() {
        let kinds: Vec<_> = units(sample).into_iter().map(|unit| unit[0] & 31).collect();
        let expected = if index % 10 == 0 { 5 } else { 1 };
        assert_eq!(kinds, [expected], "frame {index} is one slice");
    }
}

/// Every H.264 decoder supports constrained baseline.
#[test]
fn the_profile_is_constrained_baseline_in_every_header() {
    let movie = Movie::new(&VideoOptions::default(), &frames(64, 48, 2));
    let avcc = movie.entry("avcC");
    let [sps, pps] = movie.parameter_sets();
    assert_eq!((sps[0] & 31, pps[0] & 31), (7, 8));
    assert_eq!(avcc[1], 66, "baseline");
    assert_eq!(avcc[2] & 0x40, 0x40, "constraint set 1");
    assert_eq!(avcc[1..4], sps[1..4]);
    assert_eq!(avcc[4] & 3, 3, "lengths of four bytes");
}

/// ITU-T H.273: primaries of BT.709, transfer of sRGB, matrix of BT.709, limited range.
#[test]
fn the_colours_are_named() {
    let movie = Movie::new(&VideoOptions::default(), &frames(64, 48, 2));
    assert_eq!(movie.entry("colr"), b"nclx\0\x01\0\x0d\0\x01\0");
}

#[test]
fn any_size_can_be_encoded() {
    for (width, height) in [(1, 1), (1, 40), (16, 16), (17, 15), (33, 2), (481, 361)] {
        let frames = frames(width, height, 2);
        let movie = Movie::new(&VideoOptions::default(), &frames);
        let header = movie.find(&["moov", "trak", "tkhd"]);
        let size = VideoFormat::Mp4.padded_size(width, height);
        assert_eq!((be32(header, 76) >> 16, be32(header, 80) >> 16), size);
        let decoded = &movie.decode()[1];
        assert_eq!((decoded.width as u32, decoded.height as u32), size);
        assert!(worst(&movie, &frames) > 35.0, "{width}×{height}");
    }
}
