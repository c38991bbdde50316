//! View and light for models that have none: a camera that frames the model; two soft lights and a gradient, or a sky
//! with a sun where paths are traced; and a ground that receives the model's shadow.

use super::{Ground, Options, visibility};
use crate::scene::{
    Attenuation, Backdrop, Background, Camera, Framing, Geometry, Light, LightKind, LightTransport,
    Material, Scene, Shape, sky,
};
use glam::{DVec3, Vec3};

/// The field of view of the camera, in radians.
const FOV_Y: f64 = 32.0 * std::f64::consts::PI / 180.0;

/// From the model to its camera: in front of it, to the right and above.
const TOWARDS: DVec3 = DVec3::new(0.62, 0.42, 1.0);

/// Margin around the model, as a fraction of half the image.
const MARGIN: f64 = 0.1;

/// Adds what `scene`, which is a model, lacks: a camera; and if it has no lights, lights, a background and a
/// ground. `options` may leave out each.
pub(super) fn complete(scene: &mut Scene, options: &Options) {
    visibility::note(scene);
    let staging = options.staging;
    if scene.cameras.is_empty() {
        let size = options.size.unwrap_or(scene.output.size);
        scene.cameras = vec![match staging.camera {
            true => camera(scene, size),
            false => Camera::default(),
        }];
    }
    if scene.lights.is_empty() {
        let integrator = options.integrator.unwrap_or(scene.output.integrator);
        light(scene, options, integrator);
    } else if matches!(staging.ground, Ground::Surface | Ground::Shadow) {
        add_ground(scene, staging.ground, false);
    }
    scene.output.samples = scene.default_samples().max(4);
}

/// A camera that sees all of `scene` from the front, right and above, for a picture of this size; the
/// course's camera if nothing in the scene is bounded.
pub(super) fn camera(scene: &Scene, (width, height): (u32, u32)) -> Camera {
    let framing = Framing {
        towards: TOWARDS,
        fov_y: FOV_Y,
        aspect: f64::from(width.max(1)) / f64::from(height.max(1)),
        margin: MARGIN,
    };
    scene.framed(&framing).unwrap_or_default()
}

/// Distance of the lights from the model, in its radii: so far away that they light all of the ground alike.
const DISTANCE: f64 = 1e5;

/// Lights: towards them, their radius by their distance, samples and colour. A warm key light from the left
/// above, and a cool fill light from the right.
const LIGHTS: [(DVec3, f64, u32, Vec3); 2] = [
    (
        DVec3::new(-0.75, 1.25, 0.85),
        0.175,
        2,
        Vec3::new(0.78, 0.75, 0.70),
    ),
    (
        DVec3::new(1.0, 0.55, 0.55),
        0.417,
        1,
        Vec3::new(0.17, 0.19, 0.23),
    ),
];
const AMBIENT: Vec3 = Vec3::new(0.19, 0.20, 0.22);

/// The exposure in stops that makes white paper in this sun nearly white with the tone curve of paths.
const SKY_EXPOSURE: f32 = 0.5;

/// Colours of the background straight down and straight up.
const BOTTOM: Vec3 = Vec3::new(0.30, 0.30, 0.305);
const TOP: Vec3 = Vec3::new(0.60, 0.60, 0.61);

/// Adds lights, a background and a ground around the bounds of `scene`. Lights come from the side of the
/// default camera and do not fade, so that large and small models are lit alike.
fn light(scene: &mut Scene, options: &Options, integrator: LightTransport) {
    let staging = options.staging;
    let bounds = scene.bounds_over_time();
    let (min, max) = bounds.unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
    let center = min.midpoint(max);
    let radius = radius_of(min, max);
    let has_sky = integrator == LightTransport::Path && staging.lights && staging.background;
    if has_sky {
        // Another environment replaces it.
        if options.environment.source.is_none() {
            // With the sun at the left behind the default camera.
            scene.set_sky(
                sky::SUN_ELEVATION_DEG.to_radians(),
                sky::SUN_AZIMUTH_DEG.to_radians(),
            );
        }
        scene.output.exposure_ev = SKY_EXPOSURE;
    } else if staging.lights {
        let distance = DISTANCE * radius;
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
            }
        };
        scene.lights = LIGHTS.map(soft).into();
        scene.ambient = AMBIENT;
    }
    if staging.background && !has_sky {
        scene.background = Background::Gradient {
            bottom: BOTTOM,
            top: TOP,
        };
    }
    if staging.ground != Ground::None {
        add_ground(scene, staging.ground, has_sky);
    }
    scene.staged = staging.lights || staging.background || staging.ground != Ground::None;
}

/// A ground below `scene`, if that is bounded.
fn add_ground(scene: &mut Scene, ground: Ground, has_sky: bool) {
    let Some((min, max)) = scene.bounds_over_time() else {
        return;
    };
    // Slightly below the model, so that its own flat bottom does not coincide with it.
    let center = min.midpoint(max);
    let point = DVec3::new(center.x, min.y - 1e-3 * radius_of(min, max), center.z);
    let color = match has_sky {
        true => Vec3::splat(sky::GROUND_ALBEDO as f32),
        false => ground_color(),
    };
    scene.materials.push(Material {
        name: "ground".to_owned(),
        diffuse: color,
        ambient: color,
        shadow_catcher: ground == Ground::Shadow,
        ..Material::default()
    });
    scene.shapes.push(Shape {
        geometry: Geometry::Plane {
            point,
            normal: DVec3::Y,
        },
        material: scene.materials.len() - 1,
        node: None,
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

/// The colour of a ground that these lights make as bright as the background at the horizon, where the two
/// meet.
fn ground_color() -> Vec3 {
    let falling = |(towards, _, _, color): (DVec3, f64, u32, Vec3)| {
        let cosine = towards.normalize().y as f32;
        cosine * color
    };
    let light: Vec3 = LIGHTS.into_iter().map(falling).sum();
    (BOTTOM + TOP) / 2.0 / (AMBIENT + light)
}
