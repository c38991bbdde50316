//! Joins panels side by side into the strips of `docs/src/theory/failures.md`:
//!
//! ```sh
//! cargo run --release --example strips -- target/strips assets/gallery
//! ```
//!
//! The panels NAME_1.png, NAME_2.png … of the first folder, all of one height, become NAME.jpg in the second.

use image::codecs::jpeg::JpegEncoder;
use image::{Rgb, RgbImage, imageops};
use std::collections::BTreeMap;
use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// Pixels between two panels.
const GAP: u32 = 4;
/// Keeps a strip below 60 KB.
const QUALITY: u8 = 82;

fn main() -> Result<(), Box<dyn Error>> {
    let folders: Vec<_> = std::env::args().skip(1).map(PathBuf::from).collect();
    let [panels, strips] = &folders[..] else {
        return Err("name the folder of the panels and that of the strips".into());
    };
    let mut groups = BTreeMap::<String, Vec<PathBuf>>::new();
    for entry in fs::read_dir(panels)? {
        let path = entry?.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if let Some((name, _)) = stem.rsplit_once('_') {
            groups.entry(name.into()).or_default().push(path);
        }
    }
    for (name, mut paths) in groups {
        paths.sort();
        write(
            &strips.join(&name).with_extension("jpg"),
            &joined(&paths, &name)?,
        )?;
    }
    Ok(())
}

/// The pictures from left to right on white.
fn joined(paths: &[PathBuf], name: &str) -> Result<RgbImage, Box<dyn Error>> {
    let open = |path: &PathBuf| Ok(image::open(path)?.into_rgb8());
    let panels = (paths.iter().map(open)).collect::<Result<Vec<_>, image::ImageError>>()?;
    let height = panels[0].height();
    if panels.iter().any(|panel| panel.height() != height) {
        return Err(format!("the panels of {name} differ in height").into());
    }
    let width = panels.iter().map(|panel| panel.width() + GAP).sum::<u32>() - GAP;
    let mut strip = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let mut x = 0;
    for panel in &panels {
        imageops::replace(&mut strip, panel, i64::from(x), 0);
        x += panel.width() + GAP;
    }
    Ok(strip)
}

fn write(path: &Path, strip: &RgbImage) -> Result<(), Box<dyn Error>> {
    let file = BufWriter::new(File::create(path)?);
    strip.write_with_encoder(JpegEncoder::new_with_quality(file, QUALITY))?;
    Ok(())
}
