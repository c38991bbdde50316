//! The program renders by the library that other tests render by, with the same kernels on the same kind of device.

use crate::explain::{finish, renderer};
use crate::reference::compare::{assert_none, check_same_bits, open_gpu};
use crate::support::program::Workspace;
use glimray::gpu::AdapterChoice;
use glimray::import::Folder;
use glimray::render::{Antialias, ExecutionPolicy, Film, Integrator, RenderSettings, Tone};
use glimray::{PictureOptions, import, output, render_file, render_from};
use std::path::Path;

/// A switch of the device or its kernels that the program sets and tests do not would have to be here.
#[test]
fn a_device_has_no_switch_but_its_adapter() {
    let AdapterChoice {
        backend: None,
        adapter: None,
    } = AdapterChoice::default()
    else {
        panic!("programs choose no adapter unless told");
    };
}

/// Scenes whose pictures change where lanes disturb each other. The program takes vectors of 512 bits where it can.
#[test]
fn pictures_of_the_program_are_those_of_the_library() {
    let workspace = Workspace::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let rows = [
        ("carousel.toml", Integrator::Path),
        ("night_light.toml", Integrator::Path),
        ("neon.toml", Integrator::Path),
        ("everything.toml", Integrator::Path),
        ("everything.toml", Integrator::Whitted),
        ("patterns.toml", Integrator::Whitted),
        ("solids.toml", Integrator::Normals),
    ];
    assert_none(rows.map(|(name, integrator)| {
        let path = folder.join(name);
        let scene = import::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let settings = RenderSettings {
            size: (48, 36),
            samples: 4,
            antialias: Antialias::Stratified,
            max_depth: 5,
            integrator,
            ..RenderSettings::from(&scene.output)
        };
        let mut renderer = renderer(&scene, &(settings, ExecutionPolicy::default()));
        finish(&mut renderer);
        let expected = renderer.develop(&Tone::LINEAR).expect("a picture");
        let run = workspace.run(&format!(
            "render {} --size 48x36 --samples 4 --antialias stratified --max-depth 5 --integrator {} \
             --quiet -o a.film",
            path.display(),
            integrator.entry().name,
        ));
        run.expect(0);
        let film = Film::read(&workspace.read("a.film")[..]).expect("a film");
        let actual = film.develop(&open_gpu(), &Tone::LINEAR).expect("a picture");
        check_same_bits(&format!("{name}, {integrator:?}"), &expected, &actual)
    }));
}

#[test]
fn one_call_gives_the_picture_of_the_program() {
    let workspace = Workspace::new();
    workspace.write("model.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let given = |size, samples, time| PictureOptions {
        size,
        samples,
        time,
        ..PictureOptions::default()
    };
    let rows = [
        (workspace.path("a.scene"), given(None, None, 0.0), ""),
        (
            folder.join("../../crates/app/src/showcase.toml"),
            given(Some((48, 36)), Some(4), 0.0),
            "--size 48x36 --samples 4",
        ),
        (
            folder.join("carousel.toml"),
            given(Some((48, 27)), Some(2), 0.5),
            "--size 48x27 --samples 2 --time 0.5",
        ),
        // Traced by paths, and denoised.
        (
            workspace.path("model.obj"),
            given(Some((48, 36)), None, 0.0),
            "--size 48x36",
        ),
    ];
    for (path, options, flags) in rows {
        let picture = render_file(&path, &options).unwrap_or_else(|error| panic!("{error}"));
        // Without waiting, from a folder of the caller's.
        let folder = Folder::of(&path).expect("a folder");
        let name = path.file_name().expect("a name").to_string_lossy();
        let awaited = pollster::block_on(render_from(&folder, &name, &options));
        let awaited = awaited.unwrap_or_else(|error| panic!("{error}"));
        check_same_bits(&name, &picture, &awaited).expect("the same picture");
        output::save(workspace.path("library.png"), &picture).expect("written");
        let line = format!("render {} {flags} --quiet -o program.png", path.display());
        workspace.run(&line).expect(0);
        let is_same = workspace.read("library.png") == workspace.read("program.png");
        assert!(is_same, "{}", path.display());
    }
}

#[test]
fn options_out_of_range_are_refused_in_one_line() {
    let sized = |size| PictureOptions {
        size: Some(size),
        ..PictureOptions::default()
    };
    let sampled = PictureOptions {
        samples: Some(0),
        ..PictureOptions::default()
    };
    let timed = PictureOptions {
        time: f64::NAN,
        ..PictureOptions::default()
    };
    for (options, expected) in [
        (sized((0, 9)), "bad option (size): (0, 9) is not two sides"),
        (sized((9, 1_000_001)), "bad option (size): (9, 1000001)"),
        (sampled, "bad option (samples): 0 is not at least 1."),
        (timed, "bad option (time): NaN is not finite."),
    ] {
        let error = render_file("assets/scenes/sphere.scene", &options).expect_err(expected);
        let error = error.to_string();
        assert!(
            error.starts_with(expected) && !error.contains('\n'),
            "{error}"
        );
    }
}

/// Executors of several threads move futures between them.
#[test]
fn futures_of_pictures_can_be_sent_to_other_threads() {
    fn is_sent<T: Send>(_: &T) {}
    let folder = Folder::of(Path::new("assets/scenes/sphere.scene")).expect("a folder");
    let options = PictureOptions::default();
    is_sent(&render_from(&folder, "sphere.scene", &options));
}
