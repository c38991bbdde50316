//! Hostile input: refused in one line, quickly, and in little memory.

use super::{folder, load, messages};
use crate::support::effort;
use glimray::import::{self, Options};
use insta::assert_snapshot;

/// The message, which must take little time.
fn soon(name: &str, contents: impl AsRef<[u8]>) -> String {
    effort::within(10_000.0, || messages(name, &[contents]))
}

fn utf16(text: &str, mark: &[u8], big_end: bool) -> Vec<u8> {
    let units = text.encode_utf16().flat_map(|unit| {
        if big_end {
            unit.to_be_bytes()
        } else {
            unit.to_le_bytes()
        }
    });
    mark.iter().copied().chain(units).collect()
}

#[test]
fn files_that_are_not_text_are_reported() {
    let text = "1 amb: 0 0 0\n";
    let files = [
        utf16(text, &[0xff, 0xfe], false),
        utf16(text, &[0xfe, 0xff], true),
        utf16(text, &[], false),
        utf16(text, &[], true),
        b"1 amb: 0 \0 0".to_vec(),
        b"\x7fELF\x02\x01\x01\0\0\0".to_vec(),
        b"\x89PNG\r\n\x1a\n".to_vec(),
        b"\xff\xff\xff\xff".to_vec(),
    ];
    assert_snapshot!(messages("a.scene", &files), @r"
no error
no error
bad scene (a.scene): the file is UTF-16. Save it as UTF-8.
bad scene (a.scene): the file is UTF-16. Save it as UTF-8.
bad scene (a.scene:1:10): a zero byte: the file is binary, not text. Name a text file.
bad scene (a.scene:1:1): `\u{7f}ELF\u{2}\u{1}\u{1}` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:1:1): `\u{89}PNG` is not a number. Write a decimal number such as -0.5 or 2e3.
bad scene (a.scene:1:1): `ÿÿÿÿ` is not a number. Write a decimal number such as -0.5 or 2e3.
");
    assert_snapshot!(messages("a.nff", &files), @r"
bad scene (a.nff:1:1): expected an entity, found `1`. Count the numbers before it.
bad scene (a.nff:1:1): expected an entity, found `1`. Count the numbers before it.
bad scene (a.nff): the file is UTF-16. Save it as UTF-8.
bad scene (a.nff): the file is UTF-16. Save it as UTF-8.
bad scene (a.nff:1:10): a zero byte: the file is binary, not text. Name a text file.
bad scene (a.nff:1:1): unknown entity `\u{7f}ELF\u{2}\u{1}\u{1}`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:1:1): unknown entity `\u{89}PNG`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
bad scene (a.nff:1:1): unknown entity `ÿÿÿÿ`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.
");
    assert_snapshot!(messages("a.toml", &files), @r"
bad scene (a.toml:1:3): key with no value, expected `=`. See https://toml.io for the syntax.
bad scene (a.toml:1:3): key with no value, expected `=`. See https://toml.io for the syntax.
bad scene (a.toml): the file is UTF-16. Save it as UTF-8.
bad scene (a.toml): the file is UTF-16. Save it as UTF-8.
bad scene (a.toml:1:10): a zero byte: the file is binary, not text. Name a text file.
bad scene (a.toml:1:8): key with no value, expected `=`. See https://toml.io for the syntax.
bad scene (a.toml:1:1): the byte 0x89 is not UTF-8. Save the file as UTF-8.
bad scene (a.toml:1:1): the byte 0xff is not UTF-8. Save the file as UTF-8.
");
    assert_snapshot!(messages("a.obj", &files), @r"
bad model (a.obj:1:1): `1` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj:1:1): `1` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj): the file is UTF-16. Save it as UTF-8.
bad model (a.obj): the file is UTF-16. Save it as UTF-8.
bad model (a.obj:1:10): a zero byte: the file is binary, not text. Name a text file.
bad model (a.obj:1:1): `\u{7f}ELF\u{2}\u{1}\u{1}` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj:1:1): `\u{89}PNG` is not an OBJ statement. Check that this is a Wavefront OBJ file.
bad model (a.obj:1:1): `ÿÿÿÿ` is not an OBJ statement. Check that this is a Wavefront OBJ file.
");
}

#[test]
fn a_million_nested_tables_are_refused() {
    const MILLION: usize = 1_000_000;
    let dotted = "a.".repeat(MILLION);
    let files = [
        "[".repeat(MILLION),
        format!("a = {}", "[".repeat(MILLION)),
        format!("a = {}", "{a=".repeat(MILLION)),
        format!("{dotted}a = 1"),
        format!("[{dotted}a]"),
        format!("a = {{{dotted}a = 1}}"),
        "[[objects]]\n".repeat(MILLION),
        "[a.b]\n".repeat(MILLION),
        format!("a = [{}]", "1,".repeat(MILLION)),
        "\"".repeat(MILLION),
        "a\\".repeat(MILLION),
    ];
    let lines: Vec<_> = files.iter().map(|file| soon("a.toml", file)).collect();
    assert_snapshot!(lines.join("\n"), @r"
bad scene (a.toml:1:33): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:1:37): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:1:101): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:1:66): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:1:67): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:1:71): tables are nested more than 32 deep. Look for a missing bracket.
bad scene (a.toml:100001:1): the scene has too many keys and values. Keep geometry in OBJ or PLY files, and use fewer keys.
bad scene (a.toml:125001:1): the scene has too many keys and values. Keep geometry in OBJ or PLY files, and use fewer keys.
bad scene (a.toml:1:1000003): the scene has too many keys and values. Keep geometry in OBJ or PLY files, and use fewer keys.
bad scene (a.toml:1:500001): the scene has too many keys and values. Keep geometry in OBJ or PLY files, and use fewer keys.
bad scene (a.toml:1:2000001): key with no value, expected `=`. See https://toml.io for the syntax.
");
}

#[test]
fn one_long_line_is_refused_and_not_shown_whole() {
    const LENGTH: usize = 30_000_000;
    let word = "a".repeat(LENGTH);
    let spaces = " ".repeat(LENGTH);
    let numbers = "1 ".repeat(LENGTH / 2);
    assert_snapshot!(soon("a.scene", &word), @"bad scene (a.scene:1:1): `aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…` is not a number. Write a decimal number such as -0.5 or 2e3.");
    assert_snapshot!(soon("a.scene", &spaces), @"bad scene (a.scene:1:1): the file ends where the number of objects `N` should be. Check that it is complete.");
    assert_snapshot!(soon("a.scene", &numbers), @"bad scene (a.scene:1:3): expected `amb:`, found `1`. Begin the file with N and `amb: R G B`.");
    assert_snapshot!(soon("a.scene", "/".repeat(LENGTH)), @"bad scene (a.scene:1:30000001): the file ends where the number of objects `N` should be. Check that it is complete.");
    assert_snapshot!(soon("a.scene", "1/".repeat(LENGTH / 2)), @"bad scene (a.scene:1:1): `1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/1/…` is not a number. Write a decimal number such as -0.5 or 2e3.");
    assert_snapshot!(soon("a.toml", &word), @"file too big (a.toml): 28.6 MiB, but at most 16 MiB are read. Split the scene, or keep geometry in OBJ files.");
    assert_snapshot!(soon("a.toml", &word[..15_000_000]), @"bad scene (a.toml:1:15000001): key with no value, expected `=`. See https://toml.io for the syntax.");
    assert_snapshot!(soon("a.obj", &word), @"bad model (a.obj:1:1): `aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…` is not an OBJ statement. Check that this is a Wavefront OBJ file.");
    assert_snapshot!(soon("a.obj", format!("v {numbers}")), @"bad model (a.obj:1:17): a vertex has too many numbers. Write `v X Y Z`.");
    assert_snapshot!(soon("a.obj", format!("v 0 0 0\nf {numbers}")), @"bad model (a.obj:2:131075): a face has more than 65536 corners. Split the face.");
    assert_snapshot!(soon("a.obj", format!("mtllib {word}")), @"no error");
    assert_snapshot!(soon("a.obj", format!("v 0 0 {}", "9".repeat(LENGTH))), @"bad model (a.obj:1:7): `99999999999999999999999999999999…` is out of range: at most 3.4e38 is allowed. Write a decimal number such as -0.5 or 2e3.");
    assert_snapshot!(soon("a.obj", "\\\n".repeat(LENGTH / 2)), @"no error");
    assert_snapshot!(soon("a.nff", &word), @"bad scene (a.nff:1:1): unknown entity `aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…`. Entities are `v`, `b`, `l`, `f`, `c`, `s`, `p` and `pp`.");
    assert_snapshot!(soon("a.nff", &spaces), @"bad scene (a.nff:1:1): the file has no view (`v`). A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.");
    assert_snapshot!(soon("a.nff", "#".repeat(LENGTH)), @"bad scene (a.nff:1:30000001): the file has no view (`v`). A view is `v` with `from`, `at`, `up`, `angle`, `hither` and `resolution`.");
    assert_snapshot!(soon("a.nff", format!("f 1 1 1 1 0 1 0 1 p 60000 {numbers}")), @"bad scene (a.nff:1:360027): expected an entity, found `1`. Count the numbers before it.");
    assert_snapshot!(soon("a.nff", format!("f 1 1 1 1 0 1 0 1 p 3 0 0 {}", "9".repeat(LENGTH))), @"bad scene (a.nff:1:30000027): the file ends inside a polygon, after 1 of 3 corners. A polygon is `p N` and N corners of 3 numbers.");
    assert_snapshot!(soon("a.nff", format!("l {numbers}")), @"bad scene (a.nff:1:15): expected an entity, found `1`. Count the numbers before it.");
}

#[test]
fn many_equal_corners_do_not_take_quadratic_time() {
    let normals: String = "vn 0 0 1\n".repeat(100_000);
    let faces: String = (1..99_999)
        .map(|i| format!("f 1//{i} 2//{} 3//{}\n", i + 1, i + 2))
        .collect();
    let model = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{normals}{faces}");
    let scene = effort::within(10_000.0, || load("a.obj", model).expect("a scene"));
    assert_eq!(scene.triangle_count(), 99_998);
}

#[test]
fn the_excerpt_is_a_short_window_of_the_line() {
    let text = format!(
        "background = [0, 0, 0]{}oops\u{1b}[31m = 3 # {}",
        " ".repeat(200),
        "x".repeat(200)
    );
    let error = import::parse("a.toml", &text, &Options::default()).expect_err("refused");
    let fault = error.fault();
    let excerpt = fault.excerpt.as_ref().expect("an excerpt");
    // 60 bytes on either side of the fault.
    let (before, after) = excerpt.text.split_at(excerpt.span.start);
    assert_eq!(before, format!("…{}", " ".repeat(60)));
    let rest = "oops\u{fffd}[31m = 3 # ";
    let shown = 60 - (rest.len() - "\u{fffd}".len() + "\u{1b}".len());
    assert_eq!(after, format!("{rest}{}…", "x".repeat(shown)));
    let position = fault.position.expect("a place");
    assert_eq!((position.line, position.column), (1, 223));
}

/// Every file in the folder of scenes, truncated and corrupted in reproducible ways.
#[test]
fn no_corruption_of_a_file_makes_an_importer_panic() {
    let mut bits = 0x2545_f491_u32;
    let mut random = |below: usize| {
        bits ^= bits << 13;
        bits ^= bits >> 17;
        bits ^= bits << 5;
        bits as usize % below
    };
    const SNIPPETS: [&[u8]; 13] = [
        b"\0",
        b"\xff",
        b"\n",
        b" ",
        b"nan",
        b"-1",
        b"1e400",
        b"[",
        b"\"",
        b"/",
        b"f 1 2 3 4 5\n",
        b"pos:",
        b"p 9 ",
    ];
    for name in [
        "sphere.scene",
        "spheres_and_triangles.scene",
        "shapes.toml",
        "lights.toml",
        "orbits.toml",
        "neutral.nff",
        "lighthouse.obj",
    ] {
        let path = super::assets::path(name);
        let good = std::fs::read(&path).expect("a file");
        for _ in 0..300 {
            let mut bad = good[..random(good.len())].to_vec();
            for _ in 0..random(4) {
                let at = random(bad.len() + 1);
                let end = (at + random(6)).min(bad.len());
                bad.splice(at..end, SNIPPETS[random(SNIPPETS.len())].iter().copied());
            }
            let folder = folder(&[(name, &bad)]);
            if let Err(error) = import::load(&folder.path().join(name)) {
                assert_eq!(error.to_string().lines().count(), 1);
            }
        }
    }
}
