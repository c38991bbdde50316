//! Files in the window: dropped, watched, mended, saved; cameras as command lines.

use crate::harness::Window;
use crate::support::PATIENCE;
use eframe::egui;
use egui_kittest::kittest::{Queryable, by};
use glimray::image::{Image, ScreenImage};
use glimray::scene::Background;
use glimray_viewer::actions::files::{self};
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::model::messages::sentence;
use glimray_viewer::model::watch::Watch;
use glimray_viewer::state::files::Intent;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};
use tempfile::TempDir;

const SMALL: [&str; 4] = ["--size", "48x32", "--samples", "2"];

/// One sphere of this radius.
fn scene(radius: &str) -> String {
    format!(
        "ambient = [0.2, 0.2, 0.2]\n\n[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n\n\
         [[lights]]\npoint = {{ position = [2, 3, 4], color = [1, 1, 1], intensity = 30 }}\n\n\
         [materials.red]\nphong = {{ diffuse = [0.8, 0.1, 0.1] }}\n\n\
         [[objects]]\nsphere = {{ center = [0, 0, 0], radius = {radius} }}\nmaterial = \"red\"\n"
    )
}

/// A folder with files in it.
struct Folder(TempDir);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Self {
        let place = Self(tempfile::tempdir().expect("a folder"));
        for (name, text) in files {
            fs::write(place.path(name), text).expect("a file");
        }
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().canonicalize().expect("a folder").join(name)
    }

    fn open(&self, name: &str) -> Window {
        let path = self.path(name);
        let path = path.to_str().expect("a name");
        let mut window = Window::open(&[&[path], SMALL.as_slice()].concat());
        window.settle();
        window
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_files(window: &mut Window, paths: &[PathBuf]) {
    let files = paths
        .iter()
        .map(|path| Arc::new(Dropped(path.clone())) as _);
    window.harness.input_mut().dropped_files = files.collect();
    window.harness.step();
    window.settle();
}

/// Steps until it is so.
fn wait(window: &mut Window, what: &str, is_so: impl Fn(&Window) -> bool) {
    let start = Instant::now();
    while !is_so(window) {
        assert!(start.elapsed() < PATIENCE, "{what}");
        window.harness.step();
        std::thread::sleep(Duration::from_millis(5));
    }
    window.settle();
}

fn notices(window: &Window) -> Vec<String> {
    let session = window.session.borrow();
    session
        .messages
        .all()
        .iter()
        .map(|n| n.text.clone())
        .collect()
}

fn has_notice(window: &Window, words: &str) -> bool {
    notices(window).iter().any(|text| text.contains(words))
}

fn message(window: &Window) -> Option<String> {
    let session = window.session.borrow();
    session
        .files
        .broken
        .as_ref()
        .map(|b| b.trouble.message.clone())
}

fn title(window: &Window) -> String {
    window.session.borrow().title()
}

fn picture(window: &mut Window) -> Image {
    window.image(glimray::render::Tone::LINEAR)
}

/// Puts text in the place of a file in one step, as careful editors do.
fn replace(path: &Path, text: &str) {
    let beside = path.with_extension("part");
    fs::write(&beside, text).expect("a file");
    fs::rename(&beside, path).expect("a file that can be replaced");
}

#[test]
fn a_dropped_scene_is_opened_and_remembered() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    drop_files(&mut window, &[place.path("two.toml")]);
    assert_eq!(title(&window), "two.toml");
    let session = window.session.borrow();
    let recent: Vec<_> = session.preferences.recent.iter().collect();
    assert_eq!(recent, [&place.path("two.toml"), &place.path("one.toml")]);
}

#[test]
fn of_a_dropped_folder_the_first_scene_that_can_be_read_is_opened_and_said() {
    let files = [
        ("a.toml", "nonsense"),
        ("b.toml", &*scene("2")),
        ("c.toml", &*scene("3")),
    ];
    let place = Folder::new(&files);
    let mut window = Window::open(&SMALL);
    window.settle();
    drop_files(&mut window, &[place.path("")]);
    wait(&mut window, "b.toml is opened", |window| {
        title(window) == "b.toml"
    });
    assert!(has_notice(&window, "3 scenes"), "{:?}", notices(&window));
}

#[test]
fn what_cannot_be_read_is_one_notice_and_changes_nothing() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("notes.txt", "notes")]);
    let mut window = place.open("one.toml");
    let before = notices(&window).len();
    drop_files(&mut window, &[place.path("notes.txt")]);
    assert_eq!(title(&window), "one.toml");
    assert_eq!(notices(&window).len(), before + 1);
    assert!(has_notice(&window, "notes.txt"), "{:?}", notices(&window));
}

#[test]
fn a_dropped_picture_becomes_the_surroundings_and_can_be_undone() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let sky = Image {
        pixels: vec![[0.25, 0.5, 2.0, 1.0]; 2],
        ..Image::new(2, 1)
    };
    glimray::output::save(place.path("sky.exr"), &sky).expect("a picture");
    let mut window = place.open("one.toml");
    drop_files(&mut window, &[place.path("sky.exr")]);
    wait(&mut window, "the picture is read", |window| {
        has_notice(window, "sky.exr")
    });
    let scene = window.request().scene;
    assert!(matches!(scene.background, Background::Picture { .. }));
    let corner = picture(&mut window).pixel(0, 0).expect("a pixel");
    assert_eq!(corner, [0.25, 0.5, 2.0, 1.0]);
    assert!(window.session.borrow().has_changes());
}

#[test]
fn a_changed_file_is_read_again_and_the_camera_stays() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window
        .session()
        .controller
        .as_mut()
        .expect("a camera")
        .orbit_by(0.5, 0.2);
    window.session().view.tone.exposure_ev = 1.5;
    window.settle();
    let (camera, before) = (window.camera(), picture(&mut window));
    replace(&place.path("one.toml"), &scene("1.5"));
    wait(&mut window, "the scene is read again", |w| {
        has_notice(w, "Reloaded one.toml")
    });
    assert_eq!(window.camera(), camera);
    assert_eq!(window.session.borrow().view.tone.exposure_ev, 1.5);
    assert!(
        picture(&mut window) != before,
        "the larger sphere is not seen"
    );
}

#[test]
fn a_changed_file_that_the_scene_refers_to_is_read_again() {
    let obj = |x: &str| format!("v -1 -1 0\nv {x} -1 0\nv 0 1 0\nf 1 2 3\n");
    let text = scene("0.1") + "\n[[objects]]\nmaterial = \"red\"\nmesh = { file = \"tri.obj\" }\n";
    let place = Folder::new(&[("one.toml", &text), ("tri.obj", &obj("1"))]);
    let mut window = place.open("one.toml");
    assert_eq!(message(&window), None);
    let before = picture(&mut window);
    replace(&place.path("tri.obj"), &obj("1.9"));
    wait(&mut window, "the scene is read again", |w| {
        has_notice(w, "Reloaded one.toml")
    });
    assert!(
        picture(&mut window) != before,
        "the larger triangle is not seen"
    );
}

#[test]
fn a_broken_edit_shows_its_line_and_keeps_the_last_good_picture_until_it_is_mended() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let before = picture(&mut window);
    let broken = scene("1").replace("[0.8, 0.1, 0.1]", "[0.8, \"much\", 0.1]");
    replace(&place.path("one.toml"), &broken);
    wait(&mut window, "the error is shown", |window| {
        message(window).is_some()
    });
    let text = message(&window).expect("an error");
    let line = 1 + broken
        .lines()
        .position(|line| line.contains("much"))
        .expect("a line");
    assert!(text.contains(&format!("one.toml:{line}:")), "{text}");
    {
        let session = window.session.borrow();
        let shown = session
            .files
            .broken
            .as_ref()
            .and_then(|b| b.trouble.line.clone());
        let shown = shown.expect("the source line");
        assert_eq!(shown.number, line);
        assert!(shown.text.contains("\"much\""), "{shown:?}");
        assert!(shown.text[shown.span.clone()].contains("much"), "{shown:?}");
    }
    window.harness.get_by_label("Reload");
    assert!(
        picture(&mut window) == before,
        "the last good picture went away"
    );
    replace(&place.path("one.toml"), &scene("1"));
    wait(&mut window, "the error goes away", |window| {
        message(window).is_none()
    });
}

#[test]
fn a_folder_that_cannot_be_watched_is_told_in_words() {
    let (folder, path) = crate::edit::file();
    let mut window = crate::edit::open(&path, "64x48");
    let gone = folder.path().join("gone").join("balls.toml");
    let why = Watch::default().set_files(std::slice::from_ref(&gone), SystemTime::now(), || {});
    assert_eq!(why, Err("the folder does not exist".to_owned()));
    // Saved files are watched from then on.
    files::saved(&mut window.session(), vec![gone]);
    window.settle();
    let told = window.session().messages.current();
    let told: Vec<_> = told.iter().map(|it| it.text.as_str()).collect();
    let expected = "Cannot watch the scene's files: the folder does not exist. Reload the scene manually when they change.";
    assert!(told.contains(&expected), "{told:?}");
}

#[test]
fn a_deleted_file_is_one_notice_and_is_taken_up_when_it_comes_back() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let before = picture(&mut window);
    fs::remove_file(place.path("one.toml")).expect("a file");
    wait(&mut window, "it is said", |window| {
        has_notice(window, "was deleted")
    });
    assert!(picture(&mut window) == before, "the last picture went away");
    assert_eq!(message(&window), None);
    fs::write(place.path("one.toml"), scene("2")).expect("a file");
    wait(&mut window, "it is read again", |w| {
        has_notice(w, "Reloaded one.toml")
    });
    assert!(
        picture(&mut window) != before,
        "the larger sphere is not seen"
    );
}

#[test]
fn a_scene_that_was_broken_from_the_start_is_shown_when_it_is_mended() {
    let place = Folder::new(&[("one.toml", "[camera\n")]);
    let mut window = place.open("one.toml");
    assert!(message(&window).is_some_and(|text| text.contains("one.toml:1:")));
    replace(&place.path("one.toml"), &scene("1"));
    wait(&mut window, "the scene is shown", |w| {
        w.session.borrow().scene().is_some()
    });
    assert_eq!(message(&window), None);
}

#[test]
fn no_picture_is_saved_over_a_file_that_the_scene_reads() {
    let painted = "material = { phong = { diffuse = { picture = \"paint.png\" } } }";
    let text = scene("1").replace("material = \"red\"", painted);
    let place = Folder::new(&[("one.toml", &text)]);
    let paint = place.path("paint.png");
    let image = Image {
        width: 1,
        height: 1,
        pixels: vec![[1.0; 4]],
    };
    glimray::output::save(&paint, &image).expect("a picture");
    let before = fs::read(&paint).expect("a picture");
    let mut window = place.open("one.toml");
    window.harness.key_press(egui::Key::F12);
    window.harness.run_steps(3);
    let refusal = |window: &Window, path: &Path| {
        let mut session = window.session.borrow_mut();
        let dialog = session.files.saving.as_mut().expect("a sheet");
        dialog.path = path.to_string_lossy().into_owned();
        dialog.target().err()
    };
    let says = Some("The scene uses this file. Choose another name.".to_owned());
    assert_eq!(refusal(&window, &place.path("new.png")), None);
    assert_eq!(refusal(&window, &paint), says);
    window.harness.run_steps(3);
    window.harness.key_press(egui::Key::Enter);
    window.harness.run_steps(3);
    window.settle();
    assert!(fs::read(&paint).expect("a picture") == before);
}

#[test]
fn the_name_of_a_picture_is_under_the_keys_and_enter_saves_it() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window.harness.key_press(egui::Key::F12);
    window.harness.run_steps(2);
    let name = place.path("typed.png");
    window
        .harness
        .key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    let text = name.to_str().expect("a name").to_owned();
    window.harness.event(egui::Event::Text(text));
    window.harness.key_press(egui::Key::Enter);
    window.harness.step();
    wait(&mut window, "the picture is written", |_| name.exists());
    assert!(window.session().files.saving.is_none());
}

#[test]
fn a_picture_that_exists_is_replaced_only_when_the_person_agrees() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("one_1.png", "mine")]);
    let mut window = place.open("one.toml");
    window.harness.key_press(egui::Key::F12);
    window.harness.run_steps(2);
    let suggested = |window: &Window| {
        let session = window.session.borrow();
        let dialog = session.files.saving.as_ref().expect("a sheet");
        dialog.path.clone()
    };
    assert_eq!(
        suggested(&window),
        place.path("one_2.png").to_str().expect("a name")
    );
    let taken = place.path("one_1.png");
    window
        .session()
        .files
        .saving
        .as_mut()
        .expect("a sheet")
        .path = taken.display().to_string();
    window.harness.run_steps(2);
    assert!(
        window.harness.query_by_label("Save").is_none(),
        "it does not ask"
    );
    assert_eq!(fs::read(&taken).expect("a file"), b"mine");
    window.harness.get_by_label("Replace").click();
    window.harness.step();
    let is_picture = |path: &Path| fs::read(path).is_ok_and(|b| b.starts_with(b"\x89PNG"));
    wait(&mut window, "it is replaced", |_| is_picture(&taken));
}

#[test]
fn without_a_dialog_a_path_can_be_typed() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    window.session().files.dialogs = FileDialogs::answering(|_| Reply::Unavailable);
    window
        .harness
        .key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
    window.harness.run_steps(3);
    assert!(
        has_notice(&window, "No file dialog"),
        "{:?}",
        notices(&window)
    );
    window.harness.get_by_label("Path").focus();
    window.harness.step();
    let path = place.path("two.toml").display().to_string();
    window.harness.event(egui::Event::Text(path));
    window.harness.run_steps(2);
    window.harness.get_by_label("Open").click();
    window.harness.step();
    wait(&mut window, "two.toml is opened", |window| {
        title(window) == "two.toml"
    });
}

const FACET: &str = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
    endloop\nendfacet\nendsolid s\n";

#[test]
fn the_next_scene_of_the_folder_comes_after_this_one_and_round_the_end() {
    let files = [
        ("a.toml", &*scene("1")),
        ("b.toml", "nonsense"),
        ("c.toml", &*scene("3")),
        ("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("e.txt", "not a scene"),
        ("f.STL", FACET),
    ];
    let place = Folder::new(&files);
    let mut window = place.open("a.toml");
    let next = |window: &mut Window, key, expected: &str| {
        window
            .harness
            .key_press_modifiers(egui::Modifiers::COMMAND, key);
        window.harness.step();
        wait(window, expected, |window| title(window) == expected);
    };
    next(&mut window, egui::Key::PageDown, "c.toml");
    next(&mut window, egui::Key::PageDown, "d.obj");
    next(&mut window, egui::Key::PageDown, "f.STL");
    next(&mut window, egui::Key::PageDown, "a.toml");
    next(&mut window, egui::Key::PageUp, "f.STL");
}

#[test]
fn a_camera_copied_as_a_command_line_and_pasted_is_the_same_camera() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window
        .session()
        .controller
        .as_mut()
        .expect("a camera")
        .orbit_by(0.7, 0.3);
    window.settle();
    let camera = window.camera();
    let line = window.copied();
    assert!(line.starts_with("glimray render "), "{line}");
    window.harness.key_press(egui::Key::Home);
    window.settle();
    assert_ne!(window.camera().look_from, camera.look_from);
    window.harness.event(egui::Event::Paste(line));
    window.harness.step();
    window.settle();
    let pasted = window.camera();
    assert_eq!(pasted.look_from, camera.look_from);
    assert_eq!((pasted.look_at, pasted.up), (camera.look_at, camera.up));
}

#[test]
fn an_empty_clipboard_leaves_the_next_paste_to_text() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let ctx = window.harness.ctx.clone();
    files::paste_camera(&mut window.session(), &ctx);
    window.harness.run_steps(5);
    window.session().files.typed = Some(String::new());
    window.harness.run_steps(3);
    let text = "glimray render --look-from 9,9,9".to_owned();
    window.harness.event(egui::Event::Paste(text.clone()));
    window.harness.run_steps(2);
    assert_eq!(window.session().files.typed, Some(text));
    assert!(!has_notice(&window, "Pasted the camera"));
}

#[test]
fn kept_cameras_come_after_the_scenes_own_and_outlive_the_window() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let home = window.camera();
    window
        .session()
        .controller
        .as_mut()
        .expect("a camera")
        .orbit_by(0.7, 0.3);
    window.settle();
    let kept = window.camera();
    window.harness.key_press(egui::Key::K);
    window.settle();
    window.harness.key_press(egui::Key::CloseBracket);
    window.settle();
    assert_eq!(window.camera().look_from, home.look_from);
    window.harness.key_press(egui::Key::CloseBracket);
    window.settle();
    assert_eq!(window.camera().look_from, kept.look_from);
    glimray_viewer::actions::settings::write(&mut window.session());
    let text = fs::read_to_string(window.settings.path().join("viewer.toml")).expect("a file");
    assert!(text.contains("View 1"), "{text}");
}

#[test]
fn unsaved_changes_are_asked_about_before_another_scene_is_opened() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    window.settle();
    drop_files(&mut window, &[place.path("two.toml")]);
    assert_eq!(title(&window), "one.toml");
    window.harness.get_by_label("Cancel").click();
    window.harness.run_steps(2);
    assert_eq!(title(&window), "one.toml");
    drop_files(&mut window, &[place.path("two.toml")]);
    window.harness.get_by_label("Open without saving").click();
    window.harness.step();
    wait(&mut window, "two.toml is opened", |window| {
        title(window) == "two.toml"
    });
}

#[test]
fn edits_made_while_another_scene_is_read_are_asked_about() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    window.session().open(place.path("two.toml"));
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    window.settle();
    assert_eq!(title(&window), "one.toml");
    assert!(window.session().has_changes());
    window.harness.get_by_label("Open without saving").click();
    window.harness.step();
    wait(&mut window, "two.toml is opened", |window| {
        title(window) == "two.toml"
    });
}

#[test]
fn a_scene_is_opened_although_the_one_on_screen_changes_meanwhile() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    window.session().open(place.path("two.toml"));
    files::go_on(&mut window.session(), Intent::ReloadChanged);
    window.settle();
    assert_eq!(title(&window), "two.toml");
}

#[test]
fn what_the_command_line_says_of_a_scene_is_not_said_of_the_next() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let path = place.path("one.toml");
    let path = path.to_str().expect("a name");
    let flags = ["--look-from", "0,0,9", "--set"];
    let words = [
        &[path],
        SMALL.as_slice(),
        &flags,
        &["ambient=[0.5,0.5,0.5]"],
    ]
    .concat();
    let mut window = Window::open(&words);
    window.settle();
    files::go_on(&mut window.session(), Intent::Reload);
    window.settle();
    let shown = |window: &Window| {
        let session = window.session();
        let ambient = session.scene().expect("a scene").ambient.x;
        (session.camera().expect("a camera").look_from.z, ambient)
    };
    assert_eq!(shown(&window), (9.0, 0.5));
    drop_files(&mut window, &[place.path("two.toml")]);
    assert_eq!(shown(&window), (5.0, 0.2));
}

#[test]
fn a_crop_of_the_command_line_is_a_region_that_can_be_ended() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let path = place.path("one.toml");
    let path = path.to_str().expect("a name");
    let crop = ["--crop", "12,8,36,24"];
    let mut window = Window::open(&[&[path], SMALL.as_slice(), &crop].concat());
    window.settle();
    assert_eq!(window.request().settings.crop, Some([12, 8, 36, 24]));
    window.harness.key_press(egui::Key::B);
    window.settle();
    assert_eq!(window.request().settings.crop, None);
    let mut window = Window::open(&[&[path, "--samples", "1"], crop.as_slice()].concat());
    window.settle();
    assert!(window.request().settings.crop.is_some());
}

/// Stops the picture before it is finished, and wants it saved when it is.
fn save_later(window: &mut Window, paths: &[PathBuf]) {
    window.session().view.paused = true;
    window.session().view.set_samples(64);
    window.settle();
    for path in paths {
        let mut session = window.session();
        files::pictures::open(&mut session, false);
        let dialog = session.files.saving.as_mut().expect("a sheet");
        dialog.path = path.display().to_string();
        files::pictures::save(&mut session, true);
    }
    window.settle();
    assert!(window.session().files.waits_to_save());
}

#[test]
fn every_picture_that_waits_to_be_finished_is_written() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let paths = ["a.png", "b.png"].map(|name| place.path(name));
    save_later(&mut window, &paths);
    window.session().view.paused = false;
    wait(&mut window, "both are written", |_| {
        paths.iter().all(|path| path.exists())
    });
}

#[test]
fn a_picture_that_waits_is_not_made_of_another_scene() {
    let place = Folder::new(&[("one.toml", &scene("1")), ("two.toml", &scene("2"))]);
    let mut window = place.open("one.toml");
    let path = place.path("one.png");
    save_later(&mut window, std::slice::from_ref(&path));
    drop_files(&mut window, &[place.path("two.toml")]);
    assert_eq!(title(&window), "two.toml");
    assert!(has_notice(&window, "one.png was not saved"));
    assert!(!window.session().files.waits_to_save() && !path.exists());
}

/// Commands of the window to the desktop when the person closes it.
fn close(window: &mut Window) -> Vec<egui::ViewportCommand> {
    let viewports = &mut window.harness.input_mut().viewports;
    let root = viewports.get_mut(&egui::ViewportId::ROOT);
    (root.expect("a window").events).push(egui::ViewportEvent::Close);
    window.harness.step();
    let outputs = window.harness.output().viewport_output.values();
    outputs.flat_map(|output| output.commands.clone()).collect()
}

#[test]
fn a_minimised_window_comes_up_to_ask_about_unsaved_changes() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    let commands = close(&mut window);
    for command in [
        egui::ViewportCommand::CancelClose,
        egui::ViewportCommand::Minimized(false),
        egui::ViewportCommand::Focus,
    ] {
        assert!(commands.contains(&command), "{commands:?}");
    }
}

#[test]
fn closing_asks_about_a_picture_that_waits() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    assert!(!close(&mut window).contains(&egui::ViewportCommand::CancelClose));
    save_later(&mut window, &[place.path("one.png")]);
    assert!(close(&mut window).contains(&egui::ViewportCommand::CancelClose));
    window.harness.run_steps(2);
    window.harness.get_by_label("Close without saving it");
    assert!(window.harness.query_by_label("Save").is_none());
}

#[test]
fn closing_waits_for_a_picture_that_is_being_written() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    let path = place.path("one.png");
    {
        let mut session = window.session();
        files::pictures::open(&mut session, false);
        let dialog = session.files.saving.as_mut().expect("a sheet");
        dialog.path = path.display().to_string();
        files::pictures::save(&mut session, false);
    }
    let commands = close(&mut window);
    assert!(
        commands.contains(&egui::ViewportCommand::CancelClose),
        "{commands:?}"
    );
    window.settle();
    assert!(path.exists());
}

fn titles(window: &Window) -> Vec<String> {
    let outputs = window.harness.output().viewport_output.values();
    let commands = outputs.flat_map(|output| &output.commands);
    let titles = commands.filter_map(|command| match command {
        egui::ViewportCommand::Title(title) => Some(title.clone()),
        _ => None,
    });
    titles.collect()
}

#[test]
fn the_title_names_the_scene_and_marks_unsaved_changes() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window
        .session()
        .edit("brighten", |scene| scene.ambient *= 2.0);
    window.harness.step();
    assert_eq!(titles(&window), ["one.toml* · glimray"]);
}

#[test]
fn a_picture_saved_with_overlays_is_what_the_window_shows() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let mut window = place.open("one.toml");
    window.session().shows_overlays = false;
    window.session().preferences.hint_seen = true;
    let path = place.path("shot.png");
    glimray_viewer::actions::files::pictures::open(&mut window.session(), true);
    window
        .session()
        .files
        .saving
        .as_mut()
        .expect("a sheet")
        .path = path.display().to_string();
    window.harness.run_steps(2);
    window.harness.get_by_label("Save").click();
    window.harness.step();
    wait(&mut window, "the picture is written", |_| path.exists());
    let shot = image::open(&path).expect("a picture").into_rgb8();
    assert_eq!(shot.dimensions(), (48, 32));
    let tone = window.request().tone;
    let shown = window.image(tone);
    let levels = shown.pixels.iter().flat_map(|pixel| pixel[..3].to_vec());
    for (shot, level) in shot.as_raw().iter().zip(levels) {
        let expected = level.clamp(0.0, 1.0) * 255.0;
        assert!(
            (f32::from(*shot) - expected).abs() <= 1.5,
            "{shot} for {expected}"
        );
    }
}

#[test]
fn a_file_that_cannot_be_read_leaves_its_error_and_an_empty_window_that_says_so() {
    let place = Folder::new(&[("model.glb", "glTF"), ("one.toml", &scene("1"))]);
    let mut window = place.open("model.glb");
    let broken = window.session().files.broken.clone().expect("an error");
    assert!(broken.trouble.message.contains("model.glb"), "{broken:?}");
    window
        .harness
        .get_by_label(&sentence(&broken.trouble.message));
    let has = |window: &Window, words| {
        let mut found = window.harness.query_all(by().label_contains(words));
        found.next().is_some()
    };
    assert!(has(&window, "Drop a scene or open one"));
    assert!(has(&window, "Open…") && has(&window, "Built-in scene"));
    assert!(has(&window, "No scene is open"));
    assert!(!has(&window, "Preparing"), "it waits for nothing");
    assert!(!has(&window, "0 of 0 samples"));
    files::open(&mut window.session(), vec![place.path("one.toml")]);
    window.settle();
    assert!(window.shown().progress.is_done);
    assert!(!has(&window, "Drop a scene or open one"));
}

#[test]
fn while_a_scene_is_read_the_panel_names_it_and_counts_no_samples() {
    let place = Folder::new(&[("one.toml", &scene("1"))]);
    let path = place.path("one.toml");
    let window = Window::open(&[path.to_str().expect("a name")]);
    // The harness has drawn one frame, and nothing was taken up yet.
    let waiting = window.session().waiting_for();
    if window.session().scene().is_none() {
        assert!(
            waiting.starts_with("Loading ") && waiting.contains("one.toml"),
            "{waiting}"
        );
    }
    let mut found = (window.harness).query_all(by().label_contains("0 of 0 samples"));
    assert!(found.next().is_none());
}

#[test]
fn an_empty_window_offers_recent_files_and_the_built_in_scene() {
    let place = Folder::new(&[("model.glb", "glTF"), ("one.toml", &scene("1"))]);
    let mut window = place.open("model.glb");
    window.session().preferences.recent = vec![place.path("one.toml")];
    window.settle();
    window.harness.get_by_label("one.toml").click();
    window.settle();
    assert_eq!(window.session().path, Some(place.path("one.toml")));
    assert!(window.harness.query_by_label("Built-in scene").is_none());
    let mut window = place.open("model.glb");
    window.harness.get_by_label("Built-in scene").click();
    window.settle();
    let demo = glimray_app::showcase::scene().expect("the demo");
    let session = window.session();
    assert_eq!(session.scene().expect("a scene").as_ref(), &demo);
    assert_eq!(session.title(), "demo");
    assert!(session.files.broken.is_none());
}

#[test]
fn the_scenes_beside_this_one_are_shown_small_in_the_file_menu() {
    use glimray_viewer::state::neighbours::Preview;
    let place = Folder::new(&[
        ("a.toml", &*scene("1")),
        ("b.toml", &*scene("2")),
        ("c.toml", "nonsense"),
    ]);
    let mut window = place.open("a.toml");
    window.harness.get_by_label("File").click();
    window.harness.run_steps(3);
    let hover = |window: &mut Window, entry: &str| {
        let entry = window.harness.get(by().label_contains(entry));
        let at = entry.rect().center();
        window.harness.hover_at(at);
        // A tooltip waits until the pointer rests.
        for _ in 0..60 {
            window.harness.step();
        }
        window.settle();
        window.harness.run_steps(3);
    };
    hover(&mut window, "Next scene in folder");
    window.harness.get_by_label("Small picture of b.toml");
    let preview = |window: &Window, name: &str| {
        let session = window.session();
        session.files.neighbours.preview(&place.path(name))
    };
    let Preview::Picture(small) = preview(&window, "b.toml") else {
        panic!("there is no picture");
    };
    // The picture of the file itself, as far as its size tells.
    let options = glimray::PictureOptions {
        size: Some((small.width, small.height)),
        ..glimray::PictureOptions::default()
    };
    let whole = glimray::render_file(place.path("b.toml"), &options).expect("a picture");
    assert!(ScreenImage::from(&whole) == *small);
    hover(&mut window, "Previous scene in folder");
    assert_eq!(preview(&window, "c.toml"), Preview::Missing);
    assert_eq!(title(&window), "a.toml", "a scene is opened");
}
