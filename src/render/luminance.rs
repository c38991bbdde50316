//! Luminance of linear Rec. 709.

/// The weights of red, green and blue, as `LUMINANCE_REC709` in `lib/tone.wesl`.
const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// The luminance of a linear colour.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    WEIGHTS[0] * r + WEIGHTS[1] * g + WEIGHTS[2] * b
}
