//! Frames per second.

use std::fmt;

/// Frames per second as a fraction, so that 23.976 is exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FrameRate {
    /// Frames, at least 1.
    pub numerator: u32,
    /// Per this many seconds, at least 1.
    pub denominator: u32,
}

impl FrameRate {
    /// 24 frames per second.
    pub const FILM: Self = Self {
        numerator: 24,
        denominator: 1,
    };

    /// NTSC rates are 1000/1001 of these.
    const NTSC: [u32; 5] = [24, 30, 48, 60, 120];

    /// A rate within this distance of an NTSC rate, in frames per second, is taken as that rate: 23.98
    /// and 29.97 are common spellings.
    const NTSC_ROUNDING: f64 = 0.005;

    const MAX_DENOMINATOR: u32 = 1001;

    /// The rate nearest to `rate` frames per second: an NTSC rate if the decimals match, otherwise the
    /// nearest fraction with a denominator of at most 1001. `None` for NaN and for rates below 1/1001 or
    /// above 1000.
    pub fn from_f64(rate: f64) -> Option<Self> {
        if !(1.0 / f64::from(Self::MAX_DENOMINATOR)..=1000.0).contains(&rate) {
            return None;
        }
        let ntsc = Self::NTSC.map(|whole| Self {
            numerator: whole * 1000,
            denominator: 1001,
        });
        let is_meant = |ntsc: &Self| (ntsc.as_f64() - rate).abs() < Self::NTSC_ROUNDING;
        if let Some(rate) = ntsc.into_iter().find(is_meant) {
            return Some(rate);
        }
        let nearest = |denominator: u32| Self {
            numerator: (rate * f64::from(denominator)).round().max(1.0) as u32,
            denominator,
        };
        let error = |fraction: &Self| (fraction.as_f64() - rate).abs();
        // The first of equal fractions has the lowest terms.
        (1..=Self::MAX_DENOMINATOR)
            .map(nearest)
            .min_by(|a, b| error(a).total_cmp(&error(b)))
    }

    /// Frames per second.
    pub fn as_f64(self) -> f64 {
        let (frames, seconds) = self.parts();
        f64::from(frames) / f64::from(seconds)
    }

    /// Numerator and denominator; the denominator is at least 1 whatever the fields hold.
    pub(super) fn parts(self) -> (u32, u32) {
        (self.numerator.max(1), self.denominator.max(1))
    }
}

impl fmt::Display for FrameRate {
    /// As `24` or `30000/1001`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.parts() {
            (frames, 1) => write!(f, "{frames}"),
            (frames, seconds) => write!(f, "{frames}/{seconds}"),
        }
    }
}
