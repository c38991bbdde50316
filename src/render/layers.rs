//! The layers of films: what is kept of the samples of a pixel besides their radiance.
//!
//! Another layer is another constant here, a line in [`of_sampling`],
//! and in `shaders/scene/film.wesl` a member of `Sample` and `Sum` with the row that it is
//! loaded from and stored in. Memory, windows, exact totals, files and merging follow from the table.

use super::settings::Settings;

/// One layer of a film.
#[derive(Debug, PartialEq, Eq)]
pub struct Layer {
    /// Its name in files.
    pub name: &'static str,
    /// Rows of four numbers for each pixel, at least 1.
    pub rows: usize,
    /// What its rows are.
    pub kind: LayerKind,
}

/// How a layer comes about, and what becomes of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerKind {
    /// Three sums of what samples bring back times their weights, and the sum of the weights. Their ratio
    /// is developed, through the tone.
    Weighted,
    /// The sum of the squares of luminance, which says when a pixel is good enough; then the pixel's place,
    /// and 1. It is not developed.
    Squares,
}

/// Linear radiance, or what else an integrator brings back.
pub const RADIANCE: Layer = Layer {
    name: "radiance",
    rows: 1,
    kind: LayerKind::Weighted,
};

/// By what adaptive sampling stops.
pub const SQUARES: Layer = Layer {
    name: "squares",
    rows: 1,
    kind: LayerKind::Squares,
};

/// The layers on the GPU while samples are added, in the order of their rows.
pub fn of_sampling(settings: &Settings) -> &'static [&'static Layer] {
    match settings.is_adaptive() {
        true => &[&RADIANCE, &SQUARES],
        false => &[&RADIANCE],
    }
}

/// Rows of all layers together.
pub fn rows(layers: &[&Layer]) -> usize {
    layers.iter().map(|layer| layer.rows).sum()
}

/// The first row of a layer among those of a pixel.
pub fn row_of(layers: &[&Layer], wanted: &Layer) -> Option<usize> {
    let index = layers.iter().position(|layer| *layer == wanted)?;
    Some(rows(&layers[..index]))
}
