//! Films from the window: the frames of the command line, ended and gone on with.

use crate::harness::Window;
use crate::support::{PATIENCE, ROOT};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glimray::render::Integrator;
use glimray::scene::{Backdrop, ObjectRef};
use glimray_viewer::actions::files::{self, film};
use glimray_viewer::model::objects::Id;
use glimray_viewer::state::film::FilmDialog;
use glimray_viewer::state::jobs::JobState;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Width and height, and samples, on both sides of the comparison.
const SIZE: [u32; 2] = [32, 24];
const SAMPLES: u32 = 2;

struct Place {
    folder: TempDir,
    window: Window,
}

impl Place {
    fn open(scene: &str) -> Self {
        let path = format!("{ROOT}/assets/scenes/{scene}");
        let mut window = Window::open(&[&path, "--size", "64x48", "--samples", "1"]);
        window.settle();
        Self {
            folder: tempfile::tempdir().expect("a folder"),
            window,
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Opens the dialog by its keys, fills it in, and starts the film.
    fn film(&mut self, name: &str, fill: impl FnOnce(&mut FilmDialog)) {
        let path = self.path(name).display().to_string();
        let window = &mut self.window;
        (window.harness).key_press_modifiers(Modifiers::COMMAND, Key::F12);
        window.harness.run_steps(2);
        {
            let mut session = window.session();
            let dialog = session.files.film.as_mut().expect("a dialog");
            (dialog.path, dialog.size, dialog.samples) = (path, SIZE, SAMPLES);
            fill(dialog);
        }
        window.harness.run_steps(2);
        window.harness.get_by_label("Start").click();
        window.harness.run_steps(2);
        assert!(window.session().files.film.is_none(), "it does not start");
    }

    fn state(&self) -> JobState {
        let session = self.window.session.borrow();
        session
            .files
            .jobs
            .all()
            .last()
            .expect("a job")
            .state
            .clone()
    }

    fn wait(&mut self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !is_so(self) {
            assert!(start.elapsed() < PATIENCE, "{what}: {:?}", self.state());
            self.window.harness.step();
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn click(&mut self, label: &str) {
        self.window.harness.get_by_label(label).click();
        self.window.harness.run_steps(2);
    }
}

/// Runs the program that was built with these tests, as a person would.
fn glimray(arguments: &[&str]) {
    let own = std::env::current_exe().expect("a program");
    let folder = own.ancestors().nth(2).expect("the folder above deps");
    let output = Command::new(folder.join("glimray"))
        .args(arguments)
        .env("LP_NATIVE_VECTOR_WIDTH", "256")
        .output()
        .expect("the program: build all packages of the workspace");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
}

fn same_bytes(a: &Path, b: &Path) {
    assert!(
        fs::read(a).expect("a file") == fs::read(b).expect("a file"),
        "{a:?}"
    );
}

#[test]
fn frames_and_video_of_the_window_are_those_of_animate() {
    let mut place = Place::open("orbits.toml");
    let scene = format!("{ROOT}/assets/scenes/orbits.toml");
    for (own, name) in [("own_%04d.png", "cli_%04d.png"), ("own.mp4", "cli.mp4")] {
        place.film(own, |dialog| dialog.range = [2, 4]);
        place.wait("the film is done", |place| place.state() == JobState::Done);
        let path = place.path(name).display().to_string();
        glimray(&[
            "animate",
            &scene,
            "--frames",
            "2..4",
            "--size",
            "32x24",
            "--samples",
            "2",
            "-o",
            &path,
        ]);
    }
    for number in 2..=4 {
        let name = |side: &str| place.path(&format!("{side}_{number:04}.png"));
        same_bytes(&name("own"), &name("cli"));
    }
    same_bytes(&place.path("own.mp4"), &place.path("cli.mp4"));
    assert!(!place.path("own.mp4.frames").exists());
}

#[test]
fn a_film_that_was_cancelled_goes_on_with_the_frames_that_it_has() {
    let mut place = Place::open("orbits.toml");
    place.film("long.mp4", |dialog| {
        dialog.range = [0, 100];
        dialog.samples = 64;
    });
    let frames = place.path("long.mp4.frames");
    let first = frames.join("frame_0000.png");
    place.wait("a frame is done", |_| {
        frames.join("frame_0001.png").exists()
    });
    place.click("Cancel long.mp4");
    place.wait("it ends", |place| place.state() == JobState::Cancelled);
    assert!(!place.path("long.mp4").exists());
    let written = fs::metadata(&first).and_then(|file| file.modified());
    let written = written.expect("a frame");
    place.click("File");
    place.click("Jobs");
    place.click("Resume: long.mp4");
    place.wait("it goes on", |_| frames.join("frame_0003.png").exists());
    place.click("Cancel: long.mp4");
    place.wait("it ends again", |place| {
        place.state() == JobState::Cancelled
    });
    let again = fs::metadata(&first).and_then(|file| file.modified());
    assert_eq!(again.expect("a frame"), written, "it was rendered again");
}

#[test]
fn a_turntable_starts_with_this_view_and_goes_round_its_pivot() {
    let mut place = Place::open("spheres_and_triangles.scene");
    place.window.harness.key_press(Key::ArrowRight);
    place.window.settle();
    place.film("turn_%04d.png", |dialog| {
        (dialog.seconds, dialog.fps) = (1.0, 4.0);
    });
    place.wait("the film is done", |place| place.state() == JobState::Done);
    let frame = |number| {
        let path = place.path(&format!("turn_{number:04}.png"));
        image::open(path).map(image::DynamicImage::into_rgb8)
    };
    assert!(frame(3).is_ok() && frame(4).is_err(), "four frames");
    let still = place.path("still.png");
    let camera = place.window.camera();
    let text = |point: glam::DVec3| format!("{},{},{}", point.x, point.y, point.z);
    let scene = format!("{ROOT}/assets/scenes/spheres_and_triangles.scene");
    glimray(&[
        "render",
        &scene,
        &format!("--look-from={}", text(camera.look_from)),
        &format!("--look-at={}", text(camera.look_at)),
        &format!("--up={}", text(camera.up)),
        &format!("--fov-y={}", camera.fov_y.to_degrees()),
        "--size",
        "32x24",
        "--samples",
        "2",
        "-o",
        still.to_str().expect("a name"),
    ]);
    let still = image::open(&still).expect("a picture").into_rgb8();
    let first = frame(0).expect("a frame");
    let differences = first.as_raw().iter().zip(still.as_raw());
    let far = differences.filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(far <= first.as_raw().len() / 100, "{far} values differ");
    assert_ne!(first, frame(2).expect("a frame"), "nothing turns");
}

#[test]
fn a_film_without_numbers_or_folder_is_refused_in_words() {
    let mut place = Place::open("orbits.toml");
    (place.window.harness).key_press_modifiers(Modifiers::COMMAND, Key::F12);
    place.window.harness.run_steps(2);
    let refusal = |path: PathBuf| {
        let mut session = place.window.session();
        let dialog = session.files.film.as_mut().expect("a dialog");
        dialog.path = path.display().to_string();
        dialog.target().err()
    };
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let has = |refusal: Option<String>, words: &str| {
        let refusal = refusal.unwrap_or_default();
        assert!(refusal.contains(words), "{refusal}");
    };
    has(refusal(path("film.png")), "film_%04d.png");
    has(refusal(path("film.webm")), ".mp4");
    has(refusal(path("none/film.mp4")), "The folder does not exist");
    assert_eq!(refusal(path("film.gif")), None);
    place.click("PNG frames");
    let session = place.window.session();
    let dialog = session.files.film.as_ref().expect("a dialog");
    assert_eq!(dialog.typed(), path("film_%04d.png"));
}

#[test]
fn numbered_frames_that_exist_are_neither_proposed_nor_replaced_unasked() {
    let mut place = Place::open("orbits.toml");
    let path = |name: &str| place.folder.path().join(name);
    let (taken, free) = (path("film_1_0000.png"), path("film_2_%04d.png"));
    fs::write(&taken, "mine").expect("a file");
    let typed = path("film_1_%04d.png");
    (place.window.harness).key_press_modifiers(Modifiers::COMMAND, Key::F12);
    place.window.harness.run_steps(2);
    {
        let mut session = place.window.session();
        let dialog = session.files.film.as_mut().expect("a dialog");
        // Typed, so that only the question keeps the frames.
        dialog.path = typed.display().to_string();
        let asks = |dialog: &FilmDialog| {
            let target = dialog.target().expect("a target");
            dialog.must_ask(&target)
        };
        assert!(asks(dialog), "frames are replaced unasked");
        dialog.range[0] = 1;
        assert!(!asks(dialog), "nothing is replaced");
        // Any frame counts, not only the first.
        dialog.path = path("late_%04d.png").display().to_string();
        assert!(!asks(dialog), "there are no late frames");
        fs::write(path("late_0007.png"), "mine").expect("a file");
        dialog.range = [1, 6];
        assert!(!asks(dialog), "the film ends before the frame");
        dialog.range = [1, 7];
        assert!(asks(dialog), "the last frame is replaced unasked");
        dialog.range[0] = 0;
        dialog.path = free.display().to_string();
        assert!(!asks(dialog), "the name is free");
    }
    // A scene of that folder proposes the next name.
    let scene = place.path("film.toml");
    fs::copy(format!("{ROOT}/assets/scenes/orbits.toml"), &scene).expect("a file");
    files::open(&mut place.window.session(), vec![scene]);
    place.window.settle();
    film::open(&mut place.window.session());
    place.window.harness.run_steps(2);
    place.click("PNG frames");
    let session = place.window.session();
    let dialog = session.files.film.as_ref().expect("a dialog");
    assert_eq!(dialog.typed(), free);
}

#[test]
fn keys_under_the_dialog_do_nothing_but_escape_closes_it() {
    let mut place = Place::open("spheres_and_triangles.scene");
    let ball = Id::Object(ObjectRef::Shape(0));
    place.window.session().select(vec![ball]);
    let before = place.window.session().scene().cloned();
    (place.window.harness).key_press_modifiers(Modifiers::COMMAND, Key::F12);
    place.window.harness.run_steps(3);
    // A click beside the field leaves it.
    (place.window.harness.ctx).memory_mut(|memory| {
        if let Some(focused) = memory.focused() {
            memory.surrender_focus(focused);
        }
    });
    place.window.harness.run_steps(2);
    place.window.harness.key_press(Key::Delete);
    place.window.harness.run_steps(3);
    let after = place.window.session().scene().cloned();
    assert!(after == before, "the ball is deleted");
    assert!(place.window.session().files.film.is_some());
    place.window.harness.key_press(Key::Escape);
    place.window.harness.run_steps(3);
    assert!(place.window.session().files.film.is_none());
}

#[test]
fn another_frame_rate_keeps_the_times_of_the_range() {
    let place = Place::open("orbits.toml");
    let mut session = place.window.session();
    film::open(&mut session);
    let duration = session.playback.duration();
    let dialog = session.files.film.as_mut().expect("a dialog");
    let (fps, whole) = (dialog.fps, dialog.range);
    dialog.set_fps(2.5 * fps, duration);
    assert_eq!(dialog.range, [0, dialog.last_frame(duration)]);
    assert!(dialog.range[1] > 2 * whole[1], "{:?}", dialog.range);
    // By way of a rate at which all is one frame.
    dialog.set_fps(0.01, duration);
    dialog.set_fps(fps, duration);
    assert_eq!(dialog.range, whole);
    dialog.range = [4, 10];
    dialog.set_fps(0.01, duration);
    dialog.set_fps(2.5 * fps, duration);
    assert_eq!(dialog.range, [10, 25]);
}

#[test]
fn a_background_that_becomes_transparent_is_noticed_while_the_dialog_is_open() {
    let mut place = Place::open("orbits.toml");
    (place.window.harness).key_press_modifiers(Modifiers::COMMAND, Key::F12);
    place.window.harness.run_steps(2);
    let refusal = |place: &Place| {
        let session = place.window.session();
        let dialog = session.files.film.as_ref().expect("a dialog");
        dialog.target().err()
    };
    let path = place.path("film.mp4").display().to_string();
    (place.window.session().files.film.as_mut())
        .expect("a dialog")
        .path = path;
    assert_eq!(refusal(&place), None);
    {
        let mut session = place.window.session();
        session.view.settings.backdrop = Backdrop::Transparent;
        session.view.settings.integrator = Integrator::Path;
    }
    place.window.harness.run_steps(2);
    let why = refusal(&place).unwrap_or_default();
    assert!(why.contains("transparent"), "{why}");
}

#[test]
fn a_model_without_a_camera_is_filmed_as_the_command_line_shows_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("plank.obj");
    let text = "v -5 0 0\nv 5 0 0\nv 5 1 0\nv -5 1 0\nf 1 2 3 4\n";
    fs::write(&model, text).expect("a file");
    let model = model.display().to_string();
    let mut window = Window::open(&[&model, "--samples", "1"]);
    window.settle();
    assert!(window.session().is_fitted());
    let mut place = Place { folder, window };
    place.film("plank_%04d.png", |dialog| {
        (dialog.seconds, dialog.fps) = (0.5, 4.0);
    });
    place.wait("the film is done", |place| place.state() == JobState::Done);
    let still = place.path("still.png");
    let name = still.to_str().expect("a name");
    glimray(&[
        "render",
        &model,
        "--size",
        "32x24",
        "--samples",
        "2",
        "-o",
        name,
    ]);
    let still = image::open(&still).expect("a picture").into_rgb8();
    let first = image::open(place.path("plank_0000.png"));
    let first = first.expect("a frame").into_rgb8();
    let differences = first.as_raw().iter().zip(still.as_raw());
    let far = differences.filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(far <= first.as_raw().len() / 100, "{far} values differ");
}
