//! Stills that the picture is compared with: snapshots of it, and reference pictures from files.

use glimray_scene::image::Image;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Maximum number of stills. Each takes 16 bytes per pixel.
pub const MOST: usize = 8;

/// Identifies a still for as long as the window is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StillId(u32);

/// A picture that is kept.
#[derive(Clone, Debug)]
pub struct Still {
    /// The still's identifier.
    pub id: StillId,
    /// `Snapshot 1`, or the name of the file.
    pub name: String,
    /// The view mode and the samples of a snapshot; the path of a reference picture.
    pub detail: String,
    /// The pixels; transparent outside a rendered region.
    pub picture: Arc<Image>,
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
    /// Whether the pixels are linear radiance.
    pub is_radiance: bool,
    /// The view mode and the number of samples.
    pub detail: String,
}

/// The stills, the oldest first.
#[derive(Debug, Default)]
pub struct Gallery {
    stills: Vec<Still>,
    /// Number of stills and of snapshots so far.
    count: u32,
    snapshots: u32,
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

    /// Whether another still would exceed [`MOST`].
    pub fn is_full(&self) -> bool {
        self.stills.len() >= MOST
    }

    /// Whether there is a still from this file.
    pub fn holds(&self, path: &Path) -> bool {
        let mut paths = self.stills.iter().map(|still| still.path.as_deref());
        paths.any(|known| known == Some(path))
    }

    /// Keeps a snapshot under the next free name.
    pub fn keep_snapshot(&mut self, snapshot: Snapshot) -> &Still {
        self.snapshots += 1;
        let name = format!("Snapshot {}", self.snapshots);
        let (is_radiance, detail) = (snapshot.is_radiance, snapshot.detail.clone());
        let picture = Arc::new(whole(snapshot));
        self.keep(Still {
            id: StillId(0),
            name,
            detail,
            picture,
            is_radiance,
            path: None,
        })
    }

    /// Keeps a reference picture. It replaces the one from the same file.
    pub fn keep_reference(&mut self, path: &Path, picture: Image, is_radiance: bool) -> &Still {
        (self.stills).retain(|still| still.path.as_deref() != Some(path));
        let name = path.file_name().unwrap_or(path.as_os_str());
        self.keep(Still {
            id: StillId(0),
            name: name.to_string_lossy().into_owned(),
            detail: path.display().to_string(),
            picture: Arc::new(picture),
            is_radiance,
            path: Some(path.to_owned()),
        })
    }

    fn keep(&mut self, still: Still) -> &Still {
        self.count += 1;
        let id = StillId(self.count);
        self.stills.push(Still { id, ..still });
        &self.stills[self.stills.len() - 1]
    }

    /// Forgets a still.
    pub fn remove(&mut self, id: StillId) {
        self.stills.retain(|still| still.id != id);
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
