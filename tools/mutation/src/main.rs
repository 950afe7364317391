//! `mutation instrument TREE PREFIXES` rewrites a copy of the tree so that every mutant of a package's files that begin so is in one build;
//! `mutation run TREE SECONDS PREFIXES` finds which tests reach each and runs those against it; `mutation tests TREE SECONDS PREFIXES` finds for each
//! test a mutant that makes it fail. See `scripts/mutation`.
#![forbid(unsafe_code)]

mod campaign;
mod edit;
mod instrument;
mod package;
mod sites;

use std::path::Path;
use std::process::ExitCode;

use package::Package;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["instrument", tree, prefixes] => Package::of_all(prefixes)
            .and_then(|package| instrument::instrument(Path::new(tree), package, prefixes))
            .map(|count| println!("{count} mutants in one build: {tree}/mutants.json")),
        [what @ ("run" | "tests"), tree, seconds, prefixes] => match seconds.parse() {
            Ok(budget) => {
                let campaign = if *what == "run" { campaign::run } else { campaign::failing::run };
                Package::of_all(prefixes).and_then(|package| campaign(Path::new(tree), package, budget))
            }
            Err(_) => Err(format!("seconds: {seconds} is not a number")),
        },
        _ => {
            Err("usage: mutation instrument TREE PREFIXES | run TREE SECONDS PREFIXES | tests TREE SECONDS PREFIXES"
                .into())
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("mutation: {message}");
            ExitCode::FAILURE
        }
    }
}
