//! Commands with their expected answers, as written in `command/tests/cases`, whose README.md describes the lines.

use std::fs;
use std::path::Path;

use crate::common::{Folder, has_all, stderr, stdout};
use twofold_scene::scene_file::built_in;
use twofold_scene::sweep::SWEEPS;

/// A text with its escaped line ends expanded.
fn unescaped(text: &str) -> String {
    text.replace("\\n", "\n")
}

/// The fragments that a line requires; none if it has only a status.
fn fragments(text: &str) -> Vec<String> {
    text.split(" | ").filter(|part| !part.is_empty()).map(unescaped).collect()
}

fn looked_for(text: &str) -> Vec<String> {
    let found = fragments(text);
    assert!(!found.is_empty(), "a line looks for nothing");
    found
}

/// The words of a line; a quoted part is one word.
fn arguments(line: &str) -> Vec<&str> {
    let quoted = line.split('\'').enumerate();
    quoted.flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() }).collect()
}

/// `NAME: TEXT` or `NAME of SOURCE: FROM -> TO; FROM -> TO`. The source is a file of the session, a built-in scene or sweep, or a file of the repository.
fn write_file(folder: &Folder, line: &str) {
    let (head, text) = line.split_once(':').unwrap_or((line, ""));
    let text = text.strip_prefix(' ').unwrap_or(text);
    let Some((name, source)) = head.split_once(" of ") else {
        let unescaped = unescaped(text);
        let mut parts = unescaped.split("\\x");
        let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
        for part in parts {
            bytes.push(u8::from_str_radix(&part[..2], 16).expect("two digits"));
            bytes.extend_from_slice(&part.as_bytes()[2..]);
        }
        return folder.write(head, bytes);
    };
    let known = built_in(source).or(SWEEPS.iter().find(|sweep| sweep.name == source));
    let read = || fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(source)).expect(source);
    let of_session = folder.at(source).exists().then(|| folder.read(source));
    let mut found = of_session.unwrap_or_else(|| known.map_or_else(read, |file| file.toml.to_owned()));
    for change in text.split("; ").filter(|change| !change.is_empty()) {
        let (from, to) = change.split_once(" ->").expect(change);
        let from = unescaped(from);
        assert!(found.contains(&from), "`{from}` is not in {source}");
        found = found.replace(&from, &unescaped(to.strip_prefix(' ').unwrap_or(to)));
    }
    folder.write(name, found);
}

/// Executes the paragraphs of a file.
fn carry_out(sessions: &str) {
    for paragraph in sessions.split("\n\n") {
        let folder = Folder::new();
        let (mut command, mut out, mut told, mut status, mut before) = ("", String::new(), String::new(), None, vec![]);
        let mut is_judged = true;
        for line in paragraph.lines().filter(|line| !line.starts_with('#')) {
            let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
            let is_preparation = matches!(word, "file" | "$");
            assert!(is_judged || !is_preparation, "no status is told of `{command}`");
            assert!(is_preparation || !command.is_empty(), "`{line}` follows no command");
            is_judged |= !is_preparation && word.trim_end_matches(':').parse::<i32>().is_ok();
            let about = || format!("{command}: {line}\n{out}{told}");
            match word {
                "file" => write_file(&folder, rest),
                "$" => {
                    is_judged = false;
                    before = folder.contents();
                    let output = folder.run(&arguments(rest));
                    (command, out, told, status) = (rest, stdout(&output), stderr(&output), output.status.code());
                    assert!(!told.contains("panicked"), "{command}: {told}");
                }
                "out:" => has_all(&out, &looked_for(rest)),
                "head:" => assert!(out.starts_with(&unescaped(rest)), "{}", about()),
                "is:" => assert_eq!(out, unescaped(rest), "{}", about()),
                "not:" => assert!(
                    !looked_for(rest).iter().any(|part| out.contains(part) || told.contains(part)),
                    "{}",
                    about()
                ),
                "in" => {
                    let (name, text) = rest.split_once(": ").expect("a name and a text");
                    has_all(&folder.read(name), &looked_for(text));
                }
                "rows:" => {
                    let (count, part) = rest.split_once(' ').unwrap_or((rest, ""));
                    let found = out.lines().filter(|line| line.contains(part)).count();
                    assert_eq!(found.to_string(), count, "{}", about());
                }
                "short:" => {
                    let most: usize = rest.parse().expect("a length");
                    assert!(out.lines().chain(told.lines()).all(|line| line.len() < most), "{}", about());
                }
                "silent" => assert!(told.is_empty(), "{}", about()),
                "names:" => assert_eq!(folder.names(), rest.split_whitespace().collect::<Vec<_>>(), "{}", about()),
                _ => {
                    let expected = word.trim_end_matches(':').parse().unwrap_or_else(|_| panic!("what is `{line}`?"));
                    assert_eq!(status, Some(expected), "{}", about());
                    has_all(&told, &fragments(rest));
                    if expected == 2 {
                        assert!(out.is_empty() && told.matches("error: ").count() == 1, "{}", about());
                        assert!(folder.contents() == before, "{}: files have changed", about());
                    }
                }
            }
        }
        assert!(is_judged && !command.is_empty(), "no status is told of `{command}`: {paragraph}");
    }
}

macro_rules! sessions {
    ($($name:ident: $file:literal;)*) => {
        $(
            #[test]
            fn $name() {
                carry_out(include_str!(concat!("../cases/", $file)));
            }
        )*

        #[test]
        fn every_file_of_sessions_is_carried_out() {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
            let found = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
            let mut found: Vec<_> = found.filter(|name| name.ends_with(".txt")).collect();
            found.sort();
            assert_eq!(found, [$($file),*]);
        }
    };
}

sessions! {
    commands_answer_as_written: "command.txt";
    compare_answers_as_written: "compare.txt";
    figures_answers_as_written: "figures.txt";
    inference_answers_as_written: "inference.txt";
    pulses_answers_as_written: "pulses.txt";
    spectrum_answers_as_written: "spectrum.txt";
    sweep_answers_as_written: "sweep.txt";
    timing_answers_as_written: "timing.txt";
}
