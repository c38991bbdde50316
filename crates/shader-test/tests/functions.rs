//! Functions of every kind of type, and a message for each mistake.

use bytemuck::{Pod, Zeroable};
use glimray_shader_test::{Error, Gpu, Plain, Shader, shader_struct};

fn gpu() -> &'static Gpu {
    Gpu::shared().expect("an adapter; Mesa's lavapipe will do")
}

fn package() -> Shader {
    Shader::package(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/shaders"))
}

/// The message of a call with one number that returns one.
fn error(shader: &Shader, function: &str) -> String {
    let found = gpu().map::<f32, f32>(shader, function, &[1.0]);
    let text = found.expect_err(function).to_string();
    text.replace(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/"), "")
        .replace('\\', "/")
}

shader_struct! {
    /// Of `shapes/disc.wesl`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Disc {
        center: [f32; 3],
        radius: f32,
        is_lit: bool,
    }
}

#[test]
fn a_text_is_called() {
    let shader = Shader::new("fn double(x: f32) -> f32 { return 2.0 * x; }");
    let found: Vec<f32> = gpu()
        .map(&shader, "double", &[1f32, -0.5, f32::MAX])
        .unwrap();
    assert_eq!(found, [2.0, -1.0, f32::INFINITY]);
}

#[test]
fn a_package_is_called_by_path_and_by_a_text() {
    let areas: Vec<f32> = gpu()
        .map(&package(), "shapes::disc::area", &[1f32])
        .unwrap();
    assert!((areas[0] - std::f32::consts::PI).abs() < 1e-6, "{areas:?}");
    let text = "
        import package::shapes::disc::{Disc, grown};
        fn twice(disc: Disc) -> Disc { return grown(grown(disc, 1.0), 2.0); }";
    let disc = Disc {
        center: [1.0, 2.0, 3.0],
        radius: 4.0,
        is_lit: true,
    };
    let found: Vec<Disc> = gpu().map(&package().text(text), "twice", &[disc]).unwrap();
    assert_eq!(
        found,
        [Disc {
            radius: 7.0,
            ..disc
        }]
    );
}

#[test]
fn every_type_goes_in_and_out() {
    let shader = Shader::new(
        "struct Inner { pair: vec2i, flags: array<u32, 2> }
        struct All { sign: i32, is_odd: vec2<bool>, frame: mat2x3f, inner: Inner }
        fn same(sign: i32, is_odd: vec2<bool>, frame: mat2x3f, inner: Inner) -> All {
            return All(sign, is_odd, frame, inner);
        }",
    );
    let row = (
        -7i32,
        [true, false],
        [[1f32, 2.0, 3.0], [4.0, 5.0, 6.0]],
        ([i32::MIN, i32::MAX], [8u32, u32::MAX]),
    );
    type Row = (i32, [bool; 2], [[f32; 3]; 2], ([i32; 2], [u32; 2]));
    let found: Vec<Row> = gpu().map(&shader, "same", &[row]).unwrap();
    assert_eq!(found, [row]);
}

/// In WGSL the colour begins at byte 16, and each column of the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Lamp {
    position: [f32; 3],
    kind: u32,
    color: [f32; 3],
    _pad: u32,
    frame: [[f32; 4]; 3],
}

#[test]
fn plain_structs_lie_as_in_buffers() {
    let shader = Shader::new(
        "struct Lamp { position: vec3f, kind: u32, color: vec3f, frame: mat3x3f }
        fn moved(lamp: Lamp, by: vec3f) -> Lamp {
            return Lamp(lamp.position + by, lamp.kind + 1u, lamp.color.zyx, transpose(lamp.frame));
        }",
    );
    let lamp = Lamp {
        position: [1.0, 2.0, 3.0],
        kind: 4,
        color: [5.0, 6.0, 7.0],
        frame: [
            [1.0, 2.0, 3.0, 0.0],
            [4.0, 5.0, 6.0, 0.0],
            [7.0, 8.0, 9.0, 0.0],
        ],
        ..Lamp::default()
    };
    let rows = [(Plain(lamp), [1f32, 0.0, 0.0])];
    let found: Vec<Plain<Lamp>> = gpu().map(&shader, "moved", &rows).unwrap();
    let Plain(found) = found[0];
    assert_eq!(
        (found.position, found.kind, found.color),
        ([2.0, 2.0, 3.0], 5, [7.0, 6.0, 5.0])
    );
    let columns = found.frame.map(|[x, y, z, _]| [x, y, z]);
    assert_eq!(columns, [[1.0, 4.0, 7.0], [2.0, 5.0, 8.0], [3.0, 6.0, 9.0]]);
}

#[test]
fn overrides_features_and_buffers_are_set() {
    let scaled =
        |shader: Shader| -> f32 { gpu().map(&shader, "constants::scaled", &[3f32]).unwrap()[0] };
    assert_eq!(scaled(package()), 3.0);
    assert_eq!(scaled(package().set("SCALE", 4.0)), 12.0);
    assert_eq!(scaled(package().set("SCALE", 4.0).feature("doubled")), 24.0);

    let shader = Shader::new(
        "@group(0) @binding(3) var<storage, read> table: array<f32>;
        @group(2) @binding(0) var<uniform> offset: vec4u;
        fn looked_up(i: u32) -> f32 { return table[i + offset.y]; }",
    );
    let shader = shader
        .buffer("table", &[1f32, 2.0, 4.0, 8.0])
        .buffer("offset", &[0u32, 1, 0, 0]);
    let found: Vec<f32> = gpu().map(&shader, "looked_up", &[0u32, 2]).unwrap();
    assert_eq!(found, [2.0, 8.0]);
}

#[test]
fn more_rows_than_a_dispatch_has_come_back_in_order() {
    let shader = Shader::new("fn next(x: u32) -> u32 { return x + 1u; }");
    let rows: Vec<u32> = (0..64 * 65_535 + 10).collect();
    let found: Vec<u32> = gpu().map(&shader, "next", &rows).unwrap();
    assert!(found.len() == rows.len() && found.iter().zip(rows).all(|(found, x)| *found == x + 1));
}

/// A driver that stops a shader is played by a module that does less.
#[test]
fn a_row_that_is_not_written_is_an_error() {
    let gpu = Gpu::open("").expect("a device");
    let gpu = gpu.with_modules(|device, _| {
        let idle = "@compute @workgroup_size(64) fn shader_test_main() {}";
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(idle.into()),
        })
    });
    let shader = Shader::new("fn double(x: f32) -> f32 { return 2.0 * x; }");
    let found = gpu.map::<f32, f32>(&shader, "double", &[1.0, 2.0]);
    let expected = Error::Unwritten {
        function: "double".to_owned(),
        row: 0,
    };
    assert_eq!(found, Err(expected.clone()));
    assert_eq!(format!("{expected:?}"), "`double` wrote nothing for row 0");
}

#[test]
fn messages_name_the_line_of_the_source() {
    let imported = "import package::broken::inner;\nfn probe(x: f32) -> f32 { return inner(x); }";
    let unknown = "import package::broken::inner;\nfn probe(x: f32) -> f32 {\n    return y;\n}";
    let unequal = "fn probe(x: f32) -> f32 {\n    let y = 1u;\n    return y + x;\n}";
    let open = "fn probe(x: f32) -> f32 {\n    let y = 1u\n    return x;\n}";
    let rows = [
        (
            package(),
            "broken::outer",
            "shaders/broken.wesl:6: ",
            "\n    let y = vec2f(x) +",
        ),
        (
            package().text(imported),
            "probe",
            "shaders/broken.wesl:6: ",
            "\n    let y = vec2f(x) +",
        ),
        (
            package().text(unknown),
            "probe",
            "text:3: ",
            "`y`\n    return y;",
        ),
        (
            package(),
            "unfinished::half",
            "shaders/unfinished.wesl:2: unexpected token `;`",
            "return 0.5 * ;",
        ),
        (
            Shader::new(unequal),
            "probe",
            "text:3: ",
            "\n    return y + x;",
        ),
        (
            Shader::new(open),
            "probe",
            "text:3: unexpected token `return`",
            "\n    return x;",
        ),
    ];
    for (shader, function, begin, end) in rows {
        let found = error(&shader, function);
        assert!(found.starts_with(begin) && found.ends_with(end), "{found}");
    }
}

#[test]
fn messages_say_what_is_missing_and_what_does_not_fit() {
    let table = "@group(0) @binding(0) var<storage, read> table: array<f32>;
        fn probe(x: f32) -> f32 { return table[0] + x; }";
    let texture = "@group(0) @binding(0) var map: texture_2d<f32>;
        fn probe(x: f32) -> f32 { return x * textureLoad(map, vec2u(0), 0).x; }";
    let rows = [
        ("", "`probe`: there is no such function"),
        (
            "fn probe(x: ptr<function, f32>) -> f32 { return *x; }",
            "`probe`: rows cannot hold `x`; call it from a function with values",
        ),
        (
            "fn probe(x: vec2f) -> f32 { return x.x; }",
            "`probe`: a row has 1 words; none is left for `x[1]`",
        ),
        (
            "fn probe() -> f32 { return 1.0; }",
            "`probe`: a row has 1 words, the parameters 0",
        ),
        (
            "fn probe(x: u32) -> f32 { return f32(x); }",
            "`probe`: word 0 of a row is F32, but `x` is U32",
        ),
        (
            "fn probe(x: f32) -> bool { return x > 0.0; }",
            "`probe`: word 0 of the Rust type is F32, but `result` is Bool",
        ),
        ("fn probe(x: f32) {}", "`probe`: there is no result"),
        (
            table,
            "`probe` reads `table`, which `Shader::buffer` does not fill",
        ),
        (texture, "`probe` reads `map`, which is no buffer"),
    ];
    for (text, expected) in rows {
        assert_eq!(error(&Shader::new(text), "probe"), expected);
    }
    let of_package = |shader, function, expected| assert_eq!(error(&shader, function), expected);
    of_package(
        package(),
        "constants::missing",
        "`constants::missing`: there is no such function",
    );
    of_package(
        package().set("SKALE", 1.0),
        "constants::scaled",
        "`constants::scaled` reads no override `SKALE`",
    );
    let no_file = error(&package(), "missing::half");
    assert!(
        no_file.starts_with("`missing::half`: file not found: "),
        "{no_file}"
    );
    let found = gpu().map::<f32, f32>(&package(), "shapes::disc::area", &[]);
    let found = found.expect_err("no rows").to_string();
    assert_eq!(found, "`shapes::disc::area`: there are no rows");
    let found = Gpu::open("no such").err().expect("no adapter").to_string();
    assert!(
        found.starts_with("there is no adapter with `no such` in its name"),
        "{found}"
    );
}
