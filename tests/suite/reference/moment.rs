//! A moving scene frozen at one time: the same scene without tracks and nodes.

use glam::{DAffine3, DVec3};
use glimray::scene::{
    CanonicalShape, Geometry, LightKind, Material, NodeState, Phong, Scene, Shape,
};

/// The lookup transform of solid textures for a point in the world: patterns move with the node of their
/// object. `None` is the world itself.
#[derive(Default)]
pub struct Carriers {
    pub instances: Vec<Option<DAffine3>>,
    pub shapes: Vec<Option<DAffine3>>,
}

impl Carriers {
    /// For the shape or the instance with this index.
    pub fn pattern_place(list: &[Option<DAffine3>], index: usize, p: DVec3) -> DVec3 {
        let carrier = list.get(index).copied().flatten();
        carrier.map_or(p, |world_from_carrier| {
            world_from_carrier.inverse().transform_point3(p)
        })
    }
}

/// The scene at `time`. Hidden objects are removed; visible lamps become shapes too.
pub fn resolve(scene: &Scene, time: f64) -> (Scene, Carriers) {
    let frame = scene.frame(time);
    let moving = moving(scene);
    let state = |node: Option<usize>| {
        node.map_or(
            NodeState {
                world_from_node: DAffine3::IDENTITY,
                visible: true,
            },
            |node| frame.nodes[node],
        )
    };
    let carrier = |node: Option<usize>| {
        node.filter(|&node| moving[node])
            .map(|node| frame.nodes[node].world_from_node)
    };
    let mut still = scene.clone();
    let mut carriers = Carriers::default();
    still.shapes.clear();
    still.instances.clear();
    for shape in &scene.shapes {
        let state = state(shape.node);
        if !state.visible {
            continue;
        }
        let geometry = match shape.node {
            None => shape.geometry,
            Some(_) => carried(shape.geometry, state.world_from_node),
        };
        still.shapes.push(Shape {
            geometry,
            material: shape.material,
            node: None,
            name: String::new(),
        });
        carriers.shapes.push(carrier(shape.node));
    }
    for instance in &scene.instances {
        let state = state(instance.node);
        if state.visible {
            let mut instance = instance.clone();
            carriers.instances.push(carrier(instance.node));
            instance.placement = state.world_from_node * instance.placement;
            instance.node = None;
            still.instances.push(instance);
        }
    }
    if !frame.materials.is_empty() {
        still.materials.clone_from(&frame.materials);
    }
    for light in frame.lights.iter().filter(|light| light.visible) {
        let (geometry, radiance) = lamp(light.kind);
        still.materials.push(Material {
            emission: light.color * radiance as f32,
            two_sided: false,
            bsdf: Phong {
                diffuse: glam::Vec3::ZERO,
                ambient: glam::Vec3::ZERO,
                ..Phong::default()
            }
            .into(),
            ..Material::default()
        });
        still.shapes.push(Shape {
            geometry,
            material: still.materials.len() - 1,
            node: None,
            name: String::new(),
        });
    }
    still.lights.clone_from(&frame.lights);
    still.cameras = vec![frame.camera];
    still.camera_index = 0;
    still.nodes.clear();
    still.tracks.clear();
    (still, carriers)
}

/// Nodes that a track animates, and their descendants.
fn moving(scene: &Scene) -> Vec<bool> {
    use glimray::scene::Target;
    let driven = |index: usize| {
        let mut targets = scene.tracks.iter().flat_map(|track| &track.targets);
        targets.any(|target| matches!(target, Target::Node(node, _) if *node == index))
    };
    (0..scene.nodes.len())
        .map(|index| {
            let above = std::iter::successors(Some(index), |&node| scene.nodes[node].parent);
            above.into_iter().any(driven)
        })
        .collect()
}

fn carried(geometry: Geometry, world_from_node: DAffine3) -> Geometry {
    let (canonical, place) = match geometry {
        Geometry::Sphere { center, radius } => (
            CanonicalShape::Ellipsoid,
            DAffine3::from_translation(center) * DAffine3::from_scale(DVec3::splat(radius)),
        ),
        Geometry::Placed {
            canonical,
            world_from_canonical,
        } => (canonical, world_from_canonical),
        Geometry::Plane { .. } => unreachable!("planes stand still"),
    };
    Geometry::Placed {
        canonical,
        world_from_canonical: world_from_node * place,
    }
}

/// The surface of a lamp, its emitting normal, and its radiance for a colour of 1: a light of c at distance 1
/// along the normal has π c / A over the area A, and a sphere counts as its disc.
fn lamp(kind: LightKind) -> (Geometry, f64) {
    use std::f64::consts::PI;
    let flat = |canonical, u: DVec3, normal: DVec3, v: DVec3, center, area: f64| {
        let matrix = glam::DMat3::from_cols(u, normal, v);
        let world_from_canonical = DAffine3::from_mat3_translation(matrix, center);
        let geometry = Geometry::Placed {
            canonical,
            world_from_canonical,
        };
        (geometry, PI / area)
    };
    match kind {
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            let cross = edge_u.cross(edge_v);
            let normal = cross.normalize();
            flat(
                CanonicalShape::Rectangle,
                edge_u,
                normal,
                edge_v,
                center,
                4.0 * cross.length(),
            )
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            let u = normal.any_orthonormal_vector() * radius;
            let v = normal.cross(u);
            flat(
                CanonicalShape::Disc { hole: 0.0 },
                u,
                normal,
                v,
                center,
                PI * radius * radius,
            )
        }
        LightKind::Sphere { center, radius } => {
            (Geometry::Sphere { center, radius }, 1.0 / (radius * radius))
        }
        _ => unreachable!("it has no surface"),
    }
}
