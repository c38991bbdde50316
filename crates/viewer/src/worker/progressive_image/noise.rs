//! Estimates the noise of a picture.

use glimray_scene::image::Image;

/// Two states of the same picture give its noise: the mean of n samples differs from that of the first m
/// with a variance of σ²(1/m − 1/n), and its own variance is σ²/n.
#[derive(Default)]
pub struct Noise {
    samples: u32,
    levels: Vec<f32>,
    estimate: Option<f64>,
}

impl Noise {
    /// Whether a new estimate is due: each time the samples have doubled.
    pub fn is_due(&self, samples: u32) -> bool {
        samples >= 1.max(2 * self.samples)
    }

    /// Root mean square error of the last state, as a fraction of white.
    pub fn estimate(&self) -> Option<f64> {
        self.estimate
    }

    /// Adds a state of a picture with so many samples.
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
