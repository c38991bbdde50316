//! The steps of a path along its rays: the light samples at its surfaces, the directions that it chooses, and how
//! the two ways to find a light share it.

use crate::layout::{
    LOBE_COAT, LOBE_DIFFUSE, LOBE_GLOSSY, LOBE_SHEEN, PackedRay, RAY_UNTRACED, SOURCE_EMITTER,
    SOURCE_LIGHT, STEP_LIMIT, STEP_PASSED, STEP_ROULETTE, STEP_SCATTERED,
};
use glimray_scene::ObjectRef;
use schemars::JsonSchema;
use serde::Serialize;

/// How a path goes on at the surface that a ray hit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PathStep {
    /// What becomes of the path.
    pub outcome: StepOutcome,
    /// The lobe in which it chose its direction; `None` in a hole.
    pub lobe: Option<Lobe>,
    /// BSDF of this direction times the cosine to the normal, per steradian; `None` if there was no choice.
    pub bsdf: Option<[f32; 3]>,
    /// Density of this direction over all lobes, per steradian; `None` if there was no choice, as in a smooth mirror.
    pub pdf: Option<f32>,
    /// The factor on the throughput: `bsdf / pdf`, or what a smooth boundary reflects or transmits.
    pub weight: [f32; 3],
    /// The chance with which Russian roulette lets it go on; 1 without roulette.
    pub survival: f32,
    /// The throughput of the next ray, `arriving · weight / survival`; 0 if the path ends.
    pub throughput: [f32; 3],
}

/// What becomes of a path at a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StepOutcome {
    /// It goes on in the direction that it chose.
    Scattered,
    /// It goes straight on: through a hole, a smooth thin wall, or between equal media.
    Passed,
    /// Russian roulette ended it.
    Roulette,
    /// The limit of bounces ended it.
    Limit,
    /// It ended because nothing is reflected in the direction that it chose.
    Absorbed,
}

/// A part of a surface that scatters light in its own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Lobe {
    /// Reflects or transmits light in all directions.
    Diffuse,
    /// Microfacets of a metal or over a body.
    Glossy,
    /// A clear coat.
    Coat,
    /// A sheen, as of cloth.
    Sheen,
    /// A mirror or glass, smooth or rough.
    Boundary,
}

/// How light samples and the directions of paths share the light that a ray found: the power heuristic of Veach
/// and Guibas (1995). Densities are per steradian.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sharing {
    /// The density with which a light sample has this direction; `None` if paths cannot find the light by
    /// themselves, or light samples do not find it.
    pub light_pdf: Option<f32>,
    /// The density with which a path chooses this direction; `None` if it had no choice.
    pub bsdf_pdf: Option<f32>,
    /// The weight of a light sample in this direction.
    pub light_weight: f32,
    /// The weight of a path in this direction.
    pub bsdf_weight: f32,
}

/// The light sample at a surface.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LightSample {
    /// What it chose.
    pub source: LightSource,
    /// The emissive object, for [`LightSource::Emitter`].
    pub emitter: Option<ObjectRef>,
    /// The name of this object, if it has one.
    pub emitter_name: Option<String>,
    /// Index of the emissive triangle on the GPU.
    pub primitive: Option<u32>,
    /// The chance of this light or triangle, or of the background.
    pub chance: f32,
    /// Linear radiance that arrives without shadow, divided by the density of the sample; for lights without
    /// extent by their chance.
    pub radiance: [f32; 3],
    /// BSDF of its direction times the cosine to the normal, per steradian.
    pub bsdf: [f32; 3],
    /// Whether a shadow ray was traced. It is not if the surface scatters nothing of this light.
    pub traced: bool,
}

/// What a light sample chose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LightSource {
    /// A light of the scene.
    Light,
    /// An emissive triangle.
    Emitter,
    /// A direction to the background.
    Environment,
}

impl PathStep {
    pub(super) fn of(record: &PackedRay) -> Self {
        let outcome = match record.step {
            STEP_SCATTERED => StepOutcome::Scattered,
            STEP_PASSED => StepOutcome::Passed,
            STEP_ROULETTE => StepOutcome::Roulette,
            STEP_LIMIT => StepOutcome::Limit,
            _ => StepOutcome::Absorbed,
        };
        let lobe = match record.lobe {
            LOBE_DIFFUSE => Lobe::Diffuse,
            LOBE_GLOSSY => Lobe::Glossy,
            LOBE_COAT => Lobe::Coat,
            LOBE_SHEEN => Lobe::Sheen,
            _ => Lobe::Boundary,
        };
        let (has_choice, goes_on) = (record.pdf > 0.0, outcome.goes_on());
        let after = |k: usize| record.arriving[k] * record.weight[k] / record.chance;
        Self {
            outcome,
            // Holes do not scatter.
            lobe: (outcome != StepOutcome::Passed || record.lobe != LOBE_DIFFUSE).then_some(lobe),
            bsdf: has_choice.then_some(record.value),
            pdf: has_choice.then_some(record.pdf),
            weight: record.weight,
            survival: record.chance,
            throughput: if goes_on {
                [0, 1, 2].map(after)
            } else {
                [0.0; 3]
            },
        }
    }
}

impl StepOutcome {
    /// Whether the path has a next ray.
    pub fn goes_on(self) -> bool {
        matches!(self, Self::Scattered | Self::Passed)
    }
}

impl Sharing {
    /// For a ray that found light by itself.
    pub(super) fn found(record: &PackedRay) -> Self {
        Self {
            light_pdf: density(record.other_pdf),
            bsdf_pdf: density(record.own_pdf),
            light_weight: 1.0 - record.mis_weight,
            bsdf_weight: record.mis_weight,
        }
    }

    /// For a light sample.
    pub(super) fn sampled(record: &PackedRay) -> Self {
        Self {
            light_pdf: density(record.own_pdf),
            bsdf_pdf: Some(record.other_pdf),
            light_weight: record.mis_weight,
            bsdf_weight: 1.0 - record.mis_weight,
        }
    }
}

impl LightSample {
    /// Without the emitter.
    pub(super) fn of(record: &PackedRay) -> Self {
        Self {
            source: match record.lobe {
                SOURCE_LIGHT => LightSource::Light,
                SOURCE_EMITTER => LightSource::Emitter,
                _ => LightSource::Environment,
            },
            emitter: None,
            emitter_name: None,
            primitive: None,
            chance: record.chance,
            radiance: record.emission,
            bsdf: record.value,
            traced: record.flags & RAY_UNTRACED == 0,
        }
    }
}

fn density(pdf: f32) -> Option<f32> {
    (pdf > 0.0).then_some(pdf)
}
