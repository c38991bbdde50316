//! The JSON of glTF's animations, with `KHR_animation_pointer`.

use super::document_materials::absent;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
pub struct Animation {
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub channels: Vec<Channel>,
    #[serde(default)]
    pub samplers: Vec<AnimationSampler>,
}

#[derive(Debug, Deserialize)]
pub struct Channel {
    #[serde(default = "absent")]
    pub sampler: usize,
    #[serde(default)]
    pub target: ChannelTarget,
}

#[derive(Debug, Default, Deserialize)]
pub struct ChannelTarget {
    #[serde(default)]
    pub node: Option<usize>,
    #[serde(default)]
    pub path: String,
    #[serde(default)]
    pub extensions: Option<Box<TargetExtensions>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct TargetExtensions {
    #[serde(rename = "KHR_animation_pointer")]
    pub pointer: Option<AnimationPointer>,
}

#[derive(Debug, Deserialize)]
pub struct AnimationPointer {
    #[serde(default)]
    pub pointer: String,
}

#[derive(Debug, Deserialize)]
pub struct AnimationSampler {
    #[serde(default = "absent")]
    pub input: usize,
    #[serde(default = "absent")]
    pub output: usize,
    #[serde(default)]
    pub interpolation: Interpolation,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Hash)]
#[serde(rename_all = "UPPERCASE")]
pub enum Interpolation {
    #[default]
    Linear,
    Step,
    CubicSpline,
}
