//! Image file formats and their limits.

use super::OutputError;
use std::fmt;
use std::path::Path;

/// An image file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// 8 bits per channel, lossless.
    Png,
    /// 8 bits per channel, lossy, without opacity.
    Jpeg,
    /// OpenEXR, 32-bit float.
    Exr,
    /// Radiance RGBE, about 8 bits of precision at any brightness, without opacity and negative values.
    Hdr,
}

impl Format {
    /// The extensions that [`Format::from_path`] knows, for messages.
    pub const ENDINGS: &str = ".png, .jpg, .jpeg, .exr, .hdr";

    /// The format of the extension of `path`, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "png" => Some(Self::Png),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            "exr" => Some(Self::Exr),
            "hdr" => Some(Self::Hdr),
            _ => None,
        }
    }

    /// Whether it stores linear light of any brightness rather than display values in [0, 1].
    pub fn is_linear(self) -> bool {
        matches!(self, Self::Exr | Self::Hdr)
    }

    /// Whether it stores the opacity of pixels.
    pub fn has_opacity(self) -> bool {
        matches!(self, Self::Png | Self::Exr)
    }

    /// Whether it stores several layers.
    pub fn has_layers(self) -> bool {
        self == Self::Exr
    }

    /// Refuses images that exceed the format's limits.
    pub(super) fn check_size(self, width: u32, height: u32) -> Result<(), OutputError> {
        let (max_width, max_height) = self.max_size();
        if width <= max_width && height <= max_height {
            return Ok(());
        }
        Err(OutputError::TooLarge {
            format: self,
            width,
            height,
            max_width,
            max_height,
        })
    }

    /// Largest width and height in pixels.
    fn max_size(self) -> (u32, u32) {
        let signed = i32::MAX as u32;
        match self {
            Self::Png | Self::Exr => (signed, signed),
            Self::Jpeg => (0xFFFF, 0xFFFF),
            // Run-length encoded lines have a 15-bit length.
            Self::Hdr => (0x7FFF, signed),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Exr => "OpenEXR",
            Self::Hdr => "Radiance HDR",
        })
    }
}
