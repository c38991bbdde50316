//! R′G′B′ → Y′CbCr 4:2:0 according to ITU-R BT.709-6, 8 bits, limited range: luma 16 to 235, chroma 16 to
//! 240 around 128. A chroma sample is located midway between two rows, at the left one of two columns: as
//! in MPEG-2, H.264 and Y4M's `420mpeg2`.

use super::Picture8;

/// Three planes of samples, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Planes {
    /// Width of the luma plane; chroma has half of it, rounded up.
    pub width: usize,
    /// Height of the luma plane; chroma has half of it, rounded up.
    pub height: usize,
    /// Luma, Y′.
    pub y: Vec<u8>,
    /// Blue difference, Cb.
    pub u: Vec<u8>,
    /// Red difference, Cr.
    pub v: Vec<u8>,
}

/// Weights of red, green and blue in luma.
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Steps of luma and of chroma per level of 255.
const LUMA_STEP: f64 = 219.0 / 255.0;
const CHROMA_STEP: f64 = 224.0 / 255.0;

const SHIFT: u32 = 20;
const Y: [i32; 3] = fixed(LUMA, LUMA_STEP);
const CB: [i32; 3] = difference(2);
const CR: [i32; 3] = difference(0);

/// `scale` times `weights` in fixed point with `SHIFT` fractional bits.
const fn fixed(weights: [f64; 3], scale: f64) -> [i32; 3] {
    let one = (1 << SHIFT) as f64 * scale;
    [
        (weights[0] * one + 0.5).floor() as i32,
        (weights[1] * one + 0.5).floor() as i32,
        (weights[2] * one + 0.5).floor() as i32,
    ]
}

/// Weights of the chroma of colour `own`: its value less luma, scaled to −1/2 to 1/2. The three weights
/// sum to zero: greys have no chroma.
const fn difference(own: usize) -> [i32; 3] {
    let mut weights = [-LUMA[0], -LUMA[1], -LUMA[2]];
    weights[own] += 1.0;
    let mut fixed = fixed(weights, CHROMA_STEP / (2.0 * (1.0 - LUMA[own])));
    fixed[1] = -fixed[0] - fixed[2];
    fixed
}

fn sample([r, g, b]: [i32; 3], weights: [i32; 3], shift: u32, zero: i32) -> u8 {
    let sum = r * weights[0] + g * weights[1] + b * weights[2];
    (((sum + (1 << (shift - 1))) >> shift) + zero) as u8
}

impl Planes {
    /// The planes of `picture`, whose last column and row are repeated up to `width` and `height` (in
    /// pixels, not less than the image's). Missing rows are black.
    pub fn new(picture: &Picture8, (width, height): (u32, u32)) -> Self {
        let (width, height) = (width as usize, height as usize);
        let chroma_width = width.div_ceil(2);
        let chroma_size = chroma_width * height.div_ceil(2);
        let mut planes = Self {
            width,
            height,
            y: Vec::with_capacity(width * height),
            u: Vec::with_capacity(chroma_size),
            v: Vec::with_capacity(chroma_size),
        };
        let mut sums = vec![[0; 3]; width];
        for top in (0..height).step_by(2) {
            sums.fill([0; 3]);
            for y in [top, top + 1] {
                let row = row(picture, y);
                let padded = (0..width).map(|x| row.get(x).or(row.last()).copied());
                let row = padded.map(|pixel| pixel.unwrap_or_default().map(i32::from));
                for (pixel, sum) in row.zip(&mut sums) {
                    if y < height {
                        planes.y.push(sample(pixel, Y, SHIFT, 16));
                    }
                    *sum = std::array::from_fn(|c| sum[c] + pixel[c]);
                }
            }
            for x in (0..width).step_by(2) {
                let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
                let near = |c| sums[left][c] + 2 * sums[x][c] + sums[right][c];
                let eightfold = std::array::from_fn(near);
                planes.u.push(sample(eightfold, CB, SHIFT + 3, 128));
                planes.v.push(sample(eightfold, CR, SHIFT + 3, 128));
            }
        }
        planes
    }
}

/// Row `y` of the picture, or its last.
fn row(picture: &Picture8, y: usize) -> &[[u8; 3]] {
    let width = picture.width as usize;
    let y = y.min((picture.height as usize).saturating_sub(1));
    picture
        .pixels
        .get(y * width..(y + 1) * width)
        .unwrap_or_default()
}
