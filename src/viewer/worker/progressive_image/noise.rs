//! How far a picture may be from what it tends to.

use crate::image::Image;

/// Two looks at the same picture tell its noise: of n samples the mean differs from that of the first
/// m by a variance of σ²(1/m − 1/n), and its own is σ²/n.
#[derive(Default)]
pub struct Noise {
    samples: u32,
    levels: Vec<f32>,
    estimate: Option<f64>,
}

impl Noise {
    /// Whether another look is worth its time: each time the samples have doubled.
    pub fn is_due(&self, samples: u32) -> bool {
        samples >= 1.max(2 * self.samples)
    }

    /// Root mean square error of the picture that was looked at last, in levels of 1.
    pub fn estimate(&self) -> Option<f64> {
        self.estimate
    }

    /// Takes a look at a picture of so many samples.
    pub fn look(&mut self, image: &Image, samples: u32) {
        let level = |[r, g, b, _]: &[f32; 4]| {
            [r, g, b]
                .into_iter()
                .map(|v| v.clamp(0.0, 1.0))
                .sum::<f32>()
                / 3.0
        };
        let levels: Vec<f32> = image.pixels.iter().map(level).collect();
        if self.levels.len() == levels.len() && self.samples > 0 {
            let squares = (levels.iter().zip(&self.levels))
                .map(|(now, before)| f64::from(now - before).powi(2));
            let mean = squares.sum::<f64>() / levels.len() as f64;
            let growth = f64::from(samples) / f64::from(self.samples) - 1.0;
            self.estimate = Some((mean / growth).sqrt());
        }
        self.samples = samples;
        self.levels = levels;
    }
}
