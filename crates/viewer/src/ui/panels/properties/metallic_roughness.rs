//! The properties of a metallic-roughness BSDF.

use super::material_rows::{color, color_up_to, number, with};
use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::Vec3;
use glimray_scene::{LayerProperty, MetallicRoughness, Target};

/// The body of the surface and its reflection.
pub fn surface(fields: &mut Fields, index: usize, model: &MetallicRoughness) {
    use LayerProperty as L;
    let at = |property| Some(Target::Layer(index, property));
    fields.heading("Surface");
    let tip = "The colour of a dielectric's body, or of a metal's reflection, 0 to 1.";
    let label = ("Base colour", tip);
    bounded(fields, index, label, at(L::BaseColor), |m| {
        &mut m.base_color
    });
    let tip = "0 for a dielectric, 1 for a metal.";
    let label = ("Metallic", tip);
    fraction(fields, index, label, at(L::Metallic), |m| &mut m.metallic);
    let tip = "The roughness of the surface, 0 to 1.";
    let label = ("Roughness", tip);
    fraction(fields, index, label, at(L::Roughness), |m| &mut m.roughness);
    let tip = "Index of refraction of a dielectric, from 1 to 100: water 1.33, glass 1.5.";
    let (label, limits) = (("Index (ior)", tip), Limits::between(1.0, 100.0));
    number(
        fields,
        index,
        label,
        limits,
        at(L::Ior),
        |m: &mut MetallicRoughness| &mut m.ior,
    );
    let tip = "Factor on the reflection of a dielectric, 0 to 1.";
    fraction(fields, index, ("Specular", tip), None, |m| &mut m.specular);
    let tip = "The colour of this reflection along the normal.";
    color(
        fields,
        index,
        ("Specular colour", tip),
        None,
        |m: &mut MetallicRoughness| &mut m.specular_color,
    );
    let tip = "Show the base colour as it is, without light.";
    let set = with(index, |model: &mut MetallicRoughness, to| model.unlit = to);
    fields.toggle(("Unlit", tip), model.unlit, set);
}

/// The light that passes through the surface.
pub fn glass(fields: &mut Fields, index: usize) {
    let transmission = Some(Target::Layer(index, LayerProperty::Transmission));
    fields.heading("Glass");
    let tip = "The fraction of the light in a dielectric's body that passes through, 0 to 1.";
    let label = ("Transmission", tip);
    fraction(fields, index, label, transmission, |m| &mut m.transmission);
    let tip = "0 for a thin wall, which does not refract. Above 0 the surface encloses a volume.";
    let label = ("Thickness", tip);
    number(
        fields,
        index,
        label,
        Limits::AMOUNT,
        None,
        |m: &mut MetallicRoughness| &mut m.thickness,
    );
    let tip = "The colour that white light has after the attenuation distance, 0 to 1.";
    let label = ("Attenuation colour", tip);
    bounded(fields, index, label, None, |m| &mut m.attenuation_color);
    let tip =
        "The length that gives light in the volume its attenuation colour. ∞ in a clear volume.";
    let (label, limits) = (("Attenuation distance", tip), Limits::ENDLESS);
    number(
        fields,
        index,
        label,
        limits,
        None,
        |m: &mut MetallicRoughness| &mut m.attenuation_distance,
    );
    let tip = "Dependence of the index of refraction on the wavelength, 0 to 100: 20 divided by Abbe's number.";
    let (label, limits) = (("Dispersion", tip), Limits::between(0.0, 100.0));
    number(
        fields,
        index,
        label,
        limits,
        None,
        |m: &mut MetallicRoughness| &mut m.dispersion,
    );
}

/// The layers over the body, and the light that leaves it on the other side.
pub fn layers(fields: &mut Fields, index: usize, model: &MetallicRoughness) {
    fields.heading("Layers");
    let tip = "The strength of a clear coat, 0 to 1.";
    fraction(fields, index, ("Clear coat", tip), None, |m| {
        &mut m.clearcoat
    });
    let tip = "The roughness of the clear coat, 0 to 1.";
    let label = ("Clear coat roughness", tip);
    fraction(fields, index, label, None, |m| &mut m.clearcoat_roughness);
    if model.textures.clearcoat_normal.is_some() {
        let tip = "Factor on the tilt of the clear coat's normal map, 0 to 1000.";
        let (label, limits) = (("Clear coat bumps", tip), Limits::between(0.0, 1000.0));
        number(
            fields,
            index,
            label,
            limits,
            None,
            |m: &mut MetallicRoughness| &mut m.clearcoat_normal_scale,
        );
    }
    let tip = "The colour of a layer of fibres, as on velvet, 0 to 1.";
    let label = ("Sheen colour", tip);
    bounded(fields, index, label, None, |m| &mut m.sheen_color);
    let tip = "The roughness of the layer of fibres, 0 to 1.";
    let label = ("Sheen roughness", tip);
    fraction(fields, index, label, None, |m| &mut m.sheen_roughness);
    let tip = "How much longer highlights are along one direction, 0 to 1.";
    fraction(fields, index, ("Anisotropy", tip), None, |m| {
        &mut m.anisotropy
    });
    let tip = "The direction of the anisotropy, counter-clockwise from that of u.";
    let degrees = f64::from(model.anisotropy_rotation).to_degrees();
    let set = with(index, |model: &mut MetallicRoughness, to: f64| {
        model.anisotropy_rotation = to.to_radians() as f32;
    });
    fields.number(("Anisotropy rotation", tip), degrees, Limits::ANGLE, set);
    film(fields, index, model);
    let tip = "The fraction of the diffuse light that leaves on the other side, 0 to 1.";
    let label = ("Diffuse transmission", tip);
    fraction(fields, index, label, None, |m| &mut m.diffuse_transmission);
    let tip = "The colour of the diffuse light that leaves on the other side, 0 to 1.";
    let label = ("Diffuse transmission colour", tip);
    bounded(fields, index, label, None, |m| {
        &mut m.diffuse_transmission_color
    });
}

/// The thin film.
fn film(fields: &mut Fields, index: usize, model: &MetallicRoughness) {
    let tip = "The strength of a thin film, whose colours change with the angle, 0 to 1.";
    let label = ("Iridescence", tip);
    fraction(fields, index, label, None, |m| &mut m.iridescence);
    let tip = "The film's index of refraction, from 1 to 100.";
    let (label, limits) = (("Film index (ior)", tip), Limits::between(1.0, 100.0));
    number(
        fields,
        index,
        label,
        limits,
        None,
        |m: &mut MetallicRoughness| &mut m.iridescence_ior,
    );
    let limits = Limits::between(0.0, 1e6).with_speed(0.02);
    let [thinnest, thickest] = model.iridescence_thickness.map(f64::from);
    // Without a map all of the film is as thick as its thickest part.
    if model.textures.iridescence_thickness.is_some() {
        let tip = "The thickness of the film where its map is 0, in nanometres.";
        let set = with(index, |model: &mut MetallicRoughness, to: f64| {
            model.iridescence_thickness[0] = to as f32;
        });
        fields.number(("Film from", tip), thinnest, limits, set);
    }
    let tip = "The thickness of the film, in nanometres; with a map where that is 1.";
    let set = with(index, |model: &mut MetallicRoughness, to: f64| {
        let [thinnest, thickest] = &mut model.iridescence_thickness;
        *thickest = to as f32;
        if model.textures.iridescence_thickness.is_none() {
            *thinnest = thinnest.min(*thickest);
        }
    });
    fields.number(("Film thickness", tip), thickest, limits, set);
}

/// Removes what the classical integrators show instead, if a file gives it.
pub fn classical(fields: &mut Fields, index: usize, model: &MetallicRoughness) {
    if model.phong.is_some() {
        fields.heading("Classical integrators");
        let tip = "Show the colours that the file gives for them, instead of those that follow from the rows above.";
        let set = with(index, |model: &mut MetallicRoughness, _| model.phong = None);
        fields.toggle(("Own colours", tip), true, set);
    }
}

/// A row with a number from 0 to 1.
fn fraction(
    fields: &mut Fields,
    index: usize,
    label: (&'static str, &str),
    target: Option<Target>,
    slot: fn(&mut MetallicRoughness) -> &mut f32,
) {
    number(fields, index, label, Limits::UNIT, target, slot);
}

/// A row with a colour from 0 to 1.
fn bounded(
    fields: &mut Fields,
    index: usize,
    label: (&'static str, &str),
    target: Option<Target>,
    slot: fn(&mut MetallicRoughness) -> &mut Vec3,
) {
    color_up_to(fields, Vec3::ONE, index, label, target, slot);
}
