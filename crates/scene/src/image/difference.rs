//! The difference of two images as a screen shows them.

use super::{Image, ScreenImage};

/// An image, and the part of a picture that it covers.
#[derive(Debug)]
pub struct Placed<'a, I = ScreenImage> {
    /// The image.
    pub image: &'a I,
    /// Edges of the image as fractions of the picture's width and height: left, top, right, bottom. They may lie
    /// outside the picture.
    pub edges: [f64; 4],
}

impl<I> Clone for Placed<'_, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I> Copy for Placed<'_, I> {}

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
        let (mut squares, mut sum, mut count) = (0.0, 0.0, 0_u64);
        let paint = |pair: Option<[[f32; 3]; 2]>| {
            let Some([first, second]) = pair else {
                return [0, 0, 0, u8::MAX];
            };
            let [r, g, b] = [0, 1, 2].map(|channel| {
                let off = (first[channel] - second[channel]).abs();
                squares += f64::from(off).powi(2);
                sum += f64::from(off);
                (off * gain).round() as u8
            });
            count += 3;
            [r, g, b, u8::MAX]
        };
        let pixels = pairs(first, second).into_iter().map(paint).collect();
        let count = count.max(1) as f64;
        Self {
            image: ScreenImage {
                width: first.image.width,
                height: first.image.height,
                pixels,
            },
            rmse: (squares / count).sqrt() / 255.0,
            mean: sum / count / 255.0,
        }
    }
}

/// An image whose pixels can be compared with those of another.
pub trait Pixels {
    /// Width and height in pixels.
    fn size(&self) -> [u32; 2];

    /// The colour of a pixel, counted row by row from the top left; `None` unless it is opaque.
    fn opaque(&self, index: usize) -> Option<[f32; 3]>;
}

impl Pixels for ScreenImage {
    fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// In levels of 255.
    fn opaque(&self, index: usize) -> Option<[f32; 3]> {
        let &[r, g, b, opacity] = self.pixels.get(index)?;
        (opacity == u8::MAX).then(|| [r, g, b].map(f32::from))
    }
}

impl Pixels for Image {
    fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    fn opaque(&self, index: usize) -> Option<[f32; 3]> {
        let &[r, g, b, opacity] = self.pixels.get(index)?;
        (opacity >= 1.0).then_some([r, g, b])
    }
}

/// The colours of both images at each pixel of the first, row by row; the second is interpolated linearly. `None` where one of
/// them has no opaque pixel.
pub fn pairs<I: Pixels>(first: Placed<I>, second: Placed<I>) -> Vec<Option<[[f32; 3]; 2]>> {
    let [width, height] = first.image.size();
    let (columns, rows) = (first.axis(0), first.axis(1));
    let columns: Vec<_> = (0..width).map(|x| columns.on(&second, 0, x)).collect();
    let mut found = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let row = rows.on(&second, 1, y);
        for column in &columns {
            let own = first.image.opaque(found.len());
            let pair = own.zip(row.zip(*column)).and_then(|(own, (row, column))| {
                Some([own, interpolated(second.image, column, row)?])
            });
            found.push(pair);
        }
    }
    found
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
    fn on<I: Pixels>(&self, other: &Placed<I>, axis: usize, pixel: u32) -> Option<Between> {
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

impl<I: Pixels> Placed<'_, I> {
    fn axis(&self, axis: usize) -> Axis {
        Axis {
            start: self.edges[axis],
            end: self.edges[axis + 2],
            length: self.image.size()[axis],
        }
    }
}

/// The colour between four pixels; `None` unless all of them are opaque.
fn interpolated(image: &impl Pixels, column: Between, row: Between) -> Option<[f32; 3]> {
    let ((left, right, across), (top, bottom, down)) = (column, row);
    let [width, _] = image.size();
    let pixel = |x: usize, y: usize| image.opaque(y * width as usize + x);
    let corners = [
        pixel(left, top)?,
        pixel(right, top)?,
        pixel(left, bottom)?,
        pixel(right, bottom)?,
    ];
    let mix = |a: f32, b: f32, share: f32| a + (b - a) * share;
    Some([0, 1, 2].map(|channel| {
        let [a, b, c, d] = corners.map(|corner| corner[channel]);
        mix(mix(a, b, across), mix(c, d, across), down)
    }))
}
