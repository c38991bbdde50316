//! Stable fingerprints of settings, scenes and views.

use crate::reference::scenes;
use crate::support::settings::texts;
use glam::{dvec3, vec3};
use glimray::pack;
use glimray::render::{Fingerprint, INTEGRATORS, Integrator, Levels, RenderSettings, Tone};
use glimray::scene::{Backdrop, Scene, ToneCurve, Transfer};
use glimray_app::settings::SETTINGS;
use std::collections::{HashMap, HashSet};

/// Films and journals of other builds contain it: when the encoding changes, increase the version and update
/// the value here.
#[test]
fn the_fingerprint_of_settings_is_the_same_in_every_build() {
    let fingerprint = RenderSettings::default().fingerprint().to_string();
    assert_eq!(fingerprint, "c36549e8cb27c4e029775c6f8d7ba8ae");
}

#[test]
fn every_setting_has_a_flag_or_follows_from_others() {
    let of_others = ["sample_range", "features", "backdrop"];
    let with_flag = SETTINGS.iter().map(|setting| setting.name);
    let known: HashSet<_> = with_flag.chain(of_others).collect();
    assert_eq!(known, HashSet::from_iter(RenderSettings::NAMES.to_vec()));
}

#[test]
fn every_setting_changes_the_fingerprint() {
    let without_flag: [fn(&mut RenderSettings); 5] = [
        |settings| settings.sample_range = Some(0..0),
        |settings| settings.sample_range = Some(0..1),
        |settings| settings.features = true,
        |settings| settings.backdrop = Backdrop::Color(vec3(0.0, 0.0, 0.0)),
        |settings| settings.backdrop = Backdrop::Transparent,
    ];
    let usual = RenderSettings::default();
    let mut changed = vec![usual.clone()];
    for change in without_flag {
        let mut settings = usual.clone();
        change(&mut settings);
        changed.push(settings);
    }
    for setting in SETTINGS {
        for text in texts(setting) {
            let mut settings = usual.clone();
            (setting.set(&mut settings, &text)).expect("a value");
            if settings != usual {
                changed.push(settings);
            }
        }
    }
    let mut known: HashMap<Fingerprint, RenderSettings> = HashMap::new();
    for settings in changed {
        let same = known.insert(settings.fingerprint(), settings.clone());
        assert_eq!(same, None, "{settings:?}");
    }
}

#[test]
fn every_part_of_a_tone_changes_its_fingerprint() {
    let changes: Vec<fn(&mut Tone)> = vec![
        |_| {},
        |tone| tone.exposure_ev = 1.0,
        |tone| tone.auto_exposure = true,
        |tone| tone.curve = ToneCurve::Aces,
        |tone| tone.curve = ToneCurve::Agx,
        |tone| tone.curve = ToneCurve::Reinhard,
        |tone| tone.curve = ToneCurve::Neutral,
        |tone| tone.transfer = Transfer::Srgb,
        |tone| tone.levels = Levels::Found,
        |tone| tone.levels = Levels::Fixed([0.0, 0.0]),
        |tone| tone.levels = Levels::Fixed([0.0, 1.0]),
        |tone| tone.denoise = true,
    ];
    let fingerprint = |change: &fn(&mut Tone)| {
        let mut tone = Tone::LINEAR;
        change(&mut tone);
        tone.fingerprint()
    };
    let all: HashSet<_> = changes.iter().map(fingerprint).collect();
    assert_eq!(all.len(), changes.len());
}

#[test]
fn scenes_and_views_differ_in_their_own_fingerprints() {
    let of = |scene: &Scene| {
        let packed = pack::scene(scene).expect("packed");
        let view = packed.frame(&scene.frame(0.0)).expect("a view");
        (Fingerprint::of_scene(&packed), Fingerprint::of_view(&view))
    };
    let scene = scenes::everything();
    let (own, view) = of(&scene);
    assert_eq!((own, view), of(&scene), "twice the same");
    let mut turned = scene.clone();
    turned.cameras[0].up = dvec3(0.1, 1.0, 0.0);
    assert_eq!(of(&turned).0, own);
    assert_ne!(of(&turned).1, view);
    let mut other = scene.clone();
    other.materials[0].classical_mut().diffuse *= 0.5;
    assert_ne!(of(&other).0, own);
}

#[test]
fn integrators_stand_in_the_table_in_order_each_with_a_name() {
    for (index, entry) in INTEGRATORS.iter().enumerate() {
        assert_eq!(entry.integrator as usize, index);
        assert_eq!(entry.integrator.entry().name, entry.name);
        assert_eq!(Integrator::named(entry.name), Some(entry.integrator));
    }
    assert_eq!(Integrator::named("nothing"), None);
}
