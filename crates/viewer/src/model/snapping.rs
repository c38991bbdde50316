//! Whole steps: of the grid, of angles and of factors.

/// The least distance of two lines of the grid, in points of the screen.
pub const LEAST: f64 = 14.0;

/// The distance of grid lines where a point of the screen is `length` scene units long.
pub fn grid_step(length: f64) -> f64 {
    10_f64.powf((LEAST * length).log10().ceil())
}

/// How a drag is rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Snap {
    /// Not at all.
    #[default]
    Off,
    /// To whole steps: of the grid at that distance, 15°, or 0.1.
    Whole,
    /// To finer steps: a tenth of the grid, 5°, or 0.01.
    Fine,
}

impl Snap {
    /// A number rounded to steps of these sizes.
    pub fn round(self, value: f64, whole: f64, fine: f64) -> f64 {
        let step = match self {
            Self::Off => return value,
            Self::Whole => whole,
            Self::Fine => fine,
        };
        (value / step).round() * step
    }
}
