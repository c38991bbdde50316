//! Features of the native format for exported scenes: nodes, PLY files, exact values; and the list of
//! files that a scene depends on.

use super::{folder, message_in, messages, scene};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{Geometry, Mixing, NodeProperty, Target};

const CAMERA: &str = "camera = { look_from = [0, 0, 9], look_at = [0, 0, 0] }\n";

const PLY: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\n\
    property float y\nproperty float z\nproperty uchar material\nelement face 2\n\
    property list uchar int vertex_indices\nend_header\n\
    0 0 0 0\n1 0 0 0\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 0 2 3\n";

#[test]
fn nodes_move_objects_lights_and_cameras() {
    let text = r#"
        camera = { look_from = [0, 0, 9], look_at = "hand", carried_by = "arm" }
        nodes = [
            { name = "arm", transform = { translate = [1, 0, 0] } },
            { name = "hand", carried_by = "arm", placement = { matrix = [[2, 0, 0], [0, 2, 0], [0, 0, 2], [0, 3, 0]] } },
        ]
        objects = [
            { sphere = { center = [0, 0, 1], radius = 1 }, carried_by = "hand" },
            { sphere = { center = [0, 0, 1], radius = 1 } },
        ]
        lights = [{ point = { position = [0, 0, 0] }, carried_by = "hand" }]
        animation = [{ objects = ["arm", "hand"], property = "angles", keys = [[0, [0, 0, 0]], [1, [0, 3, 0]]] }]
    "#;
    let scene = scene("a.toml", text);
    assert_eq!(scene.nodes[1].parent, Some(0));
    assert_eq!(scene.shapes[0].node, Some(1));
    assert_eq!(
        (scene.shapes[1].node, scene.lights[0].node),
        (None, Some(1))
    );
    assert_eq!(
        (scene.cameras[0].node, scene.cameras[0].target),
        (Some(0), Some(1))
    );
    let angles = [0, 1].map(|node| Target::Node(node, NodeProperty::Angles));
    assert_eq!(scene.tracks[0].targets, angles);
    let light = &scene.frame(0.0).lights[0];
    let place = glimray::scene::LightKind::Point {
        position: DVec3::new(1.0, 3.0, 0.0),
    };
    assert_eq!(light.kind, place);
}

#[test]
fn ply_files_are_read_as_text_and_binary_alike_with_materials_by_number() {
    let header = PLY.replace("ascii", "binary_big_endian");
    let (header, _) = header.split_at(header.find("end_header\n").expect("it ends") + 11);
    let mut binary = header.as_bytes().to_vec();
    for (x, y, material) in [
        (0.0_f32, 0.0_f32, 0),
        (1.0, 0.0, 0),
        (1.0, 1.0, 1),
        (0.0, 1.0, 1),
    ] {
        for value in [x, y, 0.0] {
            binary.extend(value.to_be_bytes());
        }
        binary.push(material);
    }
    for face in [[0_i32, 1, 2], [0, 2, 3]] {
        binary.push(3);
        face.iter()
            .for_each(|index| binary.extend(index.to_be_bytes()));
    }
    let text = format!(
        "{CAMERA}[materials]\na = {{}}\nb = {{}}\n[meshes.m]\nfile = 'm.ply'\nmaterials = ['b', 'a']\n\
         [[objects]]\nmesh = 'm'\n[[objects]]\nmesh = 'm'\ntransform = {{ scale = 2 }}\n"
    );
    for ply in [PLY.as_bytes(), &binary] {
        let folder = folder(&[("a.toml", text.as_bytes()), ("m.ply", ply)]);
        let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
        assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 2));
        let mesh = &scene.meshes[0];
        assert_eq!(
            mesh.positions,
            [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]
        );
        assert_eq!(mesh.materials, [1, 1, 0, 0]);
        assert_eq!(mesh.normals, [Vec3::Z; 4]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    }
}

/// Colours are interpolated between the corners of a triangle; what else its materials differ in is said once.
#[test]
fn triangles_between_materials_that_differ_in_more_than_colours_are_noted() {
    let mut verdict = Verdict::on("materials at the corners of triangles");
    let note = "triangles between different materials, of which only colours are interpolated: all else, such as emission \
        and alpha, is that of the first corner: 1";
    let paths = "output = { integrator = 'path' }\n";
    for (name, head, one, other, is_said) in [
        ("the same", "", "{}", "{}", false),
        (
            "colours",
            "",
            "{ phong = { diffuse = [1, 0, 0], specular = [1, 1, 1], shininess = 9 } }",
            "{ phong = { diffuse = [0, 0, 1] } }",
            false,
        ),
        ("emission", "", "{}", "{ emission = [1, 1, 1] }", true),
        ("coverage", "", "{}", "{ coverage = { alpha = 0.5 } }", true),
        (
            "diffuse colours for paths",
            paths,
            "{ phong = { diffuse = [1, 0, 0] } }",
            "{ phong = { diffuse = [0, 0, 1] } }",
            false,
        ),
        (
            "highlights for paths",
            paths,
            "{ phong = { shininess = 9 } }",
            "{ phong = { shininess = 90 } }",
            true,
        ),
    ] {
        let text = format!(
            "{CAMERA}{head}materials = {{ a = {one}, b = {other} }}\nobjects = [{{ mesh = {{ file = 'm.ply', materials = ['a', 'b'] }} }}]"
        );
        // One of the two triangles has both materials in it, and the other one has a single one.
        let ply = PLY.replace("1 1 0 1", "1 1 0 0");
        let folder = folder(&[("a.toml", text.as_bytes()), ("m.ply", ply.as_bytes())]);
        let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
        let expected: &[&str] = if is_said { &[note] } else { &[] };
        verdict.that(name, scene.skipped == expected, || {
            format!("{:?}", scene.skipped)
        });
    }
    verdict.close();
}

#[test]
fn copies_are_at_the_points_of_a_file() {
    let points = "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n\
        property double z\nend_header\n1 2 3\n0.1 0 0\n";
    let text = format!(
        "{CAMERA}objects = [{{ sphere = {{ center = [0, 0, 0], radius = 1 }}, repeat = {{ points = {{ file = 'p.ply' }} }} }}]"
    );
    let folder = folder(&[("a.toml", text.as_bytes()), ("p.ply", points.as_bytes())]);
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    let centers: Vec<_> = (scene.shapes.iter())
        .map(|shape| match shape.geometry {
            Geometry::Sphere { center, .. } => center,
            _ => panic!("a sphere is a sphere"),
        })
        .collect();
    assert_eq!(
        centers,
        [DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.1, 0.0, 0.0)]
    );
}

#[test]
fn values_can_be_given_exactly() {
    let text = r#"
        staged = true
        [[cameras]]
        look_from = [0, 0, 9]
        look_at = [0, 0, 0]
        [[cameras]]
        default = true
        look_from = [0, 0, 9]
        look_at = [0, 0, 0]
        up = [0, 7, 0]
        fov_y = 1.25
        [textures.t]
        checker = {}
        pattern_from_space = [[0, 1, 0], [0, 0, 1], [1, 0, 0], [0.1, 0.2, 0.3]]
        [materials.m]
        optics = { reflect = [0.9, 0.8, 0.7], transmit = [1, 1, 1], ior = 0.001, opacity = 0.25, mixing = "sum" }
        [[lights]]
        spot = { position = [0, 0, 0], direction = [0, 0, -2], inner = 0.5, outer = 1.5 }
        [[objects]]
        ellipsoid = { center = [1, 2, 3], radii = [1, 1, 1] }
    "#;
    let scene = scene("a.toml", text);
    assert!(scene.staged && scene.camera_index == 1);
    assert_eq!((scene.cameras[1].up.y, scene.cameras[1].fov_y), (7.0, 1.25));
    let moved = scene.textures[0]
        .pattern_from_space
        .transform_point3(DVec3::X);
    assert_eq!(moved, DVec3::new(0.1, 1.2, 0.3));
    let material = &scene.materials[0];
    assert_eq!(
        (
            material.classical().mixing,
            material.classical().ior,
            material.classical().opacity
        ),
        (Mixing::Sum, 0.001, 0.25)
    );
    assert_eq!(material.classical().reflect, Vec3::new(0.9, 0.8, 0.7));
    let spot = glimray::scene::LightKind::Spot {
        position: DVec3::ZERO,
        direction: DVec3::NEG_Z,
        inner: 0.5,
        outer: 1.5,
    };
    assert_eq!(scene.lights[0].kind, spot);
    let placed = Geometry::Placed {
        canonical: glimray::scene::CanonicalShape::Ellipsoid,
        world_from_canonical: DAffine3::from_translation(DVec3::new(1.0, 2.0, 3.0)),
    };
    assert_eq!(scene.shapes[0].geometry, placed);
}

#[test]
fn materials_and_textures_are_numbered_as_the_file_has_them() {
    let text = format!(
        "{CAMERA}[materials.z.phong]\n[materials.a]\nphong.shininess = 3\n[materials]\nm = {{}}\n[materials.b.phong]"
    );
    let names: Vec<_> = scene("a.toml", text)
        .materials
        .into_iter()
        .map(|m| m.name)
        .collect();
    assert_eq!(names, ["z", "a", "m", "b"]);
}

#[test]
fn invalid_nodes_and_duplicate_values_are_refused_with_their_position() {
    let text = |rest: &str| format!("{CAMERA}{rest}\n");
    let refused = messages(
        "a.toml",
        &[
            text("nodes = [{ name = 'a' }, { name = 'a' }]"),
            text("nodes = [{ name = 'a', carried_by = 'b' }, { name = 'b' }]"),
            text(
                "nodes = [{ name = 'a', transform = { scale = 1e-30 } }, { name = 'b', carried_by = 'a', transform = { scale = 1e-30 } }]",
            ),
            text(
                "nodes = [{ name = 'a', transform = { matrix = [[1,0,0],[2,0,0],[0,0,1],[0,0,0]] } }]",
            ),
            text(
                "nodes = [{ name = 'a', transform = { rotate_deg = [0,0,1], rotation = [0,0,0,1] } }]",
            ),
            text(
                "nodes = [{ name = 'a' }]\nobjects = [{ name = 'a', sphere = { center = [0,0,0], radius = 1 } }]",
            ),
            text("objects = [{ carried_by = 'a', sphere = { center = [0,0,0], radius = 1 } }]"),
            text(
                "nodes = [{ name = 'a', transform = { scale = 2 } }]\nobjects = [{ carried_by = 'a', plane = { point = [0,0,0] } }]",
            ),
            text("materials.m = { optics = {}, reflect = {} }"),
            text("objects = [{ mesh = 'm' }]"),
            text(
                "lights = [{ spot = { position = [0,0,0], direction = [0,0,1], outer = 1, outer_deg = 3 } }]",
            ),
        ],
    );
    let refused: Vec<_> = refused.lines().collect();
    for (line, part) in refused.iter().zip([
        "duplicate object name `a`",
        "unknown node `b`",
        "the node's scale, combined with those of its parents, is zero",
        "the three axes of a matrix lie in one plane",
        "`matrix` replaces all others",
        "duplicate object name `a`",
        "unknown node `a`",
        "cannot move",
        "`optics` replaces",
        "unknown mesh `m`",
        "there are both `outer_deg` and `outer`",
    ]) {
        assert!(line.contains(part), "{part}: {line}");
        assert!(line.contains("a.toml:"), "{line}");
    }
    assert_eq!(refused.len(), 11);
}

#[test]
fn damaged_ply_files_are_refused_in_one_line_each() {
    let text = format!(
        "{CAMERA}materials = {{ a = {{}}, b = {{}} }}\nobjects = [{{ mesh = {{ file = 'm.ply', materials = ['a', 'b'] }} }}]"
    );
    let number = |from: &str, to: &str| PLY.replace(from, to);
    for (ply, part) in [
        ("solid".to_owned(), "does not begin with `ply`"),
        (
            "ply\nformat ascii 1.0\n".to_owned(),
            "does not end with `end_header`",
        ),
        (
            number("vertex 4", "vertex 4000000000000"),
            "shorter than its header announces",
        ),
        (number("vertex 4", "vertex -1"), "line 4 of its header"),
        (number("float x", "real x"), "line 5 of its header"),
        (number("property float z\n", ""), "lack x, y or z"),
        (
            number("3 0 1 2\n3 0 2 3\n", "3 4 1 2\n3 0 2 9\n"),
            "vertex 4, but only 4 exist",
        ),
        (
            number("3 0 2 3\n", "-1 0 2 3 1\n"),
            "a list has a negative length",
        ),
        (
            number("3 0 1 2\n3 0 2 3\n", "3 0 2"),
            "shorter than its header announces",
        ),
        (number("1 1 0 1\n", "1 nan 0 1\n"), "not a finite number"),
        (number("1 1 0 1\n", "1 x 0 1\n"), "`x` is not a number"),
        (
            number("1 1 0 1\n", "1 1 0 2\n"),
            "material 2, but only 2 exist",
        ),
    ] {
        let folder = folder(&[("a.toml", text.as_bytes()), ("m.ply", ply.as_bytes())]);
        let message = message_in(&folder, "a.toml", &Options::default());
        assert!(
            message.contains(part) && message.contains("m.ply"),
            "{part}: {message}"
        );
    }
}

#[test]
fn a_scene_lists_every_file_it_depends_on_including_missing_ones() {
    let text = format!("{CAMERA}objects = [{{ mesh = {{ file = 'm.obj' }} }}]");
    let obj = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    let files: &[(&str, &[u8])] = &[
        ("a.toml", text.as_bytes()),
        ("m.obj", obj.as_bytes()),
        ("m.mtl", b"newmtl a\nmap_Kd gone.png\n"),
    ];
    let folder = folder(files);
    let path = folder.path().join("a.toml");
    let names = || {
        let (scene, files) = import::load_watched(&path, &Options::default(), &|_| ());
        let name = |path: std::path::PathBuf| {
            path.file_name()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        };
        (
            scene.is_ok(),
            files.into_iter().map(name).collect::<Vec<_>>(),
        )
    };
    assert_eq!(
        names(),
        (
            true,
            ["a.toml", "m.obj", "m.mtl", "gone.png"]
                .map(str::to_owned)
                .to_vec()
        )
    );
    std::fs::write(folder.path().join("m.obj"), "v 0 0").expect("a file");
    assert_eq!(
        names(),
        (false, ["a.toml", "m.obj"].map(str::to_owned).to_vec())
    );
    std::fs::remove_file(folder.path().join("m.obj")).expect("removed");
    assert_eq!(
        names(),
        (false, ["a.toml", "m.obj"].map(str::to_owned).to_vec())
    );
    std::fs::remove_file(&path).expect("removed");
    assert_eq!(names(), (false, vec!["a.toml".to_owned()]));
}
