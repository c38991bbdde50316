//! The names of settings, as flags, reports and the window's lists show them.

use crate::render::{self, Antialias, Integrator, TriangleTest};
use crate::scene::{Filter, ToneCurve, Transfer};

/// The names of one setting's values: each with a description and the value.
pub struct Words<T: 'static>(pub &'static [(&'static str, &'static str, T)]);

/// Where samples lie in a pixel.
pub static ANTIALIAS: Words<Antialias> = Words(&[
    ("none", "all in the pixel's centre", Antialias::None),
    (
        "stratified",
        "well spread over the pixel",
        Antialias::Stratified,
    ),
    (
        "adaptive",
        "the same, until --noise is reached, up to --samples",
        Antialias::Adaptive,
    ),
]);

/// Reconstruction filters.
pub static FILTERS: Words<Filter> = Words(&[
    ("box", "all alike", Filter::Box),
    ("tent", "linearly down to nothing", Filter::Tent),
    (
        "gaussian",
        "a normal distribution of half a pixel, cut",
        Filter::Gaussian,
    ),
    (
        "blackman-harris",
        "much like it, ends in nothing",
        Filter::BlackmanHarris,
    ),
    (
        "mitchell",
        "sharpens: Mitchell and Netravali 1988",
        Filter::Mitchell,
    ),
]);

/// Integrators, from the table of `render`.
pub static INTEGRATORS: Words<Integrator> = Words(&INTEGRATOR_WORDS);

const INTEGRATOR_WORDS: [(&str, &str, Integrator); render::INTEGRATORS.len()] = {
    let mut words = [("", "", Integrator::Whitted); render::INTEGRATORS.len()];
    let mut index = 0;
    while index < words.len() {
        let entry = &render::INTEGRATORS[index];
        words[index] = (entry.name, entry.help, entry.integrator);
        index += 1;
    }
    words
};

/// Ray–triangle intersection algorithms.
pub static TRIANGLE_TESTS: Words<TriangleTest> = Words(&[
    (
        "plane",
        "ray and plane, then inside or not",
        TriangleTest::Plane,
    ),
    (
        "moller-trumbore",
        "Möller and Trumbore 1997",
        TriangleTest::MollerTrumbore,
    ),
    (
        "watertight",
        "Woop, Benthin and Wald 2013",
        TriangleTest::Watertight,
    ),
]);

/// Tone curves.
pub static TONES: Words<ToneCurve> = Words(&[
    ("none", "clamp", ToneCurve::None),
    ("aces", "filmic, Narkowicz 2015", ToneCurve::Aces),
    ("agx", "filmic, Sobotka's AgX", ToneCurve::Agx),
    ("reinhard", "x / (1 + x) on luminance", ToneCurve::Reinhard),
]);

/// Transfer functions.
pub static TRANSFERS: Words<Transfer> = Words(&[
    ("srgb", "IEC 61966-2-1", Transfer::Srgb),
    ("linear", "stored as is", Transfer::Linear),
]);

impl<T: PartialEq> Words<T> {
    /// The word for `value`, as flags and reports have it.
    pub fn word(&self, value: &T) -> &'static str {
        let mut words = self.0.iter();
        words
            .find(|(.., known)| known == value)
            .map_or("unknown", |(word, ..)| word)
    }
}

impl<T: Clone> Words<T> {
    /// All words, each with what it does and what it stands for.
    pub fn all(&self) -> &'static [(&'static str, &'static str, T)] {
        self.0
    }

    /// What `word` stands for.
    pub fn value(&self, word: &str) -> Option<T> {
        let mut words = self.0.iter();
        let found = words.find(|(known, ..)| *known == word);
        found.map(|(.., value)| value.clone())
    }
}
