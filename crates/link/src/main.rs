//! Writes the linked kernels to `shaders/linked`.

use glimray_link::{SOURCES, kernels, sums};
use std::{error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders");
    fs::create_dir_all(shaders.join("linked"))?;
    for (name, text) in kernels(&shaders)? {
        write(&shaders.join("linked").join(name), &text)?;
    }
    let lines = sums(&shaders)?
        .into_iter()
        .map(|(name, sum)| format!("{sum} {name}\n"));
    write(&shaders.join(SOURCES), &lines.collect::<String>())
}

/// Writes what differs, so that an unchanged file keeps its time.
fn write(path: &Path, text: &str) -> Result<(), Box<dyn Error>> {
    if fs::read_to_string(path).is_ok_and(|old| old == text) {
        return Ok(());
    }
    Ok(fs::write(path, text)?)
}
