//! Balls for one path-traced picture: a row for each lobe of `shaders/lib`, with what makes it wider from left to right.

use super::materials::material;
use super::{looking, paths};
use crate::reference::scenes::{Build, ball};
use glam::{DAffine3, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::render::RenderSettings;
use glimray::scene::{Background, Fresnel, Material, MetallicRoughness, Phong, Picture, Scene};
use std::f64::consts::TAU;

/// Pixels of a cell.
const CELL: u32 = 16;
const SAMPLES: u32 = 256;
const ROUGHNESS: [f32; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// A material for each column.
type Row = [Material; 5];

fn of(change: impl Fn(f32) -> MetallicRoughness) -> Row {
    ROUGHNESS.map(|roughness| material(change(roughness)))
}

fn dielectric(base_color: Vec3) -> MetallicRoughness {
    MetallicRoughness {
        base_color,
        metallic: 0.0,
        ..MetallicRoughness::default()
    }
}

fn metal(base_color: Vec3, roughness: f32) -> MetallicRoughness {
    MetallicRoughness {
        base_color,
        roughness,
        ..MetallicRoughness::default()
    }
}

fn glass(roughness: f32, thickness: f32) -> MetallicRoughness {
    MetallicRoughness {
        roughness,
        thickness,
        transmission: 1.0,
        ..dielectric(Vec3::ONE)
    }
}

/// Two widths of Phong's lobe, a matte body, a mirror and clear glass.
fn phong() -> Row {
    let glossy = |shininess| {
        Material::from(Phong {
            diffuse: vec3(0.3, 0.1, 0.05),
            specular: Vec3::splat(0.1 * shininess),
            shininess,
            ..Phong::default()
        })
    };
    let black = |reflect, transmit| {
        Material::from(Phong {
            diffuse: Vec3::ZERO,
            reflect: Vec3::splat(reflect),
            transmit: Vec3::splat(transmit),
            ..Phong::default()
        })
    };
    let clear = Material {
        bsdf: Phong {
            fresnel: Fresnel::Exact,
            opacity: 0.0,
            ior: 1.5,
            ..black(1.0, 1.0).classical().into_owned()
        }
        .into(),
        ..black(1.0, 1.0)
    };
    let matte = Material::from(Phong {
        diffuse: vec3(0.7, 0.3, 0.2),
        ..Phong::default()
    });
    [black(0.9, 0.0), glossy(100.0), glossy(8.0), matte, clear]
}

/// The rows from the top.
fn rows() -> Vec<Row> {
    vec![
        phong(),
        of(|roughness| MetallicRoughness {
            roughness,
            ..dielectric(vec3(0.1, 0.3, 0.6))
        }),
        of(|roughness| metal(vec3(1.0, 0.75, 0.3), roughness)),
        of(|roughness| MetallicRoughness {
            anisotropy: 0.9,
            ..metal(vec3(0.95, 0.6, 0.5), roughness)
        }),
        of(|roughness| MetallicRoughness {
            iridescence: 1.0,
            iridescence_thickness: [450.0, 450.0],
            iridescence_ior: 1.5,
            ..metal(Vec3::splat(0.4), roughness)
        }),
        of(|clearcoat_roughness| MetallicRoughness {
            clearcoat: 1.0,
            clearcoat_roughness,
            ..dielectric(vec3(0.6, 0.05, 0.05))
        }),
        of(|sheen_roughness| MetallicRoughness {
            sheen_color: vec3(0.9, 0.8, 0.6),
            sheen_roughness,
            ..dielectric(vec3(0.05, 0.02, 0.15))
        }),
        of(|roughness| MetallicRoughness {
            attenuation_color: vec3(0.3, 0.9, 0.5),
            attenuation_distance: 1.0,
            ..glass(roughness, 1.0)
        }),
        of(|roughness| MetallicRoughness {
            base_color: vec3(1.0, 0.7, 0.7),
            ..glass(roughness, 0.0)
        }),
        of(|roughness| MetallicRoughness {
            dispersion: 5.0,
            ior: 1.7,
            ..glass(0.5 * roughness, 1.0)
        }),
        // From nothing to all of the diffuse light.
        of(|part| MetallicRoughness {
            diffuse_transmission: part,
            diffuse_transmission_color: vec3(0.4, 0.9, 0.2),
            ..dielectric(vec3(0.9, 0.8, 0.6))
        }),
    ]
}

/// A room: a bright window in front at the upper left, vertical stripes behind the balls, a dark floor.
fn surroundings() -> Picture {
    let [width, height] = [64, 32];
    let texel = |index: u32| {
        let (x, y) = (index % width, index / width);
        let is_behind = (16..48).contains(&x) && (8..24).contains(&y);
        match (x, y) {
            (4..15, 4..13) => vec3(3.0, 2.8, 2.5),
            _ if is_behind && x / 3 % 2 == 0 => vec3(0.08, 0.08, 0.12),
            _ if is_behind => vec3(0.7, 0.75, 0.8),
            (_, 0..16) => vec3(0.25, 0.3, 0.4),
            _ => vec3(0.12, 0.1, 0.08),
        }
    };
    Picture::opaque(width, height, (0..width * height).map(texel))
}

pub fn scene() -> Scene {
    let rows = rows();
    let height = rows.len() as f64;
    let mut scene = Scene {
        pictures: vec![surroundings().into()],
        background: Background::Picture {
            picture: 0,
            strength: 1.0,
            rotation: 0.0,
        },
        ..Scene::default()
    };
    let mut camera = looking(10.0 * DVec3::Z, DVec3::ZERO, 1.0);
    camera.orthographic_height = Some(height);
    scene.cameras = vec![camera];
    let columns = ROUGHNESS.len() as f64;
    for (j, row) in rows.into_iter().enumerate() {
        for (i, own) in row.into_iter().enumerate() {
            let x = i as f64 + 0.5 - columns / 2.0;
            let center = dvec3(x, height / 2.0 - j as f64 - 0.5, 0.0);
            let is_stretched = (own.metallic_roughness()).is_some_and(|it| it.anisotropy > 0.0);
            let index = scene.add_material(own);
            if !is_stretched {
                scene.add_sphere(center, 0.42, index);
                continue;
            }
            // Along the circles of latitude.
            let parts = UVec2::new(64, 32);
            let mut globe = ball(parts, index as u32);
            let around = |n: &Vec3| f64::from(n.x).atan2(n.z.into()).rem_euclid(TAU);
            let tangents = globe.normals.iter().map(|n| {
                let (sin, cos) = around(n).sin_cos();
                dvec3(cos, 0.0, -sin).as_vec3().extend(1.0)
            });
            globe.tangents = tangents.collect();
            let placed =
                DAffine3::from_translation(center) * DAffine3::from_scale(DVec3::splat(0.42));
            scene.add_mesh(globe, placed);
        }
    }
    scene
}

pub fn settings() -> RenderSettings {
    let [columns, rows] = [ROUGHNESS.len(), rows().len()].map(|count| CELL * count as u32);
    paths(SAMPLES, (columns, rows), 16)
}
