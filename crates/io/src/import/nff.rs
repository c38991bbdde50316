//! Haines' Neutral File Format (`.nff`), version 3.9 of 1996, the format of the Standard Procedural
//! Database (SPD).
//!
//! ```text
//! v  from X Y Z  at X Y Z  up X Y Z  angle DEGREES  hither DISTANCE  resolution X Y
//! b  R G B                                   background, black without
//! l  X Y Z [R G B]                           light
//! f  R G B Kd Ks Shine T index               material of what follows
//! s  X Y Z radius                            sphere
//! c  X Y Z radius  X Y Z radius              cone or cylinder, from base to apex, open
//! p  N  (X Y Z)*N                            polygon, counter-clockwise
//! pp N  (X Y Z  X Y Z)*N                     the same with a normal at each corner
//! #  comment up to the end of the line
//! ```
//!
//! Where the format leaves room, this importer follows SPD's own writers for other ray tracers: Phong's
//! highlight and the reflection are white with weight Ks, and only the diffuse part is coloured; a light
//! without a colour has 1/√(number of lights); there is no ambient light; the ray depth is five. `angle`
//! is the full vertical field of view. Output values are stored without gamma, as was usual at the time.
//! The near plane (`hither`) is ignored. Surfaces are two-sided; negative radii, for surfaces visible
//! from inside only, are reported.

pub(super) use words::KEYS;

mod mesh;
mod view;
mod words;

use super::budget::{self, Budget};
use super::error::ImportError;
use super::faults::{CLAMPED, Faults};
use super::notes::Notes;
use super::source::{Source, Token};
use super::{number, suggest};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use glimray_scene::{
    Background, CanonicalShape, Fresnel, Geometry, Light, LightKind, Material, Mixing,
    OutputDefaults, Phong, Scene, Shape, Transfer,
};
use mesh::Surface;
use std::collections::HashMap;
use words::Words;

/// Entities: keyword, name in errors, and syntax.
const ENTITIES: [(&str, &str, &str); 8] = [
    (
        "v",
        "view",
        "A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`",
    ),
    ("b", "background", "A background is `b R G B`"),
    ("l", "light", "A light is `l X Y Z` or `l X Y Z R G B`"),
    (
        "f",
        "material",
        "A material is `f R G B Kd Ks SHINE T INDEX`",
    ),
    (
        "c",
        "cone",
        "A cone is `c X Y Z RADIUS` and the same of its other end",
    ),
    ("s", "sphere", "A sphere is `s X Y Z RADIUS`"),
    (
        "p",
        "polygon",
        "A polygon is `p N` and N corners of 3 numbers",
    ),
    (
        "pp",
        "patch",
        "A patch is `pp N` and N corners of 6 numbers",
    ),
];

/// Other names for entities.
const SYNONYMS: [(&str, &str); 8] = [
    ("viewpoint", "v"),
    ("camera", "v"),
    ("color", "f"),
    ("fill", "f"),
    ("cylinder", "c"),
    ("ball", "s"),
    ("triangle", "p"),
    ("polypatch", "pp"),
];

/// The smallest length distinguishable from 0 on the GPU.
const SHORTEST: f64 = f32::MIN_POSITIVE as f64;

/// The scene in `source`, with its output settings.
pub(super) fn read(source: &Source) -> Result<Scene, ImportError> {
    let mut reader = Reader {
        source,
        words: Words::new(&source.bytes),
        entity: 0,
        scene: Scene {
            output: OutputDefaults {
                transfer: Transfer::Linear,
                ..OutputDefaults::default()
            },
            ..Scene::default()
        },
        plain_lights: Vec::new(),
        backgrounds: 0,
        material: None,
        material_ids: HashMap::new(),
        surface: Surface::new(),
        inside_out: 0,
        faults: Faults::default(),
    };
    let budget = Budget::of(source.bytes.len());
    while let Some(word) = reader.words.next() {
        reader.read_entity(word)?;
        let refuse = |why, todo: &str| source.malformed(word.span(), why, todo);
        budget.check(reader.memory(), refuse)?;
    }
    reader.finish()
}

struct Reader<'s> {
    source: &'s Source,
    words: Words<'s>,
    /// Index into [`ENTITIES`] of the current entity.
    entity: usize,
    scene: Scene,
    /// Indices of lights without a colour.
    plain_lights: Vec<usize>,
    backgrounds: usize,
    /// Index into the scene's materials of the current material.
    material: Option<usize>,
    /// Indices by the bits of the numbers in the file.
    material_ids: HashMap<[u64; 8], usize>,
    /// Polygons and patches.
    surface: Surface,
    /// Shapes with negative radii.
    inside_out: usize,
    faults: Faults,
}

impl<'s> Reader<'s> {
    fn read_entity(&mut self, word: Token<'s>) -> Result<(), ImportError> {
        let is_named = |(name, ..): &(&str, &str, &str)| name.as_bytes() == word.bytes;
        let Some(entity) = ENTITIES.iter().position(is_named) else {
            return Err(self.unknown(word));
        };
        self.entity = entity;
        match word.bytes {
            b"v" => self.view(word),
            b"b" => self.background(),
            b"l" => self.light(),
            b"f" => self.fill(word),
            b"c" => self.cone(word),
            b"s" => self.sphere(word),
            patch_or_polygon => self.polygon(word, patch_or_polygon == b"pp"),
        }
    }

    /// The memory that the file takes so far, including later steps.
    fn memory(&self) -> u64 {
        // An index and its key are stored in a hash table with spare capacity.
        self.source.bytes.len() as u64
            + budget::size::<Shape>(self.scene.shapes.len())
            + budget::size::<(Light, usize)>(self.scene.lights.len())
            + budget::size::<(Material, [[u64; 9]; 2])>(self.scene.materials.len())
            + self.surface.memory()
    }

    fn unknown(&self, word: Token) -> ImportError {
        const TODO: &str = "Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`";
        let quoted = word.quote();
        if looks_like_number(word) {
            let why = format!("expected an entity, found {quoted}");
            return self.refuse(word, why, "Count the numbers before it");
        }
        let text = String::from_utf8_lossy(word.bytes).to_lowercase();
        if view::KEYS.contains(&text.as_str()) {
            let why = format!("{quoted} is outside a view");
            return self.refuse(word, why, ENTITIES[0].2);
        }
        let letters = ENTITIES.map(|(letter, name, _)| (name, letter));
        let names = letters.iter().chain(&SYNONYMS);
        let closest = suggest::closest(&text, names.clone().map(|(name, _)| *name));
        let by_name = names.clone().find(|(name, _)| closest == Some(name));
        let by_letter = letters.iter().find(|(_, letter)| *letter == text);
        let why = match by_letter.or(by_name) {
            Some((_, letter)) => format!("unknown entity {quoted}, did you mean `{letter}`?"),
            None => format!("unknown entity {quoted}"),
        };
        self.refuse(word, why, TODO)
    }

    fn background(&mut self) -> Result<(), ImportError> {
        let color = self.color()?;
        if color.is_nan() {
            return Ok(());
        }
        self.scene.background = Background::Color(color);
        self.backgrounds += 1;
        Ok(())
    }

    fn light(&mut self) -> Result<(), ImportError> {
        let position = self.vector()?;
        let color = if self.words.peek().is_some_and(looks_like_number) {
            self.color()?
        } else {
            self.plain_lights.push(self.scene.lights.len());
            Vec3::ZERO
        };
        if position.is_nan() || color.is_nan() {
            self.plain_lights
                .pop_if(|light| *light == self.scene.lights.len());
            return Ok(());
        }
        self.scene.lights.push(Light {
            kind: LightKind::Point { position },
            color,
            ..Light::default()
        });
        Ok(())
    }

    fn fill(&mut self, keyword: Token) -> Result<(), ImportError> {
        let mut values = [0.0; 8];
        for value in &mut values {
            // NaN becomes 0.
            *value = self.at_least_zero()?.max(0.0);
        }
        let [r, g, b, kd, ks, shine, t, index] = values;
        if t > 0.0 && index < SHORTEST {
            let what = ("f", "indices of refraction of 0 set to 1");
            self.faults.add(what, self.source, keyword.span(), || {
                let why = "a transparent material needs an index of refraction".to_owned();
                (why, "Write 1 or more as the last number")
            });
        }
        let mut diffuse = DVec3::new(r, g, b) * kd;
        if !number::in_range(diffuse.max_element()) {
            self.faults
                .add(("f", CLAMPED), self.source, keyword.span(), || {
                    let why = "the colour times Kd is out of range".to_owned();
                    (why, "Write colours from 0 to 1")
                });
            diffuse = diffuse.min(DVec3::splat(f32::MAX.into()));
        }
        // Adding 0 turns -0 into 0.
        let key = values.map(|value| (value + 0.0).to_bits());
        let id = *self.material_ids.entry(key).or_insert_with(|| {
            self.scene.materials.push(Material {
                two_sided: true,
                bsdf: Phong {
                    diffuse: diffuse.as_vec3(),
                    specular: Vec3::splat(ks as f32),
                    shininess: shine as f32,
                    ambient: Vec3::ZERO,
                    reflect: Vec3::splat(ks as f32),
                    transmit: Vec3::splat(t as f32),
                    ior: if index < SHORTEST { 1.0 } else { index as f32 },
                    fresnel: Fresnel::None,
                    mixing: Mixing::Sum,
                    ..Phong::default()
                }
                .into(),
                ..Material::default()
            });
            self.scene.materials.len() - 1
        });
        self.material = Some(id);
        Ok(())
    }

    fn sphere(&mut self, keyword: Token) -> Result<(), ImportError> {
        let material = self.material_in_use(keyword)?;
        let center = self.vector()?;
        let (token, radius) = self.number()?;
        if radius.abs() < SHORTEST {
            self.fault("s", token, format!("the radius {} is zero", token.quote()));
            return Ok(());
        }
        if center.is_nan() || radius.is_nan() {
            return Ok(());
        }
        self.inside_out += usize::from(radius < 0.0);
        let radius = radius.abs();
        let geometry = Geometry::Sphere { center, radius };
        self.scene.shapes.push(Shape {
            geometry,
            material,
            node: None,
            name: String::new(),
        });
        Ok(())
    }

    fn cone(&mut self, keyword: Token) -> Result<(), ImportError> {
        let material = self.material_in_use(keyword)?;
        let (base, (_, bottom)) = (self.vector()?, self.number()?);
        let (apex, (token, top)) = (self.vector()?, self.number()?);
        let axis = apex - base;
        if axis.is_nan() || bottom.is_nan() || top.is_nan() {
            return Ok(());
        }
        let fault = if bottom.abs().max(top.abs()) < SHORTEST {
            Some((token, "both radii of a cone are zero"))
        } else if bottom * top < 0.0 {
            Some((token, "only one radius of a cone is negative"))
        } else if axis.length() < SHORTEST {
            Some((keyword, "both ends of a cone are the same point"))
        } else {
            None
        };
        if let Some((token, why)) = fault {
            self.fault("c", token, why.to_owned());
            return Ok(());
        }
        self.inside_out += usize::from(bottom + top < 0.0);
        // The height is scaled but not the radii: circles stay round.
        let up = axis.normalize();
        let right = up.any_orthonormal_vector();
        let wide = bottom.abs().max(top.abs());
        let turn = DMat3::from_cols(wide * right, axis, wide * right.cross(up));
        let geometry = Geometry::Placed {
            canonical: CanonicalShape::Cone {
                bottom: bottom.abs() / wide,
                top: top.abs() / wide,
                capped: false,
            },
            world_from_canonical: DAffine3::from_mat3_translation(turn, base),
        };
        self.scene.shapes.push(Shape {
            geometry,
            material,
            node: None,
            name: String::new(),
        });
        Ok(())
    }

    fn material_in_use(&self, keyword: Token) -> Result<usize, ImportError> {
        self.material.ok_or_else(|| {
            let why = format!("no material (`f`) comes before this {}", self.name());
            self.refuse(keyword, why, "Begin objects with `f`")
        })
    }

    /// Name of the current entity.
    fn name(&self) -> &'static str {
        ENTITIES[self.entity].1
    }

    fn vector(&mut self) -> Result<DVec3, ImportError> {
        Ok(DVec3::new(
            self.number()?.1,
            self.number()?.1,
            self.number()?.1,
        ))
    }

    fn color(&mut self) -> Result<Vec3, ImportError> {
        let [r, g, b] = [
            self.at_least_zero()?,
            self.at_least_zero()?,
            self.at_least_zero()?,
        ];
        Ok(DVec3::new(r, g, b).as_vec3())
    }

    /// NaN stays.
    fn at_least_zero(&mut self) -> Result<f64, ImportError> {
        let (token, value) = self.number()?;
        let key = ENTITIES[self.entity].0;
        Ok(self.faults.not_negative(key, self.source, token, value))
    }

    /// Counts a shape that is skipped.
    fn fault(&mut self, key: &'static str, token: Token, why: String) {
        let what = (key, "shapes without extent skipped");
        let todo = ENTITIES[self.entity].2;
        (self.faults).add(what, self.source, token.span(), || (why, todo));
    }

    fn number(&mut self) -> Result<(Token<'s>, f64), ImportError> {
        self.number_of("")
    }

    /// The next word, which must be a number; `progress` tells how much of the entity has been read.
    fn number_of(&mut self, progress: &str) -> Result<(Token<'s>, f64), ImportError> {
        let (name, todo) = (self.name(), ENTITIES[self.entity].2);
        let Some(token) = self.words.next() else {
            let why = format!("the file ends inside a {name}{progress}");
            return Err(self.refuse(self.words.end(), why, todo));
        };
        let is_entity = |(letter, ..): &(&str, &str, &str)| letter.as_bytes() == token.bytes;
        if ENTITIES.iter().any(is_entity) || view::is_key(token) {
            let why = format!(
                "{} starts a new entity inside a {name}{progress}",
                token.quote()
            );
            return Err(self.refuse(token, why, todo));
        }
        let key = ENTITIES[self.entity].0;
        let number = self.faults.number_or_nan(key, self.source, token)?;
        Ok((token, number))
    }

    fn refuse(&self, token: Token, why: String, todo: &str) -> ImportError {
        self.source.malformed(token.span(), why, todo)
    }

    fn finish(mut self) -> Result<Scene, ImportError> {
        if self.scene.cameras.is_empty() {
            let why = "the file has no view (`v`)".to_owned();
            return Err(self.refuse(self.words.end(), why, ENTITIES[0].2));
        }
        if self.scene.shapes.is_empty()
            && self.surface.is_empty()
            && let Some(refusal) = self.faults.refusal()
        {
            return Err(refusal);
        }
        let strength = 1.0 / (self.scene.lights.len() as f32).sqrt();
        for light in self.plain_lights {
            self.scene.lights[light].color = Vec3::splat(strength);
        }
        let skipped = &mut self.scene.skipped;
        if self.backgrounds > 1 {
            let note = format!("{} backgrounds: the last one is used", self.backgrounds);
            skipped.push(note);
        }
        if self.inside_out > 0 {
            let note = format!(
                "shapes visible from inside only (negative radii), rendered two-sided: {}",
                self.inside_out
            );
            skipped.push(note);
        }
        if self.scene.materials.is_empty() {
            self.scene.materials.push(Material::default());
        }
        self.surface.add_to(&mut self.scene);
        let mut notes = Notes::default();
        self.faults.note(&mut notes, None);
        self.scene.skipped.extend(notes.into_lines());
        Ok(self.scene)
    }
}

/// Whether `token` looks like a number.
fn looks_like_number(token: Token) -> bool {
    matches!(token.bytes.first(), Some(b'0'..=b'9' | b'+' | b'-' | b'.'))
}
