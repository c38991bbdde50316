//! The histogram of a picture as the window shows it.

/// Levels of a channel.
pub const LEVELS: usize = 256;

/// Rec. 709 weights of red, green and blue.
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// The distribution of displayed colours. Pixels that are not opaque are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Histogram {
    /// Number of pixels at each level of red, green, blue and luminance. Luminance is the weighted mean of the
    /// encoded channels.
    pub channels: [[u32; LEVELS]; 4],
    /// Number of pixels.
    pub pixels: u32,
    /// Number of pixels whose channels are all 0.
    pub black: u32,
    /// Number of pixels with a channel at 255.
    pub white: u32,
}

impl Histogram {
    /// Counts red, green, blue and opacity of each pixel.
    pub fn new(pixels: &[[u8; 4]]) -> Self {
        let mut histogram = Self {
            channels: [[0; LEVELS]; 4],
            pixels: 0,
            black: 0,
            white: 0,
        };
        for &[red, green, blue, opacity] in pixels {
            if opacity < u8::MAX {
                continue;
            }
            let colors = [red, green, blue];
            let luminance: f32 = (colors.iter().zip(LUMINANCE))
                .map(|(level, weight)| f32::from(*level) * weight)
                .sum();
            let levels = [red, green, blue, luminance.round() as u8];
            for (channel, level) in histogram.channels.iter_mut().zip(levels) {
                channel[usize::from(level)] += 1;
            }
            histogram.pixels += 1;
            histogram.black += u32::from(colors == [0; 3]);
            histogram.white += u32::from(colors.contains(&u8::MAX));
        }
        histogram
    }

    /// Fractions of black and of white pixels, 0 to 1.
    pub fn clipped(&self) -> [f64; 2] {
        [self.black, self.white].map(|count| f64::from(count) / f64::from(self.pixels.max(1)))
    }

    /// The mean luminance of the displayed colours, 0 to 1.
    pub fn mean_luminance(&self) -> f64 {
        let counts = self.channels[3].iter().enumerate();
        let sum: f64 = counts.map(|(level, n)| level as f64 * f64::from(*n)).sum();
        sum / f64::from(self.pixels.max(1)) / 255.0
    }

    /// The height of every bar, 0 to 1, linear or logarithmic in the number of pixels. Clipped pixels may exceed
    /// the scale, so that they do not flatten the rest.
    pub fn heights(&self, is_logarithmic: bool) -> [[f32; LEVELS]; 4] {
        let most = |levels: &dyn Fn(&[u32; LEVELS]) -> Option<u32>| {
            self.channels.iter().filter_map(levels).max().unwrap_or(0)
        };
        let most = match most(&|channel| channel[1..LEVELS - 1].iter().max().copied()) {
            0 => most(&|channel| channel.iter().max().copied()),
            most => most,
        };
        let scale = |count: u32| match is_logarithmic {
            true => f64::from(count).ln_1p(),
            false => f64::from(count),
        };
        let full = scale(most.max(1));
        (self.channels).map(|channel| channel.map(|count| (scale(count) / full).min(1.0) as f32))
    }
}
