//! Every `glimray …` in the manual is a command that the program takes.

use super::pages::manual;
use crate::support::verdict::Verdict;
use std::collections::BTreeMap;
use std::process::Command;

/// The program's help on one command.
struct Help {
    /// By the name with its dashes: the values that an option takes, if they are listed. `None` for a switch.
    flags: BTreeMap<String, Option<Vec<String>>>,
}

/// The output of `glimray help COMMAND`, or of `glimray help` for the command "".
pub fn help_text(command: &str) -> Option<String> {
    let output = Command::new(env!("CARGO_BIN_EXE_glimray"))
        .arg("help")
        .args(command.split_whitespace())
        .output()
        .expect("glimray");
    let is_known = output.status.success();
    is_known.then(|| String::from_utf8(output.stdout).expect("UTF-8"))
}

impl Help {
    fn of(command: &str) -> Option<Self> {
        let mut flags = BTreeMap::new();
        let mut last: Vec<String> = Vec::new();
        for line in help_text(command)?.lines().map(str::trim) {
            let words: Vec<_> = line.split_whitespace().collect();
            let is_flag = |word: &str| {
                word.strip_prefix('-')
                    .is_some_and(|rest| rest.starts_with(|c: char| c == '-' || c.is_alphabetic()))
            };
            if words.first().is_some_and(|word| is_flag(word)) {
                let names = words.iter().take_while(|word| is_flag(word));
                last = names
                    .map(|name| name.trim_end_matches(',').to_owned())
                    .collect();
                let takes_value = words
                    .get(last.len())
                    .is_some_and(|word| word.starts_with('<'));
                for name in &last {
                    flags.insert(name.clone(), takes_value.then(Vec::new));
                }
            }
            let value = line
                .strip_prefix("- ")
                .and_then(|rest| rest.split_once(':'));
            if let Some((value, _)) = value {
                for name in &last {
                    if let Some(Some(values)) = flags.get_mut(name) {
                        values.push(value.to_owned());
                    }
                }
            }
        }
        Some(Self { flags })
    }

    /// The fault in the words after the command's name.
    fn objection(&self, arguments: &[&str]) -> Option<String> {
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            if !word.starts_with('-') || word.len() == 1 {
                continue;
            }
            let (flag, value) = match word.split_once('=') {
                Some((flag, value)) => (flag, Some(value)),
                None => (*word, None),
            };
            let Some(kind) = self.flags.get(flag) else {
                return Some(format!("there is no {flag}"));
            };
            let Some(values) = kind else {
                continue;
            };
            let Some(value) = value.or_else(|| words.next().copied()) else {
                return Some(format!("{flag} needs a value"));
            };
            if !values.is_empty()
                && !value
                    .split(',')
                    .all(|one| values.iter().any(|known| known == one))
            {
                return Some(format!("{flag} takes {values:?}"));
            }
        }
        None
    }
}

/// The commands in `line`, each without the shell's part: variables, comments, pipes and redirections.
fn commands(line: &str) -> Vec<Vec<&str>> {
    let line = line.split(" #").next().unwrap_or_default();
    let parts = line
        .split(['|', '>', ';'])
        .flat_map(|part| part.split("&&"));
    let parts = parts.map(|part| part.split_whitespace().collect::<Vec<_>>());
    let commands = parts.filter_map(|words| {
        let is_program = |word: &&str| *word == "glimray" || word.ends_with("/glimray");
        let at = words.iter().position(is_program)?;
        let is_first = words[..at].iter().all(|word| word.contains('='));
        is_first.then(|| words[at + 1..].to_vec())
    });
    commands.collect()
}

#[test]
fn commands_of_the_manual_are_those_of_the_program_with_their_flags_and_values() {
    let mut helps = BTreeMap::new();
    let mut verdict = Verdict::on("commands of the manual");
    for page in manual() {
        let blocks = page.blocks();
        let scripts = blocks.iter().filter(|block| block.language == "sh");
        let lines = scripts.flat_map(|block| block.text.lines());
        let lines = lines.map(str::to_owned);
        let quoted = page.quoted();
        let quoted = quoted
            .into_iter()
            .filter(|code| code.starts_with("glimray "));
        for line in lines.chain(quoted) {
            for words in commands(&line) {
                let Some((&name, arguments)) = words.split_first() else {
                    continue;
                };
                // The steps of `farm` are commands of their own.
                let (name, arguments) = match arguments.split_first() {
                    Some((step, arguments)) if name == "farm" => {
                        (&*format!("farm {step}"), arguments)
                    }
                    _ => (name, arguments),
                };
                let is_absent = !cfg!(feature = "viewer") && name == "view";
                if is_absent || ["help", "COMMAND", "--help", "--version"].contains(&name) {
                    continue;
                }
                let help = helps
                    .entry(name.to_owned())
                    .or_insert_with(|| Help::of(name));
                let row = format!("{}: {line}", page.path);
                let objection = match help {
                    Some(help) => help.objection(arguments),
                    None => Some(format!("there is no command `{name}`")),
                };
                verdict.that(row, objection.is_none(), || objection.unwrap_or_default());
            }
        }
    }
    assert!(helps.len() >= 12, "{:?}", helps.keys());
    verdict.close();
}

#[test]
fn commands_with_mistakes_are_found() {
    let help = Help::of("render").expect("a command");
    let good = [
        "a.toml",
        "--size",
        "64x64",
        "--tone=aces",
        "-o",
        "-",
        "--look-at",
        "-1,0,0",
    ];
    assert_eq!(help.objection(&good), None);
    for bad in [
        &["a.toml", "--sizes", "64x64"][..],
        &["a.toml", "--size"],
        &["a.toml", "--tone", "filmic"],
    ] {
        assert!(help.objection(bad).is_some(), "{bad:?}");
    }
    let script = "A=1 target/release/glimray demo -o a.png && echo glimray  # glimray nothing";
    assert_eq!(commands(script), [["demo", "-o", "a.png"]]);
    assert!(Help::of("renders").is_none());
}
