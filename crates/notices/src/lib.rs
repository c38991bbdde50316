//! Notices of the crates in the program for one platform: their licences as a text, and a bill of materials (SBOM) for
//! machines. Cargo says which crates these are; `packaging/dist.sh` packs both. Equal sources give equal bytes.

use serde_json::{Value, json};
use std::{
    collections::{BTreeMap, BTreeSet},
    env,
    error::Error,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The file with the texts of all licences.
pub const LICENSES: &str = "THIRD-PARTY-LICENSES.txt";
/// The file with the bill of materials, in CycloneDX.
pub const SBOM: &str = "glimray.cdx.json";

/// Texts of licences that crates name without carrying them, by SPDX identifiers; the first that a crate allows is taken.
const TEXTS: [(&str, &str); 4] = [
    ("MIT", include_str!("../licenses/MIT.txt")),
    ("Apache-2.0", include_str!("../../../LICENSE-APACHE")),
    ("BSD-2-Clause", include_str!("../licenses/BSD-2-Clause.txt")),
    ("ISC", ISC),
];
const ISC: &str = include_str!("../licenses/ISC.txt");

/// Works that crates carry without their licences: the crate, the copyright, the text.
const CARRIED: [(&str, &str, &str); 6] = [
    (
        "epaint_default_fonts",
        "Ubuntu-Light.ttf: Copyright 2011 Canonical Ltd.",
        include_str!("../licenses/Ubuntu-font-1.0.txt"),
    ),
    (
        "epaint_default_fonts",
        "Hack-Regular.ttf: Copyright (c) 2018 Source Foundry Authors",
        TEXTS[0].1,
    ),
    (
        "epaint_default_fonts",
        "Hack-Regular.ttf has glyphs of Bitstream Vera.",
        include_str!("../licenses/Bitstream-Vera.txt"),
    ),
    (
        "lucide-icons",
        "lucide.ttf: Copyright (c) Lucide Contributors",
        ISC,
    ),
    (
        "nv-flip-sys",
        "FLIP: Copyright (c) 2020-2022 NVIDIA CORPORATION & AFFILIATES. All rights reserved.",
        include_str!("../licenses/BSD-3-Clause.txt"),
    ),
    (
        "sctk-adwaita",
        "Cantarell-Regular.ttf: Copyright (c) 2009-2011, Understanding Limited. Copyright (c) 2010-2011, Jakub Steiner.",
        include_str!("../licenses/OFL-1.1.txt"),
    ),
];

/// A crate in the program.
pub struct Package {
    /// The name in the registry.
    pub name: String,
    /// The version.
    pub version: String,
    /// The licences, as an SPDX expression.
    pub license: String,
    /// The authors, if it names any.
    pub authors: Vec<String>,
    /// The address of its sources, if it names one.
    pub repository: Option<String>,
    /// SHA-256 of its archive, in hexadecimal digits; none for crates of this workspace.
    pub checksum: Option<String>,
    /// Where its sources are.
    pub folder: PathBuf,
    /// Crates in the program that it uses, as package URLs.
    pub uses: BTreeSet<String>,
}

impl Package {
    /// The package URL.
    pub fn url(&self) -> String {
        url(&self.name, &self.version)
    }
}

fn url(name: &str, version: &str) -> String {
    format!("pkg:cargo/{name}@{version}")
}

fn cargo(arguments: &[&str]) -> Result<String, Box<dyn Error>> {
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let output = (Command::new(cargo).current_dir(folder).args(arguments)).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

/// The crates that are linked into the program for `target`, by name and version; the program is one of them.
///
/// # Errors
/// Cargo fails, such as for a target that it does not know.
pub fn packages(target: &str) -> Result<Vec<Package>, Box<dyn Error>> {
    let tree = "tree --locked --package glimray --edges normal,no-proc-macro --prefix none --format {p} --target";
    let tree: Vec<_> = tree.split(' ').chain([target]).collect();
    let linked = cargo(&tree)?;
    let linked = linked.lines().filter_map(|line| {
        let (name, version) = line.split_once(" v")?;
        Some(url(name, version.split(' ').next()?))
    });
    let linked: BTreeSet<_> = linked.collect();

    let metadata = "metadata --locked --format-version 1 --filter-platform";
    let metadata: Vec<_> = metadata.split(' ').chain([target]).collect();
    let metadata: Value = serde_json::from_str(&cargo(&metadata)?)?;
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let text = |value: &Value| value.as_str().map(str::to_owned);
    let all = list(&metadata["packages"]);
    let urls: BTreeMap<_, _> = (all.iter())
        .filter_map(|package| {
            let (name, version) = (package["name"].as_str()?, package["version"].as_str()?);
            Some((package["id"].as_str()?, url(name, version)))
        })
        .collect();
    let is_linked = |edge: &Value| {
        let kinds = list(&edge["dep_kinds"]);
        kinds.iter().any(|kind| kind["kind"].is_null())
    };
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for node in list(&metadata["resolve"]["nodes"]) {
        let edges = list(&node["deps"]).into_iter().filter(is_linked);
        let used = edges.filter_map(|edge| urls.get(edge["pkg"].as_str()?).cloned());
        let used = used.filter(|url| linked.contains(url)).collect();
        let id = node["id"].as_str().unwrap_or_default();
        uses.insert(urls[id].clone(), used);
    }

    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../Cargo.lock");
    let lock: toml::Table = fs::read_to_string(lock)?.parse()?;
    let locked = lock["package"].as_array().into_iter().flatten();
    let checksums: BTreeMap<_, _> = locked
        .filter_map(|package| {
            let (name, version) = (package["name"].as_str()?, package["version"].as_str()?);
            Some((url(name, version), package.get("checksum")?.as_str()?))
        })
        .collect();

    let mut found: Vec<Package> = Vec::new();
    for package in &all {
        let (Some(name), Some(version)) = (text(&package["name"]), text(&package["version"]))
        else {
            continue;
        };
        let url = url(&name, &version);
        if !linked.contains(&url) {
            continue;
        }
        let license =
            text(&package["license"]).ok_or_else(|| format!("{name} names no licence."))?;
        let manifest = text(&package["manifest_path"]).unwrap_or_default();
        found.push(Package {
            // An old way to write a choice.
            license: license.replace('/', " OR "),
            authors: list(&package["authors"]).iter().filter_map(text).collect(),
            repository: text(&package["repository"]),
            checksum: checksums.get(&url).map(|&sum| sum.to_owned()),
            folder: PathBuf::from(manifest)
                .parent()
                .unwrap_or(Path::new(""))
                .into(),
            uses: uses.remove(&url).unwrap_or_default(),
            name,
            version,
        });
    }
    found.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    if found.len() != linked.len() {
        return Err(format!("cargo knows {} of {} crates.", found.len(), linked.len()).into());
    }
    Ok(found)
}

/// The licences of the crates from outside, each text once, with the crates that it covers.
///
/// # Errors
/// A crate has no text and names no licence whose text is known; or a file cannot be read.
pub fn licenses(packages: &[Package]) -> Result<String, Box<dyn Error>> {
    let mut page = String::from(
        "The program glimray contains the crates below and the standard library of Rust, whose notices are in the file\n\
         RUST-LICENSES.html. Their licences follow the list.\n\n",
    );
    // By the words of a text: the crates that it covers, and the text as the first of them has it.
    let mut covers: BTreeMap<String, (BTreeSet<String>, String)> = BTreeMap::new();
    for package in packages.iter().filter(|package| package.checksum.is_some()) {
        let Package { name, version, .. } = package;
        let address = package.repository.as_deref().unwrap_or("no address");
        writeln!(page, "{name} {version}: {} ({address})", package.license)?;
        for text in texts(package)? {
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let (crates, _) = covers
                .entry(words)
                .or_insert_with(|| (BTreeSet::new(), text));
            crates.insert(format!("{name} {version}"));
        }
    }
    let mut covers: Vec<_> = covers.into_values().collect();
    covers.sort();
    for (crates, text) in covers {
        let crates = crates.into_iter().collect::<Vec<_>>().join(", ");
        writeln!(page, "\n{}\n{crates}\n", "=".repeat(76))?;
        writeln!(page, "{}", text.replace('\r', "").trim_end())?;
    }
    Ok(page)
}

/// The texts that a crate carries, or that of the licence which it names, and those of the works in it.
fn texts(package: &Package) -> Result<Vec<String>, Box<dyn Error>> {
    let mut files = Vec::new();
    find(&package.folder, &mut files)?;
    files.sort();
    let mut texts = Vec::new();
    for file in files {
        texts.push(String::from_utf8_lossy(&fs::read(file)?).into_owned());
    }
    let Package { name, license, .. } = package;
    if texts.is_empty() {
        let words: Vec<_> = license.split([' ', '(', ')']).collect();
        let (_, text) = (TEXTS.iter()).find(|(id, _)| words.contains(id)).ok_or_else(|| {
            format!("{name} carries no text of {license}, and crates/notices/licenses has none. Add it there.")
        })?;
        let names = package
            .authors
            .iter()
            .map(|author| author.split(" <").next().unwrap_or(author));
        let names = names.collect::<Vec<_>>().join(", ");
        texts.push(match names.is_empty() {
            true => format!("Copyright (c) the authors of {name}\n\n{text}"),
            false => format!("Copyright (c) {names}\n\n{text}"),
        });
    }
    let carried = CARRIED.iter().filter(|(owner, ..)| owner == name);
    texts.extend(carried.map(|(_, copyright, text)| format!("{copyright}\n\n{text}")));
    Ok(texts)
}

/// The files in and below `folder` that are licences by their names, without those of tests.
fn find(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    let is_in_licenses = folder.ends_with("LICENSES") || folder.ends_with("licenses");
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        if path.is_dir() {
            if !["tests", "examples", "benches"].contains(&&*name) {
                find(&path, files)?;
            }
            continue;
        }
        let ending = path
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        let is_text = !["rs", "c", "h", "json", "toml", "ttf", "png"].contains(&&*ending);
        let begins = [
            "license",
            "licence",
            "copying",
            "copyright",
            "notice",
            "unlicense",
            "ofl",
        ];
        let is_license = begins.iter().any(|begin| name.starts_with(begin));
        if is_text && (is_license || is_in_licenses || name.contains("license")) {
            files.push(path);
        }
    }
    Ok(())
}

/// The bill of materials, in [CycloneDX 1.5](https://cyclonedx.org/docs/1.5/json/).
///
/// # Errors
/// The program is not among the crates.
pub fn sbom(packages: &[Package]) -> Result<String, Box<dyn Error>> {
    let component = |package: &Package, kind: &str| {
        let mut component = json!({
            "type": kind,
            "bom-ref": package.url(),
            "name": package.name,
            "version": package.version,
            "licenses": [{ "expression": package.license }],
            "purl": package.url(),
        });
        if let Some(sum) = &package.checksum {
            component["hashes"] = json!([{ "alg": "SHA-256", "content": sum }]);
        }
        if let Some(address) = &package.repository {
            component["externalReferences"] = json!([{ "type": "vcs", "url": address }]);
        }
        component
    };
    let is_program = |package: &&Package| package.name == "glimray";
    let program = packages
        .iter()
        .find(is_program)
        .ok_or("There is no program.")?;
    let others = packages.iter().filter(|package| !is_program(package));
    let bill = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": component(program, "application") },
        "components": others.map(|package| component(package, "library")).collect::<Vec<_>>(),
        "dependencies": packages.iter().map(|package| {
            json!({ "ref": package.url(), "dependsOn": package.uses })
        }).collect::<Vec<_>>(),
    });
    Ok(serde_json::to_string_pretty(&bill)? + "\n")
}
