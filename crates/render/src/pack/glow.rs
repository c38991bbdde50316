//! How bright the texture of an emissive triangle is where the triangle lies: often most of a picture is black, and paths
//! should not look for light there.

use super::light_cluster::LUMINANCE;
use glam::{DAffine3, DVec2, USizeVec2};
use glimray_scene::{Material, Pattern, Picture, Scene, Space, Target, Texture, Wrap};
use std::sync::Arc;

/// Texels that are looked at for all triangles together, about a tenth of a second.
const ALL_TEXELS: f64 = 16_777_216.0;

/// The weight of a texel beyond an edge of a triangle, whose colour reaches it by interpolation only.
const REACHED: f64 = 0.02;

/// The luminance of a texture of emission.
#[derive(Clone, Debug)]
pub struct Glow {
    /// Over the whole texture.
    pub mean: f32,
    map: Option<Map>,
}

/// A picture over texture coordinates.
#[derive(Clone, Debug)]
struct Map {
    picture_from_uv: DAffine3,
    wrap: [Wrap; 2],
    is_second: bool,
    /// Each with half of the width and height of the one before; the last one has a single texel.
    levels: Arc<[Level]>,
}

/// Luminances, row by row from the top left.
#[derive(Clone, Debug)]
struct Level {
    size: USizeVec2,
    texels: Vec<f32>,
}

impl Glow {
    /// A material without a texture.
    const EVEN: Self = Self {
        mean: 1.0,
        map: None,
    };

    /// One for each material of a scene: even for those that do not emit.
    pub fn of_materials(scene: &Scene, emits: &[bool]) -> Vec<Self> {
        let mut pictures = vec![None; scene.pictures.len()];
        let mut textures = vec![None; scene.textures.len()];
        let mut of = |material: &Material, emits: bool| match material.radiance().1 {
            Some(index) if emits => (textures[index])
                .get_or_insert_with(|| Self::of_texture(scene, index, &mut pictures))
                .clone(),
            _ => Self::EVEN,
        };
        let materials = scene.materials.iter().zip(emits);
        (materials.map(|(material, emits)| of(material, *emits))).collect()
    }

    /// `pictures` keeps the levels of each.
    fn of_texture(scene: &Scene, index: usize, pictures: &mut [Option<Arc<[Level]>>]) -> Self {
        let texture = &scene.textures[index];
        let moves = (scene.tracks.iter()).any(|track| {
            track
                .targets
                .iter()
                .any(|target| matches!(target, Target::Texture(moved, _) if *moved == index))
        });
        match texture.pattern {
            Pattern::Checker { a, b }
            | Pattern::Stripes { a, b }
            | Pattern::Gradient { a, b }
            | Pattern::Noise { a, b, .. } => Self {
                mean: LUMINANCE.dot(a + b) / 2.0,
                map: None,
            },
            Pattern::Picture { picture, wrap, .. } => {
                let levels = (pictures[picture])
                    .get_or_insert_with(|| levels(&scene.pictures[picture]))
                    .clone();
                // The smallest level is not quite it where sizes are odd.
                let texels = &levels[0].texels;
                let sum: f64 = texels.iter().map(|texel| f64::from(*texel)).sum();
                let mean = (sum / texels.len() as f64) as f32;
                // A moving picture is bright elsewhere later.
                let is_map = texture.space != Space::World && !moves;
                let map = is_map.then(|| Map::new(texture, wrap, levels));
                Self { mean, map }
            }
        }
    }

    /// Whether it differs from triangle to triangle.
    pub fn is_uneven(&self) -> bool {
        self.map.is_some()
    }

    /// The mean luminance over a triangle with the two sets of texture coordinates of its corners, where so many of
    /// the level's texels at most are along the longer side of its box.
    pub fn over(&self, corners: [[f32; 4]; 3], most_texels: f64) -> f32 {
        match &self.map {
            Some(map) => map.over(corners, most_texels),
            None => self.mean,
        }
    }
}

/// How many texels along the longer side of a triangle's box are looked at, when there are so many triangles.
pub fn most_texels(triangles: usize) -> f64 {
    (ALL_TEXELS / triangles.max(1) as f64)
        .sqrt()
        .clamp(8.0, 64.0)
}

/// Means of four texels, until one is left.
fn levels(picture: &Picture) -> Arc<[Level]> {
    let texels = picture.linear();
    let mut levels = vec![Level {
        size: USizeVec2::new(picture.width as usize, picture.height as usize),
        texels: (texels.map(|texel| LUMINANCE.dot(texel.truncate()))).collect(),
    }];
    while let Some(level) = levels.last().filter(|level| level.texels.len() > 1) {
        levels.push(level.halved());
    }
    levels.into()
}

impl Level {
    /// At odd ends the last texels count twice.
    fn halved(&self) -> Self {
        let size = (self.size + 1) / 2;
        let last = self.size - 1;
        let mean = |place: usize| {
            let corner = 2 * USizeVec2::new(place % size.x, place / size.x);
            let of = |x, y| {
                let at = (corner + USizeVec2::new(x, y)).min(last);
                self.texels[at.y * self.size.x + at.x]
            };
            (of(0, 0) + of(1, 0) + of(0, 1) + of(1, 1)) / 4.0
        };
        Self {
            size,
            texels: (0..size.x * size.y).map(mean).collect(),
        }
    }
}

impl Map {
    fn new(texture: &Texture, wrap: [Wrap; 2], levels: Arc<[Level]>) -> Self {
        Self {
            picture_from_uv: texture.pattern_from_space,
            wrap,
            is_second: texture.space == Space::SecondUv,
            levels,
        }
    }

    fn over(&self, corners: [[f32; 4]; 3], most_texels: f64) -> f32 {
        // From the top left, in widths and heights of the picture.
        let places = corners.map(|[u, v, second_u, second_v]| {
            let (u, v) = match self.is_second {
                true => (second_u, second_v),
                false => (u, v),
            };
            let uv = DVec2::new(u.into(), v.into()).extend(0.0);
            let place = self.picture_from_uv.transform_point3(uv).truncate();
            DVec2::new(place.x, 1.0 - place.y)
        });
        let extent = |level: &Level| {
            let [a, b, c] = places.map(|place| place * level.size.as_dvec2());
            (a.max(b).max(c) - a.min(b).min(c)).max_element()
        };
        let last = &self.levels[self.levels.len() - 1];
        // An extent that is not finite fits no level.
        let fits = |level: &&Level| extent(level) <= most_texels;
        match self.levels.iter().find(fits) {
            Some(level) => self.mean_in(level, places),
            None => last.texels[0],
        }
    }

    /// The mean of the texels of a level over a triangle.
    fn mean_in(&self, level: &Level, places: [DVec2; 3]) -> f32 {
        let [a, b, c] = places.map(|place| place * level.size.as_dvec2());
        let side = (b - a).perp_dot(c - a).signum();
        let edges = [(a, b), (b, c), (c, a)].map(|(from, to)| {
            let inwards = side * (to - from).perp().normalize_or_zero();
            (from, inwards)
        });
        // About the part of a texel within the edges; a little for those that interpolation can reach.
        let weight = |center: DVec2| {
            let parts = edges.iter().map(|(from, inwards)| {
                let inside = inwards.dot(center - from) / inwards.abs().element_sum().max(1e-9);
                if inside < -1.0 {
                    0.0
                } else {
                    (inside + 0.5).clamp(REACHED, 1.0)
                }
            });
            parts.product::<f64>()
        };
        let min = (a.min(b).min(c) - 0.5).floor();
        let max = (a.max(b).max(c) + 0.5).ceil();
        let size = (max - min).as_usizevec2();
        let (mut sum, mut total) = (0.0, 0.0);
        for row in 0..size.y {
            for column in 0..size.x {
                let corner = min + DVec2::new(column as f64, row as f64);
                let weight = weight(corner + 0.5);
                if weight > 0.0 {
                    let x = wrapped(corner.x, level.size.x, self.wrap[0]);
                    let y = wrapped(corner.y, level.size.y, self.wrap[1]);
                    sum += weight * f64::from(level.texels[y * level.size.x + x]);
                    total += weight;
                }
            }
        }
        match total > 0.0 {
            true => (sum / total) as f32,
            false => self.levels[self.levels.len() - 1].texels[0],
        }
    }
}

/// The index of a texel that may lie beyond the picture.
fn wrapped(index: f64, count: usize, wrap: Wrap) -> usize {
    let count = count as f64;
    let inside = match wrap {
        Wrap::Repeat => index.rem_euclid(count),
        Wrap::Clamp => index,
        Wrap::Mirror => {
            let twice = index.rem_euclid(2.0 * count);
            twice.min(2.0 * count - 1.0 - twice)
        }
    };
    inside.clamp(0.0, count - 1.0) as usize
}
