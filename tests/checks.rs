//! Runs every check of the project as a test of its own: `cargo test --test checks -- ID`.
//!
//! With the variable `FAIL_FAST` set the first failure ends the run, which is all that mutation tests want to know.

use libtest_mimic::{Arguments, Failed, Trial};
use twofold_verify::check::Check;
use twofold_verify::checks::{all, outcome};
use twofold_verify::claims::markdown;

fn main() {
    let of_check = |check: Check| {
        Trial::test(check.id, move || {
            let outcome = outcome(check.id).expect("a check of the list");
            if outcome.passed {
                return Ok(());
            }
            let failure = match &outcome.measured {
                Ok(measured) => format!(
                    "{}\n{}: {:e}, required {} ({})\n{}",
                    check.statement, check.figure, measured.figure, check.bound, check.reason, measured.detail
                ),
                Err(message) => format!("{}\n{message}", check.statement),
            };
            if std::env::var_os("FAIL_FAST").is_some() {
                eprintln!("{}: {failure}", check.id);
                std::process::exit(101);
            }
            Err(Failed::from(failure))
        })
        .with_kind(check.kind.name())
    };
    let mut trials: Vec<_> = all().into_iter().map(of_check).collect();
    // Last, when most of its figures are there.
    trials.push(Trial::test("page-of-claims", page_of_claims));
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

/// `docs/claims.md` is the generated page, and every check of it passes.
fn page_of_claims() -> Result<(), Failed> {
    let page = std::fs::read_to_string("docs/claims.md")?;
    if page == markdown()? { Ok(()) } else { Err("stale: run `cargo run --release -- claims > docs/claims.md`".into()) }
}
