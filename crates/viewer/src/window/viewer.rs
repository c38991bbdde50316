//! The contents of the window: passes input to the [`Session`], requests pictures and draws them.

use crate::actions::commands;
use crate::actions::cursor;
use crate::actions::files::{cameras, pictures};
use crate::actions::{settings, sight, tools, update};
use crate::model::tool::Tool;
use crate::state::answer::Answer;
use crate::state::layout::Layout;
use crate::state::session::Session;
use crate::ui::context::PanelContext;
use crate::ui::dialogs;
use crate::ui::textures::Textures;
use crate::ui::{dragged, focus_ring, panels, shield, tabs, theme};
use crate::window::fonts::{self, Fallbacks};
use crate::window::presses::Presses;
use crate::worker::progressive_image::PictureSlot;
use crate::worker::progressive_image::wait_limit;
use crate::worker::render_thread::{Fault, RenderRequests, RenderThread};
use eframe::egui;
use glimray_render::gpu::Gpu;
use std::cell::RefCell;
use std::rc::Rc;
use std::time::Duration;

/// Interval of updates while the window is hidden.
const HIDDEN: Duration = Duration::from_millis(200);

/// Number of requests sent without waiting, after one wait has timed out.
const IN_VAIN: u32 = 16;

/// The session, its render thread and the drawing state. Lives as long as its device.
pub struct Viewer {
    session: Rc<RefCell<Session>>,
    render: RenderThread<Answer>,
    textures: Textures,
    layout: Layout,
    wanted: Pictures,
    presses: Presses,
    fallbacks: Fallbacks,
    /// Whether the window is cleared with [`eframe::App::clear_color`] first.
    is_cleared: bool,
    /// Index of the last frame drawn.
    last_pass: Option<u64>,
}

impl Viewer {
    /// A viewer that draws with `gpu`, which must be the device of `context`.
    ///
    /// # Errors
    /// The render thread cannot be started, or eframe does not use wgpu.
    pub fn new(
        context: &eframe::CreationContext,
        gpu: Gpu,
        session: Rc<RefCell<Session>>,
    ) -> Result<Self, Box<dyn std::error::Error + Send + Sync>> {
        context.egui_ctx.set_fonts(fonts::own());
        theme::install(&context.egui_ctx);
        let state = context.wgpu_render_state.clone();
        let ctx = context.egui_ctx.clone();
        let wanted = Pictures {
            requests: RenderRequests::default(),
            wait_limit: wait_limit(&gpu),
            until_wait: 0,
        };
        let render = RenderThread::new(gpu, move || ctx.request_repaint())?;
        update::reopened(&mut session.borrow_mut());
        let layout = Layout::kept(&session.borrow().preferences);
        Ok(Self {
            session,
            render,
            textures: Textures::new(state.ok_or("eframe does not draw with wgpu")?),
            layout,
            wanted,
            presses: Presses::default(),
            fallbacks: Fallbacks::default(),
            is_cleared: context.winit_window().is_some(),
            last_pass: None,
        })
    }

    /// Whether loading, motion and rendering have finished.
    pub fn is_settled(&self) -> bool {
        self.render.is_settled() && self.session.borrow().is_at_rest()
    }

    /// The current session.
    pub fn session(&self) -> Rc<RefCell<Session>> {
        self.session.clone()
    }

    /// The layout of the panels.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The render thread.
    pub fn render_thread(&self) -> &RenderThread<Answer> {
        &self.render
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        if let Ok(mut session) = self.session.try_borrow_mut() {
            settings::store_layout(&mut session, &self.layout);
        }
    }
}

impl eframe::App for Viewer {
    fn raw_input_hook(&mut self, ctx: &egui::Context, raw: &mut egui::RawInput) {
        let mut session = self.session.borrow_mut();
        if let Some(note) = session.recording.pass(ctx, raw) {
            session.messages.warn(note);
        }
        if self.presses.pass(raw) {
            ctx.request_repaint();
        }
    }

    fn logic(&mut self, ctx: &egui::Context, _: &mut eframe::Frame) {
        let mut session = self.session.borrow_mut();
        for answer in self.render.answers() {
            session.handle_answer(answer);
        }
        match self.render.fault() {
            Some(Fault::Lost) => {
                session.lost_device();
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
            Some(Fault::Refused(why)) => session.refused(Some(why)),
            None => session.refused(None),
        }
        // A hidden window draws no frames; its input is that of the last one.
        let pass = ctx.cumulative_pass_nr();
        let is_hidden = self.last_pass.replace(pass) == Some(pass);
        if is_hidden {
            update::update_hidden(&mut session);
        } else {
            commands::keys(&mut session, &mut self.layout, ctx);
            update::update(&mut session, ctx);
        }
        if session.tool != Tool::Inspect {
            self.layout.hide_rays();
        }
        let shown = self.render.shown(PictureSlot::Main);
        let progress = shown.map(|shown| shown.progress).unwrap_or_default();
        pictures::finish(&mut session, progress.is_done);
        cursor::update(&mut session, &progress);
        tools::aim(&mut session, &progress);
        cameras::picture(&mut session, &progress);
        sight::update(&mut session, &progress);
        let paused = session.view.paused;
        session.time_left.update(&progress, paused);
        session.set_spent(match progress.is_coarse {
            true => 0.0,
            false => progress.trace_seconds,
        });
        settings::update(&mut session, ctx);
        for question in session.questions.drain(..) {
            self.render.ask(question);
        }
        self.wanted.submit(&self.render, &session);
        if session.is_at_rest() && self.presses.is_empty() && session.recording.is_to_close() {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        if let Some(wait) = session.until_next_frame() {
            let least = if is_hidden { HIDDEN } else { Duration::ZERO };
            ctx.request_repaint_after(wait.max(least));
        }
    }

    /// Colour behind the panels: on software, clearing is faster than filling.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        if !self.is_cleared {
            let ground = ui.visuals().panel_fill;
            ui.painter().rect_filled(ui.max_rect(), 0.0, ground);
        }
        let mut session = self.session.borrow_mut();
        self.textures.begin_frame();
        let mut context = PanelContext {
            session: &mut session,
            render: &self.render,
            textures: &mut self.textures,
        };
        panels::menu(ui, &mut context, &mut self.layout);
        panels::status(ui, &mut context);
        tabs::show(ui, &mut self.layout, &mut context);
        dragged::show(ui.ctx(), context.session);
        shield::show(ui.ctx(), context.session);
        dialogs::show(ui, &mut context, &mut self.layout);
        panels::messages(ui, &mut context, &self.layout);
        focus_ring::show(ui.ctx());
        self.fallbacks.update(ui.ctx(), context.session);
        self.textures.end();
        // Input of this frame is shown in this frame.
        if self.wanted.submit(&self.render, &session) {
            ui.ctx().request_discard("a new picture is available");
        }
    }
}

/// The last request, and whether the window waits for it.
struct Pictures {
    requests: RenderRequests,
    /// Maximum time to wait.
    wait_limit: Duration,
    /// Number of requests not to wait for.
    until_wait: u32,
}

impl Pictures {
    /// Sends the current request if it has changed. Waits for its first picture, mostly the coarse one,
    /// unless recent waits timed out.
    fn submit(&mut self, render: &RenderThread<Answer>, session: &Session) -> bool {
        let requests = session.requests();
        let is_same = requests.is_same(&self.requests);
        let has_ball = requests.ball == self.requests.ball;
        if is_same && has_ball && requests.shares_prepared(&self.requests) {
            return false;
        }
        render.submit(requests.clone());
        self.requests = requests;
        if is_same {
            // Better BVHs and previews of materials bring no picture that is worth waiting for.
            return false;
        }
        if self.until_wait > 0 {
            self.until_wait -= 1;
            return false;
        }
        let is_there = render.wait_for_look(self.wait_limit);
        if !is_there {
            self.until_wait = IN_VAIN;
        }
        is_there
    }
}
