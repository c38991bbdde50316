//! `compare`: metrics, limits, difference image.

use crate::support::program::Workspace;
use serde_json::Value;
use std::fs;

/// Writes 2×2 black pixels, and the same with the last pixel 3 levels brighter in red.
fn write_pair(workspace: &Workspace) {
    let black = [[0.0; 3]; 4];
    let mut other = black;
    other[3][0] = 3.0 / 255.0;
    workspace.picture("a.png", 2, &black);
    workspace.picture("b.png", 2, &other);
}

#[test]
fn compare_reports_the_metrics_computed_by_hand() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    let run = workspace.run("compare a.png b.png --json").expect(8);
    let figures = run.json();
    let number = |name: &str| figures[name].as_f64().expect(name);
    // One of 12 channels differs by 3/255.
    let rmse = 3.0 / 255.0 / 12_f64.sqrt();
    assert!((number("rmse") - rmse).abs() < 1e-8, "{figures}");
    assert!((number("psnr_db") - 49.381).abs() < 1e-3, "{figures}");
    assert_eq!(number("max_levels"), 3.0);
    assert_eq!(figures["max_at"], serde_json::json!([1, 1]));
    assert_eq!(number("beyond_percent"), 25.0);
    assert!(number("flip") > 0.0 && number("flip") < 1.0);
    assert_eq!(figures["different"], true);
    insta::assert_snapshot!(run.stderr, @"error: the pictures differ (a.png, b.png): 25 % of pixels differ by more than 0/255; the limit is 0 %.");
    let text = workspace.run("compare a.png b.png --tolerance 3").expect(0);
    let lines: Vec<_> = text
        .text()
        .lines()
        .filter(|line| !line.starts_with("FLIP"))
        .collect();
    insta::assert_snapshot!(lines.join("\n"), @r"
    size      2×2 pixels
    RMSE      0.003396 (0.866 levels)
    PSNR      49.38 dB
    largest   3 levels at 1,1
    beyond    0 % of pixels differ by more than 3 levels
    ");
}

#[test]
fn compare_respects_tolerance_and_max_share() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    workspace.run("compare a.png a.png").expect(0);
    workspace.run("compare a.png b.png").expect(8);
    workspace
        .run("compare a.png b.png --tolerance 2.9")
        .expect(8);
    workspace.run("compare a.png b.png --tolerance 3").expect(0);
    workspace
        .run("compare a.png b.png --max-share 25")
        .expect(0);
    workspace
        .run("compare a.png b.png --max-share 24.9")
        .expect(8);
    workspace
        .run("compare a.png b.png --tolerance -1")
        .expect(2);
    workspace
        .run("compare a.png b.png --max-share 101")
        .expect(2);
}

#[test]
fn compare_of_equal_pictures_finds_no_difference() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    let figures = workspace.run("compare b.png b.png --json").expect(0).json();
    assert_eq!(figures["rmse"], 0.0);
    assert_eq!(figures["flip"], 0.0);
    assert_eq!(figures["psnr_db"], Value::Null, "it is infinite");
}

#[test]
fn compare_uses_float_values_unchanged() {
    let workspace = Workspace::new();
    workspace.picture("a.exr", 1, &[[0.0, 5.0, 100.0]]);
    workspace.picture("b.exr", 1, &[[0.0, 5.0, 102.0]]);
    workspace.picture("c.exr", 1, &[[f32::NAN, 5.0, 102.0]]);
    let figures = workspace.run("compare a.exr b.exr --json").expect(8).json();
    assert_eq!(figures["max_levels"], 510.0);
    assert_eq!(figures["flip"], 0.0, "both are white on a screen");
    workspace
        .run("compare a.exr b.exr --tolerance 510")
        .expect(0);
    workspace
        .run("compare b.exr c.exr --tolerance 1e9")
        .expect(8);
    workspace.run("compare c.exr c.exr").expect(0);
}

#[test]
fn compare_writes_a_difference_image() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    workspace.run("compare a.png b.png --diff d.png").expect(8);
    let drawn = image::open(workspace.path("d.png"))
        .expect("a picture")
        .into_rgb8();
    assert_eq!(drawn.into_raw(), [0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0]);
    workspace
        .run("compare a.png b.png --diff no/d.png")
        .expect(4);
    workspace.run("compare a.png b.png --diff d.bmp").expect(2);
}

#[test]
fn compare_reports_different_sizes_and_refuses_other_files() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    workspace.picture("wide.png", 3, &[[0.0; 3]; 3]);
    fs::write(workspace.path("broken.png"), b"\x89PNG\r\n\x1a\nnot really").expect("a file");
    let run = workspace.run("compare a.png wide.png").expect(8);
    insta::assert_snapshot!(run.stderr, @"error: the pictures differ (a.png, wide.png): one is 2×2 pixels, the other 3×1.");
    let run = workspace.run("compare a.png nothing.png").expect(3);
    insta::assert_snapshot!(run.stderr, @"error: cannot read the picture (nothing.png): no such file or directory. Give a PNG, JPEG, WebP, KTX2, OpenEXR or Radiance HDR file.");
    for name in ["broken.png", "a.scene", "."] {
        let run = workspace.run(&format!("compare a.png {name}")).expect(3);
        assert_eq!(run.stderr.trim_end().lines().count(), 1, "{}", run.stderr);
    }
}
