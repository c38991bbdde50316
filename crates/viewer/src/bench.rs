//! The viewer's latency, measured without a window: drives its render thread with requests like those of a
//! user.

use crate::model::camera::CameraController;
use crate::worker::progressive_image::PictureSlot;
use crate::worker::render_thread::{Fault, RenderRequests, RenderThread};
use crate::worker::request::RenderRequest;
use glimray_app::error::AppError;
use glimray_app::showcase;
use glimray_app::window::{BenchRequest, median};
use glimray_render::gpu::{Gpu, GpuError};
use glimray_render::pack;
use glimray_render::{RenderSettings, Renderer, Tone};
use glimray_scene::Scene;
use serde::Serialize;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// Approximate size of the picture in a window of 1280 × 800.
const SIZE: (u32, u32) = (750, 620);
/// Camera movements per run, and the angle of each in radians.
const MOVES: u32 = 20;
const ANGLE: f64 = 0.03;
/// Pause before each movement, so that a full-resolution picture is being rendered when it starts.
const REST: Duration = Duration::from_millis(250);

/// Medians of all runs.
#[derive(Debug, Serialize)]
struct Row {
    name: &'static str,
    width: u32,
    height: u32,
    /// From opening the adapter to the first picture.
    first_picture_seconds: f64,
    /// From a request to its coarse picture, while the previous picture is rendered at full resolution.
    latency_seconds: f64,
    /// The longest such latency.
    longest_latency_seconds: f64,
    /// Width and height of the last coarse picture.
    coarse_width: u32,
    coarse_height: u32,
    /// The longest submission.
    longest_submission_seconds: f64,
    /// Host time from the end of a camera movement to the first submission at full resolution.
    rest_seconds: f64,
    /// Seconds of rest in a scene of 1,000 objects with 1,000,000 triangles.
    thousand_rest_seconds: f64,
    /// From a request that moves one of those objects to the coarse picture.
    thousand_move_seconds: f64,
    /// The longest such time.
    longest_thousand_move_seconds: f64,
}

/// Measures the window's render thread: as JSON, and as a line for people.
///
/// # Errors
/// The adapter cannot be opened or fails.
pub fn run(request: BenchRequest) -> Result<(serde_json::Value, String), AppError> {
    let row = measure(&request)?;
    let value = serde_json::to_value(&row)
        .map_err(|error| AppError::Internal(format!("bench: {error}")))?;
    Ok((value, text(&row)))
}

fn measure(request: &BenchRequest) -> Result<Row, AppError> {
    let mut first = Vec::new();
    let mut latencies = Vec::new();
    let mut last = None;
    let mut longest_submission: f64 = 0.0;
    for _ in 0..request.repeats {
        let started = Instant::now();
        let mut stage = Stage::new(request, showcase::scene()?)?;
        stage.wait(|stage| stage.coarse_size().is_some())?;
        first.push(started.elapsed().as_secs_f64());
        for _ in 0..MOVES {
            stage.rest()?;
            latencies.push(stage.turn()?);
        }
        last = stage.coarse_size();
        longest_submission = longest_submission.max(stage.longest_submission());
    }
    let (coarse_width, coarse_height) = last.unwrap_or_default();
    let moves = moves_of_one(request)?;
    Ok(Row {
        name: "viewer",
        width: SIZE.0,
        height: SIZE.1,
        first_picture_seconds: median(first),
        longest_latency_seconds: latencies.iter().copied().fold(0.0, f64::max),
        latency_seconds: median(latencies),
        coarse_width,
        coarse_height,
        longest_submission_seconds: longest_submission,
        rest_seconds: rest_seconds(request, &showcase::scene()?)?,
        thousand_rest_seconds: rest_seconds(request, &request.crowd)?,
        longest_thousand_move_seconds: moves.iter().copied().fold(0.0, f64::max),
        thousand_move_seconds: median(moves),
    })
}

/// Seconds from a request that moves one of a thousand objects to the coarse picture, for each movement.
fn moves_of_one(request: &BenchRequest) -> Result<Vec<f64>, AppError> {
    let mut stage = Stage::new(request, request.crowd.clone())?;
    stage.wait(|stage| stage.coarse_size().is_some())?;
    let mut seconds = Vec::new();
    for step in 0..MOVES {
        stage.rest()?;
        seconds.push(stage.request_coarse(|request| {
            let mut scene = Scene::clone(&request.scene);
            scene.instances[500 + step as usize].placement.translation.y += 0.01;
            request.scene = Arc::new(scene);
        })?);
    }
    Ok(seconds)
}

/// Median host time before a full-resolution picture from another camera starts, in seconds.
fn rest_seconds(request: &BenchRequest, scene: &Scene) -> Result<f64, AppError> {
    let gpu = Gpu::with_all_limits(&request.adapter)?;
    let settings = settings(scene);
    let packed = Arc::new(pack::scene(scene)?);
    let mut controller = CameraController::new(&scene.frame(0.0).camera, scene.bounds());
    let mut frames = scene.motion_samples(0.0, 0.0);
    let mut view = packed.view(&frames)?;
    let policy = request.policy;
    let mut renderer = Renderer::new(gpu, packed.clone(), &view, settings.clone(), policy)?;
    let mut seconds = Vec::new();
    for _ in 0..MOVES {
        controller.orbit_by(ANGLE, 0.0);
        controller.advance(10.0);
        let started = Instant::now();
        frames[0].camera = controller.camera();
        view = packed.view_from(Some(&view), &frames)?;
        renderer.restart(packed.clone(), &view, settings.clone(), policy)?;
        seconds.push(started.elapsed().as_secs_f64());
        renderer.step()?;
    }
    Ok(median(seconds))
}

fn settings(scene: &Scene) -> RenderSettings {
    RenderSettings {
        size: SIZE,
        ..RenderSettings::from(&scene.output)
    }
}

/// A scene on a render thread, with the current request.
struct Stage {
    thread: RenderThread<()>,
    news: Receiver<()>,
    requests: RenderRequests,
    controller: CameraController,
}

impl Stage {
    fn new(request: &BenchRequest, scene: Scene) -> Result<Self, AppError> {
        let gpu = Gpu::with_all_limits(&request.adapter)?;
        let (wake, news) = channel();
        let wake = move || {
            // Fails only if the receiver is gone.
            let _ = wake.send(());
        };
        let thread = RenderThread::new(gpu, wake)
            .map_err(|error| AppError::Internal(format!("bench: no thread: {error}")))?;
        let controller = CameraController::new(&scene.frame(0.0).camera, scene.bounds());
        let mut requests = RenderRequests::default();
        requests.pictures[PictureSlot::Main as usize] = Some(RenderRequest {
            settings: settings(&scene),
            policy: request.policy,
            scene: Arc::new(scene),
            restarts: 0,
            camera: None,
            background: None,
            shutter_interval: (0.0, 0.0),
            tone: Tone::LINEAR,
            layer: glimray_app::layers::PictureLayer::Beauty,
            denoises_previews: true,
            false_color: false,
        });
        thread.submit(requests.clone());
        Ok(Self {
            thread,
            news,
            requests,
            controller,
        })
    }

    /// Lets the full-resolution picture refine for a while.
    fn rest(&mut self) -> Result<(), AppError> {
        self.requests.coarse = false;
        self.thread.submit(self.requests.clone());
        std::thread::sleep(REST);
        self.check()
    }

    /// Moves the camera, and returns the seconds until the coarse picture shows it.
    fn turn(&mut self) -> Result<f64, AppError> {
        self.controller.orbit_by(ANGLE, 0.0);
        // Past the camera's smoothing.
        self.controller.advance(10.0);
        let camera = self.controller.camera();
        self.request_coarse(|request| request.camera = Some(camera))
    }

    /// Changes the request, and returns the seconds until its coarse picture is there.
    fn request_coarse(&mut self, change: impl FnOnce(&mut RenderRequest)) -> Result<f64, AppError> {
        self.requests.coarse = true;
        if let Some(request) = &mut self.requests.pictures[PictureSlot::Main as usize] {
            change(request);
        }
        let started = Instant::now();
        self.thread.submit(self.requests.clone());
        self.wait(|stage| stage.thread.is_settled())?;
        Ok(started.elapsed().as_secs_f64())
    }

    fn wait(&self, is_there: impl Fn(&Self) -> bool) -> Result<(), AppError> {
        while !is_there(self) {
            self.check()?;
            // The condition may hold already, so wait only briefly for a wake-up.
            let _ = self.news.recv_timeout(Duration::from_millis(1));
        }
        self.check()
    }

    fn check(&self) -> Result<(), AppError> {
        match self.thread.fault() {
            None => Ok(()),
            Some(Fault::Lost) => Err(GpuError::Lost.into()),
            Some(Fault::Refused(why)) => Err(AppError::Refused(why)),
        }
    }

    fn coarse_size(&self) -> Option<(u32, u32)> {
        let shown = self.thread.shown(PictureSlot::Main)?;
        shown.under.map(|screen| screen.size())
    }

    fn longest_submission(&self) -> f64 {
        let shown = self.thread.shown(PictureSlot::Main);
        shown.map_or(0.0, |shown| shown.stats.longest_submission_ms / 1e3)
    }
}

fn text(row: &Row) -> String {
    format!(
        "{:<20} {:>5}×{:<5} first picture {:.3} s, movement to picture {:.0} ms (longest {:.0} ms) at \
         {}×{}, longest submission {:.0} ms, camera stop to submission {:.1} ms; with 1,000 objects {:.1} ms, \
         moved object to picture {:.0} ms (longest {:.0} ms)\n",
        row.name,
        row.width,
        row.height,
        row.first_picture_seconds,
        row.latency_seconds * 1e3,
        row.longest_latency_seconds * 1e3,
        row.coarse_width,
        row.coarse_height,
        row.longest_submission_seconds * 1e3,
        row.rest_seconds * 1e3,
        row.thousand_rest_seconds * 1e3,
        row.thousand_move_seconds * 1e3,
        row.longest_thousand_move_seconds * 1e3,
    )
}
