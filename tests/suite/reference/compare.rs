//! Rendering pictures in tests, and comparing two pictures.

use crate::support::devices::Devices;
use glimray::gpu::{AdapterChoice, Gpu};
use glimray::image::Image;
use glimray::pack::{self, PackedScene, PackedView};
use glimray::render::{
    ExecutionPolicy, Fetch, RenderError, RenderSettings, Renderer, Slicing, Stats, Tone,
};
use glimray::scene::Scene;
use std::path::PathBuf;
use std::sync::Arc;

/// The default device, as users have it.
pub fn open_gpu() -> Gpu {
    static DEVICES: Devices = Devices::new(|| Gpu::new(&AdapterChoice::default()));
    DEVICES.lease()
}

/// Test settings, with an optional policy.
pub trait Wanted {
    fn parts(&self) -> (RenderSettings, ExecutionPolicy);
}

impl Wanted for RenderSettings {
    fn parts(&self) -> (RenderSettings, ExecutionPolicy) {
        (self.clone(), ExecutionPolicy::default())
    }
}

impl Wanted for (RenderSettings, ExecutionPolicy) {
    fn parts(&self) -> (RenderSettings, ExecutionPolicy) {
        self.clone()
    }
}

/// The settings with rays counted.
pub fn counting(settings: &RenderSettings) -> (RenderSettings, ExecutionPolicy) {
    let policy = ExecutionPolicy {
        count_rays: true,
        ..ExecutionPolicy::default()
    };
    (settings.clone(), policy)
}

/// The settings with this slicing, and rays counted.
pub fn sliced(settings: &RenderSettings, slicing: Slicing) -> (RenderSettings, ExecutionPolicy) {
    let (settings, policy) = counting(settings);
    (settings, ExecutionPolicy { slicing, ..policy })
}

/// The settings with this kind of fetch.
pub fn fetched(settings: &RenderSettings, fetch: Fetch) -> (RenderSettings, ExecutionPolicy) {
    let policy = ExecutionPolicy {
        fetch,
        ..ExecutionPolicy::default()
    };
    (settings.clone(), policy)
}

/// A renderer before its first step.
pub fn start(scene: &Scene, wanted: &impl Wanted) -> Result<Renderer, RenderError> {
    start_on(open_gpu(), scene, wanted)
}

fn start_on(gpu: Gpu, scene: &Scene, wanted: &impl Wanted) -> Result<Renderer, RenderError> {
    let packed = Arc::new(pack::scene(scene).expect("a scene that can be packed"));
    let view = packed
        .frame(&scene.frame(0.0))
        .expect("a frame that can be packed");
    let (settings, policy) = wanted.parts();
    Renderer::new(gpu, packed, &view, settings, policy)
}

/// A renderer of a packed scene.
#[track_caller]
pub fn start_packed(packed: Arc<PackedScene>, view: &PackedView, wanted: &impl Wanted) -> Renderer {
    let (settings, policy) = wanted.parts();
    Renderer::new(open_gpu(), packed, view, settings, policy)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Renders to the end; the picture is linear radiance.
pub fn try_render(scene: &Scene, wanted: &impl Wanted) -> Result<(Image, Stats), RenderError> {
    try_render_on(open_gpu(), scene, wanted)
}

/// As [`try_render`], on another device.
pub fn try_render_on(
    gpu: Gpu,
    scene: &Scene,
    wanted: &impl Wanted,
) -> Result<(Image, Stats), RenderError> {
    let mut renderer = start_on(gpu, scene, wanted)?;
    while !renderer.is_done() {
        renderer.step()?;
    }
    let image = renderer.develop(&Tone::LINEAR)?;
    Ok((image, renderer.stats().clone()))
}

/// As [`try_render`], panicking on errors.
#[track_caller]
pub fn render(scene: &Scene, wanted: &impl Wanted) -> (Image, Stats) {
    render_on(open_gpu(), scene, wanted)
}

/// As [`render`], on another device.
#[track_caller]
pub fn render_on(gpu: Gpu, scene: &Scene, wanted: &impl Wanted) -> (Image, Stats) {
    try_render_on(gpu, scene, wanted).unwrap_or_else(|error| panic!("{error}"))
}

/// Default settings for a picture of this size.
pub fn sized(width: u32, height: u32) -> RenderSettings {
    RenderSettings {
        size: (width, height),
        ..RenderSettings::default()
    }
}

/// Number of pixels in which some channel, clamped to [0, 1], differs by more than `levels` of 255.
pub fn differing(a: &Image, b: &Image, levels: f32) -> usize {
    assert_eq!((a.width, a.height), (b.width, b.height), "sizes differ");
    let level = |c: f32| c.clamp(0.0, 1.0) * 255.0;
    let far = |(a, b): (&[f32; 4], &[f32; 4])| {
        // NaN counts as different.
        !a.iter()
            .zip(b)
            .all(|(a, b)| (level(*a) - level(*b)).abs() <= levels + 1e-3)
    };
    a.pixels
        .iter()
        .zip(&b.pixels)
        .filter(|pair| far(*pair))
        .count()
}

/// Describes the error unless at most `fraction` of the pixels differ by more than `levels` of 255.
pub fn check_alike(
    name: &str,
    expected: &Image,
    actual: &Image,
    levels: f32,
    fraction: f64,
) -> Result<(), String> {
    let differing = differing(expected, actual, levels);
    let pixels = expected.pixels.len();
    if differing as f64 <= fraction * pixels as f64 {
        return Ok(());
    }
    let path = write_comparison(name, expected, actual);
    Err(format!(
        "{name}: {differing} of {pixels} pixels differ by more than {levels} levels; expected | \
         difference | actual: {}",
        path.display()
    ))
}

/// Describes the error unless the pictures are bit-identical.
pub fn check_same_bits(name: &str, expected: &Image, actual: &Image) -> Result<(), String> {
    assert_eq!(
        (expected.width, expected.height),
        (actual.width, actual.height),
        "{name}"
    );
    let bits = |pixel: &[f32; 4]| pixel.map(f32::to_bits);
    let mut pairs = expected.pixels.iter().zip(&actual.pixels).enumerate();
    let Some((first, (a, b))) = pairs.find(|(_, (a, b))| bits(a) != bits(b)) else {
        return Ok(());
    };
    let count = 1 + pairs.filter(|(_, (a, b))| bits(a) != bits(b)).count();
    let (x, y) = (first as u32 % expected.width, first as u32 / expected.width);
    Err(format!(
        "{name}: {count} pixels differ, first ({x}, {y}): {a:?} became {b:?}"
    ))
}

/// Fails with all problems, or if nothing was compared.
#[track_caller]
pub fn assert_none(results: impl IntoIterator<Item = Result<(), String>>) {
    let results: Vec<_> = results.into_iter().collect();
    assert!(!results.is_empty(), "nothing was looked at");
    let problems: Vec<_> = results.into_iter().filter_map(Result::err).collect();
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// Writes expected | difference (amplified) | actual to the folder for temporary files.
fn write_comparison(name: &str, expected: &Image, actual: &Image) -> PathBuf {
    let (width, height) = (expected.width, expected.height);
    let mut canvas = Image::new(3 * width, height);
    for y in 0..height {
        for x in 0..width {
            let from = (y * width + x) as usize;
            let (a, b) = (expected.pixels[from], actual.pixels[from]);
            let difference = std::array::from_fn(|i| {
                if i == 3 {
                    1.0
                } else {
                    ((a[i] - b[i]).abs() * 32.0).min(1.0)
                }
            });
            for (column, pixel) in [a, difference, b].into_iter().enumerate() {
                let to = y * 3 * width + column as u32 * width + x;
                canvas.pixels[to as usize] = pixel;
            }
        }
    }
    let path = std::env::temp_dir().join(format!("glimray-{}.png", name.replace([' ', '/'], "-")));
    glimray::output::save(&path, &canvas).expect("a comparison");
    path
}

#[test]
#[should_panic(expected = "nothing was looked at")]
fn no_results_are_no_success() {
    assert_none([]);
}
