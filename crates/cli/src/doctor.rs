//! `glimray doctor`: lists the adapters and tests the one that would be used.

mod self_test;

use crate::args::DoctorArgs;
use crate::device;
use glimray_app::console;
use glimray_app::error::AppError;
use glimray_app::storage::{self, Reason};
use glimray_render::Storage;
use glimray_render::gpu::{self, AdapterChoice, AdapterReport, Gpu};
use glimray_scene::bytes::size;
use self_test::Outcome;
use serde_json::{Value, json};
use std::fmt::{self, Write};

pub fn run(arguments: &DoctorArgs) -> Result<(), AppError> {
    let choice = arguments.device.choice();
    let adapters = gpu::adapters(&AdapterChoice {
        adapter: None,
        ..choice.clone()
    });
    let opened = Gpu::new(&choice);
    let chosen = opened.as_ref().ok().map(|gpu| gpu.adapter().clone());
    let requested = storage::requested()?;
    let fetch = opened.as_ref().ok().map(|gpu| {
        let usual = Storage::usual(gpu);
        let used = requested.unwrap_or(usual);
        (storage::name(used), Reason::of(used, requested, usual))
    });
    let outcome = opened
        .map_err(AppError::from)
        .and_then(|gpu| self_test::run(gpu, arguments.device.memory_limit_bytes()));

    let advice = (adapters.is_empty()).then(|| device::advice(choice.backend));
    if arguments.json {
        let passed = outcome.as_ref().ok();
        console::print_json(&to_json(&adapters, chosen.as_ref(), fetch, passed, advice))?;
    } else {
        let mut text = String::new();
        let outcome = outcome.as_ref().ok();
        write_text(&mut text, &adapters, chosen.as_ref(), fetch, outcome)
            .map_err(|error| AppError::Internal(format!("doctor: {error}")))?;
        if let Some(advice) = advice {
            text = text + advice + "\n";
        }
        console::print(&text)?;
    }
    verdict(chosen.as_ref(), outcome?)
}

fn verdict(chosen: Option<&AdapterReport>, outcome: Outcome) -> Result<(), AppError> {
    if outcome.is_right() {
        return Ok(());
    }
    let Outcome { found, expected } = outcome;
    Err(AppError::SelfTest(format!(
        "the adapter computes wrong results ({}): the radiance of the test pixel is {found:.4}, not \
         {expected:.4}. Choose another adapter with --adapter, or update the driver.",
        chosen.map_or_else(String::new, device::describe)
    )))
}

fn to_json(
    adapters: &[AdapterReport],
    chosen: Option<&AdapterReport>,
    fetch: Option<(&str, Reason)>,
    outcome: Option<&Outcome>,
    advice: Option<&str>,
) -> Value {
    json!({
        "adapters": adapters.iter().map(adapter_json).collect::<Value>(),
        "chosen": chosen.map(|adapter| adapter.index),
        "fetch": fetch.map(|(storage, reason)| json!({ "storage": storage, "reason": reason })),
        "self_test": outcome.map(|outcome| json!({
            "passed": outcome.is_right(), "found": outcome.found, "expected": outcome.expected,
        })),
        "advice": advice,
    })
}

fn adapter_json(adapter: &AdapterReport) -> Value {
    json!({
        "index": adapter.index,
        "name": adapter.name,
        "backend": adapter.backend,
        "driver": adapter.driver,
        "device_type": adapter.device_type,
        "max_buffer_bytes": adapter.max_buffer_bytes,
        "max_binding_bytes": adapter.max_binding_bytes,
        "max_texture_2d": adapter.max_texture_2d,
        "storage_buffers_per_stage": adapter.storage_buffers_per_stage,
    })
}

fn write_text(
    out: &mut String,
    adapters: &[AdapterReport],
    chosen: Option<&AdapterReport>,
    fetch: Option<(&str, Reason)>,
    outcome: Option<&Outcome>,
) -> fmt::Result {
    writeln!(out, "adapters   {}", adapters.len())?;
    for adapter in adapters {
        writeln!(out, "  {}  {}", adapter.index, device::describe(adapter))?;
        writeln!(out, "     driver {}", adapter.driver)?;
        writeln!(
            out,
            "     limits: buffers {}, bindings {}, textures {}², {} storage buffers per stage",
            size(adapter.max_buffer_bytes),
            size(adapter.max_binding_bytes),
            adapter.max_texture_2d,
            adapter.storage_buffers_per_stage
        )?;
    }
    if let Some(adapter) = chosen {
        writeln!(out, "used       {}  {}", adapter.index, adapter.name)?;
    }
    if let Some((storage, reason)) = fetch {
        writeln!(
            out,
            "reads      scenes from {storage}s, {}",
            reason.phrase()
        )?;
    }
    match outcome {
        Some(outcome) if outcome.is_right() => writeln!(
            out,
            "self-test  passed: the radiance of the test pixel is {:.4}, as expected",
            outcome.found
        )?,
        Some(_) => writeln!(out, "self-test  failed")?,
        None => writeln!(out, "self-test  not run")?,
    }
    Ok(())
}
