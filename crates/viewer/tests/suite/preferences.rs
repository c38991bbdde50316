//! The viewer's preferences between runs: nothing is lost, whatever is in the file.

use crate::support::random::Random;
use glam::dvec3;
use glimray::scene::{Camera, Lens, ToneCurve};
use glimray_viewer::model::bindings::{Action, Preset};
use glimray_viewer::model::overlays::Overlays;
use glimray_viewer::model::preferences::{
    MAX_CAMERAS, MAX_RECENT, Preferences, SavedCamera, Store, Theme,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn saved(name: &str) -> SavedCamera {
    SavedCamera {
        name: name.to_owned(),
        camera: Camera {
            look_from: dvec3(1.0 / 3.0, -2e-17, 1e9 / 7.0),
            look_at: dvec3(0.1, 0.2, 0.3),
            up: dvec3(0.0, 1.0, 1e-300),
            fov_y: 1.0 / 7.0,
            orthographic_height: Some(0.3),
            lens: Some(Lens {
                radius: 0.1,
                focus_distance: 10.0 / 3.0,
                blade_count: 5,
                blade_rotation: -0.7,
            }),
            clip: (0.25, f64::INFINITY),
            ..Camera::default()
        },
        picture: Some(String::from("ffd8").try_into().expect("digits")),
    }
}

/// Nothing in it is as by default.
fn changed(place: &Path) -> Preferences {
    let mut it = Preferences::default();
    it.theme = Theme::Light;
    it.ui_scale = 1.3;
    it.hint_seen = true;
    it.denoises_previews = false;
    it.samples = Some(777);
    it.tone = Some(ToneCurve::Agx);
    it.window = Some([1234.5, 777.0]);
    it.window_position = Some([-20.0, 31.0]);
    it.maximized = true;
    it.snaps = true;
    it.overlays = Overlays {
        outline: false,
        grid: true,
        wireframe: true,
        features: true,
        section: false,
        lamps: false,
        rays: false,
    };
    it.bindings.set_preset(Preset::Blender);
    let keys = vec!["Ctrl+U".parse().expect("a key")];
    it.bindings.set(Action::Undo, keys).expect("a key");
    it.bindings.set(Action::Quit, Vec::new()).expect("nothing");
    it.opened(&place.join("a \"scene\".toml"));
    it.opened(&place.join("b.obj"));
    it.save_camera(&place.join("b.obj"), saved("one"));
    it.save_camera(&place.join("b.obj"), saved("two"));
    // Keys that are no text in Rust.
    it.set_layout(Some(&BTreeMap::from([(7_u64, vec![Some(0.25_f32), None])])));
    it
}

/// The text of a file of [`changed`].
fn good_file(place: &Path) -> String {
    Store::in_folder(place)
        .save(&changed(place))
        .expect("a file");
    fs::read_to_string(place.join("viewer.toml")).expect("a file")
}

fn names(place: &Path) -> Vec<String> {
    let entries = fs::read_dir(place).expect("a folder");
    let mut names: Vec<_> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn what_is_kept_comes_back_to_the_last_bit() {
    let place = folder();
    let inner = place.path().join("not").join("yet there");
    let it = changed(place.path());
    Store::in_folder(&inner).save(&it).expect("a file");
    let (again, notes) = Store::in_folder(&inner).load();
    assert_eq!(notes, Vec::<String>::new());
    assert_eq!(again, it);
    let layout: BTreeMap<u64, Vec<Option<f32>>> = again.layout().expect("a layout");
    assert_eq!(layout[&7], [Some(0.25), None]);
    assert_eq!(again.layout::<String>(), None);
    assert_eq!(
        again.cameras_of(&place.path().join("b.obj")),
        [saved("one"), saved("two")]
    );
    assert_eq!(names(&inner), ["viewer.toml"]);
}

#[test]
fn the_first_run_has_the_defaults_and_nothing_to_say() {
    let place = folder();
    let (it, notes) = Store::in_folder(place.path()).load();
    assert_eq!((it, notes.len()), (Preferences::default(), 0));
    assert_eq!(names(place.path()), Vec::<String>::new());
}

#[test]
fn people_can_read_the_file() {
    let place = folder();
    let text = good_file(place.path());
    for line in [
        "theme = \"light\"",
        "ui_scale = 1.3",
        "tone = \"agx\"",
        "preset = \"blender\"",
        "undo = [\"Ctrl+U\"]",
        "quit = []",
        "fov_y = 0.14285714285714285",
    ] {
        assert!(text.contains(line), "{line} in\n{text}");
    }
}

#[test]
fn a_file_that_cannot_be_read_at_all_is_kept_under_another_name() {
    for (bytes, needle) in [
        (&b"theme = \"dark\"\nui_scale = = 2\n"[..], "line 2"),
        (&b"theme = \xff\n"[..], "UTF-8"),
        (&b"[bindings\n"[..], "line 1"),
    ] {
        let place = folder();
        let path = place.path().join("viewer.toml");
        fs::write(&path, bytes).expect("a file");
        let (it, notes) = Store::in_folder(place.path()).load();
        assert_eq!(it, Preferences::default());
        let [note] = &notes[..] else {
            panic!("one line: {notes:?}");
        };
        assert!(
            note.contains(needle) && note.contains("viewer.toml.bak"),
            "{note}"
        );
        assert!(!note.contains('\n'), "{note}");
        assert_eq!(
            fs::read(place.path().join("viewer.toml.bak")).expect("a copy"),
            bytes
        );
        let (_, notes) = Store::in_folder(place.path()).load();
        assert_eq!(notes, Vec::<String>::new(), "the new file is whole");
    }
}

#[test]
fn one_bad_setting_costs_nothing_but_itself() {
    let place = folder();
    let good = good_file(place.path());
    let whole = changed(place.path());
    type Repair = fn(&mut Preferences);
    let rows: [(&str, &str, &str, Repair); 17] = [
        ("theme = \"light\"", "theme = \"pink\"", "`pink`", |it| {
            it.theme = Theme::System
        }),
        ("theme = \"light\"", "theme = 3", "`theme`", |it| {
            it.theme = Theme::System
        }),
        ("ui_scale = 1.3", "ui_scale = 40.0", "`ui_scale`", |it| {
            it.ui_scale = 1.0
        }),
        ("ui_scale = 1.3", "ui_scale = nan", "`ui_scale`", |it| {
            it.ui_scale = 1.0
        }),
        ("samples = 777", "samples = 0", "`samples`", |it| {
            it.samples = None
        }),
        ("tone = \"agx\"", "tone = \"filmic\"", "`filmic`", |it| {
            it.tone = None
        }),
        ("window = [", "window = [0.0, ", "`window`", |it| {
            it.window = None
        }),
        (
            "window_position = [",
            "window_position = [nan, ",
            "`window_position`",
            |it| it.window_position = None,
        ),
        ("maximized = true", "maximized = 1", "`maximized`", |it| {
            it.maximized = false
        }),
        ("snaps = true", "snaps = 1", "`snaps`", |it| {
            it.snaps = false
        }),
        ("grid = true", "grid = \"fine\"", "`grid`", |it| {
            it.overlays.grid = false
        }),
        ("grid = true", "net = true", "`net`", |it| {
            it.overlays.grid = false
        }),
        ("preset = \"blender\"", "preset = \"vi\"", "`vi`", |it| {
            it.bindings.set_preset(Preset::Glimray);
        }),
        (
            "undo = [\"Ctrl+U\"]",
            "undo = [\"Strg+U\"]",
            "Strg+U",
            |it| {
                it.bindings.reset(Action::Undo);
            },
        ),
        ("undo = [\"Ctrl+U\"]", "undo = 5", "`undo`", |it| {
            it.bindings.reset(Action::Undo)
        }),
        (
            "hint_seen = true",
            "hint_seen = true\nfuture = 1",
            "`future`",
            |_| {},
        ),
        (
            "fov_y = 0.14285714285714285",
            "fov_y = 4.0",
            "`fov_y`",
            |it| {
                let cameras = it.cameras.values_mut().next().expect("cameras");
                cameras.remove(0);
            },
        ),
    ];
    for (from, to, needle, repair) in rows {
        let place = folder();
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        fs::write(place.path().join("viewer.toml"), &text).expect("a file");
        let (it, notes) = Store::in_folder(place.path()).load();
        let mut expected = whole.clone();
        repair(&mut expected);
        assert_eq!(it, expected, "{to}");
        assert!(
            notes.len() == 1 && notes[0].contains(needle),
            "{to}: {notes:?}"
        );
        let kept = fs::read_to_string(place.path().join("viewer.toml.bak")).expect("a copy");
        assert_eq!(kept, text, "{to}");
        let (again, notes) = Store::in_folder(place.path()).load();
        assert_eq!((again, notes.len()), (it, 0), "{to}");
    }
}

#[test]
fn no_file_is_so_broken_that_reading_it_fails_or_loses_it() {
    let place = folder();
    let good = good_file(place.path()).into_bytes();
    let mut random = Random::new(3);
    for i in 0..150 {
        let place = folder();
        let mut bytes = good.clone();
        match i % 3 {
            0 => bytes.truncate(random.below(good.len())),
            1 => {
                for _ in 0..4 {
                    let at = random.below(bytes.len());
                    bytes[at] = random.word() as u8;
                }
            }
            _ => {
                let at = random.below(bytes.len());
                bytes.drain(at..(at + 30).min(good.len()));
            }
        }
        fs::write(place.path().join("viewer.toml"), &bytes).expect("a file");
        let (it, notes) = Store::in_folder(place.path()).load();
        let kept = fs::read(place.path().join("viewer.toml.bak"));
        assert_eq!(kept.is_ok(), !notes.is_empty(), "{notes:?}");
        assert!(kept.is_err() || kept.is_ok_and(|kept| kept == bytes));
        let (again, notes) = Store::in_folder(place.path()).load();
        assert_eq!((again, notes), (it, Vec::new()));
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error_in_one_line() {
    let place = folder();
    let file = place.path().join("file");
    fs::write(&file, "in the way").expect("a file");
    for in_the_way in [file.clone(), file.join("below")] {
        let mut store = Store::in_folder(&in_the_way);
        let error = store.save(&Preferences::default()).expect_err("no folder");
        let text = error.to_string();
        assert!(text.contains("file") && !text.contains('\n'), "{text}");
        assert!(text.contains("GLIMRAY_SETTINGS"), "{text}");
    }
    assert_eq!(fs::read_to_string(&file).expect("a file"), "in the way");
    // A folder in the place of the file.
    fs::create_dir(place.path().join("viewer.toml")).expect("a folder");
    let mut store = Store::in_folder(place.path());
    let (it, notes) = store.load();
    assert_eq!((it, notes.len()), (Preferences::default(), 1));
    assert!(store.save(&changed(place.path())).is_err());
}

#[cfg(unix)]
#[test]
fn a_file_that_cannot_be_opened_is_put_aside_and_not_replaced() {
    let place = folder();
    let path = place.path().join("viewer.toml");
    // A link to itself cannot be opened, whoever tries.
    std::os::unix::fs::symlink(&path, &path).expect("a link");
    let mut store = Store::in_folder(place.path());
    let (it, notes) = store.load();
    assert_eq!((it, notes.len()), (Preferences::default(), 1));
    assert!(notes[0].contains("viewer.toml.bak"), "{notes:?}");
    store.save(&changed(place.path())).expect("a new file");
    assert_eq!(names(place.path()), ["viewer.toml", "viewer.toml.bak"]);
    let kept = fs::read_link(place.path().join("viewer.toml.bak"));
    assert_eq!(kept.expect("the old one"), path);
}

#[test]
fn a_reset_keeps_every_earlier_file() {
    let place = folder();
    let mut texts = Vec::new();
    for scale in [1.5, 2.5] {
        let mut store = Store::in_folder(place.path());
        let mut it = store.load().0;
        it.ui_scale = scale;
        store.save(&it).expect("a file");
        texts.push(fs::read_to_string(place.path().join("viewer.toml")).expect("a file"));
        assert_eq!(store.reset().expect("a reset"), Preferences::default());
        assert_eq!(store.load(), (Preferences::default(), Vec::new()));
    }
    assert_eq!(
        names(place.path()),
        ["viewer.toml", "viewer.toml.bak", "viewer.toml.bak2"]
    );
    for (name, text) in ["viewer.toml.bak", "viewer.toml.bak2"].iter().zip(texts) {
        assert_eq!(
            fs::read_to_string(place.path().join(name)).expect("a file"),
            text
        );
    }
}

#[cfg(unix)]
#[test]
fn what_did_not_change_is_not_written() {
    use std::os::unix::fs::MetadataExt;
    let place = folder();
    good_file(place.path());
    let file = || {
        fs::metadata(place.path().join("viewer.toml"))
            .expect("a file")
            .ino()
    };
    let before = file();
    let mut store = Store::in_folder(place.path());
    let (mut it, _) = store.load();
    store.save(&it).expect("a file");
    assert_eq!(file(), before);
    it.hint_seen = false;
    store.save(&it).expect("a file");
    assert_ne!(file(), before);
}

#[test]
fn recent_files_are_few_and_each_is_there_once() {
    let place = folder();
    let scene = |i: usize| place.path().join(format!("{i}.toml"));
    let mut it = Preferences::default();
    for i in 0..3 * MAX_RECENT {
        it.opened(&scene(i % (MAX_RECENT + 3)));
    }
    let whole = fs::canonicalize(place.path()).unwrap_or_else(|_| place.path().into());
    let last = 3 * MAX_RECENT - 1;
    let expected: Vec<PathBuf> = (0..MAX_RECENT)
        .map(|age| scene((last - age) % (MAX_RECENT + 3)))
        .collect();
    assert_eq!(it.recent, expected, "{whole:?}");
    it.opened(&scene((last - 4) % (MAX_RECENT + 3)));
    assert_eq!(it.recent.len(), MAX_RECENT);
    assert_eq!(it.recent[0], expected[4]);
    assert_eq!(it.recent[1..5], expected[..4]);
    // A known file by another path.
    fs::write(scene(0), "").expect("a file");
    fs::create_dir(place.path().join("sub")).expect("a folder");
    it.opened(&scene(0));
    let count = it.recent.len();
    it.opened(&place.path().join("sub").join("..").join("0.toml"));
    assert_eq!(it.recent.len(), count);
}

#[test]
fn kept_cameras_are_replaced_by_name_and_bounded() {
    let scene = Path::new("/somewhere/else.toml");
    let mut it = Preferences::default();
    it.save_camera(scene, saved("a"));
    it.save_camera(scene, saved("b"));
    let mut other = saved("a");
    other.camera.fov_y = 0.5;
    it.save_camera(scene, other.clone());
    assert_eq!(it.cameras_of(scene), [other, saved("b")]);
    for i in 0..MAX_CAMERAS {
        it.save_camera(scene, saved(&format!("{i}")));
    }
    assert_eq!(it.cameras_of(scene).len(), MAX_CAMERAS);
    assert_eq!(it.cameras_of(scene)[0].name, "0");
    for i in 0..MAX_CAMERAS {
        it.remove_camera(scene, &format!("{i}"));
    }
    assert!(it.cameras.is_empty());
}
