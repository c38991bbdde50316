//! Layers as pictures to look at: colours as they are, everything else in false colours.

use super::layers::PictureLayer;
use glimray_render::gpu::Gpu;
use glimray_render::{Features, PixelFeatures, RenderError, Tone};
use glimray_scene::Transfer;
use glimray_scene::image::Image;

/// The grey level of the greatest distance.
const FAR: f32 = 0.1;

/// A layer other than the beauty, in display values. Light is developed with the tone. Numbers of objects and materials
/// have a colour each, black for none. Distances go from white to dark grey and variances from black to white, both by
/// their logarithms; positions are red, green and blue from one end of the picture's extent to the other.
///
/// # Errors
/// The device failed.
pub fn picture(
    layer: PictureLayer,
    features: &Features,
    tone: &Tone,
    gpu: &Gpu,
) -> Result<Image, RenderError> {
    let drawn = |color: &dyn Fn(&PixelFeatures) -> [f32; 3]| Image {
        width: features.width,
        height: features.height,
        pixels: (features.pixels.iter())
            .map(|pixel| {
                let [r, g, b] = color(pixel);
                [r, g, b, 1.0]
            })
            .collect(),
    };
    let light = |of: fn(&PixelFeatures) -> [f32; 3]| tone.develop(gpu, &drawn(&of));
    let srgb = Tone {
        transfer: Transfer::Srgb,
        ..Tone::LINEAR
    };
    let (nearest, farthest) = extent(features, |pixel| pixel.depth);
    let (quietest, noisiest) = extent(features, |pixel| pixel.variance);
    let most = features
        .pixels
        .iter()
        .map(|it| it.samples)
        .fold(1.0, f32::max);
    let ends = [0, 1, 2].map(|axis| {
        let hits = features.pixels.iter().filter(|pixel| pixel.material > 0);
        let along = hits.map(|pixel| pixel.position[axis]);
        along.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| {
            (low.min(at), high.max(at))
        })
    });
    Ok(match layer {
        PictureLayer::Beauty => tone.develop(gpu, &features.picture())?,
        PictureLayer::Albedo => srgb.develop(gpu, &drawn(&|pixel| pixel.albedo))?,
        PictureLayer::Direct => light(|pixel| pixel.direct)?,
        PictureLayer::Indirect => light(|pixel| pixel.indirect)?,
        PictureLayer::Emission => light(|pixel| pixel.emission)?,
        PictureLayer::Normal => drawn(&|pixel| match pixel.normal == [0.0; 3] {
            true => [0.0; 3],
            false => pixel.normal.map(|along| 0.5 + 0.5 * along),
        }),
        PictureLayer::Depth => drawn(&|pixel| {
            let far = place_of(pixel.depth, nearest, farthest);
            [far.map_or(0.0, |far| 1.0 + far * (FAR - 1.0)); 3]
        }),
        PictureLayer::Position => drawn(&|pixel| match pixel.material {
            0 => [0.0; 3],
            _ => [0, 1, 2].map(|axis| {
                let (low, high) = ends[axis];
                (pixel.position[axis] - low) / (high - low).max(1e-30)
            }),
        }),
        PictureLayer::Uv => drawn(&|pixel| match pixel.material {
            0 => [0.0; 3],
            _ => [
                pixel.uv[0].rem_euclid(1.0),
                pixel.uv[1].rem_euclid(1.0),
                0.0,
            ],
        }),
        PictureLayer::Object => drawn(&|pixel| number_color(pixel.object)),
        PictureLayer::Material => drawn(&|pixel| number_color(pixel.material)),
        PictureLayer::Variance => {
            drawn(&|pixel| heat(place_of(pixel.variance, quietest, noisiest).unwrap_or(0.0)))
        }
        PictureLayer::Samples => drawn(&|pixel| [pixel.samples / most; 3]),
    })
}

/// The least and the greatest of the numbers above 0.
fn extent(features: &Features, of: fn(&PixelFeatures) -> f32) -> (f32, f32) {
    let numbers = features
        .pixels
        .iter()
        .map(of)
        .filter(|number| *number > 0.0);
    numbers.fold((f32::INFINITY, 0.0), |(low, high), number| {
        (number.min(low), number.max(high))
    })
}

/// The place of a number above 0 between two others by their logarithms, from 0 to 1.
fn place_of(number: f32, low: f32, high: f32) -> Option<f32> {
    let place = (number / low).log2() / (high / low).log2().max(1e-6);
    (number > 0.0).then(|| place.clamp(0.0, 1.0))
}

/// A colour for a number, of a hue that is far from those of the numbers beside it: steps of the golden ratio. Black for 0.
fn number_color(number: u32) -> [f32; 3] {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    if number == 0 {
        return [0.0; 3];
    }
    let hue = (f64::from(number) * GOLDEN).fract() as f32;
    let value = [1.0, 0.75, 0.55][number as usize % 3];
    [0.0, 2.0 / 3.0, 1.0 / 3.0].map(|shift| {
        let along = 6.0 * (hue + shift).fract();
        value * (0.25 + 0.75 * ((along - 3.0).abs() - 1.0).clamp(0.0, 1.0))
    })
}

/// From black over blue, green, yellow and red to white, as the view of traversal costs.
fn heat(place: f32) -> [f32; 3] {
    let stops = super::legend::stops(glimray_render::Quantity::Work);
    super::legend::color_at(stops, place).map(|level| level / 255.0)
}
