//! Groups and copies of the native format: their placement, and errors.

use super::{folder, load, message_in, messages, scene};
use crate::support::effort;
use glam::{DAffine3, DVec3};
use glimray::import::{self, Options};
use glimray::scene::{CanonicalShape, Geometry, Scene};
use insta::assert_snapshot;
use std::f64::consts::TAU;

const BALL: &str = "sphere = { center = [0, 0, 0], radius = 1 }";

fn centers(scene: &Scene) -> Vec<DVec3> {
    let center = |geometry: &Geometry| match *geometry {
        Geometry::Sphere { center, .. } => center,
        Geometry::Placed {
            world_from_canonical,
            ..
        } => world_from_canonical.translation,
        Geometry::Plane { point, .. } => point,
    };
    scene
        .shapes
        .iter()
        .map(|shape| center(&shape.geometry))
        .collect()
}

fn assert_at(scene: &Scene, expected: &[DVec3]) {
    let found = centers(scene);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            found.distance(*expected) < 1e-12,
            "{found} is not {expected}"
        );
    }
}

#[test]
fn a_group_is_placed_with_all_its_objects_and_groups() {
    let text = format!(
        "
        [[groups.pair]]
        {BALL}
        [[groups.pair]]
        {BALL}
        transform = {{ translate = [1, 0, 0], scale = 0.5 }}
        [[groups.row]]
        group = 'pair'
        [[groups.row]]
        group = 'pair'
        transform = {{ translate = [0, 0, 10], rotate_deg = [0, 90, 0] }}
        [[objects]]
        group = 'row'
        transform = {{ scale = 2, translate = [100, 0, 0] }}"
    );
    let scene = scene("a.toml", text);
    let expected = [
        [100.0, 0.0, 0.0],
        [102.0, 0.0, 0.0],
        [100.0, 0.0, 20.0],
        [100.0, 0.0, 18.0],
    ];
    assert_at(&scene, &expected.map(DVec3::from));
    let radii = scene.shapes.iter().map(|shape| match shape.geometry {
        Geometry::Sphere { radius, .. } => radius,
        _ => panic!("a sphere"),
    });
    assert!(
        radii
            .zip([2.0, 1.0, 2.0, 1.0])
            .all(|(a, b)| (a - b).abs() < 1e-12)
    );
    assert!(scene.nodes.is_empty(), "what stands still needs no node");
    assert_eq!(scene.materials.len(), 1);
}

/// The axes of the ball are nearly parallel, but their matrix has an inverse.
#[test]
fn turned_objects_may_be_scaled_very_unevenly() {
    let text = format!(
        "[[groups.a]]\n{BALL}\ntransform = {{ rotate_deg = [40, 30, 20] }}\n\
         [[objects]]\ngroup = 'a'\ntransform = {{ scale = [0.01, 0.01, 1e6] }}"
    );
    let (low, high) = scene("a.toml", text).bounds().expect("a ball");
    assert!(
        (high - DVec3::new(0.01, 0.01, 1e6))
            .abs()
            .cmple(DVec3::new(1e-6, 1e-6, 1.0))
            .all(),
        "{high}"
    );
    assert!((high + low).abs().max_element() < 1.0, "{low} to {high}");
}

#[test]
fn copies_of_a_grid_are_a_step_apart() {
    let grid = |rest: &str| {
        let repeat = format!("{{ grid = {{ count = [3, 2, 2], step = [2, 5, -1]{rest} }} }}");
        scene(
            "a.toml",
            format!(
                "[[objects]]\n{BALL}\ntransform = {{ translate = [0, 7, 0] }}\nrepeat = {repeat}"
            ),
        )
    };
    let mut expected = Vec::new();
    for z in 0..2 {
        for y in 0..2 {
            for x in 0..3 {
                let at = [2.0 * f64::from(x), 7.0 + 5.0 * f64::from(y), -f64::from(z)];
                expected.push(DVec3::from(at));
            }
        }
    }
    assert_at(&grid(""), &expected);
    let middle = DVec3::new(2.0, 2.5, -0.5);
    let centered: Vec<_> = expected.iter().map(|&p| p - middle).collect();
    assert_at(&grid(", centered = true"), &centered);
}

#[test]
fn copies_of_a_ring_are_counter_clockwise_about_its_axis() {
    let ring = |ring: &str| {
        scene(
            "a.toml",
            format!("[[objects]]\n{BALL}\nrepeat = {{ ring = {{ {ring} }} }}"),
        )
    };
    // Seen from +y, x turns to -z; from +z, x turns to y; from +x, -y turns to -z.
    let round = |x: DVec3, y: DVec3, turn: f64| 3.0 * (x * turn.cos() + y * turn.sin());
    let five = |x, y| {
        (0..5)
            .map(|i| round(x, y, f64::from(i) * TAU / 5.0))
            .collect::<Vec<_>>()
    };
    assert_at(
        &ring("count = 5, radius = 3"),
        &five(DVec3::X, DVec3::NEG_Z),
    );
    let z = ring("count = 5, radius = 3, axis = [0, 0, 2]");
    assert_at(&z, &five(DVec3::X, DVec3::Y));
    let x = ring("count = 5, radius = 3, axis = [2, 0, 0]");
    assert_at(&x, &five(DVec3::NEG_Y, DVec3::NEG_Z));
    // From 90 to 180 degrees, both ends included.
    let arc = ring("count = 3, radius = 3, start_deg = 90, arc_deg = 90");
    let arced = [0.25, 0.375, 0.5].map(|turn| round(DVec3::X, DVec3::NEG_Z, turn * TAU));
    assert_at(&arc, &arced);
    let alone = ring("count = 1, radius = 3, arc_deg = 90");
    assert_at(&alone, &[DVec3::new(3.0, 0.0, 0.0)]);
}

#[test]
fn a_ring_turns_its_copies_by_default() {
    let sticks = |rest: &str| {
        let text = format!(
            "[[objects]]
            box = {{ min = [0, 0, 0], max = [2, 1, 1] }}
            transform = {{ translate = [4, 0, 0] }}
            repeat = {{ ring = {{ count = 4, axis = [0, 1, 0]{rest} }} }}"
        );
        let scene = scene("a.toml", text);
        let axes = scene.shapes.iter().map(|shape| match shape.geometry {
            Geometry::Placed {
                canonical: CanonicalShape::Box,
                world_from_canonical,
            } => world_from_canonical,
            _ => panic!("a box"),
        });
        axes.collect::<Vec<DAffine3>>()
    };
    let directions = [DVec3::X, DVec3::NEG_Z, DVec3::NEG_X, DVec3::Z];
    for (stick, direction) in sticks("").iter().zip(directions) {
        assert!(stick.matrix3.x_axis.distance(direction) < 1e-12);
        let (out, up, side) = (5.0 * direction, DVec3::Y, 0.5 * direction.cross(DVec3::Y));
        assert!(stick.translation.distance(out + 0.5 * up + side) < 1e-12);
    }
    for (stick, direction) in sticks(", radius = 3, turned = false")
        .iter()
        .zip(directions)
    {
        assert_eq!(stick.matrix3.x_axis, DVec3::X);
        let at = DVec3::new(5.0, 0.5, 0.5) + 3.0 * direction;
        assert!(stick.translation.distance(at) < 1e-12);
    }
}

fn scattered(count: usize, seed: u32) -> Vec<DAffine3> {
    let text = format!(
        "[[objects]]
        box = {{ min = [-1, -1, -1], max = [1, 1, 1] }}
        repeat = {{ scatter = {{ count = {count}, seed = {seed}, min = [-2, 5, 0], max = [2, 5, 30], turn_deg = [0, 60, 0], scale = [0.5, 2] }} }}"
    );
    let scene = scene("a.toml", text);
    let axes = scene.shapes.iter().map(|shape| match shape.geometry {
        Geometry::Placed {
            world_from_canonical,
            ..
        } => world_from_canonical,
        _ => panic!("a box"),
    });
    axes.collect()
}

#[test]
fn scattered_copies_fill_their_box_evenly_and_the_same_every_time() {
    let copies = scattered(4000, 3);
    assert_eq!(copies, scattered(4000, 3));
    assert_eq!(copies[..100], scattered(100, 3), "more copies move none");
    assert_ne!(copies[0], scattered(1, 4)[0]);

    // A uniform distribution over [0, 1] has the mean 1/2 and the variance 1/12; the mean of n samples is within
    // five of its standard deviations.
    let evenly = |what: &str, values: Vec<f64>| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count;
        assert!(values.iter().all(|x| (0.0..=1.0).contains(x)), "{what}");
        assert!(
            (mean - 0.5).abs() < 5.0 / (12.0 * count).sqrt(),
            "{what}: {mean}"
        );
        assert!((variance * 12.0 - 1.0).abs() < 0.1, "{what}: {variance}");
    };
    let each = |of: fn(&DAffine3) -> f64| copies.iter().map(of).collect::<Vec<_>>();
    evenly("x", each(|copy| (copy.translation.x + 2.0) / 4.0));
    evenly("z", each(|copy| copy.translation.z / 30.0));
    evenly(
        "scale",
        each(|copy| (copy.matrix3.y_axis.length() - 0.5) / 1.5),
    );
    let turn = |copy: &DAffine3| {
        let x = copy.matrix3.x_axis;
        ((-x.z).atan2(x.x).to_degrees() + 60.0) / 120.0
    };
    evenly("turn", each(turn));
    assert!(copies.iter().all(|copy| copy.translation.y == 5.0));
    // Consecutive copies are uncorrelated too.
    let x = each(|copy| copy.translation.x / 2.0);
    let product = x.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / x.len() as f64;
    assert!(
        product.abs() < 5.0 / 3.0 / (x.len() as f64).sqrt(),
        "{product}"
    );
}

#[test]
fn a_mesh_that_is_placed_often_is_in_memory_once() {
    let model: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let native = b"
        [[groups.tree]]
        mesh = { file = 'm.obj' }
        [[groups.tree]]
        mesh = { file = './m.obj' }
        transform = { translate = [0, 1, 0] }
        [[objects]]
        group = 'tree'
        repeat = { grid = { count = [10, 1, 10], step = [2, 0, 2] } }
        [[objects]]
        group = 'tree'";
    let folder = folder(&[("a.toml", native), ("m.obj", model)]);
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 202));
    assert_eq!(
        scene.instances[199].placement.translation,
        DVec3::new(18.0, 1.0, 18.0)
    );
    assert_eq!((scene.materials.len(), scene.triangle_count()), (1, 202));
}

#[test]
fn a_material_inside_an_object_is_made_once_for_all_copies() {
    let text = format!(
        "[[objects]]
        {BALL}
        material = {{ phong = {{ diffuse = {{ noise = {{}} }} }} }}
        repeat = {{ grid = {{ count = [9, 9, 9], step = [3, 3, 3] }} }}"
    );
    let scene = scene("a.toml", text);
    assert_eq!(scene.shapes.len(), 729);
    assert_eq!((scene.materials.len(), scene.textures.len()), (1, 1));
}

#[test]
fn hidden_objects_and_groups_are_skipped() {
    let text = format!(
        "[[groups.pair]]
        {BALL}
        [[groups.pair]]
        {BALL}
        visible = false
        [[objects]]
        group = 'pair'
        transform = {{ translate = [5, 0, 0] }}
        [[objects]]
        group = 'pair'
        visible = false
        repeat = {{ grid = {{ count = [1000000, 1000000, 1000000], step = [1, 1, 1] }} }}"
    );
    assert_at(&scene("a.toml", text), &[DVec3::new(5.0, 0.0, 0.0)]);
}

#[test]
fn a_sphere_in_a_sheared_group_is_an_ellipsoid() {
    let text = format!(
        "[[groups.a]]
        {BALL}
        transform = {{ rotate_deg = [0, 0, 45] }}
        [[objects]]
        group = 'a'
        transform = {{ scale = [3, 1, 1] }}"
    );
    let scene = scene("a.toml", text);
    let Geometry::Placed {
        canonical: CanonicalShape::Ellipsoid,
        world_from_canonical,
    } = scene.shapes[0].geometry
    else {
        panic!("an ellipsoid");
    };
    // Both turned axes get the same length, but are no longer perpendicular.
    let far = world_from_canonical.transform_point3(DVec3::new(1.0, -1.0, 0.0).normalize());
    assert!(far.distance(DVec3::new(3.0, 0.0, 0.0)) < 1e-12, "{far}");
}

/// Ten nested groups, each placed a hundred times by the next, with `inside` in the innermost.
fn nested(levels: usize, inside: &str) -> String {
    let mut text = format!("[[objects]]\ngroup = 'g0'\n[[groups.g{levels}]]\n{inside}\n");
    for level in 0..levels {
        text += &format!(
            "[[groups.g{level}]]\ngroup = 'g{}'\nrepeat = {{ grid = {{ count = [10, 1, 1], step = [1, 1, 1] }} }}\n",
            level + 1
        );
    }
    text
}

#[test]
fn too_many_copies_are_counted_and_refused_before_any_is_made() {
    let texts = [
        nested(10, BALL),
        nested(60, BALL),
        nested(10, "group = 'empty'\n[groups]\nempty = []"),
        format!("[[objects]]\n{BALL}\nrepeat = {{ ring = {{ count = 1048576 }} }}"),
    ];
    for text in &texts {
        let error = effort::within(1000.0, || load("a.toml", text).expect_err("too many"));
        assert!(error.is_too_big(), "{error}");
    }
    assert_snapshot!(messages("a.toml", &texts), @r#"
bad scene (a.toml:2:9): the scene has 10000000000 objects, counting all copies, but at most 1048575 are allowed. Repeat fewer of them.
bad scene (a.toml:2:9): the scene has more than 1e38 objects, counting all copies, but at most 1048575 are allowed. Repeat fewer of them.
bad scene (a.toml:2:9): the scene has 21111111111 groups, counting all copies, but at most 1048575 are allowed. Repeat fewer of them.
bad scene (a.toml:3:10): the scene has 1048576 objects, counting all copies, but at most 1048575 are allowed. Repeat fewer of them.
"#);
    let most =
        format!("[[objects]]\n{BALL}\nrepeat = {{ ring = {{ count = 1048575, radius = 9 }} }}");
    assert_eq!(scene("a.toml", most).shapes.len(), 1_048_575);
}

#[test]
fn deep_and_wide_groups_are_counted_quickly() {
    let chain: String = (0..30_000)
        .map(|i| format!("[[groups.g{i:05}]]\ngroup = 'g{:05}'\n", i + 1))
        .collect();
    let last = format!("[[groups.g30000]]\n{BALL}\n");
    // Every group places all those after it: from the first to the last there are 2^58 paths.
    let wide: String = (0..60)
        .flat_map(|i| (i + 1..60).map(move |j| format!("[[groups.g{i:02}]]\ngroup = 'g{j:02}'\n")))
        .collect();
    let wide = format!("{wide}[[groups.g59]]\n{BALL}\n[[objects]]\ngroup = 'g00'\n");
    let folder = folder(&[
        ("a.toml", (chain + &last).as_bytes()),
        ("b.toml", wide.as_bytes()),
    ]);
    let soon = |name| effort::within(2000.0, || message_in(&folder, name, &Options::default()));
    assert_snapshot!(soon("a.toml"), @r#"bad scene (a.toml:128:9): groups are nested more than 64 deep. Reduce the nesting."#);
    assert_snapshot!(soon("b.toml"), @"bad scene (b.toml:3544:9): the scene has 288230376151711744 objects, counting all copies, but at most 1048575 are allowed. Repeat fewer of them.");
}

#[test]
fn every_invalid_group_or_copy_has_a_message() {
    let object = |rest: &str| format!("[[objects]]\n{BALL}\n{rest}");
    let tiny = "1e-30";
    let texts = [
        "[[objects]]\ngroup = 'wheel'".to_owned(),
        format!("[[groups.wheel]]\n{BALL}\n[[objects]]\ngroup = 'wheels'"),
        "[[groups.a]]\ngroup = 'a'".to_owned(),
        "[[groups.a]]\ngroup = 'b'\n[[groups.b]]\ngroup = 'c'\n[[groups.c]]\ngroup = 'b'"
            .to_owned(),
        "[[groups.a]]\nname = 'x'".to_owned(),
        "[groups.a]\nobjects = []".to_owned(),
        object("group = 'a'\n[groups]\na = []"),
        "[groups]\na = []\n[materials.m]\n[[objects]]\ngroup = 'a'\nmaterial = 'm'".to_owned(),
        object(&format!("name = 'x'\n[[groups.a]]\n{BALL}\nname = 'x'")),
        object("repeat = {}"),
        object("repeat = { grid = { count = [2, 2, 2], step = [1, 1, 1] }, ring = { count = 2 } }"),
        object("repeat = { grid = { count = [2, 0, 2], step = [1, 1, 1] } }"),
        object("repeat = { grid = { count = [2, 2], step = [1, 1, 1] } }"),
        object("repeat = { grid = { count = 3, step = [1, 1, 1] } }"),
        object("repeat = { ring = { count = 2.5 } }"),
        object("repeat = { ring = { count = -1 } }"),
        object("repeat = { ring = { count = 2000000000 } }"),
        object("repeat = { ring = { count = 3, radius = -1 } }"),
        object("repeat = { ring = { count = 3, axis = [0, 0, 0] } }"),
        object("repeat = { ring = { radius = 3 } }"),
        object("repeat = { scatter = { count = 3, min = [0, 0, 0], max = [1, -1, 1] } }"),
        object("repeat = { scatter = { count = 3, seed = -1, min = [0, 0, 0], max = [1, 1, 1] } }"),
        object(
            "repeat = { scatter = { count = 3, min = [0, 0, 0], max = [1, 1, 1], scale = [2, 1] } }",
        ),
        object(
            "repeat = { scatter = { count = 3, min = [0, 0, 0], max = [1, 1, 1], scale = [0, 1] } }",
        ),
        object("repeat = { spiral = { count = 3 } }"),
        object("repeat = { grid = { count = [3, 1, 1], step = [3e38, 0, 0] } }"),
        format!(
            "[[groups.a]]\n{BALL}\ntransform = {{ scale = {tiny} }}\n[[objects]]\ngroup = 'a'\ntransform = {{ scale = {tiny} }}"
        ),
        format!(
            "[[groups.a]]\n{BALL}\ntransform = {{ rotate_deg = [0, 0, 45] }}\n[[objects]]\ngroup = 'a'\ntransform = {{ scale = [1, {tiny}, 1] }}"
        ),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r#"
bad scene (a.toml:2:9): unknown group `wheel`. Add it under [groups], or use an existing one.
bad scene (a.toml:4:9): unknown group `wheels`, did you mean `wheel`? Add it under [groups], or use an existing one.
bad scene (a.toml:2:9): a group contains itself: `a` places `a`. Remove one of them.
bad scene (a.toml:6:9): a group contains itself: `b` places `c` places `b`. Remove one of them.
bad scene (a.toml:1:1): an object needs exactly one surface or group. Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`.
bad scene (a.toml:1:1): invalid type: map, expected a sequence. See `glimray schema` for what is allowed.
bad scene (a.toml:1:1): an object needs exactly one surface or group. Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`.
bad scene (a.toml:6:12): a group has no material. Give one to each of its objects.
bad scene (a.toml:6:8): duplicate object name `x`. Rename one of them.
bad scene (a.toml:3:10): a repetition needs exactly one arrangement. Give one of `grid`, `ring`, `scatter` and `points`; to combine them, repeat a group.
bad scene (a.toml:3:10): a repetition needs exactly one arrangement. Give one of `grid`, `ring`, `scatter` and `points`; to combine them, repeat a group.
bad scene (a.toml:3:29): 0 is not a whole number from 1 to 1000000000. See `glimray schema` for what is allowed.
bad scene (a.toml:3:29): expected three counts [x, y, z], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:3:29): invalid type: integer `3`, expected three counts [x, y, z]. See `glimray schema` for what is allowed.
bad scene (a.toml:3:29): 2.5 is not a whole number from 1 to 1000000000. See `glimray schema` for what is allowed.
bad scene (a.toml:3:29): -1 is not a whole number from 1 to 1000000000. See `glimray schema` for what is allowed.
bad scene (a.toml:3:29): 2000000000 is not a whole number from 1 to 1000000000. See `glimray schema` for what is allowed.
bad scene (a.toml:3:41): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:3:39): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:3:19): the key `count` is missing. Add `count = …`.
bad scene (a.toml:3:58): y of `max` is less than y of `min`. Swap them.
bad scene (a.toml:3:42): -1 is not a whole number from 0 to 4294967295. See `glimray schema` for what is allowed.
bad scene (a.toml:3:77): the smallest factor, 2, exceeds the largest, 1. See `glimray schema` for what is allowed.
bad scene (a.toml:3:77): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:3:12): unknown key `spiral`. Allowed here: `grid`, `ring`, `scatter`, `points`.
bad scene (a.toml:3:10): the object's coordinates are out of range: at most 3.4e38 is allowed. Make it smaller, or move it nearer to the origin.
bad scene (a.toml:3:13): the object's scale, combined with those of its groups and nodes, is zero or out of range. Check these scales.
bad scene (a.toml:3:13): the object's scale, combined with those of its groups and nodes, is zero or out of range. Check these scales.
"#);
}
