//! Recursive reflection and refraction in whole pictures, against closed forms.

use crate::reference::compare::{assert_none, check_same_bits, counting, render, sized, sliced};
use crate::reference::scenes;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3};
use glimray::image::Image;
use glimray::layout::NONE;
use glimray::pack::PackError;
use glimray::render::{ExecutionPolicy, Fetch, Rays, RenderSettings, Slicing};
use glimray::scene::{
    Background, Beyond, Camera, CanonicalShape, Curve, Easing, Fresnel, Geometry, Instance,
    Interpolation, Light, LightKind, Material, MaterialProperty, Mixing, Node, NodeProperty, Phong,
    Scene, Shadows, Shape, Target, Track, Values,
};
use glimray::{import, pack};

/// A scene without lights, in which only backgrounds and emission contribute.
fn dark() -> Scene {
    Scene {
        cameras: vec![camera(dvec3(0.0, 0.0, 5.0), DVec3::ZERO, 1.0)],
        ..Scene::default()
    }
}

fn camera(look_from: DVec3, look_at: DVec3, fov_y: f64) -> Camera {
    Camera {
        look_from,
        look_at,
        fov_y,
        ..Camera::default()
    }
}

fn add(scene: &mut Scene, geometry: Geometry, material: Material) {
    scene.shapes.push(Shape {
        geometry,
        material: scene.materials.len(),
        node: None,
        name: String::new(),
    });
    scene.materials.push(material);
}

fn cuboid(min: DVec3, max: DVec3) -> Geometry {
    Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical: DAffine3::from_scale_rotation_translation(
            (max - min) / 2.0,
            DQuat::IDENTITY,
            (min + max) / 2.0,
        ),
    }
}

fn plane(point: DVec3, normal: DVec3) -> Geometry {
    Geometry::Plane { point, normal }
}

fn sphere(center: DVec3, radius: f64) -> Geometry {
    Geometry::Sphere { center, radius }
}

fn glass(ior: f32) -> Material {
    Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior,
            fresnel: Fresnel::Exact,
            ..black().classical().into_owned()
        }
        .into(),
        ..black()
    }
}

fn mirror() -> Material {
    Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            ..black().classical().into_owned()
        }
        .into(),
        ..black()
    }
}

fn black() -> Material {
    Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        ..Phong::default()
    })
}

fn shining(emission: f32) -> Material {
    Material {
        emission: Vec3::splat(emission),
        ..black()
    }
}

fn to_depth(max_depth: u32) -> RenderSettings {
    RenderSettings {
        max_depth,
        min_throughput: 1e-7,
        ..sized(16, 16)
    }
}

fn middle(image: &Image) -> f64 {
    f64::from(
        image
            .pixel(image.width / 2, image.height / 2)
            .expect("a pixel")[0],
    )
}

fn rays(scene: &Scene, settings: &RenderSettings) -> Rays {
    render(scene, &counting(settings))
        .1
        .rays
        .expect("counted rays")
}

#[test]
fn a_glass_slab_reflects_and_transmits_what_its_infinitely_many_bounces_add_up_to() {
    // R = 2 R₀ / (1 + R₀) with R₀ = ((n - 1) / (n + 1))², T = 1 - R.
    let r0 = (0.5_f64 / 2.5).powi(2);
    let reflected = 2.0 * r0 / (1.0 + r0);
    let slab = |in_front: f32, behind: f32| {
        let mut scene = dark();
        add(
            &mut scene,
            cuboid(dvec3(-50.0, -50.0, -1.0), dvec3(50.0, 50.0, 0.0)),
            glass(1.5),
        );
        add(
            &mut scene,
            plane(dvec3(0.0, 0.0, 10.0), DVec3::NEG_Z),
            shining(in_front),
        );
        add(
            &mut scene,
            plane(dvec3(0.0, 0.0, -10.0), DVec3::Z),
            shining(behind),
        );
        scene.cameras[0].fov_y = 1e-3;
        middle(&render(&scene, &to_depth(30)).0)
    };
    let mut verdict = Verdict::on("slab");
    for (name, got, expected) in [
        ("reflected", slab(1.0, 0.0), reflected),
        ("transmitted", slab(0.0, 1.0), 1.0 - reflected),
        ("all of it", slab(1.0, 1.0), 1.0),
    ] {
        verdict.that(name, (got / expected - 1.0).abs() < 1e-3, || {
            format!("{got} for {expected}")
        });
    }
    verdict.close();
}

#[test]
fn an_absorbing_slab_leaves_what_beer_and_lambert_say() {
    let mut scene = dark();
    let tinted = Material {
        bsdf: Phong {
            absorption: Vec3::new(1.0, 2.0, 0.0),
            ..glass(1.0).classical().into_owned()
        }
        .into(),
        ..glass(1.0)
    };
    add(
        &mut scene,
        cuboid(dvec3(-9.0, -9.0, -1.0), dvec3(9.0, 9.0, 0.0)),
        tinted,
    );
    scene.background = Background::Color(Vec3::ONE);
    scene.cameras[0].fov_y = 1e-3;
    let image = render(&scene, &to_depth(4)).0;
    let pixel = image.pixel(8, 8).expect("a pixel");
    for (channel, length) in [1.0_f64, 2.0, 0.0].into_iter().enumerate() {
        let got = f64::from(pixel[channel]);
        assert!(
            (got / (-length).exp() - 1.0).abs() < 1e-3,
            "{got} after {length}"
        );
    }
}

#[test]
fn a_camera_inside_a_medium_sees_through_it() {
    // 2 units of water to its surface, where all indices are 1.
    let mut scene = dark();
    let water = Material {
        bsdf: Phong {
            absorption: Vec3::splat(0.5),
            ..glass(1.0).classical().into_owned()
        }
        .into(),
        ..glass(1.0)
    };
    add(
        &mut scene,
        cuboid(DVec3::splat(-7.0), DVec3::splat(7.0)),
        water,
    );
    add(&mut scene, sphere(dvec3(0.0, 0.0, -4.0), 1.0), shining(1.0));
    scene.cameras[0].fov_y = 1e-3;
    // From z = 5 to the ball at z = -3.
    let got = middle(&render(&scene, &to_depth(4)).0);
    assert!((got / (-4.0_f64).exp() - 1.0).abs() < 1e-3, "{got}");
}

#[test]
fn a_white_furnace_shows_neither_mirror_nor_glass() {
    for (name, material, room) in [("mirror", mirror(), 1e-5), ("glass", glass(1.5), 1e-4)] {
        let mut scene = dark();
        scene.background = Background::Color(Vec3::ONE);
        add(&mut scene, sphere(DVec3::ZERO, 1.5), material);
        let image = render(&scene, &to_depth(64)).0;
        for pixel in &image.pixels {
            assert!(
                (f64::from(pixel[0]) - 1.0).abs() < room,
                "{name}: {pixel:?}"
            );
        }
    }
}

#[test]
fn a_mirror_corridor_shows_one_image_more_with_every_bounce() {
    // Mirrors at z = ±2 and a ball next to the camera, whose k-th image is 4k away.
    let mut scene = dark();
    scene.cameras[0] = camera(DVec3::ZERO, DVec3::NEG_Z, 2.0 * 0.16_f64.atan());
    add(&mut scene, plane(dvec3(0.0, 0.0, -2.0), DVec3::Z), mirror());
    add(
        &mut scene,
        plane(dvec3(0.0, 0.0, 2.0), DVec3::NEG_Z),
        mirror(),
    );
    add(
        &mut scene,
        sphere(dvec3(0.5, 0.0, 0.0), 0.035),
        shining(1.0),
    );
    let mut verdict = Verdict::on("images");
    for depth in 0..=6 {
        let settings = RenderSettings {
            size: (1024, 1024),
            crop: Some([0, 511, 1024, 512]),
            ..to_depth(depth)
        };
        let row = render(&scene, &settings).0;
        let lit: Vec<bool> = row.pixels.iter().map(|pixel| pixel[0] > 0.5).collect();
        let images = lit.windows(2).filter(|pair| !pair[0] && pair[1]).count();
        verdict.that(format!("depth {depth}"), images == depth as usize, || {
            format!("{images} images")
        });
    }
    verdict.close();
}

#[test]
fn every_bounce_between_mirrors_is_one_reflected_ray() {
    let mut scene = dark();
    scene.cameras[0] = camera(DVec3::ZERO, DVec3::NEG_Z, 0.1);
    add(&mut scene, plane(dvec3(0.0, 0.0, -2.0), DVec3::Z), mirror());
    add(
        &mut scene,
        plane(dvec3(0.0, 0.0, 2.0), DVec3::NEG_Z),
        mirror(),
    );
    for depth in [0, 1, 7, 100] {
        let counted = rays(&scene, &to_depth(depth));
        assert_eq!(counted.primary_hits, 256);
        assert_eq!(counted.reflection, 256 * u64::from(depth), "depth {depth}");
        assert_eq!(counted.reflection_hits, counted.reflection);
        assert_eq!(counted.refraction, 0);
    }
}

#[test]
fn rays_below_the_minimum_throughput_are_not_traced() {
    // Half mirrors: the k-th ray has the throughput 2⁻ᵏ, and 2⁻⁹ is 1/512.
    let mut scene = dark();
    scene.cameras[0] = camera(DVec3::ZERO, DVec3::NEG_Z, 0.1);
    let half = Material {
        bsdf: Phong {
            reflect: Vec3::splat(0.5),
            ..black().classical().into_owned()
        }
        .into(),
        ..black()
    };
    add(
        &mut scene,
        plane(dvec3(0.0, 0.0, -2.0), DVec3::Z),
        half.clone(),
    );
    add(&mut scene, plane(dvec3(0.0, 0.0, 2.0), DVec3::NEG_Z), half);
    for (min_throughput, bounces) in [(1.0 / 512.0, 9), (0.25, 2), (0.6, 0)] {
        let settings = RenderSettings {
            min_throughput,
            ..to_depth(50)
        };
        assert_eq!(
            rays(&scene, &settings).reflection,
            256 * bounces,
            "{min_throughput}"
        );
    }
}

#[test]
fn a_tree_with_too_many_rays_is_cut_off_and_counted() {
    // Surfaces that fully reflect and fully transmit: the throughput never ends the tree.
    let mut scene = dark();
    let endless = Material {
        bsdf: Phong {
            mixing: Mixing::Sum,
            fresnel: Fresnel::None,
            ..glass(1.0).classical().into_owned()
        }
        .into(),
        ..glass(1.0)
    };
    for i in 0..40 {
        let z = -2.0 * f64::from(i);
        add(
            &mut scene,
            cuboid(dvec3(-90.0, -90.0, z - 1.0), dvec3(90.0, 90.0, z)),
            endless.clone(),
        );
    }
    scene.cameras[0].fov_y = 0.1;
    let (_, stats) = render(&scene, &to_depth(60));
    assert_eq!(stats.cut_off_trees, 256);
    let (_, stats) = render(&scene, &to_depth(3));
    assert_eq!(stats.cut_off_trees, 0);
}

#[test]
fn counts_do_not_depend_on_slicing() {
    let mut scene = dark();
    scene.background = Background::Color(Vec3::ONE);
    add(&mut scene, sphere(dvec3(-0.8, 0.0, 0.0), 1.0), glass(1.5));
    add(&mut scene, sphere(dvec3(1.2, 0.2, -1.0), 1.0), mirror());
    scene.lights.push(Light {
        kind: LightKind::Point {
            position: dvec3(3.0, 4.0, 5.0),
        },
        color: Vec3::ONE,
        ..Light::default()
    });
    add(
        &mut scene,
        plane(dvec3(0.0, -1.0, 0.0), DVec3::Y),
        Material::default(),
    );
    let whole = RenderSettings {
        samples: 4,
        antialias: glimray::render::Antialias::Stratified,
        size: (37, 21),
        ..to_depth(5)
    };
    let (image, stats) = render(&scene, &counting(&whole));
    for (max_groups, max_samples, tile_side, fetch) in [
        (1, 1, 8, Fetch::Buffer),
        (3, 2, 2048, Fetch::Image),
        // A lane takes the same pixel of several workgroups, one after the other.
        (u32::MAX, 1, 2048, Fetch::Image),
        (5, 1, 2048, Fetch::Image),
        (7, 3, 24, Fetch::Image),
        (2, 4, 16, Fetch::Packet),
    ] {
        let slicing = Slicing {
            max_groups,
            max_samples,
            tile_side,
            ..Slicing::default()
        };
        let (settings, policy) = sliced(&whole, slicing);
        let cut = (settings, ExecutionPolicy { fetch, ..policy });
        let (other, other_stats) = render(&scene, &cut);
        assert_eq!(other_stats.rays, stats.rays);
        assert_none([check_same_bits("cut", &image, &other)]);
    }
    let counted = stats.rays.expect("counts");
    assert!(counted.reflection > 0 && counted.refraction > 0 && counted.shadow > 0);
}

/// A row of pixels across two volumes and their surroundings.
fn across(scene: &Scene) -> Vec<f64> {
    let settings = RenderSettings {
        size: (129, 129),
        crop: Some([0, 64, 129, 65]),
        ..to_depth(20)
    };
    let row = render(scene, &settings).0;
    row.pixels.iter().map(|pixel| f64::from(pixel[0])).collect()
}

#[test]
fn two_touching_blocks_of_one_glass_look_like_one() {
    let left = cuboid(dvec3(-2.0, -1.0, -1.0), dvec3(0.0, 1.0, 1.0));
    let right = cuboid(dvec3(0.0, -1.0, -1.0), dvec3(2.0, 1.0, 1.0));
    let whole = cuboid(dvec3(-2.0, -1.0, -1.0), dvec3(2.0, 1.0, 1.0));
    let tinted = Material {
        bsdf: Phong {
            absorption: Vec3::splat(0.3),
            ..glass(1.5).classical().into_owned()
        }
        .into(),
        ..glass(1.5)
    };
    let scene = |bodies: &[Geometry]| {
        let mut scene = dark();
        scene.background = Background::Gradient {
            bottom: Vec3::splat(0.1),
            top: Vec3::ONE,
        };
        // At an angle, so that rays cross the common face.
        scene.cameras[0] = camera(dvec3(3.0, 1.0, 5.0), DVec3::ZERO, 0.8);
        for body in bodies {
            add(&mut scene, *body, tinted.clone());
        }
        scene
    };
    let one = across(&scene(&[whole]));
    for (name, two) in [
        ("left first", [left, right]),
        ("right first", [right, left]),
    ] {
        let worst = across(&scene(&two))
            .iter()
            .zip(&one)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1e-3, "{name}: {worst}");
    }
}

#[test]
fn light_passes_between_touching_volumes() {
    // Straight through glass and water: three boundaries, none of them to air.
    let (glass_ior, water_ior) = (1.5_f64, 1.33);
    let once = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    let straight = [
        once(1.0, glass_ior),
        once(glass_ior, water_ior),
        once(water_ior, 1.0),
    ];
    let mut scene = dark();
    scene.background = Background::Color(Vec3::ONE);
    add(
        &mut scene,
        cuboid(dvec3(-9.0, -9.0, -1.0), dvec3(9.0, 9.0, 0.0)),
        glass(1.5),
    );
    add(
        &mut scene,
        cuboid(dvec3(-9.0, -9.0, -2.0), dvec3(9.0, 9.0, -1.0)),
        glass(1.33),
    );
    scene.cameras[0].fov_y = 1e-3;
    // Without reflection: the tree is as deep as there are boundaries.
    let settings = RenderSettings {
        min_throughput: 0.5,
        ..to_depth(3)
    };
    let got = middle(&render(&scene, &settings).0);
    let expected: f64 = straight.iter().map(|r| 1.0 - r).product();
    assert!((got / expected - 1.0).abs() < 1e-4, "{got} for {expected}");
}

#[test]
fn of_overlapping_bodies_the_one_with_the_higher_priority_counts() {
    // Water that overlaps the wall of its glass: from z = -1 to -1.5 both are present.
    let seen = |water_priority| {
        let mut scene = dark();
        scene.background = Background::Color(Vec3::ONE);
        let wall = Material {
            bsdf: Phong {
                absorption: Vec3::splat(1.0),
                ..glass(1.0).classical().into_owned()
            }
            .into(),
            ..glass(1.0)
        };
        let water = Material {
            priority: water_priority,
            bsdf: Phong {
                absorption: Vec3::splat(0.1),
                ..glass(1.0).classical().into_owned()
            }
            .into(),
            ..glass(1.0)
        };
        add(
            &mut scene,
            cuboid(dvec3(-9.0, -9.0, -1.5), dvec3(9.0, 9.0, 0.0)),
            wall,
        );
        add(
            &mut scene,
            cuboid(dvec3(-9.0, -9.0, -3.0), dvec3(9.0, 9.0, -1.0)),
            water,
        );
        scene.cameras[0].fov_y = 1e-3;
        -middle(&render(&scene, &to_depth(9)).0).ln()
    };
    for (name, priority, expected) in [
        ("wall first", -1, 1.5 + 0.15),
        ("water first", 1, 1.0 + 0.2),
        ("the last entered", 0, 1.0 + 0.2),
    ] {
        let got = seen(priority);
        assert!(
            (got - expected).abs() < 2e-3,
            "{name}: {got} for {expected}"
        );
    }
}

#[test]
fn volumes_of_one_mesh_touch_and_overlap_like_others() {
    // Two cubes as triangles of a native scene, one inside the other: together they form one mesh.
    let cube = |half: f64, material: &str| {
        let corner = |i: usize| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { half } else { -half };
            format!("[{}, {}, {}]", sign(0), sign(1), sign(2))
        };
        let faces = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangle = |[a, b, c]: [usize; 3]| {
            let corners = [a, b, c].map(corner).join(", ");
            format!(
                "[[objects]]\ntriangle = {{ vertices = [{corners}] }}\nmaterial = '{material}'\n"
            )
        };
        faces
            .map(|[a, b, c, d]| triangle([a, b, c]) + &triangle([a, c, d]))
            .concat()
    };
    let head = "background = [1, 1, 1]\n\
                camera = { look_from = [0.2, 0.1, 9], look_at = [0.2, 0.1, 0], fov_y_deg = 0.01 }\n\
                materials.outer = { refract = { ior = 1, absorption = [0.1, 0.1, 0.1] } }\n\
                materials.inner = { refract = { ior = 1, absorption = [1, 1, 1] } }\n";
    let text = format!("{head}{}{}", cube(2.0, "outer"), cube(0.5, "inner"));
    let scene = import::parse("a.toml", &text, &import::Options::default()).expect("a scene");
    assert_eq!(scene.instances.len(), 1);
    let got = -middle(&render(&scene, &to_depth(9)).0).ln();
    // 3 units of the outer and 1 of the inner.
    assert!((got - (0.3 + 1.0)).abs() < 2e-3, "{got}");
}

#[test]
fn a_bubble_in_glass_is_entered_from_glass() {
    // At normal incidence four boundaries of the same R₀; the sphere of air is a medium of its own.
    let r0 = (0.5_f64 / 2.5).powi(2);
    let mut scene = dark();
    scene.background = Background::Color(Vec3::ONE);
    add(&mut scene, sphere(DVec3::ZERO, 2.0), glass(1.5));
    add(&mut scene, sphere(DVec3::ZERO, 1.0), glass(1.0));
    scene.cameras[0].fov_y = 1e-4;
    let settings = RenderSettings {
        min_throughput: 0.5,
        ..to_depth(9)
    };
    let got = middle(&render(&scene, &settings).0);
    assert!((got / (1.0 - r0).powi(4) - 1.0).abs() < 1e-3, "{got}");
}

#[test]
fn a_pane_on_a_table_shows_the_table() {
    // The lower face of the pane and the table are coplanar.
    let mut scene = dark();
    scene.cameras[0] = camera(dvec3(0.0, 4.0, 4.0), DVec3::ZERO, 0.5);
    add(&mut scene, plane(DVec3::ZERO, DVec3::Y), shining(1.0));
    add(
        &mut scene,
        cuboid(dvec3(-9.0, 0.0, -9.0), dvec3(9.0, 0.2, 9.0)),
        glass(1.5),
    );
    let settings = RenderSettings {
        min_throughput: 0.5,
        ..to_depth(4)
    };
    let image = render(&scene, &settings).0;
    for pixel in &image.pixels {
        assert!(pixel[0] > 0.9, "{pixel:?}");
    }
}

#[test]
fn a_ball_of_glass_bends_light_as_a_lens_does() {
    // The focal length of a ball is n R / (2 (n - 1)) from its centre, where both principal planes lie: a ray
    // that leaves a point at the distance s under the angle θ continues under θ (1 - s / f).
    let (radius, n) = (1.0, 1.5);
    let f = n * radius / (2.0 * (n - 1.0));
    let mut verdict = Verdict::on("ball lens");
    for (name, s) in [
        ("at the focus", f),
        ("inverted image", 2.0 * f),
        ("near", 1.2),
        ("far", 10.0),
    ] {
        let mut scene = dark();
        // The brightness of the background gives the y of the direction.
        scene.background = Background::Gradient {
            bottom: Vec3::ZERO,
            top: Vec3::ONE,
        };
        add(&mut scene, sphere(DVec3::ZERO, radius), glass(n as f32));
        scene.cameras[0] = camera(dvec3(0.0, 0.0, s), DVec3::ZERO, 0.02);
        let settings = RenderSettings {
            size: (16, 16),
            min_throughput: 0.5,
            ..to_depth(4)
        };
        let image = render(&scene, &settings).0;
        // The ray of pixel (8, 2) and the fraction that two boundaries transmit.
        let angle = ((5.5 / 8.0) * 0.01_f64.tan()).atan();
        let through = (1.0 - 0.04_f64).powi(2);
        let seen = f64::from(image.pixel(8, 2).expect("a pixel")[0]) / through;
        let got = 2.0 * seen - 1.0;
        let expected = angle * (1.0 - s / f);
        verdict.that(name, (got - expected).abs() < 0.01 * angle, || {
            format!("{got} for {expected}")
        });
    }
    verdict.close();
}

#[test]
fn the_courses_mirrors_blend_local_and_reflected_light() {
    // One ball with ambient light 0.2 only: (1 - spe) · amb + spe · white.
    let text = "2\namb: 0.2 0.2 0.2\nsphere pos: 0 0 -3 rad: 1 dif: 0 0 0 spe: 0.25 0.5 1 shi: 1\n\
                light pos: 0 0 -9 col: 1 1 1\n";
    let scene = import::parse("a.scene", text, &import::Options::default()).expect("a scene");
    assert_eq!(scene.output.max_depth, 0);
    let local = render(&scene, &to_depth(0)).0.pixel(8, 8).expect("a pixel");
    assert_eq!(local[..3], [0.2; 3]);
    let mirrored = render(&scene, &to_depth(1)).0.pixel(8, 8).expect("a pixel");
    for (channel, spe) in [0.25, 0.5, 1.0].into_iter().enumerate() {
        let expected = (1.0 - spe) * 0.2 + spe;
        assert!((mirrored[channel] - expected).abs() < 1e-5, "{mirrored:?}");
    }
}

#[test]
fn filtered_shadows_let_through_what_transmission_and_absorption_leave() {
    // A lamp directly above a plate of glass above a floor.
    let lit = |shadows, plate: Option<Material>| {
        let mut scene = dark();
        scene.shadows = shadows;
        scene.cameras[0] = camera(dvec3(0.0, 0.5, 4.0), DVec3::ZERO, 1e-3);
        add(
            &mut scene,
            plane(DVec3::ZERO, DVec3::Y),
            Material::default(),
        );
        if let Some(plate) = plate {
            add(
                &mut scene,
                cuboid(dvec3(-1.0, 1.0, -1.0), dvec3(1.0, 1.5, 1.0)),
                plate,
            );
        }
        scene.lights.push(Light {
            kind: LightKind::Point {
                position: dvec3(0.0, 3.0, 0.0),
            },
            color: Vec3::ONE,
            ..Light::default()
        });
        middle(&render(&scene, &to_depth(5)).0)
    };
    let open = lit(Shadows::Filtered, None);
    let tinted = Material {
        bsdf: Phong {
            absorption: Vec3::splat(2.0),
            transmit: Vec3::splat(0.9),
            ..glass(1.5).classical().into_owned()
        }
        .into(),
        ..glass(1.5)
    };
    assert_eq!(lit(Shadows::Opaque, Some(tinted.clone())), 0.0);
    let r0 = 0.04_f64;
    let expected = open * (0.9 * (1.0 - r0)).powi(2) * (-1.0_f64).exp();
    let got = lit(Shadows::Filtered, Some(tinted));
    assert!((got / expected - 1.0).abs() < 2e-3, "{got} for {expected}");
    assert_eq!(lit(Shadows::Filtered, Some(Material::default())), 0.0);
}

#[test]
fn light_passes_through_touching_volumes_and_balls_up_to_their_rim() {
    let lit = |bodies: &[(Geometry, Material)], x: f64| {
        let mut scene = dark();
        scene.shadows = Shadows::Filtered;
        scene.cameras[0] = camera(dvec3(x, 0.5, 4.0), dvec3(x, 0.0, 0.0), 1e-3);
        add(
            &mut scene,
            plane(DVec3::ZERO, DVec3::Y),
            Material::default(),
        );
        for (body, material) in bodies {
            add(&mut scene, *body, material.clone());
        }
        scene.lights.push(Light {
            kind: LightKind::Directional {
                direction: DVec3::NEG_Y,
            },
            color: Vec3::ONE,
            ..Light::default()
        });
        middle(&render(&scene, &to_depth(5)).0)
    };
    let open = lit(&[], 0.0);
    // Half a unit of a tinted medium below a clear one.
    let tinted = Material {
        bsdf: Phong {
            absorption: Vec3::splat(2.0),
            ..glass(1.0).classical().into_owned()
        }
        .into(),
        ..glass(1.0)
    };
    let stack = [
        (cuboid(dvec3(-1.0, 0.5, -1.0), dvec3(1.0, 1.0, 1.0)), tinted),
        (
            cuboid(dvec3(-1.0, 1.0, -1.0), dvec3(1.0, 1.5, 1.0)),
            glass(1.0),
        ),
    ];
    let got = lit(&stack, 0.0) / open;
    assert!((got / (-1.0_f64).exp() - 1.0).abs() < 2e-3, "{got}");
    // Both boundaries at the angle whose sine is x: never below the value for grazing light.
    for x in [0.0, 0.5, 0.7, 0.9_f64] {
        let ball = [(sphere(dvec3(0.0, 2.0, 0.0), 1.0), glass(1.5))];
        let (incidence, refraction) = (x.asin(), (x / 1.5).asin());
        let (sum, difference) = (incidence + refraction, incidence - refraction);
        let reflected = if x == 0.0 {
            0.04
        } else {
            0.5 * ((difference.sin() / sum.sin()).powi(2) + (difference.tan() / sum.tan()).powi(2))
        };
        let got = lit(&ball, x) / open;
        let expected = (1.0 - reflected).powi(2);
        assert!(
            (got / expected - 1.0).abs() < 5e-3,
            "{got} for {expected} at {x}"
        );
    }
}

#[test]
fn too_many_media_around_the_camera_are_rejected() {
    let mut scene = dark();
    for radius in 6..=10 {
        add(
            &mut scene,
            sphere(DVec3::ZERO, f64::from(radius)),
            glass(1.5),
        );
    }
    let packed = pack::scene(&scene).expect("a packed scene");
    let refused = packed.frame(&scene.frame(0.0));
    assert!(matches!(
        refused,
        Err(PackError::TooMany {
            count: 5,
            limit: 4,
            ..
        })
    ));
}

/// A track of two keys at 0 and 1 seconds.
fn track(target: Target, values: [DVec3; 2]) -> Track {
    Track {
        targets: vec![target],
        curve: Curve {
            times: vec![0.0, 1.0],
            values: Values::Vector(values.into()),
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

/// The materials of the media around the camera at a time.
fn media_at(scene: &Scene, time: f64) -> [u32; 4] {
    let packed = pack::scene(scene).expect("a packed scene");
    let view = packed.frame(&scene.frame(time)).expect("a frame");
    view.frame.camera_media
}

#[test]
fn media_round_the_camera_are_those_that_are_transparent_at_the_time() {
    let mut scene = dark();
    add(&mut scene, sphere(DVec3::ZERO, 9.0), glass(1.5));
    scene.materials[0].classical_mut().transmit = Vec3::ZERO;
    assert_eq!(media_at(&scene, 1.0), [NONE; 4]);
    scene.tracks = vec![track(
        Target::Material(0, MaterialProperty::Transmit),
        [DVec3::ZERO, DVec3::ONE],
    )];
    assert_eq!(media_at(&scene, 0.0), [NONE; 4]);
    assert_eq!(media_at(&scene, 0.5), [0, NONE, NONE, NONE]);
    scene.materials[0].classical_mut().transmit = Vec3::ONE;
    assert_eq!(media_at(&scene, 0.0), [NONE; 4]);
}

#[test]
fn of_the_media_round_the_camera_the_outermost_comes_first_at_all_times() {
    let mut scene = dark();
    add(&mut scene, sphere(DVec3::ZERO, 9.0), glass(1.5));
    add(&mut scene, sphere(DVec3::ZERO, 7.0), glass(1.3));
    scene.nodes.push(Node::default());
    scene.shapes[1].node = Some(0);
    scene.tracks = vec![track(
        Target::Node(0, NodeProperty::Scale),
        [DVec3::ONE, DVec3::splat(2.0)],
    )];
    assert_eq!(media_at(&scene, 0.0), [0, 1, NONE, NONE]);
    assert_eq!(media_at(&scene, 1.0), [1, 0, NONE, NONE]);
}

#[test]
fn the_media_round_the_camera_are_those_of_the_copy_that_it_is_in() {
    let mut scene = dark();
    scene.materials = vec![glass(1.5), glass(1.3)];
    scene.meshes = vec![
        scenes::ball(UVec2::new(12, 8), 0).into(),
        scenes::ball(UVec2::new(12, 8), 1).into(),
    ];
    // Only one of the copies of the first mesh, stretched and mirrored, contains the camera; so does one of the
    // second's.
    let stretched = DAffine3::from_scale_rotation_translation(
        dvec3(-1.0, 1.0, 6.0),
        DQuat::from_rotation_x(0.1),
        dvec3(0.0, 0.0, 2.0),
    );
    let copy = |mesh, placement| Instance {
        mesh,
        placement,
        node: None,
        name: String::new(),
    };
    scene.instances = vec![
        copy(
            1,
            DAffine3::from_translation(dvec3(0.1, 0.0, 5.0))
                * DAffine3::from_scale(DVec3::splat(0.3)),
        ),
        copy(0, DAffine3::from_translation(dvec3(0.0, 3.0, 5.0))),
        copy(0, stretched),
        copy(1, DAffine3::from_translation(dvec3(0.0, -3.0, 5.0))),
    ];
    assert_eq!(media_at(&scene, 0.0), [0, 1, NONE, NONE]);
    scene.instances.remove(2);
    assert_eq!(media_at(&scene, 0.0), [1, NONE, NONE, NONE]);
}

/// A ball around the origin in Haines' format, in front of a constant background.
fn nff_ball(material: &str) -> Scene {
    let text = format!(
        "b 0.25 0.5 1\nv\nfrom 0 -5 0\nat 0 0 0\nup 0 0 1\nangle 30\nhither 1\nresolution 64 64\n\
         l 3 -4 5\nf {material}\ns 0 0 0 1\n"
    );
    import::parse("a.nff", &text, &import::Options::default()).expect("a scene")
}

/// Every pixel of a picture through the camera of [`nff_ball`], with its value in f64. Rays within rounding
/// error of the edge of the ball are skipped.
fn check_nff_ball(image: &Image, expected: impl Fn(DVec3, Option<DVec3>) -> DVec3) {
    let mut verdict = Verdict::on("a ball");
    let eye = dvec3(0.0, -5.0, 0.0);
    let side = f64::from(image.width);
    for (i, pixel) in image.pixels.iter().enumerate() {
        let (x, y) = (i as u32 % image.width, i as u32 / image.width);
        let at = |i: u32| (f64::from(2 * i + 1) / side - 1.0) * 15_f64.to_radians().tan();
        let direction = dvec3(at(x), 1.0, -at(y)).normalize();
        let b = eye.dot(direction);
        let square = b * b - eye.length_squared() + 1.0;
        if square.abs() < 1e-4 {
            continue;
        }
        let n = (square > 0.0).then(|| eye - (b + square.sqrt()) * direction);
        let expected = expected(direction, n);
        let got = Vec3::from_slice(&pixel[..3]).as_dvec3();
        let off = (got - expected).abs().max_element();
        verdict.that(format!("({x}, {y})"), off < 1e-4, || {
            format!("{got} for {expected}")
        });
    }
    verdict.close();
}

#[test]
fn a_ball_of_haines_adds_phongs_light_its_mirror_and_what_comes_through() {
    // Light reflected outside comes from the background. Light that entered hits the wall from inside under its
    // angle of entry, so that it always exits: with d bounces left, the radiance along a ray inside is I(d) = T
    // B + Ks I(d - 1), I(0) = 0. No lamp illuminates the inside.
    let (mirror, through, depth) = (0.25_f64, 0.5_f64, 5);
    let scene = nff_ball("1 0.5 0.25 0.5 0.25 12 0.5 1.5");
    let image = render(
        &scene,
        &RenderSettings {
            size: (64, 64),
            ..to_depth(depth)
        },
    )
    .0;
    let back = dvec3(0.25, 0.5, 1.0);
    let inside = through * (1.0 - mirror.powi(depth as i32 - 1)) / (1.0 - mirror);
    let lamp = dvec3(3.0, -4.0, 5.0);
    check_nff_ball(&image, |direction, n| {
        let Some(n) = n else {
            return back;
        };
        let l = (lamp - n).normalize();
        let cos = l.dot(n);
        let highlight = (2.0 * cos * n - l).dot(-direction).max(0.0).powi(12);
        let diffuse = 0.5 * dvec3(1.0, 0.5, 0.25) * cos;
        let local = match cos > 0.0 {
            true => diffuse + mirror * highlight,
            false => DVec3::ZERO,
        };
        local + (mirror + through * inside) * back
    });
}

#[test]
fn a_clear_ball_of_haines_turns_every_ray_by_twice_the_angle_that_snell_bends_it() {
    let mut scene = nff_ball("1 1 1 0 0 1 1 1.5");
    // The brightness gives y, and therefore the deflection of a ray: the camera looks along y.
    scene.background = Background::Gradient {
        bottom: Vec3::ZERO,
        top: Vec3::ONE,
    };
    let image = render(
        &scene,
        &RenderSettings {
            size: (64, 64),
            ..to_depth(2)
        },
    )
    .0;
    check_nff_ball(&image, |direction, n| {
        let direction = n.map_or(direction, |n| {
            let incidence = (-n.dot(direction)).acos();
            let turn = 2.0 * (incidence - (incidence.sin() / 1.5).asin());
            let inwards = (-n).reject_from(direction).normalize_or_zero();
            turn.cos() * direction + turn.sin() * inwards
        });
        DVec3::splat(0.5 + 0.5 * direction.y)
    });
}

#[test]
fn inside_a_ball_of_haines_only_rays_within_the_critical_angle_go_on() {
    // At the distance s from the centre the ray hits the wall under sin φ = s sin θ; without a mirror nothing
    // returns from beyond the critical angle.
    let mut scene = nff_ball("1 1 1 0 0 1 0.5 1.25");
    let eye = dvec3(0.9, 0.0, 0.0);
    scene.cameras[0] = camera(eye, eye + DVec3::NEG_Z, 1.0);
    scene.background = Background::Color(Vec3::ONE);
    let settings = RenderSettings {
        size: (64, 64),
        ..to_depth(5)
    };
    let (image, stats) = render(&scene, &counting(&settings));
    let (mut lit, mut dark) = (0, 0);
    for (i, pixel) in image.pixels.iter().enumerate() {
        let at = |i: usize| ((2 * i + 1) as f64 / 64.0 - 1.0) * 0.5_f64.tan();
        let direction = dvec3(at(i % 64), -at(i / 64), -1.0).normalize();
        let sine = direction.cross(eye).length();
        if (sine - 0.8).abs() < 1e-5 {
            continue;
        }
        let leaves = sine < 0.8;
        assert_eq!(pixel[0], if leaves { 0.5 } else { 0.0 }, "pixel {i}");
        lit += u64::from(leaves);
        dark += u64::from(!leaves);
    }
    assert!(lit > 50 && dark > 50 && lit + dark == 4096, "{lit} {dark}");
    let rays = stats.rays.expect("counts");
    assert_eq!((rays.refraction, rays.refraction_hits), (lit, 0));
}
