//! Pictures of the classical colours of metallic-roughness materials, computed texel by texel from several maps.
//!
//! Only the classical integrator shows them: scenes that are path-traced do without.

use super::metallic_roughness::shininess;
use super::{
    Bsdf, MAX_PICTURE_BYTES, Material, MetallicRoughness, Origin, Pattern, Phong, PhongTextures,
    Picture, Scene, SrgbCurve, SurfacePoint, Target, Texels, TextureProperty,
};
use crate::threads;
use glam::{DVec4, Vec3, Vec4Swizzles};
use std::collections::HashMap;
use std::sync::Arc;

/// Largest width and height of the pictures.
const MAX_SIDE: u32 = 2048;

/// Differences of colours below this are not worth a picture.
const VISIBLE: f32 = 1.0 / 512.0;

/// The maps of a material that belong to the same texture coordinates: base colour in sRGB, metalness in blue,
/// roughness in green, transmission in red.
type Sheets = [Option<Arc<Picture>>; 4];

/// A colour, and the picture that multiplies it.
type Shade = (Vec3, Option<Arc<Picture>>);

/// The colours of the classical model.
#[derive(Clone, Debug)]
struct Baked {
    diffuse: Shade,
    specular: Shade,
    reflect: Shade,
    transmit: Shade,
    /// The mean, for the width of the highlight.
    roughness: f32,
}

/// The pictures that were computed for a scene, to be used again after a change.
#[derive(Clone, Debug, Default)]
pub struct ClassicalMaps {
    /// With what they were computed from, so that its address stays its own.
    known: HashMap<Key, (Sheets, Baked)>,
}

/// All that the pictures of a material depend on: numbers, and addresses of sheets.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key(Vec<u32>, [usize; 4]);

impl Material {
    /// Whether its classical colours differ from texel to texel in a way that its textures alone cannot show. They do
    /// not follow the values of its layers then.
    pub fn has_classical_maps(&self) -> bool {
        let Some(model) = self.metallic_roughness() else {
            return false;
        };
        let layers = &model.textures;
        let has_values = [layers.metallic, layers.roughness, layers.transmission]
            .iter()
            .any(Option::is_some);
        let is_even = model.metallic.fract() == 0.0 && model.transmission == 0.0;
        !model.unlit && (has_values || layers.base_color.is_some() && !is_even)
    }
}

impl Scene {
    /// Gives materials whose maps only paths would show their classical colours, in pictures of at most 2048 × 2048
    /// texels. For the integrator [`super::LightTransport::Whitted`]; others show the same without.
    pub fn bake_classical_maps(&mut self) {
        ClassicalMaps::default().bake(self);
    }

    /// Whether the texels of two pictures at the same place belong to the same points of a surface at all times.
    fn are_aligned(&self, a: usize, b: usize) -> bool {
        let motion = |index: usize| {
            let moves = |property| {
                let target = Target::Texture(index, property);
                let mut tracks = self.tracks.iter();
                tracks
                    .find(|track| track.targets.contains(&target))
                    .map(|track| &track.curve)
            };
            TextureProperty::ALL.map(moves)
        };
        self.textures[a].is_aligned(&self.textures[b]) && motion(a) == motion(b)
    }

    /// Whether [`Self::bake_classical_maps`] would change it.
    pub fn lacks_classical_maps(&self) -> bool {
        self.materials.iter().any(|it| self.sources(it).is_some())
    }

    /// Model and maps that a material's pictures are computed from, and the index of the texture that places them;
    /// `None` if it needs none or has them.
    fn sources(&self, material: &Material) -> Option<(MetallicRoughness, Sheets, usize)> {
        let model = material.metallic_roughness()?;
        if !material.has_classical_maps() || model.phong.is_some() {
            return None;
        }
        let mut model = model.clone();
        let layers = model.textures;
        let textures = [
            layers.base_color,
            layers.metallic,
            layers.roughness,
            layers.transmission,
        ];
        let lead = *textures.iter().flatten().next()?;
        let mut sheets = Sheets::default();
        for (slot, texture) in textures.into_iter().enumerate() {
            let Some(texture) = texture else { continue };
            let Pattern::Picture { picture, .. } = self.textures[texture].pattern else {
                return None;
            };
            let picture = &self.pictures[picture];
            if self.are_aligned(texture, lead) {
                sheets[slot] = Some(picture.clone());
            } else {
                // Without a picture for it, a map counts with its mean.
                with_mean(&mut model, slot, picture);
            }
        }
        Some((model, sheets, lead))
    }
}

impl ClassicalMaps {
    /// Bakes `scene` as [`Scene::bake_classical_maps`] does, with pictures of earlier calls where they fit.
    pub fn bake(&mut self, scene: &mut Scene) {
        let mut jobs = HashMap::new();
        let mut wanted = Vec::new();
        for (index, material) in scene.materials.iter().enumerate() {
            if let Some((model, sheets, lead)) = scene.sources(material) {
                let key = key(&model, &sheets);
                wanted.push((index, key.clone(), lead));
                jobs.entry(key).or_insert((model, sheets));
            }
        }
        let own: usize = scene.pictures.iter().map(|it| it.texels.byte_len()).sum();
        let most = largest_side(jobs.values().map(|(_, sheets)| sheets), own);
        let before = std::mem::take(&mut self.known);
        let known = before.into_iter().filter(|(key, _)| jobs.contains_key(key));
        self.known = known.collect();
        jobs.retain(|key, _| !self.known.contains_key(key));
        let jobs: Vec<_> = jobs.into_iter().collect();
        let made = threads::map(jobs, |(key, (model, sheets))| {
            let baked = bake(&model, sheets.clone(), most);
            (key, (sheets, baked))
        });
        self.known.extend(made);
        let mut added = Added::default();
        for (index, key, lead) in wanted {
            if let Some((_, baked)) = self.known.get(&key) {
                scene.dress(index, baked, lead, &mut added);
            }
        }
    }
}

impl Scene {
    /// Gives the material at `index` the colours of `baked`, placed as the texture `lead` is. `added` has the places of
    /// what was added before.
    fn dress(&mut self, index: usize, baked: &Baked, lead: usize, added: &mut Added) {
        let mut texture = |shade: &Shade| {
            let picture = shade.1.as_ref()?;
            let address = Arc::as_ptr(picture);
            let known = added.textures.get(&(address, lead)).copied();
            Some(known.unwrap_or_else(|| {
                let place = *added.pictures.entry(address).or_insert_with(|| {
                    self.pictures.push(picture.clone());
                    self.pictures.len() - 1
                });
                let made = self.copied(lead, place);
                added.textures.insert((address, lead), made);
                made
            }))
        };
        let diffuse = texture(&baked.diffuse);
        let (specular, reflect) = (texture(&baked.specular), texture(&baked.reflect));
        let transmit = texture(&baked.transmit);
        let material = &mut self.materials[index];
        let Bsdf::MetallicRoughness(model) = &mut material.bsdf else {
            return;
        };
        let mut phong = Phong {
            diffuse: baked.diffuse.0,
            ambient: baked.diffuse.0,
            specular: baked.specular.0,
            reflect: baked.reflect.0,
            transmit: baked.transmit.0,
            shininess: shininess(baked.roughness),
            textures: PhongTextures {
                diffuse,
                ambient: diffuse,
                specular,
                reflect,
                transmit,
            },
            ..model.phong_without_maps()
        };
        model.paint(&mut phong, material.tint);
        Arc::make_mut(model).phong = Some(Box::new(phong));
    }
}

impl Scene {
    /// Adds a texture of another picture, placed and moved as the texture `lead` is, and returns its index.
    fn copied(&mut self, lead: usize, other: usize) -> usize {
        let mut texture = self.textures[lead].clone();
        if let Pattern::Picture { picture, .. } = &mut texture.pattern {
            *picture = other;
        }
        self.textures.push(texture);
        let index = self.textures.len() - 1;
        for track in &mut self.tracks {
            for property in TextureProperty::ALL {
                if track.targets.contains(&Target::Texture(lead, property)) {
                    track.targets.push(Target::Texture(index, property));
                }
            }
        }
        index
    }
}

/// Where pictures that were added are in the scene, and textures of them by that which places them.
#[derive(Default)]
struct Added {
    pictures: HashMap<*const Picture, usize>,
    textures: HashMap<(*const Picture, usize), usize>,
}

/// The largest side that pictures of all these sheets may have beside others of `own` bytes.
fn largest_side<'s>(jobs: impl Iterator<Item = &'s Sheets> + Clone, own: usize) -> u32 {
    let mut most = MAX_SIDE;
    let bytes = |most: u32| -> usize {
        let sides = jobs.clone().map(|sheets| {
            let (width, height) = size(sheets);
            width.min(most) as usize * height.min(most) as usize
        });
        // Four colours of four bytes.
        sides.map(|texels| 16 * texels).sum()
    };
    while most > 1 && own.saturating_add(bytes(most)) > MAX_PICTURE_BYTES {
        most /= 2;
    }
    most
}

/// Width and height of the largest sheet.
fn size(sheets: &Sheets) -> (u32, u32) {
    let sizes = sheets.iter().flatten().map(|it| (it.width, it.height));
    sizes.fold((1, 1), |most, size| {
        (most.0.max(size.0), most.1.max(size.1))
    })
}

fn key(model: &MetallicRoughness, sheets: &Sheets) -> Key {
    let colors = [model.base_color, model.specular_color].map(|color| color.to_array());
    let numbers = [
        model.metallic,
        model.roughness,
        model.ior,
        model.specular,
        model.transmission,
        model.thickness,
    ];
    let numbers = colors.as_flattened().iter().chain(&numbers);
    let address = |it: &Option<Arc<Picture>>| it.as_ref().map_or(0, |it| Arc::as_ptr(it).addr());
    Key(
        numbers.map(|x| x.to_bits()).collect(),
        sheets.each_ref().map(address),
    )
}

/// Multiplies a parameter of `model` by the mean of a map that is not aligned with the others, by its place in
/// [`Sheets`].
fn with_mean(model: &mut MetallicRoughness, slot: usize, sheet: &Picture) {
    let sum: DVec4 = sheet.linear().map(|texel| texel.as_dvec4()).sum();
    let mean = (sum / sheet.texels.len() as f64).as_vec4();
    match slot {
        1 => model.metallic *= mean.z,
        2 => model.roughness *= mean.y,
        _ => model.transmission *= mean.x,
    }
}

/// The colours of `model` with `sheets`, in pictures of the size of the largest sheet, which is at most `most` texels a
/// side; others are sampled at the nearest texel. At least one sheet must be there.
fn bake(model: &MetallicRoughness, mut sheets: Sheets, most: u32) -> Baked {
    for sheet in sheets.iter_mut().flatten() {
        while sheet.width.max(sheet.height) > most {
            *sheet = sheet.halved().into();
        }
    }
    let (width, height) = size(&sheets);
    let [base_color, metallic, rough, transmission] = &sheets;
    let curve = SrgbCurve::default();
    let texel = |sheet: &Option<Arc<Picture>>, x: u32, y: u32| {
        sheet.as_ref().map(|sheet| {
            let (w, h) = (sheet.width, sheet.height);
            let along =
                |i: u32, n: u32, of: u32| (u64::from(i) * u64::from(n) / u64::from(of)) as usize;
            let row = along(y, h, height) * w as usize;
            sheet.texels.linear(&curve, row + along(x, w, width))
        })
    };
    let point = |x: u32, y: u32| {
        let mut point: SurfacePoint = model.point();
        if let Some(texel) = texel(base_color, x, y) {
            point.base_color *= texel.xyz();
        }
        if let Some(texel) = texel(metallic, x, y) {
            point.metallic *= texel.z;
        }
        if let Some(texel) = texel(rough, x, y) {
            point.roughness *= texel.y;
        }
        if let Some(texel) = texel(transmission, x, y) {
            point.transmission *= texel.x;
        }
        point
    };
    let roughness = match rough {
        None => model.roughness,
        Some(sheet) => {
            let sum: f64 = sheet.linear().map(|texel| f64::from(texel.y)).sum();
            model.roughness * (sum / sheet.texels.len() as f64) as f32
        }
    };
    let count = width as usize * height as usize;
    // Transmission is a fraction, and most others are colours: each keeps its precision in 8 bits.
    let linear = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| (x * 255.0).round() as u8);
        [r, g, b, u8::MAX]
    };
    let srgb = |color: Vec3| {
        let [r, g, b] = color.to_array().map(|x| curve.code(x));
        [r, g, b, u8::MAX]
    };
    let mut layers: [Vec<[u8; 4]>; 4] = Default::default();
    // A layer stays empty while it has one colour only.
    let mut first = None;
    for i in 0..count {
        let (x, y) = ((i % width as usize) as u32, (i / width as usize) as u32);
        let lobes = model.lobes(&point(x, y), roughness);
        let colors = [lobes.diffuse, lobes.specular, lobes.reflect, lobes.transmit];
        let first = *first.get_or_insert(colors);
        for (k, layer) in layers.iter_mut().enumerate() {
            let encoded = |color| match k {
                3 => linear(color),
                _ => srgb(color),
            };
            let differs = (colors[k] - first[k]).abs().max_element() > VISIBLE;
            if layer.is_empty() && differs {
                layer.reserve_exact(count);
                layer.resize(i, encoded(first[k]));
            }
            if !layer.is_empty() || differs {
                layer.push(encoded(colors[k]));
            }
        }
    }
    let first = first.unwrap_or_default();
    let mut shades = layers.into_iter().enumerate().map(|(k, texels)| {
        let texels = match (texels.is_empty(), k) {
            (true, _) => return (first[k], None),
            (false, 3) => Texels::Linear8(texels),
            (false, _) => Texels::Srgb8(texels),
        };
        let picture = Picture {
            width,
            height,
            texels,
            origin: Origin::Texels,
        };
        (Vec3::ONE, Some(Arc::new(picture)))
    });
    let mut next = || shades.next().unwrap_or_default();
    Baked {
        diffuse: next(),
        specular: next(),
        reflect: next(),
        transmit: next(),
        roughness,
    }
}
