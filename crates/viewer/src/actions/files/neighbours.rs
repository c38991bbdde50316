//! Renders small pictures of the next and the previous scene of the folder when they are asked for.

use super::dropped;
use crate::state::answer::Answer;
use crate::state::neighbours::Preview;
use crate::state::session::Session;
use crate::worker::job::JobControl;
use crate::worker::request::RenderRequest;
use crate::worker::still;
use glimray_app::layers::PictureLayer;
use glimray_io::import::{self, Options};
use glimray_render::gpu::Gpu;
use glimray_render::{ExecutionPolicy, Integrator, RenderSettings, Tone};
use glimray_scene::image::ScreenImage;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Sender, TryRecvError, channel};

/// Largest width and height, in pixels.
const SIZE: (u32, u32) = (160, 120);
/// Most samples of a pixel. Those of paths are denoised.
const SAMPLES: u32 = 4;
/// Largest file that is read for a small picture, in bytes.
const LARGEST: u64 = 64 << 20;
/// Most pictures that are kept.
const MOST: usize = 32;

/// The next scene of the folder, or the previous one with −1, and its small picture. The picture is rendered the first time that
/// it is asked for.
pub fn neighbour(session: &mut Session, step: isize) -> Option<(PathBuf, Preview)> {
    let here = session.path.clone()?;
    let neighbours = &mut session.files.neighbours;
    if neighbours.of.as_ref().is_none_or(|(of, _)| *of != here) {
        let others = dropped::others(&here);
        let beside = [others.front().cloned(), others.back().cloned()];
        neighbours.of = Some((here, beside));
    }
    let (_, beside) = neighbours.of.as_ref()?;
    let path = beside[usize::from(step < 0)].clone()?;
    let preview = neighbours.preview(&path);
    if preview == Preview::Awaited && neighbours.rendering.is_none() {
        render(session, path.clone());
    }
    Some((path, preview))
}

fn render(session: &mut Session, path: PathBuf) {
    let (sender, receiver) = channel();
    session.files.neighbours.rendering = Some((path.clone(), receiver));
    // The render thread has the device.
    session.ask(move |frame| {
        let gpu = frame.renderer.gpu().clone();
        // Without a thread the sender is dropped, which counts as a failure.
        let _ = std::thread::Builder::new()
            .name("small picture".into())
            .spawn(move || work(gpu, &path, &sender));
        Answer::Nothing
    });
}

fn work(gpu: Gpu, path: &Path, sender: &Sender<Option<ScreenImage>>) {
    // The window may have been closed meanwhile.
    let _ = sender.send(picture(gpu, path));
}

/// The small picture of a file; `None` if it cannot be read or rendered.
fn picture(gpu: Gpu, path: &Path) -> Option<ScreenImage> {
    if std::fs::metadata(path).ok()?.len() > LARGEST {
        return None;
    }
    let scene = import::load_with(path, &Options::default()).ok()?;
    let settings = RenderSettings::from(&scene.output);
    let (width, height) = settings.size;
    let share = (f64::from(SIZE.0) / f64::from(width)).min(f64::from(SIZE.1) / f64::from(height));
    let side = |length: u32| ((f64::from(length) * share).round() as u32).max(1);
    let is_path = settings.integrator == Integrator::Path;
    let tone = Tone {
        denoise: is_path,
        ..Tone::of_scene(&scene.output, settings.integrator)
    };
    let request = RenderRequest {
        restarts: 0,
        camera: None,
        background: None,
        shutter_interval: (0.0, 0.0),
        settings: RenderSettings {
            size: (side(width), side(height)),
            crop: None,
            samples: settings.samples.min(SAMPLES),
            features: is_path,
            ..settings
        },
        policy: ExecutionPolicy::default(),
        tone,
        layer: PictureLayer::Beauty,
        false_color: false,
        denoises_previews: false,
        scene: Arc::new(scene),
    };
    let still = still::render(gpu, &request, &tone, false, &JobControl::default()).ok()??;
    Some(ScreenImage::from(&still.image))
}

/// Takes a picture that is rendered.
pub(in crate::actions) fn update(session: &mut Session) {
    let neighbours = &mut session.files.neighbours;
    let Some((path, receiver)) = neighbours.rendering.take() else {
        return;
    };
    let preview = match receiver.try_recv() {
        Ok(Some(image)) => Preview::Picture(Arc::new(image)),
        Ok(None) | Err(TryRecvError::Disconnected) => Preview::Missing,
        Err(TryRecvError::Empty) => {
            neighbours.rendering = Some((path, receiver));
            return;
        }
    };
    if neighbours.known.len() == MOST {
        neighbours.known.remove(0);
    }
    neighbours.known.push((path, preview));
}
