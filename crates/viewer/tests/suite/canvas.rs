//! One picture that follows its orders: what restarts it and what does not, coarse and fine, whole and
//! in part; and that it is the command line's.

use super::pixels;
use crate::harness::Window;
use crate::reference::compare::{open_gpu, render, sized};
use crate::reference::scenes;
use crate::support::PATIENCE;
use eframe::egui;
use glam::{DAffine3, Vec3};
use glimray::gpu::Gpu;
use glimray::image::Image;
use glimray::import;
use glimray::render::{Antialias, ExecutionPolicy, Integrator, RenderSettings, Tone, Uploads};
use glimray::scene::{
    Background, Camera, LayerTextures, MetallicRoughness, Minify, Pattern, Picture, Scene, Space,
    Texels, Texture, ToneCurve, Wrap,
};
use glimray_viewer::worker::progressive_image::PictureSlot;
use glimray_viewer::worker::progressive_image::{Pace, Shown};
use glimray_viewer::worker::render_thread::{Fault, RenderRequests, RenderThread};
use glimray_viewer::worker::request::RenderRequest;
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

/// A render thread and what it was last told, without a window.
struct Easel {
    gpu: Gpu,
    thread: RenderThread<()>,
    requests: RenderRequests,
}

impl Easel {
    fn new(scene: &Scene, settings: RenderSettings) -> Self {
        let gpu = open_gpu();
        let thread = RenderThread::new(gpu.clone(), || {}).expect("a thread");
        let mut requests = RenderRequests::default();
        requests.pictures[PictureSlot::Main as usize] = Some(RenderRequest {
            scene: Arc::new(scene.clone()),
            restarts: 0,
            camera: None,
            background: None,
            shutter_interval: (0.0, 0.0),
            settings,
            policy: ExecutionPolicy::default(),
            tone: Tone::LINEAR,
            layer: glimray_app::layers::PictureLayer::Beauty,
            denoises_previews: false,
            false_color: false,
        });
        let easel = Self {
            gpu,
            thread,
            requests,
        };
        easel.thread.submit(easel.requests.clone());
        easel
    }

    /// Changes what is wanted.
    fn want(&mut self, change: impl FnOnce(&mut RenderRequest)) {
        let request = self.requests.pictures[PictureSlot::Main as usize].as_mut();
        change(request.expect("an order"));
        self.thread.submit(self.requests.clone());
    }

    fn pause(&mut self, paused: bool) {
        self.requests.paused = paused;
        self.thread.submit(self.requests.clone());
    }

    #[track_caller]
    fn wait_until(&self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !is_so(self) {
            assert_eq!(self.thread.fault(), None);
            assert!(start.elapsed() < PATIENCE, "never {what}");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[track_caller]
    fn settle(&self) {
        self.wait_until("settled", |easel| easel.thread.is_settled());
        assert_eq!(self.thread.fault(), None);
    }

    fn shown(&self) -> Shown {
        self.thread.shown(PictureSlot::Main).expect("a picture")
    }

    /// The picture in linear light.
    fn image(&self) -> Image {
        let (sender, receiver) = channel();
        self.thread.ask(move |frame| {
            let (image, _) = frame.image(&Tone::LINEAR).expect("a picture");
            sender.send(image).expect("someone who waits");
        });
        receiver.recv_timeout(PATIENCE).expect("the picture")
    }
}

fn stratified(samples: u32) -> RenderSettings {
    RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(61, 43)
    }
}

const PIXELS: u64 = 61 * 43;

#[test]
fn developing_otherwise_takes_no_new_samples() {
    let mut easel = Easel::new(&scenes::everything(), stratified(4));
    easel.settle();
    let before = easel.shown();
    let first = pixels::on(&before.screen.expect("a screen"), &easel.gpu);
    easel.want(|request| {
        request.tone.exposure_ev = 1.0;
        request.tone.curve = ToneCurve::Agx;
    });
    easel.settle();
    let after = easel.shown();
    assert_eq!(after.stats.samples, before.stats.samples);
    assert_eq!(after.stats.submissions, before.stats.submissions);
    assert!(after.progress.is_done, "{:?}", after.progress);
    let second = pixels::on(&after.screen.expect("a screen"), &easel.gpu);
    assert!(first != second, "the new tone is not on the screen");
}

#[test]
fn another_background_gives_the_picture_of_a_scene_that_has_it() {
    let adaptive = RenderSettings {
        samples: 16,
        antialias: Antialias::Adaptive,
        ..stratified(16)
    };
    for settings in [stratified(4), adaptive] {
        let scene = scenes::everything();
        let mut easel = Easel::new(&scene, settings.clone());
        easel.settle();
        let background = Background::Color(Vec3::new(0.1, 0.5, 0.2));
        easel.want(|request| request.background = Some(background.clone()));
        easel.settle();
        assert!(easel.shown().progress.is_done);
        let other = glimray::scene::Scene {
            background,
            ..scene
        };
        assert!(
            easel.image() == render(&other, &settings).0,
            "it is not the picture before the background"
        );
    }
}

#[test]
fn a_pause_does_not_show_in_the_picture() {
    let scene = scenes::everything();
    let settings = stratified(600);
    let mut easel = Easel::new(&scene, settings.clone());
    easel.wait_until("fine", |easel| {
        let shown = easel.thread.shown(PictureSlot::Main);
        shown.is_some_and(|shown| shown.screen.is_some() && shown.progress.samples > 0)
    });
    easel.pause(true);
    easel.settle();
    let held = easel.shown();
    assert!(held.progress.samples < 600, "it was done before the pause");
    easel.want(|request| request.tone.exposure_ev = -1.0);
    easel.settle();
    assert_eq!(
        easel.shown().stats.samples,
        held.stats.samples,
        "a paused picture goes on"
    );
    easel.pause(false);
    easel.settle();
    assert!(easel.shown().progress.is_done);
    assert!(
        easel.image() == render(&scene, &settings).0,
        "the pause shows"
    );
}

#[test]
fn a_paused_picture_that_is_still_coarse_answers_questions() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(4));
    easel.settle();
    easel.requests.paused = true;
    easel.want(|request| request.shutter_interval = (0.5, 0.5));
    easel.settle();
    assert!(easel.shown().progress.is_coarse);
    let image = easel.image();
    assert_eq!((image.width, image.height), (61, 43));
}

#[test]
fn a_question_that_must_wait_is_looked_at_once_for_each_wish() {
    const QUESTIONS: u32 = 20;
    let (wake, woken) = channel();
    let wake = move || _ = wake.send(());
    let thread = RenderThread::<()>::new(open_gpu(), wake).expect("a thread");
    for _ in 0..QUESTIONS {
        thread.ask(|_| ());
        woken
            .recv_timeout(PATIENCE)
            .expect("a look at the question");
    }
    // A thread that went on looking would do so all the while that this takes.
    render(&scenes::everything(), &stratified(4));
    let start = Instant::now();
    while !thread.is_settled() {
        assert!(start.elapsed() < PATIENCE, "never settled");
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(woken.try_iter().count(), 0, "looked at without a wish");
    assert_eq!(thread.answers().len(), 0);
}

#[test]
fn a_refused_order_passes_for_nothing_else_and_the_last_picture_stays() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(2));
    easel.settle();
    let done = easel.shown().stats.samples;
    easel.want(|request| {
        request.settings.size = (16384, 16384);
        request.policy.memory_limit_bytes = 1 << 20;
    });
    let is_refused = |easel: &Easel| matches!(easel.thread.fault(), Some(Fault::Refused(_)));
    let wait = |easel: &Easel| {
        let start = Instant::now();
        while !(easel.thread.is_settled() && is_refused(easel)) {
            assert!(start.elapsed() < PATIENCE, "{:?}", easel.thread.fault());
            std::thread::sleep(Duration::from_millis(1));
        }
    };
    wait(&easel);
    easel.want(|request| request.tone.exposure_ev = 1.0);
    wait(&easel);
    assert_eq!(easel.shown().size, (61, 43));
    easel.want(|request| {
        request.settings = stratified(2);
        request.policy = ExecutionPolicy::default();
        request.tone.exposure_ev = 0.0;
    });
    let start = Instant::now();
    while easel.thread.fault().is_some() || !easel.thread.is_settled() {
        assert!(start.elapsed() < PATIENCE, "still refused");
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(easel.shown().progress.is_done);
    assert!(easel.image() == render(&scene, &stratified(2)).0);
    assert_eq!(easel.shown().stats.samples, done, "it was traced again");
}

#[test]
fn more_samples_go_on_from_those_that_there_are() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(4));
    easel.settle();
    // The second lot ends where sums go into totals, the third begins there.
    let mut before = easel.shown().stats.samples;
    for (from, to) in [(4, 8), (8, 256), (256, 300)] {
        easel.want(|request| request.settings.samples = to);
        easel.settle();
        let now = easel.shown().stats.samples;
        assert_eq!(
            now - before,
            u64::from(to - from) * PIXELS,
            "{from} to {to}"
        );
        assert!(
            easel.image() == render(&scene, &stratified(to)).0,
            "{from} and {} more samples are not {to}",
            to - from
        );
        before = now;
    }
}

#[test]
fn fewer_samples_and_adaptive_ones_are_those_of_the_command_line_too() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(8));
    easel.settle();
    easel.want(|request| request.settings.samples = 2);
    easel.settle();
    assert!(
        easel.image() == render(&scene, &stratified(2)).0,
        "8 and then 2 samples"
    );
    let adaptive = |samples| RenderSettings {
        antialias: Antialias::Adaptive,
        ..stratified(samples)
    };
    for samples in [16, 32] {
        easel.want(|request| request.settings = adaptive(samples));
        easel.settle();
        let image = easel.image();
        assert!(
            image == render(&scene, &adaptive(samples)).0,
            "{samples} adaptive samples"
        );
    }
}

#[test]
fn another_size_starts_over_and_the_last_picture_stays_meanwhile() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(4));
    easel.settle();
    let other = RenderSettings {
        size: (90, 30),
        ..stratified(4)
    };
    easel.want(|request| request.settings = other.clone());
    easel.wait_until("ordered", |easel| easel.shown().size == (90, 30));
    assert!(
        easel.shown().under.is_some(),
        "there is nothing to see meanwhile"
    );
    easel.settle();
    assert_eq!(easel.shown().screen.expect("a screen").size(), (90, 30));
    assert!(easel.image() == render(&scene, &other).0);
}

#[test]
fn a_region_is_the_same_part_of_the_picture_and_leaves_the_rest() {
    let scene = scenes::everything();
    let mut easel = Easel::new(&scene, stratified(4));
    easel.settle();
    let whole = easel.image();
    for crop in [[7, 5, 40, 33], [9, 5, 40, 33]] {
        easel.want(|request| request.settings.crop = Some(crop));
        easel.settle();
        let shown = easel.shown();
        let [x, y, width, height] = shown.region;
        assert_eq!([x, y, x + width, y + height], crop);
        assert_eq!(shown.screen.expect("a screen").size(), (width, height));
        assert_eq!(shown.whole.expect("the rest").size(), (61, 43));
        let part = easel.image();
        for (index, pixel) in part.pixels.iter().enumerate() {
            let (column, row) = (x + index as u32 % width, y + index as u32 / width);
            assert_eq!(
                whole.pixels[(row * 61 + column) as usize],
                *pixel,
                "{column},{row}"
            );
        }
    }
    easel.want(|request| request.settings.crop = None);
    easel.settle();
    assert!(
        easel.shown().whole.is_none(),
        "the rest is under a picture that is whole"
    );
    assert!(easel.image() == whole);
}

#[test]
fn what_moves_is_one_whole_coarse_picture() {
    let mut easel = Easel::new(&scenes::everything(), stratified(64));
    easel.settle();
    easel.requests.coarse = true;
    easel.want(|request| request.shutter_interval = (0.5, 0.5));
    easel.settle();
    let shown = easel.shown();
    assert!(shown.progress.is_coarse, "{:?}", shown.progress);
    assert!(
        shown.screen.is_none(),
        "a fine picture of what was before is shown"
    );
    let (width, height) = shown.under.expect("a picture").size();
    assert!((1..=61).contains(&width) && (1..=43).contains(&height));
    easel.requests.coarse = false;
    easel.want(|_| {});
    easel.settle();
    assert!(!easel.shown().progress.is_coarse);
}

/// Costs that vary by a quarter up and down are what a busy machine is like.
#[test]
fn the_coarse_picture_is_what_is_wanted_too_after_a_way_back() {
    let scene = scenes::everything();
    let home = scene.frame(0.0).camera;
    let mut easel = Easel::new(&scene, stratified(2));
    easel.settle();
    // Every channel's mean on the main picture's screens.
    let means = |easel: &Easel| {
        let shown = easel.shown();
        let screen = (shown.screen.or(shown.under)).expect("a screen");
        let bytes = pixels::on(&screen, &easel.gpu);
        std::array::from_fn::<f64, 3, _>(|channel| {
            let values = bytes.rgb.iter().map(|rgb| f64::from(rgb[channel]));
            values.sum::<f64>() / bytes.rgb.len() as f64
        })
    };
    let apart = |a: [f64; 3], b: [f64; 3]| {
        let off = (0..3).map(|i| (a[i] - b[i]).abs());
        off.fold(0.0, f64::max)
    };
    let wanted = means(&easel);
    type Change = (
        &'static str,
        fn(&mut RenderRequest, &Camera),
        fn(&mut RenderRequest),
    );
    let changes: [Change; 2] = [
        (
            "camera",
            |request, home| {
                request.camera = Some(Camera {
                    look_at: home.look_from + (home.look_from - home.look_at),
                    ..home.clone()
                });
            },
            |request| request.camera = None,
        ),
        (
            "background",
            |request, _| request.background = Some(Background::Color(Vec3::new(9.0, 0.0, 9.0))),
            |request| request.background = None,
        ),
    ];
    for (what, there, back) in changes {
        easel.requests.coarse = false;
        easel.want(|request| there(request, &home));
        easel.settle();
        let far = apart(means(&easel), wanted);
        easel.requests.coarse = true;
        easel.want(back);
        easel.settle();
        assert!(easel.shown().progress.is_coarse);
        let near = apart(means(&easel), wanted);
        assert!(
            near < far / 4.0,
            "{what}: {near} from home, {far} before the way back"
        );
    }
}

#[test]
fn previews_of_paths_are_nearer_to_the_picture_in_full_when_they_are_denoised() {
    let scene = import::load("assets/scenes/cornell_box.toml".as_ref()).expect("a scene");
    let settings = RenderSettings {
        integrator: Integrator::Path,
        ..stratified(2)
    };
    let error = |denoises: bool| {
        let mut easel = Easel::new(&scene, settings.clone());
        easel.settle();
        let in_full = easel.shown().screen.expect("a screen");
        easel.requests.coarse = true;
        easel.want(|request| {
            request.denoises_previews = denoises;
            request.restarts += 1;
        });
        easel.settle();
        let shown = easel.shown();
        assert!(shown.progress.is_coarse);
        let coarse = pixels::on(&shown.under.expect("a preview"), &easel.gpu);
        let (converged, _) = render(
            &scene,
            &RenderSettings {
                size: coarse.size,
                samples: 512,
                ..settings.clone()
            },
        );
        let of_pixel = |(shown, exact): (&[u8; 3], &[f32; 4])| -> f64 {
            let off = |channel: usize| {
                f64::from(shown[channel]) / 255.0 - f64::from(exact[channel].clamp(0.0, 1.0))
            };
            (0..3).map(|channel| off(channel).powi(2)).sum()
        };
        let pairs = coarse.rgb.iter().zip(&converged.pixels);
        let mean = pairs.map(of_pixel).sum::<f64>() / coarse.rgb.len() as f64;
        // The picture in full has no features and stays as it is.
        easel.requests.coarse = false;
        easel.want(|request| request.restarts += 1);
        easel.settle();
        let again = pixels::on(&easel.shown().screen.expect("a screen"), &easel.gpu);
        again.assert_same(&pixels::on(&in_full, &easel.gpu), "the picture in full");
        mean
    };
    let (raw, denoised) = (error(false), error(true));
    assert!(
        denoised < 0.5 * raw,
        "{denoised}, and {raw} without denoising"
    );
}

#[test]
fn a_camera_that_moves_and_comes_to_rest_builds_no_tree_and_uploads_only_frames() {
    // One that stands still, and one in which a node moves.
    let moving = import::load("assets/scenes/orbits.toml".as_ref()).expect("a scene");
    for mut scene in [scenes::everything(), moving] {
        scene.pin_render_origin();
        let home = scene.frame(0.0).camera;
        let mut easel = Easel::new(&scene, stratified(2));
        easel.settle();
        let before = easel.shown();
        assert!(before.trees_built > 0 && before.stats.uploads.geometry > 0);
        let mut frames = before.stats.uploads.frames;
        for step in 1..4 {
            easel.requests.coarse = true;
            easel.want(|request| {
                let mut camera = home.clone();
                camera.look_from.x += f64::from(step);
                request.camera = Some(camera);
            });
            easel.settle();
            easel.requests.coarse = false;
            easel.want(|_| {});
            easel.settle();
            let now = easel.shown();
            assert!(now.progress.is_done);
            assert_eq!(now.trees_built, before.trees_built, "trees");
            let uploads = now.stats.uploads;
            assert!(uploads.frames > frames, "no frame");
            frames = uploads.frames;
            let others = Uploads {
                frames: before.stats.uploads.frames,
                ..uploads
            };
            assert_eq!(others, before.stats.uploads);
        }
    }
}

#[test]
fn an_edit_of_the_scene_builds_the_trees_of_what_it_changes() {
    let mut scene = scenes::everything();
    scene.pin_render_origin();
    let mut easel = Easel::new(&scene, stratified(2));
    easel.settle();
    let before = easel.shown();
    let edited = |edit: fn(&mut Scene)| {
        let mut scene = scene.clone();
        edit(&mut scene);
        Arc::new(scene)
    };
    let recoloured =
        edited(|scene| scene.materials[0].classical_mut().diffuse = Vec3::new(0.9, 0.1, 0.4));
    easel.want(|request| request.scene = recoloured.clone());
    easel.settle();
    let now = easel.shown();
    assert_eq!(now.trees_built, before.trees_built);
    let (was, is) = (before.stats.uploads, now.stats.uploads);
    assert_eq!((is.geometry, is.tlas), (was.geometry, was.tlas));
    assert!(is.surfaces > was.surfaces);
    assert!(easel.image() == render(&recoloured, &stratified(2)).0);

    let moved = edited(|scene| scene.instances[0].placement.translation.y += 0.5);
    easel.want(|request| request.scene = moved.clone());
    easel.settle();
    assert_eq!(easel.shown().trees_built, before.trees_built + 1);
    assert!(easel.image() == render(&moved, &stratified(2)).0);
}

#[test]
fn the_size_of_coarse_pictures_fits_the_time_and_does_not_flicker() {
    let wanted = 0.04;
    for pixels in [40_000, 640_000, 2_000_000] {
        for cost in [2e-8, 3e-7, 5e-6] {
            let mut pace = Pace::default();
            let mut divisors = Vec::new();
            for frame in 0..60 {
                let divisor = pace.divisor(pixels, wanted);
                divisors.push(divisor);
                let samples = pixels / u64::from(divisor).pow(2);
                let noise = [1.0, 0.8, 1.2, 0.9, 1.25, 0.85][frame % 6];
                pace.measured(samples as f64 * cost * noise, samples);
            }
            let last = divisors[59];
            assert!(
                divisors[8..].iter().all(|d| *d == last),
                "{pixels} {cost}: {divisors:?}"
            );
            let time = |divisor: u32| pixels as f64 * cost / f64::from(divisor).powi(2);
            assert!(
                last == 16 || time(last) < 1.5 * wanted,
                "{pixels} {cost}: {last} is slow"
            );
            assert!(
                last == 1 || time(last - 1) > 0.5 * wanted,
                "{pixels} {cost}: {last} is coarse"
            );
        }
    }
}

#[test]
fn a_slow_picture_is_refined_by_halves() {
    let mut pace = Pace::default();
    pace.measured(1.0, 1_000_000);
    let levels = |first: u32, pixels: u64| {
        let mut levels = vec![first];
        while *levels.last().expect("a level") > 1 {
            levels.push(pace.next(pixels, *levels.last().expect("a level")));
        }
        levels
    };
    assert_eq!(levels(16, 1_000_000), [16, 8, 4, 2, 1]);
    assert_eq!(levels(11, 1_000_000), [11, 4, 2, 1]);
    assert_eq!(levels(3, 1_000_000), [3, 2, 1]);
    assert_eq!(levels(2, 1_000_000), [2, 1]);
    // A sample of a fast picture takes less time than a person sees.
    assert_eq!(levels(16, 50_000), [16, 1]);
}

#[test]
fn a_slow_picture_comes_in_levels_and_its_first_sample_as_a_whole() {
    let easel = Easel::new(&scenes::everything(), sized(2048, 1536));
    let mut levels = Vec::new();
    let start = Instant::now();
    while !easel.thread.is_settled() {
        assert!(start.elapsed() < PATIENCE, "never settled");
        if let Some(shown) = easel.thread.shown(PictureSlot::Main) {
            let is_partial = shown.screen.is_some() && shown.progress.samples == 0;
            assert!(!is_partial, "a part of a sample is shown");
            let under = shown.under.map(|under| under.size().0);
            levels.extend(under.filter(|width| levels.last() != Some(width)));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(levels.ends_with(&[512, 1024]), "{levels:?}");
    assert!(levels.is_sorted(), "{levels:?}");
    assert!(easel.shown().progress.is_done);
    assert!(easel.image() == render(&scenes::everything(), &sized(2048, 1536)).0);
}

#[test]
fn the_last_picture_lies_scaled_under_the_one_of_another_size() {
    let mut easel = Easel::new(&scenes::everything(), stratified(2));
    easel.settle();
    let last = easel.shown().screen.expect("a screen");
    // Enough samples for a look before it is done.
    easel.want(|request| request.settings.size = (610, 430));
    let mut is_under = false;
    let start = Instant::now();
    while !easel.thread.is_settled() {
        assert!(start.elapsed() < PATIENCE, "never settled");
        let shown = easel.shown();
        assert!(!shown.progress.is_coarse, "a coarse picture replaces it");
        is_under |= shown.under.as_ref() == Some(&last) && shown.screen.is_none();
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(is_under, "the last picture was not shown");
    let settings = RenderSettings {
        size: (610, 430),
        ..stratified(2)
    };
    assert!(easel.image() == render(&scenes::everything(), &settings).0);
}

#[test]
fn a_picture_is_finished_while_the_window_draws_nothing() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "64"]);
    window.harness.step();
    window.harness.step();
    let start = Instant::now();
    let render = window.harness.state().render_thread();
    let is_done = || {
        render
            .shown(PictureSlot::Main)
            .is_some_and(|shown| shown.progress.is_done)
    };
    while !is_done() {
        assert!(start.elapsed() < PATIENCE, "it waits for the window");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_window_without_room_renders_nothing_and_comes_back() {
    let mut window = Window::open(&["assets/scenes/sphere.scene", "--samples", "1"]);
    window.settle();
    let size = window.shown().size;
    window.session().set_space((0, 0));
    let requests = window.session().requests();
    assert!(requests.pictures.iter().all(Option::is_none));
    window.harness.set_size(egui::vec2(1.0, 1.0));
    window.harness.step();
    window.harness.step();
    window.harness.set_size(egui::vec2(1000.0, 700.0));
    window.settle();
    assert_eq!(window.shown().size, size);
    assert!(window.shown().progress.is_done);
}

#[test]
fn a_finer_screen_gets_a_picture_of_as_many_pixels_more() {
    let mut window = Window::open(&["assets/scenes/sphere.scene", "--samples", "1"]);
    window.settle();
    let (width, height) = window.shown().size;
    let viewports = &mut window.harness.input_mut().viewports;
    let root = viewports.get_mut(&eframe::egui::ViewportId::ROOT);
    root.expect("a window").native_pixels_per_point = Some(2.0);
    window.settle();
    let (wide, high) = window.shown().size;
    assert!(wide.abs_diff(2 * width) <= 2, "{width} and {wide}");
    assert!(high.abs_diff(2 * height) <= 2, "{height} and {high}");
}

#[test]
fn samples_outlast_a_window_of_another_size_until_the_picture_begins_again() {
    let mut window = Window::open(&["--samples", "1"]);
    window.settle();
    let size = window.shown().size;
    // A short picture is made anew for the room that there is.
    window.session().set_spent(0.1);
    window.session().set_space((size.0 - 40, size.1 - 30));
    assert_eq!(
        window.session().picture_size(),
        (size.0 - 40, size.1 - 30),
        "a short picture does not follow"
    );
    window.settle();
    assert_eq!(window.shown().size, size, "back to the real room");

    window.session().set_spent(60.0);
    window.session().set_space((size.0 - 40, size.1 - 30));
    assert_eq!(
        window.session().picture_size(),
        size,
        "the samples are gone"
    );
    window.session().view.tone.exposure_ev += 1.0;
    window.session().set_space((size.0 + 40, size.1 + 30));
    assert_eq!(
        window.session().picture_size(),
        size,
        "the samples are gone"
    );
    window.session().view.settings.seed += 1;
    window.session().set_space((size.0 + 40, size.1 + 30));
    assert_eq!(
        window.session().picture_size(),
        (size.0 + 40, size.1 + 30),
        "a new picture does not take its room"
    );
}

/// Spheres whose metalness and roughness differ from texel to texel, as a path-traced model has them.
fn mapped() -> Scene {
    let mut scene = scenes::spheres();
    let texels = |seed: u8| {
        let texel = |i: u8| {
            [
                seed.wrapping_mul(i),
                i.wrapping_mul(61),
                255 - i.wrapping_mul(83),
                255,
            ]
        };
        (0..16).map(texel).collect()
    };
    let texture = |picture| Texture {
        pattern: Pattern::Picture {
            picture,
            nearest: false,
            minify: Minify::Linear,
            wrap: [Wrap::Repeat; 2],
        },
        space: Space::World,
        pattern_from_space: DAffine3::IDENTITY,
    };
    for (picture, texels) in [Texels::Srgb8(texels(37)), Texels::Linear8(texels(91))]
        .into_iter()
        .enumerate()
    {
        let (width, height) = (4, 4);
        scene.pictures.push(Arc::new(Picture {
            width,
            height,
            texels,
            origin: glimray::scene::Origin::Texels,
        }));
        scene.textures.push(texture(picture));
    }
    let layers = LayerTextures {
        base_color: Some(0),
        metallic: Some(1),
        roughness: Some(1),
        ..LayerTextures::default()
    };
    for material in &mut scene.materials {
        *material = MetallicRoughness {
            textures: layers,
            ..MetallicRoughness::default()
        }
        .into();
    }
    scene
}

#[test]
fn classical_maps_are_there_once_the_integrator_is_chosen_and_after_edits() {
    let whitted = RenderSettings {
        integrator: Integrator::Whitted,
        ..sized(61, 43)
    };
    let scene = mapped();
    let path = RenderSettings {
        integrator: Integrator::Path,
        ..whitted.clone()
    };
    let mut easel = Easel::new(&scene, path.clone());
    easel.settle();
    let traced = easel.image();
    easel.want(|request| request.settings = whitted.clone());
    easel.settle();
    let baked = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.bake_classical_maps();
        render(&scene, &whitted).0
    };
    assert_eq!(easel.image(), baked(&scene));
    assert_ne!(easel.image(), render(&scene, &whitted).0, "no map shows");
    // One material follows its new colour, and the maps of the others are the same.
    let mut edited = scene.clone();
    let model = edited.materials[0].metallic_roughness_mut();
    model.expect("a model").base_color = Vec3::new(0.25, 0.5, 1.0);
    easel.want(|request| request.scene = Arc::new(edited.clone()));
    easel.settle();
    assert_eq!(easel.image(), baked(&edited));
    easel.want(|request| {
        request.scene = Arc::new(scene.clone());
        request.settings = path;
    });
    easel.settle();
    assert_eq!(easel.image(), traced);
}
