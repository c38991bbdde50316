//! Defaults of scenes: samples per pixel, and the warning about scenes without light.

use super::scene;
use glimray::export;
use glimray::import::{self, Options};
use glimray::render::{Integrator, Tone};
use glimray::scene::{LightTransport, Scene, ToneCurve};

const BALL: &str = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";

fn native(text: &str) -> Scene {
    scene("a.toml", text)
}

/// Scenes that are noisy with one sample per pixel.
const NOISY: [&str; 4] = [
    "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nlens = { radius = 0.1 }\n",
    "[[lights]]\nrectangle = { center = [0, 4, 0], look_at = [0, 0, 0], size = [1, 1] }\n",
    "[[lights]]\nsphere = { center = [0, 4, 0], radius = 0.5 }\n",
    "[output]\nshutter = \"180deg\"\n[[objects]]\nname = 'b'\nsphere = { center = [0, 0, 0], radius = 1 }\n\
     [[animation]]\nobject = 'b'\nproperty = 'translate'\nkeys = [[0, [0, 0, 0]], [1, [1, 0, 0]]]\n",
];

#[test]
fn a_lens_an_area_light_or_a_shutter_gets_sixteen_samples() {
    for text in NOISY {
        assert_eq!(native(text).output.samples, 16, "{text}");
    }
    assert_eq!(native(BALL).output.samples, 1);
    // A shutter alone does not blur.
    assert_eq!(native("output.shutter = 0.5").output.samples, 1);
}

#[test]
fn explicit_samples_override_the_default_and_survive_conversion() {
    for text in NOISY {
        for samples in [None, Some(1), Some(4), Some(16)] {
            let text = match samples {
                Some(samples) => match text.strip_prefix("[output]") {
                    Some(rest) => format!("[output]\nsamples = {samples}{rest}"),
                    None => format!("output.samples = {samples}\n{text}"),
                },
                None => text.to_owned(),
            };
            let scene = native(&text);
            assert_eq!(scene.output.samples, samples.unwrap_or(16), "{text}");
            let written = export::native(&scene, "a", &|_, _| false)
                .expect("written")
                .text;
            let again = import::parse("a.toml", &written, &Options::default());
            let again = again.unwrap_or_else(|error| panic!("{error}\n{written}"));
            assert_eq!(again.output, scene.output, "{written}");
        }
    }
}

#[test]
fn scenes_for_path_tracing_have_its_samples_bounces_and_tone_curve() {
    let of = |text: &str| native(&format!("{text}\n{BALL}")).output;
    let plain = of("");
    assert_eq!(plain.integrator, LightTransport::Whitted);
    assert_eq!((plain.samples, plain.max_depth), (1, 5));
    assert_eq!(Tone::from(&plain).curve, ToneCurve::None);
    let path = of("[output]\nintegrator = 'path'");
    assert_eq!((path.samples, path.max_depth), (64, 16));
    assert_eq!(Tone::from(&path).curve, ToneCurve::Agx);
    let said = of(
        "[output]\nintegrator = 'path'\nsamples = 4\nmax_depth = 2\ntone = 'none'\nauto_exposure = true",
    );
    assert_eq!((said.samples, said.max_depth), (4, 2));
    let tone = Tone::from(&said);
    assert_eq!((tone.curve, tone.auto_exposure), (ToneCurve::None, true));
    let other = of("[output]\npath_tone = 'neutral'");
    let curve_by = |integrator: Integrator| Tone::of_scene(&other, integrator).curve;
    assert_eq!(curve_by(Integrator::Path), ToneCurve::Neutral);
    assert_eq!(curve_by(Integrator::Whitted), ToneCurve::None);
    for output in [plain, path, said, other.clone()] {
        let scene = Scene {
            output,
            ..native(BALL)
        };
        let text = export::native(&scene, "a", &|_, _| false)
            .expect("written")
            .text;
        assert_eq!(native(&text).output, scene.output, "{text}");
    }
}

#[test]
fn a_scene_without_light_is_detected() {
    let dark = [
        BALL.to_owned(),
        format!("background = [1, 1, 1]\n{BALL}"),
        format!("[[lights]]\npoint = {{ position = [0, 3, 0], intensity = 0 }}\n{BALL}"),
        format!("ambient = [1, 1, 1]\n{BALL}material = {{ phong = {{ ambient = [0, 0, 0] }} }}\n"),
        format!("{BALL}material = {{ reflect = {{ amount = 1 }} }}\n"),
    ];
    for text in dark {
        assert!(native(&text).is_unlit(), "{text}");
    }
    assert!(
        scene(
            "a.scene",
            "1 amb: 0 0 0 sphere pos: 0 0 -5 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1"
        )
        .is_unlit()
    );

    let lit = [
        format!("[[lights]]\npoint = {{ position = [0, 3, 0] }}\n{BALL}"),
        format!("ambient = [0, 0.1, 0]\n{BALL}"),
        format!("{BALL}material = {{ emission = [1, 0, 0] }}\n"),
        format!("background = [1, 1, 1]\n{BALL}material = {{ reflect = {{ amount = 1 }} }}\n"),
        format!(
            "background = {{ bottom = [0, 0, 0], top = [1, 1, 1] }}\n{BALL}material = {{ refract = {{ ior = 1.5 }} }}\n"
        ),
        // Light that is animated.
        format!(
            "[[lights]]\nname = 'l'\npoint = {{ position = [0, 3, 0] }}\n\
             [[animation]]\nlight = 'l'\nproperty = 'intensity'\nkeys = [[0, 0], [1, 1]]\n{BALL}"
        ),
        // No surface to light.
        "background = [1, 1, 1]".to_owned(),
    ];
    for text in lit {
        assert!(!native(&text).is_unlit(), "{text}");
    }
    assert!(!scene("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").is_unlit());
}

/// Whether a native scene with a picture `p.png` has no light, and whether its background shines. The picture is black but
/// for the channel `blue` of one texel.
fn under_picture(text: &str, blue: u8) -> (bool, bool) {
    let texels = (0..8).map(|i| [0, 0, if i == 5 { blue } else { 0 }, 255]);
    let png = super::gltf::model::png(4, &texels.collect::<Vec<_>>());
    let folder = super::folder(&[("a.toml", text.as_bytes()), ("p.png", &png)]);
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    (scene.is_unlit(), scene.background_shines())
}

#[test]
fn a_black_picture_is_no_light() {
    let matte = format!("background = {{ picture = 'p.png' }}\n{BALL}");
    assert_eq!(under_picture(&matte, 0), (true, false));
    assert_eq!(under_picture(&matte, 1), (true, true));
    let mirror = format!("{matte}material = {{ reflect = {{ amount = 1 }} }}\n");
    assert_eq!(under_picture(&mirror, 0), (true, false));
    assert_eq!(under_picture(&mirror, 1), (false, true));
    let lamp = format!("{BALL}material = {{ emission = {{ picture = 'p.png' }} }}\n");
    assert_eq!(under_picture(&lamp, 0), (true, false));
    assert_eq!(under_picture(&lamp, 1), (false, false));
    let checker = |color: &str| {
        format!(
            "{BALL}material = {{ emission = {{ checker = {{ a = [0, 0, 0], b = {color} }} }} }}\n"
        )
    };
    assert!(native(&checker("[0, 0, 0]")).is_unlit());
    assert!(!native(&checker("[0, 1, 0]")).is_unlit());
}
