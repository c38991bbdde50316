//! Films as values: parts of a picture, split anywhere and merged in any order, give the whole picture.

use crate::reference::compare::{
    Wanted, assert_none, check_same_bits, open_gpu, render, sized, sliced, start,
};
use crate::reference::scenes;
use crate::support::random::Random;
use glimray::image::Image;
use glimray::render::{
    Antialias, Film, FilmError, Integrator, Levels, RenderError, RenderSettings, Renderer,
    SAMPLE_BLOCK, Slicing, Tone,
};
use glimray::scene::{Background, Filter, Scene};

/// A finished renderer.
pub fn traced(scene: &Scene, wanted: &impl Wanted) -> Renderer {
    let mut renderer = start(scene, wanted).expect("a renderer");
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    renderer
}

pub fn film(scene: &Scene, wanted: &impl Wanted) -> Film {
    traced(scene, wanted).film().expect("a film")
}

pub fn bytes(film: &Film) -> Vec<u8> {
    let mut bytes = Vec::new();
    film.write(&mut bytes).expect("written");
    bytes
}

fn developed(film: &Film) -> Image {
    film.develop(&open_gpu(), &Tone::LINEAR).expect("a picture")
}

pub fn stratified(samples: u32, (width, height): (u32, u32)) -> RenderSettings {
    RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(width, height)
    }
}

/// The settings of parts of a picture, split horizontally, vertically or between sample blocks, at random
/// positions.
pub fn cut(whole: &RenderSettings, count: usize, random: &mut Random) -> Vec<RenderSettings> {
    let [x, y, width, height] = whole.region();
    let mut below = |limit: u32| random.below(limit as usize) as u32;
    let mut parts = vec![([x, y, x + width, y + height], whole.samples_to_render())];
    while parts.len() < count {
        let index = below(parts.len() as u32) as usize;
        let (crop, samples) = parts[index].clone();
        let (mut first, mut second) = ((crop, samples.clone()), (crop, samples.clone()));
        match below(3) {
            2 if samples.len() as u32 > SAMPLE_BLOCK => {
                let blocks = (samples.len() as u32 - 1) / SAMPLE_BLOCK;
                let middle = samples.start + SAMPLE_BLOCK * (1 + below(blocks));
                (first.1.end, second.1.start) = (middle, middle);
            }
            axis @ (0 | 1) if crop[axis as usize + 2] - crop[axis as usize] > 1 => {
                let axis = axis as usize;
                let middle = crop[axis] + 1 + below(crop[axis + 2] - crop[axis] - 1);
                (first.0[axis + 2], second.0[axis]) = (middle, middle);
            }
            _ => continue,
        }
        parts[index] = first;
        parts.push(second);
    }
    let settings = |(crop, samples)| RenderSettings {
        crop: Some(crop),
        sample_range: Some(samples),
        ..whole.clone()
    };
    parts.into_iter().map(settings).collect()
}

/// Merges them pairwise in a random order.
pub fn merged(mut films: Vec<Film>, random: &mut Random) -> Film {
    while films.len() > 1 {
        let mut any = |films: &mut Vec<Film>| films.swap_remove(random.below(films.len()));
        let (first, second) = (any(&mut films), any(&mut films));
        films.push(first.merge(&second).expect("films of one picture"));
    }
    films.remove(0)
}

#[test]
fn parts_cut_anywhere_and_merged_in_any_order_have_the_bytes_of_one_run() {
    let mut random = Random::new(11);
    let mut outcomes = Vec::new();
    let mitchell = RenderSettings {
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..stratified(200, (37, 29))
    };
    for (name, whole) in [("few", stratified(9, (23, 17))), ("many", mitchell)] {
        let scene = scenes::everything();
        let mut renderer = traced(&scene, &whole);
        let image = renderer.develop(&Tone::LINEAR).expect("a picture");
        let expected = renderer.film().expect("a film");
        assert_eq!(expected.missing(), []);
        outcomes.push(check_same_bits(name, &image, &developed(&expected)));
        for count in [2, 3, 5, 9] {
            let parts = cut(&whole, count, &mut random);
            let films = parts.iter().map(|part| film(&scene, part));
            let merged = merged(films.collect(), &mut random);
            assert_eq!(merged, expected, "{name} of {count} parts");
            assert!(
                bytes(&merged) == bytes(&expected),
                "{name} of {count} parts"
            );
        }
    }
    assert_none(outcomes);
}

#[test]
fn film_tiles_and_submissions_do_not_affect_films() {
    let scene = scenes::spheres();
    let whole = stratified(70, (41, 23));
    let slicing = Slicing {
        tile_side: 16,
        max_groups: 3,
        max_samples: 5,
        ..Slicing::default()
    };
    let expected = film(&scene, &whole);
    assert!(bytes(&expected) == bytes(&film(&scene, &sliced(&whole, slicing))));
}

/// With a constant background every sum is known.
#[test]
fn sums_of_several_blocks_are_exact() {
    let scene = Scene {
        background: Background::Color(glam::vec3(0.5, 0.25, 3.0)),
        ..scenes::empty()
    };
    let image = developed(&film(&scene, &stratified(1000, (8, 8))));
    assert!(
        image
            .pixels
            .iter()
            .all(|pixel| *pixel == [0.5, 0.25, 3.0, 1.0])
    );
}

#[test]
fn films_of_other_pictures_are_refused_with_what_differs() {
    let scene = scenes::spheres();
    let own = stratified(2, (8, 6));
    let first = film(&scene, &own);
    let mut moved = scene.clone();
    moved.cameras[0].fov_y *= 0.9;
    let mut painted = scene.clone();
    painted.materials[0].classical_mut().diffuse *= 0.5;
    let rows = [
        ("size", scene.clone(), stratified(2, (8, 7))),
        ("number of samples", scene.clone(), stratified(3, (8, 6))),
        ("scene", painted, own.clone()),
        ("view", moved, own.clone()),
        (
            "settings",
            scene.clone(),
            RenderSettings {
                seed: 1,
                ..own.clone()
            },
        ),
        (
            "integrator",
            scene.clone(),
            RenderSettings {
                integrator: Integrator::Ids,
                ..own.clone()
            },
        ),
        (
            "layers",
            scene.clone(),
            RenderSettings {
                antialias: Antialias::Adaptive,
                ..own.clone()
            },
        ),
    ];
    let mut brighter = first.clone();
    brighter.set_tone(Tone {
        exposure_ev: 1.0,
        ..Tone::LINEAR
    });
    let error = first.merge(&brighter).expect_err("another tone");
    let tones = "differ in the tone, exposure 0 EV, curve none, transfer linear and exposure 1 EV, curve none, transfer linear.";
    assert!(error.to_string().contains(tones), "{error}");
    for (field, scene, settings) in rows {
        let error = first.merge(&film(&scene, &settings)).expect_err(field);
        let FilmError::Differs { what, .. } = &error else {
            panic!("{field}: {error}");
        };
        assert_eq!(*what, field);
        let text = error.to_string();
        assert!(text.contains(field), "{text}");
        // Words of people, not of Rust.
        assert!(!text.contains(['{', '(', '[', '"']), "{text}");
    }
}

#[test]
fn samples_common_to_two_films_are_named() {
    let scene = scenes::spheres();
    let whole = stratified(200, (20, 10));
    let part = |crop, sample_range| {
        let part = RenderSettings {
            crop: Some(crop),
            sample_range: Some(sample_range),
            ..whole.clone()
        };
        film(&scene, &part)
    };
    let first = part([2, 1, 12, 9], 64..200);
    // Adjacent pixels, and other samples of the same pixels.
    assert!(first.merge(&part([12, 1, 20, 9], 0..200)).is_ok());
    assert!(first.merge(&part([0, 0, 20, 10], 0..64)).is_ok());
    let error = first
        .merge(&part([8, 4, 20, 10], 0..128))
        .expect_err("an overlap");
    let FilmError::Overlap { region, samples } = error else {
        panic!("{error}");
    };
    assert_eq!((region, samples), ([8, 4, 4, 5], 64..128));
}

#[test]
fn missing_samples_are_listed() {
    let scene = scenes::spheres();
    let whole = stratified(200, (20, 10));
    let part = RenderSettings {
        crop: Some([5, 0, 20, 10]),
        sample_range: Some(64..128),
        ..whole
    };
    let missing = film(&scene, &part).missing();
    let missing: Vec<_> = missing
        .iter()
        .map(|m| (m.region, m.samples.clone()))
        .collect();
    let expected = [
        ([0, 0, 5, 10], 0..200),
        ([5, 0, 15, 10], 0..64),
        ([5, 0, 15, 10], 128..200),
    ];
    assert_eq!(missing, expected);
}

#[test]
fn the_film_of_an_unfinished_picture_has_its_finished_blocks() {
    let scene = scenes::spheres();
    let whole = stratified(100, (12, 9));
    let slicing = Slicing {
        max_samples: 10,
        ..Slicing::default()
    };
    let mut renderer = start(&scene, &sliced(&whole, slicing)).expect("a renderer");
    while renderer.samples_done() < 80 {
        renderer.step().expect("a step");
    }
    assert!(!renderer.is_done());
    let so_far = renderer.film().expect("a film");
    let block = RenderSettings {
        sample_range: Some(0..64),
        ..whole.clone()
    };
    let rest = RenderSettings {
        sample_range: Some(64..100),
        ..whole.clone()
    };
    assert!(bytes(&so_far) == bytes(&film(&scene, &block)));
    let complete = so_far.merge(&film(&scene, &rest)).expect("both parts");
    assert!(bytes(&complete) == bytes(&film(&scene, &whole)));
}

#[test]
fn ranges_of_partial_blocks_have_no_film() {
    for range in [0..63, 1..64, 64..100, 65..150] {
        let settings = RenderSettings {
            sample_range: Some(range.clone()),
            ..stratified(150, (8, 8))
        };
        let error = traced(&scenes::spheres(), &settings).film().map(drop);
        let is_refused = matches!(&error, Err(RenderError::Film(FilmError::Unaligned { .. })));
        assert!(is_refused, "{range:?}: {error:?}");
    }
}

#[test]
fn a_range_of_samples_is_the_mean_of_those_samples() {
    // Two ranges and both together, each with the mean of its own samples.
    let scene = scenes::everything();
    let mean = |range| {
        let settings = RenderSettings {
            sample_range: Some(range),
            ..stratified(12, (16, 12))
        };
        render(&scene, &settings).0
    };
    let (first, second, all) = (mean(0..4), mean(4..12), mean(0..12));
    for ((first, second), all) in first.pixels.iter().zip(&second.pixels).zip(&all.pixels) {
        for ((first, second), all) in first.iter().zip(second).zip(all) {
            let both = (4.0 * first + 8.0 * second) / 12.0;
            assert!(
                (both - all).abs() <= 1e-5 * all.abs().max(1.0),
                "{both} {all}"
            );
        }
    }
    assert_ne!(first, second);
}

#[test]
fn adaptive_pictures_have_films_that_are_cut_into_regions_only() {
    let scene = scenes::everything();
    let whole = RenderSettings {
        antialias: Antialias::Adaptive,
        ..stratified(100, (40, 30))
    };
    let mut renderer = start(&scene, &whole).expect("a renderer");
    let unfinished = renderer.film().map(drop);
    assert!(matches!(
        unfinished,
        Err(RenderError::Film(FilmError::Unfinished))
    ));
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
    let expected = renderer.film().expect("a film");
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    let read = Film::read(&bytes(&expected)[..]).expect("a film");
    assert_none([check_same_bits("read", &image, &developed(&read))]);

    let crop = |crop| RenderSettings {
        crop: Some(crop),
        ..whole.clone()
    };
    let parts = [[0, 0, 13, 30], [13, 0, 40, 11], [13, 11, 40, 30]];
    let mut films = parts.map(|part| film(&scene, &crop(part))).into_iter();
    let first = films.next().expect("three");
    let merged = films
        .try_fold(first, |all, part| part.merge(&all))
        .expect("one picture");
    assert!(bytes(&merged) == bytes(&expected));

    let range = RenderSettings {
        sample_range: Some(0..64),
        ..whole.clone()
    };
    let error = start(&scene, &range).map(drop).expect_err("a refusal");
    assert!(
        error
            .to_string()
            .contains("adaptive sampling cannot be split"),
        "{error}"
    );
}

#[test]
fn quantities_are_developed_from_films_as_from_renderers() {
    let scene = scenes::everything();
    let tone = Tone {
        levels: Levels::Found,
        ..Tone::LINEAR
    };
    let rows = [
        (Integrator::Depth, Antialias::Stratified),
        (Integrator::Heat, Antialias::Stratified),
        (Integrator::Samples, Antialias::Adaptive),
        (Integrator::Samples, Antialias::Stratified),
    ];
    assert_none(rows.map(|(integrator, antialias)| {
        let settings = RenderSettings {
            integrator,
            antialias,
            ..stratified(80, (40, 30))
        };
        let mut renderer = traced(&scene, &settings);
        let expected = renderer.develop(&tone).expect("a picture");
        let film = renderer.film().expect("a film");
        assert_eq!(film.range(), renderer.range().expect("a range"));
        let actual = film.develop(&open_gpu(), &tone).expect("a picture");
        check_same_bits(integrator.entry().name, &expected, &actual)
    }));
}
