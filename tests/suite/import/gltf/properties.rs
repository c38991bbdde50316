//! Every property that a model has is honoured or reported: set to an odd value, one after the other, each changes the
//! scene, or its notes, or refuses the model, unless `inspect` says by name that it has no effect.

mod everything;

use super::model::{Model, base64, png};
use crate::support::program::Workspace;
use crate::support::verdict::Verdict;
use everything::everything;
use glimray::import::{self, Memory, Options, Staging, gltf_properties};
use glimray::scene::Scene;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Properties without an effect in these models of which nothing is said, and why.
const SILENT: [(&str, &str); 2] = [
    (
        "extensions.KHR_lights_punctual.lights[].name",
        "messages about the light have it",
    ),
    ("images[].name", "messages about the image have it"),
];

/// A way from the root of the JSON to a value.
type Way = Vec<Step>;

#[derive(Clone, Debug, PartialEq)]
enum Step {
    Key(String),
    At(usize),
}

/// A way as messages write it: `nodes[0].name`, or `nodes[].name` as a pattern.
fn written(way: &[Step], is_pattern: bool) -> String {
    let mut text = String::new();
    for step in way {
        match step {
            Step::Key(key) if text.is_empty() => text += key,
            Step::Key(key) => text += &format!(".{key}"),
            Step::At(_) if is_pattern => text += "[]",
            Step::At(index) => text += &format!("[{index}]"),
        }
    }
    text
}

/// Calls `visit` for each value below `value`, itself first.
fn walk<'v>(value: &'v Value, way: &mut Way, visit: &mut dyn FnMut(&Way, &'v Value)) {
    visit(way, value);
    match value {
        Value::Object(members) => {
            for (key, value) in members {
                way.push(Step::Key(key.clone()));
                walk(value, way, visit);
                way.pop();
            }
        }
        Value::Array(parts) => {
            for (index, value) in parts.iter().enumerate() {
                way.push(Step::At(index));
                walk(value, way, visit);
                way.pop();
            }
        }
        _ => {}
    }
}

fn at<'v>(json: &'v mut Value, way: &Way) -> &'v mut Value {
    way.iter().fold(json, |value, step| match step {
        Step::Key(key) => &mut value[key],
        Step::At(index) => &mut value[index],
    })
}

/// Words of which a property must be one: an odd value is the other.
const WORDS: [[&str; 2]; 13] = [
    ["LINEAR", "STEP"],
    ["CUBICSPLINE", "LINEAR"],
    ["SCALAR", "VEC3"],
    ["VEC2", "VEC3"],
    ["VEC4", "VEC2"],
    ["MAT4", "VEC4"],
    ["MASK", "BLEND"],
    ["perspective", "orthographic"],
    ["point", "directional"],
    ["spot", "point"],
    ["ATTRIBUTES", "INDICES"],
    ["TRIANGLES", "ATTRIBUTES"],
    ["OCTAHEDRAL", "EXPONENTIAL"],
];

/// Values of the same type as `value` that it would hardly have.
fn odd(value: &Value) -> Vec<Value> {
    match value {
        Value::Bool(flag) => vec![json!(!flag)],
        Value::Number(number) if number.is_f64() => vec![json!(0.37), json!(-3.5), json!(1e9)],
        Value::Number(_) => vec![json!(7), json!(1_000_000)],
        Value::String(text) => {
            let word = WORDS.iter().flatten().position(|word| word == text);
            let other = word.map(|at| WORDS.as_flattened()[at ^ 1]);
            vec![json!(other.unwrap_or("odd"))]
        }
        _ => Vec::new(),
    }
}

fn outcome(model: &Model, options: &Options) -> Result<Scene, String> {
    let files = Memory::from_iter([("a.glb", &model.glb()[..])]);
    import::load_from(&files, "a.glb", options).map_err(|error| error.to_string())
}

/// Whether a sentence of an import names the property at `way`, or one that it is a part of.
fn is_named(scene: &Scene, way: &Way) -> bool {
    let keys = (2..=way.len()).filter(|&end| matches!(way[end - 1], Step::Key(_)));
    let mut names: BTreeSet<String> = keys
        .flat_map(|end| [false, true].map(|is_pattern| written(&way[..end], is_pattern)))
        .collect();
    if way.contains(&Step::Key("extras".to_owned())) {
        names.insert("extras".to_owned());
    }
    let has_name = |sentence: &String| {
        let words = sentence.split([' ', ',', ':']);
        // The first of several is named.
        let stands_for_several = sentence.contains(" times)");
        words.into_iter().any(|word| {
            names.contains(word) || stands_for_several && names.contains(&pattern_of(word))
        })
    };
    scene.remarks.iter().chain(&scene.skipped).any(has_name)
}

/// `word` without the numbers in brackets.
fn pattern_of(word: &str) -> String {
    let mut parts = word.split('[');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        let rest = part.split_once(']').map_or("", |(_, rest)| rest);
        text + "[]" + rest
    })
}

/// The model in a GLB.
fn parsed(glb: &[u8]) -> Model {
    let word =
        |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("four bytes")) as usize;
    let end = 20 + word(12);
    Model {
        json: serde_json::from_slice(&glb[20..end]).expect("JSON"),
        bin: glb[end + 8..].to_vec(),
    }
}

/// The torus of a file in `tests/encoded` with a map, so that its texture coordinates count.
fn torus(glb: &[u8]) -> Model {
    let mut model = parsed(glb);
    let uri = format!(
        "data:image/png;base64,{}",
        base64(&png(1, &[[9, 8, 7, 255]]))
    );
    model.push("images", json!({ "uri": uri }));
    model.push("textures", json!({ "source": 0 }));
    let map = json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } });
    model.push("materials", map);
    model.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    model
}

/// Models that have every property together, by name.
fn models() -> [(&'static str, Model); 4] {
    [
        ("everything", everything()),
        ("draco", torus(include_bytes!("../../../encoded/draco.glb"))),
        (
            "meshopt_ext",
            torus(include_bytes!("../../../encoded/meshopt_ext.glb")),
        ),
        (
            "meshopt_khr",
            torus(include_bytes!("../../../encoded/meshopt_khr.glb")),
        ),
    ]
}

/// The ways to read a model: as it is, and with everything that can be chosen by name.
fn choices() -> [Options; 3] {
    let plain = Options {
        staging: Staging::NONE,
        ..Options::default()
    };
    let chosen = |variant: &str| Options {
        scene: Some("main".to_owned()),
        variant: Some(variant.to_owned()),
        ..plain.clone()
    };
    [chosen("first"), chosen("second"), plain]
}

/// The properties of `model` that do nothing: the pattern of each, and a place.
fn silent(model: &Model) -> Vec<(String, String)> {
    let choices = choices();
    let plain: Vec<(Scene, &Options)> = choices
        .iter()
        .filter_map(|options| Some((outcome(model, options).ok()?, options)))
        .collect();
    assert!(!plain.is_empty(), "{:?}", outcome(model, &choices[2]));
    let mut ways = Vec::new();
    walk(&model.json, &mut Vec::new(), &mut |way, value| {
        if !odd(value).is_empty() {
            ways.push(way.clone());
        }
    });
    let counts = |way: &Way| {
        let mut changed = model.clone();
        let value = at(&mut changed.json, way).clone();
        odd(&value).into_iter().any(|odd| {
            *at(&mut changed.json, way) = odd;
            plain.iter().any(|(before, options)| {
                is_named(before, way) || outcome(&changed, options).as_ref() != Ok(before)
            })
        })
    };
    let share = ways.len().div_ceil(4).max(1);
    let found: Vec<Way> = std::thread::scope(|scope| {
        let jobs: Vec<_> = (ways.chunks(share))
            .map(|ways| {
                let silent = move || ways.iter().filter(|way| !counts(way)).cloned().collect();
                scope.spawn::<_, Vec<Way>>(silent)
            })
            .collect();
        let found = jobs.into_iter().map(|job| job.join().expect("no panic"));
        found.flatten().collect()
    });
    let named = |way: &Way| (written(way, true), written(way, false));
    found.iter().map(named).collect()
}

#[test]
fn every_property_of_models_counts_or_is_named() {
    let mut verdict = Verdict::on("properties");
    let mut needed = BTreeSet::new();
    for (name, model) in models() {
        let mut lost: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (pattern, place) in silent(&model) {
            lost.entry(pattern).or_default().push(place);
        }
        for (pattern, places) in lost {
            let is_known = SILENT.iter().any(|(known, _)| *known == pattern);
            verdict.that(format!("{name}: {pattern}"), is_known, || {
                format!("{places:?} is dropped without a word")
            });
            needed.insert(pattern);
        }
    }
    for (pattern, why) in SILENT {
        verdict.that(pattern, needed.contains(pattern), || {
            format!("is no exception any more: {why}")
        });
    }
    verdict.close();
}

#[test]
fn the_models_have_every_property_that_is_known() {
    let mut there = BTreeSet::new();
    for (_, model) in models() {
        walk(&model.json, &mut Vec::new(), &mut |way, _| {
            there.insert(written(way, true));
        });
    }
    let known = gltf_properties();
    assert!(known.len() > 200, "{}", known.len());
    let lacking: Vec<_> = known.iter().filter(|it| !there.contains(*it)).collect();
    assert!(lacking.is_empty(), "{lacking:#?}");
}

#[test]
fn inspect_tells_all_that_is_not_used_of_a_model_with_every_property() {
    let workspace = Workspace::new();
    workspace.write("a.glb", everything().glb());
    let scene = outcome(&everything(), &Options::default()).expect("a scene");
    assert_eq!(
        scene.skipped,
        [
            "materials[1].extensions.KHR_materials_pbrSpecularGlossiness.specularGlossinessTexture is not shown"
        ]
    );
    let run = workspace.run("inspect a.glb --json").expect(0);
    let told = run.json();
    assert_eq!(told["remarks"], json!(scene.remarks));
    assert_eq!(told["skipped"], json!(scene.skipped));
}
