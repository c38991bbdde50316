//! The manual's table of bindings is that of the program.

use glimray::viewer::model::bindings::markdown_table;
use std::path::Path;

const BEGIN: &str = "<!-- bindings: UPDATE_README=1 cargo test --release --test suite readme -->\n";
const END: &str = "<!-- end of bindings -->";

#[test]
fn the_readme_has_the_table_of_bindings() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = std::fs::read_to_string(&path).expect("README.md");
    let (before, rest) = readme.split_once(BEGIN).expect("the table's beginning");
    let (table, after) = rest.split_once(END).expect("the table's end");
    let expected = format!("\n{}\n", markdown_table().trim_end());
    if std::env::var_os("UPDATE_README").is_some() {
        let updated = format!("{before}{BEGIN}{expected}\n{END}{after}");
        std::fs::write(&path, updated).expect("README.md written");
        return;
    }
    assert!(
        table.trim() == expected.trim(),
        "README.md has another table of bindings than the program. Run\n  \
         UPDATE_README=1 cargo test --release --test suite readme"
    );
}
