//! Scenes that do not come from a folder: the same scene, the same image, the same errors.

use super::{folder, without_folder};
use crate::support::verdict::Verdict;
use glimray::import::{self, Archive, FileError, ImportError, Memory, Options, Resolver};
use glimray::scene::Scene;
use insta::assert_snapshot;
use std::cell::RefCell;
use std::io::Write;
use std::path::{Path, PathBuf};

type Named = (&'static str, Vec<u8>);

/// A scene with a model that has materials and a texture, a mesh, points, and a background.
fn files() -> Vec<Named> {
    let scene = "background = { picture = 'sky.hdr' }\n\
        camera = { look_from = [0, 0, 5], look_at = [0, 0, 0] }\n\
        lights = [{ point = { position = [1, 2, 6] } }]\n\
        [[objects]]\nmesh = { file = 'models/quad.obj' }\n\
        [[objects]]\nmesh = { file = 'models/square.ply' }\ntransform = { translate = [1, 0, 0] }\n\
        [[objects]]\nsphere = { center = [0, 0, 0], radius = 0.2 }\nrepeat = { points = { file = 'models/square.ply' } }\n";
    let model = "mtllib materials/quad.mtl\nv -2 -1 0\nv 0 -1 0\nv 0 1 0\nv -2 1 0\nvt 0 0\nvt 1 0\n\
        vt 1 1\nvt 0 1\nusemtl painted\nf 1/1 2/2 3/3 4/4\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    let gradient =
        ::image::RgbImage::from_fn(4, 4, |x, y| [60 * x as u8, 60 * y as u8, 200].into());
    let sky =
        ::image::Rgb32FImage::from_fn(8, 4, |x, y| [x as f32 / 8.0, y as f32 / 4.0, 0.5].into());
    vec![
        ("scenes/a.toml", scene.into()),
        ("scenes/models/quad.obj", model.into()),
        (
            "scenes/models/materials/quad.mtl",
            "newmtl painted\nKd 1 1 1\nmap_Kd gradient.png\n".into(),
        ),
        (
            "scenes/models/materials/gradient.png",
            encoded(gradient, ::image::ImageFormat::Png),
        ),
        ("scenes/models/square.ply", ply.into()),
        ("scenes/sky.hdr", encoded(sky, ::image::ImageFormat::Hdr)),
    ]
}

fn encoded(image: impl Into<::image::DynamicImage>, format: ::image::ImageFormat) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).expect("encodes");
    bytes.into_inner()
}

fn from_memory(files: Vec<Named>, name: &str) -> Result<Scene, ImportError> {
    import::load_from(&Memory::from_iter(files), name, &Options::default())
}

#[test]
fn a_scene_from_memory_equals_the_one_from_a_folder() {
    let files = files();
    let named: Vec<_> = files
        .iter()
        .map(|(name, bytes)| (*name, &bytes[..]))
        .collect();
    let folder = folder(&named);
    let on_disk = import::load(&folder.path().join("scenes/a.toml")).expect("a scene");
    let in_memory = from_memory(files, "scenes/a.toml").expect("a scene");
    assert_eq!((on_disk.meshes.len(), on_disk.pictures.len()), (2, 2));
    assert_eq!(on_disk.skipped, Vec::<String>::new());
    assert!(on_disk == in_memory, "the scenes differ");
}

/// Each file is requested once, under the name that another file gives it.
/// Files in memory, and those that were read, in that order.
pub struct Recorded(pub Memory, pub RefCell<Vec<PathBuf>>);

impl Resolver for Recorded {
    fn resolve(&self, base: &Path, name: &Path) -> Result<PathBuf, FileError> {
        self.0.resolve(base, name)
    }

    fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        self.1.borrow_mut().push(path.to_owned());
        self.0.read(path, limit)
    }
}

#[test]
fn every_file_comes_from_the_resolver_and_is_read_once() {
    let mut files = files();
    files[0]
        .1
        .extend(b"[[objects]]\nmesh = { file = 'models/./quad.obj' }\n");
    let recorded = Recorded(Memory::from_iter(files.clone()), RefCell::default());
    import::load_from(&recorded, "scenes/a.toml", &Options::default()).expect("a scene");
    let mut read = recorded.1.into_inner();
    read.sort();
    let mut expected: Vec<_> = files.iter().map(|(name, _)| PathBuf::from(name)).collect();
    // As a mesh, and as points.
    expected.push("scenes/models/square.ply".into());
    expected.sort();
    assert_eq!(read, expected);
}

#[test]
fn names_are_refused_in_memory_as_in_a_folder() {
    let mut verdict = Verdict::on("refusals");
    for name in [
        "../m.obj",
        "a/../../m.obj",
        "..\\m.obj",
        "/etc/passwd",
        "C:\\m.obj",
        "http://example.org/m.obj",
        "a\0b.obj",
        "",
        ".",
        "gone.obj",
        "inner",
        "inner/gone.obj",
    ] {
        let scene = format!(
            "[[objects]]\nmesh = {{ file = {} }}\n",
            serde_json::json!(name)
        );
        let files = [("a.toml", scene.as_bytes()), ("inner/m.obj", b"v 0 0 0\n")];
        let folder = folder(&files);
        let on_disk = import::load(&folder.path().join("a.toml")).expect_err("a refusal");
        let memory = Memory::from_iter(files);
        let in_memory = import::load_from(&memory, "a.toml", &Options::default());
        let in_memory = in_memory.expect_err("a refusal").to_string();
        let on_disk = without_folder(&on_disk, folder.path());
        verdict.that(name, on_disk == in_memory, || {
            format!("{on_disk:?} and {in_memory:?}")
        });
    }
    verdict.close();
}

#[test]
fn a_scene_missing_from_memory_has_a_message() {
    let files = || {
        vec![
            ("a.toml", b"ambient = 3".to_vec()),
            ("sub/b.obj", Vec::new()),
        ]
    };
    let message = |name| {
        from_memory(files(), name)
            .expect_err("a refusal")
            .to_string()
    };
    let names = ["gone.toml", "../a.toml", "a.fbx", "a.toml", "sub/b.obj"];
    let lines: Vec<_> = names.iter().map(|name| message(name)).collect();
    assert_snapshot!(lines.join("\n"), @r##"
scene refused (gone.toml): `gone.toml` does not exist. Check the name and the folder.
scene refused (../a.toml): `../a.toml` points outside the scene folder. Name a file in it, or permit the other folder.
unknown scene format (a.fbx): the extension `.fbx` is not supported. Use a .toml, .scene, .nff, .obj, .gltf, .glb, .ply, .stl or .zip file; convert other models to one of these.
bad scene (a.toml:1:11): invalid type: integer `3`, expected a colour: [r, g, b] or "#rrggbb". See `glimray schema` for what is allowed.
bad model (sub/b.obj): the file is empty. Check that it was written completely.
"##);
}

#[test]
fn an_image_can_be_read_from_memory() {
    let memory = Memory::from_iter(files());
    let picture = import::picture_from(&memory, "scenes/sky.hdr").expect("a picture");
    assert_eq!((picture.width, picture.height), (8, 4));
    let missing = import::picture_from(&memory, "sky.hdr").expect_err("a refusal");
    assert_snapshot!(missing, @"picture refused (sky.hdr): `sky.hdr` does not exist. Check the name and the folder.");
}

/// A ZIP archive of some files, those with odd indices compressed.
fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (index, (name, bytes)) in files.iter().enumerate() {
        let method = match index % 2 {
            0 => zip::CompressionMethod::Stored,
            _ => zip::CompressionMethod::Deflated,
        };
        let options = zip::write::SimpleFileOptions::default().compression_method(method);
        writer.start_file(*name, options).expect("a file");
        writer.write_all(bytes).expect("written");
    }
    writer.finish().expect("an archive").into_inner()
}

#[test]
fn a_scene_from_an_archive_equals_the_one_from_memory() {
    let files = files();
    let named: Vec<_> = files
        .iter()
        .map(|(name, bytes)| (*name, &bytes[..]))
        .collect();
    let archive = Archive::new(zipped(&named)).expect("an archive");
    let names: Vec<_> = archive.names().map(Path::to_owned).collect();
    let mut expected: Vec<_> = named.iter().map(|(name, _)| PathBuf::from(name)).collect();
    expected.sort();
    assert_eq!(names, expected);
    let scene = import::load_from(&archive, "scenes/a.toml", &Options::default());
    assert!(scene.expect("a scene") == from_memory(files, "scenes/a.toml").expect("a scene"));
}

#[test]
fn bad_archives_are_refused() {
    let long = vec![7; 100_000];
    let bytes = zipped(&[
        ("../outside.toml", b"a"),
        ("/etc/outside.toml", b"a"),
        ("folder/long.bin", &long),
    ]);
    let archive = Archive::new(bytes.clone()).expect("an archive");
    let names: Vec<_> = archive.names().collect();
    assert_eq!(names, [Path::new("folder/long.bin")]);
    let long_file = Path::new("folder/long.bin");
    assert_eq!(archive.read(long_file, 100_000).expect("its bytes"), long);
    let too_long = archive.read(long_file, 99_999);
    assert!(matches!(
        too_long,
        Err(FileError::TooLong { length: 100_000 })
    ));
    let resolved = |name: &str| archive.resolve(Path::new("folder"), Path::new(name));
    assert_eq!(resolved("long.bin").expect("there"), long_file);
    // Up is allowed, but not out, even on a way back in.
    assert_eq!(resolved("../folder/long.bin").expect("there"), long_file);
    for outside in ["../../x", "../../folder/long.bin", "/folder/long.bin"] {
        assert!(
            matches!(resolved(outside), Err(FileError::Outside)),
            "{outside}"
        );
    }
    assert!(matches!(resolved("short.bin"), Err(FileError::Missing)));
    assert!(matches!(
        archive.resolve(Path::new(""), Path::new("folder")),
        Err(FileError::IsFolder)
    ));
    for cut in [0, 1, bytes.len() / 2, bytes.len() - 1] {
        assert!(Archive::new(bytes[..cut].to_vec()).is_err(), "cut at {cut}");
    }
}
