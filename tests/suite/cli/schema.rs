//! JSON that commands print and write follows `glimray schema`.

use crate::support::program::{MOVING, Workspace};
use crate::support::schema::errors;
use crate::support::verdict::Verdict;
use serde_json::{Value, json};

/// Everything that `inspect` has entries for.
const FULL: &str = r##"
background = { bottom = [0, 0, 0], top = [1, 1, 1] }
[[cameras]]
name = "lens"
look_from = [0, 1, 6]
look_at = [0, 0, 0]
lens = { radius = 0.1, blades = 5 }
[[cameras]]
name = "flat"
look_from = [0, 1, 6]
look_at = [0, 0, 0]
orthographic = 3
[[lights]]
point = { position = [0, 3, 0] }
[[lights]]
directional = { direction = [0, -1, 0] }
[[lights]]
spot = { position = [0, 3, 0], direction = [0, -1, 0], outer_deg = 30 }
[[lights]]
rectangle = { center = [0, 4, 0], edge_u = [1, 0, 0], edge_v = [0, 0, 1] }
[[lights]]
disc = { center = [0, 4, 0], normal = [0, -1, 0], radius = 1 }
[[lights]]
sphere = { center = [0, 4, 0], radius = 1 }
[[objects]]
sphere = { center = [0, 0, 0], radius = 1 }
material = { phong = { diffuse = { checker = { a = [1, 0, 0], b = [0, 0, 1] } } } }
[[objects]]
sphere = { center = [2, 0, 0], radius = 1 }
material = { phong = { diffuse = { noise = { a = [1, 0, 0], b = [0, 0, 1] } } } }
[[objects]]
sphere = { center = [-2, 0, 0], radius = 1 }
material = { pbr = { base_color = [1, 0.5, 0], metallic = 1 } }
[[objects]]
sphere = { center = [0, 2, 0], radius = 1 }
material = { refract = { amount = 0.9, ior = 1.5 } }
"##;

fn schema(workspace: &Workspace, subject: &str) -> Value {
    let schema = workspace.run(&format!("schema {subject}")).expect(0).json();
    assert!(schema["$schema"].is_string(), "{schema}");
    schema
}

/// Outputs of commands, printed or in a report, each with a name.
fn outputs(workspace: &Workspace, subject: &str) -> Vec<(String, Value)> {
    workspace.write("full.toml", FULL);
    workspace.write("moving.toml", MOVING);
    for folder in ["left", "right"] {
        std::fs::create_dir(workspace.path(folder)).expect("a folder");
    }
    let lines: &[(&str, i32)] = match subject {
        "report" => &[
            ("render a.scene -o a.png --size 8x8", 0),
            ("render a.scene -o a.png --count-rays --size 8x8", 0),
            (
                "render a.scene -o a.png --integrator path --denoise --size 8x8",
                0,
            ),
            ("animate moving.toml --frames 0..1 -o a.y4m --size 8x8", 0),
            (
                "animate moving.toml --frames 0..1 -o f_%d.png --size 9x9",
                0,
            ),
            (
                "animate moving.toml --frames 0..1 -o f_%d.png --size 8x8",
                0,
            ),
            ("sheet a.scene -o a.png --size 64 --views top,back-left", 0),
            ("render gone.scene -o a.png", 3),
            ("sheet gone.scene -o a.png", 3),
            ("animate gone.toml -o a.y4m", 3),
            (
                "render a.scene -o a.png --memory-limit 1 --size 2048x2048",
                7,
            ),
        ],
        "compare" => {
            workspace.picture("left/a.png", 2, &[[0.0; 3]; 4]);
            workspace.picture("right/a.png", 2, &[[0.5; 3]; 4]);
            workspace.picture("left/b.png", 2, &[[0.0; 3]; 4]);
            workspace.picture("left/c.exr", 1, &[[f32::NAN; 3]]);
            workspace.picture("right/c.exr", 1, &[[0.0; 3]]);
            &[
                ("compare left/a.png right/a.png", 8),
                ("compare left/a.png left/a.png --flip 0.5", 0),
                ("compare left/c.exr right/c.exr", 8),
                ("compare left right", 8),
                ("compare right right", 0),
            ]
        }
        "inspect" => &[
            ("inspect a.scene", 0),
            ("inspect full.toml", 0),
            ("inspect moving.toml", 0),
        ],
        "explain" => &[
            ("explain a.scene --size 9x9 --pixel 4,4", 0),
            ("explain a.scene --size 9x9 --pixel 0,0", 0),
            ("explain full.toml --size 9x9 --pixel 4,4", 0),
            (
                "explain full.toml --size 9x9 --pixel 4,4 --integrator path --samples 4",
                0,
            ),
        ],
        other => panic!("{other}"),
    };
    let to = if subject == "report" {
        "--report -"
    } else {
        "--json"
    };
    let runs = lines.iter().map(|(line, code)| {
        let line = format!("{line} {to}");
        let run = workspace.run(&line).expect(*code);
        (line, run.json())
    });
    runs.collect()
}

#[test]
fn what_commands_write_as_json_keeps_to_its_schema() {
    let mut verdict = Verdict::on("schemas");
    for subject in ["report", "compare", "inspect", "explain"] {
        let workspace = Workspace::new();
        let schema = schema(&workspace, subject);
        for (line, value) in outputs(&workspace, subject) {
            let found = errors(&schema, &value);
            verdict.that(&line, found.is_empty(), || found.join("\n"));
            // The check finds what is not as it should be: a member too many, too few, or of another type.
            let members: Vec<_> = value
                .as_object()
                .expect("an object")
                .keys()
                .cloned()
                .collect();
            let mut more = value.clone();
            more["surprise"] = json!(1);
            verdict.that(
                format!("{line}, more"),
                !errors(&schema, &more).is_empty(),
                || "passes",
            );
            for name in &members {
                let mut other = value.clone();
                other[name] = json!({ "surprise": [] });
                let is_found = !errors(&schema, &other).is_empty();
                verdict.that(format!("{line}, {name} changed"), is_found, || "passes");
            }
            let mut fewer = value.clone();
            fewer
                .as_object_mut()
                .expect("an object")
                .remove(&members[0]);
            verdict.that(
                format!("{line}, fewer"),
                !errors(&schema, &fewer).is_empty(),
                || "passes",
            );
        }
    }
    verdict.close();
}

#[test]
fn a_schema_without_a_subject_is_that_of_scenes() {
    let workspace = Workspace::new();
    let [scene, plain] = ["scene", ""].map(|subject| schema(&workspace, subject));
    assert_eq!(scene, plain);
    assert!(scene["properties"]["objects"].is_object(), "{scene}");
    workspace.run("schema nothing").expect(2);
}
