//! Importers: the meaning of each format, and the message for every error.

mod assets;
pub mod cameras;
mod course;
mod defaults;
mod encoded;
mod files;
pub mod gltf;
mod hostile;
mod keys;
mod memory;
mod mtl;
mod native;
mod native_animation;
mod native_groups;
mod native_keys;
mod native_light_and_lens;
mod nff;
mod nodes_and_ply;
mod obj;
mod optics;
mod picture_meaning;
mod picture_store;
mod pictures;
mod ply;
mod range;
mod resolver;
mod rounding;
mod shapes;
mod stage;
mod stl;
mod texts;
mod textures;
pub mod zipped;

use glimray::import::{self, ImportError, Options};
use glimray::scene::Scene;
use std::path::Path;
use tempfile::TempDir;

/// A folder with the given files in it.
fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, contents) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, contents).expect("a file");
    }
    folder
}

/// The result of loading a file with this name and contents.
fn load(name: &str, contents: impl AsRef<[u8]>) -> Result<Scene, ImportError> {
    let folder = folder(&[(name, contents.as_ref())]);
    import::load(&folder.path().join(name))
}

/// Loads the scene in a valid file.
fn scene(name: &str, contents: impl AsRef<[u8]>) -> Scene {
    load(name, contents).unwrap_or_else(|error| panic!("{error}"))
}

/// The error message for the file `name` in `folder`, without the folder's own name.
fn message_in(folder: &TempDir, name: &str, options: &Options) -> String {
    match import::load_with(&folder.path().join(name), options) {
        Ok(_) => "no error".to_owned(),
        Err(error) => without_folder(&error, folder.path()),
    }
}

fn without_folder(error: &ImportError, folder: &Path) -> String {
    let text = error.to_string();
    assert_eq!(text.lines().count(), 1, "an error is one line: {text}");
    let real = folder.canonicalize().expect("the folder is there");
    let text = text.replace(&format!("{}/", real.display()), "");
    text.replace(&format!("{}/", folder.display()), "")
}

/// The messages for files of one kind, one line per text.
fn messages<T: AsRef<[u8]>>(name: &str, texts: &[T]) -> String {
    let message = |text: &T| {
        let folder = folder(&[(name, text.as_ref())]);
        message_in(&folder, name, &Options::default())
    };
    texts.iter().map(message).collect::<Vec<_>>().join("\n")
}
