//! The stages of a scene that is opened: in order, shown, cancelled.

use crate::harness::Window;
use crate::reference::compare::render;
use crate::support::PATIENCE;
use egui_kittest::kittest::{Queryable, by};
use glimray::gpu::{AdapterChoice, Gpu};
use glimray::import::Options;
use glimray::pack;
use glimray::render::{ExecutionPolicy, Integrator, RenderSettings, Tone};
use glimray::scene::Scene;
use glimray_viewer::actions::files;
use glimray_viewer::model::loader::{self, Loaded};
use glimray_viewer::worker::progressive_image::{PictureSlot, ProgressiveImage};
use glimray_viewer::worker::render_thread::{RenderRequests, RenderThread};
use glimray_viewer::worker::request::{PreparedScene, RenderRequest};
use glimray_viewer::worker::stage::Stage;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, mpsc};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A folder with `scene.toml`, which refers to a square of `side` × `side` cells of two triangles each.
struct Folder(TempDir);

impl Folder {
    fn new(side: usize) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = "[camera]\nlook_from = [0.5, 0.5, 2]\nlook_at = [0.5, 0.5, 0]\n\n\
                     [[lights]]\npoint = { position = [0, 0, 4], color = [1, 1, 1], intensity = 30 }\n\n\
                     [[objects]]\nmesh = { file = \"grid.obj\" }\n";
        std::fs::write(folder.path().join("scene.toml"), scene).expect("a file");
        let mut grid = String::new();
        let end = side as f64;
        for row in 0..=side {
            for column in 0..=side {
                let (x, y) = (column as f64 / end, row as f64 / end);
                writeln!(grid, "v {x} {y} {}", 0.1 * (9.0 * x).sin()).expect("text");
            }
        }
        for row in 0..side {
            for column in 0..side {
                let a = row * (side + 1) + column + 1;
                let (b, c, d) = (a + 1, a + side + 1, a + side + 2);
                writeln!(grid, "f {a} {b} {d}\nf {a} {d} {c}").expect("text");
            }
        }
        std::fs::write(folder.path().join("grid.obj"), grid).expect("a file");
        Self(folder)
    }

    fn scene(&self) -> PathBuf {
        self.0.path().join("scene.toml")
    }
}

/// Loads until `last`, which is then cancelled. Returns the stages, and the result.
fn load(folder: &Folder, last: Option<usize>) -> (Vec<String>, Option<Loaded>) {
    let stages = Mutex::new(Vec::new());
    let loaded = loader::load(&folder.scene(), &Options::default(), &|stage| {
        let mut stages = stages.lock().expect("stages");
        stages.push(stage.to_string());
        last.is_none_or(|last| stages.len() < last)
    });
    (stages.into_inner().expect("stages"), loaded)
}

#[test]
fn a_scene_with_a_mesh_is_read_imported_and_given_its_bvh() {
    let (stages, loaded) = load(&Folder::new(30), None);
    let expected = [
        "Reading scene.toml",
        "Importing scene.toml",
        "Reading grid.obj",
        "Importing grid.obj",
        "Building the BVH (1,800 triangles)",
    ];
    assert_eq!(stages, expected);
    let outcome = loaded.expect("a result").outcome;
    let imported = outcome.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    assert_eq!(imported.scene.triangle_count(), 1800);
    assert_eq!(imported.packed.baked_triangle_count, 1800);
}

#[test]
fn a_cancelled_import_builds_no_bvh() {
    let (stages, loaded) = load(&Folder::new(2), Some(5));
    assert_eq!(stages.len(), 5);
    assert!(loaded.is_none(), "it was cancelled at {stages:?}");
}

fn request(scene: Arc<Scene>) -> RenderRequest {
    RenderRequest {
        settings: RenderSettings {
            size: (32, 24),
            ..RenderSettings::default()
        },
        scene,
        restarts: 0,
        camera: None,
        background: None,
        shutter_interval: (0.0, 0.0),
        policy: ExecutionPolicy::default(),
        tone: Tone::LINEAR,
        layer: glimray_app::layers::PictureLayer::Beauty,
        denoises_previews: false,
        false_color: false,
    }
}

/// The names of stages, each once in a row, and without the share of samples.
fn names(stages: &Mutex<Vec<Stage>>) -> Vec<String> {
    let stages = std::mem::take(&mut *stages.lock().expect("stages"));
    let name = |stage: Stage| match stage {
        Stage::FirstSamples { .. } => "First samples".to_owned(),
        stage => stage.to_string(),
    };
    let mut names: Vec<String> = stages.into_iter().map(name).collect();
    names.dedup();
    names
}

#[test]
fn the_first_picture_waits_for_uploads_shaders_and_samples() {
    let (_, loaded) = load(&Folder::new(30), None);
    let outcome = loaded.expect("a result").outcome;
    let imported = outcome.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let scene = Arc::new(imported.scene);
    let prepared = PreparedScene {
        scene: scene.clone(),
        packed: imported.packed,
    };
    let request = request(scene.clone());
    for prepared in [Some(&prepared), None] {
        let stages = Arc::new(Mutex::new(Vec::new()));
        let report = {
            let stages = stages.clone();
            Arc::new(move |stage| stages.lock().expect("stages").push(stage))
        };
        // A device of its own has compiled nothing yet.
        let gpu = Gpu::new(&AdapterChoice::default()).expect("an adapter");
        let mut picture = ProgressiveImage::new(gpu, PictureSlot::Main, report);
        let mut settle = |request: &RenderRequest, prepared: Option<&PreparedScene>| {
            let outcome = picture.set_request(Some(request), false, prepared);
            outcome.expect("a picture");
            let start = Instant::now();
            while !picture.is_done() {
                assert!(start.elapsed() < PATIENCE, "never done");
                picture.step(false).expect("a step");
            }
        };
        settle(&request, prepared);
        let mut expected = vec![
            "Uploading to the device",
            "Compiling shaders",
            "First samples",
            // The kernel that puts the picture on the screen.
            "Compiling shaders",
        ];
        if prepared.is_none() {
            expected.insert(0, "Building the BVH (1,800 triangles)");
        }
        assert_eq!(names(&stages), expected);
        // The picture that is there stays while the scene is edited.
        let edited = Scene {
            ambient: scene.ambient * 2.0,
            ..Scene::clone(&scene)
        };
        settle(&self::request(Arc::new(edited)), prepared);
        assert_eq!(names(&stages), [""; 0]);
    }
    let packed = pack::scene(&scene).expect("a packed scene");
    assert_eq!(packed.work, prepared.packed.work);
}

#[test]
fn the_render_thread_tells_its_stage_until_there_is_a_picture() {
    let folder = Folder::new(2);
    let (_, loaded) = load(&folder, None);
    let outcome = loaded.expect("a result").outcome;
    let imported = outcome.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let gpu = Gpu::new(&AdapterChoice::default()).expect("an adapter");
    // The thread waits at each wake-up until its stage has been read: polling would miss short stages.
    let (wake, wakes) = mpsc::sync_channel(0);
    let thread = RenderThread::new(gpu, move || {
        if wake.send(()).is_ok() {
            let _ = wake.send(());
        }
    });
    let thread: RenderThread<()> = thread.expect("a thread");
    // Dropped before the thread, which then waits no longer.
    let wakes = wakes;
    let stage = || {
        wakes.recv_timeout(Duration::from_millis(1)).ok()?;
        let activity = thread.activity();
        wakes.recv().expect("the end of a wake-up");
        activity
    };
    assert_eq!(thread.activity(), None);
    let mut requests = RenderRequests::default();
    requests.pictures[PictureSlot::Main as usize] = Some(request(Arc::new(imported.scene)));
    let start = Instant::now();
    thread.submit(requests);
    let mut seen = Vec::new();
    while !thread.is_settled() {
        assert!(start.elapsed() < PATIENCE, "never settled");
        if let Some(activity) = stage() {
            assert!(activity.since >= start);
            seen.push(activity.stage);
        }
    }
    assert!(seen.contains(&Stage::CompilingShaders), "{seen:?}");
    assert_eq!(thread.activity(), None);
    // Recording rays needs another kernel; after that there is nothing left to wait for.
    thread.ask(|frame| {
        let tree = frame.renderer.explain([16, 12], 0..1);
        assert_eq!(tree.expect("rays").samples.len(), 1);
    });
    let start = Instant::now();
    while thread.answers().is_empty() {
        assert!(start.elapsed() < PATIENCE, "no answer");
        let _ = stage();
    }
    assert_eq!(thread.activity(), None);
}

fn has(window: &Window, words: &str) -> bool {
    let mut found = window.harness.query_all(by().label_contains(words));
    found.next().is_some()
}

#[test]
fn loading_is_shown_over_the_picture_and_in_the_status_bar_and_can_be_cancelled() {
    let folder = Folder::new(300);
    let path = folder.scene();
    let mut window = Window::open(&[path.to_str().expect("a name"), "--size", "64x48"]);
    window.harness.run_steps(2);
    let told = (window.harness).query_all(by().label_contains("Loading scene.toml"));
    assert_eq!(told.count(), 2, "in the picture and in the status bar");
    assert!(!has(&window, " of 0 samples") && !has(&window, "Preparing"));
    window.harness.get_by_label("Cancel loading").click();
    window.settle();
    assert!(window.session().scene().is_none());
    for words in ["Drop a scene or open one", "Cancelled loading scene.toml"] {
        assert!(has(&window, words), "no {words}");
    }
    assert!(!has(&window, "Loading scene.toml"));
}

#[test]
fn a_scene_that_is_not_loaded_after_all_leaves_the_one_that_is_open() {
    let folder = Folder::new(2);
    let mut window = Window::open(&["--size", "64x48", "--samples", "1"]);
    window.settle();
    let before = window.request();
    files::open(&mut window.session(), vec![folder.scene()]);
    files::cancel_loading(&mut window.session());
    window.settle();
    assert!(window.request() == before);
    assert_eq!(window.session().title(), "demo");
    assert!(window.shown().progress.is_done);
    let render = window.harness.state().render_thread();
    assert_eq!(render.activity(), None, "there is a picture");
    // The scene can still be opened.
    files::open(&mut window.session(), vec![folder.scene()]);
    window.settle();
    assert_eq!(window.session().title(), "scene.toml");
    assert_eq!(window.request().scene.triangle_count(), 8);
}

#[test]
fn a_picture_keeps_its_samples_when_the_drafts_of_its_trees_are_replaced() {
    let (_, loaded) = load(&Folder::new(363), None);
    let outcome = loaded.expect("a result").outcome;
    let imported = outcome.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    assert!(imported.packed.is_draft());
    let scene = Arc::new(imported.scene);
    let draft = PreparedScene {
        scene: scene.clone(),
        packed: imported.packed,
    };
    let refined = pack::refined(&draft.packed, &scene).expect("a packed scene");
    let refined = PreparedScene {
        scene: scene.clone(),
        packed: Arc::new(refined),
    };
    let mut request = request(scene);
    request.settings.samples = 1 << 20;
    let gpu = Gpu::new(&AdapterChoice::default()).expect("an adapter");
    let mut picture = ProgressiveImage::new(gpu, PictureSlot::Main, Arc::new(|_| ()));
    let ask = |picture: &mut ProgressiveImage, prepared: &PreparedScene| {
        let outcome = picture.set_request(Some(&request), false, Some(prepared));
        outcome.expect("a picture");
    };
    ask(&mut picture, &draft);
    let samples = |picture: &ProgressiveImage| {
        let shown = picture.shown().map(|shown| shown.progress);
        shown.map_or(0, |progress| progress.samples)
    };
    let start = Instant::now();
    while samples(&picture) < 2 || picture.is_awaited() {
        assert!(start.elapsed() < PATIENCE, "no samples");
        ask(&mut picture, &draft);
        picture.step(false).expect("a step");
    }
    let before = samples(&picture);
    let trees = |picture: &ProgressiveImage| picture.shown().map(|shown| shown.trees_built);
    let built = trees(&picture);
    // The refined scene is set again and again; the trees are replaced once.
    for _ in 0..3 {
        ask(&mut picture, &refined);
        picture.step(false).expect("a step");
        assert!(samples(&picture) >= before, "the picture has restarted");
        assert_eq!(trees(&picture), built.map(|built| built + 1));
    }
}

#[test]
fn a_picture_of_steps_is_that_of_the_usual_trees() {
    let (_, loaded) = load(&Folder::new(363), None);
    let outcome = loaded.expect("a result").outcome;
    let imported = outcome.unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let scene = Arc::new(imported.scene);
    let refined = pack::refined(&imported.packed, &scene).expect("a packed scene");
    let prepared = [imported.packed, Arc::new(refined)].map(|packed| PreparedScene {
        scene: scene.clone(),
        packed,
    });
    let mut request = request(scene);
    request.settings.integrator = Integrator::Heat;
    let gpu = Gpu::new(&AdapterChoice::default()).expect("an adapter");
    let mut picture = ProgressiveImage::new(gpu, PictureSlot::Main, Arc::new(|_| ()));
    let mut pictures = Vec::new();
    for prepared in &prepared {
        let outcome = picture.set_request(Some(&request), false, Some(prepared));
        outcome.expect("a picture");
        let start = Instant::now();
        while !picture.is_done() {
            assert!(start.elapsed() < PATIENCE, "never done");
            picture.step(false).expect("a step");
        }
        let image = picture.frame().expect("a frame").image(&Tone::LINEAR);
        pictures.push(image.expect("a picture").0);
    }
    let (usual, _) = render(&request.scene, &request.settings);
    assert!(pictures[0] != pictures[1], "the draft is the usual tree");
    assert!(pictures[1] == usual, "the steps of the draft are left");
}

#[test]
fn the_window_ends_with_the_usual_trees() {
    let folder = Folder::new(363);
    let path = folder.scene();
    let path = path.to_str().expect("a path");
    let mut window = Window::open(&[path, "--size", "32x24", "--samples", "2"]);
    window.settle();
    let session = window.session();
    let scene = session.scene().expect("a scene").clone();
    let prepared = session.prepared_scene().expect("a packed scene");
    assert!(!prepared.is_draft());
    let usual = pack::scene(&scene).expect("a packed scene");
    assert!(prepared.parts() == usual.parts(), "the bytes differ");
    drop(session);
    assert!(window.shown().progress.is_done);
}
