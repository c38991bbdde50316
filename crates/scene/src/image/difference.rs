//! The difference of two images as a screen shows them.

use super::ScreenImage;

/// An image, and the part of a picture that it covers.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The image.
    pub image: &'a ScreenImage,
    /// Edges of the image as fractions of the picture's width and height: left, top, right, bottom. They may lie
    /// outside the picture.
    pub edges: [f64; 4],
}

/// The difference of two images.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The absolute difference of every colour channel, multiplied by the gain; opaque. Black where one of the
    /// images has no opaque pixel.
    pub image: ScreenImage,
    /// Root mean square difference of the colour channels, without the gain, in 0..=1; 0 without common pixels.
    pub rmse: f64,
    /// Mean absolute difference of the same channels.
    pub mean: f64,
}

impl Difference {
    /// Compares the pixels of `first` with those of `second`, which is interpolated linearly where its pixels lie
    /// elsewhere.
    pub fn new(first: Placed, second: Placed, gain: f32) -> Self {
        let (width, height) = (first.image.width, first.image.height);
        let (columns, rows) = (first.axis(0), first.axis(1));
        let columns: Vec<_> = (0..width).map(|x| columns.on(&second, 0, x)).collect();
        let mut pixels = Vec::with_capacity(first.image.pixels.len());
        let (mut squares, mut sum, mut count) = (0.0, 0.0, 0_u64);
        let lines = first.image.pixels.chunks_exact(width.max(1) as usize);
        for (y, line) in (0..height).zip(lines) {
            let row = rows.on(&second, 1, y);
            for (pixel, column) in line.iter().zip(&columns) {
                let other = row.zip(*column).and_then(|(row, column)| {
                    let color = second.image.interpolated(column, row)?;
                    (pixel[3] == u8::MAX).then_some(color)
                });
                let Some(other) = other else {
                    pixels.push([0, 0, 0, u8::MAX]);
                    continue;
                };
                let [r, g, b] = [0, 1, 2].map(|channel| {
                    let off = (f32::from(pixel[channel]) - other[channel]).abs();
                    squares += f64::from(off).powi(2);
                    sum += f64::from(off);
                    (off * gain).round() as u8
                });
                count += 3;
                pixels.push([r, g, b, u8::MAX]);
            }
        }
        let count = count.max(1) as f64;
        Self {
            image: ScreenImage {
                width,
                height,
                pixels,
            },
            rmse: (squares / count).sqrt() / 255.0,
            mean: sum / count / 255.0,
        }
    }
}

/// The edges and the number of pixels of an image along one axis.
struct Axis {
    start: f64,
    end: f64,
    length: u32,
}

/// Two neighbouring pixels along an axis, and the weight of the second.
type Between = (usize, usize, f32);

impl Axis {
    /// The pixels of `other` at the centre of a pixel of this axis; `None` outside.
    fn on(&self, other: &Placed, axis: usize, pixel: u32) -> Option<Between> {
        let share = (f64::from(pixel) + 0.5) / f64::from(self.length);
        let position = self.start + share * (self.end - self.start);
        let other = other.axis(axis);
        let place = (position - other.start) / (other.end - other.start);
        if !(0.0..1.0).contains(&place) {
            return None;
        }
        let last = f64::from(other.length - 1);
        let place = (place * f64::from(other.length) - 0.5).clamp(0.0, last);
        // Rounding must not mix neighbours where pixels coincide.
        let near = place.round();
        let place = if (place - near).abs() < 1e-6 {
            near
        } else {
            place
        };
        let first = place.floor();
        Some((
            first as usize,
            place.ceil() as usize,
            (place - first) as f32,
        ))
    }
}

impl Placed<'_> {
    fn axis(&self, axis: usize) -> Axis {
        Axis {
            start: self.edges[axis],
            end: self.edges[axis + 2],
            length: [self.image.width, self.image.height][axis],
        }
    }
}

impl ScreenImage {
    /// The colour between four pixels, in levels of 255; `None` unless all of them are opaque.
    fn interpolated(&self, column: Between, row: Between) -> Option<[f32; 3]> {
        let ((left, right, across), (top, bottom, down)) = (column, row);
        let pixel = |x: usize, y: usize| {
            let pixel = self.pixels.get(y * self.width as usize + x);
            pixel.filter(|pixel| pixel[3] == u8::MAX)
        };
        let corners = [
            pixel(left, top)?,
            pixel(right, top)?,
            pixel(left, bottom)?,
            pixel(right, bottom)?,
        ];
        let mix = |a: f32, b: f32, share: f32| a + (b - a) * share;
        Some([0, 1, 2].map(|channel| {
            let [a, b, c, d] = corners.map(|corner| f32::from(corner[channel]));
            mix(mix(a, b, across), mix(c, d, across), down)
        }))
    }
}
