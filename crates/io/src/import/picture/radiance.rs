//! Radiance HDR: what the header says about the picture, and the picture. The scan lines are read by `image`.
//!
//! Values are divided by `EXPOSURE` and `COLORCORR`, which programs multiplied into them. Lines that do not begin at the left
//! are of pictures that this one was made of. Source: Ward, Radiance File Formats, "Picture file format".

use super::Refused;
use super::opened::{Ignored, Opened, Unfit, Values};
use super::primaries::{self, Primaries};
use crate::import::source::quote;
use glam::{DVec2, Mat3, Vec3, Vec4};
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use std::io::{Cursor, Read};
use std::str::FromStr;

/// The first bytes of each file; the name of the program that wrote it follows.
pub(super) const MAGIC: &[u8] = b"#?";

/// The header of a file.
pub(super) struct Head {
    /// Number of texels in a scan line, and of lines.
    scan: [u32; 2],
    orientation: Orientation,
    /// Divisor of values.
    divisor: Vec3,
    rec709_from_own: Option<Mat3>,
    ignored: Vec<Ignored>,
    /// Where the scan lines begin.
    body: usize,
}

/// How scan lines lie in the picture.
#[derive(Clone, Copy, PartialEq)]
struct Orientation {
    /// Whether they are columns.
    are_columns: bool,
    /// Whether x falls along or across them.
    is_mirrored: bool,
    /// Whether they begin at the bottom, or the first is there.
    is_upward: bool,
}

impl Head {
    /// Width and height of the picture.
    pub fn size(&self) -> [u32; 2] {
        let [along, across] = self.scan;
        match self.orientation.are_columns {
            true => [across, along],
            false => [along, across],
        }
    }
}

/// Reads the header.
///
/// # Errors
/// The header is cut, has another encoding, or does not name the size.
pub(super) fn head(bytes: &[u8], unfit: &Unfit) -> Result<Head, Refused> {
    let mut lines = bytes.split_inclusive(|&byte| byte == b'\n');
    let mut body = 0;
    let mut next = || {
        let line = lines.next().filter(|line| line.ends_with(b"\n"));
        let line = line.ok_or_else(|| unfit.damaged("is truncated: its header has no end"))?;
        body += line.len();
        Ok(line.trim_ascii_end())
    };
    let mut head = Head {
        scan: [0; 2],
        orientation: Orientation {
            are_columns: false,
            is_mirrored: false,
            is_upward: false,
        },
        divisor: Vec3::ONE,
        rec709_from_own: None,
        ignored: Vec::new(),
        body: 0,
    };
    let mut is_xyz = false;
    let mut own = None;
    loop {
        let line = next()?;
        if line.is_empty() {
            break;
        }
        let Some(equals) = line.iter().position(|&byte| byte == b'=') else {
            continue;
        };
        let (key, value) = (&line[..equals], line[equals + 1..].trim_ascii());
        let mut is_usable = true;
        match key {
            b"FORMAT" => {
                is_xyz = match value {
                    b"32-bit_rle_rgbe" => false,
                    b"32-bit_rle_xyze" => true,
                    _ => {
                        let why = format!("has the unsupported encoding {}", quote(value));
                        return Err(unfit.unsupported(&why));
                    }
                }
            }
            b"EXPOSURE" | b"COLORCORR" | b"PIXASPECT" | b"GAMMA" => {
                let factors = match (key, numbers(value).as_deref()) {
                    (b"COLORCORR", Some(&[r, g, b])) => Some(Vec3::new(r, g, b)),
                    (b"COLORCORR", _) => None,
                    (_, Some(&[all])) => Some(Vec3::splat(all)),
                    _ => None,
                };
                let is_positive = |it: &Vec3| it.is_finite() && it.min_element() > 0.0;
                let factors = factors.filter(is_positive);
                match (key, factors) {
                    (b"EXPOSURE" | b"COLORCORR", Some(factors)) => head.divisor *= factors,
                    // Pixels that are no squares, and values that are no light.
                    (_, factors) => is_usable = factors == Some(Vec3::ONE),
                }
            }
            b"PRIMARIES" => match numbers(value).as_deref() {
                Some(&[rx, ry, gx, gy, bx, by, wx, wy]) => {
                    let point = |x: f64, y: f64| DVec2::new(x, y);
                    own = Some(Primaries {
                        red: point(rx, ry),
                        green: point(gx, gy),
                        blue: point(bx, by),
                        white: point(wx, wy),
                    });
                }
                _ => is_usable = false,
            },
            _ => {}
        }
        if !is_usable {
            head.ignored.push(Ignored {
                clause: format!("says {}, which is not applied", quote(line)),
                is_of_colors: matches!(key, b"GAMMA" | b"PRIMARIES"),
            });
        }
    }
    head.rec709_from_own = match (is_xyz, own) {
        (true, _) => Some(primaries::rec709_from_xyz()),
        (false, Some(own)) => primaries::rec709_from(own, "PRIMARIES", &mut head.ignored),
        (false, None) => None,
    };
    let size = next()?;
    (head.orientation, head.scan) = resolution(size).ok_or_else(|| {
        let why = format!("is damaged: {} is no size of a picture", quote(size));
        unfit.damaged(&why)
    })?;
    head.body = body;
    Ok(head)
}

/// The numbers in a text that has nothing else.
fn numbers<N: FromStr>(text: &[u8]) -> Option<Vec<N>> {
    let text = std::str::from_utf8(text).ok()?;
    let number = |word: &str| word.parse().ok();
    text.split_ascii_whitespace().map(number).collect()
}

/// The line `-Y 480 +X 640`: the first axis leads from scan line to scan line, the second along them.
fn resolution(line: &[u8]) -> Option<(Orientation, [u32; 2])> {
    let words: Vec<&str> = std::str::from_utf8(line)
        .ok()?
        .split_ascii_whitespace()
        .collect();
    let [across, across_count, along, along_count] = words[..] else {
        return None;
    };
    let (are_columns, x, y) = match (&across.get(1..)?, &along.get(1..)?) {
        (&"Y", &"X") => (false, along, across),
        (&"X", &"Y") => (true, across, along),
        _ => return None,
    };
    let falls = |axis: &str| match axis.as_bytes()[0] {
        b'-' => Some(true),
        b'+' => Some(false),
        _ => None,
    };
    let orientation = Orientation {
        are_columns,
        is_mirrored: falls(x)?,
        is_upward: !falls(y)?,
    };
    let scan = [along_count.parse().ok()?, across_count.parse().ok()?];
    Some((orientation, scan))
}

/// The picture of a file with this header.
///
/// # Errors
/// The file is damaged.
pub(super) fn open(bytes: &[u8], head: Head, unfit: &Unfit) -> Result<Opened, Refused> {
    const CHANNELS: usize = 3;
    let [along, across] = head.scan;
    let count = along as usize * across as usize;
    let mut texels = vec![Vec4::W; count];
    // The decoder knows one orientation and one encoding; what else the header says is applied here.
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {across} +X {along}\n");
    let body = bytes.get(head.body..).unwrap_or_default();
    let decoder = HdrDecoder::new(Cursor::new(plain).chain(body));
    let explain = |error| unfit.explain(error);
    let decoder = decoder.map_err(explain)?;
    let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut texels);
    let colors = &mut floats[..CHANNELS * count];
    (decoder.read_image(bytemuck::cast_slice_mut(colors))).map_err(explain)?;
    // From the end, so that no colour is overwritten before it is moved.
    for index in (0..count).rev() {
        let at = CHANNELS * index;
        let color = Vec3::from_slice(&floats[at..at + CHANNELS]) / head.divisor;
        floats[4 * index..][..4].copy_from_slice(&color.extend(1.0).to_array());
    }
    let [width, height] = head.size();
    let texels = match head.orientation {
        Orientation {
            are_columns: false,
            is_mirrored: false,
            is_upward: false,
        } => texels,
        orientation => (0..count)
            .map(|index| {
                let (x, y) = (index % width as usize, index / width as usize);
                texels[orientation.source([x, y], [width, height], along as usize)]
            })
            .collect(),
    };
    Ok(Opened {
        width,
        height,
        values: Values::Floats(texels),
        has_alpha: false,
        is_premultiplied: false,
        rec709_from_own: head.rec709_from_own,
        ignored: head.ignored,
    })
}

impl Orientation {
    /// The place in scan lines of this length of the texel in a column and row of a picture of this size.
    fn source(self, [x, y]: [usize; 2], [width, height]: [u32; 2], along: usize) -> usize {
        let x = match self.is_mirrored {
            true => width as usize - 1 - x,
            false => x,
        };
        let y = match self.is_upward {
            true => height as usize - 1 - y,
            false => y,
        };
        match self.are_columns {
            true => x * along + y,
            false => y * along + x,
        }
    }
}
