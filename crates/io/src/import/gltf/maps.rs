//! Uses of images: which picture, where it lies, and how a sampler filters it.

use super::Reader;
use super::document::TextureInfo;
use crate::import::error::ImportError;
use glimray_scene::{Minify, UvTransform, Wrap};

const NEAREST: u32 = 9728;
const LINEAR: u32 = 9729;
const NEAREST_MIPMAP_NEAREST: u32 = 9984;
const LINEAR_MIPMAP_NEAREST: u32 = 9985;
const NEAREST_MIPMAP_LINEAR: u32 = 9986;
const CLAMP: u32 = 33071;
const MIRROR: u32 = 33648;
const REPEAT: u32 = 10497;
const LINEAR_MIPMAP_LINEAR: u32 = 9987;

/// The codes of samplers. The first of each is used in place of unknown ones.
pub(super) const MAG_FILTERS: &[u32] = &[LINEAR, NEAREST];
pub(super) const MIN_FILTERS: &[u32] = &[
    LINEAR_MIPMAP_LINEAR,
    NEAREST,
    LINEAR,
    NEAREST_MIPMAP_NEAREST,
    LINEAR_MIPMAP_NEAREST,
    NEAREST_MIPMAP_LINEAR,
];
pub(super) const WRAPS: &[u32] = &[REPEAT, CLAMP, MIRROR];

/// A use of an image.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FoundMap {
    pub image: usize,
    pub uv_set: u32,
    pub transform: UvTransform,
    /// Whether texels that look large are not interpolated.
    pub nearest: bool,
    pub minify: Minify,
    /// Along u and v.
    pub wrap: [Wrap; 2],
}

/// The transform that `KHR_texture_transform` describes.
pub(super) fn transform(info: &TextureInfo) -> UvTransform {
    match &info.extensions.transform {
        None => UvTransform::default(),
        Some(it) => UvTransform {
            offset: it.offset.into(),
            rotation: it.rotation,
            scale: it.scale.unwrap_or([1.0; 2]).into(),
        },
    }
}

impl Reader<'_> {
    /// The image that `info`, which is at `place`, uses; `None` with a note if there is none.
    pub(super) fn map(
        &mut self,
        info: &TextureInfo,
        place: &str,
    ) -> Result<Option<FoundMap>, ImportError> {
        let document = self.document;
        let texture = self
            .blame
            .get(&document.textures, info.index, "textures", place);
        let Some(texture) = self.spared(texture)? else {
            return Ok(None);
        };
        let here = format!("textures[{}]", info.index);
        let Some(image) = texture.image() else {
            let what = match texture.extensions.basisu {
                Some(_) => "has only a KTX2 picture, which this program cannot read",
                None => "has no picture",
            };
            let note = || format!("texture skipped: {here} {what}");
            self.notes.add("skipped textures", note);
            return Ok(None);
        };
        let source = self.blame.get(&document.images, image, "images", &here);
        if self.spared(source)?.is_none() {
            return Ok(None);
        }
        let mut found = FoundMap {
            image,
            uv_set: info.tex_coord.unwrap_or(0),
            transform: transform(info),
            nearest: false,
            minify: Minify::default(),
            wrap: [Wrap::Repeat; 2],
        };
        let moved = info.extensions.transform.as_ref();
        if let Some(set) = moved.and_then(|it| it.tex_coord) {
            found.uv_set = set;
        }
        let sampler = match texture.sampler {
            None => None,
            Some(index) => {
                let found = self.blame.get(&document.samplers, index, "samplers", &here);
                self.spared(found)?
            }
        };
        if let Some(sampler) = sampler {
            found.nearest = sampler.mag_filter == Some(NEAREST);
            found.minify = match sampler.min_filter {
                Some(NEAREST) => Minify::Nearest,
                Some(LINEAR) => Minify::Linear,
                Some(NEAREST_MIPMAP_NEAREST) => Minify::NearestMipmapNearest,
                Some(LINEAR_MIPMAP_NEAREST) => Minify::LinearMipmapNearest,
                Some(NEAREST_MIPMAP_LINEAR) => Minify::NearestMipmapLinear,
                _ => Minify::LinearMipmapLinear,
            };
            found.wrap = [sampler.wrap_s, sampler.wrap_t].map(|wrap| match wrap {
                Some(CLAMP) => Wrap::Clamp,
                Some(MIRROR) => Wrap::Mirror,
                _ => Wrap::Repeat,
            });
        }
        Ok(Some(found))
    }
}
