//! The pages of the manual, and the parts of Markdown that the tests look at.

use std::fs;
use std::path::{Path, PathBuf};

/// One Markdown file.
pub struct Page {
    /// Relative to the repository, with `/`.
    pub path: String,
    pub text: String,
}

/// A fenced block of code.
pub struct Block<'t> {
    /// The word after the opening fence; may be empty.
    pub language: &'t str,
    pub text: &'t str,
}

impl Page {
    pub fn read(path: &str) -> Self {
        let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let path = path.to_owned();
        Self { path, text }
    }

    /// The path that a link on this page to `target` leads to.
    pub fn resolve(&self, target: &str) -> PathBuf {
        let folder = Path::new(&self.path).parent().expect("a folder");
        folder.join(target)
    }

    pub fn blocks(&self) -> Vec<Block<'_>> {
        let parts: Vec<_> = self.text.split("```").collect();
        assert!(
            parts.len() % 2 == 1,
            "{}: a block of code has no end",
            self.path
        );
        let blocks = parts.iter().skip(1).step_by(2);
        let blocks = blocks.map(|block| block.split_once('\n').unwrap_or((block, "")));
        blocks
            .map(|(language, text)| Block { language, text })
            .collect()
    }

    /// The page without blocks of code.
    pub fn prose(&self) -> String {
        self.text
            .split("```")
            .step_by(2)
            .collect::<Vec<_>>()
            .join("\n")
    }

    /// Texts between backticks in the prose. Escaped bars of tables become bars.
    pub fn quoted(&self) -> Vec<String> {
        let prose = self.prose();
        let quoted = prose.split('`').skip(1).step_by(2);
        quoted.map(|code| code.replace("\\|", "|")).collect()
    }

    /// The targets of all links and pictures.
    pub fn links(&self) -> Vec<String> {
        let prose = self.prose();
        let text: Vec<_> = prose.split('`').step_by(2).collect();
        let text = text.join("code");
        let parts = text.split("](").skip(1);
        let targets = parts.filter_map(|part| Some(part.split_once(')')?.0));
        targets.map(str::to_owned).collect()
    }

    /// The anchors of the headings, as GitHub and mdBook make them.
    pub fn anchors(&self) -> Vec<String> {
        let prose = self.prose();
        let headings = prose.lines().filter(|line| line.starts_with('#'));
        headings
            .map(|line| anchor(line.trim_start_matches('#').trim()))
            .collect()
    }
}

fn anchor(heading: &str) -> String {
    let kept = heading
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c })
        .collect::<String>()
        .to_lowercase()
}

#[test]
fn anchors_are_those_of_github_and_mdbook() {
    let rows = [
        ("Where to start", "where-to-start"),
        ("Level 1: rays", "level-1-rays"),
        ("`[[lights]]` and `samples`", "lights-and-samples"),
        ("Möller–Trumbore", "möllertrumbore"),
    ];
    for (heading, expected) in rows {
        assert_eq!(anchor(heading), expected);
    }
}

/// All pages of the book, by the paths below `docs/src`.
pub fn book() -> Vec<Page> {
    below("docs/src")
}

/// README.md, other pages beside it, the book, and the READMEs of folders.
pub fn manual() -> Vec<Page> {
    let mut pages = in_folder(".");
    pages.extend(book());
    for folder in ["assets/scenes", "shaders/lib"] {
        pages.extend(in_folder(folder));
    }
    pages
}

fn entries(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    paths
}

fn in_folder(folder: &str) -> Vec<Page> {
    let paths = entries(folder).into_iter();
    let pages = paths.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let names = pages.map(|path| path.to_string_lossy().replace('\\', "/"));
    names
        .map(|name| Page::read(name.trim_start_matches("./")))
        .collect()
}

fn below(folder: &str) -> Vec<Page> {
    let mut pages = in_folder(folder);
    for path in entries(folder).into_iter().filter(|path| path.is_dir()) {
        pages.extend(below(&path.to_string_lossy().replace('\\', "/")));
    }
    pages
}
