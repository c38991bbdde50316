//! R′G′B′ to Y′CbCr against the equations of ITU-R BT.709-6, items 3.2 to 3.4, in f64.

use super::picture;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glimray::output::video::{Picture8, Planes};

/// Y′, Cb and Cr in 8 bits, before rounding.
fn bt709(colour: [f64; 3]) -> [f64; 3] {
    let [r, g, b] = colour.map(|level| level / 255.0);
    let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let (cb, cr) = ((b - y) / 1.8556, (r - y) / 1.5748);
    [219.0 * y + 16.0, 224.0 * cb + 128.0, 224.0 * cr + 128.0]
}

fn planes(picture: &Picture8) -> Planes {
    Planes::new(picture, (picture.width, picture.height))
}

#[test]
fn white_black_and_grey_have_the_codes_of_the_standard() {
    for (level, luma) in [(0, 16), (255, 235)] {
        let flat = planes(&picture(4, 4, |_, _| [level; 3]));
        assert_eq!(flat.y, [luma; 16]);
        assert_eq!((flat.u, flat.v), (vec![128; 4], vec![128; 4]));
    }
    for level in 0..=255 {
        let flat = planes(&picture(2, 2, |_, _| [level; 3]));
        assert_eq!((flat.u, flat.v), (vec![128], vec![128]), "grey {level}");
    }
}

#[test]
fn colours_round_to_the_nearest_code() {
    let mut verdict = Verdict::on("BT.709");
    let mut random = Random::new(709);
    let corners = (0..8).map(|i| [0, 1, 2].map(|c| 255 * (i >> c & 1) as u8));
    let others = (0..2000).map(|_| [0, 1, 2].map(|_| random.below(256) as u8));
    for colour in corners.chain(others.collect::<Vec<_>>()) {
        let flat = planes(&picture(2, 2, |_, _| colour));
        let got = [flat.y[0], flat.u[0], flat.v[0]];
        let expected = bt709(colour.map(f64::from));
        for (got, expected) in got.into_iter().zip(expected) {
            let off = (f64::from(got) - expected).abs();
            verdict.that(format!("{colour:?}"), off <= 0.501, || {
                format!("{got} instead of {expected}")
            });
        }
    }
    verdict.close();
}

/// The filter preserves a linear ramp, so that its value shows the position of a sample.
#[test]
fn chroma_sits_at_the_left_column_and_between_the_rows() {
    let ramp = picture(32, 24, |x, y| [(5 * x) as u8, 60, (8 * y) as u8]);
    let planes = planes(&ramp);
    for row in 0..12 {
        for column in 1..16 {
            let (x, y) = (2.0 * f64::from(column), 2.0 * f64::from(row) + 0.5);
            let [_, cb, cr] = bt709([5.0 * x, 60.0, 8.0 * y]);
            let at = (row * 16 + column) as usize;
            let (u, v) = (f64::from(planes.u[at]), f64::from(planes.v[at]));
            assert!((u - cb).abs() < 0.51, "Cb {u} instead of {cb} at {x},{y}");
            assert!((v - cr).abs() < 0.51, "Cr {v} instead of {cr} at {x},{y}");
        }
    }
}

#[test]
fn odd_sides_are_padded_with_the_last_column_and_row() {
    let colour = |x: u32, y: u32| [(37 * x) as u8, (91 * y) as u8, (13 * x * y) as u8];
    let odd = picture(7, 5, colour);
    let padded = picture(8, 6, |x, y| colour(x.min(6), y.min(4)));
    assert_eq!(Planes::new(&odd, (8, 6)), planes(&padded));

    let kept = planes(&odd);
    assert_eq!((kept.width, kept.height), (7, 5));
    assert_eq!((kept.y.len(), kept.u.len(), kept.v.len()), (35, 12, 12));
    assert_eq!((&kept.u, &kept.v), (&planes(&padded).u, &planes(&padded).v));
}

#[test]
fn a_single_pixel_is_converted() {
    let one = Planes::new(&picture(1, 1, |_, _| [255, 0, 0]), (2, 2));
    let [y, cb, cr] = bt709([255.0, 0.0, 0.0]).map(|code| code.round() as u8);
    assert_eq!((one.y, one.u, one.v), (vec![y; 4], vec![cb], vec![cr]));
}
