//! Small copies of the pictures of textures, for egui.

use eframe::egui::{self, Color32, ColorImage, Context, TextureHandle, TextureOptions};
use glimray_scene::image::ScreenImage;
use glimray_scene::{Picture, SrgbCurve};
use std::sync::{Arc, Weak};

/// The texture of a small picture that stays as long as the window. `image` makes the picture the first time; without one there
/// is no texture.
pub fn kept(
    ctx: &Context,
    id: egui::Id,
    image: impl FnOnce() -> Option<ColorImage>,
) -> Option<TextureHandle> {
    let known: Option<Option<TextureHandle>> = ctx.data(|data| data.get_temp(id));
    known.unwrap_or_else(|| {
        let load = |image| ctx.load_texture("small picture", image, TextureOptions::LINEAR);
        let texture = image().map(load);
        ctx.data_mut(|data| data.insert_temp(id, texture.clone()));
        texture
    })
}

/// Lets go of a texture of [`kept`].
pub fn forget(ctx: &Context, id: egui::Id) {
    ctx.data_mut(|data| data.remove::<Option<TextureHandle>>(id));
}

/// A picture for egui.
pub fn color_image(picture: &ScreenImage) -> ColorImage {
    let size = [picture.width as usize, picture.height as usize];
    ColorImage::from_rgba_premultiplied(size, picture.pixels.as_flattened())
}

/// Length of the longer side in texels.
const SIDE: u32 = 64;
/// Samples of the picture per texel and axis.
const SAMPLES: u32 = 2;

/// The thumbnails that were asked for, of pictures that still exist.
#[derive(Default)]
pub struct Thumbnails {
    known: Vec<(Weak<Picture>, TextureHandle)>,
}

impl Thumbnails {
    /// The thumbnail of a picture, which is made the first time.
    pub fn of(&mut self, ctx: &Context, picture: &Arc<Picture>) -> &TextureHandle {
        let is_it = |(known, _): &(Weak<Picture>, _)| known.as_ptr() == Arc::as_ptr(picture);
        let index = match self.known.iter().position(is_it) {
            Some(index) => index,
            None => {
                self.known.retain(|(picture, _)| picture.strong_count() > 0);
                let image = small(picture);
                let texture = ctx.load_texture("thumbnail", image, TextureOptions::LINEAR);
                self.known.push((Arc::downgrade(picture), texture));
                self.known.len() - 1
            }
        };
        &self.known[index].1
    }
}

/// A small copy over a checkerboard where the picture is transparent.
fn small(picture: &Picture) -> ColorImage {
    let longest = picture.width.max(picture.height);
    let side = |length: u32| (length * SIDE / longest.max(1)).clamp(1, length.max(1));
    let (width, height) = (side(picture.width), side(picture.height));
    let curve = SrgbCurve::default();
    let texel = |x: u32, y: u32| {
        let mut sum = glam::Vec4::ZERO;
        for sample in 0..SAMPLES * SAMPLES {
            let place = |at: u32, part: u32, size: u32, length: u32| {
                let steps = u64::from(size * SAMPLES);
                (u64::from(at * SAMPLES + part) * u64::from(length) / steps) as usize
            };
            let column = place(x, sample % SAMPLES, width, picture.width);
            let row = place(y, sample / SAMPLES, height, picture.height);
            let index = row * picture.width as usize + column;
            sum += picture.texels.linear(&curve, index);
        }
        let mean = sum / (SAMPLES * SAMPLES) as f32;
        let ground = if (x / 8 + y / 8).is_multiple_of(2) {
            0.5
        } else {
            0.25
        };
        let over = mean.truncate() * mean.w + ground * (1.0 - mean.w);
        let [r, g, b] = over.to_array().map(|channel| channel.clamp(0.0, 1.0));
        Color32::from(egui::Rgba::from_rgb(r, g, b))
    };
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = rows.map(|(x, y)| texel(x, y)).collect();
    ColorImage::new([width as usize, height as usize], pixels)
}
