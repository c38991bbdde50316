//! `glimray bench`: renders built-in workloads several times each, starting with opening the adapter, and
//! reports medians.

mod workloads;

use crate::app::console;
use crate::app::error::AppError;
use crate::app::window::{BenchRequest, Window, median};
use crate::cli::args::BenchArgs;
use crate::cli::device;
use crate::cli::interrupt::Interrupt;
use crate::cli::job;
use crate::gpu::{AdapterReport, Gpu};
use crate::pack;
use crate::render::{Rays, RenderSettings, Renderer, Tone};
use serde::Serialize;
use std::sync::Arc;
use std::time::Instant;
use workloads::Workload;

pub fn run(arguments: &BenchArgs, program: Option<&Window>) -> Result<(), AppError> {
    Interrupt::install()?;
    let adapter = Gpu::new(&arguments.device.choice())?.adapter().clone();
    if !arguments.json {
        console::print(&format!("{}\n{HEADER}\n", device::describe(&adapter)))?;
    }
    let mut rows = Vec::new();
    for workload in workloads::all()? {
        if !is_selected(workload.name, arguments.only.as_deref()) {
            continue;
        }
        let row = measure(&workload, arguments)?;
        if !arguments.json {
            console::print(&text(&row))?;
        }
        rows.push(row);
    }
    let window = window(arguments, program)?;
    if arguments.json {
        console::print_json(&json(&adapter, arguments, &rows, window))?;
    }
    Ok(())
}

/// Measures the window, if that is wanted and there is one; prints it unless JSON is wanted.
fn window(
    arguments: &BenchArgs,
    program: Option<&Window>,
) -> Result<Option<serde_json::Value>, AppError> {
    let wanted = program.filter(|_| is_selected("viewer", arguments.only.as_deref()));
    let Some(program) = wanted else {
        return Ok(None);
    };
    let (row, text) = (program.bench)(BenchRequest {
        repeats: arguments.repeats,
        adapter: arguments.device.choice(),
        policy: job::policy(&arguments.device, false),
        crowd: workloads::thousand(),
    })?;
    if !arguments.json {
        console::print(&text)?;
    }
    Ok(Some(row))
}

fn is_selected(name: &str, only: Option<&str>) -> bool {
    only.is_none_or(|part| name.contains(part))
}

/// Medians of one workload. Times are wall-clock seconds.
#[derive(Debug, Serialize)]
struct Row {
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
}

/// Times of one run, in seconds.
struct Times {
    bvh: f64,
    compile: f64,
    trace: f64,
    total: f64,
}

fn measure(workload: &Workload, arguments: &BenchArgs) -> Result<Row, AppError> {
    // Counting rays costs time, so a separate run counts them; it also warms caches.
    let (_, rays) = render(workload, arguments, true)?;
    let times = (0..arguments.repeats)
        .map(|_| render(workload, arguments, false).map(|(times, _)| times))
        .collect::<Result<Vec<_>, _>>()?;
    let median = |part: fn(&Times) -> f64| median(times.iter().map(part).collect());
    let (bvh, trace) = (median(|t| t.bvh), median(|t| t.trace));
    let rays = rays.ok_or_else(|| AppError::Internal("bench: rays were not counted".into()))?;
    let all = rays.primary + rays.shadow + rays.reflection + rays.refraction;
    let (width, height) = workload.size;
    let triangles = workload.scene.triangle_count();
    Ok(Row {
        name: workload.name,
        width,
        height,
        triangles,
        bvh_seconds: bvh,
        compile_seconds: median(|t| t.compile),
        trace_seconds: trace,
        total_seconds: median(|t| t.total),
        bvh_mtriangles_per_second: triangles as f64 / bvh / 1e6,
        primary_rays: rays.primary,
        shadow_rays: rays.shadow,
        primary_mrays_per_second: rays.primary as f64 / trace / 1e6,
        mrays_per_second: all as f64 / trace / 1e6,
    })
}

fn render(
    workload: &Workload,
    arguments: &BenchArgs,
    count_rays: bool,
) -> Result<(Times, Option<Rays>), AppError> {
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
    let policy = job::policy(&arguments.device, count_rays);
    let packed = Arc::new(pack::scene_with(scene, workload.most_baked)?);
    let bvh = packed.build_seconds;
    let view = packed.view(&scene.motion_samples(shutter_interval.0, shutter_interval.1))?;
    let mut renderer = Renderer::new(gpu, packed, &view, settings, policy)?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    renderer.develop(&Tone::LINEAR)?;
    let stats = renderer.stats();
    let times = Times {
        bvh,
        compile: stats.compile_seconds,
        trace: stats.trace_seconds,
        total: started.elapsed().as_secs_f64(),
    };
    Ok((times, stats.rays))
}

const HEADER: &str = "workload              size        bvh s  compile s    trace s    total s  \
                      primary Mrays/s  all Mrays/s";

fn text(row: &Row) -> String {
    format!(
        "{:<20} {:>5}×{:<5} {:>7.3} {:>10.3} {:>10.3} {:>10.3} {:>16.2} {:>12.2}\n",
        row.name,
        row.width,
        row.height,
        row.bvh_seconds,
        row.compile_seconds,
        row.trace_seconds,
        row.total_seconds,
        row.primary_mrays_per_second,
        row.mrays_per_second,
    )
}

fn json(
    adapter: &AdapterReport,
    arguments: &BenchArgs,
    rows: &[Row],
    window: Option<serde_json::Value>,
) -> serde_json::Value {
    serde_json::json!({
        "glimray": env!("CARGO_PKG_VERSION"),
        "adapter": crate::cli::report::Adapter::from(adapter),
        "repeats": arguments.repeats,
        "workloads": rows,
        "viewer": window,
    })
}
