//! Letters and lines on a picture of display values.

use glam::DVec2;
use glimray_scene::image::Image;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

const WEIGHT: FontWeight = FontWeight::Regular;
const HEIGHT: RasterHeight = RasterHeight::Size16;

/// Height and width of a letter in pixels.
pub const LETTER_HEIGHT: u32 = HEIGHT.val() as u32;
pub const LETTER_WIDTH: u32 = get_raster_width(WEIGHT, HEIGHT) as u32;

/// Display values.
pub type Color = [f32; 3];

/// Lays `share` of a colour over the pixel in column `x` of row `y`, if there is one.
fn blend(image: &mut Image, x: i64, y: i64, color: Color, share: f32) {
    let is_inside =
        (0..i64::from(image.width)).contains(&x) && (0..i64::from(image.height)).contains(&y);
    if is_inside && share > 0.0 {
        let pixel = &mut image.pixels[y as usize * image.width as usize + x as usize];
        for (value, color) in pixel.iter_mut().zip(color) {
            *value += share * (color - *value);
        }
    }
}

/// Fills the rectangle whose upper left pixel is `corner`.
pub fn fill(image: &mut Image, corner: [u32; 2], [width, height]: [u32; 2], color: Color) {
    for y in corner[1]..corner[1] + height {
        for x in corner[0]..corner[0] + width {
            blend(image, x.into(), y.into(), color, 1.0);
        }
    }
}

/// The number of letters that fit into `width` pixels.
pub fn fitting(width: u32) -> usize {
    (width / LETTER_WIDTH) as usize
}

/// Writes letters to the right of the pixel `corner`, which is their upper left one, as far as they fit into `width`
/// pixels. A question mark stands for others than those of Western European languages.
pub fn write(image: &mut Image, corner: [i64; 2], width: u32, text: &str, color: Color) {
    for (index, letter) in text.chars().take(fitting(width)).enumerate() {
        let of = |letter| get_raster(letter, WEIGHT, HEIGHT);
        let left = corner[0] + index as i64 * i64::from(LETTER_WIDTH);
        let rows = of(letter).or_else(|| of('?')).into_iter();
        for (y, row) in rows.flat_map(|letter| letter.rows()).enumerate() {
            for (x, share) in row.iter().enumerate() {
                let at = [left + x as i64, corner[1] + y as i64];
                blend(image, at[0], at[1], color, f32::from(*share) / 255.0);
            }
        }
    }
}

/// Writes a letter round its middle, with an edge of another colour.
pub fn write_edged(image: &mut Image, middle: DVec2, letter: &str, [color, edge]: [Color; 2]) {
    let size = DVec2::new(LETTER_WIDTH.into(), LETTER_HEIGHT.into());
    let corner = (middle - size / 2.0).round();
    let [x, y] = [corner.x as i64, corner.y as i64];
    for at in [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]] {
        write(image, at, LETTER_WIDTH, letter, edge);
    }
    write(image, [x, y], LETTER_WIDTH, letter, color);
}

/// Draws a line with round ends. A pixel's centre is half a pixel from its corner.
pub fn line(image: &mut Image, [from, to]: [DVec2; 2], width: f64, color: Color) {
    let reach = width / 2.0 + 1.0;
    let (low, high) = (from.min(to) - reach, from.max(to) + reach);
    for y in low.y.floor() as i64..=high.y.ceil() as i64 {
        for x in low.x.floor() as i64..=high.x.ceil() as i64 {
            let at = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - from;
            let way = to - from;
            let along = at.dot(way) / way.length_squared().max(f64::MIN_POSITIVE);
            let distance = (at - along.clamp(0.0, 1.0) * way).length();
            let share = (width / 2.0 + 0.5 - distance).clamp(0.0, 1.0);
            blend(image, x, y, color, share as f32);
        }
    }
}
