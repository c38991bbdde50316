//! Emissive textures whose brightness differs from triangle to triangle.

use super::{lit_floor, matte, mean, near, paths};
use crate::reference::compare::render;
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec2, DVec3, UVec2, Vec3, Vec4, dvec3, vec3};
use glimray::pack;
use glimray::scene::{
    Deformation, Light, Material, Mesh, Minify, MorphTarget, Pattern, Picture, Scene, Space,
    Texture, Textures, Wrap,
};
use std::sync::Arc;

/// Quads along each side of the panel.
const SIDE: u32 = 16;

/// A panel of quads over the floor that faces it, with corners of their own and the picture over all of them.
fn panel(quads: impl IntoIterator<Item = [u32; 2]>, material: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for [x, y] in quads {
        let first = mesh.positions.len() as u32;
        for [dx, dy] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
            let [u, v] = [x + dx, y + dy].map(|k| k as f32 / SIDE as f32);
            mesh.positions.push(vec3(u - 0.5, 1.2, v - 1.2));
            mesh.normals.push(-Vec3::Y);
            mesh.uvs.push([u, v].into());
            mesh.materials.push(material);
        }
        let corners = [[0, 1, 2], [0, 2, 3]];
        (mesh.triangles).extend(corners.map(|corners| corners.map(|k| first + k)));
    }
    mesh
}

fn dark_floor() -> Scene {
    let mut scene = lit_floor(matte(0.5), Light::default());
    scene.lights.clear();
    scene
}

fn glowing(texture: Option<usize>) -> Material {
    Material {
        emission: Vec3::splat(500.0),
        two_sided: false,
        textures: Textures {
            emission: texture,
            ..Textures::default()
        },
        ..matte(0.0)
    }
}

/// A panel of 256 quads, of which the texture makes this one bright, and that quad without a texture.
fn panel_and_quad(bright: [u32; 2]) -> [Scene; 2] {
    let mut textured = dark_floor();
    let places = (0..SIDE * SIDE).map(|k| [k % SIDE, SIDE - 1 - k / SIDE]);
    let texels = places.clone().map(|place| match place == bright {
        true => Vec3::ONE,
        false => Vec3::ZERO,
    });
    add_picture_texture(&mut textured, Picture::opaque(SIDE, SIDE, texels));
    let material = textured.add_material(glowing(Some(0)));
    textured.add_mesh(panel(places, material as u32), DAffine3::IDENTITY);
    let mut alone = dark_floor();
    let material = alone.add_material(glowing(None));
    alone.add_mesh(panel([bright], material as u32), DAffine3::IDENTITY);
    [textured, alone]
}

pub fn add_picture_texture(scene: &mut Scene, picture: Picture) {
    scene.pictures.push(picture.into());
    scene.textures.push(Texture {
        pattern: Pattern::Picture {
            picture: scene.pictures.len() - 1,
            nearest: true,
            minify: Minify::Nearest,
            wrap: [Wrap::Repeat; 2],
        },
        space: Space::Uv,
        pattern_from_space: DAffine3::IDENTITY,
    });
}

/// The relative mean squared error of a picture with few samples, and the mean luminance with many.
fn noise(scene: &Scene) -> [f64; 2] {
    let image = |samples| render(scene, &paths(samples, (24, 16), 0)).0;
    let (few, many) = (image(16), image(2048));
    let pairs = few.pixels.iter().zip(&many.pixels);
    let errors = pairs.map(|(few, many)| {
        let [few, many] = [few[1], many[1]].map(f64::from);
        ((few - many) / many.max(1e-3)).powi(2)
    });
    let sum: f64 = many.pixels.iter().map(|pixel| f64::from(pixel[1])).sum();
    let count = few.pixels.len() as f64;
    [errors.sum::<f64>() / count, sum / count]
}

/// Light samples go where a texture is bright: a panel that is black but for one quad gives the light of that quad, and
/// most samples find it. If they went anywhere on the panel, one in 256 would, and the error would be above 1.
#[test]
fn light_samples_go_where_a_texture_is_bright() {
    let mut verdict = Verdict::on("a panel with one bright quad");
    for bright in [[3, 11], [15, 0]] {
        let [textured, alone] = panel_and_quad(bright).map(|scene| noise(&scene));
        let what = format!("quad {bright:?}");
        near(
            &mut verdict,
            format!("{what}: light"),
            textured[1],
            alone[1],
            0.01 * alone[1],
        );
        verdict.that(format!("{what}: noise"), textured[0] < 0.03, || textured[0]);
    }
    verdict.close();
}

/// Where the mesh deforms, each triangle keeps its part of the texture, though the tree puts triangles in another order.
#[test]
fn triangles_keep_their_brightness_when_they_move() {
    let [still, _] = panel_and_quad([3, 11]);
    let mut moved = still.clone();
    let mesh = Arc::make_mut(&mut moved.meshes[0]);
    let rest: Vec<Vec3> = mesh.positions.clone();
    // At rest all quads are elsewhere, in another order.
    for (k, position) in mesh.positions.iter_mut().enumerate() {
        let quad = (k as u32 / 4) * 97 % (SIDE * SIDE);
        let [x, z] = [quad % SIDE, quad / SIDE].map(|place| place as f32 / SIDE as f32);
        *position = vec3(x, 2.0, z) + (rest[k] - rest[4 * (k / 4)]);
    }
    let ways = mesh
        .positions
        .iter()
        .zip(&rest)
        .map(|(from, to)| *to - *from);
    let target = MorphTarget {
        vertices: (0..rest.len() as u32).collect(),
        positions: ways.collect(),
        normals: Vec::new(),
        tangents: Vec::new(),
    };
    moved.deformations.push(Deformation {
        mesh: 0,
        weights: vec![1.0],
        targets: Arc::new([target]),
        skin: None,
        flat: Arc::default(),
    });
    let [expected, found] = [still, moved].map(|scene| noise(&scene));
    let mut verdict = Verdict::on("a panel whose quads were moved to their places");
    near(
        &mut verdict,
        "light",
        found[1],
        expected[1],
        0.01 * expected[1],
    );
    verdict.that("noise", found[0] < 1.5 * expected[0], || {
        format!("{} and {}", found[0], expected[0])
    });
    verdict.close();
}

/// A value of a smooth periodic picture.
fn wave(x: f64, y: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    1.0 + 0.7 * (turn * x).sin() * (turn * y).cos() + 0.25 * (2.0 * turn * y).sin()
}

/// The chance of each triangle follows the mean of the picture over it, however the picture lies there.
#[test]
fn emitters_know_the_mean_of_their_part_of_a_picture() {
    const TEXELS: u32 = 256;
    let mut random = Random::new(12);
    let mut verdict = Verdict::on("luminances of triangles");
    let transform = DAffine3::from_translation(dvec3(0.3, 0.1, 0.0))
        * DAffine3::from_rotation_z(0.7)
        * DAffine3::from_scale(dvec3(1.5, 0.8, 1.0));
    let mirrored = |x: f64| (x.rem_euclid(2.0) - 1.0).abs();
    type Wrapping<'a> = (Wrap, &'a dyn Fn(f64) -> f64);
    let wraps: [Wrapping; 3] = [
        (Wrap::Repeat, &|x| x),
        (Wrap::Clamp, &|x| x.clamp(0.0, 1.0)),
        (Wrap::Mirror, &|x| 1.0 - mirrored(x)),
    ];
    for (wrap, inside) in wraps {
        for space in [Space::Uv, Space::SecondUv] {
            let mut scene = dark_floor();
            let centers = (0..TEXELS * TEXELS).map(|k| {
                let (x, y) = (k % TEXELS, TEXELS - 1 - k / TEXELS);
                DVec2::new(x.into(), y.into()) + 0.5
            });
            let texels = centers.map(|at| {
                let at = at / f64::from(TEXELS);
                Vec3::splat(wave(at.x, at.y) as f32)
            });
            add_picture_texture(&mut scene, Picture::opaque(TEXELS, TEXELS, texels));
            let texture = &mut scene.textures[0];
            (texture.space, texture.pattern_from_space) = (space, transform);
            if let Pattern::Picture { wrap: own, .. } = &mut texture.pattern {
                *own = [wrap; 2];
            }
            let material = scene.add_material(glowing(Some(0)));
            let mut mesh = Mesh::default();
            for k in 0..60 {
                let corner = DVec2::new(random.between(-1.0, 2.0), random.between(-1.0, 2.0));
                let size = [0.03, 0.08, 0.2][k % 3];
                let first = 3 * k as u32;
                mesh.triangles.push([first, first + 1, first + 2]);
                for _ in 0..3 {
                    let [x, y] = [0, 1].map(|_| random.between(-size, size));
                    let uv = (corner + DVec2::new(x, y)).as_vec2();
                    let place = random.in_cube() + 3.0 * k as f64 * DVec3::X;
                    mesh.positions.push(place.as_vec3());
                    mesh.normals.push(Vec3::Y);
                    mesh.materials.push(material as u32);
                    let other = vec3(0.1, 0.2, 0.0).truncate();
                    let is_second = space == Space::SecondUv;
                    mesh.uvs.push(if is_second { other } else { uv });
                    mesh.second_uvs.push(if is_second { uv } else { other });
                }
            }
            scene.add_mesh(mesh.clone(), DAffine3::IDENTITY);
            let packed = pack::scene(&scene).expect("a packed scene");
            let view = packed.frame(&scene.frame(0.0)).expect("a view");
            let glows: Vec<f32> = view.emitter_glows.iter().flatten().copied().collect();
            assert_eq!(view.emitters.len(), 60);
            for (emitter, glow) in view.emitters.iter().zip(glows) {
                let packed_triangle = packed.triangles.get(emitter.primitive as usize);
                let first = packed_triangle.expect("a triangle").i0;
                // Each triangle has corners of its own, in order.
                let k = first as usize / 3 * 3;
                let set = match space {
                    Space::SecondUv => &mesh.second_uvs,
                    _ => &mesh.uvs,
                };
                let corners = [k, k + 1, k + 2].map(|k| set[k].as_dvec2());
                const STEPS: usize = 60;
                let (mut sum, mut count) = (0.0, 0.0);
                for i in 0..STEPS {
                    for j in 0..STEPS - i {
                        let [a, b] = [i, j].map(|k| (k as f64 + 1.0 / 3.0) / STEPS as f64);
                        let uv = (1.0 - a - b) * corners[0] + a * corners[1] + b * corners[2];
                        let at = transform.transform_point3(uv.extend(0.0));
                        sum += wave(inside(at.x), inside(at.y));
                        count += 1.0;
                    }
                }
                let expected = 500.0 * sum / count;
                verdict.that(
                    format!("{wrap:?}, {space:?}, triangle at {k}"),
                    (f64::from(glow) - expected).abs() < 0.08 * 500.0,
                    || format!("{glow}, expected {expected}"),
                );
            }
        }
    }
    verdict.close();
}

/// A panel whose light rises along x, in so few and in many triangles. By symmetry half of it on either side of its middle
/// adds up to an even panel there.
#[test]
fn light_of_vertices_whose_emission_rises_is_that_of_their_mean() {
    let mut verdict = Verdict::on("panels with colours");
    let under = |parts: u32, color: &dyn Fn(f32) -> f32| {
        let mut scene = dark_floor();
        scene.cameras[0].look_at = dvec3(0.0, 0.0, 0.0);
        scene.cameras[0].look_from = dvec3(0.0, 2.5, 1.0);
        let material = scene.add_material(Material {
            emission: Vec3::splat(5.0),
            two_sided: false,
            ..matte(0.0)
        });
        let mut mesh = scenes::lattice(UVec2::splat(parts), material as u32, |u, v| {
            (dvec3(u - 0.5, 1.2, v - 1.0), -DVec3::Y)
        });
        let colors = mesh.positions.iter();
        mesh.colors = colors.map(|p| Vec4::splat(color(p.x))).collect();
        scene.add_mesh(mesh, DAffine3::IDENTITY);
        mean(&scene, &paths(1024, (16, 16), 0))
    };
    let expected = under(1, &|_| 1.0);
    for parts in [1, 8] {
        let found = under(parts, &|x| 1.0 + 2.0 * x);
        let what = format!("{parts} quads a side");
        near(&mut verdict, what, found, expected, 0.01 * expected);
    }
    // Without symmetry, few triangles and many give the same light.
    let [few, many] = [1, 8].map(|parts| under(parts, &|x| (0.5 + x) * 2.0 + 0.1));
    near(&mut verdict, "few and many", few, many, 0.01 * many);
    verdict.close();
}
