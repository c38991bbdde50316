//! The denoiser: closed forms of its filter, what it keeps, and what it gains on a rendered picture.

use crate::reference::compare::{open_gpu, start};
use crate::support::program::Workspace;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glimray::image::{Image, ScreenImage};
use glimray::render::{
    ExecutionPolicy, Features, Fetch, Filter, Integrator, PixelFeatures, RenderSettings, Renderer,
    Tone, denoise,
};
use glimray::scene::{Antialias, Transfer};
use glimray::{import, pack};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

const SIDE: u32 = 160;

/// A picture whose pixels have the given radiance, without noise of their own, on one white surface.
fn picture(color: impl Fn(u32, u32) -> [f32; 3], variance: f32) -> (Image, Features) {
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let pixel = |(x, y)| PixelFeatures {
        radiance: color(x, y),
        albedo: [1.0; 3],
        normal: [0.0, 0.0, 1.0],
        depth: 2.0,
        variance,
        samples: 16.0,
        ..PixelFeatures::default()
    };
    let features = Features {
        width: SIDE,
        height: SIDE,
        pixels: places.map(pixel).collect(),
    };
    (features.picture(), features)
}

fn denoised((image, features): &(Image, Features)) -> Image {
    let denoised = denoise(image, &open_gpu(), features);
    denoised.expect("a denoised picture").image
}

#[test]
fn a_constant_picture_stays_as_it_is() {
    for variance in [0.0, 1e-4, 1e6] {
        let found = denoised(&picture(|_, _| [0.3, 0.5, 7.0], variance));
        for pixel in &found.pixels {
            for (value, wanted) in pixel.iter().zip([0.3, 0.5, 7.0, 1.0]) {
                assert!((value - wanted).abs() <= 1e-5 * wanted, "{pixel:?}");
            }
        }
    }
}

#[test]
fn passes_take_a_part_of_the_time() {
    let gpu = open_gpu();
    let mut given = picture(|_, _| [0.3, 0.5, 7.0], 1.0);
    for transparency in [0.0, 0.5] {
        for pixel in &mut given.1.pixels {
            pixel.transparency = transparency;
        }
        let started = Instant::now();
        let denoised = denoise(&given.0, &gpu, &given.1).expect("a picture");
        let whole = started.elapsed().as_secs_f64();
        // Adapters without timestamps have none.
        if let Some(passes) = denoised.pass_seconds {
            assert!(passes > 0.0 && passes < whole, "{passes} of {whole} s");
        }
    }
}

/// Where nothing stops it, each pass at a distance of s multiplies a wave of frequency f by (1 + cos(f s)) / 2 along each
/// axis: its weights are 1/4, 1/2 and 1/4.
#[test]
fn waves_fall_by_the_closed_form_factor_of_the_filter() {
    let strides = [1.0, 2.0, 4.0, 8.0, 16.0];
    for (across, down, opacity) in [
        (0.02, 0.05, 1.0),
        (0.1, 0.04, 1.0),
        (0.15, 0.0, 1.0),
        (0.1, 0.04, 0.5),
    ] {
        let wave = |x: u32, y: u32| (across * f64::from(x)).cos() * (down * f64::from(y)).cos();
        let gain = |frequency: f64| -> f64 {
            let pass = |stride: &f64| (1.0 + (frequency * stride).cos()) / 2.0;
            strides.iter().map(pass).product()
        };
        let (_, mut features) = picture(|x, y| [1.0 + 0.1 * wave(x, y) as f32; 3], 1e8);
        for pixel in &mut features.pixels {
            cover(pixel, opacity);
        }
        let found = denoised(&(features.picture(), features));
        // Beyond the reach of the filter from the borders, where it is cut.
        for (x, y) in (32..SIDE - 32).flat_map(|y| (32..SIDE - 32).map(move |x| (x, y))) {
            let wanted = 1.0 + 0.1 * gain(across) * gain(down) * wave(x, y);
            let value = f64::from(found.pixel(x, y).expect("inside")[0]);
            assert!(
                (value - wanted).abs() < 2e-4,
                "{x},{y}: {value}, not {wanted}"
            );
        }
    }
}

/// Leaves so much of a pixel, which shows nothing else.
fn cover(pixel: &mut PixelFeatures, opacity: f32) {
    pixel.transparency = 1.0 - opacity;
    for value in (pixel.radiance.iter_mut())
        .chain(&mut pixel.albedo)
        .chain(&mut pixel.normal)
    {
        *value *= opacity;
    }
}

/// A white disc that shines by itself in front of nothing, whose edge has this width: what of it samples find, and the
/// exact opacity.
fn disc(edge: f32, samples: u32) -> (Image, Features, Vec<f32>) {
    let mut random = Random::new(7);
    let middle = SIDE as f32 / 2.0;
    let (_, mut features) = picture(|_, _| [1.0; 3], 0.0);
    let mut exact = Vec::new();
    for (index, pixel) in features.pixels.iter_mut().enumerate() {
        let place = [index as u32 % SIDE, index as u32 / SIDE].map(|at| at as f32 + 0.5 - middle);
        let distance = place[0].hypot(place[1]);
        let opacity = ((50.0 - distance) / edge + 0.5).clamp(0.0, 1.0);
        let hits = (0..samples).filter(|_| random.between(0.0, 1.0) < f64::from(opacity));
        let found = hits.count() as f32 / samples as f32;
        cover(pixel, found);
        let variance = found * (1.0 - found) / (samples - 1) as f32;
        (pixel.variance, pixel.albedo_variance) = (variance, variance);
        pixel.samples = samples as f32;
        pixel.depth = if distance < 50.0 { 2.0 } else { 0.0 };
        exact.push(opacity);
    }
    (features.picture(), features, exact)
}

/// A disc of one colour has that colour at each pixel that shows anything of it, and smoother opacity than before.
#[test]
fn edges_of_transparent_pictures_have_no_fringe() {
    let mut verdict = Verdict::on("edges");
    for (edge, samples) in [(1.0, 4), (1.0, 64), (20.0, 4), (20.0, 64)] {
        let (image, features, exact) = disc(edge, samples);
        let found = denoised(&(image.clone(), features));
        let name = format!("{edge} pixels, {samples} samples");
        let seen = found.pixels.iter().filter(|pixel| pixel[3] > 1e-3);
        let off = seen.flat_map(|[r, g, b, _]| [r, g, b].map(|value| (value - 1.0).abs()));
        let off = off.fold(0.0, f32::max);
        verdict.that(&name, off < 2e-3, || format!("a colour is off by {off}"));
        let error = |image: &Image| {
            let pairs = image.pixels.iter().zip(&exact);
            let squares = pairs.map(|(pixel, exact)| (pixel[3] - exact).powi(2));
            (squares.sum::<f32>() / exact.len() as f32).sqrt()
        };
        let (before, after) = (error(&image), error(&found));
        // Features hold hard edges as they are, and guide less well where few samples make them noisy.
        let most = match (edge > 1.0, samples) {
            (false, _) => 1.1,
            (true, 4) => 0.9,
            (true, _) => 0.7,
        };
        verdict.that(&name, after <= most * before, || {
            format!("opacity is off by {after}, and was by {before}")
        });
    }
    verdict.close();
}

/// PNG has colours that were not multiplied by opacity, OpenEXR those that were.
#[test]
fn files_of_denoised_transparent_pictures_have_no_fringe() {
    let workspace = Workspace::new();
    workspace.write(
        "disc.toml",
        "[camera]\nlook_from = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov_y_deg = 40\n\
         [[objects]]\ndisc = { center = [0, 0, 0], normal = [0, 0, 1], radius = 1 }\n\
         material = { phong = {}, emission = [1, 1, 1] }\n",
    );
    let flags = "--integrator path --background transparent --samples 16 --denoise --size 48x48 \
                 --tone none --exposure 0";
    for layers in ["", " --layers beauty"] {
        let run = workspace.run(&format!("render disc.toml {flags}{layers} -o o.exr"));
        run.expect(0);
        let picture = image::open(workspace.path("o.exr")).expect("a picture");
        let pixels = picture.into_rgba32f();
        let edges = pixels.pixels().filter(|p| p.0[3] > 0.02 && p.0[3] < 0.98);
        assert!(edges.count() > 20);
        for pixel in pixels.pixels() {
            let [r, _, _, a] = pixel.0;
            assert!((r - a).abs() < 2e-3, "{pixel:?}");
        }
    }
    let run = workspace.run(&format!("render disc.toml {flags} -o o.png"));
    run.expect(0);
    let picture = image::open(workspace.path("o.png")).expect("a picture");
    for pixel in picture.into_rgba8().pixels() {
        let is_white = pixel.0[..3].iter().all(|value| *value >= 254);
        assert!(pixel.0[3] == 0 || is_white, "{pixel:?}");
    }
}

/// Both sides are so noisy that only features keep them apart.
#[test]
fn edges_of_every_feature_stay() {
    type Change = fn(&mut PixelFeatures);
    let changes: [(&str, Change); 3] = [
        ("albedo", |pixel| pixel.albedo = [0.1, 0.1, 0.9]),
        ("normal", |pixel| pixel.normal = [1.0, 0.0, 0.0]),
        ("depth", |pixel| pixel.depth = 4.0),
    ];
    let color = |x: u32, _| if x < SIDE / 2 { [1.0; 3] } else { [3.0; 3] };
    let (image, plain) = picture(color, 1e8);
    let middle = SIDE / 2;
    let error = |found: &Image| {
        let own = found.pixels.iter().zip(&image.pixels);
        own.map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max)
    };
    let blurred = denoised(&(image.clone(), plain.clone()));
    assert!(error(&blurred) > 0.5, "without an edge the filter averages");
    for (name, change) in changes {
        let mut features = plain.clone();
        let pixels = features.pixels.iter_mut().enumerate();
        pixels
            .filter(|(index, _)| *index as u32 % SIDE >= middle)
            .for_each(|(_, pixel)| change(pixel));
        let found = denoised(&(image.clone(), features));
        assert!(error(&found) < 0.01, "{name}: {}", error(&found));
    }
}

/// A pattern that is known without noise stays. One that has much noise becomes the mean of 3x3 pixels with the weights 1, 2
/// and 4 of a tent. Something between is kept from what differs by far more than its noise.
#[test]
fn albedos_are_smoothed_as_far_as_they_are_noisy() {
    let level = |x: u32, y: u32| 0.3 + 0.01 * ((7 * x + 13 * y) % 11) as f32;
    let stripe = |x: u32| if (x / 4).is_multiple_of(2) { 0.0 } else { 0.5 };
    let given = |albedo: &dyn Fn(u32, u32) -> f32, noise: f32| {
        let (_, mut features) = picture(|_, _| [1.0; 3], 1e-4);
        for (index, pixel) in features.pixels.iter_mut().enumerate() {
            let own = albedo(index as u32 % SIDE, index as u32 / SIDE);
            pixel.albedo = [own; 3];
            // Even light.
            pixel.radiance = [2.0 * own; 3];
            pixel.albedo_variance = noise;
        }
        (features.picture(), features)
    };
    let tent = |x: u32, y: u32| {
        let around = (0..9).map(|k| (k % 3, k / 3));
        let weighted = around.map(|(i, j)| {
            let near = |k: u32| if k == 1 { 2.0 } else { 1.0 };
            near(i) * near(j) * level(x + i - 1, y + j - 1)
        });
        weighted.sum::<f32>() / 16.0
    };
    type Check<'a> = (&'a str, (Image, Features), &'a dyn Fn(u32, u32) -> f32, f32);
    let striped = |x: u32, y: u32| level(x, y) + stripe(x);
    // A dark pattern of little contrast, whose means of 3x3 pixels are as good as equal.
    let faint = |x: u32, y: u32| 0.03 + 0.001 * ((x + y) % 2) as f32;
    let checks: [Check; 4] = [
        ("without noise", given(&level, 0.0), &level, 1e-5),
        ("faint, without noise", given(&faint, 0.0), &faint, 1e-6),
        ("with much noise", given(&level, 1e4), &tent, 1e-5),
        // The standard deviation is 0.01: within stripes that are 4 pixels wide, and as far from their edges as
        // means of 3x3 pixels see, half of the pattern is left at most; between them, nothing is lost.
        (
            "with stripes",
            given(&striped, 1e-4),
            &|x, _| 0.35 + stripe(x),
            0.051,
        ),
    ];
    for (name, given, expected, tolerance) in checks {
        let found = denoised(&given);
        for (x, y) in (1..SIDE - 1).flat_map(|y| (1..SIDE - 1).map(move |x| (x, y))) {
            let value = found.pixel(x, y).expect("inside")[1];
            let wanted = 2.0 * expected(x, y);
            assert!(
                (value - wanted).abs() <= 2.0 * tolerance,
                "{name}, {x},{y}: {value}, not {wanted}"
            );
        }
    }
}

#[test]
fn pixels_that_are_not_finite_do_not_spread() {
    let (mut image, features) = picture(|_, _| [0.25; 3], 1e-3);
    let holes = [(0, 0), (40, 40), (41, 40), (SIDE - 1, 7)];
    for ((x, y), value) in
        holes
            .into_iter()
            .zip([f32::NAN, f32::INFINITY, -f32::INFINITY, f32::NAN])
    {
        image.pixels[(y * SIDE + x) as usize][1] = value;
    }
    let found = denoised(&(image, features));
    for pixel in &found.pixels {
        assert!((pixel[1] - 0.25).abs() < 1e-5, "{pixel:?}");
    }
}

#[test]
fn opacity_is_kept() {
    let (mut image, features) = picture(|x, _| [x as f32 / 100.0; 3], 1e-2);
    for (index, pixel) in image.pixels.iter_mut().enumerate() {
        pixel[3] = (index % 11) as f32 / 10.0;
    }
    let found = denoised(&(image.clone(), features));
    let same = found.pixels.iter().zip(&image.pixels);
    assert!(same.clone().all(|(a, b)| a[3] == b[3]));
}

/// The peak signal-to-noise ratio of display values, in decibels.
fn psnr(image: &Image, reference: &Image) -> f64 {
    let shown = |value: f32| f64::from(value.clamp(0.0, 1.0)).powf(1.0 / 2.2);
    let pairs = image.pixels.iter().zip(&reference.pixels);
    let error: f64 = pairs
        .map(|(a, b)| {
            (0..3)
                .map(|c| (shown(a[c]) - shown(b[c])).powi(2))
                .sum::<f64>()
        })
        .sum();
    -10.0 * (error / (3 * image.pixels.len()) as f64).log10()
}

#[test]
fn a_cornell_box_of_1_and_of_16_samples_gains_almost_6_decibels() {
    let scene = import::load(Path::new("assets/scenes/cornell_box.toml")).expect("a scene");
    let rendered = |samples, seed| {
        let settings = RenderSettings {
            size: (64, 64),
            samples,
            seed,
            antialias: Antialias::Stratified,
            integrator: Integrator::Path,
            max_depth: 16,
            features: true,
            ..RenderSettings::default()
        };
        let mut renderer = start(&scene, &settings).expect("a renderer");
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        renderer
            .film()
            .expect("a film")
            .features()
            .expect("features")
    };
    let reference = rendered(512, 1).picture();
    // The variance of a single sample is not known.
    let mut verdict = Verdict::on("numbers of samples");
    for (samples, gain) in [(1, 5.8), (16, 5.8)] {
        let features = rendered(samples, 0);
        let noisy = features.picture();
        let found = denoised(&(noisy.clone(), features));
        let (before, after) = (psnr(&noisy, &reference), psnr(&found, &reference));
        verdict.that(format!("{samples}"), after >= before + gain, || {
            format!("{before:.2} dB, then {after:.2} dB")
        });
    }
    verdict.close();
}

/// The window develops its renderer, and files are made from films.
#[test]
fn renderers_and_films_denoise_to_the_same_bits() {
    let scene = import::load(Path::new("assets/scenes/still_life.toml")).expect("a scene");
    for antialias in [Antialias::Stratified, Antialias::Adaptive] {
        let settings = RenderSettings {
            size: (40, 30),
            samples: 70,
            antialias,
            integrator: Integrator::Path,
            features: true,
            ..RenderSettings::default()
        };
        let tone = Tone {
            denoise: true,
            transfer: Transfer::Srgb,
            ..Tone::LINEAR
        };
        let mut renderer = start(&scene, &settings).expect("a renderer");
        renderer.step().expect("a step");
        let early = renderer.develop(&tone).expect("a picture");
        assert!(early.pixels.iter().flatten().all(|value| value.is_finite()));
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        let shown = renderer.develop(&tone).expect("a picture");
        let film = renderer.film().expect("a film");
        let features = film.features().expect("features");
        let image = denoise(&features.picture(), renderer.gpu(), &features);
        let image = image.expect("a denoised picture").image;
        let saved = tone.develop(renderer.gpu(), &image).expect("a picture");
        assert_eq!(shown, saved);
        let raw = film.develop(renderer.gpu(), &tone).expect("a picture");
        assert_ne!(shown, raw, "films develop their noise");
    }
}

/// The screen of a renderer is denoised from the film on the device, files from means in f64 on the host. Pixels without a
/// sample are transparent on a screen.
fn check_screen(renderer: &mut Renderer, what: &str) {
    let tone = Tone {
        denoise: true,
        transfer: Transfer::Srgb,
        ..Tone::LINEAR
    };
    let raw = Tone {
        denoise: false,
        ..tone
    };
    let screen = renderer.new_screen().expect("a screen");
    let mut apart = |tone: &Tone| {
        renderer.show(tone, &screen).expect("a picture");
        let shown = screen.read(renderer.gpu()).expect("its pixels");
        let file = ScreenImage::from(&renderer.develop(tone).expect("a picture"));
        let pairs = shown.pixels.into_iter().zip(file.pixels);
        let seen = pairs.filter(|(shown, _)| shown[3] > 0 || renderer.is_done());
        let levels = |(shown, file): ([u8; 4], [u8; 4])| {
            let levels = shown.into_iter().zip(file).map(|(a, b)| a.abs_diff(b));
            levels.max().unwrap_or_default()
        };
        seen.map(levels).collect::<Vec<_>>()
    };
    let denoised = apart(&tone);
    let others = denoised.iter().filter(|levels| **levels > 0).count();
    assert!(
        denoised.iter().all(|levels| *levels <= 1),
        "{what}: {denoised:?}"
    );
    assert!(
        50 * others <= denoised.len(),
        "{what}: {others} pixels differ"
    );
    assert!(apart(&raw).iter().all(|levels| *levels == 0), "{what}, raw");
    let image = renderer.develop(&tone).expect("a picture");
    assert_ne!(image, renderer.develop(&raw).expect("a picture"), "{what}");
}

#[test]
fn a_screen_shows_what_files_get() {
    let scene = import::load(Path::new("assets/scenes/still_life.toml")).expect("a scene");
    let packed = Arc::new(pack::scene(&scene).expect("a packed scene"));
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    let settings = |size, crop, samples, filter| RenderSettings {
        size,
        crop,
        samples,
        antialias: Antialias::Stratified,
        filter,
        integrator: Integrator::Path,
        features: true,
        ..RenderSettings::default()
    };
    // One renderer for all. The second filter has negative lobes; more than 64 samples pass through the host.
    let all = [
        settings((50, 30), None, 1, Filter::Box),
        settings((50, 30), Some([3, 2, 48, 29]), 7, Filter::Mitchell),
        settings((30, 20), None, 64, Filter::Tent),
        settings((30, 20), None, 70, Filter::Box),
    ];
    for (fetch, rows) in [(Fetch::Image, &all[..]), (Fetch::Buffer, &all[1..2])] {
        let policy = ExecutionPolicy {
            fetch,
            ..ExecutionPolicy::default()
        };
        let first = rows[0].clone();
        let renderer = Renderer::new(open_gpu(), packed.clone(), &view, first, policy);
        let mut renderer = renderer.expect("a renderer");
        for row in rows {
            renderer
                .restart(packed.clone(), &view, row.clone(), policy)
                .expect("a restart");
            renderer.step().expect("a step");
            check_screen(&mut renderer, &format!("{fetch:?}, {} begun", row.samples));
            while !renderer.is_done() {
                renderer.step().expect("a step");
            }
            check_screen(
                &mut renderer,
                &format!("{fetch:?}, {} samples", row.samples),
            );
        }
    }
}
