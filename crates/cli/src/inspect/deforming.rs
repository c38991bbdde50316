//! The clips of a model, and its deforming meshes.

use crate::inspect::{list, number};
use glimray_app::console::quoted;
use glimray_scene::{Clip, Deformation, Scene};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::{self, Write};

/// A clip.
#[derive(Serialize, JsonSchema)]
pub struct ClipEntry {
    name: String,
    /// Duration; null for clips that are not played.
    seconds: Option<f64>,
}

/// A mesh that deforms.
#[derive(Serialize, JsonSchema)]
pub struct DeformationEntry {
    /// The name of the mesh.
    mesh: String,
    /// Number of joints; null without a skin.
    joints: Option<usize>,
    morph_targets: usize,
}

impl From<&Clip> for ClipEntry {
    fn from(clip: &Clip) -> Self {
        Self {
            name: clip.name.clone(),
            seconds: clip.seconds,
        }
    }
}

impl DeformationEntry {
    pub fn new(scene: &Scene, deformation: &Deformation) -> Self {
        Self {
            mesh: scene.meshes[deformation.mesh].name.clone(),
            joints: deformation.skin.as_ref().map(|skin| skin.joints.len()),
            morph_targets: deformation.targets.len(),
        }
    }
}

/// Nothing for scenes without.
pub fn write_text(out: &mut String, scene: &Scene) -> fmt::Result {
    if !scene.clips.is_empty() {
        list(out, "clips", &scene.clips, |out, _, clip| {
            clip_text(out, clip)
        })?;
    }
    if !scene.deformations.is_empty() {
        list(out, "deforming", &scene.deformations, |out, _, it| {
            deformation_text(out, scene, it)
        })?;
    }
    Ok(())
}

fn clip_text(out: &mut String, clip: &Clip) -> fmt::Result {
    write!(out, "{}, ", quoted(&clip.name))?;
    match clip.seconds {
        Some(seconds) => write!(out, "{} s", number(seconds)),
        None => write!(out, "not played"),
    }
}

fn deformation_text(out: &mut String, scene: &Scene, it: &Deformation) -> fmt::Result {
    let mesh = &scene.meshes[it.mesh];
    write!(
        out,
        "{} of {} triangles",
        quoted(&mesh.name),
        mesh.triangles.len()
    )?;
    if let Some(skin) = &it.skin {
        write!(out, ", skin with {} joint(s)", skin.joints.len())?;
    }
    match it.targets.len() {
        0 => Ok(()),
        count => write!(out, ", {count} morph target(s)"),
    }
}
