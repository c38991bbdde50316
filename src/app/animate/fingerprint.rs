//! Short names for long bytes: two things with the same fingerprint are the same.

use crate::pack::{PackedScene, PackedView};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use xxhash_rust::xxh3::Xxh3;

/// XXH3 of 128 bits, in hexadecimal digits. It finds accidents, not forgeries.
pub type Fingerprint = String;

/// Of a text.
pub fn of_text(text: &str) -> Fingerprint {
    let mut hash = Xxh3::new();
    hash.update(text.as_bytes());
    digits(&hash)
}

/// Of everything in a scene that stands still.
pub fn of_scene(scene: &PackedScene) -> Fingerprint {
    let PackedScene {
        features,
        plane_count,
        pictures,
        ..
    } = scene;
    of_parts(
        scene.parts(),
        &format!("{features:?} {plane_count} {pictures:?}"),
    )
}

/// Of everything that is special to a frame.
pub fn of_view(view: &PackedView) -> Fingerprint {
    let PackedView {
        background,
        has_lights,
        has_area_lights,
        ..
    } = view;
    of_parts(
        view.parts(),
        &format!("{background} {has_lights} {has_area_lights}"),
    )
}

/// The length in bytes and the fingerprint of a file.
///
/// # Errors
/// It cannot be read, or is no ordinary file, which might have no end.
pub fn of_file(path: &Path) -> io::Result<(u64, Fingerprint)> {
    let mut file = File::open(path)?;
    if !file.metadata()?.is_file() {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    let mut hash = Xxh3::new();
    let mut buffer = vec![0; 1 << 16];
    let mut length = 0;
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok((length, digits(&hash))),
            Ok(count) => {
                hash.update(&buffer[..count]);
                length += count as u64;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// Lengths go in too, so that bytes cannot move from one part to the next unnoticed.
fn of_parts(parts: Vec<&[u8]>, text: &str) -> Fingerprint {
    let mut hash = Xxh3::new();
    for part in parts.into_iter().chain([text.as_bytes()]) {
        hash.update(&(part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    digits(&hash)
}

fn digits(hash: &Xxh3) -> Fingerprint {
    format!("{:032x}", hash.digest128())
}
