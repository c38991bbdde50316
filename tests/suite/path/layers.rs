//! Layers of materials in path-traced pictures against formulas in f64: the glTF specification, dispersion, coats over
//! emission.

use super::materials::material;
use super::{glowing_square, lit_floor, looking, matte, mean, near, paths};
use crate::reference::scenes::{Build, quad};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec2, Vec3, dvec3, vec3};
use glimray::render::{BsdfModel, RenderSettings};
use glimray::scene::{
    Attenuation, Background, Instance, LayerTextures, Light, LightKind, Material, Mesh,
    MetallicRoughness, Minify, Pattern, Picture, Scene, Space, Texture, Wrap,
};
use std::f64::consts::PI;
use std::sync::Arc;

/// (1 - |cos|)^5.
fn fifth(cos: f64) -> f64 {
    (1.0 - cos.abs()).powi(5)
}

/// D V of the glTF specification, appendix B, for the cosines of h, v and l to the normal.
fn specular_brdf(roughness: f64, nh: f64, nv: f64, nl: f64) -> f64 {
    let a2 = roughness.powi(4);
    let d = a2 / (PI * (nh * nh * (a2 - 1.0) + 1.0).powi(2));
    let part = |cos: f64| 1.0 / (cos + (a2 + (1.0 - a2) * cos * cos).sqrt());
    d * part(nv) * part(nl)
}

/// The BRDF of the specification with KHR_materials_ior, specular and clearcoat, in green.
fn by_the_specification(model: &MetallicRoughness, v: DVec3, l: DVec3) -> f64 {
    let number = f64::from;
    let h = (v + l).normalize();
    let (nh, nv, nl, vh) = (h.y, v.y, l.y, v.dot(h));
    let base = number(model.base_color.y);
    let glossy = specular_brdf(number(model.roughness), nh, nv, nl);
    let metal = glossy * (base + (1.0 - base) * fifth(vh));
    let ior = number(model.ior);
    let f90 = number(model.specular);
    let f0 = ((1.0 - ior) / (1.0 + ior)).powi(2) * f90;
    let fresnel = f0 + (f90 - f0) * fifth(vh);
    let dielectric = (1.0 - fresnel) * base / PI + fresnel * glossy;
    let metallic = number(model.metallic);
    let below = (1.0 - metallic) * dielectric + metallic * metal;
    let coat = number(model.clearcoat) * (0.04 + 0.96 * fifth(nv));
    let over = specular_brdf(number(model.clearcoat_roughness), nh, nv, nl);
    (1.0 - coat) * below + coat * over
}

#[test]
fn the_specification_is_shown_to_the_letter() {
    let mut verdict = Verdict::on("--bsdf spec");
    let plain = MetallicRoughness {
        base_color: Vec3::splat(0.6),
        ..MetallicRoughness::default()
    };
    let mut full_differs = 0;
    for (metallic, roughness, clearcoat, ior) in [
        (0.0, 0.3, 0.0, 1.5),
        (1.0, 0.5, 0.0, 1.5),
        (0.0, 1.0, 0.0, 2.0),
        (1.0, 1.0, 0.0, 1.5),
        (0.4, 0.7, 0.0, 1.5),
        (0.0, 0.6, 1.0, 1.5),
        (1.0, 0.8, 0.5, 1.5),
    ] {
        let model = MetallicRoughness {
            metallic,
            roughness,
            clearcoat,
            clearcoat_roughness: 0.4,
            ior,
            specular: 0.9,
            ..plain.clone()
        };
        for (v, l) in [
            (dvec3(0.0, 1.0, 0.01), dvec3(0.6, 0.8, 0.0)),
            (dvec3(0.7, 0.5, 0.1), dvec3(-0.6, 0.6, 0.0)),
            (dvec3(0.9, 0.3, 0.2), dvec3(-0.9, 0.25, 0.1)),
        ] {
            let (v, l) = (v.normalize(), l.normalize());
            let light = Light {
                kind: LightKind::Directional { direction: -l },
                color: Vec3::ONE,
                attenuation: Attenuation::None,
                ..Light::default()
            };
            let mut scene = lit_floor(material(model.clone()), light);
            scene.cameras = vec![looking(5.0 * v, DVec3::ZERO, 1e-4)];
            let of = |bsdf| {
                let settings = RenderSettings {
                    bsdf,
                    ..paths(1, (2, 2), 0)
                };
                mean(&scene, &settings)
            };
            // A light of strength 1 gives the irradiance π.
            let expected = PI * l.y * by_the_specification(&model, v, l);
            let what = format!(
                "metallic {metallic}, roughness {roughness}, coat {clearcoat}, {v:.2}, {l:.2}"
            );
            near(
                &mut verdict,
                what,
                of(BsdfModel::Spec),
                expected,
                2e-3 * expected,
            );
            full_differs += usize::from((of(BsdfModel::Full) / expected - 1.0).abs() > 0.01);
        }
    }
    verdict.that("the full model differs", full_differs > 15, || full_differs);
    verdict.close();
}

/// A prism around the z axis with its edge upwards.
fn prism(material: Material) -> Scene {
    let corners = [(-1.0, 0.0), (1.0, 0.0), (0.0, 3.0)];
    let positions = [-2.0, 2.0].map(|z| corners.map(|(x, y)| vec3(x, y, z)));
    let triangles = vec![
        [0, 2, 1],
        [3, 4, 5],
        [0, 1, 4],
        [0, 4, 3],
        [1, 2, 5],
        [1, 5, 4],
        [2, 0, 3],
        [2, 3, 5],
    ];
    let mut mesh = Mesh {
        positions: positions.as_flattened().to_vec(),
        triangles,
        materials: vec![0; 6],
        ..Mesh::default()
    };
    // Flat faces: every triangle has corners of its own.
    mesh.positions = mesh
        .triangles
        .iter()
        .flatten()
        .map(|&i: &u32| mesh.positions[i as usize])
        .collect();
    mesh.triangles = (0..8).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    mesh.materials = vec![0; 24];
    mesh.normals = (0..8)
        .flat_map(|i| {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[3 * i + k]);
            [(b - a).cross(c - a).normalize(); 3]
        })
        .collect();
    Scene {
        cameras: vec![looking(dvec3(-10.0, 1.0, 0.0), dvec3(0.0, 1.0, 0.0), 1e-4)],
        materials: vec![material],
        background: Background::Gradient {
            bottom: Vec3::ZERO,
            top: Vec3::ONE,
        },
        meshes: vec![Arc::new(mesh)],
        instances: vec![Instance {
            mesh: 0,
            placement: DAffine3::IDENTITY,
            node: None,
            name: String::new(),
        }],
        ..Scene::default()
    }
}

/// The direction behind a boundary with normal `n` against `d`, and what passes: Snell and Fresnel.
fn bent(d: DVec3, n: DVec3, eta: f64) -> (DVec3, f64) {
    let cos_i = -d.dot(n);
    let cos_t = (1.0 - eta * eta * (1.0 - cos_i * cos_i)).sqrt();
    let s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    (
        eta * d + (eta * cos_i - cos_t) * n,
        1.0 - 0.5 * (s * s + p * p),
    )
}

fn channels(scene: &Scene, settings: &RenderSettings) -> [f64; 3] {
    let (image, _) = crate::reference::compare::render(scene, settings);
    let count = image.pixels.len() as f64;
    [0, 1, 2].map(|c| {
        image
            .pixels
            .iter()
            .map(|pixel| f64::from(pixel[c]))
            .sum::<f64>()
            / count
    })
}

/// Light that a prism bends shows a background that grows evenly with height: each channel that of its own wavelength.
#[test]
fn a_prism_bends_each_wavelength_by_its_own_index() {
    let mut verdict = Verdict::on("a prism");
    let glass = |dispersion: f32| {
        material(MetallicRoughness {
            metallic: 0.0,
            roughness: 0.0,
            transmission: 1.0,
            thickness: 1.0,
            // Without reflection there is one path.
            specular: 0.0,
            dispersion,
            ..MetallicRoughness::default()
        })
    };
    let [left, right] = [-1.0, 1.0].map(|side| dvec3(3.0 * side, 1.0, 0.0).normalize());
    let settings = paths(4096, (2, 2), 16);
    for dispersion in [0.5, 2.0] {
        let found = channels(&prism(glass(dispersion)), &settings);
        for (channel, wavelength) in [611.4_f64, 549.1, 464.2].into_iter().enumerate() {
            let abbe = 20.0 / f64::from(dispersion);
            let index = 1.5 + 0.5 / abbe * (523_655.0 / (wavelength * wavelength) - 1.5168);
            let (inside, entered) = bent(DVec3::X, left, 1.0 / index);
            let (outside, left_over) = bent(inside, -right, index);
            let expected = entered * left_over * 0.5 * (1.0 + outside.y);
            let what = format!("dispersion {dispersion}, {wavelength} nm");
            near(
                &mut verdict,
                what,
                found[channel],
                expected,
                2e-3 * expected,
            );
        }
        verdict.that("the channels differ", found[0] - found[2] > 0.003, || {
            format!("{found:?}")
        });
    }
    // The choice of a channel changes no mean: hardly any dispersion looks like none.
    let none = channels(&prism(glass(0.0)), &settings);
    let hardly = channels(&prism(glass(1e-6)), &settings);
    for channel in 0..3 {
        let what = format!("hardly any dispersion, channel {channel}");
        near(&mut verdict, what, hardly[channel], none[channel], 2e-3);
    }
    verdict.close();
}

/// A coat takes its part of the light that the surface below emits, for paths that hit it and for light samples.
#[test]
fn emission_below_a_coat_is_tinted_by_it() {
    let mut verdict = Verdict::on("a coated lamp over a floor");
    let size = 0.02;
    let placed = DAffine3::from_scale_rotation_translation(
        dvec3(size, 1.0, size),
        glam::DQuat::IDENTITY,
        dvec3(0.0, 1.0, 0.0),
    );
    let of = |coat: f32| {
        let mut scene = lit_floor(matte(0.5), Light::default());
        scene.lights.clear();
        glowing_square(&mut scene, placed, 1000.0);
        let last = scene.materials.len() - 1;
        let model = MetallicRoughness {
            base_color: Vec3::ZERO,
            metallic: 0.0,
            specular: 0.0,
            clearcoat: coat,
            clearcoat_roughness: 0.0,
            ..MetallicRoughness::default()
        };
        scene.materials[last].bsdf = model.into();
        let mut look = |from: DVec3, at: DVec3| {
            scene.cameras = vec![looking(from, at, 0.001)];
            mean(&scene, &paths(256, (2, 2), 0))
        };
        let below = look(dvec3(0.0, 0.5, 0.3), DVec3::ZERO);
        let lamp = look(dvec3(0.0, 0.5, 0.0), dvec3(0.0, 1.0, 0.0001));
        [below, lamp]
    };
    let (bare, coated) = (of(0.0), of(1.0));
    // E = L A / d², of which a matte surface reflects a/π.
    let expected = 0.5 / PI * 1000.0 * 4.0 * size * size;
    near(&mut verdict, "bare lamp", bare[1], 1000.0, 0.1);
    near(
        &mut verdict,
        "floor below it",
        bare[0],
        expected,
        0.004 * expected,
    );
    // Along the normal a coat of index 1.5 reflects 4 %.
    for (what, bare, coated) in [("floor", bare[0], coated[0]), ("lamp", bare[1], coated[1])] {
        near(&mut verdict, what, coated / bare, 0.96, 0.001);
    }
    verdict.close();
}

/// The value times the cosine of anisotropic microfacets of a white metal that scatter once, by the specification: the
/// distribution of Burley with separable Smith shadowing, in the frame of x and y.
fn anisotropic([x, y]: [f64; 2], v: DVec3, l: DVec3) -> f64 {
    let h = (v + l).normalize();
    let d = 1.0 / (PI * x * y * (h.x * h.x / (x * x) + h.y * h.y / (y * y) + h.z * h.z).powi(2));
    let lambda =
        |w: DVec3| ((w.x * w.x * x * x + w.y * w.y * y * y + w.z * w.z).sqrt() / w.z - 1.0) / 2.0;
    d / (4.0 * v.z * (1.0 + lambda(v)) * (1.0 + lambda(l)))
}

/// A square on the floor, whose u points along x and v along -z.
pub fn square() -> Mesh {
    let corners = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    Mesh {
        positions: corners.map(|(x, z)| vec3(x, 0.0, z)).to_vec(),
        normals: vec![Vec3::Y; 4],
        uvs: corners
            .map(|(x, z)| Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * z))
            .to_vec(),
        materials: vec![0; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// A square of brushed metal, seen and lit from many sides.
#[test]
fn brushed_metal_is_wider_along_its_direction() {
    let mut verdict = Verdict::on("brushed metal by the specification");
    for (strength, rotation) in [(0.6, 0.0), (1.0, 0.5), (0.8, -2.0)] {
        let model = MetallicRoughness {
            base_color: Vec3::ONE,
            roughness: 0.5,
            anisotropy: strength,
            anisotropy_rotation: rotation,
            ..MetallicRoughness::default()
        };
        for (v, l) in [
            (dvec3(0.1, 0.9, 0.2), dvec3(0.3, 0.8, 0.1)),
            (dvec3(0.5, 0.7, 0.1), dvec3(-0.2, 0.6, 0.4)),
            (dvec3(-0.3, 0.5, 0.6), dvec3(0.1, 0.7, -0.5)),
        ] {
            let (v, l) = (v.normalize(), l.normalize());
            let light = Light {
                kind: LightKind::Directional { direction: -l },
                color: Vec3::ONE,
                attenuation: Attenuation::None,
                ..Light::default()
            };
            let mut scene = lit_floor(material(model.clone()), light);
            scene.shapes.clear();
            scene.meshes.push(Arc::new(square()));
            scene.instances.push(Instance {
                mesh: 0,
                placement: DAffine3::IDENTITY,
                node: None,
                name: String::new(),
            });
            scene.complete_tangents();
            scene.cameras = vec![looking(3.0 * v, DVec3::new(0.05, 0.0, 0.02), 1e-4)];
            let settings = RenderSettings {
                bsdf: BsdfModel::Spec,
                ..paths(1, (2, 2), 0)
            };
            let found = mean(&scene, &settings);
            // The direction is turned from u towards v, counter-clockwise.
            let (sin, cos) = f64::from(rotation).sin_cos();
            let (x, y) = (dvec3(cos, 0.0, -sin), dvec3(-sin, 0.0, -cos));
            let seen = (3.0 * v - DVec3::new(0.05, 0.0, 0.02)).normalize();
            let turned = |w: DVec3| dvec3(w.dot(x), w.dot(y), w.y);
            let alpha = 0.25;
            let wide = alpha + (1.0 - alpha) * f64::from(strength).powi(2);
            let expected = PI * anisotropic([wide, alpha], turned(seen), turned(l)) * 1.0;
            near(
                &mut verdict,
                format!("strength {strength}, rotation {rotation}, {v:.2}, {l:.2}"),
                found,
                expected,
                3e-3 * expected,
            );
        }
    }
    verdict.close();
}

/// A floor of two triangles in the plane y = 0 whose u points along x and v against z, or its back after half a turn about x.
fn mapped_floor(own: Material, maps: [Option<Vec3>; 2], light: Light, is_back: bool) -> Scene {
    let mut scene = lit_floor(own, light);
    scene.shapes.clear();
    let material = &mut scene.materials[0];
    let mut layers = LayerTextures::default();
    for (map, slot) in
        (maps.into_iter()).zip([&mut material.textures.normal, &mut layers.clearcoat_normal])
    {
        *slot = None;
        let Some(normal) = map else { continue };
        let code = 0.5 * normal + Vec3::splat(0.5);
        let picture = scene.pictures.len();
        scene.pictures.push(Picture::opaque(2, 2, [code; 4]).into());
        *slot = Some(scene.textures.len());
        scene.textures.push(Texture {
            pattern: Pattern::Picture {
                picture,
                nearest: false,
                minify: Minify::default(),
                wrap: [Wrap::Repeat; 2],
            },
            space: Space::Uv,
            pattern_from_space: DAffine3::IDENTITY,
        });
    }
    material.metallic_roughness_mut().expect("a model").textures = layers;
    let mut floor = quad(2.0, 0);
    floor.uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        .map(Vec2::from)
        .into();
    let turn = if is_back { PI } else { 0.0 };
    scene.add_mesh(floor, DAffine3::from_rotation_x(turn));
    scene.complete_tangents();
    scene
}

/// A coat has the normal of its own map, or that of the mesh, whatever the map of the surface below says: seen over a
/// black body it reflects what the specification's coat does around that normal.
#[test]
fn a_coat_follows_its_own_normal_map_and_not_that_below() {
    let mut verdict = Verdict::on("coats with normal maps");
    // v points against z.
    let world = |n: Vec3| dvec3(n.x.into(), n.z.into(), f64::from(-n.y)).normalize();
    let tilted = vec3(0.3, 0.2, 0.0);
    let tilted = tilted.with_z((1.0 - tilted.length_squared()).sqrt());
    let other = vec3(-0.4, 0.1, 0.0);
    let other = other.with_z((1.0 - other.length_squared()).sqrt());
    let steep = vec3(-0.93, 0.0, 0.367);
    let (v, l) = (
        dvec3(0.2, 0.9, 0.3).normalize(),
        dvec3(0.4, 0.8, -0.5).normalize(),
    );
    assert!(world(steep).dot(l) < -0.05 && world(steep).dot(v) > 0.1);
    let light = Light {
        kind: LightKind::Directional { direction: -l },
        color: Vec3::ONE,
        attenuation: Attenuation::None,
        ..Light::default()
    };
    for (name, maps, scale, is_back) in [
        ("no map", [None, None], 1.0, false),
        ("a map", [None, Some(tilted)], 1.0, false),
        ("a map below", [Some(other), None], 1.0, false),
        ("both", [Some(other), Some(tilted)], 1.0, false),
        ("half of the tilt", [Some(other), Some(tilted)], 0.5, false),
        // The light is behind the normal of the surface below.
        ("a steep map below", [Some(steep), None], 1.0, false),
        (
            "a steep map below a map",
            [Some(steep), Some(tilted)],
            1.0,
            false,
        ),
        ("the back of both", [Some(other), Some(tilted)], 1.0, true),
    ] {
        let own = maps[1].map_or(Vec3::Z, |n| vec3(scale * n.x, scale * n.y, n.z));
        let mut n = world(own);
        // Half a turn about x, and then towards the viewer.
        n.x *= if is_back { -1.0 } else { 1.0 };
        let coat = MetallicRoughness {
            base_color: Vec3::ZERO,
            metallic: 0.0,
            specular: 0.0,
            clearcoat: 0.8,
            clearcoat_roughness: 0.6,
            clearcoat_normal_scale: scale,
            ..MetallicRoughness::default()
        };
        let mut scene = mapped_floor(material(coat), maps, light.clone(), is_back);
        scene.cameras = vec![looking(5.0 * v, DVec3::ZERO, 1e-4)];
        let settings = RenderSettings {
            bsdf: BsdfModel::Spec,
            ..paths(1, (2, 2), 0)
        };
        let found = mean(&scene, &settings);
        let h = (v + l).normalize();
        let fresnel = 0.8 * (0.04 + 0.96 * fifth(n.dot(v)));
        let lobe = specular_brdf(0.6, n.dot(h), n.dot(v), n.dot(l));
        let expected = PI * n.dot(l) * fresnel * lobe;
        near(&mut verdict, name, found, expected, 2e-3 * expected);
        // Lamps so far away that they shine in one direction, chosen from a tree.
        let lamp = Light {
            kind: LightKind::Point { position: 1e4 * l },
            color: Vec3::splat(1e8 / 8.0),
            attenuation: Attenuation::InverseSquare,
            ..light.clone()
        };
        scene.lights = vec![lamp; 8];
        let found = mean(&scene, &settings);
        let what = format!("{name}, lamps");
        near(&mut verdict, what, found, expected, 2e-3 * expected);
        // Samples of its lobe find as much of even light as the integral over the directions above the floor.
        scene.lights.clear();
        scene.background = Background::Color(Vec3::ONE);
        let settings = RenderSettings {
            bsdf: BsdfModel::Spec,
            ..paths(4096, (4, 4), 0)
        };
        let found = mean(&scene, &settings);
        let steps = 400;
        let part = |k: i32| (f64::from(k) + 0.5) / f64::from(steps);
        let mut sum = 0.0;
        for (a, b) in (0..steps).flat_map(|a| (0..steps).map(move |b| (part(a), part(b)))) {
            let (sin, cos) = (2.0 * PI * b).sin_cos();
            let across = (1.0 - a * a).sqrt();
            let l = dvec3(across * cos, a, across * sin);
            let h = (v + l).normalize();
            if n.dot(l) > 0.0 {
                sum += n.dot(l) * fresnel * specular_brdf(0.6, n.dot(h), n.dot(v), n.dot(l));
            }
        }
        let expected = 2.0 * PI * sum / f64::from(steps * steps);
        near(
            &mut verdict,
            format!("{name}, even light"),
            found,
            expected,
            0.01 * expected,
        );
    }
    verdict.close();
}
