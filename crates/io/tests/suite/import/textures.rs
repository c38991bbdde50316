//! Textures and backgrounds in native scenes and in models.

use super::{folder, messages, scene};
use glam::{DVec3, Vec2, Vec3};
use glimray::import;
use glimray::scene::{Background, Pattern, PhongTextures, Scene, Space};
use image::{DynamicImage, ImageBuffer, ImageFormat, Rgb};
use insta::assert_snapshot;
use std::io::Cursor;

pub(super) fn png() -> Vec<u8> {
    let image = ImageBuffer::from_pixel(2, 1, Rgb([255u8, 0, 0]));
    let mut bytes = Cursor::new(Vec::new());
    let image = DynamicImage::from(image);
    image
        .write_to(&mut bytes, ImageFormat::Png)
        .expect("a picture");
    bytes.into_inner()
}

#[test]
fn textures_are_named_or_inline() {
    let text = r##"
        [textures.tiles]
        checker = { a = [1, 0, 0], b = [0, 1, 0] }
        scale = 2
        rotate_deg = [0, 0, 90]
        translate = [10, 0, 0]
        [textures.sky]
        noise = { octaves = 7 }
        space = "uv"
        [materials.a.phong]
        diffuse = { texture = "tiles", color = [0.5, 0.5, 0.5] }
        specular = { stripes = { a = "#000000", b = [3, 3, 3] }, scale = [1, 2, 4] }
        [materials.b.phong]
        diffuse = { texture = "tiles" }
        ambient = { gradient = { b = [0.25, 0, 0] }, color = [2, 2, 2] }
        [materials.c.phong]
        diffuse = [0.1, 0.2, 0.3]
        "##;
    let scene = scene("a.toml", text);
    let names: Vec<_> = scene.textures.iter().map(|t| t.pattern.clone()).collect();
    // The named ones in the file's order, then the unnamed ones.
    let (white, black) = (Vec3::ONE, Vec3::ZERO);
    let expected = [
        Pattern::Checker {
            a: Vec3::X,
            b: Vec3::Y,
        },
        Pattern::Noise {
            a: white,
            b: black,
            octaves: 7,
        },
        Pattern::Stripes {
            a: black,
            b: Vec3::splat(3.0),
        },
        Pattern::Gradient {
            a: white,
            b: 0.25 * Vec3::X,
        },
    ];
    assert_eq!(names, expected);
    assert_eq!(scene.textures[1].space, Space::Uv);
    assert_eq!(scene.textures[0].space, Space::World);
    // (0.5, 0, 0) of the pattern is scaled to (1, 0, 0), turned to (0, 1, 0), moved to (10, 1, 0).
    let place = scene.textures[0].pattern_from_space;
    let p = place.transform_point3(DVec3::new(10.0, 1.0, 0.0));
    assert!(p.distance(DVec3::new(0.5, 0.0, 0.0)) < 1e-12, "{p}");
    let [a, b, c] = &scene.materials[..] else {
        panic!("three materials");
    };
    // The ambient colour defaults to the diffuse one with its texture.
    let both = PhongTextures {
        diffuse: Some(0),
        specular: Some(2),
        ambient: Some(0),
        ..PhongTextures::default()
    };
    assert_eq!(a.classical().textures, both);
    assert_eq!(
        (
            a.classical().diffuse,
            a.classical().specular,
            a.classical().ambient
        ),
        (Vec3::splat(0.5), white, Vec3::splat(0.5))
    );
    assert_eq!(
        (b.classical().diffuse, b.classical().ambient),
        (white, Vec3::splat(2.0))
    );
    assert_eq!(
        (
            b.classical().textures.diffuse,
            b.classical().textures.ambient
        ),
        (Some(0), Some(3))
    );
    assert_eq!(c.texture_indices().next(), None);
}

#[test]
fn a_background_may_be_a_gradient() {
    let text = "background = { bottom = [1, 0.5, 0], top = '#0000ff' }";
    let expected = Background::Gradient {
        bottom: Vec3::new(1.0, 0.5, 0.0),
        top: Vec3::Z,
    };
    assert_eq!(scene("a.toml", text).background, expected);
}

#[test]
fn a_background_may_be_the_sky() {
    let sky = |text: &str| {
        let scene = scene("a.toml", format!("background = {text}"));
        let Background::Picture {
            picture,
            strength,
            rotation,
        } = scene.background
        else {
            panic!("{text} is no picture");
        };
        (scene.pictures[picture].clone(), strength, rotation)
    };
    // The flag `--environment sky` has the same defaults.
    let default = glimray::scene::sky::picture(45_f64.to_radians(), -135_f64.to_radians());
    for text in ["'sky'", "{ sky = {} }", "{ sky = { elevation_deg = 45 } }"] {
        assert!(*sky(text).0 == default, "{text}");
    }
    let (found, strength, rotation) =
        sky("{ sky = { elevation_deg = 5, azimuth_deg = 30 }, strength = 2, rotation_deg = 180 }");
    let evening = glimray::scene::sky::picture(5_f64.to_radians(), 30_f64.to_radians());
    assert!(*found == evening);
    assert_eq!((strength, rotation), (2.0, std::f64::consts::PI));
}

/// Rows from the top: the surface rises to the right by 10 levels a texel, and upwards by 40.
fn rising() -> Vec<u8> {
    let image =
        image::GrayImage::from_fn(5, 4, |x, y| image::Luma([(10 * x + 40 * (3 - y)) as u8]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    let written = image.write_to(&mut bytes, image::ImageFormat::Png);
    written.expect("a picture");
    bytes.into_inner()
}

#[test]
fn height_maps_become_normal_maps_by_their_slopes() {
    for (map, sign, scale) in [
        ("{ picture = 'a.png' }", 1.0, 1.0),
        (
            "{ picture = { file = 'a.png', nearest = true }, strength = 2.5, scale = 2 }",
            1.0,
            2.5,
        ),
        ("{ picture = 'a.png', strength = -3 }", -1.0, 3.0),
    ] {
        let text = format!("[materials.a]\nheight_map = {map}");
        let folder = folder(&[("a.toml", text.as_bytes()), ("a.png", &rising())]);
        let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
        let material = &scene.materials[0];
        assert_eq!(material.normal_scale, scale);
        let texture = &scene.textures[material.textures.normal.expect("a map")];
        assert_eq!(texture.space, Space::Uv);
        let texel = scene.pictures[0].linear().nth(5 + 2).expect("a texel");
        let normal = 2.0 * texel.as_dvec4().truncate() - 1.0;
        let slopes = DVec3::new(-10.0 / 255.0 * sign, -40.0 / 255.0 * sign, 1.0);
        assert!(
            (normal - slopes.normalize()).length() < 1e-3,
            "{map}: {normal}"
        );
        // The file beside an export is the one that was read.
        let export = glimray::export::native(&scene, "s", &|_, _| false).expect("an export");
        assert!(
            export.text.contains("height_map = { picture = "),
            "{}",
            export.text
        );
        crate::export::loss(&scene).unwrap_or_else(|lost| panic!("{lost}"));
    }
}

#[test]
fn every_invalid_texture_has_a_message() {
    let diffuse = |value: &str| format!("[materials.a]\nphong.diffuse = {value}");
    let texts = [
        diffuse("0.5"),
        diffuse("'blue'"),
        diffuse("[1, 0]"),
        diffuse("{}"),
        diffuse("{ color = [1, 0, 0] }"),
        diffuse("{ checker = {}, stripes = {} }"),
        diffuse("{ cheker = {} }"),
        diffuse("{ checker = { c = [0, 0, 0] } }"),
        diffuse("{ checker = { a = [0, 0, -1] } }"),
        diffuse("{ noise = { octaves = 0 } }"),
        diffuse("{ noise = { octaves = 17 } }"),
        diffuse("{ noise = { octaves = 2.5 } }"),
        diffuse("{ checker = {}, scale = 0 }"),
        diffuse("{ checker = {}, space = 'object' }"),
        diffuse("{ picture = 'gone.png' }"),
        diffuse("{ picture = 3 }"),
        diffuse("{ picture = { nearest = true } }"),
        diffuse("{ picture = { file = 'gone.png' } }"),
        diffuse("{ texture = 'tile' }\n[textures.tiles]\nchecker = {}"),
        diffuse("{ texture = 'tiles' }"),
        diffuse("{ texture = 'tiles', noise = {} }\n[textures.tiles]\nchecker = {}"),
        diffuse("{ texture = 'tiles', scale = 3 }\n[textures.tiles]\nchecker = {}"),
        diffuse("{ checker = { a = [1e30, 0, 0] }, color = [1e30, 0, 0] }"),
        "background = 'skyy'".to_owned(),
        "background = { sky = { elevation_deg = 91 } }".to_owned(),
        "background = { sky = {}, picture = 'gone.png' }".to_owned(),
        "[materials.a]\nheight_map = { texture = 'tiles' }".to_owned(),
        "[materials.a]\nheight_map = { picture = 'a.png', space = 'world' }".to_owned(),
        "[materials.a]\nheight_map = { picture = 'a.png' }\nnormal_map = { picture = 'a.png' }"
            .to_owned(),
        "[textures.a]".to_owned(),
        "[textures.a]\ntexture = 'b'".to_owned(),
        "textures = 3".to_owned(),
        "background = {}".to_owned(),
        "background = { bottom = [0, 0, 0] }".to_owned(),
        "background = { bottom = [0, 0, 0], top = [0, 0, 0], strength = 2 }".to_owned(),
        "background = { strength = 2 }".to_owned(),
        "background = { up = [0, 0, 0] }".to_owned(),
        "background = { picture = 'gone.hdr' }".to_owned(),
        "background = { picture = 'gone.hdr', strength = -1 }".to_owned(),
        "background = { picture = 'gone.hdr', strength = 1e37 }".to_owned(),
        "background = { picture = 'gone.hdr', rotation_deg = 'left' }".to_owned(),
    ];
    assert_snapshot!(messages("a.toml", &texts), @r##"
bad scene (a.toml:2:17): invalid type: floating point `0.5`, expected a colour ([r, g, b] or "#rrggbb") or a texture. See `glimray schema` for what is allowed.
bad scene (a.toml:2:17): `blue` is not a colour: write "#rrggbb" or [r, g, b]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:17): expected three numbers [r, g, b], found fewer. See `glimray schema` for what is allowed.
bad scene (a.toml:2:17): a texture needs exactly one pattern. Give it one of `checker`, `stripes`, `gradient`, `noise` and `picture`.
bad scene (a.toml:2:17): a texture needs exactly one pattern. Give it one of `checker`, `stripes`, `gradient`, `noise` and `picture`.
bad scene (a.toml:2:17): a texture needs exactly one pattern. Give it one of `checker`, `stripes`, `gradient`, `noise` and `picture`.
bad scene (a.toml:2:19): unknown key `cheker`, did you mean `checker`? Allowed here: `texture`, `color`, `checker`, `stripes`, `gradient`, `noise`, `picture`, `space`, `scale`, `rotate_deg`, `translate`, `pattern_from_space`.
bad scene (a.toml:2:31): unknown key `c`, did you mean `a`? Allowed here: `a`, `b`.
bad scene (a.toml:2:35): -1 in a colour is negative. See `glimray schema` for what is allowed.
bad scene (a.toml:2:39): 0 is not a whole number from 1 to 16. See `glimray schema` for what is allowed.
bad scene (a.toml:2:39): 17 is not a whole number from 1 to 16. See `glimray schema` for what is allowed.
bad scene (a.toml:2:39): 2.5 is not a whole number from 1 to 16. See `glimray schema` for what is allowed.
bad scene (a.toml:2:41): a scale cannot be 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:41): unknown value `object`. Allowed here: `world`, `uv`, `second-uv`.
picture refused (a.toml:2:29): `gone.png` does not exist. Check the name and the folder.
bad scene (a.toml:2:29): invalid type: integer `3`, expected the name of a picture file, or a table. See `glimray schema` for what is allowed.
bad scene (a.toml:2:29): the key `file` is missing. Add `file = …`.
picture refused (a.toml:2:38): `gone.png` does not exist. Check the name and the folder.
bad scene (a.toml:2:29): unknown texture `tile`, did you mean `tiles`? Add it under [textures], or use an existing one.
bad scene (a.toml:2:29): unknown texture `tiles`. Add it under [textures], or use an existing one.
bad scene (a.toml:2:29): a named texture has its own pattern and transform. Put them under [textures], or leave out `texture`.
bad scene (a.toml:2:29): a named texture has its own pattern and transform. Put them under [textures], or leave out `texture`.
bad scene (a.toml:2:17): `color` times the texture is out of range: at most 3.4e38 is allowed. Lower one of them.
bad scene (a.toml:1:14): `skyy` is not a colour: write "#rrggbb" or [r, g, b]. See `glimray schema` for what is allowed.
bad scene (a.toml:1:22): the sun stands at most 90 degrees above the horizon, and not below it. Give it an `elevation_deg` from 0 to 90.
bad scene (a.toml:1:14): a background needs a colour, a gradient, a picture or a sky. Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`.
bad scene (a.toml:2:16): unknown key `texture`. Allowed here: `picture`, `strength`, `space`, `scale`, `rotate_deg`, `translate`, `pattern_from_space`.
bad scene (a.toml:2:14): a map of numbers has its place by u and v. Leave out `space`.
bad scene (a.toml:2:14): a surface has a normal map or a height map. Leave out one of them.
bad scene (a.toml:1:1): a texture needs exactly one pattern. Give it one of `checker`, `stripes`, `gradient`, `noise` and `picture`.
bad scene (a.toml:2:1): unknown key `texture`. Allowed here: `checker`, `stripes`, `gradient`, `noise`, `picture`, `space`, `scale`, `rotate_deg`, `translate`, `pattern_from_space`.
bad scene (a.toml:1:12): invalid type: integer `3`, expected a map. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): a background needs a colour, a gradient, a picture or a sky. Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`.
bad scene (a.toml:1:14): a background needs a colour, a gradient, a picture or a sky. Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`.
bad scene (a.toml:1:14): a background needs a colour, a gradient, a picture or a sky. Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`.
bad scene (a.toml:1:14): a background needs a colour, a gradient, a picture or a sky. Give it `bottom` and `top`, or `picture`, `environment` or `sky` with `strength` and `rotation_deg`.
bad scene (a.toml:1:16): unknown key `up`. Allowed here: `bottom`, `top`, `picture`, `environment`, `sky`, `strength`, `rotation_deg`, `rotation`.
picture refused (a.toml:1:26): `gone.hdr` does not exist. Check the name and the folder.
bad scene (a.toml:1:49): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:1:14): `strength` is out of range: at most 5e33 is allowed. Lower it.
bad scene (a.toml:1:53): invalid type: string "left", expected a number. See `glimray schema` for what is allowed.
"##);
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

fn model(files: &[(&str, &[u8])]) -> Scene {
    let folder = folder(files);
    let path = folder.path().join(files[0].0);
    import::load(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn models_have_their_textures() {
    let text =
        format!("mtllib m/a.mtl\n{SQUARE}usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1/ 3/3/ 4/4/\n");
    let library = b"newmtl a\nKd 0.5 1 1\nmap_Kd -clamp on -s 2 2 1 my red.png\nmap_bump x.png\n\
                    newmtl b\nmap_Kd -mm 0 1 .\\my red.png\nmap_Ks my red.png\nKa 0.1 0.1 0.1\n\
                    newmtl unused\nmap_Kd gone.png\n";
    let png = png();
    let scene = model(&[
        ("a.obj", text.as_bytes()),
        ("m/a.mtl", library),
        ("m/my red.png", &png),
    ]);
    // One of them is scaled.
    assert_eq!((scene.pictures.len(), scene.textures.len()), (1, 2));
    let [a, b, _ground] = &scene.materials[..] else {
        panic!("two materials");
    };
    assert_eq!(a.classical().diffuse, Vec3::new(0.5, 1.0, 1.0));
    assert_eq!(
        (
            a.classical().textures.diffuse,
            a.classical().textures.specular
        ),
        (Some(0), None)
    );
    assert_eq!(a.classical().textures.ambient, Some(0));
    // A colour that is not given is white if there is a texture.
    assert_eq!(
        (b.classical().diffuse, b.classical().specular),
        (Vec3::ONE, Vec3::ONE)
    );
    assert_eq!(
        (
            b.classical().textures.diffuse,
            b.classical().textures.specular
        ),
        (Some(1), Some(1))
    );
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.uvs.len(), mesh.positions.len());
    for (p, uv) in mesh.positions.iter().zip(&mesh.uvs) {
        assert_eq!(p.truncate(), *uv, "here u is x and v is y");
    }
    assert_snapshot!(scene.skipped.join("\n"), @"texture skipped: `x.png` does not exist");
}

#[test]
fn a_model_keeps_its_u_and_v_though_no_texture_uses_them() {
    let faces = "f 1/1 2/2 3/3\nf 1/4 3/2 4/1\n";
    let plain = model(&[("a.obj", format!("{SQUARE}{faces}").as_bytes())]);
    assert_eq!(plain.skipped, Vec::<String>::new());
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl a\n{faces}");
    let library: &[u8] = b"newmtl a\nmap_Kd a.png\n";
    let png = png();
    let files = [
        ("a.obj", text.as_bytes()),
        ("a.mtl", library),
        ("a.png", &png),
    ];
    let shown = model(&files);
    // Two corners of the square have other coordinates in its second half.
    for scene in [&plain, &shown] {
        let mesh = &scene.meshes[0];
        let corners = mesh
            .triangles
            .iter()
            .flatten()
            .map(|corner| *corner as usize);
        let found: Vec<_> = corners
            .map(|i| (mesh.positions[i].truncate(), mesh.uvs[i]))
            .collect();
        let [a, b, c, d] = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        let expected = [(a, a), (b, b), (c, c), (a, d), (c, b), (d, a)];
        assert_eq!((mesh.positions.len(), &found[..]), (6, &expected[..]));
    }

    // So it does with another material.
    for space in ["world", "uv"] {
        let native = format!(
            "[[objects]]\nmesh = {{ file = 'a.obj' }}\nmaterial = {{ phong = {{ diffuse = {{ checker = {{}}, space = '{space}' }} }} }}"
        );
        let scene = model(&[("s.toml", native.as_bytes()), files[0], files[1], files[2]]);
        assert_eq!(scene.meshes[0].uvs, shown.meshes[0].uvs);
        assert_eq!((scene.pictures.len(), scene.textures.len()), (0, 1));
    }
    let native = b"textures.t.checker = {}\nmaterials.m.phong.diffuse = { texture = 't' }\n\
                   [[objects]]\nmesh = { file = 'a.obj' }\n";
    let scene = model(&[("s.toml", native), files[0], files[1], files[2]]);
    assert_eq!((scene.pictures.len(), scene.textures.len()), (1, 2));
    assert_eq!(scene.materials[1].classical().textures.diffuse, Some(1));
}

#[test]
fn unreadable_textures_of_models_are_skipped() {
    let text = format!(
        "mtllib a.mtl\n{SQUARE}usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\nusemtl c\nf 1/1 2/2 4/4\nusemtl d\nf 2/2 3/3 4/4\n"
    );
    let library = b"newmtl a\nKd 1 0 0\nmap_Kd gone.png\nnewmtl b\nmap_Kd C:\\pictures\\x.png\n\
                    newmtl c\nmap_Kd broken.png\nnewmtl d\nmap_Kd\nmap_Ks -s 1\n";
    let scene = model(&[
        ("a.obj", text.as_bytes()),
        ("a.mtl", library),
        ("broken.png", b"not a picture"),
    ]);
    assert_eq!(scene.triangle_count(), 4);
    assert!(scene.textures.is_empty());
    assert_snapshot!(scene.skipped.join("\n"), @r"
`map_Kd`: pictures without a file skipped: 1 (line 9 of a.mtl)
`map_Ks`: pictures without a file skipped: 1 (line 10 of a.mtl)
texture skipped: `gone.png` does not exist
texture skipped: `C:\pictures\x.png` points outside the scene folder
texture skipped: `broken.png` is not a supported image
");
}

#[test]
fn texture_coordinates_are_numbers() {
    let texts = [
        "vt",
        "vt a",
        "vt 0 b",
        "vt 1e400",
        "vt 1e38 -1e38 5\nv 0 0 0",
    ];
    assert_snapshot!(messages("a.obj", &texts), @r"
bad model (a.obj:1:1): `vt` needs a number. Write `vt U V`.
bad model (a.obj:1:4): `a` is not a number. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:6): `b` is not a number. Write a decimal number such as -0.5 or 2e3.
bad model (a.obj:1:4): `1e400` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.
no error
");
}

#[test]
fn single_triangles_have_their_own_u_and_v_if_a_texture_uses_them() {
    for (space, expected) in [("uv", &[Vec2::ZERO, Vec2::X, Vec2::Y][..]), ("world", &[])] {
        let text = format!(
            "[[objects]]\ntriangle = {{ vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }}\n\
             material.phong.diffuse = {{ checker = {{}}, space = '{space}' }}"
        );
        assert_eq!(scene("a.toml", text).meshes[0].uvs, expected);
    }
}

#[test]
fn a_picture_on_a_model_without_texture_coordinates_is_reported() {
    let files: [(&str, &[u8]); 2] = [
        (
            "s.toml",
            b"[[objects]]\nmesh = { file = 'a.obj' }\nmaterial.phong.diffuse = { noise = {}, space = 'uv' }",
        ),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"),
    ];
    assert_snapshot!(model(&files).skipped.join("\n"), @"`a.obj`: no texture coordinates: each texture shows a single colour");
}
