//! The pictures and textures of a model. Pictures that are too large together are halved.

use super::Reader;
use super::bake;
use super::buffers::{self, Source};
use crate::import::error::ImportError;
use crate::import::paths::Refusal;
use crate::import::picture;
use crate::import::source::quote;
use crate::scene::Picture;
use image::RgbaImage;
use std::collections::HashMap;
use std::sync::Arc;

/// Most bytes that all pictures of a model take; at four bytes a texel 16 pictures of 4096 × 4096.
const MAX_BYTES: usize = 1 << 30;

/// Number of texels of decoded images that are kept for other materials.
const MOST_KEPT: usize = 64 << 20;

/// What was made of the images of a model.
#[derive(Default)]
pub(super) struct Store {
    pub pictures: Vec<Arc<Picture>>,
    /// Decoded images by their number in the file; `None` if it cannot be read.
    images: HashMap<usize, Option<Arc<RgbaImage>>>,
    kept_texels: usize,
    /// Pictures by what they were made from.
    pub known: HashMap<Vec<u32>, super::textures::Appearance>,
    /// How many times pictures were halved.
    pub halved_count: usize,
}

impl Store {
    /// Adds a picture and returns its index.
    pub fn add(&mut self, picture: Picture) -> usize {
        self.pictures.push(picture.into());
        while self.byte_count() > MAX_BYTES {
            let largest = (self.pictures.iter_mut()).max_by_key(|it| it.texels.byte_len());
            let Some(largest) = largest.filter(|picture| picture.texels.len() > 1) else {
                break;
            };
            *largest = bake::halved(largest).into();
            self.halved_count += 1;
        }
        self.pictures.len() - 1
    }

    fn byte_count(&self) -> usize {
        self.pictures
            .iter()
            .map(|picture| picture.texels.byte_len())
            .sum()
    }
}

impl Reader<'_> {
    /// `images[index]`, which exists; `None` with a note if it cannot be read.
    ///
    /// # Errors
    /// It is in a file that the model may not read.
    pub(super) fn image(&mut self, index: usize) -> Result<Option<Arc<RgbaImage>>, ImportError> {
        if let Some(known) = self.store.images.get(&index) {
            return Ok(known.clone());
        }
        let found = match self.encoded(index)? {
            Ok((bytes, name)) => picture::open(&bytes, &name)
                .map(|image| Arc::new(image.into_rgba8()))
                .map_err(picture::Refused::into_note),
            Err(why) => Err(why),
        };
        let found = match found {
            Ok(image) => Some(image),
            Err(why) => {
                let note = || format!("texture skipped: images[{index}] {why}");
                self.notes.add("skipped textures", note);
                None
            }
        };
        let texels = found.as_ref().map_or(0, |image| image.len() / 4);
        if self.store.kept_texels + texels > MOST_KEPT {
            self.store.images.clear();
            self.store.kept_texels = 0;
        }
        self.store.kept_texels += texels;
        self.store.images.insert(index, found.clone());
        Ok(found)
    }

    /// The bytes of an image file and its name for messages, or why they cannot be had.
    fn encoded(&self, index: usize) -> Result<Result<(Vec<u8>, String), String>, ImportError> {
        let place = format!("images[{index}]");
        let Some(image) = self.document.images.get(index) else {
            return Ok(Err("does not exist".to_owned()));
        };
        let Some(uri) = &image.uri else {
            let Some(view) = image.buffer_view else {
                return Ok(Err("has neither a URI nor a buffer view".to_owned()));
            };
            let (bytes, _) = self.buffers.view(self.document, view, &place, self.blame)?;
            let name = image.name.clone().unwrap_or_default();
            return Ok(Ok((bytes.to_vec(), quote(name.as_bytes()))));
        };
        let name = match buffers::source(uri, self.blame, &place)? {
            Source::Bytes(bytes) => return Ok(Ok((bytes, "in a data: URI".to_owned()))),
            Source::File(name) => name,
        };
        let path = match self.files.resolve(&name) {
            Ok(path) => path,
            Err(refusal @ Refusal::Outside(_)) => {
                return Err(buffers::refused(refusal, "picture", self.blame, &place));
            }
            Err(Refusal::Missing(why) | Refusal::Unfit(why)) => return Ok(Err(why)),
        };
        let quoted = quote(name.as_bytes());
        match self.files.read(&path, picture::MAX_BYTES) {
            Ok(bytes) => Ok(Ok((bytes, quoted))),
            Err(error) => Ok(Err(format!("{quoted}: {}", error.into_fault().why))),
        }
    }
}
