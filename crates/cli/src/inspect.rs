//! `glimray inspect SCENE`: the contents of a scene as the renderer sees it.

mod deforming;
mod entries;
mod materials;
mod motion;
mod textures;

pub use entries::Inspection;

use crate::args::{InspectArgs, PictureFlags};
use crate::idle_flags;
use crate::report::SceneReport;
use crate::scene_file;
use glam::{DVec3, Vec3};
use glimray_app::advice::UNLIT;
use glimray_app::console::{self, quoted};
use glimray_app::error::AppError;
use glimray_app::value_names::{TONES, TRANSFERS};
use glimray_io::import::{Baking, Options};
use glimray_render::{Integrator, Tone};
use glimray_scene::{Attenuation, Background, Camera, Light, LightKind, Scene, Section};
use std::fmt::{self, Write};

/// Largest number of list items in the text output; JSON lists all.
const MAX_LISTED: usize = 20;

/// The scene to look at.
///
/// # Errors
/// The scene is refused.
pub fn scene(arguments: &InspectArgs) -> Result<Scene, AppError> {
    idle_flags::check(&arguments.reading, &arguments.scene)?;
    let options = Options {
        baking: Baking::Never,
        ..(arguments.reading).import_options(arguments.axis.up, false, &PictureFlags::default())
    };
    scene_file::load(&arguments.scene, &options, arguments.reading.strict).0
}

pub fn run(arguments: &InspectArgs) -> Result<(), AppError> {
    let scene = scene(arguments)?;
    let path = arguments.scene.display().to_string();
    if arguments.json {
        let value = serde_json::to_value(Inspection::new(&path, &scene))
            .map_err(|error| AppError::Internal(format!("inspect: {error}")))?;
        return console::print_json(&value);
    }
    let mut text = String::new();
    write_text(&mut text, &path, &scene)
        .map_err(|error| AppError::Internal(format!("inspect: {error}")))?;
    console::print(&text)
}

fn write_text(out: &mut String, path: &str, scene: &Scene) -> fmt::Result {
    let counts = SceneReport::new(path, scene);
    writeln!(out, "{path}")?;
    writeln!(out, "spheres    {}", counts.spheres)?;
    writeln!(out, "shapes     {} other", counts.shapes)?;
    let [meshes, instances] = [scene.meshes.len(), counts.instances];
    let triangles = counts.triangles;
    writeln!(
        out,
        "triangles  {triangles} in {instances} instance(s) of {meshes} mesh(es)"
    )?;
    match scene.bounds() {
        Some((min, max)) => writeln!(out, "bounds     {} to {}", point(min), point(max))?,
        None => writeln!(out, "bounds     none")?,
    }
    let output = &scene.output;
    writeln!(
        out,
        "picture    {}×{}, integrator {}, {} sample(s){}, depth {}, exposure {}{} EV, tone {}, transfer {}",
        output.size.0,
        output.size.1,
        Integrator::from(output.integrator).entry().name,
        output.samples,
        if output.denoise { " denoised" } else { "" },
        output.max_depth,
        if output.auto_exposure {
            "auto and "
        } else {
            ""
        },
        output.exposure_ev,
        TONES.name(&Tone::from(output).curve),
        TRANSFERS.name(&output.transfer),
    )?;
    writeln!(
        out,
        "background {}, ambient {}",
        background(&scene.background),
        color(scene.ambient)
    )?;
    if let Some(Section { normal, offset }) = scene.section {
        let normal = point(normal);
        writeln!(out, "section    beyond {offset} along {normal} is cut away")?;
    }
    motion::write_text(out, scene)?;
    deforming::write_text(out, scene)?;
    list(
        out,
        "cameras",
        &scene.cameras_at(0.0),
        |out, index, camera| {
            let used = if index == scene.camera_index {
                " (used)"
            } else if index < scene.blind_cameras {
                " (sees nothing that is lit)"
            } else {
                ""
            };
            camera_text(out, camera)?;
            write!(out, "{used}")
        },
    )?;
    list(out, "lights", &scene.frame(0.0).lights, |out, _, light| {
        light_text(out, light)
    })?;
    list(out, "materials", &scene.materials, |out, _, material| {
        materials::material_text(out, material)
    })?;
    list(out, "textures", &scene.textures, |out, _, texture| {
        textures::texture_text(out, texture)
    })?;
    list(out, "pictures", &scene.pictures, |out, _, picture| {
        textures::picture_text(out, picture)
    })?;
    for (title, lines) in [("skipped", &scene.skipped), ("remarks", &scene.remarks)] {
        writeln!(out, "{title:<10} {}", lines.len())?;
        for (index, line) in lines.iter().enumerate() {
            writeln!(out, "  {index}  {line}")?;
        }
    }
    match scene.is_unlit() {
        true => writeln!(out, "warning    {UNLIT}"),
        false => Ok(()),
    }
}

fn list<T>(
    out: &mut String,
    title: &str,
    items: &[T],
    write_item: impl Fn(&mut String, usize, &T) -> fmt::Result,
) -> fmt::Result {
    let count = items.len();
    writeln!(out, "{title:<10} {count}")?;
    for (index, item) in items.iter().enumerate().take(MAX_LISTED) {
        write!(out, "  {index}  ")?;
        write_item(out, index, item)?;
        writeln!(out)?;
    }
    if count > MAX_LISTED {
        writeln!(out, "  … and {} more", count - MAX_LISTED)?;
    }
    Ok(())
}

fn background(background: &Background) -> String {
    match background {
        Background::Color(value) => color(*value),
        Background::Gradient { bottom, top } => {
            format!(
                "gradient from {} (bottom) to {} (top)",
                color(*bottom),
                color(*top)
            )
        }
        Background::Picture { picture, .. } => format!("picture {picture}"),
    }
}

fn camera_text(out: &mut String, camera: &Camera) -> fmt::Result {
    let (from, at) = (point(camera.look_from), point(camera.look_at));
    let view = match camera.orthographic_height {
        Some(height) => format!("orthographic, view height {}", number(height)),
        None => format!("vertical field of view {:.2}°", camera.fov_y.to_degrees()),
    };
    write!(out, "{} from {from} to {at}, {view}", quoted(&camera.name))?;
    let (near, far) = camera.clip;
    if camera.clip != Camera::UNCLIPPED {
        write!(out, ", sees from {}", number(near))?;
        match far.is_finite() {
            true => write!(out, " to {}", number(far))?,
            false => write!(out, " on")?,
        }
    }
    match camera.lens {
        Some(lens) => write!(
            out,
            ", lens radius {}, focus distance {}",
            number(lens.radius),
            number(lens.focus_distance)
        ),
        None => Ok(()),
    }
}

fn light_text(out: &mut String, light: &Light) -> fmt::Result {
    write!(out, "{} {}", kind(light), color(light.color))?;
    match light.kind {
        LightKind::Point { position } => write!(out, " at {}", point(position))?,
        LightKind::Directional { direction } => write!(out, " towards {}", point(direction))?,
        LightKind::Spot {
            position,
            direction,
            inner,
            outer,
        } => write!(
            out,
            " at {} towards {}, cone angles {:.1}° to {:.1}°",
            point(position),
            point(direction),
            inner.to_degrees(),
            outer.to_degrees()
        )?,
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => write!(
            out,
            " at {}, {} by {}",
            point(center),
            number(2.0 * edge_u.length()),
            number(2.0 * edge_v.length())
        )?,
        LightKind::Disc { center, radius, .. } | LightKind::Sphere { center, radius } => {
            write!(out, " at {}, radius {}", point(center), number(radius))?;
        }
    }
    write!(out, ", attenuation {}", attenuation(light))?;
    match light.kind.radiance() {
        Some(_) => {
            let seen = if light.visible { "" } else { ", invisible" };
            write!(out, ", {} sample(s){seen}", light.samples)
        }
        None => Ok(()),
    }
}

fn kind(light: &Light) -> &'static str {
    match light.kind {
        LightKind::Point { .. } => "point",
        LightKind::Directional { .. } => "directional",
        LightKind::Spot { .. } => "spot",
        LightKind::Rectangle { .. } => "rectangle",
        LightKind::Disc { .. } => "disc",
        LightKind::Sphere { .. } => "sphere",
    }
}

fn attenuation(light: &Light) -> &'static str {
    match light.attenuation {
        Attenuation::None => "none",
        Attenuation::InverseSquare => "inverse-square",
    }
}

fn point(p: DVec3) -> String {
    format!("({}, {}, {})", number(p.x), number(p.y), number(p.z))
}

fn color(c: Vec3) -> String {
    point(c.as_dvec3())
}

/// Formats a number with at most four decimals.
fn number(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    // Adding 0 turns -0 into 0.
    format!("{}", rounded + 0.0)
}
