//! What is kept from one run of the viewer to the next, as a file that people can read, change and
//! copy: `viewer.toml` in the settings folder of the platform, or in the one that the environment
//! variable `GLIMRAY_SETTINGS` names.

mod read;
mod saved_camera;

pub use saved_camera::SavedCamera;

use crate::app::words::TONES;
use crate::output::{self, OutputError};
use crate::scene::ToneCurve;
use crate::viewer::model::bindings::Bindings;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The file's name.
const FILE: &str = "viewer.toml";

/// Most files that are remembered.
pub const MAX_RECENT: usize = 12;

/// Most cameras that are kept for one scene; the oldest goes.
pub const MAX_CAMERAS: usize = 100;

/// Names the folder of the settings in place of the platform's.
pub const FOLDER_VARIABLE: &str = "GLIMRAY_SETTINGS";

/// Scales of the window's contents.
const SCALES: [f32; 12] = [
    0.5, 0.67, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0,
];

/// Dark or light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// As the desktop has it.
    #[default]
    System,
    /// Light on dark.
    Dark,
    /// Dark on light.
    Light,
}

impl Theme {
    /// All, the default first.
    pub const ALL: [Self; 3] = [Self::System, Self::Dark, Self::Light];

    /// As the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::System => "system",
            Self::Dark => "dark",
            Self::Light => "light",
        }
    }
}

/// What is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Preferences {
    /// Dark or light.
    pub theme: Theme,
    /// Factor on the screen's own scale, 0.5 to 4.
    pub ui_scale: f32,
    /// Which hand does what.
    pub bindings: Bindings,
    /// Files that were opened, the last one first.
    pub recent: Vec<PathBuf>,
    /// Cameras that were kept, by the scene's path, in the order in which they were.
    pub cameras: BTreeMap<PathBuf, Vec<SavedCamera>>,
    /// Width and height of the window's inside, in points.
    pub window: Option<[f32; 2]>,
    /// Where its upper left corner is, in points of the desktop; `None` is up to that.
    pub window_position: Option<[f32; 2]>,
    /// Whether it fills the screen; size and place are those of before then.
    pub maximized: bool,
    /// The arrangement of the panels; `Null` is the default one.
    layout: serde_json::Value,
    /// Whether the hint of the first run was read.
    pub hint_seen: bool,
    /// Samples per pixel to be reached, where they are not to be the scene's; 1 to 65536.
    pub samples: Option<u32>,
    /// The tone curve, where it is not to be the scene's.
    pub tone: Option<ToneCurve>,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            theme: Theme::System,
            ui_scale: 1.0,
            bindings: Bindings::default(),
            recent: Vec::new(),
            cameras: BTreeMap::new(),
            window: None,
            window_position: None,
            maximized: false,
            layout: serde_json::Value::Null,
            hint_seen: false,
            samples: None,
            tone: None,
        }
    }
}

impl Preferences {
    /// Takes the next larger scale of the window's contents.
    pub fn enlarge(&mut self) {
        let next = SCALES.into_iter().find(|scale| *scale > self.ui_scale);
        self.ui_scale = next.unwrap_or(self.ui_scale);
    }

    /// Takes the next smaller scale of the window's contents.
    pub fn shrink(&mut self) {
        let next = SCALES
            .into_iter()
            .rev()
            .find(|scale| *scale < self.ui_scale);
        self.ui_scale = next.unwrap_or(self.ui_scale);
    }

    /// Remembers that a file was opened.
    pub fn opened(&mut self, path: &Path) {
        let path = whole(path);
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }

    /// Cameras that were kept for a scene.
    pub fn cameras_of(&self, scene: &Path) -> &[SavedCamera] {
        (self.cameras.get(&whole(scene))).map_or(&[], Vec::as_slice)
    }

    /// Keeps a camera for a scene; one of the same name is replaced.
    pub fn keep_camera(&mut self, scene: &Path, camera: SavedCamera) {
        let cameras = self.cameras.entry(whole(scene)).or_default();
        match cameras.iter_mut().find(|known| known.name == camera.name) {
            Some(known) => *known = camera,
            None => cameras.push(camera),
        }
        let surplus = cameras.len().saturating_sub(MAX_CAMERAS);
        cameras.drain(..surplus);
    }

    /// Keeps for a scene that was saved under another name what was kept for it before.
    pub fn copy_cameras(&mut self, from: &Path, to: &Path) {
        let known = self.cameras_of(to).to_vec();
        for camera in self.cameras_of(from).to_vec() {
            if known.iter().all(|other| other.name != camera.name) {
                self.keep_camera(to, camera);
            }
        }
    }

    /// Drops a camera that was kept for a scene.
    pub fn drop_camera(&mut self, scene: &Path, name: &str) {
        let scene = whole(scene);
        if let Some(cameras) = self.cameras.get_mut(&scene) {
            cameras.retain(|known| known.name != name);
            if cameras.is_empty() {
                self.cameras.remove(&scene);
            }
        }
    }

    /// The arrangement of the panels; `None` if there is none, or none that this version can read.
    pub fn layout<T: DeserializeOwned>(&self) -> Option<T> {
        // Twice through text, for maps whose keys are not text in Rust but are in JSON.
        serde_json::from_str(&self.layout.to_string()).ok()
    }

    /// Keeps the arrangement of the panels, whatever that is made of; `None` is the default one.
    pub fn set_layout<T: Serialize>(&mut self, layout: Option<&T>) {
        let value = layout.and_then(|layout| serde_json::to_value(layout).ok());
        self.layout = value.unwrap_or_default();
    }

    /// As the file has it.
    fn to_toml(&self) -> String {
        let mut table = toml::Table::new();
        let mut put = |name: &str, value: toml::Value| table.insert(name.to_owned(), value);
        put("theme", self.theme.name().into());
        // f32 through f64 would show digits that nobody chose.
        let plain = |value: f32| toml::Value::from(value.to_string().parse().unwrap_or(1.0));
        put("ui_scale", plain(self.ui_scale));
        put("hint_seen", self.hint_seen.into());
        if let Some(samples) = self.samples {
            put("samples", i64::from(samples).into());
        }
        if let Some(tone) = self.tone {
            put("tone", TONES.word(&tone).into());
        }
        if let Some(size) = self.window {
            put("window", size.map(plain).to_vec().into());
        }
        if let Some(position) = self.window_position {
            put("window_position", position.map(plain).to_vec().into());
        }
        put("maximized", self.maximized.into());
        if !self.layout.is_null() {
            put("layout", self.layout.to_string().into());
        }
        // Names that are not text are no names in the file; the files stay openable.
        let recent = self.recent.iter().filter_map(|path| path.to_str());
        put(
            "recent",
            recent.map(toml::Value::from).collect::<Vec<_>>().into(),
        );

        let mut bindings = toml::Table::new();
        let preset = self.bindings.preset().name();
        bindings.insert("preset".to_owned(), preset.into());
        let changes = self.bindings.changes().into_iter();
        let changes = changes.map(|(name, triggers)| (name, triggers.into()));
        bindings.insert(
            "changed".to_owned(),
            toml::Value::Table(changes.collect::<toml::Table>()),
        );
        put("bindings", bindings.into());

        let cameras = self.cameras.iter();
        let cameras = cameras.filter_map(|(path, cameras)| {
            let cameras = cameras.iter().map(SavedCamera::to_toml);
            Some((
                path.to_str()?.to_owned(),
                cameras.collect::<Vec<_>>().into(),
            ))
        });
        put(
            "cameras",
            toml::Value::Table(cameras.collect::<toml::Table>()),
        );
        format!(
            "# Settings of `glimray view`, which rewrites this file when a setting changes.\n\n{table}"
        )
    }
}

/// Why the settings could not be kept. The text is `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum PreferencesError {
    /// The platform has no place for them.
    #[error(
        "cannot save the settings: there is no home folder. Name a folder in {FOLDER_VARIABLE}."
    )]
    NoFolder,
    /// The folder could not be made, or the old file not be put aside.
    #[error(
        "cannot save the settings ({}): {}. Make the folder writable, or name another one in {FOLDER_VARIABLE}.",
        path.display(),
        output::reason(source)
    )]
    Folder {
        /// What could not be made or moved.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file that is there could be neither read nor put aside, and may be of worth.
    #[error(
        "cannot save the settings ({}): the existing file cannot be read and is not replaced. Make it readable, or name another folder in {FOLDER_VARIABLE}.",
        path.display()
    )]
    Unread {
        /// The file.
        path: PathBuf,
    },
    /// The file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// The file.
#[derive(Debug)]
pub struct Store {
    folder: Option<PathBuf>,
    /// What it contains, as far as is known.
    written: Option<String>,
    /// Whether a file is in its place that could not be read, and so must not be replaced.
    is_unread: bool,
}

impl Store {
    /// In the folder that the environment names, else in the platform's.
    pub fn of_this_system() -> Self {
        let named = env::var_os(FOLDER_VARIABLE).filter(|folder| !folder.is_empty());
        let platform = || {
            directories::ProjectDirs::from("", "", "glimray")
                .map(|folders| folders.config_dir().to_owned())
        };
        Self {
            folder: named.map(PathBuf::from).or_else(platform),
            written: None,
            is_unread: false,
        }
    }

    /// In this folder, which need not exist.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: Some(folder.into()),
            written: None,
            is_unread: false,
        }
    }

    /// Where the file is or will be; `None` where the platform has no place for it.
    pub fn path(&self) -> Option<PathBuf> {
        self.folder.as_ref().map(|folder| folder.join(FILE))
    }

    /// What the file says, and a line for each thing that a person should know about it. What it does
    /// not say, or what cannot be read, is as by default; the file is then kept under another name.
    pub fn load(&mut self) -> (Preferences, Vec<String>) {
        let Some(path) = self.path() else {
            return (
                Preferences::default(),
                vec![PreferencesError::NoFolder.to_string()],
            );
        };
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Default::default(),
            Err(error) => return (Preferences::default(), vec![self.unread(&path, &error)]),
        };
        let (preferences, notes) = read::read(&bytes);
        if notes.is_empty() {
            self.written = String::from_utf8(bytes).ok();
            return (preferences, Vec::new());
        }
        let mut lines = Vec::new();
        let kept = match self.put_aside(&path) {
            Ok(kept) => format!("The old file is now {}.", kept.display()),
            Err(error) => {
                lines.push(error.to_string());
                "The file is unchanged.".to_owned()
            }
        };
        let more = match notes.len() - 1 {
            0 => String::new(),
            more => format!(" (and {more} more)"),
        };
        let first = &notes[0];
        let note = format!(
            "cannot read all settings ({}): {first}{more}. {kept}",
            path.display()
        );
        lines.insert(0, note);
        if lines.len() == 1
            && let Err(error) = self.save(&preferences)
        {
            lines.push(error.to_string());
        }
        (preferences, lines)
    }

    /// Keeps a file that cannot be read from being replaced; returns a line about it.
    fn unread(&mut self, path: &Path, error: &io::Error) -> String {
        // A folder is no old file of settings: it stays where it is.
        let is_file = fs::symlink_metadata(path).is_ok_and(|found| !found.is_dir());
        let kept = if is_file {
            self.put_aside(path).ok()
        } else {
            None
        };
        self.is_unread = kept.is_none();
        let what = match kept {
            Some(kept) => format!("It is now {}", kept.display()),
            None => "It is unchanged, and settings are not saved".to_owned(),
        };
        let (path, why) = (path.display(), output::reason(error));
        format!("cannot read the settings ({path}): {why}. {what}; the defaults are in use.")
    }

    /// Writes what has changed since it was last written or read.
    ///
    /// # Errors
    /// The folder cannot be made or written to; the old file is then still there.
    pub fn save(&mut self, preferences: &Preferences) -> Result<(), PreferencesError> {
        let text = preferences.to_toml();
        if self.written.as_ref() == Some(&text) {
            return Ok(());
        }
        let folder = self.folder.as_ref().ok_or(PreferencesError::NoFolder)?;
        if self.is_unread {
            let path = folder.join(FILE);
            return Err(PreferencesError::Unread { path });
        }
        fs::create_dir_all(folder).map_err(|source| PreferencesError::Folder {
            path: folder.clone(),
            source,
        })?;
        output::write(folder.join(FILE), text.as_bytes(), true)?;
        self.written = Some(text);
        Ok(())
    }

    /// Goes back to the defaults. The file as it was is kept under another name.
    ///
    /// # Errors
    /// As [`Store::save`].
    pub fn reset(&mut self) -> Result<Preferences, PreferencesError> {
        let path = self.path().ok_or(PreferencesError::NoFolder)?;
        if path.exists() {
            self.put_aside(&path)?;
        }
        self.written = None;
        self.is_unread = false;
        let preferences = Preferences::default();
        self.save(&preferences)?;
        Ok(preferences)
    }

    /// Gives the file another name, which no other has.
    fn put_aside(&self, path: &Path) -> Result<PathBuf, PreferencesError> {
        let mut name = path.with_extension("toml.bak");
        let mut count = 1;
        while name.exists() {
            count += 1;
            name = path.with_extension(format!("toml.bak{count}"));
        }
        let moved = fs::rename(path, &name);
        moved.map_err(|source| PreferencesError::Folder {
            path: path.into(),
            source,
        })?;
        Ok(name)
    }
}

/// The same path from wherever it is looked at.
fn whole(path: &Path) -> PathBuf {
    let path = fs::canonicalize(path).or_else(|_| std::path::absolute(path));
    path.unwrap_or_default()
}
