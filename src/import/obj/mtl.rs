//! Material libraries: `Kd`, `Ks`, `Ns` and `Ka` of MTL files. Colours are taken as linear.

use super::lines::{Line, Lines};
use crate::import::error::ImportError;
use crate::import::number;
use crate::import::source::{Source, Token};
use crate::scene::Material;
use glam::Vec3;
use std::collections::{BTreeMap, HashMap};

/// The materials of one file.
#[derive(Default)]
pub(super) struct Library {
    pub materials: HashMap<String, Material>,
    /// Notes for [`crate::scene::Scene::skipped`].
    pub skipped: Vec<String>,
}

/// A material while it is read.
struct Draft {
    material: Material,
    ambient: Option<Vec3>,
}

/// The library in `source`.
pub(super) fn read(source: &Source) -> Result<Library, ImportError> {
    let mut library = Library::default();
    let mut draft: Option<Draft> = None;
    let mut left_out: BTreeMap<&str, usize> = BTreeMap::new();
    for mut line in Lines::new(&source.bytes) {
        let Some(keyword) = line.word() else {
            continue;
        };
        if keyword.bytes == b"newmtl" {
            library.insert(draft.replace(begin(source, keyword, &line)?));
            continue;
        }
        let Some(Draft { material, ambient }) = &mut draft else {
            let why = format!("{} stands before the first `newmtl`", keyword.quote());
            return Err(source.malformed(keyword.span(), why, "Begin with `newmtl NAME`"));
        };
        match keyword.bytes {
            b"Kd" | b"Ks" | b"Ka" => match color(source, keyword, &mut line)? {
                None => *left_out.entry("spectral colours").or_default() += 1,
                Some(color) if keyword.bytes == b"Kd" => material.diffuse = color,
                Some(color) if keyword.bytes == b"Ks" => material.specular = color,
                Some(color) => *ambient = Some(color),
            },
            b"Ns" => material.shininess = at_least_zero(source, keyword, line.word())?,
            b"d" if line.rest().bytes.starts_with(b"-halo") => {}
            b"d" | b"Tr" => {
                let opaque = if keyword.bytes == b"d" { 1.0 } else { 0.0 };
                if at_least_zero(source, keyword, line.word())? != opaque {
                    *left_out.entry("transparency").or_default() += 1;
                }
            }
            word if word.starts_with(b"map_") || matches!(word, b"bump" | b"disp" | b"refl") => {
                *left_out.entry("textures").or_default() += 1;
            }
            _ => {}
        }
    }
    library.insert(draft);
    let notes = left_out
        .iter()
        .map(|(what, count)| format!("{what} of materials left out: {count}"));
    library.skipped.extend(notes);
    Ok(library)
}

impl Library {
    fn insert(&mut self, draft: Option<Draft>) {
        if let Some(Draft {
            mut material,
            ambient,
        }) = draft
        {
            material.ambient = ambient.unwrap_or(material.diffuse);
            // The first of two equal names is the one that viewers take.
            self.materials
                .entry(material.name.clone())
                .or_insert(material);
        }
    }
}

fn begin(source: &Source, keyword: Token, line: &Line) -> Result<Draft, ImportError> {
    let name = line.rest().bytes;
    if name.is_empty() {
        let why = "a material has no name".to_owned();
        return Err(source.malformed(keyword.span(), why, "Write `newmtl NAME`"));
    }
    let name = String::from_utf8_lossy(name).into_owned();
    Ok(Draft {
        material: Material {
            name,
            ..Material::default()
        },
        ambient: None,
    })
}

/// `None` for colours that are given as spectra.
fn color(source: &Source, keyword: Token, line: &mut Line) -> Result<Option<Vec3>, ImportError> {
    let first = line.word();
    if first.is_some_and(|word| matches!(word.bytes, b"spectral" | b"xyz")) {
        return Ok(None);
    }
    let red = at_least_zero(source, keyword, first)?;
    // One number stands for three.
    let Some(second) = line.word() else {
        return Ok(Some(Vec3::splat(red)));
    };
    let green = at_least_zero(source, keyword, Some(second))?;
    let blue = at_least_zero(source, keyword, line.word())?;
    Ok(Some(Vec3::new(red, green, blue)))
}

fn at_least_zero(source: &Source, keyword: Token, word: Option<Token>) -> Result<f32, ImportError> {
    let Some(word) = word else {
        let why = format!("{} lacks a number", keyword.quote());
        return Err(source.malformed(keyword.span(), why, "Add it"));
    };
    match number::parse(source, word)? {
        value if value >= 0.0 => Ok(value as f32),
        _ => {
            let why = format!("{} in {} is negative", word.quote(), keyword.quote());
            Err(source.malformed(word.span(), why, "Write 0 or more"))
        }
    }
}
