//! Why a picture or a video could not be written, in one line each.

use super::Format;
use super::video::{FrameRate, VideoFormat};
use std::io;
use std::path::{Path, PathBuf};

/// What keeps a file from being written. The text is `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The name's ending says nothing known, and no format was given.
    #[error(
        "cannot tell the picture format ({}): the name has none of the endings {}. \
         Choose one of them or name the format.",
        show(path),
        Format::ENDINGS
    )]
    UnknownFormat {
        /// Where the picture was to go.
        path: PathBuf,
    },

    /// The format cannot count that many pixels. All figures are pixels.
    #[error(
        "cannot write the picture ({width}×{height} pixels): {format} holds at most \
         {max_width}×{max_height}. Choose a smaller size or another format."
    )]
    TooLarge {
        /// The format asked for.
        format: Format,
        /// The picture's width.
        width: u32,
        /// The picture's height.
        height: u32,
        /// The format's greatest width.
        max_width: u32,
        /// The format's greatest height.
        max_height: u32,
    },

    /// The picture has not as many pixels as its width and height say.
    #[error(
        "cannot write the picture ({width}×{height} pixels): it holds {pixel_count} pixels. \
         Give it as many as its size says."
    )]
    Misshapen {
        /// The picture's width.
        width: u32,
        /// The picture's height.
        height: u32,
        /// How many it holds.
        pixel_count: usize,
    },

    /// The name is a folder's.
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
        /// Where the file was to go.
        path: PathBuf,
        /// What is missing.
        folder: PathBuf,
    },

    /// The file exists and may not be replaced.
    #[error(
        "cannot write the file ({}): it exists and is to be kept. Choose another name.",
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

    /// The name is one that the program made up, and there is a symbolic link of that name.
    #[error(
        "cannot write the file ({}): it is a link that leads elsewhere. Remove the link, or choose \
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
        /// Where the file was to go.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },

    /// The standard output takes no more.
    #[error(
        "cannot write the picture (standard output): {}. {}",
        reason(source),
        advice(source)
    )]
    Stdout {
        /// What the system said.
        source: io::Error,
    },

    /// The file was written without an error, yet does not hold what was written.
    #[error(
        "cannot write the file ({}): {found} of {expected} bytes arrived. \
         Check the disk and write to another one.",
        show(path)
    )]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// How many bytes it should have.
        expected: u64,
        /// How many it has.
        found: u64,
    },

    /// The encoder refused the picture.
    #[error("cannot write the picture ({format}): {source}. Choose another format.")]
    Encode {
        /// The format asked for.
        format: Format,
        /// What the encoder said.
        source: ::image::ImageError,
    },

    /// The name's ending says no known video format.
    #[error(
        "cannot tell the video format ({}): the name has none of the endings {}. \
         Choose one of them.",
        show(path),
        VideoFormat::ENDINGS
    )]
    UnknownVideoFormat {
        /// Where the video was to go.
        path: PathBuf,
    },

    /// The program was built without the encoders of videos.
    #[error(
        "cannot write the video ({format}): this program was built without its encoder, the cargo \
         feature `video`. Choose .y4m, or numbered pictures."
    )]
    VideoLeftOut {
        /// The format asked for.
        format: VideoFormat,
    },

    /// The format cannot hold frames of that size. All figures are pixels.
    #[error(
        "cannot write the video ({width}×{height} pixels): {format} holds at most {long}×{short}, \
         or upright. Choose a smaller size or another format."
    )]
    VideoTooLarge {
        /// The format asked for.
        format: VideoFormat,
        /// The frames' width.
        width: u32,
        /// The frames' height.
        height: u32,
        /// The greatest longer side.
        long: u32,
        /// The greatest shorter side.
        short: u32,
    },

    /// The format cannot play frames at that rate.
    #[error(
        "cannot write the video ({rate} frames per second): {format} plays {least} to {most}. \
         Choose a rate between them or another format."
    )]
    VideoRate {
        /// The format asked for.
        format: VideoFormat,
        /// The rate asked for.
        rate: FrameRate,
        /// The lowest rate, in frames per second.
        least: f64,
        /// The highest rate, in frames per second.
        most: f64,
    },

    /// A frame has not the size of the first. All figures are pixels.
    #[error(
        "cannot write the video (frame {index}, counted from 0): it has {width}×{height} pixels, \
         the first one {first_width}×{first_height}. Render it again in that size."
    )]
    FrameSize {
        /// Which frame, from 0 on.
        index: usize,
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// The first frame's width.
        first_width: u32,
        /// The first frame's height.
        first_height: u32,
    },

    /// A frame could not be read back.
    #[error("cannot read the frame ({}): {reason}. Render it again.", show(path))]
    UnreadableFrame {
        /// The frame's file.
        path: PathBuf,
        /// What the system or the decoder said.
        reason: String,
    },

    /// The encoder refused a frame.
    #[error("cannot write the video ({format}): {reason}. Choose another format.")]
    VideoEncode {
        /// The format asked for.
        format: VideoFormat,
        /// What the encoder said.
        reason: String,
    },
}

impl OutputError {
    /// Whether another name, format, size or rate is all it takes.
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

    /// Whether a frame that was to be read back is at fault.
    pub fn is_refused_input(&self) -> bool {
        matches!(self, Self::FrameSize { .. } | Self::UnreadableFrame { .. })
    }

    /// Whether it can only be our bug.
    pub fn is_internal(&self) -> bool {
        matches!(
            self,
            Self::Encode { .. } | Self::Misshapen { .. } | Self::VideoEncode { .. }
        )
    }
}

/// A path for a one-line message: control characters are escaped, so that no file name can break
/// the line or steer the terminal.
fn show(path: &Path) -> String {
    path.to_string_lossy()
        .chars()
        .flat_map(|c| {
            let escaped = c.is_control().then(|| c.escape_default());
            let plain = escaped.is_none().then_some(c);
            escaped.into_iter().flatten().chain(plain)
        })
        .collect()
}

/// The system's words without its number, as a part of a sentence.
pub(crate) fn reason(error: &io::Error) -> String {
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
        FileTooLarge => "Raise the limit of file sizes (`ulimit -f`), or write a smaller file.",
        PermissionDenied | ReadOnlyFilesystem => "Choose a folder that you may write to.",
        InvalidFilename | InvalidInput | NotADirectory => "Choose another name.",
        BrokenPipe => "Keep the reading program running until the end.",
        _ => "Choose another place.",
    }
}
