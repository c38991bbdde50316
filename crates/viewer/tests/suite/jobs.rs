//! Jobs: pictures that are rendered for files, one after the other and beside each other.

use crate::harness::Window;
use crate::support::PATIENCE;
use eframe::egui::{self, Key};
use egui_kittest::kittest::{Queryable, by};
use glimray_app::clock::Clock;
use glimray_app::sequence::Files;
use glimray_app::sequence::pattern::Pattern;
use glimray_io::output::Format;
use glimray_render::{ExecutionPolicy, RenderSettings};
use glimray_scene::{Scene, Shutter};
use glimray_viewer::actions::files::{self, film, pictures, show};
use glimray_viewer::model::file_manager::{self, FileManager};
use glimray_viewer::state::dialogs::Dialog;
use glimray_viewer::state::files::Intent;
use glimray_viewer::state::jobs::{JobState, Jobs, Written};
use glimray_viewer::worker::film::FilmRequest;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const BALL: &str = "ambient = [0.2, 0.2, 0.2]\n\n[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n\n\
    [[lights]]\npoint = { position = [2, 3, 4], color = [1, 1, 1], intensity = 30 }\n\n\
    [materials.red]\nphong = { diffuse = [0.8, 0.1, 0.1] }\n\n\
    [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\nmaterial = \"red\"\n\n\
    [output]\nsize = [48, 32]\nsamples = 2\n";

/// Enough samples for a render to last longer than a few frames of the window.
const LONG: u32 = 2048;

/// More than a render could finish while a test runs.
const ENDLESS: u32 = 65_536;

struct Place {
    folder: TempDir,
    window: Window,
}

impl Place {
    /// A window with a ball, in a folder of its own.
    fn open() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("one.toml");
        fs::write(&path, BALL).expect("a file");
        let mut window = Window::open(&[path.to_str().expect("a name")]);
        window.settle();
        Self { folder, window }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn click(&mut self, label: &str) {
        self.window.harness.get_by_label(label).click();
        self.window.harness.run_steps(2);
    }

    /// Renders a picture of twice the scene's size, which is another than that of the window.
    fn save_twice_the_size(&mut self, samples: u32) {
        self.window.session().view.paused = true;
        self.window.session().view.set_samples(samples);
        self.window.harness.key_press(Key::F12);
        self.window.harness.run_steps(2);
        self.click("Scene size ×2");
        self.window.harness.get_by_label("Save").click();
        self.window.harness.step();
    }

    /// The name in the sheet that asks for one.
    fn proposed(&mut self) -> String {
        self.window.harness.key_press(Key::F12);
        self.window.harness.run_steps(2);
        let session = self.window.session();
        let sheet = session.files.saving.as_ref().expect("a sheet");
        sheet.path.clone()
    }

    fn has(&self, words: &str) -> bool {
        let mut found = self.window.harness.query_all(by().label_contains(words));
        found.next().is_some()
    }

    fn wait(&mut self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !is_so(self) {
            assert!(start.elapsed() < PATIENCE, "{what}");
            self.window.harness.step();
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn has_notice(&self, words: &str) -> bool {
        let session = self.window.session.borrow();
        let mut all = session.messages.all().iter();
        all.any(|notice| notice.text.contains(words))
    }
}

fn is_png(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| bytes.starts_with(b"\x89PNG"))
}

#[test]
fn the_name_of_a_picture_that_is_being_rendered_is_not_proposed_again() {
    let mut place = Place::open();
    place.save_twice_the_size(ENDLESS);
    let first = place.path("one_1.png");
    assert!(!first.exists(), "the picture took no time");
    assert_eq!(
        place.proposed(),
        place.path("one_2.png").to_str().expect("a name")
    );
    place.window.session().files.jobs.cancel_lasting();
    place.window.settle();
}

#[test]
fn a_finished_picture_whose_name_is_taken_is_written_under_the_next() {
    let mut place = Place::open();
    place.save_twice_the_size(LONG);
    let (first, second) = (place.path("one_1.png"), place.path("one_2.png"));
    assert!(!first.exists(), "the picture took no time");
    fs::write(&first, "mine").expect("a file");
    place.wait("it is written", |place| is_png(&place.path("one_2.png")));
    place.window.settle();
    assert_eq!(fs::read(&first).expect("a file"), b"mine");
    assert_eq!(image::open(&second).expect("a picture").width(), 96);
    assert!(place.has_notice("one_2.png, because one_1.png exists by now"));
}

#[test]
fn the_status_bar_tells_of_a_render_and_cancels_it() {
    let mut place = Place::open();
    place.save_twice_the_size(ENDLESS);
    place.wait("it has begun", |place| {
        let session = place.window.session.borrow();
        let progress = session.files.jobs.active().next().expect("a job");
        progress.control.progress().share > 0.0
    });
    place.window.harness.step();
    assert!(place.has("one_1.png: ") && place.has(" %"));
    place.click("Cancel one_1.png");
    place.window.settle();
    assert!(!place.has("one_1.png: "));
    assert!(!place.path("one_1.png").exists());
}

#[test]
fn the_list_of_jobs_has_what_runs_and_what_is_done() {
    let mut place = Place::open();
    place.save_twice_the_size(2);
    place.window.settle();
    place.save_twice_the_size(ENDLESS);
    place.window.harness.run_steps(2);
    place.click("File");
    place.click("Jobs");
    assert!(place.has("saved: ") && place.has("one_1.png"));
    place
        .window
        .harness
        .get_by_label("Copy path: one_1.png")
        .click();
    place.window.harness.step();
    let commands = (place.window.harness.output().platform_output.commands).clone();
    let path = place.path("one_1.png").display().to_string();
    assert!(
        commands.contains(&egui::OutputCommand::CopyText(path)),
        "{commands:?}"
    );
    place.click("Cancel: one_2.png");
    place.window.settle();
    assert!(place.has("cancelled: "));
    place.click("Clear list");
    assert!(place.has("No jobs yet"));
}

#[test]
fn what_waits_for_a_picture_ends_with_its_scene() {
    let place = Place::open();
    for is_new in [false, true] {
        let mut session = place.window.session();
        session.view.paused = true;
        pictures::open(&mut session, false);
        let dialog = session.files.saving.as_mut().expect("a dialog");
        dialog.path = place.path("wait.png").display().to_string();
        pictures::save(&mut session, true);
        assert!(session.files.jobs.waiting().is_some());
        pictures::open(&mut session, false);
        film::open(&mut session);
        assert!(session.files.saving.is_some() && session.files.film.is_some());
        match is_new {
            true => files::go_on(&mut session, Intent::New),
            false => files::open_built_in(&mut session),
        }
        let job = session.files.jobs.all().last().expect("a job");
        assert!(matches!(job.state, JobState::Failed(_)), "{:?}", job.state);
        assert!(session.files.saving.is_none() && session.files.film.is_none());
    }
}

#[test]
fn a_film_that_is_written_is_forgotten_and_one_that_has_begun_is_not_ended_at_once() {
    let place = Place::open();
    let pattern = Pattern::parse(&place.path("film_%04d.png")).expect("a pattern");
    let film = |scene: &Arc<Scene>| FilmRequest {
        scene: scene.clone(),
        clock: Clock {
            fps: 24.0,
            shutter: Shutter::default(),
            end: None,
        },
        first: 0,
        count: 1,
        settings: RenderSettings::default(),
        tone: place.window.session().view.tone,
        policy: ExecutionPolicy::default(),
        files: Files::new(pattern.clone(), Format::Png, 90),
        video: None,
    };
    let mut jobs = Jobs::default();
    let scene = Arc::new(Scene::default());
    let begun = jobs.begin_film(Arc::new(film(&scene)));
    begun.control.begin();
    assert_eq!(begun.control.progress().seconds_left(), None);
    jobs.cancel(begun.id);
    assert_eq!(jobs.all()[0].state, JobState::Running, "its thread goes on");
    begun.sender.send(Ok(None)).expect("a job");
    jobs.update(|_| ());
    assert!(jobs.all()[0].can_resume() && Arc::strong_count(&scene) == 2);
    let again = jobs.run(begun.id);
    let written = Written {
        path: place.path("film_%04d.png"),
        message: String::new(),
    };
    again.sender.send(Ok(Some(written))).expect("a job");
    jobs.update(|_| ());
    assert_eq!(jobs.all()[0].state, JobState::Done);
    assert_eq!(Arc::strong_count(&scene), 1, "the scene is kept");
}

#[test]
fn closing_asks_about_a_picture_that_is_being_rendered() {
    let mut place = Place::open();
    place.save_twice_the_size(ENDLESS);
    let viewports = &mut place.window.harness.input_mut().viewports;
    let root = viewports.get_mut(&egui::ViewportId::ROOT);
    (root.expect("a window").events).push(egui::ViewportEvent::Close);
    place.window.harness.run_steps(3);
    assert!(place.has("one_1.png is not written yet."));
    place.click("Close without saving it");
    place.window.settle();
    assert!(!place.path("one_1.png").exists());
}

#[test]
fn a_saved_picture_is_shown_in_its_folder_from_its_message_and_from_the_list() {
    let mut place = Place::open();
    let (sender, shown) = std::sync::mpsc::channel();
    let manager = FileManager::new(move |path: &Path| {
        sender.send(path.to_owned()).expect("someone who waits");
        match path.extension().is_some_and(|ending| ending == "png") {
            true => Ok(()),
            false => Err("There is no desktop.".to_owned()),
        }
    });
    place.window.session().files.manager = manager;
    let file = PathBuf::from(place.proposed());
    let name = file
        .file_name()
        .expect("a name")
        .to_string_lossy()
        .into_owned();
    place.click("Save");
    place.window.settle();
    place.click(&format!("Show in folder: {name}"));
    let path = shown.recv_timeout(PATIENCE).expect("a file");
    assert_eq!(path, file);
    place.window.settle();
    place.window.session().dialogs.open(Dialog::Jobs);
    place.window.settle();
    place.click(&format!("Show {name} in its folder"));
    assert_eq!(shown.recv_timeout(PATIENCE), Ok(file.clone()));
    place.window.session().dialogs.close(Dialog::Jobs);
    place.window.settle();
    assert!(!place.has_notice("desktop"));

    // Without a desktop, there is one line. A file that is gone is not looked for.
    let other = place.path("one.toml");
    let ctx = place.window.harness.ctx.clone();
    show::in_folder(&mut place.window.session(), &other, &ctx);
    place.window.settle();
    assert!(place.has_notice("There is no desktop."));
    assert_eq!(shown.try_recv(), Ok(other));
    fs::remove_file(&file).expect("a file");
    show::in_folder(&mut place.window.session(), &file, &ctx);
    place.window.settle();
    assert!(place.has_notice("it does not exist any more"));
    assert!(shown.try_recv().is_err());
}

#[test]
#[cfg(target_os = "linux")]
fn a_file_manager_gets_the_address_of_a_file_and_else_its_folder() {
    let found = file_manager::commands(Path::new("/a b/c,d%é.png"));
    let programs: Vec<_> = found.iter().map(|(program, _)| *program).collect();
    assert_eq!(programs, ["dbus-send", "xdg-open"]);
    // RFC 3986: a space is %20, a comma %2C, a percent sign %25, and é is C3 A9 in UTF-8.
    let items = "array:string:file:///a%20b/c%2Cd%25%C3%A9.png";
    assert!(found[0].1.iter().any(|it| it == items), "{found:?}");
    assert_eq!(found[1].1, ["/a b"]);
}
