//! From the maps of a material to the textures that multiply its classical colours.

use super::Reader;
use super::bake::{self, Baked, Shade, Sheets};
use super::document::{Material as Source, TextureInfo};
use super::maps::FoundMap;
use crate::import::error::ImportError;
use crate::import::picture::Role;
use crate::scene::{Coverage, LayerTextures, Material, MetallicRoughness, Pattern, Space, Texture};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// Largest width and height of pictures that are computed from several maps.
const MAX_BAKED: u32 = 2048;

/// The classical colours of a textured material: factors and indices of pictures.
#[derive(Clone, Debug)]
pub(super) struct Appearance {
    diffuse: (Vec3, Option<usize>),
    specular: (Vec3, Option<usize>),
    reflect: (Vec3, Option<usize>),
    transmit: (Vec3, Option<usize>),
    roughness: f32,
}

impl Reader<'_> {
    /// Gives `material`, which is `model`'s, the pictures of `source`. Returns the sets of texture coordinates that
    /// they use, at most two.
    pub(super) fn textured(
        &mut self,
        source: &Source,
        model: &MetallicRoughness,
        material: &mut Material,
        here: &str,
    ) -> Result<Vec<u32>, ImportError> {
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
        let lead = maps.iter().flatten().next().cloned();
        let mut sets = Vec::new();
        // Without a picture for it, a map counts with its mean.
        let mut mean = model.clone();
        if let Some(lead) = &lead {
            for (index, map) in maps.iter_mut().enumerate() {
                if map.as_ref().is_some_and(|map| !map.is_aligned(lead)) {
                    let note =
                        "a map with other texture coordinates than the first is shown by its mean";
                    (self.notes).add("maps that are not shown", || format!("{here}: {note}"));
                    if let Some(map) = map.take()
                        && let Some(image) = self.image(map.image, Role::Data)?
                    {
                        bake::with_mean(&mut mean, index, &image);
                    }
                }
            }
            if let Some(look) = self.appearance(&mean, &maps)? {
                let space = self.space(&mut sets, lead, here);
                self.dress(material, model, &look, lead, space.unwrap_or_default());
            }
        }
        if model.coverage != Coverage::Opaque
            && let Some(map) = &maps[0]
            && let Some(picture) = self.shown(map.image, Role::Color)?
            && let Some(space) = self.space(&mut sets, map, here)
        {
            material.textures.alpha = Some(self.texture(picture, map, space));
        }
        if !model.unlit {
            let layers = self.layer_textures(source, infos, &mut sets, here)?;
            material.layer_textures =
                (layers != LayerTextures::default()).then(|| Box::new(layers));
        }
        if let Some(info) = source.emissive_texture.as_deref()
            && model.emission != Vec3::ZERO
            && !model.unlit
        {
            material.textures.emission = self.other(info, false, &mut sets, here)?;
        }
        if let Some(info) = source.normal_texture.as_deref()
            && !model.unlit
        {
            material.textures.normal = self.other(info, true, &mut sets, here)?;
            material.normal_scale = info.scale.unwrap_or(1.0).clamp(0.0, 1e3) as f32;
        }
        if let Some(info) = source.occlusion_texture.as_deref()
            && !model.unlit
        {
            material.textures.occlusion = self.other(info, true, &mut sets, here)?;
            material.occlusion_strength = info.strength.unwrap_or(1.0).clamp(0.0, 1.0) as f32;
        }
        Ok(sets)
    }

    /// The textures of the layers of a material, the first three of which are `main`.
    fn layer_textures(
        &mut self,
        source: &Source,
        main: [Option<&TextureInfo>; 3],
        sets: &mut Vec<u32>,
        here: &str,
    ) -> Result<LayerTextures, ImportError> {
        let mut of = |info: Option<&TextureInfo>, has_values| match info {
            Some(info) => self.other(info, has_values, sets, here),
            None => Ok(None),
        };
        macro_rules! map {
            ($extension:ident $texture:ident) => {
                (source.extensions.as_deref())
                    .and_then(|it| it.$extension.as_ref())
                    .and_then(|it| it.$texture.as_deref())
            };
        }
        let base_color = of(main[0], false)?;
        let metallic_roughness = of(main[1], true)?;
        Ok(LayerTextures {
            base_color,
            metallic: metallic_roughness,
            roughness: metallic_roughness,
            transmission: of(main[2], true)?,
            specular: of(map!(specular specular_texture), true)?,
            specular_color: of(map!(specular specular_color_texture), false)?,
            clearcoat: of(map!(clearcoat clearcoat_texture), true)?,
            clearcoat_roughness: of(map!(clearcoat clearcoat_roughness_texture), true)?,
            sheen_color: of(map!(sheen sheen_color_texture), false)?,
            sheen_roughness: of(map!(sheen sheen_roughness_texture), true)?,
            anisotropy: of(map!(anisotropy anisotropy_texture), true)?,
            iridescence: of(map!(iridescence iridescence_texture), true)?,
            iridescence_thickness: of(map!(iridescence iridescence_thickness_texture), true)?,
            diffuse_transmission: of(
                map!(diffuse_transmission diffuse_transmission_texture),
                true,
            )?,
            diffuse_transmission_color: of(
                map!(diffuse_transmission diffuse_transmission_color_texture),
                false,
            )?,
        })
    }

    /// The place of a map's texture coordinates in the meshes of its material, whose sets so far are `sets`; `None`
    /// with a note if it is a third one.
    fn space(&mut self, sets: &mut Vec<u32>, map: &FoundMap, here: &str) -> Option<Space> {
        if !sets.contains(&map.uv_set) {
            sets.push(map.uv_set);
        }
        match sets.iter().position(|set| *set == map.uv_set) {
            Some(0) => Some(Space::Uv),
            Some(1) => Some(Space::SecondUv),
            _ => {
                sets.pop();
                self.notes.add("maps that are not shown", || {
                    format!("{here}: a map with a third set of texture coordinates is not shown")
                });
                None
            }
        }
    }

    /// The texture of a map that is shown as it is, with values or colours; `None` with a note if it cannot be.
    fn other(
        &mut self,
        info: &TextureInfo,
        has_values: bool,
        sets: &mut Vec<u32>,
        here: &str,
    ) -> Result<Option<usize>, ImportError> {
        let Some(map) = self.map(info, here)? else {
            return Ok(None);
        };
        let role = if has_values { Role::Data } else { Role::Color };
        let Some(picture) = self.shown(map.image, role)? else {
            return Ok(None);
        };
        let Some(space) = self.space(sets, &map, here) else {
            return Ok(None);
        };
        Ok(Some(self.texture(picture, &map, space)))
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
        space: Space,
    ) {
        let mut texture = |picture: Option<usize>| picture.map(|it| self.texture(it, map, space));
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
    fn texture(&mut self, picture: usize, map: &FoundMap, space: Space) -> usize {
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
            space,
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
