//! OpenEXR files without colours: those of luminance alone are read as grey, of others it is said what they have.

use super::{Refused, Unfit, complete};
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, Text};
use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage};
use std::io::Cursor;

/// The first bytes of an OpenEXR file.
const MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// The grey image in `bytes` if they are an OpenEXR file without red, green and blue; otherwise `None`.
///
/// # Errors
/// It has neither colours nor luminance, or is damaged or too large.
pub(super) fn open(bytes: &[u8], unfit: &Unfit) -> Option<Result<DynamicImage, Refused>> {
    if !bytes.starts_with(MAGIC) {
        return None;
    }
    let parts = MetaData::read_from_buffered(Cursor::new(bytes), false).ok()?;
    let has = |name: &str| {
        let name = Text::from(name);
        let mut parts = parts.headers.iter();
        parts.any(|part| part.channels.find_index_of_channel(&name).is_some())
    };
    if has("R") && has("G") && has("B") {
        return None;
    }
    match &parts.headers[..] {
        [part] if has("Y") && !has("RY") && !has("BY") && !part.deep => {
            Some(grey(bytes, part, unfit))
        }
        parts => {
            let channels = parts.iter().flat_map(|part| &part.channels.list);
            let names: Vec<String> = (channels.take(8))
                .map(|channel| crate::import::source::quote(channel.name.to_string().as_bytes()))
                .collect();
            let why = format!("has no channels R, G and B, but {}", names.join(", "));
            let todo = "Save it with R, G and B, or with Y alone for a grey picture";
            Some(Err(unfit.as_it_is(&why, todo)))
        }
    }
}

/// The channel Y of the only part of a file as a grey image.
fn grey(
    bytes: &[u8],
    part: &exr::meta::header::Header,
    unfit: &Unfit,
) -> Result<DynamicImage, Refused> {
    let damaged = |why: &str| unfit.damaged(&format!("is damaged: {}", super::clause(why)));
    let window = part.shared_attributes.display_window;
    let size = |size: usize| u32::try_from(size).unwrap_or(u32::MAX);
    let (width, height) = (size(window.size.width()), size(window.size.height()));
    let count = unfit.count(width, height)?;
    let stored = unfit.count(
        size(part.layer_size.width()),
        size(part.layer_size.height()),
    )?;
    complete::check(ImageFormat::OpenExr, bytes, count.max(stored))
        .map_err(|why| unfit.damaged(&why))?;
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level();
    let read = read.all_channels().first_valid_layer().all_attributes();
    let image = read.non_parallel().from_buffered(Cursor::new(bytes));
    let layer = image
        .map_err(|error| damaged(&error.to_string()))?
        .layer_data;
    let mut channels = layer.channel_data.list.iter();
    let channel = channels.find(|channel| channel.name == *"Y");
    let Some(channel) = channel.filter(|channel| channel.sampling.area() == 1) else {
        return Err(damaged("its channel Y is not as large as the picture"));
    };
    // The stored part of the picture may be larger or smaller than what is shown of it; the rest is black.
    let corner = layer.attributes.layer_position - window.position;
    let mut grey = Rgb32FImage::new(width, height);
    let columns = layer.size.width();
    for (index, value) in channel.sample_data.values_as_f32().enumerate() {
        let place = |at: usize, corner: i32| u32::try_from(at as i64 + i64::from(corner));
        let x = place(index % columns, corner.x());
        let y = place(index / columns, corner.y());
        if let (Ok(x), Ok(y)) = (x, y)
            && let Some(pixel) = grey.get_pixel_mut_checked(x, y)
        {
            *pixel = Rgb([value; 3]);
        }
    }
    Ok(DynamicImage::ImageRgb32F(grey))
}
