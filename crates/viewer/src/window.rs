//! The native window: opened with our device, and reopened when the device is lost.

mod events;
mod fonts;
mod presses;
pub mod viewer;

use crate::actions::settings;
use crate::model::preferences::Preferences;
use crate::state::session::Session;
use crate::window::viewer::Viewer;
use eframe::UserEvent;
use eframe::egui;
use eframe::egui_wgpu::{
    RendererOptions, SurfaceErrorAction, WgpuConfiguration, WgpuSetup, WgpuSetupExisting,
};
use glimray_app::error::AppError;
use glimray_app::{console, scene_file, storage};
use glimray_render::gpu::{AdapterChoice, Gpu, GpuError};
use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::event_loop::EventLoop;

/// Maximum number of device losses within this time before the program ends.
const MAX_LOSSES: usize = 3;
const RECENT: Duration = Duration::from_secs(600);

/// Runs the window until the user closes it.
///
/// # Errors
/// There is no display, or no device that can draw on it; or the device is lost again and again.
pub fn run(session: Session, choice: &AdapterChoice) -> Result<(), AppError> {
    check_display()?;
    let session = Rc::new(RefCell::new(session));
    let events = EventLoop::with_user_event().build();
    let mut events = events.map_err(|error| no_display(reason(&error.to_string())))?;
    session.borrow_mut().request.policy.storage = storage::requested()?;
    let mut losses = Vec::new();
    loop {
        let shown = Gpu::with_all_limits(choice)
            .map_err(AppError::from)
            .and_then(|gpu| show(&mut events, &session, &gpu));
        if let Err(error) = shown {
            return Err(rescued(&session.borrow(), error));
        }
        if !session.borrow_mut().is_to_reopen() {
            return Ok(());
        }
        losses.retain(|loss: &Instant| loss.elapsed() < RECENT);
        losses.push(Instant::now());
        if losses.len() > MAX_LOSSES {
            let count = losses.len() as u32;
            return Err(rescued(
                &session.borrow(),
                GpuError::KeptFailing { count }.into(),
            ));
        }
        let told =
            "the GPU was lost (driver reset or timeout) and is reopened. Rendering restarts.";
        session.borrow_mut().messages.warn(told.into());
    }
}

/// Writes unsaved changes to a temporary file and reports its path.
fn rescued(session: &Session, error: AppError) -> AppError {
    let Some(scene) = session.scene().filter(|_| session.has_changes()) else {
        return error;
    };
    let name = format!("glimray_rescued_{}.toml", std::process::id());
    let path = std::env::temp_dir().join(name);
    match scene_file::save(&path, scene, false) {
        Ok(_) => console::warning(format_args!(
            "unsaved changes were written to {}.",
            path.display()
        )),
        Err(why) => console::warning(format_args!("unsaved changes could not be written: {why}")),
    }
    error
}

/// Configures eframe to draw with our device.
pub fn configuration(gpu: &Gpu) -> WgpuConfiguration {
    let (instance, adapter, device, queue) = gpu.handles();
    let usual = WgpuConfiguration::default();
    let (gpu, react) = (gpu.clone(), usual.on_surface_status);
    WgpuConfiguration {
        // A surface that no longer suits is configured at once. The event loop lets others submit again afterwards.
        on_surface_status: Arc::new(move |status| {
            let action = react(status);
            if matches!(action, SurfaceErrorAction::Reconfigure) {
                gpu.hold_submissions();
            }
            action
        }),
        wgpu_setup: WgpuSetup::Existing(WgpuSetupExisting {
            instance,
            adapter,
            device,
            queue,
        }),
        surface: usual.surface,
    }
}

/// Draw options. Dithering is off so that pictures keep the values of saved files.
pub const OPTIONS: RendererOptions = RendererOptions {
    dithering: false,
    ..RendererOptions::PREDICTABLE
};

/// Initial size of the window, in points.
const SIZE: [f32; 2] = [1280.0, 800.0];

/// Runs the window until it is closed or the device is lost.
fn show(
    events: &mut EventLoop<UserEvent>,
    session: &Rc<RefCell<Session>>,
    gpu: &Gpu,
) -> Result<(), AppError> {
    let options = eframe::NativeOptions {
        viewport: place(&session.borrow().preferences)
            .with_title("glimray")
            .with_app_id("glimray")
            .with_min_inner_size([320.0, 240.0])
            .with_drag_and_drop(true),
        wgpu_options: configuration(gpu),
        dithering: false,
        ..Default::default()
    };
    // eframe does not return the outcome of the creator.
    let opened = Rc::new(Cell::new(Err("the desktop opened none".to_owned())));
    let creator = {
        let (session, gpu, opened) = (session.clone(), gpu.clone(), opened.clone());
        move |context: &eframe::CreationContext| {
            bring_in(context);
            let viewer = Viewer::new(context, gpu, session);
            let outcome = viewer.as_ref().map(|_| ()).map_err(ToString::to_string);
            opened.set(outcome);
            Ok(Box::new(viewer?) as Box<dyn eframe::App>)
        }
    };
    let app = eframe::create_native("glimray", options, Box::new(creator), events);
    let is_lost =
        events::run(events, app, gpu).map_err(|error| no_display(reason(&error.to_string())))?;
    settings::write(&mut session.borrow_mut());
    if is_lost {
        session.borrow_mut().lost_device();
        return Ok(());
    }
    opened.replace(Ok(())).map_err(|why| {
        let adapter = gpu.adapter();
        match adapter.backend == "gl" && adapter.is_cpu() {
            true => AppError::NoDisplay(NO_VULKAN.to_owned()),
            false => no_display(&why),
        }
    })
}

/// Restores the window's position and size.
fn place(kept: &Preferences) -> egui::ViewportBuilder {
    let size = kept.window.unwrap_or(SIZE);
    let viewport = egui::ViewportBuilder::default().with_inner_size(size);
    let viewport = viewport.with_maximized(kept.maximized);
    match kept.window_position {
        Some(position) => viewport.with_position(position),
        None => viewport,
    }
}

/// The window's screen may be gone; the position is limited so that its title bar stays reachable.
fn bring_in(context: &eframe::CreationContext) {
    let Some(window) = context.winit_window() else {
        return;
    };
    let Ok(corner) = window.outer_position() else {
        return;
    };
    let middle = corner
        .x
        .saturating_add_unsigned(window.outer_size().width / 2);
    let screens: Vec<_> = window.available_monitors().collect();
    let shows_title = screens.iter().any(|screen| {
        let (place, size) = (screen.position(), screen.size());
        (place.x..place.x.saturating_add_unsigned(size.width)).contains(&middle)
            && (place.y..place.y.saturating_add_unsigned(size.height)).contains(&corner.y)
    });
    if !shows_title && !screens.is_empty() {
        let corner = egui::ViewportCommand::OuterPosition(egui::Pos2::ZERO);
        context.egui_ctx.send_viewport_cmd(corner);
    }
}

/// Why no window opens although there is a display.
const NO_VULKAN: &str = "cannot open a window: there is no Vulkan driver that can show pictures. Install one, such as \
    Mesa's: mesa-vulkan-drivers (Debian, Ubuntu, Fedora), vulkan-swrast (Arch) or mesa-vulkan-swrast (Alpine).";

/// Without one of these variables the connection fails, with a less helpful message.
fn check_display() -> Result<(), AppError> {
    match has_display() {
        true => Ok(()),
        false => Err(no_display("neither DISPLAY nor WAYLAND_DISPLAY is set")),
    }
}

/// Whether a display seems to be available.
pub fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux")
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"]
            .into_iter()
            .any(is_set)
}

/// The text of a winit error without source locations.
fn reason(message: &str) -> &str {
    message.rsplit(": ").next().unwrap_or(message)
}

fn no_display(why: &str) -> AppError {
    AppError::NoDisplay(format!(
        "cannot open a window (no display): {}. Render to a file instead: glimray render SCENE -o \
         picture.png",
        why.trim_end_matches('.')
    ))
}
