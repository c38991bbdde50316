//! The textures of a scene.

use super::pictures::{Role, codes};
use super::text::{self, Table, color, key, string};
use super::{ExportError, Writer, exact};
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{Minify, Origin, Pattern, Space, Texels, Texture, Transform, Wrap};

impl Writer<'_> {
    pub fn textures(&mut self) -> Result<(), ExportError> {
        if !self.scene.textures.is_empty() {
            self.text.section("Textures");
        }
        for (index, texture) in self.scene.textures.iter().enumerate() {
            let mut table = Table::default();
            let pair = |a: Vec3, b: Vec3, octaves: Option<u32>| {
                let mut table = Table::default();
                table.put_if(a != Vec3::ONE, "a", color(a));
                table.put_if(b.to_array().map(f32::to_bits) != [0; 3], "b", color(b));
                let octaves = octaves.filter(|octaves| *octaves != 4);
                if let Some(octaves) = octaves {
                    table.put("octaves", octaves.to_string());
                }
                table.inline()
            };
            match texture.pattern {
                Pattern::Checker { a, b } => table.put("checker", pair(a, b, None)),
                Pattern::Stripes { a, b } => table.put("stripes", pair(a, b, None)),
                Pattern::Gradient { a, b } => table.put("gradient", pair(a, b, None)),
                Pattern::Noise { a, b, octaves } => {
                    table.put("noise", pair(a, b, Some(octaves)));
                }
                // Materials have them.
                Pattern::Picture { picture, .. } if self.is_relief(picture) => continue,
                Pattern::Picture {
                    picture,
                    nearest,
                    minify,
                    wrap,
                } => {
                    let role = self.role(picture);
                    let file = self.picture(picture, role)?;
                    table.put("picture", sampled(file, role, nearest, minify, wrap));
                }
            }
            let is_picture = matches!(texture.pattern, Pattern::Picture { .. });
            match (texture.space, is_picture) {
                (Space::Uv, false) => table.put("space", string("uv")),
                (Space::SecondUv, _) => table.put("space", string("second-uv")),
                (Space::World, true) => table.put("space", string("world")),
                _ => {}
            }
            place(&mut table, texture);
            self.text.gap();
            let name = key(&self.names.textures[index]);
            self.text.head(&format!("[textures.{name}]"));
            self.text.lines(&table);
        }
        Ok(())
    }

    /// The height map that a normal map was made from, if there is one.
    pub fn height_map(
        &mut self,
        index: Option<usize>,
        scale: f32,
    ) -> Result<Option<String>, ExportError> {
        let Some(texture) = index.map(|index| &self.scene.textures[index]) else {
            return Ok(None);
        };
        let Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap,
        } = texture.pattern
        else {
            return Ok(None);
        };
        let Origin::Heights { are_depths, .. } = self.scene.pictures[picture].origin else {
            return Ok(None);
        };
        if !self.is_relief(picture) {
            return Ok(None);
        }
        let file = self.picture(picture, Role::Color)?;
        let mut table = Table::default();
        table.put("picture", sampled(file, Role::Color, nearest, minify, wrap));
        // Depths of 0 are as flat as heights of 0.
        let strength = if are_depths { -scale } else { scale };
        table.put_if(strength != 1.0, "strength", text::number32(strength));
        table.put_if(
            texture.space == Space::SecondUv,
            "space",
            string("second-uv"),
        );
        place(&mut table, texture);
        Ok(Some(table.inline()))
    }

    /// A normal or occlusion map, if there is one.
    pub fn data_map(&self, index: Option<usize>, strength: f32) -> Option<String> {
        let mut table = Table::default();
        table.put("texture", string(&self.names.textures[index?]));
        table.put_if(strength != 1.0, "strength", text::number32(strength));
        Some(table.inline())
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

/// An image file, and how it is sampled.
fn sampled(file: String, role: Role, nearest: bool, minify: Minify, wrap: [Wrap; 2]) -> String {
    let is_linear = role == Role::Data;
    if !is_linear && !nearest && minify == Minify::default() && wrap == [Wrap::Repeat; 2] {
        return file;
    }
    let mut table = Table::default();
    table.put("file", file);
    table.put_if(is_linear, "linear", "true");
    table.put_if(nearest, "nearest", "true".to_owned());
    table.put_if(minify != Minify::default(), "minify", string(minify.name()));
    table.put_if(wrap != [Wrap::Repeat; 2], "wrap", wrap_modes(wrap));
    table.inline()
}

/// The name of a mode for both axes, or the names of two.
fn wrap_modes([u, v]: [Wrap; 2]) -> String {
    match u == v {
        true => string(u.name()),
        false => format!("[{}, {}]", string(u.name()), string(v.name())),
    }
}

/// The transform of the pattern.
fn place(table: &mut Table, texture: &Texture) {
    let wanted = texture.pattern_from_space;
    // The transform of a file without one.
    if exact::is_same(Transform::default().affine().inverse(), wanted) {
        return;
    }
    let near = wanted.inverse();
    let candidates = [0, 2, 4, 6, 9, 12].map(|decimals| {
        let (transform, is_near) = Transform::of(near);
        let round = |v: DVec3| {
            let round = |x: f64| format!("{x:.decimals$}").parse::<f64>().unwrap_or(x) + 0.0;
            DVec3::from(v.to_array().map(round))
        };
        let transform = Transform {
            translate: round(transform.translate),
            rotate_deg: round(transform.rotate_deg),
            scale: round(transform.scale),
        };
        is_near.then_some(transform)
    });
    let gives_it = |transform: &Transform| {
        let is_flat = transform.scale.abs().min_element() == 0.0;
        !is_flat && exact::is_same(transform.affine().inverse(), wanted)
    };
    match candidates.into_iter().flatten().find(gives_it) {
        Some(transform) => {
            table.put_if(
                transform.scale != DVec3::ONE,
                "scale",
                text::scale(transform.scale),
            );
            let turned = transform.rotate_deg != DVec3::ZERO;
            table.put_if(turned, "rotate_deg", text::vector(transform.rotate_deg));
            let moved = transform.translate != DVec3::ZERO;
            table.put_if(moved, "translate", text::vector(transform.translate));
        }
        None if exact::is_same(wanted, DAffine3::IDENTITY) => {
            table.put("pattern_from_space", text::matrix(DAffine3::IDENTITY));
        }
        None => table.put("pattern_from_space", text::matrix(wanted)),
    }
}
