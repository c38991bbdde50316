//! Checkpoints as values: a render that is interrupted anywhere and goes on in another renderer has the bytes of an
//! undisturbed one; files that do not fit are refused by name.

use crate::film::{bytes, stratified};
use crate::reference::compare::{Wanted, sized, sliced, start};
use crate::reference::scenes;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glimray::image::Image;
use glimray::render::{
    Antialias, CheckpointError, ExecutionPolicy, Integrator, RenderSettings, Renderer, Slicing,
    Stats, Tone,
};
use glimray::scene::{Filter, Scene};

/// Many small submissions.
const FINE: Slicing = Slicing {
    target_seconds: 0.1,
    max_groups: 5,
    max_samples: 7,
    tile_side: 2048,
    even_passes: false,
};

type Case = (&'static str, RenderSettings, ExecutionPolicy);

fn case(name: &'static str, settings: RenderSettings, slicing: Slicing) -> Case {
    let (settings, policy) = sliced(&settings, slicing);
    (name, settings, policy)
}

fn cases() -> Vec<Case> {
    let path = |settings| RenderSettings {
        integrator: Integrator::Path,
        max_depth: 4,
        ..settings
    };
    let adaptive = |samples, size| RenderSettings {
        antialias: Antialias::Adaptive,
        noise: 0.002,
        ..stratified(samples, size)
    };
    let tiles = Slicing {
        tile_side: 16,
        ..FINE
    };
    let part = RenderSettings {
        crop: Some([3, 5, 29, 30]),
        sample_range: Some(64..192),
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..stratified(260, (40, 33))
    };
    let with_features = |settings| RenderSettings {
        features: true,
        ..settings
    };
    let (device_only, mut lazy) = sliced(&stratified(150, (33, 21)), FINE);
    lazy.host_copy = false;
    vec![
        case("classical", stratified(150, (33, 21)), FINE),
        case("paths", path(stratified(40, (37, 29))), FINE),
        case("a range and a region", part, FINE),
        case("many film tiles", stratified(70, (40, 35)), tiles),
        case("layers", with_features(stratified(70, (24, 17))), tiles),
        case("adaptive", adaptive(64, (40, 30)), FINE),
        case("adaptive, many tiles", path(adaptive(300, (30, 20))), tiles),
        case(
            "adaptive with layers",
            with_features(adaptive(32, (30, 20))),
            tiles,
        ),
        ("without host copies", device_only, lazy),
    ]
}

fn checkpoint(renderer: &mut Renderer) -> Vec<u8> {
    let mut written = Vec::new();
    let checkpoint = renderer.checkpoint().expect("a checkpoint");
    checkpoint.write(&mut written).expect("written");
    written
}

fn finished(mut renderer: Renderer) -> (Vec<u8>, Image, Stats) {
    let film = bytes(&renderer.film().expect("a film"));
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    (film, image, renderer.stats().clone())
}

/// The counts of a picture, whichever runs took part.
fn counts(stats: &Stats) -> String {
    let Stats {
        nonfinite_samples,
        cut_off_trees,
        samples,
        rays,
        ..
    } = stats;
    // The order of the submissions rounds this differently.
    let cut = (stats.energy_cut() * 1e9).round();
    format!("{nonfinite_samples} {cut_off_trees} {samples} {rays:?} {cut}")
}

fn advance(renderer: &mut Renderer, steps: usize) -> usize {
    let mut taken = 0;
    while taken < steps && !renderer.is_done() {
        renderer.step().expect("a step");
        taken += 1;
    }
    taken
}

#[test]
fn a_render_interrupted_anywhere_ends_with_the_bytes_of_an_undisturbed_one() {
    let scene = scenes::everything();
    let mut random = Random::new(3);
    let mut verdict = Verdict::on("interrupted renders");
    for (name, settings, policy) in cases() {
        let begin = || start(&scene, &(settings.clone(), policy)).expect("a renderer");
        let mut undisturbed = begin();
        let steps = advance(&mut undisturbed, usize::MAX);
        let expected = finished(undisturbed);
        for _ in 0..2 {
            let mut renderer = begin();
            let mut interruptions = Vec::new();
            while !renderer.is_done() {
                advance(&mut renderer, random.below(steps.div_ceil(2) + 1));
                let written = checkpoint(&mut renderer);
                let progress = renderer.progress();
                renderer = begin();
                renderer.resume(&written[..]).expect("the same work");
                assert!(renderer.progress() == progress, "{name}");
                assert!(
                    checkpoint(&mut renderer) == written,
                    "{name}: written again"
                );
                interruptions.push(progress);
            }
            let (film, image, stats) = finished(renderer);
            let what = || format!("interrupted at {interruptions:?} of {steps} steps");
            verdict.that(format!("{name}: film"), film == expected.0, what);
            verdict.that(format!("{name}: picture"), image == expected.1, what);
            let (found, wanted) = (counts(&stats), counts(&expected.2));
            let differ = || format!("{found}, not {wanted}");
            verdict.that(format!("{name}: counts"), found == wanted, differ);
        }
    }
    verdict.close();
}

/// A small picture, some steps in, and its checkpoint.
fn small(settings: &RenderSettings) -> (Scene, Renderer, Vec<u8>) {
    let scene = scenes::spheres();
    let mut renderer = start(&scene, &sliced(settings, FINE)).expect("a renderer");
    while renderer.progress() < 0.5 {
        renderer.step().expect("a step");
    }
    let written = checkpoint(&mut renderer);
    (scene, renderer, written)
}

#[test]
fn a_checkpoint_that_is_cut_short_or_damaged_is_refused_and_changes_nothing() {
    let adaptive = RenderSettings {
        antialias: Antialias::Adaptive,
        features: true,
        noise: 1e-4,
        ..stratified(64, (12, 9))
    };
    let mut random = Random::new(5);
    for settings in [stratified(150, (13, 9)), adaptive] {
        let (_, mut renderer, written) = small(&settings);
        let lengths = (0..100).map(|percent| written.len() * percent / 100);
        for length in lengths
            .chain(written.len() - 20..written.len())
            .chain(0..200)
        {
            let error = renderer.resume(&written[..length]).expect_err("too short");
            match (length, &error) {
                (..8, CheckpointError::NotACheckpoint)
                | (8.., CheckpointError::CutShort { .. }) => {}
                _ => panic!("{length}: {error}"),
            }
        }
        let longer = [&written[..], b"more"].concat();
        let error = renderer.resume(&longer[..]).expect_err("too long");
        assert!(matches!(error, CheckpointError::Damaged { .. }), "{error}");
        let anywhere = (0..1000).map(|_| random.below(written.len()));
        for place in (0..500).chain(anywhere) {
            let mut changed = written.clone();
            changed[place] ^= 1 << (place % 8);
            assert!(renderer.resume(&changed[..]).is_err(), "byte {place}");
        }
        for place in (12..500).step_by(2) {
            let mut changed = written.clone();
            changed[place..place + 4].copy_from_slice(&u32::MAX.to_le_bytes());
            assert!(renderer.resume(&changed[..]).is_err(), "byte {place}");
        }
        assert!(checkpoint(&mut renderer) == written);
        let noise: Vec<u8> = (0..200_u8).collect();
        let error = renderer.resume(&noise[..]).expect_err("noise");
        assert!(matches!(error, CheckpointError::NotACheckpoint), "{error}");
        let mut other = written.clone();
        other[8] = 77;
        let error = renderer.resume(&other[..]).expect_err("a version");
        assert!(error.to_string().contains("version 77"), "{error}");
    }
}

/// Changes that the hash does not show, as no accident makes them.
#[test]
fn whatever_a_checkpoint_says_the_render_ends_without_a_panic() {
    let adaptive = RenderSettings {
        antialias: Antialias::Adaptive,
        features: true,
        noise: 1e-4,
        ..stratified(64, (12, 9))
    };
    let mut random = Random::new(9);
    for settings in [stratified(150, (13, 9)), adaptive] {
        let (_, mut renderer, written) = small(&settings);
        let mut accepted = 0;
        for round in 0..600 {
            let mut changed = written.clone();
            let end = changed.len() - 16;
            // Most of the file are sums; the position is in front of them, behind the statistics.
            let place = match round % 3 {
                0 => random.below(end),
                1 => 150 + random.below(250),
                _ => end - 1 - random.below(end.min(9000)),
            };
            match round % 2 {
                0 => changed[place] = random.bits() as u8,
                _ => changed[place] ^= 1,
            }
            let digest = xxhash_rust::xxh3::xxh3_128(&changed[..end]);
            changed[end..].copy_from_slice(&digest.to_le_bytes());
            if renderer.resume(&changed[..]).is_ok() {
                accepted += 1;
                if accepted % 20 == 0 {
                    advance(&mut renderer, 1000);
                    renderer.develop(&Tone::LINEAR).expect("a picture");
                }
            }
        }
        assert!(accepted > 100, "{accepted}");
    }
}

#[test]
fn the_checkpoint_of_other_work_is_refused_by_what_differs() {
    let settings = stratified(150, (13, 9));
    let (scene, _, written) = small(&settings);
    let mut verdict = Verdict::on("other work");
    let mut check = |scene: &Scene,
                     wanted: &dyn Fn() -> (RenderSettings, ExecutionPolicy),
                     written: &[u8],
                     what: &str| {
        let mut renderer = start(scene, &wanted()).expect("a renderer");
        let error = renderer.resume(written).expect_err(what).to_string();
        let words = format!("of other work: it differs in the {what}.");
        verdict.that(what, error.contains(&words), || error.clone());
        assert!(renderer.progress() == 0.0);
    };
    let same = || sliced(&settings, FINE);
    let mut other = scene.clone();
    other.ambient *= 0.5;
    other
        .materials
        .iter_mut()
        .for_each(|material| *material = scenes::shiny(glam::Vec3::ONE));
    check(&other, &same, &written, "scene, view");
    let mut other = scene.clone();
    other.ambient *= 0.5;
    check(&other, &same, &written, "view");
    let with = |change: fn(&mut RenderSettings)| {
        let mut settings = settings.clone();
        change(&mut settings);
        move || sliced(&settings, FINE)
    };
    check(&scene, &with(|s| s.seed = 1), &written, "settings");
    check(&scene, &with(|s| s.features = true), &written, "settings");
    check(
        &scene,
        &with(|s| s.crop = Some([0, 0, 5, 5])),
        &written,
        "region",
    );
    check(
        &scene,
        &with(|s| s.sample_range = Some(64..128)),
        &written,
        "range of samples",
    );
    let tiles = || {
        let slicing = Slicing {
            tile_side: 8,
            ..FINE
        };
        sliced(&settings, slicing)
    };
    check(&scene, &tiles, &written, "size of film tiles");
    // The text of the version begins after the signature, the version of the format and its own length.
    let mut other = written.clone();
    other[16] = b'9';
    check(&scene, &same, &other, "version of the program");
    let mut other = written.clone();
    let adapter = 16 + env!("CARGO_PKG_VERSION").len() + 4;
    other[adapter] ^= 1;
    check(&scene, &same, &other, "adapter");
    verdict.close();
}

#[test]
fn counts_in_a_checkpoint_are_those_of_runs_that_both_count_rays() {
    let settings = sized(16, 16);
    let scene = scenes::spheres();
    let (_, counting) = sliced(&settings, FINE);
    let silent = ExecutionPolicy {
        count_rays: false,
        ..counting
    };
    for (first, second, is_counted) in [
        (counting, counting, true),
        (counting, silent, false),
        (silent, counting, false),
    ] {
        let parts = |policy| (settings.clone(), policy).parts();
        let mut renderer = start(&scene, &parts(first)).expect("a renderer");
        renderer.step().expect("a step");
        let written = checkpoint(&mut renderer);
        let mut renderer = start(&scene, &parts(second)).expect("a renderer");
        renderer.resume(&written[..]).expect("the same work");
        advance(&mut renderer, usize::MAX);
        assert_eq!(renderer.stats().rays.is_some(), is_counted);
    }
}
