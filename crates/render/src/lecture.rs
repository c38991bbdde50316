//! The scenes that [`Integrator::Lecture`] can render: the exercise alone.

use super::{Integrator, RenderError, RenderSettings, effort};
use crate::{
    layout::{LIGHT_RECTANGLE, SHAPE_SPHERE},
    pack::{PackedScene, PackedView},
};

/// Refuses a scene with anything that the exercise does not have, so that no picture lacks a part of it.
pub fn check(
    scene: &PackedScene,
    view: &PackedView,
    settings: &RenderSettings,
) -> Result<(), RenderError> {
    if settings.integrator != Integrator::Lecture {
        return Ok(());
    }
    let (features, frame) = (&scene.features, &view.frame);
    let lights = view.lights.iter().take(frame.light_count as usize);
    let beyond = [
        ("planes", frame.plane_count > 0),
        (
            "shapes other than spheres",
            features.shape_kinds & !(1 << SHAPE_SPHERE) != 0,
        ),
        ("instances", frame.instance_count > 0),
        ("motion of lights", frame.light_key_count > 1),
        (
            "lights with area",
            lights
                .into_iter()
                .any(|light| light.kind >= LIGHT_RECTANGLE),
        ),
        ("a section plane", view.has_section()),
        ("textures", features.textures || features.normal_maps),
        ("holes", features.coverage),
        ("emissive surfaces", features.emission),
        (
            "reflection or refraction",
            effort::has_trees(scene, settings),
        ),
    ];
    let names: Vec<_> = (beyond.into_iter())
        .filter_map(|(name, is_there)| is_there.then_some(name))
        .collect();
    match names.is_empty() {
        true => Ok(()),
        false => Err(RenderError::BeyondLecture {
            parts: names.join(", "),
        }),
    }
}
