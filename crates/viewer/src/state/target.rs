//! Where a picture is written.

use glimray_io::output::Format;
use std::path::PathBuf;

/// The target of a saved picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The file.
    pub path: PathBuf,
    /// The format, from the extension.
    pub format: Format,
    /// JPEG quality, 1 to 100.
    pub quality: u8,
    /// Whether an existing file may be replaced.
    pub replaces: bool,
    /// Whether the picture has opacity, whatever its pixels are.
    pub opacity: bool,
}
