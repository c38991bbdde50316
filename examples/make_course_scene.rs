//! Writes a course scene of rolling hills to standard output:
//! `cargo run --example make_course_scene -- 800 3 > assets/scenes/terrain.scene`
//!
//! The arguments are the number of triangles (800) and of lights (3). The same arguments give the
//! same bytes.

use std::fmt::Write;

/// Half the width of the terrain, and its nearest and farthest distance from the camera.
const HALF_WIDTH: f64 = 9.0;
const NEAR: f64 = -2.5;
const FAR: f64 = -20.0;

/// Position and colour of the lights, in order of use.
const LIGHTS: [([f64; 3], [f64; 3]); 6] = [
    ([-9.0, 6.0, -4.0], [1.0, 0.84, 0.6]),
    ([8.0, 5.0, -14.0], [0.24, 0.32, 0.5]),
    ([0.0, 9.0, 2.0], [0.25, 0.25, 0.22]),
    ([-6.0, 4.0, -18.0], [0.2, 0.1, 0.1]),
    ([6.0, 4.0, -3.0], [0.1, 0.2, 0.1]),
    ([0.0, 12.0, -11.0], [0.1, 0.1, 0.2]),
];

fn main() {
    let mut arguments = std::env::args()
        .skip(1)
        .map(|argument| argument.parse::<usize>());
    let (triangles, lights) = match (arguments.next(), arguments.next()) {
        (None, _) => (800, 3),
        (Some(Ok(triangles)), None) => (triangles, 3),
        (Some(Ok(triangles)), Some(Ok(lights))) => (triangles, lights.min(LIGHTS.len())),
        _ => {
            eprintln!("usage: make_course_scene [TRIANGLES [LIGHTS]]");
            std::process::exit(2);
        }
    };
    print!("{}", scene(triangles, lights));
}

/// The text of a scene with exactly this many triangles and lights.
fn scene(triangles: usize, lights: usize) -> String {
    let mut text = format!("{}\namb: 0.08 0.09 0.11\n", triangles + lights);
    for (position, color) in &LIGHTS[..lights] {
        let _ = writeln!(
            text,
            "light pos: {} col: {}",
            numbers(position),
            numbers(color)
        );
    }
    // Twice as many cells across as deep; the last row may be incomplete.
    let columns = ((triangles as f64).sqrt().round() as usize).max(1);
    let rows = triangles.div_ceil(2 * columns).max(1);
    let corner = |column: usize, row: usize| {
        let x = HALF_WIDTH * (2.0 * column as f64 / columns as f64 - 1.0);
        [x, NEAR + (FAR - NEAR) * row as f64 / rows as f64]
    };
    for index in 0..triangles {
        let (cell, upper) = (index / 2, index % 2);
        let (column, row) = (cell % columns, cell / columns);
        let corners = match upper {
            0 => [(0, 0), (1, 0), (1, 1)],
            _ => [(0, 0), (1, 1), (0, 1)],
        };
        text.push_str("triangle\n");
        for (right, down) in corners {
            let [x, z] = corner(column + right, row + down);
            text.push_str(&vertex(x, z));
        }
    }
    text
}

/// One vertex of the terrain, coloured by its height: meadow, rock, snow.
fn vertex(x: f64, z: f64) -> String {
    const STEP: f64 = 1e-4;
    let y = height(x, z);
    let slope_x = (height(x + STEP, z) - height(x - STEP, z)) / (2.0 * STEP);
    let slope_z = (height(x, z + STEP) - height(x, z - STEP)) / (2.0 * STEP);
    let length = (slope_x * slope_x + slope_z * slope_z + 1.0).sqrt();
    let normal = [-slope_x / length, 1.0 / length, -slope_z / length];
    let rise = ((y + 2.4) / 3.6).clamp(0.0, 1.0);
    let (low, high, t) = match rise {
        t if t < 0.5 => ([0.16, 0.42, 0.14], [0.46, 0.38, 0.28], 2.0 * t),
        t => ([0.46, 0.38, 0.28], [0.92, 0.93, 0.96], 2.0 * t - 1.0),
    };
    let diffuse: Vec<f64> = (0..3).map(|i| low[i] + (high[i] - low[i]) * t).collect();
    let specular = 0.05 + 0.35 * rise * rise;
    format!(
        "pos: {} nor: {} dif: {} spe: {} shi: {}\n",
        numbers(&[x, y, z]),
        numbers(&normal),
        numbers(&diffuse),
        numbers(&[specular; 3]),
        numbers(&[8.0 + 24.0 * rise]),
    )
}

/// The height of the terrain: a few waves, higher towards the back.
fn height(x: f64, z: f64) -> f64 {
    let depth = (z - NEAR) / (FAR - NEAR);
    let waves = (0.9 * x + 0.4 * z).sin() * (0.7 * z - 0.2 * x).cos()
        + 0.5 * (1.9 * x - 1.1 * z + 1.0).sin()
        + 0.25 * (3.1 * z + 2.3 * x).cos();
    -2.1 + 2.4 * depth + waves * (0.25 + 0.85 * depth)
}

/// `values` with at most three decimals, separated by spaces.
fn numbers(values: &[f64]) -> String {
    let number = |value: &f64| {
        let text = format!("{value:.3}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" {
            "0".to_owned()
        } else {
            text.to_owned()
        }
    };
    values.iter().map(number).collect::<Vec<_>>().join(" ")
}
