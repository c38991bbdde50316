//! View and light of models that have none.

use super::gltf::model::Model;
use glam::{DMat3, DVec3};
use glimray::import::{self, Environment, EnvironmentSource, Ground, Memory, Options, Staging};
use glimray::scene::{Background, Camera, Geometry, LightKind, LightTransport, Scene, ToneCurve};
use serde_json::json;

/// A box with this minimum and maximum.
fn cuboid(min: DVec3, max: DVec3) -> String {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: u8, axis: usize| if i & bit == 0 { min[axis] } else { max[axis] };
        text += &format!("v {} {} {}\n", side(1, 0), side(2, 1), side(4, 2));
    }
    text + "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n"
}

fn load(model: &str, options: &Options) -> Scene {
    let files = Memory::from_iter([("a.obj", model.as_bytes())]);
    import::load_from(&files, "a.obj", options).expect("a scene")
}

fn sized(size: (u32, u32)) -> Options {
    Options {
        size: Some(size),
        ..Options::default()
    }
}

/// Where the corners of the box are in the image of a pinhole camera: −1 to 1 from edge to edge.
fn projected(camera: &Camera, aspect: f64, min: DVec3, max: DVec3) -> Vec<[f64; 2]> {
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(camera.up).normalize();
    let axes = DMat3::from_cols(right, right.cross(forward), forward).transpose();
    let corner = |i: u8| {
        let side = |bit: u8, axis: usize| if i & bit == 0 { min[axis] } else { max[axis] };
        let p = axes * (DVec3::new(side(1, 0), side(2, 1), side(4, 2)) - camera.look_from);
        assert!(p.z > 0.0, "in front of the camera");
        let high = p.z * (camera.fov_y / 2.0).tan();
        [p.x / (high * aspect), p.y / high]
    };
    (0..8).map(corner).collect()
}

#[test]
fn the_model_fills_the_picture_whatever_its_shape_and_that_of_the_picture() {
    let boxes = [
        (DVec3::ZERO, DVec3::ONE),
        (DVec3::splat(-1e-4), DVec3::splat(1e-4)),
        (DVec3::new(1e5, -3e5, 2e5), DVec3::new(1.1e5, -2e5, 3e5)),
        (DVec3::new(-9.0, 0.0, 0.0), DVec3::new(9.0, 1.0, 1.0)),
        (DVec3::new(0.0, -20.0, 0.0), DVec3::new(1.0, 20.0, 1.0)),
        (DVec3::new(0.0, 5.0, 0.0), DVec3::new(7.0, 5.0, 7.0)),
    ];
    for (min, max) in boxes {
        for size in [(800, 600), (300, 300), (100, 900), (1600, 200)] {
            let scene = load(&cuboid(min, max), &sized(size));
            let camera = &scene.cameras[0];
            let towards = camera.look_from - camera.look_at;
            assert!(
                towards.min_element() > 0.0,
                "from the front, right and above: {towards}"
            );
            let places = projected(camera, f64::from(size.0) / f64::from(size.1), min, max);
            let range = |axis: usize| {
                let all = places.iter().map(|place| place[axis]);
                (
                    all.clone().fold(f64::INFINITY, f64::min),
                    all.fold(f64::NEG_INFINITY, f64::max),
                )
            };
            // A margin of a tenth of the half on both sides along one axis, and no less along the other.
            let [(left, right), (low, high)] = [range(0), range(1)];
            let most = right.max(high).max(-left).max(-low);
            assert!((most - 0.9).abs() < 1e-3, "{size:?} {min} {max}: {most}");
            let is_tight =
                |low: f64, high: f64| (high - 0.9).abs() < 1e-3 && (low + 0.9).abs() < 1e-3;
            assert!(
                is_tight(left, right) || is_tight(low, high),
                "{size:?} {min} {max}"
            );
        }
    }
}

#[test]
fn the_rig_does_not_depend_on_the_size_of_the_model() {
    let [small, large] = [1e-3, 1e3].map(|size| {
        let scene = load(
            &cuboid(DVec3::ZERO, DVec3::splat(size)),
            &Options::default(),
        );
        (scene.cameras[0].look_from / size, scene)
    });
    assert!(small.0.distance(large.0) < 1e-6 * large.0.length());
    for (a, b) in small.1.lights.iter().zip(&large.1.lights) {
        assert_eq!((a.color, a.attenuation), (b.color, b.attenuation));
        let bounds = |light: &glimray::scene::Light| light.kind.bounds().expect("an area light");
        let [a, b] = [bounds(a).0 * 1e3, bounds(b).0 * 1e-3];
        assert!(a.distance(b) < 1e-6 * b.length());
    }
}

#[test]
fn the_ground_is_just_below_the_model() {
    let scene = load(&cuboid(DVec3::ONE, DVec3::splat(3.0)), &Options::default());
    let [shape] = &scene.shapes[..] else {
        panic!("only the ground: {:?}", scene.shapes);
    };
    let Geometry::Plane { point, normal } = shape.geometry else {
        panic!("the ground is a plane");
    };
    assert_eq!(normal, DVec3::Y);
    assert!(point.y < 1.0 && point.y > 0.99, "{point}");
}

/// A model of one triangle in each format.
fn one_triangle() -> [(&'static str, Vec<u8>); 5] {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let stl = "solid a\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\n\
               endfacet\nendsolid a\n";
    let gltf = Model::triangle(json!({}));
    [
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
        ("a.ply", ply.into()),
        ("a.stl", stl.into()),
        ("a.glb", gltf.glb()),
        ("a.gltf", gltf.gltf("a.bin").into()),
    ]
}

#[test]
fn models_of_all_formats_stand_in_the_same_studio() {
    let gltf = Model::triangle(json!({}));
    let scenes = one_triangle().map(|(name, bytes)| {
        let files = Memory::from_iter([(name, &bytes[..]), ("a.bin", &gltf.bin[..])]);
        import::load_from(&files, name, &Options::default()).expect(name)
    });
    let first = &scenes[0];
    assert!(first.staged && !first.is_unlit());
    assert_eq!(first.lights.len(), 2);
    assert_eq!(first.output.integrator, LightTransport::Path);
    assert_eq!(
        first.output.exposure_ev, 0.0,
        "unlit colours stay as they are"
    );
    assert_eq!(first.output.path_tone, ToneCurve::Neutral);
    for scene in &scenes[1..] {
        assert_eq!(scene.cameras, first.cameras);
        assert_eq!(scene.lights, first.lights);
        assert_eq!(scene.background, first.background);
        assert_eq!((scene.ambient, &scene.shapes.len()), (first.ambient, &1));
        assert_eq!(scene.output, first.output);
        let ground = |scene: &Scene| {
            scene.materials[scene.shapes[0].material]
                .classical()
                .diffuse
        };
        assert_eq!(ground(scene), ground(first));
    }
}

/// The backdrop shows above the ground, and is brighter, behind models that are not flat.
#[test]
fn the_horizon_is_in_the_picture() {
    let scene = load(&cuboid(DVec3::ZERO, DVec3::ONE), &Options::default());
    let camera = &scene.cameras[0];
    let forward = (camera.look_at - camera.look_from).normalize();
    let above = camera.fov_y / 2.0 + forward.y.asin();
    assert!(above > 5_f64.to_radians(), "{above}");
    let Background::Gradient { bottom, top } = scene.background else {
        panic!("{:?}", scene.background);
    };
    // The light of the lamps and of the upper half of the backdrop on a level surface.
    let lamps: f32 = (scene.lights.iter())
        .map(|light| match light.kind {
            LightKind::Disc { normal, .. } => light.color.y * -normal.y as f32,
            other => panic!("{other:?}"),
        })
        .sum();
    let sky = bottom.y + (top.y - bottom.y) * 5.0 / 6.0;
    let ground = scene.materials[scene.shapes[0].material]
        .classical()
        .diffuse
        .y
        * (lamps + sky);
    let horizon = bottom.midpoint(top).y;
    assert!(
        ground > 0.1 && 1.2 * ground < horizon && horizon < 0.8,
        "{ground} {horizon}"
    );
}

#[test]
fn flat_models_are_seen_from_higher_up() {
    let elevation = |max: DVec3| {
        let camera = &load(&cuboid(DVec3::ZERO, max), &Options::default()).cameras[0];
        let towards = (camera.look_from - camera.look_at).normalize();
        towards.y.asin().to_degrees()
    };
    for upright in [
        DVec3::ONE,
        DVec3::new(2.0, 1.0, 1.0),
        DVec3::new(1.0, 9.0, 1.0),
    ] {
        let degrees = elevation(upright);
        assert!((8.0..15.0).contains(&degrees), "{upright}: {degrees}");
    }
    let plate = elevation(DVec3::new(2.0, 0.0, 2.0));
    assert!((30.0..40.0).contains(&plate), "{plate}");
    let board = elevation(DVec3::new(2.0, 0.5, 2.0));
    assert!(board < plate && board > 15.0, "{board}");
}

#[test]
fn an_environment_takes_the_place_of_the_lamps_where_paths_are_traced() {
    let model = cuboid(DVec3::ZERO, DVec3::ONE);
    let folder = super::folder(&[("a.obj", model.as_bytes())]);
    let with = |integrator| {
        let options = Options {
            integrator,
            environment: Environment {
                source: Some(EnvironmentSource::Sky {
                    elevation_deg: 45.0,
                    azimuth_deg: 0.0,
                }),
                ..Environment::default()
            },
            ..Options::default()
        };
        import::load_with(&folder.path().join("a.obj"), &options).expect("a scene")
    };
    assert!(with(None).lights.is_empty() && with(None).staged);
    assert_eq!(with(Some(LightTransport::Whitted)).lights.len(), 2);
}

/// A model with one light, before its centre at twice its size.
fn lit_by(intensity: f64, staging: Staging) -> Scene {
    let model = Model::triangle(json!({})).with(json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "mesh": 0 },
            { "translation": [0.5, 0.5, 2], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": intensity }] } },
    }));
    let files = Memory::from_iter([("a.glb", &model.glb()[..])]);
    let options = Options {
        staging,
        ..Options::default()
    };
    import::load_from(&files, "a.glb", &options).expect("a scene")
}

#[test]
fn weak_lights_of_a_model_are_helped_by_lamps() {
    let strong = lit_by(100.0, Staging::default());
    assert_eq!((strong.lights.len(), strong.shapes.len()), (1, 0));
    assert!(!strong.staged && strong.background == Background::default());
    let weak = lit_by(0.5, Staging::default());
    assert!(weak.staged && matches!(weak.background, Background::Gradient { .. }));
    assert_eq!((weak.lights.len(), weak.shapes.len()), (3, 1));
    assert!(
        matches!(weak.lights[0].kind, LightKind::Point { .. }),
        "its own comes first and stays"
    );
    let alone = lit_by(
        0.5,
        Staging {
            lights: false,
            ..Staging::default()
        },
    );
    assert_eq!(alone.lights.len(), 1);
}

#[test]
fn each_part_can_be_left_out() {
    let model = cuboid(DVec3::ZERO, DVec3::ONE);
    let with = |staging| {
        load(
            &model,
            &Options {
                staging,
                ..Options::default()
            },
        )
    };
    let whole = with(Staging::default());
    assert!(whole.staged && !whole.is_unlit());
    assert!(
        whole
            .lights
            .iter()
            .all(|light| light.kind.radiance().is_some()),
        "soft lights"
    );
    assert!(matches!(whole.background, Background::Gradient { .. }));

    let bare = with(Staging::NONE);
    assert!(!bare.staged && bare.is_unlit());
    assert_eq!(
        (bare.lights.len(), bare.shapes.len(), bare.materials.len()),
        (0, 0, 1)
    );
    assert_eq!(bare.cameras, [Camera::default()]);
    assert_eq!(bare.background, Background::default());
    assert_eq!(bare.output.path_tone, ToneCurve::None);

    let no_lights = with(Staging {
        lights: false,
        ..Staging::default()
    });
    assert_eq!((no_lights.lights.len(), no_lights.shapes.len()), (0, 1));
    assert_eq!(no_lights.cameras, whole.cameras);
    let no_ground = with(Staging {
        ground: Ground::None,
        ..Staging::default()
    });
    assert_eq!(
        (no_ground.lights.len(), no_ground.shapes.len()),
        (whole.lights.len(), 0)
    );
    let no_background = with(Staging {
        background: false,
        ..Staging::default()
    });
    assert_eq!(no_background.background, Background::default());
    assert_eq!(no_background.lights, whole.lights);
    let no_camera = with(Staging {
        camera: false,
        ..Staging::default()
    });
    assert_eq!(no_camera.cameras, [Camera::default()]);
}

#[test]
fn only_models_can_be_turned_upright() {
    let files = Memory::from_iter([("a.toml", &b"background = [1, 1, 1]"[..])]);
    let options = Options {
        up: Some(import::Axis::Z),
        ..Options::default()
    };
    let error = import::load_from(&files, "a.toml", &options).expect_err("refused");
    assert_eq!(
        error.to_string(),
        "up axis refused (a.toml): only models have an axis that points up. Leave it out, or give the camera an up \
         direction."
    );
}
