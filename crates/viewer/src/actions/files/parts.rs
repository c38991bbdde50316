//! Parts of a model's file of which one is shown: a clip, a variant of the materials, a scene.

use crate::actions::files::intend;
use crate::state::files::{Intent, Part};
use crate::state::session::Session;
use glimray_io::import::SceneFormat;

/// The choices among a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choices {
    /// Labels, in the order of the file.
    pub names: Vec<String>,
    /// The chosen one; `None` if it is left to the file.
    pub chosen: Option<usize>,
}

/// The choices of a part; `None` if there are not several.
pub fn choices(session: &Session, part: Part) -> Option<Choices> {
    let known = known(session, part);
    let chosen = option(session, part).and_then(|wanted| {
        let by_name = known.iter().position(|name| *name == wanted);
        by_name.or_else(|| wanted.parse().ok().filter(|index| *index < known.len()))
    });
    let label = |(index, name): (usize, &String)| match name.is_empty() {
        true => format!("{} {index}", part.title()),
        false => name.clone(),
    };
    let names: Vec<_> = known.iter().enumerate().map(label).collect();
    // A single variant differs from none.
    let least = if part == Part::Variant { 1 } else { 2 };
    (names.len() >= least).then_some(Choices { names, chosen })
}

/// Reads the file again with another choice; `None` leaves it to the file. Asks if there are unsaved changes.
pub fn choose(session: &mut Session, part: Part, index: Option<usize>) {
    let known = known(session, part);
    let name = index.and_then(|index| {
        let name = known.get(index)?;
        let is_unique = known.iter().filter(|other| *other == name).count() == 1;
        Some(match is_unique && !name.is_empty() {
            true => name.clone(),
            false => index.to_string(),
        })
    });
    intend(session, Intent::Choose(part, name));
}

/// Names in the file, some of them empty. A scene that was saved in another format keeps the names of its model, but
/// its file has no such choice.
fn known(session: &Session, part: Part) -> Vec<String> {
    let format = session.path.as_deref().and_then(SceneFormat::of);
    let has_parts = format.is_some_and(SceneFormat::has_choices);
    let Some(scene) = session.original.as_ref().filter(|_| has_parts) else {
        return Vec::new();
    };
    match part {
        Part::Clip => scene.clips.iter().map(|clip| clip.name.clone()).collect(),
        Part::Variant => scene.variants.clone(),
        Part::Scene => scene.alternatives.clone(),
    }
}

fn option(session: &Session, part: Part) -> Option<String> {
    let options = &session.request.import;
    match part {
        Part::Clip => options.clip.clone(),
        Part::Variant => options.variant.clone(),
        Part::Scene => options.scene.clone(),
    }
}
