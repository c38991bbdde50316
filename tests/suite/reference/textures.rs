//! Textures and backgrounds in f64, from their definitions in `glimray::scene`.

use glam::{DVec2, DVec3, Vec3};
use glimray::scene::{Background, Material, Pattern, Phong, Picture, Scene, Space, Texture, Wrap};
use std::f64::consts::{PI, TAU};

/// The coordinate at which a cell of a pattern begins, as in `lib/pattern.wesl`.
const CELL_START: f64 = -0.00073;

/// The material with its textured Phong coefficients at a point.
pub fn textured(scene: &Scene, material: Material, p: DVec3, uv: DVec2) -> Material {
    let at = |color: Vec3, texture: Option<usize>| {
        let factor = texture.map(|i| color_at(scene, &scene.textures[i], p, uv));
        color * factor.unwrap_or(DVec3::ONE).as_vec3()
    };
    let own = material.classical().into_owned();
    Material {
        bsdf: Phong {
            diffuse: at(own.diffuse, own.textures.diffuse),
            specular: at(own.specular, own.textures.specular),
            ambient: at(own.ambient, own.textures.ambient),
            ..own
        }
        .into(),
        ..material
    }
}

/// The colour of a texture at a point in the world or at (u, v).
pub fn color_at(scene: &Scene, texture: &Texture, p: DVec3, uv: DVec2) -> DVec3 {
    let at = match texture.space {
        Space::World => p,
        Space::Uv | Space::SecondUv => uv.extend(0.0),
    };
    let q = texture.pattern_from_space.transform_point3(at);
    let mix = |a: Vec3, b: Vec3, fraction: f64| a.as_dvec3().lerp(b.as_dvec3(), fraction);
    match texture.pattern {
        Pattern::Checker { a, b } => {
            let cell = (q - CELL_START).floor();
            mix(a, b, cell.element_sum().rem_euclid(2.0))
        }
        Pattern::Stripes { a, b } => mix(a, b, (2.0 * (q.x - CELL_START)).floor().rem_euclid(2.0)),
        Pattern::Gradient { a, b } => mix(a, b, q.x.clamp(0.0, 1.0)),
        Pattern::Noise { a, b, octaves } => mix(
            a,
            b,
            (0.5 + 0.5 * noise_octaves(q, octaves)).clamp(0.0, 1.0),
        ),
        Pattern::Picture {
            picture,
            nearest,
            wrap,
            ..
        } => picture_at(&scene.pictures[picture], q.truncate(), nearest, wrap),
    }
}

/// Radiance from infinity against a unit direction.
pub fn background(scene: &Scene, direction: DVec3) -> DVec3 {
    match scene.background {
        Background::Color(color) => color.as_dvec3(),
        Background::Gradient { bottom, top } => {
            (bottom.as_dvec3()).lerp(top.as_dvec3(), (1.0 + direction.y) / 2.0)
        }
        Background::Picture {
            picture,
            strength,
            rotation,
        } => {
            // The picture is rotated, so the direction is rotated back before lookup.
            let turned = glam::DQuat::from_rotation_y(-rotation) * direction;
            let u = 0.5 + turned.x.atan2(-turned.z) / TAU;
            let v = 0.5 + turned.y.clamp(-1.0, 1.0).asin() / PI;
            let wrap = [Wrap::Repeat, Wrap::Clamp];
            let color = picture_at(&scene.pictures[picture], DVec2::new(u, v), false, wrap);
            f64::from(strength) * color
        }
    }
}

/// A picture over [0, 1]², continued as `wrap` says along u and v.
pub fn picture_at(picture: &Picture, uv: DVec2, nearest: bool, wrap: [Wrap; 2]) -> DVec3 {
    let (width, height) = (i64::from(picture.width), i64::from(picture.height));
    let texels: Vec<_> = picture.linear().collect();
    let continued = |index: i64, count: i64, wrap: Wrap| match wrap {
        Wrap::Repeat => index.rem_euclid(count),
        Wrap::Clamp => index.clamp(0, count - 1),
        Wrap::Mirror => {
            let index = index.rem_euclid(2 * count);
            index.min(2 * count - 1 - index)
        }
    };
    let texel = |column: i64, row_from_below: i64| {
        let row = continued(row_from_below, height, wrap[1]);
        let index = (height - 1 - row) * width + continued(column, width, wrap[0]);
        texels[index as usize].truncate().as_dvec3()
    };
    let place = uv * DVec2::new(width as f64, height as f64);
    if nearest {
        return texel(place.x.floor() as i64, place.y.floor() as i64);
    }
    let place = place - 0.5;
    let (low, fraction) = (place.floor(), place - place.floor());
    let (x, y) = (low.x as i64, low.y as i64);
    let lower = texel(x, y).lerp(texel(x + 1, y), fraction.x);
    let upper = texel(x, y + 1).lerp(texel(x + 1, y + 1), fraction.x);
    lower.lerp(upper, fraction.y)
}

/// Gradient noise (Perlin 2002), with octaves of half the size and strength, over the hash of the lattice.
pub fn noise_octaves(p: DVec3, octaves: u32) -> f64 {
    (0..octaves)
        .map(|k| {
            let scale = f64::from(1 << k);
            let shift = f64::from(k) * DVec3::new(0.37f32 as f64, 0.59f32 as f64, 0.83f32 as f64);
            gradient_noise(scale * p + shift, 256 << k) / scale
        })
        .sum()
}

pub fn gradient_noise(p: DVec3, period: i64) -> f64 {
    let cell = p.floor();
    let inside = p - cell;
    let fade = |t: f64| t.powi(3) * (t * (6.0 * t - 15.0) + 10.0);
    let mut sum = 0.0;
    for corner in 0..8 {
        let step = DVec3::new(
            f64::from(corner & 1),
            f64::from(corner >> 1 & 1),
            f64::from(corner >> 2),
        );
        let place = (cell + step)
            .to_array()
            .map(|c| (c as i64).rem_euclid(period) as u32);
        let away = inside - step;
        let weight = 1.0 - away.abs();
        sum += fade(weight.x) * fade(weight.y) * fade(weight.z) * gradient(place).dot(away);
    }
    sum
}

/// The centre of one of the twelve edges of a cube, as a direction of length √2.
fn gradient([x, y, z]: [u32; 3]) -> DVec3 {
    const EDGES: [[f64; 3]; 16] = [
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [-1.0, 0.0, -1.0],
        [0.0, 1.0, 1.0],
        [0.0, -1.0, 1.0],
        [0.0, 1.0, -1.0],
        [0.0, -1.0, -1.0],
        [1.0, 1.0, 0.0],
        [0.0, -1.0, 1.0],
        [-1.0, 1.0, 0.0],
        [0.0, -1.0, -1.0],
    ];
    let key = hash(x.wrapping_add(hash(y.wrapping_add(hash(z)))));
    EDGES[(key & 15) as usize].into()
}

/// `lowbias32` of Wellons' hash-prospector.
fn hash(x: u32) -> u32 {
    let x = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let x = (x ^ x >> 15).wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}
