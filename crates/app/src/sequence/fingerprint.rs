//! Fingerprints: hashes that identify texts and files.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use xxhash_rust::xxh3::Xxh3;

/// 128-bit XXH3 in hexadecimal digits. It detects accidental changes, not forgeries.
pub type Fingerprint = String;

/// The fingerprint of a text.
pub fn of_text(text: &str) -> Fingerprint {
    let mut hash = Xxh3::new();
    hash.update(text.as_bytes());
    digits(&hash)
}

/// The length in bytes and the fingerprint of a file.
///
/// # Errors
/// The file cannot be read, or is not a regular file (a device might never end).
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

fn digits(hash: &Xxh3) -> Fingerprint {
    format!("{:032x}", hash.digest128())
}
