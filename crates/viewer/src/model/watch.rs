//! Detects changes of files. Folders are watched rather than files, because programs replace files when they
//! save, and a deleted file may return.

use notify::event::ModifyKind;
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant, SystemTime};

/// Programs save in several steps: delay after the last event before the file is read.
pub const DEBOUNCE: Duration = Duration::from_millis(50);

/// Interval for polling a deleted file, whose folder may be gone too.
const SEARCH: Duration = Duration::from_millis(500);

/// Modification time and length of a file; `None` if it does not exist.
type Stamp = Option<(SystemTime, u64)>;

/// Watched files and their last known state.
#[derive(Default)]
pub struct Watch {
    watcher: Option<(RecommendedWatcher, Receiver<PathBuf>)>,
    folders: BTreeSet<PathBuf>,
    stamps: BTreeMap<PathBuf, Stamp>,
    /// Time of the last event.
    news: Option<Instant>,
    searched: Option<Instant>,
}

/// A change of the watched files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// No relevant change.
    None,
    /// Changes are in progress; check again after this time.
    Wait(Duration),
    /// Files have changed.
    Changed,
}

impl Watch {
    /// Watches these files from now on. Files written after `since` count as changed, unless they were
    /// watched before. `wake` is called from another thread on events.
    ///
    /// # Errors
    /// The system cannot watch a folder: why, in a few words.
    pub fn set_files(
        &mut self,
        files: &[PathBuf],
        since: SystemTime,
        wake: impl Fn() + Send + 'static,
    ) -> Result<(), String> {
        let files: BTreeSet<PathBuf> = files.iter().map(|file| absolute(file)).collect();
        self.stamps.retain(|file, _| files.contains(file));
        for file in &files {
            let (news, stamps) = (&mut self.news, &mut self.stamps);
            stamps.entry(file.clone()).or_insert_with(|| {
                let found = stamp(file);
                match found {
                    Some((written, _)) if written > since => {
                        *news = Some(Instant::now());
                        None
                    }
                    _ => found,
                }
            });
        }
        let folders: BTreeSet<PathBuf> = (files.iter())
            .filter_map(|file| file.parent().map(Path::to_owned))
            .collect();
        if folders == self.folders && self.watcher.is_some() {
            return Ok(());
        }
        self.folders = folders;
        let (sender, receiver) = channel();
        let mut watcher =
            notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
                let Ok(event) = event else {
                    return;
                };
                let is_change = match event.kind {
                    EventKind::Create(_) | EventKind::Remove(_) | EventKind::Any => true,
                    EventKind::Modify(kind) => !matches!(kind, ModifyKind::Metadata(_)),
                    _ => false,
                };
                if is_change {
                    let sent = event.paths.into_iter().map(|path| sender.send(path));
                    // The receiver may be gone.
                    sent.for_each(drop);
                    wake();
                }
            })
            .map_err(|error| reason(&error))?;
        let mut failure = None;
        for folder in &self.folders {
            if let Err(error) = watcher.watch(folder, RecursiveMode::NonRecursive) {
                failure = Some(reason(&error));
            }
        }
        self.watcher = Some((watcher, receiver));
        failure.map_or(Ok(()), Err)
    }

    /// The watched files.
    pub fn files(&self) -> Vec<PathBuf> {
        self.stamps.keys().cloned().collect()
    }

    /// Accepts the current state of the files as known, before they are read again.
    pub fn accept(&mut self) {
        for (file, known) in &mut self.stamps {
            *known = stamp(file);
        }
        self.news = None;
    }

    /// The changes since the last call.
    pub fn look(&mut self) -> Change {
        if let Some((_, receiver)) = &self.watcher {
            let names: BTreeSet<_> = self.stamps.keys().filter_map(|f| f.file_name()).collect();
            for path in receiver.try_iter() {
                // The folder itself counts: it may be deleted together with the file.
                if path.file_name().is_some_and(|name| names.contains(name))
                    || self.folders.contains(&path)
                {
                    self.news = Some(Instant::now());
                }
            }
        }
        let is_missing = self.stamps.values().any(Option::is_none);
        if is_missing && self.searched.is_none_or(|at| at.elapsed() >= SEARCH) {
            self.searched = Some(Instant::now());
            if self.has_changed() && self.news.is_none() {
                // The system treats a recreated folder as a different one.
                self.folders.clear();
                self.news = Some(Instant::now());
            }
        }
        match self.news.map(|at| at.elapsed()) {
            Some(age) if age < DEBOUNCE => Change::Wait(DEBOUNCE - age),
            Some(_) => {
                self.news = None;
                match self.has_changed() {
                    true => Change::Changed,
                    false => Change::None,
                }
            }
            None if is_missing => Change::Wait(SEARCH),
            None => Change::None,
        }
    }

    /// Whether there are events that have not been evaluated.
    pub fn is_busy(&self) -> bool {
        self.news.is_some()
    }

    /// Whether a file differs from its known state.
    pub fn has_changed(&self) -> bool {
        self.stamps
            .iter()
            .any(|(file, known)| stamp(file) != *known)
    }
}

fn stamp(file: &Path) -> Stamp {
    let found = fs::metadata(file).ok()?;
    Some((found.modified().ok()?, found.len()))
}

/// With its canonical folder, which is the path that the system reports; the file itself may be a link.
fn absolute(file: &Path) -> PathBuf {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    match (file.parent().map(fs::canonicalize), file.file_name()) {
        (Some(Ok(folder)), Some(name)) => folder.join(name),
        _ => file,
    }
}

fn reason(error: &notify::Error) -> String {
    match &error.kind {
        notify::ErrorKind::Io(error) => glimray_io::output::reason(error),
        notify::ErrorKind::PathNotFound => "the folder does not exist".to_owned(),
        notify::ErrorKind::MaxFilesWatch => {
            "the system's limit of watched files is reached".to_owned()
        }
        other => format!("{other:?}"),
    }
}
