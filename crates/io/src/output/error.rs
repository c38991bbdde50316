//! Why an image or a video could not be written, in one line each.

use super::Format;
use super::video::{FrameRate, VideoFormat};
use glimray_scene::bytes::sizes;
use glimray_scene::text;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be written. The text is `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The file extension is unknown, and no format was given.
    #[error(
        "cannot determine the image format ({}): the extension is none of {}. \
         Choose one of them or name the format.",
        show(path),
        Format::ENDINGS
    )]
    UnknownFormat {
        /// The target.
        path: PathBuf,
    },

    /// The format does not support that size. All figures are pixels.
    #[error(
        "cannot write the image ({width}×{height} pixels): {format} supports at most \
         {max_width}×{max_height}. Choose a smaller size or another format."
    )]
    TooLarge {
        /// The requested format.
        format: Format,
        /// Width of the image.
        width: u32,
        /// Height of the image.
        height: u32,
        /// The format's largest width.
        max_width: u32,
        /// The format's largest height.
        max_height: u32,
    },

    /// The number of pixels does not match the width and height.
    #[error(
        "cannot write the image ({width}×{height} pixels): it has {pixel_count} pixels. \
         Give it as many as its size requires."
    )]
    Misshapen {
        /// Width of the image.
        width: u32,
        /// Height of the image.
        height: u32,
        /// Number of pixels in the image.
        pixel_count: usize,
    },

    /// Layers cannot be encoded.
    #[error("cannot write the layers: {source}. Choose another size or other layers.")]
    Layers {
        /// The encoder's error.
        #[source]
        source: Box<dyn std::error::Error + Send + Sync>,
    },

    /// The name is that of a folder.
    #[error(
        "cannot write the file ({}): it is a folder. Add a file name.",
        show(path)
    )]
    IsFolder {
        /// The folder.
        path: PathBuf,
    },

    /// The folder does not exist.
    #[error(
        "cannot write the file ({}): the folder {} does not exist. Create it first.",
        show(path),
        show(folder)
    )]
    MissingFolder {
        /// The target.
        path: PathBuf,
        /// The missing folder.
        folder: PathBuf,
    },

    /// The file exists and must not be replaced.
    #[error(
        "cannot write the file ({}): it exists and must not be replaced. Choose another name.",
        show(path)
    )]
    Exists {
        /// The file.
        path: PathBuf,
    },

    /// The file exists and is marked read-only.
    #[error(
        "cannot write the file ({}): it is write-protected. Choose another name or make it writable.",
        show(path)
    )]
    Protected {
        /// The file.
        path: PathBuf,
    },

    /// The name was generated, and a symbolic link of that name exists.
    #[error(
        "cannot write the file ({}): it is a symbolic link. Remove the link, or choose \
         another folder.",
        show(path)
    )]
    Link {
        /// The link.
        path: PathBuf,
    },

    /// The operating system refused.
    #[error(
        "cannot write the file ({}): {}. {}",
        show(path),
        reason(source),
        advice(source)
    )]
    Io {
        /// The target.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },

    /// Standard output could not be written.
    #[error(
        "cannot write the image (standard output): {}. {}",
        reason(source),
        advice(source)
    )]
    Stdout {
        /// The system's error.
        source: io::Error,
    },

    /// Writing reported no error, but the file is incomplete.
    #[error(
        "cannot write the file ({}): only {} of {} were written. \
         Check the disk and write to another one.",
        show(path),
        sizes([*found, *expected])[0],
        sizes([*found, *expected])[1]
    )]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// Expected length of the file in bytes.
        expected: u64,
        /// Actual length of the file in bytes.
        found: u64,
    },

    /// The encoder refused the image.
    #[error("cannot write the image ({format}): {source}. Choose another format.")]
    Encode {
        /// The requested format.
        format: Format,
        /// The encoder's error.
        source: ::image::ImageError,
    },

    /// The file extension is not that of a supported video format.
    #[error(
        "cannot determine the video format ({}): the extension is none of {}. \
         Choose one of them.",
        show(path),
        VideoFormat::ENDINGS
    )]
    UnknownVideoFormat {
        /// The target.
        path: PathBuf,
    },

    /// The program was built without the video encoders.
    #[error(
        "cannot write the video ({format}): this program was built without its encoder, cargo \
         feature `video`. Choose .y4m, or numbered images."
    )]
    VideoLeftOut {
        /// The requested format.
        format: VideoFormat,
    },

    /// The format does not support frames of that size. All figures are pixels.
    #[error(
        "cannot write the video ({width}×{height} pixels): {format} supports at most {long}×{short}, \
         or the same in portrait. Choose a smaller size or another format."
    )]
    VideoTooLarge {
        /// The requested format.
        format: VideoFormat,
        /// Width of the frames.
        width: u32,
        /// Height of the frames.
        height: u32,
        /// Limit of the longer side.
        long: u32,
        /// Limit of the shorter side.
        short: u32,
    },

    /// The format does not support that frame rate.
    #[error(
        "cannot write the video ({rate} frames per second): {format} supports {least} to {most}. \
         Choose a rate between them or another format."
    )]
    VideoRate {
        /// The requested format.
        format: VideoFormat,
        /// The requested rate.
        rate: FrameRate,
        /// The lowest supported rate, in frames per second.
        least: f64,
        /// The highest supported rate, in frames per second.
        most: f64,
    },

    /// A frame differs in size from the first one. All figures are pixels.
    #[error(
        "cannot write the video (frame {index}, counted from 0): it has {width}×{height} pixels, \
         but the first one {first_width}×{first_height}. Render it again at that size."
    )]
    FrameSize {
        /// Index of the frame, from 0.
        index: usize,
        /// Width of the frame.
        width: u32,
        /// Height of the frame.
        height: u32,
        /// Width of the first frame.
        first_width: u32,
        /// Height of the first frame.
        first_height: u32,
    },

    /// A frame file could not be read.
    #[error("cannot read the frame ({}): {reason}. Render it again.", show(path))]
    UnreadableFrame {
        /// The frame's file.
        path: PathBuf,
        /// The error of the system or the decoder.
        reason: String,
    },

    /// The encoder refused a frame.
    #[error("cannot write the video ({format}): {reason}. Choose another format.")]
    VideoEncode {
        /// The requested format.
        format: VideoFormat,
        /// The encoder's error.
        reason: String,
    },
}

impl OutputError {
    /// Whether another name, format, size or rate would help.
    pub fn is_usage(&self) -> bool {
        matches!(
            self,
            Self::UnknownFormat { .. }
                | Self::TooLarge { .. }
                | Self::UnknownVideoFormat { .. }
                | Self::VideoLeftOut { .. }
                | Self::VideoTooLarge { .. }
                | Self::VideoRate { .. }
        )
    }

    /// Whether the error concerns a frame file.
    pub fn is_refused_input(&self) -> bool {
        matches!(self, Self::FrameSize { .. } | Self::UnreadableFrame { .. })
    }

    /// Whether it can only be a bug in glimray.
    pub fn is_internal(&self) -> bool {
        matches!(
            self,
            Self::Encode { .. } | Self::Misshapen { .. } | Self::VideoEncode { .. }
        )
    }
}

/// A path for a one-line message: control characters are escaped, so that a file name cannot break the
/// line or control the terminal.
fn show(path: &Path) -> String {
    text::escape(&path.to_string_lossy(), |_| false)
}

/// The system's message without its number, as a clause.
pub fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or_default();
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => "unknown reason".into(),
    }
}

fn advice(error: &io::Error) -> &'static str {
    use io::ErrorKind::*;
    match error.kind() {
        StorageFull | QuotaExceeded => "Free some space or choose another disk.",
        FileTooLarge => "Raise the file size limit (`ulimit -f`), or write a smaller file.",
        PermissionDenied | ReadOnlyFilesystem => "Choose a folder that you may write to.",
        InvalidFilename | InvalidInput | NotADirectory => "Choose another name.",
        BrokenPipe => "Keep the reading program running until the end of the output.",
        _ => "Choose another location.",
    }
}
