//! The layers of films: what is kept of the samples of a pixel.
//!
//! Another layer is another constant here and its place in [`of_sampling`] and [`of_pictures`]; and in
//! `shaders/scene/film.wesl` a member of `Sample` and of `Sum`, with the row that it is loaded from and stored
//! in. Memory, tiles, exact totals, files and merging follow from the table.

use super::settings::RenderSettings;

/// One layer of a film.
#[derive(Debug, PartialEq, Eq)]
pub struct Layer {
    /// Its name in files.
    pub name: &'static str,
    /// Rows of four numbers for each pixel, at least 1.
    pub rows: usize,
    /// How it comes about, and what becomes of it.
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
    /// How many samples there are, which is known without the GPU; then zeros. It is developed as a grey level.
    Count,
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

/// Where the samples of adaptive sampling went.
pub const COUNT: Layer = Layer {
    name: "count",
    rows: 1,
    kind: LayerKind::Count,
};

/// The layers on the GPU while samples are added, in the order of their rows.
pub fn of_sampling(settings: &RenderSettings) -> &'static [&'static Layer] {
    match settings.is_adaptive() {
        true => &[&RADIANCE, &SQUARES],
        false => &[&RADIANCE],
    }
}

/// The layers of the film that comes of it.
pub fn of_pictures(settings: &RenderSettings) -> &'static [&'static Layer] {
    match settings.is_adaptive() {
        true => &[&RADIANCE, &COUNT],
        false => &[&RADIANCE],
    }
}

/// Every list of layers that a film can have.
const LISTS: &[&[&Layer]] = &[&[&RADIANCE], &[&RADIANCE, &COUNT]];

/// The list of layers with these names.
pub fn named(names: &[String]) -> Option<&'static [&'static Layer]> {
    let is_wanted = |list: &&&[&Layer]| list.iter().map(|layer| layer.name).eq(names);
    LISTS.iter().find(is_wanted).copied()
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
