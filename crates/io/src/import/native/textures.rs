//! The textures, images and background of a native scene.

use super::Texts;
use super::file::{
    BackgroundTable, ColorOrBackground, ColorOrTexture, DataMapTable, HeightMapTable, NoiseTable,
    NumberTable, PairTable, PictureOrFile, SceneFile, SkyTable, SpaceName, Spanned, TextureTable,
    WrapModes, in_order,
};
use super::values::or;
use crate::import::error::ImportError;
use crate::import::paths::Files;
use crate::import::picture::{self, Pictures, Place, Refused, Role};
use crate::import::source::quote;
use crate::import::{Options, suggest};
use glam::{DVec3, Vec3};
use glimray_scene::{
    Background, BuiltIn, LARGEST_TEXEL, Minify, Pattern, Space, Texture, Transform, Wrap, sky,
};
use std::collections::BTreeMap;
use std::ops::Range;

/// All textures of a scene while it is built.
pub(super) struct Textures<'a> {
    texts: &'a Texts<'a>,
    files: &'a Files<'a>,
    names: BTreeMap<String, usize>,
    pub textures: Vec<Texture>,
    pub pictures: Pictures,
    /// For each picture where it is named first.
    spans: BTreeMap<usize, Range<usize>>,
}

impl<'a> Textures<'a> {
    /// The textures under `[textures]`.
    pub fn new(
        file: &SceneFile,
        texts: &'a Texts<'a>,
        files: &'a Files<'a>,
        options: &Options,
    ) -> Result<Self, ImportError> {
        let mut textures = Self {
            texts,
            files,
            names: BTreeMap::new(),
            textures: Vec::new(),
            pictures: Pictures::new(options),
            spans: BTreeMap::new(),
        };
        for (name, table) in in_order(&file.textures) {
            let index = textures.texture(&table.pattern(), Role::Color, table.span())?;
            textures.names.insert(name.clone(), index);
        }
        Ok(textures)
    }

    /// An error about `span`.
    pub fn refuse(&self, span: Range<usize>, why: &str, todo: &str) -> ImportError {
        self.texts.malformed(span, why.to_owned(), todo)
    }

    /// The constant colour of a material, and the texture that multiplies it.
    pub fn color(
        &mut self,
        color: Option<&Spanned<ColorOrTexture>>,
        default: Vec3,
    ) -> Result<(Vec3, Option<usize>), ImportError> {
        let Some(color) = color else {
            return Ok((default, None));
        };
        let table = match color.get_ref() {
            ColorOrTexture::Color(color) => return Ok((color.0, None)),
            ColorOrTexture::Table(table) => table,
        };
        let index =
            self.named_or_own(&table.texture, &table.pattern(), Role::Color, color.span())?;
        let factor = or(table.color, Vec3::ONE);
        if !(factor * largest(&self.textures[index].pattern)).is_finite() {
            let why =
                "`color` times the texture is out of range: at most 3.4e38 is allowed".to_owned();
            return Err(self.texts.malformed(color.span(), why, "Lower one of them"));
        }
        Ok((factor, Some(index)))
    }

    /// The texture with this name if there is one, otherwise one with this pattern.
    fn named_or_own(
        &mut self,
        name: &Option<Spanned<String>>,
        pattern: &TextureTable,
        role: Role,
        span: Range<usize>,
    ) -> Result<usize, ImportError> {
        match name {
            Some(name) if count(pattern) == 0 && !has_placement(pattern) => self.named(name),
            Some(name) => {
                let todo = "Put them under [textures], or leave out `texture`";
                let why = "a named texture has its own pattern and transform";
                Err(self.refuse(name.span(), why, todo))
            }
            None => self.texture(pattern, role, span),
        }
    }

    /// The texture of a number.
    pub fn number(
        &mut self,
        table: &NumberTable,
        span: Range<usize>,
    ) -> Result<usize, ImportError> {
        self.named_or_own(&table.texture, &table.pattern(), Role::Data, span)
    }

    /// Whether a texture has an alpha.
    pub fn has_alpha(&self, index: usize) -> bool {
        matches!(self.textures[index].pattern, Pattern::Picture { .. })
    }

    /// The largest value of each channel of a texture; 1 for a picture.
    pub fn largest(&self, index: usize) -> Vec3 {
        match self.has_alpha(index) {
            true => Vec3::ONE,
            false => largest(&self.textures[index].pattern),
        }
    }

    /// The texture of a map of numbers.
    pub fn data_map(&mut self, map: &Spanned<DataMapTable>) -> Result<usize, ImportError> {
        let table = map.get_ref();
        self.check_flat(table.space, map.span())?;
        let index = self.named_or_own(&table.texture, &table.pattern(), Role::Data, map.span())?;
        match self.has_alpha(index) {
            true => Ok(index),
            false => {
                let why = "a map of numbers is a picture";
                Err(self.refuse(map.span(), why, "Name a texture with a picture"))
            }
        }
    }

    /// The normal map that a height map becomes.
    pub fn height_map(&mut self, map: &Spanned<HeightMapTable>) -> Result<usize, ImportError> {
        self.check_flat(map.space, map.span())?;
        let role = match map.height() < 0.0 {
            true => Role::Depth,
            false => Role::Height,
        };
        self.texture(&map.pattern(), role, map.span())
    }

    fn check_flat(&self, space: Option<SpaceName>, span: Range<usize>) -> Result<(), ImportError> {
        match space {
            Some(SpaceName::World) => {
                let why = "a map of numbers has its place by u and v";
                Err(self.refuse(span, why, "Leave out `space`"))
            }
            _ => Ok(()),
        }
    }

    /// The background.
    pub fn background(
        &mut self,
        background: Option<&Spanned<ColorOrBackground>>,
    ) -> Result<Background, ImportError> {
        let Some(background) = background else {
            return Ok(Background::Color(Vec3::ZERO));
        };
        let refuse = |why: &str, todo: &str| {
            Err(self
                .texts
                .malformed(background.span(), why.to_owned(), todo))
        };
        let named;
        let table: &BackgroundTable = match background.get_ref() {
            ColorOrBackground::Color(color) => return Ok(Background::Color(color.0)),
            ColorOrBackground::Table(table) => table,
            ColorOrBackground::Name(name) => {
                named = BackgroundTable {
                    environment: Some(*name),
                    ..BackgroundTable::default()
                };
                &named
            }
        };
        let only_for_pictures =
            table.strength.is_some() || table.rotation_deg.is_some() || table.rotation.is_some();
        let has_source = [
            table.picture.is_some(),
            table.environment.is_some(),
            table.sky.is_some(),
        ];
        let source_count = has_source.into_iter().filter(|has| *has).count();
        match (table.bottom, table.top, source_count) {
            (Some(bottom), Some(top), 0) if !only_for_pictures => Ok(Background::Gradient {
                bottom: bottom.0,
                top: top.0,
            }),
            (None, None, 1) => {
                let strength = or(table.strength, 1.0);
                if !(strength * LARGEST_TEXEL).is_finite() {
                    return refuse(
                        "`strength` is out of range: at most 5e33 is allowed",
                        "Lower it",
                    );
                }
                if let (Some(_), Some(_)) = (table.rotation_deg, table.rotation) {
                    let why = "there are both `rotation_deg` and `rotation`";
                    return refuse(why, "Leave out one of them");
                }
                let degrees = or(table.rotation_deg, 0.0);
                let degrees = (degrees % 360.0).to_radians();
                let picture = match (&table.picture, table.environment) {
                    (Some(name), _) => {
                        self.picture(name.get_ref(), name.span(), Role::Environment)?
                    }
                    (None, Some(name)) => self.pictures.add(BuiltIn::from(name).picture()),
                    (None, None) => self.sky(table.sky.as_ref())?,
                };
                Ok(Background::Picture {
                    picture,
                    strength,
                    rotation: or(table.rotation, degrees),
                })
            }
            _ => refuse(
                "a background needs a colour, a gradient, a picture or a sky",
                "Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`",
            ),
        }
    }

    /// The picture of a sky.
    fn sky(&mut self, table: Option<&Spanned<SkyTable>>) -> Result<usize, ImportError> {
        let default = SkyTable::default();
        let sky = table.map_or(&default, Spanned::get_ref);
        let elevation = or(sky.elevation_deg, sky::SUN_ELEVATION_DEG);
        match table {
            Some(table) if !(0.0..=90.0).contains(&elevation) => {
                let why = "the sun stands at most 90 degrees above the horizon, and not below it";
                Err(self.refuse(table.span(), why, "Give it an `elevation_deg` from 0 to 90"))
            }
            _ => {
                let azimuth = or(sky.azimuth_deg, sky::SUN_AZIMUTH_DEG).to_radians();
                Ok(self
                    .pictures
                    .add(sky::picture(elevation.to_radians(), azimuth)))
            }
        }
    }

    fn named(&self, name: &Spanned<String>) -> Result<usize, ImportError> {
        self.names.get(name.get_ref()).copied().ok_or_else(|| {
            let known = self.names.keys().map(String::as_str);
            let why = suggest::unknown("texture", name.get_ref(), known);
            let todo = "Add it under [textures], or use an existing one";
            self.texts.malformed(name.span(), why, todo)
        })
    }

    fn texture(
        &mut self,
        tables: &TextureTable,
        role: Role,
        span: Range<usize>,
    ) -> Result<usize, ImportError> {
        let pair = |a, b| (or(a, Vec3::ONE), or(b, Vec3::ZERO));
        let colors = |table: PairTable| pair(table.a, table.b);
        let pattern = if count(tables) > 1 {
            None
        } else if let Some((a, b)) = tables.checker.map(colors) {
            Some(Pattern::Checker { a, b })
        } else if let Some((a, b)) = tables.stripes.map(colors) {
            Some(Pattern::Stripes { a, b })
        } else if let Some((a, b)) = tables.gradient.map(colors) {
            Some(Pattern::Gradient { a, b })
        } else if let Some(noise) = tables.noise {
            let (a, b) = pair(noise.a, noise.b);
            let octaves = or(noise.octaves, NoiseTable::OCTAVES);
            Some(Pattern::Noise { a, b, octaves })
        } else if let Some(picture) = &tables.picture {
            Some(self.sampled(picture, role)?)
        } else {
            None
        };
        let Some(pattern) = pattern else {
            let todo = "Give it one of `checker`, `stripes`, `gradient`, `noise` and `picture`";
            let why = "a texture needs exactly one pattern".to_owned();
            return Err(self.texts.malformed(span, why, todo));
        };
        let space = or(
            tables.space,
            tables.picture.as_ref().map_or(Space::World, |_| Space::Uv),
        );
        let space_from_pattern = Transform {
            scale: or(tables.scale, DVec3::ONE),
            rotate_deg: or(tables.rotate_deg, DVec3::ZERO),
            translate: or(tables.translate, DVec3::ZERO),
        }
        .affine();
        let pattern_from_space = match tables.pattern_from_space {
            Some(_) if is_placed(tables) => {
                let why = "`pattern_from_space` replaces `scale`, `rotate_deg` and `translate`";
                return Err(self.refuse(span, why, "Leave out the others"));
            }
            Some(matrix) => matrix.0,
            None => space_from_pattern.inverse(),
        };
        self.textures.push(Texture {
            pattern,
            space,
            pattern_from_space,
        });
        Ok(self.textures.len() - 1)
    }

    /// A picture and how it is sampled; `role` is what its texels are unless it says so.
    fn sampled(
        &mut self,
        picture: &Spanned<PictureOrFile>,
        role: Role,
    ) -> Result<Pattern, ImportError> {
        let table = match picture.get_ref() {
            PictureOrFile::File(name) => {
                return Ok(Pattern::Picture {
                    picture: self.picture(name, picture.span(), role)?,
                    nearest: false,
                    minify: Minify::default(),
                    wrap: [Wrap::Repeat; 2],
                });
            }
            PictureOrFile::Table(table) => table,
        };
        let role = match (table.linear == Some(true), role) {
            (true, Role::Color) => Role::Data,
            _ => role,
        };
        let file = &table.file;
        Ok(Pattern::Picture {
            picture: self.picture(file.get_ref(), file.span(), role)?,
            nearest: table.nearest.unwrap_or_default(),
            minify: or(table.minify, Minify::default()),
            wrap: table.wrap.map_or([Wrap::Repeat; 2], WrapModes::modes),
        })
    }

    fn picture(
        &mut self,
        name: &str,
        span: Range<usize>,
        role: Role,
    ) -> Result<usize, ImportError> {
        match self.files.resolve(name) {
            Ok(path) => {
                let place = Place::File(path);
                let index = (self.pictures).reserve(place, &quote(name.as_bytes()), role);
                self.spans.entry(index).or_insert(span);
                Ok(index)
            }
            Err(refusal) => Err(self.refused(Refused::File(refusal), span)),
        }
    }

    /// Reads the pictures.
    pub fn complete(&mut self) -> Result<(), ImportError> {
        let read = self.pictures.complete(&picture::reader(self.files));
        read.map_err(|(index, refused)| {
            let span = self.spans.get(&index).cloned().unwrap_or_default();
            self.refused(refused, span)
        })
    }

    fn refused(&self, refused: Refused, span: Range<usize>) -> ImportError {
        refused.into_error(|why, todo| self.texts.malformed(span, why, todo))
    }
}

/// Number of patterns.
fn count(table: &TextureTable) -> usize {
    let given = [
        table.checker.is_some(),
        table.stripes.is_some(),
        table.gradient.is_some(),
        table.noise.is_some(),
        table.picture.is_some(),
    ];
    given.into_iter().filter(|&given| given).count()
}

/// Whether it has a scale, angles or a translation.
fn is_placed(table: &TextureTable) -> bool {
    table.rotate_deg.or(table.translate).is_some() || table.scale.is_some()
}

/// Whether it has a transform or coordinates for the pattern.
fn has_placement(table: &TextureTable) -> bool {
    is_placed(table) || table.space.is_some() || table.pattern_from_space.is_some()
}

/// The largest value of each channel of a pattern.
fn largest(pattern: &Pattern) -> Vec3 {
    match *pattern {
        Pattern::Checker { a, b }
        | Pattern::Stripes { a, b }
        | Pattern::Gradient { a, b }
        | Pattern::Noise { a, b, .. } => a.max(b),
        Pattern::Picture { .. } => Vec3::splat(LARGEST_TEXEL),
    }
}
