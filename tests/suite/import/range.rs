//! Colours that are finite but whose products overflow: they are clamped and reported, and no sample is
//! lost.

use super::folder;
use crate::reference::compare::{render, sized};
use glimray::import;
use glimray::scene::Scene;

/// The result of loading a file with these contents.
fn read(name: &str, text: &str, others: &[(&str, &[u8])]) -> Scene {
    let folder = folder(&[&[(name, text.as_bytes())], others].concat());
    import::load(&folder.path().join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// Scenes in all formats, with `{}` for a colour.
const SCENES: [(&str, &str); 8] = [
    (
        "a.nff",
        "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 0.1\nresolution 8 8\n\
         b 1 1 1\nl 3 3 3\nl 0 0 5 1 1 1\nf 1 1 1 1 {} 1 0 1\ns 0.6 0 0 1\ns -0.6 0 0 1\n",
    ),
    (
        "a.nff",
        "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 0.1\nresolution 8 8\n\
         b {} 1 1\nl 3 3 3 1 {} 1\nf 1 1 1 1 0.5 1 0.5 {}\ns 0.6 0 0 1\ns -0.6 0 0 1\n",
    ),
    (
        "a.scene",
        "3\namb: {} 0 0\nsphere\npos: 0.6 0 -5\nrad: 1\ndif: 1 {} 1\nspe: 1 1 {}\nshi: 1\n\
         sphere\npos: -0.6 0 -5\nrad: 1\ndif: 1 1 1\nspe: 1 1 1\nshi: 1\n\
         light\npos: 3 3 3\ncol: 1 {} 1\n",
    ),
    (
        "a.toml",
        "background = [{}, 1, 1]\nambient = [1, {}, 1]\n\
         [[lights]]\npoint = { position = [3, 3, 3], intensity = {} }\n\
         [[lights]]\ndirectional = { direction = [0, -1, -1], intensity = {} }\n\
         [[objects]]\nsphere = { center = [0.6, 0, 0], radius = 1 }\n\
         material = { phong = { diffuse = [1, {}, 1], specular = [1, {}, 1] }, emission = [0, 0, {}] }\n\
         [[objects]]\nsphere = { center = [-0.6, 0, 0], radius = 1 }\n\
         material = { reflect = { amount = 1 } }\n",
    ),
    (
        "a.toml",
        "[[lights]]\nsphere = { center = [0, 3, 3], radius = 2, intensity = {}, samples = 2 }\n\
         [[lights]]\nrectangle = { center = [0, 4, 0], look_at = [0, 0, 0], size = [1, 1], radiance = {} }\n\
         [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n\
         material = { phong = { diffuse = { checker = { a = [{}, 1, 1], b = [1, {}, 1] } } } }\n",
    ),
    (
        "a.toml",
        "background = { bottom = [{}, 1, 1], top = [1, {}, 1] }\n\
         [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n\
         material = { reflect = { amount = 1 } }\n",
    ),
    (
        "a.toml",
        "ambient = [1, 1, 1]\n\
         [[lights]]\nname = 'l'\npoint = { position = [3, 3, 3] }\n\
         [[animation]]\nlight = 'l'\nproperty = 'intensity'\nkeys = [[0, {}], [1, 1]]\n\
         [materials.m]\n[[animation]]\nmaterial = 'm'\nproperty = 'diffuse'\nkeys = [[0, [{}, 1, 1]], [1, [1, 1, 1]]]\n\
         [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\nmaterial = 'm'\n",
    ),
    (
        "a.obj",
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n",
    ),
];

/// Products of such colours may be brighter than any light that makes sense: such samples are counted, and no pixel is infinite.
#[test]
fn finite_colours_of_any_size_give_finite_pictures() {
    for (name, scene) in SCENES {
        for size in ["1e30", "3.4e38"] {
            let text = scene.replace("{}", size);
            let library = format!("newmtl m\nKd {size} 1 1\nKs 1 {size} 1\nKa {size} 1 1\n");
            let scene = read(name, &text, &[("a.mtl", library.as_bytes())]);
            let said = scene.skipped.join("; ");
            assert!(
                said.contains("clamped"),
                "{name} with {size}: {said:?}\n{text}"
            );
            let (image, stats) = render(&scene, &sized(24, 24));
            let is_finite = image.pixels.iter().flatten().all(|value| value.is_finite());
            assert!(is_finite, "{name} with {size}\n{text}");
            let is_lit = image.pixels.iter().any(|pixel| pixel[1] > 0.0);
            assert!(
                is_lit || stats.nonfinite_samples > 0,
                "{name} with {size}\n{text}"
            );
        }
    }
}

#[test]
fn ordinary_colours_are_unchanged() {
    for (name, scene) in SCENES {
        let text = scene.replace("{}", "0.5");
        let library = "newmtl m\nKd 0.5 1 1\nKs 1 100 1\nKa 0.5 1 1\n";
        let scene = read(name, &text, &[("a.mtl", library.as_bytes())]);
        assert_eq!(scene.skipped, [""; 0], "{text}");
    }
    // The Sun, at its distance in metres.
    let sun = "[[lights]]\npoint = { position = [0, 1.5e11, 0], intensity = 2e25 }\n";
    let scene = read("a.toml", sun, &[]);
    assert_eq!(scene.skipped, [""; 0]);
    assert_eq!(scene.lights[0].color.x, 2e25);
}

/// Beyond 2^40 kernels drop a sample.
#[test]
fn the_brightest_light_on_the_whitest_surface_is_in_the_picture() {
    let all = |size: &str| {
        format!(
            "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_y_deg = 60\n[output]\nmax_depth = 1\n{size}\n\
             [[objects]]\nrectangle = {{ center = [0, 0, 0], normal = [0, 0, 1], size = [1, 1] }}\n\
             material = {{ phong = {{ diffuse = [3e38, 3e38, 3e38], specular = [0, 0, 0] }} }}\n"
        )
    };
    for light in [
        "[[lights]]\npoint = { position = [0, 0, 5], intensity = 3e38 }",
        "[[lights]]\nspot = { position = [0, 0, 5], direction = [0, 0, -1], outer_deg = 60, intensity = 3e38 }",
        "[[lights]]\ndirectional = { direction = [0, 0, -1], intensity = 3e38 }",
    ] {
        let scene = read("a.toml", &all(light), &[]);
        assert!(
            scene
                .skipped
                .iter()
                .any(|note| note.starts_with("lights clamped")),
            "{:?}",
            scene.skipped
        );
        let (image, stats) = render(&scene, &sized(16, 16));
        assert_eq!(stats.nonfinite_samples, 0, "{light}");
        let lit = image.pixels[8 * 16 + 8][0];
        assert!(lit > 1e11, "{light}: {lit}");
    }
    // A light is not cut where the scene is as large as the light needs.
    let far = "[[lights]]\npoint = { position = [0, 0, 1e6], intensity = 1e20 }";
    let scene = read("a.toml", &all(far), &[]);
    assert_eq!(scene.skipped, ["coefficients clamped to 1000: 2"]);
}

#[test]
fn clamped_values_are_counted() {
    let text = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n\
                material = { phong = { diffuse = [1e4, 0, 0], specular = [0, 2e3, 0] } }\n";
    let scene = read("a.toml", text, &[]);
    assert_eq!(scene.skipped, ["coefficients clamped to 1000: 3"]);
    assert_eq!(
        scene.materials[0].classical().diffuse.to_array(),
        [1e3, 0.0, 0.0]
    );
}
