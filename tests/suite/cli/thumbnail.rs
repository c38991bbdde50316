//! Thumbnails, as file managers ask for them.

use crate::support::program::Workspace;
use image::{ImageFormat, RgbImage};

/// A red cube whose sides are 2 long.
const CUBE: &str = "mtllib a.mtl\nusemtl red\nv 4 0 0\nv 6 0 0\nv 6 2 0\nv 4 2 0\nv 4 0 2\nv 6 0 2\nv 6 2 2\nv 4 2 2\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

/// A tetrahedron.
const STL: &str = "solid a\n\
    facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

fn workspace() -> Workspace {
    let workspace = Workspace::new();
    workspace.write("cube.obj", CUBE);
    workspace.write("a.mtl", "newmtl red\nKd 0.7 0.02 0.02\nillum 1\n");
    workspace
}

/// A PNG, whatever its name.
fn picture(bytes: &[u8]) -> RgbImage {
    let picture = image::load_from_memory_with_format(bytes, ImageFormat::Png);
    picture.expect("a PNG").into_rgb8()
}

#[test]
fn a_thumbnail_shows_the_whole_model_in_its_middle_and_prints_nothing() {
    let workspace = workspace();
    for output in ["a.png", "thumbnail", "a.jpg"] {
        let run = workspace
            .run(&format!("thumbnail --size 64 -o {output} cube.obj"))
            .expect(0);
        assert_eq!((run.text(), &*run.stderr), ("", ""), "{output}");
        let picture = picture(&workspace.read(output));
        assert_eq!(picture.dimensions(), (64, 64), "{output}");
        let is_red = |[r, g, b]: [u8; 3]| r > 60 && g < r / 2 && b < r / 2;
        let red = picture
            .enumerate_pixels()
            .filter(|(.., pixel)| is_red(pixel.0));
        let (mut low, mut high) = ([63; 2], [0; 2]);
        for (x, y, _) in red {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
        }
        assert!(
            low.iter().all(|it| *it > 0) && high.iter().all(|it| *it < 63),
            "{low:?} {high:?}"
        );
        assert!(
            (0..2).any(|axis| high[axis] - low[axis] > 45),
            "{low:?} {high:?}"
        );
        let off = (0..2).map(|axis| (low[axis] + high[axis]).abs_diff(63) / 2);
        assert!(off.into_iter().all(|off| off < 5), "{low:?} {high:?}");
    }
    let first = workspace.read("a.png");
    assert!(
        first == workspace.read("thumbnail"),
        "the same bytes each time"
    );
    let streamed = workspace.run("thumbnail --size 64 -o - cube.obj").expect(0);
    assert!(streamed.stdout == first);
    assert_eq!(
        picture(&workspace.run("thumbnail cube.obj -o -").expect(0).stdout).dimensions(),
        (256, 256)
    );
}

#[test]
fn a_thumbnail_of_a_scene_keeps_the_proportions_of_its_picture() {
    let workspace = workspace();
    workspace.write("tall.toml", "[output]\nsize = [300, 600]\n\n[[objects]]\nsphere = { center = [0, 0, -5], radius = 1 }\n");
    for (scene, size) in [("a.scene", (64, 48)), ("tall.toml", (32, 64))] {
        let run = workspace
            .run(&format!("thumbnail --size 64 {scene} -o -"))
            .expect(0);
        assert_eq!(picture(&run.stdout).dimensions(), size, "{scene}");
    }
}

#[test]
fn a_thumbnail_tells_a_model_by_its_contents() {
    let workspace = workspace();
    for (name, text) in [("x", STL), ("y.tmp", PLY), ("z.part", CUBE)] {
        workspace.write(name, text);
        let run = workspace
            .run(&format!("thumbnail --size 16 {name} -o -"))
            .expect(0);
        assert_eq!(picture(&run.stdout).dimensions(), (16, 16), "{name}");
        workspace
            .run(&format!("render {name} -o a.png"))
            .expect(3)
            .says("unknown scene format");
    }
    workspace.write("letter", "Dear reader,\n");
    for (line, code, message) in [
        ("thumbnail letter -o a.png", 3, "unknown scene format"),
        ("thumbnail gone -o a.png", 3, "no such file"),
        ("thumbnail cube.obj", 2, "--output"),
        ("thumbnail cube.obj -o a.png --size 15", 2, "15"),
        ("thumbnail cube.obj -o a.png --size 1025", 2, "1025"),
        (
            "thumbnail cube.obj -o cube.obj",
            4,
            "this run reads that file",
        ),
        ("thumbnail cube.obj -o none/a.png", 4, "none"),
    ] {
        workspace.run(line).expect(code).says(message);
    }
    assert!(!workspace.path("a.png").exists());
}
