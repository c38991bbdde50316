//! Automatic exposure: the exposure that makes the average of a picture a medium grey, by the log-average of its
//! luminance (Reinhard, Stark, Shirley, Ferwerda 2002, Photographic Tone Reproduction for Digital Images, section 3.1).

use super::{RenderError, Renderer, Tone, luminance::luminance};

/// The luminance that the average becomes: a medium grey.
const KEY: f64 = 0.18;

/// Luminances are counted in steps of this fraction of a stop. Sums of whole numbers do not depend on the order of the
/// pixels, so films in any tiles and parts have the same exposure.
const STEPS: f64 = 64.0;

/// The stops around 1 that are told apart.
const MOST_STOPS: f64 = 64.0;

/// The share of the pixels that is left out at either end: lamps and what lies in the dark.
const OUTLIERS: f64 = 0.05;

impl Tone {
    /// The tone with a fixed exposure. `rows` are sums of radiance, weighted by their fourth component.
    pub(super) fn exposed<'a, I>(&self, rows: impl FnOnce() -> I) -> Self
    where
        I: Iterator<Item = &'a [f32; 4]>,
    {
        match self.auto_exposure {
            true => self.fixed(average_exposure(rows())),
            false => *self,
        }
    }

    /// The tone with a fixed exposure where that of the average is this, in stops.
    fn fixed(&self, average: f32) -> Self {
        Self {
            exposure_ev: self.exposure_ev + average,
            auto_exposure: false,
            ..*self
        }
    }
}

impl Renderer {
    /// The tone with a fixed exposure, for the samples so far.
    pub(super) async fn exposed(&mut self, tone: &Tone) -> Result<Tone, RenderError> {
        match tone.auto_exposure {
            true => Ok(tone.fixed(self.exposure_async().await?)),
            false => Ok(*tone),
        }
    }

    /// The exposure in stops that makes the average of the picture so far a medium grey: 0.18. The average is that of
    /// the logarithm of luminance, without the darkest and the brightest 5 % of the pixels that are not black. 0 for a
    /// black picture.
    ///
    /// # Errors
    /// The device failed during readback of the film.
    pub async fn exposure_async(&mut self) -> Result<f32, RenderError> {
        self.fetch_film().await?;
        let tiles = self.tiles.developable(self.policy.slicing.tile_side);
        let rows =
            (tiles.iter()).flat_map(|(tile, rows)| rows.iter().step_by(tile.rows_per_pixel()));
        Ok(average_exposure(rows))
    }
}

/// The exposure for sums of radiance, weighted by their fourth component.
fn average_exposure<'a>(rows: impl Iterator<Item = &'a [f32; 4]>) -> f32 {
    let mut counts = vec![0_u64; (2.0 * MOST_STOPS * STEPS) as usize];
    for &[r, g, b, weight] in rows {
        let luminance = luminance([r, g, b].map(f64::from)) / f64::from(weight);
        // Padding and pixels without samples have no weight, which gives no number.
        if luminance > 0.0 && luminance.is_finite() {
            let step = (STEPS * (luminance.log2() + MOST_STOPS)).round();
            let last = counts.len() - 1;
            counts[(step.max(0.0) as usize).min(last)] += 1;
        }
    }
    let total: u64 = counts.iter().sum();
    let skipped = (total as f64 * OUTLIERS) as u64;
    let (mut sum, mut passed) = (0_i128, 0);
    for (step, &count) in counts.iter().enumerate() {
        // Pixels of this step that are neither among the first nor among the last ones.
        let first = skipped.max(passed);
        passed += count;
        let inside = passed.min(total - skipped).saturating_sub(first);
        sum += i128::from(inside) * step as i128;
    }
    match total - 2 * skipped {
        0 => 0.0,
        count => {
            let mean = sum as f64 / count as f64 / STEPS - MOST_STOPS;
            (KEY.log2() - mean) as f32
        }
    }
}
