//! Random scenes.

use crate::support::random::Random;
use glam::Vec4;
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3};
use glimray::scene::*;
use std::sync::Arc;

fn vector(random: &mut Random) -> DVec3 {
    let mut axis = || match random.below(4) {
        0 => random.below(5) as f64 - 2.0,
        1 => (random.between(-9.0, 9.0) * 10.0).round() / 10.0,
        _ => random.between(-9.0, 9.0),
    };
    let vector = DVec3::new(axis(), axis(), axis());
    // Zeros without a sign; matrices cover negative zeros.
    vector + 0.0
}

fn direction(random: &mut Random) -> DVec3 {
    vector(random).normalize_or(DVec3::X)
}

fn color(random: &mut Random) -> Vec3 {
    let mut channel = || match random.below(4) {
        0 => random.below(3) as f32,
        1 => linear_from_srgb(random.below(256) as f64 / 255.0) as f32,
        _ => random.between(0.0, 3.0) as f32,
    };
    Vec3::new(channel(), channel(), channel())
}

fn angle(random: &mut Random) -> f64 {
    match random.below(2) {
        0 => (random.below(360) as f64 - 180.0).to_radians(),
        _ => random.between(-7.0, 7.0),
    }
}

fn turn(random: &mut Random) -> DQuat {
    match random.below(3) {
        0 => DQuat::IDENTITY,
        1 => rotation(DVec3::new(0.0, 10.0 * random.below(36) as f64, 0.0)),
        _ => DQuat::from_axis_angle(direction(random), angle(random)),
    }
}

fn scale(random: &mut Random) -> DVec3 {
    match random.below(3) {
        0 => DVec3::ONE,
        1 => DVec3::splat(random.between(0.1, 4.0)),
        _ => vector(random).map_or_one(),
    }
}

trait NotZero {
    fn map_or_one(self) -> Self;
}

impl NotZero for DVec3 {
    /// No component is 0.
    fn map_or_one(self) -> Self {
        Self::from(self.to_array().map(|x| if x == 0.0 { 1.0 } else { x }))
    }
}

fn placement(random: &mut Random) -> DAffine3 {
    let affine =
        DAffine3::from_scale_rotation_translation(scale(random), turn(random), vector(random));
    match random.below(4) {
        0 => DAffine3::IDENTITY,
        1 => DAffine3::from_translation(vector(random)),
        // Slanted.
        2 => {
            let slant = DMat3::from_cols(DVec3::X, DVec3::new(0.3, 1.0, 0.0), DVec3::Z);
            DAffine3::from_mat3(slant) * affine
        }
        _ => affine,
    }
}

/// A random index below `count`, or `None`.
fn maybe(random: &mut Random, count: usize) -> Option<usize> {
    let index = random.below(2 * count + 1);
    (index < count).then_some(index)
}

fn pick<T: Copy>(random: &mut Random, all: &[T]) -> T {
    all[random.below(all.len())]
}

fn material(random: &mut Random, textures: usize) -> Material {
    let mut material = Material {
        two_sided: random.below(2) == 0,
        two_sided_emission: random.below(2) == 0,
        bsdf: Phong {
            diffuse: color(random),
            specular: color(random),
            shininess: random.between(0.0, 200.0) as f32,
            ambient: color(random),
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    };
    if random.below(3) == 0 {
        material.classical_mut().ambient = material.classical().diffuse;
    }
    if random.below(3) == 0 {
        material.emission = color(random);
    }
    if random.below(2) == 0 {
        material.classical_mut().reflect = color(random);
    }
    if random.below(2) == 0 {
        material.classical_mut().transmit = color(random);
        material.classical_mut().opacity = random.between(0.0, 1.0) as f32;
        material.classical_mut().ior = random.between(0.5, 3.0) as f32;
        material.classical_mut().absorption = color(random);
        material.priority = random.below(9) as i32 - 4;
    }
    if random.below(3) == 0 {
        // As glass is.
        let amount = random.between(0.0, 1.0) as f32;
        material.classical_mut().reflect = Vec3::splat(amount);
        material.classical_mut().transmit = amount * color(random);
        material.classical_mut().opacity = 1.0 - amount;
    }
    material.thin = random.below(4) == 0;
    material.classical_mut().fresnel =
        pick(random, &[Fresnel::None, Fresnel::Exact, Fresnel::Schlick]);
    material.classical_mut().mixing = pick(
        random,
        &[Mixing::Layer, Mixing::Layer, Mixing::Sum, Mixing::Blend],
    );
    if textures > 0 {
        let mut slot = || maybe(random, textures);
        material.classical_mut().textures = PhongTextures {
            diffuse: slot(),
            specular: slot(),
            ambient: slot(),
            reflect: slot(),
            transmit: slot(),
        };
        material.textures = Textures {
            emission: slot(),
            normal: None,
            occlusion: None,
            alpha: slot(),
        };
        material.coverage = match random.below(3) {
            0 => Coverage::Opaque,
            1 => Coverage::Mask(random.between(0.0, 1.0) as f32),
            _ => Coverage::Blend,
        };
        if material.coverage == Coverage::Opaque {
            material.textures.alpha = None;
        } else {
            material.alpha = random.between(0.0, 1.0) as f32;
        }
    }
    if random.below(2) == 0 {
        physical(random, &mut material, textures);
    }
    material
}

fn fraction(random: &mut Random) -> f32 {
    match random.below(3) {
        0 => random.below(2) as f32,
        _ => random.between(0.0, 1.0) as f32,
    }
}

/// Gives `material` a metallic-roughness model, which its classical colours may or may not show. Of `textures`, the
/// first two are pictures or have values up to 1.
fn physical(random: &mut Random, material: &mut Material, textures: usize) {
    let tint = |random: &mut Random| Vec3::from([0; 3].map(|_| fraction(random)));
    let unlit = random.below(4) == 0;
    let mut model = MetallicRoughness {
        base_color: tint(random),
        metallic: fraction(random),
        roughness: fraction(random),
        unlit,
        ior: pick(random, &[1.0, 1.5, 1.33, 1e6]),
        specular: fraction(random),
        specular_color: color(random),
        transmission: fraction(random),
        thickness: random.between(0.0, 2.0) as f32,
        attenuation_color: tint(random),
        attenuation_distance: pick(random, &[f32::INFINITY, 0.1, 7.0]),
        clearcoat: fraction(random),
        clearcoat_roughness: fraction(random),
        clearcoat_normal_scale: 1.0,
        sheen_color: tint(random),
        sheen_roughness: fraction(random),
        anisotropy: fraction(random),
        anisotropy_rotation: random.between(-7.0, 7.0) as f32,
        iridescence: fraction(random),
        iridescence_ior: random.between(1.0, 2.0) as f32,
        iridescence_thickness: [random.between(0.0, 200.0), 400.0].map(|x| x as f32),
        dispersion: random.between(0.0, 1.0) as f32,
        diffuse_transmission: fraction(random),
        diffuse_transmission_color: tint(random),
        textures: LayerTextures::default(),
        phong: None,
    };
    if textures > 0 {
        // The last texture is a picture.
        let picture = textures - 1;
        let mut slot = || (random.below(3) == 0).then_some(picture);
        model.textures = LayerTextures {
            base_color: slot(),
            metallic: slot(),
            roughness: slot(),
            transmission: slot(),
            specular: slot(),
            specular_color: slot(),
            clearcoat: slot(),
            clearcoat_roughness: slot(),
            clearcoat_normal: slot(),
            sheen_color: slot(),
            sheen_roughness: slot(),
            anisotropy: slot(),
            iridescence: slot(),
            iridescence_thickness: slot(),
            diffuse_transmission: slot(),
            diffuse_transmission_color: slot(),
        };
        if model.textures.clearcoat_normal.is_some() {
            model.clearcoat_normal_scale = 0.75;
        }
    }
    let tint = if random.below(2) == 0 {
        Vec3::ONE
    } else {
        tint(random)
    };
    let phong = material.classical().into_owned();
    material.bsdf = model.into();
    material.tint = tint;
    if random.below(2) == 0 {
        // As importers without further colours make it.
        material.thin = false;
        if unlit {
            material.emission = Vec3::ZERO;
        }
        material.textures.emission = None;
    } else {
        material.set_classical(phong);
    }
}

fn texture(random: &mut Random, pictures: usize) -> Texture {
    let (a, b) = (color(random), color(random));
    let pattern = match random.below(5) {
        0 => Pattern::Checker { a, b },
        1 => Pattern::Stripes { a, b },
        2 => Pattern::Gradient { a, b },
        3 => Pattern::Noise {
            a,
            b,
            octaves: 1 + random.below(16) as u32,
        },
        _ => Pattern::Picture {
            picture: random.below(pictures),
            nearest: random.below(2) == 0,
            minify: pick(random, &Minify::ALL),
            wrap: [wrap(random), wrap(random)],
        },
    };
    Texture {
        pattern,
        space: pick(random, &[Space::World, Space::Uv, Space::SecondUv]),
        pattern_from_space: placement(random),
    }
}

fn picture(random: &mut Random) -> Picture {
    let (width, height) = (1 + random.below(5) as u32, 1 + random.below(5) as u32);
    let count = width * height;
    let kind = random.below(3);
    let mut bytes = || {
        (0..count)
            .map(|_| [0; 4].map(|_| random.below(256) as u8))
            .collect()
    };
    let texels = match kind {
        0 => Texels::Srgb8(bytes()),
        1 => Texels::Linear8(bytes()),
        _ => {
            let texel = |_| color(random).extend(random.below(65) as f32 / 64.0);
            Texels::Float((0..count).map(texel).collect())
        }
    };
    Picture {
        width,
        height,
        texels,
        origin: glimray::scene::Origin::Texels,
    }
}

fn wrap(random: &mut Random) -> Wrap {
    pick(random, &[Wrap::Repeat, Wrap::Clamp, Wrap::Mirror])
}

fn mesh(random: &mut Random, materials: usize) -> Mesh {
    let count = 3 * (1 + random.below(20));
    let mut mesh = Mesh {
        positions: (0..count).map(|_| vector(random).as_vec3()).collect(),
        normals: (0..count).map(|_| direction(random).as_vec3()).collect(),
        materials: (0..count).map(|_| random.below(materials) as u32).collect(),
        triangles: (0..count as u32 / 3)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect(),
        ..Mesh::default()
    };
    if random.below(2) == 0 {
        let mut place = || random.between(-3.0, 3.0) as f32;
        let mut set = || (0..count).map(|_| Vec2::new(place(), place())).collect();
        mesh.uvs = set();
        if count.is_multiple_of(2) {
            mesh.second_uvs = set();
        }
    }
    if random.below(2) == 0 {
        let hand = |random: &mut Random| pick(random, &[1.0, -1.0]);
        let mut tangent = || direction(random).as_vec3().extend(hand(random));
        mesh.tangents = (0..count).map(|_| tangent()).collect();
    }
    if random.below(2) == 0 {
        let mut part = || random.between(0.0, 3.0) as f32;
        let mut color = || Vec4::from([0; 4].map(|_| part()));
        mesh.colors = (0..count).map(|_| color()).collect();
    }
    if random.below(2) == 0 {
        mesh.materials.fill(0);
    }
    mesh.repair();
    mesh
}

fn geometry(random: &mut Random) -> Geometry {
    let canonical = match random.below(8) {
        0 => {
            return Geometry::Sphere {
                center: vector(random),
                radius: random.between(0.1, 3.0),
            };
        }
        1 => CanonicalShape::Disc {
            hole: pick(random, &[0.0, 0.5, 0.123_456_789]),
        },
        2 => CanonicalShape::Rectangle,
        3 => CanonicalShape::Box,
        4 => CanonicalShape::Cone {
            bottom: 1.0,
            top: pick(random, &[1.0, 0.0, 0.3]),
            capped: random.below(2) == 0,
        },
        5 => CanonicalShape::Cone {
            bottom: random.between(0.0, 1.0),
            top: 1.0,
            capped: random.below(2) == 0,
        },
        6 => CanonicalShape::Torus {
            minor: random.between(0.01, 1.0),
        },
        _ => CanonicalShape::Ellipsoid,
    };
    Geometry::Placed {
        canonical,
        world_from_canonical: placement(random),
    }
}

fn light(random: &mut Random, nodes: usize) -> Light {
    let kind = match random.below(6) {
        0 => LightKind::Point {
            position: vector(random),
        },
        1 => LightKind::Directional {
            direction: direction(random),
        },
        2 => {
            let outer = angle(random).abs().clamp(0.01, 1.5);
            LightKind::Spot {
                position: vector(random),
                direction: direction(random),
                inner: outer * pick(random, &[0.0, 0.5, 1.0]),
                outer,
            }
        }
        3 => {
            let edge_u = direction(random);
            LightKind::Rectangle {
                center: vector(random),
                edge_u: 0.3 * edge_u,
                edge_v: 1.7 * edge_u.any_orthonormal_vector(),
            }
        }
        4 => LightKind::Disc {
            center: vector(random),
            normal: direction(random),
            radius: random.between(0.1, 2.0),
        },
        _ => LightKind::Sphere {
            center: vector(random),
            radius: random.between(0.1, 2.0),
        },
    };
    let has_extent = kind.radiance().is_some();
    let fades = !matches!(kind, LightKind::Directional { .. }) && random.below(2) == 0;
    Light {
        kind,
        color: color(random),
        attenuation: if fades {
            Attenuation::InverseSquare
        } else {
            Attenuation::None
        },
        samples: if has_extent {
            1 + random.below(30) as u32
        } else {
            1
        },
        visible: has_extent && random.below(2) == 0,
        node: maybe(random, nodes),
        name: pick(random, &["", "lamp", "lamp"]).to_owned(),
    }
}

fn track(random: &mut Random, scene: &Scene) -> Track {
    let node = random.below(scene.nodes.len());
    let (target, kind) = match random.below(6) {
        0 => (Target::Node(node, NodeProperty::Translation), 0),
        1 => (Target::Node(node, NodeProperty::Angles), 1),
        2 => (Target::Node(node, NodeProperty::Rotation), 2),
        3 => (Target::Node(node, NodeProperty::Visible), 3),
        4 => (
            Target::Camera(random.below(scene.cameras.len()), CameraProperty::FovY),
            4,
        ),
        _ => {
            let property = pick(
                random,
                &[MaterialProperty::Diffuse, MaterialProperty::Ambient],
            );
            (
                Target::Material(random.below(scene.materials.len()), property),
                5,
            )
        }
    };
    let count = 1 + random.below(4);
    let interpolation = match kind {
        3 => Interpolation::Step,
        _ => pick(
            random,
            &[
                Interpolation::Step,
                Interpolation::Linear,
                Interpolation::CatmullRom,
                Interpolation::Hermite,
            ],
        ),
    };
    let is_hermite = interpolation == Interpolation::Hermite;
    let each = if is_hermite { 3 } else { 1 };
    let values = match kind {
        0 => Values::Vector((0..each * count).map(|_| vector(random)).collect()),
        1 => {
            let mut angles = || DVec3::new(angle(random), 0.0, angle(random));
            Values::Vector((0..each * count).map(|_| angles()).collect())
        }
        2 => Values::Rotation((0..each * count).map(|_| turn(random)).collect()),
        3 => Values::Scalar((0..count).map(|_| random.below(2) as f64).collect()),
        4 => Values::Scalar(
            (0..each * count)
                .map(|_| random.between(0.2, 2.0))
                .collect(),
        ),
        _ => Values::Vector(
            (0..each * count)
                .map(|_| color(random).as_dvec3())
                .collect(),
        ),
    };
    let easing = match interpolation {
        Interpolation::Linear => pick(
            random,
            &[
                Easing::None,
                Easing::IN,
                Easing::Bezier([0.1, -0.3, 0.7, 1.9]),
            ],
        ),
        _ => Easing::None,
    };
    Track {
        targets: vec![target],
        curve: Curve {
            times: (0..count)
                .map(|i| i as f64 + random.between(0.0, 0.9))
                .collect(),
            values,
            interpolation,
            easing,
            beyond: pick(random, &[Beyond::Hold, Beyond::Repeat, Beyond::PingPong]),
        },
    }
}

pub fn scene(random: &mut Random) -> Scene {
    let pictures: Vec<_> = (0..2).map(|_| Arc::new(picture(random))).collect();
    let mut textures: Vec<_> = (0..4).map(|_| texture(random, pictures.len())).collect();
    while !matches!(textures[3].pattern, Pattern::Picture { .. }) {
        textures[3] = texture(random, pictures.len());
    }
    let materials: Vec<_> = (0..6).map(|_| material(random, textures.len())).collect();
    let mut scene = Scene {
        pictures,
        textures,
        materials,
        ambient: color(random),
        background: Background::Gradient {
            bottom: color(random),
            top: color(random),
        },
        staged: random.below(2) == 0,
        shadows: pick(random, &[Shadows::Opaque, Shadows::Filtered]),
        ..Scene::default()
    };
    // In the order in which textures show them.
    let shown = scene
        .textures
        .iter()
        .filter_map(|texture| match texture.pattern {
            Pattern::Picture { picture, .. } => Some(picture),
            _ => None,
        });
    if shown.clone().next() == Some(1) || shown.collect::<Vec<_>>().is_empty() {
        for texture in &mut scene.textures {
            if let Pattern::Picture { picture, .. } = &mut texture.pattern {
                *picture = 0;
            }
        }
    }
    let used = scene
        .textures
        .iter()
        .filter_map(|texture| match texture.pattern {
            Pattern::Picture { picture, .. } => Some(picture + 1),
            _ => None,
        });
    let used = used.max().unwrap_or(0);
    scene.pictures.truncate(used);
    for index in 0..5 {
        scene.nodes.push(Node {
            name: pick(random, &["", "arm", "leg", "node 2"]).to_owned(),
            parent: maybe(random, index),
            placement: placement(random),
            translation: vector(random),
            rotation: turn(random),
            scale: scale(random),
            visible: random.below(4) > 0,
        });
    }
    let count = scene.materials.len();
    scene.meshes = (0..3).map(|_| Arc::new(mesh(random, count))).collect();
    for _ in 0..8 {
        scene.instances.push(Instance {
            mesh: random.below(3),
            placement: placement(random),
            node: maybe(random, 5),
            name: pick(random, &["", "ball", "arm", "node 2"]).to_owned(),
        });
        let geometry = geometry(random);
        scene.shapes.push(Shape {
            geometry,
            material: random.below(count),
            node: maybe(random, 5),
            name: pick(random, &["", "ball", "arm", "sphere 7"]).to_owned(),
        });
    }
    scene.shapes.push(Shape {
        geometry: Geometry::Plane {
            point: vector(random),
            normal: direction(random),
        },
        material: 0,
        node: None,
        name: String::new(),
    });
    scene.lights = (0..4).map(|_| light(random, 5)).collect();
    for name in ["", "b", "b"] {
        let lens = Lens {
            radius: random.between(0.01, 0.2),
            focus_distance: random.between(1.0, 9.0),
            blade_count: pick(random, &[0, 5]),
            blade_rotation: angle(random),
        };
        let node = maybe(random, 5);
        scene.cameras.push(Camera {
            name: name.to_owned(),
            look_from: vector(random),
            look_at: vector(random) + DVec3::new(0.0, 0.0, -40.0),
            up: direction(random) + DVec3::new(0.0, 5.0, 0.0),
            fov_y: random.between(0.1, 3.0),
            orthographic_height: (name == "b").then_some(lens.focus_distance),
            lens: (random.below(2) == 0).then_some(lens),
            clip: match random.below(2) {
                0 => Camera::UNCLIPPED,
                _ => (random.between(0.0, 3.0), random.between(4.0, 90.0)),
            },
            node,
            target: None,
        });
    }
    scene.camera_index = random.below(3);
    let mut driven = Vec::new();
    for _ in 0..5 {
        let track = track(random, &scene);
        // Both properties rotate a node, so only one of them is animated.
        let slot = format!("{:?}", track.targets).replace("Angles", "Rotation");
        if !driven.contains(&slot) {
            driven.push(slot);
            scene.tracks.push(track);
        }
    }
    scene.output.exposure_ev = random.between(-2.0, 2.0) as f32;
    scene.output.shutter.close = random.between(0.0, 1.0);
    scene.complete_tangents();
    scene
}
