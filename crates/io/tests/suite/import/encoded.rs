//! Pictures that encoders of other projects wrote (tests/encoded/make.py), and KTX2 files made here.

use super::folder;
use glimray::import::{self, ImportError};
use glimray::scene::{Picture, Texels};
use std::sync::Arc;

/// Width and height of the pictures.
const SIZE: (u32, u32) = (61, 47);

/// The picture files, whether each has alpha, and by how much their codes may be off.
const FILES: [(&str, &[u8], bool, usize); 5] = [
    (
        "alpha.webp",
        include_bytes!("../../../../../tests/encoded/alpha.webp"),
        true,
        24,
    ),
    ("etc1s_alpha.ktx2", ETC1S, true, 24),
    (
        "etc1s_levels.ktx2",
        include_bytes!("../../../../../tests/encoded/etc1s_levels.ktx2"),
        false,
        24,
    ),
    ("uastc_alpha.ktx2", UASTC, true, 16),
    (
        "uastc_zstd.ktx2",
        include_bytes!("../../../../../tests/encoded/uastc_zstd.ktx2"),
        false,
        16,
    ),
];
const ETC1S: &[u8] = include_bytes!("../../../../../tests/encoded/etc1s_alpha.ktx2");
const UASTC: &[u8] = include_bytes!("../../../../../tests/encoded/uastc_alpha.ktx2");

fn read(bytes: &[u8]) -> Result<Arc<Picture>, ImportError> {
    let folder = folder(&[("picture", bytes)]);
    import::picture(&folder.path().join("picture"))
}

fn codes(bytes: &[u8]) -> Vec<[u8; 4]> {
    let picture = read(bytes).unwrap_or_else(|error| panic!("{error}"));
    match &picture.texels {
        Texels::Srgb8(texels) => texels.clone(),
        other => panic!("not sRGB: {other:?}"),
    }
}

#[test]
fn pictures_of_other_encoders_show_what_was_encoded() {
    for (name, bytes, has_alpha, tolerance) in FILES {
        let picture = read(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((picture.width, picture.height), SIZE, "{name}");
        let (mut largest, mut sum) = ([0; 4], 0);
        for (i, texel) in codes(bytes).iter().enumerate() {
            let (x, y) = (i % 61, i / 61);
            let alpha = if has_alpha { 255 - 2 * x } else { 255 };
            for (k, expected) in [4 * x, 5 * y, 77, alpha].into_iter().enumerate() {
                let off = usize::from(texel[k]).abs_diff(expected);
                largest[k] = off.max(largest[k]);
                sum += off;
            }
        }
        assert!(
            largest.iter().all(|off| *off <= tolerance),
            "{name}: {largest:?}"
        );
        // On average, a code is off by less than a quarter of that.
        assert!(sum < 61 * 47 * tolerance, "{name}: {sum}");
    }
}

#[test]
fn two_channels_of_ktx2_are_red_and_green() {
    // The file says that its second channel is alpha; say that it is green, as glTF's tools do for two channels.
    for (file, at, from, to) in [(ETC1S, 44, 15, 4), (UASTC, 28, 3, 5)] {
        let mut bytes = file.to_vec();
        let descriptor = u32::from_le_bytes(bytes[48..52].try_into().expect("four")) as usize;
        let channel = &mut bytes[descriptor + at + 3];
        assert_eq!(*channel & 15, from);
        *channel = *channel & 0xf0 | to;
        for (whole, texel) in codes(file).into_iter().zip(codes(&bytes)) {
            assert_eq!(texel, [whole[0], whole[3], 0, 255]);
        }
    }
}

/// A KTX2 file without Basis Universal: of this format, supercompression, size and level.
fn ktx2(format: u32, scheme: u32, (width, height): (u32, u32), level: &[u8]) -> Vec<u8> {
    let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let (descriptor, index) = (44, 24);
    let start = 80 + index + descriptor;
    for word in [format, 1, width, height, 0, 0, 1, 1, scheme] {
        bytes.extend(word.to_le_bytes());
    }
    for word in [80 + index, descriptor, 0, 0, 0, 0, 0, 0_u32] {
        bytes.extend(word.to_le_bytes());
    }
    for word in [u64::from(start), level.len() as u64, 0] {
        bytes.extend(word.to_le_bytes());
    }
    // The descriptor: the model RGBSDA, the rest is not read.
    let mut words = [0_u32; 11];
    (words[0], words[3]) = (descriptor, 1);
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend_from_slice(level);
    bytes
}

#[test]
fn plain_ktx2_has_one_three_or_four_channels() {
    let rgba: Vec<u8> = (0..6 * 4).map(|i| i * 10).collect();
    let expected: Vec<[u8; 4]> = rgba.as_chunks().0.to_vec();
    assert_eq!(codes(&ktx2(43, 0, (3, 2), &rgba)), expected);
    let zlib = miniz_oxide::deflate::compress_to_vec_zlib(&rgba, 6);
    assert_eq!(codes(&ktx2(37, 3, (3, 2), &zlib)), expected);
    let expected: Vec<[u8; 4]> = (rgba.as_chunks().0.iter())
        .map(|&[r, g, b]| [r, g, b, 255])
        .collect();
    assert_eq!(codes(&ktx2(29, 0, (4, 2), &rgba)), expected);
    let expected: Vec<[u8; 4]> = rgba.iter().map(|&grey| [grey, grey, grey, 255]).collect();
    assert_eq!(codes(&ktx2(9, 0, (24, 1), &rgba)), expected);
}

#[test]
fn ktx2_that_lies_or_is_not_supported_is_refused() {
    let rgba = [7; 24];
    let zeros = miniz_oxide::deflate::compress_to_vec_zlib(&vec![0; 1 << 26], 6);
    let mut cube = ktx2(37, 0, (3, 2), &rgba);
    cube[36] = 6;
    for (bytes, why) in [
        (
            ktx2(37, 0, (8192, 8192), &rgba),
            "has 24 bytes instead of 256 MiB",
        ),
        (
            ktx2(37, 0, (u32::MAX, u32::MAX), &rgba),
            "the limit is 67108864",
        ),
        (ktx2(37, 0, (0, 2), &rgba), "has no texels"),
        (ktx2(37, 3, (3, 2), &zeros), "zlib stream is invalid"),
        (ktx2(37, 2, (3, 2), &rgba), "Zstandard stream is invalid"),
        (ktx2(37, 1, (3, 2), &rgba), "supercompression 1"),
        (ktx2(145, 0, (3, 2), &rgba), "the format 145"),
        (cube, "not a flat picture"),
    ] {
        let started = std::time::Instant::now();
        let error = read(&bytes).expect_err("refused").to_string();
        assert!(error.contains(why), "{error}");
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(started.elapsed().as_secs_f64() < 2.0, "{error}");
    }
}

#[test]
fn encoded_pictures_that_were_cut_or_changed_are_refused_or_read_without_a_panic() {
    let mut random = crate::support::random::Random::new(7);
    for (name, whole, ..) in FILES {
        for length in (0..100).map(|percent| whole.len() * percent / 100) {
            let read = read(&whole[..length]);
            assert!(read.is_err(), "{name}: {length} of {} bytes", whole.len());
        }
        for _ in 0..300 {
            let mut bad = whole.to_vec();
            for _ in 0..1 + random.below(4) {
                let at = random.below(bad.len());
                bad[at] = [0, 1, 0x7f, 0x80, 0xff, random.below(256) as u8][random.below(6)];
            }
            if let Err(error) = read(&bad) {
                assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }
}
