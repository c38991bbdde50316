//! Coincident volumes of one medium, in part or as a whole: together they look like one.

use crate::{
    features::boxes,
    motion_blur::track,
    reference::{
        compare::{assert_none, check_alike, render, sized},
        scenes::{self, Build},
    },
};
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::{
    image::Image,
    render::RenderSettings,
    scene::{
        Background, Camera, CanonicalShape, Fresnel, Geometry, Instance, Material, Node,
        NodeProperty, Phong, Scene, Shape, Target, Values,
    },
};
use std::sync::Arc;

fn glass() -> Material {
    Material::from(Phong {
        diffuse: Vec3::ZERO,
        ambient: Vec3::ZERO,
        reflect: Vec3::ONE,
        transmit: Vec3::ONE,
        opacity: 0.0,
        ior: 1.5,
        absorption: vec3(0.3, 0.1, 0.2),
        fresnel: Fresnel::Exact,
        ..Phong::default()
    })
}

/// Under a bright sky, with two materials of the same glass.
fn stage(look_from: DVec3, look_at: DVec3) -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from,
            look_at,
            fov_y: 0.8,
            ..Camera::default()
        }],
        materials: vec![glass(), glass()],
        background: Background::Gradient {
            bottom: Vec3::splat(0.1),
            top: Vec3::ONE,
        },
        ..Scene::default()
    }
}

fn outside() -> Scene {
    stage(dvec3(1.5, 2.2, 4.0), DVec3::ZERO)
}

fn inside() -> Scene {
    stage(dvec3(0.45, 0.05, 0.1), dvec3(5.0, 0.3, -1.0))
}

fn picture(scene: &Scene) -> Image {
    let settings = RenderSettings {
        max_depth: 8,
        ..sized(96, 72)
    };
    let (image, stats) = render(scene, &settings);
    assert_eq!(stats.cut_off_trees, 0);
    image
}

fn add_box(scene: &mut Scene, [min, max]: [DVec3; 2]) {
    let world_from_canonical = DAffine3::from_scale_rotation_translation(
        (max - min) / 2.0,
        DQuat::IDENTITY,
        (min + max) / 2.0,
    );
    let geometry = Geometry::Placed {
        canonical: CanonicalShape::Box,
        world_from_canonical,
    };
    scene.shapes.push(Shape {
        geometry,
        material: 0,
        node: None,
        name: String::new(),
    });
}

const WHOLE: [DVec3; 2] = [DVec3::NEG_ONE, DVec3::ONE];
/// Parts of it that share five faces, or parts of three.
const PARTS: [[DVec3; 2]; 2] = [
    [DVec3::NEG_ONE, dvec3(0.2, 1.0, 1.0)],
    [dvec3(-1.0, -0.4, -0.5), dvec3(0.2, 0.6, 1.0)],
];

#[test]
fn a_volume_inside_another_of_the_same_glass_is_invisible_where_they_share_faces() {
    let mut one = outside();
    add_box(&mut one, WHOLE);
    let expected = picture(&one);
    let rows = PARTS.into_iter().enumerate().flat_map(|(i, part)| {
        let mut shapes = outside();
        add_box(&mut shapes, WHOLE);
        add_box(&mut shapes, part);
        let mut meshes = outside();
        for corners in [WHOLE, part] {
            meshes.add_mesh(boxes(&[corners]), DAffine3::IDENTITY);
        }
        let mut mixed = outside();
        mixed.add_mesh(boxes(&[WHOLE]), DAffine3::IDENTITY);
        add_box(&mut mixed, part);
        [("shapes", shapes), ("meshes", meshes), ("mixed", mixed)].map(|(name, scene)| {
            let name = format!("{name}, part {i}");
            check_alike(&name, &expected, &picture(&scene), 2.0, 0.002)
        })
    });
    assert_none(rows.collect::<Vec<_>>());
}

/// A volume once, and twice in the same position: with one material, with two, and with one copy on a node that
/// may move.
fn check_twins(
    name: &str,
    stage: fn() -> Scene,
    add: impl Fn(&mut Scene),
) -> Vec<Result<(), String>> {
    let mut one = stage();
    add(&mut one);
    let expected = picture(&one);
    let mut twins = one.clone();
    add(&mut twins);
    let mut two_materials = twins.clone();
    if let [.., last] = &mut two_materials.shapes[..] {
        last.material = 1;
    }
    if let [.., last] = &mut two_materials.meshes[..] {
        Arc::make_mut(last).materials.fill(1);
    }
    let mut carried = twins.clone();
    carried.nodes.push(Node::default());
    let target = Target::Node(0, NodeProperty::Translation);
    let still = Values::Vector(vec![DVec3::ZERO, DVec3::X]);
    carried.tracks.push(track(target, still));
    if let [.., last] = &mut carried.shapes[..] {
        last.node = Some(0);
    }
    if let [.., last] = &mut carried.instances[..] {
        last.node = Some(0);
    }
    [
        ("of one material", twins),
        ("of two materials", two_materials),
        ("of which one may move", carried),
    ]
    .map(|(which, scene)| {
        check_alike(
            &format!("{name} {which}"),
            &expected,
            &picture(&scene),
            2.0,
            0.005,
        )
    })
    .into()
}

fn add_torus(scene: &mut Scene) {
    let mesh = scenes::torus(1.0, 0.6, UVec2::new(24, 12), 0);
    scene.meshes.push(mesh.into());
    scene.instances.push(Instance {
        mesh: scene.meshes.len() - 1,
        placement: DAffine3::from_rotation_x(0.4),
        node: None,
        name: String::new(),
    });
}

#[test]
fn coincident_volumes_of_glass_look_like_one() {
    let ball = |scene: &mut Scene| scene.add_sphere(DVec3::ZERO, 1.2, 0);
    let mut rows = check_twins("balls", outside, ball);
    rows.extend(check_twins("meshes", outside, add_torus));
    rows.extend(check_twins("balls round the camera", inside, ball));
    rows.extend(check_twins("meshes round the camera", inside, add_torus));
    assert_none(rows);
}

#[test]
fn a_ray_inside_too_many_volumes_is_counted() {
    let nested = |count: usize| {
        let mut scene = stage(dvec3(0.0, 0.0, 20.0), DVec3::ZERO);
        scene.cameras[0].fov_y = 0.01;
        for i in 0..count {
            scene.add_sphere(DVec3::ZERO, 5.0 - 0.5 * i as f64, 0);
        }
        render(&scene, &sized(8, 8)).1.cut_off_trees
    };
    assert_eq!((nested(4), nested(5)), (0, 64));
}
