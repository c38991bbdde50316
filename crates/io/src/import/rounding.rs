//! Notes where the arithmetic of the renderer, in f32, would lose light or change it.

use super::notes::Notes;
use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{LightKind, Material, Mesh, Scene, area_normal};

/// The sizes of scenes in which products of lengths are in the range of f32: areas of triangles and of lights, and squares
/// of distances.
const SIZES: [f64; 2] = [1e-9, 1e9];

/// The relative error of emitted light from which on it is noted.
const TOLERANCE: f64 = 0.05;

/// The part of their area, after an even scale, that squashed emissive triangles keep at most.
const SQUASHED: f64 = 1e-4;

/// Notes what rounding does to the light of a scene.
pub(super) fn note(scene: &mut Scene) {
    let mut notes = Notes::default();
    of_size(scene, &mut notes);
    of_slivers(scene, &mut notes);
    scene.skipped.extend(notes.into_lines());
}

fn of_size(scene: &Scene, notes: &mut Notes) {
    let Some((min, max)) = scene.bounds() else {
        return;
    };
    let size = min.distance(max);
    let is_flat =
        |kind: &LightKind| matches!(kind, LightKind::Rectangle { .. } | LightKind::Disc { .. });
    let has_areas = !scene.meshes.is_empty() || scene.lights.iter().any(|it| is_flat(&it.kind));
    let [least, most] = SIZES;
    let (is_far, limit) = match size < least {
        true => (size > 0.0, format!("below {least:e}")),
        false => (size > most && has_areas, format!("above {most:e}")),
    };
    if is_far {
        let why =
            "products of lengths leave the range of f32, and lights may turn dark or too bright";
        notes.add("sizes", || {
            format!("the scene measures {size:.1e} units; {limit} {why}. Scale it")
        });
    }
}

/// Emissive triangles lie where f32 allows it as seen from the camera, which changes the areas of thin ones.
fn of_slivers(scene: &Scene, notes: &mut Notes) {
    let emits: Vec<bool> = scene.materials.iter().map(is_emissive).collect();
    if !emits.contains(&true) || scene.cameras.is_empty() {
        return;
    }
    let rest = scene.frame(0.0);
    let origin = scene.render_origin_at(&rest);
    let moving = scene.moving_nodes();
    let mut copies = vec![0; scene.meshes.len()];
    scene.instances.iter().for_each(|it| copies[it.mesh] += 1);
    for instance in &scene.instances {
        let node = scene.node_of(instance);
        let is_seen = (instance.node).is_none_or(|node| !moving[node] && rest.nodes[node].visible);
        if !is_seen || scene.deformation_of(instance.mesh).is_some() {
            continue;
        }
        let mesh = &scene.meshes[instance.mesh];
        let above = node.map_or(DAffine3::IDENTITY, |node| rest.nodes[node].world_from_node);
        let world_from_object = above * instance.placement;
        let [own_area, true_area, area] = emissive_areas(mesh, &emits, world_from_object, origin);
        let matrix = world_from_object.matrix3;
        let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let most = axes
            .into_iter()
            .map(DVec3::length_squared)
            .fold(0.0, f64::max);
        if true_area < SQUASHED * most * own_area {
            notes.add("slivers", || {
                format!(
                    "emissive triangles of mesh `{}` are squashed by their transform to {:.0e} of their area and light. \
                     Scale them evenly",
                    mesh.name,
                    true_area / (most * own_area)
                )
            });
            continue;
        }
        // Others keep their shape in a space of their own.
        if copies[instance.mesh] == 1 && (area - true_area).abs() > TOLERANCE * true_area {
            notes.add("slivers", || {
                format!(
                    "emissive triangles of mesh `{}` are so thin for their distance from the camera that rounding gives \
                     them {:.2} times their area and light. Make them wider, or use a rectangle",
                    mesh.name,
                    area / true_area
                )
            });
        }
    }
}

/// The area of all emissive triangles in their own space, in the world, and as they are packed.
fn emissive_areas(
    mesh: &Mesh,
    emits: &[bool],
    world_from_object: DAffine3,
    origin: DVec3,
) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for triangle in &mesh.triangles {
        if !emits[mesh.materials[triangle[0] as usize] as usize] {
            continue;
        }
        let own = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
        let corners = own.map(|corner| world_from_object.transform_point3(corner) - origin);
        let rounded = corners.map(|corner| corner.as_vec3().as_dvec3());
        for (sum, [a, b, c]) in sums.iter_mut().zip([own, corners, rounded]) {
            *sum += (b - a).cross(c - a).length() / 2.0;
        }
    }
    sums
}

/// Notes the light of triangles that `Mesh::repair` will drop: those that have an area, but one that f32 cannot hold.
pub(super) fn note_lost_light(notes: &mut Notes, mesh: &Mesh, materials: &[Material]) {
    if !materials.iter().any(is_emissive) {
        return;
    }
    let is_lost = |triangle: &&[u32; 3]| {
        let material = mesh.materials[triangle[0] as usize] as usize;
        let [a, b, c] = triangle.map(|i| mesh.positions[i as usize].as_dvec3());
        materials.get(material).is_some_and(is_emissive)
            && area_normal(&mesh.positions, triangle).is_none()
            && (b - a).cross(c - a) != DVec3::ZERO
    };
    let count = mesh.triangles.iter().filter(is_lost).count();
    if count > 0 {
        notes.add("slivers", || {
            format!("emissive triangles too thin for f32, whose light is lost: {count}")
        });
    }
}

fn is_emissive(material: &Material) -> bool {
    material.radiance().0 != Vec3::ZERO
}
