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

#[test]
fn compare_limits_flip() {
    let workspace = Workspace::new();
    write_pair(&workspace);
    let figures = workspace.run("compare a.png b.png --json").expect(8).json();
    let flip = figures["flip"].as_f64().expect("a number");
    assert_eq!(figures["flip_limit"], Value::Null);
    let run = |flags: String| workspace.run(&format!("compare a.png b.png {flags}"));
    run(format!("--flip {}", flip * 1.001)).expect(0);
    let beyond = run(format!("--flip {}", flip * 0.999)).expect(8);
    beyond.says("error: the pictures differ (a.png, b.png): FLIP is 0.");
    run("--flip 0".into()).expect(8);
    workspace.run("compare b.png b.png --flip 0").expect(0);
    // Alone it is the only limit; beside those of pixels all hold.
    let json = run("--flip 1 --json".into()).expect(0).json();
    assert_eq!(json["max_share_percent"], Value::Null);
    assert_eq!(
        (&json["flip_limit"], &json["different"]),
        (&1.0.into(), &false.into())
    );
    run("--flip 1 --tolerance 2".into()).expect(8);
    run("--flip 1 --max-share 24".into()).expect(8);
    run("--flip 1 --tolerance 3".into()).expect(0);
    run("--flip 0 --tolerance 3".into()).expect(8);
    run("--flip 1.1".into()).expect(2);
    run("--flip -0.1".into()).expect(2);
}

/// Folders `reference` and `new`: alike, different, on one side only, of different sizes, and no picture.
fn write_folders(workspace: &Workspace) {
    for folder in ["reference/deep", "new/deep"] {
        fs::create_dir_all(workspace.path(folder)).expect("a folder");
    }
    write_pair(workspace);
    for (from, to) in [
        ("a.png", "reference/same.png"),
        ("a.png", "new/same.png"),
        ("a.png", "reference/off.png"),
        ("b.png", "new/off.png"),
        ("a.png", "reference/gone.png"),
        ("a.png", "new/more.PNG"),
        ("a.png", "reference/deep/wide.png"),
    ] {
        workspace.write(to, workspace.read(from));
    }
    workspace.picture("new/deep/wide.png", 3, &[[0.0; 3]; 3]);
    workspace.write("new/report.json", "{}");
    workspace.write("new/.hidden.png", "");
}

#[test]
fn compare_pairs_the_pictures_of_two_folders_by_name() {
    let workspace = Workspace::new();
    write_folders(&workspace);
    let run = workspace.run("compare reference new").expect(8);
    let flip = workspace.run("compare a.png b.png --json").json()["flip"].as_f64();
    let flip = format!("{:.6}", flip.expect("a number"));
    insta::assert_snapshot!(run.text().replace(&flip, "........"), @r"
    picture            RMSE      PSNR      FLIP  largest  beyond  result
    deep/wide.png         -         -         -        -       -  one is 2×2 pixels, the other 3×1
    gone.png              -         -         -        -       -  missing in new
    more.PNG              -         -         -        -       -  missing in reference
    off.png        0.003396  49.38 dB  ........        3    25 %  25 % of pixels differ by more than 0/255; the limit is 0 %
    same.png       0.000000    inf dB  0.000000        0     0 %  ok
    ");
    insta::assert_snapshot!(run.stderr, @"error: the folders differ (reference, new): 4 of 5 pictures differ or are missing: deep/wide.png, gone.png, more.PNG, off.png.");

    let json = workspace.run("compare reference new --json").expect(8);
    let json = json.json();
    let row = |name: &str| {
        let rows = json["pictures"].as_array().expect("a list").iter();
        let mut rows = rows.filter(|row| row["name"] == name);
        rows.next().expect(name).clone()
    };
    assert_eq!(json["different"], true);
    assert_eq!(row("gone.png")["problem"], "missing in new");
    assert_eq!(row("gone.png")["comparison"], Value::Null);
    assert_eq!(row("off.png")["comparison"]["max_levels"], 3.0);
    assert_eq!(row("same.png")["problem"], Value::Null);
    assert_eq!(row("same.png")["comparison"]["different"], false);

    for name in [
        "reference/gone.png",
        "new/more.PNG",
        "reference/deep/wide.png",
        "new/deep/wide.png",
    ] {
        fs::remove_file(workspace.path(name)).expect("removed");
    }
    workspace.run("compare reference new").expect(8);
    let run = workspace
        .run("compare reference new --tolerance 3")
        .expect(0);
    assert_eq!(
        run.text()
            .lines()
            .filter(|line| line.ends_with("  ok"))
            .count(),
        2
    );
    workspace.run("compare reference new --flip 1").expect(0);
    workspace.run("compare reference new --flip 0").expect(8);
}

#[test]
fn compare_writes_the_differences_of_folders_into_a_folder() {
    let workspace = Workspace::new();
    write_folders(&workspace);
    workspace.run("compare reference new --diff d").expect(8);
    assert_eq!(workspace.names("d"), ["off.png"]);
    workspace
        .run("compare a.png b.png --diff one.png")
        .expect(8);
    assert!(workspace.read("d/off.png") == workspace.read("one.png"));
    // A difference never replaces what is compared.
    let before = workspace.files("new");
    let run = workspace.run("compare reference new --diff new").expect(4);
    run.says("cannot write the difference (new/");
    assert!(workspace.files("new") == before);
}

#[test]
fn compare_refuses_folders_without_pictures_and_goes_on_after_a_broken_one() {
    let workspace = Workspace::new();
    write_folders(&workspace);
    for folder in ["empty", "void"] {
        fs::create_dir(workspace.path(folder)).expect("a folder");
    }
    let run = workspace.run("compare empty void").expect(3);
    run.says("error: cannot compare the folders (empty, void): neither has a picture.");
    workspace.run("compare reference empty").expect(8);
    let run = workspace.run("compare reference a.png").expect(3);
    insta::assert_snapshot!(run.stderr, @"error: cannot compare (reference, a.png): one is a folder and the other is not. Give two pictures or two folders.");
    let run = workspace.run("compare reference nowhere").expect(3);
    insta::assert_snapshot!(run.stderr, @"error: cannot compare (reference, nowhere): nowhere is not there. Give two pictures or two folders.");
    for folder in ["reference", "new"] {
        workspace.write(&format!("{folder}/broken.png"), "no picture");
    }
    let run = workspace.run("compare reference new").expect(3);
    run.says("error: cannot read the picture (reference/broken.png): ");
    let rows = run.text().lines().count();
    assert_eq!(rows, 7, "a head and six pictures: {}", run.text());
}
