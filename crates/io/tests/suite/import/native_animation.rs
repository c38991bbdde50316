//! Animations of the native format: the resulting nodes and tracks, and errors.

use super::{folder, load, message_in, messages, scene};
use crate::support::effort;
use glam::{DQuat, DVec3};
use glimray::import::{self, Options};
use glimray::scene::{
    Beyond, CameraProperty, Curve, Easing, Geometry, Interpolation, LightProperty,
    MaterialProperty, Node, NodeProperty, Scene, Shutter, Target, Track, Values,
};
use insta::assert_snapshot;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

const BALL: &str = "sphere = { center = [0, 0, 0], radius = 1 }";

fn animated(target: &str, property: &str, rest: &str) -> String {
    format!("\n[[animation]]\n{target}\nproperty = '{property}'\n{rest}\n")
}

fn targets(scene: &Scene) -> Vec<&[Target]> {
    scene
        .tracks
        .iter()
        .map(|track| &track.targets[..])
        .collect()
}

fn center(scene: &Scene, shape: usize) -> DVec3 {
    match scene.shapes[shape].geometry {
        Geometry::Sphere { center, .. } => center,
        _ => panic!("a sphere"),
    }
}

#[test]
fn an_animated_object_is_in_the_space_of_its_own_node() {
    let text = format!(
        "[[objects]]
        {BALL}
        transform = {{ translate = [9, 9, 9] }}
        [[objects]]
        name = 'ball'
        {BALL}
        transform = {{ translate = [1, 2, 3], rotate_deg = [0, 90, 0], scale = [2, 3, 4] }}"
    ) + &animated(
        "object = 'ball'",
        "translate",
        "keys = [[0, [1, 2, 3]], [2.5, [4, 5, 6]]]",
    );
    let scene = scene("a.toml", text);
    let node = Node {
        name: "ball".to_owned(),
        translation: DVec3::new(1.0, 2.0, 3.0),
        rotation: DQuat::from_xyzw(0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2),
        scale: DVec3::new(2.0, 3.0, 4.0),
        ..Node::default()
    };
    assert!(scene.nodes[0].rotation.abs_diff_eq(node.rotation, 1e-15));
    let found = Node {
        rotation: node.rotation,
        ..scene.nodes[0].clone()
    };
    assert_eq!((found, scene.nodes.len()), (node, 1));
    assert_eq!(
        (scene.shapes[0].node, scene.shapes[1].node),
        (None, Some(0))
    );
    assert_eq!(
        (center(&scene, 0), center(&scene, 1)),
        (DVec3::splat(9.0), DVec3::ZERO)
    );
    let track = Track {
        targets: vec![Target::Node(0, NodeProperty::Translation)],
        curve: Curve {
            times: vec![0.0, 2.5],
            values: Values::Vector(vec![DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0)]),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    };
    assert_eq!(scene.tracks, [track]);
}

#[test]
fn every_copy_of_an_animated_object_follows_one_track() {
    let text = format!(
        "[[groups.car]]
        name = 'wheel'
        {BALL}
        transform = {{ translate = [0, 1, 0] }}
        repeat = {{ grid = {{ count = [2, 1, 1], step = [3, 0, 0] }} }}
        [[groups.car]]
        {BALL}
        [[objects]]
        group = 'car'
        [[objects]]
        name = 'second'
        group = 'car'
        transform = {{ translate = [0, 0, 10], scale = 2 }}
        [[groups.unused]]
        group = 'car'"
    ) + &animated(
        "object = 'wheel'",
        "rotate_deg",
        "keys = [[0, [0, 0, 720]]]",
    ) + &animated(
        "object = 'second'",
        "visible",
        "keys = [[0, false], [1, true]]",
    );
    let scene = scene("a.toml", text);
    let names: Vec<_> = scene.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["wheel", "wheel", "second", "wheel", "wheel"]);
    let parents: Vec<_> = scene.nodes.iter().map(|node| node.parent).collect();
    assert_eq!(parents, [None, None, None, Some(2), Some(2)]);
    let placed: Vec<_> = scene
        .nodes
        .iter()
        .map(|node| node.placement.translation.x)
        .collect();
    assert_eq!(
        placed,
        [0.0, 3.0, 0.0, 0.0, 3.0],
        "copies are placed outside of what moves"
    );
    assert!(
        scene
            .nodes
            .iter()
            .filter(|node| node.name == "wheel")
            .all(|node| node.translation == DVec3::Y)
    );
    let carriers: Vec<_> = scene.shapes.iter().map(|shape| shape.node).collect();
    assert_eq!(
        carriers,
        [Some(0), Some(1), None, Some(3), Some(4), Some(2)]
    );
    let turned = [0, 1, 3, 4].map(|node| Target::Node(node, NodeProperty::Angles));
    let seen = [Target::Node(2, NodeProperty::Visible)];
    assert_eq!(targets(&scene), [&turned[..], &seen[..]]);
    assert_eq!(
        scene.tracks[0].curve.values,
        Values::Vector(vec![DVec3::new(0.0, 0.0, 4.0 * PI)])
    );
    assert_eq!(scene.tracks[1].curve.interpolation, Interpolation::Step);
    assert_eq!(scene.tracks[1].curve.values, Values::Scalar(vec![0.0, 1.0]));
}

#[test]
fn meshes_and_triangles_are_attached_to_their_parent_nodes() {
    let native = "
        [[groups.flag]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }
        transform = { translate = [0, 3, 0] }
        [[groups.flag]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }
        [[groups.flag]]
        mesh = { file = 'm.obj' }
        transform = { translate = [0, 0, 7] }
        [[objects]]
        name = 'flag'
        group = 'flag'
        repeat = { ring = { count = 2, radius = 5 } }
        [[objects]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }"
        .to_owned()
        + &animated(
            "object = 'flag'",
            "scale",
            "keys = [[0, 1], [1, [1, 2, 1]]]",
        );
    let model: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let folder = folder(&[("a.toml", native.as_bytes()), ("m.obj", model)]);
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    let instances: Vec<_> = (scene.instances.iter())
        .map(|instance| {
            let triangles = scene.meshes[instance.mesh].triangles.len();
            (instance.mesh, triangles, instance.node)
        })
        .collect();
    assert_eq!(
        instances,
        [
            (0, 1, Some(0)),
            (0, 1, Some(1)),
            (1, 1, None),
            (2, 2, Some(0)),
            (2, 2, Some(1))
        ]
    );
    assert_eq!(
        scene.instances[0].placement.translation,
        DVec3::new(0.0, 0.0, 7.0)
    );
    assert_eq!(
        scene.meshes[2].positions[2].y, 4.0,
        "in the space of the node"
    );
    assert!(
        scene.nodes[1]
            .placement
            .translation
            .distance(DVec3::new(-5.0, 0.0, 0.0))
            < 1e-12
    );
}

#[test]
fn cameras_and_lights_are_attached_and_cameras_track_targets() {
    let text = format!(
        "[[objects]]
        name = 'car'
        {BALL}
        transform = {{ translate = [10, 0, 0] }}
        [[groups.inner]]
        name = 'moon'
        {BALL}
        transform = {{ translate = [0, 5, 0] }}
        [[objects]]
        group = 'inner'
        transform = {{ translate = [0, 0, 3] }}
        [[objects]]
        name = 'nothing'
        {BALL}
        visible = false
        [[cameras]]
        look_from = [0, 1, 0]
        look_at = 'moon'
        carried_by = 'car'
        lens = {{ radius = 0.1 }}
        [[cameras]]
        look_from = [0, 1, 7]
        look_at = 'nothing'
        [[lights]]
        carried_by = 'car'
        point = {{ position = [0, 2, 0] }}"
    );
    let scene = scene("a.toml", text);
    let names: Vec<_> = scene.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["car", "moon", "nothing"]);
    let carried = &scene.cameras[0];
    assert_eq!((carried.node, carried.target), (Some(0), Some(1)));
    assert_eq!(
        carried.look_at,
        DVec3::new(-10.0, 5.0, 3.0),
        "at rest, as seen from the car"
    );
    let focus = carried.lens.expect("a lens").focus_distance;
    assert!((focus - 125_f64.sqrt()).abs() < 1e-12);
    assert_eq!(
        (scene.cameras[1].node, scene.cameras[1].target),
        (None, Some(2))
    );
    assert_eq!(scene.lights[0].node, Some(0));
    assert_eq!(scene.shapes.len(), 2, "what only marks a place is not seen");
    assert!(!scene.nodes[2].visible && scene.tracks.is_empty());
}

#[test]
fn a_hidden_object_that_may_appear_is_there() {
    let object = format!("[[objects]]\nname = 'a'\n{BALL}\nvisible = false\n");
    let appearing = scene(
        "a.toml",
        object.clone() + &animated("object = 'a'", "visible", "keys = [[3, true]]"),
    );
    assert_eq!(
        (appearing.shapes.len(), appearing.nodes[0].visible),
        (1, false)
    );
    let moving = scene(
        "a.toml",
        object + &animated("object = 'a'", "scale", "keys = [[3, 2]]"),
    );
    assert_eq!((moving.shapes.len(), moving.nodes.len()), (0, 1));
}

#[test]
fn every_property_and_keyword_has_an_effect() {
    let camera =
        "[camera]\nname = 'c'\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nlens = { radius = 1 }";
    let lights = "
        [[lights]]
        name = 'p'
        point = { position = [0, 0, 0], color = [1, 0.5, 0], intensity = 4 }
        [[lights]]
        name = 's'
        sphere = { center = [0, 0, 0], radius = 2, color = [1, 0.5, 0], radiance = 3 }
        [[lights]]
        name = 'd'
        directional = { direction = [0, -1, 0] }
        [[materials.m.nothing]]";
    let lights = lights.replace(
        "[[materials.m.nothing]]",
        "[materials.m]\n[materials.n]\nphong.ambient = [0, 0, 0]",
    );
    let c = |property, keys: &str| animated("camera = 'c'", property, &format!("keys = {keys}"));
    let l = |name, property, keys: &str| {
        animated(
            &format!("light = '{name}'"),
            property,
            &format!("keys = {keys}"),
        )
    };
    let m = |property, keys: &str| animated("material = 'm'", property, &format!("keys = {keys}"));
    let text = [
        camera.to_owned(),
        lights,
        c("look_from", "[[0, [1, 2, 3]]]"),
        c("look_at", "[[0, [1, 2, 3]]]"),
        c("up", "[[0, [0, 0, 2]]]"),
        c("fov_y_deg", "[[0, 90]]"),
        c("focus_distance", "[[0, 7]]"),
        c("lens_radius", "[[0, 0.5]]"),
        l("p", "position", "[[0, [1, 2, 3]]]"),
        l("p", "color", "[[0, '#ffffff']]"),
        l("s", "color", "[[0, [0, 0, 1]]]"),
        l("s", "intensity", "[[0, 5]]"),
        l("d", "direction", "[[0, [0, 0, -9]]]"),
        l("d", "on", "[[0, true], [1, false]]"),
        m("diffuse", "[[0, [1, 0, 0]]]"),
        m("specular", "[[0, [1, 0, 0]]]"),
        m("shininess", "[[0, 9]]"),
        m("emission", "[[0, [9, 0, 0]]]"),
        m("reflect", "[[0, 0.25]]"),
        m("transmit", "[[0, [1, 0.5, 0.25]]]"),
        m("opacity", "[[0, 0.75]]"),
        m("ior", "[[0, 1.5]]"),
        m("absorption", "[[0, [1, 2, 3]]]"),
        animated("material = 'n'", "diffuse", "keys = [[0, [0, 1, 0]]]"),
        animated("material = 'n'", "ambient", "keys = [[0, [0, 1, 0]]]"),
    ];
    let scene = scene("a.toml", text.concat());
    use {CameraProperty as C, LightProperty as L, MaterialProperty as M};
    let point = DVec3::new(1.0, 2.0, 3.0);
    let camera = |property| vec![Target::Camera(0, property)];
    let light = |index, property| vec![Target::Light(index, property)];
    let material = |property| vec![Target::Material(0, property)];
    let expected = [
        (camera(C::LookFrom), Values::Vector(vec![point])),
        (camera(C::LookAt), Values::Vector(vec![point])),
        (camera(C::Up), Values::Vector(vec![DVec3::Z])),
        (camera(C::FovY), Values::Scalar(vec![PI / 2.0])),
        (camera(C::FocusDistance), Values::Scalar(vec![7.0])),
        (camera(C::LensRadius), Values::Scalar(vec![0.5])),
        (light(0, L::Position), Values::Vector(vec![point])),
        // The intensity is kept unless it is animated too.
        (light(0, L::Color), Values::Vector(vec![DVec3::splat(4.0)])),
        (light(1, L::Color), Values::Vector(vec![DVec3::Z])),
        (light(1, L::Intensity), Values::Scalar(vec![5.0])),
        (light(2, L::Direction), Values::Vector(vec![DVec3::NEG_Z])),
        (light(2, L::On), Values::Scalar(vec![1.0, 0.0])),
        // A material whose ambient colour defaults to its diffuse one keeps them equal.
        (
            vec![
                Target::Material(0, M::Diffuse),
                Target::Material(0, M::Ambient),
            ],
            Values::Vector(vec![DVec3::X]),
        ),
        (material(M::Specular), Values::Vector(vec![DVec3::X])),
        (material(M::Shininess), Values::Scalar(vec![9.0])),
        (material(M::Emission), Values::Vector(vec![9.0 * DVec3::X])),
        (
            material(M::Reflect),
            Values::Vector(vec![DVec3::splat(0.25)]),
        ),
        (
            material(M::Transmit),
            Values::Vector(vec![DVec3::new(1.0, 0.5, 0.25)]),
        ),
        (material(M::Opacity), Values::Scalar(vec![0.75])),
        (material(M::Ior), Values::Scalar(vec![1.5])),
        (material(M::Absorption), Values::Vector(vec![point])),
        (
            vec![Target::Material(1, M::Diffuse)],
            Values::Vector(vec![DVec3::Y]),
        ),
        (
            vec![Target::Material(1, M::Ambient)],
            Values::Vector(vec![DVec3::Y]),
        ),
    ];
    let found: Vec<_> = (scene.tracks.iter())
        .map(|track| (track.targets.clone(), track.curve.values.clone()))
        .collect();
    assert_eq!(found, expected);
    // An animated intensity multiplies the plain colour.
    assert_eq!(scene.lights[0].color, glam::Vec3::new(4.0, 2.0, 0.0));
    assert_eq!(scene.lights[1].color, glam::Vec3::new(1.0, 0.5, 0.0));
}

#[test]
fn curves_match_the_file() {
    let curve = |property: &str, rest: &str| {
        let object = format!("[[objects]]\nname = 'a'\n{BALL}");
        scene("a.toml", object + &animated("object = 'a'", property, rest)).tracks[0]
            .curve
            .clone()
    };
    let two = "keys = [[-1, [0, 0, 0]], [1.5, [1, 0, 0]]]";
    let translate = |words: &str| curve("translate", &format!("{words}\n{two}"));
    assert_eq!(translate("").times, [-1.0, 1.5]);
    for (word, expected) in [
        ("step", Interpolation::Step),
        ("linear", Interpolation::Linear),
        ("cubic", Interpolation::CatmullRom),
        ("hermite", Interpolation::Hermite),
    ] {
        let found = translate(&format!("interpolation = '{word}'"));
        assert_eq!(found.interpolation, expected);
    }
    for (word, expected) in [
        ("'none'", Easing::None),
        ("'in'", Easing::IN),
        ("'out'", Easing::OUT),
        ("'in-out'", Easing::IN_OUT),
        ("[0, -1, 1, 2.5]", Easing::Bezier([0.0, -1.0, 1.0, 2.5])),
    ] {
        assert_eq!(translate(&format!("easing = {word}")).easing, expected);
    }
    for (word, expected) in [
        ("hold", Beyond::Hold),
        ("repeat", Beyond::Repeat),
        ("ping-pong", Beyond::PingPong),
    ] {
        assert_eq!(translate(&format!("beyond = '{word}'")).beyond, expected);
    }
    let hermite = curve(
        "rotate_deg",
        "interpolation = 'hermite'
        keys = [{ time = 0, value = [180, 0, 0], out_tangent = [0, 360, 0] }, { time = 1, value = [0, 0, 0], in_tangent = [0, 0, 90] }]",
    );
    let [zero, x, y, z] = [
        DVec3::ZERO,
        PI * DVec3::X,
        2.0 * PI * DVec3::Y,
        PI / 2.0 * DVec3::Z,
    ];
    assert_eq!(
        hermite.values,
        Values::Vector(vec![zero, x, y, z, zero, zero])
    );
    let turned = curve(
        "rotation",
        "interpolation = 'hermite'\nkeys = [{ time = 0, value = [0, 0.7071, 0, 0.7071], in_tangent = [1, 2, 3, 4] }]",
    );
    let Values::Rotation(turned) = turned.values else {
        panic!("rotations");
    };
    assert_eq!(turned[0], DQuat::from_xyzw(1.0, 2.0, 3.0, 4.0));
    assert!(
        (turned[1].length() - 1.0).abs() < 1e-15,
        "three digits are enough"
    );
    let grown = curve(
        "scale",
        "interpolation = 'hermite'\nkeys = [{ time = 0, value = -2, out_tangent = 3 }]",
    );
    let expected = [DVec3::ZERO, DVec3::splat(-2.0), DVec3::splat(3.0)];
    assert_eq!(grown.values, Values::Vector(expected.to_vec()));
}

#[test]
fn the_output_has_frame_rate_and_shutter() {
    let output = |text: &str| scene("a.toml", format!("[output]\n{text}")).output;
    let shutter = |open, close| Shutter { open, close };
    let all = output("fps = 29.97\nduration = 4\nshutter = 0.5");
    assert_eq!(
        (all.fps, all.duration, all.shutter),
        (29.97, Some(4.0), shutter(0.0, 0.5))
    );
    assert_eq!(output("shutter = '180deg'").shutter, shutter(0.0, 0.5));
    assert_eq!(output("shutter = '90deg'").shutter, shutter(0.0, 0.25));
    assert_eq!(
        output("shutter = [-0.25, 0.25]").shutter,
        shutter(-0.25, 0.25)
    );
    assert_eq!(output("shutter = 0").shutter, Shutter::default());
    assert_eq!((output("").fps, output("").duration), (24.0, None));
}

#[test]
fn an_animation_of_an_unplaced_object_is_noted() {
    let text = format!("[[groups.a]]\nname = 'x'\n{BALL}")
        + &animated("object = 'x'", "scale", "keys = [[0, 2]]");
    let scene = scene("a.toml", text);
    assert!(scene.tracks.is_empty() && scene.nodes.is_empty());
    assert_snapshot!(scene.skipped.join("\n"), @r#"animation of `x` skipped: the object is nowhere in the scene"#);
}

#[test]
fn a_hundred_thousand_keys_load_quickly_and_a_million_are_refused() {
    let text = |count: usize| {
        let keys: String = (0..count).map(|i| format!("[{i},{}],", i % 7)).collect();
        "[materials.m]".to_owned()
            + &animated("material = 'm'", "shininess", &format!("keys = [{keys}]"))
    };
    let many = text(100_000);
    let scene = effort::within(3000.0, || scene("a.toml", many));
    assert_eq!(scene.tracks[0].curve.times.len(), 100_000);
    let folder = folder(&[("a.toml", text(1_000_000).as_bytes())]);
    assert_snapshot!(message_in(&folder, "a.toml", &Options::default()), @r#"bad scene (a.toml:5:1263851): the scene has too many keys and values. Keep geometry in OBJ or PLY files, and use fewer keys."#);
    assert!(load("a.toml", text(2)).is_ok());
}

#[test]
fn every_invalid_animation_has_a_message() {
    let things = format!(
        "[camera]\nname = 'c'\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n[[lights]]\nname = 'l'\npoint = {{ position = [0, 0, 0] }}\n[materials.m]\n[[objects]]\nname = 'o'\n{BALL}"
    );
    let of = |target: &str, property: &str, rest: &str| {
        things.clone() + &animated(target, property, rest)
    };
    let keys = |keys: &str| of("object = 'o'", "translate", &format!("keys = {keys}"));
    let o = |property: &str, list: &str| of("object = 'o'", property, &format!("keys = {list}"));
    let c = |property: &str, list: &str| of("camera = 'c'", property, &format!("keys = {list}"));
    let l = |property: &str, list: &str| of("light = 'l'", property, &format!("keys = {list}"));
    let m = |property: &str, list: &str| of("material = 'm'", property, &format!("keys = {list}"));
    let one = "keys = [[0, [0, 0, 0]]]";
    let texts = [
        keys("[]"),
        keys("[[0, [0, 0, 0]], [2, [0, 0, 0]], [1, [0, 0, 0]]]"),
        keys("[[0, [0, 0, 0]], [0, [0, 0, 0]]]"),
        keys("[[nan, [0, 0, 0]]]"),
        keys("[[1e10, [0, 0, 0]]]"),
        keys("[[0, [0, nan, 0]]]"),
        keys("[[0, [0, inf, 0]]]"),
        keys("[[0, [0, 1e39, 0]]]"),
        keys("[[0, [0, 0]]]"),
        keys("[[0, [0, 0, 0, 0]]]"),
        keys("[[0, [0, 0, 0, 0, 0]]]"),
        keys("[[0, 1]]"),
        keys("[[0, true]]"),
        keys("[[0, '#ffffff']]"),
        keys("[[0]]"),
        keys("[[0, [0, 0, 0], 1]]"),
        keys("[{ time = 0 }]"),
        keys("[{ time = 0, value = [0, 0, 0], tangent = 3 }]"),
        keys("[{ time = 0, value = [0, 0, 0], in_tangent = [1, 0, 0] }]"),
        keys("[3]"),
        o("rotation", "[[0, [0, 0, 0, 0]]]"),
        o("rotation", "[[0, [0, 0, 0, 1.01]]]"),
        o("rotation", "[[0, [0, 0, 0]]]"),
        o("scale", "[[0, [1, 0, 1]]]"),
        o("scale", "[[0, 1], [1, -1]]"),
        o("visible", "[[0, 1]]"),
        of(
            "object = 'o'",
            "visible",
            "interpolation = 'linear'\nkeys = [[0, true]]",
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("interpolation = 'bezier'\n{one}"),
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("interpolation = 'step'\neasing = 'in'\n{one}"),
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("easing = 'inn'\n{one}"),
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("easing = [0, 0, 2, 0]\n{one}"),
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("easing = [0, 11, 1, 0]\n{one}"),
        ),
        of(
            "object = 'o'",
            "translate",
            &format!("beyond = 'loop'\n{one}"),
        ),
        of("object = 'o'", "translat", one),
        of("object = 'o'", "fov_y_deg", "keys = [[0, 30]]"),
        of("camera = 'c'", "scale", "keys = [[0, 30]]"),
        of("object = 'p'", "translate", one),
        of("camera = 'd'", "look_from", one),
        of("light = 'k'", "position", one),
        of("material = 'n'", "diffuse", one),
        of("", "translate", one),
        of("object = 'o'\nlight = 'l'", "translate", one),
        of("object = 'o'", "translate", one) + &animated("object = 'o'", "translate", one),
        o("rotate_deg", "[[0, [0, 0, 0]]]")
            + &animated("object = 'o'", "rotation", "keys = [[0, [0, 0, 0, 1]]]"),
        c("fov_y_deg", "[[0, 180]]"),
        c("up", "[[0, [0, 0, 0]]]"),
        c("up", "[[0, [0, 1, 0]], [1, [0, -2, 0]]]"),
        c("focus_distance", "[[0, 4]]"),
        l("color", "[[0, [0, 0, -1]]]"),
        l("color", "[[0, 'red']]"),
        l("intensity", "[[0, -1]]"),
        l("direction", "[[0, [0, 1, 0]]]"),
        m("opacity", "[[0, 1.5]]"),
        m("reflect", "[[0, 1.5]]"),
        m("ior", "[[0, 0]]"),
        m("absorption", "[[0, [0, -1, 0]]]"),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r##"
bad scene (a.toml:15:8): an animation needs at least one key. Add one, such as [0, VALUE].
bad scene (a.toml:15:42): the time 1 is before that of the previous key, 2. Give every key a later time than the one before it.
bad scene (a.toml:15:26): two keys have the same time, 0. Give every key a later time than the one before it.
bad scene (a.toml:15:10): NaN is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:15:9): 10000000000 is not a time between -1e9 and 1e9 seconds. See `glimray schema` for what is allowed.
bad scene (a.toml:15:17): NaN is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:15:17): inf is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:15:17): 1e39 is out of range: at most 3.4e38 is allowed. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): expected three numbers [x, y, z], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): expected three numbers [x, y, z], found more. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): a value has four numbers at most. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): invalid type: floating point `1.0`, expected three numbers [x, y, z]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): invalid type: boolean `true`, expected three numbers [x, y, z]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): invalid type: string "#ffffff", expected three numbers [x, y, z]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:9): a key is a time and a value: [time, value]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:9): a key is a time and a value: [time, value]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:9): the key `value` is missing. Add `value = …`.
bad scene (a.toml:15:40): unknown key `tangent`. Allowed here: `time`, `value`, `in_tangent`, `out_tangent`.
bad scene (a.toml:15:53): only hermite interpolation has tangents. Leave it out, or add `interpolation = "hermite"`.
bad scene (a.toml:15:9): invalid type: integer `3`, expected a key: [time, value] or { time, value }. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): a rotation is a quaternion [x, y, z, w] of length 1, not 0.000. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): a rotation is a quaternion [x, y, z, w] of length 1, not 1.010. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): expected a quaternion [x, y, z, w], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): a scale cannot be 0. See `glimray schema` for what is allowed.
bad scene (a.toml:15:21): between the previous key and this one, the scale would pass through 0. Keep the signs, or use `interpolation = "step"`.
bad scene (a.toml:15:13): invalid type: floating point `1.0`, expected a boolean. See `glimray schema` for what is allowed.
bad scene (a.toml:15:17): true and false cannot be interpolated. Leave `interpolation` out, or make it "step".
bad scene (a.toml:15:17): unknown value `bezier`. Allowed here: `step`, `linear`, `cubic`, `hermite`.
bad scene (a.toml:16:10): only linear interpolation has easing. Leave `easing` out, or make the interpolation linear.
bad scene (a.toml:15:10): unknown value `inn`, did you mean `in`? Allowed here: `none`, `in`, `out`, `in-out`.
bad scene (a.toml:15:10): x1 and x2 of an easing are between 0 and 1: time runs forward. See `glimray schema` for what is allowed.
bad scene (a.toml:15:10): y1 and y2 of an easing are between -10 and 10. See `glimray schema` for what is allowed.
bad scene (a.toml:15:10): unknown value `loop`. Allowed here: `hold`, `repeat`, `ping-pong`.
bad scene (a.toml:14:12): unknown value `translat`, did you mean `translate`? Allowed here: `translate`, `rotation`, `rotate_deg`, `angles`, `scale`, `visible`, `look_from`, `look_at`, `up`, `fov_y_deg`, `fov_y`, `orthographic`, `focus_distance`, `lens_radius`, `position`, `direction`, `color`, `intensity`, `on`, `diffuse`, `specular`, `shininess`, `ambient`, `emission`, `reflect`, `transmit`, `opacity`, `ior`, `absorption`.
bad scene (a.toml:14:12): an object has no such property. Allowed here: `translate`, `rotation`, `rotate_deg`, `angles`, `scale`, `visible`.
bad scene (a.toml:14:12): a camera has no such property. Allowed here: `look_from`, `look_at`, `up`, `fov_y_deg`, `fov_y`, `orthographic`, `focus_distance`, `lens_radius`.
bad scene (a.toml:13:10): unknown object `p`, did you mean `o`? Add that `name` to an object, or use an existing one.
bad scene (a.toml:13:10): unknown camera `d`, did you mean `c`? Add that `name` to a camera, or use an existing one.
bad scene (a.toml:13:9): unknown light `k`, did you mean `l`? Add that `name` to a light, or use an existing one.
bad scene (a.toml:13:12): unknown material `n`, did you mean `m`? Add it under [materials], or use an existing one.
bad scene (a.toml:12:1): an animation needs exactly one target. Give it one of `object`, `objects`, `camera`, `light` and `material`.
bad scene (a.toml:12:1): an animation needs exactly one target. Give it one of `object`, `objects`, `camera`, `light` and `material`.
bad scene (a.toml:19:12): a second animation of the same property of the object `o`. Put all keys into one animation.
bad scene (a.toml:19:12): a second animation of the same property of the object `o`. Put all keys into one animation.
bad scene (a.toml:15:13): 180 is not an angle between 0.001 and 179.999 degrees. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:29): the direction is opposite to that of the previous key, so the path is ambiguous. Add a key in between, or use `interpolation = "step"`.
bad scene (a.toml:14:12): this needs a lens, but `c` has none. Give the camera a `lens`.
bad scene (a.toml:15:13): -1 in a colour is negative. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): `red` is not a colour: write "#rrggbb" or [r, g, b]. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:14:12): this kind of light has no such property. Animate a key of its own table.
bad scene (a.toml:15:13): 1.5 is not between 0 and 1. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): 1.5 is not between 0 and 1. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): 0 is not an index of refraction between 0.01 and 100. See `glimray schema` for what is allowed.
bad scene (a.toml:15:13): -1 in an absorption is not between 0 and 1e12. See `glimray schema` for what is allowed.
"##);
}

#[test]
fn every_invalid_use_of_a_moving_object_has_a_message() {
    let ball = format!("[[objects]]\nname = 'o'\n{BALL}\n");
    let pair = format!("{ball}repeat = {{ ring = {{ count = 2 }} }}\n");
    let camera = |look_at: &str, rest: &str| {
        format!("[camera]\nname = 'c'\nlook_from = [0, 0, 5]\nlook_at = {look_at}\n{rest}\n")
    };
    let light = |rest: &str| {
        format!("[[lights]]\nname = 'l'\npoint = {{ position = [0, 0, 0] }}\n{rest}\n")
    };
    let move_o = animated("object = 'o'", "translate", "keys = [[0, [0, 0, 0]]]");
    let texts = [
        camera("'x'", "") + &ball,
        camera("'o'", "") + &pair,
        camera("'o'", "") + &format!("[[groups.a]]\nname = 'o'\n{BALL}"),
        camera("'o'", "") + &ball + "transform = { translate = [0, 0, 5] }",
        camera("'o'", "") + &ball + "transform = { translate = [0, 1, 5] }",
        camera("3", ""),
        camera("'o'", "") + &ball + &animated("camera = 'c'", "look_at", "keys = [[0, [0, 0, 0]]]"),
        camera("'o'", "carried_by = 'p'") + &ball,
        camera("[0, 0, 0]", "lens = { radius = 0.1 }")
            + &animated("camera = 'c'", "focus_distance", "keys = [[0, 1e-9]]"),
        camera("[0, 0, 0]", "lens = { radius = 0.1 }")
            + &animated("camera = 'c'", "lens_radius", "keys = [[0, 1e8]]"),
        light("carried_by = 'x'"),
        light("carried_by = 'o'") + &pair,
        light("") + &light(""),
        light("")
            + &animated("light = 'l'", "intensity", "keys = [[0, 3e38], [1, 1]]")
            + &animated("light = 'l'", "color", "keys = [[0, [3e38, 0, 0]]]"),
        "[[lights]]\nname = 'l'\npoint = { position = [0, 0, 0], color = [1e20, 0, 0] }".to_owned()
            + &animated("light = 'l'", "intensity", "keys = [[0, 1e20]]"),
        "[[lights]]\nname = 'l'\ndirectional = { direction = [0, -1, 0] }".to_owned()
            + &animated("light = 'l'", "position", "keys = [[0, [0, 0, 0]]]"),
        format!("[[objects]]\nname = 'o'\nplane = {{ point = [0, 0, 0] }}{move_o}"),
        format!(
            "[[groups.a]]\nplane = {{ point = [0, 0, 0] }}\n[[objects]]\nname = 'o'\ngroup = 'a'{move_o}"
        ),
        "output.fps = 0".to_owned(),
        "output.fps = 1001".to_owned(),
        "output.duration = 0".to_owned(),
        "output.duration = -1".to_owned(),
        "output.shutter = -0.5".to_owned(),
        "output.shutter = 1001".to_owned(),
        "output.shutter = '180'".to_owned(),
        "output.shutter = '-180deg'".to_owned(),
        "output.shutter = 'nandeg'".to_owned(),
        "output.shutter = [0.5, 0]".to_owned(),
        "output.shutter = [-1001, 0]".to_owned(),
        "output.shutter = [0, 1, 2]".to_owned(),
        "output.shutter = true".to_owned(),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r#"
bad scene (a.toml:4:11): unknown object `x`, did you mean `o`? Add that `name` to an object, or use an existing one.
bad scene (a.toml:4:11): `o` is in the scene 2 times. Name an object that is not repeated and not in a group that is placed more than once.
bad scene (a.toml:4:11): `o` is nowhere in the scene: its group is hidden or never placed. Place it, or name another object.
bad scene (a.toml:4:11): `look_at` is the same point as `look_from`. Move one of them.
bad scene (a.toml:4:11): `up` is parallel to the viewing direction. Give the camera another `up`.
bad scene (a.toml:4:11): invalid type: integer `3`, expected a point [x, y, z], or the name of an object. See `glimray schema` for what is allowed.
bad scene (a.toml:12:12): the camera already looks at an object. Animate that object, or give `look_at` a point.
bad scene (a.toml:5:14): unknown object `p`, did you mean `o`? Add that `name` to an object, or use an existing one.
bad scene (a.toml:10:8): the lens gets out of proportion: its radius must be at most 1e9, and at most a million times its focus distance. Make the lens smaller, or its focus distance greater.
bad scene (a.toml:10:8): the lens gets out of proportion: its radius must be at most 1e9, and at most a million times its focus distance. Make the lens smaller, or its focus distance greater.
bad scene (a.toml:4:14): unknown object `x`. Add that `name` to an object, or use an existing one.
bad scene (a.toml:4:14): `o` is in the scene 2 times. Name an object that is not repeated and not in a group that is placed more than once.
bad scene (a.toml:6:8): duplicate light name `l`. Rename one of them.
bad scene (a.toml:14:8): `color` times `intensity` gets out of range: at most 3.4e38 is allowed. Lower one of them.
bad scene (a.toml:7:8): `color` times `intensity` gets out of range: at most 3.4e38 is allowed. Lower one of them.
bad scene (a.toml:6:12): this kind of light has no such property. Animate a key of its own table.
bad scene (a.toml:1:1): a plane is infinite and cannot move. Do not animate it, attach anything to it or look at it, or use a large rectangle.
bad scene (a.toml:1:1): a plane is infinite and cannot move. Do not animate it, attach anything to it or look at it, or use a large rectangle.
bad scene (a.toml:1:14): 0 is not between 0.001 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): 1001 is not between 0.001 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:19): 0 is not between 1e-6 and 1e9 seconds. See `glimray schema` for what is allowed.
bad scene (a.toml:1:19): -1 is not between 1e-6 and 1e9 seconds. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): -0.5 is not a fraction of a frame between 0 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): 1001 is not a fraction of a frame between 0 and 1000. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): `180` is not the angle of a shutter, such as "180deg". See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): `-180deg` is not the angle of a shutter, such as "180deg". See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): `nandeg` is not the angle of a shutter, such as "180deg". See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): the shutter opens at 0.5, after it closes at 0. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): -1001 is not within 1000 frames of the frame's own time. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): expected two times [open, close], found more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): invalid type: boolean `true`, expected a fraction of a frame, an angle such as "180deg", or [open, close] in frames. See `glimray schema` for what is allowed.
"#);
}
