//! Golden pictures: small pictures, one for each feature, that a person has checked. A failure explains how to
//! compare and how to update them.

use crate::models;
use crate::path::lobes;
use crate::reference::compare::{assert_none, check_alike, sized, start_packed};
use crate::reference::scenes::{self, Build};
use crate::textures;
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::image::Image;
use glimray::output;
use glimray::pack;
use glimray::render::{Antialias, Filter, Integrator, Levels, RenderSettings, Tone, TriangleTest};
use glimray::scene::{
    Attenuation, Lens, Light, LightKind, Material, Scene, Shadows, ToneCurve, Transfer,
};
use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 48;
/// Tolerance for a tenth of a percent of the pixels.
const LEVELS: f32 = 3.0;
const MOST_BYTES: u64 = 24 << 10;
/// The contact sheet of models.
const MODELS: &str = "models";
/// The variable that picks every so many of the pictures only.
pub const STRIDE: &str = "GOLDEN_STRIDE";
const UPDATE: &str = "UPDATE_GOLDEN=1 cargo test --profile ci --test suite golden";

struct Golden {
    name: &'static str,
    scene: Scene,
    settings: RenderSettings,
    tone: Tone,
}

fn golden(name: &'static str, scene: Scene) -> Golden {
    let tone = Tone {
        transfer: Transfer::Srgb,
        ..Tone::LINEAR
    };
    Golden {
        name,
        scene,
        settings: sized(WIDTH, HEIGHT),
        tone,
    }
}

impl Golden {
    fn set(mut self, change: impl FnOnce(&mut RenderSettings)) -> Self {
        change(&mut self.settings);
        self
    }

    fn viewed(self, integrator: Integrator, exposure_ev: f32) -> Self {
        let tone = Tone {
            exposure_ev,
            ..Tone::LINEAR
        };
        Self { tone, ..self }.set(|settings| settings.integrator = integrator)
    }

    /// Shown over the range found in the picture.
    fn ranged(mut self, integrator: Integrator) -> Self {
        self = self.viewed(integrator, 0.0);
        self.tone.levels = Levels::Found;
        self
    }

    fn toned(mut self, exposure_ev: f32, curve: ToneCurve) -> Self {
        self.tone = Tone {
            exposure_ev,
            curve,
            ..self.tone
        };
        self
    }

    fn linear(mut self) -> Self {
        self.tone.transfer = Transfer::Linear;
        self
    }

    fn render(&self) -> Image {
        let packed = Arc::new(pack::scene(&self.scene).expect("packed"));
        let view = packed.frame(&self.scene.frame(0.0)).expect("a frame");
        let mut renderer = start_packed(packed, &view, &self.settings);
        while !renderer.is_done() {
            renderer.step().expect("a step");
        }
        renderer.develop(&self.tone).expect("a picture")
    }
}

/// A ball, a torus and a sphere on a floor, without lights.
fn still_life() -> Scene {
    let mut scene = scenes::empty();
    let red = scene.add_material(scenes::shiny(vec3(0.9, 0.3, 0.2)));
    let green = scene.add_material(scenes::shiny(vec3(0.3, 0.7, 0.3)));
    let blue = scene.add_material(scenes::shiny(vec3(0.2, 0.4, 0.9)));
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene.add_sphere(dvec3(-1.6, 0.8, 0.0), 0.8, red);
    let lying = DAffine3::from_translation(dvec3(0.3, 0.4, 1.0)) * DAffine3::from_rotation_x(0.2);
    scene.add_mesh(
        scenes::torus(0.7, 0.3, UVec2::new(24, 12), green as u32),
        lying,
    );
    let placed = DAffine3::from_translation(dvec3(1.8, 0.9, -0.3));
    scene.add_mesh(scenes::ball(UVec2::new(20, 10), blue as u32), placed);
    scene
}

fn lit() -> Scene {
    let mut scene = still_life();
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.8);
    scene
}

fn lit_by(kind: LightKind, strength: f32, attenuation: Attenuation) -> Scene {
    let mut scene = still_life();
    scene.lights.push(Light {
        kind,
        color: Vec3::splat(strength),
        attenuation,
        ..Light::default()
    });
    scene
}

fn spot() -> LightKind {
    let position = dvec3(0.5, 5.0, 3.0);
    LightKind::Spot {
        position,
        direction: -position.normalize(),
        inner: 0.15,
        outer: 0.35,
    }
}

fn mixed() -> Scene {
    let mut scene = still_life();
    let count = scene.materials.len() as u32;
    for mesh in &mut scene.meshes {
        let mesh = std::sync::Arc::make_mut(mesh);
        for (i, material) in mesh.materials.iter_mut().enumerate() {
            *material = i as u32 / 3 % count;
        }
    }
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.8);
    scene
}

/// Two walls seen and lit from behind: the left one is two-sided, the right one is not.
fn sides() -> Scene {
    let mut scene = scenes::empty();
    let one_sided = scene.add_material(Material {
        two_sided: false,
        ..Material::default()
    });
    let upright = DAffine3::from_rotation_x(PI / 2.0);
    for (x, material) in [(-1.5, 0), (1.5, one_sided)] {
        // Both face away from the camera and the lamp.
        let turned = DAffine3::from_rotation_y(PI) * upright;
        let placement = DAffine3::from_translation(dvec3(x, 0.5, 0.0)) * turned;
        scene.add_mesh(scenes::quad(2.4, material as u32), placement);
    }
    scene.add_point_light(dvec3(0.0, 2.0, 4.0), 0.8);
    scene
}

fn inside() -> Scene {
    let mut scene = still_life();
    let shell = scene.add_material(scenes::shiny(vec3(0.7, 0.6, 0.3)));
    scene.add_sphere(dvec3(0.0, 1.0, 2.0), 7.0, shell);
    scene.add_point_light(dvec3(2.0, 4.0, 4.0), 0.8);
    scene
}

fn filtered() -> Scene {
    let mut scene = scenes::mirrors_and_glass();
    scene.shadows = Shadows::Filtered;
    scene
}

fn lamp() -> LightKind {
    LightKind::Disc {
        center: dvec3(1.0, 3.0, 1.5),
        normal: DVec3::NEG_Y,
        radius: 0.6,
    }
}

fn blurred() -> Scene {
    let mut scene = lit();
    scene.cameras[0].lens = Some(Lens {
        radius: 0.15,
        focus_distance: 6.0,
        blade_count: 6,
        blade_rotation: 0.3,
    });
    scene
}

fn sixteen(settings: &mut RenderSettings) {
    settings.samples = 16;
    settings.antialias = Antialias::Stratified;
}

fn goldens() -> Vec<Golden> {
    let none = Attenuation::None;
    let aslant = LightKind::Directional {
        direction: dvec3(-0.5, -0.7, -0.5).normalize(),
    };
    let near = LightKind::Point {
        position: dvec3(0.3, 1.6, 1.0),
    };
    let mut bright = lit();
    bright.lights[0].color = vec3(6.0, 5.0, 3.5);
    vec![
        golden("whitted", lit()),
        golden("normals", lit()).viewed(Integrator::Normals, 0.0),
        golden("depth", lit()).viewed(Integrator::Depth, -4.0),
        golden("ids", lit()).viewed(Integrator::Ids, 0.0),
        golden("heat", lit()).ranged(Integrator::Heat),
        golden("depth-range", lit()).ranged(Integrator::Depth),
        golden("triangle-plane", lit()).set(|s| s.triangle_test = TriangleTest::Plane),
        golden("triangle-moller-trumbore", lit())
            .set(|s| s.triangle_test = TriangleTest::MollerTrumbore),
        golden("stratified", lit()).set(|s| {
            s.samples = 16;
            s.antialias = Antialias::Stratified;
        }),
        golden("crop", lit()).set(|s| {
            s.size = (128, 96);
            s.crop = Some([20, 30, 20 + WIDTH, 30 + HEIGHT]);
        }),
        golden("light-none", still_life()),
        golden("light-directional", lit_by(aslant, 0.8, none)),
        golden("light-spot", lit_by(spot(), 0.9, none)),
        golden(
            "light-inverse-square",
            lit_by(near, 1.5, Attenuation::InverseSquare),
        ),
        golden("materials-mixed", mixed()),
        golden("materials-sides", sides()),
        golden("inside-a-sphere", inside()),
        golden("background", scenes::empty()),
        golden("background-gradient", textures::under_a_gradient()),
        golden("background-picture", textures::under_a_picture()),
        golden("everything", scenes::everything()),
        golden("mirrors-and-glass", scenes::mirrors_and_glass()),
        golden("shadows-filtered", filtered()),
        golden("forms", scenes::solids()),
        golden(
            "light-area",
            lit_by(lamp(), 3.0, Attenuation::InverseSquare),
        )
        .set(sixteen),
        golden("lens", blurred()).set(sixteen),
        golden("filter-blackman-harris", lit()).set(|s| {
            sixteen(s);
            s.filter = Filter::BlackmanHarris;
            s.filter_radius = 1.5;
        }),
        golden("adaptive", lit()).set(|s| {
            sixteen(s);
            s.antialias = Antialias::Adaptive;
        }),
        golden("samples", lit()).set(|s| {
            sixteen(s);
            s.antialias = Antialias::Adaptive;
            s.integrator = Integrator::Samples;
        }),
        golden("transfer-linear", lit()).linear(),
        golden("tone-none", bright.clone()),
        golden("tone-aces", bright.clone()).toned(0.0, ToneCurve::Aces),
        golden("tone-agx", bright.clone()).toned(0.0, ToneCurve::Agx),
        golden("tone-reinhard", bright.clone()).toned(0.0, ToneCurve::Reinhard),
        golden("tone-neutral", bright.clone()).toned(0.0, ToneCurve::Neutral),
        golden("exposure", bright).toned(-2.5, ToneCurve::None),
        golden("lobes", lobes::scene()).set(|s| *s = lobes::settings()),
    ]
}

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    folder.join(format!("{name}.png"))
}

/// A stored picture, with levels from 0 to 1.
fn stored(name: &str) -> Result<Image, String> {
    let read =
        image::open(path(name)).map_err(|error| format!("{name}: {error}. Run: {UPDATE}"))?;
    let read = read.into_rgb8();
    let pixels = read
        .pixels()
        .map(|p| vec3(p[0].into(), p[1].into(), p[2].into()) / 255.0);
    Ok(Image {
        width: read.width(),
        height: read.height(),
        pixels: pixels.map(|p| p.extend(1.0).to_array()).collect(),
    })
}

/// Checks a picture against the stored one, or stores it.
fn check(name: &str, actual: &Image) -> Result<(), String> {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        return output::save(path(name), actual).map_err(|error| error.to_string());
    }
    // Includes the rounding to levels.
    let levels = LEVELS + 0.5;
    check_alike(
        &format!("golden {name}"),
        &stored(name)?,
        actual,
        levels,
        0.001,
    )
    .map_err(|why| format!("{why}. If it is right now, run: {UPDATE}"))
}

#[test]
fn golden_pictures_are_as_they_were() {
    let goldens = goldens();
    let stride = std::env::var(STRIDE).map_or(1, |stride| stride.parse().expect("a number"));
    assert_none(
        goldens
            .iter()
            .step_by(stride)
            .map(|golden| check(golden.name, &golden.render())),
    );
}

#[test]
fn the_contact_sheet_of_models_is_as_it_was() {
    assert_none([check(MODELS, &models::sheet())]);
}

#[test]
fn golden_pictures_are_small_and_all_in_use() {
    let goldens = goldens();
    let names = goldens.iter().map(|golden| golden.name);
    let names: Vec<_> = names.chain([MODELS]).collect();
    let folder = path("any").parent().map(PathBuf::from).expect("a folder");
    for entry in folder.read_dir().expect("golden pictures") {
        let entry = entry.expect("an entry");
        let bytes = entry.metadata().expect("a file").len();
        let file = entry.path();
        let name = file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        assert!(
            names.contains(&name.as_str()),
            "{} belongs to no test",
            file.display()
        );
        assert!(bytes <= MOST_BYTES, "{} has {bytes} bytes", file.display());
    }
}
