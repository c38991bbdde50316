//! From the maps of a material to the textures that multiply its classical colours.

use super::Reader;
use super::bake::{self, Baked, Shade, Sheets};
use super::document::{Material as Source, TextureInfo};
use crate::import::error::ImportError;
use crate::import::picture::Role;
use crate::scene::{Coverage, Material, MetallicRoughness, Minify, Pattern, Space, Texture, Wrap};
use glam::{DAffine2, DAffine3, DMat2, DMat3, DVec2, DVec3, Vec3};

const NEAREST: u32 = 9728;
const LINEAR: u32 = 9729;
const NEAREST_MIPMAP_NEAREST: u32 = 9984;
const LINEAR_MIPMAP_NEAREST: u32 = 9985;
const NEAREST_MIPMAP_LINEAR: u32 = 9986;
const CLAMP: u32 = 33071;
const MIRROR: u32 = 33648;

/// Largest width and height of pictures that are computed from several maps.
const MAX_BAKED: u32 = 2048;

/// A use of an image.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FoundMap {
    pub image: usize,
    pub uv_set: u32,
    /// Both with v downwards.
    pub picture_from_uv: DAffine3,
    /// Whether texels that look large are not interpolated.
    nearest: bool,
    minify: Minify,
    /// Along u and v.
    wrap: [Wrap; 2],
}

impl FoundMap {
    /// Whether a texel of one map belongs to the same point as that of the other.
    fn is_aligned(&self, other: &Self) -> bool {
        (self.uv_set, self.wrap) == (other.uv_set, other.wrap)
            && self.picture_from_uv == other.picture_from_uv
    }
}

/// The classical colours of a textured material: factors and indices of pictures.
#[derive(Clone, Debug)]
pub(super) struct Appearance {
    diffuse: (Vec3, Option<usize>),
    specular: (Vec3, Option<usize>),
    reflect: (Vec3, Option<usize>),
    transmit: (Vec3, Option<usize>),
    roughness: f32,
}

/// The transform that `KHR_texture_transform` describes.
fn transform(info: &TextureInfo) -> DAffine3 {
    let Some(it) = &info.extensions.transform else {
        return DAffine3::IDENTITY;
    };
    let number = |x: f64| x.clamp(-1e9, 1e9);
    let (sin, cos) = it.rotation.sin_cos();
    // Counter-clockwise on the picture, whose v points down.
    let rotation = DMat2::from_cols(DVec2::new(cos, -sin), DVec2::new(sin, cos));
    let scale = DVec2::from(it.scale.unwrap_or([1.0; 2]).map(number));
    let flat = DAffine2 {
        matrix2: rotation * DMat2::from_diagonal(scale),
        translation: DVec2::from(it.offset.map(number)),
    };
    DAffine3 {
        matrix3: DMat3::from_cols(
            flat.matrix2.x_axis.extend(0.0),
            flat.matrix2.y_axis.extend(0.0),
            DVec3::Z,
        ),
        translation: flat.translation.extend(0.0),
    }
}

impl Reader<'_> {
    /// The image that `info`, which is at `place`, uses; `None` with a note if there is none.
    pub(super) fn map(
        &mut self,
        info: &TextureInfo,
        place: &str,
    ) -> Result<Option<FoundMap>, ImportError> {
        let document = self.document;
        let texture = self
            .blame
            .get(&document.textures, info.index, "textures", place)?;
        let here = format!("textures[{}]", info.index);
        let Some(image) = texture.image() else {
            let what = match texture.extensions.basisu {
                Some(_) => "has only a KTX2 picture, which this program cannot read",
                None => "has no picture",
            };
            let note = || format!("texture skipped: {here} {what}");
            self.notes.add("skipped textures", note);
            return Ok(None);
        };
        self.blame.get(&document.images, image, "images", &here)?;
        let mut found = FoundMap {
            image,
            uv_set: info.tex_coord,
            picture_from_uv: transform(info),
            nearest: false,
            minify: Minify::default(),
            wrap: [Wrap::Repeat; 2],
        };
        let moved = info.extensions.transform.as_ref();
        if let Some(set) = moved.and_then(|it| it.tex_coord) {
            found.uv_set = set;
        }
        if let Some(index) = texture.sampler {
            let sampler = self
                .blame
                .get(&document.samplers, index, "samplers", &here)?;
            found.nearest = sampler.mag_filter == Some(NEAREST);
            found.minify = match sampler.min_filter {
                Some(NEAREST) => Minify::Nearest,
                Some(LINEAR) => Minify::Linear,
                Some(NEAREST_MIPMAP_NEAREST) => Minify::NearestMipmapNearest,
                Some(LINEAR_MIPMAP_NEAREST) => Minify::LinearMipmapNearest,
                Some(NEAREST_MIPMAP_LINEAR) => Minify::NearestMipmapLinear,
                _ => Minify::LinearMipmapLinear,
            };
            found.wrap = [sampler.wrap_s, sampler.wrap_t].map(|wrap| match wrap {
                Some(CLAMP) => Wrap::Clamp,
                Some(MIRROR) => Wrap::Mirror,
                _ => Wrap::Repeat,
            });
        }
        Ok(Some(found))
    }

    /// Gives `material`, which is `model`'s, the pictures of `source`. Returns the set of texture
    /// coordinates that they use.
    pub(super) fn textured(
        &mut self,
        source: &Source,
        model: &MetallicRoughness,
        material: &mut Material,
        here: &str,
    ) -> Result<Option<u32>, ImportError> {
        let pbr = source.pbr_metallic_roughness.as_deref();
        let extensions = source.extensions.as_deref();
        let older = extensions.and_then(|e| e.specular_glossiness.as_deref());
        let infos = [
            match older {
                Some(older) => older.diffuse_texture.as_deref(),
                None => pbr.and_then(|pbr| pbr.base_color_texture.as_deref()),
            },
            match older {
                Some(_) => None,
                None => pbr.and_then(|pbr| pbr.metallic_roughness_texture.as_deref()),
            },
            extensions
                .and_then(|e| e.transmission.as_ref())
                .and_then(|it| it.transmission_texture.as_deref()),
        ];
        let mut maps = [None, None, None];
        for (map, info) in maps.iter_mut().zip(infos) {
            if let Some(info) = info {
                *map = self.map(info, here)?;
            }
        }
        let mut lead = maps.iter().flatten().next().cloned();
        for map in &mut maps {
            if let (Some(other), Some(lead)) = (&*map, &lead)
                && !other.is_aligned(lead)
            {
                self.notes.add("maps that are not shown", || {
                    format!(
                        "{here}: a map with other texture coordinates than the first is not shown"
                    )
                });
                *map = None;
            }
        }
        if let Some(lead) = &lead
            && let Some(look) = self.appearance(model, &maps)?
        {
            self.dress(material, model, &look, lead);
        } else {
            lead = None;
        }
        let mut uv_set = lead.map(|lead| lead.uv_set);
        if model.coverage != Coverage::Opaque
            && let Some(map) = &maps[0]
            && let Some(picture) = self.shown(map.image, Role::Color)?
        {
            material.textures.alpha = Some(self.texture(picture, map));
        }
        if let Some(info) = source.emissive_texture.as_deref()
            && model.emission != Vec3::ZERO
            && !model.unlit
        {
            material.textures.emission = self.other(info, false, &mut uv_set, here)?;
        }
        if let Some(info) = source.normal_texture.as_deref()
            && !model.unlit
        {
            material.textures.normal = self.other(info, true, &mut uv_set, here)?;
            material.normal_scale = info.scale.unwrap_or(1.0).clamp(0.0, 1e3) as f32;
        }
        Ok(uv_set)
    }

    /// The texture of a map that is shown as it is, with values or colours; `None` with a note if it uses
    /// another set of texture coordinates than `uv_set`, which it sets if it is the first.
    fn other(
        &mut self,
        info: &TextureInfo,
        has_values: bool,
        uv_set: &mut Option<u32>,
        here: &str,
    ) -> Result<Option<usize>, ImportError> {
        let Some(map) = self.map(info, here)? else {
            return Ok(None);
        };
        if uv_set.is_some_and(|set| set != map.uv_set) {
            self.notes.add("maps that are not shown", || {
                let what = if has_values { "normal" } else { "emissive" };
                format!(
                    "{here}.{what}Texture uses another set of texture coordinates and is not shown"
                )
            });
            return Ok(None);
        }
        let role = if has_values { Role::Data } else { Role::Color };
        let Some(picture) = self.shown(map.image, role)? else {
            return Ok(None);
        };
        *uv_set = Some(map.uv_set);
        Ok(Some(self.texture(picture, &map)))
    }

    /// The classical colours of `model` with its base colour, metallic-roughness and transmission map;
    /// `None` if no map can be read.
    fn appearance(
        &mut self,
        model: &MetallicRoughness,
        maps: &[Option<FoundMap>; 3],
    ) -> Result<Option<Appearance>, ImportError> {
        let mut sheets = [None, None, None];
        let roles = [Role::Color, Role::Data, Role::Data];
        for ((sheet, map), role) in sheets.iter_mut().zip(maps).zip(roles) {
            if let Some(map) = map {
                *sheet = self.image(map.image, role)?;
            }
        }
        if sheets.iter().all(Option::is_none) {
            return Ok(None);
        }
        let key = key(model, maps);
        if let Some(known) = self.store.known.get(&key) {
            return Ok(Some(known.clone()));
        }
        let is_simple = sheets[1].is_none()
            && sheets[2].is_none()
            && (model.metallic == 0.0 || model.metallic == 1.0)
            && model.transmission == 0.0
            && !model.unlit;
        let look = match (&sheets[0], maps[0].as_ref()) {
            (Some(_), Some(map)) if is_simple => {
                let picture = self.shown(map.image, Role::Color)?;
                let lobes = model.lobes(&model.point(), model.roughness);
                // With metals, all colours are multiples of the base colour.
                let is_metal = model.metallic == 1.0;
                let tinted = |color| (color, picture.filter(|_| is_metal && color != Vec3::ZERO));
                Appearance {
                    diffuse: (lobes.diffuse, picture),
                    specular: tinted(lobes.specular),
                    reflect: tinted(lobes.reflect),
                    transmit: (lobes.transmit, None),
                    roughness: model.roughness,
                }
            }
            _ => {
                // What is unlit shines with the colour that would be diffuse.
                let mut model = model.clone();
                if std::mem::take(&mut model.unlit) {
                    (model.metallic, model.transmission) = (0.0, 0.0);
                    (model.specular, model.roughness) = (0.0, 1.0);
                    sheets[1] = None;
                    sheets[2] = None;
                }
                for sheet in sheets.iter_mut().flatten() {
                    *sheet = self.store.pictures.at_most(sheet.clone(), MAX_BAKED);
                }
                let baked = bake::bake(
                    &model,
                    &Sheets {
                        base_color: sheets[0].as_deref(),
                        metallic_roughness: sheets[1].as_deref(),
                        transmission: sheets[2].as_deref(),
                    },
                );
                self.stored(baked)
            }
        };
        self.store.known.insert(key, look.clone());
        Ok(Some(look))
    }

    /// Adds baked pictures to the store.
    fn stored(&mut self, baked: Baked) -> Appearance {
        let mut add = |shade| match shade {
            Shade::Constant(color) => (color, None),
            Shade::Picture(picture) => (Vec3::ONE, Some(self.store.pictures.add(picture))),
        };
        Appearance {
            diffuse: add(baked.diffuse),
            specular: add(baked.specular),
            reflect: add(baked.reflect),
            transmit: add(baked.transmit),
            roughness: baked.roughness,
        }
    }

    /// Gives `material` the colours of `look`.
    fn dress(
        &mut self,
        material: &mut Material,
        model: &MetallicRoughness,
        look: &Appearance,
        map: &FoundMap,
    ) {
        let mut texture = |picture: Option<usize>| picture.map(|it| self.texture(it, map));
        let diffuse = texture(look.diffuse.1);
        let textures = &mut material.textures;
        if model.unlit {
            material.emission = look.diffuse.0;
            textures.emission = diffuse;
        } else {
            material.diffuse = look.diffuse.0;
            material.ambient = look.diffuse.0;
            (textures.diffuse, textures.ambient) = (diffuse, diffuse);
        }
        let smoother = MetallicRoughness {
            roughness: look.roughness,
            ..model.clone()
        };
        material.shininess = smoother.classical(String::new()).shininess;
        material.specular = look.specular.0;
        material.reflect = look.reflect.0;
        material.transmit = look.transmit.0;
        textures.specular = texture(look.specular.1);
        textures.reflect = texture(look.reflect.1);
        textures.transmit = texture(look.transmit.1);
    }

    /// Adds a texture with `picture`, placed as `map` says.
    fn texture(&mut self, picture: usize, map: &FoundMap) -> usize {
        let flip = DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
            translation: DVec3::Y,
        };
        let texture = Texture {
            pattern: Pattern::Picture {
                picture,
                nearest: map.nearest,
                minify: map.minify,
                wrap: map.wrap,
            },
            space: Space::Uv,
            pattern_from_space: flip * map.picture_from_uv * flip,
        };
        let textures = &mut self.scene.textures;
        // Materials of one file often share a texture; only the last few are compared.
        let recent = textures.len().saturating_sub(64);
        if let Some(known) = textures[recent..]
            .iter()
            .position(|known| *known == texture)
        {
            return recent + known;
        }
        textures.push(texture);
        textures.len() - 1
    }
}

/// All that baked pictures depend on.
fn key(model: &MetallicRoughness, maps: &[Option<FoundMap>; 3]) -> Vec<u32> {
    let mut key = vec![u32::MAX];
    key.extend(
        maps.iter()
            .map(|map| map.as_ref().map_or(u32::MAX, |map| map.image as u32)),
    );
    key.extend([model.unlit, model.thickness > 0.0].map(u32::from));
    let colors = [model.base_color, model.specular_color].map(|color| color.to_array());
    let numbers = [
        model.metallic,
        model.roughness,
        model.ior,
        model.specular,
        model.transmission,
    ];
    key.extend(
        colors
            .as_flattened()
            .iter()
            .chain(&numbers)
            .map(|x| x.to_bits()),
    );
    key
}
