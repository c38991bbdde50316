//! The names of settings, as flags, reports and the window's lists show them.

use glimray_render::{self as render, Antialias, BsdfModel, Integrator, TriangleTest};
use glimray_scene::{Filter, ToneCurve, Transfer};

/// The names of one setting's values: each with a description and the value.
pub struct ValueNames<T: 'static>(pub &'static [(&'static str, &'static str, T)]);

/// Where samples lie in a pixel.
pub static ANTIALIAS: ValueNames<Antialias> = ValueNames(&[
    ("none", "all at the pixel centre", Antialias::None),
    (
        "stratified",
        "spread evenly over the pixel",
        Antialias::Stratified,
    ),
    (
        "adaptive",
        "stratified, until --noise is reached, at most --samples",
        Antialias::Adaptive,
    ),
]);

/// Reconstruction filters.
pub static FILTERS: ValueNames<Filter> = ValueNames(&[
    ("box", "constant weight", Filter::Box),
    ("tent", "linear falloff to 0", Filter::Tent),
    (
        "gaussian",
        "Gaussian, standard deviation 0.5 pixels, truncated",
        Filter::Gaussian,
    ),
    (
        "blackman-harris",
        "similar to a Gaussian, falls to 0 at its radius",
        Filter::BlackmanHarris,
    ),
    (
        "mitchell",
        "sharpening, Mitchell and Netravali 1988",
        Filter::Mitchell,
    ),
]);

/// Integrators, from the table of `render`.
pub static INTEGRATORS: ValueNames<Integrator> = ValueNames(&INTEGRATOR_NAMES);

const INTEGRATOR_NAMES: [(&str, &str, Integrator); render::INTEGRATORS.len()] = {
    let mut names = [("", "", Integrator::Whitted); render::INTEGRATORS.len()];
    let mut index = 0;
    while index < names.len() {
        let entry = &render::INTEGRATORS[index];
        names[index] = (entry.name, entry.help, entry.integrator);
        index += 1;
    }
    names
};

/// How metallic-roughness materials scatter.
pub static BSDF_MODELS: ValueNames<BsdfModel> = ValueNames(&[
    (
        "full",
        "with the light that rough surfaces scatter several times",
        BsdfModel::Full,
    ),
    (
        "spec",
        "the formulas of the glTF specification to the letter",
        BsdfModel::Spec,
    ),
]);

/// Ray–triangle intersection algorithms.
pub static TRIANGLE_TESTS: ValueNames<TriangleTest> = ValueNames(&[
    (
        "plane",
        "plane intersection, then a point-in-triangle test",
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
pub static TONES: ValueNames<ToneCurve> = ValueNames(&[
    ("none", "clamp to 0..1", ToneCurve::None),
    ("aces", "filmic, Narkowicz 2015", ToneCurve::Aces),
    ("agx", "filmic, Sobotka's AgX", ToneCurve::Agx),
    ("reinhard", "x / (1 + x) on luminance", ToneCurve::Reinhard),
    (
        "neutral",
        "Khronos PBR Neutral, keeps base colours",
        ToneCurve::Neutral,
    ),
]);

/// Transfer functions.
pub static TRANSFERS: ValueNames<Transfer> = ValueNames(&[
    ("srgb", "IEC 61966-2-1", Transfer::Srgb),
    ("linear", "no transfer function", Transfer::Linear),
]);

impl<T: PartialEq> ValueNames<T> {
    /// The name of `value` in flags and reports.
    pub fn name(&self, value: &T) -> &'static str {
        let mut entries = self.0.iter();
        entries
            .find(|(.., known)| known == value)
            .map_or("unknown", |(name, ..)| name)
    }
}

impl<T: Clone> ValueNames<T> {
    /// Name, help text and value of each entry.
    pub fn all(&self) -> &'static [(&'static str, &'static str, T)] {
        self.0
    }

    /// The value that `name` belongs to.
    pub fn value(&self, name: &str) -> Option<T> {
        let mut entries = self.0.iter();
        let found = entries.find(|(known, ..)| *known == name);
        found.map(|(.., value)| value.clone())
    }
}
