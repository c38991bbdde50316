//! Stills that the picture is compared with: snapshots of it, and reference pictures from files.

use crate::model::small::small;
use glimray_scene::image::{Image, ScreenImage};
use glimray_scene::srgb_from_linear;
use image::RgbaImage;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Maximum number of stills: each has a number, and each number a key. A still takes 16 bytes per pixel.
pub const MOST: usize = 8;

/// Largest width and height of a thumbnail, in pixels.
const THUMBNAIL: [u32; 2] = [80, 60];

/// Identifies a still for as long as the window is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StillId(u32);

/// A picture that is kept.
#[derive(Clone, Debug)]
pub struct Still {
    /// The still's identifier.
    pub id: StillId,
    /// The number of its key, from 1 to [`MOST`]: the least that was free when it was kept.
    pub number: usize,
    /// `Snapshot 1`, the name of the file, or what the user calls it.
    pub name: String,
    /// The view mode and the samples of a snapshot; the path of a reference picture.
    pub detail: String,
    /// The pixels; transparent outside a rendered region.
    pub picture: Arc<Image>,
    /// A small copy, as it looked when it was kept.
    pub thumbnail: Arc<ScreenImage>,
    /// Whether the pixels are linear radiance, so that tone mapping applies; otherwise display values.
    pub is_radiance: bool,
    /// The file of a reference picture.
    path: Option<PathBuf>,
}

impl Still {
    /// Width and height in pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.picture.width, self.picture.height)
    }
}

/// A picture from the renderer that is about to be kept.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The pixels of the rendered region.
    pub image: Image,
    /// The region: x, y, width and height in pixels of the whole picture.
    pub region: [u32; 4],
    /// Width and height of the whole picture.
    pub size: (u32, u32),
    /// The picture as it is displayed.
    pub screen: ScreenImage,
    /// Whether the pixels are linear radiance.
    pub is_radiance: bool,
    /// The view mode and the number of samples.
    pub detail: String,
}

/// The stills in the order of their numbers.
#[derive(Debug, Default)]
pub struct Gallery {
    stills: Vec<Still>,
    /// Number of stills so far.
    count: u32,
}

impl Gallery {
    /// All stills.
    pub fn all(&self) -> &[Still] {
        &self.stills
    }

    /// The still with this identifier.
    pub fn get(&self, id: StillId) -> Option<&Still> {
        self.stills.iter().find(|still| still.id == id)
    }

    /// The still with this number.
    pub fn numbered(&self, number: usize) -> Option<&Still> {
        self.stills.iter().find(|still| still.number == number)
    }

    /// The still that was kept last.
    pub fn newest(&self) -> Option<&Still> {
        self.stills.iter().max_by_key(|still| still.id.0)
    }

    /// Whether another still would exceed [`MOST`].
    pub fn is_full(&self) -> bool {
        self.stills.len() >= MOST
    }

    /// Whether there is a still from this file.
    pub fn holds(&self, path: &Path) -> bool {
        let mut paths = self.stills.iter().map(|still| still.path.as_deref());
        paths.any(|known| known == Some(path))
    }

    /// Keeps a snapshot, which is called by its number.
    pub fn keep_snapshot(&mut self, snapshot: Snapshot) -> &Still {
        let number = self.free_number();
        let name = format!("Snapshot {number}");
        let thumbnail = Arc::new(thumbnail(&snapshot.screen));
        let (is_radiance, detail) = (snapshot.is_radiance, snapshot.detail.clone());
        let picture = Arc::new(whole(snapshot));
        self.keep(Still {
            id: StillId(0),
            number,
            name,
            detail,
            picture,
            thumbnail,
            is_radiance,
            path: None,
        })
    }

    /// Keeps a reference picture. It replaces the one from the same file, and has its number and name.
    pub fn keep_reference(&mut self, path: &Path, picture: Image, is_radiance: bool) -> &Still {
        let is_same = |still: &&Still| still.path.as_deref() == Some(path);
        let before = self.stills.iter().find(is_same).cloned();
        (self.stills).retain(|still| still.path.as_deref() != Some(path));
        let name = path.file_name().unwrap_or(path.as_os_str());
        let (number, name) = match before {
            Some(before) => (before.number, before.name),
            None => (self.free_number(), name.to_string_lossy().into_owned()),
        };
        let screen = match is_radiance {
            true => ScreenImage::from(&encoded(&picture)),
            false => ScreenImage::from(&picture),
        };
        self.keep(Still {
            id: StillId(0),
            number,
            name,
            detail: path.display().to_string(),
            picture: Arc::new(picture),
            thumbnail: Arc::new(thumbnail(&screen)),
            is_radiance,
            path: Some(path.to_owned()),
        })
    }

    fn keep(&mut self, still: Still) -> &Still {
        self.count += 1;
        let id = StillId(self.count);
        let place = (self.stills).partition_point(|other| other.number < still.number);
        self.stills.insert(place, Still { id, ..still });
        &self.stills[place]
    }

    fn free_number(&self) -> usize {
        let mut numbers = 1..;
        let is_free = |number: &usize| self.numbered(*number).is_none();
        numbers.find(is_free).unwrap_or(MOST)
    }

    /// Calls a still something else. Space around the name is left out, and an empty name changes nothing.
    pub fn rename(&mut self, id: StillId, name: &str) {
        let still = self.stills.iter_mut().find(|still| still.id == id);
        if let Some(still) = still.filter(|_| !name.trim().is_empty()) {
            name.trim().clone_into(&mut still.name);
        }
    }

    /// Forgets a still.
    pub fn remove(&mut self, id: StillId) {
        self.stills.retain(|still| still.id != id);
    }
}

/// Radiance as display values, without a tone curve.
fn encoded(radiance: &Image) -> Image {
    let encode = |value: f32| srgb_from_linear(value.clamp(0.0, 1.0));
    let pixels = radiance.pixels.iter();
    Image {
        pixels: pixels
            .map(|&[r, g, b, opacity]| [encode(r), encode(g), encode(b), opacity])
            .collect(),
        ..*radiance
    }
}

/// An opaque picture of at most [`THUMBNAIL`] pixels, transparent where there are none.
fn thumbnail(picture: &ScreenImage) -> ScreenImage {
    let small = small(picture, THUMBNAIL).unwrap_or_else(|| RgbaImage::new(1, 1));
    let pixels = small.pixels().map(|pixel| {
        // Of what is there: a picture in progress has pixels without a sample.
        let [r, g, b, opacity] = pixel.0.map(u32::from);
        let level = |sum: u32| (sum * 255 / opacity.max(1)).min(255) as u8;
        [level(r), level(g), level(b), u8::from(opacity > 0) * 255]
    });
    ScreenImage {
        width: small.width(),
        height: small.height(),
        pixels: pixels.collect(),
    }
}

/// The whole picture, transparent outside the rendered region.
fn whole(snapshot: Snapshot) -> Image {
    let Snapshot {
        image,
        region: [left, top, width, height],
        size,
        ..
    } = snapshot;
    if (image.width, image.height) == size {
        return image;
    }
    let mut whole = Image {
        width: size.0,
        height: size.1,
        pixels: vec![[0.0; 4]; size.0 as usize * size.1 as usize],
    };
    let count = width as usize * height as usize;
    whole.put(
        &image.pixels[..count.min(image.pixels.len())],
        width,
        [left, top],
    );
    whole
}
