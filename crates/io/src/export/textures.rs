//! The textures of a scene.

use super::pictures::{Role, codes};
use super::{ExportError, Writer, exact};
use crate::import::native::file::{
    DataMapTable, HeightMapTable, NoiseTable, PairTable, PictureOrFile, PictureTable, SpaceName,
    Spanned, TextureTable,
};
use crate::import::native::values::{Matrix, Number, differing, short};
use glam::{DVec3, Vec3};
use glimray_scene::{Minify, Origin, Pattern, Space, Texels, Texture, Transform, Wrap};

impl Writer<'_> {
    /// The table of a texture; `None` if only a material has it.
    pub fn texture(&mut self, texture: &Texture) -> Result<Option<TextureTable>, ExportError> {
        let pair = |a, b| PairTable {
            a: differing(a, Vec3::ONE),
            b: differing(b, Vec3::ZERO),
        };
        let mut table = place(texture);
        let mut space = Space::World;
        match texture.pattern {
            Pattern::Checker { a, b } => table.checker = Some(pair(a, b)),
            Pattern::Stripes { a, b } => table.stripes = Some(pair(a, b)),
            Pattern::Gradient { a, b } => table.gradient = Some(pair(a, b)),
            Pattern::Noise { a, b, octaves } => {
                let PairTable { a, b } = pair(a, b);
                let octaves = differing(octaves, NoiseTable::OCTAVES);
                table.noise = Some(NoiseTable { a, b, octaves });
            }
            // Materials have them.
            Pattern::Picture { picture, .. } if self.is_relief(picture) => return Ok(None),
            Pattern::Picture { picture, .. } => {
                let role = self.role(picture);
                table.picture = self.sampled(&texture.pattern, role)?;
                space = Space::Uv;
            }
        }
        table.space = differing(texture.space, space);
        Ok(Some(table))
    }

    /// The height map that a normal map was made from, if there is one.
    pub fn height_map(
        &mut self,
        index: Option<usize>,
        scale: f32,
    ) -> Result<Option<HeightMapTable>, ExportError> {
        let Some(texture) = index.map(|index| &self.scene.textures[index]) else {
            return Ok(None);
        };
        let Pattern::Picture { picture, .. } = texture.pattern else {
            return Ok(None);
        };
        let Origin::Heights { are_depths, .. } = self.scene.pictures[picture].origin else {
            return Ok(None);
        };
        if !self.is_relief(picture) {
            return Ok(None);
        }
        let picture = self.sampled(&texture.pattern, Role::Color)?;
        let place = place(texture);
        // Depths of 0 are as flat as heights of 0.
        let strength = if are_depths { -scale } else { scale };
        Ok(picture.map(|picture| HeightMapTable {
            picture,
            strength: differing::<_, Number>(short(strength), 1.0),
            space: (texture.space == Space::SecondUv).then_some(SpaceName::SecondUv),
            scale: place.scale,
            rotate_deg: place.rotate_deg,
            translate: place.translate,
            pattern_from_space: place.pattern_from_space,
        }))
    }

    /// A normal or occlusion map, if there is one.
    pub fn data_map(&self, index: Option<usize>, strength: f32) -> Option<Spanned<DataMapTable>> {
        let table = DataMapTable {
            texture: Some(self.names.texture(index?)),
            strength: differing(strength, 1.0),
            ..DataMapTable::default()
        };
        Some(table.into())
    }

    /// The image file of a pattern, and how it is sampled.
    fn sampled(
        &mut self,
        pattern: &Pattern,
        role: Role,
    ) -> Result<Option<Spanned<PictureOrFile>>, ExportError> {
        let Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap,
        } = *pattern
        else {
            return Ok(None);
        };
        let file = self.picture(picture, role)?;
        let is_linear = role == Role::Data;
        let is_plain = !nearest && minify == Minify::default() && wrap == [Wrap::Repeat; 2];
        let picture = match is_plain && !is_linear {
            true => PictureOrFile::File(file),
            false => PictureOrFile::Table(PictureTable {
                file: file.into(),
                linear: is_linear.then_some(true),
                nearest: nearest.then_some(true),
                minify: differing(minify, Minify::default()),
                wrap: (wrap != [Wrap::Repeat; 2]).then(|| wrap.into()),
            }),
        };
        Ok(Some(picture.into()))
    }

    /// The role of a picture: values that are no colours are linear in 8 bits. Colours of OpenEXR are divided by alpha
    /// when they are read, and numbers are not.
    pub fn role(&self, picture: usize) -> Role {
        match &self.scene.pictures[picture].texels {
            Texels::Linear8(_) => Role::Data,
            Texels::Float(texels) if texels.iter().any(|texel| texel.w != 1.0) => {
                match codes(texels) {
                    None => Role::Data,
                    Some(_) => Role::Color,
                }
            }
            Texels::Srgb8(_) | Texels::Float(_) => Role::Color,
        }
    }
}

/// A table with the transform of the pattern alone.
fn place(texture: &Texture) -> TextureTable {
    let wanted = texture.pattern_from_space;
    // The transform of a file without one.
    if exact::is_same(Transform::default().affine().inverse(), wanted) {
        return TextureTable::default();
    }
    let (near, is_near) = Transform::of(wanted.inverse());
    let candidates = [0, 2, 4, 6, 9, 12].map(|decimals| {
        let round = |v: DVec3| {
            let round = |x: f64| format!("{x:.decimals$}").parse::<f64>().unwrap_or(x) + 0.0;
            DVec3::from(v.to_array().map(round))
        };
        Transform {
            translate: round(near.translate),
            rotate_deg: round(near.rotate_deg),
            scale: round(near.scale),
        }
    });
    let gives_it = |transform: &Transform| {
        let is_flat = transform.scale.abs().min_element() == 0.0;
        is_near && !is_flat && exact::is_same(transform.affine().inverse(), wanted)
    };
    match candidates.into_iter().find(gives_it) {
        Some(transform) => TextureTable {
            scale: differing(transform.scale, DVec3::ONE),
            rotate_deg: differing(transform.rotate_deg, DVec3::ZERO),
            translate: differing(transform.translate, DVec3::ZERO),
            ..TextureTable::default()
        },
        None => TextureTable {
            pattern_from_space: Some(Matrix(wanted)),
            ..TextureTable::default()
        },
    }
}
