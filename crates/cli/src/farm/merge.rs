//! `glimray farm merge DIR`: puts the parts together, to the bytes of one run.

use super::manifest::{Frames, Manifest};
use super::results::{Depth, State, foreign, frame_files, state, unfinished};
use super::{Folder, frames, numbered};
use crate::animate::rate;
use crate::args::FarmMergeArgs;
use crate::interrupt::Interrupt;
use glimray_app::console;
use glimray_app::console::Console;
use glimray_app::error::AppError;
use glimray_app::sequence::encode::encode;
use glimray_app::sequence::pattern::Pattern;
use glimray_io::output;
use glimray_io::output::video::{VideoFormat, VideoOptions};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Parts that the message about missing ones lists; their commands are complete.
const MAX_LISTED: usize = 8;

pub fn run(arguments: &FarmMergeArgs) -> Result<(), AppError> {
    let interrupt = Interrupt::install()?;
    let folder = Folder(arguments.dir.clone());
    let manifest = Manifest::read(folder.path())?;
    let output = arguments.path.clone().unwrap_or(manifest.output.clone());
    if output.extension() != manifest.output.extension() {
        return Err(AppError::Usage(format!(
            "cannot merge ({}): the farm was planned for {}. Choose a name with the same extension.",
            output.display(),
            manifest.output.display()
        )));
    }
    let missing = unfinished(&folder, &manifest);
    if arguments.partial && manifest.frames.is_some() {
        return Err(AppError::Usage(format!(
            "cannot merge (--partial): {} is an animation. Omit the flag, and run the parts that are missing.",
            manifest.output.display()
        )));
    }
    let is_partial = arguments.partial && missing.len() < manifest.parts.len();
    if !missing.is_empty() && !is_partial {
        return Err(incomplete(&folder, &missing)?);
    }
    let merge = Merge {
        folder,
        manifest,
        arguments,
    };
    match &merge.manifest.frames {
        None => merge.picture(&missing, &output)?,
        Some(frames) => merge.animation(frames, &output, &interrupt)?,
    }
    let console = Console::new(arguments.quiet, false);
    console.status(format_args!("wrote {}", output.display()));
    Ok(())
}

/// The error for parts that are not done; prints their commands.
fn incomplete(folder: &Folder, missing: &[u32]) -> Result<AppError, AppError> {
    let commands = missing
        .iter()
        .map(|part| format!("{} {part}\n", super::command("run", folder)));
    console::print(&commands.collect::<String>())?;
    let listed: Vec<_> = (missing.iter().take(MAX_LISTED))
        .map(u32::to_string)
        .collect();
    let more = match missing.len().saturating_sub(MAX_LISTED) {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    Ok(AppError::Missing(format!(
        "cannot merge ({}): parts {}{more} are not done. Run them, or see `glimray farm status`.",
        folder.path().display(),
        listed.join(", ")
    )))
}

struct Merge<'a> {
    folder: Folder,
    manifest: Manifest,
    arguments: &'a FarmMergeArgs,
}

impl Merge<'_> {
    /// Merges the films of a picture.
    fn picture(&self, missing: &[u32], output: &Path) -> Result<(), AppError> {
        let mut films = Vec::new();
        for (number, _) in numbered(&self.manifest) {
            if missing.binary_search(&number).is_err() {
                films.push(self.film(number)?);
            }
        }
        let mut extra = Vec::new();
        if self.arguments.partial {
            extra.push("--partial");
        }
        if self.arguments.same_adapter {
            extra.push("--same-adapter");
        }
        frames::merge_films(&self.manifest, films, &extra, output)
    }

    /// Merges the frames that are in parts, and writes the frames or the video.
    fn animation(
        &self,
        frames: &Frames,
        output: &Path,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        self.check_adapters()?;
        let mut files: BTreeMap<u32, PathBuf> = BTreeMap::new();
        for (number, part) in numbered(&self.manifest) {
            if part.is_film() {
                self.film(number)?;
                continue;
            }
            match state(&self.folder, &self.manifest, number, Depth::Whole) {
                State::Done => files.extend(frame_files(&self.folder, &self.manifest, number)),
                State::Invalid(why) => return Err(self.damaged(number, &why)),
                State::Absent => return Err(self.damaged(number, "it is no longer done")),
            }
        }
        for (frame, parts) in frames::cut(&self.manifest) {
            interrupt.check()?;
            let mixes = self.arguments.mix_adapters;
            let path = frames::merge(&self.folder, &self.manifest, (frame, &parts), mixes)?;
            files.insert(frame, path);
        }
        let files: Vec<_> = files.into_iter().collect();
        match VideoFormat::from_path(output) {
            Some(format) => {
                let files: Vec<_> = files.into_iter().map(|(_, file)| file).collect();
                self.video(&files, format, frames, output, interrupt)
            }
            None => self.frames(&files, output, interrupt),
        }
    }

    /// The film of a part.
    fn film(&self, number: u32) -> Result<PathBuf, AppError> {
        match foreign(&self.folder, &self.manifest, number) {
            None => Ok(self.folder.film(number)),
            Some(why) => Err(self.damaged(number, &why)),
        }
    }

    fn damaged(&self, number: u32, why: &str) -> AppError {
        AppError::Refused(format!(
            "cannot merge ({}): part {number} cannot be used, {why}. Run it again: {} {number}.",
            self.folder.path().display(),
            super::command("run", &self.folder)
        ))
    }

    /// Refuses parts of several adapters, or warns about them: one frame may then differ from the next.
    fn check_adapters(&self) -> Result<(), AppError> {
        let parts = numbered(&self.manifest);
        let done = parts.filter_map(|(number, _)| self.folder.done(number));
        let adapters: BTreeSet<_> = done.map(|done| done.adapter).collect();
        if adapters.len() < 2 {
            return Ok(());
        }
        let adapters = Vec::from_iter(adapters).join(", ");
        if self.arguments.same_adapter {
            return Err(AppError::Refused(format!(
                "cannot merge ({}): its parts are of different adapters, {adapters}. Render them on one kind of adapter, or \
                 omit --same-adapter.",
                self.folder.path().display()
            )));
        }
        console::warning(format_args!(
            "the frames are of different adapters ({adapters}), which may round differently; --same-adapter refuses them."
        ));
        Ok(())
    }

    fn video(
        &self,
        files: &[PathBuf],
        format: VideoFormat,
        frames: &Frames,
        output: &Path,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        let options = VideoOptions {
            rate: rate(frames.fps)?,
            quality: self.manifest.quality,
            repeat: frames.repeat,
            clobber: true,
        };
        let _deferred = interrupt.defer();
        encode(output, format, &options, files, |_| interrupt.check())
    }

    fn frames(
        &self,
        files: &[(u32, PathBuf)],
        output: &Path,
        interrupt: &Interrupt,
    ) -> Result<(), AppError> {
        let pattern = Pattern::parse(output)
            .map_err(|why| AppError::Usage(format!("cannot number the frames: {why}")))?;
        let folder = pattern.folder();
        fs::create_dir_all(folder).map_err(|error| super::failed_io(folder, error))?;
        for (frame, file) in files {
            interrupt.check()?;
            let bytes = fs::read(file).map_err(|error| super::failed_io(file, error))?;
            output::write(pattern.path(*frame), &bytes, true)?;
        }
        Ok(())
    }
}
