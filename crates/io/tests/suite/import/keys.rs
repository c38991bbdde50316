//! Every key that a format has is honoured or reported: set to an odd value it changes the scene, its notes, or refuses it.

use super::{folder, load};
use glimray::import::{self, FORMAT_KEYS};
use glimray::scene::Scene;

/// The outcome of loading a file: its scene with its notes, or its message.
fn outcome(name: &str, contents: impl AsRef<[u8]>) -> Result<Scene, String> {
    let fault = |error: import::ImportError| error.fault().why.clone();
    load(name, contents).map_err(fault)
}

fn keys(format: &str) -> &'static [&'static str] {
    let found = FORMAT_KEYS.iter().find(|(ending, _)| *ending == format);
    found.expect("the format has keys").1
}

/// For each key of `format` two files that differ in it only, by `files`.
fn every_key_counts<T: AsRef<[u8]>>(format: &str, files: impl Fn(&str) -> (T, T)) {
    let name = format!("a.{format}");
    for key in keys(format) {
        let (plain, odd) = files(key);
        let plain = outcome(&name, plain);
        assert!(plain.is_ok(), "{key}: {plain:?}");
        assert_ne!(
            plain,
            outcome(&name, odd),
            "`{key}` is dropped without a word"
        );
    }
}

/// `text` with one part replaced.
fn changed(text: &str, from: &str, to: &str) -> (String, String) {
    assert!(text.contains(from), "{from}");
    (text.to_owned(), text.replacen(from, to, 1))
}

#[test]
fn every_statement_of_obj_files_counts() {
    let model = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 -0.5\nvt 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 3\nf 2 4 3\n";
    every_key_counts("obj", |key| {
        let line = match key {
            "v" => return changed(model, "v 1 0 0", "v 7 0 0"),
            "vn" => return changed(model, "vn 0 0 1", "vn 0 1 1"),
            "vt" => return changed(model, "vt 0 0", "vt 0 0 5"),
            "f" => return changed(model, "f 1 2 3\n", ""),
            "fo" => "fo 1 3 2",
            "usemtl" => "usemtl other",
            "mtllib" => "mtllib gone.mtl",
            "s" => "s off",
            "o" => "o part",
            "g" => "g part",
            other => &format!("{other} 1 2 3"),
        };
        let (start, faces) = model.split_once("f 1 2 3").expect("faces");
        (model.to_owned(), format!("{start}{line}\nf 1 2 3{faces}"))
    });
}

#[test]
fn every_key_of_material_libraries_counts() {
    const MODEL: &[u8] =
        b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";
    let outcome = |library: &str| {
        let folder = folder(&[
            ("a.obj", MODEL),
            ("a.mtl", library.as_bytes()),
            ("red.png", &super::textures::png()),
        ]);
        import::load(&folder.path().join("a.obj")).expect("a model")
    };
    for &key in keys("mtl") {
        // Some numbers count for some materials only.
        let context = match key {
            "Ni" | "Tf" => "newmtl a\nillum 7\nKd 0 0 0\nKs 1 1 1\n",
            "Pcr" | "map_Pcr" => "newmtl a\nPc 1\n",
            "anisor" => "newmtl a\naniso 0.5\n",
            _ => "newmtl a\nKd 0.5 0.25 0.125\n",
        };
        let line = match key {
            "newmtl" => "newmtl".to_owned(),
            "illum" => "illum 0".to_owned(),
            map if map.starts_with("map_") => format!("{map} red.png"),
            "norm" | "bump" => format!("{key} red.png"),
            other => format!("{other} 0.3 0.2 0.1"),
        };
        let odd = outcome(&format!("{context}{line}\n"));
        assert_ne!(outcome(context), odd, "`{key}` is dropped without a word");
    }
    let unknown = outcome("newmtl a\nKq 1 2 3\nmap_Kq red.png\n");
    assert_eq!(
        unknown.skipped,
        ["unknown in materials: `Kq` 1, `map_Kq` 1"]
    );
}

#[test]
fn every_property_of_ply_files_counts() {
    let file = |extra: &[(&str, [f32; 3])], faces: &str| {
        let names = extra
            .iter()
            .map(|(name, _)| format!("property float {name}\n"));
        let header: String = names.collect();
        let rows = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let row = |(i, place): (usize, &[f32; 3])| {
            let numbers = place
                .iter()
                .copied()
                .chain(extra.iter().map(|(_, values)| values[i]));
            let words: Vec<_> = numbers.map(|number| number.to_string()).collect();
            words.join(" ") + "\n"
        };
        let rows: String = rows.iter().enumerate().map(row).collect();
        let (faces, body) = faces.split_once('|').unwrap_or((faces, ""));
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             {header}{faces}end_header\n{rows}{body}"
        )
    };
    const FACES: &str = "element face 1\nproperty list uchar int vertex_indices\n|3 0 1 2\n";
    let groups: [&[&str]; 9] = [
        &["linear_red", "linear_green", "linear_blue", "linear_alpha"],
        &["nx", "ny", "nz"],
        &["s", "t"],
        &["u", "v"],
        &["texture_u", "texture_v"],
        &["s2", "t2"],
        &["red", "green", "blue"],
        &["diffuse_red", "diffuse_green", "diffuse_blue"],
        &["r", "g", "b"],
    ];
    every_key_counts("ply", |key| match key {
        "x" => changed(&file(&[], FACES), "1 0 0", "7 0 0"),
        "y" => changed(&file(&[], FACES), "1 0 0", "1 7 0"),
        "z" => changed(&file(&[], FACES), "1 0 0", "1 0 7"),
        "radius" => (
            file(&[("radius", [1.0; 3])], ""),
            file(&[("radius", [1.0, 2.0, 1.0])], ""),
        ),
        "vertex_indices" => changed(&file(&[], FACES), "3 0 1 2", "3 0 2 1"),
        "vertex_index" => {
            let faces = FACES.replace("indices", "index");
            changed(&file(&[], &faces), "3 0 1 2", "3 0 2 1")
        }
        "tristrips" => {
            let strips = "element tristrips 1\nproperty list int int vertex_indices\n|3 0 1 2\n";
            changed(&file(&[], strips), "3 0 1 2", "3 0 2 1")
        }
        "TextureFile" => changed(
            &file(&[], FACES),
            "end_header",
            "comment TextureFile a.png\nend_header",
        ),
        other => {
            let group = groups.iter().find(|group| group.contains(&other));
            let group = group.unwrap_or_else(|| panic!("{other} has no group"));
            let properties = |odd: f32| {
                let value = |name: &&'static str| if *name == other { odd } else { 0.5 };
                let mut list: Vec<_> = group.iter().map(|name| (*name, [value(name); 3])).collect();
                if other.ends_with('2') {
                    list.extend([("s", [0.0; 3]), ("t", [0.0; 3])]);
                }
                list
            };
            (
                file(&properties(0.5), FACES),
                file(&properties(0.25), FACES),
            )
        }
    });
}

#[test]
fn every_part_of_stl_files_counts() {
    let text = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
        endfacet\nendsolid a\n";
    let binary = |header: &[u8], attribute: [u8; 2]| {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(1_u32.to_le_bytes());
        for number in [
            0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0,
        ] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(attribute);
        bytes
    };
    every_key_counts("stl", |key| {
        let pair = match key {
            "solid" => changed(text, "solid", "sold"),
            "facet" => changed(text, "facet", "faucet"),
            "normal" => changed(text, "normal 0 0 1", "normal 0 0 -1"),
            "vertex" => changed(text, "vertex 1 0 0", "vertex 7 0 0"),
            "COLOR=" => {
                return (
                    binary(b"", [0; 2]),
                    binary(b"COLOR=\xff\0\0\xff", [0, 0x80]),
                );
            }
            "MATERIAL=" => {
                return (
                    binary(b"", [0; 2]),
                    binary(b"MATERIAL=123456789012", [0; 2]),
                );
            }
            "attribute" => return (binary(b"", [0; 2]), binary(b"", [7, 0x80])),
            other => panic!("{other} has no test"),
        };
        (pair.0.into_bytes(), pair.1.into_bytes())
    });
}

#[test]
fn every_keyword_of_nff_files_counts() {
    let text = "v\nfrom 0 -5 1\nat 0 0 1\nup 0 0 1\nangle 45\nhither 0.01\nresolution 320 200\nb 0 0 1\nl 1 2 3\n\
        f 1 0.5 0.25 0.8 0.5 30 0 0\ns 0 0 0 1\nc 0 0 0 1 0 0 1 1\np 3 0 0 0 1 0 0 0 1 0\n\
        pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n";
    every_key_counts("nff", |key| match key {
        "v" => changed(text, "v\n", "w\n"),
        "from" => changed(text, "from 0", "from 7"),
        "at" => changed(text, "at 0", "at 7"),
        "up" => changed(text, "up 0", "up 7"),
        "angle" => changed(text, "angle 45", "angle 7"),
        "hither" => changed(text, "hither 0.01", "hither 77"),
        "resolution" => changed(text, "resolution 320", "resolution 7"),
        "b" => changed(text, "b 0", "b 7"),
        "l" => changed(text, "l 1 2 3", "l 7 2 3"),
        "f" => changed(text, "f 1 0.5 0.25 0.8", "f 1 0.5 0.25 0.7"),
        "s" => changed(text, "s 0", "s 7"),
        "c" => changed(text, "c 0", "c 7"),
        "p" => changed(text, "p 3 0", "p 3 7"),
        "pp" => changed(text, "pp 3 0 0 0 0 0 1", "pp 3 0 0 0 0 7 1"),
        other => panic!("{other} has no test"),
    });
}

#[test]
fn every_key_of_course_files_counts() {
    let vertex = "nor: 0 0 1 dif: 1 1 1 spe: 0 0 0 shi: 1";
    let text = format!(
        "3 amb: 0 0 0\nsphere pos: 0 0 -3 rad: 1 dif: 1 1 1 spe: 0 0 0 shi: 1\n\
         light pos: 0 9 0 col: 1 1 1 area_light: true area_u: 1 0 0 area_v: 0 0 1 samples: 9\n\
         triangle pos: 0 0 -9 {vertex} pos: 1 0 -9 {vertex} pos: 0 1 -9 {vertex}\n"
    );
    every_key_counts("scene", |key| {
        let (from, to) = match key {
            "sphere" => ("sphere", "spare"),
            "triangle" => ("triangle", "rectangle"),
            "light" => ("light pos:", "lamp pos:"),
            "area_light:" => ("area_light: true", "area_light: false"),
            "area_u:" => ("area_u: 1", "area_u: 7"),
            "area_v:" => ("area_v: 0", "area_v: 7"),
            "samples:" => ("samples: 9", "samples: 7"),
            "ref:" => ("rad: 1", "rad: 1 ref: 0.5"),
            "pos:" => ("pos: 0", "pos: 7"),
            "rad:" => ("rad: 1", "rad: 7"),
            "nor:" => ("nor: 0", "nor: 7"),
            "dif:" => ("dif: 1", "dif: 7"),
            "spe:" => ("spe: 0", "spe: 7"),
            "shi:" => ("shi: 1", "shi: 7"),
            "col:" => ("col: 1", "col: 7"),
            "amb:" => ("amb: 0", "amb: 7"),
            other => panic!("{other} has no test"),
        };
        changed(&text, from, to)
    });
}
