//! How much pictures may differ.

use super::figures::Figures;
use super::rounded;
use crate::args::CompareArgs;
use glimray_app::error::AppError;
use glimray_app::flip;

/// Differences up to these count as equal.
pub struct Limits {
    /// Limit of a pixel's difference, in levels of 1/255.
    pub tolerance: f64,
    /// Limit of the percentage of pixels that differ by more.
    pub max_share: Option<f64>,
    /// Limit of the mean of FLIP.
    pub flip: Option<f64>,
}

impl Limits {
    /// The limits that the flags set. A limit of FLIP alone replaces that of pixels.
    ///
    /// # Errors
    /// FLIP is limited, and the program was built without it.
    pub fn new(arguments: &CompareArgs) -> Result<Self, AppError> {
        let CompareArgs {
            tolerance,
            max_share,
            flip,
            ..
        } = *arguments;
        if let (Some(flip), false) = (flip, cfg!(feature = "flip")) {
            return Err(AppError::Usage(format!(
                "cannot compare by FLIP (--flip {flip}): this program was built without it, the cargo feature `flip`. \
                 Build it with that feature, or use --tolerance and --max-share."
            )));
        }
        let limits_pixels = flip.is_none() || tolerance.is_some() || max_share.is_some();
        Ok(Self {
            tolerance: tolerance.unwrap_or_default(),
            max_share: limits_pixels.then(|| max_share.unwrap_or_default()),
            flip,
        })
    }

    /// Which limits the figures exceed, as sentences without the last full stop.
    pub fn exceeded(&self, figures: &Figures) -> Option<String> {
        let share = figures.beyond_percent;
        let pixels = self.max_share.filter(|most| share > *most).map(|most| {
            format!(
                "{} % of pixels differ by more than {}/255; the limit is {most} %",
                rounded(share),
                self.tolerance
            )
        });
        let mean = figures.flip.map_or(0.0, f64::from);
        let flip = self.flip.filter(|most| mean > *most);
        let flip = flip.map(|most| format!("FLIP is {mean:.6}; the limit is {most}"));
        let parts: Vec<_> = pixels.into_iter().chain(flip).collect();
        (!parts.is_empty()).then(|| parts.join(". "))
    }

    /// Refuses pictures of this size if FLIP is limited, but was not computed.
    pub fn check_flip(&self, figures: &Figures, [width, height]: [u32; 2]) -> Result<(), AppError> {
        match (self.flip, figures.flip) {
            (Some(_), None) => Err(AppError::TooBig(format!(
                "too big for FLIP (--flip): the pictures have {width}×{height} pixels, and the limit is {} in \
                 all. Compare smaller pictures, or use --tolerance and --max-share.",
                flip::MAX_PIXELS
            ))),
            _ => Ok(()),
        }
    }
}
