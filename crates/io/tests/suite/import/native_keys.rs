//! Every key of native scenes counts: set to an odd value it changes the scene, or refuses it. The files in
//! `native_keys` have all keys of the JSON Schema together.

use super::gltf::model::png;
use crate::support::verdict::Verdict;
use glimray::import::{self, Memory, Options};
use glimray::scene::Scene;
use serde_json::Value as Json;
use std::collections::BTreeSet;
use toml::{Table, Value};

const FILES: [(&str, &str); 5] = [
    ("surfaces", include_str!("native_keys/surfaces.toml")),
    ("lights", include_str!("native_keys/lights.toml")),
    ("materials", include_str!("native_keys/materials.toml")),
    ("environment", include_str!("native_keys/environment.toml")),
    ("sky", include_str!("native_keys/sky.toml")),
];

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.25\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n\
    f 1/1 2/2 3/3\nf 3/3 2/2 4/4\n";

/// A square whose corners have one of two materials.
const PAINTED: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property int material\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0 0\n1 0 0 1\n1 1 0 1\n0 1 0 0\n4 0 1 2 3\n";

const POINTS: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n\
    end_header\n0 0 0\n1 2 3\n";

/// Keys without an effect in these files of which nothing is said, and why.
const SILENT: [(&str, &str); 1] = [(
    "materials.coated.pbr.roughness.picture.linear",
    "a picture of roughness holds numbers in any case",
)];

/// The keys and indices that lead to a value.
type Way = Vec<String>;

fn outcome(scene: &Table, picture: &[u8]) -> Result<Scene, String> {
    let text = toml::to_string(scene).expect("TOML");
    let files = Memory::from_iter([
        ("a.toml", text.as_bytes()),
        ("square.obj", SQUARE.as_bytes()),
        ("square.ply", PAINTED.as_bytes()),
        ("points.ply", POINTS.as_bytes()),
        ("p.png", picture),
    ]);
    let scene = import::load_from(&files, "a.toml", &Options::default());
    scene.map_err(|error| error.to_string())
}

fn picture() -> Vec<u8> {
    let texel = |i: u8| [30 * i, 250 - 20 * i, 7 * i, 255 - 9 * i];
    png(4, &[0, 1, 2, 3, 4, 5, 6, 7].map(texel))
}

/// Adds the ways to all values below `value` that are no tables or lists.
fn walk(value: &Value, way: &mut Way, found: &mut Vec<Way>) {
    let parts: Vec<(String, &Value)> = match value {
        Value::Table(members) => members.iter().map(|(key, it)| (key.clone(), it)).collect(),
        Value::Array(parts) => (parts.iter().enumerate())
            .map(|(index, it)| (index.to_string(), it))
            .collect(),
        _ => return found.push(way.clone()),
    };
    for (step, part) in parts {
        way.push(step);
        walk(part, way, found);
        way.pop();
    }
}

fn at<'v>(scene: &'v mut Table, way: &[String]) -> &'v mut Value {
    let (first, rest) = way.split_first().expect("a key");
    let first = scene.get_mut(first).expect("a value");
    rest.iter().fold(first, |value, step| match value {
        Value::Array(parts) => &mut parts[step.parse::<usize>().expect("an index")],
        value => value.get_mut(step).expect("a value"),
    })
}

/// The words of which values may be, in all of the schema.
fn words(schema: &Json, found: &mut BTreeSet<String>) {
    match schema {
        Json::Object(members) => {
            for (key, value) in members {
                match (key.as_str(), value) {
                    ("const", Json::String(word)) => {
                        found.insert(word.clone());
                    }
                    ("enum", Json::Array(all)) => {
                        found.extend(all.iter().filter_map(Json::as_str).map(str::to_owned));
                    }
                    _ => words(value, found),
                }
            }
        }
        Json::Array(parts) => parts.iter().for_each(|part| words(part, found)),
        _ => {}
    }
}

/// Whether the value at `way` counts. All numbers must; of words one that may stand there.
fn counts(
    scene: &Table,
    way: &Way,
    words: &BTreeSet<String>,
    before: &Scene,
    picture: &[u8],
) -> bool {
    let mut changed = scene.clone();
    let value = at(&mut changed, way).clone();
    let mut outcome = |odd: Value| {
        *at(&mut changed, way) = odd;
        outcome(&changed, picture)
    };
    let mut all = |odds: &[Value]| {
        odds.iter()
            .all(|odd| outcome(odd.clone()).as_ref() != Ok(before))
    };
    match &value {
        Value::Boolean(flag) => all(&[Value::Boolean(!flag)]),
        Value::Float(_) => all(&[0.37, -3.5, 1e9].map(Value::Float)),
        Value::Integer(_) => all(&[3, 1_000_000].map(Value::Integer)),
        Value::String(text) if words.contains(text) => {
            let others = words.iter().filter(|word| *word != text);
            let read = others.filter_map(|word| outcome(Value::String(word.clone())).ok());
            let read: Vec<Scene> = read.collect();
            read.is_empty() || read.iter().any(|scene| scene != before)
        }
        Value::String(_) => all(&[Value::String("odd".to_owned())]),
        other => panic!("{way:?}: {other}"),
    }
}

#[test]
fn every_key_of_native_scenes_counts() {
    let mut known = BTreeSet::new();
    words(&import::native_schema(), &mut known);
    let (picture, known) = (picture(), &known);
    let mut verdict = Verdict::on("keys of native scenes");
    let mut needed = BTreeSet::new();
    for (name, text) in FILES {
        let scene: Table = text.parse().expect("TOML");
        let before = outcome(&scene, &picture).unwrap_or_else(|why| panic!("{name}: {why}"));
        assert_eq!(before.skipped, [""; 0], "{name}");
        let mut ways = Vec::new();
        walk(&Value::Table(scene.clone()), &mut Vec::new(), &mut ways);
        let silent = |ways: &[Way]| -> Vec<String> {
            let silent = ways
                .iter()
                .filter(|way| !counts(&scene, way, known, &before, &picture));
            silent.map(|way| way.join(".")).collect()
        };
        let share = ways.len().div_ceil(4);
        let silent: Vec<String> = std::thread::scope(|scope| {
            let jobs: Vec<_> = (ways.chunks(share))
                .map(|ways| scope.spawn(|| silent(ways)))
                .collect();
            let found = jobs.into_iter().map(|job| job.join().expect("no panic"));
            found.flatten().collect()
        });
        for key in silent {
            let is_known = SILENT.iter().any(|(known, _)| *known == key);
            verdict.that(format!("{name}: {key}"), is_known, || {
                "is dropped without a word".to_owned()
            });
            needed.insert(key);
        }
    }
    for (key, why) in SILENT {
        verdict.that(key, needed.contains(key), || {
            format!("is no exception any more: {why}")
        });
    }
    verdict.close();
}

/// Adds what of `schema` is in `value`: the name of each table and a key.
fn find<'s>(
    root: &'s Json,
    (name, schema): (&'s str, &'s Json),
    value: &Value,
    found: &mut BTreeSet<(&'s str, &'s str)>,
) {
    if let Some(target) = schema["$ref"].as_str() {
        let name = target.rsplit('/').next().unwrap_or_default();
        find(root, (name, &root["$defs"][name]), value, found);
    }
    for kind in ["anyOf", "oneOf", "allOf"] {
        for schema in schema[kind].as_array().into_iter().flatten() {
            find(root, (name, schema), value, found);
        }
    }
    match value {
        Value::Table(members) => {
            for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
                if let Some(value) = members.get(key) {
                    found.insert((name, key));
                    find(root, ("", schema), value, found);
                }
            }
            let others = &schema["additionalProperties"];
            if others.is_object() {
                members
                    .values()
                    .for_each(|value| find(root, ("", others), value, found));
            }
        }
        Value::Array(parts) => {
            if schema["items"].is_object() {
                let items = &schema["items"];
                parts
                    .iter()
                    .for_each(|part| find(root, ("", items), part, found));
            }
            let schemas = schema["prefixItems"].as_array().into_iter().flatten();
            for (schema, part) in schemas.zip(parts) {
                find(root, ("", schema), part, found);
            }
        }
        _ => {}
    }
}

#[test]
fn the_files_have_every_key_of_the_schema() {
    let schema = import::native_schema();
    let mut found = BTreeSet::new();
    for (_, text) in FILES {
        let scene: Table = text.parse().expect("TOML");
        find(
            &schema,
            ("scene", &schema),
            &Value::Table(scene),
            &mut found,
        );
    }
    let tables = schema["$defs"].as_object().expect("definitions").iter();
    let tables = tables.map(|(name, table)| (name.as_str(), table));
    let keys: Vec<(&str, &str)> = (tables.chain([("scene", &schema)]))
        .flat_map(|(name, table)| {
            let keys = table["properties"].as_object().into_iter().flatten();
            keys.map(move |(key, _)| (name, key.as_str()))
        })
        .collect();
    assert!(keys.len() > 300, "{}", keys.len());
    let lacking: Vec<_> = keys.iter().filter(|key| !found.contains(*key)).collect();
    assert!(lacking.is_empty(), "{lacking:?}");
}
