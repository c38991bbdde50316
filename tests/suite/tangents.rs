//! Tangents: those of MikkTSpace beside another implementation and closed forms, and what normal maps show with them.

use crate::instances::{packed, rendered};
use crate::reference::compare::sized;
use crate::reference::scenes::{self, Build};
use crate::support::random::Random;
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, UVec2, Vec2, Vec3, Vec4, dvec3, vec3};
use glimray::image::Image;
use glimray::render::{Antialias, Integrator, RenderSettings};
use glimray::scene::{
    Beyond, Curve, Deformation, Easing, Influences, Interpolation, Joint, Material, Mesh, Minify,
    MorphTarget, Node, NodeProperty, Pattern, Picture, Scene, Skin, Space, Target, Texels, Texture,
    Textures, Track, Values, Wrap,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The colour of a normal that leans along u and against v.
const CODE: [u8; 4] = [200, 80, 210, 255];

/// A scene whose first material has a map of one normal.
fn mapped() -> Scene {
    let mut scene = scenes::empty();
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
    scene.materials = vec![Material {
        textures: Textures {
            normal: Some(0),
            ..Textures::default()
        },
        ..Material::default()
    }];
    scene
}

/// The mesh with its tangents.
fn completed(mesh: Mesh) -> Mesh {
    let mut scene = mapped();
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene.complete_tangents();
    (*scene.meshes[0]).clone()
}

/// A mesh as the other implementation sees it, and the tangents that it finds.
struct Other<'a> {
    mesh: &'a Mesh,
    found: Vec<[Option<[f32; 4]>; 3]>,
}

impl Geometry for Other<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.mesh.triangles[face][corner] as usize].into()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.mesh.triangles[face][corner] as usize].into()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.mesh.uvs[self.mesh.triangles[face][corner] as usize].into()
    }

    fn set_tangent(&mut self, found: Option<TangentSpace>, face: usize, corner: usize) {
        self.found[face][corner] = found.map(|it| it.tangent_encoded());
    }
}

/// Compares the tangents of all corners with those of the other implementation.
fn check_with_other(name: &str, mesh: Mesh) {
    let mut other = Other {
        mesh: &mesh,
        found: vec![[None; 3]; mesh.triangles.len()],
    };
    generate_tangents(&mut other).expect("tangents");
    let expected = other.found;
    let ours = completed(mesh.clone());
    assert_eq!(ours.triangles.len(), mesh.triangles.len(), "{name}");
    let (mut compared, mut split) = (0, 0);
    for (index, (triangle, before)) in ours.triangles.iter().zip(&mesh.triangles).enumerate() {
        for k in 0..3 {
            let (vertex, old) = (triangle[k] as usize, before[k] as usize);
            split += usize::from(vertex != old);
            assert_eq!(ours.positions[vertex], mesh.positions[old], "{name}");
            assert_eq!(ours.normals[vertex], mesh.normals[old], "{name}");
            assert_eq!(ours.uvs[vertex], mesh.uvs[old], "{name}");
            let found = ours.tangents[vertex];
            match expected[index][k] {
                None => assert_eq!(found, Vec4::ZERO, "{name}: triangle {index}"),
                Some(expected) => {
                    compared += 1;
                    let off = (found - Vec4::from(expected)).length();
                    assert!(
                        off < 2e-3,
                        "{name}: triangle {index}, corner {k}: {found}, not {expected:?}"
                    );
                }
            }
        }
    }
    let added = ours.positions.len() - mesh.positions.len();
    println!("{name}: {compared} corners, {split} at {added} copies of vertices");
}

/// A unit sphere with u around and v up.
fn globe(parts: UVec2) -> Mesh {
    let mut mesh = scenes::ball(parts, 0);
    mesh.uvs.clear();
    for j in 0..=parts.y {
        for i in 0..=parts.x {
            let (u, v) = (i as f32 / parts.x as f32, j as f32 / parts.y as f32);
            mesh.uvs.push(Vec2::new(u, 1.0 - v));
        }
    }
    mesh
}

#[test]
fn tangents_agree_with_another_implementation_of_mikktspace() {
    let mut random = Random::new(11);
    check_with_other("a sphere", globe(UVec2::new(24, 12)));
    // u is mirrored in the middle, where vertices are shared.
    let mut mirrored = globe(UVec2::new(24, 12));
    for uv in &mut mirrored.uvs {
        uv.x = 0.5 - (uv.x - 0.5).abs();
    }
    check_with_other("a mirrored sphere", mirrored.clone());
    // The triangles with vertices of their own, in another order.
    let mut soup = Mesh::default();
    for triangle in mirrored.triangles.iter().rev() {
        let first = soup.positions.len() as u32;
        for &i in triangle {
            let i = i as usize;
            soup.positions.push(mirrored.positions[i]);
            soup.normals.push(mirrored.normals[i]);
            soup.uvs.push(mirrored.uvs[i]);
            soup.materials.push(0);
        }
        soup.triangles.push([first + 2, first, first + 1]);
    }
    check_with_other("a soup of triangles", soup);
    // Mappings of all orientations and sizes.
    let mut chaos = globe(UVec2::new(16, 16));
    for uv in &mut chaos.uvs {
        *uv = Vec2::new(
            random.between(0.0, 1.0) as f32,
            random.between(0.0, 1.0) as f32,
        );
    }
    check_with_other("a sphere with random coordinates", chaos.clone());
    // Some triangles have no area in space, some none in u and v.
    for k in 0..60 {
        let at = 7 * k;
        match k % 3 {
            0 => chaos.triangles[at][1] = chaos.triangles[at][0],
            1 => {
                let [a, b, c] = chaos.triangles[at].map(|i| i as usize);
                chaos.uvs[b] = chaos.uvs[a];
                chaos.uvs[c] = chaos.uvs[a];
            }
            _ => chaos.triangles[at].reverse(),
        }
    }
    check_with_other("a damaged sphere", chaos);
}

#[test]
fn tangents_of_a_quad_and_a_sphere_are_what_geometry_says() {
    for degrees in [0.0f64, 30.0, 135.0] {
        for mirror in [1.0, -1.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut quad = scenes::quad(2.0, 0);
            // u points along (cos, sin) in the plane of x and −z, which is seen from above.
            let uv = |p: &Vec3| {
                let (x, y) = (f64::from(p.x), f64::from(-p.z));
                DVec2::new(cos * x + sin * y, mirror * (cos * y - sin * x)).as_vec2()
            };
            quad.uvs = quad.positions.iter().map(uv).collect();
            let expected = dvec3(cos, 0.0, -sin).as_vec3().extend(mirror as f32);
            for tangent in completed(quad).tangents {
                assert!(
                    (tangent - expected).length() < 1e-6,
                    "{tangent}, {expected}"
                );
            }
        }
    }
    // The direction of growing u on a sphere is horizontal. At the poles it has none.
    let globe = completed(globe(UVec2::new(64, 32)));
    let mut count = 0;
    for ((normal, tangent), uv) in globe.normals.iter().zip(&globe.tangents).zip(&globe.uvs) {
        // At the seam the mean is over triangles of one side.
        if uv.x == 0.0 || uv.x == 1.0 {
            continue;
        }
        let around = DVec3::Y.cross(normal.as_dvec3());
        if around.length() > 0.2 {
            count += 1;
            let expected = around.normalize().as_vec3().extend(1.0);
            assert!(
                (*tangent - expected).length() < 2e-3,
                "{tangent}, {expected}"
            );
        }
    }
    assert!(count > 1600, "{count}");
}

#[test]
fn only_meshes_whose_material_shows_them_have_tangents() {
    let mut scene = mapped();
    let plain = scene.add_material(Material::default()) as u32;
    let mut other = globe(UVec2::new(8, 8));
    other.materials.fill(plain);
    let before = globe(UVec2::new(8, 8));
    scene.add_mesh(before.clone(), DAffine3::IDENTITY);
    scene.add_mesh(other.clone(), DAffine3::IDENTITY);
    scene.complete_tangents();
    assert_eq!(*scene.meshes[1], other);
    assert_eq!(
        scene.meshes[0].tangents.len(),
        scene.meshes[0].positions.len()
    );
    let with = scene.meshes[0].clone();
    scene.complete_tangents();
    assert_eq!(scene.meshes[0], with, "a second time changes nothing");
    let packed = packed(&scene, 1 << 14);
    assert_eq!(packed.tangents.len(), packed.vertices.len());
    scene.materials[0] = Material::default();
    scene.meshes[0] = before.into();
    scene.complete_tangents();
    assert!(scene.meshes[0].tangents.is_empty());
    let packed = crate::instances::packed(&scene, 1 << 14);
    assert!(packed.tangents.is_empty());
}

#[test]
fn a_fan_of_a_million_triangles_needs_no_deep_stack() {
    let count = 1_000_000u32;
    let mut fan = Mesh {
        positions: vec![Vec3::ZERO],
        ..Mesh::default()
    };
    for i in 0..=count {
        let angle = TAU * f64::from(i) / f64::from(count);
        fan.positions
            .push(vec3(angle.cos() as f32, angle.sin() as f32, 0.0));
    }
    fan.uvs = fan.positions.iter().map(|p| p.truncate()).collect();
    fan.normals = vec![Vec3::Z; fan.positions.len()];
    fan.materials = vec![0; fan.positions.len()];
    fan.triangles = (1..=count).map(|i| [0, i, i + 1]).collect();
    let tangents = completed(fan).tangents;
    let off = |tangent: &Vec4| (*tangent - Vec4::new(1.0, 0.0, 0.0, 1.0)).length();
    assert!(off(&tangents[0]) < 1e-5, "{}", tangents[0]);
}

/// A triangle that covers the picture of an orthographic camera, with normals and tangents that differ.
fn wide() -> Mesh {
    let mut random = Random::new(3);
    let mut near = |axis: DVec3| (axis + 0.4 * random.direction()).normalize();
    let normals = [0; 3].map(|_| near(DVec3::Z));
    let tangents = normals.map(|n| {
        let along = near(dvec3(0.8, 0.5, 0.0));
        (along - along.dot(n) * n)
            .normalize()
            .as_vec3()
            .extend(-1.0)
    });
    Mesh {
        positions: vec![
            vec3(-3.0, -2.0, 0.1),
            vec3(4.0, -2.5, 0.0),
            vec3(0.0, 4.0, -0.2),
        ],
        normals: normals.map(|n| n.as_vec3()).to_vec(),
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
        tangents: tangents.to_vec(),
        materials: vec![0; 3],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    }
}

const SIDE: u32 = 16;

fn normals_view() -> RenderSettings {
    RenderSettings {
        integrator: Integrator::Normals,
        antialias: Antialias::None,
        samples: 1,
        ..sized(SIDE, SIDE)
    }
}

/// Looks along −z at the square from −0.5 to 0.5.
fn look(scene: &mut Scene) {
    scene.cameras[0].look_from = dvec3(0.0, 0.0, 9.0);
    scene.cameras[0].look_at = DVec3::ZERO;
    scene.cameras[0].orthographic_height = Some(1.0);
    scene.render_origin = None;
}

/// The mapped normal at a point of a triangle, by the definition of tangent space.
fn normal_at(
    at: DVec2,
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    tangents: [DVec3; 3],
    hand: f64,
) -> DVec3 {
    let [a, b, c] = corners.map(DVec3::truncate);
    let area = (b - a).perp_dot(c - a);
    let (v, w) = (
        (at - a).perp_dot(c - a) / area,
        (b - a).perp_dot(at - a) / area,
    );
    let mean = |values: [DVec3; 3]| values[0] * (1.0 - v - w) + values[1] * v + values[2] * w;
    let (n, t) = (mean(normals), mean(tangents));
    let [x, y, z, _] = CODE.map(|code| 2.0 * f64::from(code) / 255.0 - 1.0);
    let mapped = (x * t + y * hand * n.cross(t) + z * n).normalize();
    // The shading normal is on the side of the ray.
    let ng = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let is_turned = (n.dot(ng) > 0.0) == (ng.z < 0.0);
    if is_turned { -mapped } else { mapped }
}

fn check_normals(name: &str, image: &Image, expected: impl Fn(DVec2) -> DVec3) {
    for y in 0..SIDE {
        for x in 0..SIDE {
            let place = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
            let at = DVec2::new(place(x), -place(y));
            let [r, g, b, _] = image.pixels[(y * SIDE + x) as usize];
            let found = 2.0 * vec3(r, g, b).as_dvec3() - 1.0;
            let expected = expected(at);
            assert!(
                (found - expected).length() < 1e-3,
                "{name} at {at}: {found}, not {expected}"
            );
        }
    }
}

#[test]
fn given_tangents_turn_with_mirrored_and_unevenly_scaled_nodes() {
    let places = [
        ("as it is", DAffine3::IDENTITY),
        ("turned", DAffine3::from_rotation_z(0.7)),
        ("mirrored", DAffine3::from_scale(dvec3(-1.0, 1.0, 1.0))),
        (
            "mirrored, sheared and scaled",
            DAffine3::from_mat3(
                DMat3::from_rotation_x(0.3)
                    * DMat3::from_diagonal(dvec3(1.5, -0.7, 2.0))
                    * DMat3::from_rotation_y(0.4),
            ),
        ),
    ];
    for (name, place) in places {
        for is_instanced in [false, true] {
            let mut scene = mapped();
            look(&mut scene);
            scene.add_mesh(wide(), place);
            if is_instanced {
                // Only meshes of moving nodes are surely instanced.
                scene.nodes.push(Node::default());
                scene.instances[0].node = Some(0);
                let way = vec![DVec3::ZERO, DVec3::X];
                scene
                    .tracks
                    .push(track(NodeProperty::Translation, Values::Vector(way)));
            }
            let mesh = scene.meshes[0].clone();
            scene.complete_tangents();
            assert_eq!(scene.meshes[0], mesh, "none is lacking");
            let packed = packed(&scene, 1 << 14);
            let (image, _) = rendered(&packed, &[scene.frame(0.0)], &normals_view());
            let m = place.matrix3;
            let pick = |list: &[Vec3]| [0, 1, 2].map(|i| list[i].as_dvec3());
            let corners = pick(&mesh.positions).map(|p| place.transform_point3(p));
            let normals = pick(&mesh.normals).map(|n| (m.inverse().transpose() * n).normalize());
            let tangents = [0, 1, 2].map(|i| {
                let own: Vec4 = mesh.tangents[i];
                (m * own.truncate().as_dvec3()).normalize()
            });
            let hand = -m.determinant().signum();
            let kind = if is_instanced { "instanced" } else { "baked" };
            check_normals(&format!("{name}, {kind}"), &image, |at| {
                normal_at(at, corners, normals, tangents, hand)
            });
        }
    }
}

fn track(property: NodeProperty, values: Values) -> Track {
    Track {
        targets: vec![Target::Node(0, property)],
        curve: Curve {
            times: vec![0.0, 1.0],
            values,
            interpolation: Interpolation::Linear,
            easing: Easing::None,
            beyond: Beyond::Hold,
        },
    }
}

/// `wide` on a joint that turns about z by 2 rad in a second.
fn turning(targets: Vec<MorphTarget>) -> Scene {
    let mut scene = mapped();
    look(&mut scene);
    scene.add_mesh(wide(), DAffine3::IDENTITY);
    scene.nodes.push(Node::default());
    let turns = vec![DQuat::IDENTITY, DQuat::from_rotation_z(2.0)];
    scene
        .tracks
        .push(track(NodeProperty::Rotation, Values::Rotation(turns)));
    let mut influences = Influences::default();
    (0..3).for_each(|_| influences.push([(0, 1.0)]));
    scene.deformations.push(Deformation {
        mesh: 0,
        weights: vec![0.5; targets.len()],
        targets: targets.into(),
        skin: Some(Skin {
            joints: vec![Joint {
                node: Some(0),
                node_from_mesh: DAffine3::from_scale(dvec3(1.0, -1.0, 1.0)),
            }],
            influences: influences.into(),
        }),
        flat: Arc::default(),
    });
    scene
}

#[test]
fn tangents_follow_skins_and_morph_targets() {
    let added = [
        vec3(0.1, 0.6, 0.0),
        vec3(-0.3, 0.2, 0.1),
        vec3(0.0, -0.5, 0.2),
    ];
    let target = MorphTarget {
        vertices: vec![0, 1, 2],
        positions: vec![Vec3::ZERO; 3],
        normals: Vec::new(),
        tangents: added.to_vec(),
    };
    let scene = turning(vec![target]);
    let packed = packed(&scene, 1 << 14);
    let (image, _) = rendered(&packed, &[scene.frame(0.6)], &normals_view());
    let mesh = wide();
    let m = DMat3::from_rotation_z(1.2) * DMat3::from_diagonal(dvec3(1.0, -1.0, 1.0));
    // A mirror is its own inverse transpose: normals stay on their side.
    let normals = [0, 1, 2].map(|i| m * mesh.normals[i].as_dvec3());
    let tangents = [0, 1, 2].map(|i| {
        let own: Vec4 = mesh.tangents[i];
        let t = own.truncate().as_dvec3() + 0.5 * added[i].as_dvec3();
        let n = mesh.normals[i].as_dvec3();
        m * (t - t.dot(n) * n).normalize()
    });
    let corners = [0, 1, 2].map(|i| m * mesh.positions[i].as_dvec3());
    check_normals("a turned figure", &image, |at| {
        // The joint mirrors.
        normal_at(at, corners, normals, tangents, 1.0)
    });
}

#[test]
fn tangents_turn_while_the_shutter_is_open() {
    let mut scene = turning(Vec::new());
    // Flat, so that the mean over the angles has a closed form.
    let mut mesh = wide();
    mesh.normals = vec![Vec3::Z; 3];
    mesh.tangents = vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 3];
    scene.meshes[0] = mesh.into();
    let frames = scene.motion_samples(0.0, 1.0);
    let packed = packed(&scene, 1 << 14);
    assert!(packed.view(&frames).expect("a view").deforms());
    let settings = RenderSettings {
        samples: 1024,
        antialias: Antialias::Stratified,
        ..normals_view()
    };
    let (image, _) = rendered(&packed, &frames, &settings);
    let [x, y, z, _] = CODE.map(|code| 2.0 * f64::from(code) / 255.0 - 1.0);
    let code = dvec3(x, y, z).normalize();
    // The joint mirrors y: the map is that of (x, −y), turned by angles from 0 to 2.
    let (c, s) = (2f64.sin() / 2.0, (1.0 - 2f64.cos()) / 2.0);
    let expected = dvec3(c * code.x + s * code.y, s * code.x - c * code.y, code.z);
    let mut mean = DVec3::ZERO;
    for [r, g, b, _] in &image.pixels {
        mean += (2.0 * vec3(*r, *g, *b).as_dvec3() - 1.0) / f64::from(SIDE * SIDE);
    }
    assert!((mean - expected).length() < 4e-3, "{mean}, not {expected}");
}

#[test]
fn copies_of_vertices_move_as_the_vertices_do() {
    let mut mesh = globe(UVec2::new(8, 4));
    for uv in &mut mesh.uvs {
        uv.x = 0.5 - (uv.x - 0.5).abs();
    }
    let count = mesh.positions.len();
    let mut scene = mapped();
    scene.add_mesh(mesh.clone(), DAffine3::IDENTITY);
    // Two nodes share the mesh and its deformation.
    scene.meshes.push(scene.meshes[0].clone());
    let mut random = Random::new(8);
    let mut influences = Influences::default();
    for i in 0..count {
        influences.push([(0, 0.5), (1, i as f32)]);
    }
    let vertices: Vec<u32> = (0..count as u32).step_by(2).collect();
    let target = MorphTarget {
        positions: vertices
            .iter()
            .map(|_| random.direction().as_vec3())
            .collect(),
        normals: vertices
            .iter()
            .map(|_| random.direction().as_vec3())
            .collect(),
        tangents: Vec::new(),
        vertices,
    };
    let targets: Arc<[MorphTarget]> = [target].into();
    let influences = Arc::new(influences);
    for mesh in 0..2 {
        scene.deformations.push(Deformation {
            mesh,
            targets: targets.clone(),
            weights: vec![0.0],
            skin: Some(Skin {
                joints: Vec::new(),
                influences: influences.clone(),
            }),
            flat: Arc::default(),
        });
    }
    scene.complete_tangents();
    let new = &scene.meshes[0];
    let copies = new.positions.len() - count;
    assert!(copies > 0);
    assert!(Arc::ptr_eq(new, &scene.meshes[1]));
    let [a, b] = [0, 1].map(|i| &scene.deformations[i]);
    assert!(Arc::ptr_eq(&a.targets, &b.targets));
    let skin = a.skin.as_ref().expect("a skin");
    assert_eq!(skin.influences.len(), new.positions.len());
    let target = &a.targets[0];
    assert!(target.vertices.is_sorted());
    for (old, new) in mesh
        .triangles
        .iter()
        .flatten()
        .zip(scene.meshes[0].triangles.iter().flatten())
    {
        let (old, new) = (*old as usize, *new as usize);
        assert_eq!(skin.influences.of(new), influences.of(old));
        let moved = |target: &MorphTarget, vertex: usize| {
            let at = target.vertices.binary_search(&(vertex as u32)).ok()?;
            Some((target.positions[at], target.normals[at]))
        };
        assert_eq!(moved(target, new), moved(&targets[0], old));
    }
}
