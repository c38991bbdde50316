//! Views of quantities (distances, samples, traversal steps) and the range over which they are shown.

use super::{RenderError, Renderer, Tone};

/// Minimum fraction of hits among the samples of a pixel, as in `lib/quantity.wesl`.
const LEAST_COVERAGE: f32 = 0.01;

/// The range over which a view of a quantity is shown. Other pictures are not affected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Levels {
    /// No range: values are developed like radiance.
    #[default]
    Raw,
    /// Over the range found in the picture so far: [`Renderer::range`].
    Found,
    /// From the first of these values to the second.
    Fixed([f32; 2]),
}

/// The quantity that a view measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Distance along the ray in scene units, on a logarithmic scale from white for the nearest to dark grey
    /// for the farthest; black without a hit.
    Distance,
    /// Samples of a pixel, from black for the fewest to white for the most.
    Samples,
    /// Traversal steps of a ray: black, blue, green, yellow, red, white.
    Work,
}

impl Quantity {
    /// Fraction of the pixels excluded from the range at both ends: otherwise a horizon, or a few expensive
    /// rays along an edge, would leave no levels for the rest.
    pub fn outliers(self) -> f64 {
        match self {
            Self::Distance => 0.02,
            Self::Samples => 0.0,
            Self::Work => 0.002,
        }
    }

    /// The unit of its values, in the plural.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Distance => "scene units",
            Self::Samples => "samples",
            Self::Work => "steps",
        }
    }
}

/// The position of a value in a range, from 0 to 1; 0.5 for an empty range.
pub(super) fn position_in_range(value: f32, [least, most]: [f32; 2]) -> f32 {
    match most > least {
        true => ((value - least) / (most - least)).clamp(0.0, 1.0),
        false => 0.5,
    }
}

impl Renderer {
    /// The minimum and maximum in the picture so far, without [`Quantity::outliers`]. `None` if the integrator
    /// shows no quantity or there is no value yet. Pixels without a hit have no distance.
    ///
    /// # Errors
    /// The device failed during readback of the film.
    pub async fn range_async(&mut self) -> Result<Option<[f32; 2]>, RenderError> {
        let Some(quantity) = self.settings.integrator.quantity() else {
            return Ok(None);
        };
        if quantity == Quantity::Samples {
            return Ok(extent(self.counts(), quantity));
        }
        self.fetch_film().await?;
        let tiles = self.tiles.developable(self.policy.slicing.tile_side);
        let rows = tiles
            .iter()
            .flat_map(|(tile, rows)| rows.iter().step_by(tile.rows_per_pixel()));
        Ok(extent(values(quantity, rows), quantity))
    }

    /// The samples of each pixel, row by row.
    pub(super) fn counts(&self) -> Vec<f32> {
        let [x, y, width, height] = self.settings.region();
        let pixels = (y..y + height).flat_map(|y| (x..x + width).map(move |x| [x, y]));
        pixels
            .map(|pixel| self.tiles.samples_at(pixel) as f32)
            .collect()
    }

    /// The range for a tone.
    pub(super) async fn range_of(&mut self, tone: &Tone) -> Result<Option<[f32; 2]>, RenderError> {
        match tone.levels {
            Levels::Raw => Ok(None),
            Levels::Found => self.range_async().await,
            Levels::Fixed(range) => Ok((self.settings.integrator.quantity()).map(|_| range)),
        }
    }
}

/// The values of all pixels that have one, from their film rows.
pub(super) fn values<'a>(quantity: Quantity, rows: impl Iterator<Item = &'a [f32; 4]>) -> Vec<f32> {
    let value = |[value, hits, _, weight]: &[f32; 4]| {
        // Padding and pixels without samples have no weight.
        let is_sampled = weight.abs() > 0.5;
        let hits = hits / weight;
        match quantity {
            Quantity::Distance => {
                (is_sampled && hits >= LEAST_COVERAGE).then(|| value / weight / hits)
            }
            Quantity::Samples | Quantity::Work => is_sampled.then(|| value / weight),
        }
    };
    rows.filter_map(value).collect()
}

/// The minimum and maximum, without [`Quantity::outliers`].
pub(super) fn extent(mut values: Vec<f32>, quantity: Quantity) -> Option<[f32; 2]> {
    let last = values.len().checked_sub(1)?;
    let skipped = (values.len() as f64 * quantity.outliers()) as usize;
    let mut nth = |index| *values.select_nth_unstable_by(index, f32::total_cmp).1;
    Some([nth(skipped), nth(last - skipped)])
}
