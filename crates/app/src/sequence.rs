//! Animations as files: frames that are numbered, a journal of them beside them, and the video that they are encoded to.
//!
//! A run renders the frames that are missing or out of date and then encodes all of them. So runs are resumable, by
//! the command line and the window alike.

pub mod encode;
pub mod fingerprint;
pub mod frames;
pub mod journal;
pub mod pattern;

use glimray_io::output::{Format, SaveOptions};
use pattern::Pattern;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// One file per frame.
#[derive(Clone, Debug)]
pub struct Files {
    /// Their names.
    pub pattern: Pattern,
    /// Their format.
    pub format: Format,
    /// How they are written.
    pub options: SaveOptions,
}

impl Files {
    /// Files of this format. `quality` is that of JPEG, from 1 to 100.
    pub fn new(pattern: Pattern, format: Format, quality: u8) -> Self {
        Self {
            pattern,
            format,
            options: SaveOptions {
                format: Some(format),
                quality,
                clobber: true,
                follow_links: false,
                place: None,
                opacity: false,
            },
        }
    }

    /// The frames of a video, in this folder.
    pub fn of_video(folder: &Path, quality: u8) -> Self {
        let pattern = Pattern::in_folder(folder, "frame_", ".png");
        Self::new(pattern, Format::Png, quality)
    }
}

/// The usual folder for the frames of a video: beside it.
pub fn frames_folder(video: &Path) -> PathBuf {
    let mut folder = OsString::from(video);
    folder.push(".frames");
    folder.into()
}
