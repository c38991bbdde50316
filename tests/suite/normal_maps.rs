//! Normal maps: pictures of flat quads whose map says what interpolated normals would.

use crate::reference::compare::{assert_none, check_alike, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::harness::gpu;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat2, DQuat, DVec2, DVec3, Vec2, Vec3, dvec3, vec3};
use glimray::scene::{
    Light, LightKind, Material, Minify, Pattern, Phong, Picture, Scene, Space, Texels, Texture,
    Textures, Wrap,
};
use glimray::{export, import};
use std::sync::Arc;

/// The colour of a normal that leans along u and against v.
const CODE: [u8; 4] = [190, 90, 220, 255];
const SCALE: f32 = 0.75;

/// A quad in the plane z = 0 that faces +z, with u and v from x and y by `uv_from_xy`, under one light.
fn quad(uv_from_xy: DMat2, placement: DAffine3, material: Material) -> Scene {
    let mut scene = scenes::empty();
    scene.cameras[0].look_from = dvec3(0.0, 0.0, 0.3);
    scene.cameras[0].look_at = DVec3::NEG_Z;
    scene.pictures.push(Arc::new(Picture {
        width: 1,
        height: 1,
        texels: Texels::Linear8(vec![CODE]),
        origin: glimray::scene::Origin::Texels,
    }));
    scene.textures.push(Texture {
        pattern: Pattern::Picture {
            picture: 0,
            nearest: false,
            minify: Minify::default(),
            wrap: [Wrap::Repeat; 2],
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::IDENTITY,
    });
    scene.lights.push(Light {
        color: Vec3::ONE,
        kind: LightKind::Directional {
            direction: dvec3(-0.3, -0.5, -1.0).normalize(),
        },
        ..Light::default()
    });
    let material = scene.add_material(material);
    let mut mesh = scenes::quad(0.9, material as u32);
    for p in &mut mesh.positions {
        *p = vec3(p.x, -p.z, 0.0);
    }
    mesh.normals = vec![Vec3::Z; 4];
    let uv = |p: &Vec3| (uv_from_xy * DVec2::new(p.x.into(), p.y.into())).as_vec2();
    mesh.uvs = mesh.positions.iter().map(uv).collect();
    scene.add_mesh(mesh, placement);
    scene
}

fn shiny(normal: Option<usize>) -> Material {
    Material {
        two_sided: true,
        normal_scale: SCALE,
        textures: Textures {
            normal,
            ..Textures::default()
        },
        bsdf: Phong {
            specular: Vec3::splat(0.4),
            shininess: 9.0,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    }
}

/// The normal of `CODE` in space, from the definition of tangent space.
fn mapped(uv_from_xy: DMat2) -> DVec3 {
    let xy_from_uv = uv_from_xy.inverse();
    let along_u = xy_from_uv.x_axis.extend(0.0).normalize();
    let along_v = DVec3::Z.cross(along_u) * uv_from_xy.determinant().signum();
    let [x, y, z, _] = CODE.map(|code| 2.0 * f64::from(code) / 255.0 - 1.0);
    let scale = f64::from(SCALE);
    (scale * x * along_u + scale * y * along_v + z * DVec3::Z).normalize()
}

#[test]
fn a_map_of_one_normal_looks_as_if_all_vertices_had_it() {
    let turn = |degrees: f64| DMat2::from_angle(degrees.to_radians());
    let mirror = DMat2::from_diagonal(DVec2::new(-1.0, 1.0));
    let mappings = [
        ("as it is", DMat2::IDENTITY),
        ("turned", turn(35.0)),
        ("mirrored", mirror),
        (
            "mirrored, turned and squeezed",
            mirror * turn(120.0) * DMat2::from_diagonal(DVec2::new(3.0, 0.5)),
        ),
    ];
    let ahead = DAffine3::from_translation(dvec3(0.0, 0.0, -1.0));
    let turned =
        DAffine3::from_rotation_translation(DQuat::from_rotation_y(0.6), dvec3(0.1, 0.0, -1.2));
    let mut problems = Vec::new();
    for (name, mapping) in mappings {
        for placement in [ahead, turned] {
            let with_map = quad(mapping, placement, shiny(Some(0)));
            let mut with_normals = quad(mapping, placement, shiny(None));
            for mesh in &mut with_normals.meshes {
                let mesh = Arc::make_mut(mesh);
                mesh.normals = vec![mapped(mapping).as_vec3(); mesh.positions.len()];
            }
            let flat = quad(mapping, placement, shiny(None));
            let [with_map, with_normals, flat] =
                [with_map, with_normals, flat].map(|scene| render(&scene, &sized(48, 48)).0);
            problems.push(check_alike(name, &with_map, &with_normals, 0.2, 0.0));
            assert!(
                check_alike("flat", &with_map, &flat, 5.0, 0.2).is_err(),
                "{name} shows nothing"
            );
        }
    }
    assert_none(problems);
}

#[test]
fn tangents_follow_u_in_the_plane_of_the_normal() {
    let mut random = Random::new(5);
    let inputs: Vec<_> = (0..4000)
        .map(|_| {
            let [e1, e2, n] = [0; 3].map(|_| random.direction().as_vec3());
            let [d1, d2] = [0; 2].map(|_| {
                let d = random.direction();
                [d.x as f32, d.y as f32]
            });
            (e1.to_array(), e2.to_array(), d1, d2, n.to_array())
        })
        .collect();
    let found: Vec<[f32; 4]> = gpu().map("lib::tangent::tangent_along", &inputs);
    let mut verdict = Verdict::on("tangent_along");
    for ((e1, e2, d1, d2, n), [x, y, z, hand]) in inputs.iter().zip(found) {
        let [e1, e2, n] = [e1, e2, n].map(|v| Vec3::from(*v).as_dvec3());
        let [d1, d2] = [d1, d2].map(|d| Vec2::from(*d).as_dvec2());
        // The derivative of the position by u, with v held.
        let area = d1.perp_dot(d2);
        let along = (e1 * d2.y - e2 * d1.y) / area;
        let expected = (along - along.dot(n) * n).normalize();
        let is_clear =
            area.abs() > 1e-3 && (along.normalize() - along.normalize().dot(n) * n).length() > 1e-2;
        let got = dvec3(x.into(), y.into(), z.into());
        let holds =
            !is_clear || (got - expected).length() < 1e-3 && f64::from(hand) == area.signum();
        verdict.that(format!("{e1} {e2} {d1} {d2} {n}"), holds, || {
            format!("{got} {hand}, not {expected}")
        });
        let is_tangent = (got.length() - 1.0).abs() < 1e-5 && got.dot(n).abs() < 1e-4;
        verdict.that("a unit vector in the plane", is_tangent, || {
            format!("{got}")
        });
    }
    verdict.close();
}

#[test]
fn without_area_in_u_and_v_any_tangent_will_do() {
    let flat = (
        [1f32, 0.0, 0.0],
        [0f32, 1.0, 0.0],
        [0.5f32, 0.5],
        [0.5f32, 0.5],
        [0f32, 0.0, 1.0],
    );
    let none = ([0f32; 3], [0f32; 3], [0f32; 2], [0f32; 2], [1f32, 0.0, 0.0]);
    let found: Vec<[f32; 4]> = gpu().map("lib::tangent::tangent_along", &[flat, none]);
    for ([x, y, z, hand], n) in found.into_iter().zip([Vec3::Z, Vec3::X]) {
        let tangent = Vec3::new(x, y, z);
        assert!(
            (tangent.length() - 1.0).abs() < 1e-6 && tangent.dot(n).abs() < 1e-6,
            "{tangent}"
        );
        assert_eq!(hand.abs(), 1.0);
    }
}

#[test]
fn a_native_scene_names_a_map_and_gets_it_back_when_it_is_exported() {
    let mut png = std::io::Cursor::new(Vec::new());
    let [r, g, b, _] = CODE;
    image::RgbImage::from_pixel(2, 1, image::Rgb([r, g, b]))
        .write_to(&mut png, image::ImageFormat::Png)
        .expect("a picture");
    let text = "
        [materials.rough]
        phong.diffuse = { picture = 'n.png' }
        normal_map = { picture = { file = 'n.png', wrap = 'mirror' }, strength = 0.75, scale = 0.5 }
        occlusion_map = { picture = 'n.png', strength = 0.25, space = 'second-uv' }
        thin = true
        [[objects]]
        sphere = { center = [0, 0, -3], radius = 1 }
        material = 'rough'";
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("n.png"), png.into_inner()).expect("a picture");
    std::fs::write(folder.path().join("a.toml"), text).expect("a scene");
    let scene = import::load(&folder.path().join("a.toml")).expect("a scene");
    let material = &scene.materials[0];
    assert_eq!(material.normal_scale, 0.75);
    assert!(material.thin);
    assert_eq!(material.occlusion_strength, 0.25);
    let occlusion = &scene.textures[material.textures.occlusion.expect("a map")];
    assert_eq!(occlusion.space, Space::SecondUv);
    let map = &scene.textures[material.textures.normal.expect("a map")];
    let color = &scene.textures[material.classical().textures.diffuse.expect("a texture")];
    let texels = |texture: &Texture| match texture.pattern {
        Pattern::Picture { picture, .. } => scene.pictures[picture].texels.clone(),
        _ => panic!("no picture"),
    };
    assert_eq!(texels(map), Texels::Linear8(vec![CODE; 2]));
    assert_eq!(texels(color), Texels::Srgb8(vec![CODE; 2]));
    assert!(matches!(
        map.pattern,
        Pattern::Picture {
            wrap: [Wrap::Mirror, Wrap::Mirror],
            ..
        }
    ));
    assert_eq!(
        map.pattern_from_space,
        DAffine3::from_scale(DVec3::splat(2.0))
    );

    let export = export::native(&scene, "b", &|_, _| false).expect("an export");
    let folder = tempfile::tempdir().expect("a folder");
    for file in &export.files {
        std::fs::write(folder.path().join(&file.name), &file.bytes).expect("a file");
    }
    std::fs::write(folder.path().join("b.toml"), &export.text).expect("a scene");
    let again = import::load(&folder.path().join("b.toml")).expect("a scene");
    assert_eq!(again.materials, scene.materials);
    assert_eq!(
        (&again.textures, &again.pictures),
        (&scene.textures, &scene.pictures)
    );
}
