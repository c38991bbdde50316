//! The folders of the platform in which glimray keeps files of its own.

use directories::ProjectDirs;
use std::{env, path::PathBuf};

/// The environment variable that overrides the settings folder.
pub const SETTINGS_VARIABLE: &str = "GLIMRAY_SETTINGS";

/// The folder of settings; `None` if the platform has none.
pub fn settings() -> Option<PathBuf> {
    named(SETTINGS_VARIABLE).or_else(|| Some(of_platform()?.config_dir().to_owned()))
}

/// The folder of data that only saves time; `None` if the platform has none.
pub fn cache() -> Option<PathBuf> {
    Some(of_platform()?.cache_dir().to_owned())
}

fn named(variable: &str) -> Option<PathBuf> {
    let folder = env::var_os(variable).filter(|folder| !folder.is_empty());
    folder.map(PathBuf::from)
}

fn of_platform() -> Option<ProjectDirs> {
    ProjectDirs::from("", "", "glimray")
}
