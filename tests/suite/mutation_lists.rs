//! The lists of the mutation tests are of today's sources: a fault without its place would be left out unseen.

use std::fs;

/// Lines of a list, each as its fields.
fn list(file: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{file}: {error}"));
    text.lines().map(|line| line.split('\t').map(str::to_string).collect()).collect()
}

/// The source from the name of the function or constant on, without what lays it out.
fn source(file: &str, function: &str) -> String {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{file}: {error}"));
    let name = function.rsplit("::").next().unwrap_or(function);
    let place = |kind: &str| text.find(&format!("{kind} {name}"));
    let at = place("fn").or_else(|| place("const")).unwrap_or_else(|| panic!("{file} has no {name}"));
    laid_out(&text[at..])
}

/// All sources of the model.
fn sources() -> Vec<String> {
    let mut folders = vec![std::path::PathBuf::from("src")];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if entry.is_dir() { folders.push(entry) } else { found.push(fs::read_to_string(entry).expect("a source")) }
        }
    }
    found
}

fn laid_out(code: &str) -> String {
    code.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_fault_of_physicists_has_its_place() {
    let faults = list("tools/mutation/domain.tsv");
    assert!(faults.len() >= 60, "{} faults", faults.len());
    for fault in faults {
        let [file, function, from, to, what] = &fault[..] else { panic!("not five fields: {fault:?}") };
        let from = laid_out(&from.replace("\\n", "\n"));
        assert!(source(file, function).contains(&from), "{file}, {function}: no `{from}` for the fault: {what}");
        assert_ne!(from, laid_out(&to.replace("\\n", "\n")), "{what} changes nothing");
    }
}

/// Of the lists of what changes nothing, with a proof, and of what is caught in an edited source, with the test that fails.
#[test]
fn every_listed_mutant_has_its_place_and_a_reason() {
    for mutant in ["tools/mutation/equivalent.tsv", "tools/mutation/edited.tsv"].into_iter().flat_map(list) {
        let [file, function, change, code, which, proof] = &mutant[..] else { panic!("not six fields: {mutant:?}") };
        if file == "*" {
            let name = change.split(':').next().unwrap_or_default();
            let is_called = sources().iter().any(|source| source.contains(&format!("{name}(")));
            assert!(is_called, "no source calls {name}");
        } else {
            let source = if function == "*" {
                laid_out(&fs::read_to_string(file).expect("a source"))
            } else {
                source(file, function)
            };
            assert!(code == "*" || source.contains(code.as_str()), "{file}, {function}: no `{code}`");
        }
        assert!(which == "all" || which.parse::<usize>().is_ok_and(|place| place > 0), "{file}, {function}: {which}");
        assert!(proof.len() > 20, "{file}, {function}: no reason");
    }
}
