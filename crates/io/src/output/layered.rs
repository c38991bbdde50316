//! Pictures of several layers in one OpenEXR file.

use super::{OutputError, Place, SaveOptions, atomic};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, Text, Vec2, WritableImage,
};
use glimray_scene::image::Image as Picture;
use half::f16;
use std::io::{Cursor, Write};
use std::path::Path;

/// A picture of several layers.
#[derive(Clone, Debug, PartialEq)]
pub struct LayeredImage {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// The layers, with distinct names.
    pub layers: Vec<ImageLayer>,
    /// Whether each layer becomes a part of its own. Otherwise all channels are in one part, which more programs read.
    pub in_parts: bool,
}

/// A layer of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageLayer {
    /// Name of the layer; empty for channels without a prefix.
    pub name: &'static str,
    /// Channels of the layer.
    pub channels: Vec<Channel>,
}

/// A channel of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name of the channel within the layer, such as `R`.
    pub name: &'static str,
    /// Values of the channel: row by row from the top left.
    pub values: Vec<f32>,
    /// Whether they may be stored as half floats: they are if no value of the layer is beyond the range of those, and otherwise
    /// as 32-bit floats.
    pub is_half: bool,
}

/// The name of a nameless layer that is a part of its own.
const NAMELESS: &str = "beauty";

/// Writes a picture to an OpenEXR file.
///
/// # Errors
/// The errors of [`super::save_with`].
pub fn save_layers(
    path: impl AsRef<Path>,
    image: &LayeredImage,
    options: &SaveOptions,
) -> Result<(), OutputError> {
    let bytes = encode(image, options.place)?;
    atomic::write(path.as_ref(), &bytes, options.clobber, options.follow_links)
}

/// Writes a picture to standard output.
///
/// # Errors
/// The errors of [`super::save_to_stdout`].
pub fn save_layers_to_stdout(
    image: &LayeredImage,
    options: &SaveOptions,
) -> Result<(), OutputError> {
    let bytes = encode(image, options.place)?;
    let mut stdout = std::io::stdout().lock();
    (stdout.write_all(&bytes))
        .and_then(|()| stdout.flush())
        .map_err(|source| OutputError::Stdout { source })
}

impl ImageLayer {
    /// Whether its values are in the range of half floats.
    fn fits_half(&self) -> bool {
        let values = self.channels.iter().flat_map(|channel| &channel.values);
        let mut finite = values.filter(|value| value.is_finite());
        finite.all(|value| value.abs() <= f16::MAX.to_f32())
    }

    /// A layer of colours, multiplied by their opacity if it has that, as OpenEXR asks.
    pub fn color(name: &'static str, image: &Picture, opacity: bool, is_half: bool) -> Self {
        let names: &[&str] = match opacity {
            true => &["R", "G", "B", "A"],
            false => &["R", "G", "B"],
        };
        let channel = |(index, name): (usize, &&'static str)| Channel {
            name,
            values: image.premultiplied().map(|pixel| pixel[index]).collect(),
            is_half,
        };
        Self {
            name,
            channels: names.iter().enumerate().map(channel).collect(),
        }
    }
}

/// An image of one layer in 32-bit floats, with opacity if that is asked for or some pixel is not opaque.
pub(super) fn plain(image: &Picture, opacity: bool) -> LayeredImage {
    let opacity = opacity || !image.is_opaque();
    LayeredImage {
        width: image.width,
        height: image.height,
        layers: vec![ImageLayer::color("", image, opacity, false)],
        in_parts: false,
    }
}

/// The contents of the file. Its data window is the place of the image, its display window the larger image.
pub(super) fn encode(image: &LayeredImage, place: Option<Place>) -> Result<Vec<u8>, OutputError> {
    let count = image.width as usize * image.height as usize;
    let channels = image.layers.iter().flat_map(|layer| &layer.channels);
    for channel in channels {
        if channel.values.len() != count {
            return Err(OutputError::Misshapen {
                width: image.width,
                height: image.height,
                pixel_count: channel.values.len(),
            });
        }
    }
    let size = Vec2(image.width as usize, image.height as usize);
    let part = |name: Option<&str>, channels: Vec<AnyChannel<FlatSamples>>| {
        let attributes = LayerAttributes {
            layer_name: name.map(Text::from),
            layer_position: place.map_or(Vec2(0, 0), |it| {
                Vec2(it.corner.0 as i32, it.corner.1 as i32)
            }),
            software_name: Some(Text::from("glimray")),
            ..LayerAttributes::default()
        };
        let channels = AnyChannels::sort(channels.into());
        Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels)
    };
    let parts: Vec<_> = match image.in_parts {
        true => (image.layers.iter())
            .map(|layer| {
                let name = if layer.name.is_empty() {
                    NAMELESS
                } else {
                    layer.name
                };
                let fits = layer.fits_half();
                let channels = layer.channels.iter();
                let channels = channels.map(|it| stored(it.name.to_owned(), it, fits));
                part(Some(name), channels.collect())
            })
            .collect(),
        false => {
            let named = |layer: &ImageLayer, channel: &Channel| match layer.name {
                "" => channel.name.to_owned(),
                name => format!("{name}.{}", channel.name),
            };
            let layers = image.layers.iter();
            let channels = layers.flat_map(|layer| {
                let fits = layer.fits_half();
                let channels = layer.channels.iter();
                channels.map(move |channel| stored(named(layer, channel), channel, fits))
            });
            vec![part(None, channels.collect())]
        }
    };
    let whole = place.map_or(size, |it| Vec2(it.whole.0 as usize, it.whole.1 as usize));
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(whole));
    let mut file = Cursor::new(Vec::new());
    Image::from_layers(attributes, parts)
        .write()
        .to_buffered(&mut file)
        .map_err(|source| OutputError::Layers {
            source: source.into(),
        })?;
    Ok(file.into_inner())
}

fn stored(name: String, channel: &Channel, fits_half: bool) -> AnyChannel<FlatSamples> {
    let samples = match channel.is_half && fits_half {
        true => FlatSamples::F16(channel.values.iter().map(|v| f16::from_f32(*v)).collect()),
        false => FlatSamples::F32(channel.values.clone()),
    };
    AnyChannel::new(name.as_str(), samples)
}
