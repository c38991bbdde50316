//! The program renders by the library that other tests render by, with the same kernels on the same kind of device.

use crate::explain::{finish, renderer};
use crate::reference::compare::{assert_none, check_same_bits, open_gpu};
use crate::support::program::Workspace;
use glimray::gpu::AdapterChoice;
use glimray::import;
use glimray::render::{Antialias, ExecutionPolicy, Film, Integrator, RenderSettings, Tone};
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
