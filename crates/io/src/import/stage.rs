//! The studio that models are shown in: a camera that frames the model, two soft lamps, a backdrop and a ground.

use super::{Ground, Options, Staging, visibility};
use glam::{DVec3, Vec3};
use glimray_scene::{
    Attenuation, Backdrop, Background, Camera, Framing, Geometry, Light, LightKind, LightTransport,
    Material, Phong, Scene, Shape, Sight, ToneCurve,
};

/// The field of view of the camera, in radians.
const FOV_Y: f64 = 32.0 * std::f64::consts::PI / 180.0;

/// From the model to its camera, horizontally: in front of it, a little to the right.
const TOWARDS: DVec3 = DVec3::new(0.4, 0.0, 1.0);

/// The elevation of the camera in degrees: of models that are at least half as high as wide, and of flat ones.
const ELEVATION_DEG: [f64; 2] = [10.0, 35.0];

/// Margin around the model, as a fraction of half the image.
const MARGIN: f64 = 0.1;

/// Samples per pixel of pictures that are denoised.
const SAMPLES: u32 = 8;

/// Own lights that give white surfaces less than this radiance are helped by the lamps of the studio.
const WEAK: f32 = 0.5;

/// Adds what `scene`, which is a model, lacks: a camera; and if its own lights are weak, lamps, a background and a
/// ground. `options` may leave out each. The tone curve keeps base colours, and where nothing is added, all colours up to white.
pub(super) fn complete(scene: &mut Scene, options: &Options) {
    visibility::note(scene);
    let staging = options.staging;
    let is_dark = scene.lights.is_empty() || scene.own_light() < WEAK;
    choose_camera(scene, options, is_dark);
    if is_dark {
        light(scene, options);
    } else if matches!(staging.ground, Ground::Surface | Ground::Shadow) {
        add_ground(scene, staging.ground);
    }
    scene.output.samples = SAMPLES;
    scene.output.denoise = true;
    scene.output.path_tone = match staging == Staging::NONE {
        true => ToneCurve::None,
        false => ToneCurve::Neutral,
    };
}

/// Makes the first camera that sees something lit the default, or else one that frames `scene`. `is_dark` tells whether light
/// is to be added.
fn choose_camera(scene: &mut Scene, options: &Options, is_dark: bool) {
    let staging = options.staging;
    let size = options.size.unwrap_or(scene.output.size);
    if staging.fit || staging.camera && scene.cameras.is_empty() {
        scene.camera_index = scene.cameras.len();
        scene.cameras.push(framed_camera(scene, size));
    } else if scene.cameras.is_empty() {
        scene.cameras.push(Camera::default());
    } else if staging.camera {
        let adds_light = is_dark && (staging.lights || staging.background);
        let sight = Sight::new(scene, adds_light || options.environment.source.is_some());
        let aspect = f64::from(size.0.max(1)) / f64::from(size.1.max(1));
        let cameras = scene.cameras_at(0.0);
        let sees = |camera: &Camera| sight.sees(camera, aspect);
        let first = cameras.iter().position(sees).unwrap_or(cameras.len());
        if first == cameras.len() {
            scene.cameras.push(Camera {
                name: "framed".to_owned(),
                ..framed_camera(scene, size)
            });
        }
        scene.camera_index = first;
        scene.blind_cameras = first;
    }
}

/// A camera that sees all of `scene` from the front, a little from the right and from above, for a picture of this size;
/// the course's camera if nothing in the scene is bounded.
pub fn framed_camera(scene: &Scene, (width, height): (u32, u32)) -> Camera {
    let size = (scene.bounds_over_time()).map_or(DVec3::ONE, |(min, max)| max - min);
    let flatness = 1.0 - (2.0 * size.y / size.x.max(size.z)).clamp(0.0, 1.0);
    let [least, most] = ELEVATION_DEG;
    let elevation = (least + flatness * (most - least)).to_radians();
    let framing = Framing {
        towards: TOWARDS.with_y(TOWARDS.length() * elevation.tan()),
        fov_y: FOV_Y,
        aspect: f64::from(width.max(1)) / f64::from(height.max(1)),
        margin: MARGIN,
    };
    scene.framed(&framing).unwrap_or_default()
}

/// Whether the default camera of `scene` frames it for a picture of this size, because its file had no camera that suits.
pub fn is_framed(scene: &Scene, size: (u32, u32)) -> bool {
    let own = scene.cameras.get(scene.camera_index);
    // Others are told apart without a look at all vertices.
    own.filter(|own| own.fov_y == FOV_Y && own.node.is_none())
        .is_some_and(|own| {
            *own == Camera {
                name: own.name.clone(),
                ..framed_camera(scene, size)
            }
        })
}

/// Distance of the lamps from the model, in its radii: so far away that they light all of the ground alike.
const DISTANCE: f64 = 1e5;

/// Lamps: towards them, their radius by their distance, samples and colour. A warm key light from the left
/// above, and a cool fill light from the right. With the backdrop they give white surfaces a radiance of about 1, most of which
/// the tone curve does not compress: shapes show on white too.
const LAMPS: [(DVec3, f64, u32, Vec3); 2] = [
    (
        DVec3::new(-0.75, 1.25, 0.85),
        0.175,
        2,
        Vec3::new(0.84, 0.80, 0.75),
    ),
    (
        DVec3::new(1.0, 0.55, 0.55),
        0.417,
        1,
        Vec3::new(0.17, 0.19, 0.23),
    ),
];

/// The light of the backdrop from all around, as classical rays have it.
const AMBIENT: Vec3 = Vec3::new(0.19, 0.20, 0.22);

/// Colours of the background straight down and straight up. It is brighter at the horizon than the ground.
const BOTTOM: Vec3 = Vec3::new(0.22, 0.22, 0.225);
const TOP: Vec3 = Vec3::new(0.62, 0.64, 0.66);

/// Albedo of the ground.
const GROUND: f32 = 0.2;

/// Adds lamps, a background and a ground around the bounds of `scene`. Lamps come from the side of the
/// default camera and do not fade, so that large and small models are lit alike.
fn light(scene: &mut Scene, options: &Options) {
    let staging = options.staging;
    let integrator = options.integrator.unwrap_or(scene.output.integrator);
    // Another environment lights paths alone.
    let is_lit = integrator == LightTransport::Path && options.environment.source.is_some();
    if staging.lights && !is_lit {
        let (min, max) = (scene.bounds_over_time()).unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
        let center = min.midpoint(max);
        let distance = DISTANCE * radius_of(min, max);
        let soft = |(towards, size, samples, color): (DVec3, f64, u32, Vec3)| {
            let normal = -towards.normalize();
            Light {
                kind: LightKind::Disc {
                    center: center - distance * normal,
                    normal,
                    radius: size * distance,
                },
                color,
                attenuation: Attenuation::None,
                samples,
                visible: false,
                node: None,
                name: String::new(),
            }
        };
        scene.lights.extend(LAMPS.map(soft));
        scene.ambient = AMBIENT;
    }
    if staging.background {
        scene.background = Background::Gradient {
            bottom: BOTTOM,
            top: TOP,
        };
    }
    if staging.ground != Ground::None {
        add_ground(scene, staging.ground);
    }
    scene.staged = staging.lights || staging.background || staging.ground != Ground::None;
}

/// A ground below `scene`, if that is bounded.
fn add_ground(scene: &mut Scene, ground: Ground) {
    let Some((min, max)) = scene.bounds_over_time() else {
        return;
    };
    // Slightly below the model, so that its own flat bottom does not coincide with it.
    let center = min.midpoint(max);
    let point = DVec3::new(center.x, min.y - 1e-3 * radius_of(min, max), center.z);
    let color = Vec3::splat(GROUND);
    scene.materials.push(Material {
        name: "ground".to_owned(),
        shadow_catcher: ground == Ground::Shadow,
        bsdf: Phong {
            diffuse: color,
            ambient: color,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    });
    scene.shapes.push(Shape {
        geometry: Geometry::Plane {
            point,
            normal: DVec3::Y,
        },
        material: scene.materials.len() - 1,
        node: None,
        name: String::new(),
    });
    if ground == Ground::Shadow {
        scene.output.backdrop = Backdrop::Transparent;
    }
}

/// Half the diagonal of bounds, never 0, not even for a single point far from the origin.
fn radius_of(min: DVec3, max: DVec3) -> f64 {
    let least = 1e-6 * min.midpoint(max).abs().max_element().max(1e-6);
    ((max - min).length() / 2.0).max(least)
}
