//! Material libraries: `Kd`, `Ks`, `Ns` and `Ka` of MTL files, and pictures in their place. Colours
//! are taken as linear.

use super::lines::{Line, Lines};
use crate::import::error::ImportError;
use crate::import::number;
use crate::import::source::{Source, Token};
use crate::scene::Material;
use glam::Vec3;
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;

/// The materials of one file.
#[derive(Default)]
pub(super) struct Library {
    pub materials: HashMap<String, Entry>,
    /// Notes for [`crate::scene::Scene::skipped`].
    pub skipped: Vec<String>,
}

/// A material, still without its pictures.
#[derive(Clone)]
pub(super) struct Entry {
    pub material: Material,
    pub maps: Maps,
    /// The file that it stands in, which the names of pictures are relative to.
    pub file: PathBuf,
}

/// File names of pictures that colours are multiplied by.
#[derive(Clone, Default)]
pub(super) struct Maps {
    pub diffuse: Option<String>,
    pub specular: Option<String>,
    pub ambient: Option<String>,
}

/// A material while it is read.
struct Draft {
    name: String,
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    ambient: Option<Vec3>,
    shininess: f32,
    maps: Maps,
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
            library.insert(source, draft.replace(begin(source, keyword, &line)?));
            continue;
        }
        let Some(draft) = &mut draft else {
            let why = format!("{} stands before the first `newmtl`", keyword.quote());
            return Err(source.malformed(keyword.span(), why, "Begin with `newmtl NAME`"));
        };
        match keyword.bytes {
            b"Kd" | b"Ks" | b"Ka" => match color(source, keyword, &mut line)? {
                None => *left_out.entry("spectral colours").or_default() += 1,
                color if keyword.bytes == b"Kd" => draft.diffuse = color,
                color if keyword.bytes == b"Ks" => draft.specular = color,
                color => draft.ambient = color,
            },
            b"Ns" => draft.shininess = at_least_zero(source, keyword, line.word())?,
            b"d" if line.rest().bytes.starts_with(b"-halo") => {}
            b"d" | b"Tr" => {
                let opaque = if keyword.bytes == b"d" { 1.0 } else { 0.0 };
                if at_least_zero(source, keyword, line.word())? != opaque {
                    *left_out.entry("transparency").or_default() += 1;
                }
            }
            b"map_Kd" | b"map_Ks" | b"map_Ka" => {
                if skip_options(&mut line) {
                    *left_out.entry("options of textures").or_default() += 1;
                }
                let name = line.rest().bytes;
                let name = (!name.is_empty()).then(|| String::from_utf8_lossy(name).into_owned());
                match keyword.bytes {
                    b"map_Kd" => draft.maps.diffuse = name,
                    b"map_Ks" => draft.maps.specular = name,
                    _ => draft.maps.ambient = name,
                }
            }
            word if word.starts_with(b"map_") || matches!(word, b"bump" | b"disp" | b"refl") => {
                *left_out.entry("other textures").or_default() += 1;
            }
            _ => {}
        }
    }
    library.insert(source, draft);
    let notes = left_out
        .iter()
        .map(|(what, count)| format!("{what} of materials left out: {count}"));
    library.skipped.extend(notes);
    Ok(library)
}

/// Moves behind the options of a texture and says whether there were any.
fn skip_options(line: &mut Line) -> bool {
    let mut found = false;
    while line.rest().bytes.starts_with(b"-") {
        let Some(option) = line.word() else { break };
        found = true;
        let (least, most) = match option.bytes {
            b"-mm" => (2, 2),
            b"-o" | b"-s" | b"-t" => (1, 3),
            _ => (1, 1),
        };
        for i in 0..most {
            let next = line.rest().bytes.split(u8::is_ascii_whitespace).next();
            let text = next.and_then(|word| std::str::from_utf8(word).ok());
            let is_number = text.is_some_and(|text| text.parse::<f64>().is_ok());
            if i >= least && !is_number {
                break;
            }
            line.word();
        }
    }
    found
}

impl Library {
    fn insert(&mut self, source: &Source, draft: Option<Draft>) {
        let Some(draft) = draft else { return };
        // A picture alone is shown as it is.
        let or_white = |color: Option<Vec3>, map: &Option<String>, default: Vec3| {
            color.unwrap_or(if map.is_some() { Vec3::ONE } else { default })
        };
        let Maps {
            diffuse, specular, ..
        } = &draft.maps;
        let diffuse = or_white(draft.diffuse, diffuse, Material::default().diffuse);
        let specular = or_white(draft.specular, specular, Material::default().specular);
        let material = Material {
            name: draft.name,
            diffuse,
            specular,
            ambient: draft.ambient.unwrap_or(diffuse),
            shininess: draft.shininess,
            ..Material::default()
        };
        let entry = Entry {
            material,
            maps: draft.maps,
            file: source.path.clone(),
        };
        // The first of two equal names is the one that viewers take.
        self.materials
            .entry(entry.material.name.clone())
            .or_insert(entry);
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
        name,
        diffuse: None,
        specular: None,
        ambient: None,
        shininess: Material::default().shininess,
        maps: Maps::default(),
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
