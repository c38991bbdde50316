//! Material libraries: `Kd`, `Ks`, `Ns` and `Ka` of MTL files, and their textures. Colours are taken as
//! linear.

use super::lines::{Line, Lines};
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::number;
use crate::import::source::{Source, Token};
use crate::scene::Material;
use glam::Vec3;
use std::collections::BTreeMap;

/// A material without its images.
pub(super) struct Entry {
    pub material: Material,
    pub maps: Maps,
}

/// File names of the images that multiply the colours.
#[derive(Default)]
pub(super) struct Maps {
    pub diffuse: Option<String>,
    pub specular: Option<String>,
    pub ambient: Option<String>,
}

/// A material while it is parsed. It owns no memory: a library may have millions.
struct Draft<'s> {
    name: &'s [u8],
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    ambient: Option<Vec3>,
    shininess: f32,
    map_diffuse: Option<&'s [u8]>,
    map_specular: Option<&'s [u8]>,
    map_ambient: Option<&'s [u8]>,
}

/// Validates the library in `source` and returns those of its materials that `place` assigns an index to,
/// by name. Notes go to `notes`.
pub(super) fn read(
    source: &Source,
    notes: &mut Notes,
    mut place: impl FnMut(&[u8], Option<Entry>) -> bool,
) -> Result<(), ImportError> {
    let mut close = |draft: Option<Draft>| {
        if let Some(draft) = draft.filter(|draft| place(draft.name, None)) {
            place(draft.name, Some(draft.entry()));
        }
    };
    let mut draft: Option<Draft> = None;
    let mut left_out: BTreeMap<&str, usize> = BTreeMap::new();
    for mut line in Lines::new(&source.bytes) {
        let Some(keyword) = line.word() else {
            continue;
        };
        if keyword.bytes == b"newmtl" {
            close(draft.replace(new_draft(source, keyword, &line)?));
            continue;
        }
        let Some(draft) = &mut draft else {
            let why = format!("{} comes before the first `newmtl`", keyword.quote());
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
                    *left_out.entry("texture options").or_default() += 1;
                }
                let name = line.rest().bytes;
                let name = (!name.is_empty()).then_some(name);
                match keyword.bytes {
                    b"map_Kd" => draft.map_diffuse = name,
                    b"map_Ks" => draft.map_specular = name,
                    _ => draft.map_ambient = name,
                }
            }
            word if word.starts_with(b"map_") || matches!(word, b"bump" | b"disp" | b"refl") => {
                *left_out.entry("other textures").or_default() += 1;
            }
            _ => {}
        }
    }
    close(draft);
    for (what, count) in left_out {
        notes.add("material files with skipped parts", || {
            format!("{what} of materials skipped: {count}")
        });
    }
    Ok(())
}

/// Skips the options of a texture and returns whether there were any.
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

impl Draft<'_> {
    fn entry(self) -> Entry {
        // An image without a colour is shown unchanged.
        let or_white = |color: Option<Vec3>, map: Option<&[u8]>, default: Vec3| {
            color.unwrap_or(if map.is_some() { Vec3::ONE } else { default })
        };
        let default = Material::default();
        let diffuse = or_white(self.diffuse, self.map_diffuse, default.diffuse);
        let specular = or_white(self.specular, self.map_specular, default.specular);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Entry {
            material: Material {
                name: text(self.name),
                diffuse,
                specular,
                ambient: self.ambient.unwrap_or(diffuse),
                shininess: self.shininess,
                ..default
            },
            maps: Maps {
                diffuse: self.map_diffuse.map(text),
                specular: self.map_specular.map(text),
                ambient: self.map_ambient.map(text),
            },
        }
    }
}

fn new_draft<'s>(
    source: &Source,
    keyword: Token,
    line: &Line<'s>,
) -> Result<Draft<'s>, ImportError> {
    let name = line.rest().bytes;
    if name.is_empty() {
        let why = "a material has no name".to_owned();
        return Err(source.malformed(keyword.span(), why, "Write `newmtl NAME`"));
    }
    Ok(Draft {
        name,
        diffuse: None,
        specular: None,
        ambient: None,
        shininess: Material::default().shininess,
        map_diffuse: None,
        map_specular: None,
        map_ambient: None,
    })
}

/// `None` for spectral colours.
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
        return Err(source.malformed(keyword.span(), why, "Add the number"));
    };
    match number::parse(source, word)? {
        value if value >= 0.0 => Ok(value as f32),
        _ => {
            let why = format!("{} in {} is negative", word.quote(), keyword.quote());
            Err(source.malformed(word.span(), why, "Write 0 or more"))
        }
    }
}
