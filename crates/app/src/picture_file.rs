//! Reads picture files with limits on size, because a file from elsewhere must not exhaust memory.

use crate::error::AppError;
use glimray_io::{import, output};
use glimray_scene::image::Image;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest file, in bytes.
const MAX_BYTES: u64 = 1 << 30;

/// A decoded picture.
pub struct Picture {
    /// Linear light in Rec. 709, or values as stored; integers are scaled to 0..1.
    pub image: Image,
    /// Whether the file stores linear radiance as floats.
    pub is_float: bool,
    /// Whether the file stores opacity.
    pub has_alpha: bool,
    /// Sentences on all that the file says and the picture does not follow.
    pub notes: Vec<String>,
}

impl Picture {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.image.width, self.image.height]
    }
}

/// Reads the picture at `path`: PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR, recognised by its first bytes.
///
/// # Errors
/// The file is missing, damaged, of another kind or too large.
pub fn read(path: &Path) -> Result<Picture, AppError> {
    let refused = |why: &str, todo: &str| {
        let path = path.display();
        AppError::Refused(format!("cannot read the picture ({path}): {why}. {todo}."))
    };
    let bytes = contents(path).map_err(|error| {
        let todo = "Give a PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR file";
        refused(&output::reason(&error), todo)
    })?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(refused("it has more than 1 GiB", "Give a smaller file"));
    }
    let pixels = import::pixels(path, &bytes).map_err(|error| {
        let fault = error.fault();
        refused(&fault.why, &fault.todo)
    })?;
    let note = |clause| format!("{} {clause}.", path.display());
    Ok(Picture {
        image: Image {
            width: pixels.width,
            height: pixels.height,
            pixels: pixels.values,
        },
        is_float: pixels.is_light,
        has_alpha: pixels.has_alpha,
        notes: pixels.ignored.into_iter().map(note).collect(),
    })
}

/// The bytes of a file, or one more than the limit.
fn contents(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(MAX_BYTES + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}
