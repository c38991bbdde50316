//! Maps of full value: they change nothing, even where filtering or their floats exceed 1.

use super::{ball_in, near, paths};
use crate::reference::compare::render;
use crate::support::verdict::Verdict;
use glam::{DAffine3, Vec4};
use glimray::scene::{
    LayerTextures, MetallicRoughness, Minify, Origin, Pattern, Picture, Scene, Space, Texels,
    Texture, Wrap,
};
use std::sync::Arc;

/// A parameter of 1, and the slot of its map.
type Slot = (
    &'static str,
    fn(&mut MetallicRoughness),
    fn(&mut LayerTextures, Option<usize>),
);

const SLOTS: [Slot; 15] = [
    ("base colour", |_| {}, |maps, it| maps.base_color = it),
    (
        "metalness",
        |own| own.metallic = 1.0,
        |maps, it| maps.metallic = it,
    ),
    (
        "roughness",
        |own| own.roughness = 1.0,
        |maps, it| maps.roughness = it,
    ),
    (
        "metalness and roughness",
        |own| (own.metallic, own.roughness) = (1.0, 1.0),
        |maps, it| {
            (maps.metallic, maps.roughness) = (it, it);
        },
    ),
    (
        "transmission",
        |own| own.transmission = 1.0,
        |maps, it| maps.transmission = it,
    ),
    ("specular", |_| {}, |maps, it| maps.specular = it),
    // At an index of 100 the reflectance is near 1.
    (
        "specular colour",
        |own| own.ior = 100.0,
        |maps, it| maps.specular_color = it,
    ),
    (
        "clear coat",
        |own| own.clearcoat = 1.0,
        |maps, it| maps.clearcoat = it,
    ),
    (
        "its roughness",
        |own| (own.clearcoat, own.clearcoat_roughness) = (1.0, 1.0),
        |maps, it| {
            maps.clearcoat_roughness = it;
        },
    ),
    (
        "sheen",
        |own| own.sheen_color = glam::Vec3::ONE,
        |maps, it| maps.sheen_color = it,
    ),
    (
        "its roughness",
        |own| (own.sheen_color, own.sheen_roughness) = (glam::Vec3::ONE, 1.0),
        |maps, it| {
            maps.sheen_roughness = it;
        },
    ),
    (
        "iridescence",
        |own| own.iridescence = 1.0,
        |maps, it| maps.iridescence = it,
    ),
    (
        "thickness of the film",
        |own| own.iridescence = 1.0,
        |maps, it| maps.iridescence_thickness = it,
    ),
    (
        "diffuse transmission",
        |own| own.diffuse_transmission = 1.0,
        |maps, it| {
            maps.diffuse_transmission = it;
        },
    ),
    (
        "its colour",
        |own| own.diffuse_transmission = 0.5,
        |maps, it| {
            maps.diffuse_transmission_color = it;
        },
    ),
];

/// A ball in even light, with this map in one slot.
fn ball((_, set, put): Slot, map: Option<&Texels>) -> Scene {
    let mut model = MetallicRoughness {
        metallic: 0.0,
        roughness: 0.4,
        ..MetallicRoughness::default()
    };
    set(&mut model);
    put(&mut model.textures, map.map(|_| 0));
    let mut scene = ball_in(1.0, model.into());
    if let Some(texels) = map {
        scene.pictures.push(Arc::new(Picture {
            width: 3,
            height: 3,
            texels: texels.clone(),
            origin: Origin::Texels,
        }));
        scene.textures.push(Texture {
            pattern: Pattern::Picture {
                picture: 0,
                nearest: false,
                minify: Minify::default(),
                wrap: [Wrap::Repeat; 2],
            },
            space: Space::Uv,
            pattern_from_space: DAffine3::from_scale(glam::dvec3(7.3, 5.1, 1.0)),
        });
    }
    scene
}

#[test]
fn maps_of_full_value_and_above_it_show_the_material_without_them() {
    let mut verdict = Verdict::on("balls in even light");
    let settings = paths(16, (24, 24), 16);
    for slot in SLOTS {
        let plain = render(&ball(slot, None), &settings).0;
        for (kind, texels) in [
            ("bytes", Texels::Linear8(vec![[255; 4]; 9])),
            ("floats", Texels::Float(vec![Vec4::splat(1.001); 9])),
            ("bright floats", Texels::Float(vec![Vec4::splat(9.0); 9])),
        ] {
            let (mapped, stats) = render(&ball(slot, Some(&texels)), &settings);
            let what = format!("{}, {kind}", slot.0);
            verdict.that(&what, stats.nonfinite_samples == 0, || {
                stats.nonfinite_samples
            });
            let sum = |image: &glimray::image::Image| {
                let values = image.pixels.iter().flat_map(|pixel| &pixel[..3]);
                values.map(|value| f64::from(*value)).sum::<f64>()
            };
            near(&mut verdict, &what, sum(&mapped) / sum(&plain), 1.0, 2e-3);
            let most = |image: &glimray::image::Image| {
                let values = image.pixels.iter().flat_map(|pixel| &pixel[..3]);
                values.copied().fold(0.0, f32::max)
            };
            let [found, expected] = [&mapped, &plain].map(most);
            verdict.that(what, found < 1.01 * expected, || found);
        }
    }
    verdict.close();
}
