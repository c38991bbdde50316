//! Tells when files have changed. Folders are watched rather than files: programs replace files when
//! they save, and a file that is gone may come back.

use notify::event::ModifyKind;
use notify::{EventKind, RecommendedWatcher, RecursiveMode, Watcher};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant, SystemTime};

/// Programs save in several steps: this long after the last one the file is read.
pub const DEBOUNCE: Duration = Duration::from_millis(50);

/// How often a file that is gone is looked for, because its folder may be gone too.
const SEARCH: Duration = Duration::from_millis(500);

/// When a file was written, and its length; `None` for one that is not there.
type Stamp = Option<(SystemTime, u64)>;

/// Files, and whether they are as they were.
#[derive(Default)]
pub struct Watch {
    watcher: Option<(RecommendedWatcher, Receiver<PathBuf>)>,
    folders: BTreeSet<PathBuf>,
    stamps: BTreeMap<PathBuf, Stamp>,
    /// When the last thing happened to one of them.
    news: Option<Instant>,
    searched: Option<Instant>,
}

/// What happened to the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Nothing that matters.
    None,
    /// Something is going on; look again after so long.
    Wait(Duration),
    /// They are not as they were.
    Changed,
}

impl Watch {
    /// Watches these from now on. What was written after `since` counts as changed, unless it was watched
    /// before. `wake` is called from another thread when something happens.
    ///
    /// # Errors
    /// The system cannot watch a folder: why, in a few words.
    pub fn follow(
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
                    // Nobody listens to a watcher that is about to be dropped.
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

    /// What is watched.
    pub fn files(&self) -> Vec<PathBuf> {
        self.stamps.keys().cloned().collect()
    }

    /// Takes the files as they are now for how they were: before they are read again.
    pub fn accept(&mut self) {
        for (file, known) in &mut self.stamps {
            *known = stamp(file);
        }
        self.news = None;
    }

    /// What has happened.
    pub fn look(&mut self) -> Change {
        if let Some((_, receiver)) = &self.watcher {
            let names: BTreeSet<_> = self.stamps.keys().filter_map(|f| f.file_name()).collect();
            for path in receiver.try_iter() {
                // The folder itself counts, which may have gone with the file.
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
                // A folder that was made anew is another one to the system.
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

    /// Whether something has happened of which it is not known yet what.
    pub fn is_busy(&self) -> bool {
        self.news.is_some()
    }

    /// Whether a file is not as it was, told or not.
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

/// With its folder as it really is, which is what the system will name; the file itself may be a link.
fn absolute(file: &Path) -> PathBuf {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    match (file.parent().map(fs::canonicalize), file.file_name()) {
        (Some(Ok(folder)), Some(name)) => folder.join(name),
        _ => file,
    }
}

fn reason(error: &notify::Error) -> String {
    match &error.kind {
        notify::ErrorKind::Io(error) => crate::output::reason(error),
        notify::ErrorKind::MaxFilesWatch => "too many files are watched on this system".to_owned(),
        other => format!("{other:?}"),
    }
}
