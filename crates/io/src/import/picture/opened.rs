//! Images as their files have them, and what their numbers mean.

use super::{KINDS, Refused, clause};
use crate::import::ImportError;
use glam::{Mat3, Vec3, Vec4};
use image::{DynamicImage, ImageError};

/// An image as its file has it.
pub(super) struct Opened {
    pub width: u32,
    pub height: u32,
    pub values: Values,
    pub has_alpha: bool,
    /// Whether its colours were multiplied by alpha.
    pub is_premultiplied: bool,
    /// From its colours to linear Rec. 709, unless they are that.
    pub rec709_from_own: Option<Mat3>,
    /// Properties of the file that its picture does not follow.
    pub ignored: Vec<Ignored>,
}

/// The values of an image, row by row from the top left.
pub(super) enum Values {
    /// Codes of 8 or 16 bits.
    Codes(DynamicImage),
    /// Light. Alpha is 1 if there is none.
    Floats(Vec<Vec4>),
}

/// Something that a file says and its picture does not follow.
pub(super) struct Ignored {
    /// A clause that follows the name of the file.
    pub clause: String,
    /// Whether it is about colours, so that numbers do not depend on it.
    pub is_of_colors: bool,
}

impl Opened {
    /// A texel with light in linear Rec. 709, not multiplied by alpha.
    pub fn straight(&self, texel: Vec4) -> Vec4 {
        let divisor = match self.is_premultiplied && texel.w > 0.0 {
            true => texel.w.min(1.0),
            // Without alpha there is no colour, only light that is added.
            false => 1.0,
        };
        (self.rec709(texel.truncate()) / divisor).extend(texel.w)
    }

    /// Light in linear Rec. 709. What is outside of its gamut has negative values.
    pub fn rec709(&self, color: Vec3) -> Vec3 {
        self.rec709_from_own.map_or(color, |matrix| matrix * color)
    }
}

/// Makes errors about the image in a file.
pub(super) struct Unfit<'n> {
    /// Name of the image in messages.
    pub name: &'n str,
    /// The number of texels that it may have.
    pub most_texels: u64,
}

impl Unfit<'_> {
    pub fn as_it_is(&self, why: &str, todo: &str) -> Refused {
        Refused::Unfit {
            kind: ImportError::Malformed,
            why: format!("{} {why}", self.name),
            todo: todo.to_owned(),
        }
    }

    fn too_big(&self, why: &str) -> Refused {
        Refused::too_big(format!("{} {why}", self.name))
    }

    pub fn damaged(&self, why: &str) -> Refused {
        self.as_it_is(why, "Check that it was written completely")
    }

    pub fn unsupported(&self, why: &str) -> Refused {
        self.as_it_is(why, &format!("Save it as {KINDS}"))
    }

    /// The number of texels of a picture of this size.
    pub fn count(&self, width: u32, height: u32) -> Result<u64, Refused> {
        match u64::from(width) * u64::from(height) {
            0 => Err(self.as_it_is("has no texels", "Save it again")),
            count if count > self.most_texels => Err(self.too_big(&format!(
                "has {width} × {height} texels, but the limit is {} of them",
                self.most_texels
            ))),
            count => Ok(count),
        }
    }

    pub fn explain(&self, error: ImageError) -> Refused {
        match error {
            ImageError::Limits(_) => self.too_big("takes too much memory to decode"),
            ImageError::Unsupported(_) => self.unsupported("is an image of an unsupported kind"),
            error => self.damaged(&format!("is damaged: {}", clause(&error.to_string()))),
        }
    }
}
