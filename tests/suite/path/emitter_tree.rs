//! Emissive triangles and shapes in the light tree: their chances are those of a reference in f64, a ray that hits one
//! knows its chance, and their light is that of closed forms and of the table by power.

use super::emitters::{dust, globe};
use super::light_chances::{Chances, chances, mean_from, wide};
use super::many_lights::{any_kind, floor_under};
use super::{lit_floor, matte, near, paths};
use crate::explain::{finish, random_pixels};
use crate::film::{bytes, cut, film, merged};
use crate::motion_blur::track;
use crate::reference::compare::{sliced, start_packed};
use crate::reference::scenes::Build;
use crate::support::random::Random;
use crate::support::verdict::Verdict;
use bytemuck::cast_slice;
use glam::{DAffine3, DMat3, DQuat, DVec3, Quat, Vec3, dvec3, vec3};
use glimray::layout::{
    LIGHT_INDEX_MASK, LIGHT_LEAF, MATERIAL_TWO_SIDED_EMISSION, NO_INSTANCE, PackedCluster,
    PackedEmitter, PackedInstance, PackedKey, SHAPE, SHAPE_SPHERE,
};
use glimray::pack::{self, PackedScene, PackedView};
use glimray::render::{LightSource, Slicing};
use glimray::scene::{
    Attenuation, CanonicalShape, Deformation, Geometry, Instance, Light, LightKind, LightProperty,
    Material, MorphTarget, Node, NodeProperty, ObjectRef, Phong, Scene, Shape, Target, Values,
};
use std::f64::consts::PI;
use std::sync::Arc;

fn glowing(radiance: f32, two_sided: bool) -> Material {
    Material {
        emission: Vec3::splat(radiance),
        two_sided,
        ..matte(0.0)
    }
}

/// A floor under lamps of all kinds, a globe that shines outwards, copies of a cloud of triangles of which each fourth
/// shines to both sides, and shapes.
pub fn mixed(lamps: usize) -> Scene {
    let glossy = Material {
        bsdf: Phong {
            specular: Vec3::splat(2.0),
            shininess: 20.0,
            ..matte(0.4).classical().into_owned()
        }
        .into(),
        ..matte(0.4)
    };
    let mut scene = floor_under(glossy, lamps, any_kind);
    let material = scene.add_material(glowing(2.0, false)) as u32;
    let placed = DAffine3::from_translation(dvec3(0.9, 0.5, -0.6));
    scene.add_mesh(globe(0.4, 6, material), placed);
    let mut random = Random::new(5);
    let mut place = || (0.25 * random.in_cube()).as_vec3() + vec3(0.0, 0.9, 0.0);
    let centers: Vec<Vec3> = (0..40).map(|_| place()).collect();
    let mesh = dust(&mut scene, &centers);
    scene.add_mesh(mesh, DAffine3::from_translation(-0.5 * DVec3::X));
    let copy = scene.meshes.len() - 1;
    scene.instances.push(Instance {
        mesh: copy,
        placement: DAffine3::from_scale_rotation_translation(
            dvec3(1.5, 0.6, -0.9),
            DQuat::from_rotation_x(0.7),
            dvec3(-0.4, 0.2, -1.0),
        ),
        node: None,
        name: String::new(),
    });
    let shapes = scene.add_material(Material {
        two_sided_emission: false,
        ..glowing(5.0, true)
    });
    let facing_down = DAffine3 {
        matrix3: DMat3::from_cols(0.1 * DVec3::X, -DVec3::Y, -0.15 * DVec3::Z),
        translation: dvec3(-0.6, 0.8, 0.7),
    };
    for canonical in [
        CanonicalShape::Rectangle,
        CanonicalShape::Disc { hole: 0.0 },
    ] {
        let turned = DAffine3::from_rotation_z(f64::from(canonical == CanonicalShape::Rectangle));
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical: turned * facing_down,
            },
            material: shapes,
            node: None,
            name: String::new(),
        });
    }
    scene.add_sphere(dvec3(0.2, 1.4, 0.9), 0.1, shapes);
    scene
}

/// An emitter in render space: corners of a triangle, or the middle of a shape, and the normal of its front.
struct Placed {
    corners: Vec<DVec3>,
    front: Option<DVec3>,
    two_sided: bool,
}

impl Placed {
    fn of(packed: &PackedScene, view: &PackedView, emitter: &PackedEmitter) -> Self {
        let instances: &[PackedInstance] = cast_slice(view.node_parts()[1]);
        let (mut linear, mut inverse, mut shift) = (DMat3::IDENTITY, DMat3::IDENTITY, DVec3::ZERO);
        if emitter.instance != NO_INSTANCE {
            let own = &instances[emitter.instance as usize];
            let rows = |x, y, z| DMat3::from_cols(wide(x), wide(y), wide(z)).transpose();
            linear = rows(own.linear_x, own.linear_y, own.linear_z);
            inverse = rows(own.inverse_x, own.inverse_y, own.inverse_z);
            shift = wide(own.translation);
        }
        let place = |p: [f32; 3]| linear * wide(p) + shift;
        if emitter.primitive & SHAPE != 0 {
            let shape = &packed.shapes[(emitter.primitive & !SHAPE) as usize];
            let front = (inverse.transpose() * wide(shape.row_y)).normalize();
            return Self {
                corners: vec![place(shape.position)],
                front: (shape.kind != SHAPE_SPHERE).then_some(front),
                two_sided: false,
            };
        }
        let own = &packed.triangles[emitter.primitive as usize];
        let corners = [own.v0, own.v1, own.v2].map(place);
        let vertices = [own.i0, own.i1, own.i2].map(|i| &packed.vertices[i as usize]);
        let normals = vertices.map(|vertex| inverse.transpose() * wide(vertex.normal));
        let across = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize();
        let side = normals.iter().sum::<DVec3>().dot(across).signum();
        let flags = packed.materials[vertices[0].material as usize].flags;
        Self {
            corners: corners.to_vec(),
            front: Some(side * across),
            two_sided: flags & MATERIAL_TWO_SIDED_EMISSION != 0,
        }
    }

    fn middle(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / self.corners.len() as f64
    }

    fn reaches(&self, p: DVec3, n: DVec3) -> bool {
        let to_light = (self.middle() - p).normalize();
        let is_ahead = self.front.is_none_or(|front| {
            let cos = -to_light.dot(front);
            cos > 0.01 || self.two_sided && cos < -0.01
        });
        is_ahead && to_light.dot(n) > 0.01
    }

    fn area(&self) -> f64 {
        let [a, b, c] = self.corners[..] else {
            return f64::NAN;
        };
        (b - a).cross(c - a).length() / 2.0
    }

    /// Whether a point is on the triangle, up to rounding.
    fn holds(&self, p: DVec3) -> bool {
        let [a, b, c] = self.corners[..] else {
            return false;
        };
        let sum: f64 = [(a, b), (b, c), (c, a)]
            .iter()
            .map(|(a, b)| (a - p).cross(b - p).length() / 2.0)
            .sum();
        sum < self.area() * 1.0005
    }
}

fn check_chances(verdict: &mut Verdict, packed: &PackedScene, view: &PackedView) {
    let emitters = view.emitters.iter();
    let placed: Vec<_> = (emitters.map(|one| Placed::of(packed, view, one))).collect();
    let mut random = Random::new(4);
    for _ in 0..100 {
        let p = dvec3(0.0, 0.6, 0.0) + 1.2 * random.in_cube() - packed.origin;
        let n = random.direction();
        let all = chances(view, p, n);
        let own = all.emitters.iter().chain(&all.lamps);
        let sum: f64 = own.map(|(chance, _)| chance).sum();
        let what = format!("sum at {p}");
        near(verdict, what, sum + all.missed, 1.0, 1e-6);
        for ((emitter, placed), &(chance, trail)) in
            view.emitters.iter().zip(&placed).zip(&all.emitters)
        {
            verdict.that("trail", emitter.trail == trail, || {
                format!("{emitter:?}, {trail}")
            });
            let is_seen = placed.reaches(p, n);
            verdict.that("chance", chance > 0.0 || !is_seen, || {
                format!("{emitter:?} at {p}, {n}")
            });
        }
    }
}

/// Whether some emitter of this primitive has the expected value.
fn some_is(
    view: &PackedView,
    all: &Chances,
    primitive: u32,
    is_it: impl Fn(usize, f64) -> bool,
) -> bool {
    let own = view.emitters.iter().zip(&all.emitters).enumerate();
    own.filter(|(_, (emitter, _))| emitter.primitive == primitive)
        .any(|(index, (_, (chance, _)))| is_it(index, *chance))
}

#[test]
fn chances_of_emitters_are_those_of_a_reference_for_samples_and_for_hits() {
    let mut verdict = Verdict::on("a tree over lamps, triangles and shapes");
    for (lamps, most_baked) in [(30, 0), (0, 1 << 14)] {
        let scene = mixed(lamps);
        let packed = pack::scene_with(&scene, most_baked).expect("a scene that can be packed");
        let view = packed.frame(&scene.frame(0.0)).expect("a frame");
        verdict.that("tree", view.has_light_tree(), || "none");
        let is_instanced = view.emitters.iter().any(|it| it.instance != NO_INSTANCE);
        verdict.that("instances", is_instanced == (most_baked == 0), || {
            most_baked
        });
        check_chances(&mut verdict, &packed, &view);

        let settings = paths(32, (12, 8), 0);
        let packed = Arc::new(packed);
        let mut renderer = start_packed(packed.clone(), &view, &settings);
        finish(&mut renderer);
        let wanted: Vec<_> = (random_pixels(settings.size, 60, 3).into_iter())
            .map(|place| (place, 0..32))
            .collect();
        let trees = renderer.explain_pixels(&wanted).expect("paths");
        let (mut samples, mut hits) = (0, 0);
        for ray in (trees.iter().flat_map(|tree| &tree.samples)).flat_map(|it| &it.rays) {
            let p = DVec3::from(ray.origin) - packed.origin;
            if p.y + packed.origin.y > 0.001 {
                continue;
            }
            let all = chances(&view, p, DVec3::Y);
            if let Some(sample) = ray.shadow.as_ref().and_then(|it| it.sample.as_ref()) {
                let found = f64::from(sample.chance);
                if sample.source != LightSource::Emitter || found == 0.0 {
                    continue;
                }
                let primitive = sample.primitive.expect("a primitive");
                let is_it = |_, chance: f64| (found - chance).abs() <= 0.02 * chance;
                verdict.that("sample", some_is(&view, &all, primitive, is_it), || {
                    format!("{sample:?} at {p}")
                });
                samples += 1;
            } else if let (Some(hit), Some(sharing)) = (&ray.hit, &ray.sharing)
                && hit.emission != [0.0; 3]
                && !matches!(hit.object, Some(ObjectRef::Shape(_)))
            {
                let at = DVec3::from(hit.position) - packed.origin;
                let cos = DVec3::from(ray.direction)
                    .dot(DVec3::from(hit.geometric_normal))
                    .abs();
                let found = f64::from(sharing.light_pdf.unwrap_or(0.0));
                let is_it = |index: usize, chance: f64| {
                    let own = Placed::of(&packed, &view, &view.emitters[index]);
                    let expected = chance / own.area() * (at - p).length_squared() / cos;
                    own.holds(at) && (found - expected).abs() <= 0.02 * expected
                };
                verdict.that("hit", some_is(&view, &all, hit.primitive, is_it), || {
                    format!("{hit:?} from {p}, density {found}")
                });
                hits += 1;
            }
        }
        verdict.that("counts", samples > 300 && hits > 50, || {
            format!("{samples}, {hits}")
        });
    }
    verdict.close();
}

/// More emitters than the tree has groups for share groups.
#[test]
fn groups_of_emitters_divide_the_chance_of_their_leaf() {
    let mut verdict = Verdict::on("a tree over many triangles");
    let mut scene = lit_floor(matte(0.5), Light::default());
    scene.lights.clear();
    let material = scene.add_material(glowing(2.0, false)) as u32;
    let placed = DAffine3::from_translation(dvec3(0.3, 1.0, -0.2));
    scene.add_mesh(globe(0.4, 136, material), placed);
    let packed = pack::scene(&scene).expect("a scene that can be packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    verdict.that("group", view.frame.emitter_group == 2, || {
        view.frame.emitter_group
    });
    let p = dvec3(0.1, 0.0, 0.1) - packed.origin;
    let all = chances(&view, p, DVec3::Y);
    let sum: f64 = all.emitters.iter().map(|(chance, _)| chance).sum();
    near(&mut verdict, "sum", sum + all.missed, 1.0, 1e-6);
    let settings = paths(64, (24, 16), 0);
    let [expected, found] = [usize::MAX, 2].map(|from| mean_from(&scene, &settings, from));
    near(&mut verdict, "light", found, expected, 0.005 * expected);
    verdict.close();
}

#[test]
fn a_tree_and_a_table_of_emitters_give_the_same_light() {
    let mut verdict = Verdict::on("floors under lamps and emitters");
    for (name, scene) in [
        ("emitters", mixed(0)),
        ("lamps and emitters", mixed(20)),
        ("moving lamps and emitters", moving()),
    ] {
        let settings = paths(2048, (24, 16), 0);
        let [expected, found] = [usize::MAX, 2].map(|from| mean_from(&scene, &settings, from));
        near(&mut verdict, name, found, expected, 0.005 * expected);
    }
    verdict.close();
}

/// The placement of a moving instance, as two neighbouring keys give it: stretch, rotation and translation are mixed apart.
fn between(a: &PackedKey, b: &PackedKey, fraction: f64) -> DAffine3 {
    let mix = |a: [f32; 3], b: [f32; 3]| wide(a).lerp(wide(b), fraction);
    let [from, to] = [a, b].map(|key| Quat::from_array(key.rotation).as_dquat());
    let turn = (from * (1.0 - fraction) + to * fraction).normalize();
    let (d, s) = (mix(a.stretch, b.stretch), mix(a.shear, b.shear));
    let stretch = DMat3::from_cols_array_2d(&[[d.x, s.z, s.y], [s.z, d.y, s.x], [s.y, s.x, d.z]]);
    DAffine3 {
        matrix3: DMat3::from_quat(turn) * stretch,
        translation: mix(a.translation, b.translation),
    }
}

/// The cluster of a leaf.
fn leaf_at(view: &PackedView, trail: u32) -> PackedCluster {
    let clusters: &[PackedCluster] = cast_slice(view.node_parts()[7]);
    let (mut leaf, mut left) = (clusters[0], trail);
    while leaf.child & LIGHT_LEAF == 0 {
        leaf = clusters[(leaf.child & LIGHT_INDEX_MASK) as usize + (left & 3) as usize];
        left >>= 2;
    }
    leaf
}

#[test]
fn leaves_hold_what_moves_at_all_times() {
    let mut verdict = Verdict::on("a tree over lamps and emitters that move");
    let scene = moving();
    let mut packed = pack::scene(&scene).expect("a scene that can be packed");
    packed.tree_from = 2;
    let view = packed
        .view(&scene.motion_samples(0.0, 1.0))
        .expect("a view");
    let instances: &[PackedInstance] = cast_slice(view.node_parts()[1]);
    let keys: &[PackedKey] = cast_slice(view.node_parts()[2]);
    let mut check = |trail: u32, p: DVec3| {
        let leaf = leaf_at(&view, trail);
        let off = (p - wide(leaf.center)).length();
        let radius = f64::from(leaf.radius2).sqrt();
        verdict.that("place", off <= radius + 1e-6, || {
            format!("{off} from the middle, radius {radius}")
        });
    };
    let mut moves = 0;
    for emitter in &view.emitters {
        let instance = &instances[emitter.instance as usize];
        if instance.key_count < 2 {
            continue;
        }
        moves += 1;
        let own = &packed.triangles[emitter.primitive as usize];
        for pair in keys[instance.first_key as usize..][..instance.key_count as usize].windows(2) {
            for step in 0..=8 {
                let now = between(&pair[0], &pair[1], f64::from(step) / 8.0);
                for corner in [own.v0, own.v1, own.v2] {
                    check(emitter.trail, now.transform_point3(wide(corner)));
                }
            }
        }
    }
    for light in &view.lights {
        check(light.place, wide(light.position));
    }
    verdict.that(
        "count",
        moves > 50 && view.frame.light_key_count > 1,
        || moves,
    );
    verdict.close();
}

/// Hidden lamps that cross the scene, a globe that turns about a far point, and a cloud that a morph target scatters, all
/// while the shutter is open.
fn moving() -> Scene {
    let mut scene = floor_under(matte(0.5), 6, |_, center| LightKind::Sphere {
        center,
        radius: 0.05,
    });
    for index in 0..scene.lights.len() {
        scene.lights[index].attenuation = Attenuation::InverseSquare;
        let from = dvec3(-1.5, 0.4 + 0.1 * index as f64, 0.5 * index as f64 - 1.5);
        let way = Values::Vector(vec![from, from + 3.0 * DVec3::X]);
        let target = Target::Light(index, LightProperty::Position);
        scene.tracks.push(track(target, way));
    }
    let material = scene.add_material(glowing(1.0, false)) as u32;
    scene.add_mesh(
        globe(0.2, 6, material),
        DAffine3::from_translation(dvec3(1.0, 0.5, 0.0)),
    );
    scene.nodes.push(Node::default());
    scene.instances.last_mut().expect("a globe").node = Some(scene.nodes.len() - 1);
    let turn = Values::Vector(vec![DVec3::ZERO, dvec3(0.0, 2.5, 0.0)]);
    let target = Target::Node(scene.nodes.len() - 1, NodeProperty::Angles);
    scene.tracks.push(track(target, turn));
    let centers: Vec<Vec3> = (0..40_u16)
        .map(|k| 0.1 * vec3((k % 8).into(), 7.0, (k / 8).into()))
        .collect();
    let mesh = dust(&mut scene, &centers);
    let count = mesh.positions.len() as u32;
    let mut random = Random::new(8);
    let ways = (0..count).map(|_| (0.5 * random.in_cube()).as_vec3());
    scene.deformations.push(Deformation {
        mesh: scene.meshes.len(),
        weights: vec![0.0],
        targets: Arc::new([MorphTarget {
            vertices: (0..count).collect(),
            positions: ways.collect(),
            normals: Vec::new(),
            tangents: Vec::new(),
        }]),
        skin: None,
        flat: Arc::default(),
    });
    let index = scene.deformations.len() - 1;
    let grow = Values::Scalar(vec![0.0, 1.0]);
    scene.tracks.push(track(Target::Weight(index, 0), grow));
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    scene
}

/// The irradiance at the origin of a plane with normal +y from a polygon of radiance 1 above it, by Lambert's formula:
/// positive if its corners run clockwise as seen from there.
pub fn lambert(corners: &[DVec3]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).map(|(a, b)| {
        let across = a.cross(*b);
        a.angle_between(*b) * across.y / across.length()
    });
    edges.sum::<f64>() / 2.0
}

/// The mean over the picture of the irradiance on the floor.
pub fn mean_irradiance(scene: &Scene, at: impl Fn(DVec3) -> f64) -> f64 {
    let camera = &scene.cameras[0];
    let forward = (camera.look_at - camera.look_from).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let half = (camera.fov_y / 2.0).tan();
    let mut sum = 0.0;
    for x in 0..48 {
        for y in 0..32 {
            let [u, v] = [
                (f64::from(x) + 0.5) / 24.0 - 1.0,
                (f64::from(y) + 0.5) / 16.0 - 1.0,
            ];
            let direction = forward + half * (1.5 * u * right + v * up);
            let t = -camera.look_from.y / direction.y;
            sum += at(camera.look_from + t * direction);
        }
    }
    sum / f64::from(48 * 32)
}

/// Flat and closed meshes of many triangles in the tree light a matte floor as Lambert's formula says.
#[test]
fn meshes_in_a_tree_give_the_irradiance_of_closed_forms() {
    let mut verdict = Verdict::on("a matte floor under glowing meshes");
    let albedo = 0.5;
    let floor = || {
        let mut scene = lit_floor(matte(albedo as f32), Light::default());
        scene.lights.clear();
        scene
    };
    // Every other square of 12 by 12, which shine down.
    let mut scene = floor();
    let material = scene.add_material(glowing(3.0, false)) as u32;
    let mut mesh = glimray::scene::Mesh::default();
    let mut squares = Vec::new();
    for x in 0..12_u16 {
        for z in (x % 2..12_u16).step_by(2) {
            let first = mesh.positions.len() as u32;
            for (i, j) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                let [x, z] = [x + i, z + j].map(|k| f32::from(k) / 12.0 - 0.5);
                mesh.positions.push(vec3(0.4 + 0.8 * x, 0.7, 0.8 * z - 1.2));
            }
            let own = &mesh.positions[first as usize..];
            squares.push(own.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
            mesh.triangles.push([first, first + 1, first + 2]);
            mesh.triangles.push([first, first + 2, first + 3]);
        }
    }
    mesh.normals = vec![Vec3::NEG_Y; mesh.positions.len()];
    mesh.materials = vec![material; mesh.positions.len()];
    scene.add_mesh(mesh, DAffine3::IDENTITY);
    let expected = mean_irradiance(&scene, |p| {
        let parts = squares.iter().map(|own| {
            let corners: Vec<_> = own.iter().map(|corner| corner - p).collect();
            lambert(&corners).abs()
        });
        3.0 * parts.sum::<f64>()
    });
    let found = mean_from(&scene, &paths(2048, (24, 16), 0), 2) * PI / albedo;
    near(&mut verdict, "squares", found, expected, 0.003 * expected);

    // A closed globe: of its triangles those count that face the point.
    let mut scene = floor();
    let material = scene.add_material(glowing(3.0, false)) as u32;
    let center = dvec3(1.4, 0.7, -0.8);
    let mesh = globe(0.4, 16, material);
    let triangles: Vec<[DVec3; 3]> = (mesh.triangles.iter())
        .map(|own| own.map(|i| mesh.positions[i as usize].as_dvec3() + center))
        .filter(|[a, b, c]| (b - a).cross(c - a).length() > 1e-9)
        .collect();
    scene.add_mesh(mesh, DAffine3::from_translation(center));
    let expected = mean_irradiance(&scene, |p| {
        let facing = triangles.iter().filter(|[a, b, c]| {
            let n = (*b - *a).cross(*c - *a);
            n.dot(*a - center).signum() * n.dot(p - *a) > 0.0
        });
        let parts = facing.map(|own| lambert(&own.map(|corner| corner - p)).abs());
        3.0 * parts.sum::<f64>()
    });
    let ball = mean_irradiance(&scene, |p| {
        let to = center - p;
        3.0 * PI * 0.16 * to.normalize().y / to.length_squared()
    });
    near(&mut verdict, "globe and ball", expected, ball, 0.03 * ball);
    let found = mean_from(&scene, &paths(2048, (24, 16), 0), 2) * PI / albedo;
    near(&mut verdict, "globe", found, expected, 0.003 * expected);
    verdict.close();
}

/// Any cut of a picture lit from the tree merges to the bytes of one run, however each part is divided into submissions.
#[test]
fn pictures_lit_from_a_tree_are_cut_and_merged_to_the_same_bytes() {
    let scene = mixed(20);
    let packed = pack::scene(&scene).expect("a scene that can be packed");
    let view = packed.frame(&scene.frame(0.0)).expect("a frame");
    assert!(view.has_light_tree() && !view.emitters.is_empty());
    let whole = paths(150, (19, 13), 3);
    let expected = film(&scene, &whole);
    assert_eq!(expected.missing(), []);
    let slicing = Slicing {
        tile_side: 8,
        max_groups: 3,
        max_samples: 5,
        ..Slicing::default()
    };
    assert!(bytes(&expected) == bytes(&film(&scene, &sliced(&whole, slicing))));
    let mut random = Random::new(12);
    let mut later_ranges = 0;
    for count in [3, 6] {
        let parts = cut(&whole, count, &mut random);
        let ranges = parts.iter().filter_map(|part| part.sample_range.as_ref());
        later_ranges += ranges.filter(|range| range.start > 0).count();
        let films = parts.iter().map(|part| film(&scene, part));
        let merged = merged(films.collect(), &mut random);
        assert!(bytes(&merged) == bytes(&expected), "{count} parts");
    }
    assert!(later_ranges > 0);
}
