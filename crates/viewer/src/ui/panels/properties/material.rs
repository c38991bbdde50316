//! The properties of a material.

use crate::model::objects;
use crate::model::objects::Id;
use crate::state::session::Session;
use crate::ui::panels::icon;
use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;
use glimray_scene::{
    Fresnel, Material, MaterialProperty, Mixing, ObjectRef, Pattern, Scene, Target, Textures,
};

/// The option that links the ambient colour to the diffuse colour.
const FOLLOWS: &str = "Ambient follows diffuse";

/// Draws all properties of a material.
pub fn show(fields: &mut Fields, index: usize) {
    let scene = fields.scene;
    let material = &scene.materials[index];
    local_shading(fields, index, material);
    mirror_and_glass(fields, index, material);
    textures(fields, index, &material.textures);
}

/// A change of a material.
fn with<T>(index: usize, change: fn(&mut Material, T)) -> impl FnOnce(&mut Scene, T) {
    move |scene, to| change(&mut scene.materials[index], to)
}

fn local_shading(fields: &mut Fields, index: usize, material: &Material) {
    use MaterialProperty as P;
    fields.heading("Local shading");
    let tip = "Diffuse reflection coefficient (k_d).";
    let is_same = material.ambient == material.diffuse;
    let follows = is_same && fields.option_value(FOLLOWS, true);
    let set = match follows {
        true => |material: &mut Material, to: Vec3| {
            (material.diffuse, material.ambient) = (to, to);
        },
        false => |material: &mut Material, to: Vec3| material.diffuse = to,
    };
    fields.driven_by(Target::Material(index, P::Diffuse)).color(
        ("Diffuse", tip),
        material.diffuse,
        with(index, set),
    );
    let tip = "Specular reflection coefficient (k_s).";
    color(fields, index, ("Specular", tip), P::Specular, |m| {
        &mut m.specular
    });
    if !follows {
        let tip = "Factor on the scene's ambient light.";
        color(fields, index, ("Ambient", tip), P::Ambient, |m| {
            &mut m.ambient
        });
    }
    let tip = "Set the ambient colour together with the diffuse colour.";
    if fields.option((FOLLOWS, tip), follows) == Some(true) {
        fields.change("ambient", move |scene| {
            let material = &mut scene.materials[index];
            material.ambient = material.diffuse;
            Ok(())
        });
    }
    let tip = "Radiance emitted by the surface.";
    color(fields, index, ("Emission", tip), P::Emission, |m| {
        &mut m.emission
    });
    let tip = "Phong exponent of the highlight, 0 or more. Larger values are sharper.";
    let label = ("Shininess", tip);
    number(fields, index, label, Limits::AMOUNT, P::Shininess, |m| {
        &mut m.shininess
    });
    let tip = "Shade both sides. Otherwise the back shows ambient light only.";
    let set = with(index, |material, to| material.two_sided = to);
    fields.toggle(("Two-sided", tip), material.two_sided, set);
    let tip = "Emit on both sides of a two-sided surface. Otherwise its back emits nothing.";
    let set = with(index, |material, to| material.two_sided_emission = to);
    let label = ("Two-sided emission", tip);
    fields.toggle(label, material.two_sided_emission, set);
}

fn mirror_and_glass(fields: &mut Fields, index: usize, material: &Material) {
    use MaterialProperty as P;
    fields.heading("Mirror and glass");
    let tip = "Fraction of light that is reflected; with Fresnel, at grazing angles.";
    color(fields, index, ("Reflect", tip), P::Reflect, |m| {
        &mut m.reflect
    });
    let tip = "Fraction of light that is transmitted.";
    color(fields, index, ("Transmit", tip), P::Transmit, |m| {
        &mut m.transmit
    });
    let tip = "Absorption coefficient: transmittance is exp(−absorption · length).";
    color(fields, index, ("Absorption", tip), P::Absorption, |m| {
        &mut m.absorption
    });
    let tip = "Index of refraction, from 0.01 to 100: water 1.33, glass 1.5, diamond 2.42.";
    let limits = Limits::between(0.01, 100.0);
    number(fields, index, ("Index (ior)", tip), limits, P::Ior, |m| {
        &mut m.ior
    });
    let tip = "Weight of local shading when mixing is “Layer”, 0 to 1.";
    let limits = Limits::between(0.0, 1.0);
    number(fields, index, ("Opacity", tip), limits, P::Opacity, |m| {
        &mut m.opacity
    });
    let tip = "Dependence of reflectance on the angle.";
    let options = [
        (Fresnel::None, "Constant"),
        (Fresnel::Exact, "Fresnel's equations"),
        (Fresnel::Schlick, "Schlick's approximation"),
    ];
    let set = with(index, |material, to| material.fresnel = to);
    fields.choice(("Fresnel", tip), material.fresnel, &options, set);
    let tip = "How local shading, reflection and transmission are combined.";
    let options = [
        (Mixing::Layer, "Layer"),
        (Mixing::Sum, "Sum"),
        (Mixing::Blend, "Blend"),
    ];
    let set = with(index, |material, to| material.mixing = to);
    fields.choice(("Mixing", tip), material.mixing, &options, set);
    let tip = "Where dielectric volumes overlap, the highest priority wins. An integer.";
    let limits = Limits::between(-100.0, 100.0).with_speed(0.1);
    let set = with(index, |material, to: f64| {
        material.priority = to.round() as i32
    });
    fields.number(("Priority", tip), f64::from(material.priority), limits, set);
}

/// A row with a colour of a material.
fn color(
    fields: &mut Fields,
    index: usize,
    label: (&str, &str),
    property: MaterialProperty,
    slot: fn(&mut Material) -> &mut Vec3,
) {
    let value = *slot(&mut fields.scene.materials[index].clone());
    fields
        .driven_by(Target::Material(index, property))
        .color(label, value, move |scene, to| {
            *slot(&mut scene.materials[index]) = to;
        });
}

/// A row with a number of a material.
fn number(
    fields: &mut Fields,
    index: usize,
    label: (&str, &str),
    limits: Limits,
    property: MaterialProperty,
    slot: fn(&mut Material) -> &mut f32,
) {
    let value = f64::from(*slot(&mut fields.scene.materials[index].clone()));
    fields.driven_by(Target::Material(index, property)).number(
        label,
        value,
        limits,
        move |scene, to| {
            *slot(&mut scene.materials[index]) = to as f32;
        },
    );
}

/// Accesses a texture of a material.
type Slot = fn(&mut Textures) -> &mut Option<usize>;

/// The textures, and the colours that they multiply.
fn textures(fields: &mut Fields, index: usize, textures: &Textures) {
    if fields.scene.textures.is_empty() {
        return;
    }
    fields.heading("Textures");
    let mut options = vec![(None, "None".to_owned())];
    for (number, texture) in fields.scene.textures.iter().enumerate() {
        let kind = match texture.pattern {
            Pattern::Checker { .. } => "Checker",
            Pattern::Stripes { .. } => "Stripes",
            Pattern::Gradient { .. } => "Gradient",
            Pattern::Noise { .. } => "Noise",
            Pattern::Picture { .. } => "Picture",
        };
        options.push((Some(number), format!("{kind} (texture {})", number + 1)));
    }
    let slots: [(&str, Option<usize>, Slot); 8] = [
        ("× Diffuse", textures.diffuse, |t| &mut t.diffuse),
        ("× Specular", textures.specular, |t| &mut t.specular),
        ("× Ambient", textures.ambient, |t| &mut t.ambient),
        ("× Emission", textures.emission, |t| &mut t.emission),
        ("× Reflect", textures.reflect, |t| &mut t.reflect),
        ("× Transmit", textures.transmit, |t| &mut t.transmit),
        ("Normal map", textures.normal, |t| &mut t.normal),
        ("× Alpha", textures.alpha, |t| &mut t.alpha),
    ];
    for (label, value, slot) in slots {
        let tip = match label {
            "Normal map" => "Normals of small bumps, as a picture.",
            "× Alpha" => "Texture whose alpha says how much of the surface is there.",
            _ => "Texture that multiplies this colour.",
        };
        fields.choice((label, tip), value, &options, move |scene, to| {
            *slot(&mut scene.materials[index].textures) = to;
        });
    }
}

/// The material of an object, and its properties if all parts share it.
pub fn of_object(fields: &mut Fields, session: &mut Session, object: ObjectRef) {
    let scene = fields.scene;
    let used: Vec<usize> = match object {
        ObjectRef::Shape(index) => vec![scene.shapes[index].material],
        ObjectRef::Instance(index) => {
            let mesh = &scene.meshes[scene.instances[index].mesh];
            let mut used: Vec<usize> = Vec::new();
            let mut last = None;
            for &material in &mesh.materials {
                if last.replace(material) != Some(material) && !used.contains(&(material as usize))
                {
                    used.push(material as usize);
                }
            }
            used
        }
        ObjectRef::Light(_) => return,
    };
    fields.heading("Material");
    let options: Vec<(usize, String)> = (0..scene.materials.len())
        .map(|index| (index, session.label(Id::Material(index))))
        .collect();
    let now = match used[..] {
        [one] => one,
        _ => usize::MAX,
    };
    let tip = "The material of the whole object.";
    if let Some(to) = fields.choice_value(("Material", tip), now, &options) {
        fields.change("material", move |scene| objects::assign(scene, object, to));
    }
    if let [one] = used[..] {
        let subject = session.label(Id::Material(one));
        let users = scene
            .shapes
            .iter()
            .filter(|shape| shape.material == one)
            .count()
            + (scene.instances.iter())
                .filter(|i| scene.meshes[i.mesh].materials.first() == Some(&(one as u32)))
                .count();
        if users > 1 {
            fields.note(&format!(
                "{users} objects share {subject}. Editing it changes all of them."
            ));
        }
        let before = std::mem::replace(&mut fields.subject, subject);
        show(fields, one);
        fields.subject = before;
        return;
    }
    for index in used {
        let label = session.label(Id::Material(index));
        fields.ui.horizontal(|ui| {
            let size = eframe::egui::vec2(16.0, 18.0);
            let (rect, _) = ui.allocate_exact_size(size, eframe::egui::Sense::hover());
            icon::draw(ui, rect, scene, Id::Material(index), true);
            if ui
                .link(label)
                .on_hover_text("Select this material")
                .clicked()
            {
                session.selection = Some(Id::Material(index));
            }
        });
    }
}
