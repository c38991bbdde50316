//! Checksums of the sources of kernels, which tell whether linked kernels are stale.

use std::{fs, io, path::Path};

/// The file of the sources that were linked, in the folder of shaders: checksum, length and name, as `cksum` prints them
/// there.
pub const SOURCES: &str = "linked/sources.txt";

/// Names of the sources in a folder, with checksum and length, in the order of names.
///
/// # Errors
/// A file cannot be read.
pub fn sums(root: &Path) -> io::Result<Vec<(String, String)>> {
    let mut sources = Vec::new();
    list(root, root, &mut sources)?;
    sources.sort();
    Ok(sources)
}

/// Adds the sources below `folder`, named from `root`.
fn list(root: &Path, folder: &Path, sources: &mut Vec<(String, String)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            list(root, &path, sources)?;
        } else if path.extension().is_some_and(|ending| ending == "wesl") {
            let name = path.strip_prefix(root).unwrap_or(&path).to_string_lossy();
            let bytes = fs::read(&path)?;
            let sum = format!("{} {}", checksum(&bytes), bytes.len());
            sources.push((name.replace('\\', "/"), sum));
        }
    }
    Ok(())
}

/// The CRC of POSIX's `cksum`, which takes the length in after the bytes.
fn checksum(bytes: &[u8]) -> u32 {
    let length = bytes.len().to_le_bytes();
    let length_end = length.iter().rposition(|byte| *byte != 0);
    let length = &length[..length_end.map_or(0, |last| last + 1)];
    let sum = bytes.iter().chain(length).fold(0_u32, |sum, byte| {
        (0..8).fold(sum ^ (u32::from(*byte) << 24), |sum, _| match sum >> 31 {
            0 => sum << 1,
            _ => (sum << 1) ^ 0x04c1_1db7,
        })
    });
    !sum
}
