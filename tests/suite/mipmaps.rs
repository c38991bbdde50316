//! Mipmaps: levels of pictures, and pictures that are filtered over the width of rays.

use crate::reference::compare::{assert_none, check_same_bits, fetched, open_gpu, render, sized};
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DQuat, DVec3, Vec2, Vec3, Vec4, dvec3, vec3};
use glimray::image::Image;
use glimray::layout::{PICTURE_FIRST_MASK, PICTURE_HALF, PICTURE_SRGB};
use glimray::pack;
use glimray::render::{Antialias, Fetch, RenderSettings};
use glimray::scene::{
    Camera, Geometry, Instance, MAX_PICTURE_BYTES, Material, Minify, Origin, Pattern, Phong,
    PhongTextures, Picture, Scene, Shape, Space, SrgbCurve, Texels, Texture, Wrap,
    linear_from_srgb,
};
use half::f16;
use std::sync::Arc;

fn textured(picture: usize, nearest: bool, minify: Minify, space: Space) -> Texture {
    Texture {
        pattern: Pattern::Picture {
            picture,
            nearest,
            minify,
            wrap: [Wrap::Repeat; 2],
        },
        space,
        pattern_from_space: DAffine3::IDENTITY,
    }
}

/// Linear values of every level of a packed picture, row by row, with width and height.
fn levels(packed: &pack::PackedScene, index: usize, count: u32) -> Vec<([u32; 2], Vec<Vec4>)> {
    let words: Vec<u32> = packed.texels.iter().copied().collect();
    let [place, width, height] = packed.pictures[index];
    let first = place & PICTURE_FIRST_MASK;
    let texel = |start: u32, index: u32| {
        if place & PICTURE_HALF != 0 {
            let at = (start + 2 * index) as usize;
            let [low, high] = [words[at], words[at + 1]];
            let halves = [low, low >> 16, high, high >> 16];
            return Vec4::from(halves.map(|bits| f16::from_bits(bits as u16).to_f32()));
        }
        let [r, g, b, a] = words[(start + index) as usize].to_le_bytes();
        let plain = |code: u8| f64::from(code) / 255.0;
        let color = |code: u8| match place & PICTURE_SRGB != 0 {
            true => linear_from_srgb(plain(code)),
            false => plain(code),
        };
        Vec4::from([color(r), color(g), color(b), plain(a)].map(|value| value as f32))
    };
    (0..count)
        .map(|level| {
            let size = [width, height].map(|side| (side >> level).max(1));
            let start = match level {
                0 => first,
                _ => first + words[(first - level) as usize],
            };
            let texels = (0..size[0] * size[1]).map(|index| texel(start, index));
            (size, texels.collect())
        })
        .collect()
}

fn mean(texels: &[Vec4]) -> Vec4 {
    let sum: glam::DVec4 = texels.iter().map(|texel| texel.as_dvec4()).sum();
    (sum / texels.len() as f64).as_vec4()
}

/// A scene whose textures show these pictures.
fn showing(pictures: Vec<Picture>) -> Scene {
    let count = pictures.len();
    let texture = |index| textured(index, false, Minify::default(), Space::Uv);
    let mut scene = scenes::empty();
    scene.pictures = pictures.into_iter().map(Arc::new).collect();
    scene.textures = (0..count).map(texture).collect();
    scene
}

#[test]
fn every_level_has_the_mean_of_its_picture() {
    let mut random = Random::new(21);
    let mut pictures = Vec::new();
    let sizes = [[1, 1], [64, 64], [13, 7], [1, 9], [31, 2], [100, 37]];
    for [width, height] in sizes {
        let count = (width * height) as usize;
        let bytes: Vec<[u8; 4]> = (0..count)
            .map(|_| [(); 3].map(|()| random.below(256) as u8))
            .map(|[r, g, b]| [r, g, b, 255])
            .collect();
        let floats = bytes
            .iter()
            .map(|b| Vec4::from(b.map(|c| f32::from(c) / 100.0)).with_w(1.0));
        for texels in [
            Texels::Float(floats.collect()),
            Texels::Srgb8(bytes.clone()),
            Texels::Linear8(bytes),
        ] {
            pictures.push(Picture {
                width,
                height,
                texels,
                origin: glimray::scene::Origin::Texels,
            });
        }
    }
    let means: Vec<_> = (pictures.iter())
        .map(|picture| mean(&picture.linear().collect::<Vec<_>>()))
        .collect();
    let packed = pack::scene(&showing(pictures)).expect("a packed scene");
    let mut verdict = Verdict::on("means of levels");
    for (index, expected) in means.iter().enumerate() {
        let [_, width, height] = packed.pictures[index];
        let count = width.max(height).ilog2() + 1;
        let levels = levels(&packed, index, count);
        assert_eq!(levels[count as usize - 1].0, [1, 1]);
        for (size, texels) in levels {
            // Each texel is rounded to 1/255, or to 11 bits of a half float.
            let off = (mean(&texels) - expected).abs().max_element();
            verdict.that(format!("picture {index}, {size:?}"), off < 0.004, || {
                format!("{}, not {expected}", mean(&texels))
            });
        }
    }
    verdict.close();
}

#[test]
fn a_level_halves_the_one_before_and_transparent_texels_lend_no_colour() {
    let red = [255, 0, 0, 0];
    let green = [0, 188, 0, 255];
    let clear = [9, 9, 9, 0];
    let picture = Picture {
        width: 4,
        height: 2,
        texels: Texels::Srgb8(vec![red, green, clear, clear, green, red, clear, clear]),
        origin: glimray::scene::Origin::Texels,
    };
    let packed = pack::scene(&showing(vec![picture])).expect("a packed scene");
    let found = levels(&packed, 0, 3);
    let half = 128.0 / 255.0;
    let value = |code: u8| linear_from_srgb(f64::from(code) / 255.0) as f32;
    let near = |a: Vec4, b: Vec4| (a - b).abs().max_element() < 3e-3;
    let [left, right] = found[1].1[..] else {
        panic!("two texels");
    };
    assert!(near(left, Vec4::new(0.0, value(188), 0.0, half)), "{left}");
    assert!(
        near(right, vec3(value(9), value(9), value(9)).extend(0.0)),
        "{right}"
    );
    let last = found[2].1[0];
    assert!(
        near(last, Vec4::new(0.0, value(188), 0.0, half / 2.0)),
        "{last}"
    );
}

#[test]
fn only_pictures_of_minified_textures_have_a_mipmap() {
    let picture = |width| Picture::opaque(width, 4, vec![Vec3::ONE; 4 * width as usize]);
    let mut scene = showing(vec![picture(4), picture(4), picture(4)]);
    for (texture, minify) in scene
        .textures
        .iter_mut()
        .zip([Minify::Linear, Minify::Nearest])
    {
        if let Pattern::Picture { minify: own, .. } = &mut texture.pattern {
            *own = minify;
        }
    }
    let packed = pack::scene(&scene).expect("a packed scene");
    // Two words for each texel of floats; 16, 4 and 1 of them and two starts.
    // The tables of albedos follow.
    let tables = pack::albedo::words().len();
    assert_eq!(packed.texels.len(), 2 * (16 + 16 + 21) + 2 + tables);
    let again = pack::scene_from(&packed, &scene).expect("a packed scene");
    assert_eq!(again.texels.len(), packed.texels.len());
    let full = pack::scene_from(&packed, &showing(vec![picture(4), picture(4), picture(4)]));
    assert_eq!(
        full.expect("a packed scene").texels.len(),
        3 * (2 * 21 + 2) + tables
    );
}

/// The words of 8 bits per channel are the texels themselves: a scene of large pictures has them in memory once.
#[test]
fn texels_of_8_bits_are_packed_without_a_copy() {
    let codes: Vec<[u8; 4]> = (0..64_u8).map(|i| [i, 2, 3, 255]).collect();
    for texels in [Texels::Srgb8(codes.clone()), Texels::Linear8(codes)] {
        for minify in [Minify::Nearest, Minify::default()] {
            let mut scene = showing(vec![Picture {
                width: 8,
                height: 8,
                texels: texels.clone(),
                origin: Origin::Texels,
            }]);
            if let Pattern::Picture { minify: own, .. } = &mut scene.textures[0].pattern {
                *own = minify;
            }
            let (Texels::Srgb8(own) | Texels::Linear8(own)) = &scene.pictures[0].texels else {
                panic!("of 8 bits");
            };
            let packed = pack::scene(&scene).expect("a packed scene");
            let place = own.as_ptr().cast();
            let is_shared = packed.texels.bytes().any(|run| run.as_ptr() == place);
            assert!(is_shared, "{minify:?}");
        }
    }
}

/// The code of a linear value is that of the nearest one, by the definition of sRGB in f64.
#[test]
fn codes_of_srgb_are_the_nearest_ones() {
    let curve = SrgbCurve::default();
    let linear = |code: u8| linear_from_srgb(f64::from(code) / 255.0);
    let mut random = Random::new(9);
    let between = (0..255).flat_map(|code| {
        let (low, high) = (linear(code), linear(code + 1));
        [0.0, 0.01, 0.49, 0.51, 0.99].map(|part| low + part * (high - low))
    });
    let anywhere = (0..10_000).map(|_| random.below(1 << 20) as f64 / f64::from(1 << 20));
    for value in between.chain(anywhere).chain([-1.0, 1.0, 2.0]) {
        let off = |code: u8| (linear(code) - value).abs();
        let best = (0..=255).map(off).fold(f64::INFINITY, f64::min);
        let found = curve.code(value as f32);
        assert!(
            off(found) - best < 1e-7 * value.abs().max(1e-3),
            "{value}: {found}"
        );
    }
    assert_eq!(curve.code(f32::NAN), 0);
}

/// A picture of 64×64 texels of random grey.
fn noise() -> Picture {
    let mut random = Random::new(4);
    Picture::opaque(
        64,
        64,
        (0..64 * 64).map(|_| Vec3::splat(random.below(200) as f32 / 200.0)),
    )
}

/// A camera at `at` that looks along -z at 2×2 units, with parallel rays.
fn facing(scene: &mut Scene, at: DVec3) {
    scene.cameras = vec![Camera {
        look_from: at,
        look_at: at - DVec3::Z,
        orthographic_height: Some(2.0),
        ..Camera::default()
    }];
}

fn ambient(scene: &mut Scene, texture: usize) -> usize {
    scene.ambient = Vec3::ONE;
    scene.add_material(Material::from(Phong {
        ambient: Vec3::ONE,
        diffuse: Vec3::ZERO,
        textures: PhongTextures {
            ambient: Some(texture),
            ..PhongTextures::default()
        },
        ..Phong::default()
    }))
}

/// Surfaces at z = -1 that show the picture over x and y from -1 to 1.
fn walls(minify: Minify) -> Vec<(&'static str, Scene)> {
    let unit = DAffine3::from_scale_rotation_translation(
        DVec3::splat(2.0),
        DQuat::IDENTITY,
        dvec3(-1.0, -1.0, 0.0),
    );
    let mut walls = Vec::new();
    let mut add = |name, space, build: &dyn Fn(&mut Scene, usize)| {
        let mut scene = showing(vec![noise()]);
        scene.textures = vec![textured(0, false, minify, space)];
        if space == Space::World {
            scene.textures[0].pattern_from_space = unit.inverse();
        }
        let material = ambient(&mut scene, 0);
        facing(&mut scene, DVec3::Z);
        build(&mut scene, material);
        walls.push((name, scene));
    };
    let quad = |material: usize| {
        let mut mesh = scenes::quad(2.0, material as u32);
        for p in &mut mesh.positions {
            *p = vec3(p.x, -p.z, 0.0);
        }
        mesh.normals = vec![Vec3::Z; 4];
        let uv = |p: &Vec3| Vec2::new(0.5 + 0.5 * p.x, 0.5 + 0.5 * p.y);
        mesh.uvs = mesh.positions.iter().map(uv).collect();
        mesh
    };
    let back = DAffine3::from_translation(DVec3::NEG_Z);
    add("a plane in space", Space::World, &|scene, material| {
        scene.add_plane(dvec3(0.0, 0.0, -1.0), DVec3::Z, material);
    });
    add("a mesh", Space::Uv, &|scene, material| {
        scene.add_mesh(quad(material), back);
    });
    add("instances of a mesh", Space::Uv, &|scene, material| {
        let mut mesh = quad(material);
        for p in &mut mesh.positions {
            *p *= 0.25;
        }
        scene.meshes.push(mesh.into());
        for x in 0..3 {
            let far = dvec3(40.0 * f64::from(x), 0.0, -1.0);
            let place =
                DAffine3::from_scale_rotation_translation(DVec3::splat(4.0), DQuat::IDENTITY, far);
            scene.instances.push(Instance {
                mesh: 0,
                placement: place,
                node: None,
                name: String::new(),
            });
        }
    });
    add("a rectangle", Space::Uv, &|scene, material| {
        // The canonical rectangle lies in x and z, with u along x and v along -z.
        let upright = DAffine3::from_rotation_translation(
            DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
            DVec3::NEG_Z,
        );
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical: glimray::scene::CanonicalShape::Rectangle,
                world_from_canonical: upright,
            },
            material,
            node: None,
            name: String::new(),
        });
    });
    walls
}

/// The mean of the texels of the picture that a pixel covers, where `side` × `side` pixels cover all.
fn covered(picture: &Picture, pixel: usize, side: usize) -> Vec3 {
    let texels: Vec<_> = picture.linear().collect();
    let each = 64 / side;
    let (x, y) = (pixel % side * each, pixel / side * each);
    let block = (0..each * each).map(|k| texels[(y + k / each) * 64 + x + k % each]);
    mean(&block.collect::<Vec<_>>()).truncate()
}

#[test]
fn a_pixel_of_a_wall_is_the_mean_of_the_texels_it_covers() {
    let mut verdict = Verdict::on("walls");
    for (name, scene) in walls(Minify::LinearMipmapLinear) {
        for side in [64u32, 32, 16, 8, 4] {
            let (image, _) = render(&scene, &sized(side, side));
            for (index, pixel) in image.pixels.iter().enumerate() {
                let expected = covered(&scene.pictures[0], index, side as usize);
                let off = (Vec3::from_slice(pixel) - expected).abs().max_element();
                verdict.that(format!("{name}, {side}: {index}"), off < 4e-3, || {
                    format!("{pixel:?}, not {expected}")
                });
            }
        }
    }
    verdict.close();
}

#[test]
fn samples_share_a_pixel_and_modes_choose_levels() {
    let stratified = |samples| RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(8, 8)
    };
    let contrast = |image: &Image| {
        let values: Vec<_> = image.pixels.iter().map(|p| f64::from(p[0])).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
    };
    let wall = |minify| walls(minify).swap_remove(1).1;
    // 16 samples look at 2×2 texels each and 64 at one: both average the 8×8 texels of a pixel.
    let full = render(&wall(Minify::LinearMipmapLinear), &sized(8, 8)).0;
    for samples in [16, 64] {
        let image = render(&wall(Minify::LinearMipmapLinear), &stratified(samples)).0;
        let off = (image.pixels.iter().zip(&full.pixels))
            .map(|(a, b)| (a[0] - b[0]).abs())
            .fold(0.0, f32::max);
        assert!(off < 0.12, "{samples} samples: {off}");
    }
    // The standard deviation of 200 levels of grey is 0.29, and that of the mean of 64 an eighth of it.
    let all = contrast(&full);
    assert!((0.02..0.06).contains(&all), "{all}");
    for minify in [
        Minify::NearestMipmapNearest,
        Minify::LinearMipmapNearest,
        Minify::NearestMipmapLinear,
    ] {
        let image = render(&wall(minify), &sized(8, 8)).0;
        let close =
            (image.pixels.iter().zip(&full.pixels)).all(|(a, b)| (a[0] - b[0]).abs() < 4e-3);
        assert!(close, "{minify:?} has another level");
    }
    let nearest = contrast(&render(&wall(Minify::Nearest), &sized(8, 8)).0);
    assert!(nearest > 0.2, "{nearest}");
    let linear = contrast(&render(&wall(Minify::Linear), &sized(8, 8)).0);
    assert!(linear > 0.1, "{linear}");
}

#[test]
fn magnified_texels_are_as_without_a_mipmap() {
    for nearest in [false, true] {
        let scene = |minify| {
            let mut scene = walls(minify).swap_remove(1).1;
            if let Pattern::Picture { nearest: own, .. } = &mut scene.textures[0].pattern {
                *own = nearest;
            }
            scene
        };
        let [with, without] = [Minify::LinearMipmapLinear, Minify::Linear]
            .map(|minify| render(&scene(minify), &sized(150, 150)).0);
        assert_none([check_same_bits("magnified", &without, &with)]);
    }
}

/// A floor with a picture of a checkerboard, repeated 60 times, under a mirror ball if there is one.
fn floor(minify: Minify, has_ball: bool) -> Scene {
    let mut scene = showing(vec![Picture::opaque(
        16,
        16,
        (0..256).map(|i| Vec3::splat(f32::from((i / 8 + i / 128) % 2 == 0))),
    )]);
    scene.textures = vec![textured(0, false, minify, Space::Uv)];
    let material = ambient(&mut scene, 0);
    let mut mesh = scenes::quad(120.0, material as u32);
    mesh.uvs = (mesh.positions.iter())
        .map(|p| 0.5 * Vec2::new(p.x, -p.z))
        .collect();
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene.cameras[0] = Camera {
        look_from: dvec3(0.3, 1.5, 9.0),
        look_at: dvec3(0.0, 0.7, 0.0),
        fov_y: 0.8,
        ..Camera::default()
    };
    if has_ball {
        let mirror = scene.add_material(Material::from(Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            reflect: Vec3::ONE,
            ..Phong::default()
        }));
        scene.cameras[0].look_from = dvec3(0.3, 2.0, 4.0);
        scene.cameras[0].look_at = dvec3(0.0, 1.2, 0.0);
        scene.add_sphere(dvec3(0.0, 1.5, 0.0), 1.4, mirror);
    }
    scene
}

fn rmse(a: &Image, b: &Image) -> f64 {
    let squares = (a.pixels.iter().zip(&b.pixels)).map(|(a, b)| f64::from(a[0] - b[0]).powi(2));
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt()
}

#[test]
fn one_sample_of_a_checkered_floor_is_near_the_mean_of_a_thousand() {
    for (has_ball, factor) in [(false, 4.0), (true, 2.5)] {
        let size = sized(96, 72);
        let many = RenderSettings {
            samples: 1024,
            antialias: Antialias::Stratified,
            ..size.clone()
        };
        let truth = render(&floor(Minify::Linear, has_ball), &many).0;
        let [with, without] = [Minify::LinearMipmapLinear, Minify::Linear]
            .map(|minify| rmse(&render(&floor(minify, has_ball), &size).0, &truth));
        assert!(
            with * factor < without,
            "ball {has_ball}: {with} with a mipmap, {without} without"
        );
        // Many samples are not blurred.
        let filtered = rmse(
            &render(&floor(Minify::LinearMipmapLinear, has_ball), &many).0,
            &truth,
        );
        assert!(filtered < 0.012, "ball {has_ball}: {filtered}");
    }
}

#[test]
fn every_way_to_fetch_gives_the_same_filtered_picture() {
    let _ = open_gpu();
    let scene = floor(Minify::LinearMipmapLinear, true);
    let of = |fetch| render(&scene, &fetched(&sized(96, 72), fetch)).0;
    assert_none([check_same_bits(
        "a floor",
        &of(Fetch::Image),
        &of(Fetch::Buffer),
    )]);
}

/// 44 pictures of 64 MiB take all of the memory for pictures; the same one many times takes little of it here.
#[test]
fn an_environment_counts_with_the_other_pictures_of_a_scene() {
    const SIDE: u32 = 4096;
    let large = Arc::new(Picture {
        width: SIDE,
        height: SIDE,
        texels: Texels::Linear8(vec![[7; 4]; (SIDE * SIDE) as usize]),
        origin: Origin::Texels,
    });
    let environment = Arc::new(Picture::opaque(2, 1, [Vec3::ONE; 2]));
    let bytes = |scene: &Scene| -> usize {
        let sizes = scene.pictures.iter().map(|it| it.texels.byte_len());
        sizes.sum()
    };
    for (count, halvings) in [(43, 0), (44, 1)] {
        let mut scene = Scene {
            pictures: vec![large.clone(); count],
            ..Scene::default()
        };
        assert!(bytes(&scene) <= MAX_PICTURE_BYTES);
        assert_eq!(scene.set_environment(environment.clone()), halvings);
        assert!(bytes(&scene) <= MAX_PICTURE_BYTES, "{}", bytes(&scene));
        assert_eq!(scene.pictures[count], environment);
        let is_half = |picture: &&Arc<Picture>| picture.width == SIDE / 2;
        assert_eq!(scene.pictures.iter().filter(is_half).count(), halvings);
    }
}
