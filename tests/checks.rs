//! Runs every check of the project as a test of its own: `cargo test --test checks -- ID`.

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
                Err(Failed::from(match outcome.measured {
                    Ok(measured) => format!(
                        "{}\n{}: {:e}, required {} ({})\n{}",
                        check.statement, check.figure, measured.figure, check.bound, check.reason, measured.detail
                    ),
                    Err(message) => format!("{}\n{message}", check.statement),
                }))
            })
            .with_kind(check.kind.name())
        })
        .collect();
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
