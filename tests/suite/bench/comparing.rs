//! `glimray bench --compare`: what a comparison says of two runs, and what it refuses.

use crate::support::program::Workspace;
use serde_json::{Value, json};

#[test]
fn a_file_that_is_no_earlier_run_is_refused() {
    let workspace = Workspace::new();
    workspace.write(
        "foreign.json",
        r#"{"glimray": "0.1.0", "command": "render"}"#,
    );
    workspace.write(
        "quick.json",
        r#"{"glimray": "0.1.0", "quick": true, "workloads": []}"#,
    );
    for (file, why) in [
        ("missing.json", "missing.json"),
        ("foreign.json", "no figures of a benchmark"),
        ("a.scene", "no figures of a benchmark"),
        ("quick.json", "with --quick"),
    ] {
        let run = workspace.run(&format!("bench --compare {file}")).expect(3);
        run.says(why);
        run.says("Give a file with the output of `glimray bench --json`.");
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        assert!(run.stdout.is_empty(), "{file}");
    }
}

#[test]
fn a_name_of_no_measurement_is_refused() {
    let run = Workspace::new().run("bench --only nonsense").expect(2);
    run.says("nothing to measure (--only nonsense)");
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
}

#[test]
fn a_comparison_marks_counters_that_grew() {
    let workspace = Workspace::new();
    let mut old = workspace
        .run("bench --quick --only sphereflake --json")
        .expect(0)
        .json();
    let scene = old["scenes"][0].clone();
    assert_eq!(scene["spheres"], 7381);
    let sets: Vec<_> = scene["rays"]
        .as_array()
        .expect("ray sets")
        .iter()
        .map(|set| set["set"].clone())
        .collect();
    assert_eq!(
        sets,
        [
            "primary",
            "shadow",
            "ambient-occlusion",
            "diffuse",
            "mirror",
            "random"
        ]
    );
    for set in scene["rays"].as_array().expect("ray sets") {
        let rate = &set["mrays_per_second"];
        let [low, middle, high] =
            ["min", "median", "max"].map(|name| rate[name].as_f64().expect(name));
        assert!(0.0 < low && low <= middle && middle <= high, "{set}");
        assert!(set["nodes_per_ray"].as_f64().expect("nodes") > 0.5, "{set}");
    }
    let nodes = scene["rays"][0]["nodes_per_ray"].as_f64().expect("nodes");
    old["scenes"][0]["rays"][0]["nodes_per_ray"] = (nodes / 1.06).into();
    let primitives = scene["rays"][0]["primitives_per_ray"]
        .as_f64()
        .expect("primitives");
    old["scenes"][0]["rays"][0]["primitives_per_ray"] = (primitives / 1.04).into();
    workspace.write("old.json", old.to_string());
    let run = workspace
        .run("bench --quick --only sphereflake --compare old.json --json")
        .expect(0)
        .json();
    let nothing = json!({"differences": [], "only_old": [], "only_new": []});
    assert_eq!(run["compared_with"], nothing);
    let compared = run["compared"].as_array().expect("ratios");
    let of = |name: &str| {
        let found = compared
            .iter()
            .find(|ratio| ratio["figure"] == format!("sphereflake/primary/{name}"));
        let found = found.unwrap_or_else(|| panic!("{name} in {compared:?}"));
        (
            found["ratio"].as_f64().expect("a ratio"),
            found["grew"].clone(),
        )
    };
    let (ratio, grew) = of("nodes_per_ray");
    assert!((ratio - 1.06).abs() < 1e-9 && grew == true, "{ratio}");
    let (ratio, grew) = of("primitives_per_ray");
    assert!((ratio - 1.04).abs() < 1e-9 && grew == false, "{ratio}");
    assert!(of("mrays_per_second").1 == false, "a speed is no counter");
}

#[test]
fn the_passes_of_the_denoiser_are_measured_apart() {
    let workspace = Workspace::new();
    let run = workspace.run("bench --quick --only denoiser --json");
    let run = run.expect(0).json();
    let row = &run["denoiser"][0];
    assert_eq!((&row["width"], &row["height"]), (&480.into(), &270.into()));
    let of = |figure: &str| row[figure]["median"].as_f64();
    let whole = of("denoise_seconds").expect("a figure");
    // Adapters without timestamps have none.
    if let Some(passes) = of("pass_seconds") {
        assert!(passes > 0.0 && passes < whole, "{passes} of {whole} s");
    }
}

/// The numbers of `ratio` and `grew` are in another test.
#[test]
fn a_comparison_names_what_only_one_side_has() {
    let workspace = Workspace::new();
    let mut old = workspace
        .run("bench --quick --only glass --json")
        .expect(0)
        .json();
    assert_eq!(old["workloads"][0]["name"], "glass");
    old["glimray"] = "0.0.1".into();
    old["adapter"]["driver"] = "a driver of before".into();
    old["repeats"] = 7.into();
    let row = old["workloads"][0].as_object_mut().expect("a row");
    row.remove("trace_seconds").expect("a figure");
    row.insert("lost_per_ray".into(), 3.0.into());
    row.insert("shadow_rays".into(), 1.into());
    let workloads = old["workloads"].as_array_mut().expect("rows");
    workloads.push(json!({"name": "glass-gone", "trace_seconds": 1.0}));
    // `course` is not measured with `--only glass`, so it is not missing.
    workloads.push(json!({"name": "course", "trace_seconds": 1.0}));
    workspace.write("old.json", old.to_string());

    let run = workspace.run("bench --quick --only glass --compare old.json --json");
    let run = run.expect(0).json();
    let sides = &run["compared_with"];
    assert_eq!(
        sides["only_old"],
        json!(["glass-gone/trace_seconds", "glass/lost_per_ray"])
    );
    assert_eq!(sides["only_new"], json!(["glass/trace_seconds"]));
    let differences = sides["differences"].as_array().expect("differences");
    let of = |what: &str| {
        let found = differences.iter().find(|other| other["what"] == what);
        found.map(|found| [&found["old"], &found["new"]].map(Value::clone))
    };
    assert_eq!(
        of("version"),
        Some(["0.0.1".into(), run["glimray"].clone()])
    );
    let driver = [
        "a driver of before".into(),
        run["adapter"]["driver"].clone(),
    ];
    assert_eq!(of("driver"), Some(driver));
    assert_eq!(of("repeats"), Some([7.into(), 1.into()]));
    assert_eq!(differences.len(), 3, "{differences:?}");
    let text = workspace.run("bench --quick --only glass --compare old.json");
    let text = text.expect(0);
    let text = text.text();
    for line in [
        "The runs differ: version 0.0.1, now ",
        "; driver a driver of before, now ",
        "; repeats 7, now 1.",
        "Only in the old run: glass-gone/trace_seconds, glass/lost_per_ray",
        "Only in the new run: glass/trace_seconds",
    ] {
        assert!(text.contains(line), "{line} in {text}");
    }
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}
