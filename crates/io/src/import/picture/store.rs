//! The pictures of a scene, whatever its format: each file is decoded once, by all cores, for the roles in which it is
//! used; pictures that are too large are halved.
//!
//! Pictures that will be used are planned first ([`Pictures::plan`]). The first use of a planned picture decodes those
//! that are planned after it as well, as many at a time as fit into a bounded memory. How often each is halved so that
//! all fit is known before from their headers ([`budget`]), so that no more is decoded and kept than fits.

mod budget;

use super::{Announced, Role, decode};
use crate::import::Options;
use crate::import::notes::Notes;
use crate::import::picture::Refused;
use glimray_scene::threads;
use glimray_scene::{MAX_PICTURE_BYTES, Picture, fit};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// Bytes of texels that are decoded at a time, and those of decoded pictures that are kept for a later use.
const BATCH_BYTES: u64 = 256 << 20;

/// Number of pictures that are decoded at a time.
const MOST_IN_BATCH: usize = 64;

/// Where the file of a picture is.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::import) enum Place {
    /// The path that a resolver returned.
    File(PathBuf),
    /// A part of the model's file, by its number.
    Part(usize),
}

/// Reads the file at a place, which messages call by the name in the second argument.
pub(in crate::import) type Read<'r, 'b> =
    &'r dyn Fn(&Place, &str) -> Result<Cow<'b, [u8]>, Refused>;

/// A picture that will be used.
struct Planned {
    place: Place,
    /// For messages.
    name: String,
    roles: Vec<Role>,
    /// Properties that the header of the file announces, once that was read.
    announced: Option<Announced>,
    /// The file, or why there is none, if it is kept from the reading of its header.
    file: Option<Result<Vec<u8>, Refused>>,
    /// Whether it is refused, because the files before it announced as much as all may.
    is_beyond: bool,
    /// How many times its picture is halved so that all fit into memory.
    halvings: u32,
}

type Decoded = Result<Arc<Picture>, Refused>;

/// The pictures of a scene.
pub(in crate::import) struct Pictures {
    /// `None` until [`Self::complete`].
    pictures: Vec<Option<Arc<Picture>>>,
    /// Bytes of the texels of `pictures`.
    bytes: usize,
    indices: HashMap<(Place, Role), usize>,
    /// In the order in which they were planned.
    planned: BTreeMap<usize, Planned>,
    /// Where a place is in `planned`.
    order: HashMap<Place, usize>,
    /// Pictures that are not in the scene, or not yet.
    decoded: HashMap<(Place, Role), Decoded>,
    /// Bytes of the texels in `decoded`.
    decoded_bytes: u64,
    /// Length of the longest side that pictures may have.
    limit: u32,
    /// Whether colour spaces of files count, so that it is said if they are not followed.
    has_profiles: bool,
    /// Files whose pictures exceeded the limit.
    limited: HashSet<Place>,
    /// Files whose headers were read, and the bytes of texels that these announced.
    announced: HashSet<Place>,
    announced_bytes: u64,
    /// How many times pictures were halved for lack of memory.
    halved_count: usize,
    /// On what was repaired in pictures, and on what their files say and they do not follow.
    notes: Vec<String>,
}

impl Pictures {
    pub fn new(options: &Options) -> Self {
        Self {
            pictures: Vec::new(),
            bytes: 0,
            indices: HashMap::new(),
            planned: BTreeMap::new(),
            order: HashMap::new(),
            decoded: HashMap::new(),
            decoded_bytes: 0,
            limit: options.texture_limit.map_or(u32::MAX, Into::into),
            has_profiles: true,
            limited: HashSet::new(),
            announced: HashSet::new(),
            announced_bytes: 0,
            halved_count: 0,
            notes: Vec::new(),
        }
    }

    /// For a format whose colours are sRGB whatever the files of its pictures say.
    pub fn without_profiles(self) -> Self {
        Self {
            has_profiles: false,
            ..self
        }
    }

    /// Announces that the picture at `place` will be used in `role`. Messages call it `name`.
    pub fn plan(&mut self, place: Place, name: &str, role: Role) {
        let next = self.order.len();
        let at = *self.order.entry(place.clone()).or_insert(next);
        let planned = self.planned.entry(at).or_insert_with(|| Planned {
            place,
            name: name.to_owned(),
            roles: Vec::new(),
            announced: None,
            file: None,
            is_beyond: false,
            halvings: 0,
        });
        if !planned.roles.contains(&role) {
            planned.roles.push(role);
        }
    }

    /// The index of the picture at `place` in the scene, of which it becomes part.
    ///
    /// # Errors
    /// The data at `place` cannot be read, is not an image, or is too large.
    pub fn index(
        &mut self,
        place: &Place,
        name: &str,
        role: Role,
        read: Read,
    ) -> Result<usize, Refused> {
        let key = (place.clone(), role);
        if let Some(&index) = self.indices.get(&key) {
            return Ok(index);
        }
        let picture = self.picture(place, name, role, read)?;
        self.forget(&key);
        let index = self.add(picture);
        self.indices.insert(key, index);
        Ok(index)
    }

    /// The index that the picture at `place` will have once [`Self::complete`] has read it, as planned.
    pub fn reserve(&mut self, place: Place, name: &str, role: Role) -> usize {
        if let Some(&index) = self.indices.get(&(place.clone(), role)) {
            return index;
        }
        self.plan(place.clone(), name, role);
        self.pictures.push(None);
        let index = self.pictures.len() - 1;
        self.indices.insert((place, role), index);
        index
    }

    /// Reads the pictures that are reserved.
    ///
    /// # Errors
    /// The index of the first that cannot be read, and why.
    pub fn complete(&mut self, read: Read) -> Result<(), (usize, Refused)> {
        let mut missing: Vec<(usize, (Place, Role))> = (self.indices.iter())
            .filter(|(_, index)| self.pictures[**index].is_none())
            .map(|(key, &index)| (index, key.clone()))
            .collect();
        missing.sort_unstable_by_key(|(index, _)| *index);
        self.plan_sizes(read);
        // Then nothing is decoded in vain.
        let planned = |(_, key): &&(usize, (Place, Role))| {
            let planned = self.order.get(&key.0).and_then(|at| self.planned.get(at));
            planned.is_some_and(|planned| planned.is_beyond)
        };
        if let Some(beyond) = missing.iter().position(|it| planned(&it)) {
            let beyond = missing.remove(beyond);
            missing.insert(0, beyond);
        }
        for (index, key) in missing {
            let planned = self.order.get(&key.0).and_then(|at| self.planned.get(at));
            let name = planned.map(|planned| planned.name.clone());
            let picture = self.picture(&key.0, &name.unwrap_or_default(), key.1, read);
            let picture = picture.map_err(|refused| (index, refused))?;
            self.forget(&key);
            self.bytes += picture.texels.byte_len();
            self.pictures[index] = Some(picture);
            self.fit();
        }
        Ok(())
    }

    /// The picture at `place`, which need not become part of the scene.
    ///
    /// # Errors
    /// As [`Self::index`].
    pub fn picture(&mut self, place: &Place, name: &str, role: Role, read: Read) -> Decoded {
        let key = (place.clone(), role);
        let index = self.indices.get(&key);
        if let Some(Some(picture)) = index.map(|&index| &self.pictures[index]) {
            return Ok(picture.clone());
        }
        if !self.decoded.contains_key(&key) {
            self.decode_from(place, name, role, read);
        }
        // The batch holds it, whatever has become of it.
        let gone = || Refused::unreadable(format!("{name} was not decoded"));
        self.decoded
            .get(&key)
            .cloned()
            .unwrap_or_else(|| Err(gone()))
    }

    /// Notes on what was repaired in the pictures that were read, and on what their files say and they do not follow.
    pub fn into_notes(self) -> Vec<String> {
        self.notes
    }

    /// Adds a picture to the scene and returns its index.
    pub fn add(&mut self, picture: impl Into<Arc<Picture>>) -> usize {
        let picture = picture.into();
        self.bytes += picture.texels.byte_len();
        self.pictures.push(Some(picture));
        self.fit();
        self.pictures.len() - 1
    }

    /// All pictures of the scene. What was done to them is added to `notes`.
    pub fn finish(self, notes: &mut Notes) -> Vec<Arc<Picture>> {
        let pictures = |count: usize| match count {
            1 => "1 picture was".to_owned(),
            _ => format!("{count} pictures were"),
        };
        for note in &self.notes {
            notes.add("notes on pictures", || note.clone());
        }
        if !self.limited.is_empty() {
            let (pictures, limit) = (pictures(self.limited.len()), self.limit);
            notes.remark(format!(
                "{pictures} halved to at most {limit} texels a side, as asked for"
            ));
        }
        if self.halved_count > 0 {
            notes.add("smaller pictures", || smaller_pictures(self.halved_count));
        }
        self.pictures.into_iter().flatten().collect()
    }

    /// Decodes the picture at `place` for `role`, and pictures that are planned after it.
    fn decode_from(&mut self, place: &Place, name: &str, role: Role, read: Read) {
        self.plan(place.clone(), name, role);
        self.plan_sizes(read);
        let mut at = self.order.get(place).copied();
        if self.decoded_bytes > BATCH_BYTES {
            self.decoded.retain(|_, decoded| decoded.is_err());
            self.decoded_bytes = 0;
        }
        let most = if threads::count() > 1 {
            MOST_IN_BATCH
        } else {
            1
        };
        let mut batch = Vec::new();
        let mut size = 0;
        while let Some(mut planned) = at.and_then(|at| self.planned.remove(&at)) {
            let bytes = match planned.file.take() {
                Some(kept) => kept.map(Cow::Owned),
                None => read(&planned.place, &planned.name),
            };
            size += planned.bytes(u32::MAX, 0);
            batch.push((planned, bytes));
            let more = batch.len() < most && size < BATCH_BYTES;
            let next = at.and_then(|at| self.planned.range(at..).next());
            at = next.filter(|_| more).map(|(at, _)| *at);
        }
        let (limit, has_profiles) = (self.limit, self.has_profiles);
        let decoded = threads::map(batch, |(planned, bytes)| {
            let made = match bytes {
                Ok(bytes) => decode(&bytes, &planned.name, &planned.roles, has_profiles),
                Err(refused) => Err(refused),
            };
            let made = made.map(|pictures| {
                let is_large = |it: &Picture| it.width.max(it.height) > limit;
                let is_limited = pictures.iter().any(|(picture, _)| is_large(picture));
                let small = |picture: Picture| {
                    let limited = picture.limited(limit);
                    (0..planned.halvings).fold(limited, |picture, _| picture.halved())
                };
                let small = (pictures.into_iter())
                    .map(|(picture, notes)| (Arc::new(small(picture)), notes));
                (small.collect::<Vec<_>>(), is_limited)
            });
            (planned, made)
        });
        for (planned, made) in decoded {
            let (pictures, why) = match made {
                Ok((pictures, is_limited)) => {
                    if is_limited {
                        self.limited.insert(planned.place.clone());
                    }
                    (pictures, None)
                }
                Err(refused) => (Vec::new(), Some(refused)),
            };
            let mut pictures = pictures.into_iter();
            for role in planned.roles {
                let made = match (pictures.next(), &why) {
                    (Some((picture, notes)), _) => {
                        self.notes.extend(notes);
                        self.halved_count += planned.halvings as usize;
                        Ok(picture)
                    }
                    (None, Some(why)) => Err(why.clone()),
                    (None, None) => break,
                };
                self.decoded_bytes += bytes_of(&made);
                self.decoded.insert((planned.place.clone(), role), made);
            }
        }
    }

    /// Forgets a decoded picture that the scene has now.
    fn forget(&mut self, key: &(Place, Role)) {
        if let Some(decoded) = self.decoded.remove(key) {
            self.decoded_bytes -= bytes_of(&decoded);
        }
    }

    /// Halves the largest pictures until all fit into memory.
    fn fit(&mut self) {
        if self.bytes > MAX_PICTURE_BYTES {
            self.halved_count += fit(self.pictures.iter_mut().flatten());
            let pictures = self.pictures.iter().flatten();
            self.bytes = pictures.map(|picture| picture.texels.byte_len()).sum();
        }
    }
}

/// The note on pictures that were halved so many times for lack of memory.
pub fn smaller_pictures(count: usize) -> String {
    format!("pictures were halved {count} times to fit into memory")
}

fn bytes_of(decoded: &Decoded) -> u64 {
    decoded
        .as_ref()
        .map_or(0, |picture| picture.texels.byte_len() as u64)
}
