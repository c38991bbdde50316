//! A diver's helmet of copper and brass on a wooden base: pictures of colour, metal, roughness, normals and holes, and
//! windows of glass with a volume.

use crate::{
    glb::Glb,
    pictures::{self, normals, picture, waves},
    surface::Surface,
};
use glam::{Quat, Vec3, vec3};
use image::RgbaImage;
use serde_json::json;
use std::{
    error::Error,
    f32::consts::{PI, TAU},
};

/// The middle of the bonnet, and its radius, in metres.
const CENTER: Vec3 = vec3(0.0, 0.3, 0.0);
const RADIUS: f32 = 0.15;
/// Where the bonnet ends below, as an angle from its top.
const LOWEST: f32 = 0.72 * PI;
/// The radius of the neck, and the height of the ring around it.
const NECK: f32 = 0.117;
const COLLAR: f32 = 0.175;

/// A window of the bonnet: where it looks, and its radius.
struct Window {
    toward: Vec3,
    radius: f32,
    barred: bool,
}

const WINDOWS: [Window; 4] = [
    Window {
        toward: vec3(0.0, -0.08, 1.0),
        radius: 0.056,
        barred: false,
    },
    Window {
        toward: vec3(1.0, -0.04, 0.18),
        radius: 0.046,
        barred: true,
    },
    Window {
        toward: vec3(-1.0, -0.04, 0.18),
        radius: 0.046,
        barred: true,
    },
    Window {
        toward: vec3(0.0, 0.95, 0.72),
        radius: 0.036,
        barred: true,
    },
];

pub fn write(path: &str) -> Result<(), Box<dyn Error>> {
    let mut glb = Glb::default();
    let wood = glb.picture(&pictures::wood())?;
    let bonnet = glb.picture(&copper([512, 256], bonnet_alpha))?;
    let plain = glb.picture(&copper([256, 128], |_, _| 1.0))?;
    let worn = glb.picture(&worn())?;
    let hammered = glb.picture(&normals([256, 128], |u, v| {
        0.0012 * waves(3.0 * u + 0.05 * waves(2.0 * v, u), 2.0 * v)
    }))?;
    let copper = |name: &str, colors: usize| {
        json!({ "name": name, "doubleSided": true, "normalTexture": { "index": hammered },
            "pbrMetallicRoughness": {
            "baseColorTexture": { "index": colors }, "metallicRoughnessTexture": { "index": worn } } })
    };
    let mut holed = copper("bonnet", bonnet);
    holed["alphaMode"] = json!("MASK");
    let materials = [
        json!({ "name": "wood", "pbrMetallicRoughness": {
            "baseColorTexture": { "index": wood }, "metallicFactor": 0, "roughnessFactor": 0.45 } }),
        holed,
        copper("corselet", plain),
        json!({ "name": "brass", "pbrMetallicRoughness": {
            "baseColorFactor": [0.89, 0.68, 0.33, 1], "metallicFactor": 1, "roughnessFactor": 0.28 } }),
        json!({ "name": "glass", "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
            "extensions": {
                "KHR_materials_transmission": { "transmissionFactor": 1 },
                "KHR_materials_ior": { "ior": 1.5 },
                "KHR_materials_volume": { "thicknessFactor": 0.008,
                    "attenuationDistance": 0.1, "attenuationColor": [0.75, 0.95, 0.88] } } }),
    ];
    let (mut brass, mut glass) = (collar(), Surface::default());
    for window in &WINDOWS {
        let (frame, pane) = fittings(window);
        brass.add(&frame);
        glass.add(&pane);
    }
    brass.add(&rim());
    brass.add(&valves());
    let parts = [
        (base(), "wood"),
        (bonnet_surface(), "bonnet"),
        (corselet(), "corselet"),
        (brass, "brass"),
        (glass, "glass"),
    ];
    let material = |name: &str| materials.iter().position(|it| it["name"] == name);
    let parts = parts.map(|(surface, name)| glb.primitive(&surface, material(name), json!({})));
    let mesh = glb.mesh("helmet", parts);
    glb.write(path, json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"],
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "helmet", "mesh": mesh }],
        "materials": materials,
    }))?;
    Ok(())
}

/// A point of the unit sphere: u goes around from +x over -z, v from below to the top.
fn direction(u: f32, v: f32) -> Vec3 {
    let (sin, cos) = (LOWEST * (1.0 - v)).sin_cos();
    let (side, front) = (u * TAU).sin_cos();
    vec3(sin * front, cos, -sin * side)
}

fn bonnet_surface() -> Surface {
    Surface::grid([96, 56], |u, v| CENTER + RADIUS * direction(u, v))
}

/// 0 where a window is; v points down in the picture.
fn bonnet_alpha(u: f32, v: f32) -> f32 {
    let at = direction(u, 1.0 - v);
    let is_hole = |window: &Window| {
        let chord = RADIUS * at.cross(window.toward.normalize()).length();
        at.dot(window.toward) > 0.0 && chord < window.radius + 0.002
    };
    f32::from(!WINDOWS.iter().any(is_hole))
}

/// How far copper has turned green, from 0 to 1: in patches, and more so low down.
fn verdigris(u: f32, v: f32) -> f32 {
    let warped = u + 0.04 * waves(3.0 * v, 2.0 * u);
    let patches = 0.6 * waves(warped + 0.3, v) + 0.25 * waves(3.0 * warped, v);
    smooth_step(0.35, 0.85, patches + 0.7 * (v - 0.5))
}

fn smooth_step(low: f32, high: f32, at: f32) -> f32 {
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn copper(size: [u32; 2], alpha: impl Fn(f32, f32) -> f32) -> RgbaImage {
    picture(size, |u, v| {
        let dark = 0.4 + 0.4 * waves(u + 0.06 * waves(2.0 * v, u), v);
        let bare = vec3(0.93, 0.6, 0.48).lerp(vec3(0.72, 0.41, 0.3), dark.clamp(0.0, 1.0));
        let [r, g, b] = bare
            .lerp(vec3(0.36, 0.56, 0.47), verdigris(u, v))
            .to_array();
        [r, g, b, alpha(u, v)]
    })
}

/// Roughness in green and metal in blue.
fn worn() -> RgbaImage {
    picture([256, 128], |u, v| {
        let green = verdigris(u, v);
        let scuffed = 0.26 + 0.06 * waves(4.0 * u, 3.0 * v);
        [0.0, scuffed + (0.75 - scuffed) * green, 1.0 - green, 1.0]
    })
}

/// A window's frame with its bolts and bars, and its pane, which bulges.
fn fittings(window: &Window) -> (Surface, Surface) {
    let r = window.radius;
    let profile = [
        [r + 0.014, -0.018],
        [r + 0.014, 0.008],
        [r + 0.011, 0.012],
        [r + 0.003, 0.012],
        [r, 0.009],
        [r, -0.018],
    ];
    let mut frame = Surface::lathe(&profile, 64);
    for i in 0..8 {
        let (sin, cos) = ((i as f32 + 0.5) / 8.0 * TAU).sin_cos();
        frame.add(&knob(0.0042).moved((r + 0.007) * vec3(cos, 0.0, sin) + 0.012 * Vec3::Y));
    }
    if window.barred {
        for across in [-0.36, 0.36] {
            let half = r * (1.0f32 - across * across).sqrt() + 0.004;
            let turns = [Quat::IDENTITY, Quat::from_rotation_y(PI / 2.0)];
            for (level, turn) in turns.into_iter().enumerate() {
                let height = 0.0135 + 0.003 * level as f32;
                let ends = [-half, half].map(|x| turn * vec3(x, height, across * r));
                frame.add(&rod(ends, 0.0024));
            }
        }
    }
    let top = (0..=8).map(|i| {
        let part = 1.0 - i as f32 / 8.0;
        [r * part, 0.007 - 0.009 * part * part]
    });
    let profile: Vec<_> = [[0.0, -0.006], [r, -0.006]]
        .into_iter()
        .chain(top)
        .collect();
    let pane = Surface::lathe(&profile, 64);
    let toward = window.toward.normalize();
    let turn = Quat::from_rotation_arc(Vec3::Y, toward);
    let reach = (RADIUS * RADIUS - r * r).sqrt();
    let place = |surface: Surface| surface.turned(turn).moved(CENTER + reach * toward);
    (place(frame), place(pane))
}

/// Half a ball on the plane y = 0.
fn knob(radius: f32) -> Surface {
    Surface::grid([10, 4], |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        let (up, out) = (v * PI / 2.0).sin_cos();
        radius * vec3(out * cos, up, -out * sin)
    })
}

/// A cylinder between two points, without ends.
fn rod([from, to]: [Vec3; 2], radius: f32) -> Surface {
    let turn = Quat::from_rotation_arc(Vec3::Y, (to - from).normalize());
    Surface::grid([8, 1], |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        from.lerp(to, v) + turn * vec3(radius * cos, 0.0, -radius * sin)
    })
}

/// The rings between the bonnet and the corselet.
fn collar() -> Surface {
    let profile = [
        [NECK - 0.006, COLLAR - 0.03],
        [NECK + 0.016, COLLAR - 0.03],
        [NECK + 0.02, COLLAR - 0.026],
        [NECK + 0.02, COLLAR - 0.012],
        [NECK + 0.009, COLLAR - 0.009],
        [NECK + 0.009, COLLAR - 0.001],
        [NECK + 0.016, COLLAR + 0.002],
        [NECK + 0.016, COLLAR + 0.014],
        [NECK + 0.01, COLLAR + 0.018],
        [NECK - 0.006, COLLAR + 0.022],
    ];
    let mut collar = Surface::lathe(&profile, 96);
    for i in 0..16 {
        let turn = Quat::from_rotation_y((i as f32 + 0.5) / 16.0 * TAU);
        let outward = turn * Quat::from_rotation_z(-PI / 2.0);
        let at = turn * vec3(NECK + 0.02, COLLAR - 0.019, 0.0);
        collar.add(&knob(0.004).turned(outward).moved(at));
    }
    collar
}

/// A point of the corselet: u goes around, v from its rim to the neck.
fn shoulder(u: f32, v: f32) -> Vec3 {
    let (sin, cos) = (u * TAU).sin_cos();
    // The rim is higher at the sides, where the arms are.
    let low = 0.055 * cos * cos + 0.008;
    let inward = v.powf(1.25);
    let reach = |rim: f32| rim + (NECK - rim) * inward;
    let height = low + (COLLAR - 0.028 - low) * (1.0 - (1.0 - v).powf(2.2));
    vec3(reach(0.235) * cos, height, -reach(0.175) * sin)
}

fn corselet() -> Surface {
    Surface::grid([96, 32], shoulder)
}

/// The straps around the rim of the corselet, and the studs on them.
fn rim() -> Surface {
    let outward = |u: f32| {
        let across = shoulder(u + 1e-3, 0.06) - shoulder(u - 1e-3, 0.06);
        across
            .cross(shoulder(u, 0.061) - shoulder(u, 0.059))
            .normalize()
    };
    let mut rim = Surface::grid([96, 12], |u, v| {
        let (sin, cos) = (v * TAU).sin_cos();
        shoulder(u, 0.06 + 0.055 * cos) - 0.0045 * sin * outward(u)
    });
    for i in 0..12 {
        let u = (i as f32 + 0.5) / 12.0;
        let turn = Quat::from_rotation_arc(Vec3::Y, outward(u));
        let nut = [[0.011, 0.0], [0.011, 0.006], [0.007, 0.009], [0.0, 0.0095]];
        let at = shoulder(u, 0.06) + 0.004 * outward(u);
        rim.add(&Surface::lathe(&nut, 24).turned(turn).moved(at));
    }
    rim
}

/// The inlet for air behind, and the outlet beside the front window.
fn valves() -> Surface {
    let on_bonnet = |surface: Surface, toward: Vec3| {
        let toward = toward.normalize();
        let turn = Quat::from_rotation_arc(Vec3::Y, toward);
        surface
            .turned(turn)
            .moved(CENTER + (RADIUS - 0.003) * toward)
    };
    let outlet = [
        [0.017, 0.0],
        [0.017, 0.012],
        [0.012, 0.014],
        [0.012, 0.024],
        [0.021, 0.026],
        [0.021, 0.036],
        [0.018, 0.039],
        [0.0, 0.039],
    ];
    let mut valves = on_bonnet(Surface::lathe(&outlet, 32), vec3(0.62, -0.42, 0.66));
    for side in [-1.0, 1.0] {
        let foot = [[0.021, 0.0], [0.021, 0.006], [0.015, 0.009]];
        let toward = vec3(0.55 * side, 0.05, -0.8).normalize();
        valves.add(&on_bonnet(Surface::lathe(&foot, 32), toward));
        valves.add(&bend(CENTER + RADIUS * toward, toward));
    }
    valves
}

/// A pipe that leaves a point in a direction and turns down.
fn bend(from: Vec3, toward: Vec3) -> Surface {
    const TURN: f32 = 0.03;
    const PIPE: f32 = 0.013;
    let aside = toward.cross(Vec3::Y).normalize();
    let up = aside.cross(toward);
    Surface::grid([16, 16], |u, v| {
        let (sin, cos) = (u * TAU).sin_cos();
        let (ahead, rest) = (v * PI / 2.0).sin_cos();
        let middle = from + TURN * (ahead * toward - (1.0 - rest) * up);
        middle + PIPE * (cos * (ahead * toward + rest * up) + sin * aside)
    })
}

fn base() -> Surface {
    let profile = [
        [0.0, -0.04],
        [0.27, -0.04],
        [0.278, -0.036],
        [0.278, -0.026],
        [0.265, -0.018],
        [0.265, -0.006],
        [0.259, 0.0],
        [0.0, 0.0],
    ];
    Surface::lathe(&profile, 96)
}
