//! Whole renders of a workload.

use super::figure::Figure;
use super::workloads::Workload;
use crate::args::BenchArgs;
use crate::job;
use glimray_app::error::AppError;
use glimray_app::storage;
use glimray_app::window::median;
use glimray_render::gpu::Gpu;
use glimray_render::pack::{self, PackedScene, PackedView};
use glimray_render::{Rays, RenderSettings, Renderer, Tone};
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;

/// A workload and the times of its runs.
pub struct Renders {
    workload: Workload,
    rays: Option<Rays>,
    times: Vec<Times>,
}

/// Medians of one workload. Times are wall-clock seconds.
#[derive(Debug, Serialize)]
pub struct Row {
    name: &'static str,
    width: u32,
    height: u32,
    triangles: usize,
    /// Building the BVH.
    bvh_seconds: f64,
    /// Compiling shaders.
    compile_seconds: f64,
    trace_seconds: f64,
    /// From opening the adapter to the developed picture.
    total_seconds: f64,
    /// Millions of triangles per second of BVH construction.
    bvh_mtriangles_per_second: f64,
    /// Camera rays.
    primary_rays: u64,
    /// Shadow rays.
    shadow_rays: u64,
    /// Millions of camera rays per second of tracing.
    primary_mrays_per_second: f64,
    /// Millions of rays of all kinds per second of tracing.
    mrays_per_second: f64,
    /// Spread of `trace_seconds`.
    trace_spread: Figure,
    /// Spread of `total_seconds`.
    total_spread: Figure,
}

/// Times of one run, in seconds.
#[derive(Clone, Copy)]
pub struct Times {
    pub bvh: f64,
    pub compile: f64,
    pub trace: f64,
    pub total: f64,
}

impl Renders {
    pub fn new(workload: Workload) -> Self {
        Self {
            workload,
            rays: None,
            times: Vec::new(),
        }
    }

    /// Renders the workload once more. Counting rays costs time, so before the first run another one counts them. That one
    /// has a kernel of its own, so after it the kernel that is timed runs once too: drivers keep what they compile.
    ///
    /// # Errors
    /// Rendering failed.
    pub fn run(&mut self, arguments: &BenchArgs) -> Result<(), AppError> {
        self.run_with(|workload, purpose| {
            let rendered = render(workload, arguments, purpose)?;
            Ok((rendered.times, rendered.rays))
        })
    }

    fn run_with(
        &mut self,
        mut render: impl FnMut(&Workload, Purpose) -> Result<(Times, Option<Rays>), AppError>,
    ) -> Result<(), AppError> {
        if self.times.is_empty() {
            (_, self.rays) = render(&self.workload, Purpose::Count)?;
            render(&self.workload, Purpose::Warm)?;
        }
        let (times, _) = render(&self.workload, Purpose::Time)?;
        self.times.push(times);
        Ok(())
    }

    /// The figures of all runs.
    pub fn row(&self) -> Row {
        let figure = |part: fn(&Times) -> f64| Figure::of(self.times.iter().map(part));
        let middle = |part: fn(&Times) -> f64| median(self.times.iter().map(part).collect());
        let (bvh, trace) = (middle(|t| t.bvh), middle(|t| t.trace));
        let rays = self.rays.unwrap_or_default();
        let all = rays.primary + rays.shadow + rays.reflection + rays.refraction;
        let (width, height) = self.workload.size;
        let triangles = self.workload.scene.triangle_count();
        Row {
            name: self.workload.name,
            width,
            height,
            triangles,
            bvh_seconds: bvh,
            compile_seconds: middle(|t| t.compile),
            trace_seconds: trace,
            total_seconds: middle(|t| t.total),
            bvh_mtriangles_per_second: triangles as f64 / bvh / 1e6,
            primary_rays: rays.primary,
            shadow_rays: rays.shadow,
            primary_mrays_per_second: rays.primary as f64 / trace / 1e6,
            mrays_per_second: all as f64 / trace / 1e6,
            trace_spread: figure(|t| t.trace),
            total_spread: figure(|t| t.total),
        }
    }
}

/// The purpose of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Counts rays, which a kernel of its own does.
    Count,
    /// Runs the kernel that is timed, for the first part of the picture.
    Warm,
    Time,
}

/// The results of one render.
pub struct Rendered {
    pub times: Times,
    /// Counted only on request.
    pub rays: Option<Rays>,
    pub packed: Arc<PackedScene>,
    pub view: PackedView,
}

/// Packs and renders a workload on a newly opened adapter.
///
/// # Errors
/// The scene cannot be packed, or rendering failed.
pub fn render(
    workload: &Workload,
    arguments: &BenchArgs,
    purpose: Purpose,
) -> Result<Rendered, AppError> {
    let started = Instant::now();
    let gpu = Gpu::new(&arguments.device.choice())?;
    let Workload {
        scene,
        shutter_interval,
        ..
    } = workload;
    let settings = RenderSettings {
        size: workload.size,
        ..RenderSettings::from(&scene.output)
    };
    let policy = job::policy(&arguments.device, purpose == Purpose::Count);
    let policy = storage::with_requested(policy)?;
    let packed = Arc::new(pack::scene_with(scene, workload.most_baked)?);
    let view = packed.view(&scene.motion_samples(shutter_interval.0, shutter_interval.1))?;
    let mut renderer = Renderer::new(gpu, packed.clone(), &view, settings, policy)?;
    // Drivers compile a kernel at the latest when it first runs.
    while !renderer.is_done() {
        renderer.step()?;
        if purpose == Purpose::Warm {
            break;
        }
    }
    renderer.develop(&Tone::LINEAR)?;
    let stats = renderer.stats();
    let times = Times {
        bvh: packed.build_seconds,
        compile: stats.compile_seconds,
        trace: stats.trace_seconds,
        total: started.elapsed().as_secs_f64(),
    };
    Ok(Rendered {
        times,
        rays: stats.rays,
        packed,
        view,
    })
}

/// The heading of the lines of [`Row::text`].
pub const HEADER: &str = "workload              size        bvh s  compile s    trace s    total s  \
                      primary Mrays/s  all Mrays/s  trace s, min–max\n";

impl Row {
    /// A line for people.
    pub fn text(&self) -> String {
        format!(
            "{:<20} {:>5}×{:<5} {:>7.3} {:>10.3} {:>10.3} {:>10.3} {:>16.2} {:>12.2}  {:.3}–{:.3}\n",
            self.name,
            self.width,
            self.height,
            self.bvh_seconds,
            self.compile_seconds,
            self.trace_seconds,
            self.total_seconds,
            self.primary_mrays_per_second,
            self.mrays_per_second,
            self.trace_spread.min,
            self.trace_spread.max,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::{Purpose, Renders, Times};
    use crate::bench::workloads::Workload;
    use glimray_render::Rays;
    use glimray_scene::Scene;

    /// A driver that takes long for the first render with each kernel: that which counts rays, and that which does not.
    #[test]
    fn a_render_is_timed_with_a_kernel_that_the_driver_knows() {
        let mut renders = Renders::new(Workload::new("a", Scene::default(), (8, 8)));
        let mut known = Vec::new();
        for _ in 0..3 {
            let run = renders.run_with(|_, purpose| {
                let kernel = purpose == Purpose::Count;
                let compile = if known.contains(&kernel) { 0.1 } else { 1.0 };
                known.push(kernel);
                let times = Times {
                    bvh: 0.0,
                    compile,
                    trace: 1.0,
                    total: compile + 1.0,
                };
                let rays = kernel.then(|| Rays {
                    primary: 7,
                    ..Rays::default()
                });
                Ok((times, rays))
            });
            run.expect("a run");
        }
        let row = renders.row();
        assert_eq!(row.primary_rays, 7);
        assert_eq!((row.compile_seconds, row.total_spread.max), (0.1, 1.1));
        assert_eq!(known.len(), 5);
    }
}
