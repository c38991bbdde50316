//! Short names for long bytes: two things with the same fingerprint are the same.

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

fn digits(hash: &Xxh3) -> Fingerprint {
    format!("{:032x}", hash.digest128())
}
