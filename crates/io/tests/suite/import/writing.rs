//! Files for importers, and the results of reading them.

use glam::DVec3;
use glimray::import::{self, ImportError, Options};
use glimray::scene::{Instance, Scene};
use std::io::Write;
use std::path::Path;
use tempfile::TempDir;
use zip::{CompressionMethod, write::SimpleFileOptions};

/// A folder with the given files in it.
pub fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, contents) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, contents).expect("a file");
    }
    folder
}

/// The result of loading a file with this name and contents.
pub fn load(name: &str, contents: impl AsRef<[u8]>) -> Result<Scene, ImportError> {
    let folder = folder(&[(name, contents.as_ref())]);
    import::load(&folder.path().join(name))
}

/// Loads the scene in a valid file.
pub fn scene(name: &str, contents: impl AsRef<[u8]>) -> Scene {
    load(name, contents).unwrap_or_else(|error| panic!("{error}"))
}

/// The error message for the file `name` in `folder`, without the folder's own name.
pub fn message_in(folder: &TempDir, name: &str, options: &Options) -> String {
    match import::load_with(&folder.path().join(name), options) {
        Ok(_) => "no error".to_owned(),
        Err(error) => without_folder(&error, folder.path()),
    }
}

pub fn without_folder(error: &ImportError, folder: &Path) -> String {
    let text = error.to_string();
    assert_eq!(text.lines().count(), 1, "an error is one line: {text}");
    let real = folder.canonicalize().expect("the folder is there");
    let text = text.replace(&format!("{}/", real.display()), "");
    text.replace(&format!("{}/", folder.display()), "")
}

/// The messages for files of one kind, one line per text.
pub fn messages<T: AsRef<[u8]>>(name: &str, texts: &[T]) -> String {
    let message = |text: &T| {
        let folder = folder(&[(name, text.as_ref())]);
        message_in(&folder, name, &Options::default())
    };
    texts.iter().map(message).collect::<Vec<_>>().join("\n")
}

/// A ZIP archive of files with these names.
pub fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    for (name, contents) in files {
        writer.start_file(*name, options).expect("an entry");
        writer.write_all(contents).expect("its contents");
    }
    writer.finish().expect("an archive").into_inner()
}

/// The triangles of all meshes, in the world, in f64.
pub fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let of_instance = |instance: &Instance| {
        let mesh = &scene.meshes[instance.mesh];
        let corner = |i: u32| {
            let position = mesh.positions[i as usize].as_dvec3();
            instance.placement.transform_point3(position)
        };
        let triangles = mesh.triangles.iter();
        triangles.map(|t| t.map(corner)).collect::<Vec<_>>()
    };
    scene.instances.iter().flat_map(of_instance).collect()
}
