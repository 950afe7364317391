//! `mutation instrument TREE [PREFIX...]` rewrites a copy of the tree so that every mutant of the model is in one build;
//! `mutation run TREE` finds which tests reach each and runs those against it. See `scripts/mutation`.
#![forbid(unsafe_code)]

mod campaign;
mod edit;
mod instrument;
mod sites;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["instrument", tree, ..] => instrument::instrument(Path::new(tree), &arguments[2..])
            .map(|count| println!("{count} mutants in one build: {tree}/mutants.json")),
        ["run", tree, rest @ ..] => campaign::run(Path::new(tree), rest),
        _ => Err("usage: mutation instrument TREE [PREFIX...] | run TREE [seconds per mutant] [file prefix]".into()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("mutation: {message}");
            ExitCode::FAILURE
        }
    }
}
