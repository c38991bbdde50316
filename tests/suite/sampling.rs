//! Sampling in whole renders: how fast noise decreases, and that filters preserve energy.

use crate::reference::compare::{assert_none, check_same_bits, render, sized, sliced};
use crate::reference::scenes::{self, Build};
use glam::{DAffine3, DVec3, Vec3, dvec3, vec3};
use glimray::image::Image;
use glimray::render::{Antialias, Filter, RenderSettings};
use glimray::scene::{
    Attenuation, Background, Camera, Lens, Light, LightKind, Material, Mesh, Phong, Scene,
};

const FILTERS: [Filter; 5] = [
    Filter::Box,
    Filter::Tent,
    Filter::Gaussian,
    Filter::BlackmanHarris,
    Filter::Mitchell,
];

fn stratified(side: u32, samples: u32) -> RenderSettings {
    RenderSettings {
        samples,
        antialias: Antialias::Stratified,
        ..sized(side, side)
    }
}

/// Balls on a floor under a square lamp, one shadow ray for each sample.
fn soft_shadow() -> Scene {
    let mut scene = scenes::spheres();
    scene.lights = vec![Light {
        kind: LightKind::Rectangle {
            center: dvec3(1.0, 4.0, 2.0),
            edge_u: DVec3::Z,
            edge_v: DVec3::X,
        },
        color: Vec3::splat(12.0),
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        visible: false,
        node: None,
        name: String::new(),
    }];
    scene
}

/// Balls behind the plane of focus and one in front of it, blurred over several pixels.
fn depth_of_field() -> Scene {
    let mut scene = scenes::spheres();
    scene.add_sphere(dvec3(0.6, 0.4, 3.2), 0.3, 1);
    scene.add_sphere(dvec3(-1.5, 0.5, -4.0), 0.5, 2);
    scene.cameras[0].lens = Some(Lens {
        radius: 1.2,
        focus_distance: 3.8,
        blade_count: 0,
        blade_rotation: 0.0,
    });
    scene
}

/// Bright and dark triangles whose edges run in all directions.
fn edges() -> Scene {
    let mut scene = scenes::empty();
    let mut random = scenes::Random(7);
    let mut mesh = Mesh::default();
    for _ in 0..60 {
        let middle = random.within(2.5);
        let first = mesh.positions.len() as u32;
        let corners = [0; 3].map(|_| (middle + random.within(0.8)).as_vec3());
        mesh.positions.extend(corners);
        mesh.materials.extend([1 + first / 3 % 2; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    for shade in [0.1, 0.9] {
        scene.add_material(Material::from(Phong {
            ambient: Vec3::splat(shade),
            ..Phong::default()
        }));
    }
    mesh.repair();
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene.ambient = Vec3::ONE;
    scene
}

/// Root mean square of the differences of all channels.
fn rmse(a: &Image, b: &Image) -> f64 {
    let pairs = a.pixels.iter().zip(&b.pixels);
    let sum: f64 = pairs
        .flat_map(|(a, b)| (0..3).map(|i| f64::from(a[i] - b[i]).powi(2)))
        .sum();
    (sum / (3.0 * a.pixels.len() as f64)).sqrt()
}

#[test]
fn sixteen_samples_are_twice_as_quiet_as_independent_ones() {
    const SIDE: u32 = 32;
    let rows = [
        ("soft shadow", soft_shadow()),
        ("depth of field", depth_of_field()),
        ("edges", edges()),
    ];
    assert_none(rows.map(|(name, scene)| {
        let picture = |samples, seed| {
            render(
                &scene,
                &RenderSettings {
                    seed,
                    ..stratified(SIDE, samples)
                },
            )
            .0
        };
        let reference = picture(4096, 1000);
        // Pictures of one sample each are independent, so the mean of 16 has a quarter of their error.
        let one = (0..2)
            .map(|seed| rmse(&picture(1, seed), &reference).powi(2))
            .sum::<f64>()
            / 2.0;
        let independent = one.sqrt() / 4.0;
        let got = rmse(&picture(16, 0), &reference);
        println!(
            "{name}: {got:.5} against {independent:.5}: {:.3}",
            got / independent
        );
        if got <= 0.5 * independent {
            return Ok(());
        }
        Err(format!(
            "{name}: {got}, of independent samples {independent}"
        ))
    }));
}

/// A panel that fills the picture and more, with a linear brightness gradient.
fn gradient() -> Scene {
    let mut scene = Scene {
        cameras: vec![Camera {
            look_from: DVec3::ZERO,
            look_at: DVec3::NEG_Z,
            fov_y: 0.5,
            ..Camera::default()
        }],
        background: Background::Color(Vec3::ZERO),
        ambient: Vec3::ONE,
        ..Scene::default()
    };
    let mut mesh = Mesh {
        positions: vec![
            vec3(-4.0, -4.0, -5.0),
            vec3(8.0, -4.0, -5.0),
            vec3(-4.0, 8.0, -5.0),
        ],
        materials: vec![0, 1, 2],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    mesh.repair();
    for ambient in [
        vec3(0.1, 0.9, 0.5),
        vec3(0.9, 0.1, 0.3),
        vec3(0.5, 0.2, 0.9),
    ] {
        scene.add_material(Material::from(Phong {
            ambient,
            ..Phong::default()
        }));
    }
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

fn mean(image: &Image) -> DVec3 {
    let sum = image
        .pixels
        .iter()
        .map(|p| dvec3(p[0].into(), p[1].into(), p[2].into()));
    sum.sum::<DVec3>() / image.pixels.len() as f64
}

#[test]
fn filters_neither_add_light_nor_take_it_at_tiles_or_edges() {
    let scene = gradient();
    let exact = mean(&render(&scene, &sized(20, 20)).0);
    assert_none(FILTERS.map(|filter| {
        let settings = RenderSettings {
            filter,
            filter_radius: filter.default_radius(),
            ..stratified(20, 256)
        };
        // Boundaries between film tiles and workgroups must not be visible.
        let slicing = glimray::render::Slicing {
            tile_side: 13,
            ..Default::default()
        };
        let got = mean(&render(&scene, &sliced(&settings, slicing)).0);
        if (got - exact).abs().max_element() < 1e-4 {
            return Ok(());
        }
        Err(format!("{filter:?}: {got}, expected {exact}"))
    }));
}

#[test]
fn filters_spread_a_thin_line_by_their_own_width() {
    // A bright edge between two pixels: its reach is the radius of the filter.
    let mut scene = gradient();
    scene.materials.clear();
    for shade in [0.0, 1.0] {
        scene.add_material(Material::from(Phong {
            ambient: Vec3::splat(shade),
            ..Phong::default()
        }));
    }
    std::sync::Arc::make_mut(&mut scene.meshes[0]).materials = vec![0; 3];
    let mut right = (*scene.meshes[0]).clone();
    right.materials = vec![1; 3];
    // A triangle whose left edge is x = 0, in front of the dark panel.
    right.positions = vec![
        vec3(0.0, -9.0, -4.0),
        vec3(9.0, 0.0, -4.0),
        vec3(0.0, 9.0, -4.0),
    ];
    scene.add_mesh(right, DAffine3::IDENTITY);
    assert_none(FILTERS.map(|filter| {
        let radius = filter.default_radius();
        let settings = RenderSettings {
            filter,
            filter_radius: radius,
            ..stratified(16, 256)
        };
        let (image, _) = render(&scene, &settings);
        let row: Vec<f32> = (0..16)
            .filter_map(|x| image.pixel(x, 8))
            .map(|p| p[1])
            .collect();
        // The edge lies at x = 8: pixel 7 has its centre half a pixel to the left.
        let reach = |x: usize| (x as f32 + 0.5 - 8.0).abs() < radius;
        for (x, &value) in row.iter().enumerate() {
            let flat = if x < 8 { 0.0 } else { 1.0 };
            if !reach(x) && (value - flat).abs() > 1e-6 {
                return Err(format!("{filter:?}: {value} at {x}"));
            }
        }
        // The two sides of the edge are symmetric, except for clamped negative values.
        let (left, right) = (row[7], row[8]);
        let softened = if filter == Filter::Box {
            left == 0.0
        } else {
            left > 0.02 && left < 0.5
        };
        if !softened || (left + right - 1.0).abs() > 0.03 {
            return Err(format!("{filter:?}: {left} and {right} beside the edge"));
        }
        Ok(())
    }));
}

#[test]
fn filters_and_light_samples_change_nothing_where_they_have_nothing_to_do() {
    let scene = scenes::spheres();
    let base = sized(24, 18);
    let (expected, _) = render(&scene, &base);
    assert_none(FILTERS.map(|filter| {
        let settings = RenderSettings {
            filter,
            filter_radius: 3.0,
            light_samples: 7.0,
            ..base.clone()
        };
        check_same_bits(
            &format!("{filter:?}"),
            &expected,
            &render(&scene, &settings).0,
        )
    }));
}

#[test]
fn few_samples_of_a_filter_with_negative_lobes_give_no_light_and_no_nan() {
    let scene = scenes::spheres();
    for samples in [1, 2, 3, 4, 16] {
        let settings = RenderSettings {
            filter: Filter::Mitchell,
            filter_radius: 2.0,
            ..stratified(32, samples)
        };
        let (image, stats) = render(&scene, &settings);
        assert_eq!(stats.nonfinite_samples, 0);
        let bad = |pixel: &&[f32; 4]| {
            !pixel
                .iter()
                .all(|c| c.is_finite() && (0.0..10.0).contains(c))
        };
        assert_eq!(image.pixels.iter().find(bad), None, "{samples} samples");
        let black = image
            .pixels
            .iter()
            .filter(|pixel| pixel[..3] == [0.0; 3])
            .count();
        assert!(
            samples == 2 || black * 50 < image.pixels.len(),
            "{samples} samples: {black} black"
        );
    }
}
