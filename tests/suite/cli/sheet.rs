//! Sheets: each view shows its side of the model, to scale, with the bar that says so.

use crate::support::program::Workspace;
use crate::support::verdict::Verdict;
use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use std::fmt::Write;

/// A model whose three arms differ in colour and length: red along x to 3, green along y to 2, blue along z to 4.
fn arms(workspace: &Workspace) {
    let mut model = "mtllib a.mtl\n".to_owned();
    let boxes = [
        ("red", [0, 0, 0], [3, 1, 1]),
        ("green", [0, 1, 0], [1, 2, 1]),
        ("blue", [0, 0, 1], [1, 1, 4]),
    ];
    for (color, low, high) in boxes {
        writeln!(model, "usemtl {color}").expect("text");
        for corner in 0..8 {
            let [x, y, z] = [0, 1, 2].map(|axis| match corner >> axis & 1 {
                0 => low[axis],
                _ => high[axis],
            });
            writeln!(model, "v {x} {y} {z}").expect("text");
        }
        model += "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n";
    }
    workspace.write("arms.obj", model);
    let material = |name: &str, color: &str| format!("newmtl {name}\nKd {color}\nillum 1\n");
    let library = [
        material("red", "0.7 0.02 0.02"),
        material("green", "0.02 0.7 0.02"),
        material("blue", "0.02 0.02 0.7"),
    ];
    workspace.write("a.mtl", library.concat());
}

/// The middle of the bounding box of the model.
const CENTER: [f64; 3] = [1.5, 1.0, 2.0];

/// For each view along an axis the axes that point right, up and towards the eye, as letters with their signs.
const SIDES: [(&str, [&str; 3]); 6] = [
    ("front", ["+x", "+y", "+z"]),
    ("back", ["-x", "+y", "-z"]),
    ("left", ["+z", "+y", "-x"]),
    ("right", ["-z", "+y", "+x"]),
    ("top", ["+x", "-z", "+y"]),
    ("bottom", ["+x", "+z", "-y"]),
];

/// The component of a vector along an axis.
fn along(axis: &str, vector: [f64; 3]) -> f64 {
    let (sign, letter) = axis.split_at(1);
    let index = "xyz".find(letter).expect("an axis");
    if sign == "-" {
        -vector[index]
    } else {
        vector[index]
    }
}

fn workspace() -> Workspace {
    let workspace = Workspace::new();
    arms(&workspace);
    workspace
}

fn picture(workspace: &Workspace, name: &str) -> RgbImage {
    let picture = image::load_from_memory(&workspace.read(name));
    picture.expect("a picture").into_rgb8()
}

/// The sheet of the model, and the `sheet` of its report.
fn sheet(workspace: &Workspace, flags: &str) -> (RgbImage, Value) {
    let line = format!("sheet arms.obj -o sheet.png --report - {flags}");
    let report = workspace.run(&line).expect(0).report;
    (picture(workspace, "sheet.png"), report["sheet"].clone())
}

/// A view of a sheet: its upper left pixel, and the length of a pixel.
fn view(report: &Value, name: &str) -> ([u32; 2], f64) {
    let views = report["views"].as_array().expect("views");
    let view = views.iter().find(|view| view["name"] == name).expect(name);
    let number = |key: &str| view[key].as_u64().expect(key) as u32;
    let scale = view["units_per_pixel"].as_f64().unwrap_or(f64::NAN);
    ([number("x"), number("y")], scale)
}

#[test]
fn each_view_of_a_sheet_shows_its_side_of_the_model() {
    let workspace = workspace();
    let (picture, report) = sheet(&workspace, "--size 256");
    let (red, green, blue) = ([2.5, 0.5, 0.5], [0.5, 1.5, 0.5], [0.5, 0.5, 3.5]);
    let mut verdict = Verdict::on("views");
    for (name, [right, up, _]) in SIDES {
        let (corner, scale) = view(&report, name);
        let at = |point: [f64; 3]| {
            let pixels = |axis| (along(axis, point) - along(axis, CENTER)) / scale;
            let [x, y] = [128.0 + pixels(right), 128.0 - pixels(up)].map(|it| it as u32);
            picture.get_pixel(corner[0] + x, corner[1] + y).0
        };
        // The red arm hides the green one from below, and the blue one from behind.
        let cases = [
            (red, 0),
            (green, if name == "bottom" { 0 } else { 1 }),
            (blue, if name == "back" { 0 } else { 2 }),
        ];
        for (point, channel) in cases {
            let found = at(point);
            let is_it = (0..3).all(|other| other == channel || found[other] < found[channel] / 2);
            verdict.that(format!("{name} {point:?}"), is_it, || format!("{found:?}"));
        }
        // Beyond the longest arm there is nothing, not even a ground.
        let [r, g, b] = at([3.0, 2.0, 4.0]);
        verdict.that(name, r == g && g == b, || format!("{:?}", [r, g, b]));
    }
    verdict.close();
}

#[test]
fn a_view_of_a_sheet_is_the_picture_that_render_makes_from_there() {
    let workspace = workspace();
    let flags = "--integrator normals --samples 1 --background 0.1,0.1,0.1";
    let (picture, report) = sheet(&workspace, &format!("--size 128 {flags}"));
    let mut verdict = Verdict::on("views");
    for (name, [_, up, towards]) in SIDES {
        let (corner, scale) = view(&report, name);
        let unit =
            |axis| [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|it| along(axis, it));
        let list = |[x, y, z]: [f64; 3]| format!("{x},{y},{z}");
        let eye = [0, 1, 2].map(|index| CENTER[index] + 9.0 * unit(towards)[index]);
        let line = format!(
            "render arms.obj -o view.png --size 128x128 {flags} --orthographic {} --look-from {} --look-at {} --up {}",
            128.0 * scale,
            list(eye),
            list(CENTER),
            list(unit(up))
        );
        workspace.run(&line).expect(0);
        let other = self::picture(&workspace, "view.png");
        // The axes are in the lower half.
        let upper = other.enumerate_pixels().filter(|(_, y, _)| *y < 64);
        let differing = upper.filter(|(x, y, pixel)| {
            let own = picture.get_pixel(corner[0] + x, corner[1] + y);
            own.0.iter().zip(pixel.0).any(|(a, b)| a.abs_diff(b) > 2)
        });
        // Of pixels whose middle is on an edge, either side may be seen.
        let count = differing.count();
        verdict.that(name, count <= 128, || format!("{count} pixels differ"));
    }
    verdict.close();
}

/// The longest horizontal run of pixels for which this holds, in this part of a picture: columns, then rows.
fn longest_run(
    picture: &RgbImage,
    columns: std::ops::Range<u32>,
    rows: std::ops::Range<u32>,
    is: impl Fn(&Rgb<u8>) -> bool,
) -> u32 {
    let mut longest = 0;
    for y in rows {
        let mut run = 0;
        for x in columns.clone() {
            run = if is(picture.get_pixel(x, y)) {
                run + 1
            } else {
                0
            };
            longest = longest.max(run);
        }
    }
    longest
}

#[test]
fn the_scale_bar_is_as_long_as_it_says() {
    let workspace = workspace();
    for side in [64, 320] {
        let flags = format!(
            "--size {side} --views right,front --integrator normals --samples 1 --background 0,0,0"
        );
        let (picture, report) = sheet(&workspace, &flags);
        let (corner, scale) = view(&report, "right");
        let bottom = corner[1] + side..picture.height();
        let bar = longest_run(&picture, 0..picture.width(), bottom, |pixel| {
            pixel.0 == [0; 3]
        });
        let length = report["scale_bar"].as_f64().expect("a length");
        assert!(
            (f64::from(bar) * scale - length).abs() < 1e-9,
            "{bar} pixels of {scale}, {length}"
        );
        let digits = length / 10_f64.powf(length.log10().floor());
        assert!(
            [1.0, 2.0, 5.0]
                .iter()
                .any(|nice| (digits - nice).abs() < 1e-9),
            "{length}"
        );
        // The blue arm is 4 long; the axes are below it.
        let (columns, rows) = (
            corner[0]..corner[0] + side,
            corner[1]..corner[1] + side * 2 / 3,
        );
        let arm = longest_run(&picture, columns, rows, |pixel| pixel.0 != [0; 3]);
        assert!(
            (f64::from(arm) - 4.0 / scale).abs() <= 1.0,
            "{arm} pixels of {scale}"
        );
    }
}

#[test]
fn the_axes_have_their_colours_and_point_as_in_the_view() {
    let workspace = workspace();
    let (picture, report) = sheet(
        &workspace,
        "--size 64 --views top,left --background 0,0,0 --section 1,0,0,-9",
    );
    // The model is cut away, so that only the axes are left.
    for (name, right, upright) in [("top", 0, 2), ("left", 2, 1)] {
        let (corner, _) = view(&report, name);
        let middle = |channel: usize| {
            let (mut sum, mut count) = ([0.0; 2], 0.0);
            for y in 0..64 {
                for x in 0..64 {
                    let found = picture.get_pixel(corner[0] + x, corner[1] + y).0;
                    let others = (0..3).filter(|other| *other != channel);
                    if found[channel] > 90
                        && others.into_iter().all(|it| found[it] < found[channel] / 2)
                    {
                        sum = [sum[0] + f64::from(x), sum[1] + f64::from(y)];
                        count += 1.0;
                    }
                }
            }
            assert!(count > 10.0, "{name} has no axis {channel}: {count}");
            sum.map(|it| it / count)
        };
        let [across, along] = [middle(right), middle(upright)];
        assert!(across[0] > along[0], "{name}: {across:?} {along:?}");
        // From above z points down, from the left y points up.
        assert_eq!(
            across[1] > along[1],
            name == "left",
            "{name}: {across:?} {along:?}"
        );
    }
}

#[test]
fn a_sheet_has_the_chosen_views_in_their_order_and_the_same_bytes_each_time() {
    let workspace = workspace();
    let flags = "--size 64 --views back-left,top,top --samples 1";
    let (first, report) = sheet(&workspace, flags);
    let bytes = workspace.read("sheet.png");
    let (second, _) = sheet(&workspace, flags);
    assert!(bytes == workspace.read("sheet.png") && first == second);
    let views = report["views"].as_array().expect("views");
    let names: Vec<_> = views.iter().map(|view| &view["name"]).collect();
    assert_eq!(names, ["back-left", "top", "top"]);
    assert_eq!(views[0]["units_per_pixel"], Value::Null, "of perspective");
    let column = |index: usize| views[index]["x"].as_u64();
    assert!(column(0) < column(1) && column(1) < column(2));
    let all = workspace
        .run("sheet arms.obj --size 64 --samples 1 --report -")
        .expect(0);
    assert_eq!(
        all.report["sheet"]["views"].as_array().map(Vec::len),
        Some(8)
    );
    let image = &all.report["image"];
    let made = picture(&workspace, "arms.png");
    assert_eq!(
        (&image["width"], &image["height"]),
        (&json!(made.width()), &json!(made.height()))
    );
}

#[test]
fn a_sheet_that_cannot_be_made_is_refused() {
    let workspace = workspace();
    workspace.write(
        "plane.toml",
        "[[objects]]\nplane = { point = [0, 0, 0], normal = [0, 1, 0] }\n",
    );
    for (line, code, message) in [
        ("sheet arms.obj -o a.exr", 2, "cannot write a sheet (a.exr)"),
        (
            "sheet arms.obj -o a.film",
            2,
            "cannot write a sheet (a.film)",
        ),
        ("sheet arms.obj -o a.png --size 63", 2, "63"),
        ("sheet arms.obj -o a.png --views side", 2, "side"),
        ("sheet gone.obj -o a.png", 3, "gone.obj"),
        ("sheet plane.toml -o a.png", 3, "no bounded geometry"),
        (
            "sheet arms.obj -o a.mtl --format png",
            4,
            "this run reads that file",
        ),
        ("sheet arms.obj -o none/a.png", 4, "none"),
    ] {
        workspace.run(line).expect(code).says(message);
    }
    assert!(!workspace.path("a.png").exists());
}
