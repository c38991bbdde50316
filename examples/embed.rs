//! glimray embedded in another program: a plain winit and wgpu window whose device renders the picture. Nothing
//! here waits for the GPU: each frame of the window polls the renderer, submits more work, and draws its
//! texture.
//!
//! ```text
//! cargo run --release --example embed -- assets/scenes/still_life.toml [--until-done]
//! ```

use glimray::gpu::Gpu;
use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Screen, Status, Tone};
use glimray::{import, pack};
use std::{error::Error, path::Path, sync::Arc};
use wgpu::util::TextureBlitter;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::window::{Window, WindowId};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut program = Program {
        scene: arguments.next().ok_or("name a scene")?,
        until_done: arguments.next().is_some_and(|word| word == "--until-done"),
        view: None,
        failure: None,
    };
    EventLoop::new()?.run_app(&mut program)?;
    program.failure.map_or(Ok(()), Err)
}

struct Program {
    scene: String,
    /// Closes the window once every pixel has all its samples.
    until_done: bool,
    view: Option<View>,
    failure: Option<Box<dyn Error>>,
}

impl ApplicationHandler for Program {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        match View::new(events, &self.scene) {
            Ok(view) => self.view = Some(view),
            Err(error) => {
                self.failure = Some(error);
                events.exit();
            }
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(view) = &mut self.view else { return };
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => view.resize(size),
            WindowEvent::RedrawRequested => match view.draw() {
                Ok(Status::Done) if self.until_done => {
                    println!("{} samples", view.renderer.samples_done());
                    events.exit();
                }
                Ok(Status::Done) => {}
                Ok(_) => view.window.request_redraw(),
                Err(error) => {
                    self.failure = Some(error);
                    events.exit();
                }
            },
            _ => {}
        }
    }
}

struct View {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    device: wgpu::Device,
    queue: wgpu::Queue,
    blitter: TextureBlitter,
    renderer: Renderer,
    tone: Tone,
    screen: Screen,
}

impl View {
    fn new(events: &ActiveEventLoop, scene: &str) -> Result<Self, Box<dyn Error>> {
        let scene = import::load(Path::new(scene))?;
        let (width, height) = scene.output.size;
        let attributes = Window::default_attributes()
            .with_title("A program with a picture")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(events.create_window(attributes)?);

        // The set-up of any wgpu program.
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle(Box::new(
            events.owned_display_handle(),
        ));
        let instance = wgpu::Instance::new(descriptor);
        let surface = instance.create_surface(window.clone())?;
        let options = wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))?;
        // With a fifth storage image glimray can read scenes from images, which is faster on software adapters.
        let images = adapter
            .limits()
            .max_storage_textures_per_shader_stage
            .min(5);
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits {
                max_storage_textures_per_shader_stage: images,
                ..Default::default()
            },
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))?;
        let mut configuration = surface
            .get_default_config(&adapter, width, height)
            .ok_or("the adapter cannot draw on this window")?;
        // The picture is already encoded for display.
        configuration.format = configuration.format.remove_srgb_suffix();
        surface.configure(&device, &configuration);

        // The set-up of glimray.
        let packed = Arc::new(pack::scene(&scene)?);
        let frame = packed.frame(&scene.frame(0.0))?;
        let gpu = Gpu::from_wgpu(instance, adapter, device.clone(), queue.clone());
        let settings = RenderSettings::from(&scene.output);
        // Keep the film on the GPU, where it can be displayed directly.
        let policy = ExecutionPolicy {
            host_copy: false,
            ..ExecutionPolicy::default()
        };
        let renderer = Renderer::new(gpu, packed, &frame, settings, policy)?;
        let screen = renderer.new_screen()?;

        Ok(Self {
            blitter: TextureBlitter::new(&device, configuration.format),
            window,
            surface,
            configuration,
            device,
            queue,
            renderer,
            tone: Tone::from(&scene.output),
            screen,
        })
    }

    fn resize(&mut self, size: PhysicalSize<u32>) {
        self.configuration.width = size.width.max(1);
        self.configuration.height = size.height.max(1);
        self.surface.configure(&self.device, &self.configuration);
        self.window.request_redraw();
    }

    /// One frame of the window: collects finished work, submits more, and draws the picture.
    fn draw(&mut self) -> Result<Status, Box<dyn Error>> {
        let status = self.renderer.poll()?;
        if status != Status::Working {
            self.renderer.submit()?;
            self.renderer.show(&self.tone, &self.screen)?;
        }
        use wgpu::CurrentSurfaceTexture::{Outdated, Suboptimal, Success};
        match self.surface.get_current_texture() {
            Success(frame) | Suboptimal(frame) => {
                let target = frame.texture.create_view(&Default::default());
                let mut encoder = self.device.create_command_encoder(&Default::default());
                let picture = self.screen.view();
                (self.blitter).copy(&self.device, &mut encoder, picture, &target);
                self.queue.submit([encoder.finish()]);
                self.window.pre_present_notify();
                self.queue.present(frame);
            }
            Outdated => self.surface.configure(&self.device, &self.configuration),
            // The window is not visible.
            _ => {}
        }
        Ok(status)
    }
}
