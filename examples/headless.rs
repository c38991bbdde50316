//! Renders a scene file to a picture without a window: `cargo run --release --example headless -- SCENE
//! OUT.png`

use glimray::gpu::{AdapterChoice, Gpu};
use glimray::render::{ExecutionPolicy, RenderSettings, Renderer, Tone};
use glimray::{import, output, pack};
use std::{error::Error, path::Path, sync::Arc};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(from), Some(to)) = (arguments.next(), arguments.next()) else {
        return Err("name a scene and the picture to write".into());
    };
    let scene = import::load(Path::new(&from))?;
    let packed = Arc::new(pack::scene(&scene)?);
    let view = packed.frame(&scene.frame(0.0))?;
    let gpu = Gpu::new(&AdapterChoice::default())?;
    let settings = RenderSettings::from(&scene.output);
    let mut renderer = Renderer::new(gpu, packed, &view, settings, ExecutionPolicy::default())?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    let tone = Tone::from(&scene.output);
    output::save(&to, &renderer.develop(&tone)?)?;
    Ok(())
}
