//! Runs eframe's event loop with a panic handler: if the device is lost during a frame, only that window
//! closes.

use eframe::{EframeWinitApplication, UserEvent};
use glimray_render::gpu::{self, Gpu, GpuError};
use winit::application::ApplicationHandler;
use winit::error::EventLoopError;
use winit::event::{DeviceEvent, DeviceId, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::platform::run_on_demand::EventLoopExtRunOnDemand;
use winit::window::WindowId;

/// Runs `app`, which draws with `gpu`, until its window is closed. Returns whether eframe panicked because
/// the device was lost.
///
/// # Errors
/// The window system failed.
pub fn run(
    events: &mut EventLoop<UserEvent>,
    app: EframeWinitApplication,
    gpu: &Gpu,
) -> Result<bool, EventLoopError> {
    let mut guarded = Guarded {
        app,
        gpu,
        is_lost: false,
        unsettled: 0,
    };
    events.run_app_on_demand(&mut guarded)?;
    let Guarded { app, is_lost, .. } = guarded;
    // Dropping a half-finished frame may panic again. That must not happen during the first panic, which
    // would abort the process.
    let put_away = gpu::surviving_loss(gpu, || drop(app));
    Ok(is_lost || matches!(put_away, Err(GpuError::Lost)))
}

/// Wraps eframe, which gets no more events after it has panicked.
struct Guarded<'a> {
    app: EframeWinitApplication<'a>,
    gpu: &'a Gpu,
    is_lost: bool,
    /// Number of frames that may configure the surface once more after a change of size.
    unsettled: u32,
}

/// Number of frames after a change of size in which egui may find that the surface no longer suits.
const UNSETTLED: u32 = 3;

impl<'a> Guarded<'a> {
    fn hand(
        &mut self,
        events: &ActiveEventLoop,
        act: impl FnOnce(&mut EframeWinitApplication<'a>, &ActiveEventLoop),
    ) {
        if self.is_lost {
            return;
        }
        let app = &mut self.app;
        if gpu::surviving_loss(self.gpu, || act(app, events)).is_err() {
            self.is_lost = true;
            events.exit();
        }
        self.gpu.release_submissions();
    }

    /// Keeps other threads from submitting during an event that may configure the surface.
    fn keep_still(&mut self, event: &WindowEvent) {
        let may_configure = match event {
            WindowEvent::Resized(_) => {
                self.unsettled = UNSETTLED;
                true
            }
            WindowEvent::RedrawRequested => self.unsettled > 0,
            _ => false,
        };
        if may_configure && !self.is_lost {
            self.gpu.hold_submissions();
        }
        if matches!(event, WindowEvent::RedrawRequested) {
            self.unsettled = self.unsettled.saturating_sub(1);
        }
    }
}

impl ApplicationHandler<UserEvent> for Guarded<'_> {
    fn new_events(&mut self, events: &ActiveEventLoop, cause: StartCause) {
        self.hand(events, |app, events| app.new_events(events, cause));
    }

    fn resumed(&mut self, events: &ActiveEventLoop) {
        self.hand(events, |app, events| app.resumed(events));
    }

    fn user_event(&mut self, events: &ActiveEventLoop, event: UserEvent) {
        self.hand(events, |app, events| app.user_event(events, event));
    }

    fn window_event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) {
        self.keep_still(&event);
        self.hand(events, |app, events| {
            app.window_event(events, window, event)
        });
    }

    fn device_event(&mut self, events: &ActiveEventLoop, device: DeviceId, event: DeviceEvent) {
        self.hand(events, |app, events| {
            app.device_event(events, device, event)
        });
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        self.hand(events, |app, events| app.about_to_wait(events));
    }

    fn suspended(&mut self, events: &ActiveEventLoop) {
        self.hand(events, |app, events| app.suspended(events));
    }

    fn exiting(&mut self, events: &ActiveEventLoop) {
        self.hand(events, |app, events| app.exiting(events));
    }

    fn memory_warning(&mut self, events: &ActiveEventLoop) {
        self.hand(events, |app, events| app.memory_warning(events));
    }
}
