//! Scenes built in code.

use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3, dvec3, vec3};
use glimray::scene::{
    Attenuation, Background, Camera, CanonicalShape, Fresnel, Geometry, Instance, Light, LightKind,
    Material, Mesh, Phong, Scene, Shape,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A camera, a grey material and a bluish background, without objects.
pub fn empty() -> Scene {
    Scene {
        cameras: vec![Camera {
            look_from: dvec3(0.0, 1.5, 6.0),
            look_at: dvec3(0.0, 0.3, 0.0),
            fov_y: 0.8,
            ..Camera::default()
        }],
        materials: vec![Material::default()],
        background: glimray::scene::Background::Color(vec3(0.2, 0.4, 0.6)),
        ambient: Vec3::splat(0.1),
        ..Scene::default()
    }
}

/// Three shiny spheres on a floor, a point light and a weaker directional one.
pub fn spheres() -> Scene {
    let mut scene = empty();
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    for (i, color) in [
        (-1, vec3(0.8, 0.2, 0.1)),
        (0, vec3(0.2, 0.7, 0.2)),
        (1, vec3(0.2, 0.3, 0.9)),
    ] {
        let material = scene.add_material(shiny(color));
        scene.add_sphere(
            dvec3(1.7 * f64::from(i), 0.8, 0.3 * f64::from(i)),
            0.8,
            material,
        );
    }
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.7);
    scene.lights.push(Light {
        kind: LightKind::Directional {
            direction: dvec3(0.6, -0.7, -0.4).normalize(),
        },
        color: vec3(0.2, 0.2, 0.3),
        attenuation: Attenuation::None,
        ..Light::default()
    });
    scene
}

/// A torus and a ball as meshes with smooth normals over a floor of two triangles.
pub fn meshes() -> Scene {
    let mut scene = empty();
    let red = scene.add_material(shiny(vec3(0.8, 0.3, 0.2)));
    let blue = scene.add_material(shiny(vec3(0.2, 0.4, 0.8)));
    scene.add_mesh(quad(8.0, 0), DAffine3::IDENTITY);
    scene.add_mesh(
        torus(1.0, 0.35, UVec2::new(36, 18), red as u32),
        DAffine3::from_translation(dvec3(-1.2, 1.0, 0.0)) * DAffine3::from_rotation_x(0.9),
    );
    scene.add_mesh(
        ball(UVec2::new(32, 16), blue as u32),
        DAffine3::from_translation(dvec3(1.5, 0.9, 0.2))
            * DAffine3::from_scale(dvec3(1.0, 0.8, 0.6)),
    );
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.6);
    scene.add_point_light(dvec3(-4.0, 3.0, 2.0), 0.3);
    scene
}

/// Every kind of surface and light at once: one-sided and two-sided, mixed materials, a mirrored
/// instance, a spot and inverse-square light.
pub fn everything() -> Scene {
    let mut scene = spheres();
    let first = scene.add_material(Material {
        bsdf: Phong {
            diffuse: vec3(0.9, 0.1, 0.1),
            specular: Vec3::splat(0.1),
            shininess: 2.0,
            ..shiny(Vec3::ONE).classical().into_owned()
        }
        .into(),
        ..shiny(Vec3::ONE)
    });
    scene.add_material(Material {
        bsdf: Phong {
            shininess: 80.0,
            ..shiny(vec3(0.1, 0.9, 0.1)).classical().into_owned()
        }
        .into(),
        ..shiny(vec3(0.1, 0.9, 0.1))
    });
    scene.add_material(shiny(vec3(0.1, 0.1, 0.9)));
    let mut panel = ball(UVec2::new(24, 12), 0);
    for (i, material) in panel.materials.iter_mut().enumerate() {
        *material = first as u32 + i as u32 % 3;
    }
    let mirrored = DAffine3::from_scale(dvec3(-0.7, 0.5, 0.5));
    scene.add_mesh(
        panel,
        DAffine3::from_translation(dvec3(0.2, 2.1, -1.0)) * mirrored,
    );
    let one_sided = scene.add_material(Material {
        two_sided: false,
        ..Material::default()
    });
    let wall =
        DAffine3::from_translation(dvec3(0.0, 0.0, -3.0)) * DAffine3::from_rotation_x(-PI / 2.0);
    scene.add_mesh(quad(6.0, one_sided as u32), wall);
    scene.add_plane(
        dvec3(-4.0, 0.0, 0.0),
        dvec3(1.0, 0.0, 0.2).normalize(),
        one_sided,
    );
    scene.lights.push(Light {
        kind: LightKind::Spot {
            position: dvec3(-2.0, 4.0, 3.0),
            direction: dvec3(0.4, -0.8, -0.6).normalize(),
            inner: 0.2,
            outer: 0.5,
        },
        color: Vec3::splat(12.0),
        attenuation: Attenuation::InverseSquare,
        ..Light::default()
    });
    scene
}

/// Mirrors, varnish, glass, nested glass, and a medium with a higher priority than its surroundings.
pub fn mirrors_and_glass() -> Scene {
    let mut scene = spheres();
    scene.shapes.truncate(1);
    scene.background = Background::Gradient {
        bottom: vec3(0.2, 0.15, 0.1),
        top: vec3(0.3, 0.5, 0.9),
    };
    let mut ball = |center: DVec3, radius: f64, material: Material| {
        let material = scene.add_material(material);
        scene.add_sphere(center, radius, material);
    };
    let glass = Material {
        bsdf: Phong {
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior: 1.5,
            absorption: vec3(0.4, 0.1, 0.2),
            fresnel: Fresnel::Exact,
            ..shiny(Vec3::ZERO).classical().into_owned()
        }
        .into(),
        ..shiny(Vec3::ZERO)
    };
    ball(dvec3(-1.6, 0.8, 0.3), 0.8, glass.clone());
    ball(
        dvec3(0.2, 0.9, -0.6),
        0.9,
        Material {
            bsdf: Phong {
                reflect: vec3(0.9, 0.7, 0.4),
                ..shiny(Vec3::splat(0.2)).classical().into_owned()
            }
            .into(),
            ..shiny(Vec3::splat(0.2))
        },
    );
    ball(
        dvec3(1.9, 0.7, 0.1),
        0.7,
        Material {
            bsdf: Phong {
                reflect: Vec3::ONE,
                ior: 1.6,
                fresnel: Fresnel::Schlick,
                ..shiny(vec3(0.7, 0.1, 0.1)).classical().into_owned()
            }
            .into(),
            ..shiny(vec3(0.7, 0.1, 0.1))
        },
    );
    // A bubble, a drop of another liquid, and a volume that overlaps with glass and has priority over it.
    ball(
        dvec3(-1.7, 0.9, 0.5),
        0.3,
        Material {
            bsdf: Phong {
                ior: 1.0,
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass.clone()
        },
    );
    ball(
        dvec3(0.4, 0.4, 1.1),
        0.4,
        Material {
            priority: -1,
            ..glass.clone()
        },
    );
    ball(
        dvec3(0.7, 0.4, 1.0),
        0.35,
        Material {
            bsdf: Phong {
                ior: 1.2,
                fresnel: Fresnel::None,
                reflect: Vec3::splat(0.2),
                transmit: vec3(0.3, 0.8, 0.6),
                opacity: 0.2,
                ..glass.classical().into_owned()
            }
            .into(),
            ..glass
        },
    );
    scene
}

/// Every canonical shape, rotated and scaled non-uniformly, over a floor.
pub fn solids() -> Scene {
    let mut scene = empty();
    scene.add_plane(dvec3(0.0, -0.2, 0.0), DVec3::Y, 0);
    let cone = |bottom, top, capped| CanonicalShape::Cone {
        bottom,
        top,
        capped,
    };
    let rows = [
        (CanonicalShape::Disc { hole: 0.0 }, [0.7, 0.2, 0.3]),
        (CanonicalShape::Disc { hole: 0.6 }, [0.8, 1.0, 0.5]),
        (CanonicalShape::Rectangle, [0.6, 1.0, 0.3]),
        (CanonicalShape::Box, [0.3, 0.5, 0.4]),
        (CanonicalShape::Ellipsoid, [0.6, 0.3, 0.4]),
        (CanonicalShape::Torus { minor: 0.3 }, [0.5, 0.7, 0.5]),
        (CanonicalShape::Torus { minor: 1.0 }, [0.3, 0.3, 0.2]),
        (cone(1.0, 1.0, true), [0.4, 0.8, 0.3]),
        (cone(1.0, 1.0, false), [0.4, 0.6, 0.4]),
        (cone(0.5, 0.0, true), [0.9, 0.9, -0.9]),
        (cone(0.2, 0.5, false), [1.0, 0.7, 1.0]),
        (cone(0.5, 0.2, true), [-1.0, 0.8, 1.0]),
    ];
    for (i, (canonical, scale)) in rows.into_iter().enumerate() {
        let (column, row) = ((i % 4) as f64, (i / 4) as f64);
        let hue = i as f64 * 2.4;
        let color = dvec3(hue.sin(), (hue + 2.1).sin(), (hue + 4.2).sin()) * 0.4 + 0.5;
        let material = scene.add_material(shiny(color.as_vec3()));
        let turn = DQuat::from_scaled_axis(dvec3(0.5 + 0.1 * column, 0.7 * column, 0.3 * row));
        let place = dvec3(1.5 * column - 2.2, 1.0 * row + 0.2, 0.6 - 0.8 * row);
        let world_from_canonical =
            DAffine3::from_scale_rotation_translation(DVec3::from(scale), turn, place);
        scene.shapes.push(Shape {
            geometry: Geometry::Placed {
                canonical,
                world_from_canonical,
            },
            material,
            node: None,
            name: String::new(),
        });
    }
    scene.add_sphere(dvec3(2.6, 0.6, 1.2), 0.3, 0);
    scene.add_point_light(dvec3(3.0, 5.0, 4.0), 0.6);
    scene.add_point_light(dvec3(-4.0, 3.0, 2.0), 0.3);
    scene
}

pub fn shiny(color: Vec3) -> Material {
    Material::from(Phong {
        diffuse: color * 0.8,
        specular: Vec3::splat(0.4),
        shininess: 30.0,
        ambient: color,
        ..Phong::default()
    })
}

/// Helpers for building scenes.
pub trait Build {
    fn add_material(&mut self, material: Material) -> usize;
    fn add_sphere(&mut self, center: DVec3, radius: f64, material: usize);
    fn add_plane(&mut self, point: DVec3, normal: DVec3, material: usize);
    fn add_mesh(&mut self, mesh: impl Into<Arc<Mesh>>, world_from_object: DAffine3);
    fn add_point_light(&mut self, position: DVec3, strength: f32);
}

impl Build for Scene {
    fn add_material(&mut self, material: Material) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }

    fn add_sphere(&mut self, center: DVec3, radius: f64, material: usize) {
        self.shapes.push(Shape {
            geometry: Geometry::Sphere { center, radius },
            material,
            node: None,
            name: String::new(),
        });
    }

    fn add_plane(&mut self, point: DVec3, normal: DVec3, material: usize) {
        self.shapes.push(Shape {
            geometry: Geometry::Plane { point, normal },
            material,
            node: None,
            name: String::new(),
        });
    }

    fn add_mesh(&mut self, mesh: impl Into<Arc<Mesh>>, world_from_object: DAffine3) {
        self.meshes.push(mesh.into());
        self.instances.push(Instance {
            mesh: self.meshes.len() - 1,
            placement: world_from_object,
            node: None,
            name: String::new(),
        });
    }

    fn add_point_light(&mut self, position: DVec3, strength: f32) {
        self.lights.push(Light {
            kind: LightKind::Point { position },
            color: Vec3::splat(strength),
            attenuation: Attenuation::None,
            ..Light::default()
        });
    }
}

/// A square of two triangles in the plane y = 0, `side` long, its normal up.
pub fn quad(side: f32, material: u32) -> Mesh {
    let h = side / 2.0;
    Mesh {
        positions: vec![
            vec3(-h, 0.0, h),
            vec3(h, 0.0, h),
            vec3(h, 0.0, -h),
            vec3(-h, 0.0, -h),
        ],
        normals: vec![Vec3::Y; 4],
        materials: vec![material; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// The unit sphere in `parts.x` by `parts.y` facets.
pub fn ball(parts: UVec2, material: u32) -> Mesh {
    lattice(parts, material, |u, v| {
        let (around, down) = (TAU * u, PI * v);
        let p = dvec3(
            around.sin() * down.sin(),
            down.cos(),
            around.cos() * down.sin(),
        );
        (p, p)
    })
}

/// A torus around the y axis.
pub fn torus(radius: f64, thickness: f64, parts: UVec2, material: u32) -> Mesh {
    lattice(parts, material, |u, v| {
        let outwards = dvec3((TAU * u).sin(), 0.0, (TAU * u).cos());
        let normal = outwards * (TAU * v).sin() + DVec3::Y * (TAU * v).cos();
        (outwards * radius + normal * thickness, normal)
    })
}

/// A height field over the square of this side, without its own normals.
pub fn height_field(
    side: f64,
    parts: u32,
    material: u32,
    height: impl Fn(f64, f64) -> f64,
) -> Mesh {
    let mut mesh = lattice(UVec2::splat(parts), material, |u, v| {
        let (x, z) = (side * (u - 0.5), side * (v - 0.5));
        (dvec3(x, height(x, z), z), DVec3::ZERO)
    });
    mesh.normals.clear();
    mesh.repair();
    mesh
}

/// A mesh over the unit square, with point and normal of each (u, v).
pub fn lattice(parts: UVec2, material: u32, at: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..=parts.y {
        for i in 0..=parts.x {
            let (u, v) = (
                f64::from(i) / f64::from(parts.x),
                f64::from(j) / f64::from(parts.y),
            );
            let (p, n) = at(u, v);
            mesh.positions.push(p.as_vec3());
            mesh.normals.push(n.as_vec3());
            mesh.materials.push(material);
            if i < parts.x && j < parts.y {
                let a = j * (parts.x + 1) + i;
                let b = a + parts.x + 1;
                mesh.triangles.extend([[a, b, a + 1], [a + 1, b, b + 1]]);
            }
        }
    }
    mesh.repair();
    mesh
}

/// Reproducible pseudo-random numbers (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..count.
    pub fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In the cube around the origin with this half side.
    pub fn within(&mut self, half: f64) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.between(-half, half)))
    }
}
