//! Notes about skipped features. A file may cause millions of similar notes, so the first few of each
//! kind are kept and the others counted.

use glimray_scene::text::one_line;

/// Number of notes kept per kind.
const MOST: usize = 8;

/// Notes for [`glimray_scene::Scene::skipped`], in order, grouped by kind, and those for its remarks.
#[derive(Debug, Default)]
pub(super) struct Notes {
    kinds: Vec<Kind>,
    remarks: Vec<String>,
}

#[derive(Debug)]
struct Kind {
    /// The subject of the notes, in the plural.
    what: &'static str,
    kept: Vec<String>,
    more: usize,
}

impl Notes {
    fn kind(&mut self, what: &'static str) -> &mut Kind {
        let known = self.kinds.iter().position(|kind| kind.what == what);
        let index = known.unwrap_or_else(|| {
            self.kinds.push(Kind {
                what,
                kept: Vec::new(),
                more: 0,
            });
            self.kinds.len() - 1
        });
        &mut self.kinds[index]
    }

    /// Adds a note of the kind `what`, a plural such as "undefined materials", unless an equal one is
    /// kept.
    pub fn add(&mut self, what: &'static str, note: impl FnOnce() -> String) {
        let kind = self.kind(what);
        if kind.kept.len() >= MOST {
            kind.more += 1;
            return;
        }
        let note = one_line(&note());
        if !kind.kept.contains(&note) {
            kind.kept.push(note);
        }
    }

    /// Adds notes of the kind `what`, all of which are kept: their number is bounded already.
    pub fn keep(&mut self, what: &'static str, lines: Vec<String>) {
        self.kind(what).kept.extend(lines);
    }

    /// Adds a sentence on what is neither skipped nor repaired: it was asked for, or says nothing about the picture.
    pub fn remark(&mut self, sentence: String) {
        self.remarks.push(sentence);
    }

    /// The remarks, which [`Notes::into_lines`] leaves out.
    pub fn take_remarks(&mut self) -> Vec<String> {
        std::mem::take(&mut self.remarks)
    }

    /// Adds the notes of one of several files, prefixed with its name.
    pub fn append(&mut self, mut other: Self, name: &str) {
        let remarks = other.take_remarks().into_iter();
        (self.remarks).extend(remarks.map(|remark| format!("{name}: {remark}")));
        for Kind { what, kept, more } in other.kinds {
            for note in kept {
                self.add(what, || format!("{name}: {note}"));
            }
            self.kind(what).more += more;
        }
    }

    /// One sentence each.
    pub fn into_lines(self) -> Vec<String> {
        let lines = self.kinds.into_iter().flat_map(|kind| {
            let more = (kind.more > 0).then(|| format!("and {} more {}", kind.more, kind.what));
            kind.kept.into_iter().chain(more)
        });
        lines.collect()
    }
}

/// Notes the repairs that [`glimray_scene::Mesh::repair`] made.
pub(super) fn of_repairs(notes: &mut Notes, repairs: glimray_scene::Repairs) {
    const WHAT: &str = "repaired meshes";
    let count = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    };
    if repairs.dropped_triangles > 0 {
        let triangles = count(repairs.dropped_triangles, "triangle");
        notes.add(WHAT, || format!("dropped {triangles} without area"));
    }
    if repairs.dangling_triangles > 0 {
        let triangles = count(repairs.dangling_triangles, "triangle");
        notes.add(WHAT, || {
            format!("dropped {triangles} with vertices that do not exist")
        });
    }
    if repairs.recomputed_normals > 0 {
        let normals = count(repairs.recomputed_normals, "normal");
        notes.add(WHAT, || format!("recomputed {normals} of zero length"));
    }
}
