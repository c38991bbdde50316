//! Material libraries: the colours and numbers of MTL files, and their textures. Colours are taken as linear.

use super::lines::{Line, Lines};
use super::surface::Values;
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::number;
use crate::import::source::{Source, Token};
use crate::scene::Material;
use glam::{DAffine3, DVec3, Vec3};
use std::collections::BTreeMap;

/// Textures and numbers that are skipped by name: the renderer has no such thing.
const SKIPPED: [&str; 10] = [
    "map_Tr", "map_Ns", "map_Pr", "map_Pm", "map_Ps", "map_Pc", "disp", "decal", "refl", "map_refl",
];

/// Names of height maps, in upper or lower case.
const HEIGHTS: [&str; 2] = ["map_Bump", "bump"];

/// A material without its images.
pub(super) struct Entry {
    pub material: Material,
    pub maps: Maps<String>,
}

/// An image that multiplies a colour.
#[derive(Clone, Copy)]
pub(super) struct Map<N> {
    /// Its file.
    pub name: N,
    /// By `-s` and `-o`.
    pub picture_from_uv: DAffine3,
    /// By `-bm`: how high white is in a height map, in texels.
    pub height: f64,
}

/// The images of a material.
#[derive(Clone, Copy, Default)]
pub(super) struct Maps<N> {
    pub diffuse: Option<Map<N>>,
    pub specular: Option<Map<N>>,
    pub ambient: Option<Map<N>>,
    pub emission: Option<Map<N>>,
    /// The shading normal.
    pub normal: Option<Map<N>>,
    /// The height of the surface, which a normal map replaces.
    pub bump: Option<Map<N>>,
    /// How much of the surface is there.
    pub alpha: Option<Map<N>>,
}

/// A material while it is parsed. It owns no memory: a library may have millions.
struct Draft<'s> {
    name: &'s [u8],
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    emission: Option<Vec3>,
    values: Values,
    maps: Maps<&'s [u8]>,
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
            b"Kd" | b"Ks" | b"Ka" | b"Ke" | b"Tf" => {
                let color = color(source, keyword, &mut line)?;
                match (keyword.bytes, color) {
                    (_, None) => *left_out.entry("spectral colours").or_default() += 1,
                    (b"Kd", color) => draft.diffuse = color,
                    (b"Ks", color) => draft.specular = color,
                    (b"Ke", color) => draft.emission = color,
                    (b"Ka", color) => draft.values.ka = color,
                    (_, Some(color)) => draft.values.tf = color.min(Vec3::ONE),
                }
            }
            b"d" if line.rest().bytes.starts_with(b"-halo") => {
                *left_out.entry("`d -halo`").or_default() += 1;
            }
            b"illum" => {
                let model = at_least_zero(source, keyword, line.word())? as u32;
                draft.values.illum = model;
                if model > 9 {
                    *left_out.entry("`illum` above 9").or_default() += 1;
                }
            }
            b"Ns" | b"Ni" | b"d" | b"Tr" | b"Pr" | b"Pm" | b"Ps" | b"Pc" | b"Pcr" | b"aniso"
            | b"anisor" => {
                let number = at_least_zero(source, keyword, line.word())?;
                let values = &mut draft.values;
                match keyword.bytes {
                    b"Ns" => values.ns = number,
                    b"Ni" => values.ni = number,
                    b"d" => values.d = number,
                    b"Tr" => values.d = (1.0 - number).max(0.0),
                    b"Pr" => values.pr = Some(number),
                    b"Ps" => values.ps = number,
                    b"Pc" => values.pc = number,
                    b"Pcr" => values.pcr = number,
                    b"aniso" => values.aniso = number,
                    b"anisor" => values.anisor = number,
                    _ => values.pm = Some(number),
                }
            }
            b"map_Kd" | b"map_Ks" | b"map_Ka" | b"map_Ke" | b"norm" | b"map_d" | b"map_opacity" => {
                let (map, is_complete) = map(&mut line);
                if !is_complete || map.is_some_and(|map| map.height != 1.0) {
                    *left_out.entry("texture options").or_default() += 1;
                }
                match keyword.bytes {
                    b"map_Kd" => draft.maps.diffuse = map,
                    b"map_Ks" => draft.maps.specular = map,
                    b"map_Ka" => draft.maps.ambient = map,
                    b"norm" => draft.maps.normal = map,
                    b"map_d" | b"map_opacity" => draft.maps.alpha = map,
                    _ => draft.maps.emission = map,
                }
            }
            word if HEIGHTS
                .iter()
                .any(|name| word.eq_ignore_ascii_case(name.as_bytes())) =>
            {
                let (map, is_complete) = map(&mut line);
                if !is_complete {
                    *left_out.entry("texture options").or_default() += 1;
                }
                draft.maps.bump = map;
            }
            word => {
                let is_named = |name: &&&str| word.eq_ignore_ascii_case(name.as_bytes());
                if let Some(name) = SKIPPED.iter().find(is_named) {
                    // A number of 0 asks for nothing.
                    let rest = line.rest().bytes;
                    let is_zero = std::str::from_utf8(rest).is_ok_and(|t| t.parse() == Ok(0.0));
                    if !is_zero {
                        *left_out.entry(name).or_default() += 1;
                    }
                } else if word.starts_with(b"map_") {
                    *left_out.entry("other textures").or_default() += 1;
                }
            }
        }
    }
    close(draft);
    const WHAT: &str = "material files with skipped parts";
    let (named, others): (Vec<_>, Vec<_>) =
        (left_out.into_iter()).partition(|(what, _)| SKIPPED.contains(what));
    for (what, count) in others {
        notes.add(WHAT, || format!("{what} of materials skipped: {count}"));
    }
    if !named.is_empty() {
        let named = named
            .iter()
            .map(|(what, count)| format!("`{what}` {count}"));
        let named: Vec<_> = named.collect();
        notes.add(WHAT, || {
            format!("skipped in materials: {}", named.join(", "))
        });
    }
    Ok(())
}

/// Reads a texture, with its transform by `-s` and `-o` and its height by `-bm`, and whether these are all of its
/// options. `None` without a name.
fn map<'s>(line: &mut Line<'s>) -> (Option<Map<&'s [u8]>>, bool) {
    let mut is_complete = true;
    let mut height = 1.0;
    let (mut scale, mut offset) = (DVec3::ONE, DVec3::ZERO);
    while line.rest().bytes.starts_with(b"-") {
        let Some(option) = line.word() else { break };
        let (least, most) = match option.bytes {
            b"-mm" => (2, 2),
            b"-o" | b"-s" | b"-t" => (1, 3),
            _ => (1, 1),
        };
        let mut numbers: Vec<f64> = Vec::new();
        for i in 0..most {
            let next = line.rest().bytes.split(u8::is_ascii_whitespace).next();
            let text = next.and_then(|word| std::str::from_utf8(word).ok());
            let number = text.and_then(|text| text.parse::<f64>().ok());
            if i >= least && number.is_none() {
                break;
            }
            // Beyond this, f32 has whole numbers only.
            numbers.extend(number.filter(|n| n.is_finite()).map(|n| n.clamp(-1e9, 1e9)));
            line.word();
        }
        match (option.bytes, &numbers[..]) {
            (b"-s", [first, ..]) if numbers.iter().all(|n| *n != 0.0) => {
                scale = DVec3::new(*first, numbers.get(1).copied().unwrap_or(1.0), 1.0);
            }
            (b"-o", [first, ..]) => {
                offset = DVec3::new(*first, numbers.get(1).copied().unwrap_or(0.0), 0.0);
            }
            (b"-bm", [number]) => height = *number,
            _ => is_complete = false,
        }
    }
    let name = line.rest().bytes;
    let map = Map {
        name,
        picture_from_uv: DAffine3::from_translation(offset) * DAffine3::from_scale(scale),
        height,
    };
    ((!name.is_empty()).then_some(map), is_complete)
}

impl Draft<'_> {
    fn entry(self) -> Entry {
        let text = |map: Option<Map<&[u8]>>| {
            map.map(|map| Map {
                name: String::from_utf8_lossy(map.name).into_owned(),
                picture_from_uv: map.picture_from_uv,
                height: map.height,
            })
        };
        // An image without a colour is shown unchanged.
        let or_white = |color: Option<Vec3>, is_image: bool, default: Vec3| {
            color.unwrap_or(if is_image { Vec3::ONE } else { default })
        };
        let maps = &self.maps;
        let values = Values {
            kd: or_white(self.diffuse, maps.diffuse.is_some(), self.values.kd),
            ks: or_white(self.specular, maps.specular.is_some(), self.values.ks),
            ke: or_white(self.emission, maps.emission.is_some(), self.values.ke),
            ..self.values
        };
        let mut entry = Entry {
            material: Material {
                name: String::from_utf8_lossy(self.name).into_owned(),
                ..values.material()
            },
            maps: Maps {
                diffuse: text(maps.diffuse),
                specular: text(maps.specular),
                ambient: text(maps.ambient),
                emission: text(maps.emission),
                normal: text(maps.normal),
                bump: text(maps.bump),
                alpha: text(maps.alpha),
            },
        };
        if values.illum == 0 && entry.maps.emission.is_none() {
            entry.maps.emission = entry.maps.diffuse.take();
        }
        entry
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
    let default = Material::default();
    Ok(Draft {
        name,
        diffuse: None,
        specular: None,
        emission: None,
        values: Values {
            kd: default.diffuse,
            ks: default.specular,
            ka: None,
            ke: Vec3::ZERO,
            tf: Vec3::ONE,
            ns: default.shininess,
            ni: 1.0,
            d: 1.0,
            illum: 2,
            pr: None,
            pm: None,
            ps: 0.0,
            pc: 0.0,
            pcr: 0.0,
            aniso: 0.0,
            anisor: 0.0,
        },
        maps: Maps::default(),
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
