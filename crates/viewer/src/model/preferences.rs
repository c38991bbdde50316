//! Settings that outlive the window, in a file that users can read, edit and copy: `viewer.toml` in the
//! platform's settings folder, or in the one that the environment variable `GLIMRAY_SETTINGS` names.

mod format;
mod saved_camera;
mod thumbnail;

pub use saved_camera::SavedCamera;
pub use thumbnail::{THUMBNAIL, Thumbnail};

use crate::model::bindings::Bindings;
use crate::model::overlays::Overlays;
use glimray_app::folders::{self, SETTINGS_VARIABLE};
use glimray_io::output::{self, OutputError};
use glimray_scene::ToneCurve;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The name of the file.
const FILE: &str = "viewer.toml";

/// Maximum number of recent files.
pub const MAX_RECENT: usize = 12;

/// Maximum number of bookmarks per scene; the oldest is dropped.
pub const MAX_CAMERAS: usize = 100;

/// Scales of the interface.
const SCALES: [f32; 12] = [
    0.5, 0.67, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0,
];

/// Colour theme.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Theme {
    /// Follows the desktop.
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
}

/// The settings of the viewer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Preferences {
    /// Colour theme.
    pub theme: Theme,
    /// Factor on the screen's own scale, 0.5 to 4.
    pub ui_scale: f32,
    /// Whether the hint of the first run was read.
    pub hint_seen: bool,
    /// Whether path-traced previews are denoised, also where the picture is not.
    pub denoises_previews: bool,
    /// Target samples per pixel of new scenes, 1 to 65536; `None` for the scene's own.
    pub samples: Option<u32>,
    /// Tone curve of new scenes; `None` for the scene's own.
    #[serde(with = "format::tone")]
    pub tone: Option<ToneCurve>,
    /// Inner size of the window, in points.
    pub window: Option<[f32; 2]>,
    /// Upper left corner of the window, in points of the desktop; `None` leaves it to the desktop.
    pub window_position: Option<[f32; 2]>,
    /// Whether the window is maximised; size and position are those from before.
    pub maximized: bool,
    /// The layout of the panels; `Null` is the default one.
    #[serde(
        with = "format::json",
        skip_serializing_if = "serde_json::Value::is_null"
    )]
    layout: serde_json::Value,
    /// Files that were opened, the most recent first.
    #[serde(serialize_with = "format::paths")]
    pub recent: Vec<PathBuf>,
    /// Whether moves, rotations and scales snap without a key.
    pub snaps: bool,
    /// The overlays of the picture.
    #[serde(skip_deserializing)]
    pub overlays: Overlays,
    /// Keyboard and mouse bindings.
    #[serde(skip_deserializing, serialize_with = "format::bindings")]
    pub bindings: Bindings,
    /// Bookmarked views by the path of their scene, the oldest first.
    #[serde(skip_deserializing, serialize_with = "format::cameras")]
    pub cameras: BTreeMap<PathBuf, Vec<SavedCamera>>,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            theme: Theme::System,
            ui_scale: 1.0,
            snaps: false,
            overlays: Overlays::default(),
            bindings: Bindings::default(),
            recent: Vec::new(),
            cameras: BTreeMap::new(),
            window: None,
            window_position: None,
            maximized: false,
            layout: serde_json::Value::Null,
            hint_seen: false,
            denoises_previews: true,
            samples: None,
            tone: None,
        }
    }
}

impl Preferences {
    /// Selects the next larger scale of the interface.
    pub fn enlarge(&mut self) {
        let next = SCALES.into_iter().find(|scale| *scale > self.ui_scale);
        self.ui_scale = next.unwrap_or(self.ui_scale);
    }

    /// Selects the next smaller scale of the interface.
    pub fn shrink(&mut self) {
        let next = SCALES
            .into_iter()
            .rev()
            .find(|scale| *scale < self.ui_scale);
        self.ui_scale = next.unwrap_or(self.ui_scale);
    }

    /// Adds a file to the recent ones.
    pub fn opened(&mut self, path: &Path) {
        let path = whole(path);
        self.recent.retain(|known| *known != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }

    /// The bookmarks of a scene.
    pub fn cameras_of(&self, scene: &Path) -> &[SavedCamera] {
        (self.cameras.get(&whole(scene))).map_or(&[], Vec::as_slice)
    }

    /// Adds a bookmark to a scene; one with the same name is replaced.
    pub fn save_camera(&mut self, scene: &Path, camera: SavedCamera) {
        let cameras = self.cameras.entry(whole(scene)).or_default();
        match cameras.iter_mut().find(|known| known.name == camera.name) {
            Some(known) => *known = camera,
            None => cameras.push(camera),
        }
        let surplus = cameras.len().saturating_sub(MAX_CAMERAS);
        cameras.drain(..surplus);
    }

    /// Gives a picture to the bookmark of this name and camera, if a scene has it still.
    pub fn picture_camera(&mut self, scene: &Path, saved: &SavedCamera) {
        let cameras = self.cameras.get_mut(&whole(scene));
        let mut cameras = cameras.into_iter().flatten();
        let is_it =
            |known: &&mut SavedCamera| known.name == saved.name && known.camera == saved.camera;
        if let Some(known) = cameras.find(is_it) {
            known.picture.clone_from(&saved.picture);
        }
    }

    /// Copies the bookmarks of a scene that was saved under another name.
    pub fn copy_cameras(&mut self, from: &Path, to: &Path) {
        let known = self.cameras_of(to).to_vec();
        for camera in self.cameras_of(from).to_vec() {
            if known.iter().all(|other| other.name != camera.name) {
                self.save_camera(to, camera);
            }
        }
    }

    /// Deletes a bookmark of a scene.
    pub fn remove_camera(&mut self, scene: &Path, name: &str) {
        let scene = whole(scene);
        if let Some(cameras) = self.cameras.get_mut(&scene) {
            cameras.retain(|known| known.name != name);
            if cameras.is_empty() {
                self.cameras.remove(&scene);
            }
        }
    }

    /// The layout of the panels; `None` if there is none that this version can read.
    pub fn layout<T: DeserializeOwned>(&self) -> Option<T> {
        // Through text, which converts map keys that are not strings.
        serde_json::from_str(&self.layout.to_string()).ok()
    }

    /// Sets the layout of the panels; `None` is the default one.
    pub fn set_layout<T: Serialize>(&mut self, layout: Option<&T>) {
        let value = layout.and_then(|layout| serde_json::to_value(layout).ok());
        self.layout = value.unwrap_or_default();
    }
}

/// Why the settings cannot be saved. The text is `WHAT (WHERE): WHY. WHAT TO DO.`
#[derive(Debug, thiserror::Error)]
pub enum PreferencesError {
    /// The platform has no settings folder.
    #[error(
        "cannot save the settings: there is no home folder. Name a folder in {SETTINGS_VARIABLE}."
    )]
    NoFolder,
    /// The folder cannot be created, or the old file cannot be renamed.
    #[error(
        "cannot save the settings ({}): {}. Make the folder writable, or name another one in {SETTINGS_VARIABLE}.",
        path.display(),
        output::reason(source)
    )]
    Folder {
        /// The folder or file.
        path: PathBuf,
        /// The error.
        source: io::Error,
    },
    /// The existing file can be neither read nor renamed, and must not be lost.
    #[error(
        "cannot save the settings ({}): the existing file cannot be read and is not replaced. Make it readable, or name another folder in {SETTINGS_VARIABLE}.",
        path.display()
    )]
    Unread {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// The settings file.
#[derive(Debug)]
pub struct Store {
    folder: Option<PathBuf>,
    /// Known contents of the file.
    written: Option<String>,
    /// Whether the existing file could not be read and must not be replaced.
    is_unread: bool,
}

impl Store {
    /// The file in the folder that the environment names, else in the platform's folder.
    pub fn of_this_system() -> Self {
        Self {
            folder: folders::settings(),
            written: None,
            is_unread: false,
        }
    }

    /// The file in this folder, which need not exist.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: Some(folder.into()),
            written: None,
            is_unread: false,
        }
    }

    /// The path of the file; `None` if the platform has no settings folder.
    pub fn path(&self) -> Option<PathBuf> {
        self.folder.as_ref().map(|folder| folder.join(FILE))
    }

    /// Reads the file. Missing and invalid values have their defaults. Returns a message about invalid
    /// ones; the file is then kept under another name.
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
        let (preferences, notes) = format::read(&bytes);
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

    /// Protects a file that cannot be read from being replaced; returns a message.
    fn unread(&mut self, path: &Path, error: &io::Error) -> String {
        // A folder is not a settings file and stays.
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

    /// Writes the file if the settings have changed since it was last written or read.
    ///
    /// # Errors
    /// The folder cannot be created or written to. The old file is unchanged then.
    pub fn save(&mut self, preferences: &Preferences) -> Result<(), PreferencesError> {
        let text = format::write(preferences);
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

    /// Resets to the defaults. The old file is kept under another name.
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

    /// Renames the file to an unused name.
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

/// The canonical form of a path, or its absolute form if it does not exist.
fn whole(path: &Path) -> PathBuf {
    let path = fs::canonicalize(path).or_else(|_| std::path::absolute(path));
    path.unwrap_or_default()
}
