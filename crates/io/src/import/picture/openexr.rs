//! OpenEXR: which channels of which part are the picture, and what their numbers mean.
//!
//! The picture is the display window; what is stored beyond it is not shown, and what is not stored in it is black. Colours
//! are multiplied by alpha. They are those of the nameless layer, or of the first that has some. Sources: Technical
//! Introduction to OpenEXR; OpenEXR File Layout.

use super::opened::{Ignored, Opened, Unfit, Values};
use super::primaries::{self, Primaries};
use super::{Refused, clause};
use crate::import::source::quote;
use exr::image::read::layers::ReadChannels;
use exr::meta::{MetaData, header::Header};
use exr::prelude::{ReadLayers, ReadSpecificChannel, Text, Vec2};
use glam::Vec4;
use std::io::Cursor;

/// The first bytes of each file.
pub(super) const MAGIC: &[u8] = b"\x76\x2f\x31\x01";

/// The name of no channel.
const NONE: &str = "\u{1}";

/// The part and the channels that have the picture of a file.
pub(super) struct Head {
    /// The part that has it.
    part: Header,
    layer: Layer,
}

/// The channels of a picture in one part of a file.
#[derive(Clone)]
struct Layer {
    /// The beginning of their names.
    prefix: Vec<u8>,
    colors: Colors,
    alpha: Option<Text>,
}

#[derive(Clone)]
enum Colors {
    /// Red, green and blue.
    Rgb([Text; 3]),
    /// Luminance, or the only channel.
    Grey(Text),
}

impl Head {
    /// Width and height of the display window.
    pub fn size(&self) -> [u32; 2] {
        size(self.part.shared_attributes.display_window.size)
    }

    /// Width and height of what is stored.
    pub fn stored_size(&self) -> [u32; 2] {
        size(self.part.layer_size)
    }
}

fn size(size: Vec2<usize>) -> [u32; 2] {
    [size.x(), size.y()].map(|side| u32::try_from(side).unwrap_or(u32::MAX))
}

/// Finds the picture in a file.
///
/// # Errors
/// The header is invalid, or no layer is a picture.
pub(super) fn head(bytes: &[u8], unfit: &Unfit) -> Result<Head, Refused> {
    let data = MetaData::read_from_buffered(Cursor::new(bytes), false)
        .map_err(|error| unfit.damaged(&format!("is damaged: {}", clause(&error.to_string()))))?;
    let flat = || data.headers.iter().filter(|part| !part.deep);
    if flat().next().is_none() {
        let todo = "Flatten it";
        return Err(unfit.as_it_is("has deep data alone, which is not supported", todo));
    }
    let layers = flat().flat_map(|part| layers(part).into_iter().map(move |layer| (part, layer)));
    let Some((part, layer)) = layers.min_by_key(|(_, layer)| layer.rank()) else {
        let channels = flat().flat_map(|part| &part.channels.list);
        let names: Vec<String> = (channels.take(8))
            .map(|channel| quote(channel.name.bytes()))
            .collect();
        let why = format!("has no channels R, G and B, but {}", names.join(", "));
        let todo = "Save it with R, G and B, or with a single channel for a grey picture";
        return Err(unfit.as_it_is(&why, todo));
    };
    if (part.channels.list.iter()).any(|channel| channel.sampling != Vec2(1, 1)) {
        let todo = "Save it with all channels in full resolution";
        return Err(unfit.as_it_is("has channels of a lower resolution than others", todo));
    }
    Ok(Head {
        part: part.clone(),
        layer,
    })
}

/// The pictures in the channels of a part.
fn layers(part: &Header) -> Vec<Layer> {
    let names = || part.channels.list.iter().map(|channel| &channel.name);
    let split = |name: &Text| {
        let end = name.bytes().iter().rposition(|&byte| byte == b'.');
        let end = end.map_or(0, |dot| dot + 1);
        (name.bytes()[..end].to_vec(), name.bytes()[end..].to_vec())
    };
    let mut prefixes: Vec<Vec<u8>> = names().map(|name| split(name).0).collect();
    prefixes.dedup();
    let layer = |prefix: Vec<u8>| {
        let own = || names().filter(|name| split(name).0 == prefix);
        let named = |end: &str| own().find(|name| split(name).1 == end.as_bytes()).cloned();
        let alpha = named("A");
        let mut rest = own().filter(|name| Some(*name) != alpha.as_ref());
        let colors = match (named("R"), named("G"), named("B"), named("Y")) {
            (Some(r), Some(g), Some(b), _) => Colors::Rgb([r, g, b]),
            // Y of colour differences or of a vector is no picture.
            (.., Some(y)) if ["RY", "BY", "X"].iter().all(|end| named(end).is_none()) => {
                Colors::Grey(y)
            }
            _ => match (rest.next(), rest.next()) {
                (Some(only), None) => Colors::Grey(only.clone()),
                _ => return None,
            },
        };
        Some(Layer {
            prefix,
            colors,
            alpha,
        })
    };
    prefixes.into_iter().filter_map(layer).collect()
}

impl Layer {
    /// How likely it is not the picture that other programs show.
    fn rank(&self) -> u32 {
        match (&self.colors, self.prefix.is_empty()) {
            (Colors::Rgb(_), true) => 0,
            (Colors::Grey(name), true) if name.eq("Y") => 1,
            (Colors::Rgb(_), false) => 2,
            (Colors::Grey(_), _) => 3,
        }
    }
}

/// Reads channels of one part only.
struct OfPart<R> {
    part: Header,
    read: R,
}

impl<'s, R: ReadChannels<'s>> ReadChannels<'s> for OfPart<R> {
    type Reader = R::Reader;

    fn create_channels_reader(&'s self, header: &Header) -> exr::error::Result<Self::Reader> {
        match *header == self.part {
            true => self.read.create_channels_reader(header),
            false => Err(exr::error::Error::Invalid("another part".into())),
        }
    }
}

/// The picture of a file with this header.
///
/// # Errors
/// The file is damaged.
pub(super) fn open(bytes: &[u8], head: Head, unfit: &Unfit) -> Result<Opened, Refused> {
    let Head { part, layer } = &head;
    let [width, height] = head.size();
    let corner =
        part.own_attributes.layer_position - part.shared_attributes.display_window.position;
    let empty = match layer.alpha {
        Some(_) => Vec4::ZERO,
        None => Vec4::W,
    };
    let count = width as usize * height as usize;
    let put = move |texels: &mut Vec<Vec4>, at: Vec2<usize>, texel: Vec4| {
        let place = |at: usize, corner: i32, side: u32| {
            let place = u32::try_from(at as i64 + i64::from(corner)).ok()?;
            (place < side).then_some(place as usize)
        };
        let (x, y) = (
            place(at.x(), corner.x(), width),
            place(at.y(), corner.y(), height),
        );
        if let (Some(x), Some(y)) = (x, y) {
            texels[y * width as usize + x] = texel;
        }
    };
    let alpha = layer.alpha.clone().unwrap_or_else(|| NONE.into());
    let channels = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels();
    let file = Cursor::new(bytes);
    macro_rules! texels {
        ($read:expr) => {{
            let part = part.clone();
            let read = OfPart { part, read: $read };
            let read = read.first_valid_layer().all_attributes();
            let image = read.non_parallel().from_buffered(file);
            image.map(|image| image.layer_data.channel_data.pixels)
        }};
    }
    let texels = match layer.colors.clone() {
        Colors::Rgb([r, g, b]) => texels!(
            (channels
                .required(r)
                .required(g)
                .required(b)
                .optional(alpha, 1.0))
            .collect_pixels(
                move |_, _| vec![empty; count],
                move |texels, at, (r, g, b, a): (f32, f32, f32, f32)| {
                    put(texels, at, Vec4::new(r, g, b, a));
                },
            )
        ),
        Colors::Grey(grey) => texels!(
            (channels.required(grey).optional(alpha, 1.0)).collect_pixels(
                move |_, _| vec![empty; count],
                move |texels, at, (grey, a): (f32, f32)| {
                    put(texels, at, Vec4::new(grey, grey, grey, a));
                },
            )
        ),
    };
    let texels = texels
        .map_err(|error| unfit.damaged(&format!("is damaged: {}", clause(&error.to_string()))))?;
    let mut ignored = ignored(part, layer);
    let rec709_from_own = match (part.shared_attributes.chromaticities, &layer.colors) {
        (Some(own), Colors::Rgb(_)) => {
            let point = |point: Vec2<f32>| [f64::from(point.x()), f64::from(point.y())].into();
            let own = Primaries {
                red: point(own.red),
                green: point(own.green),
                blue: point(own.blue),
                white: point(own.white),
            };
            primaries::rec709_from(own, "chromaticities", &mut ignored)
        }
        _ => None,
    };
    Ok(Opened {
        width,
        height,
        values: Values::Floats(texels),
        has_alpha: layer.alpha.is_some(),
        is_premultiplied: layer.alpha.is_some(),
        rec709_from_own,
        ignored,
    })
}

/// Properties of a part that its picture does not follow.
fn ignored(part: &Header, layer: &Layer) -> Vec<Ignored> {
    let mut ignored = Vec::new();
    let mut add = |clause: String, is_of_colors| {
        ignored.push(Ignored {
            clause,
            is_of_colors,
        });
    };
    if let [name @ .., _] = &layer.prefix[..] {
        let name = quote(name);
        add(
            format!("has no nameless layer: the layer {name} is shown"),
            false,
        );
    }
    let aspect = part.shared_attributes.pixel_aspect;
    if (aspect - 1.0).abs() > 1e-3 {
        add(
            format!("has pixels {aspect} times as wide as high, which are shown as squares"),
            false,
        );
    }
    if part.own_attributes.adopted_neutral.is_some() {
        add(
            "names a neutral colour, which is not applied".to_owned(),
            true,
        );
    }
    ignored
}
