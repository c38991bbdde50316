//! The course's format (`.scene`): CV 804 exercise 4 and its parent, USC CSCI 420 assignment 3.
//!
//! ```text
//! file     := N  "amb:" r g b  object*          N counts lights too
//! object   := sphere | triangle | light
//! sphere   := "sphere"   "pos:" x y z  "rad:" r  "dif:" r g b  "spe:" r g b  "shi:" s
//! triangle := "triangle" vertex vertex vertex
//! vertex   := "pos:" x y z  "nor:" x y z  "dif:" r g b  "spe:" r g b  "shi:" s
//! light    := "light"    "pos:" x y z  "col:" r g b
//! ```
//! Accepted as found in practice: keys of an object in any order and case, a wrong `N`, `#` and `//`
//! comments, and the extensions `ref:`, which is not rendered, and `area_light:`, which turns a light
//! into a rectangle: `pos:` is its centre, `area_u:` and `area_v:` are its edges.

pub(super) use tokens::KEYS;

mod area;
mod palette;
mod tokens;

use super::budget::{self, Budget};
use super::error::ImportError;
use super::faults::Faults;
use super::notes::{self, Notes};
use super::source::{Source, Token};
use super::suggest;
use area::Area;
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{
    Background, Camera, Geometry, Instance, Light, LightKind, Mesh, OutputDefaults, Scene, Shape,
    Transfer,
};
use palette::Palette;
use tokens::Tokens;

/// One `key:` of an object or vertex.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Key {
    Pos,
    Nor,
    Dif,
    Spe,
    Shi,
    Rad,
    Col,
}

use Key::{Col, Dif, Nor, Pos, Rad, Shi, Spe};

const SPHERE: &[Key] = &[Pos, Rad, Dif, Spe, Shi];
const VERTEX: &[Key] = &[Pos, Nor, Dif, Spe, Shi];
const LIGHT: &[Key] = &[Pos, Col];
const OBJECTS: [&str; 3] = ["sphere", "triangle", "light"];

/// Keys that student renderers added, and the number of words that follow them.
const EXTENSIONS: [(&str, usize); 5] = [
    ("ref:", 1),
    ("area_light:", 1),
    ("area_u:", 3),
    ("area_v:", 3),
    ("samples:", 1),
];

/// The values of one object or vertex by [`Key`]; single numbers are in the first component.
type Fields = [Option<[f64; 3]>; 7];

impl Key {
    fn name(self) -> &'static str {
        KEYS[self as usize]
    }

    fn of(self, fields: &Fields) -> DVec3 {
        DVec3::from(fields[self as usize].unwrap_or_default())
    }
}

/// The scene in `source`, with the output settings of the course.
pub(super) fn read(source: &Source) -> Result<Scene, ImportError> {
    let mut reader = Reader {
        source,
        tokens: Tokens::new(&source.bytes),
        scene: Scene {
            background: Background::Color(Vec3::ONE),
            cameras: vec![Camera::default()],
            output: OutputDefaults {
                transfer: Transfer::Linear,
                max_depth: 0,
                ..OutputDefaults::default()
            },
            ..Scene::default()
        },
        mesh: Mesh::default(),
        positions: Vec::new(),
        palette: Palette::default(),
        extensions: [0; 5],
        area: Area::default(),
        faults: Faults::default(),
    };
    let announced = reader.header()?;
    let budget = Budget::of(source.bytes.len());
    let mut found = 0_u64;
    while let Some(token) = reader.next_object()? {
        reader.object(token)?;
        found += 1;
        let refuse = |why, todo: &str| source.malformed(token.span(), why, todo);
        budget.check(reader.memory(), refuse)?;
    }
    reader.close_light();
    if announced != found as f64 {
        let note = format!(
            "the file announces {announced} objects, but contains {found}: all of them are read"
        );
        reader.scene.skipped.push(note);
    }
    reader.finish()
}

struct Reader<'s> {
    source: &'s Source,
    tokens: Tokens<'s>,
    scene: Scene,
    /// All triangles, without their positions.
    mesh: Mesh,
    positions: Vec<DVec3>,
    palette: Palette,
    /// How often each of [`EXTENSIONS`] occurred without effect.
    extensions: [usize; 5],
    /// The extent that the current object specifies.
    area: Area<'s>,
    faults: Faults,
}

impl<'s> Reader<'s> {
    /// Reads up to the first object and returns the announced number of objects.
    fn header(&mut self) -> Result<f64, ImportError> {
        let token = self.expect("the number of objects ", "N")?;
        let announced = self.faults.number_or_nan("N", self.source, token)?;
        let token = self.expect("", "amb:")?;
        if !token.bytes.eq_ignore_ascii_case(b"amb:") {
            let why = format!("expected `amb:`, found {}", token.quote());
            return Err(self.refuse(token, why, "Begin the file with N and `amb: R G B`"));
        }
        self.scene.ambient = DVec3::from(self.color("amb:")?).as_vec3();
        Ok(announced)
    }

    /// The memory that the file takes so far, including later steps.
    fn memory(&self) -> u64 {
        self.source.bytes.len() as u64
            + budget::size::<Shape>(self.scene.shapes.len())
            + budget::size::<Light>(self.scene.lights.len())
            + budget::size::<(DVec3, [Vec3; 2], u32)>(self.positions.len())
            + budget::size::<[u32; 3]>(self.mesh.triangles.len())
            + self.palette.memory()
    }

    /// The keyword of the next object; `None` at the end.
    fn next_object(&mut self) -> Result<Option<Token<'s>>, ImportError> {
        while let Some(token) = self.tokens.next() {
            if !self.is_extension(token)? {
                return Ok(Some(token));
            }
        }
        Ok(None)
    }

    fn object(&mut self, keyword: Token<'s>) -> Result<(), ImportError> {
        self.close_light();
        match keyword.bytes.to_ascii_lowercase().as_slice() {
            b"sphere" => self.sphere(),
            b"triangle" => self.triangle(),
            b"light" => self.light(),
            word => {
                let why = suggest::unknown("object", &String::from_utf8_lossy(word), OBJECTS);
                let todo = "Objects are `sphere`, `triangle` and `light`";
                Err(self.refuse(keyword, why, todo))
            }
        }
    }

    fn sphere(&mut self) -> Result<(), ImportError> {
        let fields = self.fields("sphere", SPHERE)?;
        if Pos.of(&fields).is_nan() || Rad.of(&fields).is_nan() {
            return Ok(());
        }
        let shape = Shape {
            geometry: Geometry::Sphere {
                center: Pos.of(&fields),
                radius: Rad.of(&fields).x,
            },
            material: self.material(&fields) as usize,
            node: None,
            name: String::new(),
        };
        self.scene.shapes.push(shape);
        Ok(())
    }

    fn triangle(&mut self) -> Result<(), ImportError> {
        let first = self.positions.len();
        for _ in 0..3 {
            let fields = self.fields("triangle", VERTEX)?;
            self.positions.push(Pos.of(&fields));
            self.mesh.normals.push(Nor.of(&fields).as_vec3());
            let material = self.material(&fields);
            self.mesh.materials.push(material);
        }
        if self.positions[first..].iter().any(|place| place.is_nan()) {
            self.positions.truncate(first);
            self.mesh.normals.truncate(first);
            self.mesh.materials.truncate(first);
            return Ok(());
        }
        let first = first as u32;
        self.mesh.triangles.push([first, first + 1, first + 2]);
        Ok(())
    }

    fn light(&mut self) -> Result<(), ImportError> {
        let fields = self.fields("light", LIGHT)?;
        if Pos.of(&fields).is_nan() {
            return Ok(());
        }
        self.scene.lights.push(Light {
            kind: LightKind::Point {
                position: Pos.of(&fields),
            },
            color: Col.of(&fields).as_vec3(),
            ..Light::default()
        });
        self.area.is_of_light = true;
        Ok(())
    }

    /// Gives the light that just ended its extent, if it has one.
    fn close_light(&mut self) {
        let area = std::mem::take(&mut self.area);
        match self.scene.lights.last_mut() {
            Some(light) if area.is_of_light => {
                area.apply(light, self.source, &mut self.faults, &mut self.extensions);
            }
            _ => area.count(&mut self.extensions),
        }
    }

    fn material(&mut self, fields: &Fields) -> u32 {
        let (diffuse, specular) = (Dif.of(fields).as_vec3(), Spe.of(fields).as_vec3());
        self.palette
            .index(diffuse, specular, Shi.of(fields).x as f32)
    }

    /// Reads keys in any order until all of `wanted` are present.
    fn fields(&mut self, object: &str, wanted: &[Key]) -> Result<Fields, ImportError> {
        let mut fields = Fields::default();
        while let Some(missing) = wanted.iter().find(|&&key| fields[key as usize].is_none()) {
            let Some(token) = self.tokens.next() else {
                let why = format!(
                    "the file ends inside a {object}, before `{}`",
                    missing.name()
                );
                return Err(self.refuse(self.tokens.end(), why, "Check that it is complete"));
            };
            if self.is_extension(token)? {
                continue;
            }
            let key = self.key(token, object, wanted, *missing)?;
            if fields[key as usize].is_some() {
                let why = format!("a second `{}` before `{}`", key.name(), missing.name());
                return Err(self.refuse(token, why, &expects(object, wanted)));
            }
            fields[key as usize] = Some(self.values(key)?);
        }
        Ok(fields)
    }

    fn key(
        &self,
        token: Token,
        object: &str,
        wanted: &[Key],
        missing: Key,
    ) -> Result<Key, ImportError> {
        let is_named = |key: &&Key| token.bytes.eq_ignore_ascii_case(key.name().as_bytes());
        if let Some(&key) = wanted.iter().find(is_named) {
            return Ok(key);
        }
        let word = String::from_utf8_lossy(token.bytes).to_lowercase();
        let why = if OBJECTS.contains(&word.as_str()) {
            format!(
                "a new object begins, but the {object} before it has no `{}`",
                missing.name()
            )
        } else {
            suggest::unknown("key", &word, wanted.iter().map(|key| key.name()))
        };
        Err(self.refuse(token, why, &expects(object, wanted)))
    }

    /// The checked values of `key`.
    fn values(&mut self, key: Key) -> Result<[f64; 3], ImportError> {
        let name = key.name();
        match key {
            Pos | Nor => Ok([
                self.number(name)?.1,
                self.number(name)?.1,
                self.number(name)?.1,
            ]),
            Dif | Spe | Col => self.color(name),
            Rad => self.radius(),
            Shi => Ok([self.at_least_zero(name)?, 0.0, 0.0]),
        }
    }

    fn radius(&mut self) -> Result<[f64; 3], ImportError> {
        let (token, mut radius) = self.number("rad:")?;
        if radius < f64::from(f32::MIN_POSITIVE) {
            let what = ("rad:", "spheres without a positive radius skipped");
            self.faults.add(what, self.source, token.span(), || {
                let why = format!("the radius {} is not greater than 0", token.quote());
                (why, "Write a positive number")
            });
            radius = f64::NAN;
        }
        Ok([radius, 0.0, 0.0])
    }

    fn color(&mut self, key: &'static str) -> Result<[f64; 3], ImportError> {
        Ok([
            self.at_least_zero(key)?,
            self.at_least_zero(key)?,
            self.at_least_zero(key)?,
        ])
    }

    fn at_least_zero(&mut self, key: &'static str) -> Result<f64, ImportError> {
        let (token, value) = self.number(key)?;
        let value = self.faults.not_negative(key, self.source, token, value);
        Ok(value.max(0.0))
    }

    /// NaN if it cannot be used.
    fn number(&mut self, key: &'static str) -> Result<(Token<'s>, f64), ImportError> {
        let token = self.expect("a number of ", key)?;
        let number = self.faults.number_or_nan(key, self.source, token)?;
        Ok((token, number))
    }

    /// The next token, expected to be `key` or one of its values.
    fn expect(&mut self, what: &str, key: &str) -> Result<Token<'s>, ImportError> {
        self.tokens.next().ok_or_else(|| {
            let why = format!("the file ends where {what}`{key}` should be");
            self.refuse(self.tokens.end(), why, "Check that it is complete")
        })
    }

    /// Whether `token` is an extension; if so, skips its words.
    fn is_extension(&mut self, token: Token<'s>) -> Result<bool, ImportError> {
        let known = |(name, _): &(&str, usize)| token.bytes.eq_ignore_ascii_case(name.as_bytes());
        let Some(index) = EXTENSIONS.iter().position(known) else {
            return Ok(false);
        };
        let (name, word_count) = EXTENSIONS[index];
        let mut words = Vec::with_capacity(word_count);
        for _ in 0..word_count {
            words.push(self.expect("a value of ", name)?);
        }
        if name == "ref:" {
            self.faults.number_or_nan("ref:", self.source, words[0])?;
            self.extensions[index] += 1;
        } else {
            let faults = &mut self.faults;
            self.area.read(index, token, &words, self.source, faults)?;
        }
        Ok(true)
    }

    fn refuse(&self, token: Token, why: String, todo: &str) -> ImportError {
        self.source.malformed(token.span(), why, todo)
    }

    fn finish(mut self) -> Result<Scene, ImportError> {
        if self.scene.shapes.is_empty()
            && self.mesh.triangles.is_empty()
            && let Some(refusal) = self.faults.refusal()
        {
            return Err(refusal);
        }
        for ((name, _), count) in EXTENSIONS.iter().zip(self.extensions) {
            if count > 0 {
                let times = if count == 1 {
                    "once".to_owned()
                } else {
                    format!("{count} times")
                };
                let why = if *name == "ref:" {
                    "is not supported"
                } else {
                    "has no effect without a light, `area_light: true`, `area_u:` and `area_v:`"
                };
                self.scene
                    .skipped
                    .push(format!("`{name}` {why} (found {times})"));
            }
        }
        let (local, offset) = Mesh::from_world_positions(&self.positions);
        self.mesh.positions = local;
        let mut notes = Notes::default();
        self.faults.note(&mut notes, None);
        notes::of_repairs(&mut notes, self.mesh.repair());
        self.scene.skipped.extend(notes.into_lines());
        if !self.mesh.triangles.is_empty() {
            let world_from_object = DAffine3::from_translation(offset);
            self.scene.meshes.push(self.mesh.into());
            self.scene.instances.push(Instance {
                mesh: 0,
                placement: world_from_object,
                node: None,
                name: String::new(),
            });
        }
        self.scene.materials = self.palette.into_materials();
        Ok(self.scene)
    }
}

fn expects(object: &str, wanted: &[Key]) -> String {
    let names: Vec<_> = wanted
        .iter()
        .map(|key| format!("`{}`", key.name()))
        .collect();
    let part = if object == "triangle" {
        "vertex of a triangle"
    } else {
        object
    };
    format!("A {part} needs {}, each once", names.join(", "))
}
