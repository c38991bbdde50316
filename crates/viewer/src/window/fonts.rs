//! Fonts: egui's own, and an installed one for letters that these lack.

use crate::state::session::Session;
use crate::ui::panels::sign::ICONS;
use eframe::egui::{self, FontData, FontDefinitions, FontFamily, FontId};
use glimray_scene::Scene;
use lucide_icons::LUCIDE_FONT_BYTES;
use skrifa::{FontRef, MetadataProvider};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Folders with fonts, by system.
const FOLDERS: &[&str] = &[
    "/usr/share/fonts",
    "/usr/local/share/fonts",
    "/System/Library/Fonts",
    "/Library/Fonts",
    "C:\\Windows\\Fonts",
];
/// Parts of the names of fonts with many letters, the best first.
const LIKELY: &[&str] = &[
    "notosanscjk",
    "sourcehansans",
    "pingfang",
    "hiragino",
    "msyh",
    "yugoth",
    "malgun",
    "wqy",
    "droidsansfallback",
    "notosans",
    "dejavusans.",
    "arial",
];
/// Largest number of fonts that are read.
const MOST: usize = 64;

/// egui's fonts, and that of the icons. Glyphs missing in the text font, such as arrows, come from the monospace font first, which
/// fits better than the symbol fonts.
pub fn own() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let code = (fonts.families.get(&FontFamily::Monospace)).cloned();
    let text = (fonts.families.entry(FontFamily::Proportional)).or_default();
    if let Some(font) = code.unwrap_or_default().into_iter().next() {
        text.retain(|other| *other != font);
        text.insert(text.len().min(1), font);
    }
    let icons = FontData::from_static(LUCIDE_FONT_BYTES);
    fonts.font_data.insert(ICONS.to_owned(), Arc::new(icons));
    let family = FontFamily::Name(ICONS.into());
    fonts.families.insert(family, vec![ICONS.to_owned()]);
    fonts
}

/// Looks for letters without a glyph, and gives the window fonts that have them.
#[derive(Default)]
pub struct Fallbacks {
    /// The names that were looked through.
    seen: Names,
    /// Letters that were looked for, whether found or not.
    known: BTreeSet<char>,
    fonts: Vec<(String, FontData)>,
}

/// Where names in any script come from.
#[derive(Clone, Default)]
struct Names {
    scene: Option<Arc<Scene>>,
    files: Vec<PathBuf>,
    query: String,
}

impl Names {
    fn of(session: &Session) -> Self {
        let recent = session.preferences.recent.iter();
        Self {
            scene: session.scene().cloned(),
            files: session.path.iter().chain(recent).cloned().collect(),
            query: session.editing.listing.query.clone(),
        }
    }

    fn is_same(&self, other: &Self) -> bool {
        let is_same_scene = match (&self.scene, &other.scene) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        is_same_scene && self.files == other.files && self.query == other.query
    }

    /// All letters of other scripts than Latin.
    fn letters(&self) -> BTreeSet<char> {
        let mut text = self.query.clone();
        let paths = self.files.iter();
        text.extend(paths.map(|path| path.display().to_string()));
        if let Some(scene) = &self.scene {
            text.extend(scene.materials.iter().map(|it| it.name.as_str()));
            text.extend(scene.nodes.iter().map(|it| it.name.as_str()));
            text.extend(scene.cameras.iter().map(|it| it.name.as_str()));
            text.extend(scene.meshes.iter().map(|it| it.name.as_str()));
            text.extend(scene.instances.iter().map(|it| it.name.as_str()));
            text.extend(scene.shapes.iter().map(|it| it.name.as_str()));
            text.extend(scene.lights.iter().map(|it| it.name.as_str()));
            text.extend(scene.clips.iter().map(|it| it.name.as_str()));
            text.extend(scene.variants.iter().map(String::as_str));
            text.extend(scene.alternatives.iter().map(String::as_str));
        }
        text.chars().filter(|letter| *letter > '\u{24f}').collect()
    }
}

impl Fallbacks {
    /// Adds fonts if a name in the session has letters without a glyph. Files are read only then.
    pub fn update(&mut self, ctx: &egui::Context, session: &Session) {
        let names = Names::of(session);
        if names.is_same(&self.seen) {
            return;
        }
        let mut missing = names.letters();
        self.seen = names;
        missing.retain(|letter| !self.known.contains(letter));
        let id = FontId::default();
        ctx.fonts_mut(|fonts| missing.retain(|letter| !fonts.has_glyph(&id, *letter)));
        self.known.extend(&missing);
        let folders = FOLDERS.iter().map(PathBuf::from).collect();
        let found = match missing.is_empty() {
            true => return,
            false => fonts_with(folders, missing),
        };
        if found.is_empty() {
            return;
        }
        self.fonts.extend(found);
        let mut all = own();
        for (name, data) in &self.fonts {
            all.font_data.insert(name.clone(), data.clone().into());
            for family in all.families.values_mut() {
                family.push(name.clone());
            }
        }
        ctx.set_fonts(all);
    }
}

/// Fonts in these folders that have some of the letters, until all are found.
fn fonts_with(folders: Vec<PathBuf>, mut letters: BTreeSet<char>) -> Vec<(String, FontData)> {
    let mut files = font_files(folders);
    files.sort_by_key(|path| (rank(path), path.clone()));
    let mut found = Vec::new();
    for path in files.into_iter().take(MOST) {
        if letters.is_empty() {
            break;
        }
        let Ok(bytes) = fs::read(&path) else {
            continue;
        };
        let Ok(font) = FontRef::from_index(&bytes, 0) else {
            continue;
        };
        let map = font.charmap();
        let before = letters.len();
        letters.retain(|letter| map.map(*letter).is_none());
        if letters.len() < before {
            found.push((path.display().to_string(), FontData::from_owned(bytes)));
        }
    }
    found
}

fn rank(path: &Path) -> usize {
    let name = path
        .file_name()
        .map(|name| name.to_string_lossy().to_lowercase());
    let name = name.unwrap_or_default();
    let likely = LIKELY.iter().position(|part| name.contains(part));
    likely.unwrap_or(LIKELY.len())
}

/// All font files below these folders. Links to folders are not followed.
fn font_files(mut folders: Vec<PathBuf>) -> Vec<PathBuf> {
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
            if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                folders.push(path);
            } else if ending.is_some_and(|it| ["ttf", "otf", "ttc"].iter().any(|e| it == *e)) {
                files.push(path);
            }
        }
    }
    files
}
