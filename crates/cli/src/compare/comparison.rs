//! The result of comparing two pictures, as JSON and as text.

use super::figures::Figures;
use super::limits::Limits;
use super::rounded;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// The difference between two pictures of equal size. One level is 1/255.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Comparison {
    /// Path of the first picture.
    pub a: String,
    /// Path of the second picture.
    pub b: String,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Root mean square difference of all channels, for values of 0 to 1; null if it is infinite.
    pub rmse: Option<f64>,
    /// Peak signal-to-noise ratio in decibels; null if it is infinite, as that of equal pictures.
    pub psnr_db: Option<f64>,
    /// Mean of FLIP, 0 (equal) to 1; null for very large pictures, and in a program without the cargo feature `flip`.
    pub flip: Option<f32>,
    /// Largest difference in any channel, in levels; null if it is infinite.
    pub max_levels: Option<f64>,
    /// Column and row of a pixel with the largest difference.
    pub max_at: [u32; 2],
    /// Levels by which pixels may differ.
    pub tolerance_levels: f64,
    /// Percentage of pixels that differ by more.
    pub beyond_percent: f64,
    /// The most of `beyond_percent`; null if only FLIP is limited.
    pub max_share_percent: Option<f64>,
    /// The most of `flip`; null without a limit.
    pub flip_limit: Option<f64>,
    /// Whether a limit is exceeded.
    pub different: bool,
}

impl Comparison {
    pub fn new(
        paths: [&PathBuf; 2],
        [width, height]: [u32; 2],
        figures: &Figures,
        limits: &Limits,
    ) -> Self {
        let [a, b] = paths.map(|path| path.display().to_string());
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        Self {
            a,
            b,
            width,
            height,
            rmse: finite(figures.rmse),
            psnr_db: finite(figures.psnr_db()),
            flip: figures.flip,
            max_levels: finite(figures.max_levels),
            max_at: figures.max_at,
            tolerance_levels: limits.tolerance,
            beyond_percent: figures.beyond_percent,
            max_share_percent: limits.max_share,
            flip_limit: limits.flip,
            different: limits.exceeded(figures).is_some(),
        }
    }

    /// Lines for people.
    pub fn to_text(&self) -> String {
        let [x, y] = self.max_at;
        let flip = self.flip.map_or_else(
            || match cfg!(feature = "flip") {
                true => "not computed: too many pixels".to_owned(),
                false => "not computed: built without the feature `flip`".to_owned(),
            },
            |flip| format!("{flip:.6}"),
        );
        let [rmse, max_levels] = [self.rmse, self.max_levels].map(or_infinite);
        let (width, height, levels) = (self.width, self.height, rmse * 255.0);
        format!(
            "size      {width}×{height} pixels\n\
             RMSE      {rmse:.6} ({levels:.3} levels)\n\
             PSNR      {:.2} dB\n\
             FLIP      {flip}\n\
             largest   {} levels at {x},{y}\n\
             beyond    {} % of pixels differ by more than {} levels\n",
            self.psnr(),
            rounded(max_levels),
            rounded(self.beyond_percent),
            self.tolerance_levels,
        )
    }

    /// RMSE, PSNR, FLIP, the largest difference in levels, and the percentage of pixels beyond the tolerance, as the
    /// cells of a table.
    pub fn to_cells(&self) -> [String; 5] {
        [
            format!("{:.6}", or_infinite(self.rmse)),
            format!("{:.2} dB", self.psnr()),
            self.flip.map_or("-".into(), |flip| format!("{flip:.6}")),
            format!("{}", rounded(or_infinite(self.max_levels))),
            format!("{} %", rounded(self.beyond_percent)),
        ]
    }

    /// In decibels.
    fn psnr(&self) -> f64 {
        match (self.rmse, self.psnr_db) {
            (_, Some(decibels)) => decibels,
            (Some(_), None) => f64::INFINITY,
            (None, None) => f64::NEG_INFINITY,
        }
    }
}

fn or_infinite(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::INFINITY)
}
