//! Material libraries: the colours and numbers of MTL files, and their textures. Colours are taken as linear.

mod keys;
mod map;

pub(in crate::import) use keys::KEYS;
pub(super) use map::{Map, unquoted};

use super::lines::{Line, Lines};
use super::surface::Values;
use crate::import::faults::{CLAMPED, Faults};
use crate::import::notes::Notes;
use crate::import::number;
use crate::import::source::{Source, Token, quote};
use glam::{DMat3, DVec3, Vec3};
use glimray_scene::{Material, Phong};
use keys::{Color, Key, Number, Slot};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// Indices of refraction, by the specification.
const INDICES: RangeInclusive<f64> = 0.001..=10.0;

/// Number of different unknown keys that are named.
const MOST_UNKNOWN: usize = 16;

/// Linear Rec. 709 from CIE XYZ (IEC 61966-2-1), in rows.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.2406, -1.5372, -0.4986],
    [-0.9689, 1.8758, 0.0415],
    [0.0557, -0.2040, 1.0570],
];

/// A material without its images.
pub(super) struct Entry {
    pub material: Material,
    pub maps: Maps<String>,
    /// Whether it is clear glass although nothing dissolves it: see [`Values::is_clear_pane`].
    pub is_clear_pane: bool,
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
    pub roughness: Option<Map<N>>,
    pub metallic: Option<Map<N>>,
    pub sheen: Option<Map<N>>,
    pub coat: Option<Map<N>>,
    pub coat_roughness: Option<Map<N>>,
}

/// A material library whose text was checked.
pub(super) struct Library {
    pub source: Source,
    /// Whether `Tr` means what `d` does: see [`Habit`].
    tr_is_d: bool,
}

/// How a library uses `Tr` in materials without `d`. Most programs take it for 1 - d. MeshLab and others wrote it for d,
/// so that opaque materials have 1: nobody exports a library of invisible materials, so one with 1 and without 0 is
/// theirs.
#[derive(Default)]
struct Habit {
    zeros: usize,
    ones: usize,
}

impl Library {
    /// Checks the library in `source` and notes what is skipped or repaired.
    pub fn new(source: Source, notes: &mut Notes) -> Self {
        let mut reader = Reader::new(&source);
        let mut habit = Habit::default();
        reader.read(|draft| match (draft.values.d, draft.values.tr) {
            (None, Some(0.0)) => habit.zeros += 1,
            (None, Some(1.0)) => habit.ones += 1,
            _ => {}
        });
        reader.note(notes);
        let tr_is_d = habit.ones > 0 && habit.zeros == 0;
        if tr_is_d {
            notes.add("meanings of `Tr`", || {
                let count = habit.ones;
                format!("`Tr 1` without `d` read as opaque, as MeshLab writes it: {count}")
            });
        }
        Self { source, tr_is_d }
    }

    /// Calls `place` with the name of each material, and once more with the material if it returns true.
    pub fn materials(&self, mut place: impl FnMut(&[u8], Option<Entry>) -> bool) {
        Reader::new(&self.source).read(|mut draft| {
            if place(draft.name, None) {
                draft.values.tr_is_d = self.tr_is_d;
                let name = draft.name;
                place(name, Some(draft.entry()));
            }
        });
    }
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

struct Reader<'s> {
    source: &'s Source,
    faults: Faults,
    /// Numbers of skipped statements, options and forms, by name.
    left_out: BTreeMap<String, usize>,
    unknown: BTreeMap<String, usize>,
    more_unknown: usize,
}

impl<'s> Reader<'s> {
    fn new(source: &'s Source) -> Self {
        Self {
            source,
            faults: Faults::default(),
            left_out: BTreeMap::new(),
            unknown: BTreeMap::new(),
            more_unknown: 0,
        }
    }

    /// Calls `close` with each material.
    fn read(&mut self, mut close: impl FnMut(Draft<'s>)) {
        let mut draft: Option<Draft> = None;
        for mut line in Lines::new(&self.source.bytes) {
            let Some(word) = line.word() else {
                continue;
            };
            let found = keys::find(word.bytes);
            if let Some((_, Key::Name)) = found {
                if let Some(draft) = draft.replace(self.draft(word, &line)) {
                    close(draft);
                }
                continue;
            }
            match (found, &mut draft) {
                (None, _) => self.count_unknown(word),
                (Some((key, Key::Skipped)), _) => self.skipped(key, &line),
                (Some((key, meaning)), Some(draft)) => {
                    self.statement(key, meaning, word, &mut line, draft);
                }
                (Some((key, _)), None) => {
                    let what = "before the first `newmtl` skipped";
                    self.faults.add((key, what), self.source, word.span(), || {
                        let why = format!("`{key}` comes before the first `newmtl`");
                        (why, "Begin with `newmtl NAME`")
                    });
                }
            }
        }
        if let Some(draft) = draft {
            close(draft);
        }
    }

    fn draft(&mut self, keyword: Token, line: &Line<'s>) -> Draft<'s> {
        let name = line.rest().bytes;
        if name.is_empty() {
            let what = ("newmtl", "materials without a name");
            self.faults.add(what, self.source, keyword.span(), || {
                ("a material has no name".to_owned(), "Write `newmtl NAME`")
            });
        }
        Draft {
            name,
            diffuse: None,
            specular: None,
            emission: None,
            values: Values::default(),
            maps: Maps::default(),
        }
    }

    fn skipped(&mut self, key: &'static str, line: &Line) {
        // A number of 0 asks for nothing, and so does `off`.
        let rest = line.rest().bytes;
        if number::read(rest) != Some(0.0) && !rest.eq_ignore_ascii_case(b"off") {
            self.leave_out(key.to_owned());
        }
    }

    fn leave_out(&mut self, what: String) {
        *self.left_out.entry(what).or_default() += 1;
    }

    fn count_unknown(&mut self, word: Token) {
        let name = quote(word.bytes);
        if self.unknown.len() < MOST_UNKNOWN || self.unknown.contains_key(&name) {
            *self.unknown.entry(name).or_default() += 1;
        } else {
            self.more_unknown += 1;
        }
    }

    fn statement(
        &mut self,
        key: &'static str,
        meaning: Key,
        keyword: Token,
        line: &mut Line<'s>,
        draft: &mut Draft<'s>,
    ) {
        let values = &mut draft.values;
        match meaning {
            Key::Color(color) => {
                let Some(value) = self.color(key, keyword, line) else {
                    return;
                };
                match color {
                    Color::Diffuse => draft.diffuse = Some(value),
                    Color::Specular => draft.specular = Some(value),
                    Color::Emission => draft.emission = Some(value),
                    Color::Ambient => values.ka = Some(value),
                    Color::Filter => values.tf = Some(value.min(Vec3::ONE)),
                }
            }
            Key::Illum => {
                let number = self.number(key, keyword, line.word());
                match number.filter(|n| n.fract() == 0.0 && (0.0..=10.0).contains(n)) {
                    Some(model) => values.illum = model as u32,
                    None if number.is_some() => self.leave_out("illum other than 0 to 10".into()),
                    None => {}
                }
            }
            Key::Number(number) => {
                if line.rest().bytes.starts_with(b"-halo") {
                    line.word();
                    self.leave_out(format!("{key} -halo"));
                }
                if let Some(value) = self.number(key, keyword, line.word()) {
                    self.set(key, number, value, keyword, values);
                }
            }
            Key::Map(slot) => {
                let map = Map::read(line, |option| {
                    let option = String::from_utf8_lossy(option).chars().take(32).collect();
                    let option: String = option;
                    *self.left_out.entry(format!("{key} {option}")).or_default() += 1;
                });
                if map.is_none() {
                    let what = (key, "pictures without a file skipped");
                    self.faults.add(what, self.source, keyword.span(), || {
                        (format!("`{key}` has no file"), "Add its name")
                    });
                } else if slot != Slot::Bump && map.is_some_and(|map| map.height != 1.0) {
                    self.leave_out(format!("{key} -bm"));
                }
                *draft.maps.slot(slot) = map;
            }
            Key::Name | Key::Skipped => {}
        }
    }

    fn set(
        &mut self,
        key: &'static str,
        number: Number,
        value: f64,
        keyword: Token,
        values: &mut Values,
    ) {
        let range = match number {
            Number::Shininess | Number::Rotation => 0.0..=f64::from(f32::MAX),
            // Some exporters write 0 for none.
            Number::Index if value == 0.0 => 0.0..=0.0,
            Number::Index => INDICES,
            _ => 0.0..=1.0,
        };
        if !range.contains(&value) {
            self.faults
                .add((key, CLAMPED), self.source, keyword.span(), || {
                    let why = format!("{value} in `{key}` is out of range");
                    (why, "Write a number within it")
                });
        }
        let value = value.clamp(*range.start(), *range.end()) as f32;
        match number {
            Number::Shininess => values.ns = value,
            Number::Index => values.ni = if value > 0.0 { value } else { 1.0 },
            Number::Dissolve => values.d = Some(value),
            Number::Transparency => values.tr = Some(value),
            Number::Roughness => values.pr = Some(value),
            Number::Metallic => values.pm = Some(value),
            Number::Sheen => values.ps = Some(value),
            Number::Coat => values.pc = Some(value),
            Number::CoatRoughness => values.pcr = Some(value),
            Number::Anisotropy => values.aniso = value,
            Number::Rotation => values.anisor = value,
        }
    }

    /// `None` for spectral colours and those that cannot be read.
    fn color(&mut self, key: &'static str, keyword: Token, line: &mut Line) -> Option<Vec3> {
        let mut first = line.word();
        let is = |word: Option<Token>, name: &[u8]| {
            word.is_some_and(|word| word.bytes.eq_ignore_ascii_case(name))
        };
        if is(first, b"spectral") {
            self.leave_out(format!("{key} spectral"));
            return None;
        }
        let is_xyz = is(first, b"xyz");
        if is_xyz {
            first = line.word();
        }
        let mut color = DVec3::splat(self.at_least_zero(key, keyword, first)?);
        // One number stands for three.
        if let Some(second) = line.word() {
            color.y = self.at_least_zero(key, keyword, Some(second))?;
            color.z = self.at_least_zero(key, keyword, line.word())?;
        }
        if is_xyz {
            color = DMat3::from_cols_array_2d(&RGB_FROM_XYZ).transpose() * color;
        }
        Some(color.max(DVec3::ZERO).as_vec3())
    }

    fn number(&mut self, key: &'static str, keyword: Token, word: Option<Token>) -> Option<f64> {
        if let Some(word) = word {
            return self.faults.number(key, self.source, word);
        }
        let what = (key, "without a number skipped");
        self.faults.add(what, self.source, keyword.span(), || {
            (format!("`{key}` lacks a number"), "Add the number")
        });
        None
    }

    fn at_least_zero(
        &mut self,
        key: &'static str,
        keyword: Token,
        word: Option<Token>,
    ) -> Option<f64> {
        match word {
            Some(word) => self.faults.at_least_zero(key, self.source, word),
            None => self.number(key, keyword, None),
        }
    }

    fn note(self, notes: &mut Notes) {
        const WHAT: &str = "material files with skipped parts";
        let mut add = |what: &str, counts: &mut dyn Iterator<Item = String>| {
            let list: Vec<String> = counts.collect();
            if !list.is_empty() {
                notes.add(WHAT, || format!("{what}: {}", list.join(", ")));
            }
        };
        let named = |(what, count): (&String, &usize)| format!("`{what}` {count}");
        add("skipped in materials", &mut self.left_out.iter().map(named));
        let more = (self.more_unknown > 0).then(|| format!("others {}", self.more_unknown));
        let unknown = self
            .unknown
            .iter()
            .map(|(name, count)| format!("{name} {count}"));
        add("unknown in materials", &mut unknown.chain(more));
        let name = self.source.path.file_name().unwrap_or_default();
        self.faults.note(notes, Some(&name.to_string_lossy()));
    }
}

impl<N> Maps<N> {
    fn slot(&mut self, slot: Slot) -> &mut Option<Map<N>> {
        match slot {
            Slot::Diffuse => &mut self.diffuse,
            Slot::Specular => &mut self.specular,
            Slot::Ambient => &mut self.ambient,
            Slot::Emission => &mut self.emission,
            Slot::Normal => &mut self.normal,
            Slot::Bump => &mut self.bump,
            Slot::Alpha => &mut self.alpha,
            Slot::Roughness => &mut self.roughness,
            Slot::Metallic => &mut self.metallic,
            Slot::Sheen => &mut self.sheen,
            Slot::Coat => &mut self.coat,
            Slot::CoatRoughness => &mut self.coat_roughness,
        }
    }
}

impl Draft<'_> {
    fn entry(mut self) -> Entry {
        // An image without a colour or a number is shown unchanged.
        let white = |is_image: bool| is_image.then_some(Vec3::ONE);
        let one = |is_image: bool| is_image.then_some(1.0);
        let (maps, values) = (&self.maps, &mut self.values);
        let default = Phong::default();
        let is_pictured = maps.diffuse.is_some();
        values.kd = (self.diffuse.or(white(is_pictured))).unwrap_or(default.diffuse);
        values.ks = (self.specular.or(white(maps.specular.is_some()))).unwrap_or(default.specular);
        values.ke = (self.emission.or(white(maps.emission.is_some()))).unwrap_or_default();
        values.pr = values.pr.or(one(maps.roughness.is_some()));
        values.pm = values.pm.or(one(maps.metallic.is_some()));
        values.ps = values.ps.or(one(maps.sheen.is_some()));
        values.pc = values.pc.or(one(maps.coat.is_some()));
        values.pcr = values.pcr.or(one(maps.coat_roughness.is_some()));
        let text = |map: Option<Map<&[u8]>>| map.map(Map::to_text);
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
                roughness: text(maps.roughness),
                metallic: text(maps.metallic),
                sheen: text(maps.sheen),
                coat: text(maps.coat),
                coat_roughness: text(maps.coat_roughness),
            },
            is_clear_pane: values.is_clear_pane(),
        };
        if values.illum == 0 && entry.maps.emission.is_none() {
            entry.maps.emission = entry.maps.diffuse.take();
        }
        entry
    }
}
