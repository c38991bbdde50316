//! The images of a model in the store that all formats share.

use super::Reader;
use super::blame::Blame;
use super::buffers::{self, Buffers, Source};
use super::document::Document;
use super::map_kinds::{MapKind, ShownBy, all_maps};
use crate::import::Options;
use crate::import::error::ImportError;
use crate::import::paths::Refusal;
use crate::import::picture::{self, Pictures, Place, Refused, Role};
use crate::import::source::quote;
use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

/// Pictures made of a model's images, and where these are.
pub(super) struct Store {
    pub pictures: Pictures,
    /// By the number of the image, what is known of it.
    images: HashMap<usize, Image>,
}

/// Where the file of an image is and its name for messages, or why there is none.
type Image = Result<(Place, String), String>;

impl Store {
    pub fn new(options: &Options) -> Self {
        Self {
            // Section 3.8.3: colour spaces in image files must be ignored.
            pictures: Pictures::new(options).without_profiles(),
            images: HashMap::new(),
        }
    }
}

/// Whether the scene has this map.
fn is_used(kind: MapKind) -> bool {
    kind.shown_by() != ShownBy::None
}

impl Reader<'_> {
    /// Announces the images that will be used, so that they are decoded together: those of the materials of all
    /// primitives in the chosen variant, unless they are in no file.
    pub(super) fn plan_images(&mut self) {
        let document = self.document;
        let mut seen = HashSet::new();
        for primitive in document.meshes.iter().flat_map(|mesh| &mesh.primitives) {
            let index = self.material_index(primitive);
            let Some(source) = index.and_then(|index| document.materials.get(index)) else {
                continue;
            };
            if !seen.insert(index) {
                continue;
            }
            for (kind, info) in all_maps(source) {
                let texture = document.textures.get(info.index);
                let image = texture.and_then(|texture| texture.image());
                if let Some(image) = image.filter(|_| is_used(kind))
                    && let Ok(Ok((place, name))) = self.located(image)
                {
                    self.store.pictures.plan(place, &name, kind.role());
                }
            }
        }
    }

    /// The index in the scene of `images[index]`, which exists; `None` with a note if it cannot be read.
    ///
    /// # Errors
    /// The image is in a file that the model may not read.
    pub(super) fn shown(&mut self, index: usize, role: Role) -> Result<Option<usize>, ImportError> {
        self.looked_up(index, |pictures, place, name, read| {
            pictures.index(place, name, role, read)
        })
    }

    /// The result of `get` for `images[index]` in the store.
    fn looked_up<T>(
        &mut self,
        index: usize,
        get: impl FnOnce(&mut Pictures, &Place, &str, picture::Read) -> Result<T, Refused>,
    ) -> Result<Option<T>, ImportError> {
        let (document, buffers, files) = (self.document, self.buffers, self.files);
        let blame = self.blame;
        let found = match self.located(index)? {
            Ok((place, name)) => {
                let read = move |place: &Place, name: &str| match place {
                    Place::File(path) => picture::file(files, path, name).map(Cow::Owned),
                    Place::Part(number) => part(document, buffers, blame, *number, name),
                };
                let pictures = &mut self.store.pictures;
                get(pictures, &place, &name, &read).map_err(Refused::into_note)
            }
            Err(why) => Err(why),
        };
        Ok(found.map_or_else(
            |why| {
                let note = || format!("texture skipped: images[{index}] {why}");
                self.notes.add("skipped textures", note);
                None
            },
            Some,
        ))
    }

    /// Where `images[index]` is.
    fn located(&mut self, index: usize) -> Result<Image, ImportError> {
        if let Some(known) = self.store.images.get(&index) {
            return Ok(known.clone());
        }
        let found = self.locate(index)?;
        self.store.images.insert(index, found.clone());
        Ok(found)
    }

    fn locate(&self, index: usize) -> Result<Image, ImportError> {
        let place = format!("images[{index}]");
        let Some(image) = self.document.images.get(index) else {
            return Ok(Err("does not exist".to_owned()));
        };
        let views = self.document.buffer_views.len();
        let Some(uri) = &image.uri else {
            let Some(view) = image.buffer_view else {
                return Ok(Err("has neither a URI nor a buffer view".to_owned()));
            };
            let found = self.buffers.view(self.document, view, &place, self.blame);
            if let Err(ImportError::Malformed(fault)) = found {
                return Ok(Err(format!("cannot be read: {}", fault.why)));
            }
            let name = image.name.clone().unwrap_or_default();
            return Ok(Ok((Place::Part(view), quote(name.as_bytes()))));
        };
        let source = match buffers::source(uri, self.blame, &place) {
            Ok(source) => source,
            Err(error) => return Ok(Err(format!("cannot be read: {}", error.fault().why))),
        };
        let name = match source {
            Source::Bytes(_) => {
                return Ok(Ok((
                    Place::Part(views + index),
                    "in a data: URI".to_owned(),
                )));
            }
            Source::File(name) => name,
        };
        match self.files.resolve(&name) {
            Ok(path) => Ok(Ok((Place::File(path), quote(name.as_bytes())))),
            Err(refusal @ Refusal::Outside(_)) => {
                Err(buffers::refused(refusal, "picture", self.blame, &place))
            }
            Err(Refusal::Missing(why) | Refusal::Unfit(why)) => Ok(Err(why)),
        }
    }
}

/// The bytes of an image inside the model: `number` is that of its buffer view, or counts on with images.
fn part<'b>(
    document: &Document,
    buffers: &'b Buffers,
    blame: Blame,
    number: usize,
    name: &str,
) -> Result<Cow<'b, [u8]>, Refused> {
    const PLACE: &str = "images";
    let bytes = match number.checked_sub(document.buffer_views.len()) {
        None => (buffers.view(document, number, PLACE, blame).ok())
            .map(|(bytes, _)| Cow::Borrowed(bytes)),
        Some(image) => (document.images.get(image))
            .and_then(|image| buffers::source(image.uri.as_deref()?, blame, PLACE).ok())
            .and_then(|source| match source {
                Source::Bytes(bytes) => Some(Cow::Owned(bytes)),
                Source::File(_) => None,
            }),
    };
    bytes.ok_or_else(|| Refused::unreadable(format!("{name} is not in the model")))
}
