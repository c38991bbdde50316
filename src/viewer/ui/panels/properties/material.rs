//! The properties of a material.

use crate::scene::{
    Fresnel, Material, MaterialProperty, Mixing, ObjectRef, Pattern, Scene, Target, Textures,
};
use crate::viewer::model::objects;
use crate::viewer::model::objects::Id;
use crate::viewer::state::session::Session;
use crate::viewer::ui::panels::icon;
use crate::viewer::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;

/// The option that links the ambient colour to the diffuse colour.
const FOLLOWS: &str = "Ambient follows diffuse";

/// Draws all properties of a material.
pub fn show(fields: &mut Fields, index: usize) {
    let material = fields.scene.materials[index].clone();
    use MaterialProperty as P;
    fields.heading("Local shading");
    let of = |fields: &mut Fields, label, tip, property, slot| {
        color(fields, index, label, tip, property, slot);
    };
    let tip = "Diffuse reflection coefficient (k_d).";
    let follow_tip = "Set the ambient colour together with the diffuse colour.";
    let is_same = material.ambient == material.diffuse;
    let target = Some(Target::Material(index, P::Diffuse));
    let follows = is_same && fields.option_value(FOLLOWS, true);
    fields.color(
        "Diffuse",
        tip,
        material.diffuse,
        target,
        move |scene, to| {
            let material = &mut scene.materials[index];
            material.diffuse = to;
            if follows {
                material.ambient = to;
            }
        },
    );
    let tip = "Specular reflection coefficient (k_s).";
    of(fields, "Specular", tip, P::Specular, |m| &mut m.specular);
    let tip = "Factor on the scene's ambient light.";
    if !follows {
        of(fields, "Ambient", tip, P::Ambient, |m| &mut m.ambient);
    }
    if fields.option(FOLLOWS, follow_tip, follows) == Some(true) {
        fields.change("ambient", move |scene| {
            let material = &mut scene.materials[index];
            material.ambient = material.diffuse;
            Ok(())
        });
    }
    let tip = "Radiance emitted by the surface.";
    of(fields, "Emission", tip, P::Emission, |m| &mut m.emission);
    let number = |fields: &mut Fields, label, tip, limits, property, slot: Number| {
        let value = f64::from(*slot(&mut fields.scene.materials[index].clone()));
        let set = move |scene: &mut Scene, to: f64| *slot(&mut scene.materials[index]) = to as f32;
        let target = Target::Material(index, property);
        fields.number(label, tip, value, limits, Some(target), set);
    };
    let tip = "Phong exponent of the highlight, 0 or more. Larger values are sharper.";
    number(
        fields,
        "Shininess",
        tip,
        Limits::AMOUNT,
        P::Shininess,
        |m| &mut m.shininess,
    );
    let tip = "Shade both sides. Otherwise the back shows ambient light only.";
    fields.toggle("Two-sided", tip, material.two_sided, move |scene, to| {
        scene.materials[index].two_sided = to;
    });
    fields.heading("Mirror and glass");
    let tip = "Fraction of light that is reflected; with Fresnel, at grazing angles.";
    of(fields, "Reflect", tip, P::Reflect, |m| &mut m.reflect);
    let tip = "Fraction of light that is transmitted.";
    of(fields, "Transmit", tip, P::Transmit, |m| &mut m.transmit);
    let tip = "Absorption coefficient: transmittance is exp(−absorption · length).";
    of(fields, "Absorption", tip, P::Absorption, |m| {
        &mut m.absorption
    });
    let tip = "Index of refraction, from 0.01 to 100: water 1.33, glass 1.5, diamond 2.42.";
    number(
        fields,
        "Index (ior)",
        tip,
        Limits::between(0.01, 100.0),
        P::Ior,
        |m| &mut m.ior,
    );
    let tip = "Weight of local shading when mixing is “layer”, 0 to 1.";
    number(
        fields,
        "Opacity",
        tip,
        Limits::between(0.0, 1.0),
        P::Opacity,
        |m| &mut m.opacity,
    );
    let tip = "Dependence of reflectance on the angle.";
    let options = [
        (Fresnel::None, "Constant".to_owned()),
        (Fresnel::Exact, "Fresnel's equations".to_owned()),
        (Fresnel::Schlick, "Schlick's approximation".to_owned()),
    ];
    fields.choice(
        "Fresnel",
        tip,
        material.fresnel,
        &options,
        move |scene, to| {
            scene.materials[index].fresnel = to;
            Ok(())
        },
    );
    let tip = "How local shading, reflection and transmission are combined.";
    let options = [
        (Mixing::Layer, "layer".to_owned()),
        (Mixing::Sum, "sum".to_owned()),
        (Mixing::Blend, "blend".to_owned()),
    ];
    fields.choice(
        "Mixing",
        tip,
        material.mixing,
        &options,
        move |scene, to| {
            scene.materials[index].mixing = to;
            Ok(())
        },
    );
    let tip = "Where dielectric volumes overlap, the highest priority wins. An integer.";
    let limits = Limits {
        speed: 0.1,
        ..Limits::between(-100.0, 100.0)
    };
    let priority = f64::from(material.priority);
    fields.number("Priority", tip, priority, limits, None, move |scene, to| {
        scene.materials[index].priority = to.round() as i32;
    });
    textures(fields, index, &material.textures);
}

/// Accesses a colour or a number of a material.
type Color = fn(&mut Material) -> &mut Vec3;
type Number = fn(&mut Material) -> &mut f32;

fn color(
    fields: &mut Fields,
    index: usize,
    label: &str,
    tip: &str,
    property: MaterialProperty,
    slot: Color,
) {
    let value = *slot(&mut fields.scene.materials[index].clone());
    let set = move |scene: &mut Scene, to| *slot(&mut scene.materials[index]) = to;
    let target = Target::Material(index, property);
    fields.color(label, tip, value, Some(target), set);
}

/// Accesses a texture of a material.
type Slot = fn(&mut Textures) -> &mut Option<usize>;

/// The textures, and the colours that they multiply.
fn textures(fields: &mut Fields, index: usize, textures: &Textures) {
    if fields.scene.textures.is_empty() {
        return;
    }
    fields.heading("Textures");
    let mut options = vec![(None, "none".to_owned())];
    for (number, texture) in fields.scene.textures.iter().enumerate() {
        let kind = match texture.pattern {
            Pattern::Checker { .. } => "checker",
            Pattern::Stripes { .. } => "stripes",
            Pattern::Gradient { .. } => "gradient",
            Pattern::Noise { .. } => "noise",
            Pattern::Picture { .. } => "picture",
        };
        options.push((Some(number), format!("{kind} (texture {})", number + 1)));
    }
    let slots: [(&str, Option<usize>, Slot); 6] = [
        ("× diffuse", textures.diffuse, |t| &mut t.diffuse),
        ("× specular", textures.specular, |t| &mut t.specular),
        ("× ambient", textures.ambient, |t| &mut t.ambient),
        ("× emission", textures.emission, |t| &mut t.emission),
        ("× reflect", textures.reflect, |t| &mut t.reflect),
        ("× transmit", textures.transmit, |t| &mut t.transmit),
    ];
    for (label, value, slot) in slots {
        let tip = "Texture that multiplies this colour.";
        fields.choice(label, tip, value, &options, move |scene, to| {
            *slot(&mut scene.materials[index].textures) = to;
            Ok(())
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
    fields.choice("Material", tip, now, &options, move |scene, to| {
        objects::assign(scene, object, to)
    });
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
