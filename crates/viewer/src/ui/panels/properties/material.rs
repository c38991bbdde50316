//! The properties of a material.

use super::material_rows::{Part, color, number, with};
use super::{ball, metallic_roughness, texture_rows};
use crate::actions::materials::selected_surfaces;
use crate::model::material_presets::MaterialPreset;
use crate::model::objects;
use crate::model::objects::Id;
use crate::state::session::Session;
use crate::ui::panels::icon;
use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;
use glimray_scene::{
    Bsdf, Fresnel, Material, MaterialProperty, Mixing, ObjectRef, Phong, Scene, Target,
};

/// The option that links the ambient colour to the diffuse colour.
const FOLLOWS: &str = "Ambient follows diffuse";

/// Draws all properties of a material: those that it has in common with others, and those of its BSDF.
pub fn show(fields: &mut Fields, index: usize) {
    let scene = fields.scene;
    let material = &scene.materials[index];
    ball::show(fields, index);
    presets(fields, index);
    match &material.bsdf {
        Bsdf::Phong(phong) => {
            local_shading(fields, index, phong);
            emission(fields, index, material);
            mirror_and_glass(fields, index, phong);
            priority(fields, index, material);
        }
        Bsdf::MetallicRoughness(model) => {
            metallic_roughness::surface(fields, index, model);
            emission(fields, index, material);
            metallic_roughness::glass(fields, index);
            priority(fields, index, material);
            metallic_roughness::layers(fields, index, model);
            metallic_roughness::classical(fields, index, model);
        }
    }
    texture_rows::show(fields, index);
}

/// The presets. A material with other parameters than all of them is shown as a custom one.
fn presets(fields: &mut Fields, index: usize) {
    let now = MaterialPreset::of(&fields.scene.materials[index]);
    let custom = now.is_none().then_some((None, "Custom"));
    let presets = MaterialPreset::ALL.map(|preset| (Some(preset), preset.title()));
    let options: Vec<_> = custom.into_iter().chain(presets).collect();
    let tip = "Replace all that follows by a ready-made material. The name stays.";
    let set = move |scene: &mut Scene, to: Option<MaterialPreset>| match to {
        Some(preset) => preset.apply(scene, index),
        None => Ok(()),
    };
    fields.try_choice(("Preset", tip), now, &options, set);
}

fn local_shading(fields: &mut Fields, index: usize, phong: &Phong) {
    use MaterialProperty as P;
    let at = |property| Some(Target::Material(index, property));
    fields.heading("Local shading");
    let tip = "Diffuse reflection coefficient (k_d).";
    let is_same = phong.ambient == phong.diffuse;
    let follows = is_same && fields.option_value(FOLLOWS, true);
    let set = if follows {
        |phong: &mut Phong, to: Vec3| (phong.diffuse, phong.ambient) = (to, to)
    } else {
        |phong: &mut Phong, to: Vec3| phong.diffuse = to
    };
    fields.driven_by(Target::Material(index, P::Diffuse)).color(
        ("Diffuse", tip),
        phong.diffuse,
        with(index, set),
    );
    let tip = "Specular reflection coefficient (k_s).";
    let label = ("Specular", tip);
    color(fields, index, label, at(P::Specular), |p: &mut Phong| {
        &mut p.specular
    });
    if !follows {
        let tip = "Factor on the scene's ambient light.";
        color(
            fields,
            index,
            ("Ambient", tip),
            at(P::Ambient),
            |p: &mut Phong| &mut p.ambient,
        );
    }
    let tip = "Set the ambient colour together with the diffuse colour.";
    let is_asked = fields.option((FOLLOWS, tip), follows) == Some(true);
    fields.change_all("Ambient", is_asked, move |scene| {
        if let Some(phong) = Phong::of(&mut scene.materials[index]) {
            phong.ambient = phong.diffuse;
        }
    });
    let tip = "Phong exponent of the highlight, 0 or more. Larger values are sharper.";
    let label = ("Shininess", tip);
    let target = at(P::Shininess);
    number(
        fields,
        index,
        label,
        Limits::AMOUNT,
        target,
        |p: &mut Phong| &mut p.shininess,
    );
}

/// The emission, and the sides of the surface.
fn emission(fields: &mut Fields, index: usize, material: &Material) {
    let tip = match material.metallic_roughness() {
        Some(model) if model.unlit => {
            "Radiance emitted by the surface. Without it the unlit surface shows its base colour."
        }
        _ => "Radiance emitted by the surface.",
    };
    let target = Some(Target::Material(index, MaterialProperty::Emission));
    color(
        fields,
        index,
        ("Emission", tip),
        target,
        |m: &mut Material| &mut m.emission,
    );
    let tip = "Shade both sides. Otherwise the back shows ambient light only.";
    let set = with(index, |material: &mut Material, to| material.two_sided = to);
    fields.toggle(("Two-sided", tip), material.two_sided, set);
    let tip = "Emit on both sides of a two-sided surface. Otherwise its back emits nothing.";
    let set = with(index, |material: &mut Material, to| {
        material.two_sided_emission = to;
    });
    let label = ("Two-sided emission", tip);
    fields.toggle(label, material.two_sided_emission, set);
}

fn mirror_and_glass(fields: &mut Fields, index: usize, phong: &Phong) {
    use MaterialProperty as P;
    let at = |property| Some(Target::Material(index, property));
    fields.heading("Mirror and glass");
    let tip = "Fraction of light that is reflected; with Fresnel, at grazing angles.";
    color(
        fields,
        index,
        ("Reflect", tip),
        at(P::Reflect),
        |p: &mut Phong| &mut p.reflect,
    );
    let tip = "Fraction of light that is transmitted.";
    let label = ("Transmit", tip);
    color(fields, index, label, at(P::Transmit), |p: &mut Phong| {
        &mut p.transmit
    });
    let tip = "Absorption coefficient: transmittance is exp(−absorption · length).";
    let label = ("Absorption", tip);
    color(fields, index, label, at(P::Absorption), |p: &mut Phong| {
        &mut p.absorption
    });
    let tip = "Index of refraction, from 0.01 to 100: water 1.33, glass 1.5, diamond 2.42.";
    let limits = Limits::between(0.01, 100.0);
    let label = ("Index (ior)", tip);
    number(fields, index, label, limits, at(P::Ior), |p: &mut Phong| {
        &mut p.ior
    });
    let tip = "Weight of local shading when mixing is “Layer”, 0 to 1.";
    let label = ("Opacity", tip);
    let target = at(P::Opacity);
    number(
        fields,
        index,
        label,
        Limits::UNIT,
        target,
        |p: &mut Phong| &mut p.opacity,
    );
    let tip = "Dependence of reflectance on the angle.";
    let options = [
        (Fresnel::None, "Constant"),
        (Fresnel::Exact, "Fresnel's equations"),
        (Fresnel::Schlick, "Schlick's approximation"),
    ];
    let set = with(index, |phong: &mut Phong, to| phong.fresnel = to);
    fields.choice(("Fresnel", tip), phong.fresnel, &options, set);
    let tip = "How local shading, reflection and transmission are combined.";
    let options = [
        (Mixing::Layer, "Layer"),
        (Mixing::Sum, "Sum"),
        (Mixing::Blend, "Blend"),
    ];
    let set = with(index, |phong: &mut Phong, to| phong.mixing = to);
    fields.choice(("Mixing", tip), phong.mixing, &options, set);
}

fn priority(fields: &mut Fields, index: usize, material: &Material) {
    let tip = "Where dielectric volumes overlap, the highest priority wins. An integer.";
    let limits = Limits::between(-100.0, 100.0).with_speed(0.1);
    let set = with(index, |material: &mut Material, to: f64| {
        material.priority = to.round() as i32;
    });
    fields.number(("Priority", tip), f64::from(material.priority), limits, set);
}

/// The material of an object, and its properties if all parts share it.
pub fn of_object(fields: &mut Fields, session: &mut Session, object: ObjectRef) {
    let scene = fields.scene;
    if matches!(object, ObjectRef::Light(_)) {
        return;
    }
    let used = fields.materials_of(object);
    fields.heading("Material");
    let now = match used[..] {
        [one] => one,
        _ => usize::MAX,
    };
    given(fields, session, now);
    if let [one] = used[..] {
        if !fields.is_new_material(one) {
            return;
        }
        if !fields.is_drawn() {
            return show(fields, one);
        }
        let subject = session.label(Id::Material(one));
        let users = users(scene, one);
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
        fields.draw(|ui, _| {
            ui.horizontal(|ui| {
                let size = eframe::egui::vec2(16.0, 18.0);
                let (rect, _) = ui.allocate_exact_size(size, eframe::egui::Sense::hover());
                icon::draw(ui, rect, scene, Id::Material(index), true);
                let label = session.label(Id::Material(index));
                let link = ui.link(label).on_hover_text("Select this material");
                if link.clicked() {
                    session.select(vec![Id::Material(index)]);
                }
            })
        });
    }
}

/// The row of the material of a whole object.
fn given(fields: &mut Fields, session: &Session, now: usize) {
    let materials = fields.scene.materials.len();
    let drawn = fields.draw(|_, _| {
        let label = |index| (index, session.label(Id::Material(index)));
        let options: Vec<_> = (0..materials).map(label).collect();
        (options, selected_surfaces(session))
    });
    // The row that is drawn gives the material to all that are selected, so that a mesh is copied once for all of them. The
    // others give it to none.
    let (options, takers) = drawn.unwrap_or_default();
    let tip = "The material of the whole object.";
    let set = move |scene: &mut Scene, to: usize| objects::assign_all(scene, &takers, to);
    fields.try_choice(("Material", tip), now, &options, set);
}

/// Number of objects that have a material.
fn users(scene: &Scene, material: usize) -> usize {
    let shapes = scene.shapes.iter().filter(|it| it.material == material);
    let is_of = |mesh: usize| scene.meshes[mesh].materials.first() == Some(&(material as u32));
    let instances = scene.instances.iter().filter(|it| is_of(it.mesh));
    shapes.count() + instances.count()
}
