//! Writes the lighthouse to standard output:
//! `cargo run --example make_lighthouse > assets/scenes/lighthouse.obj`
//!
//! Surfaces of revolution made of quads and two polygons. Parts do not share vertices, so computed
//! normals are smooth within a part and have creases between parts; the rock is flat (`s off`).

use std::f64::consts::TAU;
use std::fmt::Write;

/// Number of sides of round parts.
const SIDES: usize = 24;

/// One part: name, material, whether it is smooth, and its outline of (radius, height) upwards.
type Part = (&'static str, &'static str, bool, &'static [(f64, f64)]);

const PARTS: [Part; 11] = [
    (
        "rock",
        "rock",
        false,
        &[
            (2.3, -0.2),
            (2.1, 0.25),
            (1.75, 0.4),
            (1.5, 0.75),
            (1.1, 0.8),
            (0.8, 0.78),
        ],
    ),
    (
        "plinth",
        "stone",
        true,
        &[(0.86, 0.7), (0.86, 0.95), (0.8, 1.0)],
    ),
    (
        "band_1",
        "white",
        true,
        &[(0.72, 1.0), (0.69, 1.25), (0.66, 1.5)],
    ),
    (
        "band_2",
        "red",
        true,
        &[(0.66, 1.5), (0.63, 1.75), (0.6, 2.0)],
    ),
    (
        "band_3",
        "white",
        true,
        &[(0.6, 2.0), (0.57, 2.25), (0.54, 2.5)],
    ),
    (
        "band_4",
        "red",
        true,
        &[(0.54, 2.5), (0.51, 2.75), (0.48, 3.0)],
    ),
    (
        "band_5",
        "white",
        true,
        &[(0.48, 3.0), (0.46, 3.2), (0.46, 3.35)],
    ),
    (
        "gallery",
        "stone",
        true,
        &[(0.46, 3.3), (0.68, 3.42), (0.7, 3.5)],
    ),
    (
        "lantern",
        "lamp",
        true,
        &[(0.3, 3.5), (0.33, 3.7), (0.33, 3.9), (0.3, 4.1)],
    ),
    (
        "roof",
        "red",
        true,
        &[
            (0.46, 4.08),
            (0.4, 4.22),
            (0.27, 4.38),
            (0.1, 4.48),
            (0.045, 4.5),
        ],
    ),
    (
        "finial",
        "iron",
        true,
        &[
            (0.045, 4.5),
            (0.08, 4.56),
            (0.08, 4.62),
            (0.015, 4.7),
            (0.01, 5.0),
        ],
    ),
];

fn main() {
    let mut text = String::from(
        "# A lighthouse on a rock, five high: quads, polygons and several materials.\n\
         # Made by examples/make_lighthouse.rs\n\
         mtllib lighthouse.mtl\n",
    );
    for (name, material, smooth, outline) in PARTS {
        let smoothing = if smooth { "1" } else { "off" };
        let _ = writeln!(text, "o {name}\nusemtl {material}\ns {smoothing}");
        lathe(&mut text, name == "rock", outline);
    }
    disc(&mut text, "deck", "stone", 0.7, 3.5);
    disc(&mut text, "ledge", "stone", 0.8, 1.0);
    railing(&mut text);
    door(&mut text);
    print!("{text}");
}

/// Rings of vertices and the quads between them. Indices count back from the last vertex.
fn lathe(text: &mut String, rough: bool, outline: &[(f64, f64)]) {
    for (ring, &(radius, height)) in outline.iter().enumerate() {
        for side in 0..SIDES {
            let bump = if rough {
                1.0 + 0.12 * noise(ring * SIDES + side)
            } else {
                1.0
            };
            let lift = if rough {
                0.1 * noise(1000 + ring * SIDES + side)
            } else {
                0.0
            };
            vertex(text, radius * bump, height + lift, side);
        }
    }
    let count = outline.len() * SIDES;
    let back = |ring: usize, side: usize| count - ring * SIDES - side % SIDES;
    for ring in 0..outline.len() - 1 {
        for side in 0..SIDES {
            let (a, b) = (back(ring, side), back(ring, side + 1));
            let (c, d) = (back(ring + 1, side + 1), back(ring + 1, side));
            let _ = writeln!(text, "f -{a} -{b} -{c} -{d}");
        }
    }
}

/// A horizontal disc that faces up: one polygon.
fn disc(text: &mut String, name: &str, material: &str, radius: f64, height: f64) {
    let _ = writeln!(text, "o {name}\nusemtl {material}\ns off");
    for side in 0..SIDES {
        vertex(text, radius, height, side);
    }
    text.push('f');
    for side in 0..SIDES {
        let _ = write!(text, " -{}", SIDES - side);
    }
    text.push('\n');
}

/// Posts around the gallery and a rail on them.
fn railing(text: &mut String) {
    let _ = writeln!(text, "o railing\nusemtl iron\ns off");
    for side in (0..SIDES).step_by(2) {
        let angle = TAU * side as f64 / SIDES as f64;
        let (x, z) = (0.66 * angle.cos(), 0.66 * angle.sin());
        cuboid(
            text,
            [x - 0.012, 3.5, z - 0.012],
            [x + 0.012, 3.72, z + 0.012],
        );
    }
    lathe(
        text,
        false,
        &[
            (0.645, 3.72),
            (0.675, 3.72),
            (0.675, 3.75),
            (0.645, 3.75),
            (0.645, 3.72),
        ],
    );
}

/// A door with a round top: a prism over a polygon that is concave at its step.
fn door(text: &mut String) {
    let _ = writeln!(text, "o door\nusemtl wood\ns off");
    let mut outline = vec![
        (-0.2, 1.0),
        (-0.16, 1.0),
        (-0.16, 1.04),
        (0.16, 1.04),
        (0.16, 1.0),
        (0.2, 1.0),
    ];
    for step in 0..=8 {
        let angle = std::f64::consts::PI * f64::from(step) / 8.0;
        outline.push((0.2 * angle.cos(), 1.4 + 0.2 * angle.sin()));
    }
    let count = outline.len();
    for z in [0.6, 0.76] {
        for &(x, y) in &outline {
            let _ = writeln!(text, "v {x:.3} {y:.3} {z:.3}");
        }
    }
    text.push('f');
    for i in 0..count {
        let _ = write!(text, " -{}", count - i);
    }
    text.push('\n');
    for i in 0..count {
        let j = (i + 1) % count;
        let (a, b, c, d) = (2 * count - i, 2 * count - j, count - j, count - i);
        let _ = writeln!(text, "f -{a} -{b} -{c} -{d}");
    }
}

/// An axis-aligned box between two corners, without a floor.
fn cuboid(text: &mut String, min: [f64; 3], max: [f64; 3]) {
    for (x, y, z) in [
        (min[0], min[1], min[2]),
        (max[0], min[1], min[2]),
        (max[0], min[1], max[2]),
        (min[0], min[1], max[2]),
        (min[0], max[1], min[2]),
        (max[0], max[1], min[2]),
        (max[0], max[1], max[2]),
        (min[0], max[1], max[2]),
    ] {
        let _ = writeln!(text, "v {x:.3} {y:.3} {z:.3}");
    }
    text.push_str("f -4 -1 -2 -3\nf -8 -4 -3 -7\nf -7 -3 -2 -6\nf -6 -2 -1 -5\nf -5 -1 -4 -8\n");
}

fn vertex(text: &mut String, radius: f64, height: f64, side: usize) {
    // Clockwise seen from above, so that faces listed upwards face outwards.
    let angle = -TAU * side as f64 / SIDES as f64;
    let (x, z) = (radius * angle.cos(), radius * angle.sin());
    let _ = writeln!(text, "v {x:.3} {height:.3} {z:.3}");
}

/// A number in [-1, 1] that depends on `index` alone.
fn noise(index: usize) -> f64 {
    let mut bits = (index as u32).wrapping_mul(0x9e37_79b9) ^ 0x85eb_ca6b;
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    f64::from(bits ^ (bits >> 15)) / f64::from(u32::MAX) * 2.0 - 1.0
}
