//! Runs every check of the project as a test of its own: `cargo test --test checks -- ID`.
//!
//! With the variable `FAIL_FAST` set the first failure ends the run, which is all that mutation tests want to know.

use libtest_mimic::{Arguments, Failed, Trial};

fn main() {
    let trials = twofold_verify::checks::all()
        .into_iter()
        .map(|check| {
            Trial::test(check.id, move || {
                let outcome = check.run();
                if outcome.passed {
                    return Ok(());
                }
                let failure = match outcome.measured {
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
        })
        .collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
