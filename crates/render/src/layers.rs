//! The layers of films: the data accumulated for each pixel.
//!
//! To add a layer, add a constant here and list it in [`of_sampling`] and [`of_pictures`]; then add its rows to
//! `add_features` in `shaders/scene/features.wesl`, and its member to [`super::PixelFeatures`]. Memory,
//! film tiles, exact totals, files and merging follow from the table.

use super::{settings::RenderSettings, sums::PixelRows};
use std::ops::Range;

/// One layer of a film.
#[derive(Debug, PartialEq, Eq)]
pub struct Layer {
    /// Name in files.
    pub name: &'static str,
    /// Rows of four numbers for each pixel, at least 1.
    pub rows: usize,
    /// How it is accumulated and developed.
    pub kind: LayerKind,
}

/// How a layer is accumulated and developed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerKind {
    /// Three weighted sums of sample values, and the sum of the weights. Their ratio is developed with the
    /// tone.
    Weighted,
    /// The sum of squared luminance, which decides when a pixel has converged; then the pixel position, and 1.
    /// The layer is not developed.
    Squares,
    /// Three weighted sums, and the sum of their weights or what the layer says.
    Mean,
    /// The sample nearest the pixel's centre: its nearness, 1/(1 + d²) at a distance of d pixels, its
    /// index, and the rest. It is the last layer of a pixel.
    Nearest,
    /// The number of samples, which is known without the GPU; then zeros. It is developed as a grey level.
    Count,
}

/// Linear radiance, or the value of another integrator.
pub const RADIANCE: Layer = Layer {
    name: "radiance",
    rows: 1,
    kind: LayerKind::Weighted,
};

/// The stopping criterion of adaptive sampling.
pub const SQUARES: Layer = Layer {
    name: "squares",
    rows: 1,
    kind: LayerKind::Squares,
};

/// The sample counts of adaptive sampling.
pub const COUNT: Layer = Layer {
    name: "count",
    rows: 1,
    kind: LayerKind::Count,
};

/// The albedo of what is seen, through mirrors and clear glass; of what shines its radiance, both at most 1.
pub const ALBEDO: Layer = mean("albedo");

/// The shading normal of what is seen, in world space; zero where nothing is hit. The weights are those of [`ALBEDO`]. In place
/// of their sum is that of the albedo's squared luminance.
pub const NORMAL: Layer = mean("normal");

/// Light that was scattered once.
pub const DIRECT: Layer = mean("direct");

/// Light that was not scattered.
pub const EMISSION: Layer = mean("emission");

/// The first surface. The rows are: nearness, sample, material and instance; position and depth; texture coordinates,
/// and the lower and the upper half of the primitive's index. Positions are in render space. A film has them in world
/// space, and the object in place of the instance. Numbers of materials and objects count from 1, 0 is none.
pub const FIRST: Layer = Layer {
    name: "first",
    rows: 3,
    kind: LayerKind::Nearest,
};

const fn mean(name: &'static str) -> Layer {
    Layer {
        name,
        rows: 1,
        kind: LayerKind::Mean,
    }
}

/// How much of what lies behind the picture can be seen: see [`super::opacity`]. The rows are: what is seen of nothing, and
/// of shadow catchers; the light on these, the same without shadows, and what the cap of single samples removed.
pub const OPACITY: Layer = Layer {
    name: "opacity",
    rows: 2,
    kind: LayerKind::Mean,
};

/// The noise of opacity, which counts in adaptive sampling. The rows are: the square of the light on shadow catchers, its
/// product with the same without shadows, and the square of that; what a white picture seen instead of nothing adds to the
/// squares of luminance, then the product of both with the part of catchers, and the square of this.
pub const OPACITY_SQUARES: Layer = Layer {
    name: "opacity squares",
    rows: 2,
    kind: LayerKind::Mean,
};

/// Lists of layers without and with opacity.
type Lists = [&'static [&'static Layer]; 2];
const EVEN: Lists = [&[&RADIANCE], &[&RADIANCE, &OPACITY]];
const LISTED: Lists = [
    &[&RADIANCE, &SQUARES],
    &[&RADIANCE, &OPACITY, &OPACITY_SQUARES, &SQUARES],
];
const COUNTED: Lists = [&[&RADIANCE, &COUNT], &[&RADIANCE, &OPACITY, &COUNT]];
const FEATURED: Lists = [
    &[
        &RADIANCE, &SQUARES, &ALBEDO, &NORMAL, &DIRECT, &EMISSION, &FIRST,
    ],
    &[
        &RADIANCE, &OPACITY, &SQUARES, &ALBEDO, &NORMAL, &DIRECT, &EMISSION, &FIRST,
    ],
];
const FEATURED_LISTED: Lists = [
    FEATURED[0],
    &[
        &RADIANCE,
        &OPACITY,
        &OPACITY_SQUARES,
        &SQUARES,
        &ALBEDO,
        &NORMAL,
        &DIRECT,
        &EMISSION,
        &FIRST,
    ],
];
const FEATURED_COUNT: Lists = [
    &[
        &RADIANCE, &SQUARES, &ALBEDO, &NORMAL, &DIRECT, &EMISSION, &COUNT, &FIRST,
    ],
    &[
        &RADIANCE, &OPACITY, &SQUARES, &ALBEDO, &NORMAL, &DIRECT, &EMISSION, &COUNT, &FIRST,
    ],
];

/// The layers on the GPU during sampling, in row order.
pub fn of_sampling(settings: &RenderSettings) -> &'static [&'static Layer] {
    let lists = match (settings.is_adaptive(), settings.has_features()) {
        (true, true) => FEATURED_LISTED,
        (true, false) => LISTED,
        (false, true) => FEATURED,
        (false, false) => EVEN,
    };
    lists[usize::from(settings.has_opacity())]
}

/// The layers of the resulting film.
pub fn of_pictures(settings: &RenderSettings) -> &'static [&'static Layer] {
    let lists = match (settings.is_adaptive(), settings.has_features()) {
        (true, true) => FEATURED_COUNT,
        (true, false) => COUNTED,
        (false, true) => FEATURED,
        (false, false) => EVEN,
    };
    lists[usize::from(settings.has_opacity())]
}

/// The list of layers with these names.
pub fn named(names: &[String]) -> Option<&'static [&'static Layer]> {
    let is_wanted = |list: &&&[&Layer]| list.iter().map(|layer| layer.name).eq(names);
    let lists = [EVEN, COUNTED, FEATURED, FEATURED_COUNT];
    lists.as_flattened().iter().find(is_wanted).copied()
}

/// Total number of rows per pixel.
pub fn rows(layers: &[&Layer]) -> usize {
    layers.iter().map(|layer| layer.rows).sum()
}

/// The rows of a pixel, as sums are added.
pub fn pixel_rows(layers: &[&Layer]) -> PixelRows {
    PixelRows {
        count: rows(layers),
        nearest: row_of(layers, &FIRST),
    }
}

/// The rows of [`OPACITY`] and [`OPACITY_SQUARES`] within a pixel; none if it lacks them.
pub fn rows_of_noisy_opacity(layers: &[&Layer]) -> Range<usize> {
    let squares = row_of(layers, &OPACITY_SQUARES);
    let rows = |first| first - OPACITY.rows..first + OPACITY_SQUARES.rows;
    squares.map_or(0..0, rows)
}

/// The first row of a layer within a pixel.
pub fn row_of(layers: &[&Layer], wanted: &Layer) -> Option<usize> {
    let index = layers.iter().position(|layer| *layer == wanted)?;
    Some(rows(&layers[..index]))
}
