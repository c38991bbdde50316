//! Materials of Wavefront libraries, and colours of vertices.

use super::{folder, scene};
use glam::{DVec3, Vec3};
use glimray::import;
use glimray::scene::{Coverage, Fresnel, Material, Scene, Shadows, Texels};
use insta::assert_snapshot;

const MODEL: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";

fn with(library: &str) -> Scene {
    let folder = folder(&[
        ("a.obj", MODEL.as_bytes()),
        ("a.mtl", format!("newmtl a\n{library}").as_bytes()),
        ("red.png", &super::textures::png()),
    ]);
    import::load(&folder.path().join("a.obj")).unwrap_or_else(|error| panic!("{error}"))
}

fn material(library: &str) -> Material {
    let mut scene = with(library);
    assert_eq!(scene.skipped, [""; 0], "{library}");
    scene.materials.swap_remove(0)
}

#[test]
fn dissolved_materials_are_seen_through() {
    for library in ["d 0.25", "Tr 0.75", "d 0.25\nillum 4"] {
        let scene = with(library);
        let material = &scene.materials[0];
        assert_eq!(
            (
                material.classical().opacity,
                material.classical().transmit,
                material.classical().ior
            ),
            (0.25, Vec3::splat(0.75), 1.0)
        );
        assert_eq!(scene.shadows, Shadows::Filtered);
    }
    let material = material("d 0.5\nTf 1 0.5 0");
    assert_eq!(material.classical().transmit, Vec3::new(0.5, 0.25, 0.0));
    // Maya and 3ds Max write these for opaque materials.
    for library in ["illum 4\nTf 1 1 1\nNi 1", "Tr 0\nd 1\nTf 1 1 1"] {
        let scene = with(library);
        assert_eq!(
            (scene.materials[0].classical().transmit, scene.shadows),
            (Vec3::ZERO, Shadows::Opaque)
        );
    }
}

#[test]
fn every_model_of_illumination_has_its_meaning() {
    let of = |model: u32| {
        material(&format!(
            "Kd 0.4 0.2 0.1\nKs 0.5 0.5 0.5\nNs 30\nd 0.2\nNi 1.4\nillum {model}"
        ))
    };
    let kd = Vec3::new(0.4, 0.2, 0.1);
    // 0: a constant colour. 1: no highlight. 2: a highlight.
    let constant = of(0);
    assert_eq!(
        (
            constant.emission,
            constant.classical().diffuse,
            constant.classical().specular
        ),
        (kd, Vec3::ZERO, Vec3::ZERO)
    );
    assert_eq!(
        (of(1).classical().diffuse, of(1).classical().specular),
        (kd, Vec3::ZERO)
    );
    assert_eq!(
        (
            of(2).classical().diffuse,
            of(2).classical().specular,
            of(2).classical().shininess
        ),
        (kd, Vec3::splat(0.5), 30.0)
    );
    for model in [0, 1, 2] {
        assert_eq!(
            (of(model).classical().reflect, of(model).classical().fresnel),
            (Vec3::ZERO, Fresnel::None)
        );
    }
    // From 3 to 7 the surroundings are reflected, which 8 and 9 do not trace; 5 and 7 by Fresnel; 6 and 7 refract.
    for model in 3..=9 {
        let material = of(model);
        let mirror = if model < 8 { 0.5 } else { 0.0 };
        assert_eq!(material.classical().reflect, Vec3::splat(mirror), "{model}");
        let is_fresnel = matches!(model, 5 | 7);
        assert_eq!(
            material.classical().fresnel == Fresnel::Exact,
            is_fresnel,
            "{model}"
        );
        let is_bent = matches!(model, 5..=7);
        assert_eq!(
            material.classical().ior,
            if is_bent { 1.4 } else { 1.0 },
            "{model}"
        );
    }
    // 10: an invisible surface that receives shadows.
    assert!(of(10).shadow_catcher && !of(2).shadow_catcher);
    for library in ["illum 11", "illum 2.5", "illum -1"] {
        assert_eq!(
            with(library).skipped,
            ["skipped in materials: `illum other than 0 to 10` 1"]
        );
    }
}

#[test]
fn emission_and_its_picture_are_kept() {
    assert_eq!(material("Ke 1 2 3").emission, Vec3::new(1.0, 2.0, 3.0));
    let pictured = material("map_Ke red.png");
    assert_eq!(
        (pictured.emission, pictured.textures.emission),
        (Vec3::ONE, Some(0))
    );
    let constant = material("illum 0\nmap_Kd red.png");
    assert_eq!(
        (constant.emission, constant.textures.emission),
        (Vec3::ONE, Some(0))
    );
}

#[test]
fn physically_based_keys_become_a_highlight_and_a_mirror() {
    // α = 0.25, so the Blinn–Phong exponent is 2/0.0625 − 2 = 30: 7.5 in Phong's model, with the height
    // 0.04 · 38/8 = 0.19. The mirror has (1 − 0.5)⁴ = 0.0625 of what Schlick's formula gives.
    let plastic = material("Kd 0.5 0.25 1\nPr 0.5\nPm 0");
    assert_eq!(plastic.classical().diffuse, Vec3::new(0.5, 0.25, 1.0));
    assert!((plastic.classical().shininess - 7.5).abs() < 1e-4);
    assert!(
        (plastic.classical().specular - 0.19).abs().max_element() < 1e-5,
        "{}",
        plastic.classical().specular
    );
    assert_eq!(plastic.classical().reflect, Vec3::splat(0.0625));
    assert_eq!(
        (plastic.classical().fresnel, plastic.classical().ior),
        (Fresnel::Schlick, 1.5)
    );
    // A metal reflects in its own colour: (1 − 0.2)⁴ = 0.4096 of it.
    let metal = material("Kd 1 0.5 0.25\nPr 0.2\nPm 1");
    let expected = 0.4096 * Vec3::new(1.0, 0.5, 0.25);
    assert!(
        (metal.classical().reflect - expected).abs().max_element() < 1e-5,
        "{}",
        metal.classical().reflect
    );
    let diffuse = 0.6 * (1.0 - 0.4096);
    assert!(
        (metal.classical().diffuse.x - diffuse).abs() < 1e-5,
        "{}",
        metal.classical().diffuse
    );
    let sheer = material("Kd 1 1 1\nPr 0.4\nd 0.3");
    assert_eq!((sheer.coverage, sheer.alpha), (Coverage::Blend, 0.3));
    assert_eq!(
        (sheer.classical().opacity, sheer.classical().transmit),
        (1.0, Vec3::ZERO)
    );
}

#[test]
fn what_the_renderer_lacks_is_named() {
    let library = "norm -bm 0.5 red.png\nmap_Ns c.png\ndisp f.png\n\
        refl -type sphere g.png\nmap_what h.png\nd -halo 0.5\n";
    assert_snapshot!(with(library).skipped.join("\n"), @r"
skipped in materials: `d -halo` 1, `disp` 1, `map_Ns` 1, `norm -bm` 1, `refl` 1
unknown in materials: `map_what` 1
");
}

#[test]
fn norm_is_a_normal_map() {
    let material = material("norm red.png");
    assert_eq!(
        (
            material.textures.normal,
            material.classical().textures.diffuse
        ),
        (Some(0), None)
    );
}

#[test]
fn normal_maps_of_models_follow_the_tangents_of_their_vertices() {
    // u grows along y and v against x.
    let text = MODEL.replace("vt 0 0\n", "vt 0 0\nvt 0 -1\nvt 1 0\n");
    let text = text.replace("f 1/1 2/1 3/1", "f 1/1 2/2 3/3");
    let of = |line: &str| {
        let folder = folder(&[
            ("a.obj", text.as_bytes()),
            ("a.mtl", format!("newmtl a\n{line}").as_bytes()),
            ("red.png", &super::textures::png()),
        ]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        scene.meshes[0].tangents.clone()
    };
    for line in ["norm red.png", "bump red.png", "Pr 0.5\naniso 0.5"] {
        assert_eq!(of(line), [glam::Vec4::new(0.0, 1.0, 0.0, 1.0); 3], "{line}");
    }
    assert!(of("map_Kd red.png").is_empty());
}

#[test]
fn coats_sheen_and_anisotropy_are_kept_for_path_tracing() {
    let coated = material("Kd 0.5 0.5 0.5\nPr 0.5\nPs 0.25\nPc 1\nPcr 0.1\naniso 0.5\nanisor 0.25");
    let model = coated.metallic_roughness().expect("the model");
    assert_eq!((model.clearcoat, model.clearcoat_roughness), (1.0, 0.1));
    assert_eq!(model.sheen_color, Vec3::splat(0.25));
    assert_eq!(model.anisotropy, 0.5);
    let quarter = std::f32::consts::FRAC_PI_2;
    assert!((model.anisotropy_rotation - quarter).abs() < 1e-6);
    // Blender writes zeros for what a material lacks.
    let plain = material("Kd 0.5 0.5 0.5\nPs 0\nPc 0\nPcr 0\naniso 0\nanisor 0");
    assert_eq!(plain.metallic_roughness(), None);
}

#[test]
fn map_d_cuts_holes_by_alpha_or_by_brightness() {
    let png = |image: image::DynamicImage| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let written = image.write_to(&mut bytes, image::ImageFormat::Png);
        written.expect("a picture");
        bytes.into_inner()
    };
    let grey = image::GrayImage::from_pixel(1, 1, image::Luma([51]));
    let clear = image::RgbaImage::from_pixel(1, 1, image::Rgba([9, 200, 9, 102]));
    for (bytes, alpha) in [(png(grey.into()), 51), (png(clear.into()), 102)] {
        let folder = folder(&[
            ("a.obj", MODEL.as_bytes()),
            ("a.mtl", b"newmtl a\nd 0.5\nmap_d a.png"),
            ("a.png", &bytes),
        ]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        let material = &scene.materials[0];
        assert_eq!((material.coverage, material.alpha), (Coverage::Blend, 0.5));
        assert_eq!(
            (material.classical().opacity, material.classical().transmit),
            (1.0, Vec3::ZERO)
        );
        assert_eq!(material.textures.alpha, Some(0));
        let texels = Texels::Linear8(vec![[255, 255, 255, alpha]]);
        assert_eq!(scene.pictures[0].texels, texels);
    }
}

#[test]
fn textures_are_scaled_and_moved() {
    let scene = with("map_Kd -s 2 3 1 -o 0.5 0.25 0 -blendu on -mm 0 2 red.png");
    let place = scene.textures[0]
        .pattern_from_space
        .transform_point3(DVec3::new(1.0, 1.0, 0.0));
    assert_eq!(place, DVec3::new(2.5, 3.25, 0.0));
    assert_eq!(scene.skipped, ["skipped in materials: `map_Kd -mm` 1"]);
}

#[test]
fn vertices_have_their_colours() {
    // MeshLab writes them after the position, ZBrush after a weight too; 0.7373 is 188 of 255.
    let text =
        "v 0 0 0 1 0 0\nv 1 0 0 1 0.7373 0.7373 0.7373\nv 0 1 0 0 0 1\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    let scene = scene("a.obj", text);
    let mesh = &scene.meshes[0];
    let at = |position: Vec3| {
        let index = mesh
            .positions
            .iter()
            .position(|p| *p == position)
            .expect("a vertex");
        mesh.colors[index].truncate()
    };
    assert_eq!(
        (at(Vec3::ZERO), at(Vec3::Y), at(Vec3::new(1.0, 1.0, 0.0))),
        (Vec3::X, Vec3::Z, Vec3::ONE)
    );
    assert!((at(Vec3::X) - 0.5029).abs().max_element() < 1e-4);
    assert_eq!(scene.skipped, [""; 0]);
}

#[test]
fn colours_of_vertices_multiply_the_material() {
    let model = MODEL.replace("v 0 0 0", "v 0 0 0 0 1 1");
    let folder = folder(&[
        ("a.obj", model.as_bytes()),
        ("a.mtl", b"newmtl a\nKd 0.5 0.25 1\n"),
    ]);
    let scene = import::load(&folder.path().join("a.obj")).expect("a scene");
    assert_eq!(
        scene.materials[0].classical().diffuse,
        Vec3::new(0.5, 0.25, 1.0)
    );
    let mesh = &scene.meshes[0];
    let first = mesh.positions.iter().position(|p| *p == Vec3::ZERO);
    for (index, color) in mesh.colors.iter().enumerate() {
        let expected = match Some(index) == first {
            true => glam::vec4(0.0, 1.0, 1.0, 1.0),
            false => glam::Vec4::ONE,
        };
        assert_eq!(*color, expected);
    }
}

#[test]
fn height_maps_become_normal_maps_by_their_slopes() {
    let png = |image: image::DynamicImage| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let written = image.write_to(&mut bytes, image::ImageFormat::Png);
        written.expect("a picture");
        bytes.into_inner()
    };
    // Rows from the top: the surface rises to the right by 10 levels a texel, and upwards by 40.
    let rising =
        image::GrayImage::from_fn(5, 4, |x, y| image::Luma([(10 * x + 40 * (3 - y)) as u8]));
    let coded = image::RgbImage::from_pixel(5, 4, image::Rgb([120, 130, 250]));
    let read = |image: image::DynamicImage, line: &str| {
        let folder = folder(&[
            ("a.obj", MODEL.as_bytes()),
            ("a.mtl", format!("newmtl a\n{line} a.png").as_bytes()),
            ("a.png", &png(image)),
        ]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        assert_eq!(scene.skipped, [""; 0]);
        let material = &scene.materials[0];
        assert_eq!(material.textures.normal, Some(0));
        let texels: Vec<_> = scene.pictures[0].linear().collect();
        (texels, material.normal_scale)
    };
    for (line, sign, scale) in [
        ("bump", 1.0, 1.0),
        ("map_Bump -bm 2", 1.0, 2.0),
        ("MAP_BUMP -bm -3", -1.0, 3.0),
    ] {
        let (texels, found) = read(rising.clone().into(), line);
        assert_eq!(found, scale, "{line}");
        // In the middle of the picture; at its edges it is repeated.
        let normal = 2.0 * texels[5 + 2].as_dvec4().truncate() - 1.0;
        let slopes = DVec3::new(-10.0 / 255.0 * sign, -40.0 / 255.0 * sign, 1.0);
        assert!(
            (normal - slopes.normalize()).length() < 1e-3,
            "{line}: {normal}"
        );
    }
    // A picture with colours is a normal map already.
    let (texels, _) = read(coded.into(), "map_Bump");
    let expected = [120.0, 130.0, 250.0].map(|code: f32| code / 255.0);
    assert!((texels[7].truncate() - Vec3::from(expected)).length() < 1e-5);
    // A normal map counts before heights.
    let both = material("bump gone.png\nnorm red.png");
    assert_eq!(both.textures.normal, Some(0));
}

#[test]
fn d_decides_where_tr_is_given_too() {
    for library in ["d 1\nTr 1", "Tr 1\nd 1", "Tr 0.25\nd 1"] {
        let material = material(library);
        assert_eq!(
            (material.classical().opacity, material.classical().transmit),
            (1.0, Vec3::ZERO)
        );
    }
    assert_eq!(material("Tr 0.5\nd 0.25").classical().opacity, 0.25);
}

#[test]
fn tr_of_one_in_every_material_means_opaque_and_is_reported() {
    let library = "Tr 1\nKd 1 0 0\nnewmtl b\nTr 1.000000\n";
    let scene = with(library);
    assert_eq!(scene.materials[0].classical().opacity, 1.0);
    assert_snapshot!(scene.skipped.join("\n"), @"`Tr 1` without `d` read as opaque, as MeshLab writes it: 2");
    // With a material that is opaque by 0, `Tr` is 1 - d.
    let scene = with("Tr 1\nnewmtl b\nTr 0");
    assert_eq!(scene.materials[0].classical().opacity, 0.0);
    assert_snapshot!(scene.skipped.join("\n"), @"the model is wholly transparent: none of its materials shows anything");
    assert_eq!(with("Tr 0.25").materials[0].classical().opacity, 0.75);
}

#[test]
fn a_model_that_is_wholly_transparent_is_reported() {
    let note = "the model is wholly transparent: none of its materials shows anything";
    for library in ["d 0", "d 0\nPr 0.5", "d -1\nillum 4"] {
        assert_eq!(with(library).skipped.last().map(String::as_str), Some(note));
    }
    for library in ["d 0.1", "d 0\nillum 3\nKs 1 1 1", "Ke 1 1 1\nd 0"] {
        assert!(
            !with(library).skipped.contains(&note.to_owned()),
            "{library}"
        );
    }
}

/// The formulas of models 6 and 7 pass (1 - Ks) Tf of the light behind and Ft Tf, and do not have d.
#[test]
fn glass_passes_what_its_filter_does() {
    let glass = "Kd 0 0 0\nKs 0.2 0.2 0.2\nNi 1.2\nTf 1 0.5 0";
    for dissolved in ["", "\nd 1"] {
        let six = material(&format!("{glass}{dissolved}\nillum 6"));
        assert_eq!(six.classical().transmit, Vec3::new(0.8, 0.4, 0.0));
        assert_eq!(
            (six.classical().fresnel, six.classical().ior, six.thin),
            (Fresnel::None, 1.2, false)
        );
        let seven = material(&format!("illum 7\n{glass}{dissolved}"));
        assert_eq!(seven.classical().transmit, Vec3::new(1.0, 0.5, 0.0));
        assert_eq!(
            (seven.classical().fresnel, seven.classical().ior),
            (Fresnel::Exact, 1.2)
        );
        assert_eq!(seven.classical().reflect, Vec3::splat(0.2));
    }
    // McGuire's Cornell box.
    let ball =
        "Ns 1000\nNi 2.5\nillum 7\nKa 0.01 0.01 0.01\nKd 0.01 0.01 0.01\nKs 0.9 0.9 0.9\nTf 0.1";
    assert_eq!(material(ball).classical().transmit, Vec3::splat(0.1));
    // No light is gained where the surface has a colour of its own.
    let colored = material("Kd 0.75 0 1\nTf 1 1 1\nillum 7");
    assert_eq!(colored.classical().transmit, Vec3::new(0.25, 1.0, 0.0));
    // Without filter and dissolve, what the colour leaves is refracted.
    assert_eq!(
        material("Kd 0 0 0\nillum 7").classical().transmit,
        Vec3::ONE
    );
    assert_eq!(
        material("Kd 0 0 0\nillum 7\nd 1").classical().transmit,
        Vec3::ZERO
    );
    assert_eq!(
        material("Kd 0 0 0\nillum 6\nTf 0 0 0").classical().transmit,
        Vec3::ZERO
    );
}

#[test]
fn black_panes_with_a_filter_are_clear_and_reported() {
    for model in [4, 9] {
        let scene = with(&format!("Kd 0 0 0\nKs 0 0 0\nTf 1 1 1\nillum {model}"));
        let pane = &scene.materials[0];
        assert_eq!((pane.classical().transmit, pane.thin), (Vec3::ONE, true));
        let note = "black glass without `d` but with `Tf` (`illum` 4 or 9) read as clear: 1";
        assert_eq!(scene.skipped[0], note);
        let opaque = material(&format!("Kd 0 0 0\nTf 1 1 1\nd 1\nillum {model}"));
        assert_eq!(opaque.classical().transmit, Vec3::ZERO);
    }
}

#[test]
fn keys_may_have_any_case() {
    let plain =
        material("Kd 1 0 0\nKs 0 1 0\nKa 0 0 1\nKe 1 1 1\nNs 9\nd 0.5\nillum 2\nmap_Kd red.png");
    let lower =
        material("kd 1 0 0\nks 0 1 0\nka 0 0 1\nke 1 1 1\nns 9\nD 0.5\nILLUM 2\nmap_kd red.png");
    let upper =
        material("KD 1 0 0\nKS 0 1 0\nKA 0 0 1\nKE 1 1 1\nNS 9\nd 0.5\nIllum 2\nMAP_KD red.png");
    assert_eq!((&lower, &upper), (&plain, &plain));
    let mask = [material("map_d red.png"), material("map_D red.png")];
    assert!(mask.iter().all(|m| m.textures.alpha == Some(0)));
    let normal = [material("norm red.png"), material("map_Kn red.png")];
    assert!(normal.iter().all(|m| m.textures.normal == Some(0)));
}

#[test]
fn colours_may_be_in_xyz() {
    // The white of Rec. 709, and one number for all three.
    let white = material("Kd xyz 0.9505 1 1.089").classical().diffuse;
    assert!((white - 1.0).abs().max_element() < 1e-3, "{white}");
    let equal = material("Kd xyz 0.5").classical().diffuse;
    assert!(
        (equal - Vec3::new(0.6025, 0.4742, 0.4544))
            .abs()
            .max_element()
            < 1e-3,
        "{equal}"
    );
}

#[test]
fn pictures_of_roughness_and_metalness_are_kept() {
    let scene = with(
        "map_Pr red.png\nmap_Pm red.png\nmap_Ps red.png\nmap_Pc red.png\nmap_Pcr red.png\nmap_Kd red.png",
    );
    assert_eq!(scene.skipped, [""; 0]);
    let material = &scene.materials[0];
    let model = material.metallic_roughness().expect("the model");
    assert_eq!(
        (model.roughness, model.metallic, model.clearcoat),
        (1.0, 1.0, 1.0)
    );
    let layers = &model.textures;
    let slots = [
        layers.base_color,
        layers.roughness,
        layers.metallic,
        layers.sheen_color,
        layers.clearcoat,
        layers.clearcoat_roughness,
    ];
    assert!(slots.iter().all(Option::is_some), "{layers:?}");
}

#[test]
fn values_of_materials_that_cannot_be_used_are_repaired_and_reported() {
    let library = "Kd 1 0\nKs 1 0 -1\nKe inf 0 0\nKa\nNs -3\nNi 11\nd much\nTr -1\nPr nan\nPs -1\n\
        map_Ks\nillum\nnewmtl\nKd 1 1 1\n";
    let scene = with(library);
    let material = &scene.materials[0];
    assert_eq!(material.classical().specular, Vec3::X);
    assert_eq!(
        (material.emission, material.classical().opacity),
        (Vec3::ZERO, 1.0)
    );
    assert_snapshot!(scene.skipped.join("\n"), @r"
`Kd`: without a number skipped: 1 (line 2 of a.mtl)
`Ks`: negative numbers set to 0: 1 (line 3 of a.mtl)
`Ke`: values that are not finite numbers skipped: 1 (line 4 of a.mtl)
`Ka`: without a number skipped: 1 (line 5 of a.mtl)
`Ns`: numbers out of range clamped: 1 (line 6 of a.mtl)
`Ni`: numbers out of range clamped: 1 (line 7 of a.mtl)
`d`: values that are not finite numbers skipped: 1 (line 8 of a.mtl)
`Tr`: numbers out of range clamped: 1 (line 9 of a.mtl)
`Pr`: values that are not finite numbers skipped: 1 (line 10 of a.mtl)
`Ps`: numbers out of range clamped: 1 (line 11 of a.mtl)
`map_Ks`: pictures without a file skipped: 1 (line 12 of a.mtl)
`illum`: without a number skipped: 1 (line 13 of a.mtl)
`newmtl`: materials without a name: 1 (line 14 of a.mtl)
");
    // Keys before the first material, and binary files.
    for (library, note) in [
        (
            &b"Kd 1 0 0\nnewmtl a\n"[..],
            "`Kd`: before the first `newmtl` skipped: 1 (line 1 of a.mtl)",
        ),
        (
            b"\x89PNG\0\0\0\x01",
            "the material file `a.mtl` skipped: a zero byte: the file is binary, not text",
        ),
    ] {
        let folder = folder(&[("a.obj", MODEL.as_bytes()), ("a.mtl", library)]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        assert_eq!(scene.skipped[0], note);
    }
}

#[test]
fn a_library_that_cannot_be_found_is_looked_for_beside_the_model() {
    let names = [
        "C:\\Users\\alice\\my models\\a.mtl",
        "/home/alice/models/a.mtl",
        "../export/a.mtl",
        "textures/a.mtl",
        "\"a.mtl\"",
        "A:\\a.mtl",
    ];
    for name in names {
        let model = MODEL.replace("a.mtl", name);
        let folder = folder(&[
            ("a.obj", model.as_bytes()),
            ("a.mtl", b"newmtl a\nKd 1 0 0\nmap_Ke D:\\red.png\n"),
            ("red.png", &super::textures::png()),
        ]);
        let scene = import::load(&folder.path().join("a.obj")).expect("a model");
        let material = &scene.materials[0];
        assert_eq!(material.classical().diffuse, Vec3::X, "{name}");
        assert_eq!(material.textures.emission, Some(0), "{name}");
        let is_said = scene.skipped[0].contains("replaced by the file of that name");
        assert!(is_said, "{name}: {:?}", scene.skipped);
    }
}
