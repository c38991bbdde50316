//! The output of a farm, checked before rendering: plans refuse what `render` and `animate` refuse.

use crate::animate::{Timeline, rate};
use crate::args::{FarmPlanArgs, MomentFlags};
use crate::job::Job;
use glimray_app::error::AppError;
use glimray_app::overrides::picture_size;
use glimray_app::sequence::pattern::Pattern;
use glimray_io::output::video::{self, VideoFormat, VideoOptions};
use glimray_io::output::{self, Format, SaveOptions};
use std::path::Path;

/// A picture, its film, a video, or numbered frames.
pub enum Target {
    Picture(Format),
    Film,
    Video(VideoFormat),
    Frames(Pattern, Format),
}

impl Target {
    /// Parses the name of the output.
    ///
    /// # Errors
    /// The name has no known extension or is not UTF-8.
    pub fn parse(path: &Path) -> Result<Self, AppError> {
        let refused = |why: String| {
            Err(AppError::Usage(format!(
                "cannot plan ({}): {why}. Choose another name.",
                path.display()
            )))
        };
        if path.to_str().is_none() {
            return refused("the name is not valid Unicode".into());
        }
        if path.is_dir() {
            return refused("it is a folder".into());
        }
        if let Some(format) = VideoFormat::from_path(path) {
            return Ok(Self::Video(format));
        }
        let ending = path.extension().unwrap_or_default();
        let is_film = ending.eq_ignore_ascii_case("film");
        match (Pattern::parse(path), Format::from_path(path)) {
            (Ok(pattern), Some(format)) => Ok(Self::Frames(pattern, format)),
            (Ok(_), None) if is_film => refused("frames cannot be films".into()),
            (Err(_), Some(format)) => Ok(Self::Picture(format)),
            (Err(_), None) if is_film => Ok(Self::Film),
            _ => refused(format!(
                "the name is none of a picture ({}, .film), of a video ({}) or of frames",
                Format::ENDINGS,
                VideoFormat::ENDINGS
            )),
        }
    }

    pub fn is_animation(&self) -> bool {
        matches!(self, Self::Video(_) | Self::Frames(..))
    }

    /// Finds what prevents the merge.
    ///
    /// # Errors
    /// Layers, opacity, the size or the frame rate do not fit the format, or the file cannot be written.
    pub fn check(
        &self,
        job: &Job,
        arguments: &FarmPlanArgs,
        timeline: Option<&Timeline>,
    ) -> Result<(), AppError> {
        let MomentFlags { frame, time } = arguments.moment;
        if self.is_animation() && (frame.is_some() || time.is_some()) {
            return Err(AppError::Usage(format!(
                "cannot plan ({}): --frame and --time choose one picture of an animation. Choose --frames, or the name of a \
                 picture.",
                arguments.path.display()
            )));
        }
        if arguments.log.report.is_some() {
            return Err(AppError::Usage(
                "cannot plan (--report): a plan renders nothing that could be reported. Omit it; each part writes its own \
                 report into the folder."
                    .into(),
            ));
        }
        let path = &arguments.path;
        let settings = job.settings();
        let (takes_layers, takes_opacity) = match self {
            Self::Film => (true, true),
            Self::Video(_) => (false, false),
            Self::Picture(format) | Self::Frames(_, format) => {
                (*format == Format::Exr, format.has_opacity())
            }
        };
        job.check_format(&settings, path, takes_layers, takes_opacity)?;
        let (width, height) = picture_size(&settings)?;
        let options = SaveOptions {
            quality: arguments.quality,
            ..SaveOptions::default()
        };
        match (self, timeline) {
            (Self::Picture(_), _) => output::check(path, &options, width, height)?,
            (Self::Film, _) => output::check_file(path, true)?,
            // The merge makes the folder.
            (Self::Frames(pattern, _), Some(timeline)) if pattern.folder().is_dir() => {
                let first = pattern.path(timeline.first);
                output::check(first, &options, width, height)?;
            }
            (Self::Video(format), Some(timeline)) => {
                let options = VideoOptions {
                    rate: rate(timeline.video_fps())?,
                    ..VideoOptions::default()
                };
                video::check(path, *format, &options, width, height)?;
            }
            _ => {}
        }
        Ok(())
    }
}
