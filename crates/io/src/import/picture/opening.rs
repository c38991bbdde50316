//! Opens image files. This is the one place that knows what the numbers of each format mean:
//!
//! | format | numbers | alpha | colours |
//! |---|---|---|---|
//! | PNG, JPEG, WebP, KTX2 | codes of sRGB | not multiplied into colours | those of sRGB, whatever their profile is |
//! | OpenEXR | light | multiplied into colours | those of its chromaticities, or Rec. 709 |
//! | Radiance HDR | light, times its exposure | none | those of its primaries, or Rec. 709; XYZ |
//!
//! [`Opened::ignored`] has the properties of a file that its picture does not follow.

#[cfg(feature = "basis")]
use super::ktx2;
use super::opened::{Opened, Unfit, Values};
use super::{KINDS, Refused, complete, openexr, profile, radiance};
use glam::Vec4;
use image::{
    ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, ImageResult, Limits, RgbaImage,
};
use std::io::Cursor;

/// The header of an image.
pub(super) struct Head {
    pub width: u32,
    pub height: u32,
    /// Whether its texels become floats.
    pub has_floats: bool,
    /// The decoder of a format that `image` does not have.
    special: Option<Special>,
}

enum Special {
    OpenExr(Box<openexr::Head>),
    Radiance(radiance::Head),
    #[cfg(feature = "basis")]
    Ktx2,
}

/// A reader of the formats of `image`, unless it does not know this one.
fn reader(bytes: &[u8]) -> Option<ImageReader<Cursor<&[u8]>>> {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    reader.ok().filter(|reader| reader.format().is_some())
}

/// Reads the header of the image in `bytes`, and checks that these can hold what it announces.
///
/// # Errors
/// The image is invalid or of an unsupported kind, or announces too many texels.
pub(super) fn head(bytes: &[u8], unfit: &Unfit) -> Result<Head, Refused> {
    if bytes.is_empty() {
        return Err(unfit.damaged("is empty"));
    }
    #[cfg(feature = "basis")]
    if bytes.starts_with(ktx2::MAGIC) {
        let (width, height) = ktx2::dimensions(bytes).map_err(|fault| fault.of(unfit))?;
        unfit.count(width, height)?;
        return Ok(Head {
            width,
            height,
            has_floats: false,
            special: Some(Special::Ktx2),
        });
    }
    let (format, special) = if bytes.starts_with(openexr::MAGIC) {
        let head = openexr::head(bytes, unfit)?;
        let special = Special::OpenExr(Box::new(head));
        (ImageFormat::OpenExr, Some(special))
    } else if bytes.starts_with(radiance::MAGIC) {
        let special = Special::Radiance(radiance::head(bytes, unfit)?);
        (ImageFormat::Hdr, Some(special))
    } else {
        let Some(format) = reader(bytes).and_then(|reader| reader.format()) else {
            let todo = format!("Name a {KINDS} file");
            return Err(unfit.as_it_is("is not a supported image", &todo));
        };
        (format, None)
    };
    let head = match special {
        Some(special) => {
            let [width, height] = special.size();
            Head {
                width,
                height,
                has_floats: true,
                special: Some(special),
            }
        }
        None => {
            let decoder = reader(bytes).map(ImageReader::into_decoder);
            let decoder = decoder.ok_or_else(|| unfit.damaged("is damaged"))?;
            let decoder = decoder.map_err(|error| unfit.explain(error))?;
            let (width, height) = decoder.dimensions();
            let color = decoder.color_type();
            Head {
                width,
                height,
                has_floats: color.bytes_per_pixel() > color.channel_count(),
                special: None,
            }
        }
    };
    let mut stored = unfit.count(head.width, head.height)?;
    if let Some(Special::OpenExr(head)) = &head.special {
        let [width, height] = head.stored_size();
        stored = unfit.count(width, height)?;
    }
    complete::check(format, bytes, stored).map_err(|why| unfit.damaged(&why))?;
    Ok(head)
}

impl Special {
    /// Width and height of the picture in texels.
    fn size(&self) -> [u32; 2] {
        match self {
            Self::OpenExr(head) => head.size(),
            Self::Radiance(head) => head.size(),
            #[cfg(feature = "basis")]
            Self::Ktx2 => [0; 2],
        }
    }
}

/// The image in `bytes`, whose header is `head`.
///
/// # Errors
/// The image is damaged, or takes too much memory.
pub(super) fn open(bytes: &[u8], head: Head, unfit: &Unfit) -> Result<Opened, Refused> {
    let (width, height) = (head.width, head.height);
    let codes = |image: DynamicImage, has_alpha, ignored| Opened {
        width,
        height,
        has_alpha,
        values: Values::Codes(image),
        is_premultiplied: false,
        rec709_from_own: None,
        ignored,
    };
    match head.special {
        Some(Special::OpenExr(head)) => openexr::open(bytes, *head, unfit),
        Some(Special::Radiance(head)) => radiance::open(bytes, head, unfit),
        #[cfg(feature = "basis")]
        Some(Special::Ktx2) => {
            let image = ktx2::decode(bytes, (width, height)).map_err(|fault| fault.of(unfit))?;
            let has_alpha = image.color().has_alpha();
            Ok(codes(image, has_alpha, ktx2::ignored(bytes)))
        }
        None => {
            let gone = || unfit.damaged("is damaged");
            let mut reader = reader(bytes).ok_or_else(gone)?;
            let format = reader.format().ok_or_else(gone)?;
            let mut limits = Limits::no_limits();
            limits.max_alloc = Some(unfit.most_texels * size_of::<Vec4>() as u64);
            reader.limits(limits);
            let explain = |error| unfit.explain(error);
            let mut decoder = reader.into_decoder().map_err(explain)?;
            let ignored = profile::ignored(bytes, format, &mut decoder);
            let has_alpha = decoder.color_type().has_alpha();
            let image = match decoder.color_type() {
                ColorType::Rgb8 => with_alpha(decoder),
                _ => DynamicImage::from_decoder(decoder),
            };
            Ok(codes(image.map_err(explain)?, has_alpha, ignored))
        }
    }
}

/// The image of red, green and blue, with full alpha. Its colours are decoded to the end of their memory and then spread
/// over it, so that a large picture is not in memory twice.
fn with_alpha(decoder: impl ImageDecoder) -> ImageResult<DynamicImage> {
    let (width, height) = decoder.dimensions();
    let count = width as usize * height as usize;
    let mut bytes = vec![0; 4 * count];
    decoder.read_image(&mut bytes[count..])?;
    let texels = &mut bytes[..];
    let (mut from, mut to) = (count, 0);
    while to < texels.len() {
        let [r, g, b] = [texels[from], texels[from + 1], texels[from + 2]];
        texels[to] = r;
        texels[to + 1] = g;
        texels[to + 2] = b;
        texels[to + 3] = u8::MAX;
        (from, to) = (from + 3, to + 4);
    }
    let image = RgbaImage::from_raw(width, height, bytes);
    Ok(image.unwrap_or_default().into())
}
