//! Compressed geometry: models that encoders of other projects wrote (tests/encoded/make.py), all of one torus.

use super::super::{folder, load};
use glam::{DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{Mesh, Scene};
use std::f64::consts::TAU;
use std::time::Instant;

const EXT: &[u8] = include_bytes!("../../../../../../tests/encoded/meshopt_ext.glb");
const KHR: &[u8] = include_bytes!("../../../../../../tests/encoded/meshopt_khr.glb");
const DRACO: &[u8] = include_bytes!("../../../../../../tests/encoded/draco.glb");
const DRACO_SEQUENTIAL: &[u8] =
    include_bytes!("../../../../../../tests/encoded/draco_sequential.glb");
const ALL: [(&str, &[u8]); 4] = [
    ("EXT_meshopt_compression", EXT),
    ("KHR_meshopt_compression", KHR),
    ("Draco", DRACO),
    ("sequential Draco", DRACO_SEQUENTIAL),
];

fn scene(bytes: &[u8]) -> Scene {
    load("a.glb", bytes).unwrap_or_else(|error| panic!("{error}"))
}

/// The point and the normal of the torus at (u, v).
fn torus(u: f64, v: f64) -> (DVec3, DVec3) {
    let ((sin_a, cos_a), (sin_b, cos_b)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
    let normal = DVec3::new(cos_b * cos_a, sin_b, cos_b * sin_a);
    (2.0 * DVec3::new(cos_a, 0.0, sin_a) + 0.75 * normal, normal)
}

/// u and v of the vertex of the torus next to `p`, in steps of 1/24 and 1/16.
fn place(p: DVec3) -> (f64, f64) {
    let u = p.z.atan2(p.x) / TAU;
    let v = p.y.atan2(p.x.hypot(p.z) - 2.0) / TAU;
    ((u * 24.0).round() / 24.0, (v * 16.0).round() / 16.0)
}

/// Checks that `mesh`, scaled by `scale`, is the torus: its vertices within `off`, its normals within `turned`.
fn check(name: &str, mesh: &Mesh, scale: f64, off: f64, turned: f64) {
    assert_eq!(mesh.triangles.len(), 24 * 16 * 2, "{name}");
    let normal_at = |i: usize| mesh.normals[i].as_dvec3();
    for (i, p) in mesh.positions.iter().enumerate() {
        let p = scale * p.as_dvec3();
        let (u, v) = place(p);
        let (expected, normal) = torus(u, v);
        let far = p.distance(expected);
        assert!(far <= off, "{name}: vertex {i} is {far} from {expected}");
        let far = normal_at(i).distance(normal);
        assert!(far <= turned, "{name}: normal {i} is {far} from {normal}");
        if let Some(uv) = mesh.uvs.get(i) {
            // Both ends of a period are the same place. v of a scene points up.
            let apart = |a: f64, b: f64| (a - b - (a - b).round()).abs();
            let far = apart(uv.x.into(), u).max(apart(1.0 - f64::from(uv.y), v));
            assert!(
                far < 1e-3,
                "{name}: {uv} at vertex {i} is {far} from {u}, {v}"
            );
        }
    }
    // Each quadrilateral of the surface is covered by two triangles.
    let mut halves = std::collections::HashMap::new();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| scale * mesh.positions[i as usize].as_dvec3());
        let flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let outwards: DVec3 = triangle.iter().map(|&i| normal_at(i as usize)).sum();
        assert!(
            flat.dot(outwards) > 0.0,
            "{name}: {corners:?} faces inwards"
        );
        let (u, v) = place_of(corners);
        *halves.entry((u, v)).or_insert(0) += 1;
    }
    assert!(
        halves.len() == 24 * 16 && halves.values().all(|&n| n == 2),
        "{name}"
    );
}

/// The quadrilateral of three of its corners, by number.
fn place_of(corners: [DVec3; 3]) -> (i64, i64) {
    let first = |numbers: [i64; 3], count: i64| {
        let numbers = numbers.map(|n| n.rem_euclid(count));
        let (least, most) = (numbers.iter().min(), numbers.iter().max());
        match (least, most) {
            (Some(0), Some(&most)) if most > 1 => most,
            (Some(&least), _) => least,
            _ => 0,
        }
    };
    let places = corners.map(place);
    (
        first(places.map(|(u, _)| (u * 24.0).round() as i64), 24),
        first(places.map(|(_, v)| (v * 16.0).round() as i64), 16),
    )
}

#[test]
fn compressed_models_are_what_was_encoded() {
    let mesh = |bytes| scene(bytes).meshes[0].clone();
    // Octahedral normals of 8 bits turn by less than 0.02; positions are not changed.
    check("EXT", &mesh(EXT), 1.0, 1e-6, 0.02);
    // Steps of 8/65535 along each axis, and normals of 12 bits. The importer keeps [0, 1].
    let khr = scene(KHR);
    let mut moved = (*khr.meshes[0]).clone();
    for p in &mut moved.positions {
        *p -= Vec3::splat(0.5);
    }
    check("KHR", &moved, 8.0, 8.0 / 65535.0, 0.002);
    // The largest side is 5.5, in 2¹⁴ steps.
    for bytes in [DRACO, DRACO_SEQUENTIAL] {
        check("Draco", &mesh(bytes), 1.0, 5.5 / 16384.0, 0.01);
    }
}

#[test]
fn filtered_quaternions_exponents_and_colors_keep_their_values() {
    let scene = scene(KHR);
    let placements: Vec<_> = scene.instances.iter().map(|it| it.placement).collect();
    assert_eq!(placements.len(), 2);
    let expected = [
        (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.1, -0.3, 0.2)),
        (DVec3::new(-4.5, 0.125, 1000.0), DVec3::new(-0.1, 0.3, 0.2)),
    ];
    // A quarter turn around x takes (x, y, z) to (x, −z, y); a half turn around y + z takes it to (−x, z, y).
    for (placement, (translation, turned)) in placements.iter().zip(expected) {
        let off = placement.translation - translation;
        assert!(
            off.abs().max_element() < 1e-3 * translation.length(),
            "{off}"
        );
        let vector = placement.transform_vector3(DVec3::new(0.1, 0.2, 0.3));
        assert!(vector.distance(turned) < 1e-4, "{vector}, not {turned}");
    }
    let color = scene.meshes[0].colors[0].truncate();
    let white = color / color.x;
    assert!(white.distance(Vec3::new(1.0, 0.5, 0.25)) < 0.02, "{color}");
}

#[test]
fn compressed_data_that_were_cut_or_changed_are_refused_or_read_without_a_panic() {
    let mut random = crate::support::random::Random::new(11);
    let folder = folder(&[]);
    let path = folder.path().join("a.glb");
    for (name, whole) in ALL {
        let text_len = u32::from_le_bytes(whole[12..16].try_into().expect("four")) as usize;
        let body = 28 + text_len..whole.len();
        for round in 0..100 {
            let mut bad = whole.to_vec();
            for _ in 0..1 + random.below(4) {
                // Mostly the compressed bytes; sometimes the JSON.
                let range = if round % 8 == 0 {
                    20..body.start
                } else {
                    body.clone()
                };
                let at = range.start + random.below(range.len());
                bad[at] = [0, 1, 0x7f, 0x80, 0xff, random.below(256) as u8][random.below(6)];
            }
            std::fs::write(&path, &bad).expect("a file");
            let started = Instant::now();
            if let Err(error) = import::load_with(&path, &Options::default()) {
                assert_eq!(error.to_string().lines().count(), 1, "{error}");
            }
            let seconds = started.elapsed().as_secs_f64();
            assert!(seconds < 2.0, "{name}: {seconds} s");
        }
    }
}

/// The error or notes of `model` with `from` replaced by `to` in its JSON; both have the same length.
fn changed(model: &[u8], from: &str, to: &str) -> String {
    assert_eq!(from.len(), to.len());
    let at = model
        .windows(from.len())
        .position(|it| it == from.as_bytes());
    let at = at.unwrap_or_else(|| panic!("{from} is not in the model"));
    let mut bad = model.to_vec();
    bad[at..at + to.len()].copy_from_slice(to.as_bytes());
    match load("a.glb", bad) {
        Ok(scene) => scene.skipped.join("; "),
        Err(error) => error.to_string(),
    }
}

#[test]
fn counts_that_the_bytes_cannot_hold_are_refused_before_anything_is_decoded() {
    for (model, from, to, why) in [
        (
            EXT,
            r#""byteStride":12,"count":425"#,
            r#""byteStride":12,"count":9e9"#,
            "",
        ),
        (
            KHR,
            r#""byteStride":4,"count":2304"#,
            r#""byteStride":4,"count":9999"#,
            "cannot hold 9999 elements",
        ),
        (
            EXT,
            r#""mode":"TRIANGLES""#,
            r#""mode":"TRIANGELS""#,
            "is unknown",
        ),
        (
            EXT,
            r#""filter":"OCTAHEDRAL""#,
            r#""filter":"QUATERNION""#,
            "does not suit",
        ),
        (
            DRACO,
            r#""TEXCOORD_0":0}}}"#,
            r#""TEXCOORD_0":7}}}"#,
            "attribute 7 is missing",
        ),
    ] {
        let error = changed(model, from, to);
        assert!(error.contains(why) && error.lines().count() == 1, "{error}");
    }
}

#[test]
fn zeros_that_compress_to_nothing_are_limited() {
    // Version 1 may say of each block of attributes that all its bytes are as before.
    const COUNT: usize = 64 << 20;
    let mut stream = vec![0xa1];
    let blocks = COUNT / 256;
    stream.extend(std::iter::repeat_n([0xaa; 3], blocks).flatten());
    stream.extend([0; 24]);
    let mut model = super::model::Model::triangle(serde_json::json!({}));
    let view = model.view(&stream);
    let position = model.json["bufferViews"][view].clone();
    model.json["bufferViews"][view] = serde_json::json!({
        "buffer": 0, "byteLength": 12 * COUNT,
        "extensions": { "KHR_meshopt_compression": {
            "buffer": 0, "byteOffset": position["byteOffset"], "byteLength": stream.len(),
            "byteStride": 12, "count": COUNT, "mode": "ATTRIBUTES",
        } },
    });
    let started = Instant::now();
    let error = load("a.glb", model.glb()).expect_err("refused");
    assert!(error.is_too_big(), "{error}");
    assert!(error.to_string().contains("compressed data"), "{error}");
    assert!(started.elapsed().as_secs_f64() < 2.0);
}
