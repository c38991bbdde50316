//! A window without a screen: egui_kittest with our device.

use crate::support::PATIENCE;
use crate::support::devices::Devices;
use eframe::egui;
use egui_kittest::Harness;
use glimray::gpu::{AdapterChoice, Gpu};
use glimray::image::Image;
use glimray::render::Tone;
use glimray::scene::Camera;
use glimray_cli::view;
use glimray_viewer::model::preferences::Store;
use glimray_viewer::state::session::Session;
use glimray_viewer::window;
use glimray_viewer::window::viewer::Viewer;
use glimray_viewer::worker::progressive_image::PictureSlot;
use glimray_viewer::worker::progressive_image::Shown;
use glimray_viewer::worker::request::RenderRequest;
use std::cell::{RefCell, RefMut};
use std::rc::Rc;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The device of all windows of a thread.
fn open_gpu() -> Gpu {
    static DEVICES: Devices = Devices::new(|| Gpu::with_all_limits(&AdapterChoice::default()));
    DEVICES.lease()
}

/// An open window.
pub struct Window {
    pub harness: Harness<'static, Viewer>,
    pub session: Rc<RefCell<Session>>,
    /// The device that the window uses.
    pub gpu: Gpu,
    /// The window's settings folder.
    #[allow(dead_code, reason = "for tests of what is kept")]
    pub settings: TempDir,
}

impl Window {
    /// `glimray view ARGUMENTS…` in a window of 1000 × 700 points, with no settings kept before but that the hint was read.
    pub fn open(arguments: &[&str]) -> Self {
        let settings = tempfile::tempdir().expect("a folder");
        // The hint that lies over the picture at the first time is not to be in the way.
        let mut store = Store::in_folder(settings.path());
        let (mut preferences, _) = store.load();
        preferences.hint_seen = true;
        store.save(&preferences).expect("settings");
        Self::open_with(arguments, settings)
    }

    /// [`Self::open`] with settings that are in this folder.
    pub fn open_with(arguments: &[&str], settings: TempDir) -> Self {
        let store = Store::in_folder(settings.path());
        let request = view::request(arguments.iter().copied()).expect("a command line");
        let session = Session::new(request, store).expect("a session");
        let session = Rc::new(RefCell::new(session));
        let gpu = open_gpu();
        let (kept, theirs) = (session.clone(), gpu.clone());
        let harness = Harness::builder()
            .with_size(egui::vec2(1000.0, 700.0))
            .with_max_steps(64)
            .with_render_options(window::OPTIONS)
            .wgpu_setup(window::configuration(&gpu).wgpu_setup)
            .build_eframe(move |context| Viewer::new(context, theirs, kept).expect("a viewer"));
        Self {
            harness,
            session,
            gpu,
            settings,
        }
    }

    /// Steps until nothing is left to read, to move or to render.
    pub fn settle(&mut self) {
        let start = Instant::now();
        let mut calm = 0;
        // Clicks come to the window in several frames, and leave it in the next.
        while calm < 8 {
            assert!(start.elapsed() < PATIENCE, "the window does not settle");
            self.harness.step();
            calm = match self.harness.state().is_settled() {
                true => calm + 1,
                false => 0,
            };
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// The published main picture.
    pub fn shown(&self) -> Shown {
        let render = self.harness.state().render_thread();
        render.shown(PictureSlot::Main).expect("a picture")
    }

    /// The last request of the main picture.
    pub fn request(&self) -> RenderRequest {
        let requests = self.session.borrow().requests();
        requests.pictures[PictureSlot::Main as usize]
            .clone()
            .expect("a picture")
    }

    /// The main picture so far.
    pub fn image(&mut self, tone: Tone) -> Image {
        let (sender, receiver) = channel();
        self.session.borrow_mut().ask(move |frame| {
            let (image, _) = frame.image(&tone).expect("a picture");
            sender.send(image).expect("someone who waits");
            glimray_viewer::state::answer::Answer::Nothing
        });
        self.settle();
        // Without one there is no answer either.
        self.shown();
        receiver.recv_timeout(PATIENCE).expect("the picture")
    }

    /// The command line that the window copies.
    pub fn copied(&mut self) -> String {
        self.harness.event(egui::Event::Copy);
        self.harness.step();
        let commands = self.harness.output().platform_output.commands.clone();
        let line = commands.into_iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text),
            _ => None,
        });
        line.expect("a command line")
    }

    /// The camera that the picture is seen by.
    pub fn camera(&self) -> Camera {
        self.session.borrow().camera().expect("a camera")
    }

    /// The current session.
    #[allow(dead_code, reason = "for the tests of each panel")]
    pub fn session(&self) -> RefMut<'_, Session> {
        self.session.borrow_mut()
    }
}
