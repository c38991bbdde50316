//! The features of a film's pixels, in scene units.

use super::{
    RenderError, Renderer, Tone,
    layers::{self, Layer},
    luminance::luminance,
    opacity::{opacity, straight},
    sums::fill_rectangle,
};
use crate::pack::{PackedScene, PackedView};
use glam::DVec3;
use glimray_scene::ObjectRef;
use glimray_scene::image::Image;
use glimray_scene::threads;

/// The features of the pixels of a rectangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// `width * height` of them, row by row from the top left; zeros without samples.
    pub pixels: Vec<PixelFeatures>,
}

impl Features {
    /// The picture that was rendered: linear radiance and opacity.
    pub fn picture(&self) -> Image {
        let pixel = |pixel: &PixelFeatures| {
            let [r, g, b] = pixel.radiance;
            match pixel.transparency > 0.0 {
                true => straight(pixel.radiance, 1.0 - pixel.transparency),
                false => [r, g, b, 1.0],
            }
        };
        Image {
            width: self.width,
            height: self.height,
            pixels: threads::collect(self.pixels.len(), |index| pixel(&self.pixels[index])),
        }
    }
}

/// The features of a pixel. Means are over all its samples, weighted by the filter; those of albedo and normal over the samples
/// that show what mirrors show. `depth`, `position`, `uv`, `object`
/// and `material` are those of the first surface of the sample nearest the centre, and 0 where that hits nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelFeatures {
    /// Mean linear radiance, not negative; of a transparent picture, what that adds to the light behind it.
    pub radiance: [f32; 3],
    /// How much of what lies behind is seen, 0 to 1; see [`glimray_scene::Backdrop::Transparent`].
    pub transparency: f32,
    /// Mean albedo of what is seen through mirrors and clear glass, 0 to 1; of light its radiance, at most 1. Filters with
    /// negative lobes may make it negative, not below -1.
    pub albedo: [f32; 3],
    /// Variance of the luminance of that mean, as if samples were independent; 0 if hardly more than one sample shows what
    /// mirrors show.
    pub albedo_variance: f32,
    /// Mean shading normal in world space, at most 1 long.
    pub normal: [f32; 3],
    /// Mean light that was scattered once.
    pub direct: [f32; 3],
    /// Mean light that was scattered twice or more: what remains of the radiance.
    pub indirect: [f32; 3],
    /// Mean light that was not scattered.
    pub emission: [f32; 3],
    /// Distance from the camera along the ray.
    pub depth: f32,
    /// In world space.
    pub position: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// From 1: instances of meshes in the scene's order, then shapes, then lights.
    pub object: u32,
    /// Index of the material plus 1.
    pub material: u32,
    /// Variance of the mean luminance, as if samples were independent.
    pub variance: f32,
    /// Number of samples.
    pub samples: f32,
}

/// The weight of the albedo and normal of a sample that does not show what mirrors show.
const LEAST_WEIGHT: f64 = 1.0 / 1024.0;

/// Where the features are among the rows of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    opacity: Option<usize>,
    squares: usize,
    albedo: usize,
    normal: usize,
    direct: usize,
    emission: usize,
    first: usize,
    count: Option<usize>,
}

impl Places {
    /// `None` if these layers lack features.
    pub fn new(layers: &[&Layer]) -> Option<Self> {
        let at = |layer| layers::row_of(layers, layer);
        Some(Self {
            opacity: at(&layers::OPACITY),
            squares: at(&layers::SQUARES)?,
            albedo: at(&layers::ALBEDO)?,
            normal: at(&layers::NORMAL)?,
            direct: at(&layers::DIRECT)?,
            emission: at(&layers::EMISSION)?,
            first: at(&layers::FIRST)?,
            count: at(&layers::COUNT),
        })
    }

    /// The features of a pixel from its rows, with the position as it is there. `samples` is their number where no row
    /// counts them.
    pub fn pixel(&self, rows: &[[f64; 4]], samples: f64) -> PixelFeatures {
        let weight = rows[0][3];
        // Weights of both signs may cancel (lib/filter.wesl).
        let scale = match weight.abs() > 0.5 {
            true => 1.0 / weight,
            false => 0.0,
        };
        let mean = |row: usize| [0, 1, 2].map(|channel| rows[row][channel] * scale);
        // These rows have a weight of their own, a small one where no sample shows what mirrors show: see `feature_mean` in
        // scene/features.wesl.
        let own_weight = rows[self.albedo][3];
        let own_scale = match own_weight.abs() > 0.5 * LEAST_WEIGHT {
            true => 1.0 / own_weight,
            false => 0.0,
        };
        let own_mean = |row: usize| rows[row].map(|sum| (sum * own_scale).clamp(-1.0, 1.0));
        let [red, green, blue, _] = own_mean(self.albedo);
        let [normal_x, normal_y, normal_z, albedo_squares] = own_mean(self.normal);
        let whole = mean(0).map(|channel| channel.max(0.0));
        let (direct, emission) = (mean(self.direct), mean(self.emission));
        let rest = |channel: usize| whole[channel] - direct[channel] - emission[channel];
        let samples = self.count.map_or(samples, |row| rows[row][0]);
        let squares = match self.count {
            Some(_) => rows[self.squares][0],
            None => rows[self.squares][0] / samples.max(1.0),
        };
        let variance_of = |squares: f64, mean: [f64; 3], samples: f64| {
            (squares - luminance(mean).powi(2)).max(0.0) / (samples - 1.0).max(1.0)
        };
        let variance = variance_of(squares, whole, samples);
        let shown = samples * own_weight * scale;
        let albedo_variance = variance_of(albedo_squares, [red, green, blue], shown);
        let first = &rows[self.first..];
        let [x, y, z, depth] = first[1];
        PixelFeatures {
            radiance: single(whole),
            transparency: (self.opacity).map_or(0.0, |row| 1.0 - opacity(weight, &rows[row..])),
            albedo: single([red, green, blue]),
            albedo_variance: finite(albedo_variance),
            normal: single([normal_x, normal_y, normal_z]),
            direct: single(direct),
            indirect: single([0, 1, 2].map(rest)),
            emission: single(emission),
            depth: finite(depth),
            position: single([x, y, z]),
            uv: [finite(first[2][0]), finite(first[2][1])],
            object: first[0][3] as u32,
            material: first[0][2] as u32,
            variance: finite(variance),
            samples: samples as f32,
        }
    }
}

fn single(numbers: [f64; 3]) -> [f32; 3] {
    numbers.map(finite)
}

/// Numbers in f32, 0 for what is not finite there.
fn finite(number: f64) -> f32 {
    let number = number as f32;
    if number.is_finite() { number } else { 0.0 }
}

impl Renderer {
    /// Whether it denoises a picture of this tone.
    pub fn denoises(&self, tone: &Tone) -> bool {
        tone.denoise && self.settings.has_features()
    }

    /// The features of the samples so far. Without
    /// [`super::RenderSettings::features`] there are no pixels.
    ///
    /// # Errors
    /// The device failed.
    pub async fn features_async(&mut self) -> Result<Features, RenderError> {
        self.fetch_film().await?;
        let layers = layers::of_pictures(&self.settings);
        let Some(places) = Places::new(layers) else {
            return Ok(Features::default());
        };
        let region = self.settings.region();
        let [.., width, height] = region;
        let whole = f64::from(self.settings.samples_to_render().len() as u32);
        let is_done = self.is_done();
        let mut pixels = vec![PixelFeatures::default(); width as usize * height as usize];
        for (part, sums) in self.tiles.sums(layers) {
            let sums = (&sums, layers::pixel_rows(layers));
            // A renderer itself stays on its thread in browsers.
            let (scene, view) = (&*self.scene, &self.view);
            fill_rectangle(&mut pixels, region, part, sums, |rows| {
                let samples = if is_done { whole } else { rows[0][3].abs() };
                in_scene(
                    scene,
                    view,
                    places.pixel(rows, samples),
                    &rows[places.first..],
                )
            });
        }
        Ok(Features {
            width,
            height,
            pixels,
        })
    }
}

/// A pixel with its object, and its position in world space, from the rows of the first surface.
fn in_scene(
    scene: &PackedScene,
    view: &PackedView,
    mut pixel: PixelFeatures,
    first: &[[f64; 4]],
) -> PixelFeatures {
    if pixel.material > 0 {
        let ([.., instance], [x, y, z, _], [.., low, high]) = (first[0], first[1], first[2]);
        let primitive = low as u32 | (high as u32) << 16;
        pixel.object = number_of(scene, view, primitive, instance as u32);
        pixel.position = single(in_world(scene, [x, y, z]));
    }
    pixel
}

/// A point in world space, from one in render space.
pub fn in_world(scene: &PackedScene, point: [f64; 3]) -> [f64; 3] {
    (scene.origin + DVec3::from(point)).into()
}

/// The number of the object of a hit, from 1: the instances of meshes in the scene's order, then its shapes, then its
/// lights. 0 if there is none.
pub fn number_of(scene: &PackedScene, view: &PackedView, primitive: u32, instance: u32) -> u32 {
    let (instances, shapes) = scene.object_counts();
    let index = match scene.object_at(view, primitive, instance) {
        None => return 0,
        Some(ObjectRef::Instance(index)) => index,
        Some(ObjectRef::Shape(index)) => instances + index,
        Some(ObjectRef::Light(index)) => instances + shapes + index,
    };
    index as u32 + 1
}
