//! Stable fingerprints of settings, scenes and views.

use crate::reference::scenes;
use glam::dvec3;
use glimray::pack;
use glimray::render::{
    BsdfModel, Fingerprint, INTEGRATORS, Integrator, Levels, RayOffset, RenderSettings, Tone,
    TriangleTest,
};
use glimray::scene::{Antialias, Filter, Scene, ToneCurve, Transfer};
use std::collections::{HashMap, HashSet};

/// Films and journals of other builds contain it: when the encoding changes, increase the version and update
/// the value here.
#[test]
fn the_fingerprint_of_settings_is_the_same_in_every_build() {
    let fingerprint = RenderSettings::default().fingerprint().to_string();
    assert_eq!(fingerprint, "c36549e8cb27c4e029775c6f8d7ba8ae");
}

#[test]
fn every_setting_changes_the_fingerprint() {
    type Change = fn(&mut RenderSettings);
    let changes: Vec<(&str, Change)> = vec![
        ("nothing", |_| {}),
        ("width", |s| s.size.0 += 1),
        ("height", |s| s.size.1 += 1),
        ("crop", |s| s.crop = Some([0, 0, 0, 0])),
        ("another crop", |s| s.crop = Some([0, 0, 0, 1])),
        ("samples", |s| s.samples += 1),
        ("range", |s| s.sample_range = Some(0..0)),
        ("another range", |s| s.sample_range = Some(0..1)),
        ("stratified", |s| s.antialias = Antialias::Stratified),
        ("adaptive", |s| s.antialias = Antialias::Adaptive),
        ("noise", |s| s.noise = 0.02),
        ("tent", |s| s.filter = Filter::Tent),
        ("gaussian", |s| s.filter = Filter::Gaussian),
        ("blackman", |s| s.filter = Filter::BlackmanHarris),
        ("mitchell", |s| s.filter = Filter::Mitchell),
        ("radius", |s| s.filter_radius = 0.75),
        ("light samples", |s| s.light_samples = 2.0),
        ("normals", |s| s.integrator = Integrator::Normals),
        ("depth", |s| s.integrator = Integrator::Depth),
        ("ids", |s| s.integrator = Integrator::Ids),
        ("uv", |s| s.integrator = Integrator::Uv),
        ("heat", |s| s.integrator = Integrator::Heat),
        ("counts", |s| s.integrator = Integrator::Samples),
        ("plane", |s| s.triangle_test = TriangleTest::Plane),
        ("moller", |s| s.triangle_test = TriangleTest::MollerTrumbore),
        ("offset", |s| s.offset = RayOffset::Fixed(1e-4)),
        ("another offset", |s| s.offset = RayOffset::Fixed(2e-4)),
        ("brute force", |s| s.brute_force = true),
        ("seed", |s| s.seed = 1),
        ("depth of rays", |s| s.max_depth += 1),
        ("throughput", |s| s.min_throughput = 0.25),
        ("paths", |s| s.integrator = Integrator::Path),
        ("transparent shadows", |s| s.transparent_shadows = true),
        ("the specification", |s| s.bsdf = BsdfModel::Spec),
        ("clamp", |s| s.clamp_indirect = Some(1.0)),
        ("another clamp", |s| s.clamp_indirect = Some(2.0)),
        ("features", |s| s.features = true),
    ];
    let mut known: HashMap<Fingerprint, &str> = HashMap::new();
    for (name, change) in changes {
        let mut settings = RenderSettings::default();
        change(&mut settings);
        let same = known.insert(settings.fingerprint(), name);
        assert_eq!(same, None, "{name}");
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
    other.materials[0].diffuse *= 0.5;
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
