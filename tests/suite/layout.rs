//! Host and shader agree on structs, tags, bindings and overrides.

use crate::support::verdict::Verdict;
use glimray::{
    gpu::Kernel,
    layout::{self, PACKED_STRUCTS},
    render::KERNEL_OVERRIDES,
};
use naga::{AddressSpace, ArraySize, ImageClass, Module, StorageAccess, StorageFormat, TypeInner};
use std::{collections::BTreeSet, fs};

fn parse(name: &str, source: &str) -> Module {
    naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(source)))
}

/// The shared types before linking: they import nothing, so the file is plain WGSL.
fn shared_types() -> Module {
    parse(
        "types.wesl",
        &fs::read_to_string("shaders/types.wesl").expect("shaders/types.wesl"),
    )
}

/// Every variant of every kernel.
fn linked() -> Vec<(String, Module)> {
    Kernel::ALL
        .iter()
        .flat_map(|kernel| {
            (kernel.variants()).map(|variant| (kernel.name, variant, kernel.source(variant)))
        })
        .map(|(name, variant, source)| {
            let source = source.expect("a variant has a source");
            (format!("{name} ({variant:?})"), parse(name, &source))
        })
        .collect()
}

/// The name in its own file: the linker adds the module before it.
fn plain(name: &Option<String>) -> String {
    let name = name.as_deref().unwrap_or_default();
    let item = name.rsplit_once("__").map_or(name, |(_, item)| item);
    item.to_owned()
}

type Members = Vec<(String, usize)>;

/// Name, size and members (name, offset) of the packed structs of a module. The host struct omits a
/// runtime-sized array at the end: it is the head of a buffer.
fn packed_structs(module: &Module) -> Vec<(String, usize, Members)> {
    let mut found = Vec::new();
    for (_, ty) in module.types.iter() {
        let TypeInner::Struct { members, span } = &ty.inner else {
            continue;
        };
        let name = plain(&ty.name);
        if !name.starts_with("Packed") {
            continue;
        }
        let is_endless = |ty| {
            matches!(
                module.types[ty].inner,
                TypeInner::Array {
                    size: ArraySize::Dynamic,
                    ..
                }
            )
        };
        let endless = members.iter().find(|member| is_endless(member.ty));
        let size = endless.map_or(*span, |member| member.offset) as usize;
        let sized = members.iter().filter(|member| !is_endless(member.ty));
        let members = sized
            .map(|member| (plain(&member.name), member.offset as usize))
            .collect();
        found.push((name, size, members));
    }
    found
}

fn compare_structs(verdict: &mut Verdict, place: &str, module: &Module) {
    for (name, size, members) in packed_structs(module) {
        let host = PACKED_STRUCTS.iter().find(|(host, ..)| *host == name);
        let host = host.map(|(_, size, members)| {
            (
                *size,
                members
                    .iter()
                    .map(|(name, offset)| (name.to_string(), *offset))
                    .collect::<Members>(),
            )
        });
        let shader = Some((size, members));
        verdict.that(format!("{name} in {place}"), host == shader, || {
            format!("host   {host:?}\n    shader {shader:?}")
        });
    }
}

#[test]
fn structs_have_the_same_members_at_the_same_offsets() {
    let types = shared_types();
    let mut verdict = Verdict::on("packed structs");
    compare_structs(&mut verdict, "types.wesl", &types);
    for (kernel, module) in linked() {
        compare_structs(&mut verdict, &kernel, &module);
    }
    let in_shader: BTreeSet<_> = packed_structs(&types)
        .into_iter()
        .map(|(name, ..)| name)
        .collect();
    let on_host: BTreeSet<_> = PACKED_STRUCTS
        .iter()
        .map(|(name, ..)| name.to_string())
        .collect();
    verdict.that(
        "both sides have the same structs",
        in_shader == on_host,
        || format!("host   {on_host:?}\n    shader {in_shader:?}"),
    );
    verdict.close();
}

/// The line of `types.wesl` after which the structs are generated.
const GENERATED: &str =
    "// Written by `UPDATE=1 cargo test --profile ci --test suite layout` from layout.rs.\n";

/// The structs of `packed!` with their docs, in WGSL.
fn generated(layout: &str) -> String {
    let (_, structs) = (layout.split_once("\npacked! {\n")).expect("layout.rs has structs");
    let (structs, _) = structs.split_once("\n}").expect("the macro ends");
    let mut text = String::new();
    let mut is_shared = false;
    for line in structs.lines() {
        let Some(line) = line.strip_prefix("    ") else {
            continue;
        };
        let item = line.trim_start();
        let indent = &line[..line.len() - item.len()];
        if let Some(doc) = item.strip_prefix("///") {
            let doc = doc.replace("[`", "`").replace("`]", "`");
            text += &format!("{indent}//{doc}\n");
        } else if let Some(name) = item.strip_suffix(" {") {
            is_shared = name == "PackedCounters";
            text += &format!("struct {name} {{\n");
        } else if let Some((name, ty)) = item.trim_end_matches(',').split_once(": ") {
            text += &format!("{indent}{name}: {},\n", in_wgsl(ty, is_shared));
        } else if item == "}" {
            text += "}\n\n";
        }
    }
    text.trim_end().to_owned() + "\n"
}

/// A type in WGSL; all invocations add to words that are shared.
fn in_wgsl(ty: &str, is_shared: bool) -> String {
    let array = ty.strip_prefix('[').and_then(|ty| ty.strip_suffix(']'));
    match array.and_then(|array| array.rsplit_once("; ")) {
        Some((element @ ("f32" | "u32"), count)) if !is_shared => {
            format!("vec{count}{}", &element[..1])
        }
        Some((element, count)) => format!("array<{}, {count}>", in_wgsl(element, is_shared)),
        None if is_shared => format!("atomic<{ty}>"),
        None => ty.to_owned(),
    }
}

#[test]
fn structs_of_shaders_are_those_of_the_host() {
    const PATH: &str = "shaders/types.wesl";
    let text = fs::read_to_string(PATH).expect("a file");
    let (own, _) = text.split_once(GENERATED).expect("the line is there");
    let layout = fs::read_to_string("crates/render/src/layout.rs").expect("a file");
    let expected = format!("{own}{GENERATED}\n{}", generated(&layout));
    if std::env::var_os("UPDATE").is_some() {
        fs::write(PATH, &expected).expect("a file that can be written");
        return;
    }
    assert!(
        text == expected,
        "shaders/types.wesl differs from layout.rs: {GENERATED}"
    );
}

macro_rules! constants {
    ($($name:ident)*) => { &[$((stringify!($name), layout::$name)),*] };
}

/// The tags and numbers of `types.wesl` as the host has them.
const CONSTANTS: &[(&str, u32)] = constants! {
    NONE
    LEAF SHAPE LEAF_COUNT_SHIFT LEAF_COUNT_ONE LEAF_COUNT_MASK LEAF_FIRST_MASK INSTANCE
    MOVING NO_INSTANCE CUT_OFF_LOOP CUT_OFF_STACK NODE_ROWS FLOAT_NODE_ROWS INSTANCE_ROWS KEY_ROWS LIGHT_ROWS CLUSTER_ROWS LIGHT_LEAF LIGHT_BY_POWER
    LIGHT_EMITTERS LIGHT_TWO_SIDED LIGHT_INDEX_MASK CAMERA_ROWS SHAPE_ROWS STACK_SIZE SHORT_STACK_SIZE IMAGE_WIDTH_LOG2
    LAYER_ROWS_LOG2
    SHAPE_SPHERE SHAPE_PLANE SHAPE_DISC SHAPE_RECTANGLE SHAPE_BOX SHAPE_CONE SHAPE_TORUS
    SHAPE_ELLIPSOID SHAPE_GLOBE SHAPE_CAPPED
    LIGHT_POINT LIGHT_DIRECTIONAL LIGHT_SPOT LIGHT_RECTANGLE LIGHT_DISC LIGHT_SPHERE MIXED_LIGHTS
    ATTENUATION_NONE ATTENUATION_INVERSE_SQUARE
    MATERIAL_TWO_SIDED MATERIAL_FRESNEL MATERIAL_SCHLICK MATERIAL_SUM MATERIAL_BLEND
    MATERIAL_COVERAGE MATERIAL_MASK MATERIAL_THIN MATERIAL_METALLIC_ROUGHNESS MATERIAL_SHADOW_CATCHER
    MATERIAL_TWO_SIDED_EMISSION MATERIAL_COLORED_MIRROR
    MATERIAL_COLORED_GLASS MATERIAL_COLORED_EMISSION LARGEST_RADIANCE_BITS
    MATERIAL_ROWS LAYERS_ROW
    SLOT_BASE SLOT_METALLIC_ROUGHNESS SLOT_F0 SLOT_TRANSMISSION
    SLOT_F90 SLOT_COAT SLOT_COAT_ROUGHNESS SLOT_SHEEN
    SLOT_SHEEN_ROUGHNESS SLOT_ANISOTROPY SLOT_IRIDESCENCE SLOT_FILM_THICKNESS
    SLOT_DIFFUSE_TRANSMISSION SLOT_DIFFUSE_TRANSMISSION_COLOR SLOT_REFLECT SLOT_EMISSION
    SLOT_METALLIC SLOT_ROUGHNESS SLOT_COAT_NORMAL
    TEXTURE_ROWS NO_TEXTURE
    PATTERN_CHECKER PATTERN_STRIPES PATTERN_GRADIENT PATTERN_NOISE PATTERN_PICTURE
    TEXTURE_UV TEXTURE_NEAREST TEXTURE_MINIFY_NEAREST TEXTURE_LEVELS TEXTURE_BETWEEN_LEVELS TEXTURE_SECOND_UV
    TEXTURE_WRAP_U_SHIFT TEXTURE_WRAP_V_SHIFT
    WRAP_REPEAT WRAP_CLAMP WRAP_MIRROR PICTURE_HALF PICTURE_SRGB PICTURE_FIRST_MASK
    BACKGROUND_COLOR BACKGROUND_GRADIENT BACKGROUND_PICTURE BACKGROUND_SKY
    BACKDROP_BACKGROUND BACKDROP_COLOR BACKDROP_TRANSPARENT
    FILTER_BOX FILTER_TENT FILTER_GAUSSIAN FILTER_BLACKMAN_HARRIS FILTER_MITCHELL
    TRIANGLE_TEST_PLANE TRIANGLE_TEST_MOLLER_TRUMBORE TRIANGLE_TEST_WATERTIGHT
    VIEW_NORMALS VIEW_DEPTH VIEW_IDS VIEW_HEAT VIEW_UV
    TONE_NONE TONE_ACES TONE_AGX TONE_REINHARD TONE_NEUTRAL
    TRANSFER_SRGB TRANSFER_LINEAR
    RAY_PRIMARY RAY_REFLECTION RAY_REFRACTION RAY_SHADOW
    RAY_OUTSIDE RAY_TRANSPARENT RAY_BOUNDARY RAY_TOTAL RAY_UNTRACED PROBE_ROWS RAY_ROWS
    LOBE_DIFFUSE LOBE_GLOSSY LOBE_COAT LOBE_SHEEN LOBE_BOUNDARY
    STEP_SCATTERED STEP_PASSED STEP_ROULETTE STEP_LIMIT STEP_ABSORBED
    SOURCE_LIGHT SOURCE_EMITTER SOURCE_ENVIRONMENT
};

#[test]
fn tags_have_the_same_values() {
    let types = shared_types();
    let value = |name: &str| {
        let (_, constant) = types
            .constants
            .iter()
            .find(|(_, constant)| constant.name.as_deref() == Some(name))?;
        match types.global_expressions[constant.init] {
            naga::Expression::Literal(naga::Literal::U32(value)) => Some(value),
            _ => None,
        }
    };
    let mut verdict = Verdict::on("constants of types.wesl");
    for (name, host) in CONSTANTS {
        let shader = value(name);
        verdict.that(name, shader == Some(*host), || {
            format!("host {host:#x}, shader {shader:x?}")
        });
    }
    for (_, constant) in types.constants.iter() {
        let name = plain(&constant.name);
        let known = CONSTANTS.iter().any(|(known, _)| *known == name);
        verdict.that(
            format!("{name} is on the host as well"),
            known,
            || "it is not in this test's table",
        );
    }
    verdict.close();
}

/// Bindings by group and slot, as defined in `render/bindings.rs`: their access in shaders.
const BINDINGS: &[(u32, u32, &str, &str)] = &[
    (0, 0, "nodes", "geometry"),
    (0, 1, "triangles", "geometry"),
    (0, 2, "vertices", "geometry"),
    (0, 3, "materials", "geometry"),
    (0, 3, "rays", "geometry"),
    (0, 4, "texels", "texels"),
    (1, 0, "frame", "read"),
    (1, 1, "dispatch", "read and write"),
    (2, 0, "film", "read and write"),
    (2, 0, "records", "read and write"),
    (2, 0, "hits", "read and write"),
    (3, 0, "tone", "read"),
    (3, 1, "developed", "read and write"),
    (3, 2, "screen", "screen"),
    (3, 3, "stride", "read"),
    (3, 4, "signal", "signal"),
    (3, 5, "guides", "guides"),
    (3, 6, "denoised", "colors out"),
    (3, 7, "noisy", "color texture"),
    (3, 8, "albedos", "albedos"),
    (3, 9, "surfaces", "color texture"),
    (3, 10, "guides_out", "guides out"),
    (3, 11, "noisy_out", "colors out"),
    (3, 12, "albedos_out", "colors out"),
    (3, 13, "surfaces_out", "colors out"),
    (3, 14, "covers", "color texture"),
    (3, 15, "covers_out", "colors out"),
];

/// The kind of a binding, as `BINDINGS` calls it.
fn kind_of(module: &Module, variable: &naga::GlobalVariable) -> &'static str {
    use ImageClass::{Sampled, Storage};
    const READ: StorageAccess = StorageAccess::LOAD;
    const WRITTEN: StorageAccess = StorageAccess::STORE;
    let multi = false;
    let (arrayed, class) = match (variable.space, &module.types[variable.ty].inner) {
        (AddressSpace::Storage { access }, _) if access == READ => return "read",
        (AddressSpace::Storage { access }, _) if access == READ | WRITTEN => {
            return "read and write";
        }
        (
            AddressSpace::Handle,
            &TypeInner::Image {
                dim: naga::ImageDimension::D2,
                arrayed,
                class,
            },
        ) => (arrayed, class),
        _ => return "something else",
    };
    let image = |format, access| Storage { format, access };
    let texture = |kind| Sampled { kind, multi };
    let images = [
        ("image", false, image(StorageFormat::Rgba32Uint, READ)),
        ("layered image", true, image(StorageFormat::R32Uint, READ)),
        ("texture", true, texture(naga::ScalarKind::Uint)),
        ("screen", false, image(StorageFormat::Rgba8Unorm, WRITTEN)),
        (
            "color image",
            false,
            image(StorageFormat::Rgba32Float, READ),
        ),
        ("color texture", false, texture(naga::ScalarKind::Float)),
        ("guide texture", false, texture(naga::ScalarKind::Uint)),
        (
            "colors out",
            false,
            image(StorageFormat::Rgba32Float, WRITTEN),
        ),
        (
            "guides out",
            false,
            image(StorageFormat::Rgba32Uint, WRITTEN),
        ),
    ];
    let found = images.iter().find(|(_, a, c)| (*a, *c) == (arrayed, class));
    found.map_or("something else", |(name, ..)| *name)
}

/// The bindings of a module: group, slot, name and kind.
fn bindings(module: &Module) -> BTreeSet<(u32, u32, String, &'static str)> {
    let bound = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| Some((variable.binding?, variable)));
    bound
        .map(|(place, variable)| {
            (
                place.group,
                place.binding,
                plain(&variable.name),
                kind_of(module, variable),
            )
        })
        .collect()
}

#[test]
fn bindings_are_where_the_host_puts_them() {
    let mut verdict = Verdict::on("bindings");
    let mut used = BTreeSet::new();
    for (kernel, module) in linked() {
        let kind_here = |kind| match (kind, kernel.ends_with("(Buffer)")) {
            ("geometry", true) => "read",
            ("texels", true) => "texture",
            ("signal", true) => "color texture",
            ("guides", true) => "guide texture",
            ("geometry" | "guides", false) => "image",
            ("texels", false) => "layered image",
            ("signal", false) => "color image",
            ("albedos", _) if kernel == "denoise (Image)" => "color image",
            ("albedos", _) => "color texture",
            (kind, _) => kind,
        };
        for (group, slot, name, kind) in bindings(&module) {
            // Two bindings may share a slot in different kernels.
            let mut here = BINDINGS
                .iter()
                .filter(|(g, s, ..)| (*g, *s) == (group, slot));
            let expected = (here.clone().find(|(.., known, _)| *known == name)).or(here.next());
            let expected = expected.map(|&(.., name, kind)| (name, kind_here(kind)));
            let found = (name.as_str(), kind);
            verdict.that(
                format!("group {group}, binding {slot} in {kernel}"),
                expected == Some(found),
                || format!("host   {expected:?}\n    shader {found:?}"),
            );
            used.insert((group, slot, name));
        }
    }
    for (group, slot, name, _) in BINDINGS {
        verdict.that(
            format!("{name} is used"),
            used.contains(&(*group, *slot, name.to_string())),
            || "by no kernel",
        );
    }
    verdict.close();
}

#[test]
fn no_kernel_needs_more_storage_buffers_than_webgpu_guarantees() {
    let mut verdict = Verdict::on("storage buffers");
    for (kernel, module) in linked() {
        let buffers = bindings(&module)
            .iter()
            .filter(|(.., kind)| kind.starts_with("read"))
            .count();
        verdict.that(kernel, buffers <= 8, || format!("{buffers} of 8"));
    }
    verdict.close();
}

/// Begins the declarations that the table of the host has.
const TABLE: &str = "\n// crates/render/src/overrides.rs explains the overrides below. \
    UPDATE=1 cargo test --profile ci --test suite layout\n";

#[test]
fn bindings_declare_the_overrides_that_the_host_sets() {
    const PATH: &str = "shaders/bindings.wesl";
    let declarations = KERNEL_OVERRIDES.iter().map(|(name, ty)| {
        let off = match *ty {
            "bool" => "false",
            "u32" => "0u",
            _ => "0.0",
        };
        format!("override {name}: {ty} = {off};\n")
    });
    let expected: String = declarations.collect();
    let source = fs::read_to_string(PATH).expect(PATH);
    let (before, found) = source.split_once(TABLE).expect("the table");
    if std::env::var_os("UPDATE").is_some() {
        fs::write(PATH, format!("{before}{TABLE}{expected}")).expect(PATH);
        return;
    }
    assert_eq!(found, expected, "UPDATE=1 writes it");
}
