//! The native format: its meaning, and its error messages.

use super::{folder, message_in, messages, scene};
use glam::{DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{
    Attenuation, Background, Camera, Geometry, LightKind, Material, OutputDefaults, Phong, Scene,
    ToneCurve, Transfer,
};
use insta::assert_snapshot;
use std::f64::consts::FRAC_1_SQRT_2;

fn with(overrides: &[&str], text: &str) -> Result<Scene, import::ImportError> {
    let overrides = overrides.iter().map(|&text| text.to_owned()).collect();
    import::parse(
        "embedded.toml",
        text,
        &Options {
            overrides,
            ..Options::default()
        },
    )
}

fn sphere(scene: &Scene, index: usize) -> (DVec3, f64) {
    match scene.shapes[index].geometry {
        Geometry::Sphere { center, radius } => (center, radius),
        _ => panic!("not a sphere"),
    }
}

#[test]
fn missing_keys_have_their_defaults() {
    let scene = scene("a.toml", "# nothing\n");
    assert_eq!(scene.output, OutputDefaults::default());
    assert_eq!(
        (scene.background, scene.ambient),
        (Background::Color(Vec3::ZERO), Vec3::ZERO)
    );
    assert_eq!(scene.cameras, [Camera::default()]);
    assert_eq!(scene.materials, [Material::default()]);
    assert_eq!(scene.skipped, [""; 0]);

    let material = super::scene("a.toml", "[materials.a]").materials.remove(0);
    let shininess = 32.0;
    assert_eq!(
        material,
        Material {
            name: "a".to_owned(),
            bsdf: Phong {
                shininess,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        }
    );
}

#[test]
fn every_key_is_heard() {
    let scene = scene(
        "a.toml",
        r##"
        background = [0.5, 0.25, 2]
        ambient = "#ffffff"
        output = { size = [320, 200], samples = 9, exposure_ev = -1.5, tone = "agx", path_tone = "neutral", transfer = "linear" }
        [[cameras]]
        name = "a"
        look_from = [1, 2, 3]
        look_at = [1, 2, 0]
        up = [0, 5, 0]
        fov_y_deg = 90
        [[cameras]]
        look_from = [0, 9, 0]
        look_at = [0, 0, 0]
        up = [0, 0, -1]
        [materials.m]
        phong = { diffuse = [1, 0, 0], specular = [0, 1, 0], shininess = 7.5, ambient = [0, 0, 1] }
        two_sided = false
        two_sided_emission = false
        [[objects]]
        plane = { point = [0, -1, 0] }
        material = "m"
        [[objects]]
        sphere = { center = [0, 0, 0], radius = 2 }
        material = { phong = { diffuse = "#000000" } }
        [[lights]]
        point = { position = [1, 1, 1], color = [1, 0.5, 0.25], intensity = 4 }
        [[lights]]
        directional = { direction = [0, -2, 0] }
        [[lights]]
        spot = { position = [0, 5, 0], look_at = [0, 0, 0], inner_deg = 45, outer_deg = 90, attenuation = "none" }
        "##,
    );
    assert_eq!(
        scene.background,
        Background::Color(Vec3::new(0.5, 0.25, 2.0))
    );
    assert_eq!(scene.ambient, Vec3::ONE);
    let output = OutputDefaults {
        size: (320, 200),
        samples: 9,
        exposure_ev: -1.5,
        tone: Some(ToneCurve::Agx),
        path_tone: ToneCurve::Neutral,
        transfer: Transfer::Linear,
        ..OutputDefaults::default()
    };
    assert_eq!(scene.output, output);
    assert_eq!(scene.cameras[0].name, "a");
    assert_eq!(scene.cameras[0].up.normalize(), DVec3::Y);
    assert_eq!(scene.cameras[0].fov_y, 90_f64.to_radians());
    assert_eq!(scene.cameras[1].fov_y, 60_f64.to_radians());
    let named = Material {
        name: "m".to_owned(),
        two_sided: false,
        two_sided_emission: false,
        bsdf: Phong {
            diffuse: Vec3::X,
            specular: Vec3::Y,
            shininess: 7.5,
            ambient: Vec3::Z,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    assert_eq!(scene.materials[0], named);
    assert_eq!(
        scene.materials[scene.shapes[1].material]
            .classical()
            .diffuse,
        Vec3::ZERO
    );
    let plane = Geometry::Plane {
        point: DVec3::NEG_Y,
        normal: DVec3::Y,
    };
    assert_eq!(scene.shapes[0].geometry, plane);
    assert_eq!(scene.lights[0].color, Vec3::new(4.0, 2.0, 1.0));
    assert_eq!(scene.lights[0].attenuation, Attenuation::InverseSquare);
    assert_eq!(
        scene.lights[1].kind,
        LightKind::Directional {
            direction: DVec3::NEG_Y
        }
    );
    assert_eq!(scene.lights[1].attenuation, Attenuation::None);
    let spot = LightKind::Spot {
        position: DVec3::new(0.0, 5.0, 0.0),
        direction: DVec3::NEG_Y,
        inner: 45_f64.to_radians(),
        outer: 90_f64.to_radians(),
    };
    assert_eq!(scene.lights[2].kind, spot);
    assert_eq!(scene.lights[2].attenuation, Attenuation::None);
}

#[test]
fn hex_colors_are_srgb_and_lists_linear() {
    let Background::Color(hex) = scene("a.toml", "background = '#00ff80'").background else {
        panic!("a colour");
    };
    assert!(
        (hex - Vec3::new(0.0, 1.0, 0.215_86)).length() < 1e-5,
        "{hex}"
    );
    let list = scene("a.toml", "background = [0, 1, 0.5]").background;
    assert_eq!(list, Background::Color(Vec3::new(0.0, 1.0, 0.5)));
}

#[test]
fn ambient_defaults_to_diffuse() {
    let scene = scene("a.toml", "materials.a.phong.diffuse = [0.1, 0.2, 0.3]");
    assert_eq!(
        scene.materials[0].classical().ambient,
        Vec3::new(0.1, 0.2, 0.3)
    );
}

#[test]
fn transforms_scale_then_rotate_about_x_y_z_then_move() {
    let text = "
        [[objects]]
        sphere = { center = [0, 1, 0], radius = 1 }
        transform = { scale = 2, rotate_deg = [90, 90, 0], translate = [10, 0, 0] }
        [[objects]]
        plane = { point = [0, 0, 0], normal = [1, 1, 0] }
        transform = { scale = [2, 1, 1] }
        [[objects]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], normals = [[0, 0, 1], [0, 0, 1], [0, 0, 1]] }
        transform = { scale = [1, 1, -1], rotate_deg = [0, 0, 90], translate = [0, 0, 5] }";
    let scene = scene("a.toml", text);
    // y, scaled to 2y, goes to 2z by the rotation about x, then to 2x by the one about y.
    let (center, radius) = sphere(&scene, 0);
    assert!(
        center.distance(DVec3::new(12.0, 0.0, 0.0)) < 1e-12,
        "{center}"
    );
    assert_eq!(radius, 2.0);
    let Geometry::Plane { normal, .. } = scene.shapes[1].geometry else {
        panic!("not a plane");
    };
    assert!(
        normal.distance(DVec3::new(1.0, 2.0, 0.0).normalize()) < 1e-12,
        "{normal}"
    );
    let mesh = &scene.meshes[0];
    let world = |i: usize| {
        scene.instances[0]
            .placement
            .transform_point3(mesh.positions[i].as_dvec3())
    };
    assert!(world(1).distance(DVec3::new(0.0, 1.0, 5.0)) < 1e-6);
    assert_eq!(
        mesh.normals,
        [Vec3::NEG_Z; 3],
        "a mirrored surface faces the other way"
    );
}

#[test]
fn triangles_are_flat_unless_they_have_normals_and_may_blend_materials() {
    let text = "
        [materials]
        a = {}
        b = {}
        [[objects]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 1]], materials = ['a', 'b', 'a'] }
        [[objects]]
        triangle = { vertices = [[0, 0, 0], [1, 1, 1], [2, 2, 2]] }
        [[objects]]
        triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }
        visible = false";
    let scene = scene("a.toml", text);
    assert_eq!(scene.triangle_count(), 1);
    let half = FRAC_1_SQRT_2 as f32;
    assert_eq!(
        scene.meshes[0].normals[..3],
        [Vec3::new(0.0, -half, half); 3]
    );
    assert_eq!(scene.meshes[0].materials[..3], [0, 1, 0]);
    assert_snapshot!(scene.skipped.join("\n"), @"dropped 1 triangle without area");
}

#[test]
fn a_scene_without_a_camera_is_framed() {
    let scene = scene(
        "a.toml",
        "objects = [{ sphere = { center = [7, 8, 9], radius = 2 } }]",
    );
    let camera = &scene.cameras[0];
    assert!(camera.look_at.distance(DVec3::new(7.0, 8.0, 9.0)) < 1e-12);
    let distance = camera.look_from.distance(camera.look_at);
    assert!(
        (2.0 / distance).asin() < camera.fov_y / 2.0,
        "all of the sphere is seen"
    );
    assert!(distance < 20.0, "and not from afar");
}

#[test]
fn meshes_come_from_files_beside_the_scene() {
    let model: &[u8] = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    let native = b"
        [materials.blue]
        phong = { diffuse = [0, 0, 1] }
        [[objects]]
        mesh = { file = 'models/m.obj' }
        [[objects]]
        mesh = { file = './models/m.obj' }
        transform = { translate = [5, 0, 0] }
        [[objects]]
        mesh = { file = 'models\\m.obj' }
        material = 'blue'";
    let folder = folder(&[
        ("a.toml", native),
        ("models/m.obj", model),
        ("models/m.mtl", b"newmtl red\nKd 1 0 0\n"),
    ]);
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    assert_eq!(scene.instances.len(), 3);
    assert_eq!(scene.meshes.len(), 2, "the same mesh is read once");
    assert_eq!(scene.instances[1].placement.translation.x, 5.0);
    let diffuse = |mesh: usize| {
        scene.materials[scene.meshes[mesh].materials[0] as usize]
            .classical()
            .diffuse
    };
    assert_eq!(diffuse(1), Vec3::Z);
    assert_eq!(
        diffuse(0),
        Vec3::X,
        "names in a model are relative to the model"
    );
}

#[test]
fn overrides_replace_and_add_values() {
    let text = "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }";
    let overrides = [
        "camera.fov_y_deg=30",
        "camera.look_from = [0, 0, 9]",
        "objects.0.sphere.radius=2",
        "output.tone=aces",
        "output.transfer='linear'",
        "background=#ffffff",
        "materials.new.two_sided=false",
        "objects.0.material=new",
    ];
    let scene = with(&overrides, text).expect("a scene");
    assert_eq!(scene.cameras[0].fov_y, 30_f64.to_radians());
    assert_eq!(scene.cameras[0].look_from.z, 9.0);
    assert_eq!(sphere(&scene, 0).1, 2.0);
    assert_eq!(scene.output.tone, Some(ToneCurve::Aces));
    assert_eq!(scene.output.transfer, Transfer::Linear);
    assert_eq!(scene.background, Background::Color(Vec3::ONE));
    assert!(!scene.materials[0].two_sided);
}

#[test]
fn every_invalid_override_has_a_message() {
    let text = "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\n[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }";
    let overrides = [
        "",
        "camera",
        "=3",
        "camera..x=3",
        "camera.fov_y_deg=",
        "camera.fov_y_deg=wide",
        "camera.fov_y_deg=[",
        "camera.fov_y_deg=1\nambient=[1,1,1]",
        "camera.fov_y_deg.x=1",
        "camera.fov=3",
        "objects=3",
        "objects.0=3",
        "objects.1.sphere.radius=3",
        "objects.first.sphere.radius=3",
        "objects.0.sphere.radius=-3",
        "objects.0.material=gold",
        "camera.look_at=[0, 0, 5]",
    ];
    let message = |text_of: &&str| match with(&[text_of], text) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    };
    let lines: Vec<_> = overrides.iter().map(message).collect();
    assert_snapshot!(lines.join("\n"), @r#"
override refused (override): the file is empty. Check that it was written completely.
override refused (override:1:1): `camera` has no `=`. Write KEY=VALUE, such as camera.fov_y_deg=30.
override refused (override:1:1): `` is not a key. Write KEY=VALUE, such as camera.fov_y_deg=30.
override refused (override:1:1): `camera..x` is not a key. Write KEY=VALUE, such as camera.fov_y_deg=30.
override refused (override:1:18): `` is not a TOML value. Write it as in a scene file, strings in quotes.
override refused (override:1:18): invalid type: string "wide", expected a number. See `glimray schema` for what is allowed.
override refused (override:1:18): `[` is not a TOML value. Write it as in a scene file, strings in quotes.
override refused (override:1:18): `1\nambient=[1,1,1]` is not a TOML value. Write it as in a scene file, strings in quotes.
override refused (override:1:20): invalid type: map, expected a number. See `glimray schema` for what is allowed.
override refused (override:1:1): unknown key `fov`. Allowed here: `name`, `look_from`, `look_at`, `carried_by`, `up`, `fov_y_deg`, `fov_y`, `orthographic`, `near`, `far`, `default`, `lens`.
override refused (override:1:9): invalid type: integer `3`, expected a sequence. See `glimray schema` for what is allowed.
override refused (override:1:1): `objects` is a list. See the scene for its keys.
override refused (override:1:1): there is no `objects.1`: the list has 1, counted from 0. See the scene for its keys.
override refused (override:1:1): there is no `objects.first`: the list has 1, counted from 0. See the scene for its keys.
override refused (override:1:25): -3 is not greater than 0. See `glimray schema` for what is allowed.
override refused (override:1:20): unknown material `gold`. Add it under [materials], or use an existing one.
override refused (override:1:16): `look_at` is the same point as `look_from`. Move one of them.
"#);

    let folder = folder(&[("a.scene", b"0 amb: 0 0 0")]);
    let options = Options {
        overrides: vec!["a=1".to_owned()],
        ..Options::default()
    };
    assert_snapshot!(message_in(&folder, "a.scene", &options), @"override refused (a.scene): only native scenes (.toml) have keys to set. Leave out the overrides.");
}

#[test]
fn an_embedded_scene_cannot_read_files() {
    let error = with(&[], "objects = [{ mesh = { file = 'Cargo.toml' } }]").expect_err("refused");
    assert_snapshot!(error, @"mesh file refused (embedded.toml:1:30): `Cargo.toml`: a built-in scene has no folder. Name a plain file in the scene folder.");
}

#[test]
fn every_invalid_value_has_a_message() {
    let object = |surface: &str| format!("[[objects]]\n{surface}");
    let light = |light: &str| format!("[[lights]]\n{light}");
    let texts = [
        String::new(),
        " \r\n\t".to_owned(),
        "background = ".to_owned(),
        "background = [0, 0, 0]\nbackground = [0, 0, 0]".to_owned(),
        "[camera".to_owned(),
        "background = [0, 0".to_owned(),
        "background = [0, 0]".to_owned(),
        "background = [0, 0, 0, 0]".to_owned(),
        "background = [0, 0, -0.5]".to_owned(),
        "background = [0, 0, nan]".to_owned(),
        "background = [0, 0, -inf]".to_owned(),
        "background = [0, 0, 1e400]".to_owned(),
        "background = [0, 0, 1e39]".to_owned(),
        "background = [0, 0, 'blue']".to_owned(),
        "background = 'blue'".to_owned(),
        "background = '#12345'".to_owned(),
        "background = 0.5".to_owned(),
        "backgruond = [0, 0, 0]".to_owned(),
        "zebra = 1".to_owned(),
        "output.size = [0, 480]".to_owned(),
        "output.size = [640.5, 480]".to_owned(),
        "output.size = [640, 480, 3]".to_owned(),
        "output.samples = 0".to_owned(),
        "output.samples = 100000".to_owned(),
        "output.exposure_ev = 99".to_owned(),
        "output.tone = 'filmic'".to_owned(),
        "output.transfer = 'sRGB'".to_owned(),
        "camera = { look_from = [0, 0, 1], look_at = [0, 0, 0], fov_y_deg = 180 }".to_owned(),
        "camera = { look_from = [0, 0, 1], look_at = [0, 0, 0], fov = 60 }".to_owned(),
        "camera = { look_at = [0, 0, 0] }".to_owned(),
        "materials.a.phong.shininess = -1".to_owned(),
        "materials.a.phong.colour = '#ff0000'".to_owned(),
        "materials.a.two_sided = 1".to_owned(),
        "materials = [1, 2]".to_owned(),
        object("sphere = { center = [0, 0, 0], radius = 0 }"),
        object("sphere = { center = [0, 0, 0], radius = -2 }"),
        object("sphere = { center = [0, 0, 0], radius = '2' }"),
        object("sphere = { centre = [0, 0, 0], radius = 1 }"),
        object("sphere = { center = [0, 0, 0] }"),
        object("plane = { point = [0, 0, 0], normal = [0, 0, 0] }"),
        object("triangle = { vertices = [[0, 0, 0], [1, 0, 0]] }"),
        object("triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] }"),
        object("transform = { scale = 0 }"),
        object("transform = { scale = [1, 0, 1] }"),
        object("transform = { scale = true }"),
        object("material = 3"),
        object("material = { fong = {} }"),
        light("point = { position = [0, 0, 0], intensity = -1 }"),
        light("point = { position = [0, 0, 0], colour = [1, 1, 1] }"),
        light("point = { position = [0, 0, 0], attenuation = 'linear' }"),
        light("directional = { direction = [0, 0, 0] }"),
        light("spot = { position = [0, 0, 0], look_at = [0, 0, 1], outer_deg = 91 }"),
        light("spot = { position = [0, 0, 0], look_at = [0, 0, 1], outer_deg = 0 }"),
        light("spot = { position = [0, 0, 0], look_at = [0, 0, 1], outer = 0 }"),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r##"
bad scene (a.toml): the file is empty. Check that it was written completely.
bad scene (a.toml): the file is empty. Check that it was written completely.
bad scene (a.toml:1:14): string values must be quoted, expected literal string. See https://toml.io for the syntax.
bad scene (a.toml:2:1): duplicate key. See https://toml.io for the syntax.
bad scene (a.toml:1:8): unclosed table, expected `]`. See https://toml.io for the syntax.
bad scene (a.toml:1:19): unclosed array, expected `]`. See https://toml.io for the syntax.
bad scene (a.toml:1:14): expected three numbers [r, g, b], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): expected three numbers [r, g, b], found more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): -0.5 in a colour is negative. See `glimray schema` for what is allowed.
bad scene (a.toml:1:21): NaN is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:1:21): -inf is not a finite number. See `glimray schema` for what is allowed.
bad scene (a.toml:1:21): floating-point number overflowed. See `glimray schema` for what is allowed.
bad scene (a.toml:1:21): 1e39 is out of range: at most 3.4e38 is allowed. See `glimray schema` for what is allowed.
bad scene (a.toml:1:21): invalid type: string "blue", expected a number. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): `blue` is not a colour: write "#rrggbb" or [r, g, b]. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): `#12345` is not a colour: write "#rrggbb" or [r, g, b]. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): invalid type: floating point `0.5`, expected a colour ([r, g, b] or "#rrggbb"), a gradient, a picture or a built-in environment such as "sky". See `glimray schema` for what is allowed.
bad scene (a.toml:1:1): unknown key `backgruond`, did you mean `background`? Allowed here: `output`, `background`, `ambient`, `shadows`, `section`, `staged`, `camera`, `cameras`, `textures`, `materials`, `meshes`, `nodes`, `groups`, `objects`, `lights`, `animation`.
bad scene (a.toml:1:1): unknown key `zebra`. Allowed here: `output`, `background`, `ambient`, `shadows`, `section`, `staged`, `camera`, `cameras`, `textures`, `materials`, `meshes`, `nodes`, `groups`, `objects`, `lights`, `animation`.
bad scene (a.toml:1:15): 0 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:1:15): 640.5 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:1:15): expected two numbers [width, height], found more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): 0 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:1:18): 100000 is not a whole number from 1 to 65536. See `glimray schema` for what is allowed.
bad scene (a.toml:1:22): 99 is not between -32 and 32. See `glimray schema` for what is allowed.
bad scene (a.toml:1:15): unknown value `filmic`. Allowed here: `none`, `aces`, `agx`, `reinhard`, `neutral`.
bad scene (a.toml:1:19): unknown value `sRGB`, did you mean `srgb`? Allowed here: `srgb`, `linear`.
bad scene (a.toml:1:68): 180 is not an angle between 0.001 and 179.999 degrees. See `glimray schema` for what is allowed.
bad scene (a.toml:1:56): unknown key `fov`. Allowed here: `name`, `look_from`, `look_at`, `carried_by`, `up`, `fov_y_deg`, `fov_y`, `orthographic`, `near`, `far`, `default`, `lens`.
bad scene (a.toml:1:10): the key `look_from` is missing. Add `look_from = …`.
bad scene (a.toml:1:31): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:19): unknown key `colour`. Allowed here: `diffuse`, `specular`, `shininess`, `ambient`.
bad scene (a.toml:1:25): invalid type: integer `1`, expected a boolean. See `glimray schema` for what is allowed.
bad scene (a.toml:1:13): invalid type: sequence, expected a map. See `glimray schema` for what is allowed.
bad scene (a.toml:2:41): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:41): -2 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:41): invalid type: string "2", expected a number. See `glimray schema` for what is allowed.
bad scene (a.toml:2:12): unknown key `centre`, did you mean `center`? Allowed here: `center`, `radius`.
bad scene (a.toml:2:10): the key `radius` is missing. Add `radius = …`.
bad scene (a.toml:2:39): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:25): expected three elements, one for each corner, found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:2:25): expected three elements, one for each corner, found more. See `glimray schema` for what is allowed.
bad scene (a.toml:2:23): a scale cannot be 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:23): a scale cannot be 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:23): invalid type: boolean `true`, expected a number or [x, y, z]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:12): invalid type: integer `3`, expected the name of a material, or a table. See `glimray schema` for what is allowed.
bad scene (a.toml:2:14): unknown key `fong`. Allowed here: `phong`, `pbr`, `reflect`, `refract`, `optics`, `normal_map`, `height_map`, `occlusion_map`, `thin`, `shadow_catcher`, `coverage`, `emission`, `two_sided`, `two_sided_emission`.
bad scene (a.toml:2:45): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:2:33): unknown key `colour`, did you mean `color`? Allowed here: `position`, `color`, `intensity`, `attenuation`.
bad scene (a.toml:2:47): unknown value `linear`. Allowed here: `none`, `inverse-square`.
bad scene (a.toml:2:29): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:65): 91 is not an angle between 0.05 and 90 degrees. See `glimray schema` for what is allowed.
bad scene (a.toml:2:65): 0 is not an angle between 0.05 and 90 degrees. See `glimray schema` for what is allowed.
bad scene (a.toml:2:61): 0 is not an angle between 0.0005 and pi/2 radians. See `glimray schema` for what is allowed.
"##);
}

#[test]
fn every_invalid_combination_has_a_message() {
    let camera = |rest: &str| format!("[camera]\nlook_from = [0, 1, 0]\n{rest}");
    let ball = "sphere = { center = [0, 0, 0], radius = 1 }";
    let triangle = "triangle = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]";
    let texts = [
        camera("look_at = [0, 1, 0]"),
        camera("look_at = [0, 0, 0]"),
        camera("look_at = [0, 0, 5]\nup = [0, 2, -10]"),
        camera("look_at = [0, 0, 5]\n[[cameras]]\nlook_from = [0, 0, 1]\nlook_at = [0, 0, 0]"),
        "[[cameras]]\nname = 'a'\nlook_from = [0, 0, 1]\nlook_at = [0, 0, 0]\n".repeat(2),
        "[[objects]]".to_owned(),
        format!("[[objects]]\n{ball}\nplane = {{ point = [0, 0, 0] }}"),
        format!("[materials.gold]\n[[objects]]\n{ball}\nmaterial = 'glod'"),
        format!("[[objects]]\n{ball}\nmaterial = 'gold'"),
        format!(
            "[materials.gold]\n[[objects]]\n{triangle}, materials = ['gold', 'gold', 'old'] }}"
        ),
        format!("[[objects]]\n{ball}\ntransform = {{ translate = [3.4e38, 0, 0], scale = 1e38 }}"),
        "[[lights]]".to_owned(),
        "[[lights]]\npoint = { position = [0, 0, 0] }\ndirectional = { direction = [0, 1, 0] }"
            .to_owned(),
        "[[lights]]\npoint = { position = [0, 0, 0], color = [9e20, 0, 0], intensity = 9e20 }"
            .to_owned(),
        "[[lights]]\nspot = { position = [1, 2, 3], look_at = [1, 2, 3] }".to_owned(),
        "[[lights]]\nspot = { position = [0, 0, 0], look_at = [0, 0, 1], inner_deg = 31 }"
            .to_owned(),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r"
bad scene (a.toml:3:11): `look_at` is the same point as `look_from`. Move one of them.
bad scene (a.toml:3:11): `up` is parallel to the viewing direction. Give the camera another `up`.
bad scene (a.toml:4:6): `up` is parallel to the viewing direction. Give the camera another `up`.
bad scene (a.toml:1:1): there are both `camera` and `cameras`. Use [[cameras]] for all of them.
bad scene (a.toml:5:1): duplicate camera name `a`. Rename one of them.
bad scene (a.toml:1:1): an object needs exactly one surface or group. Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`.
bad scene (a.toml:1:1): an object needs exactly one surface or group. Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`.
bad scene (a.toml:4:12): unknown material `glod`, did you mean `gold`? Add it under [materials], or use an existing one.
bad scene (a.toml:3:12): unknown material `gold`. Add it under [materials], or use an existing one.
bad scene (a.toml:3:89): unknown material `old`, did you mean `gold`? Add it under [materials], or use an existing one.
bad scene (a.toml:3:13): the object's coordinates are out of range: at most 3.4e38 is allowed. Make it smaller, or move it nearer to the origin.
bad scene (a.toml:1:1): a light needs exactly one kind. Give it one of `point`, `directional`, `spot`, `rectangle`, `disc` and `sphere`.
bad scene (a.toml:1:1): a light needs exactly one kind. Give it one of `point`, `directional`, `spot`, `rectangle`, `disc` and `sphere`.
bad scene (a.toml:1:1): `color` times `intensity` is out of range: at most 3.4e38 is allowed. Lower one of them.
bad scene (a.toml:2:42): `look_at` is the position of the spot light itself. Move one of them.
bad scene (a.toml:2:65): `inner_deg` is greater than `outer_deg`, which is 30. Give the inner cone the smaller angle.
");
}

#[test]
fn the_schema_knows_every_key() {
    let schema = import::native_schema();
    let text = serde_json::to_string(&schema).expect("JSON");
    assert_eq!(schema["title"], "glimray scene");
    assert_eq!(schema["additionalProperties"], false);
    // Serde lists the known keys in errors about unknown ones.
    let tables = [
        "?=1",
        "output.?=1",
        "camera.?=1",
        "materials.a.?=1",
        "materials.a.phong.?=1",
        "materials.a.reflect.?=1",
        "materials.a.refract.?=1",
        "materials.a.phong.diffuse={?=1}",
        "textures.a.?=1",
        "textures.a.checker={?=1}",
        "textures.a.noise={?=1}",
        "textures.a.picture={?=1}",
        "background={?=1}",
        "objects=[{?=1}]",
        "objects=[{sphere={?=1}}]",
        "objects=[{plane={?=1}}]",
        "objects=[{disc={?=1}}]",
        "objects=[{rectangle={?=1}}]",
        "objects=[{box={?=1}}]",
        "objects=[{cylinder={?=1}}]",
        "objects=[{cone={?=1}}]",
        "objects=[{torus={?=1}}]",
        "objects=[{triangle={?=1}}]",
        "objects=[{mesh={?=1}}]",
        "objects=[{transform={?=1}}]",
        "objects=[{repeat={?=1}}]",
        "objects=[{repeat={grid={?=1}}}]",
        "objects=[{repeat={ring={?=1}}}]",
        "objects=[{repeat={scatter={?=1}}}]",
        "groups={a=[{?=1}]}",
        "animation=[{?=1}]",
        "animation=[{property='on',keys=[{?=1}]}]",
        "lights=[{?=1}]",
        "lights=[{point={?=1}}]",
        "lights=[{directional={?=1}}]",
        "lights=[{spot={?=1}}]",
    ];
    for table in tables {
        let error = with(&[], &table.replace('?', "qqqqqq"))
            .expect_err("an unknown key")
            .to_string();
        let (_, known) = error
            .split_once("Allowed here: ")
            .unwrap_or_else(|| panic!("{error}"));
        for key in known.split('`').skip(1).step_by(2) {
            assert!(
                text.contains(&format!("\"{key}\":{{")),
                "{key} of {table} is in the schema"
            );
        }
    }
}
