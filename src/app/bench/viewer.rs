//! How soon there is something to see in the window, without the window: its render thread, ordered
//! about as a hand would.

use crate::app::cli::BenchArgs;
use crate::app::demo;
use crate::app::exit::AppError;
use crate::app::job;
use crate::app::view::navigation::Rig;
use crate::app::view::order::Order;
use crate::app::view::render_thread::{Fault, Orders, Place, RenderThread};
use crate::gpu::{Gpu, GpuError};
use crate::render::{RenderSettings, Tone};
use serde::Serialize;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// The name by which it is chosen.
pub const NAME: &str = "viewer";

/// About the room for the picture in a window of 1280 × 800.
const SIZE: (u32, u32) = (750, 620);
/// Movements in each run, and radians of each.
const MOVES: u32 = 20;
const ANGLE: f64 = 0.03;
/// How long the picture rests before it moves, so that it is being made in full just then.
const REST: Duration = Duration::from_millis(250);

/// Medians of all runs.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    width: u32,
    height: u32,
    /// From the opening of the adapter to the first picture.
    first_picture_seconds: f64,
    /// From an order to its coarse picture, while the one before is being made in full.
    latency_seconds: f64,
    /// The longest of all.
    longest_latency_seconds: f64,
    /// Width and height of the last coarse picture.
    coarse_width: u32,
    coarse_height: u32,
    /// The longest that anything had to wait for the adapter.
    longest_submission_seconds: f64,
}

pub fn measure(arguments: &BenchArgs) -> Result<Row, AppError> {
    let mut first = Vec::new();
    let mut latencies = Vec::new();
    let mut last = None;
    let mut longest_submission: f64 = 0.0;
    for _ in 0..arguments.repeats {
        let started = Instant::now();
        let mut stage = Stage::new(arguments)?;
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
    Ok(Row {
        name: NAME,
        width: SIZE.0,
        height: SIZE.1,
        first_picture_seconds: super::median(first),
        longest_latency_seconds: latencies.iter().copied().fold(0.0, f64::max),
        latency_seconds: super::median(latencies),
        coarse_width,
        coarse_height,
        longest_submission_seconds: longest_submission,
    })
}

/// The demo on a render thread.
struct Stage {
    thread: RenderThread<()>,
    news: Receiver<()>,
    orders: Orders,
    rig: Rig,
}

impl Stage {
    fn new(arguments: &BenchArgs) -> Result<Self, AppError> {
        let scene = demo::scene()?;
        let gpu = Gpu::with_all_limits(&arguments.device.choice())?;
        let (wake, news) = channel();
        let wake = move || {
            // The receiver is gone when nobody waits any more.
            let _ = wake.send(());
        };
        let thread = RenderThread::new(gpu, wake)
            .map_err(|error| AppError::Internal(format!("bench: no thread: {error}")))?;
        let rig = Rig::new(&scene.frame(0.0).camera, scene.bounds());
        let mut orders = Orders::default();
        orders.pictures[Place::Main as usize] = Some(Order {
            settings: RenderSettings {
                size: SIZE,
                ..RenderSettings::from(&scene.output)
            },
            policy: job::policy(&arguments.device, false),
            scene: Arc::new(scene),
            restarts: 0,
            camera: None,
            background: None,
            shot: (0.0, 0.0),
            tone: Tone::LINEAR,
        });
        thread.order(orders.clone());
        Ok(Self {
            thread,
            news,
            orders,
            rig,
        })
    }

    /// Lets the picture be made in full for a while.
    fn rest(&mut self) -> Result<(), AppError> {
        self.orders.coarse = false;
        self.thread.order(self.orders.clone());
        std::thread::sleep(REST);
        self.check()
    }

    /// Moves, and returns the seconds until that is to be seen.
    fn turn(&mut self) -> Result<f64, AppError> {
        self.rig.orbit_by(ANGLE, 0.0);
        // To where it glides.
        self.rig.advance(10.0);
        self.orders.coarse = true;
        if let Some(order) = &mut self.orders.pictures[Place::Main as usize] {
            order.camera = Some(self.rig.camera());
        }
        let started = Instant::now();
        self.thread.order(self.orders.clone());
        self.wait(|stage| stage.thread.is_settled())?;
        Ok(started.elapsed().as_secs_f64())
    }

    fn wait(&self, is_there: impl Fn(&Self) -> bool) -> Result<(), AppError> {
        while !is_there(self) {
            self.check()?;
            // News that came before are no reason to wait for more.
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
        let shown = self.thread.shown(Place::Main)?;
        shown.under.map(|screen| screen.size())
    }

    fn longest_submission(&self) -> f64 {
        let shown = self.thread.shown(Place::Main);
        shown.map_or(0.0, |shown| shown.stats.longest_submission_ms / 1e3)
    }
}

pub fn text(row: &Row) -> String {
    format!(
        "{:<20} {:>5}×{:<5} first picture {:.3} s, movement to picture {:.0} ms (longest {:.0} ms) at \
         {}×{}, longest submission {:.0} ms\n",
        row.name,
        row.width,
        row.height,
        row.first_picture_seconds,
        row.latency_seconds * 1e3,
        row.longest_latency_seconds * 1e3,
        row.coarse_width,
        row.coarse_height,
        row.longest_submission_seconds * 1e3,
    )
}
