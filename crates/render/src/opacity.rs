//! Opacity: how much of what lies behind a picture can be seen through it.
//!
//! A sample sees through holes and smooth transparent surfaces to nothing, to a shadow catcher, or to neither. With the
//! sums over a pixel's samples of their filter weights W, of what is seen of nothing N and of catchers C, of the light L on
//! these, and of the light U that they would get if nothing were in its way,
//!
//! opacity = 1 − (N + C L / U) / W
//!
//! The ratio is that of sums, so it has no bias from the noise of single samples, and U = 0 is no shadow. L includes light
//! that the scene scatters onto the catcher; it is at most U. Colours of glass count by their luminance, as a picture has one
//! opacity.
//! Source: Debevec 1998, Rendering Synthetic Objects into Real Scenes, section 5, with the ratio of the two pictures in
//! place of their difference, as Cycles has it (`film/read.h`).

use super::{
    RenderError, Renderer,
    layers::{self, Layer},
    sums::{Sums, fill_rectangle},
};
use glimray_scene::image::Image;
use std::{borrow::Borrow, ops::AddAssign};

/// The least opacity by which colours are divided.
const LEAST: f32 = 1e-4;

/// The light on shadow catchers of pictures, in luminance; in any unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CatcherLight {
    /// The light that was counted.
    pub kept: f64,
    /// The light that the cap of single samples removed: see `MOST_SCATTERED` in `scene/opacity.wesl`.
    pub removed: f64,
}

impl CatcherLight {
    /// The share that was removed, 0 to 1; `None` without light.
    pub fn cut(self) -> Option<f64> {
        let all = self.kept + self.removed;
        // Filters with negative lobes leave the sums of few samples beyond that.
        (all > 0.0).then(|| (self.removed / all).clamp(0.0, 1.0))
    }
}

impl AddAssign for CatcherLight {
    fn add_assign(&mut self, other: Self) {
        self.kept += other.kept;
        self.removed += other.removed;
    }
}

/// The opacity of a pixel, from 0 to 1, from the sum of its weights and its rows of the layer
/// [`layers::OPACITY`]. A pixel without samples is transparent.
pub fn opacity(weight: f64, rows: &[[f64; 4]]) -> f32 {
    let ([nothing, catchers, ..], [light, unshadowed, ..]) = (rows[0], rows[1]);
    // Weights of both signs may cancel (lib/filter.wesl).
    if weight.abs() <= 0.5 {
        return 0.0;
    }
    let lit = match unshadowed != 0.0 {
        true => (light / unshadowed).clamp(0.0, 1.0),
        false => 1.0,
    };
    let clear = ((nothing + catchers * lit) / weight).clamp(0.0, 1.0);
    (1.0 - clear) as f32
}

/// A colour that was multiplied by its opacity, without that.
pub fn straight([r, g, b]: [f32; 3], opacity: f32) -> [f32; 4] {
    match opacity > LEAST {
        true => [r / opacity, g / opacity, b / opacity, opacity],
        false => [0.0, 0.0, 0.0, opacity],
    }
}

/// The picture in linear radiance of a film with opacity: of the sums of rectangles (x, y, width, height) of pixels. Pixels
/// without samples are transparent.
pub fn picture<S: Borrow<Sums>>(
    region: [u32; 4],
    layers: &[&Layer],
    patches: impl IntoIterator<Item = ([u32; 4], S)>,
) -> Option<Image> {
    let place = layers::row_of(layers, &layers::OPACITY)?;
    let [.., width, height] = region;
    let mut image = Image {
        width,
        height,
        pixels: vec![[0.0; 4]; width as usize * height as usize],
    };
    for (patch, sums) in patches {
        let sums = (sums.borrow(), layers::pixel_rows(layers));
        fill_rectangle(&mut image.pixels, region, patch, sums, |rows| {
            let weight = rows[0][3];
            let mean = [0, 1, 2].map(|channel| (rows[0][channel] / weight).max(0.0) as f32);
            straight(mean, opacity(weight, &rows[place..]))
        });
    }
    Some(image)
}

impl Renderer {
    /// The light on the shadow catchers of the picture so far; none if it shows none.
    ///
    /// # Errors
    /// The device failed.
    pub async fn catcher_light_async(&mut self) -> Result<CatcherLight, RenderError> {
        let mut light = CatcherLight::default();
        if !(self.settings.has_opacity() && self.scene.features.shadow_catchers) {
            return Ok(light);
        }
        self.fetch_film().await?;
        let layers = layers::of_pictures(&self.settings);
        let Some(place) = layers::row_of(layers, &layers::OPACITY) else {
            return Ok(light);
        };
        let rows = layers::pixel_rows(layers);
        let mut pixel = Vec::new();
        for ([.., width, height], sums) in self.tiles.sums(layers) {
            for index in 0..width as usize * height as usize {
                sums.round_pixel(index, rows, &mut pixel);
                let [kept, _, removed, _] = pixel[place + 1];
                light += CatcherLight { kept, removed };
            }
        }
        Ok(light)
    }

    /// The picture so far in linear radiance, if it has opacity.
    pub(super) async fn transparent_picture(&mut self) -> Result<Option<Image>, RenderError> {
        if !self.settings.has_opacity() {
            return Ok(None);
        }
        self.fetch_film().await?;
        let layers = layers::of_pictures(&self.settings);
        let sums = self.tiles.sums(layers);
        Ok(picture(self.settings.region(), layers, sums))
    }
}
